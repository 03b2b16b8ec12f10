"""The ways of a student and of an instructor through the studio, in headless Chromium."""

from __future__ import annotations

import base64
import re
import shutil
import subprocess
import urllib.request
from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import PROGRAM, Page, browsing
from studying import DRAWN, at, begin, click, studio, take, text, works
from waiting import wait_until
from worked import PROBLEMS

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
    click(page, "[data-what=pdf]")
    link = page.wait("document.querySelector('#files .made a')?.href")
    with urllib.request.urlopen(link) as answer:
        assert answer.read(5) == b"%PDF-"
    # what was typed is there when the page is opened again
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
    assert text(page, ".cm-completionInfo") == "Угловая скорость, 1/с."


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
        " all.value = [...all.options].find(one => /^p-?b +μ_v/.test(one.text)).value;"
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


def test_positions_move_with_their_plans(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-motion")
    page.wait("document.querySelector('#motion iframe')")
    click(page, "#to-tables")
    page.wait("document.querySelector('#tables pre').textContent.includes('Масштабы')")
    assert page.said == []


def test_answers_are_compared_while_one_types_and_judged(page: Page, address: str) -> None:
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
    click(page, "#judge")
    page.wait("document.querySelector('#verdicts iframe')")
    # a frame would be cut where a sheet of paper ends: its page is printed by itself
    page.call("Emulation.setEmulatedMedia", media="print")
    shown = "document.querySelector({!r}).checkVisibility()"
    assert page.ask(shown.format("#rows th")) and page.ask(shown.format("#verdicts .own"))
    assert not page.ask(shown.format("#verdicts iframe"))
    page.call("Emulation.setEmulatedMedia", media="")
    with urllib.request.urlopen(page.ask("document.querySelector('.own a + a').href")) as answer:
        assert answer.read(5) == b"%PDF-"
    assert page.said == []


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
    # taken back by its button, the mark is what it was
    click(page, "#entered button")
    page.wait(f"document.querySelector('#marks tbody tr').textContent === {before!r}")
    assert page.said == []


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
    with urllib.request.urlopen(page.ask("document.querySelector('#page .own a').href")) as answer:
        assert "Петров П.П." in answer.read().decode()
    assert page.said == []


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


def test_an_address_opens_a_task_and_replaces_nothing_typed_since(page: Page, address: str) -> None:
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
    page.wait("document.querySelector('#said').textContent.includes('no task no-such-task')")
    assert page.ask("studio.text()") == "# typed\n"


def test_tables_scroll_within_an_edge_of_their_own(page: Page, address: str) -> None:
    begin(page, address, 360)
    take(page, "linkages-ex3")
    click(page, "#to-answers")
    click(page, "#ask")
    page.wait("document.querySelectorAll('#rows tr').length > 5")
    wide, shown, edge = page.ask(
        "(box => [box.scrollWidth, box.clientWidth, getComputedStyle(box).borderRightWidth])"
        "(document.querySelector('#answering .wide'))"
    )
    assert wide > shown and edge == "1px"
    assert page.ask("document.documentElement.scrollWidth") <= 360
    heads = "document.querySelector('#rows th').getBoundingClientRect().x"
    before = page.ask(heads)
    page.ask("document.querySelector('#answering .wide').scrollTo(200, 0)")
    assert page.ask(heads) == pytest.approx(before, abs=2)  # the quantity stays in sight
    # indices stand below: v_B1
    assert page.ask("document.querySelector('#rows th sub').textContent") == "B1"


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


@pytest.mark.parametrize("width", [360, 1360])
def test_no_room_is_wider_than_the_window(page: Page, address: str, width: int) -> None:
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


def test_a_file_is_saved_and_another_editor_is_told_of(page: Page, tmp_path: Path) -> None:
    file = tmp_path / "my.toml"
    file.write_text("title = 'a'\n")
    with studio(str(file)) as (address,):
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
