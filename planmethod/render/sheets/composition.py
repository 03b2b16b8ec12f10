"""Composition files (файлы компоновки): read with all faults at once, like problem files."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Mapping
from functools import cache, partial
from pathlib import Path
from typing import Any

from planmethod.errors import CompositionError, Fault, LayoutError, ProblemError
from planmethod.languages import LANGUAGES, translate
from planmethod.paper import BASIC, paper_format
from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.names import is_label, nearest_name_hint, short
from planmethod.problem.quantities import QuantityKind
from planmethod.problem.source import parse, read_source
from planmethod.render.ink.drawing import HEIGHTS
from planmethod.render.ink.typeset import SMALLEST, typeset
from planmethod.render.layout.groups import Arrange
from planmethod.render.sheets.blocks import BLOCKS
from planmethod.render.sheets.composer import Sizes
from planmethod.render.sheets.compositions import SHIPPED, shipped_text
from planmethod.render.sheets.model import BlockSpec, Composition, SheetSpec

TITLE_LIMIT = 200
TEXT_LIMIT = 4000
BRACE_DEPTH = 8


def read_line(node: FileNode) -> str:
    """Read a plain line."""
    return node.text(TITLE_LIMIT)


def read_markup(node: FileNode) -> str:
    """Read a line of rich text."""
    return _checked(node, node.text(TITLE_LIMIT))


def _checked(node: FileNode, text: str) -> str:
    """Return rich text that can be set."""
    depth = deepest = 0
    for sign in text:
        depth += (sign == "{") - (sign == "}")
        deepest = max(deepest, depth)
    if deepest > BRACE_DEPTH:
        node.reject("braces are nested {} deep, the limit is {}", deepest, BRACE_DEPTH)
    try:
        for line in text.split("\n"):
            typeset(line, SMALLEST)
    except LayoutError as error:
        what, _, hint = str(error).partition("). ")
        node.reject(f"{what[:1].lower()}{what[1:]})", hint=hint)
    return text


def read_paragraph(node: FileNode) -> str:
    r"""Read rich text of several lines; ``\n`` starts a new one."""
    if not isinstance(node.value, str):
        node.reject_value("a string", "Put it in quotes.")
    if len(node.value) > TEXT_LIMIT:
        message = "the text has {} characters, the limit is {}"
        node.reject(message, len(node.value), TEXT_LIMIT, hint="Shorten it.")
    text = node.value.strip("\n")
    for line in text.split("\n"):
        node.check_text(line, TEXT_LIMIT)
    if not text.strip():
        node.reject("the text is empty", hint="Write a text, or omit the block.")
    return _checked(node, text)


def read_switch(node: FileNode) -> bool:
    """Read true or false."""
    if not isinstance(node.value, bool):
        node.reject_value("true or false")
    return node.value


def read_choice(node: FileNode, known: tuple[str, ...]) -> str:
    """Read one of the known words."""
    word = node.value
    if not isinstance(word, str) or word not in known:
        hint = nearest_name_hint(word, known) if isinstance(word, str) else ""
        node.reject_value(translate("one of {}", ", ".join(known)), hint)
    return word


def read_size(node: FileNode, noun: str, low: float, high: float) -> float:
    """Read a size within bounds, mm."""
    return node.number(noun, low, high, hint="Sizes are in millimetres.")


def read_height(node: FileNode) -> float:
    """Read a letter height of GOST 2.304, mm."""
    known = [height for height in HEIGHTS if SMALLEST <= height <= 20.0]
    number = node.number("a letter height in mm")
    if number not in known:
        listed = ", ".join(f"{height:g}" for height in known)
        closest = min(known, key=lambda height: abs(height - number))
        message = "expected a height of GOST 2.304 ({}), got {:g}"
        node.reject(message, listed, number, hint=translate("Take {:g}.", closest))
    return number


def read_heights(node: FileNode) -> tuple[float, ...]:
    """Read one height, or several to try."""
    if isinstance(node.value, list):
        node.array("one to four letter heights", low=1, high=4)
    return node.read_one_or_all(read_height)


def require_list(node: FileNode, noun: str, limit: int) -> None:
    """Make sure that a list is neither empty nor too long."""
    expected = translate("a list of {}, one to {} of them", translate(noun), limit)
    node.array(expected, low=1, high=limit)


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
COLUMNS = {
    kind.letter: kind.symbol
    for kind in (
        QuantityKind.VELOCITY,
        QuantityKind.OMEGA,
        QuantityKind.ACCELERATION,
        QuantityKind.EPSILON,
    )
}


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
    "hatched": read_switch,
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


TOP = (
    "about",
    "formats",
    "smaller",
    "per_sheet",
    "grow",
    "turn",
    "cycle",
    "colour",
    "arrange",
    "sizes",
    "groups",
    "sheets",
    "blocks",
)
SIZES = ("letter", "title", "text", "column", "scheme", "velocity", "acceleration")
SHEET = ("title", "formats")

MAX_PER_SHEET = 36

VIEWS = {"scheme": PlanKind.POSITION, **OF}
ARRANGES: tuple[Arrange, ...] = ("free", "row", "column")
"""Arrangements of a group; a whole sheet may also be in columns."""


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
    colour = file.read("colour", read_switch, absent=False)
    usual = {} if name == SHIPPED[0] else shipped(SHIPPED[0]).sizes
    sizes = file.get("sizes", {}).attempt(partial(_read_sizes, usual=usual))
    if "blocks" not in file:
        file["blocks"].note("missing", hint=EXAMPLE)
    blocks = file.read("blocks", read_entries) or ()
    arranged = _read_groups(file, blocks)
    numbers = {one.sheet for one in blocks}
    sheet_specs = file.read("sheets", partial(_read_sheets, numbers=numbers), {})
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
        colour=needed(colour),
        sizes=needed(sizes),
        arranged=arranged,
        sheet_specs=needed(sheet_specs),
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


def _read_sheets(node: FileNode, numbers: Collection[int]) -> dict[int, SheetSpec]:
    node.table('[sheets.2] title = "План ускорений"')
    node.allow(str(number) for number in sorted(numbers))
    return {int(key): spec for key, spec in node.read_each(_read_sheet).items()}


def _read_sheet(node: FileNode) -> SheetSpec:
    node.table()
    node.allow(SHEET)
    title, formats = node.read("title", read_line, ""), node.read("formats", _read_formats, ())
    return SheetSpec(needed(title), needed(formats))


def _read_groups(file: FileNode, blocks: tuple[BlockSpec, ...]) -> dict[tuple[str, ...], Arrange]:
    """Read the arrangement of groups: tables nested like the names of groups."""
    arranged: dict[tuple[str, ...], Arrange] = {}
    paths = {entry.group[:depth] for entry in blocks for depth in range(1, GROUP_DEPTH + 1)}

    def read_one(node: FileNode, arranges: tuple[Arrange, ...] = ARRANGES) -> Arrange:
        word = read_choice(node, arranges)
        return next(one for one in arranges if one == word)

    def read_level(node: FileNode, group: tuple[str, ...]) -> None:
        node.table('arrange = "row"')
        inner = {p[-1]: None for p in sorted(paths) if len(p) == len(group) + 1 and p[:-1] == group}
        node.allow((*GROUP, *inner) if group else inner)
        for key in inner:
            node.read(key, partial(read_level, group=(*group, key)))
        if "arrange" in node and group:
            arranged[group] = node.read("arrange", read_one) or "free"

    if "arrange" in file:
        arranged[()] = (
            file.read("arrange", partial(read_one, arranges=(*ARRANGES, "columns"))) or "free"
        )
    file.read("groups", partial(read_level, group=()))
    return arranged
