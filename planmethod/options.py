"""Options of the commands, their names and values, and how commands name problems and warn."""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias, TypeVar

import click
from msgspec.structs import replace

from planmethod.languages import (
    LANGUAGES,
    current_language,
    look_up_translation,
    named_language,
    translate,
)

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from planmethod.construct.drafting import Profile
    from planmethod.problem.records import KindProblem


class UsageError(click.UsageError):
    """A command that is called wrongly: a sentence, and its facts."""

    def __init__(self, message: str, *facts: object) -> None:
        super().__init__(translate(message, *facts))


class BadParameter(click.BadParameter):
    """A value that an option does not take: a sentence, and its facts."""

    def __init__(self, message: str, *facts: object) -> None:
        super().__init__(translate(message, *facts))


def basename(problem: KindProblem) -> str:
    """Return the base name of the files of a problem."""
    return problem.name if problem.variant is None else f"{problem.name}-{problem.variant}"


def message_name(problem: KindProblem) -> str:
    """Return the name of a problem in messages: its file, or the file's name with the variant."""
    return problem.source_file if problem.variant is None else basename(problem)


def warn(problem: KindProblem, message: object) -> None:
    """Print a warning about a problem's results: a sentence, or a record of one."""
    click.echo(translate("Warning: {}: {}", message_name(problem), message), err=True)


def warn_each(problem: KindProblem, messages: Iterable[object]) -> None:
    """Print warnings about a problem's results as they are found."""
    for message in messages:
        warn(problem, message)


class PathType(click.Path):
    """A path (путь к файлу или папке), named in the current language when it is shown.

    Click names it once, when a command is imported.
    """

    def __init__(
        self, *, file_okay: bool = True, dir_okay: bool = True, readable: bool = True
    ) -> None:
        super().__init__(path_type=Path, file_okay=file_okay, dir_okay=dir_okay, readable=readable)

    @property
    def name(self) -> str:
        """Name of the type: a file, a directory or a path."""
        return look_up_translation(self._english)

    @name.setter
    def name(self, english: str) -> None:
        self._english = english


class NumberRange(click.FloatRange):
    """Numbers between bounds (число в границах); NaN, which passes every range, is none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return a number of the command line."""
        from planmethod.problem.formula import read_decimal

        if isinstance(value, str) and read_decimal(value) is None:
            raise BadParameter("{!r} is not a number", value)
        return super().convert(value, param, ctx)


F = TypeVar("F", bound=Callable[..., Any])

Positions: TypeAlias = "npt.NDArray[np.float64]"
"""Driver positions, ndarray of shape (n,): degrees, or metres of a slider."""

MAX_POSITIONS = 1_000_000
"""Most positions that ``--phi`` may ask for."""

MAX_SWEPT_POSITIONS = 10_000_000
"""The same where they are swept, not drawn: ``--npz`` and ``--ask``."""

MAX_SHOWN_ROWS = 10_000
"""Rows of a table on the terminal."""

COUNTED = 72
"""Number of positions up to which a missing last one would be noticed."""


def read_positions(
    ctx: click.Context, param: click.Parameter, value: str | None, *, limit: int = MAX_POSITIONS
) -> Positions | None:
    """Return driver positions: ``20``, ``0,30,60``, or ``from:to:step`` without the end."""
    if value is None:
        return None
    import numpy as np

    from planmethod.problem.formula import read_decimal

    parts: list[Positions] = []
    count = 0
    for part in value.split(","):
        read = [read_decimal(number) for number in part.split(":")]
        numbers = [float(number) for number in read if number is not None]
        if len(numbers) != len(read):
            raise BadParameter("{!r} is neither a number nor from:to:step", part)
        parts.append(_expanded(numbers, part, limit))
        count += len(parts[-1])
        if count > limit:
            raise BadParameter("more than {} positions", limit)
    return np.concatenate(parts)


def _expanded(numbers: list[float], part: str, limit: int) -> Positions:
    """Return the positions of one part of ``--phi``."""
    import numpy as np

    if not all(abs(number) < 1e9 for number in numbers):
        raise BadParameter("{!r} is out of range: below 1e9 is expected", part)
    if len(numbers) == 1:
        return np.array(numbers)
    if len(numbers) != 3 or numbers[2] == 0:
        raise BadParameter("{!r} is not from:to:step with a step that is not 0", part)
    start, stop, step = numbers
    count = (stop - start) / step
    if count <= 0 or count > limit:
        raise BadParameter("{!r} gives {} positions", part, max(0, round(count)))
    near = max(1, round(count))
    is_met = abs(count - near) < 1e-9 * max(1.0, count)
    whole = near if is_met else int(count) + 1
    if is_met and whole <= COUNTED and (stop - start) % 360:
        phrase = "Note: --phi {0} is {1} position{1:||s} without {2:g}; {3:g}:{4:g}:{5:g} has it."
        click.echo(translate(phrase, part, whole, stop, start, stop + step, step), err=True)
    return np.asarray(start + step * np.arange(whole), dtype=float)


def read_labels(
    ctx: click.Context, param: click.Parameter, value: str | None
) -> tuple[str, ...] | None:
    """Return the labels of results of a comma-separated list."""
    if value is None:
        return None
    labels = tuple(dict.fromkeys(label.strip() for label in value.split(",") if label.strip()))
    if not labels:
        raise BadParameter("no result is named; v_E,omega_3 is expected")
    return labels


def read_formats(
    ctx: click.Context, param: click.Parameter, value: Sequence[str]
) -> tuple[str, ...]:
    """Return the output formats of comma-separated lists, checked."""
    from planmethod.render.backends import BACKENDS, DXF_NEEDS, is_absent

    names = tuple(dict.fromkeys(n.strip().lower() for n in ",".join(value).split(",") if n.strip()))
    for name in names:
        if name not in BACKENDS:
            raise BadParameter("{!r} is not one of {}", name, ", ".join(BACKENDS))
        if is_absent(name):
            raise click.UsageError(DXF_NEEDS, ctx)
    if not names:
        raise BadParameter("no format given; choose from {}", ", ".join(BACKENDS))
    return names


def problem_options(command: F) -> F:
    """Add the options that choose the problems."""
    for option in (
        click.argument(
            "problems",
            nargs=-1,
            required=True,
            metavar="PROBLEM...",
            type=PathType(readable=False),
        ),
        click.option("--variant", metavar="NAME", help="Variant of the problem file."),
        click.option("--all-variants", is_flag=True, help="Every variant of the problem file."),
    ):
        command = option(command)
    return command


def _ruler_option(**more: Any) -> Callable[[F], F]:
    return click.option(
        "--ruler",
        type=NumberRange(min=0.0, min_open=True, max=50.0),
        **more,
    )


def ruler_option(command: F) -> F:
    """Add the ruler of the hand."""
    return _ruler_option(
        default=0.5, show_default=True, help="Ruler step with which the plans are read, mm."
    )(command)


def drafting_options(command: F) -> F:
    """Add the ruler and the profile of the hand; `drawn_by` makes one of them."""
    command = click.option(
        "--profile",
        type=click.Choice(["cad", "board", "coarse"]),
        show_default="board",
        help="Accuracy of the drawn plans: with CAD, on a board, rough.",
    )(command)
    return _ruler_option(
        metavar="MM",
        help="Ruler step with which the plans are read; that of the profile (board: 0.5 mm).",
    )(command)


def drawn_by(profile: str | None, ruler: float | None, *, usual: str = "board") -> Profile:
    """Return the drafting profile by its name, or the default one, with a ruler if given."""
    from planmethod.construct.drafting import PROFILES

    hand = PROFILES[profile or usual]
    return hand if ruler is None else replace(hand, ruler=ruler)


def positions_option(limit: int) -> Callable[[F], F]:
    """Add the option of the driver positions, at most ``limit``."""
    return click.option(
        "--phi",
        callback=functools.partial(read_positions, limit=limit),
        metavar="POSITIONS",
        help="Other driver positions, degrees (m for a slider): 20 or 0,30,60 or 0:360:30 "
        "(without its end).",
    )


def reading_options(command: F) -> F:
    """Add the options of the positions and of the reading of the plans."""
    return positions_option(MAX_POSITIONS)(drafting_options(command))


def jobs_option(command: F) -> F:
    """Add the number of processes."""
    return click.option(
        "--jobs",
        type=click.IntRange(1, 64),
        default=1,
        show_default=True,
        help="Processes at work.",
    )(command)


def out_option(command: F) -> F:
    """Add the folder that files are written into."""
    return click.option(
        "-o",
        "--out",
        type=PathType(file_okay=False),
        default=Path("out"),
        show_default=True,
        help="Folder for the files.",
    )(command)


def open_option(command: F) -> F:
    """Add the option that opens the written files."""
    return click.option(
        "--open", "shown", is_flag=True, help="Open the written files in the system's viewer."
    )(command)


def position_option(command: F) -> F:
    """Add the number of the calculated position."""
    return click.option(
        "--position",
        type=click.IntRange(min=0),
        metavar="NUMBER",
        help="Calculated position, from 0: drawn bold, loaded; else that of [project], that of "
        "phi or the clearest one.",
    )(command)


def layout_option(command: F) -> F:
    """Add the option of the sheets' contents and layout."""
    return click.option(
        "--layout",
        metavar="NAME|FILE",
        help="What is on the sheets: a name of planmethod layouts, or a file of your own.",
    )(command)


def format_option(default: str) -> Callable[[F], F]:
    """Add the output formats."""

    def add(command: F) -> F:
        return click.option(
            "--format",
            "formats",
            callback=read_formats,
            multiple=True,
            default=[default],
            show_default=True,
            help="svg,pdf,png,dxf.",
        )(command)

    return add


def drawing_options(command: F) -> F:
    """Add the options of the shown drafting errors and of the formats."""
    for option in (
        dxf_text_option,
        click.option(
            "--dpi", type=click.IntRange(30, 600), default=100, show_default=True, help="Of PNG."
        ),
        click.option(
            "--sigma/--no-sigma",
            default=None,
            help="Show the drafting errors in the table of results.",
        ),
        click.option(
            "--all-positions",
            is_flag=True,
            help="Draw any number of sheets. Default: at most six for a file.",
        ),
        click.option(
            "--errors", is_flag=True, help="Draw the error ellipses of the drafting, 2 sigma."
        ),
    ):
        command = option(command)
    return command


def dxf_text_option(command: F) -> F:
    """Add the kind of letters in a DXF."""
    return click.option(
        "--dxf-text",
        type=click.Choice(["text", "strokes"]),
        default="strokes",
        show_default=True,
        help="Letters of DXF: strokes that look the same everywhere, or text.",
    )(command)


def _lang_option(read: Callable[[str | None], str | None]) -> Callable[[F], F]:
    return click.option(
        "--lang",
        type=click.Choice(LANGUAGES),
        callback=lambda ctx, param, value: read(value),
        help="Language of output and messages. Default: the language of the system.",
    )


def lang_option(command: F) -> F:
    """Add the language of texts that are of no problem; the command gets the one to write in."""
    return _lang_option(lambda named: named or current_language())(command)


def problem_lang_option(command: F) -> F:
    """Add the language of texts of a problem; the command gets the one that the user names.

    Default: None; then the commands use the file's, by `language_of`.
    """
    return _lang_option(named_language)(command)
