"""Signs, pens and letters of a sheet against the motion itself."""

from __future__ import annotations

from math import radians

import numpy as np
import pytest
from cases import each
from doors import (
    RATES,
    Locus,
    Pen,
    PlanKind,
    Solution,
    Stroke,
    VectorKind,
    construction_items,
    extreme_construction,
    get_language,
    plan_picture,
    plan_spans,
    result_columns,
)
from msgspec.structs import replace
from worked import SIX, drawn_sheets, problem_of

# Results ------------------------------------------------------------------------------------------


@each("name", ["linkages/ex3", "linkages/ex1", "levers/task12"])
def test_the_sign_beside_an_angular_velocity_is_the_way_the_link_turns_next(name: str) -> None:
    """By how the link lies a little later, not by its rate."""
    problem = problem_of(name)
    first = float(problem.drive.positions[0])
    step = 1e-3 * np.sign(problem.drive.rate)
    before, now, after = (
        Solution(problem, positions=[first + k * step, first + k * step + 30.0]) for k in (-1, 0, 1)
    )
    seen = 0
    for sigma in (False, True):
        here = Solution(problem, positions=[first])
        for column in result_columns(here, [0], get_language("en"), sigma=sigma):
            letter, _, link = column.head.rstrip("}").partition("_{")
            if letter not in ("ω", "ε") or link not in now.links:
                continue
            one, two, three = np.unwrap(
                [radians(float(s.links[link].phi_deg[0])) for s in (before, now, after)]
            )
            turn = float(three - one)
            if letter == "ε":
                own = (float(s.links[link].omega[0]) for s in (before, after))
                rates = list(own)
                turn = rates[1] - rates[0]
            cell = column.cells[0]
            if cell.text == "0" or abs(turn) < 1e-9 * (1 + abs(two)):
                continue
            assert cell.sense == np.sign(turn), (column.head, cell)
            if sigma:
                assert column.cells[1].sense in (cell.sense, 0)  # the value read has the same sense
            seen += 1
    assert seen >= 2


def test_the_rows_of_a_single_position_are_exact_read_difference_and_error() -> None:
    here = Solution(problem_of("linkages/ex3"))
    said = get_language("en").sheets
    head, *columns = result_columns(here, [0], get_language("en"), sigma=True)
    assert [cell.text for cell in head.cells] == [said.exact, said.read, "Δ, %", "±σ"]
    for column in columns:
        exact, seen, off, sigma = (cell.text.rstrip("*") for cell in column.cells)
        if "—" in (off, seen) or exact == "0":
            continue
        due = 100 * (float(seen) - float(exact)) / float(exact)
        room = 0.06 + 100 * 0.6 * 10.0 ** -len(exact.partition(".")[2]) / float(exact)
        assert float(off.replace("−", "-")) == pytest.approx(due, abs=room), column.head
        assert float(sigma) < 0.5 * float(exact)


# Plans --------------------------------------------------------------------------------------------


@each("name", SIX)
def test_absolute_vectors_are_thick_and_components_thin(name: str) -> None:
    solution = Solution(problem_of(name))
    parts = {VectorKind.NORMAL.value, VectorKind.TANGENTIAL.value, VectorKind.CORIOLIS.value}
    seen = set()
    for kind in RATES:
        for item in plan_picture(solution, kind, 0).items:
            if not isinstance(item, Stroke) or abs(item.points[-1] - item.points[0]) < 12.0:
                continue  # any short vector is thin
            if item.tag in parts:
                assert item.pen is Pen.COMPONENT, item.tag
            elif item.tag == VectorKind.ABSOLUTE.value:
                assert item.pen is Pen.RESULTANT, item.tag
            seen.add(item.tag)
    assert VectorKind.ABSOLUTE.value in seen
    assert seen & parts


@each(
    "name, positions, own",
    [
        ("levers/task-49", [30.0, 150.0, 270.0], False),
        ("levers/task-49", [30.0, 150.0, 270.0], True),
        ("linkages/ex3", [20.0], False),
    ],
)
def test_a_segment_represents_its_velocity_at_its_own_multiple_of_the_scale(
    name: str, positions: list[float], own: bool
) -> None:
    """Length times scale over magnification is the size of the vector, in SI.

    Plans have the common scale but those out of proportion, or with ``own`` each its own one.
    """
    problem = problem_of(name)
    problem = replace(problem, scales=replace(problem.scales, own=own))
    solution = Solution(problem, positions=positions)
    shares, wanted = set(), set()
    for kind in RATES:
        for index in range(len(positions)):
            pole = 100 + 50j
            plan = solution.construction.plan(kind)
            mu = solution.plan_scale(kind, index).per_mm
            wanted.add(round(solution.scales[kind].per_mm / mu, 6))
            for span in plan_spans(solution, kind, index, pole):
                if span.start != pole:
                    continue
                paper = solution.paper
                vectors = [
                    vector
                    for vector in plan.vectors
                    if vector.tail == plan.pole
                    and abs(complex(paper.point(vector.head)[index]) + pole - span.end) < 1e-9
                ]
                sizes = [abs(complex(solution.si.vector(v.tail, v.head)[index])) for v in vectors]
                true = span.length * solution.scales[kind].per_mm / span.magnification
                assert any(abs(true - size) < 1e-9 * (1 + size) for size in sizes), span.name
                shares.add(round(span.magnification, 6))
    assert shares == wanted
    assert (len(shares) > 1) == (name == "levers/task-49")


def test_an_enlarged_segment_represents_its_vector_at_its_multiple() -> None:
    problem = problem_of("levers/task-57")
    solution = Solution(problem)
    (sheet,) = drawn_sheets("levers/task-57")[:1]
    true = {kind.value: [] for kind in PlanKind}  # type: ignore[var-annotated]
    for kind in RATES:
        for vector in solution.construction.plan(kind).vectors:
            true[kind.value].append(abs(complex(solution.si.vector(vector.tail, vector.head)[0])))
    seen = 0
    for view in sheet.views:
        for span in view.spans:
            if span.magnification > 1.0:
                size = span.length * view.per_mm / span.magnification
                # As long as the hand has drawn it: half a division of the ruler, enlarged.
                room = (0.6 / span.magnification + 0.3) * view.per_mm
                assert min(abs(size - one) for one in true[view.kind]) < room, span
                seen += 1
    assert seen


# Extreme positions --------------------------------------------------------------------------------


@each("name", ["linkages/ex1", "levers/six-link", "press/press", "levers/task12", "linkages/ex2"])
def test_radii_of_extreme_positions_are_as_long_as_their_names_state(name: str) -> None:
    made = extreme_construction(Solution(problem_of(name)))
    if made is None or made.locus is Locus.TANGENTS:
        pytest.skip("no arcs")
    rod, crank = made.length("l"), made.length("r")
    _, labels = construction_items(made, 3.5)
    assert len(labels) == 2
    for label in labels:
        assert label.segment is not None
        pivot = made.place(made.pivot)
        reach = abs(label.segment[1] - pivot)
        is_sum = "+" in label.inscription.markup
        assert is_sum or "−" in label.inscription.markup
        assert reach == pytest.approx(rod + crank if is_sum else abs(rod - crank), abs=1e-6)
    assert {"+" in label.inscription.markup for label in labels} == {True, False}


def test_the_extreme_positions_are_those_where_rod_and_crank_are_in_one_line() -> None:
    made = extreme_construction(Solution(problem_of("levers/task12")))
    assert made is not None
    for prime in "′″":
        pin, end = (
            made.place(f"{n}{prime}") - made.place(made.pivot) for n in (made.pin, made.end)
        )
        if made.locus is not Locus.TANGENTS:
            assert abs((pin.conjugate() * end).imag) < 1e-6 * abs(pin) * abs(end)
