"""A mechanism built from the stated data alone: the keys in the nodes of a statement."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import Any

from msgspec.structs import replace

from planmethod import loads
from planmethod.note.document import GivenFact, plain_text
from planmethod.problem.model import Problem

UNITS = {
    "mm": 1e-3, "мм": 1e-3, "cm": 1e-2, "см": 1e-2, "m": 1.0, "м": 1.0, "in": 0.0254, "ft": 0.3048,
}  # fmt: skip
LISTS = ("cams", "meshes", "loads", "springs")
_NUMBER = r"[−-]?\d[\d.,]*(?:e[+-]?\d+|·10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?"


def rebuilt(facts: Iterable[GivenFact], name: str = "rebuilt") -> Problem:
    """Return the problem that the data of some facts describe."""
    data: dict[str, Any] = {}
    for fact in facts:
        for key, value in fact.data.items():
            assert data.setdefault(key, value) == value, f"{key} is given twice"
    judged = data.pop("judged", None)
    driving = {key: data.pop(key) for key in [*data] if key.startswith(("cam.", "gears."))}
    of_driving = file_of(table_of([GivenFact("", driving)]))
    problem = loads("\n".join([of_driving, *_toml(data)]), name=name)
    if judged is not None:
        problem = replace(problem, drive=replace(problem.drive, assembly_positions=tuple(judged)))
    return problem


def _toml(data: dict[str, Any]) -> Iterator[str]:
    """Yield a problem file; a point given by one coordinate has 0 as the other."""
    lists: dict[str, dict[int, Any]] = {}
    tables: dict[tuple[str, int], list[str]] = {}
    for key, value in data.items():
        entry = re.fullmatch(r"(loads|springs)\[(\d+)\]\.(.+)", key)
        item = re.fullmatch(r"(.+)\[(\d+)\]", key)
        if entry:
            own = tables.setdefault((entry[1], int(entry[2])), [])
            own.append(f"{entry[3]} = {_value(value)}")
        elif item:
            lists.setdefault(item[1], {})[int(item[2])] = value
        else:
            yield f"{key} = {_value(value)}"
    for key, items in lists.items():
        yield f"{key} = {_value([items.get(k, 0.0) for k in range(2)])}"
    for (name, _), lines in sorted(tables.items()):
        yield f"[[{name}]]"
        yield from lines


def _value(value: Any) -> str:
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_value, value))}]"
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value(one)}" for key, one in value.items()) + " }"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    return repr(value)


def printed(text: str) -> Iterator[tuple[float, float]]:
    """Yield the numbers of a text, lengths in metres, each with the value of its last digit."""
    for match in re.finditer(rf"({_NUMBER})[ \u00a0]?([a-zа-я]*)", plain_text(text)):
        shown = match[1].rstrip(",.").replace("−", "-").replace(",", ".")
        base, _, power = shown.partition("·10")
        if power:
            base += "e" + power.translate(str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "-0123456789"))
        mantissa, _, exponent = base.partition("e")
        try:
            value = float(base)
        except ValueError:
            continue
        last = 10.0 ** (int(exponent or 0) - len(mantissa.partition(".")[2]))
        scale = UNITS.get(match[2], 1.0)
        yield value * scale, last * scale


def table_of(facts: Iterable[GivenFact]) -> dict[str, Any]:
    """Return the tables of a problem file made of the data of some facts only."""
    table: dict[str, Any] = {}
    told: dict[str, Any] = {}
    for fact in facts:
        for key, value in fact.data.items():
            assert told.setdefault(key, value) == value, f"{key} is given twice"
    for key, value in told.items():
        *way, last = [part.strip('"') for part in re.findall(r'"[^"]*"|[^.\[\]"]+', key)]
        inner = table
        for part in way:
            inner = inner.setdefault(part, {})
        inner[last] = value
    found: dict[str, Any] = _listed(table)
    return found


def _listed(value: Any) -> Any:
    """Return tables whose keys are ``meshes[0]``, ``meshes[1]`` as lists."""
    if not isinstance(value, dict):
        return value
    return {
        key: [_listed(one[str(k)]) for k in range(len(one))]
        if isinstance(one, dict) and key in LISTS
        else _listed(one)
        for key, one in value.items()
    }


def file_of(table: dict[str, Any]) -> str:
    """Return a problem file of tables."""
    return "\n".join(f"{key} = {_inline(value)}" for key, value in table.items()) + "\n"


def _inline(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f'"{key}" = {_inline(one)}' for key, one in value.items()) + "}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_inline, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    return _value(value)
