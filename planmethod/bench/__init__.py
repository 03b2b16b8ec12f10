"""A speed benchmark: one four-bar, solved here and by peers."""
