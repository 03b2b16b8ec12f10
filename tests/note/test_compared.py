"""Numbers beside reference values: in every table Δ follows from the two printed numbers."""

import re
from collections.abc import Iterator, Sequence
from contextlib import chdir
from functools import cache
from itertools import groupby, product
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from unittest.mock import patch

import pytest
from cases import each, sampled, some
from click.testing import CliRunner
from doors import (
    ComparedNumber,
    Document,
    Table,
    TablePart,
    cli,
    get_language,
    percent_text,
)
from hypothesis import given, strategies as st
from msgspec import Struct
from worked import PROBLEMS

NONE = "—"


class Line(Struct, frozen=True):
    """A column of a table, or a row of a table with named rows: its name and its cells."""

    name: str
    cells: Sequence[tuple[str, int | None]]


class Range(Struct, frozen=True):
    """All numbers that are written so."""

    low: float
    high: float

    @property
    def has_zero(self) -> bool:
        return self.low <= 0.0 <= self.high


def written(text: str, sense: int | None = None) -> Range | None:
    """Return the range of values that a number of a table may have; None for a dash.

    Zeros at the end of a whole number may be places that were rounded to.
    """
    plain = text.replace("−", "-").replace(",", ".").replace("*", "").strip()
    plain = plain.replace("\N{NO-BREAK SPACE}", " ").partition(" ")[0]  # without error or unit
    found = re.fullmatch(r"([-+]?)(\d+)(\.\d+)?(?:·10\^\{(-?\d+)\})?", plain)
    if found is None:
        return None
    sign, whole, fraction, power = found.groups()
    places = -len(fraction) + 1 if fraction else len(whole) - len(whole.rstrip("0") or whole)
    scale = 10.0 ** int(power or 0)
    value = float(f"{sign}{whole}{fraction or ''}") * (sense or 1)
    half = 0.5 * 10.0**places * (1 + 1e-9)
    return Range((value - half) * scale, (value + half) * scale)


@cache
def names(lang: str) -> tuple[set[str], set[str], set[str]]:
    """Return the names of reference values, compared values and differences in the tables."""
    words = get_language(lang)
    sheets, said, point = words.sheets, words.report, words.point
    compared, reactions = said["results"]["columns_compared"], said["forces"]["columns_reactions"]
    results = words.gears["sheet"]["columns_results"]
    published, chords = words.gears["columns_published"], point["chords"]
    printed, own = point["printed"], words.check["compared"]["columns"]
    audit = words.audit["columns"]
    exact = {sheets.exact, sheets.by_plans, sheets.cycle_plans, compared[2], reactions[3],
             results[2], published[2], chords[2], printed[3], own[2], audit[3]}  # fmt: skip
    read = {sheets.read, sheets.by_lever, sheets.cycle_lever, compared[1], reactions[2],
            results[3], published[1], chords[3], printed[2], own[1], audit[2]}  # fmt: skip
    off = {"Δ", "Δ, %", sheets.difference, results[5], published[3], chords[5], printed[4],
           own[3], own[4], audit[5], audit[6]}  # fmt: skip
    return exact, read, off


def lines_of(table: TablePart | Table) -> list[Line]:
    """Return the columns of a table, or its rows if their names come first."""
    if isinstance(table, Table):
        columns = [
            Line(head, [(row[k], None) for row in table.rows]) for k, head in enumerate(table.head)
        ]
    else:
        sources = [column.source for column in table.columns]
        columns = [
            Line(
                f"{one.head}, %" if one.unit == "%" else one.head,
                [(cell.text, cell.sense) for cell in one.cells],
            )
            for one in sources
        ]
    if columns and not columns[0].name and any("Δ" in text for text, _ in columns[0].cells):
        lead, *rest = columns
        return [
            Line(name, [column.cells[k] for column in rest])
            for k, (name, _) in enumerate(lead.cells)
        ]
    return columns


def comparisons(lines: Sequence[Line], lang: str) -> Iterator[tuple[Line, Line, Line]]:
    """Yield reference values, compared values and their difference; a table may have many."""
    exact_names, read_names, off_names = names(lang)
    exact = read = None
    for k, line in enumerate(lines):
        if line.name.endswith("′"):
            exact, read = lines[k - 1], line
        elif line.name in exact_names:
            exact = line
        elif line.name in read_names:
            read = line
        if line.name in off_names:
            assert exact is not None and read is not None, [one.name for one in lines]
            yield exact, read, line


class Told(Struct):
    """Counts of the compared numbers."""

    tables: int = 0
    rows: int = 0
    dashes: int = 0
    lost: int = 0


def judge(lines: Sequence[Line], lang: str, told: Told) -> list[str]:
    """Return the differences that do not follow from the two numbers beside them."""
    wrong, looked = [], False
    # The σ of a difference is not the difference of the two σ above it.
    heads = lines[0].cells if lines and not lines[0].name else []
    errors = {k for k, (text, _) in enumerate(heads) if text.startswith("±σ")}
    for exact, read, off in comparisons(lines, lang):
        looked = True
        cells = zip(exact.cells, read.cells, off.cells, strict=True)
        for k, (one, other, shown) in enumerate(cells):
            if k in errors:
                continue
            a, b, found = written(*one), written(*other), written(shown[0])
            told.rows += 1
            if a is None or b is None or found is None:
                told.dashes += 1
                continue
            corners = list(product((a.low, a.high), (b.low, b.high)))
            if off.name.endswith("%"):
                if a.has_zero:
                    told.lost += 1
                    continue
                given = [100.0 * (y - x) / x for x, y in corners]
            else:
                turned = -1.0 if one[1] is not None and a.high < 0 else 1.0
                given = [turned * (y - x) for x, y in corners]
            if not (min(given) <= found.high and found.low <= max(given)):
                wrong.append(f"{exact.name} {one}, {read.name} {other}: {off.name} {shown[0]}")
    told.tables += looked
    return wrong


def tables_of(*words: str) -> list[TablePart | Table]:
    """Return the tables that a command prints and draws."""
    found: list[TablePart | Table] = []
    document, place = Document.of.__func__, TablePart.place  # type: ignore[attr-defined]

    def written_down(cls: type[Document], nodes: Any) -> Document:
        made: Document = document(cls, nodes)
        found.extend(node for node in made.nodes if isinstance(node, Table))
        return made

    def placed(part: TablePart, corner: complex) -> Any:
        found.append(part)
        return place(part, corner)

    with (
        patch.object(Document, "of", classmethod(written_down)),
        patch.object(TablePart, "place", placed),
        TemporaryDirectory() as folder,
        chdir(folder),
    ):
        result = CliRunner().invoke(cli, words)
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        raise result.exception
    return found


def judge_largest(lines: Sequence[Line], lang: str) -> list[str]:
    """Return the largest differences whose share is not that of the largest values beside them."""
    heads = get_language(lang).report["results"]["columns_all"]
    (_, peak, off, percent, *_) = (text.format() for text in heads)
    found = {line.name: [written(*cell) for cell in line.cells] for line in lines}
    if percent not in found:
        return []
    wrong = []
    for whole, part, share in zip(found[peak], found[off], found[percent], strict=True):
        assert whole is not None and part is not None and share is not None
        least, most = 100.0 * part.low / whole.high, 100.0 * part.high / whole.low
        if not (least <= share.high and share.low <= most):
            wrong.append(f"{whole} {part} {share}")
    return wrong


def markdown_tables(text: str) -> Iterator[list[Line]]:
    """Yield the tables of a document in Markdown."""
    every = text.split("\n")
    rows = [line[2:-2].split(" | ") if line.startswith("|") else [] for line in every]
    for is_table, block in groupby(rows, bool):
        if is_table:
            head, _, *body = block
            columns = zip(*body, strict=True)
            yield [
                Line(name, [(cell, None) for cell in cells])
                for name, cells in zip(head, columns, strict=True)
            ]


def told_of(path: Path, lang: str, told: Told, *lines: str) -> list[str]:
    """Return the faults in the tables of commands."""
    wrong = []
    for line in lines:
        command, *words = line.split()
        for table in tables_of(command, str(path), "--lang", lang, *words):
            found = [*judge(lines_of(table), lang, told), *judge_largest(lines_of(table), lang)]
            wrong += [f"{line}: {one}" for one in found]
    return wrong


SAID = sorted([*PROBLEMS.glob("gears/*.toml"), *PROBLEMS.glob("point/*.toml")])
"""Problems whose documents have differences; for linkages only sheets and the note have them."""

LINKAGES = ("linkages", "levers", "machines", "press")
"""Folders of the problems whose differences are on sheets and in the note."""

TURN = "0:360:30"
DRAWN = (  # problem, what draws tables that others do not have
    ("linkages/ex3", "sheet --phi 20,140,260"),
    ("linkages/ex3", "sheet --sigma"),
    ("linkages/2.1.5", f"sheet --layout coursework-12 --phi {TURN}"),
    ("press/press", f"sheet --layout forces-cycle --phi {TURN}"),
    ("press/press", "sheet --layout forces --sigma"),
    ("press/flywheel", "note"),
    ("gears/gears-ex1", "sheet"),
)


def test_a_written_number_stands_for_a_range() -> None:
    some = written("−1,25·10^{3}")
    assert some is not None and some.low == pytest.approx(-1255.0)
    whole = written("390", -1)
    assert whole is not None and (whole.low, whole.high) == pytest.approx((-395.0, -385.0))
    assert written(NONE) is None


def test_per_cent_of_neither_sense_is_written_from_the_limit_on() -> None:
    sizes = (199.9, -199.9, 200.0, -200.0, None)
    assert [percent_text(one, limit=200.0) for one in sizes] == ["199.9", "-199.9", *[NONE] * 3]


SIZES = st.floats(1e-3, 1e5)
SENSES = st.sampled_from([1.0, -1.0])


@given(SIZES, SENSES, st.floats(-0.9, 0.9), st.floats(1e-4, 1e3))
def test_the_difference_has_the_sign_and_size_of_the_two_numbers(
    size: float, sense: float, share: float, sigma: float
) -> None:
    one = ComparedNumber(sense * size, sense * size * (1.0 + share), sigma)
    assert one.percent == pytest.approx(100.0 * share, abs=1e-9)
    assert one.off == pytest.approx(sense * size * share, abs=1e-9 * size)
    assert one.size_off == pytest.approx(size * share, abs=1e-9 * size)
    assert one.unless_lost().percent == (one.percent if size > sigma else None)
    whole, part = written(one.part_text(one.off, 1)), written(one.percent_text(1))
    assert whole is not None and part is not None and whole.low == part.low


@given(SIZES, SENSES, st.floats(-0.9, 0.9), st.floats(1e-4, 1e3), st.booleans())
def test_a_reading_beside_the_exact_value_is_written_no_further_off_than_half_a_digit(
    size: float, sense: float, share: float, sigma: float, signed: bool
) -> None:
    one = ComparedNumber(sense * size, sense * size * (1.0 + share), sigma)
    found = written(one.text_beside(one.exact_text, signed=signed))
    assert found is not None
    assert found.low <= (one.read if signed else abs(one.read)) <= found.high


@each("path", sampled(SAID, 3))
def test_differences_follow_from_the_printed_numbers(path: Path) -> None:
    told = Told()
    assert told_of(path, "en", told, "solve", "protocol") == []


@pytest.mark.parametrize(("name", "line"), DRAWN)
def test_differences_on_sheets_and_in_notes_follow_from_the_numbers(name: str, line: str) -> None:
    told = Told()
    assert told_of(PROBLEMS / f"{name}.toml", "ru", told, line) == []
    assert told.rows > told.dashes + told.lost


PRINTED = [
    path for path in sorted(PROBLEMS.rglob("*.toml")) if "[published" in path.read_text("utf-8")
]
"""Problems with printed values, which an audit sets beside the exact ones."""


@each("path", sampled(PRINTED, 12))
def test_differences_of_an_audit_follow_from_the_printed_numbers(path: Path) -> None:
    result = CliRunner().invoke(cli, ["audit", str(path), "--lang", "en"])
    told, wrong = Told(), list[str]()
    for lines in markdown_tables(result.output):
        wrong += judge(lines, "en", told)
    assert wrong == [] and told.tables


def test_differences_of_a_student_s_numbers_follow_from_them(tmp_path: Path) -> None:
    file = tmp_path / "my.csv"
    file.write_text("Величина;Значение\nv_D;3,4\na_E;80\nomega_4;-2,5\n", encoding="utf-8")
    told, wrong = Told(), list[str]()
    for table in tables_of(
        "solve", str(PROBLEMS / "linkages/ex3.toml"), "--compare", str(file), "--lang", "ru"
    ):
        wrong += judge(lines_of(table), "ru", told)
    assert wrong == [] and told.rows - told.dashes - told.lost == 6


EVERY = sorted(path for path in PROBLEMS.rglob("*.toml"))


@pytest.mark.skipif(some(1, few=0) == 0, reason="takes ten minutes: with --thorough")
def test_differences_of_every_shipped_problem_follow_from_the_numbers() -> None:
    told, wrong = Told(), list[str]()
    for path in EVERY:
        of_linkage = path.parent.name in LINKAGES
        lines = ("sheet", "sheet --sigma", "note") if of_linkage else ("sheet", "solve", "protocol")
        wrong += [f"{path.stem}: {one}" for one in told_of(path, "ru", told, *lines)]
    assert wrong == []
    assert told.rows - told.dashes - told.lost > 20 * len(EVERY)
