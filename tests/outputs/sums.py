"""The sums of all outputs, and what differs from them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from difflib import unified_diff
from hashlib import sha256
from pathlib import Path

from produced import outputs, workplace

HERE = Path(__file__).resolve().parent
SUMS = HERE / "sums.txt"


def make_texts(group: str, wanted: Callable[[str], object] = bool) -> dict[str, str]:
    """Return the texts of the outputs of a group by name; of those that are wanted."""
    with workplace():
        return {name: make() for name, make in outputs(group) if wanted(name)}


def compute_sum(text: str) -> str:
    """Return the sum of a text: hash and size."""
    data = text.encode()
    return f"{sha256(data).hexdigest()[:10]} {len(data)}"


def read_sums() -> dict[str, str]:
    """Return the sums that were taken, by name of the output."""
    lines = SUMS.read_text("utf-8").splitlines() if SUMS.exists() else []
    rows = (line.split(" ", 2) for line in lines)
    return {name: f"{digest} {size}" for digest, size, name in rows}


def write_sums(sums: Mapping[str, str]) -> None:
    """Take sums."""
    SUMS.write_text("".join(f"{sums[name]} {name}\n" for name in sorted(sums)), "utf-8")


def compare_sums(sums: Mapping[str, str], stored: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Yield what differs: the name of an output, and whether it is changed, added or gone."""
    for name in sorted({*sums, *stored}):
        if name not in stored:
            yield name, "added"
        elif name not in sums:
            yield name, "gone"
        elif sums[name] != stored[name]:
            yield name, "changed"


def difference(name: str, before: str, after: str, most: int) -> Iterator[str]:
    """Yield the lines of a unified difference, so many at most."""
    lines = list(
        unified_diff(before.splitlines(), after.splitlines(), name, name, lineterm="", n=1)
    )
    yield from lines[:most]
    if len(lines) > most:
        yield f"... {len(lines) - most} lines more"


def describe_differences(group: str) -> str:
    """Return what of a group differs from the sums that were taken; nothing if all is the same."""
    sums = {name: compute_sum(text) for name, text in make_texts(group).items()}
    stored = {name: one for name, one in read_sums().items() if name.startswith(f"{group}: ")}
    lines = [f"{what}: {name}" for name, what in compare_sums(sums, stored)]
    if lines:
        lines.append(f"To look: make outputs SHOW='^{group}: '. To take: make outputs TAKE=1.")
    return "\n".join(lines)
