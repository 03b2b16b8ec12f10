"""Gear trains: read, solved in fractions, told, drawn (зубчатые механизмы).

The functions of a kind of problem (`planmethod.kinds`) stand here; what draws is imported late, as
a solution needs no pens.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from planmethod.gears.driving import driven
from planmethod.gears.reader import load
from planmethod.gears.record import record, structure_record
from planmethod.gears.text import solved_text, structure_text

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.gears.figures import TrainFigures
    from planmethod.gears.model import GearProblem
    from planmethod.note.audit.audit import Audited
    from planmethod.render.ink.drawing import Drawing

__all__ = [
    "asked_of",
    "audited",
    "drawings",
    "driven",
    "load",
    "protocol_text",
    "record",
    "solved_text",
    "structure_record",
    "structure_text",
]


def drawings(
    problem: GearProblem,
    *,
    fields: Mapping[str, str],
    profile: Profile,
    before: int = 0,
    total: int | None = None,
) -> list[Drawing]:
    """Return the sheet of a train."""
    from planmethod.gears.drawn.sheet import drawings as draw

    return draw(problem, fields=fields, profile=profile, before=before, total=total)


def protocol_text(problem: GearProblem, lang: str, profile: Profile) -> str:
    """Tell the construction of the pictures."""
    from planmethod.gears.protocol import protocol_text as tell

    return tell(problem, lang, profile)


def audited(problem: GearProblem, ruler: float) -> list[Audited]:
    """Return what the source prints beside the exact and the read value."""
    from planmethod.gears.audit import audited as compare

    return compare(problem, ruler)


def asked_of(problem: GearProblem) -> TrainFigures:
    """Return what students can be asked for."""
    from planmethod.gears.figures import TrainFigures

    return TrainFigures(problem)
