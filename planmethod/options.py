"""Options of the commands, their names and values, and how commands name problems and warn."""

# Cyrillic letters: an example of a name

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, TypeVar

import click
from msgspec import Struct, field
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


R = TypeVar("R", bound=Struct)


# Options as fields of records --------------------------------------------------------------------


class DeclaredOption(Struct, frozen=True):
    """How a field of a record is given on the command line: the default factory of the field.

    Attributes
    ----------
    kind : type
        `click.Option` or `click.Argument`.
    flags : tuple of str
        How it is written.
    settings : mapping
        Other attributes of the parameter of click.
    read : callable, optional
        Turns what was written into the value of the field.
    linkages_only : bool
        Whether only linkages have it.
    """

    kind: type[click.Parameter]
    flags: tuple[str, ...]
    settings: Mapping[str, Any]
    read: Callable[[Any], Any] | None = None
    linkages_only: bool = False

    def __call__(self) -> Any:
        """Return the value of the field where the option is not given."""
        settings = self.settings
        several = settings.get("multiple") or settings.get("nargs") == -1
        value = settings.get("default", () if several else False if self.is_flag else None)
        return self._read(value() if callable(value) else value)

    @property
    def is_flag(self) -> bool:
        """Whether it has no value."""
        return bool(self.settings.get("is_flag"))

    @property
    def name(self) -> str:
        """The long one of its flags; of a switch the one that turns it on."""
        return max(self.flags, key=len).partition("/")[0]

    def parameter(self, name: str) -> click.Parameter:
        """Return what click reads it with."""
        settings = dict(self.settings)
        if self.read is not None:
            settings["callback"] = lambda context, parameter, text: self._read(text)
        return self.kind([*self.flags, name], **settings)

    def _read(self, text: Any) -> Any:
        return text if self.read is None or text is None else self.read(text)


def option(
    *flags: str,
    read: Callable[[Any], Any] | None = None,
    linkages_only: bool = False,
    **settings: Any,
) -> Any:
    """Declare a field of a record as an option; ``settings`` are those of `click.Option`."""
    declared = DeclaredOption(click.Option, flags, settings, read, linkages_only)
    return field(default_factory=declared)


def argument(*, read: Callable[[Any], Any] | None = None, **settings: Any) -> Any:
    """Declare a field of a record as an argument."""
    return field(default_factory=DeclaredOption(click.Argument, (), settings, read))


def find_declared_options(
    record: type[Struct],
) -> Iterator[tuple[str, DeclaredOption | type[Struct]]]:
    """Yield the fields of a record that are options, and those that are records of options."""
    names, defaults = record.__struct_fields__, record.__struct_defaults__
    for name, default in zip(names[len(names) - len(defaults) :], defaults, strict=True):
        made = getattr(default, "factory", None)
        if isinstance(made, DeclaredOption) or (
            isinstance(made, type) and issubclass(made, Struct)
        ):
            yield name, made


def make_parameters(record: type[Struct]) -> Iterator[click.Parameter]:
    """Yield the parameters of a command that takes a record, in the order of its fields."""
    for name, made in find_declared_options(record):
        if isinstance(made, DeclaredOption):
            yield made.parameter(name)
        else:
            yield from make_parameters(made)


def fill_record(record: type[R], values: Mapping[str, Any]) -> R:
    """Return a record, with the records in it, of the values of its options by name."""
    return record(
        **{
            name: values[name] if isinstance(made, DeclaredOption) else fill_record(made, values)
            for name, made in find_declared_options(record)
        }
    )


def find_linkage_options(record: Struct) -> Iterator[str]:
    """Yield the options that are given and only linkages have, as they are written."""
    for name, made in find_declared_options(type(record)):
        value = getattr(record, name)
        if not isinstance(made, DeclaredOption):
            yield from find_linkage_options(value)
        elif made.linkages_only and value is not None and value is not False:
            yield made.name


# Values ------------------------------------------------------------------------------------------


Positions: TypeAlias = "npt.NDArray[np.float64]"
"""Driver positions, ndarray of shape (n,): degrees, or metres of a slider; of several driving
links that are listed of each, shape (m, n)."""

MAX_POSITIONS = 1_000_000
"""Most positions that ``--phi`` may ask for."""

MAX_SWEPT_POSITIONS = 10_000_000
"""The same where they are swept, not drawn: ``--npz`` and ``--ask``."""

MAX_SHOWN_ROWS = 10_000
"""Rows of a table on the terminal."""

COUNTED = 72
"""Number of positions up to which a missing last one would be noticed."""


def read_positions(value: str, *, limit: int = MAX_POSITIONS) -> Positions:
    """Return driver positions: ``20``, ``0,30,60``, or ``from:to:step`` without the end.

    Lists of several driving links, in their order, have a stroke between: ``70,80/40,10``.
    """
    import numpy as np

    listed = [_read_list(own, limit) for own in value.split("/")]
    if len(listed) == 1:
        return listed[0]
    counts = [len(own) for own in listed]
    if len(set(counts)) > 1:
        numbers = ", ".join(map(str, counts))
        raise BadParameter(
            "the lists of the driving links have {} positions: give as many", numbers
        )
    return np.array(listed)


def _read_list(value: str, limit: int) -> Positions:
    """Return the positions of one driving link."""
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


def read_labels(value: str) -> tuple[str, ...]:
    """Return the labels of results of a comma-separated list."""
    labels = tuple(dict.fromkeys(label.strip() for label in value.split(",") if label.strip()))
    if not labels:
        raise BadParameter("no result is named; expected for instance v_E,omega_3")
    return labels


def read_names(value: str, known: Sequence[str], empty_message: str) -> tuple[str, ...]:
    """Return the names of a comma-separated list, each one of the known."""
    names = tuple(dict.fromkeys(n.strip().lower() for n in value.split(",") if n.strip()))
    for name in names:
        if name not in known:
            raise BadParameter("{!r} is not one of {}", name, ", ".join(known))
    if not names:
        raise BadParameter(empty_message, ", ".join(known))
    return names


NO_FORMAT = "no format given; choose from {}"


def read_formats(value: Sequence[str]) -> tuple[str, ...]:
    """Return the output formats of comma-separated lists, checked."""
    from planmethod.render.backends import BACKENDS, DXF_NEEDS, is_absent

    names = read_names(",".join(value), BACKENDS, NO_FORMAT)
    for name in names:
        if is_absent(name):
            raise click.UsageError(DXF_NEEDS)
    return names


# Options of several commands ---------------------------------------------------------------------


def read_step(value: str) -> str:
    """Return a step of rounding, ``1mm``, as a file has it."""
    from planmethod.problem.faults import Faults
    from planmethod.problem.file_node import FileNode

    if FileNode(Faults(), value).attempt(FileNode.length) is None:
        raise BadParameter("{!r} is not a length such as 1mm", value)
    return value


class ProblemChoice(Struct, frozen=True, kw_only=True):
    """Problems that a command acts on."""

    all_variants: bool = option(
        "--all-variants", is_flag=True, help="All variants of the problem file."
    )
    variant: str | None = option("--variant", metavar="NAME", help="Variant of the problem file.")
    round_to: str | None = option(
        "--round",
        read=read_step,
        metavar="LENGTH",
        help="Round the sizes that follow from the coordinates in [drawn], and print the changes: "
        "1mm.",
    )
    problems: tuple[Path, ...] = argument(
        nargs=-1, required=True, metavar="PROBLEM...", type=PathType(readable=False)
    )


def problem_argument() -> Any:
    """Declare the only problem file."""
    return argument(metavar="PROBLEM", type=click.Path(path_type=Path, readable=False))


def variant_option(help_text: str = "Variant of the problem file.") -> Any:
    """Declare the variant of a file."""
    return option("--variant", metavar="NAME", help=help_text)


def positions_option(limit: int = MAX_POSITIONS) -> Any:
    """Declare the driver positions, at most ``limit``."""
    return option(
        "--phi",
        read=partial(read_positions, limit=limit),
        linkages_only=True,
        metavar="POSITIONS",
        help="Other positions of the driving link, degrees (m for a slider): 20 or 0,30,60 "
        "or 0:360:30 (end excluded). With several driving links: 70,80/40,10.",
    )


def position_option(
    help_text: str = "Calculated position, from 0: drawn bold and loaded. Default: that of "
    "[project], that of phi, or the clearest one.",
) -> Any:
    """Declare the number of the calculated position."""
    return option(
        "--position",
        linkages_only=True,
        type=click.IntRange(min=0),
        metavar="NUMBER",
        help=help_text,
    )


def ruler_option(**settings: Any) -> Any:
    """Declare the ruler of the hand."""
    return option("--ruler", type=NumberRange(min=0.0, min_open=True, max=50.0), **settings)


def drawn_by(profile: str | None, ruler: float | None, *, usual: str = "board") -> Profile:
    """Return the drafting profile by its name, or the default one, with a ruler if given."""
    from planmethod.construct.drafting import PROFILES

    hand = PROFILES[profile or usual]
    return hand if ruler is None else replace(hand, ruler=ruler)


class DraftingOptions(Struct, frozen=True, kw_only=True):
    """The hand that draws the plans: its ruler and its profile."""

    ruler: float | None = ruler_option(
        metavar="MM",
        help="Ruler graduation for reading the plans. Default: that of the profile "
        "(board: 0.5 mm).",
    )
    profile: str | None = option(
        "--profile",
        type=click.Choice(["cad", "board", "coarse"]),
        show_default="board",
        help="Accuracy of the drawn plans: in CAD, on a board, rough.",
    )

    @property
    def named_profile(self) -> Profile:
        """The drafting profile, with the ruler if one is given."""
        return drawn_by(self.profile, self.ruler)


def layout_option() -> Any:
    """Declare the sheets' contents and layout."""
    return option(
        "--layout",
        linkages_only=True,
        metavar="NAME|FILE",
        help="Layout of the sheets: a name from planmethod layouts, or your own file.",
    )


class DrawingOptions(Struct, frozen=True, kw_only=True):
    """Drafting errors that are shown on the sheets, and how many sheets may be drawn."""

    errors: bool = option(
        "--errors",
        linkages_only=True,
        is_flag=True,
        help="Draw the error ellipses of the drafting, 2 sigma.",
    )
    all_positions: bool = option(
        "--all-positions",
        is_flag=True,
        help="Draw any number of sheets. Default: at most six for a file.",
    )
    sigma: bool | None = option(
        "--sigma/--no-sigma",
        linkages_only=True,
        default=None,
        help="Show the drafting errors in the table of results.",
    )


def dpi_option() -> Any:
    """Declare the resolution of PNG."""
    return option(
        "--dpi",
        type=click.IntRange(30, 600),
        default=100,
        show_default=True,
        help="PNG resolution, dots per inch.",
    )


def dxf_text_option() -> Any:
    """Declare the kind of letters in a DXF."""
    return option(
        "--dxf-text",
        type=click.Choice(["text", "strokes"]),
        default="text",
        show_default=True,
        help="Letters in DXF: text, or strokes, which need no font.",
    )


class FileOptions(Struct, frozen=True, kw_only=True):
    """How the files of drawings are written."""

    dpi: int = dpi_option()
    dxf_text: Literal["text", "strokes"] = dxf_text_option()


def format_option(default: str) -> Any:
    """Declare the output formats."""
    return option(
        "--format",
        read=read_formats,
        multiple=True,
        default=[default],
        show_default=True,
        help="svg,pdf,png,dxf.",
    )


def out_option() -> Any:
    """Declare the folder that files are written into."""
    return option(
        "-o",
        "--out",
        type=PathType(file_okay=False),
        default=Path("out"),
        show_default=True,
        help="Folder for the output files.",
    )


def open_option(help_text: str = "Open the written files in the system's viewer.") -> Any:
    """Declare whether the results are opened."""
    return option("--open", is_flag=True, help=help_text)


def jobs_option() -> Any:
    """Declare the number of processes."""
    return option(
        "--jobs",
        type=click.IntRange(1, 64),
        default=1,
        show_default=True,
        help="Number of processes.",
    )


def json_option(help_text: str) -> Any:
    """Declare that JSON is printed."""
    return option("--json", is_flag=True, help=help_text)


def force_option(help_text: str = "Overwrite an existing file.") -> Any:
    """Declare that a file may be replaced."""
    return option("--force", is_flag=True, help=help_text)


def settings_option(help_text: str) -> Any:
    """Declare the file with the settings of the department."""
    return option("--settings", type=PathType(dir_okay=False), metavar="FILE", help=help_text)


def watch_option() -> Any:
    """Declare that the command is done again after every saving of its files."""
    return option("--watch", is_flag=True, help="Repeat the command whenever a file is saved.")


def _lang_option(usual: Callable[[], str | None]) -> Any:
    return option(
        "--lang",
        type=click.Choice(LANGUAGES),
        default=usual,
        help="Language of output and messages. Default: the language of the system.",
    )


def lang_option() -> Any:
    """Declare the language of texts that are of no problem: the one to write in."""
    return _lang_option(current_language)


def problem_lang_option() -> Any:
    """Declare the language of texts of a problem: the one that the user names.

    Default: None; then the commands use the file's, by `language_of`.
    """
    return _lang_option(partial(named_language, None))


def structure_option() -> Any:
    """Declare that the structural sheet is meant, not the plans."""
    return option(
        "--structure",
        linkages_only=True,
        is_flag=True,
        help="Check the structural sheet instead of the plans.",
    )


def analytic_option() -> Any:
    """Declare that the protocol has the analytic method."""
    return option(
        "--analytic",
        linkages_only=True,
        is_flag=True,
        help="Add the analytic method: closed contours, projections, derivatives.",
    )


def centres_option() -> Any:
    """Declare that the results have the instant centres."""
    return option(
        "--centres",
        linkages_only=True,
        is_flag=True,
        help="Add the instant centres of all links, and velocities by them.",
    )


# What kinds of problem are requested -------------------------------------------------------------


class ResultRequest(Struct, frozen=True, kw_only=True):
    """Results to compute and their form; ``-`` is the terminal."""

    phi: Positions | None = positions_option(MAX_SWEPT_POSITIONS)
    position: int | None = position_option("Only the position with this number, from 0.")
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    as_json: bool = json_option("Print one JSON object, full precision, SI units.")
    csv_file: str | None = option(
        "--csv",
        linkages_only=True,
        is_flag=False,
        flag_value="-",
        metavar="[FILE]",
        help="Write a row for each position. Without FILE: to the terminal.",
    )
    npz_file: str | None = option(
        "--npz",
        linkages_only=True,
        metavar="FILE",
        help="Write NumPy arrays named as the columns of --csv (B.x, 2.omega), and phi_deg "
        "or s, reason, reasons. With several variants or problems each name begins "
        "with the variant or the file: А:B.x.",
    )
    quantities: tuple[str, ...] | None = option(
        "--ask",
        read=read_labels,
        linkages_only=True,
        metavar="LIST",
        help="Only these results: v_E,omega_3,B,phi_2,v_E_D,v_q_E,u_31,F_B_2/1,M_dr, or positions, "
        "velocities, accelerations, transfers, forces.",
    )
    partial: bool = option(
        "--partial",
        is_flag=True,
        help="Leave impossible positions empty and give the reason (--json, --csv, --npz, --ask).",
    )
    sigma: bool = option(
        "--sigma",
        linkages_only=True,
        is_flag=True,
        help="Show the drafting errors in the tables.",
    )
    centres: bool = centres_option()
    covariance_file: str | None = option(
        "--covariance",
        linkages_only=True,
        metavar="FILE",
        help="Write the covariance of the drafting errors of every two quantities as CSV; - "
        "for the terminal.",
    )
    referee: int | None = option(
        "--referee",
        linkages_only=True,
        type=click.IntRange(16, 1000),
        is_flag=False,
        flag_value=50,
        metavar="[DIGITS]",
        help="Verify every result in DIGITS-digit arithmetic (default 50). Requires mpmath.",
    )

    @property
    def returns_data(self) -> bool:
        """Whether the results are data for a file or a table, not printed documents."""
        return self.as_json or self.is_file or self.covariance_file is not None

    @property
    def is_file(self) -> bool:
        """Whether the results of all problems make one table or file of arrays."""
        return self.csv_file is not None or self.npz_file is not None

    @property
    def is_swept(self) -> bool:
        """Whether positions are swept, not drawn."""
        return self.npz_file is not None or self.quantities is not None

    @property
    def can_batch(self) -> bool:
        """Whether many problems can be solved together, not each alone."""
        moved = self.phi is not None or self.referee is not None or self.partial
        moved = moved or self.centres
        return (self.as_json or self.is_file) and not moved and self.quantities is None


class PlanRequest(Struct, frozen=True, kw_only=True):
    """Sheets or protocol of a problem, as they are requested.

    Attributes
    ----------
    fields : mapping of str to str
        Texts of the title block that outrank the file's.
    before, total : int
        Sheets of the set that go before, and all of them.
    phi : ndarray, optional
        Other positions than the problem's, of shape (n,), or (m, n) of m drivers; ``position``:
        the number of the main one.
    layout : str, optional
        Composition of the sheets; ``quantities``: what its graphs are of.
    structural : bool
        Whether the structural sheet is meant, not the plans.
    analytic : bool
        Whether the protocol has the analytic method.
    centres : bool
        Whether it has the instant centres.
    """

    fields: Mapping[str, str] = {}
    before: int = 0
    total: int | None = None
    phi: Positions | None = positions_option()
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    position: int | None = position_option()
    layout: str | None = layout_option()
    quantities: tuple[str, ...] = ()
    compact: bool = False
    drawing: DrawingOptions = field(default_factory=DrawingOptions)
    structural: bool = structure_option()
    analytic: bool = analytic_option()
    centres: bool = centres_option()

    @property
    def profile(self) -> Profile:
        """Accuracy of the drawing."""
        return self.drafting.named_profile
