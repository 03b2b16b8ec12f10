"""Gear trains: read, solved in fractions, told (зубчатые механизмы).

The functions of a kind of problem (`planmethod.kinds`) stand here.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from planmethod.gears.answers import published_values
from planmethod.gears.driving import driven
from planmethod.gears.reader import load
from planmethod.gears.record import record, structure_record
from planmethod.gears.text import solved_text, structure_text

if TYPE_CHECKING:
    from planmethod.gears.model import GearProblem
    from planmethod.note.audit.audit import Audited

__all__ = [
    "audited",
    "driven",
    "load",
    "record",
    "solved_text",
    "structure_record",
    "structure_text",
]


def audited(problem: GearProblem, ruler: float) -> list[Audited]:
    """Return what the source prints beside the exact value; nothing is read with a ruler."""
    from planmethod.note.audit.audit import Audited

    return [Audited(*pair) for pair in published_values(problem)]
