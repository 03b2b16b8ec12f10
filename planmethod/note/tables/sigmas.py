"""Drafting errors as they are written: digits of a sigma, the mark of those found by draws."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

from planmethod.note.numbers import significant
from planmethod.note.plaintext import spoken, table, wrap

if TYPE_CHECKING:
    from planmethod.note.wording import Wording
    from planmethod.solved.errors.spread import Errors
    from planmethod.solved.solution import Solution

DRAWN = "*"
"""Mark of a sigma that was found by random draws, first order failing there."""

TWO_DIGITS = 2.95
"""Leading digits of an error up to which it has two significant digits, beyond them one."""


def _place(sigma: float) -> int:
    """Return the power of ten of the last digit that an error is written with."""
    power = math.floor(math.log10(sigma))
    return power - 1 if sigma / 10.0**power < TWO_DIGITS else power


def _plain(sigma: float) -> bool:
    """Tell whether an error is written without a power of ten."""
    return math.isfinite(sigma) and 1e-6 <= sigma < 1e6


def sigma_text(sigma: float) -> str:
    """Return an error with a decimal point: two digits when it begins with 1 or 2, else one.

    >>> [sigma_text(s) for s in (0.0881, 0.1416, 17.73, 430.0, 0.0)]
    ['0.09', '0.14', '18', '400', '0']
    """
    if sigma == 0.0 or not _plain(sigma):
        return significant(sigma, 2)
    place = _place(sigma)
    return f"{round(sigma, -place):.{max(0, -place)}f}"


def rounded_to(value: float, sigma: float) -> str:
    """Return a value up to the last digit of its error; to four digits when it has none.

    >>> rounded_to(3.9251, 0.0881), rounded_to(1234.5, 56.0)
    ('3.93', '1230')
    """
    if sigma == 0.0 or not _plain(sigma):
        return significant(value)
    place = _place(sigma)
    return f"{round(value, -place) + 0.0:.{max(0, -place)}f}"


def as_long(text: str, value: float, sigma: float) -> str:
    """Return the text of an exact value with no fewer decimals than its error has."""
    longer = rounded_to(value, sigma) if value and sigma else text
    return longer if len(longer.partition(".")[2]) > len(text.partition(".")[2]) else text


def marked(errors: Errors, label: str, index: int) -> tuple[float, str]:
    """Return a quantity's sigma in one position and its mark, `DRAWN` or nothing.

    What the drawing does not give, as the ω of a link that does not turn, has no error.
    """
    spread = errors.spreads.get(label)
    if spread is None:
        return 0.0, ""
    return float(spread.sigma[index]), DRAWN if spread.drawn[index] else ""


LABEL = {"v": "v", "a": "a", "ω": "omega", "ε": "epsilon"}
"""What the drafting errors call the quantities of the result tables."""


def label_of(symbol: str, name: str) -> str:
    """Return the label of a result: ``ω`` of link ``2`` is ``omega_2``."""
    return f"{LABEL[symbol]}_{name}"


class Sigmas:
    """Cells of the drafting errors, none where they are not asked for.

    Attributes
    ----------
    drawn : bool
        Some cell that was made has the mark of a sigma found by random draws.
    """

    def __init__(self, solution: Solution, words: Wording, *, asked: bool = True) -> None:
        self.solution, self.words, self.asked = solution, words, asked
        self.drawn = False

    def cell(self, label: str | None, index: int, errors: Errors | None = None) -> list[str]:
        """Return the error of a quantity as a row of one cell, or of none.

        ``errors`` are those that have it, the kinematic ones when absent. What is told by a dash
        and has no label has one for its error, too.
        """
        if not self.asked:
            return []
        if label is None:
            return ["—"]
        sigma, mark = marked(errors or self.solution.drafting, label, index)
        self.drawn = self.drawn or bool(mark)
        return [spoken(sigma_text(sigma), self.words) + mark]

    def header(self, header: Sequence[str], *after: int) -> tuple[str, ...]:
        """Return a header with the columns of the errors behind those of the readings."""
        wide: list[str] = []
        for k, text in enumerate(header):
            wide.append(text)
            wide += [self.words.sigma] if self.asked and k in after else []
        return tuple(wide)

    def table(
        self, header: Sequence[str], rows: Sequence[Sequence[str]], *, left: int = 1
    ) -> list[str]:
        """Return an aligned table; the digits of the errors stand under each other."""
        if not self.asked:
            return table(header, rows, left=left)
        columns = [
            levelled(column) if head == self.words.sigma else list(column)
            for head, *column in zip(header, *rows, strict=True)
        ]
        return table(header, list(zip(*columns, strict=True)), left=left)

    def notes(self) -> list[str]:
        """Return what the errors are, and what the mark of some of them means."""
        if not self.asked:
            return []
        name = self.solution.profile.name
        profile = self.words.profiles.get(name, name)
        lines = wrap(self.words.sigma_note.format(profile=profile))
        if self.drawn:
            lines += wrap(self.words.drawn_note.format(count=self.solution.drafting.draws))
        return lines


def levelled(cells: Sequence[str]) -> list[str]:
    """Return cells with room for a mark where another cell of their column has one."""
    some = any(cell.endswith(DRAWN) for cell in cells)
    return [cell + " " if some and not cell.endswith(DRAWN) else cell for cell in cells]
