from __future__ import annotations

import pytest

from planmethod.problem.selector import Selector, SelectorError, parse_selector, unknown_names


@pytest.mark.parametrize(
    ("text", "selector"),
    [
        ("v C", Selector("v", ("C",))),
        ("v C B", Selector("v", ("C", "B"))),
        ("an C B", Selector("an", ("C", "B"))),
        ("ak B3 B", Selector("ak", ("B3", "B"))),
        ("omega 2", Selector("omega", ("2",))),
        ("  phi   3 ", Selector("phi", ("3",))),
        ("segment velocity p D", Selector("segment velocity", ("p", "D"))),
        ("length B C", Selector("length", ("B", "C"))),
        ("vx D / omega 1", Selector("vx", ("D",), Selector("omega", ("1",)))),
    ],
)
def test_parse(text: str, selector: Selector) -> None:
    assert parse_selector(text) == selector


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", 'expected a quantity such as "v C", got nothing'),
        ("w 2", "unknown quantity 'w'"),
        ("omga 2", "unknown quantity 'omga' (the nearest is 'omega')"),
        ("x", "'x' goes with 1 names, got 0"),
        ("v A B C", "'v' goes with 1 or 2 names, got 3"),
        ("at A A", "'at' needs two different names"),
        ("v A / v B / v C", "expected one division at most"),
        ("v A /", 'expected a quantity such as "v C", got nothing'),
        ("segment", "unknown quantity 'segment'"),
    ],
)
def test_refuse(text: str, message: str) -> None:
    with pytest.raises(SelectorError) as caught:
        parse_selector(text)
    assert str(caught.value).startswith(message)


def test_unknown_names_know_the_pole_and_links() -> None:
    points, links = ["B", "B3"], ["3"]
    assert unknown_names(parse_selector("segment velocity p B3"), points, links) == []
    assert unknown_names(parse_selector("v p"), points, links) == ["p"]
    assert unknown_names(parse_selector("omega B"), points, links) == ["B"]
    assert unknown_names(parse_selector("v C / omega 4"), points, links) == ["C", "4"]
