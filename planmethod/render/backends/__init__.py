"""Output formats: one module each, imported only when it is asked for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import MappingProxyType

from planmethod.errors import OutputError
from planmethod.render.backends.canvas import Canvas, Options, replay
from planmethod.render.drawing import Drawing

__all__ = ["BACKENDS", "Canvas", "Options", "render", "replay"]


def _svg(options: Options) -> Canvas:
    from planmethod.render.backends.svg import SvgCanvas

    return SvgCanvas(options)


def _pdf(options: Options) -> Canvas:
    from planmethod.render.backends.pdf import PdfCanvas

    return PdfCanvas(options)


def _png(options: Options) -> Canvas:
    from planmethod.render.backends.png import PngCanvas

    return PngCanvas(options)


def _dxf(options: Options) -> Canvas:
    if is_absent("dxf"):
        raise OutputError(DXF_NEEDS)
    from planmethod.render.backends.dxf import DxfCanvas

    return DxfCanvas(options)


DXF_NEEDS = "DXF needs ezdxf: pip install 'planmethod[dxf]'"


def is_absent(fmt: str) -> bool:
    """Return whether a format cannot be written for want of a library, without importing it."""
    from importlib.util import find_spec

    return fmt == "dxf" and find_spec("ezdxf") is None


BACKENDS: Mapping[str, Callable[[Options], Canvas]] = MappingProxyType(
    {"svg": _svg, "pdf": _pdf, "png": _png, "dxf": _dxf}
)
"""Output formats by the suffix of their files. A canvas draws one sheet."""


def render(drawing: Drawing, fmt: str, *, options: Options | None = None) -> bytes:
    """Return the file of ``drawing`` in the format ``fmt``.

    Parameters
    ----------
    drawing
        The display list.
    fmt
        A key of `BACKENDS`: ``"svg"``, ``"pdf"``, ``"png"`` or ``"dxf"``.
    options
        Resolution and the like; the defaults when absent.

    Raises
    ------
    OutputError
        There is no such format, the picture would be too large for it, or its library is absent.
    """
    make = BACKENDS.get(fmt)
    if make is None:
        raise OutputError(f"Unknown format '{fmt}'. Use one of: {', '.join(BACKENDS)}.")
    return replay(drawing, make(options or Options()))
