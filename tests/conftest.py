from __future__ import annotations

from hypothesis import settings

# A slow machine is no failure, and a run is like the one before it.
settings.register_profile("planmethod", deadline=None, derandomize=True)
settings.load_profile("planmethod")
