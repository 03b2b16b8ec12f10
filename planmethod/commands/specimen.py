"""Command ``specimen``: sheets that show the symbols, the lines, the letters (листы образцов)."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import write_drawings
from planmethod.commands.sheet_options import lettering_option, stamp_option
from planmethod.languages import translate
from planmethod.options import (
    BadParameter,
    FileOptions,
    argument,
    format_option,
    lang_option,
    out_option,
)


def read_specimens(value: tuple[str, ...]) -> tuple[str, ...]:
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


class SpecimenOptions(Struct, frozen=True, kw_only=True):
    """Options of ``specimen``."""

    sheets: tuple[str, ...] = argument(nargs=-1, metavar="[SHEET]...", read=read_specimens)
    out: Path = out_option()
    formats: tuple[str, ...] = format_option("svg,pdf")
    fields: Mapping[str, str] = stamp_option()
    lettering: str | None = lettering_option()
    lang: str = lang_option()
    files: FileOptions = field(default_factory=FileOptions)


@command(SpecimenOptions)
def specimen(options: SpecimenOptions) -> None:
    """Draw the specimen sheets: every symbol, every line, at working size (листы образцов).

    SHEET is symbols, lines or lettering; all of them when none is given. The files are
    specimen-symbols.svg and so on. More: docs/reference/specimens.md.
    """
    from planmethod.note.wording import get_language
    from planmethod.render.ink.lettering import lettering as lettered, using
    from planmethod.render.sheets.specimen import SPECIMENS

    language = get_language(options.lang)
    for name in options.sheets:
        with using(lettered(options.lettering or "B")):
            drawing = SPECIMENS[name](options.fields, language)
        write_drawings(
            [drawing],
            options.out,
            f"specimen-{name}",
            options.formats,
            author=options.fields.get("author"),
            file_options=options.files,
        )
