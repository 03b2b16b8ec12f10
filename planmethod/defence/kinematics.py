"""Questions on plans of positions, velocities, accelerations, and on diagrams (кинематика)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi
from types import MappingProxyType

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, TextAnswer
from planmethod.mechanism.model import FRAME
from planmethod.note.compared import Series
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.plans.model import PlanKind, Relation, Vector, VectorKind
from planmethod.problem.model import Problem
from planmethod.problem.quantities import QuantityKind

VELOCITY, ACCELERATION = PlanKind.VELOCITY, PlanKind.ACCELERATION


def length_name(first: str, second: str) -> str:
    """Return the name of the length between two points, whatever their order."""
    return f"l {min(first, second)} {max(first, second)}"


def _line(vector: Vector) -> Rich:
    """Return the line of two points that a relative vector is of: ``BA``."""
    return "".join(point_name(point) for point in vector.points)


def turning_links(case: Case, kind: QuantityKind) -> Iterator[tuple[str, Series]]:
    """Yield omega or epsilon of driven links: a block on a slotted link turns with it."""
    problem = case.solution.problem
    for series in case.motion(kind):
        link = of_link(series)
        if link != problem.drive.link and link not in problem.slides:
            yield link, series


def of_link(series: Series) -> str:
    """Return the link of omega or epsilon."""
    return series.label.rpartition("_")[2]


def point_of(series: Series) -> str:
    """Return the point of a velocity or an acceleration."""
    return series.label.partition("_")[2]


def _plan_letter(case: Case, kind: PlanKind, point: str) -> str:
    """Return the letter that a point has on the inscriptions of a plan."""
    letters = point[:1].lower() + point[1:]
    return point_name(letters)


def _scale_text(case: Case, kind: PlanKind, index: int) -> Rich:
    convention = case.solution.problem.scales.convention
    scale = case.solution.plan_scale(kind, index)
    return scale_inscription(scale, convention, case.language.notation)


def _turns_evenly(problem: Problem) -> bool:
    drive = problem.drive
    return drive.revolves and bool(drive.rate) and not drive.acceleration


# Sizes and scales --------------------------------------------------------------------------------


def _crank_speed(case: Case) -> Iterator[Instance]:
    drive = case.solution.problem.drive
    if drive.is_crank and drive.turns and drive.gear_drive is None:
        facts = {"n": case.input_number(abs(drive.turns), "rev/min"), "link": drive.link}
        yield Instance("", case.computed(abs(drive.turns) * pi / 30.0, "1/s"), case.scheme(), facts)


def _length_on_scheme(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    for link in problem.mechanism.links:
        points = problem.bodies[link].points
        for one, other in zip(list(points), list(points)[1:], strict=False):
            length = abs(points[one] - points[other])
            per_mm = case.solution.plan_scale(PlanKind.POSITION, 0).per_mm
            if length > 5.0 * per_mm:
                facts = {
                    "line": point_name(one) + point_name(other), "link": link,
                    "length": case.input_number(length, "m"),
                    "scale": _scale_text(case, PlanKind.POSITION, 0),
                }  # fmt: skip
                answer = case.drawn(length / per_mm, case.length_sigma, 1.0, "mm")
                if answer is not None:
                    length_key = length_name(one, other)
                    yield Instance(f"{one}{other}", answer, case.scheme(), facts, states=length_key)


def _velocity_of_segment(case: Case) -> Iterator[Instance]:
    yield from _segments(case, VELOCITY)


def _acceleration_of_segment(case: Case) -> Iterator[Instance]:
    yield from _segments(case, ACCELERATION)


def _segments(case: Case, kind: PlanKind) -> Iterator[Instance]:
    """Yield how long the segment of a known vector is."""
    kinds = QuantityKind.VELOCITY if kind is VELOCITY else QuantityKind.ACCELERATION
    for series in case.motion(kinds):
        if point_of(series) in case.crank_points:
            continue
        for index, value in case.readable(series):
            per_mm = case.solution.plan_scale(kind, index).per_mm
            one = series[index]
            answer = case.drawn(abs(value) / per_mm, one.sigma / per_mm, 1.0, "mm")
            if answer is None:
                continue
            facts = {
                "symbol": series.symbol, "at": case.at_position(index),
                "value": case.number(abs(value), series.unit),
                "scale": _scale_text(case, kind, index),
            }  # fmt: skip
            letter = _plan_letter(case, kind, point_of(series))
            about = f"{series.label} {index}"
            yield Instance(about, answer, case.plan(kind, index, letter), facts, states=about)


def _smaller_scale(case: Case) -> Iterator[Instance]:
    yield Instance("", ChoiceAnswer("longer"), case.plan(VELOCITY, 0), {"scale": "μ_{v}"})


# Velocities --------------------------------------------------------------------------------------


def _point_velocity(case: Case) -> Iterator[Instance]:
    yield from _of_points(case, VELOCITY, QuantityKind.VELOCITY)


def _point_acceleration(case: Case) -> Iterator[Instance]:
    yield from _of_points(case, ACCELERATION, QuantityKind.ACCELERATION)


def _of_points(
    case: Case, plan: PlanKind, kind: QuantityKind, times: float = 1.0
) -> Iterator[Instance]:
    for series in case.motion(kind):
        point = point_of(series)
        if point in case.crank_points:
            continue
        for index, value in case.readable(series):
            answer = case.read(series, index, times)
            assert answer is not None
            facts = {
                "symbol": series.symbol, "at": case.at_position(index),
                "value": case.number(abs(value), series.unit),
                "changed": case.number(abs(times * value), series.unit),
                "link": case.solution.problem.drive.link,
            }  # fmt: skip
            letter = _plan_letter(case, plan, point)
            about = f"{series.label} {index}"
            yield Instance(about, answer, case.plan(plan, index, letter), facts, requests=about)


def _crank_pin(case: Case) -> Iterator[tuple[Series, float]]:
    """Yield the velocity of the crank's pin, and its distance from the pivot, m."""
    problem = case.solution.problem
    drive = problem.drive
    if not drive.revolves or drive.pivot is None or not drive.rate:
        return
    points = problem.bodies[drive.link].points
    for series in case.motion(QuantityKind.VELOCITY):
        point = point_of(series)
        if point in points and not any(mass.centre == point for mass in case.masses.values()):
            yield series, abs(points[point] - points[drive.pivot])


def _pin_velocity(case: Case) -> Iterator[Instance]:
    for series, length in _crank_pin(case):
        drive = case.solution.problem.drive
        value = abs(drive.rate) * length
        facts = {
            "symbol": series.symbol, "link": drive.link,
            "omega": case.number(abs(drive.rate), "1/s"), "length": case.input_number(length, "m"),
        }  # fmt: skip
        letter = _plan_letter(case, VELOCITY, point_of(series))
        answer, place = case.computed(value, "m/s"), case.plan(VELOCITY, 0, letter)
        length_key = length_name(str(drive.pivot), point_of(series))
        yield Instance(series.label, answer, place, facts, states=length_key)


def _perpendicular(case: Case) -> Iterator[Instance]:
    for vector, series in case.relative(VELOCITY, VectorKind.RELATIVE):
        direction = vector.direction
        if direction is None or direction.relation is not Relation.PERPENDICULAR:
            continue
        if not vector.points:
            continue
        for index, _ in case.visible(series):
            one, other = map(point_name, vector.points)
            facts = {
                "symbol": series.symbol, "at": case.at_position(index), "line": _line(vector),
                "one": one, "other": other,
            }  # fmt: skip
            yield Instance(
                f"{series.symbol} {index}", ChoiceAnswer("circle"), case.plan(VELOCITY, index),
                facts,
            )  # fmt: skip


def _along_guide(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    for link, slide in problem.slides.items():
        if slide.host == FRAME and link != problem.drive.link:
            series = next(
                (s for s in case.motion(QuantityKind.VELOCITY) if point_of(s) == slide.pin), None
            )
            if series is None:
                continue
            for index, _ in case.visible(series):
                facts = {"symbol": series.symbol, "link": link, "at": case.at_position(index)}
                letter = _plan_letter(case, VELOCITY, slide.pin)
                yield Instance(
                    f"{link} {index}", ChoiceAnswer("guide"), case.plan(VELOCITY, index, letter),
                    facts,
                )  # fmt: skip


def _pole(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    fixed = [point for point in problem.bodies[FRAME].points if point in _hinges(problem)]
    if fixed:
        text = ", ".join(map(point_name, fixed))
        yield Instance("", TextAnswer(text), case.plan(VELOCITY, 0), {"points": text})


def _hinges(problem: Problem) -> set[str]:
    return {joint.point for joint in problem.mechanism.revolutes if FRAME in joint.links}


def _relative_segment(case: Case) -> Iterator[Instance]:
    """Yield which segment of the plan shows a relative velocity."""
    for vector, series in case.relative(VELOCITY, VectorKind.RELATIVE):
        if len(vector.points) != 2:
            continue
        one, other = (point_name(p[:1].lower() + p[1:]) for p in vector.points)
        options = {"between": f"{other}{one}", "first": f"p{one}", "second": f"p{other}"}
        for index, _ in case.visible(series):
            facts = {"symbol": series.symbol, "at": case.at_position(index)}
            yield Instance(
                f"{series.symbol} {index}", ChoiceAnswer("between", options),
                case.plan(VELOCITY, index), facts,
            )  # fmt: skip


def _omega(case: Case) -> Iterator[Instance]:
    yield from _of_links(case, QuantityKind.OMEGA, VELOCITY)


def _epsilon(case: Case) -> Iterator[Instance]:
    yield from _of_links(case, QuantityKind.EPSILON, ACCELERATION)


def _of_links(case: Case, kind: QuantityKind, plan: PlanKind) -> Iterator[Instance]:
    for link, series in turning_links(case, kind):
        for index, value in case.readable(series):
            answer = case.read(series, index)
            assert answer is not None
            facts = {
                "symbol": series.symbol, "link": link, "at": case.at_position(index),
                "value": case.number(abs(value), series.unit),
            }  # fmt: skip
            yield Instance(f"{series.label} {index}", answer, case.plan(plan, index), facts)


def _sense_of_omega(case: Case) -> Iterator[Instance]:
    yield from _senses(case, QuantityKind.OMEGA, VELOCITY)


def _sense_of_epsilon(case: Case) -> Iterator[Instance]:
    yield from _senses(case, QuantityKind.EPSILON, ACCELERATION)


def _senses(case: Case, kind: QuantityKind, plan: PlanKind) -> Iterator[Instance]:
    for link, series in turning_links(case, kind):
        for index, value in case.visible(series):
            facts = {"symbol": series.symbol, "link": link, "at": case.at_position(index)}
            right = "ccw" if value > 0 else "cw"
            yield Instance(
                f"{series.label} {index}", ChoiceAnswer(right), case.plan(plan, index), facts
            )


def _speeding(case: Case) -> Iterator[Instance]:
    epsilons = {of_link(one): one for one in case.motion(QuantityKind.EPSILON)}
    for link, series in turning_links(case, QuantityKind.OMEGA):
        other = epsilons.get(link)
        if other is None:
            continue
        there = dict(case.visible(other))
        for index, value in case.visible(series):
            if index in there:
                right = "faster" if value * there[index] > 0 else "slower"
                facts = {"link": link, "at": case.at_position(index)}
                yield Instance(
                    f"{link} {index}", ChoiceAnswer(right), case.plan(ACCELERATION, index), facts
                )


# Accelerations -----------------------------------------------------------------------------------


def _pin_acceleration(case: Case) -> Iterator[Instance]:
    drive = case.solution.problem.drive
    if not _turns_evenly(case.solution.problem) or drive.pivot is None:
        return
    for series, _ in _crank_pin(case):
        point = point_of(series)
        facts = {"symbol": f"a_{{{point}}}", "point": point_name(point), "link": drive.link,
                 "pivot": point_name(drive.pivot)}  # fmt: skip
        letter = _plan_letter(case, ACCELERATION, point)
        yield Instance(point, ChoiceAnswer("pivot"), case.plan(ACCELERATION, 0, letter), facts)


def _normal(case: Case) -> Iterator[Instance]:
    for vector, series in case.relative(ACCELERATION, VectorKind.NORMAL):
        if len(vector.points) != 2:
            continue
        one, other = map(point_name, vector.points)
        options = {
            "centre": case.texts.from_to.format(start=one, end=other),
            "away": case.texts.from_to.format(start=other, end=one),
            "across": case.texts.across.format(line=one + other),
        }
        for index, _ in case.visible(series):
            facts = {"symbol": series.symbol, "at": case.at_position(index), "one": one,
                     "other": other}  # fmt: skip
            yield Instance(
                f"{series.symbol} {index}", ChoiceAnswer("centre", options),
                case.plan(ACCELERATION, index), facts,
            )  # fmt: skip


def _normal_value(case: Case) -> Iterator[Instance]:
    for vector, series in case.relative(ACCELERATION, VectorKind.NORMAL):
        for index, value in case.readable(series):
            answer = case.read(series, index)
            assert answer is not None
            facts = {"symbol": series.symbol, "at": case.at_position(index),
                     "line": _line(vector), "value": case.number(value, series.unit)}  # fmt: skip
            if len(vector.points) == 2:
                yield Instance(
                    f"{series.symbol} {index}", answer, case.plan(ACCELERATION, index), facts
                )


def _tangential(case: Case) -> Iterator[Instance]:
    for vector, series in case.relative(ACCELERATION, VectorKind.TANGENTIAL):
        for index, _ in case.visible(series):
            facts = {
                "symbol": series.symbol,
                "at": case.at_position(index),
                "line": _line(vector),
            }
            if len(vector.points) == 2:
                yield Instance(
                    f"{series.symbol} {index}", ChoiceAnswer("epsilon"),
                    case.plan(ACCELERATION, index), facts,
                )  # fmt: skip


def _coriolis(case: Case) -> Iterator[Instance]:
    for _, series in case.relative(ACCELERATION, VectorKind.CORIOLIS):
        for index, value in case.readable(series):
            answer = case.read(series, index)
            assert answer is not None
            facts = {"symbol": series.symbol, "at": case.at_position(index),
                     "value": case.number(value, series.unit)}  # fmt: skip
            yield Instance(
                f"{series.symbol} {index}", answer, case.plan(ACCELERATION, index), facts
            )


def _coriolis_direction(case: Case) -> Iterator[Instance]:
    for _, series in case.relative(ACCELERATION, VectorKind.CORIOLIS):
        for index, _ in case.visible(series):
            facts = {"symbol": series.symbol, "at": case.at_position(index)}
            yield Instance(
                f"{series.symbol} {index}", ChoiceAnswer("turned"),
                case.plan(ACCELERATION, index), facts,
            )  # fmt: skip


def _coriolis_zero(case: Case) -> Iterator[Instance]:
    for _, series in case.relative(ACCELERATION, VectorKind.CORIOLIS):
        yield Instance(series.symbol, ChoiceAnswer("either"), case.plan(ACCELERATION, 0),
                    {"symbol": series.symbol})  # fmt: skip


def _no_coriolis(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    for link, slide in problem.slides.items():
        if slide.host == FRAME and link != problem.drive.link:
            yield Instance(link, ChoiceAnswer("still"), case.plan(ACCELERATION, 0), {"link": link})


def _similarity(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    found = {point_of(s) for s in case.motion(QuantityKind.VELOCITY)}
    for link in problem.mechanism.links:
        points = list(problem.bodies[link].points)
        mass = case.masses.get(link)
        centre = next((p for p in points if p.startswith("S") and p in found), None)
        centre = centre if mass is None or mass.centre is None else mass.centre
        ends = [p for p in points if p != centre][:2]
        if centre is None or centre not in points or len(ends) < 2 or link == problem.drive.link:
            continue
        if centre not in found or {e[:1] for e in ends} == {centre[:1]}:
            continue
        facts = {
            "point": point_name(centre), "link": link,
            "letter": _plan_letter(case, VELOCITY, centre), "line": "".join(map(point_name, ends)),
        }  # fmt: skip
        place = case.plan(VELOCITY, 0, facts["letter"])
        yield Instance(link, ChoiceAnswer("similar"), place, facts)


# What changes with the speed ---------------------------------------------------------------------


def _doubled_velocity(case: Case) -> Iterator[Instance]:
    if _turns_evenly(case.solution.problem):
        yield from _of_points(case, VELOCITY, QuantityKind.VELOCITY, 2.0)


def _doubled_acceleration(case: Case) -> Iterator[Instance]:
    if _turns_evenly(case.solution.problem):
        yield from _of_points(case, ACCELERATION, QuantityKind.ACCELERATION, 4.0)


def _reversed(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    if _turns_evenly(problem):
        facts = {"link": problem.drive.link}
        yield Instance("", ChoiceAnswer("same"), case.plan(ACCELERATION, 0), facts)


def _analogue(case: Case) -> Iterator[Instance]:
    problem = case.solution.problem
    if not problem.drive.revolves or not problem.drive.rate:
        return
    rate = abs(problem.drive.rate)
    for series in case.motion(QuantityKind.VELOCITY):
        point = point_of(series)
        for index, value in case.readable(series):
            answer = case.drawn(abs(value) / rate, series[index].sigma / rate, unit="m")
            if answer is None or point in case.crank_points:
                continue
            facts = {
                "symbol": f"v_{{q{point}}}", "velocity": series.symbol, "link": problem.drive.link,
                "at": case.at_position(index), "value": case.number(abs(value) / rate, "m"),
            }  # fmt: skip
            about = f"{series.label} {index}"
            yield Instance(about, answer, case.plan(VELOCITY, index), facts, requests=about)


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "crank_speed": _crank_speed,
        "length_on_scheme": _length_on_scheme,
        "pin_velocity": _pin_velocity,
        "velocity_of_segment": _velocity_of_segment,
        "smaller_scale": _smaller_scale,
        "perpendicular": _perpendicular,
        "along_guide": _along_guide,
        "pole": _pole,
        "relative_segment": _relative_segment,
        "similarity": _similarity,
        "point_velocity": _point_velocity,
        "omega": _omega,
        "sense_of_omega": _sense_of_omega,
        "doubled_velocity": _doubled_velocity,
        "analogue": _analogue,
        "pin_acceleration": _pin_acceleration,
        "normal": _normal,
        "normal_value": _normal_value,
        "tangential": _tangential,
        "coriolis": _coriolis,
        "coriolis_direction": _coriolis_direction,
        "coriolis_zero": _coriolis_zero,
        "no_coriolis": _no_coriolis,
        "acceleration_of_segment": _acceleration_of_segment,
        "point_acceleration": _point_acceleration,
        "epsilon": _epsilon,
        "sense_of_epsilon": _sense_of_epsilon,
        "speeding": _speeding,
        "doubled_acceleration": _doubled_acceleration,
        "reversed": _reversed,
    }
)
"""Templates by their keys in the catalogue."""
