"""Questions on synthesis and the flywheel (синтез, маховик)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees, pi
from types import MappingProxyType

import numpy as np

from planmethod.defence.case import Case, Template
from planmethod.defence.kinematics import length_name
from planmethod.defence.model import ChoiceAnswer, Instance, NumberAnswer, Place
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import point_name
from planmethod.problem.machine_records import ConstantMoment
from planmethod.project.parts import PartName
from planmethod.project.settle import quick_shaft
from planmethod.solved.machine.chain import rotor_inertia
from planmethod.solved.machine.drawing import FlywheelDrawing, drawing_of
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of, size_of

FLYWHEEL, SYNTHESIS = PartName.FLYWHEEL, PartName.SYNTHESIS

COARSE = 0.25
"""Largest tolerance of the inertia of a flywheel, which two tangents of a thin loop give."""


# Synthesis ---------------------------------------------------------------------------------------


def _theta(case: Case) -> Iterator[Instance]:
    for ratio, theta, place in _overlap(case):
        facts = {"ratio": case.input_number(ratio), "value": case.number(theta)}
        yield Instance("", case.computed(theta, "deg"), place, facts, states="K_v")


def _overlap(case: Case) -> Iterator[tuple[float, float, Place]]:
    """Yield the ratio K_v of a synthesis with the angle of the extreme positions, degrees."""
    project = case.project
    if project is None or project.part(SYNTHESIS) is None:
        return
    task = project.problem.synthesis
    ratio = None if task is None else task.data.get("K_v")
    if ratio:
        yield ratio, 180.0 * (ratio - 1.0) / (ratio + 1.0), case.of_part(SYNTHESIS, "position")


def _greater_ratio(case: Case) -> Iterator[Instance]:
    for _, _, place in _overlap(case):
        yield Instance("", ChoiceAnswer("greater"), place)


def _found_length(case: Case) -> Iterator[Instance]:
    project = case.project
    if project is None or project.part(SYNTHESIS) is None or project.problem.synthesis is None:
        return
    task = project.problem.synthesis
    link = project.problem.drive.link
    pivot, points = project.problem.drive.pivot, project.problem.bodies[link].points
    for point in points:
        names = (f"l_{pivot}{point}", f"l_{point}{pivot}")
        if pivot is not None and any(name in task.values for name in names):
            length = abs(points[point] - points[pivot])
            per_mm = project.scales.mu_l or 0.0
            answer = case.drawn(length, case.length_sigma * per_mm, per_mm, "m")
            line = point_name(pivot) + point_name(point)
            if answer is not None:
                facts = {"line": line, "value": case.number(length, "m"), "link": link}
                place, sought = case.of_part(SYNTHESIS, "position"), length_name(pivot, point)
                yield Instance(point, answer, place, facts, requests=sought)
            break


SYNTHESES: Mapping[str, Template] = MappingProxyType(
    {"theta": _theta, "greater_ratio": _greater_ratio, "found_length": _found_length}
)
"""Templates of a synthesis by their keys in the catalogue."""


# The flywheel ------------------------------------------------------------------------------------


def _machine(case: Case) -> Flywheel | None:
    project = case.project
    if project is None or project.part(FLYWHEEL) is None:
        return None
    return flywheel_of(project.solution)


def _place(case: Case, *marks: str, kind: str = "flywheel") -> Place:
    return case.of_part(FLYWHEEL, kind, *marks)


def _constant(case: Case, wheel: Flywheel) -> Rich:
    """Return the letter of the moment that is constant."""
    is_driving = wheel.machine.constant is ConstantMoment.DRIVING
    name = "driving moment" if is_driving else "resisting moment"
    return case.language.notation.symbol(name)


def _varying(case: Case, wheel: Flywheel) -> Rich:
    is_driving = wheel.machine.constant is ConstantMoment.DRIVING
    name = "resisting moment" if is_driving else "driving moment"
    return case.language.notation.symbol(name)


def _speed_limits(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None:
        return
    delta, mean = wheel.machine.delta, wheel.middle_speed
    place = _place(case, "speed: .*", kind="diagram")
    for about, sign in (("max", 1.0), ("min", -1.0)):
        value = mean * (1.0 + sign * delta / 2.0)
        facts = {
            "symbol": f"ω_{{{about}}}", "delta": case.input_number(delta),
            "mean": case.number(mean, "1/s"),
            "sign": "+" if sign > 0 else "−", "value": case.number(value, "1/s"),
        }  # fmt: skip
        # A share of the swing, not of the speed: else the mean speed would be right.
        answer = case.computed(value, "1/s")
        answer = type(answer)(value, 0.1 * mean * delta / 2.0, answer.unit)
        yield Instance(about, answer, place, facts)


def _delta(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is not None:
        yield Instance("", ChoiceAnswer("swing"), _place(case, "speed: .*", kind="diagram"),
                    {"delta": case.input_number(wheel.machine.delta)})  # fmt: skip


def _work(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None:
        return
    value, drawing = wheel.work_per_cycle, _drawing(case, wheel)
    per_mm = drawing.scales.work
    off = float(drawing.points.work[-1]) - value
    answer = case.drawn(value, case.length_sigma * per_mm, per_mm, "J", off=off)
    facts = {"varying": _varying(case, wheel), "value": case.number(value, "J"),
             "turns": case.input_number(wheel.cycle / (2.0 * pi))}  # fmt: skip
    if answer is not None:
        yield Instance("", answer, _place(case, "flywheel work"), facts)


def _drawing(case: Case, wheel: Flywheel) -> FlywheelDrawing:
    """Return the diagrams as the sheet has them."""
    return drawing_of(wheel, case.profile)


def _constant_moment(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None:
        return
    drawing = _drawing(case, wheel)
    per_mm, value = drawing.scales.moment, wheel.constant
    off = float(drawing.points.work[-1]) / wheel.cycle - value
    answer = case.drawn(value, case.length_sigma * per_mm, per_mm, "N·m", off=off)
    facts = {"symbol": _constant(case, wheel), "varying": _varying(case, wheel),
             "value": case.number(wheel.constant, "N·m")}  # fmt: skip
    if answer is not None:
        yield Instance("", answer, _place(case, "flywheel constant"), facts)


def _equal_ends(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is not None:
        yield Instance(
            "", ChoiceAnswer("cycle"), _place(case, "flywheel T: .*", "flywheel axis ΔT.*")
        )


def _gain(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None:
        return
    high, low = wheel.gain.mixed([1.0]).peak()[1], -wheel.gain.mixed([-1.0]).peak()[1]
    value, drawing = high - low, _drawing(case, wheel)
    per_mm, off = drawing.scales.work, float(np.ptp(drawing.points.gain)) - value
    answer = case.drawn(value, case.length_sigma * per_mm, per_mm, "J", off=off)
    facts = {"value": case.number(value, "J")}
    if answer is not None:
        place = _place(case, "flywheel axis ΔT.*", "flywheel T: .*")
        yield Instance("", answer, place, facts)


def _surplus(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is not None:
        yield Instance("", ChoiceAnswer("grows"), _place(case, "flywheel constant"))


def _greatest_speed(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None or wheel.steady_inertia <= 0.0:
        return
    count = len(case.solution.positions)
    for about, extreme in zip(("max", "min"), wheel.integrated, strict=True):
        share = extreme.rotation / wheel.cycle * wheel.machine.count
        near = round(share) % wheel.machine.count
        if abs(share - round(share)) > 0.4 or wheel.machine.count != count:
            continue
        facts = {"symbol": f"ω_{{{about}}}",
                 "phi": case.input_number(round(degrees(extreme.rotation), 1)) + "°"}  # fmt: skip
        place = _place(case, f"speed: position {near}", kind="diagram")
        yield Instance(about, case.exactly(near), place, facts)


def _tangents(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is not None:
        yield Instance("", ChoiceAnswer("limits"), _place(case, "flywheel psi max", "flywheel K"))


def _wheel_inertia(case: Case, wheel: Flywheel, ratio: float) -> NumberAnswer | None:
    """Return the inertia of the flywheel on a shaft that is faster than the crank."""
    drawing, value = _drawing(case, wheel), wheel.steady_inertia
    off = drawing.inertia - value
    return case.drawn(value, drawing.sigma, unit="kg·m²", times=ratio**-2, off=off, cap=COARSE)


def _inertia(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None or wheel.steady_inertia <= 0.0:
        return
    value = wheel.steady_inertia
    answer = _wheel_inertia(case, wheel, 1.0)
    facts = {"symbol": case.language.notation.symbol("flywheel"),
             "value": case.number(value, "kg·m²")}  # fmt: skip
    if answer is not None:
        yield Instance("", answer, _place(case, "flywheel K"), facts)


def _halved_delta(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is not None and wheel.steady_inertia > 0.0:
        yield Instance("", ChoiceAnswer("doubled"), _place(case, "flywheel K"),
                    {"symbol": case.language.notation.symbol("flywheel")})  # fmt: skip


def _faster_shaft(case: Case) -> Iterator[Instance]:
    wheel, project = _machine(case), case.project
    if wheel is None or project is None or wheel.steady_inertia <= 0.0:
        return
    shaft = quick_shaft(project)
    ratio = wheel.machine.wheel.ratio if wheel.machine.wheel.ratio != 1.0 else None
    ratio = ratio or (shaft[1] if shaft is not None else 2.0)
    value = wheel.steady_inertia / ratio**2
    answer = _wheel_inertia(case, wheel, ratio)
    if answer is not None:
        facts = {"ratio": case.input_number(ratio), "value": case.number(value, "kg·m²"),
                 "symbol": case.language.notation.symbol("flywheel")}  # fmt: skip
        place = _place(case, "dimension D", "flywheel K")
        yield Instance("", answer, place, facts, states="U")


def _smaller_wheel(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None:
        return
    made = wheel.steady_inertia - rotor_inertia(wheel)
    size = size_of(wheel.machine.wheel, made, wheel.middle_speed)
    if size is not None:
        facts = {"diameter": case.input_number(size.diameter, "m")}
        yield Instance("", ChoiceAnswer("rim"), _place(case, "dimension D", "flywheel K"), facts)


def _reduced_inertia(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is None or wheel.machine.count != len(case.solution.positions):
        return
    inertia = wheel.rows.inertia
    for index, value in enumerate(inertia.tolist()):
        per_mm = _drawing(case, wheel).scales.inertia
        answer = case.drawn(value, case.length_sigma * per_mm, per_mm, "kg·m²")
        if answer is not None:
            facts = {"symbol": case.language.notation.symbol("reduced inertia"),
                     "at": case.at_position(index),
                     "value": case.number(value, "kg·m²")}  # fmt: skip
            place = _place(case, f"flywheel J: position {index}")
            yield Instance(str(index), answer, place, facts)


def _why_varies(case: Case) -> Iterator[Instance]:
    wheel = _machine(case)
    if wheel is not None and np.ptp(wheel.rows.inertia) > 1e-6 * np.max(wheel.rows.inertia):
        yield Instance("", ChoiceAnswer("ratios"), _place(case, "flywheel axis J.*"),
                    {"symbol": case.language.notation.symbol("reduced inertia")})  # fmt: skip


FLYWHEELS: Mapping[str, Template] = MappingProxyType(
    {
        "delta": _delta,
        "speed_limits": _speed_limits,
        "work": _work,
        "constant_moment": _constant_moment,
        "surplus": _surplus,
        "equal_ends": _equal_ends,
        "gain": _gain,
        "reduced_inertia": _reduced_inertia,
        "why_varies": _why_varies,
        "tangents": _tangents,
        "inertia": _inertia,
        "halved_delta": _halved_delta,
        "faster_shaft": _faster_shaft,
        "smaller_wheel": _smaller_wheel,
        "greatest_speed": _greatest_speed,
    }
)
"""Templates of the flywheel by their keys in the catalogue."""
