"""Program of construction steps: single assignment, checked when it is made, and rewritten."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from functools import lru_cache
from itertools import islice

from msgspec import Struct, field

from planmethod.construct.steps import (
    AtAngle,
    Carry,
    Compute,
    GivenNumber,
    GivenPoint,
    IntersectCircles,
    IntersectLineCircle,
    IntersectLines,
    Join,
    LayOffLength,
    Leg,
    LineName,
    LineSense,
    Measure,
    MeasureAlong,
    MeasureAngle,
    MeasureArm,
    Name,
    NumberName,
    Parallel,
    Perpendicular,
    Place,
    PointName,
    Side,
    Similar,
    Spot,
    Step,
    Total,
    Touch,
    TriadPose,
    operands,
    result_kind,
)
from planmethod.errors import ProgramError


# no messages: mistakes in a program
class Program(Struct, frozen=True):
    """Ordered steps of a construction (программа построения).

    Each name is made once and before it is used; a line is never used as a point. Both are
    checked here, so no reading has to.
    """

    steps: tuple[Step, ...]

    def __post_init__(self) -> None:
        made: dict[Name, object] = {}
        for number, step in enumerate(self.steps, 1):
            for name, kind in operands(step):
                if name not in made:
                    from difflib import get_close_matches

                    near = get_close_matches(name, made, 1)
                    hint = f"; did you mean {near[0]!r}?" if near else ""
                    raise ProgramError(
                        f"step {number} ({step.out}): no earlier step makes {name!r}{hint}"
                    )
                if made[name] is not kind:
                    raise ProgramError(f"step {number} ({step.out}): {name!r} is not a {kind}")
            if step.out in made:
                raise ProgramError(f"step {number}: {step.out!r} is already made")
            made[step.out] = result_kind(step)

    def needed_for(self, names: Iterable[Name]) -> Program:
        """Return the program of the steps on which the requested names depend (только нужное).

        Raises
        ------
        ProgramError
            No step makes a requested name.
        """
        need: set[Name] = set(names)
        unknown = need - {step.out for step in self.steps}
        if unknown:
            raise ProgramError(f"no step makes {', '.join(sorted(unknown))}")
        kept: list[Step] = []
        for step in reversed(self.steps):
            if step.out in need:
                kept.append(step)
                need.update(name for name, _ in operands(step))
        return _checked(tuple(reversed(kept)))


@lru_cache(maxsize=512)  # variants of a task are drawn by the same steps
def _checked(steps: tuple[Step, ...]) -> Program:
    return Program(steps)


class Builder(Struct):
    """Collect the steps of a construction; each verb returns the name it makes.

    The verbs are the steps; a line that was drawn once is found again instead of drawn twice,
    so callers ask for the line they need without keeping count.
    """

    steps: list[Step] = field(default_factory=list)
    _drawn: dict[tuple[object, ...], LineName] = field(default_factory=dict)
    _count: int = 0
    _names: set[Name] = field(default_factory=set)
    _named_count: int = 0  # steps whose names are in _made

    def copy(self) -> Builder:
        """Return a copy of the collector that continues from here."""
        return Builder(
            list(self.steps), dict(self._drawn), self._count, set(self._names), self._named_count
        )

    def has(self, name: str) -> bool:
        """Return whether a step makes a name."""
        self._names.update(step.out for step in islice(self.steps, self._named_count, None))
        self._named_count = len(self.steps)
        return name in self._names

    def program(self) -> Program:
        """Return the collected steps as a program; the same steps give the same object."""
        return _checked(tuple(self.steps))

    def take_point(self, out: str) -> PointName:
        """Take a point as given."""
        name = PointName(out)
        self.steps.append(GivenPoint(name))
        return name

    def known(self, out: str) -> NumberName:
        """Take a number as given."""
        name = NumberName(out)
        self.steps.append(GivenNumber(name))
        return name

    def known_once(self, numbers: dict[str, float], name: str, value: float) -> NumberName:
        """Take a number of the data as given, once; another value gets another name."""
        while numbers.get(name, value) != value:
            name += "*"
        if name in numbers:
            return NumberName(name)
        numbers[name] = value
        return self.known(name)

    def _line(self, key: tuple[object, ...]) -> tuple[LineName, bool]:
        name = self._drawn.get(key)
        if name is not None:
            return name, False
        self._count += 1
        name = self._drawn[key] = LineName(f"line{self._count}")
        return name, True

    def join(self, tail: PointName, head: PointName) -> LineName:
        """Draw the line from ``tail`` through ``head``."""
        name, new = self._line((Join, tail, head))
        if new:
            self.steps.append(Join(name, tail, head))
        return name

    def parallel(self, through: PointName, to: LineName) -> LineName:
        """Draw a parallel."""
        name, new = self._line((Parallel, through, to))
        if new:
            self.steps.append(Parallel(name, through, to))
        return name

    def perpendicular(self, through: PointName, to: LineName) -> LineName:
        """Draw a perpendicular, directed as ``to`` turned by +90 degrees."""
        name, new = self._line((Perpendicular, through, to))
        if new:
            self.steps.append(Perpendicular(name, through, to))
        return name

    def at_angle(self, through: PointName, to: LineName | None, angle: NumberName) -> LineName:
        """Draw a line at an angle to ``to``, or to +x."""
        name, new = self._line((AtAngle, through, to, angle))
        if new:
            self.steps.append(AtAngle(name, through, to, angle))
        return name

    def lay_off_length(
        self, out: str, origin: PointName, line: LineName, length: NumberName
    ) -> PointName:
        """Lay a length off."""
        name = PointName(out)
        self.steps.append(LayOffLength(name, origin, line, length))
        return name

    def intersect_lines(self, out: str, first: LineName, second: LineName) -> PointName:
        """Intersect two lines."""
        name = PointName(out)
        self.steps.append(IntersectLines(name, first, second))
        return name

    def intersect_line_circle(
        self,
        out: str,
        line: LineName,
        centre: PointName,
        radius: NumberName,
        sense: LineSense,
        branch: NumberName | None = None,
    ) -> PointName:
        """Intersect a line and an arc."""
        name = PointName(out)
        self.steps.append(IntersectLineCircle(name, line, centre, radius, sense, branch))
        return name

    def intersect_circles(
        self,
        out: str,
        centre1: PointName,
        radius1: NumberName,
        centre2: PointName,
        radius2: NumberName,
        side: Side,
        branch: NumberName | None = None,
    ) -> PointName:
        """Intersect two arcs."""
        name = PointName(out)
        step = IntersectCircles(name, centre1, radius1, centre2, radius2, side, branch)
        self.steps.append(step)
        return name

    def touch(
        self, out: str, centre: PointName, radius: NumberName, source: PointName, side: Side
    ) -> PointName:
        """Find where a line from ``source`` touches a circle."""
        name = PointName(out)
        self.steps.append(Touch(name, centre, radius, source, side))
        return name

    def pose_triad(
        self,
        out: str,
        legs: tuple[Leg, Leg, Leg],
        start: tuple[NumberName, NumberName, NumberName],
    ) -> LineName:
        """Find the axis of a link that three legs hold."""
        name = LineName(out)
        self.steps.append(TriadPose(name, legs, start))
        return name

    def spot(self, out: str, axis: LineName, at: Place) -> PointName:
        """Mark a point of a link whose axis is found."""
        name = PointName(out)
        self.steps.append(Spot(name, axis, at))
        return name

    def similar(
        self,
        out: str,
        plan: tuple[PointName, PointName],
        link: tuple[PointName, PointName, PointName],
        side: NumberName,
        *,
        span: NumberName | None = None,
        arm: NumberName | None = None,
    ) -> PointName:
        """Find the point of a plan similar to ``link[2]`` on the link ``link[0] link[1]``."""
        name = PointName(out)
        self.steps.append(Similar(name, *plan, link[2], link[0], link[1], side, span, arm))
        return name

    def measure(self, out: str, tail: PointName, head: PointName) -> NumberName:
        """Read a length."""
        name = NumberName(out)
        self.steps.append(Measure(name, tail, head))
        return name

    def measure_along(
        self, out: str, tail: PointName, head: PointName, line: LineName
    ) -> NumberName:
        """Read a signed length."""
        name = NumberName(out)
        self.steps.append(MeasureAlong(name, tail, head, line))
        return name

    def carry(
        self,
        out: str,
        origin: PointName,
        tail: PointName,
        head: PointName,
        length: NumberName | None = None,
        *,
        times: NumberName | None = None,
        rotated: bool = False,
    ) -> PointName:
        """Carry a segment to another point."""
        name = PointName(out)
        self.steps.append(Carry(name, origin, tail, head, length, times, rotated))
        return name

    def measure_arm(
        self, out: str, about: PointName, at: PointName, tail: PointName, head: PointName
    ) -> NumberName:
        """Read the arm of a vector."""
        name = NumberName(out)
        self.steps.append(MeasureArm(name, about, at, tail, head))
        return name

    def measure_angle(self, out: str, line: LineName, base: LineName | None = None) -> NumberName:
        """Read the angle of a line from another one, or from +x."""
        name = NumberName(out)
        self.steps.append(MeasureAngle(name, line, base))
        return name

    def total(self, out: str, *terms: NumberName) -> NumberName:
        """Add numbers."""
        name = NumberName(out)
        self.steps.append(Total(name, terms))
        return name

    def compute(
        self, out: str, *powers: tuple[NumberName, int], factor: float = 1.0, size: bool = False
    ) -> NumberName:
        """Compute ``factor`` times a product of powers."""
        name = NumberName(out)
        self.steps.append(Compute(name, factor, powers, size))
        return name


# no messages: mistakes in a program
def substituted(program: Program, names: Iterable[Name]) -> Program:
    """Return a program in which some points and numbers are given instead of made.

    Their values are then data of the program, beside its own: points in mm, numbers in their unit.

    Raises
    ------
    ProgramError
        No step makes a name, or the step makes a line: a line is determined by its points.
    """
    given = set(names)
    unknown = given - {step.out for step in program.steps}
    if unknown:
        raise ProgramError(f"no step makes {', '.join(sorted(unknown))}")

    def change(step: Step) -> Step:
        if step.out not in given:
            return step
        if result_kind(step) is PointName:
            return GivenPoint(PointName(step.out))
        if result_kind(step) is NumberName:
            return GivenNumber(NumberName(step.out))
        raise ProgramError(f"{step.out} is a line: give a point of it, or a number")

    return rewritten(program, change)


# no messages: mistakes in a program
def rewritten(program: Program, change: Callable[[Step], Step | tuple[Step, ...]]) -> Program:
    """Return a program with every step changed or kept.

    Parameters
    ----------
    change : callable
        Takes a step and returns its replacement: the same step, or another one that makes the same
        name of the same kind from earlier results; or several, the last of which does.

    Raises
    ------
    ProgramError
        A step makes another name or kind than the one it replaces, or uses a name that is made
        later.
    """
    steps: list[Step] = []
    for before in program.steps:
        changed = change(before)
        several = changed if isinstance(changed, tuple) else (changed,)
        after = several[-1]
        if (after.out, result_kind(after)) != (before.out, result_kind(before)):
            raise ProgramError(f"{after.out} cannot replace {before.out}")
        steps.extend(several)
    return Program(tuple(steps))
