"""Constructions played stroke by stroke: a record, its page, and its frames as pictures."""
