"""Scheme symbols (условные обозначения кинематических схем, GOST 2.770) as display-list items.

Places are mm of paper, directions are complex numbers of any length (or degrees where a parameter
is called an angle). ``factor`` scales a symbol for a small sheet. Where symbols and links overlap
the order matters: sliders first, links over them, joints last, whose white insides cover the lines.

These are the symbols of schemes and plans; wheels, cams and axes have modules of their own:
`gears`, `cams`, `axes`.
"""

from planmethod.render.symbols.arrows import (
    FORCE,
    PLAN_FORCE,
    arrowhead,
    drive_arrow,
    turn_arrow,
    turn_sign,
    vector_arrow,
)
from planmethod.render.symbols.dimensions import angle_dimension, dimension
from planmethod.render.symbols.grounds import (
    bearing,
    fixed_pivot,
    fixed_pivots,
    ground_line,
    guide_line,
    guide_plates,
    support_half_width,
)
from planmethod.render.symbols.hatching import (
    GROUND,
    before_links,
    clipped,
    hatch,
    occupied_area,
)
from planmethod.render.symbols.links import (
    crank,
    link,
    mass_centre,
    rigid_corner,
    rigid_polygon,
    rocker,
)
from planmethod.render.symbols.pairs import (
    SLIDER,
    mobile_revolute,
    mobile_slider,
    offset_slider,
    revolute,
    revolute_on,
    slider,
    sliding_block,
    sliding_block_size,
)
from planmethod.render.symbols.sizes import SIZES, SymbolSizes, angle_of, unit

__all__ = [
    "FORCE",
    "GROUND",
    "PLAN_FORCE",
    "SIZES",
    "SLIDER",
    "SymbolSizes",
    "angle_dimension",
    "angle_of",
    "arrowhead",
    "bearing",
    "before_links",
    "clipped",
    "crank",
    "dimension",
    "drive_arrow",
    "fixed_pivot",
    "fixed_pivots",
    "ground_line",
    "guide_line",
    "guide_plates",
    "hatch",
    "link",
    "mass_centre",
    "mobile_revolute",
    "mobile_slider",
    "occupied_area",
    "offset_slider",
    "revolute",
    "revolute_on",
    "rigid_corner",
    "rigid_polygon",
    "rocker",
    "slider",
    "sliding_block",
    "sliding_block_size",
    "support_half_width",
    "turn_arrow",
    "turn_sign",
    "unit",
    "vector_arrow",
]
