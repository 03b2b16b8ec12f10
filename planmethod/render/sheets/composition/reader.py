"""Composition files (файлы компоновки): read with all faults at once, like problem files."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import cache, partial
from pathlib import Path

from planmethod.errors import CompositionError, Fault, LayoutError, ProblemError
from planmethod.languages import LANGUAGES, translate
from planmethod.paper import BASIC, paper_format
from planmethod.plans.model import PlanKind
from planmethod.problem.file_node import Faults, FileNode, needed
from planmethod.problem.names import nearest_name_hint, short
from planmethod.problem.source import parse, read_source
from planmethod.render.layout.cuttings import Arrange
from planmethod.render.sheets.composer import Sizes
from planmethod.render.sheets.composition.entries import (
    EXAMPLE,
    GROUP,
    GROUP_DEPTH,
    OF,
    read_entries,
)
from planmethod.render.sheets.composition.values import (
    read_choice,
    read_height,
    read_line,
    read_size,
    read_switch,
    require_list,
)
from planmethod.render.sheets.compositions import SHIPPED, shipped_text
from planmethod.render.sheets.model import BlockSpec, Composition

TOP = (
    "about",
    "formats",
    "smaller",
    "per_sheet",
    "grow",
    "turn",
    "cycle",
    "arrange",
    "sizes",
    "groups",
    "sheets",
    "blocks",
)
SIZES = ("letter", "title", "text", "column", "scheme", "velocity", "acceleration")
SHEET = ("title",)

MAX_PER_SHEET = 36

VIEWS = {"scheme": PlanKind.POSITION, **OF}
ARRANGES: tuple[Arrange, ...] = ("free", "row", "column")


@cache
def shipped(name: str, lang: str = LANGUAGES[0]) -> Composition:
    """Return a shipped composition in a language."""
    return read_composition(shipped_text(name, lang), name=name)


def composition(source: str | Path, lang: str = LANGUAGES[0]) -> Composition:
    """Return a composition: a shipped one by its name in a language, else a file.

    Raises
    ------
    CompositionError
        With every fault of the file: path, expected and actual value, the next action.
    """
    if str(source) in SHIPPED:
        return shipped(str(source), lang)
    path = Path(source)
    if path.suffix != ".toml" and not path.exists():
        hint = nearest_name_hint(
            str(source), SHIPPED, translate("Shipped are {}.", ", ".join(SHIPPED))
        )
        fault = Fault("", "neither a layout nor a file has this name", hint)
        raise CompositionError(str(source), [fault])
    try:
        text = read_source(path)
    except ProblemError as error:
        raise CompositionError(error.source, error.faults) from None
    return read_composition(text, name=str(path))


def read_composition(text: str, *, name: str) -> Composition:
    """Read a composition from a text; ``name`` is its name in messages.

    Raises
    ------
    CompositionError
    """
    try:
        table = parse(text, name=name)
    except ProblemError as error:
        raise CompositionError(name, error.faults) from None
    file = FileNode(Faults(), table)
    file.allow(TOP)
    about = file.read("about", read_line, "")
    formats = file.read("formats", _read_formats, ("A3", "A2", "A1", "A0"))
    smaller = file.read("smaller", _read_formats, ())
    per_sheet = file.read("per_sheet", _read_per_sheet, (12, 6, 4, 2, 1))
    grow = file.read("grow", read_switch, absent=False)
    turn = file.read("turn", read_switch, absent=False)
    cycle = file.read("cycle", read_switch, absent=turn)
    usual = {} if name == SHIPPED[0] else shipped(SHIPPED[0]).sizes
    sizes = file.get("sizes", {}).attempt(partial(_read_sizes, usual=usual))
    if "blocks" not in file:
        file["blocks"].note("missing", hint=EXAMPLE)
    blocks = file.read("blocks", read_entries) or ()
    arranged = _read_groups(file, blocks)
    titles = file.read("sheets", partial(_read_sheets, numbers={one.sheet for one in blocks}), {})
    if file.faults:
        raise CompositionError(name, file.faults.listed)
    return Composition(
        name=name,
        about=needed(about),
        formats=needed(formats),
        smaller=needed(smaller),
        per_sheet=needed(per_sheet),
        grow=needed(grow),
        turn=needed(turn),
        cycle=needed(cycle),
        sizes=needed(sizes),
        arranged=arranged,
        titles=needed(titles),
        blocks=blocks,
    )


def _read_formats(node: FileNode) -> tuple[str, ...]:
    require_list(node, "paper formats", 20)
    return tuple(dict.fromkeys(node.read_sound(_read_format)))


def _read_format(node: FileNode) -> str:
    if not isinstance(node.value, str):
        node.reject_value("a paper format", 'For example: "A2".')
    try:
        return paper_format(node.value).name
    except LayoutError:
        hint = 'For example: "A2", "A4x3".'
        node.reject("unknown paper format '{}'", short(node.value), hint=hint)


def _read_per_sheet(node: FileNode) -> tuple[int, ...]:
    require_list(node, "numbers of positions", 12)
    found = node.read_sound(lambda number: number.integer(1, MAX_PER_SHEET))
    if list(found) != sorted(found, reverse=True):
        node.note("expected falling numbers", hint="For example: [12, 6, 4, 2, 1].")
    return found


def _read_sizes(node: FileNode, usual: Mapping[str, Sizes]) -> dict[str, Sizes]:
    """Read the sizes by format; ``usual`` are those that the file does not have."""
    node.table("A2 = { text = 5 }")
    node.allow(BASIC)
    read = node.read_each(lambda sizes: _read_format_sizes(sizes, usual.get(str(sizes.key))))
    return {**usual, **read}


def _read_format_sizes(node: FileNode, usual: Sizes | None) -> Sizes | None:
    node.table()
    node.allow(SIZES)
    values = {key: getattr(usual, key) for key in SIZES[:4]} if usual else {}
    boxes = dict(usual.boxes) if usual else {}
    for entry in node.entries():
        key = str(entry.key)
        if key in VIEWS:
            box = entry.attempt(_read_box)
            boxes |= {} if box is None else {VIEWS[key]: box}
        elif key == "column":
            values[key] = entry.attempt(lambda column: read_size(column, "a width", 40.0, 1200.0))
        else:
            values[key] = entry.attempt(read_height)
    node.require_sound()
    return Sizes(**values, boxes=tuple(boxes.items())) if len(values) == 4 else None


def _read_box(node: FileNode) -> tuple[float, float]:
    node.array("[width, height] in mm", low=2, high=2)
    width, height = node.read_all(lambda side: read_size(side, "a side", 10.0, 1200.0))
    return width, height


def _read_sheets(node: FileNode, numbers: Collection[int]) -> dict[int, str]:
    node.table('[sheets.2] title = "План ускорений"')
    node.allow(str(number) for number in sorted(numbers))
    return {int(key): title for key, title in node.read_each(_read_title).items()}


def _read_title(node: FileNode) -> str | None:
    node.table()
    node.allow(SHEET)
    return node.read("title", read_line)


def _read_groups(file: FileNode, blocks: tuple[BlockSpec, ...]) -> dict[tuple[str, ...], Arrange]:
    """Read the arrangement of groups: tables nested like the names of groups."""
    arranged: dict[tuple[str, ...], Arrange] = {}
    paths = {entry.group[:depth] for entry in blocks for depth in range(1, GROUP_DEPTH + 1)}

    def read_one(node: FileNode) -> Arrange:
        word = read_choice(node, ARRANGES)
        return next(way for way in ARRANGES if way == word)

    def read_level(node: FileNode, group: tuple[str, ...]) -> None:
        node.table('arrange = "row"')
        inner = {p[-1]: None for p in sorted(paths) if len(p) == len(group) + 1 and p[:-1] == group}
        node.allow((*GROUP, *inner) if group else inner)
        for key in inner:
            node.read(key, partial(read_level, group=(*group, key)))
        if "arrange" in node and group:
            arranged[group] = node.read("arrange", read_one) or "free"

    if "arrange" in file:
        arranged[()] = file.read("arrange", read_one) or "free"
    file.read("groups", partial(read_level, group=()))
    return arranged
