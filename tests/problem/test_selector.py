from __future__ import annotations

import pytest
from doors import (
    Selector,
    SelectorError,
    is_force,
    parse_selector,
    unknown_names,
)


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
        ("F 2 0", Selector("F", ("2", "0"))),
        ("Ft 2 1 B C", Selector("Ft", ("2", "1", "B", "C"))),
        ("inertia 2", Selector("inertia", ("2",))),
        ("inertia couple 2", Selector("inertia couple", ("2",))),
        ("angle F 2 1", Selector("angle F", ("2", "1"))),
        ("arm F 2 1 about C", Selector("arm F", ("2", "1", "C"))),
        ("arm load F_{5C} about C", Selector("arm load", ("F_{5C}", "C"))),
        ("balance", Selector("balance", ())),
        ("lever A", Selector("lever", ("A",))),
        ("M 5 0 / F 5 0", Selector("M", ("5", "0"), Selector("F", ("5", "0")))),
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
        ("x", "'x' takes 1 name, got 0"),
        ("v A B C", "'v' takes 1 or 2 names, got 3"),
        ("at A A", "'at' needs two different names"),
        ("v A / v B / v C", "expected one division at most"),
        ("v A /", 'expected a quantity such as "v C", got nothing'),
        ("segment", "unknown quantity 'segment'"),
        ("angle 2 1", "unknown quantity 'angle 2'"),
        ("arm weigth 2 about C", "unknown quantity 'arm weigth' (the nearest is 'arm weight')"),
        ("arm weight 2 C", "'arm weight' ends with 'about' and a point"),
        ("arm weight about C", "'arm weight' takes 2 names, got 1"),
        ("F 2", "'F' takes 2 names, got 1"),
        ("F 2 2", "'F' needs two different names"),
        ("Ft 2 1 B B", "'Ft' needs two different names"),
        ("balance A B", "'balance' takes 0 or 1 names, got 2"),
    ],
)
def test_faulty_selectors_are_rejected(text: str, message: str) -> None:
    with pytest.raises(SelectorError) as caught:
        parse_selector(text)
    assert str(caught.value).startswith(message)


def test_unknown_names_know_the_pole_and_links() -> None:
    points, links = ["B", "B3"], ["3"]
    assert unknown_names(parse_selector("segment velocity p B3"), points, links) == []
    assert unknown_names(parse_selector("v p"), points, links) == ["p"]
    assert unknown_names(parse_selector("omega B"), points, links) == ["B"]
    assert unknown_names(parse_selector("v C / omega 4"), points, links) == ["C", "4"]


@pytest.mark.parametrize(
    ("text", "unknown"),
    [
        ("F 3 0", []),
        ("F 0 3", []),
        ("F 3 4", ["4"]),
        ("weight 0", ["0"]),
        ("Fn 3 0 B C", ["C"]),
        ("arm load P about B", []),
        ("arm load Q about D", ["Q", "D"]),
        ("arm F 3 B about 3", ["B", "3"]),
        ("M 3 4 / F 3 0", ["4"]),
        ("lever p", ["p"]),
        ("balance", []),
    ],
)
def test_unknown_names_of_forces(text: str, unknown: list[str]) -> None:
    assert unknown_names(parse_selector(text), ["B", "B3"], ["3"], ["P"]) == unknown


def test_a_link_and_a_point_may_have_one_name() -> None:
    assert parse_selector("Ft A B A B").names == ("A", "B", "A", "B")


def test_selectors_of_forces_are_recognized() -> None:
    told = {"v B": False, "F 2 1": True, "v B / v C": False, "v B / F 2 1": True}
    assert {text: is_force(parse_selector(text)) for text in told} == told
