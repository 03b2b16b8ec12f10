"""The chapters of a protocol on forces: loads, force plans, Zhukovsky lever (протокол сил)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from planmethod.construct.steps import Name
from planmethod.mechanism.groups import AssurGroup
from planmethod.note.document import (
    Caption,
    Chapter,
    Equations,
    Node,
    Part,
    Step,
    step_of,
)
from planmethod.note.narrate.equations import direction_note
from planmethod.note.narrate.forces.bearings import undetermined
from planmethod.note.narrate.forces.common import ForceContext, balance_equation, closed
from planmethod.note.narrate.forces.lever import LeverNarrator, thrust_lines
from planmethod.note.narrate.forces.loads import LoadNarrator
from planmethod.note.narrate.forces.moments import MomentNarrator
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.structure import group_title, links_of_group
from planmethod.plans.forces.polygons import ForcePlan
from planmethod.solved.forces.reading import ForceReading


def force_chapters(formulas: Formulas, index: int) -> Iterator[Node]:
    """Yield the chapters on forces of one position.

    Parameters
    ----------
    formulas : Formulas
        Of the position.
    index : int
        Which position.

    Raises
    ------
    AssemblyError
        Where a force plan does not close.
    """
    context = ForceContext(ForceReading(formulas.solution, index), formulas)
    context.reading.statics.si  # noqa: B018 - report first what cannot be drawn
    yield from _loads(context)
    yield from _plans(context)
    yield from _lever(context)
    dynamics = formulas.solution.problem.dynamics
    if dynamics is not None and dynamics.friction is not None:
        yield from _friction(context, formulas)


def _loads(context: ForceContext) -> Iterator[Node]:
    texts, voice = context.texts, LoadNarrator(context)
    yield Chapter(texts.title_loads)
    if context.solution.problem.scales.mu_F is not None:
        yield Step((texts.scale.format(scale=voice.scale()),))
    for link in context.solution.problem.mechanism.links:
        yield Step(tuple(voice.link(link)))


def _plans(context: ForceContext) -> Iterator[Node]:
    said, words = context.texts, context.note_texts
    yield Chapter(said.title_plans)
    groups: list[AssurGroup | None] = [*reversed(context.solution.structure.groups), None]
    driver = words.driver.format(link=context.solution.problem.drive.link)
    titles = [driver if group is None else links_of_group(group, words) for group in groups]
    frame = context.solution.problem.mechanism.frame
    order = ", ".join(title[:1].lower() + title[1:] for title in titles)
    dyads = [group for group in groups if group is not None]
    lines = (said.order.format(order=order), said.indices.format(frame=frame))
    found = thrust_lines(context)
    yield Step((*lines, *found, *([undetermined(dyads, words)] if dyads else [])))
    for number, (plan, group) in enumerate(zip(context.reading.plans, groups, strict=True)):
        yield Part(driver if group is None else group_title(group, words))
        yield from _plan(context, plan, number)


def _plan(context: ForceContext, plan: ForcePlan, number: int) -> Iterator[Node]:
    voice, moments = ForcePlanNarrator(context, plan, number), MomentNarrator(context, plan)
    yield Step(tuple(voice.freed()))
    if voice.is_unloaded:
        yield Step((context.texts.nothing,))
        return
    yield from _balances(context, plan)
    if not _readable(context, *(end for edge in plan.polygon for end in (edge.tail, edge.head))):
        yield Step((context.texts.unreadable,))
        return
    for lines in moments.before():
        yield from step_of(lines)
    if context.solution.problem.scales.mu_F is None:
        yield Step((context.texts.own_scale.format(scale=voice.inscription()),))
    for lines in (*voice.steps(), *moments.guides()):
        yield from step_of(lines)


def _readable(context: ForceContext, *names: Name) -> bool:
    """Return whether the hand has all named values: not where it divides by zero."""
    hand, index = context.reading.statics.ruler_reading, context.reading.index
    return all(hand.has(name)[index] for name in names)


def _balances(context: ForceContext, plan: ForcePlan) -> Iterator[Node]:
    texts, directed = context.texts, partial(direction_note, context.names)
    for balance in plan.balances:
        template = texts.balance_link if len(balance.links) == 1 else texts.balance_group
        yield Caption(template.format(links="–".join(balance.links)))
        yield Equations((balance_equation(balance, context, directed),))


def _lever(context: ForceContext) -> Iterator[Node]:
    yield Chapter(context.texts.title_lever)
    lever = context.reading.statics.lever_at(context.reading.index)
    if lever is None:
        yield Step((context.texts.stands,))
    elif not _readable(context, lever.balance):
        yield Step((context.texts.unreadable,))
    else:
        for lines in LeverNarrator(context).items():
            yield from step_of(lines)


def _friction(context: ForceContext, formulas: Formulas) -> Iterator[Node]:
    """Yield the friction of the pairs, and the force plans with one correction."""
    from planmethod.note.narrate.forces.friction import FrictionNarrator  # few need it
    from planmethod.solved.forces.friction import rubbed_reading

    narrator, texts = FrictionNarrator(context), context.note_texts
    yield Chapter(narrator.texts.title)
    yield Step((narrator.texts.order, *closed(narrator.given_lines())))
    for pair in narrator.friction.pairs:
        yield Step((narrator.pair(pair),))
    corrected = ForceContext(rubbed_reading(context.solution, context.reading.index), formulas)
    driver = texts.driver.format(link=context.solution.problem.drive.link)
    yield Chapter(narrator.texts.corrected)
    groups: list[AssurGroup | None] = [*reversed(context.solution.structure.groups), None]
    for number, (plan, group) in enumerate(zip(corrected.reading.plans, groups, strict=True)):
        yield Part(driver if group is None else group_title(group, texts))
        yield from _plan(corrected, plan, number)
    yield Part(narrator.texts.results)
    yield from (Step((line,)) for line in (*narrator.results(), *narrator.cycle_lines()))
