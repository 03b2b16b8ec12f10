"""Sketch of a problem file: the scheme alone, with missing parts marked (эскиз схемы)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from math import radians

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import PointName
from planmethod.errors import ProblemError
from planmethod.mechanism.model import FRAME
from planmethod.note.formula import capitalized, escape
from planmethod.note.narrate.cycle import degrees, range_fact
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.wording import Language
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention
from planmethod.render.forces.arrows import (
    Acting,
    CoupleArc,
    couple_items,
    force_items,
    place_force_arrows,
)
from planmethod.render.ink.drawing import Arc, Drawing, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.layout.block import Block, Column, Picture, Row, paragraph
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.scheme import extent
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.render.pictures.seriesview import series_picture
from planmethod.render.symbols import fixed_pivot, unit
from planmethod.solved.failures import Cause, Failure
from planmethod.solved.forces.loads import external
from planmethod.solved.partial_mechanism import MechanismPart
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle, crank_cycle_of
from planmethod.solved.view_space import Views

BOX = (180.0, 130.0)
"""Size of the scheme, mm."""

VIEWS = Views.for_scheme(BOX)
"""Size of the scheme as views, for the choice of the scale."""

ASSEMBLY_BOX = (110.0, 85.0)
"""Size of one of several assemblies, mm."""

ASSEMBLY_VIEWS = Views.for_scheme(ASSEMBLY_BOX)

HEIGHT, SMALL, WIDTH, EDGE = 5.0, 3.5, 190.0, 6.0
"""Heights of letters, width of the text and white round all, mm."""

_MAX_TIMES = 6.0
"""Largest ratio of a scheme at the scale of the file to its box."""

_MAX_MARKS_OF_MISSING_LINK = 3
"""Number of points with the number of a link that is not drawn."""

_SAME = 1e-2  # degrees, or m: the shown position is the requested one
_HALF = 60  # of a drawn arc, degrees
_OUT = 6.0  # of the arc of possible positions beyond the crank's pin, mm


class _Marks(Struct):
    """Items drawn over the scheme, and their labels."""

    items: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)


def sketch(part: MechanismPart, title: str, language: Language, notes: Sequence[str]) -> Drawing:
    """Return the sketch of a part of a mechanism, as large as its contents.

    Parameters
    ----------
    title : str
        Title of the problem.
    notes : sequence of str
        Text about the file under the scheme, plain text, a paragraph each.
    """
    if part.solution is not None and not _is_viewable(part.solution):
        scales = replace(part.solution.problem.scales, mu_l=None)
        part = replace(part, solution=part.solution.filling(VIEWS, scales))
    ways = part.assemblies if len(part.assemblies) > 1 else ()
    if ways:
        picture, facts = _show_assemblies(part, language)
    else:
        picture, facts = _scheme(part, language) if part.solution else _pivots(part, language)
    if part.links:
        facts.append(language.sheets.not_drawn.format(links=", ".join(part.links)))
    texts = [escape(line) for line in notes]
    blocks: list[Block] = [picture] if not isinstance(picture, Picture) or picture.items else []
    return _set(title, [*blocks, *(paragraph(text, SMALL, WIDTH) for text in (*facts, *texts))])


def _is_viewable(solution: Solution) -> bool:
    """Return whether a sketch at the scale of the file is small enough to view."""
    left, low, right, high = extent(solution, range(len(solution.positions)))
    return max(right - left, high - low) <= _MAX_TIMES * BOX[0]


def assigned(solution: Solution) -> Drawing:
    """Return the scheme of an assignment: with its loads, without the requested results."""
    marks = _Marks()
    _mark_loads(marks, solution)
    return _set("", [_marked(solution, marks, driver_only=True)])


def _marked(solution: Solution, marks: _Marks, *, driver_only: bool = False) -> Picture:
    """Return the scheme and the items over it, all letters placed together."""
    added, several = (tuple(marks.items), tuple(marks.labels)), range(len(solution.positions))
    if len(several) == 1:
        return scheme_picture(solution, 0, driver_only=driver_only, added=added)
    return series_picture(solution, 0, tuple(several), added=added)


def notice(text: str) -> Drawing:
    """Return a text alone, in place of a picture that cannot be drawn."""
    return _set("", [paragraph(escape(line), SMALL, WIDTH) for line in text.splitlines()])


def _set(title: str, blocks: list[Block]) -> Drawing:
    head: list[Block] = [paragraph(escape(title), HEIGHT, WIDTH)] if title else []
    whole = Column([*head, *blocks], gap=5.0)
    drawing = Drawing(whole.width + 2 * EDGE, whole.height + 2 * EDGE, title)
    drawing.extend(whole.place(complex(EDGE, whole.height + EDGE)))
    return drawing


def _scheme(part: MechanismPart, language: Language) -> tuple[Picture, list[str]]:
    solution = part.solution
    assert solution is not None
    marks = _Marks()
    facts = [
        _scale(solution.scales[PlanKind.POSITION], solution.problem.scales.convention, language)
    ]
    places = {name: _at(solution, name) for name in _points(solution)}
    joined = {joint.point for joint in solution.problem.mechanism.revolutes}
    own = {point for points in (part.links or {}).values() for point in points}
    fixed = solution.problem.bodies[FRAME].points
    _mark_pivots(marks, {name: places[name] for name in fixed if name in own - joined})
    _mark_missing(marks, part, places)
    if part.failure is not None:
        _mark_arcs(marks, solution, part.failure)
    _mark_loads(marks, solution)
    turn = _turn(solution)
    if turn is not None:
        facts.append(capitalized(range_fact(turn, language)))
        _mark_range(marks, turn, language)
    return _marked(solution, marks), facts


def _show_assemblies(part: MechanismPart, language: Language) -> tuple[Block, list[str]]:
    """Return the assemblies side by side, each under the rules that choose it."""
    shown: list[Block] = []
    facts: list[str] = []
    for way in part.assemblies:
        scales = (
            None if _is_viewable(way.solution) else replace(way.solution.problem.scales, mu_l=None)
        )
        one = replace(part, solution=way.solution.filling(ASSEMBLY_VIEWS, scales), unsure=())
        picture, facts = _scheme(one, language)
        rules = (f'{point} = "{rule}"' for point, rule in way.rules.items())
        text = language.sheets.assembled.format(rules="; ".join(map(escape, rules)))
        shown.append(Column([paragraph(text, HEIGHT, ASSEMBLY_BOX[0]), picture], gap=3.0))
    rows = [Row(shown[k : k + 2], gap=10.0) for k in range(0, len(shown), 2)]
    return Column(rows, gap=8.0), facts


def _scale(scale: Scale, convention: Convention, language: Language) -> str:
    return scale_inscription(scale, convention, language.notation)


def _pivots(part: MechanismPart, language: Language) -> tuple[Picture, list[str]]:
    """Return the fixed points alone."""
    places = part.fixed or {}
    if not places:
        return Picture((), (0.0, 0.0, 0.0, 0.0)), []
    xs, ys = [z.real for z in places.values()], [z.imag for z in places.values()]
    size = (max(xs) - min(xs), max(ys) - min(ys))
    per_mm = choose_scale(size, BOX) if max(size) else 1.0
    marks = _Marks()
    at = {name: (z - complex(xs[0], ys[0])) / per_mm for name, z in places.items()}
    _mark_pivots(marks, at)
    _mark_missing(marks, part, at)
    scale = Scale("mu_l", per_mm, "m")
    facts = [_scale(scale, Convention.UNIT_PER_MM, language)] if max(size) else []
    return lettered(marks.items, marks.labels), facts


def _mark_pivots(marks: _Marks, places: Mapping[str, complex]) -> None:
    for name, place in places.items():
        marks.items += fixed_pivot(place)
        marks.labels.append(Label(typeset(point_name(name), HEIGHT), place, prefer=1 + 1j, gap=3.0))


def _points(solution: Solution) -> list[str]:
    return list(solution.construction.draft.points())


def _at(solution: Solution, name: str) -> complex:
    return complex(solution.paper.point(PointName(name))[0])


def _mark_missing(marks: _Marks, part: MechanismPart, places: Mapping[str, complex]) -> None:
    """Put the numbers of links that are not drawn at their drawn points."""
    for link, points in (part.links or {}).items():
        for point in [one for one in points if one in places][:_MAX_MARKS_OF_MISSING_LINK]:
            text = typeset(f"{link}?", HEIGHT)
            marks.labels.append(
                Label(text, places[point], prefer=1 - 1j, gap=4.0, name=f"missing {link}")
            )
    for point in part.unsure:
        if point in places:
            marks.labels.append(
                Label(typeset("?", HEIGHT), places[point], prefer=-1 + 1j, gap=4.0, name="unsure")
            )


def _mark_arcs(marks: _Marks, solution: Solution, failure: Failure) -> None:
    """Draw the arcs that do not intersect, if the shown position is the impossible one."""
    shown = abs(float(solution.positions[0]) - failure.place.value) < _SAME
    if not shown or failure.cause not in (Cause.ARCS, Cause.ARC):
        return
    if not {*failure.points} <= {*_points(solution)}:
        return
    centres = [_at(solution, point) for point in failure.points]
    radii = [length / solution.per_mm["mu_l"] for length in failure.lengths[: len(centres)]]
    if failure.cause is Cause.ARC:
        marks.items.append(Arc(centres[0], radii[0], pen=Pen.THIN, tag="arc"))
        return
    ways = [centres[1] - centres[0], centres[0] - centres[1]]
    if abs(radii[0] - radii[1]) > abs(ways[0]):  # one circle lies in the other
        ways = [ways[0] if radii[0] > radii[1] else ways[1]] * 2
    for centre, radius, way in zip(centres, radii, ways, strict=True):
        turn = unit(way)
        points = tuple(centre + radius * turn * cis(a) for a in range(-_HALF, _HALF + 1, 2))
        marks.items.append(Stroke(points, Pen.THIN, tag="arc", smooth=True))
        text = typeset(f"{point_name(failure.out)}?", SMALL)
        marks.labels.append(Label(text, points[len(points) // 2], prefer=turn, gap=1.5))


def _mark_loads(marks: _Marks, solution: Solution) -> None:
    """Draw the external forces and couples of the first position that is shown."""
    dynamics, problem = solution.problem.dynamics, solution.problem
    if dynamics is None:
        return
    try:
        found = [
            one for link in problem.mechanism.links for one in external(solution, dynamics, link)
        ]
    except ProblemError:  # known only in the positions of the file, some of which are absent
        return
    forces, couples = [], []
    for one in found:
        if one.point is not None and abs(one.force[0]) > 0:
            forces.append(Acting(one.name, _at(solution, one.point), complex(one.force[0])))
        elif one.point is None and one.couple[0]:
            points = [_at(solution, name) for name in problem.bodies[one.link].points]
            middle = sum(points) / len(points)
            couples.append(CoupleArc(one.name, middle, 1 if one.couple[0] > 0 else -1))
    bars = [(_at(solution, one), _at(solution, two)) for one, two in _bars(solution)]
    arrows, letters = force_items(place_force_arrows(forces, bars), SMALL, "sketch")
    turns, more = couple_items(couples, [Stroke(bar) for bar in bars], SMALL, "sketch")
    marks.items += [*arrows, *turns]
    marks.labels += [*letters, *more]


def _bars(solution: Solution) -> Iterator[tuple[str, str]]:
    for link, body in solution.problem.bodies.items():
        names = list(body.points)
        if link != FRAME and len(names) > 1:
            yield from ((names[0], other) for other in names[1:])


def _turn(solution: Solution) -> CrankCycle | None:
    """Return the turn of a crank that moves other links."""
    if not solution.problem.drive.is_crank or not solution.structure.groups:
        return None
    try:
        return crank_cycle_of(solution)
    except ProblemError:  # none of its links can be an output
        return None


def _mark_range(marks: _Marks, turn: CrankCycle, language: Language) -> None:
    """Draw the arc of the positions in which the mechanism can be assembled."""
    solution, limits = turn.solution, turn.range
    drive = solution.problem.drive
    if limits is None or drive.pivot is None:
        return
    centre = _at(solution, drive.pivot)
    body = solution.problem.bodies[drive.link].points
    radius = max(abs(_at(solution, point) - centre) for point in body) + _OUT
    marks.items.append(
        Arc(centre, radius, radians(limits[0]), radians(limits[1]), Pen.THIN, "range")
    )
    for value in limits:
        way = cis(value)
        end = centre + (radius + 3.0) * way
        marks.items.append(Stroke((end - _OUT * way, end), Pen.THIN, tag="range"))
        marks.labels.append(Label(typeset(degrees(value, language), SMALL), end, prefer=way))
