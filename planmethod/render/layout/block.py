"""Blocks (блоки листа): objects that know their size and draw themselves at a given place.

Every block is placed by its **upper left** corner, since a sheet is filled from the top down.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from functools import cached_property
from typing import Literal, Protocol, TypeAlias

from msgspec import Struct

from planmethod.note.formula import escape
from planmethod.render.ink.drawing import Bounds, Item, shifted
from planmethod.render.ink.typeset import (
    Inscription,
    ink_bounds,
    line_step,
    overlap,
    smaller_heights,
    split_words,
    typeset,
)

# Parts that stay whole when a word is broken: an escaped sign, a letter with its indices.
_SIGNS = r"(?:\\bar\{[^{}]*\}|\\.|.)(?:[_^](?:\{[^{}]*\}|.))*"

# Letters of a unit are few, or there is a sign between them.
_UNIT = r"[^\W\d_]{1,3}(?![^\W\d_])|[^\W\d_]+[·/]"

Align: TypeAlias = Literal["left", "centre", "right"]

CUT = "cut"
"""Word in the tag of a text that was shortened to fit its cell; the lint reports it."""


CLEARANCE = 4.0
"""Least white between drawn items and a graph within the frame (свободное поле), mm."""


class DrawingArea(Struct, frozen=True):
    """Area of a sheet available for the drawing (поле чертежа), mm.

    Attributes
    ----------
    inner : Bounds
        Inside of the frame.
    stamp : Bounds
        Title block, with the graphs above it, in the lower right corner of the inside.
    reserved : tuple of Bounds
        Other occupied boxes of the inside: graph 26 and those beside it.
    """

    inner: Bounds
    stamp: Bounds
    reserved: tuple[Bounds, ...] = ()

    def is_clear(self, items: Iterable[Item]) -> bool:
        """Return whether no item comes near a graph; items are compared by their boxes."""
        boxes = [ink_bounds([item]) for item in items] if self.reserved else []
        return not any(overlap(box, graph, CLEARANCE) for box in boxes for graph in self.reserved)


class Block(Protocol):
    """Protocol of the parts of a sheet for its layout (блок)."""

    @property
    def width(self) -> float:
        """Width, mm."""
        ...

    @property
    def height(self) -> float:
        """Height, mm."""
        ...

    def place(self, corner: complex) -> list[Item]:
        """Return the items of the block with its upper left corner at ``corner``, mm."""
        ...


class Alternatives(Struct, frozen=True):
    """A block with several layouts (варианты блока); by itself it is the first one.

    ``grows``: a larger layout has a larger scale, and is not only looser.
    """

    blocks: tuple[Block, ...]
    grows: bool = False

    @property
    def width(self) -> float:
        """Width, mm."""
        return self.blocks[0].width

    @property
    def height(self) -> float:
        """Height, mm."""
        return self.blocks[0].height

    def place(self, corner: complex) -> list[Item]:
        """Return the items of the first layout."""
        return self.blocks[0].place(corner)


def make_alternatives(blocks: Iterable[Block], *, grows: bool = False) -> Block:
    """Return a block with several layouts, or the only layout."""
    found = tuple(blocks)
    return Alternatives(found, grows) if len(found) > 1 else found[0]


class Spacer(Struct, frozen=True):
    """Empty room, mm (промежуток)."""

    width: float
    height: float

    def place(self, corner: complex) -> list[Item]:
        """Return nothing: a spacer has no ink."""
        return []


class Picture(Struct, frozen=True):
    """Ready items in their own coordinates; ``bounds`` is their extent, mm."""

    items: tuple[Item, ...]
    bounds: Bounds

    @property
    def width(self) -> float:
        """Width of the bounds, mm."""
        return self.bounds[2] - self.bounds[0]

    @property
    def height(self) -> float:
        """Height of the bounds, mm."""
        return self.bounds[3] - self.bounds[1]

    def place(self, corner: complex) -> list[Item]:
        """Return the items moved so that the bounds' upper left corner is at ``corner``."""
        return list(shifted(self.items, corner - complex(self.bounds[0], self.bounds[3])))


class Line(Struct, frozen=True):
    """One typeset line (строка); the block's box is its ink box."""

    inscription: Inscription

    @property
    def width(self) -> float:
        """Ink width, mm."""
        return self.inscription.width

    @property
    def height(self) -> float:
        """Ink height, mm."""
        return self.inscription.ascent + self.inscription.descent

    def place(self, corner: complex) -> list[Item]:
        """Return the letters."""
        return list(self.inscription.at(corner - 1j * self.inscription.ascent))


class Lines(Struct, frozen=True):
    """Typeset lines under one another with the line step of GOST 2.304 (абзац)."""

    inscriptions: tuple[Inscription, ...]
    step: float
    align: Align = "left"

    @property
    def width(self) -> float:
        """Width of the longest line, mm."""
        return max((line.width for line in self.inscriptions), default=0.0)

    @property
    def height(self) -> float:
        """Height from the top of the first line's ink to the bottom of the last one's, mm."""
        if not self.inscriptions:
            return 0.0
        first, last = self.inscriptions[0], self.inscriptions[-1]
        return first.ascent + sum(self.steps()) + last.descent

    def steps(self) -> list[float]:
        """Return the steps of base lines: wider where indices or bars would come too close."""
        pairs = zip(self.inscriptions, self.inscriptions[1:], strict=False)
        return [
            max(self.step, above.descent + below.ascent + 0.2 * below.height)
            for above, below in pairs
        ]

    def place(self, corner: complex) -> list[Item]:
        """Return the letters of all lines."""
        items: list[Item] = []
        if not self.inscriptions:
            return items
        base, steps = corner.imag - self.inscriptions[0].ascent, [*self.steps(), 0.0]
        for k, line in enumerate(self.inscriptions):
            spare = self.width - line.width
            shift = {"left": 0.0, "centre": spare / 2, "right": spare}[self.align]
            items += line.at(complex(corner.real + shift, base))
            base -= steps[k]
        return items


class Column(Struct, frozen=True, dict=True):
    """Blocks from the top down (столбец)."""

    blocks: Sequence[Block]
    gap: float = 5.0
    align: Align = "left"

    @cached_property
    def width(self) -> float:
        """Width, mm."""
        return max((b.width for b in self.blocks), default=0.0)

    @cached_property
    def height(self) -> float:
        """Height, mm."""
        return sum(b.height for b in self.blocks) + self.gap * max(0, len(self.blocks) - 1)

    def place(self, corner: complex) -> list[Item]:
        """Return the items of all blocks."""
        items: list[Item] = []
        for block in self.blocks:
            spare = self.width - block.width
            shift = {"left": 0.0, "centre": spare / 2, "right": spare}[self.align]
            items += block.place(corner + shift)
            corner -= 1j * (block.height + self.gap)
        return items


class Row(Struct, frozen=True, dict=True):
    """Blocks from left to right (ряд)."""

    blocks: Sequence[Block]
    gap: float = 5.0
    align: Literal["top", "centre", "bottom"] = "top"

    @cached_property
    def width(self) -> float:
        """Width, mm."""
        return sum(b.width for b in self.blocks) + self.gap * max(0, len(self.blocks) - 1)

    @cached_property
    def height(self) -> float:
        """Height, mm."""
        return max((b.height for b in self.blocks), default=0.0)

    def place(self, corner: complex) -> list[Item]:
        """Return the items of all blocks."""
        items: list[Item] = []
        for block in self.blocks:
            spare = self.height - block.height
            drop = {"top": 0.0, "centre": spare / 2, "bottom": spare}[self.align]
            items += block.place(corner - 1j * drop)
            corner += block.width + self.gap
        return items


def heading(markup: str, height: float = 5.0, *, width: float | None = None) -> Block:
    """Return the name of a view or of a list (заголовок), shrunk or wrapped to ``width`` mm.

    GOST 2.316 underlines no headings.
    """
    for size in smaller_heights(height)[:2]:
        line = typeset(markup, size)
        if width is None or line.width <= width:
            return Line(line)
    return paragraph(markup, height, width, align="centre")


TITLE_WIDTH = 14.0
"""Width of the lines of a wrapped title over a small picture, in heights of its letters."""


def titled(
    picture: Block,
    title: str,
    notes: Iterable[str | Block],
    heights: tuple[float, float],
    *,
    is_wrapped: bool = False,
) -> Column:
    """Return a picture under its name (GOST 2.316) and notes, which wrap to the wider of both.

    All begin at one left edge, that of the column of the sheet. ``heights`` are those of the
    letters of the name and of the notes, mm. A name ``is_wrapped`` to the picture, or over a small
    one to `TITLE_WIDTH`.
    """
    width = max(picture.width, TITLE_WIDTH * heights[0]) if is_wrapped else None
    head = paragraph(title, heights[0], width)
    width = max(head.width, picture.width)
    lines: list[Block] = [head]
    lines += [paragraph(one, heights[1], width) if isinstance(one, str) else one for one in notes]
    return Column([Column(lines, gap=2.5), picture], gap=5.0)


SIGNS = frozenset("+−±≈≥≤><")
"""Signs between two terms or sides of a formula that is broken there."""

_ORPHAN_LENGTH = 12
"""Length of a word, with its markup, below which it is not left alone in a line."""


def paragraph(
    markup: str,
    height: float = 3.5,
    width: float | None = None,
    *,
    align: Align = "left",
) -> Lines:
    r"""Return rich text wrapped at spaces into lines not wider than ``width`` mm (абзац).

    ``\n`` in the markup starts a new line. A word wider than ``width`` gets a line of its own. Both
    sides of an equality, and a number and its unit, are on one line. A line does not begin with a
    dash; a formula is broken after a sign of `SIGNS`, which the next line repeats (GOST 2.105). A
    short word is not left alone in the last line.
    """
    lines: list[str] = []
    for part in markup.split("\n"):
        words = _tied(split_words(part))
        lines += _in_company(wrapped(words, height, width), words, height, width)
    return Lines(tuple(typeset(line, height) for line in lines), line_step(height), align)


def _in_company(
    lines: list[str], words: Sequence[str], height: float, width: float | None
) -> list[str]:
    """Return lines without a single short word in the last, if the line before can spare a word."""
    alone = len(lines) > 1 and lines[-1] == words[-1] and len(words[-1]) < _ORPHAN_LENGTH
    if not alone or lines[-2] == words[-2]:
        return lines
    last = f"{words[-2]} {words[-1]}"
    if width is not None and typeset(last, height).width > width:
        return lines
    return [*lines[:-2], lines[-2].removesuffix(words[-2]).rstrip(), last]


def _tied(words: Sequence[str]) -> list[str]:
    """Return words with the signs after them, both sides of an equality, and units as one."""
    found: list[str] = []
    for before, word in zip(("", *words), words, strict=False):
        is_unit = before[-1:].isdigit() and re.match(_UNIT, word) is not None
        is_sign = word in SIGNS or word in ("–", "—")
        if found and (is_sign or "=" in (before, word) or is_unit):
            found[-1] += f" {word}"
        else:
            found.append(word)
    return found


def wrapped(words: Sequence[str], height: float, width: float | None) -> list[str]:
    """Join words into as few lines as the width allows (переносы по словам).

    A line that ends with a sign of a formula has it again at the beginning of the next.
    """
    lines: list[str] = []
    for word in words:
        longer = f"{lines[-1]} {word}" if lines else word
        fits = width is None or typeset(longer, height).width <= width
        if lines and fits:
            lines[-1] = longer
        else:
            sign = lines[-1].rpartition(" ")[2] if lines else ""
            lines.append(f"{sign} {word}" if sign in SIGNS else word)
    return lines


def fit_text(
    text: str,
    box: Bounds,
    heights: Iterable[float],
    *,
    align: Align = "centre",
    pad: float = 0.8,
    tag: str = "",
    shrink_first: bool = True,
) -> list[Item]:
    r"""Return a text that stays in its cell (вписывание в графу).

    One line at the first or second height if it fits; else lines at the first height that holds
    them in the cell; else long words are broken at the last height, the lines as near as their ink
    allows if need be; else the text is cut with an ellipsis and its tag gets the word `CUT`, which
    the lint reports. The text never leaves the cell, however little of it is left.

    Parameters
    ----------
    text : str
        Plain text; ``\n`` starts a new line.
    box : Bounds, mm
        The cell. Its ``Text`` items carry it as their box.
    heights : iterable of float, mm
        Heights to try, largest first.
    pad : float, mm
        White kept between the text and the sides of the cell.
    shrink_first : bool
        One line of the second height is better than two of the first.
    """
    sizes = tuple(heights)
    room = (box[2] - box[0] - 2 * pad, box[3] - box[1] - 2 * min(pad, 0.4))
    parts = [escape(part) for part in text.split("\n")]
    block, cut = _fitting(parts, room, sizes, align, 2 if shrink_first else 1)
    middle = complex((box[0] + box[2]) / 2, (box[1] + box[3]) / 2)
    sides = {"left": box[0] + pad, "centre": middle.real, "right": box[2] - pad}
    base = middle.imag + _caps(block) / 2 - block.inscriptions[0].height
    told = f"{tag} {CUT}".strip() if cut else tag
    items: list[Item] = []
    for line, step in zip(block.inscriptions, [*block.steps(), 0.0], strict=True):
        items += line.at(complex(sides[align], base), anchor=align, box=box, tag=told)
        base -= step
    return items


def _fitting(
    parts: Sequence[str],
    space: tuple[float, float],
    sizes: Sequence[float],
    align: Align,
    unwrapped: int,
) -> tuple[Lines, bool]:
    """Choose lines and height; return also whether the text had to be cut.

    ``unwrapped`` are the heights tried in one line before words are wrapped.
    """

    def build(lines: Sequence[str], size: float, step: float) -> Lines:
        return Lines(tuple(typeset(s, size) for s in lines or [""]), step, align)

    tries = [(list(parts), size, line_step(size)) for size in sizes[:unwrapped]]
    words = [split_words(part) for part in parts]
    for size in sizes:
        lines = [line for part in words for line in _balanced(part, size, space[0])]
        tries.append((lines, size, line_step(size)))
    size = sizes[-1]
    broken: list[str] = []
    for part in words:
        pieces = [piece for word in part for piece in _broken(word, size, space[0])]
        broken += wrapped(pieces, size, space[0])
    # Finally, the lines are set as close as their ink allows: a date in two lines, for example.
    tries += [(broken, size, line_step(size)), (broken, size, 0.0)]
    for lines, height, step in tries:
        block = build(lines, height, step)
        if _block_fits(block, space):
            return block, False
    while len(broken) > 1 and not _block_fits(build(broken, size, 0.0), space):
        broken.pop()
    last = re.findall(_SIGNS, broken[-1]) if broken else []
    while last and typeset("".join(last) + "…", size).width > space[0]:
        last.pop()
    return build([*broken[:-1], "".join(last).rstrip() + "…"], size, 0.0), True


def _caps(block: Lines) -> float:
    """Return the height of lines from the top of the first capitals to the last base line."""
    return block.inscriptions[0].height + sum(block.steps())


def _block_fits(block: Lines, space: tuple[float, float]) -> bool:
    # Text is centred by cap height, so the larger of the overhangs counts twice.
    first, last = block.inscriptions[0], block.inscriptions[-1]
    overhang = max(first.ascent - first.height, last.descent, 0.0)
    return block.width <= space[0] and _caps(block) + 2 * overhang <= space[1] + 1e-9


def _balanced(words: Sequence[str], size: float, width: float) -> list[str]:
    """Wrap into the least number of lines, of nearly equal length."""
    lines = wrapped(words, size, width)
    count = len(lines)
    for tenths in range(40, 100, 3):
        even = wrapped(words, size, width * tenths / 100)
        if len(even) == count and all(typeset(s, size).width <= width for s in even):
            return even
    return lines


def _broken(word: str, size: float, width: float) -> list[str]:
    """Break a word wider than the cell; with a hyphen inside a run of letters."""
    if typeset(word, size).width <= width:
        return [word]
    signs = re.findall(_SIGNS, word)
    pieces: list[str] = []
    while len(signs) > 1 and typeset("".join(signs), size).width > width:
        take = len(signs) - 1
        while take > 1 and typeset(_hyphened(signs, take), size).width > width:
            take -= 1
        # Preferably after a dot or a hyphen of the text itself: 12.03. / 2025.
        stops = [k for k in range(2, take + 1) if signs[k - 1] in ".-/,"]
        take = stops[-1] if stops else take
        pieces.append(_hyphened(signs, take))
        signs = signs[take:]
    return [*pieces, "".join(signs)]


def _hyphened(signs: Sequence[str], count: int) -> str:
    hyphen = "-" if signs[count - 1].isalpha() and signs[count].isalpha() else ""
    return "".join(signs[:count]) + hyphen
