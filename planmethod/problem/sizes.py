"""Size of a load, a number or a table, and the phases in which it acts."""

from __future__ import annotations

from itertools import pairwise

from planmethod.problem import keys
from planmethod.problem.fields import (
    Faults,
    Table,
    is_number,
    read_angle,
    read_coordinate,
    read_keys,
    read_member,
    read_number,
    show,
)
from planmethod.problem.load_records import Interpolation, Moving, Over, Phase, Turning
from planmethod.problem.load_records import Table as SizeTable
from planmethod.problem.model import Drive
from planmethod.problem.names import listed

TURN = 360.0
"""A table over phi repeats after so many degrees."""

_TABLE = '{ over = "phi", values = [[0, 0], [90, 730]], interpolation = "linear" }'
_PHASES = 'phases = { phi = [90, 270] } or phases = { moving = "down" }'

Spans = tuple[tuple[float, float], ...]


# Sizes -------------------------------------------------------------------------------------------


def read_size(
    faults: Faults, path: str, value: object, drive: Drive | None, *, couple: bool
) -> float | SizeTable | None:
    """Read a force, N, or a couple, N·m: a number or a table."""
    if isinstance(value, dict):
        return _read_table(faults, path, value, drive, couple=couple)
    what = "a couple in N·m" if couple else "a force in N"
    if not is_number(value) and not isinstance(value, str):
        faults.add(path, f"expected {what} or a table, got {show(value)}", f"A table: {_TABLE}.")
        return None
    return _read_value(faults, path, value, what)


def _read_value(faults: Faults, path: str, value: object, what: str) -> float | None:
    return read_number(faults, path, value, what, low=-1e12, high=1e12)


def _read_table(
    faults: Faults, path: str, value: Table, drive: Drive | None, *, couple: bool
) -> SizeTable | None:
    before = len(faults)
    given = read_keys(faults, path, value, keys.TABLE)
    whole = len(faults) == before
    for key, hint in (
        ("over", f"Say what the values are over: {listed(item.value for item in Over)}."),
        ("values", f"For example: {_TABLE}."),
    ):
        if key not in given and whole:
            faults.add(f"{path}.{key}", "missing", hint)
    over = None
    if "over" in given:
        over = _read_over(faults, f"{path}.over", given["over"], drive, couple=couple)
    interpolation = _read_interpolation(faults, path, given, over, whole=whole)
    if over is None or "values" not in given:
        return None
    what = "a couple in N·m" if couple else "a force in N"
    rows = _read_rows(faults, f"{path}.values", given["values"], over, what, drive)
    if rows is None or interpolation is None or len(faults) != before:
        return None
    return SizeTable(over, *rows, interpolation)


def _read_over(
    faults: Faults, path: str, value: object, drive: Drive | None, *, couple: bool
) -> Over | None:
    over = read_member(faults, path, value, Over)
    if over is None:
        return None
    if couple and over in (Over.X, Over.Y):
        hint = "A couple has no point: give it over phi, s or position."
        faults.add(path, f"'{over.value}' does not go with a couple", hint)
        return None
    if drive is not None and over in (Over.PHI, Over.S) and over.value != drive.coordinate.name:
        kind = "turns" if drive.is_crank else "slides"
        message = f"'{over.value}' is not what the driver has: link {drive.link} {kind}"
        faults.add(path, message, f"Give the table over {drive.coordinate.name}.")
        return None
    return over


def _read_interpolation(
    faults: Faults, path: str, given: Table, over: Over | None, *, whole: bool
) -> Interpolation | None:
    where = f"{path}.interpolation"
    if "interpolation" not in given:
        if over is Over.POSITION:
            return Interpolation.STEP
        if whole:
            hint = 'Say how to read between the rows: interpolation = "linear" or "step".'
            faults.add(where, "missing", hint)
        return None
    if over is Over.POSITION:
        hint = "There is a value for each position."
        faults.add(where, 'does not go with over = "position"', hint)
        return None
    return read_member(faults, where, given["interpolation"], Interpolation)


Rows = tuple[tuple[float, ...], tuple[float, ...]]


def _read_rows(
    faults: Faults, path: str, value: object, over: Over, what: str, drive: Drive | None
) -> Rows | None:
    """Read the rows of a table: abscissae and values."""
    if not isinstance(value, list):
        faults.add(path, f"expected a list, got {show(value)}", f"For example: {_TABLE}.")
        return None
    if len(value) > keys.ROW_LIMIT:
        faults.add(path, f"{len(value)} values, the limit is {keys.ROW_LIMIT}")
        return None
    if over is Over.POSITION:
        return _read_by_position(faults, path, value, what, drive)
    if len(value) < 2:
        hint = f"For example: {_TABLE}. A constant load is just a number."
        faults.add(
            path, f"expected at least two rows [{over.value}, value], got {len(value)}", hint
        )
        return None
    before = len(faults)
    read = read_angle if over is Over.PHI else read_coordinate
    rows: list[tuple[float, float]] = []
    for index, row in enumerate(value):
        where = f"{path}[{index}]"
        if not isinstance(row, list) or len(row) != 2:
            faults.add(where, f"expected [{over.value}, value], got {show(row)}")
            continue
        at = read(faults, f"{where}[0]", row[0])
        size = _read_value(faults, f"{where}[1]", row[1], what)
        if at is not None and size is not None:
            rows.append((at, size))
    if len(faults) != before or not _check_order(faults, path, rows, over):
        return None
    return tuple(at for at, _ in rows), tuple(size for _, size in rows)


def _read_by_position(
    faults: Faults, path: str, value: list[object], what: str, drive: Drive | None
) -> Rows | None:
    read = [_read_value(faults, f"{path}[{i}]", item, what) for i, item in enumerate(value)]
    sizes = tuple(size for size in read if size is not None)
    if len(sizes) != len(read):
        return None
    if drive is not None and len(sizes) != len(drive.positions):
        count = len(drive.positions)
        hint = "Give one for each position of the driver, or a table over its motion."
        faults.add(path, f"{len(sizes)} values for {count} positions", hint)
        return None
    return (), sizes


def _check_order(faults: Faults, path: str, rows: list[tuple[float, float]], over: Over) -> bool:
    """Whether the rows increase, and lie within a turn where they repeat."""
    for index, ((one, _), (two, _)) in enumerate(pairwise(rows), 1):
        if two > one:
            continue
        if two == one:
            message, hint = f"{over.value} = {two:g} is in two rows", "Keep one of them."
        else:
            message, hint = f"{over.value} = {two:g} after {one:g}", "Put the rows in order."
        faults.add(f"{path}[{index}]", message, hint)
        return False
    if over is not Over.PHI:
        return True
    (start, first), (end, last) = rows[0], rows[-1]
    if end - start > TURN:
        message = f"the rows span {end - start:g} degrees, a turn has {TURN:g}"
        faults.add(path, message, "The table repeats with every turn.")
        return False
    if end - start == TURN and first != last:
        message = f"{first:g} at {start:g} degrees and {last:g} a turn later"
        faults.add(path, message, "The table repeats with every turn: its ends are one position.")
        return False
    return True


# Phases ------------------------------------------------------------------------------------------


def read_phase(
    faults: Faults,
    path: str,
    value: object,
    drive: Drive | None,
    *,
    couple: bool = False,
    still: str | None = None,
) -> Phase | None:
    """Read ``phases``.

    Parameters
    ----------
    still : str, optional
        Point of application, if it is fixed.
    """
    if not isinstance(value, dict):
        faults.add(path, f"expected a table, got {show(value)}", f"For example: {_PHASES}.")
        return None
    before = len(faults)
    given = read_keys(faults, path, value, keys.PHASES)
    if not given and len(faults) == before:
        faults.add(path, "expected phi, moving or turning, got an empty table", _PHASES + ".")
    spans: Spans | None = ()
    moving = turning = None
    if "phi" in given:
        spans = _read_spans(faults, f"{path}.phi", given["phi"])
        if drive is not None and not drive.is_crank:
            hint = 'Say which way the point moves: phases = { moving = "down" }.'
            faults.add(f"{path}.phi", f"link {drive.link} slides, it has no phi", hint)
    if "moving" in given:
        where = f"{path}.moving"
        moving = read_member(faults, where, given["moving"], Moving)
        if couple:
            hint = 'A couple has no point; it may have turning = "ccw" or "cw".'
            faults.add(where, "does not go with a couple", hint)
        elif still is not None:
            faults.add(where, f"point {still} is fixed and does not move")
    if "turning" in given:
        turning = read_member(faults, f"{path}.turning", given["turning"], Turning)
    if len(faults) != before or spans is None:
        return None
    return Phase(spans, moving, turning)


def _read_spans(faults: Faults, path: str, value: object) -> Spans | None:
    """Read ``[from, to]`` or a list of such, degrees."""
    if not isinstance(value, list) or not value:
        faults.add(path, f"expected [from, to] in degrees, got {show(value)}")
        return None
    if len(value) > keys.ROW_LIMIT:
        faults.add(path, f"{len(value)} phases, the limit is {keys.ROW_LIMIT}")
        return None
    if any(isinstance(item, list) for item in value):
        read = [_read_span(faults, f"{path}[{i}]", item) for i, item in enumerate(value)]
    else:
        read = [_read_span(faults, path, value)]
    spans = tuple(span for span in read if span is not None)
    return spans if len(spans) == len(read) else None


def _read_span(faults: Faults, path: str, value: object) -> tuple[float, float] | None:
    if not isinstance(value, list) or len(value) != 2:
        faults.add(path, f"expected [from, to] in degrees, got {show(value)}")
        return None
    start = read_angle(faults, f"{path}[0]", value[0])
    end = read_angle(faults, f"{path}[1]", value[1])
    if start is None or end is None:
        return None
    if start == end or abs(end - start) > TURN:
        message = f"expected a phase within one turn, got {start:g} to {end:g}"
        faults.add(path, message, "A load without phases always acts.")
        return None
    return start, end
