"""A format that draws nothing: the template of a new one, and the cost of a replay by itself."""

from __future__ import annotations

from planmethod.render.backends.canvas import Options
from planmethod.render.ink.drawing import Arc, Disc, Fill, Stroke, Text
from planmethod.render.ink.lettering import OutlineLettering


class NullCanvas:
    """Do-nothing canvas: copy it and fill in the verbs."""

    def __init__(self, options: Options) -> None:
        self.options = options

    def open(self, width: float, height: float, title: str, lettering: OutlineLettering) -> None:
        """Begin a sheet of ``width`` by ``height`` mm."""

    def stroke(self, item: Stroke) -> None:
        """Draw ``stroke_lines(item)`` with the pen ``PENS[item.pen]``."""

    def arc(self, item: Arc) -> None:
        """Draw every span of ``arc_spans(item)``."""

    def fill(self, item: Fill | Disc) -> None:
        """Fill the polygon or circle with ``item.ink``."""

    def text(self, item: Text) -> None:
        """Draw the outlines of the sheet's lettering or the same font."""

    def close(self) -> bytes:
        """Return the file."""
        return b""
