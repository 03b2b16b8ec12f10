"""Clearance (свободное поле): what keeps out of the graphs that stand within the frame."""

from __future__ import annotations

from collections.abc import Iterable

from planmethod.render.frame.furniture import Room
from planmethod.render.ink.drawing import Bounds, Item
from planmethod.render.ink.extent import ink_bounds

GAP = 4.0
"""Least white between what is drawn and a graph, mm."""


def is_clear(items: Iterable[Item], room: Room) -> bool:
    """Whether no item comes near a graph; an item that lies across it is judged by its box."""
    boxes = [ink_bounds([item]) for item in items] if room.taken else []
    return not any(overlap(box, graph, GAP) for box in boxes for graph in room.taken)


def overlap(one: Bounds, two: Bounds, gap: float = 0.0) -> bool:
    """Whether two boxes are nearer than ``gap`` mm, or lie on each other."""
    across = one[0] < two[2] + gap - 1e-6 and two[0] < one[2] + gap - 1e-6
    return across and one[1] < two[3] + gap - 1e-6 and two[1] < one[3] + gap - 1e-6
