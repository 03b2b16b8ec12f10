"""The drawing room in a browser: a mechanism drawn by clicks, dragged, and its text in step."""

from __future__ import annotations

import re
import time
import tomllib
from collections.abc import Callable, Iterator
from typing import Any

import pytest
from browser import PROGRAM, Page, browsing
from studying import begin, click, come_in, studio, take, text

from benchmarks.drawing import READY, Hand, draw_six_link, draw_slider_crank

pytestmark = pytest.mark.skipif(PROGRAM is None, reason="chromium is not installed")

ACTIONS: dict[Callable[[Hand], None], int] = {draw_slider_crank: 15, draw_six_link: 20}
"""Largest numbers of actions from an empty board to the plans."""


@pytest.fixture(scope="module")
def address() -> Iterator[str]:
    with studio() as (own, *_):
        yield own


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as browser:
        yield browser


def content(page: Page) -> dict[str, Any]:
    return tomllib.loads(page.ask("studio.text()"))


@pytest.mark.parametrize("width", [1360, 390])
@pytest.mark.parametrize("draw", [draw_slider_crank, draw_six_link])
def test_a_mechanism_is_drawn_from_nothing_to_its_plans_by_clicks(
    width: int, draw: Callable[[Hand], None], page: Page, address: str
) -> None:
    page.call("Emulation.setTouchEmulationEnabled", enabled=width < 600)
    begin(page, address, width=width)
    hand = Hand(page, touches=width < 600)
    draw(hand)
    page.call("Emulation.setTouchEmulationEnabled", enabled=False)
    assert hand.actions <= ACTIONS[draw]
    table = content(page)
    six = draw is draw_six_link
    assert len(table["links"]) == (5 if six else 3)
    assert table["assembly"].keys() == ({"B", "D"} if six else {"B"})
    assert table["frame"]["O"] == [0, 0]  # the first support is the origin
    assert table["frame"]["guides"]["x-x"]["through"][1] != 0  # offset
    assert f"W = 3·{5 if six else 3} − 2·{7 if six else 4} = 1" in text(page, "#draw-told")
    assert page.ask("document.querySelectorAll('#plans .tip').length") >= 5
    values = page.ask("document.querySelector('#plans p').textContent")
    omega, crank = table["driver"]["omega"], table["links"]["1"]["OA"]
    assert values.startswith(f"vA\xa0=\xa0{omega * crank:.3f}".replace(".", ","))
    assert page.ask("document.documentElement.scrollWidth") <= width
    # the mechanism and its velocity plan are seen at once
    tops = page.ask(
        "['#board', '#plans figure'].map(one => document.querySelector(one)"
        ".getBoundingClientRect()).map(one => [one.top, one.bottom])"
    )
    assert max(tops[0][1], tops[1][1]) - min(tops[0][0], tops[1][0]) < 740
    assert not page.said


def test_undo_brings_back_the_picture_of_an_unfinished_drawing(page: Page, address: str) -> None:
    begin(page, address)
    click(page, "#new-drawing")
    page.wait("!document.querySelector('#drawing').hidden")
    hand = Hand(page)
    for place in ((150, 300), (250, 200), (250, 200), (420, 330)):
        hand.press(*place)
    places = page.ask("studio.board.state().places")
    click(page, "[data-tool=select]")
    hand.pull(hand.joint("A"), (40, -30))
    page.wait("!studio.board.state().writing && !studio.board.state().held")
    page.wait(f"studio.board.state().places.A[0] !== {places['A'][0]}")
    click(page, "#draw-undo")
    page.wait(f"studio.board.state().places.A[0] === {places['A'][0]}")
    assert page.ask("studio.board.state().places") == places
    click(page, "[data-tool=ground]")
    hand.press(*hand.joint("O"))
    assert content(page)["frame"] == {"O": [0, 0]}
    click(page, "#draw-undo")
    page.wait("!studio.text().includes('frame')")
    page.wait("!document.querySelector('#board .ground')")
    far = "(({ O, A }) => Math.hypot(A[0] - O[0], A[1] - O[1]))(studio.board.state().places)"
    assert page.ask(far) == pytest.approx(content(page)["links"]["1"]["OA"], abs=5e-4)
    assert not page.said


def test_a_crank_turns_by_itself_and_the_text_stays(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-drawing")
    page.wait(READY)
    before, x = page.ask("[studio.text(), studio.board.state().sizes.x]")
    click(page, "#draw-play")
    page.wait(f"Math.abs(studio.board.state().sizes.x - {x}) > 8")
    click(page, "#draw-play")
    held = page.ask("studio.board.state().sizes.x")
    assert text(page, "#phi-told") == f"{round(held) % 360}°"
    time.sleep(0.2)
    assert page.ask("studio.board.state().sizes.x") == held
    assert page.ask("studio.text()") == before
    assert not page.said


def test_a_force_is_an_arrow_that_is_turned_by_hand(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    click(page, "#to-drawing")
    page.wait(READY)
    hand = Hand(page)
    click(page, "[data-tool=load]")
    hand.press(*hand.joint("E"))
    page.wait("document.querySelector('#board .load.head')")
    page.wait(READY)
    click(page, "[data-tool=select]")
    x, y = hand.joint("E")
    hand.pull((x + 70, y), (-70, -70))
    page.wait("!studio.text().includes('angle = 180')")
    assert content(page)["loads"][-1] == {"link": "5", "at": "E", "angle": -90, "force": 100}
    click(page, "[data-tool=delete]")
    hand.press(x, y - 70)
    page.wait("!studio.text().includes('[[loads]]')")
    assert not page.said


def test_the_border_of_the_text_moves_and_stays(page: Page, address: str) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    wide = "document.querySelector('#typed').getBoundingClientRect().width"
    before = page.ask(wide)
    page.ask("document.querySelector('#split').focus()")

    def key(name: str) -> None:
        page.call("Input.dispatchKeyEvent", type="keyDown", key=name, code=name)

    key("ArrowRight")
    assert page.ask(wide) > before + 40
    key("Enter")  # folded away
    assert page.ask(wide) == 0
    come_in(page, address, width=1360)
    page.wait("!!globalThis.studio")
    assert page.ask(wide) == 0
    x, y = page.ask(
        "(one => [one.left + 3, one.top + 30])"
        "(document.querySelector('#split').getBoundingClientRect())"
    )
    for kind, to in (("Pressed", x), ("Moved", x + 400), ("Released", x + 400)):
        page.call("Input.dispatchMouseEvent", type=f"mouse{kind}", x=to, y=y, button="left",
                  buttons=int(kind != "Released"), clickCount=1)  # fmt: skip
    assert page.ask(wide) == pytest.approx(400, abs=20)
    page.ask("localStorage.removeItem('planmethod.split')")
    assert not page.said


def test_a_dragged_joint_changes_its_numbers_and_leaves_the_comments(
    page: Page, address: str
) -> None:
    begin(page, address)
    take(page, "linkages-ex3")
    before = page.ask("studio.text()")
    click(page, "#to-drawing")
    page.wait(READY)
    Hand(page).drag("D", 20, -40)
    after = page.ask("studio.text()")
    old, new = tomllib.loads(before), tomllib.loads(after)
    assert new["links"]["3"]["CD"] != old["links"]["3"]["CD"]
    new["links"]["3"]["CD"] = old["links"]["3"]["CD"]
    assert new == old  # nothing else
    assert re.findall(r"#.*", after) == re.findall(r"#.*", before)
    Hand(page).drag("C", 15, 15)
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
    where = Hand(page).joint("D")
    page.ask("studio.put(studio.text().replace('CD = 0.22', 'CD = 0.23'))")
    page.wait(
        "studio.board.state().model?.parameters.find(one => one.name === 'l_CD').value === 0.23"
    )
    assert Hand(page).joint("D") != where
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
    Hand(page).drag("B", 0, 0.16 * scale, steps=12)
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
        Hand(page).drag("D", 6 if k % 2 else -6, 0, steps=3)
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
    assert x == pytest.approx(Hand(page).joint("A")[0] + 30)
    hand = Hand(page)
    hand.send("Pressed", x, y)
    for k in range(1, 6):
        hand.send("Moved", x - 0.004 * scale * k, y)
    hand.send("Released", x - 0.02 * scale, y)
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
    hand = Hand(page)
    _, _, w, h = hand.board()
    for place in ((0.2 * w, 0.6 * h), (0.4 * w, 0.4 * h)):
        hand.press(*place)
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
    Hand(page).drag("D", 10, -20)
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
