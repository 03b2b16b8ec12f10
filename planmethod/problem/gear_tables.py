"""Flat tables of gear problems as they are written: what they say is read in `planmethod.gears`."""

from __future__ import annotations

from typing import Annotated

from planmethod.problem.declared import FlagKey, NumberKey, OwnKey, WholeKey
from planmethod.record import dataclass

MESHING_EXAMPLE = '[meshing] z = [12, 30], m = 5, x = "blocking"'
MESHING_HINT = "Lengths of [meshing] are millimetres, as the standard has them."


@dataclass(frozen=True, slots=True, kw_only=True)
class MeshingTable:
    """``[meshing]``: two wheels with involute teeth (эвольвентное зацепление)."""

    z: Annotated[
        tuple[int, int],
        OwnKey("teeth of the driving wheel 1 and of wheel 2, 5 to 1000", required=True),
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
        WholeKey(
            "teeth of the pinion cutter (долбяк) of an internal wheel 2, fewer than the wheel's",
            8,
            200,
            absent="20",
        ),
    ] = None
    alpha: Annotated[
        float,
        NumberKey(
            "profile angle of the rack", "an angle", "degrees", 10.0, 30.0, hint=MESHING_HINT
        ),
    ] = 20.0
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
        OwnKey(
            'shifts of the rack in modules, `[0.5, 0.3]`; or `"blocking"`: chosen by the blocking '
            "limits"
        ),
    ] = None
    x1: Annotated[
        float | None,
        NumberKey(
            "shift of wheel 1 alone, beside `a_w`",
            "a shift", "modules", -2.0, 3.0, hint=MESHING_HINT, more="; the other one follows",
        ),
    ] = None  # fmt: skip
    x2: Annotated[
        float | None,
        NumberKey(
            "shift of wheel 2 alone, beside `a_w`",
            "a shift", "modules", -2.0, 3.0, hint=MESHING_HINT, more="; the other one follows",
        ),
    ] = None  # fmt: skip
    a_w: Annotated[
        float | None,
        NumberKey(
            "distance of the axes", "a distance", "mm", 0.1, 1e5, hint=MESHING_HINT,
            more="; the sum of the shifts follows, and the limits choose how it is shared",
        ),
    ] = None  # fmt: skip
    s_a_min: Annotated[
        float,
        NumberKey(
            "least tooth thickness at the tip",
            "a thickness", "modules", 0.0, 1.0, hint=MESHING_HINT,
        ),
    ] = 0.25  # fmt: skip
    epsilon_min: Annotated[
        float,
        NumberKey("least contact ratio", "a contact ratio", low=1.0, high=2.0, hint=MESHING_HINT),
    ] = 1.2


@dataclass(frozen=True, slots=True)
class PictureTable:
    """``[gears.picture]``: scales of the pictures of velocities (масштабы картин скоростей)."""

    mu_l: Annotated[float, NumberKey("scale of the scheme", "a scale", "m/mm", 1e-9, 1e6)] = 0.001
    longest_mm: Annotated[
        float,
        NumberKey(
            "longest segment of the picture of linear velocities", "a length", "mm", 1.0, 1e4
        ),
    ] = 60.0
    pole_mm: Annotated[
        float, NumberKey("distance of the pole of the rays", "a length", "mm", 1.0, 1e4)
    ] = 40.0


@dataclass(frozen=True, slots=True)
class GearWheelTable:
    """A wheel of ``[gears]`` that is a table (колесо)."""

    z: Annotated[int | None, WholeKey("number of teeth (of a worm: starts)", 1, 10_000)] = None
    r: Annotated[
        float | None,
        OwnKey("pitch radius, m, in place of teeth; beside wheels with teeth it needs `module`"),
    ] = None
    x: Annotated[float, NumberKey("shift, in modules", "a shift", low=-5.0, high=5.0)] = 0.0
    axis: Annotated[
        tuple[float, float, float] | None,
        OwnKey("of a bevel wheel: `[x, y, z]` from the apex towards the wheel; z is the main axis"),
    ] = None
