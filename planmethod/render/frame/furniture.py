"""Furniture of a sheet (оформление листа): form, additional graphs and the drawing area left."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType
from typing import TypeAlias

from msgspec import Struct

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES
from planmethod.paper import FRAME_OTHER, Format
from planmethod.problem.common import SheetSettings
from planmethod.render.frame.forms import FORM_1, FORM_2, FORM_2A, Form
from planmethod.render.ink.drawing import Bounds, Item
from planmethod.render.ink.extent import ink_bounds, overlap

FORMS: Mapping[str, tuple[Form, Form]] = MappingProxyType(
    {
        "1": (FORM_1, FORM_1),
        "1+2a": (FORM_1, FORM_2A),
        "2": (FORM_2, FORM_2A),
        "2a": (FORM_2A, FORM_2A),
    }
)
"""Forms of the first and of the later sheets, by the name of the pair in files and options."""

Graphs: TypeAlias = Mapping[str, Bounds]
"""Cells of additional graphs by number, mm on the sheet."""

_GRAPHS_27_29_WIDTH = 67.0  # mm: graphs 27 to 29 beside graph 26
_GRAPHS_HEIGHT = {"1": 8.0, "2": 22.0}  # mm: graph 30, or 27 to 30, above the title block


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


class Furniture(Struct, frozen=True):
    """Furniture around the drawings of a set of sheets (оформление комплекта листов).

    Attributes
    ----------
    form : str
        A key of `FORMS`.
    graph_26 : bool, optional
        The designation again, upside down in the upper corner. Default: on sheets of form 1.
    graphs_27_30 : bool
        Cells for the marks of a customer, beside graph 26 and above the title block.
    side_columns : bool
        Graphs 19 to 23 (and 24, 25 on the first sheet) in the binding margin.
    before : int
        Sheets of the set before the first of these.
    total : int, optional
        Sheets of the whole set. Default: those before plus these.
    lang : str
        Language of the captions.
    """

    form: str = "1"
    graph_26: bool | None = None
    graphs_27_30: bool = False
    side_columns: bool = False
    before: int = 0
    total: int | None = None
    lang: str = LANGUAGES[0]

    def __post_init__(self) -> None:
        """Refuse an unknown form."""
        if self.form not in FORMS:
            raise LayoutError(
                "Unknown form {!r} of the title block. Choose one of: {}.",
                self.form,
                ", ".join(FORMS),
            )

    @classmethod
    def of(cls, settings: SheetSettings, *, before: int = 0, total: int | None = None) -> Furniture:
        """Return the furniture that settings select, with defaults for the rest."""
        return cls(
            settings.form or "1",
            settings.graph_26,
            bool(settings.graphs_27_30),
            bool(settings.side_columns),
            before,
            total,
            settings.lang or LANGUAGES[0],
        )

    def is_first(self, sheet: int) -> bool:
        """Return whether one of these sheets, counted from 1, is the first of the set."""
        return self.before + sheet == 1

    def form_of(self, sheet: int) -> Form:
        """Return the form of one of these sheets, counted from 1."""
        first, later = FORMS[self.form]
        return first if self.is_first(sheet) else later

    def graphs(self, paper: Format, sheet: int = 1) -> Graphs:
        """Return the cells of graphs 26 to 30 that a sheet has."""
        form = self.form_of(sheet)
        shown = form is FORM_1 if self.graph_26 is None else self.graph_26
        found = {"26": upper_corner(paper, 0.0, 70.0)} if shown else {}
        if self.graphs_27_30:
            found |= _for_the_customer(paper, form, 70.0 if shown else 0.0)
        return MappingProxyType(found)

    def drawing_area(self, paper: Format, sheet: int = 1) -> DrawingArea:
        """Return the area that a sheet, counted from 1, has within its furniture."""
        form, inner = self.form_of(sheet), paper.inner
        above = _GRAPHS_HEIGHT.get(form.name, 0.0) if self.graphs_27_30 else 0.0
        stamp = (inner[2] - form.width, inner[1], inner[2], inner[1] + form.height + above)
        graphs = self.graphs(paper, sheet).values()
        return DrawingArea(inner, stamp, tuple(box for box in graphs if not _is_inside(box, stamp)))

    def numbers(self, sheet: int, sheets: int) -> dict[str, str]:
        """Return graphs 7 and 8 of one of ``sheets`` sheets.

        A single sheet has no number, and only the first one gives the total (GOST 2.104).
        """
        whole = self.total or self.before + sheets
        if whole == 1:
            return {}
        count = str(whole) if self.is_first(sheet) else ""
        return {"sheet": str(self.before + sheet), "sheets": count}


def upper_corner(
    paper: Format, start: float, end: float, low: float = 0.0, high: float = 14.0
) -> Bounds:
    """Return a cell of the row of graph 26: from ``start`` to ``end`` mm along it.

    The row goes from the upper left corner to the right; on a portrait sheet larger than A4, from
    the upper right corner down. ``low`` and ``high`` are across it, from the edge that is further
    from the frame.
    """
    left, _, right, top = paper.inner
    if paper.is_portrait and paper.size != "A4":
        return (right - 14.0 + low, top - end, right - 14.0 + high, top - start)
    return (left + start, top - 14.0 + low, left + end, top - 14.0 + high)


def _for_the_customer(paper: Format, form: Form, start: float) -> dict[str, Bounds]:
    """Return graphs 27 to 30; forms without a place for them have none."""
    if form.name not in _GRAPHS_HEIGHT:
        return {}
    right, top = paper.width - FRAME_OTHER, FRAME_OTHER + form.height
    whole = {"30": (right - 120.0, top, right, top + 8.0)}
    if form is FORM_2:
        y0, y1 = top + 8.0, top + 22.0
        return whole | {
            "27": (right - 120.0, y0, right - 106.0, y1),
            "28": (right - 106.0, y0, right - 53.0, y1),
            "29": (right - 53.0, y0, right, y1),
        }
    end = start + _GRAPHS_27_29_WIDTH
    return whole | {
        "27": upper_corner(paper, start, start + 14.0),
        "28": upper_corner(paper, start + 14.0, end, low=7.0),
        "29": upper_corner(paper, start + 14.0, end, high=7.0),
    }


def _is_inside(box: Bounds, outer: Bounds) -> bool:
    return outer[0] <= box[0] and outer[1] <= box[1] and box[2] <= outer[2] and box[3] <= outer[3]
