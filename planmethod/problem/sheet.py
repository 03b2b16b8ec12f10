"""Title block and make-up of the sheets (основная надпись и оформление): ``[stamp]``, ``[sheet]``.

A problem file has these tables, and so does the user's config file (файл настроек): a student
writes surname, group and checker into it once; the problem file outranks it.
"""

# Cyrillic letters: an example of a surname

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from functools import partial
from pathlib import Path
from typing import Any

from msgspec import Struct, field

from planmethod.errors import ConfigError, Fault, LayoutError, ProblemError
from planmethod.languages import LANGUAGES, translate
from planmethod.paper import paper_format
from planmethod.problem import keys
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode
from planmethod.problem.names import TITLE_LIMIT
from planmethod.problem.records import (
    SEVERAL,
    STAMP_LIMIT,
    TITLE_BLOCK,
    TITLE_BLOCK_IN,
    SheetSettings,
)
from planmethod.problem.source import parse, read_source

_PAPER_LIMIT = 40
_READINGS_LIMIT = 10


def read_head(file: FileNode) -> dict[str, Any]:
    """Read the common head of all files: title, source, title block, sheet settings."""
    return {
        **{key: file.read(key, _read_heading) or "" for key in ("title", "source")},
        **_read_reading(file),
        **_read_stamps(file),
        "sheet": file.read("sheet", read_sheet) or _DEFAULTS,
    }


def _read_heading(node: FileNode) -> str:
    return node.text(TITLE_LIMIT)


def _read_reading(file: FileNode) -> dict[str, Any]:
    """Read whether the scheme is one of several matching the data, and the others."""
    if "reading" not in file:
        if "other_readings" in file:
            hint = translate('Write reading = "{}".', SEVERAL)
            file["other_readings"].note("valid only with reading", hint=hint)
        return {}
    return {
        "reading": file.read("reading", lambda word: word.word((SEVERAL,))) or "",
        "other_readings": file.read("other_readings", _read_others) or (),
    }


def _read_others(node: FileNode) -> tuple[str, ...]:
    expected = partial(translate, "a list of up to {} texts", _READINGS_LIMIT)
    node.array(expected, high=_READINGS_LIMIT)
    return tuple(text for text in node.read_sound(_read_heading) if text)


def _read_stamps(file: FileNode) -> dict[str, Any]:
    """Read ``[stamp]`` of a problem file, which may have texts for a language."""
    node, languages = file["stamp"], []
    if isinstance(node.value, Mapping):
        languages = [node[lang] for lang in TITLE_BLOCK_IN if lang in node]
        own = {key: value for key, value in node.value.items() if key not in TITLE_BLOCK_IN}
        node = node.with_value(own)
    return {
        "stamp": (node.attempt(read_stamp) if "stamp" in file else None) or {},
        "stamp_in": {str(one.key): one.attempt(read_stamp) or {} for one in languages},
    }


def read_stamp(node: FileNode) -> dict[str, str]:
    """Read ``[stamp]`` (основная надпись)."""
    node.table('author = "Иванов"')
    _reject_astray(node, "stamp", "sheet")
    node.allow(TITLE_BLOCK)
    return node.read_each(lambda text: text.text(STAMP_LIMIT))


def read_sheet(node: FileNode) -> SheetSettings:
    """Read ``[sheet]`` (оформление листов)."""
    node.table("side_columns = true")
    _reject_astray(node, "sheet", "stamp")
    found = node.record(SheetSettings, paper=_read_paper, lang=lambda lang: lang.choice(LANGUAGES))
    return SheetSettings(**found)


_DEFAULTS = SheetSettings()


def _reject_astray(node: FileNode, table: str, second: str) -> None:
    """Reject the keys of a table that belong to another one."""
    astray = {*keys.known(second)}.difference(keys.known(table))
    for key in [key for key in node.value if key in astray]:
        node[key].note("unknown key", hint=translate("It belongs in [{}].", second))
    node.value = {key: value for key, value in node.value.items() if key not in astray}


def _read_paper(node: FileNode) -> str:
    text = node.text(_PAPER_LIMIT)
    try:
        return paper_format(text).name
    except LayoutError as error:
        node.reject(str(error).removesuffix("."))


VARIABLE = "PLANMETHOD_CONFIG"
"""Environment variable that names the config file."""


class Config(Struct, frozen=True):
    """Content of a config file (настройки)."""

    stamp: Mapping[str, str] = field(default_factory=dict)
    sheet: SheetSettings = field(default_factory=SheetSettings)


def usual_place(environ: Mapping[str, str] = os.environ, platform: str = sys.platform) -> Path:
    """Return the default path of the config file, which need not exist."""
    if platform == "win32":
        folder = environ.get("APPDATA", "")
        base = Path(folder) if folder else Path.home() / "AppData" / "Roaming"
    else:
        folder = environ.get("XDG_CONFIG_HOME", "")
        # the XDG rule: a relative path counts as absent
        base = Path(folder) if folder.startswith("/") else Path.home() / ".config"
    return base / "planmethod" / "config.toml"


def find_config(environ: Mapping[str, str] = os.environ) -> Path | None:
    """Return the config file of the user, or None where there is none.

    A file that `VARIABLE` names is returned whether it exists or not; the usual one if it exists.
    """
    named = environ.get(VARIABLE, "")
    if named:
        return Path(named)
    try:
        usual = usual_place(environ)
        return usual if usual.exists() else None
    except (OSError, RuntimeError):  # no home, or no permission to look into it
        return None


def load_config(path: Path) -> Config:
    """Read a config file.

    Raises
    ------
    ConfigError
        With every fault of the file: path, what was expected, what was found, the nearest name.
    """
    name = str(path)
    try:
        if not path.exists():
            hint = translate("Check --config or {}, or use --no-config.", VARIABLE)
            raise ConfigError(name, [Fault("", "this file does not exist", hint)])
        if path.is_dir():
            raise ConfigError(
                name, [Fault("", "this is a directory", "Name the file itself, config.toml.")]
            )
        table = parse(read_source(path), name=name)
    except ConfigError:
        raise
    except ProblemError as error:
        raise ConfigError(name, error.faults) from None
    except OSError as error:
        raise ConfigError(
            name,
            [
                Fault(
                    "", translate("the file cannot be read: {}", error.strerror), "Check the path."
                )
            ],
        ) from None
    file = FileNode(Faults(), table)
    file.allow(keys.CONFIG)
    stamp, sheet = file.read("stamp", read_stamp), file.read("sheet", read_sheet)
    if file.faults:
        raise ConfigError(name, file.faults.listed)
    return Config(stamp or {}, sheet or SheetSettings())
