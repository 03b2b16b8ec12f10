"""Blocks of a sheet and how they are put together (компоновка)."""
