"""Positions by the thousand: sweeps and their gaps (развёртка)."""
