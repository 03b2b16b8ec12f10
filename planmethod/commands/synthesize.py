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
from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import json_text, reject_unknown, write_drawings, write_new
from planmethod.commands.problems import finish
from planmethod.commands.sheet_options import PaperRequest
from planmethod.errors import AssemblyError, ExitCode, ProblemError
from planmethod.languages import current_language, translate
from planmethod.options import (
    BadParameter,
    DraftingOptions,
    FileOptions,
    PathType,
    UsageError,
    argument,
    dpi_option,
    dxf_text_option,
    force_option,
    format_option,
    json_option,
    option,
)

LEAST, MOST = 1e-6, 1e4
"""Range of accepted lengths, m."""


def read_number(text: str) -> float:
    """Return a number of an option; a decimal comma would be ambiguous with a separator."""
    from planmethod.problem.formula import read_decimal

    number = read_decimal(text)
    if number is None:
        raise BadParameter("{!r} is not a number", text.strip())
    if not abs(number) < 1e9:
        raise BadParameter("{!r} is out of range: below 1e9 is expected", text.strip())
    return float(number)


def read_length(value: str) -> float:
    """Return a positive length, m."""
    number = read_number(value)
    if not LEAST <= number <= MOST:
        raise BadParameter("{:g} m: a length from {:g} to {:g} m is expected", number, LEAST, MOST)
    return number


def read_offset(value: str) -> float:
    """Return a length of either sign, m; 0 is none."""
    number = read_number(value)
    if number:
        read_length(str(abs(number)))
    return number


def read_rows(value: str) -> tuple[tuple[float, ...], ...]:
    """Return rows of numbers: ``x,y,angle; x,y,angle``."""
    rows = [row for row in value.split(";") if row.strip()]
    return tuple(tuple(read_number(number) for number in row.split(",")) for row in rows)


def read_line(value: str) -> tuple[float, ...]:
    """Return a line: x and y of a point, m, and its direction, degrees."""
    rows = read_rows(value)
    if len(rows) != 1 or len(rows[0]) != 3:
        raise BadParameter("{!r} is not x,y,angle", value)
    return rows[0]


def _size(name: str, metavar: str, read: Callable[[str], Any], help_text: str) -> Any:
    """Declare what a kind of synthesis may be made from."""
    return option(f"--{name}", read=read, metavar=metavar, help=help_text)


class SynthesisData(Struct, frozen=True, kw_only=True):
    """What mechanisms of all kinds are made from (исходные данные синтеза), SI and degrees."""

    K_v: float | None = _size(
        "K_v",
        "NUMBER",
        read_number,
        "Ratio of the slow stroke's time to the quick stroke's, at least 1.",
    )
    centres: float | None = _size("centres", "M", read_length, "Distance between the fixed pivots.")
    stroke: float | None = _size("stroke", "M", read_length, "Stroke of the slider.")
    swing: float | None = _size(
        "swing", "DEG", read_number, "Swing of the slotted link or the rocker."
    )
    lambda_: float | None = _size(
        "lambda", "NUMBER", read_number, "Ratio of crank to connecting rod, r/l."
    )
    offset: float | None = _size(
        "offset",
        "M",
        read_offset,
        "Offset of the guide from the crank's pivot, upwards positive.",
    )
    pressure: float | None = _size(
        "pressure", "DEG", read_number, "Largest pressure angle of the slider."
    )
    rod: float | None = _size(
        "rod", "M", read_length, "Connecting rod of a shaper. Default: half of O3B."
    )
    rocker: float | None = _size("rocker", "M", read_length, "Length of the rocker. Default: 1.")
    line: tuple[float, ...] | None = _size(
        "line", "X,Y,DEG", read_line, "Line on which the crank's pivot is, from the rocker's pivot."
    )
    beta: float | None = _size(
        "beta", "DEG", read_number, "Angle between the chord B''B' and B''O."
    )
    coupler: float | None = _size(
        "coupler", "M", read_length, "Length of the coupler BC. Default: the best one."
    )
    positions: tuple[tuple[float, ...], ...] | None = _size(
        "positions",
        "ROWS",
        read_rows,
        'Three positions of B and BC: "x,y,angle; ...", or "xB,yB,xC,yC; ...".',
    )
    angles: tuple[tuple[float, ...], ...] | None = _size(
        "angles",
        "ROWS",
        read_rows,
        'Three pairs of angles of the links joined to the frame: "a,b; ...".',
    )

    def of(self, kind: str) -> dict[str, Any]:
        """Return the data of a kind by the names of their options.

        Raises
        ------
        click.UsageError
            Data are given that the kind does not take.
        """
        from planmethod.synthesis import options_of

        given = {name.removesuffix("_"): getattr(self, name) for name in self.__struct_fields__}
        known = options_of(kind)
        strange = [
            f"--{name}" for name, value in given.items() if value is not None and name not in known
        ]
        if strange:
            taken = ", ".join(f"--{name}" for name in known)
            raise UsageError("{} accepts {}, not {}.", kind, taken, ", ".join(strange))
        return {name: given[name] for name in known}


class SynthesizeOptions(Struct, frozen=True, kw_only=True):
    """Options of ``synthesize``."""

    kind: str = argument()
    data: SynthesisData = field(default_factory=SynthesisData)
    as_json: bool = json_option("Print lengths and checks as a JSON object.")
    out: Path | None = option(
        "-o",
        "--out",
        type=PathType(),
        help="Problem file to write, *.toml, or a folder for it and the sheet.",
    )
    force: bool = force_option("Overwrite an existing problem file.")
    drawn: bool = option("--sheet", is_flag=True, help="Draw the construction into the folder.")
    formats: tuple[str, ...] = format_option("svg")
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    dxf_text: Literal["text", "strokes"] = dxf_text_option()
    dpi: int = dpi_option()
    paper: PaperRequest = field(default_factory=PaperRequest)


@command(
    SynthesizeOptions,
    findings="The mechanism found does not pass through the positions in order without reassembly.",
)
def synthesize(options: SynthesizeOptions) -> None:
    """Find the dimensions of a mechanism by construction, and verify them (синтез механизма).

    KIND is slotted, slider-crank, crank-rocker, three-positions or three-angles. The given data of
    each kind: docs/how-to/synthesis.md. Lengths are in metres, angles in degrees.
    """
    from planmethod.note.synthesis.drawing import Drawn, synthesis_record
    from planmethod.note.synthesis.verification import checks, problem_text
    from planmethod.note.wording import get_language
    from planmethod.problem import loads
    from planmethod.synthesis import KINDS, synthesize as find

    kind, out, as_json = options.kind, options.out, options.as_json
    reject_unknown("no kind of synthesis {!r}", kind, tuple(KINDS))
    wanted = options.data.of(kind)
    made = find(kind, wanted)
    language = get_language(options.paper.lang or current_language())
    text = problem_text(made, _command(kind, wanted), language)
    try:
        settled = options.paper.resolve()
        problem = settled.over(loads(text, name=out.stem if out else kind))
    except ProblemError as error:
        raise AssemblyError(
            "The dimensions found are not valid in a problem file. {}", error
        ) from error
    found = {**checks(made, problem), **made.facts}
    drawing = Drawn(made, options.drafting.named_profile)
    source = click.get_current_context().get_parameter_source("formats")
    drawn = options.drawn or source is not ParameterSource.DEFAULT
    # With --json the output is one object; file names go to the error stream.
    aside = contextlib.redirect_stdout(sys.stderr) if as_json else contextlib.nullcontext()
    is_file = out is not None and out.suffix == ".toml"
    with aside:
        if out is not None:
            if is_file:
                write_new(out, text, force=options.force)
            else:
                write_new(out / f"{kind}.toml", text, force=options.force, folder=out)
        if drawn:
            from planmethod.render.sheets.synthesis import synthesis_sheet

            folder = Path("out") if out is None else out.parent if is_file else out
            write_drawings(
                [synthesis_sheet(drawing, problem, found, fields=settled.fields)],
                folder,
                f"{out.stem if out is not None and is_file else kind}-synthesis",
                options.formats,
                author=settled.author(problem),
                file_options=FileOptions(dpi=options.dpi, dxf_text=options.dxf_text),
            )
    if as_json:
        record = {"schema": 1, **synthesis_record(drawing, found)}
        click.echo(json_text(record))
    elif out is None and not drawn:
        from planmethod.note.document import Document
        from planmethod.note.synthesis.account import synthesis_document
        from planmethod.note.writers.terminal import plain_document

        whole = Document.of(synthesis_document(drawing, found, language))
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
