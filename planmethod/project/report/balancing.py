"""The chapter on static balancing: counterweights, main vector of inertia (уравновешивание)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Chapter, Node, Table
from planmethod.note.formula import Rich
from planmethod.note.narrate.balancing import BalancingTeller
from planmethod.note.numbers import in_heads
from planmethod.note.wording import Words
from planmethod.project.report.context import Report, sentences
from planmethod.project.report.figures import figure, of_sheet

COLUMN = 180.0
"""Width of the texts of the sheet, mm."""

Columns = list[tuple[str, str, list[str]]]


def balancing_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    said: Words = report.said["weights"]
    tell = BalancingTeller(report.every, report.words)
    first, *others = tell.lines()
    yield Chapter(said.title.format())
    yield sentences(said.about.format(), f"{first}.")
    for line in others[:-2]:
        yield sentences(f"{line}.")
    for kind in ("balanced-scheme", "mass-polygons"):
        made = of_sheet(kind, report.every, report.words, column=COLUMN)
        yield figure(made, str(said["figures"][kind]).format(), kind.replace("-", "_"))
    yield sentences(said.weights_text.format(), *(f"{line}." for line in others[-2:]))
    (_, unit, links), *numbers = tell.weights()
    weights = [(said.link.format(), unit, links), *numbers]
    yield _table(weights, report, said.weights_table.format(), "weights", 1)
    yield sentences(said.forces_text.format())
    yield _table(tell.columns(), report, said.forces_table.format(), "inertia", 2)
    made = of_sheet("inertia-hodographs", report.every, report.words, column=COLUMN)
    yield figure(made, said.hodographs.format(), "inertia_hodographs", height=90.0)


def _table(columns: Columns, report: Report, name: Rich, key: str, lead: int) -> Table:
    told = [(f"{head}, {unit}" if unit else head, cells)
            for head, unit, cells in in_heads(columns, report.say)]  # fmt: skip
    rows = zip(*(cells for _, cells in told), strict=True)
    return Table(tuple(head for head, _ in told), tuple(rows), lead, lead, name=name, key=key)
