"""Gear trains: read, solved in fractions, described, drawn (зубчатые механизмы)."""
