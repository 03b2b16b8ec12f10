"""Position plan: the mechanism drawn to scale by arcs and lines (план положений, метод засечек)."""

from __future__ import annotations

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.steps import Leg, LineName, NumberName, Place, PointName, TriadPose
from planmethod.errors import AssemblyError, StructureError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup, OuterLeg, Triad, triad_of
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import analyse
from planmethod.plans.draft import TINY, Draft, Special, cis, degrees, line_sense, side
from planmethod.plans.model import AssemblyMode, Dimension, DimensionKind, Start
from planmethod.plans.motion.meshes import place_toothed
from planmethod.problem.model import Drive, OtherDrive, Problem, Slide

EQUAL = 1e-9
"""Share of a length by which the opposite sides of a parallelogram may differ."""


def slide_of(draft: Draft, joint: Prismatic | Revolute) -> Slide:
    """Return the line of a prismatic pair."""
    assert isinstance(joint, Prismatic)
    return draft.problem.slides[joint.slider]


def has_two_modes(group: AssurGroup) -> bool:
    """Return whether the same links can be joined in two ways, so that a rule must choose."""
    return group.signature in ("RRR", "RRP", "RPR")


def place_frame(draft: Draft) -> None:
    """Take the fixed points as given, and draw the fixed guides."""
    for point, place in draft.problem.bodies[FRAME].points.items():
        draft.places[point] = place - draft.origin
        draft.b.take_point(point)
        draft.mark_placed(point)
    for slide in draft.problem.slides.values():
        if slide.host == FRAME:
            draft.line(slide)


def place_driver(draft: Draft) -> None:
    """Draw the driving link in the requested position."""
    drive = draft.problem.drive
    _place_on_frame(draft, drive, drive.program_inputs[0])
    for other in drive.other_drives:
        _place_on_frame(draft, other, other.program_inputs[0])


def _place_on_frame(draft: Draft, drive: Drive | OtherDrive, place: str) -> None:
    """Draw a crank at its angle, or a slider at its distance."""
    if drive.pivot is not None:
        phi = draft.b.known(place)
        draft.axes[drive.link] = draft.b.at_angle(PointName(drive.pivot), None, phi)
        draft.place_rest(drive.link)
        return
    slide = draft.problem.slides[drive.link]
    s = draft.b.compute(f"|{place}|", (draft.b.known(place), 1), (draft.mu_l, -1))
    draft.dimensions[s] = Dimension(DimensionKind.TRAVEL, (slide.pin,), "s")
    track = draft.path(slide, FRAME, slide.pin)
    draft.b.lay_off_length(slide.pin, track.origin, track.line, s)
    draft.mark_placed(slide.pin)
    draft.turn_with(slide, FRAME, PointName(slide.pin))
    draft.place_rest(drive.link)


def place_group(draft: Draft, group: AssurGroup) -> None:
    """Place the links of a dyad or a triad between the links it is joined to.

    Raises
    ------
    AssemblyError
        The group is neither: it is recognised, but these steps cannot build it.
    """
    if group.is_toothed or group.is_passive:
        if group.is_toothed:
            place_toothed(draft, group)
        draft.place_rest(group.links[0])
        return
    closing = draft.choice.get(group.links, AssemblyMode())
    triad = triad_of(group)
    if triad is None and not group.is_dyad:
        raise AssemblyError(*_refusal(draft.problem, group))
    match group.signature:
        case _ if triad is not None:
            _place_triad(draft, triad, closing)
        case "RRR" if closing.parallel:
            _place_parallel(draft, group)
        case "RRR":
            _place_rrr(draft, group, closing)
        case "RRP":
            _place_rrp(draft, group, closing)
        case "RPR":
            _place_rpr(draft, group, closing.side)
        case "PRP":
            _place_prp(draft, group)
        case "RPP":
            _place_rpp(draft, group)
        case _:
            raise AssemblyError("No recipe for a group {} of class II.", group.signature)
    for link in group.links:
        draft.place_rest(link)


def inner_point(group: AssurGroup) -> str:
    """Return the point of the inner revolute joint."""
    (joint,) = group.inner
    assert isinstance(joint, Revolute)
    return joint.point


def outer_point(leg: OuterLeg) -> str:
    """Return the point of a revolute outer joint."""
    assert isinstance(leg.joint, Revolute)
    return leg.joint.point


def split(group: AssurGroup) -> tuple[OuterLeg, OuterLeg]:
    """Return the legs with the revolute one first (a mixed dyad), else in the group's order."""
    first, second = group.legs
    if isinstance(first.joint, Prismatic) and isinstance(second.joint, Revolute):
        return second, first
    return first, second


def base_points(problem: Problem, triad: Triad) -> list[str]:
    """Return the points of a base link that locate it: its hinges first, two at least."""
    body = problem.bodies[triad.base].points
    hinges = [joint.point for _, joint in triad.legs if isinstance(joint, Revolute)]
    found = list(dict.fromkeys([*hinges, *body]))
    apart = next((point for point in found[1:] if body[point] != body[found[0]]), None)
    if apart is None:
        raise AssemblyError(
            "The base link {} of links {} does not have two points: add one.",
            triad.base,
            ", ".join([triad.base, *(lead.link for lead, _ in triad.legs)]),
        )
    return list(dict.fromkeys([found[0], apart, *hinges]))


def _place_triad(draft: Draft, triad: Triad, mode: AssemblyMode) -> None:
    """Hold the base link by all three legs at once; then the legs lie between two points each."""
    base = triad.base
    body, points = draft.problem.bodies[base].points, base_points(draft.problem, triad)
    unit = body[points[1]] - body[points[0]]
    unit /= abs(unit)

    def place(z: complex, *of: str) -> Place:
        w = (z - body[points[0]]) * unit.conjugate()
        found: list[NumberName | None] = []
        for kind, value in ((DimensionKind.ALONG, w.real), (DimensionKind.ACROSS, w.imag)):
            solid = abs(value) > TINY * draft.size(base)
            found.append(draft.drawn(draft.dimension(kind, value, *of)) if solid else None)
        return found[0], found[1]

    def at(point: str) -> Place:
        if point == points[1]:
            return draft.drawn(draft.length(base, points[0], point)), None
        return place(body[point], point)

    legs: list[Leg] = []
    for lead, joint in triad.legs:
        if isinstance(joint, Prismatic):
            pin, slide = outer_point(lead), slide_of(draft, joint)
            z = draft.problem.bodies[lead.link].points[pin]
            along = cis(slide.angle)
            if slide.host == base:
                line = slide.base + 1j * along * (slide.offset + z.imag)
            else:
                line = 1j * (((z - slide.base) / along).imag - slide.offset)
                along = 1.0 + 0j
            angle = degrees(along / unit)
            turned = draft.dimension(DimensionKind.ANGLE, angle, pin, host=base) if angle else None
            legs.append(Leg(place(line, pin, base), centre=PointName(pin), angle=turned))
        elif isinstance(lead.joint, Prismatic):
            track = draft.path(slide_of(draft, lead.joint), lead.to, joint.point)
            legs.append(Leg(at(joint.point), line=track.line))
        else:
            radius = draft.drawn(draft.length(lead.link, outer_point(lead), joint.point))
            centre = PointName(outer_point(lead))
            legs.append(Leg(at(joint.point), centre=centre, radius=radius))
    one, two, three = legs
    x, y, turn = (_start(draft, base, what, mode) for what in ("x", "y", "turn"))
    x, y = (draft.b.compute(f"|{name}|", (name, 1), (draft.mu_l, -1)) for name in (x, y))
    axis = draft.b.pose_triad(axis_of_link(base), (one, two, three), (x, y, turn))
    for point in points:
        draft.mark_placed(draft.b.spot(point, axis, at(point)))
    for lead, joint in triad.legs:
        if isinstance(joint, Prismatic):
            draft.turn_with(slide_of(draft, joint), base, PointName(outer_point(lead)))
        elif isinstance(lead.joint, Prismatic):
            draft.turn_with(slide_of(draft, lead.joint), lead.to, PointName(joint.point))
    if mode.tracked.places != AssemblyMode().tracked.places:
        _special(draft, triad, mode.third)


def axis_of_link(link: str) -> str:
    """Return the name of the step that finds a base link's axis."""
    return f"axis {link}"


def link_of_axis(step: TriadPose) -> str:
    """Return the base link that a step holds."""
    return step.out.removeprefix("axis ")


def _start(draft: Draft, base: str, coordinate: str, mode: AssemblyMode) -> NumberName:
    name = f"start_{coordinate}_{base}"
    draft.branches[name] = Start(mode.tracked, coordinate)
    return draft.b.known(name)


def _special(draft: Draft, triad: Triad, third: int) -> None:
    """Draw the special point: where the lines of two legs meet, forces along which hold the base.

    A leg with a guide holds across it.
    """
    for link in (triad.base, *(lead.link for lead, _ in triad.legs)):
        draft.place_rest(link)
    one, two, three = (leg_line(draft, lead, joint) for lead, joint in triad.legs)
    lines = one, two, three
    first, second = (line for k, line in enumerate(lines) if k != third)
    # Of a point K that of link 1 under it is called K1, too.
    taken = {p for body in draft.problem.bodies.values() for p in body.points}
    taken |= {special.point for special in draft.special.values()}
    free = (c for c in "SQKWUZVXY" if not taken & {c, *(c + digit for digit in "123")})
    point = draft.b.intersect_lines(f"{next(free, 'Ω')}{3 - third}", first, second)
    draft.special[triad.base] = Special(point, lines, third)


def leg_line(draft: Draft, leg: OuterLeg, joint: Prismatic | Revolute) -> LineName:
    """Return the line of force of an unloaded leg on the base link."""
    if isinstance(joint, Prismatic):
        guide = draft.direction(slide_of(draft, joint))
        return draft.b.perpendicular(PointName(outer_point(leg)), guide)
    if isinstance(leg.joint, Prismatic):
        guide = draft.direction(slide_of(draft, leg.joint))
        return draft.b.perpendicular(PointName(joint.point), guide)
    return draft.b.join(PointName(outer_point(leg)), PointName(joint.point))


def leg_points(leg: OuterLeg, joint: Prismatic | Revolute) -> tuple[str, ...]:
    """Return the hinges of a leg, through which its line passes."""
    return tuple(one.point for one in (leg.joint, joint) if isinstance(one, Revolute))


def _refusal(problem: Problem, group: AssurGroup) -> tuple[str, int, int, str, str]:
    """Return why a group is not built, with the links that may drive instead."""
    mechanism = problem.mechanism
    able = [link for link in mechanism.links if _is_built(replace(mechanism, driver=link))]
    advice, crank = translate("No driving link joined to the frame splits it into these."), ""
    if able:
        text = "It splits into these if link {} drives: give its motion in [driver]."
        advice = translate(text, translate(" or ").join(able))
        # An output may give the motion of the driver, so the crank's own data stay as they are.
        crank = mechanism.driver if problem.drive.is_crank else ""
    if crank:
        text = "Or keep that of link {0} as an output: phi_{0} and omega_{0}."
        advice = f"{advice} {translate(text, crank)}"
    inside = [mesh for mesh in mechanism.meshes if len({*mesh.joined} & {*group.links}) > 1]
    if inside:
        advice = translate(
            "The mesh of links {} is inside it, but a wheel is placed by links of other groups. {}",
            translate(" and ").join(map(mechanism.called, inside[0].links)),
            advice,
        )
    return (
        "Group of class {}, order {} (links {}) cannot be built: dyads (class II) and triads "
        "(class III, order 3) are. {}",
        group.class_number,
        group.order,
        ", ".join(group.links),
        advice,
    )


def _is_built(mechanism: Mechanism) -> bool:
    """Return whether all groups of a mechanism can be built and its driver is on the frame."""
    pairs = [
        *(joint.links for joint in mechanism.revolutes),
        *((pair.slider, pair.host) for pair in mechanism.prismatics),
    ]
    if not any({FRAME, mechanism.driver} <= set(links) for links in pairs):
        return False
    try:
        groups = analyse(mechanism).groups
    except StructureError:
        return False
    return all(group.class_number == 2 or triad_of(group) is not None for group in groups)


def _place_rrr(draft: Draft, group: AssurGroup, mode: AssemblyMode) -> None:
    c = inner_point(group)
    one, two = group.legs
    p, q = outer_point(one), outer_point(two)
    draft.b.intersect_circles(
        c,
        PointName(p),
        draft.drawn(draft.length(one.link, p, c)),
        PointName(q),
        draft.drawn(draft.length(two.link, q, c)),
        side(mode.side),
        draft.branch(c, mode),
    )
    draft.mark_placed(c)


def _place_parallel(draft: Draft, group: AssurGroup) -> None:
    """Draw the fourth corner of a parallelogram with the set square: no arcs that may touch."""
    c = inner_point(group)
    found = parallelogram(draft.problem, group)
    assert found is not None and found.is_one
    line = draft.b.parallel(
        PointName(found.far_joint),
        draft.b.join(PointName(found.corner), PointName(found.near_joint)),
    )
    length = draft.drawn(draft.length(found.link, found.far_joint, c))
    draft.b.lay_off_length(c, PointName(found.far_joint), line, length)
    draft.mark_placed(c)


class Quadrilateral(Struct, frozen=True):
    """A dyad RRR and the corner across it: corner, near, its inner joint, far (четырёхзвенник).

    Attributes
    ----------
    corner, near_joint, far_joint : str
        The dyad's outer joints ``near_joint`` and ``far_joint`` each share a body with the corner.
    link : str
        Link of the dyad from ``far_joint`` to its inner joint.
    sides : tuple of (str, float)
        Names and lengths in order around, m: corner-near, far-inner, corner-far, near-inner.
    """

    corner: str
    near_joint: str
    far_joint: str
    link: str
    sides: tuple[tuple[str, float], ...]

    @property
    def is_one(self) -> bool:
        """True where opposite sides are equal: a parallelogram."""
        (_, a), (_, b), (_, c), (_, d) = self.sides
        return abs(a - b) <= EQUAL * a and abs(c - d) <= EQUAL * c


def parallelogram(problem: Problem, group: AssurGroup) -> Quadrilateral | None:
    """Return the quadrilateral that a dyad RRR closes, a parallelogram if one can be found.

    None where its outer joints share no corner.
    """
    one, two = group.legs
    near, far, c = outer_point(one), outer_point(two), inner_point(group)
    found = None
    bodies = [body.points for link, body in problem.bodies.items() if link not in group.links]
    for first in (points for points in bodies if near in points):
        for other in (points for points in bodies if far in points and points is not first):
            for corner in (p for p in first if p in other and p not in (near, far)):
                sides = tuple(
                    (p + q, abs(points[q] - points[p]))
                    for points, p, q in (
                        (first, corner, near),
                        (problem.bodies[two.link].points, far, c),
                        (other, corner, far),
                        (problem.bodies[one.link].points, near, c),
                    )
                )
                found = Quadrilateral(corner, near, far, two.link, sides)
                if found.is_one:
                    return found
    return found


def _place_rrp(draft: Draft, group: AssurGroup, mode: AssemblyMode) -> None:
    c = inner_point(group)
    revolute, prismatic = split(group)
    slide = slide_of(draft, prismatic.joint)
    p = outer_point(revolute)
    radius = draft.drawn(draft.length(revolute.link, p, c))
    track = draft.path(slide, prismatic.to, c)
    branch = draft.branch(c, mode)
    draft.b.intersect_line_circle(
        c, track.line, PointName(p), radius, line_sense(mode.side), branch
    )
    at = draft.mark_placed(c)
    draft.turn_with(slide, prismatic.to, at)


def _place_rpr(draft: Draft, group: AssurGroup, sign: int) -> None:
    slide, host, slider = rpr_parts(draft, group)
    p, q = PointName(outer_point(host)), PointName(outer_point(slider))
    across = draft.transverse_offset(slide, p, q)
    if across == 0:
        line = draft.b.join(p, q) if sign > 0 else draft.b.join(q, p)
    else:
        # The line through the slider's joint touches a circle about the host's joint.
        offset = draft.dimension(DimensionKind.OFFSET, abs(across), q, host=host.link)
        radius = draft.drawn(offset)
        foot = draft.b.touch(f"T_{q}_{host.link}", p, radius, q, side(sign * across))
        # Joined over the tangent, not turned from its short radius: that keeps the digits.
        line = draft.b.join(foot, q) if sign > 0 else draft.b.join(q, foot)
    draft.axes[slider.link] = draft.b.parallel(q, line)
    draft.axes[host.link] = draft.line_at_angle(line, p, -slide.angle, host.link)


def rpr_parts(draft: Draft, group: AssurGroup) -> tuple[Slide, OuterLeg, OuterLeg]:
    """Return the inner slide line of an RPR dyad, the leg that carries it, and the slider's."""
    slide = slide_of(draft, group.inner[0])
    host, slider = group.legs if group.legs[0].link == slide.host else group.legs[::-1]
    return slide, host, slider


def _place_prp(draft: Draft, group: AssurGroup) -> None:
    c = inner_point(group)
    tracks: list[LineName] = []
    for lead in group.legs:
        tracks.append(draft.path(slide_of(draft, lead.joint), lead.to, c).line)
    draft.b.intersect_lines(c, tracks[0], tracks[1])
    at = draft.mark_placed(c)
    for lead in group.legs:
        draft.turn_with(slide_of(draft, lead.joint), lead.to, at)


def _place_rpp(draft: Draft, group: AssurGroup) -> None:
    revolute, prismatic = split(group)
    outer, inner = slide_of(draft, prismatic.joint), slide_of(draft, group.inner[0])
    at = PointName(outer_point(revolute))
    # Both links turn with the link that the group slides on; the first then moves about its joint.
    draft.turn_with(outer, prismatic.to, at)
    draft.turn_with(inner, prismatic.link, at)
    draft.place_rest(revolute.link)
    x = intersection_point(draft, group)
    draft.b.intersect_lines(
        x, draft.path(outer, prismatic.to, x).line, draft.path(inner, revolute.link, x).line
    )
    draft.mark_placed(x)


def intersection_point(draft: Draft, group: AssurGroup) -> str:
    """Return the point of an RPP dyad's sliding link at which its two rays meet."""
    _, prismatic = split(group)
    return next(iter(draft.problem.bodies[prismatic.link].points))
