"""Compositions of sheets (компоновка): what they are, and how their files are read."""
