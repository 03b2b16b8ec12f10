"""Plans as programs of steps: positions, velocities, accelerations, forces (планы)."""
