"""Velocity and acceleration plans of a triad by the special point of its base link (особая точка).

Both points in which two legs hold the base link move, along the lines of these legs, as the legs'
other ends do. So does the point of the base link in which the two lines meet: its vector is found
from two rays, across one leg and across the other. That point and the third leg then give the
third joint, and similarity the rest.

Source: L. V. Assur's special points (особые точки), as the courses of the theory of mechanisms have
them for groups of class III.
"""

from __future__ import annotations

from planmethod.construct.steps import PointName
from planmethod.mechanism.groups import Joint, OuterLeg, Triad
from planmethod.mechanism.model import FRAME, Prismatic, Revolute
from planmethod.plans.model import (
    Direction,
    KnownParts,
    PlanKind,
    Vector,
    VectorEquation,
    VectorKind,
    perpendicular_to,
    towards,
)
from planmethod.plans.motion.board import MotionBoard, Ray
from planmethod.plans.motion.legs import (
    Kinematics,
    arm,
    close,
    plan_point_at,
    prismatic_ray,
    read_sliding,
    read_turning,
    revolute_ray,
    track_direction,
)
from planmethod.plans.motion.position import outer_point, slide_of


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
        normal = Vector(symbol, VectorKind.NORMAL, ray.start, start, KnownParts.BOTH, direction)
        terms.append(motion.add(normal))
    line = b.parallel(start, ray.line)
    of, along = _relative(kinematics, lead, joint, label)
    both = f"{special}{of}"
    if motion.kind is PlanKind.VELOCITY:
        return Ray(
            start, line, tuple(terms), (f"v_{{{both}}}", VectorKind.RELATIVE, along), f"v_{both}"
        )
    symbol = f"a^{{τ}}_{{{both}}}"
    unknown = (symbol, VectorKind.TANGENTIAL, along)
    return Ray(start, line, tuple(terms), unknown, f"at_{both}")


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
