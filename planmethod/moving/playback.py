"""The construction of a moving point as it is played: the vectors of each shown moment."""

from __future__ import annotations

import numpy as np

from planmethod.construct import steps
from planmethod.construct.drafting import Profile
from planmethod.construct.steps import Name, NumberName, PointName, Step
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.moving.construction import (
    POLES,
    MomentConstruction,
    construct,
    drawn_interval,
)
from planmethod.moving.motion import PointProblem
from planmethod.moving.results import PointNarrator
from planmethod.moving.sheet import sheet_scales
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import scale_inscription
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen
from planmethod.render.ink.typeset import typeset, vector_markup
from planmethod.render.labels import Label
from planmethod.render.pictures.lettered import lettered
from planmethod.render.play.appearing import Moments
from planmethod.render.play.playback import Board, Playback, PlayedSection
from planmethod.render.play.strokes import Strokes, grouped, lettered_points
from planmethod.render.symbols import vector_arrow

LETTER = 5.0
"""Height of letters, mm."""


def playback(problem: PointProblem, language: Language, profile: Profile) -> Playback:
    """Return the construction of the shown moments as it is played.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval, or no moment has a velocity.
    LayoutError
        The sheet cannot be drawn.
    """
    course = drawn_interval(problem)
    scales = sheet_scales(problem, course, profile)
    sections, boards = list[PlayedSection](), list[Board]()
    for k in course.shown:
        built = construct(problem, course.marks, k, scales)
        if built is None:
            continue
        time = language.notation.as_input(float(course.marks.columns["t"][k]))
        title = language.point.at.format(time=time)
        first = sum(len(section.steps) for section in sections)
        played = _Player(built, problem, language, profile, f"{k}", first)
        sections += played.sections(title)
        boards += played.boards(title)
    if not sections:
        hint = translate("Give moments in which the point moves; its results: planmethod solve.")
        raise ProblemError(
            problem.name, [Fault("point.t", translate("no moment has a velocity to draw"), hint)]
        )
    return Playback.of(problem.title or problem.name, boards, sections)


class _Player:
    """The steps of one moment, on a board for the wheel and for each plan."""

    def __init__(
        self,
        built: MomentConstruction,
        problem: PointProblem,
        language: Language,
        profile: Profile,
        name: str,
        first: int,
    ) -> None:
        self.built, self.problem, self.language = built, problem, language
        self.first, self.name = first, name
        self.narrator = PointNarrator(built, language, profile)
        self.plan: dict[Name, str] = {}
        for step in built.program.steps:
            self.plan[step.out] = self._plan(step)
        self.strokes = Strokes(
            built.program.steps,
            self.narrator.exact.value,
            lambda step: f"{self.plan[step.out]}-{name}",
        )
        self.when: dict[Name, int] = {}

    def _plan(self, step: Step) -> str:
        """Return the drawing to which a step belongs: that of its origin, l of a wheel."""
        poles = {pole: plan for plan, pole in POLES.items()}
        if step.out in poles:
            return poles[PointName(step.out)]
        if isinstance(step, steps.GivenPoint):
            return "l"
        for field in ("origin", "through", "tail", "first", "length", "head"):
            name = getattr(step, field, None)
            if name in self.plan:
                return self.plan[name]
        if isinstance(step, steps.Compute):
            used = {self.plan[name] for name, _ in step.powers if name in self.plan}
            begun = [*dict.fromkeys(self.plan.values())]
            if used:
                return max(used, key=begun.index)
        return next(reversed(self.plan.values()), "v")

    def sections(self, title: Rich) -> list[PlayedSection]:
        """Return the sections of the moment: one for each drawing, in the order of the steps."""
        found = list[PlayedSection]()
        told = ((step, self.narrator.narrate(step)) for step in self.built.program.steps)
        for number, (lines, made) in enumerate(grouped(told), self.first):
            step = self.strokes.played(lines, made)
            self.when |= dict.fromkeys(map(PointName, step.names), number)
            plan = self.plan[made[-1].out]
            board = f"{plan}-{self.name}"
            if found and found[-1].board == board:
                last = found.pop()
                found.append(PlayedSection(last.title, board, (*last.steps, step)))
            else:
                found.append(PlayedSection(f"{title}. {self._name(plan)}", board, (step,)))
        return found

    def _name(self, plan: str) -> Rich:
        kinds = {"l": "position", "v": "velocity", "a": "acceleration"}
        name: Rich = self.language.note["plans"][kinds[plan]]
        return name

    def _inscription(self, plan: str) -> Rich:
        convention, notation = self.problem.scales.convention, self.language.notation
        return scale_inscription(self.built.scales[plan], convention, notation)

    # Finished drawings -----------------------------------------------------------------------

    def boards(self, title: Rich) -> list[Board]:
        """Return the boards of the moment with the vectors and letters of its plans."""
        found = list[Board]()
        for plan in dict.fromkeys(self.plan.values()):
            items, appears = self._wheel() if plan == "l" else self._vectors(plan)
            scale = self._inscription(plan)
            whole = f"{title}. {self._name(plan)}"
            found.append(Board(f"{plan}-{self.name}", whole, scale, items=items, appears=appears))
        return found

    def _wheel(self) -> tuple[tuple[Item, ...], tuple[int, ...]]:
        letters = {
            PointName(step.out): self.built.letters[step.out]
            for step in self.built.program.steps
            if self.plan[step.out] == "l"
            and isinstance(step, steps.GivenPoint | steps.LayOffLength)
        }
        return lettered_points(self.strokes, letters, self.when, LETTER)

    def _vectors(self, plan: str) -> tuple[tuple[Item, ...], tuple[int, ...]]:
        pole = POLES[plan]
        items: list[Item] = []
        labels = [Label(typeset(pole, LETTER), 0j, gap=1.6, priority=2, name="pole")]
        exact: dict[Item, int] = {}
        named = {"pole": self.when.get(pole, self.first)}
        for vector in self.built.vectors:
            if vector.plan != plan:
                continue
            ends = self.strokes.point(vector.tail), self.strokes.point(vector.head)
            step = max(self.when[vector.tail], self.when[vector.head])
            if vector.is_resultant:
                step = self.when[NumberName(plan)]
            if not np.isfinite(ends).all():
                continue
            pen = Pen.RESULTANT if vector.is_resultant else Pen.COMPONENT
            arrow = vector_arrow(*ends, pen=pen, tag=vector.symbol)
            exact |= dict.fromkeys(arrow, step)
            items += arrow
            if arrow:
                name = f"vector {vector.symbol}"
                text = typeset(vector_markup(vector.symbol), LETTER)
                labels.append(Label(text, sum(ends) / 2, ends, gap=1.2, name=name))
                named[name] = step
        items.append(Disc(0j, 0.9, Ink.BLACK))
        picture = lettered(items, labels)
        places = [(0j, named["pole"])]
        moments = Moments(places, labels=named, first=self.first, exact=exact)
        return picture.items, moments.each(picture.items)
