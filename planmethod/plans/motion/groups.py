"""Velocity and acceleration plans of the driver, of each dyad and triad."""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.mechanism.groups import AssurGroup, Joint, OuterLeg, Triad, triad_of
from planmethod.mechanism.model import FRAME, Prismatic, Revolute
from planmethod.plans.model import (
    FACTS,
    Direction,
    KnownParts,
    PlanKind,
    Vector,
    VectorEquation,
    VectorKind,
    perpendicular_to,
    towards,
)
from planmethod.plans.motion.legs import (
    Kinematics,
    MotionBoard,
    Ray,
    arm,
    close,
    plan_point_at,
    prismatic_ray,
    read_sliding,
    read_turning,
    revolute_ray,
    rotate_about,
    track_direction,
)
from planmethod.plans.motion.meshes import show_pole, toothed_motion
from planmethod.plans.motion.position import (
    inner_point,
    intersection_point,
    outer_point,
    rpr_parts,
    slide_of,
    split,
)
from planmethod.problem.model import Drive, OtherDrive


def triad_motion(kinematics: Kinematics, motion: MotionBoard, triad: Triad) -> None:
    """Find the special point's vector from two legs, the third joint's, then the others."""
    base, special = triad.base, kinematics.draft.special[triad.base]
    first, second = (k for k in range(3) if k != special.third)
    rays = {k: _ray(kinematics, motion, base, *triad.legs[k]) for k in (first, second)}
    through = [
        _through(kinematics, motion, base, special.point, triad.legs[k], rays[k])
        for k in (first, second)
    ]
    close(kinematics, motion, (base, base), special.point, (through[0], through[1]))
    lead, joint = triad.legs[special.third]
    place = leg_place(lead, joint)
    turned = revolute_ray(kinematics, motion, base, special.point, place)
    third = _ray(kinematics, motion, base, lead, joint)
    close(kinematics, motion, (base, lead.link), place, (turned, third))
    read_turning(kinematics, motion, base, special.point, place, turned)
    _read_leg(kinematics, motion, base, (lead, joint), third)
    for k in (first, second):
        lead, joint = triad.legs[k]
        head = plan_point_at(kinematics, motion, base, leg_place(lead, joint))
        unknown = rays[k].close(motion, head)
        left = motion.absolute(motion.label(base, leg_place(lead, joint)), head, KnownParts.NONE)
        motion.equations.append(VectorEquation(left, (*rays[k].terms, unknown)))
        _read_leg(kinematics, motion, base, (lead, joint), rays[k])


def leg_place(leg: OuterLeg, joint: Joint) -> str:
    """Return the place where a leg holds the base link: its hinge, or beside its block's pin."""
    return joint.point if isinstance(joint, Revolute) else outer_point(leg)


def _ray(
    kinematics: Kinematics, motion: MotionBoard, base: str, leg: OuterLeg, joint: Joint
) -> Ray:
    """Return the ray of the velocity that a leg leaves unknown where it holds the base link."""
    place = leg_place(leg, joint)
    if isinstance(joint, Prismatic):
        return prismatic_ray(
            kinematics, motion, slide_of(kinematics.draft, joint), base, leg.link, place
        )
    if isinstance(leg.joint, Prismatic):
        slide = slide_of(kinematics.draft, leg.joint)
        return prismatic_ray(kinematics, motion, slide, leg.link, leg.to, place)
    return revolute_ray(kinematics, motion, leg.link, outer_point(leg), place)


def _read_leg(
    kinematics: Kinematics, motion: MotionBoard, base: str, leg: tuple[OuterLeg, Joint], ray: Ray
) -> None:
    """Read how a leg turns, or slides, off its closed ray."""
    lead, joint = leg
    place = leg_place(lead, joint)
    if isinstance(joint, Prismatic):
        kinematics.note_common_rotation(lead.link, base)
        read_sliding(kinematics, motion, base, lead.link, place, ray)
    elif isinstance(lead.joint, Prismatic):
        read_sliding(kinematics, motion, lead.link, lead.to, place, ray)
        kinematics.note_common_rotation(lead.link, lead.to)
    else:
        read_turning(kinematics, motion, lead.link, outer_point(lead), place, ray)


def _through(
    kinematics: Kinematics,
    motion: MotionBoard,
    base: str,
    special: PointName,
    leg: tuple[OuterLeg, Joint],
    ray: Ray,
) -> Ray:
    """Return the ray of the special point: that of the leg, after its normal component."""
    b, (lead, joint) = kinematics.draft.b, leg
    place = leg_place(lead, joint)
    start, terms = ray.start, list(ray.terms)
    label = motion.label(base, place)
    if motion.kind is PlanKind.ACCELERATION:
        lever = arm(kinematics.draft, base, place, special)
        inward = b.parallel(start, b.join(special, PointName(place)))
        value = motion.segments.compute(
            f"an_{special}{label}", (kinematics.omega[base], 2), *lever.length
        )
        start = motion.segments.lay_off_vector(
            motion.name(f"n_{special}{label}"), start, inward, value
        )
        motion.letters.setdefault(start, [f"n_{{{special}{label}}}"])
        symbol, direction = f"a^{{n}}_{{{special}{label}}}", towards(special, place)
        normal = Vector(
            symbol,
            VectorKind.NORMAL,
            ray.start,
            start,
            KnownParts.BOTH,
            direction,
            (special, place),
        )
        terms.append(motion.add(normal))
    line = b.parallel(start, ray.line)
    of, along = _relative(kinematics, lead, joint, label)
    both, points = f"{special}{of}", (special, along.points[1]) if along.points else ()
    if motion.kind is PlanKind.VELOCITY:
        return Ray(
            start, line, tuple(terms), (f"v_{{{both}}}", VectorKind.RELATIVE, along), f"v_{both}",
            points,
        )  # fmt: skip
    symbol = f"a^{{τ}}_{{{both}}}"
    unknown = (symbol, VectorKind.TANGENTIAL, along)
    return Ray(start, line, tuple(terms), unknown, f"at_{both}", points)


def _relative(
    kinematics: Kinematics, leg: OuterLeg, joint: Joint, label: str
) -> tuple[str, Direction]:
    """Return the reference point of the special point's unknown component, and its direction."""
    if isinstance(joint, Revolute) and isinstance(leg.joint, Revolute):
        return outer_point(leg), perpendicular_to(joint.point, outer_point(leg))
    pair = joint if isinstance(joint, Prismatic) else leg.joint
    slide = slide_of(kinematics.draft, pair)
    to = kinematics.draft.problem.mechanism.called(FRAME if leg.to == FRAME else leg.to)
    if isinstance(joint, Prismatic):
        return outer_point(leg), track_direction(slide, kinematics.draft.problem)
    return f"{label}{to}", track_direction(slide, kinematics.draft.problem)


def drive_motion(kinematics: Kinematics, motion: MotionBoard) -> None:
    """Lay off the motion of the points of the driving links."""
    drive = kinematics.draft.problem.drive
    _drive_one(kinematics, motion, drive, drive.program_inputs, accelerates=drive.accelerates)
    for other in drive.other_drives:
        accelerates = other.acceleration != 0
        _drive_one(kinematics, motion, other, other.program_inputs, accelerates=accelerates)


def _drive_one(
    kinematics: Kinematics,
    motion: MotionBoard,
    drive: Drive | OtherDrive,
    names: tuple[str, str, str],
    *,
    accelerates: bool,
) -> None:
    b = kinematics.draft.b
    if drive.pivot is not None:
        if motion.kind is PlanKind.VELOCITY:
            kinematics.omega[drive.link] = b.known(names[1])
        elif accelerates:
            kinematics.epsilon[drive.link] = b.known(names[2])
        points = kinematics.draft.problem.bodies[drive.link].points
        first = next((p for p in points if points[p] != points[drive.pivot]), None)
        if first is not None:
            head = rotate_about(kinematics, motion, drive.link, drive.pivot, first)
            motion.add_point(drive.link, first, head)
    else:
        slide = kinematics.draft.problem.slides[drive.link]
        rate = b.known(names[1] if motion.kind is PlanKind.VELOCITY else names[2])
        out = motion.name(slide.pin)
        along = b.parallel(motion.pole, kinematics.draft.direction(slide))
        head = motion.segments.lay_off_vector(out, motion.pole, along, rate)
        symbol = f"{FACTS[motion.kind].letter}_{{{motion.written(slide.pin, drive.link)}}}"
        direction = track_direction(slide, kinematics.draft.problem)
        motion.add(
            Vector(symbol, VectorKind.ABSOLUTE, motion.pole, head, KnownParts.BOTH, direction)
        )
        motion.add_point(drive.link, slide.pin, head)
    carry_rest(kinematics, motion, (drive.link,))


def group_motion(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """Close a dyad's plan: the rays of its two legs meet in the middle joint; or a triad's."""
    if group.is_passive:
        (link,) = group.links
        like = next(one.like for one in kinematics.draft.problem.mechanism.passive
                    if one.link == link)  # fmt: skip
        kinematics.note_common_rotation(link, like)
        carry_rest(kinematics, motion, group.links)
        return
    if group.is_toothed:
        toothed_motion(kinematics, motion, group)
        carry_rest(kinematics, motion, group.links)
        show_pole(kinematics, motion, group)
        motion.read_off()
        return
    triad = triad_of(group)
    if triad is not None:
        triad_motion(kinematics, motion, triad)
        carry_rest(kinematics, motion, group.links)
        return
    match group.signature:
        case "RRR" | "RRP" | "PRP":
            _middle_revolute(kinematics, motion, group)
        case "RPR":
            _swinging(kinematics, motion, group)
        case "RPP":
            _sliding(kinematics, motion, group)
    carry_rest(kinematics, motion, group.links)


def carry_rest(kinematics: Kinematics, motion: MotionBoard, links: tuple[str, ...]) -> None:
    """Find the remaining points of links whose motion is known (теорема подобия)."""
    for link in links:
        for place in kinematics.draft.problem.bodies[link].points:
            at = plan_point_at(kinematics, motion, link, place)
            motion.absolute(motion.label(link, place), at, link=link)
    motion.read_off()


def _middle_revolute(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """RRR, RRP, PRP: the middle joint is a point of both links."""
    place = inner_point(group)
    leads = split(group)
    rays = []
    for lead in leads:
        if isinstance(lead.joint, Revolute):
            rays.append(revolute_ray(kinematics, motion, lead.link, outer_point(lead), place))
        else:
            rays.append(
                prismatic_ray(
                    kinematics,
                    motion,
                    slide_of(kinematics.draft, lead.joint),
                    lead.link,
                    lead.to,
                    place,
                )
            )
    close(kinematics, motion, (leads[0].link, leads[1].link), place, (rays[0], rays[1]))
    for lead, ray in zip(leads, rays, strict=True):
        if isinstance(lead.joint, Revolute):
            read_turning(kinematics, motion, lead.link, outer_point(lead), place, ray)
        else:
            read_sliding(kinematics, motion, lead.link, lead.to, place, ray)
            kinematics.note_common_rotation(lead.link, lead.to)


def _swinging(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """RPR: the point of the slotted link under the slider's joint is sought (кулиса)."""
    slide, host, slider = rpr_parts(kinematics.draft, group)
    joint, place = outer_point(host), outer_point(slider)
    sliding = prismatic_ray(kinematics, motion, slide, host.link, slider.link, place)
    across = revolute_ray(kinematics, motion, host.link, joint, place)
    close(kinematics, motion, (host.link, host.link), place, (sliding, across))
    read_turning(kinematics, motion, host.link, joint, place, across)
    read_sliding(kinematics, motion, host.link, slider.link, place, sliding)
    kinematics.note_common_rotation(slider.link, host.link)


def _sliding(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """RPP: both links turn with the link that the group slides on."""
    revolute, prismatic = split(group)
    outer, inner = (
        slide_of(kinematics.draft, prismatic.joint),
        slide_of(kinematics.draft, group.inner[0]),
    )
    for link in group.links:
        kinematics.note_common_rotation(link, prismatic.to)
    carry_rest(kinematics, motion, (revolute.link,))
    place = intersection_point(kinematics.draft, group)
    rays = (
        prismatic_ray(kinematics, motion, inner, prismatic.link, revolute.link, place),
        prismatic_ray(kinematics, motion, outer, prismatic.link, prismatic.to, place),
    )
    close(kinematics, motion, (prismatic.link, prismatic.link), place, rays)
    read_sliding(kinematics, motion, prismatic.link, revolute.link, place, rays[0])
    read_sliding(kinematics, motion, prismatic.link, prismatic.to, place, rays[1])
