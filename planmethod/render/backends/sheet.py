"""Sheets of one problem for a program: as files, bytes or pictures (листы)."""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from planmethod.arguments import number_of
from planmethod.errors import OutputError
from planmethod.render.backends import BACKENDS, PAGED, render, render_pages
from planmethod.render.backends.canvas import Options, draw_sheet
from planmethod.render.ink.drawing import Drawing


class Sheet(Sequence[Drawing]):
    """Drawn sheets of one problem: mostly one, which a notebook shows (лист).

    Parameters
    ----------
    drawings : sequence of Drawing

    Raises
    ------
    OutputError
        The list of drawings is empty.

    Examples
    --------
    >>> import planmethod
    >>> sheet = planmethod.solve(planmethod.load("problems/linkages/ex3.toml")).sheet(lang="en")
    >>> sheet
    Sheet(594 × 420 mm)
    >>> sheet.to_pdf()[:5]
    b'%PDF-'
    """

    def __init__(self, drawings: Sequence[Drawing]) -> None:
        if not drawings:
            raise OutputError("The file would have no sheets. Draw at least one.")
        self._drawings = tuple(drawings)

    def __getitem__(self, index: Any) -> Any:
        """Return the display list of one sheet."""
        return self._drawings[index]

    def __len__(self) -> int:
        return len(self._drawings)

    def __repr__(self) -> str:
        first = self._drawings[0]
        more = f", {len(self)} sheets" if len(self) > 1 else ""
        return f"Sheet({first.width:g} × {first.height:g} mm{more})"

    def _repr_svg_(self) -> str:
        """Return the picture that a notebook shows: the first sheet."""
        return self.to_svg()

    def _drawing(self, number: int) -> Drawing:
        return self._drawings[number_of("number", number, len(self))]

    def to_svg(self, number: int = 0) -> str:
        """Return a sheet as SVG; ``number`` from 0."""
        return render(self._drawing(number), "svg").decode()

    def to_png(self, number: int = 0, *, dpi: float = 100.0) -> bytes:
        """Return a sheet as PNG."""
        return render(self._drawing(number), "png", options=Options(dpi=dpi))

    def to_dxf(self, number: int = 0) -> bytes:
        """Return a sheet as DXF.

        Raises
        ------
        OutputError
            ezdxf is not installed.
        """
        return render(self._drawing(number), "dxf")

    def to_pdf(self) -> bytes:
        """Return all sheets as one PDF."""
        return render_pages(self._drawings)

    def to_axes(self, axes: Any, number: int = 0) -> None:
        """Draw a sheet on axes of matplotlib, in millimetres."""
        from planmethod.render.backends.axes import AxesCanvas  # matplotlib is slow to import

        draw_sheet(self._drawing(number), AxesCanvas(axes))

    def save(self, path: str | Path) -> None:
        """Write a file in the format of its suffix: all sheets of a PDF, else the first one.

        Raises
        ------
        OutputError
            There is no such format.
        """
        path = Path(path)
        suffix = path.suffix.removeprefix(".").lower()
        if suffix not in BACKENDS:
            raise OutputError("Unknown format '{}'. Use one of: {}.", suffix, ", ".join(BACKENDS))
        path.write_bytes(self.to_pdf() if suffix in PAGED else render(self._drawings[0], suffix))
