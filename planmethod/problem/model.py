"""Checked content of a problem file as plain records (SI units).

Lengths are metres. Angles are degrees, as in the file, wherever a protractor would lay them off:
then quadrants stay exact; the arithmetic of a reading turns them into directions.
"""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from enum import Enum
from functools import cached_property
from math import inf, isinf
from typing import TYPE_CHECKING, Annotated, Any, NamedTuple

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Mechanism
from planmethod.problem.machine_records import CycleTask, ProjectTask
from planmethod.problem.mesh_records import GearMesh
from planmethod.problem.names import format_length, split_pair
from planmethod.problem.quantities import SLIDINGS, QuantityKey
from planmethod.problem.records import KindProblem
from planmethod.problem.tables import CustomKey, FlagKey, NumberKey, WordKey

if TYPE_CHECKING:
    from fractions import Fraction
    from typing import Self

    from planmethod.construct.program import Program
    from planmethod.construct.steps import LineName, NumberName
    from planmethod.problem.machine_records import CounterweightTask, Machine
    from planmethod.problem.records import BalancingForceTask, Dynamics


class Body(Struct, frozen=True):
    """Points of a link in the link's own axes (собственные оси звена).

    The own axis is the real axis: the line of the link's first length (from its first letter,
    which is the origin, towards the second); for a slider the direction of its slide, the pin
    being the origin; for a host with one point the line it carries. Left of the axis is positive
    imaginary. The frame is a body whose axes are those of the paper.

    Attributes
    ----------
    points : mapping of str to complex, m
        In file order. Every point of the link has coordinates.
    axis : tuple of two str, or None
        Letters of the own axis (("B", "C")); None for a slider and for a one-point link.
    forms : mapping of str to PointForm
        How the file gives the third points that have a table of their own.
    angles : mapping of str to float, degrees
        Angles of the link by their letters: ``AOD``; of two lines ``ABCD``.
    arc : str or None
        Centre of the circular slot whose sliding block the link replaces (дуговая направляющая).
    """

    points: Mapping[str, complex]
    axis: tuple[str, str] | None
    forms: Mapping[str, PointForm] = field(default_factory=dict)
    angles: Mapping[str, float] = field(default_factory=dict)
    arc: str | None = None


class PointForm(Struct, frozen=True):
    """Form in which a third point is given (способ задания точки).

    ``kind`` is ``side``, ``on``, ``from`` or ``vertex``; ``line`` is its directed
    line, ``point`` its point; lengths in metres, ``angle`` in degrees.
    """

    kind: str
    line: tuple[str, str] = ("", "")
    point: str = ""
    left: bool = True
    at: float = 0.0
    lateral_offset: float = 0.0
    angle: float = 0.0
    distance: float | None = None


class Slide(Struct, frozen=True):
    """Line of a prismatic pair on the link that carries it (направляющая).

    Attributes
    ----------
    slider, host : str
        The slider's own axis has the direction of the line. The host may be the frame.
    pin : str
        Point of the slider at its origin.
    base : complex, m
        A point of the line in the host's axes.
    angle : float, degrees
        Direction of the line from the host's own axis (from +x when the host is the frame).
    offset : float, m
        Pin to the left of the line (смещение оси ползуна), counted along the directed line.
    label : str
        What the drawing calls the line: ``x-x`` (a guide) or ``CD`` (a line of a link) or ``C``.
    through : str or None
        Name of the host's point at ``base`` when it has one.
    towards : str or None
        Name of the host's second point of the line (``D`` of ``along = "CD"``), if so given.
    length : float or None, m
        Length of contact along the line (длина ползуна), if it is given.
    """

    slider: str
    host: str
    pin: str
    base: complex
    angle: float
    offset: float
    label: str
    through: str | None = None
    towards: str | None = None
    length: float | None = None


class Size(Struct, frozen=True):
    """Distance of two fixed points or guides along ``x`` or ``y`` (размер стойки)."""

    axis: str
    first: str
    second: str


class Letters(Struct, frozen=True):
    """Letters of the source: ``[letters]``.

    Outputs for a reader have them; keys of records and names of quantities stay.

    Attributes
    ----------
    points : mapping of str to (str, str)
        Letter of a link's point, to its place and the link: ``L`` to ``H``, ``2``.
    balance : str
        Of the balancing moment or force, in rich text; empty for the usual one.
    sizes : mapping of str to Size
        Distances in the frame by their letters.
    """

    points: Annotated[
        Mapping[str, tuple[str, str]],
        CustomKey(
            "letters of the points of links that coincide in a joint or under a pin, each with its "
            'place and link: `points.L = "H on 2"`'
        ),
    ] = field(default_factory=dict)
    balance: Annotated[
        str,
        CustomKey(
            "letter of the balancing moment or force, with indices in braces: `M_{1д}`; "
            "default: the usual one of the language"
        ),
    ] = ""
    sizes: Annotated[
        Mapping[str, Size],
        CustomKey(
            "letters of distances along x or y between points and guides of the frame: "
            '`sizes.a_1 = "x D y-y"`; the statement, the plan of positions and the scheme have them'
        ),
    ] = field(default_factory=dict)

    def names(self, bodies_by_link: Mapping[str, Body]) -> dict[str, str]:
        """Return the names by which quantities know the points: ``L`` is ``H2``."""
        return {
            name: place if place in bodies_by_link[link].points else f"{place}{link}"
            for name, (place, link) in self.points.items()
        }

    def point(self, link: str, place: str) -> str | None:
        """Return the letter of a link's point at a place; None for its usual name."""
        return next((name for name, at in self.points.items() if at == (place, link)), None)

    def line_letter(self, link: str, place: str) -> str:
        """Return the letter of a link's point for its lines: the place if only an index differs."""
        name = self.point(link, place) or place
        return name if name[0] != place[0] else place


class AssemblyRelation(Enum):
    """Relation by which an assembly rule distinguishes the two assemblies of a group."""

    RIGHT = "right"
    LEFT = "left"
    ABOVE = "above"
    BELOW = "below"
    LEFT_OF = "left of"
    RIGHT_OF = "right of"
    TOWARDS = "towards"
    AWAY = "away from"
    NEAR = "near"
    PARALLEL = "parallel"


class Rule(Struct, frozen=True):
    """Assembly rule of a point (способ сборки).

    ``right|left|above|below`` compare with one point (``refs`` has one name), ``left of`` and
    ``right of`` with a directed line (two names), ``near`` with a place ``at`` in metres;
    ``towards`` and ``away from`` (one name) give the direction of the point from its group's outer
    joint on the same link: a bar extends through its block, or ends before it;
    ``parallel`` requires a parallelogram. A ``continuous`` rule applies to the first position; in
    the others the motion continues from there, through change points too.
    """

    point: str
    relation: AssemblyRelation
    refs: tuple[str, ...] = ()
    at: complex = 0j
    continuous: bool = False


class Coordinate(Struct, frozen=True):
    """Generalized coordinate of the driver (обобщённая координата): ``phi``, deg or ``s``, m.

    Of a cam's follower it is the angle of the cam, ``cam``, deg. Records name it by ``column``;
    ``symbol`` is rich text; ``rates`` are the velocity and the acceleration in a program. ``turn``
    is its period, infinite for a slider.
    """

    name: str
    unit: str
    column: str
    symbol: str
    rates: tuple[str, str]
    turn: float

    def distance(self, one: float, two: float) -> float:
        """Return the distance of two positions, within a turn."""
        way, turn = one - two, self.turn
        return abs(way) if isinf(turn) else abs((way + turn / 2) % turn - turn / 2)

    def format_value(self, value: float, unit: str, digits: int = 12) -> str:
        """Return a value for a message, lengths in the unit of the file: ``phi = 20 deg``."""
        if self.unit == "m":
            return f"{self.name} = {format_length(value, unit, digits)}"
        return f"{self.name} = {value:.{digits}g} {translate(self.unit)}"


class BalancingQuantity(Struct, frozen=True):
    """Balancing quantity of the driver (уравновешивающий момент, уравновешивающая сила).

    Records name it by ``quantity``, sentences by ``phrase_key``; ``symbol`` is the key of its
    letters in a language.
    """

    phrase_key: str
    quantity: str
    symbol: str
    letter: str
    unit: str
    turns: bool


MOMENT = BalancingQuantity("moment", "moment", "balancing moment", "M", "N·m", turns=True)
FORCE = BalancingQuantity("force", "force", "balancing force", "F", "N", turns=False)
PUSH = BalancingQuantity("push", "force", "balancing force", "F", "N", turns=False)
MOTOR = BalancingQuantity("motor", "moment", "balancing moment", "M", "N·m", turns=True)
THRUST = BalancingQuantity("thrust", "force", "balancing force", "F", "N", turns=False)


class GearStage(NamedTuple):
    """Two wheels in mesh of the train that drives a crank (ступень передачи).

    Attributes
    ----------
    labels : (str, str)
    teeth : tuple of int or None
        None of a wheel without teeth.
    module : Fraction or None, m
        None where the file gives none.
    """

    labels: tuple[str, str]
    teeth: tuple[int | None, int | None]
    module: Fraction | None


class GearDrive(Struct, frozen=True):
    """Gear train through which a crank is driven (привод через зубчатый механизм).

    Attributes
    ----------
    label : str
        Its body that turns with the crank.
    inputs : tuple of (str, float)
        Labels and speeds of its inputs, in `unit`.
    unit : str
        ``n`` for rev/min, ``omega`` for 1/s.
    ratio : Fraction or None
        U from a single input to the crank; None where it has no value.
    rate : float, 1/s
    efficiency : float or None
        From the input to the crank; None where the file gives none.
    stages : tuple of GearStage
        Its meshes in the order of the file.
    """

    label: str
    inputs: tuple[tuple[str, float], ...]
    unit: str
    ratio: Fraction | None
    rate: float
    efficiency: float | None = None
    stages: tuple[GearStage, ...] = ()

    def given_facts(self, words: Any) -> Sequence[Any]:
        """Return the given facts of the train, in a language (`Language`).

        The subclass of a train (`gears/results.py`) has them.
        """
        return ()


class LawPiece(NamedTuple):
    """A smooth part of a follower's law (участок закона движения).

    The displacement is ``powers[0] + powers[1]·x + … + size·sin(rate·x + phase)``, m or rad; x is
    the angle of the cam from ``start``, rad.
    """

    start: float
    powers: tuple[float, ...]
    size: float = 0.0
    rate: float = 1.0
    phase: float = 0.0


class CamDrive(Struct, frozen=True):
    """Follower of a cam that drives a linkage (привод от толкателя кулачка).

    Attributes
    ----------
    turns : bool
        The follower oscillates: it turns a crank.
    n : float, rev/min
        Of the cam, counter-clockwise positive.
    pieces : tuple of LawPiece
        Its displacement over a turn of the cam, from the start of the rise in the sense of the cam.
    lowest : float
        Position of the link while the follower is lowest, m or degrees.
    """

    turns: bool
    n: float
    pieces: tuple[LawPiece, ...]
    lowest: float = 0.0

    def given_facts(self, words: Any) -> Sequence[Any]:
        """Return the given facts of the cam, in a language (`Language`).

        The subclass of a cam (`cams/results.py`) has them.
        """
        return ()


class OutputPositionKind(Enum):
    """Quantity that gives a position of the mechanism in place of the driver's coordinate."""

    X = "x"
    Y = "y"
    PHI = "phi"
    BETWEEN = "between"  # the angle of two links
    LINE = "on"  # a point on a line of two others
    STROKE = "stroke"
    EXTREME = "at"
    LENGTH = "length"


class OutputPositions(Struct, frozen=True):
    """Positions given by the output (положения, заданные выходным звеном).

    Attributes
    ----------
    by : OutputPositionKind
    of : str
        The point, the link of an angle, two links with a low line between (``2_3``), or two points
        of a length; empty of a share of the stroke, of an extreme, and of a point on a line.
    values : tuple of float
        Coordinates and lengths, m; angles, degrees; shares of the stroke from position zero of the
        cycle; or degrees of the crank after an extreme.
    extremes : tuple of str
        Extreme that each is counted from: ``left``, ``right``, ``upper``, ``lower``, ``other``, or
        nothing for that of position zero; or the point and the line that it is on, ``B on OC``.
    going : str
        Choice among several positions: that in which the output moves ``right``, ``ccw``,
        ``forth`` ...; empty where the file does not give it.
    nearest_to : float or None
        That nearest to this position of the driver, degrees or m.
    number : int
        That of this number, from 1, as positions of the driver grow; 0 where the file has none.
    rates : tuple of float
        Of an actuator, which drives by the distance of two points: m/s, m/s².
    """

    by: OutputPositionKind
    of: str
    values: tuple[float, ...]
    extremes: tuple[str, ...] = ()
    going: str = ""
    nearest_to: float | None = None
    rates: tuple[float, float] = (0.0, 0.0)
    number: int = 0

    @property
    def key(self) -> str:
        """Key in ``[driver]``."""
        if self.by is OutputPositionKind.LENGTH:
            return self.of
        if self.by is OutputPositionKind.LINE:
            return OutputPositionKind.EXTREME.value
        if self.by is OutputPositionKind.BETWEEN:
            return f"{OutputPositionKind.PHI.value}_{self.of}"
        return f"{self.by.value}_{self.of}" if self.of else self.by.value


class OutputRate(Struct, frozen=True):
    """Rate of an output that gives that of the driver (скорость выходного звена).

    Attributes
    ----------
    key : str
        Key in ``[driver]``: ``v_B``, positive along the guide of a slider on the frame, of another
        point its size, with the sign of the driver's rate; ``vx_B``, ``vy_B``; ``omega_3``; or
        ``omega_2_3``, of link 3 relative to link 2, counter-clockwise positive.
    rate : float, m/s or 1/s
    gain : float or None, m/s² or 1/s²
        Acceleration of the output; None where the driver's own is given.
    """

    key: str
    rate: float
    gain: float | None = None

    @property
    def kind(self) -> str:
        """Its letter: ``v``, ``vx``, ``vy`` or ``omega``."""
        return self.key.partition("_")[0]

    @property
    def of(self) -> str:
        """Its point or link, or two links with a low line between."""
        return self.key.partition("_")[2]

    @property
    def gain_key(self) -> str:
        """Key of the acceleration."""
        return {"omega": "epsilon"}.get(self.kind, "a" + self.kind[1:]) + f"_{self.of}"


class FoundRates(Struct, frozen=True):
    """How the rates of the driver follow from an output or a load (аналоги, приведение).

    Attributes
    ----------
    first, second : float
        Derivatives of the output by the driver's coordinate, m or 1; zero where no output gives
        the rate.
    load, inertia : float
        Balance without acceleration, N·m or N, and its growth with the driver's acceleration, kg·m²
        or kg; zero where no load gives the acceleration.
    derivatives : tuple of float
        Derivatives of the output by the coordinates of several drivers; empty of a single one.
    """

    first: float = 0.0
    second: float = 0.0
    load: float = 0.0
    inertia: float = 0.0
    derivatives: tuple[float, ...] = ()


MOTOR_DRIVES = "a motor between links {} and {} drives, so that link {} does not turn evenly"
"""Why a mechanism has no cycle of its crank."""

MOTOR_POSITIONS = (
    "Draw forces of single positions: planmethod sheet --layout forces. Each {0} is a variant: "
    "before the first table write variants = {{ 2.{1}.{0} = {2:.6g}{3} }}, then request "
    "--all-variants."
)
"""What to do in place of a cycle."""

SAME_DEG = 0.1
"""Degrees within which two positions of a file are equal, as it has them rounded."""

ANYWHERE = tuple(10.0 * number for number in range(36))
"""Arbitrary positions of a crank, degrees: the first that can be assembled is used."""


class Drive(Struct, frozen=True):
    """Law of motion of the driving link (начальное звено) in the requested positions.

    Attributes
    ----------
    link : str
    pivot : str or None
        Fixed point that a crank turns about; None for a driving slider.
    positions : tuple of float
        phi of the crank's own axis, degrees; or s of the slider's pin along its guide from the
        guide's base point, m. For a cam's follower the angles of the cam, degrees.
    rate, acceleration : float
        omega, 1/s and epsilon, 1/s² (counter-clockwise positive); or v, m/s and a, m/s². For a
        cam's follower those of the cam in its sense: the link's own are in
        `planmethod.solved.reading`.
    gear_drive : GearDrive or None
        The train that drives a crank, where one is given.
    turns : float or None, rev/min
        Rotational speed, where the file gives that.
    posed : OutputPositions or None
        Quantity that gives the positions in place of the driver's coordinate; it determines
        `positions`.
    assembly_positions : tuple of float
        Positions in which the assembly rules are checked, where ``[cycle]`` gives the positions:
        those that the file lists, else `ANYWHERE`; empty where they are `positions`.
    pushed : BalancingForceTask or None
        The force at a point of a crank that balances it, in place of a couple.
    cam_drive : CamDrive or None
        The cam's follower that is the driving link, or moves it.
    output_rate : OutputRate or None
        Rate of an output that determines ``rate``.
    effort : float or None, N·m or N
        Moment or force that drives, which determines ``acceleration``.
    found_rates : FoundRates or None
        How both follow, once the mechanism is assembled.
    other_drives : tuple of OtherDrive
        The other driving links of a mechanism with W > 1.
    """

    link: str
    pivot: str | None
    positions: tuple[float, ...]
    rate: float
    acceleration: float
    gear_drive: GearDrive | None = None
    turns: float | None = None
    posed: OutputPositions | None = None
    assembly_positions: tuple[float, ...] = ()
    pushed: BalancingForceTask | None = None
    cam_drive: CamDrive | None = None
    output_rate: OutputRate | None = None
    effort: float | None = None
    found_rates: FoundRates | None = None
    other_drives: tuple[OtherDrive, ...] = ()

    @property
    def links(self) -> tuple[str, ...]:
        """All driving links."""
        return (self.link, *(other.link for other in self.other_drives))

    @property
    def every(self) -> tuple[Drive, ...]:
        """It and the other drivers."""
        return (self, *self.other_drives)

    def at_index(self, index: int) -> Self:
        """Return it in one of its positions; a single one is that of all."""
        start = index if len(self.positions) > 1 else 0
        posed = self.posed
        if posed is not None:
            extremes = posed.extremes[start : start + 1]
            posed = replace(posed, values=posed.values[start : start + 1], extremes=extremes)
        return replace(self, positions=self.positions[start : start + 1], posed=posed)

    def in_other_positions(self, positions: Sequence[float]) -> Self:
        """Return it in other positions than the file's, in which no output determines its place.

        The rules of assembly hold in the file's first position; its rates stay.
        """
        judged = (self.assembly_positions or self.positions)[:1]
        moved = replace(self, positions=tuple(positions), assembly_positions=judged)
        if self.actuator is not None or self.motor is not None:
            return moved
        return replace(moved, posed=None, output_rate=None, found_rates=None)

    @property
    def senses(self) -> dict[str, int]:
        """Sense of each driving link: 1 counter-clockwise or along its guide, -1 otherwise."""
        return {one.link: -1 if one.rate < 0 else 1 for one in self.every}

    @property
    def is_determined(self) -> bool:
        """True if a position or a rate follows from the assembled mechanism."""
        given = [(one.posed, one.output_rate, one.effort) for one in self.every]
        return any(part is not None for parts in given for part in parts)

    @property
    def is_crank(self) -> bool:
        """True when the driver turns, False when it slides."""
        return self.pivot is not None

    @property
    def goes_round(self) -> bool:
        """True if its positions are angles of a turn, of a crank or of the cam that moves it."""
        return self.is_crank or self.cam_drive is not None

    @property
    def actuator(self) -> tuple[str, str] | None:
        """The ends of the actuator that drives, where one does."""
        if self.posed is None or self.posed.by is not OutputPositionKind.LENGTH:
            return None
        return split_pair(self.posed.of)

    @property
    def motor(self) -> tuple[str, str] | None:
        """The moving links that a motor turns relative to each other, where one does."""
        posed, rate = self.posed, self.output_rate
        if posed is None or rate is None or posed.by is not OutputPositionKind.BETWEEN:
            return None
        one, two = posed.of.split("_")
        if rate.kind != "omega" or rate.of not in (f"{one}_{two}", f"{two}_{one}"):
            return None
        return (one, two) if rate.of == posed.of else (two, one)

    @property
    def motor_hint(self) -> str:
        """What to do in place of a cycle where a motor between links drives, a sentence."""
        assert self.posed is not None
        place = "drivers.0" if self.other_drives else "driver"
        number = self.posed.number  # a variant's place replaces it, too
        root = f", 2.{place}.root = {number}" if number else ""
        return translate(MOTOR_POSITIONS, self.posed.key, place, self.posed.values[0] + 10.0, root)

    @property
    def is_at_rest(self) -> bool:
        """True if its speed is zero or missing; for an actuator or an output, that one's."""
        if self.output_rate is not None:
            return not self.output_rate.rate
        acted = self.posed if self.actuator is not None else None
        return not (self.rate if acted is None else acted.rates[0])

    @property
    def mover(self) -> str:
        """Body whose turn its positions are in, a key of sentences: ``crank`` or ``cam``."""
        return "crank" if self.cam_drive is None else "cam"

    @property
    def revolves(self) -> bool:
        """True if it is a crank that can rotate fully, not one that a follower swings."""
        return self.is_crank and self.cam_drive is None and not self.other_drives

    @property
    def accelerates(self) -> bool:
        """True if its link accelerates in at least one position."""
        return self.acceleration != 0 or self.cam_drive is not None

    @property
    def program_inputs(self) -> tuple[str, str, str]:
        """Names of position, rate and acceleration of its link in a program."""
        return ("phi" if self.is_crank else "s", *self.coordinate.rates)

    @property
    def coordinate(self) -> Coordinate:
        """Coordinate of its positions."""
        rates = (f"omega_{self.link}", f"epsilon_{self.link}") if self.is_crank else ("v", "a")
        if self.cam_drive is not None:
            return Coordinate("cam", "deg", "cam_deg", "φ", rates, 360.0)
        if self.is_crank:
            return Coordinate("phi", "deg", "phi_deg", f"φ_{{{self.link}}}", rates, 360.0)
        return Coordinate("s", "m", "s", "s", rates, inf)

    @property
    def balancing(self) -> BalancingQuantity:
        """Quantity that balances it."""
        if self.motor is not None:
            return MOTOR
        if self.actuator is not None:
            return THRUST
        if not self.is_crank:
            return FORCE
        return MOMENT if self.pushed is None else PUSH


class OtherDrive(Drive, frozen=True):
    """Another driving link of a mechanism with several (второе начальное звено).

    It has as many positions as the first driver, or the one of its first position.
    """

    @property
    def program_inputs(self) -> tuple[str, str, str]:
        """Names of its position, rate and acceleration in a program."""
        letters = ("phi", "omega", "epsilon") if self.pivot is not None else ("s", "v", "a")
        place, rate, gain = (f"{letter}_{self.link}" for letter in letters)
        return place, rate, gain

    @property
    def coordinate(self) -> Coordinate:
        """Coordinate of its positions; that of a slider has its number."""
        coordinate = super().coordinate
        symbol = coordinate.symbol if self.is_crank else f"s_{{{self.link}}}"
        return replace(coordinate, symbol=symbol)


class Convention(Enum):
    """The two textbook conventions of a scale."""

    UNIT_PER_MM = "unit/mm"
    MM_PER_UNIT = "mm/unit"


class Scales(Struct, frozen=True):
    """Scales given in the file; None where the program chooses.

    ``mu_l, mu_v, mu_a, mu_F`` are always stored as unit per millimetre, whichever convention the
    file and the sheet use. Where they are ``decided``, for all documents, every sheet keeps them:
    it uses larger paper, or more sheets.
    """

    convention: Annotated[
        Convention,
        WordKey(
            'meaning of the numbers: `"unit/mm"` (масштабный коэффициент μ, metres per '
            'millimetre) or `"mm/unit"` (масштаб, millimetres per metre). It applies to the file '
            "and to the sheets"
        ),
    ] = Convention.UNIT_PER_MM
    mu_l: Annotated[
        float | None,
        NumberKey(
            "scale of lengths, m/mm",
            "a scale", low=1e-12, high=1e12, positive=True,
            absent="chosen from the series 1, 2, 2.5, 4, 5",
        ),
    ] = None  # fmt: skip
    mu_v: Annotated[
        float | None,
        NumberKey(
            "scale of velocities, (m/s)/mm",
            "a scale", low=1e-12, high=1e12, positive=True, absent="chosen from the series",
        ),
    ] = None  # fmt: skip
    mu_a: Annotated[
        float | None,
        NumberKey(
            "scale of accelerations, (m/s²)/mm",
            "a scale", low=1e-12, high=1e12, positive=True, absent="chosen from the series",
        ),
    ] = None  # fmt: skip
    mu_F: Annotated[  # noqa: N815 - the letter of the textbook
        float | None,
        NumberKey(
            "scale of forces for all force plans, N/mm",
            "a scale", low=1e-12, high=1e12, positive=True,
            absent="chosen from the series; small plans have their own scales",
        ),
    ] = None  # fmt: skip

    own: Annotated[
        bool,
        FlagKey(
            "`true`: every plan of several positions has its own scale, which fills its place. "
            "`false`: all plans of one kind have the same scale"
        ),
    ] = False
    decided: bool = False

    @property
    def freed(self) -> Scales:
        """The scales without those of the plans, which may be too fine for other positions."""
        return self if self.decided else replace(self, mu_v=None, mu_a=None)

    @property
    def in_mm_per_unit(self) -> bool:
        """True if the scales in mm per unit are the round numbers."""
        return self.convention is Convention.MM_PER_UNIT


def _is_pair(name: str) -> bool:
    """Return whether a guide's name has the usual form: ``x-x``."""
    half = len(name) // 2
    return half > 0 and name[half] in "-–" and name[:half] == name[half + 1 :]


class FixedLine(Struct, frozen=True):
    """Guide of the frame as the file gives it (направляющая); None for drawn numbers.

    Attributes
    ----------
    through : str or None
        The fixed point that it goes through; else ``base`` has the coordinates of such a point, m.
    towards : str or None
        A second fixed point on it, which then gives its direction.
    """

    through: str | None
    base: tuple[float | None, float | None]
    angle: float | None
    towards: str | None = None


class DrawnKind(Enum):
    """What a fact of a drawn position is about (что показано на рисунке)."""

    PHI = "phi"  # the direction of a link's own axis, or of another line of it, from +x
    BETWEEN = "between"  # the angle of two links or of their lines, without a sign
    LENGTH = "length"  # the distance of two points


class DrawnFact(Struct, frozen=True):
    """One number of a drawn position: degrees or m; ``of`` names its links, or its two points.

    ``lines`` has two points of each link whose angle is not that of its own axis.
    """

    kind: DrawnKind
    of: tuple[str, ...]
    value: float
    lines: tuple[tuple[str, str] | None, ...] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """Its links and lines as the file has them: ``2``, ``BE``."""
        lines = self.lines or (None,) * len(self.of)
        return tuple(
            link if line is None else "".join(line)
            for link, line in zip(self.of, lines, strict=True)
        )

    @property
    def key(self) -> str:
        """Key in ``[drawn]``: ``phi_3``, ``phi_2_3``, ``phi_BE``, ``AC``."""
        length = self.kind is DrawnKind.LENGTH
        return "".join(self.of) if length else "_".join(("phi", *self.names))


class DrawnDirection(Struct, frozen=True):
    """How the direction of a link, or of a guide, is known in a drawn position.

    ``by`` is ``phi``, ``between`` (of a link), ``guide``, ``host`` or ``slider`` (of its slide),
    ``points`` (two of its own), ``slot`` (a slider, and a point), or ``line`` (a guide itself).
    ``headings``, degrees, are those of the lines of an angle in the axes of this link and of the
    other one; ``names`` are their names in the file.
    """

    link: str
    by: str
    of: tuple[str, ...] = ()
    angle: NumberName | None = None
    headings: tuple[float, ...] = (0.0, 0.0)
    names: tuple[str, ...] = ()


class DrawnSize(Struct, frozen=True):
    """A size that follows from the coordinates of a figure (размер по координатам).

    Attributes
    ----------
    path : tuple of str
        Its place in the file, which lacks it: ``links.2.BC``, ``links.2.K.at``; ``frame.A.x``.
    exact, value : float
        m; ``value`` is rounded where the file asks for it. Zero of the side of a third point.
    of : tuple of str
        Two points whose distance it is.
    """

    path: tuple[str, ...]
    exact: float
    value: float
    of: tuple[str, ...] = ()


class DrawnPoints(Struct, frozen=True):
    """Coordinates of points in one position, and sizes that follow (координаты рисунка).

    Attributes
    ----------
    places : mapping of str to complex
        As given, m.
    sizes : tuple of DrawnSize
        Those that the rest of the file does not give.
    step : float or None
        Step of their rounding, m.
    position : float or None
        That of the driver, degrees or m; None if its points have no coordinates.
    file_values, places_found : mapping
        As of `DrawnPosition`.
    """

    places: Mapping[str, complex]
    sizes: tuple[DrawnSize, ...]
    step: float | None
    position: float | None
    file_values: Mapping[tuple[str, ...], Any]
    places_found: Mapping[tuple[str, ...], Any]

    @property
    def paths(self) -> frozenset[tuple[str, ...]]:
        """Places in the file of the sizes that follow."""
        return frozenset(size.path for size in self.sizes)


class DrawnPosition(Struct, frozen=True):
    """Position that the figure of a task shows, from which fixed points follow (рисунок задачи).

    Attributes
    ----------
    facts : tuple of DrawnFact
        Those of ``[drawn]``, without the driver's position.
    file_values : mapping of tuple of str to object
        What the file says of the unknown places, by path: ``"drawn"``, ``["drawn", 0.0]``.
    places_found : mapping of tuple of str to float or list
        Their values, m and degrees, by the same paths.
    position : float or None
        That of the driver, degrees or m; None where it is not needed.
    is_stated : bool
        The position is given in ``[drawn]``.
    program : Program
        The steps that find the unknown places; its data are ``numbers`` and ``places``.
    directions : mapping of LineName to DrawnDirection
        Meaning of its lines.
    rules : tuple of Rule
        Assembly of the groups that the figure shows and the file has no rules for.
    choosing : tuple of str
        Points whose rules in ``[assembly]`` choose the figure alone.
    shown : DrawnPoints or None
        Points that the figure has coordinates of.
    """

    facts: tuple[DrawnFact, ...]
    file_values: Mapping[tuple[str, ...], Any]
    places_found: Mapping[tuple[str, ...], Any]
    position: float | None
    is_stated: bool
    program: Program
    numbers: Mapping[str, float]
    places: Mapping[str, complex]
    directions: Mapping[LineName, DrawnDirection]
    rules: tuple[Rule, ...] = ()
    choosing: tuple[str, ...] = ()
    shown: DrawnPoints | None = None


class SourceTable(dict[str, Any]):
    """Parsed TOML of a file, ignored when problems are compared for equality."""

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SourceTable)

    def __ne__(self, other: object) -> bool:
        return not self == other


class SynthesisTask(Struct, frozen=True):
    """What the sizes of the mechanism follow from: ``[synthesis]`` (синтез).

    Attributes
    ----------
    kind : str
    data : mapping
        The given data by their keys, SI and degrees; None for a key that the file leaves out.
    letters : mapping
        Letters of the file by those of the construction, where these differ.
    values : mapping
        Results that numbers of the file may name: ``l_OA`` or ``l_AO``, ``x_C``, ``e``, ``phi_0``;
        SI, degrees.
    """

    kind: str
    data: Mapping[str, Any]
    letters: Mapping[str, str]
    values: Mapping[str, float]

    def is_named_in(self, arithmetic: str) -> bool:
        """Return whether arithmetic of the file names a result."""
        return any(re.search(rf"\b{name}\b", arithmetic) for name in self.values)


class Problem(KindProblem, frozen=True, kw_only=True, dict=True):
    """Task as read (задача).

    Attributes
    ----------
    lengths : tuple of (str, str, float)
        (link, name, metres) of every length as written, in file order: the sheet's "Дано".
    guides : mapping of str to (str or None, complex, float)
        Frame guides by name: fixed point's name if so given, base in m, angle in degrees.
    assembly : tuple of Rule
    dynamics : Dynamics or None
        Masses and loads; None when the file has neither ``[dynamics]`` nor ``[[loads]]``.
    cycle : CycleTask or None
        Data of ``[cycle]``; None when the file has none.
    project : ProjectTask or None
        Data of ``[project]``; None when the file has none.
    calculated : int or None
        Number of the calculated position of a decided project (`planmethod.project`), whose
        positions and scales are those of all sheets; None for a problem as read.
    numbered : tuple of float
        Positions of the cycle in the order of their numbers, degrees, over all turns of a cycle
        of several; empty without ``[cycle]`` (`planmethod.solved.turn.extremes`).
    machine : Machine or None
        Data for the flywheel; None when the file has no ``[machine]``.
    balancing : CounterweightTask or None
        Data of ``[balancing]``; None when the file has none.
    tables : mapping
        Tables that later parts read ([gears], [point]), as parsed.
    unit : str
        Unit in which the file gives lengths: ``m``, ``cm``, ``mm`` or ``in``.
    stated : mapping of str to str
        Arithmetic that the file has for a number (``0.25/3``), by path.
    source_table : SourceTable
        Parsed TOML of the file with the variant's values; empty for a problem that was not
        read from one.
    vanished : mapping of str to float
        Numbers of the file that are read as zero where that matters, by path.
    drawn : DrawnPosition or None
        The position by which the file gives fixed points or guides; None without "drawn" ones.
    letters : Letters
        Letters of the source.
    synthesis : SynthesisTask or None
        What sizes of the mechanism follow from; None without ``[synthesis]``.
    meshes : tuple of GearMesh
        Meshes of wheels and racks on links, and wheels that roll.
    """

    mechanism: Mechanism
    bodies: Mapping[str, Body]
    slides: Mapping[str, Slide]
    drive: Drive
    lengths: tuple[tuple[str, str, float], ...] = ()
    guides: Mapping[str, tuple[str | None, complex, float]] = field(default_factory=dict)
    assembly: tuple[Rule, ...] = ()
    scales: Scales = Scales()
    dynamics: Dynamics | None = None
    cycle: CycleTask | None = None
    project: ProjectTask | None = None
    calculated: int | None = None
    numbered: tuple[float, ...] = ()
    machine: Machine | None = None
    balancing: CounterweightTask | None = None
    tables: Mapping[str, Any] = field(default_factory=dict)
    unit: str = "m"
    stated: Mapping[str, str] = field(default_factory=dict)
    source_table: SourceTable = field(default_factory=SourceTable)
    vanished: Mapping[str, float] = field(default_factory=dict)
    drawn: DrawnPosition | None = None
    letters: Letters = Letters()
    synthesis: SynthesisTask | None = None
    meshes: tuple[GearMesh, ...] = ()

    @property
    def rules(self) -> tuple[Rule, ...]:
        """Rules of assembly: those of the file, and those that its figure implies."""
        if self.drawn is None:
            return self.assembly
        own = (rule for rule in self.assembly if rule.point not in self.drawn.choosing)
        return (*own, *self.drawn.rules)

    @property
    def is_project(self) -> bool:
        """True if the file has decisions of a project, which every command follows."""
        return self.project is not None and not self.project.is_of_note

    @cached_property
    def names_of_letters(self) -> dict[str, str]:
        """Names by which quantities know the points that have letters: ``L`` is ``H2``."""
        return self.letters.names(self.bodies)

    def lettered(self, name: str) -> str:
        """Return the letter of a point by the name that quantities have: ``L`` for ``H2``.

        A joint has the letter of its first link.
        """
        for letter, own in self.names_of_letters.items():
            place, link = self.letters.points[letter]
            owners = [one for one, body in self.bodies.items() if place in body.points]
            if own == name and (link not in owners or link == owners[0]):
                return letter
        return name

    def key_symbol(self, key: QuantityKey) -> str:
        """Return the symbol of a quantity in the letters of the source."""
        names = [self.lettered(name) for name in key.names]
        if key.kind in SLIDINGS and len(names) == 2:
            for slide in self.slides.values():
                if {slide.pin, f"{slide.pin}{slide.host}"} == {*key.names}:
                    k = key.names.index(slide.pin)
                    names[k] = self.letters.point(slide.slider, slide.pin) or names[k]
        over = self.key_symbol(key.over) if key.over is not None else ""
        own = replace(key.dividend, names=tuple(names)).symbol
        return f"{own}/{over}" if over else own

    @property
    def balancer(self) -> BalancingQuantity:
        """Quantity that balances the driver, with its letter."""
        usual = self.drive.balancing
        return replace(usual, symbol=self.letters.balance) if self.letters.balance else usual

    def balancer_of(self, driver: OtherDrive) -> str:
        """Return the letter of the balance of another driving link."""
        usual = FORCE if driver.pivot is None else MOMENT
        return f"{usual.symbol} of {driver.link}"

    @property
    def turns(self) -> int:
        """Turns of the crank in a cycle: two of a machine of 720 degrees."""
        return 1 if self.machine is None else self.machine.turns

    def display_position(self, position: float) -> float:
        """Return a driver position as in documents: a numbered one is within a turn.

        The number of the position shows which of two turns it is in.
        """
        if not self.goes_round:  # over a range angles are as its limits are
            return position
        return round(position % 360.0, 2) % 360.0

    @property
    def goes_round(self) -> bool:
        """True if the numbered positions cover the whole cycle, which may have several turns."""
        step = abs(self.numbered[1] - self.numbered[0]) if self.numbered else 0.0
        turns = max(round(step * len(self.numbered) / 360.0), 1)
        return abs(step * len(self.numbered) - 360.0 * turns) <= SAME_DEG

    def counted(self, position: float) -> float | None:
        """Return the count of positions from position 0 to a place of two turns; None for one."""
        if self.turns == 1 or not self.goes_round:
            return None
        whole = (position - self.numbered[0]) / (self.numbered[1] - self.numbered[0])
        return whole % len(self.numbered)

    def guide_name(self, label: str) -> str:
        """Return the name of a guide of the frame in documents: ``x-x``, ``y-y`` (направляющая).

        A name of that form is used as it is. Another one, ``g5``, is a key of the file: the guide
        gets the first free pair of letters, ``y-y`` first where it is vertical.
        """
        if label not in self.guides or _is_pair(label):
            return label
        taken = [name for name in self.guides if _is_pair(name)]
        for name, (_, _, angle) in self.guides.items():
            if name in taken or _is_pair(name):
                continue
            letters = "yxzuw" if angle % 180.0 == 90.0 else "xyzuw"
            pairs = (f"{one}{n}-{one}{n}" for n in ("", *range(1, 99)) for one in letters)
            taken.append(next(pair for pair in pairs if pair not in taken))
            if name == label:
                break
        return taken[-1]

    @property
    def centres(self) -> frozenset[str]:
        """Centres of mass: those of [dynamics], and points S, S1, S2 ... that are not joints."""
        masses = self.dynamics.masses.values() if self.dynamics is not None else ()
        joints = {joint.point for joint in self.mechanism.revolutes}
        joints |= {slide.pin for slide in self.slides.values()}
        named = {
            point
            for body in self.bodies.values()
            for point in body.points
            if point[0] == "S" and (point[1:].isdigit() or not point[1:])
        }
        found = {mass.centre for mass in masses if mass.centre is not None} | named
        return frozenset(found - joints - {*self.bodies[FRAME].points})

    def is_block(self, slide: Slide) -> bool:
        """Return whether the host of a slide is a block through which the slider, a bar, passes."""
        return (
            slide.host != FRAME
            and len(self.bodies[slide.host].points) == 1
            and len(self.bodies[slide.slider].points) > 1
        )
