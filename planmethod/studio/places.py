"""Location of a fault in the text of a problem file (место ошибки)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from planmethod.errors import Fault

_HEADER = re.compile(r"^\s*+(\[{1,2}+)([^\]]++)\]{1,2}+\s*+(?:#.*)?$")
_NAME = r"""(?:[\w-]++|"[^"]*+"|'[^']*+')"""
_KEY = re.compile(rf"^\s*+({_NAME}(?:\s*+\.\s*+{_NAME})*+)\s*+=")
_PART = re.compile(r"""[\w-]+|"[^"]*"|'[^']*'""")


def place_of(text: str, fault: Fault) -> tuple[int, int] | None:
    """Return the line and the column of a fault, both from 1; None if unknown.

    A syntax error states them; another fault names a key, found by its longest matching path.
    """
    numbers = re.fullmatch(r"\D*(\d+)\D+(\d+)\D*", fault.path)
    if numbers is not None and " " in fault.path:
        return int(numbers[1]), int(numbers[2])
    said = re.match(r"\w+ (\d+)\b", fault.message) if not fault.path else None
    if said is not None:
        return int(said[1]), 1
    wanted = _parts(fault.path.split(" ")[0].replace("[", ".").replace("]", ""))
    best: tuple[int, int, int] | None = None
    for own, line, column in _keys(text):
        same = next((k for k, (a, b) in enumerate(zip(own, wanted, strict=False)) if a != b), None)
        depth = min(len(own), len(wanted)) if same is None else same
        whole = same is None and len(own) <= len(wanted)
        if (whole or depth == len(wanted)) and depth and (best is None or depth > best[0]):
            best = depth, line, column
    return None if best is None else best[1:]


def _parts(path: str) -> tuple[str, ...]:
    return tuple(part.strip("\"'") for part in _PART.findall(path))


def _keys(text: str) -> Iterator[tuple[Sequence[str], int, int]]:
    """Yield the headers and keys of a text with their lines and columns; arrays by number from 0.

    A half-typed text is not valid TOML: lines are parsed one by one.
    """
    table: tuple[str, ...] = ()
    count: dict[tuple[str, ...], int] = {}
    for number, line in enumerate(text.split("\n"), 1):
        if (header := _HEADER.match(line)) is not None:
            table = _parts(header[2].strip())
            if len(header[1]) == 2:
                count[table] = count.get(table, -1) + 1
            for depth in range(len(table), 0, -1):
                if table[:depth] in count:
                    table = (*table[:depth], str(count[table[:depth]]), *table[depth:])
            yield table, number, line.index("[") + 1
        elif (key := _KEY.match(line)) is not None:
            own = (*table, *_parts(key[1]))
            yield own, number, key.start(1) + 1
            for inner in re.finditer(r"[{,]\s*([\w-]+)\s*=", line):
                yield (*own, inner[1]), number, inner.start(1) + 1
