from __future__ import annotations

import cmath
from math import radians

import pytest
from doors import (
    PART_OF,
    LayoutError,
    Pen,
    Stroke,
    Text,
    escape,
    in_use,
    index_height,
    smaller_heights,
    split_words,
    typeset,
    vector_markup,
)
from hypothesis import given, strategies as st


def runs(markup: str, height: float = 5.0) -> list[tuple[str, float]]:
    return [(run.text, run.height) for run in typeset(markup, height).runs]


def test_plain_text_is_one_run() -> None:
    line = typeset("План скоростей", 5)
    assert runs("План скоростей") == [("План скоростей", 5)]
    assert line.width == pytest.approx(in_use().width("План скоростей", 5))
    assert line.ascent >= 5


def test_a_height_is_no_other_one_for_being_a_whole_number() -> None:
    """The text cached for the height 7 is also returned for 7.0; its heights are floats."""
    made = typeset("W_{9}", 7)
    assert {type(height) for height in (made.height, *(run.height for run in made.runs))} == {float}


@pytest.mark.parametrize("markup", ["v_{C}", "v_C"])
def test_index_below(markup: str) -> None:
    letter, index = typeset(markup, 5).runs
    assert (letter.text, index.text) == ("v", "C")
    assert index.y < 0 < index.y + index.height
    assert index.x == pytest.approx(in_use().width("v", 5))
    assert index.height == 3.5


@pytest.mark.parametrize("markup", ["a^{n}_{CB}", "a_{CB}^{n}"])
def test_indices_above_and_below_are_stacked_without_touching(markup: str) -> None:
    line = typeset(markup, 5)
    _, below, above = line.runs
    assert (below.text, above.text) == ("CB", "n")
    assert below.x == above.x
    top_of_below = below.y + in_use().ascent("CB", below.height)
    assert above.y - in_use().descent("n", above.height) >= top_of_below + 0.5
    widest = max(in_use().width(r.text, r.height) for r in (below, above))
    assert line.width == pytest.approx(below.x + widest)


def test_two_indices_of_one_kind_follow_each_other() -> None:
    first, second = typeset("a_b_c", 5).runs[1:]
    assert second.x > first.x
    assert second.y == first.y


def test_a_multiplication_dot_is_clear_of_the_index_before_it() -> None:
    index, dot = typeset("ω_{1}·l", 5.0).runs[1:]
    assert dot.x - index.x - in_use().width(index.text, index.height) > 0.5


def test_index_of_an_index() -> None:
    assert runs("B_{3_{1}}") == [("B", 5), ("3", 3.5), ("1", 2.5)]


def test_overbar_is_above_its_letter_only() -> None:
    line = typeset(r"\bar{v}_{B}", 5)
    ((left, right, level),) = line.bars
    assert 0 <= left < right < in_use().width("v", 5)
    assert level > in_use().ascent("v", 5)
    assert line.ascent >= level


@pytest.mark.parametrize(
    ("height", "index"), [(2.5, 1.8), (3.5, 2.5), (4.0, 2.5), (5, 3.5), (7, 5), (10, 7)]
)
def test_index_heights(height: float, index: float) -> None:
    assert index_height(height) == index


def test_smaller_heights_end_at_the_smallest_of_drawings() -> None:
    assert smaller_heights(7) == (7, 5, 3.5, 2.5)
    assert smaller_heights(2.5) == (2.5,)


@given(st.text(alphabet="aБ_^{}\\ 1", max_size=12))
def test_escaped_text_is_shown_literally(text: str) -> None:
    assert "".join(run.text for run in typeset(escape(text), 3.5).runs) == text


@pytest.mark.parametrize("markup", ["v_{C", "v}", "{v", "v_", "v_{}", "v^ ", r"\foo", r"\bar{v"])
def test_faulty_markup_is_reported_with_its_place(markup: str) -> None:
    with pytest.raises(LayoutError, match=r"Cannot set the inscription .* \(sign \d+\)"):
        typeset(markup, 5)


def test_at_anchors_and_joins_runs_by_one_label() -> None:
    line = typeset("v_{CB}", 5)
    for anchor, start in (("left", 0.0), ("centre", line.width / 2), ("right", line.width)):
        first, second = line.at(30 + 40j, anchor=anchor)  # type: ignore[arg-type]
        assert isinstance(first, Text)
        assert isinstance(second, Text)
        assert first.at == pytest.approx(30 - start + 40j)
        assert first.label == second.label != ""


def test_turned_inscription_turns_runs_and_bars_about_the_point() -> None:
    line = typeset(r"\bar{v}_{B}", 5)
    straight, turned = line.at(0j), line.at(10 + 5j, angle=90)
    turn = cmath.exp(1j * radians(90))
    for a, b in zip(straight, turned, strict=True):
        if isinstance(a, Text) and isinstance(b, Text):
            assert b.at == pytest.approx(10 + 5j + a.at * turn)
            assert b.angle == 90
        elif isinstance(a, Stroke) and isinstance(b, Stroke):
            assert b.points == pytest.approx(tuple(10 + 5j + p * turn for p in a.points))
            assert b.pen is Pen.LETTER
            assert b.tag.startswith(PART_OF)


@pytest.mark.parametrize(
    ("symbol", "vector"),
    [("v_{B}", r"\bar{v}_{B}"), ("a^{n}_{CB}", r"\bar{a}^{n}_{CB}"), ("F", r"\bar{F}")],
)
def test_vector_markup(symbol: str, vector: str) -> None:
    assert vector_markup(symbol) == vector
    assert vector_markup(vector) == vector


def test_words_are_not_split_inside_braces_or_at_unbreakable_spaces() -> None:
    assert split_words("l_{A B} = 0,1\u00a0м  и") == ["l_{A B}", "=", "0,1\u00a0м", "и"]
    assert runs("0,1\u00a0м") == [("0,1 м", 5)]
