"""Command ``solve``: the numbers."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import JsonTexts, bar, is_terminal, json_text, write_parts
from planmethod.commands.problems import (
    LoadedProblem,
    Loading,
    act_by_kind,
    finish,
    for_each_problem,
    language_of,
)
from planmethod.errors import ExitCode
from planmethod.languages import translate
from planmethod.options import (
    MAX_POSITIONS,
    MAX_SHOWN_ROWS,
    PathType,
    ProblemChoice,
    ResultRequest,
    UsageError,
    basename,
    jobs_option,
    option,
    problem_lang_option,
    watch_option,
)

if TYPE_CHECKING:
    from planmethod.note.records.spreadsheet import SolvedArrays, SpreadsheetRows
    from planmethod.problem.model import Problem
    from planmethod.solved.many.gapped import GappedSweep

MANY_PROBLEMS = 500
"""Problems whose arrays take about a second to write."""

LONG_TEXT, LONG_ARRAYS = 2_000_000, 50_000_000
"""Count of numbers that take about a second to write."""


class SolveOptions(Struct, frozen=True, kw_only=True):
    """Options of ``solve``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    request: ResultRequest = field(default_factory=ResultRequest)
    work: Path | None = option(
        "--compare",
        metavar="WORK",
        type=PathType(),
        help="Compare your own values with the exact ones. WORK is JSON, TOML, CSV, XLSX or "
        "a filled-in form.",
    )
    lang: str | None = problem_lang_option()
    jobs: int = jobs_option()
    watch: bool = watch_option()

    @property
    def processes(self) -> int:
        """Number of processes; large tables are solved while they are written, by one."""
        request = self.request
        long = request.phi is not None and request.phi.shape[-1] > MAX_SHOWN_ROWS
        return 1 if long or request.npz_file is not None else self.jobs


@command(SolveOptions)
def solve(options: SolveOptions) -> None:
    """Compute positions, velocities, accelerations and the plans' segments."""
    choice, request = options.choice, options.request
    if options.work is not None:
        from planmethod.commands.compared import compare

        _reject_beside_compare(choice, request)
        compare(choice.problems[0], options.work, choice.variant, options.lang)
        return
    _reject_contradictions(request)
    run = partial(
        for_each_problem,
        choice,
        partial(compute, options=options),
        jobs=options.processes,
        act_on_many=partial(_solve_together, request=request) if request.can_batch else None,
        loading=Loading(drawn=not request.is_swept),
    )
    if request.as_json:
        from planmethod.note.columnar import to_builtins

        with JsonTexts() as texts:
            code = run(on_result=lambda one: texts.add(json_text(to_builtins(one))))
            texts.echo()
        finish(code)
        return
    found: list[Any] = []
    code = run(on_result=found.append)
    if found and request.covariance_file is not None:
        from planmethod.note.records.solution import covariance_text

        write_parts([covariance_text(found)], request.covariance_file)
    if found and request.csv_file is not None:
        write_text(found, request.csv_file)
    if request.npz_file is not None and code is ExitCode.DONE:  # one file: all or nothing
        write_arrays_file(found, request.npz_file)
    finish(code)


def compute(item: LoadedProblem, options: SolveOptions) -> Any:
    """Compute a problem; print its numbers, or return what several problems print together."""
    from planmethod.note.wording import get_language

    kind, problem, request = item.kind, item.problem, options.request
    kind.reject_options(problem, request)
    lang = language_of(problem, options.lang)
    if request.returns_data:
        data = kind.solved_data(problem, lang, request)
        is_sent = request.csv_file is not None and options.processes > 1
        return data.materialized() if is_sent else data
    from planmethod.note.writers.terminal import plain_document

    language = get_language(lang)
    for number, document in enumerate(kind.solved_documents(problem, language, request)):
        click.echo("\n" * min(number, 1) + plain_document(document, language))
    return None


def _solve_together(items: Sequence[LoadedProblem], request: ResultRequest) -> dict[int, Any]:
    """Return the data of problems that can be solved together, by index."""
    return act_by_kind(items, lambda kind, problems: kind.solved_together(problems, request))


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
            "--npz: two problems have the name {}, so their arrays would have the same "
            "names; write two files",
            twice[0],
        )
    return [f"{name}:" for name in names]


# Contradictions ----------------------------------------------------------------------------------


def _reject_beside_compare(choice: ProblemChoice, request: ResultRequest) -> None:
    """Reject what does not go with a work to compare."""
    numbers = request.phi is not None or request.position is not None
    others = (
        choice.all_variants, numbers, request.as_json, request.csv_file, request.npz_file,
        request.quantities, request.covariance_file,
    )  # fmt: skip
    if any(others) or len(choice.problems) > 1:
        raise UsageError(
            "--compare allows one PROBLEM, and only --variant and --lang as further options"
        )


def _reject_contradictions(request: ResultRequest) -> None:
    """Reject contradictory options, and outputs that would overwrite a problem."""
    _reject_other_forms(request)
    is_table = request.is_swept or request.csv_file is not None
    covariance_file, referee = request.covariance_file, request.referee
    if is_table and (request.sigma or referee is not None):
        raise UsageError("--sigma and --referee require the tables of the terminal or --json")
    if request.centres and (request.is_swept or covariance_file is not None or request.partial):
        raise UsageError("--centres requires the tables of the terminal, --json or --csv")
    if covariance_file is not None and (is_table or request.as_json):
        raise UsageError(
            "--covariance writes a separate table: omit --json, --csv, --npz and --ask"
        )
    if covariance_file is not None and covariance_file.lower().endswith(".toml"):
        raise UsageError("--covariance would overwrite {}; put it last", covariance_file)
    if referee is not None:
        _need_mpmath()
    if request.position is not None and (is_table or covariance_file is not None):
        raise UsageError("--position requires the tables of the terminal or --json")
    if request.partial and referee is not None:
        raise UsageError("--referee verifies only positions that exist: omit --partial")
    if request.partial and not (is_table or request.as_json):
        raise UsageError("--partial requires --json, --csv, --npz or --ask")
    if request.phi is not None and request.phi.shape[-1] > MAX_POSITIONS and not request.is_swept:
        raise UsageError(
            "--phi: more than {} positions; this is possible only with --npz or --ask",
            MAX_POSITIONS,
        )


def _need_mpmath() -> None:
    try:
        import mpmath  # noqa: F401
    except ImportError:
        raise UsageError("--referee needs mpmath: pip install mpmath") from None


def _reject_other_forms(request: ResultRequest) -> None:
    """Reject several forms at once, and files that are problems."""
    files = {"--csv": request.csv_file, "--npz": request.npz_file}
    forms = {"--json": request.as_json} | {name: file is not None for name, file in files.items()}
    given = [name for name, is_given in forms.items() if is_given]
    if len(given) > 1:
        raise UsageError("give {}, not both", translate(" or ").join(given))
    if request.as_json and request.quantities is not None:
        raise UsageError("--json prints all results; use --ask with --csv, --npz or a table")
    for name, file in files.items():
        if file is not None and file.lower().endswith(".toml"):
            raise UsageError("{} would overwrite the problem file {}; put it last", name, file)
    if request.npz_file in ("", "-"):
        raise UsageError("--npz requires the name of a file")
