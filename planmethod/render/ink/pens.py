"""Pens of a sheet (линии чертежа, GOST 2.303): width, dashes, colour by the meaning of a line.

Widths are fractions of s, the width of a solid main line, which follows from the format. This table
is the only place that has them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from enum import Enum
from functools import wraps
from types import MappingProxyType
from typing import Any, Concatenate, Literal, ParamSpec, Protocol, TypeVar

from msgspec import Struct

from planmethod.paper import Format


class Pen(Enum):
    """Meaning of a line (назначение линии)."""

    MAIN = "main"  # links, curves, table outline
    RESULTANT = "resultant"  # vectors from a pole, forces
    RELATIVE = "relative"  # vectors between two ends of others
    FINE_RESULTANT = "fine resultant"  # the same on one of many plans, which are small
    FINE_RELATIVE = "fine relative"
    COMPONENT = "component"  # normal, tangential and Coriolis components
    THIN = "thin"  # construction, dimensions, table lines
    LETTER = "letter"  # bars and underlines of letters, thin lines of the title block
    FRAME = "frame"  # frame and title block
    AXIS = "axis"  # dash-dot: axes, guide lines
    HIDDEN = "hidden"  # dashed
    THICK_AXIS = "thick axis"  # thick dash-dot: surfaces that are treated
    PHANTOM = "phantom"  # dash-dot with two dots: a link in another position
    HATCH = "hatch"  # hatching of the frame
    BREAK = "break"  # wavy or kinked: where a link is broken off
    PALE = "pale"  # other positions of the mechanism


class Dashes(Struct, frozen=True):
    """Dash pattern: stroke, gap, and for a dash-dot line the dots evenly in the gap.

    ``stroke`` is the length aimed at; the strokes of one line are equal, stretched or shrunk (to
    ``min_stroke`` at most) so that the line starts and ends with a stroke. ``gap`` is the whole gap
    between two strokes, ``dot`` the length of the short strokes inside it, ``dots`` their number.
    """

    stroke: float
    min_stroke: float
    gap: float
    dot: float = 0.0
    dots: int = 1

    @property
    def inside(self) -> tuple[tuple[float, float], ...]:
        """Start and end of each dot from the end of the stroke before it, mm."""
        if not self.dot:
            return ()
        white = (self.gap - self.dots * self.dot) / (self.dots + 1)
        starts = [white + k * (white + self.dot) for k in range(self.dots)]
        return tuple((start, start + self.dot) for start in starts)

    @property
    def period(self) -> tuple[float, ...]:
        """Lengths of one period, mm: strokes and dots positive, whites negative."""
        parts, reached = [self.stroke], 0.0
        for start, end in self.inside:
            parts += [reached - start, end - start]
            reached = end
        return (*parts, reached - self.gap)


class PenStyle(Struct, frozen=True):
    """Style of a pen.

    ``width_fraction`` is its width as a fraction of s. ``colour`` is that of a sheet in colour;
    ``grey``, from 0 (black) to 1 (white), that of every other sheet.
    """

    width_fraction: float
    dashes: Dashes | None = None
    grey: float = 0.0
    cap: Literal["round", "butt"] = "round"
    colour: str = "#000000"


# Colours of a sheet for the screen. Their contrast on white is at least 4.5, as WCAG 2.1 wants.
_BLUE, _RED, _GREEN, _GREY = "#0b4fb3", "#c01616", "#0b7a3b", "#6b6b6b"

_THIRD = 1 / 3  # GOST 2.303: thin lines are s/3..s/2
_LEAST_WIDTH = 0.25  # mm: a thinner line is lost in print

PENS: Mapping[Pen, PenStyle] = MappingProxyType(
    {
        Pen.MAIN: PenStyle(1.0),
        # Weaker than the links, so that a small plan is not clogged.
        Pen.RESULTANT: PenStyle(0.7, colour=_BLUE),
        Pen.RELATIVE: PenStyle(0.7, colour=_RED),
        Pen.FINE_RESULTANT: PenStyle(0.5, colour=_BLUE),
        Pen.FINE_RELATIVE: PenStyle(0.5, colour=_RED),
        Pen.COMPONENT: PenStyle(0.5, colour=_GREEN),
        Pen.THIN: PenStyle(_THIRD, colour=_GREY),
        Pen.LETTER: PenStyle(_THIRD),
        # GOST 2.301, 2.104: frame and outline of the title block are solid main lines.
        Pen.FRAME: PenStyle(1.0, cap="butt"),
        # GOST 2.303, dash-dot thin: strokes 5..30, 3..5 between them [mem].
        Pen.AXIS: PenStyle(
            _THIRD, Dashes(stroke=12.0, min_stroke=5.0, gap=4.0, dot=1.0), cap="butt"
        ),
        # GOST 2.303, dash-dot thick: width s/2..2s/3, strokes 3..8, 3..4 between them [mem].
        Pen.THICK_AXIS: PenStyle(
            0.6, Dashes(stroke=5.5, min_stroke=3.0, gap=3.5, dot=1.0), cap="butt"
        ),
        # GOST 2.303, dash-dot with two dots: strokes 5..30, 4..6 between them [mem].
        Pen.PHANTOM: PenStyle(
            _THIRD, Dashes(stroke=12.0, min_stroke=5.0, gap=5.0, dot=1.0, dots=2), cap="butt"
        ),
        # GOST 2.303, dashed: width s/3..s/2, strokes 2..8, gaps 1..2 [mem].
        Pen.HIDDEN: PenStyle(_THIRD, Dashes(stroke=4.0, min_stroke=2.0, gap=1.5), cap="butt"),
        # GOST 2.303: hatching is a solid thin line.
        Pen.HATCH: PenStyle(_THIRD, cap="butt"),
        # GOST 2.303: a break is a thin line by hand; its waves are drawn, not dashed.
        Pen.BREAK: PenStyle(_THIRD),
        # The standard knows no grey: thin lines set back so that the main position is prominent.
        Pen.PALE: PenStyle(_THIRD, grey=0.5, colour=_GREY),
    }
)

# GOST 2.303: s is 0.5..1.4 mm, the larger the paper, the wider.
_MAIN_WIDTHS: Mapping[str, float] = MappingProxyType(
    {"A4": 0.6, "A3": 0.8, "A2": 0.8, "A1": 1.0, "A0": 1.0}
)

_HEAD = 8.0  # length of the head of a vector, in widths of its line
HEAD_FRACTION = 1 / 3
"""Part of a vector that its head takes at most."""

_MARK = 4.0  # length of the head of a dimension, an axis or a sense, in s
_LEAST_MARK = 2.5  # mm: GOST 2.307


class PenSet(Struct, frozen=True):
    """Pens of one sheet (комплект перьев).

    Attributes
    ----------
    s : float
        Width of a solid main line, mm.
    is_coloured : bool
        Lines have the colours of their meanings; otherwise they are black.
    """

    s: float = 0.8
    is_coloured: bool = False

    @classmethod
    def of(cls, paper: Format, *, is_coloured: bool = False) -> PenSet:
        """Return the pens of a format; an elongated one has those of the basic one as high."""
        return cls(_MAIN_WIDTHS[paper.like], is_coloured)

    def width(self, pen: Pen) -> float:
        """Return the width of a pen, mm."""
        return max(_LEAST_WIDTH, round(PENS[pen].width_fraction * self.s, 2))

    def colour(self, pen: Pen) -> tuple[int, int, int]:
        """Return the colour of a pen: red, green, blue from 0 to 255."""
        style = PENS[pen]
        if self.is_coloured:
            red, green, blue = bytes.fromhex(style.colour[1:])
            return red, green, blue
        return (round(255 * style.grey),) * 3

    def head(self, pen: Pen, span: float = float("inf")) -> float:
        """Return the length of the head of a vector of ``span`` mm: a third of it at most."""
        return min(_HEAD * self.width(pen), HEAD_FRACTION * span)

    @property
    def mark(self) -> float:
        """Length of the arrowhead of a dimension, an axis or a sense of rotation, mm."""
        return max(_LEAST_MARK, _MARK * self.s)


class ArrowStyle(Struct, frozen=True):
    """Swept arrowhead: its width, and the depth of the cut in its back, as shares of its length.

    There is one shape.
    """

    width: float
    notch: float


# GOST 2.307: sides at about 20°.
ARROW = ArrowStyle(width=0.38, notch=0.2)

_IN_USE: ContextVar[PenSet] = ContextVar("pens", default=PenSet())  # noqa: B039 - it is frozen


def pens_in_use() -> PenSet:
    """Return the pens that symbols are drawn with."""
    return _IN_USE.get()


@contextmanager
def using_pens(pens: PenSet) -> Iterator[PenSet]:
    """Draw with other pens inside the ``with`` block."""
    token = _IN_USE.set(pens)
    try:
        yield pens
    finally:
        _IN_USE.reset(token)


class _Remembering(Protocol):
    def compute_once(self, function: Callable[..., Any], *arguments: Any, **named: Any) -> Any: ...


_Memory = TypeVar("_Memory", bound=_Remembering)
_Arguments = ParamSpec("_Arguments")
_Picture = TypeVar("_Picture")


def drawn_once(
    function: Callable[Concatenate[_Memory, _Arguments], _Picture],
) -> Callable[Concatenate[_Memory, _Arguments], _Picture]:
    """Memoize a picture on its first argument, for the lifetime of that object, with its pens."""

    def draw(of: _Memory, _: PenSet, *arguments: Any, **named: Any) -> _Picture:
        return function(of, *arguments, **named)

    @wraps(function)
    def remember(
        of: _Memory, /, *arguments: _Arguments.args, **named: _Arguments.kwargs
    ) -> _Picture:
        made: _Picture = of.compute_once(draw, pens_in_use(), *arguments, **named)
        return made

    return remember
