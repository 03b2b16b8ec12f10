"""The vector equations of the plans as a reader has them: paired, joint, numbered (уравнения)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import TypeAlias

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.mechanism.groups import AssurGroup, triad_of
from planmethod.mechanism.model import FRAME
from planmethod.note.document import Equation, Term
from planmethod.note.formula import Rich
from planmethod.plans.build import Construction
from planmethod.plans.forces.polygons import Edge
from planmethod.plans.model import (
    RATES,
    ZERO_VECTOR,
    Direction,
    KnownParts,
    Plan,
    PlanKind,
    Vector,
    VectorEquation,
    VectorKind,
    perpendicular_to,
)
from planmethod.problem.model import Problem

Ends: TypeAlias = tuple[PointName, PointName]

Directed: TypeAlias = Callable[[Direction | None], Rich]
"""Function that writes a direction: `letters.direction_text`, or `direction_note` of names."""


_NO_DIRECTIONS: Mapping[Ends, Direction] = MappingProxyType({})


class StatedEquation(Struct, frozen=True):
    """A vector equation of a plan as it is stated (уравнение плана).

    Attributes
    ----------
    head : PointName
        Plan point whose vector it determines.
    is_joint : bool
        Whether two expressions of that vector are equated.
    number : int
        Through all plans; 0 if equations have no numbers.
    """

    head: PointName
    left: tuple[Vector, ...]
    right: tuple[Vector, ...]
    is_joint: bool = False
    number: int = 0

    def written(
        self, directed: Directed, known: Mapping[Ends, Direction] = _NO_DIRECTIONS
    ) -> Equation:
        """Return it for a document.

        Parameters
        ----------
        known : mapping
            Directions for terms that have none of their own, by the ends of their segments.
        """
        left, right = (
            tuple(
                term_of(
                    one
                    if one.direction
                    else replace(one, direction=known.get((one.tail, one.head))),
                    directed,
                )
                for one in side
            )
            for side in (self.left, self.right)
        )
        return Equation(left, right, number=numbered(self.number))


def numbered(number: int) -> Rich:
    """Return the number of an equation; empty for none."""
    return str(number) if number else ""


def marked(text: Rich, number: int | None) -> Rich:
    """Return an equation of moments with its number, if it has one."""
    return f"{text}  ({number})" if number else text


def term_of(term: Vector | Edge, directed: Directed) -> Term:
    """Return a term: its symbol, its known parts, its direction."""
    return Term(term.symbol, term.known.value, directed(term.direction))


def known_directions(
    construction: Construction, problem: Problem, kind: PlanKind
) -> Mapping[Ends, Direction]:
    """Return the known directions of the segments of a plan; none if the file wants them once."""
    if not problem.sheet.directions:
        return {}
    plan = construction.plan(kind)
    terms = [term for equation in plan.equations for term in equation.right]
    every = [(one.tail, one.head, one.direction) for one in (*plan.vectors, *terms)]
    found = {
        (tail, head): direction
        for tail, head, direction in every
        if direction is not None and direction != ZERO_VECTOR
    }
    if kind is PlanKind.VELOCITY:
        board = construction.kinematics.velocity
        for link, point, pivot in _turning_points(problem):
            if (link, point) in board.point:
                ends = board.pole, board.point[link, point]
                found.setdefault(ends, perpendicular_to(point, pivot))
    return found


def _turning_points(problem: Problem) -> Iterator[tuple[str, str, str]]:
    """Yield the points of links that turn about a fixed joint: link, point, joint."""
    for joint in problem.mechanism.revolutes:
        if FRAME in joint.links:
            for link in joint.links:
                points = problem.bodies[link].points if link != FRAME else ()
                yield from ((link, point, joint.point) for point in points if point != joint.point)


def stated_equations(
    construction: Construction, problem: Problem, kind: PlanKind
) -> tuple[StatedEquation, ...]:
    """Return the equations of a plan as the file wants them: in pairs or joint, with numbers."""
    first, found = 1, list[StatedEquation]()
    for each in RATES:
        plan = construction.plan(each)
        found = list(_stated(plan, construction, joint=bool(problem.sheet.joint_equations)))
        if each is kind:
            break
        first += len(found)
    if not problem.sheet.equation_numbers:
        return tuple(found)
    return tuple(replace(one, number=number) for number, one in enumerate(found, first))


def last_number(construction: Construction, problem: Problem) -> int:
    """Return the number of the last equation of the plans; 0 if they have no numbers."""
    every = [one for kind in RATES for one in stated_equations(construction, problem, kind)]
    return max((one.number for one in every), default=0)


def _stated(plan: Plan, construction: Construction, *, joint: bool) -> Iterator[StatedEquation]:
    """Yield the equations of a plan without numbers; two of one vector as one, if ``joint``."""
    apart = unjoined_points(construction, plan.kind)
    pairs: dict[PointName, list[VectorEquation]] = {}
    for one in plan.equations:
        pairs.setdefault(one.left.head, []).append(one)
    done = set[PointName]()
    for one in plan.equations:
        head = one.left.head
        if head in done:
            continue
        pair = pairs[head]
        if joint and head not in apart and (sides := _sides(pair, plan.equations)):
            done.add(head)
            yield StatedEquation(head, *sides, is_joint=True)
        else:
            yield StatedEquation(head, (one.left,), one.right)


def is_unjoined(problem: Problem, group: AssurGroup | None) -> bool:
    """Return whether joint equations are wanted, and a group has none: it is of class III."""
    wanted = bool(problem.sheet.joint_equations)
    return wanted and group is not None and triad_of(group) is not None


def unjoined_points(construction: Construction, kind: PlanKind) -> frozenset[PointName]:
    """Return the points of a plan that groups of class III determine: more than two legs do."""
    return frozenset(
        PointName(step.out)
        for section in construction.sections
        if section.kind is kind and section.group is not None
        if triad_of(section.group) is not None
        for step in section.steps
    )


def _sides(
    pair: Sequence[VectorEquation], every: Sequence[VectorEquation]
) -> tuple[tuple[Vector, ...], tuple[Vector, ...]] | None:
    """Return both sides of a joint equation; None unless two expressions determine the vector."""
    if len(pair) != 2 or any(one.right[-1].known is not KnownParts.ONE for one in pair):
        return None
    first, second = pair
    if _starts_on_frame(first) and _starts_on_frame(second):
        return None
    left, right = (first, second) if _starts_on_frame(first) else (second, first)
    return _expression(left, every), _expression(right, every)


def _starts_on_frame(equation: VectorEquation) -> bool:
    """Return whether the expression begins with a point of the frame."""
    return equation.right[0].direction == ZERO_VECTOR


def _expression(equation: VectorEquation, every: Sequence[VectorEquation]) -> tuple[Vector, ...]:
    """Return the terms of an expression: without zero, and with components of the driver's point.

    A component alone is the whole vector, which has its direction.
    """
    terms = [one for one in equation.right if one.direction != ZERO_VECTOR]
    if len(terms) == 1 and _starts_on_frame(equation):
        return (replace(equation.left, known=KnownParts.ONE, direction=terms[0].direction),)
    parts = {
        one.left.symbol: one.right
        for one in every
        if all(term.kind is not VectorKind.ABSOLUTE for term in one.right)
    }
    return tuple(part for term in terms for part in parts.get(term.symbol, (term,)))
