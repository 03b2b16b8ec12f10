"""Lettering behind one interface: widths and outlines of the letters, whatever their source.

`Lettering` is all that the rest of the renderer knows of letters; `LETTERING` is the one in use.
"""

from __future__ import annotations

from typing import Protocol


class Lettering(Protocol):
    """What drawing needs of a lettering (шрифт); heights are cap heights h in mm."""

    name: str

    def width(self, text: str, height: float) -> float:
        """Return the advance of a run of letters, mm."""
        ...

    def ascent(self, text: str, height: float) -> float:
        """Return how far the ink of this run rises above the base line, mm."""
        ...

    def descent(self, text: str, height: float) -> float:
        """Return how far the ink of this run goes below the base line, mm (positive)."""
        ...
