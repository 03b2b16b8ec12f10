"""What keyboard, screen reader and eyes reach on a page."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from browser import Page

ROLES = {"button", "link", "textbox", "searchbox", "combobox", "checkbox", "tab", "spinbutton",
         "slider", "separator", "Iframe", "DisclosureTriangle", "region", "group"}  # fmt: skip
CONTROLS = "a[href], button, input, select, summary, iframe, [contenteditable=true], [tabindex]"
HERE = (
    f"[...document.querySelectorAll({CONTROLS!r})].filter(one => one.checkVisibility()"
    " && one.id !== 'main' && !one.disabled && !one.classList.contains('cm-scroller'))"
)
"""Expression for the visible controls; the main content itself is only the target of a link."""

FAINT = (Path(__file__).parent / "studio/contrast.js").read_text("utf-8")
"""Expression for the texts with little contrast."""


def nameless(page: Page, *, least: int = 10) -> list[str]:
    """Return the controls that a screen reader has no role or no name for.

    ``least``: of a page with no more controls the check has seen nothing.
    """
    page.ask(f"{HERE}.forEach((one, k) => {{ one.dataset.control = k; }})")
    nodes = page.call("Accessibility.getFullAXTree")["nodes"]
    told = {node["backendDOMNodeId"]: node for node in nodes if "backendDOMNodeId" in node}
    root = page.call("DOM.getDocument", depth=-1)["root"]["nodeId"]
    found = page.call("DOM.querySelectorAll", nodeId=root, selector="[data-control]")["nodeIds"]
    lacking = []
    for number in found:
        node = page.call("DOM.describeNode", nodeId=number)["node"]
        heard: dict[str, Any] = told.get(node["backendNodeId"], {})
        role = heard.get("role", {}).get("value")
        name = heard.get("name", {}).get("value", "")
        if not name.strip() or role not in ROLES:
            lacking.append(f"{node['localName']} {node.get('attributes')}: {role} {name!r}")
    page.ask(
        "document.querySelectorAll('[data-control]').forEach(one => delete one.dataset.control)"
    )
    assert len(found) > least
    return lacking


def unreached(page: Page) -> list[str]:
    """Return the controls that Tab does not reach from the top of the page."""
    reached = (  # a page without controls is read in the tab that the link below it opens
        "(one => one.tagName === 'IFRAME' ? one.sandbox.contains('allow-scripts')"
        " : one.tabIndex >= 0 || one.isContentEditable)"
    )
    wanted = page.ask(f"globalThis.all = {HERE}.filter({reached}); all.length")
    page.call("Page.bringToFront")
    page.ask("all[0].focus()")  # not in a frame that a room before had, and that is hidden now
    missed, turn = {*range(wanted)}, 0
    frames = page.ask("all.filter(one => one.tagName === 'IFRAME').length")
    while missed and turn < 2 * (wanted + 10 + 60 * frames):  # a trap would keep focus
        for kind in ("rawKeyDown", "keyUp"):
            page.call("Input.dispatchKeyEvent", type=kind, key="Tab", code="Tab",
                      windowsVirtualKeyCode=9)  # fmt: skip
        missed.discard(page.ask("all.indexOf(document.activeElement)"))
        turn += 1
    name = "one => `${one.tagName}#${one.id} ${one.textContent.slice(0, 30)}`"
    told: list[str] = page.ask(f"{sorted(missed)}.map(k => all[k]).map({name})")
    return told
