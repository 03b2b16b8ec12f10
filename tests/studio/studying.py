"""A user's actions in the studio in a browser: open it, take a task, type, click."""

from __future__ import annotations

import contextlib
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

from browser import Page
from worked import ROOT

DRAWN = (
    "document.querySelector('#sketch').naturalWidth > 0 &&"
    " !document.querySelector('#scheme').classList.contains('old')"
)


@contextlib.contextmanager
def studio(*args: str) -> Iterator[list[str]]:
    """Start a studio at a free port; its address, and the instructor's where it is served.

    The address has no token: `come_in` gives its cookie to a browser.
    """
    command = [sys.executable, "-m", "planmethod", "studio", "--port", "0", "--lang", "en", *args]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=ROOT) as running:
        assert running.stdout is not None
        lines = [running.stdout.readline() for _ in range(1 + ("--serve" in args))]
        try:
            found = [re.findall(r"http://\S+", line)[0] for line in lines]
            addresses = [found[0].partition("?")[0], *found[1:]]
            PRINTED[addresses[0]] = found[0]
            yield addresses
        finally:
            running.terminate()
            running.wait()


PRINTED: dict[str, str] = {}
"""Addresses with the token, as printed, by the same addresses without it."""


def come_in(page: Page, address: str, width: int = 1200, height: int = 900) -> None:
    """Open the address that was printed; it leads to the one without the token."""
    page.open(PRINTED[address], leads=True, width=width, height=height)


def fetched(page: Page, link: str) -> bytes:
    """Return the target of a link of the page."""
    page.ask(
        f"globalThis.got = ''; fetch({link!r}).then(one => one.arrayBuffer()).then(found =>"
        " { got = [...new Uint8Array(found)].map(one => one.toString(16).padStart(2, '0')).join('')"
        "; })"
    )
    return bytes.fromhex(page.wait("globalThis.got"))


def click(page: Page, name: str) -> None:
    page.ask(f"document.querySelector({name!r}).click()")


def text(page: Page, name: str) -> str:
    return str(page.ask(f"document.querySelector({name!r}).textContent"))


def at(page: Page, words: str, replaced: str) -> None:
    """Select words in the editor as a reader would, and type others in their place."""
    page.ask(
        "{ const view = studio.typed.view, at = studio.text().indexOf(" + repr(words) + ");"
        f" view.dispatch({{ selection: {{ anchor: at, head: at + {len(words)} }} }});"
        " view.focus(); }"
    )
    page.call("Input.insertText", text=replaced)


def begin(page: Page, address: str, width: int = 1360, lang: str = "ru") -> None:
    come_in(page, address, width=width, height=900 if width > 600 else 740)
    page.ask(
        "localStorage.clear(); globalThis.cleared = false;"
        "{ const asked = indexedDB.open('planmethod', 1);"
        " asked.onupgradeneeded = () => asked.result.createObjectStore('works');"
        " asked.onsuccess = () => {"
        " const act = asked.result.transaction('works', 'readwrite');"
        " act.objectStore('works').clear();"
        " act.oncomplete = () => { asked.result.close(); cleared = true; }; }; }"
    )
    page.wait("cleared")  # a deletion of the whole database may wait for minutes
    page.open(f"{address}?lang={lang}", width=width, height=900 if width > 600 else 740)
    page.said.clear()
    page.wait("document.querySelectorAll('#tasks li').length > 3")


def take(page: Page, words: str) -> None:
    page.ask(
        "{ const box = document.querySelector('#search');"
        f" box.value = {words!r}; box.dispatchEvent(new Event('input')); }}"
    )
    button = f"#tasks button[aria-label$=': {words}']"
    page.wait(
        f"document.querySelectorAll('#tasks li').length < 9 && !!document.querySelector({button!r})"
    )
    click(page, button)
    page.wait(DRAWN)


def works(page: Page, file: Path) -> None:
    """Give works to the instructor's page."""
    root = page.call("DOM.getDocument")["root"]["nodeId"]
    node = page.call("DOM.querySelector", nodeId=root, selector="#chosen")["nodeId"]
    page.call("DOM.setFileInputFiles", nodeId=node, files=[str(file)])
    page.wait("document.querySelector('#works li')")
