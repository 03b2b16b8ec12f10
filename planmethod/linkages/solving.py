"""Linkages solved for the commands: documents and data of ``solve``, protocols.

Warnings are printed while a problem is solved, before an impossible position ends it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.options import (
    MAX_SHOWN_ROWS,
    PlanRequest,
    Positions,
    ResultRequest,
    UsageError,
    drawn_by,
    message_name,
    warn,
    warn_each,
)
from planmethod.solved.failures import Cause, PositionError
from planmethod.solved.selfcheck import (
    changed_branches,
    kept_rates,
    motion_warnings,
    verify,
    warnings,
    without_dead,
)
from planmethod.solved.solution import FEW_ROWS, Solution

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.note.document import Document
    from planmethod.note.records.spreadsheet import SolvedArrays, SpreadsheetRows
    from planmethod.note.wording import Language
    from planmethod.problem.model import Problem
    from planmethod.render.play.playback import Playback
    from planmethod.solved.many.gapped import GappedSweep
    from planmethod.solved.many.positions import Gaps
    from planmethod.solved.many.variants import Batch

HINT = " To leave such positions empty, give --partial with --json, --csv, --npz or --ask."

_PLACES = " The places exist there: --ask positions."

MAX_NUMBERS = 250_000_000
"""Most numbers of one problem in a file of arrays: 2 GB, all in memory before they are written."""


# Solve -------------------------------------------------------------------------------------------


def solved_documents(
    problem: Problem, language: Language, request: ResultRequest
) -> Iterator[Document]:
    """Yield the tables of requested results, or of all, with the referee's and other parts'."""
    if request.quantities is not None:
        from planmethod.note.tables.requested_table import requested_document

        warn_each(problem, motion_warnings(problem, request.phi))
        _reject_long_table(len(requested_positions(problem, request.phi)))
        yield requested_document(_sweep_of(problem, request), language)
        return
    from planmethod.note.tables.results import results_document

    solution = _requested_solution(problem, request)
    yield results_document(solution, language, sigma=request.sigma)
    if request.referee is not None:
        from planmethod.note.tables.referee import referee_document

        yield referee_document(solution, request.referee, language)
    if request.centres:
        from planmethod.note.tables.centres import centres_document

        yield centres_document(solution, language)
    for kind, part in _other_parts(problem):
        yield kind.solved_document(part, language)


def solved_data(
    problem: Problem, lang: str, request: ResultRequest
) -> dict[str, Any] | SpreadsheetRows | GappedSweep | SolvedArrays | Solution:
    """Return a record, the rows of a table, arrays, or the solution of a table of covariances."""
    hand = request.drafting.named_profile  # a train needs no arrays
    if request.npz_file is not None and request.can_batch and _is_short(problem):
        from planmethod.note.records.spreadsheet import solved_arrays

        return solved_arrays(solution_of(problem, None, hand, hint=HINT, forces=True))
    if request.npz_file is not None:
        warn_each(problem, motion_warnings(problem, request.phi))
        sweep = _sweep_of(problem, request)
        _reject_huge_array(sweep)
        return sweep
    if request.csv_file is not None:
        return _table_of(problem, request, hand.ruler)
    if request.covariance_file is not None:
        return solution_of(problem, request.phi, hand, hint=HINT)
    if request.partial:
        return _partial_record(problem, request, hand)
    from planmethod.note.records.solution import record_in_columns

    solution, more = _requested_solution(problem, request), dict[str, Any]()
    if request.referee is not None:
        from planmethod.note.tables.referee import referee_record

        more["referee"] = referee_record(solution, request.referee)
    if request.centres:
        from planmethod.note.tables.centres import centres_record

        more["instant_centres"] = centres_record(solution)
    parts = {kind.table: kind.record(part, lang) for kind, part in _other_parts(problem)}
    return record_in_columns(solution, **more) | ({"parts": parts} if parts else {})


def solved_together(problems: Sequence[Problem], request: ResultRequest) -> dict[int, Any]:
    """Return the data of problems that are drawn by the same steps, by index."""
    from planmethod.solved.many.variants import in_batches

    hand = request.drafting.named_profile
    if request.csv_file is not None:
        hand = drawn_by("board", request.drafting.ruler)
    found: dict[int, Any] = {}
    for batch, members in in_batches(problems, hand):
        found.update(zip(members, _batch_data(batch, request), strict=True))
    return found


def _batch_data(batch: Batch, request: ResultRequest) -> Iterator[Any]:
    """Return the data of a batch in the requested form."""
    if request.as_json:
        from planmethod.note.records.solution import batch_records

        return batch_records(batch)
    if request.npz_file is not None:
        from planmethod.note.records.spreadsheet import batch_arrays

        return batch_arrays(batch)
    from planmethod.note.records.spreadsheet import batch_tables

    return batch_tables(batch)


def _table_of(problem: Problem, request: ResultRequest, ruler: float) -> SpreadsheetRows:
    """Return the rows of all results; a large table is checked here and solved when written."""
    from planmethod.note.records.spreadsheet import large_table, solved_table, swept_table
    from planmethod.solved.many.positions import BLOCK

    phi, partial = request.phi, request.partial
    if request.quantities is not None:
        warn_each(problem, motion_warnings(problem, phi))
        return swept_table(_sweep_of(problem, request), partial=partial)
    positions = requested_positions(problem, phi)
    if len(positions) <= BLOCK and not partial:
        solution = solution_of(problem, phi, drawn_by("board", ruler), hint=HINT, forces=True)
        if not request.centres:
            return solved_table(solution)
        from planmethod.note.tables.centres import centres_columns

        return solved_table(solution, centres_columns(solution))
    if request.centres:
        text = "--centres with --csv: {} positions, the limit is {}"
        raise UsageError(text, len(positions), BLOCK)
    gaps = _examine_positions(problem, phi, partial=partial)
    return large_table(problem, positions, gaps, ruler=ruler, partial=partial)


def _partial_record(problem: Problem, request: ResultRequest, profile: Profile) -> dict[str, Any]:
    """Return the record of a problem some of whose positions may be impossible."""
    from planmethod.note.records.solution import partial_record

    positions, number = requested_positions(problem, request.phi), request.position
    gaps = _examine_positions(problem, request.phi, partial=True)
    record = partial_record(problem, positions, gaps, profile)
    if number is None:
        return record
    if number >= len(positions):
        raise no_position(number, problem, len(positions))
    return {**record, "positions": record["positions"][number : number + 1]}


def _requested_solution(problem: Problem, request: ResultRequest) -> Solution:
    """Return the solution to print; for a single position it has the scales of all."""
    hand = request.drafting.named_profile
    solution = solution_of(problem, request.phi, hand, hint=HINT, forces=True, machine=True)
    number, positions = request.position, solution.positions
    if number is None:
        return solution
    if number >= len(positions):
        raise no_position(number, problem, len(positions))
    return solution.in_position(number).drawn_at(solution.scales)


def _other_parts(problem: Problem) -> list[tuple[Any, Any]]:
    """Return the kinds and problems of the wheels, the meshing and the cam of a project."""
    if not problem.is_project:
        return []
    from planmethod.project.parts import PART_KINDS
    from planmethod.project.settle import settle

    parts = settle(problem, Path(problem.source_file)).parts
    return [(PART_KINDS[part.name], part.problem) for part in parts if part.name in PART_KINDS]


def _is_short(problem: Problem) -> bool:
    """Return whether a problem has few enough positions to be solved in a batch."""
    return len(problem.drive.positions) <= FEW_ROWS


# Many positions ----------------------------------------------------------------------------------


def requested_positions(problem: Problem, phi: Positions | None) -> Positions:
    """Return the positions of ``--phi``, rad, or those of the problem."""
    return np.array(problem.drive.positions) if phi is None else phi


def _examine_positions(problem: Problem, phi: Positions | None, *, partial: bool) -> Gaps:
    """Examine all requested positions, print their warnings, and return the gaps."""
    from planmethod.solved.many.positions import examine

    warn_each(problem, motion_warnings(problem, phi))
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
        asked = Solution(problem, positions=positions.tolist())
        instead = without_dead(asked, gaps.failures[0], forces=problem.dynamics is not None) or ""
        raise AssemblyError(
            f"{gaps.refusal()}{instead}{translate(HINT) if len(gaps.reason) > 1 else ''}"
        )
    if gaps.count:
        warn(problem, gaps.warning())
    warn_each(problem, accuracy_warnings)


def _sweep_of(problem: Problem, request: ResultRequest) -> GappedSweep:
    """Return the sweep of the requested results; positions without any are rejected or reported."""
    from planmethod.solved.many.gapped import GappedSweep
    from planmethod.solved.quantities import UnknownQuantityError

    positions = requested_positions(problem, request.phi)
    try:
        made = GappedSweep(problem, positions, request.quantities)
    except UnknownQuantityError as error:
        raise UsageError("--ask: {}: {}", message_name(problem), error) from None
    _report_positions(problem, made.positions, made.gaps, made.warnings, request.partial)
    return made


def _reject_long_table(rows: int) -> None:
    """Reject a table that is too long for the terminal."""
    if rows > MAX_SHOWN_ROWS:
        raise UsageError(
            "a table of {} rows is too long for the terminal: give --csv FILE or --npz FILE", rows
        )


def _reject_huge_array(sweep: GappedSweep) -> None:
    """Reject more numbers than fit into memory."""
    numbers = len(sweep.names) * len(sweep.positions)
    if numbers > MAX_NUMBERS:
        most = MAX_NUMBERS // len(sweep.names)
        raise UsageError(
            "--npz: {} results in {} positions are {} numbers, the limit is {}. Request at "
            "most {} positions, or fewer results with --ask.",
            len(sweep.names),
            len(sweep.positions),
            numbers,
            MAX_NUMBERS,
            most,
        )


# Protocols ---------------------------------------------------------------------------------------


def protocol(problem: Problem, language: Language, request: PlanRequest) -> Document:
    """Return the construction of a position, step by step.

    It is the requested one, else the calculated one of a project, else the first.
    """
    from planmethod.note.protocol import protocol_document

    solution, number = constructed(problem, request)
    return protocol_document(
        solution, language, number, analytic=request.analytic, centres=request.centres
    )


def playback(problem: Problem, language: Language, request: PlanRequest) -> Playback:
    """Return the construction of the same position as it is played."""
    from planmethod.render.play.linkage import linkage_playback

    solution, number = constructed(problem, request)
    return linkage_playback(solution, language, number)


def constructed(problem: Problem, request: PlanRequest) -> tuple[Solution, int]:
    """Return a solution, and the number of the position whose construction is described.

    Raises
    ------
    UsageError
        There is no such position.
    """
    phi, number = request.phi, request.position
    solution = solution_of(problem, phi, request.profile, forces=True, machine=True)
    count = len(solution.positions)
    if number is None:
        number = (None if phi is not None else problem.calculated) or 0
    if number >= count:
        raise no_position(number, problem, count)
    return solution, number


def no_position(number: int, problem: Problem, count: int) -> UsageError:
    """Return the error of a position that a problem does not have."""
    return UsageError(
        "--position {}: the last of {} is {}", number, message_name(problem), count - 1
    )


# Solutions ---------------------------------------------------------------------------------------


def solution_of(
    problem: Problem,
    phi: Positions | None,
    profile: Profile,
    *,
    hint: str = "",
    forces: bool = False,
    machine: bool = False,
) -> Solution:
    """Solve a problem, check the solution, and print its warnings.

    Parameters
    ----------
    profile : Profile
        Accuracy of drawing the plans.
    hint : str
        Alternative to suggest where one of several positions is rejected.
    forces : bool
        The forces must exist, too, where there are loads.
    machine : bool
        The flywheel is checked as well.
    """
    solution = Solution(problem, positions=None if phi is None else phi.tolist(), profile=profile)
    warn_each(problem, changed_branches(solution))
    warn_each(problem, kept_rates(solution))
    try:
        verify(solution, forces=forces)
    except AssemblyError as error:
        if hint and isinstance(error, PositionError) and error.failure.cause is Cause.RAYS:
            hint = f"{translate(_PLACES)}{translate(hint) if len(solution.positions) > 1 else ''}"
        elif len(solution.positions) < 2:
            raise
        else:
            hint = translate(hint)
        raise AssemblyError(f"{error}{hint}") from error
    warn_each(problem, warnings(solution, forces=forces))
    if machine and problem.machine is not None:
        from planmethod.solved.machine.chain import flywheel_warnings
        from planmethod.solved.machine.flywheel import flywheel_of

        warn_each(problem, flywheel_warnings(flywheel_of(solution)))
    return solution
