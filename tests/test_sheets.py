"""Whole sheets: no remarks of the norm control, the requested paper, reproducible bytes."""

from __future__ import annotations

import gc
import hashlib
import os
import re
import shutil
import subprocess
import sys
from itertools import cycle
from pathlib import Path
from random import Random

import pytest
from cases import each, some, thinned
from click.testing import CliRunner
from doors import (
    FRAME_FORMATS as FORMATS,
    RATES,
    Drawing,
    ExitCode,
    FrameFormat as Format,
    LayoutError,
    Solution,
    Text,
    cli,
    kinematics_sheets,
    lint,
    problem_loads as loads,
    render,
    variant_names,
)
from worked import PROBLEMS, ROOT, drawn_sheets, every_file, path_of, problem_of

from benchmarks.generator import random_problem

FILES = {str(path.relative_to(PROBLEMS).with_suffix("")): path for path in every_file()}

ALL_ROUND = [30.0 * k for k in range(12)]

MANY = {
    "linkages/ex1": ALL_ROUND,
    "linkages/ex2": ALL_ROUND,
    "linkages/ex3": ALL_ROUND,
    "levers/six-link": [150.0 + 10.0 * k for k in range(12)],  # it does not go all round
    "levers/task12": ALL_ROUND,
    "press/press": ALL_ROUND,
    "press/press-stone": ALL_ROUND,
}


def marks(sheets: list[Drawing]) -> list[str]:
    """Return the remarks of the lint on each sheet, by the frame of its format."""
    found = []
    for drawing in sheets:
        inner = format_of(drawing).inner
        found += [f"{f.code} {f.message}" for f in lint(drawing.items, inner)]
    return found


def format_of(drawing: Drawing) -> Format:
    (fmt,) = (f for f in FORMATS.values() if (f.width, f.height) == size(drawing))
    return fmt


def size(drawing: Drawing) -> tuple[float, float]:
    return drawing.width, drawing.height


def texts(drawing: Drawing) -> str:
    return "\n".join(item.text for item in drawing.items if isinstance(item, Text))


# Lint ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", FILES)
def test_the_lint_finds_no_faults(name: str) -> None:
    for variant in [None, *variant_names(FILES[name])]:
        sheets = drawn_sheets(name, variant=variant)
        assert len(sheets) == 1
        assert marks(sheets) == []


@pytest.mark.parametrize("paper", ["A4", "A3", "A2", "A1"])
@pytest.mark.parametrize("name", FILES)
def test_requested_paper_is_taken_or_rejected(name: str, paper: str) -> None:
    try:
        sheets = drawn_sheets(name, paper=paper)
    except LayoutError as error:
        assert error.exit_code is ExitCode.USAGE
        assert f"the views do not fit {paper}" in str(error)
        assert paper in ("A4", "A3")  # the requested views fit larger ones
        return
    # On a small format one position takes several sheets; every view is on one of them, once. With
    # two enlarged views the calculation of the press goes on another A2.
    assert {size(sheet) for sheet in sheets} == {(FORMATS[paper].width, FORMATS[paper].height)}
    assert len(sheets) == 1 or paper in ("A4", "A3") or (name, paper) == ("press/press-stone", "A2")
    shown = "\n".join(texts(sheet) for sheet in sheets)
    for view in ("План положения механизма", "План скоростей", "План ускорений"):
        assert shown.count(view) == 1
    assert marks(sheets) == []


@pytest.mark.dear
@pytest.mark.parametrize("name", MANY)
def test_many_positions_with_the_scales_of_the_file(name: str) -> None:
    """A sheet holds as many as fit; the others go on further sheets of the same format."""
    sheets = drawn_sheets(name, MANY[name], layout="many-positions")
    assert marks(sheets) == []
    assert len({size(sheet) for sheet in sheets}) == 1
    for sheet in sheets:
        assert {view.kind for view in sheet.views} == {"position", "velocity", "acceleration"}
        shown = texts(sheet)
        for part in ("Планы скоростей", "Планы ускорений", "Дано:", "Определить:", "Уравнения"):
            assert part in shown


def without_scales(name: str) -> str:
    text = path_of(name).read_text("utf-8")
    return re.sub(r"(?m)^\[scales\]\n(?:[^\[\n].*\n|\n)*", "", text)


GIVEN = [name for name in MANY if without_scales(name) != path_of(name).read_text("utf-8")]
"""Files with scales; those of the others are free in the test above."""


@pytest.mark.dear
@pytest.mark.parametrize("name", thinned(GIVEN, 2))
def test_many_positions_fit_when_the_scales_are_free(name: str) -> None:
    problem = loads(without_scales(name), name=path_of(name).stem)
    assert problem.scales.mu_v is None
    assert marks(kinematics_sheets(problem, positions=MANY[name])) == []


@pytest.mark.dear
@pytest.mark.parametrize("count", [1, 3, 12])
def test_sheets_and_numbers_speak_of_the_same_scales(count: int) -> None:
    """One decision: the sheets have the scales and the paper that `solve` and `protocol` tell.

    Plans out of proportion have the own scales of the solution there, printed or not.
    """
    for name in MANY:
        problem = loads(without_scales(name), name=path_of(name).stem)
        positions = MANY[name][:count]
        solution = Solution(problem, positions=positions)
        sheet, *more = kinematics_sheets(problem, positions=positions)
        assert size(sheet) == (FORMATS[solution.views.paper].width, format_of(sheet).height)
        assert len(more) <= 1  # beside measured values, or the second half of many plans
        told = {kind.value: scale.per_mm for kind, scale in solution.scales.items()}
        views = [view for one in (sheet, *more) if not one.is_continuation for view in one.views]
        for view in views:
            assert view.per_mm == pytest.approx(told[view.kind])
        assert {view.kind for view in views} == set(told)
        for kind in RATES:
            drawn = {
                round(span.magnification, 6)
                for view in views
                if view.kind == kind.value
                for span in view.spans
            }
            own = [solution.plan_scale(kind, k).per_mm for k in range(len(positions))]
            assert {round(told[kind.value] / mu, 6) for mu in own} <= drawn  # enlarged views, too


def test_forces_of_36_positions_are_on_one_a1() -> None:
    (sheet,) = drawn_sheets("press/press", range(0, 360, 10), layout="forces-cycle")
    assert size(sheet) == (841, 594)


def test_a_compact_sheet_has_space_for_a_plan_and_its_enlarged_views() -> None:
    sheets = drawn_sheets("levers/task-49", layout="compact")
    assert {size(sheet) for sheet in sheets} == {(210, 297)}


@each("seed", range(some(30, few=6)))
def test_sheets_of_random_mechanisms(seed: int) -> None:
    problem = loads(random_problem(seed)[0], name=f"random-{seed}")
    assert marks(kinematics_sheets(problem)) == []


@each("seed", range(some(10, few=2)))
def test_many_positions_of_random_mechanisms(seed: int) -> None:
    problem = loads(random_problem(seed)[0], name=f"random-{seed}")
    step = 2.0 if problem.drive.is_crank else 0.004
    positions = [problem.drive.positions[0] + step * k for k in range(-3, 4)]
    assert marks(kinematics_sheets(problem, positions=positions)) == []


def test_the_lint_of_these_tests_does_find() -> None:
    """The lint marks a letter on another one and a letter outside the frame."""
    (sheet,) = drawn_sheets("linkages/ex1")
    letter = next(item for item in sheet.items if isinstance(item, Text) and item.text == "B")
    spoiled = Drawing(sheet.width, sheet.height, sheet.title, [*sheet.items])
    spoiled.add(Text(letter.at, "Q", letter.height), Text(2 + 100j, "Q", 5.0))
    codes = {mark.split()[0] for mark in marks([spoiled])}
    assert {"PM-D01", "PM-D04"} <= codes


# Contents of the sheet ----------------------------------------------------------------------------


@pytest.mark.parametrize("name", FILES)
def test_a_sheet_has_its_parts(name: str) -> None:
    (sheet,) = drawn_sheets(name)
    shown = re.sub(r"\s+", " ", texts(sheet))
    for part in ("План скоростей", "План ускорений", "Дано:", "Определить:", "Результаты"):
        assert part in shown
    assert shown.count("μ") >= 3
    (view,) = (view for view in sheet.views if view.kind == "velocity")
    (above,) = (i for i in sheet.items if isinstance(i, Text) and i.text == "План скоростей")
    assert above.at.imag > (view.box[1] + view.box[3]) / 2  # above, as GOST 2.316 has it


def test_more_than_a_dozen_of_positions_go_on_further_sheets() -> None:
    sheets = drawn_sheets("linkages/ex2", [27.0 * k for k in range(13)])
    assert len(sheets) == 2
    assert size(sheets[0]) == size(sheets[1])
    assert marks(sheets) == []


@pytest.mark.parametrize("paper", ["A1", "A2:portrait", "A4x4"])
def test_the_paper_of_the_file_sets_the_scales_of_sheet_and_numbers(paper: str) -> None:
    text = re.sub(r"(?m)^mu_.*\n", "", path_of("linkages/ex3").read_text("utf-8"))
    problem = loads(text.replace("[sheet]\n", f'[sheet]\npaper = "{paper}"\n'), name="ex3")
    (sheet,) = kinematics_sheets(problem)
    assert size(sheet) == (FORMATS[paper].width, FORMATS[paper].height)
    scales = {kind.value: scale.per_mm for kind, scale in Solution(problem).scales.items()}
    assert {view.kind: view.per_mm for view in sheet.views} == scales


def test_requested_fields_outrank_those_of_the_file() -> None:
    (sheet,) = kinematics_sheets(problem_of("linkages/ex1"), fields={"author": "Кузнецова"})
    assert "Кузнецова" in texts(sheet)


# Files --------------------------------------------------------------------------------------------

DRAW = """
import hashlib, sys
from planmethod import draw, load
from planmethod.render.backends import render
for path in sys.argv[1:]:
    (sheet,) = draw(load(path))
    for fmt in ("svg", "pdf"):
        print(hashlib.sha256(render(sheet, fmt)).hexdigest())
"""


def test_the_same_bytes_in_another_process() -> None:
    """The order of sets differs from process to process, the files do not."""
    names = ("linkages/ex3", "levers/six-link", "press/press")
    mine = [
        hashlib.sha256(render(sheet, fmt)).hexdigest()
        for name in names
        for sheet in drawn_sheets(name)
        for fmt in ("svg", "pdf")
    ]
    theirs = subprocess.run(
        [sys.executable, "-c", DRAW, *(str(path_of(name)) for name in names)],
        capture_output=True,
        encoding="utf-8",
        check=True,
        cwd=ROOT,
        env={**os.environ, "PYTHONHASHSEED": "4242"},
    ).stdout
    assert theirs.split() == mine


AFTER = """
import hashlib, sys
from msgspec.structs import replace
from planmethod import draw, load
from planmethod.languages import LANGUAGES, speaking
from planmethod.render.backends import render
from planmethod.render.ink.drawing import Text
from planmethod.render.ink.lettering import STYLES
from planmethod.render.ink.typeset import typeset

def printed():
    for path in sys.argv[2:]:
        for sheet in draw(load(path)):
            yield sheet, [hashlib.sha256(render(sheet, fmt)).hexdigest() for fmt in ("svg", "pdf")]

if sys.argv[1] == "much":
    for height in (5, 7):  # whole numbers: what is kept for 5 is asked for by 5.0
        for markup in (*"ABCDEvnabc123", r"\\bar{v}_{B}", r"\\bar{a}^{n}_{CB}", "План скоростей"):
            typeset(markup, height)
    for sheet, _ in printed():
        for text in [item for item in sheet.items if isinstance(item, Text)]:
            typeset(text.text, round(text.height))
    for path in sys.argv[2:]:
        for lang, lettering in zip(LANGUAGES * 2, (*STYLES, "B")):
            with speaking(lang):
                own = load(path)
                other = replace(own, sheet=replace(own.sheet, lettering=lettering, lang=lang))
                for sheet in draw(other, sigma=True):
                    render(sheet, "svg")
for _, found in printed():
    print(*found)
"""


def test_sheets_do_not_depend_on_earlier_drawings() -> None:
    """Cached inscriptions, places and texts never differ from newly made ones."""
    paths = [str(path_of(name)) for name in ("linkages/ex3", "linkages/ex1")]
    fresh, after = (
        subprocess.run(
            [sys.executable, "-c", AFTER, much, *paths],
            capture_output=True,
            encoding="utf-8",
            check=True,
            cwd=ROOT,
        ).stdout
        for much in ("nothing", "much")
    )
    assert after == fresh
    assert len(fresh.split()) >= 2 * len(paths)


FORTY = [
    (str(path), "--format", "svg,pdf", *options)
    for path, options in zip(
        [
            *every_file(),
            *sorted((PROBLEMS / "cams").glob("*.toml")),
            *sorted((PROBLEMS / "gears").glob("*.toml")),
            *sorted((PROBLEMS / "meshing").glob("*.toml")),
            *every_file(),
        ][:40],
        cycle(
            [
                ("--lang", "ru"),
                ("--lang", "en"),
                ("--lang", "ru", "--lettering", "A"),
                ("--lang", "en", "--lettering", "B-upright"),
                ("--lang", "ru", "--lettering", "A-upright", "--dxf-text", "text"),
            ]
        ),
        strict=False,
    )
]
"""Sheets of every kind of problem, in both languages and all letterings."""


@pytest.mark.skipif(some(1, few=0) == 0, reason="takes minutes: with --thorough")
def test_sheets_are_the_same_in_any_order(tmp_path: Path) -> None:
    """All in one process, in three random orders, have the bytes of fresh processes."""
    for seed in range(3):
        for words in Random(seed).sample(FORTY, len(FORTY)):
            folder = str(tmp_path / f"{FORTY.index(words)}-{seed}")
            done = CliRunner().invoke(cli, ["sheet", *words, "-o", folder])
            assert done.exit_code == 0, done.output
    count = 0
    for k, words in enumerate(FORTY):
        fresh = tmp_path / f"{k}-fresh"
        subprocess.run([sys.executable, "-m", "planmethod", "sheet", *words, "-o", str(fresh)])
        for path in fresh.iterdir():
            for seed in range(3):
                found = (tmp_path / f"{k}-{seed}" / path.name).read_bytes()
                assert found == path.read_bytes(), (words, path.name, seed)
            count += 1
    print(f"{count} files of {len(FORTY)} sheets in three orders")
    assert count >= 2 * len(FORTY)


@pytest.mark.skipif(shutil.which("pdftotext") is None, reason="needs pdftotext")
@pytest.mark.parametrize("name", ["linkages/ex1", "linkages/ex3", "levers/task12"])
def test_the_pdf_can_be_searched_in_russian(name: str, tmp_path: Path) -> None:
    (sheet,) = drawn_sheets(name)
    path = tmp_path / "sheet.pdf"
    path.write_bytes(render(sheet, "pdf"))
    found = subprocess.run(
        ["pdftotext", "-layout", "-enc", "UTF-8", str(path), "-"],
        capture_output=True,
        encoding="utf-8",
        check=True,
    ).stdout
    for text in ("План скоростей", "План ускорений", "Дано"):
        assert text in found


@pytest.mark.parametrize("paper", ["A3", "A2", "A1"])
def test_the_page_is_the_format(paper: str) -> None:
    (sheet,) = drawn_sheets("linkages/ex1", paper=paper)
    fmt = FORMATS[paper]
    svg = render(sheet, "svg").decode("utf-8")
    head = svg[svg.index("<svg") : svg.index(">", svg.index("<svg"))]
    assert f'width="{fmt.width:g}mm"' in head
    assert f'height="{fmt.height:g}mm"' in head
    pdf = render(sheet, "pdf")
    box = re.search(rb"/MediaBox \[ ?([\d. ]+?) ?\]", pdf)
    assert box is not None
    _, _, width, height = (float(number) for number in box[1].split())
    assert width * 25.4 / 72 == pytest.approx(fmt.width, abs=0.01)
    assert height * 25.4 / 72 == pytest.approx(fmt.height, abs=0.01)


@pytest.mark.parametrize(
    ("layout", "positions"),
    [("many-positions", ALL_ROUND[:3]), ("forces", None), ("forces-cycle", ALL_ROUND[:3])],
)
def test_a_drawn_solution_is_not_kept_in_memory(layout: str, positions: list[float] | None) -> None:
    def solutions() -> list[Solution]:
        gc.collect()
        return [one for one in gc.get_objects() if type(one) is Solution]

    before = solutions()
    kinematics_sheets(
        problem_of("levers/task12"), positions=positions, layout=layout, errors=True, sigma=True
    )
    assert len(solutions()) == len(before)
