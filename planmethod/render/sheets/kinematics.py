"""Sheet of the kinematic analysis: scheme, velocity and acceleration plans, equations, tables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, product
from math import inf
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import number_of, numbers, of_type, text, texts
from planmethod.construct.drafting import PROFILES, Profile
from planmethod.construct.scale import next_scale
from planmethod.errors import ArgumentError, LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.note.wording import Language, get_language
from planmethod.paper import paper_format
from planmethod.plans.model import FACTS, MOTION, RATES, PlanKind
from planmethod.problem.model import Problem, Scales
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Drawing
from planmethod.render.layout.pack import largest_hole
from planmethod.render.pictures.paths import Paths
from planmethod.render.sheets.blocks import OF_CYCLE, OF_POSITIONS, has_forces
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    PageLayout,
    SheetLayout,
    TrialPaper,
    compose,
    find_layout,
    free_area,
    grow_scales,
)
from planmethod.render.sheets.composition import composition
from planmethod.render.sheets.compositions import SHIPPED
from planmethod.render.sheets.model import BlockOptions, Composition
from planmethod.render.sheets.pages import PageTrial
from planmethod.solved.extents import smallest_plan
from planmethod.solved.legibility import FEW, is_too_dense
from planmethod.solved.scaling import MAX_DRAWN, PLAN
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution
from planmethod.solved.turn.extremes import counting, numbered_positions
from planmethod.solved.view_space import Views

STEPS = 3
"""Largest number of members of the series by which a scale is changed."""

SMALLER = ((0.8, 1.0), (0.65, 1.0), (0.65, 0.8), (0.5, 0.8))
"""Parts of the boxes for plans and scheme, tried before plans are left out of a sheet of one
position."""

FOR_TEXTS = "A1"
"""Largest format that is taken for texts of one position that would be left out otherwise."""

EMPTY = 0.12
"""Part of the field of a hole for which no larger paper is taken."""

MAX_SHEETS = 1_000_000
"""Largest limit of sheets."""

MIN_CHOSEN = 4
"""Least number of positions of a turn from which plans are chosen."""

KEYS = [FACTS[kind].scale for kind in reversed(MOTION)]
"""Keys of the scales, the plan that is to be largest first."""


def kinematics_sheets(
    problem: Problem,
    *,
    paper: str | None = None,
    positions: npt.ArrayLike | None = None,
    ruler: float | None = None,
    profile: Profile | str = PROFILES["board"],
    fields: Mapping[str, str] | None = None,
    furniture: Furniture | None = None,
    errors: bool = False,
    sigma: bool | None = None,
    layout: str | Path | Composition | None = None,
    most: int | None = None,
    asked: Sequence[str] = (),
    advised: bool = True,
) -> list[Drawing]:
    """Draw the kinematic analysis in the language of ``problem.sheet``, a dozen positions a sheet.

    Parameters
    ----------
    paper : str, optional
        Format. Default: the file's, or the smallest that the blocks fit.
    positions : array_like of shape (n,), optional
        Other driver positions than the file's.
    ruler : float, mm, optional
        Step of the ruler with which the plans are read. Default: the profile's.
    profile : Profile or str
        Drafting accuracy of the plans.
    fields : mapping, optional
        Texts of the title block that outrank the file's.
    furniture : Furniture, optional
        Form of the title block and additional graphs. Default: the file's.
    errors : bool
        Draw the ellipses of the drafting error around the points of scheme and plans.
    sigma : bool, optional
        Show the drafting errors of the results in their tables; None: only for a single position.
    layout : str, Path or Composition, optional
        Contents of the sheets: the name of a shipped composition or a file. Default: by the number
        of positions, from ``one-position`` to ``many-positions``.
    most : int, optional
        Largest number of sheets. Default: no limit.
    asked : sequence of str
        Labels of quantities for the composition's block of graphs. Default: those of the block or
        of ``[cycle]``.
    advised : bool
        On failure, try larger papers so that the error names one that fits.

    Raises
    ------
    ArgumentError
        An argument has a wrong type or value.
    UnknownQuantityError
        There is no such quantity.
    LayoutError
        When the blocks fit no format, or not the requested one, or need more than ``most`` sheets.
    CompositionError
        When the composition is faulty.

    Examples
    --------
    >>> import planmethod
    >>> from planmethod.render.backends import render
    >>> (sheet,) = planmethod.draw(planmethod.load("problems/linkages/ex3.toml"), paper="A2")
    >>> sheet.width, sheet.height
    (594, 420)
    >>> render(sheet, "pdf")[:5]
    b'%PDF-'
    """
    problem = of_type("problem", problem, Problem, "planmethod.load()")
    if positions is not None and not len(numbers("positions", positions)):
        raise ArgumentError("positions: expected at least one, got [].")
    if paper is not None:
        text("paper", paper)
    if fields is not None:
        texts("fields", [*of_type("fields", fields, Mapping), *fields.values()])
    if furniture is not None:
        of_type("furniture", furniture, Furniture)
    if layout is not None and not isinstance(layout, str | Path):
        of_type("layout", layout, Composition)
    if most is not None:
        number_of("most", most, MAX_SHEETS)
    asked = texts("asked", asked)
    if paper:
        problem = replace(problem, sheet=replace(problem.sheet, paper=paper_format(paper).name))
    problem = _counted(problem, layout, positions)
    solution = Solution(problem, positions=positions, ruler=ruler, profile=profile)
    moved = positions is not None
    language = get_language(problem.sheet.lang or LANGUAGES[0])
    options = BlockOptions(language, errors, sigma, quantities=tuple(asked))
    strategy = _strategy(solution, layout, options, has_own_positions=moved, max_sheets=most)

    def fits_paper(name: str) -> bool:
        other = replace(problem, sheet=replace(problem.sheet, paper=name))
        tried = Solution(other, positions=positions, ruler=ruler, profile=profile)
        again = _strategy(tried, layout, options, has_own_positions=moved)
        try:
            find_layout(other, again, _no_fit_advice(other), furniture or Furniture.of(other.sheet))
        except LayoutError:
            return False
        return True

    misfit = replace(_no_fit_advice(problem), fits_paper=fits_paper if advised else None)
    if problem.sheet.colour is None and strategy.layout.colour:
        problem = replace(problem, sheet=replace(problem.sheet, colour=True))
    drawings = compose(problem, strategy, misfit, fields=fields, furniture=furniture)
    _reject_too_many(strategy.solution, len(drawings), most)
    return drawings


def sheet_scales(
    problem: Problem,
    layout: str | Path | Composition | None = None,
    positions: npt.ArrayLike | None = None,
) -> Scales:
    """Return the decided scales of a mechanism in a layout (масштабы листа).

    Every output of a problem with them keeps to them. Parameters and errors are those of
    `kinematics_sheets`.
    """
    problem = _counted(problem, layout, positions)
    solution = Solution(problem, positions=positions)
    options = BlockOptions(get_language(problem.sheet.lang or LANGUAGES[0]))
    strategy = _strategy(solution, layout, options, has_own_positions=positions is not None)
    furniture = Furniture.of(problem.sheet)
    _, laid = find_layout(problem, strategy, _no_fit_advice(problem), furniture)
    taken: dict[str, Any] = dict(laid.scales)
    return replace(problem.scales, **taken, decided=True)


def _counted(
    problem: Problem, layout: str | Path | Composition | None, positions: npt.ArrayLike | None
) -> Problem:
    """Return a problem with one numbering of positions for all blocks of a layout.

    Raises
    ------
    LayoutError
        Some blocks number positions of the cycle, others the requested ones.
    """
    if layout is None or not problem.drive.goes_round:
        return problem
    lang = problem.sheet.lang or LANGUAGES[0]
    made = composition(layout, lang) if isinstance(layout, str | Path) else layout
    kinds = {entry.kind for entry in made.blocks}
    if kinds.isdisjoint(OF_CYCLE) or kinds.isdisjoint(OF_POSITIONS):
        return problem
    if positions is None and made.cycle:
        return problem
    shown: Sequence[float] = problem.drive.positions
    if positions is not None:
        shown = np.ravel(np.asarray(positions, dtype=float)).tolist()
    return counting(problem, shown) if len(shown) > 1 else problem


def _strategy(
    solution: Solution,
    layout: str | Path | Composition | None,
    options: BlockOptions,
    *,
    has_own_positions: bool,
    max_sheets: int | None = None,
) -> Linkage:
    """Return the search strategy of a layout's sheets.

    ``has_own_positions`` means that positions were requested.
    """
    language = options.language
    made = composition(layout, language.lang) if isinstance(layout, str | Path) else layout
    if not has_own_positions and made is not None and made.cycle:
        solution = _over_the_cycle(solution)
    made = made or _usual(len(solution.positions), language)
    made = made.without(sheets_without_forces(made, solution.problem))
    _check_positions(made, solution)
    calculated = solution.problem.calculated
    if calculated is not None and made.per_sheet == (1,):
        solution = solution.in_position(calculated)
    count = len(solution.positions)
    least = len(made.sheets) * -(-count // made.list_per_sheet(count)[0])
    _reject_too_many(solution, least, max_sheets)  # before the work, if already known
    verify(solution)
    return Linkage(made, solution, replace(options, turn=made.turn))


def sheets_without_forces(layout: Composition, problem: Problem) -> list[int]:
    """Return the numbers of the sheets of forces, if a problem has none and others remain."""
    if problem.dynamics is not None:
        return []
    others = {entry.sheet for entry in layout.blocks if not has_forces(entry.kind)}
    return [number for number in layout.sheets if number not in others] if others else []


def _no_fit_advice(problem: Problem) -> NoFitAdvice:
    return NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the views do not fit {}. {}", problem.name, paper, advice
        ),
        translate("Request fewer positions (--phi), or remove blocks from the layout."),
        None if problem.scales.decided else problem.scales,
    )


def _reject_too_many(solution: Solution, sheets: int, max_sheets: int | None) -> None:
    """Reject more sheets than were probably intended; those of one position are always made."""
    count = len(solution.positions)
    if max_sheets is not None and sheets > max_sheets and count > 1:
        raise LayoutError(
            "{0}: {1} position{1:||s} take {2} sheet{2:||s}. Select positions (--phi "
            "{3:g}), or pass --all-positions to draw them all.",
            solution.problem.name,
            count,
            sheets,
            solution.problem.drive.positions[0],
        )


def _over_the_cycle(solution: Solution) -> Solution:
    """Return the solution at the numbered positions of the cycle; a slider keeps the file's.

    Raises
    ------
    ProblemError
        No link can be the output.
    PositionError
        One of these positions does not exist.
    """
    if not solution.problem.drive.goes_round:
        return solution
    solution = solution.with_positions(numbered_positions(solution).tolist())
    verify(solution)  # besides a calculated position the diagrams need all others
    return solution


def _usual(count: int, language: Language) -> Composition:
    """Return the shipped composition for ``count`` positions."""
    return composition(SHIPPED[(count > 1) + (count > FEW)], language.lang)


def _check_positions(layout: Composition, solution: Solution) -> None:
    count = len(solution.positions)
    if count > MAX_DRAWN:
        raise LayoutError(
            "{}: sheets are drawn for at most {} positions, {} are requested. Request fewer "
            "(--phi 0:360:30); for tables use solve --csv.",
            solution.problem.name,
            MAX_DRAWN,
            count,
        )
    calculated = solution.problem.calculated
    if calculated is not None and calculated >= count:
        raise LayoutError(
            "{}: the position to be calculated, {}, does not exist. The last of {} "
            "positions is {}.",
            solution.problem.name,
            calculated,
            count,
            count - 1,
        )
    for number, entry in enumerate(layout.blocks):
        named = [*entry.positions, *([] if entry.position is None else [entry.position])]
        if named and max(named) >= count:
            raise LayoutError(
                "{}: blocks[{}].position is {}, but the last of {} positions is {}. Name "
                "one of them, or request more with --phi.",
                layout.name,
                number,
                max(named),
                count,
                count - 1,
            )


class Linkage(Struct, frozen=True):
    """Search strategy for the sheets of a linkage: scales and numbers of positions on a sheet.

    The views of ``solution`` are the first guess.
    """

    layout: Composition
    solution: Solution
    options: BlockOptions

    @property
    def views(self) -> Views:
        """Views on the format that sheets are tried on first."""
        layout, count = self.layout, len(self.solution.positions)
        views = self.solution.views
        estimated = views.paper in layout.formats and any(entry.of for entry in layout.blocks)
        if not self.solution.problem.sheet.paper and not estimated:  # for schemes and plans
            views = Views.for_paper(layout.formats[0], count)
        return layout.views_for(views.paper, count)

    @property
    def formats(self) -> Sequence[str]:
        """Formats of the composition, from the estimated one on unless one is requested.

        Smaller ones come first, unless scales are decided, which are for the others.
        """
        formats = self.layout.formats
        if self.solution.problem.sheet.paper:
            return formats
        return (*self.smaller, *formats[formats.index(self.views.paper) :])

    @property
    def smaller(self) -> Sequence[str]:
        """Formats that are taken only if all blocks are on them, unless scales are decided.

        If the file has all scales of one position, such is the format before the estimated one.
        """
        layout, given = self.layout, self.solution.given_scales
        if given.decided or layout.smaller or not layout.is_estimated:
            return () if given.decided else layout.smaller
        several = len(self.solution.positions) > 1
        if several or any(getattr(given, key) is None for key in KEYS):
            return ()
        number = layout.formats.index(self.views.paper)
        return layout.formats[max(number - 1, 0) : number]

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[LinkageProposal]:
        """Yield scales and numbers of positions on a sheet, paper by paper.

        The estimated scales stay on a larger paper if the smaller one turns out not to fit. If a
        composition has views of its own, each paper then has its own scales, and finally those of
        the file are dropped: scales for one position may be too fine for a turn.
        """
        problem, count = self.solution.problem, len(self.solution.positions)
        own: tuple[Views | None, Scales] = (None, problem.scales)
        free = (None, problem.scales.freed)
        views = self.views
        turns = [[own if views.fixed else (views, self.solution.given_scales)]]
        given = free != own
        if given and self.layout.turn:
            turns[0].append(free)
        if not (self.layout.is_estimated or problem.scales.decided):
            turns += [[own], [free] if given and not self._uses_file_positions else []]
        numbers = self.layout.list_per_sheet(count)
        for paper, (keeps_groups, share), per_sheet, (boxes, scales) in chain(
            *(
                product([paper], self._trials_on(paper), numbers, some)
                for some in turns
                for paper in papers
            )
        ):
            boxes = boxes or self.layout.views_for(paper.name, count, share)
            yield LinkageProposal(self, paper, share, per_sheet, boxes, scales, keeps_groups)

    def _trials_on(self, paper: TrialPaper) -> Sequence[tuple[bool, float]]:
        """Return the trials of the composition: on a smaller paper only the first one."""
        trials = self.layout.trials
        if paper.is_required or paper.name not in self.layout.smaller:
            return trials
        return trials[:1]

    @property
    def _uses_file_positions(self) -> bool:
        """True if the positions are those of the file."""
        return tuple(self.solution.positions.tolist()) == self.solution.problem.drive.positions

    def solved(self, views: Views, scales: Scales) -> Solution:
        """Return the solution whose plans fill given views, at given scales."""
        one = self.solution
        if (one.views, one.given_scales) == (views, scales):
            return one
        return one.compute_once(Solution.filling, views, scales)


class LinkageProposal(Struct, frozen=True):
    """Sheets of a linkage on a paper, ``per_sheet`` positions on each (`Proposal`)."""

    of: Linkage
    paper: TrialPaper
    size_fraction: float
    per_sheet: int
    views: Views
    scales: Scales
    keeps_groups: bool = False

    def arrange(self) -> SheetLayout | None:
        """Return the sheets, enlarged as far as they fit if the composition permits.

        If texts of one position would be on none of them, a larger paper is taken for all.
        """
        laid = self._arrange_on_paper()
        lacks = laid is not None and len(self.of.solution.positions) == 1 and _lacks_texts(laid)
        if not lacks or self.paper.is_required or not self.of.layout.is_estimated:
            return laid
        return self._arrange_on_larger() or laid

    def _arrange_on_larger(self) -> SheetLayout | None:
        """Return the sheets on the smallest larger paper that has all blocks, or None.

        Not on paper on which they leave a hole that is `EMPTY`.
        """
        formats = self.of.layout.formats
        if FOR_TEXTS not in formats or self.paper.name not in formats:
            return None
        for name in formats[formats.index(self.paper.name) + 1 : formats.index(FOR_TEXTS) + 1]:
            paper = replace(self.paper, format=paper_format(name))
            views = self.of.layout.views_for(name, len(self.of.solution.positions))
            larger = replace(self, paper=paper, views=views)
            with paper.using_pens():
                laid = larger._arrange_on_paper()
            if laid is None or _has_omissions(laid):
                continue
            (page,) = laid.pages
            if largest_hole(page.placed, paper.drawing_area()) <= EMPTY:
                return replace(laid, paper=paper)
        return None

    def _arrange_on_paper(self) -> SheetLayout | None:
        """Return the sheets on the paper, or None where the blocks have no room."""
        of, extras = self.of, self.of.options
        solution = of.solved(self.views, self.scales)
        laid = self._arrange_at(solution, extras)
        if laid is None or (self._is_smaller and _has_omissions(laid)):
            return None
        if extras.traces and len(solution.positions) == 1 and _has_omissions(laid):
            # The traces of the construction must not displace the texts that explain it.
            bare = replace(extras, traces=False)
            without = self._arrange_at(solution, bare)
            if without is not None and not _has_omissions(without):
                laid, extras = without, bare
        views = self.views
        if len(solution.positions) == 1 and _has_omissions(laid):
            kinds = self._kinds_beside_omissions(laid)
            tried = [[solution.scales[kind].per_mm for kind in kinds]]
            for smaller in self._with_smaller_plans():
                again = of.solved(smaller, self.scales)
                scales = [again.scales[kind].per_mm for kind in kinds]
                if scales in tried:  # the texts have the same room as before
                    continue
                tried.append(scales)
                whole = self._arrange_at(again, extras)
                if whole is not None and not _has_omissions(whole):
                    laid, solution, views = whole, again, smaller
                    break
        drawn = {scale.symbol: scale.per_mm for scale in solution.scales.values()}
        shown = {PlanKind.POSITION, *(entry.of for entry in of.layout.blocks if entry.of)}
        keys = {FACTS[kind].scale for kind in shown}
        free = [key for key in KEYS if key in keys and getattr(self.scales, key) is None]
        if of.layout.grow and free:
            laid = replace(laid, scales={key: drawn[key] for key in free})
            laid = self._with_legible_plans(laid, extras, views)
            laid = grow_scales(
                laid,
                free * STEPS,
                self.scales,
                lambda scales: self._at(scales, extras, views),
                # Rows of plans of several positions have other sizes than one plan enlarged.
                free_area(self.paper.drawing_area()) if len(solution.positions) == 1 else inf,
            )
        laid = replace(laid, scales={**drawn, **laid.scales})
        if self._is_smaller and self._has_dense_letters(laid):
            return None
        return self._with_plans(laid, extras)

    def _at(
        self, scales: Mapping[str, float], options: BlockOptions, views: Views
    ) -> SheetLayout | None:
        """Return the sheets at given scales, or None when one does not fit."""
        wish: dict[str, Any] = dict(scales)
        return self._arrange_at(self.of.solved(views, replace(self.scales, **wish)), options)

    def _with_legible_plans(
        self, layout: SheetLayout, options: BlockOptions, views: Views
    ) -> SheetLayout:
        """Return the sheets with plans that are too small at finer scales, if these fit.

        The texts beside such a plan of one position move to a continuation sheet for it.
        """
        one = self.of.solution
        for kind in RATES if len(one.positions) == 1 else ():
            key = FACTS[kind].scale
            least = smallest_plan(one.construction, one.si, kind)
            while key in layout.scales and 0.0 < least < PLAN * layout.scales[key]:
                finer = next_scale(
                    layout.scales[key], finer=True, mm_per_unit=self.scales.in_mm_per_unit
                )
                wish = {**layout.scales, key: finer}
                tried = self._at(wish, options, views)
                if tried is None or _lacks_texts(tried):
                    break
                layout = replace(tried, scales=wish)
        return layout

    def _with_plans(self, layout: SheetLayout, options: BlockOptions) -> SheetLayout:
        """Return the sheets with the plans of as many positions of a turn as fit.

        If the file names none: plans of all positions, of every second, or of every third, also at
        a coarser scale, as long as no plan of the turn becomes too small.
        """
        kinds = [
            entry.of
            for entry in self.of.layout.blocks
            if entry.kind == "chosen-plans" and entry.of and not entry.positions
        ]
        solution = self.of.solution
        count = len(solution.positions) // solution.repeated
        if not kinds or count < MIN_CHOSEN:
            return layout
        key, wishes = FACTS[kinds[0]].scale, [dict(layout.scales)]
        least = smallest_plan(solution.construction, solution.si, kinds[0])
        while getattr(self.scales, key) is None and len(wishes) <= STEPS:
            coarser = next_scale(
                wishes[-1][key], finer=False, mm_per_unit=self.scales.in_mm_per_unit
            )
            if least < PLAN * coarser:
                break
            wishes.append({**wishes[-1], key: coarser})
        for part, wish in product((1, 2, 3), wishes):
            tried = self._at(wish, replace(options, plans=count // part), self.views)
            if tried is not None and tried.is_no_worse_than(layout):
                return replace(tried, scales=wish)
        return layout

    def _kinds_beside_omissions(self, layout: SheetLayout) -> list[PlanKind]:
        """Return the kinds of plans on the sheets on which blocks were left out, and the scheme."""
        composition = self.of.layout
        whole = [page for page in layout.pages if not page.is_continuation]
        numbers = {
            number
            for number, page in zip(composition.sheets, whole, strict=False)
            if page.concessions[0] or len(whole) != len(composition.sheets)
        }
        here = {entry.of for entry in composition.blocks if entry.sheet in numbers}
        return [kind for kind in MOTION if kind in (PlanKind.POSITION, *here)]

    def _with_smaller_plans(self) -> Iterator[Views]:
        """Yield the views with smaller boxes for the plans that would be left out otherwise."""
        left_out = [
            entry.of
            for entry in self.of.layout.blocks
            if entry.droppable and entry.of and getattr(self.scales, FACTS[entry.of].scale) is None
        ]
        for of_plans, of_scheme in SMALLER if left_out else ():
            parts = dict.fromkeys(left_out, of_plans)
            if of_scheme < 1.0 and self.scales.mu_l is None:
                parts[PlanKind.POSITION] = of_scheme
            less: dict[str, Any] = {
                kind.value: tuple(part * side for side in getattr(self.views, kind.value))
                for kind, part in parts.items()
            }
            yield replace(self.views, fixed=self.views.fixed | {*parts}, **less)

    @property
    def _is_smaller(self) -> bool:
        """True if the paper is taken only when no blocks or letters of positions are left out."""
        return not self.paper.is_required and self.paper.name in self.of.smaller

    def _has_dense_letters(self, layout: SheetLayout) -> bool:
        """Return whether a scheme of many positions has too many letters for its area."""
        one = self.of.solution
        if len(one.positions) <= FEW or all(e.kind != "scheme" for e in self.of.layout.blocks):
            return False
        apart, positions = one.problem.drive.coordinate.distance, one.positions.tolist()
        # An extreme position that is also a drawn one shares its letters.
        more = sum(min(apart(p, end) for p in positions) > 1e-6 for end in Paths(one).extremes)
        per_mm = layout.scales[FACTS[PlanKind.POSITION].scale]
        return is_too_dense(one.construction, one.si, per_mm, more)

    def _arrange_at(self, solution: Solution, options: BlockOptions) -> SheetLayout | None:
        """Return the sheets at the scales of a solution, or None when one does not fit."""
        count, pages = len(solution.positions), list[PageLayout]()
        trial = PageTrial(
            self.of.layout, self.paper, options, self.size_fraction, self.keeps_groups
        )
        for start in range(0, count, self.per_sheet):
            indices, first = range(start, min(start + self.per_sheet, count)), len(pages) + 1
            found = trial.pages(solution, indices, first)
            if found is None:
                return None
            pages += found
        return SheetLayout(pages)


def _has_omissions(layout: SheetLayout) -> bool:
    """Return whether blocks were left out."""
    return any(page.concessions[0] for page in layout.pages)


def _lacks_texts(layout: SheetLayout) -> bool:
    """Return whether blocks were left out that are on no continuation sheet, either."""
    return _has_omissions(layout) and not any(page.is_continuation for page in layout.pages)
