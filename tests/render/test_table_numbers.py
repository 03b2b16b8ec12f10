"""The numbers of the tables of sheets follow from the solution: sizes, signs, senses, places."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cache
from math import pi, radians, sin, tan
from typing import TypeAlias

import numpy as np
import numpy.typing as npt
import pytest
from doors import (
    MOTION_KINDS,
    Block,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    Column,
    PlanKind,
    PrintedNumbers,
    Quantity,
    Row,
    Sizes,
    Solution,
    TableCell,
    TablePart,
    clearest_position,
    decimals_of_step,
    drafting_of,
    drawn_forces,
    flywheel_of,
    get_language,
    lever_beside_plans,
    maker_of,
    ruler_steps,
    run_up_of,
    size_label,
    statics_of,
    transfers_of,
)
from worked import problem_of

from benchmarks.generator import random_problem
from planmethod import loads
from planmethod.note.tables.errors import motion_series, relative_series

EN = get_language("en")
THREE = (20.0, 140.0, 260.0)
PRESS = (99.0, 150.0, 219.0)

Numbers: TypeAlias = npt.NDArray[np.float64]
NUMBER = re.compile(r"-?[\d.]+(?:e-?\d+)?")


@cache
def solution_of(name: str, positions: tuple[float, ...] | None = None) -> Solution:
    kind, _, seed = name.partition("/")
    if kind == "random":
        return Solution(loads(random_problem(int(seed))[0], name=kind), positions=positions)
    return Solution(problem_of(name), positions=positions)


class Told:
    """A printed column: numbers, negative with a clockwise arrow, and half of the last digit."""

    def __init__(self, head: str, cells: Sequence[TableCell]) -> None:
        self.head = head
        texts = [cell.text.partition(" ± ")[0].rstrip("*").replace("−", "-") for cell in cells]
        self.texts = texts
        values = [float(text) if NUMBER.fullmatch(text) else np.nan for text in texts]
        senses = [-1.0 if cell.sense == -1 else 1.0 for cell in cells]
        self.values: Numbers = np.array(values) * senses
        self.arrows = [cell.sense for cell in cells]
        self.room: Numbers = np.array(
            [0.501 * 10.0 ** -len(text.partition(".")[2]) for text in texts]
        )

    def assert_are(self, values: npt.ArrayLike, share: float = 1e-9) -> None:
        """Assert that its numbers are these, rounded; ``share`` is of the largest."""
        wanted = np.asarray(values, dtype=float)
        room = self.room[: len(wanted)] + share * float(np.nanmax(np.abs(wanted), initial=0.0))
        told = self.values[: len(wanted)]
        assert np.all((np.abs(told - wanted) <= room) | np.isnan(told)), (self.head, told, wanted)
        assert np.isfinite(told).any(), self.head


def parts_of(block: Block) -> Iterator[TablePart]:
    if isinstance(block, TablePart):
        yield block
    elif isinstance(block, Column | Row):
        for one in block.blocks:
            yield from parts_of(one)


@cache
def columns_of(
    kind: str, name: str, positions: tuple[float, ...] | None = None, sigma: bool | None = None
) -> list[Told]:
    """Return the columns of the tables of a block of a sheet, in order."""
    solution = solution_of(name, positions)
    manner = BlockStyle(
        BlockSpec(kind), Sizes(5.0, 5.0, 5.0, 240.0), 3000.0, BlockOptions(EN, sigma=sigma)
    )
    block = maker_of(kind)(solution, tuple(range(len(solution.positions))), manner)
    sources = [column.source for part in parts_of(block) for column in part.columns]
    return [Told(source.head, source.cells) for source in sources]


def heads_of(columns: Sequence[Told]) -> dict[str, Told]:
    heads = {column.head: column for column in columns}
    assert len(heads) == len(columns)
    return heads


# Motion ------------------------------------------------------------------------------------------


def test_each_exact_value_has_its_reading_and_the_difference_in_per_cent() -> None:
    solution = solution_of("linkages/ex3", THREE)
    quantities = {one.symbol: one for one in quantities_of(solution)}
    relative = {one.symbol: one for one in relative_series(solution, PlanKind.VELOCITY)}
    columns = columns_of("measured-results", "linkages/ex3", THREE)[2:]
    shown, compared = clearest_position(solution, (0, 1, 2)), 0
    printed = calculated_at(solution, shown)
    for exact, read, off in zip(columns, columns[1:], columns[2:], strict=False):
        if not read.head.endswith("′"):
            continue
        symbol = exact.head.partition(" = ")[0]
        if symbol in relative:
            values, found = relative[symbol].exact, relative[symbol].read
        else:
            quantity = quantities[symbol]
            values, found = solution.exact(quantity), solution.read_off(quantity.label)
        assert read.head == f"{symbol}′" and off.head == "Δ"
        exact.assert_are(values)
        found = np.array(found)
        if symbol in printed:  # one number, alike in the calculation and in the table
            assert abs(found[shown]) == pytest.approx(printed[symbol], rel=0.01)
            found[shown] = np.copysign(printed[symbol], found[shown])
        read.assert_are(found)
        told = np.abs(read.values)  # the difference is that of the printed number
        off.assert_are(100.0 * (told - np.abs(values)) / np.abs(values))
        compared += int(np.sum(off.values < 0.0))
    assert compared > 3  # the reading is less than the exact value, with a minus sign


def test_readings_at_one_scale_have_equal_decimals_that_a_ruler_reads() -> None:
    """Position 0 of the accelerations has a plan at a scale of its own."""
    angles = (-67.0601, 227.94, 257.94)
    solution = solution_of("random/98201", angles)
    heads = {c.head: c for c in columns_of("measured-results", "random/98201", angles)
             if c.head.endswith("′")}  # fmt: skip
    compared = scales = 0
    for quantity in quantities_of(solution):
        told = heads.get(f"{quantity.symbol}′")
        if told is None or quantity.size is None:
            continue
        places = dict[int, set[int]]()
        for i, text in enumerate(told.texts):
            step = float(ruler_steps(solution, quantity.size)[i])
            if NUMBER.fullmatch(text):
                places.setdefault(decimals_of_step(step), set()).add(len(text.partition(".")[2]))
                if not quantity.kind.is_number:  # a segment times its scale
                    assert float(text) / step == pytest.approx(round(float(text) / step))
                    compared += 1
        assert all(len(some) == 1 for some in places.values()), (told.head, told.texts)
        scales += len(places) > 1
    assert compared > 15 and scales


def calculated_at(solution: Solution, index: int) -> dict[str, float]:
    """Return the measured results that the calculation of a position prints, by their symbols."""
    construction = solution.construction
    steps = {step.out: step for step in construction.program.steps}
    numbers = PrintedNumbers(solution, steps, index)
    names = {one.symbol: one.size for one in quantities_of(solution) if one.size is not None}
    segments = construction.kinematics.velocity.segments
    for vector in construction.plan(PlanKind.VELOCITY).vectors:
        names.setdefault(vector.symbol, segments.known((vector.tail, vector.head)))
    found = {symbol: numbers.of(name) for symbol, name in names.items()}
    return {symbol: one.value for symbol, one in found.items() if one.is_measured}


def quantities_of(solution: Solution) -> list[Quantity]:
    return [one for some in solution.quantities(*MOTION_KINDS).values() for one in some]


def turned_by(name: str, *angles: float) -> tuple[float, ...]:
    """Return positions of the crank by their angles from that of the file, degrees."""
    first = solution_of(name).problem.drive.positions[0]
    return tuple(float(first + angle) for angle in angles)


NEAR_DEAD = "random/97001", (30.0, 60.0, 90.0, 120.0, 150.0)
"""A mechanism and angles, at the last of which it is next to a dead position."""


def test_what_is_large_next_to_a_dead_position_makes_nothing_zero_elsewhere() -> None:
    """In the last position accelerations are a thousand million times larger than in the others."""
    name, angles = NEAR_DEAD
    positions = turned_by(name, *angles)
    solution = solution_of(name, positions)
    assert solution.extents.drawable.tolist() == [True] * 4 + [False]
    told = columns_of("measured-results", name, positions)
    for point in "BDEFHG":
        size = np.abs(solution.points[point].acceleration)[:4]
        (k,) = (k for k, one in enumerate(told) if one.head.partition(" = ")[0] == f"a_{{{point}}}")
        assert size.min() > 9.0
        told[k].assert_are(size)
        assert told[k].values[:4].all()
        assert told[k + 1].values[:4] == pytest.approx(size, rel=0.12)
    for series in motion_series(solution, *MOTION_KINDS):
        shown = np.array(series.displayed(series.exact, range(5)))
        assert np.array_equal(shown != 0.0, np.abs(series.exact) > 1e-6)


def test_a_position_that_is_not_drawn_has_only_its_number_and_place_in_the_table() -> None:
    name, angles = NEAR_DEAD
    told = columns_of("measured-results", name, turned_by(name, *angles))
    whole = [column for column in told if "—" not in column.texts]
    assert whole[:2] == told[:2] and len(whole) == 2
    for column in told:
        assert "—" not in column.texts[:4]
        assert column in whole or column.texts[4] == "—"


def test_relative_velocities_that_are_laid_off_are_not_among_the_measured_ones() -> None:
    """Links 1 and 3 turn alike: v_ED and v_HF are known before the plan is drawn."""
    name, angles = NEAR_DEAD
    positions = turned_by(name, *angles)
    found = {
        one.symbol: one.exact
        for one in relative_series(solution_of(name, positions), PlanKind.VELOCITY)
    }
    assert np.ptp(found["v_{ED}"]) == pytest.approx(0.0, abs=1e-9)
    heads = {column.head for column in columns_of("measured-results", name, positions)}
    assert {symbol for symbol in found if symbol not in heads} == {"v_{ED}", "v_{HF}"}
    assert not {"v_{ED}′", "v_{HF}′"} & heads and "v_{DD2}′" in heads


def test_a_reading_that_is_lost_in_its_error_is_told_by_that_error() -> None:
    """In position 2 of this mechanism small accelerations are differences of long vectors."""
    name = "random/97004"
    positions = turned_by(name, 0.0, 45.0, 120.0)
    solution = solution_of(name, positions)
    columns = columns_of("measured-results", name, positions)
    assert solution.read_off("epsilon_5")[2] > 0.0 > solution.exact("epsilon_5")[2]
    labels = {one.symbol: one.label for one in quantities_of(solution)}
    lost = 0
    for exact, read, off in zip(columns, columns[1:], columns[2:], strict=False):
        label = labels.get(exact.head.partition(" = ")[0])
        if off.head != "Δ" or label is None:
            continue
        sigma = drafting_of(solution).spreads[label].sigma
        for k, text in enumerate(read.texts):
            if text.startswith("±"):
                assert sigma[k] > abs(solution.exact(label)[k]) and off.texts[k] == ">100"
                assert float(text[1:]) == pytest.approx(float(sigma[k]), rel=0.15)
                assert read.arrows[k] is None
                lost += 1
            else:
                assert read.arrows[k] == exact.arrows[k] and abs(off.values[k]) < 50.0
    assert lost >= 3


@pytest.mark.parametrize("kind", ["results", "transfer-table"])
def test_one_position_has_rows_of_exact_values_readings_and_differences(kind: str) -> None:
    solution = solution_of("linkages/ex3")
    transfers = transfers_of(solution)
    assert transfers is not None
    lead, *columns = columns_of(kind, "linkages/ex3", None, True)
    assert lead.texts == ["exact", "read", "Δ, %", "±σ"]
    if kind == "results":
        every = quantities_of(solution)
        found = {q.symbol: (solution.exact(q), solution.read_off(q.label)) for q in every}
    else:
        found = {
            q.symbol: (transfers.exact(q), transfers.read_off(q)) for q in transfers.quantities
        }
    printed = calculated_at(solution, 0) if kind == "results" else {}
    for column in columns:
        exact, read = (float(one[0]) for one in found[column.head])
        if column.head in printed:
            assert abs(read) == pytest.approx(printed[column.head], rel=0.01)
            read = float(np.copysign(printed[column.head], read))
        wanted = [exact, read, 100.0 * (abs(read) / abs(exact) - 1.0)]
        for row, value in enumerate(wanted):
            told = column.values[row]
            assert told == pytest.approx(value, abs=column.room[row] + 1e-9), (column.head, row)
    assert {"ε_{4}", "ω_{4}"} <= {*found} or {"u_{41}", "ε_{q4}"} <= {*found}
    assert len(columns) == 14


def test_transfer_functions_are_velocities_over_that_of_the_crank_in_every_position() -> None:
    solution = solution_of("linkages/ex3", THREE)
    omega = solution.problem.drive.rate
    heads = heads_of(columns_of("transfer-table", "linkages/ex3", THREE))
    for point in "BDE":
        moving, point = solution.points[point], solution.problem.lettered(point)
        heads[f"v_{{q{point}}}"].assert_are(np.abs(moving.velocity) / abs(omega))
        heads[f"a_{{q{point}}}"].assert_are(np.abs(moving.acceleration) / omega**2)
    for link in "234":
        heads[f"u_{{{link}1}}"].assert_are(solution.links[link].omega / omega)
        heads[f"ε_{{q{link}}}"].assert_are(solution.links[link].epsilon / omega**2)


# Forces ------------------------------------------------------------------------------------------


def test_reactions_over_the_cycle_have_their_sizes_and_directions_in_every_position() -> None:
    solution = solution_of("press/press", PRESS)
    statics = statics_of(solution)
    columns = columns_of("cycle-reactions", "press/press", PRESS)
    heads = {column.head: column for column in columns}
    for joint in statics.reactions:
        index = f"{{{joint.on}{joint.by}}}".replace("frame", "0")
        heads[f"F_{index}"].assert_are(np.abs(joint.force))
        heads[f"φ_{index}"].assert_are(np.degrees(np.angle(joint.force)) % 360.0)


def test_the_balance_has_the_arrow_of_its_sense_and_differs_by_lever_less_plans() -> None:
    solution = solution_of("press/press", PRESS)
    statics = statics_of(solution)
    balance, plans, lever, apart, share, sigma = columns_of(
        "cycle-reactions", "press/press", PRESS
    )[-6:]
    both = lever_beside_plans(statics)
    assert both is not None
    assert [one.head for one in (balance, plans, lever)] == ["M_{b}", "force plans", "lever"]
    for column, values in ((balance, statics.balance), (plans, both.exact), (lever, both.read)):
        column.assert_are(values)
        assert column.arrows == [1 if value > 0.0 else -1 for value in values.tolist()]
    assert {*balance.arrows} == {1, -1}
    off = np.abs(both.read) - np.abs(both.exact)
    apart.assert_are(off, share=0.15)  # the difference of the numbers beside it
    share.assert_are(100.0 * off / np.abs(both.exact), share=0.15)
    np.testing.assert_array_equal(np.sign(apart.values), np.sign(off))
    expected = drawn_forces(statics).discrepancy_sigma
    assert expected is not None
    sigma.assert_are(expected)


@pytest.mark.parametrize("name", ["press/press", "levers/task12"])
def test_the_reactions_of_a_position_are_exact_read_and_turned_as_the_statics_have_them(
    name: str,
) -> None:
    solution = solution_of(name)
    statics = statics_of(solution)
    columns = columns_of("reactions", name, None, True)
    heads = {column.head: column for column in columns[::-1]}
    forces = np.array([complex(joint.force[0]) for joint in statics.reactions])
    read = [float(drawn_forces(statics).read(size_label(j))[0]) for j in statics.reactions]
    heads["F_{ij}, N"].assert_are(np.abs(forces), share=1e-3)
    heads["read, N"].assert_are(np.abs(read), share=2e-3)
    heads["φ_{ij}, deg"].assert_are(np.degrees(np.angle(forces)) % 360.0)
    if "M_{ij}, N·m" in heads:
        moments = [float(joint.moment[0]) for joint in statics.reactions]
        heads["M_{ij}, N·m"].assert_are(moments)
    both = lever_beside_plans(statics)
    assert both is not None
    exact, plans, lever, share = columns[-4:]
    for column, value in ((exact, statics.balance), (plans, both.exact), (lever, both.read)):
        assert column.values[0] == pytest.approx(float(value[0]), abs=column.room[0]), column.head
        assert column.arrows[0] == (1 if float(value[0]) > 0.0 else -1)
    off = abs(float(both.read[0])) / abs(float(both.exact[0])) - 1.0
    assert share.values[0] == pytest.approx(100.0 * abs(off), abs=share.room[0])


def test_friction_is_the_reaction_by_the_radius_or_by_the_sine_of_the_angle() -> None:
    """In the first correction it is the friction of the reactions without friction."""
    solution = solution_of("machines/rubbing-crank")
    heads = heads_of(columns_of("friction-table", "machines/rubbing-crank"))
    radius = heads["ρ, mm"].values / 1000.0
    angle = heads["φ, °"].values
    first, _, last = (heads[f"R{index}, N"].values for index in ("_{0}", "_{1}", ""))
    arm = np.where(np.isnan(radius), [tan(radians(a)) for a in angle], radius)
    heads["Friction_{1}"].assert_are(first * arm, share=1e-3)
    arm = np.where(np.isnan(radius), [sin(radians(a)) for a in angle], radius)
    heads["Friction"].assert_are(last * arm, share=1e-3)
    exact = {joint.joint: abs(complex(joint.force[0])) for joint in statics_of(solution).reactions}
    assert first[0] == pytest.approx(exact["A"], rel=1e-3)


# Cycle and machine -------------------------------------------------------------------------------


def test_the_table_of_the_turn_has_the_path_its_derivatives_and_the_motion() -> None:
    name = "press/flywheel"
    heads = heads_of(columns_of("turn-table", name))
    phi = heads["φ"].values
    solution = solution_of(name, tuple(phi.tolist()))
    omega = solution.problem.drive.rate
    turned, moving = radians(phi[1] - phi[0]), solution.points["B"]
    heads["v_{q}"].assert_are(heads["v_{B}"].values / omega, share=1e-3)
    heads["a_{q}"].assert_are(heads["a_{B}"].values / omega**2, share=1e-3)
    along = np.sign(heads["v_{q}"].values)
    wanted = np.abs(moving.velocity) * along
    heads["v_{B}"].assert_are(wanted, share=1e-4)
    path, gain, second = (heads[head].values for head in ("s_{B}", "v_{q}", "a_{q}"))
    for one, two in ((path, gain), (gain, second)):
        found = (np.roll(one, -1) - np.roll(one, 1)) / (2.0 * turned)
        assert np.max(np.abs(found - two)) < 0.12 * np.max(np.abs(two))
    assert np.sum(gain > 0.0) > 3 < np.sum(gain < 0.0)


def test_the_deviations_by_every_way_have_a_mean_below_the_largest() -> None:
    columns = columns_of("deviations", "press/flywheel")
    ways, _, most, mean, ruled, ruled_mean, sigma = columns
    assert ways.texts[-2:] == ["from the plans"] * 2 or len({*ways.texts}) == 3
    for above, below in ((most, mean), (ruled, ruled_mean)):
        there = np.isfinite(above.values)
        assert np.all(below.values[there] < above.values[there])
    by_curve = [text == "by the curve" for text in ways.texts]
    assert np.all(np.isnan(sigma.values[by_curve]))


def test_the_table_of_the_machine_keeps_the_equation_of_motion() -> None:
    name = "press/flywheel"
    flywheel = flywheel_of(solution_of(name))
    heads = heads_of(columns_of("machine-table", name))
    moment, work, inertia, slope, omega = (
        heads[head].values for head in ("M_{r}", "A_{r}", "J_{r}", "dJ/dφ", "ω")
    )
    heads["M^{Zh}"].assert_are(moment, share=1e-4)
    whole = flywheel.steady_inertia + inertia
    energy = whole * omega**2 / 2.0
    heads["ΔT"].assert_are(energy - energy[0], share=2e-3)
    turned = 2.0 * pi * np.arange(len(moment)) / len(moment)
    heads["ΔT"].assert_are(flywheel.constant * turned - work, share=2e-3)
    pushed = flywheel.constant - moment - omega**2 * slope / 2.0
    heads["ε"].assert_are(pushed / whole, share=2e-3)
    found = (np.roll(inertia, -1) - np.roll(inertia, 1)) / (2.0 * turned[1])
    assert np.corrcoef(found, slope)[0, 1] > 0.95
    assert np.max(np.abs(omega / flywheel.middle_speed - 1.0)) < flywheel.machine.delta


def test_the_reduced_moment_is_the_sum_of_powers_over_the_speed_of_the_crank() -> None:
    name = "press/flywheel"
    solution = solution_of(name)
    heads = heads_of(columns_of("moment-table", name))
    omega, dynamics = solution.problem.drive.rate, solution.problem.dynamics
    assert dynamics is not None
    masses = {link: mass.mass for link, mass in dynamics.masses.items()}
    forces: dict[str, tuple[float | Numbers, Numbers, str]] = {
        "P": (heads["P"].values, heads["v_{B}"].values, "α_{P}"),
        "G3": (masses["3"] * 9.81, heads["v_{S3}"].values, "α_{G3}"),
        "G5": (masses["5"] * 9.81, heads["v_{B}"].values, "α_{G5}"),
    }
    total = np.zeros(len(heads["P"].values))
    for index, (force, speed, angle) in forces.items():
        power = np.nan_to_num(force * speed * np.cos(np.radians(heads[angle].values)))
        heads[f"M_{{{index}}}"].assert_are(-power / abs(omega), share=2e-3)
        total += heads[f"M_{{{index}}}"].values
    heads["M_{r}"].assert_are(total, share=1e-3)
    heads[r"\frac{P}{P_{max}}"].assert_are(heads["P"].values / np.max(heads["P"].values))
    at = solution_of(name, tuple(columns_of("machine-table", name)[1].values.tolist()))
    heads["v_{S3}"].assert_are(np.abs(at.points["S3"].velocity), share=1e-4)


def test_the_energies_of_the_links_are_those_of_their_motion() -> None:
    name = "press/flywheel"
    heads = heads_of(columns_of("energy-table", name))
    at = solution_of(name, tuple(columns_of("machine-table", name)[1].values.tolist()))
    dynamics, omega = at.problem.dynamics, at.problem.drive.rate
    assert dynamics is not None
    for link in "35":
        mass = dynamics.masses[link]
        assert mass.centre is not None
        energy = mass.mass * np.abs(at.points[mass.centre].velocity) ** 2 / 2.0
        energy = energy + (mass.inertia or 0.0) * at.links[link].omega ** 2 / 2.0
        heads[f"T_{{{link}}}"].assert_are(energy, share=1e-4)
    heads["T"].assert_are(sum(heads[f"T_{{{k}}}"].values for k in "135"), share=1e-3)
    heads["J_{r}"].assert_are(2.0 * heads["T"].values / omega**2, share=1e-3)


def test_the_run_up_and_the_stop_go_by_even_times_with_the_speed_of_the_course() -> None:
    columns = columns_of("run-up-tables", "machines/compressor")
    run = run_up_of(flywheel_of(solution_of("machines/compressor")))
    assert run.stop is not None
    for (time, phi, omega), course in zip(
        (columns[:3], columns[3:]), (run.run_up, run.stop), strict=True
    ):
        assert [one.head for one in (time, phi, omega)] == ["t", "φ", "ω"]
        assert np.ptp(np.diff(time.values)) < 3.0 * time.room[-1]
        count = len(time.values)
        assert time.values[-1] == pytest.approx(float(course.time[-1]), abs=time.room[-1])
        for k in range(1, count - 1):
            found = np.interp(time.values[k], course.time, course.rotation)
            assert phi.values[k] == pytest.approx(np.degrees(found), abs=4.0)
            speed = np.interp(radians(phi.values[k]), course.rotation, course.omega)
            assert omega.values[k] == pytest.approx(float(speed), abs=0.35)


def test_counterweights_and_the_force_of_inertia_are_those_of_the_masses() -> None:
    """After full balancing the force is zero; before, it is minus the sum of m·a."""
    name = "machines/balanced-crank"
    columns = columns_of("balancing-tables", name)
    links, moment, radius, mass, _ = columns[:5]
    moment.assert_are(radius.values * mass.values, share=1e-3)
    heads = heads_of(columns[5:])
    solution = solution_of(name, tuple(heads["φ_{1}"].values.tolist()))
    dynamics = solution.problem.dynamics
    assert dynamics is not None
    force = -sum(
        one.mass * solution.points[one.centre].acceleration
        for one in dynamics.masses.values()
        if one.centre is not None
    )
    for index, values in (("^{x}", force.real), ("^{y}", force.imag), ("", np.abs(force))):
        heads[f"F{index}_{{0}}"].assert_are(values)
        heads[f"F{index}"].assert_are(0.0 * values)
    # about the pin A the slider and the rod, about O all of it
    told = dict(zip(links.texts, moment.values.tolist(), strict=True))
    about = 3.6 * 0.16 + 2.8 * 0.36
    assert told["2"] == pytest.approx(about, rel=1e-3)
    weight = dict(zip(links.texts, mass.values.tolist(), strict=True))["2"]
    assert told["1"] == pytest.approx(1.2 * 0.04 + (3.6 + 2.8 + weight) * 0.12, rel=1e-3)
