"""SVG sheets of planmethod: the vectors of their plans and the letters (чтение SVG)."""

from __future__ import annotations

import re
from cmath import exp, pi
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from lxml import etree

from planmethod.check.measured.drawing import MeasuredDrawing
from planmethod.check.submissions.faults import SubmissionError, read_bytes
from planmethod.render.backends.layers import FIGURES, VECTORS, layer_of
from planmethod.render.ink.drawing import Pen

SIZE_LIMIT = 8 * 1024 * 1024
TIP_MM = 8.0
"""Maximum gap between the end of a thick line and the tip of its arrow, mm."""

CAPITAL = 0.7
"""Height of the letters of a text, a share of the size of its font."""

WIDE = 0.6
"""Width of a single letter, in its heights."""

_SVG = "{http://www.w3.org/2000/svg}"
_STEP = re.compile(r"([A-Za-z])|(-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?)")
_TURN = re.compile(r"rotate\((-?[\d.]+) ")


def read_svg(path: Path) -> MeasuredDrawing:
    """Return the vectors and letters of one of our own sheets.

    Raises
    ------
    WorksError
        It is not an SVG, or not from planmethod.
    """
    data = read_bytes(path, SIZE_LIMIT)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise SubmissionError("{}: this is not an SVG file: {}.", path, str(error)[:80]) from None
    if root.tag != f"{_SVG}svg" or not str(root.get("height", "")).endswith("mm"):
        raise SubmissionError("{}: this is not an SVG sheet of planmethod. Save it as DXF.", path)
    drawing = MeasuredDrawing(path)
    try:
        _read_elements(root, drawing)
    except ValueError as error:
        raise SubmissionError("{}: this is not an SVG file: {}.", path, str(error)[:80]) from None
    return drawing


def _read_elements(root: Any, drawing: MeasuredDrawing) -> None:
    held: tuple[str, list[complex]] | None = None
    for element in root.iter(f"{_SVG}path", f"{_SVG}text"):
        if element.tag == f"{_SVG}text":
            _text(element, drawing)
            continue
        tag = element.get("data-tag", "")
        layer = layer_of(tag, Pen.THIN)
        if layer not in (VECTORS, FIGURES):
            continue
        corners = list(_corners(element.get("d", "")))
        if str(element.getparent().get("class", "")).startswith("ink-"):
            if held is not None and corners and held[0] == tag:
                held = (tag, _to_tip(held[1], corners[0]))
            continue
        if held is not None:
            drawing.line(held[1], layer_of(held[0], Pen.THIN), 0)
        held = tag, corners
    if held is not None:
        drawing.line(held[1], layer_of(held[0], Pen.THIN), 0)


def _to_tip(corners: list[complex], tip: complex) -> list[complex]:
    """Return a line up to the tip of its arrow."""
    near = len(corners) == 2 and abs(tip - corners[-1]) < TIP_MM
    return [corners[0], tip] if near else corners


def _corners(data: str) -> Iterator[complex]:
    """Yield the corners of a path of straight lines, y up; none from where it bends."""
    command, numbers, at, start = "", list[float](), 0j, 0j
    for step in _STEP.finditer(data):
        if step[1]:
            command = step[1]
            if command in "Zz":
                yield start.conjugate()
            elif command not in "MmLl":
                return
            continue
        numbers.append(float(step[2]))
        if len(numbers) == 2:
            to = complex(*numbers)
            at = at + to if command in "ml" else to
            if command in "Mm":
                start = at
                command = "l" if command == "m" else "L"
            numbers.clear()
            yield at.conjugate()


def _text(element: Any, drawing: MeasuredDrawing) -> None:
    text = element.text or ""
    size = float(element.get("font-size") or element.getparent().get("font-size") or 5.0)
    high = CAPITAL * size
    wide = float(element.get("textLength") or WIDE * high * len(text))
    turned = _TURN.match(element.get("transform") or "")
    along = exp(-1j * float(turned[1]) * pi / 180.0) if turned else 1.0 + 0j
    corner = complex(float(element.get("x", 0)), -float(element.get("y", 0)))
    across = abs(along.real) * wide + abs(along.imag) * high
    tall = abs(along.imag) * wide + abs(along.real) * high
    drawing.text(text, corner + along * complex(wide / 2, high / 2), across, tall)
