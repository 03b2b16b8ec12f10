"""Command line: parse, call, print, exit code; no geometry here.

What a command does not need it does not import: the imports of the work stand in the functions.
"""

from __future__ import annotations

import functools
import gc
import io
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.options import (
    format_option,
    lang_option,
    out_option,
    problem_options,
    reading_options,
    ruler_option,
    stamp_option,
)

if TYPE_CHECKING:
    from planmethod.plans.solution import Solution
    from planmethod.problem.model import Problem

F = TypeVar("F", bound=Callable[..., Any])

MANY = 6
"""Problems from which a command shows how far it is."""


def _fail(error: PlanMethodError) -> None:
    click.echo(f"Error: {error}", err=True)


def guarded(command: F) -> F:
    """Turn the package's errors into a message and an exit code."""

    @functools.wraps(command)
    def wrapper(*args: Any, **kwargs: Any) -> Any:
        try:
            return command(*args, **kwargs)
        except PlanMethodError as error:
            _fail(error)
            sys.exit(error.exit_code)

    return wrapper  # type: ignore[return-value]


def _load(path: Path, variant: str | None, all_variants: bool) -> list[Problem]:
    """Read a problem file: one problem, or one for each variant."""
    from planmethod.problem import load, variant_names

    if all_variants and variant is not None:
        raise click.UsageError("give --variant or --all-variants, not both")
    if all_variants:
        names = variant_names(path)
        return [load(path, variant=name) for name in names] or [load(path)]
    return [load(path, variant=variant)]


def _each(
    paths: tuple[Path, ...], variant: str | None, all_variants: bool, act: Callable[[Problem], None]
) -> None:
    """Act on every problem; a faulty one is reported and the others go on."""
    errors: list[PlanMethodError] = []

    def problems() -> Iterator[Problem]:
        for path in paths:
            try:
                yield from _load(path, variant, all_variants)
            except PlanMethodError as error:
                errors.append(error)
                _fail(error)

    found = list(problems())
    for problem in _watched(found):
        try:
            act(problem)
        except PlanMethodError as error:
            errors.append(error)
            _fail(error)
    if errors:
        sys.exit(errors[0].exit_code)


def _watched(found: list[Problem]) -> Iterator[Problem]:
    """Yield problems, on a terminal with a bar when they are many (about a second of work)."""
    if len(found) < MANY or not sys.stderr.isatty():
        yield from found
        return
    with click.progressbar(found, label="planmethod", file=sys.stderr) as bar:
        yield from bar


def _stem(problem: Problem) -> str:
    return problem.name if problem.variant is None else f"{problem.name}-{problem.variant}"


def _solve(problem: Problem, phi: tuple[float, ...] | None, ruler: float) -> Solution:
    from planmethod.plans.selfcheck import verify, warnings
    from planmethod.plans.solution import Solution

    solution = Solution(problem, positions=phi, ruler=ruler)
    verify(solution)
    for said in warnings(solution):
        click.echo(f"Warning: {problem.name}: {said}", err=True)
    return solution


@click.group(context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="planmethod")
def cli() -> None:
    """Draw and compute linkages by the graphical plan method (метод планов)."""


@cli.command()
@problem_options
@reading_options
@out_option
@format_option("svg,pdf")
@click.option("--paper", metavar="FORMAT", help="A4, A3, A2, A1; chosen to fit when absent.")
@stamp_option
@click.option("--dpi", type=click.IntRange(30, 600), default=100, show_default=True, help="Of PNG.")
@guarded
def sheet(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: tuple[float, ...] | None,
    ruler: float,
    out: Path,
    formats: tuple[str, ...],
    paper: str | None,
    stamp: dict[str, str],
    dpi: int,
) -> None:
    """Draw the framed sheet: scheme, velocity and acceleration plans, equations, tables."""
    from planmethod.render.sheets.kinematics import kinematics_sheets

    def draw(problem: Problem) -> None:
        drawings = kinematics_sheets(problem, paper=paper, positions=phi, ruler=ruler, fields=stamp)
        _write(drawings, out, _stem(problem), formats, dpi, stamp.get("author"))

    _each(problems, variant, all_variants, draw)


def _write(
    drawings: list[Any],
    out: Path,
    stem: str,
    formats: tuple[str, ...],
    dpi: int,
    author: str | None,
) -> None:
    """Write drawings as ``stem.svg``, ``stem-2.svg``...; files appear only when all are made."""
    from planmethod.render.backends import render
    from planmethod.render.backends.canvas import Options
    from planmethod.render.output import write

    options = Options(dpi=dpi) if author is None else Options(dpi=dpi, author=author)
    files = {
        out / (f"{stem}.{fmt}" if number == 1 else f"{stem}-{number}.{fmt}"): render(
            drawing, fmt, options=options
        )
        for number, drawing in enumerate(drawings, 1)
        for fmt in formats
    }
    for path, data in files.items():
        write(path, data)
    for path in files:
        click.echo(str(path))


@cli.command()
@problem_options
@reading_options
@click.option("--json", "as_json", is_flag=True, help="One object, full precision, SI.")
@click.option(
    "--csv",
    "csv_file",
    is_flag=False,
    flag_value="-",
    metavar="[FILE]",
    help="A row for each position; to the terminal without FILE.",
)
@lang_option
@guarded
def solve(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: tuple[float, ...] | None,
    ruler: float,
    as_json: bool,
    csv_file: str | None,
    lang: str,
) -> None:
    """Compute positions, velocities, accelerations and the plans' segments."""
    if as_json and csv_file is not None:
        raise click.UsageError("give --json or --csv, not both")
    if csv_file is not None and csv_file.lower().endswith(".toml"):
        raise click.UsageError(f"--csv would write over the problem file {csv_file}; put it last")
    records: list[dict[str, Any]] = []
    tables: list[tuple[Problem, list[str], list[list[Any]]]] = []

    def compute(problem: Problem) -> None:
        solution = _solve(problem, phi, ruler)
        if as_json:
            from planmethod.note.record import record

            records.append(record(solution))
        elif csv_file is not None:
            from planmethod.note.tables import csv_rows

            header, rows = csv_rows(solution)
            tables.append((problem, list(header), [list(row) for row in rows]))
        else:
            from planmethod.note.tables import result_tables

            click.echo(result_tables(solution, lang))

    try:
        _each(problems, variant, all_variants, compute)
    finally:
        if records:
            import json

            whole: Any = records[0] if len(records) == 1 else records
            click.echo(json.dumps(whole, ensure_ascii=_is_narrow(), allow_nan=False))
        if tables:
            _put(_csv(tables), csv_file)


def _csv(tables: list[tuple[Problem, list[str], list[list[Any]]]]) -> str:
    """Return solutions as CSV; of several each row tells its problem and variant.

    A solution with other columns than the one before it begins with a header of its own.
    """
    import csv

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    several, before = len(tables) > 1, None
    for problem, header, rows in tables:
        if header != before:
            writer.writerow(["problem", "variant", *header] if several else header)
        before = header
        told = [problem.name, problem.variant or ""] if several else []
        writer.writerows([*told, *row] for row in rows)
    return text.getvalue()


def _put(text: str, file: str | None) -> None:
    """Print a text, or write it to a file and say so."""
    if file is None or file == "-":
        click.echo(text, nl=not text.endswith("\n"))
        return
    from planmethod.render.output import write

    write(Path(file), text.encode())
    click.echo(file)


@cli.command()
@problem_options
@out_option
@click.option("--json", "as_json", is_flag=True, help="The analysis as one object.")
@format_option("svg")
@click.option("--no-drawing", is_flag=True, help="Text only.")
@click.option("--paper", metavar="FORMAT", help="A3, A2...; chosen to fit when absent.")
@stamp_option
@lang_option
@guarded
def structure(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    out: Path,
    as_json: bool,
    formats: tuple[str, ...],
    no_drawing: bool,
    paper: str | None,
    stamp: dict[str, str],
    lang: str,
) -> None:
    """Analyse the structure: mobility, redundant constraints, Assur groups; text and drawing."""
    from planmethod.mechanism.structure import analyse

    def show(problem: Problem) -> None:
        found = analyse(problem.mechanism)
        if as_json:
            import json

            from planmethod.note.record import structure_record

            head = {"schema": 1, "problem": problem.name}
            whole = {**head, "structure": structure_record(found)}
            click.echo(json.dumps(whole, ensure_ascii=_is_narrow()))
            return
        from planmethod.note.structure_text import structure_text

        click.echo(structure_text(problem.mechanism, found, lang))
        if not no_drawing:
            from planmethod.render.sheets.structure import structure_sheet

            drawing = structure_sheet(problem, found, paper=paper, fields=stamp)
            _write([drawing], out, f"{_stem(problem)}-structure", formats, 100, None)

    _each(problems, variant, all_variants, show)


@cli.command()
@problem_options
@reading_options
@click.option(
    "-o",
    "--out",
    type=click.Path(path_type=Path, file_okay=False),
    help="Folder for a text file; to the terminal when absent.",
)
@click.option("--position", type=click.IntRange(min=1), default=1, help="Number of the position.")
@lang_option
@guarded
def protocol(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    phi: tuple[float, ...] | None,
    ruler: float,
    out: Path | None,
    position: int,
    lang: str,
) -> None:
    """Tell the construction step by step, as the explanatory note does."""
    from planmethod.note.protocol import protocol as narrate

    def tell(problem: Problem) -> None:
        solution = _solve(problem, phi, ruler)
        count = len(solution.positions)
        if position > count:
            raise click.UsageError(f"--position {position}: {problem.name} has {count}")
        text = narrate(solution, lang=lang, position=position - 1)
        _put(text, None if out is None else str(out / f"{_stem(problem)}-protocol.txt"))

    _each(problems, variant, all_variants, tell)


@cli.command()
@problem_options
@ruler_option
@lang_option
@click.option(
    "-o",
    "--out",
    "file",
    metavar="FILE",
    help="Markdown file; to the terminal when absent.",
)
@guarded
def audit(
    problems: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    ruler: float,
    lang: str,
    file: str | None,
) -> None:
    """Compare what the sources print with the exact values and with the ruler's."""
    from planmethod.note.audit import audit as examine
    from planmethod.note.audit_table import Document

    if file is not None and file.lower().endswith(".toml"):
        raise click.UsageError(f"-o would write over the problem file {file}; name another one")
    audits: list[tuple[Problem, Any]] = []

    def compare(problem: Problem) -> None:
        audits.append((problem, examine(problem, ruler=ruler)))

    # A faulty problem ends the command here: the document is written whole or not at all.
    _each(problems, variant, all_variants, compare)
    _put(Document(lang, ruler).markdown(audits), file)


@cli.command()
@click.argument("family", required=False)
@click.argument("file", required=False, type=click.Path(path_type=Path, dir_okay=False))
@click.option("--list", "show", is_flag=True, help="List the families.")
@click.option("--force", is_flag=True, help="Write over an existing file.")
@guarded
def new(family: str | None, file: Path | None, show: bool, force: bool) -> None:
    """Write a commented problem file of a FAMILY, ready to edit."""
    from planmethod.problem import FAMILIES, template

    if show or family is None:
        width = max(map(len, FAMILIES))
        for name, meaning in FAMILIES.items():
            click.echo(f"{name.ljust(width)}  {meaning}")
        if not show:
            raise click.UsageError("give one of these families: planmethod new FAMILY [FILE]")
        return
    if family not in FAMILIES:
        from difflib import get_close_matches

        near = get_close_matches(family, FAMILIES, 1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise click.UsageError(f"no family {family!r}{hint} Known: {', '.join(FAMILIES)}.")
    path = file or Path(f"{family}.toml")
    if path.exists() and not force:
        raise click.UsageError(f"{path} exists; name another file or give --force")
    from planmethod.render.output import write

    write(path, template(family).encode())
    click.echo(str(path))


def _is_narrow() -> bool:
    """Tell whether the terminal's encoding has only some of the letters."""
    return not (sys.stdout.encoding or "").lower().startswith("utf")


def main() -> None:
    """Run the command line; no traceback reaches a user."""
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")  # a Russian console has no Greek or arrows
    # A command lives a fraction of a second and makes few cycles: looking for them is a twentieth.
    gc.set_threshold(100_000)
    try:
        cli()
    except BrokenPipeError:
        sys.exit(ExitCode.DONE)
    except OSError as error:
        click.echo(f"Error: cannot write the output: {error.strerror or error}.", err=True)
        sys.exit(ExitCode.USAGE)
    except Exception as error:  # the last net
        click.echo(
            f"Error: planmethod failed inside ({type(error).__name__}: {error}). Please report the "
            "problem file and the command.",
            err=True,
        )
        sys.exit(ExitCode.SELF_CHECK)
