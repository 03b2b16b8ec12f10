"""Linkages (рычажные механизмы) as a kind of problem: their files, and what the commands ask."""
