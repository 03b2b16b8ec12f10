"""Questions on a cam and its follower (кулачковый механизм)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees, isfinite, pi
from types import MappingProxyType

from planmethod.cams.design import CamDesign, motion_in_division, nodes_of
from planmethod.cams.model import CamPhase, CamProblem, Closure, Contact
from planmethod.cams.results import CamQuantities
from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place
from planmethod.project.parts import PartName

COARSE = 0.25
"""Largest tolerance of the least radius, which the corner of two long tangents gives."""


def _design(case: Case) -> CamDesign | None:
    found = case.solved(CamProblem, CamQuantities)
    return None if found is None else found.design


def _quantities(case: Case) -> CamQuantities:
    found = case.solved(CamProblem, CamQuantities)
    assert found is not None, "there is a cam"
    return found


def _place(case: Case, *marks: str, kind: str = "cam") -> Place:
    return case.of_part(case.own_part(PartName.CAM), kind, *marks)


def _sigma(case: Case, name: str, scale: str) -> float:
    """Return one sigma of a size that is read from the sheet, m or degrees.

    ``scale`` is that of the picture where the construction has no result of that name.
    """
    quantities = _quantities(case)
    found = quantities.read_off(name, 0, case.profile)
    if found is not None:
        return found[1]
    return case.length_sigma * float(getattr(quantities.built.scales, scale))


def _mm(value: float) -> float:
    return 1000.0 * value


def _profile(case: Case) -> Place:
    return _place(case, r"profile: O_\{1\}", r"profile: .*")


def _least_radius(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None:
        value = design.geometry.r_min
        sigma = _sigma(case, "r_min", "region")
        answer = case.drawn(_mm(value), _mm(sigma), unit="mm", cap=COARSE)
        facts = {"value": case.number(_mm(value), "mm")}
        if answer is not None:
            yield Instance("", answer, _place(case, r"dimension r_\{min\}"), facts)


def _wider_cam(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and design.problem.contact is not Contact.FLAT:
        yield Instance("", ChoiceAnswer("less"), _place(case, r"r_\{min\}"))


def _angle_sigma(case: Case, name: str) -> float:
    found = _quantities(case).read_off(name, 0, case.profile)
    return case.profile.parallel if found is None else found[1]


def _largest_pressure(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or design.problem.contact is Contact.FLAT:
        return
    names = {CamPhase.RISE: "rise", CamPhase.RETURN: "return"}
    for phase, key in names.items():
        if any(one.phase is phase for one in design.problem.moving):
            value, phi = design.pressure(phase)
            name = "theta_max" if phase is CamPhase.RISE else "theta_max_return"
            answer = case.drawn(degrees(value), _angle_sigma(case, name), unit="deg")
            facts = {"phase": case.texts["phases"][key], "value": case.number(degrees(value)),
                     "phi": case.input_number(round(degrees(phi), 1)) + "°"}  # fmt: skip
            if answer is not None:
                place = _place(case, "cam pressure: .*", kind="diagram")
                yield Instance(key, answer, place, facts)


def _pressure_meaning(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and design.problem.contact is not Contact.FLAT:
        place = _place(case, "cam pressure: .*", kind="diagram")
        yield Instance("", ChoiceAnswer("velocity"), place)


def _jamming(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and design.problem.contact is not Contact.FLAT:
        yield Instance("", ChoiceAnswer("jam"), _place(case, "cam pressure: .*", kind="diagram"))


def _return_limit(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or design.problem.contact is Contact.FLAT:
        return
    if design.problem.closure is Closure.FORCE:
        yield Instance("", ChoiceAnswer("spring"), _profile(case))


def _shock(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None:
        return
    orders = {jump.order for jump in design.problem.jumps}
    right = "hard" if 1 in orders else "soft" if 2 in orders else "none"
    mark = "cam v: .*" if right == "hard" else "cam a: .*"
    yield Instance("", ChoiceAnswer(right), _place(case, mark, kind="diagram"))


def _working_angle(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or not design.problem.has_one_lift:
        return
    phases = (CamPhase.RISE, CamPhase.UPPER, CamPhase.RETURN)
    angles = [degrees(design.problem.length(phase)) for phase in phases]
    facts = {"sum": " + ".join(case.input_number(round(one, 2)) + "°" for one in angles if one),
             "value": case.input_number(round(sum(angles), 2)) + "°"}  # fmt: skip
    yield Instance("", case.computed(sum(angles), "deg"), _profile(case), facts)


def _dwell_profile(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and design.problem.length(CamPhase.UPPER) > 0.0:
        yield Instance("", ChoiceAnswer("arc"), _profile(case))


def _reversal(case: Case) -> Iterator[Instance]:
    if _design(case) is not None:
        yield Instance("", ChoiceAnswer("turn"), _place(case, "profile: −ω", r"profile: O_\{1\}"))


def _roller_limit(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or design.problem.contact is not Contact.ROLLER:
        return
    facts = {"radius": case.input_number(_mm(design.geometry.roller), "mm")}
    yield Instance("", ChoiceAnswer("curvature"), _place(case, r"dimension r_\{p\}"), facts)


def _curvature(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or design.problem.contact is not Contact.ROLLER:
        return
    value = design.rho_min.value
    if isfinite(value) and value > 0.0:
        answer = case.drawn(_mm(value), _mm(_sigma(case, "rho_min", "profile")), unit="mm")
        facts = {"value": case.number(_mm(value), "mm"),
                 "phi": case.input_number(round(degrees(design.rho_min.phi), 1)) + "°"}  # fmt: skip
        if answer is not None:
            yield Instance("", answer, _profile(case), facts)


def _actual_profile(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and design.problem.contact is Contact.ROLLER:
        place = _place(case, r"dimension r_\{p\}")
        yield Instance("", ChoiceAnswer("equidistant"), place)


def _ordinate_sigma(case: Case) -> float:
    """Return one sigma of an ordinate of the analogue of the velocity, m."""
    return case.length_sigma * float(_quantities(case).built.scales.v)


def _fastest(case: Case) -> Iterator[Instance]:
    """Yield the largest velocity of the follower from its analogue."""
    design = _design(case)
    if design is None or not design.problem.n or design.problem.oscillates:
        return
    problem = design.problem
    omega = abs(problem.n or 0.0) * pi / 30.0
    peak = design.highest(lambda stretch, phi: abs(problem.on(stretch, phi)[1]))
    value = peak.value * omega
    answer = case.drawn(value, omega * _ordinate_sigma(case), unit="m/s")
    if answer is not None:
        facts = {"omega": case.number(omega, "1/s"), "value": case.number(value, "m/s")}
        yield Instance("", answer, _place(case, "cam v: .*", kind="diagram"), facts)


def _largest_analogue(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None:
        return
    problem = design.problem
    peak = design.highest(lambda stretch, phi: abs(problem.on(stretch, phi)[1]))
    answer = case.drawn(_mm(peak.value), _mm(_ordinate_sigma(case)), unit="mm")
    if answer is not None:
        facts = {"value": case.number(_mm(peak.value), "mm"),
                 "phi": case.input_number(round(degrees(peak.phi), 1)) + "°"}  # fmt: skip
        yield Instance("", answer, _place(case, "cam v: .*", kind="diagram"), facts)


def _faster_cam(case: Case) -> Iterator[Instance]:
    if _design(case) is not None:
        yield Instance("", ChoiceAnswer("same"), _place(case, "cam a: .*", kind="diagram"))


def _largest_acceleration(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None:
        return
    problem = design.problem
    peak = design.highest(lambda stretch, phi: abs(problem.on(stretch, phi)[2]))
    sigma = case.length_sigma * float(_quantities(case).built.scales.a)
    answer = case.drawn(_mm(peak.value), _mm(sigma), unit="mm")
    if answer is not None:
        facts = {"value": case.number(_mm(peak.value), "mm"),
                 "phi": case.input_number(round(degrees(peak.phi), 1)) + "°"}  # fmt: skip
        yield Instance("", answer, _place(case, "cam a: .*", kind="diagram"), facts)


def _in_division(case: Case, order: int, scale: str) -> Iterator[Instance]:
    """Yield an ordinate of a diagram in each division."""
    design, letter = _design(case), "svA"[order].lower()
    if design is None:
        return
    per_mm = float(getattr(_quantities(case).built.scales, scale))
    for node in nodes_of(design.problem):
        value = _mm(float(motion_in_division(design.problem, node)[order]))
        answer = case.drawn(abs(value), _mm(case.length_sigma * per_mm), _mm(per_mm), unit="mm")
        if answer is not None:
            facts = {"number": str(node.number), "value": case.number(abs(value), "mm")}
            place = _place(case, f"cam {letter}: .*", kind="diagram")
            yield Instance(str(node.number), answer, place, facts)


def _lift_in_division(case: Case) -> Iterator[Instance]:
    yield from _in_division(case, 0, "s")


def _analogue_in_division(case: Case) -> Iterator[Instance]:
    yield from _in_division(case, 1, "v")


def _division(case: Case) -> Iterator[Instance]:
    """Yield the angle between the divisions of a phase."""
    design = _design(case)
    if design is None:
        return
    problem = design.problem
    for number, motion in enumerate(problem.moving, 1):
        value = degrees(motion.length) / problem.parts
        facts = {"phase": case.texts["phases_of"][motion.phase.value], "number": str(number),
                 "parts": str(problem.parts), "value": case.input_number(round(value, 3)) + "°",
                 "angle": case.input_number(round(degrees(motion.length), 2)) + "°"}  # fmt: skip
        place = _place(case, "cam s: .*", kind="diagram")
        yield Instance(str(number), case.computed(value, "deg"), place, facts)


def _time_of_phase(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or not design.problem.n:
        return
    for number, motion in enumerate(design.problem.moving, 1):
        value = degrees(motion.length) / (6.0 * abs(design.problem.n))
        facts = {"phase": case.texts["phases_of"][motion.phase.value], "number": str(number),
                 "n": case.input_number(abs(design.problem.n), "rev/min"),
                 "value": case.number(value, "s")}  # fmt: skip
        place = _place(case, "cam s: .*", kind="diagram")
        yield Instance(str(number), case.computed(value, "s"), place, facts)


def _mean_speed(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or not design.problem.n or design.problem.oscillates:
        return
    for number, motion in enumerate(design.problem.moving, 1):
        time = degrees(motion.length) / (6.0 * abs(design.problem.n))
        value = abs(motion.after - motion.before) / time
        facts = {"phase": case.texts["phases_of"][motion.phase.value], "number": str(number),
                 "value": case.number(value, "m/s")}  # fmt: skip
        place = _place(case, "cam s: .*", kind="diagram")
        yield Instance(str(number), case.computed(value, "m/s"), place, facts)


def _rate_at_top(case: Case) -> Iterator[Instance]:
    if _design(case) is not None:
        yield Instance("", ChoiceAnswer("zero"), _place(case, "cam v: .*", kind="diagram"))


def _area_of_acceleration(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and not any(jump.order == 1 for jump in design.problem.jumps):
        yield Instance("", ChoiceAnswer("zero"), _place(case, "cam a: .*", kind="diagram"))


def _area_of_velocity(case: Case) -> Iterator[Instance]:
    if _design(case) is not None:
        yield Instance("", ChoiceAnswer("lift"), _place(case, "cam v: .*", kind="diagram"))


def _faster_acceleration(case: Case) -> Iterator[Instance]:
    if _design(case) is not None:
        yield Instance("", ChoiceAnswer("fourfold"), _place(case, "cam a: .*", kind="diagram"))


def _closure(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None:
        yield Instance("", ChoiceAnswer(design.problem.closure.value), _profile(case))


def _flat_pressure(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or design.problem.contact is not Contact.FLAT:
        return
    if not design.problem.oscillates:
        yield Instance("", ChoiceAnswer("zero"), _profile(case))


def _flat_contact(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is None or design.problem.contact is not Contact.FLAT:
        return
    if not design.problem.oscillates:
        yield Instance("", ChoiceAnswer("analogue"), _profile(case))


def _flat_convex(case: Case) -> Iterator[Instance]:
    design = _design(case)
    if design is not None and design.problem.contact is Contact.FLAT:
        yield Instance("", ChoiceAnswer("convex"), _place(case, r"dimension r_\{min\}"))


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "working_angle": _working_angle,
        "shock": _shock,
        "largest_analogue": _largest_analogue,
        "fastest": _fastest,
        "faster_cam": _faster_cam,
        "pressure_meaning": _pressure_meaning,
        "jamming": _jamming,
        "largest_pressure": _largest_pressure,
        "return_limit": _return_limit,
        "least_radius": _least_radius,
        "wider_cam": _wider_cam,
        "reversal": _reversal,
        "dwell_profile": _dwell_profile,
        "actual_profile": _actual_profile,
        "roller_limit": _roller_limit,
        "curvature": _curvature,
        "largest_acceleration": _largest_acceleration,
        "lift_in_division": _lift_in_division,
        "analogue_in_division": _analogue_in_division,
        "division": _division,
        "time_of_phase": _time_of_phase,
        "mean_speed": _mean_speed,
        "rate_at_top": _rate_at_top,
        "area_of_acceleration": _area_of_acceleration,
        "area_of_velocity": _area_of_velocity,
        "faster_acceleration": _faster_acceleration,
        "closure": _closure,
        "flat_pressure": _flat_pressure,
        "flat_contact": _flat_contact,
        "flat_convex": _flat_convex,
    }
)
"""Templates by their keys in the catalogue."""
