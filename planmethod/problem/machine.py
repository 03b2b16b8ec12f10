"""``[machine]``, ``[cycle]``, ``[project]`` of a problem file: flywheel, cycle, course project."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import PurePath
from typing import Any, TypeVar

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.drive import require_turning
from planmethod.problem.faults import is_number, show
from planmethod.problem.file_node import FileNode
from planmethod.problem.formula import read_decimal
from planmethod.problem.machine_records import (
    OUTPUT,
    PROJECT_PARTS,
    ConstantMoment,
    CycleTask,
    FlywheelTask,
    Machine,
    PoleDistances,
    ProjectTask,
    StrokeSense,
    Zero,
    find_graph,
    graph_quantities,
)
from planmethod.problem.model import SAME_DEG, Body, Drive, Slide
from planmethod.problem.motor_records import KlossSection, LineSection, Motor, MotorSection
from planmethod.problem.motors import read_motors
from planmethod.problem.names import nearest_name_hint, short

R = TypeVar("R")

_MACHINE_EXAMPLE = '[machine] delta = "1/18", constant = "driving"'


def read_machine(file: FileNode, drive: Drive | None) -> Machine:
    """Read ``[machine]``; ``drive`` is None where it has a fault of its own."""
    node = file["machine"]
    node.table(_MACHINE_EXAMPLE)
    hint = "The cycle of a machine is that of a driving crank: give it phi and n."
    require_turning(node, drive, hint, "Give its mean speed: [driver] n or omega.")
    if not file["loads"].value:
        node.note("there are no [[loads]]", hint="A flywheel evens out their work.")
    found = node.record(
        Machine,
        delta=_read_delta,
        cycle_deg=_read_cycle,
        flywheel=_read_flywheel,
        motor=_read_motor,
    )
    found["stated_count"] = found.get("count")
    found.setdefault("count", round(found.get("cycle_deg", 360.0) / 30))
    if found.get("constant") is ConstantMoment.RESISTING:
        if "motor" in found:
            hint = 'Omit the motor, or write constant = "driving".'
            message = "the loads drive already: the constant moment resists"
            node["motor"].note(message, hint=hint)
        if "brake" in found:
            hint = "A run-down needs loads that resist the motion."
            message = "the loads drive: no brake is known to stop them"
            node["brake"].note(message, hint=hint)
    if "motors" in file:
        read = partial(read_motors, constant=found.get("constant"))
        found["motors"] = file.attempt(read) or ()
    return node.build(Machine, found)


def _read_cycle(node: FileNode) -> float:
    if not is_number(node.value) or node.value not in (360, 720):
        node.reject_value("360 or 720", "A four-stroke engine has 720.")
    return float(node.value)


def _read_delta(node: FileNode) -> float:
    """Read the coefficient of speed fluctuation: a number, or a fraction such as ``"1/18"``."""
    value = node.value
    if isinstance(value, str):
        top, slash, bottom = value.partition("/")
        one, other = read_decimal(top), read_decimal(bottom if slash else "1")
        value = float(one) / float(other) if one is not None and other else math.nan
    if not is_number(value) or not math.isfinite(value):
        message = 'expected a number or a fraction such as "1/18", got {}'
        node.reject(message, show(node.value), hint="A decimal fraction has a point: 0.05.")
    if not 0.0 < value < 1.0:
        hint = "delta = (omega_max - omega_min)/omega_mean: from 1/5 (pumps) to 1/300 (generators)."
        node.reject(
            "expected a coefficient of speed fluctuation between 0 and 1, got {:g}",
            value,
            hint=hint,
        )
    return float(value)


def _read_flywheel(node: FileNode) -> FlywheelTask:
    node.table('flywheel = { shape = "rim", speed = 30 }')
    return node.build(FlywheelTask, node.record(FlywheelTask))


_MOTOR = "kloss = { M_max = 60, s_k = 0.15, n_sync = 150 }"


def _read_motor(node: FileNode) -> Motor:
    """Read a motor's characteristic, and reduce it to the crank."""
    node.table(_MOTOR)
    found = node.record(MotorSection)
    forms = [form for form in keys.MOTOR_FORMS if form in found]
    if len(forms) != 1 and node.is_whole:
        hint = translate("For example: {}", _MOTOR)
        node.reject("expected kloss or line, one of them", hint=hint)
    node.require_sound()
    characteristic, ratio = node[forms[0]], found.get("ratio", 1.0)
    characteristic.table(_MOTOR)
    if forms == ["kloss"]:
        return _kloss(characteristic, ratio)
    return _line(characteristic, ratio)


def _read_numbers(node: FileNode, record: Callable[..., R]) -> R:
    """Read the numbers of a characteristic, in one of the ways in which it may be given."""
    found = node.record(record)  # type: ignore[arg-type]
    node.require_sound()
    ways = keys.MOTOR_FORMS[str(node.key)]
    if set(node.value) not in map(set, ways):
        wanted = translate(" or ").join(", ".join(names) for names in ways)
        given = ", ".join(node.value) or translate("nothing")
        node.reject("expected {}; got {}", wanted, given, hint="Give all.")
    return record(**found)


def _kloss(node: FileNode, ratio: float) -> Motor:
    """Return the characteristic of Kloss's formula."""
    table = _read_numbers(node, KlossSection)
    slip = _nominal_slip(node, table.n_nom, table.n_sync)
    if table.M_max:
        if table.s_k >= 10.0:
            message = "expected a slip up to 10, got {:g}"
            node["s_k"].note(message, table.s_k, hint="From 0.05 to 1.")
        moment, critical = table.M_max, table.s_k
    else:
        factor = table.overload
        if factor <= 1.0:
            hint = "lambda = M_max/M_nom, from 1.7 to 3."
            node["lambda"].reject("expected more than 1, got {:g}", factor, hint=hint)
        moment = factor * table.P_nom / (table.n_nom * math.pi / 30.0)
        critical = slip * (factor + math.sqrt(factor * factor - 1.0))
    node.require_sound()
    return Motor(table.n_sync * math.pi / 30.0 / ratio, moment * ratio, critical)


def _line(node: FileNode, ratio: float) -> Motor:
    """Return a straight characteristic."""
    table = _read_numbers(node, LineSection)
    slip = _nominal_slip(node, table.n_nom, table.n_idle)
    node.require_sound()
    moment = table.M_start or table.M_nom / slip
    return Motor(table.n_idle * math.pi / 30.0 / ratio, moment * ratio)


def _nominal_slip(node: FileNode, nominal: float, idle: float) -> float:
    """Return the slip of the nominal point, which must drive. Default: 1."""
    slip = 1.0 - nominal / idle
    if slip <= 0.0:
        hint = translate("Expected less than {:g} rev/min.", idle)
        node["n_nom"].note("the motor is driven at {:g} rev/min", nominal, hint=hint)
    return slip


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
        count //= machine.turns
    found.setdefault("count", count)
    return node.build(CycleTask, found)


def _check_working(node: FileNode, entries: Mapping[str, Any], slides: Mapping[str, Slide]) -> None:
    """Reject a sense of rotation of an output that slides."""
    sense, output = entries.get("working"), entries.get("output")
    slides_on = output in slides or any(slide.pin == output for slide in slides.values())
    if sense in (StrokeSense.CCW, StrokeSense.CW) and slides_on:
        hint = 'Give the direction of the working stroke: "left", "right", "up" or "down".'
        node["working"].note("{} slides: it does not turn", output, hint=hint)


def _of_machine(node: FileNode, entries: Mapping[str, Any], machine: Machine) -> dict[str, Any]:
    """Return the data of the positions that only ``[machine]`` has; data in both must agree."""
    found: dict[str, Any] = {}
    start, count, turns = machine.start_deg, machine.stated_count, machine.turns
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
    count = cycle.count * machine.turns
    if count not in _OF_MACHINE and machine.stated_count is None:
        hint = translate(
            "A flywheel needs from {} to {} positions.", _OF_MACHINE[0], _OF_MACHINE[-1]
        )
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
        hint = "Name a point of a slider, or the link with this angle: {}."
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
    graphs = graph_quantities(dict.fromkeys(points), moving, crank)
    known = [*graphs, OUTPUT]

    def read_label(label: FileNode) -> str:
        if not isinstance(label.value, str):
            label.reject_value("a quantity")
        found = find_graph(graphs, label.value)
        if found is not None:
            return found.label
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


_PROJECT_EXAMPLE = '[project] calculated = 4, gears = "train.toml"'


def read_project(node: FileNode) -> ProjectTask:
    """Read ``[project]``."""
    node.table(_PROJECT_EXAMPLE)
    file = _read_file_name
    found = node.record(
        ProjectTask, gears=file, meshing=file, cam=file, parts=_read_parts, sources=_read_sources
    )
    return node.build(ProjectTask, found)


def _read_file_name(node: FileNode) -> str:
    """Read the name of a problem file in the same folder."""
    name = node.value
    if isinstance(name, str) and PurePath(name).name == name and name.endswith(".toml"):
        return name
    hint = translate('For example: {} = "train.toml", beside this file.', node.key)
    shown = short(name) if isinstance(name, str) else name
    return node.reject("expected the name of a problem file, got '{}'", shown, hint=hint)


MAX_SOURCES, SOURCE_LIMIT = 60, 400
"""Largest number of books in the list of sources, and of the characters of one."""


def _read_sources(node: FileNode) -> tuple[str, ...]:
    """Read the list of books, each a line as the note prints it."""
    if not isinstance(node.value, list) or not node.value:
        node.reject_value(
            "a list of books", 'For example: ["Author. Title. City: Publisher, 1988"].'
        )
    if len(node.value) > MAX_SOURCES:
        node.reject("the list has {} books, the limit is {}", len(node.value), MAX_SOURCES)
    return tuple(dict.fromkeys(node.read_all(lambda book: book.text(SOURCE_LIMIT))))


def _read_parts(node: FileNode) -> tuple[str, ...]:
    parts = node.value
    if not isinstance(parts, list) or not parts or not all(isinstance(v, str) for v in parts):
        node.reject_value("a list of parts", 'For example: ["kinematics", "note"].')
    for name in parts:
        if name not in PROJECT_PARTS:
            hint = translate("There are {}.", ", ".join(PROJECT_PARTS))
            hint = nearest_name_hint(name, PROJECT_PARTS, hint)
            node.reject("unknown part '{}'", short(name), hint=hint)
    return tuple(dict.fromkeys(parts))
