"""The HTML document of a page that moves: its contents are data or escaped text, never source.

A policy in the head lets the page's own script and style run, by their hashes, and nothing else.
"""

# no messages: HTML

from __future__ import annotations

import json
import re
from base64 import b64encode
from collections.abc import Sequence
from hashlib import sha256
from html import escape
from importlib.resources import files
from typing import Any

from planmethod.problem.records import KindProblem
from planmethod.render.ink.pens import Pen, PenSet
from planmethod.render.ink.typeset import typeset

POLICY = "default-src 'none'; script-src '{script}'; style-src '{style}'; base-uri 'none'"
"""Content security policy of the page: only its own script and style may run."""

SPEEDS = (0.25, 0.5, 1, 2)
"""Speeds of a page relative to the usual one."""


def html_document(
    problem: KindProblem,
    *,
    lang: str,
    body: str,
    credit: str,
    letters: str,
    scene: Any,
    script: str,
    style: str = "",
) -> str:
    """Return the page of a problem.

    Parameters
    ----------
    body : str
        Contents under the title, as HTML.
    credit : str
        Credit line of the page, plain text.
    letters : str
        Letters of the drawn texts, as SVG.
    scene : plain data
        Data that the script reads.
    script : str
        The page's own source.
    style : str
        Rules of the page over the common ones.
    """
    common = files("planmethod.render.live").joinpath("page.css").read_text("utf-8")
    style = common + _colours() + style
    policy = POLICY.format(script=_hash(script), style=_hash(style))
    title = escape(problem.title or problem.name)
    return (
        f'<!DOCTYPE html>\n<html lang="{lang}">\n<head>\n<meta charset="utf-8">\n'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title}</title>\n<style>{style}</style>\n"
        f"</head>\n<body>\n<header><h1>{title}</h1>"
        f"<p>{escape(problem.source)}</p></header>\n<main>{body}</main>\n"
        f"<footer>{escape(credit)}</footer>\n"
        f'<svg width="0" height="0" aria-hidden="true"><defs>{letters}</defs>'
        f'</svg>\n<script type="application/json" id="scene">{_data(scene)}</script>\n'
        f"<script>{script}</script>\n</body>\n</html>\n"
    )


def with_link(page: str, address: str, text: str) -> str:
    """Return a page with a link under its title, to a file beside it."""
    link = f'<p><a href="{escape(address)}">{escape(text)}</a></p>'
    return page.replace("</header>", f"{link}</header>", 1)


def joined(*names: str, package: str = "planmethod.render.live") -> str:
    """Return modules of ``script/`` as one script, for a page that may load nothing.

    A name has one meaning in all of them, so their imports and exports are left out.

    Parameters
    ----------
    names : str
        Names of modules, each after those that it imports.
    package : str
        Where the folder is.
    """
    folder = files(package).joinpath("script")
    texts = (folder.joinpath(f"{name}.js").read_text("utf-8") for name in names)
    return re.sub(r"(?m)^(?:import .*;\n|export )", "", "".join(texts))


def _colours() -> str:
    """Return the rules of the colours of pens, which hold while the switch of the page is on.

    On a dark page they are lighter. A line that is pointed at keeps the colour of that.
    """
    pens, on = PenSet(is_coloured=True), ":root:has(#colour:checked)"
    rules = ""
    for pen in Pen:
        red, green, blue = pens.colour(pen)
        if (red, green, blue) == (0, 0, 0):
            continue
        name, colour = pen.value.replace(" ", "."), f"#{red:02x}{green:02x}{blue:02x}"
        shade = f"light-dark({colour},color-mix(in srgb,{colour} 55%,#fff))"
        lines = f":where({on}) .pen-{name},:where({on} .{name}).seg"
        heads = f":where({on}) .of-{name},:where({on} .{name})+.tip"
        rules += f"{lines}{{stroke:{colour};stroke:{shade}}}{heads}{{fill:{colour};fill:{shade}}}"
    return rules


def colour_switch(problem: KindProblem, label: str) -> str:
    """Return the element that switches the colours of lines."""
    state = " checked" if problem.sheet.colour else ""
    return f'<label><input id="colour" type="checkbox"{state}> {escape(label)}</label>'


def speed_choice(label: str) -> str:
    """Return the element that chooses how quickly the page moves."""
    options = "".join(
        f'<option value="{v}"{" selected" if v == 1 else ""}>×{v:g}</option>' for v in SPEEDS
    )
    return f'<select id="speed" aria-label="{escape(label)}">{options}</select>'


def slider_marks(places: Sequence[tuple[int, float]], name: str) -> str:
    """Return the marks of a slider, which the script puts in their places.

    Parameters
    ----------
    places : sequence of (int, float)
        Number of a place, and where it is.
    name : str
        How a mark is spoken; it has ``{number}``.
    """
    marks = ""
    for number, place in places:
        spoken = escape(name.format(number=number))
        marks += (
            f'<button data-at="{float(place)!r}" aria-label="{spoken}" title="{spoken}">'
            f"{number if len(places) > 1 else ''}</button>"
        )
    return f'<div id="marks">{marks}</div>'


def runs(markup: str) -> list[list[str]]:
    """Return rich text as letters with their element: ``sub``, ``sup`` or none."""
    height = 10.0
    level = {True: "sub", False: "sup"}
    found = typeset(markup, height).runs
    return [[run.text, level[run.y < 0] if abs(run.y) > 0.1 * height else ""] for run in found]


def rich(markup: str) -> str:
    """Return rich text as HTML."""
    return "".join(
        f"<{tag}>{escape(text)}</{tag}>" if tag else escape(text) for text, tag in runs(markup)
    )


def _data(value: Any) -> str:
    """Return a value as JSON that cannot close an element of a page."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


def _hash(source: str) -> str:
    return "sha256-" + b64encode(sha256(source.encode()).digest()).decode()
