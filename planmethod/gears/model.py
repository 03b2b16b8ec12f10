"""A gear train as a problem file states it: wheels, meshes, roles, requested quantities."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from enum import Enum
from fractions import Fraction

from msgspec import Struct

from planmethod.errors import Fault
from planmethod.languages import translate
from planmethod.note.formula import Rich
from planmethod.problem.names import UNITS, fold, listed, looks_latin, nearest_name, short
from planmethod.problem.records import KindProblem
from planmethod.problem.tables import PlanetaryTask


class MeshKind(Enum):
    """Type of drive between two wheels (вид передачи)."""

    EXTERNAL = "external"
    INTERNAL = "internal"
    BEVEL = "bevel"
    RACK = "rack"
    BELT = "belt"
    CROSSED = "crossed belt"
    CHAIN = "chain"
    WORM = "worm"


FLEXIBLE = (MeshKind.BELT, MeshKind.CROSSED, MeshKind.CHAIN)
"""Drives between wheels at any distance, which may have radii beside wheels with teeth."""

PARALLEL = (MeshKind.EXTERNAL, MeshKind.INTERNAL)
"""Meshes whose axes are parallel and at a distance that the wheels give."""


HALF_MODULES = 1000
"""In a metre, for pictures without a module: it is then 2 mm."""


class GearRim(Struct, frozen=True):
    """A rim of teeth on a body (зубчатый венец).

    Attributes
    ----------
    size : Fraction or None
        Number of teeth, or the radius in half modules (in metres where no wheel has teeth); None
        where coaxiality determines it.
    shift : Fraction
        Shift x of the rack that cuts it, in modules.
    axis : tuple of float or None
        Direction of a bevel wheel's axis from the apex towards the wheel.
    is_pulley : bool
        A pulley or a sprocket given by its radius beside wheels with teeth.
    module : Fraction or None, m
        Its own, where rows have different ones.
    """

    label: str
    size: Fraction | None
    shift: Fraction = Fraction(0)
    axis: tuple[float, float, float] | None = None
    is_pulley: bool = False
    module: Fraction | None = None

    @property
    def number(self) -> str:
        """The label without primes: rims of one number are one body."""
        return self.label.rstrip("'")


class Mesh(Struct, frozen=True):
    """Two wheels in mesh (зацепление).

    Attributes
    ----------
    first, second : str
        Labels of the wheels; of a rack the second is the rack.
    carrier : str or None
        Body that carries the axes; None for the frame.
    eta : Fraction or None
        Efficiency of the stage.
    left : bool
        The worm is left-handed.
    """

    first: str
    second: str
    kind: MeshKind
    carrier: str | None = None
    eta: Fraction | None = None
    left: bool = False

    @property
    def name(self) -> str:
        """As the picture calls it: ``2'-3``."""
        return f"{self.first}-{self.second}"


class DiagramSettings(Struct, frozen=True):
    """Scales of the velocity diagrams (масштабы картин скоростей).

    Attributes
    ----------
    mu_l : Fraction, m/mm
    longest_mm : Fraction, mm
        Longest segment of the linear velocity diagram.
    pole_mm : Fraction or None, mm
        Distance of the pole of the rays; None where round scales set it, near to ``near_mm``.
    file_keys : frozenset of str
        Those that the file gives: the sheet enlarges only the others.
    """

    mu_l: Fraction = Fraction(1, 1000)
    longest_mm: Fraction = Fraction(60)
    pole_mm: Fraction | None = None
    near_mm: Fraction = Fraction(40)
    file_keys: frozenset[str] = frozenset()


class Train(Struct, frozen=True):
    """A gear train (зубчатый механизм).

    Attributes
    ----------
    body_of : mapping
        Body of every label, carrier and number; a body is called by its carrier, or first label.
    bodies : tuple of str
        All bodies, in file order.
    racks : frozenset of str
        Bodies in translation.
    inputs : mapping
        Speeds of bodies, in `unit`.
    unit : str
        ``n`` for rev/min, ``omega`` for 1/s.
    module : Fraction or None, m
        Module of all wheels that have none of their own; half of it is the unit of sizes.
    listed : tuple of str
        Wheels, and carriers whose radius is given, in file order.
    arms : mapping
        Radii of carriers by label, m: distances of the axes of their planets.
    toothed : bool
        Sizes are teeth (or half modules), not metres.
    planets : mapping
        Number of planets on a carrier, by carrier.
    length_unit : str
        Unit of the file, in which texts give radii.
    """

    wheels: Mapping[str, GearRim]
    meshes: tuple[Mesh, ...]
    body_of: Mapping[str, str]
    bodies: tuple[str, ...]
    carriers: tuple[str, ...]
    racks: frozenset[str]
    fixed: frozenset[str]
    inputs: Mapping[str, Fraction]
    unit: str
    module: Fraction | None
    toothed: bool
    unknown: tuple[str, ...]
    listed: tuple[str, ...]
    arms: Mapping[str, Fraction]
    coaxial: tuple[tuple[str, ...], ...]
    planets: Mapping[str, int]
    output: str | None
    ask: tuple[str, ...]
    picture: DiagramSettings
    design: PlanetaryTask | None = None
    length_unit: str = "m"

    @property
    def unit_m(self) -> Fraction:
        """Metres per unit of size; a missing module is taken as 2 mm."""
        if not self.toothed:
            return Fraction(1)
        return Fraction(1, HALF_MODULES) if self.module is None else self.module / 2

    @property
    def per_m(self) -> Fraction:
        """Units of length of the file in a metre."""
        return Fraction(UNITS[self.length_unit]).limit_denominator(1000)

    @property
    def rate(self) -> float:
        """Unit of the inputs, 1/s."""
        return math.pi / 30 if self.unit == "n" else 1.0

    @property
    def letter(self) -> str:
        """Letter of the speeds of the inputs."""
        return "n" if self.unit == "n" else "ω"

    @property
    def units(self) -> tuple[str, str]:
        """Key of the unit of the inputs, and of the other one."""
        return ("1/min", "1/s") if self.unit == "n" else ("1/s", "1/min")

    @property
    def factor(self) -> float:
        """Unit of the inputs, expressed in the other one."""
        return math.pi / 30 if self.unit == "n" else 30 / math.pi

    @property
    def numbers(self) -> tuple[str, ...]:
        """Labels without primes, each once: the wheels of a block have one."""
        return tuple(dict.fromkeys(label.rstrip("'") for label in self.body_of))

    def counted(self, label: str) -> bool:
        """Return whether the size of a wheel is a number of teeth."""
        return self.toothed and not self.wheels[label].is_pulley

    def module_of(self, label: str) -> Fraction | None:
        """Return the module of a wheel, m; None where it is not given, or of a pulley."""
        wheel = self.wheels[label]
        return None if wheel.is_pulley else wheel.module or self.module

    def module_ratio(self, label: str) -> Fraction:
        """Return the module of a wheel over that of the train, in which half modules count."""
        module = self.module_of(label)
        return Fraction(1) if module is None or self.module is None else module / self.module

    @property
    def modules(self) -> dict[Fraction, tuple[str, ...]]:
        """Modules of the rows with the wheels that have them, in the order of the wheels, m."""
        found: dict[Fraction, tuple[str, ...]] = {}
        for label in self.wheels:
            module = self.module_of(label)
            if module is not None:
                found[module] = (*found.get(module, ()), label)
        return found

    def ends(self, mesh: Mesh) -> tuple[str, str]:
        """Return the bodies of the two wheels of a mesh."""
        return self.body_of[mesh.first], self.body_of[mesh.second]

    def carrier(self, mesh: Mesh) -> str | None:
        """Return the body that carries the axes of a mesh."""
        return None if mesh.carrier is None else self.body_of[mesh.carrier]


class GearProblem(KindProblem, frozen=True, kw_only=True):
    """A problem of a gear train (задача о передаче)."""

    train: Train


Vector = tuple[float, float, float]


class Roles(Struct, frozen=True):
    """Roles of the bodies of a train (роли звеньев).

    Attributes
    ----------
    central, planets : mapping
        Central wheels and planets, by carrier.
    senses : mapping
        By bevel mesh: +1 where both wheels turn in the positive senses of their axes, else -1.
    transverse : frozenset of str
        Bodies whose axis is not parallel to the main one: their speeds are relative to their
        carrier, about their own axis.
    """

    central: Mapping[str, tuple[str, ...]]
    planets: Mapping[str, tuple[str, ...]]
    senses: Mapping[Mesh, int]
    transverse: frozenset[str]


def find_roles(train: Train) -> tuple[Roles, list[Fault]]:
    """Distinguish central wheels from planets, and give bevel wheels their senses.

    A wheel that meshes on a carrier is central if it is fixed, is an input, is coupled to something
    else (another carrier, a mesh of the frame), is a ring, is stated to be coaxial with a central
    body, or meshes only once there; the others are planets.
    """
    faults: list[Fault] = []
    central: dict[str, tuple[str, ...]] = {}
    satellites: dict[str, tuple[str, ...]] = {}
    for carrier in train.carriers:
        middle, around = _split(train, carrier)
        central[carrier], satellites[carrier] = tuple(middle), tuple(around)
        if not around:
            text = translate("no wheel on the carrier {} is a planet", carrier)
            faults.append(Fault("gears.meshes", text, "Name the carrier of each mesh, and check."))
    for mesh in train.meshes:
        if train.carrier(mesh) in train.ends(mesh):
            text = translate(
                "a wheel of {} is one body with the carrier {}", mesh.name, mesh.carrier
            )
            faults.append(Fault("gears.meshes", text, "It cannot roll on it: check bodies."))
    senses, across = _bevels(train, satellites, faults)
    return Roles(central, satellites, senses, across), faults


def _split(train: Train, carrier: str) -> tuple[list[str], list[str]]:
    own = [mesh for mesh in train.meshes if train.carrier(mesh) == carrier]
    ends = [body for mesh in own for body in train.ends(mesh)]
    elsewhere = {
        body for mesh in train.meshes if mesh not in own for body in train.ends(mesh)
    } | set(train.carriers)
    sure = {b for b in ends if b in train.fixed or b in elsewhere}
    sure |= {b for mesh in own if (b := _ring(train, mesh)) is not None}
    sure |= {b for b in ends if b in train.inputs and not _is_between(train, own, b, sure)}
    for group in train.coaxial:
        if carrier in group or sure & set(group):
            sure |= set(group) & set(ends)
    once = {body for body in ends if ends.count(body) == 1}
    for mesh in own:  # a planet that meshes only once
        one, other = train.ends(mesh)
        if {one, other} <= sure | once:
            once -= {next((body for body in (other, one) if body not in sure), "")}
    middle = [body for body in dict.fromkeys(ends) if body in sure | once]
    return middle, [body for body in dict.fromkeys(ends) if body not in middle]


def _is_between(train: Train, carrier_meshes: list[Mesh], body: str, sure: set[str]) -> bool:
    """Return whether a body meshes with several central bodies only: then it is a planet."""
    ends = [train.ends(mesh) for mesh in carrier_meshes]
    mates = {b for both in ends if body in both for b in both} - {body}
    once = {b for b in mates if sum(b in both for both in ends) == 1}
    return body not in sure and len(mates) > 1 and mates <= sure | once


def _ring(train: Train, mesh: Mesh) -> str | None:
    """Return the body of the wheel with internal teeth, where its size is known."""
    if mesh.kind is not MeshKind.INTERNAL:
        return None
    one, other = (train.wheels[label].size for label in (mesh.first, mesh.second))
    if one is None or other is None:
        return None
    return train.ends(mesh)[0 if one > other else 1]


# Bevel wheels ------------------------------------------------------------------------------------


def _bevels(
    train: Train, planets: Mapping[str, tuple[str, ...]], faults: list[Fault]
) -> tuple[dict[Mesh, int], frozenset[str]]:
    """Give every bevel mesh its sense, by the directions of the axes from the apex.

    The contact point P has one velocity, seen from the carrier: with axes that point from the
    apex to the wheels, the wheels turn in opposite senses of them. Where no axes are given, the
    first wheel in mesh with a planet is below it on the main axis, the next above.
    """
    around = {body for bodies in planets.values() for body in bodies}
    main = _main_axis(train, around)
    across: dict[str, bool] = {}
    above: dict[tuple[str, str], bool] = {}
    senses: dict[Mesh, int] = {}
    for mesh in train.meshes:
        if mesh.kind is not MeshKind.BEVEL:
            continue
        one, other = train.ends(mesh)
        turned = _is_transverse(train, mesh, main, across, around)
        across.setdefault(one, turned)
        across.setdefault(other, not turned)
        if across[one] == across[other]:
            text = translate(
                "the axes of {} and {} are parallel, they cannot be bevel", mesh.first, mesh.second
            )
            faults.append(Fault("gears.meshes", text))
            continue
        axial, crossing = (other, one) if across[one] else (one, other)
        below = not any(c == crossing and up is False for (_, c), up in above.items())
        above.setdefault((axial, crossing), not below)
        senses[mesh] = -1 if above[axial, crossing] else 1
        given = [train.wheels[label].axis for label in (mesh.first, mesh.second)]
        label = mesh.second if across[one] else mesh.first
        axis = train.wheels[label].axis
        if axis is not None:
            senses[mesh] = -(_sign(axis, main) or 1)
        across_axis = given[0] if across[one] else given[1]
        if across_axis is not None:
            senses[mesh] *= 1 if across_axis > (0.0, 0.0, 0.0) else -1
    return senses, frozenset(body for body, is_across in across.items() if is_across)


def _is_transverse(
    train: Train,
    mesh: Mesh,
    main: Vector,
    transverse: Mapping[str, bool],
    around: set[str],
) -> bool:
    """Return whether the first wheel of a bevel mesh is transverse to the main axis."""
    ends = train.ends(mesh)
    axes = [train.wheels[label].axis for label in (mesh.first, mesh.second)]
    for body, axis, flip in zip(ends, axes, (False, True), strict=True):
        if body in transverse:
            return transverse[body] != flip
        if axis is not None:
            return (_sign(axis, main) == 0) != flip
    return ends[0] in around and ends[1] not in around


def _main_axis(train: Train, around: set[str]) -> Vector:
    """Return the direction of the main axis, z upwards unless a central wheel has another."""
    wheels = [
        train.wheels[label]
        for mesh in sorted(train.meshes, key=lambda mesh: mesh.carrier is None)
        if mesh.kind is MeshKind.BEVEL
        for label in (mesh.first, mesh.second)
    ]
    axes = [w.axis for w in wheels if w.axis is not None and train.body_of[w.label] not in around]
    if not axes:
        return 0.0, 0.0, 1.0
    x, y, z = axes[0]
    return axes[0] if (z, x, y) > (0.0, 0.0, 0.0) else (-x, -y, -z)


def _sign(axis: Vector, main: Vector) -> int:
    """Return +1 for an axis along the main one, -1 for one against it, 0 for one across."""
    along = sum(a * b for a, b in zip(axis, main, strict=True))
    size = math.hypot(*axis) * math.hypot(*main)
    return 0 if abs(along) < (1 - 1e-9) * size else (1 if along > 0 else -1)


UNLABELLED = ("W", "q")
"""Names without labels."""

COUNTS = {"U": 2, "n": 1, "omega": 1, "z": 1, "r": 1, "v": 1, "a_w": 2, "k": 1, "eta": 0}
"""Quantities and the number of labels of each; ``k`` is the largest number of planets."""

RELATIVE = ("U", "n", "omega")
"""Quantities that can be taken relative to a carrier."""


_GREEK = {"omega": "ω", "eta": "η"}


class RequestedQuantityError(ValueError):
    """The name of a requested quantity cannot be parsed; the message says why."""


class RequestedQuantity(Struct, frozen=True):
    """One quantity of a train (искомая величина)."""

    kind: str
    labels: tuple[str, ...] = ()
    carrier: str | None = None

    @property
    def symbol(self) -> Rich:
        """Symbol: ``U^{(H)}_{14}``, ``n_{5}``, ``ω_{2}``."""
        letter = _GREEK.get(self.kind, self.kind)
        if not self.labels:
            return letter
        index = ("" if all(len(label) == 1 for label in self.labels) else "-").join(self.labels)
        hat = f"^{{({self.carrier})}}" if self.carrier else ""
        return f"a_{{w{index}}}" if self.kind == "a_w" else f"{letter}{hat}_{{{index}}}"


def parse(text: str, known: Collection[str]) -> RequestedQuantity:
    """Parse a name such as ``U_1_4^H``; also ``U_15``, ``n_H_2`` if read in one way only.

    Raises
    ------
    SoughtQuantityError
    """
    name = text.strip().replace("′", "'").replace("’", "'")
    name = fold(name) if looks_latin(name) else name
    if name in UNLABELLED or name == "eta":
        return RequestedQuantity(name)
    whole, hat, carrier = name.partition("^")
    carrier = carrier if carrier in known else carrier.replace("_", "")
    kind = next((k for k in COUNTS if whole.startswith(f"{k}_")), None)
    if kind is None:
        raise RequestedQuantityError(translate("unknown quantity '{}'", short(text)))
    labels = _labels(whole.removeprefix(f"{kind}_"), COUNTS[kind], known)
    if hat and kind not in RELATIVE:
        raise RequestedQuantityError(translate("'{}' is not taken relative to a carrier", kind))
    for label in (*labels, *([carrier] if hat else [])):
        if label not in known:
            guess = nearest_name(label, known)
            hint = (
                translate("the nearest is '{}'", guess)
                if guess
                else translate("known: {}", listed(known))
            )
            raise RequestedQuantityError(
                translate("the train has no '{}' ({})", short(label), hint)
            )
    return RequestedQuantity(kind, labels, carrier if hat else None)


def _labels(text: str, count: int, known: Collection[str]) -> tuple[str, ...]:
    parts = tuple(text.split("_")) if count else ()
    if count and len(parts) != count:  # U_15, n_H_2
        run = "".join(parts)
        cuts = [(run,)] if count == 1 else [(run[:i], run[i:]) for i in range(1, len(run))]
        found = [cut for cut in cuts if all(label in known for label in cut)]
        if len(found) == 1:
            return found[0]
    if len(parts) != count:
        raise RequestedQuantityError(
            translate("expected {} labels with _ between them, got '{}'", count, short(text))
        )
    return parts
