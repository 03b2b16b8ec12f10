"""Blocks of a composition file, ``[[blocks]]``, in the order in which they are read."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping
from functools import partial
from typing import Any

from planmethod.languages import translate
from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.names import is_label
from planmethod.render.sheets.blocks import BLOCKS
from planmethod.render.sheets.composition.values import (
    read_choice,
    read_height,
    read_heights,
    read_line,
    read_markup,
    read_paragraph,
    read_size,
    read_switch,
    require_list,
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


def read_entries(node: FileNode) -> tuple[BlockSpec, ...]:
    """Read ``[[blocks]]``: every block, and their order."""
    if not isinstance(node.value, list) or not all(isinstance(b, Mapping) for b in node.value):
        node.reject_value("tables [[blocks]]", EXAMPLE)
    if not 1 <= len(node.value) <= BLOCK_LIMIT:
        node.reject("expected 1 to {} blocks, got {}", BLOCK_LIMIT, len(node.value))
    blocks: list[tuple[FileNode, BlockSpec]] = []
    for entry in node.entries():
        sheet = blocks[-1][1].sheet if blocks else 1
        block = entry.attempt(partial(_read_block, sheet=sheet))
        if block is not None:
            blocks.append((entry, block))
    _check_order(blocks)
    for number, count in Counter(block.sheet for _, block in blocks).items():
        if count > ON_SHEET_LIMIT:
            message = "sheet {} has {} blocks, the limit is {}"
            hint = translate("Put some on another sheet: sheet = {}.", number + 1)
            node.note(message, number, count, ON_SHEET_LIMIT, hint=hint)
    return tuple(block for _, block in blocks)


EXAMPLE = 'Give the blocks: [[blocks]] kind = "scheme".'


def _read_block(node: FileNode, sheet: int) -> BlockSpec:
    """Read a block; it is on the ``sheet`` of the previous one unless it names another."""
    hint = translate("The kinds are {}.", ", ".join(BLOCKS))
    kind = needed(node.require("kind", partial(read_choice, known=tuple(BLOCKS)), hint))
    known = BLOCKS[kind].keys
    node.allow((*ALWAYS, *known))
    for key, example in _REQUIRED.items():
        if key in known and key not in node:
            node[key].note("missing in a block of kind {}", kind, hint=example)
    values: dict[str, Any] = {"sheet": sheet}
    for key in node.value:
        value = node.read(key, _READERS[key]) if key != "kind" else None
        if value is not None:
            values["heights" if key == "height" else key] = value
    return BlockSpec(kind, **values)


_REQUIRED = {"of": 'Name the plan: of = "velocity".', "text": 'For example: text = "...".'}
"""Keys that a block must have if its kind has them, and examples."""


def _read_of(node: FileNode) -> PlanKind:
    return OF[read_choice(node, tuple(OF))]


def _read_group(node: FileNode) -> tuple[str, ...]:
    text = node.text(100)
    names = tuple(text.split(".")) if text else ()
    named = all(is_label(name) and name not in GROUP for name in names)
    if not (names and len(names) <= GROUP_DEPTH and named):
        expected = translate("names with dots between, {} at the most", GROUP_DEPTH)
        node.reject_value(expected, 'For example: "left" or "left.equations".')
    return names


def _read_width(node: FileNode) -> float:
    width = node.value
    if isinstance(width, int | float) and width is not True and 0.1 <= width <= 1.0:
        return float(width)
    return read_size(node, "a width (or a part of the paper, to 1)", 40.0, 1200.0)


def _read_columns(node: FileNode) -> tuple[str, ...]:
    require_list(node, "quantities", len(COLUMNS))
    words = node.read_sound(partial(read_choice, known=tuple(COLUMNS)))
    return tuple(COLUMNS[word] for word in words)


def _read_positions(node: FileNode) -> tuple[int, ...]:
    require_list(node, "positions", MAX_CHOSEN)
    return tuple(dict.fromkeys(node.read_sound(_read_position)))


def _read_position(node: FileNode) -> int:
    return node.integer(0, MAX_NUMBER)


def _read_traces(node: FileNode) -> bool | tuple[str, ...]:
    if not isinstance(node.value, list):
        return read_switch(node)
    require_list(node, "letters", MAX_LETTERS)
    return node.read_sound(read_line)


def _read_quantities(node: FileNode) -> tuple[str, ...]:
    require_list(node, "quantities", MAX_QUANTITIES)
    return node.read_sound(read_line)


_READERS: Mapping[str, Callable[[FileNode], object]] = {
    "of": _read_of,
    "group": _read_group,
    "sheet": lambda sheet: sheet.integer(1, SHEET_LIMIT),
    "droppable": read_switch,
    "title": read_markup,
    "text": read_paragraph,
    "height": read_heights,
    "letter": read_height,
    "title_height": read_height,
    "width": _read_width,
    "per_row": lambda count: count.integer(1, MAX_PER_ROW),
    "position": _read_position,
    "positions": _read_positions,
    "columns": _read_columns,
    "traces": _read_traces,
    "asked": _read_quantities,
}
"""Readers of the keys of a block: each is a field of `BlockSpec`; ``height`` is `heights`."""


def _check_order(blocks: list[tuple[FileNode, BlockSpec]]) -> None:
    """Note sheets out of order, and groups that are resumed."""
    last, before = 1, BlockSpec("")
    closed: set[tuple[int, tuple[str, ...]]] = set()
    for node, entry in blocks:
        if entry.sheet < last:
            hint = "Put the blocks in the order of the sheets."
            node["sheet"].note("sheet {} after sheet {}", entry.sheet, last, hint=hint)
        elif entry.sheet > last + 1 or (node.key == 0 and entry.sheet != 1):
            hint = "Number the sheets from 1 without gaps."
            lacking = last + 1 if node.key else 1
            node["sheet"].note("sheet {}, but no sheet {}", entry.sheet, lacking, hint=hint)
        last = max(last, entry.sheet)
        same = entry.sheet == before.sheet
        for depth in range(1, len(before.group) + 1):
            group = before.group[:depth]
            if not same or entry.group[:depth] != group:
                closed.add((before.sheet, group))
        for depth in range(1, len(entry.group) + 1):
            if (entry.sheet, entry.group[:depth]) in closed:
                name = ".".join(entry.group[:depth])
                hint = "Put the blocks of a group one after another."
                node["group"].note("group '{}' is resumed after another group", name, hint=hint)
                break
        before = entry
