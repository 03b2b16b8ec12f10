"""Links cut free with reactions that friction inclines: circles and cones (круги и конусы трения).

The whole reaction of a turning pair touches its friction circle; that of a sliding one deviates
from the normal by the angle of friction. So moments and forces of friction are not drawn
separately.
"""

from __future__ import annotations

import cmath
from collections.abc import Iterator
from itertools import combinations
from math import atan2, radians

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.numbers import Notation
from planmethod.plans.forces.board import Reaction
from planmethod.plans.forces.polygons import CoupleOn, LoadKind, reaction_symbol
from planmethod.plans.model import PlanKind
from planmethod.render.forces.arrows import (
    Acting,
    CoupleArc,
    couple_items,
    force_items,
    on_action,
    place_force_arrows,
)
from planmethod.render.forces.cut import (
    FreeBodyScheme,
    Pressed,
    drawn_items,
    letters_of,
    point_items,
    pressed,
    turning,
)
from planmethod.render.ink.drawing import Arc, Item, Pen, Stroke
from planmethod.render.ink.pens import drawn_once
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label, Segment
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import SIZES, unit
from planmethod.solved.forces.friction import FrictionPair, RubbedReading

CIRCLE, CONE = "friction circle", "friction cone"
"""First words of the tags; the second is the letter."""

MIN_RADIUS = 3.0
"""Radius of the smallest friction circle, mm: smaller ones are enlarged, all by one factor."""

_MAX_RADIUS = 7.0  # mm: an enlarged circle is not larger
_REACH = 30.0  # length of the lines of a cone, mm


class Inclined(Struct, frozen=True):
    """Whole reaction of a pair with friction: how it is drawn, and the circle or the normal.

    ``normal`` is the force without that of friction; zero of a turning pair.
    """

    acting: Acting
    pair: FrictionPair
    centre: complex
    radius: float = 0.0
    normal: complex = 0j


def is_enlarged(reading: RubbedReading) -> bool:
    """Return whether the friction circles are drawn larger than to scale."""
    return _factor(reading) > 1.0


def _factor(reading: RubbedReading) -> float:
    per_mm = reading.solution.scales[PlanKind.POSITION].per_mm
    found = [pair.rho / per_mm for pair in reading.friction.pairs if pair.rho]
    return (
        max(1.0, min(MIN_RADIUS / min(found), max(_MAX_RADIUS / max(found), 1.0))) if found else 1.0
    )


def _letter(reading: RubbedReading, on: str, by: str, letter: str) -> str:
    called = reading.solution.problem.mechanism.called
    return reaction_symbol(called(on), called(by), letter=letter)


def _reactions(
    reading: RubbedReading, links: tuple[str, ...], guided: list[Pressed]
) -> Iterator[Acting | Inclined]:
    """Yield the reactions on links from outside them."""
    pairs = {pair.number: pair for pair in reading.friction.pairs}
    factor = _factor(reading) / reading.solution.scales[PlanKind.POSITION].per_mm
    at_guides = {symbol: one for one in guided for symbol in one.replaced}
    for number, reaction in enumerate(reading.statics.board.reactions):
        here = reaction.on in links, reaction.by in links
        if here[0] is here[1]:
            continue
        sign = 1.0 if here[0] else -1.0
        on, by = (reaction.on, reaction.by) if here[0] else (reaction.by, reaction.on)
        force = sign * reading.of_force(reaction.force)
        own = at_guides.get(_letter(reading, on, by, "F"))
        forces = list(own.forces) if own is not None else []
        if not forces and abs(force) > 1e-9 * reading.peak:
            symbol = _letter(reading, on, by, "F")
            forces = [Acting(symbol, reading.place(reaction.force.at), force)]
        pair = pairs.get(number)
        for one in forces:
            if pair is None or not pair.sense[reading.index]:
                yield one
            elif pair.slide is None:
                yield _touching(reading, reaction, pair, one, sign, factor * pair.rho)
            else:
                yield _off_normal(reading, pair, one, sign)


def _touching(
    reading: RubbedReading,
    reaction: Reaction,
    pair: FrictionPair,
    one: Acting,
    sign: float,
    radius: float,
) -> Inclined:
    """Shift the force of a hinge to its friction circle, on the side of the friction moment."""
    against = -sign * float(pair.sense[reading.index]) * _done(reading, pair, abs(one.direction))
    aside = -1j * unit(one.direction) * against * radius
    acting = replace(one, symbol=one.symbol.replace("F", "R", 1), at=one.at + aside, gap=radius)
    return Inclined(acting, pair, one.at, radius)


def _done(reading: RubbedReading, pair: FrictionPair, force: float) -> float:
    """Return the fraction of a force's friction that one correction includes, at most 1."""
    rub = reading.friction.rub(pair, reading.friction.corrected)
    friction = float(rub[reading.index])
    return min(1.0, friction / (pair.coefficient * force))


def _off_normal(reading: RubbedReading, pair: FrictionPair, one: Acting, sign: float) -> Inclined:
    """Incline the force of a guide against the sliding."""
    index = reading.index
    rub = -sign * pair.sense[index] * complex(pair.direction[index]) * pair.f * abs(one.direction)
    whole = abs(complex(reading.friction.corrected.reactions[pair.number][index]))
    rub *= _done(reading, pair, max(whole, 1e-12)) if one.symbol.count("'") == 0 else 1.0
    symbol = one.symbol.replace("F", "R", 1)
    acting = replace(one, symbol=symbol, direction=one.direction + rub)
    return Inclined(acting, pair, one.at, normal=one.direction)


@drawn_once
def friction_picture(
    reading: RubbedReading, number: int, letter_height: float, notation: Notation
) -> Picture:
    """Return the links of a force plan cut free, with loads and inclined reactions, mm."""
    plan, index, solution = reading.plans[number], reading.index, reading.solution
    scheme = FreeBodyScheme(solution, index, letter_height, links=plan.links)
    prefix = f"rubbed {index} {number}"
    places = [
        [reading.place(PointName(point)) for point in solution.problem.bodies[link].points]
        for link in plan.links
    ]
    bars: list[Segment] = [pair for ends in places for pair in combinations(ends, 2)]
    guided = pressed(reading, plan.links, bars, scheme.factor)
    found = list(_reactions(reading, plan.links, guided))
    inclined = [one for one in found if isinstance(one, Inclined)]
    forces = [one.acting if isinstance(one, Inclined) else one for one in found]
    couples: list[CoupleArc] = []
    replaced = {symbol for one in guided for symbol in one.replaced}
    for given in reading.statics.board.given:
        one = given.applied
        if one.kind is LoadKind.FRICTION or one.link not in plan.links:
            continue
        if given.force is not None and abs(complex(one.force[index])) > 1e-9 * reading.peak:
            at, way = reading.place(given.force.at), reading.drawn_direction(given.force)
            forces.append(Acting(notation.symbol(one.name), at, way))
        elif given.couple is not None:
            couple = CoupleOn(one.name, one.link, given.couple)
            if not reading.is_no_couple(couple):
                couples.append(turning(reading, scheme, couple, notation))
    forces += [
        Acting(notation.symbol(edge.symbol), reading.place(edge.at), reading.drawn_direction(edge))
        for edge in reading.shown(plan)
        if edge.symbol in reading.balancing_symbols
    ]
    couples += [
        turning(reading, scheme, couple, notation)
        for couple in reading.couples(plan)
        if (couple.symbol in reading.balancing_symbols or couple.symbol.startswith("M_{"))
        and couple.symbol not in replaced
        and couple.symbol not in {one.symbol for one in couples}
        and couple.at is not None
    ]
    items = [*drawn_items(scheme), *point_items(guided, scheme.factor)]
    lines = [part for parts in scheme.segments.values() for part in parts]
    joints = [scheme.at(point) for point in scheme.named]
    placed = place_force_arrows(forces, lines, joints, gap=SIZES.joint / 2 * scheme.factor + 0.5)
    arrows, labels = force_items(placed, letter_height, prefix)
    marks, letters = _marks(reading, inclined, placed, letter_height, prefix)
    items += [*marks, *arrows]
    turns, more = couple_items(couples, items, letter_height, prefix)
    return lettered(
        [*items, *turns], [*labels, *more, *letters, *letters_of(scheme, prefix, plan.links)]
    )


def _marks(
    reading: RubbedReading,
    inclined: list[Inclined],
    placed: list[tuple[Acting, Segment]],
    height: float,
    prefix: str,
) -> tuple[list[Item], list[Label]]:
    """Return circles, the normals with the angle of friction, and their letters."""
    items: list[Item] = []
    labels: list[Label] = []
    arrows = {id(acting): on_action(acting, arrow) for acting, arrow in placed}
    for k, one in enumerate(inclined):
        pair = one.pair
        index = f"{pair.on}{pair.frame if pair.by == FRAME else pair.by}"
        letter = f"{'φ' if pair.slide is not None else 'ρ'}_{{{index}}}"
        name = f"{prefix} friction {k}: {letter}"
        tag = f"{CONE if pair.slide is not None else CIRCLE} {letter}"
        arrow = arrows.get(id(one.acting))
        if arrow is None:
            continue
        if pair.slide is None:
            items.append(Arc(one.centre, one.radius, pen=Pen.THIN, tag=tag))
            foot = one.acting.at
            near = min(arrow, key=lambda end: abs(end - foot))
            if abs(near - foot) > 0.5:
                items.append(Stroke((foot, near), Pen.THIN, tag=tag))
            away = one.centre - foot
            labels.append(
                Label(
                    typeset(letter, height),
                    one.centre,
                    prefer=away,
                    gap=one.radius + 1.0,
                    name=name,
                )
            )
            continue
        middle = sum(arrow) / 2 - one.acting.at
        side = 1.0 if (middle * one.acting.direction.conjugate()).real > 0 else -1.0
        normal = side * unit(one.normal)
        reach = max(_REACH, abs(middle) + 12.0)
        other = (
            normal * cmath.exp(1j * radians(pair.phi)),
            normal * cmath.exp(-1j * radians(pair.phi)),
        )
        at = one.acting.at
        items.append(Stroke((at, at + reach * normal), Pen.AXIS, tag=tag))
        items += [Stroke((at, at + reach * way), Pen.THIN, tag=tag) for way in other]
        start = atan2(other[1].imag, other[1].real)
        radius = reach - 3.0
        items.append(Arc(at, radius, start, start + 2 * radians(pair.phi), Pen.THIN, tag))
        place = at + radius * normal
        labels.append(Label(typeset(letter, height), place, prefer=normal, gap=3.5, name=name))
    return items, labels
