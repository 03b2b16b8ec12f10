"""Command ``convert``: files of other programs, read and written."""

from __future__ import annotations

from pathlib import Path

import click
from msgspec import Struct

from planmethod.commands.command import command
from planmethod.commands.output import write_new
from planmethod.languages import translate
from planmethod.options import (
    PathType,
    UsageError,
    argument,
    force_option,
    option,
    read_step,
    variant_option,
)

TARGETS = {".toml": "toml", ".json": "pylinkage", ".py": "python"}
"""What is written into a file, by the ending of its name."""


class ConvertOptions(Struct, frozen=True, kw_only=True):
    """Options of ``convert``."""

    source: str = argument(metavar="SOURCE")
    file: Path | None = argument(required=False, type=PathType(dir_okay=False))
    target: str | None = option(
        "--to",
        type=click.Choice([*TARGETS.values()]),
        help="Format to write. Default: by the ending of FILE, else toml.",
    )
    units: str | None = option(
        "--units",
        type=click.Choice(["m", "cm", "mm", "in"]),
        help="Unit of lengths of a file without one. Default: m for pylinkage, mm for Pyslvs.",
    )
    round_to: str | None = option(
        "--round",
        read=read_step,
        metavar="LENGTH",
        help="Round the sizes that follow from the coordinates: 1mm.",
    )
    variant: str | None = variant_option()
    force: bool = force_option()


@command(ConvertOptions)
def convert(options: ConvertOptions) -> None:
    """Convert a mechanism of another program, or write one for it.

    SOURCE is a file of Linkage (.linkage2), pylinkage (.json) or Pyslvs (.pyslvs, YAML or an
    expression), a share link of PMKS+, or a problem file (.toml). Without FILE the result is
    printed. What is not read is listed.
    """
    from planmethod.peers import load, loads, to_pylinkage, to_script
    from planmethod.peers.pmks import is_pmks
    from planmethod.scripting.mechanism import Mechanism

    source, path = options.source, Path(options.source)
    named = source
    target = options.target or TARGETS.get("" if options.file is None else options.file.suffix)
    if source.lower().endswith(".toml"):
        if options.units is not None:
            raise UsageError("a problem file has its own unit: omit --units")
        mechanism = Mechanism.from_file(path, variant=options.variant)
        remarks: tuple[str, ...] = ()
    else:
        if is_pmks(source):
            named = "PMKS+"
            imported = loads(source, units=options.units, source=named)
        else:
            imported = load(path, units=options.units)
        mechanism, remarks = imported.mechanism, imported.remarks
    if options.round_to is not None:
        mechanism.set("drawn.round", options.round_to)
    for remark in remarks:
        click.echo(translate("Note: {}: {}", named, remark), err=True)
    text = {
        "pylinkage": lambda: to_pylinkage(mechanism.problem),
        "python": lambda: to_script(mechanism),
    }.get(target or "toml", mechanism.to_toml)()
    if options.file is None:
        click.echo(text, nl=False)
    else:
        write_new(options.file, text, force=options.force)
    mechanism.problem  # noqa: B018 - its faults are reported, the file is there to correct
