"""The writer of plain text: every kind of node, numbering, spacing."""

from __future__ import annotations

import re
from typing import cast, get_args

import pytest
from doors import (
    TERMINAL_WIDTH as WIDTH,
    Caption,
    Chapter,
    Contents,
    Document,
    DocumentItem as Item,
    DocumentStep as Step,
    DrawableView,
    Equation,
    Equations,
    Figure,
    Formula,
    Node,
    Note,
    PageBreak,
    Paragraph,
    Part,
    References,
    StructuralHeading,
    Subpart,
    Table,
    Term,
    Title,
    TitlePage,
    escape,
    get_language,
    plain_document,
    step_of,
    table_of,
    table_of_columns,
    table_of_quantities,
    width,
)
from worked import ROOT

LONG = " ".join(["word"] * 30)

ALONE: dict[type, tuple[Node, str]] = {
    Title: (Title("v_{2}"), "v₂\n══"),
    TitlePage: (
        TitlePage(
            ("University",), "Note", title="Press", author="Ivanov", place="Omsk", year="2026"
        ),
        "University\nNote\nSubject: Press\nDone by: Ivanov\nOmsk 2026",
    ),
    Contents: (Contents(), "Contents\n────────"),
    PageBreak: (PageBreak(), ""),
    StructuralHeading: (StructuralHeading("Conclusion"), "Conclusion\n──────────"),
    Chapter: (Chapter("Plans"), "1. Plans\n────────"),
    Part: (Part("Frame"), "0.1. Frame"),
    Subpart: (Subpart("Link"), "0.0.1. Link"),
    Caption: (Caption("Links"), "Links"),
    Paragraph: (Paragraph("a^{n}_{CB}"), "aⁿ_CB"),
    Item: (Item(LONG), f"{LONG[:99]}\n  {LONG[100:]}"),
    Step: (Step(("One.", "Two.")), "  1) One.\n     Two."),
    Formula: (Formula("W = \\frac{a}{b·c}", numbered=True), "     W = a/(b·c)    (1)"),
    Equations: (
        Equations((Equation((Term("v_{C}"),), (Term("v_{B}", 2, "⊥ AB"), Term("v_{CB}", 1))),)),
        "     v_C = v_B  + v_CB\n           ═══    ────\n           ⊥ AB",
    ),
    Table: (table_of(("link", "ω"), [("1", "20,00")]), "link      ω\n───────────\n1     20,00"),
    Figure: (Figure(cast("DrawableView", None), "Scheme"), "Scheme"),
    References: (References(("Book", "Paper")), "  1. Book\n  2. Paper"),
    Note: (Note("read"), "read"),
}


def written(*nodes: Node, lang: str = "en") -> str:
    return plain_document(Document.of(nodes), get_language(lang))


@pytest.mark.parametrize("kind", get_args(Node))
def test_every_kind_of_node(kind: type) -> None:
    node, text = ALONE[kind]
    assert written(node) == text


def test_chapters_parts_and_steps_are_numbered() -> None:
    nodes: tuple[Node, ...] = (
        Chapter("One"), Step(("a",)),
        Chapter("Between", numbered=False),
        Chapter("Two"), Part("First"), Step(("b",)), Part("Second"), Step(("c",)),
        *step_of(["still c"], continues=True), *step_of([]),
        Chapter("Three"), Part("First"), Step(("d",)),
    )  # fmt: skip
    lines = [line for line in written(*nodes).splitlines() if line.strip("─")]
    assert lines == [
        "1. One", "  1) a", "Between", "2. Two", "2.1. First", "  2) b", "2.2. Second", "  3) c",
        "     still c", "3. Three", "3.1. First", "  4) d",
    ]  # fmt: skip


def test_blank_lines_separate_blocks() -> None:
    table = table_of(("a",), [("1",)])
    equations = Equations((Equation((Term("F"),)),))
    nodes = (
        Paragraph("head"), Item("one"), Item("two"),
        Chapter("Plan"), Caption("Equations:"), equations, Step(("step",)), Caption("Table"), table,
        Note("of the table"), Caption("Another"), table, table, Item("after"), Paragraph("end"),
        Paragraph("more"),
    )  # fmt: skip
    parts = written(*nodes).split("\n\n")
    assert [part.splitlines()[0] for part in parts] == [
        "head", "1. Plan", "Equations:", "     F = 0", "  1) step", "Table", "Another", "a",
        "after", "end",
    ]  # fmt: skip
    assert parts[5].splitlines()[-1] == "of the table"
    assert parts[-1] == "end\nmore"


def test_an_item_is_indented_under_its_label() -> None:
    lines = written(Item(LONG, label="7 %"), Item("short", label="12 %")).splitlines()
    assert lines[0].startswith("    7 %  word")
    assert lines[1].startswith(" " * 9 + "word")
    assert lines[2] == "   12 %  short"


def test_wide_tables_are_cut_where_they_may_be() -> None:
    columns = [["No.", "1"], *([f"column{k}", "0.123456789"] for k in range(20))]
    lines = written(table_of_columns(columns, repeated=1)).splitlines()
    assert all(width(line) <= WIDTH for line in lines)
    heads = [line for line in lines if line.startswith("No.")]
    assert len(heads) == 3
    assert sum(head.count("column") for head in heads) == 20
    whole = Table(tuple(head for head, _ in columns), (tuple(cell for _, cell in columns),))
    assert len(written(whole).splitlines()) == 3


def test_units_are_in_the_heads() -> None:
    table = table_of_quantities([("t", "s", ["0"]), ("No.", "", ["1"])], repeated=1)
    assert table.head == ("t, s", "No.")
    assert table.rows == (("0", "1"),)


def test_equations_are_cut_at_a_sign_that_is_repeated() -> None:
    forces = tuple(Term(f"F_{{{k}{k + 1}}}", 1, "∥ x-x") for k in range(30))
    lines = written(Equations((Equation(forces),))).splitlines()
    assert all(width(line) <= WIDTH for line in lines)
    rows = [line.strip() for line in lines if "F" in line]
    assert len(rows) > 2
    assert all(row.endswith(" +") for row in rows[:-1])
    assert all(row.startswith("+ ") for row in rows[1:])
    assert rows[-1].endswith(" = 0")


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_a_number_and_its_unit_are_not_parted(lang: str) -> None:
    metre = get_language(lang).note["units"]["m"]
    for count in range(80, 100):
        text = written(Paragraph("x" * count + f" 0.25 {metre} y"), lang=lang)
        assert f"0.25 {metre}" in text
    text = written(Step(("a\N{NO-BREAK SPACE}b",)))
    assert text == "  1) a b"


def test_text_of_a_file_is_printed_unchanged() -> None:
    text = r"a_{b}^2 \ {c}"
    assert written(Paragraph(escape(text))) == text


LATER = ("gears", "moving", "synthesis")
"""Rooms that give no documents yet."""


def test_only_writers_lay_text_out() -> None:
    """Modules that build documents do not use the columns of a terminal."""
    found = [
        path.relative_to(ROOT)
        for path in sorted((ROOT / "planmethod").rglob("*.py"))
        if "note.writers.plain import" in path.read_text("utf-8")
        and path.relative_to(ROOT).parts[1] not in (*LATER, "commands")
        and path.parent.name != "writers"
    ]
    assert not found
    used = {
        names.strip()
        for path in (ROOT / "planmethod" / "commands").glob("*.py")
        for names in re.findall(r"note\.writers\.terminal import (.*)", path.read_text("utf-8"))
    }
    assert {names.split()[0] for names in used} == {"plain_document"}
    assert not [
        path.name
        for path in sorted((ROOT / "planmethod" / "note").rglob("*.py"))
        if path.parent.name != "writers" and "textwrap" in path.read_text("utf-8")
    ]


def test_items_below_a_caption_are_indented_and_others_are_not() -> None:
    text = written(
        Caption("Checks"), Item("one"), Item(LONG), table_of(("a",), [("1",)]), Item("a note")
    )
    lines = text.splitlines()
    assert lines[1] == "  one"
    assert lines[2].startswith("  word")
    assert lines[3].startswith("    word")
    assert lines[-1] == "a note"
    assert written(Item("one"), Caption("Checks"), Item("two")).splitlines()[-1] == "  two"


def test_zero_has_no_sign() -> None:
    say = get_language("ru").notation
    assert [say.number(text) for text in ("-0.00", "-0", "0.0", "-0.01")] == [
        "0,00",
        "0",
        "0,0",
        "−0,01",
    ]
