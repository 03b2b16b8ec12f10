"""What a sheet is composed of (компоновка): blocks in reading order, their groups and sizes.

A composition is data: the shipped ones are TOML files beside this module, and a department may give
its own. `planmethod.render.sheets.composition.reader` reads them.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.layout.cuttings import Arrange
from planmethod.render.sheets.composer import Sizes
from planmethod.render.sheets.compositions import SHIPPED
from planmethod.solved.scaling import AS_HIGH, LESS, Views


class Entry(Struct, frozen=True):
    """One block of a composition, as the file asks for it (блок компоновки).

    Attributes
    ----------
    kind : str
        A name of `planmethod.render.sheets.blocks.BLOCKS`.
    of : PlanKind or None
        Whose plan, equations or calculation.
    group : tuple of str
        The groups it stands in, the outer one first.
    sheet : int
        Number of the sheet, from 1.
    droppable : bool
        It may be left out where the paper has no room.
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
    asked : tuple of str
        Quantities whose graphs are drawn, by label.
    number : int
        Which of the force plans, from 0: the blocks of one are made for each of them.
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
    asked: tuple[str, ...] = ()
    number: int = 0


class Composition(Struct, frozen=True):
    """Blocks of the sheets, and how they are arranged (компоновка листов).

    Attributes
    ----------
    formats : tuple of str
        Formats tried in turn when none is asked for.
    smaller : tuple of str
        Formats tried before them: taken where nothing is left out, as a larger one would be white.
    per_sheet : tuple of int
        Positions on one sheet: as many as fit; the others go on further sheets.
    grow : bool
        Plans whose scale is free are drawn larger where the paper has room.
    turn : bool
        It is the sheet of a turn: ``cycle``, and scales of velocities and accelerations give way.
    cycle : bool
        The positions are the numbered ones of the cycle where no others are asked.
    sizes : mapping
        By basic format.
    arranged : mapping
        How the members of a group stand, by its path; ``()`` is the whole sheet.
    titles : mapping
        Names of sheets for the title block, by their numbers.
    """

    name: str
    about: str
    formats: tuple[str, ...]
    smaller: tuple[str, ...]
    per_sheet: tuple[int, ...]
    grow: bool
    turn: bool
    cycle: bool
    sizes: Mapping[str, Sizes]
    arranged: Mapping[tuple[str, ...], Arrange]
    titles: Mapping[int, str]
    blocks: tuple[Entry, ...]

    @property
    def sheets(self) -> tuple[int, ...]:
        """Numbers of the sheets that have blocks."""
        return tuple(sorted({entry.sheet for entry in self.blocks}))

    @property
    def is_estimated(self) -> bool:
        """Whether room and scales are those that the estimate has decided for all outputs.

        So it is of the compositions that are taken when none is asked for.
        """
        return self.name in SHIPPED[:3]

    @property
    def levels(self) -> int:
        """How many letter heights there are to try."""
        return max((len(entry.heights) for entry in self.blocks), default=1) or 1

    def at_most(self, positions: int) -> tuple[int, ...]:
        """Return the numbers of positions on one sheet to try for so many positions."""
        if positions == 1:
            return (1,)
        room = min((n for n in self.per_sheet if n >= positions), default=max(self.per_sheet))
        return tuple(n for n in self.per_sheet if n <= room)

    @property
    def shares(self) -> tuple[float, ...]:
        """Parts of its sizes to try on a format; boxes that it asks for itself may be smaller."""
        return (1.0, LESS) if any(sizes.boxes for sizes in self.sizes.values()) else (1.0,)

    def sizes_for(self, paper: str, share: float = 1.0) -> Sizes:
        """Return the sizes of a format; an elongated one has those of the basic one as high."""
        basic = AS_HIGH.get(paper, paper)
        return self.sizes[basic if basic in self.sizes else paper[:2]].parts(share)

    def views_for(self, paper: str, positions: int, share: float = 1.0) -> Views:
        """Return the boxes that the views shall fill on a format."""
        views = Views.for_paper(paper, positions)
        for kind, box in self.sizes_for(paper, share).boxes:
            named: dict[str, Any] = {kind.value: box}
            views = replace(views, kept=views.kept | {kind}, **named)
        return views


class Extras(Struct, frozen=True):
    """What is asked of all blocks of a sheet: its language, and what it shows of drafting errors.

    ``errors`` are ellipses around points, ``sigma`` stands in the tables; None: in that of the
    results of one position alone. ``turn``: it is that of a turn, and the scheme has the
    construction of the extreme positions. ``traces``: there is room for those of the construction
    where nobody asks for them. ``asked`` are the quantities whose graphs are drawn. ``plans``: how
    many positions of a turn have their plans chosen where nobody names them; 0: one of either
    stroke.
    """

    words: Language
    errors: bool = False
    sigma: bool | None = None
    turn: bool = False
    traces: bool = True
    asked: tuple[str, ...] = ()
    plans: int = 0


class Manner(Struct, frozen=True):
    """How a block is drawn on a certain sheet: what the file asks for, and the format's sizes.

    ``level`` counts the letter heights that did not fit; ``inside`` is the width inside the frame,
    mm.
    """

    entry: Entry
    sizes: Sizes
    inside: float
    extras: Extras
    level: int = 0

    def larger(self, *, below: float) -> Manner:
        """Return it with the next larger letters, where there are any below a height, mm."""
        heights, now = self.entry.heights, self.text(0.0)
        levels = [k for k in range(len(heights)) if now < heights[k] < below]
        return replace(self, level=max(levels)) if levels else self

    @property
    def words(self) -> Language:
        """Language of the sheet."""
        return self.extras.words

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
        """Return the height of a text, mm; ``usual`` where the file asks for none."""
        heights = self.entry.heights
        return heights[min(self.level, len(heights) - 1)] if heights else usual

    def width(self, usual: float) -> float:
        """Return the width to set to, mm; ``usual`` where the file asks for none."""
        asked = self.entry.width
        if asked is None:
            return usual
        return asked if asked > 1.0 else asked * self.inside
