"""Legs of a group on its force plan: components of reactions, guides (поводки).

The moment of a revolute leg's loads about its inner joint gives the tangential component of its
outer reaction; a guide's reaction is perpendicular to it, and the moment about the pin gives its
point of application.
"""

from __future__ import annotations

from collections.abc import Sequence

from msgspec.structs import replace

from planmethod.construct.steps import PointName
from planmethod.mechanism.groups import OuterLeg
from planmethod.mechanism.model import Revolute
from planmethod.plans.forces.board import Force, ForceBoard
from planmethod.plans.forces.polygons import (
    Components,
    CoupleOn,
    Edge,
    Moments,
    as_known,
    reaction_edge,
    reaction_symbol,
)
from planmethod.plans.motion.legs import arm, track_direction
from planmethod.plans.motion.position import outer_point, slide_of
from planmethod.problem.model import Slide


def tangent(
    board: ForceBoard, leg: OuterLeg, origin: PointName, middle: PointName
) -> tuple[PointName, Components | None]:
    """Lay off the tangential reaction of a revolute leg: its moment about the middle joint.

    A guide has none: its reaction is across it.
    """
    if not isinstance(leg.joint, Revolute):
        return origin, None
    outer = outer_point(leg)
    lever = arm(board.draft, leg.link, outer, middle)
    moment = board.moment((leg.link,), middle)
    end = board.lay_off_tangential(origin, lever.line, moment, lever.length)
    return end, Components(
        leg, board.called(leg.to), PointName(outer), (outer, str(middle)), lever.length
    )


def guide_reaction(board: ForceBoard, leg: OuterLeg, force: Force, inner: Edge) -> CoupleOn:
    """Note the reaction of a guide: its moment about the pin balances those of all other forces.

    ``inner`` is the reaction of the middle joint on the slider.
    """
    pin = PointName(slide_of(board.draft, leg.joint).pin)
    acting = Force(inner.at, *inner.ends, inner.symbol)
    couple = board.negative(board.moment((leg.link,), pin, acting))
    return board.react_guide(pin, leg.link, leg.to, replace(force, at=pin), couple)


def guide_edge(board: ForceBoard, leg: OuterLeg, tail: PointName, head: PointName) -> Edge:
    """Return the reaction of a guide, which is across it."""
    slide = slide_of(board.draft, leg.joint)
    direction = track_direction(slide, board.draft.problem, perpendicular=True)
    return reaction_edge(
        leg.link, board.called(leg.to), PointName(slide.pin), tail, head, direction
    )


def of_guide(couple: CoupleOn, edges: Sequence[Edge], known: tuple[CoupleOn, ...]) -> Moments:
    """Return the moments about the pin of a slider, which give the moment of its guide."""
    assert couple.at is not None
    return Moments((couple.on,), couple.at, tuple(map(as_known, edges)), known, couple=couple)


def pressed_block(board: ForceBoard, slide: Slide, force: Force, loads: Sequence[Edge]) -> Moments:
    """Note the reaction of a block on the bar through it, by the moments about its own joint."""
    known = board.couples_on(slide.host)
    held = board.negative(board.moment((slide.host,), force.at))
    board.react_guide(slide.pin, slide.slider, slide.host, force, board.negative(held), inner=True)
    symbol = reaction_symbol(slide.host, slide.slider, letter="M")
    couple = CoupleOn(symbol, slide.host, held, force.at)
    return of_guide(couple, loads, known)
