"""Rules that select the assembly mode of a group (правила сборки).

The score of a mode under a rule, the rule's text in the file, and its faults.
"""

# no messages: rules, in the words of the file

from __future__ import annotations

from typing import TypeAlias, assert_never

import numpy as np
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import Prismatic, Revolute
from planmethod.plans.draft import Draft, cis
from planmethod.plans.motion.position import (
    outer_point,
    parallelogram,
)
from planmethod.problem.model import AssemblyRelation, Problem, Rule
from planmethod.problem.names import format_length, format_place
from planmethod.solved.reading import Complexes, Reading, Reals

Tried: TypeAlias = tuple[Draft, Reading]
"""An assembly mode of a group, and its reading."""

TIE = 1e-9
"""Fraction of the mechanism's size below which two modes are the same."""


def late_fault(rule: Rule, draft: Draft) -> Fault | None:
    """Return the fault of a rule that compares with a point which is placed only later."""
    missing = [name for name in rule.refs if name not in draft.marked]
    if not missing:
        return None
    return Fault(
        f"assembly.{rule.point}",
        translate(
            "{} is placed after {}, so it cannot determine its place",
            translate(" and ").join(missing),
            rule.point,
        ),
        "Compare with a fixed point or with one that an earlier group places",
    )


def unkept_fault(problem: Problem, rule: Rule, group: AssurGroup) -> Fault | None:
    """Return the fault of a rule with a ``keep`` that its group cannot keep."""
    path, links = f"assembly.{rule.point}.keep", ", ".join(group.links)
    if rule.continuous and group.signature == "RPR":
        return Fault(
            path,
            translate("links {} close by a slotted link, which keeps its side", links),
            'Leave keep = "continuous" out',
        )
    if rule.relation is not AssemblyRelation.PARALLEL:
        return None
    found = parallelogram(problem, group) if group.signature == "RRR" else None
    if found is None:
        return Fault(
            path,
            translate("links {} are not two sides of a quadrilateral of four joints", links),
            'Leave keep = "parallel" out, and give a rule for the assembly that is meant',
        )
    if found.is_one:
        return None
    phrase = "; ".join(
        translate(
            "{} = {} and {} = {}",
            one,
            format_length(a, problem.unit, 10),
            two,
            format_length(b, problem.unit, 10),
        )
        for (one, a), (two, b) in (found.sides[:2], found.sides[2:])
    )
    return Fault(
        path,
        translate("the opposite sides of a parallelogram are equal, but here {}", phrase),
        'Correct the lengths, or give keep = "continuous" with a rule for the '
        "assembly that is meant",
    )


def score_of(rule: Rule, draft: Draft, reading: Reading) -> Reals:
    """Return the score of a mode under a rule, m or m²: satisfied if > 0, the larger the better."""

    def at(name: str) -> Complexes:
        return reading.point(PointName(name))

    p = at(rule.point)
    match rule.relation:
        case AssemblyRelation.RIGHT:
            return np.asarray((p - at(rule.refs[0])).real)
        case AssemblyRelation.LEFT:
            return np.asarray((at(rule.refs[0]) - p).real)
        case AssemblyRelation.ABOVE:
            return np.asarray((p - at(rule.refs[0])).imag)
        case AssemblyRelation.BELOW:
            return np.asarray((at(rule.refs[0]) - p).imag)
        case AssemblyRelation.LEFT_OF | AssemblyRelation.RIGHT_OF:
            start, end = at(rule.refs[0]), at(rule.refs[1])
            left = ((end - start).conjugate() * (p - start)).imag / abs(end - start)
            return np.asarray(left if rule.relation is AssemblyRelation.LEFT_OF else -left)
        case AssemblyRelation.TOWARDS | AssemblyRelation.AWAY:
            end, start = at(rule.refs[0]), at(rule.refs[1])
            ahead = ((end - start).conjugate() * (p - start)).real / abs(end - start)
            return np.asarray(ahead if rule.relation is AssemblyRelation.TOWARDS else -ahead)
        case AssemblyRelation.NEAR:
            return np.asarray(-abs(p - (rule.at - draft.origin)))
        case AssemblyRelation.PARALLEL:
            return np.full(np.shape(p), np.nan)  # which of the sides it is changes with the crank
        case _:
            assert_never(rule.where)


def rule_text(rule: Rule, unit: str) -> str:
    """Return a rule in the words of the file: ``C right of B``, ``C left of AD``."""
    match rule.relation:
        case AssemblyRelation.NEAR:
            return translate("{} near [{}]", rule.point, format_place(rule.at, unit))
        case AssemblyRelation.PARALLEL:
            return translate("{} keep parallel", rule.point)
        case AssemblyRelation.TOWARDS | AssemblyRelation.AWAY:
            return f"{rule.point} {rule.relation.value} {rule.refs[0]}"
        case AssemblyRelation.ABOVE | AssemblyRelation.BELOW:
            words = rule.relation.value
        case _:
            words = f"{rule.relation.value.removesuffix(' of')} of"
    return f"{rule.point} {words} {''.join(rule.refs)}"


def ambiguous_fault(rule: Rule, both: list[Tried], index: int, location: str) -> Fault:
    """Return the fault of a rule that both modes satisfy, with rules that distinguish them."""
    draft = both[0][0]
    unit = draft.problem.unit
    places = [
        format_place(complex(reading.point(PointName(rule.point))[index]) + draft.origin, unit)
        for _, reading in both
    ]
    told = distinguishing_rules(rule.point, both, slice(index, index + 1))
    words = told or [f"{{ near = [{place}] }}" for place in places]
    return Fault(
        f"assembly.{rule.point}",
        translate(
            "'{}' holds for both assemblies at {}: with {} at ({}) and at ({}) {}",
            rule_text(rule, unit),
            location,
            rule.point,
            *places,
            translate(unit),
        ),
        translate("Give '{}' for the first or '{}' for the second", words[0], words[1]),
        tuple(told),
    )


def distinguishing_rules(point: str, both: list[Tried], rows: slice) -> list[str]:
    """Return the rules, one for each mode, that separate them most in the given positions.

    Empty if there is none, with a point that does not depend on the mode or a line through two such
    points.
    """

    def at(reading: Reading, name: str) -> Complexes:
        return reading.point(PointName(name))[rows]

    def smallest(first: Complexes, second: Complexes) -> float:
        sides = np.minimum(first.real, second.real)
        return float(np.nanmin(sides)) if np.isfinite(sides).any() else 0.0

    (draft, one), (_, two) = both
    c, d = at(one, point), at(two, point)
    still = [
        p
        for p in sorted(draft.marked)
        if p != point and np.array_equal(at(one, p), at(two, p), equal_nan=True)
    ]
    ways = (("right of", "left of", 1), ("above", "below", -1j))
    told = [
        (width, f"{more} {p}", f"{less} {p}")
        for p in still
        for first, second, turn in ways
        for more, less, sign in ((first, second, turn), (second, first, -turn))
        if (width := smallest((c - at(one, p)) * sign, (at(one, p) - d) * sign)) > 0
    ]
    # No point is between them: a line through two points may be.
    told = told or [
        (width, f"left of {p}{q}", f"right of {p}{q}")
        for p in still
        for q in still
        if (along := at(one, q) - at(one, p)).all()
        and (width := smallest((c - at(one, p)) / along / 1j, (at(one, p) - d) / along / 1j)) > 0
    ]
    return list(max(told, key=lambda pair: pair[0])[1:]) if told else []


def _outer(problem: Problem, group: AssurGroup, point: str) -> str | None:
    """Return the outer joint of a group on the link that a point belongs to."""
    for lead in group.legs:
        if isinstance(lead.joint, Revolute) and point in problem.bodies[lead.link].points:
            return lead.joint.point
    return None


def from_joint(problem: Problem, group: AssurGroup, rule: Rule) -> Rule:
    """Return a rule of direction from a joint with that joint added after its points."""
    if rule.relation not in (AssemblyRelation.TOWARDS, AssemblyRelation.AWAY):
        return rule
    joint = _outer(problem, group, rule.point)
    if joint is None or joint in (rule.point, *rule.refs):
        hint = "Compare with another point: right of, left of, above, below"
        phrase = rule_text(rule, problem.unit)
        message = translate(
            "'{}': the direction from the joint {} is not defined", phrase, joint or ""
        )
        raise ProblemError(problem.name, [Fault(f"assembly.{rule.point}", message, hint)])
    return replace(rule, refs=(*rule.refs, joint))


def slotted_rule(problem: Problem, group: AssurGroup) -> Rule | None:
    """Return the rule that a slotted link needs: a point of it lies towards the other joint.

    None if the line starts at the joint of its link, so that the sliding block is on that ray, and
    if no point can lie on the other side: for a block and a single sliding block.
    """
    inner = group.inner[0]
    assert isinstance(inner, Prismatic)
    slide = problem.slides[inner.slider]
    ends = {lead.link: outer_point(lead) for lead in group.legs}
    host = problem.bodies[slide.host].points
    runs_on = ((slide.base - host[ends[slide.host]]) / cis(slide.angle)).real >= 0.0
    for link, other in ((slide.host, slide.slider), (slide.slider, slide.host)):
        joint, body = ends[link], problem.bodies[link].points
        if runs_on and (link == slide.host or len(host) > 1):
            continue
        for point in (point for point, at in body.items() if at != body[joint]):
            return Rule(point, AssemblyRelation.TOWARDS, (ends[other], joint))
    return None
