"""Cams by the plan method (кулачковые механизмы)."""
