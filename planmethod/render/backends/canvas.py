"""Protocol of an output format: replay of a display list, circles as curves, layers."""

from __future__ import annotations

from cmath import exp, isfinite
from collections.abc import Iterable, Iterator, Mapping
from itertools import pairwise
from math import ceil, tan, tau
from types import MappingProxyType
from typing import Literal, Protocol, TypeAlias, assert_never

from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.render.ink.drawing import Arc, Disc, Drawing, Fill, Item, Pen, Stroke, Text


class Options(Struct, frozen=True, kw_only=True):
    """Wishes that only some formats can grant.

    ``dpi`` is the resolution of a raster picture, dots to the inch; ``author`` goes into the
    properties of the file. ``dxf_text`` chooses text or outlines for the letters of a DXF;
    ``packed``, whether a raster picture is made as small as can be, which takes three times longer.
    """

    dpi: float = 100.0
    author: str = "planmethod"
    dxf_text: Literal["text", "strokes"] = "text"
    packed: bool = True


class Canvas(Protocol):
    """Six verbs of an output format (холст): `open`, drawing in order, `close`.

    A format with pages is opened once more for each further sheet; the others draw one sheet.

    Coordinates are millimetres, y up, origin at the lower left corner of the sheet. A canvas takes
    pens, dashes and letter outlines from `style` and `lettering`.

    Its constructor takes `Options`.
    """

    def open(self, drawing: Drawing) -> None:
        """Begin the sheet of a drawing; its items are drawn by the other verbs."""
        ...

    def stroke(self, item: Stroke) -> None:
        """Draw ``stroke_lines(item)`` with the pen ``PENS[item.pen]``."""
        ...

    def arc(self, item: Arc) -> None:
        """Draw every span of ``arc_spans(item)`` with its pen."""
        ...

    def fill(self, item: Fill | Disc) -> None:
        """Fill a polygon or a circle with ``item.ink``; its outline is not drawn."""
        ...

    def text(self, item: Text) -> None:
        """Draw one run of letters: the outlines of the sheet's lettering, or the same font."""
        ...

    def close(self) -> bytes:
        """Finish the sheet and return the file."""
        ...


def _coordinates(item: Item) -> Iterator[complex]:
    match item:
        case Stroke() | Fill():
            yield from item.points
        case Arc():
            yield from (item.centre, complex(item.radius), complex(item.start, item.end))
        case Disc():
            yield from (item.centre, complex(item.radius))
        case Text():
            yield from (item.at, complex(item.height, item.angle))
        case _:
            assert_never(item)


def _is_invisible(item: Item) -> bool:
    """Return whether an item leaves nothing on the paper; such items are skipped."""
    match item:
        case Stroke():
            return len(item.points) < 2
        case Fill():
            return len(item.points) < 3
        case Arc() | Disc():
            return item.radius <= 0.0
        case Text():
            return not item.text.strip() or item.height <= 0.0
        case _:
            assert_never(item)


def draw_sheet(drawing: Drawing, canvas: Canvas) -> None:
    """Draw the display list on ``canvas`` as its next sheet.

    Raises
    ------
    PlanMethodError
        An item has a coordinate that is not a finite number: the caller did not check that the
        point exists.
    """
    canvas.open(drawing)
    draw(drawing.items, canvas, drawing.title)


def draw(items: Iterable[Item], canvas: Canvas, title: str = "") -> None:
    """Draw items on the open sheet of a canvas; ``title`` is for the message.

    Raises
    ------
    PlanMethodError
        As of `draw_sheet`.
    """
    for number, item in enumerate(items):
        if not all(map(isfinite, _coordinates(item))):
            raise PlanMethodError(
                "Item {} of the drawing '{}' has a coordinate that is not finite: {!r}. Draw "
                "only points that exist.",
                number,
                title,
                item,
            )
        if _is_invisible(item):
            continue
        match item:
            case Stroke():
                canvas.stroke(item)
            case Arc():
                canvas.arc(item)
            case Fill() | Disc():
                canvas.fill(item)
            case Text():
                canvas.text(item)
            case _:
                assert_never(item)


Curve: TypeAlias = tuple[complex, complex, complex, complex]
"""Start, two control points, end."""


def arc_curves(
    centre: complex,
    radius: float,
    start: float = 0.0,
    turn: float = tau,
    *,
    tolerance: float = 1e-3,
) -> list[Curve]:
    """Return cubic curves along an arc, at most ``tolerance`` mm from it.

    Parameters
    ----------
    centre, radius
        The circle, mm.
    start, turn
        Where the arc starts and how far it goes counter-clockwise, radians.
    tolerance
        Largest distance allowed, mm. The curve of a quarter circle leaves the circle by 2.7e-4 of
        the radius; this falls with the sixth power of the angle.
    """
    finer = max(1.0, (2.8e-4 * radius / tolerance) ** (1.0 / 6.0))
    count = max(1, ceil(turn / (tau / 4.0) * finer - 1e-9))
    step = turn / count
    pull = 4.0 / 3.0 * tan(step / 4.0) * 1j
    ends = [radius * exp(1j * (start + k * step)) for k in range(count + 1)]
    return [
        (centre + a, centre + a + pull * a, centre + b - pull * b, centre + b)
        for a, b in pairwise(ends)
    ]


VECTORS, ARROWS, FIGURES = "PLAN_VECTORS", "PLAN_ARROWS", "PLAN_FIGURES"

LAYERS: Mapping[str, Pen] = MappingProxyType(
    {
        "MAIN": Pen.MAIN,
        "THIN": Pen.THIN,
        "FRAME": Pen.FRAME,
        "AXIS": Pen.AXIS,
        "THICK_AXIS": Pen.THICK_AXIS,
        "PHANTOM": Pen.PHANTOM,
        "HIDDEN": Pen.HIDDEN,
        "HATCHING": Pen.HATCH,
        "BREAKS": Pen.BREAK,
        "PALE": Pen.PALE,
        "LINKS": Pen.MAIN,
        "SYMBOLS": Pen.MAIN,
        "MASKS": Pen.THIN,
        VECTORS: Pen.THIN,
        ARROWS: Pen.THIN,
        FIGURES: Pen.THIN,
        "DIAGRAMS": Pen.MAIN,
        "ERRORS": Pen.THIN,
        "TABLES": Pen.THIN,
        "TITLE_BLOCK": Pen.FRAME,
        "TEXT": Pen.THIN,
    }
)
"""Layers, and the pen whose width, dashes and grey they have."""

RELATIVE, COMPONENTS = "PLAN_RELATIVE", "PLAN_COMPONENTS"

COLOURED_LAYERS: Mapping[str, Pen] = MappingProxyType(
    {
        VECTORS: Pen.RESULTANT,
        ARROWS: Pen.RESULTANT,
        RELATIVE: Pen.RELATIVE,
        f"{RELATIVE}_ARROWS": Pen.RELATIVE,
        COMPONENTS: Pen.COMPONENT,
        f"{COMPONENTS}_ARROWS": Pen.COMPONENT,
    }
)
"""Layers of the vectors of a sheet in colour, thin as those of others, and the pen whose colour
they have."""

_OF_COLOURED = {
    Pen.RELATIVE: RELATIVE,
    Pen.FINE_RELATIVE: RELATIVE,
    Pen.COMPONENT: COMPONENTS,
}

_OF_PEN = {
    **{pen: name for name, pen in reversed(tuple(LAYERS.items()))},
    **dict.fromkeys((Pen.RESULTANT, Pen.RELATIVE), "MAIN"),
    **dict.fromkeys((Pen.FINE_RESULTANT, Pen.FINE_RELATIVE, Pen.COMPONENT), "THIN"),
    Pen.LETTER: "TEXT",
}
_OF_TAG = {
    "margin": "TITLE_BLOCK",
    "table": "TABLES",
    "ellipse": "ERRORS",
    "similar": FIGURES,
    "pole": FIGURES,
    "absolute": VECTORS,
    "relative": VECTORS,
    "normal": VECTORS,
    "tangential": VECTORS,
    "coriolis": VECTORS,
    "sliding": VECTORS,
}
_OF_WORD = {
    "stamp": "TITLE_BLOCK",
    "plan-force": VECTORS,
    "diagram": "DIAGRAMS",
    "hodograph": "DIAGRAMS",
}
"""By the first word of a tag whose other words are letters."""


def layer_of(tag: str, pen: Pen) -> str:
    """Return the layer of a line with this tag and pen."""
    if tag.startswith("link ") and pen is Pen.MAIN:
        return "LINKS"
    return _of_tag(tag, _OF_PEN[pen])


def coloured_layer(layer: str, pen: Pen) -> str:
    """Return the layer that a line or an arrowhead of ``layer`` has on a sheet in colour."""
    if layer not in (VECTORS, ARROWS) or pen not in _OF_COLOURED:
        return layer
    return _OF_COLOURED[pen] + ("_ARROWS" if layer == ARROWS else "")


def layer_of_area(tag: str) -> str:
    """Return the layer of an area with this tag: of an arrowhead, mostly."""
    layer = _of_tag(tag, "SYMBOLS")
    return ARROWS if layer == VECTORS else layer


def layer_of_text(tag: str) -> str:
    """Return the layer of letters with this tag."""
    return _of_tag(tag, "TEXT")


def _of_tag(tag: str, usual: str) -> str:
    return _OF_TAG.get(tag) or _OF_WORD.get(tag.partition(" ")[0], usual)
