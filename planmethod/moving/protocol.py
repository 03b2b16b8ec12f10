"""Drawing of a moving point, step by step, in the words of the explanatory note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.ruler import RulerArithmetic
from planmethod.construct.scale import Scale
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.moving.construction import (
    POLES,
    ConstructionVector,
    MomentConstruction,
    construct,
    read_hodograph,
)
from planmethod.moving.interval import DrawnInterval, drawn_interval
from planmethod.moving.model import PointProblem
from planmethod.moving.motion import LEGEND
from planmethod.moving.sheet import read_rows, sheet_scales
from planmethod.moving.text import given_facts, moment, title
from planmethod.note.document import Caption, Chapter, Node, Paragraph, steps_of, table_of
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.narrator import Line, Reading, StepNarrator
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import with_unit
from planmethod.note.wording import Language


def protocol_document(
    problem: PointProblem, language: Language, profile: Profile
) -> Iterator[Node]:
    """Yield the construction of a moving point; the scales are those of the sheet.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval.
    LayoutError
        The sheet cannot be drawn.
    """
    course, texts, notation = drawn_interval(problem), language.point, language.notation
    scales = sheet_scales(problem, course, profile)
    yield title(problem)
    if problem.source:
        yield Paragraph(language.note.source.format(source=escape(problem.source)))
    facts = given_facts(problem, language)
    text = language.note.given.format(given="; ".join(fact.text for fact in facts))
    yield Paragraph(text, facts=tuple(facts))
    yield Paragraph(texts.wanted)
    convention = problem.scales.convention
    text = ", ".join(scale_inscription(scales[name], convention, notation) for name in "lva")
    yield Paragraph(language.note.scales_text.format(scales=text))
    yield Paragraph(language.note.ruler.format(ruler=notation.as_input(profile.ruler)))
    start, end = (notation.as_input(t) for t in course.interval)
    count = len(course.marks.columns["t"])
    yield Paragraph(texts.curve.format(start=start, end=end, last=count - 1))
    for k in course.shown:
        time = notation.as_input(float(course.marks.columns["t"][k]))
        yield Chapter(texts.at.format(time=time), numbered=False)
        yield from moment(problem, course.marks, k, language)
        built = construct(problem, course.marks, k, scales)
        if built is not None:
            narrator = PointNarrator(built, language, profile)
            for step in built.program.steps:
                yield from steps_of(narrator.narrate(step))
            yield Caption(texts.read_title.format(profile=language.note["profiles"][profile.name]))
            yield table_of(texts["read"], read_rows(built, course.marks, k, language, profile))
    yield from _hodograph(course, scales["v"], language, profile)


def _hodograph(
    course: DrawnInterval, scale: Scale, language: Language, profile: Profile
) -> Iterator[Node]:
    """Yield the accelerations that the hodograph of the velocity gives."""
    chords, notation = read_hodograph(course, scale, profile), language.notation
    said = language.point
    if len(chords.at) < 2:
        return
    yield Chapter(said.by_hodograph, numbered=False)
    yield Paragraph(said.chord_told)
    rows = []
    for row, k in enumerate(chords.at):
        one = chords.series[row]
        at = notation.as_input(float(course.marks.columns["t"][k]))
        rows.append([str(k), at, *notation.numbers(*one.texts, one.off_text)])
    yield table_of(said["chords"], rows, names=0)


class PointNarrator(StepNarrator):
    """Tells the steps of one moment (рассказчик)."""

    def __init__(self, built: MomentConstruction, language: Language, profile: Profile) -> None:
        self.built, self.language, self.texts = built, language, language.point
        self.step = {step.out: step for step in built.program.steps}
        self.exact: Trace = built.read()
        self.read: Trace = built.read(RulerArithmetic(ruler=profile.ruler))
        self.parts: dict[PointName, ConstructionVector] = {}
        for vector in built.vectors:
            if not vector.is_resultant:
                self.parts.setdefault(vector.head, vector)
        self.columns = {number: column for column, number in built.results.items()}

    def _number(self, name: Name, *, exact: bool = False) -> float:
        trace = self.exact if exact else self.read
        return float(np.ravel(trace.value[name])[0])

    def _format(self, value: float, digits: int = 4) -> Rich:
        return self.language.notation.short(value, digits)

    def _of(self, name: PointName) -> Rich:
        """Return a point in the genitive: "точки P", "полюса p", "конца a_x"."""
        texts = self.language.note
        while isinstance(step := self.step[name], steps.LayOffLength) and not self._number(
            step.length
        ):
            name = step.origin  # nothing was laid off
        if name in self.parts:
            return self.texts.end.format(symbol=self.parts[name].symbol)
        text = texts.of_pole if name in POLES.values() else texts.of_point
        return text.format(point=self.built.letters[name])

    def describe_line(self, step: Line) -> list[Rich]:
        """Describe a ray, a line across the wheel, or the direction of the tangent."""
        match step:
            case steps.AtAngle(_, through, _, angle):
                text = self.texts.ray if self._number(angle) else self.texts.level
                turn = self._format(self._number(angle))
                return [text.format(of=self._of(through), angle=turn)]
            case steps.Join(_, tail, head) if tail not in POLES.values():
                letters = self.built.letters
                return [self.texts.join.format(tail=letters[tail], head=letters[head])]
            case steps.Parallel(_, through, to) if isinstance(self.step[to], steps.Join):
                return [self.texts.tangent.format(of=self._of(through))]
            case _:
                return []

    def describe_intersection(self, step: steps.IntersectLines) -> list[Rich]:
        """Describe the foot of the perpendicular on the tangent."""
        return [self.texts.foot.format(point=self.built.letters[step.out])]

    def describe_measured_segment(self, step: Reading) -> list[Rich]:
        """Describe a side of the wheel; other segments are described with their readings."""
        if any(self._is_value(one, step.out) for one in self.columns):
            return []
        length = self._format(self._number(step.out))
        return [self.texts.measured.format(segment=self.built.letters[step.out], length=length)]

    def _is_value(self, result: NumberName, length: NumberName) -> bool:
        made = self.step[result]
        return isinstance(made, steps.Compute) and made.powers[0][0] == length

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[Rich]:
        """Describe a vector, or a side of the wheel: its length, origin and direction."""
        texts, made, letters = self.texts, self.step[step.length], self.built.letters
        assert isinstance(made, steps.Compute)
        mm, symbol = self._number(step.length), letters[step.length]
        if isinstance(self.step[made.powers[-1][0]], steps.Measure):
            return [texts.across_pm.format(length=self._format(abs(mm)))]
        if not mm:
            return [texts.nothing.format(symbol=symbol)]
        part = self.parts.get(step.out)
        plan = "l" if part is None else part.plan
        per_mm = self._format(self.built.scales[plan].per_mm)
        numbers = fraction(self._format(abs(self._number(made.powers[0][0]))), per_mm)
        quotient = fraction(f"|{symbol}|", f"μ_{{{plan}}}")
        turned = isinstance(self.step[step.line], steps.Perpendicular)
        way = texts["ways"][("across" if turned else "along") + ("" if mm >= 0 else " back")]
        text = texts.lay_off_side if part is None else texts.lay_off
        return [
            text.format(
                symbol=symbol,
                size=f"{quotient} = {numbers} = {self._format(abs(mm))}",
                of=self._of(step.origin),
                way=way,
                point=letters[step.out],
            )
        ]

    def describe_computed_number(self, step: steps.Compute) -> list[Rich]:
        """Describe a value read off the drawing."""
        column = self.columns.get(step.out)
        if column is None:
            return []
        found = self._number(step.out)
        value = with_unit(self._format(found), self.language.notation.units[LEGEND[column].unit])
        symbol, (length, _) = self.built.letters[step.out], step.powers[0]
        if not isinstance(self.step[length], steps.Measure | steps.MeasureAlong):
            if not np.isfinite(found):
                return []
            v, a = (self._format(self._number(name)) for name, _ in step.powers)
            sought = f"{fraction('v^{2}', 'a^{n}')} = {fraction(f'{v}^{{2}}', a)}"
            return [f"{symbol} = {sought} = {value}."]
        plan = "v" if column == "v" else "a"
        mm, segment = self._number(length), self.built.letters[length]
        scale = self._format(self.built.scales[plan].per_mm)
        size = f"({self._format(mm)})" if mm < 0 else self._format(mm)
        return [
            self.texts.value.format(
                segment=segment,
                length=self._format(mm),
                exact=self._format(self._number(length, exact=True), 5),
                formula=f"{symbol} = μ_{{{plan}}}·{segment} = {scale}·{size} = {value}",
            )
        ]
