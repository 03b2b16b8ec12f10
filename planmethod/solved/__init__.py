"""The solved problem: closings, scales, the readings of its program, what follows from them."""
