"""Keyboard, screen reader and eyes reach everything on the studio's pages."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from browser import PROGRAM, Page, browsing
from reach import FAINT, nameless, unreached
from studying import begin, click, studio, take

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("uvicorn", reason="the studio's extra is not installed")
pytestmark = pytest.mark.skipif(PROGRAM is None, reason="Chromium looks at the page")

LOADED = (
    "document.querySelector('#motion iframe') && performance.getEntriesByType('resource')"
    ".some(one => one.initiatorType === 'iframe' && one.responseEnd)"
)


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as page:
        yield page


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with studio() as (address,):
        yield address


def visited(page: Page, address: str, lang: str, look: Callable[[str], None]) -> None:
    """Show every page of the studio and look at it."""
    begin(page, address, lang=lang)
    look("task")
    take(page, "linkages-ex3")
    page.ask("studio.put(studio.text().replace('DE = 0.18', 'DE = 0.18 m'))")
    page.wait("document.querySelector('#faults button')")
    look("faults")
    page.ask("studio.put(studio.text().replace('DE = 0.18 m', 'DE = 0.18'))")
    page.wait("document.querySelector('#faults .good')")
    for view, shown in (
        ("drawing", "document.querySelectorAll('#plans svg').length === 2"),
        ("motion", LOADED),
        ("sheets", "document.querySelector('#sheet img')?.naturalWidth > 0"),
        ("tables", "document.querySelector('#tables pre').textContent"),
        ("assemblies", "document.querySelector('#ways button')"),
        ("files", "true"),
    ):
        click(page, f"#to-{view}")
        page.wait(shown)
        if shown == LOADED:
            time.sleep(0.5)  # its script runs apart
        look(view)
    click(page, "#files [data-what=pdf]")
    page.wait("document.querySelector('#files .made a')")
    look("made")
    click(page, "#to-answers")
    click(page, "#ask")
    page.wait("document.querySelector('#rows tr')")
    page.ask("document.querySelector('#rows td:nth-of-type(3) input').value = '3,2'")
    click(page, "#judge")
    page.wait("document.querySelector('#verdicts iframe')")
    look("answers")
    click(page, "#to-group")
    page.ask("document.querySelector('#results').hidden = false")
    look("group")
    assert page.said == []


@pytest.mark.dear
@pytest.mark.parametrize("lang", ["ru", "en"])
def test_every_control_has_a_role_and_a_name_and_is_come_to_by_tab(
    page: Page, address: str, lang: str
) -> None:
    faults: dict[str, list[str]] = {}

    def look(name: str) -> None:
        faults[name] = [*nameless(page), *unreached(page)]

    visited(page, address, lang, look)
    assert {name: found for name, found in faults.items() if found} == {}
    assert page.ask("document.querySelectorAll('iframe').length") == page.ask(
        "document.querySelectorAll('iframe + .own').length"
    )
    # every reported text is announced by a screen reader
    live = page.ask(
        "[...document.querySelectorAll('.told, #said, #told, #done, #faults, #measured')]"
        ".filter(one => !one.closest('[role=status], [role=alert], [aria-live]')).length"
    )
    assert live == 0
    # and a control without a name is found
    page.ask("document.querySelector('#theme').removeAttribute('title')")
    page.ask("document.querySelector('#theme').removeAttribute('aria-label')")
    page.ask("document.querySelector('#theme').textContent = ''")
    page.ask("document.querySelector('#key').tabIndex = -1")
    assert [one.split()[0] for one in nameless(page)] == ["button"]


@pytest.mark.dear
@pytest.mark.parametrize("theme", ["light", "dark"])
def test_letters_contrast_with_their_background(page: Page, address: str, theme: str) -> None:
    faint: dict[str, Any] = {}

    def look(name: str) -> None:
        page.ask(f"document.documentElement.dataset.theme = {theme!r}")
        faint[name] = page.ask(FAINT)

    visited(page, address, "en", look)
    assert {name: found for name, found in faint.items() if found} == {}
    page.ask("document.querySelector('#desk h2').style.color = '#888'")
    page.ask("document.querySelector('#desk h2').style.background = '#999'")
    assert [one[1] for one in page.ask(FAINT)] != []
