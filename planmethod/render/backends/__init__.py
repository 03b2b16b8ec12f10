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


BACKENDS: Mapping[str, Callable[[Options], Canvas]] = MappingProxyType(
    {"svg": _svg, "pdf": _pdf, "png": _png}
)
"""Output formats by the suffix of their files. A canvas draws one sheet."""


def render(drawing: Drawing, fmt: str, *, options: Options | None = None) -> bytes:
    """Return the file of ``drawing`` in the format ``fmt``.

    Parameters
    ----------
    drawing
        The display list.
    fmt
        A key of `BACKENDS`: ``"svg"``, ``"pdf"`` or ``"png"``.
    options
        Resolution and the like; the defaults when absent.

    Raises
    ------
    OutputError
        There is no such format, or the picture would be too large for it.
    """
    make = BACKENDS.get(fmt)
    if make is None:
        raise OutputError(f"Unknown format '{fmt}'. Use one of: {', '.join(BACKENDS)}.")
    return replay(drawing, make(options or Options()))
