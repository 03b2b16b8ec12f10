"""Axes of matplotlib: a sheet as lines and areas in a figure of the user, in millimetres."""

from __future__ import annotations

from typing import Any

from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.transforms import Affine2D

from planmethod.render.backends.canvas import Options
from planmethod.render.backends.png import PngCanvas
from planmethod.render.ink.drawing import Drawing, Pen, Text
from planmethod.render.ink.pens import PENS


class AxesCanvas(PngCanvas):
    """Canvas that adds the strokes to axes; the widths of pens fit their present size."""

    def __init__(self, axes: Any) -> None:
        super().__init__(Options())
        self._axes = axes
        self._points_per_mm = 1.0

    def open(self, drawing: Drawing) -> None:
        """Set the limits of the axes to the sheet."""
        self._lettering, self._pens = drawing.lettering, drawing.pens
        axes = self._axes
        axes.set(xlim=(0.0, drawing.width), ylim=(0.0, drawing.height), aspect="equal")
        axes.set_axis_off()
        box = axes.get_window_extent()
        per_mm = min(box.width / drawing.width, box.height / drawing.height)
        self._points_per_mm = per_mm * 72.0 / axes.figure.dpi

    def _add(self, path: Path, **looks: Any) -> None:
        self._axes.add_patch(PathPatch(path, joinstyle="round", **looks))

    def _paint(self, path: Path, colour: tuple[int, int, int]) -> None:
        self._add(path, facecolor=[part / 255 for part in colour], linewidth=0)

    def _ink_pen(self, pen: Pen, path: Path) -> None:
        colour = [part / 255 for part in self._pens.colour(pen)]
        width = self._pens.width(pen) * self._points_per_mm
        self._add(path, fill=False, edgecolor=colour, linewidth=width, capstyle=PENS[pen].cap)

    def _ink_letter(self, item: Text, path: Path, place: Affine2D) -> None:
        width = self._thickness(item) * self._points_per_mm
        letter = place.transform_path(path)
        self._add(letter, fill=False, edgecolor="black", linewidth=width, capstyle="round")

    def close(self) -> bytes:
        """Return nothing: the figure is the user's."""
        return b""
