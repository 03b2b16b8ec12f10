"""How a moving point is drawn, step by step, in the words of the explanatory note (протокол)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import assert_never

import numpy as np

from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import Trace
from planmethod.construct.hand import Hand
from planmethod.construct.scale import Scale
from planmethod.construct.steps import LineName, Name, PointName, Step
from planmethod.moving.construction import POLES, Construction, construct, read_hodograph
from planmethod.moving.course import Course, course_of
from planmethod.moving.model import PointProblem
from planmethod.moving.sheet import read_rows, sheet_scales
from planmethod.moving.text import law_lines, moment_lines, unit_of
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import significant, with_unit
from planmethod.note.plaintext import plain_text
from planmethod.note.rounding import rounded_to, sigma_text
from planmethod.note.wording import Language, language
from planmethod.note.writers.plain import heading, table, wrap


def protocol_text(problem: PointProblem, lang: str, profile: Profile) -> str:
    """Return the construction of a moving point as text of at most 100 columns.

    The scales are those of the sheet.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval.
    LayoutError
        The sheet cannot be drawn.
    """
    words, course = language(lang), course_of(problem)
    said, say = words.point, words.say
    scales = sheet_scales(problem, course, profile)
    variant = f" ({problem.variant})" if problem.variant else ""
    lines = heading(f"{problem.title or problem.name}{variant}")
    if problem.source:
        lines += wrap(words.note.source.format(source=problem.source))
    moments = "; ".join(map(say.given, sorted(set(problem.times))[:3]))
    facts = "; ".join([*law_lines(problem, words), said.moments.format(times=moments)])
    lines += ["", *_wrapped([words.note.given.format(given=facts)]), *_wrapped([said.wanted])]
    convention = problem.scales.convention
    told = ", ".join(scale_inscription(scales[name], convention, say) for name in "lva")
    lines += ["", *_wrapped([words.note.scales_text.format(scales=told)])]
    lines += _wrapped([words.note.ruler.format(ruler=say.given(profile.ruler))])
    start, end = (say.given(t) for t in course.interval)
    count = len(course.marks.columns["t"])
    lines += _wrapped([said.curve.format(start=start, end=end, last=count - 1)])
    for k in course.shown:
        time = say.given(float(course.marks.columns["t"][k]))
        lines += ["", *heading(said.at.format(time=time))]
        lines += _wrapped(moment_lines(problem, course.marks, k, words))
        built = construct(problem, course.marks, k, scales)
        if built is not None:
            sentences = list(_Teller(built, words, profile).sentences())
            lines += ["", *_wrapped(f"{n}. {text}" for n, text in enumerate(sentences, 1))]
            lines += ["", *_readings(built, course, k, words, profile)]
    return "\n".join([*lines, *_hodograph(course, scales["v"], words, profile)])


def _wrapped(texts: Iterator[str] | Sequence[str]) -> list[str]:
    return [line for text in texts for line in wrap(plain_text(text), rest="  ")]


def _readings(
    built: Construction, course: Course, k: int, words: Language, profile: Profile
) -> list[str]:
    """Return what the drawing gives beside the exact values, with its error."""
    whole = read_rows(built, course.marks, k, words, profile)
    rows = [[plain_text(cell) for cell in row] for row in whole]
    title = words.point.read_title.format(profile=words.note.profiles[profile.name])
    return [title, *table(words.point.read, rows)]


def _hodograph(course: Course, scale: Scale, words: Language, profile: Profile) -> list[str]:
    """Return the accelerations that the hodograph of the velocity gives."""
    chords, say = read_hodograph(course, scale, profile), words.say
    if len(chords.at) < 2:
        return []
    rows = []
    for k, read, sigma, exact in zip(
        chords.at, chords.read, chords.sigma, chords.exact, strict=True
    ):
        time = say.given(float(course.marks.columns["t"][k]))
        cells = [str(k), time, say.number(significant(float(exact)))]
        cells += [say.number(rounded_to(float(read), float(sigma)))]
        cells += [say.number(sigma_text(float(sigma)))]
        cells += [say.number(significant(float(read - exact), 2))]
        rows.append([plain_text(cell) for cell in cells])
    said = words.point
    return ["", *heading(said.by_hodograph), *wrap(plain_text(said.chord_told)), "",
            *table(said.chords, rows, left=0)]  # fmt: skip


class _Teller:
    """Tells the steps of one construction in order (рассказчик)."""

    def __init__(self, built: Construction, words: Language, profile: Profile) -> None:
        self.built, self.words = built, words
        self.step: Mapping[Name, Step] = {step.out: step for step in built.program.steps}
        self.exact: Trace = built.read()
        self.read: Trace = built.read(Hand(ruler=profile.ruler))
        self.plan = {vector.head: vector.plan for vector in built.vectors if not vector.is_whole}

    def sentences(self) -> Iterator[str]:
        """Yield the sentences."""
        for step in self.built.program.steps:
            yield from self._tell(step)

    def _number(self, name: Name, *, exact: bool = False) -> float:
        trace = self.exact if exact else self.read
        return float(np.ravel(trace.value[name])[0])

    def _put(self, value: float, digits: int = 4) -> str:
        return self.words.say.short(value, digits)

    def _letter(self, name: Name) -> str:
        return self.built.letters.get(name, str(name).rstrip(":"))

    def _of(self, name: PointName) -> str:
        """Return a point in the genitive: "точки P", "полюса p", "конца a_x"."""
        words = self.words.note
        while isinstance(step := self.step[name], steps.LayOff) and not self._number(step.length):
            name = step.origin  # nothing was laid off
        if name.endswith(":"):
            return self.words.point.end.format(symbol=name.rstrip(":"))
        text = words.of_pole if name in POLES.values() else words.of_point
        return text.format(point=self._letter(name))

    def _tell(self, step: Step) -> Iterator[str]:
        said = self.words.point
        match step:
            case steps.AtAngle(_, through, _, angle):
                turn = self._put(self._number(angle))
                text = said.ray if self._number(angle) else said.level
                yield text.format(of=self._of(through), angle=turn)
            case steps.LayOff(out, origin, along, length):
                yield self._laid(out, origin, along, length)
            case steps.Join(_, tail, head) if head == "M":
                yield said.join.format(tail=self._letter(tail), head=self._letter(head))
            case steps.Parallel(_, through, to) if isinstance(self.step[to], steps.Join):
                yield said.tangent.format(of=self._of(through))
            case steps.MeetLines(out):
                yield said.foot.format(point=self._letter(out))
            case steps.Compute(out, _, powers, _):
                if isinstance(self.step[powers[0][0]], steps.Measure | steps.MeasureAlong):
                    yield self._value(out, powers[0][0])
                elif out == "rho" and np.isfinite(self._number(out)):
                    v, a = (self._put(self._number(name)) for name, _ in powers)
                    found = with_unit(self._put(self._number(out)), self.words.say.units["m"])
                    yield f"ρ = v^{{2}}/a_{{n}} = {v}^{{2}}/{a} = {found}."
            case steps.Measure(out) if out == "PM":
                yield said.measured.format(segment="PM", length=self._put(self._number(out)))
            case steps.Given() | steps.Known() | steps.Join() | steps.Parallel():
                return
            case steps.Perpendicular() | steps.Measure() | steps.MeasureAlong():
                return
            case steps.MeasureArm() | steps.Carry() | steps.Similar() | steps.Touch():
                return
            case steps.Total() | steps.MeetCircles() | steps.MeetLineCircle():
                return
            case _:
                assert_never(step)

    def _laid(self, out: Name, origin: PointName, along: LineName, length: Name) -> str:
        """Tell a vector, or a side of the wheel, that is laid off: how long, from where, along."""
        said, step = self.words.point, self.step[length]
        assert isinstance(step, steps.Compute)
        mm, plan = self._number(length), self.plan.get(PointName(out), "l")
        if step.powers[-1][0] == "PM":
            return said.across_pm.format(length=self._put(abs(mm)))
        symbol = self._letter(length)
        if not mm:
            return said.nothing.format(symbol=symbol)
        numbers = f"{self._put(abs(self._number(step.powers[0][0])))}/"
        numbers += self._put(self.built.scales[plan].per_mm)
        line = self.step[along]
        turned = isinstance(line, steps.Perpendicular)
        way = said.ways[("across" if turned else "along") + ("" if mm >= 0 else " back")]
        told = said.lay_off if plan != "l" else said.lay_off_side
        return told.format(
            symbol=symbol,
            size=f"|{symbol}|/μ_{{{plan}}} = {numbers} = {self._put(abs(mm))}",
            of=self._of(origin),
            way=way,
            point=self._letter(out),
        )

    def _value(self, out: Name, length: Name) -> str:
        plan = "v" if out == "v" else "a"
        mm, found = self._number(length), self._number(out)
        unit = self.words.say.units[unit_of(str(out))]
        scale = self._put(self.built.scales[plan].per_mm)
        size = f"({self._put(mm)})" if mm < 0 else self._put(mm)
        symbol = self._letter(out) if out != plan else plan
        segment = self._letter(length)
        return self.words.point.value.format(
            segment=segment,
            length=self._put(mm),
            exact=self._put(self._number(length, exact=True), 5),
            formula=f"{symbol} = μ_{{{plan}}}·{segment} = {scale}·{size} = "
            + with_unit(self._put(found), unit),
        )
