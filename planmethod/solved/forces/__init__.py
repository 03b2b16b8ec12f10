"""Loads in numbers, reactions, the balancing moment, the lever (силовой расчёт)."""
