"""Formulas: parsing into a tree, and setting in one line with the necessary brackets."""

from __future__ import annotations

import pytest
from doors import (
    Fraction,
    Index,
    LayoutError,
    Letters,
    Overline,
    Root,
    formula_parse as parse,
    formula_written as written,
    fraction,
    get_language,
    inline,
    inlined,
    lines_of,
    pieces,
    plain_text,
    root,
    sides,
    sole_formula,
    units_of,
    with_stops,
)

UNITS = units_of(get_language("ru").note["units"])


def test_the_tree_has_every_part_of_the_text() -> None:
    assert parse(r"\frac{v}{\sqrt{x}}") == (Fraction((Letters("v"),), (Root((Letters("x"),)),)),)
    assert parse(r"\bar{a}^{n}_{B}") == (
        Overline((Letters("a"),)),
        Index((Letters("B"),), (Letters("n"),)),
    )
    assert parse("ω_{3}^{2}")[1] == Index((Letters("3"),), (Letters("2"),), is_power=True)


@pytest.mark.parametrize(
    "markup", [r"\frac{a}", r"\frac{a}{}", r"\frac{a}b", r"\sqrt{a", r"\root{a}", "a_", "}"]
)
def test_unpaired_brackets_are_a_fault(markup: str) -> None:
    with pytest.raises(LayoutError):
        parse(markup)


@pytest.mark.parametrize(
    ("markup", "line"),
    [
        (r"\frac{v}{l}", "v/l"),
        (r"\frac{v_{B3}}{BC·μ_{l}}", "v_B3/(BC·μ_l)"),
        (r"\frac{(pb_{3})·CD}{BC}", "(pb₃)·CD/BC"),
        (r"\frac{ω_{max} + ω_{min}}{2}", "(ω_max + ω_min)/2"),
        (r"\frac{(a + b)·c}{d}", "(a + b)·c/d"),
        (r"\frac{−a}{b}", "−a/b"),
        (r"\frac{a}{−b}", "a/(−b)"),
        (r"\frac{a}{2μ_{T}}", "a/(2μ_T)"),
        (r"\frac{1}{O_{1}A}", "1/O₁A"),
        (r"\frac{0,05}{2·10^{−3}}", "0,05/2·10⁻³"),
        (r"\frac{a}{\frac{b}{c}}", "a/(b/c)"),
        (r"\frac{\frac{a}{b}}{c}", "(a/b)/c"),
        (r"\frac{a·\frac{b}{c} − d}{e}", "(a·b/c − d)/e"),
        (r"\frac{|a − b|}{v}", "|a − b|/v"),
        (r"\frac{δ}{2}^{2}", "(δ/2)²"),
        (r"\sqrt{x^{2} + y^{2}}", "√(x² + y²)"),
        (r"d·(\frac{s}{d} + inv α)", "d·(s/d + inv α)"),
        ("U^{H}_{13} = U^{(4)}_{13}", "U^H₁₃ = U^(4)₁₃"),
        ("h_{a}^{*} + ω_{1}^{2}", "h_a* + ω₁²"),
    ],
)
def test_a_line_has_brackets_exactly_where_they_are_needed(markup: str, line: str) -> None:
    assert plain_text(markup) == line
    assert parse(inlined(markup)) == inline(parse(markup))


@pytest.mark.parametrize(
    "markup",
    ["v_{B}", "a^{n}_{CB}", "ω_{3}^{2}", r"\bar{v}_{B}", r"\frac{a_{1}}{\sqrt{b}}", r"a\_b"],
)
def test_a_tree_is_written_as_it_was(markup: str) -> None:
    assert written(parse(markup)) == markup


def test_fractions_and_roots_are_made_of_their_parts() -> None:
    assert fraction("v^{2}", root("x")) == r"\frac{v^{2}}{\sqrt{x}}"


def test_the_sides_of_a_chain_of_equalities_are_seen() -> None:
    found = [(s, written(n)) for s, n in sides(parse(r"v = f(x = 1)·\frac{a}{b} ≈ 5 м/с"))]
    assert found == [("", "v"), ("=", r"f(x = 1)·\frac{a}{b}"), ("≈", "5 м/с")]


def test_a_formula_is_cut_at_its_signs_and_repeats_them() -> None:
    lines = [
        plain_text(written(line)) for line in lines_of(parse("aaaa = bbbb = cccc = dddd"), 7.0)
    ]
    assert lines == ["aaaa = bbbb =", " = cccc = dddd"]
    long = lines_of(parse(r"M = \frac{aaaa + bbbb + cccc + dddd}{2}"), 6.0)
    assert [plain_text(written(line)).strip() for line in long] == [
        "M = (aaaa +", "+ bbbb +", "+ cccc +", "+ dddd)/2",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("text", "formulas"),
    [
        (r"откладываем AB = \frac{l_{AB}}{μ_{l}} = 32 мм; получаем B.",
         [r"AB = \frac{l_{AB}}{μ_{l}} = 32 мм"]),
        ("v_{D} = μ_{v}·(pd) = 3,4 м/с (точно 3,405).", ["v_{D} = μ_{v}·(pd) = 3,4 м/с"]),
        ("лежит (точка O_{1}) на прямой", ["O_{1}"]),
        ("Скорости, м/с², звена 3", ["м/с^{2}"]),
        ("tg ψ_{max} = 0,5, ψ_{min} = 26°", ["tg ψ_{max} = 0,5", "ψ_{min} = 26°"]),
        ("Через точку A под углом 0° к оси x", []),
        ("μ_{v} = 0,05 (м/с)/мм", ["μ_{v} = 0,05 (м/с)/мм"]),
    ],
)  # fmt: skip
def test_the_formulas_of_a_sentence_are_found(text: str, formulas: list[str]) -> None:
    found = pieces(parse(text), UNITS)
    assert [written(piece.nodes) for piece in found if piece.is_formula] == formulas
    assert plain_text("".join(written(piece.nodes) for piece in found)) == plain_text(text)


def test_no_line_begins_with_the_stop_after_a_formula() -> None:
    found = list(with_stops(pieces(parse("Где v_{B}; и a_{B}."), UNITS)))
    assert [plain_text(written(piece.nodes)) for piece in found] == ["Где ", "v_B;", " и ", "a_B."]


def test_a_formula_alone_is_known() -> None:
    assert sole_formula(pieces(parse("(pb) = v_{B} = 5 мм."), UNITS))
    assert not sole_formula(pieces(parse("(pb) = v_{B} (точно 5)."), UNITS))
