"""Title block and make-up of the sheets (основная надпись и оформление): ``[stamp]``, ``[sheet]``.

A problem file has these tables, and so does a config file.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any

from planmethod.errors import LayoutError
from planmethod.languages import say
from planmethod.paper import paper_format
from planmethod.problem import keys
from planmethod.problem.fields import Faults, read_flag, read_keys, read_table, read_text
from planmethod.problem.head import SheetSettings
from planmethod.problem.names import TITLE_LIMIT, fold, joined, near_hint, segment

STAMP_LIMIT = 200
_WORD_LIMIT = 40


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
    example = 'author = "Иванов"'
    for key, value in _given(faults, "stamp", table, keys.STAMP, keys.SHEET, example).items():
        text = read_text(faults, f"stamp.{key}", value, limit=STAMP_LIMIT)
        if text is not None:
            stamp[key] = text
    return stamp


def read_sheet(faults: Faults, table: object) -> SheetSettings:
    """Read ``[sheet]`` (оформление листов)."""
    told: dict[str, Any] = {}
    given = _given(faults, "sheet", table, keys.SHEET, keys.STAMP, "side_columns = true")
    for key, value in given.items():
        path = f"sheet.{key}"
        if key == "paper":
            told[key] = _read_paper(faults, path, value)
        elif key in keys.SHEET_CHOICES:
            told[key] = _read_choice(faults, path, value, keys.SHEET_CHOICES[key])
        else:
            told[key] = read_flag(faults, path, value)
    return SheetSettings(**told)


def _given(
    faults: Faults,
    path: str,
    table: object,
    known: Collection[str],
    others: Collection[str],
    example: str,
) -> dict[str, Any]:
    """Return the known keys of a table; the fault of a key of the other table says so."""
    entries = read_table(faults, path, table, example) or {}
    other = "sheet" if path == "stamp" else "stamp"
    astray = [key for key in entries if key in others and key not in known]
    for key in astray:
        faults.add(joined(path, segment(key)), "unknown key", say("It stands in [{}].", other))
    kept = {key: value for key, value in entries.items() if key not in astray}
    return read_keys(faults, path, kept, known)


def _read_paper(faults: Faults, path: str, value: object) -> str | None:
    text = read_text(faults, path, value, limit=_WORD_LIMIT)
    if text is None:
        return None
    try:
        return paper_format(text).name
    except LayoutError as error:
        faults.add(path, str(error).removesuffix("."))
        return None


def _read_choice(faults: Faults, path: str, value: object, known: Collection[str]) -> str | None:
    """Read one of a few words, in either alphabet and case."""
    text = read_text(faults, path, value, limit=_WORD_LIMIT)
    if text is None:
        return None
    word = chosen(text, known)
    if word is None:
        faults.expected(path, say("one of {}", ", ".join(known)), value, near_hint(text, known))
    return word


def chosen(text: str, known: Collection[str]) -> str | None:
    """Return which of a few words a text is, in either alphabet and case, or None.

    Type Б of the lettering is called B in Latin letters.

    Examples
    --------
    >>> chosen("2А", ("1", "2a"))
    '2a'
    """
    word = fold(text.replace("Б", "B")).replace(" ", "").casefold()
    return next((name for name in known if name.casefold() == word), None)
