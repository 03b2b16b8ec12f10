"""Display list: the items on the paper, mm, y up, origin at the sheet's lower left corner.

All drawing code makes these records; every output format (backend) replays them. The list is plain
data, so tests compare lists, not pictures, and a lint can look for labels that collide.
"""

from __future__ import annotations

from cmath import rect
from collections.abc import Iterable, Iterator
from enum import Enum
from math import radians
from typing import TypeAlias

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.render.ink.lettering import OutlineLettering, in_use


class Pen(Enum):
    """Meaning of a line; width and dashes follow from it in `style` (назначение линии)."""

    MAIN = "main"  # links, vectors, table outline
    THIN = "thin"  # construction, leaders, table lines
    FRAME = "frame"  # frame and title block
    AXIS = "axis"  # dash-dot: axes, guide lines
    HIDDEN = "hidden"  # dashed
    THICK_AXIS = "thick axis"  # thick dash-dot: surfaces that are treated
    PHANTOM = "phantom"  # dash-dot with two dots: a link in another position
    HATCH = "hatch"  # hatching of the frame
    BREAK = "break"  # wavy or kinked: where a link is broken off
    PALE = "pale"  # other positions of the mechanism


class Ink(Enum):
    """Colour of a filled area."""

    BLACK = "black"
    WHITE = "white"


class Stroke(Struct, frozen=True):
    """Open or closed polyline.

    ``smooth`` marks points of a curve without corners, which a format with splines draws as one.
    """

    points: tuple[complex, ...]
    pen: Pen = Pen.MAIN
    closed: bool = False
    tag: str = ""
    smooth: bool = False


class Arc(Struct, frozen=True):
    """Circular arc, counter-clockwise from ``start`` to ``end`` (radians); by default a circle."""

    centre: complex
    radius: float
    start: float = 0.0
    end: float = 6.283185307179586
    pen: Pen = Pen.MAIN
    tag: str = ""


class Fill(Struct, frozen=True):
    """Filled polygon: an arrowhead, a rigid corner, the white inside of a joint."""

    points: tuple[complex, ...]
    ink: Ink = Ink.BLACK
    tag: str = ""


class Disc(Struct, frozen=True):
    """Filled circle."""

    centre: complex
    radius: float
    ink: Ink = Ink.WHITE
    tag: str = ""


class Text(Struct, frozen=True):
    """One run of letters; ``at`` is the left end of its base line (always left anchored).

    ``height`` is the cap height h of GOST 2.304 in mm, ``angle`` turns the run about ``at``,
    degrees. ``label`` groups the runs of one inscription (a letter and its index): the lint treats
    runs with one non-empty label as one. ``box`` is the cell that the text must stay in, or None;
    ``names`` is the point that a letter names, or None.
    """

    at: complex
    text: str
    height: float
    angle: float = 0.0
    label: str = ""
    box: tuple[float, float, float, float] | None = None  # xmin, ymin, xmax, ymax
    tag: str = ""
    names: complex | None = None


Item: TypeAlias = Stroke | Arc | Fill | Disc | Text
Bounds: TypeAlias = tuple[float, float, float, float]
"""xmin, ymin, xmax, ymax in mm."""


class Span(Struct, frozen=True):
    """One segment of a plan as it lies on the sheet (отрезок плана).

    ``name`` is its letters, ``position`` the number of the position on the sheet (None if there is
    only one), ``start`` and ``end`` are mm; ``magnification`` is its enlargement relative to the
    scale of its view: a plan may have a scale of its own. ``label`` is the name of the inscription
    that names its vector; empty if it needs none.
    """

    name: str
    position: int | None
    start: complex
    end: complex
    magnification: float = 1.0
    label: str = ""

    @property
    def length(self) -> float:
        """Length, mm."""
        return abs(self.end - self.start)


VIEW_KINDS = (
    "position", "velocity", "acceleration", "forces", "balance", "reactions", "hodograph",
    "structure", "flywheel", "diagram", "meshing", "trajectory", "cam",
)  # fmt: skip
"""Kinds of views; every language has a word for each."""


class View(Struct, frozen=True):
    """One view of a sheet, for its checks (вид).

    Attributes
    ----------
    kind : str
        One of `VIEW_KINDS`.
    box : Bounds, mm
        The picture with its title and inscriptions.
    scale : str
        Beginning of its scale inscription, ``μ_{v}``; empty where a view has no scale.
    per_mm : float
        The scale, SI units per mm.
    spans : tuple of Span
        The segments that are measured on it.
    """

    kind: str
    box: Bounds
    scale: str = ""
    per_mm: float = 0.0
    spans: tuple[Span, ...] = ()


class Drawing(Struct):
    """Display list of one sheet, drawn in order (чертёж), and its views.

    ``lettering`` is the one that its texts were measured in: the output formats draw them in it.
    ``has_omissions`` means that optional blocks were left out to make room for the others;
    ``is_continuation``, that the sheet continues the one before.
    """

    width: float
    height: float
    title: str = ""
    items: list[Item] = field(default_factory=list)
    views: list[View] = field(default_factory=list)
    lettering: OutlineLettering = field(default_factory=in_use)
    has_omissions: bool = False
    is_continuation: bool = False

    def _repr_svg_(self) -> str:
        """Return the SVG that a notebook shows."""
        from pkgutil import resolve_name

        # Ink knows no format: the notebook's one is found by name (ADR 0044).
        data: bytes = resolve_name("planmethod.render.backends:render")(self, "svg")
        return data.decode()

    def add(self, *items: Item) -> None:
        """Append items."""
        self.items.extend(items)

    def extend(self, items: Iterable[Item]) -> None:
        """Append many items."""
        self.items.extend(items)


def shifted(items: Iterable[Item], by: complex) -> Iterator[Item]:
    """Yield the items moved by ``by`` mm."""
    for item in items:
        match item:
            case Stroke(points=points):
                yield replace(item, points=tuple(point + by for point in points))
            case Fill(points=points):
                yield replace(item, points=tuple(point + by for point in points))
            case Arc(centre=centre) | Disc(centre=centre):
                yield replace(item, centre=centre + by)
            case Text(at=at, box=box, names=point):
                if box is not None:
                    dx, dy = by.real, by.imag
                    box = (box[0] + dx, box[1] + dy, box[2] + dx, box[3] + dy)
                point = None if point is None else point + by
                yield replace(item, at=at + by, box=box, names=point)


def placed(items: Iterable[Item], at: complex, angle: float) -> Iterator[Item]:
    """Yield the items turned about the origin by ``angle`` degrees, and moved by ``at`` mm."""
    turn = rect(1.0, radians(angle))
    for item in items:
        match item:
            case Stroke(points=points):
                yield replace(item, points=tuple(at + point * turn for point in points))
            case Fill(points=points):
                yield replace(item, points=tuple(at + point * turn for point in points))
            case Arc(centre=centre, start=start, end=end):
                by = radians(angle)
                yield replace(item, centre=at + centre * turn, start=start + by, end=end + by)
            case Disc(centre=centre):
                yield replace(item, centre=at + centre * turn)
            case Text(names=point):
                point = None if point is None else at + point * turn
                yield replace(item, at=at + item.at * turn, angle=item.angle + angle, names=point)
