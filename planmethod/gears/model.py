"""A gear train as a problem file states it: wheels, meshes, what turns together (модель)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from enum import Enum
from fractions import Fraction

from msgspec import Struct

from planmethod.problem.common import KindProblem
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
    """

    mu_l: Fraction = Fraction(1, 1000)
    longest_mm: Fraction = Fraction(60)
    pole_mm: Fraction | None = None
    near_mm: Fraction = Fraction(40)


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

    @property
    def unit_m(self) -> Fraction:
        """Metres per unit of size; a missing module is taken as 2 mm."""
        if not self.toothed:
            return Fraction(1)
        return Fraction(1, HALF_MODULES) if self.module is None else self.module / 2

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
