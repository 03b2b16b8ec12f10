"""A document lowered to the nodes that writers set: numbers, names, lists, steps of pages."""

from __future__ import annotations

from typing import get_args

from doors import (
    Chapter,
    Contents,
    Document,
    DocumentItem as Item,
    DocumentStep as Step,
    Formula,
    Heading,
    LoweredNode,
    LoweredText,
    Node,
    Paragraph,
    Part,
    References,
    TextKind,
    get_language,
    lower,
    step_parts,
)
from noted import note

RU = get_language("ru")


def lowered(*nodes: Node) -> tuple[LoweredNode, ...]:
    return lower(Document.of(nodes), RU).nodes


def test_writers_set_half_as_many_kinds_of_node() -> None:
    assert 2 * len(get_args(LoweredNode)) <= len(get_args(Node))
    assert {type(node) for node in lower(note(), RU).nodes} == set(get_args(LoweredNode))


def test_headings_have_level_and_number() -> None:
    assert lowered(Chapter("A"), Part("B"), Chapter("C", numbered=False)) == (
        Heading("A", 1, "1"),
        Heading("B", 2, "1.1"),
        Heading("C", 1),
    )


def test_steps_are_numbered_through_a_document_and_sources_in_their_list() -> None:
    steps = lowered(Step(("a",)), Chapter("B"), Step(("b",)), Step(("c",), continues=True))
    assert [node.mark for node in steps if isinstance(node, LoweredText)] == ["1", "2", ""]
    assert lowered(References(("x", "y"))) == (
        LoweredText(("x",), TextKind.SOURCE, "1"),
        LoweredText(("y",), TextKind.SOURCE, "2"),
    )


def test_the_steps_of_a_note_are_numbered_in_each_part() -> None:
    found = lowered(Contents(), Step(("a",)), Step(("b",)), Part("B"), Step(("c",)))
    marks = [node.mark for node in found if isinstance(node, LoweredText)]
    assert marks == ["1", "2", "1"]


def test_what_introduces_a_formula_or_ends_in_a_colon_stays_with_the_next_node() -> None:
    found = lowered(Paragraph("Then"), Formula("x = 1"), Item("these:"), Paragraph("End:"))
    assert [node.introduces_next for node in found if isinstance(node, LoweredText)] == [
        True, True, False,
    ]  # fmt: skip


def test_a_line_of_a_step_that_is_a_formula_alone_has_a_line_of_its_own_on_pages() -> None:
    written = lower(Document.of([Step(("Находим", "v_{C} = 2·l_{AB}.", "Точка"))]), RU)
    (step,) = written.nodes
    assert isinstance(step, LoweredText)
    text, formula, last = step_parts(step, written)
    assert text.text == "1)\u00a0Находим" and text.introduces_next and not text.formula
    assert formula.formula and last.text == "Точка"


def test_a_sentence_is_divided_once() -> None:
    written = lower(Document.of([]), RU)
    assert written.divide("Пусть x_{1} = 2") is written.divide("Пусть x_{1} = 2")
