"""Sentences and formulas of the force analysis (силовой расчёт)."""
