"""Shipped problems with some of their values spoiled: each is read, or its faults are reported."""

from __future__ import annotations

import copy
import json
import random
import re
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from cases import sampled, some
from doors import (
    KINDS_KINDS as KINDS,
    PlanMethodError,
    ProblemError,
    kinds_load as load,
)
from worked import PROBLEMS

FILES = sorted(PROBLEMS.rglob("*.toml"))
SPOILED: dict[str, object] = {
    "text": "x", "negative": -3.5, "flag": True, "list": [1, 2], "zero": 0, "table": {"a": 1},
    "pairs": [[0, 1], [0, 2]], "huge": 1e300, "point": "A", "number": 7,
}  # fmt: skip
KEYS = ("fi", "mas", "аt", "over", "kind")  # one of them has a Cyrillic letter
ADDED = ("angle", "at", "law", "like", "phi", "n", "value", "type")

FLAT = ("scales", "cycle", "machine", "project", "friction", "sheet", "design", "picture")
"""Tables whose keys are read one by one, whatever else the file has."""


def as_toml(value: object) -> str:
    if isinstance(value, list):
        return "[" + ",\n".join(map(as_toml, value)) + "]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{json.dumps(k)} = {as_toml(v)}' for k, v in value.items())}}}"
    if isinstance(value, int | float) and not isinstance(value, bool):
        return repr(value)
    return json.dumps(value if isinstance(value, str | bool) else str(value))


def lines_of(table: dict[str, Any], before: str = "") -> Iterator[str]:
    """Yield a table as lines of dotted keys."""
    for key, value in table.items():
        dotted = before + json.dumps(key)
        if isinstance(value, dict) and value:
            yield from lines_of(value, f"{dotted}.")
        else:
            yield f"{dotted} = {as_toml(value)}"


def read(table: dict[str, Any], path: Path) -> list[str]:
    """Read a table as a file, and return its faults."""
    path.write_text("\n".join(lines_of(table)), "utf-8")
    kind = next((kind for kind in KINDS if kind.table in table and "links" not in table), None)
    try:
        if kind is None:
            load(path)
        else:
            kind.load(path, None)
    except ProblemError as error:
        assert error.faults
        return [str(fault) for fault in error.faults]
    return []


def table_of(file: Path) -> dict[str, Any]:
    table = tomllib.loads(file.read_text("utf-8"))
    return {key: value for key, value in table.items() if key != "variants"}


def paths_of(value: object, before: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    items = value.items() if isinstance(value, dict) else ()
    for key, inner in enumerate(value[:6]) if isinstance(value, list) else items:
        yield (*before, key)
        yield from paths_of(inner, (*before, key))


def spoil(draw: random.Random, table: dict[str, Any], path: tuple[Any, ...]) -> None:
    """Remove, replace or rename a value, or add one to it."""
    place: Any = table
    for key in path[:-1]:
        place = place[key]
    action = draw.choice(("remove", "rename", "add", *SPOILED))
    if action == "remove":
        del place[path[-1]]
    elif action == "rename" and isinstance(place, dict):
        place[draw.choice(KEYS)] = place.pop(path[-1])
    elif action == "add" and isinstance(place[path[-1]], dict):
        place[path[-1]][draw.choice(ADDED)] = draw.choice((1, "B", [1, 2]))
    else:
        place[path[-1]] = copy.deepcopy(SPOILED.get(action, "x"))


@pytest.mark.parametrize("file", sampled(FILES, 3), ids=lambda file: file.stem)
def test_a_spoiled_problem_is_read_or_its_faults_are_reported_once(
    file: Path, tmp_path: Path
) -> None:
    draw, table = random.Random(file.name), table_of(file)
    paths = list(paths_of(table))
    assert read(table, tmp_path / "x.toml") == []
    for _ in range(some(40, few=8)):
        spoiled = copy.deepcopy(table)
        for path in draw.sample(paths, min(len(paths), draw.choice((1, 1, 2, 3)))):
            try:
                spoil(draw, spoiled, path)
            except (KeyError, IndexError, TypeError):
                continue  # it was in what has been spoiled before
        try:
            faults = read(spoiled, tmp_path / "x.toml")
        except PlanMethodError:
            continue  # no fault of the file: the mechanism does not close
        assert len(set(faults)) == len(faults), faults


def leaves_of(table: dict[str, Any]) -> list[tuple[str, ...]]:
    """Return the paths of the values of flat tables."""
    found: list[tuple[str, ...]] = [(name, key) for name in FLAT for key in table.get(name, ())]
    for kind in KINDS:
        own = table.get(kind.table, {})
        if isinstance(own, list):
            continue  # [[cams]]: spoiled as a whole by the test above
        found += [(kind.table, name, key) for name in FLAT for key in own.get(name, ())]
    return found


def test_every_value_of_a_flat_table_that_is_faulty_is_reported(tmp_path: Path) -> None:
    """A fault of one value hides none of another's: readers of tables collect."""
    draw, seen = random.Random(5), 0
    for file in sampled(FILES, 2):
        table = table_of(file)
        leaves = leaves_of(table)
        if len(leaves) < 2:
            continue
        for _ in range(some(100, few=10)):
            spoiled = copy.deepcopy(table)
            places = draw.sample(leaves, 2)
            for *above, key in places:
                place = spoiled
                for part in above:
                    place = place[part]
                place[key] = {"a": [{"b": 1}]}
            faults = read(spoiled, tmp_path / "x.toml")
            for path in places:
                start = re.escape(".".join(path))
                assert any(re.match(rf"{start}[:.\[]", fault) for fault in faults), (file, faults)
                seen += 1
    assert seen > 40
