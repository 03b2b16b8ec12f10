"""Velocity and acceleration plans of the driver and of each dyad, from their two legs."""

from __future__ import annotations

from planmethod.mechanism.groups import AssurGroup, triad_of
from planmethod.mechanism.model import Revolute
from planmethod.plans.model import FACTS, KnownParts, PlanKind, Vector, VectorKind
from planmethod.plans.motion.board import MotionBoard
from planmethod.plans.motion.legs import (
    Kinematics,
    close,
    plan_point_at,
    prismatic_ray,
    read_sliding,
    read_turning,
    revolute_ray,
    rotate_about,
    track_direction,
)
from planmethod.plans.motion.position import (
    inner_point,
    intersection_point,
    outer_point,
    rpr_parts,
    slide_of,
    split,
)
from planmethod.plans.motion.triads import triad_motion


def drive_motion(kinematics: Kinematics, motion: MotionBoard) -> None:
    """Lay off the motion of the driving link's points."""
    drive = kinematics.draft.problem.drive
    b = kinematics.draft.b
    if drive.pivot is not None:
        if motion.kind is PlanKind.VELOCITY:
            kinematics.omega[drive.link] = b.known(f"omega_{drive.link}")
        elif drive.accelerates:
            kinematics.epsilon[drive.link] = b.known(f"epsilon_{drive.link}")
        points = kinematics.draft.problem.bodies[drive.link].points
        first = next((p for p in points if points[p] != points[drive.pivot]), None)
        if first is not None:
            head = rotate_about(kinematics, motion, drive.link, drive.pivot, first)
            motion.add_point(drive.link, first, head)
    else:
        slide = kinematics.draft.problem.slides[drive.link]
        rate = b.known("v" if motion.kind is PlanKind.VELOCITY else "a")
        out = motion.name(slide.pin)
        along = b.parallel(motion.pole, kinematics.draft.direction(slide))
        head = motion.segments.lay_off_vector(out, motion.pole, along, rate)
        symbol = f"{FACTS[motion.kind].letter}_{{{slide.pin}}}"
        direction = track_direction(slide, kinematics.draft.problem)
        motion.add(
            Vector(symbol, VectorKind.ABSOLUTE, motion.pole, head, KnownParts.BOTH, direction)
        )
        motion.add_point(drive.link, slide.pin, head)
    carry_rest(kinematics, motion, (drive.link,))


def group_motion(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """Close a dyad's plan: the rays of its two legs meet in the middle joint; or a triad's."""
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
            motion.absolute(motion.label(link, place), at)
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
