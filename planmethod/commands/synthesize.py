"""Command ``synthesize``: sizes of a mechanism by construction (синтез)."""

from __future__ import annotations

import contextlib
import shlex
import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, Literal

import click
from click.core import ParameterSource

from planmethod.commands.output import (
    LocalizedCommand,
    json_text,
    reject_unknown,
    write_drawings,
    write_new,
)
from planmethod.commands.problems import finish, guarded
from planmethod.commands.sheet_options import PaperRequest, sheet_options
from planmethod.errors import AssemblyError, ExitCode, ProblemError
from planmethod.languages import current_language, translate
from planmethod.options import (
    BadParameter,
    PathType,
    UsageError,
    drafting_options,
    drawn_by,
    dxf_text_option,
    format_option,
)

LEAST, MOST = 1e-6, 1e4
"""Range of accepted lengths, m."""


def _number(text: str) -> float:
    """Return a number of an option; a decimal comma would be ambiguous with a separator."""
    from planmethod.problem.formula import read_decimal

    number = read_decimal(text)
    if number is None:
        raise BadParameter("{!r} is not a number", text.strip())
    if not abs(number) < 1e9:
        raise BadParameter("{!r} is out of range: below 1e9 is expected", text.strip())
    return float(number)


def read_number(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return a number."""
    return None if value is None else _number(value)


def read_length(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return a positive length, m."""
    number = read_number(ctx, param, value)
    if number is not None and not LEAST <= number <= MOST:
        raise BadParameter("{:g} m: a length from {:g} to {:g} m is expected", number, LEAST, MOST)
    return number


def read_offset(ctx: click.Context, param: click.Parameter, value: str | None) -> float | None:
    """Return a length of either sign, m; 0 is none."""
    number = read_number(ctx, param, value)
    if number:
        read_length(ctx, param, str(abs(number)))
    return number


def read_rows(
    ctx: click.Context, param: click.Parameter, value: str | None
) -> tuple[tuple[float, ...], ...] | None:
    """Return rows of numbers: ``x,y,angle; x,y,angle``."""
    if value is None:
        return None
    rows = [row for row in value.split(";") if row.strip()]
    return tuple(tuple(_number(number) for number in row.split(",")) for row in rows)


def read_line(
    ctx: click.Context, param: click.Parameter, value: str | None
) -> tuple[float, ...] | None:
    """Return a line: x and y of a point, m, and its direction, degrees."""
    rows = read_rows(ctx, param, value)
    if rows is None:
        return None
    if len(rows) != 1 or len(rows[0]) != 3:
        raise BadParameter("{!r} is not x,y,angle", value)
    return rows[0]


_OPTIONS: tuple[tuple[str, str, Callable[..., Any], str], ...] = (
    ("K_v", "NUMBER", read_number, "Slow stroke's time over the quick one's, at least 1."),
    ("centres", "M", read_length, "Distance of the fixed pivots."),
    ("stroke", "M", read_length, "Stroke of the slider."),
    ("swing", "DEG", read_number, "Swing of the slotted link or the rocker."),
    ("lambda", "NUMBER", read_number, "Crank over rod, r/l."),
    ("offset", "M", read_offset, "Offset of the guide from the crank's pivot, upwards positive."),
    ("pressure", "DEG", read_number, "Largest pressure angle of the slider."),
    ("rod", "M", read_length, "Rod of a shaper. Default: half of O3B."),
    ("rocker", "M", read_length, "Rocker. Default: 1."),
    ("line", "X,Y,DEG", read_line, "Line of the crank's pivot, from the rocker's."),
    ("beta", "DEG", read_number, "Angle between the chord B''B' and B''O."),
    ("coupler", "M", read_length, "Coupler BC. Default: the best one."),
    ("positions", "ROWS", read_rows, 'Three of B and BC: "x,y,angle; ...", or "xB,yB,xC,yC; ...".'),
    ("angles", "ROWS", read_rows, 'Three pairs of angles of the links on the frame: "a,b; ...".'),
)
"""Options of the kinds: name, metavar, reader, help."""


def synthesis_options(command: Callable[..., Any]) -> Callable[..., Any]:
    """Add the options of all kinds; the command gets their values by name."""
    for name, metavar, reader, told in reversed(_OPTIONS):
        param = f"of_{name}"
        option = click.option(f"--{name}", param, metavar=metavar, callback=reader, help=told)
        command = option(command)
    return command


@click.command(cls=LocalizedCommand)
@click.argument("kind")
@synthesis_options
@click.option("--json", "as_json", is_flag=True, help="Print lengths and checks as a JSON object.")
@click.option(
    "-o",
    "--out",
    type=PathType(),
    help="Problem file to write, *.toml; or a folder for it and the sheet.",
)
@click.option("--force", is_flag=True, help="Write over an existing problem file.")
@click.option("--sheet", "drawn", is_flag=True, help="Draw the construction, into the folder.")
@format_option("svg")
@drafting_options
@dxf_text_option
@click.option("--dpi", type=click.IntRange(30, 600), default=100, show_default=True, help="Of PNG.")
@sheet_options
@guarded
def synthesize(
    kind: str,
    as_json: bool,
    out: Path | None,
    force: bool,
    drawn: bool,
    formats: tuple[str, ...],
    ruler: float | None,
    profile: str | None,
    dxf_text: Literal["text", "strokes"],
    dpi: int,
    request: PaperRequest,
    **options: Any,
) -> None:
    """Find the sizes of a mechanism by construction, and measure it (синтез механизма).

    KIND is slotted, slider-crank, crank-rocker, three-positions or three-angles; what each is made
    from: docs/synthesis.md. Lengths are metres, angles degrees.
    """
    from planmethod.note.wording import get_language
    from planmethod.problem import loads
    from planmethod.synthesis import KINDS, options_of, synthesize as find
    from planmethod.synthesis.drawing import Drawn, synthesis_record
    from planmethod.synthesis.verification import checks, problem_text

    reject_unknown("no kind of synthesis {!r}", kind, tuple(KINDS))
    given = {name: options[f"of_{name}"] for name, *_ in _OPTIONS}
    known = options_of(kind)
    strange = [
        f"--{name}" for name, value in given.items() if value is not None and name not in known
    ]
    if strange:
        taken = ", ".join(f"--{name}" for name in known)
        raise UsageError("{} takes {}, not {}.", kind, taken, ", ".join(strange))
    wanted = {name: given[name] for name in known}
    made = find(kind, wanted)
    language = get_language(request.lang or current_language())
    text = problem_text(made, _command(kind, wanted), language)
    try:
        settled = request.resolve()
        problem = settled.over(loads(text, name=out.stem if out else kind))
    except ProblemError as error:
        raise AssemblyError("Sizes were found that no problem file takes. {}", error) from error
    found = {**checks(made, problem), **made.facts}
    drawing = Drawn(made, drawn_by(profile, ruler))
    source = click.get_current_context().get_parameter_source("formats")
    drawn = drawn or source is not ParameterSource.DEFAULT
    # With --json the output is one object; file names go to the error stream.
    aside = contextlib.redirect_stdout(sys.stderr) if as_json else contextlib.nullcontext()
    is_file = out is not None and out.suffix == ".toml"
    with aside:
        if out is not None:
            if is_file:
                write_new(out, text, force=force)
            else:
                write_new(out / f"{kind}.toml", text, force=force, folder=out)
        if drawn:
            from planmethod.synthesis.sheet import synthesis_sheet

            folder = Path("out") if out is None else out.parent if is_file else out
            write_drawings(
                [synthesis_sheet(drawing, problem, wanted, found, fields=request.fields)],
                folder,
                f"{out.stem if out is not None and is_file else kind}-synthesis",
                formats,
                dpi=dpi,
                author=settled.author(problem),
                dxf_text=dxf_text,
            )
    if as_json:
        record = synthesis_record(drawing, wanted, found)
        click.echo(json_text(record))
    elif out is None and not drawn:
        from planmethod.note.document import Document
        from planmethod.note.writers.terminal import plain_document
        from planmethod.synthesis.text import synthesis_document

        whole = Document.of(synthesis_document(drawing, wanted, found, language))
        click.echo(plain_document(whole, language))
    if found.get("missed", 0.0) is None or not all(
        made.facts.get(k, True) for k in ("branch", "order")
    ):
        click.echo(
            translate("Warning: {}", language.synthesis.interrupted.format(name=kind)), err=True
        )
        finish(ExitCode.FINDINGS)


def _command(kind: str, options: Mapping[str, Any]) -> str:
    """Return the equivalent command line, as the source of the problem file."""
    parts = ["planmethod", "synthesize", kind]
    for name, value in options.items():
        if isinstance(value, tuple):
            rows = value if isinstance(value[0], tuple) else (value,)
            parts += [f"--{name}", "; ".join(",".join(f"{n:.12g}" for n in row) for row in rows)]
        elif value is not None:
            parts += [f"--{name}", f"{value:.12g}"]
    return shlex.join(parts)
