"""Title block and make-up of the sheets (основная надпись и оформление): ``[stamp]``, ``[sheet]``.

A problem file has these tables, and so does the user's config file (файл настроек): a student
writes surname, group and checker into it once; the problem file outranks it.
"""

# Cyrillic letters: an example of a surname

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from msgspec import Struct, field

from planmethod.errors import ConfigError, Fault, LayoutError, ProblemError
from planmethod.languages import LANGUAGES, translate
from planmethod.paper import paper_format
from planmethod.problem import keys
from planmethod.problem.common import (
    SEVERAL,
    STAMP_LIMIT,
    TITLE_BLOCK,
    TITLE_BLOCK_IN,
    SheetSettings,
)
from planmethod.problem.fields import (
    Faults,
    Table,
    read_keys,
    read_table,
    read_text,
    read_word,
)
from planmethod.problem.flat_tables import read_choice, read_flat
from planmethod.problem.names import TITLE_LIMIT, joined, segment
from planmethod.problem.source import parse, read_source

_PAPER_LIMIT = 40
_READINGS_LIMIT = 10


def read_head(faults: Faults, document: Mapping[str, Any]) -> dict[str, Any]:
    """Read the common head of all files: title, source, title block, sheet settings."""
    return {
        **{key: _read_heading(faults, document, key) for key in ("title", "source")},
        **_read_reading(faults, document),
        **_read_stamps(faults, document.get("stamp", {})),
        "sheet": read_sheet(faults, document.get("sheet", {})),
    }


def _read_heading(faults: Faults, document: Mapping[str, Any], key: str) -> str:
    return read_text(faults, key, document.get(key, ""), limit=TITLE_LIMIT) or ""


def _read_reading(faults: Faults, document: Mapping[str, Any]) -> dict[str, Any]:
    """Read whether the scheme is one of several matching the data, and the others."""
    if "reading" not in document:
        if "other_readings" in document:
            hint = translate('Write reading = "{}".', SEVERAL)
            faults.add("other_readings", "goes with a reading", hint)
        return {}
    word = read_word(faults, "reading", document["reading"], (SEVERAL,))
    others = document.get("other_readings", [])
    if not isinstance(others, list) or len(others) > _READINGS_LIMIT:
        faults.expected(
            "other_readings", translate("a list of up to {} texts", _READINGS_LIMIT), others
        )
        return {}
    texts = [
        read_text(faults, f"other_readings[{k}]", one, limit=TITLE_LIMIT)
        for k, one in enumerate(others)
    ]
    return {"reading": word or "", "other_readings": tuple(text for text in texts if text)}


def _read_stamps(faults: Faults, table: object) -> dict[str, Any]:
    """Read ``[stamp]`` of a problem file, which may have texts for a language."""
    whole = table if isinstance(table, Mapping) else {}
    languages = {lang: whole[lang] for lang in TITLE_BLOCK_IN if lang in whole}
    if languages:
        table = {key: value for key, value in whole.items() if key not in languages}
    return {
        "stamp": read_stamp(faults, table),
        "stamp_in": {
            lang: read_stamp(faults, texts, f"stamp.{lang}") for lang, texts in languages.items()
        },
    }


def read_stamp(faults: Faults, table: object, path: str = "stamp") -> dict[str, str]:
    """Read ``[stamp]`` (основная надпись)."""
    stamp: dict[str, str] = {}
    given = _without_astray(faults, path, table, "sheet", 'author = "Иванов"')
    for key, value in read_keys(faults, path, given, TITLE_BLOCK).items():
        text = read_text(faults, f"{path}.{key}", value, limit=STAMP_LIMIT)
        if text is not None:
            stamp[key] = text
    return stamp


def read_sheet(faults: Faults, table: object) -> SheetSettings:
    """Read ``[sheet]`` (оформление листов)."""
    given = _without_astray(faults, "sheet", table, "stamp", "side_columns = true")
    own = {"paper": _read_paper, "lang": _read_language}
    return (
        SheetSettings(**read_flat(faults, "sheet", given, SheetSettings, own))
        if given
        else _DEFAULTS
    )


_DEFAULTS = SheetSettings()


def _without_astray(faults: Faults, path: str, table: object, second: str, example: str) -> Table:
    """Return a table without the keys that belong to the other one, each of which is a fault."""
    entries = read_table(faults, path, table, example)
    if not entries:
        return {}
    own = keys.known(path.partition(".")[0])
    astray = set(entries).intersection(keys.known(second)).difference(own)
    for key in entries:
        if key in astray:
            faults.add(
                joined(path, segment(key)), "unknown key", translate("It belongs in [{}].", second)
            )
    return {key: value for key, value in entries.items() if key not in astray}


def _read_language(faults: Faults, path: str, value: object) -> str | None:
    return read_choice(faults, path, value, LANGUAGES)


def _read_paper(faults: Faults, path: str, value: object) -> str | None:
    text = read_text(faults, path, value, limit=_PAPER_LIMIT)
    if text is None:
        return None
    try:
        return paper_format(text).name
    except LayoutError as error:
        faults.add(path, str(error).removesuffix("."))
        return None


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
            hint = translate("Check --config or {}, or go without: --no-config.", VARIABLE)
            raise ConfigError(name, [Fault("", "there is no such file", hint)])
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
    faults = Faults()
    given = read_keys(faults, "", table, keys.CONFIG)
    config = Config(
        read_stamp(faults, given.get("stamp", {})), read_sheet(faults, given.get("sheet", {}))
    )
    if faults:
        raise ConfigError(name, faults.listed)
    return config
