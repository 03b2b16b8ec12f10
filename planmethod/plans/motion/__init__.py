"""Position, velocity and acceleration plans of the driver and of every dyad (планы движения)."""
