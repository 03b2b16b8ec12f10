"""A variant as a question: its data, the scheme, the requested items (вариант как вопрос)."""

from __future__ import annotations

from typing import Any

from planmethod.check.exchange.cloze import QuizQuestion
from planmethod.check.exchange.quiz import quiz_of
from planmethod.check.task import Task
from planmethod.kind import ProblemKind
from planmethod.note.narrate.forces.statement import statement
from planmethod.note.narrate.statement import drawn, given_facts
from planmethod.note.wording import Language
from planmethod.problem.model import Problem
from planmethod.render.backends import Options, render
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sketch import assigned
from planmethod.solved.forces.reading import ForceReading

DPI = 110.0
"""About 800 dots across a scheme: read on a screen, some ten kilobytes."""


def question_of(task: Task, kind: ProblemKind[Any] | None, language: Language) -> QuizQuestion:
    """Return a variant as a question; its kind is None for a linkage."""
    problem = task.problem
    drawing: Drawing | None
    if kind is None:
        assert isinstance(problem, Problem)
        facts = [drawn(problem, language), *given_facts(problem, language)]
        if problem.dynamics is not None:
            known = {fact.text.partition(" = ")[0] for fact in facts}
            loaded = statement(ForceReading(task.solution, task.first), language)
            facts += [fact for fact in loaded if fact.text.partition(" = ")[0] not in known]
        drawing = assigned(task.solution)
    else:
        facts = kind.given_facts(problem, language)
        drawing = kind.scheme(problem)
    parts = tuple(quiz_of(task, language))
    used = {"mu_l", *(part.entry.scale for part in parts)}
    scales = task.scales({}, task.first) if kind is None else {}
    return QuizQuestion(
        problem.title or problem.name,
        task.variant,
        tuple(facts),
        {name: per_mm for name, per_mm in scales.items() if name in used},
        parts,
        render(drawing, "png", options=Options(dpi=DPI)) if drawing is not None else b"",
    )
