"""The user's config file (файл настроек): the standing texts of title blocks, preferred make-up.

A student writes surname, group and checker into it once; the problem file outranks it.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Mapping
from pathlib import Path

from msgspec import Struct, field

from planmethod.errors import ConfigError, Fault, ProblemError
from planmethod.languages import say
from planmethod.problem import keys
from planmethod.problem.fields import Faults, read_keys
from planmethod.problem.head import SheetSettings
from planmethod.problem.sheet import read_sheet, read_stamp
from planmethod.problem.source import parse, read_source

VARIABLE = "PLANMETHOD_CONFIG"
"""Environment variable that names the config file."""


class Config(Struct, frozen=True):
    """What a config file says (настройки)."""

    stamp: Mapping[str, str] = field(default_factory=dict)
    sheet: SheetSettings = field(default_factory=SheetSettings)


def usual_place(environ: Mapping[str, str] = os.environ, platform: str = sys.platform) -> Path:
    """Return where the config file is unless told otherwise; it need not exist."""
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
            hint = say("Check --config or {}, or go without: --no-config.", VARIABLE)
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
            name, [Fault("", say("the file cannot be read: {}", error.strerror), "Check the path.")]
        ) from None
    faults = Faults()
    given = read_keys(faults, "", table, keys.CONFIG)
    config = Config(
        read_stamp(faults, given.get("stamp", {})), read_sheet(faults, given.get("sheet", {}))
    )
    if faults:
        raise ConfigError(name, faults.found)
    return config
