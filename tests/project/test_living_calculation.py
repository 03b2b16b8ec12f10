"""The calculation by formulas: its values are the program's, and it follows changed data."""

from __future__ import annotations

import io
import json
import math
import re
import shutil
import subprocess
from collections.abc import Mapping
from contextlib import redirect_stdout
from pathlib import Path
from typing import Any

import numpy as np
import openpyxl
import pytest
from cases import each, sampled, some
from doors import (
    DRAFTING_PROFILES,
    LINKAGES,
    CalculationBuilder,
    Call,
    Drawn,
    ExpressionName as Name,
    ExpressionNumber as Number,
    Homework,
    LivingCalculation,
    ModelQuantity as Quantity,
    NameRegistry,
    Negative,
    Operation,
    Project,
    Solution,
    UnreadableFormulaError,
    calculation_files,
    calculation_of,
    expression_evaluate as evaluate,
    get_language,
    kind_of,
    linkage_chapters,
    name_of,
    options_of,
    read_expression,
    settle,
    synthesis_chapter,
    synthesize,
)
from msgspec.structs import replace
from worked import PROBLEMS

from benchmarks.generator import random_problem
from planmethod import load, loads

CLOSE = 1e-9


def noted(path: Path, lang: str = "en") -> Project | Homework:
    """Return a file's project, or the homework that it is."""
    kind = kind_of(path)
    if kind is LINKAGES:
        return replace(settle(load(path), path), language=lang)
    return Homework(kind.load(path, None), kind, lang)


def calculated(path: Path, lang: str = "en") -> LivingCalculation:
    return calculation_of(noted(path, lang))


def quantities(calculation: LivingCalculation) -> dict[str, Quantity]:
    return {one.name: one for chapter in calculation.chapters for one in chapter.quantities()}


def run_notebook(data: bytes, given: Mapping[str, float] | None = None) -> dict[str, Any]:
    """Return the variables of a notebook after all its cells, with some data changed."""
    variables: dict[str, Any] = {}
    changed = dict(given or {})
    with redirect_stdout(io.StringIO()):
        for cell in json.loads(data)["cells"]:
            if cell["cell_type"] != "code":
                continue
            source = "".join(cell["source"])
            for name in [*changed]:
                source, found = re.subn(
                    rf"(?m)^{name} = [-+.e\d]+(?=  #)", f"{name} = {changed[name]!r}", source
                )
                if found:
                    del changed[name]
            exec(compile(source, "cell", "exec"), variables)
    assert not changed, f"no given data of these names: {changed}"
    return variables


def notebook_of(calculation: LivingCalculation) -> bytes:
    return calculation_files(calculation, "numbers", "en", ("ipynb",))["numbers.ipynb"]


def differences(
    found: Mapping[str, Any], calculation: LivingCalculation, *, but: frozenset[str] = frozenset()
) -> list[str]:
    """Return the names of quantities that have other values."""
    wrong = []
    # A force of zero among large ones is what rounding leaves of them.
    largest: dict[str, float] = {}
    for one in quantities(calculation).values():
        most = max((abs(value) for value in one.values if math.isfinite(value)), default=0.0)
        largest[one.unit] = max(most, largest.get(one.unit, 1.0))
    for name, one in quantities(calculation).items():
        if name in but:
            continue
        values, wanted = np.atleast_1d(np.asarray(found[name], float)), np.array(one.values)
        assert values.shape == wanted.shape, name
        there = np.isfinite(wanted)
        off = np.abs(values - wanted)[there]
        if one.unit == "°":
            off = np.minimum(off, np.abs((off + 180.0) % 360.0 - 180.0))
        size = np.abs(wanted[there]).max(initial=1e-6 * largest[one.unit])
        if not np.all(off <= CLOSE * size):
            wrong.append(name)
    return wrong


SHIPPED = [
    *sorted(PROBLEMS.glob("machines/*.toml")),
    PROBLEMS / "linkages/ex3.toml",
    *sorted(PROBLEMS.glob("meshing/*.toml")),
    *sorted(PROBLEMS.glob("gears/*.toml")),
    *sorted(PROBLEMS.glob("cams/*.toml")),
    PROBLEMS / "camshafts/automatic.toml",
    PROBLEMS / "press/press.toml",
    *sampled(sorted(PROBLEMS.glob("levers/task-*.toml")), 20),
]


@each("path", sampled(SHIPPED, 4))
def test_every_quantity_has_a_formula_that_gives_the_value_of_the_program(path: Path) -> None:
    calculation = calculated(path)
    texts = get_language("en").calculation
    remarks = [one.remark for one in quantities(calculation).values()]
    assert not [remark for remark in remarks if texts.not_reproduced in remark]
    assert differences(run_notebook(notebook_of(calculation)), calculation) == []


def test_random_mechanisms_have_a_formula_for_everything() -> None:
    """Their groups are dyads of all kinds, in any order."""
    words = get_language("en")
    for seed in range(300, 300 + some(30, 4)):
        text, _ = random_problem(seed)
        solution = Solution(loads(text, name=f"random {seed}"))
        builder = CalculationBuilder(words.calculation.not_reproduced)
        linkage_chapters(solution, ["0"], builder, words)
        calculation = builder.finished("random", "Given")
        computed = [one.name for one in quantities(calculation).values() if one.remark]
        assert computed == [], seed
        found = run_notebook(notebook_of(calculation))
        assert differences(found, calculation) == [], seed
        for link, moving in solution.links.items():
            if f"omega_{link}" in found:
                assert found[f"omega_{link}"] == pytest.approx(moving.omega[0], rel=1e-8, abs=1e-9)


def changed_file(path: Path, folder: Path, *edits: tuple[str, str]) -> Path:
    text = path.read_text("utf-8")
    for old, new in edits:
        assert old in text
        text = text.replace(old, new, 1)
    file = folder / path.name
    file.write_text(text, "utf-8")
    return file


CHANGES: list[tuple[str, list[tuple[str, str]], dict[str, float]]] = [
    (
        "machines/rubbing-crank",
        [("OA = 0.1", "OA = 0.09"), ("mass = 3\n", "mass = 6.5\n")],
        {"l_OA": 0.09, "m_2": 6.5},
    ),
    ("linkages/ex3", [("AB = 0.064", "AB = 0.06"), ("DE = 0.18", "DE = 0.19")],
     {"l_AB": 0.06, "l_DE": 0.19}),
    ("gears/gears-ex3", [("2 = 21", "2 = 31"), ("1 = 1200", "1 = 900")],
     {"z_2": 31.0, "n_1_0": 900.0}),
    ("machines/balanced-crank", [("AB = 0.36", "AB = 0.4"), ("mass = 2.8", "mass = 3.1"),
     ("1 = 0.2,", "1 = 0.25,")], {"l_AB": 0.4, "m_3": 3.1, "r_s_1": 0.25}),
    ("machines/balanced-fourbar", [("at = 0.13", "at = 0.1")], {"l_CS3": 0.1}),
    ("camshafts/automatic", [("phase = 150", "phase = 172"), ("phase = 30", "phase = 7.5")],
     {"phi_0_B": 172.0, "phi_0_A": 7.5}),
    ("cams/oscillating", [], {}),
]  # fmt: skip


@each("name, edits, given", CHANGES)
def test_changed_data_give_what_the_program_gives_for_them(
    tmp_path: Path, name: str, edits: list[tuple[str, str]], given: dict[str, float]
) -> None:
    path = PROBLEMS / f"{name}.toml"
    before = calculated(path)
    after = calculated(changed_file(path, tmp_path, *edits))
    assert differences(run_notebook(notebook_of(before), given), after) == []


def recalculated(data: bytes, folder: Path, given: Mapping[str, float]) -> dict[str, Any]:
    """Return the values of all names after LibreOffice has calculated a workbook again."""
    book = openpyxl.load_workbook(io.BytesIO(data))  # this drops the values of formulas
    for name, value in given.items():
        ((sheet, cell),) = book.defined_names[name].destinations
        book[sheet][cell.replace("$", "")].value = value
    (folder / "in").mkdir(parents=True)
    book.save(folder / "in/numbers.xlsx")
    home = f"-env:UserInstallation={(folder / 'home').as_uri()}"
    order = ["soffice", home, "--headless", "--convert-to", "xlsx", "--outdir", "out",
             "in/numbers.xlsx"]  # fmt: skip
    subprocess.run(order, cwd=folder, check=True, capture_output=True, timeout=300)
    return cell_values((folder / "out/numbers.xlsx").read_bytes())


def cell_values(data: bytes) -> dict[str, Any]:
    """Return the values of the cells of all names of a workbook."""
    book = openpyxl.load_workbook(io.BytesIO(data), data_only=True)
    found = {}
    for name, defined in book.defined_names.items():
        for sheet, place in defined.destinations:
            cells = book[sheet][place.replace("$", "")]
            row = cells[0] if isinstance(cells, tuple) else (cells,)
            found[name] = [math.nan if c.value is None else c.value for c in row]
    return found


@pytest.mark.dear
@pytest.mark.skipif(not shutil.which("soffice"), reason="LibreOffice is absent")
def test_libreoffice_calculates_the_same_also_for_changed_data(tmp_path: Path) -> None:
    for name, edits, given in [*CHANGES[:3], CHANGES[4], CHANGES[6]]:
        path, folder = PROBLEMS / f"{name}.toml", tmp_path / name
        folder.mkdir(parents=True)
        data = calculation_files(calculated(path), "numbers", "en", ("xlsx",))["numbers.xlsx"]
        after = calculated(changed_file(path, folder, *edits))
        assert differences(recalculated(data, folder / "office", given), after) == [], name


def test_a_workbook_has_the_values_of_its_formulas() -> None:
    """A program that does not calculate shows them: openpyxl, a telephone."""
    calculation = calculated(PROBLEMS / "gears/gears-ex3.toml")
    data = calculation_files(calculation, "numbers", "en", ("xlsx",))["numbers.xlsx"]
    assert differences(cell_values(data), calculation) == []


def test_the_flywheel_of_the_table_is_near_the_exact_one() -> None:
    """Trapezoids between 24 positions: within three per cent."""
    found = quantities(calculated(PROBLEMS / "machines/engine.toml"))
    by_table, exact = found["J_f"].values[0], found["J_f_exact"].values[0]
    assert by_table != exact
    assert by_table == pytest.approx(exact, rel=0.03)
    assert found["J_f"].formula is not None
    assert found["J_f_exact"].formula is None


@each("lang, title", [("en", "Gear train"), ("ru", "Зубчатый механизм")])
def test_sheets_are_chapters_in_the_language(lang: str, title: str) -> None:
    calculation = calculated(PROBLEMS / "gears/gears-ex2.toml", lang)
    data = calculation_files(calculation, "numbers", lang, ("xlsx",))["numbers.xlsx"]
    assert openpyxl.load_workbook(io.BytesIO(data)).sheetnames[-1] == title


def test_a_group_without_a_closed_form_is_a_table_of_values() -> None:
    """A sentence names such groups; the groups before them have formulas."""
    words = get_language("en")
    text, _ = random_problem(0, triad=True)
    solution = Solution(loads(text, name="triad"))
    builder = CalculationBuilder(words.calculation.not_reproduced)
    linkage_chapters(solution, ["0"], builder, words)
    calculation, texts = builder.finished("triad", "Given"), words.calculation
    told = [getattr(item, "text", "") for c in calculation.chapters for item in c.items]
    assert texts.no_form in told
    found = quantities(calculation)
    last = next(one for one in solution.structure.groups if one.class_number > 2).links[0]
    assert found[f"omega_{last}"].remark == texts.computed
    assert found[f"omega_{last}"].values == tuple(solution.links[last].omega)


PARTIAL = ('method = "full"', 'method = "partial"')
BALANCINGS: list[tuple[str, list[tuple[str, str]]]] = [
    ("balanced-crank",
     [PARTIAL, ("\"partial\"", "\"partial\"\nshare = 0.5"), (", 2 = 0.24", "")]),
    ("balanced-crank", [PARTIAL, (", 2 = 0.24", "")]),
    ("balanced-fourbar", [PARTIAL, (", 3 = 0.12", "")]),
    ("balanced-fourbar", [("at = 0.16 }", "at = 0.16, across = 0.05 }")]),
    ("balanced-crank", [("at = 0.04 }", "at = -0.04 }"), ("1 = 0.2, ", "")]),
    ("balanced-crank", [("at = 0.04 }", "at = 0.04, across = -0.03 }"), PARTIAL,
                        (", 2 = 0.24", "")]),
]  # fmt: skip


@each("name, edits", BALANCINGS)
def test_counterweights_follow_from_formulas(
    tmp_path: Path, name: str, edits: list[tuple[str, str]]
) -> None:
    """In part, by the first harmonic, with centres beside the lines and behind the pivot."""
    calculation = calculated(changed_file(PROBLEMS / f"machines/{name}.toml", tmp_path, *edits))
    texts = get_language("en").calculation
    found = quantities(calculation)
    assert texts.balancing in [chapter.title for chapter in calculation.chapters]
    assert not [one for one in found.values() if texts.not_reproduced in one.remark]
    again, after = run_notebook(notebook_of(calculation)), frozenset({"F_x", "F_y", "F"})
    assert differences(again, calculation, but=after) == []
    for one in after:  # rounding, where all is balanced
        off = np.abs(np.atleast_1d(again[one]) - found[one].values)
        assert np.all(off <= CLOSE * max(found["F_0"].values))


def synthesis(kind: str, options: Mapping[str, Any]) -> LivingCalculation:
    words = get_language("en")
    builder = CalculationBuilder(words.calculation.not_reproduced)
    made = Drawn(synthesize(kind, options), DRAFTING_PROFILES["board"])
    synthesis_chapter(made, builder, words)
    return builder.finished(kind, "Given")


SYNTHESES: list[tuple[str, dict[str, Any], dict[str, Any], dict[str, float]]] = [
    ("slotted", {"K_v": 1.22, "centres": 1.08}, {"K_v": 1.4}, {"K_v": 1.4}),
    ("slotted", {"K_v": 1.5, "centres": 0.5, "stroke": 0.4}, {"stroke": 0.3}, {"H": 0.3}),
    ("slider-crank", {"K_v": 1.2, "stroke": 0.2, "offset": 0.03}, {"stroke": 0.22}, {"H": 0.22}),
    ("slider-crank", {"K_v": 1.1, "stroke": 0.2, "lambda": 0.4}, {"K_v": 1.05}, {"K_v": 1.05}),
    ("slider-crank", {"stroke": 0.2, "lambda": 0.3}, {"lambda": 0.25}, {"lambda_": 0.25}),
    ("slider-crank", {"stroke": 0.2, "lambda": 0.3, "offset": 0.02}, {"offset": 0.03}, {"e": 0.03}),
    ("slider-crank", {"stroke": 0.2, "pressure": 20.0}, {"pressure": 25.0}, {"alpha_max": 25.0}),
    ("crank-rocker", {"K_v": 1.2, "swing": 50.0, "rocker": 0.3, "beta": 120.0}, {"swing": 45.0},
     {"psi": 45.0}),
    ("crank-rocker", {"K_v": 1.2, "swing": 50.0, "rocker": 0.3}, {}, {}),
    ("three-angles", {"angles": ((40.0, 60.0), (65.0, 75.0), (90.0, 95.0)), "centres": 0.4},
     {"centres": 0.5, "angles": ((42.0, 60.0), (65.0, 75.0), (90.0, 95.0))},
     {"l_OC": 0.5, "phi_q_1": 42.0}),
]  # fmt: skip


@each("kind, options, other, given", SYNTHESES)
def test_a_synthesis_follows_changed_data(
    kind: str, options: dict[str, Any], other: dict[str, Any], given: dict[str, float]
) -> None:
    every = dict.fromkeys(options_of(kind))
    before = synthesis(kind, {**every, **options})
    after = synthesis(kind, {**every, **options, **other})
    texts = get_language("en").calculation
    assert not [one for one in quantities(before).values() if texts.not_reproduced in one.remark]
    assert differences(run_notebook(notebook_of(before), given), after) == []


def test_a_size_that_a_synthesis_gives_is_that_of_the_motion() -> None:
    calculation = calculated(PROBLEMS / "press/press.toml")
    names = [one.name for one in quantities(calculation).values() if one.symbol == "l_{O1A}"]
    assert names == ["l_O1A"]


def test_a_position_has_the_formula_of_its_own_phase() -> None:
    """Where half of a rise and of a return give one displacement, too."""
    builder = CalculationBuilder("no formula")
    builder.add_input("h", 2.0)
    builder.add_input("H", 4.0)
    builder.value("u", [0.5, 0.5], is_input=True)
    builder.row("s", ["h·u", "H − 6·u"], [1.0, 1.0], by_position=True)
    builder.close("One")
    found = run_notebook(notebook_of(builder.finished("t", "Given")), {"h": 6.0})
    assert found["s"].tolist() == [3.0, 1.0]


def test_colours_are_told_in_the_workbook_alone() -> None:
    calculation = calculated(PROBLEMS / "linkages/ex3.toml")
    texts = get_language("en").calculation
    book = notebook_of(calculation).decode()
    assert texts.about.split(":")[0] not in book
    assert texts.position.format(number=0) not in book
    data = calculation_files(calculation, "x", "en", ("xlsx",))["x.xlsx"]
    sheet = openpyxl.load_workbook(io.BytesIO(data)).worksheets[0]
    assert texts.about in [sheet.cell(row, 1).value for row in (1, 2)]


# Formulas ----------------------------------------------------------------------------------------

SYMBOLS = {"l_{AB}": "l_AB", "φ_{1}": "phi_1", "m": "m", "inv α": "inv_alpha", "α": "alpha",
           "α_{w}": "alpha_w", "T": "T"}  # fmt: skip
VALUES = {name: np.asarray(value) for name, value in
          {"l_AB": 3.0, "phi_1": 60.0, "m": 2.0, "inv_alpha": 0.0149, "alpha": 20.0,
           "alpha_w": 25.0, "T": 5.0, "pi": np.pi}.items()}  # fmt: skip


@each(
    "letters, value",
    [
        ("−l_{AB}^{2}·cos φ_{1}", -4.5),
        ("\\frac{2T − m}{l_{AB}·m}", 8 / 6),
        ("l_{AB} − m − 1", 0.0),
        ("|m − l_{AB}|", 1.0),
        ("\\sqrt{l_{AB}^{2} + 16}", 5.0),
        ("atan2(−1; −1)", -135.0),
        ("atan2(1, m − 1)", 45.0),
        ("m·(π·(3 − 0,5) + inv α)", 2 * (2.5 * math.pi + 0.0149)),
        ("inv α_{w}", math.tan(math.radians(25)) - math.radians(25)),
        ("sin^{2}φ_{1}", 0.75),
        ("360° − φ_{1}", 300.0),
        ("(2·m)^{\\frac{1}{2}}", 2.0),
        ("m·(−1)", -2.0),
    ],
)
def test_a_printed_formula_is_read_as_it_is_printed(letters: str, value: float) -> None:
    assert float(evaluate(read_expression(letters, SYMBOLS), VALUES)) == pytest.approx(value)


@each("text", ["", "m·", "x_{1}", "(m", "m)", "\\frac{m}", "atan2(m)", "m =", "cos", "2 3"])
def test_what_is_no_formula_is_refused(text: str) -> None:
    with pytest.raises(UnreadableFormulaError):
        read_expression(text, SYMBOLS)


def test_angles_are_converted_where_a_formula_has_radians() -> None:
    read = read_expression("tan α − α", SYMBOLS, in_radians=frozenset({"alpha"}))
    assert float(evaluate(read, VALUES)) == pytest.approx(0.014904, abs=1e-6)


def test_a_wrong_formula_is_not_kept() -> None:
    builder = CalculationBuilder("no formula")
    builder.add_input("m", 2.0)
    assert builder.formula("d", "3·m", 6.0).remark == ""
    wrong = builder.formula("h", "3·m", 6.1)
    assert (wrong.formula, wrong.remark, wrong.values) == (None, "no formula", (6.1,))


@each(
    "symbol, name",
    [
        ("ω_{1}", "omega_1"), ("l_{AB}", "l_AB"), ("Δ", "det"), ("M_{пр}", "M_pr"), ("c^{*}", "c_"),
        ("λ", "lambda_"), ("F^{τ}_{21}", "F_t_21"), ("=cmd|x", "cmd_x"), ("B12", "B12_"),
        ("1", "x_1"), ("", "x"),
    ],
)  # fmt: skip
def test_a_name_is_one_for_a_workbook_and_for_python(symbol: str, name: str) -> None:
    assert name_of(symbol) == name
    assert name.isidentifier()


def test_names_differ_without_regard_to_capitals() -> None:
    registry = NameRegistry()
    names = [registry.new(symbol) for symbol in ("B_{max}", "b_{max}", "b_{max}")]
    assert names == ["B_max", "b_max_v2", "b_max_v3"]


def test_a_negative_power_has_brackets_in_a_workbook() -> None:
    """Excel takes −2^2 for 4."""
    builder = CalculationBuilder("")
    builder.add_input("m", 2.0)
    square = Operation("^", Name("m"), Number(2.0))
    builder.formula("y", Negative(square), -4.0)
    builder.formula("w", Operation("-", Number(1.0), Negative(Name("m"))), 3.0)
    builder.formula("q", Call("sqrt", (Operation("^", Negative(Name("m")), Number(2.0)),)), 2.0)
    builder.close("One")
    data = calculation_files(builder.finished("t", "Given"), "x", "en", ("xlsx",))["x.xlsx"]
    sheet = openpyxl.load_workbook(io.BytesIO(data))["One"]
    assert [sheet.cell(row, 5).value for row in (2, 3, 4)] == [
        "=-(m^2)", "=1-(-m)", "=SQRT((-m)^2)",
    ]  # fmt: skip
