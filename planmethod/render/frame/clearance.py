"""Clearance (свободное поле): what keeps out of the graphs that stand within the frame."""

from __future__ import annotations

from collections.abc import Iterable

from planmethod.render.frame.furniture import Room
from planmethod.render.ink.drawing import Item
from planmethod.render.ink.extent import ink_bounds, overlap

GAP = 4.0
"""Least white between what is drawn and a graph, mm."""


def is_clear(items: Iterable[Item], room: Room) -> bool:
    """Whether no item comes near a graph; an item that lies across it is judged by its box."""
    boxes = [ink_bounds([item]) for item in items] if room.taken else []
    return not any(overlap(box, graph, GAP) for box in boxes for graph in room.taken)
