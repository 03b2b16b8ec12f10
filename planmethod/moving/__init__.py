"""The moving point: its law as formulas, velocity, acceleration and curvature (движение точки)."""
