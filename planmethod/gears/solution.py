"""A solved train: the conditions that it must meet, values of its requested quantities."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

from msgspec import Struct, field

from planmethod.gears.axes import COAXIAL_TOLERANCE, cannot_mesh, shift_for, solve
from planmethod.gears.coaxiality import Terms, coaxial_paths
from planmethod.gears.model import PARALLEL, Mesh, MeshKind, RequestedQuantity, parse
from planmethod.gears.motion import TrainMotion, mesh_row
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language

MIN_TEETH = 17
"""Least teeth of a wheel without shift that the rack does not undercut."""

RING_LESS = 8
"""Least difference of teeth in an internal mesh."""

ALPHA = 20.0
"""Pressure angle of the standard rack, degrees."""

SIN2 = math.sin(math.radians(ALPHA)) ** 2

MAX_PLANETS = 24


class Condition(Struct, frozen=True):
    """A condition and whether it holds (условие синтеза).

    Attributes
    ----------
    name : str
        ``coaxiality``, ``assembly``, ``neighbourhood``, ``undercutting``, ``interference``,
        ``satellites``: key of its sentence.
    facts : mapping
        Values that its sentence names.
    phrase_key : str
        Key of its sentence where it differs from the name.
    is_derived : bool
        Unknown sizes were found from it, so a calculation need not check it.
    """

    name: str
    is_satisfied: bool
    facts: Mapping[str, str] = field(default_factory=dict)
    phrase_key: str = ""
    is_derived: bool = False


def conditions(motion: TrainMotion) -> tuple[Condition, ...]:
    """Return the conditions that can be judged of a train."""
    return (*_coaxial(motion), *_arms(motion), *_sets(motion), *_teeth(motion))


def checked(motion: TrainMotion) -> tuple[Condition, ...]:
    """Return the conditions that a calculation checks: not those that gave its sizes."""
    return tuple(one for one in conditions(motion) if not one.is_derived)


def sentence(condition: Condition, language: Language) -> str:
    """Return a condition in words."""
    decimal = language.note.decimal
    facts = {name: value.replace(".", decimal) for name, value in condition.facts.items()}
    if "unit" in facts:
        facts["unit"] = language.gears["units"][facts["unit"]]
    phrase: str = language.gears["conditions"][condition.phrase_key or condition.name]
    return phrase.format(**facts)


def judgement(condition: Condition, language: Language) -> str:
    """Return a condition in words, with the verdict unless the words imply it."""
    text = sentence(condition, language)
    if condition.is_satisfied and condition.name == "satellites":
        return text
    return str(language.gears["holds"]["yes" if condition.is_satisfied else "no"]).format(
        sentence=text
    )


# Coaxiality --------------------------------------------------------------------------------------


def _coaxial(motion: TrainMotion) -> Iterator[Condition]:
    for name, height, ways in coaxial_paths(motion):
        meshes = [_meshes_of(motion, way) for way in ways]
        is_derived = any(label in motion.train.unknown for way in ways for _, label in way)
        if motion.axes.shifted & {mesh.name for mesh in (*meshes[0], *meshes[1])}:
            yield _coaxial_shifted(motion, name, ways)
            continue
        if len({motion.train.module_of(label) for way in ways for _, label in way}) > 1:
            sums = " = ".join(_sum(motion, way, height, "r") for way in ways)
            value = f"{float(abs(height) * motion.train.unit_m * 1000):g}"
            facts = {"sums": sums, "axis": name, "value": value}
            yield Condition("coaxiality", True, facts, "coaxiality_mm", is_derived)
            continue
        sums = " = ".join(_sum(motion, way, height) for way in ways)
        per = Fraction(1) if motion.train.toothed else motion.train.per_m
        facts = {"sums": sums, "axis": name, "value": _number_text(abs(height) * per)}
        yield Condition("coaxiality", True, facts, is_derived=is_derived)


def _arms(motion: TrainMotion) -> Iterator[Condition]:
    """Yield the radius of every carrier beside the sizes that place its planets' axes."""
    train, axes = motion.train, motion.axes
    for label, radius in train.arms.items():
        carrier = train.body_of[label]
        for mesh in train.meshes:
            ends = train.ends(mesh)
            around = [body for body in ends if body in motion.roles.planets.get(carrier, ())]
            if train.carrier(mesh) != carrier or len(around) != 1 or mesh.kind not in PARALLEL:
                continue
            inner = mesh.kind is MeshKind.INTERNAL
            one, other = sorted((mesh.first, mesh.second), key=lambda x: -axes.sizes[x] * inner)
            text = f"r_{one} {'−' if inner else '+'} r_{other}"
            text = f"a_w{mesh.name}" if mesh.name in axes.shifted else text
            per = Fraction(1000) if train.toothed else train.per_m
            said = {"sums": f"{text} = r_{label}", "axis": around[0]}
            said["value"] = f"{float(radius * per):g}"
            form = "coaxiality_mm" if train.toothed else ""
            yield Condition("coaxiality", True, said, form)
            break


def _meshes_of(motion: TrainMotion, terms: Terms) -> list[Mesh]:
    """Return the meshes along a path of terms, two terms each."""
    by = {frozenset((mesh.first, mesh.second)): mesh for mesh in motion.train.meshes}
    return [by[frozenset((one, other))] for (_, one), (_, other) in zip(terms[::2], terms[1::2],
                                                                      strict=True)]  # fmt: skip


def _coaxial_shifted(motion: TrainMotion, axis: str, paths: tuple[Terms, Terms]) -> Condition:
    """Check two paths, one over shifted wheels, by comparing their centre distances."""
    train, axes = motion.train, motion.axes
    per = Fraction(1, 2) if train.module is None else train.unit_m * 1000
    heights, sums = [], []
    for way in paths:
        parts, height = [], Fraction(0)
        for mesh, (sign, _) in zip(_meshes_of(motion, way), way[::2], strict=True):
            height += sign * axes.distances[mesh.name]
            parts.append((sign, mesh.name))
        turn = -1 if height < 0 else 1
        text = " ".join(f"{'+' if sign * turn > 0 else '−'} a_w{name}" for sign, name in parts)
        heights.append(abs(height))
        sums.append(f"{text.removeprefix('+ ')} = {_places(abs(height) * per)}")
    off = heights[1] - heights[0]
    said = {"axis": axis, "sums": ", ".join(sums), "off": _places(abs(off) * per)}
    said["unit"] = "modules" if train.module is None else "mm"
    if abs(off) <= 2 * COAXIAL_TOLERANCE:
        return Condition("coaxiality", True, said, "coaxiality_shifted")
    last = _meshes_of(motion, paths[1])
    if len(last) == 1 and len(paths[0]) == 2:
        wheel, shift = shift_for(train, last[0], heights[0])
        said |= {"wheel": wheel, "shift": f"{shift:.3f}".replace("-", MINUS)}
        return Condition("coaxiality", False, said, "coaxiality_cured")
    return Condition("coaxiality", False, said, "coaxiality_off")


def _places(value: Fraction) -> str:
    return f"{float(value):.3f}"


def _sum(motion: TrainMotion, terms: Terms, height: Fraction, letter: str = "") -> str:
    """Write a sum of sizes as a positive height: ``z_1 + z_2``."""
    letter = letter or ("z" if motion.train.toothed else "r")
    turn = -1 if height < 0 else 1
    parts = [f"{'+' if sign * turn > 0 else '−'} {letter}_{label}" for sign, label in terms]
    return " ".join(parts).removeprefix("+ ")


def _number_text(value: Fraction) -> str:
    return str(value.numerator) if value.denominator == 1 else f"{float(value):g}"


# Sets of planets ---------------------------------------------------------------------------------


def max_planets(motion: TrainMotion, carrier: str) -> int | None:
    """Return the largest number of planets that can be assembled and do not touch.

    None where the carrier has more than one kind of planet, or its wheels have no teeth.
    """
    found = _set_of(motion, carrier)
    if found is None:
        return None
    whole, size, distance = found.dividend, found.tip, found.distance
    counts = range(1, MAX_PLANETS + 1)
    fits = [k for k in counts if _assembles(whole, k) and _clear_each_other(size, distance, k)]
    return max(fits, default=None)


def _sets(motion: TrainMotion) -> Iterator[Condition]:
    for carrier in motion.train.carriers:
        found = _set_of(motion, carrier)
        if found is None:
            continue
        whole, size, distance = found.dividend, found.tip, found.distance
        most = max_planets(motion, carrier)
        yield Condition(
            "satellites", most is not None, {"carrier": carrier, "most": str(most or 0)}
        )
        count = motion.train.planets.get(carrier)
        if count is None:
            continue
        said = {"carrier": carrier, "k": str(count)}
        value = {"value": _number_text(whole / count), "whole": _number_text(whole)}
        form = "assembly_two" if "divisor" in found.assembly else ""
        yield Condition(
            "assembly", _assembles(whole, count), {**said, **found.assembly, **value}, form
        )
        room = {
            "left": f"{math.sin(math.pi / count):.4f}",
            "right": f"{float(size / distance):.4f}",
        }
        said |= {**found.neighbourhood, **room}
        yield Condition("neighbourhood", _clear_each_other(size, distance, count), said)


class PlanetSet(Struct, frozen=True):
    """Planets of one kind between two central wheels (ряд сателлитов).

    Attributes
    ----------
    dividend : Fraction
        The number that k must divide.
    tip, distance : Fraction
        Tip diameter of a planet, and twice the distance of its axis, in modules of the train.
    assembly, neighbourhood : mapping
        Letters and numbers of both conditions.
    """

    dividend: Fraction
    tip: Fraction
    distance: Fraction
    assembly: Mapping[str, str]
    neighbourhood: Mapping[str, str]


def _set_of(motion: TrainMotion, carrier: str) -> PlanetSet | None:
    """Return the planets of a carrier, if they are of one kind and all wheels have teeth."""
    train, sizes = motion.train, motion.axes.sizes
    satellites = motion.roles.planets[carrier]
    if len(satellites) != 1 or not train.toothed or satellites[0] in motion.roles.transverse:
        return None
    (satellite,) = satellites
    tips: dict[str, Fraction] = {}
    rows: list[tuple[str, str, int]] = []  # planet's wheel, central wheel, +1 of an external mesh
    for mesh in train.meshes:
        ends = train.ends(mesh)
        if train.carrier(mesh) != carrier or satellite not in ends:
            continue
        if mesh.kind not in (MeshKind.EXTERNAL, MeshKind.INTERNAL):
            return None
        own, other = (mesh.first, mesh.second)[:: 1 if ends[0] == satellite else -1]
        tip = (sizes[own] + 2 * (1 + _raised(motion, mesh, own))) * train.module_ratio(own)
        tips[own] = min(tip, tips.get(own, tip))
        rows.append((own, other, 1 if mesh.kind is MeshKind.EXTERNAL else -1))
    distance = abs(motion.axes.heights.get(satellite, Fraction(0)))
    if len(rows) != 2 or not distance or any(sizes[own].denominator != 1 for own, _, _ in rows):
        return None
    (one, first, sign), (two, last, turn) = rows
    both = sign * sizes[first] * sizes[two] - turn * sizes[last] * sizes[one]
    whole = abs(both) / math.gcd(sizes[one].numerator, sizes[two].numerator)
    return PlanetSet(
        whole, max(tips.values()), distance,
        _assembly_facts(motion, rows, -1 if both < 0 else 1),
        _neighbour_facts(motion, rows, tips, distance),
    )  # fmt: skip


def _assembly_facts(
    motion: TrainMotion, rows: list[tuple[str, str, int]], sign_of_sum: int
) -> dict[str, str]:
    """Return the number that k must divide, in letters and numbers.

    Where the planet has two rims, also their greatest common divisor.
    """
    (one, first, sign), (two, last, turn) = rows
    sizes, single = motion.axes.sizes, one == two
    told = {}
    for name, of in (("letters", _letter), ("numbers", lambda x: _number_text(sizes[x]))):
        parts = [(sign_of_sum * sign, [first] if single else sorted((first, two))),
                 (-sign_of_sum * turn, [last] if single else sorted((one, last)))]  # fmt: skip
        parts.sort(key=lambda part: part[0] < 0)
        text = "".join(f" {'+' if s > 0 else '−'} {'·'.join(map(of, x))}" for s, x in parts)
        told[name] = f"({text.removeprefix(' + ')})"
    if not single:
        divisor = math.gcd(sizes[one].numerator, sizes[two].numerator)
        told |= {"rims": f"{_letter(one)}, {_letter(two)}", "divisor": str(divisor)}
    return told


def _neighbour_facts(
    motion: TrainMotion,
    rows: list[tuple[str, str, int]],
    tips: Mapping[str, Fraction],
    distance: Fraction,
) -> dict[str, str]:
    """Return the tip diameter over twice the distance: in teeth if wheels have no shifts."""
    axes, train = motion.axes, motion.train
    own = max(tips, key=tips.__getitem__)
    one, first, sign = next(row for row in rows if row[0] == own)
    tip, apart = tips[own], distance
    if any(train.wheels[x].shift or train.module_ratio(x) != 1 for row in rows for x in row[:2]):
        numbers = (f"{float(value):.6g}·m" for value in (tip, apart))
        return {"letters": f"d_a{own}/(2·a_w)", "numbers": "{}/({})".format(*numbers)}
    large, small = sorted((one, first), key=lambda x: -axes.sizes[x]) if sign < 0 else (first, one)
    told = {}
    for name, of in (("letters", _letter), ("numbers", lambda x: _number_text(axes.sizes[x]))):
        told[name] = f"({of(own)} + 2)/({of(large)} {'+' if sign > 0 else '−'} {of(small)})"
    return told


def _letter(label: str) -> str:
    return f"z_{label}"


def _raised(motion: TrainMotion, mesh: Mesh, label: str) -> Fraction:
    """Return the outward shift of a wheel's tips, modules: x − Δy, of its own mesh."""
    train, axes = motion.train, motion.axes
    if mesh.name not in axes.shifted:
        return train.wheels[label].shift
    way = 1 if mesh.kind is MeshKind.EXTERNAL else -1
    small, large = sorted((mesh.first, mesh.second), key=lambda x: axes.sizes[x])
    shifts = train.wheels[large].shift + way * train.wheels[small].shift
    plain = axes.sizes[large] + way * axes.sizes[small]
    grown = (axes.distances[mesh.name] / train.module_ratio(label) - plain) / 2
    return train.wheels[label].shift - way * (shifts - grown)


def _assembles(turns: Fraction, count: int) -> bool:
    return (turns / count).denominator == 1


def _clear_each_other(size: Fraction, distance: Fraction, count: int) -> bool:
    """Return whether the tips of neighbouring planets do not touch."""
    return count == 1 or math.sin(math.pi / count) > float(size / distance)


# Inner meshes ------------------------------------------------------------------------------------


def ring_bound(small: Any) -> tuple[Any, Any]:
    """Return denominator and numerator of the least teeth of a ring around a standard wheel.

    z₃ ≥ (z₂² sin²α − 4)/(2 z₂ sin²α − 4): the tip of the ring stays short of where the line of
    action touches the base circle of the wheel. Where the lower part is not positive, with up to
    17 teeth of the wheel, there is no such ring.
    """
    return 2 * small * SIN2 - 4, small**2 * SIN2 - 4


def ring_fits(small: Any, ring: Any) -> Any:
    """Return whether a standard wheel runs in a standard ring without interference of teeth.

    The ring has `RING_LESS` teeth more, and its tips stay short of the base circle's tangent
    point: the one rule for conditions, choice and design. Arrays of teeth give an array.
    """
    room, reach = ring_bound(small)
    return (ring - small >= RING_LESS) & (ring * room >= reach)


def _inner(motion: TrainMotion, mesh: Mesh) -> Condition:
    """Judge an internal mesh: standard teeth by their numbers, shifted ones by their sizes."""
    train, sizes = motion.train, motion.axes.sizes
    small, ring = sorted((mesh.first, mesh.second), key=lambda label: sizes[label])
    teeth, shifts = ([float(sizes[x]) for x in (small, ring)],
                     [float(train.wheels[x].shift) for x in (small, ring)])  # fmt: skip
    said = {"ring": ring, "wheel": small, "teeth": _number_text(sizes[small])}
    room, reach = ring_bound(teeth[0])
    if room > 0 and not any(shifts):
        less = sizes[ring] - sizes[small]
        least = max(Fraction(RING_LESS), math.ceil(reach / room - 1e-9) - sizes[small])
        said |= {"less": _number_text(less), "least": _number_text(least)}
        return Condition("interference", bool(ring_fits(*teeth)), said)
    from planmethod.gears.angles import ring_margins

    beyond, tips = ring_margins(teeth, shifts, math.radians(ALPHA))
    for name, text in (("beyond", f"{beyond:.3f}"), ("tips", f"{tips:.4f}")):
        said[name] = text.replace("-inf", "-∞").replace("-", MINUS)
    if not any(shifts):
        return Condition("interference", bool(ring_fits(*teeth)), said, "interference_of_few")
    return Condition("interference", beyond >= 0 and tips >= 0, said, "interference_shifted")


# Teeth -------------------------------------------------------------------------------------------


def _teeth(motion: TrainMotion) -> Iterator[Condition]:
    train, sizes = motion.train, motion.axes.sizes
    if not train.toothed:
        return
    rings: set[str] = set()
    for mesh in train.meshes:
        if mesh.kind is MeshKind.INTERNAL:
            rings.add(max(mesh.first, mesh.second, key=lambda label: sizes[label]))
            yield _inner(motion, mesh)
    spur = {
        label
        for mesh in train.meshes
        if mesh.kind in (MeshKind.EXTERNAL, MeshKind.INTERNAL, MeshKind.RACK)
        for label in (mesh.first, mesh.second)
    }
    for label, wheel in train.wheels.items():
        if label in rings or label not in spur:
            continue
        least = MIN_TEETH * (1 - wheel.shift)
        if sizes[label] < least:
            said = {"wheel": label, "z": _number_text(sizes[label]), "least": _number_text(least)}
            yield Condition("undercutting", False, said)


class Answer(Struct, frozen=True):
    """The value of a quantity (значение).

    Attributes
    ----------
    value : float or None
        None where it does not exist.
    exact : Fraction or None
        Where it is a fraction.
    reason : str
        Why there is no value: ``zero``, ``module``, ``rack``, ``satellites``, ``efficiency``.
    """

    name: str
    value: float | None
    exact: Fraction | None = None
    unit: str = ""
    reason: str = ""
    label: str = ""


def answer(motion: TrainMotion, name: str) -> Answer:
    """Return the value of a requested quantity."""
    asked = parse(name, tuple(motion.train.body_of))
    plain = {
        "W": motion.structure.mobility,
        "q": motion.structure.spatial,
    }
    if asked.kind in plain:
        return _exact(name, Fraction(plain[asked.kind]))
    if asked.kind == "U":
        return _ratio(motion, name, asked)
    if asked.kind in ("n", "omega", "v"):
        return _speed(motion, name, asked)
    if asked.kind == "eta":
        share = efficiency(motion)
        return _exact(name, share) if share is not None else no_answer(name, "efficiency")
    if asked.kind == "k":
        body = motion.train.body_of[asked.labels[0]]
        most = max_planets(motion, body) if body in motion.train.carriers else None
        return _exact(name, Fraction(most)) if most is not None else no_answer(name, "satellites")
    return _size(motion, name, asked)


def named(motion: TrainMotion) -> list[str]:
    """Return the names of the speeds of all bodies, and of the requested quantities."""
    train = motion.train
    racks = (train.body_of[x] in train.racks for x in train.numbers)
    letters = ("v" if is_rack else train.unit for is_rack in racks)
    speeds = (f"{letter}_{x}" for letter, x in zip(letters, train.numbers, strict=True))
    return list(dict.fromkeys([*speeds, *train.ask]))


def _exact(name: str, value: Fraction, unit: str = "") -> Answer:
    return Answer(name, float(value), value, unit)


def no_answer(name: str, reason: str, label: str = "") -> Answer:
    """Return the record of a quantity without a value, and the reason."""
    return Answer(name, None, reason=reason, label=label)


def _ratio(motion: TrainMotion, name: str, quantity: RequestedQuantity) -> Answer:
    one, other = quantity.labels
    for label in quantity.labels:
        if motion.train.body_of[label] in motion.train.racks:
            return no_answer(name, "rack", label)
    below = motion.speed(other, quantity.carrier)
    if not below:
        return no_answer(name, "zero", other)
    ratio = motion.speed(one, quantity.carrier) / below
    return _exact(name, ratio if motion.has_sign(one, other) else abs(ratio))


def _speed(motion: TrainMotion, name: str, quantity: RequestedQuantity) -> Answer:
    (label,) = quantity.labels
    speed = motion.speed(label, quantity.carrier)
    rack = motion.train.body_of[label] in motion.train.racks
    if rack != (quantity.kind == "v"):
        return no_answer(name, "rack", label)
    if rack:
        metres = rack_speed(motion, label)
        return no_answer(name, "module") if metres is None else Answer(name, metres, None, "m/s")
    if quantity.kind == motion.train.unit:
        return _exact(name, speed, motion.train.units[0])
    return Answer(name, float(speed) * motion.train.factor, None, motion.train.units[1])


def rack_speed(motion: TrainMotion, label: str) -> float | None:
    """Return the speed of a rack, m/s; None where the module is not given."""
    train = motion.train
    if train.toothed and train.module is None:
        return None
    return float(motion.speed(label) * train.unit_m) * train.rate


def _size(motion: TrainMotion, name: str, quantity: RequestedQuantity) -> Answer:
    """Return teeth, a radius or a centre distance, mm."""
    train, sizes, heights = motion.train, motion.axes.sizes, motion.axes.heights
    label = quantity.labels[0]
    if quantity.kind == "r" and label in train.arms:
        return _exact(name, train.arms[label] * 1000, "mm")
    if quantity.kind != "a_w" and label not in sizes:
        return no_answer(name, "wheel", label)
    if quantity.kind == "z":
        return _exact(name, sizes[label]) if train.counted(label) else no_answer(name, "teeth")
    if train.toothed and train.module is None and (quantity.kind == "a_w" or train.counted(label)):
        return no_answer(name, "module")
    if quantity.kind == "r":
        return _exact(name, motion.axes.radii[label] * train.unit_m * 1000, "mm")
    one, other = (train.body_of[x] for x in quantity.labels)
    if one not in heights or other not in heights:
        return no_answer(name, "wheel", label)
    mesh = _between(motion, one, other)
    apart = abs(heights[one] - heights[other]) if mesh is None else motion.axes.distances[mesh.name]
    if mesh is not None and cannot_mesh(motion.axes, mesh):
        return no_answer(name, "wheel", label)
    apart *= train.unit_m * 1000
    if not motion.axes.shifted:
        return _exact(name, apart, "mm")
    return Answer(name, float(apart), None, "mm")


def _between(motion: TrainMotion, first: str, second: str) -> Mesh | None:
    """Return the mesh whose axes are those of two bodies, with shifts if there is one so."""
    axis = motion.axes.axis_of
    found = [
        mesh
        for mesh in motion.train.meshes
        if mesh.kind in PARALLEL
        and {axis[body] for body in motion.train.ends(mesh)} == {axis[first], axis[second]}
    ]
    own = [mesh for mesh in found if {first, second} == set(motion.train.ends(mesh))]
    return next(iter([*own, *found]), None)


def efficiency(motion: TrainMotion, output: str | None = None) -> Fraction | None:
    """Return the efficiency from the input to the output by the powers of the stages.

    The output is a body of the train. Default: that of its file.

    The tooth forces are in equilibrium on every body; in each mesh the output power relative to
    the carrier is less than the input power. None where an efficiency or the output is not given,
    W is not 1, or the train locks itself.
    """
    train = motion.train
    output = output or train.output
    if output is None or motion.structure.mobility != 1 or len(train.inputs) != 1:
        return None
    if output in train.inputs or output in train.fixed or not motion.speeds.get(output):
        return None
    if not all(train.inputs.values()) or any(mesh.eta is None for mesh in train.meshes):
        return None
    (source,) = train.inputs
    turn = 1 if motion.speeds[source] > 0 else -1  # the torque of the input drives
    loose = [body for body in train.bodies if body not in train.fixed]
    forces = [f"mesh {mesh.name}" for mesh in train.meshes]
    forward = [True] * len(forces)
    for _ in range(2 * len(forces) + 2):
        rows: dict[str, dict[str, Fraction]] = {body: {} for body in loose}
        for mesh, name, is_forward in zip(train.meshes, forces, forward, strict=True):
            row = mesh_row(train, motion.roles, motion.axes, mesh)
            one, other = train.ends(mesh)
            loss = mesh.eta or Fraction(1)
            kept = loss if is_forward else 1 / loss
            torque = {one: row[one], other: row[other] * kept}
            carrier = train.carrier(mesh)
            if carrier is not None:
                turned = [b for b in (one, other) if b not in motion.roles.transverse]
                torque[carrier] = -sum((torque[b] for b in turned), Fraction(0))
            for body, value in torque.items():
                if body in rows:
                    rows[body][name] = rows[body].get(name, Fraction(0)) + value
        rows[output]["out"] = Fraction(1)
        right = {body: Fraction(-turn if body == source else 0) for body in loose}
        found = solve([*forces, "out"], [(rows[body], right[body]) for body in loose])
        if found.free or not found.consistent:
            return None
        seen = [
            _is_forward(motion, mesh, found.values[name])
            for mesh, name in zip(train.meshes, forces, strict=True)
        ]
        if seen == forward:
            power_in = turn * motion.speeds[source]
            share = -found.values["out"] * motion.speeds[output] / power_in
            return share if share > 0 else None
        forward = seen
    return None


def _is_forward(motion: TrainMotion, mesh: Mesh, force: Fraction) -> bool:
    """Return whether power flows from the first wheel of a mesh to the second, on the carrier."""
    row = mesh_row(motion.train, motion.roles, motion.axes, mesh)
    one = motion.train.ends(mesh)[0]
    speed = motion.speed(one, motion.train.carrier(mesh))
    return force * row[one] * speed <= 0
