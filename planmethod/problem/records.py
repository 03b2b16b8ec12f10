"""Plain records common to all problem files, and of checked masses and loads (SI units)."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from enum import Enum
from types import MappingProxyType
from typing import (
    TYPE_CHECKING,
    Annotated,
    ClassVar,
    NamedTuple,
    Protocol,
    TypeAlias,
    TypeVar,
    assert_never,
)

from msgspec import Struct, field
from msgspec.structs import asdict, replace

from planmethod.languages import LANGUAGES
from planmethod.problem.names import indexed
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
        "organisation": "organisation, first line of graph 9 (forms 1, 2): организация",
        "department": "department, second line of graph 9 (forms 1, 2): кафедра",
        "group": "student group, third line of graph 9 (forms 1, 2): группа",
        "author": (
            "surname of the author (Разраб.), graph 11 (forms 1, 2); also the author in the "
            "properties of the files"
        ),
        "checker": "surname of the person who checks the sheet (Пров.), graph 11 (forms 1, 2)",
        "t_control": "surname for the technological control (Т.контр.), graph 11 (form 1)",
        "norm_control": "surname for the drawing-standards check (Н.контр.), graph 11 (forms 1, 2)",
        "approver": "surname of the person who approves the sheet (Утв.), graph 11 (forms 1, 2)",
        "extra": "surname in the free row, graph 11 (forms 1, 2)",
        "extra_role": "role in the free row, graph 10 (forms 1, 2): `Конс.`",
        "designation": (
            "designation of the document (обозначение), graphs 2, 26 (forms 1, 2, 2a): "
            "`ТММ.КП.12.03.00.000`"
        ),
        "title": (
            "name of the sheet (наименование), graph 1 (forms 1, 2). Default: the title of "
            "the problem"
        ),
        "material": "material, graph 3 (form 1); in coursework the subject",
        "subject": "another name of `material`: graph 3 (form 1)",
        "letter": (
            "letter of the document (литера), graph 4 (forms 1, 2): at most three letters, `У`"
        ),
        "mass": "mass (масса), graph 5 (form 1)",
        "scale": "scale (масштаб), graph 6 (form 1): `1:2`",
        "sheet": (
            "number of the sheet (лист), graph 7 (forms 1, 2, 2a). Default: counted, if "
            "there are several sheets"
        ),
        "sheets": (
            "number of sheets (листов), graph 8 (forms 1, 2), on the first sheet only. "
            "Default: counted"
        ),
        "date": "another name of `author_date`: graph 13 (forms 1, 2)",
        "author_date": "date in the row of the author, graph 13 (forms 1, 2)",
        "checker_date": "date in the row Пров., graph 13 (forms 1, 2)",
        "t_control_date": "date in the row Т.контр., graph 13 (form 1)",
        "norm_control_date": "date in the row Н.контр., graph 13 (forms 1, 2)",
        "approver_date": "date in the row Утв., graph 13 (forms 1, 2)",
        "extra_date": "date in the free row, graph 13 (forms 1, 2)",
        "inventory": "Инв. № подл., graph 19 (side columns)",
        "inventory_instead": "Взам. инв. №, graph 21 (side columns)",
        "inventory_copy": "Инв. № дубл., graph 22 (side columns)",
        "reference": "Справ. №, graph 24 (side columns of the first sheet)",
        "first_use": "Перв. примен., graph 25 (side columns of the first sheet)",
        "city": "city on the title page of the note",
        "year": (
            "year on the title page of the note. Default: that of `author_date`, never the "
            "current year"
        ),
    }
)
"""Fields of ``[stamp]``, optional texts, with the graph and the forms that show each."""

TITLE_BLOCK_IN: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(LANGUAGES, "the same fields for sheets in this language; they replace the others")
)
"""Tables of ``[stamp]``: texts that a language has instead (надпись на языке листа)."""

TITLE_FORMS = ("1", "1+2a", "2", "2a")
"""Forms of the title block: of every sheet, or of the first and of the later ones."""

LETTERINGS = ("A", "A-upright", "B", "B-upright")
"""Types of the lettering of GOST 2.304, slanted by default."""


class Published(Struct, frozen=True):
    """One value that the source prints (напечатанное значение)."""

    name: str
    value: Annotated[float, NumberKey("printed number", low=-1e12, high=1e12, required=True)]
    unit: Annotated[
        str,
        TextKey(
            'unit of the number, as text. `"рад"` gives angles in radians, `"м"` true lengths', 1000
        ),
    ] = ""
    per_mm: Annotated[
        float | None,
        NumberKey(
            "scale of the plan that the source read the value from, units per millimetre. The "
            "difference is then shown in millimetres of the plan",
            "a scale, unit per millimetre,", low=1e-12, high=1e12, positive=True,
        ),
    ] = None  # fmt: skip
    what: Annotated[
        str,
        TextKey(
            'quantity, for example `"v B3"` or `"omega 3"`. Without `what` a value is listed but '
            "not compared",
            1000,
        ),
    ] = ""
    note: Annotated[str, TextKey("remark, for example why the source is wrong", 1000)] = ""
    position: Annotated[
        int | None,
        CustomKey("number of the position, from 0. Required if the file has several positions"),
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
            "name of the answer in all outputs, unique in the file: a letter, then letters, "
            "digits and `_ . / @ ' -`, at most 40 characters",
            absent="`what` with `_` for spaces, `v_B3`; with a `position` its number, `v_B3@4`",
        ),
    ]
    what: Annotated[
        str,
        CustomKey(
            'quantity: as in `[published]` (`"v B3"`, `"vs B3 B"`, `"u 2 1"`) or as a name for '
            "`--ask` (`v_B3`, `v_B3/2`, `u_21`, `F_B_2/1`, `M_dr`). In a file with `[gears]` it "
            "is a name for `ask`, with `[point]` one of `[published]`",
            required=True,
            missing='Name the quantity: what = "v B".',
        ),
    ]
    letters: Annotated[
        tuple[str, ...],
        CustomKey(
            "symbol that the department uses, or up to 10 of them. Keys and forms print the first "
            "one; the columns of a group's table may have any. In one position two answers cannot "
            "have the same symbol"
        ),
    ] = ()
    unit: Annotated[
        str,
        TextKey(
            'unit of the answer, `"мм/с"` or `"об/мин"`. A number without a unit is read in this '
            "unit",
            20,
            absent="the SI unit",
        ),
    ] = ""
    points: Annotated[
        float,
        NumberKey(
            "score for a right answer",
            "a number of points", low=0.0, high=1000.0,
            hint="These are the points of a right answer.",
        ),
    ] = 1.0  # fmt: skip
    form: Annotated[
        AnswerForm,
        WordKey(
            'form of the answer: `"value"`, a number with its unit; `"mm"`, the length of the '
            'segment on the student\'s plan; `"both"`, either of them'
        ),
    ] = AnswerForm.BOTH
    sense: Annotated[
        DirectionMode | None,
        CustomKey(
            '`true`: the sense is required, as a rotation for ω, ε and moments (`"turn"`), as '
            'left, right, up or down for vectors (`"direction"`). `"angle"`: the direction of a '
            "vector in degrees from the x axis is a separate answer, `angle_v_B3`",
            absent="`false`",
        ),
    ] = None
    position: Annotated[
        int | None,
        CustomKey(
            "number of the position (with `[point]`, of the moment), from 0. Required if the file "
            "has several positions"
        ),
    ] = None
    digits: Annotated[int | None, IntegerKey("required number of significant digits", 1, 8)] = None
    segment: Annotated[
        str,
        CustomKey(
            'letters of the segment on the plan, `"p b3"`, if they differ from those of the '
            "quantity"
        ),
    ] = ""
    tolerance: Annotated[
        float | None,
        NumberKey(
            "tolerance of the department for this answer, in per cent of the value",
            "a tolerance", "percent", 0.1, 100.0, hint="Write 5 for 5 % of the value.",
        ),
    ] = None  # fmt: skip


NOTATIONS = ("p5 p4", "p1 p2", "pn pv")
"""Letters of the numbers of lower and higher pairs; languages have words for the last one."""


class SheetSettings(Struct, frozen=True):
    """Settings of the sheets (оформление листов): ``[sheet]``; None: not given."""

    paper: Annotated[
        str | None,
        CustomKey(
            'paper format: `"A4"` to `"A0"`, elongated ones up to `"A4x9"`, `"A3x7"`, `"A2x5"`, '
            '`"A1x4"`, `"A0x3"`. A4 is portrait, the others are landscape; `"A3:portrait"` turns '
            "one",
            absent="the first format on which everything fits",
        ),
    ] = None
    form: Annotated[
        str | None,
        ChoiceKey(
            'form of the title block: `"1"` on every sheet; `"1+2a"`, form 2a on later sheets; '
            '`"2"`, a text document with form 2a on later sheets; `"2a"`, sheets that continue a '
            "document",
            TITLE_FORMS,
            absent='`"1"`',
        ),
    ] = None
    graph_26: Annotated[
        bool | None,
        FlagKey("draw graph 26, the rotated designation in the upper corner", absent="with form 1"),
    ] = None
    graphs_27_30: Annotated[
        bool | None,
        FlagKey("draw graphs 27 to 30, for the marks of a customer", absent="`false`"),
    ] = None
    side_columns: Annotated[
        bool | None,
        FlagKey(
            "draw graphs 19 to 23 in the binding margin, on the first sheet also 24 and 25",
            absent="`false`",
        ),
    ] = None
    lettering: Annotated[
        str | None,
        ChoiceKey(
            'lettering by GOST 2.304: type A or B, slanted (`"A"`, `"B"`) or upright '
            '(`"A-upright"`, `"B-upright"`)',
            LETTERINGS,
            absent='`"B"`',
        ),
    ] = None
    colour: Annotated[
        bool | None,
        FlagKey(
            "lines in the colours of their meanings, for the screen: absolute vectors blue, "
            "relative ones red, components green, construction grey",
            absent="`false`",
        ),
    ] = None
    lang: Annotated[str | None, CustomKey('language of the sheets: `"ru"` or `"en"`')] = None
    notation: Annotated[
        str | None,
        ChoiceKey(
            'symbols for the numbers of lower and higher pairs: `"p5 p4"`, `"p1 p2"` or `"pn pv"` '
            "(p_н, p_в)",
            NOTATIONS,
            absent='`"pn pv"` on Russian sheets, `"p1 p2"` on English ones',
        ),
    ] = None
    directions: Annotated[
        bool | None,
        FlagKey(
            "every vector of an equation has its direction under it where that is known, also "
            "v_B and v_C; otherwise only the components have it",
            absent="`false`",
        ),
    ] = None
    joint_equations: Annotated[
        bool | None,
        FlagKey(
            "one equation of both expressions of a vector, "
            "`a_n_CD + a_t_CD = a_B + a_n_CB + a_t_CB`; otherwise two equations",
            absent="`false`",
        ),
    ] = None
    equation_numbers: Annotated[
        bool | None,
        FlagKey(
            "number the equations of velocities, accelerations and forces through, (1), (2) …; "
            "texts refer to the numbers",
            absent="`false`",
        ),
    ] = None
    traces: Annotated[
        bool | None,
        FlagKey(
            "draw the construction lines (следы построения)",
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


K = TypeVar("K", bound=KindProblem)


def in_language(problem: K, lang: str) -> K:
    """Return a problem whose sheets are in a language."""
    return replace(problem, sheet=replace(problem.sheet, lang=lang))


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
            "centre of mass (центр масс): a point of the link. Required with a mass, unless the "
            "link has only one point"
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


class Spring(Struct, frozen=True):
    """Spring, gas strut or damper without mass (пружина, газовая пружина, демпфер).

    Between two points it is straight and its force positive where it pushes them apart; at a
    ``joint`` it is a torsion spring and its moment positive where it turns the second link
    counter-clockwise from the first one. The size is ``preload - stiffness·(l - l₀) -
    damping·dl/dt`` of the length l, or of the angle, rad. With a preload l₀ is that of the first
    position.

    Attributes
    ----------
    points : tuple of str or complex
        Names, or coordinates of a point of the frame, m; empty of a torsion spring.
    length : float or None, m
    angle : float or None, degrees
    stops : tuple of float, or None
        Least and greatest length, m, or angle, degrees.
    path : str
        Its place in the file, ``springs[0]``.
    """

    name: Annotated[
        str,
        CustomKey(
            "symbol of its force or moment on the sheets: `F_{c}`; if both links move, the force "
            "on the second one is `F_{c}'`",
            absent="`F_{s1}`, `F_{s2}`, … for springs, `M_{s1}`, … for torsion springs",
        ),
    ]
    links: Annotated[
        tuple[str, str],
        CustomKey('two links that it joins: `["3", "0"]`; `"0"` is the frame', required=True),
    ]
    points: Annotated[
        tuple[str | complex, ...],
        CustomKey(
            'ends: a point of each link, `["P", "S"]`. On the frame also coordinates: '
            '`["P", [0.1, -0.15]]`. Not allowed for a torsion spring'
        ),
    ] = ()
    joint: Annotated[
        str | None,
        CustomKey("torsion spring: common point of both links; instead of `points`"),
    ] = None
    stiffness: Annotated[
        float,
        NumberKey("stiffness (жёсткость), N/m, or N·m/rad of a torsion spring", "a stiffness",
                  "", 0.0, 1e12),
    ] = 0.0  # fmt: skip
    length: Annotated[
        float | None,
        CustomKey(
            "free length (длина в свободном состоянии), m. Required with `stiffness`, unless "
            "`preload` is given"
        ),
    ] = None
    angle: Annotated[
        float | None,
        AngleKey(
            "torsion spring: angle from the axis of the first link to that of the second at which "
            "the spring is at rest. Required with `stiffness`, unless `preload` is given"
        ),
    ] = None
    preload: Annotated[
        float | None,
        NumberKey(
            "force, N, or moment, N·m, of the spring in the first position of the file "
            "(предварительное усилие), instead of `length` or `angle`; positive if it pushes the "
            "ends apart. Without `stiffness` it is constant",
            "a preload", "", -1e12, 1e12,
        ),
    ] = None  # fmt: skip
    damping: Annotated[
        float,
        NumberKey("damping (коэффициент вязкого сопротивления), N·s/m, or N·m·s/rad",
                  "a damping", "", 0.0, 1e12),
    ] = 0.0  # fmt: skip
    stops: Annotated[
        tuple[float, float] | None,
        CustomKey(
            "least and greatest length (упоры), m, or angle, degrees: `[0.1, 0.3]`. Positions "
            "beyond them are faults"
        ),
    ] = None
    path: str = ""

    @property
    def symbol(self) -> str:
        """Letter of its force or moment on the first link that moves, rich text."""
        return indexed(self.name)

    @property
    def is_torsion(self) -> bool:
        """True for a torsion spring (пружина кручения)."""
        return self.joint is not None


LoadSize: TypeAlias = float | SizeTable | Spring
"""Size of a load: the same in every position, a table, or that of a spring."""


def largest_size(size: LoadSize) -> float:
    """Return the size of a load, N or N·m, where it is largest, with its sign; 0 of a spring."""
    match size:
        case Spring():
            return 0.0
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


class SpringEnd(Struct, frozen=True):
    """End of a spring (конец пружины): the load is what the spring exerts on its link.

    ``number`` is 0 for the first link of the spring, 1 for the second one.
    """

    number: int

    @property
    def sign(self) -> float:
        """Sign of the spring's force along the line to its second end, or of its moment."""
        return 1.0 if self.number else -1.0


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
            "angles of the driving crank, degrees: `[from, to]`, both included, or a list of such "
            "pairs. The interval runs counter-clockwise from the first angle, also through 360"
        ),
    ] = ()
    moving: Annotated[
        MovingSense | None,
        WordKey(
            'sense in which the point of application moves: `"up"`, `"down"`, `"left"` or '
            '`"right"`. The load is zero while the point is at rest'
        ),
    ] = None
    turning: Annotated[
        TurningSense | None,
        WordKey('sense in which the link turns, counter-clockwise (`"ccw"`) or clockwise (`"cw"`)'),
    ] = None


class LoadEntry(Struct, frozen=True):
    """A table of ``[[loads]]`` as written; it becomes a `Load` or a `Couple`."""

    name: Annotated[
        str,
        TextKey(
            "symbol on the sheets, with indices in braces: `F_{5}`, `M_{1}^{c}`, `P`; `F5` means "
            "`F_{5}`. Each load has its own symbol",
            40,
            absent="`F_{5}`, `F_{5}'`, … for forces on link 5, `M_{5}`, … for couples",
        ),
    ] = ""
    link: Annotated[str, CustomKey("name of the link that the load acts on", required=True)] = ""
    at: Annotated[
        str,
        CustomKey(
            "point of application (точка приложения), a point of that link. Required for a force, "
            "not allowed for a couple"
        ),
    ] = ""
    force: Annotated[
        LoadSize,
        CustomKey("force, N: a number or a table. A negative force acts in the opposite direction"),
    ] = 0.0
    couple: Annotated[
        LoadSize,
        CustomKey("couple (момент), N·m: a number or a table; positive counter-clockwise"),
    ] = 0.0
    angle: Annotated[float | None, AngleKey("direction of the force from the x axis, degrees")] = (
        None
    )
    against: Annotated[
        str,
        CustomKey(
            'resistance, instead of `angle`: `"velocity"` directs the force against the velocity '
            'of its point, `"rotation"` directs the couple against the rotation of its link'
        ),
    ] = ""
    phases: Annotated[
        Phase,
        CustomKey(
            "parts of the cycle in which the load acts (фазы действия)", absent="the whole cycle"
        ),
    ] = Phase()
    like: Annotated[
        str,
        CustomKey(
            "instead of `force`: name of the load of another piston, whose indicator diagram this "
            "one has"
        ),
    ] = ""
    shift: Annotated[
        float | None,
        CustomKey(
            "with `like`: delay after the other piston, degrees of the cycle (the firing interval)"
        ),
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
    sense : Fixed, Against or SpringEnd
        Against the velocity of the point; along the spring that is its size.
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
    sense: Fixed | Against | SpringEnd
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
    sense : Against, SpringEnd or None
        Against the rotation of the link; of the spring that is its size.
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
    sense: Against | SpringEnd | None = None
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
            "direction of the force from the x axis, degrees. The force is negative if it acts in "
            "the opposite direction",
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
            "coefficient of friction of prismatic joints (f)",
            "a coefficient", "", 0.0, 10.0, hint=_LIKE,
        ),
    ] = 0.0  # fmt: skip
    f_pin: Annotated[
        float,
        NumberKey(
            "reduced coefficient of friction of revolute joints (приведённый коэффициент f′)",
            "a coefficient", "", 0.0, 10.0, hint=_LIKE,
        ),
    ] = 0.0  # fmt: skip
    radius: Annotated[
        float, NumberKey("radius of the pins (радиус цапф)", "a radius", "m", 0.0, 10.0)
    ] = 0.0
    pairs: Annotated[
        Mapping[str, PairFriction],
        CustomKey(
            'other values for single joints, by their point and two links: `"B 3-0" = { f = 0.2 '
            "}`. A prismatic joint is named by its pin; the frame is 0"
        ),
    ] = field(default_factory=dict)


class BearingSection(Struct, frozen=True):
    """Two bearings of a shaft, a table of ``[bearings]`` (подшипники вала)."""

    at: Annotated[
        tuple[float, float],
        CustomKey(
            "positions `[z′, z″]` of the bearings O′ and O″ along the axis of the shaft, m, from "
            "any origin",
            required=True,
        ),
    ]
    plane: Annotated[
        float,
        NumberKey(
            "position of the plane of the force along the same axis", "a distance", "m", -1e3, 1e3
        ),
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
        In file order, with different names; last those of the springs, one for each moving end.
    springs : tuple of Spring
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
            "acceleration of free fall (ускорение свободного падения), m/s², along -y; `0` or "
            "`false`: no weights",
            absent="9.81",
        ),
    ]
    masses: Annotated[
        Mapping[str, Mass],
        CustomKey(
            "mass and moment of inertia of each link, by name. A link that is not listed is "
            "massless (невесомое звено)",
            name="links",
        ),
    ]
    loads: tuple[Load | Couple, ...]
    resultant: Annotated[
        bool,
        FlagKey(
            "`true`: the inertia forces of a link are drawn as one force on a shifted line, "
            "without a couple, if the line fits the drawing"
        ),
    ] = False
    friction: FrictionTask | None = None
    bearings: Mapping[str, BearingSection] = field(default_factory=dict)
    springs: tuple[Spring, ...] = ()


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


class RelationTerm(NamedTuple):
    """A number in the relations of a problem, an answer or a datum (величина формулы).

    Attributes
    ----------
    value : float
        The exact one.
    symbol : str
        Rich text.
    answer : str
        Name of the answer that it is; empty for a datum.
    code : str
        Mistake of leaving it out, or of taking it with the other sign; empty for an ordinary one.
    turns : bool
        Whether its sign is a sense of turning: then a product with it may have either sign.
    """

    value: float
    symbol: str
    answer: str = ""
    code: str = ""
    turns: bool = False


class Relation(Struct, frozen=True, eq=False):
    """Formula of an answer by others and by data (зависимость).

    Attributes
    ----------
    answer : str
    formula : str
        Python arithmetic of the keys of the terms, with ``sqrt`` and ``abs``.
    codes : mapping
        Mistakes by the change of the formula: ``sign``, ``inverted``, ``root``, ``squares``,
        ``square``; where it has no code of its own it is a slip.
    is_usual : bool
        Whether an answer contradicts earlier ones that give another value by it.
    """

    answer: str
    formula: str
    codes: Mapping[str, str] = MappingProxyType({})
    is_usual: bool = True


class Relations(Struct, frozen=True, eq=False):
    """All relations of the answers of a computed problem (зависимости величин).

    Attributes
    ----------
    terms : mapping
        By their keys, which are Python names.
    relations : tuple of Relation
        Those of an answer in the order in which they are usual.
    instead : mapping
        Terms that are taken for a term, or for an answer by its name, with the code of that.
    """

    terms: Mapping[str, RelationTerm] = field(default_factory=dict)
    relations: tuple[Relation, ...] = ()
    instead: Mapping[str, Mapping[str, str]] = field(default_factory=dict)


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

    def relations(self, names: Sequence[str], position: int) -> Relations:
        """Return the relations of some quantities, requested in this order."""
