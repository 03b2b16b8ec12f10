"""Blocks of a sheet and their arrangement (компоновка)."""
