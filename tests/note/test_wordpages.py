"""Figures of a document of Word that let text go before them."""

from __future__ import annotations

from doors import (
    Chapter,
    Document,
    Drawing,
    DrawingView,
    Figure,
    Heading,
    LoweredNode,
    NamedFigure,
    Node,
    PageFlow,
    Paragraph,
    flowing,
    get_language,
    lower,
)

FIGURE = Figure(DrawingView(Drawing(80.0, 60.0, "Plan")), "Plan")
PUT = NamedFigure(FIGURE.view, "Plan", "Plan")
PAGE = 100.0


def lowered(nodes: list[Node]) -> list[LoweredNode]:
    return list(lower(Document.of(nodes), get_language("en")).nodes)


def order(nodes: list[Node]) -> list[LoweredNode]:
    """Return nodes as they are put on pages where a paragraph takes 10 mm."""
    flow, found = PageFlow(PAGE), []
    for node in flowing(lowered(nodes), flow, lambda figure: figure.view.size[1]):
        flow.reserve(FIGURE.view.size[1] if isinstance(node, NamedFigure) else 10.0)
        found.append(node)
    return found


def lines(count: int, first: int = 0) -> list[Node]:
    return [Paragraph(f"{k}") for k in range(first, first + count)]


def test_text_goes_before_a_figure_until_the_page_is_full() -> None:
    found = order([*lines(7), FIGURE, *lines(8, 7)])
    assert found.index(PUT) == 11  # ten lines fill the page, the eleventh shows that it is full
    assert [node for node in found if node != PUT] == lowered(lines(15))


def test_a_figure_that_fits_stays_and_waits_for_no_heading() -> None:
    assert order([*lines(3), FIGURE, *lines(4, 3)]).index(PUT) == 3
    found = order([*lines(7), FIGURE, *lines(1, 7), Chapter("Next"), *lines(3, 8)])
    assert found.index(PUT) == 8 and isinstance(found[9], Heading)


def test_the_last_figure_is_put() -> None:
    assert order([*lines(7), FIGURE, *lines(1, 7)])[-1] == PUT
