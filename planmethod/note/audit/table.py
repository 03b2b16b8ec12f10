"""The audit of sources as a Markdown document."""

from __future__ import annotations

import re
from collections.abc import Sequence

from planmethod.note.audit.audit import DRAFTING_MM, Audited, count
from planmethod.note.numbers import significant
from planmethod.note.plaintext import fixed, given, spoken
from planmethod.note.wording import language
from planmethod.problem.head import KindProblem
from planmethod.problem.model import Problem

NONE = "—"
DIGITS = 5
"""Significant digits of an exact and of a read value."""


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
        found = language(lang)
        self.words, self.says = found.note, found.audit
        self.ruler = ruler

    def markdown(self, audits: Sequence[tuple[KindProblem, Sequence[Audited]]]) -> str:
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

    def _counts(self, audits: Sequence[tuple[KindProblem, Sequence[Audited]]]) -> str:
        says = self.says
        rows = [
            [_plain(name(problem)), str(len(items)), *map(str, count(items).values())]
            for problem, items in audits
        ]
        return _table([says.problem, says.values, *says.counted.values()], rows, "lrrrrr")

    def _section(self, problem: KindProblem, items: Sequence[Audited]) -> str:
        says = self.says
        head = [f"## {_plain(name(problem))}: {_plain(problem.title)}"]
        if problem.source:
            head.append(f"{says.source}: {_plain(problem.source)}.")
        if not items:
            return "\n\n".join([*head, says.nothing])
        counts = {verdict.value: number for verdict, number in count(items).items()}
        head.append(says.summary.format(values=len(items), **counts))
        rows = [self._row(item) for item in items]
        return "\n\n".join(
            [*head, _table(list(says.columns), rows, "llrrrrrrll"), *self._chain(problem)]
        )

    def _chain(self, problem: KindProblem) -> list[str]:
        """Return the way from a printed flywheel to the exact one, if the source prints it."""
        if not isinstance(problem, Problem) or problem.machine is None:
            return []
        from planmethod.note.audit.machine import chain

        rows, before = [], 0.0
        for step, value in chain(problem):
            change = 100.0 * (value / before - 1.0) if before else None
            told = self.says.chain_steps[step]
            rows.append([self._number(value, 6), self._hundredths(change), *told])
            before = value
        if not rows:
            return []
        return [self.says.chain, _table(list(self.says.chain_columns), rows, "rrll")]

    def _row(self, item: Audited) -> list[str]:
        published, says = item.published, self.says
        reasons = [says.whys[item.why.value] if item.why else "", published.note]
        return [
            _plain(published.name),
            _plain(published.unit),
            given(published.value, self.words, 12),
            self._number(item.exact, DIGITS),
            self._number(item.read, DIGITS),
            self._number(item.difference, 2),
            self._hundredths(item.percent),
            self._hundredths(item.mm),
            says.verdicts[item.verdict.value],
            _plain("; ".join(reason for reason in reasons if reason)),
        ]

    def _number(self, value: float | None, digits: int) -> str:
        return NONE if value is None else spoken(significant(value, digits), self.words)

    def _hundredths(self, value: float | None) -> str:
        # Rounded first: what rounds to nothing has no minus.
        return NONE if value is None else fixed(round(value, 2), self.words)


def name(problem: KindProblem) -> str:
    """Return what the document calls a problem: its file, and its variant."""
    return problem.name if problem.variant is None else f"{problem.name}, {problem.variant}"


def _plain(text: str) -> str:
    """Return a stranger's text in one line, without the signs that Markdown acts upon."""
    return re.sub(r"([\\`*|<>\[\]#])", r"\\\1", " ".join(text.split()))


def _table(head: list[str], rows: list[list[str]], align: str) -> str:
    rule = ["---:" if side == "r" else "---" for side in align]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, rule, *rows])
