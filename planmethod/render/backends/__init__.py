"""Output formats: one module each, imported only when it is needed."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec

from planmethod.errors import OutputError
from planmethod.render.backends.canvas import Canvas, Options, draw_sheet
from planmethod.render.ink.drawing import Drawing

__all__ = ["BACKENDS", "PAGED", "Canvas", "Options", "render", "render_pages"]


DXF_NEEDS = "DXF needs ezdxf: pip install ezdxf"


def is_absent(fmt: str) -> bool:
    """Return whether the library that a format needs is absent, without importing it."""
    return fmt == "dxf" and find_spec("ezdxf") is None


BACKENDS = ("svg", "pdf", "png", "dxf")
"""Output formats: the suffixes of their files."""

PAGED = frozenset({"pdf"})
"""Formats whose files have pages: their canvases draw several sheets."""


def render(drawing: Drawing, fmt: str, *, options: Options | None = None) -> bytes:
    """Return the file of ``drawing`` in the format ``fmt``.

    Parameters
    ----------
    drawing
        The display list.
    fmt
        One of `BACKENDS`: ``"svg"``, ``"pdf"``, ``"png"`` or ``"dxf"``.
    options
        Resolution and the like. Default: `Options()`.

    Raises
    ------
    OutputError
        There is no such format, the picture would be too large for it, or its library is absent.
    """
    canvas = make_canvas(fmt, options or Options())
    draw_sheet(drawing, canvas)
    return canvas.close()


def render_pages(
    drawings: Sequence[Drawing], fmt: str = "pdf", *, options: Options | None = None
) -> bytes:
    """Return one file with a page for each drawing, every page as large as its sheet.

    Parameters
    ----------
    drawings : sequence of Drawing
        At least one; the title of the first one is that of the file.
    fmt : str
        One of `PAGED`.

    Raises
    ------
    OutputError
        The format has no pages, or ``drawings`` is empty; and as `render`.
    """
    if fmt not in PAGED:
        raise OutputError("'{}' has no pages. Use one of: {}.", fmt, ", ".join(sorted(PAGED)))
    if not drawings:
        raise OutputError("The file would have no sheets. Draw at least one.")
    canvas = make_canvas(fmt, options or Options())
    for drawing in drawings:
        draw_sheet(drawing, canvas)
    return canvas.close()


def make_canvas(fmt: str, options: Options) -> Canvas:
    """Return an empty canvas of an output format."""
    if is_absent(fmt):
        raise OutputError(DXF_NEEDS)
    match fmt:
        case "svg":
            from planmethod.render.backends.svg import SvgCanvas

            return SvgCanvas(options)
        case "pdf":
            from planmethod.render.backends.pdf import PdfCanvas

            return PdfCanvas(options)
        case "png":
            from planmethod.render.backends.png import PngCanvas

            return PngCanvas(options)
        case "dxf":
            from planmethod.render.backends.dxf import DxfCanvas

            return DxfCanvas(options)
    raise OutputError("Unknown format '{}'. Use one of: {}.", fmt, ", ".join(BACKENDS))
