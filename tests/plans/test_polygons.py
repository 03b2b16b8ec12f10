"""Consistency of force plans: polygons close, equations hold, letters fit."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from doors import (
    Component,
    Direction,
    Edge,
    KnownParts,
    PlanKind,
    ReadingReals as Reals,
    Relation,
    Solution,
    Statics,
    reaction_symbol,
)
from worked import problem_of

LOADED = ("levers/six-link", "levers/task12", "press/press")
TURN = {"levers/six-link": (140, 150, 160), "levers/task12": tuple(range(5, 365, 45))}


def statics_of(name: str) -> Statics:
    return Statics(Solution(problem_of(name), positions=TURN.get(name)))


def drawn(statics: Statics, edge: Edge) -> Reals:
    ends = (statics.si.point(end) for end in (edge.tail, edge.head))
    tail, head = ends
    return np.asarray(head - tail)


@pytest.mark.parametrize("name", LOADED)
def test_polygons_close_edge_by_edge(name: str) -> None:
    statics = statics_of(name)
    assert [plan.links for plan in statics.board.plans] == [
        *(group.links for group in statics.solution.structure.force_order),
        (statics.solution.problem.drive.link,),
    ]
    for plan in statics.board.plans:
        ring = [*plan.polygon, plan.polygon[0]]
        assert all(one.head == two.tail for one, two in pairwise(ring))
        assert {edge.on for edge in plan.polygon} == set(plan.links)


@pytest.mark.parametrize("name", LOADED)
def test_equations_hold_and_have_two_unknowns(name: str) -> None:
    statics = statics_of(name)
    for plan in statics.board.plans:
        for balance in plan.balances:
            forces = [drawn(statics, edge) for edge in balance.edges]
            peak = max(float(np.max(np.abs(force))) for force in forces)
            assert np.all(np.abs(sum(forces)) <= 1e-9 * peak)
            unknown = sum(2 - edge.known.value for edge in balance.edges)
            assert unknown == 2


@pytest.mark.parametrize("name", LOADED)
def test_edges_are_the_loads_and_the_reactions(name: str) -> None:
    statics = statics_of(name)
    called = statics.solution.problem.mechanism.called
    found = [(called(r.on), called(r.by), r.force) for r in statics.reactions]
    reactions = {reaction_symbol(on, by): force for on, by, force in found}
    reactions |= {reaction_symbol(by, on): -force for on, by, force in found}
    loads = {given.applied.name: given.applied.force for given in statics.board.given}
    seen = set()
    for plan in statics.board.plans:
        for edge in (*plan.polygon, *plan.wholes, *plan.inner):
            if edge.component is Component.TOTAL:
                seen.add(edge.symbol)
                expected = {**loads, **reactions}[edge.symbol]
                assert drawn(statics, edge) == pytest.approx(expected, rel=1e-9, abs=1e-6)
    assert {name for name, force in loads.items() if np.any(force)} <= seen
    assert all({reaction_symbol(on, by), reaction_symbol(by, on)} & seen for on, by, _ in found)


@pytest.mark.parametrize("name", LOADED)
def test_moment_equations_give_their_results(name: str) -> None:
    statics = statics_of(name)
    for plan in statics.board.plans:
        for equation in plan.moments:
            about = statics.si.point(equation.about)
            whole = sum(
                ((statics.si.point(e.at) - about).conj() * drawn(statics, e)).imag
                for e in (*equation.edges, *([equation.force] if equation.force else []))
            )
            couples = [*equation.couples, *([equation.couple] if equation.couple else [])]
            values = [statics.si.number(couple.moment) for couple in couples]
            assert whole + sum(values) == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize("name", LOADED)
def test_the_hand_goes_on_with_the_forces_that_it_has_read(name: str) -> None:
    """Each equation of moments once more, from arms and forces in whole steps of the ruler."""
    statics = statics_of(name)
    solution, step = statics.solution, statics.solution.ruler_arithmetic.ruler
    loaded = {given.applied.name for given in statics.board.given}
    segments = statics.board.segments

    def drawn_by_hand(edge: Edge) -> Any:
        hand = statics.ruler_reading
        return hand.point(edge.head) - hand.point(edge.tail)

    def ruled(length: Any, times: Any = 1.0) -> Any:
        fine = step / times
        return np.sign(length) * np.floor(np.abs(length) / fine + 0.5) * fine

    for plan in statics.board.plans:
        for equation in plan.moments:
            total: Any = 0.0
            about = solution.ruler_reading.point(equation.about)
            for edge in equation.edges:
                vector, at = drawn_by_hand(edge), solution.ruler_reading.point(edge.at)
                length = np.abs(vector)
                # A small plan is drawn and read at a scale of its own.
                times = statics.ruler_arithmetic.enlargements.get(segments.drawn(edge.ends), 1.0)
                size = length if edge.symbol in loaded else ruled(length, times)
                across = ((at - about).conj() * vector).imag / np.where(length == 0, 1.0, length)
                total = total + ruled(across) * size
            whole = total * statics.scale.per_mm * solution.scales[PlanKind.POSITION].per_mm
            for couple in equation.couples:
                whole = whole + statics.ruler_reading.number(couple.moment)
            if equation.couple is not None:
                found = statics.ruler_reading.number(equation.couple.moment)
                assert found == pytest.approx(-whole, rel=1e-9, abs=1e-9)


def test_letters_of_the_components() -> None:
    assert reaction_symbol("2", "1", Component.NORMAL) == "F^{n}_{21}"
    assert reaction_symbol("10", "2") == "F_{10,2}"
    plan = statics_of("levers/six-link").board.plans[1]
    assert [(edge.symbol, edge.known, edge.direction) for edge in plan.polygon[:2]] == [
        ("F^{n}_{21}", KnownParts.ONE, Direction(Relation.PARALLEL, ("B", "C"))),
        ("F^{τ}_{21}", KnownParts.BOTH, None),
    ]
    assert [edge.symbol for edge in plan.reactions] == [
        "F^{n}_{21}", "F^{n}_{36}", "F_{21}", "F_{36}", "F_{23}",
    ]  # fmt: skip
