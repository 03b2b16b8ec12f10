"""The machine over its cycle: reduced moments and inertia, work, flywheel (динамика машины)."""
