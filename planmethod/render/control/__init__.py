"""Norm control of a drawing (нормоконтроль)."""
