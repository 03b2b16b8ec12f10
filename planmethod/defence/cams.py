"""Questions on a cam and its follower (кулачковый механизм)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import degrees, isfinite, pi
from types import MappingProxyType

from planmethod.cams.design import CamDesign
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
    part = None if case.project is None else PartName.CAM
    return case.of_part(part, kind, *marks)


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
    }
)
"""Templates by their keys in the catalogue."""
