"""A value read off the drawings of a project is the same on its sheets and in its note."""

import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any
from unittest.mock import patch

import pytest
from cases import each, some
from doors import (
    Chapter,
    DocumentItem as Item,
    DocumentStep as Step,
    Drawing,
    Formula,
    Paragraph,
    Part,
    PartName,
    Project,
    Table,
    TableCell,
    TablePart,
    Text,
    get_language,
    inlined,
    kinds_load as load,
    note_document,
    part_drawings,
    settle,
)
from msgspec import Struct
from test_report import FILES, TEMPLATE
from worked import PROBLEMS, ROOT

CAM = """
[cam] # the file of the shaper has none
follower = "translating"
stroke = 0.03
rise = 80
return = 70
upper_dwell = 20
law = "constant-acceleration"
pressure = 30
"""


class Reading(Struct, frozen=True):
    """A number as it is written, and its quantity."""

    symbol: str
    position: int
    text: str


class Grid(Struct, frozen=True):
    """A table: its columns with their heads, and the key of a table of the note."""

    columns: list[tuple[str, list[str]]]
    key: str = ""


NUMBER = re.compile(r"−?\d+(?:,\d+)?(?:·10\^\{−?\d+\})?(?=$|[;.,]$|°|\s(?![−+]))")
SYMBOL = re.compile(r"\(?[^\W\d](?:[_^]\{[^}]*\}|[\w′″])*\)?")
INDEX = re.compile(r"[_^]\{[^}]*\}")


def span(text: str) -> tuple[float, float]:
    """Return the least and the largest number that is written so."""
    mantissa, _, power = text.replace("−", "-").replace(",", ".").partition("·10^")
    places = len(mantissa.partition(".")[2]) or len(mantissa.rstrip("0") or "0") - len(mantissa)
    scale = 10.0 ** int(power.strip("{}") or 0)
    half = 0.5 * 10.0**-places * (1 + 1e-9)
    return (float(mantissa) - half) * scale, (float(mantissa) + half) * scale


def named(symbol: str) -> str:
    """Return a symbol with its lower indices before the upper ones."""
    indices = sorted(INDEX.findall(symbol), key=lambda index: index[0] == "^")
    return INDEX.sub("", symbol) + "".join(indices)


# Stated values ------------------------------------------------------------------------------------


def lines_of(drawing: Drawing) -> Iterator[str]:
    """Yield the inscriptions of a sheet as they were set: small letters are indices.

    A fraction is set above and below its line, which it cuts: its two parts are lines of their own.
    """
    line = ""
    base: Text | None = None
    cut: tuple[str, Text] | None = None
    for item in drawing.items:
        if not isinstance(item, Text):
            continue
        rise = 0.0 if base is None else (item.at - base.at).imag
        if base is not None and item.height < 0.95 * base.height and abs(rise) < base.height:
            line += f"{'_' if rise < 0 else '^'}{{{item.text}}}"
        elif base is not None and abs(rise) < 0.01:
            line += item.text
        elif cut is not None and abs((item.at - cut[1].at).imag) < 0.01:
            yield line
            line, base, cut = f"{cut[0]}…{item.text}", item, None
        else:
            if base is not None and line.endswith("= "):
                cut = line, base
            else:
                yield line
            line, base = item.text, item
    yield line


def stated(lines: Iterable[str], position: int) -> Iterator[Reading]:
    """Yield quantities equated to a number: v_{A} = ω_{1}·l_{OA} = 10·0,1 = 1,000 м/с."""
    for line in lines:
        for piece in re.split(r"[;:(]\s|,\s|\.\s|\.$", line.replace("\u00a0", " ")):
            sides = piece.split(" = ")
            if sides[-1] == "0":
                continue  # an equation, or the name of a curve
            for k, side in enumerate(sides[:-1]):
                symbol = side.rpartition(" ")[2]
                found = next(filter(None, map(NUMBER.match, sides[k + 1 :])), None)
                # Scales and angles belong to one drawing, σ to the quantity before it.
                if found and SYMBOL.fullmatch(symbol) and symbol[0] not in "μφσ":
                    yield Reading(named(symbol), position, found[0])


READ = re.compile(r"[Сс]нято|^По плану|^По картине")
"""Heads of columns with values read; the quantities are in a preceding column."""

BALANCES = ("по планам сил", "по рычагу", "планы сил", "рычаг")
"""Heads of columns with readings of the quantity that heads a column before."""

UNTOLD = ("трени", "Разбег")
"""Titles of sheets whose numbers belong to other motions and forces than those of the note."""

OF_PLANS = ("velocities", "accelerations")
"""Tables of the note with the values read in all positions."""


def tabled(grids: Iterable[Grid], position: int) -> Iterator[Reading]:
    """Yield the readings in columns of tables; ``position`` applies to tables without positions."""
    for grid in grids:
        heads = [head for head, _ in grid.columns]
        places = dict(grid.columns).get("№")
        for k, (head, cells) in enumerate(grid.columns):
            symbols = [head.removesuffix("′")] * len(cells)
            if head in BALANCES:
                balance = next(one for one in reversed(heads[:k]) if "_" in one)
                symbols = [balance] * len(cells)
            elif READ.search(head) and places is None:
                before = [some for _, some in grid.columns[:k]]
                symbols = next(some for some in before[::-1] if not re.match(r"[−—\d]", some[0]))
            elif not head.endswith("′") and not (grid.key in OF_PLANS and k > 1):
                continue
            for row, (symbol, cell) in enumerate(zip(symbols, cells, strict=True)):
                number = NUMBER.match(cell)
                if number is not None:
                    where = position if places is None else int(places[row])
                    # Texts give the size of a balance, and its sense by a word or an arrow.
                    size = number[0].lstrip("−") if head in BALANCES else number[0]
                    yield Reading(named(symbol.partition(", ")[0]), where, size)


def on_sheets(project: Project) -> dict[PartName, list[Reading]]:
    """Return the readings on the sheets of each part."""
    found: dict[PartName, list[Reading]] = {}
    place = TablePart.place
    placed: list[TablePart] = []

    def noted(table: TablePart, corner: complex) -> Any:
        placed.append(table)
        return place(table, corner)

    with patch.object(TablePart, "place", noted):
        for part in project.parts:
            placed.clear()
            found[part.name] = []
            for drawing in part_drawings(project, part, {}):
                if not any(word in drawing.title for word in UNTOLD):
                    found[part.name] += stated(lines_of(drawing), project.calculated)
            grids = [Grid([(c.source.head, [*map(_signed, c.source.cells)]) for c in table.columns])
                     for table in placed]  # fmt: skip
            found[part.name] += tabled(grids, project.calculated)
    return found


def _signed(cell: TableCell) -> str:
    """Return the text of a cell, with a minus sign for a negative sense shown by an arrow."""
    return f"−{cell.text}" if (cell.sense or 0) < 0 else cell.text


def in_note(project: Project) -> Iterator[Reading]:
    position, is_told = project.calculated, True
    for node in note_document(project, get_language("ru")).nodes:
        match node:
            case Chapter(title) | Part(title):
                is_told = "Трение" not in title
            case Table():
                columns = [(one, [row[k] for row in node.rows]) for k, one in enumerate(node.head)]
                yield from tabled([Grid(columns, node.key)], position)
            case Formula(text) | Item(text) | Paragraph(text) if is_told:
                yield from stated([inlined(text)], position)
            case Step(lines):
                yield from stated(lines, position)
            case _:
                pass


# Comparison --------------------------------------------------------------------------------------


def compared(project: Project) -> tuple[dict[PartName, int], list[str]]:
    """Return how many numbers of each part the note has as well, and those that are others."""
    told = defaultdict[tuple[str, int], set[str]](set)
    for one in in_note(project):
        told[one.symbol, one.position].add(one.text)
    counts, others = {}, []
    for part, readings in on_sheets(project).items():
        both = [one for one in dict.fromkeys(readings) if (one.symbol, one.position) in told]
        counts[part] = len(both)
        for one in both:
            low, high = span(one.text)
            ranges = map(span, told[one.symbol, one.position])
            if not any(a <= high and low <= b for a, b in ranges):
                others.append(f"{part.value}: {one}, note {told[one.symbol, one.position]}")
    return counts, others


LEAST = {
    PartName.KINEMATICS: 40,
    PartName.FORCES: 20,
    PartName.FLYWHEEL: 15,
    PartName.GEARS: 10,
    PartName.MESHING: 20,
    PartName.CAM: 5,
}
"""Least number of values that sheets and note of a usual project share, by part."""

PROJECTS = [
    TEMPLATE,
    *sorted((ROOT / "tests/data/projects").glob("*.toml")),
    *sorted((PROBLEMS / "press").glob("*.toml")),
    *sorted((PROBLEMS / "machines").glob("*.toml")),
]


def test_a_project_gives_every_number_one_value(tmp_path: Path) -> None:
    """All sheets and the note of one project: no smaller part has both, so the test is slow."""
    path = tmp_path / "shaper.toml"
    path.write_text(FILES["shaper"].read_text("utf-8") + CAM, "utf-8")
    counts, others = compared(settle(load(path), path))
    assert others == []
    assert {*counts} == {*LEAST} - {PartName.MESHING}
    assert all(count >= LEAST[part] for part, count in counts.items()), counts


@pytest.mark.skipif(some(1, few=0) == 0, reason="takes two minutes: with --thorough")
@each("path", PROJECTS)
def test_every_project_gives_every_number_one_value(path: Path) -> None:
    counts, others = compared(settle(load(path), path))
    assert others == []
    if path == TEMPLATE:
        assert all(counts[part] >= least for part, least in LEAST.items()), counts
