"""Tables of the hard cases."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from itertools import groupby

from benchmarks.hard import HardRow, Outcome, run
from benchmarks.hard_cases import HARD

HEAD = (
    "case",
    "parameter",
    "outcome",
    "margin",
    "κ",
    "worst multiple of κ·u",
    "relative error",
    "what the user is told",
)
SUMMARY = (
    "case",
    "what is hard",
    "rows",
    "good",
    "warned",
    "refused",
    "broken",
    "worst multiple of κ·u",
    "of the largest κ",
    "silently wrong",
)
TOLD = 70
"""Characters of a message that a table shows."""


def table(*results: Sequence[HardRow], folded: bool = True) -> str:
    """Return a table in Markdown: a line for each row, or for neighbours of the same outcome.

    Parameters
    ----------
    *results : sequences of HardRow
        Results of `run` for some cases.
    folded : bool
        Show neighbouring rows of one case and outcome as one line with the worst of each.
    """
    lines = [_line(HEAD), _line(["---"] * len(HEAD))]
    for rows in results:
        for _, group in groupby(rows, key=_end if folded else id):
            lines.append(_line(_fold(list(group))))
    return "\n".join(lines) + "\n"


def _end(row: HardRow) -> tuple[Outcome, bool, str]:
    """Return the outcome that the rows of one line share: rejections by their kind."""
    if row.outcome is not Outcome.REFUSED:
        return row.outcome, row.silently_wrong, ""
    nature = "dead position"
    if nature not in row.told:
        nature = " ".join(row.told.split(": ", 1)[-1].split()[:2])
    return row.outcome, False, nature


def _fold(rows: list[HardRow]) -> list[str]:
    first, last = rows[0], rows[-1]
    worst = max(rows, key=lambda row: row.multiple)
    wrong = max(rows, key=lambda row: row.error)
    margins = [row.margin for row in rows if not math.isnan(row.margin)]
    kappas = [row.kappa for row in rows if not math.isnan(row.kappa)]
    return [
        first.case,
        first.label if len(rows) == 1 else f"{first.label} … {last.label}",
        first.outcome.value if not first.silently_wrong else "silently wrong",
        f"{min(margins):.1e}" if margins else "",
        f"{max(kappas):.1e}" if kappas else "",
        f"{worst.multiple:.2g} ({worst.multiple_of})" if worst.multiple else "0",
        f"{wrong.error:.1e} ({wrong.error_of})" if wrong.error else "0",
        _shorten(last),
    ]


def _shorten(row: HardRow) -> str:
    """Return the beginning of the message shown to the user, without the name of the case."""
    said = row.told.split("in the problem file ")[-1].removeprefix(f"{row.case}: ")
    return said if len(said) <= TOLD else said[: TOLD - 1].rstrip() + "…"


def summarise(*results: Sequence[HardRow]) -> str:
    """Return a table in Markdown with a line for each case.

    The multiples are the worst of the rows that were not refused: in units of u times the reach
    of the result itself, and times the largest κ of the row.
    """
    titles = {case.name: case.title for case in HARD}
    lines = [_line(SUMMARY), _line(["---", "---", *["---:"] * (len(SUMMARY) - 2)])]
    for rows in results:
        name = rows[0].case
        solved = [row for row in rows if row.outcome is not Outcome.REFUSED]
        worst = max(solved, key=lambda row: row.multiple, default=None)
        cells = [name, titles.get(name, ""), str(len(rows))]
        cells += [str(sum(row.outcome is outcome for row in rows)) for outcome in Outcome]
        cells.append(f"{worst.multiple:.2g} ({worst.multiple_of})" if worst else "")
        cells.append(f"{max(row.share for row in solved):.2g}" if solved else "")
        cells.append(str(sum(row.silently_wrong for row in rows)))
        lines.append(_line(cells))
    return "\n".join(lines) + "\n"


def _line(cells: Iterable[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def hard_section() -> list[str]:
    """Examine every hard case and return the section of the document."""
    results = [run(case) for case in HARD]
    return [
        "## Hard cases",
        "",
        "Every row is solved in float64, judged by a referee of 50 digits that also measures the "
        "condition numbers, and asked of the package as a user asks it. *Good*: solved, nothing "
        "to tell. *Warned*: solved, and the user is told how few digits are left. *Refused*: with "
        "the reason. The error is counted in units of κ·u, κ being the condition number of that "
        "very result; for rows that are refused because too few digits are left, too.",
        "",
        "By case (rows not refused; the second multiple is in units of u times the largest κ of "
        "the row, which is what a user is told 16 of):",
        "",
        *summarise(*results).splitlines(),
        "",
        "One kind of rows is above 16. *Ratios*: with a crank a hundred times the frame and more, "
        "an angular acceleration is a difference of terms ω² that cancel, and the plan draws those "
        "terms; beside ω² it is as good as any other.",
        "",
        "All rows, neighbours that ended alike in one line with the worst of each:",
        "",
        *table(*results).splitlines(),
    ]
