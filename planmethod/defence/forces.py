"""Questions on the force analysis of the calculated position and of the cycle (силовой расчёт)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from types import MappingProxyType

import numpy as np

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place
from planmethod.mechanism.model import FRAME
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.structure import links_of_group
from planmethod.plans.forces.polygons import Applied, LoadKind, reaction_symbol
from planmethod.problem.model import MOMENT
from planmethod.project.parts import PartName
from planmethod.solved.errors.forces import BALANCE, DIFFERENCE, drawn_forces, size_label
from planmethod.solved.forces.loads import applied
from planmethod.solved.forces.statics import JointForce, statics_of
from planmethod.solved.solution import Solution

NOISE = 1e-6
"""Share of the largest force below which a force is zero."""

FORCES = PartName.FORCES


def _loads(case: Case, *kinds: LoadKind) -> Iterator[Applied]:
    """Yield the loads of some kinds that act in the calculated position."""
    if not case.has_forces:
        return
    largest = case.statics.largest(0)
    for one in applied(case.loaded):
        size = abs(one.force[0]) if one.point else abs(one.couple[0])
        if one.kind in kinds and size > NOISE * largest:
            yield one


def _on_scheme(case: Case, name: str) -> Place:
    return case.of_part(FORCES, "position", rf"loads \d+ (force|couple) \d+: {re.escape(name)}")


def _weight(case: Case) -> Iterator[Instance]:
    dynamics = case.solution.problem.dynamics
    for one in _loads(case, LoadKind.WEIGHT):
        assert dynamics is not None
        mass = case.masses[one.link].mass
        facts = {"symbol": one.name, "link": one.link, "mass": case.input_number(mass, "kg"),
                 "g": case.input_number(dynamics.gravity, "m/s²")}  # fmt: skip
        answer = case.computed(abs(one.force[0]), "N")
        yield Instance(one.link, answer, _on_scheme(case, one.name), facts)


def _inertia(case: Case) -> Iterator[Instance]:
    for one in _loads(case, LoadKind.INERTIA):
        mass = case.masses[one.link]
        spread = _spread(case, f"a_{mass.centre}")
        value = abs(one.force[0])
        answer = case.drawn(value, mass.mass * spread, unit="N")
        if answer is not None:
            facts = {
                "symbol": one.name, "link": one.link, "at": case.at_calculated,
                "centre": point_name(str(mass.centre)), "mass": case.input_number(mass.mass, "kg"),
                "acceleration": case.number(value / mass.mass, "m/s²"),
            }  # fmt: skip
            yield Instance(one.link, answer, _on_scheme(case, one.name), facts)


def _spread(case: Case, label: str) -> float:
    """Return one sigma of a quantity of the motion in the calculated position; 0 if it is given."""
    from planmethod.note.tables.errors import spread_of

    spread = spread_of(case.loaded, label)
    return 0.0 if spread is None else float(spread.sigma[0])


def _inertia_direction(case: Case) -> Iterator[Instance]:
    for one in _loads(case, LoadKind.INERTIA):
        centre = point_name(str(case.masses[one.link].centre))
        facts = {"symbol": one.name, "centre": centre, "link": one.link}
        yield Instance(one.link, ChoiceAnswer("against"), _on_scheme(case, one.name), facts)


def _couple(case: Case) -> Iterator[Instance]:
    for one in _loads(case, LoadKind.INERTIA_COUPLE):
        mass = case.masses[one.link]
        sigma = mass.inertia * _spread(case, f"epsilon_{one.link}")
        answer = case.drawn(abs(one.couple[0]), sigma, unit="N·m")
        if answer is not None:
            facts = {
                "symbol": one.name, "link": one.link, "at": case.at_calculated,
                "inertia": case.input_number(mass.inertia, "kg·m²"),
                "value": case.number(abs(one.couple[0]), "N·m"),
            }  # fmt: skip
            yield Instance(one.link, answer, _on_scheme(case, one.name), facts)


def _couple_sense(case: Case) -> Iterator[Instance]:
    for one in _loads(case, LoadKind.INERTIA_COUPLE):
        sigma = case.masses[one.link].inertia * _spread(case, f"epsilon_{one.link}")
        if case.drawn(abs(one.couple[0]), sigma) is None:
            continue
        facts = {"symbol": one.name, "link": one.link, "at": case.at_calculated}
        right = "ccw" if one.couple[0] > 0 else "cw"
        yield Instance(one.link, ChoiceAnswer(right), _on_scheme(case, one.name), facts)


def _given_load(case: Case) -> Iterator[Instance]:
    for one in _loads(case, LoadKind.EXTERNAL):
        if one.point is None:
            continue
        link = case.loaded.points.get(one.point)
        if link is None or abs(link.velocity[0]) == 0.0:
            continue
        worked = float((one.force[0] * link.velocity[0].conjugate()).real)
        size = abs(one.force[0]) * abs(link.velocity[0])
        if abs(worked) < 0.05 * size:
            continue
        facts = {"symbol": one.name, "link": one.link, "at": case.at_calculated,
                 "point": point_name(one.point)}  # fmt: skip
        right = "resists" if worked < 0 else "drives"
        yield Instance(one.name, ChoiceAnswer(right), _on_scheme(case, one.name), facts)


def _doubled_inertia(case: Case) -> Iterator[Instance]:
    drive = case.solution.problem.drive
    if not drive.revolves or drive.acceleration or not drive.rate:
        return
    for one in _loads(case, LoadKind.INERTIA):
        mass = case.masses[one.link]
        value = abs(one.force[0])
        answer = case.drawn(value, mass.mass * _spread(case, f"a_{mass.centre}"), unit="N", times=4)
        if answer is not None:
            facts = {"symbol": one.name, "at": case.at_calculated, "driver": drive.link,
                     "before": case.number(value, "N"),
                     "value": case.number(4 * value, "N")}  # fmt: skip
            yield Instance(one.link, answer, _on_scheme(case, one.name), facts)


# Groups and reactions ----------------------------------------------------------------------------


def decapitalized(text: Rich) -> Rich:
    """Return a name with a small first letter."""
    return text[:1].lower() + text[1:]


def _groups(case: Case) -> dict[str, Rich]:
    found = {
        ",".join(group.links): decapitalized(links_of_group(group, case.language.note))
        for group in case.solution.structure.groups
    }
    driver = case.solution.problem.drive.link
    return found | {"driver": case.link(driver)}


def _first_group(case: Case) -> Iterator[Instance]:
    groups = case.solution.structure.groups
    if case.has_forces and len(groups) > 1:
        options = _groups(case)
        right = ",".join(groups[-1].links)
        place = case.of_part(FORCES, "forces", r"plan 0 0 .*")
        yield Instance(
            "", ChoiceAnswer(right, options), place, {"links": "–".join(groups[-1].links)}
        )


def _last_link(case: Case) -> Iterator[Instance]:
    groups = case.solution.structure.groups
    if case.has_forces and len(groups) > 1:
        number = len(groups)
        place = case.of_part(FORCES, "forces", rf"(plan|cut) 0 {number} .*")
        yield Instance("", ChoiceAnswer("driver", _groups(case)), place,
                    {"driver": case.solution.problem.drive.link})  # fmt: skip


def _determinate(case: Case) -> Iterator[Instance]:
    for number, group in enumerate(case.solution.structure.force_order):
        if case.has_forces and group.is_dyad:
            links = "–".join(group.links)
            place = case.of_part(FORCES, "position", rf"cut 0 {number} .*")
            yield Instance(links, ChoiceAnswer("equal"), place, {"links": links})


def _symbol(case: Case, joint: JointForce, *, back: bool = False) -> Rich:
    called = case.loaded.problem.mechanism.called
    on, by = (joint.by, joint.on) if back else (joint.on, joint.by)
    return reaction_symbol(called(on), called(by))


def _joints(case: Case) -> Iterator[tuple[JointForce, Rich, Place]]:
    """Yield the reactions that are named on a force plan, with their places."""
    if not case.has_forces:
        return
    largest = case.statics.largest(0)
    for joint in case.statics.reactions:
        if abs(joint.force[0]) <= NOISE * largest:
            continue
        for back in (False, True):
            symbol = _symbol(case, joint, back=back)
            place = case.sheets.find(FORCES, "forces", rf"plan .*: {re.escape(symbol)}")
            if place is not None:
                yield joint, symbol, place
                break


def _reaction(case: Case) -> Iterator[Instance]:
    for joint, symbol, place in _joints(case):
        spread = drawn_forces(case.statics).spreads.get(size_label(joint))
        sigma = 0.0 if spread is None else float(spread.sigma[0])
        value = abs(joint.force[0])
        answer = case.drawn(value, sigma, unit="N")
        if answer is not None:
            facts = {"symbol": symbol, "at": case.at_calculated, "joint": point_name(joint.joint),
                     "value": case.number(value, "N")}  # fmt: skip
            yield Instance(symbol, answer, place, facts, requests=symbol)


def _opposite(case: Case) -> Iterator[Instance]:
    for joint, symbol, place in _joints(case):
        back = _symbol(case, joint, back=symbol == _symbol(case, joint))
        yield Instance(symbol, ChoiceAnswer("opposite"), place, {"symbol": symbol, "back": back})


def _guide_reaction(case: Case) -> Iterator[Instance]:
    problem = case.loaded.problem
    rubbed = problem.dynamics is not None and problem.dynamics.friction is not None
    pins = {slide.pin: link for link, slide in problem.slides.items() if slide.host == FRAME}
    for joint, symbol, place in _joints(case):
        sliders = {pins.get(joint.joint)}
        if sliders & {joint.on, joint.by} and FRAME in (joint.on, joint.by) and not rubbed:
            facts = {"symbol": symbol, "link": pins[joint.joint]}
            yield Instance(symbol, ChoiceAnswer("normal"), place, facts)


def _moment_point(case: Case) -> Iterator[Instance]:
    """Yield about which point the moments of a link give its tangential reaction."""
    for number, group in enumerate(case.solution.structure.force_order):
        if not case.has_forces or group.signature not in ("RRR", "RRP"):
            continue
        inner = next((one.point for one in group.inner if hasattr(one, "point")), None)
        place = case.sheets.find(FORCES, "position", rf"cut 0 {number} force \d+: F\^\{{τ\}}.*")
        if place is not None and inner is not None:
            symbol = place.mark.partition(": ")[2]
            facts = {"symbol": symbol, "links": "–".join(group.links), "point": point_name(inner)}
            yield Instance(symbol, ChoiceAnswer("inner"), place, facts)


def _force_of_segment(case: Case) -> Iterator[Instance]:
    for sheet in case.sheets.sheets:
        if sheet.part is not FORCES:
            continue
        for view in sheet.drawing.views:
            for span in view.spans if view.kind == "forces" else ():
                if span.magnification != 1.0 or span.length < 10.0 or not view.per_mm:
                    continue
                notation = case.language.notation
                per_mm = view.per_mm
                scale = f"{view.scale} = {notation.as_input(per_mm)} {case.unit('N')}/" + case.unit(
                    "mm"
                )
                facts = {"length": case.number(round(span.length, 1), "mm"), "scale": scale}
                place = case.sheets.place_of(sheet, view, (span.start + span.end) / 2)
                value = round(span.length, 1) * per_mm
                facts["value"] = case.number(value, "N")
                yield Instance(span.name, case.computed(value, "N"), place, facts)


# The driving link --------------------------------------------------------------------------------


def _is_moment(case: Case) -> bool:
    return case.has_forces and case.solution.problem.drive.balancing is MOMENT


def _balance(case: Case) -> Iterator[Instance]:
    if not _is_moment(case):
        return
    value = float(case.statics.balance[0])
    sigma = float(drawn_forces(case.statics).spreads[BALANCE].sigma[0])
    answer = case.drawn(abs(value), sigma, unit="N·m")
    if answer is not None:
        facts = {"symbol": _balance_symbol(case), "at": case.at_calculated,
                 "link": case.solution.problem.drive.link,
                 "value": case.number(abs(value), "N·m")}  # fmt: skip
        yield Instance("", answer, _driver_place(case), facts)


def _balance_symbol(case: Case) -> Rich:
    return case.language.notation.symbol(MOMENT.symbol)


def _driver_place(case: Case) -> Place:
    symbol = re.escape(_balance_symbol(case))
    return case.of_part(FORCES, "position", rf"cut 0 \d+ couple \d+: {symbol}")


def _balance_clear(case: Case) -> bool:
    if not _is_moment(case):
        return False
    sigma = float(drawn_forces(case.statics).spreads[BALANCE].sigma[0])
    return case.drawn(abs(float(case.statics.balance[0])), sigma) is not None


def _balance_sense(case: Case) -> Iterator[Instance]:
    if _balance_clear(case):
        right = "ccw" if case.statics.balance[0] > 0 else "cw"
        facts = {"symbol": _balance_symbol(case), "at": case.at_calculated,
                 "link": case.solution.problem.drive.link}  # fmt: skip
        yield Instance("", ChoiceAnswer(right), _driver_place(case), facts)


def _balance_power(case: Case) -> Iterator[Instance]:
    rate = case.solution.problem.drive.rate
    if _balance_clear(case) and rate:
        power = float(case.statics.balance[0]) * rate
        facts = {"symbol": _balance_symbol(case), "at": case.at_calculated}
        right = "drives" if power > 0 else "brakes"
        yield Instance("", ChoiceAnswer(right), _driver_place(case), facts)


def _power(case: Case) -> Iterator[Instance]:
    rate = case.solution.problem.drive.rate
    if not _is_moment(case) or not rate:
        return
    value = abs(float(case.statics.balance[0]) * rate)
    sigma = abs(rate) * float(drawn_forces(case.statics).spreads[BALANCE].sigma[0])
    answer = case.drawn(value, sigma, unit="W")
    if answer is not None:
        facts = {"symbol": _balance_symbol(case), "at": case.at_calculated,
                 "value": case.number(value, "W"),
                 "link": case.solution.problem.drive.link}  # fmt: skip
        yield Instance("", answer, _driver_place(case), facts)


def _lever_place(case: Case) -> Place | None:
    found = case.sheets.find(FORCES, "velocity", r"lever.*")
    if found is not None:
        return found
    for sheet in case.sheets.sheets:
        for view in sheet.drawing.views if sheet.part is FORCES else ():
            place = case.sheets.place_of(sheet, view)
            if place.view.startswith(case.language.sheets.lever):
                return place
    return None


def _lever_turned(case: Case) -> Iterator[Instance]:
    place = _lever_place(case) if case.has_forces else None
    if place is not None and case.statics.lever_at(0) is not None:
        yield Instance("", ChoiceAnswer("arms"), place)


def _lever_forces(case: Case) -> Iterator[Instance]:
    place = _lever_place(case) if case.has_forces else None
    if place is not None and case.statics.lever_at(0) is not None:
        yield Instance("", ChoiceAnswer("external"), place)


def _lever_check(case: Case) -> Iterator[Instance]:
    place = _lever_place(case) if case.has_forces else None
    if place is None or not _balance_clear(case) or case.statics.lever_at(0) is None:
        return
    spread = drawn_forces(case.statics).spreads.get(DIFFERENCE)
    if spread is not None:
        sigma = float(spread.sigma[0])
        share = 100.0 * sigma / abs(float(case.statics.balance[0]))
        facts = {"symbol": _balance_symbol(case), "share": case.input_number(round(share, 1))}
        yield Instance("", ChoiceAnswer("drafting"), place, facts)


# The cycle ---------------------------------------------------------------------------------------


def _every(case: Case) -> Solution | None:
    solution = case.solution
    return solution if case.has_forces and solution.problem.cycle is not None else None


def _largest_reaction(case: Case) -> Iterator[Instance]:
    solution = _every(case)
    if solution is None or len(solution.positions) < 4:
        return
    for joint in statics_of(solution).reactions:
        sizes = np.abs(joint.force)
        best = int(np.argmax(sizes))
        rest = np.delete(sizes, best)
        symbol = _symbol(case, joint)
        place = case.sheets.find_lettered(FORCES, "reactions", symbol)
        if place is None or sizes[best] < 1.05 * float(np.max(rest)):
            continue
        facts = {"symbol": symbol, "value": case.number(float(sizes[best]), "N")}
        yield Instance(symbol, case.exactly(best), place, facts)


def _balance_over_cycle(case: Case) -> Iterator[Instance]:
    solution = _every(case)
    if solution is None or not _is_moment(case):
        return
    place = case.sheets.find(FORCES, "balance")
    sizes = np.abs(statics_of(solution).balance)
    best = int(np.argmax(sizes))
    rest = np.delete(sizes, best)
    if place is not None and len(rest) and sizes[best] > 1.05 * float(np.max(rest)):
        facts = {"symbol": _balance_symbol(case), "value": case.number(float(sizes[best]), "N·m")}
        yield Instance("", case.exactly(best), place, facts)


TEMPLATES: Mapping[str, Template] = MappingProxyType(
    {
        "weight": _weight,
        "inertia": _inertia,
        "inertia_direction": _inertia_direction,
        "couple": _couple,
        "couple_sense": _couple_sense,
        "given_load": _given_load,
        "doubled_inertia": _doubled_inertia,
        "first_group": _first_group,
        "determinate": _determinate,
        "moment_point": _moment_point,
        "reaction": _reaction,
        "opposite": _opposite,
        "guide_reaction": _guide_reaction,
        "force_of_segment": _force_of_segment,
        "last_link": _last_link,
        "balance": _balance,
        "balance_sense": _balance_sense,
        "balance_power": _balance_power,
        "power": _power,
        "lever_turned": _lever_turned,
        "lever_forces": _lever_forces,
        "lever_check": _lever_check,
        "largest_reaction": _largest_reaction,
        "balance_over_cycle": _balance_over_cycle,
    }
)
"""Templates by their keys in the catalogue."""
