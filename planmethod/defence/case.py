"""The work of a student: its solution, its sheets, its letters (работа)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from math import hypot, sqrt
from typing import Any, TypeAlias, TypeVar

import numpy as np

from planmethod.check.marks import Settings
from planmethod.check.tolerance import SHORT, Tolerance
from planmethod.construct.drafting import PROFILES, Profile
from planmethod.defence.model import Instance, NumberAnswer, Place
from planmethod.defence.places import NumberedSheet, Sheets
from planmethod.mechanism.structure import kind_of_motion
from planmethod.note.compared import Series
from planmethod.note.formula import Rich
from planmethod.note.numbers import with_unit
from planmethod.note.tables.errors import motion_series, relative_series
from planmethod.note.wording import Language, MessageTable, get_language
from planmethod.options import PlanRequest
from planmethod.plans.model import PlanKind, Vector, VectorKind
from planmethod.problem.quantities import QuantityKind
from planmethod.problem.records import KindProblem, Mass
from planmethod.project.parts import PartName
from planmethod.project.settle import Homework, Project
from planmethod.project.sheets import numbered_set, part_drawings
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.solution import Solution

K = TypeVar("K", bound=KindProblem)
S = TypeVar("S")

STRICT = Settings()
"""The tolerances of grading without a department's settings."""


class Case:
    """A work with its sheets, from which questions are made (работа).

    Parameters
    ----------
    work : Project or Homework
    language : Language

    Attributes
    ----------
    sheets : Sheets
        All its sheets, numbered as one set.
    """

    def __init__(self, work: Project | Homework, language: Language | None = None) -> None:
        self.work = work
        self.language = get_language(work.language) if language is None else language
        self.sheets = Sheets(list(_sheets_of(work)))
        self._solved: dict[Any, Any] = {}

    @property
    def texts(self) -> MessageTable:
        """Sentences of questions."""
        return self.language.defence

    @property
    def project(self) -> Project | None:
        """The project of a linkage; None for another kind of problem."""
        return self.work if isinstance(self.work, Project) else None

    def problem_of(self, kind: type[K]) -> K | None:
        """Return the problem of a kind that the work has as a part, or is; None without one."""
        found: list[KindProblem] = [part.problem for part in self.work.parts]
        if isinstance(self.work, Homework):
            found.append(self.work.problem)
        return next((one for one in found if isinstance(one, kind)), None)

    def solved(self, kind: type[K], solve: Callable[[K], S]) -> S | None:
        """Return what a function makes of the problem of a kind, made once; None without one."""
        problem = self.problem_of(kind)
        if problem is not None and solve not in self._solved:
            self._solved[solve] = solve(problem)
        return self._solved.get(solve)

    @cached_property
    def has_forces(self) -> bool:
        """Whether forces are calculated."""
        project = self.project
        return project is not None and project.part(PartName.FORCES) is not None

    @property
    def solution(self) -> Solution:
        """The linkage in all positions."""
        assert self.project is not None, "only a linkage has plans"
        return self.project.solution

    @property
    def loaded(self) -> Solution:
        """The linkage in the calculated position."""
        assert self.project is not None, "only a linkage has plans"
        return self.project.loaded

    @property
    def masses(self) -> Mapping[str, Mass]:
        """The masses of the links by their names; none without a table of them."""
        dynamics = self.solution.problem.dynamics
        return {} if dynamics is None else dynamics.masses

    @property
    def statics(self) -> Statics:
        """Its forces in the calculated position."""
        return statics_of(self.loaded)

    # Texts ---------------------------------------------------------------------------------------

    def unit(self, name: str) -> Rich:
        """Return the letters of a unit of SI."""
        return self.language.notation.units[name] if name else ""

    def number(self, value: float, unit: str = "") -> Rich:
        """Return a computed number with its unit."""
        text = self.language.notation.computed(value)
        return with_unit(text, self.unit(unit)) if unit else text

    def input_number(self, value: float, unit: str = "") -> Rich:
        """Return a given number with its unit."""
        text = self.language.notation.as_input(value)
        return with_unit(text, self.unit(unit)) if unit else text

    def link(self, link: str, case: str = "who") -> Rich:
        """Return the name of a link with its number: ``кулиса 3``."""
        return self.language.report.of_link.format(role=self.role(link, case), link=link)

    def role(self, link: str, case: str = "who") -> Rich:
        """Return the name of a link."""
        rows = kind_of_motion(self.solution.problem.mechanism)
        kind = next(row for row in rows if row.link == link)
        roles: MessageTable = self.language.report["roles"][case]
        return str(roles[kind.role.value])

    def at_position(self, index: int) -> Rich:
        """Return the phrase "in position 3", after a blank; empty where it is the only one."""
        if len(self.solution.positions) == 1:
            return ""
        return self.texts.at_position.format(number=index)

    @property
    def at_calculated(self) -> Rich:
        """The same of the calculated position."""
        assert self.project is not None
        return self.at_position(self.project.calculated)

    # Numbers -------------------------------------------------------------------------------------

    def computed(self, value: float, unit: str = "") -> NumberAnswer:
        """Return a number that follows by calculation: its tolerance is a share of it."""
        tolerance = STRICT.floor_share * abs(value) * 2.0
        return NumberAnswer(value, tolerance, self.unit(unit))

    def exactly(self, value: float, unit: str = "") -> NumberAnswer:
        """Return a whole number."""
        return NumberAnswer(value, 0.0, self.unit(unit))

    @property
    def profile(self) -> Profile:
        """The hand that draws."""
        return PROFILES["board"] if self.project is None else self.solution.profile

    @property
    def length_sigma(self) -> float:
        """One sigma of a length between two points that is read with the ruler, mm."""
        return hypot(sqrt(2.0) * self.profile.point, self.profile.measure)

    def drawn(
        self,
        value: float,
        sigma: float,
        per_mm: float = 0.0,
        unit: str = "",
        *,
        times: float = 1.0,
        off: float = 0.0,
        cap: float = STRICT.cap,
    ) -> NumberAnswer | None:
        """Return a number that is read from the drawing; None where the drawing cannot show it.

        Its tolerance is that of grading. ``times`` is a factor of the question; ``off`` is the
        difference of the construction itself from the exact value. ``cap`` is the largest
        tolerance as a share of the value.
        """
        size = abs(value)
        most = cap * size
        spread = STRICT.k * sigma
        if not np.isfinite(sigma) or size <= SHORT * sigma or spread > most or not size:
            return None
        if abs(off) > most:
            return None
        least = min(max(STRICT.floor_mm * per_mm, STRICT.floor_share * size), most)
        limit = Tolerance(value, sigma, spread, least, most, True, False, per_mm)
        tolerance = limit.tolerance() + abs(off)
        return NumberAnswer(times * value, abs(times) * tolerance, self.unit(unit))

    def read(self, series: Series, index: int, times: float = 1.0) -> NumberAnswer | None:
        """Return the magnitude of a quantity in a position as an answer; None if not readable."""
        one = series[index]
        return self.drawn(abs(one.exact), one.sigma, unit=series.unit, times=times)

    def readable(self, series: Series) -> Iterator[tuple[int, float]]:
        """Yield the positions in which a quantity can be read, with its value."""
        for index in range(len(series.exact)):
            if self.read(series, index) is not None:
                yield index, float(series.exact[index])

    def visible(self, series: Series) -> Iterator[tuple[int, float]]:
        """Yield the positions in which a quantity is not too short to be seen, with its value."""
        for index in range(len(series.exact)):
            one = series[index]
            if np.isfinite(one.sigma) and abs(one.exact) > SHORT * one.sigma and one.exact:
                yield index, float(one.exact)

    # Motion --------------------------------------------------------------------------------------

    def motion(self, kind: QuantityKind) -> list[Series]:
        """Return the quantities of a kind of all points or links, in all positions."""
        return motion_series(self.solution, kind)

    def relative(self, plan: PlanKind, *kinds: VectorKind) -> Iterator[tuple[Vector, Series]]:
        """Yield the vectors of two points of some kinds, each with its values."""
        found = {one.symbol: one for one in relative_series(self.solution, plan)}
        seen: set[str] = set()
        for vector in self.solution.construction.plan(plan).vectors:
            if vector.kind in kinds and vector.symbol in found and vector.symbol not in seen:
                seen.add(vector.symbol)
                yield vector, found[vector.symbol]

    @cached_property
    def crank_points(self) -> frozenset[str]:
        """Points of the driving link."""
        problem = self.solution.problem
        return frozenset(problem.bodies[problem.drive.link].points)

    # Places --------------------------------------------------------------------------------------

    @cached_property
    def plans_part(self) -> PartName:
        """Part whose sheets have the plans of all positions."""
        assert self.project is not None
        return PartName.KINEMATICS if self.project.part(PartName.KINEMATICS) else PartName.FORCES

    def scheme(self) -> Place:
        """Return the scheme of the mechanism."""
        return self._first_view(self.plans_part, PlanKind.POSITION.value)

    def diagrams(self, mark: str = "") -> Place | None:
        """Return the diagrams of the output, or an inscription in them."""
        return self.sheets.find(PartName.KINEMATICS, "diagram", mark)

    def plan(self, kind: PlanKind, index: int, letter: str = "") -> Place:
        """Return the plan of a position: a letter on it, its pole, or the view."""
        part = self.plans_part
        for mark in (re.escape(letter), ".*") if letter else (".*",):
            place = self.sheets.find(part, kind.value, rf"{kind.value} {index}: {mark}")
            if place is not None:
                return place
        return self._first_view(part, kind.value)

    def own_part(self, name: PartName) -> PartName | None:
        """Return the part whose sheets a subject has; None of a work that is one problem."""
        return None if self.project is None else name

    def of_part(self, part: PartName | None, kind: str, *marks: str) -> Place:
        """Return the first inscription that a part's sheets have, else the first view of a kind."""
        for mark in marks:
            place = self.sheets.find(part, kind, mark) or self.sheets.find(part, "", mark)
            place = place or self.sheets.find_text(part, mark)
            if place is not None:
                return place
        return self._first_view(part, kind)

    def _first_view(self, part: PartName | None, kind: str) -> Place:
        """Return the first view of a kind of a part, else its first view, else its first sheet."""
        for one in (kind, ""):
            place = self.sheets.find(part, one)
            if place is not None:
                return place
        for sheet in self.sheets.sheets:
            if sheet.part is part:
                return self.sheets.middle_of(sheet)
        return self.sheets.middle_of(self.sheets.sheets[0])


Template: TypeAlias = Callable[[Case], Iterator[Instance]]
"""Yields a question for each object of a work to which it applies."""


def _sheets_of(work: Project | Homework) -> Iterator[NumberedSheet]:
    """Yield the sheets of a work, numbered as one set."""
    if isinstance(work, Project):
        drawings = numbered_set(work, [part_drawings(work, part, {}) for part in work.parts])
        parts: list[PartName | None] = [part.name for part in work.parts]
    else:
        drawings, parts = [work.kind.drawings(work.problem, PlanRequest())], [None]
    number = 0
    for part, some in zip(parts, drawings, strict=True):
        for drawing in some:
            number += 1
            yield NumberedSheet(number, part, drawing)
