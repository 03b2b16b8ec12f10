"""The moving point: law as formulas, velocity, acceleration, curvature (движение точки)."""
