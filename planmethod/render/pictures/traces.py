"""Traces of the construction (следы построения): marks of compass and set square on the paper.

They follow from the steps: a step that intersects arcs leaves notches (засечки), one that
intersects lines leaves these a little beyond the intersection, and a right angle where one was
drawn. All are short and thin, so that they explain a sheet without covering it.
"""

from __future__ import annotations

from cmath import phase
from collections.abc import Iterable, Iterator, Mapping
from math import pi
from typing import TypeAlias

from msgspec import Struct

from planmethod.construct import steps
from planmethod.construct.steps import LineName, PointName, Step
from planmethod.note.narrate.letters import direction_text, plan_letters
from planmethod.note.plaintext import plain_text
from planmethod.plans.model import Plan, PlanKind, Relation, Vector
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.symbols import unit
from planmethod.solved.solution import Solution

Shown: TypeAlias = bool | tuple[str, ...]
"""All traces, none, or those of the steps that make the points with these letters."""

TRACE = "trace"
"""Tag of a trace."""

NOTCH, EXTENSION, CORNER = 8.0, 5.0, 2.5
"""Half a notch of the scheme, the extension of a line beyond an intersection, and the sides of a
right angle, mm."""

_NAMES = 2.5  # height of the name of a direction, mm
_LEGS = 1.6  # least length of the legs of a right angle, in sides of its sign
_ZERO_LENGTH = 0.5  # mm: a shorter vector gives its line no direction on the paper
_RIGHT = 1e-6  # cosine of the angle between lines that were drawn as a right one


def shown_traces(solution: Solution, requested: Shown | None, *, has_space: bool) -> Shown:
    """Return the shown traces: those of the layout, else of the file.

    By default the traces of a single position are shown if the sheet has ``has_space`` for them.
    """
    said = solution.problem.sheet.traces if requested is None else requested
    return has_space and len(solution.positions) == 1 if said is None else said


def scheme_traces(solution: Solution, index: int, factor: float, shown: Shown) -> list[Item]:
    """Return the notches of the construction of the scheme's points, mm, reduced by ``factor``."""
    items: list[Item] = []
    for step in _steps(solution, PlanKind.POSITION) if shown else ():
        if _is_shown(shown, [step.out]):
            for needle in _needles(step, solution):
                way = complex(solution.paper.vector(needle, PointName(step.out))[index])
                at = complex(solution.paper.point(step.out)[index])
                items.append(_notch(at - way, at, NOTCH * factor))
    return items


def plan_traces(
    solution: Solution, kind: PlanKind, index: int, at: Mapping[PointName, complex], shown: Shown
) -> tuple[list[Item], list[Label]]:
    """Return the traces on a plan whose points lie at ``at``, mm, and the names of directions."""
    plan = solution.construction.plan(kind)
    letters = plan_letters(solution.problem, plan)
    items: list[Item] = []
    labels: list[Label] = []
    for step in _steps(solution, kind) if shown else ():
        own = [plain_text(letter) for letter in letters.get(PointName(str(step.out)), ())]
        if not own or not _is_shown(shown, own):
            continue
        if isinstance(step, steps.Similar):
            items += _corner_of_triangle(step, at)
        elif isinstance(step, steps.IntersectLines):
            for line in (step.first, step.second):
                ray = _Ray.of(solution, plan, index, line, step.out)
                if ray is not None and {ray.start, ray.head} <= set(at):
                    items += [*ray.extend(at), *ray.right_angle(at)]
                    labels += ray.names(at)
    return items, labels


def _is_shown(shown: Shown, letters: Iterable[str]) -> bool:
    return shown if isinstance(shown, bool) else not set(shown).isdisjoint(letters)


def _steps(solution: Solution, kind: PlanKind) -> Iterator[Step]:
    for section in solution.construction.sections:
        if section.kind is kind:
            yield from section.steps


def _needles(step: Step, solution: Solution) -> tuple[PointName, ...]:
    """Return the centres of the compass for a point of the scheme."""
    construction = solution.construction
    match step:
        case steps.LayOffLength(out=out, origin=origin, line=line) if (
            out in construction.draft.marked
        ):
            drawn = construction.step(line)
            return (origin,) if isinstance(drawn, steps.AtAngle) and drawn.to is not None else ()
        case steps.IntersectCircles(centre1=one, centre2=two):
            return one, two
        case steps.IntersectLineCircle(centre=centre):
            return (centre,)
        case _:
            return ()


def _notch(centre: complex, at: complex, half: float) -> Arc:
    radius, turn = abs(at - centre), phase(at - centre)
    by = min(half / radius, pi / 6)
    return Arc(centre, radius, turn - by, turn + by, Pen.THIN, TRACE)


def _corner_of_triangle(step: steps.Similar, at: Mapping[PointName, complex]) -> list[Item]:
    """Return the notches of the construction of a triangle's corner from the two others."""
    b, c, corner = (at.get(point) for point in (step.plan_b, step.plan_c, step.out))
    if b is None or c is None or corner is None:
        return []
    off = abs(((corner - b) * (c - b).conjugate()).imag)
    if off <= _ZERO_LENGTH * abs(c - b):
        return []  # on the line of the two, laid off by one length
    return [_notch(end, corner, NOTCH / 2) for end in (b, c)]


class _Ray(Struct, frozen=True):
    """Direction of an unknown vector, and the vector that was laid off before it.

    ``direction`` is the direction of its line, a unit vector; ``before`` the tail of the previous
    vector, if the line is perpendicular to it.
    """

    start: PointName
    head: PointName
    direction: complex
    vector: Vector | None
    before: PointName | None

    @classmethod
    def of(
        cls, solution: Solution, plan: Plan, index: int, line: LineName, head: PointName
    ) -> _Ray | None:
        """Return the ray of an intersected line, or None for a line that was there before."""
        step = solution.construction.step(line)
        if not isinstance(step, steps.Parallel | steps.Perpendicular):
            return None
        along = unit(complex(solution.paper.line_vector(line)[index]))
        ends = {(vector.tail, vector.head): vector for vector in plan.vectors}
        before = next((tail for tail, end in ends if end == step.through), None)
        if before is not None:
            way = complex(solution.paper.vector(before, step.through)[index])
            if abs((way * along.conjugate()).real) > _RIGHT * abs(way):
                before = None
        return cls(step.through, head, along, ends.get((step.through, head)), before)

    def _ends(self, at: Mapping[PointName, complex]) -> tuple[complex, complex]:
        """Return the start of its vector and its direction, a unit vector."""
        start, way = at[self.start], at[self.head] - at[self.start]
        return start, unit(way) if abs(way) > _ZERO_LENGTH else self.direction

    def extend(self, at: Mapping[PointName, complex]) -> list[Item]:
        """Return the line beyond the intersection; to both sides of it without a vector."""
        start, way = self._ends(at)
        head = at[self.head]
        short = abs(head - start) <= _ZERO_LENGTH
        return [
            Stroke((head - way * EXTENSION * short, head + way * EXTENSION), Pen.THIN, tag=TRACE)
        ]

    def right_angle(self, at: Mapping[PointName, complex]) -> list[Item]:
        """Return the sign of the right angle with the previous vector."""
        if self.before is None or self.before not in at:
            return []
        start, way = self._ends(at)
        back = at[self.before] - start
        if min(abs(back), abs(at[self.head] - start)) < _LEGS * CORNER:
            return []
        one, two = unit(back) * CORNER, way * CORNER
        corner = (start + one, start + one + two, start + two)
        return [Stroke(corner, Pen.THIN, tag=TRACE)]

    def names(self, at: Mapping[PointName, complex]) -> list[Label]:
        """Return the label of the line's direction at its end: ``⊥ CB``."""
        told = None if self.vector is None else self.vector.direction
        if told is None or told.relation not in (Relation.PERPENDICULAR, Relation.PARALLEL):
            return []
        end = at[self.head] + self._ends(at)[1] * EXTENSION
        way = self._ends(at)[1]
        return [Label(typeset(direction_text(told), _NAMES), end, prefer=way, gap=0.6)]
