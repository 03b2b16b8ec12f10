"""The account of the analytic method: contours, projections, derivatives (аналитический метод)."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from math import copysign

from msgspec import Struct

from planmethod.errors import Fault, ProblemError
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME, Prismatic
from planmethod.note.accounts.voice import Voice, VoiceForm
from planmethod.note.accounts.wheels import WheelAccount
from planmethod.note.document import Chapter, Node
from planmethod.note.formula import Rich
from planmethod.note.narrate.contours import (
    AXES,
    DECIMALS,
    Arm,
    Direction,
    LinearSystem,
    Place,
    Side,
    Turn,
    Unknown,
)
from planmethod.note.narrate.naming import mark
from planmethod.note.narrate.structure import group_title
from planmethod.note.numbers import MINUS, with_unit
from planmethod.note.spelled import (
    ONE,
    ZERO,
    Spelled,
    angle_of,
    arccos,
    degree,
    equation,
    named,
    named_angle,
    number,
    over,
    root,
    shown,
    shown_angle,
    squared,
    times,
    total,
)
from planmethod.note.wording import Language
from planmethod.plans.draft import TINY, cis, degrees
from planmethod.plans.motion.position import (
    inner_point,
    intersection_point,
    outer_point,
    rpr_parts,
    split,
)
from planmethod.problem.machine_records import ratio_of
from planmethod.problem.model import Slide
from planmethod.solved.solution import Solution


class Definition(Struct, frozen=True):
    """A letter with its value, SI or degrees: given, or by a formula (величина выкладки).

    ``letters`` is the formula, empty of a given number; ``unit`` the key of the unit, or ``°``.
    """

    symbol: Rich
    value: float
    unit: str
    letters: Rich = ""


def empty() -> Iterator[Node]:
    """Yield nothing."""
    yield from ()


class AnalyticAccount:
    """The analytic method in one position, in a voice (аналитический метод).

    The values are those of the formulas: the program of the plans gives only the assembly, which is
    the sign of a root.

    Parameters
    ----------
    solution : Solution
    index : int
        Of the position.
    language : Language
    voice : Voice

    Attributes
    ----------
    values : dict of Rich to float
        Every letter with its value, SI and degrees, once the nodes are made.
    definitions : list of Definition
        The same in their order, with their formulas; a letter that several groups use is
        defined again.
    """

    def __init__(self, solution: Solution, index: int, language: Language, voice: Voice) -> None:
        if solution.problem.drive.other_drives:
            text = "the analytic method differentiates by the coordinate of one driving link"
            hint = "Leave it out: the protocol describes the plans of all driving links."
            raise ProblemError(solution.problem.name, [Fault("drivers", text, hint)])
        self.solution, self.index, self.voice, self.language = solution, index, voice, language
        self.problem, self.draft = solution.problem, solution.construction.draft
        self.notation, self.texts = language.notation, language.analytic
        self.values: dict[Rich, float] = {}
        self.given: dict[Rich, Rich] = {}
        self.definitions: list[Definition] = []
        self.lines: list[Rich] = []
        self.places: dict[str, Place] = {}
        self.directions: dict[str, Direction] = {FRAME: Direction(None)}
        self.turns: dict[str, Turn] = {}
        crank = self.problem.drive.is_crank
        metre = self.notation.units["m"]
        per = [f"{metre}^{{{MINUS}{n}}}" for n in (1, 2)]
        # Units of derivatives: of a length, and of an angle.
        self.of_length = ("m", "m") if crank else ("", per[0])
        self.of_angle = ("", "") if crank else (per[0], per[1])
        self.coordinate = (
            f"φ_{{{self.problem.drive.link}}}" if crank else self.problem.drive.coordinate.symbol
        )

    # Letters -----------------------------------------------------------------------------------

    def mark(self, *points: str) -> Rich:
        """Return the names of points, as the voice has them."""
        return "".join(points) if self.voice.form is VoiceForm.STEPS else mark(*points)

    def define(self, symbol: Rich, value: Spelled, unit: str = "") -> Spelled:
        """Write the formula of a new letter; return the letter."""
        if value.is_constant:
            return value
        self.lines.append(equation(symbol, value, unit, self.notation))
        self.values[symbol] = value.value
        self.definitions.append(Definition(symbol, value.value, unit, value.sides()[0]))
        letters = named_angle if unit == "°" else named
        return letters(symbol, value.value, self.notation)

    def constant(self, symbol: Rich, value: float, unit: str) -> Spelled:
        """Return a given number with its letter; zero is left out of formulas."""
        if value == 0.0:
            return ZERO
        whole = shown(value, self.notation)
        whole = with_unit(whole, self.notation.units[unit]) if unit else whole
        self._note_given(symbol, value, whole, unit)
        return named(symbol, value, self.notation)

    def given_angle(self, symbol: Rich, value: float) -> Spelled:
        """Return a given angle with its letter, degrees."""
        self._note_given(symbol, value, shown_angle(value, self.notation), "°")
        return named_angle(symbol, value, self.notation)

    def _note_given(self, symbol: Rich, value: float, value_text: Rich, unit: str) -> None:
        if self.values.get(symbol) != value:
            self.definitions.append(Definition(symbol, value, unit))
        self.given[symbol] = f"{symbol} = {value_text}"
        self.values[symbol] = value

    def length(self, link: str, start: str, end: str) -> Spelled:
        """Return the distance of two points of a link."""
        points = self.problem.bodies[link].points
        ends = (end, start) if self.draft.has_length(end, start) else (start, end)
        return self.constant(f"l_{{{self.mark(*ends)}}}", abs(points[end] - points[start]), "m")

    def state(self, text: Rich, *, numbered: bool = False) -> Iterator[Node]:
        """Yield the formulas so far under a text."""
        lines, self.lines = self.lines, []
        if lines:
            yield from self.voice.statement(text, lines, numbered=numbered)

    def _exact(self, point: str) -> complex:
        return complex(self.solution.place(point)[self.index])  # type: ignore[arg-type]

    # Points ------------------------------------------------------------------------------------

    def _fixed(self, name: Rich, place: complex) -> Place:
        x, y = (
            self.constant(f"{axis}_{{{name}}}", value, "m")
            for axis, value in zip(AXES, (place.real, place.imag), strict=True)
        )
        return Place(name, (x, y))

    def arm(self, link: str, start: str, end: str) -> Arm:
        """Return the vector of two points of a link."""
        points = self.problem.bodies[link].points
        between = points[end] - points[start]
        angle = round(degrees(between), DECIMALS) if between else 0.0
        length = self.length(link, start, end)
        vector = f"\\bar{{l}}_{{{self.mark(start, end)}}}"
        turned = self._rotated(self.directions[link], angle, self.mark(start, end))
        return Arm(vector, length, turned)

    def locate(self, name: str, side: Side) -> None:
        """Write the coordinates of a point."""
        mark_ = self.mark(name)
        x, y = (
            self.define(f"{axis}_{{{mark_}}}", one, "m")
            for axis, one in zip(AXES, side.sums(0, self.notation), strict=True)
        )
        self.places[name] = Place(mark_, (x, y))

    def differentiate(self, name: str, side: Side) -> None:
        """Write the derivatives of the coordinates of a point."""
        place = self.places[name]
        rates = []
        for order, (letter, unit) in enumerate(zip("va", self.of_length, strict=True), 1):
            x, y = (
                self.define(f"{letter}_{{q{place.name}{axis}}}", one, unit)
                for axis, one in zip(AXES, side.sums(order, self.notation), strict=True)
            )
            rates.append((x, y))
        self.places[name] = Place(place.name, place.at, (rates[0], rates[1]))

    def _rest(self, links: Sequence[str]) -> Iterator[Node]:
        """Yield the points of links that are not known yet, from one that is."""
        for link in links:
            points = self.problem.bodies[link].points
            for point in points:
                if point in self.places:
                    continue
                start = next(one for one in points if one in self.places)
                side = Side(self.places[start], (self.arm(link, start, point),))
                self.locate(point, side)
                self.differentiate(point, side)
                text = self.texts.point.format(point=self.mark(point), link=link)
                yield from self.state(text)

    def _rotated(self, direction: Direction, angle: float, index: Rich) -> Direction:
        """Return a direction at an angle to another; an angle that is not right has a letter."""
        letter = "α"
        turned = direction.rotated(round(angle, DECIMALS), f"{letter}_{{{index}}}")
        while turned.angle and self.values.get(turned.symbol, turned.angle) != turned.angle:
            letter += "′"
            turned = direction.rotated(round(angle, DECIMALS), f"{letter}_{{{index}}}")
        if turned.angle:
            self.given_angle(turned.symbol, turned.angle)
        return turned

    # Directions --------------------------------------------------------------------------------

    def unknown_turn(self, link: str) -> Turn:
        """Return the angle of a link that a contour gives; its value is for letters alone."""
        symbol = f"φ_{{{link}}}"
        exact = float(self.solution.links[link].phi_deg[self.index])
        drive = self.problem.drive
        links = self.problem.mechanism.links
        ratio = f"u_{{{ratio_of(link, drive.link, links)}}}"
        first = ratio if drive.is_crank else f"ω_{{q{link}}}"
        angle = named_angle(symbol, exact, self.notation)
        turn = Turn(angle, (ZERO, ZERO), (first, f"ε_{{q{link}}}"))
        self.turns[link], self.directions[link] = turn, Direction(turn)
        return turn

    def turn_is(self, link: str, angle: Spelled, of: Direction) -> None:
        """Write the angle of a link by that of a direction on it, within half a turn."""
        angle = total(angle, -of.offset(self.notation))
        exact = float(self.solution.links[link].phi_deg[self.index])
        whole = 360.0 * round((exact - angle.value) / 360.0)
        angle = total(angle, degree(whole, self.notation))
        self.turns[link].angle = self.define(f"φ_{{{link}}}", angle, "°")

    def track(self, slide: Slide, known: str, point: str) -> tuple[Place, Arm, Arm]:
        """Return the line that a point follows: its origin, the vector across it and along it."""
        bodies = self.problem.bodies
        if known == slide.host:
            direction = self.slide_direction(slide)
            distance = slide.offset + bodies[slide.slider].points[point].imag
            if slide.through is not None:
                origin = self.places[slide.through]
            else:
                origin = self._fixed(self.problem.guide_name(slide.label), slide.base)
        else:
            origin, direction = self.places[slide.pin], self.directions[known]
            z = bodies[slide.host].points[point]
            distance = ((z - slide.base) * cis(-slide.angle)).imag - slide.offset
        return origin, *self._offset(slide, direction, distance)

    def _offset(self, slide: Slide, direction: Direction, distance: float) -> tuple[Arm, Arm]:
        size = max(self.draft.size(slide.slider), self.draft.size(slide.host))
        e = ZERO
        if abs(distance) > TINY * size:
            e = self.constant(f"e_{{{slide.slider}}}", distance, "m")
        s = f"{{{slide.slider}}}"
        along = Arm(
            f"\\bar{{s}}_{s}", named(f"s_{s}", 0.0, self.notation), direction,
            symbols=(f"s′_{s}", f"s″_{s}"),
        )  # fmt: skip
        return Arm(f"\\bar{{e}}_{s}", e, direction.rotated(90.0)), along

    def turns_with(self, slide: Slide, known: str) -> None:
        """Note the direction of the other link of a pair, which turns with the known one."""
        sign, other = (1, slide.slider) if known == slide.host else (-1, slide.host)
        self.directions[other] = self._rotated(
            self.directions[known], sign * slide.angle, self._index(slide)
        )

    def slide_direction(self, slide: Slide) -> Direction:
        """Return the direction of the line of a slider, from that of its host."""
        return self._rotated(self.directions[slide.host], slide.angle, self._index(slide))

    def _index(self, slide: Slide) -> Rich:
        """Return the index of the angle of a slide: its guide on the frame, else its slider."""
        is_guide = slide.host == FRAME and slide.label in self.problem.guides
        return self.problem.guide_name(slide.label) if is_guide else slide.slider

    # The driver --------------------------------------------------------------------------------

    def _driver(self) -> Iterator[Node]:
        drive = self.problem.drive
        place = float(self.solution.driven[0][self.index])
        if drive.pivot is not None:
            place = place % 360.0 if self.problem.goes_round else place
            turn = Turn(self.given_angle(self.coordinate, place), (ONE, ZERO))
            self.directions[drive.link] = Direction(turn)
        else:
            slide = self.problem.slides[drive.link]
            origin, offset, along = self.track(slide, FRAME, slide.pin)
            along.length = self.constant(self.coordinate, place, "m")
            along.rates = (ONE, ZERO)
            self.turns_with(slide, FRAME)
            side = Side(origin, (offset, along))
            self.locate(slide.pin, side)
            self.differentiate(slide.pin, side)
        self.values[self.coordinate] = place
        yield from self.voice.part(self.texts.driver.format(link=drive.link))
        if drive.is_crank:
            yield from self.voice.results(self.texts.crank.format(symbol=self.coordinate))
        else:
            yield from self.state(self.texts.slider.format(symbol=self.coordinate))
        yield from self._rest([drive.link])

    # Groups ------------------------------------------------------------------------------------

    def _group(self, group: AssurGroup) -> Iterator[Node]:
        yield from self.voice.part(group_title(group, self.language.note))
        match group.signature:
            case "RRR":
                yield from self._rrr(group)
            case "RRP":
                yield from self._rrp(group)
            case "RPR":
                yield from self._rpr(group)
            case "PRP":
                yield from self._prp(group)
            case _ if group.is_toothed or group.is_passive:
                yield from WheelAccount(self).nodes(group)
            case _:
                yield from self._rpp(group)
        yield from self._rest(group.links)

    def _contour(self, *sides: Side) -> Iterator[Node]:
        """Yield a contour and its projections, in letters."""
        self.lines = [" = ".join(side.vectors for side in sides)]
        yield from self.state(self.texts.contour.format(), numbered=True)
        for k in (0, 1):
            both = [side.sums(0, self.notation)[k].sides()[0] for side in sides]
            self.lines.append(" = ".join(both))
        yield from self.state(self.texts.projections.format(), numbered=True)

    def _system(self, sides: Sequence[Side], unknowns: Sequence[Turn | Arm]) -> LinearSystem:
        pairs = [Unknown(one).coefficients(sides, self.notation) for one in unknowns]
        return LinearSystem(tuple(zip(*pairs, strict=True)), self.notation, self.define)

    def _rates(
        self,
        sides: Sequence[Side],
        unknowns: Sequence[Turn | Arm],
        system: LinearSystem | None = None,
    ) -> Iterator[Node]:
        """Yield both derivatives of the unknowns of a contour."""
        names = [one.symbols for one in unknowns]
        found: list[list[Spelled]] = []
        for order, (letter, key) in enumerate((("b", "first"), ("c", "second")), 1):
            system = system or self._system(sides, unknowns)
            left, right = (side.sums(order, self.notation) for side in sides)
            known = [total(right[k], -left[k]) for k in (0, 1)]
            equations = self._equations(system, [pair[order - 1] for pair in names], known)
            values = system.solve(known, letter, self.define)
            defined = [
                self.define(pair[order - 1], value, self._unit(one, order))
                for one, pair, value in zip(unknowns, names, values, strict=True)
            ]
            found.append(defined)
            for one, value in zip(unknowns, defined, strict=True):
                one.rates = (value, ZERO) if order == 1 else (one.rates[0], value)
            yield from self.voice.statement(
                str(self.texts[key]).format(symbol=self.coordinate), equations, numbered=True
            )
            yield from self.state(str(self.texts["determinant"][key]).format())

    def _unit(self, one: Turn | Arm, order: int) -> str:
        if isinstance(one, Turn):
            return self.of_angle[order - 1]
        return self.of_length[order - 1]

    def _equations(
        self, system: LinearSystem, names: Sequence[Rich], right: Sequence[Spelled]
    ) -> list[Rich]:
        """Return the linear equations in letters."""
        letters = [named(name, 0.0, self.notation) for name in names]
        return [
            f"{total(*map(times, row, letters)).sides()[0]} = {one.sides()[0]}"
            for row, one in zip(system.rows, right, strict=True)
        ]

    def _between(self, start: str, end: str) -> tuple[Spelled, Spelled]:
        """Return the projections of the vector of two known points."""
        one, two = self.places[start], self.places[end]
        return total(two.at[0], -one.at[0]), total(two.at[1], -one.at[1])

    def _rrr(self, group: AssurGroup) -> Iterator[Node]:
        c, (one, two) = inner_point(group), group.legs
        p, q = outer_point(one), outer_point(two)
        turns = [self.unknown_turn(lead.link) for lead in (one, two)]
        first, second = self.arm(one.link, p, c), self.arm(two.link, q, c)
        sides = Side(self.places[p], (first,)), Side(self.places[q], (second,))
        yield from self._contour(*sides)
        x, y = self._between(p, q)
        at = self.mark(p, q)
        d = self.define(f"d_{{{at}}}", root(total(squared(x), squared(y))), "m")
        delta = self.define(f"δ_{{{at}}}", angle_of(x, y, self.notation), "°")
        above = total(squared(first.length), squared(d), -squared(second.length))
        below = times(number(2.0, self.notation), first.length, d)
        beta = self.define(f"β_{{{one.link}}}", arccos(over(above, below)), "°")
        turning = (self._exact(c) - self._exact(p)) * (self._exact(q) - self._exact(p)).conjugate()
        angle = total(delta, beta if turning.imag > 0 else -beta)
        self.turn_is(one.link, angle, first.direction)
        self.locate(c, sides[0])
        x, y = self._between(q, c)
        self.turn_is(two.link, angle_of(x, y, self.notation), second.direction)
        yield from self.state(self._solved("RRR", "+" if turning.imag > 0 else MINUS))
        yield from self._rates(sides, turns)
        yield from self._derived(c, sides[0])

    def _solved(self, kind: str, sign: str) -> Rich:
        return str(self.texts["solved"][kind]).format(sign=sign)

    def _derived(self, point: str, side: Side) -> Iterator[Node]:
        self.differentiate(point, side)
        yield from self.state(self.texts.derivatives.format(point=self.mark(point)))

    def _rrp(self, group: AssurGroup) -> Iterator[Node]:
        c, (revolute, prismatic) = inner_point(group), split(group)
        slide, p = self._slide(prismatic.joint), outer_point(revolute)
        turn = self.unknown_turn(revolute.link)
        origin, offset, along = self.track(slide, prismatic.to, c)
        arm = self.arm(revolute.link, p, c)
        sides = Side(self.places[p], (arm,)), Side(origin, (offset, along))
        yield from self._contour(*sides)
        cos_, sin_ = along.direction.projections(self.notation)
        start = self.places[p]
        x, y = (total(origin.at[k], -start.at[k]) for k in (0, 1))
        s = f"{{{slide.slider}}}"
        p_ = self._letter(f"p_{s}", total(times(x, cos_), times(y, sin_)))
        g = self._letter(f"h_{s}", total(times(y, cos_), -times(x, sin_), offset.length))
        to = (self._exact(c) - self._exact(p)) * cis(-self._value(along.direction))
        rest = root(total(squared(arm.length), -squared(g)))
        rest = rest if to.real > 0 else -rest
        along.length = self.define(f"s_{s}", total(-p_, rest), "m")
        self.locate(c, sides[1])
        x, y = self._between(p, c)
        self.turn_is(revolute.link, angle_of(x, y, self.notation), arm.direction)
        self.turns_with(slide, prismatic.to)
        yield from self.state(self._solved("RRP", "+" if to.real > 0 else MINUS))
        yield from self._rates(sides, (turn, along))
        yield from self._derived(c, sides[1])

    def _letter(self, symbol: Rich, value: Spelled) -> Spelled:
        return self.define(symbol, value, "m")

    def _value(self, direction: Direction) -> float:
        return direction.value(self.notation).value

    def _slide(self, joint: object) -> Slide:
        assert isinstance(joint, Prismatic)
        return self.problem.slides[joint.slider]

    def _rpr(self, group: AssurGroup) -> Iterator[Node]:
        slide, host, slider = rpr_parts(self.draft, group)
        p, q = outer_point(host), outer_point(slider)
        turn = self.unknown_turn(host.link)
        direction = self.slide_direction(slide)
        bodies = self.problem.bodies
        z = ((bodies[slide.host].points[p] - slide.base) * cis(-slide.angle)).imag
        e, along = self._offset(
            slide, direction, slide.offset + bodies[slide.slider].points[q].imag - z
        )
        sides = Side(self.places[p], (e, along)), Side(self.places[q], ())
        yield from self._contour(*sides)
        x, y = self._between(p, q)
        exact = (self._exact(q) - self._exact(p)) * cis(-self._value(direction))
        size = root(total(squared(x), squared(y), -squared(e.length)))
        sign = copysign(1.0, exact.real)
        along.length = self.define(f"s_{{{slide.slider}}}", size if sign > 0 else -size, "m")
        if e.length.is_zero:
            vector = (x, y) if sign > 0 else self._between(q, p)
        else:
            s, h = along.length, e.length
            vector = (
                total(times(s, x), times(h, y)),
                total(times(s, y), -times(h, x)),
            )
        self.turn_is(host.link, angle_of(*vector, self.notation), direction)
        self.turns_with(slide, host.link)
        yield from self.state(self._solved("RPR", "+" if sign > 0 else MINUS))
        yield from self._rates(sides, (turn, along))

    def _prp(self, group: AssurGroup) -> Iterator[Node]:
        c = inner_point(group)
        slides = [self._slide(lead.joint) for lead in group.legs]
        tracks = [
            self.track(slide, lead.to, c) for slide, lead in zip(slides, group.legs, strict=True)
        ]
        yield from self._linear(c, tracks)
        for slide, lead in zip(slides, group.legs, strict=True):
            self.turns_with(slide, lead.to)

    def _rpp(self, group: AssurGroup) -> Iterator[Node]:
        revolute, prismatic = split(group)
        outer, inner = self._slide(prismatic.joint), self._slide(group.inner[0])
        self.turns_with(outer, prismatic.to)
        self.turns_with(inner, prismatic.link)
        yield from self._rest([revolute.link])
        x = intersection_point(self.draft, group)
        tracks = [self.track(outer, prismatic.to, x), self.track(inner, revolute.link, x)]
        yield from self._linear(x, tracks)

    def _linear(self, point: str, tracks: Sequence[tuple[Place, Arm, Arm]]) -> Iterator[Node]:
        """Yield a contour whose unknowns are two lengths: the places are linear, too."""
        unknowns = [along for _, _, along in tracks]
        sides = tuple(Side(origin, (offset, along)) for origin, offset, along in tracks)
        yield from self._contour(*sides)
        system = self._system(sides, unknowns)
        letters = [one.length for one in unknowns]
        for one in unknowns:
            one.length = ZERO
        left, right = (side.sums(0, self.notation) for side in sides)
        known = [total(right[k], -left[k]) for k in (0, 1)]
        values = system.solve(known, "k", self.define)
        for one, letter, value in zip(unknowns, letters, values, strict=True):
            one.length = self.define(letter.factors[0].sides[0], value, "m")
        way = next((side for side in sides if side.is_fixed), sides[0])
        self.locate(point, way)
        yield from self.state(self._solved("linear", ""))
        yield from self._rates(sides, unknowns, system)
        yield from self._derived(point, way)

    # Velocities and accelerations --------------------------------------------------------------

    def _motion(self) -> Iterator[Node]:
        drive = self.problem.drive
        _, rate, again = self.solution.driven
        rates = [float(one if isinstance(one, float | int) else one[self.index])
                 for one in (rate, again)]  # fmt: skip
        if not rates[0]:
            return
        crank = drive.is_crank
        index = f"_{{{drive.link}}}" if crank else ""
        units = ("1/s", "1/s²") if crank else ("m/s", "m/s²")
        w, e = (
            self.constant(f"{letter}{index}", value, unit)
            for letter, value, unit in zip("ωε" if crank else "va", rates, units, strict=True)
        )
        yield from self.voice.part(self.texts.motion.format())
        for link, turn in self.turns.items():
            u, eps = turn.rates
            self.define(f"ω_{{{link}}}", times(u, w), "1/s")
            self.define(f"ε_{{{link}}}", total(times(eps, squared(w)), times(u, e)), "1/s²")
        if self.lines:
            yield from self.state(self.texts.turning.format(symbol=self.coordinate))
        for point in self.places.values():
            for letter, unit in (("v", "m/s"), ("a", "m/s²")):
                parts = []
                for k, axis in enumerate(AXES):
                    v, a = (pair[k] for pair in point.rates)
                    value = times(v, w)
                    if letter == "a":
                        value = total(times(a, squared(w)), times(v, e))
                    parts.append(self.define(f"{letter}_{{{point.name}{axis}}}", value, unit))
                if not any(one.is_zero for one in parts):
                    size = root(total(*map(squared, parts)))
                    self.define(f"{letter}_{{{point.name}}}", size, unit)
            if self.lines:
                yield from self.state(self.texts.of_point.format(point=point.name))

    # Documents ---------------------------------------------------------------------------------

    def nodes(self, further: Callable[[], Iterator[Node]] = empty) -> Iterator[Node]:
        """Yield all sections and further ones, without a heading of the whole."""
        for point, place in self.problem.bodies[FRAME].points.items():
            self.places[point] = self._fixed(self.mark(point), place)
        body = [*self._body(), *further()]
        facts = "; ".join(self.given.values())
        texts = self.texts
        letters = texts.slides.format() if self.problem.slides else ""
        told = (texts.intro.format(symbol=self.coordinate), letters, texts.atan2.format())
        yield from self.voice.statement(" ".join(filter(None, told)))
        yield from self.voice.results(self.texts.given.format(facts=facts))
        yield from body

    def _body(self) -> Iterator[Node]:
        yield from self._driver()
        for group in self.solution.structure.groups:
            if group.class_number != 2:
                links = "–".join(group.links)
                yield from self.voice.results(self.texts.no_form.format(links=links))
                break
            yield from self._group(group)
        yield from self._motion()

    def chapter(self, further: Callable[[], Iterator[Node]] = empty) -> Iterator[Node]:
        """Yield the chapter of a note or of a protocol."""
        yield Chapter(self.texts.title)
        yield from self.nodes(further)
