"""A linkage as JSON of pylinkage's class ``Mechanism`` (экспорт).

Places are those of the drawn position, else of the first one. pylinkage takes lengths from them.
"""

from __future__ import annotations

import cmath
import json
from collections.abc import Mapping
from typing import Any

from planmethod.construct.steps import PointName
from planmethod.mechanism.model import FRAME
from planmethod.peers.foreign import reject
from planmethod.problem.model import Problem, Slide
from planmethod.problem.placement import rotation
from planmethod.solved.solution import Solution


def to_pylinkage(problem: Problem) -> str:
    """Return a linkage as JSON of pylinkage, in metres; the rate is in radians a second.

    Raises
    ------
    ProblemError
        pylinkage has no such joint or driver.
    """
    drive = problem.drive
    source = problem.source_file
    if drive.pivot is None:
        reject(source, "pylinkage has no driving slider", hint="Drive a crank.")
    if drive.other_drives:
        links_of = ", ".join(drive.links)
        reject(source, "pylinkage moves a mechanism by one crank, and links {} drive", links_of)
    start = (drive.assembly_positions or drive.positions)[0]
    solution = Solution(problem, positions=[start])
    at = {
        point: complex(solution.place(PointName(point))[0])
        for body in problem.bodies.values()
        for point in body.points
    }
    axis_angles = {link: float(one.phi_deg[0]) for link, one in solution.links.items()}
    joints: dict[str, dict[str, Any]] = {}
    for point, place in at.items():
        kind = "ground" if point in problem.bodies[FRAME].points else "revolute"
        joints[point] = {"id": point, "type": kind, "position": _pair(place)}
    ground = [*problem.bodies[FRAME].points]
    links: list[dict[str, Any]] = []
    slots: dict[str, list[str]] = {}
    for slide in problem.slides.values():
        links.append(_guide(problem, slide, joints, ground, at, axis_angles))
        slots.setdefault(slide.host, []).extend(links[-1]["joints"][:-1])
    for name, body in problem.bodies.items():
        points = list(dict.fromkeys([*body.points, *slots.get(name, ())]))
        if name == FRAME or len(points) < 2:
            continue
        link: dict[str, Any] = {"id": name, "type": "link", "joints": points}
        if name == drive.link:
            others = [point for point in points if point != drive.pivot]
            link |= {
                "type": "driver",
                "joints": [drive.pivot, *others],
                "angular_velocity": drive.rate,
                "initial_angle": cmath.phase(at[others[0]] - at[drive.pivot]),
                "motor_joint": drive.pivot,
            }
        links.append(link)
    frame = {"id": "ground", "type": "ground", "joints": ground}
    data = {
        "name": problem.title or problem.name,
        "joints": [*joints.values()],
        "links": [frame, *links],
        "ground": "ground",
    }
    return json.dumps(data, ensure_ascii=False, indent=2) + "\n"


def _pair(place: complex) -> list[float]:
    return [place.real, place.imag]


def _guide(
    problem: Problem,
    slide: Slide,
    joints: dict[str, dict[str, Any]],
    ground: list[str],
    at: dict[str, complex],
    axis_angles: Mapping[str, float],
) -> dict[str, Any]:
    """Return the link that guides a slider, with two joints on the line of its pin.

    ``axis_angles`` are the directions of own axes, degrees.
    """
    pin, source = slide.pin, problem.source_file
    if len(problem.bodies[slide.slider].points) > 1:
        reject(source, "pylinkage has no slider with several points: link {}", slide.slider)
    if joints[pin]["type"] == "prismatic":
        links = ", ".join(one.slider for one in problem.slides.values() if one.pin == pin)
        reject(source, "pylinkage has one slot for a pin: {} is in those of links {}", pin, links)
    if joints[pin]["type"] == "ground":
        reject(source, "pylinkage has no slot that slides over a fixed pin: link {}", slide.slider)
    if slide.host == FRAME:
        axis = rotation(slide.angle)
        ends = []
        for k, along in enumerate((0.0, 1.0)):
            place = slide.base + axis * (1j * slide.offset + along)
            key = f"{slide.slider}_{k}"
            joints[key] = {"id": key, "type": "ground", "position": [place.real, place.imag]}
            ground.append(key)
            ends.append(key)
    else:
        ends, axis = _ends_of_slot(problem, slide, at, axis_angles)
        for end in ends:
            joints.setdefault(end, {"id": end, "type": "revolute", "position": _pair(at[end])})
    joints[pin] |= {"type": "prismatic", "axis": [axis.real, axis.imag], "slide_distance": 0.0}
    return {"id": f"{slide.slider}_guide", "type": "link", "joints": [*ends, pin]}


def _ends_of_slot(
    problem: Problem, slide: Slide, at: dict[str, complex], axis_angles: Mapping[str, float]
) -> tuple[list[str], complex]:
    """Return two joints on the line of a pin along a moving link, and the direction of that line.

    A slot beside the points of the link has joints of its own there, which are added to ``at``.
    """
    host = problem.bodies[slide.host].points
    if slide.through is not None and slide.towards is not None and not slide.offset:
        ends = [slide.through, slide.towards]
        line = at[ends[1]] - at[ends[0]]
        return ends, line / abs(line)
    axis = rotation(axis_angles[slide.host] + slide.angle)
    base = next(iter(host))
    along = ((at[slide.pin] - at[base]) * axis.conjugate()).real
    foot = at[slide.pin] - axis * along  # so that the ends do not depend on where the pin is
    size = max((abs(at[point] - at[base]) for point in host), default=0.0) or abs(along) or 1.0
    for k, way in enumerate((0.0, size)):
        at[f"{slide.slider}_{k}"] = foot + axis * way
    return [f"{slide.slider}_{k}" for k in (0, 1)], axis
