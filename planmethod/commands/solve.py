"""Command ``solve``: the numbers."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import functools
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from msgspec import Struct

from planmethod.commands.output import (
    JsonTexts,
    LocalizedCommand,
    json_text,
    watch_option,
    write_parts,
)
from planmethod.commands.position_tables import (
    HINT,
    MAX_SHOWN_ROWS,
    examine_positions,
    reject_huge_array,
    reject_long_table,
    requested_positions,
    sweep_of,
    table_of,
    write_arrays_file,
    write_text,
)
from planmethod.commands.problems import (
    LoadedProblem,
    finish,
    for_each_problem,
    guarded,
    language_of,
    message_name,
    no_position,
    of_linkages,
    solution_of,
    warn_of_change_points,
)
from planmethod.errors import ExitCode
from planmethod.languages import translate
from planmethod.options import (
    MAX_POSITIONS,
    MAX_SWEPT_POSITIONS,
    PathType,
    Positions,
    UsageError,
    drafting_options,
    drawn_by,
    jobs_option,
    positions_option,
    problem_lang_option,
    problem_options,
    read_labels,
)

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.kind import ProblemKind
    from planmethod.note.records.spreadsheet import SolvedArrays, SpreadsheetRows
    from planmethod.problem.model import Problem
    from planmethod.problem.records import KindProblem
    from planmethod.solved.many.gaps import GappedSweep
    from planmethod.solved.many.variants import Batch
    from planmethod.solved.solution import Solution


class SolveOptions(Struct, frozen=True, kw_only=True):
    """Results to compute and their form; the options of the command.

    Attributes
    ----------
    csv, npz, covariance : bool
        Whether a file or a table of that kind is made of all problems.
    in_subprocess : bool
        Whether the work is done in another process.
    """

    phi: Positions | None
    position: int | None = None
    ruler: float | None
    profile: str | None
    as_json: bool
    csv: bool
    npz: bool
    quantities: tuple[str, ...] | None
    partial: bool
    sigma: bool
    covariance: bool
    referee: int | None
    lang: str | None
    in_subprocess: bool

    @property
    def profile_and_ruler(self) -> tuple[str | None, float | None]:
        """Drafting profile and ruler."""
        return self.profile, self.ruler

    def of_linkages(self) -> dict[str, bool]:
        """Return the given options that only linkages have."""
        return {
            "--csv": self.csv,
            "--npz": self.npz,
            "--ask": self.quantities is not None,
            "--phi": self.phi is not None,
            "--position": self.position is not None,
            "--sigma": self.sigma,
            "--covariance": self.covariance,
            "--referee": self.referee is not None,
        }


@click.command(cls=LocalizedCommand)
@problem_options
@positions_option(MAX_SWEPT_POSITIONS)
@click.option(
    "--position",
    type=click.IntRange(min=0),
    metavar="NUMBER",
    help="Only the position of this number, from 0.",
)
@drafting_options
@click.option("--json", "as_json", is_flag=True, help="One object, full precision, SI.")
@click.option(
    "--csv",
    "csv_file",
    is_flag=False,
    flag_value="-",
    metavar="[FILE]",
    help="A row for each position; to the terminal without FILE.",
)
@click.option(
    "--npz",
    "npz_file",
    metavar="FILE",
    help="Arrays for NumPy, named as the columns of --csv (B.x, 2.omega), and phi_deg or s, "
    "reason, reasons. With several variants or problems each name begins with that of "
    "the variant or of the file: А:B.x.",
)
@click.option(
    "--ask",
    callback=read_labels,
    metavar="LIST",
    help="Only these results: v_E,omega_3,B,phi_2,v_q_E,u_31,F_B_2/1,M_dr, or positions, "
    "velocities, accelerations, transfers, forces.",
)
@click.option(
    "--partial",
    is_flag=True,
    help="Leave impossible positions empty and say why (--json, --csv, --npz, --ask).",
)
@click.option("--sigma", is_flag=True, help="Show the drafting errors in the tables.")
@click.option(
    "--covariance",
    "covariance_file",
    metavar="FILE",
    help="Drafting errors together: the covariance of every two quantities, CSV; - for the "
    "terminal.",
)
@click.option(
    "--referee",
    type=click.IntRange(16, 1000),
    is_flag=False,
    flag_value=50,
    metavar="[DIGITS]",
    help="Check every result with a computation in this number of digits (50), which needs mpmath.",
)
@click.option(
    "--compare",
    "work",
    metavar="WORK",
    type=PathType(),
    help="Own numbers beside the exact ones: JSON, TOML, CSV, XLSX or a form, as check reads them.",
)
@problem_lang_option
@jobs_option
@watch_option()
@guarded
def solve(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: Positions | None,
    position: int | None,
    ruler: float | None,
    profile: str | None,
    as_json: bool,
    csv_file: str | None,
    npz_file: str | None,
    ask: tuple[str, ...] | None,
    partial: bool,
    sigma: bool,
    covariance_file: str | None,
    referee: int | None,
    work: Path | None,
    lang: str | None,
    jobs: int,
) -> None:
    """Compute positions, velocities, accelerations and the plans' segments."""
    if work is not None:
        from planmethod.commands.compared import compare

        numbers = phi is not None or position is not None
        others = (all_variants, numbers, as_json, csv_file, npz_file, ask, covariance_file)
        if any(others) or len(problems) > 1:
            raise UsageError("--compare goes with one PROBLEM, --variant and --lang alone")
        compare(problems[0], work, variant, lang)
        return
    sweeping = npz_file is not None or ask is not None
    _reject_contradictions(as_json, csv_file, npz_file, ask)
    told = sweeping or csv_file is not None
    if told and (sigma or referee is not None):
        raise UsageError("--sigma and --referee go with the tables of a terminal or --json")
    if covariance_file is not None and (told or as_json):
        raise UsageError("--covariance is a table of its own: no --json, --csv, --npz, --ask")
    if covariance_file is not None and covariance_file.lower().endswith(".toml"):
        raise UsageError("--covariance would write over {}; put it last", covariance_file)
    if referee is not None:
        _need_mpmath()
    if position is not None and (told or covariance_file is not None):
        raise UsageError("--position goes with the tables of a terminal or --json")
    if partial and referee is not None:
        raise UsageError("--referee judges positions that exist: leave out --partial")
    if partial and not (sweeping or as_json or csv_file is not None):
        raise UsageError("--partial goes with --json, --csv, --npz or --ask")
    if phi is not None and len(phi) > MAX_POSITIONS and not sweeping:
        raise UsageError(
            "--phi: more than {} positions; this is possible only with --npz or --ask",
            MAX_POSITIONS,
        )
    if npz_file is not None or (phi is not None and len(phi) > MAX_SHOWN_ROWS):
        jobs = 1  # large tables are solved while they are written
    options = SolveOptions(
        phi=phi,
        position=position,
        ruler=ruler,
        profile=profile,
        as_json=as_json,
        csv=csv_file is not None,
        npz=npz_file is not None,
        quantities=ask,
        partial=partial,
        sigma=sigma,
        covariance=covariance_file is not None,
        referee=referee,
        lang=lang,
        in_subprocess=jobs > 1,
    )
    run = functools.partial(
        for_each_problem,
        problems,
        variant,
        all_variants,
        functools.partial(compute, options=options),
        jobs=jobs,
        act_on_many=_batch_solver(options),
        drawn=not sweeping,
    )
    if as_json:
        from planmethod.note.columnar import to_builtins

        with JsonTexts() as texts:
            code = run(on_result=lambda one: texts.add(json_text(to_builtins(one))))
            texts.echo()
        finish(code)
        return
    found: list[Any] = []
    code = run(on_result=found.append)
    if found and covariance_file is not None:
        from planmethod.note.records.solution import covariance_text

        write_parts([covariance_text(found)], covariance_file)
    if found and csv_file is not None:
        write_text(found, csv_file)
    if npz_file is not None and code is ExitCode.DONE:  # one file: all or nothing
        write_arrays_file(found, npz_file)
    finish(code)


def compute(
    item: LoadedProblem, options: SolveOptions
) -> dict[str, Any] | SpreadsheetRows | GappedSweep | SolvedArrays | Solution | None:
    """Compute a problem; print its numbers, or return what several problems print together."""
    kind, problem = item.kind, item.problem
    if kind is None:
        return _computed(item.linkage, options)
    table = kind.spreadsheet(problem) if options.csv else None
    for option, given in options.of_linkages().items():
        if given and not (table is not None and option == "--csv"):
            raise UsageError("{} is for linkages, {} is none", option, message_name(problem))
    if table is not None:
        return table
    if options.as_json:
        return kind.record(problem, language_of(problem, options.lang))
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document

    language = get_language(language_of(problem, options.lang))
    click.echo(plain_document(kind.solved_document(problem, language), language))
    return None


def _batch_solver(
    options: SolveOptions,
) -> Callable[[Sequence[LoadedProblem]], dict[int, Any]] | None:
    """Return the batch solver of many problems; None where each is to be solved alone."""
    moved = options.phi is not None or options.referee is not None or options.partial
    if (
        moved
        or options.quantities is not None
        or not (options.as_json or options.npz or options.csv)
    ):
        return None
    return functools.partial(_solve_together, options=options)


def _convert_batch(options: SolveOptions, batch: Batch) -> Iterator[Any]:
    """Return the numbers of a batch in the requested form."""
    if options.as_json:
        from planmethod.note.records.solution import batch_records

        return batch_records(batch)
    if options.npz:
        from planmethod.note.records.spreadsheet import batch_arrays

        return batch_arrays(batch)
    from planmethod.note.records.spreadsheet import batch_tables

    return batch_tables(batch)


def _solve_together(items: Sequence[LoadedProblem], options: SolveOptions) -> dict[int, Any]:
    """Return the output of linkages that are solved together, by index."""

    def solved(problems: list[Problem]) -> dict[int, Any]:
        from planmethod.solved.many.variants import in_batches

        found: dict[int, Any] = {}
        for batch, members in in_batches(problems, drawn_by(*hand)):
            found.update(zip(members, _convert_batch(options, batch), strict=True))
        if options.as_json:
            for number, one in found.items():
                found[number] = one | _other_parts_record(problems[number], options)
        return found

    hand = ("board", options.ruler) if options.csv else options.profile_and_ruler
    return of_linkages(items, solved)


def _computed(
    problem: Problem, options: SolveOptions
) -> dict[str, Any] | SpreadsheetRows | GappedSweep | SolvedArrays | Solution | None:
    phi, referee = options.phi, options.referee
    hand = drawn_by(options.profile, options.ruler)  # a train needs no arrays
    if options.npz and _batch_solver(options) is not None and _is_short(problem):
        from planmethod.note.records.spreadsheet import solved_arrays

        return solved_arrays(solution_of(problem, None, hand, hint=HINT, forces=True))
    if options.npz or options.quantities is not None:
        warn_of_change_points(problem, phi)
        if not (options.csv or options.npz):
            reject_long_table(len(requested_positions(problem, phi)))
        made = sweep_of(problem, phi, options.quantities, options.partial)
        if options.npz:
            reject_huge_array(made)
            return made
        from planmethod.note.records.spreadsheet import swept_table
        from planmethod.note.tables.requested_table import requested_document
        from planmethod.note.wording import get_language
        from planmethod.note.writers.terminal import plain_document

        if options.csv:
            table = swept_table(made, partial=options.partial)
            return table.materialized() if options.in_subprocess else table
        language = get_language(language_of(problem, options.lang))
        click.echo(plain_document(requested_document(made, language), language))
    elif options.csv:
        table = table_of(problem, phi, hand.ruler, options.partial)
        return table.materialized() if options.in_subprocess else table
    elif options.as_json and options.partial:
        return _partial(problem, options, hand)
    elif options.as_json:
        from planmethod.note.records.solution import record_in_columns

        solution, more = _requested_solution(problem, options, hand), {}
        if referee is not None:
            from planmethod.note.tables.referee import referee_record

            more["referee"] = referee_record(solution, referee)
        return record_in_columns(solution, **more) | _other_parts_record(problem, options)
    elif options.covariance:
        return solution_of(problem, phi, hand, hint=HINT)
    else:
        from planmethod.note.tables.results import results_document
        from planmethod.note.wording import get_language
        from planmethod.note.writers.terminal import plain_document

        language = get_language(language_of(problem, options.lang))
        solution = _requested_solution(problem, options, hand)
        click.echo(
            plain_document(results_document(solution, language, sigma=options.sigma), language)
        )
        if referee is not None:
            from planmethod.note.tables.referee import referee_document

            judged = referee_document(solution, referee, language)
            click.echo("\n" + plain_document(judged, language))
        for part, kind in _other_parts(problem):
            click.echo("\n" + plain_document(kind.solved_document(part, language), language))
    return None


def _partial(problem: Problem, options: SolveOptions, profile: Profile) -> dict[str, Any]:
    """Return the record of a problem some of whose positions may be impossible."""
    from planmethod.note.records.solution import partial_record

    positions, number = requested_positions(problem, options.phi), options.position
    gaps = examine_positions(problem, options.phi, partial=True)
    record = partial_record(problem, positions, gaps, profile)
    if number is None:
        return record
    if number >= len(positions):
        raise no_position(number, problem, len(positions))
    return {**record, "positions": record["positions"][number : number + 1]}


def _other_parts(problem: Problem) -> list[tuple[KindProblem, ProblemKind[Any]]]:
    """Return the wheels, the meshing and the cam of a project, which have numbers, too."""
    if problem.project is None:
        return []
    from planmethod.project.settle import settle

    parts = settle(problem, Path(problem.source_file)).parts
    return [(part.problem, part.kind) for part in parts if part.kind is not None]


def _other_parts_record(problem: Problem, options: SolveOptions) -> dict[str, Any]:
    """Return the records of the other parts of a project than its linkage, by table."""
    lang = language_of(problem, options.lang)
    found = {kind.table: kind.record(part, lang) for part, kind in _other_parts(problem)}
    return {"parts": found} if found else {}


def _is_short(problem: Problem) -> bool:
    """Return whether a problem has few enough positions to be solved in a batch."""
    from planmethod.solved.solution import FEW_ROWS

    return len(problem.drive.positions) <= FEW_ROWS


def _requested_solution(problem: Problem, options: SolveOptions, profile: Profile) -> Solution:
    """Return the solution to print; for a single position it has the scales of all."""
    solution = solution_of(problem, options.phi, profile, hint=HINT, forces=True, machine=True)
    number, positions = options.position, solution.positions
    if number is None:
        return solution
    if number >= len(positions):
        raise no_position(number, problem, len(positions))
    return solution.with_positions([float(positions[number])]).drawn_at(solution.scales)


def _need_mpmath() -> None:
    try:
        import mpmath  # noqa: F401
    except ImportError:
        raise UsageError("--referee needs mpmath: pip install mpmath") from None


def _reject_contradictions(
    as_json: bool, csv_file: str | None, npz_file: str | None, quantities: tuple[str, ...] | None
) -> None:
    """Reject contradictory options, and outputs that would overwrite a problem."""
    forms = {"--json": as_json, "--csv": csv_file is not None, "--npz": npz_file is not None}
    given = [name for name, is_given in forms.items() if is_given]
    if len(given) > 1:
        raise UsageError("give {}, not both", translate(" or ").join(given))
    if as_json and quantities is not None:
        raise UsageError("--json is always whole; --ask goes with --csv, --npz or a table")
    for name, file in (("--csv", csv_file), ("--npz", npz_file)):
        if file is not None and file.lower().endswith(".toml"):
            raise UsageError("{} would write over the problem file {}; put it last", name, file)
    if npz_file in ("", "-"):
        raise UsageError("--npz needs the name of a file")
