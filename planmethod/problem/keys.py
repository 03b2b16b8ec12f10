"""Every key the reader knows, table by table: the docs and the schema are tested against it."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from planmethod.languages import LANGUAGES

TOP = (
    "title", "source", "units", "frame", "links", "driver", "assembly", "scales", "stamp",
    "sheet", "published", "answers", "compare", "variants", "dynamics", "loads", "machine",
    "balancing", "gears", "point", "cycle", "meshing",
)  # fmt: skip
UNITS: Mapping[str, float] = MappingProxyType({"m": 1.0, "cm": 100.0, "mm": 1000.0})
"""Units in which a file may give its lengths: how many of them a metre has."""
FRAME = ("guides",)
GUIDE = ("through", "angle")
LINK = ("points", "slides", "angle")
SLIDES = ("on", "along", "through", "angle", "offset", "length", "centre", "radius")
ARC = ("on", "centre", "radius")
"""Keys of a slide along a circle."""
POINT_FORMS = {
    "side": ("side",),
    "on": ("on", "at", "across"),
    "from": ("from", "at", "across"),
    "vertex": ("vertex", "ray", "angle", "distance"),
}
"""The key that tells how a third point is given, and the keys that go with it."""
POINT = tuple(dict.fromkeys(key for form in POINT_FORMS.values() for key in form))
CRANK = ("phi", "omega", "n", "train", "epsilon")
SLIDER = ("s", "v", "a")
POSED = ("x", "y", "phi")
"""Keys of the driver that tell a position by the output, each with a name: ``x_B``, ``phi_3``."""
GOING = {
    "x": ("right", "left"),
    "y": ("up", "down"),
    "phi": ("ccw", "cw"),
    "stroke": ("forth", "back"),
}
"""Which way the output goes: forward of its coordinate, and back."""
EXTREMES = ("left", "right", "upper", "lower")
PLACES = ("phi", "s", "stroke", "at")
DRIVER = ("link", *CRANK, *SLIDER, "stroke", "at", "root")
SPAN = ("from", "to", "step", "count")
RULE = ("near", "rule", "keep")
KEEP = ("parallel", "continuous")
MOVING = ("x", "y", "r", "phi", "s", "radius", "wheel", "theta", "t", "show")
"""Keys of ``[point]``."""
CYCLE = ("output", "zero", "count", "length", "pole", "differentiation")
POLE = ("v", "a")
ROLLING = ("radius", "r", "angle", "on", "within", "arm")
"""Keys of ``point.wheel``."""
SCALES = ("convention", "mu_l", "mu_v", "mu_a", "mu_F")
STAMP = (
    "organisation", "department", "group", "author", "checker", "t_control", "norm_control",
    "approver", "extra", "extra_role", "designation", "title", "material", "subject", "letter",
    "mass", "scale", "sheet", "sheets", "date", "author_date", "checker_date", "t_control_date",
    "norm_control_date", "approver_date", "extra_date", "inventory", "inventory_instead",
    "inventory_copy", "reference", "first_use",
)  # fmt: skip
"""Fields of the title block, all of them optional; what they are: docs/title-block.md."""

SHEET = ("paper", "form", "graph_26", "graphs_27_30", "side_columns", "lettering", "lang", "traces")
FORMS = ("1", "1+2a", "2", "2a")
"""Forms of the title block: of every sheet, or of the first and of the later ones."""
LETTERINGS = ("A", "A-upright", "B", "B-upright")
"""Types of the lettering of GOST 2.304, slanted where nothing else is said."""
SHEET_CHOICES = {"form": FORMS, "lettering": LETTERINGS, "lang": LANGUAGES}
"""Keys of ``[sheet]`` that take one of some names."""
CONFIG = ("stamp", "sheet")
DYNAMICS = ("gravity", "resultant", "links")
MASS = ("mass", "centre", "inertia")
LOAD = ("name", "link", "at", "force", "couple", "angle", "against", "phases")
TABLE = ("law", "over", "values", "interpolation", "strokes", "area", "sides", "area_2")
INDICATOR = ("strokes", "area", "sides", "area_2")
"""Keys of a table that is an indicator diagram."""
MACHINE = (
    "delta", "mean", "constant", "cycle_deg", "J_crank", "count", "pole_mm", "turn_mm", "mu_M",
    "mu_J", "signs", "ordinates", "method", "phi_0", "flywheel", "motor", "brake",
)  # fmt: skip
MOTOR_FORMS = {
    "kloss": (("M_max", "s_k", "n_sync"), ("P_nom", "n_nom", "n_sync", "lambda")),
    "line": (("M_start", "n_idle"), ("M_nom", "n_nom", "n_idle")),
}
"""Numbers of each way to give a motor's characteristic."""
KLOSS, LINE = (
    tuple(dict.fromkeys(key for form in forms for key in form)) for forms in MOTOR_FORMS.values()
)
MOTOR = (*MOTOR_FORMS, "ratio")
BALANCING = ("method", "share", "radii")
FLYWHEEL = ("shape", "density", "speed", "ratio")
PHASES = ("phi", "moving", "turning")
PUBLISHED = ("value", "unit", "per_mm", "what", "note", "position")
ANSWER = (
    "what", "id", "letters", "unit", "points", "form", "sense", "position", "digits", "segment",
    "tolerance",
)  # fmt: skip

GEARS = (
    "wheels", "meshes", "bodies", "fixed", "n", "omega", "unknown", "coaxial", "module",
    "satellites", "output", "ask", "picture",
)  # fmt: skip
WHEEL = ("z", "r", "x", "axis")
MESH = ("of", "kind", "carrier", "eta", "hand")
PICTURE = ("mu_l", "longest_mm", "pole_mm")
MESHING = (
    "z", "m", "internal", "cutter", "alpha", "ha", "c", "x", "x1", "x2", "a_w", "s_a_min",
    "epsilon_min",
)  # fmt: skip
"""Keys of ``[meshing]``."""

_KINDS = (
    "top", "frame", "guide", "link", "slides", "point", "driver", "span", "rule", "moving",
    "cycle", "pole", "rolling", "scales", "stamp", "sheet", "published", "answer", "dynamics",
    "mass", "load", "table", "phases", "machine", "flywheel", "motor", "balancing", "kloss",
    "line", "gears", "wheel", "mesh", "picture", "meshing",
)  # fmt: skip
KNOWN: dict[str, tuple[str, ...]] = {kind: tuple(globals()[kind.upper()]) for kind in _KINDS}
"""All of them by the kind of table."""

POINT_LIMIT = 400
LINK_POINT_LIMIT = 60
LINK_KEY_LIMIT = 200
LINK_LIMIT = 60
POSITION_LIMIT = 10_000
CYCLE_LIMIT = 360
VARIANT_LIMIT = 400
PUBLISHED_LIMIT = 1000
LOAD_LIMIT = 200
ANSWER_LIMIT = 200
ROW_LIMIT = POSITION_LIMIT
