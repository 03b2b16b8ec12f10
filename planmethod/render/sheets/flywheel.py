"""Blocks of the sheets of flywheel and run-up: diagrams, tables, the wheel (маховик, разбег)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import ceil, degrees, inf

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.scale import Scale, choose_scale, series_near
from planmethod.errors import LayoutError
from planmethod.note.accounts.machine import MachineAccount
from planmethod.note.accounts.voice import SHEET
from planmethod.note.document import Caption, Formula, Paragraph
from planmethod.note.narrate.balancing import ReductionNarrator
from planmethod.note.narrate.forces.statement import like_line
from planmethod.note.narrate.machine import MachineNarrator, course_columns, courses, run_up_lines
from planmethod.note.narrate.naming import point_name
from planmethod.note.numbers import trimmed
from planmethod.note.wording import Language
from planmethod.problem.machine_records import WheelShape
from planmethod.problem.records import Load, Over, SizeTable
from planmethod.render.frame import STAMP_WIDTH
from planmethod.render.ink.drawing import Arc, Disc, Item, Pen, Span, Stroke
from planmethod.render.ink.pens import drawn_once
from planmethod.render.ink.typeset import ink_bounds, typeset
from planmethod.render.layout.block import (
    Alternatives,
    Block,
    Column,
    Picture,
    Row,
    make_alternatives,
    paragraph,
)
from planmethod.render.layout.text_blocks import (
    TableColumn,
    TableForm,
    TextNode,
    blocks_of,
    table_block,
)
from planmethod.render.pictures.diagram import Abscissae, Curve, Diagram, Ordinates, diagram_picture
from planmethod.render.pictures.flywheel import POLE, construction_picture
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.views import LARGER, NARROW, named, stated
from planmethod.render.symbols import dimension, dimension_tag, hatch
from planmethod.render.symbols.marks import axis_line, centre_lines
from planmethod.solved.forces.loads import external
from planmethod.solved.legibility import Box
from planmethod.solved.machine.drawing import FlywheelDrawing, drawing_of
from planmethod.solved.machine.flywheel import Flywheel, FlywheelSizes, flywheel_of
from planmethod.solved.machine.runup import TimeMotion, run_up_of
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution


def _drawing(solution: Solution) -> FlywheelDrawing:
    problem = solution.problem
    if problem.machine is None:
        raise LayoutError(
            "{}: a layout with a flywheel needs [machine] in the problem file. For "
            'example: [machine] delta = "1/18".',
            problem.name,
        )
    return drawing_of(flywheel_of(solution), solution.profile)


def _flywheel_narrator(solution: Solution, style: BlockStyle) -> MachineNarrator:
    return MachineNarrator(_drawing(solution), style.language)


# Texts -------------------------------------------------------------------------------------------


def statement_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return "Дано" of the machine, and "Определить"."""
    narrator = _flywheel_narrator(solution, style)
    asked = style.language.sheets.wanted.format(wanted=narrator.unknowns())
    return stated(narrator.given_facts(), asked, style)


def calculation_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the formulas of the construction, the exact flywheel, and their difference.

    There are several widths: the diagrams beside it may need space.
    """
    narrator = _flywheel_narrator(solution, style)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    told = MachineAccount(narrator, SHEET).calculation()
    nodes: list[TextNode] = [
        Caption(style.entry.title or narrator.texts.calculation),
        *(node for node in told if isinstance(node, TextNode)),
    ]
    widths = (width, (1.0 + NARROW) / 2.0 * width, NARROW * width)
    return Alternatives(
        tuple(Column(list(blocks_of(nodes, height, width=one)), gap=2.5) for one in widths)
    )


# Diagrams of the construction --------------------------------------------------------------------


class _DiagramsViewBlock(ViewBlock, frozen=True):
    """The diagrams of the construction, with KL or AB and the pole distance as measured segments.

    ``corner`` is the place of the point that is marked with the letter ``mark``.
    """

    ends: tuple[tuple[str, complex, complex], ...]
    corner: complex
    mark: str

    def spans(self, items: Sequence[Item], corner: complex) -> Iterable[Span]:
        """Return KL or AB, and H."""
        marks = [item.centre for item in items if isinstance(item, Disc) and item.tag == self.mark]
        for by in (mark - self.corner for mark in marks[:1]):
            yield from (Span(name, None, tail + by, head + by) for name, tail, head in self.ends)


def diagrams_view(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the constructed diagrams of moment, work, energy, inertia and those of the method."""
    whole = _construction(solution, style.letter, style.language)
    return _measured(solution, whole, style, "MφATJ")


def works_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> ViewBlock:
    """Return the diagrams of moment and work; all of them, if they cannot be divided."""
    upper, lower = _halves(solution, style)
    return _measured(solution, upper, style, "MφA" if lower.items else "MφATJ")


def masses_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the diagrams that `works_view` has not, with their axes under its axes, if any."""
    _, lower = _halves(solution, style)
    return _measured(solution, lower, style, "TJ") if lower.items else lower


@drawn_once
def _construction(solution: Solution, letter: float, language: Language) -> Picture:
    drawing = _drawing(solution)
    return construction_picture(drawing, MachineNarrator(drawing, language), letter)


def _halves(solution: Solution, style: BlockStyle) -> tuple[Picture, Picture]:
    """Return the diagrams of moment and work, and those below, as wide at their left sides.

    The second is empty where no white goes across below the diagram of work.
    """
    whole, made = _construction(solution, style.letter, style.language), _drawing(solution)
    high, low = (
        complex(made.exact.point(made.construction.axes[key].origin)[0]).imag for key in "AT"
    )
    boxes = [(ink_bounds([item]), item) for item in whole.items]
    cuts = [box[1] for box, _ in boxes if low < box[1] < high]
    cut = next((y for y in sorted(cuts, reverse=True)
                if not any(box[1] < y < box[3] for box, _ in boxes)), -inf)  # fmt: skip
    halves = []
    for own in ([item for box, item in boxes if box[1] >= cut],
                [item for box, item in boxes if box[1] < cut]):  # fmt: skip
        _, bottom, right, top = ink_bounds(own) if own else (0.0, 0.0, 0.0, 0.0)
        left = whole.bounds[0] if own else 0.0
        halves.append(Picture(tuple(own), (left, bottom, right, top)))
    return halves[0], halves[1]


def _measured(
    solution: Solution, picture: Picture, style: BlockStyle, letters: str
) -> _DiagramsViewBlock:
    """Return diagrams as a view with the segments that are measured there: H, and KL or AB.

    ``letters`` are those of the scales. The second part of all diagrams has a title of its own: it
    may be in another column.
    """
    drawing, narrator = _drawing(solution), _flywheel_narrator(solution, style)
    scales, made = drawing.scales, drawing.construction
    all_scales = {
        "M": (scales.moment, "N·m"),
        "φ": (degrees(scales.phi), "deg"),
        "A": (scales.work, "J"),
        "T": (scales.work, "J"),
        "J": (scales.inertia, "kg·m²"),
    }
    text = "; ".join(narrator.scale(letter, *all_scales[letter]) for letter in letters)
    upper, lower, pole, foot = (
        complex(drawing.exact.point(name)[0])
        for name in (made.upper, made.lower, made.pole, made.axes["M"].origin)
    )
    level = complex(upper.real, lower.imag)  # of A and B along the axis, as KL is
    spans = [(str(made.segment), level, upper)] if "T" in letters else []
    corner, mark = upper, made.letters[0]
    account = MachineAccount(narrator, SHEET)
    title = account.by_method("energy_diagrams")
    scale = Scale(f"mu_{letters[0]}", *all_scales[letters[0]])
    if "M" in letters:
        spans.append(("H", pole, foot))
        corner, mark = pole, POLE
        every = account.by_method("diagrams")
        title = style.entry.title or (every if "T" in letters else narrator.texts.works)
    block = named(picture, title, [text], style, is_wrapped=True)
    return _DiagramsViewBlock(block, "flywheel", scale, tuple(spans), corner, mark)


# Further diagrams --------------------------------------------------------------------------------


def speed_diagram(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the deviation of the speed of the steady motion from the mean as a diagram.

    Where there is space, its axis begins as far from the left edge as those of the construction,
    under which it may be.
    """
    made = _drawing(solution)
    origin = complex(made.exact.point(made.construction.axes["M"].origin)[0]).real
    edge = _construction(solution, style.letter, style.language).bounds[0] - origin
    ways = (
        _speed_diagram(solution, style, times, left) for times in LARGER for left in (0.0, edge)
    )
    return make_alternatives(ways, grows=True)


def _speed_diagram(solution: Solution, style: BlockStyle, times: float, left: float) -> ViewBlock:
    """Return the diagram of the speed, ``times`` as high; ``left`` is its edge from the axis."""
    narrator, flywheel = _flywheel_narrator(solution, style), flywheel_of(solution)
    _, height = _diagram_size(style)
    at = np.linspace(0.0, flywheel.cycle, 721)
    omega = flywheel.speeds(np.append(at[:-1], 0.0))[0] - flywheel.middle_speed
    per_mm = choose_scale((0.0, float(np.ptp(omega))), (1.0, times * height))
    across = _drawing(solution).scales.phi
    width = flywheel.cycle / across
    places = tuple(complex(t / across, y / per_mm) for t, y in zip(at, omega, strict=True))
    count = flywheel.machine.count
    marks = tuple(width * k / count for k in range(count + 1))
    unit = narrator.unit("1/s")
    picture = diagram_picture(
        Diagram(
            Abscissae("φ", marks, tuple(map(str, flywheel.turn.numbers(count)))),
            Ordinates(f"ω − {narrator.letter('mean speed')}, {unit}", per_mm, narrator.notation),
            [Curve("", (places,))],
        ),
        letter_height=style.letter,
        name="speed",
    )
    picture = replace(picture, bounds=(min(left, picture.bounds[0]), *picture.bounds[1:]))
    scale = Scale("mu_ω", per_mm, "1/s")
    told = [f"{narrator.scale('ω', per_mm, '1/s')}; {narrator.scale('φ', degrees(across), 'deg')}"]
    title = style.entry.title or narrator.texts.speed
    return ViewBlock(named(picture, title, told, style, is_wrapped=True), "diagram", scale)


def _diagram_size(style: BlockStyle) -> tuple[float, float]:
    column = style.width(style.sizes.column)
    return 0.75 * column, 0.22 * column


def load_diagrams(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return diagrams of variable forces over the strokes of their points, side by side.

    A load that repeats another one's diagram later is listed under that diagram.
    """
    narrator, flywheel = _flywheel_narrator(solution, style), flywheel_of(solution)
    width, height = _diagram_size(style)
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    blocks: list[Block] = []
    turned = _fine(flywheel)
    moved = flywheel.turn.at(turned)
    for load in dynamics.loads:
        if not isinstance(load, Load) or not isinstance(load.size, SizeTable) or load.size.like:
            continue
        (force,) = (one.force for one in external(moved, dynamics, load.link)
                    if one.name == load.name)  # fmt: skip
        way = flywheel.turn.main_direction(load.at)
        along = (moved.points[load.at].place * way.conjugate()).real
        stroke = float(np.ptp(along))
        # from the end at or nearer to position 0
        start = along.min() if along[0] - along.min() <= along.max() - along[0] else along.max()
        if load.size.over is Over.STROKES:  # from the top dead centre
            start = (flywheel.turn.stroke_of(load).start * way.conjugate()).real
        share = np.abs(along - start) / stroke
        values = (force * way.conjugate()).real
        if values[int(np.argmax(np.abs(values)))] < 0.0:
            values = -values
        per_mm = choose_scale((0.0, float(np.ptp(np.append(values, 0.0)))), (1.0, height))
        mu_s = choose_scale((stroke, 0.0), (0.7 * width, 1.0))
        places = tuple(
            complex(s * stroke / mu_s, y / per_mm) for s, y in zip(share, values, strict=True)
        )
        name = point_name(load.at)
        picture = diagram_picture(
            Diagram(
                Abscissae(f"s_{{{name}}}", (0.0, stroke / mu_s), ("0", "H")),
                Ordinates(f"{load.name}, {narrator.unit('N')}", per_mm, narrator.notation),
                [Curve("", (places,))],
            ),
            letter_height=style.letter,
            name=f"load {load.name}",
        )
        metres = f"{narrator.notation.computed(stroke)} {narrator.unit('m')}"
        text = "; ".join(
            (
                narrator.texts.over_stroke.format(stroke=metres),
                narrator.scale("F", per_mm, "N"),
                narrator.scale("s", mu_s, "m"),
            )
        )
        title = style.entry.title or narrator.texts.load.format(name=load.name, point=name)
        later = [like_line(one, style.language) for one in dynamics.loads
                 if isinstance(one.size, SizeTable) and one.size.like == load.name]  # fmt: skip
        blocks.append(named(picture, title, [text, *later], style))
    return (
        Row(blocks[:2], gap=12.0, align="bottom") if blocks else Picture((), (0.0, 0.0, 0.0, 0.0))
    )


def _fine(flywheel: Flywheel) -> Reals:
    """Return the rotation angles for a load's curve, with both sides of every jump."""
    edges = flywheel.moment.edges
    inside = [
        np.linspace(low + 1e-7, high - 1e-7, max(int((high - low) / 0.02), 2))
        for low, high in pairwise(edges.tolist())
    ]
    return np.concatenate(inside)


# Table -------------------------------------------------------------------------------------------


def machine_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the quantities reduced to the crank, work, energy and speed by positions."""
    narrator = _flywheel_narrator(solution, style)
    height = style.text(min(style.sizes.text, 3.5))
    columns = [
        TableColumn(head, tuple(cells), unit=unit, min_width=8.0)
        for head, unit, cells in narrator.columns()
    ]
    title = style.entry.title or narrator.texts.table
    table = table_block(
        columns,
        TableForm(height, leading=2, row_height=max(6.0, 2.0 * height)),
        max_width=table_width(style),
        width=STAMP_WIDTH,
        title=title,
    )
    note = MachineAccount(narrator, SHEET).lever_agrees.removesuffix(".")
    return Column([table, paragraph(note, height, table.width)], gap=3.0)


def chain_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the tables of motors, stages and shafts; nothing without ``[[motors]]``."""
    narrator = _flywheel_narrator(solution, style)
    account, height = MachineAccount(narrator, SHEET).chain, style.text(min(style.sizes.text, 3.5))
    form = TableForm(height, leading=1, row_height=max(6.0, 2.0 * height))
    tables = () if account is None else account.tables()
    blocks = [
        table_block(
            [TableColumn(head, tuple(cells), unit=unit, min_width=8.0)
             for head, unit, cells in columns],
            form, max_width=table_width(style), width=STAMP_WIDTH,
            title=narrator.texts["chain"]["tables"][name],
        )
        for name, columns in tables
        if columns
    ]  # fmt: skip
    return Column(blocks, gap=5.0) if blocks else Picture((), (0.0, 0.0, 0.0, 0.0))


def moment_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the reduced moment term by term: forces, velocities, angles."""
    reduction = ReductionNarrator(_flywheel_narrator(solution, style))
    formulas = [reduction.moment_formula()]
    return _reduced(reduction.moments(), formulas, reduction.narrator.texts.moments, style)


def energy_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the energies of the links and the reduced moment of inertia."""
    reduction = ReductionNarrator(_flywheel_narrator(solution, style))
    formulas, title = reduction.energy_formulas(), reduction.narrator.texts.energies
    return _reduced(reduction.energy_columns(), formulas, title, style)


def _reduced(
    columns: Sequence[tuple[str, str, list[str]]],
    formulas: Iterable[str],
    title: str,
    style: BlockStyle,
) -> Block:
    """Return a table with the formulas of its columns above it."""
    height = style.text(min(style.sizes.text, 3.5))
    made = [
        TableColumn(head, tuple(cells), unit=unit, min_width=8.0) for head, unit, cells in columns
    ]
    width = table_width(style)
    table = table_block(
        made, TableForm(height, leading=1, row_height=max(6.0, 2.0 * height)), max_width=width
    )
    head: list[TextNode] = [Caption(style.entry.title or title), *map(Formula, formulas)]
    return Column([*blocks_of(head, height, width=max(table.width, 100.0)), table], gap=2.5)


# The wheel ---------------------------------------------------------------------------------------


def wheel_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the flywheel in section and from the side, with its dimensions, as large as fits."""
    narrator = _flywheel_narrator(solution, style)
    sizes, width = narrator.sizes, style.width(style.sizes.column)
    if sizes is None:
        text = MachineAccount(narrator, SHEET).not_needed
        return paragraph(text, style.text(style.sizes.text), width)
    scales = [choose_scale((sizes.diameter, 0.0), (0.7 * width * k, 1.0)) for k in LARGER]
    ways = (_wheel(narrator, sizes, scale, style) for scale in dict.fromkeys(scales))
    return make_alternatives(ways, grows=True)


def _wheel(
    narrator: MachineNarrator, sizes: FlywheelSizes, scale: float, style: BlockStyle
) -> Block:
    """Return the flywheel at a scale, m/mm."""
    height = style.text(style.sizes.text)
    radius, half = sizes.diameter / 2.0 / scale, sizes.width / 2.0 / scale
    bore = sizes.bore / 2.0 / scale or 0.12 * radius
    middle = complex(radius + half + 14.0, 0.0)
    items: list[Item] = [Arc(middle, radius), Arc(middle, bore)]
    for sign in (1.0, -1.0):
        ring = (complex(-half, sign * bore), complex(half, sign * bore),
                complex(half, sign * radius), complex(-half, sign * radius))  # fmt: skip
        items += [Stroke(ring, Pen.MAIN, closed=True), *hatch(ring)]
    if sizes.shape is WheelShape.DISC:
        items += [Stroke((complex(x, -bore), complex(x, bore)), Pen.MAIN) for x in (-half, half)]
    items += axis_line(complex(-half - 8.0), complex(half + 8.0))
    items += centre_lines(middle, radius)
    corners = complex(-half, -radius), complex(half, -radius), complex(-half, radius)
    sides = [("b", corners[0], corners[1], -12j, sizes.width)]
    if sizes.bore:  # inside, beside the other diameter
        low = complex(-half, -bore)
        sides.append(("D_{1}", low, low.conjugate(), -10.0 + 0j, sizes.bore))
    sides.append(("D", corners[0], corners[2], -10.0 * len(sides) + 0j, sizes.diameter))
    for letter, one, two, out, size in sides:
        value = narrator.notation.short(1000.0 * size, 4)  # mm, without unit, as on a drawing
        items += _dimension(letter, value, one, two, out, height)
    picture = Picture(tuple(items), ink_bounds(items))
    lines = paragraph(
        "; ".join(narrator.size_lines(sizes)), height, max(picture.width, radius), align="centre"
    )
    title = style.entry.title or narrator.texts["sizes"][sizes.shape.value]
    return named(picture, title, [narrator.scale("l", scale, "m"), lines], style)


def _dimension(
    letter: str, value: str, one: complex, two: complex, out: complex, size: float
) -> list[Item]:
    """Return a dimension with its number: above a level line, left of an upright one."""
    tag, number = dimension_tag(letter), typeset(value, size)
    place, angle = (one + two) / 2.0 + out, 0.0
    if abs(out.real) > abs(out.imag):
        # Off the middle, where the axes are.
        place, angle = place + complex(-number.descent - 1.2, 0.3 * abs(two - one)), 90.0
    elif abs(two - one) > number.width:
        place += 1j * (number.descent + 1.4)  # above the arrowheads
    else:  # beside the arrowheads
        place = two + out + complex(7.0 + number.width / 2.0, 1.2)
    items = dimension(one, two, out, tag=tag)
    return [*items, *number.at(place, anchor="centre", angle=angle, label=tag)]


_TIMES, _HIGH = (1.0, 0.8, 1.2, 1.5), (0.7, 0.9)  # sizes of the diagrams that are tried
_POINTS, _MAX_POINTS = 400, 4000  # of a curve, and of one of many turns


def _runup_narrator(solution: Solution, language: Language) -> MachineNarrator:
    machine = solution.problem.machine
    if machine is None or (machine.motor is None and machine.brake is None):
        raise LayoutError(
            "{}: a layout with a run-up needs a motor or a brake in [machine]. For "
            "example: motor = {{ kloss = {{ M_max = 60, s_k = 0.2, n_sync = 150 }} }}.",
            solution.problem.name,
        )
    return MachineNarrator(drawing_of(flywheel_of(solution), solution.profile), language)


def run_up_text(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return "Дано" and "Определить", the motor, run-up, steady motion and stop with numbers."""
    narrator = _runup_narrator(solution, style.language)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    lines = map(Paragraph, run_up_lines(narrator))
    nodes: list[TextNode] = [Caption(style.entry.title or narrator.texts.run_up), *lines]
    before = stated(narrator.given_facts(), narrator.texts.run_up_wanted, style)
    return Column([before, *blocks_of(nodes, height, width=width)], gap=3.0)


def run_up_tables(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return run-up and stop by even times, one table beside another."""
    narrator = _runup_narrator(solution, style.language)
    height = style.text(min(style.sizes.text, 3.5))
    tables = []
    for title, course in courses(narrator):
        columns = [
            TableColumn(head, tuple(cells), unit=unit, min_width=14.0)
            for head, unit, cells in course_columns(course, narrator)
        ]
        tables.append(table_block(columns, TableForm(height, row_height=2.0 * height), title=title))
    return Row(tables, gap=14.0)


def run_up_diagrams(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the motor's characteristic, the speed over time and angle, and that of the stop.

    They are as large as the paper permits.
    """
    narrator = _runup_narrator(solution, style.language)
    width = 0.82 * style.width(style.sizes.column)
    sizes = ((k * width, high * k * width) for k in _TIMES for high in _HIGH)
    return make_alternatives(_diagrams(narrator, style, size) for size in sizes)


def _diagrams(narrator: MachineNarrator, style: BlockStyle, size: Box) -> Block:
    run, texts = run_up_of(narrator.flywheel), narrator.texts
    blocks = _characteristic(narrator, style, size)
    if run.machine.motor is not None and run.failure is None:
        course = run.run_up
        time, _, speeds = course.rows(_count(course))
        started = _SpeedCurve(texts.by_time, "t", "s", time, speeds)
        blocks.append(_speed_curve_diagram(narrator, style, size, started))
        turned = np.linspace(course.rotation[0], course.rotation[-1], _count(course))
        speeds = course.at(turned)[0]
        speeds[0] = 0.0
        by_angle = _SpeedCurve(texts.by_angle, "φ", "deg", np.degrees(turned), speeds)
        blocks.append(_speed_curve_diagram(narrator, style, size, by_angle))
    if run.stop is not None:
        time, _, speeds = run.stop.rows(_count(run.stop))
        stopped = _SpeedCurve(texts.stop_diagram, "t", "s", time, speeds)
        blocks.append(_speed_curve_diagram(narrator, style, size, stopped))
    rows = [Row(blocks[k : k + 2], gap=16.0, align="bottom") for k in range(0, len(blocks), 2)]
    return Column(rows, gap=12.0)


def _count(motion: TimeMotion) -> int:
    """Return the number of points of a curve, sufficient to show every turn."""
    return min(max(_POINTS, int(4.0 * motion.rotation[-1])), _MAX_POINTS)


def _numbered(symbol: str, largest: float, width: float, style: BlockStyle) -> Abscissae:
    """Return an axis from 0 with round numbers beyond the largest, which is at ``width`` mm."""
    step = series_near(largest / 8.0, up=True)
    count = ceil(largest / step + 0.3) + 1
    numbers = tuple(style.language.notation.number(trimmed(k * step, 6)) for k in range(count))
    return Abscissae(symbol, tuple(width * k * step / largest for k in range(count)), numbers)


class _SpeedCurve(Struct, frozen=True):
    """Speed, 1/s, over time or angle: the abscissae with their symbol and unit."""

    title: str
    symbol: str
    unit: str
    abscissae: Reals
    speeds: Reals


# no messages: tags of items
def _speed_curve_diagram(
    narrator: MachineNarrator, style: BlockStyle, size: Box, curve: _SpeedCurve
) -> Block:
    """Return the speed over time or angle as a diagram."""
    width, height = size
    per_mm = choose_scale((0.0, float(np.max(curve.speeds))), (1.0, height))
    largest = float(curve.abscissae[-1])
    places = tuple(
        complex(width * x / largest, y / per_mm)
        for x, y in zip(curve.abscissae, curve.speeds, strict=True)
    )
    axis = _numbered(f"{curve.symbol}, {narrator.unit(curve.unit)}", largest, width, style)
    picture = diagram_picture(
        Diagram(
            axis,
            Ordinates(f"ω, {narrator.unit('1/s')}", per_mm, narrator.notation),
            # ripples of many turns would run together
            [Curve("", (places,), Pen.MAIN if len(places) <= 2 * _POINTS else Pen.THIN)],
        ),
        letter_height=style.letter,
        name=f"speed over {curve.symbol}",
    )
    scale = Scale("mu_ω", per_mm, "1/s")
    return ViewBlock(
        named(picture, curve.title, [narrator.scale("ω", per_mm, "1/s")], style), "diagram", scale
    )


def _characteristic(narrator: MachineNarrator, style: BlockStyle, size: Box) -> list[Block]:
    """Return the motor's moment over the speed, and the mean moment of resistance."""
    motor = narrator.flywheel.machine.motor
    if motor is None:
        return []
    width, height = size
    speeds = np.linspace(0.0, motor.idle, _POINTS)
    moments = np.array([motor.at(speed) for speed in speeds.tolist()])
    mean = narrator.flywheel.constant
    per_mm = choose_scale((0.0, max(float(moments.max()), mean)), (1.0, height))
    curve = tuple(
        complex(width * x / motor.idle, y / per_mm) for x, y in zip(speeds, moments, strict=True)
    )
    level = (complex(0.0, mean / per_mm), complex(0.7 * width, mean / per_mm))
    picture = diagram_picture(
        Diagram(
            _numbered(f"ω, {narrator.unit('1/s')}", motor.idle, width, style),
            Ordinates(f"M, {narrator.unit('N·m')}", per_mm, narrator.notation),
            [
                Curve(narrator.letter("motor moment"), (curve,)),
                Curve(narrator.moment, (level,), Pen.HIDDEN),
            ],
        ),
        letter_height=style.letter,
        name="motor",
    )
    scale = Scale("mu_M", per_mm, "N·m")
    told = [narrator.scale("M", per_mm, "N·m")]
    return [ViewBlock(named(picture, narrator.texts.motor_diagram, told, style), "diagram", scale)]
