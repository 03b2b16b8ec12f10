"""Masses and loads of a problem, checked and put into plain records (SI units)."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from msgspec import Struct

GRAVITY = 9.81
"""Acceleration of free fall where the file gives no other, m/s²."""


class Mass(Struct, frozen=True):
    """Inertia of a link (масса и момент инерции звена).

    Attributes
    ----------
    mass : float, kg
        Zero for a link of which only the moment of inertia counts.
    centre : str or None
        Point of the link at its centre of mass (центр масс); None only where ``mass`` is zero.
    inertia : float, kg·m²
        Moment of inertia about the centre of mass (момент инерции).
    """

    mass: float
    centre: str | None
    inertia: float = 0.0


class Over(Enum):
    """What a table of a force or couple is over (аргумент таблицы)."""

    PHI = "phi"  # angle of the driving crank, degrees, periodic
    S = "s"  # place of the driving slider, m
    X = "x"  # coordinates of the point where the force acts, m
    Y = "y"
    POSITION = "position"  # one value for each position of the file
    PATH = "path"  # share of the stroke of the point where the force acts, from 0 to 1
    STROKES = "strokes"  # strokes done since the cycle began: an indicator diagram


class Law(Enum):
    """Kind of a table by one word (закон нагрузки), which says what it is over and how read."""

    TABLE = "table"  # over phi, straight between the rows
    PATH = "path"
    STEPS = "steps"  # over phi, each row until the next one
    INDICATOR = "indicator"  # pressures over the strokes of a piston


class Interpolation(Enum):
    """How a table is read between its rows (интерполяция)."""

    LINEAR = "linear"
    STEP = "step"  # a row holds until the next one


class Table(Struct, frozen=True):
    """Size of a load as a table (табличная сила или пара сил).

    Attributes
    ----------
    over : Over
    at : tuple of float, degrees or m
        Increasing; empty when the table is over the positions of the file. Over phi the rows lie
        within one turn and repeat. Over a path or strokes one abscissa twice is a jump.
    values : tuple of float, N or N·m
        As many as ``at``, or as the positions of the file.
    interpolation : Interpolation
    turn : float, degrees
        A table over phi repeats after so many.
    """

    over: Over
    at: tuple[float, ...]
    values: tuple[float, ...]
    interpolation: Interpolation = Interpolation.LINEAR
    turn: float = 360.0


class Fixed(Struct, frozen=True):
    """Direction that stays on the paper (неизменное направление), degrees from +x."""

    angle: float


class Against(Struct, frozen=True):
    """Sense of a resistance (сила сопротивления): against the motion; none where that stops."""


class Moving(Enum):
    """Sense of the velocity of a point (направление хода)."""

    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"


class Turning(Enum):
    """Sense of the rotation of a link (направление вращения)."""

    CCW = "ccw"
    CW = "cw"


class Phase(Struct, frozen=True):
    """When a load acts (фаза действия нагрузки): where all that is given holds.

    Attributes
    ----------
    phi : tuple of (float, float), degrees
        Each from the first angle of the driving crank counter-clockwise to the second, both ends
        included; the load acts in any of them. Empty when it does not depend on phi.
    moving : Moving or None
        Sense in which the point of application moves.
    turning : Turning or None
        Sense in which the link turns.
    """

    phi: tuple[tuple[float, float], ...] = ()
    moving: Moving | None = None
    turning: Turning | None = None


class Load(Struct, frozen=True):
    """External force on a link (внешняя сила).

    Attributes
    ----------
    name : str
        Letter in rich text, ``F_{5}``.
    link, at : str
        The link and its point where the force acts (точка приложения).
    size : float or Table, N
        A negative size acts the other way.
    sense : Fixed or Against
        Against the velocity of the point.
    phase : Phase or None
        None: it always acts.
    """

    name: str
    link: str
    at: str
    size: float | Table
    sense: Fixed | Against
    phase: Phase | None = None


class Couple(Struct, frozen=True):
    """External couple on a link (внешняя пара сил, момент).

    Attributes
    ----------
    name : str
        Letter in rich text, ``M_{1}``.
    link : str
    size : float or Table, N·m
        Counter-clockwise positive when ``sense`` is None.
    sense : Against or None
        Against the rotation of the link.
    phase : Phase or None
        None: it always acts.
    """

    name: str
    link: str
    size: float | Table
    sense: Against | None = None
    phase: Phase | None = None


class Dynamics(Struct, frozen=True):
    """What the force analysis knows beside the motion (исходные данные силового расчёта).

    Attributes
    ----------
    gravity : float, m/s²
        Acceleration of free fall (ускорение свободного падения), along -y; zero: no weights.
    masses : mapping of str to Mass
        By link; a link that is not here has no mass (невесомое звено).
    loads : tuple of Load and Couple
        In file order, with different names.
    resultant : bool
        The inertia of a link is shown as one force on a shifted line (равнодействующая сил
        инерции) where it can be, not as a force at the centre of mass and a couple.
    """

    gravity: float
    masses: Mapping[str, Mass]
    loads: tuple[Load | Couple, ...]
    resultant: bool = False


class Mean(Enum):
    """What the mean speed of a machine is (средняя угловая скорость)."""

    HALF_SUM = "half-sum"  # of the largest and the least
    TIME = "time"


class Side(Enum):
    """Which reduced moment does not change (постоянный приведённый момент)."""

    DRIVING = "driving"
    RESISTING = "resisting"


class Signs(Enum):
    """How weights are added to the loads (знаки сил тяжести)."""

    TRUE = "true"
    SOURCE = "source"  # with the other sign, as a coursework may have it


class Ordinates(Enum):
    """By what the work under a curve is measured (способ интегрирования)."""

    MIDDLE = "middle"
    TRAPEZOID = "trapezoid"


class Method(Enum):
    """How the flywheel is found of the diagrams (метод определения момента инерции маховика)."""

    WITTENBAUER = "wittenbauer"
    MERTSALOV = "mertsalov"


class Shape(Enum):
    """Shape of a flywheel (форма маховика)."""

    DISC = "disc"
    RIM = "rim"


class Wheel(Struct, frozen=True):
    """What the flywheel is to be like (исходные данные маховика).

    Attributes
    ----------
    shape : Shape
    density : float or None, kg/m³
        None: steel.
    speed : float, m/s
        Greatest speed of the rim.
    ratio : float
        Turns of the flywheel's shaft to one of the crank.
    """

    shape: Shape = Shape.DISC
    density: float | None = None
    speed: float = 30.0
    ratio: float = 1.0


class Motor(Struct, frozen=True):
    """Characteristic of a motor, reduced to the crank (механическая характеристика двигателя).

    Attributes
    ----------
    idle : float, 1/s
        Speed of the crank at which there is no moment: synchronous, or of idle running.
    moment : float, N·m
        The greatest one of Kloss's formula; of a straight line the moment at rest.
    critical_slip : float or None
        Slip of the greatest moment; None of a straight line.
    """

    idle: float
    moment: float
    critical_slip: float | None = None

    def at(self, omega: float) -> float:
        """Return the moment, N·m, at a speed of the crank, 1/s (формула Клосса, прямая)."""
        slip = 1.0 - omega / self.idle
        if self.critical_slip is None:
            return self.moment * slip
        critical = self.critical_slip
        return 2.0 * self.moment * slip * critical / (slip * slip + critical * critical)


class Machine(Struct, frozen=True):
    """What the choice of a flywheel knows beside masses and loads (исходные данные маховика).

    Attributes
    ----------
    delta : float
        Irregularity of the motion (коэффициент неравномерности), between 0 and 1.
    mean : Mean
    constant : Side
    cycle_deg : float
        360, or 720 of a four-stroke engine.
    crank_inertia : float, kg·m²
        On the crank beside the links' own.
    count : int
        Positions of the construction in a cycle.
    pole_mm, turn_mm : float, mm
        Pole distance of the graphical integration, and the length of a cycle on the sheet.
    mu_M, mu_J : float or None, N·m/mm and kg·m²/mm
        None where the program chooses.
    signs : Signs
    ordinates : Ordinates
    method : Method
    start_deg : float or None
        Driver angle of position 0; None: the first position of the file.
    wheel : Wheel
    motor : Motor or None
        What drives in a run-up.
    brake : float or None, N·m
        Moment on the crank that stops it; None: not asked.
    """

    delta: float
    mean: Mean = Mean.HALF_SUM
    constant: Side = Side.DRIVING
    cycle_deg: float = 360.0
    crank_inertia: float = 0.0
    count: int = 12
    pole_mm: float = 30.0
    turn_mm: float = 240.0
    mu_M: float | None = None  # noqa: N815 - the letters of the textbook
    mu_J: float | None = None  # noqa: N815
    signs: Signs = Signs.TRUE
    ordinates: Ordinates = Ordinates.MIDDLE
    method: Method = Method.WITTENBAUER
    start_deg: float | None = None
    wheel: Wheel = Wheel()
    motor: Motor | None = None
    brake: float | None = None


class Weighing(Enum):
    """How much counterweights balance (полное или частичное уравновешивание)."""

    FULL = "full"
    PARTIAL = "partial"  # by the crank's counterweight alone


class CounterweightTask(Struct, frozen=True):
    """What ``[balancing]`` asks (статическое уравновешивание).

    Attributes
    ----------
    method : Weighing
    share : float or None
        Share of the reciprocating mass that the crank balances; None: the first harmonic that turns
        with the crank.
    radii : mapping of str to float, m
        By link, where its counterweight stands; elsewhere at the length of the link.
    """

    method: Weighing
    share: float | None
    radii: Mapping[str, float]
