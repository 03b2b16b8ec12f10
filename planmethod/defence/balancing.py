"""Questions on counterweights and the shaking force (уравновешивание)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from types import MappingProxyType

import numpy as np

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place
from planmethod.note.narrate.naming import point_name
from planmethod.problem.machine_records import Weighing
from planmethod.project.parts import PartName
from planmethod.solved.machine.balancing import SLIDER_CRANK, Balancing, balancing_of

BALANCING = PartName.BALANCING


def _balancing(case: Case) -> Balancing | None:
    project = case.project
    if project is None or project.part(BALANCING) is None:
        return None
    return balancing_of(project.solution)


def _scheme(case: Case, *marks: str) -> Place:
    return case.of_part(BALANCING, "scheme", *marks)


def _counterweight(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    for number, one in enumerate(() if found is None else found.counterweights):
        if found is not None and one.mass:
            facts = {
                "link": one.link, "radius": case.input_number(one.radius, "m"),
                "moment": case.number(abs(one.moment), "kg·m"),
                "value": case.number(one.mass, "kg"),
            }  # fmt: skip
            per_mm = found.polygon(number, case.profile)[1] / one.radius
            answer = case.drawn(one.mass, case.length_sigma * per_mm, per_mm, "kg")
            if answer is not None:
                yield Instance(one.link, answer, _scheme(case), facts)


def _farther_counterweight(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    for one in () if found is None else found.counterweights:
        if one.mass:
            yield Instance(one.link, ChoiceAnswer("half"), _scheme(case), {"link": one.link})


def _counterweight_side(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    for one in () if found is None else found.counterweights:
        turned = abs(one.angle_deg - 180.0)
        if one.mass and turned < 1e-6:
            facts = {"link": one.link, "pivot": point_name(one.pivot), "pin": point_name(one.pin)}
            yield Instance(one.link, ChoiceAnswer("behind"), _scheme(case), facts)


def _largest_before(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and found.largest[0] > 0.0:
        value, title = found.largest[0], re.escape(case.language.machine.before)
        place = case.sheets.find_text(BALANCING, rf"{title}@.*")
        if place is not None:
            answer = case.computed(value, "N")
            yield Instance("", answer, place, {"value": case.number(value, "N")})


def _whole_balance(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and found.task.method is not Weighing.PARTIAL:
        yield Instance("", ChoiceAnswer("fixed"), _scheme(case))


def _partial_balance(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and found.task.method is Weighing.PARTIAL:
        before, after = found.largest
        facts = {"before": case.number(before, "N"), "after": case.number(after, "N")}
        yield Instance("", ChoiceAnswer("rest"), _scheme(case), facts)


def _main_moment(case: Case) -> Iterator[Instance]:
    if _balancing(case) is not None:
        yield Instance("", ChoiceAnswer("not"), _scheme(case))


def _at_other_speed(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None:
        yield Instance("", ChoiceAnswer("same"), _scheme(case), {"link": found.crank})


def _replaced_rod(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is None or not abs(found.rod_masses[0]) or abs(found.share.imag) > 1e-9:
        return
    mass = found.dynamics.masses[found.rod].mass
    pins = (found.crank_pin, found.rod_pin)
    for pin, share in zip(pins, found.rod_masses, strict=True):
        value = float(np.real(share))
        if value > 0.0:
            facts = {
                "rod": found.rod, "pin": point_name(pin), "mass": case.input_number(mass, "kg"),
                "centre": point_name(str(found.dynamics.masses[found.rod].centre)),
                "ends": ", ".join(map(point_name, pins)), "value": case.number(value, "kg"),
                "other": point_name(next(p for p in pins if p != pin)),
            }  # fmt: skip
            yield Instance(pin, case.computed(value, "kg"), _scheme(case), facts)


def _slider_harmonic(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and found.structure == SLIDER_CRANK:
        yield Instance("", ChoiceAnswer("whole"), _scheme(case), {"link": found.crank})


def _added_mass(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None:
        value = found.mass_after - found.mass_before
        answer = case.computed(value, "kg") if value > 0.0 else None
        count = sum(1 for one in found.counterweights if one.mass)
        if answer is not None and count > 1:
            facts = {"value": case.number(value, "kg"), "count": str(count)}
            yield Instance("", answer, _scheme(case), facts)


def _static_moment(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    for number, one in enumerate(() if found is None else found.counterweights):
        if found is not None and one.mass:
            value, per_mm = abs(one.moment), found.polygon(number, case.profile)[1]
            answer = case.drawn(value, case.length_sigma * per_mm, per_mm, "kg·m")
            if answer is not None:
                facts = {"link": one.link, "value": case.number(value, "kg·m"),
                         "pivot": point_name(one.pivot)}  # fmt: skip
                yield Instance(one.link, answer, _scheme(case), facts)


def _own_moment(case: Case) -> Iterator[Instance]:
    """Yield the static moment of the mass of a link itself."""
    found = _balancing(case)
    for one in () if found is None else found.counterweights:
        mass = None if found is None else found.dynamics.masses.get(one.link)
        if found is None or mass is None or not mass.mass or one.link == found.rod:
            continue
        size = mass.mass * abs(found.centre_on_line(one.link, one.pivot, one.pin)) * one.length
        if size:
            facts = {"link": one.link, "mass": case.input_number(mass.mass, "kg"),
                     "centre": point_name(str(mass.centre)), "pivot": point_name(one.pivot),
                     "value": case.number(size, "kg·m")}  # fmt: skip
            yield Instance(one.link, case.computed(size, "kg·m"), _scheme(case), facts)


def _polygon_scale(case: Case) -> Iterator[Instance]:
    """Yield the length that shows a counterweight on the polygon."""
    found = _balancing(case)
    for number, one in enumerate(() if found is None else found.counterweights):
        if found is not None and one.mass:
            per_mm = found.polygon(number, case.profile)[1]
            value = abs(one.moment) / per_mm
            answer = case.drawn(value, case.length_sigma, 1.0, "mm")
            if answer is not None:
                facts = {"link": one.link, "value": case.number(value, "mm")}
                yield Instance(one.link, answer, _scheme(case), facts)


def _mass_farther(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    for one in () if found is None else found.counterweights:
        if one.mass:
            radius = round(1.5 * one.radius, 6)
            value = abs(one.moment) / radius
            facts = {"link": one.link, "radius": case.input_number(radius, "m"),
                     "value": case.number(value, "kg")}  # fmt: skip
            yield Instance(one.link, case.computed(value, "kg"), _scheme(case), facts)


def _two_masses(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and any(found.rod_masses):
        facts = {"rod": found.rod}
        yield Instance("", ChoiceAnswer("centre"), _scheme(case), facts)


def _whole_mass(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None:
        facts = {"value": case.number(found.mass_before, "kg")}
        yield Instance("", case.computed(found.mass_before, "kg"), _scheme(case), facts)


def _closed_polygon(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and any(one.mass for one in found.counterweights):
        yield Instance("", ChoiceAnswer("closed"), _scheme(case))


def _cause(case: Case) -> Iterator[Instance]:
    if _balancing(case) is not None:
        yield Instance("", ChoiceAnswer("accelerated"), _scheme(case))


def _drawback(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and any(one.mass for one in found.counterweights):
        yield Instance("", ChoiceAnswer("heavier"), _scheme(case))


def _resting_mass(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    for pin in () if found is None or not any(found.rod_masses) else (found.crank_pin,):
        if found is not None:
            facts = {"rod": found.rod, "pin": point_name(pin), "crank": found.crank}
            yield Instance(pin, ChoiceAnswer("crank"), _scheme(case), facts)


def _doubled_speed(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and found.largest[0] > 0.0:
        value = 4.0 * found.largest[0]
        facts = {"crank": found.crank, "value": case.number(value, "N")}
        yield Instance("", case.computed(value, "N"), _scheme(case), facts)


def _centre_of_all(case: Case) -> Iterator[Instance]:
    found = _balancing(case)
    if found is not None and found.task.method is not Weighing.PARTIAL:
        yield Instance("", ChoiceAnswer("rests"), _scheme(case))


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "replaced_rod": _replaced_rod,
        "counterweight": _counterweight,
        "farther_counterweight": _farther_counterweight,
        "counterweight_side": _counterweight_side,
        "added_mass": _added_mass,
        "largest_before": _largest_before,
        "whole_balance": _whole_balance,
        "partial_balance": _partial_balance,
        "main_moment": _main_moment,
        "at_other_speed": _at_other_speed,
        "slider_harmonic": _slider_harmonic,
        "static_moment": _static_moment,
        "own_moment": _own_moment,
        "polygon_scale": _polygon_scale,
        "mass_farther": _mass_farther,
        "two_masses": _two_masses,
        "whole_mass": _whole_mass,
        "closed_polygon": _closed_polygon,
        "cause": _cause,
        "drawback": _drawback,
        "resting_mass": _resting_mass,
        "doubled_speed": _doubled_speed,
        "centre_of_all": _centre_of_all,
    }
)
"""Templates of balancing by their keys in the catalogue."""
