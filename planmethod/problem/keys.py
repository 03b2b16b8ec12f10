"""Every key the reader knows, table by table: the docs and the schema are tested against it.

Keys of flat tables are those of the records in `FLAT`; those of the other tables are here.
"""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.languages import LANGUAGES
from planmethod.problem.machine_records import (
    CounterweightTask,
    CycleTask,
    FlywheelTask,
    Machine,
    PoleDistances,
    ProjectTask,
)
from planmethod.problem.mesh_records import MeshSection, RollingSection
from planmethod.problem.model import Letters, Scales
from planmethod.problem.motor_records import (
    CatalogueMotor,
    KlossSection,
    LineSection,
    MotorSection,
)
from planmethod.problem.records import (
    LETTERINGS,
    TITLE_BLOCK,
    TITLE_BLOCK_IN,
    TITLE_FORMS,
    BalancingForceTask,
    BearingSection,
    Dynamics,
    FrictionTask,
    LoadEntry,
    Mass,
    PairFriction,
    Phase,
    Published,
    QuestionSpec,
    SheetSettings,
    Spring,
)
from planmethod.problem.tables import (
    CamMotionEntry,
    CamSection,
    GearWheelSection,
    HigherPairSection,
    MeshingSection,
    PictureSection,
    PlanetaryTask,
    ShaftCamSection,
    SynthesisSection,
    declared,
)

OF_KINDS: Mapping[str, str] = {
    "gears": "a gear train",
    "point": "a moving point",
    "meshing": "two wheels in mesh",
    "cam": "a cam mechanism",
    "cams": "several cams on one shaft",
}
"""Tables by which a file is of another kind than linkages, which reads them, and what they
describe."""

READING = ("reading", "other_readings")
"""Keys of a linkage or train file whose scheme is one of several matching the data."""

TOP = (
    "title", "source", *READING, "units", "frame", "drawn", "links", "driver", "drivers",
    "assembly",
    "scales", "stamp", "sheet", "published", "answers", "compare", "variants", "dynamics", "loads",
    "springs", "machine", "motors",
    "balancing", "balancing_force", "friction", "bearings", "letters", "cycle",
    "project", "higher_pairs", "meshes", "synthesis", *OF_KINDS,
)  # fmt: skip
FRAME = ("guides", "number")
GUIDE = ("through", "angle")
DRAWN = ("s", "points", "round")
"""Keys of ``[drawn]`` that have no names of links or points."""
LINK = ("points", "slides", "angle", "rolls")
SLIDES = ("on", "along", "through", "angle", "offset", "length", "centre", "radius")
ARC = ("on", "centre", "radius")
"""Keys of a slide along a circle."""
POINT_FORMS = {
    "side": ("side",),
    "on": ("on", "at", "across"),
    "from": ("from", "at", "across"),
    "vertex": ("vertex", "ray", "angle", "distance"),
}
"""Keys of the form of a third point, each with the keys that belong to it."""
POINT = tuple(dict.fromkeys(key for form in POINT_FORMS.values() for key in form))
EFFORTS = ("torque", "force")
"""Keys of the driver of which one drives it, so that its acceleration follows."""
CRANK = ("phi", "omega", "n", "train", "epsilon", "cam")
SLIDER = ("s", "v", "a", "cam")
POSED = ("x", "y", "phi")
"""Keys of the driver that give a position by the output, each with a name: ``x_B``, ``phi_3``."""
GOING = {
    "x": ("right", "left"),
    "y": ("up", "down"),
    "phi": ("ccw", "cw"),
    "stroke": ("forth", "back"),
}
"""Directions of the output: forward along its coordinate, and back."""
EXTREMES = ("left", "right", "upper", "lower")
PLACES = ("phi", "s", "stroke", "at")
DRIVER = ("link", *dict.fromkeys((*CRANK, *SLIDER)), "stroke", "at", "root", *EFFORTS)
SPAN = ("from", "to", "step", "count")
RULE = ("near", "rule", "keep")
ASSEMBLY_FLAGS = ("parallel", "continuous")
MOVING = ("x", "y", "r", "phi", "s", "radius", "wheel", "theta", "t", "show")
"""Keys of ``[point]``."""
ROLLING = ("radius", "r", "angle", "on", "within", "arm")
"""Keys of ``point.wheel``."""
CONFIG = ("stamp", "sheet")
INDICATOR = ("strokes", "area", "sides", "area_2", "like", "shift")
"""Keys of a table that is an indicator diagram."""
LIKE = ("like", "shift")
"""Keys of a diagram that is another piston's, later."""
TABLE = ("law", "over", "values", "interpolation", *INDICATOR)
MOTOR_FORMS = {
    "kloss": (("M_max", "s_k", "n_sync"), ("P_nom", "n_nom", "n_sync", "lambda")),
    "line": (("M_start", "n_idle"), ("M_nom", "n_nom", "n_idle")),
}
"""Numbers of each way to give a motor's characteristic."""
GEARS = (
    "wheels", "meshes", "bodies", "fixed", "n", "omega", "unknown", "coaxial", "module",
    "satellites", "output", "ask", "picture", "design",
)  # fmt: skip
MESH = ("of", "kind", "carrier", "eta", "hand")
FLAT: Mapping[str, type[object]] = {
    "cycle": CycleTask, "pole": PoleDistances, "scales": Scales, "sheet": SheetSettings,
    "published": Published, "answer": QuestionSpec, "dynamics": Dynamics, "mass": Mass,
    "load": LoadEntry, "spring": Spring, "phases": Phase, "machine": Machine,
    "flywheel": FlywheelTask,
    "motor": MotorSection, "kloss": KlossSection, "line": LineSection,
    "catalogue_motor": CatalogueMotor,
    "balancing": CounterweightTask, "wheel": GearWheelSection, "picture": PictureSection,
    "design": PlanetaryTask, "meshing": MeshingSection,
    "project": ProjectTask, "higher": HigherPairSection, "toothed": MeshSection,
    "rolls": RollingSection, "balancing_force": BalancingForceTask,
    "friction": FrictionTask, "pair": PairFriction, "bearing": BearingSection, "cam": CamSection,
    "shaft_cam": ShaftCamSection,
    "motion": CamMotionEntry,
    "letters": Letters, "synthesis": SynthesisSection,
}  # fmt: skip
"""Records of flat tables by the kind of table."""

EXTENDED: Mapping[str, str] = {"shaft_cam": "cam"}
"""Kinds of table that have all keys of another one besides their own."""

OTHER_TABLES: Mapping[str, tuple[str, ...]] = {
    "top": TOP, "frame": FRAME, "guide": GUIDE, "drawn": DRAWN, "link": LINK,
    "slides": SLIDES, "point": POINT,
    "driver": DRIVER, "span": SPAN, "rule": RULE, "moving": MOVING, "rolling": ROLLING,
    "stamp": (*TITLE_BLOCK, *TITLE_BLOCK_IN), "table": TABLE, "gears": GEARS, "mesh": MESH,
}  # fmt: skip
"""Keys of the other tables."""

CHOICES = {"form": TITLE_FORMS, "lettering": LETTERINGS, "lang": LANGUAGES}
"""Keys of ``[sheet]`` that take one of some names."""

KINDS = (*OTHER_TABLES, *FLAT)


def known(kind: str) -> tuple[str, ...]:
    """Return the keys of a kind of table; none of one that there is not."""
    if kind in FLAT:
        own = tuple(field.name for field in declared(FLAT[kind]))
        return (*own, *known(EXTENDED[kind])) if kind in EXTENDED else own
    return OTHER_TABLES.get(kind, ())


POINT_LIMIT = 400
LINK_POINT_LIMIT = 60
LINK_KEY_LIMIT = 200
LINK_LIMIT = 201
POSITION_LIMIT = 10_000
CYCLE_LIMIT = 360
VARIANT_LIMIT = 10_000
PUBLISHED_LIMIT = 1000
LOAD_LIMIT = 200
SPRING_LIMIT = 50
MOTOR_LIMIT = 60
CAM_LIMIT = 24
ANSWER_LIMIT = 200
HIGHER_LIMIT = 20
ROW_LIMIT = POSITION_LIMIT
