"""Command ``sketch``: the scheme of a problem file at once, finished or not."""

from __future__ import annotations

from pathlib import Path

from msgspec import Struct, field

from planmethod.commands.command import command
from planmethod.commands.output import show, write_drawings
from planmethod.commands.problems import fail, finish, language_of_file, names_of, variants_of
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.options import (
    ProblemChoice,
    UsageError,
    format_option,
    open_option,
    out_option,
    problem_lang_option,
    watch_option,
)

PAGE = (
    '<!DOCTYPE html><meta charset="utf-8"><meta http-equiv="refresh" content="1">'
    '<img src="{picture}" alt="" style="width:100%">\n'
)
"""Page that shows a picture which is redrawn again and again."""


class SketchOptions(Struct, frozen=True, kw_only=True):
    """Options of ``sketch``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    out: Path = out_option()
    formats: tuple[str, ...] = format_option("svg")
    lang: str | None = problem_lang_option()
    shown: bool = open_option()
    watch: bool = watch_option()


@command(SketchOptions)
def sketch(options: SketchOptions) -> None:
    """Draw only the scheme, also of an unfinished file.

    The scheme is to scale, with the loads; missing parts are marked.
    """
    if options.choice.round_to is not None:
        raise UsageError("a sketch shows the figure as it is: omit --round")
    codes: list[ExitCode] = []
    for path in options.choice.problems:
        try:
            variants = variants_of(path, options.choice)
            for name in variants:
                error = _draw(path, name, options)
                if error is not None:
                    codes.append(error.exit_code)
                    is_one = len(options.choice.problems) + len(variants) == 2
                    fail(error, () if is_one else names_of(path, path.stem, name))
                if options.shown:
                    _show(options.out / f"{_basename(path, name)}.{options.formats[0]}")
        except PlanMethodError as error:
            codes.append(error.exit_code)
            fail(error)
    finish(codes[0] if codes else ExitCode.DONE)


def _basename(path: Path, variant: str | None) -> str:
    return f"{path.stem}-sketch" if variant is None else f"{path.stem}-{variant}-sketch"


def _draw(path: Path, variant: str | None, options: SketchOptions) -> PlanMethodError | None:
    """Draw the sketch of a file; return the faults of the file."""
    from planmethod.kinds import kind_of
    from planmethod.note.wording import get_language
    from planmethod.render.sketch import VIEWS, sketch as drawn

    title, part = kind_of(path).part(path, variant=variant, views=VIEWS)
    language = get_language(language_of_file(path, options.lang))
    said = [str(fault) for fault in part.faults] or ([str(part.error)] if part.error else [])
    if part.solution is not None:
        from planmethod.problem.plausibility import unlikely

        said += unlikely(part.solution.problem)
    drawing = drawn(part, title, language, said)
    write_drawings([drawing], options.out, _basename(path, variant), options.formats)
    return part.error


def _show(picture: Path) -> None:
    """Open a page that reloads a picture every second, as ``--watch`` redraws it."""
    from planmethod.render.backends.output import write

    page = picture.with_suffix(".html")
    write(page, PAGE.format(picture=picture.name).encode(), output_root=page.parent)
    show(page)
