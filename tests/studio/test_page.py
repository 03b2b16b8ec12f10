"""The ways of a student and of an instructor through the studio, in headless Chromium."""

from __future__ import annotations

import base64
import json
import re
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from browser import PROGRAM, Page, browsing
from doors import Solution
from studying import DRAWN, at, begin, click, come_in, fetched, studio, take, text, works
from waiting import wait_until
from worked import PROBLEMS, path_of, problem_of

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("uvicorn", reason="the studio's extra is not installed")
pytestmark = pytest.mark.skipif(PROGRAM is None, reason="Chromium looks at the page")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with studio() as (address,):
        yield address


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as page:
        yield page


def test_a_student_comes_from_an_empty_page_to_a_pdf(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    assert "Замечаний нет" in text(page, "#faults")
    at(page, "DE = 0.18", "DE = 0.18 m")
    page.wait("document.querySelector('.cm-lintRange-error')")
    assert text(page, "#faults").count("строка 23") == 1
    # the scheme of before is still there, as an old one
    assert page.ask("document.querySelector('#sketch').naturalWidth") > 0
    assert page.ask("document.querySelector('#scheme').classList.contains('old')")
    assert page.ask("studio.text().split('\\n')[22]") == "DE = 0.18 m"
    at(page, "DE = 0.18 m", "DE = 0.18")
    page.wait("document.querySelector('#faults').textContent.includes('Замечаний нет')")
    assert not page.ask("!!document.querySelector('.cm-lintRange-error')")
    click(page, "#to-files")
    click(page, "#files [data-what=pdf]")
    link = page.wait("document.querySelector('#files .made a')?.href")
    assert fetched(page, link).startswith(b"%PDF-")
    # the typed text is there when the page is opened again
    page.ask("studio.put(studio.text() + '# kept\\n')")
    page.open(f"{address}?lang=en", width=1360)
    page.wait(DRAWN)
    assert str(page.ask("studio.text()")).endswith("# kept\n")
    # Chromium itself gives letters that replace coloured ones a style, which the policy takes away.
    assert [one for one in page.said if "Applying inline style" not in one] == []


def test_keys_are_completed_from_the_schema(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    page.ask("studio.put('[driver]\\n')")
    page.ask("studio.typed.view.dispatch({ selection: { anchor: 9 } }); studio.typed.view.focus()")
    page.call("Input.insertText", text="om")
    page.wait("document.querySelector('.cm-tooltip-autocomplete')")
    assert "omega" in text(page, ".cm-tooltip-autocomplete")
    page.wait("document.querySelector('.cm-completionInfo')")
    assert text(page, ".cm-completionInfo") == (
        "Угловая скорость, 1/с; против часовой стрелки положительная."
    )


def test_the_other_assembly_is_chosen_by_a_click(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-assemblies")
    page.wait("document.querySelectorAll('#ways button').length === 2")
    click(page, "#ways button:nth-child(2)")
    page.wait(DRAWN)
    assert 'E = "left of D"' in page.ask("studio.text()")
    assert page.ask("studio.text()").count("[assembly]") == 1


def test_a_segment_is_measured_in_mm_and_in_its_unit(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-sheets")
    page.wait("document.querySelector('#sheet img')?.naturalWidth > 0")
    page.ask(
        "{ const all = document.querySelector('#spans');"
        " all.value = [...all.options].find(one => /^pb₁ +μ_v/.test(one.text)).value;"
        " all.dispatchEvent(new Event('change')); }"
    )
    assert re.search(r"= 64 мм × μv 0,05 = 3,2 м/с$", text(page, "#measured"))
    # the same by two clicks near its ends
    ends = page.ask(
        "[...document.querySelectorAll('#sheet circle')].map(one => {"
        " const box = one.getBoundingClientRect();"
        " return [box.x + box.width / 2 + 2, box.y + box.height / 2 - 2]; })"
    )
    click(page, "#ruler")
    for x, y in ends:
        page.ask(
            "document.querySelector('#sheet').dispatchEvent(new MouseEvent('click',"
            f" {{ clientX: {x}, clientY: {y}, bubbles: true }}))"
        )
    assert "64 мм × μv 0,05 = 3,2 м/с" in text(page, "#measured")


def test_on_a_segment_drawn_larger_than_its_plan_the_ruler_gives_the_value_of_the_vector(
    page: Page, address: str
) -> None:
    """Task 27: (de) has a scale of its own, ten times finer; its value is |v_D - v_E|."""
    points = Solution(problem_of("levers/task-27")).points
    exact = abs(complex(points["D"].velocity[0] - points["E"].velocity[0]))
    begin(page, address)
    take(page, "linkages-ex3")
    page.ask(f"studio.put({json.dumps(path_of('levers/task-27').read_text('utf-8'))})")
    page.wait("document.querySelector('#scheme').classList.contains('old')")
    page.wait(DRAWN)
    click(page, "#to-sheets")
    page.wait(
        "[...document.querySelector('#spans').options].some(one => /^de +μ_v/.test(one.text))"
    )
    page.ask(
        "{ const all = document.querySelector('#spans');"
        " all.value = [...all.options].find(one => /^de +μ_v/.test(one.text)).value;"
        " all.dispatchEvent(new Event('change')); }"
    )
    told = text(page, "#measured").replace("\u00a0", " ")
    found = re.search(r"([\d,]+) мм × μv ([\d,]+) = ([\d,]+) м/с$", told)
    assert found is not None, told
    mm, scale, value = (float(one.replace(",", ".")) for one in found.groups())
    assert value == pytest.approx(exact, abs=0.01 * scale + 0.5e-5)  # mm in hundredths
    assert mm * scale == pytest.approx(10.0 * value, rel=2e-3)


def test_positions_move_with_their_plans(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-motion")
    page.wait("document.querySelector('#motion iframe')")
    click(page, "#to-tables")
    page.wait("document.querySelector('#tables pre').textContent.includes('Масштабы')")
    assert page.said == []


def test_answers_are_compared_while_typing_and_judged(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-answers")
    click(page, "#ask")
    page.wait("document.querySelectorAll('#rows tr').length > 5")

    click(page, "#judge")
    assert text(page, "#answers .told") == "Пока не заполнен ни один ответ."

    def fill(name: str, value: str) -> None:
        page.ask(
            f"{{ const box = document.querySelector({name!r}); box.value = {value!r};"
            " box.dispatchEvent(new Event('input', { bubbles: true })); }"
        )

    fill("#scales label:nth-of-type(1) input", "0,05")
    fill("#rows tr:nth-child(1) td:nth-of-type(1) input", "64")
    fill("#rows tr:nth-child(1) td:nth-of-type(3) input", "3,3")
    assert "≠" in text(page, "#rows tr:nth-child(1)")
    fill("#rows tr:nth-child(1) td:nth-of-type(3) input", "3,2")
    assert "сходится" in text(page, "#rows tr:nth-child(1)")
    # in another unit the product is in that, and what is written is read in it
    page.ask(
        "{ const box = document.querySelector('#rows tr:nth-child(1) select');"
        " box.value = 'мм/с'; box.dispatchEvent(new Event('input', { bubbles: true })); }"
    )
    product = text(page, "#rows tr:nth-child(1) td:nth-of-type(2)")
    assert re.sub(r"\s", "", product) == "3200"
    assert "≠" in text(page, "#rows tr:nth-child(1)")
    fill("#rows tr:nth-child(1) td:nth-of-type(3) input", "3200")
    assert "сходится" in text(page, "#rows tr:nth-child(1)")
    click(page, "#judge")
    page.wait("document.querySelector('#verdicts iframe')")
    # a frame would be cut where a sheet of paper ends: its page is printed by itself
    page.call("Emulation.setEmulatedMedia", media="print")
    shown = "document.querySelector({!r}).checkVisibility()"
    assert page.ask(shown.format("#rows th")) and page.ask(shown.format("#verdicts .own"))
    assert not page.ask(shown.format("#verdicts iframe"))
    page.call("Emulation.setEmulatedMedia", media="")
    link = page.ask("document.querySelector('.own a + a').href")
    assert fetched(page, link).startswith(b"%PDF-")
    assert page.said == []


@pytest.mark.dear
def test_an_instructor_comes_from_a_table_to_marks(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3-variants")
    click(page, "#to-group")
    works(page, PROBLEMS / "groups/ex3.csv")
    click(page, "#check")
    page.wait("document.querySelectorAll('#marks tbody tr').length === 30")
    before = text(page, "#marks tbody tr")
    page.ask(
        "document.querySelector('#points').value = '0';"
        "document.querySelector('#by-hand button').click()"
    )
    page.wait(f"document.querySelector('#marks tbody tr').textContent !== {before!r}")
    for box in ("#statistics", "#page"):
        page.wait(f"document.querySelector('{box} iframe')")
    assert page.ask("document.querySelector('#page .own a:last-child').href").endswith(".pdf")
    # after undo by its button, the mark is as before
    click(page, "#entered button")
    page.wait(f"document.querySelector('#marks tbody tr').textContent === {before!r}")
    assert page.said == []


@pytest.mark.dear
def test_the_page_opens_of_a_student_with_points_in_the_name(
    page: Page, address: str, tmp_path: Path
) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-group")
    group = tmp_path / "group.csv"
    group.write_text("student;what;value\nПетров П.П.;v B;3,2\nab;v B;3,2\n", "utf-8")
    works(page, group)
    click(page, "#check")
    page.wait("document.querySelector('#page iframe')")
    assert page.ask("document.querySelector('#who').value") == "Петров П.П."
    link = page.ask("document.querySelector('#page .own a').href")
    assert "Петров П.П." in fetched(page, link).decode()
    assert page.said == []


@pytest.mark.dear
def test_variants_and_questions_are_made_and_downloaded_by_clicks(
    page: Page, address: str, tmp_path: Path
) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-group")
    page.ask("document.querySelector('#how-many').value = '3'")
    click(page, "#vary button")
    made = "[...document.querySelectorAll('#desk > .made a')].map(one => one.textContent)"
    page.wait(f"{made}.length > 1")
    assert "Подобрано вариантов: 3 из 3" in text(page, "#varied")
    assert page.ask(made)[1:] == ["linkages-ex3-moodle.xml", "linkages-ex3-variants.toml"]
    page.call("Browser.setDownloadBehavior", behavior="allow", downloadPath=str(tmp_path))
    for name, tells in (("moodle.xml", "<quiz>"), ("variants.toml", "[variants]")):
        click(page, f"#desk > .made a[href*='{name}']")
        written = tmp_path / f"linkages-ex3-{name}"
        wait_until(written.exists)
        assert tells in written.read_text("utf-8")
    # for a variant of theirs the key is a button, too
    click(page, "#key")
    page.wait(f"{made}.some(one => /key[.]pdf$/.test(one))")
    assert page.said == []


def test_an_address_opens_a_task_and_keeps_text_typed_since(page: Page, address: str) -> None:
    begin(page, address)
    page.open("about:blank")
    page.open(f"{address}?lang=en#task=linkages-ex3&view=sheets", width=1360)
    page.wait("document.querySelector('#sheet img')?.naturalWidth > 0")
    assert 'title = "Рычажный механизм"' in page.ask("studio.text()")
    assert "#" not in page.ask("location.href")
    page.ask("studio.put('# typed\\n')")
    page.leave("location.reload()")
    page.wait("!!globalThis.studio")
    assert page.ask("studio.text()") == "# typed\n"
    page.ask("location.hash = '#task=no-such-task'")
    page.wait("document.querySelector('#said').textContent.includes('The task no-such-task, or')")
    assert page.ask("studio.text()") == "# typed\n"


def test_tables_scroll_within_an_edge_of_their_own(page: Page, address: str) -> None:
    begin(page, address, 620)
    take(page, "linkages-ex3")
    click(page, "#to-answers")
    click(page, "#ask")
    page.wait("document.querySelectorAll('#rows tr').length > 5")
    wide, shown, edge = page.ask(
        "(box => [box.scrollWidth, box.clientWidth, getComputedStyle(box).borderRightWidth])"
        "(document.querySelector('#answering .wide'))"
    )
    assert wide > shown and edge == "1px"
    assert page.ask("document.documentElement.scrollWidth") <= 620
    heads = "document.querySelector('#rows th').getBoundingClientRect().x"
    before = page.ask(heads)
    page.ask("document.querySelector('#answering .wide').scrollTo(200, 0)")
    assert page.ask(heads) == pytest.approx(before, abs=2)  # the quantity stays in sight
    # indices are set below the line: v_B1
    assert page.ask("document.querySelector('#rows th sub').textContent") == "B1"


@pytest.mark.dear
@pytest.mark.skipif(shutil.which("pdfinfo") is None, reason="poppler reads the PDF")
def test_a_sheet_is_printed_on_one_page_across_in_light_colours(
    page: Page, address: str, tmp_path: Path
) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    page.ask("document.documentElement.dataset.theme = 'dark'")
    click(page, "#to-sheets")
    page.wait("document.querySelector('#sheet img')?.naturalWidth > 0")
    printed = tmp_path / "sheet.pdf"
    told = page.call("Page.printToPDF", preferCSSPageSize=True)
    printed.write_bytes(base64.b64decode(told["data"]))
    facts = subprocess.run(["pdfinfo", printed], capture_output=True, text=True).stdout
    assert re.search(r"Pages: +1\n", facts)
    wide, high = map(float, re.findall(r"Page size: +([\d.]+) x ([\d.]+)", facts)[0])
    assert wide > high
    page.call("Emulation.setEmulatedMedia", media="print")
    assert page.ask("getComputedStyle(document.body).color") == "rgb(21, 24, 29)"
    page.call("Emulation.setEmulatedMedia", media="")


@pytest.mark.dear
@pytest.mark.parametrize("width", [360, 1360])
def test_no_pane_is_wider_than_the_window(page: Page, address: str, width: int) -> None:
    begin(page, address, width)
    take(page, "linkages-ex3")
    for room in ("task", "work", "answers", "group"):
        click(page, f"#to-{room}")
        assert page.ask("document.documentElement.scrollWidth") <= width, room
    click(page, "#to-work")
    for view in ("scheme", "sheets", "files", "motion"):
        click(page, f"#to-{view}")
        assert page.ask("document.documentElement.scrollWidth") <= width, view


def test_everything_has_a_name_and_tabs_are_turned_by_arrows(page: Page, address: str) -> None:
    begin(page, address)
    nameless = page.ask(
        "[...document.querySelectorAll('button, input, select, img, iframe, progress')]"
        ".filter(one => !one.hidden && one.type !== 'file' && !one.textContent.trim()"
        " && !one.ariaLabel"
        " && !one.title && !one.labels?.length && one.alt === undefined).map(one => one.id)"
    )
    assert nameless == []
    page.ask("document.querySelector('#to-task').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight", code="ArrowRight")
    assert page.ask("document.activeElement.id") == "to-work"
    assert page.ask("document.querySelector('#work').hidden") is False


def test_a_file_is_saved_and_changes_by_another_editor_are_reported(
    page: Page, tmp_path: Path
) -> None:
    file = tmp_path / "my.toml"
    file.write_text("title = 'a'\n")
    with studio(str(file)) as (address,):
        come_in(page, address)
        page.open(f"{address}?lang=en", width=1000)
        page.wait("studio.text().includes('title')")
        at(page, "'a'", "'b'")
        click(page, "#save")
        page.wait("document.querySelector('#saved').textContent === 'Saved'")
        assert file.read_text() == "title = 'b'\n"
        at(page, "'b'", "'mine'")
        file.write_text("title = 'theirs'\n")
        click(page, "#save")
        page.wait("document.querySelectorAll('#said-do button').length === 2")
        assert file.read_text() == "title = 'theirs'\n"
        click(page, "#said-do button")
        page.wait("document.querySelector('#saved').textContent === 'Saved'")
        assert file.read_text() == "title = 'mine'\n"


def test_strangers_have_no_instructors_pages_without_the_token(page: Page) -> None:
    with studio("--serve", "--jobs", "2") as (address, instructors):
        page.open(f"{address}?lang=en", width=1000)
        page.ask("sessionStorage.clear(); localStorage.clear()")
        page.open(f"{address}?lang=en", width=1000)
        page.wait("!document.querySelector('#no-token').hidden")
        assert page.ask("document.querySelector('#desk').hidden")
        page.open("about:blank")
        page.open(instructors, width=1000)
        page.wait("document.querySelector('#works-of').textContent")
        assert not page.ask("document.querySelector('#desk').hidden")
        assert "token" not in page.ask("location.href")


# One text is not another -------------------------------------------------------------------------


def open_task(page: Page, name: str) -> None:
    """Take a task, or a template, by its address."""
    page.ask(f"location.hash = '#task=' + encodeURIComponent({name!r})")
    page.wait(f"document.querySelector('#name').value === {name!r}")
    page.wait(DRAWN)


def press(page: Page, key: str, modifiers: int, *, letter: str = "") -> None:
    """Press a key; ``letter``: its letter on the keyboard of another language."""
    for kind in ("rawKeyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key=letter or key, code=f"Key{key.upper()}",
                  windowsVirtualKeyCode=ord(key.upper()), modifiers=modifiers)  # fmt: skip


def undo(page: Page) -> None:
    page.ask("studio.typed.view.focus()")
    press(page, "z", 2)


def choose(page: Page, box: str, value: str) -> None:
    page.ask(
        f"{{ const box = document.querySelector({box!r}); box.value = {value!r};"
        " box.dispatchEvent(new Event('change', { bubbles: true })); }"
    )


def give(page: Page, box: str, *files: Path) -> None:
    """Choose files of this machine."""
    root = page.call("DOM.getDocument")["root"]["nodeId"]
    node = page.call("DOM.querySelector", nodeId=root, selector=box)["nodeId"]
    page.call("DOM.setFileInputFiles", nodeId=node, files=[str(file) for file in files])


def mouse(page: Page, place: list[float], clicks: int) -> None:
    for count in range(1, clicks + 1):
        for kind in ("mousePressed", "mouseReleased"):
            page.call("Input.dispatchMouseEvent", type=kind, x=place[0], y=place[1], button="left",
                      clickCount=count)  # fmt: skip


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("desk")


@pytest.fixture
def desk(page: Page, folder: Path, of_folder: str) -> Path:
    """Show a studio of a folder, with two files in it."""
    for path in folder.iterdir():
        path.unlink()
    for name in ("a", "b"):
        (folder / f"{name}.toml").write_text(f"title = '{name}'\n")
    come_in(page, of_folder)
    page.open("about:blank")
    page.open(f"{of_folder}?lang=en", width=1200)
    page.ask("localStorage.clear()")
    page.open(f"{of_folder}?lang=en", width=1200)
    page.wait("document.querySelectorAll('#tasks li').length > 3")
    page.said.clear()
    return folder


@pytest.fixture(scope="module")
def of_folder(folder: Path) -> Iterator[str]:
    with studio(str(folder)) as (address,):
        yield address


def open_file(page: Page, name: str) -> None:
    choose(page, "#folder", name)
    page.wait(f"studio.text() === \"title = '{name[0]}'\\n\"")


def test_undo_in_one_file_restores_no_text_of_another(page: Page, desk: Path) -> None:
    open_file(page, "a.toml")
    open_file(page, "b.toml")
    undo(page)
    press(page, "s", 2)
    page.wait("document.querySelector('#saved').textContent === 'Saved'")
    assert (desk / "b.toml").read_text() == "title = 'b'\n"
    # however another text comes in
    at(page, "'b'", "'own'")
    other = desk / "other.txt"
    other.write_text("title = 'uploaded'\n")
    ways: dict[str, Callable[[], object]] = {
        "title = 'a'\n": lambda: open_file(page, "a.toml"),
        "uploaded": lambda: give(page, "#opened", other),
        "Рычажный механизм": lambda: page.ask("location.hash = '#task=linkages-ex3'"),
        "ex3-variants": lambda: page.ask("location.hash = '#task=linkages-ex3-variants&variant=2'"),
        "[gears]": lambda: page.ask("location.hash = '#task=planetary-train'"),
    }
    for words, come in ways.items():
        come()
        page.wait(f"(studio.text() + document.querySelector('#name').value).includes({words!r})")
        before = page.ask("studio.text()")
        undo(page)
        assert page.ask("studio.text()") == page.ask("studio.typed.text()") == before
    # after reloading the page, undo restores the text before, with its history
    page.ask("studio.put('# typed\\n')")
    page.leave("location.reload()")
    page.wait("!!globalThis.studio")
    undo(page)
    assert page.ask("studio.text()") == "# typed\n"
    open_file(page, "b.toml")
    at(page, "'b'", "'mended'")
    open_file(page, "a.toml")
    click(page, "#said-do button")
    assert page.ask("studio.text()") == "title = 'mended'\n"
    assert text(page, "#saved") == "Not saved to the file"
    undo(page)
    assert page.ask("studio.text()") == "title = 'b'\n"
    press(page, "s", 2)
    page.wait("document.querySelector('#saved').textContent === 'Saved'")
    assert [(desk / f"{name}.toml").read_text()[9] for name in "ab"] == ["a", "b"]
    assert page.said == []


@pytest.mark.dear
def test_a_text_is_saved_to_its_own_file_or_the_user_is_asked(page: Page, desk: Path) -> None:
    def named(name: str) -> None:
        page.ask(
            f"{{ const box = document.querySelector('#name'); box.value = {name!r};"
            " box.dispatchEvent(new Event('input')); }"
        )

    def asked(words: str, answer: int) -> None:
        page.wait(f"document.querySelector('#said').textContent.includes({words!r})")
        page.ask(f"document.querySelectorAll('#said-do button')[{answer}].click()")

    open_file(page, "a.toml")
    at(page, "'a'", "'c'")
    named("b")
    press(page, "s", 2, letter="ы")
    asked("The page says b.toml, but the text came from a.toml", 1)
    asked("The file b.toml already exists", 1)  # that of the file is taken
    page.wait("studio.text() === \"title = 'b'\\n\"")
    assert [(desk / f"{name}.toml").read_text()[9] for name in "ab"] == ["a", "b"]
    named("new")
    click(page, "#save")
    asked("the text came from b.toml", 1)
    page.wait("JSON.parse(localStorage.getItem('planmethod.text')).file === 'new.toml'")
    assert (desk / "new.toml").read_text() == "title = 'b'\n"
    # an answer to a question about an earlier file does not apply to the present one
    (desk / "new.toml").write_text("title = 'theirs'\n")
    at(page, "'b'", "'mine'")
    click(page, "#save")
    page.wait("document.querySelectorAll('#said-do button').length === 2")
    page.ask("globalThis.late = [...document.querySelectorAll('#said-do button')]")
    open_file(page, "a.toml")
    page.ask("late.forEach(button => button.click())")
    assert page.ask("studio.text()") == "title = 'a'\n"
    # nor is one of a studio of another folder
    page.ask(
        "{ const kept = JSON.parse(localStorage.getItem('planmethod.text'));"
        " localStorage.setItem('planmethod.text', JSON.stringify({ ...kept, file: 'z.toml' })); }"
    )
    page.leave("location.reload()")
    page.wait("!!globalThis.studio")
    assert page.ask("document.querySelector('#save').hidden")
    assert {path.name: path.read_text()[9] for path in desk.iterdir()} == {
        "a.toml": "a", "b.toml": "b", "new.toml": "t",
    }  # fmt: skip


SHOWN = (
    "JSON.stringify([...document.querySelectorAll('#work *, #answers *, #group *')]"
    ".filter(one => !one.closest('#editor')).map(one => [one.tagName, one.id, one.hidden,"
    " [...one.childNodes].map(node => node.nodeType === 3 ? node.data.trim() : '').join(''),"
    " one.value, (one.src || '').replace(/blob:.*/, 'blob'), one.alt, one.className]))"
)
"""All that is shown of a task."""


def filled(page: Page, work: Path) -> None:
    """Have everything made of a linkage that a page makes."""
    for view, shown in (
        ("motion", "#motion iframe"), ("sheets", "#sheet img"), ("tables", "#tables pre"),
        ("protocol", "#playing iframe"), ("structure", "#structure pre"),
        ("assemblies", "#ways button"),
    ):  # fmt: skip
        click(page, f"#to-{view}")
        page.wait(
            f"(one => one && (one.childNodes.length || one.src))(document.querySelector({shown!r}))"
        )
    click(page, "#files [data-what=form]")
    page.wait("document.querySelector('#files .made a')")
    click(page, "#ask")
    page.wait("document.querySelector('#rows tr')")
    page.ask(
        "{ const box = document.querySelector('#rows td:nth-of-type(3) input'); box.value = '3,2';"
        " box.dispatchEvent(new Event('input')); }"
    )
    click(page, "#judge")
    page.wait("document.querySelector('#verdicts iframe')")
    give(page, "#chosen", work)
    page.wait("document.querySelector('#works li')")
    click(page, "#check")
    page.wait("document.querySelector('#statistics iframe')")
    click(page, "#key")
    page.wait("document.querySelector('#desk > .made a')")


@pytest.mark.dear
def test_results_of_a_task_are_not_shown_under_the_next_one(
    page: Page, address: str, tmp_path: Path
) -> None:
    whole = (PROBLEMS / "groups/ex3.csv").read_text("utf-8-sig").splitlines()
    work = tmp_path / "one.csv"
    work.write_text("\n".join(whole[:6]).replace("Абрамова Дарья", "Петров П.П."), "utf-8")
    begin(page, address)
    open_task(page, "moving-point")
    fresh = page.ask(SHOWN)
    open_task(page, "linkages-ex3-variants")
    filled(page, work)
    assert page.ask("!!document.querySelector('#page iframe')")  # also for a name with initials
    page.ask(
        "document.querySelector('#points').value = '0';"
        "document.querySelector('#by-hand button').click()"
    )
    page.wait("document.querySelector('#entered li')")
    open_task(page, "moving-point")
    assert page.ask(SHOWN) == fresh
    # nor that of a variant under another one
    open_task(page, "linkages-ex3-variants")
    page.wait("document.querySelectorAll('#variant option').length > 2")
    click(page, "#to-structure")
    page.wait("document.querySelector('#structure pre').textContent")
    choose(page, "#variant", "2")
    assert text(page, "#structure pre") == ""
    # works and points are there when their task is, and after the page was opened again
    page.leave("location.reload()")
    page.wait("document.querySelector('#works li')?.textContent === 'one.csv'")
    choose(page, "#variant", "")
    click(page, "#check")
    page.wait("document.querySelector('#marks tbody tr')")
    assert text(page, "#entered li").startswith("Петров П.П.")
    click(page, "#forget")
    page.wait("!document.querySelector('#works li')")
    assert page.said == []


def test_an_answer_that_comes_late_is_not_shown_under_the_next_task(
    page: Page, address: str
) -> None:
    begin(page, address)
    open_task(page, "linkages-ex3")
    page.ask(
        "globalThis.held = []; globalThis.real = fetch;"
        "globalThis.fetch = async (path, more) => {"
        " const answer = await real(path, more), body = await answer.clone().text();"
        " if (/api.do/.test(path)) await new Promise(done => held.push(done));"
        " return new Response(body, answer); }"
    )
    click(page, "#to-structure")
    page.ask("studio.put(studio.text().replace('DE = 0.18', 'DE = 0.19'))")
    page.wait("held.length === 2")
    page.ask("globalThis.fetch = real")
    open_task(page, "moving-point")
    seen = page.ask(SHOWN)
    page.ask("held.forEach(done => done()); setTimeout(() => { held = null; }, 200)")
    page.wait("held === null")
    assert page.ask(SHOWN) == seen
    assert page.said == []


def test_a_pane_names_results_that_a_kind_of_problem_does_not_have(
    page: Page, address: str
) -> None:
    begin(page, address, lang="en")
    open_task(page, "moving-point")
    for view, words in (
        ("structure", "This problem has no links and joints"),
        ("assemblies", "Only linkages have several assembly configurations."),
    ):
        click(page, f"#to-{view}")
        page.wait(f"document.querySelector('#{view} .told').textContent.startsWith({words!r})")
        assert not page.ask(f"!!document.querySelector('#{view} iframe, #{view} button')")
    click(page, "#files [data-what=project]")
    lacking = "Only a linkage has a project"
    page.wait(f"document.querySelector('#files .told').textContent.startsWith({lacking!r})")
    assert page.said == []


def test_a_double_click_takes_a_whole_number(page: Page, address: str) -> None:
    begin(page, address)
    page.ask(
        "studio.put('AB = 0.1\\nBC = [-12.5, 2.5e-3]\\n[links.12]\\nx = \"2*t-0.25\"\\nB3.x = 1')"
    )
    click(page, "#to-work")
    found = {}
    for words in ("0.1", "12.5", "2.5e-3", "links", "0.25", "AB"):
        for place in (0, len(words) - 1):
            box = page.ask(
                f"{{ const box = studio.typed.view.coordsAtPos(studio.text().indexOf({words!r}) + "
                f"{place}, 1); [box.left + 2, (box.top + box.bottom) / 2]; }}"
            )
            mouse(page, box, 2)
            found[words, place] = page.ask(
                "(({ from, to }) => studio.text().slice(from, to))"
                "(studio.typed.view.state.selection.main)"
            )
    assert {key: value for key, value in found.items() if value != key[0]} == {}
    page.call("Input.insertText", text="CD")
    assert page.ask("studio.text()").startswith("CD = 0.1\n")


def test_the_assemblies_that_a_file_leaves_open_are_offered(page: Page, address: str) -> None:
    begin(page, address)
    open_task(page, "RRR+RRP")
    rules = "[...document.querySelectorAll('#ways code')].map(one => one.textContent).join()"
    page.ask("studio.put(studio.text().replace(/^E = .*/m, ''))")
    page.wait(f'{rules} === \'E = "right of D",E = "left of D"\'')
    click(page, "#ways button:last-child")
    page.wait(
        "document.querySelector('#faults .good') && !document.querySelector('#scheme').hidden"
    )
    assert 'B = "above C"' in page.ask("studio.text()")
    assert 'E = "left of D"' in page.ask("studio.text()")
    # if no assembly is open, all of them are offered, and they follow the text as it is typed
    click(page, "#to-assemblies")
    page.wait(f'{rules}.includes(\'B = "above C"; E = "left of D"\')')
    page.ask("studio.put(studio.text().replace('AB = 0.28', 'AB = 0.9'))")
    page.wait("document.querySelector('#assemblies .told').textContent.includes('B')")
    assert page.ask(rules) == text(page, "#ways-told") == ""
