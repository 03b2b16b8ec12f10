"""A program compiled to one straight line of real arithmetic, for batches of positions."""
