"""Drawing of a moving point, step by step, in the words of the explanatory note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.hand import Hand
from planmethod.construct.scale import Scale
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.moving.construction import (
    POLES,
    ConstructionVector,
    MomentConstruction,
    construct,
    read_hodograph,
)
from planmethod.moving.course import Course, course_of
from planmethod.moving.model import PointProblem
from planmethod.moving.motion import LEGEND
from planmethod.moving.sheet import read_rows, sheet_scales
from planmethod.moving.text import given, moment, title
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import Caption, Chapter, Node, Paragraph, steps_of, table_of
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.narrator import Line, Reading, StepNarrator
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import significant, with_unit
from planmethod.note.wording import Language


def protocol_document(problem: PointProblem, words: Language, profile: Profile) -> Iterator[Node]:
    """Yield the construction of a moving point; the scales are those of the sheet.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval.
    LayoutError
        The sheet cannot be drawn.
    """
    course, said, say = course_of(problem), words.point, words.say
    scales = sheet_scales(problem, course, profile)
    yield title(problem)
    if problem.source:
        yield Paragraph(words.note.source.format(source=escape(problem.source)))
    facts = given(problem, words)
    told = words.note.given.format(given="; ".join(fact.text for fact in facts))
    yield Paragraph(told, facts=tuple(facts))
    yield Paragraph(said.wanted)
    convention = problem.scales.convention
    told = ", ".join(scale_inscription(scales[name], convention, say) for name in "lva")
    yield Paragraph(words.note.scales_text.format(scales=told))
    yield Paragraph(words.note.ruler.format(ruler=say.given(profile.ruler)))
    start, end = (say.given(t) for t in course.interval)
    count = len(course.marks.columns["t"])
    yield Paragraph(said.curve.format(start=start, end=end, last=count - 1))
    for k in course.shown:
        time = say.given(float(course.marks.columns["t"][k]))
        yield Chapter(said.at.format(time=time), numbered=False)
        yield from moment(problem, course.marks, k, words)
        built = construct(problem, course.marks, k, scales)
        if built is not None:
            narrator = PointNarrator(built, words, profile)
            for step in built.program.steps:
                yield from steps_of(narrator.tell(step))
            yield Caption(said.read_title.format(profile=words.note["profiles"][profile.name]))
            yield table_of(said["read"], read_rows(built, course.marks, k, words, profile))
    yield from _hodograph(course, scales["v"], words, profile)


def _hodograph(course: Course, scale: Scale, words: Language, profile: Profile) -> Iterator[Node]:
    """Yield the accelerations that the hodograph of the velocity gives."""
    chords, say, said = read_hodograph(course, scale, profile), words.say, words.point
    if len(chords.at) < 2:
        return
    yield Chapter(said.by_hodograph, numbered=False)
    yield Paragraph(said.chord_told)
    rows = []
    for k, read, sigma, exact in zip(
        chords.at, chords.read, chords.sigma, chords.exact, strict=True
    ):
        one = ComparedNumber(float(exact), float(read), float(sigma))
        texts = (significant(one.exact), one.read_text, one.sigma_text, one.off_text)
        at = say.given(float(course.marks.columns["t"][k]))
        rows.append([str(k), at, *map(say.number, texts)])
    yield table_of(said["chords"], rows, names=0)


class PointNarrator(StepNarrator):
    """Tells the steps of one moment (рассказчик)."""

    def __init__(self, built: MomentConstruction, words: Language, profile: Profile) -> None:
        self.built, self.words, self.said = built, words, words.point
        self.step = {step.out: step for step in built.program.steps}
        self.exact: Trace = built.read()
        self.read: Trace = built.read(Hand(ruler=profile.ruler))
        self.parts: dict[PointName, ConstructionVector] = {}
        for vector in built.vectors:
            if not vector.is_whole:
                self.parts.setdefault(vector.head, vector)
        self.columns = {number: column for column, number in built.results.items()}

    def _number(self, name: Name, *, exact: bool = False) -> float:
        trace = self.exact if exact else self.read
        return float(np.ravel(trace.value[name])[0])

    def _put(self, value: float, digits: int = 4) -> Rich:
        return self.words.say.short(value, digits)

    def _of(self, name: PointName) -> Rich:
        """Return a point in the genitive: "точки P", "полюса p", "конца a_x"."""
        words = self.words.note
        while isinstance(step := self.step[name], steps.LayOff) and not self._number(step.length):
            name = step.origin  # nothing was laid off
        if name in self.parts:
            return self.said.end.format(symbol=self.parts[name].symbol)
        text = words.of_pole if name in POLES.values() else words.of_point
        return text.format(point=self.built.letters[name])

    def line(self, step: Line) -> list[Rich]:
        """Describe a ray, a line across the wheel, or the direction of the tangent."""
        match step:
            case steps.AtAngle(_, through, _, angle):
                text = self.said.ray if self._number(angle) else self.said.level
                turn = self._put(self._number(angle))
                return [text.format(of=self._of(through), angle=turn)]
            case steps.Join(_, tail, head) if tail not in POLES.values():
                letters = self.built.letters
                return [self.said.join.format(tail=letters[tail], head=letters[head])]
            case steps.Parallel(_, through, to) if isinstance(self.step[to], steps.Join):
                return [self.said.tangent.format(of=self._of(through))]
            case _:
                return []

    def meet(self, step: steps.MeetLines) -> list[Rich]:
        """Describe the foot of the perpendicular on the tangent."""
        return [self.said.foot.format(point=self.built.letters[step.out])]

    def measure(self, step: Reading) -> list[Rich]:
        """Describe a side of the wheel; other segments are described with their readings."""
        if any(self._is_value(one, step.out) for one in self.columns):
            return []
        length = self._put(self._number(step.out))
        return [self.said.measured.format(segment=self.built.letters[step.out], length=length)]

    def _is_value(self, result: NumberName, length: NumberName) -> bool:
        made = self.step[result]
        return isinstance(made, steps.Compute) and made.powers[0][0] == length

    def lay_off(self, step: steps.LayOff) -> list[Rich]:
        """Describe a vector, or a side of the wheel: its length, origin and direction."""
        said, made, letters = self.said, self.step[step.length], self.built.letters
        assert isinstance(made, steps.Compute)
        mm, symbol = self._number(step.length), letters[step.length]
        if isinstance(self.step[made.powers[-1][0]], steps.Measure):
            return [said.across_pm.format(length=self._put(abs(mm)))]
        if not mm:
            return [said.nothing.format(symbol=symbol)]
        part = self.parts.get(step.out)
        plan = "l" if part is None else part.plan
        per_mm = self._put(self.built.scales[plan].per_mm)
        numbers = fraction(self._put(abs(self._number(made.powers[0][0]))), per_mm)
        quotient = fraction(f"|{symbol}|", f"μ_{{{plan}}}")
        turned = isinstance(self.step[step.along], steps.Perpendicular)
        way = said["ways"][("across" if turned else "along") + ("" if mm >= 0 else " back")]
        told = said.lay_off_side if part is None else said.lay_off
        return [
            told.format(
                symbol=symbol,
                size=f"{quotient} = {numbers} = {self._put(abs(mm))}",
                of=self._of(step.origin),
                way=way,
                point=letters[step.out],
            )
        ]

    def compute(self, step: steps.Compute) -> list[Rich]:
        """Describe a value read off the drawing."""
        column = self.columns.get(step.out)
        if column is None:
            return []
        found = self._number(step.out)
        value = with_unit(self._put(found), self.words.say.units[LEGEND[column].unit])
        symbol, (length, _) = self.built.letters[step.out], step.powers[0]
        if not isinstance(self.step[length], steps.Measure | steps.MeasureAlong):
            if not np.isfinite(found):
                return []
            v, a = (self._put(self._number(name)) for name, _ in step.powers)
            sought = f"{fraction('v^{2}', 'a^{n}')} = {fraction(f'{v}^{{2}}', a)}"
            return [f"{symbol} = {sought} = {value}."]
        plan = "v" if column == "v" else "a"
        mm, segment = self._number(length), self.built.letters[length]
        scale = self._put(self.built.scales[plan].per_mm)
        size = f"({self._put(mm)})" if mm < 0 else self._put(mm)
        return [
            self.said.value.format(
                segment=segment,
                length=self._put(mm),
                exact=self._put(self._number(length, exact=True), 5),
                formula=f"{symbol} = μ_{{{plan}}}·{segment} = {scale}·{size} = {value}",
            )
        ]
