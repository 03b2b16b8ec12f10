"""The analysed cycle of motion (цикл движения): ``[cycle]``."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from typing import Any

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields
from planmethod.problem.cycle_records import CycleTask, PoleDistances, StrokeSense, Zero
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import CustomReader, read_flat
from planmethod.problem.graphs import OUTPUT, graph_quantities
from planmethod.problem.machine_records import Machine
from planmethod.problem.model import SAME_DEG, Body, Drive, Slide
from planmethod.problem.names import nearest_name, short

_EXAMPLE = '[cycle] output = "B", zero = "extreme", count = 12'
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
    faults: Faults,
    table: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
    machine: Machine | None,
    count: int,
) -> CycleTask | None:
    """Read ``[cycle]``; None after a fault.

    Parameters
    ----------
    bodies, slides : mapping
        As far as the file has them.
    drive, machine : Drive or None, Machine or None
        None where it has a fault of its own; data that only a machine has apply to the cycle.
    count : int
        Positions of the cycle (`cycle_count`).
    """
    before = len(faults)
    entries = fields.read_table(faults, "cycle", table, _EXAMPLE)
    if entries is None:
        return None
    if drive is not None and not drive.goes_round:
        faults.add(
            "cycle",
            translate("the driver, link {}, slides: it has no turn", drive.link),
            "A cycle is a turn of a crank. Delete [cycle], or let a crank drive.",
        )
    output = partial(_read_output, bodies=bodies, slides=slides, drive=drive)
    graphs = partial(_read_graphs, bodies=bodies, slides=slides, drive=drive)
    own: dict[str, CustomReader] = {
        "output": output,
        "zero": _read_zero,
        "pole": _read_pole,
        "graphs": graphs,
    }
    found = read_flat(faults, "cycle", entries, CycleTask, own)
    if len(faults) > before:
        return None
    _check_working(faults, found, slides)
    if machine is not None:
        found |= _of_machine(faults, found, machine)
        count //= round(machine.cycle_deg / 360.0)
    found.setdefault("count", count)
    return None if len(faults) > before else CycleTask(**found)


def _check_working(faults: Faults, entries: Mapping[str, Any], slides: Mapping[str, Slide]) -> None:
    """Reject a sense of rotation of an output that slides."""
    sense, output = entries.get("working"), entries.get("output")
    slides_on = output in slides or any(slide.pin == output for slide in slides.values())
    if sense in (StrokeSense.CCW, StrokeSense.CW) and slides_on:
        hint = 'Say where it goes: "left", "right", "up" or "down".'
        faults.add("cycle.working", translate("{} slides: it does not turn", output), hint)


def _of_machine(faults: Faults, entries: Mapping[str, Any], machine: Machine) -> dict[str, Any]:
    """Return the data of the positions that only ``[machine]`` has; data in both must agree."""
    told: dict[str, Any] = {}
    turns = round(machine.cycle_deg / 360.0)
    start, count = machine.start_deg, machine.stated_count
    if start is not None and "zero" not in entries:
        told["zero"] = start
    elif start is not None and not isinstance(entries["zero"], Zero):
        report_start(faults, entries["zero"], start)
    if count is None:
        return told
    if "count" not in entries and count % turns == 0 and count // turns in _COUNTS:
        told["count"] = count // turns
    elif count != entries.get("count", 0) * turns:
        message = translate("{} positions of a cycle of {:g} degrees", count, machine.cycle_deg)
        if "count" in entries:
            message = translate("{}, and [cycle] has {} of a turn", message, entries["count"])
        hint = "The positions are those of [cycle]: delete count of [machine]."
        faults.add("machine.count", message, hint)
    return told


def report_start(faults: Faults, zero: float, start: float) -> None:
    """Note a fault if a machine starts in another position than the cycle."""
    if abs((start - zero + 180.0) % 360.0 - 180.0) > SAME_DEG:
        hint = "The positions are those of [cycle]: delete phi_0 of [machine]."
        message = translate("{:g} deg, and position 0 of [cycle] is at {:.2f} deg", start, zero)
        faults.add("machine.phi_0", message, hint)


def with_cycle_count(faults: Faults, machine: Machine, cycle: CycleTask) -> Machine:
    """Return a machine with as many positions as the cycle has."""
    count = cycle.count * round(machine.cycle_deg / 360.0)
    if count not in _OF_MACHINE and machine.stated_count is None:
        message = translate("{} positions of a cycle of {:g} degrees", count, machine.cycle_deg)
        low, high = _OF_MACHINE[0], _OF_MACHINE[-1]
        faults.add("cycle.count", message, translate("A flywheel takes from {} to {}.", low, high))
    return replace(machine, count=count)


def _read_zero(faults: Faults, path: str, value: object) -> Zero | float | None:
    if fields.is_number(value):
        return fields.read_angle(faults, path, value)
    if isinstance(value, str):
        word = fields.read_word(faults, path, value, _NAMED)
        return None if word is None else _NAMED[word]
    wanted = translate(" or ").join(f'"{word}"' for word in _NAMED)
    faults.expected(path, translate("{} or an angle in degrees", wanted), value)
    return None


def _read_pole(faults: Faults, path: str, value: object) -> PoleDistances:
    table = fields.read_table(faults, path, value, "pole = { v = 36, a = 36 }")
    return PoleDistances(**read_flat(faults, path, table or {}, PoleDistances))


def _read_output(
    faults: Faults,
    path: str,
    value: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
) -> str | None:
    """Read the output: a link, or a point of a link that moves along a guide of the frame."""
    if not isinstance(value, str):
        hint = translate('Write output = "{}".', value) if isinstance(value, int) else ""
        faults.expected(path, "a point or a link", value, hint)
        return None
    moving = [link for link in bodies if link != FRAME]
    name = value if value in moving else fields.unmask(faults, path, value)
    if name in moving:
        if drive is not None and name == drive.link:
            faults.add(
                path, translate("link {} drives", name), "The output is a link that is driven."
            )
            return None
        return name
    points = list(dict.fromkeys(point for link in moving for point in bodies[link].points))
    if name not in points:
        fields.report_unknown(
            faults, path, name, [*points, *moving], message="unknown point or link '{}'"
        )
        return None
    if guiding(name, bodies, slides) is None:
        links = [link for link in moving if name in bodies[link].points]
        faults.add(
            path,
            translate("point {} moves along no guide of the frame", name),
            translate(
                "Name a point of a slider, or a link whose angle is meant: {}.", ", ".join(links)
            ),
        )
        return None
    return name


def _read_graphs(
    faults: Faults,
    path: str,
    value: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
) -> tuple[str, ...]:
    """Read the quantities of the requested graphs."""
    if not isinstance(value, list) or not 1 <= len(value) <= _MAX_GRAPHS:
        example = 'graphs = ["v_q_C", "u_31", "x_C"]'
        faults.expected(
            path, translate("a list of quantities, 1 to {} of them", _MAX_GRAPHS), value,
            translate("For example: {}", example),
        )  # fmt: skip
        return ()
    moving = [link for link in bodies if link != FRAME]
    fixed = bodies[FRAME].points if FRAME in bodies else {}
    points = [p for link in moving for p in bodies[link].points if p not in fixed]
    for slide in slides.values():  # the coincident points of a sliding pair
        points += [f"{slide.pin}{slide.host}"] if slide.host != FRAME else []
        points += [f"{slide.through}{slide.slider}"] if slide.through else []
    crank = "" if drive is None else drive.link
    known = [*graph_quantities(dict.fromkeys(points), moving, crank), OUTPUT]
    for k, label in enumerate(value):
        if not isinstance(label, str):
            faults.expected(f"{path}[{k}]", "a quantity", label)
        elif drive is not None and label not in known:
            phrase = "unknown quantity '{}'"
            faults.add(f"{path}[{k}]", translate(phrase, short(label)), _nearest(label, known))
    return tuple(label for label in value if isinstance(label, str))


def _nearest(label: str, known: list[str]) -> str:
    guess = nearest_name(label, known)
    if guess is not None:
        return translate("Did you mean '{}'?", guess)
    return 'For example: "x_C", "phi_3", "v_q_C", "u_31", "omega_3", "a_C".'


def guiding(point: str, bodies: Mapping[str, Body], slides: Mapping[str, Slide]) -> Slide | None:
    """Return the slide on the frame of the link that a point belongs to; None without one."""
    for slide in slides.values():
        body = bodies.get(slide.slider)
        if slide.host == FRAME and body is not None and point in body.points:
            return slide
    return None
