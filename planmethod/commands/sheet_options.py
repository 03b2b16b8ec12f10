"""Sheet settings: options override the problem file, which overrides the user's config file."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import current_language, named_language
from planmethod.options import BadParameter, PathType, UsageError

if TYPE_CHECKING:
    from planmethod.problem.records import KindProblem, SheetSettings
    from planmethod.problem.sheet import Config

F = TypeVar("F", bound=Callable[..., Any])
P = TypeVar("P", bound="KindProblem")


class PaperRequest(Struct, frozen=True):
    """Paper and title block requested by the command line (заказанное оформление).

    Attributes
    ----------
    fields : mapping
        Texts of the title block.
    sheet : mapping
        Values for the other keys of ``[sheet]``; None where there is none.
    config : Path, optional
        The config file, if it is named.
    no_config : bool
        Whether no config file is read at all.
    """

    fields: Mapping[str, str]
    sheet: Mapping[str, str | bool | None]
    config: Path | None = None
    no_config: bool = False

    @property
    def lang(self) -> str | None:
        """The language that the user names."""
        return cast("str | None", self.sheet["lang"])

    def resolve(self) -> ResolvedRequest:
        """Read the config file, and return the settings of the sheets of every problem.

        The texts of the options are left to the sheets, as they outrank even computed numbers.

        Raises
        ------
        ConfigError
            The config file is faulty.
        LayoutError
            A field of the options is unknown.
        """
        from planmethod.problem.records import SheetSettings
        from planmethod.render.frame import check_fields

        check_fields(self.fields)
        return ResolvedRequest(self.fields, self._config(), SheetSettings(**self.sheet))  # type: ignore[arg-type]

    def _config(self) -> Config:
        from planmethod.problem.sheet import Config, find_config, load_config

        if self.no_config:
            if self.config is not None:
                raise UsageError("give --config or --no-config, not both")
            return Config()
        path = self.config or find_config()
        return Config() if path is None else load_config(path)


class ResolvedRequest(Struct, frozen=True):
    """Settings of the sheets of every problem.

    Attributes
    ----------
    fields : mapping
        Texts of the title block, from the options.
    config : Config
    options : SheetSettings
    """

    fields: Mapping[str, str]
    config: Config
    options: SheetSettings

    def over(self, problem: P) -> P:
        """Return a problem with the options over its settings, and the config file under them.

        The title of the problem outranks one of the config file: it is what the sheets show. The
        language is the one that the user names, else that of the files, else that of messages.
        """
        from planmethod.render.frame import merged

        config = self.config
        own = {"title": problem.title} if problem.title else {}
        stamp = merged(config.stamp, own, problem.stamp) if config.stamp else problem.stamp
        sheet = self.options.over(problem.sheet.over(config.sheet))
        sheet = replace(sheet, lang=sheet.lang or current_language())
        whole: Any = problem
        return cast("P", replace(whole, stamp=stamp, sheet=sheet))

    def author(self, problem: KindProblem) -> str | None:
        """Return whom the files of a problem name as their author."""
        return self.fields.get("author", problem.title_block.get("author")) or None


# Options -----------------------------------------------------------------------------------------


def _reader(key: str) -> Callable[[click.Context, click.Parameter, str | None], str | None]:
    """Return a callback that accepts one of the names of a key; letters may be Cyrillic."""

    def read(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
        if value is None:
            return None
        from planmethod.problem.file_node import chosen
        from planmethod.problem.keys import CHOICES

        names = CHOICES[key]
        name = chosen(value, names)
        if name is None:
            raise BadParameter("{!r} is not one of {}", value, ", ".join(names))
        return name

    return read


def _read_language(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Return the language that the user names: by the option, else in the environment."""
    return named_language(_reader("lang")(ctx, param, value))


def read_fields(
    ctx: click.Context, param: click.Parameter, value: tuple[str, ...]
) -> dict[str, str]:
    """Return the fields of the title block given as ``author=Иванов``."""
    if not value:
        return {}
    from planmethod.problem.faults import Faults
    from planmethod.problem.file_node import FileNode
    from planmethod.problem.records import STAMP_LIMIT

    fields, faults = {}, Faults()
    for field in value:
        key, sign, text = (part.strip() for part in field.partition("="))
        if not sign or not key:
            raise BadParameter("{!r} is not key=text, such as author=Иванов", field)
        fields[key] = text
        text.encode()  # a text that is not UTF-8 is reported as any other argument
        FileNode(faults, text, key).attempt(lambda node: node.text(STAMP_LIMIT))
    if faults.listed:
        raise click.BadParameter(" ".join(map(str, faults.listed)))
    return fields


def read_paper(ctx: click.Context, param: click.Parameter, value: str | None) -> str | None:
    """Return the name of a paper format."""
    if value is None:
        return None
    from planmethod.errors import LayoutError
    from planmethod.paper import paper_format

    try:
        return paper_format(value).name
    except LayoutError as error:
        raise click.BadParameter(str(error)) from None


stamp_option = click.option(
    "--stamp",
    "title_block_fields",
    callback=read_fields,
    multiple=True,
    metavar="KEY=TEXT",
    help="Field of the title block.",
)
lettering_option = click.option(
    "--lettering",
    callback=_reader("lettering"),
    metavar="TYPE",
    help="GOST 2.304: B (type Б, slanted), B-upright, A, A-upright.",
)

_SHEET_OPTIONS = (
    click.option(
        "--paper",
        callback=read_paper,
        metavar="FORMAT",
        help="A4, A3, A4x3, A3:portrait... Default: chosen to fit.",
    ),
    stamp_option,
    lettering_option,
    click.option(
        "--lang",
        callback=_read_language,
        metavar="LANG",
        help="Language of the sheets and of messages, ru or en; else that of [sheet].",
    ),
    click.option(
        "--form",
        callback=_reader("form"),
        metavar="FORM",
        help="Title block: 1, 1+2a (later sheets 2a), 2 (later sheets 2a), 2a.",
    ),
    click.option(
        "--graph-26/--no-graph-26",
        default=None,
        help="Designation in the upper corner; by default with form 1.",
    ),
    click.option(
        "--graphs-27-30/--no-graphs-27-30", default=None, help="Cells for a customer's marks."
    ),
    click.option(
        "--side-columns/--no-side-columns",
        default=None,
        help="Graphs 19 to 25 in the binding margin.",
    ),
    click.option(
        "--config",
        type=PathType(),
        metavar="FILE",
        help="Config file instead of the usual one.",
    ),
    click.option("--no-config", is_flag=True, help="Do not read a config file."),
)


def sheet_options(command: F) -> F:
    """Add paper, title block and config file; the command gets them as one `PaperRequest`."""

    @functools.wraps(command)
    def with_request(*args: Any, **kwargs: Any) -> Any:
        from planmethod.problem.keys import known

        asked = PaperRequest(
            fields=kwargs.pop("title_block_fields"),
            sheet={key: kwargs.pop(key) for key in known("sheet") if key in kwargs},
            config=kwargs.pop("config"),
            no_config=kwargs.pop("no_config"),
        )
        return command(*args, request=asked, **kwargs)

    whole: Any = with_request
    for option in reversed(_SHEET_OPTIONS):
        whole = option(whole)
    return cast("F", whole)
