"""The chapters of a protocol on forces: loads, force plans, Zhukovsky lever (протокол сил)."""

from __future__ import annotations

from msgspec.structs import replace

from planmethod.construct.steps import Name
from planmethod.mechanism.groups import AssurGroup
from planmethod.note.narrate.equations import balance_lines
from planmethod.note.narrate.forces.common import ForceContext
from planmethod.note.narrate.forces.lever import LeverNarrator
from planmethod.note.narrate.forces.loads import LoadNarrator
from planmethod.note.narrate.forces.moments import MomentNarrator
from planmethod.note.narrate.forces.plan import ForcePlanNarrator
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.structure import group_title
from planmethod.note.plaintext import INDENT, WIDTH, Steps
from planmethod.plans.forces.polygons import ForcePlan
from planmethod.plans.model import Known
from planmethod.solved.forces.reading import ForceReading


def tell_forces(text: Steps, say: Formulas, index: int) -> None:
    """Write the chapters on forces of one position.

    Parameters
    ----------
    text : Steps
        Where to write.
    say : Formulas
        Of the position.
    index : int
        Which position.

    Raises
    ------
    AssemblyError
        Where a force plan does not close.
    """
    context = ForceContext(ForceReading(say.solution, index), say)
    context.reading.statics.si  # noqa: B018 - what cannot be drawn is told before anything else
    _loads(text, context)
    _plans(text, context)
    _lever(text, context)


def _loads(text: Steps, context: ForceContext) -> None:
    said, voice = context.said, LoadNarrator(context)
    text.chapter(said.title_loads)
    if context.solution.problem.scales.mu_F is not None:
        text.item([said.scale.format(scale=voice.scale())])
    for link in context.solution.problem.mechanism.links:
        text.item(voice.link(link))


def _plans(text: Steps, context: ForceContext) -> None:
    said, words = context.said, context.words
    text.chapter(said.title_plans)
    titles = [_short(context, group) for group in reversed(context.solution.structure.groups)]
    driver = words.driver.format(link=context.solution.problem.drive.link)
    titles.append(driver[:1].lower() + driver[1:])
    text.item([said.order.format(order=", ".join(titles)), said.indices])
    groups: list[AssurGroup | None] = [*reversed(context.solution.structure.groups), None]
    for number, (plan, group) in enumerate(zip(context.reading.plans, groups, strict=True)):
        text.part(driver if group is None else group_title(group, words))
        _plan(text, context, plan, number)


def _short(context: ForceContext, group: AssurGroup) -> str:
    """Return a group's heading without its class: ``группа 4–5``."""
    title = group_title(group, context.words).partition(" (")[0].partition(":")[0]
    return title[:1].lower() + title[1:]


def _plan(text: Steps, context: ForceContext, plan: ForcePlan, number: int) -> None:
    voice, moments = ForcePlanNarrator(context, plan, number), MomentNarrator(context, plan)
    text.item(voice.freed())
    if voice.is_nothing:
        text.item([context.said.nothing])
        return
    _balances(text, context, plan)
    if not _readable(context, *(end for edge in plan.polygon for end in (edge.tail, edge.head))):
        text.item([context.said.unreadable])
        return
    for lines in moments.before():
        text.item(lines)
    if context.solution.problem.scales.mu_F is None:
        text.item([context.said.own_scale.format(scale=voice.inscription())])
    for lines in voice.steps():
        text.item(lines)
    for lines in moments.guides():
        text.item(lines)


def _readable(context: ForceContext, *names: Name) -> bool:
    """Tell whether the hand has all of what is named: not where it divides by nothing."""
    hand, index = context.reading.statics.by_hand, context.reading.index
    return all(hand.has(name)[index] for name in names)


def _balances(text: Steps, context: ForceContext, plan: ForcePlan) -> None:
    said = context.said
    for balance in plan.balances:
        edges = [
            replace(edge, symbol=context.notation.symbol(edge.symbol))
            for edge in balance.edges
            if edge.known is not Known.BOTH or not context.reading.is_none(edge)
        ]
        template = said.balance_link if len(balance.links) == 1 else said.balance_group
        blank = [] if text.lines[-1] == "" else [""]
        text.lines += [*blank, template.format(links="–".join(balance.links)), ""]
        text.formulas(balance_lines(edges, context.names, WIDTH - len(INDENT)))


def _lever(text: Steps, context: ForceContext) -> None:
    text.chapter(context.said.title_lever)
    if context.reading.statics.lever_plan is None:
        text.item([context.said.stands])
        return
    if not _readable(context, context.reading.statics.lever_plan.balance):
        text.item([context.said.unreadable])
        return
    for lines in LeverNarrator(context).items():
        text.item(lines)
