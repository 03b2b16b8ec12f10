"""Nodes of a document as blocks of a sheet (блоки текста)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import TypeAlias, assert_never

from planmethod.note.document import Caption, Equations, Formula, Item, Note, Paragraph
from planmethod.render.layout.block import Block, heading, paragraph
from planmethod.render.layout.equations import equation_block, formula_block

TextNode: TypeAlias = Caption | Paragraph | Item | Note | Formula | Equations
"""Nodes of a text column; tables and figures are set by their own blocks."""


def blocks_of(
    nodes: Iterable[TextNode], height: float = 3.5, *, width: float | None = None
) -> Iterator[Block]:
    """Yield texts, formulas and equations as blocks, as wide as ``width`` mm at most."""
    for node in nodes:
        match node:
            case Caption(text):
                yield heading(text, height)
            case Paragraph(text) | Item(text) | Note(text):
                yield paragraph(text, height, width)
            case Formula(text):
                yield formula_block(text, height, width=width)
            case Equations(equations):
                yield from (equation_block(one, height, width=width) for one in equations)
            case _:
                assert_never(node)
