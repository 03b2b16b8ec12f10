"""Statistics of a group's marks and of the questions (статистика группы)."""

from __future__ import annotations

import math
import statistics
from collections.abc import Sequence

from msgspec import Struct

from planmethod.check.model import GradedSubmission

MIN_SUBMISSIONS = 3
"""Minimum number of submissions for a correlation."""

WEAK = 0.2
"""Discrimination below which a question does not separate strong students from weak ones."""


class QuestionStatistics(Struct, frozen=True):
    """Results of a group for one question (статистика вопроса).

    Attributes
    ----------
    label, symbol : str
        Letters as plain text, and as rich text.
    submissions : int
        Number of submissions in which it is graded.
    mean_fraction : float
        Mean share of its points, 0 to 1: the smaller, the harder.
    discrimination : float or None
        Correlation of its fraction with that of all other answers of a submission, -1 to 1; None
        for fewer than three submissions, or equal fractions.
    """

    label: str
    symbol: str
    submissions: int
    mean_fraction: float
    discrimination: float | None


class GroupStatistics(Struct, frozen=True):
    """Statistics of a group (статистика группы).

    Attributes
    ----------
    marks : tuple of (str, int)
        Number of submissions with each mark, the best first.
    fractions : tuple of float
        Fraction of the points of each submission, 0 to 1.
    questions : tuple of QuestionStatistics
        In the requested order.
    provisional : int
        How many marks may still change.
    """

    marks: tuple[tuple[str, int], ...]
    fractions: tuple[float, ...]
    questions: tuple[QuestionStatistics, ...]
    provisional: int = 0

    @property
    def mean(self) -> float:
        """Mean share of the points."""
        return statistics.fmean(self.fractions)

    @property
    def median(self) -> float:
        """Fraction of the points that half of the submissions reach."""
        return statistics.median(self.fractions)

    @property
    def deviation(self) -> float:
        """Standard deviation of the group's fractions (of a population, not a sample)."""
        return statistics.pstdev(self.fractions)


def statistics_of(
    works: Sequence[GradedSubmission], marks: Sequence[str], scale: Sequence[str]
) -> GroupStatistics | None:
    """Return the statistics of a group; None for fewer than two graded submissions.

    Parameters
    ----------
    marks : sequence of str
        Marks of the submissions, one each; empty for one that is not graded.
    scale : sequence of str
        All marks that there are, the best first.
    """
    judged = [(work, mark) for work, mark in zip(works, marks, strict=True) if work.of]
    if len(judged) < 2:
        return None
    order = list(dict.fromkeys([*scale, *(mark for _, mark in judged)]))
    given = [mark for _, mark in judged]
    found: dict[tuple[str, int], list[tuple[float, float | None]]] = {}
    symbols: dict[str, str] = {}
    for work, _ in judged:
        for one in work.answers:
            if one.key is None:
                continue
            symbols.setdefault(one.key.label, one.key.symbol)
            pairs = found.setdefault((one.key.label, one.key.position), [])
            if not one.is_open and one.of:
                rest = work.of - one.of
                others = (work.points - one.points) / rest if rest > 0 else None
                pairs.append((one.points / one.of, others))
    several = len({position for _, position in found}) > 1
    questions = tuple(
        QuestionStatistics(
            f"{label} [{position}]" if several else label,
            f"{symbols[label]} [{position}]" if several else symbols[label],
            len(pairs),
            statistics.fmean(own for own, _ in pairs),
            _correlation([(own, rest) for own, rest in pairs if rest is not None]),
        )
        for (label, position), pairs in found.items()
        if pairs
    )
    return GroupStatistics(
        tuple((mark, given.count(mark)) for mark in order),
        tuple(work.points / work.of for work, _ in judged),
        questions,
        sum(work.is_provisional for work, _ in judged),
    )


def _correlation(pairs: Sequence[tuple[float, float]]) -> float | None:
    """Return Pearson's correlation; None where it has no meaning."""
    if len(pairs) < MIN_SUBMISSIONS:
        return None
    own, rest = [one for one, _ in pairs], [one for _, one in pairs]
    if max(own) - min(own) < 1e-9 or max(rest) - min(rest) < 1e-9:
        return None
    found = statistics.correlation(own, rest)
    return found if math.isfinite(found) else None
