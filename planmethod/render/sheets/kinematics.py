"""Sheet of the kinematic analysis: scheme, velocity and acceleration plans, equations, tables."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import chain, product
from pathlib import Path

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.drafting import PROFILES, Profile
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, say
from planmethod.note.wording import language
from planmethod.paper import Format
from planmethod.problem.model import Problem, Scales
from planmethod.render.frame.frame import paper_format, sheet_frame
from planmethod.render.frame.furniture import Furniture, Room
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.lettering import lettering, using
from planmethod.render.sheets.composition.reader import composition
from planmethod.render.sheets.compositions import SHIPPED
from planmethod.render.sheets.growth import grown
from planmethod.render.sheets.model import Composition, Extras
from planmethod.render.sheets.pages import Page, Paper, pages_of, stamp_fields
from planmethod.solved.room import FEW
from planmethod.solved.scaling import MOST_DRAWN, Views
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution


class _Task(Struct, frozen=True):
    """What is drawn, whatever the paper; ``views`` fill the paper's own boxes when absent.

    ``estimated`` is the solution whose views were the first guess.
    """

    problem: Problem
    layout: Composition
    positions: tuple[float, ...]
    ruler: float | None
    profile: Profile
    extras: Extras
    views: Views | None = None
    estimated: Solution | None = None

    def solved(self, views: Views | None, scales: Scales) -> Solution:
        """Return the solution for the views of a paper, with certain scales."""
        # Without views told the estimate keeps to scales of the file in all of several positions.
        keeps = len(self.positions) > 1 and scales != Scales(scales.convention)
        known = None if keeps else self.estimated
        if known is not None and (known.views, known.problem.scales) == (views, scales):
            return known
        solution = Solution(
            replace(self.problem, scales=scales),
            positions=self.positions,
            ruler=self.ruler,
            profile=self.profile,
            views=views,
        )
        verify(solution)
        return solution

    def pages(self, solution: Solution, paper: Paper, per_sheet: int) -> list[Page] | None:
        """Return the sheets with so many positions on each, or None when one does not fit."""
        count = len(self.positions)
        pages: list[Page] = []
        for start in range(0, count, per_sheet):
            indices = range(start, min(start + per_sheet, count))
            found = pages_of(
                self.layout, solution, indices, paper, self.extras, first=len(pages) + 1
            )
            if found is None:
                return None
            pages += found
        return pages

    def on(self, paper: Paper, per_sheet: int) -> list[Page] | None:
        """Return the sheets on a paper with so many positions on each, or None."""
        views = self.views
        if views is None:
            views = self.layout.views_for(paper.name, len(self.positions), paper.share)
        asked = self.problem.scales
        solution = self.solved(views, asked)
        pages = self.pages(solution, paper, per_sheet)
        traced = self.extras.traces and len(self.positions) == 1
        if pages is not None and traced and any(page.tried[0] for page in pages):
            # The traces of the construction are not to push out what explains it.
            without = replace(self, extras=replace(self.extras, traces=False))
            bare = without.pages(solution, paper, per_sheet)
            if bare is not None and not any(page.tried[0] for page in bare):
                return without.on(paper, per_sheet)
        if pages is not None and self.layout.grow:

            def draw(scales: Scales) -> list[Page] | None:
                return self.pages(self.solved(views, scales), paper, per_sheet)

            return grown(pages, solution.scales, asked, draw)
        return pages


def _drawn(
    problem: Problem,
    pages: Sequence[Page],
    fmt: Format,
    fields: Mapping[str, str],
    furniture: Furniture,
) -> list[Drawing]:
    """Return pages as drawings, with frame and title block."""
    sheets = []
    for number, page in enumerate(pages, 1):
        numbers = furniture.numbers(number, len(pages))
        told = stamp_fields(problem, numbers, fields, page.title)
        own, around = paper_format(page.paper or fmt.name), furniture
        if page.paper:
            around = replace(furniture, form="2a")
        drawing = Drawing(own.width, own.height, told.get("title", problem.title))
        drawing.extend(sheet_frame(own, told, around, sheet=number).items)
        drawing.extend(page.items)
        drawing.views.extend(page.views)
        drawing.is_cut_down, *_ = page.tried
        drawing.goes_on = bool(page.paper)
        sheets.append(drawing)
    return sheets


def kinematics_sheets(
    problem: Problem,
    *,
    paper: str | None = None,
    positions: Sequence[float] | None = None,
    ruler: float | None = None,
    profile: Profile = PROFILES["board"],
    fields: Mapping[str, str] | None = None,
    furniture: Furniture | None = None,
    errors: bool = False,
    sigma: bool | None = None,
    layout: str | Path | Composition | None = None,
) -> list[Drawing]:
    """Draw the kinematic analysis in the language of ``problem.sheet``, a dozen positions a sheet.

    Parameters
    ----------
    paper : str, optional
        Format; the file's when absent, or the smallest that the blocks fit.
    positions : sequence of float, optional
        Other driver positions than the file's.
    ruler : float, mm, optional
        Step of the ruler with which the plans are read; the profile's when absent.
    profile : Profile
        How well the plans are drawn.
    fields : mapping, optional
        Texts of the title block that outrank the file's.
    furniture : Furniture, optional
        Form of the title block and additional graphs; the file's when absent.
    errors : bool
        Draw the ellipses of the drafting error around the points of scheme and plans.
    sigma : bool, optional
        Show the drafting errors of the results in their tables; None: of one position alone.
    layout : str, Path or Composition, optional
        What is on the sheets: the name of a shipped composition or a file of one's own. When
        absent, ``one-position`` or ``many-positions``.

    Raises
    ------
    LayoutError
        When the blocks fit no format, or not the asked one.
    CompositionError
        When the composition is faulty.
    """
    words = language(problem.sheet.lang or LANGUAGES[0])
    made = composition(layout, words.lang) if isinstance(layout, str | Path) else layout
    if positions is None and made is not None and made.turn:
        from planmethod.solved.turn.turn import turn_of

        positions = turn_of(Solution(problem)).positions.tolist()
    asked = problem.drive.positions if positions is None else tuple(positions)
    if len(asked) > MOST_DRAWN:
        raise LayoutError(
            "{}: sheets are drawn for at most {} positions, {} are asked. Ask fewer "
            "(--phi 0:360:30); for tables take solve --csv.",
            problem.name,
            MOST_DRAWN,
            len(asked),
        )
    if made is None:
        made = composition(SHIPPED[(len(asked) > 1) + (len(asked) > FEW)], words.lang)
    _check_positions(made, len(asked))
    if paper:
        problem = replace(problem, sheet=replace(problem.sheet, paper=paper_format(paper).name))
    paper = problem.sheet.paper
    furniture = furniture or Furniture.of(problem.sheet)
    extras = Extras(words, errors, sigma, made.turn)
    task = _Task(problem, made, tuple(asked), ruler, profile, extras)
    task = replace(task, estimated=task.solved(None, problem.scales))
    views = _views(task)
    papers = (views.paper,) if paper else made.formats[made.formats.index(views.paper) :]
    scales = problem.scales
    # One decision: the scales stay on a larger paper, if the smaller one had no room after all.
    tasks = [task if views.kept else replace(task, views=views)]
    # Scales for one position may be too fine for a dozen plans on one sheet, or for another one.
    free = replace(task, problem=replace(problem, scales=replace(scales, mu_v=None, mu_a=None)))
    given = (scales.mu_v, scales.mu_a) != (None, None)
    if given and (made.turn or len(asked) > FEW):
        tasks.append(free)
    last = [free] if given and task.positions != problem.drive.positions else []
    turns = (tasks, [task], last)
    tries = chain(*(product(papers, made.shares, made.at_most(len(asked)), some) for some in turns))

    def later(name: str) -> Room:
        return replace(furniture, form="2a").room(paper_format(name), 2)

    with using(lettering(problem.sheet.lettering or "B")):
        for name, share, per_sheet, task in tries:
            fmt = paper_format(name)
            on = Paper(name, partial(furniture.room, fmt), later, paper is not None, share)
            pages = task.on(on, per_sheet)
            if pages is not None:
                return _drawn(problem, pages, fmt, fields or {}, furniture)
    given = any(mu is not None for mu in (scales.mu_l, scales.mu_v, scales.mu_a))
    advice = (
        "Take coarser scales in [scales], or leave them out"
        if given
        else (say("Take a larger format: one of {}", ", ".join(made.formats)))
    )
    raise LayoutError("{}: the views do not fit {}. {}.", problem.name, papers[-1], advice)


def _views(task: _Task) -> Views:
    """Return the views on the format that sheets are tried on first."""
    layout, count = task.layout, len(task.positions)
    assert task.estimated is not None
    views = task.estimated.views
    estimated = views.paper in layout.formats and any(entry.of for entry in layout.blocks)
    if not task.problem.sheet.paper and not estimated:  # it is one of schemes and plans
        views = Views.for_paper(layout.formats[0], count)
    return layout.views_for(views.paper, count)


def _check_positions(layout: Composition, count: int) -> None:
    for number, entry in enumerate(layout.blocks):
        if entry.position is not None and entry.position >= count:
            raise LayoutError(
                "{}: blocks[{}].position is {}, but of {} positions the last is {}. Name one "
                "of them, or ask more with --phi.",
                layout.name,
                number,
                entry.position,
                count,
                count - 1,
            )
