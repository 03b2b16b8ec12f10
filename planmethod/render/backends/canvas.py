"""Protocol of an output format, and the replay of a display list on it."""

from __future__ import annotations

from cmath import isfinite
from collections.abc import Iterable, Iterator
from typing import Literal, Protocol, assert_never

from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.render.ink.drawing import Arc, Disc, Drawing, Fill, Item, Stroke, Text


class Options(Struct, frozen=True, kw_only=True):
    """Wishes that only some formats can grant.

    ``dpi`` is the resolution of a raster picture, dots to the inch; ``author`` goes into the
    properties of the file. ``dxf_text`` chooses text or outlines for the letters of a DXF;
    ``packed``, whether a raster picture is made as small as can be, which takes three times longer.
    """

    dpi: float = 100.0
    author: str = "planmethod"
    dxf_text: Literal["text", "strokes"] = "strokes"
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
