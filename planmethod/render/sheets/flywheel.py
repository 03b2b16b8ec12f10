"""Blocks of the flywheel's sheet: diagrams as constructed, table, the wheel (лист 3)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import pairwise
from math import degrees

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.errors import LayoutError
from planmethod.note.document import Caption, Formula, Paragraph
from planmethod.note.narrate.forces.statement import like_line
from planmethod.note.narrate.given import point_name
from planmethod.note.narrate.machine import MachineTeller
from planmethod.note.narrate.reduction import ReductionTeller
from planmethod.problem.load_records import Load, Over, SizeTable
from planmethod.problem.machine_records import WheelShape
from planmethod.render.ink.drawing import Arc, Disc, Item, Pen, Span, Stroke
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Picture, Row, paragraph
from planmethod.render.layout.nodes import TextNode, blocks_of
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.pictures.diagram import Abscissae, Curve, Ordinates, diagram_picture
from planmethod.render.pictures.flywheel import construction_picture
from planmethod.render.sheets.composer import Viewed
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.results import table_width
from planmethod.render.sheets.texts import stated
from planmethod.render.sheets.views import named
from planmethod.render.symbols import arrowhead, hatch
from planmethod.solved.forces.loads import external
from planmethod.solved.machine.drawing import FlywheelDrawing, drawing_of
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of
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


def _teller(solution: Solution, manner: Manner) -> MachineTeller:
    return MachineTeller(_drawing(solution), manner.words)


# Texts -------------------------------------------------------------------------------------------


def statement_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return "Дано" of the machine, and "Определить"."""
    tell = _teller(solution, manner)
    asked = manner.words.sheets.wanted.format(wanted=tell.wanted())
    return stated(tell.given(), asked, manner)


def calculation_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the formulas of the construction, the exact flywheel, and their difference."""
    tell = _teller(solution, manner)
    height, width = manner.text(manner.sizes.text), manner.width(manner.sizes.column)
    nodes: list[TextNode] = [
        Caption(manner.entry.title or tell.said.calculation),
        *map(Formula, tell.formulas()),
        *map(Paragraph, tell.conclusions()),
        *map(Formula, tell.power_formulas()),
        *map(Paragraph, tell.motor_choice()),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=2.5)


# Diagrams of the construction --------------------------------------------------------------------


class _DiagramsViewed(Viewed, frozen=True):
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


def diagrams_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return the constructed diagrams of moment, work, energy, inertia and those of the method."""
    drawing, tell = _drawing(solution), _teller(solution, manner)
    picture = construction_picture(drawing, tell, manner.letter)
    scales, made = drawing.scales, drawing.made
    told = "; ".join(
        (
            tell.scale("M", scales.moment, "N·m"),
            tell.scale("φ", degrees(scales.phi), "deg"),
            tell.scale("A", scales.work, "J"),
            tell.scale("T", scales.work, "J"),
            tell.scale("J", scales.inertia, "kg·m²"),
        )
    )
    block = named(picture, manner.entry.title or tell.by_method("diagrams"), [told], manner)
    ends = [drawing.exact.point(name)[0] for name in (made.upper, made.lower, made.pole)]
    upper, lower, pole = (complex(end) for end in ends)
    foot = complex(drawing.exact.point(made.axes["M"].origin)[0])
    level = complex(upper.real, lower.imag)  # of A and B along the axis, as KL is
    spans = ((str(made.segment), level, upper), ("H", pole, foot))
    scale, mark = Scale("mu_M", scales.moment, "N·m"), made.letters[0]
    return _DiagramsViewed(block, "flywheel", scale, spans, upper, mark)


# Further diagrams --------------------------------------------------------------------------------


def speed_diagram(solution: Solution, indices: Sequence[int], manner: Manner) -> Viewed:
    """Return the deviation of the speed of the steady motion from the mean as a diagram."""
    tell, flywheel = _teller(solution, manner), flywheel_of(solution)
    _, height = _diagram_room(manner)
    at = np.linspace(0.0, flywheel.cycle, 721)
    omega = flywheel.speeds(np.append(at[:-1], 0.0))[0] - flywheel.middle_speed
    per_mm = choose_scale((0.0, float(np.ptp(omega))), (1.0, height))
    across = _drawing(solution).scales.phi
    width = flywheel.cycle / across
    places = tuple(complex(t / across, y / per_mm) for t, y in zip(at, omega, strict=True))
    count = flywheel.machine.count
    marks = tuple(width * k / count for k in range(count + 1))
    unit = tell.unit("1/s")
    picture = diagram_picture(
        Abscissae("φ", marks, tuple(map(str, flywheel.turn.numbers(count)))),
        Ordinates(f"ω − {tell.letter('mean speed')}, {unit}", per_mm, tell.say),
        [Curve("", (places,))],
        letter_height=manner.letter,
        name="speed",
    )
    scale = Scale("mu_ω", per_mm, "1/s")
    told = [f"{tell.scale('ω', per_mm, '1/s')}; {tell.scale('φ', degrees(across), 'deg')}"]
    return Viewed(named(picture, manner.entry.title or tell.said.speed, told, manner),
                  "diagram", scale)  # fmt: skip


def _diagram_room(manner: Manner) -> tuple[float, float]:
    column = manner.width(manner.sizes.column)
    return 0.75 * column, 0.22 * column


def load_diagrams(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return diagrams of variable forces over the strokes of their points, side by side.

    A load that repeats another one's diagram later is listed under that diagram.
    """
    tell, flywheel = _teller(solution, manner), flywheel_of(solution)
    width, height = _diagram_room(manner)
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    blocks: list[Block] = []
    turned = _fine(flywheel)
    moved = flywheel.turn.at(turned)
    for number, load in enumerate(dynamics.loads):
        if not isinstance(load, Load) or not isinstance(load.size, SizeTable) or load.size.like:
            continue
        (force,) = (one.force for one in external(moved, dynamics, load.link)
                    if one.name == load.name)  # fmt: skip
        way = flywheel.turn.course(load.at)
        along = (moved.points[load.at].place * way.conjugate()).real
        stroke = float(np.ptp(along))
        # from the end at or nearer to position 0
        start = along.min() if along[0] - along.min() <= along.max() - along[0] else along.max()
        if load.size.over is Over.STROKES:  # from the top dead centre
            start = (flywheel.turn.stroke_of(number).start * way.conjugate()).real
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
            Abscissae(f"s_{{{name}}}", (0.0, stroke / mu_s), ("0", "H")),
            Ordinates(f"{load.name}, {tell.unit('N')}", per_mm, tell.say),
            [Curve("", (places,))],
            letter_height=manner.letter,
            name=f"load {load.name}",
        )
        metres = f"{tell.say.found(stroke)} {tell.unit('m')}"
        told = "; ".join(
            (
                tell.said.over_stroke.format(stroke=metres),
                tell.scale("F", per_mm, "N"),
                tell.scale("s", mu_s, "m"),
            )
        )
        title = manner.entry.title or tell.said.load.format(name=load.name, point=name)
        later = [like_line(one, manner.words) for one in dynamics.loads
                 if isinstance(one.size, SizeTable) and one.size.like == load.name]  # fmt: skip
        blocks.append(named(picture, title, [told, *later], manner))
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


def machine_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the quantities reduced to the crank, work, energy and speed by positions."""
    tell = _teller(solution, manner)
    height = manner.text(min(manner.sizes.text, 3.5))
    columns = [
        TableColumn(head, tuple(cells), unit=unit, least=8.0)
        for head, unit, cells in tell.columns()
    ]
    title = manner.entry.title or tell.said.table
    table = table_block(columns, height, max_width=table_width(manner), leading=2, title=title,
                        row_height=max(6.0, 2.0 * height))  # fmt: skip
    note = tell.said.lever_agrees.format(lever=tell.letter("moment by lever"))
    return Column([table, paragraph(note, height, table.width)], gap=3.0)


def moment_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the reduced moment term by term: forces, velocities, angles."""
    reduction = ReductionTeller(_teller(solution, manner))
    formulas = [reduction.moment_formula()]
    return _reduced(reduction.moments(), formulas, reduction.tell.said.moments, manner)


def energy_table(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the energies of the links and the reduced moment of inertia."""
    reduction = ReductionTeller(_teller(solution, manner))
    formulas, title = reduction.energy_formulas(), reduction.tell.said.energies
    return _reduced(reduction.energy_columns(), formulas, title, manner)


def _reduced(
    columns: Sequence[tuple[str, str, list[str]]],
    formulas: Iterable[str],
    title: str,
    manner: Manner,
) -> Block:
    """Return a table with the formulas of its columns above it."""
    height = manner.text(min(manner.sizes.text, 3.5))
    made = [TableColumn(head, tuple(cells), unit=unit, least=8.0) for head, unit, cells in columns]
    width = table_width(manner)
    table = table_block(made, height, max_width=width, leading=1, row_height=max(6.0, 2.0 * height))
    head: list[TextNode] = [Caption(manner.entry.title or title), *map(Formula, formulas)]
    return Column([*blocks_of(head, height, width=max(table.width, 100.0)), table], gap=2.5)


# The wheel ---------------------------------------------------------------------------------------


def wheel_view(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the flywheel in section and from the side, with its dimensions."""
    tell = _teller(solution, manner)
    sizes = tell.sizes
    height = manner.text(manner.sizes.text)
    if sizes is None:
        return paragraph(tell.conclusions()[0], height, manner.width(manner.sizes.column))
    scale = choose_scale((sizes.diameter, 0.0), (0.3 * manner.width(manner.sizes.column), 1.0))
    radius, half = sizes.diameter / 2.0 / scale, sizes.width / 2.0 / scale
    bore = sizes.bore / 2.0 / scale or 0.12 * radius
    middle = complex(radius + half + 16.0, 0.0)
    items: list[Item] = [Arc(middle, radius), Arc(middle, bore)]
    for sign in (1.0, -1.0):
        ring = (complex(-half, sign * bore), complex(half, sign * bore),
                complex(half, sign * radius), complex(-half, sign * radius))  # fmt: skip
        items += [Stroke(ring, Pen.MAIN, closed=True), *hatch(ring)]
    if sizes.shape is WheelShape.DISC:
        items += [Stroke((complex(x, -bore), complex(x, bore)), Pen.MAIN) for x in (-half, half)]
    reach = radius + 4.0
    items += [
        Stroke((complex(-half - 8.0, 0.0), complex(half + 8.0, 0.0)), Pen.AXIS),
        Stroke((middle - reach, middle + reach), Pen.AXIS),
        Stroke((middle - 1j * reach, middle + 1j * reach), Pen.AXIS),
    ]
    size = max(3.5, height)
    items += _measure(complex(-half, -radius), complex(half, -radius), -9j, "b", size)
    if sizes.bore:
        aside = -10.0 - 2.5 * size  # inside, beside the other diameter
        items += _measure(complex(-half, -radius), complex(-half, radius), aside, "D", size)
        items += _measure(complex(-half, -bore), complex(-half, bore), -10.0, "D_{1}", size)
    else:
        items += _measure(complex(-half, -radius), complex(-half, radius), -10.0, "D", size)
    picture = Picture(tuple(items), ink_bounds(items))
    told = ["; ".join(tell.size_lines(sizes))]
    lines = paragraph(told[0], height, manner.width(manner.sizes.column))
    title = manner.entry.title or tell.said["sizes"][sizes.shape.value]
    return named(picture, title, [tell.scale("l", scale, "m"), lines], manner)


def _measure(one: complex, two: complex, aside: complex, letter: str, size: float) -> list[Item]:
    """Return a dimension with its extension lines; ``aside`` is its offset."""
    beyond = aside / abs(aside) * 2.0
    tail, head = one + aside, two + aside
    way = (head - tail) / abs(head - tail)
    outside = abs(head - tail) < 12.0
    items: list[Item] = [
        Stroke((one, tail + beyond), Pen.THIN),
        Stroke((two, head + beyond), Pen.THIN),
        Stroke((tail - 7.0 * way, head + 7.0 * way) if outside else (tail, head), Pen.THIN),
        *arrowhead(tail, way if outside else -way, length=3.0),
        *arrowhead(head, -way if outside else way, length=3.0),
    ]
    text, middle = typeset(letter, size), (tail + head) / 2.0
    if abs(way.imag) > 0.5:  # left of a vertical dimension, off its middle, where axes are
        place = middle + complex(-text.width - 1.2, 0.25 * abs(head - tail))
    elif outside:
        place = head + complex(8.5, -size / 2.0)
    else:
        place = middle + complex(-text.width / 2.0, 1.2)
    return [*items, *text.at(place)]
