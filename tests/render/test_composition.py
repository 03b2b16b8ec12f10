"""Compositions: the shipped ones draw everything, files are read with all their faults at once."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path

import pytest
from cases import some
from doors import (
    BLOCKS,
    FRAME_FORMATS as FORMATS,
    MOTION,
    SHIPPED,
    WORDING_LANGUAGES as LANGUAGES,
    Block,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    Column,
    Composition,
    CompositionError,
    Drawing,
    DrawingArea,
    ExitCode,
    Furniture,
    LayoutError,
    PageTrial,
    Scales,
    Solution,
    Text,
    TrialPaper,
    View,
    about,
    block_heading as heading,
    composition,
    entries,
    get_language,
    ink_bounds,
    kinematics_sheets,
    lint,
    problem_loads as loads,
    read_composition,
    reader,
    sheets_blocks as kinds,
    shipped,
    shipped_text,
)
from hypothesis import given, settings, strategies as st
from mechanisms import REVERSED
from msgspec.structs import replace
from worked import ROOT, SIX, drawn_sheets, path_of, problem_of

from benchmarks.generator import random_problem

FAULTY = sorted((Path(__file__).parent / "faulty_layouts").glob("*.toml"))
TURN = [30.0 * k for k in range(12)]
SHEETS = ROOT / "planmethod/render/sheets"


def positions_of(name: str, layout: str) -> list[float] | None:
    if layout != "coursework-12":
        return None
    return [150.0 + 10.0 * k for k in range(12)] if name == "levers/six-link" else TURN


def shown(sheet: Drawing) -> str:
    """Return the texts of a sheet in one line."""
    texts = " ".join(item.text for item in sheet.items if isinstance(item, Text))
    return re.sub(r"\s+", " ", texts)


def marks(sheet: Drawing) -> list[str]:
    (fmt,) = (f for f in FORMATS.values() if (f.width, f.height) == (sheet.width, sheet.height))
    return [f"{finding.code} {finding.message}" for finding in lint(sheet.items, fmt.inner)]


def place(sheet: Drawing, start: str) -> complex:
    """Return where the first text begins that starts so."""
    found = (i for i in sheet.items if isinstance(i, Text) and i.text.startswith(start))
    return next(found).at


def view(sheet: Drawing, kind: str) -> View:
    return next(v for v in sheet.views if v.kind == kind)


def made(text: str) -> Composition:
    return read_composition(text, name="mine.toml")


# Shipped ones -------------------------------------------------------------------------------------


def test_the_shipped_layouts_are_the_files_in_the_folder() -> None:
    files = {path.stem for path in (SHEETS / "compositions").glob("*.toml")}
    assert files == set(SHIPPED)
    for name in SHIPPED:
        for lang in LANGUAGES:
            assert shipped(name, lang).about == about(name, lang) != ""
            russian = re.search("[а-я]", shipped_text(name, lang))
            assert (russian is not None) is (lang == "ru")


OTHERS = (
    *("forces", "forces-cycle", "friction", "flywheel", "run-up", "balancing", "coursework"),
    *("project-kinematics", "project-forces"),
    "graphs",  # test_graphs
    "synthesis",  # test_synthesis_table
    "four-sheets",  # test_four_sheets
    "superposition",  # of several drivers: test_superposition
    "compact",  # at other scales than the files': test_sheet_options
)
KINEMATIC = tuple(name for name in SHIPPED if name not in OTHERS)
"""The sheet of the turn, ``coursework``, has its own tests: ``test_turn_sheet``."""


@pytest.mark.parametrize("layout", [name for name in KINEMATIC if name != "many-positions"])
@pytest.mark.parametrize("name", SIX)
def test_every_shipped_composition_draws_every_problem(name: str, layout: str) -> None:
    """The one of many positions is checked with its sheets in ``test_sheets``."""
    sheets = drawn_sheets(name, positions_of(name, layout), layout=layout)
    assert sheets
    for sheet in sheets:
        assert marks(sheet) == []
        if not sheet.views:
            assert "Расчёт" in shown(sheet)  # blocks that did not fit beside the plans
            continue
        kinds_shown, told = {"position", "velocity", "acceleration"}, "Уравнения"
        if layout == "analytic":
            kinds_shown, told = {"position", "graphs"}, "Аналитический метод"
        if layout == "centres":
            kinds_shown, told = {"position", "velocity"}, "Мгновенные центры"
        assert {v.kind for v in sheet.views} == kinds_shown
        for part in ("Дано:", "Определить:", told):
            assert part in shown(sheet)


@pytest.mark.parametrize("layout", KINEMATIC)
def test_a_composition_for_many_positions_draws_one_and_the_other_way_round(layout: str) -> None:
    """Graphs number the positions of a turn, so that the analytic sheet takes an even one."""
    problem = problem_of("linkages/ex3")
    many = [20.0, 50.0, 80.0]
    if layout == "analytic":
        with pytest.raises(LayoutError, match="a number would refer to two positions"):
            kinematics_sheets(problem, layout=layout, positions=many)
        many = TURN
    for positions in ([20.0], many):
        sheets = kinematics_sheets(problem, layout=layout, positions=positions)
        assert sheets
        assert all(marks(sheet) == [] for sheet in sheets)


def test_the_default_layout_depends_on_the_number_of_positions() -> None:
    problem = problem_of("linkages/ex1")
    for positions, name in (
        (None, "one-position"),
        (TURN[:3], "few-positions"),
        (TURN, "many-positions"),
    ):
        plain = kinematics_sheets(problem, positions=positions)
        asked = kinematics_sheets(problem, positions=positions, layout=name)
        assert [sheet.items for sheet in plain] == [sheet.items for sheet in asked]


def test_the_order_of_the_textbook() -> None:
    """The scheme upper left, Дано under it; the velocity plan right of it, the next one below."""
    (sheet,) = drawn_sheets("linkages/ex1", layout="homework")
    scheme, velocity, acceleration = (
        view(sheet, kind).box for kind in ("position", "velocity", "acceleration")
    )
    assert place(sheet, "Дано").imag < scheme[1]
    assert velocity[0] > scheme[2]
    assert acceleration[3] < velocity[1]
    results = place(sheet, "Таблица")
    assert results.real > acceleration[2]
    assert 60.0 < results.imag < acceleration[3]
    assert "Схема механизма" in shown(sheet)


def test_twelve_positions_are_arranged_as_in_a_coursework() -> None:
    """The scheme left, velocity plans in two rows of six, accelerations below, then the table."""
    (sheet,) = drawn_sheets("press/press", TURN, layout="coursework-12")
    scheme, velocity, acceleration = (
        view(sheet, kind).box for kind in ("position", "velocity", "acceleration")
    )
    assert scheme[2] < min(velocity[0], acceleration[0])
    assert velocity[1] > acceleration[3]
    assert place(sheet, "Измеренные").imag < acceleration[1]
    captions = [
        item.at.imag
        for item in sheet.items
        if isinstance(item, Text)
        and re.fullmatch(r"\d+: φ", item.text)
        and item.at.imag > velocity[1]
    ]
    rows = sorted({round(y, 1) for y in captions})
    assert len(rows) == 2
    assert [sum(abs(y - row) < 0.1 for y in captions) for row in rows] == [6, 6]


@pytest.mark.parametrize("name", SIX)
def test_a_plan_is_beside_its_equations(name: str) -> None:
    """No part of the other is in the hull of a plan and its equations; each has its calculation."""
    (sheet,) = drawn_sheets(name)
    own = {}
    for kind, genitive in (("velocity", "скоростей"), ("acceleration", "ускорений")):
        box = view(sheet, kind).box
        at = place(sheet, f"Уравнения {genitive}")
        own[kind] = (
            min(box[0], at.real),
            min(box[1], at.imag),
            max(box[2], at.real),
            max(box[3], at.imag),
        )
        assert place(sheet, f"Расчёт {genitive}")
    own["position"] = view(sheet, "position").box
    for one, two in combinations(own.values(), 2):
        across = min(one[2], two[2]) - max(one[0], two[0])
        along = min(one[3], two[3]) - max(one[1], two[1])
        assert min(across, along) <= 0.0


@pytest.mark.parametrize("name", SIX)
def test_scales_of_the_default_are_those_that_solve_prints(name: str) -> None:
    text = re.sub(r"(?m)^\[scales\]\n(?:[^\[\n].*\n|\n)*", "", path_of(name).read_text("utf-8"))
    problem = loads(text, name="free")
    solution = Solution(problem)
    (sheet,) = kinematics_sheets(problem)
    for kind in MOTION:
        assert view(sheet, kind.value).per_mm == solution.scales[kind].per_mm


@pytest.mark.parametrize("corner", ["left", "right"])
@pytest.mark.parametrize("name", SIX)
def test_sheets_keep_clear_of_graph_26(
    name: str, corner: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The cell of graph 26, 70x14 mm in the upper left corner, or turned in the upper right one."""
    views = shipped("one-position").views_for("A1", 1)
    solution = Solution(problem_of(name), views=views)
    fmt = FORMATS["A1"]
    left, _, right, top = fmt.inner
    cell = (left, top - 14.0, left + 70.0, top)
    if corner == "right":
        cell = (right - 14.0, top - 70.0, right, top)
    room = DrawingArea(fmt.inner, fmt.stamp, (cell,))
    monkeypatch.setattr(Furniture, "drawing_area", lambda *_: room)
    options = BlockOptions(get_language("ru"))
    trial = PageTrial(shipped("one-position"), TrialPaper(fmt, Furniture()), options)
    found = trial.pages(solution, (0,))
    assert found is not None
    (page,) = found
    for item in (item for block, at in page.placed for item in block.place(at)):
        box = ink_bounds([item])
        across = max(box[0] - cell[2], cell[0] - box[2])
        along = max(box[1] - cell[3], cell[1] - box[3])
        assert max(across, along) > 1.0


# A composition of one's own -----------------------------------------------------------------------


TWO_SHEETS = """
formats = ["A3", "A2"]
[sheets.1]
title = "Схема и скорости"
[sheets.2]
title = "Ускорения"
[[blocks]]
kind = "scheme"
title = "Кинематическая схема"
title_height = 7
[[blocks]]
kind = "plan"
of = "velocity"
letter = 3.5
[[blocks]]
kind = "results"
title = "Скорости"
columns = ["v", "omega"]
[[blocks]]
kind = "plan"
of = "acceleration"
title = "План ускорений a_{B}"
sheet = 2
[[blocks]]
kind = "text"
title = "Примечание"
text = \"\"\"
1. Масштаб a_{B} выбран по ряду.
2. Отрезки сняты линейкой.
\"\"\"
height = 5
"""


def test_sheets_titles_columns_and_texts_follow_the_file() -> None:
    one, two = kinematics_sheets(problem_of("linkages/ex3"), layout=made(TWO_SHEETS))
    assert (one.title, two.title) == ("Схема и скорости", "Ускорения")
    assert [v.kind for v in one.views] == ["position", "velocity"]
    assert [v.kind for v in two.views] == ["acceleration"]
    assert "Кинематическая схема" in shown(one)
    assert "ω" in shown(one)
    assert "м/с2" not in shown(one).replace(" ", "")
    assert "Уравнения" not in shown(one) + shown(two)
    assert "1. Масштаб a" in shown(two)
    heights = {i.text: i.height for i in [*one.items, *two.items] if isinstance(i, Text)}
    assert heights["Кинематическая схема"] == 7
    assert heights["2. Отрезки сняты линейкой."] == 5
    assert marks(one) == marks(two) == []


def test_the_requested_title_outranks_that_of_the_layout() -> None:
    sheets = kinematics_sheets(
        problem_of("linkages/ex3"), layout=made(TWO_SHEETS), fields={"title": "Мой лист"}
    )
    assert {sheet.title for sheet in sheets} == {"Мой лист"}


def test_blocks_are_in_the_order_of_the_file() -> None:
    text = """
formats = ["A2"]
arrange = "column"
[[blocks]]
kind = "statement"
[[blocks]]
kind = "plan"
of = "velocity"
[[blocks]]
kind = "scheme"
[[blocks]]
kind = "results"
"""
    (sheet,) = kinematics_sheets(problem_of("linkages/ex1"), layout=made(text))
    levels = [
        place(sheet, "Дано").imag,
        view(sheet, "velocity").box[3],
        view(sheet, "position").box[3],
        place(sheet, "Результаты").imag,
    ]
    assert levels == sorted(levels, reverse=True)


def test_a_block_that_must_stay_is_never_left_out() -> None:
    """The calculation of the default goes to a sheet of its own, a required one stays."""
    default = shipped_text("one-position")
    strict = made(default.replace("droppable = true", "droppable = false"))
    problem = problem_of("levers/task-33")
    loose = kinematics_sheets(problem, paper="A3", layout=made(default))
    *plans, texts = loose
    assert "Расчёт" not in "".join(map(shown, plans))
    assert shown(texts).count("Расчёт") == 2
    assert not texts.views
    asked = kinematics_sheets(problem, paper="A3", layout=strict)
    assert "".join(map(shown, asked)).count("Расчёт") == 2
    assert not any(sheet.is_continuation for sheet in asked)


def test_texts_take_the_larger_letters_if_they_fit() -> None:
    """All shrink equally until they fit; then those that can grow again, below twice the least."""
    text = re.sub(r"height = \[.*\]", "height = [5, 3.5, 2.5]", shipped_text("one-position"))
    (sheet,) = kinematics_sheets(problem_of("levers/task-57"), layout=made(text))
    titles = ("Дано", "Уравнения", "Расчёт", "Результаты")
    heights = {
        item.height
        for item in sheet.items
        if isinstance(item, Text) and item.text.startswith(titles)
    }
    assert len(heights) > 1
    assert max(heights) < 2 * min(heights)


def test_one_position_of_many_and_its_calculation() -> None:
    text = """
formats = ["A2", "A1"]
[[blocks]]
kind = "scheme"
position = 2
[[blocks]]
kind = "plan"
of = "velocity"
position = 2
[[blocks]]
kind = "calculation"
of = "velocity"
position = 2
[[blocks]]
kind = "results"
"""
    problem = problem_of("linkages/ex3")
    (sheet,) = kinematics_sheets(problem, layout=made(text), positions=[20.0, 50.0, 80.0])
    assert "План скоростей" in shown(sheet)
    assert "Расчёт скоростей (положение 2)" in shown(sheet)
    assert {span.position for span in view(sheet, "velocity").spans} == {2}
    with pytest.raises(LayoutError, match=r"blocks\[0\]\.position is 2, but the last of 2"):
        kinematics_sheets(problem, layout=made(text), positions=[20.0, 50.0])


def test_boxes_of_views_set_their_scales() -> None:
    text = shipped_text("one-position")
    wide = text.replace(
        "A1 = { letter = 5, title = 7, text = 3.5, column = 200 }",
        "A1 = { letter = 5, title = 7, text = 3.5, column = 200, velocity = [60, 60] }",
    )
    problem = problem_of("press/press")
    usual = kinematics_sheets(problem, paper="A1", layout=made(text))[0]
    small = kinematics_sheets(problem, paper="A1", layout=made(wide))[0]
    assert view(small, "velocity").per_mm > 2 * view(usual, "velocity").per_mm
    assert view(small, "acceleration").per_mm <= view(usual, "acceleration").per_mm


def test_plans_grow_into_free_paper_and_given_scales_stay() -> None:
    text = shipped_text("one-position")
    grows = made(text.replace("grow = false", "grow = true"))
    free, given_ = problem_of("press/press"), problem_of("linkages/ex3")
    (usual,) = kinematics_sheets(free, paper="A0", layout=made(text))
    (large,) = kinematics_sheets(free, paper="A0", layout=grows)
    pairs = [
        (view(large, kind).per_mm, view(usual, kind).per_mm)
        for kind in ("position", "velocity", "acceleration")
    ]
    assert all(new <= old for new, old in pairs)
    assert any(new < old for new, old in pairs)
    assert marks(large) == []
    assert "Расчёт ускорений" in shown(large)
    (kept,) = kinematics_sheets(given_, layout=grows)
    (same,) = kinematics_sheets(given_)
    assert [v.per_mm for v in kept.views] == [v.per_mm for v in same.views]


def test_a_new_kind_of_block_is_a_function_and_its_lines(monkeypatch: pytest.MonkeyPatch) -> None:
    def signature(solution: Solution, indices: object, manner: BlockStyle) -> Block:
        return Column([heading(f"Подпись: {solution.problem.title}", manner.text(3.5))])

    signed = kinds.BlockKind(lambda: {"signature": signature}, ("height",))
    monkeypatch.setitem(BLOCKS, "signature", signed)
    text = '[[blocks]]\nkind = "scheme"\n[[blocks]]\nkind = "signature"\nheight = 5\n'
    (sheet,) = kinematics_sheets(problem_of("linkages/ex1"), layout=made(text))
    assert "Подпись:" in shown(sheet)


# Files --------------------------------------------------------------------------------------------


def test_sizes_that_are_left_out_are_those_of_the_first_composition() -> None:
    mine = made('[sizes]\nA2 = { text = 5 }\n[[blocks]]\nkind = "scheme"\n')
    usual = shipped("one-position").sizes
    assert mine.sizes["A2"].text == 5
    assert mine.sizes["A2"].letter == usual["A2"].letter
    assert mine.sizes["A1"] == usual["A1"]
    assert mine.sizes_for("A3x3") == mine.sizes["A2"]


@pytest.mark.parametrize(
    ("per_sheet", "count", "tried"),
    [
        ((12, 6, 4, 2, 1), 12, (12, 6, 4, 2, 1)),
        ((12, 6, 4, 2, 1), 3, (4, 2, 1)),
        ((12, 6, 4, 2, 1), 30, (12, 6, 4, 2, 1)),
        ((12, 6), 3, (6,)),
        ((12, 6), 1, (1,)),
        ((4,), 7, (4,)),
    ],
)
def test_positions_on_one_sheet(
    per_sheet: tuple[int, ...], count: int, tried: tuple[int, ...]
) -> None:
    mine = made(f'per_sheet = {list(per_sheet)}\n[[blocks]]\nkind = "scheme"\n')
    assert mine.list_per_sheet(count) == tried


@pytest.mark.parametrize("name", ["linkages/ex3", "levers/task12"])
def test_scales_of_the_file_that_are_too_fine_for_other_positions_are_left(name: str) -> None:
    problem = problem_of(name)
    assert problem.scales != Scales(problem.scales.convention)
    sheets = kinematics_sheets(problem, positions=[0.0, 120.0, 240.0])
    assert [sheet.width for sheet in sheets] in ([841], [594])


def test_the_sheet_of_a_block_is_that_of_the_one_before() -> None:
    blocks = '[[blocks]]\nkind = "scheme"\nsheet = {}\n' * 2 + '[[blocks]]\nkind = "results"\n'
    mine = made(blocks.format(1, 2))
    assert [entry.sheet for entry in mine.blocks] == [1, 2, 2]
    assert mine.sheets == (1, 2)


def test_defaults_of_a_block() -> None:
    (entry,) = made('[[blocks]]\nkind = "scheme"\n').blocks
    assert entry == BlockSpec("scheme")


@pytest.mark.parametrize("path", FAULTY, ids=lambda path: path.stem)
def test_every_fault_of_a_file_is_reported_and_no_other(path: Path) -> None:
    mark = "# fault: "
    text = path.read_text("utf-8")
    expected = [line.removeprefix(mark) for line in text.splitlines() if line.startswith(mark)]
    with pytest.raises(CompositionError) as caught:
        composition(path)
    assert [str(fault) for fault in caught.value.faults] == expected
    assert caught.value.exit_code is ExitCode.USAGE
    plural = "s" if len(expected) > 1 else ""
    head = f"{path}: {len(expected)} fault{plural} in the layout file"
    assert str(caught.value).splitlines()[0] == head


def test_there_are_faulty_files_of_many_kinds() -> None:
    assert len(FAULTY) >= 15


@pytest.mark.parametrize("markup", ["_{" * 900, "x" + "_{a" * 60 + "}" * 60, "\\bar{" * 30])
def test_rich_text_is_bounded(markup: str) -> None:
    with pytest.raises(CompositionError):
        made(f"[[blocks]]\nkind = 'text'\ntext = '{markup}'\n")


VALUES = st.recursive(
    st.none().map(lambda _: "1979-05-27")
    | st.booleans().map(lambda value: str(value).lower())
    | st.integers(-5, 5).map(str)
    | st.sampled_from(
        ['"row"', '"velocity"', '"left"', '"a.b"', '"v"', '""', '"A2"', "nan", "0.5"]
    ),
    lambda inner: st.lists(inner, max_size=3).map(lambda items: f"[{', '.join(items)}]"),
    max_leaves=4,
)
KEYS = st.sampled_from(
    sorted({*reader.TOP, *entries.ALWAYS, *(key for kind in BLOCKS.values() for key in kind.keys)})
)


@settings(deadline=None, max_examples=some(400, few=60))
@given(
    st.dictionaries(KEYS, VALUES, max_size=4),
    st.lists(st.tuples(st.sampled_from(list(BLOCKS)), st.dictionaries(KEYS, VALUES, max_size=4))),
)
def test_random_files_are_read_or_rejected(
    top: dict[str, str], blocks: list[tuple[str, dict[str, str]]]
) -> None:
    def lines() -> Iterator[str]:
        yield from (f"{key} = {value}" for key, value in top.items())
        for kind, keys in blocks:
            yield "[[blocks]]"
            yield from (f"{k} = {v}" for k, v in {**keys, "kind": f'"{kind}"'}.items())

    try:
        found = made("\n".join(lines()))
    except CompositionError as error:
        assert error.faults
    else:
        assert found.blocks


# Documentation ------------------------------------------------------------------------------------


def test_the_documents_name_every_key_and_no_other() -> None:
    page = (ROOT / "docs/reference/layout-file.md").read_text("utf-8")
    blocks = (ROOT / "docs/reference/layouts.md").read_text("utf-8")
    tables = re.findall(r"(?m)^\| key \| (?:value|meaning) \|\n(?:\|.*\n)*", page + blocks)
    named = {key for table in tables for key in re.findall(r"(?m)^\| `([a-z_]+)` \|", table)}
    known = {
        *reader.TOP,
        *reader.SIZES,
        *reader.SHEET,
        *entries.GROUP,
        *entries.ALWAYS,
        *(key for kind in BLOCKS.values() for key in kind.keys),
    }
    assert named == known
    for name, kind in BLOCKS.items():
        (row,) = re.findall(rf"(?m)^\| `{name}` \|.*\| (.*) \|$", blocks)
        assert tuple(re.findall(r"`(\w+)`", row)) == kind.keys
        assert callable(kinds.maker_of(name))
    for name in SHIPPED:
        assert f"`{name}`" in blocks


def test_the_examples_of_the_document_can_be_read() -> None:
    text = (ROOT / "docs/reference/layout-file.md").read_text("utf-8")
    examples = re.findall(r"(?ms)^```toml\n(.*?)^```$", text)
    assert examples
    for example in examples:
        whole = example if "[[blocks]]" in example else f'{example}\n[[blocks]]\nkind = "scheme"\n'
        assert made(whole).blocks


def test_scales_of_the_file_for_another_position_do_not_stop_a_sheet() -> None:
    """Near a dead position the plans at those scales do not fit A0."""
    problem = problem_of("linkages/ex3")
    (sheet,) = kinematics_sheets(problem, positions=(270.0,))
    (found,) = (view.per_mm for view in sheet.views if view.kind == "acceleration")
    assert problem.scales.mu_a is not None and found > problem.scales.mu_a
    own = replace(problem, drive=replace(problem.drive, positions=(270.0,)))
    with pytest.raises(LayoutError, match="coarser scales"):
        kinematics_sheets(own)


def test_blocks_too_large_at_their_scales_are_tried_at_those_of_the_paper() -> None:
    """Before a larger paper is taken."""
    (sheet,) = kinematics_sheets(problem_of("levers/task-1"))
    assert sheet.width == 594


def test_a_heading_of_the_analytic_method_stands_over_its_formulas() -> None:
    """The last heading of this mechanism would be the last line of a column."""
    (sheet,) = kinematics_sheets(loads(REVERSED, name="own"), layout="analytic")
    texts = [item for item in sheet.items if isinstance(item, Text)]
    titles = [one for one in texts if re.match(r"Группа|Начальное|Скорости", one.text)]
    assert len(titles) == 3
    for title in titles:
        right = (one.at - title.at for one in texts)
        below = [-way for way in right if -1.0 < way.real < 20.0]  # signs of equality aligned
        assert [way for way in below if 0.0 < way.imag < 12.0], title.text


def test_one_position_has_its_calculation_on_larger_paper() -> None:
    """Its statement of eleven lines leaves no room for it on A2, and A4 is too low for it."""
    problem = loads(random_problem(98_004)[0], name="random")
    (sheet,) = kinematics_sheets(problem)
    assert (sheet.width, sheet.has_omissions) == (841.0, False)
    assert shown(sheet).count("Расчёт") == 2
    (asked, *_) = kinematics_sheets(problem, paper="A2")
    assert (asked.width, asked.has_omissions) == (594.0, True)


def test_one_of_two_calculations_is_enlarged_alone() -> None:
    """That of the acceleration fits only in letters of 2.5 mm; beside the other one is white."""
    problem = loads(random_problem(62_103)[0], name="random")
    (sheet,) = kinematics_sheets(problem)
    heights = {
        item.text: item.height
        for item in sheet.items
        if isinstance(item, Text) and item.text.startswith("Расчёт")
    }
    assert heights == {"Расчёт скоростей": 3.5, "Расчёт ускорений": 2.5}


def test_plans_are_coarser_by_one_scale_for_a_calculation_in_letters_of_the_other_texts() -> None:
    """At the finest scales on A2 the calculations of this mechanism have letters of 2.5 mm."""
    (sheet,) = kinematics_sheets(loads(random_problem(62_109)[0], name="random"))
    heights = [
        item.height
        for item in sheet.items
        if isinstance(item, Text) and item.text.startswith("Расчёт")
    ]
    assert (heights, sheet.width) == ([3.5, 3.5], 594.0)
    lengths = [span.length for view in sheet.views for span in view.spans]
    assert sorted(lengths)[len(lengths) // 2] > 25.0


def test_large_plans_of_few_positions_have_names_of_vectors_as_high_as_single_ones() -> None:
    problem = loads(random_problem(62_103)[0], name="random")
    first = problem.drive.positions[0]
    (sheet, *_) = kinematics_sheets(problem, positions=[first, first + 20.0])
    names = [
        item
        for item in sheet.items
        if isinstance(item, Text) and item.label.startswith(("velocity 0: v", "velocity 1: v"))
    ]
    assert {item.height for item in names} == {3.5, 2.5}  # letters and their indices
