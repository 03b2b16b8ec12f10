"""The form: its contents, and its return from every spreadsheet program."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
import zipfile
from pathlib import Path
from typing import Any

import openpyxl
import pytest
from click.testing import CliRunner
from doors import (
    HEADS,
    WORDING_LANGUAGES as LANGUAGES,
    ExitCode,
    FormHead,
    KeyEntry,
    Sense,
    Submission,
    Unread,
    Variants,
    WrittenAnswer,
    cli,
    fingerprint_of,
    form as form_module,
    form_of,
    gears_reader_load as load_gears,
    get_language,
    key,
    key_of_task,
    list_form_rows,
    plain_text,
    problem_load as load,
    read_sense,
    read_unit,
    read_works,
)
from msgspec.structs import replace
from worked import path_of

EX3 = path_of("linkages/ex3")
EXACT, SIGMA, LENGTH = 2.2434567, 0.0123456, 44.869134

ENTRIES = (
    KeyEntry("v_B3", "VB₃", "v_{B3}", "m/s", EXACT, SIGMA, 2.5 * SIGMA, mm=LENGTH, scale="mu_v"),
    KeyEntry(
        *("omega_3", "ω3", "ω_{3}", "1/s", -EXACT, SIGMA, 2.5 * SIGMA),
        mm=LENGTH,
        scale="mu_v",
        sense=Sense.CW,
        asks_sense=True,
    ),
    KeyEntry("=cmd", "=1+1", "x", "N", EXACT, SIGMA, SIGMA, scale="mu_F", mm=LENGTH),
    KeyEntry("phi_3", "φ3", "φ_{3}", "deg", EXACT, 0.0, 0.1),
)


def book_of(data: bytes) -> Any:
    return openpyxl.load_workbook(io.BytesIO(data))


def made(**more: Any) -> bytes:
    return form_of(ENTRIES, FormHead(problem="ex3", fingerprint="f" * 64, **more))


def rows_of(sheet: Any) -> dict[str, int]:
    """Return the rows of the form by the texts of their first three columns, without words."""
    return {
        text: cell.row
        for row in sheet.iter_rows(max_col=3)
        for cell in row
        if cell.value is not None
        for text in (str(cell.value), str(cell.value).rpartition(", ")[2])
    }


def filled(data: bytes, lang: str = "ru") -> bytes:
    """Fill a form in as a student does."""
    words = get_language(lang).form
    book = book_of(data)
    sheet = book.worksheets[0]
    rows = rows_of(sheet)
    cells = {
        (words.student, "D"): "Иванов И. И.",
        (words.variant, "D"): "Б",
        (words["scales"]["mu_v"], "D"): 0.05,
        (words.ruler, "D"): "0,5",
        ("VB₃", "D"): 45.5,
        ("VB₃", "F"): 2275,
        ("VB₃", "G"): words["units"][1],
        ("ω3", "F"): "15,2",
        ("ω3", "H"): words["senses"]["cw"],
        ("φ3", "F"): 0,
    }
    for (name, column), value in cells.items():
        cell = sheet[f"{column}{rows[name]}"]
        assert not cell.protection.locked, name
        cell.value = value
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def read(path: Path, data: bytes | None = None) -> Submission:
    if data is not None:
        path.write_bytes(data)
    (work,) = read_works(path)
    return work


def check_filled(work: Submission) -> None:
    """Compare a submission with the values that `filled` wrote."""
    assert (work.student, work.problem, work.ruler_mm) == ("Иванов И. И.", "ex3", 0.5)
    assert (work.variant, work.scales) == ("Б", {"mu_v": 0.05})
    assert not work.remarks
    v, omega, force, phi = work.answers
    assert [answer.id for answer in work.answers] == ["v_B3", "omega_3", "=cmd", "phi_3"]
    assert (v.value, v.step, v.mm) == (2.275, 0.001, 45.5)
    assert (omega.value, omega.sense) == (15.2, Sense.CW)
    assert force.is_blank
    assert (phi.value, phi.is_blank) == (0.0, False)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_a_form_that_is_filled_in_is_read_back(tmp_path: Path, lang: str) -> None:
    work = read(tmp_path / "form.xlsx", filled(made(lang=lang), lang))
    check_filled(work)
    assert work.fingerprint == "f" * 64


def test_an_empty_form_is_blank_and_called_as_its_file(tmp_path: Path) -> None:
    work = read(tmp_path / "Петров.xlsx", made())
    assert work.student == "Петров"
    assert len(work.answers) == len(ENTRIES)
    assert all(answer.is_blank for answer in work.answers)
    assert not work.remarks
    named = read(tmp_path / "x.xlsx", made(student="=Сидоров", variant="В"))
    assert (named.student, named.variant) == ("=Сидоров", "В")


def test_a_missing_row_is_reported(tmp_path: Path) -> None:
    book = book_of(made())
    sheet = book.worksheets[0]
    sheet.delete_rows(rows_of(sheet)["ω3"])
    stream = io.BytesIO()
    book.save(stream)
    (remark,) = read(tmp_path / "form.xlsx", stream.getvalue()).remarks
    assert (remark.reason, remark.fault) == (Unread.ROW, "omega_3")


def test_the_form_does_not_know_the_answers() -> None:
    with zipfile.ZipFile(io.BytesIO(made())) as archive:
        text = b"".join(map(archive.read, archive.namelist())).decode()
    for number in (EXACT, SIGMA, 2.5 * SIGMA, LENGTH):
        assert f"{number:.4g}"[:-1] not in text
    other = tuple(
        replace(
            one, exact=7.7, sigma=0.1, tolerance=0.2, sense=Sense.CCW, is_visible=False, zero=True
        )
        for one in ENTRIES
    )
    assert form_of(other, FormHead(problem="ex3", fingerprint="f" * 64)) == made()


def test_only_the_answers_can_be_written_in() -> None:
    sheet = book_of(made()).worksheets[0]
    assert sheet.protection.sheet
    rows = rows_of(sheet)
    open_cells = {cell.coordinate for row in sheet for cell in row if not cell.protection.locked}
    head = {f"D{rows[name]}" for name in rows if f"D{rows[name]}" in open_cells}
    assert len(head) == 6 + 3  # student, group, variant, two scales, ruler; segments of plans
    assert not any(name[0] in "ABCEI" for name in open_cells)
    given = book_of(made(variant="Б")).worksheets[0]
    assert given[f"D{rows_of(given)['Вариант']}"].protection.locked


def test_texts_are_not_formulas_and_every_formula_is_the_forms_own() -> None:
    book = book_of(made(student="=1+1", title="=2+2"))
    formulas = [
        str(cell.value) for sheet in book for row in sheet for cell in row if cell.data_type == "f"
    ]
    assert len(formulas) == 4  # μ and the comparison of the two that are measured on a plan
    assert all(formula.startswith("=IF(") for formula in formulas)


def test_units_and_senses_are_chosen_from_lists_that_can_be_read() -> None:
    sheet = book_of(made()).worksheets[0]
    rows = rows_of(sheet)
    lists = {
        str(cells): rule.formula1.strip('"').split(",")
        for rule in sheet.data_validations.dataValidation
        for cells in rule.sqref.ranges
    }
    assert lists[f"G{rows['VB₃']}"] == ["м/с", "мм/с", "см/с"]
    assert [read_sense(text) for text in lists[f"H{rows['ω3']}"]] == [Sense.CCW, Sense.CW]
    assert f"H{rows['VB₃']}" not in lists
    assert all(len(",".join(items)) < 255 for items in lists.values())


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_words_of_the_form_can_be_read_back(lang: str) -> None:
    words = get_language(lang).form
    for head in (*words.columns, words.position, words.student, words.variant, words.problem):
        assert key(head) in HEADS or head in HEADS, head
    assert all(map(read_unit, words.units))
    assert {read_sense(text) for text in words["senses"].values()} == set(Sense)
    assert list(words.unread) == [why.value for why in Unread]


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize(
    "name",
    [
        "linkages/ex1",
        "linkages/ex3",
        "levers/task-13",
        "levers/six-link",
        "levers/task12",
        "press/press",
    ],
)
def test_letters_that_a_form_and_a_key_print_are_read_back(name: str, lang: str) -> None:
    """Also by hand into a table of one's own: v_B of a point that both links of a pair share."""
    group = Variants(path_of(name))
    task = group.task(group.names[0] if group.names else None)
    say = get_language(lang).notation
    for entry in key_of_task(task).entries:
        symbol = say.symbol(entry.symbol)
        label = say.symbol(entry.label)
        for text in (entry.id, label, symbol, plain_text(symbol)):
            found = task.find(WrittenAnswer(what=text, position=entry.position))
            assert (found.name, found.position) == (entry.id, entry.position), text


@pytest.mark.parametrize(
    ("name", "text", "found"),
    [
        ("press/press", "v_A2", "v_A"),
        ("press/press", "vs A3 A2", "vs_A3_A"),
        ("press/press", "aкор_A3A2", "ak_A3_A"),
        ("levers/six-link", "a_L", "a_H2"),
        ("levers/six-link", "v L", "v_H2"),
    ],
)
def test_letters_of_the_source_are_read_by_hand(name: str, text: str, found: str) -> None:
    task = Variants(path_of(name)).task(None)
    assert task.find(WrittenAnswer(what=text, position=0)).name == found


@pytest.mark.parametrize(("lang", "balance"), [("ru", "M_ур"), ("en", "M_b")])
def test_a_quantity_without_letters_of_the_file_has_its_symbol(lang: str, balance: str) -> None:
    entries = key_of_task(Variants(path_of("press/press")).task(None)).entries
    rows = {row.id: row.letters for row in list_form_rows(entries, get_language(lang))}
    assert rows["vs_A3_A"] == "v_A3A2" and rows["omega_3"] == "ω₃" and rows["F_2_1"] == "F₂₁"
    assert rows["balance"] == balance
    ex3 = key_of_task(Variants(path_of("linkages/ex3")).task(None)).entries
    named = {row.id: row.letters for row in list_form_rows(ex3, get_language(lang))}
    assert named["vs_B3_B"] == "v_B3B2"  # as the file has it


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize(
    "name", ["linkages/ex3", "levers/task12", "press/press", "gears/gears-ex2", "point/k11-01"]
)
def test_a_quantity_is_in_words_with_its_symbol_as_sheets_print_it(name: str, lang: str) -> None:
    group = Variants(path_of(name))
    task = group.task(group.names[0] if group.names else None)
    rows = list_form_rows(key_of_task(task).entries, get_language(lang))
    assert len({(row.words, row.letters) for row in rows}) == len(rows)
    for row in rows:
        assert row.words or row.id in ("z_3", "phi_3"), row.id
        # points are called in the words as in the letters
        points = re.findall(r"\b[A-Z]\d?\b", row.words)
        assert "".join(points) == "" or "".join(points) in row.letters, row
        assert not re.search(r"_\d$|_\{", row.letters), row.letters
    found = {row.id: f"{row.words}, {row.letters}" for row in rows}
    if (name, lang) == ("linkages/ex3", "ru"):
        assert found["at_B3_C"] == "касательное ускорение точки B3 относительно C, a^τ_B3C"
        assert found["omega_3"] == "угловая скорость звена 3, ω₃"


def test_quantities_with_one_symbol_keep_their_names() -> None:
    entries = key_of_task(Variants(path_of("cams/central")).task(None)).entries
    rows = {row.id: row.letters for row in list_form_rows(entries, get_language("ru"))}
    assert rows["theta_max"] == "theta_max"  # ϑ_max is also the symbol of the return's angle
    assert rows["theta_max_return"] == "theta_max_return"
    assert rows["rho_min"] == "ρ_min"


def test_the_same_form_has_the_same_bytes() -> None:
    assert made() == made()
    with zipfile.ZipFile(io.BytesIO(made())) as archive:
        assert {member.date_time[0] for member in archive.infolist()} == {1980}
        assert not re.search(rb"202\d-", archive.read("docProps/core.xml"))


def test_positions_are_named_where_there_are_several(tmp_path: Path) -> None:
    entries = [replace(ENTRIES[0], id=f"v_B3@{n}", position=n) for n in range(3)]
    work = read(tmp_path / "form.xlsx", form_of(entries, FormHead(problem="ex3")))
    assert [answer.position for answer in work.answers] == [0, 1, 2]


def test_the_fingerprint_covers_the_data_that_answers_depend_on(tmp_path: Path) -> None:
    text = EX3.read_text("utf-8")

    def changed(*pairs: tuple[str, str]) -> str:
        new = text
        for old, other in pairs:
            assert old in new
            new = new.replace(old, other, 1)
        (tmp_path / "other.toml").write_text(new, "utf-8")
        return fingerprint_of(load(tmp_path / "other.toml"))

    own = fingerprint_of(load(EX3))
    assert re.fullmatch("[0-9a-f]{64}", own)
    assert changed(("стойка, м", "рама"), ("Рычажный механизм", "Механизм")) == own
    assert changed(("AB = 0.064", "AB = 0.065")) != own


def test_the_unit_of_the_radii_of_a_train_is_not_in_the_fingerprint() -> None:
    problem = load_gears(path_of("gears/gears-ex1"))
    inches = replace(problem, train=replace(problem.train, length_unit="in"))
    assert fingerprint_of(inches) == fingerprint_of(problem)


# LibreOffice -------------------------------------------------------------------------------------

SOFFICE = shutil.which("soffice")
CSV = "csv:Text - txt - csv (StarCalc):59,34,76,1"
"""Semicolons, quotes, UTF-8, from the first row."""


@pytest.mark.dear
@pytest.mark.skipif(SOFFICE is None, reason="soffice is not installed")
def test_a_form_comes_back_from_libreoffice(tmp_path: Path) -> None:
    source = tmp_path / "form.xlsx"
    source.write_bytes(filled(made()))
    home, out = f"-env:UserInstallation={(tmp_path / 'office').as_uri()}", str(tmp_path / "out")
    for kind in ("xlsx", CSV):
        subprocess.run(
            [str(SOFFICE), home, "--headless", "--convert-to", kind, "--outdir", out, str(source)],
            check=True,
            capture_output=True,
            timeout=120,
        )
    work = read(tmp_path / "out" / "form.xlsx")
    check_filled(work)
    assert work.fingerprint == "f" * 64
    check_filled(read(tmp_path / "out" / "form.csv"))
    # The student sees this while typing: 45.5 mm at 0.05 are 2275 mm/s.
    computed = openpyxl.load_workbook(tmp_path / "out" / "form.xlsx", data_only=True).worksheets[0]
    rows = rows_of(computed)
    assert computed[f"I{rows['VB₃']}"].value == get_language("ru").form.agrees
    assert not computed[f"I{rows['ω3']}"].value


# Command -----------------------------------------------------------------------------------------


def run(*args: str) -> Any:
    return CliRunner().invoke(cli, ["form", *args])


def test_the_command_writes_a_form_for_each_student(tmp_path: Path) -> None:
    names = tmp_path / "names.txt"
    names.write_bytes("Иванов И.\r\n\r\n  Петров   П.\r\n".encode("cp1251"))
    result = run(str(EX3), "-o", str(tmp_path), "--names", str(names))
    assert result.exit_code == ExitCode.DONE, result.output
    made_files = [Path(line) for line in result.output.splitlines()]
    assert [path.name for path in made_files] == ["ex3-form-1.xlsx", "ex3-form-2.xlsx"]
    works = [read(path) for path in made_files]
    assert [work.student for work in works] == ["Иванов И.", "Петров П."]
    assert works[0].fingerprint == fingerprint_of(load(EX3))
    assert works[0].problem == "ex3"
    assert works[0].answers and all(answer.is_blank for answer in works[0].answers)


@pytest.mark.parametrize(
    ("args", "said"),
    [
        (["--students", "2", "--names", "x"], "not both"),
        (["--students", "0"], "range"),
        (["--names", "nowhere.txt"], "nowhere.txt"),
    ],
)
def test_the_command_rejects_impossible_requests(
    args: list[str], said: str, tmp_path: Path
) -> None:
    result = run(str(EX3), "-o", str(tmp_path), *args)
    assert result.exit_code == ExitCode.USAGE
    assert said in result.output
    assert not list(tmp_path.iterdir())


def test_a_fingerprint_does_not_depend_on_the_order_of_a_set() -> None:
    assert form_module._parts(frozenset({"2", "10", "1"})) == ["1", "10", "2"]
