"""The drawing room in a browser: a mechanism drawn by clicks, dragged, and its text in step."""

from __future__ import annotations

import re
import time
import tomllib
from collections.abc import Iterator
from typing import Any

import pytest
from browser import PROGRAM, Page, browsing
from studying import begin, click, come_in, studio, take, text

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="chromium is not installed")

SECONDS, ACTIONS = 60, 15
"""Limits of a slider-crank drawn from nothing to its plans."""

READY = (
    "(one => one.model && !one.writing && !one.held &&"
    " document.querySelectorAll('#plans svg').length === 2)(studio.board.state())"
)


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with studio() as (own, *_):
        yield own


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as browser:
        yield browser


def board(page: Page) -> list[float]:
    page.ask("document.querySelector('#board').scrollIntoView({ block: 'center' })")
    found: list[float] = page.ask(
        "(one => [one.left, one.top, one.width, one.height])"
        "(document.querySelector('#board').getBoundingClientRect())"
    )
    return found


def joint(page: Page, name: str) -> tuple[float, float]:
    """Return where a joint is on the board."""
    x, y = page.ask(f"studio.board.to(studio.board.state().places[{name!r}])")
    return x, y


def mouse(page: Page, kind: str, x: float, y: float) -> None:
    left, top, *_ = board(page)
    page.call(
        "Input.dispatchMouseEvent", type=f"mouse{kind}", x=left + x, y=top + y, button="left",
        buttons=int(kind != "Released"), clickCount=1,
    )  # fmt: skip


def press(page: Page, x: float, y: float) -> None:
    mouse(page, "Pressed", x, y)
    mouse(page, "Released", x, y)
    page.wait("!studio.board.state().writing")


def drag(page: Page, name: str, dx: float, dy: float, steps: int = 8) -> None:
    x, y = joint(page, name)
    mouse(page, "Pressed", x, y)
    for k in range(1, steps + 1):
        mouse(page, "Moved", x + dx * k / steps, y + dy * k / steps)
    mouse(page, "Released", x + dx, y + dy)
    page.wait(READY)


def content(page: Page) -> dict[str, Any]:
    return tomllib.loads(page.ask("studio.text()"))


@pytest.mark.parametrize("width", [1360, 390])
def test_a_slider_crank_is_drawn_from_nothing_to_its_plans_by_clicks(
    width: int, page: Page, address: str
) -> None:
    begin(page, address, width=width)
    start, actions = time.monotonic(), 0
    click(page, "#new-drawing")
    page.wait("!document.querySelector('#drawing').hidden")
    _, _, w, h = board(page)
    crank, pin, end = (0.2 * w, 0.6 * h), (0.3 * w, 0.4 * h), (0.75 * w, 0.7 * h)
    rod = (crank[0] + pin[0]) / 2, (crank[1] + pin[1]) / 2
    todo: list[tuple[str, list[tuple[float, float]]]] = [
        ("", [crank, pin, pin, end]), ("slider", [end]), ("ground", [crank]), ("driver", [rod]),
    ]  # fmt: skip
    for tool, places in todo:
        if tool:
            click(page, f"[data-tool={tool}]")
            actions += 1
        for place in places:
            press(page, *place)
            actions += 1
    page.wait(READY)
    assert actions + 1 <= ACTIONS
    assert time.monotonic() - start <= SECONDS
    table = content(page)
    assert table["links"].keys() == {"1", "2", "3"}
    assert table["assembly"] == {"B": "right of A"}
    through = table["frame"]["guides"]["x-x"]["through"]
    assert through[1] != table["frame"]["O"][1]  # offset
    assert "W = 3·3 − 2·4 = 1" in text(page, "#draw-told")
    assert page.ask("document.querySelectorAll('#plans .tip').length") >= 5
    assert page.ask("document.documentElement.scrollWidth") <= width
    assert not page.said


def test_a_dragged_joint_changes_its_numbers_and_leaves_the_comments(
    page: Page, address: str
) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    before = page.ask("studio.text()")
    click(page, "#to-drawing")
    page.wait(READY)
    drag(page, "D", 20, -40)
    after = page.ask("studio.text()")
    old, new = tomllib.loads(before), tomllib.loads(after)
    assert new["links"]["3"]["CD"] != old["links"]["3"]["CD"]
    new["links"]["3"]["CD"] = old["links"]["3"]["CD"]
    assert new == old  # nothing else
    assert re.findall(r"#.*", after) == re.findall(r"#.*", before)
    drag(page, "C", 15, 15)
    assert content(page)["frame"]["C"] != old["frame"]["C"]
    click(page, "#draw-undo")
    click(page, "#draw-undo")
    assert page.ask("studio.text()") == before
    page.wait(f"studio.board.state().model?.parameters.find(one => one.name === 'l_CD').value ==="
              f" {old['links']['3']['CD']}")  # fmt: skip
    assert not page.said


def test_a_size_is_typed_on_its_link_and_a_typed_text_moves_the_picture(
    page: Page, address: str
) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-drawing")
    page.wait(READY)
    page.ask("document.querySelector('[data-id=\"size l_DE\"]').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.call("Input.insertText", text="150")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.wait("!studio.board.state().writing && studio.text().includes('DE = 0.15')")
    where = joint(page, "D")
    page.ask("studio.put(studio.text().replace('CD = 0.22', 'CD = 0.23'))")
    page.wait(
        "studio.board.state().model?.parameters.find(one => one.name === 'l_CD').value === 0.23"
    )
    assert joint(page, "D") != where
    # A length that cannot close keeps the last pose and says why.
    page.ask("document.querySelector('[data-id=\"size l_DE\"]').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.call("Input.insertText", text="20")
    page.wait("document.querySelector('#draw-told').classList.contains('bad')")
    assert "E" in text(page, "#draw-told")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Escape", code="Escape")
    assert "DE = 0.15" in page.ask("studio.text()")
    assert not page.said


def test_a_joint_pulled_over_its_line_of_centres_takes_the_other_assembly(
    page: Page, address: str
) -> None:
    begin(page, address)
    page.ask(
        "studio.put(`[frame]\\nO = [0, 0]\\nC = [0.2, 0]\\n[links.1]\\npoints = ['O', 'A']\\n"
        "OA = 0.05\\n[links.2]\\npoints = ['A', 'B']\\nAB = 0.16\\n[links.3]\\n"
        "points = ['C', 'B']\\nCB = 0.12\\n[driver]\\nlink = '1'\\nphi = 60\\nomega = 5\\n"
        "[assembly]\\nB = 'above A' # как нарисовано\\n`)"
    )
    click(page, "#to-work")
    click(page, "#to-drawing")
    page.wait(READY)
    scale = page.ask("studio.board.state().view.scale")
    drag(page, "B", 0, 0.16 * scale, steps=12)
    page.wait("!studio.text().includes(\"'above A'\")")
    page.wait(READY)
    table = content(page)
    assert table["assembly"]["B"] != "above A"
    assert page.ask("studio.board.state().places.B[1]") < 0
    assert "# как нарисовано" in page.ask("studio.text()")
    assert not page.said


def test_a_link_to_share_has_the_whole_text(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    whole = page.ask("studio.text()")
    click(page, "#to-drawing")
    page.wait(READY)
    click(page, "#share-text")
    link = page.wait("location.hash.includes('text=') && location.href")
    page.ask("localStorage.clear()")
    come_in(page, address)
    page.open(link)
    page.wait("globalThis.studio && studio.text()")
    assert page.ask("studio.text()") == whole
    assert page.ask("location.hash") == ""


def test_the_heap_does_not_grow_with_drags(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-drawing")
    page.wait(READY)

    def heap() -> float:
        page.call("HeapProfiler.collectGarbage")
        found: float = page.call("Runtime.getHeapUsage")["usedSize"]
        return found / 1e6

    first = heap()
    for k in range(20):
        drag(page, "D", 6 if k % 2 else -6, 0, steps=3)
    assert heap() < first + 3, "MB"
    assert float(page.ask("document.querySelector('#board').dataset.ms")) < 200  # of a busy machine


def open_text(page: Page, whole: str) -> None:
    page.ask(f"studio.put({whole!r})")
    click(page, "#to-work")
    click(page, "#to-drawing")
    page.wait(READY)


DRIVEN = """units = 'mm'
[frame]
O = [0, 0]
guides.x-x = { through = 'O', angle = 0 }
[links.1]
points = ['A']
slides = { on = 'x-x' }
[links.2]
points = ['A', 'B']
AB = 220
[links.3]
points = ['O', 'B']
OB = 100
[driver]
link = '1'
s = 250
v = 500
[assembly]
B = 'left of OA'
"""


def test_a_driving_slider_has_a_handle_and_its_guide_an_angle_to_type(
    page: Page, address: str
) -> None:
    begin(page, address)
    open_text(page, DRIVEN)
    scale = page.ask("studio.board.state().view.scale")
    x, y = page.ask(
        "(one => [+one.getAttribute('cx'), +one.getAttribute('cy')])"
        "(document.querySelector('#board .knob'))"
    )
    assert x == pytest.approx(joint(page, "A")[0] + 30)
    mouse(page, "Pressed", x, y)
    for k in range(1, 6):
        mouse(page, "Moved", x - 0.004 * scale * k, y)
    mouse(page, "Released", x - 0.02 * scale, y)
    page.wait(READY)
    assert content(page)["driver"]["s"] == pytest.approx(230, abs=2)  # in the unit of the file
    page.ask("document.querySelector('[data-id=\"driver\"]').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="ArrowRight", code="ArrowRight")
    page.wait("!studio.text().includes('s = 230')")
    page.wait(READY)
    name = page.ask(
        "studio.board.state().model.parameters.find(one => one.means[0] === 'guide angle').name"
    )
    page.ask(f"document.querySelector('[data-id=\"size {name}\"]').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.call("Input.insertText", text="-10")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.wait("studio.text().includes('angle = -10')")
    page.wait(READY)
    assert page.ask("studio.board.state().places.A[1]") < 0
    assert not page.said


def test_a_size_is_typed_before_there_is_a_driver(page: Page, address: str) -> None:
    begin(page, address)
    click(page, "#new-drawing")
    page.wait("!document.querySelector('#drawing').hidden")
    _, _, w, h = board(page)
    for place in ((0.2 * w, 0.6 * h), (0.4 * w, 0.4 * h)):
        press(page, *place)
    page.wait("document.querySelector('#board .size') && !studio.board.state().writing")
    page.ask("document.querySelector('#board .size').focus()")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.call("Input.insertText", text="75")
    page.call("Input.dispatchKeyEvent", type="keyDown", key="Enter", code="Enter")
    page.wait("studio.text().includes('OA = 0.075') && !studio.board.state().writing")
    far = "(({ O, A }) => Math.hypot(A[0] - O[0], A[1] - O[1]))(studio.board.state().places)"
    assert page.ask(far) == pytest.approx(0.075)
    assert not page.said


def test_an_edit_asks_the_server_once(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-drawing")
    page.wait(READY)
    page.ask(
        "globalThis.asked = []; globalThis.real = fetch; globalThis.fetch = (path, more) => {"
        " if (/api.do/.test(path)) asked.push(path); return real(path, more); }"
    )
    drag(page, "D", 10, -20)
    time.sleep(0.8)  # longer than the pause of typing
    assert [one.split("?")[0] for one in page.ask("asked")] == ["api/do/modelled"]
    # the scheme is drawn when it is turned to
    click(page, "#to-scheme")
    page.wait("asked.some(one => one.startsWith('api/do/sketched'))")
    page.ask("globalThis.fetch = real")


def test_a_mechanism_that_is_not_moved_by_hand_says_why(page: Page, address: str) -> None:
    begin(page, address, lang="en")
    page.ask("location.hash = '#task=linkages-five-bar'")
    page.wait("document.querySelector('#name').value === 'linkages-five-bar'")
    click(page, "#to-drawing")
    page.wait("document.querySelector('#draw-told').textContent.includes('drive')")
    told = text(page, "#draw-told")
    assert told.startswith(("Several drivers move", "A cam moves")), told


def test_a_mechanism_is_drawn_by_keys_alone(page: Page, address: str) -> None:
    begin(page, address)
    click(page, "#new-drawing")
    page.wait("!document.querySelector('#drawing').hidden")
    page.ask("document.querySelector('#board').focus()")

    def keys(*names: str) -> None:
        for name in names:
            page.call("Input.dispatchKeyEvent", type="keyDown", key=name, code=name)
            page.wait("!studio.board.state().writing")

    keys("l", "ArrowLeft", "Enter", *["ArrowUp"] * 8, "Enter")
    keys("Enter", *["ArrowRight"] * 18, *["ArrowDown"] * 8, "Enter")
    page.wait("document.querySelectorAll('#board .bar').length === 2")
    assert page.ask("document.activeElement.id") == "board"
    keys("s", "Enter")
    page.wait("studio.text().includes('slides')")
    keys("g", *["ArrowLeft"] * 18, "Enter", "d", *["ArrowUp"] * 4, "Enter")
    page.wait(READY)
    assert content(page)["driver"]["link"] == "1"
    assert not page.said
