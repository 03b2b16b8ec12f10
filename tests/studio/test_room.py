"""The room of the studio: ways to begin, tabs, paper, answers, a server that is gone."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from browser import PROGRAM, Page, browsing
from doors import find_tasks
from studying import DRAWN, begin, click, fetched, studio, take, text, works

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("uvicorn", reason="the studio's extra is not installed")
in_browser = pytest.mark.skipif(PROGRAM is None, reason="Chromium looks at the page")


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with studio() as (address,):
        yield address


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as page:
        yield page


def groups(query: str) -> set[str]:
    """Return the structures of the linkages that a search finds."""
    found = find_tasks(query, "ru")
    assert found, query
    return {"+".join(one["groups"]) or one["kind"] for one in found}


def test_a_search_finds_a_mechanism_by_its_names_in_both_languages() -> None:
    for name in ("four-bar", "Four-bar linkage", "четырёхзвенник", "четырехзвенный"):
        assert "RRR" in groups(name)
    for name in ("piston", "slider-crank", "поршень", "поршня", "ползун"):
        found = groups(name)
        assert "RRP" in found and "RRR" not in found, name
    for name in ("шестизвенный", "шестизвенник", "six-link"):
        found = groups(name)
        assert {"RRR+RRP", "RPR+RRP"} <= found and "RRP" not in found, name
    assert {"gears"} < groups("зубчатое") and groups("cam") >= {"cam"}
    assert [one["name"] for one in find_tasks("linkages-ex3-variants", "en")]
    assert find_tasks("no such words", "en") == []
    assert {one["about"] for one in find_tasks("RRR+RRP", "en")} == {
        "four-bar linkage with a rod and a slider"
    }


def tabs(page: Page) -> list[str]:
    found: list[str] = page.ask(
        "[...document.querySelectorAll('#views [role=tab]')].filter(one =>"
        " one.checkVisibility()).map(one => one.textContent)"
    )
    return found


@in_browser
def test_an_empty_room_shows_three_ways_to_begin(page: Page, address: str) -> None:
    begin(page, address, lang="en")
    assert page.ask("document.querySelector('#go-on').hidden")
    click(page, "[data-chip=chip_four_bar]")
    shown = "[...document.querySelectorAll('#tasks li')].map(one => one.textContent)"
    assert all("· RRR" in one and "four-bar linkage" in one for one in page.ask(shown))
    click(page, "[data-chip=chip_four_bar]")
    page.wait("document.querySelector('#families img').naturalWidth > 0")
    click(page, "#to-work")
    assert page.ask("document.querySelector('#blank').checkVisibility()")
    assert not page.ask("document.querySelector('#faults').checkVisibility()")
    click(page, "#blank [data-start=templates]")
    assert page.ask("document.activeElement.id") == "templates"
    click(page, "#families button")
    page.wait(DRAWN)
    assert "[links.1]" in page.ask("studio.text()")
    assert not page.ask("document.querySelector('#blank').checkVisibility()")
    click(page, "#to-task")
    assert text(page, "#gone-on") == "slider-crank"
    click(page, "#resume")
    assert page.ask("document.querySelector('#work').hidden") is False
    click(page, "#to-task")
    click(page, "#new-drawing")
    assert page.ask("document.querySelector('#drawing').checkVisibility()")
    assert page.said == []


@in_browser
def test_a_kind_of_problem_has_only_its_own_tabs(page: Page, address: str) -> None:
    begin(page, address, lang="en")
    take(page, "linkages-ex3")
    assert tabs(page) == ["Scheme", "Draw", "Motion", "Sheets", "More"]
    click(page, "#to-motion")
    page.ask("location.hash = '#task=moving-point'")
    page.wait("document.querySelector('#name').value === 'moving-point'")
    page.wait(DRAWN)
    assert tabs(page) == ["Scheme", "Motion", "Sheets", "More"]
    click(page, "#to-more")
    page.wait("document.querySelector('#tables pre').textContent")
    assert not page.ask("document.querySelector('#to-assemblies').checkVisibility()")
    page.ask("document.querySelector('#to-tables').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="End", code="End")
    assert page.ask("document.activeElement.id") == "to-files"
    assert not page.ask("document.querySelector('[data-what=project]').checkVisibility()")


def point(page: Page, kind: str, x: float, y: float, **more: Any) -> None:
    page.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", **more)


@in_browser
def test_paper_is_dragged_by_hand_and_zoomed_by_the_wheel(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-sheets")
    page.wait("document.querySelector('#sheet img')?.naturalWidth > 0")
    box = "document.querySelector('#paper')"
    assert page.ask(f"{box}.scrollWidth <= {box}.clientWidth + 1")  # the whole sheet at first
    assert page.ask(f"{box}.scrollHeight <= {box}.clientHeight + 1")
    x, y = page.ask(
        f"(one => [one.left + one.width / 2, one.top + one.height / 2])"
        f"({box}.getBoundingClientRect())"
    )
    page.call("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=-500)
    page.wait(f"{box}.scrollWidth > 2 * {box}.clientWidth")
    before = page.ask(f"[{box}.scrollLeft, {box}.scrollTop]")
    point(page, "mousePressed", x, y, clickCount=1)
    point(page, "mouseMoved", x - 60, y - 40, buttons=1)
    point(page, "mouseReleased", x - 60, y - 40, clickCount=1)
    after = page.ask(f"[{box}.scrollLeft, {box}.scrollTop]")
    assert after == pytest.approx([before[0] + 60, before[1] + 40], abs=2)
    click(page, "#whole")
    assert page.ask(f"{box}.scrollHeight <= {box}.clientHeight + 1")
    click(page, "#sheets [data-what=pdf]")
    link = page.wait("document.querySelector('#sheets .made a')?.href")
    assert fetched(page, link).startswith(b"%PDF-")


@in_browser
def test_a_server_that_is_gone_says_so_within_three_seconds(page: Page, address: str) -> None:
    begin(page, address, lang="en")
    take(page, "linkages-ex3")
    page.ask("globalThis.real = fetch")
    seen = "document.querySelector('#gone').checkVisibility()"
    for gone in ("Promise.reject(new TypeError('Failed to fetch'))", "new Promise(() => {})"):
        page.ask(
            f"globalThis.fetch = () => {gone}; globalThis.began = performance.now();"
            " globalThis.took = 0;"
            f"globalThis.watch = setInterval(() => {{ if (took || !{seen}) return;"
            " took = performance.now() - began; clearInterval(watch); }, 20);"
            "studio.put(`${studio.text()}#\n`)"
        )
        assert page.wait("took") < 3500
        assert text(page, "#gone").startswith("The server does not answer.")
        page.ask("globalThis.fetch = real")
        if "reject" in gone:  # the page tries again without a click
            page.wait(f"!{seen}")
            page.wait(DRAWN)
    # the message has a button that closes it
    page.ask("location.hash = '#task=no-such-task'")
    page.wait("document.querySelector('#note').checkVisibility()")
    click(page, "#said-off")
    assert page.ask("document.querySelector('#note').hidden")


@in_browser
def test_answers_on_a_phone_are_cards_with_their_verdicts(page: Page, address: str) -> None:
    begin(page, address, 360)
    take(page, "linkages-ex3")
    click(page, "#to-answers")
    click(page, "#ask")
    page.wait("document.querySelectorAll('#rows tr').length > 5")
    for row, value in ((1, "3,2"), (2, "9")):
        page.ask(
            f"{{ const box = document.querySelector('#rows tr:nth-child({row})"
            f" [data-label=Значение] input'); box.value = '{value}';"
            " box.dispatchEvent(new Event('input', { bubbles: true })); }"
        )
    click(page, "#judge")
    page.wait("document.querySelector('#rows .bad')")
    verdicts = "[...document.querySelectorAll('#rows .verdict')].map(one => one.textContent)"
    assert page.ask(verdicts)[:3] == ["верно", "неверно", ""]
    inside = page.ask(
        "[...document.querySelectorAll('#rows :is(input, select, .verdict)')]"
        ".every(one => one.getBoundingClientRect().right <= innerWidth)"
    )
    assert inside
    assert page.ask("document.documentElement.scrollWidth") <= 360
    # letters have their indices, as on the sheets
    assert page.ask("document.querySelector('#rows th sub').textContent") == "B1"
    assert "τB3C" in page.ask("document.querySelector('#rows').textContent")
    assert page.said == []


@in_browser
@pytest.mark.dear
def test_an_instructor_opens_a_work_by_its_row_and_types_points_in_the_cell(
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
    click(page, "#marks tr[data-who=ab] td:last-child")
    assert page.ask("document.querySelector('#who').value") == "ab"
    assert page.ask("document.querySelector('#page iframe').title") == "ab"
    assert page.ask("document.querySelector('#marks tr[data-shown]').dataset.who") == "ab"
    page.ask(
        "{ const box = document.querySelector('#marks tr[data-who=ab] input'); box.value = '7,5';"
        " box.dispatchEvent(new Event('change', { bubbles: true })); }"
    )
    page.wait("document.querySelector('#entered li')")
    page.wait("document.querySelector('#marks tr[data-who=ab] input').value === '7,5'")
    assert page.said == []
