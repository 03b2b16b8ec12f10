"""Texts of a sheet: the statement, the vector equations and the formulas with read segments."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from planmethod.note.document import Caption, Equations, Formula, GivenFact
from planmethod.note.narrate.equations import equation_of
from planmethod.note.narrate.letters import direction_text
from planmethod.note.narrate.statement import given_facts, motion_unknowns, unbroken
from planmethod.note.narrate.steps import calculation
from planmethod.render.layout.block import Alternatives, Block, Column, Row, heading, paragraph
from planmethod.render.layout.nodes import blocks_of
from planmethod.render.sheets.model import BlockStyle
from planmethod.render.sheets.views import shown_position
from planmethod.solved.solution import Solution

NARROW = 0.7
"""Part of the usual width for a narrower layout of a text."""


def statement_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return "Дано" and "Определить"."""
    facts = given_facts(solution.problem, style.language, list(solution.positions))
    return stated(
        facts, style.language.sheets.wanted.format(wanted=motion_unknowns(solution)), style
    )


def stated(facts: Sequence[GivenFact], task: str, style: BlockStyle, *more: str) -> Block:
    """Return "Дано" with its facts, the task, and further paragraphs, in two widths."""
    height, column = style.text(style.sizes.text), style.width(style.sizes.column)
    told = unbroken(fact.text for fact in facts)
    texts = [style.language.note.given.format(given=told), task, *more]
    ways = []
    for width in (column, NARROW * column):
        lines: list[Block] = [paragraph(text, height, width=width) for text in texts]
        if style.entry.title:
            lines.insert(0, heading(style.entry.title, height, width=width))
        ways.append(Column(lines, gap=3.0))
    return Alternatives(tuple(ways))


def equations_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the vector equations of a plan, one under another."""
    kind = style.entry.of
    assert kind is not None
    plan = solution.construction.plan(kind)
    size = style.text(style.sizes.text)
    height, width = max(3.5, min(5.0, size)), style.width(style.sizes.column)
    title = heading(style.entry.title or style.language.sheets["equations"][kind.value], size)
    directed = partial(direction_text, say=style.language.notation)
    equations = Equations(tuple(equation_of(one, directed) for one in plan.equations))
    return Column([title, *blocks_of([equations], height, width=width)], gap=4.0)


def calculation_block(
    solution: Solution, position_indices: Sequence[int], style: BlockStyle
) -> Block:
    """Return the formulas with the read segments, of one position only."""
    kind = style.entry.of
    assert kind is not None
    index = shown_position(solution, position_indices, style)
    height = style.text(min(3.5, style.sizes.text))
    texts = style.language.sheets
    title = style.entry.title or texts["calculation"][kind.value]
    if len(solution.positions) > 1:
        title = texts.of_position.format(title=title, number=index)
    lines = map(Formula, calculation(solution, kind, index, style.language))
    blocks = list(blocks_of([Caption(title), *lines], height))
    whole, half = Column(blocks, gap=2.2), -(-len(blocks) // 2)
    columns = [Column(some, gap=2.2) for some in (blocks[:half], blocks[half:])]
    return Alternatives((whole, Row(columns, gap=2.0 * height)))


def text_block(solution: Solution, position_indices: Sequence[int], style: BlockStyle) -> Block:
    """Return a text of the composition itself."""
    height, width = style.text(style.sizes.text), style.width(style.sizes.column)
    lines: list[Block] = [paragraph(style.entry.text, height, width=width)]
    if style.entry.title:
        lines.insert(0, heading(style.entry.title, height, width=width))
    return Column(lines, gap=3.0)
