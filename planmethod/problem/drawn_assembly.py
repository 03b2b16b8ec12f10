"""Assembly of the position that coordinates show, and its other numbers (сборка по рисунку)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from planmethod.construct.program import Program
from planmethod.errors import StructureError
from planmethod.mechanism.groups import AssurGroup, triad_of
from planmethod.mechanism.model import FRAME, Revolute
from planmethod.mechanism.structure import analyse
from planmethod.problem.figure_checks import ANGLE_TOLERANCE, LENGTH_TOLERANCE
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import (
    AssemblyRelation,
    DrawnFact,
    DrawnKind,
    DrawnPoints,
    DrawnPosition,
    Problem,
    Rule,
)
from planmethod.problem.names import UNITS
from planmethod.problem.placement import heading


def check_figure(
    file: FileNode, shown: DrawnPoints, facts: Sequence[DrawnFact], assembly: Sequence[Rule]
) -> None:
    """Note the numbers of a figure, and the rules, that contradict its coordinates."""
    _check_facts(file["drawn"], shown, facts)
    for rule in assembly:
        if _satisfies(rule, shown.places) is False:
            file["assembly"][rule.point].note(
                "the coordinates in [drawn] show the contrary",
                hint="Delete the rule, or correct the coordinates.",
            )


def _check_facts(node: FileNode, shown: DrawnPoints, facts: Sequence[DrawnFact]) -> None:
    z = shown.places
    for fact in facts:
        lines = fact.lines or (None,) * len(fact.of)
        ends = [fact.of] if fact.kind is DrawnKind.LENGTH else [line for line in lines if line]
        if len(ends) != (1 if fact.kind is not DrawnKind.BETWEEN else 2):
            continue
        if not {point for line in ends for point in line} <= {*z}:
            continue
        vectors = [z[line[1]] - z[line[0]] for line in ends]
        if fact.kind is DrawnKind.LENGTH:
            found, off = (
                abs(vectors[0]),
                abs(abs(vectors[0]) - fact.value) / LENGTH_TOLERANCE / fact.value,
            )
        elif not all(vectors):
            continue
        elif fact.kind is DrawnKind.PHI:
            found = heading(vectors[0])
            off = abs((found - fact.value + 180.0) % 360.0 - 180.0) / ANGLE_TOLERANCE
        else:
            found = abs(heading(vectors[1] / vectors[0]))
            off = abs(found - fact.value) / ANGLE_TOLERANCE
        if off > 1.0:
            shown_number = f"{found * UNITS[node.faults.unit]:.5g}"
            if fact.kind is not DrawnKind.LENGTH:
                shown_number = f"{found:.5g}"
            node[fact.key].note(
                "the coordinates give {}", shown_number, hint="Correct one of them."
            )


def directions(
    shown: DrawnPoints, axes: Mapping[str, tuple[str, str]], facts: Sequence[DrawnFact]
) -> tuple[DrawnFact, ...]:
    """Return the directions of links by the coordinates of the ends of their own axes.

    Those that the facts of the figure give are left out.
    """
    ruled = {fact.of for fact in facts if fact.kind is DrawnKind.PHI}
    z = shown.places
    return tuple(
        DrawnFact(DrawnKind.PHI, (link,), heading(z[b] - z[a]))
        for link, (a, b) in axes.items()
        if (link,) not in ruled and {a, b} <= {*z}
    )


def with_position(problem: Problem, shown: DrawnPoints) -> Problem:
    """Return a problem that is assembled as the coordinates of its figure show."""
    figure, drive, position = problem.drawn, problem.drive, shown.position
    if figure is None:
        figure = DrawnPosition(
            facts=(),
            file_values=shown.file_values,
            places_found=shown.places_found,
            position=position,
            is_stated=True,
            program=Program(()),
            numbers={},
            places={},
            directions={},
        )
    ruled = {rule.point for rule in problem.rules}
    rules = () if drive.posed is not None or position is None else _rules(problem, shown, ruled)
    figure = replace(figure, rules=(*figure.rules, *rules), shown=shown)
    first = (drive.assembly_positions or drive.positions)[0]
    if drive.posed is None and drive.cam_drive is None and position not in (None, first):
        drive = replace(drive, assembly_positions=(position,))
    return replace(problem, drive=drive, drawn=figure)


def _rules(problem: Problem, shown: DrawnPoints, ruled: set[str]) -> Iterator[Rule]:
    """Yield the rules by which the groups close as in the figure, where the file has none."""
    try:
        groups = analyse(problem.mechanism).groups
    except StructureError:
        return  # reported where the mechanism is assembled
    known = {*problem.bodies[FRAME].points, *problem.bodies[problem.drive.link].points}
    for group in groups:
        inner = [p for link in group.links for p in problem.bodies[link].points if p not in known]
        if not ruled & {*inner}:
            for point in _choosing(problem, group, dict.fromkeys(inner)):
                if point in shown.places:
                    yield Rule(point, AssemblyRelation.NEAR, at=shown.places[point])
        known.update(inner)


def _choosing(problem: Problem, group: AssurGroup, inner: Mapping[str, None]) -> Iterator[str]:
    """Yield the points by which the vectors to close a group differ."""
    if triad_of(group) is not None:
        yield from inner
    elif group.signature in ("RRR", "RRP"):
        (joint,) = group.inner
        assert isinstance(joint, Revolute)
        yield joint.point
    elif group.signature == "RPR":
        ends = {leg.joint.point for leg in group.legs if isinstance(leg.joint, Revolute)}
        apart = [
            (abs(body.points[point] - body.points[end]), point)
            for body in (problem.bodies[link] for link in group.links)
            for end in ends & {*body.points}
            for point in body.points
            if point in inner and point not in ends
        ]
        if apart:
            yield max(apart)[1]


def _satisfies(rule: Rule, z: Mapping[str, complex]) -> bool | None:
    """Return whether coordinates satisfy a rule of direction; None of others, and of a tie."""
    if not {rule.point, *rule.refs} <= {*z} or not rule.refs:
        return None
    vector = z[rule.point] - z[rule.refs[0]]
    match rule.relation:
        case AssemblyRelation.RIGHT:
            found = vector.real
        case AssemblyRelation.LEFT:
            found = -vector.real
        case AssemblyRelation.ABOVE:
            found = vector.imag
        case AssemblyRelation.BELOW:
            found = -vector.imag
        case AssemblyRelation.LEFT_OF:
            found = ((z[rule.refs[1]] - z[rule.refs[0]]).conjugate() * vector).imag
        case AssemblyRelation.RIGHT_OF:
            found = -((z[rule.refs[1]] - z[rule.refs[0]]).conjugate() * vector).imag
        case _:
            return None
    return found > 0.0 if found else None
