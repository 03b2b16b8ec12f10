"""Wheels and racks on the plans (зубчатые колёса и рейки): their angles, rates and poles.

A mesh makes an angle depend on others in a straight line, so that a wheel or a rack whose carrier
and counterpart are known is placed by a number: the angle by the ratio of the radii (формула
Виллиса, relative to the carrier), the way of a rack by the length of the arc. On the plan of
velocities both links have one point in the pole of the mesh.
"""

from __future__ import annotations

from planmethod.construct.steps import NumberName, PointName
from planmethod.errors import AssemblyError
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import Draft
from planmethod.plans.model import (
    FACTS,
    KnownParts,
    PlanKind,
    Turns,
    Vector,
    VectorKind,
)
from planmethod.plans.motion.legs import (
    Kinematics,
    MotionBoard,
    plan_point_at,
    track_direction,
)
from planmethod.problem.mesh_records import GearMesh
from planmethod.problem.model import Problem, Slide


def mesh_of(problem: Problem, group: AssurGroup) -> GearMesh:
    """Return the mesh that holds a wheel or a rack."""
    return next(mesh for mesh in problem.meshes if mesh.pole == group.mesh)


def turns(problem: Problem, link: str) -> bool:
    """Return whether a link can turn: prismatic pairs alone do not join it to the frame."""
    while link != FRAME and link in problem.slides:
        link = problem.slides[link].host
    return link != FRAME


# Positions ---------------------------------------------------------------------------------------


def angle_from(draft: Draft, link: str, mesh: GearMesh) -> NumberName | None:
    """Return the angle by which a link is turned from the assembled position, degrees.

    None of a link that does not turn. It is counted on over whole turns: by the position of the
    driver, by the angle of a wheel that was computed, or read with a protractor.
    """
    problem, b = draft.problem, draft.b
    if not turns(problem, link):
        return None
    start, name = mesh.angle(link), f"turn_{mesh.pole}_{link}"
    if b.has(name):
        return NumberName(name)
    own: NumberName | None = draft.angles.get(link)
    if problem.drive.link == link and problem.drive.pivot is not None:
        own = NumberName("phi")
    if own is not None:
        return b.total(name, own, draft.known(f"phi0_{mesh.pole}_{link}", -start))
    at = PointName(draft.placed[link][0])
    base = b.at_angle(at, None, draft.known(f"from_{mesh.pole}_{link}", start))
    read = b.measure_angle(f"angle_{mesh.pole}_{link}", draft.axis(link), base)
    return b.total(name, read, whole_turns(draft, link, mesh))


def whole_turns(draft: Draft, link: str, mesh: GearMesh) -> NumberName:
    """Return the whole turns to be added to an angle that is read, degrees."""
    name = f"turns_{mesh.pole}_{link}"
    modes = (mode.turns for mode in draft.choice.values())
    known = (turns[mesh.pole, link] for turns in modes if (mesh.pole, link) in turns)
    draft.branches[name] = next(known, Turns())
    return draft.b.known(name)


def place_toothed(draft: Draft, group: AssurGroup) -> None:
    """Place a wheel by its angle, or a rack by its way along the guide."""
    mesh, (link,) = mesh_of(draft.problem, group), group.links
    if mesh.is_rack and link == mesh.mesh.links[1]:
        _place_rack(draft, mesh, link)
    else:
        _place_wheel(draft, mesh, link)
    draft.place_rest(link)
    place_pole(draft, mesh)


def _place_wheel(draft: Draft, mesh: GearMesh, link: str) -> None:
    b, carrier = draft.b, mesh.mesh.carrier
    terms = [draft.known(f"phi0_{mesh.pole}_{link}*", mesh.angle(link))]
    if mesh.is_rack:
        slide = draft.problem.slides[mesh.slider]
        way = travel(draft, slide)
        sign = mesh.rack_sign * mesh.degrees_per_metre
        per = draft.known(f"per_{mesh.pole}", sign)
        start = draft.known(f"s0_{mesh.pole}", -sign * mesh.place)
        terms += [b.compute(f"rolled_{mesh.pole}", (per, 1), (way, 1)), start]
        whole = 1.0
    else:
        ratio = mesh.ratio(link)
        by = angle_from(draft, mesh.counterpart(link), mesh)
        if by is not None:
            times = draft.known(f"u_{mesh.pole}", ratio)
            terms.append(b.compute(f"turned_{mesh.pole}", (times, 1), (by, 1)))
        whole = 1.0 - ratio
    around = angle_from(draft, carrier, mesh)
    if around is not None:
        share = draft.known(f"uH_{mesh.pole}", whole)
        terms.append(b.compute(f"carried_{mesh.pole}", (share, 1), (around, 1)))
    phi = b.total(f"phi_{link}", *terms)
    draft.angles[link] = phi
    at = PointName(draft.placed[link][0])
    draft.axes[link] = b.at_angle(at, None, phi)


def travel(draft: Draft, slide: Slide) -> NumberName:
    """Return the way of a slider along its guide, m: the given one, or read on the drawing."""
    b, name = draft.b, f"s_{slide.slider}"
    if draft.problem.drive.link == slide.slider and draft.problem.drive.pivot is None:
        return NumberName("s")
    if b.has(name):
        return NumberName(name)
    read = b.measure_along(f"({name})", draft.base(slide), PointName(slide.pin), draft.line(slide))
    return b.compute(name, (read, 1), (draft.mu_l, 1))


def _place_rack(draft: Draft, mesh: GearMesh, link: str) -> None:
    """Lay the way of a rack off along its guide."""
    b, slide, (wheel, _) = draft.b, draft.problem.slides[mesh.slider], mesh.mesh.links
    if slide.slider != link or slide.host != FRAME:
        raise AssemblyError(
            "Rack {} is moved by wheel {}, and its guide is not on the frame. Only a rack on a "
            "guide of the frame can be moved so.",
            link,
            wheel,
        )
    by = angle_from(draft, wheel, mesh)
    assert by is not None
    per = draft.known(f"per_{mesh.pole}", 1.0 / mesh.degrees_per_metre)
    start = draft.known(f"s0_{mesh.pole}", mesh.place)
    s = b.total(f"s_{link}", start, b.compute(f"rolled_{mesh.pole}", (per, 1), (by, 1)))
    track = draft.path(slide, FRAME, slide.pin)
    length = b.compute(f"|s_{link}|", (s, 1), (draft.mu_l, -1))
    b.lay_off_length(slide.pin, track.origin, track.line, length)
    draft.mark_placed(slide.pin)
    draft.turn_with(slide, FRAME, PointName(slide.pin))


def place_pole(draft: Draft, mesh: GearMesh) -> None:
    """Mark the pole of a mesh on the line of centres."""
    b, (one, _) = draft.b, mesh.mesh.links
    if mesh.is_rack:
        slide = draft.problem.slides[mesh.slider]
        at = PointName(mesh.centres[0])
        line = b.perpendicular(at, draft.direction(slide))
        length = draft.known(f"r_{mesh.pole}", mesh.offset)
    else:
        at = PointName(mesh.centre(one))
        line = b.join(at, PointName(mesh.centres[1]))
        length = draft.known(f"r_{mesh.pole}", mesh.pole_radius)
    drawn = b.compute(f"|r_{mesh.pole}|", (length, 1), (draft.mu_l, -1))
    b.lay_off_length(mesh.pole, at, line, drawn)
    one, other = sorted((at, mesh.pole))
    draft.laid_off[one, other] = drawn


# Velocities and accelerations --------------------------------------------------------------------


def toothed_motion(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """Find the rate of a wheel by the ratio, or lay off the velocity of a rack."""
    mesh, (link,) = mesh_of(kinematics.draft.problem, group), group.links
    if mesh.is_rack and link == mesh.mesh.links[1]:
        _move_rack(kinematics, motion, mesh, link)
    else:
        _turn_wheel(kinematics, motion, mesh, link)


def show_pole(kinematics: Kinematics, motion: MotionBoard, group: AssurGroup) -> None:
    """Show the points of both links in the pole: of velocities they are one, at rest on the frame.

    Their accelerations differ.
    """
    mesh, (own,) = mesh_of(kinematics.draft.problem, group), group.links
    other = mesh.counterpart(own)
    at = plan_point_at(kinematics, motion, other, mesh.pole)
    if motion.kind is PlanKind.VELOCITY:
        motion.add_point(own, mesh.pole, at, name=f"{mesh.pole}{own}", show=at != motion.pole)
    else:
        plan_point_at(kinematics, motion, own, mesh.pole)


def _turn_wheel(kinematics: Kinematics, motion: MotionBoard, mesh: GearMesh, link: str) -> None:
    draft, rates = kinematics.draft, kinematics.rates(motion.kind)
    b, (carrier, other) = draft.b, (mesh.mesh.carrier, mesh.counterpart(link))
    letter = "omega" if motion.kind is PlanKind.VELOCITY else "epsilon"
    terms: list[NumberName] = []
    if mesh.is_rack:
        rate = _sliding_rate(kinematics, motion, draft.problem.slides[mesh.slider])
        if rate is not None:
            radius = draft.known(f"d_{mesh.pole}", -mesh.rack_sign * mesh.offset)
            terms.append(b.compute(f"{letter}_{link}*", (rate, 1), (radius, -1)))
        whole = 1.0
    else:
        ratio = mesh.ratio(link)
        whole = 1.0 - ratio
        if other in rates:
            times = draft.known(f"u_{mesh.pole}", ratio)
            terms.append(b.compute(f"{letter}_{link}*", (times, 1), (rates[other], 1)))
    if carrier in rates:
        share = draft.known(f"uH_{mesh.pole}", whole)
        terms.append(b.compute(f"{letter}_{link}**", (share, 1), (rates[carrier], 1)))
    if terms:
        rates[link] = b.total(f"{letter}_{link}", *terms)


def _sliding_rate(kinematics: Kinematics, motion: MotionBoard, slide: Slide) -> NumberName | None:
    """Return how fast a slider moves along its guide, m/s or m/s², positive along it."""
    draft, first = kinematics.draft, motion.kind is PlanKind.VELOCITY
    b, drive = draft.b, draft.problem.drive
    if drive.link == slide.slider and drive.pivot is None:
        return NumberName("v" if first else "a") if first or drive.accelerates else None
    name = f"ds_{slide.slider}" if first else f"dds_{slide.slider}"
    if b.has(name):
        return NumberName(name)
    for relative in kinematics.relatives.values():
        if {relative.of, relative.to} != {slide.slider, slide.host}:
            continue
        sign = 1.0 if relative.of == slide.slider else -1.0
        if first:
            return b.compute(name, (relative.speed, 1), factor=sign)
        assert relative.a_coriolis is not None and relative.a_head is not None
        ends = relative.a_coriolis, relative.a_head
        return b.compute(name, (motion.segments.values[ends], 1), factor=sign)
    raise AssemblyError(
        "The way of slider {} on its guide is not on the plans, so the mesh cannot use it.",
        slide.slider,
    )


def _move_rack(kinematics: Kinematics, motion: MotionBoard, mesh: GearMesh, link: str) -> None:
    draft, rates = kinematics.draft, kinematics.rates(motion.kind)
    b, slide, (wheel, _) = draft.b, draft.problem.slides[mesh.slider], mesh.mesh.links
    if wheel not in rates:
        motion.add_point(link, slide.pin, motion.pole)
        return
    name = "ds" if motion.kind is PlanKind.VELOCITY else "dds"
    radius = draft.known(f"d_{mesh.pole}", -mesh.offset)
    rate = b.compute(f"{name}_{link}", (radius, 1), (rates[wheel], 1))
    along = b.parallel(motion.pole, draft.direction(slide))
    head = motion.segments.lay_off_vector(motion.name(slide.pin), motion.pole, along, rate)
    symbol = f"{FACTS[motion.kind].letter}_{{{motion.written(slide.pin, link)}}}"
    direction = track_direction(slide, draft.problem)
    ends = motion.pole, head
    motion.add(Vector(symbol, VectorKind.ABSOLUTE, *ends, KnownParts.BOTH, direction))
    motion.add_point(link, slide.pin, head)
