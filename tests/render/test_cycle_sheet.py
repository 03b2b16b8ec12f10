"""The sheet of the forces over the cycle: diagrams and polar diagrams to scale, marks, table."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest
from cases import each, some
from click.testing import CliRunner
from doors import (
    AXIS,
    DIAGRAM_CURVE as CURVE,
    HODOGRAPH,
    POLAR_POLE as POLE,
    Arc,
    CycleForces,
    Disc,
    Drawing,
    Fill,
    LayoutError,
    ModelProblem as Problem,
    PlanMethodError,
    ProblemError,
    Severity,
    Solution,
    Stroke,
    Text,
    View,
    cli,
    cycle_balance_columns,
    drawn_forces,
    get_language,
    inspect,
    kinematics_sheets,
    paper_of,
    polar_groups,
    shipped,
    statics_of,
)
from loaded import loaded_problem
from msgspec.structs import replace
from worked import drawn_sheets, path_of, problem_of

from planmethod import loads

RU = get_language("ru")

TURN = tuple(30.0 * k for k in range(12))
PRESS = tuple(98.918918918919 + phi for phi in TURN)
SHEETS = (
    ("levers/task12", TURN),
    ("levers/six-link", tuple(140.0 + 5.0 * k for k in range(9))),
    ("press/press-stone", PRESS),
    ("press/press", PRESS),
)


def draw(problem: Problem, positions: Sequence[float]) -> Drawing:
    (sheet,) = kinematics_sheets(problem, positions=positions, layout="forces-cycle")
    return sheet


@cache
def drawn(name: str, positions: tuple[float, ...]) -> Drawing:
    return draw(problem_of(name), positions)


def errors(sheet: Drawing) -> list[str]:
    return [f.code for f in inspect(sheet) if f.severity is Severity.ERROR]


def within(place: complex, view: View) -> bool:
    x0, y0, x1, y1 = view.box
    return x0 <= place.real <= x1 and y0 <= place.imag <= y1


def curves(sheet: Drawing, view: View) -> list[list[complex]]:
    """Return the curves of a diagram as one list of points each."""
    found: dict[str, list[complex]] = {}
    for item in sheet.items:
        if isinstance(item, Stroke) and item.tag.startswith(CURVE) and within(item.points[0], view):
            found.setdefault(item.tag, []).extend(item.points)
    return list(found.values())


def origin(sheet: Drawing, view: View) -> complex:
    """Return where the axes of a diagram cross: one begins there, the other goes through."""
    axes = [
        item.points
        for item in sheet.items
        if isinstance(item, Stroke) and item.tag == AXIS and within(item.points[0], view)
    ]
    return max(axes, key=lambda points: abs(points[1].real - points[0].real))[0]


def per_mm(sheet: Drawing, view: View, letter: str) -> float:
    """Return the text of a scale under a diagram."""
    texts = [t for t in sheet.items if isinstance(t, Text) and within(t.at, view)]
    rows = {round(t.at.imag, 1) for t in texts if t.text.startswith("μ")}
    written = [
        "".join(t.text for t in sorted(texts, key=lambda t: t.at.real) if abs(t.at.imag - y) < 3.5)
        for y in sorted(rows)
    ]
    found = re.search(rf"μ{letter}=([\d,]+)(мм)?", "".join(written).replace(" ", ""))
    assert found is not None, written
    value = float(found[1].replace(",", "."))
    return 1.0 / value if found[2] else value


@pytest.mark.dear
@pytest.mark.parametrize(("name", "positions"), SHEETS)
def test_the_sheet_passes_the_norm_control(name: str, positions: tuple[float, ...]) -> None:
    sheet = drawn(name, positions)
    assert errors(sheet) == []
    kinds = [view.kind for view in sheet.views]
    plans = len(statics_of(Solution(problem_of(name), positions=positions)).board.plans)
    assert kinds == ["position", "balance", *["reactions"] * plans, "hodograph"]


@pytest.mark.parametrize(("name", "positions"), SHEETS)
def test_the_diagrams_are_to_scale(name: str, positions: tuple[float, ...]) -> None:
    sheet, solution = drawn(name, positions), Solution(problem_of(name), positions=positions)
    statics = statics_of(solution)
    for number, view in enumerate(v for v in sheet.views if v.kind in ("balance", "reactions")):
        zero, lines = origin(sheet, view), curves(sheet, view)
        scale, turn = view.per_mm, per_mm(sheet, view, "φ")
        if view.kind == "balance":
            wanted = [statics.balance.tolist()]
        else:
            links = statics.board.plans[number - 1].links
            sizes = [np.abs(joint.force) for joint in statics.reactions if joint.on in links]
            wanted = [size.tolist() for size in sizes if size.max() > 1e-6]
        places = _across(positions, turn)
        for values in wanted:
            best = min(
                max(
                    abs(value / scale - _height(line, zero, x))
                    for x, value in zip(places, values, strict=True)
                )
                for line in lines
            )
            assert best < (0.2 if view.kind == "reactions" else 1e-6)


def _height(line: list[complex], zero: complex, x: float) -> float:
    """Return the height of a curve at an abscissa where it has a point, mm."""
    gaps = [abs(place.real - zero.real - x) for place in line]
    return line[gaps.index(min(gaps))].imag - zero.imag


def _across(positions: Sequence[float], per: float) -> list[float]:
    return [(phi - positions[0]) / per for phi in positions]


@pytest.mark.parametrize(("name", "positions"), SHEETS)
def test_the_marks_are_the_results_of_both_methods_on_paper(
    name: str, positions: tuple[float, ...]
) -> None:
    sheet = drawn(name, positions)
    views = shipped("forces-cycle").views_for(paper_of(sheet), len(positions))
    # The scheme has grown into the sheet: arms are measured on it.
    (scheme,) = (v for v in sheet.views if v.kind == "position")
    problem = problem_of(name)
    problem = replace(problem, scales=replace(problem.scales, mu_l=scheme.per_mm))
    solution = Solution(problem, positions=positions, views=views)
    hand = drawn_forces(statics_of(solution))
    (view,) = (v for v in sheet.views if v.kind == "balance")
    zero = origin(sheet, view)
    rings = [i.centre for i in sheet.items if isinstance(i, Arc) and i.tag == "mark ring"]
    crosses = [
        (i.points[0] + i.points[1]) / 2
        for i in sheet.items
        if isinstance(i, Stroke) and i.tag == "mark cross"
    ][::2]
    turn = per_mm(sheet, view, "φ")
    for found, values in ((rings, hand.read("balance")), (crosses, hand.read("lever"))):
        assert len(found) == len(positions) + 1  # the first one is in the legend
        for place, x, value in zip(found[1:], _across(positions, turn), values, strict=True):
            assert place - zero == pytest.approx(complex(x, value / view.per_mm), abs=1e-6)


@pytest.mark.parametrize(("name", "positions"), SHEETS)
def test_the_polar_diagrams_are_the_reactions(name: str, positions: tuple[float, ...]) -> None:
    """Every ray is a vector of its reaction, at a scale that is written under the diagram."""
    sheet, solution = drawn(name, positions), Solution(problem_of(name), positions=positions)
    cycle = CycleForces(solution)
    poles = [i.centre for i in sheet.items if isinstance(i, Disc) and i.tag == POLE]
    groups = polar_groups(cycle)
    assert len(poles) == len(groups)
    rays = [i.points for i in sheet.items if isinstance(i, Stroke) and i.tag == "hodograph vector"]
    (view,) = (v for v in sheet.views if v.kind == "hodograph")
    for pole, (first, *_) in zip(poles, groups, strict=True):
        own = [head - tail for tail, head in rays if abs(tail - pole) < 1e-9]
        forces = [complex(f) for f in cycle.joints[first].force]
        per = max(map(abs, forces)) / max(map(abs, own))
        drawn_forces = [force for force in forces if abs(force) / per > 0.6]
        assert [ray * per for ray in own] == pytest.approx(drawn_forces, rel=1e-9)
        lines = [
            i.points
            for i in sheet.items
            if isinstance(i, Stroke) and i.tag == f"{HODOGRAPH} {first}"
        ]
        for force in forces:
            places = [place for line in lines for place in line]
            assert min(abs(p - pole - force / per) for p in places) < 1e-6
        assert within(pole, view)


def test_equal_and_opposite_reactions_share_a_diagram() -> None:
    """Link 4 of the press has no mass: the forces at its ends are equal and opposite."""
    cycle = CycleForces(Solution(problem_of("press/press"), positions=PRESS))
    names = [[f"{cycle.joints[k].on}{cycle.joints[k].by}" for k in g] for g in polar_groups(cycle)]
    assert ["43", "45"] in names
    texts = " ".join(i.text for i in drawn("press/press", PRESS).items if isinstance(i, Text))
    assert "шарниры N, B" in texts.replace("\u00a0", " ")


def test_the_table_has_every_position() -> None:
    sheet = drawn("levers/task12", TURN)
    texts = [i.text for i in sheet.items if isinstance(i, Text)]
    statics = statics_of(Solution(problem_of("levers/task12"), positions=TURN))
    for value in np.abs(statics.balance):
        assert f"{value:.1f}".replace(".", ",") in texts
    assert "планы сил" in texts and "рычаг" in texts


def test_a_diagram_that_cannot_be_drawn_is_reported() -> None:
    with pytest.raises(LayoutError, match="needs several positions"):
        draw(problem_of("press/press"), [98.9])
    with pytest.raises(ProblemError, match="forces cannot be analysed"):
        draw(problem_of("linkages/ex3"), TURN)
    run = CliRunner().invoke(
        cli, ["sheet", str(path_of("press/press")), "--layout", "forces-cycle", "--phi", "98.9"]
    )
    assert run.exit_code == 2 and "--phi 0:360:30" in run.output


def test_chords_are_named() -> None:
    from planmethod import loads

    text = path_of("press/press").read_text("utf-8")
    start = text.index("[loads.force]")
    end = text.index('interpolation = "linear"') + len('interpolation = "linear"')
    values = [0, 0, 0, 730, 350.4] + [0] * 7
    table = f'[loads.force]\nover = "position"\nvalues = {values}'
    text = (text[:start] + table + text[end:]).replace(
        "phi = 218.918918918919", "phi = { from = 98.918918918919, count = 12 }"
    )
    sheet = draw(loads(text, name="press"), PRESS)
    texts = " ".join(i.text for i in sheet.items if isinstance(i, Text)).replace("\u00a0", " ")
    assert RU.sheets.chords in texts and errors(sheet) == []


@each("seed", range(some(8, few=2)))
def test_random_mechanisms(seed: int) -> None:
    """All dyads and driving sliders, every link loaded: a sheet without errors."""
    problem, _ = loaded_problem(seed)
    drive = problem.drive
    size = max((length for _, _, length in problem.lengths), default=0.1)
    step = 2.0 if drive.is_crank else 0.01 * size
    asked = [float(drive.positions[0]) + k * step for k in range(4)]
    try:
        _ = statics_of(Solution(problem, positions=asked)).balance
    except PlanMethodError:
        pytest.skip("the mechanism does not reach so far from its pose")
    sheet = draw(problem, asked)
    assert errors(sheet) == []
    assert any(isinstance(item, Fill) for item in sheet.items)


FAST = """
title = "A rocker that turns fast for a moment"
[frame]
O = [0, 0]
C = [0, -0.44]
[links.1]
points = ["O", "A"]
OA = 0.4
[links.2]
points = ["A"]
slides = { on = "3", along = "CB" }
[links.3]
points = ["C", "B", "S3"]
CB = 1.36
S3 = { on = "CB", at = 0.68 }
[driver]
link = "1"
phi = 0
omega = -20
[dynamics]
gravity = 9.81
[dynamics.links.3]
mass = 11
centre = "S3"
inertia = 0.1
"""


def test_the_difference_has_the_digits_of_its_operands() -> None:
    """If the balance has a narrow peak, its numbers have different decimals."""
    solution = Solution(loads(FAST, name="fast"), positions=TURN)
    (_, plans, lever, off, *_) = cycle_balance_columns(solution, range(12), get_language("ru"))

    def decimals(text: str) -> int:
        return len(text.partition(",")[2])

    cells = list(zip(*([cell.text for cell in c.cells] for c in (plans, lever, off)), strict=True))
    assert len({decimals(one) for one, _, _ in cells}) > 1
    for one, two, difference in cells:
        assert decimals(difference) <= min(decimals(text) for text in (one, two))


@pytest.mark.dear
def test_a_line_of_a_point_breaks_off_where_it_runs_away() -> None:
    """Between two of the positions points run to 140 m: the sheet shows the positions."""
    problem, _ = loaded_problem(9106)
    (sheet,) = kinematics_sheets(problem, layout="forces-cycle")
    assert sheet.width == 841.0
    lines = [i for i in sheet.items if isinstance(i, Stroke) and i.tag == "trajectory F"]
    heights = [p.imag for line in lines for p in line.points]
    assert heights and max(heights) - min(heights) < 300.0


@pytest.mark.dear
@pytest.mark.parametrize(("name", "wide"), [("machines/compressor", 594.0), ("press/press", 841.0)])
def test_a_smaller_paper_keeps_the_letters_of_the_positions(name: str, wide: float) -> None:
    """The crank of the press is small beside its mechanism: on A2 names do not fit at its pin."""
    (sheet,) = drawn_sheets(name, layout="forces-cycle")
    assert sheet.width == wide


def test_sheets_are_small_where_no_block_is_left_out() -> None:
    """A short calculation of forces takes A2, with diagrams as large as fit."""
    (sheet,) = drawn_sheets("machines/engine", layout="forces-cycle")
    assert (sheet.width, sheet.has_omissions) == (594.0, False)
    (forces,) = drawn_sheets("machines/engine", layout="forces")
    assert (forces.width, forces.has_omissions) == (594.0, False)
    (larger,) = drawn_sheets("levers/task-38", layout="forces")
    assert (larger.width, larger.has_omissions) == (841.0, False)  # A2 would leave plans out
