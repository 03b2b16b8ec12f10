"""Formulas with numbers beside a plan: what a student computes from the segments he read."""

from __future__ import annotations

from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.steps import Narrator
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.solved.solution import Solution


def calculation(solution: Solution, kind: PlanKind, index: int, words: Language) -> list[str]:
    """Return the formulas of one plan in one position as rich text (расчёт к плану).

    One a line, in the order in which each becomes known: those that a protocol has.
    """
    narrator = Narrator(solution, Names(solution, words.note, on_sheet=True), index)
    sections = (section for section in solution.construction.sections if section.kind is kind)
    lines = (
        line for section in sections for step in section.steps for line in narrator.write(step)
    )
    return [line.rstrip(".") for line in lines]
