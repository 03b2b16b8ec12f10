"""The chapter on static balancing: counterweights, main vector of inertia (уравновешивание)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Chapter, Node, Table
from planmethod.note.formula import Rich
from planmethod.note.narrate.balancing import BalancingNarrator
from planmethod.note.numbers import in_heads
from planmethod.note.wording import MessageTable
from planmethod.project.report.context import Report, sentences
from planmethod.project.report.figures import figure, of_sheet

TEXT_WIDTH = 180.0
"""Width of the texts of the sheet, mm."""

Columns = list[tuple[str, str, list[str]]]


def balancing_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    texts: MessageTable = report.texts["weights"]
    narrator = BalancingNarrator(report.every, report.language)
    first, *others = narrator.lines()
    yield Chapter(texts.title.format())
    yield sentences(texts.about.format(), f"{first}.")
    for line in others[:-2]:
        yield sentences(f"{line}.")
    for kind in ("balanced-scheme", "mass-polygons"):
        made = of_sheet(kind, report.every, report.language, column=TEXT_WIDTH)
        yield figure(made, str(texts["figures"][kind]).format(), kind.replace("-", "_"))
    yield sentences(texts.weights_text.format(), *(f"{line}." for line in others[-2:]))
    (_, unit, links), *numbers = narrator.weights()
    weights = [(texts.link.format(), unit, links), *numbers]
    yield _table(weights, report, texts.weights_table.format(), "weights", 1)
    yield sentences(texts.forces_text.format())
    yield _table(narrator.columns(), report, texts.forces_table.format(), "inertia", 2)
    made = of_sheet("inertia-hodographs", report.every, report.language, column=TEXT_WIDTH)
    yield figure(made, texts.hodographs.format(), "inertia_hodographs", height=90.0)


def _table(columns: Columns, report: Report, name: Rich, key: str, lead: int) -> Table:
    told = [(f"{head}, {unit}" if unit else head, cells)
            for head, unit, cells in in_heads(columns, report.notation)]  # fmt: skip
    rows = zip(*(cells for _, cells in told), strict=True)
    return Table(tuple(head for head, _ in told), tuple(rows), lead, lead, name=name, key=key)
