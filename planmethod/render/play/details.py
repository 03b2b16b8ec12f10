"""A played plan with its enlarged views beside it: they appear with their short segments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from planmethod.construct.steps import Name, PointName
from planmethod.note.narrate.naming import detail_view_letter, plan_letters, view_name
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.render.ink.drawing import Disc, Ink, Item, Stroke, shifted
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Line, Picture
from planmethod.render.pictures.collinear import drawn_vectors
from planmethod.render.pictures.lettered import (
    ENLARGED,
    clip_to_circle,
    letter_of_view,
    placed_in,
    radius_of,
    vector_pen,
)
from planmethod.render.pictures.planview import (
    PictureStyle,
    detail_pictures,
    plan_picture,
    plan_places,
    vector_label,
)
from planmethod.render.play.appearing import Moments
from planmethod.render.play.playback import letter_height
from planmethod.render.symbols import vector_arrow
from planmethod.solved.legibility import FEW, DetailView
from planmethod.solved.solution import Solution

GAP, UNDER = 8.0, 2.5
"""White between a plan and its enlarged views, and between a view and its name, mm."""

DOT = 0.7
"""Radius of the points of a view, mm."""


class PlayedPlan:
    """The finished drawing of a plan in one position (план с выносными элементами).

    Parameters
    ----------
    solution : Solution
    kind : PlanKind
    index : int
        Of the position.
    language : Language
    when : mapping of Name to int
        Number of the step that makes a point.
    first : int
        First step of the plan.
    """

    def __init__(
        self,
        solution: Solution,
        kind: PlanKind,
        index: int,
        language: Language,
        when: Mapping[Name, int],
        first: int,
    ) -> None:
        self.solution, self.kind, self.index, self.language = solution, kind, index, language
        self.when, self.first = when, first
        self.plan = solution.construction.plan(kind)
        self.at = plan_places(solution, kind, index)
        self.letter = letter_height(self.at.values())
        self.prefix = f"{kind.value} {index}"

    def drawn(self) -> tuple[tuple[Item, ...], tuple[int, ...]]:
        """Return its items, the pole at the origin, and the step with which each appears."""
        views = self.solution.detail_views_at(self.kind, self.index)
        letters = tuple(detail_view_letter(view, self.language) for view in views)
        style = PictureStyle(self.letter)
        picture = plan_picture(self.solution, self.kind, self.index, style, detail_letters=letters)
        moments = self._of_plan(views)
        items, appears = list(picture.items), list(moments.each(picture.items))
        for one, steps in self._detail_items(picture, views):
            items += one
            appears += steps
        return tuple(items), tuple(appears)

    def _step(self, *names: PointName) -> int:
        return max((self.when.get(name, self.first) for name in names), default=self.first)

    def _first_step(self, view: DetailView) -> int:
        """Return the step that makes the first short segment of a view."""
        return min((self._step(*pair) for pair in view.ends), default=self.first)

    def _labels(self, prefix: str) -> dict[str, int]:
        """Return the steps of the inscriptions of vectors and points by their names."""
        found = {
            vector_label(prefix, vector): self._step(vector.tail, vector.head)
            for vector in self.plan.vectors
        }
        for name, letters in plan_letters(self.solution.problem, self.plan).items():
            if letters:
                found[f"{prefix}: {letters[0]}"] = self._step(name)
        return found

    def _of_plan(self, views: tuple[DetailView, ...]) -> Moments:
        fine = len(self.solution.positions) > FEW
        exact: dict[Item, int] = {}
        for vector, ends in drawn_vectors(self.plan, self.at):
            step = self._step(vector.tail, vector.head)
            pen = vector_pen(vector, self.kind, fine=fine)
            for item in vector_arrow(*ends, pen=pen, tag=vector.kind.value):
                exact[item] = min(step, exact.get(item, step))
        places = [(place, self._step(name)) for name, place in self.at.items()]
        labels, begins = self._labels(self.prefix), {v.number: self._first_step(v) for v in views}
        labels |= {f"{ENLARGED} {number}": step for number, step in begins.items()}
        tags = {f"{ENLARGED} {number} place": step for number, step in begins.items()}
        return Moments(places, tags, labels, {}, self.first, exact)

    def _detail_items(
        self, picture_of_plan: Picture, views: tuple[DetailView, ...]
    ) -> Iterator[tuple[list[Item], list[int]]]:
        """Yield the enlarged views under one another, each under its name."""
        pictures = detail_pictures(
            self.solution, self.kind, self.index,
            letter_height=self.letter, use_ruler=False, whole=picture_of_plan,
        )  # fmt: skip
        corner = complex(picture_of_plan.bounds[2] + GAP, picture_of_plan.bounds[3])
        for view, picture in zip(views, pictures, strict=True):
            name = Line(typeset(view_name(view, self.language), letter_of_view(self.letter)))
            width, begin = max(name.width, picture.width), self._first_step(view)
            said = name.place(corner + (width - name.width) / 2)
            yield said, [begin for _ in said]
            corner -= 1j * (name.height + UNDER)
            middle = corner + (width - picture.width) / 2
            by = middle - complex(picture.bounds[0], picture.bounds[3])
            steps = self._of_view(view).each(picture.items)
            yield list(shifted(picture.items, by)), [max(step, begin) for step in steps]
            corner -= 1j * (picture.height + GAP)

    def _of_view(self, view: DetailView) -> Moments:
        own, places = f"{ENLARGED} {view.number}", placed_in(view, self.at)
        exact: dict[Item, int] = {}
        radius = radius_of(view, self.at)
        for vector, ends in drawn_vectors(self.plan, places):
            inside = clip_to_circle(*ends, radius)
            if inside is None:
                continue
            step, tag = self._step(vector.tail, vector.head), vector.kind.value
            pen = vector_pen(vector, self.kind)
            for item in (*vector_arrow(*inside, pen=pen, tag=tag), Stroke(inside, pen, tag=tag)):
                exact[item] = min(step, exact.get(item, step))
        there = [(place, self._step(name)) for name, place in places.items()]
        # The disc of points that coincide is that of the first of them.
        for place, step in reversed(there):
            exact[Disc(place, DOT, Ink.BLACK)] = step
        return Moments(there, {own: self.first}, self._labels(own), {}, self.first, exact)
