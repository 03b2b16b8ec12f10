"""Keyboard, screen reader and eyes reach everything on the live pages."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from browser import PROGRAM, Page, browsing
from click.testing import CliRunner
from doors import cli
from reach import FAINT, nameless, unreached
from worked import PROBLEMS

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="Chromium looks at the page")

PAGES = ["press/press", "gears/gears-ex1", "cams/central", "point/rolling-wheel", "meshing/z12-30"]

SWITCHED = (
    "for (const name of ['hold', 'hides', 'colour', 'centres'])"
    " document.getElementById(name)?.click();"
    " for (const one of document.querySelectorAll('details')) one.open = true;"
)
"""Statements that show everything of a page."""

OUTSIDE = (
    "[...document.querySelectorAll('body *')].filter(one => [...one.childNodes].some(text =>"
    " text.nodeType === 3 && text.data.trim()) && !one.closest('header, main, footer, script')"
    ").map(one => one.outerHTML.slice(0, 80))"
)
"""Expression for the texts that belong to no landmark."""

UNREAD = (
    "[...document.querySelectorAll('main svg')].filter(one => !one.parentNode.closest('svg'))"
    ".filter(one => !one.getAttribute('role') || !one.getAttribute('aria-label')).length"
)
"""Expression for the number of pictures without a name."""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as page:
        yield page


@pytest.mark.parametrize("name", PAGES)
def test_every_control_has_a_name_and_every_text_its_contrast(
    name: str, page: Page, tmp_path: Path
) -> None:
    run = CliRunner().invoke(cli, ["live", str(PROBLEMS / f"{name}.toml"), "-o", str(tmp_path)])
    assert run.exit_code == 0, run.output
    (file,) = tmp_path.glob("*.html")
    page.said.clear()
    for dark in (False, True):
        page.open(file, width=390, height=844, dark=dark)
        assert page.ask(FAINT) == []
        page.ask(SWITCHED)
        assert page.ask(FAINT) == []
        assert page.ask("document.documentElement.scrollWidth") <= 390
    assert nameless(page, least=4) == []
    assert unreached(page) == []
    assert page.ask(OUTSIDE) == []
    assert page.ask(UNREAD) == 0
    assert not page.said


def test_numerals_of_the_diagrams_are_whole(page: Page, tmp_path: Path) -> None:
    """Large negative ones, too: the whole text is within the picture."""
    text = (PROBLEMS / "press/press.toml").read_text("utf-8").replace("n = 130 ", "n = 13000 ")
    file = tmp_path / "quick.toml"
    file.write_text(text, "utf-8")
    run = CliRunner().invoke(cli, ["live", str(file), "-o", str(tmp_path)])
    assert run.exit_code == 0, run.output
    page.open(tmp_path / "quick-live.html", width=390, height=844)
    page.ask("for (const one of D.quantities) if (!one.plot) one.button?.click()")
    cut = page.ask(
        "[...document.querySelectorAll('#diagrams .tick')].map(one => [one.textContent,"
        " one.getBBox()]).filter(([, box]) => box.x < 0 || box.x + box.width > 360)"
        ".map(([text]) => text)"
    )
    assert cut == []
    longest = page.ask(
        "[...document.querySelectorAll('#diagrams .tick')].map(one => one.textContent)"
        ".filter(text => text.startsWith('−')).sort((a, b) => b.length - a.length)[0]"
    )
    assert len(longest) >= 7
