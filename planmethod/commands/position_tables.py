"""Output of ``solve`` for many positions: tables, sweeps and their files (таблицы и массивы)."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import click

from planmethod.commands.output import bar, is_terminal, write_parts
from planmethod.commands.problems import (
    basename,
    message_name,
    solution_of,
    warn,
    warn_of_change_points,
)
from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.options import Positions, UsageError, drawn_by

if TYPE_CHECKING:
    from planmethod.note.records.spreadsheet import SolvedArrays, SpreadsheetRows
    from planmethod.problem.model import Problem
    from planmethod.solved.many.gaps import GappedSweep
    from planmethod.solved.many.positions import Gaps

HINT = " To leave such positions empty, give --partial with --json, --csv, --npz or --ask."

MAX_SHOWN_ROWS = 10_000
"""Rows of a table on the terminal."""

MAX_NUMBERS = 250_000_000
"""Most numbers of one problem in a file of arrays: 2 GB, all in memory before they are written."""

MANY_PROBLEMS = 500
"""Problems whose arrays take about a second to write."""

LONG_TEXT, LONG_ARRAYS = 2_000_000, 50_000_000
"""Count of numbers that take about a second to write."""


def requested_positions(problem: Problem, phi: Positions | None) -> Positions:
    """Return the positions of ``--phi``, rad, or those of the problem."""
    import numpy as np

    return np.array(problem.drive.positions) if phi is None else phi


def table_of(
    problem: Problem, phi: Positions | None, ruler: float, partial: bool
) -> SpreadsheetRows:
    """Return the rows of all results; a large table is checked here and solved when written."""
    from planmethod.note.records.spreadsheet import large_table, solved_table
    from planmethod.solved.many.positions import BLOCK

    positions = requested_positions(problem, phi)
    if len(positions) <= BLOCK and not partial:
        return solved_table(
            solution_of(problem, phi, drawn_by("board", ruler), hint=HINT, forces=True)
        )
    gaps = examine_positions(problem, phi, partial=partial)
    return large_table(problem, positions, gaps, ruler=ruler, partial=partial)


def examine_positions(problem: Problem, phi: Positions | None, *, partial: bool) -> Gaps:
    """Examine all requested positions, print their warnings, and return the gaps."""
    from planmethod.solved.many.positions import examine

    warn_of_change_points(problem, phi)
    asked = requested_positions(problem, phi)
    looked = examine(problem, asked, forces=problem.dynamics is not None)
    _report_positions(problem, asked, looked.gaps, looked.warnings, partial)
    return looked.gaps


def _report_positions(
    problem: Problem,
    positions: Positions,
    gaps: Gaps,
    accuracy_warnings: tuple[object, ...],
    partial: bool,
) -> None:
    """Reject or report positions without results; report the warnings of the others."""
    if gaps.count and not partial:
        from planmethod.solved.selfcheck import without_dead
        from planmethod.solved.solution import Solution

        asked = Solution(problem, positions=positions.tolist())
        instead = without_dead(asked, gaps.failures[0], forces=problem.dynamics is not None) or ""
        raise AssemblyError(
            f"{gaps.refusal()}{instead}{translate(HINT) if len(gaps.reason) > 1 else ''}"
        )
    if gaps.count:
        warn(problem, gaps.warning())
    for said in accuracy_warnings:
        warn(problem, said)


def write_text(tables: list[SpreadsheetRows], file: str) -> None:
    """Write tables as one CSV."""
    from planmethod.note.records.spreadsheet import csv_text

    rows = sum(table.count for table in tables)
    cells = sum(table.count * len(table.header) for table in tables)
    seen = file != "-" or not is_terminal(sys.stdout)  # no bar amid the table
    with bar(rows, long=cells > LONG_TEXT and seen) as done:
        write_parts(csv_text(tables, done=done), file)


def sweep_of(
    problem: Problem, phi: Positions | None, quantities: tuple[str, ...] | None, partial: bool
) -> GappedSweep:
    """Return the sweep of the requested results; positions without any are rejected or reported."""
    from planmethod.solved.many.gaps import GappedSweep
    from planmethod.solved.quantities import UnknownQuantityError

    try:
        made = GappedSweep(problem, requested_positions(problem, phi), quantities)
    except UnknownQuantityError as error:
        raise UsageError("--ask: {}: {}", message_name(problem), error) from None
    _report_positions(problem, made.positions, made.gaps, made.warnings, partial)
    return made


def reject_long_table(rows: int) -> None:
    """Reject a table that is too long for the terminal."""
    if rows > MAX_SHOWN_ROWS:
        raise UsageError(
            "a table of {} rows is not for reading: give --csv FILE or --npz FILE", rows
        )


def reject_huge_array(sweep: GappedSweep) -> None:
    """Reject more numbers than fit into memory."""
    numbers = len(sweep.names) * len(sweep.positions)
    if numbers > MAX_NUMBERS:
        most = MAX_NUMBERS // len(sweep.names)
        raise UsageError(
            "--npz: {} results in {} positions are {} numbers, at most {} are written. "
            "Ask at most {} positions, or fewer results with --ask.",
            len(sweep.names),
            len(sweep.positions),
            numbers,
            MAX_NUMBERS,
            most,
        )


def write_arrays_file(sweeps: list[GappedSweep | SolvedArrays], file: str) -> None:
    """Write sweeps into one file; names of several begin with the variant or the problem."""
    from planmethod.note.records.spreadsheet import SolvedArrays, swept_arrays, write_arrays
    from planmethod.render.backends.output import opened

    prefixes = _prefixes([made.problem for made in sweeps])
    long = [made for made in sweeps if not isinstance(made, SolvedArrays)]
    numbers = sum(len(made.names) * len(made.positions) for made in long)

    def named() -> Iterator[tuple[str, Any]]:
        for made, prefix in zip(sweeps, prefixes, strict=True):
            if isinstance(made, SolvedArrays):
                yield from made.named(prefix)
            else:
                yield from swept_arrays(made, prefix)
            done(1)

    many = numbers > LONG_ARRAYS or len(sweeps) > MANY_PROBLEMS
    with opened(file) as target, bar(len(sweeps), long=many) as done:
        write_arrays(target, named())
    click.echo(file)


def _prefixes(problems: list[Problem]) -> list[str]:
    """Return the name prefixes of every problem's arrays."""
    if len(problems) == 1:
        return [""]
    one_file = len({problem.name for problem in problems}) == 1
    names = [(problem.variant if one_file else None) or basename(problem) for problem in problems]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise UsageError(
            "--npz: two problems are called {}, their arrays would have the same names; "
            "write them into two files",
            twice[0],
        )
    return [f"{name}:" for name in names]
