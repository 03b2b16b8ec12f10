"""Title block and make-up of the sheets (основная надпись и оформление): ``[stamp]``, ``[sheet]``.

A problem file has these tables, and so does a config file.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, say
from planmethod.paper import paper_format
from planmethod.problem import keys
from planmethod.problem.fields import Faults, Table, read_keys, read_table, read_text
from planmethod.problem.flat import read_choice, read_flat
from planmethod.problem.head import STAMP_LIMIT, SheetSettings
from planmethod.problem.names import TITLE_LIMIT, joined, segment

_PAPER_LIMIT = 40


def read_head(faults: Faults, given: Mapping[str, Any]) -> dict[str, Any]:
    """Read what files of every kind begin with: title, source, title block, make-up of sheets."""
    return {
        **{key: _read_heading(faults, given, key) for key in ("title", "source")},
        "stamp": read_stamp(faults, given.get("stamp", {})),
        "sheet": read_sheet(faults, given.get("sheet", {})),
    }


def _read_heading(faults: Faults, given: Mapping[str, Any], key: str) -> str:
    return read_text(faults, key, given.get(key, ""), limit=TITLE_LIMIT) or ""


def read_stamp(faults: Faults, table: object) -> dict[str, str]:
    """Read ``[stamp]`` (основная надпись)."""
    stamp: dict[str, str] = {}
    given = _without_astray(faults, "stamp", table, "sheet", 'author = "Иванов"')
    for key, value in read_keys(faults, "stamp", given, keys.known("stamp")).items():
        text = read_text(faults, f"stamp.{key}", value, limit=STAMP_LIMIT)
        if text is not None:
            stamp[key] = text
    return stamp


def read_sheet(faults: Faults, table: object) -> SheetSettings:
    """Read ``[sheet]`` (оформление листов)."""
    given = _without_astray(faults, "sheet", table, "stamp", "side_columns = true")
    own = {"paper": _read_paper, "lang": _read_language}
    return (
        SheetSettings(**read_flat(faults, "sheet", given, SheetSettings, own)) if given else _NONE
    )


_NONE = SheetSettings()


def _without_astray(faults: Faults, path: str, table: object, other: str, example: str) -> Table:
    """Return a table without the keys that stand in the other one, each of which is a fault."""
    entries = read_table(faults, path, table, example)
    if not entries:
        return {}
    astray = set(entries).intersection(keys.known(other)).difference(keys.known(path))
    for key in entries:
        if key in astray:
            faults.add(joined(path, segment(key)), "unknown key", say("It stands in [{}].", other))
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
