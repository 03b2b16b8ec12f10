"""Steps of a construction (шаги построения): a closed set of frozen records.

A step names what it makes and what it uses, and holds no numbers that depend on the position and
no pens. Readings of a step (evaluate, narrate, draw) are functions that match on it. Points are in
paper millimetres, x right, y up; lines are directed; angles are in degrees, as on a protractor.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from typing import NewType, TypeAlias, get_args

from msgspec import Struct

PointName = NewType("PointName", str)
LineName = NewType("LineName", str)
NumberName = NewType("NumberName", str)
Name: TypeAlias = PointName | LineName | NumberName
Place: TypeAlias = tuple[NumberName | None, NumberName | None]


class Side(Enum):
    """Side of a directed line (сторона направленной прямой): one of two arc intersections."""

    LEFT = 1
    RIGHT = -1


class LineSense(Enum):
    """Sense along a directed line, selecting one of two intersections of a line and an arc."""

    FORWARD = 1
    BACKWARD = -1


class GivenPoint(Struct, frozen=True):
    """Point given before the construction starts (данная точка), mm."""

    out: PointName


class GivenNumber(Struct, frozen=True):
    """Number given before the construction starts (данная величина), in its own unit."""

    out: NumberName


class Join(Struct, frozen=True):
    """Line through two points, directed from the first to the second (прямая через две точки)."""

    out: LineName
    tail: PointName
    head: PointName


class Parallel(Struct, frozen=True):
    """Line through a point parallel to a line, same sense (параллельная прямая)."""

    out: LineName
    through: PointName
    to: LineName


class Perpendicular(Struct, frozen=True):
    """Line through a point, a line's direction turned by +90 degrees (перпендикуляр)."""

    out: LineName
    through: PointName
    to: LineName


class AtAngle(Struct, frozen=True):
    """Line through a point at an angle to a line, or to +x when there is none (под углом)."""

    out: LineName
    through: PointName
    to: LineName | None
    angle: NumberName


class LayOffLength(Struct, frozen=True):
    """Point at a signed length along a line from a point (отложить отрезок), mm."""

    out: PointName
    origin: PointName
    line: LineName
    length: NumberName


class IntersectLines(Struct, frozen=True):
    """Intersection of two lines (точка пересечения прямых)."""

    out: PointName
    first: LineName
    second: LineName


class IntersectLineCircle(Struct, frozen=True):
    """Intersection of a line and an arc, the forward or the backward one (засечка на прямой).

    ``branch``, where there is one, is +1, or -1 where the other one is meant.
    """

    out: PointName
    line: LineName
    centre: PointName
    radius: NumberName
    sense: LineSense
    branch: NumberName | None = None


class IntersectCircles(Struct, frozen=True):
    """Intersection of two arcs on a side of the line of centres (засечки).

    ``branch``, where there is one, is +1, or -1 where the other side is meant.
    """

    out: PointName
    centre1: PointName
    radius1: NumberName
    centre2: PointName
    radius2: NumberName
    side: Side
    branch: NumberName | None = None


class Touch(Struct, frozen=True):
    """Point where a line from a point touches a circle (точка касания).

    ``side`` is the side of the directed line centre → source on which the point of tangency lies.
    """

    out: PointName
    centre: PointName
    radius: NumberName
    source: PointName
    side: Side


class Leg(Struct, frozen=True):
    """Constraint of one of the three legs on the base link (поводок базисного звена).

    A place of the link is ``radius`` away from ``centre``; or it lies on ``line``; or a straight
    line of the link, through the place and at ``angle`` to its axis, passes through ``centre``.

    Attributes
    ----------
    at : (NumberName or None, NumberName or None)
        The place, mm along the axis of the link and to the left of it; None of 0.
    angle : NumberName or None
        Degrees, counter-clockwise.
    """

    at: Place
    centre: PointName | None = None
    radius: NumberName | None = None
    line: LineName | None = None
    angle: NumberName | None = None


class TriadPose(Struct, frozen=True):
    """Axis through the origin of a base link held by three legs (группа III класса).

    Arcs alone cannot find it. Without one leg the link is a coupler, and the place of that leg
    traces a curve: the link is held where the curve meets the constraint of the leg. Among several
    such poses it is the one nearest to ``start``: the link's origin, mm, and the direction of its
    axis, degrees.
    """

    out: LineName
    legs: tuple[Leg, Leg, Leg]
    start: tuple[NumberName, NumberName, NumberName]


class Spot(Struct, frozen=True):
    """Point of a link whose axis and origin are found, by its place on the link (точка звена)."""

    out: PointName
    axis: LineName
    at: Place


class Similar(Struct, frozen=True):
    """Point of a plan similar to a point of the link, letters in the same order (теорема подобия).

    Triangle plan_b plan_c out is similar to link_b link_c link_s. ``side`` is the length of plan_b
    plan_c, mm, as read or laid off: the sides of the triangle are computed from it. ``span`` and
    ``arm`` are the lengths of link_b link_c and link_b link_s, mm, where no given length determines
    them and they are read on the drawing. The signs of all three do not matter.
    """

    out: PointName
    plan_b: PointName
    plan_c: PointName
    link_s: PointName
    link_b: PointName
    link_c: PointName
    side: NumberName
    span: NumberName | None = None
    arm: NumberName | None = None


class Measure(Struct, frozen=True):
    """Length between two points read with the ruler (измерить отрезок), mm."""

    out: NumberName
    tail: PointName
    head: PointName


class MeasureAlong(Struct, frozen=True):
    """Signed length between two points of a line: positive along its direction, mm."""

    out: NumberName
    tail: PointName
    head: PointName
    line: LineName


class Carry(Struct, frozen=True):
    """Segment of a plan carried to another point, parallel to itself (перенести отрезок).

    ``out`` is ``origin`` plus ``times`` the segment from ``tail`` to ``head``; ``rotated``: the
    segment is turned by +90 degrees, as the plan under a Zhukovsky lever is. ``length`` is the
    length read from the segment, mm, and is laid off again (its sign does not matter), as when a
    force is transferred from one plan to another; if it is None, the segment is pricked through. A
    segment of zero length has no direction and needs none.
    """

    out: PointName
    origin: PointName
    tail: PointName
    head: PointName
    length: NumberName | None = None
    times: NumberName | None = None
    rotated: bool = False


class MeasureArm(Struct, frozen=True):
    """Arm of a vector of a plan about a point of another drawing (измерить плечо), mm.

    The vector from ``tail`` to ``head`` acts at ``at``: its line is drawn through there, and the
    distance of that line from ``about`` is read with the ruler. Positive where the vector turns
    counter-clockwise about the point; 0 for a vector of no length.
    """

    out: NumberName
    about: PointName
    at: PointName
    tail: PointName
    head: PointName


class MeasureAngle(Struct, frozen=True):
    """Angle of a line read with the protractor (измерить угол), degrees in (-180, 180].

    Counted counter-clockwise from the line ``base``, or from +x when there is none.
    """

    out: NumberName
    line: LineName
    base: LineName | None = None


class Compute(Struct, frozen=True):
    """Number from numbers: ``factor`` times a product of powers (вычислить).

    ``powers`` are (name, exponent): omega = v_CB / l_BC is factor 1 and (v_CB, 1), (l_BC, -1).
    ``size``: the number without its sign (модуль).
    """

    out: NumberName
    factor: float
    powers: tuple[tuple[NumberName, int], ...]
    size: bool = False


class Total(Struct, frozen=True):
    """Sum of computed numbers (алгебраическая сумма)."""

    out: NumberName
    terms: tuple[NumberName, ...]


Step: TypeAlias = (
    GivenPoint
    | GivenNumber
    | Join
    | Parallel
    | Perpendicular
    | AtAngle
    | LayOffLength
    | IntersectLines
    | IntersectLineCircle
    | IntersectCircles
    | Touch
    | TriadPose
    | Spot
    | Similar
    | Measure
    | MeasureAlong
    | Carry
    | MeasureArm
    | MeasureAngle
    | Compute
    | Total
)
STEP_TYPES: tuple[type[Step], ...] = get_args(Step)

_KINDS = {"PointName": PointName, "LineName": LineName, "NumberName": NumberName}


def _kind(annotation: str) -> object:
    """Return the kind of name that an annotation denotes, ignoring ``| None``.

    The annotations of this module are strings; reading them as text costs a thirtieth of evaluating
    them, and every command pays that.
    """
    return _KINDS.get(annotation.removesuffix(" | None"))


# Not by `dataclasses.fields`, which are made on request: every command would pay for it.
_NAMED = {
    kind: [(name, _kind(told)) for name, told in kind.__annotations__.items()]
    for kind in STEP_TYPES
}
_RESULT_KINDS = {kind: named[0][1] for kind, named in _NAMED.items()}
_OPERANDS = {
    kind: tuple((name, of) for name, of in named[1:] if of is not None)
    for kind, named in _NAMED.items()
}


def operands(step: Step) -> Iterator[tuple[Name, object]]:
    """Yield each name the step uses together with the kind it must have."""
    if isinstance(step, Compute):
        for name, _ in step.powers:
            yield name, NumberName
        return
    if isinstance(step, Total):
        for name in step.terms:
            yield name, NumberName
        return
    if isinstance(step, TriadPose | Spot):
        yield from _pose_operands(step)
        return
    for field, kind in _OPERANDS[type(step)]:
        name = getattr(step, field)
        if name is not None:
            yield name, kind


def _pose_operands(step: TriadPose | Spot) -> Iterator[tuple[Name, object]]:
    numbers: list[NumberName | None]
    if isinstance(step, Spot):
        yield step.axis, LineName
        numbers = [*step.at]
    else:
        numbers = [*step.start]
        for leg in step.legs:
            for name, kind in ((leg.centre, PointName), (leg.line, LineName)):
                if name is not None:
                    yield name, kind
            numbers += [*leg.at, leg.radius, leg.angle]
    for number in numbers:
        if number is not None:
            yield number, NumberName


def result_kind(step: Step) -> object:
    """Return the kind of object (point, line, number) a step makes."""
    return _RESULT_KINDS[type(step)]
