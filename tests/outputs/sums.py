"""The net: sums of all outputs, whole texts of a few, and what differs from them."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from difflib import unified_diff
from hashlib import sha256
from pathlib import Path

from produced import is_thinned_out, outputs, workplace

HERE = Path(__file__).resolve().parent
SUMS = HERE / "sums.txt"
TEXTS = HERE / "texts"

WHOLE = (
    "gears/gears-ex1: protocol --lang ru",
    "gears/gears-ex1: sheet --lang ru",
    "gears/gears-ex1: solve --lang ru",
    "gears/gears-ex2: check --key --lang en",
    "gears/gears-ex2: structure --no-drawing --lang ru",
    "general: --lang en --help",
    "general: synthesize crank-rocker --K_v 1.25 --swing 50 --rocker 0.3 --lang ru",
    "general: synthesize slotted --K_v 1.22 --centres 1.08 --lang ru --sheet -o out",
    "general: tasks --lang ru",
    "general: teeth --U 6.5 --lang ru",
    "levers/six-link: audit --lang ru",
    "levers/six-link: solve --lang en",
    "linkages/ex1: sheet --lang ru",
    "linkages/ex1: solve --csv",
    "linkages/ex2: check --key --lang en",
    "linkages/ex2: structure --lang ru",
    "linkages/ex3: protocol --lang en",
    "linkages/ex3: protocol --lang ru",
    "linkages/ex3: solve --json",
    "machines/balanced-crank: solve --lang en",
    "machines/engine: solve --lang ru",
    "meshing/z12-30: protocol --lang ru",
    "meshing/z12-30: solve --lang en",
    "point/k10-satellite: protocol --lang ru",
    "point/k10-satellite: solve --lang ru",
    "press/press: structure --no-drawing --lang en",
)
"""Outputs whose texts are kept, so that a failing test shows what differs."""


def texts_of(group: str, wanted: Callable[[str], object] = bool) -> dict[str, str]:
    """Return the texts of the outputs of a group by name; of those that are wanted."""
    with workplace():
        return {name: make() for name, make in outputs(group) if wanted(name)}


def sum_of(text: str) -> str:
    """Return the sum of a text: hash and size."""
    data = text.encode()
    return f"{sha256(data).hexdigest()[:10]} {len(data)}"


def kept_sums() -> dict[str, str]:
    """Return the sums that were taken, by name of the output."""
    lines = SUMS.read_text("utf-8").splitlines() if SUMS.exists() else []
    rows = (line.split(" ", 2) for line in lines)
    return {name: f"{digest} {size}" for digest, size, name in rows}


def write_sums(sums: Mapping[str, str]) -> None:
    """Take sums."""
    SUMS.write_text("".join(f"{sums[name]} {name}\n" for name in sorted(sums)), "utf-8")


def text_file(name: str) -> Path:
    """Return the file of an output whose text is kept."""
    return TEXTS / f"{re.sub(r'[^A-Za-z0-9.]+', '-', name)}.txt"


def compared(sums: Mapping[str, str], kept: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Yield what differs: the name of an output, and whether it is changed, added or gone."""
    for name in sorted({*sums, *kept}):
        if name not in kept:
            yield name, "added"
        elif name not in sums:
            yield name, "gone"
        elif sums[name] != kept[name]:
            yield name, "changed"


def difference(name: str, before: str, after: str, most: int) -> Iterator[str]:
    """Yield the lines of a unified difference, so many at most."""
    lines = list(
        unified_diff(before.splitlines(), after.splitlines(), name, name, lineterm="", n=1)
    )
    yield from lines[:most]
    if len(lines) > most:
        yield f"... {len(lines) - most} lines more"


def complaint(group: str, *, is_thinned: bool) -> str:
    """Return what of a group differs from what was taken; nothing if all is the same."""

    def wanted(name: str) -> bool:
        return name.startswith(f"{group}: ") and not (is_thinned and is_thinned_out(name))

    texts = texts_of(group, wanted)
    kept = {name: one for name, one in kept_sums().items() if wanted(name)}
    found = dict(compared({name: sum_of(text) for name, text in texts.items()}, kept))
    lines = [f"{what}: {name}" for name, what in found.items()]
    for name in WHOLE:
        if found.get(name) == "changed":
            lines += difference(name, text_file(name).read_bytes().decode(), texts[name], 60)
    if lines:
        lines.append(f"To look: make outputs SHOW='^{group}: '. To take: make outputs TAKE=1.")
    return "\n".join(lines)
