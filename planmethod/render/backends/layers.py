"""Layers of a DXF file: their names, and the choice of a layer by tag and pen (слои)."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from planmethod.render.ink.drawing import Pen

VECTORS, ARROWS, FIGURES = "PLAN_VECTORS", "PLAN_ARROWS", "PLAN_FIGURES"

LAYERS: Mapping[str, Pen] = MappingProxyType(
    {
        "MAIN": Pen.MAIN,
        "THIN": Pen.THIN,
        "FRAME": Pen.FRAME,
        "AXIS": Pen.AXIS,
        "THICK_AXIS": Pen.THICK_AXIS,
        "PHANTOM": Pen.PHANTOM,
        "HIDDEN": Pen.HIDDEN,
        "HATCHING": Pen.HATCH,
        "BREAKS": Pen.BREAK,
        "PALE": Pen.PALE,
        "LINKS": Pen.MAIN,
        "SYMBOLS": Pen.MAIN,
        "MASKS": Pen.THIN,
        VECTORS: Pen.THIN,
        ARROWS: Pen.THIN,
        FIGURES: Pen.THIN,
        "DIAGRAMS": Pen.MAIN,
        "ERRORS": Pen.THIN,
        "TABLES": Pen.THIN,
        "TITLE_BLOCK": Pen.FRAME,
        "TEXT": Pen.THIN,
    }
)
"""Layers, and the pen whose width, dashes and grey they have."""

_OF_PEN = {pen: name for name, pen in reversed(tuple(LAYERS.items()))}
_OF_TAG = {
    "stamp": "TITLE_BLOCK",
    "margin": "TITLE_BLOCK",
    "table": "TABLES",
    "ellipse": "ERRORS",
    "similar": FIGURES,
    "pole": FIGURES,
    "absolute": VECTORS,
    "relative": VECTORS,
    "normal": VECTORS,
    "tangential": VECTORS,
    "coriolis": VECTORS,
    "sliding": VECTORS,
}
_OF_WORD = {
    "plan-force": VECTORS,
    "diagram": "DIAGRAMS",
    "hodograph": "DIAGRAMS",
}
"""By the first word of a tag whose other words are letters."""


def layer_of(tag: str, pen: Pen) -> str:
    """Return the layer of a line with this tag and pen."""
    if tag.startswith("part-of:"):
        return "TEXT"  # the bar over a letter
    if tag.startswith("link ") and pen is Pen.MAIN:
        return "LINKS"
    return _of_tag(tag, _OF_PEN[pen])


def layer_of_area(tag: str) -> str:
    """Return the layer of an area with this tag: of an arrowhead, mostly."""
    layer = _of_tag(tag, "SYMBOLS")
    return ARROWS if layer == VECTORS else layer


def layer_of_text(tag: str) -> str:
    """Return the layer of letters with this tag."""
    return _of_tag(tag, "TEXT")


def _of_tag(tag: str, usual: str) -> str:
    return _OF_TAG.get(tag) or _OF_WORD.get(tag.partition(" ")[0], usual)
