"""Strokes of the steps of a construction: the one match over the union of steps that draws.

A line has no length of its own: it is drawn as far as the points that are found on it. A line that
only carries a length, or only gives another its direction, is not drawn: the segment is.
"""

from __future__ import annotations

from cmath import isfinite, phase
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence, Set
from math import degrees, pi
from typing import Any, assert_never

import numpy as np

from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, PointName, Step
from planmethod.note.formula import Rich
from planmethod.render.ink.drawing import Disc, Ink, Item
from planmethod.render.labels.label_column import label_merged_letters, merge_letters
from planmethod.render.pictures.lettered import lettered
from planmethod.render.play.appearing import Moments
from planmethod.render.play.playback import ArcMark, Dot, Mark, PlayedStep, Role, Segment, xy

EXTENSION, NOTCH = 6.0, 7.0
"""Extension of a line beyond the points on it, and half of a notch, mm."""

LEAST_LINE = 25.0
"""Least length of a line on which points are found, mm."""

SHORTEST = 0.05
"""Shortest segment that is a stroke, mm."""


class Strokes:
    """Strokes of the steps of a program (штрихи).

    Parameters
    ----------
    program : iterable of Step
        All steps that are drawn.
    value : mapping
        Values of the steps: points, mm; lines as a place and a direction.
    board : callable
        Returns the board on which a step is drawn.
    index : int
        Which of several positions.
    dots : callable, optional
        Returns whether a point of the program is a visible point of the drawing; default: all.
    """

    def __init__(
        self,
        program: Iterable[Step],
        value: Mapping[Name, Any],
        board: Callable[[Step], str],
        index: int = 0,
        *,
        dots: Callable[[PointName], bool] | None = None,
    ) -> None:
        self.value, self.board, self.index = value, board, index
        self._dots = dots or (lambda _: True)
        self.step: dict[Name, Step] = {step.out: step for step in program}
        self._on: dict[LineName, list[PointName]] = {}
        self._carried: dict[LineName, list[PointName]] = {}
        for step in self.step.values():
            match step:
                case steps.IntersectLines(out, first, second):
                    self._on.setdefault(first, []).append(out)
                    self._on.setdefault(second, []).append(out)
                case steps.IntersectLineCircle(out=out, line=line):
                    self._on.setdefault(line, []).append(out)
                case steps.LayOffLength(out, _, line):
                    self._carried.setdefault(line, []).append(out)
                case _:
                    pass

    def point(self, name: PointName) -> complex:
        """Return the place of a point, mm."""
        return complex(self._entry(self.value[name]))

    def line(self, name: LineName) -> tuple[complex, complex]:
        """Return a place of a line, mm, and its direction, a unit vector."""
        at, along = (complex(self._entry(one)) for one in self.value[name])
        return at, along / abs(along) if along else 1 + 0j

    def _entry(self, value: Any) -> Any:
        flat = np.ravel(value)
        return flat[self.index] if len(flat) > 1 else flat[0]

    def of(self, step: Step) -> list[Mark]:
        """Return the strokes of a step; none of one that is undefined in the position."""
        try:
            marks = list(self._marks(step))
        except (ZeroDivisionError, OverflowError):
            return []
        return [mark for mark in marks if _is_finite(mark)]

    def played(self, lines: Sequence[Rich], program_steps: Iterable[Step]) -> PlayedStep:
        """Return the played step of sentences and the steps that they describe."""
        covered = list(program_steps)
        names = {step.out for step in covered}
        marks = dict.fromkeys(
            mark for step in covered for mark in (*self.of(step), *self._carrier(step, names))
        )
        return PlayedStep(tuple(lines), tuple(str(step.out) for step in covered), tuple(marks))

    def _marks(self, step: Step) -> Iterator[Mark]:
        board = self.board(step)
        match step:
            case steps.GivenPoint(out):
                yield from self._dot(out, board, Role.DATUM)
            case steps.Join() | steps.Parallel() | steps.Perpendicular() | steps.AtAngle():
                yield from self._line_marks(step, board)
            case steps.LayOffLength(out, origin):
                yield from self._segment(self.point(origin), self.point(out), board)
                yield from self._dot(out, board)
            case steps.IntersectLines(out):
                yield from self._dot(out, board)
            case steps.IntersectLineCircle(out, _, centre):
                yield from self._compass(centre, out, board)
                yield from self._dot(out, board)
            case steps.IntersectCircles(out, centre1, _, centre2):
                yield from self._compass(centre1, out, board)
                yield from self._compass(centre2, out, board)
                yield from self._dot(out, board)
            case steps.Touch(out, centre, _, source):
                yield from self._compass(centre, out, board)
                yield from self._segment(
                    self.point(source), self.point(out), board, Role.CONSTRUCTION
                )
                yield from self._dot(out, board)
            case steps.TriadPose(legs=legs):
                for leg in legs:
                    if leg.centre is not None:
                        yield from self._dot(leg.centre, board, Role.AID)
                        if leg.radius is not None:
                            held = self._place_on(step.out, leg.at)
                            yield from self._notch(self.point(leg.centre), held, board)
            case steps.Spot(out):
                yield from self._dot(out, board)
            case steps.Similar(out, plan_b, plan_c):
                for corner in (plan_b, plan_c):
                    yield from self._segment(
                        self.point(corner), self.point(out), board, Role.CONSTRUCTION
                    )
                yield from self._triangle(step)
                yield from self._dot(out, board)
            case steps.Measure(_, tail, head) | steps.MeasureAlong(_, tail, head):
                yield from self._read(tail, head, board)
            case steps.Carry(out, origin):
                yield from self._segment(self.point(origin), self.point(out), board)
                yield from self._dot(out, board)
            case steps.MeasureArm(_, about, at):
                yield from self._read(about, at, board)
            case steps.GivenNumber() | steps.MeasureAngle() | steps.Compute() | steps.Total():
                return
            case _:
                assert_never(step)

    def _dot(self, name: PointName, board: str, role: Role = Role.RESULT) -> Iterator[Mark]:
        if self._dots(name):
            yield Dot(xy(self.point(name)), role, board, str(name))

    @staticmethod
    def _segment(
        start: complex, end: complex, board: str, role: Role = Role.RESULT
    ) -> Iterator[Mark]:
        if abs(end - start) >= SHORTEST:
            yield Segment(xy(start), xy(end), role, board)

    def _read(self, tail: PointName, head: PointName, board: str) -> Iterator[Mark]:
        """Yield a segment that is measured, on the board that has its ends."""
        where = self._board_of(tail, head, board)
        yield from self._segment(self.point(tail), self.point(head), where, Role.AID)

    def _board_of(self, tail: PointName, head: PointName, board: str) -> str:
        """Return the board that has two points; ``board`` if they are on different ones."""
        boards = {self.board(self.step[end]) for end in (tail, head) if end in self.step}
        return boards.pop() if len(boards) == 1 else board

    def _compass(self, centre: PointName, out: PointName, board: str) -> Iterator[Mark]:
        """Yield the span of the compasses and the notch that they make."""
        yield from self._notch(self.point(centre), self.point(out), board)

    def _place_on(self, axis: LineName, at: steps.Place) -> complex:
        """Return the place of a point of a link with an axis, mm."""
        origin, along = self.line(axis)
        x, y = (0.0 if one is None else float(self._entry(self.value[one])) for one in at)
        return origin + complex(x, y) * along

    @staticmethod
    def _notch(middle: complex, place: complex, board: str) -> Iterator[Mark]:
        radius = abs(place - middle)
        if radius < SHORTEST:
            return
        yield Segment(xy(middle), xy(place), Role.AID, board)
        half = degrees(min(NOTCH / radius, pi / 6))
        turn = degrees(phase(place - middle))
        yield ArcMark(xy(middle), radius, turn - half, turn + half, Role.CONSTRUCTION, board)

    def _line_marks(
        self, step: steps.Join | steps.Parallel | steps.Perpendicular | steps.AtAngle, board: str
    ) -> Iterator[Mark]:
        """Yield a drawn line, and the line of another drawing that gives its direction."""
        found = self._on.get(step.out)
        if not found:
            return
        at, along = self.line(step.out)
        start = self.point(step.tail if isinstance(step, steps.Join) else step.through)
        ends = [start, *map(self.point, found)]
        if isinstance(step, steps.Join):
            ends.append(self.point(step.head))
        places = [((end - at) * along.conjugate()).real for end in ends if isfinite(end)]
        if not places:
            return
        low, high = min(places), max(places)
        # A line begins in a known point, whose letters are there: it goes beyond the found ones.
        known = places[:1] if len(ends) == len(found) + 1 else [places[0], places[-1]]
        longer = max(EXTENSION, LEAST_LINE - (high - low))
        low -= 0.0 if low in known else longer
        high += 0.0 if high in known else longer
        yield Segment(xy(at + low * along), xy(at + high * along), Role.CONSTRUCTION, board)
        if isinstance(step, steps.Join):  # the finished drawing may cover all of the line
            yield from self._read(step.tail, step.head, board)
        yield from self._base(step, board)

    def _carrier(self, step: Step, names: Set[Name]) -> Iterator[Mark]:
        """Yield a line on which only later steps lay lengths off: it is drawn by itself.

        A ray that only gives a direction is shown in its step.
        """
        later = self._carried.get(LineName(step.out), [])
        if isinstance(step, steps.Join) and step.out not in self._on and not later:
            yield from self._read(step.tail, step.head, self.board(step))
            return
        lines = steps.Join | steps.Parallel | steps.Perpendicular | steps.AtAngle
        if not isinstance(step, lines) or step.out in self._on or names >= {*later}:
            return
        at, along = self.line(step.out)
        start = self.point(step.tail if isinstance(step, steps.Join) else step.through)
        ends = [((end - at) * along.conjugate()).real for end in (start, *map(self.point, later))]
        if not all(map(isfinite, ends)):
            return
        low, high = min(ends) - EXTENSION, max(ends) + EXTENSION
        board = self.board(step)
        yield Segment(xy(at + low * along), xy(at + high * along), Role.CONSTRUCTION, board)

    def _base(self, step: Step, board: str) -> Iterator[Mark]:
        """Yield the segment to which a line is drawn parallel or perpendicular."""
        while isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle):
            if step.to is None:
                return
            step = self.step[step.to]
        if isinstance(step, steps.Join) and self._board_of(step.tail, step.head, board) != board:
            yield from self._read(step.tail, step.head, board)

    def _triangle(self, step: steps.Similar) -> Iterator[Mark]:
        """Yield the triangle of the link to which that of a plan is similar."""
        corners = (step.link_b, step.link_c, step.link_s)
        made = [self.step.get(corner) for corner in corners]
        boards = {self.board(one) for one in made if one is not None}
        if len(boards) != 1:
            return
        (board,) = boards
        for tail, head in zip(corners, (*corners[1:], corners[0]), strict=True):
            yield from self._segment(self.point(tail), self.point(head), board, Role.AID)


def grouped(
    pairs: Iterable[tuple[Step, Sequence[Rich]]],
) -> Iterator[tuple[Sequence[Rich], list[Step]]]:
    """Yield sentences with the steps that they describe: a silent step belongs to the next one.

    Silent steps at the end belong to the last sentences.
    """
    waiting, last = list[Step](), list[tuple[Sequence[Rich], list[Step]]]()
    for step, lines in pairs:
        waiting.append(step)
        if lines:
            yield from last
            last = [(lines, waiting)]
            waiting = []
    for lines, made in last:
        yield lines, [*made, *waiting]


def lettered_points(
    strokes: Strokes, letters: Mapping[PointName, Rich], when: Mapping[Name, int], height: float
) -> tuple[tuple[Item, ...], tuple[int, ...]]:
    """Return points with their letters as a drawing, and the steps with which each appears.

    Parameters
    ----------
    letters : mapping of PointName to Rich
    when : mapping of Name to int
        Number of the step that makes a point.
    height : float, mm
        Of the letters.
    """
    places = {name: strokes.point(name) for name in letters if name in when}
    spots = merge_letters((place, [letters[name]]) for name, place in places.items())
    if not spots:
        return (), ()
    labels = label_merged_letters(spots, height, "point")
    named = {f"point {letters[name]}": when[name] for name in reversed([*places])}
    dots = [Disc(place, 0.7, Ink.BLACK) for place, _ in spots]
    items = lettered(dots, labels).items
    moments = Moments([(place, when[name]) for name, place in places.items()], labels=named)
    return items, moments.each(items)


def _is_finite(mark: Mark) -> bool:
    match mark:
        case Segment(start=start, end=end):
            numbers = [*start, *end]
        case ArcMark(centre=centre, radius=radius, start=low, end=high):
            numbers = [*centre, radius, low, high]
        case Dot(at=at):
            numbers = [*at]
    return bool(np.isfinite(numbers).all())
