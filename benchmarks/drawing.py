"""Mechanisms drawn and dragged in a browser: ``python -m benchmarks.drawing`` (замеры чертежа).

Prints the table of benchmarks/reports/studio.md: actions and seconds of two mechanisms drawn from
nothing to their plans, bytes of a first visit, frames a second and milliseconds of a drag on a
processor slowed down four times, and memory after many drags. With axe-core (``--axe axe.min.js``)
also what it finds. A script acts faster than a hand: judge a drawing by its number of actions.
"""

from __future__ import annotations

import argparse
import itertools
import os
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from benchmarks.chromium import Page, browsing
from benchmarks.studio import served, table, text_of

WIDTHS = (1360, 390)
SLOWED = 4
"""A phone's processor, as a share of this machine's."""
READY = (
    "(one => one.model && !one.writing && !one.held &&"
    " document.querySelectorAll('#plans svg').length === 2)(studio.board.state())"
)
"""Expression for a mechanism that moves and has its plans."""


class Hand:
    """A user's hand on the board (рука): a mouse, or a finger.

    Attributes
    ----------
    actions : int
        Clicks and drags so far.
    """

    def __init__(self, page: Page, *, touches: bool = False) -> None:
        self.page, self.touches, self.actions = page, touches, 0

    def board(self) -> list[float]:
        """Return left, top, width and height of the board, which is scrolled into view, px."""
        self.page.ask("document.querySelector('#board').scrollIntoView({ block: 'center' })")
        found: list[float] = self.page.ask(
            "(one => [one.left, one.top, one.width, one.height])"
            "(document.querySelector('#board').getBoundingClientRect())"
        )
        return found

    def joint(self, name: str) -> tuple[float, float]:
        """Return where a joint is on the board, px."""
        x, y = self.page.ask(f"studio.board.to(studio.board.state().places[{name!r}])")
        return x, y

    def send(
        self, kind: str, x: float, y: float, *, corner: tuple[float, float] | None = None
    ) -> None:
        """Send "Pressed", "Moved" or "Released" at a place of the board, whose corner is known."""
        left, top = corner or self.board()[:2]
        if self.touches:
            points = [] if kind == "Released" else [{"x": left + x, "y": top + y}]
            name = {"Pressed": "touchStart", "Moved": "touchMove", "Released": "touchEnd"}[kind]
            self.page.call("Input.dispatchTouchEvent", type=name, touchPoints=points)
            return
        self.page.call(
            "Input.dispatchMouseEvent", type=f"mouse{kind}", x=left + x, y=top + y, button="left",
            buttons=int(kind != "Released"), clickCount=1,
        )  # fmt: skip

    def click(self, name: str) -> None:
        """Click a control of the page, by its selector."""
        self.actions += 1
        self.page.ask(f"document.querySelector({name!r}).click()")

    def press(self, x: float, y: float) -> None:
        """Click a place of the board, and wait until the text has what that means."""
        self.actions += 1
        self.send("Pressed", x, y)
        self.send("Released", x, y)
        self.page.wait("!studio.board.state().writing")

    def pull(self, start: tuple[float, float], by: tuple[float, float], *, steps: int = 8) -> None:
        """Drag from a place of the board to another one."""
        self.actions += 1
        self.send("Pressed", *start)
        for k in range(1, steps + 1):
            self.send("Moved", start[0] + by[0] * k / steps, start[1] + by[1] * k / steps)
        self.send("Released", start[0] + by[0], start[1] + by[1])

    def drag(self, name: str, dx: float, dy: float, *, steps: int = 8) -> None:
        """Drag a joint, and wait until the text and the plans have it."""
        self.pull(self.joint(name), (dx, dy), steps=steps)
        self.page.wait(READY)

    def draw(self, *strokes: tuple[str, list[tuple[float, float]]]) -> None:
        """Draw with tools: the name of each, and the clicked places as parts of the board."""
        self.click("#new-drawing")
        self.page.wait("!document.querySelector('#drawing').hidden")
        _, _, width, height = self.board()
        for tool, places in strokes:
            if tool:
                self.click(f"[data-tool={tool}]")
            for x, y in places:
                self.press(x * width, y * height)
        self.page.wait(READY)


def between(a: tuple[float, float], b: tuple[float, float]) -> tuple[float, float]:
    """Return the middle of two places (середина)."""
    return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2


def draw_slider_crank(hand: Hand) -> None:
    """Draw an offset slider-crank from nothing (кривошипно-ползунный механизм)."""
    o, a, b = (0.2, 0.6), (0.3, 0.4), (0.75, 0.7)
    hand.draw(
        ("", [o, a, a, b]), ("slider", [b]), ("ground", [o]), ("driver", [between(o, a)])
    )  # fmt: skip


def draw_six_link(hand: Hand) -> None:
    """Draw a four-bar with a rod and a slider from nothing (шестизвенник с ползуном)."""
    o, a, b, c, d = (0.15, 0.62), (0.21, 0.5), (0.45, 0.3), (0.5, 0.72), (0.85, 0.5)
    hand.draw(
        ("", [o, a, a, b, b, c, b, d]), ("slider", [d]), ("ground", [o, c]),
        ("driver", [between(o, a)]),
    )  # fmt: skip


DRAWINGS: dict[str, Callable[[Hand], None]] = {
    "an offset slider-crank": draw_slider_crank, "a six-link with a slider": draw_six_link,
}  # fmt: skip


def visit(page: Page, address: str, width: int) -> None:
    """Open the studio as on a first visit (первое посещение)."""
    page.call("Emulation.setTouchEmulationEnabled", enabled=width < 600)
    page.open(address, leads=True, width=width, height=900 if width > 600 else 844)
    origin = page.ask("location.origin")
    page.open("about:blank")  # a page that is open would keep its text
    page.call("Storage.clearDataForOrigin", origin=origin, storageTypes="local_storage")
    page.call("Network.clearBrowserCache")
    page.open(f"{origin}/?lang=en", width=width,
              height=900 if width > 600 else 844)  # fmt: skip
    page.wait("globalThis.studio && document.querySelectorAll('#tasks li').length > 3")


def bytes_of(page: Page) -> float:
    """Return what a visit has transferred so far, kB (объём посещения)."""
    total: float = page.ask(
        "[...performance.getEntriesByType('navigation'),"
        " ...performance.getEntriesByType('resource')]"
        ".reduce((sum, one) => sum + one.transferSize, 0)"
    )
    return total / 1000


def heap(page: Page) -> float:
    """Return the memory that the page's script uses, MB (память)."""
    page.call("HeapProfiler.collectGarbage")
    used: float = page.call("Runtime.getHeapUsage")["usedSize"]
    return used / 1e6


def busy(page: Page) -> float:
    """Return the CPU time of the page's thread so far, ms: script, layout, painting (затраты)."""
    told = page.call("Performance.getMetrics")["metrics"]
    return 1000 * next(float(one["value"]) for one in told if one["name"] == "TaskDuration")


def dragged(page: Page, hand: Hand, joint: str, moves: int) -> tuple[float, float, float]:
    """Return frames a second, CPU ms of a frame, and ms until the text is written (кадры)."""
    page.call("Performance.setTimeDomain", timeDomain="threadTicks")
    page.call("Performance.enable")
    page.ask(
        "globalThis.frames = []; { const step = time => { if (!frames) return;"
        " frames.push(time); requestAnimationFrame(step); }; requestAnimationFrame(step); }"
    )
    (x, y), (left, top, *_) = hand.joint(joint), hand.board()
    hand.send("Pressed", x, y)
    before = busy(page)
    for k in range(moves):
        dx, dy = 12 * ((k % 20) - 10) / 10, 8 * ((k % 14) - 7) / 7
        hand.send("Moved", x + dx, y - dy, corner=(left, top))
    took = busy(page) - before
    times = page.ask("(found => { frames = null; return found; })(frames)")
    began = time.monotonic()
    hand.send("Released", x + 6, y - 6)
    page.wait(READY)
    late = time.monotonic() - began
    gaps = [b - a for a, b in itertools.pairwise(times)]
    page.call("Performance.disable")
    return 1000 / statistics.mean(gaps), took / len(gaps), 1000 * late


def found_by_axe(page: Page, source: str) -> list[str]:
    """Return the names of the rules of accessibility that a page breaks (доступность)."""
    page.ask(f"{source}; 0")
    page.ask(
        "globalThis.told = null; axe.run(document, { iframes: false }).then(found => { told ="
        " found.violations.map(one => `${one.id}: ${one.nodes.map(node => node.target)}`); })"
    )
    found: list[str] = page.wait("told && { found: told }")["found"]
    return found


def rows(page: Page, address: str, drags: int, axe: str) -> Iterator[list[str]]:
    """Yield the rows of the table, as they are measured."""
    for width in WIDTHS:
        visit(page, address, width)
        hand = Hand(page, touches=width < 600)
        yield [f"first visit, {width} px", f"{bytes_of(page):.0f} kB compressed"]
        for name, draw in DRAWINGS.items():
            visit(page, address, width)
            hand.actions, began = 0, time.monotonic()
            draw(hand)
            took = time.monotonic() - began
            yield [f"{name}, {width} px", f"{hand.actions} actions, {took:.1f} s by a script"]
        if axe:
            yield [f"axe, drawing room, {width} px", "; ".join(found_by_axe(page, axe)) or "clean"]
        page.ask(f"studio.put({text_of('linkages-ex3')!r})")
        page.wait(READY + " && studio.board.state().model.order.includes('E')")
        page.call("Emulation.setCPUThrottlingRate", rate=SLOWED)
        page.ask("document.querySelector('#draw-fit').click()")
        rate, work, late = dragged(page, hand, "D", 120)
        page.call("Emulation.setCPUThrottlingRate", rate=1)
        yield [
            f"drag of D of ex3, {width} px, processor / {SLOWED}",
            f"{rate:.0f} frames a second, {work:.1f} ms of CPU each; text after {late:.0f} ms",
        ]
    before = heap(page)
    for k in range(drags):
        hand.drag("D", 6 if k % 2 else -6, 0, steps=3)
    yield [f"memory after {drags} drags", f"{before:.1f} MB → {heap(page):.1f} MB"]


def main() -> int:
    """Print the table."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--drags", type=int, default=200)
    parser.add_argument("--axe", type=Path, help="axe.min.js of axe-core")
    asked = parser.parse_args()
    axe = asked.axe.read_text("utf-8") if asked.axe else ""
    print(f"load average: {os.getloadavg()[0]:.1f}")
    with (
        served() as (address, _),
        tempfile.TemporaryDirectory() as folder,
        browsing(Path(folder)) as page,
    ):
        table(("what", "measured"), rows(page, address, asked.drags, axe))
        said: list[Any] = page.said
    for one in said:
        print(one)
    return 0


if __name__ == "__main__":
    sys.exit(main())
