"""Variants as a table beside the problem file: a row for each (таблица вариантов)."""

from __future__ import annotations

import io
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from planmethod.languages import say
from planmethod.pattern import pattern
from planmethod.problem import keys
from planmethod.problem.fields import Faults, is_number
from planmethod.problem.names import UNITS, fold, listed, near_hint, short, split_names
from planmethod.problem.source import SIZE_LIMIT, table_text

_UNITS = {"м": "m", "см": "cm", "мм": "mm", "m": "m", "cm": "cm", "mm": "mm"}
_SI = pattern(
    r"(?:°|град|deg|об/мин|rpm|(?:мин|с)[-⁻][12¹²]|(?:1|рад|rad|м|m)/[сs][²2]?"
    r"|кг|kg|Н|N|(?:Н|N|кг|kg)[·*][мm][²2]?)\Z"
)
"""Units that the file has them in: they change nothing."""

_HEAD = pattern(r"(?P<name>[^,(\[]+?)\s*(?:[,(\[]\s*(?P<unit>[^)\]]*)[)\]]?)?\Z")
_NUMBER = pattern(r"[-+−]?[0-9]+(?:[.,][0-9]*)?(?:[eE][-+]?[0-9]+)?\Z")
_GREEK = str.maketrans(
    {"φ": "phi", "ω": "omega", "ε": "epsilon", "∠": "", "_": "", "{": "", "}": ""}
)


def with_table(faults: Faults, table: Mapping[str, Any], folder: Path | None) -> Mapping[str, Any]:
    """Return what TOML made of a file, with the variants of the table that it names.

    Parameters
    ----------
    folder : Path or None
        Where the problem file lies; None of a text that lies nowhere.
    """
    name = table.get("variants")
    if not isinstance(name, str):
        return table
    path = None if folder is None else folder / name
    example = 'For example: variants = "variants.csv", beside the problem file.'
    if path is None or Path(name).name != name or not name.lower().endswith((".csv", ".txt")):
        faults.add(
            "variants", say("expected the name of a CSV file, got '{}'", short(name)), example
        )
        return {**table, "variants": {}}
    try:
        with path.open("rb") as stream:
            data = stream.read(SIZE_LIMIT + 1)
    except OSError as error:
        faults.add("variants", say("{} cannot be read: {}", name, error.strerror), example)
        data = b""
    if len(data) > SIZE_LIMIT:
        faults.add("variants", say("{} is larger than {} bytes", name, SIZE_LIMIT))
        data = b""
    return {**table, "variants": _variants(faults, table, table_text(data), name) if data else {}}


def _variants(
    faults: Faults, table: Mapping[str, Any], text: str, name: str
) -> dict[str, dict[str, Any]]:
    """Return the overrides of every row by its first cell."""
    import csv

    separator = next((one for one in ";\t" if one in text.partition("\n")[0]), ",")
    try:
        rows = [
            [cell.strip() for cell in row]
            for row in csv.reader(io.StringIO(text, newline=""), delimiter=separator)
            if any(cell.strip() for cell in row)
        ]
    except csv.Error as error:
        faults.add("variants", say("{} is no CSV: {}", name, error), "Is a quote left open?")
        return {}
    if not rows:
        faults.add("variants", say("{} has no rows", name), "The first row names the columns.")
        return {}
    columns = [_column(faults, table, head, name) for head in rows[0][1:]]
    found: dict[str, dict[str, Any]] = {}
    for number, row in enumerate(rows[1:], 2):
        variant = row[0]
        if variant in found or not variant:
            what = "the variant has no name"
            if variant:
                what = say("variant '{}' is there twice", variant)
            said = say("{}, row {}: {}", name, number, what)
            faults.add("variants", said, "Its name is the first cell.")
            continue
        if len(row) > len(columns) + 1:
            cells = say("{} cells, {} columns", len(row), len(columns) + 1)
            said = say("{}, row {}: {}", name, number, cells)
            faults.add("variants", said, "Is a decimal comma read as a separator? Use ';'.")
            continue
        found[variant] = {}
        for column, cell in zip(columns, row[1:], strict=False):
            if column is not None and cell:
                _put(found[variant], table, *column, cell)
    return found


def _put(
    overrides: dict[str, Any], table: Mapping[str, Any], key: str, per: float, cell: str
) -> None:
    value: Any = cell
    if _NUMBER.match(cell):
        plain = cell.replace(",", ".").replace("−", "-")
        value = float(plain) if not plain.lstrip("+-").isdigit() else int(plain)
    if per != 1.0:
        value = value * per if is_number(value) else f"({value})*{per!r}"
    key, _, part = key.partition("[")
    if part:  # x or y of a fixed point: the other one stays
        point = key.split(".")[1]
        place = list(overrides.get(key) or table["frame"][point])
        place[int(part[0])], value = value, place
    overrides[key] = place if part else value


def _column(
    faults: Faults, table: Mapping[str, Any], head: str, name: str
) -> tuple[str, float] | None:
    """Return the dotted key of a column, and by what its numbers are multiplied."""
    match = _HEAD.match(head)
    written = match["name"] if match else head
    names = dict(_names(table))
    first = fold(written).split(".")[0]
    if "." in written and (first in table or first in keys.TOP):
        key: str | None = written
    else:
        key = names.get(_plain(written)) or names.get(_plain(written).removeprefix("l"))
    if key is None:
        hint = near_hint(_plain(written), names, say("Known: {}, and dotted keys.", listed(names)))
        faults.add("variants", say("{}: no column is called '{}'", name, short(head)), hint)
        return None
    unit = (match["unit"] or "").strip() if match else ""
    if not unit or _SI.match(unit):
        return key, 1.0
    if unit not in _UNITS or not _is_length(key):
        faults.add("variants", say("{}: '{}' is not in the unit of the file", name, short(head)))
        return None
    own = UNITS.get(str(table.get("units", "m")), 1.0)
    return key, own / UNITS[_UNITS[unit]]


def _is_length(key: str) -> bool:
    """Whether a key stands for a length of the file."""
    parts = key.split(".")
    return parts[0] == "frame" or (parts[0] == "links" and "angle" not in parts) or parts[-1] == "s"


def _plain(name: str) -> str:
    """Return a name of the "Дано" as it is looked for: ``φ_{1}`` and ``phi1`` are one."""
    return fold(name.replace(" ", "").translate(_GREEK))


def _names(table: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """Yield what "Дано" calls the numbers of a file, and their dotted keys."""
    driver = table.get("driver")
    if isinstance(driver, Mapping):
        link = driver.get("link", "")
        for key in ("phi", "omega", "n", "epsilon", "s", "v", "a"):
            yield key, f"driver.{key}"
            yield f"{key}{link}", f"driver.{key}"
        yield from ((_plain(key), f"driver.{key}") for key in driver)
    for point, place in _tables(table, "frame"):
        if isinstance(place, list):
            yield f"x{point}", f"frame.{point}[0]"
            yield f"y{point}", f"frame.{point}[1]"
    for link, body in _tables(table, "links"):
        for key, value in _tables({"": body}, ""):
            if len(split_names(key)) == 2:
                yield _plain(key), f"links.{link}.{key}"
            elif key == "angle":
                yield from ((_plain(k), f"links.{link}.angle.{k}") for k, _ in _tables(body, key))
            elif key == "slides" and isinstance(value, Mapping) and "offset" in value:
                yield f"e{body.get('points', [''])[0]}", f"links.{link}.slides.offset"
        yield f"m{link}", f"dynamics.links.{link}.mass"
        yield f"J{link}", f"dynamics.links.{link}.inertia"
        yield f"JS{link}", f"dynamics.links.{link}.inertia"
    loads = table.get("loads")
    for load in loads if isinstance(loads, list) else ():
        if isinstance(load, Mapping) and isinstance(load.get("name"), str):
            size = "couple" if "couple" in load else "force"
            yield _plain(load["name"]), f"loads.{load['name']}.{size}"


def _tables(table: Mapping[str, Any], key: str) -> Iterator[tuple[str, Any]]:
    below = table.get(key)
    if isinstance(below, Mapping):
        yield from below.items()
