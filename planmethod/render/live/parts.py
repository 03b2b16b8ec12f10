"""The scheme cut into rigid parts for the page."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from msgspec import Struct

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.draft import cis
from planmethod.problem.model import Problem, Slide
from planmethod.problem.records import SizeTable
from planmethod.render.ink.drawing import Item
from planmethod.render.pictures.scheme import AXIS, Scheme
from planmethod.render.pictures.springs import (
    anchors,
    fixed_end,
    spring_ends,
    spring_items,
    springs_in,
    straight_items,
)
from planmethod.render.pictures.supports import BlockOutline, welded
from planmethod.render.pictures.wheels import contacts, wheel_items
from planmethod.render.symbols import SIZES, guide_line, revolute, slider, turn_arrow
from planmethod.render.symbols.marks import axis_line
from planmethod.solved.solution import Solution


def cycle_deg(problem: Problem) -> float:
    """Return the period of the motion and the loads, degrees."""
    dynamics, machine = problem.dynamics, problem.machine
    tables = [load.size for load in dynamics.loads] if dynamics is not None else []
    turns = [table.turn for table in tables if isinstance(table, SizeTable)]
    if machine is not None and any(isinstance(table, SizeTable) for table in tables):
        turns.append(machine.cycle_deg)
    return max([360.0, *turns])


class MovingPart(Struct, frozen=True):
    """Items that move with a link as one body, mm, as they lie in one position.

    Parts of a higher ``layer`` lie over lower ones.
    """

    link: str
    index: int
    layer: int
    items: tuple[Item, ...]


class StretchedPart(Struct, frozen=True):
    """Symbol of a straight spring, from 0 to ``length`` mm along x; the page stretches it.

    ``ends`` are names of points, or fixed places, m.
    """

    items: tuple[Item, ...]
    length: float
    ends: tuple[str | complex, str | complex]


def stretched_parts(scheme: Scheme) -> list[StretchedPart]:
    """Return the straight springs and dampers of a scheme, as long as in its position."""
    problem, found = scheme.solution.problem, []
    for number, one in enumerate(springs_in(problem), 1):
        if one.is_torsion:
            continue
        start, end = spring_ends(scheme, one)
        length, fixed = max(abs(end - start), SIZES.slider_length), fixed_end(problem, one)
        items = straight_items(one, 0j, complex(length), scheme.factor, f"spring {number}")
        first, second = (
            fixed if link == FRAME and fixed is not None else point
            for link, point in zip(one.links, one.points, strict=True)
        )
        found.append(StretchedPart(tuple(items), length, (first, second)))
    return found


GUIDES, BODIES, LINES, JOINTS = range(4)


def parts_of(solution: Solution, letter_height: float) -> tuple[list[MovingPart], Scheme]:
    """Return the parts of a scheme, the lowest first, and the scheme of the first position.

    The solution has the positions that the mechanism moves through: slots and guides are as long as
    these require.
    """
    problem = solution.problem
    scheme = Scheme(solution, 0, letter_height)
    rods: dict[str, list[Item]] = {}
    for link in problem.mechanism.links:
        if link in contacts(problem):
            continue
        before = len(scheme.lines)
        scheme.draw_link(link)
        rods[link] = scheme.lines[before:]
    found: list[MovingPart] = []
    for slide in sorted(problem.slides.values(), key=lambda slide: slide.host != FRAME):
        link = slide.slider
        if link in contacts(problem):
            continue
        if slide.host == FRAME:
            found += _on_frame(scheme, slide)
            block = _block(scheme, slide)
            scheme.own_blocks.append((link, block))
        else:
            alone = _drawn(scheme, slide, letter_height)
            found += _on_link(alone, slide)
            block = alone.blocks[-1]
            if not alone.index:
                scheme.own_blocks += alone.own_blocks
                for of, bars in alone.segments.items():
                    scheme.segments.setdefault(of, []).extend(bars)
        if not problem.is_block(slide):  # the link's rods are rigid with it
            lines, welds = welded(rods[link], f"link {link}", block, scheme.factor)
            rods[link] = [*lines, *welds]
    found = [*(MovingPart(link, 0, LINES, tuple(items)) for link, items in rods.items()), *found]
    for link in problem.bodies:
        found.append(MovingPart(link, 0, GUIDES, tuple(wheel_items(scheme, [link]))))
    scheme.draw_joints()
    for link in problem.bodies:
        bends = [item for item in scheme.corners if item.tag == f"link {link}"]
        found.append(MovingPart(link, 0, LINES, tuple(bends)))
    pivots = {joint.point for joint in problem.mechanism.revolutes}
    for joint in problem.mechanism.revolutes:
        links = [link for link in joint.links if link != FRAME]
        place = scheme.at(joint.point)
        link = next((one for one in links if scheme.passing(one, place)), links[0])
        found.append(MovingPart(link, 0, JOINTS, tuple(scheme.joint_items(joint, place))))
    held = [item for at in anchors(solution) for item in revolute(at, factor=scheme.factor)]
    found.append(MovingPart(FRAME, 0, JOINTS, tuple(held)))
    for number, spring in enumerate(springs_in(problem), 1):
        if spring.is_torsion:  # its spiral turns with the link that is not the frame
            link = next(link for link in spring.links[::-1] if link != FRAME)
            found.append(MovingPart(link, 0, LINES, tuple(spring_items(scheme, spring, number))))
    for link, body in problem.bodies.items():
        dots = tuple(
            item
            for point in body.points
            if link != FRAME and point not in pivots
            for item in scheme.mark(point)
        )
        found.append(MovingPart(link, 0, JOINTS, dots))
    fixed = [item for support in scheme.supports for item in support.items()]
    found.append(MovingPart(FRAME, 0, GUIDES, (*fixed, *_sense(scheme))))
    return sorted((p for p in found if p.items), key=lambda part: part.layer), scheme


def _block(scheme: Scheme, slide: Slide) -> BlockOutline:
    """Return the outline of a slider of the frame."""
    length, width = (size * scheme.factor for size in (SIZES.slider_length, SIZES.slider_width))
    return BlockOutline(scheme.at(slide.pin), cis(slide.angle), length, width)


def _drawn(scheme: Scheme, slide: Slide, letter_height: float) -> Scheme:
    """Return stone or block drawn alone, where a bar through the block has its full length."""
    solution = scheme.solution
    index = 0
    if solution.problem.is_block(slide) and slide.through is not None:
        paper = solution.paper
        reach = paper.point(PointName(slide.pin)) - paper.point(PointName(slide.through))
        index = int(np.argmax(np.abs(reach)))
    alone = Scheme(solution, index, letter_height)
    alone.draw_slider(slide)
    return alone


def _on_link(scheme: Scheme, slide: Slide) -> Iterator[MovingPart]:
    """Yield stone or block with the parts rigid with it, and the bar through a block."""
    body = slide.host if scheme.solution.problem.is_block(slide) else slide.slider
    yield MovingPart(body, scheme.index, BODIES, tuple(scheme.slider_items))
    for link in (slide.host, slide.slider):
        lines = (one for one in scheme.lines if one.tag == f"link {link}")
        yield MovingPart(link, scheme.index, LINES, tuple(lines))
    yield MovingPart(body, scheme.index, LINES, tuple(scheme.corners))


def _on_frame(scheme: Scheme, slide: Slide) -> Iterator[MovingPart]:
    """Yield a slider, and its fixed guide over its travel, hatched away from the mechanism."""
    solution, factor = scheme.solution, scheme.factor
    along = cis(slide.angle)
    angle, pin = slide.angle, scheme.at(slide.pin)
    way = ((solution.paper.point(PointName(slide.pin)) - pin) * along.conjugate()).real
    half = SIZES.slider_length / 2 * factor
    low, high = float(way.min()) - half, float(way.max()) + half
    bodies = (body.points for body in solution.problem.bodies.values() if slide.pin in body.points)
    others = [solution.paper.point(PointName(p)) for points in bodies for p in points]
    left = sum(float(np.sum(((at - pin) * along.conjugate()).imag)) for at in others)
    guide = guide_line(
        pin, angle=angle, before=-low + 2, after=high + 2, side=-1 if left > 0 else 1, factor=factor
    )
    beyond = AXIS * factor
    axis = axis_line(pin + along * (low - beyond), pin + along * (high + beyond), tag="guide")
    yield MovingPart(FRAME, 0, GUIDES, (*axis, *guide))
    yield MovingPart(slide.slider, 0, BODIES, tuple(slider(pin, angle=angle, factor=factor)))


def _sense(scheme: Scheme) -> list[Item]:
    """Return the arrow of a crank's sense."""
    drive = scheme.solution.problem.drive
    if not drive.revolves or drive.pivot is None:
        return []
    sense = (drive.rate > 0) - (drive.rate < 0)
    return turn_arrow(scheme.at(drive.pivot), 7.0 * scheme.factor, sense, middle=45.0, sweep=80.0)
