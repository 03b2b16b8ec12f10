"""Diagrams as constructions: graphical differentiation and integration (диаграммы)."""
