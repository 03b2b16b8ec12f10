"""Plain records of the cycle, of a project's decisions, flywheel, motor, counterweights."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from enum import Enum
from itertools import permutations
from typing import Annotated

from msgspec import Struct, field

from planmethod.problem.motor_records import CatalogueMotor, Motor
from planmethod.problem.quantities import (
    TRANSFERS,
    QuantityKey,
    QuantityKind,
    QuantityNameError,
    parse_quantity,
)
from planmethod.problem.records import TurningSense
from planmethod.problem.tables import AngleKey, CustomKey, FlagKey, IntegerKey, NumberKey, WordKey

OF_POINTS = (
    QuantityKind.PLACE,
    QuantityKind.TRANSFER,
    QuantityKind.VELOCITY,
    QuantityKind.TRANSFER_2,
    QuantityKind.ACCELERATION,
)
"""Kinds of quantities of points over the turn; of vectors the size, and both components.

Velocities and accelerations relative to another point have their size."""

OF_LINKS = (
    QuantityKind.DIRECTION,
    QuantityKind.RATIO,
    QuantityKind.OMEGA,
    QuantityKind.RATIO_2,
    QuantityKind.EPSILON,
)
"""Kinds of quantities of links over the turn."""

OUTPUT = "output"
"""Stands for the place of the output and its transfer functions."""


class GraphQuantity(Struct, frozen=True):
    """A quantity that is shown over the turn (величина графика).

    Attributes
    ----------
    key : QuantityKey
    label : str
    symbol : str
        Rich text.
    """

    key: QuantityKey
    label: str
    symbol: str

    @property
    def kind(self) -> QuantityKind:
        """Its kind."""
        return self.key.kind

    @property
    def axis(self) -> str:
        """``x``, ``y`` of a component; empty for a magnitude, and for a scalar."""
        return self.key.axis

    @property
    def of(self) -> str:
        """The point, or the link; of two points the first one, which moves past the second."""
        return self.key.names[0]

    @property
    def unit(self) -> str:
        """Unit in SI, degrees of angles; empty of a ratio."""
        return self.kind.unit.replace("1", "") if self.kind in TRANSFERS else self.kind.unit

    @property
    def family(self) -> str:
        """Key of its diagram: coordinates share one, others one for each letter."""
        return self.kind.word or "x"

    @property
    def axis_symbol(self) -> str:
        """Symbol at the axis of a diagram with several curves, rich text."""
        if self.kind is QuantityKind.PLACE:
            return "x, y"
        index = _transfer_index(self.kind)
        return f"{self.kind.symbol}_{{{index}}}" if index else self.kind.symbol

    @property
    def scale_index(self) -> str:
        """Index of the scale of its diagram, rich text."""
        if self.kind is QuantityKind.PLACE:
            return "l"
        index = "_{i}" if self.kind is QuantityKind.DIRECTION else _transfer_index(self.kind)
        return self.kind.symbol + index


def _transfer_index(kind: QuantityKind) -> str:
    return "q" if kind in TRANSFERS and kind is not QuantityKind.RATIO else ""


def graph_quantities(
    points: Iterable[str], links: Collection[str], crank: str
) -> dict[str, GraphQuantity]:
    """Return every quantity that has a graph over the turn, by its label.

    Parameters
    ----------
    points, links : iterables of str
        Of the moving links.
    crank : str
        The driving link, of which transfer functions are 1 and 0.
    """
    found: list[GraphQuantity] = []
    points = [*points]
    for point in points:
        for kind in OF_POINTS:
            for axis in ("x", "y") if kind is QuantityKind.PLACE else ("", "x", "y"):
                head, part = (kind.symbol, axis) if kind.symbol else (axis, "")
                of = _transfer_index(kind) + point
                key = QuantityKey(kind, (point,), axis)
                symbol = f"{head}_{{{of}{part}}}"
                found.append(GraphQuantity(key, kind.label(point, axis), symbol))
    for kind in (QuantityKind.VELOCITY, QuantityKind.ACCELERATION):
        for pair in permutations(points, 2):
            label = "_".join((kind.word, *pair))
            symbol = f"{kind.letter}_{{{''.join(pair)}}}"
            found.append(GraphQuantity(QuantityKey(kind, pair), label, symbol))
    for link in links:
        for kind in OF_LINKS:
            if link == crank and kind in TRANSFERS:
                continue
            is_ratio = kind is QuantityKind.RATIO
            names = (link, crank) if is_ratio else (link,)
            of = ratio_of(link, crank, links) if is_ratio else link
            symbol = f"{kind.symbol}_{{{_transfer_index(kind)}{of}}}"
            found.append(GraphQuantity(QuantityKey(kind, names), kind.label(of), symbol))
    return {one.label: one for one in found}


def find_graph(known: Mapping[str, GraphQuantity], name: str) -> GraphQuantity | None:
    """Return the quantity of a label, or of another spelling of it; None if there is none."""
    if name in known:
        return known[name]
    try:
        key = parse_quantity(name)
    except QuantityNameError:
        return None
    return next((one for one in known.values() if one.key.is_same(key)), None)


def ratio_of(link: str, crank: str, links: Collection[str]) -> str:
    """Return the index of a ratio: ``21``; ``12/1`` where that is ambiguous."""
    plain = f"{link}{crank}"
    return plain if len(plain) == 2 and plain not in links else f"{link}/{crank}"


DIAGRAM_HINT = "Millimetres of the diagrams."


class Zero(Enum):
    """Position zero by name: the start of the quicker, the slower or the working stroke.

    The usual one, without a name in files, is that of the working stroke where loads or the file
    determine it, else that of the quicker stroke.
    """

    USUAL = ""
    EXTREME = "extreme"
    OTHER = "other extreme"
    WORKING = "working"


class StrokeSense(Enum):
    """Sense in which the output moves on its working stroke (направление рабочего хода)."""

    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"
    CCW = "ccw"
    CW = "cw"


class Differentiation(Enum):
    """Method of graphical differentiation of a diagram (графическое дифференцирование)."""

    CHORDS = "chords"
    TANGENTS = "tangents"
    CURVE = "curve"


class PoleDistances(Struct, frozen=True):
    """Pole distances of both differentiations (полюсные расстояния); None where scales set them."""

    v: Annotated[
        float | None,
        NumberKey(
            "pole distance of the first differentiation; it determines the scale of the velocity",
            "a length", "mm", 1.0, 500.0, positive=True, hint=DIAGRAM_HINT,
            absent="from a round scale",
        ),
    ] = None  # fmt: skip
    a: Annotated[
        float | None,
        NumberKey(
            "pole distance of the second differentiation; it determines the scale of the "
            "acceleration",
            "a length", "mm", 1.0, 500.0, positive=True, hint=DIAGRAM_HINT,
            absent="from a round scale",
        ),
    ] = None  # fmt: skip


class CycleTask(Struct, frozen=True):
    """Requests for the cycle of a crank (цикл движения): ``[cycle]``."""

    output: Annotated[
        str | None,
        CustomKey(
            "the output: a point on a guide of the frame, or a link",
            absent="the last driven link that is joined to the frame",
        ),
    ] = None
    zero: Annotated[
        Zero | float,
        CustomKey(
            'position 0 (нулевое положение): an extreme position of the output (`"extreme"`, '
            '`"other extreme"`), the start of the working stroke (`"working"`), or the angle of '
            "the crank, degrees",
            absent=(
                "`phi_0` of `[machine]`, else the start of the working stroke if loads or "
                '`working` determine it, else `"extreme"`'
            ),
        ),
    ] = Zero.USUAL
    direction: Annotated[
        TurningSense | None,
        WordKey(
            'sense in which the positions are numbered, counter-clockwise (`"ccw"`) or clockwise '
            '(`"cw"`)',
            absent="that of the driver",
        ),
    ] = None
    count: Annotated[
        int,
        IntegerKey(
            "number of positions in a turn",
            3,
            360,
            absent=(
                "12; `count` of `[machine]` if it is the only one, else that of a full turn of "
                "`[driver] phi`"
            ),
        ),
    ] = 12
    working: Annotated[
        StrokeSense | None,
        WordKey(
            'sense in which the output moves on its working stroke (рабочий ход): `"up"`, '
            '`"down"`, `"left"`, `"right"`; for a link `"ccw"` or `"cw"`',
            absent="the stroke that the loads resist, or the longer one if the file has no loads",
        ),
    ] = None
    length: Annotated[
        float | None,
        NumberKey(
            "length of the axis of φ for one cycle on the sheet; it determines the scale of φ",
            "a length", "mm", 20.0, 2000.0, positive=True, hint=DIAGRAM_HINT,
            absent="from a round scale",
        ),
    ] = None  # fmt: skip
    pole: Annotated[
        PoleDistances,
        CustomKey(
            "pole distances of both differentiations (полюсные расстояния), mm: `{ v = 36, a = 36 "
            "}`",
            absent="from round scales",
        ),
    ] = PoleDistances()
    graphs: Annotated[
        tuple[str, ...],
        CustomKey(
            'quantities whose graphs over the turn are drawn: `["x_C", "phi_3", "v_q_C", '
            '"v_qx_C", "u_31", "omega_3", "ay_C"]`; `"output"` means the position of the output '
            "and its transfer functions",
            absent="none",
        ),
    ] = ()
    differentiation: Annotated[
        Differentiation,
        WordKey(
            'graphical differentiation: by chords (`"chords"`, хорды), by tangents (`"tangents"`, '
            'касательные), or by chords of the drawn curve (`"curve"`)'
        ),
    ] = Differentiation.CHORDS

    def is_against(self, sense: float) -> bool:
        """Return whether positions are numbered against a turning of the crank, by its sign."""
        return self.direction is not None and (self.direction is TurningSense.CCW) != (sense > 0.0)


PROJECT_PARTS = (
    "synthesis",
    "kinematics",
    "forces",
    "flywheel",
    "balancing",
    "gears",
    "meshing",
    "cam",
    "note",
)
"""Parts of a project in the order of their sheets."""


OF_NOTE = ("sources", "analytic", "centres", "theory")
"""Keys of ``[project]`` that are of the note only. Alone they do not make a file a project."""


class ProjectTask(Struct, frozen=True):
    """Decisions of a project (курсовой проект): ``[project]``."""

    calculated: Annotated[
        int | None,
        IntegerKey(
            "number of the calculated position (расчётное положение), from 0. It is drawn bold, "
            "carries the loads, and is described in full",
            0, 719, absent="that of `phi` if it is one of the positions, else the clearest one",
        ),
    ] = None  # fmt: skip
    gears: Annotated[
        str,
        CustomKey(
            'file of the gear train, in the same folder: `"train.toml"`',
            absent="`[gears]` of this file",
        ),
    ] = ""
    meshing: Annotated[
        str,
        CustomKey(
            'file of the gears in mesh, in the same folder: `"wheels.toml"`',
            absent="`[meshing]` of this file",
        ),
    ] = ""
    cam: Annotated[
        str,
        CustomKey(
            'file of the cam, in the same folder: `"cam.toml"`', absent="`[cam]` of this file"
        ),
    ] = ""
    parts: Annotated[
        tuple[str, ...],
        CustomKey("parts of the project to make", absent="all parts that the file has data for"),
    ] = ()
    sources: Annotated[
        tuple[str, ...],
        CustomKey(
            "books of the list of sources of the note, one line each, after `source` and before "
            "the standards"
        ),
    ] = ()
    analytic: Annotated[
        bool,
        FlagKey(
            "add a chapter on the analytic method to the note: closed contours, their projections "
            "and derivatives"
        ),
    ] = False
    centres: Annotated[
        bool,
        FlagKey(
            "add a chapter on the instant centres to the note: all of them by Kennedy's lines, and "
            "the velocities by them"
        ),
    ] = False
    theory: Annotated[
        bool,
        FlagKey(
            "add theory to the note: definitions of the plans, cases of motion, the formula of "
            "mobility by the number of all links, the composition of the mechanism"
        ),
    ] = False

    @property
    def is_of_note(self) -> bool:
        """True if it has keys of the note, and no decisions."""
        note = ProjectTask(**{key: getattr(self, key) for key in OF_NOTE})
        return self == note != ProjectTask()


class MeanSpeed(Enum):
    """Definition of the mean speed of a machine (средняя угловая скорость)."""

    HALF_SUM = "half-sum"  # of the largest and the least
    TIME = "time"


class ConstantMoment(Enum):
    """The constant reduced moment (постоянный приведённый момент)."""

    DRIVING = "driving"
    RESISTING = "resisting"


class WeightSigns(Enum):
    """Signs of weights among the loads (знаки сил тяжести)."""

    TRUE = "true"
    SOURCE = "source"  # with the other sign, as a coursework may have it


class Quadrature(Enum):
    """Rule of integration for the work under a curve (способ интегрирования)."""

    MIDDLE = "middle"
    TRAPEZOID = "trapezoid"


class FlywheelMethod(Enum):
    """Method of finding the flywheel's inertia (метод определения момента инерции маховика)."""

    WITTENBAUER = "wittenbauer"
    MERTSALOV = "mertsalov"


class WheelShape(Enum):
    """WheelShape of a flywheel (форма маховика)."""

    DISC = "disc"
    RIM = "rim"


class FlywheelTask(Struct, frozen=True):
    """Specification of the flywheel (исходные данные маховика)."""

    shape: Annotated[WheelShape, WordKey('a solid disc (`"disc"`) or a rim (`"rim"`)')] = (
        WheelShape.DISC
    )
    density: Annotated[
        float | None,
        NumberKey(
            "density of the material", "a density", "kg/m³", 100.0, 3e4, absent="that of steel"
        ),
    ] = None
    speed: Annotated[
        float | None,
        NumberKey(
            "greatest permitted speed of the rim",
            "a speed", "m/s", 0.1, 1e3,
            absent="50 for steel, 30 for a density below 7500 (cast iron)",
        ),
    ] = None  # fmt: skip
    ratio: Annotated[
        float,
        NumberKey(
            "turns of the flywheel for one turn of the crank",
            "a ratio of speeds", low=1e-3, high=1e3,
        ),
    ] = 1.0  # fmt: skip

    @property
    def greatest_speed(self) -> float:
        """Maximum speed of the rim, m/s: the file's, else that of its material."""
        if self.speed is not None:
            return self.speed
        return 30.0 if self.density is not None and self.density < CAST_IRON else 50.0


CAST_IRON = 7500.0
"""Density below which a flywheel is of cast iron, not of steel, kg/m³."""


class Machine(Struct, frozen=True):
    """Data for the flywheel besides masses and loads (исходные данные маховика)."""

    delta: Annotated[
        float,
        CustomKey(
            "coefficient of speed fluctuation (коэффициент неравномерности δ), between 0 and 1: a "
            'number or a fraction, `"1/18"`',
            required=True,
            missing='Give the coefficient of speed fluctuation: delta = "1/18".',
        ),
    ]
    mean: Annotated[
        MeanSpeed,
        WordKey(
            "meaning of the speed in `[driver]`: half the sum of the greatest and the least speed "
            '(`"half-sum"`) or the mean over time (`"time"`)'
        ),
    ] = MeanSpeed.HALF_SUM
    constant: Annotated[
        ConstantMoment,
        WordKey(
            'reduced moment that is constant: `"driving"` (presses, pumps, compressors) or '
            '`"resisting"` (engines)'
        ),
    ] = ConstantMoment.DRIVING
    cycle_deg: Annotated[
        float,
        CustomKey(
            "length of the cycle, degrees: 360, or 720 for a four-stroke engine", absent="360"
        ),
    ] = 360.0
    crank_inertia: Annotated[
        float,
        NumberKey(
            "moment of inertia that rotates with the crank, in addition to those in `[dynamics]`",
            "a moment of inertia", "kg·m²", 0.0, 1e12, name="J_crank",
        ),
    ] = 0.0  # fmt: skip
    count: Annotated[
        int,
        IntegerKey(
            "number of positions in the cycle for the construction",
            4, 72, absent="that of `[cycle]`, else one position for every 30 degrees",
        ),
    ] = 12  # fmt: skip
    pole_mm: Annotated[
        float | None,
        NumberKey(
            "pole distance of the graphical integration; it determines the scale of the work",
            "a distance", "mm", 5.0, 500.0, absent="from a round scale",
        ),
    ] = None  # fmt: skip
    turn_mm: Annotated[
        float | None,
        NumberKey(
            "length of the cycle on the sheet; it determines the scale of φ",
            "a length", "mm", 60.0, 1000.0, absent="from a round scale",
        ),
    ] = None  # fmt: skip
    mu_M: Annotated[  # noqa: N815 - the letters of the textbook
        float | None,
        NumberKey(
            "scale of the moment", "a scale", "N·m/mm", 1e-12, 1e12, absent="chosen from the series"
        ),
    ] = None
    mu_J: Annotated[  # noqa: N815
        float | None,
        NumberKey(
            "scale of the moment of inertia",
            "a scale", "kg·m²/mm", 1e-12, 1e12, absent="chosen from the series",
        ),
    ] = None  # fmt: skip
    signs: Annotated[
        WeightSigns,
        WordKey(
            'sign of the weights in the reduced moment: `"true"`, or the opposite sign, as some '
            'textbooks print it (`"source"`)'
        ),
    ] = WeightSigns.TRUE
    ordinates: Annotated[
        Quadrature,
        WordKey(
            'graphical integration by middle ordinates (`"middle"`) or by trapezoids '
            '(`"trapezoid"`)'
        ),
    ] = Quadrature.MIDDLE
    method: Annotated[
        FlywheelMethod,
        WordKey(
            'construction of the flywheel: `"wittenbauer"` (tangents with slopes 1 ± δ to the '
            'energy-mass diagram) or `"mertsalov"` (the energy T_II of the links at the mean '
            "speed is subtracted from ΔT)"
        ),
    ] = FlywheelMethod.WITTENBAUER
    start_deg: Annotated[
        float | None,
        AngleKey(
            "angle of the crank in position 0, degrees. The positions follow in its sense of "
            "rotation",
            name="phi_0",
            absent="that of `[cycle]`, else the first angle of `[driver]`",
        ),
    ] = None
    wheel: Annotated[
        FlywheelTask, CustomKey("shape and material of the flywheel", name="flywheel")
    ] = FlywheelTask()
    motor: Annotated[
        Motor | None,
        CustomKey(
            "characteristic of the motor (механическая характеристика двигателя), for the run-up "
            "and the motion that follows. The flywheel is chosen for a constant driving moment"
        ),
    ] = None
    efficiency: Annotated[
        float | None,
        NumberKey(
            "efficiency of the mechanism from the crank to the output. That of the train is in "
            "`[gears]`; both are in the power of the motor",
            "an efficiency", low=0.01, high=1.0, absent="losses of the mechanism are left out",
        ),
    ] = None  # fmt: skip
    brake: Annotated[
        float | None,
        NumberKey(
            "braking moment on the crank; with 0 the machine coasts. `planmethod sheet --layout "
            "run-up` draws run-up and stop",
            "a moment", "N·m", 0.0, 1e12,
        ),
    ] = None  # fmt: skip
    stated_count: int | None = None
    """``count`` where the file has it."""
    motors: tuple[CatalogueMotor, ...] = ()
    """The motors of ``[[motors]]``."""

    @property
    def turns(self) -> int:
        """Turns of the crank in a cycle: two of 720 degrees."""
        return round(self.cycle_deg / 360.0)


class Weighing(Enum):
    """Extent of balancing by counterweights (полное или частичное уравновешивание)."""

    FULL = "full"
    PARTIAL = "partial"  # by the crank's counterweight alone


class CounterweightTask(Struct, frozen=True):
    """Task of ``[balancing]`` (статическое уравновешивание)."""

    method: Annotated[
        Weighing, WordKey('`"full"`, or `"partial"`: by a counterweight on the crank alone')
    ] = Weighing.FULL
    share: Annotated[
        float | None,
        NumberKey(
            'with `"partial"`: share of the reciprocating mass that the crank balances',
            "a share", low=0.0, high=1.0,
            hint="1/2 removes half of the force along the slide and adds the same amount "
                    "across it.",
            absent="the first harmonic of the force that rotates with the crank",
        ),
    ] = None  # fmt: skip
    radii: Annotated[
        Mapping[str, float],
        CustomKey(
            "distance of each counterweight from the axis of its link (on a rod, from the crank "
            "pin), m, by link",
            absent="the length of the link",
        ),
    ] = field(default_factory=dict)
