"""A synthesis in words (текст синтеза): construction step by step, sizes, what was measured."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any, assert_never

from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, Step
from planmethod.note.numbers import with_unit
from planmethod.note.plaintext import NO_BREAK, fixed, given, plain_text
from planmethod.note.wording import Language
from planmethod.note.writers.plain import table, wrap
from planmethod.note.writers.steps import Steps
from planmethod.pattern import pattern
from planmethod.synthesis.drawn import Drawn
from planmethod.synthesis.model import place

_LETTERS = pattern(r"([^\d']+)(\d*)('*)")


def point_name(name: str) -> str:
    """Return a point's name as rich text: ``A2'`` gives ``A_{2}′``."""
    match = _LETTERS.fullmatch(name)
    assert match is not None, name
    letter, index, primes = match.groups()
    return letter + (f"_{{{index}}}" if index else "") + "′" * len(primes)


class Teller:
    """Tells the steps of a construction in order (рассказчик)."""

    def __init__(self, drawn: Drawn, words: Language) -> None:
        self.drawn, self.words, self.note = drawn, words, words.note
        self.board = drawn.synthesis.board
        self.step: dict[Name, Step] = {step.out: step for step in self.board.steps}
        self._on = {
            line: [point for point in points if not point.startswith("mark ")]
            for line, points in drawn.on_line().items()
        }

    def sentences(self) -> Iterator[str]:
        """Yield the sentences, as rich text."""
        waiting = ""  # a reading: what follows from it at once stands beside it
        for step in self.board.steps:
            if step.out in self.board.said:
                said = self.board.said[step.out]
                told = "" if said is None else self._own(*said)
            else:
                told = self._tell(step)
            if waiting and told:
                joined = isinstance(step, steps.Compute)
                yield f"{waiting[:-1]}; {told}" if joined else waiting
                waiting, told = "", "" if joined else told
            if told and isinstance(step, steps.Measure):
                waiting = told
            elif told:
                yield told
        if waiting:
            yield waiting

    def _own(self, key: str, facts: Mapping[str, str | float]) -> str:
        shown = {
            name: self._points(value) if isinstance(value, str) else given(value, self.note, 6)
            for name, value in facts.items()
        }
        return self.words.synthesis.steps[key].format(**shown)

    def _points(self, names: str) -> str:
        return ", ".join(point_name(name) for name in names.split(", "))

    def _segment(self, *names: str) -> str:
        return "".join(map(point_name, names))

    def _hand(self, name: NumberName) -> float:
        """Return what the hand has of a number; the exact value where its drawing fails."""
        value = float(self.drawn.by_hand.value[name])
        return value if math.isfinite(value) else float(self.drawn.paper.value[name])

    def _mm(self, name: NumberName) -> str:
        value = abs(self._hand(name))
        return f"{given(value, self.note, 5)} {self.note.units['mm']}"

    def _base(self, line: LineName) -> str:
        """Return what a line is called: by two of its points, in its sense; or the x axis."""
        points = self._on[line]
        ways = {point: self.drawn.way(line, point) for point in points}
        first = points[0]
        other = max(points[1:], key=lambda point: ways[point] - ways[first], default=None)
        if other is None:
            return self.note.x_axis
        ends = (first, other) if ways[other] >= ways[first] else (other, first)
        return self._segment(*ends)

    def _direction(self, line: LineName) -> str:
        """Return how a line runs: parallel, perpendicular or at an angle to another."""
        step, note = self.step[line], self.note
        if isinstance(step, steps.Join):
            return note.along.format(base=self._segment(step.tail, step.head))
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
        return note.at_angle.format(angle=given(abs(angle), note, 6), base=base) + side

    def _line(self, line: LineName) -> str:
        """Return a line in the genitive."""
        step, note = self.step[line], self.note
        if (said := self.board.said.get(line)) is not None:
            base = self._segment(str(said[1]["tail"]), str(said[1]["head"]))
            return self.words.synthesis.to_bisector.format(base=base)
        if isinstance(step, steps.Join):
            return note.line_join.format(base=self._segment(step.tail, step.head))
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        of = note.of_point.format(point=point_name(step.through))
        return note.line_through.format(of=of, direction=self._direction(line))

    def _tell(self, step: Step) -> str:
        note = self.note
        match step:
            case steps.Given(out):
                at = place(self.drawn.paper, out)
                x, y = (given(value + 0.0, note, 5) for value in (at.real, at.imag))
                return self.words.synthesis.point.format(point=point_name(out), x=x, y=y)
            case steps.LayOff(out, origin, along, length):
                reverse = self._hand(length) < 0.0
                return note.lay_off.format(
                    of=note.of_point.format(point=point_name(origin)),
                    direction=self._direction(along),
                    length=f"{self._segment(origin, out)} = {self._mm(length)}",
                    sense=note.backwards if reverse else "",
                    point=point_name(out),
                )
            case steps.MeetLines(out, first, second):
                return note.meet.format(
                    first=self._line(first), second=self._line(second),
                    point=point_name(out), coincide="",
                )  # fmt: skip
            case steps.MeetLineCircle(out, line, centre, radius, way):
                course = complex(self.drawn.paper.value[line][1]) * way.value
                if abs(course.real) >= abs(course.imag):
                    which = note.rightmost if course.real > 0 else note.leftmost
                else:
                    which = note.upper if course.imag > 0 else note.lower
                return note.arc_and_line.format(
                    centre=point_name(centre), radius=self._mm(radius),
                    line=self._line(line), way=which, point=point_name(out),
                )  # fmt: skip
            case steps.MeetCircles(out, one, first, two, second, side):
                return note.two_arcs.format(
                    one=point_name(one), first=self._mm(first), two=point_name(two),
                    second=self._mm(second), point=point_name(out),
                    side=note.left if side.value > 0 else note.right,
                )  # fmt: skip
            case steps.Measure(out, tail, head):
                exact = abs(float(self.drawn.paper.value[out]))
                return note.measure.format(
                    segment=self._segment(tail, head), exact=fixed(exact, note),
                    length=given(abs(self._hand(out)), note, 5),
                )  # fmt: skip
            case steps.Compute(out, factor, powers):
                return self._found(out, factor, powers[0][0]) if out.startswith("l ") else ""
            case steps.Known() | steps.Join() | steps.Parallel() | steps.Perpendicular():
                return ""
            case steps.AtAngle() | steps.Total():
                return ""
            case steps.Touch() | steps.Similar() | steps.MeasureAlong():
                return ""  # no synthesis is drawn with them
            case steps.Carry() | steps.MeasureArm():
                return ""
            case _:
                assert_never(step)

    def _found(self, out: NumberName, factor: float, read: NumberName) -> str:
        """Return the formula of a length of the mechanism."""
        name, say = str(out).removeprefix("l "), self.words.say
        value = say.short(self._hand(out), 4)
        symbol = "e" if name == "e" else f"l_{{{name}}}"
        made = self.step[read]
        if isinstance(made, steps.Compute):  # half the difference, which is laid off as well
            factor, made = made.factor, self.step[made.powers[0][0]]
        half = " / 2" if factor == 0.5 else ""
        return f"{symbol} = μ_{{l}}·{self._sides(made)}{half} = {value} {say.units['m']}."

    def _sides(self, made: Step) -> str:
        if isinstance(made, steps.Measure):
            return self._segment(made.tail, made.head)
        assert isinstance(made, steps.Total)
        parts = []
        for k, term in enumerate(made.terms):
            step = self.step[term]
            sign = " + "
            if isinstance(step, steps.Compute):
                sign, step = " − ", self.step[step.powers[0][0]]
            parts.append((sign if k else "") + self._sides(step))
        return f"({''.join(parts)})"


def given_facts(asked: Mapping[str, Any], words: Language) -> list[str]:
    """Return what is given, one ``symbol = value unit`` each, as rich text."""
    facts = []
    for name, value in asked.items():
        if value is None:
            continue
        symbol, unit = words.synthesis.given[name]
        if isinstance(value, tuple):
            rows = value if isinstance(value[0], tuple) else (value,)
            told = "; ".join(f"({f';{NO_BREAK}'.join(map(words.say.given, row))})" for row in rows)
            facts.append(f"{symbol.replace(' ', NO_BREAK)}: {told}")
        else:
            number = words.say.given(value)
            told = with_unit(number, words.say.units[unit]) if unit else number
            facts.append(f"{symbol} = {told}".replace(" ", NO_BREAK))
    return facts


def size_rows(drawn: Drawn, words: Language) -> list[tuple[str, str, str, str]]:
    """Return the rows of the table of sizes: symbol, exact, read, sigma, as rich text."""
    say, rows = words.say, []
    for name, value in drawn.synthesis.metres().items():
        symbol = "e" if name == "e" else f"l_{{{name}}}"
        rows.append(
            (symbol, say.short(value, 6), say.short(drawn.read(name), 4),
             say.short(drawn.sigma[name], 2))
        )  # fmt: skip
    return rows


def check_rows(checks: Mapping[str, Any], words: Language) -> list[tuple[str, str]]:
    """Return what was measured, one name and value each, as rich text."""
    said, say = words.synthesis, words.say
    rows = []

    def row(name: str, value: float | None, unit: str) -> None:
        if value is not None:
            number = say.short(value, 6)
            rows.append((said.checks[name], with_unit(number, say.units[unit]) if unit else number))

    row("K_v", checks["K_v"], "")
    if checks["stroke_unit"] == "m":
        row("stroke", checks["stroke"], "m")
    row("swing", checks["swing"], "deg")
    row("slow_deg", checks["slow_deg"], "deg")
    row("quick_deg", checks["quick_deg"], "deg")
    row("pressure", checks["pressure_angle"]["max_deg"], "deg")
    row("transmission", checks["transmission_angle"]["min_deg"], "deg")
    grashof = checks["grashof"]
    told = f"{said.holds[grashof['holds']]}: {said.verdicts[grashof['type']]}"
    rows.append((said.checks["grashof"], told))
    row("missed", checks.get("missed"), "m")
    for name in ("branch", "order"):
        if name in checks:
            rows.append((said.checks[name], said.holds[checks[name]]))
    return rows


def synthesis_text(
    drawn: Drawn, asked: Mapping[str, Any], checks: Mapping[str, Any], words: Language
) -> str:
    """Return the whole synthesis as plain text."""
    said, note = words.synthesis, words.note
    text = Steps(note)
    text.lines.append(said.titles[drawn.synthesis.kind])
    facts = "; ".join(map(plain_text, given_facts(asked, words)))
    text.lines += wrap(note.given.format(given=facts))
    text.lines += wrap(plain_text(ruler_line(drawn, words)))
    text.chapter(said.construction)
    for sentence in Teller(drawn, words).sentences():
        text.item([sentence])
    text.chapter(said.lengths)
    rows = [[plain_text(cell) for cell in row] for row in size_rows(drawn, words)]
    text.lines += table(said.columns, rows)
    text.chapter(said.measured)
    text.lines += [
        f"{plain_text(name)}: {plain_text(value)}" for name, value in check_rows(checks, words)
    ]
    return "\n".join(text.lines) + "\n"


def ruler_line(drawn: Drawn, words: Language) -> str:
    """Return the ruler and the scale of the drawing."""
    return words.synthesis.ruler.format(
        ruler=words.say.given(drawn.profile.ruler), scale=words.say.given(drawn.mu)
    )
