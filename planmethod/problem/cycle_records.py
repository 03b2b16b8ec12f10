"""Plain records of the requests for the cycle of a crank and of the decisions of a project."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from enum import Enum
from typing import Annotated

from msgspec import Struct

from planmethod.problem.key_types import CustomKey, IntegerKey, NumberKey, WordKey
from planmethod.problem.load_records import TurningSense

DIAGRAM_HINT = "Millimetres of the diagrams."


class Zero(Enum):
    """Position zero by name: the start of the quicker, the slower or the working stroke.

    The usual one, without a name in files, is that of the working stroke where loads or the file
    determine it, else that of the quicker stroke.
    """

    USUAL = ""
    EXTREME = "extreme"
    OTHER = "other extreme"
    WORKING = "working"


class StrokeSense(Enum):
    """Sense in which the output moves on its working stroke (направление рабочего хода)."""

    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"
    CCW = "ccw"
    CW = "cw"


class Differentiation(Enum):
    """Method of graphical differentiation of a diagram (графическое дифференцирование)."""

    CHORDS = "chords"
    TANGENTS = "tangents"
    CURVE = "curve"


class PoleDistances(Struct, frozen=True):
    """Pole distances of both differentiations (полюсные расстояния); None where scales set them."""

    v: Annotated[
        float | None,
        NumberKey(
            "of the first differentiation; the scale of the velocity follows from it then",
            "a length", "mm", 1.0, 500.0, positive=True, hint=DIAGRAM_HINT,
            absent="from round scales",
        ),
    ] = None  # fmt: skip
    a: Annotated[
        float | None,
        NumberKey(
            "of the second differentiation; the scale of the acceleration follows from it then",
            "a length", "mm", 1.0, 500.0, positive=True, hint=DIAGRAM_HINT,
            absent="from round scales",
        ),
    ] = None  # fmt: skip


class CycleTask(Struct, frozen=True):
    """Requests for the cycle of a crank (цикл движения): ``[cycle]``."""

    output: Annotated[
        str | None,
        CustomKey(
            "a point on a guide of the frame, or a link; default: the last driven link that "
            "is joined to the frame"
        ),
    ] = None
    zero: Annotated[
        Zero | float,
        CustomKey(
            'position zero: `"extreme"`, `"other extreme"`, `"working"`, or the angle of '
            "the crank, degrees; default: `phi_0` of `[machine]`, else the start of the "
            'working stroke if loads or `working` determine it, else `"extreme"`'
        ),
    ] = Zero.USUAL
    direction: Annotated[
        TurningSense | None,
        WordKey(
            'the sense in which positions are numbered: `"ccw"` or `"cw"`; default: that of '
            "the driver"
        ),
    ] = None
    count: Annotated[
        int,
        IntegerKey(
            "positions of a turn", 3, 360,
            more="; `count` of `[machine]` if it is the only one, else that of a full turn "
            "of `[driver] phi`",
        ),
    ] = 12  # fmt: skip
    working: Annotated[
        StrokeSense | None,
        WordKey(
            'the sense in which the output moves on its working stroke: `"up"`, `"down"`, '
            '`"left"`, `"right"`, for a link `"ccw"` or `"cw"`; default: the stroke that '
            "the loads resist, or the longer one if the file has no loads"
        ),
    ] = None
    length: Annotated[
        float | None,
        NumberKey(
            "of the axis of φ for the cycle; the scale of φ follows from it then", "a length", "mm",
            20.0, 2000.0, positive=True, hint=DIAGRAM_HINT, absent="from a round scale",
        ),
    ] = None  # fmt: skip
    pole: Annotated[
        PoleDistances,
        CustomKey(
            "pole distances of both differentiations: `{ v = 36, a = 36 }`, mm; default: "
            "from round scales"
        ),
    ] = PoleDistances()
    graphs: Annotated[
        tuple[str, ...],
        CustomKey(
            'quantities whose graphs over the turn are drawn: `["x_C", "phi_3", "v_q_C", '
            '"v_qx_C", "u_31", "omega_3", "ay_C"]`; `"output"` means the position of the '
            "output and its transfer functions",
            absent="none",
        ),
    ] = ()
    differentiation: Annotated[
        Differentiation,
        WordKey(
            '`"chords"` (хорды), `"tangents"` (касательные) or `"curve"` (by chords of the drawn '
            "curve)"
        ),
    ] = Differentiation.CHORDS


PROJECT_PARTS = (
    "kinematics",
    "forces",
    "flywheel",
    "balancing",
    "gears",
    "meshing",
    "cam",
    "note",
)
"""Parts of a project in the order of their sheets."""


class ProjectTask(Struct, frozen=True):
    """Decisions of a project (курсовой проект): ``[project]``."""

    calculated: Annotated[
        int | None,
        IntegerKey(
            "number of the calculated position, from 0: drawn bold, loaded, told in full",
            0,
            719,
            absent="that of `phi`, if it is one of the positions, else the clearest one",
        ),
    ] = None
    gears: Annotated[
        str,
        CustomKey(
            'file of the gear train, beside this one: `"train.toml"`',
            absent="`[gears]` of this file",
        ),
    ] = ""
    meshing: Annotated[
        str,
        CustomKey(
            'file of the wheels in mesh, beside this one: `"wheels.toml"`',
            absent="`[meshing]` of this file",
        ),
    ] = ""
    cam: Annotated[
        str,
        CustomKey('file of the cam, beside this one: `"cam.toml"`', absent="`[cam]` of this file"),
    ] = ""
    parts: Annotated[
        tuple[str, ...],
        CustomKey(
            "which parts are made: " + ", ".join(f'`"{part}"`' for part in PROJECT_PARTS),
            absent="all that the file has",
        ),
    ] = ()
