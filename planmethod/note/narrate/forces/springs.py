"""Springs and dampers in words: given data, and the formula of the force (пружины, демпферы)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.mechanism.model import FRAME
from planmethod.note.document import GivenFact
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.stated_links import StatedNumbers
from planmethod.note.numbers import MINUS, with_unit
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import Applied
from planmethod.problem.model import Problem
from planmethod.problem.names import UNITS
from planmethod.problem.records import Spring
from planmethod.solved.forces.springs import SpringState, spring_states, springs_of
from planmethod.solved.solution import Solution


def spring_facts(problem: Problem, language: Language) -> list[GivenFact]:
    """Return the given facts on the springs, one for each (Дано)."""
    springs = () if problem.dynamics is None else problem.dynamics.springs
    narrator = SpringNarrator(problem, language)
    return [narrator.fact(spring) for spring in springs]


def spring_letters(problem: Problem, spring: Spring) -> tuple[str, str, str, str]:
    """Return the letters of stiffness, rest, damping and preload; of several with numbers."""
    dynamics = problem.dynamics
    assert dynamics is not None, "a problem with springs has dynamics"
    mark = str(dynamics.springs.index(spring) + 1) if len(dynamics.springs) > 1 else ""
    rest, force = ("φ", "M") if spring.is_torsion else ("l", "F")
    one = f"_{{{mark}}}" if mark else ""
    return f"c{one}", f"{rest}_{{0{mark}}}", f"b{one}", f"{force}_{{0{mark}}}"


def _units(spring: Spring) -> tuple[str, str, str]:
    """Return the units of force, stiffness and damping."""
    return ("N·m", "N·m/rad", "N·m·s") if spring.is_torsion else ("N", "N/m", "N·s/m")


class SpringNarrator:
    """Describes the springs of a problem."""

    def __init__(self, problem: Problem, language: Language) -> None:
        self.problem, self.language, self.texts = problem, language, language.springs
        self.notation = language.notation

    def fact(self, spring: Spring) -> GivenFact:
        """Return the given fact on a spring."""
        template = self.texts.given_torsion if spring.is_torsion else self.texts.given
        return GivenFact(self._describe(spring, template), self._data(spring))

    def sentence(self, spring: Spring) -> Rich:
        """Return the sentence of the note on a spring."""
        template = self.texts.sentence_torsion if spring.is_torsion else self.texts.sentence
        return self._describe(spring, template)

    def _describe(self, spring: Spring, template: str) -> Rich:
        first, second = (self._end(spring, number) for number in range(2))
        return template.format(
            name=spring.symbol,
            kind=self.texts["kinds"][self._kind(spring)],
            first=first,
            second=second,
            joint=point_name(spring.joint or ""),
            data=", ".join(self._sizes(spring)),
        )

    @staticmethod
    def _kind(spring: Spring) -> str:
        kind = "both" if spring.damping else "spring"
        if not spring.stiffness:
            kind = "damper" if spring.preload is None else "constant"
        return f"{kind} torsion" if spring.is_torsion else kind

    def _end(self, spring: Spring, number: int) -> Rich:
        """Return an end: its point and link."""
        link, ends = spring.links[number], self.texts["ends"]
        if spring.is_torsion:
            return str(ends["frame" if link == FRAME else "link"]).format(link=link)
        point = spring.points[number]
        if isinstance(point, complex):
            per = UNITS[self.problem.unit]
            x, y = (self.notation.as_input(part * per) for part in (point.real, point.imag))
            unit = self.notation.units[self.problem.unit]
            return str(ends["place"]).format(x=x, y=y, unit=unit)
        template = str(ends["fixed" if link == FRAME else "point"])
        return template.format(point=point_name(point), link=link)

    # Data ------------------------------------------------------------------------------------

    def _sizes(self, spring: Spring) -> Iterator[str]:
        text, path = StatedNumbers(self.problem, self.language), spring.path
        force, stiffness, damping = _units(spring)
        c, rest, b, preload = spring_letters(self.problem, spring)
        if spring.stiffness:
            yield f"{c} = {text.number(spring.stiffness, stiffness, f'{path}.stiffness')}"
        if spring.length is not None:
            yield f"{rest} = {text.metres(spring.length, f'{path}.length')}"
        if spring.angle is not None:
            yield f"{rest} = {text.number(spring.angle, 'deg', f'{path}.angle')}"
        if spring.preload is not None:
            value = text.number(spring.preload, force, f"{path}.preload")
            yield self.texts.preload.format(letter=preload, value=value)
        if spring.damping:
            yield f"{b} = {text.number(spring.damping, damping, f'{path}.damping')}"
        if spring.stops is not None:
            low, high = (
                with_unit(self.notation.as_input(stop), self.notation.units["deg"])
                if spring.is_torsion else text.metres(stop)
                for stop in spring.stops
            )  # fmt: skip
            yield self.texts.stops.format(low=low, high=high)

    def _data(self, spring: Spring) -> dict[str, object]:
        """Return the keys of a spring in the file."""
        found: dict[str, object] = {"name": spring.name, "links": [*spring.links]}
        if spring.is_torsion:
            found["joint"] = spring.joint
        else:
            found["points"] = [
                [point.real, point.imag] if isinstance(point, complex) else point
                for point in spring.points
            ]
        for key in ("stiffness", "damping"):
            if value := getattr(spring, key):
                found[key] = value
        for key in ("length", "angle", "preload"):
            if (value := getattr(spring, key)) is not None:
                found[key] = value
        if spring.stops is not None:
            found["stops"] = [*spring.stops]
        return {f"{spring.path}.{key}": value for key, value in found.items()}

    # Formula ---------------------------------------------------------------------------------

    def equations(self, solution: Solution, index: int) -> list[Rich]:
        """Return the size of the force or moment of every spring in a position, with numbers."""
        return [self._equation(state, index) for state in spring_states(solution)]

    def _equation(self, state: SpringState, index: int) -> Rich:
        spring = state.spring
        value = abs(float(state.force[index]))
        size = with_unit(self.notation.computed(value), self.notation.units[_units(spring)[0]])
        return f"{spring.symbol} = {self._formula(state, index)} = {size}"

    def formula(self, solution: Solution, one: Applied, index: int) -> Rich:
        """Return the size of a load by the law of its spring, with numbers; of others nothing.

        ``|c·(l_{0} - l_{PS})| = |2000·(0.12 - 0.1669)|``.
        """
        dynamics = self.problem.dynamics
        assert dynamics is not None
        loads = (load for load in dynamics.loads if load.name == one.name)
        spring = next((load.size for load in loads), None)
        if not isinstance(spring, Spring):
            return ""
        return self._formula(springs_of(solution).state(spring), index)

    def _formula(self, state: SpringState, index: int) -> Rich:
        letters, numbers = zip(*self._terms(state, index), strict=True)
        both = (_sum(terms) for terms in (letters, numbers))
        return " = ".join(f"|{text}|" for text in both)

    def _terms(self, state: SpringState, index: int) -> Iterator[tuple[str, str]]:
        """Yield the terms of the law, each in letters and in numbers."""
        spring, notation = state.spring, self.notation
        size, rate, deflection = (
            float(value[index]) for value in (state.size, state.rate, state.deflection)
        )
        c, rest, b, preload = spring_letters(self.problem, spring)
        ends = "".join(point_name(point) for point in spring.points if isinstance(point, str))
        moves = f"ω_{{{''.join(spring.links[::-1])}}}" if spring.is_torsion else f"dl_{{{ends}}}/dt"
        if spring.preload is not None:
            yield f"+ {preload}", f"+ {notation.short(spring.preload)}"
        if spring.stiffness:
            stiffness = notation.short(spring.stiffness)
            if spring.length is not None:
                free, now = notation.short(spring.length), notation.computed(size)
                yield (
                    f"+ {c}·({rest} {MINUS} l_{{{ends}}})",
                    f"+ {stiffness}·({free} {MINUS} {now})",
                )
            else:
                over = "Δφ" if spring.is_torsion else f"Δl_{{{ends}}}"
                yield f"{MINUS} {c}·{over}", f"{MINUS} {stiffness}·{self._signed(deflection)}"
        if spring.damping:
            damping = notation.short(spring.damping)
            yield f"{MINUS} {b}·{moves}", f"{MINUS} {damping}·{self._signed(rate)}"

    def _signed(self, value: float) -> str:
        told = self.notation.computed(value + 0.0)
        return f"({told})" if told.startswith(MINUS) else told


def _sum(terms: Sequence[str]) -> str:
    """Return a sum of terms, each with its sign; the first has no plus, and its minus no space."""
    first, *others = terms
    return " ".join((first.removeprefix("+ ").replace(f"{MINUS} ", MINUS, 1), *others))
