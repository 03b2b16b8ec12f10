"""Size of a load, a number or a table, and the phases in which it acts."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Callable, Mapping
from functools import partial
from itertools import pairwise

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.faults import is_number, show
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.model import Drive
from planmethod.problem.names import indexed, listed
from planmethod.problem.records import (
    IndicatorDiagram,
    Interpolation,
    LoadLaw,
    LoadSize,
    Over,
    Phase,
    SizeTable,
)

TURN = 360.0
"""Period of a table over phi, degrees."""

_TABLE = '{ over = "phi", values = [[0, 0], [90, 730]], interpolation = "linear" }'
_PHASES = 'phases = { phi = [90, 270] } or phases = { moving = "down" }'

_OVERS = tuple(over.value for over in Over if over is not Over.STROKES)
"""Arguments of a table that a file may give; the strokes are those of an indicator."""

Spans = tuple[tuple[float, float], ...]


# Sizes -------------------------------------------------------------------------------------------


def read_size(
    node: FileNode, drive: Drive | None, *, couple: bool = False, turn: float = TURN
) -> LoadSize:
    """Read a force, N, or a couple, N·m: a number or a table.

    Parameters
    ----------
    turn : float, degrees
        Period of a table over phi.
    """
    expected = "a couple in N·m" if couple else "a force in N"
    if isinstance(node.value, Mapping):
        return _TableReader(expected, drive, turn, couple=couple).read(node)
    if not is_number(node.value) and not isinstance(node.value, str):
        hint = translate("A table: {}.", _TABLE)
        node.reject_value(translate("{} or a table", expected), hint)
    return _read_value(node, expected)


def _read_value(node: FileNode, expected: str) -> float:
    return node.number(expected, -1e12, 1e12)


_LAWS: Mapping[LoadLaw | None, Mapping[str, str]] = {
    LoadLaw.TABLE: {"over": "phi", "interpolation": "linear"},
    LoadLaw.PATH: {"over": "path", "interpolation": "linear"},
    LoadLaw.STEPS: {"over": "phi", "interpolation": "step"},
}
"""Defaults of a law."""

Rows = tuple[tuple[float, ...], tuple[float, ...]]


class _TableReader:
    """Reader of the table of a size.

    Attributes
    ----------
    expected : str
        What its values are: ``a force in N``.
    drive : Drive or None
        None where it has a fault of its own.
    turn : float, degrees
        Period of a table over phi.
    """

    def __init__(self, expected: str, drive: Drive | None, turn: float, *, couple: bool) -> None:
        self.expected, self.drive, self.turn, self.couple = expected, drive, turn, couple

    def read(self, node: FileNode) -> SizeTable:
        """Read the table by its law."""
        node.allow(keys.TABLE)
        if "like" in node:
            return self._read_like(node)
        law = node.read("law", lambda law: law.member(LoadLaw))
        if "law" in node:
            needed(law)
        if law is LoadLaw.INDICATOR:
            return self._read_indicator(node)
        for key in keys.INDICATOR:
            if key in node:
                hint = LIKE if key in keys.LIKE else ""
                node[key].note('valid only with law = "indicator"', hint=hint)
        node.value = {**_LAWS.get(law, {}), **node.value}
        hint = translate("Give the variable of the table: {}.", listed(_OVERS))
        over = node.require("over", self._read_over, hint)
        if "values" not in node:
            node.note_missing("values", translate("For example: {}.", _TABLE))
        interpolation = _read_interpolation(node, over)
        rows = None
        if over is not None:
            rows = node.read("values", partial(self._read_rows, over=over, expected=self.expected))
        node.require_sound()
        return SizeTable(needed(over), *needed(rows), needed(interpolation), self.turn)

    def _check_piston(self, node: FileNode) -> None:
        """Note the faults of an indicator diagram that is of no piston of a crank."""
        if self.couple:
            node.note(
                "'indicator' is not valid for a couple",
                hint="A piston exerts a force, not a couple.",
            )
        if self.drive is not None and not self.drive.is_crank:
            node.note("link {} slides: it has no crank cycle", self.drive.link)

    def _read_like(self, node: FileNode) -> SizeTable:
        """Read a diagram that is another piston's, later; its rows come with `liken`."""
        self._check_piston(node["like"])
        for key in node.value:
            if key not in (*keys.LIKE, "law") or (key == "law" and node.value[key] != "indicator"):
                node[key].note("not valid with like", hint=LIKE)
        name = node.read("like", lambda like: like.text(40))
        if "shift" not in node:
            node["shift"].note("missing", hint=LIKE)
        shift = node.read("shift", self._read_shift)
        return SizeTable(Over.STROKES, (), (), like=indexed(needed(name)), shift=needed(shift))

    def _read_shift(self, node: FileNode) -> float:
        shift = node.angle()
        if not 0.0 <= shift < self.turn:
            message = "expected from 0 to less than {:g} degrees, got {:g}"
            node.reject(message, self.turn, shift, hint=_SHIFT)
        return shift

    def _read_indicator(self, node: FileNode) -> SizeTable:
        """Read pressures over strokes: the force on the piston, N, over the strokes done."""
        self._check_piston(node["law"])
        for key in ("over", "values", "interpolation"):
            if key in node:
                node[key].note('not valid with law = "indicator"', hint=_INDICATOR)
        if "shift" in node:
            node["shift"].note("valid only with like", hint=LIKE)
        for key in ("strokes", "area"):
            if key not in node:
                node.note_missing(key, _INDICATOR)
        area = node.read("area", _read_area)
        sides = node.read("sides", lambda sides: sides.integer(1, 2), 1)
        area_2 = node.read("area_2", _read_area, area)
        if "area_2" in node and sides == 1:
            node["area_2"].note("belongs to the other side of the piston", hint="Give sides = 2.")
        strokes = node.read("strokes", self._read_strokes)
        node.require_sound()
        strokes, area, area_2 = needed(strokes), needed(area), needed(area_2)
        at: list[float] = []
        pressures: list[float] = []
        for number, (fractions, values) in enumerate(strokes):
            if number % 2:  # the way back
                fractions, values = tuple(1.0 - one for one in reversed(fractions)), values[::-1]
            at += [float(number), *(number + one for one in fractions), number + 1.0]
            pressures += [values[0], *values, values[-1]]
        own = SizeTable(Over.STROKES, tuple(at), tuple(area * p for p in pressures))
        whole_force = own if sides == 1 else _both_sides(own, area_2 / area, len(strokes))
        rows = tuple(tuple(zip(*stroke, strict=True)) for stroke in strokes)
        return replace(whole_force, indicator=IndicatorDiagram(rows, area, area_2, sides or 1))

    def _read_strokes(self, node: FileNode) -> tuple[Rows, ...]:
        if not isinstance(node.value, list) or len(node.value) not in (2, 4):
            node.reject("expected 2 or 4 strokes, got {}", show(node.value), hint=_INDICATOR)
        read = partial(self._read_rows, over=Over.PATH, expected="a pressure in Pa")
        return node.read_all(read)

    def _read_over(self, node: FileNode) -> Over:
        over, drive = Over(node.word(_OVERS)), self.drive
        if over is Over.PATH and drive is not None and not drive.is_crank:
            node.reject("link {} slides: it has no stroke of a full turn", drive.link)
        if self.couple and over in (Over.X, Over.Y, Over.PATH):
            hint = "A couple has no point: give a table over phi, s or position."
            node.reject("'{}' is not valid for a couple", over.value, hint=hint)
        if drive is None:
            return over
        own = Over.PHI if drive.goes_round else Over.S
        if over in (Over.PHI, Over.S) and over is not own:
            message = "'{}' does not apply to the driver: link {} slides"
            if drive.goes_round:
                message = "'{}' does not apply to the driver: link {} turns"
            hint = translate("Give the table over {}.", own.value)
            node.reject(message, over.value, drive.link, hint=hint)
        return over

    def _read_rows(self, node: FileNode, over: Over, expected: str) -> Rows:
        """Read the rows of a table: abscissae and values."""
        node.array("a list", lambda: translate("For example: {}.", _TABLE))
        node.require_at_most(keys.ROW_LIMIT, "{} values, the limit is {}")
        if over is Over.POSITION:
            return self._read_by_position(node, expected)
        if len(node.value) < 2:
            hint = translate("For example: {}. A constant load is just a number.", _TABLE)
            message = "expected at least two rows [{}, value], got {}"
            node.reject(message, over.value, len(node.value), hint=hint)
        read_value = partial(_read_value, expected=expected)
        rows = node.read_all(partial(_read_row, over=over, read_value=read_value))
        _check_order(node, rows, over, self.turn)
        return tuple(at for at, _ in rows), tuple(size for _, size in rows)

    def _read_by_position(self, node: FileNode, expected: str) -> Rows:
        sizes = node.read_all(partial(_read_value, expected=expected))
        count = len(sizes) if self.drive is None else len(self.drive.positions)
        if len(sizes) != count:
            hint = "Give one for each position of the driver, or a table over its motion."
            node.reject("{} values for {} positions", len(sizes), count, hint=hint)
        return (), sizes


LIKE = (
    'For example: { like = "P3", shift = 180 }: the diagram of load P3, 180 degrees of the cycle '
    "later."
)
_SHIFT = (
    "This is the delay of this piston after the other one; [machine] cycle_deg sets the "
    "length of the cycle."
)
_INDICATOR = (
    'For example: { law = "indicator", area = 0.01, strokes = [[[0, 5e5], [0.2, 1e5], [1, 1e5]], '
    "[[0, 5e5], [0.3, 5e5], [1, 1e5]]] }: the share of the stroke and the pressure in Pa."
)


def liken(
    node: FileNode, load_name: str, size: SizeTable, known: Mapping[str, object]
) -> SizeTable:
    """Return a diagram that is another piston's with the rows of that one.

    Parameters
    ----------
    node : FileNode
        The name of the other load.
    load_name : str
        The name of its own load.
    known : mapping of str to object
        Sizes of the forces of the file by name; None of one that could not be read.
    """
    name = needed(size.like)
    if name == load_name:
        node.reject("load {} cannot refer to itself in like", load_name, hint=LIKE)
    if name not in known:
        others = [one for one in known if one != load_name]
        node.reject_unknown(name, others, "unknown load '{}'")
    other = needed(known[name])
    if not isinstance(other, SizeTable) or other.over is not Over.STROKES:
        hint = 'It has law = "indicator" and its strokes.'
        node.reject("load {} is not an indicator diagram", name, hint=hint)
    if other.like is not None:
        hint = "Name the load that has the strokes."
        node.reject("load {} uses like = {}, too", name, other.like, hint=hint)
    return replace(other, like=name, shift=size.shift)


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


def _read_area(node: FileNode) -> float:
    return node.number("an area in m²", 1e-9, 1e3, positive=True)


def _read_interpolation(node: FileNode, over: Over | None) -> Interpolation | None:
    if "interpolation" not in node:
        if over is Over.POSITION:
            return Interpolation.STEP
        hint = 'Select the interpolation between the rows: interpolation = "linear" or "step".'
        node.note_missing("interpolation", hint)
    elif over is Over.POSITION:
        hint = "There is a value for each position."
        node["interpolation"].note('not valid with over = "position"', hint=hint)
    else:
        return node.read("interpolation", lambda word: word.member(Interpolation))
    return None


def _read_row(
    node: FileNode, over: Over, read_value: Callable[[FileNode], float]
) -> tuple[float, float]:
    if not isinstance(node.value, list) or len(node.value) != 2:
        node.reject_value(translate("[{}, value]", over.value))
    at, value = node[0].attempt(_ABSCISSAE[over]), node[1].attempt(read_value)
    return needed(at), needed(value)


def _read_fraction(node: FileNode) -> float:
    hint = "0 is where the stroke begins, 1 where it ends: divide the path by the stroke."
    return node.number("a share of the stroke", 0.0, 1.0, hint=hint)


_ABSCISSAE: Mapping[Over, Callable[[FileNode], float]] = {
    Over.PHI: FileNode.angle,
    Over.S: FileNode.coordinate,
    Over.X: FileNode.coordinate,
    Over.Y: FileNode.coordinate,
    Over.PATH: _read_fraction,
}


def _check_order(
    node: FileNode, rows: tuple[tuple[float, float], ...], over: Over, turn: float
) -> None:
    """Make sure that the rows increase, and are within a turn where they repeat."""
    jumps = over is Over.PATH  # two rows of one abscissa, no more
    for index, ((one, _), (two, _)) in enumerate(pairwise(rows), 1):
        if two > one or (jumps and two == one and (index < 2 or rows[index - 2][0] < one)):
            continue
        if two == one:
            node[index].reject(
                "{} = {:g} is in two rows", over.value, two, hint="Keep one of them."
            )
        node[index].reject(
            "{} = {:g} after {:g}", over.value, two, one, hint="Put the rows in order."
        )
    if over is not Over.PHI:
        return
    (start, first), (end, last) = rows[0], rows[-1]
    if end - start > turn:
        message = "the rows span {:g} degrees, a turn has {:g}"
        if turn != TURN:
            message = "the rows span {:g} degrees, a cycle has {:g}"
        node.reject(message, end - start, turn, hint="The table repeats with every turn.")
    if end - start == turn and first != last:
        message = "{:g} at {:g} degrees and {:g} a turn later"
        hint = "The table repeats with every turn: its ends are one position."
        node.reject(message, first, start, last, hint=hint)


# Phases ------------------------------------------------------------------------------------------


def read_phase(
    node: FileNode,
    drive: Drive | None,
    *,
    couple: bool = False,
    fixed_point: str | None = None,
) -> Phase:
    """Read ``phases``.

    Parameters
    ----------
    fixed_point : str, optional
        Point of application, if it is fixed.
    """
    example = translate("For example: {}.", _PHASES)
    if not isinstance(node.value, Mapping):
        node.reject_value("a table", example)
    if not node.value:
        node.reject("expected phi, moving or turning, got an empty table", hint=example)
    found = node.record(Phase, phi=_read_spans)
    if "phi" in node and drive is not None and not drive.is_crank:
        hint = 'Give the direction in which the point moves: phases = { moving = "down" }.'
        node["phi"].note("link {} slides, it has no phi", drive.link, hint=hint)
    if "moving" in node and couple:
        hint = 'A couple has no point; it may have turning = "ccw" or "cw".'
        node["moving"].note("not valid for a couple", hint=hint)
    elif "moving" in node and fixed_point is not None:
        node["moving"].note("point {} is fixed and does not move", fixed_point)
    return node.build(Phase, found)


def _read_spans(node: FileNode) -> Spans:
    """Read ``[from, to]`` or a list of such, degrees."""
    node.array("[from, to] in degrees", low=1)
    node.require_at_most(keys.ROW_LIMIT, "{} phases, the limit is {}")
    if any(isinstance(span, list) for span in node.value):
        return node.read_all(_read_span)
    return (_read_span(node),)


def _read_span(node: FileNode) -> tuple[float, float]:
    node.array("[from, to] in degrees", low=2, high=2)
    start, end = node.read_all(FileNode.angle)
    if start == end or abs(end - start) > TURN:
        hint = "A load without phases always acts."
        node.reject("expected a phase within one turn, got {:g} to {:g}", start, end, hint=hint)
    return start, end
