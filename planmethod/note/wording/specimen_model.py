"""What a language must be able to say on the specimen sheets (слова листов образцов)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class SpecimenWording(Struct, frozen=True, kw_only=True):
    """Words of the specimen sheets in one language, rich text.

    Attributes
    ----------
    standard, clause : str
        A standard, and a clause of it.
    clause_letters : str
        Letters of its paragraphs, for a, b, c.
    course : str
        What stands for the clause of a symbol that the standard does not list.
    cells : mapping
        What the cells show, by the names of `planmethod.render.sheets.specimen.cells.Cell`.
    symbols, sizes_title, sizes : str
        The sheet of symbols: its title, and what its sizes are.
    lines, lines_head, columns_lines, line_names, line_uses
        The sheet of lines: its titles, and the table of the types of lines.
    lettering, kinds, slanted, upright : str
        The sheet of the lettering: its title.
    samples : tuple of str
        Words and formulas in the lettering.
    measured_title, columns_measured, measures
        The table of the measured letters; ``measures`` by their signs.
    """

    standard: str
    clause: str
    clause_letters: str
    course: str
    cells: Mapping[str, str]
    symbols: str
    sizes_title: str
    sizes: tuple[str, ...]
    lines: str
    lines_head: str
    columns_lines: tuple[str, ...]
    line_names: Mapping[str, str]
    line_uses: Mapping[str, str]
    lettering: str
    kinds: Mapping[str, str]
    slanted: str
    upright: str
    samples: tuple[str, ...]
    measured_title: str
    columns_measured: tuple[str, ...]
    measures: Mapping[str, str]
