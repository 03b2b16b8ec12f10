"""The construction of the velocity diagrams step by step (протокол построения картин)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.gears.comparison import compare
from planmethod.gears.construction import (
    POLE,
    DrawnPoint,
    GearDrawing,
    GearReading,
    MeasuredQuantity,
    construct,
    read,
)
from planmethod.gears.model import GearProblem, parse
from planmethod.gears.motion import ContactKind, draw
from planmethod.gears.sheet import as_drawn
from planmethod.gears.sheet_texts import calculation, measured_quantities, train_facts, unit_of
from planmethod.gears.solution import answer
from planmethod.gears.text import compared_sentences, compared_table, no_diagrams
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import Chapter, Item, Node, Paragraph, Step, Title
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.naming import view_name
from planmethod.note.narrate.narrator import Line, StepNarrator
from planmethod.note.numbers import Notation, half_up, raised
from planmethod.note.wording import Language, MessageTable
from planmethod.solved.legibility import DetailView


def protocol_document(problem: GearProblem, language: Language, profile: Profile) -> Iterator[Node]:
    """Yield the given data, the calculation, the construction of the diagrams, and readings.

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    """
    motion, notation = as_drawn(problem, profile), problem.sheet.notation
    texts: MessageTable = language.gears["sheet"]
    yield Title(texts.protocol.format(title=escape(problem.title)))
    if problem.source:
        yield Paragraph(texts.source.format(source=escape(problem.source)))
    yield Chapter(texts.given)
    facts = train_facts(motion, language)
    yield Paragraph("; ".join(fact.text for fact in facts) + ".", facts=tuple(facts))
    yield Chapter(texts.calculation)
    yield from (Item(line) for line in calculation(motion, language, notation))
    compared = compare(problem, motion)
    if compared is not None:
        yield Chapter(language.teeth["compared"]["title"])
        yield from (Paragraph(line) for line in compared_sentences(compared, language))
        yield compared_table(compared, language)
    picture = draw(motion)
    if picture is None:
        yield Chapter(language.gears.picture)
        yield Paragraph(no_diagrams(motion, language))
    else:
        drawn = construct(motion, picture)
        yield from _diagram_steps(drawn, language)
        yield from readings(drawn, read(drawn, profile), profile, language)


def _diagram_steps(drawn: GearDrawing, language: Language) -> Iterator[Node]:
    """Yield the steps that draw both diagrams."""
    narrator = DiagramNarrator(drawn, language)
    texts: MessageTable = language.gears["sheet"]
    yield Chapter(texts.pictures)
    yield Step((texts["steps"]["axis"],))
    for step in drawn.program.steps:
        if step.out == POLE:
            break
        lines = narrator.narrate(step)
        if lines:
            yield Step(tuple(lines))
    yield Chapter(texts["steps"]["rays"])
    pole = language.notation.as_input(half_up(float(drawn.diagrams.pole_mm), 2))
    yield Step((texts["steps"]["pole"].format(pole=pole),))
    for body in drawn.rays:
        yield Step((texts["steps"]["ray"].format(body=drawn.label(body)),))


class DiagramNarrator(StepNarrator):
    """Narrates the linear velocity diagram; level lines are described where they are used."""

    def __init__(self, drawn: GearDrawing, language: Language) -> None:
        self.drawn, self.notation = drawn, language.notation
        self.say: Mapping[str, str] = language.gears["sheet"]["steps"]
        self._bodies = {line: drawn.label(body) for body, line in drawn.lines.items()}
        self._ends = {spot.end: spot for spot in drawn.spots}

    def describe_laid_off_length(self, step: steps.LayOffLength) -> list[Rich]:
        """Describe a velocity, or the place of a point on the axis of contact points."""
        spot = self._ends.get(step.out)
        if spot is not None and spot.plotted == step.length:
            return self._start(spot)
        what = ", ".join(
            self._describe_point(spot) for spot in self.drawn.spots if spot.base == step.out
        )
        height = float(self.drawn.data[step.length])
        what = what or self._axis_at(height)
        shown = _mm(height, self.notation)
        return [self.say["foot"].format(point=step.out, what=what, height=shown)]

    def describe_line(self, step: Line) -> list[Rich]:
        """Describe the line of a body."""
        if not isinstance(step, steps.Join):
            return []
        body = self._bodies[step.out]
        return [self.say["line"].format(one=step.tail, other=step.head, body=body)]

    def describe_intersection(self, step: steps.IntersectLines) -> list[Rich]:
        """Describe a velocity that the line of a body gives."""
        spot = self._ends[step.out]
        facts = {"foot": spot.base, "point": step.out, "what": self._describe_point(spot, "of ")}
        return [self.say["meet"].format(body=self._bodies[step.second], **facts)]

    def _describe_point(self, spot: DrawnPoint, case: str = "") -> Rich:
        """Return the phrase for a point of the diagram; ``of `` selects the genitive."""
        key = "pitch" if spot.contact.kind is ContactKind.PITCH else "own"
        return self.say[case + key].format(name=spot.contact.of)

    def _axis_at(self, height: float) -> Rich:
        """Return whose fixed axis is at a height that no contact has."""
        motion = self.drawn.motion
        scale = float(motion.train.unit_m / self.drawn.diagrams.mu_l)
        heights = {body: float(motion.axes.heights[body]) * scale for body in self.drawn.lines}
        own = [body for body, at in heights.items() if abs(at - height) < 1e-6]
        return self.say["own"].format(name=", ".join(own))

    def _start(self, spot: DrawnPoint) -> list[Rich]:
        body = next((b for b in self.drawn.starts if b in spot.bodies), spot.bodies[0])
        facts = {"foot": spot.base, "point": spot.letter, "what": self._describe_point(spot, "of ")}
        mu_v = self.notation.short(self.drawn.diagrams.mu_v, 4)
        length = _mm(abs(float(spot.speed)), self.notation)
        lines = [self.say["laid"].format(**facts, length=length, mu_v=mu_v)]
        inputs, label = self.drawn.motion.train.inputs, self.drawn.label(body)
        if body in self.drawn.calculated:
            lines.append(self.say["calculated"].format(body=label))
        elif body not in inputs:
            lines.append(self.say["any"].format(body=label, input=", ".join(inputs)))
        return lines


def readings(
    drawn: GearDrawing, reading: GearReading, profile: Profile, language: Language
) -> Iterator[Node]:
    """Yield the segments as read, and the values computed from them."""
    notation, train = language.notation, drawn.motion.train
    texts: MessageTable = language.gears["sheet"]
    yield Chapter(texts["steps"]["readings"])
    name = language.note["profiles"].get(profile.name, profile.name)
    yield Step((texts.ruler.format(ruler=notation.as_input(profile.ruler), profile=name),))

    def on_view(detail_view: DetailView | None) -> Rich:
        if detail_view is None:
            return ""
        return f" {language.sheets.read_on.format(view=view_name(detail_view, language))}"

    spots = drawn.spots_on(reading.detail_views)
    named = [
        (s.read, f"{s.base}{s.letter}", on_view(spots.get(s.end)))
        for s in drawn.spots
        if s.read is not None
    ]
    views = {b: on_view(view) for b, view in drawn.read_on(reading.detail_views).items()}
    named += [(n, f"o{drawn.label(b)}", views.get(b, "")) for b, n in drawn.segments.items()]
    yield Step(
        tuple(
            texts["steps"]["read"].format(
                name=name,
                read=notation.measured(one.read),
                exact=_mm(one.exact, notation),
                sigma=notation.number(one.sigma_text),
                view=view,
            )
            for number, name, view in named
            for one in [reading.compared(number)]
        )
    )
    unit = raised(language.gears["units"][train.units[0]])
    chosen = drawn.mu in drawn.data
    scale = texts["steps"]["scale"].format(
        symbol=_scale(drawn),
        value=notation.short(float(reading.read.value[drawn.mu]), 4),
        unit=unit,
        from_what=texts["steps"]["chosen" if chosen else "input"],
    )
    yield Step((scale,))
    every = measured_quantities(drawn, reading)
    yield Step(
        tuple(_quantity_text(one, every[one.name], drawn, language) for one in drawn.quantities)
    )


def _mm(value: float, notation: Notation) -> Rich:
    return notation.number(f"{value + 0.0:.2f}")


def _scale(drawn: GearDrawing) -> Rich:
    return f"μ_{{{drawn.motion.train.letter}}}"


def _quantity_text(
    one: MeasuredQuantity, both: ComparedNumber, drawn: GearDrawing, language: Language
) -> Rich:
    """Return a quantity with its formula, as it is read and exactly."""
    train = drawn.motion.train
    asked = parse(one.name, tuple(train.body_of))
    rays = [f"(o{drawn.label(body)})" for body in one.rays]
    parts = rays[: len(asked.labels)]
    if asked.carrier is not None:
        parts = [f"[{part} − {rays[-1]}]" for part in parts]
    formula = fraction(*parts) if asked.kind == "U" else f"{_scale(drawn)}·{parts[0]}"
    if asked.kind == "omega" and train.unit == "n":
        formula = f"{fraction('π', '30')}·{formula}"
    if asked.kind == "n" and train.unit != "n":
        formula = f"{fraction('30', 'π')}·{formula}"
    unit = unit_of(answer(drawn.motion, one.name), language)
    exact, read, sigma = language.notation.numbers(*both.texts)
    found: str = language.gears["sheet"]["steps"]["found"]
    return found.format(
        formula=f"{asked.symbol} = {formula}",
        read=f"{read} {unit}".rstrip(),
        exact=exact,
        sigma=sigma,
    )
