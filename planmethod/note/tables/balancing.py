"""Static balancing for the terminal and the protocol (таблицы уравновешивания)."""

from __future__ import annotations

from planmethod.note.narrate.balancing import BalancingTeller
from planmethod.note.plaintext import columns_text, heading, plain_columns, plain_text, wrap
from planmethod.note.wording import Words, language
from planmethod.solved.solution import Solution


def balancing_tables(solution: Solution, words: Words) -> list[str]:
    """Return the counterweights with their numbers, and the main vector by positions."""
    tell = BalancingTeller(solution, language(words.lang))
    lines = [*heading(plain_text(tell.said.balancing)), ""]
    for line in tell.lines():
        lines += wrap(plain_text(line), rest="  ")
    columns = list(plain_columns(tell.columns(), tell.say))
    return [*lines, "", plain_text(tell.said.forces_table), "", *columns_text(columns, lead=2)]
