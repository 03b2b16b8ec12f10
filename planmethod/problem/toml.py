"""Tables as the text of a problem file (запись в TOML): reading it gives the same values."""

# no messages: TOML

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from datetime import date, time
from typing import Any


def value_text(value: Any) -> str:
    """Return a value as TOML has it on one line."""
    if isinstance(value, Mapping):
        inner = ", ".join(f"{_key(key)} = {value_text(own)}" for key, own in value.items())
        return f"{{ {inner} }}" if inner else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(value_text, value))}]"
    if isinstance(value, date | time):
        return value.isoformat()
    if isinstance(value, float):
        return float.__repr__(value)  # JSON has other words for infinity
    import json  # not for those who only read a problem

    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")


def _key(key: str) -> str:
    return key if re.fullmatch(r"[A-Za-z0-9_-]+", key) else value_text(key)


def table_text(table: Mapping[str, Any]) -> str:
    """Return the text of a whole file: its tables with their heads, short ones on one line."""
    return "\n".join(_lines(table, ())).strip() + "\n"


def _lines(table: Mapping[str, Any], path: tuple[str, ...]) -> Iterator[str]:
    apart = {key for key, value in table.items() if _has_head(table, value, path)}
    plain = {key: value for key, value in table.items() if key not in apart}
    if path and (plain or not apart):
        yield ""
        yield f"[{'.'.join(map(_key, path))}]"
    yield from (f"{_key(key)} = {value_text(value)}" for key, value in plain.items())
    for key in table:
        if key not in apart:
            continue
        if isinstance(table[key], Mapping):
            yield from _lines(table[key], (*path, key))
            continue
        for entry in table[key]:
            yield ""
            yield f"[[{'.'.join(map(_key, (*path, key)))}]]"
            yield from (f"{_key(inner)} = {value_text(own)}" for inner, own in entry.items())


def _has_head(table: Mapping[str, Any], value: Any, path: tuple[str, ...]) -> bool:
    """Return whether a value has its own head: a table of the file, each of several links."""
    if isinstance(value, list):
        whole = bool(value) and all(isinstance(entry, Mapping) for entry in value)
        return whole and not path
    if not isinstance(value, Mapping):
        return False
    return not path or (len(path) == 1 and all(isinstance(one, Mapping) for one in table.values()))
