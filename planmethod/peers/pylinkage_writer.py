"""A linkage as JSON of pylinkage's class ``Mechanism`` (экспорт).

Places are those of the drawn position, else of the first one. pylinkage takes lengths from them.
"""

from __future__ import annotations

import cmath
import json
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
    start = (drive.assembly_positions or drive.positions)[0]
    solution = Solution(problem, positions=[start])
    at = {
        point: complex(solution.place(PointName(point))[0])
        for body in problem.bodies.values()
        for point in body.points
    }
    joints: dict[str, dict[str, Any]] = {}
    for point, place in at.items():
        kind = "ground" if point in problem.bodies[FRAME].points else "revolute"
        joints[point] = {"id": point, "type": kind, "position": [place.real, place.imag]}
    ground = [*problem.bodies[FRAME].points]
    links: list[dict[str, Any]] = []
    for slide in problem.slides.values():
        links.append(_guide(problem, slide, joints, ground, at))
    for name, body in problem.bodies.items():
        points = [*body.points]
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


def _guide(
    problem: Problem,
    slide: Slide,
    joints: dict[str, dict[str, Any]],
    ground: list[str],
    at: dict[str, complex],
) -> dict[str, Any]:
    """Return the link that guides a slider, with two joints on the line of its pin."""
    pin, source = slide.pin, problem.source_file
    if len(problem.bodies[slide.slider].points) > 1:
        reject(source, "pylinkage has no slider with several points: link {}", slide.slider)
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
        if slide.through is None or slide.towards is None or slide.offset:
            reject(source, "pylinkage has no slot beside the points of link {}", slide.host)
        ends = [slide.through, slide.towards]
        line = at[ends[1]] - at[ends[0]]
        axis = line / abs(line)
    joints[pin] |= {"type": "prismatic", "axis": [axis.real, axis.imag], "slide_distance": 0.0}
    return {"id": f"{slide.slider}_guide", "type": "link", "joints": [*ends, pin]}
