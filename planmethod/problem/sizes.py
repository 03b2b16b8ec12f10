"""Size of a load, a number or a table, and the phases in which it acts."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Mapping
from itertools import pairwise

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.flat_tables import read_flat
from planmethod.problem.load_records import (
    IndicatorDiagram,
    Interpolation,
    LoadLaw,
    Over,
    Phase,
    SizeTable,
)
from planmethod.problem.model import Drive
from planmethod.problem.names import indexed, listed

TURN = 360.0
"""Period of a table over phi, degrees."""

_TABLE = '{ over = "phi", values = [[0, 0], [90, 730]], interpolation = "linear" }'
_PHASES = 'phases = { phi = [90, 270] } or phases = { moving = "down" }'

_OVERS = tuple(over.value for over in Over if over is not Over.STROKES)
"""Arguments of a table that a file may give; the strokes are those of an indicator."""

Spans = tuple[tuple[float, float], ...]


# Sizes -------------------------------------------------------------------------------------------


def read_size(
    faults: Faults,
    path: str,
    value: object,
    drive: Drive | None,
    *,
    couple: bool = False,
    turn: float = TURN,
) -> float | SizeTable | None:
    """Read a force, N, or a couple, N·m: a number or a table.

    Parameters
    ----------
    turn : float, degrees
        Period of a table over phi.
    """
    if isinstance(value, dict):
        return _read_table(faults, path, value, drive, turn, couple=couple)
    what = "a couple in N·m" if couple else "a force in N"
    if not fields.is_number(value) and not isinstance(value, str):
        faults.expected(
            path, translate("{} or a table", what), value, translate("A table: {}.", _TABLE)
        )
        return None
    return _read_value(faults, path, value, what)


def _read_value(faults: Faults, path: str, value: object, expected: str) -> float | None:
    return fields.read_number(faults, path, value, expected, low=-1e12, high=1e12)


def _read_table(
    faults: Faults, path: str, value: Table, drive: Drive | None, turn: float, *, couple: bool
) -> SizeTable | None:
    before = len(faults)
    given = fields.read_keys(faults, path, value, keys.TABLE)
    whole = len(faults) == before
    law = None
    if "like" in given:
        return _read_like(faults, path, given, drive, turn, couple=couple)
    if "law" in given:
        law = fields.read_member(faults, f"{path}.law", given["law"], LoadLaw)
        if law is None:
            return None
    if law is LoadLaw.INDICATOR:
        return _read_indicator(faults, path, given, drive, couple=couple, is_complete=whole)
    for key in keys.INDICATOR:
        if key in given:
            hint = LIKE if key in keys.LIKE else ""
            faults.add(f"{path}.{key}", 'goes with law = "indicator" only', hint)
    if law is not None:
        given = {**_LAWS[law], **given}
    if whole and "over" not in given:
        hint = translate("Say what the values are over: {}.", listed(_OVERS))
        faults.add(f"{path}.over", "missing", hint)
    if whole and "values" not in given:
        faults.add(f"{path}.values", "missing", translate("For example: {}.", _TABLE))
    over = None
    if "over" in given:
        over = _read_over(faults, f"{path}.over", given["over"], drive, couple=couple)
    interpolation = _read_interpolation(faults, path, given, over, is_complete=whole)
    if over is None or "values" not in given:
        return None
    what = "a couple in N·m" if couple else "a force in N"
    rows = _read_rows(faults, f"{path}.values", given["values"], over, what, drive, turn)
    if rows is None or interpolation is None or len(faults) != before:
        return None
    return SizeTable(over, *rows, interpolation, turn)


_LAWS = {
    LoadLaw.TABLE: {"over": "phi", "interpolation": "linear"},
    LoadLaw.PATH: {"over": "path", "interpolation": "linear"},
    LoadLaw.STEPS: {"over": "phi", "interpolation": "step"},
}
"""Defaults of a law."""


def _check_piston(faults: Faults, path: str, drive: Drive | None, *, couple: bool) -> None:
    """Add the faults of an indicator diagram that is of no piston of a crank."""
    if couple:
        faults.add(path, "'indicator' does not go with a couple", "A piston has a force.")
    if drive is not None and not drive.is_crank:
        faults.add(path, translate("link {} slides: it has no crank cycle", drive.link))


def _read_like(
    faults: Faults, path: str, table: Table, drive: Drive | None, cycle: float, *, couple: bool
) -> SizeTable | None:
    """Read an indicator diagram that is another piston's, later; its rows come with `liken`."""
    before = len(faults)
    _check_piston(faults, f"{path}.like", drive, couple=couple)
    for key in table:
        if key not in (*keys.LIKE, "law") or (key == "law" and table[key] != "indicator"):
            faults.add(f"{path}.{key}", "does not go with like", LIKE)
    name = fields.read_text(faults, f"{path}.like", table["like"], limit=40)
    shift = None
    if "shift" in table:
        shift = fields.read_angle(faults, f"{path}.shift", table["shift"])
    else:
        faults.add(f"{path}.shift", "missing", LIKE)
    if shift is not None and not 0.0 <= shift < cycle:
        message = translate("expected from 0 to less than {:g} degrees, got {:g}", cycle, shift)
        faults.add(f"{path}.shift", message, _SHIFT)
    if len(faults) != before or name is None or shift is None:
        return None
    return SizeTable(Over.STROKES, (), (), like=indexed(name), shift=shift)


LIKE = (
    'For example: { like = "P3", shift = 180 }: the diagram of load P3, 180 degrees of the cycle '
    "later."
)
_SHIFT = (
    "It is how much later than the other piston this one works; [machine] cycle_deg says how long "
    "the cycle is."
)


def liken(
    faults: Faults, path: str, load_name: str, size: SizeTable, known: Mapping[str, object]
) -> SizeTable | None:
    """Return a diagram that is another piston's with the rows of that one; None after a fault.

    Parameters
    ----------
    load_name : str
        The name of its load.
    known : mapping of str to object
        Sizes of the forces of the file by name; None of one that could not be read.
    """
    assert size.like is not None
    path = f"{path}.like"
    if size.like == load_name:
        faults.add(path, translate("load {} cannot be like itself", load_name), LIKE)
        return None
    if size.like not in known:
        others = [name for name in known if name != load_name]
        fields.report_unknown(faults, path, size.like, others, message="unknown load '{}'")
        return None
    other = known[size.like]
    if other is None:
        return None
    if not isinstance(other, SizeTable) or other.over is not Over.STROKES:
        message = translate("load {} is not an indicator diagram", size.like)
        faults.add(path, message, 'It has law = "indicator" and its strokes.')
        return None
    if other.like is not None:
        message = translate("load {} is like {} itself", size.like, other.like)
        faults.add(path, message, "Name the load that has the strokes.")
        return None
    return replace(other, like=size.like, shift=size.shift)


def _read_indicator(
    faults: Faults,
    path: str,
    table: Table,
    drive: Drive | None,
    *,
    couple: bool,
    is_complete: bool,
) -> SizeTable | None:
    """Read pressures over strokes: the force on the piston, N, over the strokes done."""
    before = len(faults)
    _check_piston(faults, f"{path}.law", drive, couple=couple)
    for key in ("over", "values", "interpolation"):
        if key in table:
            faults.add(f"{path}.{key}", 'does not go with law = "indicator"', _INDICATOR)
    if "shift" in table:
        faults.add(f"{path}.shift", "goes with like only", LIKE)
    for key in ("strokes", "area"):
        if key not in table and is_complete:
            faults.add(f"{path}.{key}", "missing", _INDICATOR)
    strokes, area = table.get("strokes", []), _read_area(faults, f"{path}.area", table.get("area"))
    sides = fields.read_integer(faults, f"{path}.sides", table.get("sides", 1), 1, 2)
    area_2 = _read_area(faults, f"{path}.area_2", table.get("area_2", table.get("area")))
    if "area_2" in table and sides == 1:
        faults.add(f"{path}.area_2", "is of the other side of the piston", "Give sides = 2.")
    if not isinstance(strokes, list) or len(strokes) not in (2, 4):
        if "strokes" in table:
            shown = fields.show(strokes)
            faults.add(
                f"{path}.strokes", translate("expected 2 or 4 strokes, got {}", shown), _INDICATOR
            )
        return None
    at: list[float] = []
    pressures: list[float] = []
    told: list[tuple[tuple[float, float], ...]] = []
    for number, rows in enumerate(strokes):
        where = f"{path}.strokes[{number}]"
        found = _read_rows(faults, where, rows, Over.PATH, "a pressure in Pa", drive, TURN)
        if found is None:
            continue
        shares, values = found
        told.append(tuple(zip(shares, values, strict=True)))
        if number % 2:  # the way back
            shares, values = tuple(1.0 - share for share in reversed(shares)), values[::-1]
        at += [float(number), *(number + share for share in shares), number + 1.0]
        pressures += [values[0], *values, values[-1]]
    if len(faults) != before or area is None or area_2 is None:
        return None
    own = SizeTable(Over.STROKES, tuple(at), tuple(area * p for p in pressures))
    whole_force = own if sides == 1 else _both_sides(own, area_2 / area, len(strokes))
    diagram = IndicatorDiagram(tuple(told), area, area_2, sides or 1)
    return replace(whole_force, indicator=diagram)


def _both_sides(diagram: SizeTable, fraction: float, count: int) -> SizeTable:
    """Return the force on a piston whose other side is one stroke ahead."""
    shifted = [(at - 1.0) % count for at in diagram.at]
    nodes = sorted({*diagram.at, *shifted, 0.0, float(count)})
    at: list[float] = []
    values: list[float] = []
    for node in nodes:
        for after in (False, True):
            other = node + 1.0
            if other > count or (other == count and after):
                other -= count
            at.append(node)
            values.append(_limit(diagram, node, after) - fraction * _limit(diagram, other, after))
    return SizeTable(diagram.over, tuple(at), tuple(values))


def _limit(table: SizeTable, at: float, after: bool) -> float:
    """Return the limit of a table with jumps just before an abscissa, or just after it."""
    find = bisect_right if after else bisect_left
    high = find(table.at, at)
    if high == 0 or high == len(table.at):
        return table.values[min(high, len(table.at) - 1)]
    (x0, x1), (y0, y1) = table.at[high - 1 : high + 1], table.values[high - 1 : high + 1]
    return y0 + (y1 - y0) * (at - x0) / (x1 - x0)


def _read_area(faults: Faults, path: str, value: object) -> float | None:
    if value is None:
        return None
    return fields.read_number(
        faults, path, value, "an area in m²", low=1e-9, high=1e3, positive=True
    )


_INDICATOR = (
    'For example: { law = "indicator", area = 0.01, strokes = [[[0, 5e5], [0.2, 1e5], [1, 1e5]], '
    "[[0, 5e5], [0.3, 5e5], [1, 1e5]]] }: the share of the stroke and the pressure in Pa."
)


def _read_over(
    faults: Faults, path: str, value: object, drive: Drive | None, *, couple: bool
) -> Over | None:
    word = fields.read_word(faults, path, value, _OVERS)
    if word is None:
        return None
    over = Over(word)
    if over is Over.PATH and drive is not None and not drive.is_crank:
        faults.add(path, translate("link {} slides: it has no stroke of a full turn", drive.link))
        return None
    if couple and over in (Over.X, Over.Y, Over.PATH):
        hint = "A couple has no point: give it over phi, s or position."
        faults.add(path, translate("'{}' does not go with a couple", over.value), hint)
        return None
    if drive is None:
        return over
    own = Over.PHI if drive.goes_round else Over.S
    if over in (Over.PHI, Over.S) and over is not own:
        message = "'{}' is not what the driver has: link {} slides"
        if drive.goes_round:
            message = "'{}' is not what the driver has: link {} turns"
        hint = translate("Give the table over {}.", own.value)
        faults.add(path, translate(message, over.value, drive.link), hint)
        return None
    return over


def _read_interpolation(
    faults: Faults, path: str, table: Table, over: Over | None, *, is_complete: bool
) -> Interpolation | None:
    where = f"{path}.interpolation"
    if "interpolation" not in table:
        if over is Over.POSITION:
            return Interpolation.STEP
        if is_complete:
            hint = 'Say how to read between the rows: interpolation = "linear" or "step".'
            faults.add(where, "missing", hint)
        return None
    if over is Over.POSITION:
        hint = "There is a value for each position."
        faults.add(where, 'does not go with over = "position"', hint)
        return None
    return fields.read_member(faults, where, table["interpolation"], Interpolation)


Rows = tuple[tuple[float, ...], tuple[float, ...]]


def _read_rows(
    faults: Faults,
    path: str,
    value: object,
    over: Over,
    expected: str,
    drive: Drive | None,
    turn: float,
) -> Rows | None:
    """Read the rows of a table: abscissae and values."""
    if not isinstance(value, list):
        faults.expected(path, "a list", value, translate("For example: {}.", _TABLE))
        return None
    if faults.exceeds(path, "{} values, the limit is {}", len(value), keys.ROW_LIMIT):
        return None
    if over is Over.POSITION:
        return _read_by_position(faults, path, value, expected, drive)
    if len(value) < 2:
        hint = translate("For example: {}. A constant load is just a number.", _TABLE)
        faults.add(
            path,
            translate("expected at least two rows [{}, value], got {}", over.value, len(value)),
            hint,
        )
        return None
    before = len(faults)
    read = {Over.PHI: fields.read_angle, Over.PATH: _read_fraction}.get(
        over, fields.read_coordinate
    )
    rows: list[tuple[float, float]] = []
    for index, row in enumerate(value):
        where = f"{path}[{index}]"
        if not isinstance(row, list) or len(row) != 2:
            faults.expected(where, translate("[{}, value]", over.value), row)
            continue
        at = read(faults, f"{where}[0]", row[0])
        size = _read_value(faults, f"{where}[1]", row[1], expected)
        if at is not None and size is not None:
            rows.append((at, size))
    if len(faults) != before or not _check_order(faults, path, rows, over, turn):
        return None
    return tuple(at for at, _ in rows), tuple(size for _, size in rows)


def _read_by_position(
    faults: Faults, path: str, value: list[object], expected: str, drive: Drive | None
) -> Rows | None:
    read = [_read_value(faults, f"{path}[{i}]", item, expected) for i, item in enumerate(value)]
    sizes = tuple(size for size in read if size is not None)
    if len(sizes) != len(read):
        return None
    if drive is not None and len(sizes) != len(drive.positions):
        count = len(drive.positions)
        hint = "Give one for each position of the driver, or a table over its motion."
        faults.add(path, translate("{} values for {} positions", len(sizes), count), hint)
        return None
    return (), sizes


def _read_fraction(faults: Faults, path: str, value: object) -> float | None:
    hint = "0 is where the stroke begins, 1 where it ends: divide the path by the stroke."
    return fields.read_number(
        faults, path, value, "a share of the stroke", low=0.0, high=1.0, hint=hint
    )


def _check_order(
    faults: Faults, path: str, rows: list[tuple[float, float]], over: Over, turn: float
) -> bool:
    """Return whether the rows increase, and are within a turn where they repeat."""
    jumps = over is Over.PATH  # two rows of one abscissa, no more
    for index, ((one, _), (two, _)) in enumerate(pairwise(rows), 1):
        if two > one or (jumps and two == one and (index < 2 or rows[index - 2][0] < one)):
            continue
        if two == one:
            message, hint = (
                translate("{} = {:g} is in two rows", over.value, two),
                "Keep one of them.",
            )
        else:
            message = translate("{} = {:g} after {:g}", over.value, two, one)
            hint = "Put the rows in order."
        faults.add(f"{path}[{index}]", message, hint)
        return False
    if over is not Over.PHI:
        return True
    (start, first), (end, last) = rows[0], rows[-1]
    if end - start > turn:
        message = "the rows span {:g} degrees, a turn has {:g}"
        if turn != TURN:
            message = "the rows span {:g} degrees, a cycle has {:g}"
        faults.add(
            path, translate(message, end - start, turn), "The table repeats with every turn."
        )
        return False
    if end - start == turn and first != last:
        message = translate("{:g} at {:g} degrees and {:g} a turn later", first, start, last)
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
    fixed_point: str | None = None,
) -> Phase | None:
    """Read ``phases``.

    Parameters
    ----------
    fixed_point : str, optional
        Point of application, if it is fixed.
    """
    if not isinstance(value, dict):
        faults.expected(path, "a table", value, translate("For example: {}.", _PHASES))
        return None
    before = len(faults)
    found = read_flat(faults, path, value, Phase, {"phi": _read_spans})
    if not value:
        hint = translate("For example: {}.", _PHASES)
        faults.add(path, "expected phi, moving or turning, got an empty table", hint)
    if "phi" in value and drive is not None and not drive.is_crank:
        hint = 'Say which way the point moves: phases = { moving = "down" }.'
        faults.add(f"{path}.phi", translate("link {} slides, it has no phi", drive.link), hint)
    if "moving" in value and couple:
        hint = 'A couple has no point; it may have turning = "ccw" or "cw".'
        faults.add(f"{path}.moving", "does not go with a couple", hint)
    elif "moving" in value and fixed_point is not None:
        faults.add(f"{path}.moving", translate("point {} is fixed and does not move", fixed_point))
    return None if len(faults) != before else Phase(**found)


def _read_spans(faults: Faults, path: str, value: object) -> Spans | None:
    """Read ``[from, to]`` or a list of such, degrees."""
    if not isinstance(value, list) or not value:
        faults.expected(path, "[from, to] in degrees", value)
        return None
    if faults.exceeds(path, "{} phases, the limit is {}", len(value), keys.ROW_LIMIT):
        return None
    if any(isinstance(item, list) for item in value):
        read = [_read_span(faults, f"{path}[{i}]", item) for i, item in enumerate(value)]
    else:
        read = [_read_span(faults, path, value)]
    spans = tuple(span for span in read if span is not None)
    return spans if len(spans) == len(read) else None


def _read_span(faults: Faults, path: str, value: object) -> tuple[float, float] | None:
    if not isinstance(value, list) or len(value) != 2:
        faults.expected(path, "[from, to] in degrees", value)
        return None
    start = fields.read_angle(faults, f"{path}[0]", value[0])
    end = fields.read_angle(faults, f"{path}[1]", value[1])
    if start is None or end is None:
        return None
    if start == end or abs(end - start) > TURN:
        message = translate("expected a phase within one turn, got {:g} to {:g}", start, end)
        faults.add(path, message, "A load without phases always acts.")
        return None
    return start, end
