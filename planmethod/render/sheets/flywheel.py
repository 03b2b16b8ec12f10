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
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.narrate.reduction import ReductionNarrator
from planmethod.note.narrate.statement import point_name
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
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
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


def _make_narrator(solution: Solution, style: BlockStyle) -> MachineNarrator:
    return MachineNarrator(_drawing(solution), style.language)


# Texts -------------------------------------------------------------------------------------------


def statement_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return "Дано" of the machine, and "Определить"."""
    narrator = _make_narrator(solution, style)
    asked = style.language.sheets.wanted.format(wanted=narrator.unknowns())
    return stated(narrator.given_facts(), asked, style)


def calculation_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the formulas of the construction, the exact flywheel, and their difference."""
    narrator = _make_narrator(solution, style)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    nodes: list[TextNode] = [
        Caption(style.entry.title or narrator.texts.calculation),
        *map(Formula, narrator.formulas()),
        *map(Paragraph, narrator.conclusions()),
        *map(Formula, narrator.power_formulas()),
        *map(Paragraph, narrator.motor_choice()),
    ]
    return Column(list(blocks_of(nodes, height, width=width)), gap=2.5)


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
    drawing, narrator = _drawing(solution), _make_narrator(solution, style)
    picture = construction_picture(drawing, narrator, style.letter)
    scales, made = drawing.scales, drawing.construction
    text = "; ".join(
        (
            narrator.scale("M", scales.moment, "N·m"),
            narrator.scale("φ", degrees(scales.phi), "deg"),
            narrator.scale("A", scales.work, "J"),
            narrator.scale("T", scales.work, "J"),
            narrator.scale("J", scales.inertia, "kg·m²"),
        )
    )
    block = named(picture, style.entry.title or narrator.by_method("diagrams"), [text], style)
    ends = [drawing.exact.point(name)[0] for name in (made.upper, made.lower, made.pole)]
    upper, lower, pole = (complex(end) for end in ends)
    foot = complex(drawing.exact.point(made.axes["M"].origin)[0])
    level = complex(upper.real, lower.imag)  # of A and B along the axis, as KL is
    spans = ((str(made.segment), level, upper), ("H", pole, foot))
    scale, mark = Scale("mu_M", scales.moment, "N·m"), made.letters[0]
    return _DiagramsViewBlock(block, "flywheel", scale, spans, upper, mark)


# Further diagrams --------------------------------------------------------------------------------


def speed_diagram(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> ViewBlock:
    """Return the deviation of the speed of the steady motion from the mean as a diagram."""
    narrator, flywheel = _make_narrator(solution, style), flywheel_of(solution)
    _, height = _diagram_size(style)
    at = np.linspace(0.0, flywheel.cycle, 721)
    omega = flywheel.speeds(np.append(at[:-1], 0.0))[0] - flywheel.middle_speed
    per_mm = choose_scale((0.0, float(np.ptp(omega))), (1.0, height))
    across = _drawing(solution).scales.phi
    width = flywheel.cycle / across
    places = tuple(complex(t / across, y / per_mm) for t, y in zip(at, omega, strict=True))
    count = flywheel.machine.count
    marks = tuple(width * k / count for k in range(count + 1))
    unit = narrator.unit("1/s")
    picture = diagram_picture(
        Abscissae("φ", marks, tuple(map(str, flywheel.turn.numbers(count)))),
        Ordinates(f"ω − {narrator.letter('mean speed')}, {unit}", per_mm, narrator.notation),
        [Curve("", (places,))],
        letter_height=style.letter,
        name="speed",
    )
    scale = Scale("mu_ω", per_mm, "1/s")
    told = [f"{narrator.scale('ω', per_mm, '1/s')}; {narrator.scale('φ', degrees(across), 'deg')}"]
    return ViewBlock(named(picture, style.entry.title or narrator.texts.speed, told, style),
                  "diagram", scale)  # fmt: skip


def _diagram_size(style: BlockStyle) -> tuple[float, float]:
    column = style.width(style.sizes.column)
    return 0.75 * column, 0.22 * column


def load_diagrams(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return diagrams of variable forces over the strokes of their points, side by side.

    A load that repeats another one's diagram later is listed under that diagram.
    """
    narrator, flywheel = _make_narrator(solution, style), flywheel_of(solution)
    width, height = _diagram_size(style)
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
        way = flywheel.turn.main_direction(load.at)
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
            Ordinates(f"{load.name}, {narrator.unit('N')}", per_mm, narrator.notation),
            [Curve("", (places,))],
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
    narrator = _make_narrator(solution, style)
    height = style.text(min(style.sizes.text, 3.5))
    columns = [
        TableColumn(head, tuple(cells), unit=unit, min_width=8.0)
        for head, unit, cells in narrator.columns()
    ]
    title = style.entry.title or narrator.texts.table
    table = table_block(columns, height, max_width=table_width(style), leading=2, title=title,
                        row_height=max(6.0, 2.0 * height))  # fmt: skip
    note = narrator.texts.lever_agrees.format(lever=narrator.letter("moment by lever"))
    return Column([table, paragraph(note, height, table.width)], gap=3.0)


def moment_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the reduced moment term by term: forces, velocities, angles."""
    reduction = ReductionNarrator(_make_narrator(solution, style))
    formulas = [reduction.moment_formula()]
    return _reduced(reduction.moments(), formulas, reduction.narrator.texts.moments, style)


def energy_table(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the energies of the links and the reduced moment of inertia."""
    reduction = ReductionNarrator(_make_narrator(solution, style))
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
    table = table_block(made, height, max_width=width, leading=1, row_height=max(6.0, 2.0 * height))
    head: list[TextNode] = [Caption(style.entry.title or title), *map(Formula, formulas)]
    return Column([*blocks_of(head, height, width=max(table.width, 100.0)), table], gap=2.5)


# The wheel ---------------------------------------------------------------------------------------


def wheel_view(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the flywheel in section and from the side, with its dimensions."""
    narrator = _make_narrator(solution, style)
    sizes = narrator.sizes
    height = style.text(style.sizes.text)
    if sizes is None:
        return paragraph(narrator.conclusions()[0], height, style.width(style.sizes.column))
    scale = choose_scale((sizes.diameter, 0.0), (0.3 * style.width(style.sizes.column), 1.0))
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
    told = ["; ".join(narrator.size_lines(sizes))]
    lines = paragraph(told[0], height, style.width(style.sizes.column))
    title = style.entry.title or narrator.texts["sizes"][sizes.shape.value]
    return named(picture, title, [narrator.scale("l", scale, "m"), lines], style)


def _measure(one: complex, two: complex, offset: complex, letter: str, size: float) -> list[Item]:
    """Return a dimension with its extension lines; ``offset`` is its offset."""
    beyond = offset / abs(offset) * 2.0
    tail, head = one + offset, two + offset
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
