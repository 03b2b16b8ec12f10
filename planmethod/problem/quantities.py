"""Names of quantities: their kinds in one table, and the one parser of all their spellings.

A quantity has one name, a `QuantityKey`: its kind and the points, links or loads that it is of.
Files and commands spell it in words (``vs B3 B``), by a label (``v_B3/2``) or as a column of
numbers (``B.vx``, ``F.B.2-1``); `parse_quantity` reads them all. `QuantityKind` is the table of the
letters, units and signs.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping
from enum import Enum, unique
from types import MappingProxyType
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.names import indexed, nearest_name, short
from planmethod.problem.records import DirectionMode


class NameRole(Enum):
    """Role of a name in a quantity."""

    POINT = "point"
    PLAN_POINT = "plan point"  # a point, or the pole of a plan
    LINK = "link"
    BODY = "body"  # a link, or the frame
    LOAD = "load"  # an external load, by its letter in the file
    NUMBER = "number"  # of a position of ``[machine]``


class Analysis(Enum):
    """Analysis that a quantity is of (раздел расчёта)."""

    MOTION = "motion"
    FORCES = "forces"
    MACHINE = "machine"
    CYCLE = "cycle"
    SYNTHESIS = "synthesis"

    @property
    def needs_loads(self) -> bool:
        """Whether it is of the masses and loads of a file."""
        return self in (Analysis.FORCES, Analysis.MACHINE)

    @property
    def is_of_position(self) -> bool:
        """Whether its quantities are of one position, not of the whole cycle."""
        return self in (Analysis.MOTION, Analysis.FORCES)


class Sign(Enum):
    """Meaning of the sign of a number."""

    SIZE = "size"  # no meaning: it is a magnitude
    TURN = "turn"  # the sense, which may be stated separately instead
    STRICT = "strict"  # it belongs to the number
    ANGLE = "angle"  # degrees, whole turns do not count


class Measure(Enum):
    """Thing that a step of the program makes for a quantity (что измеряется)."""

    PLACE = "place"  # a point, from the origin of the paper
    VECTOR = "vector"  # a point of a plan, from its pole
    NUMBER = "number"
    ANGLE = "angle"  # that of a line, degrees
    DIRECTION = "direction"  # of a line, as a unit vector


Form = tuple[NameRole, ...]

_POINT, _LINK = NameRole.POINT, NameRole.LINK
_ONE: Form = (_POINT,)
_TWO: Form = (_POINT, _POINT)
_OF: Form = (_LINK,)
_ON_BY: Form = (NameRole.BODY, NameRole.BODY)
_LOAD: Form = (NameRole.LOAD,)
_ENDS: Form = (NameRole.PLAN_POINT, NameRole.PLAN_POINT)
_AT: Form = (NameRole.NUMBER,)
_TURN, _ALONG = DirectionMode.TURN, DirectionMode.DIRECTION


class KindFacts(Struct, frozen=True):
    """Properties of a kind of quantity.

    Attributes
    ----------
    word : str
        Its name in words: ``v``, ``arm weight``; empty if it is not named alone.
    forms : tuple of tuples of NameRole
        What its names are, in every form it has.
    unit : str
        In SI; ``deg``; ``mm`` of a plan; empty where the driver determines it.
    order : int
        Of its derivative by time: 1 on the velocity plan, 2 on the acceleration plan.
    letter : str
        Beginning of its label: ``omega``; empty of a kind that has none, and of a place.
    symbol : str
        Letter of its symbol in rich text; empty where it is the first word.
    part : str
        Word of a component: ``v{}``; empty where there is none.
    record : str
        Its key in records of points, links and pairs; empty where it is the letter.
    columns : tuple of str
        Endings of the names of table columns; none if the label is the name.
    sign : Sign
    sense : DirectionMode or None
        Sense that it shows besides its size.
    measure : Measure
    is_size : bool
        True if the drawing gives only its size, without a sign.
    about : bool
        True if its last name follows the word ``about``.
    analysis : Analysis
    """

    word: str
    forms: tuple[Form, ...]
    unit: str
    order: int = 0
    letter: str = ""
    symbol: str = ""
    part: str = ""
    record: str = ""
    columns: tuple[str, ...] = ()
    sign: Sign = Sign.SIZE
    sense: DirectionMode | None = None
    measure: Measure = Measure.NUMBER
    is_size: bool = False
    about: bool = False
    analysis: Analysis = Analysis.MOTION


_CENTRE = "centre"


def _vector(word: str, order: int) -> KindFacts:
    unit = "m/s" if order == 1 else "m/s²"
    return KindFacts(
        word, (_ONE, _TWO), unit, order, word, part=word + "{}", sense=_ALONG,
        columns=(f".{word}x", f".{word}y"), measure=Measure.VECTOR, is_size=True,
    )  # fmt: skip


def _pair(word: str, order: int, letter: str, symbol: str, record: str = "") -> KindFacts:
    unit = "m/s" if order == 1 else "m/s²"
    return KindFacts(
        word, (_TWO,), unit, order, letter, symbol, record=record, sense=_ALONG, is_size=True
    )


def _rate(word: str, unit: str, order: int, symbol: str) -> KindFacts:
    columns = (f".{word}",)
    return KindFacts(
        word, (_OF,), unit, order, word, symbol, columns=columns, sign=Sign.TURN, sense=_TURN
    )


def _force(word: str, *forms: Form, unit: str = "N", **facts: Any) -> KindFacts:
    return KindFacts(word, forms, unit, analysis=Analysis.FORCES, **facts)


def _angle(word: str, form: Form) -> KindFacts:
    return _force(f"angle {word}", form, unit="deg", symbol="α", sign=Sign.ANGLE)


def _arm(word: str, form: Form) -> KindFacts:
    return _force(f"arm {word}", (*form, _POINT), unit="mm", symbol="h", about=True)


def _machine(word: str, unit: str, form: Form = ()) -> KindFacts:
    return KindFacts(f"machine {word}", (form,), unit, analysis=Analysis.MACHINE)


def _diagram(word: str, unit: str) -> KindFacts:
    return KindFacts(f"diagram {word}", ((),), unit, analysis=Analysis.CYCLE)


@unique
class QuantityKind(Enum):
    """Kind of a quantity (вид величины): how it is named, its unit, what measures it."""

    PLACE = KindFacts("", (_ONE,), "m", part="{}", columns=(".x", ".y"), measure=Measure.PLACE)
    VELOCITY = _vector("v", 1)
    ACCELERATION = _vector("a", 2)
    # Of two points of a link.
    NORMAL = KindFacts("an", (_TWO,), "m/s²", 2, "an", "a^{n}", sense=_ALONG)
    TANGENTIAL = KindFacts("at", (_TWO,), "m/s²", 2, "at", "a^{τ}", sense=_ALONG)
    # Of sliding in a pair: the relative velocity and acceleration are signed along the slide line.
    SLIDING = _pair("vs", 1, "v", "v")
    RELATIVE = _pair("ar", 2, "ar", "a^{r}", "a_rel")
    CORIOLIS = _pair("ak", 2, "ak", "a^{k}", "a_coriolis")
    DIRECTION = KindFacts(
        "phi", (_OF,), "deg", 0, "phi", "φ", columns=(".phi_deg",), sign=Sign.ANGLE,
        measure=Measure.ANGLE,
    )  # fmt: skip
    UNIT = KindFacts(  # the direction as a unit vector
        "", (_OF,), "1", 0, "u", columns=(".cos", ".sin"), measure=Measure.DIRECTION
    )
    OMEGA = _rate("omega", "1/s", 1, "ω")
    EPSILON = _rate("epsilon", "1/s²", 2, "ε")
    LENGTH = KindFacts("length", (_ENDS,), "mm", symbol="l")
    VELOCITY_SEGMENT = KindFacts("segment velocity", (_ENDS,), "mm", 1)
    ACCELERATION_SEGMENT = KindFacts("segment acceleration", (_ENDS,), "mm", 2)
    # Derivatives by the angle of the crank: of places, and of angles of links. Components are
    # those of the exact motion; no plan has them.
    TRANSFER = KindFacts("v_q", (_ONE,), "m", 1, "v_q", "v", part="{}1", is_size=True)
    TRANSFER_2 = KindFacts("a_q", (_ONE,), "m", 2, "a_q", "a", part="{}2", is_size=True)
    RATIO = KindFacts("u", (_OF, (_LINK, _LINK)), "1", 1, "u", sign=Sign.STRICT)
    RATIO_2 = KindFacts("epsilon_q", (_OF,), "1", 2, "epsilon_q", "ε", sign=Sign.STRICT)
    # Of the instant centre of two links, and velocities by the centres.
    CENTRE = KindFacts(
        "",
        (_ON_BY,),
        "m",
        symbol="P",
        part=_CENTRE + " {}",
        sign=Sign.STRICT,
        measure=Measure.PLACE,
    )
    CENTRE_DISTANCE = KindFacts("centre distance", ((*_ON_BY, _POINT),), "m", symbol="l")
    CENTRE_VELOCITY = KindFacts("centre v", (_ONE,), "m/s", 1, symbol="v", is_size=True)
    CENTRE_OMEGA = KindFacts("centre omega", (_OF,), "1/s", 1, symbol="ω", sign=Sign.TURN)
    TURN_BY_DRIVER = KindFacts("phi1", (_OF,), "1", 1, "phi1", sign=Sign.STRICT)
    TURN_BY_DRIVER_2 = KindFacts("phi2", (_OF,), "1", 2, "phi2", sign=Sign.STRICT)

    REACTION = _force(
        "F", _ON_BY, letter="F", part="F{}", columns=(".x", ".y", ""), sense=_ALONG,
        measure=Measure.VECTOR, is_size=True,
    )  # fmt: skip
    TANGENTIAL_REACTION = _force("Ft", (*_ON_BY, *_TWO), symbol="F^{τ}", sense=_ALONG)
    NORMAL_REACTION = _force("Fn", (*_ON_BY, *_TWO), symbol="F^{n}", sense=_ALONG)
    MOMENT = _force("M", _ON_BY, unit="N·m", letter="M", columns=("",), sense=_TURN)
    # On the driving slider, along its guide; in words it is ``balance``.
    THRUST = _force("", (), letter="F", columns=("",))
    WEIGHT = _force("weight", _OF, symbol="G", sense=_ALONG)
    INERTIA = _force("inertia", _OF, symbol="Φ", sense=_ALONG)
    INERTIA_COUPLE = _force("inertia couple", _OF, unit="N·m", symbol="M", sense=_TURN)
    SHIFT = _force("shift", _OF, unit="mm")
    LOAD = _force("load", _LOAD)
    REACTION_ANGLE = _angle("F", _ON_BY)
    INERTIA_ANGLE = _angle("inertia", _OF)
    LOAD_ANGLE = _angle("load", _LOAD)
    REACTION_ARM = _arm("F", _ON_BY)
    WEIGHT_ARM = _arm("weight", _OF)
    INERTIA_ARM = _arm("inertia", _OF)
    LOAD_ARM = _arm("load", _LOAD)
    # The moment or force on the driver, or the force at a point that does its work.
    BALANCE = _force("balance", (), _ONE, unit="", sign=Sign.TURN, sense=_ALONG)
    LEVER = _force("lever", (), _ONE, unit="", sign=Sign.TURN, sense=_ALONG)

    MACHINE_MOMENT = _machine("M", "N·m", _AT)
    MACHINE_INERTIA = _machine("J", "kg·m²", _AT)
    MACHINE_ENERGY = _machine("T", "J", _AT)
    LINK_ENERGY = _machine("energy", "J", (_LINK, NameRole.NUMBER))
    CONSTANT_MOMENT = _machine("constant", "N·m")
    MIDDLE_SPEED = _machine("omega", "1/s")
    IRREGULARITY = _machine("delta", "1")
    ANGLE_SCALE = _machine("mu_phi", "rad/mm")
    WORK_SCALE = _machine("mu_A", "J/mm")
    GREATEST_SLOPE = _machine("psi_max", "deg")
    LEAST_SLOPE = _machine("psi_min", "deg")
    CUT = _machine("KL", "mm")
    MERTSALOV_CUT = _machine("AB", "mm")
    FLYWHEEL = _machine("J_f", "kg·m²")
    WHEEL_DIAMETER = _machine("D", "m")
    WHEEL_MASS = _machine("m", "kg")
    WHEEL_WIDTH = _machine("b", "m")

    # Of the diagrams of the output over the cycle; a millimetre of a link's is in radians.
    DIAGRAM_LENGTH = _diagram("length", "mm")
    VELOCITY_POLE = _diagram("pole_v", "mm")
    ACCELERATION_POLE = _diagram("pole_a", "mm")
    TIME_SCALE = _diagram("mu_t", "s/mm")
    PATH_SCALE = _diagram("mu_s", "m/mm")
    RATE_SCALE = _diagram("mu_v", "m/(s·mm)")
    CHANGE_SCALE = _diagram("mu_a", "m/(s²·mm)")

    # Of the construction that the sizes follow from: the angle between the extreme positions.
    EXTREME_ANGLE = KindFacts("synthesis theta", ((),), "deg", analysis=Analysis.SYNTHESIS)

    # Of a problem that is computed without plans, by its own name there.
    COMPUTED = KindFacts("", (), "1")
    PICTURED = KindFacts("", (), "mm")

    def __init__(self, facts: KindFacts) -> None:
        self.word, self.forms = facts.word, facts.forms
        self.unit, self.order = facts.unit, facts.order
        self.written_unit = "" if facts.unit == "1" else facts.unit
        self.letter, self.part, self.columns = facts.letter, facts.part, facts.columns
        self.symbol = facts.symbol or facts.letter or facts.word
        self.record = facts.record or facts.letter
        self.sign, self.sense, self.measure = facts.sign, facts.sense, facts.measure
        self.is_size, self.about, self.analysis = facts.is_size, facts.about, facts.analysis
        self.is_force = facts.analysis is Analysis.FORCES
        self.is_number = facts.measure is Measure.NUMBER
        self.is_length_on_paper = facts.unit == "mm" and facts.analysis.is_of_position

    def label(self, of: str, axis: str = "") -> str:
        """Return the label of a quantity, or of a component: ``v_B``, ``vx_B``, ``x_B``, ``B``."""
        head = self.letter + axis
        return f"{head}_{of}" if head else of


TRANSFERS = (
    QuantityKind.TRANSFER,
    QuantityKind.RATIO,
    QuantityKind.TRANSFER_2,
    QuantityKind.RATIO_2,
)
"""Kinds of transfer functions, in the order in which tables have them."""

SLIDINGS = (QuantityKind.SLIDING, QuantityKind.CORIOLIS, QuantityKind.RELATIVE)
"""Kinds of quantities of two points that slide on each other."""

BY_DRIVER = (QuantityKind.TURN_BY_DRIVER, QuantityKind.TURN_BY_DRIVER_2)
"""Derivatives of angles by the coordinate of the driver, whatever it is (аналоги)."""

BALANCES = (QuantityKind.BALANCE, QuantityKind.LEVER)
TURNING = (QuantityKind.DIRECTION, QuantityKind.OMEGA, QuantityKind.EPSILON)
"""Kinds of quantities of links, in the order in which tables have them."""

OF_PLANS = tuple(kind for kind in TURNING if kind.is_number)
"""The kinds among them that the plans give."""

TURNINGS = tuple(kind for kind in OF_PLANS if kind.sense is _TURN)
"""The rates among those: a segment of a plan over the arm on which it was read."""

CENTRES = (
    QuantityKind.CENTRE,
    QuantityKind.CENTRE_DISTANCE,
    QuantityKind.CENTRE_VELOCITY,
    QuantityKind.CENTRE_OMEGA,
)
"""Kinds of quantities by instant centres (по мгновенным центрам)."""

POLE = "p"

_ABOUT = "about"


class QuantityKey(Struct, frozen=True):
    """Name of a quantity (имя величины), however it is spelled.

    Attributes
    ----------
    kind : QuantityKind
    names : tuple of str
        By the `NameRole` of each: of one of the forms of its kind. The pole of a plan is ``p``.
        Coincident points have the number of their link: ``B3`` is the point of link 3 under the
        pin B.
    axis : str
        ``x``, ``y`` of a component, else empty.
    over : QuantityKey or None
        Divisor of a quotient such as ``vx D / omega 1``.
    """

    kind: QuantityKind
    names: tuple[str, ...]
    axis: str = ""
    over: QuantityKey | None = None

    @property
    def word(self) -> str:
        """Name of its kind, or of a component, in words: ``v``, ``vx``, ``arm weight``."""
        return self.kind.part.format(self.axis) if self.axis else self.kind.word

    @property
    def words(self) -> str:
        """The quantity in words: ``arm weight 2 about C``."""
        names = list(self.names)
        if self.kind.about:
            names.insert(-1, _ABOUT)
        words = " ".join((self.word, *names))
        return words if self.over is None else f"{words} / {self.over.words}"

    @property
    def id(self) -> str:
        """What outputs call it: ``v_B3``, ``vs_B3_B``."""
        own = "_".join((*self.word.split(), *self.names))
        return own if self.over is None else f"{own}/{self.over.id}"

    @property
    def symbol(self) -> str:
        """Symbol in rich text: ``v_{B3}``."""
        if self.over is not None:
            return f"{self.dividend.symbol}/{self.over.symbol}"
        kind, names = self.kind, self.names
        letter = self.word if self.axis else kind.symbol
        if kind in (QuantityKind.VELOCITY_SEGMENT, QuantityKind.ACCELERATION_SEGMENT):
            return "".join(name.lower() for name in names)
        if kind in CENTRES:
            return self._symbol_by_centre
        if kind is QuantityKind.LOAD:
            return names[0]
        if kind is QuantityKind.INERTIA_COUPLE:
            return f"{letter}_{{Φ{names[0]}}}"
        if kind in TRANSFERS and kind is not QuantityKind.RATIO and not self.axis:
            return f"{letter}_{{q{names[0]}}}"
        apart = kind.about or (kind.is_force and kind.sign is Sign.ANGLE)
        together = not apart and all(len(name) < 3 for name in names)
        return f"{letter}_{{{('' if together else ',').join(names)}}}" if names else letter

    @property
    def _symbol_by_centre(self) -> str:
        """Symbol of a quantity by centres: ``x_{P13}``, ``P_{13}A``, ``v^{P}_{E}``."""
        kind, names = self.kind, self.names
        pair = ("" if all(len(name) == 1 for name in names[:2]) else ",").join(names[:2])
        if kind is QuantityKind.CENTRE:
            return f"{self.axis}_{{P{pair}}}"
        if kind is QuantityKind.CENTRE_DISTANCE:
            return f"P_{{{pair}}}{names[2]}"
        return f"{kind.symbol}^{{P}}_{{{names[0]}}}"

    def is_same(self, quantity_key: QuantityKey) -> bool:
        """Return whether another name is of the same quantity.

        Of two points that slide on each other either is the first; a ratio is to the crank if it
        does not say to which link.
        """
        names, names_there = self.names, quantity_key.names
        if self.kind in SLIDINGS:
            names, names_there = tuple(sorted(names)), tuple(sorted(names_there))
        elif self.kind is QuantityKind.RATIO:
            shorter = min(len(names), len(names_there))
            names, names_there = names[:shorter], names_there[:shorter]
        alike = QuantityKey(self.kind, names, self.axis, self.over)
        return alike == replace(quantity_key, names=names_there)

    def renamed(self, names: Mapping[str, str]) -> QuantityKey:
        """Return the quantity of points that a file calls otherwise: ``v L`` is ``v H2``."""
        own = tuple(
            names.get(name, name) if role in (_POINT, NameRole.PLAN_POINT) else name
            for name, role in self.roles
        )
        over = None if self.over is None else self.over.renamed(names)
        return replace(self, names=own, over=over)

    @property
    def dividend(self) -> QuantityKey:
        """The quantity without its divisor."""
        return QuantityKey(self.kind, self.names, self.axis)

    @property
    def sign(self) -> Sign:
        """Meaning of its sign."""
        if self.axis:
            return Sign.STRICT
        return Sign.SIZE if self.kind in BALANCES and self.names else self.kind.sign

    @property
    def is_angle(self) -> bool:
        """Whether it is measured with a protractor."""
        return self.kind.sign is Sign.ANGLE

    @property
    def is_analogue(self) -> bool:
        """Whether it is of the exact motion by the coordinate of the driver: no plan has it."""
        return self.kind in BY_DRIVER or (bool(self.axis) and self.kind in TRANSFERS)

    @property
    def has_segment(self) -> bool:
        """Whether a segment of a plan may represent it."""
        sense = self.kind.sense
        return not (sense is DirectionMode.TURN or self.is_angle or self.over is not None)

    @property
    def is_loaded(self) -> bool:
        """Whether it, or its divisor, needs the masses and loads: a force, or of a machine."""
        own = self.kind.analysis.needs_loads
        return own or (self.over is not None and self.over.is_loaded)

    @property
    def roles(self) -> list[tuple[str, NameRole]]:
        """Its names, and the role of each."""
        form = next(form for form in self.kind.forms if len(form) == len(self.names))
        return list(zip(self.names, form, strict=True))

    def unknown_names(
        self, points: Collection[str], links: Collection[str], loads: Collection[str] = ()
    ) -> list[str]:
        """Return its names that the mechanism does not have.

        Parameters
        ----------
        points : collection of str
            Points, coincident ones such as ``B3`` among them.
        loads : collection of str
            Letters of the external loads.
        """
        known: dict[NameRole, Collection[str]] = {
            NameRole.POINT: points,
            NameRole.PLAN_POINT: {*points, POLE},
            NameRole.LINK: links,
            NameRole.BODY: {*links, FRAME},
            NameRole.LOAD: loads,
        }
        found = [
            name
            for name, role in self.roles
            if (not name.isdecimal() if role is NameRole.NUMBER else name not in known[role])
        ]
        return found + (self.over.unknown_names(points, links, loads) if self.over else [])


class QuantityNameError(ValueError):
    """The name of a quantity cannot be read; the message has the reason."""


def _words() -> Iterator[tuple[str, tuple[QuantityKind, str]]]:
    """Yield the kinds and components by their words."""
    for kind in QuantityKind:
        if kind.word:
            yield kind.word, (kind, "")
        if kind.part:
            yield from ((kind.part.format(axis), (kind, axis)) for axis in "xy")


def _letters() -> Iterator[tuple[str, tuple[QuantityKind, str]]]:
    """Yield the kinds and components of one point or link by the beginnings of their labels."""
    for kind in QuantityKind:
        if kind.word and kind.letter and not kind.is_force and kind.forms[0] != _TWO:
            yield kind.letter, (kind, "")
        if kind.part and not kind.is_force and len(kind.forms[0]) == 1:
            yield from ((kind.letter + axis, (kind, axis)) for axis in "xy")


def _columns() -> Iterator[tuple[str, tuple[QuantityKind, str]]]:
    """Yield the kinds and components of one point or link by the endings of their columns."""
    for kind in QuantityKind:
        if kind.is_force or not (kind.word or kind.part):
            continue
        axes = "xy" if kind.part else ("",)
        yield from ((end, (kind, axis)) for end, axis in zip(kind.columns, axes, strict=False))
        if kind.part and kind.columns and kind.letter:
            yield f".{kind.letter}", (kind, "")


_REACTIONS = MappingProxyType(
    {kind.letter: kind for kind in (QuantityKind.REACTION, QuantityKind.MOMENT)}
)
_WORDS = MappingProxyType(dict(_words()))
_LETTERS = MappingProxyType(dict(_letters()))
_COLUMNS = MappingProxyType(dict(_columns()))
_PAIRED = frozenset(word.split()[0] for word in _WORDS if " " in word)
"""First words of the kinds that have two; ``inertia`` alone is a kind as well."""

# On link 2 from link 1, at their joint B.
_REACTION_RE = (
    r"(?P<letter>[FM])(?:(?<=F)(?P<axis>[xy]))?"
    r"_(?P<joint>[^_/]+)_(?P<on>[^_/]+)/(?P<by>[^_/]+)\Z"
)
_REACTION_COLUMN_RE = (
    r"(?P<letter>[FM])\.(?P<joint>[^.]+)\.(?P<on>[^.]+)-(?P<by>[^.]+?)(?:\.(?P<axis>[xy]))?\Z"
)
_BALANCE_RE = r"(?:[MF]_dr|driving\.(?:moment|force))\Z"
_LEVER_RE = r"(?:[MF]_lever|lever\.(?:moment|force))\Z"
# Of the centre of links 1 and 3: P_13.x; of links with longer names P_1,12.x.
_CENTRE_RE = r"P_(?P<pair>[^\W_]{2}|[^\W_]+,[^\W_]+)\.(?P<axis>[xy])\Z"
_COLUMN_RE = r"(?P<of>[^.]+)(?P<end>\.[^.]+)\Z"

Pairs = Mapping[str, tuple[str, ...]]
"""Points that slide on each other by the subject of their quantities, ``B3/2``: ``B3``, ``B``; on
the frame it is one point."""

_NO_PAIRS: Pairs = MappingProxyType({})


def parse_quantity(text: str, pairs: Pairs = _NO_PAIRS) -> QuantityKey:
    """Read the name of a quantity in any of its spellings.

    In words, ``v C B``, ``arm weight 2 about C``, which `_` may join; by its label, ``v_B3/2``,
    ``v_q_C``, ``u_21``, ``F_B_2/1``, ``M_dr``; as a column, ``B.vx``, ``2.omega``, ``F.B.2-1``,
    ``driving.moment``. Two of them may be divided.

    Parameters
    ----------
    pairs : mapping
        Of the mechanism; labels of sliding pairs need it. Along a guide of the frame a slider
        moves as its point does: ``v_E5/0`` is ``v E``.

    Examples
    --------
    >>> parse_quantity("F_B_2/1").words
    'F 2 1'
    >>> parse_quantity("arm weight 2 about C").names
    ('2', 'C')

    Raises
    ------
    QuantityNameError
    """
    text = " ".join(text.split())
    named = _of_column(text) or (None if " " in text else _of_label(text, pairs))
    if named is not None:
        return named
    return parse_words(text if " " in text else text.replace("_", " "))


def joint_of(text: str) -> str:
    """Return the joint that a label or a column of a reaction has; empty where there is none."""
    found = re.match(_REACTION_RE, text) or re.match(_REACTION_COLUMN_RE, text)
    return found["joint"] if found else ""


def parse_words(text: str) -> QuantityKey:
    """Read the name of a quantity in words, or two of them divided.

    Raises
    ------
    QuantityNameError
    """
    above, slash, below = text.partition("/")
    first = _of_words(above)
    if not slash:
        return first
    if "/" in below:
        raise QuantityNameError(translate("expected one division at most"))
    second = _of_words(below)
    if not (first.kind.analysis.is_of_position and second.kind.analysis.is_of_position):
        raise QuantityNameError(translate("quantities of the whole cycle cannot be divided"))
    return QuantityKey(first.kind, first.names, first.axis, second)


def _of_label(name: str, pairs: Pairs) -> QuantityKey | None:
    """Return the quantity of a label; None for other texts."""
    if found := re.match(_REACTION_RE, name):
        on_by = (found["on"], found["by"])
        return QuantityKey(_REACTIONS[found["letter"]], on_by, found["axis"] or "")
    head, _, rest = name.partition("_")
    if head == QuantityKind.LOAD.word and rest:
        return QuantityKey(QuantityKind.LOAD, (indexed(rest),))  # its letter may have an index
    head, _, rest = name.rpartition("_")
    if pair := pairs.get(rest):
        return _of_pair(head, pair)
    if head not in _LETTERS or not rest:
        return None
    kind, axis = _LETTERS[head]
    if kind is not QuantityKind.RATIO and "/" in rest:
        return None
    if kind is QuantityKind.RATIO:
        return QuantityKey(kind, tuple(rest.split("/") if "/" in rest else rest))
    return QuantityKey(kind, (rest,), axis)


def _of_pair(letter: str, pair: tuple[str, ...]) -> QuantityKey | None:
    """Return a quantity of two points that slide on each other; on the frame, of the one point."""
    for kind in SLIDINGS:
        if kind.letter == letter and len(pair) == 2:
            return QuantityKey(kind, pair)
    on_frame = {
        QuantityKind.SLIDING.letter: QuantityKind.VELOCITY,
        QuantityKind.RELATIVE.letter: QuantityKind.ACCELERATION,
    }
    return QuantityKey(on_frame[letter], pair) if letter in on_frame else None


def _of_column(name: str) -> QuantityKey | None:
    """Return the quantity of a column, or of a balancing load by its label; None for others."""
    if re.match(_BALANCE_RE, name):
        return QuantityKey(QuantityKind.BALANCE, ())
    if re.match(_LEVER_RE, name):
        return QuantityKey(QuantityKind.LEVER, ())
    if found := re.match(_REACTION_COLUMN_RE, name):
        kind = _REACTIONS[found["letter"]]
        axis = found["axis"] if kind.part else ""
        return QuantityKey(kind, (found["on"], found["by"]), axis or "")
    if found := re.match(_CENTRE_RE, name):
        pair = found["pair"].split(",") if "," in found["pair"] else found["pair"]
        return QuantityKey(QuantityKind.CENTRE, tuple(pair), found["axis"])
    found = re.match(_COLUMN_RE, name)
    if found is None or found["end"] not in _COLUMNS:
        return None
    kind, axis = _COLUMNS[found["end"]]
    return QuantityKey(kind, (found["of"],), axis)


def _of_words(text: str) -> QuantityKey:
    words = text.split()
    if not words:
        raise QuantityNameError(translate('expected a quantity such as "v C", got an empty text'))
    (kind, axis), word, names = _kind(words)
    if kind.about:
        if names[-2:-1] != [_ABOUT]:
            raise QuantityNameError(translate("'{}' must end with '{}' and a point", word, _ABOUT))
        del names[-2]
    counts = [len(form) for form in (kind.forms[:1] if axis else kind.forms)]
    if len(names) not in counts:
        wanted = translate(" or ").join(map(str, counts))
        message = "'{0}' takes {1} name{2:||s}, got {3}"
        some = 1 if wanted == "1" else 2
        raise QuantityNameError(translate(message, word, wanted, some, len(names)))
    roles = QuantityKey(kind, tuple(names)).roles
    if len(set(roles)) < len(roles):
        raise QuantityNameError(translate("'{}' needs two different names", word))
    given = (indexed(name) if role is NameRole.LOAD else name for name, role in roles)
    return QuantityKey(kind, tuple(given), axis)


def _kind(words: list[str]) -> tuple[tuple[QuantityKind, str], str, list[str]]:
    """Split the words of a quantity into its kind, of one word or two, and its names."""
    first = words[0]
    for size in (2, 1) if first in _PAIRED else (1,):
        word = " ".join(words[:size])
        if word in _WORDS:
            return _WORDS[word], word, words[size:]
    unknown = " ".join(words[:2]) if first in _PAIRED else first
    guess = nearest_name(unknown, list(_WORDS))
    tail = translate(" (the nearest is '{}')", guess) if guess else ""
    raise QuantityNameError(translate("unknown quantity '{}'{}", short(unknown), tail))
