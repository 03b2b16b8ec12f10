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
    ((left, right),) = line.bars
    assert 0 <= left.real < right.real < in_use().width("v", 5)
    assert left.imag == right.imag > in_use().ascent("v", 5)
    assert line.ascent >= left.imag


def test_a_built_fraction_has_its_parts_above_and_below_its_line() -> None:
    line = typeset(r"ω = \frac{v_{B}}{l_{AB}·0,5} = 3", 3.5, built=True)
    ((left, right),) = line.bars
    inks = [(run, in_use().ink(run.text, run.height)) for run in line.runs]
    within = [(run, ink) for run, ink in inks if left.real < run.x < right.real]
    above = [run.text for run, ink in within if run.y + ink[1] > left.imag]
    below = [run.text for run, ink in within if run.y + ink[3] < left.imag]
    assert (above, below) == (["v", "B"], ["l", "AB", "·0,5"])
    assert line.ascent + line.descent > typeset("ω_{B} = 3", 3.5).ascent * 2.5


def test_a_fraction_in_a_line_of_text_has_no_line() -> None:
    line = typeset(r"ω = \frac{v_{B}}{l + 1}", 3.5)
    assert not line.bars
    assert "".join(run.text for run in line.runs) == "ω = vB/(l + 1)"


def test_only_the_outer_fraction_is_built() -> None:
    line = typeset(r"\frac{a + \frac{b}{c}}{d}", 3.5, built=True)
    assert len(line.bars) == 1
    assert [run.text for run in line.runs] == ["a + b/c", "d"]


@pytest.mark.parametrize(("opened", "closed"), ["()", "[]"])
def test_brackets_about_a_fraction_are_as_high(opened: str, closed: str) -> None:
    line = typeset(rf"f(x)·{opened}1 + \frac{{a}}{{b}}{closed}·2", 3.5, built=True)
    assert [run.text for run in line.runs] == ["f(x)·", "1 + ", "a", "b", "·2"]
    tall = [bar for bar in line.bars if bar[0].real == bar[-1].real and bar[0] != bar[-1]]
    heights = [bar[-1].imag - bar[0].imag for bar in tall]
    assert min(heights) > 7.0
    assert len(heights) == 2


def test_a_built_root_has_a_line_above_its_body() -> None:
    line = typeset(r"r = \sqrt{x^{2} + y^{2}}", 3.5, built=True)
    (sign,) = line.bars
    assert sign[-1].imag == sign[-2].imag == max(point.imag for point in sign) == line.ascent
    assert [run.text for run in line.runs if run.height == 3.5] == ["r = ", "x", " + y"]


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
