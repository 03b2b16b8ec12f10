"""Velocity and acceleration plans of the driver and of each dyad, from their two legs."""

from __future__ import annotations

from planmethod.mechanism.groups import AssurGroup, triad_of
from planmethod.mechanism.model import Revolute
from planmethod.plans.model import FACTS, Known, PlanKind, Vector, VectorKind
from planmethod.plans.motion.board import MotionBoard
from planmethod.plans.motion.leads import (
    Kinematics,
    carried,
    close,
    prismatic_ray,
    read_sliding,
    read_turning,
    revolute_ray,
    track_direction,
    turn_about,
)
from planmethod.plans.motion.position import (
    inner_point,
    lead_point,
    meeting_point,
    rpr_parts,
    slide_of,
    split,
)
from planmethod.plans.motion.triads import triad_motion


def drive_motion(kin: Kinematics, motion: MotionBoard) -> None:
    """Lay off the motion of the driving link's points."""
    drive = kin.draft.problem.drive
    b = kin.draft.b
    if drive.pivot is not None:
        if motion.kind is PlanKind.VELOCITY:
            kin.omega[drive.link] = b.known(f"omega_{drive.link}")
        elif drive.accelerates:
            kin.epsilon[drive.link] = b.known(f"epsilon_{drive.link}")
        points = kin.draft.problem.bodies[drive.link].points
        first = next((p for p in points if points[p] != points[drive.pivot]), None)
        if first is not None:
            head = turn_about(kin, motion, drive.link, drive.pivot, first)
            motion.put(drive.link, first, head)
    else:
        slide = kin.draft.problem.slides[drive.link]
        rate = b.known("v" if motion.kind is PlanKind.VELOCITY else "a")
        out = motion.name(slide.pin)
        along = b.parallel(motion.pole, kin.draft.direction(slide))
        head = motion.segments.lay_off(out, motion.pole, along, rate)
        symbol = f"{FACTS[motion.kind].letter}_{{{slide.pin}}}"
        direction = track_direction(slide, kin.draft.problem)
        motion.add(Vector(symbol, VectorKind.ABSOLUTE, motion.pole, head, Known.BOTH, direction))
        motion.put(drive.link, slide.pin, head)
    carry_rest(kin, motion, (drive.link,))


def group_motion(kin: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """Close a dyad's plan: the rays of its two legs meet in the middle joint; or a triad's."""
    triad = triad_of(group)
    if triad is not None:
        triad_motion(kin, motion, triad)
        carry_rest(kin, motion, group.links)
        return
    match group.signature:
        case "RRR" | "RRP" | "PRP":
            _middle_revolute(kin, motion, group)
        case "RPR":
            _swinging(kin, motion, group)
        case "RPP":
            _sliding(kin, motion, group)
    carry_rest(kin, motion, group.links)


def carry_rest(kin: Kinematics, motion: MotionBoard, links: tuple[str, ...]) -> None:
    """Find the remaining points of links whose motion is known (теорема подобия)."""
    for link in links:
        for place in kin.draft.problem.bodies[link].points:
            at = carried(kin, motion, link, place)
            motion.absolute(motion.label(link, place), at)
    motion.read_off()


def _middle_revolute(kin: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """RRR, RRP, PRP: the middle joint is a point of both links."""
    place = inner_point(group)
    leads = split(group)
    rays = []
    for lead in leads:
        if isinstance(lead.joint, Revolute):
            rays.append(revolute_ray(kin, motion, lead.link, lead_point(lead), place))
        else:
            rays.append(
                prismatic_ray(
                    kin, motion, slide_of(kin.draft, lead.joint), lead.link, lead.to, place
                )
            )
    close(kin, motion, (leads[0].link, leads[1].link), place, (rays[0], rays[1]))
    for lead, ray in zip(leads, rays, strict=True):
        if isinstance(lead.joint, Revolute):
            read_turning(kin, motion, lead.link, lead_point(lead), place, ray)
        else:
            read_sliding(kin, motion, lead.link, lead.to, place, ray)
            kin.share_turning(lead.link, lead.to)


def _swinging(kin: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """RPR: the point of the slotted link under the slider's joint is sought (кулиса)."""
    slide, host, slider = rpr_parts(kin.draft, group)
    joint, place = lead_point(host), lead_point(slider)
    sliding = prismatic_ray(kin, motion, slide, host.link, slider.link, place)
    across = revolute_ray(kin, motion, host.link, joint, place)
    close(kin, motion, (host.link, host.link), place, (sliding, across))
    read_turning(kin, motion, host.link, joint, place, across)
    read_sliding(kin, motion, host.link, slider.link, place, sliding)
    kin.share_turning(slider.link, host.link)


def _sliding(kin: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """RPP: both links turn with the link that the group slides on."""
    revolute, prismatic = split(group)
    outer, inner = slide_of(kin.draft, prismatic.joint), slide_of(kin.draft, group.inner[0])
    for link in group.links:
        kin.share_turning(link, prismatic.to)
    carry_rest(kin, motion, (revolute.link,))
    place = meeting_point(kin.draft, group)
    rays = (
        prismatic_ray(kin, motion, inner, prismatic.link, revolute.link, place),
        prismatic_ray(kin, motion, outer, prismatic.link, prismatic.to, place),
    )
    close(kin, motion, (prismatic.link, prismatic.link), place, rays)
    read_sliding(kin, motion, prismatic.link, revolute.link, place, rays[0])
    read_sliding(kin, motion, prismatic.link, prismatic.to, place, rays[1])
