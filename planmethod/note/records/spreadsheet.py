"""Results as rows for a spreadsheet and as arrays: SI, full precision, the same bytes."""

from __future__ import annotations

import csv
import io
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache, partial
from typing import Any, BinaryIO

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.drafting import PROFILES
from planmethod.languages import WRITTEN, speaking
from planmethod.note.columns import numbers_or_none
from planmethod.plans.model import MOTION
from planmethod.problem.model import Problem
from planmethod.problem.quantities import TURNING
from planmethod.problem.records import KindProblem
from planmethod.solved.many.gapped import GappedSweep
from planmethod.solved.many.positions import Gaps, blocks, solver_in
from planmethod.solved.many.variants import Batch
from planmethod.solved.quantities import BY_NAME
from planmethod.solved.reading import Reals
from planmethod.solved.solution import EVERY, Solution

Rows = Sequence[Sequence[Any]]


class SpreadsheetRows(Struct, frozen=True):
    """Rows of a problem, made block by block while they are written.

    Attributes
    ----------
    problem : KindProblem
    header : tuple of str
    count : int
        Rows.
    blocks : callable
        Returns an iterator over blocks of rows.
    """

    problem: KindProblem
    header: tuple[str, ...]
    count: int
    blocks: Callable[[], Iterator[Rows]]

    def materialized(self) -> SpreadsheetRows:
        """Return the table with its rows computed, which can be sent to another process."""
        return replace(self, blocks=partial(iter, list(self.blocks())))


def motion_columns(solution: Solution) -> dict[str, Reals]:
    """Return the columns of the motion and of its plans by name, ndarrays of shape (n,).

    Columns: ``phi_deg`` or ``s``, ``margin``; for each point ``B.x, B.y, B.vx, B.vy, B.v, B.ax,
    B.ay, B.a``; for each link ``2.phi_deg, 2.omega, 2.epsilon`` (counter-clockwise positive); for
    each segment of the plans ``velocity.p-b.exact`` and ``velocity.p-b.read``, mm of the plan.
    """
    columns: dict[str, Reals] = {}

    def add(name: str, values: Reals) -> None:
        _add(columns, name, values)

    add(driver_of(solution.problem), solution.positions)
    add("margin", solution.margin)
    for name, point in solution.points.items():
        add(f"{name}.x", point.place.real)
        add(f"{name}.y", point.place.imag)
        for letter, vector in (("v", point.velocity), ("a", point.acceleration)):
            add(f"{name}.{letter}x", vector.real)
            add(f"{name}.{letter}y", vector.imag)
            add(f"{name}.{letter}", np.hypot(vector.real, vector.imag))
    for quantities in solution.quantities(*TURNING).values():
        for quantity in quantities:
            (name,) = quantity.columns
            add(name, solution.exact(quantity))
    for kind in MOTION:
        for segment in solution.segments(kind):
            add(f"{kind.value}.{segment.name}.exact", segment.exact)
            add(f"{kind.value}.{segment.name}.read", segment.read)
    return columns


def _add(columns: dict[str, Reals], name: str, values: Reals) -> None:
    key, copy = name, 2
    while key in columns:
        key, copy = f"{name}#{copy}", copy + 1
    columns[key] = values + 0.0  # no negative zeros


def csv_columns(solution: Solution) -> dict[str, Reals]:
    """Return all columns by name: those of the motion, and of the forces where there are loads.

    See `motion_columns` and `force_columns`.
    """
    columns = motion_columns(solution)
    if solution.problem.dynamics is not None:
        for name, values in force_columns(solution):
            _add(columns, name, values)
    return columns


def force_columns(solution: Solution) -> Iterator[tuple[str, Reals]]:
    """Yield the columns of the forces by name, ndarrays of shape (n,).

    For each reaction, on link 2 from link 1, ``F.B.2-1.x, F.B.2-1.y, F.B.2-1`` (its size) and
    ``F.B.2-1.read`` (with the ruler), in a prismatic pair ``M.B.2-1`` (about the pin,
    counter-clockwise positive); the balancing load, ``driving.moment`` or ``driving.force``;
    the same by the lever, ``lever.moment`` or ``lever.force``, where the driver moves; both with
    ``.read``; then the springs.

    Raises
    ------
    AssemblyError
        Where a force plan does not close.
    ProblemError
        A load is known only in the positions of the file, and others are requested.
    """
    from planmethod.note.series import balance_series, lever_series, size_series
    from planmethod.solved.forces.reading import force_row, moment_row
    from planmethod.solved.forces.statics import statics_of

    statics = statics_of(solution)
    for planned, joint in zip(statics.board.reactions, statics.reactions, strict=True):
        name = force_row(planned)
        yield f"{name}.x", joint.force.real
        yield f"{name}.y", joint.force.imag
        yield name, np.abs(joint.force)
        yield f"{name}.read", size_series(statics, joint).read
        if planned.couple is not None:
            yield moment_row(planned), joint.moment
    quantity, balance = solution.problem.balancer.quantity, balance_series(statics)
    yield f"driving.{quantity}", balance.exact
    if solution.problem.drive.pushed is not None and statics.moment is not None:
        yield "driving.moment", statics.moment
    yield f"driving.{quantity}.read", balance.read
    for other in solution.problem.drive.other_drives:
        own = f"driving.{other.link}.{other.balancing.quantity}"
        yield own, statics.other_balances[other.link]
    lever = lever_series(statics)
    if lever is not None:
        yield f"lever.{quantity}", lever.exact
        yield f"lever.{quantity}.read", lever.read
    assert solution.problem.dynamics is not None
    if solution.problem.dynamics.springs:
        from planmethod.note.tables.springs import spring_columns

        yield from spring_columns(solution)
    if solution.problem.dynamics.friction is not None:
        from planmethod.note.tables.forces import friction_columns

        yield from friction_columns(solution)


def driver_of(problem: Problem) -> str:
    """Return the name of the column of the driver's positions."""
    return problem.drive.coordinate.column


def csv_rows(solution: Solution) -> tuple[list[str], list[list[float | int]]]:
    """Return header and rows for a spreadsheet: ``position`` from 0, then `csv_columns`."""
    columns = csv_columns(solution)
    lists = [values.tolist() for values in columns.values()]
    rows = enumerate(zip(*lists, strict=True))
    return ["position", *columns], [[number, *row] for number, row in rows]


def solved_table(solution: Solution, more: Mapping[str, Reals] | None = None) -> SpreadsheetRows:
    """Return the rows of a solution, with more columns after its own."""
    header, own = csv_rows(solution)
    added = {name: numbers_or_none(values) for name, values in (more or {}).items()}
    rows = [[*row, *(column[k] for column in added.values())] for k, row in enumerate(own)]
    return SpreadsheetRows(solution.problem, (*header, *added), len(rows), lambda: iter([rows]))


def batch_tables(batch: Batch) -> Iterator[SpreadsheetRows]:
    """Yield `solved_table` of each variant of a batch, its rows cut out of all of them."""
    columns = csv_columns(batch)
    lists = [values.tolist() for values in columns.values()]
    whole = list(zip(*lists, strict=True))
    header = ("position", *columns)
    for problem, own in zip(batch.problems, batch.rows, strict=True):
        rows = [[number, *row] for number, row in enumerate(whole[own])]
        yield SpreadsheetRows(problem, header, len(rows), partial(_at_once, rows))


def _at_once(rows: Rows) -> Iterator[Rows]:
    return iter([rows])


def large_table(
    problem: Problem, positions: Reals, gaps: Gaps, *, ruler: float, partial: bool
) -> SpreadsheetRows:
    """Return the rows of any number of positions, solved again block by block.

    Parameters
    ----------
    positions : ndarray of shape (n,)
    gaps : Gaps
        Positions whose cells, or those of the forces, stay empty.
    partial : bool
        A last column ``reason`` says why cells are empty.
    """
    solve_at = solver_in(problem, positions, gaps, replace(PROFILES["board"], ruler=ruler))
    places = np.arange(len(positions))
    nothing = solve_at(problem, places[:0])
    names, still = list(csv_columns(nothing))[1:], len(motion_columns(nothing))

    def row_blocks() -> Iterator[Rows]:
        for part in blocks(len(positions)):
            here, moving, able = positions[part], gaps.moving[part], gaps.reason[part] < 0
            own = places[part]
            cells: list[list[Any]] = []
            if able.any():
                solved = csv_columns(solve_at(problem, own[able]))
                cells = [_spread(v, able) for v in solved.values()]
            if (moving & ~able).any():  # the motion there, without the forces
                moved = motion_columns(solve_at(problem, own[moving]))
                cells[:still] = [_spread(v, moving) for v in moved.values()]
            empty = [[""] * len(here)] * (1 + len(names) - len(cells))
            yield _rows(part, here, [*cells, *empty][1:], gaps if partial else None)

    return SpreadsheetRows(problem, _header(problem, names, partial), len(positions), row_blocks)


def swept_table(swept: GappedSweep, *, partial: bool) -> SpreadsheetRows:
    """Return the rows of a sweep: ``position``, ``phi_deg`` or ``s``, requested quantities."""

    def row_blocks() -> Iterator[Rows]:
        for part in swept.parts():
            here = swept.positions[part]
            values = swept.fill(np.empty((len(swept.names), len(here))), part)
            able = ~np.isnan(values)
            spread = [_spread(row[full], full) for row, full in zip(values, able, strict=True)]
            yield _rows(part, here, spread, swept.gaps if partial else None)

    header = _header(swept.problem, swept.names, partial)
    return SpreadsheetRows(swept.problem, header, len(swept.positions), row_blocks)


def _header(problem: Problem, names: Iterable[str], partial: bool) -> tuple[str, ...]:
    return "position", driver_of(problem), *names, *(["reason"] if partial else [])


def _spread(values: Reals, able: Any) -> list[Any]:
    """Return values as cells, empty where a position has none."""
    if len(values) == len(able):
        listed: list[Any] = values.tolist()
        return listed
    cells = np.full(len(able), "", dtype=object)
    cells[able] = values
    return list(cells)


def _rows(part: slice, positions: Reals, cells: list[list[Any]], gaps: Gaps | None) -> Rows:
    columns: list[Sequence[Any]] = [range(part.start, part.stop)]
    columns += [(positions + 0.0).tolist(), *cells]
    if gaps is not None:
        with speaking(WRITTEN):  # the bytes of a file do not depend on the system's language
            kinds = gaps.kinds
        columns.append([kinds[k] if k >= 0 else "" for k in gaps.reason[part].tolist()])
    return list(zip(*columns, strict=True))


def csv_text(
    tables: Sequence[SpreadsheetRows], *, done: Callable[[int], None] = lambda rows: None
) -> Iterator[str]:
    """Yield tables as CSV, part by part; with several, each row names its problem and variant.

    A table with other columns than the one before it begins with a header of its own.

    Parameters
    ----------
    done : callable
        Called with the number of rows of every part.
    """
    several, before = len(tables) > 1, None
    for table in tables:
        text = io.StringIO()
        writer = csv.writer(text, lineterminator="\n")
        if table.header != before:
            writer.writerow(["problem", "variant", *table.header] if several else table.header)
        before = table.header
        told = (table.problem.name, table.problem.variant or "") if several else ()
        for rows in table.blocks():
            writer.writerows([(*told, *row) for row in rows] if several else rows)
            yield text.getvalue()
            done(len(rows))
            text.seek(0)
            text.truncate()


SMALL = 2**16
"""Bytes of an array up to which its member is made at once."""

FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""Time of every member: the earliest that the format has."""


class SolvedArrays(Struct, frozen=True):
    """Results of few positions, all of which exist: rows of a table shared by many problems.

    ``columns`` are those of a sweep by name, the driver's positions the first; ``rows`` its own.
    """

    problem: Problem
    columns: Mapping[str, Reals]
    rows: slice

    def named(self, prefix: str) -> Iterator[tuple[str, npt.NDArray[Any]]]:
        """Yield the arrays by name, as `swept_arrays` does."""
        for name, values in self.columns.items():
            own = values[self.rows]
            yield prefix + name, own
        yield f"{prefix}reason", np.full(len(own), -1, np.int16)
        yield f"{prefix}reasons", _NO_REASONS


_NO_REASONS = np.array((), dtype=np.str_)


def solved_arrays(solution: Solution) -> SolvedArrays:
    """Return the results of a solution as a sweep of its positions has them."""
    return SolvedArrays(solution.problem, dict(_columns(solution)), EVERY)


def batch_arrays(batch: Batch) -> Iterator[SolvedArrays]:
    """Yield `solved_arrays` of each variant of a batch."""
    columns = dict(_columns(batch))
    for problem, own in zip(batch.problems, batch.rows, strict=True):
        yield SolvedArrays(problem, columns, own)


def _columns(solution: Solution) -> Iterator[tuple[str, Reals]]:
    """Yield the results of a solution by the names of a sweep's rows, no negative zeros."""
    yield driver_of(solution.problem), solution.positions + 0.0
    for quantity in solution.construction.legend:
        if quantity.kind in BY_NAME:
            continue
        values = solution.components(quantity)
        yield from zip(quantity.columns, (value + 0.0 for value in values), strict=True)
    if solution.problem.dynamics is not None:
        yield from _forces(solution)


def _forces(solution: Solution) -> Iterator[tuple[str, Reals]]:
    from planmethod.solved.forces.reading import force_row, moment_row  # few files have any
    from planmethod.solved.forces.statics import statics_of

    statics = statics_of(solution)
    for planned, joint in zip(statics.board.reactions, statics.reactions, strict=True):
        name, force = force_row(planned), joint.force
        yield from ((f"{name}.x", force.real + 0.0), (f"{name}.y", force.imag + 0.0))
        yield name, np.hypot(force.real, force.imag)
        if planned.couple is not None:
            yield moment_row(planned), joint.moment + 0.0
    quantity = solution.problem.balancer.quantity
    yield f"driving.{quantity}", statics.balance + 0.0
    for other in solution.problem.drive.other_drives:
        own = f"driving.{other.link}.{other.balancing.quantity}"
        yield own, statics.other_balances[other.link] + 0.0
    if statics.lever is not None:
        yield f"lever.{quantity}", statics.lever + 0.0


@lru_cache(maxsize=64)  # most arrays of many variants are alike
def _head(dtype: np.dtype[Any], shape: tuple[int, ...]) -> bytes:
    whole = io.BytesIO()
    told = {"descr": np.lib.format.dtype_to_descr(dtype), "fortran_order": False, "shape": shape}
    np.lib.format.write_array_header_1_0(whole, told)
    return whole.getvalue()


def write_arrays(file: BinaryIO, named: Iterable[tuple[str, npt.NDArray[Any]]]) -> None:
    """Write arrays as ``numpy.savez`` does, one after another, with no time of day in the file."""
    with zipfile.ZipFile(file, "w") as whole:
        for name, array in named:
            member = zipfile.ZipInfo(f"{name}.npy", FIRST_DAY)
            member.create_system = 3  # the same on every system
            if array.nbytes <= SMALL:
                whole.writestr(member, _head(array.dtype, array.shape) + array.tobytes())
                continue
            with whole.open(member, "w", force_zip64=True) as target:
                np.lib.format.write_array(target, np.ascontiguousarray(array), allow_pickle=False)


def swept_arrays(swept: GappedSweep, prefix: str = "") -> Iterator[tuple[str, npt.NDArray[Any]]]:
    """Yield the results of a sweep by name.

    ``phi_deg`` or ``s``; every row by its name (``B.x``, ``2.omega``), NaN where it does not exist;
    ``reason``, int16, -1 where every step exists, else an index into ``reasons``, the sentences.
    """
    count = len(swept.positions)
    out = np.empty((len(swept.names), count))
    for part in swept.parts():
        swept.fill(out[:, part], part)
    yield prefix + driver_of(swept.problem), swept.positions + 0.0
    for name, values in zip(swept.names, out, strict=True):
        yield prefix + name, values
    yield f"{prefix}reason", swept.gaps.reason
    with speaking(WRITTEN):  # as in a CSV
        sentences = swept.gaps.sentences
    yield f"{prefix}reasons", np.array(sentences, dtype=np.str_)
