"""What problem files of every kind state, and the flat tables of gears: plain records."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import Annotated

from msgspec import Struct, field
from msgspec.structs import asdict, replace

from planmethod.languages import LANGUAGES
from planmethod.problem.declared import (
    ChoiceKey,
    FlagKey,
    NumberKey,
    OwnKey,
    TextKey,
    WholeKey,
    WordKey,
)

STAMP_LIMIT = 200

TITLE_BLOCK: Mapping[str, str] = MappingProxyType(
    {
        "organisation": "организация",
        "department": "кафедра",
        "group": "группа",
        "author": "surname in the row Разраб.",
        "checker": "surname in the row Пров.",
        "t_control": "surname in the row Т.контр.",
        "norm_control": "surname in the row Н.контр.",
        "approver": "surname in the row Утв.",
        "extra": "surname in the free row",
        "extra_role": "what the free row is for: Конс.",
        "designation": "обозначение",
        "title": "наименование",
        "material": "материал; in coursework the subject",
        "subject": "another name of `material`",
        "letter": "Лит.",
        "mass": "Масса",
        "scale": "Масштаб",
        "sheet": "Лист",
        "sheets": "Листов",
        "date": "another name of `author_date`",
        "author_date": "Дата beside the author",
        "checker_date": "Дата beside the checker",
        "t_control_date": "Дата in the row Т.контр.",
        "norm_control_date": "Дата in the row Н.контр.",
        "approver_date": "Дата in the row Утв.",
        "extra_date": "Дата in the free row",
        "inventory": "side column Инв. № подл.",
        "inventory_instead": "side column Взам. инв. №",
        "inventory_copy": "side column Инв. № дубл.",
        "reference": "side column Справ. №",
        "first_use": "side column Перв. примен.",
        "city": "city on the title page of the note",
        "year": "year on the title page of the note; by default that of `author_date`",
    }
)
"""Fields of ``[stamp]``, all of them optional texts; more of them: docs/title-block.md."""

TITLE_BLOCK_IN: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(LANGUAGES, "a table of these fields for sheets in this language, over the others")
)
"""Tables of ``[stamp]``: texts that a language has instead (надпись на языке листа)."""

TITLE_FORMS = ("1", "1+2a", "2", "2a")
"""Forms of the title block: of every sheet, or of the first and of the later ones."""

LETTERINGS = ("A", "A-upright", "B", "B-upright")
"""Types of the lettering of GOST 2.304, slanted where nothing else is said."""


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
        TextKey(
            "which quantity it is, see below; without it the value is listed and not compared", 1000
        ),
    ] = ""
    note: Annotated[str, TextKey("a remark, for instance why the source is wrong", 1000)] = ""
    position: Annotated[
        int | None,
        OwnKey("which position of the driver, counted from 0; absent when there is one"),
    ] = None


class AnswerForm(Enum):
    """In what an answer is given (вид ответа)."""

    VALUE = "value"
    MM = "mm"  # millimetres of the student's own plan
    BOTH = "both"  # either is taken


class AskedSense(Enum):
    """As what the sense of an answer is asked (направление)."""

    TURN = "turn"  # ↺ or ↻
    DIRECTION = "direction"  # left, right, up or down
    ANGLE = "angle"  # degrees from +x


class HigherPairTable(Struct, frozen=True):
    """Two profiles that touch (высшая пара), as the file has them."""

    name: Annotated[
        str,
        OwnKey("letter of the contact", required=True, missing='Name the contact: name = "K".'),
    ]
    links: Annotated[
        tuple[str, ...],
        OwnKey(
            'the two links that touch, `["1", "2"]`; `"0"` is the frame',
            required=True,
            missing='Name the links that touch: links = ["1", "2"].',
        ),
    ]
    centres: Annotated[
        tuple[str, ...],
        OwnKey(
            "centres of curvature of both profiles, a point of each link; one point, of the first "
            "link, where the profile of the second is straight",
            required=True,
            missing='Name the centres of curvature, a point of each link: centres = ["O", "C"].',
        ),
    ]
    distance: Annotated[
        float | None,
        OwnKey("distance of both centres, m: the sum of the radii, or their difference"),
    ] = None
    slides: Annotated[
        dict[str, object] | None,
        OwnKey(
            "straight profile of the second link: `along`, `through`, `angle`, `offset` as in "
            "`slides` of a link; the offset of the centre is the radius of the first profile"
        ),
    ] = None
    roller: Annotated[
        str,
        OwnKey(
            "number of the roller that turns on the second link about its centre: it counts among "
            "the links and their mobilities"
        ),
    ] = ""
    by: Annotated[
        str, OwnKey("number of the link that replaces the pair; the next free one when absent")
    ] = ""


class AskedAnswer(Struct, frozen=True):
    """What students are asked for (вопрос); ``what`` is in the words of ``[published]``."""

    id: Annotated[
        str,
        OwnKey(
            "what outputs call the answer, each its own: a letter first, then letters, digits and "
            "`_ . / @ ' -`, at most 40. When absent, `what` with `_` for spaces: `v_B3`, `an_E_D`; "
            "with a `position` also that: `v_B3@4`"
        ),
    ]
    what: Annotated[
        str,
        OwnKey(
            "the quantity",
            more=". The words of `[published]`, or a name as `--ask` has it: `v_B3`, "
            "`omega_3`, `v_B3/2` for `vs B3 B`, `ak_B3/2`, `v_q_C`, `u_21` for `u 2 1`, "
            "`F_B_2/1` for `F 2 1`, `M_dr` for `balance`. Words may be "
            "joined by `_` as well: `an_E_D`",
            required=True,
            missing='Say which quantity: what = "v B".',
        ),
    ]
    letters: Annotated[
        tuple[str, ...],
        OwnKey(
            "how the department writes it, a string or up to 10: keys and forms print the first, "
            "columns of a group's table are known by any. In one position no two answers share "
            "one"
        ),
    ] = ()
    unit: Annotated[
        str,
        TextKey(
            'unit in which it is asked, `"мм/с"`, `"об/мин"`: a number without a unit is in it, '
            "keys, pages and the list of a form show it",
            20,
            absent="SI",
        ),
    ] = ""
    points: Annotated[
        float,
        NumberKey(
            "points of a right answer", "a number of points", low=0.0, high=1000.0,
            hint="Points are those of a right answer.",
        ),
    ] = 1.0  # fmt: skip
    form: Annotated[
        AnswerForm,
        WordKey(
            '`"value"`; `"mm"`, the length on the student\'s own plan; `"both"`, either is taken'
        ),
    ] = AnswerForm.BOTH
    sense: Annotated[
        AskedSense | None,
        OwnKey(
            '`true`: the sense is asked, of ω, ε and moments as a turn (`"turn"`), of vectors as '
            'left, right, up, down (`"direction"`); `"angle"`: the direction of a vector in '
            "degrees from +x is an answer of its own, `angle_v_B3`, with the points of a sense; "
            "`false` when absent"
        ),
    ] = None
    position: Annotated[
        int | None,
        OwnKey("which position of the driver, counted from 0; absent when there is one"),
    ] = None
    digits: Annotated[int | None, WholeKey("significant digits asked for", 1, 8)] = None
    segment: Annotated[
        str,
        OwnKey(
            'letters of its segment on the plan, `"p b3"`, where it is another than that of the '
            "quantity"
        ),
    ] = ""
    tolerance: Annotated[
        float | None,
        NumberKey(
            "the department's own for this answer",
            "a tolerance", "percent", 0.1, 100.0,
            hint="5 is 5 % of the value.", more=", of the value",
        ),
    ] = None  # fmt: skip


NOTATIONS = ("p5 p4", "p1 p2", "pn pv")
"""How the numbers of lower and higher pairs are lettered; of the last one a language has words."""


class SheetSettings(Struct, frozen=True):
    """How the sheets are to be made up (оформление листов): ``[sheet]``; None: not given."""

    paper: Annotated[str | None, OwnKey('format: `"A3"`, `"A4x3"`, `"A3:portrait"`')] = None
    form: Annotated[
        str | None,
        ChoiceKey('form of the title block: `"1"`, `"1+2a"`, `"2"` or `"2a"`', TITLE_FORMS),
    ] = None
    graph_26: Annotated[bool | None, FlagKey("the designation turned round, graph 26")] = None
    graphs_27_30: Annotated[bool | None, FlagKey("graphs 27 to 30")] = None
    side_columns: Annotated[bool | None, FlagKey("the side columns, graphs 19 to 25")] = None
    lettering: Annotated[
        str | None,
        ChoiceKey('lettering: `"A"`, `"A-upright"`, `"B"` or `"B-upright"`', LETTERINGS),
    ] = None
    lang: Annotated[str | None, OwnKey('language of the sheets: `"ru"` or `"en"`')] = None
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
            absent="of one position, where the sheet has room,",
        ),
    ] = None

    def over(self, lower: SheetSettings) -> SheetSettings:
        """Return these settings, and those of ``lower`` where these say nothing."""
        given = {name: value for name, value in asdict(self).items() if value is not None}
        return replace(lower, **given)


SEVERAL = "one of several"
"""What ``reading`` says of a scheme that is one of several which fit the data of a lost figure."""


class KindProblem(Struct, frozen=True, kw_only=True):
    """What is read of a problem of any kind (задача).

    Attributes
    ----------
    name : str
        Stem of the file.
    source_file : str
        The file as it was asked for, which messages name; the name where there is none.
    reading : str
        `SEVERAL`, or empty where the scheme is that of the task.
    other_readings : tuple of str
        What else the figure may have been (другие прочтения рисунка).
    stamp : mapping of str to str
        Texts of the title block.
    stamp_in : mapping of str to mapping
        Those that a language has instead, by its name.
    answers : tuple of AskedAnswer
        What students are asked for, in the order of the file; empty where it does not say.
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
    answers: tuple[AskedAnswer, ...] = ()
    variants: tuple[str, ...] = ()
    variant: str | None = None

    @property
    def title_block(self) -> Mapping[str, str]:
        """Texts of the title block in the language of the sheets (основная надпись)."""
        return {**self.stamp, **self.stamp_in.get(self.sheet.lang or LANGUAGES[0], {})}


def reading_record(problem: KindProblem) -> dict[str, object]:
    """Return what records say of the reading of a lost figure; nothing where there is one."""
    if not problem.reading:
        return {}
    return {"reading": problem.reading, "other_readings": list(problem.other_readings)}


MESHING_EXAMPLE = '[meshing] z = [12, 30], m = 5, x = "blocking"'
MESHING_HINT = "Lengths of [meshing] are millimetres, as the standard has them."


class MeshingTable(Struct, frozen=True, kw_only=True):
    """``[meshing]``: two wheels with involute teeth (эвольвентное зацепление)."""

    z: Annotated[
        tuple[int, int],
        OwnKey("teeth of the driving wheel 1 and of wheel 2, 5 to 1000", required=True),
    ]
    m: Annotated[
        float,
        NumberKey("module", "a module", "mm", 0.05, 100.0, hint=MESHING_HINT, required=True),
    ]
    internal: Annotated[
        bool,
        FlagKey(
            "wheel 2 has internal teeth (внутреннее зацепление), and more of them than wheel 1"
        ),
    ] = False
    cutter: Annotated[
        int | None,
        WholeKey(
            "teeth of the pinion cutter (долбяк) of an internal wheel 2, fewer than the wheel's",
            8,
            200,
            absent="20",
        ),
    ] = None
    alpha: Annotated[
        float,
        NumberKey(
            "profile angle of the rack", "an angle", "degrees", 10.0, 30.0, hint=MESHING_HINT
        ),
    ] = 20.0
    beta: Annotated[
        float,
        NumberKey(
            "helix angle of both wheels (угол наклона зуба); m, alpha, ha, c, x are then those of "
            "the normal section",
            "an angle", "degrees", 0.0, 45.0, hint=MESHING_HINT,
        ),
    ] = 0.0  # fmt: skip
    b: Annotated[
        float | None,
        NumberKey(
            "working width of the rims, for the overlap ratio of helical wheels",
            "a width", "mm", 0.05, 1e4, hint=MESHING_HINT, absent="not known",
        ),
    ] = None  # fmt: skip
    ha: Annotated[
        float,
        NumberKey(
            "addendum factor h_a* of the rack",
            "a factor of the module", low=0.5, high=1.3, hint=MESHING_HINT,
        ),
    ] = 1.0  # fmt: skip
    c: Annotated[
        float,
        NumberKey(
            "clearance factor c* of the rack",
            "a factor of the module", low=0.05, high=0.5, hint=MESHING_HINT,
        ),
    ] = 0.25  # fmt: skip
    x: Annotated[
        tuple[float, float] | None,
        OwnKey(
            "shifts of the rack in modules, `[0.5, 0.3]`; or how they are chosen within the "
            'blocking limits: `"blocking"`, `"equal-sliding"`, `"contact-ratio"`'
        ),
    ] = None
    x1: Annotated[
        float | None,
        NumberKey(
            "shift of wheel 1 alone, beside `a_w`",
            "a shift", "modules", -2.0, 3.0, hint=MESHING_HINT, more="; the other one follows",
        ),
    ] = None  # fmt: skip
    x2: Annotated[
        float | None,
        NumberKey(
            "shift of wheel 2 alone, beside `a_w`",
            "a shift", "modules", -2.0, 3.0, hint=MESHING_HINT, more="; the other one follows",
        ),
    ] = None  # fmt: skip
    a_w: Annotated[
        float | None,
        NumberKey(
            "distance of the axes", "a distance", "mm", 0.1, 1e5, hint=MESHING_HINT,
            more="; the sum of the shifts follows, and the limits choose how it is shared",
        ),
    ] = None  # fmt: skip
    s_a_min: Annotated[
        float,
        NumberKey(
            "least tooth thickness at the tip",
            "a thickness", "modules", 0.0, 1.0, hint=MESHING_HINT,
        ),
    ] = 0.25  # fmt: skip
    epsilon_min: Annotated[
        float,
        NumberKey("least contact ratio", "a contact ratio", low=1.0, high=2.0, hint=MESHING_HINT),
    ] = 1.2


CAM_EXAMPLE = '[cam] follower = "translating", stroke = 0.04, rise = 120, return = 120'
CHOOSE = "choose"
"""Word in place of a size of the cam: it is chosen."""

CAM_LAWS = (
    "constant-acceleration", "cosine", "sine", "trapezoidal", "modified-trapezoidal", "linear",
    "3-4-5", "4-5-6-7", "table", "piecewise-linear",
)  # fmt: skip
"""Laws of motion of a follower."""

CamSize = float | str | None
"""A size in metres, or ``choose``."""


class CamTable(Struct, frozen=True, kw_only=True):
    """``[cam]``: a cam and its follower (кулачковый механизм)."""

    follower: Annotated[
        str,
        ChoiceKey(
            'how the follower moves: `"translating"` or `"oscillating"`',
            ("translating", "oscillating"),
            required=True,
        ),
    ]
    contact: Annotated[
        str,
        ChoiceKey(
            'what touches the cam: `"roller"`, `"pointed"` or `"flat"`',
            ("roller", "pointed", "flat"),
        ),
    ] = "roller"
    closure: Annotated[
        str,
        ChoiceKey(
            'what keeps them together: `"force"`, a spring, or `"form"`, a groove of two sides',
            ("force", "form"),
        ),
    ] = "force"
    stroke: Annotated[
        float | None,
        NumberKey("stroke of a translating follower", "a length", "m", 1e-4, 10.0, positive=True),
    ] = None
    swing: Annotated[
        float | None,
        NumberKey("swing of an oscillating one", "an angle", "degrees", 0.1, 120.0, positive=True),
    ] = None
    arm: Annotated[
        float | None,
        NumberKey(
            "from the pivot of an oscillating one to its roller; to where its plate ends",
            "a length", "m", 1e-3, 10.0, positive=True,
        ),
    ] = None  # fmt: skip
    sense: Annotated[
        str,
        ChoiceKey(
            'whether an oscillating one rises `"opposite"` to the turning of the cam or the '
            '`"same"` way',
            ("opposite", "same"),
        ),
    ] = "opposite"
    rise: Annotated[
        float,
        NumberKey("angle of the rise", "an angle", "degrees", 1.0, 359.0, required=True),
    ]
    upper_dwell: Annotated[
        float, NumberKey("angle of the upper dwell", "an angle", "degrees", 0.0, 358.0)
    ] = 0.0
    return_: Annotated[
        float,
        NumberKey(
            "angle of the return", "an angle", "degrees", 1.0, 359.0, required=True, name="return"
        ),
    ]
    lower_dwell: Annotated[
        float | None,
        NumberKey(
            "angle of the lower dwell", "an angle", "degrees", 0.0, 358.0,
            absent="what the others leave of a turn",
        ),
    ] = None  # fmt: skip
    law: Annotated[
        object,
        OwnKey(
            "law of motion, of both or `{ rise = .., return = .. }`: "
            + ", ".join(f'`"{law}"`' for law in CAM_LAWS)
            + ', or a table: `{ law = "table", values = [..] }`',
            absent='`"3-4-5"`',
        ),
    ] = None
    pressure: Annotated[
        object,
        OwnKey(
            "allowed pressure angle, degrees, or `{ rise = 30, return = 45 }`",
            absent="30 of the rise, 45 of an oscillating follower; of the return any, in a groove "
            "that of the rise",
        ),
    ] = None
    offset: Annotated[
        CamSize,
        OwnKey('offset e of the line of a translating follower, m, or `"choose"`; 0 under a plate'),
    ] = None
    centre: Annotated[
        CamSize,
        OwnKey('from the axis of the cam to the pivot of an oscillating one, m, or `"choose"`'),
    ] = None
    r_min: Annotated[
        CamSize,
        OwnKey('least radius of the theoretical profile, m, or `"choose"`'),
    ] = None
    roller: Annotated[
        CamSize,
        OwnKey(
            'radius of the roller, m, or `"choose"`: at most 0.4 of `r_min` and 0.8 of the least '
            "radius of curvature"
        ),
    ] = None
    curvature: Annotated[
        float,
        NumberKey(
            "least radius of curvature under a plate, by which `r_min` is chosen",
            "a length", "m", 0.0, 10.0,
        ),
    ] = 0.0  # fmt: skip
    count: Annotated[int, WholeKey("positions from the rise to the next rise", 3, 720)] = 24
    parts: Annotated[
        int, WholeKey("parts of rise and of return in the diagrams that are constructed", 4, 30)
    ] = 12
    n: Annotated[
        float | None,
        NumberKey(
            "speed of the cam, counter-clockwise positive", "a speed", "rev/min", -1e5, 1e5,
            absent="that of the crank of the file, if it has one",
        ),
    ] = None  # fmt: skip
    mass: Annotated[float, NumberKey("mass of the follower", "a mass", "kg", 0.0, 1e5)] = 0.0
    load: Annotated[float, NumberKey("force against the rise", "a force", "N", 0.0, 1e8)] = 0.0
    margin: Annotated[
        float,
        NumberKey("by how much the spring is stronger than it must be", "a factor", low=1.0,
                  high=10.0),
    ] = 1.2  # fmt: skip


class PictureTable(Struct, frozen=True):
    """``[gears.picture]``: scales of the pictures of velocities (масштабы картин скоростей)."""

    mu_l: Annotated[float, NumberKey("scale of the scheme", "a scale", "m/mm", 1e-9, 1e6)] = 0.001
    longest_mm: Annotated[
        float,
        NumberKey(
            "no segment of the picture of linear velocities is longer", "a length", "mm", 1.0, 1e4
        ),
    ] = 60.0
    pole_mm: Annotated[
        float | None,
        NumberKey(
            "distance of the pole of the rays; their scale follows from it then", "a length", "mm",
            1.0, 1e4, absent="from a round scale",
        ),
    ] = None  # fmt: skip


class PlanetaryTask(Struct, frozen=True, kw_only=True):
    """``[gears.design]``: what a planetary train was to be (проектирование передачи)."""

    U: Annotated[
        float | None,
        NumberKey(
            "ratio that was asked, with its sign: U_1H, of a set with two like rows U_H1",
            "a ratio", low=-1e6, high=1e6, hint="A ratio is a number: U = 6.5.",
            absent="that of the train",
        ),
    ] = None  # fmt: skip
    within: Annotated[
        float,
        NumberKey(
            "allowed share of U, both ways", "a share", low=0.0, high=0.5, hint="2 % are 0.02."
        ),
    ] = 0.02
    z_min: Annotated[int, WholeKey("least number of teeth", 6, 400)] = 17
    z_max: Annotated[int, WholeKey("most teeth of wheels with external teeth", 6, 400)] = 120
    ring_max: Annotated[int, WholeKey("most teeth of wheels with internal teeth", 6, 400)] = 250
    k_min: Annotated[int, WholeKey("least number of satellites that is compared", 1, 24)] = 3
    k_max: Annotated[int, WholeKey("most satellites that are compared", 1, 24)] = 6
    count: Annotated[int, WholeKey("how many variants of each number are shown", 1, 10)] = 3


class GearWheelTable(Struct, frozen=True):
    """A wheel of ``[gears]`` that is a table (колесо)."""

    z: Annotated[int | None, WholeKey("number of teeth (of a worm: starts)", 1, 10_000)] = None
    r: Annotated[
        float | None,
        OwnKey("pitch radius, m, in place of teeth; beside wheels with teeth it needs `module`"),
    ] = None
    x: Annotated[float, NumberKey("shift, in modules", "a shift", low=-5.0, high=5.0)] = 0.0
    axis: Annotated[
        tuple[float, float, float] | None,
        OwnKey("of a bevel wheel: `[x, y, z]` from the apex towards the wheel; z is the main axis"),
    ] = None
