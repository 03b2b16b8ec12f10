from __future__ import annotations

import re
import shutil
import subprocess
import zipfile
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from io import BytesIO
from itertools import pairwise
from pathlib import Path

import numpy as np
import openpyxl
import pytest
import worked
from cases import each
from doors import (
    FIGURES_WIDTH as WIDTH,
    LETTER,
    MOTION_KINDS,
    RATES,
    WORDING_LANGUAGES as LANGUAGES,
    Document,
    FittedView,
    FlywheelMethod,
    GearProblem,
    Language,
    MeshingProblem,
    NoteOptions,
    PartName,
    ProblemError,
    Project,
    QuantityKind,
    Report,
    SizeTable,
    Solution,
    Text,
    Train,
    calculation,
    compared,
    conclusion,
    cycle_forces_of,
    document,
    drawing_of,
    flywheel_chapter,
    flywheel_of,
    friction_of,
    get_language,
    in_mesh,
    inlined,
    kinds_load as load,
    kinds_on,
    meshed,
    note_document,
    note_files,
    numbers_of,
    numbers_workbook,
    part_drawings,
    plain_document,
    plain_text,
    reported_quantities,
    settle,
    sheet_list,
    solve_motion,
    statement_given_facts as given_facts,
    statics_of,
    train_chapter,
    train_facts as train_given,
    warn_of_separate_train,
)
from evaluated import count_equations_that_hold
from msgspec.structs import replace
from worked import ROOT, path_of, problem_of

TEMPLATE = ROOT / "planmethod/problem/templates/project.toml"

FILES = {
    "shaper": ROOT / "tests/data/projects/shaper.toml",
    "engine": ROOT / "tests/data/projects/engine.toml",
    "rubbing": ROOT / "tests/data/projects/rubbing.toml",
    "homework": path_of("linkages/ex3"),
    "forces": path_of("press/press"),
    "slider": path_of("levers/task-33"),
}

HEADINGS = (document.StructuralHeading, document.Chapter, document.Part)

SHAPER = (
    "Структурный анализ механизма",
    "Кинематический анализ механизма",
    "Аналоги скоростей и ускорений",
    "Силовой расчёт механизма",
    "Расчёт маховика",
    "Зубчатый механизм",
)


def project_of(name: str) -> Project:
    return worked.project_of(TEMPLATE if name == "template" else FILES[name])


@cache
def note_of(name: str, lang: str = "ru") -> Document:
    return note_document(project_of(name), get_language(lang))


@cache
def text_of(name: str, lang: str = "ru") -> str:
    return plain_document(note_of(name, lang), get_language(lang))


def scales_of(name: str) -> str:
    """Return the scales of a project as its file has them: given, they are not searched again."""
    scales = project_of(name).scales
    lines = (f"mu_{of} = {getattr(scales, f'mu_{of}')!r}" for of in "lvaF")
    return "\n".join(("\n[scales]", *lines, ""))


def chapters(written: Document) -> tuple[str, ...]:
    return tuple(node.title for node in written.nodes if isinstance(node, document.Chapter))


def tables_of(name: str) -> dict[str, document.Table]:
    return {n.key: n for n in note_of(name).nodes if isinstance(n, document.Table)}


def texts(written: Document) -> Iterator[str]:
    """Yield every rich text of a note."""
    for node in written.nodes:
        for name in ("text", "title", "caption", "name"):
            yield str(getattr(node, name, ""))
        if isinstance(node, document.Table):
            yield from (cell for row in (node.head, *node.rows) for cell in row)


# Chapters ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FILES)
def test_no_paragraph_is_empty(name: str) -> None:
    """With weights and inertia forces only, there is no paragraph on loads."""
    texts = [node.text for node in note_of(name).nodes if isinstance(node, document.Paragraph)]
    assert all(texts)


def test_a_note_has_the_chapters_that_the_file_has_something_for() -> None:
    assert chapters(note_of("shaper")) == SHAPER
    assert chapters(note_of("homework")) == SHAPER[:3]
    assert chapters(note_of("forces")) == ("Синтез кулисного механизма", *SHAPER[:4])


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_note_has_theory_on_request(lang: str, tmp_path: Path) -> None:
    """The cases of motion are those of the mechanism; its sliding pairs are all on the frame."""
    path = tmp_path / "my.toml"
    path.write_text(path_of("linkages/ex1").read_text("utf-8") + "\n[project]\ntheory = true\n")
    language = get_language(lang)
    written = note_document(worked.project_of(path), language)
    said = "\n".join(texts(written))
    theory = language.report["theory"]
    assert "W = 3(k − 1) − 2p" in said and "3·(4 − 1) − 2·4 − 0 = 1." in said
    assert (
        f"M = {theory['primary']['revolute'].format()} + {theory.group.format(number=1)}," in said
    )
    assert theory.part.format() in said
    for case in theory["motion"].values():
        assert str(case).format() in said
    assert theory.sliding.format() not in said
    plain = "\n".join(texts(note_of("homework", lang)))
    assert "3(k − 1)" not in plain and theory.part.format() not in plain


def test_a_note_begins_with_the_title_page_and_ends_with_the_list_of_sheets() -> None:
    nodes = note_of("shaper").nodes
    assert isinstance(nodes[0], document.TitlePage)
    titles = [node.title for node in nodes if isinstance(node, document.StructuralHeading)]
    assert titles[:2] == ["Задание", "Введение"]
    assert titles[-3:-1] == ["Заключение", "Список использованных источников"]
    assert sum(isinstance(node, document.Contents) for node in nodes) == 1
    *_, sheets = (node for node in nodes if isinstance(node, document.Table))
    assert len(sheets.rows) == len(project_of("shaper").parts)


def test_the_subject_of_a_project_differs_from_that_of_a_homework() -> None:
    page, other = (note_of(name).nodes[0] for name in ("shaper", "homework"))
    assert isinstance(page, document.TitlePage)
    assert isinstance(other, document.TitlePage)
    assert "курсовому проекту" in page.subject
    assert "домашнему заданию" in other.subject


@pytest.mark.parametrize("name", FILES)
def test_no_chapter_and_no_part_is_empty(name: str) -> None:
    nodes = [n for n in note_of(name).nodes if not isinstance(n, document.PageBreak)]
    for before, after in zip(nodes, [*nodes[1:], None], strict=True):
        if isinstance(before, HEADINGS):
            inside = not isinstance(after, HEADINGS) or (
                isinstance(before, document.Chapter) and isinstance(after, document.Part)
            )
            assert after is not None and inside, before


@pytest.mark.parametrize("name", FILES)
def test_both_languages_state_the_same_facts_in_the_same_order(name: str) -> None:
    kinds = [[type(node) for node in note_of(name, lang).nodes] for lang in LANGUAGES]
    assert kinds[0] == kinds[1]


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("lang", LANGUAGES)
def test_no_markup_is_left(name: str, lang: str) -> None:
    text = text_of(name, lang)
    assert not re.findall(r"[\\{}]|\bNone\b|\bnan\b| ,|\. \.", text)
    title = plain_text(project_of(name).problem.title)
    if lang == "en":
        problem = project_of(name).problem
        books = () if problem.project is None else problem.project.sources
        own = text
        for given in (title, problem.source, *problem.stamp.values(), *books):
            own = own.replace(given, "")
        assert not re.search("[\u0400-\u04ff]", own)


@pytest.mark.parametrize("name", FILES)
def test_every_figure_and_table_is_referred_to_and_has_a_number(name: str) -> None:
    written = note_of(name)
    referred = set(re.findall(r"\\ref\{([^}]*)\}", " ".join(texts(written))))
    shown = [n for n in written.nodes if isinstance(n, document.Figure | document.Table)]
    keys = [node.key for node in shown]
    assert len(keys) == len(set(keys))
    assert set(keys) == referred
    assert all(found for node, found in numbers_of(written) if node in shown)


@pytest.mark.dear
@pytest.mark.parametrize("name", ("template", "homework", "rubbing"))
@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_source_is_cited_by_its_number(name: str, lang: str) -> None:
    written = note_of(name, lang)
    (listed,) = (n.entries for n in written.nodes if isinstance(n, document.References))
    cited = [int(k) for text in texts(written) for k in re.findall(r"\u00a0\[(\d+)\]", text)]
    assert cited == list(range(1, len(listed) + 1))
    source = project_of(name).problem.source
    assert (listed[0] == source) == bool(source)
    task = project_of(name).problem.project
    books = () if task is None else task.sources
    first = 1 if source else 0
    assert listed[first : first + len(books)] == books
    assert bool(books) == (name == "rubbing")
    assert any("13755" in entry for entry in listed) == (name == "template")


def test_points_in_the_steps_of_the_cam_do_not_part_from_their_letters() -> None:
    steps = [n for n in note_of("template").nodes if isinstance(n, document.Step)]
    lines = [line for step in steps for line in step.lines]
    assert len([line for line in lines if "точка\u00a0" in line]) > 8
    assert not [line for line in lines if re.search(r"точка [A-Za-z]", line)]
    assert not [line for line in lines if " — " in line]
    assert "28,65\u00a0мм" in " ".join(lines)


@pytest.mark.parametrize("name", ("shaper", "homework"))
def test_numbers_and_their_units_are_not_parted(name: str) -> None:
    lines = [n.text for n in note_of(name).nodes if isinstance(n, document.Paragraph)]
    apart = re.compile(r"\d (?:мм|м/с|м|кг|Н·м|Н|с\^|рад|Дж|%)(?![а-я])")
    assert not [line for line in lines if apart.search(line)]


# Numbers -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FILES)
def test_the_numbers_of_every_formula_come_to_its_result(name: str) -> None:
    checked = 0
    for node in note_of(name).nodes:
        # The accepted value is a standard size near the computed one.
        text = str(getattr(node, "text", "")).partition(", принимаем ")[0]
        checked += count_equations_that_hold([text])
    assert checked > 15


@pytest.mark.parametrize("name", ["homework", "forces"])
def test_the_matrix_of_constraints_has_six_columns_for_each_moving_link(name: str) -> None:
    """It has a row for each freedom removed by a pair; the formula above it has both numbers."""
    told = " ".join(inlined(text) for text in texts(note_of(name))).replace("\u00a0", " ")
    count = re.search(r"= 6·(\d+)((?: − \d·\d+)+) = 1\b", told)
    matrix = re.search(
        r"имеет (\d+) строк\w* и (\d+) столбц\w* \(6n\), её ранг .*? равен (\d+)", told
    )
    assert count is not None and matrix is not None
    links = int(count[1])
    assert links == len(project_of(name).loaded.problem.mechanism.links)
    taken = sum(int(one) * int(two) for one, two in re.findall(r"(\d)·(\d+)", count[2]))
    assert [int(one) for one in matrix.groups()] == [taken, 6 * links, taken]


def test_the_strokes_in_the_conclusion_make_one_turn_and_k_v_is_working_over_idle() -> None:
    for lang, said in (
        ("ru", r"Рабочий ход занимает ([\d,]+)°, холостой – ([\d,]+)°.*?K_{v} = ([\d,]+\d)"),
        (
            "en",
            r"working stroke takes ([\d.]+)° and the idle stroke ([\d.]+)°.*?K_{v} = ([\d.]+\d)",
        ),
    ):
        told = " ".join(texts(note_of("shaper", lang))).replace("\u00a0", " ")
        found = re.search(said, told)
        assert found is not None
        working, idle, ratio = (float(one.replace(",", ".")) for one in found.groups())
        assert working + idle == pytest.approx(360.0, abs=0.011)
        assert ratio == pytest.approx(working / idle, abs=6e-4)
        strokes = project_of("shaper").strokes
        assert strokes is not None
        assert working == pytest.approx(strokes.working_deg, abs=0.006)


def conclusion_of(name: str) -> str:
    """Return the numbered items of the conclusion in English, in one line."""
    items = [n for n in note_of(name, "en").nodes if isinstance(n, document.Item)]
    start = max(k for k, item in enumerate(items) if item.label == "1)")
    own = items[start:]
    assert [item.label for item in own] == [f"{k})" for k in range(1, len(own) + 1)]
    said = " ".join(inlined(item.text) for item in own)
    return said.replace("\u00a0", " ").replace("−", "-")


def largest_share(solution: Solution, *kinds: QuantityKind) -> tuple[str, float, float]:
    """Return the quantity that is read worst, its error in per cent and in sigmas."""
    found = []
    for of, one in compared(solution, 0, *kinds):
        assert one.exact == pytest.approx(float(solution.exact(of.label)[0]))
        assert one.read == pytest.approx(float(solution.read_off(of.label)[0]))
        off = one.read - one.exact
        found.append((abs(off / one.exact) * 100.0, of.symbol, abs(off) / (one.sigma or np.inf)))
    share, symbol, sigmas = max(found)
    return symbol, share, sigmas


@pytest.mark.parametrize("name", ["homework", "forces", "slider"])
def test_the_conclusion_names_the_worst_readings_with_their_shares_and_sigmas(name: str) -> None:
    said, solution = conclusion_of(name), project_of(name).loaded
    found = re.search(
        r"calculation is ([\d.]+) % for the velocities \((\S+)\) and ([\d.]+) % for the "
        r"accelerations \((\S+)\), that is ([\d.]+) and ([\d.]+) standard", said
    )  # fmt: skip
    assert found is not None
    velocity, acceleration = (largest_share(solution, *kinds_on(plan)) for plan in RATES)
    for (symbol, share, sigmas), (text, letters, many) in zip(
        (velocity, acceleration),
        ((found[1], found[2], found[5]), (found[3], found[4], found[6])),
        strict=True,
    ):
        assert letters == inlined(symbol)
        assert float(text) == pytest.approx(share, abs=0.051)
        assert float(many) == pytest.approx(sigmas, abs=0.051)
    later = float(found[3]) > float(found[1])
    assert ("are found less accurately than the velocities" in said) == later


@pytest.mark.parametrize("name", ["forces", "shaper"])
def test_the_conclusion_has_the_largest_reaction_and_the_balance_of_the_plans(name: str) -> None:
    said, project = conclusion_of(name), project_of(name)
    found = re.search(
        r"the largest reaction is (\S+) = ([\d.]+) N and the balancing (moment|force) is "
        r"(\S+) = ([\d.]+) (N·m|N)\.", said
    )  # fmt: skip
    assert found is not None
    statics = statics_of(project.loaded)
    sizes = [abs(complex(one.force[0])) for one in statics.reactions]
    assert float(found[2]) == pytest.approx(max(sizes), rel=0.03)
    assert found[4][0] == {"moment": "M", "force": "F"}[found[3]]
    assert found[6] == {"moment": "N·m", "force": "N"}[found[3]]
    lever = re.search(r"differ by ([\d.]+) %, the expected standard deviation being ([\d.]+)", said)
    assert lever is not None
    assert ("noticeable" in said) == (10.0 < float(lever[1]) < 3.0 * float(lever[2]))


@pytest.mark.parametrize("name", FILES)
def test_the_calculation_has_the_results_of_the_sheet(name: str) -> None:
    """The note has in full what a sheet rounds and computes from the numbers that it prints."""
    words, solution = get_language("ru"), project_of(name).loaded
    nodes = note_of(name).nodes
    own = [result for n in nodes if isinstance(n, document.Formula) for result in ends_of(n.text)]
    seen = 0
    for kind in RATES:
        for line in calculation(solution, kind, 0, words):
            for symbol, text, unit in ends_of(line):
                said = float(text)
                alike = [float(t) for s, t, u in own if (s, u) == (symbol, unit)]
                if said == 0.0 and not alike:
                    continue  # a sentence states it
                room = half_a_digit(text) + 0.01 * said  # of operands with three digits
                assert min(abs(one - said) for one in alike) <= room, (line, alike)
                seen += 1
    assert seen > 9


def ends_of(text: str) -> list[tuple[str, str, str]]:
    """Return the symbols, numbers and units of formulas: symbols at the head of them, and last."""
    found = []
    for one in text.replace("\u00a0", " ").split(";  "):
        end = re.match(r"(.+?) = .*?([0-9][0-9,]*) (м/с(?:\^\{2\})?|мм|с\^\{−[12]\})", one)
        if end is not None:
            found.append((end[1], end[2].replace(",", "."), end[3]))
    return found


@pytest.mark.parametrize("name", FILES)
def test_the_comparison_has_the_values_of_solve(name: str) -> None:
    project = project_of(name)
    solution, say = project.loaded, get_language("ru").notation
    (table,) = (
        n for n in note_of(name).nodes if isinstance(n, document.Table) and n.key == "compared"
    )
    rows = {row[0].partition(",")[0]: row for row in table.rows}
    kinds = (QuantityKind.VELOCITY, QuantityKind.OMEGA, QuantityKind.ACCELERATION)
    seen = 0
    for quantity in reported_quantities(solution, *kinds):
        if quantity.symbol in rows:
            read, exact = rows[quantity.symbol][1:3]
            assert exact == say.computed(float(solution.exact(quantity)[0]))
            assert read == say.computed(float(solution.read_off(quantity.label)[0]))
            seen += 1
    assert seen > 2


def cells_of(table: document.Table) -> list[dict[str, str]]:
    """Return the rows of a table by heads, with points for commas."""
    return [
        dict(
            zip(
                table.head,
                (inlined(c).replace(",", ".").replace("−", "-") for c in row),
                strict=True,
            )
        )
        for row in table.rows
    ]


def half_a_digit(cell: str) -> float:
    """Return half of the last decimal place of a number."""
    return 0.5001 * 10.0 ** -len(cell.partition(".")[2])


def half_of_the_fourth(value: float) -> float:
    """Return half of the fourth significant digit of a number."""
    return 0.5001 * 10.0 ** (np.floor(np.log10(abs(value))) - 3.0) if value else 0.0


@pytest.mark.parametrize("name", FILES)
def test_differences_of_tables_are_readings_of_the_plans_less_exact_values(name: str) -> None:
    count = 0
    for key in ("compared", "reactions", "train_results"):
        table = tables_of(name).get(key)
        for row in cells_of(table) if table is not None else []:
            read, exact = (
                next((float(row[h]) for h in row if h.startswith(said)), 0.0)
                for said in (("По плану", "Снято"), "Точно")
            )
            rounding = half_of_the_fourth(read) + half_of_the_fourth(exact)
            share = 100.0 * max(1.0, abs(read / exact)) / abs(exact) if exact else 0.0
            for head, value in (
                ("Δ", read - exact),
                ("Δ, %", 100.0 * (read / exact - 1.0) if exact else 0.0),
            ):
                if (cell := row.get(head, "—")) != "—":
                    room = half_a_digit(cell) + rounding * (1.0 if head == "Δ" else share)
                    assert float(cell) == pytest.approx(value, abs=room), (key, row)
                    count += abs(value) > room
    assert count > 2


@pytest.mark.dear
@pytest.mark.parametrize("name", ["shaper", "engine", "rubbing"])
def test_the_largest_differences_are_those_of_the_position_that_is_named(name: str) -> None:
    every = project_of(name).solution
    quantities = {one.symbol: one for one in reported_quantities(every, *MOTION_KINDS)}
    rows = cells_of(tables_of(name)["largest"])
    for row in rows:
        symbol, _, _ = row["Величина"].partition(". ")
        quantity = quantities[symbol]
        exact = every.exact(quantity)
        off = np.abs(every.read_off(quantity.label) - exact)
        assert int(row["Положение"]) == int(np.nanargmax(off)), symbol
        for head, value in (
            ("Наибольшее значение", np.nanmax(np.abs(exact))),
            ("Δ_{max}", np.nanmax(off)),
            ("Δ_{max}, %", 100.0 * np.nanmax(off) / np.nanmax(np.abs(exact))),
        ):
            room = half_a_digit(row[head]) + 1e-3 * value
            assert float(row[head]) == pytest.approx(float(value), abs=room), (symbol, head)
    assert len({row["Положение"] for row in rows}) > 1


@pytest.mark.parametrize("name", ["shaper", "engine"])
def test_the_error_of_the_flywheel_is_the_drawn_value_less_the_exact_one(name: str) -> None:
    said = " ".join(texts(note_of(name))).replace(",", ".").replace("−", "-").replace("\u00a0", " ")
    exact = re.search(
        r": J_{м} = ([\d.]+) кг·м\^\{2\}; построение отличается от него на ([-+\d.]+) %", said
    )
    drawn = re.search(r"нужен маховик с моментом инерции J_{м} = ([\d.]+) кг", said)
    assert exact is not None and drawn is not None
    off = 100.0 * (float(drawn[1]) / float(exact[1]) - 1.0)
    assert float(exact[2]) == pytest.approx(off, abs=0.15)
    assert abs(off) > 1.0


def test_the_tables_of_all_positions_have_the_readings_of_the_plans() -> None:
    project = project_of("shaper")
    tables = {n.key: n for n in note_of("shaper").nodes if isinstance(n, document.Table)}
    every = project.solution
    for key, kind in (
        ("velocities", QuantityKind.VELOCITY),
        ("accelerations", QuantityKind.ACCELERATION),
    ):
        table = tables[key]
        assert len(table.rows) == len(project.positions)
        for quantity in reported_quantities(every, kind):
            column = [row[table.head.index(quantity.symbol)] for row in table.rows]
            values = [float(cell.replace(",", ".").replace("−", "-")) for cell in column]
            read = every.read_off(quantity.label)
            assert values == pytest.approx(read.tolist(), rel=1e-3, abs=6e-3)


def test_strokes_and_scales_are_those_of_the_project() -> None:
    project, text = project_of("shaper"), text_of("shaper")
    strokes = project.strokes
    assert strokes is not None and strokes.K_v is not None
    angles = [round(one, 2) for one in (strokes.working_deg, strokes.idle_deg)]
    ratio = "K_v = φ_р/φ_х = {:g}°/{:g}° = {:.3f}".format(*angles, strokes.K_v)
    assert ratio.replace(".", ",") in text
    say = get_language("ru").notation
    for letter in "lvaF":
        scale = say.as_input(getattr(project.scales, f"mu_{letter}"))
        assert set(re.findall(rf"μ_{letter} = ([0-9,]+) (?:м|\(|Н)", text)) >= {scale}
    plans = re.findall(
        r"План (?:скоростей|ускорений).* строим в масштабе μ_([va]) = ([0-9,]+)", text
    )
    assert dict(plans) == {x: say.as_input(getattr(project.scales, f"mu_{x}")) for x in "va"}


def test_by_mertsalov_the_chapter_of_the_flywheel_does_not_mention_tangents() -> None:
    problem = load(FILES["engine"])
    assert problem.machine is not None
    machine = replace(problem.machine, method=FlywheelMethod.MERTSALOV)
    project = settle(replace(problem, machine=machine), FILES["engine"])
    for lang, steps in (("ru", ("наивысшая точка A", "Вычитая")), ("en", ("highest point A",
                        "Subtracting"))):  # fmt: skip
        chapter = " ".join(map(repr, flywheel_chapter(Report(project, get_language(lang)))))
        for word in (*steps, "T_{II}", "ΔT_{I}", "μ_{T}·AB"):
            assert word.lower() in chapter.lower(), word
        for word in ("касательн", "tangent", "энергомасс", "energy-mass", "KL", "ψ"):
            assert word not in chapter, word


def test_the_flywheel_is_that_of_the_diagrams_in_the_formula_and_in_the_conclusion() -> None:
    solution = project_of("shaper").solution
    found = drawing_of(flywheel_of(solution), solution.profile).read_inertia
    told = f"{get_language('ru').notation.computed(found)}\u00a0кг·м^{{2}}"
    nodes = note_of("shaper").nodes
    (formula,) = (n for n in nodes if isinstance(n, document.Formula) and n.key == "flywheel")
    assert formula.text.endswith(f"= {told}.")
    assert any(told in n.text for n in nodes if isinstance(n, document.Item))


# Sentences ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FILES)
@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_colon_is_followed_by_a_formula_or_a_list(name: str, lang: str) -> None:
    """A colon comes before a formula or a list; a list has more than one entry."""
    follows = (document.Formula, document.Equations, document.Item)
    nodes = note_of(name, lang).nodes
    for before, after in pairwise(nodes):
        if isinstance(before, document.Paragraph) and before.text.endswith(":"):
            assert isinstance(after, follows), before.text
        if isinstance(before, document.Item) and before.label == "1)":
            assert isinstance(after, document.Item), before.text


def test_the_largest_reaction_of_the_cycle_is_that_of_the_sheet() -> None:
    say = get_language("ru").notation
    for name in ("shaper", "engine"):
        curves = cycle_forces_of(project_of(name).solution)
        most = say.computed(max(curves.peak(k).size for k in range(len(curves.joints))))
        _, _, chapter = told_of(name).partition("Модули реакций")
        told = chapter[: chapter.index("Приведённые моменты сил")]
        assert re.search(rf"за (?:весь )?цикл .*{most} Н", told), told


def test_of_a_load_that_jumps_the_largest_reaction_is_between_positions() -> None:
    text = told_of("shaper")
    assert re.search(r"В рассмотренных положениях наибольшая реакция – \S+ = \d+ Н \(полож", text)
    jump = r"между положениями \d+ и \d+ при φ₁ = \d+°, где нагрузка меняется скачком"
    assert re.search(jump, text)


def told_of(name: str) -> str:
    """Return the text of a note in one line."""
    return " ".join(text_of(name).replace("\u00a0", " ").split())


def test_the_strokes_of_an_engine_are_four_of_which_the_expansion_works() -> None:
    text = told_of("engine")
    assert "состоит из четырёх ходов" in text and "Рабочим является ход расширения" in text
    assert "поэтому K_v = 1." in text
    assert "холост" not in text and "преодолев" not in text


def test_couples_of_one_sense_are_described_together() -> None:
    for name in ("shaper", "engine", "forces"):
        for sentence in told_of(name).split(". "):
            assert len(re.findall(r"направлен[аы]? (?:по|против) час", sentence)) < 2, sentence


def test_deviations_are_those_of_the_way_that_is_taken() -> None:
    table = tables_of("shaper")["deviations"]
    assert [row[0] for row in table.rows] == ["по хордам"] * 2 + ["по планам"] * 2


# Gears -------------------------------------------------------------------------------------------


def geared(old: str, new: str, tmp_path: Path) -> Project:
    path = tmp_path / "shaper.toml"
    text = FILES["shaper"].read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new) + scales_of("shaper"), "utf-8")
    return settle(load(path), path)


def test_construction_and_calculation_differ_by_no_more_than_the_table_has(tmp_path: Path) -> None:
    project = geared("1 = 20, 2 = 40", "1 = 21, 2 = 39", tmp_path)
    part = project.part(PartName.GEARS)
    assert part is not None and isinstance(part.problem, GearProblem)
    nodes = list(train_chapter(Report(project, get_language("ru")), part.problem))
    (table,) = (node for node in nodes if isinstance(node, document.Table))
    offs = [abs(float(row[-1].replace(",", ".").replace("−", "-"))) for row in table.rows]
    told = " ".join(node.text for node in nodes if isinstance(node, document.Paragraph))
    found = re.search(r"не более чем на ([0-9,]+)\s%", told)
    assert found is not None
    assert float(found[1].replace(",", ".")) == max(offs) > 0.0
    assert "Дробью" in table.head
    assert "Дробью" not in tables_of("shaper")["train_results"].head  # of whole numbers


def test_a_condition_of_the_teeth_that_fails_is_in_the_conclusion(tmp_path: Path) -> None:
    assert "Числа зубьев не" not in told_of("shaper")
    old, new = """1 = 20, 2 = 40, "2'" = 20, 3 = 80""", """1 = 18, 2 = 36, "2'" = 18, 3 = 72"""
    report = Report(geared(old, new, tmp_path), get_language("ru"))
    *_, last = (node.text for node in conclusion(report) if isinstance(node, document.Item))
    assert last.startswith("Числа зубьев не удовлетворяют одному из условий (внутреннее")
    assert last.endswith("не меньше 143).")


def test_a_train_that_does_not_turn_the_crank_is_warned_of(tmp_path: Path) -> None:
    assert warn_of_separate_train(project_of("shaper")) is None
    apart = warn_of_separate_train(geared("1 = 540", "1 = 480", tmp_path))
    assert apart is not None
    assert "60 rev/min" in apart and "H" in apart and "53.33 rev/min" in apart


def test_the_warning_of_a_train_names_its_last_stage(tmp_path: Path) -> None:
    """Behind the carrier there is a pair of wheels."""
    apart = warn_of_separate_train(staged('train = "5"', "n = 90", tmp_path))
    assert apart is not None
    assert "link 5 of the train 80 rev/min" in apart and 'train = "5"' in apart


def staged(old: str, new: str, tmp_path: Path) -> Project:
    """Return the project of the template, with wheels that mesh, changed."""
    path = tmp_path / "staged.toml"
    text = TEMPLATE.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new) + scales_of("template"), "utf-8")
    return settle(load(path), path)


# Wheels in mesh ----------------------------------------------------------------------------------


def template_of() -> str:
    """Return the note of the template, whose wheels 4 and 5 mesh, without figures."""
    return text_of("template")


@pytest.fixture(scope="module")
def changed_template(tmp_path_factory: pytest.TempPathFactory) -> str:
    """The note of the template with the flywheel on the crank, wheels without shifts, no cam."""
    text = TEMPLATE.read_text("utf-8")
    for old, new in (("flywheel = { ratio = 5 }", ""), ('x = "blocking"', "x = [0, 0]")):
        assert old in text
        text = text.replace(old, new)
    text, _, after = text.partition("[cam]")
    path = tmp_path_factory.mktemp("template") / "changed.toml"
    path.write_text(text + after[after.index("[stamp]") :] + scales_of("template"), "utf-8")
    return plain_document(
        note_document(settle(load(path), path), get_language("ru")), get_language("ru")
    )


def test_the_wheels_of_the_train_are_those_of_the_meshing() -> None:
    text = " ".join(template_of().split())
    assert "колесо 4 обозначено номером 1, колесо 5 – номером 2" in text
    assert "Модуль колёс 4 и 5 m 8 мм" in text and "n₁ = −960 мин⁻¹; m = 8 мм." in text
    assert "подрезания: z₄" not in text  # with their shifts they are not undercut
    assert "Число зубьев колеса 1 z₁ = 13 меньше z_min" in text and "предотвращает" in text
    assert "z₂ = 20 меньше" not in text


def test_meshing_wheels_are_named_with_their_teeth() -> None:
    parts = project_of("template").parts
    train = next(x.problem.train for x in parts if isinstance(x.problem, GearProblem))
    pair = next(x.problem for x in parts if isinstance(x.problem, MeshingProblem))
    assert meshed(train, pair) == ("4", "5")
    assert meshed(train, replace(pair, z=(20, 13))) == ("5", "4")
    assert meshed(train, replace(pair, z=(20, 40))) == ("1", "2")
    assert meshed(train, replace(pair, z=(13, 21))) is None
    alike = {**train.wheels, "1": train.wheels["4"], "2": train.wheels["5"]}
    assert meshed(replace(train, wheels=alike), pair) is None  # 1-2 has the same teeth
    assert meshed(train, replace(pair, z=(25, 85))) is None  # they mesh internally
    assert meshed(train, replace(pair, z=(25, 85), cutter=20)) == ("2'", "3")


def test_a_train_takes_module_and_shifts_of_its_wheels_in_mesh() -> None:
    part = project_of("template").part(PartName.GEARS)
    assert part is not None and isinstance(part.problem, GearProblem)
    train = part.problem.train
    assert train.module == Fraction(8, 1000) and train.picture.mu_l == Fraction(4, 1000)
    assert [float(train.wheels[x].shift) for x in ("1", "4", "5")] == [0.0, 0.52, 0.43]
    alone = project_of("shaper").part(PartName.GEARS)
    assert alone is not None and isinstance(alone.problem, GearProblem)
    assert alone.problem.train.module is None
    assert "условном модуле 2 мм" in " ".join(text_of("shaper").split())


def test_rows_beside_the_meshing_keep_the_module_of_the_train() -> None:
    """Wheels 4 and 5 have the module of their sheet; another module in the file is an error."""
    parts = project_of("template").parts
    (part,) = (one for one in parts if isinstance(one.problem, GearProblem))
    assert isinstance(part.problem, GearProblem)
    pair = next(one for one in parts if isinstance(one.problem, MeshingProblem))
    train = replace(part.problem.train, module=Fraction(4, 1000))

    def joined(train: Train) -> Train:
        problem = replace(part.problem, train=train)
        found = next(iter(in_mesh((replace(part, problem=problem), pair)))).problem
        assert isinstance(found, GearProblem)
        return found.train

    four, eight = Fraction(4, 1000), Fraction(8, 1000)
    assert joined(train).modules == {four: ("1", "2", "2'", "3"), eight: ("4", "5")}
    rim = replace(train.wheels["5"], module=Fraction(6, 1000))
    with pytest.raises(ProblemError, match=r"4 and 5 have the module 6 mm, and 8 mm in"):
        joined(replace(train, wheels={**train.wheels, "5": rim}))


def test_the_data_of_the_note_name_the_teeth_the_input_and_the_flywheel() -> None:
    text = " ".join(template_of().split())
    for row in (
        "Число зубьев колеса 2' z_2' 25",
        "Число сателлитов на водиле H k 3",
        "Частота вращения ведущего звена 1 зубчатого механизма n₁ −960 мин⁻¹",
        "Отношение скоростей вала маховика и кривошипа i 5",
        "ω₁ 8,378 с⁻¹ (постоянна)",
    ):
        assert row in text, row
    assert "Частота вращения кривошипа" not in text  # the speed of wheel 1 is not that of the crank


def test_the_flywheel_is_on_a_shaft(changed_template: str) -> None:
    text = " ".join(template_of().split())
    found = re.search(r"момент инерции самого маховика J_м/i² = (\S+)/5² = (\S+) кг", text)
    assert found is not None
    own, reduced = (float(x.replace(",", ".")) for x in (found[2], found[1]))
    assert own == pytest.approx(reduced / 25.0, rel=5e-4)
    said = "Маховик установлен на валу кривошипа."
    assert said in changed_template and said not in template_of()


def test_the_conclusion_has_the_whole_ratio_the_shifts_and_the_largest_reaction() -> None:
    _, _, text = " ".join(template_of().split()).rpartition("Заключение")
    assert "U_1H = n₁/n_H = 39/5 = 7,800 и U₁₅ = n₁/n₅ = −12" in text
    assert "δ = 1/25" in text and "x₁ = 0,52 и x₂ = 0,43" in text
    assert "Наибольшего значения за весь цикл реакция достигает между положениями 0 и 1" in text


def test_limits_that_the_shifts_do_not_keep_are_in_the_conclusion(changed_template: str) -> None:
    text = changed_template
    _, _, told = " ".join(text.split()).rpartition("Заключение")
    assert "С такими смещениями не выполнено:" in told and "подрезание: x₁ = 0,000 <" in told
    assert "зубья будут подрезаны" in " ".join(text.split())
    assert "не выполнено" not in template_of().rpartition("Заключение")[2]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_every_step_of_the_meshing_is_led_in(lang: str) -> None:
    nodes = note_of("template", lang).nodes
    heads = [k for k, node in enumerate(nodes) if isinstance(node, document.Chapter)]
    *_, start, cam = heads  # the cam's chapter is the last one
    chapter = nodes[start:cam]
    titles = [node.title for node in chapter if isinstance(node, document.Part)]
    assert len(titles) == len(set(titles)) == 9
    for before, after in pairwise(chapter):
        if isinstance(after, document.Formula):
            assert isinstance(before, document.Formula | document.Paragraph), after.text


def test_counterweights_are_a_part_of_a_project(tmp_path: Path) -> None:
    path = tmp_path / "balanced.toml"
    source = path_of("machines/balanced-crank").read_text("utf-8")
    path.write_text(source.replace("[balancing]", "[project]\n[balancing]"), "utf-8")
    project = settle(load(path), path)
    assert [part.name.value for part in project.parts] == ["kinematics", "forces", "balancing"]
    sheets = part_drawings(project, project.parts[-1], {})
    assert [sheet.title for sheet in sheets] == ["Уравновешивание механизма"]
    text = plain_document(note_document(project, get_language("ru")), get_language("ru"))
    # m_2B = 3.6·0.16/0.36 kg and the slider, at AB = 0.36 m; then all of it and m_1 at the crank.
    rod = (1.6 + 2.8) * 0.36 / 0.24
    assert f"на звене 2 массой {rod:.3f} кг".replace(".", ",") in " ".join(text.split())


# Sheets ------------------------------------------------------------------------------------------


def test_the_list_of_sheets_has_the_numbers_titles_and_formats_of_the_title_blocks() -> None:
    project = project_of("homework")
    sheets = [part_drawings(project, part, {}) for part in project.parts]
    (one,) = listed = sheet_list(project, sheets)
    assert (one.number, one.title) == (1, sheets[0][0].title)
    assert (one.paper.width, one.paper.height) == (sheets[0][0].width, sheets[0][0].height)
    several = [replace(one, number=number) for number in (1, 2)]
    nodes = note_document(project, get_language("ru"), several).nodes
    (table,) = (n for n in nodes if isinstance(n, document.Table) and n.key == "sheets")
    assert table.head == ("Лист", "Наименование", "Формат")
    paper = one.paper.written("А")
    assert table.rows == (("1", one.title, paper), ("2", one.title, paper))
    assert len(listed) == len(sheets[0])


def test_friction_has_a_sheet_beside_that_of_the_forces_and_is_described() -> None:
    project = project_of("rubbing")
    (forces,) = (part for part in project.parts if part.name is PartName.FORCES)
    sheets = part_drawings(project, forces, {})
    titles = ["Силовой расчёт механизма", "Силовой расчёт с учётом трения",
              "Силовой расчёт механизма за цикл"]  # fmt: skip
    assert [one.title for one in sheets] == titles
    shown = {item.text for item in sheets[1].items if isinstance(item, Text)}
    assert any("(положение 2)" in text for text in shown) and any("ρ" in text for text in shown)
    assert not any("ρ" in i.text for i in sheets[0].items if isinstance(i, Text))
    listed = sheet_list(project, [sheets if part is forces else [] for part in project.parts])
    assert [one.title for one in listed] == titles
    book = openpyxl.load_workbook(BytesIO(numbers_workbook(project)))
    heads = [str(cell.value) for cell in book.worksheets[1][1]]
    assert "R B.3-0 (с трением), Н" in heads and "КПД" in heads
    assert not [head for head in heads if re.search(r"rubbed|once|friction|efficiency", head)]
    rubbing = friction_of(project.loaded)
    eta = float(rubbing.efficiency[0])
    told = " ".join(text_of("rubbing").split())
    assert f"= {get_language('ru').notation.computed(eta)}." in told and 0 < eta < 1
    for lang, sentences in {
        "ru": ("Уравновешивающая сила приложена в точке A перпендикулярно OA.",
               "имеют на его оси координаты −0,04 м и 0,06 м",
               "показаны на рисунках 15 и 16", "вычислены без графической погрешности, без учёта"),
        "en": ("The balancing force acts at point A across OA.", "at −0.04 m and 0.06 m",
               "shown in figures 15 and 16", "free of drafting error and without friction"),
    }.items():  # fmt: skip
        flat = " ".join(text_of("rubbing", lang).replace("\u00a0", " ").split())
        assert [one for one in sentences if one not in flat] == []
    assert "friction" not in " ".join(texts(note_of("forces"))).lower()


def test_the_balance_has_the_size_that_the_equations_beside_it_give(tmp_path: Path) -> None:
    path = tmp_path / "six.toml"
    text = path_of("levers/six-link").read_text("utf-8")
    rubs = "[friction]\nf = 0.1\nf_pin = 0.12\nradius = 0.01\n"
    bearings = "[bearings.A]\nat = [-0.03, 0.02]\nplane = 0.04\n"
    path.write_text(f"{text}\n{rubs}{bearings}", "utf-8")
    project = settle(load(path), path)
    friction = friction_of(project.loaded)
    assert float(friction.without.balance[0]) < 0 and float(friction.converged.balance[0]) < 0
    words = get_language("ru")
    told = plain_document(note_document(project, words), words).replace("\u00a0", " ")
    size = words.notation.computed(-float(friction.without.balance[0]))
    assert told.count(f"Без трения M_1д = {size} Н·м") == 2
    flat = " ".join(told.split())
    # 10030 N at 0.04, the bearings at −0.03 and 0.02: moments about each give the other.
    f = abs(complex(friction.statics.reactions[-1].force[0]))
    for share in (f * 0.02 / 0.05, f * 0.07 / 0.05):
        assert f"= {words.notation.computed(share)} Н" in flat
    assert "(противоположно F₁₆); F''₁₆" in flat


# Figures -----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ("homework", "forces"))
def test_figures_are_legible_at_the_width_of_a_page(name: str) -> None:
    for node in note_of(name).nodes:
        if isinstance(node, document.Figure):
            assert isinstance(node.view, FittedView)
            view, factor = node.view.scaled_view
            assert node.view.size[0] <= WIDTH + 1e-6
            heights = [item.height for item in view.drawing.items if isinstance(item, Text)]
            assert min(heights) * factor > 0.4 * LETTER  # of an index of an index
            assert np.median(heights) * factor > 0.6 * LETTER


def test_a_figure_is_drawn_only_when_a_writer_needs_it() -> None:
    made: list[float] = []

    def picture(letter: float) -> None:
        made.append(letter)

    view = FittedView(picture, "", (WIDTH, 100.0))  # type: ignore[arg-type]
    assert not made
    with pytest.raises(AttributeError):
        _ = view.size
    assert made


def test_the_parts_of_a_project_are_named() -> None:
    names = set(get_language("ru").report["back"]["names"])
    assert {name.value for name in PartName} - {"note"} <= names


@pytest.mark.parametrize(
    ("stamp", "foot"),
    [
        ({"city": "Омск", "date": "01.12.2025"}, ("Омск", "2025")),
        ({"year": "2024", "author_date": "01.12.2025"}, ("", "2024")),
        ({"date": "01.12"}, ("", "")),
    ],
)
def test_the_title_page_has_the_city_and_the_year_of_the_stamp(
    stamp: dict[str, str], foot: tuple[str, str]
) -> None:
    project = project_of("homework")
    problem = replace(project.problem, stamp=stamp)
    page = note_document(replace(project, problem=problem), get_language("ru")).nodes[0]
    assert isinstance(page, document.TitlePage) and (page.place, page.year) == foot


@each("name", ["engine", "shaper", "template"])
def test_the_stated_data_have_the_tables_of_the_loads(name: str) -> None:
    project = project_of(name)
    front = list(note_of(name).nodes)
    dynamics = project.problem.dynamics
    assert dynamics is not None
    changing = [
        (k, one)
        for k, one in enumerate(dynamics.loads)
        if isinstance(one.size, SizeTable) and one.size.like is None
    ]
    assert changing
    for number, one in changing:
        tables = (n for n in front if isinstance(n, document.Table))
        (table,) = (table for table in tables if table.key == f"load_{number}")
        cells = [[number_of(cell) for cell in row] for row in table.rows]
        assert isinstance(one.size, SizeTable)
        told = one.size.indicator
        if told is None:
            assert np.allclose(cells, [*zip(one.size.at, one.size.values, strict=True)])
            continue
        listed = [
            (k, share, pressure * 1e-6)
            for k, stroke in enumerate(told.strokes, 1)
            for share, pressure in stroke
        ]
        assert np.allclose(cells, listed)
        area = get_language("ru").notation.as_input(told.area)
        assert any(isinstance(n, document.Paragraph) and area in n.text for n in front)


def number_of(cell: str) -> float:
    return float(plain_text(cell).replace(",", ".").replace("\u2212", "-"))


@each("name", ["engine", "shaper"])
def test_the_reduced_moment_has_the_sign_of_its_terms(name: str) -> None:
    formulas = [n.text for n in note_of(name).nodes if isinstance(n, document.Formula)]
    whole = next(text for text in formulas if "Σ(F_{i}·v_{i}" in text)
    letter = whole.partition(" = ")[0]
    terms = next(t for t in formulas if t.startswith(f"{letter} = ") and "cos α_{P" in t)
    first = terms.partition("{")[2] if "\\frac" in terms else terms
    resists = "−" in whole.partition(" = ")[2][:2]
    assert (f"{letter} = \\frac{{−" in terms or "−P" in first) is resists


@pytest.mark.dear
@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
@pytest.mark.parametrize("name", ["homework", "slider"])
def test_pages_of_pdf_have_the_frames_of_word_and_no_text_runs_into_them(
    name: str, tmp_path: Path
) -> None:
    """Form 2 after the title page, then form 2a, with its number and how many there are."""
    fields = {"designation": "ТММ.КП.01", "title": "Строгальный станок", "author": "Иванов И."}
    (made,) = note_files(project_of(name), "n", NoteOptions(fields, frame=True), ["pdf"]).values()
    (plain,) = note_files(project_of(name), "n", NoteOptions(fields), ["pdf"]).values()
    (tmp_path / "n.pdf").write_bytes(made)
    assert made != plain
    told = ["pdftotext", "-bbox", str(tmp_path / "n.pdf"), "-"]
    shown = subprocess.run(told, capture_output=True, timeout=60).stdout.decode()
    word = r'<word xMin="([\d.]+)" yMin="([\d.]+)" xMax="([\d.]+)" yMax="([\d.]+)">(.*?)</word>'
    pages = [re.findall(word, page) for page in shown.split("<page ")[1:]]
    assert not any("Разраб" in text for *_, text in pages[0])  # the title page has no frame
    for number, page in enumerate(pages[1:], 2):
        high = 40.0 if number == 2 else 15.0
        top = (297.0 - 5.0 - high) / 25.4 * 72.0
        block = [text for _, low, _, _, text in page if float(low) > top]
        body = [(*map(float, box),) for *box, _ in page if float(box[1]) <= top]
        assert max(box[3] for box in body) < top and max(box[2] for box in body) < 205 / 25.4 * 72
        assert min(box[0] for box in body) > 20 / 25.4 * 72
        assert str(number) in block and "ТММ.КП.01" in " ".join(block)
        assert ("Листов" in block, "Иванов" in block) == (number == 2, number == 2)
        assert str(len(pages)) in block or number != 2


def speeds_told(project: Project, words: Language) -> Iterator[tuple[str, float]]:
    """Yield the rotational speeds in the note and sheets of a project, with their symbols."""
    symbol, value = r"(n(?:_\{[^}]*\})?)", r"([−-]?\d[\d.,]*)"
    facts_given = [fact.text for fact in given_facts(project.problem, words)]
    for part in project.parts:
        if isinstance(part.problem, GearProblem):
            facts = train_given(solve_motion(part.problem), words)
            facts_given += [fact.text for fact in facts]
    written = note_document(project, words)
    for text in (*facts_given, *texts(written)):
        for name, found in re.findall(
            rf"{symbol} = (?:[^;]* = )?{value} (?:об/мин|мин\^|rev/min|rpm|min\^)",
            text.replace("\u00a0", " "),
        ):
            yield name, number_of(found)
        # The mean power: A·n/60 beside the same with numbers.
        for name, found in re.findall(
            rf"·{symbol}\}}\{{\d+\}} = \\frac\{{[^}}]*·{value}\}}", text.replace("\u00a0", " ")
        ):
            yield name, number_of(found)
    for _, name, found in next(t.rows for t in written.nodes
                               if isinstance(t, document.Table) and t.key == "data"):  # fmt: skip
        if name.startswith("n"):
            yield name, number_of(found.replace("\u00a0", " ").split(" ")[0])


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", ["template", "shaper", "engine", "apart"])
def test_a_letter_of_a_speed_is_one_thing_in_all_parts(
    name: str, lang: str, tmp_path: Path
) -> None:
    """The crank is not wheel 1: with a train, its speed is n of the crank, or of its wheel."""
    if name == "apart":  # a train of the same file that does not drive the crank by [driver]
        path = tmp_path / "apart.toml"
        text, count = re.subn(r"(?m)^train = .*$", "n = 80", TEMPLATE.read_text("utf-8"))
        assert count == 1
        path.write_text(text, "utf-8")
        project = settle(load(path), path)
    else:
        project = project_of(name)
    found: dict[str, set[float]] = {}
    for symbol, value in speeds_told(project, get_language(lang)):
        found.setdefault(symbol, set()).add(value)
    assert found and all(max(of) - min(of) <= 1e-3 * max(map(abs, of)) for of in found.values())
    beside = get_language(lang).notation.symbol("crank turns")
    assert {"template": "n_{5}", "engine": "n_{1}"}.get(name, beside) in found


@pytest.mark.parametrize("name", FILES)
def test_the_differences_of_the_conclusion_are_those_of_the_chapters(name: str) -> None:
    """Each percent of the conclusion is read where the table and the formulas read it."""
    told = told_of(name).rpartition("Построением планов найдены")[2]
    table = tables_of(name)["compared"]
    rows = {plain_text(row[0]).split(",")[0]: abs(number_of(row[4])) for row in table.rows}
    worst_of = re.search(
        r"– ([\d,]+) % для скоростей \((\S+?)\) и ([\d,]+) % для ускорений \((\S+?)\)", told
    )
    assert worst_of is not None
    pairs = {worst_of[2]: number_of(worst_of[1]), worst_of[4]: number_of(worst_of[3])}
    for letters, (symbol, percent) in zip(("vω", "aε"), pairs.items(), strict=True):
        most = max(of for one, of in rows.items() if one[0] in letters)
        assert rows[symbol] == most and abs(percent - most) <= 0.0551
    largest = max(pairs, key=lambda one: rows[one])
    assert f"разность – у {largest}: {worst_of[1 if largest == worst_of[2] else 3]} %." in told_of(
        name
    )
    for chapter, end in (
        (r"отличается от него на [+\u2212]([\d,]+) %", r"отличается от построения на ([\d,]+) %"),
        (r"100 % = ([\d,]+) %", r"рычага Жуковского составляет ([\d,]+) %"),
    ):
        assert re.findall(chapter, told_of(name))[:1] == re.findall(end, told)


SWINGING = """
[frame]
A = [0, 0]
D = [0.5, 0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.25
[links.3]
points = ["C", "D"]
CD = 0.2
[driver]
link = "1"
phi = 20
omega = 10
[cycle]
count = 12
[assembly]
C = "left of BD"
"""


def test_the_range_of_a_crank_that_makes_no_full_turn_goes_from_its_lower_end(
    tmp_path: Path,
) -> None:
    """At the ends BD = BC + CD = 0.45 m: cos φ = (0.5² + 0.1² − 0.45²)/(2·0.5·0.1) = 0.575."""
    path, words = tmp_path / "swinging.toml", get_language("en")
    path.write_text(SWINGING, "utf-8")
    text = plain_document(note_document(settle(load(path), path), words), words)
    assert "can be assembled for φ₁ from −54.9° to 54.9°" in " ".join(text.split())


def test_a_note_has_the_title_of_its_language() -> None:
    project = project_of("homework")
    title = project.problem.stamp_in["en"]["title"]
    files = note_files(replace(project, language="en"), "note", NoteOptions(), ["docx"])
    with zipfile.ZipFile(BytesIO(files["note.docx"])) as archive:
        text = archive.read("word/document.xml").decode()
    assert title in text and project.problem.title not in text


def test_a_slider_at_rest_has_no_row_among_the_compared_velocities() -> None:
    """At φ = 180.00001° its velocity is 2·10⁻⁷ of the largest, which is that of the pin."""
    problem = problem_of("linkages/ex1")
    solution = Solution(replace(problem, drive=replace(problem.drive, positions=(180.00001,))))
    found = {of.label: one for of, one in compared(solution, 0, QuantityKind.VELOCITY)}
    assert "v_B" in found and "v_C" not in found, [*found]
