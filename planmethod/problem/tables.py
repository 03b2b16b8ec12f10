"""Flat tables of problem files and the declaration of their keys (таблицы задач)."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Iterator
from types import NoneType
from typing import Annotated, Any, TypeAlias, get_args, get_type_hints

from msgspec import Struct

_SIZE = (1e-6, 1e4)
"""Least and greatest length of a synthesis, m."""

LENGTH_HINT = "Check the unit: the file is in SI units and degrees."


class DeclaredKey(Struct, frozen=True, kw_only=True):
    """Common attributes of keys of every type.

    Attributes
    ----------
    name : str
        Name in the file; empty where it is that of the field.
    required : bool
    missing : str
        Hint where the file lacks a required key.
    absent : str
        Default in words; empty where it is the default of the field.
    """

    name: str = ""
    required: bool = False
    missing: str = ""
    absent: str = ""


class NumberKey(DeclaredKey, frozen=True):
    """A number within bounds.

    Attributes
    ----------
    noun : str
        Expected value, without its unit: ``a density``.
    unit : str
        Empty of a number without dimension.
    positive : bool
        Zero and negative numbers are reported as such, before the bounds are checked.
    hint : str
        Hint for a number out of bounds.
    """

    sentence: str
    noun: str = "a number"
    unit: str = ""
    low: float = -1e9
    high: float = 1e9
    positive: bool = False
    hint: str = LENGTH_HINT

    @property
    def expected(self) -> str:
        """Expected value, with its unit."""
        return f"{self.noun} in {self.unit}" if self.unit else self.noun

    @property
    def unbounded(self) -> bool:
        """True if the upper bound only rejects values that are impossible in a machine."""
        return self.high >= 1e9


class IntegerKey(DeclaredKey, frozen=True):
    """A whole number within bounds."""

    sentence: str
    low: int
    high: int


class AngleKey(DeclaredKey, frozen=True):
    """An angle, degrees."""

    sentence: str


class FlagKey(DeclaredKey, frozen=True):
    """``true`` or ``false``."""

    sentence: str


class TextKey(DeclaredKey, frozen=True):
    """A line of text of at most ``limit`` characters."""

    sentence: str
    limit: int


class WordKey(DeclaredKey, frozen=True):
    """A word of the enumeration that the field has."""

    sentence: str


class ChoiceKey(DeclaredKey, frozen=True):
    """One of some words, in either alphabet and case."""

    sentence: str
    words: tuple[str, ...]


class CustomKey(DeclaredKey, frozen=True):
    """A value with a reader of its own in its table."""

    sentence: str


FlatKey: TypeAlias = (
    NumberKey | IntegerKey | AngleKey | FlagKey | TextKey | WordKey | ChoiceKey | CustomKey
)


class FlatField(Struct, frozen=True):
    """A field of the record of a table with its key.

    Attributes
    ----------
    field, name : str
        Its names in the record and in the file.
    key : FlatKey
    kind : type
        Type of the value.
    """

    field: str
    name: str
    key: FlatKey
    kind: type[Any]


_DECLARED: dict[type[object], tuple[FlatField, ...]] = {}


def declared(record: type[object]) -> tuple[FlatField, ...]:
    """Return the fields of a record that are keys of a table, in their order."""
    if record not in _DECLARED:
        _DECLARED[record] = tuple(_declared(record))
    return _DECLARED[record]


def _declared(record: type[object]) -> Iterator[FlatField]:
    for field, hint in get_type_hints(record, include_extras=True).items():
        for key in getattr(hint, "__metadata__", ()):
            kinds = [kind for kind in get_args(hint.__origin__) if kind is not NoneType]
            kind = kinds[0] if kinds else hint.__origin__
            yield FlatField(field, key.name or field, key, kind)


class HigherPairSection(Struct, frozen=True):
    """Two profiles that touch (высшая пара), as the file has them."""

    name: Annotated[
        str,
        CustomKey(
            "letter of the point of contact", required=True, missing='Name the contact: name = "K".'
        ),
    ]
    links: Annotated[
        tuple[str, ...],
        CustomKey(
            'the two links in contact, `["1", "2"]`; `"0"` is the frame',
            required=True,
            missing='Name the links that touch: links = ["1", "2"].',
        ),
    ]
    centres: Annotated[
        tuple[str, ...],
        CustomKey(
            "centres of curvature of both profiles, a point of each link. If the profile of the "
            "second link is straight: one point, of the first link",
            required=True,
            missing='Name the centres of curvature, a point of each link: centres = ["O", "C"].',
        ),
    ]
    distance: Annotated[
        float | None,
        CustomKey("distance between the centres, m: the sum of the radii, or their difference"),
    ] = None
    slides: Annotated[
        dict[str, object] | None,
        CustomKey(
            "straight profile of the second link, with the keys of "
            "[[links.3.slides]](#links3slides). The offset of the centre is the radius of the "
            "first profile"
        ),
    ] = None
    roller: Annotated[
        str,
        CustomKey(
            "number of the roller that rotates on the second link about its centre. It counts as "
            "a link with its own mobility"
        ),
    ] = ""
    by: Annotated[
        str, CustomKey("number of the link that replaces the pair", absent="the next free number")
    ] = ""


MESHING_EXAMPLE = '[meshing] z = [12, 30], m = 5, x = "blocking"'
MESHING_HINT = "Lengths of [meshing] are millimetres, as the standard has them."


class MeshingSection(Struct, frozen=True, kw_only=True):
    """``[meshing]``: two wheels with involute teeth (эвольвентное зацепление)."""

    z: Annotated[
        tuple[int, int],
        CustomKey("numbers of teeth of the driving wheel 1 and of wheel 2", required=True),
    ]
    m: Annotated[
        float,
        NumberKey("module", "a module", "mm", 0.05, 100.0, hint=MESHING_HINT, required=True),
    ]
    internal: Annotated[
        bool,
        FlagKey(
            "wheel 2 has internal teeth (внутреннее зацепление), and more of them than wheel 1"
        ),
    ] = False
    cutter: Annotated[
        int | None,
        IntegerKey(
            "number of teeth of the pinion cutter (долбяк) for an internal wheel 2; less than "
            "that of the wheel",
            8, 200, absent="20",
        ),
    ] = None  # fmt: skip
    alpha: Annotated[
        float,
        NumberKey(
            "profile angle of the rack", "an angle", "degrees", 10.0, 30.0, hint=MESHING_HINT
        ),
    ] = 20.0
    beta: Annotated[
        float,
        NumberKey(
            "helix angle of both wheels (угол наклона зуба). `m`, `alpha`, `ha`, `c` and `x` then "
            "apply to the normal section",
            "an angle", "degrees", 0.0, 45.0, hint=MESHING_HINT,
        ),
    ] = 0.0  # fmt: skip
    b: Annotated[
        float | None,
        NumberKey(
            "working width of the rims, mm, for the overlap ratio of helical gears",
            "a width", "mm", 0.05, 1e4, hint=MESHING_HINT, absent="not given",
        ),
    ] = None  # fmt: skip
    ha: Annotated[
        float,
        NumberKey(
            "addendum factor h_a* of the rack",
            "a factor of the module", low=0.5, high=1.3, hint=MESHING_HINT,
        ),
    ] = 1.0  # fmt: skip
    c: Annotated[
        float,
        NumberKey(
            "clearance factor c* of the rack",
            "a factor of the module", low=0.05, high=0.5, hint=MESHING_HINT,
        ),
    ] = 0.25  # fmt: skip
    x: Annotated[
        tuple[float, float] | None,
        CustomKey(
            "profile shifts of both wheels in modules, `[0.5, 0.3]`, or how planmethod chooses "
            'them within the blocking contour: `"blocking"` (least sliding), `"equal-sliding"`, '
            '`"contact-ratio"` (greatest contact ratio)'
        ),
    ] = None
    x1: Annotated[
        float | None,
        NumberKey(
            "profile shift of wheel 1, with `a_w`; that of wheel 2 follows",
            "a shift", "modules", -2.0, 3.0, hint=MESHING_HINT,
        ),
    ] = None  # fmt: skip
    x2: Annotated[
        float | None,
        NumberKey(
            "profile shift of wheel 2, with `a_w`; that of wheel 1 follows",
            "a shift", "modules", -2.0, 3.0, hint=MESHING_HINT,
        ),
    ] = None  # fmt: skip
    a_w: Annotated[
        float | None,
        NumberKey(
            "centre distance, mm. The sum of the shifts follows from it; the blocking contour "
            "determines how the wheels share the sum",
            "a distance", "mm", 0.1, 1e5, hint=MESHING_HINT,
        ),
    ] = None  # fmt: skip
    s_a_min: Annotated[
        float,
        NumberKey(
            "least tooth thickness at the tip, in modules",
            "a thickness", "modules", 0.0, 1.0, hint=MESHING_HINT,
        ),
    ] = 0.25  # fmt: skip
    epsilon_min: Annotated[
        float,
        NumberKey("least contact ratio", "a contact ratio", low=1.0, high=2.0, hint=MESHING_HINT),
    ] = 1.2


CAM_EXAMPLE = '[cam] follower = "translating", stroke = 0.04, rise = 120, return = 120'
CHOOSE = "choose"
"""Word in place of a size of the cam: it is chosen."""

CAM_LAWS = (
    "constant-acceleration", "cosine", "harmonic", "sine", "cycloid", "modified-sine",
    "trapezoidal", "modified-trapezoidal", "linear", "3-4-5", "4-5-6-7", "table",
    "piecewise-linear", "lift",
)  # fmt: skip
"""Laws of motion of a follower."""

CamSize = float | str | None
"""A size in metres, or ``choose``."""


class ShaftCamSection(Struct, frozen=True, kw_only=True):
    """``[[cams]]``: what a cam on a shaft has besides the keys of ``[cam]`` (кулачок на валу)."""

    name: Annotated[str, TextKey("name of the cam, letters and digits", 12, required=True)]
    phase: Annotated[
        float,
        AngleKey(
            "angle of the shaft at which the turn of the cam begins, degrees in the sense of "
            "rotation. At the angle 0 the key of the shaft points up"
        ),
    ] = 0.0


class CamMotionEntry(Struct, frozen=True, kw_only=True):
    """An entry of ``motions``: a rise, a return or a dwell (движение толкателя, выстой)."""

    rise: Annotated[
        float | None,
        NumberKey(
            "angle of the cam in which the follower rises", "an angle", "degrees", 1.0, 359.0
        ),
    ] = None
    return_: Annotated[
        float | None,
        NumberKey(
            "angle of the cam in which the follower returns, or falls by a part of its height",
            "an angle", "degrees", 1.0, 359.0, name="return",
        ),
    ] = None  # fmt: skip
    dwell: Annotated[
        float | None,
        NumberKey(
            "angle of the cam in which the follower rests", "an angle", "degrees", 0.1, 358.0
        ),
    ] = None
    stroke: Annotated[
        float | None,
        NumberKey(
            "stroke of a translating follower; default in a return: to the height of the start",
            "a length", "m", 1e-4, 10.0, positive=True,
        ),
    ] = None  # fmt: skip
    swing: Annotated[
        float | None,
        NumberKey(
            "swing of an oscillating follower, as `stroke`",
            "an angle", "degrees", 0.1, 120.0, positive=True,
        ),
    ] = None  # fmt: skip
    law: Annotated[
        object,
        CustomKey("law of this motion, as in [[cam.law]](#camlaw)", absent="that of `[cam]`"),
    ] = None


class CamSection(Struct, frozen=True, kw_only=True):
    """``[cam]``: a cam and its follower (кулачковый механизм)."""

    follower: Annotated[
        str,
        ChoiceKey(
            'motion of the follower: `"translating"` or `"oscillating"`',
            ("translating", "oscillating"),
            required=True,
        ),
    ]
    contact: Annotated[
        str,
        ChoiceKey(
            'end of the follower: `"roller"`, `"pointed"` or `"flat"`',
            ("roller", "pointed", "flat"),
        ),
    ] = "roller"
    closure: Annotated[
        str,
        ChoiceKey(
            'how the follower is kept on the cam: `"force"` (a spring) or `"form"` (a groove with '
            "two sides)",
            ("force", "form"),
        ),
    ] = "force"
    stroke: Annotated[
        float | None,
        NumberKey("stroke of a translating follower", "a length", "m", 1e-4, 10.0, positive=True),
    ] = None
    swing: Annotated[
        float | None,
        NumberKey(
            "angle of swing of an oscillating follower",
            "an angle", "degrees", 0.1, 120.0, positive=True,
        ),
    ] = None  # fmt: skip
    arm: Annotated[
        float | None,
        NumberKey(
            "length of an oscillating follower from its pivot to the roller, or to the end of its "
            "flat face",
            "a length", "m", 1e-3, 10.0, positive=True,
        ),
    ] = None  # fmt: skip
    sense: Annotated[
        str,
        ChoiceKey(
            "sense in which an oscillating follower turns in the rise, compared with the cam: "
            '`"opposite"` or `"same"`',
            ("opposite", "same"),
        ),
    ] = "opposite"
    rise: Annotated[
        float | None,
        NumberKey(
            "angle of the rise (удаление); required without `motions`",
            "an angle", "degrees", 1.0, 359.0,
        ),
    ] = None  # fmt: skip
    upper_dwell: Annotated[
        float,
        NumberKey("angle of the upper dwell (дальнее стояние)", "an angle", "degrees", 0.0, 358.0),
    ] = 0.0
    return_: Annotated[
        float | None,
        NumberKey(
            "angle of the return (возвращение); required without `motions`",
            "an angle", "degrees", 1.0, 359.0, name="return",
        ),
    ] = None  # fmt: skip
    lower_dwell: Annotated[
        float | None,
        NumberKey(
            "angle of the lower dwell (ближнее стояние)",
            "an angle", "degrees", 0.0, 358.0, absent="the rest of the turn",
        ),
    ] = None  # fmt: skip
    motions: Annotated[
        object,
        CustomKey(
            "several rises and returns in a turn, instead of `rise`, `upper_dwell`, `return`, "
            "`lower_dwell` and `stroke` or `swing`: rows [[cam.motions]](#cammotions)"
        ),
    ] = None
    law: Annotated[
        object,
        CustomKey(
            "law of motion for both phases, or `{ rise = …, return = … }`. A law with numbers is "
            "a table, see [[cam.law]](#camlaw)",
            absent='`"3-4-5"`',
        ),
    ] = None
    pressure: Annotated[
        object,
        CustomKey(
            "permitted pressure angle, degrees, or `{ rise = 30, return = 45 }`",
            absent=(
                "30 in the rise, 45 for an oscillating follower; any in the return, in a groove "
                "that of the rise"
            ),
        ),
    ] = None
    offset: Annotated[
        CamSize,
        CustomKey(
            'offset e of the line of a translating follower, m, or `"choose"`. Under a flat face '
            "it is 0"
        ),
    ] = None
    centre: Annotated[
        CamSize,
        CustomKey('centre distance of an oscillating follower, m, or `"choose"`'),
    ] = None
    r_min: Annotated[
        CamSize,
        CustomKey('least radius of the theoretical profile, m, or `"choose"`'),
    ] = None
    roller: Annotated[
        CamSize,
        CustomKey(
            'radius of the roller, m, or `"choose"`: at most 0.4 of `r_min` and 0.8 of the least '
            "radius of curvature"
        ),
    ] = None
    curvature: Annotated[
        float,
        NumberKey(
            "least radius of curvature under a flat face, m; `r_min` is chosen for it",
            "a length", "m", 0.0, 10.0,
        ),
    ] = 0.0  # fmt: skip
    count: Annotated[
        int, IntegerKey("number of positions in JSON, from one rise to the next", 3, 720)
    ] = 24
    parts: Annotated[
        int,
        IntegerKey(
            "number of parts into which the diagrams divide the rise, and the return", 4, 30
        ),
    ] = 12
    n: Annotated[
        float | None,
        NumberKey(
            "speed of the cam, rev/min; positive counter-clockwise",
            "a speed", "rev/min", -1e5, 1e5, absent="that of the crank in the same file",
        ),
    ] = None  # fmt: skip
    mass: Annotated[
        float,
        NumberKey(
            "mass of the follower; for an oscillating follower reduced to the roller",
            "a mass", "kg", 0.0, 1e5,
        ),
    ] = 0.0  # fmt: skip
    load: Annotated[float, NumberKey("force against the rise", "a force", "N", 0.0, 1e8)] = 0.0
    margin: Annotated[
        float,
        NumberKey(
            "safety factor of the spring: its force over the required one",
            "a factor", low=1.0, high=10.0,
        ),
    ] = 1.2  # fmt: skip


class PictureSection(Struct, frozen=True):
    """``[gears.picture]``: scales of the pictures of velocities (масштабы картин скоростей)."""

    mu_l: Annotated[float, NumberKey("scale of the scheme", "a scale", "m/mm", 1e-9, 1e6)] = 0.001
    longest_mm: Annotated[
        float,
        NumberKey(
            "greatest length of a segment in the diagram of linear velocities",
            "a length", "mm", 1.0, 1e4,
        ),
    ] = 60.0  # fmt: skip
    pole_mm: Annotated[
        float | None,
        NumberKey(
            "pole distance of the rays; it determines their scale",
            "a length", "mm", 1.0, 1e4, absent="from a round scale",
        ),
    ] = None  # fmt: skip


class PlanetaryTask(Struct, frozen=True, kw_only=True):
    """``[gears.design]``: what a planetary train was to be (проектирование передачи)."""

    U: Annotated[
        float | None,
        NumberKey(
            "required ratio, with its sign: U_1H, or U_H1 for a set with two equal rows",
            "a ratio", low=-1e6, high=1e6, hint="A ratio is a number: U = 6.5.",
            absent="that of the train",
        ),
    ] = None  # fmt: skip
    within: Annotated[
        float,
        NumberKey(
            "permitted deviation from `U` to either side, as a share of `U`",
            "a share", low=0.0, high=0.5, hint="Write 2 % as 0.02.",
        ),
    ] = 0.02  # fmt: skip
    z_min: Annotated[int, IntegerKey("least number of teeth", 6, 400)] = 17
    z_max: Annotated[int, IntegerKey("greatest number of teeth of external gears", 6, 400)] = 120
    ring_max: Annotated[int, IntegerKey("greatest number of teeth of internal gears", 6, 400)] = 250
    k_min: Annotated[int, IntegerKey("least number of planet gears to compare", 1, 24)] = 3
    k_max: Annotated[int, IntegerKey("greatest number of planet gears to compare", 1, 24)] = 6
    count: Annotated[
        int, IntegerKey("number of variants shown for each number of planet gears", 1, 10)
    ] = 3


class GearWheelSection(Struct, frozen=True):
    """A wheel of ``[gears]`` that is a table (колесо)."""

    z: Annotated[
        int | None, IntegerKey("number of teeth; of a worm, number of starts", 1, 10_000)
    ] = None
    r: Annotated[
        float | None,
        CustomKey(
            "pitch radius, m, instead of teeth. Beside wheels with teeth it needs `module`, "
            "except for a pulley. For a carrier: the centre distance of its planet gears"
        ),
    ] = None
    m: Annotated[
        float | None,
        NumberKey(
            "module of the row, mm, if the rows have different modules",
            "a module in mm", low=0.01, high=1000.0,
        ),
    ] = None  # fmt: skip
    x: Annotated[
        float,
        NumberKey(
            "profile shift coefficient (коэффициент смещения)", "a shift", low=-5.0, high=5.0
        ),
    ] = 0.0
    axis: Annotated[
        tuple[float, float, float] | None,
        CustomKey(
            "axis of a bevel wheel: `[x, y, z]` from the apex towards the wheel. The z axis is "
            "the main axis"
        ),
    ] = None


SYNTHESIS_KINDS = ("slotted", "slider-crank", "crank-rocker", "three-positions", "three-angles")


class SynthesisSection(Struct, frozen=True, kw_only=True):
    """``[synthesis]``: what the sizes of the mechanism follow from (синтез механизма)."""

    kind: Annotated[
        str,
        ChoiceKey(
            "mechanism that is synthesized, as of [planmethod synthesize](../how-to/synthesis.md)",
            SYNTHESIS_KINDS,
            required=True,
            missing='For example: kind = "slotted"',
        ),
    ]
    K_v: Annotated[
        float | None,
        NumberKey("ratio of the slow stroke's time to the quick stroke's", "a number"),
    ] = None
    centres: Annotated[
        float | None,
        NumberKey("distance between the fixed pivots", "a length", "m", *_SIZE, positive=True),
    ] = None
    stroke: Annotated[
        float | None, NumberKey("stroke of the slider", "a length", "m", *_SIZE, positive=True)
    ] = None
    swing: Annotated[
        float | None,
        NumberKey("swing of the slotted link or of the rocker", "an angle", "degrees", 0.0, 360.0),
    ] = None
    lambda_: Annotated[
        float | None, NumberKey("ratio of crank to connecting rod", "a number", name="lambda")
    ] = None
    offset: Annotated[
        float | None,
        NumberKey(
            "offset of the guide from the crank's pivot, upwards positive",
            "a distance", "m", -_SIZE[1], _SIZE[1],
        ),
    ] = None  # fmt: skip
    pressure: Annotated[
        float | None,
        NumberKey("largest pressure angle of the slider", "an angle", "degrees", 0.0, 90.0),
    ] = None
    rod: Annotated[
        float | None,
        NumberKey(
            "connecting rod of a shaper",
            "a length", "m", *_SIZE, positive=True, absent="half of O3B",
        ),
    ] = None  # fmt: skip
    rocker: Annotated[
        float | None,
        NumberKey("length of the rocker", "a length", "m", *_SIZE, positive=True, absent="1 m"),
    ] = None
    line: Annotated[
        tuple[float, ...] | None,
        CustomKey(
            "line on which the crank's pivot is: `[x, y, angle]` from the rocker's pivot, whose "
            "rocker is upright in the middle"
        ),
    ] = None
    beta: Annotated[
        float | None,
        NumberKey("angle between the chord B''B' and B''O", "an angle", "degrees", -180.0, 180.0),
    ] = None
    coupler: Annotated[
        float | None,
        NumberKey(
            "length of the coupler BC",
            "a length",
            "m",
            *_SIZE,
            positive=True,
            absent="the best one",
        ),
    ] = None
    positions: Annotated[
        tuple[tuple[float, ...], ...] | None,
        CustomKey(
            "three positions of the coupler BC: `[xB, yB, angle]` each, or `[xB, yB, xC, yC]`"
        ),
    ] = None
    angles: Annotated[
        tuple[tuple[float, ...], ...] | None,
        CustomKey("three pairs of angles `[a, b]` of the links OA and CB from the line OC"),
    ] = None
    points: Annotated[
        dict[str, str] | None,
        CustomKey(
            "letters of the file for those of the construction, "
            '`{ O = "A", A = "B", B = "C", C = "D" }`',
            absent="the same letters",
        ),
    ] = None
