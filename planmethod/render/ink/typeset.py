"""Typesetting of rich text to runs of letters, and the extent of items on the paper."""

from __future__ import annotations

import cmath
import re
from collections.abc import Iterable, Sequence
from functools import lru_cache
from math import ceil, radians
from typing import Any, Literal, TypeAlias, assert_never

from msgspec import Struct
from msgspec.structs import replace

from planmethod.note.formula import (
    Fraction,
    Index,
    Letters,
    Node,
    Overline,
    Root,
    inline,
    inlined,
    parse,
)
from planmethod.render.ink.drawing import (
    HEIGHTS,
    Arc,
    Bounds,
    Disc,
    Fill,
    Item,
    Pen,
    Stroke,
    Text,
    sweep,
)
from planmethod.render.ink.lettering import OutlineLettering, in_use, lettering_of

SMALLEST = 2.5
"""Smallest height of a run that is not an index, mm."""

PART_OF = "part-of:"
"""Tag prefix of a line that belongs to an inscription: ``part-of:<label>``."""

Anchor: TypeAlias = Literal["left", "centre", "right"]

_LINE = r"(?<![^\W\d_])([a-z])-\1(?![^\W\d_])"  # x-x in files, x–x on paper
_SUB_DROP = 0.3  # of h: how far an index below sinks under the base line
_SUP_RISE = 0.5  # of h: how far the base line of an index above rises
_STACK_GAP = 0.16  # of h: white between two stacked indices
_AFTER_INDEX = 0.15  # of h: white between an index and a multiplication dot or letter after it
_BAR_INSET = 0.1  # of h: white between an overbar and an index that follows
_BAR_GAP = 0.16  # of h: white between the letter and its overbar
_QUOTIENT_GAP = 0.28  # of h: white between the line of a fraction and its parts
_OVERHANG = 0.2  # of h: the line of a fraction beyond its wider part
_AXIS = 0.4  # of h: level of the line of a fraction, that of the sign of equality
_ROOT_LEAD = 0.75  # of h: width of the sign of a root before the line above
_PAIRS = {"(": ")", "[": "]"}
_TALL = 0.45  # of h: width of a bracket as high as a fraction


class Run(Struct, frozen=True):
    """Letters of one height, placed from the start of the inscription, mm."""

    x: float
    y: float
    text: str
    height: float


class Inscription(Struct, frozen=True):
    """Typeset line (надпись): its parts and its extent.

    Attributes
    ----------
    markup : str
    height : float, mm
        Cap height of the main letters.
    width, ascent, descent : float, mm
        Ink room to the right of the origin, above and below the base line (descent positive).
    runs : tuple of Run
    bars : tuple of tuple of complex, mm
        Overbars, lines of fractions, signs of roots and tall brackets, point by point.
    """

    markup: str
    height: float
    width: float
    ascent: float
    descent: float
    runs: tuple[Run, ...]
    bars: tuple[tuple[complex, ...], ...] = ()

    def shifted_by(self, right: float) -> Inscription:
        """Return the inscription shifted to the right, mm; the white is part of its width."""
        runs = tuple(replace(run, x=run.x + right) for run in self.runs)
        bars = tuple(tuple(point + right for point in bar) for bar in self.bars)
        return replace(self, width=self.width + right, runs=runs, bars=bars)

    def at(
        self,
        point: complex,
        *,
        anchor: Anchor = "left",
        angle: float = 0.0,
        label: str = "",
        box: Bounds | None = None,
        tag: str = "",
    ) -> list[Item]:
        """Return the items of the inscription with its base line starting at a point.

        Parameters
        ----------
        point : complex, mm
            Left end of the base line; its middle or right end by ``anchor``.
        angle : float, degrees
            Turn about ``point``, counter-clockwise.
        label : str
            Name that joins the runs for the lint. Default: made of markup and place.
        box : Bounds, optional
            Cell that the text must stay in.
        """
        name = label or f"{self.markup}@{point.real:.2f},{point.imag:.2f}"
        turn = cmath.exp(1j * radians(angle)) if angle else 1 + 0j
        start = {"left": 0.0, "centre": -self.width / 2, "right": -self.width}[anchor]
        items: list[Item] = [
            Text(
                at=point + (start + run.x + 1j * run.y) * turn,
                text=run.text,
                height=run.height,
                angle=angle,
                label=name,
                box=box,
                tag=tag,
            )
            for run in self.runs
        ]
        for bar in self.bars:
            points = tuple(point + (start + end) * turn for end in bar)
            items.append(Stroke(points, Pen.LETTER, tag=PART_OF + name))
        return items

    def ink(self, point: complex) -> Bounds:
        """Return the ink box of the inscription with its base line starting at ``point``, mm."""
        return (
            point.real,
            point.imag - self.descent,
            point.real + self.width,
            point.imag + self.ascent,
        )


def index_height(height: float) -> float:
    """Return the height of the indices of letters (высота индекса), mm.

    The next smaller GOST height, which is about 0.7 of the main one: 2.5 for letters of 3.5, and
    1.8, the smallest the standard has, for letters of 2.5.
    """
    fitting = [size for size in HEIGHTS if size <= 0.73 * height]
    return max(fitting, default=HEIGHTS[0])


def smaller_heights(height: float) -> tuple[float, ...]:
    """Return ``height`` and the smaller GOST heights down to 2.5 mm, largest first."""
    below = sorted((size for size in HEIGHTS if SMALLEST <= size < height), reverse=True)
    return (height, *below)


def line_step(height: float) -> float:
    """Return the step of base lines of consecutive lines, mm (GOST 2.304)."""
    return in_use().line_step * height


def vector_markup(symbol: str) -> str:
    r"""Return the markup of a vector: the letter before the indices gets an overbar.

    >>> vector_markup("a^{n}_{CB}")
    '\\bar{a}^{n}_{CB}'
    """
    if symbol.startswith("\\bar"):
        return symbol
    cut = next((i for i, sign in enumerate(symbol) if sign in "_^"), len(symbol))
    return f"\\bar{{{symbol[:cut]}}}{symbol[cut:]}"


def split_words(markup: str, *, built: bool = False) -> list[str]:
    """Split markup at spaces that are not inside braces nor unbreakable (U+00A0).

    Fractions are in one line (``a/b``) unless ``built``.
    """
    words: list[str] = []
    markup = markup if built else inlined(markup)
    word, depth, escaped = "", 0, False
    for sign in markup:
        if sign.isspace() and depth == 0 and not escaped and sign != "\u00a0":
            if word:
                words.append(word)
            word = ""
            continue
        if not escaped:
            depth += (sign == "{") - (sign == "}")
        escaped = sign == "\\" and not escaped
        word += sign
    return [*words, word] if word else words


def typeset(markup: str, height: float, *, built: bool = False) -> Inscription:
    r"""Set one line of rich text (набор строки).

    Parameters
    ----------
    markup : str
        Rich text.
    height : float, mm
        Cap height of the main letters.
    built : bool
        Whether fractions get a line between their parts, and roots one above them. Otherwise they
        are in one line, ``a/b`` and ``√(a)``.

    Returns
    -------
    Inscription

    Raises
    ------
    LayoutError
        If braces do not pair, an index is empty, or a command is unknown.
    """
    # Cached by height: 5 and 5.0 are one key, and the cached line has the height of the first.
    return _typeset(markup if built else inlined(markup), float(height), in_use())


@lru_cache(maxsize=4096)
def _typeset(markup: str, height: float, lettering: OutlineLettering) -> Inscription:
    written = re.sub(_LINE, r"\1–\1", markup) if "-" in markup else markup
    nodes = parse(written)
    setter = _Setter(lettering)
    end_x = setter.set(nodes, 0.0, 0.0, height)
    # Slanted letters lean beyond their advance along the line.
    inks = [(run.x, lettering.ink(run.text, run.height)) for run in setter.runs]
    left = min([0.0, *(x + ink[0] for x, ink in inks)])
    right = max([end_x, *(x + ink[2] for x, ink in inks)])
    line = Inscription(
        markup,
        height,
        right,
        setter.ascent,
        setter.descent,
        tuple(setter.runs),
        tuple(setter.bars),
    )
    return line.shifted_by(-left) if left else line


def text_bounds(text: Text) -> Bounds:
    """Return the least upright box about the ink of a run, mm; about its turned box if turned."""
    left, low, right, high = _lettering_of(text).ink(text.text, text.height)
    turn = cmath.exp(1j * radians(text.angle))
    corners = [text.at + turn * complex(x, y) for x in (left, right) for y in (low, high)]
    xs, ys = [corner.real for corner in corners], [corner.imag for corner in corners]
    return (min(xs), min(ys), max(xs), max(ys))


def text_corners(text: Text) -> list[complex]:
    """Return the corners of the ink box of a run, mm, turned as the text and leaning."""
    at = text.at
    return [
        at + corner for corner in _corners(text.text, text.height, text.angle, _lettering_of(text))
    ]


def _lettering_of(text: Text) -> OutlineLettering:
    return lettering_of(text.lettering, in_use())


@lru_cache(maxsize=8192)  # the same letters recur at many places
def _corners(
    text: str, height: float, angle: float, lettering: OutlineLettering
) -> tuple[complex, ...]:
    wide = lettering.width(text, height)
    side = min(lettering.side * height, wide / 2)
    up, down = lettering.ascent(text, height), lettering.descent(text, height)
    turn = cmath.exp(1j * radians(angle))
    corners = (side - 1j * down, wide - side - 1j * down, wide - side + 1j * up, side + 1j * up)
    return tuple(turn * (corner + lettering.leaning(corner.imag, height)) for corner in corners)


class _Bracketed(Struct, frozen=True):
    """What is between brackets that must be as high as a fraction in it (высокие скобки)."""

    sign: str
    body: tuple[Node, ...]


def _bracketed(nodes: Sequence[Node]) -> Sequence[Node | _Bracketed]:
    """Return nodes with each pair of brackets about a fraction as one."""
    if not any(isinstance(node, Fraction) for node in nodes):
        return nodes
    levels: list[tuple[str, list[Any]]] = [("", [])]
    for node in nodes:
        pieces = re.split(r"([()\[\]])", node.text) if isinstance(node, Letters) else [node]
        for piece in pieces:
            if piece in ("(", "["):
                levels.append((piece, []))
            elif piece in (")", "]") and _PAIRS.get(levels[-1][0]) == piece:
                sign, body = levels.pop()
                is_tall = any(isinstance(one, Fraction | _Bracketed) for one in body)
                flat = [Letters(sign), *body, Letters(piece)]
                levels[-1][1].extend([_Bracketed(sign, _joined(body))] if is_tall else flat)
            elif piece:
                levels[-1][1].append(Letters(piece) if isinstance(piece, str) else piece)
    found = levels[0][1]
    for sign, body in levels[1:]:  # brackets that do not pair
        found += [Letters(sign), *body]
    return _joined(found)


def _joined(nodes: Iterable[Node | _Bracketed]) -> tuple[Any, ...]:
    """Return nodes with the letters that follow one another as one run."""
    found: list[Node | _Bracketed] = []
    for node in nodes:
        if isinstance(node, Letters) and found and isinstance(last := found[-1], Letters):
            found[-1] = Letters(last.text + node.text)
        else:
            found.append(node)
    return tuple(found)


class _Setter:
    """Collect runs and bars from left to right, and their extent."""

    def __init__(self, lettering: OutlineLettering, *, flat: bool = False) -> None:
        self.lettering = lettering
        self.runs: list[Run] = []
        self.bars: list[tuple[complex, ...]] = []
        self.ascent = 0.0
        self.descent = 0.0
        self.flat = flat
        """Whether fractions are in one line: those inside another one."""

    def set(self, nodes: Sequence[Node], x: float, y: float, height: float) -> float:
        """Set the nodes from (x, y) on and return the x where they end."""
        before: Node | _Bracketed | None = None
        for node in inline(nodes) if self.flat else _bracketed(nodes):
            match node:
                case _Bracketed(sign, body):
                    x = self._tall(sign, body, x, y, height)
                case Letters(text):
                    if isinstance(before, Index) and (text[0] == "·" or text[0].isalpha()):
                        x += _AFTER_INDEX * height
                    x = self._letters(text, x, y, height)
                case Overline(body):
                    x += _AFTER_INDEX * height if isinstance(before, Index) else 0.0
                    x = self._bar(body, x, y, height)
                case Index(below, above):
                    x = self._index(below, above, x, y, height)
                case Fraction(above, below):
                    x = self._fraction(above, below, x, y, height)
                case Root(body):
                    x = self._root(body, x, y, height)
                case _:
                    assert_never(node)
            before = node
        return x

    def _inner(
        self, nodes: Sequence[Node], height: float, *, flat: bool = False
    ) -> tuple[_Setter, float]:
        """Return nodes that are set by themselves, and their width."""
        inner = _Setter(self.lettering, flat=flat or self.flat)
        return inner, inner.set(nodes, 0.0, 0.0, height)

    def _place(self, inner: _Setter, x: float, y: float) -> None:
        """Place what was set by itself."""
        self.runs += [replace(run, x=run.x + x, y=run.y + y) for run in inner.runs]
        self.bars += [tuple(point + complex(x, y) for point in bar) for bar in inner.bars]
        self._reach(y + inner.ascent, y - inner.descent)

    def _reach(self, high: float, low: float) -> None:
        self.ascent, self.descent = max(self.ascent, high), max(self.descent, -low)

    def _letters(self, text: str, x: float, y: float, height: float) -> float:
        text = text.replace("\u00a0", " ")  # it has done its work when lines were broken
        self.runs.append(Run(x, y, text, height))
        up, down = self.lettering.ascent(text, height), self.lettering.descent(text, height)
        self._reach(y + up, y - down)
        return x + self.lettering.width(text, height)

    def _bar(self, body: Sequence[Node], x: float, y: float, height: float) -> float:
        inner, width = self._inner(body, height)
        self._place(inner, x, y)
        level = y + inner.ascent + _BAR_GAP * height
        white = _BAR_INSET * height if width > 4 * _BAR_INSET * height else 0.0
        self.bars.append((complex(x + white / 2, level), complex(x + width - white, level)))
        self._reach(level, y)
        return x + width

    def _fraction(
        self, above: Sequence[Node], below: Sequence[Node], x: float, y: float, height: float
    ) -> float:
        """Set the parts of a fraction above and below its line, which is as wide as the wider."""
        (top, over), (low, under) = (self._inner(one, height, flat=True) for one in (above, below))
        axis, gap = y + _AXIS * height, _QUOTIENT_GAP * height
        width = max(over, under) + 2 * _OVERHANG * height
        self._place(top, x + (width - over) / 2, axis + gap + top.descent)
        self._place(low, x + (width - under) / 2, axis - gap - low.ascent)
        self.bars.append((complex(x, axis), complex(x + width, axis)))
        return x + width

    def _root(self, body: Sequence[Node], x: float, y: float, height: float) -> float:
        """Set a root: its sign, and the line above the body."""
        inner, width = self._inner(body, height)
        lead, level = _ROOT_LEAD * height, inner.ascent + _BAR_GAP * height
        self._place(inner, x + lead, y)
        tick, foot = 0.45 * height, -max(inner.descent, 0.1 * height)
        sign = (0.05 * height + 1j * tick, 0.25 * height + 1j * (tick + 0.1 * height),
                0.4 * height + 1j * foot, lead + 1j * level, lead + width + 1j * level)  # fmt: skip
        self.bars.append(tuple(point + complex(x, y) for point in sign))
        self._reach(y + level, y + foot)
        return x + lead + width + _BAR_INSET * height

    def _tall(self, sign: str, body: Sequence[Node], x: float, y: float, height: float) -> float:
        """Set a body between brackets of its height."""
        inner, width = self._inner(body, height)
        room, axis = _TALL * height, y + _AXIS * height
        self._place(inner, x + room, y)
        half = max(inner.ascent - axis + y, inner.descent + axis - y)
        # An arc of a round bracket, three sides of a square one.
        turns = [radians(angle) for angle in range(-90, 91, 15)]
        shape = [cmath.rect(1.0, turn) for turn in turns]
        if sign == "[":
            shape = [-1j, 1.0 - 1j, 1.0 + 1j, 1j]
        for end, way in ((x + 0.8 * room, -1.0), (x + 1.2 * room + width, 1.0)):
            wide = way * 0.6 * room
            self.bars.append(
                tuple(complex(end + wide * p.real, axis + half * p.imag) for p in shape)
            )
        self._reach(axis + half, axis - half)
        return x + width + 2 * room

    def _index(
        self,
        below: Sequence[Node],
        above: Sequence[Node],
        x: float,
        y: float,
        height: float,
    ) -> float:
        small = index_height(height)
        (low, under), (high, over) = self._inner(below, small), self._inner(above, small)
        drop, rise = y - _SUB_DROP * height, y + _SUP_RISE * height
        if below and above:
            rise = max(rise, drop + low.ascent + _STACK_GAP * height + high.descent)
        self._place(low, x, drop)
        self._place(high, x, rise)
        return x + max(under, over)


def arc_points(arc: Arc, *, step: float = 0.25) -> list[complex]:
    """Return points along an arc, ``step`` radians apart at most."""
    turn = sweep(arc)
    count = max(2, ceil(turn / step))
    angles = (arc.start + turn * k / count for k in range(count + 1))
    return [arc.centre + cmath.rect(arc.radius, angle) for angle in angles]


def ink_bounds(items: Iterable[Item]) -> Bounds:
    """Return the box around items, mm; a point at the origin when there are none."""
    points: list[complex] = []
    for item in items:
        match item:
            case Stroke(points=path) | Fill(points=path):
                points += path
            case Arc():
                points += arc_points(item)
            case Disc(centre=centre, radius=radius):
                points += [centre - radius * (1 + 1j), centre + radius * (1 + 1j)]
            case Text():
                points += text_corners(item)
    if not points:
        return 0.0, 0.0, 0.0, 0.0
    xs, ys = [p.real for p in points], [p.imag for p in points]
    return min(xs), min(ys), max(xs), max(ys)


def overlap(one: Bounds, two: Bounds, gap: float = 0.0) -> bool:
    """Return whether two boxes are nearer than ``gap`` mm, or overlap."""
    across = one[0] < two[2] + gap - 1e-6 and two[0] < one[2] + gap - 1e-6
    return across and one[1] < two[3] + gap - 1e-6 and two[1] < one[3] + gap - 1e-6
