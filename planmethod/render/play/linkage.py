"""The construction of a linkage played: the scheme, the velocity and acceleration plans, forces."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property, partial

from msgspec.structs import replace

from planmethod.construct import steps
from planmethod.construct.steps import Name, PointName, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.document import Step as ToldStep
from planmethod.note.narrate.equations import StatedEquation, known_directions
from planmethod.note.narrate.naming import direction_note, scale_inscription
from planmethod.note.protocol import DescribedNode, DescribedSection, described_sections
from planmethod.note.wording import Language
from planmethod.plans.model import FACTS, PlanKind
from planmethod.render.ink.drawing import Item, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.pictures.planview import (
    PictureStyle,
)
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.pictures.springs import springs_in
from planmethod.render.play.appearing import ON, Moments
from planmethod.render.play.details import PlayedPlan
from planmethod.render.play.playback import (
    Board,
    Measured,
    Playback,
    PlayedEquation,
    PlayedSection,
    PlayedStep,
    letter_height,
)
from planmethod.render.play.strokes import Strokes
from planmethod.solved.solution import Solution

SCHEME = PlanKind.POSITION.value
"""Board of the scheme: it is seen beside the plans."""


def linkage_playback(solution: Solution, language: Language, index: int = 0) -> Playback:
    """Return the construction of one position as it is played (воспроизведение построения).

    Each step of the program of the plans is in one played step, with a sentence; the lines and
    letters of the finished drawings are those of `scheme_picture` and `plan_picture`.

    Parameters
    ----------
    solution : Solution
    language : Language
        Of the sentences.
    index : int
        Index into ``solution.positions``.

    Raises
    ------
    AssemblyError
        A force plan does not close.
    """
    return _Player(solution, language, index).playback()


class _Player:
    def __init__(self, solution: Solution, language: Language, index: int) -> None:
        self.solution, self.language, self.index = solution, language, index
        self.narrator, self.parts = described_sections(solution, language, index)
        self.names = self.narrator.names
        construction = solution.construction
        self._kind: dict[Name, PlanKind] = {
            step.out: section.kind for section in construction.sections for step in section.steps
        }
        self._poles: dict[PlanKind, Step] = {}
        for plan in construction.plans:
            assert plan.pole is not None
            self._poles[plan.kind] = construction.step(plan.pole)
            self._kind[plan.pole] = plan.kind
        self._first: dict[PlanKind, DescribedSection] = {}
        for part in self.parts:
            self._first.setdefault(part.section.kind, part)
        self.strokes = Strokes(
            construction.program.steps,
            solution.paper.value,
            lambda step: self._kind.get(step.out, PlanKind.POSITION).value,
            index,
            dots=self._is_visible,
        )
        self.when: dict[Name, int] = {}

    def _is_visible(self, name: PointName) -> bool:
        """Return whether a point has a letter on the paper, or a name in the sentences."""
        return (
            name in self.names.letters
            or name in self._named_aids
            or any(name in body.points for body in self.solution.problem.bodies.values())
        )

    @cached_property
    def _named_aids(self) -> frozenset[PointName]:
        """Auxiliary points of the scheme that sentences name: feet, tangencies, special points."""
        draft = self.solution.construction.draft
        special = {one.point for one in draft.special.values()}
        return frozenset(
            PointName(step.out)
            for step in self.names.step.values()
            if step.out in draft.feet or step.out in special or isinstance(step, steps.Touch)
        )

    def playback(self) -> Playback:
        """Return all of it."""
        sections = list[PlayedSection]()
        first: dict[PlanKind, int] = {}
        count = 0
        for part in self.parts:
            kind, played = part.section.kind, self._steps(part)
            first.setdefault(kind, count)
            for number, step in enumerate(played, count):
                self.when |= dict.fromkeys(map(PointName, step.names), number)
            count += len(played)
            title = f"{part.plan}. {part.title}"
            equations = self._equations(part)
            source = "" if kind is PlanKind.POSITION else SCHEME
            sections.append(PlayedSection(title, kind.value, tuple(played), equations, source))
        boards = [self._board(kind, begin) for kind, begin in first.items()]
        if self.solution.problem.dynamics is not None:
            from planmethod.render.play.forces import force_sections

            more, forces = force_sections(self.narrator.formulas, self.index, count)
            sections += more
            boards += forces
        title = self.solution.problem.title or self.solution.problem.name
        return Playback.of(title, boards, sections)

    # Steps -----------------------------------------------------------------------------------

    def _steps(self, part: DescribedSection) -> list[PlayedStep]:
        """Return the played steps of a section: those of its nodes that are sentences."""
        found, waiting = list[PlayedStep](), list[Step]()
        for one in self._with_pole_first(part):
            waiting += one.steps
            if isinstance(one.node, ToldStep):
                found.append(self._step(one.node.lines, waiting))
                waiting = []
        if waiting and found:
            last = found.pop()
            more = self._step(last.lines, waiting)
            found.append(
                replace(
                    more,
                    names=(*last.names, *more.names),
                    marks=(*last.marks, *more.marks),
                    measured=(*last.measured, *more.measured),
                )
            )
        return found

    def _with_pole_first(self, part: DescribedSection) -> Sequence[DescribedNode]:
        """Return the nodes of a section, the pole with the sentence that chooses it.

        The program takes both poles at once.
        """
        kind, nodes = part.section.kind, part.nodes
        opens = self._first[kind] is part and kind is not PlanKind.POSITION
        poles = {step.out for step in self._poles.values()}
        rest = [
            replace(node, steps=tuple(step for step in node.steps if step.out not in poles))
            for node in nodes
        ]
        if opens and rest:
            rest[0] = replace(rest[0], steps=(self._poles[kind], *rest[0].steps))
        return rest

    def _step(self, lines: Sequence[str], program_steps: Sequence[Step]) -> PlayedStep:
        marks = [mark for step in program_steps for mark in self.strokes.of(step)]
        return PlayedStep(
            tuple(lines),
            tuple(str(step.out) for step in program_steps),
            tuple(dict.fromkeys(marks)),
            tuple(self._measured(program_steps)),
        )

    def _measured(self, program_steps: Iterable[Step]) -> Iterator[Measured]:
        """Yield the segments that are read, and the values of those that show a quantity."""
        formulas, names = self.narrator.formulas, self.names
        for step in program_steps:
            match step:
                case steps.Measure(out, tail, head) | steps.MeasureAlong(out, tail, head):
                    if formulas.readable(out):
                        yield Measured(names.segment(tail, head), abs(formulas.number(out)))
                case steps.Compute(out, _, powers) if self.narrator.motion.is_value(
                    step
                ) and formulas.readable(out):
                    length = powers[1][0]
                    read = names.step[length]
                    ends = (
                        (read.tail, read.head)
                        if isinstance(read, steps.Measure | steps.MeasureAlong)
                        else None
                    )
                    kind = self._kind.get(out, PlanKind.POSITION)
                    yield Measured(
                        "" if ends is None else names.segment(*ends),
                        abs(formulas.number(length)),
                        names.symbol(out),
                        abs(formulas.number(out)),
                        self.language.notation.units[FACTS[kind].unit],
                    )
                case _:
                    pass

    # Equations -------------------------------------------------------------------------------

    def _equations(self, part: DescribedSection) -> tuple[PlayedEquation, ...]:
        """Return the vector equations that a section solves."""
        kind = part.section.kind
        if kind is PlanKind.POSITION:
            return ()
        made = {step.out for step in part.section.steps}
        directed = partial(direction_note, self.names)
        known = known_directions(self.solution.construction, self.solution.problem, kind)
        return tuple(
            PlayedEquation(one.written(directed, known), self._drawn(one))
            for one in self.names.stated(kind)
            if one.head in made
        )

    def _drawn(self, one: StatedEquation) -> tuple[int, ...]:
        """Return the steps that draw the terms of an equation."""
        return tuple(
            max(self.when.get(term.tail, -1), self.when.get(term.head, -1))
            for term in (*one.left, *one.right)
        )

    # Finished drawings -----------------------------------------------------------------------

    def _board(self, kind: PlanKind, first: int) -> Board:
        """Return the board of a plan with its finished drawing."""
        problem, notation = self.solution.problem, self.language.notation
        scale = self.solution.plan_scale(kind, self.index)
        inscription = scale_inscription(scale, problem.scales.convention, notation)
        if kind is PlanKind.POSITION:
            items, moments = self._scheme(first)
            appears = moments.each(items)
        else:
            played = PlayedPlan(self.solution, kind, self.index, self.language, self.when, first)
            items, appears = played.drawn()
        title = self.language.note["plans"][kind.value]
        return Board(kind.value, title, inscription, items=items, appears=appears)

    def _scheme(self, first: int) -> tuple[tuple[Item, ...], Moments]:
        solution, when = self.solution, self.when
        problem = solution.problem
        places = [
            (self.strokes.point(PointName(point)), when.get(PointName(point), first))
            for body in problem.bodies.values()
            for point in body.points
        ]
        links = {
            link: max((when.get(PointName(point), first) for point in body.points), default=first)
            for link, body in problem.bodies.items()
            if link != FRAME
        }
        style = PictureStyle(letter_height(at for at, _ in places))
        labels = tuple(self._auxiliary([at for at, _ in places], style.letter_height))
        picture = scheme_picture(solution, self.index, style, hide_motion=True, added=((), labels))
        named = {f"point {point}": step for point, step in self._moments_by_name()}
        named |= {f"auxiliary {name}": when[name] for name in self._named_aids if name in when}
        tags = {f"link {link}": step for link, step in links.items()}
        for number, spring in enumerate(springs_in(problem), 1):  # it joins two links
            step = max((links.get(link, first) for link in spring.links), default=first)
            tags[f"spring {number}"] = named[f"spring {number}"] = step
        exact = dict(_open_arms(picture.items, places))
        return picture.items, Moments(places, tags, named, links, first, exact)

    def _moments_by_name(self) -> Iterator[tuple[str, int]]:
        for name, step in self.when.items():
            if self._kind.get(name) is PlanKind.POSITION:
                yield str(name), step

    def _auxiliary(self, other_places: Sequence[complex], height: float) -> Iterator[Label]:
        """Yield the letters of auxiliary points that are in no other point's place."""
        for name in sorted(self._named_aids & {*self.when}):
            place = self.strokes.point(name)
            if all(abs(place - other) > ON for other in other_places):
                inscription = typeset(self.names.point(name), height)
                yield Label(inscription, place, gap=1.4, name=f"auxiliary {name}")


def _open_arms(
    items: Iterable[Item], places: Sequence[tuple[complex, int]]
) -> Iterator[tuple[Item, int]]:
    """Yield the arms of links that end in no point, such as a guide of a slider.

    An arm appears with the last point that is found on it.
    """
    for item in items:
        if not (isinstance(item, Stroke) and item.tag.startswith(LINK) and len(item.points) == 2):
            continue
        start, end = item.points
        if all(any(abs(at - place) <= ON for place, _ in places) for at in (start, end)):
            continue
        along = (end - start) / abs(end - start) if end != start else 1 + 0j
        there = [((place - start) / along, step) for place, step in places]
        under = [
            step
            for by, step in there
            if abs(by.imag) <= ON and -ON <= by.real <= abs(end - start) + ON
        ]
        if len(under) > 1:
            yield item, max(under)


LINK = "link "
"""Beginning of the tags of the lines of links."""
