from __future__ import annotations

from itertools import pairwise

import pytest
from doors import (
    PART_OF,
    Direction,
    DrawingItem as Item,
    EquationBlock,
    KnownParts,
    Lines,
    PointName,
    Relation,
    StatedEquation,
    Stroke,
    Text,
    Vector,
    VectorEquation,
    VectorKind,
    direction_text,
    equals_at,
    equation_block as made,
    formula_block,
    formula_blocks,
    in_use,
    lint,
    paragraph,
    perpendicular_to,
    towards,
    typeset,
)
from hypothesis import given, settings, strategies as st
from reading import texts


def equation_block(
    equation: VectorEquation, height: float = 5.0, *, width: float | None = None
) -> EquationBlock:
    stated = StatedEquation(equation.left.head, (equation.left,), equation.right)
    return made(stated.written(direction_text), height, width=width)


def vector(
    symbol: str, known: KnownParts = KnownParts.ONE, direction: Direction | None = None
) -> Vector:
    letters = PointName("p"), PointName("b")
    return Vector(symbol, VectorKind.ABSOLUTE, *letters, known, direction)


EQUATION = VectorEquation(
    vector("a_{C}", KnownParts.ONE, Direction(Relation.PARALLEL, guide="x-x")),
    (
        vector("a_{B}", KnownParts.BOTH, towards("B", "A")),
        vector("a^{n}_{CB}", KnownParts.BOTH, towards("C", "B")),
        vector("a^{τ}_{CB}", KnownParts.ONE, perpendicular_to("B", "C")),
        vector("a_{S}", KnownParts.NONE),
    ),
)


def underlines(items: list[Item]) -> list[Stroke]:
    return [i for i in items if isinstance(i, Stroke) and not i.tag.startswith(PART_OF)]


def inside(block: EquationBlock, corner: complex, items: list[Item]) -> bool:
    slack = 1e-6
    for item in items:
        points = item.points if isinstance(item, Stroke) else ()
        if isinstance(item, Text):
            left, low, right, high = in_use().ink(item.text, item.height)
            points = (item.at + complex(left, low), item.at + complex(right, high))
        for p in points:
            x, y = (p - corner).real, (corner - p).imag
            if not (-slack <= x <= block.width + slack and -slack <= y <= block.height + slack):
                return False
    return True


def test_underlines_mark_known_terms() -> None:
    items = equation_block(EQUATION).place(0j)
    by_left: dict[float, int] = {}
    for line in underlines(items):
        left = round(line.points[0].real, 6)
        by_left[left] = by_left.get(left, 0) + 1
    assert [by_left[left] for left in sorted(by_left)] == [1, 2, 2, 1]


def test_underlines_are_as_long_as_their_terms_and_level() -> None:
    items = equation_block(EQUATION).place(0j)
    lengths = {round(abs(line.points[1] - line.points[0]), 6) for line in underlines(items)}
    wanted = {round(typeset(v.symbol, 5).width, 6) for v in (EQUATION.left, *EQUATION.right[:3])}
    assert lengths == wanted
    assert len({round(line.points[0].imag, 6) for line in underlines(items)}) == 2


def test_every_vector_has_an_overbar_and_notes_are_smaller() -> None:
    items = equation_block(EQUATION).place(0j)
    bars = [i for i in items if isinstance(i, Stroke) and i.tag.startswith(PART_OF)]
    assert len(bars) == 5
    notes = [run for run in texts(items) if "⊥" in run.text or "→" in run.text]
    assert len(notes) == 3
    assert {run.height for run in notes} == {3.5}


def test_wraps_at_a_plus_that_is_repeated() -> None:
    whole = equation_block(EQUATION)
    narrow = equation_block(EQUATION, width=whole.width * 0.75)
    assert whole.place(0j) != narrow.place(0j)
    assert narrow.width <= whole.width * 0.75
    assert narrow.height > 1.8 * whole.height
    count = [sum(run.text == "+" for run in texts(b.place(0j))) for b in (whole, narrow)]
    assert count == [3, 4]


def test_shrinks_when_single_terms_are_too_wide() -> None:
    narrow = equation_block(EQUATION, width=20)
    assert {run.height for run in texts(narrow.place(0j)) if run.text == "="} < {2.5, 3.5}


words = st.text(alphabet="ABCDOxτn123", min_size=1, max_size=8)
vectors = st.builds(
    vector,
    words.map("a_{{{}}}".format),
    st.sampled_from(KnownParts),
    st.one_of(
        st.none(),
        words.map(lambda guide: Direction(Relation.PERPENDICULAR, guide=guide)),
        st.builds(towards, words, words),
    ),
)
equations = st.builds(
    lambda left, right: VectorEquation(left, tuple(right)),
    vectors,
    st.lists(vectors, min_size=1, max_size=6),
)


@settings(deadline=None)
@given(equations, st.sampled_from([None, 60.0, 90.0, 150.0]), st.sampled_from([3.5, 5.0, 7.0]))
def test_no_parts_of_an_equation_overlap(
    equation: VectorEquation, width: float | None, height: float
) -> None:
    block = equation_block(equation, height, width=width)
    items = block.place(30 + 200j)
    assert [f.message for f in lint(items)] == []
    assert inside(block, 30 + 200j, items)
    # Notes of neighbours keep apart.
    notes = [run for run in texts(items) if run.text[0] in "⊥∥"]
    for one, two in pairwise(notes):
        if one.at.imag == two.at.imag:
            end = one.at.real + in_use().ink(one.text, one.height)[2]
            assert two.at.real + in_use().ink(two.text, two.height)[0] >= end + 1


def test_formula_on_one_line() -> None:
    markup = "ω_{2} = v_{CB}/l_{BC} = 15,5 с^{-1}"
    block = formula_block(markup, 3.5)
    assert block.width == pytest.approx(typeset(markup, 3.5).width)
    assert block.height < 3.5 * 2


def test_formula_is_broken_at_signs_that_are_repeated() -> None:
    block = formula_block("a = b + c = 15,5 + 16,5 = 32 м/с", 5, width=45)
    assert isinstance(block, Lines)
    lines = [line.markup.split(" ") for line in block.inscriptions]
    assert len(lines) > 1
    assert block.width <= 45
    for above, below in pairwise(lines):
        assert above[-1] == below[0]
        assert above[-1] in "=+"
    assert "32 м/с" in block.inscriptions[-1].markup


@pytest.mark.parametrize("width", range(40, 121, 10))
def test_a_formula_in_a_sentence_repeats_its_sign_and_no_line_begins_with_a_dash(
    width: int,
) -> None:
    text = (
        "Модули одинаковы: z_{4} = z_{2} + 2·z_{3} − z_{1} = 50 + 2·15 − 10 = 70 ≥ z_{5}, нужно "
        "не меньше 8 – выполнено"
    )
    block = paragraph(text, 3.5, width)
    assert block.width <= width
    lines = [line.markup.split(" ") for line in block.inscriptions]
    for above, below in pairwise(lines):
        assert below[0] != "–"
        signs = {above[-1], below[0]} & {"+", "−", "≥"}
        assert not signs or above[-1] == below[0]
        if signs:
            assert len(below) > 1


@pytest.mark.parametrize("width", [30, 40, 60])
def test_a_product_wider_than_its_lines_goes_on_with_a_sign_of_multiplication(width: int) -> None:
    factors = [rf"(−\frac{{z_{{{k + 1}}}}}{{z_{{{k}}}}})" for k in range(1, 8)]
    block = formula_block(f"U_{{18}} = {'·'.join(factors)} = 5", 3.5, width=width)
    assert isinstance(block, Lines)
    assert block.width <= width
    lines = [line.markup.split(" ") for line in block.inscriptions]
    assert sum("×" in line for line in lines) > 1
    for above, below in pairwise(lines):
        assert above[-1] == below[0]
        assert above[-1] in "=×"


def test_formula_without_signs_is_broken_at_spaces() -> None:
    block = formula_block("Подобие фигур относительного движения", 5, width=70)
    assert isinstance(block, Lines)
    assert block.width <= 70


def test_signs_of_equality_are_under_one_another() -> None:
    texts = ["v_{B} = 1,5·2 = 3 м/с", "ω_{43} = 2", "△abc ~ △ABC", "R_{max} = 1"]
    blocks = formula_blocks(texts, 3.5)
    places = []
    for text, block in zip(texts, blocks, strict=True):
        runs = [item for item in block.place(0j) if isinstance(item, Text)]
        line = next((run for run in runs if "=" in run.text), None)
        if line is None:
            assert runs[0].at.real == 0.0, text
            continue
        before = line.text.partition("=")[0]
        places.append(line.at.real + in_use().width(before, line.height))
    assert max(places) - min(places) < 0.01
    assert min(min(i.at.real for i in b.place(0j) if isinstance(i, Text)) for b in blocks) == 0.0


def test_a_long_formula_goes_on_under_its_sign_of_equality() -> None:
    text = r"v_{B} = \frac{1,5·2·0,25 + 17}{0,01} = 0,25·(12,5 + 75) = 3 м/с"
    (block,) = formula_blocks([text], 3.5, width=50.0)
    assert isinstance(block, Lines)
    assert block.width <= 50.0
    _, *others = block.inscriptions
    assert others
    for line in others:
        assert line.runs[0].text.startswith("=")
        assert line.runs[0].x == pytest.approx(equals_at(text, 3.5))
