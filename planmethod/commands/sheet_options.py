"""Sheet settings: options override the problem file, which overrides the user's config file."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar, cast

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import current_language, named_language
from planmethod.options import BadParameter, PathType, UsageError, option

if TYPE_CHECKING:
    from planmethod.problem.records import KindProblem, SheetSettings
    from planmethod.problem.sheet import Config

P = TypeVar("P", bound="KindProblem")


# Values ------------------------------------------------------------------------------------------


def _read_choice(value: str, *, key: str) -> str:
    """Return one of the names of a key; letters may be Cyrillic."""
    from planmethod.problem.file_node import chosen
    from planmethod.problem.keys import CHOICES

    names = CHOICES[key]
    name = chosen(value, names)
    if name is None:
        raise BadParameter("{!r} is not one of {}", value, ", ".join(names))
    return name


def read_fields(value: tuple[str, ...]) -> dict[str, str]:
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


def read_paper(value: str) -> str:
    """Return the name of a paper format."""
    from planmethod.errors import LayoutError
    from planmethod.paper import paper_format

    try:
        return paper_format(value).name
    except LayoutError as error:
        raise click.BadParameter(str(error)) from None


# Options -----------------------------------------------------------------------------------------


def stamp_option() -> Any:
    """Declare the texts of the title block."""
    return option(
        "--stamp",
        read=read_fields,
        multiple=True,
        metavar="KEY=TEXT",
        help="Field of the title block.",
    )


def lettering_option() -> Any:
    """Declare the type of the letters."""
    return option(
        "--lettering",
        read=partial(_read_choice, key="lettering"),
        metavar="TYPE",
        help="GOST 2.304: B (type Б, slanted), B-upright, A, A-upright.",
    )


def colour_option() -> Any:
    """Declare the colours of lines."""
    return option(
        "--colour/--no-colour",
        default=None,
        help="Colour lines by their meaning, for the screen. Default: that of [sheet].",
    )


def coloured(problem: P, colour: bool | None) -> P:
    """Return a problem with the option over its settings of the sheet."""
    from planmethod.problem.records import SheetSettings

    whole: Any = problem
    return cast("P", replace(whole, sheet=SheetSettings(colour=colour).over(whole.sheet)))


class PaperRequest(Struct, frozen=True, kw_only=True):
    """Paper and title block requested by the command line (заказанное оформление).

    A field that `SheetSettings` has, too, is over the same key of ``[sheet]``.
    """

    paper: str | None = option(
        "--paper",
        read=read_paper,
        metavar="FORMAT",
        help="A4, A3, A4x3, A3:portrait... Default: the format that fits.",
    )
    fields: Mapping[str, str] = stamp_option()
    lettering: str | None = lettering_option()
    colour: bool | None = colour_option()
    lang: str | None = option(
        "--lang",
        read=partial(_read_choice, key="lang"),
        default=partial(named_language, None),
        metavar="LANG",
        help="Language of the sheets and messages, ru or en. Default: that of [sheet].",
    )
    form: str | None = option(
        "--form",
        read=partial(_read_choice, key="form"),
        metavar="FORM",
        help="Title block: 1, 1+2a (later sheets 2a), 2 (later sheets 2a), 2a.",
    )
    graph_26: bool | None = option(
        "--graph-26/--no-graph-26",
        default=None,
        help="Draw the designation in the upper corner. Default: with form 1 only.",
    )
    graphs_27_30: bool | None = option(
        "--graphs-27-30/--no-graphs-27-30",
        default=None,
        help="Draw the cells for a customer's marks.",
    )
    side_columns: bool | None = option(
        "--side-columns/--no-side-columns",
        default=None,
        help="Draw graphs 19 to 25 in the binding margin.",
    )
    config: Path | None = option(
        "--config",
        type=PathType(),
        metavar="FILE",
        help="Config file to use instead of the usual one.",
    )
    no_config: bool = option("--no-config", is_flag=True, help="Do not read a config file.")

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
        given = {
            key: getattr(self, key)
            for key in SheetSettings.__struct_fields__
            if key in self.__struct_fields__
        }
        return ResolvedRequest(self.fields, self._config(), SheetSettings(**given))

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
