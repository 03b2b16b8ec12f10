"""Blocks of the run-up sheet: the motor, diagrams of run-up and stop, tables (разбег и останов)."""

# no messages: tags of items

from __future__ import annotations

from collections.abc import Sequence
from math import ceil

import numpy as np

from planmethod.construct.scale import Scale, choose_scale, series_near
from planmethod.errors import LayoutError
from planmethod.note.document import Caption, Paragraph
from planmethod.note.narrate.machine import MachineNarrator, course_columns, courses, run_up_lines
from planmethod.note.numbers import trimmed
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Pen
from planmethod.render.layout.block import Block, Column, Row, make_alternatives
from planmethod.render.layout.nodes import TextNode, blocks_of
from planmethod.render.layout.tables import TableColumn, table_block
from planmethod.render.pictures.diagram import Abscissae, Curve, Ordinates, diagram_picture
from planmethod.render.sheets.composer import ViewBlock
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.texts import stated
from planmethod.render.sheets.views import named
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import flywheel_of
from planmethod.solved.machine.runup import TimeMotion, run_up_of
from planmethod.solved.reading import Reals
from planmethod.solved.sheet_estimate import Box
from planmethod.solved.solution import Solution

_TIMES, _HIGH = (1.0, 0.8, 1.2, 1.5), (0.7, 0.9)  # sizes of the diagrams that are tried
_POINTS, _MAX_POINTS = 400, 4000  # of a curve, and of one of many turns


def _make_narrator(solution: Solution, language: Language) -> MachineNarrator:
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
    narrator = _make_narrator(solution, style.language)
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    lines = map(Paragraph, run_up_lines(narrator))
    nodes: list[TextNode] = [Caption(style.entry.title or narrator.texts.run_up), *lines]
    before = stated(narrator.given_facts(), narrator.texts.run_up_wanted, style)
    return Column([before, *blocks_of(nodes, height, width=width)], gap=3.0)


def run_up_tables(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return run-up and stop by even times, one table beside another."""
    narrator = _make_narrator(solution, style.language)
    height = style.text(min(style.sizes.text, 3.5))
    tables = []
    for title, course in courses(narrator):
        columns = [
            TableColumn(head, tuple(cells), unit=unit, min_width=14.0)
            for head, unit, cells in course_columns(course, narrator)
        ]
        tables.append(table_block(columns, height, title=title, row_height=2.0 * height))
    return Row(tables, gap=14.0)


def run_up_diagrams(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the motor's characteristic, the speed over time and angle, and that of the stop.

    They are as large as the paper permits.
    """
    narrator = _make_narrator(solution, style.language)
    width = 0.82 * style.width(style.sizes.column)
    sizes = ((k * width, high * k * width) for k in _TIMES for high in _HIGH)
    return make_alternatives(_diagrams(narrator, style, size) for size in sizes)


def _diagrams(narrator: MachineNarrator, style: BlockStyle, size: Box) -> Block:
    run, texts = run_up_of(narrator.flywheel), narrator.texts
    blocks = _characteristic(narrator, style, size)
    if run.machine.motor is not None and run.failure is None:
        course = run.run_up
        time, _, speeds = course.rows(_count(course))
        blocks.append(
            _speed_diagram(narrator, style, size, texts.by_time, ("t", "s"), time, speeds)
        )
        turned = np.linspace(course.rotation[0], course.rotation[-1], _count(course))
        speeds = course.at(turned)[0]
        speeds[0] = 0.0
        blocks.append(
            _speed_diagram(
                narrator, style, size, texts.by_angle, ("φ", "deg"), np.degrees(turned), speeds
            )
        )
    if run.stop is not None:
        time, _, speeds = run.stop.rows(_count(run.stop))
        blocks.append(
            _speed_diagram(narrator, style, size, texts.stop_diagram, ("t", "s"), time, speeds)
        )
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


def _speed_diagram(
    narrator: MachineNarrator,
    style: BlockStyle,
    size: Box,
    title: str,
    over: tuple[str, str],
    abscissae: Reals,
    speeds: Reals,
) -> Block:
    """Return the speed over time or angle as a diagram."""
    width, height = size
    per_mm = choose_scale((0.0, float(np.max(speeds))), (1.0, height))
    largest = float(abscissae[-1])
    places = tuple(
        complex(width * x / largest, y / per_mm) for x, y in zip(abscissae, speeds, strict=True)
    )
    symbol, unit = over
    axis = _numbered(f"{symbol}, {narrator.unit(unit)}", largest, width, style)
    picture = diagram_picture(
        axis,
        Ordinates(f"ω, {narrator.unit('1/s')}", per_mm, narrator.notation),
        # ripples of many turns would run together
        [Curve("", (places,), Pen.MAIN if len(places) <= 2 * _POINTS else Pen.THIN)],
        letter_height=style.letter,
        name=f"speed over {symbol}",
    )
    scale = Scale("mu_ω", per_mm, "1/s")
    return ViewBlock(
        named(picture, title, [narrator.scale("ω", per_mm, "1/s")], style), "diagram", scale
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
        _numbered(f"ω, {narrator.unit('1/s')}", motor.idle, width, style),
        Ordinates(f"M, {narrator.unit('N·m')}", per_mm, narrator.notation),
        [
            Curve(narrator.letter("motor moment"), (curve,)),
            Curve(narrator.moment, (level,), Pen.HIDDEN),
        ],
        letter_height=style.letter,
        name="motor",
    )
    scale = Scale("mu_M", per_mm, "N·m")
    told = [narrator.scale("M", per_mm, "N·m")]
    return [ViewBlock(named(picture, narrator.texts.motor_diagram, told, style), "diagram", scale)]
