"""Gear trains: read, solved in fractions, told, drawn (зубчатые механизмы)."""
