"""Mechanisms without redundant constraints: poses of the plane, schemes evaluated by rank."""
