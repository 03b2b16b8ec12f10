"""Names, letters, formulas and vector equations of a construction for the reader."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence

from msgspec import Struct

from planmethod.construct import steps
from planmethod.construct.scale import Scale
from planmethod.construct.steps import Compute, LineName, Name, NumberName, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.document import input_text, plain_text
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.digits import PrintedNumbers
from planmethod.note.narrate.equations import StatedEquation, stated_equations
from planmethod.note.numbers import Notation, is_noise
from planmethod.note.wording import Language, MessageTable, get_language
from planmethod.plans.build import kinds_on
from planmethod.plans.model import (
    FACTS,
    MOTION,
    RATES,
    ZERO_VECTOR,
    Dimension,
    DimensionKind,
    Direction,
    Plan,
    PlanKind,
    Relation,
    Vector,
    VectorKind,
    is_primed,
    pole_letter,
)
from planmethod.plans.motion.legs import offset_name
from planmethod.problem.model import Convention, Problem
from planmethod.problem.names import fold
from planmethod.solved.legibility import DetailView
from planmethod.solved.quantities import solution_peak
from planmethod.solved.solution import Solution

SIGN = {Relation.PARALLEL: "∥", Relation.PERPENDICULAR: "⊥"}


def plan_letters(problem: Problem, plan: Plan) -> dict[PointName, list[str]]:
    """Return the letters of every plan point; those of the pole begin with the pole's own."""
    primed = is_primed(problem, plan.kind)
    letters = {
        at: [_primed(letter) if primed else letter for letter in text.split(", ")]
        for at, text in plan.letters.items()
    }
    if plan.pole is not None:
        letters[plan.pole] = [pole_letter(problem, plan.kind), *letters.get(plan.pole, [])]
    return letters


def _primed(letter: str) -> str:
    head, brace, tail = letter.partition("_{")
    return f"{head}′_{{{tail}" if brace else f"{head}′"


def mark(*points: str) -> str:
    """Return names of mechanism points in rich text: ``mark("O3", "A")`` gives ``O_{3}A``."""
    return "".join(f"{name[:1]}_{{{name[1:]}}}" if name[1:] else name for name in points)


def pair_letters(name: str) -> str:
    """Return the designation of a pair as rich text: ``O1(0,3)`` gives ``O_{1}(0,3)``."""
    point, bracket, links = name.partition("(")
    return f"{mark(point)}{bracket}{links}"


def direction_text(direction: Direction | None, notation: Notation | None = None) -> str:
    """Return a direction as it stands under a term, in rich text: ``⊥ BC``, ``C → B``, ``= 0``.

    ``notation`` writes the degrees of an angle in a language.
    """
    if direction is None:
        return ""
    base = direction.guide or mark(*direction.ends)
    match direction.relation:
        case Relation.ZERO:
            return "= 0"
        case Relation.TOWARDS:
            return " → ".join(mark(point) for point in direction.ends)
        case Relation.ANGLED:
            degrees = f"{direction.angle:.4g}"
            return f"∠ {notation.number(degrees) if notation else degrees}° {base}"
        case Relation.PARALLEL | Relation.PERPENDICULAR:
            return f"{SIGN[direction.relation]} {base}"


def spot_letters(problem: Problem, point: str, links: Collection[str] | None = None) -> Rich:
    """Return the letters at a point of a scheme: its own, and those of links that are under it.

    Parameters
    ----------
    links : collection of str, optional
        Links of which letters are wanted; default: all.
    """
    at = [of for of in problem.letters.points.values() if of[0] == point]
    others = [
        problem.letters.line_letter(link, point) for _, link in at if links is None or link in links
    ]
    return ", ".join(dict.fromkeys(map(point_name, (point, *others))))


_DIGITS = r"\d+"
SCALE_KIND = {FACTS[kind].scale: kind for kind in MOTION}
SCALE_SYMBOL = {kind: f"μ_{{{FACTS[kind].letter}}}" for kind in MOTION}


class LineDirection(Struct, frozen=True):
    """Direction of a drawn line: turned by ``angle`` degrees (in (-180, 180]) from ``base``."""

    base: str
    angle: float
    start: PointName | None = None
    end: PointName | None = None


class Names:
    """Names for the reader, of one solution in one language, as rich text (обозначения).

    Points of the plans are called by their letters, points of the mechanism by their own names,
    the feet of offsets by a prime, numbers by their symbols, lines by their parallels.

    Parameters
    ----------
    solution : Solution
    texts : MessageTable
    on_sheet : bool
        For formulas that are lettered: an index is lowered there, so that the ``3`` of ``O3`` is
        one as well, and no dash need keep the ends of a segment apart.
    """

    def __init__(self, solution: Solution, texts: MessageTable, *, on_sheet: bool = False) -> None:
        self.solution, self.texts, self.on_sheet = solution, texts, on_sheet
        self.construction = solution.construction
        self.kinematics = solution.construction.kinematics
        problem = solution.problem
        self.step: dict[Name, Step] = {step.out: step for step in self.construction.program.steps}
        self.letters: dict[PointName, list[str]] = {}
        self.poles: set[PointName] = set()
        for plan in self.construction.plans:
            for at, letters in plan_letters(problem, plan).items():
                self.letters[at] = letters
            assert plan.pole is not None
            self.poles.add(plan.pole)
        self.guides = {
            f"{slide.label}:0": problem.guide_name(slide.label)
            for slide in problem.slides.values()
            if slide.host == FRAME
        }
        self._given = {q + p: p + q for p, q in self._lengths()}
        self._slots: dict[str, str] = {}
        for slide in problem.slides.values():
            if slide.host != FRAME and slide.towards is None and slide.label == slide.through:
                known = self._slots.get(slide.label, slide.host)
                self._slots[slide.label] = slide.host if known == slide.host else ""
        self._auxiliary: dict[PointName, str] = {}
        self._stated: dict[PlanKind, tuple[StatedEquation, ...]] = {}
        self._roles = dict(self._number_roles())

    def _lengths(self) -> Iterator[tuple[str, str]]:
        """Yield the ends of every given length, in the order the problem writes them."""
        for body in self.solution.problem.bodies.values():
            points = list(body.points)
            for i, p in enumerate(points):
                for q in points[i + 1 :]:
                    yield (q, p) if self.construction.draft.has_length(q, p) else (p, q)

    # Points ----------------------------------------------------------------------------------

    def point(self, name: PointName) -> str:
        """Return a point's letter or name."""
        if name in self.letters:
            return self.letters[name][0]
        foot_of = self.construction.draft.feet.get(name)
        if foot_of is not None:
            return self._auxiliary_name(name, foot_of + "′")
        if isinstance(self.step.get(name), steps.Touch):
            return self._auxiliary_name(name, "T")
        return self.guides.get(name) or self._lowered(name)

    def _lowered(self, name: str) -> str:
        return re.sub(_DIGITS, r"_{\g<0>}", name) if self.on_sheet else name

    def _auxiliary_name(self, name: PointName, text: str) -> str:
        """Return the name of an auxiliary point, with primes that make it unique."""
        if name not in self._auxiliary:
            while text in self._auxiliary.values() or text in self.solution.points:
                text += "′"
            self._auxiliary[name] = text
        return self._auxiliary[name]

    def further_letters(self, name: PointName) -> list[str]:
        """Return the further letters of a plan point: of points that move alike."""
        return self.letters.get(name, [""])[1:]

    def of(self, name: PointName) -> str:
        """Return a point in the genitive: "точки b", "полюса p"."""
        texts = self.texts
        if name in self.poles:
            return texts.of_pole.format(point=self.point(name))
        if name in self.guides:
            return texts.of_guide_start.format(guide=self.guides[name])
        return texts.of_point.format(point=self.point(name))

    def ends(self, tail: PointName, head: PointName) -> tuple[str, str]:
        """Return the letters of two points, in the position plan those of the link they are on."""
        one, two = self.point(tail), self.point(head)
        if not {tail, head} & {*self.letters}:
            problem = self.solution.problem
            for place, link in problem.letters.points.values():
                body, letter = problem.bodies[link].points, problem.letters.line_letter(link, place)
                if place == tail and head in body and tail not in body:
                    one = self._lowered(letter)
                elif place == head and tail in body and head not in body:
                    two = self._lowered(letter)
        return one, two

    def segment(self, tail: PointName, head: PointName) -> str:
        """Return a segment by its ends: ``bc``, ``BC``, ``b–n_CB``."""
        one, two = self.ends(tail, head)
        apart = "_" in plain_text(one + two) and not self.on_sheet
        return f"{one}–{two}" if apart else one + two

    # Lines -----------------------------------------------------------------------------------

    def axis(self, text: str) -> str:
        """Return the reader's name of a line of a link.

        Its letters are in the order in which its length was given (CB becomes BC); a line that
        is given by one point and an angle is called the guide of its link.
        """
        if text in self._slots:
            link = self._slots[text]
            return self.texts.slot_of.format(link=link) if link else self.texts.slot
        return self._given.get(text, text)

    def base(self, direction: Direction) -> str:
        """Return the reader's name of the line that defines a direction."""
        if direction.relation is Relation.ANGLED:
            return "".join(direction.points)
        return self.axis(direction.guide or "".join(direction.ends))

    def direction(self, line: LineName) -> LineDirection:
        """Return the line from which another is rotated, and the angle."""
        step = self.step[line]
        match step:
            case steps.Join(_, tail, head):
                return LineDirection("".join(self.ends(tail, head)), 0.0, tail, head)
            case steps.Parallel(_, through, to):
                found = self.direction(to)
                if through == found.start:  # the same line drawn again
                    return found
                if through == found.end:  # produced beyond its end
                    back = found.base if found.start is None else self.segment(through, found.start)
                    return LineDirection(back, 180.0, through, found.start)
                return LineDirection(found.base, found.angle)
            case steps.Perpendicular(_, _, to):
                found = self.direction(to)
                return LineDirection(found.base, _reduced(found.angle + 90.0))
            case steps.AtAngle(_, _, None, angle):
                guide = self.guide(line)
                if guide is not None:
                    return LineDirection(guide, 0.0)
                if angle in self.angles:
                    axis = self.solution.problem.bodies[self.angles[angle]].axis
                    if axis is not None:
                        return LineDirection("".join(axis), 0.0)
                return LineDirection(self.texts.x_axis, self.value_of(angle))
            case steps.AtAngle(_, _, to, angle):
                assert to is not None
                found = self.direction(to)
                return LineDirection(found.base, _reduced(found.angle + self.value_of(angle)))
            case _:
                raise TypeError(f"{step.out} is no line")

    @property
    def angles(self) -> Mapping[str, str]:
        """Links of the angles that are known numbers: of cranks, and of wheels."""
        drives = self.solution.problem.drive.every
        turned = {one.program_inputs[0]: one.link for one in drives if one.is_crank}
        return turned | {name: of for of, name in self.construction.draft.angles.items()}

    def guide(self, line: LineName) -> str | None:
        """Return the name of the frame's guide that a line is, or None."""
        step = self.step[line]
        if not isinstance(step, steps.AtAngle) or step.to is not None:
            return None
        told = self.construction.draft.dimensions.get(step.angle)
        return None if told is None else self.solution.problem.guide_name(told.of[0])

    def value_of(self, angle: NumberName) -> float:
        """Return a given angle, degrees."""
        return self.construction.draft.numbers.get(angle, 0.0)

    def relation(self, line: LineName) -> str:
        """Return a line's direction in signs: ``⊥ BC``, ``∥ x-x``."""
        found = self.direction(line)
        if found.angle in (0.0, 180.0):
            return f"∥ {self.axis(found.base)}"
        if abs(found.angle) == 90.0:
            return f"⊥ {self.axis(found.base)}"
        angle = input_text(abs(found.angle), self.texts)
        return self.texts.at_angle.format(angle=angle, base=found.base)

    def line(self, line: LineName) -> str:
        """Return a drawn line in the genitive."""
        texts, step = self.texts, self.step[line]
        guide = self.guide(line)
        if guide is not None:
            return texts.line_guide.format(guide=guide)
        if isinstance(step, steps.Join):
            return texts.line_join.format(base=self.direction(line).base)
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        return texts.line_through.format(of=self.of(step.through), direction=self.relation(line))

    # Numbers ---------------------------------------------------------------------------------

    def _number_roles(self) -> Iterator[tuple[NumberName, str]]:
        drive = self.solution.problem.drive
        yield NumberName("phi"), f"φ_{{{drive.link}}}"
        for link, angle in self.construction.draft.angles.items():
            yield angle, f"φ_{{{link}}}"
        if not drive.is_crank:
            pin = self.solution.problem.slides[drive.link].pin
            yield NumberName("v"), f"v_{{{pin}}}"
            yield NumberName("a"), f"a_{{{pin}}}"
        for other in drive.other_drives:
            place, rate, gain = map(NumberName, other.program_inputs)
            letter = "s" if other.pivot is None else "φ"
            yield place, f"{letter}_{{{other.link}}}"
            if other.pivot is None:
                pin = self.solution.problem.slides[other.link].pin
                yield rate, f"v_{{{pin}}}"
                yield gain, f"a_{{{pin}}}"
        for letter, table in (("ω", self.kinematics.omega), ("ε", self.kinematics.epsilon)):
            seen: set[NumberName] = set()
            for link, number in table.items():
                if self.owner(number) == link and number not in seen:
                    seen.add(number)
                    yield number, f"{letter}_{{{link}}}"
        for motion in (self.kinematics.velocity, self.kinematics.acceleration):
            for ends, number in motion.segments.lengths.items():
                yield number, f"({self.segment(*ends)})"
            for ends, number in motion.segments.values.items():
                whole = self.absolute(ends[1]) if ends[0] == motion.pole else ""
                vector = self.vector(*ends)
                if whole or vector is not None:
                    yield number, whole or (vector.symbol if vector else "")

    def owner(self, number: NumberName) -> str:
        """Return the link whose own angular velocity or acceleration a number is."""
        for (kind, link), _ in self.kinematics.turnings.items():
            if self.kinematics.rates(kind).get(link) == number:
                return link
        for link in self.construction.draft.angles:
            if any(rates.get(link) == number for rates in map(self.kinematics.rates, RATES)):
                return link
        for other in self.solution.problem.drive.other_drives:
            if number in other.program_inputs:
                return other.link
        return self.solution.problem.drive.link

    def symbol(self, number: NumberName) -> str:
        """Return the symbol of a number: ``l_BC``, ``ω₂``, ``(bc)``, ``μ_v``."""
        if number in self._roles:
            return self._roles[number]
        if number in SCALE_KIND:
            return SCALE_SYMBOL[SCALE_KIND[number]]
        step = self.step[number]
        match step:
            case steps.Measure(_, tail, head) if tail not in self.letters:
                return self.segment(tail, head)
            case steps.Measure(_, tail, head) | steps.MeasureAlong(_, tail, head, _):
                return f"({self.segment(tail, head)})"
            case steps.Compute():
                return self._lowered(number.strip("|"))
            case _:
                told = self.construction.draft.dimensions.get(number)
                if told is not None and told.kind is DimensionKind.OFFSET:
                    return self._offset_symbol(number, told)
                letter, _, index = number.partition("_")
                return f"{letter}_{{{index}}}" if index else letter

    def _offset_symbol(self, number: NumberName, dimension: Dimension) -> str:
        """Return the symbol of a distance from a guide: as given, else by the link it is from."""
        draft, (pin, *_) = self.construction.draft, dimension.of
        own = [s for s in draft.problem.slides.values() if s.offset and s.pin == pin]
        value = abs(draft.numbers[number])
        for slide in own:
            if abs(abs(slide.offset) - value) <= 1e-9 * value:
                return offset_name(slide, draft.problem)
        of_pin = [one for name, one in draft.dimensions.items() if name in draft.numbers]
        if own or sum((one.kind, one.of) == (dimension.kind, dimension.of) for one in of_pin) > 1:
            return f"e_{{{dimension.letters.removeprefix(dimension.kind.value)}}}"
        return f"e_{{{pin}}}"

    def is_inverse_scale(self) -> bool:
        """Return whether scales are written as millimetres per unit."""
        return self.solution.problem.scales.convention is Convention.MM_PER_UNIT

    # Vectors ---------------------------------------------------------------------------------

    def plan_of(self, point: PointName) -> Plan | None:
        """Return the velocity or acceleration plan that a point is on."""
        for plan in self.construction.plans:
            if point in plan.letters or point == plan.pole:
                return plan
        return None

    def vector(self, tail: PointName, head: PointName) -> Vector | None:
        """Return the vector that a segment shows, the one with a stated direction first."""
        plan = self.plan_of(tail)
        if plan is None:
            return None
        terms = [term for equation in plan.equations for term in equation.right]
        found = [v for v in (*plan.vectors, *terms) if (v.tail, v.head) == (tail, head)]
        stated = [v for v in found if v.direction not in (None, ZERO_VECTOR)]
        return next(iter(stated or found), None)

    def absolute(self, head: PointName) -> str:
        """Return the symbol of a point's whole velocity or acceleration, empty if it has none."""
        plan = self.plan_of(head)
        if plan is None:
            return ""
        vectors = [*(equation.left for equation in plan.equations), *plan.vectors]
        return next(
            (v.symbol for v in vectors if v.head == head and v.kind is VectorKind.ABSOLUTE),
            "",
        )

    def stated(self, kind: PlanKind) -> tuple[StatedEquation, ...]:
        """Return the equations of a plan as the file wants them."""
        if kind not in self._stated:
            self._stated[kind] = stated_equations(self.construction, self.solution.problem, kind)
        return self._stated[kind]

    def determining(self, point: PointName) -> list[StatedEquation]:
        """Return the equations whose solution is a plan point."""
        plan = self.plan_of(point)
        if plan is None or plan.kind not in RATES:
            return []
        return [one for one in self.stated(plan.kind) if one.head == point]

    def solved(self, numbers: Sequence[Rich]) -> list[Rich]:
        """Return the sentence that equations are solved, if they have numbers."""
        if not numbers:
            return []
        form = self.texts.solved_one if len(numbers) == 1 else self.texts.solved_many
        return [form.format(numbers=", ".join(numbers))]

    def ray(self, line: LineName) -> Vector | None:
        """Return the unknown component that a line of a plan carries."""
        step = self.step[line]
        if not isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle):
            return None
        plan = self.plan_of(step.through)
        if plan is None:
            return None
        return next(
            (
                term
                for head in self._intersections(line)
                for equation in self.stated(plan.kind)
                for term in (*equation.left, *equation.right)
                if (term.tail, term.head) == (step.through, head) and term.direction
            ),
            None,
        )

    def _intersections(self, line: LineName) -> Iterator[PointName]:
        for step in self.construction.program.steps:
            if line in (getattr(step, "first", None), getattr(step, "second", None)):
                yield PointName(step.out)

    def pole(self, kind: PlanKind) -> str:
        """Return the letter of a plan's pole."""
        return pole_letter(self.solution.problem, kind)


def _reduced(angle: float) -> float:
    """Return an angle in (-180, 180] degrees."""
    return 180.0 - (180.0 - angle) % 360.0


SHORTEST_MM = 1e-9
"""Length, mm, below which a segment is a point."""


class Formulas:
    """Values of one position, as the hand has them, and formulas with them (расчётные формулы).

    Magnitudes are written without signs: words beside them give the sense.
    """

    def __init__(
        self, solution: Solution, names: Names, index: int, *, in_full: bool = False
    ) -> None:
        self.solution, self.names, self.index = solution, names, index
        self.is_short = names.on_sheet and not in_full
        """Whether numbers have the digits of a sheet: an explanatory note has them in full."""
        self.texts = names.texts
        self.language = get_language(names.texts.lang)
        self.notation = self.language.notation
        self.printed = PrintedNumbers(solution, names.step, index)

    # Values ----------------------------------------------------------------------------------

    def number(self, name: NumberName) -> float:
        """Return a number as the hand has it."""
        return float(self.solution.ruler_reading.number(name)[self.index])

    def magnitude(self, name: NumberName) -> float:
        """Return a number without its sign, on a sheet as printed."""
        return self.printed.of(name).value if self.is_short else abs(self.number(name))

    def operand(self, name: NumberName) -> Rich:
        """Return the magnitude of a number as a formula has it: on a sheet with few digits."""
        if self.is_short:
            return self.notation.number(self.printed.of(name).text)
        return self.notation.short(abs(self.number(name)))

    def result(self, name: NumberName) -> Rich:
        """Return the magnitude of a number as its formula ends: on a sheet as others have it."""
        if self.is_short:
            return self.operand(name)
        return self.notation.short(abs(self.number(name)), 4)

    def exact_value(self, name: NumberName) -> float:
        """Return a number without the error of reading."""
        return float(self.solution.paper.number(name)[self.index])

    @property
    def position(self) -> float:
        """Position of the driver, degrees or m."""
        return float(self.solution.positions[self.index])

    def readable(self, name: Name) -> bool:
        """Return whether the hand has a value: not where it divides by a reading of 0."""
        return bool(self.solution.ruler_reading.has(name)[self.index])

    def place(self, point: PointName) -> complex:
        """Return a point of the exact drawing, mm."""
        column = self.solution.paper.point(point)
        return complex(column[self.index])

    def direction_vector(self, line: LineName) -> complex:
        """Return a vector along a line of the exact drawing."""
        return complex(self.solution.paper.line_vector(line)[self.index])

    def per_mm(self, kind: PlanKind) -> float:
        """Return the scale of a plan, unit per mm."""
        return self.solution.plan_scale(kind, self.index).per_mm

    # Formulas --------------------------------------------------------------------------------

    def unit(self, key: str) -> str:
        """Return a unit in the language."""
        return self.notation.units[key]

    def exactly(self, value: float, unit: str = "") -> str:
        """Return the exact value in brackets; empty on a sheet, whose table has it."""
        if self.names.on_sheet:
            return ""
        text = f"{self.notation.computed(value)} {unit}".rstrip()
        return self.texts.exact.format(value=text)

    def product(
        self,
        powers: Iterable[tuple[NumberName, int]],
        factor: float = 1.0,
        *,
        called: str | None = None,
    ) -> tuple[str, str]:
        """Return a product of powers in symbols and in numbers, a fraction where there is one.

        ``called`` is another symbol for the factor that is not a scale.
        """
        factors: list[tuple[str, float | Rich, int, bool]] = []
        for name, power in powers:
            is_scale = name in SCALE_KIND
            symbol = self.names.symbol(name) if is_scale or called is None else called
            value = abs(self.number(name)) if is_scale else self.operand(name)
            factors.append((symbol, value, power, is_scale))
        return self.fraction(factors, factor)

    def fraction(
        self, factors: Sequence[tuple[str, float | Rich, int, bool]], factor: float = 1.0
    ) -> tuple[str, str]:
        """Return factors (symbol, value, power, is a scale) as a fraction: symbols and numbers."""
        above: list[tuple[str, str]] = []
        below: list[tuple[str, str]] = []
        if factor != 1.0:
            above.append((self.notation.as_input(factor),) * 2)
        for symbol, value, power, is_scale in factors:
            if is_scale and self.names.is_inverse_scale():
                value, power = 1.0 / float(value), -power
            text = value if isinstance(value, str) else self.notation.short(value)
            mark = "" if abs(power) == 1 else f"^{{{abs(power)}}}"
            if mark and "·" in text:
                text = f"({text})"
            (above if power > 0 else below).append((symbol + mark, text + mark))
        return _over(above, below, 0), _over(above, below, 1)

    def formula(
        self, symbol: str, sides: Sequence[str], value: float | Rich, unit: str, more: str = ""
    ) -> str:
        """Return ``symbol = in symbols = in numbers = value unit``, without repetition."""
        number = value if isinstance(value, str) else self.notation.short(value, 4)
        parts = [symbol, *(side for side in sides if side != number), f"{number} {self.unit(unit)}"]
        return " = ".join(parts) + more

    def laid_off_formulas(
        self, step: Compute, segment: str, kind: PlanKind, vector: Vector | None
    ) -> list[str]:
        """Return how a length to be laid off on a plan is computed: the quantity, then the length.

        On a sheet, a quantity that is not given covers both.

        Parameters
        ----------
        step : Compute
            The length: a quantity over the scale.
        segment : str
            Name of the length, as ``(pb)``.
        """
        (value, _), (scale, _) = step.powers
        length, mu = abs(self.number(step.out)), self.per_mm(kind)
        symbol = vector.symbol if vector else self.names.symbol(value)
        made, lines = self.names.step[value], []
        sides: tuple[str, ...] = self.fraction(
            [(symbol, _as_written(length * mu), 1, False), (self.names.symbol(scale), mu, -1, True)]
        )
        if isinstance(made, Compute):
            product = self.product(made.powers, made.factor)
            lines.append(self.formula(symbol, product, self.result(value), FACTS[kind].unit, ";"))
            sides = () if self.names.on_sheet else sides
        lines.append(self.formula(segment, sides, self.result(step.out), "mm", "."))
        return ["  ".join(lines)] if self.names.on_sheet else lines

    def quantity_from_segment(self, step: Compute, kind: PlanKind) -> str:
        """Return a quantity from the read segment that shows it."""
        symbol = self.names.symbol(step.out)
        powers = step.powers[::-1] if self.names.is_inverse_scale() else step.powers
        exact, unit = abs(self.exact_value(step.out)), FACTS[kind].unit
        if is_noise(exact, solution_peak(self.solution, kinds_on(kind)[0])):
            exact = 0.0
        if not self.readable(step.out):
            text = self.exactly(exact, self.unit(unit))
            return f"{symbol} {self.language.sheets.unreadable}{text}"
        value, product = abs(self.number(step.out)), self.product(powers)
        text = self._read_on(step) + self.exactly(exact)
        if value == 0.0 < exact:  # no enlargement of GOST 2.302 shows it
            return f"{symbol} = {product[0]} ≈ 0{text}"
        return self.formula(symbol, product, self.result(step.out), unit, text)

    def _read_on(self, step: Compute) -> str:
        """Return the detail view on which a quantity's segment is read; empty for others."""
        read_on = self.solution.read_on(self.index)
        knot = next((read_on[name] for name, _ in step.powers if name in read_on), None)
        if knot is None:
            return ""
        return f" ({self.language.sheets.read_on.format(view=view_name(knot, self.language))})"


def view_name(detail_view: DetailView, language: Language) -> str:
    """Return the name of a detail view: ``А (10:1)``."""
    ratio = language.notation.short(detail_view.times)
    return language.sheets.enlarged.format(
        letter=detail_view_letter(detail_view, language), ratio=ratio
    )


def detail_view_letter(detail_view: DetailView, language: Language) -> str:
    """Return the letter of a detail view, none that looks like that of a point.

    Where the letters are too few they start again with a number: ``Б1``.
    """
    every: tuple[str, ...] = language.sheets["knots"]
    letters = [one for one in every if fold(one) not in detail_view.initials] or every
    again, which = divmod(detail_view.number, len(letters))
    return f"{letters[which]}{again or ''}"


def _as_written(value: float) -> float:
    """Return a number as just written, so that the next formula uses the same digits."""
    return float(f"{value:.4g}")


def _over(above: list[tuple[str, str]], below: list[tuple[str, str]], which: int) -> str:
    top = "·".join(pair[which] for pair in above) or "1"
    return fraction(top, "·".join(pair[which] for pair in below)) if below else top


def direction_note(names: Names, direction: Direction | None) -> str:
    """Return a direction, links called as their lengths are: ``⊥ BC``."""
    if direction is None:
        return ""
    match direction.relation:
        case Relation.ZERO:
            return "= 0"
        case Relation.TOWARDS:
            return " → ".join(direction.ends)
        case Relation.ANGLED:
            angle = input_text(float(f"{direction.angle:.4g}"), names.texts)
            return f"∠ {angle}° {''.join(direction.points)}"
        case Relation.PARALLEL | Relation.PERPENDICULAR:
            return f"{SIGN[direction.relation]} {names.base(direction)}"


def scale_inscription(scale: Scale, convention: Convention, notation: Notation) -> str:
    """Return a scale as rich text: ``μ_v = 0,05 (м/с)/мм`` or ``μ_v = 20 мм/(м/с)``.

    What has no unit, as a ratio, has ``1/мм`` or ``мм``.
    """
    letter = scale.symbol.removeprefix("mu_")
    unit, mm = notation.in_head(scale.unit) if scale.unit else "1", notation.units["mm"]
    grouped = f"({unit})" if "/" in unit or "·" in unit else unit
    if convention is Convention.MM_PER_UNIT:
        return f"μ_{{{letter}}} = {notation.as_input(1.0 / scale.per_mm, zero_limit=0.0)} {mm}" + (
            f"/{grouped}" if scale.unit else ""
        )
    return f"μ_{{{letter}}} = {notation.as_input(scale.per_mm, zero_limit=0.0)} {grouped}/{mm}"


def point_name(point: str) -> str:
    """Return a point's name as rich text: S2 gives ``S_{2}``."""
    return f"{point[:1]}_{{{point[1:]}}}" if point[1:] else point
