"""The analysed cycle of motion (цикл движения): ``[cycle]``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.cycle_records import CycleTask, PoleDistances, StrokeSense, Zero
from planmethod.problem.file_node import FileNode, is_number
from planmethod.problem.graphs import OUTPUT, graph_quantities
from planmethod.problem.machine_records import Machine
from planmethod.problem.model import SAME_DEG, Body, Drive, Slide

_NAMED = {zero.value: zero for zero in Zero if zero is not Zero.USUAL}
_COUNTS, _OF_MACHINE = range(3, 361), range(4, 73)

_MAX_GRAPHS = 24
MAX_LISTED = 36
"""Maximum number of positions of a turn that a cycle without a count uses from the driver."""


def cycle_count(document: Mapping[str, Any]) -> int:
    """Return the number of positions of the cycle of a file, as far as it can be read; 0 if none.

    Parameters
    ----------
    document : mapping
        The whole file.
    """
    table, machine = document.get("cycle"), document.get("machine")
    if not isinstance(table, Mapping):
        return 0
    machine = machine if isinstance(machine, Mapping) else {}
    turns = 2 if machine.get("cycle_deg") == 720 else 1
    own, other = table.get("count"), machine.get("count")
    if isinstance(own, int) and own in _COUNTS:
        return own * turns
    if isinstance(other, int) and other % turns == 0 and other // turns in _COUNTS:
        return other
    return (_driver_count(document) or 12) * turns


def _driver_count(document: Mapping[str, Any]) -> int | None:
    """Return the number of positions if the driver of a file lists a full turn, else None."""
    driver = document.get("driver")
    phi = driver.get("phi") if isinstance(driver, Mapping) else None
    if not isinstance(phi, Mapping) or phi.keys() != {"from", "count"}:
        return None
    count = phi["count"]
    return count if isinstance(count, int) and _COUNTS[0] <= count <= MAX_LISTED else None


def read_cycle(
    file: FileNode,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
    machine: Machine | None,
) -> CycleTask:
    """Read ``[cycle]``.

    Parameters
    ----------
    bodies, slides : mapping
        As far as the file has them.
    drive, machine : Drive or None, Machine or None
        None where it has a fault of its own; data that only a machine has apply to the cycle.
    """
    node = file["cycle"]
    node.table('[cycle] output = "B", zero = "extreme", count = 12')
    if drive is not None and not drive.goes_round:
        hint = "A cycle is a turn of a crank. Delete [cycle], or let a crank drive."
        node.note("the driver, link {}, slides: it has no turn", drive.link, hint=hint)
    found = node.record(
        CycleTask,
        output=partial(_read_output, bodies=bodies, slides=slides, drive=drive),
        zero=_read_zero,
        pole=_read_pole,
        graphs=partial(_read_graphs, bodies=bodies, slides=slides, drive=drive),
    )
    node.require_sound()
    count = cycle_count(file.value)
    _check_working(node, found, slides)
    if machine is not None:
        found |= _of_machine(file["machine"], found, machine)
        file["machine"].require_sound()
        count //= round(machine.cycle_deg / 360.0)
    found.setdefault("count", count)
    return node.build(CycleTask, found)


def _check_working(node: FileNode, entries: Mapping[str, Any], slides: Mapping[str, Slide]) -> None:
    """Reject a sense of rotation of an output that slides."""
    sense, output = entries.get("working"), entries.get("output")
    slides_on = output in slides or any(slide.pin == output for slide in slides.values())
    if sense in (StrokeSense.CCW, StrokeSense.CW) and slides_on:
        hint = 'Say where it goes: "left", "right", "up" or "down".'
        node["working"].note("{} slides: it does not turn", output, hint=hint)


def _of_machine(node: FileNode, entries: Mapping[str, Any], machine: Machine) -> dict[str, Any]:
    """Return the data of the positions that only ``[machine]`` has; data in both must agree."""
    found: dict[str, Any] = {}
    turns = round(machine.cycle_deg / 360.0)
    start, count = machine.start_deg, machine.stated_count
    if start is not None and "zero" not in entries:
        found["zero"] = start
    elif start is not None and not isinstance(entries["zero"], Zero):
        check_start(node, entries["zero"], start)
    if count is None:
        return found
    if "count" not in entries and count % turns == 0 and count // turns in _COUNTS:
        found["count"] = count // turns
    elif count != entries.get("count", 0) * turns:
        message = translate("{} positions of a cycle of {:g} degrees", count, machine.cycle_deg)
        if "count" in entries:
            message = translate("{}, and [cycle] has {} of a turn", message, entries["count"])
        hint = "The positions are those of [cycle]: delete count of [machine]."
        node["count"].note(message, hint=hint)
    return found


def check_start(node: FileNode, zero: float, start: float) -> None:
    """Note a fault of ``[machine]`` if it starts in another position than the cycle."""
    if abs((start - zero + 180.0) % 360.0 - 180.0) > SAME_DEG:
        hint = "The positions are those of [cycle]: delete phi_0 of [machine]."
        message = "{:g} deg, and position 0 of [cycle] is at {:.2f} deg"
        node["phi_0"].note(message, start, zero, hint=hint)


def with_cycle_count(node: FileNode, machine: Machine, cycle: CycleTask) -> Machine:
    """Return a machine with as many positions as the cycle, which ``node`` is, has."""
    count = cycle.count * round(machine.cycle_deg / 360.0)
    if count not in _OF_MACHINE and machine.stated_count is None:
        hint = translate("A flywheel takes from {} to {}.", _OF_MACHINE[0], _OF_MACHINE[-1])
        message = "{} positions of a cycle of {:g} degrees"
        node["count"].note(message, count, machine.cycle_deg, hint=hint)
    return replace(machine, count=count)


def _read_zero(node: FileNode) -> Zero | float:
    if is_number(node.value):
        return node.angle()
    if not isinstance(node.value, str):
        wanted = translate(" or ").join(f'"{word}"' for word in _NAMED)
        node.reject_value(translate("{} or an angle in degrees", wanted))
    return _NAMED[node.word(_NAMED)]


def _read_pole(node: FileNode) -> PoleDistances:
    node.table("pole = { v = 36, a = 36 }")
    return node.build(PoleDistances, node.record(PoleDistances))


def _read_output(
    node: FileNode, bodies: Mapping[str, Body], slides: Mapping[str, Slide], drive: Drive | None
) -> str:
    """Read the output: a link, or a point of a link that moves along a guide of the frame."""
    moving = [link for link in bodies if link != FRAME]
    name = node.any_name("a point or a link", moving)
    if name in moving:
        if drive is not None and name == drive.link:
            node.reject("link {} drives", name, hint="The output is a link that is driven.")
        return name
    points = list(dict.fromkeys(point for link in moving for point in bodies[link].points))
    if name not in points:
        node.reject_unknown(name, [*points, *moving], "unknown point or link '{}'")
    if guiding(name, bodies, slides) is None:
        links = ", ".join(link for link in moving if name in bodies[link].points)
        hint = "Name a point of a slider, or a link whose angle is meant: {}."
        message = "point {} moves along no guide of the frame"
        node.reject(message, name, hint=translate(hint, links))
    return name


def _read_graphs(
    node: FileNode, bodies: Mapping[str, Body], slides: Mapping[str, Slide], drive: Drive | None
) -> tuple[str, ...]:
    """Read the quantities of the requested graphs."""
    wanted = partial(translate, "a list of quantities, 1 to {} of them", _MAX_GRAPHS)
    hint = partial(translate, "For example: {}", 'graphs = ["v_q_C", "u_31", "x_C"]')
    node.array(wanted, hint, low=1, high=_MAX_GRAPHS)
    moving = [link for link in bodies if link != FRAME]
    fixed = bodies[FRAME].points if FRAME in bodies else {}
    points = [p for link in moving for p in bodies[link].points if p not in fixed]
    for slide in slides.values():  # the coincident points of a sliding pair
        points += [f"{slide.pin}{slide.host}"] if slide.host != FRAME else []
        points += [f"{slide.through}{slide.slider}"] if slide.through else []
    crank = "" if drive is None else drive.link
    known = [*graph_quantities(dict.fromkeys(points), moving, crank), OUTPUT]

    def read_label(label: FileNode) -> str:
        if not isinstance(label.value, str):
            label.reject_value("a quantity")
        if drive is not None and label.value not in known:
            hint = 'For example: "x_C", "phi_3", "v_q_C", "u_31", "omega_3", "a_C".'
            label.reject_unknown(label.value, known, "unknown quantity '{}'", hint=hint)
        return label.value

    return node.read_all(read_label)


def guiding(point: str, bodies: Mapping[str, Body], slides: Mapping[str, Slide]) -> Slide | None:
    """Return the slide on the frame of the link that a point belongs to; None without one."""
    for slide in slides.values():
        body = bodies.get(slide.slider)
        if slide.host == FRAME and body is not None and point in body.points:
            return slide
    return None
