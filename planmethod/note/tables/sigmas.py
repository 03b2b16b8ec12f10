"""Drafting errors in tables: their cells, the mark of those found by draws."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from planmethod.note.compared import DRAWN, marked
from planmethod.note.document import Node, Paragraph, Table, table_of
from planmethod.note.formula import Rich
from planmethod.note.plaintext import localized
from planmethod.note.rounding import sigma_text

if TYPE_CHECKING:
    from planmethod.note.wording import MessageTable
    from planmethod.solved.errors.spread import Errors
    from planmethod.solved.solution import Solution


class ErrorColumns:
    """Cells of the drafting errors, none where they are not requested.

    Attributes
    ----------
    drawn : bool
        Whether a cell has the mark of a sigma found by random draws.
    """

    def __init__(self, solution: Solution, texts: MessageTable, *, enabled: bool = True) -> None:
        self.solution, self.texts, self.enabled = solution, texts, enabled
        self.drawn = False

    def cell(self, label: str | None, index: int, errors: Errors | None = None) -> list[str]:
        """Return the error of a quantity as a row of one cell, or of none.

        ``errors`` contain it. Default: the kinematic errors. A quantity without a label, shown by
        a dash, also has a dash for its error.
        """
        if not self.enabled:
            return []
        if label is None:
            return ["—"]
        from planmethod.solved.errors.motion import drafting_of

        sigma, mark = marked(errors or drafting_of(self.solution), label, index)
        self.drawn = self.drawn or bool(mark)
        return [localized(sigma_text(sigma), self.texts) + mark]

    def table(
        self,
        head: Sequence[Rich],
        after: Sequence[int],
        rows: Sequence[Sequence[Rich]],
        *,
        names: int = 1,
    ) -> Table:
        """Return a table with the errors behind the columns ``after``: their cells are in the rows.

        The digits of the errors are aligned.
        """
        if not self.enabled:
            return table_of(head, rows, names=names)
        columns: list[Sequence[Rich]] = list(zip(*rows, strict=True))
        wide = list(head)
        for made, k in enumerate(after, 1):
            wide.insert(k + made, self.texts.sigma)
            columns[k + made] = levelled(columns[k + made])
        return table_of(wide, zip(*columns, strict=True), names=names)

    def notes(self) -> Iterator[Node]:
        """Yield what the errors are, and what the mark of some of them means."""
        if not self.enabled:
            return
        name = self.solution.profile.name
        profile = self.texts["profiles"].get(name, name)
        yield Paragraph(self.texts.sigma_note.format(profile=profile))
        if self.drawn:
            yield Paragraph(self.texts.drawn_note)


def levelled(cells: Sequence[str]) -> list[str]:
    """Return cells with space for a mark where another cell of their column has one."""
    some = any(cell.endswith(DRAWN) for cell in cells)
    return [cell + " " if some and not cell.endswith(DRAWN) else cell for cell in cells]
