"""Outputs of a moving point: audit, students' quantities, drawing step by step."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property, partial

import numpy as np
from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.drafting import PROFILES, Profile, RulerArithmetic
from planmethod.construct.evaluate import Trace
from planmethod.construct.scale import Scale
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.moving.construction import (
    POLES,
    ConstructionVector,
    DrawnInterval,
    MomentConstruction,
    construct,
    drawn_interval,
    read_hodograph,
)
from planmethod.moving.motion import LEGEND, POLAR, Law, Motion, PointProblem, Undefined, move
from planmethod.moving.reader import QUANTITY_COLUMNS, column_of
from planmethod.moving.sheet import read_rows, sheet_scales
from planmethod.moving.text import given_facts, moment, title
from planmethod.note.audit import Audited
from planmethod.note.document import Caption, Chapter, Node, Paragraph, steps_of, table_of
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.narrate.narrator import Line, Reading, StepNarrator
from planmethod.note.numbers import with_unit
from planmethod.note.wording import Language
from planmethod.problem.records import (
    AnswerValue,
    Mistaken,
    QuantityReader,
    Relation,
    Relations,
    RelationTerm,
)
from planmethod.solved.quantity_steps import NoValue


def audited(problem: PointProblem, ruler: float) -> list[Audited]:
    """Compare every printed value with the exact one, and with that read off the drawing.

    Parameters
    ----------
    ruler : float, mm
        Step to which lengths are read; the scales are those of the sheet.
    """
    if not problem.published:
        return []
    motion, profile = move(problem), replace(PROFILES["board"], ruler=ruler)
    scales = sheet_scales(problem, drawn_interval(problem), profile)
    told = []
    for item in problem.published:
        k = item.position or 0
        if not item.what:
            told.append(Audited(item, reason=NoValue.NO_QUANTITY))
            continue
        exact = float(motion.columns[item.what][k])
        if np.isnan(exact):
            divided = motion.reasons[k] in (Undefined.REST, Undefined.STRAIGHT)
            told.append(Audited(item, reason=NoValue.ZERO_DIVISOR if divided else NoValue.NO_POINT))
            continue
        built = construct(problem, motion, k, scales)
        read = built.ruled(ruler).get(item.what, np.nan) if built is not None else np.nan
        plan = item.what[0] if item.what != "rho" else ""
        per_mm = scales[plan].per_mm if plan in scales else None
        told.append(Audited(item, exact, None if np.isnan(read) else read, per_mm))
    return told


SIZES = ("v", "a", "a_normal", "rho")
USUAL = ("v", "a", "a_tau", "a_n", "rho")
PARTS = ("a_tangential", "a_normal")
ROOTS = {"v": ("vx", "vy"), "a": ("ax", "ay")}
"""Lengths of vectors, and their parts."""


class PointQuantities:
    """Quantities of a moving point for questions (`QuestionQuantities`)."""

    def __init__(self, problem: PointProblem) -> None:
        self.problem, self.count = problem, len(problem.times)
        self.names = tuple(n for n in USUAL if self.quantity(n, 0) is not None)

    @cached_property
    def motion(self) -> Motion:
        """Motion at the moments of the file."""
        return move(self.problem)

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity by its name of ``[published]``, or as people write it."""
        column = column_of(name)
        value = None if column is None else _value(self.motion, name, position)
        if column is None or value is None:
            return None
        quantity = LEGEND[column]
        return AnswerValue(quantity.symbol, quantity.unit, value, signed=column not in SIZES)

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of the reading."""
        scales = sheet_scales(self.problem, drawn_interval(self.problem), profile)
        built = construct(self.problem, self.motion, position, scales)
        column = column_of(name) or ""
        sigma = {} if built is None else built.sigma(profile)
        if column not in sigma:
            return None
        scale = scales.get(column[0])
        value = abs(_value(self.motion, name, position) or 0.0)
        return (math.nan if scale is None else value / scale.per_mm), sigma[column]

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes: roots, the parts of the acceleration, degrees."""
        changes: list[tuple[str, QuantityReader]] = [
            ("K1", self._exchanged),
            *(("K2", partial(self._resultant, of)) for of in (PARTS, PARTS[:1], PARTS[1:])),
            *(("K3", partial(self._rooted, of, 2)) for of in (("v", "a"), ("v",), ("a",))),
            *(("K4", partial(self._rooted, of, 1)) for of in (("v", "a"), ("v",), ("a",))),
            ("K5", self._curved),
        ]
        for code, change in changes:
            yield Mistaken(code, "", change)
        turned = {key: one.in_degrees for key, one in self.problem.formulas.items()}
        if turned != self.problem.formulas:
            motion = move(replace(self.problem, formulas=turned))
            yield Mistaken("K6", "", partial(_value, motion))
        if self.problem.law is Law.POLAR:
            yield from _polar_mistakes(self.motion)

    def _of(self, column: str, position: int) -> float | None:
        return _value(self.motion, column, position)

    def _exchanged(self, name: str, position: int) -> float | None:
        """Mistake a_n for a_tau and vice versa."""
        parts = dict(zip(PARTS, PARTS[::-1], strict=True))
        column = column_of(name) or ""
        return self._of(parts.get(column, column), position)

    def _resultant(self, parts: tuple[str, ...], name: str, position: int) -> float | None:
        """Take the whole acceleration for some of its parts."""
        column = column_of(name) or ""
        return self._of("a" if column in parts else column, position)

    def _rooted(self, of: tuple[str, ...], power: int, name: str, position: int) -> float | None:
        """Leave out the root of some lengths, or the squares under it as well."""
        column = column_of(name) or ""
        if column not in of:
            return self._of(column, position)
        parts = (self._of(part, position) or 0.0 for part in ROOTS[column])
        return abs(sum(part**power for part in parts))

    def _curved(self, name: str, position: int) -> float | None:
        """Leave the square out of v²/a_n."""
        v, across = self._of("v", position), self._of("a_normal", position)
        if column_of(name) == "rho" and v is not None and across:
            return v / across
        return self._of(name, position)

    def relations(self, names: Sequence[str], position: int) -> Relations:
        """Return lengths by their parts, the parts of a by projections or each other, rho by v."""
        asked = {column_of(name) or "": name for name in reversed(names)}
        terms = {}
        for column in LEGEND.keys() & self.motion.columns.keys():
            value = _value(self.motion, column, position)
            if value is not None:
                symbol = LEGEND[column].symbol
                terms[column] = RelationTerm(value, symbol, asked.get(column, ""))
        if self.problem.law is Law.POLAR:
            phi = float(self.motion.columns["phi"][position])
            terms["cos_phi"] = RelationTerm(math.cos(phi), "cos φ")
            terms["sin_phi"] = RelationTerm(math.sin(phi), "sin φ")
        if self.problem.radius is not None:
            terms["R"] = RelationTerm(self.problem.radius, "R")
        found = []
        for out, formula, codes in FORMULAS:
            needs = {*re.findall(r"[A-Za-z_]+", formula)} - {"sqrt", "abs"}
            if out in asked and needs <= terms.keys():
                is_usual = needs <= {*asked, "R"}
                found.append(Relation(asked[out], formula, codes, is_usual=is_usual))
        instead = {
            name: {key: code for key, code in taken.items() if key in terms}
            for column, taken in INSTEAD.items()
            for name in (column, asked.get(column, column))
        }
        return Relations(terms, tuple(found), instead)


LENGTH = {"root": "K3", "squares": "K4"}

FORMULAS: tuple[tuple[str, str, Mapping[str, str]], ...] = (
    ("v", "sqrt(v_r**2 + v_phi**2)", LENGTH),
    ("v", "sqrt(vx**2 + vy**2)", LENGTH),
    ("v", "abs(omega) * sqrt((x - xP)**2 + (y - yP)**2)", {}),
    ("a", "sqrt(a_r**2 + a_phi**2)", LENGTH),
    ("a", "sqrt(ax**2 + ay**2)", LENGTH),
    ("a", "sqrt(a_tangential**2 + a_normal**2)", LENGTH),
    ("vx", "v_r*cos_phi - v_phi*sin_phi", {}),
    ("vy", "v_r*sin_phi + v_phi*cos_phi", {}),
    ("ax", "a_r*cos_phi - a_phi*sin_phi", {}),
    ("ay", "a_r*sin_phi + a_phi*cos_phi", {}),
    ("a_tangential", "(vx*ax + vy*ay) / v", {}),
    ("a_tangential", "(vx*ax + vy*ay) / sqrt(vx**2 + vy**2)", {}),
    ("a_tangential", "(v_r*a_r + v_phi*a_phi) / v", {}),
    ("a_normal", "v**2 / R", {"square": "K5"}),
    ("a_normal", "sqrt(a**2 - a_tangential**2)", LENGTH),
    ("a_normal", "abs(vx*ay - vy*ax) / v", {}),
    ("a_normal", "abs(vx*ay - vy*ax) / sqrt(vx**2 + vy**2)", {}),
    ("a_normal", "abs(v_r*a_phi - v_phi*a_r) / v", {}),
    ("a_normal", "v**2 / rho", {}),
    ("rho", "v**2 / a_normal", {"square": "K5"}),
    ("rho", "v**3 / abs(vx*ay - vy*ax)", {}),
    ("rho", "v**3 / abs(v_r*a_phi - v_phi*a_r)", {}),
)
"""Formulas of a moving point: quantity, how it is found, codes of mistakes in that."""

PARTS_OF = {"vx": "vy", "v_r": "v_phi", "ax": "ay", "a_r": "a_phi"}

INSTEAD: Mapping[str, Mapping[str, str]] = {
    "a_tangential": {"a": "K2", "a_normal": "K1"},
    "a_normal": {"a": "K2", "a_tangential": "K1"},
    "v": dict.fromkeys(("a", "vx", "vy"), "slip"),
    "a": dict.fromkeys(("a_normal", "a_tangential", "ax", "ay"), "slip"),
    **{one: {other: "slip"} for one, other in PARTS_OF.items()},
    **{other: {one: "slip"} for one, other in PARTS_OF.items()},
}
"""What is taken for a quantity, and the code of that."""


def _polar_mistakes(motion: Motion) -> Iterator[Mistaken]:
    """Yield the projections of a point on a turning rod with the mistakes that students make.

    The angle is in degrees, the acceleration to the centre or that of Coriolis is left out, or the
    factor 2 of the latter.
    """
    r, phi, v_r, v_phi, a_r, a_phi = (motion.columns[name] for name in POLAR)
    with np.errstate(divide="ignore", invalid="ignore"):
        centripetal, coriolis = v_phi**2 / r, 2.0 * v_r * v_phi / r
    parts = (
        ("K6", np.radians(phi), a_r, a_phi),
        ("N2", phi, a_r + centripetal, a_phi),
        ("A1", phi, a_r, a_phi - coriolis),
        ("A3", phi, a_r, a_phi - coriolis / 2),
    )
    for code, angle, along, across in parts:
        turn = np.exp(1j * angle)
        point, v, a = r * turn, (v_r + 1j * v_phi) * turn, (along + 1j * across) * turn
        with np.errstate(divide="ignore", invalid="ignore"):
            by_tangent = v.conj() * a / abs(v)
            rho = abs(v) ** 2 / abs(by_tangent.imag)
        columns = {
            "x": point.real,
            "y": point.imag,
            "vx": v.real,
            "vy": v.imag,
            "ax": a.real,
            "ay": a.imag,
            "a": abs(a),
            "a_r": along,
            "a_phi": across,
            "a_tangential": by_tangent.real,
            "a_normal": abs(by_tangent.imag),
            "rho": rho,
        }
        made = replace(motion, columns={**motion.columns, **columns})
        yield Mistaken(code, "", partial(_value, made))


def _value(motion: Motion, name: str, position: int) -> float | None:
    value = float(motion.columns[QUANTITY_COLUMNS.get(name) or column_of(name) or name][position])
    return value if math.isfinite(value) else None


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
