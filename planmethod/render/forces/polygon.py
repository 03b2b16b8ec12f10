"""A force plan, a hodograph of a reaction and the lever as a draughtsman draws them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.construct.scale import Scale, choose_scale
from planmethod.construct.steps import PointName
from planmethod.note.narrate.forces.loads import force_symbol
from planmethod.note.narrate.naming import plan_letters
from planmethod.note.numbers import Notation
from planmethod.plans.forces.board import SCALE
from planmethod.plans.forces.polygons import Component, Edge
from planmethod.plans.model import KnownParts, PlanKind
from planmethod.problem.model import Convention
from planmethod.render.forces.arrows import (
    FORCE_LABEL_STYLE,
    Acting,
    CoupleArc,
    arm_items,
    arm_of,
    couple_items,
    force_items,
    place_force_arrows,
)
from planmethod.render.forces.cut import ShiftedForce, shift_items
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.pens import drawn_once
from planmethod.render.ink.typeset import typeset, vector_markup
from planmethod.render.labels import NEAREST, Label
from planmethod.render.labels.label_column import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.collinear import shifts_apart
from planmethod.render.pictures.diagram import polar_picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.planview import Ellipses, shown_ellipses, similar_lines
from planmethod.render.symbols import PLAN_FORCE, vector_arrow
from planmethod.solved.cycle_forces import CycleForces
from planmethod.solved.errors.forces import drawn_forces
from planmethod.solved.forces.reading import (
    NEGLIGIBLE_FRACTION,
    ForceReading,
    LeverCouple,
    LeverReading,
)
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.reading import Complexes, memoized

START = "start of a force plan"
"""Tag of the disc where the construction of a plan begins: one for each plan."""

LINK_START = "start of a link's force plan"
"""Tag of the disc where the plan of one link begins."""

NO_ELLIPSES = Ellipses()

_MIN_LENGTH = 0.3
"""Shortest segment that is drawn, mm."""


def start_place(reading: ForceReading, number: int) -> complex:
    """Return where the construction of a plan begins, mm: the first forces are laid off there."""
    starts = reading.statics.board.starts
    ends = (end for edge in reading.plans[number].polygon for end in (edge.tail, edge.head))
    return reading.corner(number, next(end for end in ends if end in starts))


def drawn_edges(reading: ForceReading, number: int) -> list[Edge]:
    """Return the segments of a force plan that are drawn: polygon, resultants, inner reaction.

    Resultants and the inner reaction are drawn only if no side of the polygon shows them.
    """
    plan = reading.plans[number]
    result: list[Edge] = []
    ends: set[frozenset[complex]] = set()
    others = [*reading.wholes(plan), *reading.inner(plan)]
    for edge, is_side in (*((e, True) for e in reading.shown(plan)), *((e, False) for e in others)):
        places = frozenset(_rounded(reading.corner(number, end)) for end in (edge.tail, edge.head))
        if abs(reading.drawn(number, edge)) >= _MIN_LENGTH and (is_side or places not in ends):
            ends.add(places)
            result.append(edge)
    return result


def _rounded(place: complex) -> complex:
    return complex(round(place.real, 3), round(place.imag, 3))


def _written(reading: ForceReading, number: int, edge: Edge, notation: Notation) -> str:
    """Return the inscription of a segment: all reactions that it shows.

    A component may be the whole reaction; the inner reaction may be the same line.
    """
    plan = reading.plans[number]
    others = [*plan.wholes, *plan.inner]
    written = [vector_markup(notation.symbol(edge.symbol))]
    tail, head = reading.corner(number, edge.tail), reading.corner(number, edge.head)
    for other in others:
        ends = reading.corner(number, other.tail), reading.corner(number, other.head)
        if other.symbol == edge.symbol:
            continue
        if max(abs(ends[0] - tail), abs(ends[1] - head)) < 1e-3:
            written.append(vector_markup(other.symbol))
        elif max(abs(ends[0] - head), abs(ends[1] - tail)) < 1e-3:
            written.append(f"−{vector_markup(other.symbol)}")
    return " = ".join(written)


def find_overlap_shifts(reading: ForceReading, number: int) -> list[complex]:
    """Return the offsets at which the segments of a plan are drawn beside their places, mm."""
    return overlap_shifts(reading, number, drawn_edges(reading, number))


def overlap_shifts(reading: ForceReading, number: int, edges: Sequence[Edge]) -> list[complex]:
    """Return the offsets at which some segments are drawn beside their places, mm."""
    return shifts_apart(
        [(reading.corner(number, edge.tail), reading.corner(number, edge.head)) for edge in edges],
        always=True,
    )


@drawn_once
def polygon_picture(
    reading: ForceReading,
    number: int,
    letter_height: float,
    notation: Notation,
    ellipses: Ellipses = NO_ELLIPSES,
) -> Picture:
    """Return the force plan of a group or of the driver, its first point at the origin, mm."""
    edges = drawn_edges(reading, number)
    written = [_written(reading, number, edge, notation) for edge in edges]
    named = [notation.symbol(edge.symbol) for edge in edges]
    items, labels = _sides(reading, number, edges, (named, written), letter_height)
    start = Disc(start_place(reading, number), 0.7, Ink.BLACK, tag=START)
    return lettered([*ellipses.strokes, *items, start], labels, clear=ellipses.grounds)


@drawn_once
def link_polygon_picture(
    reading: ForceReading, number: int, link: str, letter_height: float, notation: Notation
) -> Picture:
    """Return the force plan of one link of a group, in the places of the group's plan, mm."""
    edges = link_edges(reading, number, link)
    named = [notation.symbol(edge.symbol) for edge in edges]
    texts = (named, [vector_markup(name) for name in named])
    items, labels = _sides(reading, number, edges, texts, letter_height, f" link {link}")
    start = Disc(reading.corner(number, edges[0].tail), 0.7, Ink.BLACK, tag=LINK_START)
    return lettered([*items, start], labels)


def link_edges(reading: ForceReading, number: int, link: str) -> list[Edge]:
    """Return the sides of the force plan of one link of a group: known forces, inner reaction."""
    edges = [
        edge
        for balance in reading.plans[number].balances
        if balance.links == (link,)
        for edge in balance.edges
        if abs(reading.drawn(number, edge)) >= _MIN_LENGTH
    ]
    last = next((k for k, edge in enumerate(edges) if edge.known is KnownParts.NONE), -1)
    return edges[last + 1 :] + edges[: last + 1]  # the found reaction closes the plan


def _sides(
    reading: ForceReading,
    number: int,
    edges: Sequence[Edge],
    texts: tuple[Sequence[str], Sequence[str]],
    letter_height: float,
    suffix: str = "",
) -> tuple[list[Item], list[Label]]:
    """Return the sides of a force plan with their labels: ``texts`` are letters, inscriptions."""
    shifts = overlap_shifts(reading, number, edges)
    items: list[Item] = []
    labels: list[Label] = []
    ends = [reading.corner(number, end) for edge in edges for end in (edge.tail, edge.head)] or [0j]
    centre = sum(ends) / len(ends)
    for k, (edge, shift) in enumerate(zip(edges, shifts, strict=True)):
        tail, head = (
            reading.corner(number, edge.tail) + shift,
            reading.corner(number, edge.head) + shift,
        )
        thin = edge.component is not Component.TOTAL
        pen = Pen.COMPONENT if thin else Pen.RESULTANT
        symbol, inscription = texts[0][k], texts[1][k]
        tag = f"{PLAN_FORCE} {symbol}"
        items += vector_arrow(tail, head, pen=pen, tag=tag)
        labels.append(
            Label(
                typeset(inscription, letter_height),
                (tail + head) / 2,
                (tail, head),
                prefer=(tail + head) / 2 - centre,
                gap=1.0,
                name=f"plan {reading.index} {number}{suffix} {k}: {symbol}",
                style=FORCE_LABEL_STYLE,
            )
        )
    return items, labels


@memoized
def vertex_ellipses(reading: ForceReading, number: int) -> Ellipses:
    """Return the ellipses around the vertices of a force plan.

    They are relative to the point where the construction of the plan begins, which is arbitrary. A
    vertex from which segments are drawn apart has its ellipse at the end of the first of them.
    """
    edges, shifts = drawn_edges(reading, number), find_overlap_shifts(reading, number)
    places: dict[PointName, complex] = {}
    for ends in ([edge.head for edge in edges], [edge.tail for edge in edges]):
        for end, shift in zip(ends, shifts, strict=True):
            places.setdefault(end, reading.corner(number, end) + shift)
    across = [place.real for place in places.values()]
    up = [place.imag for place in places.values()]
    size = max(max(across) - min(across), max(up) - min(up)) if places else 0.0
    share = reading.enlargement(number)
    return shown_ellipses(
        drawn_forces(reading.statics), reading.index, places, size, magnification=share
    )


def hodograph_scale(cycle: CycleForces, number: int, side: float) -> Scale:
    """Return the scale at which a hodograph fills a square of ``side`` mm."""
    places = np.concatenate([[0j], *(piece.values for piece in cycle.force(number))])
    size = (float(np.ptp(places.real)), float(np.ptp(places.imag)))
    inverse = cycle.solution.problem.scales.convention is Convention.MM_PER_UNIT
    return Scale(SCALE, choose_scale(size, (side, side), mm_per_unit=inverse), "N")


def polar_groups(cycle: CycleForces) -> list[list[int]]:
    """Return the numbers of the reactions that have a polar diagram.

    They are not zero, and their direction is free, unlike that of reactions across a guide.
    Reactions that are the same but for their sign, as those at the ends of a massless link, share
    one.
    """
    reactions = statics_of(cycle.solution).board.reactions
    groups: list[list[int]] = []
    for k, reaction in enumerate(reactions):
        if reaction.couple is not None or cycle.is_negligible(k):
            continue
        for group in groups:
            if opposite(cycle, group[0], k) is not None:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def opposite(cycle: CycleForces, one: int, two: int) -> bool | None:
    """Return whether two reactions are always opposite (True) or equal (False); None if neither."""
    a, b = cycle.joints[one].force, cycle.joints[two].force
    least = NEGLIGIBLE_FRACTION * cycle.peak(one).size
    if float(np.max(np.abs(a + b))) <= least:
        return True
    return False if float(np.max(np.abs(a - b))) <= least else None


@drawn_once
def hodograph_picture(
    cycle: CycleForces, number: int, per_mm: float, letter_height: float
) -> Picture:
    """Return the polar diagram of a reaction, its pole at the origin, mm."""
    parts = [piece.values / per_mm for piece in cycle.force(number)]
    ends: Complexes = cycle.joints[number].force / per_mm
    return polar_picture(parts, ends, letter_height, str(number))


LEVER = "lever"
"""Tag of the lines of the lever."""


@drawn_once
def lever_picture(reading: ForceReading, letter_height: float, notation: Notation) -> Picture:
    """Return the lever with all its forces and couples, its pole at the origin, mm."""
    solution = reading.solution
    lever, plan = LeverReading(reading), solution.construction.plan(PlanKind.VELOCITY)
    pairs = [(vector.tail, vector.head) for vector in plan.vectors]
    pairs += similar_lines(solution, plan)
    bars = [
        (lever.place(tail), lever.place(head))
        for tail, head in pairs
        if abs(lever.place(head) - lever.place(tail)) > 0.3
    ]
    items: list[Item] = [Stroke(bar, Pen.THIN, tag=LEVER) for bar in bars]
    letters = plan_letters(solution.problem, plan)
    ordered = sorted(letters.items(), key=lambda pair: pair[0] != plan.pole)
    spots = merge_letters((lever.place(name), own) for name, own in ordered)
    items += [Disc(place, 0.7, Ink.BLACK) for place, _ in spots]
    prefix = f"lever {reading.index}"
    labels = label_merged_letters(spots, letter_height, f"{prefix}: point", style=NEAREST)
    forces = [
        Acting(notation.symbol(force.symbol), force.at, force.force) for force in lever.forces
    ]
    shifted_forces = [
        ShiftedForce(force_symbol(one.link), one.letters[1], *one.line) for one in lever.shifts
    ]
    shifted_forces = [one for one in shifted_forces if one.is_visible]
    placed = place_force_arrows(forces, [one.line for one in shifted_forces])
    arrows, letters_of_forces = force_items(placed, letter_height, prefix)
    lines, letters_of_shifts = shift_items(shifted_forces, placed, letter_height, prefix)
    arms = [
        arm_of(acting, force.about, force.arm)
        for acting, force in zip(forces, lever.forces, strict=True)
        if force.arm
    ]
    measured, sizes = arm_items(arms, placed, letter_height, prefix, notation)
    items += [*lines, *measured, *arrows]
    turnings = [_turning(one, notation) for one in lever.couples if one.lever_moment]
    turns, letters_of_couples = couple_items(turnings, items, letter_height, prefix)
    named = [*sizes, *letters_of_forces, *letters_of_couples, *letters_of_shifts, *labels]
    return lettered([*items, *turns], named)


def _turning(one: LeverCouple, notation: Notation) -> CoupleArc:
    place = 0j if one.segment is None else sum(one.segment) / 2
    sense = 1 if one.lever_moment > 0 else -1
    return CoupleArc(notation.symbol(one.symbol), place, sense, one.segment)
