"""Shipped problem files (банк задач) and ready files of the common families."""

from __future__ import annotations

import re
import tomllib
from collections import Counter
from functools import cache
from pathlib import Path
from typing import Any

from msgspec import Struct

from planmethod.languages import catalogue
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode
from planmethod.problem.reader import apply_variant, read_variants
from planmethod.problem.source import parse
from planmethod.problem.toml import value_text

MACHINES = ("shaper", "press", "crusher", "conveyor", "engine")
"""Names of those that have loads, a cycle and a flywheel, too."""

FAMILIES = (
    "slider-crank", "four-bar", "slotted-link", "swinging-block", "sine", "six-link",
    "driving-slider", "RRR+RRP", "RRP+RPR", "RRP+PRP", "RPR+RPP", "RRR+RPR", "RRR+RRR",
    "moving-guide", "whitworth", "toggle-press", "v-engine", "oscillating-cylinder",
    "pantograph", "watt", "stephenson", *MACHINES, "project",
)  # fmt: skip
"""Names of those of linkages; their meanings are in `planmethod.note.wording`."""

OTHER_FAMILIES = (
    "ordinary-train",
    "planetary-train",
    "differential-train",
    "meshing",
    "moving-point",
    "cam",
    "cam-oscillating",
)
"""Names of those of the other kinds of problem."""


SOURCE_LANGUAGE = "ru"
"""Language that the templates are written in."""


def template(family: str, lang: str = SOURCE_LANGUAGE) -> str:
    """Return a commented problem file of a family in a language, ready to edit.

    Raises
    ------
    KeyError
        The family is none of these.
    """
    if family not in (*FAMILIES, *OTHER_FAMILIES):
        raise KeyError(family)
    from importlib.resources import files  # not for those who only read

    source = files("planmethod.problem") / "templates" / f"{family}.toml"
    text = source.read_text(encoding="utf-8")
    return text if lang == SOURCE_LANGUAGE else _translated(text, lang)


def _translated(text: str, lang: str) -> str:
    """Return a template with its comments and texts in another language."""
    phrases = catalogue(lang, "templates")

    def line_of(line: re.Match[str]) -> str:
        keys, comment = line["keys"], line["comment"]
        keys = re.sub(r'"([^"]*)"', lambda text: f'"{phrases.get(text[1], text[1])}"', keys)
        return f"{keys}{line['sign']}{phrases.get(comment, comment)}"

    return re.sub(
        r'^(?P<keys>(?:[^#"\n]|"[^"\n]*")*)(?P<sign>#? ?)(?P<comment>.*)$',
        line_of,
        text,
        flags=re.M,
    )


def schema_text(lang: str) -> str:
    """Return the JSON Schema of problem files, with descriptions in a language (схема файла)."""
    from importlib.resources import files

    name = "schema.json" if lang == "en" else f"schema.{lang}.json"
    return (files("planmethod.problem") / name).read_text(encoding="utf-8")


LINKAGE = "linkage"
"""Kind of the problems that are linkages; the others are called as their table is."""

DYADS = {"PRR": "RRP", "PPR": "RPP"}
"""Other ways to write a dyad."""


class ShippedTask(Struct, frozen=True):
    """A shipped problem file (задача банка).

    Attributes
    ----------
    name : str
        What it is called on the command line: ``levers-13``.
    file : str
        Path below the folder of the problems.
    kind : str
        ``linkage``, or the table of the kind.
    title, source : str
    groups : tuple of str
        Signatures of the Assur groups of a linkage in the order of kinematic analysis.
    variants : tuple of str
    reading : str
        ``one of several`` where the figure is lost and the scheme is one of those that fit; or
        empty.
    """

    name: str
    file: str
    kind: str
    title: str
    source: str
    groups: tuple[str, ...]
    variants: tuple[str, ...]
    reading: str = ""

    @property
    def structure(self) -> str:
        """Groups in one word: ``RRR+RRP``; empty where there are none."""
        return "+".join(self.groups)

    @property
    def text(self) -> str:
        """The problem file as it is shipped."""
        return (home() / self.file).read_text(encoding="utf-8")

    def has(self, groups: tuple[str, ...]) -> bool:
        """Return whether the linkage has these groups one after the other."""
        starts = range(len(self.groups) - len(groups) + 1)
        return any(self.groups[k : k + len(groups)] == groups for k in starts)


def home() -> Path:
    """Return the folder of the problems: in the installed package, or beside its source."""
    package = Path(__file__).parents[1]
    inside = package / "problems"
    return inside if inside.is_dir() else package.parent / "problems"


@cache
def tasks() -> tuple[ShippedTask, ...]:
    """Return all of them as the index has them: by kind, linkages by structure."""
    import json  # not for those who only read a problem

    rows: list[dict[str, Any]] = json.loads((home() / "index.json").read_text(encoding="utf-8"))
    for row in rows:
        row |= {key: tuple(row[key]) for key in ("groups", "variants")}
    return tuple(ShippedTask(**row) for row in rows)


def groups_of(written: str) -> tuple[str, ...]:
    """Return the groups of ``rrr+PRR`` as the structural analysis writes them: RRR, RRP."""
    parts = re.split(r"[+,\s]+", written.strip().upper())
    return tuple(DYADS.get(part, part) for part in parts)


def text_for(task: ShippedTask, variant: str | None) -> str:
    """Return the text of a task to start from; with a variant, its values in place of the base.

    Raises
    ------
    KeyError
        The task has no such variant.
    """
    text = re.sub(r"\A#:schema .*\n", "", task.text)
    if variant is None:
        return text
    table = parse(text, name=task.file)
    overrides = read_variants(FileNode(Faults(), table))[variant]
    left_out = {"variants"}
    if apply_variant(table, overrides).get("published") != table.get("published"):
        left_out.add("published")
    tables = [t for t in _tables(text) if t.name.split(".")[0] not in left_out]
    for path, value in overrides.items():
        _set_value(tables, path, value)
    return "\n".join(line for t in tables for line in (*t.before, *t.lines)).rstrip() + "\n"


class _Table(Struct):
    """A table of a file as text: comments over it, the header with its lines, and its name.

    The first one has no header; of an array of tables each is called by its number too.
    """

    name: str
    before: list[str]
    lines: list[str]


_HEADER = r"\[{1,2}\s*([^\W\d][\w.\-\"'\s]*)\]{1,2}\s*(?:#.*)?$"


def _tables(text: str) -> list[_Table]:
    """Return the text in tables; comments and blank lines over a header go with it."""
    found, count = [_Table("", [], [])], Counter[str]()
    for line in text.splitlines():
        header = re.match(_HEADER, line)
        if header is None:
            found[-1].lines.append(line)
            continue
        name = re.sub(r"[\s\"']", "", header[1])
        if line.startswith("[["):
            count[name] += 1
            name += f".{count[name] - 1}"
        elif (array := name.split(".")[0]) in count:
            name = name.replace(array, f"{array}.{count[array] - 1}", 1)
        last = found[-1].lines
        before: list[str] = []
        while last and (not last[-1].strip() or last[-1].startswith("#")):
            before.insert(0, last.pop())
        found.append(_Table(name, before, [line]))
    return found


def _set_value(tables: list[_Table], path: tuple[str, ...], value: object) -> None:
    """Write a value at a path: over the existing one, or as a new line of its table."""
    whole = ".".join(path)
    tables[:] = [t for t in tables if not f"{t.name}.".startswith(f"{whole}.")]
    for depth in range(len(path) - 1, -1, -1):
        key = ".".join(path[depth:])
        for table in tables:
            if table.name != ".".join(path[:depth]):
                continue
            for k, line in enumerate(table.lines):
                if re.match(rf"{re.escape(key)}\s*=", line):
                    end, remark = _entry(table.lines, k)
                    table.lines[k:end] = [f"{key} = {value_text(value)}{remark}"]
                    return
    for depth in range(len(path) - 1, 0, -1):
        for table in tables:
            if table.name == ".".join(path[:depth]):
                table.lines.append(f"{'.'.join(path[depth:])} = {value_text(value)}")
                return
    tables.append(
        _Table(path[0], [""], [f"[{'.'.join(path[:-1])}]", f"{path[-1]} = {value_text(value)}"])
    )


def _entry(lines: list[str], start: int) -> tuple[int, str]:
    """Return the end of an entry that starts on a line, and the remark on its last line."""
    end, whole = start, ""
    while True:
        whole, end = f"{whole}{lines[end]}\n", end + 1
        try:
            value = tomllib.loads(whole)
            break
        except tomllib.TOMLDecodeError:
            continue
    for mark in re.finditer(r"(?<!\s)\s*#", whole):
        try:
            if tomllib.loads(whole[: mark.start()]) == value:
                return end, whole[mark.start() :].rstrip("\n")
        except tomllib.TOMLDecodeError:
            continue
    return end, ""
