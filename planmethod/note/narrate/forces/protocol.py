"""The chapters of a protocol on forces: loads, force plans, Zhukovsky lever (протокол сил)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from planmethod.construct.steps import Name
from planmethod.mechanism.groups import AssurGroup
from planmethod.note.narrate.equations import balance_lines
from planmethod.note.narrate.forces.common import Telling
from planmethod.note.narrate.forces.lever import LeverVoice
from planmethod.note.narrate.forces.loads import LoadVoice
from planmethod.note.narrate.forces.moments import MomentVoice
from planmethod.note.narrate.forces.plan import ForceVoice
from planmethod.note.narrate.formulas import Formulas
from planmethod.note.narrate.numbered import INDENT, Steps
from planmethod.note.narrate.structure import group_title
from planmethod.note.plaintext import WIDTH
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
    telling = Telling(ForceReading(say.solution, index), say)
    telling.reading.statics.si  # noqa: B018 - what cannot be drawn is told before anything else
    _loads(text, telling)
    _plans(text, telling)
    _lever(text, telling)


def _loads(text: Steps, telling: Telling) -> None:
    said, voice = telling.said, LoadVoice(telling)
    text.chapter(said.title_loads)
    text.item([said.scale.format(scale=voice.scale())])
    for link in telling.solution.problem.mechanism.links:
        text.item(voice.link(link))


def _plans(text: Steps, telling: Telling) -> None:
    said, words = telling.said, telling.words
    text.chapter(said.title_plans)
    titles = [_short(telling, group) for group in reversed(telling.solution.structure.groups)]
    driver = words.driver.format(link=telling.solution.problem.drive.link)
    titles.append(driver[:1].lower() + driver[1:])
    text.item([said.order.format(order=", ".join(titles)), said.indices])
    groups: list[AssurGroup | None] = [*reversed(telling.solution.structure.groups), None]
    for number, (plan, group) in enumerate(zip(telling.reading.plans, groups, strict=True)):
        text.part(driver if group is None else group_title(group, words))
        _plan(text, telling, plan, number)


def _short(telling: Telling, group: AssurGroup) -> str:
    """Return a group's heading without its class: ``группа 4–5``."""
    title = group_title(group, telling.words).partition(" (")[0].partition(":")[0]
    return title[:1].lower() + title[1:]


def _plan(text: Steps, telling: Telling, plan: ForcePlan, number: int) -> None:
    voice, moments = ForceVoice(telling, plan, number), MomentVoice(telling, plan)
    text.item(voice.freed())
    if voice.is_nothing:
        text.item([telling.said.nothing])
        return
    _balances(text, telling, plan)
    if not _readable(telling, *(end for edge in plan.polygon for end in (edge.tail, edge.head))):
        text.item([telling.said.unreadable])
        return
    for lines in moments.before():
        text.item(lines)
    for lines in voice.steps():
        text.item(lines)
    for lines in moments.guides():
        text.item(lines)


def _readable(telling: Telling, *names: Name) -> bool:
    """Tell whether the hand has all of what is named: not where it divides by nothing."""
    reading = telling.reading
    columns = (np.ravel(reading.statics.by_hand.value[name]) for name in names)
    return all(np.isfinite(c[reading.index if c.size > 1 else 0]) for c in columns)


def _balances(text: Steps, telling: Telling, plan: ForcePlan) -> None:
    said = telling.said
    for balance in plan.balances:
        edges = [
            replace(edge, symbol=telling.notation.symbol(edge.symbol))
            for edge in balance.edges
            if edge.known is not Known.BOTH or not telling.reading.is_none(edge)
        ]
        template = said.balance_link if len(balance.links) == 1 else said.balance_group
        blank = [] if text.lines[-1] == "" else [""]
        text.lines += [*blank, template.format(links="–".join(balance.links)), ""]
        text.formulas(balance_lines(edges, telling.names, WIDTH - len(INDENT)))


def _lever(text: Steps, telling: Telling) -> None:
    text.chapter(telling.said.title_lever)
    if telling.reading.statics.hung is None:
        text.item([telling.said.stands])
        return
    if not _readable(telling, telling.reading.statics.hung.balance):
        text.item([telling.said.unreadable])
        return
    for lines in LeverVoice(telling).items():
        text.item(lines)
