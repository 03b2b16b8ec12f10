"""The statement of a problem in symbols: what is given, what to find (Дано, Определить)."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from planmethod.mechanism.model import FRAME
from planmethod.note.numbers import Notation, trimmed, with_unit
from planmethod.note.wording import Language
from planmethod.plans.legend import Quantity, QuantityKind
from planmethod.problem.model import Body, Geared, Problem, Slide
from planmethod.solved.solution import Solution


def coordinate(value: float, problem: Problem, say: Notation) -> str:
    """Return a given coordinate as rich text, with the digits that the mechanism needs."""
    size = max((length for _, _, length in problem.lengths), default=abs(value))
    if abs(float(trimmed(value)) - value) <= 1e-6 * size:
        return say.given(value)
    return say.number(trimmed(value, 15))


def point_name(point: str) -> str:
    """Return a point's name as rich text: S2 gives ``S_{2}``."""
    return f"{point[:1]}_{{{point[1:]}}}" if point[1:] else point


def given(problem: Problem, words: Language, positions: Sequence[float] | None = None) -> list[str]:
    """Return what is given, one ``symbol = value unit`` each.

    ``positions`` are the driver's, degrees (m for a slider); the file's when absent.
    """
    drive, number, units = problem.drive, words.say.given, words.say.units
    asked = drive.positions if positions is None else positions
    unit = units[drive.coordinate.unit]
    lines = [f"{drive.coordinate.symbol} {_asked([float(one) for one in asked], unit, words)}"]
    named = {name for _, name, _ in problem.lengths}
    for _, name, metres in problem.lengths:
        lines.append(f"l_{{{name}}} = {number(metres)} {units['m']}")
    for link, body in problem.bodies.items():
        if link != FRAME:
            lines += _distances(body, named, words)
    for point, place in problem.bodies[FRAME].points.items():
        if place != 0:
            lines += _coordinates(point, place, problem, words.say)
    carried = {slide.label for slide in problem.slides.values() if slide.host == FRAME}
    for guide, (through, base, angle) in problem.guides.items():
        if through is None:
            lines += _guide(guide, base, angle, problem, words.say)
        elif guide in carried:
            point = point_name(through)
            lines.append(words.note.given_through.format(guide=guide, point=point))
    pins = [slide.pin for slide in problem.slides.values() if slide.offset]
    for slide in problem.slides.values():
        lines += _carried(problem, slide, words)
        if slide.offset:
            name = slide.pin if pins.count(slide.pin) == 1 else f"{slide.pin}{slide.slider}"
            lines.append(f"e_{{{name}}} = {number(slide.offset)} {units['m']}")
    if drive.is_crank:
        lines += [] if drive.geared is None else _through(drive.geared, words)
        constant = "" if drive.acceleration else " = const"
        wheel = "" if drive.geared is None else f" = ω_{{{drive.geared.label}}}"
        lines.append(f"ω_{{{drive.link}}}{wheel} = {number(drive.rate)} {units['1/s']}{constant}")
        if drive.acceleration:
            lines.append(f"ε_{{{drive.link}}} = {number(drive.acceleration)} {units['1/s²']}")
    else:
        lines.append(f"v = {number(drive.rate)} {units['m/s']}")
        lines.append(f"a = {number(drive.acceleration)} {units['m/s²']}")
    return lines


MOST_LISTED = 6
"""Most positions that are given one by one."""


def _asked(asked: Sequence[float], unit: str, words: Language) -> str:
    """Return the driver's positions: all of a few, else the ends and the step, else the count."""
    said = [with_unit(words.say.given(one), unit) for one in asked[:MOST_LISTED]]
    if len(asked) <= MOST_LISTED:
        return f"= {', '.join(said)}"
    first, last = said[0], with_unit(words.say.given(asked[-1]), unit)
    step = (asked[-1] - asked[0]) / (len(asked) - 1)
    if np.ptp(np.diff(asked)) <= 1e-6 * abs(step) and abs(round(step, 4) - step) < 1e-9:
        step_said = with_unit(words.say.given(round(step, 4)), unit)
        return words.note.given_steps.format(first=first, last=last, step=step_said)
    return f"= {first}…{last}{words.note.given_count.format(count=len(asked))}"


def _through(geared: Geared, words: Language) -> list[str]:
    """Return what drives the crank: the speeds of the inputs, and the ratio to it."""
    letter, unit = ("n", "1/min") if geared.unit == "n" else ("ω", "1/s")
    lines = [
        f"{letter}_{{{label}}} = {words.say.given(speed)} {words.say.units[unit]}"
        for label, speed in geared.inputs
    ]
    if geared.ratio is not None:
        source, ratio = geared.inputs[0][0], words.say.given(float(geared.ratio))
        lines.append(f"U_{{{source}-{geared.label}}} = {ratio}")
    return lines


def _distances(body: Body, named: set[str], words: Language) -> list[str]:
    """Return the distances that place a link's further points, where no length was given."""
    points = list(body.points)
    ends = body.axis or (points[0],)
    lines = []
    for point in points:
        # A point on the axis is told by one distance, another one by two.
        off_axis = abs(body.points[point].imag) > 1e-9 * abs(body.points[point])
        for end in ends[: 2 if off_axis else 1]:
            if point not in ends and f"{end}{point}" not in named and f"{point}{end}" not in named:
                metres = abs(body.points[point] - body.points[end])
                length = f"{words.say.given(metres)} {words.say.units['m']}"
                lines.append(f"l_{{{end}{point}}} = {length}")
        if off_axis and body.axis is not None:
            left = body.points[point].imag > 0
            side = words.note.given_left if left else words.note.given_right
            lines.append(side.format(point=point_name(point), line=_line(*body.axis)))
    return lines


def _line(start: str, end: str) -> str:
    return f"{point_name(start)}{point_name(end)}"


def _carried(problem: Problem, slide: Slide, words: Language) -> list[str]:
    """Return how the line of a moving link lies on it, where two letters do not tell it."""
    axis = problem.bodies[slide.host].axis
    if slide.host == FRAME or slide.through is None or slide.towards is not None or axis is None:
        return []
    angle = words.say.given(slide.angle)
    if slide.offset:
        guide = words.note.given_guide.format(link=slide.host, line=_line(*axis))
        return [f"{guide} = {angle}°"]
    line = _line(slide.through, slide.pin)
    if slide.angle % 180 == 90:
        return [f"{line} ⊥ {_line(*axis)}"]
    return [f"∠({line}, {_line(*axis)}) = {angle}°"] if slide.angle % 180 else []


def _coordinates(name: str, place: complex, problem: Problem, say: Notation) -> list[str]:
    x, y = (coordinate(value, problem, say) for value in (place.real, place.imag))
    return [f"x_{{{name}}} = {x} {say.units['m']}", f"y_{{{name}}} = {y} {say.units['m']}"]


def _guide(name: str, base: complex, angle: float, problem: Problem, say: Notation) -> list[str]:
    """Return where a guide is: by one coordinate when it runs along an axis."""
    x, y = _coordinates(name, base, problem, say)
    if angle % 180 == 90:
        return [x]
    if angle % 180 == 0:
        return [y]
    return [x, y, f"∠({name}) = {say.given(angle)}°"]


def asked_points(solution: Solution) -> list[str]:
    """Return the moving points whose velocity and acceleration the sheet tells.

    Points of a link that does not turn move alike: the first stands for them all.
    """
    velocity = solution.construction.kinematics.velocity
    seen: set[object] = {velocity.pole}
    asked = []
    for name, at in velocity.named.items():
        if velocity.point[at] not in seen:
            seen.add(velocity.point[at])
            asked.append(name)
    return asked


def asked_links(solution: Solution) -> list[str]:
    """Return the links whose angular velocity is not given and not zero by nature."""
    kin = solution.construction.kinematics
    drive = solution.problem.drive.link
    return [
        link for link in solution.problem.mechanism.links if link in kin.omega and link != drive
    ]


MOTION_KINDS = (
    QuantityKind.VELOCITY,
    QuantityKind.OMEGA,
    QuantityKind.ACCELERATION,
    QuantityKind.EPSILON,
)
"""Kinds of quantities that a sheet tells, in their order."""

TURNINGS = (QuantityKind.OMEGA, QuantityKind.EPSILON)
"""Kinds of quantities of links; the others are of points."""


def told(solution: Solution, *kinds: QuantityKind) -> list[Quantity]:
    """Return the quantities of the motion that a sheet tells, kind by kind.

    Of points and links those of `asked_points` and `asked_links`.
    """
    still = {*solution.points} - {*asked_points(solution)}
    driven = {*solution.links} - {*asked_links(solution)}
    return [
        quantity
        for kind in kinds
        for of, quantities in solution.quantities(kind).items()
        for quantity in quantities
        if of not in (driven if kind in TURNINGS else still)
    ]


def wanted(solution: Solution) -> str:
    """Return what is to be found, as one line of symbols."""
    return ", ".join(quantity.symbol for quantity in told(solution, *MOTION_KINDS))


def solution_peak(solution: Solution, kind: QuantityKind) -> float:
    """Return the largest value of a kind of quantities in all positions of a solution."""
    found = [quantity for each in solution.quantities(kind).values() for quantity in each]
    return float(np.max([np.abs(solution.exact(quantity)) for quantity in found]))
