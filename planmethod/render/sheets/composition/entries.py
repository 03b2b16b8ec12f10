"""Blocks of a composition file, ``[[blocks]]``, in the order in which they are read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from planmethod.languages import translate
from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.fields import Faults, Table, read_integer, read_keys, read_text
from planmethod.problem.names import is_label
from planmethod.render.sheets.blocks import BLOCKS
from planmethod.render.sheets.composition.values import (
    read_choice,
    read_height,
    read_heights,
    read_line,
    read_list,
    read_markup,
    read_paragraph,
    read_size,
    read_switch,
)
from planmethod.render.sheets.model import BlockSpec

ALWAYS = ("kind", "group", "sheet", "droppable")
"""Keys of every block; the others are those of its kind."""

GROUP = ("arrange",)
"""Keys of a group, which cannot be names of groups."""

BLOCK_LIMIT = 60
ON_SHEET_LIMIT = 16
"""Most blocks on one sheet: the time to arrange them grows with the third power."""
SHEET_LIMIT = 12
GROUP_DEPTH = 4
MAX_PER_ROW = 12
MAX_LETTERS = 40
MAX_QUANTITIES = 24
MAX_NUMBER = 119
MAX_CHOSEN = 36

OF = {kind.value: kind for kind in RATES}
COLUMNS = {"v": "v", "omega": "ω", "a": "a", "epsilon": "ε"}


def read_entries(faults: Faults, value: object) -> tuple[BlockSpec, ...]:
    """Read ``[[blocks]]``: every block, and their order."""
    example = 'Give the blocks: [[blocks]] kind = "scheme".'
    if value is None:
        faults.add("blocks", "missing", example)
        return ()
    if not isinstance(value, list) or not all(isinstance(item, Mapping) for item in value):
        faults.expected("blocks", "tables [[blocks]]", value, example)
        return ()
    if not 1 <= len(value) <= BLOCK_LIMIT:
        faults.add("blocks", translate("expected 1 to {} blocks, got {}", BLOCK_LIMIT, len(value)))
        return ()
    entries: list[tuple[int, BlockSpec]] = []
    for k, item in enumerate(value):
        before = entries[-1][1].sheet if entries else 1
        entry = _read_block(faults, f"blocks[{k}]", item, before)
        if entry is not None:
            entries.append((k, entry))
    _check_order(faults, entries)
    for number, count in Counter(entry.sheet for _, entry in entries).items():
        if count > ON_SHEET_LIMIT:
            limit = translate(
                "sheet {} has {} blocks, the limit is {}", number, count, ON_SHEET_LIMIT
            )
            faults.add(
                "blocks", limit, translate("Put some on another sheet: sheet = {}.", number + 1)
            )
    return tuple(entry for _, entry in entries)


def _read_block(faults: Faults, path: str, table: Table, sheet: int) -> BlockSpec | None:
    """Read a block; it is on the ``sheet`` of the previous one unless it names another."""
    if "kind" not in table:
        faults.add(f"{path}.kind", "missing", translate("The kinds are {}.", ", ".join(BLOCKS)))
        return None
    kind = read_choice(faults, f"{path}.kind", table["kind"], tuple(BLOCKS))
    if kind is None:
        return None
    known = BLOCKS[kind].keys
    given = read_keys(faults, path, table, (*ALWAYS, *known))
    for key in ("of", "text"):
        if key in known and key not in given:
            hint = (
                'Name the plan: of = "velocity".' if key == "of" else 'For example: text = "...".'
            )
            faults.add(f"{path}.{key}", translate("missing in a block of kind {}", kind), hint)
    values: dict[str, Any] = {"sheet": sheet}
    for key, item in given.items():
        if key != "kind":
            field = "heights" if key == "height" else key
            values[field] = _READERS[key](faults, f"{path}.{key}", item)
    values["sheet"] = values["sheet"] or sheet
    return BlockSpec(kind, **values)


def _read_of(faults: Faults, path: str, value: object) -> PlanKind | None:
    return OF.get(read_choice(faults, path, value, tuple(OF)) or "")


def _read_group(faults: Faults, path: str, value: object) -> tuple[str, ...]:
    text = read_text(faults, path, value, limit=100)
    names = tuple(text.split(".")) if text else ()
    named = all(is_label(name) and name not in GROUP for name in names)
    if text is None or (names and len(names) <= GROUP_DEPTH and named):
        return names
    faults.expected(
        path,
        translate("names with dots between, {} at the most", GROUP_DEPTH),
        value,
        'For example: "left" or "left.equations".',
    )
    return ()


def _read_width(faults: Faults, path: str, value: object) -> float | None:
    if isinstance(value, int | float) and value is not True and 0.1 <= value <= 1.0:
        return float(value)
    return read_size(faults, path, value, "a width (or a part of the paper, to 1)", 40.0, 1200.0)


def _read_columns(faults: Faults, path: str, value: object) -> tuple[str, ...]:
    found = []
    for k, item in enumerate(read_list(faults, path, value, "quantities", len(COLUMNS))):
        word = read_choice(faults, f"{path}[{k}]", item, tuple(COLUMNS))
        if word is not None:
            found.append(COLUMNS[word])
    return tuple(found)


def _read_positions(faults: Faults, path: str, value: object) -> tuple[int, ...]:
    given = read_list(faults, path, value, "positions", MAX_CHOSEN)
    read = (read_integer(faults, f"{path}[{k}]", item, low=0, high=MAX_NUMBER)
            for k, item in enumerate(given))  # fmt: skip
    return tuple(dict.fromkeys(number for number in read if number is not None))


def _read_traces(faults: Faults, path: str, value: object) -> bool | tuple[str, ...]:
    if not isinstance(value, list):
        return read_switch(faults, path, value)
    letters = read_list(faults, path, value, "letters", MAX_LETTERS)
    return tuple(read_line(faults, f"{path}[{k}]", item) for k, item in enumerate(letters))


def _read_quantities(faults: Faults, path: str, value: object) -> tuple[str, ...]:
    asked = read_list(faults, path, value, "quantities", MAX_QUANTITIES)
    return tuple(read_line(faults, f"{path}[{k}]", item) for k, item in enumerate(asked))


_READERS: Mapping[str, Callable[[Faults, str, object], object]] = {
    "of": _read_of,
    "group": _read_group,
    "sheet": partial(read_integer, low=1, high=SHEET_LIMIT),
    "droppable": read_switch,
    "title": read_markup,
    "text": read_paragraph,
    "height": read_heights,
    "letter": read_height,
    "title_height": read_height,
    "width": _read_width,
    "per_row": partial(read_integer, low=1, high=MAX_PER_ROW),
    "position": partial(read_integer, low=0, high=MAX_NUMBER),
    "positions": _read_positions,
    "columns": _read_columns,
    "traces": _read_traces,
    "asked": _read_quantities,
}
"""Readers of the keys of a block: each is a field of `BlockSpec`; ``height`` is `heights`."""


def _check_order(faults: Faults, entries: list[tuple[int, BlockSpec]]) -> None:
    """Note sheets out of order, and groups that are resumed."""
    last, before = 1, BlockSpec("")
    closed: set[tuple[int, tuple[str, ...]]] = set()
    for k, entry in entries:
        path = f"blocks[{k}]"
        if entry.sheet < last:
            faults.add(
                f"{path}.sheet",
                translate("sheet {} after sheet {}", entry.sheet, last),
                "Put the blocks in the order of the sheets.",
            )
        elif entry.sheet > last + 1 or (k == 0 and entry.sheet != 1):
            faults.add(
                f"{path}.sheet",
                translate("sheet {}, but no sheet {}", entry.sheet, last + 1 if k else 1),
                "Number the sheets from 1 without gaps.",
            )
        last = max(last, entry.sheet)
        same = entry.sheet == before.sheet
        for depth in range(1, len(before.group) + 1):
            group = before.group[:depth]
            if not same or entry.group[:depth] != group:
                closed.add((before.sheet, group))
        for depth in range(1, len(entry.group) + 1):
            if (entry.sheet, entry.group[:depth]) in closed:
                name = ".".join(entry.group[:depth])
                faults.add(
                    f"{path}.group",
                    translate("group '{}' is resumed after another group", name),
                    "Put the blocks of a group one after another.",
                )
                break
        before = entry
