"""Every key the reader knows, table by table: the docs and the schema are tested against it."""

from __future__ import annotations

from planmethod.languages import LANGUAGES

TOP = (
    "title",
    "source",
    "frame",
    "links",
    "driver",
    "assembly",
    "scales",
    "stamp",
    "sheet",
    "published",
    "variants",
    "dynamics",
    "loads",
    "gears",
    "point",
)
FRAME = ("guides",)
GUIDE = ("through", "angle")
LINK = ("points", "slides")
SLIDES = ("on", "along", "through", "angle", "offset", "length")
POINT_FORMS = {
    "side": ("side",),
    "on": ("on", "at", "across"),
    "from": ("from", "at", "across"),
    "vertex": ("vertex", "ray", "angle", "distance"),
}
"""The key that tells how a third point is given, and the keys that go with it."""
POINT = tuple(dict.fromkeys(key for form in POINT_FORMS.values() for key in form))
CRANK = ("phi", "omega", "n", "epsilon")
SLIDER = ("s", "v", "a")
DRIVER = ("link", *CRANK, *SLIDER)
SPAN = ("from", "to", "step", "count")
RULE = ("near", "rule", "keep")
KEEP = ("parallel", "continuous")
SCALES = ("convention", "mu_l", "mu_v", "mu_a", "mu_F")
STAMP = (
    "organisation",
    "department",
    "group",
    "author",
    "checker",
    "t_control",
    "norm_control",
    "approver",
    "extra",
    "extra_role",
    "designation",
    "title",
    "material",
    "subject",
    "letter",
    "mass",
    "scale",
    "sheet",
    "sheets",
    "date",
    "author_date",
    "checker_date",
    "t_control_date",
    "norm_control_date",
    "approver_date",
    "extra_date",
    "inventory",
    "inventory_instead",
    "inventory_copy",
    "reference",
    "first_use",
)
SHEET = ("paper", "form", "graph_26", "graphs_27_30", "side_columns", "lettering", "lang")
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
TABLE = ("over", "values", "interpolation")
PHASES = ("phi", "moving", "turning")
PUBLISHED = ("value", "unit", "per_mm", "what", "note", "position")

KNOWN: dict[str, tuple[str, ...]] = {
    "top": TOP,
    "frame": FRAME,
    "guide": GUIDE,
    "link": LINK,
    "slides": SLIDES,
    "point": POINT,
    "driver": DRIVER,
    "span": SPAN,
    "rule": RULE,
    "scales": SCALES,
    "stamp": STAMP,
    "sheet": SHEET,
    "published": PUBLISHED,
    "dynamics": DYNAMICS,
    "mass": MASS,
    "load": LOAD,
    "table": TABLE,
    "phases": PHASES,
}
"""All of them by the kind of table."""

POINT_LIMIT = 400
LINK_POINT_LIMIT = 60
LINK_KEY_LIMIT = 200
LINK_LIMIT = 60
POSITION_LIMIT = 10_000
VARIANT_LIMIT = 400
PUBLISHED_LIMIT = 1000
LOAD_LIMIT = 200
ROW_LIMIT = POSITION_LIMIT
