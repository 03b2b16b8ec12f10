"""Rules that select the assembly mode of a group, and change points (правила сборки)."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias, assert_never

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.program import Program
from planmethod.construct.steps import PointName, Touch
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import Prismatic, Revolute
from planmethod.plans.draft import Draft, cis
from planmethod.plans.motion.position import (
    inner_point,
    outer_point,
    parallelogram,
    rpr_parts,
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
            'Omit keep = "continuous"',
        )
    if rule.relation is not AssemblyRelation.PARALLEL:
        return None
    found = parallelogram(problem, group) if group.signature == "RRR" else None
    if found is None:
        return Fault(
            path,
            translate("links {} are not two sides of a quadrilateral of four joints", links),
            'Omit keep = "parallel", and give a rule for the required assembly',
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
        'Correct the lengths, or give keep = "continuous" with a rule for the required assembly',
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


# no messages: rules, in the words of the file
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


Data = Callable[[Reals], dict[str, complex | float | Reals]]

TOUCHING = 1e-9
"""Squared distance of two modes, relative to the group's size, at which they coincide."""

SAMPLES = 721
"""Number of samples of the driver's range: every half degree of a turn."""

_ROUNDS, _PARTS = 8, 32  # the interval between two samples is subdivided again and again


def changes(
    draft: Draft,
    program: Program,
    data: Data,
    group: AssurGroup,
    interval: tuple[float, float],
    *,
    around: bool = True,
) -> tuple[float, ...]:
    """Return the driver positions of an interval in which a group's modes coincide.

    Only positions that the driver can pass through are found: the group closes on both sides.

    Parameters
    ----------
    draft, program
        A position plan that has the group.
    data : callable
        Returns the plan's data at unit scales for some positions, ndarray of shape (n,).
    around : bool
        The driver goes round: every turn is sampled equally.
    """

    def mode_distance(positions: Reals) -> Reals:
        with np.errstate(all="ignore"):
            return _mode_distance(draft, program, data(positions), group, positions)

    low, high = interval
    count = (SAMPLES - 1) * max(round((high - low) / 360.0), 1) + 1 if around else SAMPLES
    looks = np.linspace(low, high, count)
    there = np.array([np.inf, *mode_distance(looks), np.inf])
    least = (there[1:-1] <= there[:-2]) & (there[1:-1] < there[2:])
    found = []
    for i in map(int, np.flatnonzero(least & (np.abs(there[1:-1]) < 0.1))):
        one, two = looks[max(i - 1, 0)], looks[min(i + 1, count - 1)]
        for _ in range(_ROUNDS):
            fine = np.linspace(one, two, _PARTS + 1)
            here = mode_distance(fine)
            k = int(np.nanargmin(here))
            one, two = fine[max(k - 1, 0)], fine[min(k + 1, _PARTS)]
        if abs(here[k]) <= TOUCHING:
            found.append(float(fine[k]))
    return tuple(found)


def _mode_distance(
    draft: Draft,
    program: Program,
    data: dict[str, complex | float | Reals],
    group: AssurGroup,
    positions: Reals,
) -> Reals:
    """Return the squared distance of both modes, relative to the group's size."""
    trace = evaluate(program, data, Float64())

    def gap(p: str, q: str) -> Reals:
        ends = trace.value[PointName(q)] - trace.value[PointName(p)]
        return np.asarray(np.abs(ends), dtype=float)

    if group.signature == "RPR":
        _, host, slider = rpr_parts(draft, group)
        p, q = outer_point(host), outer_point(slider)
        feet = [step.out for step in program.steps if isinstance(step, Touch) and step.source == q]
        span = gap(p, q)
        found = trace.margin[feet[0]] if feet else (span / np.max(span)) ** 2
    else:
        c = inner_point(group)
        found = trace.margin[PointName(c)]
        if group.signature == "RRR":
            # Of two equal arcs about one place it is the line of centres that has no direction.
            p, q = (outer_point(lead) for lead in group.legs)
            span = gap(p, q)
            found = np.where(span == 0, 0.0, found * (span / gap(p, c)) ** 2)
    return np.broadcast_to(np.asarray(found, dtype=float), positions.shape)
