"""Composition files (файлы компоновки): read with all faults at once, like problem files."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from functools import cache
from pathlib import Path

from planmethod.errors import CompositionError, LayoutError, ProblemError
from planmethod.languages import LANGUAGES, translate
from planmethod.paper import BASIC, paper_format
from planmethod.plans.model import PlanKind
from planmethod.problem.fields import (
    Faults,
    Table,
    read_integer,
    read_keys,
    read_table,
)
from planmethod.problem.names import joined, nearest_name_hint, segment, short
from planmethod.problem.source import parse, read_source
from planmethod.render.layout.cuttings import Arrange
from planmethod.render.sheets.composer import Sizes
from planmethod.render.sheets.composition.entries import GROUP, GROUP_DEPTH, OF, read_entries
from planmethod.render.sheets.composition.values import (
    read_choice,
    read_height,
    read_line,
    read_list,
    read_size,
    read_switch,
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
        faults = Faults()
        faults.add("", "neither a layout nor a file has this name", hint)
        raise CompositionError(str(source), faults.listed)
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
    faults = Faults()
    given = read_keys(faults, "", table, TOP)
    about = read_line(faults, "about", given.get("about", ""))
    formats = _read_formats(faults, given.get("formats", ["A3", "A2", "A1", "A0"]))
    smaller = _read_formats(faults, given["smaller"], "smaller") if "smaller" in given else ()
    per_sheet = _read_per_sheet(faults, given.get("per_sheet", [12, 6, 4, 2, 1]))
    grow = read_switch(faults, "grow", given.get("grow", False))
    turn = read_switch(faults, "turn", given.get("turn", False))
    cycle = read_switch(faults, "cycle", given.get("cycle", turn))
    sizes = _read_sizes(faults, given.get("sizes", {}), is_complete=name == SHIPPED[0])
    blocks = read_entries(faults, given.get("blocks"))
    made = Composition(
        name=name,
        about=about,
        formats=formats,
        smaller=smaller,
        per_sheet=per_sheet,
        grow=grow,
        turn=turn,
        cycle=cycle,
        sizes=sizes,
        arranged=_read_groups(faults, given, blocks),
        titles=_read_sheets(faults, given.get("sheets", {}), {entry.sheet for entry in blocks}),
        blocks=blocks,
    )
    if faults:
        raise CompositionError(name, faults.listed)
    return made


def _read_formats(faults: Faults, value: object, key: str = "formats") -> tuple[str, ...]:
    found: list[str] = []
    for k, name in enumerate(read_list(faults, key, value, "paper formats", 20)):
        path = f"{key}[{k}]"
        if not isinstance(name, str):
            faults.expected(path, "a paper format", name, 'For example: "A2".')
            continue
        try:
            found.append(paper_format(name).name)
        except LayoutError:
            faults.add(
                path,
                translate("unknown paper format '{}'", short(name)),
                'For example: "A2", "A4x3".',
            )
    return tuple(dict.fromkeys(found))


def _read_per_sheet(faults: Faults, value: object) -> tuple[int, ...]:
    found: list[int] = []
    for k, item in enumerate(read_list(faults, "per_sheet", value, "numbers of positions", 12)):
        number = read_integer(faults, f"per_sheet[{k}]", item, 1, MAX_PER_SHEET)
        if number is not None:
            found.append(number)
    if found != sorted(found, reverse=True):
        faults.add("per_sheet", "expected falling numbers", "For example: [12, 6, 4, 2, 1].")
    return tuple(found)


def _read_sizes(faults: Faults, value: object, *, is_complete: bool) -> dict[str, Sizes]:
    """Read the sizes by format; defaults are those of the first shipped composition."""
    sizes = {} if is_complete else dict(shipped(SHIPPED[0]).sizes)
    table = read_table(faults, "sizes", value, "A2 = { text = 5 }") or {}
    for name, asked in read_keys(faults, "sizes", table, BASIC).items():
        path = f"sizes.{name}"
        given = read_keys(faults, path, read_table(faults, path, asked) or {}, SIZES)
        known = sizes.get(name)
        values = {key: getattr(known, key) for key in SIZES[:4]} if known else {}
        boxes = dict(known.boxes) if known else {}
        for key, item in given.items():
            at = f"{path}.{key}"
            if key in VIEWS:
                pair = item if isinstance(item, list) and len(item) == 2 else [None, None]
                if pair is not item:
                    faults.expected(at, "[width, height] in mm", item)
                    continue
                ends = [
                    read_size(faults, f"{at}[{k}]", side, "a side", 10.0, 1200.0)
                    for k, side in enumerate(pair)
                ]
                if ends[0] is not None and ends[1] is not None:
                    boxes[VIEWS[key]] = (ends[0], ends[1])
            elif key == "column":
                values[key] = read_size(faults, at, item, "a width", 40.0, 1200.0)
            else:
                values[key] = read_height(faults, at, item)
        if None not in values.values() and len(values) == 4:
            sizes[name] = Sizes(**values, boxes=tuple(boxes.items()))
    return sizes


def _read_sheets(faults: Faults, value: object, numbers: set[int]) -> dict[int, str]:
    table = read_table(faults, "sheets", value, '[sheets.2] title = "План ускорений"') or {}
    known = tuple(str(number) for number in sorted(numbers))
    titles: dict[int, str] = {}
    for key, asked in read_keys(faults, "sheets", table, known).items():
        path = f"sheets.{key}"
        given = read_keys(faults, path, read_table(faults, path, asked) or {}, SHEET)
        if "title" in given:
            titles[int(key)] = read_line(faults, f"{path}.title", given["title"])
    return titles


def _read_groups(
    faults: Faults, document: Table, blocks: tuple[BlockSpec, ...]
) -> dict[tuple[str, ...], Arrange]:
    """Read the arrangement of groups: tables nested like the names of groups."""
    arranged: dict[tuple[str, ...], Arrange] = {}
    paths = {entry.group[:depth] for entry in blocks for depth in range(1, GROUP_DEPTH + 1)}

    def read_one(path: str, value: object, group: tuple[str, ...]) -> None:
        word = read_choice(faults, path, value, ARRANGES)
        arranged[group] = next((way for way in ARRANGES if way == word), "free")

    def read_level(path: str, value: object, group: tuple[str, ...]) -> None:
        table = read_table(faults, path, value, 'arrange = "row"') or {}
        inner = {p[-1]: None for p in sorted(paths) if len(p) == len(group) + 1 and p[:-1] == group}
        known = (*GROUP, *inner) if group else tuple(inner)
        for key, item in read_keys(faults, path, table, known).items():
            at = joined(path, segment(key))
            if key in inner:
                read_level(at, item, (*group, key))
            else:
                read_one(at, item, group)

    if "arrange" in document:
        read_one("arrange", document["arrange"], ())
    if "groups" in document:
        read_level("groups", document["groups"], ())
    return arranged
