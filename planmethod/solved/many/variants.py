"""Variants of a problem as rows of one solution (варианты как строки одного решения).

Variants that are drawn by the same steps differ in their numbers alone: each number is a column,
and one reading of the program has the positions of all of them. Properties of a single variant (its
scales, enlarged views, random sheets) belong to its own solution, whose readings are rows of the
common ones. A variant with a warning is left to be solved alone.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property, partial
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.drafting import Profile
from planmethod.construct.evaluate import evaluate
from planmethod.construct.ruler import RulerArithmetic
from planmethod.errors import PlanMethodError
from planmethod.mechanism.model import Mechanism
from planmethod.mechanism.structure import Structure, analyse
from planmethod.plans.build import Construction, build
from planmethod.plans.model import RATES
from planmethod.problem.model import Problem
from planmethod.solved.assembly_modes import ModeSearch, ReadingRequest, drive_data, search_modes
from planmethod.solved.detail_views import SHORT, SMALL
from planmethod.solved.impossible import failing
from planmethod.solved.reading import Flags, Reading, Reals
from planmethod.solved.selfcheck import changed_branches, flag_rejected
from planmethod.solved.solution import FEW_ROWS, Solution, at_positions, unit_rate_problem
from planmethod.solved.trust.conditioning import WARN_RELATIVE_ERROR


class Batch(Solution):
    """Variants that are drawn by the same steps, each with its rows (варианты одной схемы).

    All values by positions have a row for each position of each variant, in order. They are NaN
    where a step is impossible.

    Parameters
    ----------
    problems : sequence of Problem
    constructions : sequence of Construction
        Of the problems; with the same steps.
    profile : Profile
    """

    def __init__(
        self, problems: Sequence[Problem], constructions: Sequence[Construction], profile: Profile
    ) -> None:
        positions = [place for problem in problems for place in problem.drive.positions]
        first = constructions[0]
        super().__init__(problems[0], positions=positions, profile=profile, construction=first)
        self.problems, self.constructions = problems, constructions
        counts = [len(problem.drive.positions) for problem in problems]
        self.rows = _rows(counts)
        self._counts, self._of = counts, np.repeat(np.arange(len(problems)), counts)

    def some(self, numbers: Sequence[int]) -> Batch:
        """Return a batch of some of the variants, which keep their own readings."""
        chosen = [self.problems[k] for k in numbers], [self.constructions[k] for k in numbers]
        found = Batch(*chosen, self.profile)
        found.solutions = [self.solutions[k] for k in numbers]
        return found

    def _inputs_at(self, chosen: npt.NDArray[np.intp] | slice) -> Mapping[str, Any]:
        """Return the given data of some rows, at unit scales."""
        return at_positions(self._inputs, chosen)

    @cached_property
    def _inputs(self) -> dict[str, Number]:
        each = zip(self.problems, self.constructions, self.rows, strict=True)
        own = [drive_data(p, made.draft, self.positions[rows]) for p, made, rows in each]
        return _columns(own, self._counts)

    def numbers_of(self, plan: Callable[[Construction], Mapping[str, float]]) -> dict[str, Number]:
        """Return the known numbers of the continued constructions, in every row."""
        return _columns([plan(made) for made in self.constructions], self._counts)

    def length(self, link: str, p: str, q: str) -> Reals:
        """Return the given distance of two points of a link in every row, m."""
        bodies = [problem.bodies[link].points for problem in self.problems]
        return np.repeat([abs(points[q] - points[p]) for points in bodies], self._counts)

    def variant_at(self, index: int) -> tuple[Solution, int]:
        """Return the solution of the variant that a row is of, and its position there."""
        k = int(self._of[index])
        return self.solutions[k], index - self.rows[k].start

    def at_unit_rate(self) -> Solution:
        """Return the same mechanisms, their drivers at one radian (or metre) a second."""
        problems, constructions = (
            [unit_rate_problem(problem) for problem in self.problems],
            self.constructions,
        )
        if self.problem.drive.acceleration:
            each = zip(problems, constructions, strict=True)
            constructions = [build(p, made.structure, made.draft.choice) for p, made in each]
        return Batch(problems, constructions, self.profile)

    # Readings --------------------------------------------------------------------------------

    @property
    def max_positions(self) -> int:
        """Largest number of positions of a variant."""
        return max(self._counts)

    @cached_property
    def si(self) -> Reading:
        """Exact reading at unit scales; NaN where a step is impossible."""
        return self.read(Float64())

    @cached_property
    def clean_variants(self) -> Flags:
        """Flags of the variants that are solved without any warning; shape (variants,)."""
        rows = failing(self.construction.program, self.si.trace, self.si.count) < 0
        rows &= ~flag_rejected(self)
        told = np.array([bool(rows[own].all()) for own in self.rows])
        for k in np.flatnonzero(told & (np.array(self._counts) > 1)):
            told[k] = not changed_branches(self.solutions[k])
        return told

    @property
    def kinds(self) -> list[tuple[object, ...] | None]:
        """Kinds of loads of the variants: those of one kind are planned in the same way.

        None for a variant that is not solved, or that has a warning.
        """
        good = self.clean_variants
        if self.problem.dynamics is None or not good.all():
            return [() if told else None for told in good.tolist()]
        kinds = [_loads_kind(one) for one, _ in self.parts]
        if len(set(kinds)) == 1 and kinds[0] is not None:
            from planmethod.solved.forces.statics import statics_of

            certain = statics_of(self).closes & (statics_of(self).bound <= WARN_RELATIVE_ERROR)
            return [kinds[0] if certain[own].all() else None for own in self.rows]
        return kinds

    @cached_property
    def solutions(self) -> list[Solution]:
        """Every variant's own solution: its exact reading is its rows of this one."""
        found = []
        for problem, made, own in zip(self.problems, self.constructions, self.rows, strict=True):
            one = Solution(problem, profile=self.profile, construction=made)
            one.si = self.si.part(own)
            one.extents = self.extents.part(made, one.si, own)
            found.append(one)
        return found

    @cached_property
    def parts(self) -> Sequence[tuple[Solution, slice]]:
        """Every variant's own solution, with its readings, and its rows."""
        for one, own in zip(self.solutions, self.rows, strict=True):
            one.paper = self.paper.part(own)
        return tuple(zip(self.solutions, self.rows, strict=True))

    @cached_property
    def per_mm(self) -> dict[str, Number]:
        """Unit per millimetre of each plan in every row, by its name in the program."""
        return _columns([one.per_mm for one in self.solutions], self._counts)

    @cached_property
    def ruler_arithmetic(self) -> RulerArithmetic:
        """Draughtsman with a ruler: in every row short segments are read as in its variant."""
        enlargements: dict[str, Number] = {}
        for k in np.flatnonzero(self._short):
            one, own = self.solutions[k], self.rows[k]
            one.paper = self.paper.part(own)
            for name, times in one.ruler_arithmetic.enlargements.items():
                enlargements.setdefault(name, np.ones(len(self.positions)))[own] = times
        return RulerArithmetic(self.profile.ruler, enlargements)

    @property
    def _short(self) -> Flags:
        """Flags of the variants that may need enlarged views, by an estimate; shape (variants,)."""
        found = np.zeros(len(self.positions), dtype=bool)
        for kind in RATES:
            ends = [(v.tail, v.head) for v in self.construction.plan(kind).vectors]
            for tail, head in ends:
                found |= np.abs(self.paper.point(head) - self.paper.point(tail)) < max(SHORT, SMALL)
        return np.array([bool(found[own].any()) for own in self.rows])


def in_batches(problems: Sequence[Problem], profile: Profile) -> list[tuple[Batch, list[int]]]:
    """Return batches of variants that are drawn by the same steps, and their indices.

    Variants with warnings and variants unlike all others are in none of them: each must be solved
    alone.
    """
    plain = [k for k, problem in enumerate(problems) if _is_basic(problem)]
    made = dict(zip(plain, constructed([problems[k] for k in plain]), strict=True))
    alike: dict[tuple[Any, ...], list[int]] = {}
    for k, construction in made.items():
        if construction is not None and construction.draft.origin == 0:
            alike.setdefault(_kind(problems[k], construction), []).append(k)
    found: list[tuple[Batch, list[int]]] = []
    for members in alike.values():
        waiting = [members]
        while waiting:
            kept = waiting.pop()
            if len(kept) < 2:
                continue
            chosen = [made[k] for k in kept]
            batch = Batch([problems[k] for k in kept], [c for c in chosen if c], profile)
            kinds = batch.kinds
            parts = [
                [k for k, own in zip(kept, kinds, strict=True) if own == kind]
                for kind in dict.fromkeys(kinds)
                if kind is not None
            ]
            if parts == [kept]:
                found.append((batch, kept))
            else:
                waiting += parts[::-1]
    return found


def _is_basic(problem: Problem) -> bool:
    """Return whether a problem consists only of plans of a few positions."""
    more = (problem.cycle, problem.machine, problem.balancing, problem.project)
    rubs = problem.dynamics is not None and problem.dynamics.friction is not None
    whole = not rubs and not any(part is not None for part in more)
    return whole and len(problem.drive.positions) <= FEW_ROWS


def _kind(problem: Problem, construction: Construction) -> tuple[Any, ...]:
    """Return the key that problems with the same steps and names have in common."""
    bodies = tuple((link, tuple(body.points)) for link, body in problem.bodies.items())
    draft = construction.draft
    given = tuple(draft.numbers), tuple(draft.places), tuple(draft.branches)
    rates = problem.drive.rate == 0, problem.drive.acceleration == 0
    several = len(problem.drive.positions) > 1
    kind = construction.program.steps, bodies, given, construction.segments, rates, several
    dynamics = problem.dynamics
    if dynamics is None:
        return kind
    # Guides and bearings are looked up by number; a force pushes along its own line.
    shared = tuple(problem.slides.items()), tuple(dynamics.bearings.items()), problem.drive.pushed
    return (*kind, tuple(dynamics.masses), dynamics.resultant, shared)


def _loads_kind(solution: Solution) -> tuple[object, ...] | None:
    from planmethod.solved.forces.statics import loads_on

    try:
        return solution.compute_once(loads_on).kind
    except PlanMethodError:
        return None  # it says why when it is solved alone


def constructed(problems: Sequence[Problem]) -> list[Construction | None]:
    """Return the constructions of problems, None where there is none.

    Their assembly modes are chosen together: programs with the same steps are read at once.
    """
    found: list[Construction | None] = [None] * len(problems)
    structures: dict[Mechanism, Structure] = {}
    choosing_of: dict[int, ModeSearch] = {}
    wanted: dict[int, ReadingRequest] = {}

    def advance(k: int, step: Callable[[], ReadingRequest]) -> None:
        """Advance one problem to its next reading request, or to its end."""
        wanted.pop(k, None)
        problem = problems[k]
        try:
            wanted[k] = step()
        except StopIteration as end:
            found[k] = build(problem, structures[problem.mechanism], end.value)
        except PlanMethodError:
            return  # it says why when it is solved alone

    for k, problem in enumerate(problems):
        mechanism = problem.mechanism
        try:
            if mechanism not in structures:
                structures[mechanism] = analyse(mechanism)
        except PlanMethodError:
            continue
        choosing_of[k] = search_modes(problem, structures[mechanism])
        advance(k, partial(next, choosing_of[k]))
    while wanted:
        for k, reading in _read_requests(wanted):
            advance(k, partial(choosing_of[k].send, reading))
    return found


def _read_requests(requests: Mapping[int, ReadingRequest]) -> list[tuple[int, Reading]]:
    """Return the requested readings, by the index of their problem."""
    alike: dict[tuple[Any, ...], list[int]] = {}
    for k, one in requests.items():
        alike.setdefault((tuple(one.draft.b.steps), tuple(one.draft.numbers)), []).append(k)
    found = []
    for members in alike.values():
        asked = [requests[k] for k in members]
        counts = [len(one.positions) for one in asked]
        own = [drive_data(one.draft.problem, one.draft, one.positions) for one in asked]
        trace = evaluate(asked[0].program, _columns(own, counts), Float64())
        whole = Reading(trace, sum(counts))
        found += [(k, whole.part(own)) for k, own in zip(members, _rows(counts), strict=True)]
    return found


def _rows(counts: Sequence[int]) -> list[slice]:
    """Return the rows of each variant, given their numbers of positions, in order."""
    return [slice(start, end) for start, end in pairwise(np.cumsum([0, *counts]).tolist())]


def _columns(mappings: Sequence[Mapping[str, Number]], counts: Sequence[int]) -> dict[str, Number]:
    """Return numbers of variants as columns with a row for each of their positions."""
    found: dict[str, Number] = {}
    for name in mappings[0]:
        values = [one[name] for one in mappings]
        if any(np.ndim(value) for value in values):
            pairs = zip(values, counts, strict=True)
            found[name] = np.concatenate([np.broadcast_to(v, (n,)) for v, n in pairs])
        else:
            found[name] = np.repeat(values, counts)
    return found
