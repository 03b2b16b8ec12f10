"""Command ``solve``: the numbers."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import functools
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from planmethod.commands.output import (
    JsonTexts,
    LocalizedCommand,
    bar,
    is_terminal,
    json_text,
    watch_option,
    write_parts,
)
from planmethod.commands.problems import (
    LoadedProblem,
    act_by_kind,
    finish,
    for_each_problem,
    guarded,
    language_of,
)
from planmethod.errors import ExitCode
from planmethod.languages import translate
from planmethod.options import (
    MAX_POSITIONS,
    MAX_SHOWN_ROWS,
    MAX_SWEPT_POSITIONS,
    PathType,
    Positions,
    UsageError,
    basename,
    drafting_options,
    jobs_option,
    positions_option,
    problem_lang_option,
    problem_options,
    read_labels,
)

if TYPE_CHECKING:
    from planmethod.kind import SolveOptions
    from planmethod.note.records.spreadsheet import SolvedArrays, SpreadsheetRows
    from planmethod.problem.model import Problem
    from planmethod.solved.many.gaps import GappedSweep

MANY_PROBLEMS = 500
"""Problems whose arrays take about a second to write."""

LONG_TEXT, LONG_ARRAYS = 2_000_000, 50_000_000
"""Count of numbers that take about a second to write."""


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
    from planmethod.kind import SolveOptions

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
        act_on_many=(
            functools.partial(_solve_together, options=options) if options.can_batch else None
        ),
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


def compute(item: LoadedProblem, options: SolveOptions) -> Any:
    """Compute a problem; print its numbers, or return what several problems print together."""
    from planmethod.note.wording import get_language

    kind, problem = item.kind, item.problem
    kind.reject_options(problem, options.of_linkages())
    lang = language_of(problem, options.lang)
    if options.returns_data:
        return kind.solved_data(problem, lang, options)
    from planmethod.note.writers.terminal import plain_document

    language = get_language(lang)
    for number, document in enumerate(kind.solved_documents(problem, language, options)):
        click.echo("\n" * min(number, 1) + plain_document(document, language))
    return None


def _solve_together(items: Sequence[LoadedProblem], options: SolveOptions) -> dict[int, Any]:
    """Return the data of problems that can be solved together, by index."""
    return act_by_kind(items, lambda kind, problems: kind.solved_together(problems, options))


# Files -------------------------------------------------------------------------------------------


def write_text(tables: list[SpreadsheetRows], file: str) -> None:
    """Write tables as one CSV."""
    from planmethod.note.records.spreadsheet import csv_text

    rows = sum(table.count for table in tables)
    cells = sum(table.count * len(table.header) for table in tables)
    seen = file != "-" or not is_terminal(sys.stdout)  # no bar amid the table
    with bar(rows, long=cells > LONG_TEXT and seen) as done:
        write_parts(csv_text(tables, done=done), file)


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


# Contradictions ----------------------------------------------------------------------------------


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
