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
from planmethod.languages import say
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import Prismatic, Revolute
from planmethod.plans.draft import Draft, cis
from planmethod.plans.motion.position import (
    lead_point,
    parallelogram,
)
from planmethod.problem.model import Problem, Rule, Where
from planmethod.problem.names import told_length, told_place
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
        say(
            "{} is placed after {}, so it cannot determine its place",
            say(" and ").join(missing),
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
            say("links {} close by a slotted link, which keeps its side", links),
            'Leave keep = "continuous" out',
        )
    if rule.where is not Where.PARALLEL:
        return None
    found = parallelogram(problem, group) if group.signature == "RRR" else None
    if found is None:
        return Fault(
            path,
            say("links {} are not two sides of a quadrilateral of four joints", links),
            'Leave keep = "parallel" out, and give a rule for the assembly that is meant',
        )
    if found.is_one:
        return None
    said = "; ".join(
        say(
            "{} = {} and {} = {}",
            one,
            told_length(a, problem.unit, 10),
            two,
            told_length(b, problem.unit, 10),
        )
        for (one, a), (two, b) in (found.sides[:2], found.sides[2:])
    )
    return Fault(
        path,
        say("the opposite sides of a parallelogram are equal, but here {}", said),
        'Correct the lengths, or give keep = "continuous" with a rule for the '
        "assembly that is meant",
    )


def score_of(rule: Rule, draft: Draft, reading: Reading) -> Reals:
    """Return the score of a mode under a rule, m or m²: satisfied if > 0, the larger the better."""

    def at(name: str) -> Complexes:
        return reading.point(PointName(name))

    p = at(rule.point)
    match rule.where:
        case Where.RIGHT:
            return np.asarray((p - at(rule.refs[0])).real)
        case Where.LEFT:
            return np.asarray((at(rule.refs[0]) - p).real)
        case Where.ABOVE:
            return np.asarray((p - at(rule.refs[0])).imag)
        case Where.BELOW:
            return np.asarray((at(rule.refs[0]) - p).imag)
        case Where.LEFT_OF | Where.RIGHT_OF:
            start, end = at(rule.refs[0]), at(rule.refs[1])
            left = ((end - start).conjugate() * (p - start)).imag / abs(end - start)
            return np.asarray(left if rule.where is Where.LEFT_OF else -left)
        case Where.TOWARDS | Where.AWAY:
            end, start = at(rule.refs[0]), at(rule.refs[1])
            ahead = ((end - start).conjugate() * (p - start)).real / abs(end - start)
            return np.asarray(ahead if rule.where is Where.TOWARDS else -ahead)
        case Where.NEAR:
            return np.asarray(-abs(p - (rule.at - draft.origin)))
        case Where.PARALLEL:
            return np.full(np.shape(p), np.nan)  # which of the sides it is changes with the crank
        case _:
            assert_never(rule.where)


def rule_text(rule: Rule, unit: str) -> str:
    """Return a rule in the words of the file: ``C right of B``, ``C left of AD``."""
    match rule.where:
        case Where.NEAR:
            return say("{} near [{}]", rule.point, told_place(rule.at, unit))
        case Where.PARALLEL:
            return say("{} keep parallel", rule.point)
        case Where.TOWARDS | Where.AWAY:
            return f"{rule.point} {rule.where.value} {rule.refs[0]}"
        case Where.ABOVE | Where.BELOW:
            words = rule.where.value
        case _:
            words = f"{rule.where.value.removesuffix(' of')} of"
    return f"{rule.point} {words} {''.join(rule.refs)}"


def ambiguous_fault(rule: Rule, both: list[Tried], index: int, where: str) -> Fault:
    """Return the fault of a rule that both modes satisfy, with rules that distinguish them."""
    draft = both[0][0]
    unit = draft.problem.unit
    places = [
        told_place(complex(reading.point(PointName(rule.point))[index]) + draft.origin, unit)
        for _, reading in both
    ]
    told = telling_rules(rule.point, both, slice(index, index + 1))
    words = told or [f"{{ near = [{place}] }}" for place in places]
    return Fault(
        f"assembly.{rule.point}",
        say(
            "'{}' holds for both assemblies at {}: with {} at ({}) and at ({}) {}",
            rule_text(rule, unit),
            where,
            rule.point,
            *places,
            say(unit),
        ),
        say("Give '{}' for the first or '{}' for the second", words[0], words[1]),
        tuple(told),
    )


def telling_rules(point: str, both: list[Tried], asked: slice) -> list[str]:
    """Return the rules, one for each mode, that separate them most in the given positions.

    Empty if there is none, with a point that does not depend on the mode or a line through two such
    points.
    """

    def at(reading: Reading, name: str) -> Complexes:
        return reading.point(PointName(name))[asked]

    def least(first: Complexes, second: Complexes) -> float:
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
        if (width := least((c - at(one, p)) * sign, (at(one, p) - d) * sign)) > 0
    ]
    # No point is between them: a line through two points may be.
    told = told or [
        (width, f"left of {p}{q}", f"right of {p}{q}")
        for p in still
        for q in still
        if (along := at(one, q) - at(one, p)).all()
        and (width := least((c - at(one, p)) / along / 1j, (at(one, p) - d) / along / 1j)) > 0
    ]
    return list(max(told, key=lambda pair: pair[0])[1:]) if told else []


def _outer(problem: Problem, group: AssurGroup, point: str) -> str | None:
    """Return the outer joint of a group on the link that a point belongs to."""
    for lead in group.leads:
        if isinstance(lead.joint, Revolute) and point in problem.bodies[lead.link].points:
            return lead.joint.point
    return None


def from_joint(problem: Problem, group: AssurGroup, rule: Rule) -> Rule:
    """Return a rule of direction from a joint with that joint added after its points."""
    if rule.where not in (Where.TOWARDS, Where.AWAY):
        return rule
    joint = _outer(problem, group, rule.point)
    if joint is None or joint in (rule.point, *rule.refs):
        hint = "Compare with another point: right of, left of, above, below"
        said = rule_text(rule, problem.unit)
        message = say("'{}': the direction from the joint {} is not defined", said, joint or "")
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
    ends = {lead.link: lead_point(lead) for lead in group.leads}
    host = problem.bodies[slide.host].points
    runs_on = ((slide.base - host[ends[slide.host]]) / cis(slide.angle)).real >= 0.0
    for link, other in ((slide.host, slide.slider), (slide.slider, slide.host)):
        joint, body = ends[link], problem.bodies[link].points
        if runs_on and (link == slide.host or len(host) > 1):
            continue
        for point in (point for point, at in body.items() if at != body[joint]):
            return Rule(point, Where.TOWARDS, (ends[other], joint))
    return None
