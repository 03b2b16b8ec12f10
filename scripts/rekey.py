"""Replace English sentences in the code, in the keys of other languages and in the English texts.

``python -m scripts.rekey FILE.csv`` reads the columns ``old`` and ``new``; the columns ``file`` and
``key`` restrict a row to one text of ``planmethod/note/wording/en``. A row whose old sentence is
not found is reported and skipped. A conflict is reported as well, and then no file is changed.
"""

from __future__ import annotations

import ast
import csv
import inspect
import json
import re
import sys
from collections import Counter, defaultdict
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).resolve().parent.parent

WIDTH = 100
"""Characters of a line of code."""

_WORD = r'(?:[\w-]+|"(?:[^"\\\n]|\\.)*")'
_TOML_STRING = re.compile(
    rf"(?m)^(?P<key>{_WORD}(?:\.{_WORD})*) = |#[^\n]*"
    r'|(?P<text>"""(?:[^\\]|\\.)*?"""|"(?:[^"\\\n]|\\.)*"|\'[^\'\n]*\')'
)
_PLACE = re.compile(r"\{\{|\}\}|\{(\w*(?:[.\[][\w.\[\]]*)?)[^{}]*\}")


class Row(NamedTuple):
    """Sentence to replace, and its replacement."""

    old: str
    new: str
    file: str = ""
    key: str = ""


class Edit(NamedTuple):
    """Replacement of some bytes of a file."""

    path: Path
    start: int
    end: int
    text: str


def read_rows(path: Path) -> list[Row]:
    """Read the rows of a CSV file."""
    with path.open(encoding="utf-8", newline="") as file:
        return [
            Row(row["old"], row["new"], row.get("file") or "", row.get("key") or "")
            for row in csv.DictReader(file)
        ]


def find_edits(rows: list[Row], root: Path) -> tuple[list[Edit], list[str], list[str]]:
    """Return the edits, the sentences that are not found, and the conflicts."""
    code = _index_code(root)
    keys = _index_keys(root)
    texts = _index_texts(root)
    edits: list[Edit] = []
    missing: list[str] = []
    conflicts: list[str] = []
    for row in rows:
        mine = [] if row.file else [*code.get(row.old, ()), *keys.get(row.old, ())]
        there = [
            (place, edit)
            for place, edit in texts.get(row.old, ())
            if not row.file or (place[0] == row.file and place[1] in (row.key, *row.key.split(".")))
        ]
        if row.old == row.new or not (mine or there):
            missing.append(row.old)
        elif _places(row.old) != _places(row.new):
            conflicts.append(f"other places: {row.old}")
        elif there and not row.file and len(mine) + len(there) > 1:
            names = ", ".join(f"{file} {key}" for (file, key), _ in there)
            conflicts.append(f"more than one meaning ({names}): {row.old}")
        elif mine and (row.new in keys or row.new in code) and row.old in keys:
            conflicts.append(f"the new sentence exists already: {row.new}")
        else:
            edits += [
                Edit(path, start, end, _write(path, start, end, kind, row.new))
                for path, start, end, kind in (*mine, *(edit for _, edit in there))
            ]
    edits = list(dict.fromkeys(edits))
    starts = Counter((edit.path, edit.start) for edit in edits)
    conflicts += [f"two rows: {edit.text}" for edit in edits if starts[edit.path, edit.start] > 1]
    return edits, missing, conflicts


_Found = tuple[Path, int, int, str]


def _index_code(root: Path) -> dict[str, list[_Found]]:
    """Return the string literals of the package by their text."""
    found: dict[str, list[_Found]] = defaultdict(list)
    for path in sorted((root / "planmethod").rglob("*.py")):
        source = path.read_bytes()
        starts = [0]
        for line in source.splitlines(keepends=True):
            starts.append(starts[-1] + len(line))
        for node, kind in _literals(ast.parse(source)):
            assert isinstance(node.value, str)
            text = inspect.cleandoc(node.value) if kind == "docstring" else node.value
            start = starts[node.lineno - 1] + node.col_offset
            end = starts[(node.end_lineno or 0) - 1] + (node.end_col_offset or 0)
            found[text].append((path, start, end, kind))
    return found


def _literals(tree: ast.AST) -> Iterator[tuple[ast.Constant, str]]:
    """Yield string literals, each with how it is used: docstring, argument, other."""
    for node in ast.walk(tree):
        for child in ast.iter_child_nodes(node):
            if isinstance(node, ast.JoinedStr):
                continue  # messages are no f-strings
            if isinstance(child, ast.Constant) and isinstance(child.value, str):
                kinds = {ast.Expr: "docstring", ast.Call: "argument", ast.keyword: "argument"}
                yield child, kinds.get(type(node), "other")


def _index_keys(root: Path) -> dict[str, list[_Found]]:
    """Return the keys of the catalogues of messages."""
    found: dict[str, list[_Found]] = defaultdict(list)
    for path in sorted((root / "planmethod/note/wording").glob("*/messages/*.toml")):
        source = path.read_text("utf-8")
        for match in re.finditer(r'(?m)^("(?:[^"\\\n]|\\.)*") = ', source):
            start, end = (len(source[:at].encode()) for at in match.span(1))
            found[json.loads(match[1])].append((path, start, end, "toml"))
    return found


def _index_texts(root: Path) -> dict[str, list[tuple[tuple[str, str], _Found]]]:
    """Return the texts of the English catalogues, each with its file and key."""
    found: dict[str, list[tuple[tuple[str, str], _Found]]] = defaultdict(list)
    for path in sorted((root / "planmethod/note/wording/en").glob("*.toml")):
        source, key = path.read_text("utf-8"), ""
        for match in _TOML_STRING.finditer(source):
            if match["key"]:
                last = re.findall(_WORD, match["key"])[-1]
                key = json.loads(last) if last[0] == '"' else last
            if not match["text"]:
                continue
            text = match["text"]
            if text.startswith('"""'):
                inside = text[3:-3].removeprefix("\n").replace("\n", "\\n")
                value = json.loads('"' + re.sub(r'(?<!\\)"', r"\"", inside) + '"')
            else:
                value = json.loads(text) if text[0] == '"' else text[1:-1]
            start, end = (len(source[:at].encode()) for at in match.span("text"))
            found[value].append(((path.name, key), (path, start, end, "toml")))
    return found


def _places(sentence: str) -> list[str]:
    """Return the names of the places for facts."""
    named = [match[1] for match in _PLACE.finditer(sentence) if match[1] is not None]
    return named if "" in named else sorted(set(named))


def _write(path: Path, start: int, end: int, kind: str, text: str) -> str:
    """Write a sentence as a literal that replaces the one at a place."""
    source = path.read_bytes()
    before, old = source[:start].decode(), source[start:end].decode()
    if kind == "toml":
        if old.startswith('"""'):
            return f'"""\n{text}"""' if old[3] == "\n" else f'"""{text}"""'
        return json.dumps(text, ensure_ascii=False)
    line = before.rpartition("\n")[2]
    if kind == "docstring":
        margin = " " * len(line)
        shown = text.replace("\\", "\\\\").replace("\b", "\\b").replace("\n", f"\n{margin}")
        close = f"\n{margin}" if "\n" in text else ""
        return re.sub(r"(?m)^ +$", "", f'"""{shown}{close}"""')
    rest = source[end:].decode().partition("\n")[0]
    if len(line + _quote(text) + rest) <= WIDTH and "\n" not in old:
        return _quote(text)
    indent = len(line) if "\n" in old else len(line) - len(line.lstrip()) + 8
    lines, room = [""], WIDTH - indent - 10
    for word in re.findall(r"\s*\S*\n|\s*\S+\s*?(?=\s|$)|\s+", text):
        if lines[-1] and (len(lines[-1] + word) > room or lines[-1].endswith("\n")):
            lines[-1] += word[: len(word) - len(word.lstrip(" "))]
            word = word.lstrip(" ")
            lines.append("")
        lines[-1] += word
    assert "".join(lines) == text
    parts = f"\n{' ' * indent}".join(_quote(part) for part in lines)
    in_brackets = len(lines) == 1 or kind == "argument" or "\n" in old
    return parts if in_brackets else f"({parts})"


def _quote(text: str) -> str:
    """Write a text in double quotes, or in single ones if that saves escapes."""
    double = json.dumps(text, ensure_ascii=False)
    return (
        "'" + double[1:-1].replace('\\"', '"') + "'" if '"' in text and "'" not in text else double
    )


def write_edits(edits: list[Edit]) -> None:
    """Write the edits, in each file from its end on."""
    for edit in sorted(edits, key=lambda edit: edit.start, reverse=True):
        source = edit.path.read_bytes()
        edit.path.write_bytes(source[: edit.start] + edit.text.encode() + source[edit.end :])


def main(names: list[str], root: Path = ROOT) -> int:
    """Replace the sentences of some files; return 1 on a conflict."""
    rows = [row for name in names for row in read_rows(Path(name))]
    edits, missing, conflicts = find_edits(rows, root)
    for sentence in missing:
        print(f"not found: {sentence}")
    for conflict in conflicts:
        print(f"conflict: {conflict}")
    if conflicts:
        return 1
    write_edits(edits)
    print(f"{len(rows) - len(missing)} sentences replaced in {len(edits)} places; run ruff format")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
