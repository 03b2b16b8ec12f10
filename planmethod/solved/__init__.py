"""The solved problem: assembly modes, scales, readings of its program, derived results."""
