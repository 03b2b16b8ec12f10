"""The Zhukovsky lever drawn: the turned velocity plan with the forces at its points."""

from __future__ import annotations

from planmethod.note.narrate.forces.resultants import force_symbol
from planmethod.note.narrate.letters import plan_letters
from planmethod.note.numbers import Notation
from planmethod.plans.model import PlanKind
from planmethod.render.forces.arms import arm_items, arm_of
from planmethod.render.forces.arrows import (
    Acting,
    CoupleArc,
    couple_items,
    force_items,
    place_force_arrows,
)
from planmethod.render.forces.shifts import ShiftedForce, shift_items
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.labels import NEAREST
from planmethod.render.labels.merged_labels import label_merged_letters, merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.pictures.planview import similar_lines
from planmethod.solved.forces.lever import LeverCouple, LeverReading
from planmethod.solved.forces.reading import ForceReading
from planmethod.solved.reading import memoized

LEVER = "lever"
"""Tag of the lines of the lever."""


@memoized
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
