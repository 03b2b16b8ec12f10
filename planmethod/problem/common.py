"""Plain records of the data common to all problem files, and of the flat tables of gears."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import Annotated

from msgspec import Struct, field
from msgspec.structs import asdict, replace

from planmethod.languages import LANGUAGES
from planmethod.problem.key_types import (
    ChoiceKey,
    CustomKey,
    FlagKey,
    IntegerKey,
    NumberKey,
    TextKey,
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
            missing='Say which quantity: what = "v B".',
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
            hint="5 is 5 % of the value.", more=", of the value",
        ),
    ] = None  # fmt: skip


NOTATIONS = ("p5 p4", "p1 p2", "pn pv")
"""Letters of the numbers of lower and higher pairs; languages have words for the last one."""


class SheetSettings(Struct, frozen=True):
    """Settings of the sheets (оформление листов): ``[sheet]``; None: not given."""

    paper: Annotated[str | None, CustomKey('format: `"A3"`, `"A4x3"`, `"A3:portrait"`')] = None
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
