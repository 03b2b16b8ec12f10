"""The position that a figure shows: given data, and how the drawn points are found (рисунок)."""

# no messages: names of keys, in the words of the file

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from planmethod.construct import steps
from planmethod.construct.arithmetic import Float64
from planmethod.construct.evaluate import evaluate
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.note.document import NO_BREAK, GivenFact, input_text
from planmethod.note.formula import Rich
from planmethod.note.narrate.figure_points import coordinates_fact, size_sentences
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.narrator import BoardNarrator
from planmethod.note.narrate.stated_links import StatedNumbers, coordinate_facts, line_name
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.problem.model import DrawnFact, DrawnKind, DrawnPosition, Problem
from planmethod.problem.names import segment, split_pair
from planmethod.solved.solution import Solution


def figure_facts(text: StatedNumbers, positions: Sequence[float]) -> Iterator[GivenFact]:
    """Yield the unknown places of a problem, and the data of its figure."""
    problem, figure, note = text.problem, text.problem.drawn, text.language.note
    assert figure is not None
    yield from coordinates_fact(text)
    for path, told in figure.file_values.items():
        if path[0] == "frame" and len(path) == 2:
            yield _sought_point(path[1], told, text)
    for guide in problem.guides:
        yield from _sought_guide(guide, figure, text)
    drive = problem.drive
    stays = ("driver", "phi") in figure.file_values and tuple(positions) == drive.positions
    first = float(positions[0]) if len(positions) else None
    if figure.shown is not None:
        pass  # its coordinates give the position
    elif (
        figure.position is not None and not stays and (figure.is_stated or first != figure.position)
    ):
        key = f"drawn.phi_{drive.link}" if drive.is_crank else "drawn.s"
        of, unit = figure.position, drive.coordinate.unit
        shown = text.metres(of, key) if unit == "m" else text.number(of, unit, key)
        position = f"{drive.coordinate.symbol} = {shown}"
        yield GivenFact(note.given_figure_at.format(position=position), {key: of})
    for fact in figure.facts:
        key = f"drawn.{segment(fact.key)}"
        axis = problem.bodies[fact.of[0]].axis if fact.kind is DrawnKind.PHI else None
        axis = fact.lines[0] if fact.lines and axis is not None else axis
        if axis is not None:
            symbol = fact_symbol(fact)
            yield GivenFact(note.given_axis.format(symbol=symbol, line=line_name(*axis)))
        yield GivenFact(f"{fact_symbol(fact)} = {_fact_value(fact, key, text)}", {key: fact.value})


def sought_paths(problem: Problem) -> frozenset[str]:
    """Return the fixed points and guides of a file that follow from its figure."""
    given = {} if problem.drawn is None else problem.drawn.file_values
    return frozenset(
        path[-1] if len(path) == 2 else path[2] for path in given if path[0] == "frame"
    )


def fact_symbol(fact: DrawnFact) -> Rich:
    """Return the symbol of a number of a figure: ``φ_{2,3}``, ``l_{AC}``."""
    if fact.kind is DrawnKind.LENGTH:
        return f"l_{{{''.join(fact.of)}}}"
    return f"φ_{{{','.join(fact.names)}}}"


def _fact_value(fact: DrawnFact, key: str, text: StatedNumbers) -> Rich:
    if fact.kind is DrawnKind.LENGTH:
        return text.metres(fact.value, key)
    return text.number(fact.value, "deg", key)


def _sought_point(name: str, value: Any, text: StatedNumbers) -> GivenFact:
    note, path = text.language.note, f"frame.{segment(name)}"
    point = point_name(name)
    if not isinstance(value, list):
        return GivenFact(note.given_drawn_point.format(point=point), {path: value})
    k = 0 if value[0] != "drawn" else 1
    place = complex(*(0.0 if part == "drawn" else part for part in value))
    known = coordinate_facts(name, place, text, path)[k].text
    shown = note.given_drawn_coordinate.format(known=known, sought=f"{'yx'[k]}_{{{name}}}")
    return GivenFact(shown, {path: value})


def _sought_guide(guide: str, figure: DrawnPosition, text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield the known coordinates and direction of a guide that is drawn."""
    problem, note, path = text.problem, text.language.note, f"frame.guides.{segment(guide)}"
    through = figure.file_values.get(("frame", "guides", guide, "through"))
    turned = ("frame", "guides", guide, "angle") in figure.file_values
    if through is None and not turned:
        return
    of, base, angle = problem.guides[guide]
    shown, data = problem.guide_name(guide), dict[str, object]()
    parts: list[str] = []
    if through is not None:
        data[f"{path}.through"] = through
        if isinstance(through, list):
            k = 0 if through[0] != "drawn" else 1
            parts.append(coordinate_facts(shown, base, text, f"{path}.through")[k].text)
    elif of is not None:
        data[f"{path}.through"] = of
        parts.append(note.given_drawn_through.format(point=point_name(of)))
    else:
        parts += [one.text for one in coordinate_facts(shown, base, text, f"{path}.through")]
        data[f"{path}.through"] = [base.real, base.imag]
    data[f"{path}.angle"] = "drawn" if turned else angle
    if not turned:
        parts.append(note.given_angle.format(angle=text.number(angle, "deg", f"{path}.angle")))
    known = f" ({', '.join(parts)})" if parts else ""
    yield GivenFact(note.given_drawn_guide.format(guide=shown, known=known), data)


class FigureNarrator(BoardNarrator):
    """Narrates how the drawn points of a problem are found, on the drawing of a solution."""

    def __init__(self, solution: Solution, language: Language) -> None:
        problem, figure = solution.problem, solution.problem.drawn
        assert figure is not None
        self.problem, self.figure, self.language = problem, figure, language
        self.per_mm = solution.plan_scale(PlanKind.POSITION, 0).per_mm
        self.step = {step.out: step for step in figure.program.steps}
        data: dict[str, Any] = {**figure.numbers, **figure.places}
        self.value = evaluate(figure.program, data, Float64()).value
        self.notation = StatedNumbers(problem, language)
        super().__init__(self, language.note)

    def sentences(self) -> list[Rich]:
        """Return the sentences of all steps, and the places that they find."""
        told = [line for step in self.figure.program.steps for line in self.narrate(step)]
        return [
            self._lead(),
            *told,
            self.texts.figure_found.format(found="; ".join(self._results())),
        ]

    def _lead(self) -> Rich:
        drive, position = self.problem.drive, self.figure.position
        at = ""
        if position is not None and ("driver", "phi") not in self.figure.file_values:
            symbol, unit = drive.coordinate.symbol, drive.coordinate.unit
            number = (
                self.notation.metres(position)
                if unit == "m"
                else self.notation.number(position, unit)
            )
            at = self.texts.figure_at.format(position=f"{symbol} = {number}")
        return self.texts.figure_lead.format(at=at)

    def _results(self) -> Iterator[Rich]:
        text = self.notation
        for path, value in self.figure.places_found.items():
            told = self.figure.file_values[path]
            if path == ("driver", "phi"):
                symbol = self.problem.drive.coordinate.symbol
                yield f"{symbol} = {self._number(value)}°"
            elif isinstance(value, list):
                name = path[1] if len(path) == 2 else self.problem.guide_name(path[2])
                facts = coordinate_facts(name, complex(*value), text, "")
                known = told if isinstance(told, list) else ["drawn", "drawn"]
                yield from (
                    fact.text for fact, one in zip(facts, known, strict=True) if one == "drawn"
                )
            else:
                yield f"∠({self.problem.guide_name(path[2])}) = {self._number(value)}°"

    # Names, of `planmethod.note.narrate.narrator.Naming` ---------------------------------------

    def point(self, name: PointName) -> Rich:
        """Return the letter of a point; an auxiliary one has a prime."""
        letter, mark, _ = str(name).partition("~")
        if mark:
            alike = [str(one) for one in self.step if str(one).startswith(letter + mark)]
            return point_name(letter) + "′" * (alike.index(str(name)) + 1)
        stem, mark, _ = letter.partition(":")
        return f"{self.problem.guide_name(stem)}_{{0}}" if mark else point_name(stem)

    def of(self, name: PointName) -> Rich:
        """Return a point in the genitive."""
        return self.texts.of_point.format(point=self.point(name))

    def segment(self, tail: PointName, head: PointName) -> Rich:
        """Return a segment by its ends."""
        return self.point(tail) + self.point(head)

    def number(self, name: NumberName) -> float:
        """Return a number."""
        return float(self.value[name])

    exact_value = number

    def line(self, name: LineName) -> Rich:
        """Return a drawn line in the genitive."""
        step = self.step[name]
        if isinstance(step, steps.Join):
            return self.texts.line_join.format(base=self.segment(step.tail, step.head))
        assert isinstance(step, steps.Parallel | steps.Perpendicular | steps.AtAngle)
        start = str(step.through)
        if ":" in start and isinstance(step, steps.AtAngle):
            point, _, axis = start.partition(":")
            if axis in ("x", "y") and point in self.problem.bodies["0"].points:
                value = self.notation.metres(
                    getattr(self.figure.places[start], "real" if axis == "x" else "imag")
                )
                return self.texts.figure_level.format(coordinate=f"{axis} = {value}")
        return self.texts.line_through.format(
            of=self.of(step.through), direction=self._direction(name, 1)
        )

    def direction_vector(self, name: LineName) -> complex:
        """Return a vector along a line."""
        return complex(self.value[name][1])

    def length(self, name: NumberName) -> Rich:
        """Return a length of the drawing: ``AB = 80 mm``."""
        millimetres = abs(self.number(name)) / self.per_mm
        value = f"{self._number(millimetres)}{NO_BREAK}{self.language.notation.units['mm']}"
        pair = split_pair(str(name).lstrip("-").removeprefix("l_").rstrip("*"))
        if pair is None:
            return value
        return f"{''.join(map(point_name, pair))}{NO_BREAK}={NO_BREAK}{value}"

    def _number(self, value: float) -> str:
        return input_text(round(value, 9), self.texts, 5)

    # Sentences -----------------------------------------------------------------------------------

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[Rich]:
        """Describe a length laid off in a direction."""
        sense = 1 if self.number(step.length) >= 0 else -1
        return [
            self.texts.lay_off.format(
                of=self.of(step.origin),
                direction=self._direction(step.line, sense),
                length=self.length(step.length),
                sense="",
                point=self.point(step.out),
            )
        ]

    def _direction(self, line: LineName, sense: int) -> Rich:
        """Return a direction by the angle that the figure gives, or from the x axis."""
        texts, step, turn = self.texts, self.step[line], self.figure.directions.get(line)
        course = Float64().angle(self.direction_vector(line) * sense)
        angle = f"{self._number(float(course) % 360.0)}°"
        if isinstance(step, steps.Join):
            return texts.along.format(base=self.segment(step.tail, step.head))
        if turn is not None and turn.by == "phi":
            symbol = f"φ_{{{turn.names[0]}}}" + ("" if sense > 0 else " + 180°")
            return texts.given_angle.format(angle=f"{symbol} = {angle}")
        if turn is not None and turn.by == "between":
            fact = next(
                (one for one in self.figure.facts if {*one.names} == {*turn.names}),
                DrawnFact(DrawnKind.BETWEEN, tuple(sorted(turn.names)), float("nan")),
            )
            shown = fact_symbol(fact)
            if fact.value == fact.value:
                shown += f" = {self._number(fact.value)}°"
            other = turn.names[0]
            said = texts.figure_between if other == turn.of[0] else texts.figure_between_line
            return said.format(shown=shown, link=other, angle=angle)
        return texts.given_angle.format(angle=angle)


def figure_sentences(solution: Solution, language: Language) -> list[Rich]:
    """Return how the sizes and points of a figure are found; nothing of a problem without one."""
    if solution.problem.drawn is None:
        return []
    found = size_sentences(solution, language)
    if solution.problem.drawn.program.steps:
        return [*found, *FigureNarrator(solution, language).sentences()]
    return found
