"""Questions on the turn of a crank: strokes, diagrams, positions compared (цикл движения)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees
from types import MappingProxyType

import numpy as np

from planmethod.defence.case import Case, Template
from planmethod.defence.kinematics import point_of, turning_links
from planmethod.defence.model import ChoiceAnswer, Instance, TextAnswer
from planmethod.note.narrate.cycle import output_name
from planmethod.plans.model import PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.solved.turn.cycle import CrankCycle, crank_cycle_of

VELOCITY, ACCELERATION = PlanKind.VELOCITY, PlanKind.ACCELERATION

LEAD_SHARE = 0.02
"""Share by which a largest value must exceed the others."""


def _turn(case: Case) -> CrankCycle | None:
    solution = case.solution
    if solution.problem.cycle is None or not solution.problem.drive.goes_round:
        return None
    return crank_cycle_of(solution)


def _stroke(case: Case) -> Iterator[Instance]:
    turn = _turn(case)
    if turn is None or turn.stroke is None or turn.output.slide is None:
        return
    per_mm = case.solution.plan_scale(PlanKind.POSITION, 0).per_mm
    answer = case.drawn(turn.stroke, case.length_sigma * per_mm, per_mm, "m")
    if answer is not None:
        place = case.of_part(case.plans_part, "position", "dimension H")
        facts = {"point": output_name(turn.output), "value": case.number(turn.stroke, "m")}
        yield Instance("", answer, place, facts)


def _angle_sigma(case: Case) -> float:
    """Return one sigma of the angle of the crank between two positions, degrees."""
    problem = case.solution.problem
    assert problem.drive.pivot is not None
    points = problem.bodies[problem.drive.link].points
    arm = max(abs(point - points[problem.drive.pivot]) for point in points.values())
    per_mm = case.solution.plan_scale(PlanKind.POSITION, 0).per_mm
    return degrees(2.0 * case.profile.point * per_mm / arm)


def _speed_ratio(case: Case) -> Iterator[Instance]:
    turn = _turn(case)
    if turn is None or turn.strokes is None or turn.strokes.K_v is None:
        return
    strokes = turn.strokes
    long, short = (max(strokes.working_deg, strokes.idle_deg),
                   min(strokes.working_deg, strokes.idle_deg))  # fmt: skip
    assert strokes.K_v is not None
    answer = case.drawn(strokes.K_v, 360.0 / short**2 * _angle_sigma(case))
    facts = {
        "long": case.input_number(round(long, 1)) + "°",
        "short": case.input_number(round(short, 1)) + "°",
        "value": case.number(strokes.K_v),
    }  # fmt: skip
    if answer is not None:
        yield Instance("", answer, case.scheme(), facts, requests="K_v")


def _equal_strokes(case: Case) -> Iterator[Instance]:
    turn = _turn(case)
    if turn is not None and turn.strokes is not None and turn.strokes.K_v is not None:
        right = "quicker" if turn.strokes.K_v > 1.0 + 1e-6 else "equal"
        yield Instance("", ChoiceAnswer(right), case.scheme())


def _fastest_position(case: Case) -> Iterator[Instance]:
    turn = _turn(case)
    if turn is None or turn.output.slide is None:
        return
    name = turn.output.point
    for series in case.motion(QuantityKind.VELOCITY):
        if point_of(series) != name:
            continue
        sizes = np.abs(series.exact)
        best = int(np.argmax(sizes))
        others = np.delete(sizes, best)
        if len(others) and sizes[best] > (1.0 + LEAD_SHARE) * float(np.max(others)):
            place = case.diagrams(f"diagram v: position {best}") or case.plan(VELOCITY, best)
            facts = {"symbol": series.symbol, "value": case.number(sizes[best], series.unit)}
            yield Instance(name, case.exactly(best), place, facts)


def _positive_epsilon(case: Case) -> Iterator[Instance]:
    count = len(case.solution.positions)
    for link, series in turning_links(case, QuantityKind.EPSILON) if count > 1 else ():
        known = dict(case.visible(series))
        if len(known) < max(4, 0.6 * count):
            continue
        found = [str(index) for index, value in known.items() if value > 0]
        unclear = [str(index) for index in range(count) if index not in known]
        if found and len(found) < len(known):
            told = case.texts.besides.format(numbers=", ".join(unclear)) if unclear else ""
            facts = {"symbol": series.symbol, "link": link, "besides": told}
            answer = TextAnswer(", ".join(found))
            yield Instance(link, answer, case.plan(ACCELERATION, int(found[0])), facts)


def _extremes_on_diagrams(case: Case) -> Iterator[Instance]:
    turn, place = _turn(case), case.diagrams()
    if turn is not None and place is not None:
        yield Instance("", ChoiceAnswer("top"), place, {"point": output_name(turn.output)})


def _zero_acceleration(case: Case) -> Iterator[Instance]:
    turn, place = _turn(case), case.diagrams()
    if turn is not None and place is not None:
        yield Instance("", ChoiceAnswer("extreme"), place, {"point": output_name(turn.output)})


def _dead_velocity(case: Case) -> Iterator[Instance]:
    turn = _turn(case)
    if turn is not None and turn.stroke is not None and turn.output.slide is not None:
        point = output_name(turn.output)
        place = case.of_part(case.plans_part, "position", "extreme position .*")
        yield Instance("", ChoiceAnswer("zero"), place, {"point": point})


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "stroke": _stroke,
        "speed_ratio": _speed_ratio,
        "equal_strokes": _equal_strokes,
        "dead_velocity": _dead_velocity,
        "positive_epsilon": _positive_epsilon,
        "fastest_position": _fastest_position,
        "extremes_on_diagrams": _extremes_on_diagrams,
        "zero_acceleration": _zero_acceleration,
    }
)
"""Templates by their keys in the catalogue."""
