"""Mechanisms without redundant constraints: poses of the plane, schemes judged by rank."""
