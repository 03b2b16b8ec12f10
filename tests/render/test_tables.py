from __future__ import annotations

import pytest
from doors import (
    Arc,
    Column,
    DrawingItem as Item,
    Fill,
    LayoutError,
    Pen,
    Picture,
    Row,
    Spacer,
    Stroke,
    TableCell,
    TableColumn,
    TableForm,
    Text,
    block_heading as heading,
    in_use,
    lint,
    paragraph,
    table_block,
    typeset,
)
from hypothesis import given, settings, strategies as st
from reading import texts

COLUMNS = (
    TableColumn("№", ("1", "2")),
    TableColumn("v_{B}", ("3,20", "12,345"), "м/с"),
    TableColumn("v_{CB}", ("1,55", "2"), "м/с"),
    TableColumn("ω_{2}", (TableCell("15,5", 1), TableCell("0", 0)), "с^{-1}"),
)


def runs_of(items: list[Item], text: str) -> list[Text]:
    return [run for run in texts(items) if run.text == text]


def strokes(items: list[Item], pen: Pen) -> list[Stroke]:
    return [i for i in items if isinstance(i, Stroke) and i.pen is pen]


def test_every_text_is_in_its_cell() -> None:
    items = table_block(COLUMNS).place(10 + 100j)
    assert all(run.box is not None for run in texts(items))
    assert lint(items) == []


def test_outline_is_thick_and_inner_lines_are_thin() -> None:
    table = table_block(COLUMNS)
    items = table.place(10 + 100j)
    outline = next(s for s in strokes(items, Pen.MAIN) if s.closed)
    assert max(p.real for p in outline.points) == pytest.approx(10 + table.width)
    assert min(p.imag for p in outline.points) == pytest.approx(100 - table.height)
    # Between rows: one under the units (columns with units only), one between the values.
    across = [s for s in strokes(items, Pen.THIN) if s.points[0].imag == s.points[1].imag]
    assert len(across) == 2


def test_equal_units_share_one_cell_under_the_symbols() -> None:
    items = table_block(COLUMNS).place(0j)
    (unit,) = runs_of(items, "м/с")
    symbols = [run for run in runs_of(items, "v") if run.box]
    assert unit.box is not None
    assert symbols[0].box is not None
    assert symbols[1].box is not None
    assert unit.box[0] == symbols[0].box[0]
    assert unit.box[2] == symbols[1].box[2]
    assert unit.box[3] == symbols[0].box[1]


def test_a_head_without_unit_takes_both_rows() -> None:
    items = table_block(COLUMNS).place(0j)
    (number,) = runs_of(items, "№")
    assert number.box is not None
    assert number.box[3] - number.box[1] == pytest.approx(16)


def test_decimal_commas_are_aligned() -> None:
    items = table_block(COLUMNS).place(0j)
    ends = [
        run.at.real + in_use().width(run.text.split(",")[0], run.height)
        for text in ("3,20", "12,345")
        for run in runs_of(items, text)
    ]
    assert ends[0] == pytest.approx(ends[1])


def test_sense_is_an_arc_with_a_head_inside_the_cell() -> None:
    items = table_block(COLUMNS).place(0j)
    (arc,) = [i for i in items if isinstance(i, Arc)]
    assert len([i for i in items if isinstance(i, Fill)]) == 1
    (value,) = runs_of(items, "15,5")
    assert value.box is not None
    assert value.at.real + in_use().width("15,5", 3.5) < arc.centre.real - arc.radius
    assert arc.centre.real + arc.radius < value.box[2]


def test_senses_are_mirror_images() -> None:
    heads = []
    for sense in (1, -1):
        items = table_block([TableColumn("ω", (TableCell("5", sense),), "1/с")]).place(0j)
        (arc,) = [i for i in items if isinstance(i, Arc)]
        (head,) = [i for i in items if isinstance(i, Fill)]
        heads.append([p - arc.centre for p in head.points])
    assert heads[0][0].real == pytest.approx(-heads[1][0].real)
    assert heads[0][0].imag == pytest.approx(heads[1][0].imag)
    assert heads[0][0].real < 0 < heads[0][0].imag  # on top, to the left: counter-clockwise


def test_stretches_to_a_width() -> None:
    assert table_block(COLUMNS, width=185).width == pytest.approx(185)


def test_wide_values_shrink_then_the_column_grows() -> None:
    value = "1234567"
    for aim, height in ((40.0, 3.5), (17.5, 2.5), (8.0, 2.5)):
        table = table_block([TableColumn("v", (value,), width=aim)])
        (run,) = runs_of(table.place(0j), value)
        assert run.height == height
        assert table.width == pytest.approx(aim) or table.width > aim
    assert table.width > 8


def test_too_wide_a_table_shrinks_first_and_then_is_cut_into_parts() -> None:
    columns = [TableColumn("φ", ("10", "20"), "°")]
    columns += [TableColumn(f"v_{{{k}}}", ("123,45", "−6,1"), "м/с") for k in range(12)]
    full = table_block(columns)
    smaller = table_block(columns, max_width=full.width * 0.97)
    assert {run.height for run in runs_of(smaller.place(0j), "123,45")} == {2.5}
    parts = table_block(columns, TableForm(leading=1), max_width=100)
    items = parts.place(0j)
    assert parts.width <= 100
    outlines = [s for s in strokes(items, Pen.MAIN) if s.closed]
    assert len(outlines) > 1
    assert len({round(max(p.real for p in s.points), 6) for s in outlines}) == 1
    assert len(runs_of(items, "φ")) == len(outlines)
    assert len(runs_of(items, "123,45")) == 12
    assert lint(items) == []


def test_a_table_is_not_cut_within_joined_cells() -> None:
    columns = [TableColumn("№", ("1",))]
    for k in range(7):
        columns += [TableColumn(f"v_{k}", ("1,00",)), TableColumn("Δ", ("0,1",), joined=True)]
    body = table_block(columns, TableForm(leading=1), max_width=90.0)
    items = body.place(0j)
    assert body.width <= 90.0
    rows: dict[float, list[str]] = {}
    for run in texts(items):
        rows.setdefault(round(run.at.imag, 3), []).append(run.text)
    heads = [row for row in rows.values() if "№" in row]
    assert len(heads) > 1
    assert all(row.count("v") == row.count("Δ") > 0 for row in heads)


def test_a_column_wider_than_the_sheet_is_an_error() -> None:
    with pytest.raises(LayoutError, match="larger paper format"):
        table_block([TableColumn("очень длинная шапка", ("1",))], max_width=20)


@pytest.mark.parametrize("columns", [(), (TableColumn("a", ("1",)), TableColumn("b", ()))])
def test_unlike_columns_are_an_error(columns: tuple[TableColumn, ...]) -> None:
    with pytest.raises(LayoutError, match="different lengths"):
        table_block(columns)


def test_blocks_are_stacked_and_set_in_rows() -> None:
    one, two = Spacer(10, 4), Picture((Stroke((0j, 6 + 8j)),), (0, 0, 6, 8))
    column = Column([one, two], gap=3, align="right")
    assert (column.width, column.height) == (10, 15)
    (stroke,) = column.place(100 + 100j)
    assert isinstance(stroke, Stroke)
    assert stroke.points == (104 + 85j, 110 + 93j)
    row = Row([one, column, two], gap=2, align="bottom")
    assert (row.width, row.height) == (30, 15)
    last = row.place(0j)[-1]
    assert isinstance(last, Stroke)
    assert last.points == (24 - 15j, 30 - 7j)


def test_paragraph_wraps_and_keeps_its_lines_apart() -> None:
    markup = "Дано: l_{AB} = 0,064 м, a^{n}_{CB} направлено от C к B.\nОпределить скорости точек."
    block = paragraph(markup, 5, 70)
    items = block.place(30 + 200j)
    assert block.width <= 70
    assert len({run.at.imag for run in texts(items) if run.height == 5}) == len(block.inscriptions)
    assert any(line.markup.endswith("B.") for line in block.inscriptions)
    assert lint(items, (30, 200 - block.height - 1e-6, 100, 200 + 1e-6)) == []


@pytest.mark.parametrize(
    ("markup", "width", "lines"),
    [
        ("v_{B}, v_{C}, ω_{2}, ε_{4}.", 25.0, ["v_{B}, v_{C},", "ω_{2}, ε_{4}."]),
        ("v_{B}, v_{C}, ω_{2}, ε_{4}.", 34.0, ["v_{B}, v_{C},", "ω_{2}, ε_{4}."]),
        ("v_{B}, v_{C}", 10.0, ["v_{B},", "v_{C}"]),  # the line before has one word alone
        ("v, расстояние CDE", 44.0, ["v, расстояние", "CDE"]),  # both do not fit
        ("v_{B}, v_{C}, направление", 30.0, ["v_{B}, v_{C},", "направление"]),
    ],
)
def test_a_short_word_is_not_alone_in_the_last_line(
    markup: str, width: float, lines: list[str]
) -> None:
    assert [line.markup for line in paragraph(markup, 5, width).inscriptions] == lines


def test_heading_shrinks_and_then_wraps() -> None:
    whole = typeset("План скоростей механизма", 7).width
    smaller = heading("План скоростей механизма", 7, width=whole * 0.8)
    assert {run.height for run in texts(smaller.place(0j))} == {5}
    wrapped = heading("План скоростей механизма", 7, width=whole * 0.6)
    assert wrapped.width <= whole * 0.6
    assert {run.height for run in texts(wrapped.place(0j))} == {7}


values = st.one_of(
    st.floats(-1e5, 1e5).map("{:.4g}".format),
    st.sampled_from(["—", "", "a^{n}_{CB}", r"\bar{v}", "мёртвое положение"]),
)


@settings(deadline=None)
@given(
    st.integers(1, 4).flatmap(
        lambda rows: st.lists(
            st.builds(
                TableColumn,
                st.sampled_from(["v_{B}", "a^{τ}_{CB}", "№", "очень длинная шапка"]),
                st.lists(
                    st.builds(TableCell, values, st.sampled_from([None, -1, 0, 1])),
                    min_size=rows,
                    max_size=rows,
                ).map(tuple),
                st.sampled_from(["", "м/с", "м/с^{2}"]),
                st.sampled_from([None, 10.0, 25.0]),
            ),
            min_size=1,
            max_size=8,
        )
    ),
    st.sampled_from([None, 120.0, 185.0]),
    st.sampled_from(["below", "none"]),
)
def test_tables_of_all_kinds_are_clean(
    columns: list[TableColumn],
    width: float | None,
    units: str,
) -> None:
    table = table_block(columns, TableForm(units=units), max_width=width, title="Таблица")  # type: ignore[arg-type]
    assert width is None or table.width <= width + 1e-6
    assert [f.message for f in lint(table.place(20 + 300j))] == []
