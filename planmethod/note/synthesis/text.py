"""Text of a synthesis (текст синтеза): construction step by step, sizes, measurements."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

from planmethod.construct import steps
from planmethod.construct.steps import LineName, NumberName, PointName, Step
from planmethod.note.document import (
    NO_BREAK,
    input_text,
)
from planmethod.note.formula import Rich
from planmethod.note.narrate.narrator import BoardNarrator
from planmethod.note.narrate.synthesis import point_name, size_symbol
from planmethod.note.numbers import with_unit
from planmethod.note.synthesis.drawing import Drawn
from planmethod.note.wording import Language
from planmethod.synthesis.model import StepPhrase, place

LEGS = range(60, 121)
"""Longer legs that an angle is laid off with, mm."""

PRICKED = 0.5
"""Step to which a leg is set at best, mm."""


_LAID_OFF_ANGLES = frozenset({("inscribed", "rest"), ("again", "angle")})
"""Angles of sentences of a synthesis' own that are laid off, by key and place."""


def set_angle(angle: float, ruler: float, language: Language) -> Rich:
    """Return an angle for laying off: if a protractor has no such mark, by two legs, mm.

    Parameters
    ----------
    angle : float, degrees
        From 0 to 180; of more than 90° the adjacent one has the legs.
    ruler : float, mm
        Step to which the shorter leg is set; the longer one, in whole millimetres, is that by which
        the angle is met best.
    """
    text = input_text(round(angle, 2), language.note)
    if math.isclose(2.0 * angle, round(2.0 * angle), abs_tol=1e-6):
        return f"{text}°"
    sharp = min(angle, 180.0 - angle)
    tangent, step = math.tan(math.radians(min(sharp, 90.0 - sharp))), max(ruler, PRICKED)

    def leg(long: int) -> float:
        return round(long * tangent / step) * step

    long = min(LEGS, key=lambda long: abs(leg(long) / long - tangent))
    across, along = (leg(long), long) if sharp < 45.0 else (long, leg(long))
    shown = (input_text(value, language.note) for value in (round(sharp, 2), across, along))
    return language.synthesis.by_legs.format(
        angle=text, **dict(zip(("sharp", "across", "along"), shown, strict=True))
    )


class SynthesisNaming:
    """Drawn elements of a synthesis, as a `planmethod.note.narrate.narrator.Naming`."""

    def __init__(self, drawn: Drawn, language: Language) -> None:
        self.drawn, self.language, self.note = drawn, language, language.note
        self.board = drawn.synthesis.board
        self.step = {step.out: step for step in self.board.steps}
        self._on = {
            line: [point for point in points if point not in self.board.marks]
            for line, points in drawn.on_line().items()
        }

    def point(self, name: str) -> Rich:
        """Return the letter of a point."""
        return point_name(name, self.drawn.shown_letters)

    def of(self, name: PointName) -> Rich:
        """Return a point in the genitive."""
        return self.note.of_point.format(point=self.point(name))

    def segment(self, tail: str, head: str) -> Rich:
        """Return a segment by its ends."""
        return self.point(tail) + self.point(head)

    def number(self, name: NumberName) -> float:
        """Return the drafted value of a number; the exact one where the drawing fails."""
        value = float(self.drawn.ruler_reading.value[name])
        return value if math.isfinite(value) else self.exact_value(name)

    def exact_value(self, name: NumberName) -> float:
        """Return a number without the error of reading."""
        return float(self.drawn.paper.value[name])

    def direction_vector(self, name: LineName) -> complex:
        """Return a vector along a line of the exact drawing."""
        return complex(self.drawn.paper.value[name][1])

    def length(self, name: NumberName) -> Rich:
        """Return a length as the hand has it."""
        return f"{input_text(abs(self.number(name)), self.note, 5)} {self.note['units']['mm']}"

    def line(self, name: LineName) -> Rich:
        """Return a line in the genitive."""
        step, note = self.step[name], self.note
        if (said := self.board.phrases.get(name)) is not None:
            base = self.segment(str(said[1]["tail"]), str(said[1]["head"]))
            return self.language.synthesis.to_bisector.format(base=base)
        if isinstance(step, steps.Join):
            return note.line_join.format(base=self.segment(step.tail, step.head))
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        return note.line_through.format(of=self.of(step.through), direction=self.direction(name))

    def direction(self, line: LineName) -> Rich:
        """Return the direction of a line: parallel, perpendicular or at an angle to another."""
        step, note = self.step[line], self.note
        if isinstance(step, steps.Join):
            return note.along.format(base=self.segment(step.tail, step.head))
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle), step
        base = note.x_axis if step.to is None else self._base(step.to)
        angle = 90.0 if isinstance(step, steps.Perpendicular) else 0.0
        if isinstance(step, steps.AtAngle):
            angle = math.remainder(float(self.board.data[step.angle].real), 360.0)
        if abs(angle) in (0.0, 180.0):
            return note.parallel.format(base=base)
        if abs(angle) == 90.0:
            return note.perpendicular.format(base=base)
        side = (note.to_left if angle > 0 else note.to_right).format(base=base)
        if step.to is None:
            angle, side = angle % 360.0, ""
        laid = set_angle(abs(angle), self.drawn.profile.ruler, self.language)
        return self.language.synthesis.at_angle.format(angle=laid, base=base) + side

    def _base(self, line: LineName) -> Rich:
        """Return the name of a line: two of its points, in its sense; or the x axis."""
        points = self._on[line]
        ways = {point: self.drawn.distance_along(line, point) for point in points}
        first = points[0]
        other = max(points[1:], key=lambda point: ways[point] - ways[first], default=None)
        if other is None:
            return self.note.x_axis
        ends = (first, other) if ways[other] >= ways[first] else (other, first)
        return self.segment(*ends)


class SynthesisNarrator(BoardNarrator):
    """Tells the steps of a construction in order (рассказчик)."""

    naming: SynthesisNaming

    def __init__(self, drawn: Drawn, language: Language) -> None:
        super().__init__(SynthesisNaming(drawn, language), language.note)
        self.drawn, self.synthesis_texts, self.notation = (
            drawn,
            language.synthesis,
            language.notation,
        )
        self.board, self.step = self.naming.board, self.naming.step

    def sentences(self) -> Iterator[Rich]:
        """Yield the sentences; a direct consequence of a reading follows it."""
        waiting = ""
        for step in self.board.steps:
            for text in self.narrate(step):
                if waiting and isinstance(step, steps.Compute):
                    yield f"{waiting[:-1]}; {text}"
                    waiting = ""
                    continue
                if waiting:
                    yield waiting
                waiting = text if isinstance(step, steps.Measure) else ""
                if not waiting:
                    yield text
        if waiting:
            yield waiting

    def narrate(self, step: Step) -> list[Rich]:
        """Return the sentence that replaces a step's own, or the step's own."""
        if step.out in self.board.phrases:
            said = self.board.phrases[step.out]
            return [] if said is None else [self._fill_phrase(said)]
        return super().narrate(step)

    def _fill_phrase(self, phrase: StepPhrase) -> Rich:
        key, facts = phrase
        shown = {
            name: ", ".join(map(self.naming.point, value.split(", ")))
            if isinstance(value, str)
            else input_text(value, self.texts, 6)
            for name, value in facts.items()
        }
        for name, value in facts.items():
            if (key, name) in _LAID_OFF_ANGLES:
                ruler = self.drawn.profile.ruler
                shown[name] = set_angle(float(value), ruler, self.naming.language)
            elif name == "angle":
                shown[name] = input_text(round(float(value), 2), self.texts)
        sentence: str = self.synthesis_texts["steps"][key]
        return sentence.format(**shown)

    def describe_given_point(self, step: steps.GivenPoint) -> list[Rich]:
        """Describe a given point by its coordinates."""
        at = place(self.drawn.paper, step.out)
        x, y = (input_text(value + 0.0, self.texts, 5) for value in (at.real, at.imag))
        return [self.synthesis_texts.point.format(point=self.naming.point(step.out), x=x, y=y)]

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[Rich]:
        """Describe a length that is laid off."""
        naming = self.naming
        length = f"{naming.segment(step.origin, step.out)} = {naming.length(step.length)}"
        return [
            self.texts.lay_off.format(
                of=naming.of(step.origin),
                direction=naming.direction(step.line),
                length=length,
                sense=self.texts.backwards if naming.number(step.length) < 0.0 else "",
                point=naming.point(step.out),
            )
        ]

    def describe_computed_number(self, step: steps.Compute) -> list[Rich]:
        """Describe the formula of a length of the mechanism."""
        name = self.board.sizes.get(step.out)
        if name is None:
            return []
        value = self.notation.short(self.naming.number(step.out), 4)
        factor, made = step.factor, self.step[step.powers[0][0]]
        if isinstance(made, steps.Compute):  # half the difference, which is laid off as well
            factor, made = made.factor, self.step[made.powers[0][0]]
        half = f"{NO_BREAK}/{NO_BREAK}2" if factor == 0.5 else ""
        unit = self.notation.units["m"]
        symbol = size_symbol(name, self.drawn.shown_letters)
        return [f"{symbol} = μ_{{l}}·{self._sides(made)}{half} = {value} {unit}."]

    def _sides(self, source: Step) -> Rich:
        if isinstance(source, steps.Measure):
            return self.naming.segment(source.tail, source.head)
        assert isinstance(source, steps.Total)
        parts = []
        for k, term in enumerate(source.terms):
            step = self.step[term]
            sign = " + "
            if isinstance(step, steps.Compute):
                sign, step = " − ", self.step[step.powers[0][0]]
            parts.append((sign if k else "") + self._sides(step))
        return f"({''.join(parts)})"


def size_rows(drawn: Drawn, language: Language) -> list[tuple[str, str, str, str]]:
    """Return the rows of the table of sizes: symbol, exact, read, sigma, as rich text."""
    short = language.notation.short
    return [
        (
            size_symbol(series.symbol, drawn.shown_letters),
            short(one.exact, 6),
            short(one.read, 4),
            short(one.sigma, 2),
        )
        for series in drawn.series
        for one in [series[0]]
    ]


def check_rows(checks: Mapping[str, Any], language: Language) -> list[tuple[str, str]]:
    """Return the measurements, one name and value each, as rich text."""
    texts, notation = language.synthesis, language.notation
    rows = []

    def row(name: str, value: float | None, unit: str) -> None:
        if value is not None:
            number = notation.short(round(value, 2) if unit == "deg" else value, 6)
            rows.append(
                (texts["checks"][name], with_unit(number, notation.units[unit]) if unit else number)
            )

    row("K_v", checks["K_v"], "")
    if checks["stroke_unit"] == "m":
        row("stroke", checks["stroke"], "m")
    row("swing", checks["swing"], "deg")
    row("slow_deg", checks["slow_deg"], "deg")
    row("quick_deg", checks["quick_deg"], "deg")
    row("pressure", checks["pressure_angle"]["max_deg"], "deg")
    row("transmission", checks["transmission_angle"]["min_deg"], "deg")
    grashof = checks["grashof"]
    holds = texts["holds"]["yes" if grashof["holds"] else "no"]
    text = f"{holds}, {texts['verdicts'][grashof['type']]}"
    rows.append((texts["checks"]["grashof"], text))
    row("missed", checks.get("missed"), "m")
    for name in ("branch", "order"):
        if name in checks:
            rows.append((texts["checks"][name], texts["holds"]["yes" if checks[name] else "no"]))
    return rows
