"""Texts of a sheet: the statement, the vector equations and the formulas with read segments."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

from planmethod.note.document import Caption, Equations, Formula, GivenFact
from planmethod.note.narrate.equations import equation_of
from planmethod.note.narrate.given import given, unbroken, wanted
from planmethod.note.narrate.letters import direction_text
from planmethod.note.narrate.steps import calculation
from planmethod.render.layout.block import Block, Column, Row, Shapes, heading, paragraph
from planmethod.render.layout.nodes import blocks_of
from planmethod.render.sheets.model import Manner
from planmethod.render.sheets.views import shown_position
from planmethod.solved.solution import Solution

NARROW = 0.7
"""Part of the usual width for a narrower layout of a text."""


def statement_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return "Дано" and "Определить"."""
    facts = given(solution.problem, manner.words, list(solution.positions))
    return stated(facts, manner.words.sheets.wanted.format(wanted=wanted(solution)), manner)


def stated(facts: Sequence[GivenFact], asked: str, manner: Manner, *more: str) -> Block:
    """Return "Дано" with its facts, the task, and further paragraphs, in two widths."""
    height, column = manner.text(manner.sizes.text), manner.width(manner.sizes.column)
    told = unbroken(fact.text for fact in facts)
    texts = [manner.words.note.given.format(given=told), asked, *more]
    ways = []
    for width in (column, NARROW * column):
        lines: list[Block] = [paragraph(text, height, width=width) for text in texts]
        if manner.entry.title:
            lines.insert(0, heading(manner.entry.title, height, width=width))
        ways.append(Column(lines, gap=3.0))
    return Shapes(tuple(ways))


def equations_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the vector equations of a plan, one under another."""
    kind = manner.entry.of
    assert kind is not None
    plan = solution.construction.plan(kind)
    size = manner.text(manner.sizes.text)
    height, width = max(3.5, min(5.0, size)), manner.width(manner.sizes.column)
    title = heading(manner.entry.title or manner.words.sheets["equations"][kind.value], size)
    directed = partial(direction_text, say=manner.words.say)
    equations = Equations(tuple(equation_of(one, directed) for one in plan.equations))
    return Column([title, *blocks_of([equations], height, width=width)], gap=4.0)


def calculation_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return the formulas with the read segments, of one position only."""
    kind = manner.entry.of
    assert kind is not None
    index = shown_position(solution, indices, manner)
    height = manner.text(min(3.5, manner.sizes.text))
    said = manner.words.sheets
    title = manner.entry.title or said["calculation"][kind.value]
    if len(solution.positions) > 1:
        title = said.of_position.format(title=title, number=index)
    lines = map(Formula, calculation(solution, kind, index, manner.words))
    blocks = list(blocks_of([Caption(title), *lines], height))
    whole, half = Column(blocks, gap=2.2), -(-len(blocks) // 2)
    columns = [Column(some, gap=2.2) for some in (blocks[:half], blocks[half:])]
    return Shapes((whole, Row(columns, gap=2.0 * height)))


def text_block(solution: Solution, indices: Sequence[int], manner: Manner) -> Block:
    """Return a text of the composition itself."""
    height, width = manner.text(manner.sizes.text), manner.width(manner.sizes.column)
    lines: list[Block] = [paragraph(manner.entry.text, height, width=width)]
    if manner.entry.title:
        lines.insert(0, heading(manner.entry.title, height, width=width))
    return Column(lines, gap=3.0)
