"""Two wheels with involute teeth: sizes, limits, profiles, the sheet (эвольвентное зацепление).

The functions of a kind of problem (`planmethod.kinds`) stand here.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from planmethod.gears.involute.model import MeshingProblem
from planmethod.gears.involute.reader import load
from planmethod.gears.involute.record import record
from planmethod.gears.involute.text import protocol_text, solved_text

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.render.ink.drawing import Drawing

__all__ = ["drawings", "load", "protocol_text", "record", "solved_text"]


def drawings(
    problem: MeshingProblem,
    *,
    fields: Mapping[str, str],
    profile: Profile,
    before: int = 0,
    total: int | None = None,
) -> list[Drawing]:
    """Draw the sheet; what draws is not imported by those who only compute."""
    from planmethod.gears.involute.sheet import drawings as draw

    return draw(problem, fields=fields, profile=profile, before=before, total=total)
