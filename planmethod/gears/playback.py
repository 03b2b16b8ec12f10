"""The construction of the velocity diagrams of a train as it is played (воспроизведение картин)."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial

from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.steps import Name, PointName, Step
from planmethod.errors import Fault, ProblemError
from planmethod.gears.construction import (
    POLE,
    RAY_ORIGIN,
    GearDrawing,
    GearReading,
    construct,
    read,
)
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import draw
from planmethod.gears.protocol import DiagramNarrator, readings
from planmethod.gears.sheet import as_drawn, inscribe_scale
from planmethod.gears.text import no_diagrams
from planmethod.gears.views import SEGMENT, angular, linear, linear_views, ray_views
from planmethod.note.document import Step as ToldStep, plain_text
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import detail_view_letter
from planmethod.note.numbers import half_up
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.pictures.lettered import lettered
from planmethod.render.play.appearing import Moments
from planmethod.render.play.playback import Board, Playback, PlayedSection, PlayedStep
from planmethod.render.play.strokes import Strokes, grouped
from planmethod.render.symbols import vector_arrow

LINEAR, RAYS = "linear", "rays"
"""Boards of the two diagrams."""

LETTER = 5.0
"""Height of letters, mm."""


def playback(problem: GearProblem, language: Language, profile: Profile) -> Playback:
    """Return the construction of the velocity diagrams as it is played.

    Raises
    ------
    ProblemError
        The train cannot be, its inputs do not fit, or it has no diagrams.
    """
    motion = as_drawn(problem, profile)
    picture = draw(motion)
    if picture is None:
        text = plain_text(no_diagrams(motion, language))
        raise ProblemError(problem.name, [Fault("gears", text)])
    drawn = construct(motion, picture)
    return _Player(problem, drawn, read(drawn, profile), language, profile).playback()


class _Player:
    def __init__(
        self,
        problem: GearProblem,
        drawn: GearDrawing,
        reading: GearReading,
        language: Language,
        profile: Profile,
    ) -> None:
        self.problem, self.drawn, self.reading = problem, drawn, reading
        self.language, self.profile = language, profile
        self.program = drawn.program.steps
        outs = [step.out for step in self.program]
        self.cut = outs.index(POLE)
        rays = {*outs[self.cut :]}
        self.strokes = Strokes(
            self.program, reading.exact.value, lambda step: RAYS if step.out in rays else LINEAR
        )
        self.when: dict[Name, int] = {}
        self._left = list[Step]()  # computed from the readings

    def playback(self) -> Playback:
        """Return all of it."""
        texts = self.language.gears["sheet"]
        sections = [
            PlayedSection(texts.pictures, LINEAR, tuple(self._linear())),
            PlayedSection(texts["steps"]["rays"], RAYS, tuple(self._rays()), source=LINEAR),
            PlayedSection(texts["steps"]["readings"], RAYS, tuple(self._readings()), source=LINEAR),
        ]
        count = 0
        for section in sections:
            for step in section.steps:
                self.when |= dict.fromkeys(map(PointName, step.names), count)
                count += 1
        first = len(sections[0].steps)
        boards = [
            self._board(LINEAR, sections[0].title, 0),
            self._board(RAYS, sections[1].title, first),
        ]
        return Playback.of(self.problem.title or self.problem.name, boards, sections)

    # Steps -----------------------------------------------------------------------------------

    def _linear(self) -> Iterator[PlayedStep]:
        """Yield the steps of the linear velocity diagram, its axis first."""
        narrator = DiagramNarrator(self.drawn, self.language)
        axis: Rich = self.language.gears["sheet"]["steps"]["axis"]
        opening = [step for step in self.program[: self.cut] if self._is_axis(step)]
        yield self.strokes.played((axis,), opening)
        rest = [step for step in self.program[: self.cut] if step not in opening]
        for lines, made in grouped((step, narrator.narrate(step)) for step in rest):
            yield self.strokes.played(lines, made)

    @staticmethod
    def _is_axis(step: Step) -> bool:
        """Return whether a step is of the axis of contact points: it has no sentence of its own."""
        return isinstance(step, steps.GivenPoint | steps.AtAngle | steps.Perpendicular) or (
            isinstance(step, steps.GivenNumber) and step.out == "level"
        )

    def _rays(self) -> Iterator[PlayedStep]:
        """Yield the pole, and the ray of each body with its segment."""
        said = self.language.gears["sheet"]["steps"]
        pole = self.language.notation.as_input(half_up(float(self.drawn.diagrams.pole_mm), 2))
        rest = list(self.program[self.cut :])
        begun = [step.out for step in rest].index(RAY_ORIGIN) + 2  # the level line through it
        yield self.strokes.played((said["pole"].format(pole=pole),), rest[:begun])
        bodies: dict[Name, str] = {one: body for body, one in self.drawn.segments.items()}
        waiting = list[Step]()
        for step in rest[begun:]:
            waiting.append(step)
            if step.out in bodies:
                text = said["ray"].format(body=self.drawn.label(bodies[step.out]))
                yield self.strokes.played((text,), waiting)
                waiting = []
        self._left = waiting

    def _readings(self) -> Iterator[PlayedStep]:
        """Yield the values that are read, with the steps that compute them."""
        nodes = readings(self.drawn, self.reading, self.profile, self.language)
        told = [node for node in nodes if isinstance(node, ToldStep)]
        for node in told[:-1]:
            yield PlayedStep(node.lines)
        yield self.strokes.played(told[-1].lines, self._left)

    # Finished diagrams -----------------------------------------------------------------------

    def _board(self, board: str, title: Rich, first: int) -> Board:
        drawn, reading, when = self.drawn, self.reading, self.when
        own = {**drawn.lines} if board == LINEAR else {**drawn.rays}
        kind = "line" if board == LINEAR else "ray"
        tags = {f"{kind} {body}": when.get(name, first) for body, name in own.items()}
        views = linear_views(reading) if board == LINEAR else ray_views(reading)
        letters = [detail_view_letter(view, self.language) for view in views]
        picture = (
            lettered(*linear(drawn, reading, LETTER, letters))
            if board == LINEAR
            else angular(drawn, reading, LETTER, letters)
        )
        places = [
            (self.strokes.point(PointName(name)), step)
            for name, step in when.items()
            if isinstance(step_of := self.strokes.step.get(name), steps.GivenPoint
                          | steps.LayOffLength | steps.IntersectLines)
            and self.strokes.board(step_of) == board
        ]  # fmt: skip
        exact: dict[Item, int] = {}
        for spot in drawn.spots if board == LINEAR else ():
            ends = self.strokes.point(spot.base), self.strokes.point(spot.end)
            for tag in ("", SEGMENT):  # on a detail view it is measured there
                arrow = vector_arrow(*ends, pen=Pen.COMPONENT, tag=tag)
                exact |= dict.fromkeys(arrow, when.get(spot.end, first))
        items = picture.items
        axes = (item for item in items if isinstance(item, Stroke) and item.pen is Pen.AXIS)
        exact |= dict.fromkeys(axes, first)
        moments = Moments(places, tags, dict(tags), first=first, exact=exact)
        scale = self._inscription(board)
        return Board(board, title, scale, items=items, appears=moments.each(items))

    def _inscription(self, board: str) -> Rich:
        """Return the inscription of the scales of a diagram, as on the sheet."""
        diagrams, inscribed = self.drawn.diagrams, partial(inscribe_scale, self.language)
        if board == LINEAR:
            lengths = inscribed("mu_l", float(diagrams.mu_l))
            return f"{lengths}; {inscribed('mu_v', diagrams.mu_v)}"
        key, value = diagrams.ray_scale(self.drawn.motion.train.unit)
        pole = self.language.notation.as_input(half_up(float(diagrams.pole_mm), 2))
        return inscribed(key, value, pole=pole)
