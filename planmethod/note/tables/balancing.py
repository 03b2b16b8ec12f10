"""Static balancing in the results and the protocol (таблицы уравновешивания)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Caption, Chapter, Item, Node, table_of_quantities
from planmethod.note.narrate.balancing import BalancingNarrator
from planmethod.note.numbers import in_heads
from planmethod.note.wording import Language
from planmethod.solved.solution import Solution


def balancing_tables(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the counterweights with their numbers, and the main vector by positions."""
    narrator = BalancingNarrator(solution, language)
    yield Chapter(narrator.texts.balancing, numbered=False)
    yield from map(Item, narrator.lines())
    yield Caption(narrator.texts.forces_table)
    yield table_of_quantities(in_heads(narrator.columns(), narrator.notation), repeated=2)
