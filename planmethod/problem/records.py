"""Plain records common to all problem files, and of checked masses and loads (SI units)."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from enum import Enum
from types import MappingProxyType
from typing import (
    TYPE_CHECKING,
    Annotated,
    ClassVar,
    NamedTuple,
    Protocol,
    TypeAlias,
    assert_never,
)

from msgspec import Struct, field
from msgspec.structs import asdict, replace

from planmethod.languages import LANGUAGES
from planmethod.problem.tables import (
    AngleKey,
    ChoiceKey,
    CustomKey,
    FlagKey,
    IntegerKey,
    NumberKey,
    TextKey,
    WordKey,
)

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile


STAMP_LIMIT = 200

TITLE_BLOCK: Mapping[str, str] = MappingProxyType(
    {
        "organisation": "организация, first line: graph 9 (forms 1, 2)",
        "department": "кафедра, second line: graph 9 (forms 1, 2)",
        "group": "группа, third line: graph 9 (forms 1, 2)",
        "author": (
            "surname in the row Разраб.: graph 11 (forms 1, 2); "
            "also the author in the properties of the files"
        ),
        "checker": "surname in the row Пров.: graph 11 (forms 1, 2)",
        "t_control": "surname in the row Т.контр.: graph 11 (form 1)",
        "norm_control": "surname in the row Н.контр.: graph 11 (forms 1, 2)",
        "approver": "surname in the row Утв.: graph 11 (forms 1, 2)",
        "extra": "surname in the free row: graph 11 (forms 1, 2)",
        "extra_role": "what the free row is for, such as Конс.: graph 10 (forms 1, 2)",
        "designation": "обозначение: graphs 2, 26 (forms 1, 2, 2a)",
        "title": "наименование: graph 1 (forms 1, 2); default: the title of the problem",
        "material": "материал; in coursework the subject: graph 3 (form 1)",
        "subject": "another name of `material`: graph 3 (form 1)",
        "letter": "Лит., up to three letters: graph 4 (forms 1, 2)",
        "mass": "Масса: graph 5 (form 1)",
        "scale": "Масштаб: graph 6 (form 1)",
        "sheet": "Лист: graph 7 (forms 1, 2, 2a); computed if there are several sheets",
        "sheets": "Листов: graph 8 (forms 1, 2); computed, on the first sheet only",
        "date": "another name of `author_date`: graph 13 (forms 1, 2)",
        "author_date": "Дата beside the author: graph 13 (forms 1, 2)",
        "checker_date": "Дата beside the checker: graph 13 (forms 1, 2)",
        "t_control_date": "Дата in the row Т.контр.: graph 13 (form 1)",
        "norm_control_date": "Дата in the row Н.контр.: graph 13 (forms 1, 2)",
        "approver_date": "Дата in the row Утв.: graph 13 (forms 1, 2)",
        "extra_date": "Дата in the free row: graph 13 (forms 1, 2)",
        "inventory": "Инв. № подл.: graph 19 (side columns)",
        "inventory_instead": "Взам. инв. №: graph 21 (side columns)",
        "inventory_copy": "Инв. № дубл.: graph 22 (side columns)",
        "reference": "Справ. №: graph 24 (side columns of the first sheet)",
        "first_use": "Перв. примен.: graph 25 (side columns of the first sheet)",
        "city": "city on the title page of the note",
        "year": "year on the title page of the note; by default that of `author_date`",
    }
)
"""Fields of ``[stamp]``, optional texts, with the graph and the forms that show each."""

TITLE_BLOCK_IN: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(LANGUAGES, "a table of these fields for sheets in this language, over the others")
)
"""Tables of ``[stamp]``: texts that a language has instead (надпись на языке листа)."""

TITLE_FORMS = ("1", "1+2a", "2", "2a")
"""Forms of the title block: of every sheet, or of the first and of the later ones."""

LETTERINGS = ("A", "A-upright", "B", "B-upright")
"""Types of the lettering of GOST 2.304, slanted by default."""


class Published(Struct, frozen=True):
    """One value that the source prints (напечатанное значение)."""

    name: str
    value: Annotated[float, NumberKey("the printed number", low=-1e12, high=1e12, required=True)]
    unit: Annotated[str, TextKey("its unit, as text", 1000)] = ""
    per_mm: Annotated[
        float | None,
        NumberKey(
            "scale of its plan, unit per millimetre: the difference is then shown in millimetres "
            "of the plan",
            "a scale, unit per millimetre,", low=1e-12, high=1e12, positive=True,
        ),
    ] = None  # fmt: skip
    what: Annotated[
        str,
        TextKey("its quantity, see below; if omitted, the value is listed but not compared", 1000),
    ] = ""
    note: Annotated[str, TextKey("a remark, for instance why the source is wrong", 1000)] = ""
    position: Annotated[
        int | None,
        CustomKey("which position of the driver, counted from 0; absent when there is one"),
    ] = None


class AnswerForm(Enum):
    """Form of an answer (вид ответа)."""

    VALUE = "value"
    MM = "mm"  # millimetres of the student's own plan
    BOTH = "both"  # either is accepted


class DirectionMode(Enum):
    """Form in which the sense of an answer is required (направление)."""

    TURN = "turn"  # ↺ or ↻
    DIRECTION = "direction"  # left, right, up or down
    ANGLE = "angle"  # degrees from +x


class QuestionSpec(Struct, frozen=True):
    """Question to students (вопрос); ``what`` is in the words of ``[published]``."""

    id: Annotated[
        str,
        CustomKey(
            "what outputs call the answer, each its own: a letter first, then letters, digits and "
            "`_ . / @ ' -`, at most 40. When absent, `what` with `_` for spaces: `v_B3`, `an_E_D`; "
            "with a `position` also that: `v_B3@4`"
        ),
    ]
    what: Annotated[
        str,
        CustomKey(
            "the quantity",
            more=". The words of `[published]`, or a name as `--ask` has it: `v_B3`, "
            "`omega_3`, `v_B3/2` for `vs B3 B`, `ak_B3/2`, `v_q_C`, `u_21` for `u 2 1`, "
            "`F_B_2/1` for `F 2 1`, `M_dr` for `balance`. Words may be "
            "joined by `_` as well: `an_E_D`",
            required=True,
            missing='Name the quantity: what = "v B".',
        ),
    ]
    letters: Annotated[
        tuple[str, ...],
        CustomKey(
            "how the department writes it, a string or up to 10: keys and forms print the first, "
            "columns of a group's table are known by any. In one position no two answers share "
            "one"
        ),
    ] = ()
    unit: Annotated[
        str,
        TextKey(
            'unit of the answer, `"мм/с"`, `"об/мин"`: a number without a unit is in it, '
            "keys, pages and the list of a form show it",
            20,
            absent="SI",
        ),
    ] = ""
    points: Annotated[
        float,
        NumberKey(
            "points of a right answer", "a number of points", low=0.0, high=1000.0,
            hint="These are the points of a right answer.",
        ),
    ] = 1.0  # fmt: skip
    form: Annotated[
        AnswerForm,
        WordKey(
            '`"value"`; `"mm"`, the length on the student\'s own plan; `"both"`, either is taken'
        ),
    ] = AnswerForm.BOTH
    sense: Annotated[
        DirectionMode | None,
        CustomKey(
            '`true`: the sense is required, for ω, ε and moments as a turn (`"turn"`), for '
            'vectors as left, right, up, down (`"direction"`); `"angle"`: the direction of '
            "a vector in degrees from +x is an answer of its own, `angle_v_B3`, with the "
            "score of a sense; default: `false`"
        ),
    ] = None
    position: Annotated[
        int | None,
        CustomKey("which position of the driver, counted from 0; absent when there is one"),
    ] = None
    digits: Annotated[int | None, IntegerKey("required significant digits", 1, 8)] = None
    segment: Annotated[
        str,
        CustomKey(
            'letters of its segment on the plan, `"p b3"`, where it is another than that of the '
            "quantity"
        ),
    ] = ""
    tolerance: Annotated[
        float | None,
        NumberKey(
            "the department's own for this answer",
            "a tolerance", "percent", 0.1, 100.0,
            hint="Write 5 for 5 % of the value.", more=", of the value",
        ),
    ] = None  # fmt: skip


NOTATIONS = ("p5 p4", "p1 p2", "pn pv")
"""Letters of the numbers of lower and higher pairs; languages have words for the last one."""


class SheetSettings(Struct, frozen=True):
    """Settings of the sheets (оформление листов): ``[sheet]``; None: not given."""

    paper: Annotated[
        str | None,
        CustomKey(
            'format: `"A4"` to `"A0"`, elongated ones to `"A4x9"`, `"A3x7"`, `"A2x5"`, `"A1x4"`, '
            '`"A0x3"`; A4 is portrait, the others are landscape: `"A3:portrait"`',
            absent="the first on which all fits",
        ),
    ] = None
    form: Annotated[
        str | None,
        ChoiceKey(
            'form of the title block: `"1"`, every sheet; `"1+2a"`, later sheets form 2a; `"2"`, a '
            'text document, later sheets form 2a; `"2a"`, sheets that continue a document',
            TITLE_FORMS,
            absent="1",
        ),
    ] = None
    graph_26: Annotated[
        bool | None,
        FlagKey("graph 26, the designation in the upper corner, rotated", absent="with form 1"),
    ] = None
    graphs_27_30: Annotated[
        bool | None, FlagKey("graphs 27 to 30, a customer's marks", absent="`false`")
    ] = None
    side_columns: Annotated[
        bool | None,
        FlagKey(
            "graphs 19 to 23 in the binding margin, on the first sheet 24 and 25 too",
            absent="`false`",
        ),
    ] = None
    lettering: Annotated[
        str | None,
        ChoiceKey(
            'type of the letters of GOST 2.304, slanted: `"A"`, `"B"`, or `"A-upright"`, '
            '`"B-upright"`',
            LETTERINGS,
            absent="B",
        ),
    ] = None
    lang: Annotated[str | None, CustomKey('language of the sheets: `"ru"` or `"en"`')] = None
    notation: Annotated[
        str | None,
        ChoiceKey(
            'letters of the numbers of lower and higher pairs: `"p5 p4"`, `"p1 p2"` or `"pn pv"` '
            "(p_н, p_в)",
            NOTATIONS,
            absent="in Russian `pn pv`, in English `p1 p2`",
        ),
    ] = None
    traces: Annotated[
        bool | None,
        FlagKey(
            "traces of the construction (следы построения)",
            absent="on a sheet of one position, if they fit",
        ),
    ] = None

    def over(self, lower: SheetSettings) -> SheetSettings:
        """Return these settings, with those of ``lower`` for missing ones."""
        given = {name: value for name, value in asdict(self).items() if value is not None}
        return replace(lower, **given)


SEVERAL = "one of several"
"""Value of ``reading`` for a scheme that is one of several matching the data of a lost figure."""


class KindProblem(Struct, frozen=True, kw_only=True):
    """Data of a problem of any kind (задача).

    Attributes
    ----------
    name : str
        Stem of the file.
    source_file : str
        The file as it was given, for messages; the name where there is none.
    reading : str
        `SEVERAL`, or empty where the scheme is that of the task.
    other_readings : tuple of str
        What else the figure may have been (другие прочтения рисунка).
    stamp : mapping of str to str
        Texts of the title block.
    stamp_in : mapping of str to mapping
        Those that a language has instead, by its name.
    answers : tuple of QuestionSpec
        Questions to students, in the order of the file; empty where it has none.
    variants : tuple of str
        Names of the variants that the file has.
    variant : str or None
        Which of them it is; None for the main part.
    """

    name: str
    source_file: str = ""
    title: str = ""
    source: str = ""
    reading: str = ""
    other_readings: tuple[str, ...] = ()
    stamp: Mapping[str, str] = field(default_factory=dict)
    stamp_in: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    sheet: SheetSettings = SheetSettings()
    published: tuple[Published, ...] = ()
    answers: tuple[QuestionSpec, ...] = ()
    variants: tuple[str, ...] = ()
    variant: str | None = None

    @property
    def title_block(self) -> Mapping[str, str]:
        """Texts of the title block in the language of the sheets (основная надпись)."""
        return {**self.stamp, **self.stamp_in.get(self.sheet.lang or LANGUAGES[0], {})}


def reading_record(problem: KindProblem) -> dict[str, object]:
    """Return the record entries on a lost figure's readings; empty if the figure exists."""
    if not problem.reading:
        return {}
    return {"reading": problem.reading, "other_readings": list(problem.other_readings)}


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


LoadSize: TypeAlias = float | SizeTable
"""Size of a load: the same in every position, or a table."""


def largest_size(size: LoadSize) -> float:
    """Return the size of a load, N or N·m, where it is largest, with its sign."""
    match size:
        case SizeTable():
            return max(size.values, key=abs)
        case int() | float():
            return size
        case _:
            assert_never(size)


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
    force: Annotated[LoadSize, CustomKey("force, N: a number or a table")] = 0.0
    couple: Annotated[
        LoadSize,
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
    path : str
        Its place in the file, ``loads[2]``; empty where it is from no file.
    """

    unit: ClassVar[str] = "N"
    key: ClassVar[str] = "force"

    name: str
    link: str
    at: str
    size: LoadSize
    sense: Fixed | Against
    phase: Phase | None = None
    path: str = ""


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
    path : str
        Its place in the file, ``loads[2]``; empty where it is from no file.
    """

    unit: ClassVar[str] = "N·m"
    key: ClassVar[str] = "couple"

    name: str
    link: str
    size: LoadSize
    sense: Against | None = None
    phase: Phase | None = None
    path: str = ""


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
        float | None, NumberKey("radius of the pin of a revolute joint", "a radius", "m", 0.0, 10.0)
    ] = None


class FrictionTask(Struct, frozen=True):
    """Data of ``[friction]`` (трение в кинематических парах)."""

    f: Annotated[
        float,
        NumberKey(
            "coefficient of prismatic joints (f)", "a coefficient", "", 0.0, 10.0, hint=_LIKE
        ),
    ] = 0.0
    f_pin: Annotated[
        float,
        NumberKey(
            "reduced coefficient of revolute joints (приведённый коэффициент f′)",
            "a coefficient", "", 0.0, 10.0, hint=_LIKE,
        ),
    ] = 0.0  # fmt: skip
    radius: Annotated[
        float, NumberKey("radius of the pins (радиус цапф)", "a radius", "m", 0.0, 10.0)
    ] = 0.0
    pairs: Annotated[
        Mapping[str, PairFriction],
        CustomKey(
            "a table for each joint with other values, named by its point and its two links: "
            '`"B 3-0" = { f = 0.2 }`, a prismatic joint by its pin, the frame is 0'
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
            "that can be drawn ([Forces](../how-to/forces.md))"
        ),
    ] = False
    friction: FrictionTask | None = None
    bearings: Mapping[str, BearingSection] = field(default_factory=dict)


QuantityReader = Callable[[str, int], float | None]
"""Value of a quantity by its name and position; None where it has none."""


class AnswerValue(Struct, frozen=True):
    """Correct value of an answer (величина).

    Attributes
    ----------
    symbol : str
        Rich text.
    unit : str
        SI, also ``1/min``, ``mm``; empty where it has none.
    value : float
    signed : bool
        Whether the sign belongs to the number.
    turns : bool
        Whether it has a sense of turning.
    is_integer : bool
        A count: nothing but the number itself is right.
    """

    symbol: str
    unit: str
    value: float
    signed: bool = True
    turns: bool = False
    is_integer: bool = False


class Mistaken(NamedTuple):
    """A mistake by its code, where it is made, and what all quantities then are."""

    code: str
    position_note: str
    read: QuantityReader


class QuestionQuantities(Protocol):
    """Quantities of a computed problem for questions.

    Attributes
    ----------
    names : tuple of str
        Questions of a file without ``[[answers]]``.
    count : int
        Number of positions.
    """

    names: tuple[str, ...]
    count: int

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity; None if it is unknown or has no value."""

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of its reading."""

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes."""

    def derive_values(self, name: str, answers: Mapping[str, float]) -> Iterator[tuple[float, str]]:
        """Yield values of a quantity from other answers of the same position, with their names."""
