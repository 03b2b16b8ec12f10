"""Paper, title block, config file and sets of sheets from the command line."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import PAPER_FORMATS as FORMATS, LayoutError, cli, compacted, kinematics_sheets
from msgspec.structs import replace
from worked import ROOT, path_of, problem_of

EX1, EX2, EX3 = (str(path_of(f"linkages/ex{number}")) for number in (1, 2, 3))
SIX_LINK = str(path_of("levers/six-link"))
VARIANTS = str(path_of("levers/task12-variants"))


@pytest.fixture(autouse=True)
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, args)


def config(text: str, name: str = "my-config.toml") -> str:
    Path(name).write_text(text, encoding="utf-8")
    return name


def drawn(*args: str) -> str:
    done = run("sheet", EX1, "--format", "svg", *args)
    assert done.exit_code == 0, done.output
    return Path("out/ex1.svg").read_text("utf-8")


# How many ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("formats", ["svg", "dxf"])
def test_more_than_six_sheets_of_a_file_are_not_drawn_unasked(formats: str, desk: Path) -> None:
    args = ("sheet", SIX_LINK, "--layout", "forces", "--phi", "0:360:45", "--format", formats)
    done = run(*args, "--lang", "en")
    assert done.exit_code == 2
    assert "six-link.toml: 8 positions take 8 sheets." in done.output
    assert "(--phi 150)" in done.output
    assert "--all-positions" in done.output
    assert not list(desk.glob("out/*"))


def test_a_plan_that_takes_more_sheets_than_it_should_is_not_written() -> None:
    """The least number is known before the work, the true one after it."""
    problem = problem_of("linkages/ex1")
    many = [float(phi) for phi in range(0, 360, 10)]
    with pytest.raises(LayoutError, match="36 positions take 3 sheets"):
        kinematics_sheets(problem, positions=many, most=2)
    small = replace(problem, sheet=replace(problem.sheet, paper="A3"))
    with pytest.raises(LayoutError, match=r"6 positions take \d sheets"):
        kinematics_sheets(small, positions=many[::6], most=1)
    assert kinematics_sheets(problem, positions=[20.0], most=0)


def test_all_positions_are_drawn_on_request(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("planmethod.linkages.sheets.MAX_SHEETS", 1)
    args = ("sheet", EX2, "--phi", "0:360:20", "--format", "svg")
    assert run(*args).exit_code == 2
    done = run(*args, "--all-positions")
    assert done.exit_code == 0, done.output
    assert len(done.stdout.split()) == 2


# Small paper -------------------------------------------------------------------------------------


def test_a_printer_at_home_has_sheets_of_a4(desk: Path) -> None:
    """The scales of the file are for larger paper: they are left out."""
    assert compacted(problem_of("linkages/ex1"), [20.0]).scales.mu_v is None
    done = run("sheet", EX1, "--compact", "--format", "svg")
    assert done.exit_code == 0, done.output
    sheets = [path.read_text("utf-8") for path in sorted(desk.glob("out/ex1*.svg"))]
    assert len(sheets) > 1
    assert all('width="210mm"' in sheet and 'height="297mm"' in sheet for sheet in sheets)


def test_small_paper_is_for_a_few_positions_and_not_with_a_layout() -> None:
    done = run("sheet", EX1, "--compact", "--phi", "0:360:30")
    assert done.exit_code == 2
    assert "--compact is for at most 5 positions, 12 are requested" in done.output
    assert run("sheet", EX1, "--compact", "--layout", "homework").exit_code == 2


# Paper and forms ---------------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["A4", "A3", "A3:portrait", "А2:книжная", "A4x3", "A3x3:portrait"])
@pytest.mark.parametrize("command", ["sheet", "lint"])
def test_papers(command: str, name: str) -> None:
    done = run(command, EX1, "--paper", name, *(["--format", "svg"] if command == "sheet" else []))
    assert done.exit_code == 0, done.output


def test_the_page_is_the_paper() -> None:
    head = drawn("--paper", "A3:portrait")[:600]
    assert 'width="297mm"' in head
    assert 'height="420mm"' in head


@pytest.mark.parametrize("command", ["sheet", "lint", "structure"])
@pytest.mark.parametrize(
    ("option", "value", "said"),
    [
        ("--paper", "A4:landscape", "A4 must be portrait by GOST 2.301"),
        ("--paper", "A3x2", "GOST 2.301 has no paper format A3x2"),
        ("--form", "3", "'3' is not one of 1, 1+2a, 2, 2a"),
        ("--lang", "de", "'de' is not one of ru, en"),
        ("--stamp", "autor=x", "Unknown field 'autor' of the title block. Did you mean 'author'?"),
        ("--config", "no.toml", "no.toml: 1 fault in the config file"),
    ],
)
def test_faults_of_the_options(command: str, option: str, value: str, said: str) -> None:
    refused = run(command, EX1, option, value)
    assert refused.exit_code == 2
    assert said in refused.output
    assert not Path("out").exists()


@pytest.mark.parametrize("form", ["1", "1+2a", "2", "2а", "2a"])
def test_forms_are_drawn_and_clean(form: str) -> None:
    assert run("lint", EX1, "--form", form, "--side-columns", "--graphs-27-30").exit_code == 0


def test_a_structural_sheet_with_all_there_is() -> None:
    options = ("--side-columns", "--graphs-27-30", "--form", "2")
    assert run("lint", EX1, "--structure", *options).exit_code == 0
    assert run("structure", EX1, *options, "--paper", "A1:portrait").exit_code == 0


# Config file -------------------------------------------------------------------------------------


@pytest.mark.usefixtures("russian")
def test_options_outrank_the_problem_and_the_problem_outranks_the_config() -> None:
    text = Path(EX1).read_text("utf-8").replace("[stamp]\n", '[stamp]\nauthor = "Задачин"\n', 1)
    text = text.replace("[sheet]\n", '[sheet]\npaper = "A1"\n')
    Path("mine.toml").write_text(text, "utf-8")
    name = config(
        '[stamp]\nauthor = "Настройкин"\nchecker = "Проверкин"\ntitle = "Общее"\n'
        '[sheet]\npaper = "A2"\nside_columns = true\n'
    )

    def shown(*args: str) -> str:
        assert run("sheet", "mine.toml", "--format", "svg", *args).exit_code == 0
        return Path("out/mine.svg").read_text("utf-8")

    bare = shown()
    assert "Задачин" in bare
    assert "Проверкин" not in bare
    with_config = shown("--config", name)
    assert "Задачин" in with_config
    assert "Проверкин" in with_config
    assert "Настройкин" not in with_config
    assert "Общее" not in with_config  # the problem has a title
    assert 'width="841mm"' in with_config
    assert "Инв. № подл." in with_config
    asked = ("--stamp", "author=Опциев", "--paper", "A3x3", "--no-side-columns")
    with_options = shown("--config", name, *asked)
    assert "Опциев" in with_options
    assert "Задачин" not in with_options
    assert 'width="891mm"' in with_options
    assert "Инв. № подл." not in with_options


def test_the_language_of_the_config_of_the_problem_and_of_the_option(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.delenv("PLANMETHOD_LANG")
    monkeypatch.setenv("LC_ALL", "ru_RU.UTF-8")
    name, mine = config('[sheet]\nlang = "en"\n'), Path(EX1).read_text("utf-8")
    assert "План скоростей" in drawn()
    assert "Velocity plan" in drawn("--config", name)
    assert "План скоростей" in drawn("--config", name, "--lang", "ru")
    Path("ex1.toml").write_text(mine.replace("[sheet]\n", '[sheet]\nlang = "ru"\n'), "utf-8")
    done = run("sheet", "ex1.toml", "--config", name, "--format", "svg")
    assert done.exit_code == 0
    assert "План скоростей" in Path("out/ex1.svg").read_text("utf-8")


def test_texts_have_the_language_of_their_sheets() -> None:
    name = config('[sheet]\nlang = "en"\n')
    structure = run("structure", EX1, "--config", name)
    assert "Kinematic pairs" in structure.output
    assert "Structural formulas" in Path("out/ex1-structure.svg").read_text("utf-8")
    three = ("--phi", "30,60,90")
    assert "short segments" in run("lint", EX1, *three, "--config", name, "--json").output
    assert "замечан" in run("lint", EX1, "--structure", "--config", name, "--lang", "ru").output
    for command in (("layouts",), ("layouts", "homework"), ("new", "--list")):
        english = run(*command, "--lang", "en")
        assert english.exit_code == 0
        assert not re.search("[а-яё]", english.output, re.IGNORECASE)


def test_the_config_of_the_environment(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLANMETHOD_CONFIG", config('[stamp]\nauthor = "Настройкин"\n'))
    assert "Настройкин" in drawn()
    assert "Настройкин" not in drawn("--no-config")
    other = config('[stamp]\nauthor = "Другой"\n', "other.toml")
    assert "Другой" in drawn("--config", other)
    done = run("structure", EX1)
    assert "Настройкин" in Path("out/ex1-structure.svg").read_text("utf-8")
    assert done.exit_code == 0


@pytest.mark.parametrize("folder", ["docs", "docs/ru"])
def test_the_files_of_the_page_on_the_title_block(folder: str) -> None:
    page = (ROOT / folder / "how-to" / "title-block.md").read_text("utf-8")
    names = re.findall(r'(?m)^```toml title="(.*)"$', page)
    assert names == ["config.toml", "my.toml"]
    settings, title = re.findall(r"(?ms)^```toml title.*?\n(.*?)^```$", page)
    bare = Path(EX1).read_text("utf-8").partition("[stamp]")[0]
    Path("my.toml").write_text(bare + title, encoding="utf-8")
    options = ("--config", config(settings), "--format", "svg")
    titles = {"ru": "Кинематический анализ механизма", "en": "Kinematic analysis of a mechanism"}
    for lang, said in titles.items():
        assert run("sheet", "my.toml", *options, "--lang", lang).exit_code == 0
        sheet = Path("out/my.svg").read_text("utf-8")
        for text in (said, "СПбПУ", "3331504", "Иванов", "Петров"):
            assert text in sheet


def test_an_option_clears_a_field(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLANMETHOD_CONFIG", config('[stamp]\nauthor = "Настройкин"\n'))
    assert "Настройкин" not in drawn("--stamp", "author=")


def test_a_faulty_config_is_reported_once_and_no_sheet_is_drawn() -> None:
    name = config("[stamp]\nautor = 'x'\n[sheet]\nform = '7'\n")
    refused = run("sheet", EX1, EX2, "--config", name)
    assert refused.exit_code == 2
    assert refused.output.count("in the config file") == 1
    assert "stamp.autor: unknown key. Did you mean 'author'?" in refused.output
    assert "sheet.form: expected one of" in refused.output
    assert not Path("out").exists()
    assert run("sheet", EX1, "--config", name, "--no-config").exit_code == 2


def test_a_command_without_drawings_reads_no_config(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PLANMETHOD_CONFIG", "no-such-file.toml")
    assert run("structure", EX1, "--no-drawing").exit_code == 0
    assert run("solve", EX1).exit_code == 0
    assert run("sheet", EX1).exit_code == 2


# Several sheets ----------------------------------------------------------------------------------


def sizes(pdf: Path) -> list[tuple[int, int]]:
    """Return the sizes of the pages of a PDF, mm."""
    boxes = re.findall(rb"/MediaBox \[ ?([\d. ]+?) ?\]", pdf.read_bytes())
    return [
        (round(float(w) * 25.4 / 72), round(float(h) * 25.4 / 72))
        for w, h in (box.split()[2:] for box in boxes)
    ]


def pages(pdf: Path) -> list[str]:
    if shutil.which("pdftotext") is None:
        pytest.skip("needs pdftotext")
    command = ["pdftotext", "-layout", "-enc", "UTF-8", str(pdf), "-"]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", check=True)
    return done.stdout.split("\f")[:-1]


def numbers(page: str) -> tuple[str, ...]:
    found = re.search(r"Лист +(\d*) *Листов *(\d*)", page)
    assert found is not None
    return found.groups()


@pytest.mark.usefixtures("russian")
def test_several_sheets_are_pages_of_one_pdf() -> None:
    done = run("sheet", EX2, "--phi", "0:360:27", "--format", "svg,pdf,dxf")
    assert done.exit_code == 0
    names = sorted(path.name for path in Path("out").iterdir())
    assert names == ["ex2-2.dxf", "ex2-2.svg", "ex2.dxf", "ex2.pdf", "ex2.svg"]
    told = pages(Path("out/ex2.pdf"))
    assert len(told) == len(sizes(Path("out/ex2.pdf"))) == 2
    assert [numbers(page) for page in told] == [("1", "2"), ("2", "")]
    for page in told:
        assert "Планы скоростей" in page


def test_a_dxf_beside_a_pdf_has_its_numbers_and_alone_those_of_a_cad_program() -> None:
    def written(folder: str, *options: str) -> bytes:
        assert run("sheet", EX1, *options, "-o", folder).exit_code == 0
        return (Path(folder) / "ex1.dxf").read_bytes()

    beside, alone = written("a", "--format", "pdf,dxf"), written("b", "--format", "dxf")
    assert beside == written("c", "--format", "dxf", "--profile", "board")
    assert alone == written("d", "--format", "dxf", "--profile", "cad") != beside


@pytest.mark.usefixtures("russian")
def test_a_set_of_problems_in_one_file() -> None:
    args = ("sheet", EX1, EX3, "--format", "svg,pdf", "--one-file", "set.pdf")
    done = run(*args, "--form", "1+2a")
    assert done.exit_code == 0, done.output
    assert sorted(path.name for path in Path("out").iterdir()) == ["ex1.svg", "ex3.svg", "set.pdf"]
    assert sizes(Path("out/set.pdf")) == [
        (FORMATS[name].width, FORMATS[name].height) for name in ("A3", "A2")
    ]
    first, second = pages(Path("out/set.pdf"))
    assert numbers(first) == ("1", "2")
    assert "Листов" not in second  # form 2a
    assert "Листов" not in Path("out/ex3.svg").read_text("utf-8")
    before = Path("out/set.pdf").read_bytes()
    assert run(*args, "--form", "1+2a").exit_code == 0
    assert Path("out/set.pdf").read_bytes() == before
    assert "Helvetica" not in before.decode("latin-1")


@pytest.mark.usefixtures("russian")
def test_variants_in_one_file_are_numbered_through() -> None:
    done = run("sheet", VARIANTS, "--all-variants", "--format", "pdf", "--one-file", "all.pdf")
    assert done.exit_code == 0, done.output
    assert [path.name for path in Path("out").iterdir()] == ["all.pdf"]
    told = [numbers(page) for page in pages(Path("out/all.pdf"))]
    assert told[0] == ("1", "6")
    assert told[1:] == [(str(k), "") for k in range(2, 7)]


def test_a_single_problem_in_one_file_is_no_set() -> None:
    assert run("sheet", EX1, "--format", "pdf", "--one-file", "one.pdf").exit_code == 0
    run("sheet", EX1, "--format", "pdf")
    assert Path("out/one.pdf").read_bytes() == Path("out/ex1.pdf").read_bytes()


def test_a_faulty_problem_is_left_out_of_the_set() -> None:
    done = run("sheet", "none.toml", EX1, EX2, "--format", "pdf", "--one-file", "set.pdf")
    assert done.exit_code == 3
    assert len(sizes(Path("out/set.pdf"))) == 2


def test_the_name_of_the_set_ends_in_pdf() -> None:
    refused = run("sheet", EX1, "--one-file", "set.svg")
    assert refused.exit_code == 2
    assert "'set.svg' does not end in .pdf" in refused.output
