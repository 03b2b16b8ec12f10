"""Facts of outputs: what a person reads in them, coarse enough to be compared line by line.

The facts of a drawing are its inscriptions, its views, and for each kind of item the count, the
bounds and the mean place, mm; those of JSON and CSV are named values; those of pages are texts and
counts of elements; those of other texts are their lines. Numbers have six digits. Rows that differ
in their numbers alone are thinned; every column and every text stays.
"""

from __future__ import annotations

import csv
import json
import re
import shlex
from ast import literal_eval
from collections import Counter, defaultdict
from collections.abc import Iterable, Iterator, Mapping
from difflib import SequenceMatcher
from itertools import groupby
from math import dist
from pathlib import Path
from typing import Any

from produced import GENERAL, PROBLEMS, run_command, workplace

FOLDER = Path(__file__).resolve().parent / "facts"

# Which outputs have facts -------------------------------------------------------------------------

DRAWN = ("animate", "live", "note", "project", "sheet", "sketch")
"""Commands that draw: one language of each layout is enough, the texts are in both elsewhere."""

SAME_KIND = {"levers": "linkages", "press": "machines"}
"""Folders with the problems of another one; what is drawn of a machine is that of a linkage."""

VALUES = ("--ask", "--covariance", "--format", "--lang", "--layout", "--paper", "--scheme")
"""Options whose values make another combination; of the others the names alone."""

MORE_ROWS = ("--all-variants", "--partial")
"""Options that add rows to an output that is there without them."""

SHORTEST = 1000
"""Bytes below which a command that draws has refused."""


def find_combination(name: str, size: int) -> tuple[str, ...]:
    """Return kind of problem, command, layout and language of an output of so many bytes."""
    group, _, line = name.partition(": ")
    folder = group.partition("/")[0]
    kind, words = SAME_KIND.get(folder, folder), list(_select_words(line))
    command = words[0]
    if command in DRAWN and size < SHORTEST:
        return kind, command, "refused"
    if command == "project" or (command == "check" and kind == GENERAL):  # seconds each
        return kind, command
    if command in DRAWN:
        kind = "linkages" if kind == "machines" else kind
        words = [word for word in words if not word.startswith("--lang")]
    return (*words,) if command == "lint" else (kind, *words)


def _select_words(line: str) -> Iterator[str]:
    """Yield the arguments of a command line and its options, with their values if they matter."""
    words = shlex.split(line)
    while words:
        word = words.pop(0)
        value = []
        if word.startswith("-") and words and not words[0].startswith("--"):
            value = [words.pop(0)]
        if word.startswith("-") and (word in MORE_ROWS or (value and word not in VALUES)):
            continue
        yield " ".join([word, *value])


def select_outputs(sums: Mapping[str, str]) -> list[str]:
    """Return the outputs that have facts: of each combination that of the smallest problem.

    Of the two projects of a machine it is the larger one: its strokes are not equal.
    """
    combinations = defaultdict(list)
    for name, total in sums.items():
        combinations[find_combination(name, int(total.split()[1]))].append(name)
    return sorted(min(names, key=_sort_key) for names in combinations.values())


def _sort_key(name: str) -> tuple[int, str]:
    group, _, line = name.partition(": ")
    size = 0 if group == GENERAL else (PROBLEMS / f"{group}.toml").stat().st_size
    return -size if line.startswith("project") else size, name


def make_facts(names: Iterable[str]) -> dict[str, list[str]]:
    """Return the facts of outputs, made now, by their names."""
    made = {}
    for group, own in groupby(sorted(names), key=lambda name: name.partition(": ")[0]):
        with workplace():
            for name in own:
                made[name] = extract_facts(name, run_command(group, name.partition(": ")[2]))
    return made


# Their files --------------------------------------------------------------------------------------


def read_facts() -> dict[str, list[str]]:
    """Return the facts that were taken, by name of the output."""
    outputs = (
        output.splitlines()
        for path in FOLDER.glob("*.txt")
        for output in path.read_text("utf-8").split("\n\n")
    )
    facts = {name: [line[2:] for line in lines] for name, *lines in filter(None, outputs)}
    return dict(sorted(facts.items()))


def write_facts(facts: Mapping[str, list[str]]) -> None:
    """Take facts: a file for each command."""
    texts: defaultdict[str, str] = defaultdict(str)
    for name in sorted(facts):
        word = name.partition(": ")[2].split()[0]
        lines = "".join(f"  {fact}\n" for fact in facts[name])
        texts["help" if word.startswith("-") else word] += f"{name}\n{lines}\n"
    FOLDER.mkdir(exist_ok=True)
    for path in FOLDER.glob("*.txt"):
        if path.stem not in texts:
            path.unlink()
    for command, text in texts.items():
        (FOLDER / f"{command}.txt").write_text(text, "utf-8")


def find_differing(old: Mapping[str, list[str]], new: Mapping[str, list[str]]) -> list[str]:
    """Return the names of the outputs whose facts are changed, added or gone."""
    return [name for name in sorted({*old, *new}) if old.get(name) != new.get(name)]


def describe_changes(old: list[str], new: list[str], most: int = 40) -> Iterator[str]:
    """Yield what is changed in the facts of an output, old → new, so many lines at most."""
    lines = []
    for _, i, j, k, m in SequenceMatcher(None, old, new, autojunk=False).get_opcodes():
        if old[i:j] == new[k:m]:
            continue
        if j - i == m - k:
            lines += [f"  {a}  →  {b}" for a, b in zip(old[i:j], new[k:m], strict=True)]
        else:
            lines += [f"  - {one}" for one in old[i:j]] + [f"  + {one}" for one in new[k:m]]
    yield from lines[:most]
    if len(lines) > most:
        yield f"  ... {len(lines) - most} lines more"


# Texts --------------------------------------------------------------------------------------------

FIRST, STEP = 3, 12
"""Of rows that differ in their numbers alone so many are facts, and then one of so many."""

NUMBER = re.compile(r"[-−]?\d+(?:[.,]\d+)?(?:[eE][-+]?\d+)?")
LONG = re.compile(r"-?\d+\.\d+(?:[eE][-+]?\d+)?|-?\d+[eE][-+]?\d+")


def extract_facts(name: str, text: str) -> list[str]:
    """Return the facts of the text of an output, in its order."""
    first, *files = re.split(r"(?m)^(?=--- )", text)
    head = re.match(r"exit code .*\n", first)
    facts = [] if head is None else [head[0].strip()]
    first = first if head is None else first[head.end() :]
    is_table = "--csv" in name or "--covariance" in name
    facts += _list_columns(first) if is_table and first else _describe_content(first)
    for file in files:
        title, _, content = file.partition("\n")
        facts += [title, *_describe_content(content)]
    return facts


def _describe_content(text: str) -> Iterator[str]:
    if text.startswith(("{", "[")):
        yield from _list_values(json.loads(text), "", set(), is_row=True)
        return
    for part in re.split(r"(?s)(<svg> sheet.*?</svg>\n?)", text):
        if part.startswith("<svg> sheet"):
            yield from _describe_drawing(part.splitlines()[:-1])
        elif part.startswith("<"):
            yield from _describe_page(part)
        else:
            yield from _thin(part.splitlines())


def _round_numbers(text: str) -> str:
    return LONG.sub(lambda number: f"{float(number[0]):.6g}", text)


def _is_sampled(row: int) -> bool:
    return row < FIRST or row % STEP == 0


def _thin(lines: Iterable[str]) -> Iterator[str]:
    rows: Counter[str] = Counter()
    for line in lines:
        words = " ".join(line.split())
        shape = NUMBER.sub("#", words)
        if words and (shape == "#" or _is_sampled(rows[shape])):  # a number alone is a cell
            yield _round_numbers(words)
        rows[shape] += 1


def _describe_page(text: str) -> Iterator[str]:
    """Yield the texts of HTML or SVG, then the count and the mean number of each element."""
    pieces = re.split(r"<([^<>]*)>", re.sub(r"(?s)<style>.*?</style>", "<style>", text))
    yield from _thin(line for piece in pieces[::2] for line in piece.splitlines())
    counts: Counter[str] = Counter()
    numbers: defaultdict[str, list[float]] = defaultdict(list)
    for tag in pieces[1::2]:
        if tag[:1] not in "/!?":
            element = " ".join([re.split(r"[\s/]", tag)[0], *re.findall(r'\bclass="[^"]*"', tag)])
            counts[element] += 1
            numbers[element] += [float(number) for number in re.findall(r"-?\d+\.?\d*", tag)]
    for element, count in counts.items():
        mean = sum(numbers[element]) / max(len(numbers[element]), 1)
        yield f"<{element}>: {count}, mean of {len(numbers[element])} numbers {mean:.6g}"


def _format_value(value: object) -> str:
    return f"{value:.6g}" if isinstance(value, float) else json.dumps(value, ensure_ascii=False)


def _list_values(
    value: Any, path: str, texts: set[tuple[str, str]], *, is_row: bool
) -> Iterator[str]:
    """Yield the values of JSON with their paths; in rows that are left out only new texts."""
    if isinstance(value, dict):
        for key, one in value.items():
            yield from _list_values(one, f"{path}.{key}" if path else key, texts, is_row=is_row)
    elif isinstance(value, list) and any(isinstance(one, dict | list) for one in value):
        yield f"{path}: {len(value)} rows"
        for k, one in enumerate(value):
            yield from _list_values(one, f"{path}[{k}]", texts, is_row=is_row and _is_sampled(k))
    elif isinstance(value, list):
        if is_row:
            some = (
                _format_value(one)
                for k, one in enumerate(value)
                if len(value) <= STEP or _is_sampled(k)
            )
            yield f"{path}: {len(value)} values {', '.join(some)}"
    else:
        text = re.sub(r"\[\d+\]", "", path), _format_value(value)
        if is_row or (isinstance(value, str) and text not in texts):
            yield f"{path}: {text[1]}"
        texts.add(text)


def _list_columns(text: str) -> Iterator[str]:
    """Yield the columns of CSV: some numbers and all texts of each."""
    head, *rows = csv.reader(text.splitlines())
    yield f"{len(rows)} rows"
    for name, *cells in zip(head, *rows, strict=True):
        values = (
            cell for k, cell in enumerate(cells) if _is_sampled(k) or not NUMBER.fullmatch(cell)
        )
        yield f"{name}: {', '.join(dict.fromkeys(map(_round_numbers, values)))}"


# Drawings -----------------------------------------------------------------------------------------

PLACE = r"-?\d+\.\d\d,-?\d+\.\d\d"
ITEMS = (
    re.compile(rf"(?P<kind>(?:stroke|fill) .*?)(?P<places>(?: {PLACE})+)"),
    re.compile(rf"(?P<kind>(?:arc|disc) .*?) (?P<places>{PLACE}) .*"),
    re.compile(
        r"text (?P<run>'(?:[^'\\]|\\.)*'|\"(?:[^\"\\]|\\.)*\")"
        rf"(?: (?P<places>{PLACE}))? (?P<kind>\S+) \S+ ?(?P<label>.*?)(?: in(?: -?\d+\.\d\d){{4}})?"
    ),
)
"""Lines of a display list, as `produced` writes them."""

MARKUP = str.maketrans("", "", "\\_^{} ")


def _describe_drawing(lines: list[str]) -> Iterator[str]:
    """Yield the inscriptions of a display list, its kinds of items, and its views."""
    yield lines[0].removeprefix("<svg> ")
    runs: list[tuple[str, str]] = []
    counts: Counter[str] = Counter()
    places: defaultdict[str, list[tuple[int, int]]] = defaultdict(list)
    others = []
    for line in lines[1:]:
        item = next(filter(None, (pattern.fullmatch(line) for pattern in ITEMS)), None)
        if item is None:
            others.append(line)
            continue
        kind = re.sub(r" ?part-of:.*|@\S+", " part", item["kind"])
        if line.startswith("text"):
            kind = f"text {kind}"
            runs.append((item["label"], literal_eval(item["run"])))
        counts[kind] += 1
        places[kind] += map(_parse_place, (item["places"] or "").split())
    yield from _join_inscriptions(runs)
    for kind, count in counts.items():
        axes = zip("xy", zip(*places[kind], strict=True), strict=False)
        yield ", ".join(
            [f"{kind}: {count}", *(f"{axis} {_describe_range(at)}" for axis, at in axes)]
        )
    yield from map(_describe_view, others)


def _join_inscriptions(runs: list[tuple[str, str]]) -> Iterator[str]:
    """Yield inscriptions of runs with their labels; where both differ the text beside the label."""
    text = ""
    for k, (label, run) in enumerate(runs):
        text += run
        if label != text and runs[k + 1 : k + 2] and runs[k + 1][0] == label:
            continue
        letters = text.translate(MARKUP)
        end = label.translate(MARKUP)[-len(letters) :]
        # Of a power with an index the letters stand in another order.
        yield f"text {label}" if sorted(end) == sorted(letters) else f"text {text} ({label})"
        text = ""


def _parse_place(place: str) -> tuple[int, int]:
    x, y = place.replace(".", "").split(",")
    return int(x), int(y)


def _describe_range(hundredths: tuple[int, ...]) -> str:
    """Return the bounds to a millimetre and the mean to a hundredth."""
    low, high = ((one + 50) // 100 for one in (min(hundredths), max(hundredths)))
    return f"{low}..{high} mean {sum(hundredths) / len(hundredths) / 100:.2f}"


def _describe_view(line: str) -> str:
    """Return the line of a view with its bounds, or of a segment measured on it with its length."""
    if view := re.fullmatch(r"view (.*?)((?: -?\d+\.\d\d){4}) (.*)", line):
        bounds = (str((_parse_place(f"{one},0")[0] + 50) // 100) for one in view[2].split())
        return f"view {view[1]} {' '.join(bounds)} {_round_numbers(view[3])}"
    if span := re.fullmatch(rf"  span (.*) ({PLACE}) ({PLACE}) (\S+)", line):
        start, end = _parse_place(span[2]), _parse_place(span[3])
        return f"segment {span[1]}: {dist(start, end) / 100:.1f} mm, {_round_numbers(span[4])}"
    return line
