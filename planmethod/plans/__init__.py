"""Plans as programs of steps: positions, velocities, accelerations, and the solved problem."""
