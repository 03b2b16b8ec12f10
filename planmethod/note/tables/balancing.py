"""Static balancing in the results and the protocol (таблицы уравновешивания)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Caption, Chapter, Item, Node, table_of_quantities
from planmethod.note.narrate.balancing import BalancingTeller
from planmethod.note.numbers import in_heads
from planmethod.note.wording import Language
from planmethod.solved.solution import Solution


def balancing_tables(solution: Solution, words: Language) -> Iterator[Node]:
    """Yield the counterweights with their numbers, and the main vector by positions."""
    tell = BalancingTeller(solution, words)
    yield Chapter(tell.said.balancing, numbered=False)
    yield from map(Item, tell.lines())
    yield Caption(tell.said.forces_table)
    yield table_of_quantities(in_heads(tell.columns(), tell.say), repeated=2)
