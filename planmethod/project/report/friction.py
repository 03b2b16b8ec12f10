"""The part of the note on friction: circles, corrected reactions, efficiency (учёт трения)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from msgspec.structs import replace

from planmethod.note.document import Node, Part
from planmethod.note.narrate.forces.common import ForceContext
from planmethod.note.narrate.forces.friction import FrictionNarrator, headed
from planmethod.note.narrate.forces.statement import plan_title
from planmethod.note.tables.forces import rubbed
from planmethod.project.report.context import Report, chain, sentences
from planmethod.project.report.figures import figure
from planmethod.render.forces.friction import friction_picture
from planmethod.render.layout.block import Block
from planmethod.solved.forces.friction import rubbed_reading


def friction_part(report: Report, context: ForceContext) -> Iterator[Node]:
    """Yield the friction of the calculated position, and the efficiency of the cycle."""
    if not rubbed(report.one.problem):
        return
    narrator, reading = FrictionNarrator(context, sizes=True), rubbed_reading(report.one, 0)
    texts = narrator.texts
    yield Part(texts.title)
    yield sentences(texts.order, texts.note_sizes)
    yield from chain(
        text
        for pair in narrator.friction.pairs
        for text in (narrator.reach(pair), narrator.size(pair))
    )
    figures = [f"\\ref{{friction_{number}}}" for number in range(len(reading.plans))]
    yield sentences(texts.see_figures.format(figures=report.listed(figures)))
    for number, plan in enumerate(reading.plans):
        yield figure(
            partial(_picture, report, number),
            texts.figure.format(what=plan_title(reading, plan, report.language)),
            f"friction_{number}",
        )
    yield sentences(texts.see_table.format())
    table = narrator.table()
    head = tuple(map(headed, table.head))
    yield replace(table, head=head, name=texts.table, key="friction_table")
    yield sentences(*narrator.results(), *narrator.cycle_lines())


def _picture(report: Report, number: int, letter: float) -> Block:
    return friction_picture(rubbed_reading(report.one, 0), number, letter, report.notation)
