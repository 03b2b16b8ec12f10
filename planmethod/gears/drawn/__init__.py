"""Drawings of gear trains: the scheme, velocity diagrams, the sheet (чертежи)."""
