"""Several driving links of a file: ``[[drivers]]`` (механизм с двумя начальными звеньями)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from msgspec.structs import asdict, replace

from planmethod.languages import translate
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import Drive, OtherDrive, OutputPositionKind
from planmethod.problem.names import listed

_ONE_DRIVER = {
    "cycle": "a cycle is a turn of one crank, but links {} drive",
    "machine": "a flywheel keeps one crank even, but links {} drive",
    "balancing": "shaking forces are those of a turn of one crank, but links {} drive",
    "balancing_force": "a force at a point balances one crank, but links {} drive",
}
"""Tables of a machine whose crank turns alone, and why they need that."""

ReadDrive = Callable[[FileNode], Drive | None]


def driver_entries(file: FileNode) -> list[FileNode]:
    """Return the entries of ``[[drivers]]``, or of a list of drivers; none of ``[driver]``."""
    key = "drivers" if "drivers" in file else "driver"
    node = file[key]
    if key == "drivers" and "driver" in file:
        hint = "Write each driving link as [[drivers]]."
        file["driver"].note("{} and {} are both given", "driver", "drivers", hint=hint)
    if key == "drivers" and (not isinstance(node.value, list) or not node.value):
        node.note_value(translate("a list of driving links"), '[[drivers]] link = "1"')
        return []
    if not isinstance(node.value, list):
        return []
    return [entry for entry in node.entries() if isinstance(entry.value, Mapping)]


def add_drivers(nodes: Sequence[FileNode], first: Drive | None, read: ReadDrive) -> Drive | None:
    """Return the first driver with the others; None after a fault.

    ``read`` reads the driver of a table.
    """
    others: list[OtherDrive] = []
    for node in nodes[1:]:
        drive = read(node)
        if drive is None:
            continue
        _check_kind(node, drive)
        others.append(OtherDrive(**asdict(drive)))
    if first is None or len(others) + 1 < len(nodes):
        return None
    _check_kind(nodes[0], first)
    drives = (first, *others)
    _check_counts(nodes, drives)
    links = [one.link for one in drives]
    for k, (node, link) in enumerate(zip(nodes, links, strict=True)):
        if link in links[:k]:
            hint = "Name another link that is joined to the frame."
            node["link"].note("link {} drives already", link, hint=hint)
    return replace(first, other_drives=tuple(others))


def _check_counts(nodes: Sequence[FileNode], drives: Sequence[Drive]) -> None:
    """Note drivers whose positions do not belong together."""
    wanted, posed = len(drives[0].positions), any(one.posed is not None for one in drives)
    for node, drive in zip(nodes[1:], drives[1:], strict=True):
        count = len(drive.positions)
        if count == wanted or (count == 1 and not posed):
            continue
        place = "phi" if drive.is_crank else "s"
        place = place if drive.posed is None else drive.posed.key
        message = "{} positions, but the first driver has {}"
        hint = "Give as many, or the one that belongs to its first position."
        if posed:
            hint = "Give as many: an output determines each position."
        node[place].note(message, count, wanted, hint=hint)


_CHOSEN = (OutputPositionKind.STROKE, OutputPositionKind.EXTREME)


def _check_kind(node: FileNode, drive: Drive) -> None:
    """Note a driver of several whose motion needs a turn of a single crank."""
    if drive.cam_drive is not None:
        hint = "Give its place and rates: s, v and a, or phi, omega and epsilon."
        node["cam"].note("not valid with several driving links", hint=hint)
    posed = drive.posed
    if posed is not None and posed.by in _CHOSEN:
        hint = "Give its coordinate, or that of a point or link: phi_3 = 40, x_C = 0.2."
        node[posed.key].note("not valid with several driving links", hint=hint)
    if posed is not None and posed.going:
        hint = translate('Give the place of link {}: root = "near 40".', drive.link)
        node["root"].note("the sense of motion depends on all drivers", hint=hint)


def check_forces_of_drivers(nodes: Sequence[FileNode], drive: Drive | None) -> None:
    """Note a motor or an actuator that the force plans cannot begin with."""
    for node, one in zip(nodes[1:], () if drive is None else drive.other_drives, strict=False):
        if one.motor is None and one.actuator is None:
            continue
        both = drive is not None and (drive.motor is not None or drive.actuator is not None)
        hint = "Write its table first of all [[drivers]]."
        message = "a motor between links or an actuator is balanced first"
        if both:
            message = "two motors between links, or actuators, have no force plans"
            hint = "Delete the forces, or give one driver by its own coordinate and rate."
        node.note(message, hint=hint)


def reject_tables_of_one_driver(file: FileNode, links: Sequence[str]) -> None:
    """Note tables that need a mechanism with one driving link, and why."""
    for key, message in _ONE_DRIVER.items():
        if key in file:
            hint = "Delete the table, or fix all drivers but one."
            file[key].note(message, listed(links), hint=hint)
