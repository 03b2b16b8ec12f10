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
from planmethod.mechanism.groups import Joint, Lead, Legs
from planmethod.mechanism.model import FRAME, Prismatic, Revolute
from planmethod.plans.model import (
    Direction,
    Known,
    PlanKind,
    Vector,
    VectorEquation,
    VectorKind,
    across,
    towards,
)
from planmethod.plans.motion.board import MotionBoard, Ray
from planmethod.plans.motion.leads import (
    Kinematics,
    arm,
    carried,
    close,
    prismatic_ray,
    read_sliding,
    read_turning,
    revolute_ray,
    track_direction,
)
from planmethod.plans.motion.position import lead_point, slide_of


def triad_motion(kin: Kinematics, motion: MotionBoard, triad: Legs) -> None:
    """Find the special point's vector from two legs, the third joint's, then the others."""
    base, special = triad.base, kin.draft.special[triad.base]
    first, second = (k for k in range(3) if k != special.third)
    rays = {k: _ray(kin, motion, base, *triad.legs[k]) for k in (first, second)}
    through = [
        _through(kin, motion, base, special.point, triad.legs[k], rays[k]) for k in (first, second)
    ]
    close(kin, motion, (base, base), special.point, (through[0], through[1]))
    lead, joint = triad.legs[special.third]
    place = leg_place(lead, joint)
    turned = revolute_ray(kin, motion, base, special.point, place)
    third = _ray(kin, motion, base, lead, joint)
    close(kin, motion, (base, lead.link), place, (turned, third))
    read_turning(kin, motion, base, special.point, place, turned)
    _read_leg(kin, motion, base, (lead, joint), third)
    for k in (first, second):
        lead, joint = triad.legs[k]
        head = carried(kin, motion, base, leg_place(lead, joint))
        unknown = rays[k].close(motion, head)
        left = motion.absolute(motion.label(base, leg_place(lead, joint)), head, Known.NOTHING)
        motion.equations.append(VectorEquation(left, (*rays[k].terms, unknown)))
        _read_leg(kin, motion, base, (lead, joint), rays[k])


def leg_place(lead: Lead, joint: Joint) -> str:
    """Return the place where a leg holds the base link: its hinge, or beside its block's pin."""
    return joint.point if isinstance(joint, Revolute) else lead_point(lead)


def _ray(kin: Kinematics, motion: MotionBoard, base: str, lead: Lead, joint: Joint) -> Ray:
    """Return the ray of the velocity that a leg leaves unknown where it holds the base link."""
    place = leg_place(lead, joint)
    if isinstance(joint, Prismatic):
        return prismatic_ray(kin, motion, slide_of(kin.draft, joint), base, lead.link, place)
    if isinstance(lead.joint, Prismatic):
        slide = slide_of(kin.draft, lead.joint)
        return prismatic_ray(kin, motion, slide, lead.link, lead.to, place)
    return revolute_ray(kin, motion, lead.link, lead_point(lead), place)


def _read_leg(
    kin: Kinematics, motion: MotionBoard, base: str, leg: tuple[Lead, Joint], ray: Ray
) -> None:
    """Read how a leg turns, or slides, off its closed ray."""
    lead, joint = leg
    place = leg_place(lead, joint)
    if isinstance(joint, Prismatic):
        kin.share_turning(lead.link, base)
        read_sliding(kin, motion, base, lead.link, place, ray)
    elif isinstance(lead.joint, Prismatic):
        read_sliding(kin, motion, lead.link, lead.to, place, ray)
        kin.share_turning(lead.link, lead.to)
    else:
        read_turning(kin, motion, lead.link, lead_point(lead), place, ray)


def _through(
    kin: Kinematics,
    motion: MotionBoard,
    base: str,
    special: PointName,
    leg: tuple[Lead, Joint],
    ray: Ray,
) -> Ray:
    """Return the ray of the special point: that of the leg, after its normal component."""
    b, (lead, joint) = kin.draft.b, leg
    place = leg_place(lead, joint)
    start, terms = ray.start, list(ray.terms)
    label = motion.label(base, place)
    if motion.kind is PlanKind.ACCELERATION:
        lever = arm(kin.draft, base, place, special)
        inward = b.parallel(start, b.join(special, PointName(place)))
        value = motion.segments.compute(f"an_{special}{label}", (kin.omega[base], 2), *lever.length)
        start = motion.segments.lay_off(motion.name(f"n_{special}{label}"), start, inward, value)
        motion.letters.setdefault(start, [f"n_{{{special}{label}}}"])
        symbol, direction = f"a^{{n}}_{{{special}{label}}}", towards(special, place)
        normal = Vector(symbol, VectorKind.NORMAL, ray.start, start, Known.BOTH, direction)
        terms.append(motion.add(normal))
    line = b.parallel(start, ray.line)
    of, along = _relative(kin, lead, joint, label)
    both = f"{special}{of}"
    if motion.kind is PlanKind.VELOCITY:
        return Ray(
            start, line, tuple(terms), (f"v_{{{both}}}", VectorKind.RELATIVE, along), f"v_{both}"
        )
    symbol = f"a^{{τ}}_{{{both}}}"
    unknown = (symbol, VectorKind.TANGENTIAL, along)
    return Ray(start, line, tuple(terms), unknown, f"at_{both}")


def _relative(kin: Kinematics, lead: Lead, joint: Joint, label: str) -> tuple[str, Direction]:
    """Return the reference point of the special point's unknown component, and its direction."""
    if isinstance(joint, Revolute) and isinstance(lead.joint, Revolute):
        return lead_point(lead), across(joint.point, lead_point(lead))
    pair = joint if isinstance(joint, Prismatic) else lead.joint
    slide = slide_of(kin.draft, pair)
    to = kin.draft.problem.mechanism.called(FRAME if lead.to == FRAME else lead.to)
    if isinstance(joint, Prismatic):
        return lead_point(lead), track_direction(slide, kin.draft.problem)
    return f"{label}{to}", track_direction(slide, kin.draft.problem)
