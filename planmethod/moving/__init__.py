"""The moving point: its law as formulas, velocity, acceleration and curvature (движение точки).

The functions of a kind of problem (`planmethod.kinds`) stand here; what draws is imported
late, as a solution needs no pens.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from planmethod.moving.reader import load
from planmethod.moving.record import record
from planmethod.moving.text import solved_text

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.moving.figures import PointFigures
    from planmethod.moving.model import PointProblem
    from planmethod.note.audit.audit import Audited
    from planmethod.render.ink.drawing import Drawing

__all__ = ["asked_of", "audited", "drawings", "load", "protocol_text", "record", "solved_text"]


def drawings(
    problem: PointProblem,
    *,
    fields: Mapping[str, str],
    profile: Profile,
    before: int = 0,
    total: int | None = None,
) -> list[Drawing]:
    """Return the sheet of a moving point; see `planmethod.moving.sheet.point_sheets`."""
    from planmethod.moving.sheet import point_sheets

    return point_sheets(problem, fields=fields, profile=profile, before=before, total=total)


def protocol_text(problem: PointProblem, lang: str, profile: Profile) -> str:
    """Return how a moving point is drawn; see `planmethod.moving.protocol.protocol_text`."""
    from planmethod.moving.protocol import protocol_text as tell

    return tell(problem, lang, profile)


def audited(problem: PointProblem, ruler: float) -> list[Audited]:
    """Return what the source prints beside the exact and the read value."""
    from planmethod.moving.audit import audited as compare

    return compare(problem, ruler)


def asked_of(problem: PointProblem) -> PointFigures:
    """Return what students can be asked for."""
    from planmethod.moving.figures import PointFigures

    return PointFigures(problem)
