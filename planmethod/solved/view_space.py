"""Space of the scheme and of the plans on a format, and rows of plans (поля видов)."""

from __future__ import annotations

from collections.abc import Sequence

from msgspec import Struct

from planmethod.paper import FORMATS
from planmethod.plans.model import MOTION, PlanKind
from planmethod.solved.legibility import FEW, Box
from planmethod.solved.reading import Reals


class Views(Struct, frozen=True):
    """Space that the drawn mechanism and the plans should fill, mm (поля видов).

    It goes with a paper format: the sheet's layout reserves just this space, and the numbers of
    `solve` and the drawing of `sheet` therefore have the same scales.

    Attributes
    ----------
    paper : str
    position, velocity, acceleration : Box, mm
        Box of each kind; for many positions the space of all its plans on a sheet, in rows.
    many : bool
        There are several positions.
    fixed : frozenset of PlanKind
        Kinds whose box, given by a composition, is that of each single plan and is kept exactly.
    """

    paper: str
    position: Box
    velocity: Box
    acceleration: Box
    many: bool = False
    fixed: frozenset[PlanKind] = frozenset()

    def box(self, kind: PlanKind) -> Box:
        """Return the space of a kind, mm."""
        box: Box = getattr(self, kind.value)
        return box

    def in_rows(self, kind: PlanKind) -> bool:
        """Return whether the space of a kind is that of many plans."""
        return self.many and kind is not PlanKind.POSITION and kind not in self.fixed

    def plan_box(self, kind: PlanKind, count: int, in_row: int) -> Box:
        """Return the space of one of ``count`` plans, ``in_row`` beside one another, mm."""
        width, height = self.box(kind)
        if not self.in_rows(kind):
            return width, height
        rows = min(-(-count // in_row), ROWS)
        return width / min(count, in_row) - BESIDE, height / rows - UNDER

    @classmethod
    def for_scheme(cls, box: Box) -> Views:
        """Return the space of a scheme that is drawn without a sheet around it."""
        return cls("", box, box, box, fixed=frozenset(MOTION))

    @classmethod
    def for_paper(cls, paper: str, positions: int) -> Views:
        """Return the space on a format for one position, for a few or for many.

        An elongated format has that of the basic one that is as high as it lies.
        """
        one = positions == 1
        table = ONE_POSITION if one else FEW_POSITIONS if positions <= FEW else MANY_POSITIONS
        return cls(paper, *table[AS_HIGH.get(paper, paper)], many=not one)


AS_HIGH = {fmt.name: fmt.like for fmt in FORMATS.values() if fmt.like != fmt.name}
"""Base format whose space is used for an elongated or a portrait one."""

ONE_POSITION: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (60.0, 50.0), (60.0, 55.0)),
    "A3": ((150.0, 90.0), (120.0, 95.0), (125.0, 115.0)),
    "A2": ((235.0, 150.0), (190.0, 160.0), (200.0, 195.0)),
    "A1": ((320.0, 220.0), (260.0, 230.0), (290.0, 300.0)),
    "A0": ((380.0, 300.0), (360.0, 320.0), (400.0, 420.0)),
}
FEW_POSITIONS: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (160.0, 50.0), (160.0, 50.0)),
    "A3": ((110.0, 90.0), (230.0, 70.0), (230.0, 75.0)),
    "A2": ((190.0, 130.0), (330.0, 110.0), (330.0, 115.0)),
    "A1": ((290.0, 230.0), (500.0, 165.0), (500.0, 175.0)),
    "A0": ((320.0, 260.0), (720.0, 240.0), (720.0, 250.0)),
}
MANY_POSITIONS: dict[str, tuple[Box, Box, Box]] = {
    "A4": ((80.0, 50.0), (160.0, 60.0), (160.0, 60.0)),
    "A3": ((100.0, 80.0), (240.0, 90.0), (240.0, 90.0)),
    "A2": ((150.0, 120.0), (340.0, 110.0), (340.0, 110.0)),
    "A1": ((310.0, 250.0), (540.0, 210.0), (540.0, 220.0)),
    "A0": ((320.0, 260.0), (730.0, 240.0), (730.0, 250.0)),
}

ROWS = 2
"""Rows of plans of one kind on a sheet."""

BESIDE, UNDER = 24.0, 22.0
"""Space of a plan's letters beside it, and with its caption under it, mm."""

SCALE_CAPTION = 5.5
"""Space of a plan's own scale under it, mm."""

ALL = 10.0
"""Space that several positions of a scheme take around one."""

STROKE = 18.0
"""Space of the stroke and its lines over the scheme of many positions, mm."""

NAME = {"A4": 28.0, "A3": 32.0, "A2": 35.0, "A1": 40.0, "A0": 40.0}
"""Space of a view's letters above and below it, with its name and its scale, mm."""

RAGGED = 1.15
"""Factor by which rows may be wider for their plans to be aligned in columns."""

BETWEEN = 6.0
"""White between the plans of a row, and between rows, mm."""


def per_row(count: int) -> int:
    """Return the number of plans in a row, given their count."""
    return count if count <= FEW else 6


def column_widths(wide: Sequence[float] | Reals, step: int) -> list[float]:
    """Return the widths of columns for plans in rows of ``step``, mm.

    Empty if one large plan would widen the column of many small ones: then rows are not aligned.
    """
    columns = [float(max(wide[k::step])) for k in range(step)]
    return columns if sum(columns) <= RAGGED * _widest_row(wide, step) else []


def row_width(wide: Sequence[float] | Reals, step: int) -> float:
    """Return the width of rows of ``step`` plans, mm."""
    return (sum(column_widths(wide, step)) or _widest_row(wide, step)) + BETWEEN * (step - 1)


def _widest_row(wide: Sequence[float] | Reals, step: int) -> float:
    return max(float(sum(wide[k : k + step])) for k in range(0, len(wide), step))
