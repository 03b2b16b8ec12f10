"""The documents are right: commands run, examples load, links have targets."""

from __future__ import annotations

import ast
import doctest
import json
import re
import shlex
import shutil
import sys
import tomllib
from pathlib import Path
from pkgutil import resolve_name
from types import ModuleType, SimpleNamespace
from typing import cast

import click
import matplotlib
import pytest
from cases import each, sampled, some
from click.testing import CliRunner
from doors import (
    COMMANDS as NAMES,
    Document,
    Drawing,
    ExitCode,
    Solution,
    cli,
    command_of,
)
from matplotlib.figure import Figure
from worked import PROBLEMS, ROOT

import planmethod
from scripts import examples, gallery

READMES = ("README.md", "README.ru.md")
COMMANDS = ("docs/reference/commands.md", "docs/ru/reference/commands.md")
PAGES = sorted(
    path.relative_to(ROOT).as_posix() for path in (ROOT / "docs" / "ru").rglob("*.md")
)
ADRS = sorted((ROOT / "docs" / "adr").glob("[0-9]*.md"))
DOCUMENTS = sorted(
    [
        *ROOT.glob("*.md"),
        *(ROOT / "docs").rglob("*.md"),
        *(ROOT / "benchmarks" / "reports").glob("*.md"),
        ROOT / "out" / "README.md",
    ]
)
DEVELOPMENT = [
    ROOT / name for name in ("CONTRIBUTING.md", "docs/architecture.md", "docs/extending.md")
]
"""Pages for developers."""
PICTURES = sorted((ROOT / "docs" / "gallery").glob("*"))
LARGEST = 150 * 1024
"""Bytes of a picture of the documentation."""


def text_of(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8")


def blocks(name: str, language: str) -> list[str]:
    """Return the fenced blocks of a language."""
    return re.findall(rf"(?ms)^```{language}\n(.*?)^```$", text_of(name))


def command_lines(name: str) -> list[list[str]]:
    """Return the words of every line of the shell blocks."""
    lines = "\n".join(blocks(name, "sh")).splitlines()
    return [words for line in lines if (words := shlex.split(line, comments=True))]


def planmethod_lines(name: str) -> list[list[str]]:
    return [words[1:] for words in command_lines(name) if words[0] == "planmethod" and words[1:]]


def first_cells(name: str, pattern: str) -> list[str]:
    """Return the matches of a pattern in the first cells of table rows."""
    return re.findall(rf"(?m)^\| {pattern} \|", text_of(name))


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Provide a folder with the problems of the repository only."""
    shutil.copytree(PROBLEMS, tmp_path / "problems")
    monkeypatch.chdir(tmp_path)
    return tmp_path


# Commands ----------------------------------------------------------------------------------------


@pytest.mark.dear
def test_the_tour_works_from_the_first_command_to_the_last(desk: Path) -> None:
    """In one language; the other has the same commands. Large sheets only with --thorough."""
    lines = [words for words in planmethod_lines(COMMANDS[0]) if words[0] != "studio"]  # it serves
    large = [words for words in lines if {"--layout", "--jobs", "animate", "batch"} & {*words}]
    large += [words for words in lines if re.search("meshing|cams", " ".join(words))]
    for words in lines if some(1, few=0) else [line for line in lines if line not in large]:
        run = CliRunner().invoke(cli, words)
        assert run.exit_code == ExitCode.DONE, (words, run.output)
    made = {path.name for path in (desk / "out").rglob("*") if path.is_file()}
    assert {"my.svg", "my.pdf", "my-protocol.txt", "my-structure.svg", "ex3.csv"} <= made
    assert {f"task12-variants-{letter}.pdf" for letter in "АБВГДЕ"} <= made


@each("name", [*READMES, *COMMANDS, *PAGES, "CONTRIBUTING.md"])
def test_every_command_line_parses(name: str) -> None:
    cells = re.findall(r"(?m)^\| [^|]+ \| `planmethod ([a-z]+ [^`]+)` \|", text_of(name))
    for command, *rest in [*planmethod_lines(name), *map(shlex.split, cells)]:
        command_of(command).make_context(command, rest)


@pytest.mark.parametrize("name", COMMANDS)
def test_every_command_is_listed_and_shown(name: str) -> None:
    assert sorted(first_cells(name, "`([a-z]+)`")) == sorted(NAMES)
    assert {words[0] for words in planmethod_lines(name)} == set(NAMES)


@pytest.mark.parametrize("name", COMMANDS)
def test_exit_codes_are_listed(name: str) -> None:
    assert first_cells(name, r"(\d)") == [str(int(code)) for code in ExitCode]


@each("name", [*READMES, *COMMANDS, *PAGES, "CONTRIBUTING.md"])
def test_options_that_the_text_speaks_of_exist(name: str) -> None:
    known = {
        option
        for command in map(command_of, NAMES)
        for param in command.params
        if isinstance(param, click.Option)
        for option in (*param.opts, *param.secondary_opts)
    }
    spans = re.findall(r"`(--[a-z-]+)", text_of(name))
    assert set(spans) - {"--help"} <= known


@each("document", DOCUMENTS)
def test_make_knows_the_targets(document: Path) -> None:
    targets = set(re.findall(r"(?m)^([a-z-]+):", text_of("Makefile")))
    assert set(re.findall(r"(?m)(?:`|^)make ([a-z-]+)", document.read_text("utf-8"))) <= targets


# Examples ----------------------------------------------------------------------------------------


@pytest.mark.parametrize("name", COMMANDS)
def test_python_examples_run(name: str, desk: Path, capsys: pytest.CaptureFixture[str]) -> None:
    names: dict[str, object] = {}
    for block in blocks(name, "python"):
        exec(compile(block, name, "exec"), names)
    pdf = names["pdf"]
    assert isinstance(pdf, bytes)
    assert pdf.startswith(b"%PDF-")
    assert "275°: 16.021" in capsys.readouterr().out


@pytest.mark.parametrize("name", ("docs/explanation/how-it-works.md", "docs/ru/explanation/how-it-works.md"))
def test_the_page_on_how_it_works_is_right(name: str, desk: Path) -> None:
    pytest.importorskip("mpmath")
    text = "\n".join(blocks(name, "pycon"))
    test = doctest.DocTestParser().get_doctest(text, {}, name, name, 0)
    failed, tried = doctest.DocTestRunner().run(test)
    assert tried > 10
    assert not failed


@pytest.mark.parametrize("name", re.findall(r"(?m)^::: (.*)$", text_of("docs/reference/api.md")))
def test_examples_of_docstrings_run(name: str, desk: Path) -> None:
    thing = resolve_name(name)
    shown = dict(vars(sys.modules[thing.__module__]))
    (test,) = doctest.DocTestFinder(recurse=False).find(thing, name, globs=shown)
    failed, tried = doctest.DocTestRunner().run(test)
    assert tried > 1
    assert not failed


def test_every_public_name_is_on_the_page_of_the_interface() -> None:
    rows = re.findall(r"(?m)^\| (`\w+`.*) \|$", text_of("docs/reference/api.md").partition("**Errors")[0])
    named = set(re.findall(r"`(\w+)`", " ".join(rows)))
    assert set(planmethod.__all__) <= named


def test_the_notebook_of_a_lecture_runs(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Run without Jupyter: the last expression of a cell is shown as it would be there."""
    matplotlib.use("agg")
    moved: list[Drawing] = []
    widgets = SimpleNamespace(
        IntSlider=lambda **options: options["value"],
        interact=lambda draw, **names: moved.append(draw(**names)),
    )
    monkeypatch.setitem(sys.modules, "ipywidgets", cast("ModuleType", widgets))
    names: dict[str, object] = {}
    shown: list[object] = []
    for cell in json.loads(text_of("examples/lecture.ipynb"))["cells"]:
        if cell["cell_type"] != "code":
            continue
        tree = ast.parse("".join(cell["source"]))
        last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
        exec(compile(tree, "lecture", "exec"), names)
        if isinstance(last, ast.Expr):
            shown.append(eval(compile(ast.Expression(last.value), "lecture", "eval"), names))
    solution, sheet, _, told, figure = shown
    assert isinstance(solution, Solution)
    assert "15.53" in solution._repr_html_().replace(",", ".")
    assert isinstance(sheet, Drawing)
    assert sheet._repr_svg_().startswith("<?xml")
    assert isinstance(told, Document)
    assert told._repr_html_().count("<li") > 20
    assert isinstance(figure, Figure)
    assert [one.width for one in moved] == [sheet.width]


@each("page", examples.pages())
def test_printed_examples_are_those_of_today(page: Path) -> None:
    """If not, ``make examples`` updates them."""
    assert examples.filled(page.read_text("utf-8")) == page.read_text("utf-8")


@pytest.mark.parametrize("name", READMES)
def test_the_example_of_the_readme_prints_what_is_shown(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A line of three dots replaces lines that are not shown."""
    (text,) = blocks(name, "toml")
    (tmp_path / "crank.toml").write_text(text, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    (session,) = blocks(name, "console")
    steps = re.findall(r"(?m)^\$ planmethod (.*)\n((?:(?!\$).*\n)+)", session)
    assert len(steps) == session.count("$ ") == 2
    for command, shown in steps:
        run = CliRunner().invoke(cli, shlex.split(command))
        assert run.exit_code == ExitCode.DONE
        same = doctest.OutputChecker().check_output(shown, run.output, doctest.ELLIPSIS)
        assert same, (command, run.output)


def code_of(block: str) -> str:
    """Return the statements of an example without its prints, which depend on the language."""
    kept = [s for s in ast.parse(block).body if "print(" not in ast.unparse(s)]
    return "\n".join(map(ast.unparse, kept))


@pytest.mark.parametrize("names", [READMES, COMMANDS], ids=str)
def test_both_languages_show_the_same(names: tuple[str, str]) -> None:
    one, other = names
    assert command_lines(one) == command_lines(other)
    for mine, theirs in zip(blocks(one, "toml"), blocks(other, "toml"), strict=True):
        assert tomllib.loads(mine) == tomllib.loads(theirs)
    for mine, theirs in zip(blocks(one, "python"), blocks(other, "python"), strict=True):
        assert code_of(mine) == code_of(theirs)
    counts = {len(re.findall(r"(?m)^##+ ", text_of(name))) for name in names}
    assert len(counts) == 1


@each("name", sampled([name for name in PAGES if name not in COMMANDS], 4))
def test_the_russian_pages_work(name: str, tmp_path: Path) -> None:
    """Their files are read, their commands run, in order; sheets only with --thorough.

    A block of a file without a title continues the one before.
    """
    folder = tmp_path / Path(name).stem
    shutil.copytree(PROBLEMS / "linkages", folder / "problems" / "linkages")
    quick = ("solve", "protocol", "layouts", "sketch", "teeth", "live", "structure", "new")
    mine = folder / "my.toml"
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        for language, text in re.findall(r"(?ms)^```(\w+)\n(.*?)^```$", text_of(name)):
            lines = []
            if language == "toml" and "[[blocks]]" in text:
                (folder / "own.toml").write_text(text, encoding="utf-8")
                lines = [["sheet", "problems/linkages/ex3.toml", "--layout", "own.toml"]]
            elif language == "toml":
                before = "" if "title" in tomllib.loads(text) else mine.read_text("utf-8") + "\n"
                mine.write_text(before + text, encoding="utf-8")
                lines = [["solve", "my.toml"]]
            elif language == "csv":
                (folder / "my.csv").write_text(text, encoding="utf-8")
            elif language == "sh":
                lines = [shlex.split(line, comments=True)[1:] for line in text.splitlines()]
            for words in lines:
                if words[0] in quick or some(1, few=0):
                    run = CliRunner().invoke(cli, ["--lang", "ru", *words])
                    found = words[0] in ("check", "lint")  # the numbers of the page are a student's
                    assert run.exit_code in (0, found), (words, run.output)


# Links and names ---------------------------------------------------------------------------------


def anchors(document: Path) -> set[str]:
    """Return the anchors of a document's headings, as GitHub makes them."""
    titles = re.findall(r"(?m)^#+ (.*)$", document.read_text(encoding="utf-8"))
    return {re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-") for title in titles}


@each("document", DOCUMENTS)
def test_links_lead_to_files(document: Path) -> None:
    text = re.sub(r"(?ms)^```.*?^```$|`[^`\n]*`", "", document.read_text(encoding="utf-8"))
    for link in re.findall(r"\]\(([^)\s]+)\)", text):
        if re.match(r"https?://", link):
            continue
        path, _, anchor = link.partition("#")
        target = document.parent / path if path else document
        assert target.exists(), link
        assert target.resolve().is_relative_to(ROOT), link
        assert not anchor or anchor in anchors(target), link


@each("document", DOCUMENTS)
def test_files_that_the_text_speaks_of_exist(document: Path) -> None:
    text = document.read_text(encoding="utf-8")
    folders = ("planmethod", "benchmarks", "tests", "docs", "problems")
    packages = ("construct", "mechanism", "problem", "plans", "note", "render")
    for span in re.findall(r"`([\w.-]+/[\w./-]*)`", text):
        top = span.split("/")[0]
        if top in folders:
            assert (ROOT / span).exists(), span
        elif top in packages:
            assert (ROOT / "planmethod" / span).exists(), span


def test_every_promise_has_a_test() -> None:
    """The tests that docs/explanation/security.md names in the last cell of a row exist."""
    page = (ROOT / "docs/explanation/security.md").read_text("utf-8")
    table = page.partition("## What is promised")[2].partition("\n## ")[0]
    rows = [line for line in table.splitlines() if line.startswith("| ")][2:]
    assert len(rows) > 20
    for row in rows:
        file, found = "", []
        for told, name in re.findall(r"`(tests/[\w/]+\.py)?::(\w+)`", row.rpartition(" | ")[2]):
            file = told or file
            found.append(f"def {name}(" in (ROOT / file).read_text("utf-8"))
        assert found and all(found), row


@pytest.fixture(scope="module")
def words_of_the_code() -> set[str]:
    """Return all words of the code and its catalogues, and the names of its files."""
    folders = [ROOT / name for name in ("planmethod", "benchmarks", "scripts", "tests")]
    paths = [path for folder in folders for path in folder.rglob("*.*")]
    texts = [path for path in paths if path.suffix in (".py", ".toml")]
    texts += [ROOT / "Makefile", ROOT / "pyproject.toml"]
    found = {word for path in texts for word in re.findall(r"\w+", path.read_text("utf-8"))}
    return found.union(*(re.findall(r"\w+", path.name) for path in paths))


@each("document", [*DEVELOPMENT, *ADRS])
def test_names_that_the_text_speaks_of_exist(document: Path, words_of_the_code: set[str]) -> None:
    text = re.sub(r"(?ms)^```.*?^```$", "", document.read_text("utf-8"))
    names = {word for span in re.findall(r"`([^`\n]+)`", text) for word in re.findall(r"\w+", span)}
    names = {word for word in names if not word.isdecimal() and not word.endswith("_")}
    assert names <= words_of_the_code, sorted(names - words_of_the_code)


def test_the_packages_are_in_the_order_of_the_linter() -> None:
    contracts = tomllib.loads(text_of("pyproject.toml"))["tool"]["importlinter"]["contracts"]
    rows = first_cells("docs/architecture.md", r"`((?:benchmarks|planmethod)/[\w./]*)`")
    said = [row.rstrip("/").removesuffix(".py").replace("/", ".") for row in rows]
    assert said == contracts[0]["layers"]
    folders = {path.parent.name for path in (ROOT / "planmethod").glob("*/__init__.py")}
    assert {f"planmethod.{name}" for name in folders} <= {*said}


# Records -----------------------------------------------------------------------------------------


def test_decisions_are_numbered_and_listed() -> None:
    numbers = [path.name[:4] for path in ADRS]
    assert len(set(numbers)) == len(numbers)  # those of records that are gone are not used again
    listed = re.findall(r"\((\d{4}-[\w-]+\.md)\) \| (.+) \|", text_of("docs/adr/README.md"))
    titles = [path.read_text("utf-8").splitlines()[0].split(". ", 1)[1] for path in ADRS]
    assert listed == [(path.name, title) for path, title in zip(ADRS, titles, strict=True)]


@each("path", ADRS)
def test_a_decision_has_its_parts(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert text.startswith(f"# {path.name[:4]}. ")
    assert re.findall(r"(?m)^## (.*)$", text) == ["Context", "Decision", "Consequences"]


def test_the_changelog_has_its_form() -> None:
    text = text_of("CHANGELOG.md")
    sections = ("Added", "Changed", "Deprecated", "Removed", "Fixed", "Security")
    assert re.findall(r"(?m)^## (.*)$", text)[0] == "[Unreleased]"
    assert set(re.findall(r"(?m)^### (.*)$", text)) <= set(sections)


def test_pictures_are_small_and_made_by_make() -> None:
    assert PICTURES
    assert sorted(one.name for one in gallery.PICTURES) == [path.stem for path in PICTURES]
    for path in PICTURES:
        data = path.read_bytes()
        assert data.startswith(b"\x89PNG")
        assert len(data) < LARGEST, path.name
