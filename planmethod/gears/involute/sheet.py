"""Sheet of an involute meshing, with its blocking contour and sliding diagram (лист)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise, product
from math import ceil, floor
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.figure import Figure
from msgspec import Struct
from shapely import Polygon, contains_xy, prepare, union_all

from planmethod.construct.scale import series_near
from planmethod.errors import LayoutError
from planmethod.gears.involute.cuttingpicture import cutting_picture, cutting_view
from planmethod.gears.involute.geometry import MeshingProblem, Reals
from planmethod.gears.involute.meshpicture import (
    mesh_dimensions,
    meshing_picture,
    nearest_scale,
    view_for,
)
from planmethod.gears.involute.results import (
    BASES,
    LimitKind,
    ProfileShiftLimit,
    SolvedMeshing,
    given_facts,
    given_text,
    meets_limits,
    quality,
    shifts,
    table,
)
from planmethod.languages import LANGUAGES, translate
from planmethod.note.numbers import Notation, trimmed
from planmethod.note.wording import Language, get_language
from planmethod.paper import STAMP_WIDTH
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Disc, Drawing, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.layout.block import (
    Block,
    Column,
    DrawingArea,
    Picture,
    heading,
    paragraph,
    titled,
)
from planmethod.render.layout.groups import EDGE, GAP, Group, LayoutItem
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.pictures.diagram import Abscissae, Curve, Diagram, Ordinates, diagram_picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    Packing,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
)
from planmethod.render.symbols import straight_arrow

if TYPE_CHECKING:
    from planmethod.options import PlanRequest


CONTOUR = "diagram contour"
"""Tag of the curves of the contour, with the kind of the limit."""

SMALLEST_DRAWN_SHIFT, LARGEST_DRAWN_SHIFT = -4.0, 4.0
"""Shifts between which the contour is drawn."""

_COARSE, _FINE = 321, 161  # rows of the grids that the region and the curves are found on
_NECK = 1.5  # grid steps: half the width of a neck that does not join two regions
_DENSER = 6  # factor of points over those where a curve crosses the grid
_SERIES = (1.0, 2.0, 2.5, 4.0, 5.0, 8.0)  # mm for a unit of the shifts, times a power of ten
_LETTERS = 30.0  # mm: space for the letters around a diagram
_MARGIN = 0.05  # of the window: white around the contour
_INSIDE = 1e-3  # gradients from a curve at which other margins end to where they are
_POLISHED = 8  # steps that bring a point of the grid's curve to the curve itself
_NAMED = 14.0  # mm: shorter parts of a curve have no name
_OVERRUN = 1.2  # length of the drawn line of action of an internal pair over its active end
_TICK = 1.2
_STEPS = (1.0, 2.0, 5.0)  # of the numbers of an axis, times a power of ten


# The curves -----------------------------------------------------------------------------------


class Window(Struct, frozen=True):
    """Part of the plane of the shifts that is drawn: bounds of x₁ and of x₂."""

    left: float
    right: float
    low: float
    high: float

    def grid(self, count: int) -> Reals:
        """Return shifts all over the window, shape (2, n, n)."""
        across = np.linspace(self.left, self.right, count)
        up = np.linspace(self.low, self.high, count)
        return np.stack(np.meshgrid(across, up))


def working_region(solved: SolvedMeshing, window: Window) -> Polygon:
    """Return the largest region of a window where pairs work, a little widened."""
    grid = window.grid(_COARSE)
    every = solved.pair.shifted(grid)
    with np.errstate(all="ignore"):
        margins = [one.margin(every) for one in solved.limits if one.hard]
    least = np.nan_to_num(np.min(margins, axis=0), nan=-1.0)
    least[[0, -1], :] = least[:, [0, -1]] = -1.0  # so that its outlines are closed
    step = (window.right - window.left) / _COARSE
    outlines = [Polygon(line) for line in _zero_lines(grid, least) if len(line) > 3]
    # Shrinking and expanding all parts separates those that only meet in a corner.
    narrow = union_all(outlines).buffer(-_NECK * step)
    largest = max(getattr(narrow, "geoms", [narrow]), key=lambda part: float(part.area))
    return largest.buffer((_NECK + 0.6) * step, join_style="mitre")


def _zero_lines(grid: Reals, values: Reals) -> list[Reals]:
    """Return the lines along which values on a grid vanish, arrays (n, 2)."""
    with np.errstate(all="ignore"):
        if not np.nanmin(values) < 0 < np.nanmax(values):
            return []
    shown = np.ma.masked_invalid(values)
    return list(Figure().subplots().contour(*grid, shown, levels=[0.0]).allsegs[0])


def window_of(solved: SolvedMeshing, region: Polygon) -> Window:
    """Return the part of the plane that is drawn: the region, the origin, the pair itself."""
    bounds: list[float] = []
    for k in (0, 1):
        shown = [0.0, float(solved.problem.x[k]), *(b for b in region.bounds[k::2] if b == b)]
        white = _MARGIN * (max(shown) - min(shown) + 0.5)
        bounds += [min(shown) - white, max(shown) + white]
    return Window(*bounds)


def curves(
    solved: SolvedMeshing, region: Polygon, window: Window
) -> Iterator[tuple[ProfileShiftLimit, list[Reals]]]:
    """Yield limits with the parts of their curves that the contour shows, arrays (2, n).

    Those of hard limits bound the pairs that work, the others run among these.
    """
    hard = tuple(one for one in solved.limits if one.hard)
    grid = window.grid(_FINE)
    every = solved.pair.shifted(grid)
    ragged = region.buffer(3 * (window.right - window.left) / _COARSE)
    prepare(region)
    for limit in (*solved.limits, *BASES):
        parts: list[Reals] = []
        others = tuple(one for one in hard if one is not limit)
        with np.errstate(all="ignore"):
            lines = _zero_lines(grid, limit.margin(every))
        for line in lines:
            places = np.linspace(0, len(line) - 1, _DENSER * len(line))
            whole = np.stack([np.interp(places, range(len(line)), column) for column in line.T])
            points = _polished(solved, limit, whole)
            within, near = points, region
            if limit in BASES:  # the other margins end there as well: no grid leads up to it
                within = points + _INSIDE * _slope(solved, limit, points)
                near = ragged
            shown = meets_limits(solved.pair.shifted(within), others).astype(bool)
            shown &= contains_xy(near, *points)
            edges = np.flatnonzero(np.diff(shown.astype(int))) + 1
            runs = np.split(np.arange(points.shape[1]), edges)
            parts += [points[:, run] for run in runs if len(run) > 1 and shown[run[0]]]
        yield limit, parts


def _polished(solved: SolvedMeshing, limit: ProfileShiftLimit, points: Reals) -> Reals:
    """Bring points near a curve onto it, along the gradient of the margin (Newton's method)."""
    with np.errstate(all="ignore"):
        for _ in range(_POLISHED):
            here, slope = limit.margin(solved.pair.shifted(points)), _slope(solved, limit, points)
            points = points - slope * here / np.sum(slope**2, axis=0)
    return np.asarray(points[:, np.isfinite(points).all(axis=0)])


def _slope(solved: SolvedMeshing, limit: ProfileShiftLimit, points: Reals) -> Reals:
    """Return the gradient of a margin at some shifts, shape (2, n)."""
    small, here = 1e-6, limit.margin(solved.pair.shifted(points))
    ways = np.array([[1.0], [0.0]]), np.array([[0.0], [1.0]])
    moved = [limit.margin(solved.pair.shifted(points + small * way)) for way in ways]
    return np.stack([(there - here) / small for there in moved])


def _joined(part: Reals, bounds: list[Reals], step: float) -> Reals:
    """Return a curve at which others cease, its ends on them where they are within a step."""
    others = np.hstack(bounds)
    for k in (0, -1):
        far = np.hypot(*(others - part[:, [k]]))
        nearest = others[:, [int(np.argmin(far))]]
        if float(np.min(far)) < step:
            part = np.hstack([nearest, part] if k == 0 else [part, nearest])
    return part


# The contour ------------------------------------------------------------------------------------


class Contour(Struct, frozen=True):
    """Blocking contour of a pair: the drawn part of the plane, and the curves in it."""

    solved: SolvedMeshing
    window: Window
    parts: list[tuple[ProfileShiftLimit, list[Reals]]]

    @classmethod
    def of(cls, solved: SolvedMeshing) -> Contour:
        """Return the contour of a pair."""
        window = window_of(
            solved,
            working_region(
                solved,
                Window(
                    SMALLEST_DRAWN_SHIFT,
                    LARGEST_DRAWN_SHIFT,
                    SMALLEST_DRAWN_SHIFT,
                    LARGEST_DRAWN_SHIFT,
                ),
            ),
        )
        parts = list(curves(solved, working_region(solved, window), window))
        step = 2 * (window.right - window.left) / _FINE
        bounds = [
            part for limit, found in parts if limit.hard and limit not in BASES for part in found
        ]
        parts = [
            (limit, [_joined(part, bounds, step) if limit in BASES else part for part in found])
            for limit, found in parts
        ]
        return cls(solved, window, parts)


def contour_picture(
    contour: Contour, language: Language, width: float, height: float, letter: float
) -> Picture:
    """Return the blocking contour with the chosen point; only letters may exceed the area."""
    solved, window = contour.solved, contour.window
    wide, tall = window.right - window.left, window.high - window.low
    room = (width - _LETTERS, height - _LETTERS)
    per_unit = series_near(min(room[0] / wide, room[1] / tall), up=False, series=_SERIES)

    def at(x: Reals) -> complex:
        return complex(x[0], x[1]) * per_unit

    step = _step(window, per_unit, language.notation, letter)
    items: list[Item] = list(_axes(window, per_unit, step, letter))
    labels = _axis_numbers(window, per_unit, step, language.notation, letter)
    for limit, parts in contour.parts:
        pen = Pen.MAIN if limit.hard else Pen.THIN
        tag = f"{CONTOUR} {limit.kind.value}"
        strokes = [tuple(at(point) for point in part.T) for part in parts]
        items += [Stroke(points, pen, tag=tag) for points in strokes]
        for k, points in enumerate(strokes):
            if _length(points) < _NAMED:
                continue
            middle = points[len(points) // 2]
            text = typeset(_sign(limit, language.notation), letter)
            name = f"{limit.kind.value} {limit.wheel} {limit.min_value} {k}"
            out = middle - complex(window.left + wide / 2, window.low + tall / 2) * per_unit
            way = out / abs(out) * (1 if limit.hard else -1) if abs(out) > 1.0 else 1j
            labels.append(Label(text, middle, prefer=way, gap=1.5, name=name, style=BUSY))
    point = at(np.array(solved.problem.x))
    for foot in (complex(point.real, 0.0), complex(0.0, point.imag)):
        if abs(point - foot) > 2.0:
            items.append(
                Stroke((point, foot), Pen.HIDDEN if abs(point - foot) > 12.0 else Pen.THIN)
            )
    items.append(Disc(point, 1.3, Ink.BLACK, tag=CONTOUR))
    shown = "; ".join(language.notation.number(f"{x + 0.0:.2f}") for x in solved.problem.x)
    labels.append(
        Label(typeset(f"({shown})", letter), point, gap=2.0, priority=1, name="x", style=BUSY)
    )
    return lettered(items, labels)


def _length(points: tuple[complex, ...]) -> float:
    return sum(abs(end - start) for start, end in pairwise(points))


def _sign(limit: ProfileShiftLimit, notation: Notation) -> str:
    """Return what a curve is called, rich text."""
    number = "" if limit.wheel is None else limit.wheel + 1
    match limit.kind:
        case LimitKind.UNDERCUT:
            return f"x_{{{number}}} = x_{{min{number}}}"
        case LimitKind.INTERFERENCE:
            return f"ρ_{{p{number}}} = ρ_{{l{number}}}"
        case LimitKind.TIP:
            share = f"{notation.as_input(limit.min_value)}m" if limit.min_value else "0"
            return f"s_{{a{number}}} = {share}"
        case LimitKind.BASE:
            return f"d_{{a{number}}} = d_{{b{number}}}"
        case LimitKind.TIPS:
            return "Δφ = 0"
        case LimitKind.OVERLAP:
            return f"ε_{{α}} = {notation.as_input(limit.min_value)}"


def _step(window: Window, per_unit: float, notation: Notation, letter: float) -> float:
    """Return the step of both axes, by the millimetres that the widest number takes."""
    apart = 2.0 * letter
    while True:
        step = series_near(apart / per_unit, up=True, series=_STEPS)
        taken = [
            label.inscription.width
            for label in _axis_numbers(window, per_unit, step, notation, letter)
        ]
        wide = max(taken, default=0.0) + letter
        if wide <= step * per_unit + 1e-9:
            return step
        apart = 1.01 * step * per_unit


def _axes(window: Window, per_unit: float, step: float, letter: float) -> Iterator[Item]:
    """Yield both axes through the origin with arrows, letters and ticks."""
    for turn, high, name in ((1 + 0j, window.right, "x_{1}"), (1j, window.high, "x_{2}")):
        tip = high * per_unit + 6.0
        low = window.left if turn == 1 else window.low
        yield from straight_arrow(turn * low * per_unit, turn * tip, tag="diagram axis")
        text = typeset(name, letter)
        beside = complex(-text.width, text.descent + 2.0) if turn == 1 else complex(2.5, -letter)
        yield from text.at(turn * tip + beside)
        for place, _ in _ticks(low, high, per_unit, step):
            across = turn * 1j * _TICK
            yield Stroke(
                (turn * place - across, turn * place + across), Pen.THIN, tag="diagram axis"
            )


def _ticks(low: float, high: float, per_unit: float, step: float) -> Iterator[tuple[float, float]]:
    """Yield places of round numbers on an axis, mm, and the numbers."""
    for k in range(ceil(low / step), floor(high / step + 1e-9) + 1):
        if k:
            yield k * step * per_unit, k * step


def _axis_numbers(
    window: Window, per_unit: float, step: float, notation: Notation, letter: float
) -> list[Label]:
    size = max(2.5, 0.7 * letter)
    spans = ((1 + 0j, window.left, window.right), (1j, window.low, window.high))
    return [
        Label(
            typeset(notation.number(trimmed(number, 3)), size),
            turn * place,
            prefer=turn * (-1j if turn == 1 else 1j),
            gap=2.2,
            name=f"axis {turn} {number:g}",
        )
        for turn, low, high in spans
        for place, number in _ticks(low, high, per_unit, step)
    ]


# Sliding ------------------------------------------------------------------------------------------


def sliding_scale(solved: SolvedMeshing, width: float) -> float:
    """Return the scale in which the line of action fits, mm of paper for one."""
    return nearest_scale((width - _LETTERS) / _line(solved))


def sliding_per_mm(solved: SolvedMeshing, height: float) -> float:
    """Return the scale of specific sliding of a diagram of given height in mm, 1/mm."""
    return series_near((1.0 - _floor(solved)) / (height - _LETTERS), up=True)


def _floor(solved: SolvedMeshing) -> float:
    """Return the lowest specific sliding of the diagram."""
    ends = np.array([solved.contact.start, solved.contact.end])
    with np.errstate(all="ignore"):
        worst = float(np.nanmin(solved.pair.sliding(ends), initial=-1.0))
    return max(1.4 * worst, -8.0)


def _line(solved: SolvedMeshing) -> float:
    """Return how long the line of action is drawn, mm: of a ring there is no N₂ on this side."""
    line = float(solved.pair.line)
    return line if line > 0 else _OVERRUN * solved.contact.end


def sliding_picture(
    solved: SolvedMeshing, language: Language, width: float, height: float, letter: float
) -> Picture:
    """Return the diagram of specific sliding along the line of action from N₁ to N₂.

    Thick lines are of the active part AB; near N₁ and N₂ the curves leave the diagram downwards.
    """
    pair, contact = solved.pair, solved.contact
    line, scale = _line(solved), sliding_scale(solved, width)
    ends = np.array([contact.start, contact.end])
    floor_at, per_mm = _floor(solved), sliding_per_mm(solved, height)

    def part(wheel: int, low: float, high: float) -> tuple[complex, ...]:
        rho = np.linspace(low, high, 400)
        with np.errstate(all="ignore"):
            theta = pair.sliding(rho)[wheel]
        places = zip(rho[theta >= floor_at], theta[theta >= floor_at], strict=True)
        return tuple(complex(r * scale, v / per_mm) for r, v in places)

    drawn = []
    for wheel in (0, 1):
        symbol = f"ϑ_{{{wheel + 1}}}"
        drawn.append(Curve(symbol, (part(wheel, contact.start, contact.end),)))
        for low, high in ((1e-6, contact.start), (contact.end, line - 1e-6)):
            points = part(wheel, low, high) if high > low else ()
            if len(points) > 1:
                drawn.append(Curve("", (points,), Pen.THIN))
    for rho in ends:
        upright = (complex(rho * scale, floor_at / per_mm), complex(rho * scale, 1.0 / per_mm))
        drawn.append(Curve("", (upright,), Pen.THIN))
    pole = pair.d_b[0] / 2 * np.tan(float(pair.alpha_w))
    marks = {"N_{1}": 0.0, "A": contact.start, "P": float(pole), "B": contact.end}
    if pair.side > 0:
        marks["N_{2}"] = line
    return diagram_picture(
        Diagram(
            Abscissae("ρ_{1}", tuple(rho * scale for rho in marks.values()), tuple(marks)),
            Ordinates("ϑ", per_mm, language.notation),
            drawn,
        ),
        letter_height=letter,
        name="sliding",
    )


TEXT_WIDTH = STAMP_WIDTH - EDGE
"""Width of the tables, which are placed over the title block, mm."""


TRIES = (
    (Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 10.0), 5.0, 1.0),
    (Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 9.0), 5.0, 1.0),
    (Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 10.0), 3.5, 1.0),
    (Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 9.0), 3.5, 1.0),
    (Sizes(5.0, 5.0, 3.5, TEXT_WIDTH, 8.0), 3.5, 0.95),
    (Sizes(3.5, 5.0, 3.5, TEXT_WIDTH, 6.0), 3.5, 0.9),
    (Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 5.0), 2.5, 0.9),
    (Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 4.5), 2.5, 0.75),
)
"""Sizes, height of the letters of the checks, mm, and part of the paper for the views.

Tried in turn until everything fits.
"""


def drawings(problem: MeshingProblem, request: PlanRequest) -> list[Drawing]:
    """Draw the pair in mesh, its blocking contour, specific sliding and the table of sizes.

    Raises
    ------
    LayoutError
        All this does not fit the requested paper.
    """
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    furniture = Furniture.of(problem.sheet, before=request.before, total=request.total)
    misfit = NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the meshing, its contour, its diagram and its tables do not fit {}. {}",
            problem.name,
            paper,
            advice,
        ),
        translate("Choose another --paper."),
    )
    strategy = _Meshing(SolvedMeshing(problem), language)
    title = problem.title or language.meshing.sheet
    return compose(
        problem, strategy, misfit, fields=request.fields, furniture=furniture, title=title
    )


class _Meshing(Struct, frozen=True):
    """Search for the layout of the sheet of a mesh, with ever smaller letters and views."""

    solved: SolvedMeshing
    language: Language

    formats = ("A1",)

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[Packing]:
        """Yield the blocks at sizes at which the tables fit."""
        contour = Contour.of(self.solved)
        for paper, (sizes, checks, share) in product(papers, TRIES):
            with paper.using_pens():
                parts = self._parts(contour, paper.drawing_area(), sizes, checks, share)
            if parts is not None:
                yield Packing(paper, (Group(parts),))

    def _parts(
        self, contour: Contour, area: DrawingArea, sizes: Sizes, checks: float, view_ratio: float
    ) -> tuple[LayoutItem, ...] | None:
        """Return the blocks in reading order; None where the tables are too high."""
        solved, language, texts = self.solved, self.language, self.language.meshing
        wide = area.inner[2] - area.inner[0]
        tall = min([area.inner[3], *(box[1] for box in area.reserved)]) - area.inner[1]
        free = wide - STAMP_WIDTH - 2 * EDGE - 2 * GAP
        high = tall - 2 * EDGE - sizes.title - 8.0
        told = Column([*_checks(solved, language, sizes.title, checks)], gap=4.0)
        tables = Column([*_tables(solved, language, sizes)], gap=4.0)
        if told.height + tables.height + area.stamp[3] + 2 * GAP > area.inner[3]:
            return None
        room = view_ratio * high
        for _ in range(3):  # letters and dimensions are known when the picture is drawn
            view = view_for(solved, view_ratio * 0.66 * free, room)
            named = mesh_dimensions(view, sizes.letter)
            mesh = meshing_picture(view, language, sizes.letter, *named)
            if mesh.height <= view_ratio * high:
                break
            room -= mesh.height - view_ratio * high
        width = view_ratio * (free - mesh.width)
        plane = contour_picture(contour, language, width, view_ratio * 0.36 * high, sizes.letter)
        low = view_ratio * 0.24 * high
        sliding = sliding_picture(solved, language, width, low, sizes.letter)
        pinion = solved.cuttings[0]
        assert pinion is not None  # only wheel 2 may be a ring
        cutting = cutting_view(pinion, width, view_ratio * 0.36 * high)
        cut = cutting_picture(cutting, language, sizes.letter)
        scale = _scale(sliding_scale(solved, width), language.notation)
        per_mm = language.notation.as_input(sliding_per_mm(solved, low))
        upright = texts.sliding_scale.format(scale=per_mm)
        title = texts.meshing.format(scale=_scale(view.scale, language.notation))
        blocks: list[Block] = [
            ViewBlock(_titled(title, mesh, sizes), "meshing", None),
            _titled(texts.cut.format(scale=_scale(cutting.scale, language.notation)), cut, sizes),
            _titled(texts.contour, plane, sizes),
            _titled(texts.sliding.format(scale=scale), sliding, sizes, upright),
        ]
        return (*map(LayoutItem, blocks), LayoutItem(told, text=True), LayoutItem(tables))


def _titled(title: str, picture: Picture, sizes: Sizes, scale: str = "") -> Block:
    return titled(picture, title, [scale] if scale else [], (sizes.title, sizes.text),
                  is_wrapped=True)  # fmt: skip


def _scale(value: float, notation: Notation) -> str:
    """Return a scale as GOST 2.302 writes it: ``4:1``, ``1:2,5``."""
    return f"{notation.short(value)}:1" if value >= 1 else f"1:{notation.short(1 / value)}"


# Texts and tables -------------------------------------------------------------------------------


def _checks(
    solved: SolvedMeshing, language: Language, title: float, text: float
) -> Iterator[Block]:
    """Yield the given data and the verdicts of the limits, in letters of a height, mm."""
    texts = language.meshing
    yield paragraph(given_text(given_facts(solved, language), language), text, TEXT_WIDTH)
    yield heading(texts.checked, title, width=TEXT_WIDTH)
    section = (texts.helical,) if solved.problem.beta else ()
    for line in (*section, *quality(solved, language), shifts(solved, language)):
        yield paragraph(line, text, TEXT_WIDTH)


def _tables(solved: SolvedMeshing, language: Language, sizes: Sizes) -> Iterator[Block]:
    """Yield the tables of the pair and of the wheels."""
    pair, wheels, contact = solved.sized_quantities()
    texts = language.meshing
    heads: tuple[str, ...] = texts["columns"]
    for told, head in (([*pair, *contact], (*heads[:2], texts.pair)), (wheels, heads)):
        shown = table([one for one in told if one.quantity.in_table], language, head)
        columns = [TableColumn(*column) for column in shown.columns()]
        yield table_block(
            columns, TableForm(sizes.text, units="none", row_height=sizes.row), width=STAMP_WIDTH
        )
