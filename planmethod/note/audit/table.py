"""The audit of sources as a Markdown document."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

from planmethod.note.audit.asking import Why
from planmethod.note.audit.audit import DRAFTING_MM, Audited, Verdict, count
from planmethod.note.numbers import significant
from planmethod.note.plaintext import fixed, given, spoken
from planmethod.note.wording import wording
from planmethod.problem.model import Problem

NONE = "—"
DIGITS = 5
"""Significant digits of an exact and of a read value."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Phrases:
    """What the document says in one language."""

    title: str
    intro: tuple[str, ...]
    problem: str
    source: str
    values: str
    nothing: str
    summary: str
    columns: tuple[str, ...]
    verdicts: dict[Verdict, str]
    counted: dict[Verdict, str]
    whys: dict[Why, str]


EN = Phrases(
    title="Printed values of the sources",
    intro=(
        "What the sources print, beside the exact value and the value that follows from the "
        "segments read with a ruler of {ruler} mm divisions on plans drawn to the source's own "
        "scales. Written by `planmethod audit` from the `[published]` tables of the problem files; "
        "names and remarks are as they stand there.",
        "The difference is printed less exact: in the unit of the value, in percent of the exact "
        "value, and in millimetres of the plan. The millimetres of an ω or ε are those of the "
        "segment from which it follows; of an angle, those at the far end of its link, or of its "
        "force on the plan. Forces are read off force plans in the source's scale, or in the "
        "program's where the source tells none.",
        "- **agrees**: the exact value rounds to the printed digits;\n"
        "- **drawing**: no more than {limit} mm off, which is what careful drafting gives. A slip "
        "of the source too small to tell from drafting is here too, and its remark says so;\n"
        "- **differs**: more than that, or not drawn and not equal; the remark gives the reason.",
    ),
    problem="Problem",
    source="Source",
    values="Values",
    nothing="The source prints no values.",
    summary="{values} values: {agrees} agree, {drawn} within drafting, {differs} differ, "
    "{absent} not computed.",
    columns=(
        "Value",
        "Unit",
        "Printed",
        "Exact",
        "Ruler",
        "Difference",
        "%",
        "mm",
        "Verdict",
        "Remark",
    ),
    verdicts={
        Verdict.AGREES: "agrees",
        Verdict.DRAWN: "drawing",
        Verdict.DIFFERS: "**differs**",
        Verdict.ABSENT: "not computed",
    },
    counted={
        Verdict.AGREES: "Agree",
        Verdict.DRAWN: "Within drafting",
        Verdict.DIFFERS: "Differ",
        Verdict.ABSENT: "Not computed",
    },
    whys={
        Why.NO_WHAT: "",
        Why.NO_POSITION: "the driver has no such position in this file",
        Why.NO_SCALE: "the file does not tell the scale of the source's plan",
        Why.NO_POINT: "the plans have no such point",
        Why.NO_LINK: "no link joins these points",
        Why.NO_ARM: "the point is on the axis of the crank, its arm is zero",
        Why.NO_SLIDING: "no sliding pair of these points",
        Why.ZERO_DIVISOR: "the divisor is zero",
        Why.NO_FORCES: "the file has no masses and no loads",
        Why.NO_JOINT: "these links have no joint",
        Why.NO_DIRECTION: "the force is zero: it has no direction and no arm",
        Why.STANDS: "the driving link stands: there is no lever",
    },
)

RU = Phrases(
    title="Напечатанные значения источников",
    intro=(
        "Что напечатано в источниках — рядом с точным значением и со значением, которое следует "
        "из отрезков, снятых линейкой с ценой деления {ruler} мм с планов в масштабах самого "
        "источника. Составлено командой `planmethod audit` по таблицам `[published]` файлов задач; "
        "названия и примечания стоят так, как они даны там.",
        "Разность — напечатанное минус точное: в единицах величины, в процентах точного значения и "
        "в миллиметрах плана. Миллиметры ω и ε — это миллиметры отрезка, из которого они следуют; "
        "миллиметры угла — на дальнем конце звена или силы на плане. Силы сняты с планов "
        "сил в масштабе источника, а если он не указан — в масштабе программы.",
        "- **сходится**: точное значение округляется до напечатанного;\n"
        "- **чертёж**: разность не больше {limit} мм, это точность аккуратного построения. Описка "
        "источника, неотличимая от погрешности чертежа, тоже здесь, о ней говорит примечание;\n"
        "- **расходится**: больше, или величина не снята с чертежа и не равна точной; причина — в "
        "примечании.",
    ),
    problem="Задача",
    source="Источник",
    values="Значений",
    nothing="Значений в источнике не напечатано.",
    summary="Значений {values}: сходится {agrees}, в пределах точности чертежа {drawn}, "
    "расходится {differs}, не вычислено {absent}.",
    columns=(
        "Величина",
        "Единица",
        "Напечатано",
        "Точно",
        "Линейка",
        "Разность",
        "%",
        "мм",
        "Заключение",
        "Примечание",
    ),
    verdicts={
        Verdict.AGREES: "сходится",
        Verdict.DRAWN: "чертёж",
        Verdict.DIFFERS: "**расходится**",
        Verdict.ABSENT: "не вычислено",
    },
    counted={
        Verdict.AGREES: "Сходится",
        Verdict.DRAWN: "В пределах чертежа",
        Verdict.DIFFERS: "Расходится",
        Verdict.ABSENT: "Не вычислено",
    },
    whys={
        Why.NO_WHAT: "",
        Why.NO_POSITION: "такого положения начального звена в файле нет",
        Why.NO_SCALE: "масштаб плана источника в файле не указан",
        Why.NO_POINT: "такой точки на планах нет",
        Why.NO_LINK: "эти точки не принадлежат одному звену",
        Why.NO_ARM: "точка лежит на оси кривошипа, плечо равно нулю",
        Why.NO_SLIDING: "эти точки не образуют поступательной пары",
        Why.ZERO_DIVISOR: "делитель равен нулю",
        Why.NO_FORCES: "в файле нет масс и нагрузок",
        Why.NO_JOINT: "эти звенья не образуют кинематической пары",
        Why.NO_DIRECTION: "сила равна нулю: у неё нет ни направления, ни плеча",
        Why.STANDS: "начальное звено неподвижно: рычага нет",
    },
)

PHRASES = {"en": EN, "ru": RU}


class Document:
    """Audits of one or many problems, written in one language.

    Parameters
    ----------
    lang : str
        ``en`` or ``ru``.
    ruler : float, mm
        Step of the ruler that the audits were made with.

    Raises
    ------
    UnknownLanguageError
    """

    def __init__(self, lang: str, ruler: float) -> None:
        self.words = wording(lang)
        self.says = PHRASES[self.words.lang]
        self.ruler = ruler

    def markdown(self, audits: Sequence[tuple[Problem, Sequence[Audited]]]) -> str:
        """Return the whole document: what the columns mean, the counts, a table a problem."""
        limits = {
            "ruler": given(self.ruler, self.words),
            "limit": given(DRAFTING_MM, self.words),
        }
        parts = [f"# {self.says.title}", *(text.format(**limits) for text in self.says.intro)]
        if len(audits) > 1:
            parts.append(self._counts(audits))
        parts += [self._section(problem, items) for problem, items in audits]
        return "\n\n".join(parts) + "\n"

    def _counts(self, audits: Sequence[tuple[Problem, Sequence[Audited]]]) -> str:
        says = self.says
        rows = [
            [_plain(name(problem)), str(len(items)), *map(str, count(items).values())]
            for problem, items in audits
        ]
        return _table([says.problem, says.values, *says.counted.values()], rows, "lrrrrr")

    def _section(self, problem: Problem, items: Sequence[Audited]) -> str:
        says = self.says
        head = [f"## {_plain(name(problem))}: {_plain(problem.title)}"]
        if problem.source:
            head.append(f"{says.source}: {_plain(problem.source)}.")
        if not items:
            return "\n\n".join([*head, says.nothing])
        counts = {verdict.value: number for verdict, number in count(items).items()}
        head.append(says.summary.format(values=len(items), **counts))
        rows = [self._row(item) for item in items]
        return "\n\n".join([*head, _table(list(says.columns), rows, "llrrrrrrll")])

    def _row(self, item: Audited) -> list[str]:
        published, says = item.published, self.says
        reasons = [says.whys[item.why] if item.why else "", published.note]
        return [
            _plain(published.name),
            _plain(published.unit),
            given(published.value, self.words, 12),
            self._number(item.exact, DIGITS),
            self._number(item.read, DIGITS),
            self._number(item.difference, 2),
            self._hundredths(item.percent),
            self._hundredths(item.mm),
            says.verdicts[item.verdict],
            _plain("; ".join(reason for reason in reasons if reason)),
        ]

    def _number(self, value: float | None, digits: int) -> str:
        return NONE if value is None else spoken(significant(value, digits), self.words)

    def _hundredths(self, value: float | None) -> str:
        # Rounded first: what rounds to nothing has no minus.
        return NONE if value is None else fixed(round(value, 2), self.words)


def name(problem: Problem) -> str:
    """Return what the document calls a problem: its file, and its variant."""
    return problem.name if problem.variant is None else f"{problem.name}, {problem.variant}"


def _plain(text: str) -> str:
    """Return a stranger's text in one line, without the signs that Markdown acts upon."""
    return re.sub(r"([\\`*|<>\[\]#])", r"\\\1", " ".join(text.split()))


def _table(head: list[str], rows: list[list[str]], align: str) -> str:
    rule = ["---:" if side == "r" else "---" for side in align]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, rule, *rows])
