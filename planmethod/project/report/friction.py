"""The part of the note on friction: circles, corrected reactions, efficiency (учёт трения)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from msgspec.structs import replace

from planmethod.note.document import Node, Part
from planmethod.note.narrate.forces.common import ForceContext
from planmethod.note.narrate.forces.friction import FrictionTeller, headed
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
    tell, reading = FrictionTeller(context, sizes=True), rubbed_reading(report.one, 0)
    said = tell.said
    yield Part(said.title)
    yield sentences(said.order, said.note_sizes)
    yield from chain(
        told for pair in tell.friction.pairs for told in (tell.reach(pair), tell.size(pair))
    )
    figures = [f"\\ref{{friction_{number}}}" for number in range(len(reading.plans))]
    yield sentences(said.see_figures.format(figures=report.listed(figures)))
    for number, plan in enumerate(reading.plans):
        yield figure(
            partial(_picture, report, number),
            said.figure.format(what=plan_title(reading, plan, report.words)),
            f"friction_{number}",
        )
    yield sentences(said.see_table.format())
    table = tell.table()
    head = tuple(map(headed, table.head))
    yield replace(table, head=head, name=said.table, key="friction_table")
    yield sentences(*tell.results(), *tell.turn())


def _picture(report: Report, number: int, letter: float) -> Block:
    return friction_picture(rubbed_reading(report.one, 0), number, letter, report.say)
