"""Force plans of the dyads and of the driver, from the last group to the first (кинетостатика).

Each dyad by the textbook's recipe: tangential components from moments about the middle joint, then
one force plan of the whole group that its two remaining directions close; the inner reaction from
the plan of one link. Prismatic pairs give a force across the guide, and a moment about the pin from
which its point of application follows.

Source: the order of force analysis in the homework guide's section 1, list a to d, for a dyad with
a force on every link.
"""

from __future__ import annotations

from dataclasses import dataclass

from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.groups import AssurGroup, Lead
from planmethod.mechanism.model import FRAME
from planmethod.plans.forceplan import Board, Force
from planmethod.plans.leads import arm
from planmethod.plans.position import (
    inner_point,
    lead_point,
    rpr_parts,
    slide_of,
    split,
)


@dataclass(frozen=True, slots=True)
class Driving:
    """What balances the driving link: a moment on a crank (N·m), or a force along a guide.

    ``axis`` is the line of that guide.
    """

    moment: NumberName | None = None
    force: Force | None = None
    axis: LineName | None = None


def group_forces(board: Board, group: AssurGroup) -> None:
    """Find the reactions in all joints of a dyad."""
    match group.signature:
        case "RRR":
            _two_revolute(board, group)
        case "RRP":
            _revolute_and_slider(board, group)
        case "PRP":
            _two_sliders(board, group)
        case "RPR":
            _swinging(board, group)
        case "RPP":
            _sliding(board, group)


def _tangent(board: Board, lead: Lead, origin: PointName, middle: str) -> PointName:
    """Lay off the tangential reaction of a revolute lead: its moment about the middle joint."""
    outer = lead_point(lead)
    lever = arm(board.draft, lead.link, outer, middle)
    moment = board.moment((lead.link,), PointName(middle))
    return board.across(origin, lever.line, moment, lever.length)


def _two_revolute(board: Board, group: AssurGroup) -> None:
    b, middle = board.draft.b, inner_point(group)
    one, two = group.leads
    start = board.start()
    first = _tangent(board, one, start, middle)
    between = board.chain(first, one.link)
    loaded = board.chain(between, two.link)
    last = _tangent(board, two, loaded, middle)
    lines = (
        b.parallel(start, arm(board.draft, one.link, lead_point(one), middle).line),
        b.parallel(last, arm(board.draft, two.link, lead_point(two), middle).line),
    )
    end = b.meet_lines(board.name("x"), *lines)
    for lead, tail, head in ((one, end, first), (two, loaded, end)):
        at = PointName(lead_point(lead))
        board.react(at, lead.link, lead.to, Force(at, tail, head))
    inner = Force(PointName(middle), between, end)
    board.react(middle, one.link, two.link, inner, inner=True)


def _revolute_and_slider(board: Board, group: AssurGroup) -> None:
    b, middle = board.draft.b, inner_point(group)
    revolute, prismatic = split(group)
    slide = slide_of(board.draft, prismatic.joint)
    start = board.start()
    first = _tangent(board, revolute, start, middle)
    between = board.chain(first, revolute.link)
    loaded = board.chain(between, prismatic.link)
    end = b.meet_lines(
        board.name("x"),
        b.parallel(start, arm(board.draft, revolute.link, lead_point(revolute), middle).line),
        b.perpendicular(loaded, board.draft.direction(slide)),
    )
    at = PointName(lead_point(revolute))
    board.react(at, revolute.link, revolute.to, Force(at, end, first))
    _guide_reaction(board, prismatic, Force(PointName(middle), loaded, end))
    inner = Force(PointName(middle), between, end)
    board.react(middle, revolute.link, prismatic.link, inner, inner=True)


def _two_sliders(board: Board, group: AssurGroup) -> None:
    b, middle = board.draft.b, PointName(inner_point(group))
    one, two = group.leads
    start = board.start()
    between = board.chain(start, one.link)
    loaded = board.chain(between, two.link)
    guides = [board.draft.direction(slide_of(board.draft, lead.joint)) for lead in (one, two)]
    end = b.meet_lines(
        board.name("x"), b.perpendicular(start, guides[0]), b.perpendicular(loaded, guides[1])
    )
    _guide_reaction(board, one, Force(middle, end, start))
    _guide_reaction(board, two, Force(middle, loaded, end))
    board.react(middle, one.link, two.link, Force(middle, between, end), inner=True)


def _guide_reaction(board: Board, lead: Lead, force: Force) -> None:
    """Note the reaction of a guide: its moment balances those of the slider's other loads."""
    couple = board.negative(board.moment((lead.link,), force.at))
    pin = slide_of(board.draft, lead.joint).pin
    board.react(pin, lead.link, lead.to, force, couple, pin=pin)


def _swinging(board: Board, group: AssurGroup) -> None:
    """RPR: the moment of the whole group about the host's joint, the slider's plan closes it."""
    b = board.draft.b
    slide, host, slider = rpr_parts(board.draft, group)
    at, pivot = PointName(lead_point(slider)), PointName(lead_point(host))
    line = b.join(at, pivot)
    apart = board.draft.measured(at, pivot)
    moment = board.moment((slider.link, host.link), pivot)
    start = board.start()
    first = board.across(start, line, moment, ((apart, 1), (board.draft.mu_l, 1)))
    between = board.chain(first, slider.link)
    end = b.meet_lines(
        board.name("x"),
        b.parallel(start, line),
        b.perpendicular(between, board.draft.direction(slide)),
    )
    loaded = board.chain(between, host.link)
    couple = board.negative(board.moment((slider.link,), at))
    board.react(at, slider.link, slider.to, Force(at, end, first))
    board.react(pivot, host.link, host.to, Force(pivot, loaded, end))
    pressed = Force(at, between, end)
    board.react(slide.pin, slider.link, host.link, pressed, couple, inner=True)


def _sliding(board: Board, group: AssurGroup) -> None:
    """RPP: the plan of the link between two guides gives both forces across them."""
    b = board.draft.b
    revolute, prismatic = split(group)
    outer, inner = slide_of(board.draft, prismatic.joint), slide_of(board.draft, group.inner[0])
    at = PointName(lead_point(revolute))
    start = board.start()
    loaded = board.chain(start, prismatic.link)
    end = b.meet_lines(
        board.name("x"),
        b.perpendicular(start, board.draft.direction(inner)),
        b.perpendicular(loaded, board.draft.direction(outer)),
    )
    first = board.back(start, revolute.link)
    own = board.moment((revolute.link,), at)
    other = board.moment((prismatic.link,), at)
    both = board.draft.b.total(board.name("M"), own, other)
    board.react(at, revolute.link, revolute.to, Force(at, end, first))
    board.react(
        outer.pin,
        prismatic.link,
        prismatic.to,
        Force(at, loaded, end),
        board.negative(both),
        pin=outer.pin,
    )
    pressed = Force(at, start, end)
    board.react(inner.pin, revolute.link, prismatic.link, pressed, board.negative(own), inner=True)


def drive_forces(board: Board) -> Driving:
    """Find what balances the driving link, and the reaction of the frame."""
    b, drive = board.draft.b, board.draft.problem.drive
    start = board.start()
    loaded = board.chain(start, drive.link)
    if drive.pivot is not None:
        pivot = PointName(drive.pivot)
        board.react(drive.pivot, drive.link, FRAME, Force(pivot, loaded, start))
        return Driving(moment=board.negative(board.moment((drive.link,), pivot)))
    slide = board.draft.problem.slides[drive.link]
    guide, pin = board.draft.direction(slide), PointName(slide.pin)
    end = b.meet_lines(board.name("x"), b.parallel(loaded, guide), b.perpendicular(start, guide))
    couple = board.negative(board.moment((drive.link,), pin))
    board.react(slide.pin, drive.link, FRAME, Force(pin, end, start), couple)
    return Driving(force=Force(pin, loaded, end), axis=guide)
