"""The theory that a note has on request: definitions, cases of motion, further forms of formulas.

A case of motion that no link of the mechanism has is left out (краткая теория записки).
"""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.mechanism.model import FRAME
from planmethod.mechanism.structure import MotionKind, kind_of_motion, pairs
from planmethod.note.accounts.voice import displayed, sentences
from planmethod.note.document import Node, Part
from planmethod.note.formula import Rich
from planmethod.note.narrate.structure import pair_classes, signed
from planmethod.note.wording import MessageTable
from planmethod.project.report.context import Report, items


def has_theory(report: Report) -> bool:
    """Return whether the file requests it."""
    task = report.one.problem.project
    return task is not None and task.theory


def counted_links(report: Report) -> Iterator[Node]:
    """Yield Chebyshev's formula by the number of all links, the frame included."""
    if not has_theory(report):
        return
    structure, problem = report.one.structure, report.one.problem
    counts = {"k": structure.moving_links + 1, "w": signed(structure.mobility)}
    low, high = structure.lower_pairs, structure.higher_pairs
    yield sentences(report.texts["theory"].links.format(**counts))
    classes = pair_classes(problem.sheet.notation, report.language)
    formula = report.texts["theory"].links_formula
    yield displayed(formula.format(low=low, high=high, **counts, **classes))


def composition(report: Report) -> Iterator[Node]:
    """Yield the composition of the mechanism: the primary mechanism and the Assur groups."""
    if not has_theory(report):
        return
    texts: MessageTable = report.texts["theory"]
    problem, groups = report.one.problem, report.one.structure.groups
    ends = {FRAME, problem.mechanism.driver}
    kind = next(pair.kind for pair in pairs(problem.mechanism) if set(pair.links) == ends)
    group = [texts.group.format(number=k) for k in range(1, len(groups) + 1)]
    primary = str(texts["primary"][kind.value]).format()
    named = [
        texts.named.format(group=name, links="–".join(one.links))
        for name, one in zip(group, groups, strict=True)
    ]
    yield sentences(texts.composition.format(primary=primary))
    yield displayed(f"M = {' + '.join([primary, *group])},")
    yield sentences(texts.where.format(named=", ".join(named)))


def definitions(report: Report) -> Iterator[Node]:
    """Yield the definitions of the plans, and the rules for each case of motion."""
    if not has_theory(report):
        return
    texts: MessageTable = report.texts["theory"]
    mechanism = report.one.problem.mechanism
    motions = {row.motion for row in kind_of_motion(mechanism)}
    cases: list[Rich] = [
        str(texts["motion"][kind.value]).format() for kind in MotionKind if kind in motions
        and kind is not MotionKind.FIXED
    ]  # fmt: skip
    if any(FRAME not in (pair.slider, pair.host) for pair in mechanism.prismatics):
        cases.append(texts.sliding.format())
    yield Part(texts.part.format())
    yield sentences(texts.plan.format(), texts.rates.format())
    yield sentences(texts.cases.format())
    yield from items(cases)
    yield sentences(texts.similarity.format())
