"""Velocity and acceleration plans as drawn by a draughtsman: pole, vectors, letters."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, isfinite

from planmethod.construct.steps import PointName, Similar
from planmethod.note.narrate.letters import plan_letters
from planmethod.plans.model import Plan, PlanKind, Vector, VectorKind
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import NAMING, NEAREST, Label
from planmethod.render.labels.merged_labels import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.detail_views import (
    ENLARGED,
    detail_mark,
    detail_picture,
    placed_in,
    radius_of,
)
from planmethod.render.pictures.ellipses import Ellipses, error_ellipses
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.traces import Shown, plan_traces
from planmethod.render.symbols import vector_arrow
from planmethod.solved.reading import memoized
from planmethod.solved.solution import Solution

POLE = "pole"
"""Tag of the disc at a plan's pole: one for each plan that is drawn."""

NAMES, SMALL_NAMES = 3.5, 2.5
"""Height of the names of vectors, and on plans of several positions, mm."""

NAMED, SMALL_NAMED = 5.0, 8.0
"""Length from which a vector has a name, and on a plan of several positions, mm: shorter ones are
identified by the letters of their ends."""

COMPONENTS = (VectorKind.NORMAL, VectorKind.TANGENTIAL, VectorKind.CORIOLIS)


def similar_lines(solution: Solution, plan: Plan) -> list[tuple[PointName, PointName]]:
    """Return the sides of the figures similar to links that are not vectors of the plan."""
    drawn = {frozenset((v.tail, v.head)) for v in plan.vectors}
    pole = str(plan.pole)
    lines: dict[frozenset[PointName], tuple[PointName, PointName]] = {}
    for step in solution.construction.program.steps:
        if not isinstance(step, Similar) or step.out[:2] != pole[:2]:
            continue
        for side in ((step.plan_b, step.plan_c), (step.plan_b, step.out), (step.plan_c, step.out)):
            if frozenset(side) not in drawn:
                lines.setdefault(frozenset(side), side)
    return list(lines.values())


def plan_places(
    solution: Solution, kind: PlanKind, index: int, *, use_ruler: bool = False
) -> dict[PointName, complex]:
    """Return the places of the points of a plan in one position, mm from its pole.

    ``use_ruler`` selects the plan drawn with the ruler, whose segments are those of the
    calculation; if one of its points cannot be drawn so, the exact plan.
    """
    plan = solution.construction.plan(kind)
    assert plan.pole is not None
    ends = {e for v in plan.vectors for e in (v.tail, v.head)} | set(plan.letters) | {plan.pole}
    for reading in (solution.ruler_reading, solution.paper) if use_ruler else (solution.paper,):
        at = {name: complex(reading.point(name)[index]) for name in ends}
        if all(isfinite(abs(place)) for place in at.values()):
            break
    return at


@memoized
def plan_picture(
    solution: Solution,
    kind: PlanKind,
    index: int,
    *,
    letter_height: float = 5.0,
    errors: bool = False,
    use_ruler: bool = False,
    traces: Shown = False,
    detail_letters: tuple[str, ...] = (),
) -> Picture:
    """Return a plan in one position as a picture, its own pole at the origin, mm.

    ``errors`` draws the ellipses of the drafting error around its points; ``use_ruler`` is
    explained by `plan_places`, and ``traces`` by `planmethod.render.pictures.traces`.
    ``detail_letters`` are the letters of the enlarged views beside it, in their order. Cached,
    since a sheet is tried with fewer positions when it does not fit with more.
    """
    plan = solution.construction.plan(kind)
    assert plan.pole is not None
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    factor = min(1.0, letter_height / 5.0 + 0.2)
    ellipses = error_ellipses(solution, kind, index) if errors else Ellipses()
    left, directions = plan_traces(solution, kind, index, at, traces)
    items: list[Item] = [*ellipses.strokes, *left]
    for tail, head in similar_lines(solution, plan):
        if abs(at[head] - at[tail]) > 0.05:
            items.append(Stroke((at[tail], at[head]), Pen.THIN, tag="similar"))
    for vector in plan.vectors:
        thin = is_component(vector, kind)
        items += vector_arrow(
            at[vector.tail],
            at[vector.head],
            pen=Pen.THIN if thin else Pen.MAIN,
            length=5.0 * factor,
            tag=vector.kind.value,
        )
    items.append(Disc(at[plan.pole], 0.9 * factor, Ink.BLACK, tag=POLE))
    enlarged = solution.detail_views_at(kind, index) if detail_letters else ()
    whole = bool(enlarged) and index in solution.small_plans[kind]  # its letters are there
    prefix = f"{kind.value} {index}"
    labels = [] if whole else _labels(solution, plan, at, letter_height, prefix)
    for detail_view, letter in zip(enlarged, detail_letters, strict=False):
        circle, label = detail_mark(detail_view, at, letter, letter_height)
        items.append(circle)
        labels.append(label)
    names = [] if whole else vector_names(plan, at, letter_height, prefix)
    return lettered(items, [*labels, *names], clear=ellipses.grounds, welcome=directions)


def vector_names(
    plan: Plan, at: Mapping[PointName, complex], letter_height: float, prefix: str
) -> list[Label]:
    """Return the names of the vectors, each once, the shortest first: they have the fewest places.

    Parameters
    ----------
    at : mapping
        Places of the points of the plan, mm.
    letter_height : float, mm
        Height of the letters of the points.
    """
    large = letter_height > NAMES
    height, named = (NAMES, NAMED) if large else (SMALL_NAMES, SMALL_NAMED)
    ends = {(v.tail, v.head): v for v in reversed(plan.vectors) if v.tail != v.head}
    sized = [(abs(at[head] - at[tail]), tail, head) for tail, head in ends]
    return [
        Label(
            typeset(f"\\bar{{{vector.symbol[0]}}}{vector.symbol[1:]}", height),
            (at[tail] + at[head]) / 2,
            (at[tail], at[head]),
            gap=1.2 if large else 0.9,
            name=vector_label(prefix, vector),
            priority=-1,
            style=NAMING,
            optional=True,
        )
        for size, tail, head in sorted(sized)
        if size >= named
        for vector in (ends[tail, head],)
    ]


def vector_label(prefix: str, vector: Vector) -> str:
    """Return the name of the inscription that names a vector: ``velocity 0: v_{B}``."""
    return f"{prefix}: {vector.symbol}"


def is_component(vector: Vector, kind: PlanKind) -> bool:
    """Return whether a vector is a component, which is drawn thin."""
    return vector.kind in COMPONENTS or (
        vector.kind is VectorKind.SLIDING and kind is PlanKind.ACCELERATION
    )


def detail_pictures(
    solution: Solution, kind: PlanKind, index: int, *, letter_height: float, use_ruler: bool
) -> list[Picture]:
    """Return the enlarged views of the knots of a position's plan."""
    plan = solution.construction.plan(kind)
    at = plan_places(solution, kind, index, use_ruler=use_ruler)
    thin = frozenset((v.tail, v.head) for v in plan.vectors if is_component(v, kind))
    letters = plan_letters(solution.problem, plan)
    shortest = 0.0 if index not in solution.small_plans[kind] else inf
    pictures = []
    for detail_view in solution.detail_views_at(kind, index):
        places = placed_in(detail_view, at)
        names = [
            name
            for name in vector_names(
                plan, places, letter_height, f"{ENLARGED} {detail_view.number}"
            )
            if name.segment is not None
            and abs(name.segment[1] - name.segment[0]) < max(shortest, NAMED * detail_view.times)
            and max(map(abs, name.segment)) < radius_of(detail_view, at)
        ]
        pictures.append(detail_picture(plan, detail_view, at, letters, thin, letter_height, names))
    return pictures


def _labels(
    solution: Solution, plan: Plan, at: dict[PointName, complex], height: float, prefix: str
) -> list[Label]:
    """Return the letters; points that coincide on the paper share one inscription."""
    letters = plan_letters(solution.problem, plan)
    ordered = sorted(letters.items(), key=lambda pair: pair[0] != plan.pole)
    spots = merge_letters((at[name], own) for name, own in ordered)
    return label_merged_letters(spots, height, f"{prefix}:", style=NEAREST)
