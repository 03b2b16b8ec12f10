"""Questions on gear trains and on two wheels in mesh (зубчатые механизмы, зацепление)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import cos, degrees
from types import MappingProxyType

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place
from planmethod.gears.involute.geometry import MeshingProblem, Pair
from planmethod.gears.model import GearProblem, MeshKind, parse
from planmethod.gears.motion import TrainKind, TrainMotion, solve_motion
from planmethod.gears.solution import answer as value_of
from planmethod.note.formula import Rich
from planmethod.project.parts import PartName

# Gear trains -------------------------------------------------------------------------------------


def _train(case: Case) -> TrainMotion | None:
    return case.solved(GearProblem, solve_motion)


def _part(case: Case, name: PartName) -> PartName | None:
    """Return the part of the sheets; None of a work that is one problem."""
    return None if case.project is None else name


def _on_train(case: Case, *marks: str, kind: str = "position") -> Place:
    return case.of_part(_part(case, PartName.GEARS), kind, *marks)


def _ends(motion: TrainMotion) -> tuple[str, str] | None:
    """Return the input and the output of a train with one input."""
    train = motion.train
    if len(train.inputs) != 1:
        return None
    (start,) = train.inputs
    planets = {x for some in motion.roles.planets.values() for x in some}
    moving = [
        body
        for body in train.bodies
        if motion.speeds.get(body) and body not in {start, *planets} and body not in train.racks
    ]
    end = train.output or (moving[-1] if moving else None)
    if end is None or end == start or start in train.racks or end in train.racks:
        return None
    return (start, end) if motion.has_sign(start, end) else None


def _symbol(motion: TrainMotion, name: str) -> Rich:
    return parse(name, tuple(motion.train.body_of)).symbol


def _train_mobility(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    found = motion.structure
    facts = {"n": str(found.moving), "low": str(found.lower), "high": str(found.higher),
             "w": str(found.mobility)}  # fmt: skip
    if found.formula == found.mobility and not found.is_spatial:
        yield Instance("", case.exactly(found.mobility), _on_train(case), facts)


def _train_kind(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is not None and motion.structure.kind is not TrainKind.CLOSED:
        right = motion.structure.kind.value
        yield Instance("", ChoiceAnswer(right), _on_train(case))


def _ratio(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    ends = None if motion is None else _ends(motion)
    if motion is None or ends is None:
        return
    name = f"U_{ends[0]}_{ends[1]}"
    value = float(motion.speed(ends[0]) / motion.speed(ends[1]))
    facts = {"symbol": _symbol(motion, name), "first": ends[0], "last": ends[1],
             "value": case.number(value)}  # fmt: skip
    yield Instance("", case.computed(value), _on_train(case), facts, requests="U")


def _ratio_sign(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    ends = None if motion is None else _ends(motion)
    if motion is not None and ends is not None:
        right = "same" if motion.speed(ends[0]) * motion.speed(ends[1]) > 0 else "opposite"
        facts = {"first": ends[0], "last": ends[1]}
        yield Instance("", ChoiceAnswer(right), _on_train(case, "rays .*", kind="velocity"), facts)


def _speed(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    train = motion.train
    unit = "rev/min" if train.unit == "n" else "1/s"
    for body in train.bodies:
        if body in {*train.inputs, *train.fixed, *train.racks} or not motion.speeds.get(body):
            continue
        value = abs(float(motion.speeds[body]))
        facts = {
            "symbol": _symbol(motion, f"{train.unit}_{body}"), "body": body,
            "value": case.number(value, unit),
        }  # fmt: skip
        place = _on_train(case, rf"rays (.*, )?{re.escape(body)}(,.*)?", kind="velocity")
        yield Instance(body, case.computed(value, unit), place, facts)


def _inverted(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    for carrier, central in motion.roles.central.items():
        for one, other in pairwise(central):
            name = f"U_{one}_{other}^{carrier}"
            value = value_of(motion, name).value
            if value and motion.has_sign(one, other):
                facts = {"symbol": _symbol(motion, name), "carrier": carrier,
                         "first": one, "last": other,
                         "value": case.number(float(value))}  # fmt: skip
                yield Instance(name, case.computed(float(value)), _on_train(case), facts)


def _willis(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    for carrier in () if motion is None else motion.roles.central:
        place = _on_train(case, f"wheel {re.escape(carrier)}")
        yield Instance(carrier, ChoiceAnswer("stops"), place, {"carrier": carrier})


def _fixed_wheel(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None or motion.structure.kind is not TrainKind.PLANETARY:
        return
    for body in motion.train.fixed:
        for planets in motion.roles.planets.values():
            if planets:
                yield Instance(body, ChoiceAnswer("differential"), _on_train(case), {"body": body})
                break


def _planets(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    for carrier, count in () if motion is None else motion.train.planets.items():
        if count > 1:
            facts = {"count": str(count), "carrier": carrier}
            yield Instance(carrier, ChoiceAnswer("one"), _on_train(case), facts)


def _pitch_diameter(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None or not motion.train.toothed:
        return
    for label, rim in motion.train.wheels.items():
        module = rim.module or motion.train.module
        teeth = motion.axes.sizes.get(label)
        if module is None or teeth is None or rim.is_pulley:
            continue
        value = float(module * teeth)
        mm = 1000.0 * float(module)
        facts = {"label": label, "module": case.input_number(mm, "mm"), "z": str(teeth),
                 "value": case.input_number(1000.0 * value, "mm")}  # fmt: skip
        place = _on_train(case, f"wheel {re.escape(label)}", f"front {re.escape(label)}")
        yield Instance(label, case.computed(1000.0 * value, "mm"), place, facts)


def _pole_velocity(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    for mesh in motion.train.meshes:
        if mesh.kind in (MeshKind.EXTERNAL, MeshKind.INTERNAL):
            place = case.sheets.find(
                _part(case, PartName.GEARS),
                "position",
                rf"at pitch {re.escape(mesh.first)}-{re.escape(mesh.second)}",
            )
            if place is not None:
                facts = {"first": mesh.first, "last": mesh.second}
                yield Instance(mesh.name, ChoiceAnswer("equal"), place, facts)


def _instant_centre(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    train = motion.train
    for planets in motion.roles.planets.values():
        for planet in planets:
            for mesh in train.meshes:
                ends = train.ends(mesh)
                if planet in ends and set(ends) & set(train.fixed):
                    still = next(x for x in ends if x in train.fixed)
                    facts = {"planet": planet, "still": still}
                    place = _on_train(case, rf"line {re.escape(planet)}", kind="velocity")
                    yield Instance(planet, ChoiceAnswer("pole"), place, facts)


def _idler(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    train = motion.train
    for label, rim in train.wheels.items():
        meshes = [m for m in train.meshes if label in (m.first, m.second)]
        alone = [x for x in train.wheels if train.body_of[x] == train.body_of[label]] == [label]
        both = all(m.kind is MeshKind.EXTERNAL for m in meshes)
        if len(meshes) == 2 and alone and both and not any(train.carrier(m) for m in meshes):
            del rim
            yield Instance(label, ChoiceAnswer("sign"), _on_train(case), {"label": label})
            break


TRAINS: Mapping[str, Template] = MappingProxyType(
    {
        "train_mobility": _train_mobility,
        "train_kind": _train_kind,
        "ratio": _ratio,
        "ratio_sign": _ratio_sign,
        "speed": _speed,
        "inverted": _inverted,
        "willis": _willis,
        "fixed_wheel": _fixed_wheel,
        "planets": _planets,
        "instant_centre": _instant_centre,
        "pole_velocity": _pole_velocity,
        "idler": _idler,
        "pitch_diameter": _pitch_diameter,
    }
)
"""Templates of a gear train by their keys in the catalogue."""


# Two wheels in mesh ------------------------------------------------------------------------------


def _meshing(case: Case) -> tuple[MeshingProblem, Pair] | None:
    problem = case.problem_of(MeshingProblem)
    return None if problem is None else (problem, Pair.of(problem))


def _on_mesh(case: Case, *marks: str) -> Place:
    return case.of_part(_part(case, PartName.MESHING), "meshing", *marks)


def _of_mesh(
    case: Case, about: str, value: float, unit: str, mark: str, facts: Mapping[str, Rich]
) -> Instance:
    """Return a question on a size of the pair."""
    answer = case.computed(value, unit)
    return Instance(
        about, answer, _on_mesh(case, mark), {**facts, "value": case.number(value, unit)}
    )


def _wheels(meshing: tuple[MeshingProblem, Pair]) -> Iterator[tuple[int, str]]:
    """Yield the wheels that a rack cuts: their indices and numbers."""
    for k in (0,) if meshing[1].cutter else (0, 1):
        yield k, str(k + 1)


def _overlap(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        yield _of_mesh(case, "", float(found[1].epsilon), "", "(N_{1}|P)".replace("{", "\\{"), {})


def _overlap_limit(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("continuous"), _on_mesh(case, "P"))


def _line_of_action(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("bases"), _on_mesh(case, r"N_\{1\}"))


def _working_angle(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        value = degrees(float(found[1].alpha_w))
        facts = {"symbol": "α_{w}"}
        yield _of_mesh(case, "", value, "deg", "dimension α_w", facts)


def _centre_distance(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        yield _of_mesh(case, "", abs(float(found[1].a_w)), "mm", "dimension a_w", {})


def _wider_centres(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None and not found[1].cutter:
        yield Instance("", ChoiceAnswer("angle"), _on_mesh(case, "dimension a_w"))


def _base_radius(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None or found[1].beta:
        return
    problem, pair = found
    for k, number in _wheels(found):
        facts = {"wheel": number, "z": str(problem.z[k]), "m": case.input_number(problem.m, "mm"),
                 "alpha": case.input_number(degrees(problem.rack.alpha)) + "°"}  # fmt: skip
        value = abs(float(pair.d_b[k])) / 2.0
        yield _of_mesh(case, number, value, "mm", rf"dimension r_\{{b{number}\}}", facts)


def _pitch(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None:
        facts = {"m": case.input_number(found[0].m, "mm")}
        yield _of_mesh(case, "", found[1].p, "mm", "dimension p", facts)


def _shift_sign(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        x = float(found[1].x[k])
        facts = {"wheel": number, "z": str(found[0].z[k]), "x": case.input_number(round(x, 4)),
                 "least": case.number(float(found[1].x_min[k])),
                 "bound": case.number(found[1].z_min)}  # fmt: skip
        if x > 0.0:
            right = "undercut" if found[0].z[k] < found[1].z_min else "thick"
            yield Instance(number, ChoiceAnswer(right), _on_mesh(case, rf"O_\{{{number}\}}"), facts)


def _least_shift(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None or found[1].beta:
        return
    for k, number in _wheels(found):
        if found[0].z[k] < found[1].z_min:
            value = float(found[1].x_min[k])
            facts = {"wheel": number, "z": str(found[0].z[k]),
                     "bound": case.number(found[1].z_min)}  # fmt: skip
            yield _of_mesh(case, number, value, "", rf"O_\{{{number}\}}", facts)


def _tip_thickness(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        value = float(found[1].s_na[k])
        facts = {"wheel": number, "thickness": case.number(value, "mm"),
                 "share": case.number(value / found[0].m)}  # fmt: skip
        yield Instance(number, ChoiceAnswer("break"), _on_mesh(case, rf"d_\{{a{number}\}}"), facts)


def _clearance(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is not None and not found[1].cutter:
        pair, problem = found[1], found[0]
        value = abs(float(pair.a_w)) - (float(pair.d_a[0]) + float(pair.d_f[1])) / 2.0
        facts = {"m": case.input_number(problem.m, "mm"), "c": case.input_number(problem.rack.c)}
        yield _of_mesh(case, "", value, "mm", "dimension c", facts)


def _sliding(case: Case) -> Iterator[Instance]:
    if _meshing(case) is not None:
        yield Instance("", ChoiceAnswer("pole"), _on_mesh(case, "P"))


def _thickness(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    for k, number in _wheels(found):
        facts = {"wheel": number}
        value = float(found[1].s[k])
        mark = rf"dimension s_\{{{number}\}}"
        if value > 0.0 and case.sheets.find(_part(case, PartName.MESHING), "meshing", mark):
            yield _of_mesh(case, number, value, "mm", mark, facts)


def _working_radius(case: Case) -> Iterator[Instance]:
    found = _meshing(case)
    if found is None:
        return
    pair = found[1]
    for k, number in _wheels(found):
        value = abs(float(pair.d_w[k])) / 2.0
        facts = {"wheel": number, "cosine": case.number(cos(float(pair.alpha_w)))}
        yield _of_mesh(case, number, value, "mm", rf"dimension r_\{{w{number}\}}", facts)


MESHINGS: Mapping[str, Template] = MappingProxyType(
    {
        "overlap": _overlap,
        "overlap_limit": _overlap_limit,
        "line_of_action": _line_of_action,
        "working_angle": _working_angle,
        "centre_distance": _centre_distance,
        "wider_centres": _wider_centres,
        "working_radius": _working_radius,
        "base_radius": _base_radius,
        "pitch": _pitch,
        "thickness": _thickness,
        "shift_sign": _shift_sign,
        "least_shift": _least_shift,
        "tip_thickness": _tip_thickness,
        "clearance": _clearance,
        "sliding": _sliding,
    }
)
"""Templates of two wheels in mesh by their keys in the catalogue."""
