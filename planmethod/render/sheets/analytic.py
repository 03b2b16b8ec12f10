"""Block of the analytic method: contours, projections, derivatives (аналитический метод)."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby, pairwise

from planmethod.note.accounts.analytic import AnalyticAccount
from planmethod.note.accounts.voice import SHEET
from planmethod.note.document import Caption
from planmethod.render.layout.block import Alternatives, Block, Column, Row, heading
from planmethod.render.layout.text_blocks import TextNode, blocks_of
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import shown_position
from planmethod.solved.solution import Solution

LARGER = {2.5: 3.5, 3.5: 5.0}
"""Heights of headings by those of formulas, mm."""

COLUMNS = (1, 2, 3, 4, 5, 6)
"""Numbers of columns to try for the formulas of the analytic method."""


def analytic_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return the analytic method of one position: contours, projections, derivatives."""
    index, language = shown_position(solution, position_indices, style), style.language
    height, width = style.text(min(3.5, style.sizes.text)), style.width(style.sizes.column)
    title = style.entry.title or language.analytic.title
    if len(solution.positions) > 1:
        title = language.sheets.of_position.format(title=title, number=index)
    account = AnalyticAccount(solution, index, language, SHEET)
    blocks: list[Block] = []
    captions: set[int] = set()
    for is_caption, group in groupby(account.nodes(), lambda node: isinstance(node, Caption)):
        if is_caption:
            captions.add(len(blocks))
            heads = (node.text for node in group if isinstance(node, Caption))
            blocks += [heading(text, LARGER.get(height, height)) for text in heads]
            continue
        nodes = [node for node in group if isinstance(node, TextNode)]
        blocks += blocks_of(nodes, height, width=width)
    head = heading(title, LARGER.get(height, height))
    ways = []
    for count in COLUMNS:
        each = -(-len(blocks) // count)
        # A heading goes on to the column of its first formula.
        cuts = [*(k - (k - 1 in captions) for k in range(0, len(blocks), each)), len(blocks)]
        parts = [Column(blocks[k:end], gap=2.2) for k, end in pairwise(cuts)]
        ways.append(Column([head, Row(parts, gap=2.0 * height)], gap=2.2))
    return Alternatives(tuple(ways))
