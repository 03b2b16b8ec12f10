"""Questions on a moving point (движение точки)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import inf
from types import MappingProxyType

import numpy as np

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place
from planmethod.moving.motion import Motion, PointProblem, move
from planmethod.moving.results import PointQuantities
from planmethod.note.formula import Rich

CLEAR = 0.02
"""Share of the largest value below which a value is too small for a question."""


def _motion(case: Case) -> Motion | None:
    return case.solved(PointProblem, move)


def _moments(case: Case, *columns: str) -> Iterator[tuple[int, Rich, tuple[float, ...]]]:
    """Yield the moments in which all of some columns are clear, with their values."""
    motion = _motion(case)
    if motion is None:
        return
    found = [motion.columns[name] for name in columns]
    sizes = [float(np.nanmax(np.abs(one), initial=0.0)) for one in found]
    for k, t in enumerate(motion.columns["t"].tolist()):
        values = tuple(float(one[k]) for one in found)
        if all(np.isfinite(v) and abs(v) > CLEAR * s for v, s in zip(values, sizes, strict=True)):
            yield k, case.input_number(t, "s"), values


def _sigma(case: Case, column: str, index: int) -> float:
    """Return one sigma of a quantity that is read from the sheet; infinite if it is not there."""
    quantities = case.solved(PointProblem, PointQuantities)
    found = None if quantities is None else quantities.read_off(column, index, case.profile)
    return inf if found is None else found[1]


def _trajectory(case: Case, index: int, letter: str) -> Place:
    marks = (rf"at {index}: {letter}", rf"at \d+: {letter}")
    return case.of_part(None, "trajectory", *marks)


def _value(case: Case, column: str, unit: str, letter: str) -> Iterator[Instance]:
    for k, time, (value,) in _moments(case, column):
        answer = case.drawn(abs(value), _sigma(case, column, k), unit=unit)
        if answer is not None:
            facts = {"time": time, "value": case.number(abs(value), unit)}
            about = f"{column} {k}"
            yield Instance(about, answer, _trajectory(case, k, letter), facts, requests=about)


def _speed(case: Case) -> Iterator[Instance]:
    yield from _value(case, "v", "m/s", "v")


def _acceleration(case: Case) -> Iterator[Instance]:
    yield from _value(case, "a", "m/s²", "a")


def _tangential(case: Case) -> Iterator[Instance]:
    yield from _value(case, "a_tangential", "m/s²", r"a\^\{τ\}")


def _normal(case: Case) -> Iterator[Instance]:
    yield from _value(case, "a_normal", "m/s²", r"a\^\{n\}")


def _radius(case: Case) -> Iterator[Instance]:
    for k, time, (rho, v, _) in _moments(case, "rho", "v", "a_normal"):
        answer = case.drawn(rho, _sigma(case, "rho", k), unit="m")
        if answer is not None and v:
            facts = {"time": time, "value": case.number(rho, "m")}
            place = case.of_part(None, "trajectory", "radius of curvature", rf"C {k}")
            yield Instance(f"rho {k}", answer, place, facts)


def _speeding(case: Case) -> Iterator[Instance]:
    for k, time, (along, _) in _moments(case, "a_tangential", "v"):
        right = "faster" if along > 0.0 else "slower"
        yield Instance(str(k), ChoiceAnswer(right), _trajectory(case, k, "a"), {"time": time})


def _tangent(case: Case) -> Iterator[Instance]:
    for k, time, _ in _moments(case, "v"):
        yield Instance(str(k), ChoiceAnswer("tangent"), _trajectory(case, k, "v"), {"time": time})


def _hollow(case: Case) -> Iterator[Instance]:
    for k, time, _ in _moments(case, "a_normal"):
        place = _trajectory(case, k, r"a\^\{n\}")
        yield Instance(str(k), ChoiceAnswer("centre"), place, {"time": time})


def _hodograph(case: Case) -> Iterator[Instance]:
    if _motion(case) is not None:
        place = case.sheets.find(None, "hodograph")
        if place is not None:
            yield Instance("", ChoiceAnswer("acceleration"), place)


def _straight(case: Case) -> Iterator[Instance]:
    if _motion(case) is not None:
        yield Instance("", ChoiceAnswer("normal"), case.of_part(None, "trajectory"))


def _uniform(case: Case) -> Iterator[Instance]:
    if _motion(case) is not None:
        yield Instance("", ChoiceAnswer("tangential"), case.of_part(None, "trajectory"))


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "speed": _speed,
        "tangent": _tangent,
        "hodograph": _hodograph,
        "acceleration": _acceleration,
        "tangential": _tangential,
        "normal": _normal,
        "speeding": _speeding,
        "hollow": _hollow,
        "radius": _radius,
        "straight": _straight,
        "uniform": _uniform,
    }
)
"""Templates by their keys in the catalogue."""
