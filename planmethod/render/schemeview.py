"""The scheme as a view of the sheet: the drawn mechanism with its letters, numbers and arrows."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import lru_cache

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.note.given import point_name, solution_peak
from planmethod.note.numbers import is_nothing
from planmethod.plans.draft import cis
from planmethod.plans.model import PlanKind
from planmethod.plans.solution import Solution
from planmethod.render.block import Picture
from planmethod.render.drawing import Item, Pen, Stroke
from planmethod.render.ellipses import Ellipses, error_ellipses
from planmethod.render.extent import lettered
from planmethod.render.labels import Label, segment_label
from planmethod.render.scheme import Scheme
from planmethod.render.symbols import SIZES, angle_of, before_links, turn_arrow
from planmethod.render.typeset import typeset


@dataclass(slots=True)
class _View:
    """A drawn scheme and what is written on it."""

    scheme: Scheme
    arrows: list[Item] = field(default_factory=list)
    labels: list[Label] = field(default_factory=list)


def _letter_points(view: _View) -> None:
    scheme = view.scheme
    for point in scheme.named:
        place = scheme.at(point)
        lines = scheme.directions(place)
        view.labels.append(
            Label(
                typeset(point_name(point), scheme.letter_height),
                place,
                prefer=-sum(lines, 0j) if lines else 1 + 1j,
                gap=1.5 * scheme.factor + 1.2,
                priority=1,
                name=f"point {point}",
            )
        )


def _letter_axes(view: _View) -> None:
    """Letter the ends of the guides' axes, but for an end that lies on a link."""
    scheme = view.scheme
    for label, low, high in scheme.axis_ends:
        names = label.split("-")
        if len(names) != 2:
            continue
        ends = [(names[0], low, low - high), (names[1], high, high - low)]
        free = [scheme.clearance(place) for _, place, _ in ends]
        for (text, place, away), room in zip(ends, free, strict=True):
            if room > 4.0 or room == max(free):
                view.labels.append(
                    Label(typeset(text, scheme.letter_height), place, prefer=away, gap=1.0)
                )


def _letter_links(view: _View) -> None:
    """Put the links' numbers down, and circular arrows for the senses of omega and epsilon."""
    scheme = view.scheme
    small = scheme.letter_height
    for link in scheme.solution.problem.mechanism.links:
        parts = scheme.segments.get(link)
        text = link
        if parts:
            start, end = max(parts, key=lambda part: abs(part[1] - part[0]))
            view.labels.append(segment_label(text, start, end, small, gap=1.2))
        else:
            first = next(iter(scheme.solution.problem.bodies[link].points))
            view.labels.append(
                Label(typeset(text, small), scheme.at(first), gap=5.5 * scheme.factor)
            )
        _senses(view, link)


def _senses(view: _View, link: str) -> None:
    scheme = view.scheme
    motion = scheme.solution.links[link]
    problem = scheme.solution.problem
    body = problem.bodies[link].points
    if link in problem.slides and len(body) == 1:
        return  # the stone turns with the link that it slides on: one arrow for both
    pivot = next((p for p in body if p in problem.bodies[FRAME].points), None)
    parts = scheme.segments.get(link)
    if not parts:
        return
    start, end = max(parts, key=lambda part: abs(part[1] - part[0]))
    if pivot is not None:
        centre = scheme.at(pivot)
        other = end if abs(end - centre) > abs(start - centre) else start
        radius = max(10.0 * scheme.factor, min(20.0 * scheme.factor, 0.6 * abs(other - centre)))
    else:
        centre, other, radius = start + 0.4 * (end - start), end, 8.0 * scheme.factor
    turn = angle_of(other - centre)
    for symbol, value, shift in (
        ("ω", float(motion.omega[scheme.index]), 0.0),
        ("ε", float(motion.epsilon[scheme.index]), 3.5 * scheme.factor),
    ):
        if is_nothing(value, solution_peak(scheme.solution, symbol)):
            continue
        sense = 1 if value > 0 else -1
        middle, sweep = turn, 70.0
        arrow = turn_arrow(
            centre,
            radius + shift,
            sense,
            middle=middle,
            sweep=sweep,
            length=3.5 * scheme.factor,
            tag=f"{symbol} {link}",
        )
        view.arrows += arrow
        tail = centre + (radius + shift) * cis(middle - sense * sweep / 2)
        view.labels.append(
            Label(
                typeset(f"{symbol}_{{{link}}}", scheme.letter_height),
                tail,
                prefer=tail - centre,
                gap=0.8,
                name=f"{symbol} {link}",
            )
        )


def _draw_angle(view: _View) -> None:
    """Show the crank's angle phi from the horizontal."""
    scheme = view.scheme
    drive = scheme.solution.problem.drive
    if drive.pivot is None:
        return
    phi = float(scheme.solution.positions[scheme.index]) % 360.0
    if phi < 8 or phi > 352:
        return
    centre, radius = scheme.at(drive.pivot), 6.0 * scheme.factor + 2
    support = angle_of(scheme.free_direction(centre)) % 360.0
    if support < phi:
        radius = (SIZES.support_height + SIZES.hatch_stroke + 4.0) * scheme.factor
        pins = [scheme.at(p) for p in scheme.solution.problem.bodies[drive.link].points]
        if max(abs(pin - centre) for pin in pins) < radius + 4.0:
            return  # no room for an arc around the support: the statement tells the angle
    scheme.guides.append(Stroke((centre, centre + radius + 6), Pen.THIN, tag="phi"))
    scheme.guides += turn_arrow(centre, radius, 1, middle=phi / 2, sweep=phi, length=2.5, tag="phi")
    view.labels.append(
        Label(
            typeset(f"φ_{{{drive.link}}}", 3.5),
            centre + radius * cis(phi / 2),
            prefer=cis(phi / 2),
            gap=1.0,
            name="phi",
        )
    )


def ghost(solution: Solution, index: int, letter_height: float) -> list[Item]:
    """Return the mechanism in another position: pale lines only."""
    scheme = Scheme(solution, index, letter_height, pen=Pen.PALE)
    for link in solution.problem.mechanism.links:
        scheme.draw_link(link)
    return scheme.lines


@lru_cache(maxsize=64)
def scheme_picture(
    solution: Solution,
    index: int,
    *,
    letter_height: float = 5.0,
    overlay: tuple[int, ...] = (),
    errors: bool = False,
) -> Picture:
    """Return the scheme in one position as a picture, mm.

    The positions of ``overlay`` are there in pale lines, the driver's pin numbered. ``errors``
    draws the ellipses of the drafting error around the moving points.
    """
    scheme = Scheme(solution, index, letter_height)
    scheme.draw()
    scheme.draw_joints()
    view = _View(scheme)
    for write in (_letter_points, _letter_axes, _letter_links, _draw_angle):
        write(view)
    ghosts: list[Item] = []
    for other in overlay:
        if other != index:
            ghosts += ghost(solution, other, letter_height)
    view.labels += _numbers(solution, letter_height, overlay)
    ellipses = error_ellipses(solution, PlanKind.POSITION, index) if errors else Ellipses()
    items = [
        *ghosts,
        *scheme.guides,
        *before_links([*scheme.bodies, *scheme.lines, *scheme.corners, *scheme.joints]),
        *view.arrows,
        # After the joints, whose white would cover them.
        *ellipses.strokes,
    ]
    return lettered(items, view.labels, clear=ellipses.grounds)


def _numbers(solution: Solution, letter_height: float, overlay: tuple[int, ...]) -> list[Label]:
    """Return the numbers of the positions at the driver's pin."""
    drive = solution.problem.drive
    if drive.pivot is None:
        return []
    body = solution.problem.bodies[drive.link].points
    pin = next(p for p in body if p != drive.pivot)
    places = solution.complexes(solution.paper, PointName(pin))
    centre = complex(solution.complexes(solution.paper, PointName(drive.pivot))[0])
    return [
        Label(
            typeset(str(number), min(letter_height, 3.5)),
            complex(place),
            prefer=complex(place) - centre,
            gap=1.5,
            name=f"position {number}",
        )
        for number, place in enumerate(places)
        if number in overlay
    ]
