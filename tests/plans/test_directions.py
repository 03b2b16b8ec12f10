"""Directions under the terms of vector equations: each vector lies as is written under it."""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterator
from functools import partial

import pytest
from cases import each, some, thinned
from doors import (
    FRAME,
    RATES,
    Direction,
    ModelProblem as Problem,
    Names,
    Relation,
    Solution,
    StatedEquation,
    Vector,
    VectorKind,
    direction_note,
    direction_text,
    equation_lines,
    get_language,
    problem_load as load,
    problem_loads as loads,
    slot_name,
    statement_given_facts as given_facts,
    wording,
)
from worked import SIX, every_task, problem_of

from benchmarks.generator import random_problem

SLOT = """
[frame]
A = [0, 0]
C = [0, -0.1]
[links.1]
points = ["A", "B"]
AB = 0.04
[links.2]
points = ["B"]
slides = {{ on = "3", through = "{through}", angle = {angle}, offset = {offset} }}
[links.3]
points = ["C", "D"]
CD = 0.3
[driver]
link = "1"
phi = [20, 75, 140, 230, 310]
omega = 10
epsilon = 20
[assembly]
D = "{where}"
"""
"""Block 2 slides on link 3 along a line beside its axis CD, at an angle to it."""

TAGS = {VectorKind.SLIDING, VectorKind.CORIOLIS}


def slot(angle: float, offset: float = 0.02, through: str = "C") -> Problem:
    error: Exception | None = None
    for where in ("above C", "below C", "left of C", "right of C", "left of AC", "right of AC"):
        text = SLOT.format(angle=angle, offset=offset, where=where, through=through)
        try:
            problem = loads(text, name="slot")
            Solution(problem)
        except Exception as caught:  # another assembly configuration
            error = caught
            continue
        return problem
    assert error is not None
    raise error


def way(solution: Solution, p: str, q: str, i: int) -> complex:
    places = solution.points
    return complex(places[q].place[i] - places[p].place[i])


def line_of(solution: Solution, term: Vector, direction: Direction, i: int) -> complex:
    """Return the direction of the line of the scheme by which a direction is described."""
    if direction.points:
        tail, head = direction.points
        return way(solution, tail, head, i)
    for slide in solution.problem.slides.values():
        if direction.guide == slot_name(slide):  # the angle of a link without points
            turned = float(solution.links[slide.host].phi_deg[i]) + slide.angle
            return cmath.rect(1.0, math.radians(turned))
    slides = [s for s in solution.problem.slides.values() if s.label == direction.guide]
    (angle,) = {slide.angle for slide in slides if slide.host == FRAME}
    return cmath.rect(1.0, math.radians(angle))


def terms(solution: Solution) -> Iterator[Vector]:
    for kind in RATES:
        for equation in solution.construction.plan(kind).equations:
            yield from (equation.left, *equation.right)


def assert_directions(solution: Solution) -> set[Relation]:
    """Compare the terms that are something with their directions; return which there are."""
    seen: set[Relation] = set()
    for kind in RATES:
        equations = solution.construction.plan(kind).equations
        seen |= _compared(solution, [t for e in equations for t in (e.left, *e.right)])
    return seen


def _compared(solution: Solution, terms: list[Vector]) -> set[Relation]:
    seen: set[Relation] = set()
    sizes = [abs(solution.si.vector(term.tail, term.head)).max() for term in terms]
    peak = max(sizes, default=0.0)
    for term in terms:
        direction = term.direction
        if direction is None or direction.relation is Relation.ZERO:
            continue
        vectors = solution.si.vector(term.tail, term.head)
        for i, vector in enumerate(map(complex, vectors)):
            if not abs(vector) > 1e-6 * peak > 0:
                continue
            slides = solution.problem.slides.values()
            if direction.guide and direction.guide not in {
                s.label if s.host == FRAME else slot_name(s) for s in slides
            }:
                continue  # a line without a second point: slots of that kind are tested below
            line = line_of(solution, term, direction, i)
            turn = vector / line / abs(vector / line)
            told = (term.symbol, direction, i)
            match direction.relation:
                case Relation.PARALLEL:
                    assert abs(turn.imag) < 1e-6, told
                case Relation.PERPENDICULAR:
                    assert abs(turn.real) < 1e-6, told
                case Relation.TOWARDS:
                    assert abs(turn - 1) < 1e-6, told
                case Relation.ANGLED:
                    turned = turn / cmath.rect(1.0, math.radians(direction.angle))
                    assert abs(turned.imag) < 1e-6, told
            seen.add(direction.relation)
    return seen


@each("name", SIX)
def test_vectors_of_the_worked_mechanisms_have_the_directions_of_their_equations(name: str) -> None:
    assert Relation.PERPENDICULAR in assert_directions(Solution(problem_of(name)))


def test_vectors_of_the_tasks_have_the_directions_of_their_equations() -> None:
    seen = set()
    for path in thinned(every_task(), 3):
        seen |= assert_directions(Solution(load(path)))
    assert seen >= {Relation.PARALLEL, Relation.PERPENDICULAR, Relation.TOWARDS}


@each("seed", range(some(60, 12)))
def test_vectors_of_random_mechanisms_have_the_directions_of_their_equations(seed: int) -> None:
    assert_directions(Solution(loads(random_problem(seed)[0], name="random")))


@each(
    "angle, along, across",
    [
        (0, "∥ CD", "⊥ CD"),
        (180, "∥ CD", "⊥ CD"),
        (90, "⊥ CD", "∥ CD"),
        (-90, "⊥ CD", "∥ CD"),
        (30, "∥ n_{2}–n_{2}", "⊥ n_{2}–n_{2}"),
        (-60, "∥ n_{2}–n_{2}", "⊥ n_{2}–n_{2}"),
    ],
)
def test_a_slot_beside_the_axis_is_described_by_that_or_at_an_angle_to_it_by_its_own_name(
    angle: float, along: str, across: str
) -> None:
    """The relative vectors run along the slot, the Coriolis acceleration across it."""
    solution = Solution(slot(angle))
    assert Relation.TOWARDS in assert_directions(solution)
    count = 0
    for term in terms(solution):
        if term.kind in TAGS:
            assert term.direction is not None
            due = along if term.kind is VectorKind.SLIDING else across
            assert direction_text(term.direction) == due, term.symbol
            note = direction_note(Names(solution, wording("en")), term.direction)
            assert note.replace("−", "-") == due, term.symbol
            count += 1
    assert count == 3  # v, a^r, a^k


@each("angle", [0, 90, 30, -120])
def test_a_slot_through_the_pin_is_described_by_the_points_on_it(angle: float) -> None:
    solution = Solution(slot(angle, offset=0.0))
    assert_directions(solution)
    for term in terms(solution):
        if term.kind in TAGS:
            assert term.direction is not None
            assert set(term.direction.points) == {"C", "B"}
            is_along = term.kind is VectorKind.SLIDING
            assert term.direction.relation is (
                Relation.PARALLEL if is_along else Relation.PERPENDICULAR
            )


def test_a_slot_that_joins_no_two_letters_has_a_name_that_the_statement_gives() -> None:
    text = SLOT.format(angle=0, offset=0.02, where="above C", through="C")
    text = text.replace('points = ["C", "D"]\nCD = 0.3', 'points = ["C"]')
    solution = Solution(loads(text.partition("[assembly]")[0], name="slot"))
    assert_directions(solution)
    told = {term.direction for term in terms(solution) if term.kind in TAGS}
    assert {direction_text(one) for one in told} == {"∥ n_{2}–n_{2}", "⊥ n_{2}–n_{2}"}
    given_texts = [fact.text for fact in given_facts(solution.problem, get_language("ru"))]
    assert "n_{2}–n_{2} — направляющая звена 3 для звена 2, проходит через C" in given_texts


def test_a_direction_is_printed_under_its_own_term() -> None:
    """In the text the note begins where the term begins, below its underline."""
    solution = Solution(slot(90))
    names = Names(solution, wording("en"))
    for kind in RATES:
        for equation in solution.construction.plan(kind).equations:
            symbols, _, *notes = equation_lines(
                StatedEquation(equation.left.head, (equation.left,), equation.right).written(
                    partial(direction_note, names)
                )
            )
            for term in (equation.left, *equation.right):
                note = direction_note(names, term.direction)
                if not note:
                    continue
                at = [found.start() for found in re.finditer(re.escape(note), notes[0])]
                heads = [found.start() for found in re.finditer(r"[va]\S*", symbols)]
                assert any(start in heads for start in at), (symbols, notes)


@pytest.mark.parametrize(
    ("relation", "text"),
    [(Relation.PARALLEL, "∥ BC"), (Relation.PERPENDICULAR, "⊥ BC"), (Relation.TOWARDS, "B → C")],
)
def test_the_signs_of_the_relations(relation: Relation, text: str) -> None:
    assert direction_text(Direction(relation, ("B", "C"))) == text


def test_an_angle_is_written_in_the_language() -> None:
    told = Direction(Relation.ANGLED, ("A", "B"), angle=-66.63)
    assert direction_text(told, get_language("ru").notation) == "∠ −66,63° AB"
    assert direction_text(told, get_language("en").notation) == "∠ −66.63° AB"
