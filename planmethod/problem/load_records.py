"""Checked masses and loads of a problem as plain records (SI units)."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import Annotated

from msgspec import Struct, field

from planmethod.problem.key_types import (
    AngleKey,
    CustomKey,
    FlagKey,
    NumberKey,
    TextKey,
    WordKey,
)

GRAVITY = 9.81
"""Acceleration of free fall where the file gives no other, m/s²."""


class Mass(Struct, frozen=True):
    """Inertia of a link (масса и момент инерции звена); it has a centre where it has a mass."""

    mass: Annotated[float, NumberKey("mass (масса)", "a mass", "kg", 0.0, 1e12)] = 0.0
    centre: Annotated[
        str | None,
        CustomKey(
            "centre of mass (центр масс): a point of the link by name. Required with a mass, "
            "unless the link has one point only"
        ),
    ] = None
    inertia: Annotated[
        float,
        NumberKey(
            "moment of inertia (момент инерции) about the centre of mass",
            "a moment of inertia", "kg·m²", 0.0, 1e12,
        ),
    ] = 0.0  # fmt: skip


class Over(Enum):
    """Argument of the table of a force or couple (аргумент таблицы)."""

    PHI = "phi"  # angle of the driving crank, degrees, periodic
    S = "s"  # place of the driving slider, m
    X = "x"  # coordinates of the point where the force acts, m
    Y = "y"
    POSITION = "position"  # one value for each position of the file
    PATH = "path"  # share of the stroke of the point where the force acts, from 0 to 1
    STROKES = "strokes"  # strokes done since the cycle began: an indicator diagram


class LoadLaw(Enum):
    """Kind of a table by one word (закон нагрузки): its argument and interpolation."""

    TABLE = "table"  # over phi, straight between the rows
    PATH = "path"
    STEPS = "steps"  # over phi, each row until the next one
    INDICATOR = "indicator"  # pressures over the strokes of a piston


class Interpolation(Enum):
    """Interpolation between the rows of a table (интерполяция)."""

    LINEAR = "linear"
    STEP = "step"  # a row holds until the next one


class IndicatorDiagram(Struct, frozen=True):
    """Pressures on a piston as the file gives them (индикаторная диаграмма).

    Attributes
    ----------
    strokes : tuple of tuple of (float, float)
        Shares of the stroke from the top dead centre and pressures, Pa, stroke by stroke.
    area, area_2 : float, m²
        Of the piston, and of its other side.
    sides : int
        2: the pressure is on its other side as well, one stroke ahead.
    """

    strokes: tuple[tuple[tuple[float, float], ...], ...]
    area: float
    area_2: float
    sides: int = 1


class SizeTable(Struct, frozen=True):
    """Size of a load as a table (табличная сила или пара сил).

    Attributes
    ----------
    over : Over
    at : tuple of float, degrees or m
        Increasing; empty when the table is over the positions of the file. Over phi the rows are
        within one turn and repeat. Over a path or strokes one abscissa twice is a jump.
    values : tuple of float, N or N·m
        As many as ``at``, or as the positions of the file.
    interpolation : Interpolation
    turn : float, degrees
        Period of a table over phi.
    like : str or None
        Of an indicator: the load of another piston whose diagram it shares.
    shift : float, degrees
        Part of the cycle by which its first stroke begins later than that load's.
    indicator : IndicatorDiagram or None
        Of an indicator: its data in the file.
    """

    over: Over
    at: tuple[float, ...]
    values: tuple[float, ...]
    interpolation: Interpolation = Interpolation.LINEAR
    turn: float = 360.0
    like: str | None = None
    shift: float = 0.0
    indicator: IndicatorDiagram | None = None


class Fixed(Struct, frozen=True):
    """Direction that stays on the paper (неизменное направление), degrees from +x."""

    angle: float


class Against(Struct, frozen=True):
    """Sense of a resistance (сила сопротивления): against the motion; none where that stops."""


class MovingSense(Enum):
    """Sense of the velocity of a point (направление хода)."""

    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"


class TurningSense(Enum):
    """Sense of the rotation of a link (направление вращения)."""

    CCW = "ccw"
    CW = "cw"


class Phase(Struct, frozen=True):
    """Phase in which a load acts (фаза действия нагрузки): all given conditions hold."""

    phi: Annotated[
        tuple[tuple[float, float], ...],
        CustomKey(
            "`[from, to]`, degrees, of the driving crank, or a list of such pairs. It runs "
            "counter-clockwise whichever way the crank turns, through 360 where needed; both ends "
            "included"
        ),
    ] = ()
    moving: Annotated[
        MovingSense | None,
        WordKey(
            'the sense in which the point of application moves: `"up"`, `"down"`, `"left"` or '
            '`"right"`; never where it stands'
        ),
    ] = None
    turning: Annotated[
        TurningSense | None, WordKey('the sense in which the link turns: `"ccw"` or `"cw"`')
    ] = None


class LoadEntry(Struct, frozen=True):
    """A table of ``[[loads]]`` as written; it becomes a `Load` or a `Couple`."""

    name: Annotated[
        str,
        TextKey(
            "letter for the sheets, with indices in braces: `F_{5}`, `M_{1}^{c}`, `P`; `F5` is "
            "`F_{5}`",
            40,
            more=", each load its own. When absent: `F_{5}`, `F_{5}'`, ... for forces on link 5, "
            "`M_{5}`, ... for couples",
        ),
    ] = ""
    link: Annotated[str, CustomKey("name of the link", required=True)] = ""
    at: Annotated[
        str,
        CustomKey(
            "point of application (точка приложения): a point of that link by name; required with "
            "a force, not for a couple"
        ),
    ] = ""
    force: Annotated[float | SizeTable, CustomKey("force, N: a number or a table")] = 0.0
    couple: Annotated[
        float | SizeTable,
        CustomKey("couple (момент), N·m: a number or a table; counter-clockwise positive"),
    ] = 0.0
    angle: Annotated[float | None, AngleKey("direction of the force from +x, degrees")] = None
    against: Annotated[
        str,
        CustomKey(
            '`"velocity"`: the force is opposite to the velocity of its point; `"rotation"`: the '
            "couple is opposite to the rotation of its link"
        ),
    ] = ""
    phases: Annotated[
        Phase, CustomKey("when it acts (фазы действия), see below; default: always")
    ] = Phase()
    like: Annotated[
        str,
        CustomKey(
            "in place of `force`: the load of another piston, whose indicator diagram this one has"
        ),
    ] = ""
    shift: Annotated[
        float | None,
        CustomKey("with `like`: how many degrees of the cycle later, the firing interval"),
    ] = None


class Load(Struct, frozen=True):
    """External force on a link (внешняя сила).

    Attributes
    ----------
    name : str
        Letter in rich text, ``F_{5}``.
    link, at : str
        The link and its point where the force acts (точка приложения).
    size : float or SizeTable, N
        A negative size acts the other way.
    sense : Fixed or Against
        Against the velocity of the point.
    phase : Phase or None
        None: it always acts.
    """

    name: str
    link: str
    at: str
    size: float | SizeTable
    sense: Fixed | Against
    phase: Phase | None = None


class Couple(Struct, frozen=True):
    """External couple on a link (внешняя пара сил, момент).

    Attributes
    ----------
    name : str
        Letter in rich text, ``M_{1}``.
    link : str
    size : float or SizeTable, N·m
        Counter-clockwise positive when ``sense`` is None.
    sense : Against or None
        Against the rotation of the link.
    phase : Phase or None
        None: it always acts.
    """

    name: str
    link: str
    size: float | SizeTable
    sense: Against | None = None
    phase: Phase | None = None


class BalancingForceTask(Struct, frozen=True):
    """Task of ``[balancing_force]`` (уравновешивающая сила): a force at a point of the crank."""

    at: Annotated[
        str, CustomKey("point of the crank where the force acts (точка приложения)", required=True)
    ]
    angle: Annotated[
        float | None,
        AngleKey(
            "its direction from +x, degrees; the force is negative where it acts the other way",
            absent="across the line from the axis to the point, positive counter-clockwise",
        ),
    ] = None


_LIKE = "A coefficient of friction is a number like 0.1."


class PairFriction(Struct, frozen=True):
    """Friction of one kinematic pair, a table of ``friction.pairs`` (трение в паре)."""

    f: Annotated[
        float | None,
        NumberKey("coefficient of friction", "a coefficient", "", 0.0, 10.0, hint=_LIKE),
    ] = None
    radius: Annotated[
        float | None, NumberKey("radius of the pin of a turning pair", "a radius", "m", 0.0, 10.0)
    ] = None


class FrictionTask(Struct, frozen=True):
    """Data of ``[friction]`` (трение в кинематических парах)."""

    f: Annotated[
        float,
        NumberKey("coefficient of sliding pairs (f)", "a coefficient", "", 0.0, 10.0, hint=_LIKE),
    ] = 0.0
    f_pin: Annotated[
        float,
        NumberKey(
            "reduced coefficient of turning pairs (приведённый коэффициент f′)",
            "a coefficient", "", 0.0, 10.0, hint=_LIKE,
        ),
    ] = 0.0  # fmt: skip
    radius: Annotated[
        float, NumberKey("radius of the pins (радиус цапф)", "a radius", "m", 0.0, 10.0)
    ] = 0.0
    pairs: Annotated[
        Mapping[str, PairFriction],
        CustomKey(
            "a table for each pair that has other values, named by its joint and its two links: "
            '`"B 3-0" = { f = 0.2 }`, a sliding pair by its pin, the frame is 0'
        ),
    ] = field(default_factory=dict)


class BearingSection(Struct, frozen=True):
    """Two bearings of a shaft, a table of ``[bearings]`` (подшипники вала)."""

    at: Annotated[
        tuple[float, float],
        CustomKey(
            "`[z′, z″]`: where the bearings O′ and O″ are along the axis of the shaft, m, counted "
            "from anywhere",
            required=True,
        ),
    ]
    plane: Annotated[
        float,
        NumberKey("where the plane of the force is along the axis", "a distance", "m", -1e3, 1e3),
    ] = 0.0

    @property
    def load_fractions(self) -> tuple[float, float]:
        """Fractions of an in-plane force on the two bearings; negative where it acts back."""
        first, second = self.at
        return (second - self.plane) / (second - first), (self.plane - first) / (second - first)


class Dynamics(Struct, frozen=True):
    """Data of the force analysis besides the motion (исходные данные силового расчёта).

    Attributes
    ----------
    gravity : float, m/s²
        Zero: no weights.
    masses : mapping of str to Mass
        By link.
    loads : tuple of Load and Couple
        In file order, with different names.
    resultant : bool
        (равнодействующая сил инерции)
    friction : FrictionTask or None
        None: the pairs are ideal.
    bearings : mapping of str to BearingSection
        By the joint of the shaft with the frame.
    """

    gravity: Annotated[
        float,
        CustomKey(
            "acceleration of free fall (ускорение свободного падения), m/s², along -y; `0` "
            "or `false` for no weights; default: 9.81"
        ),
    ]
    masses: Annotated[
        Mapping[str, Mass],
        CustomKey(
            "a table for each link that has mass; a link that is not named is massless (невесомое "
            "звено)",
            name="links",
        ),
    ]
    loads: tuple[Load | Couple, ...]
    resultant: Annotated[
        bool,
        FlagKey(
            "the inertia forces of a link are one force on a shifted line, without a couple, where "
            "that can be drawn ([forces.md](forces.md))"
        ),
    ] = False
    friction: FrictionTask | None = None
    bearings: Mapping[str, BearingSection] = field(default_factory=dict)
