"""Questions on gear trains (зубчатые механизмы)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from itertools import pairwise
from math import pi
from types import MappingProxyType

from planmethod.defence.case import Case, Template
from planmethod.defence.model import ChoiceAnswer, Instance, Place, TextAnswer
from planmethod.gears.model import GearProblem, Mesh, MeshKind, parse
from planmethod.gears.motion import TrainKind, TrainMotion, solve_motion
from planmethod.gears.solution import answer as value_of
from planmethod.note.formula import Rich
from planmethod.project.parts import PartName


def _train(case: Case) -> TrainMotion | None:
    return case.solved(GearProblem, solve_motion)


def _on_train(case: Case, *marks: str, kind: str = "position") -> Place:
    return case.of_part(case.own_part(PartName.GEARS), kind, *marks)


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
                case.own_part(PartName.GEARS),
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


def _plain_meshes(motion: TrainMotion) -> Iterator[tuple[Mesh, int, int]]:
    """Yield the meshes of toothed wheels with parallel axes, and their numbers of teeth."""
    train, sizes = motion.train, motion.axes.sizes
    for mesh in train.meshes:
        labels = (mesh.first, mesh.second)
        if mesh.kind not in (MeshKind.EXTERNAL, MeshKind.INTERNAL):
            continue
        if all(x in sizes and x in train.wheels and train.counted(x) for x in labels):
            first, second = (sizes[label] for label in labels)
            if first.denominator == second.denominator == 1:
                yield mesh, int(first), int(second)


def _mesh_ratio(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    for mesh, first, second in () if motion is None else _plain_meshes(motion):
        value = second / first * (1.0 if mesh.kind is MeshKind.INTERNAL else -1.0)
        facts = {"first": mesh.first, "last": mesh.second, "z_first": str(first),
                 "z_last": str(second), "value": case.number(value)}  # fmt: skip
        yield Instance(mesh.name, case.computed(value), _on_wheel(case, mesh.first), facts)


def _mesh_sense(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    for mesh, *_ in () if motion is None else _plain_meshes(motion):
        right = "same" if mesh.kind is MeshKind.INTERNAL else "opposite"
        facts = {"first": mesh.first, "last": mesh.second}
        yield Instance(mesh.name, ChoiceAnswer(right), _on_wheel(case, mesh.first), facts)


def _on_wheel(case: Case, label: str) -> Place:
    return _on_train(case, f"wheel {re.escape(label)}", f"front {re.escape(label)}")


def _mesh_distance(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    for mesh, first, second in () if motion is None else _plain_meshes(motion):
        assert motion is not None
        module = motion.train.module_of(mesh.first)
        if module is None or module != motion.train.module_of(mesh.second):
            continue
        sign = "−" if mesh.kind is MeshKind.INTERNAL else "+"
        whole = abs(second - first) if mesh.kind is MeshKind.INTERNAL else first + second
        value = 500.0 * float(module) * whole
        facts = {"first": mesh.first, "last": mesh.second, "sign": sign,
                 "module": case.input_number(1000.0 * float(module), "mm"),
                 "value": case.input_number(value, "mm")}  # fmt: skip
        answer = case.computed(value, "mm")
        yield Instance(mesh.name, answer, _on_wheel(case, mesh.first), facts)


def _coaxial(case: Case) -> Iterator[Instance]:
    """Yield the condition of coaxial wheels of a planet that meshes with a sun and a ring."""
    motion = _train(case)
    if motion is None:
        return
    outer, inner = dict[str, str](), dict[str, str]()
    for mesh, *_ in _plain_meshes(motion):
        for planet, central in ((mesh.first, mesh.second), (mesh.second, mesh.first)):
            if any(motion.train.body_of[planet] in some for some in motion.roles.planets.values()):
                (inner if mesh.kind is MeshKind.INTERNAL else outer)[planet] = central
    for planet in sorted({*outer} & {*inner}):
        sun, ring = (int(motion.axes.sizes[of[planet]]) for of in (outer, inner))
        own = int(motion.axes.sizes[planet])
        if ring == sun + 2 * own:
            facts = {"sun": outer[planet], "planet": planet, "ring": inner[planet],
                     "z_sun": str(sun), "z_planet": str(own), "value": str(ring)}  # fmt: skip
            place = _on_wheel(case, inner[planet])
            yield Instance(planet, case.exactly(ring), place, facts)


def _counted_pairs(case: Case) -> Iterator[Instance]:
    """Yield the numbers in the formula of mobility."""
    motion = _train(case)
    if motion is None or motion.structure.is_spatial:
        return
    found = motion.structure
    for key, value in (("n", found.moving), ("low", found.lower), ("high", found.higher)):
        facts = {"what": case.texts["counted"][key], "value": str(value)}
        yield Instance(key, case.exactly(value), _on_train(case), facts)


def _carrier(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    for carrier, planets in () if motion is None else motion.roles.planets.items():
        if len(motion.roles.planets) == 1 and planets:  # type: ignore[union-attr]
            facts = {"carrier": carrier, "planets": ", ".join(sorted(planets))}
            yield Instance(carrier, TextAnswer(carrier), _on_train(case), facts)


def _planet(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    planets = sorted({x for some in motion.roles.planets.values() for x in some})
    if planets:
        facts = {"planets": ", ".join(planets)}
        yield Instance("", TextAnswer(facts["planets"]), _on_train(case), facts)


def _relative_planet(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None:
        return
    unit = "rev/min" if motion.train.unit == "n" else "1/s"
    for carrier, planets in motion.roles.planets.items():
        for planet in planets:
            if planet in motion.roles.transverse or carrier not in motion.speeds:
                continue
            value = abs(float(motion.speeds[planet] - motion.speeds[carrier]))
            if value:
                facts = {"planet": planet, "carrier": carrier, "letter": motion.train.letter,
                         "value": case.number(value, unit)}  # fmt: skip
                yield Instance(planet, case.computed(value, unit), _on_wheel(case, planet), facts)


def _angular_velocity(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None or motion.train.unit != "n":
        return
    train = motion.train
    for body in train.bodies:
        if body in train.racks or not motion.speeds.get(body):
            continue
        value = abs(float(motion.speeds[body])) * pi / 30.0
        facts = {"body": body, "value": case.number(value, "1/s")}
        yield Instance(body, case.computed(value, "1/s"), _on_train(case), facts)


def _pitch_speed(case: Case) -> Iterator[Instance]:
    """Yield the speed of the teeth of wheels that turn about fixed axes."""
    motion = _train(case)
    if motion is None:
        return
    train = motion.train
    planets = {x for some in motion.roles.planets.values() for x in some}
    turn = pi / 30.0 if train.unit == "n" else 1.0
    for label in train.wheels:
        body, module = train.body_of[label], train.module_of(label)
        size = motion.axes.sizes.get(label)
        if body in planets or module is None or size is None or not train.counted(label):
            continue
        value = abs(float(motion.speeds[body])) * turn * float(module * size) / 2.0
        if value:
            facts = {"label": label, "value": case.number(value, "m/s")}
            yield Instance(label, case.computed(value, "m/s"), _on_wheel(case, label), facts)


_INPUT_MOMENT = 10.0
"""Moment on the input that a question gives, N·m."""


def _output_moment(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    ends = None if motion is None else _ends(motion)
    if motion is not None and ends is not None:
        value = _INPUT_MOMENT * abs(float(motion.speed(ends[0]) / motion.speed(ends[1])))
        facts = {"first": ends[0], "last": ends[1], "value": case.number(value, "N·m"),
                 "moment": case.input_number(_INPUT_MOMENT, "N·m")}  # fmt: skip
        yield Instance("", case.computed(value, "N·m"), _on_train(case), facts)


def _slows(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    ends = None if motion is None else _ends(motion)
    if motion is not None and ends is not None:
        first, last = (abs(motion.speed(end)) for end in ends)
        right = "slows" if first > last else "hastens" if first < last else "same"
        yield Instance("", ChoiceAnswer(right), _on_train(case),
                       {"first": ends[0], "last": ends[1]})  # fmt: skip


def _doubled_input(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    ends = None if motion is None else _ends(motion)
    if ends is not None:
        facts = {"first": ends[0], "last": ends[1]}
        yield Instance("", ChoiceAnswer("doubled"), _on_train(case), facts)


def _pitch_of_teeth(case: Case) -> Iterator[Instance]:
    motion = _train(case)
    if motion is None or not motion.train.toothed:
        return
    modules = {motion.train.module_of(label) for label in motion.train.wheels} - {None}
    for module in sorted(modules):  # type: ignore[type-var]
        mm = 1000.0 * float(module)  # type: ignore[arg-type]
        facts = {"module": case.input_number(mm, "mm"), "value": case.number(pi * mm, "mm")}
        yield Instance(str(module), case.computed(pi * mm, "mm"), _on_train(case), facts)


TEMPLATES: Mapping[str, Template] = MappingProxyType(
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
        "mesh_ratio": _mesh_ratio,
        "mesh_sense": _mesh_sense,
        "mesh_distance": _mesh_distance,
        "coaxial": _coaxial,
        "counted_pairs": _counted_pairs,
        "carrier": _carrier,
        "planet": _planet,
        "relative_planet": _relative_planet,
        "angular_velocity": _angular_velocity,
        "pitch_speed": _pitch_speed,
        "output_moment": _output_moment,
        "slows": _slows,
        "doubled_input": _doubled_input,
        "pitch_of_teeth": _pitch_of_teeth,
    }
)
"""Templates of a gear train by their keys in the catalogue."""
