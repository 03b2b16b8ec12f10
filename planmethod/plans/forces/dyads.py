"""Force plans of the dyads and of the driver, from the last group to the first (кинетостатика).

Each dyad by the textbook's recipe: tangential components from moments about the middle joint, then
one force plan of the whole group that its two remaining directions close; the inner reaction from
the plan of one link. Prismatic pairs give a force across the guide, and a moment about the pin from
which its point of application follows.

Source: the order of force analysis in the homework guide's section 1, list a to d, for a dyad with
a force on every link.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.groups import AssurGroup, Lead
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import Board, Force
from planmethod.plans.forces.polygons import (
    BALANCING_FORCE,
    BALANCING_MOMENT,
    Balance,
    Components,
    CoupleOn,
    Edge,
    ForcePlan,
    Moments,
    as_known,
    back,
    reaction_edge,
    reaction_symbol,
)
from planmethod.plans.model import Known
from planmethod.plans.motion.board import mark
from planmethod.plans.motion.leads import arm, track_note
from planmethod.plans.motion.position import (
    inner_point,
    lead_point,
    rpr_parts,
    slide_of,
    split,
)
from planmethod.problem.model import Slide


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


def _tangent(
    board: Board, lead: Lead, origin: PointName, middle: str
) -> tuple[PointName, Components]:
    """Lay off the tangential reaction of a revolute lead: its moment about the middle joint."""
    outer = lead_point(lead)
    lever = arm(board.draft, lead.link, outer, middle)
    moment = board.moment((lead.link,), PointName(middle))
    end = board.across(origin, lever.line, moment, lever.length)
    return end, Components(lead, PointName(outer), mark(outer, middle))


def _two_revolute(board: Board, group: AssurGroup) -> None:
    b, middle = board.draft.b, PointName(inner_point(group))
    one, two = group.leads
    start = board.start()
    first, at_one = _tangent(board, one, start, middle)
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    between = board.chain(first, one.link, loads[0])
    loaded = board.chain(between, two.link, loads[1])
    last, at_two = _tangent(board, two, loaded, middle)
    lines = (
        b.parallel(start, arm(board.draft, one.link, lead_point(one), middle).line),
        b.parallel(last, arm(board.draft, two.link, lead_point(two), middle).line),
    )
    end = b.meet_lines(board.name("x"), *lines)
    edges = (
        at_one.normal(end, start),
        at_one.tangential(start, first),
        at_two.tangential(loaded, last),
        at_two.normal(last, end),
    )
    polygon = (*edges[:2], *loads[0], *loads[1], *edges[2:])
    wholes = (at_one.whole(end, first), at_two.whole(loaded, end))
    inner = reaction_edge(one.link, two.link, middle, between, end)
    board.plans.append(
        ForcePlan(
            group.links,
            polygon,
            wholes,
            inner,
            (
                Balance(group.links, polygon),
                Balance((one.link,), (as_known(wholes[0]), *loads[0], inner)),
            ),
            (
                Moments((one.link,), middle, tuple(loads[0]), board.couples_on(one.link), edges[1]),
                Moments((two.link,), middle, tuple(loads[1]), board.couples_on(two.link), edges[2]),
            ),
            board.couples_on(*group.links),
        )
    )
    for lead, tail, head in ((one, end, first), (two, loaded, end)):
        at = PointName(lead_point(lead))
        board.react(at, lead.link, lead.to, Force(at, tail, head))
    board.react(middle, one.link, two.link, Force(middle, between, end), inner=True)


def _revolute_and_slider(board: Board, group: AssurGroup) -> None:
    b, middle = board.draft.b, PointName(inner_point(group))
    revolute, prismatic = split(group)
    slide = slide_of(board.draft, prismatic.joint)
    start = board.start()
    first, hinged = _tangent(board, revolute, start, middle)
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    between = board.chain(first, revolute.link, loads[0])
    loaded = board.chain(between, prismatic.link, loads[1])
    end = b.meet_lines(
        board.name("x"),
        b.parallel(start, arm(board.draft, revolute.link, lead_point(revolute), middle).line),
        b.perpendicular(loaded, board.draft.direction(slide)),
    )
    pressed = _guide_edge(board, prismatic, loaded, end)
    two = (hinged.normal(end, start), hinged.tangential(start, first))
    whole = hinged.whole(end, first)
    polygon = (*two, *loads[0], *loads[1], pressed)
    inner = reaction_edge(revolute.link, prismatic.link, middle, between, end)
    known = (board.couples_on(revolute.link), board.couples_on(prismatic.link))
    at = PointName(lead_point(revolute))
    board.react(at, revolute.link, revolute.to, Force(at, end, first))
    back_on_slider = Force(middle, end, between, read=True)
    guide = _guide_reaction(board, prismatic, Force(middle, loaded, end), back_on_slider)
    board.react(middle, revolute.link, prismatic.link, Force(middle, between, end), inner=True)
    board.plans.append(
        ForcePlan(
            group.links,
            polygon,
            (whole,),
            inner,
            (
                Balance(group.links, polygon),
                Balance((revolute.link,), (as_known(whole), *loads[0], inner)),
            ),
            (
                Moments((revolute.link,), middle, tuple(loads[0]), known[0], two[1]),
                _of_guide(guide, [*loads[1], back(inner, prismatic.link)], known[1]),
            ),
            (*known[0], *known[1], guide),
        )
    )


def _two_sliders(board: Board, group: AssurGroup) -> None:
    b, middle = board.draft.b, PointName(inner_point(group))
    one, two = group.leads
    start = board.start()
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    between = board.chain(start, one.link, loads[0])
    loaded = board.chain(between, two.link, loads[1])
    guides = [board.draft.direction(slide_of(board.draft, lead.joint)) for lead in (one, two)]
    end = b.meet_lines(
        board.name("x"), b.perpendicular(start, guides[0]), b.perpendicular(loaded, guides[1])
    )
    pressed = (_guide_edge(board, one, end, start), _guide_edge(board, two, loaded, end))
    polygon = (pressed[0], *loads[0], *loads[1], pressed[1])
    inner = reaction_edge(one.link, two.link, middle, between, end)
    known = (board.couples_on(one.link), board.couples_on(two.link))
    found = (
        _guide_reaction(
            board, one, Force(middle, end, start), Force(middle, between, end, read=True)
        ),
        _guide_reaction(
            board, two, Force(middle, loaded, end), Force(middle, end, between, read=True)
        ),
    )
    board.react(middle, one.link, two.link, Force(middle, between, end), inner=True)
    board.plans.append(
        ForcePlan(
            group.links,
            polygon,
            (),
            inner,
            (
                Balance(group.links, polygon),
                Balance((one.link,), (as_known(pressed[0]), *loads[0], inner)),
            ),
            (
                _of_guide(found[0], [*loads[0], inner], known[0]),
                _of_guide(found[1], [*loads[1], back(inner, two.link)], known[1]),
            ),
            (*known[0], *known[1], *found),
        )
    )


def _guide_reaction(board: Board, lead: Lead, force: Force, inner: Force) -> CoupleOn:
    """Note the reaction of a guide: its moment about the pin balances those of all other forces."""
    pin = PointName(slide_of(board.draft, lead.joint).pin)
    couple = board.negative(board.moment((lead.link,), pin, inner))
    return board.press(pin, lead.link, lead.to, replace(force, at=pin), couple)


def _guide_edge(board: Board, lead: Lead, tail: PointName, head: PointName) -> Edge:
    """Return the reaction of a guide, which is across it."""
    slide = slide_of(board.draft, lead.joint)
    note = track_note(slide, board.draft.problem, turned=True)
    return reaction_edge(lead.link, lead.to, PointName(slide.pin), tail, head, note)


def _of_guide(couple: CoupleOn, edges: Sequence[Edge], known: tuple[CoupleOn, ...]) -> Moments:
    """Return the moments about the pin of a slider, which give the moment of its guide."""
    assert couple.at is not None
    return Moments((couple.on,), couple.at, tuple(map(as_known, edges)), known, couple=couple)


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
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    between = board.chain(first, slider.link, loads[0])
    end = b.meet_lines(
        board.name("x"),
        b.parallel(start, line),
        b.perpendicular(between, board.draft.direction(slide)),
    )
    loaded = board.chain(between, host.link, loads[1])
    hinged = Components(slider, at, mark(at, pivot))
    two = (hinged.normal(end, start), hinged.tangential(start, first))
    whole = hinged.whole(end, first)
    stands = reaction_edge(host.link, host.to, pivot, loaded, end)
    note = track_note(slide, board.draft.problem, turned=True)
    inner = reaction_edge(slider.link, host.link, at, between, end, note)
    known = board.couples_on(*group.links)
    board.react(at, slider.link, slider.to, Force(at, end, first))
    board.react(pivot, host.link, host.to, Force(pivot, loaded, end))
    if board.draft.problem.is_block(slide):
        weighed = _pressed_block(board, slide, Force(pivot, between, end), loads[1])
    else:
        couple = board.negative(board.moment((slider.link,), at))
        of_slider = board.couples_on(slider.link)
        pressed = Force(at, between, end)
        held = board.press(slide.pin, slider.link, host.link, pressed, couple, inner=True)
        weighed = _of_guide(held, loads[0], of_slider)
    polygon = (*two, *loads[0], *loads[1], stands)
    board.plans.append(
        ForcePlan(
            group.links,
            polygon,
            (whole,),
            inner,
            (
                Balance((slider.link,), (*two, *loads[0], inner)),
                Balance(group.links, (as_known(whole), *loads[0], *loads[1], stands)),
            ),
            (
                Moments(group.links, pivot, (*loads[0], *loads[1]), known, two[1]),
                weighed,
            ),
            known,
        )
    )


def _pressed_block(board: Board, slide: Slide, force: Force, loads: Sequence[Edge]) -> Moments:
    """Note the reaction of a block on the bar through it, by the moments about its own joint."""
    known = board.couples_on(slide.host)
    held = board.negative(board.moment((slide.host,), force.at))
    board.press(slide.pin, slide.slider, slide.host, force, board.negative(held), inner=True)
    symbol = reaction_symbol(slide.host, slide.slider, letter="M")
    couple = CoupleOn(symbol, slide.host, held, force.at)
    return _of_guide(couple, loads, known)


def _sliding(board: Board, group: AssurGroup) -> None:
    """RPP: the plan of the link between two guides gives both forces across them."""
    b = board.draft.b
    revolute, prismatic = split(group)
    outer, inner = slide_of(board.draft, prismatic.joint), slide_of(board.draft, group.inner[0])
    at = PointName(lead_point(revolute))
    start = board.start()
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    loaded = board.chain(start, prismatic.link, loads[1])
    end = b.meet_lines(
        board.name("x"),
        b.perpendicular(start, board.draft.direction(inner)),
        b.perpendicular(loaded, board.draft.direction(outer)),
    )
    first = board.back(start, revolute.link, loads[0])
    own = board.moment((revolute.link,), at)
    pin = PointName(outer.pin)
    whole = board.moment((revolute.link, prismatic.link), pin, Force(at, end, first, read=True))
    across = _guide_edge(board, prismatic, loaded, end)
    hinge = reaction_edge(revolute.link, revolute.to, at, end, first)
    note = track_note(inner, board.draft.problem, turned=True)
    between = reaction_edge(prismatic.link, revolute.link, at, end, start, note)
    known, of_one = board.couples_on(*group.links), board.couples_on(revolute.link)
    board.react(at, revolute.link, revolute.to, Force(at, end, first))
    across_pin = Force(pin, loaded, end)
    guide = board.press(outer.pin, prismatic.link, prismatic.to, across_pin, board.negative(whole))
    pressed = Force(at, start, end)
    held = board.press(
        inner.pin, revolute.link, prismatic.link, pressed, board.negative(own), inner=True
    )
    board.plans.append(
        ForcePlan(
            group.links,
            (hinge, *loads[0], *loads[1], across),
            (),
            between,
            (
                Balance((prismatic.link,), (between, *loads[1], across)),
                Balance((revolute.link,), (hinge, *loads[0], back(between, revolute.link))),
            ),
            (
                _of_guide(held, loads[0], of_one),
                replace(_of_guide(guide, [hinge, *loads[0], *loads[1]], known), links=group.links),
            ),
            (*known, guide),
        )
    )


def drive_forces(board: Board) -> Driving:
    """Find what balances the driving link, and the reaction of the frame."""
    b, drive = board.draft.b, board.draft.problem.drive
    links = (drive.link,)
    start = board.start()
    loads: list[Edge] = []
    loaded = board.chain(start, drive.link, loads)
    known = board.couples_on(drive.link)
    if drive.pivot is not None:
        pivot = PointName(drive.pivot)
        board.react(drive.pivot, drive.link, FRAME, Force(pivot, loaded, start))
        moment = board.negative(board.moment((drive.link,), pivot))
        stands = reaction_edge(drive.link, FRAME, pivot, loaded, start)
        balancing = CoupleOn(BALANCING_MOMENT, drive.link, moment, pivot)
        board.plans.append(
            ForcePlan(
                links,
                (*loads, stands),
                balances=(Balance(links, (*loads, stands)),),
                moments=(Moments(links, pivot, tuple(loads), known, couple=balancing),),
                couples=(*known, balancing),
            )
        )
        return Driving(moment=moment)
    slide = board.draft.problem.slides[drive.link]
    guide, pin = board.draft.direction(slide), PointName(slide.pin)
    end = b.meet_lines(board.name("x"), b.parallel(loaded, guide), b.perpendicular(start, guide))
    couple = board.negative(board.moment((drive.link,), pin))
    held = board.press(slide.pin, drive.link, FRAME, Force(pin, end, start), couple)
    problem = board.draft.problem
    drives = Edge(
        BALANCING_FORCE, drive.link, pin, loaded, end, Known.ONE, track_note(slide, problem)
    )
    note = track_note(slide, problem, turned=True)
    presses = reaction_edge(drive.link, FRAME, pin, end, start, note)
    board.plans.append(
        ForcePlan(
            links,
            (*loads, drives, presses),
            balances=(Balance(links, (*loads, drives, presses)),),
            moments=(_of_guide(held, loads, known),),
            couples=(*known, held),
        )
    )
    return Driving(force=Force(pin, loaded, end, BALANCING_FORCE), axis=guide)
