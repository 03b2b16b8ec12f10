"""Composition of a sheet (компоновка): blocks in reading order, their groups and sizes.

A composition is data: the shipped ones are TOML files beside this module, and a department may give
its own. `planmethod.render.sheets.composition` reads them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.layout.groups import Arrange
from planmethod.render.sheets.composer import Sizes
from planmethod.render.sheets.compositions import SHIPPED
from planmethod.solved.scaling import LESS
from planmethod.solved.view_space import AS_HIGH, Views


class BlockSpec(Struct, frozen=True):
    """One block of a composition, as specified by the file (блок компоновки).

    Attributes
    ----------
    kind : str
        A name of `planmethod.render.sheets.blocks.BLOCKS`.
    of : PlanKind or None
        Plan of the block, its equations or calculation.
    group : tuple of str
        The groups that contain it, the outer one first.
    sheet : int
        Number of the sheet, from 1.
    droppable : bool
        It may be left out if the paper is too small.
    heights : tuple of float, mm
        Letter heights to try, the first that fits; empty for that of the format.
    letter, title_height : float or None, mm
        Letters on a view, and of its name.
    width : float or None
        Width to set to, mm; to 1, a part of the paper's width inside the frame.
    per_row : int or None
        Plans in a row.
    position : int or None
        The only position that is shown.
    positions : tuple of int
        Positions whose plans are chosen; empty for one of either stroke.
    columns : tuple of str
        Kinds of columns of a table: v, ω, a, ε; empty for all.
    traces : bool or tuple of str, optional
        Traces of the construction: all, none, or those of the points with these letters.
    hatched : bool
        Triangles of the similarity theorem are hatched.
    asked : tuple of str
        Quantities whose graphs are drawn, by label.
    number : int
        Number of the force plan, from 0: each plan has its own copies of the blocks.
    """

    kind: str
    of: PlanKind | None = None
    group: tuple[str, ...] = ()
    sheet: int = 1
    droppable: bool = False
    title: str | None = None
    text: str = ""
    heights: tuple[float, ...] = ()
    letter: float | None = None
    title_height: float | None = None
    width: float | None = None
    per_row: int | None = None
    position: int | None = None
    positions: tuple[int, ...] = ()
    columns: tuple[str, ...] = ()
    traces: bool | tuple[str, ...] | None = None
    hatched: bool = False
    asked: tuple[str, ...] = ()
    number: int = 0


class SheetSpec(Struct, frozen=True):
    """Name of a sheet for the title block, and its own formats in place of the common ones."""

    title: str = ""
    formats: tuple[str, ...] = ()


class Composition(Struct, frozen=True):
    """Blocks of the sheets, and their arrangement (компоновка листов).

    Attributes
    ----------
    formats : tuple of str
        Formats tried in turn if none is requested.
    smaller : tuple of str
        Formats tried before them: taken only if no blocks are left out, since a larger one would be
        mostly white, and, with sizes of its own, if groups stay whole at these.
    per_sheet : tuple of int
        Numbers of positions on one sheet, the largest that fits; the others are on further sheets.
    grow : bool
        Plans whose scale is free are drawn larger where the paper has room.
    turn : bool
        It is the sheet of a turn: ``cycle``, with adjustable scales of velocities and
        accelerations.
    cycle : bool
        The positions are the numbered ones of the cycle unless others are requested.
    colour : bool
        Lines have the colours of their meanings unless the problem's settings have none.
    sizes : mapping
        Sizes by basic format.
    arranged : mapping
        Arrangement of the members of a group, by its path; ``()`` is the whole sheet.
    sheet_specs : mapping
        Names and own formats of sheets, by their numbers.
    """

    name: str
    about: str
    formats: tuple[str, ...]
    smaller: tuple[str, ...]
    per_sheet: tuple[int, ...]
    grow: bool
    turn: bool
    cycle: bool
    colour: bool
    sizes: Mapping[str, Sizes]
    arranged: Mapping[tuple[str, ...], Arrange]
    sheet_specs: Mapping[int, SheetSpec]
    blocks: tuple[BlockSpec, ...]

    @property
    def sheets(self) -> tuple[int, ...]:
        """Numbers of the sheets that have blocks."""
        return tuple(sorted({entry.sheet for entry in self.blocks}))

    def sheet_spec(self, number: int) -> SheetSpec:
        """Return name and formats of a sheet."""
        return self.sheet_specs.get(number, SheetSpec())

    def without(self, numbers: Sequence[int]) -> Composition:
        """Return the composition without some sheets."""
        kept = tuple(entry for entry in self.blocks if entry.sheet not in numbers)
        return self if len(kept) == len(self.blocks) else replace(self, blocks=kept)

    @property
    def is_estimated(self) -> bool:
        """True if sizes and scales are those that the estimate has decided for all outputs.

        This holds for the default compositions.
        """
        return self.name in SHIPPED[:3]

    @property
    def levels(self) -> int:
        """Number of letter heights to try."""
        return max((len(entry.heights) for entry in self.blocks), default=1) or 1

    def list_per_sheet(self, positions: int) -> tuple[int, ...]:
        """Return the numbers of positions on one sheet to try for ``positions`` in all."""
        if positions == 1:
            return (1,)
        room = min((n for n in self.per_sheet if n >= positions), default=max(self.per_sheet))
        return tuple(n for n in self.per_sheet if n <= room)

    @property
    def trials(self) -> tuple[tuple[bool, float], ...]:
        """Trials on a format: whether groups stay whole, and the fraction of the sizes.

        Only boxes of its own may be reduced: views become smaller before groups are dissolved.
        """
        if not any(sizes.boxes for sizes in self.sizes.values()):
            return ((False, 1.0),)
        return ((True, 1.0), (True, LESS), (True, LESS**2), (False, 1.0), (False, LESS))

    def sizes_for(self, paper: str, fraction: float = 1.0) -> Sizes:
        """Return the sizes of a format, for an elongated one those of the basic one as high."""
        basic = AS_HIGH.get(paper, paper)
        return self.sizes[basic if basic in self.sizes else paper[:2]].scaled(fraction)

    def views_for(self, paper: str, positions: int, fraction: float = 1.0) -> Views:
        """Return the boxes of the views on a format."""
        views = Views.for_paper(paper, positions)
        for kind, box in self.sizes_for(paper, fraction).boxes:
            named: dict[str, Any] = {kind.value: box}
            views = replace(views, fixed=views.fixed | {kind}, **named)
        return views


class BlockOptions(Struct, frozen=True):
    """Options of all blocks of a sheet: its language, and the display of drafting errors.

    ``errors``: ellipses around points; ``sigma``: errors in the tables; None: only in the results
    of a single position. ``turn``: it is the sheet of a turn, and the scheme has the construction
    of the extreme positions. ``traces``: there is space for traces of the construction that are not
    requested. ``quantities`` are the quantities whose graphs are drawn. ``plans``: number of
    positions of a turn with plans if the file names none; 0: one of either stroke.
    """

    language: Language
    errors: bool = False
    sigma: bool | None = None
    turn: bool = False
    traces: bool = True
    quantities: tuple[str, ...] = ()
    plans: int = 0


class BlockStyle(Struct, frozen=True):
    """Style of a block on a sheet: the settings of the file, and the format's sizes.

    ``level`` counts the letter heights that did not fit; ``inside`` is the width inside the frame,
    mm.
    """

    entry: BlockSpec
    sizes: Sizes
    inside: float
    options: BlockOptions
    level: int = 0

    def larger(self, *, below: float) -> BlockStyle:
        """Return it with the next larger letters below a height, mm, if any."""
        heights, now = self.entry.heights, self.text(0.0)
        levels = [k for k in range(len(heights)) if now < heights[k] < below]
        return replace(self, level=max(levels)) if levels else self

    @property
    def language(self) -> Language:
        """Language of the sheet."""
        return self.options.language

    @property
    def letter(self) -> float:
        """Height of the letters on a view, mm."""
        return self.sizes.letter if self.entry.letter is None else self.entry.letter

    @property
    def title(self) -> float:
        """Height of the name of a view, mm."""
        asked = self.entry.title_height
        return self.sizes.title if asked is None else asked

    def text(self, usual: float) -> float:
        """Return the height of a text, mm; ``usual`` unless the file sets one."""
        heights = self.entry.heights
        return heights[min(self.level, len(heights) - 1)] if heights else usual

    def width(self, usual: float) -> float:
        """Return the width to set to, mm; ``usual`` unless the file sets one."""
        asked = self.entry.width
        if asked is None:
            return usual
        return asked if asked > 1.0 else asked * self.inside
