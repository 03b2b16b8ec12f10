"""Command ``specimen``: sheets that show the symbols, the lines, the letters (листы образцов)."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

import click

from planmethod.commands.output import LocalizedCommand, write_drawings
from planmethod.commands.problems import guarded
from planmethod.commands.sheet_options import lettering_option, stamp_option
from planmethod.languages import translate
from planmethod.options import BadParameter, dxf_text_option, format_option, lang_option, out_option


def read_specimens(
    ctx: click.Context, param: click.Parameter, value: tuple[str, ...]
) -> tuple[str, ...]:
    """Return the names of the requested specimen sheets. Default: all of them."""
    from planmethod.render.sheets.specimen import SPECIMENS

    names = tuple(dict.fromkeys(name.strip().lower() for name in value))
    for name in names:
        if name not in SPECIMENS:
            from difflib import get_close_matches

            near = get_close_matches(name, SPECIMENS, 1)
            hint = translate("; did you mean {!r}?", near[0]) if near else "."
            raise BadParameter(
                "no specimen sheet {!r}{} Known: {}.", name, hint, ", ".join(SPECIMENS)
            )
    return names or tuple(SPECIMENS)


@click.command(cls=LocalizedCommand)
@click.argument("sheets", nargs=-1, metavar="[SHEET]...", callback=read_specimens)
@out_option
@format_option("svg,pdf")
@stamp_option
@lettering_option
@lang_option
@click.option("--dpi", type=click.IntRange(30, 600), default=100, show_default=True, help="Of PNG.")
@dxf_text_option
@guarded
def specimen(
    sheets: tuple[str, ...],
    out: Path,
    formats: tuple[str, ...],
    title_block_fields: dict[str, str],
    lettering: str | None,
    lang: str,
    dpi: int,
    dxf_text: Literal["text", "strokes"],
) -> None:
    """Draw the specimen sheets: every symbol, every line, at working size (листы образцов).

    SHEET is symbols, lines or lettering; all of them when none is given. The files are
    specimen-symbols.svg and so on. What is on them: docs/symbols.md, docs/lettering.md.
    """
    from planmethod.note.wording import get_language
    from planmethod.render.ink.lettering import lettering as lettered, using
    from planmethod.render.sheets.specimen import SPECIMENS

    language = get_language(lang)
    for name in sheets:
        with using(lettered(lettering or "B")):
            drawing = SPECIMENS[name](title_block_fields, language)
        write_drawings(
            [drawing],
            out,
            f"specimen-{name}",
            formats,
            dpi=dpi,
            author=title_block_fields.get("author"),
            dxf_text=dxf_text,
        )
