"""Several driving links of a file: ``[[drivers]]`` (механизм с двумя начальными звеньями)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import Drive, OtherDrive

_ONE_DRIVER = (
    "cycle", "machine", "project", "balancing", "balancing_force", "friction",
)  # fmt: skip
"""Tables of a machine whose crank turns alone."""

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
    """Return the first driver with the others; None after a fault."""
    others: list[OtherDrive] = []
    for node in nodes[1:]:
        drive = node.attempt(read)
        if drive is None:
            continue
        _check_plain(node, drive)
        count = len(drive.positions)
        if first is not None and count not in (1, len(first.positions)):
            place = "phi" if drive.is_crank else "s"
            message = "{} positions, but the first driver has {}"
            hint = "Give as many, or the one that belongs to its first position."
            node[place].note(message, count, len(first.positions), hint=hint)
        one = drive.link, drive.pivot, drive.positions, drive.rate, drive.acceleration
        others.append(OtherDrive(*one))
    if first is None:
        return None
    _check_plain(nodes[0], first)
    links = [first.link, *(other.link for other in others)]
    for k, link in enumerate(links):
        if link in links[:k]:
            hint = "Name another link that is joined to the frame."
            nodes[min(k, len(nodes) - 1)]["link"].note("link {} drives already", link, hint=hint)
    return replace(first, other_drives=tuple(others))


def _check_plain(node: FileNode, drive: Drive) -> None:
    """Note a driver of several whose motion follows from others."""
    given = drive.posed, drive.output_rate, drive.effort, drive.cam_drive, drive.gear_drive
    if any(one is not None for one in given):
        place = "phi, omega and epsilon" if drive.is_crank else "s, v and a"
        hint = translate("Give {} of link {}.", place, drive.link)
        message = "one of several driving links needs its own position and rates"
        node.note(message, hint=hint)


def reject_tables_of_one_driver(file: FileNode) -> None:
    """Note tables that need a mechanism with one driving link."""
    for key in _ONE_DRIVER:
        if key in file:
            hint = "Delete the table, or fix all drivers but one."
            file[key].note("not valid with several driving links", hint=hint)
