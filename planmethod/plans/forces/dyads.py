"""Force plans of the dyads and of the driver, from the last group to the first (кинетостатика).

Each dyad by the textbook's recipe: tangential components from moments about the middle joint, then
one force plan of the whole group that its two remaining directions close; the inner reaction from
the plan of one link. Prismatic pairs give a force across the guide, and a moment about the pin from
which its point of application follows.

Source: the order of force analysis in the homework guide's section 1, list a to d, for a dyad with
a force on every link.
"""

from __future__ import annotations

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.mechanism.groups import AssurGroup, OuterLeg, triad_of
from planmethod.mechanism.model import FRAME, Revolute
from planmethod.plans.forces.board import (
    Force,
    ForceBoard,
    guide_edge,
    guide_reaction,
    of_guide,
    pressed_block,
    tangent,
)
from planmethod.plans.forces.meshes import toothed_forces
from planmethod.plans.forces.polygons import (
    Balance,
    Components,
    CoupleOn,
    Edge,
    ForcePlan,
    Moments,
    as_known,
    back,
    reaction_edge,
)
from planmethod.plans.forces.triads import triad_forces
from planmethod.plans.model import Direction, Ends, KnownParts, Relation
from planmethod.plans.motion.legs import arm, track_direction
from planmethod.plans.motion.position import (
    inner_point,
    outer_point,
    rpr_parts,
    slide_of,
    split,
)
from planmethod.problem.model import Drive, OtherDrive
from planmethod.problem.records import BalancingForceTask


class Driving(Struct, frozen=True):
    """Balance of the driving link (уравновешивающий момент, уравновешивающая сила).

    Attributes
    ----------
    balance : NumberName
        Moment on a crank, N·m, counter-clockwise positive, or force on a slider, N, positive in the
        direction of its guide; or force at a point of a crank, N, positive as the file directs it.
    force : Force or None
        The force on a slider, or at a point of a crank.
    moment : NumberName or None
        Moment on a crank, N·m, also if a force balances it.
    direction : (PointName, PointName) or None
        A segment in the direction that the file gives the force at a point of a crank; None where
        that is across the crank.
    between : (str, str) or None
        The ends of an actuator: ``force`` acts on the second, positive if it pushes them apart.
    motor : (str, str) or None
        The links of a motor between moving links: the moment acts on the second.
    """

    balance: NumberName
    force: Force | None = None
    moment: NumberName | None = None
    direction: Ends | None = None
    between: tuple[str, str] | None = None
    motor: tuple[str, str] | None = None


def group_forces(board: ForceBoard, group: AssurGroup) -> None:
    """Find the reactions in all joints of a dyad or a triad."""
    if group.is_toothed:
        toothed_forces(board, group)
        return
    triad = triad_of(group)
    match group.signature:
        case _ if triad is not None:
            triad_forces(board, group, triad)
        case "RRR" | "RRP" | "PRP":
            _middle_revolute(board, group)
        case "RPR":
            _swinging(board, group)
        case "RPP":
            _sliding(board, group)


def _middle_revolute(board: ForceBoard, group: AssurGroup) -> None:
    """RRR, RRP, PRP: the parts of both outer reactions not found by moments close the plan."""
    middle = PointName(inner_point(group))
    one, two = split(group)
    start = board.start()
    first, at_one = tangent(board, one, start, middle)
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    between = board.chain(first, one.link, loads[0])
    loaded = board.chain(between, two.link, loads[1])
    last, at_two = tangent(board, two, loaded, middle)
    lines = _unknown(board, one, start, middle), _unknown(board, two, last, middle)
    end = board.draft.b.intersect_lines(board.name("x"), *lines)
    held = ((end, first), (loaded, end))  # both outer reactions
    outer = (
        _outer(board, one, at_one, (end, start), (start, first), held[0]),
        _outer(board, two, at_two, (last, end), (loaded, last), held[1]),
    )
    polygon = (*outer[0], *loads[0], *loads[1], *outer[1][::-1])
    inner = reaction_edge(one.link, two.link, middle, between, end)
    known = (board.couples_on(one.link), board.couples_on(two.link))
    wholes, moments, guides = [], [], []
    for lead, parts, ends, sides, own, couples, force in (
        (one, at_one, held[0], outer[0], loads[0], known[0], inner),
        (two, at_two, held[1], outer[1], loads[1], known[1], back(inner, two.link)),
    ):
        if parts is None:
            guide = guide_reaction(board, lead, Force(middle, *ends), force)
            guides.append(guide)
            moments.append(of_guide(guide, [*own, force], couples))
            continue
        whole = parts.total(*ends)
        board.react(parts.at, lead.link, lead.to, Force(parts.at, *whole.ends))
        wholes.append(whole)
        moments.append(Moments((lead.link,), middle, tuple(own), couples, sides[1], arm=parts.arm))
    board.react(middle, one.link, two.link, Force(middle, *inner.ends), inner=True)
    of_one = as_known(outer[0][0] if at_one is None else wholes[0])
    balances = (
        Balance(group.links, polygon),
        Balance((one.link,), (of_one, *loads[0], inner)),
    )
    known_couples = (*known[0], *known[1], *guides)
    board.read_off(
        ForcePlan(
            group.links, polygon, tuple(wholes), (inner,), balances, tuple(moments), known_couples
        )
    )


def _unknown(board: ForceBoard, leg: OuterLeg, through: PointName, middle: PointName) -> LineName:
    """Draw the line of an outer reaction's unknown part: along the link, across the guide."""
    b = board.draft.b
    if isinstance(leg.joint, Revolute):
        return b.parallel(through, arm(board.draft, leg.link, outer_point(leg), middle).line)
    return b.perpendicular(through, board.draft.direction(slide_of(board.draft, leg.joint)))


def _outer(
    board: ForceBoard,
    leg: OuterLeg,
    parts: Components | None,
    normal: Ends,
    tangential: Ends,
    total: Ends,
) -> tuple[Edge, ...]:
    """Return the sides of an outer reaction: normal and tangential, or that across the guide."""
    if parts is None:
        return (guide_edge(board, leg, *total),)
    return parts.normal(*normal), parts.tangential(*tangential)


def _swinging(board: ForceBoard, group: AssurGroup) -> None:
    """RPR: the moment of the whole group about the host's joint, the slider's plan closes it."""
    b = board.draft.b
    slide, host, slider = rpr_parts(board.draft, group)
    at, pivot = PointName(outer_point(slider)), PointName(outer_point(host))
    line = b.join(at, pivot)
    apart = board.draft.measured(at, pivot)
    moment = board.moment((slider.link, host.link), pivot)
    start = board.start()
    over = ((apart, 1), (board.draft.mu_l, 1))
    first = board.lay_off_tangential(start, line, moment, over)
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    between = board.chain(first, slider.link, loads[0])
    end = b.intersect_lines(
        board.name("x"),
        b.parallel(start, line),
        b.perpendicular(between, board.draft.direction(slide)),
    )
    loaded = board.chain(between, host.link, loads[1])
    hinged = Components(slider, board.called(slider.to), at, (str(at), str(pivot)), over)
    two = (hinged.normal(end, start), hinged.tangential(start, first))
    whole = hinged.total(end, first)
    stands = reaction_edge(host.link, board.called(host.to), pivot, loaded, end)
    direction = track_direction(slide, board.draft.problem, perpendicular=True)
    inner = reaction_edge(slider.link, host.link, at, between, end, direction)
    known = board.couples_on(*group.links)
    board.react(at, slider.link, slider.to, Force(at, end, first))
    board.react(pivot, host.link, host.to, Force(pivot, loaded, end))
    if board.draft.problem.is_block(slide):
        weighed = pressed_block(board, slide, Force(pivot, between, end), loads[1])
    else:
        couple = board.negative(board.moment((slider.link,), at))
        of_slider = board.couples_on(slider.link)
        pressed = Force(at, between, end)
        held = board.react_guide(slide.pin, slider.link, host.link, pressed, couple, inner=True)
        weighed = of_guide(held, loads[0], of_slider)
    polygon = (*two, *loads[0], *loads[1], stands)
    board.read_off(
        ForcePlan(
            group.links,
            polygon,
            (whole,),
            (inner,),
            (
                Balance((slider.link,), (*two, *loads[0], inner)),
                Balance(group.links, (as_known(whole), *loads[0], *loads[1], stands)),
            ),
            (
                Moments(group.links, pivot, (*loads[0], *loads[1]), known, two[1], arm=over),
                weighed,
            ),
            known,
        )
    )


def _sliding(board: ForceBoard, group: AssurGroup) -> None:
    """RPP: the plan of the link between two guides gives both forces across them."""
    b = board.draft.b
    revolute, prismatic = split(group)
    outer, inner = slide_of(board.draft, prismatic.joint), slide_of(board.draft, group.inner[0])
    at = PointName(outer_point(revolute))
    start = board.start()
    loads: tuple[list[Edge], list[Edge]] = ([], [])
    loaded = board.chain(start, prismatic.link, loads[1])
    end = b.intersect_lines(
        board.name("x"),
        b.perpendicular(start, board.draft.direction(inner)),
        b.perpendicular(loaded, board.draft.direction(outer)),
    )
    first = board.back(start, revolute.link, loads[0])
    own = board.moment((revolute.link,), at)
    pin = PointName(outer.pin)
    whole = board.moment((revolute.link, prismatic.link), pin, Force(at, end, first))
    across = guide_edge(board, prismatic, loaded, end)
    hinge = reaction_edge(revolute.link, board.called(revolute.to), at, end, first)
    direction = track_direction(inner, board.draft.problem, perpendicular=True)
    between = reaction_edge(prismatic.link, revolute.link, at, end, start, direction)
    known, of_one = board.couples_on(*group.links), board.couples_on(revolute.link)
    board.react(at, revolute.link, revolute.to, Force(at, end, first))
    across_pin = Force(pin, loaded, end)
    guide = board.react_guide(
        outer.pin, prismatic.link, prismatic.to, across_pin, board.negative(whole)
    )
    pressed = Force(at, start, end)
    held = board.react_guide(
        inner.pin, revolute.link, prismatic.link, pressed, board.negative(own), inner=True
    )
    board.read_off(
        ForcePlan(
            group.links,
            (hinge, *loads[0], *loads[1], across),
            (),
            (between,),
            (
                Balance((prismatic.link,), (between, *loads[1], across)),
                Balance((revolute.link,), (hinge, *loads[0], back(between, revolute.link))),
            ),
            (
                of_guide(held, loads[0], of_one),
                replace(of_guide(guide, [hinge, *loads[0], *loads[1]], known), links=group.links),
            ),
            (*known, guide),
        )
    )


def other_driver_forces(board: ForceBoard, drive: OtherDrive) -> Driving:
    """Find the balance of another driving link, and the reaction of the frame on it."""
    symbol = f"{board.draft.problem.balancer_of(drive)}"
    return _balance_on_frame(board, drive, symbol)


def unbalanced(board: ForceBoard) -> NumberName:
    """Return the residual of the driving link's forces: a moment, N·m, or along its guide, N."""
    drive = board.draft.problem.drive
    if drive.pivot is not None:
        return board.moment((drive.link,), PointName(drive.pivot))
    b, start = board.draft.b, board.start()
    loaded = board.chain(start, drive.link, [])
    guide = board.draft.direction(board.draft.problem.slides[drive.link])
    end = b.intersect_lines(
        board.name("x"), b.parallel(loaded, guide), b.perpendicular(start, guide)
    )
    return board.segments.read_signed(end, loaded, guide, "F_x")


def resting_driver_forces(board: ForceBoard) -> NumberName:
    """Find the reaction of the frame on a driving link that its forces leave in equilibrium.

    Return the residual of the plans, N·m, or N along its guide: zero if they are exact.
    """
    b, drive, start = board.draft.b, board.draft.problem.drive, board.start()
    links, loads = (drive.link,), list[Edge]()
    loaded = board.chain(start, drive.link, loads)
    known, called = board.couples_on(drive.link), board.called(FRAME)
    if drive.pivot is not None:
        at = PointName(drive.pivot)
        left = board.moment(links, at)
        board.react(drive.pivot, drive.link, FRAME, Force(at, loaded, start))
        stands = reaction_edge(drive.link, called, at, loaded, start)
        moments = Moments(links, at, tuple(loads), known)
    else:
        problem = board.draft.problem
        slide = problem.slides[drive.link]
        at, guide = PointName(slide.pin), board.draft.direction(slide)
        lines = b.parallel(loaded, guide), b.perpendicular(start, guide)
        end = b.intersect_lines(board.name("x"), *lines)
        left = board.segments.read_signed(end, loaded, guide, "F_x")
        couple = board.negative(board.moment(links, at))
        held = board.react_guide(slide.pin, drive.link, FRAME, Force(at, end, start), couple)
        direction = track_direction(slide, problem, perpendicular=True)
        stands = reaction_edge(drive.link, called, at, end, start, direction)
        moments, known = of_guide(held, loads, known), (*known, held)
    polygon = (*loads, stands)
    balances = (Balance(links, polygon),)
    board.read_off(ForcePlan(links, polygon, balances=balances, moments=(moments,), couples=known))
    return left


def drive_forces(board: ForceBoard) -> Driving:
    """Find the balance of the driving link, and the reaction of the frame."""
    drive = board.draft.problem.drive
    symbol = board.draft.problem.balancer.symbol
    return _balance_on_frame(board, drive, symbol, pushed=drive.pushed)


def _balance_on_frame(
    board: ForceBoard,
    drive: Drive | OtherDrive,
    symbol: str,
    *,
    pushed: BalancingForceTask | None = None,
) -> Driving:
    """Balance a link on the frame by a moment, or by a force along its guide."""
    b, links = board.draft.b, (drive.link,)
    start = board.start()
    loads: list[Edge] = []
    loaded = board.chain(start, drive.link, loads)
    known = board.couples_on(drive.link)
    if drive.pivot is not None:
        pivot = PointName(drive.pivot)
        moment = board.negative(board.moment((drive.link,), pivot))
        if pushed is not None:
            return _pushed(board, pushed, pivot, (start, loaded), moment, loads)
        board.react(drive.pivot, drive.link, FRAME, Force(pivot, loaded, start))
        stands = reaction_edge(drive.link, board.called(FRAME), pivot, loaded, start)
        balancing = CoupleOn(symbol, drive.link, moment, pivot)
        board.read_off(
            ForcePlan(
                links,
                (*loads, stands),
                balances=(Balance(links, (*loads, stands)),),
                moments=(Moments(links, pivot, tuple(loads), known, couple=balancing),),
                couples=(*known, balancing),
            )
        )
        return Driving(moment, moment=moment)
    slide = board.draft.problem.slides[drive.link]
    guide, pin = board.draft.direction(slide), PointName(slide.pin)
    end = b.intersect_lines(
        board.name("x"), b.parallel(loaded, guide), b.perpendicular(start, guide)
    )
    couple = board.negative(board.moment((drive.link,), pin))
    held = board.react_guide(slide.pin, drive.link, FRAME, Force(pin, end, start), couple)
    problem = board.draft.problem
    direction = track_direction(slide, problem)
    drives = Edge(symbol, drive.link, pin, loaded, end, KnownParts.ONE, direction)
    direction = track_direction(slide, problem, perpendicular=True)
    presses = reaction_edge(drive.link, board.called(FRAME), pin, end, start, direction)
    balance = board.segments.read_signed(loaded, end, guide, "F_dr")
    board.read_off(
        ForcePlan(
            links,
            (*loads, drives, presses),
            balances=(Balance(links, (*loads, drives, presses)),),
            moments=(of_guide(held, loads, known),),
            couples=(*known, held),
        )
    )
    return Driving(balance, Force(pin, loaded, end, symbol))


def _pushed(
    board: ForceBoard,
    task: BalancingForceTask,
    pivot: PointName,
    ends: Ends,
    moment: NumberName,
    loads: list[Edge],
) -> Driving:
    """Balance a crank by a force at one of its points: from moments; the plan is then closed.

    ``ends`` are the start of the plan and the end of its loads; ``moment`` is the required moment,
    N·m.
    """
    b, drive, (start, loaded) = board.draft.b, board.draft.problem.drive, ends
    links, at, known = (drive.link,), PointName(task.at), board.couples_on(drive.link)
    lever, along = arm(board.draft, drive.link, str(pivot), str(at)), None
    if task.angle is None:
        length = lever.length
        line = b.perpendicular(loaded, lever.line)
        direction = Direction(Relation.PERPENDICULAR, (str(pivot), str(at)))
    else:
        turned, one = board.known("angle", task.angle), board.known("1", 1.0)
        action = b.at_angle(at, None, turned)
        # Its intersection with the crank is the point itself; the crank's own line has no arm.
        met = b.intersect_lines(board.name("x"), lever.line, action)
        board.draft.letters[met] = task.at
        way = b.at_angle(board.pole, None, turned)
        along = board.pole, b.lay_off_length(board.name("u"), board.pole, way, one)
        measured = b.measure_arm(board.name("h"), pivot, met, *along)
        length, line = ((measured, 1), (board.draft.mu_l, 1)), b.at_angle(loaded, None, turned)
        direction = Direction(Relation.ANGLED, angle=task.angle)
    over = tuple((name, -power) for name, power in length)
    value = board.segments.compute("F_dr", (moment, 1), *over)
    end = board.segments.lay_off_vector(board.name("F"), loaded, line, value)
    board.react(str(pivot), drive.link, FRAME, Force(pivot, end, start))
    pushes = Edge(
        board.draft.problem.balancer.symbol, drive.link, at, loaded, end, direction=direction
    )
    stands = reaction_edge(drive.link, board.called(FRAME), pivot, end, start)
    board.read_off(
        ForcePlan(
            links,
            (*loads, pushes, stands),
            balances=(Balance(links, (*loads, replace(pushes, direction=None), stands)),),
            moments=(Moments(links, pivot, tuple(loads), known, pushes, arm=length),),
            couples=known,
        )
    )
    return Driving(
        value, Force(at, loaded, end, board.draft.problem.balancer.symbol), moment, along
    )
