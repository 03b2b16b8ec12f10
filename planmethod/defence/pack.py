"""A pack of questions for one student, drawn by a seed (комплект вопросов)."""

from __future__ import annotations

import random
from collections.abc import Mapping
from itertools import zip_longest
from types import MappingProxyType

from msgspec import Struct
from msgspec.structs import replace

from planmethod.defence import (
    balancing,
    cams,
    forces,
    kinematics,
    machine,
    points,
    structure,
    trains,
    turn,
    wheels,
)
from planmethod.defence.case import Case, Template
from planmethod.defence.model import Answer, ChoiceAnswer, Instance, Question, Subject
from planmethod.errors import ArgumentError
from planmethod.note.accounts.voice import lettered
from planmethod.note.wording import MessageTable
from planmethod.project.settle import Project

SUBJECTS: Mapping[Subject, Mapping[str, Template]] = MappingProxyType(
    {
        Subject.STRUCTURE: structure.TEMPLATES,
        Subject.SYNTHESIS: machine.SYNTHESES,
        Subject.KINEMATICS: {**kinematics.TEMPLATES, **turn.TEMPLATES},
        Subject.FORCES: forces.TEMPLATES,
        Subject.FLYWHEEL: machine.FLYWHEELS,
        Subject.BALANCING: balancing.TEMPLATES,
        Subject.GEARS: trains.TEMPLATES,
        Subject.MESHING: wheels.TEMPLATES,
        Subject.CAM: cams.TEMPLATES,
        Subject.POINT: points.TEMPLATES,
    }
)
"""Templates of the questions, by subjects."""

OF_LINKAGE = (Subject.STRUCTURE, Subject.KINEMATICS, Subject.FORCES)
"""Subjects that need a linkage with plans."""

USUAL = 50
"""Usual number of questions of a pack."""

MOST = 3
"""Most questions of one template in a pack."""


class Candidate(Struct, frozen=True):
    """A question that a pack may have (возможный вопрос)."""

    subject: Subject
    key: str
    instance: Instance


def draw_pack(case: Case, *, seed: int = 0, count: int | None = None) -> list[Question]:
    """Return the questions of a pack, by subjects.

    Each template is used once before one is used again. No text has the answer of another question.

    Parameters
    ----------
    seed : int
        Of the draw: the same one gives the same pack.
    count : int, optional
        Number of questions. Default: one of each template, and more up to `USUAL`.

    Raises
    ------
    ArgumentError
        The work gives fewer questions, or none.
    """
    draw = random.Random(seed)
    pools = _pools(case, draw)
    chosen: list[Candidate] = []
    for repeat in range(MOST):
        wanted = count if count is not None else USUAL if repeat else None
        for pool in pools:
            if wanted is not None and len(chosen) >= wanted:
                break
            one = next((one for one in pool if _is_free(one, chosen)), None)
            if one is not None:
                chosen.append(one)
    if not chosen:
        raise ArgumentError(
            "{} gives no questions. Use the file of a linkage, a gear train, two wheels in mesh, "
            "a cam or a moving point.",
            case.work.problem.source_file or case.work.problem.name,
        )
    if count is not None and len(chosen) < count:
        raise ArgumentError(
            "{} questions are requested, and this work gives {}. Request at most that many.",
            count,
            len(chosen),
        )
    order = [(subject, key) for subject, table in SUBJECTS.items() for key in table]
    chosen.sort(key=lambda one: order.index((one.subject, one.key)))
    return [_written(one, case, draw) for one in chosen]


def _pools(case: Case, draw: random.Random) -> list[list[Candidate]]:
    """Return the candidates of each template, templates of all subjects by turns."""
    found: list[list[list[Candidate]]] = []
    for subject, templates in SUBJECTS.items():
        if subject in OF_LINKAGE and not isinstance(case.work, Project):
            continue
        pools = [[Candidate(subject, key, one) for one in ask(case)]
                 for key, ask in templates.items()]  # fmt: skip
        for pool in pools:
            draw.shuffle(pool)
        draw.shuffle(pools)
        found.append(pools)
    return [pool for row in zip_longest(*found, fillvalue=[]) for pool in row if pool]


def _is_free(one: Candidate, chosen: list[Candidate]) -> bool:
    """Return whether a question is new, and no text has the answer of another question.

    The second choice of one template must have another right option.
    """
    for other in chosen:
        if (one.subject, one.key) == (other.subject, other.key):
            if one.instance.about == other.instance.about:
                return False
            if _same_choice(one.instance.answer, other.instance.answer):
                return False
        used = {other.instance.states, other.instance.requests} - {""}
        if one.instance.requests in used:
            return False
        if one.instance.states and one.instance.states == other.instance.requests:
            return False
    return True


def _same_choice(first: Answer, second: Answer) -> bool:
    if not isinstance(first, ChoiceAnswer) or not isinstance(second, ChoiceAnswer):
        return False
    return first.right == second.right


def _written(one: Candidate, case: Case, draw: random.Random) -> Question:
    """Return a candidate as a question, its options in the order in which they are offered."""
    instance = one.instance
    words: MessageTable = case.texts[one.subject.value][one.key]
    answer = instance.answer
    if isinstance(answer, ChoiceAnswer):
        options = dict(answer.options) or {
            key: lettered(text.format(**instance.facts)) for key, text in words["options"].items()
        }
        keys = [*options]
        draw.shuffle(keys)
        answer = replace(answer, options={key: options[key] for key in keys})
    return Question(
        one.subject,
        one.key,
        instance.about,
        lettered(words.ask.format(**instance.facts)),
        answer,
        lettered(words.why.format(**instance.facts)),
        instance.place,
    )
