"""New DXF file of one sheet: line types, layers, text style, printed area."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from math import atan, degrees
from types import MappingProxyType
from typing import Any

import ezdxf
from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS

from planmethod.render.backends.canvas import COLOURED_LAYERS, LAYERS
from planmethod.render.backends.dxf_texts import clean
from planmethod.render.ink.drawing import Drawing, Pen
from planmethod.render.ink.pens import PENS, PenSet

_LIBRARY: Any = ezdxf  # its types are of the parts only

# LibreCAD takes the font that is called as the style, and this one of its own has Russian and Greek
# letters; others take the font of the style, the one of CAD programs that is nearest GOST 2.304.
TEXT_STYLE, FONT = "lc_opengost-br", "isocpeur.ttf"

# Standard names with the dashes of GOST 2.303: LibreCAD goes by the name, and draws whole what it
# does not know; AutoCAD goes by the pattern.
LINE_TYPES: Mapping[Pen, str] = MappingProxyType(
    {
        Pen.AXIS: "CENTER",
        Pen.THICK_AXIS: "DASHDOT",
        Pen.PHANTOM: "DIVIDE",
        Pen.HIDDEN: "DASHED",
    }
)


def nearest_weight(width: float) -> int:
    """Return the line weight of the standard nearest to a width in mm, hundredths of a mm."""
    return min(VALID_DXF_LINEWEIGHTS, key=lambda weight: abs(weight - width * 100.0))


def true_colour(colour: tuple[int, int, int]) -> int:
    """Return a colour as one number."""
    return int.from_bytes(bytes(colour), "big")


def pen_of_layer(name: str) -> Pen:
    """Return the pen whose width and dashes the lines of a layer have."""
    return LAYERS.get(name, Pen.THIN)


def colour_of_layer(name: str, pens: PenSet) -> tuple[int, int, int]:
    """Return the colour of a layer."""
    of_vectors = COLOURED_LAYERS.get(name) if pens.is_coloured else None
    return pens.colour(of_vectors or pen_of_layer(name))


@contextmanager
def without_clock() -> Iterator[None]:
    """Make the library's output free of time and chance: same drawing, same bytes."""
    options = _LIBRARY.options
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


def new_document(drawing: Drawing, author: str) -> Any:
    """Return an empty file for a sheet."""
    with without_clock():
        document = _LIBRARY.new("R2010", units=4)  # millimetres
    width, height = drawing.width, drawing.height
    space = document.modelspace()
    header = document.header
    header["$LTSCALE"] = 1.0
    header["$LWDISPLAY"] = 1
    header["$EXTMIN"], header["$EXTMAX"] = (0.0, 0.0, 0.0), (width, height, 0.0)
    space.reset_extents((0.0, 0.0, 0.0), (width, height, 0.0))
    space.reset_limits((0.0, 0.0), (width, height))
    header.custom_vars.append("Title", clean(drawing.title))
    header.custom_vars.append("Author", clean(author))
    middle = (width / 2, height / 2)
    document.set_modelspace_vport(height * 1.05, center=middle)
    # The default printed area: the whole sheet, 1:1.
    header["$PSVPSCALE"] = 1.0
    paper = document.paperspace()
    paper.page_setup(size=(width, height), scale=(1, 1))
    paper.reset_extents((0.0, 0.0, 0.0), (width, height, 0.0))
    paper.reset_limits((0.0, 0.0), (width, height))
    window = paper.add_viewport(middle, (width, height), middle, height)
    for viewport in (paper.main_viewport(), window):
        viewport.dxf.layer = "Defpoints"  # its lines are never printed
    document.set_wipeout_variables(frame=0)
    # Otherwise the library adds them in the order of a set, which differs between processes.
    for name in ("ACDBPLACEHOLDER", "LAYOUT", "WIPEOUT", "WIPEOUTVARIABLES"):
        document.classes.add_class(name)
    for pen, name in LINE_TYPES.items():
        dashes = PENS[pen].dashes
        assert dashes is not None
        whole = dashes.stroke + dashes.gap
        document.linetypes.add(name, [whole, *dashes.period], description="GOST 2.303")
    for name in {**LAYERS, **(COLOURED_LAYERS if drawing.pens.is_coloured else {})}:
        pen = pen_of_layer(name)
        layer = document.layers.add(
            name,
            color=7,
            lineweight=nearest_weight(drawing.pens.width(pen)),
            linetype=LINE_TYPES.get(pen, "Continuous"),
        )
        if any(colour := colour_of_layer(name, drawing.pens)):
            layer.dxf.true_color = true_colour(colour)
    document.styles.add(TEXT_STYLE, font=FONT).dxf.oblique = slant_of(drawing)
    return document


def slant_of(drawing: Drawing) -> float:
    """Return the slant of the letters of a sheet, degrees from upright."""
    return degrees(atan(drawing.lettering.style.lean))
