"""What a language must be able to say of a machine and its flywheel."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct

SYMBOLS = (
    "resisting moment",
    "driving moment",
    "resisting work",
    "driving work",
    "energy gain",
    "reduced inertia",
    "flywheel",
    "crank inertia",
    "mean speed",
    "moment by lever",
    "motor moment",
    "braking moment",
)
"""Quantities whose letters a language's `Notation` has."""


class MachineWording(Struct, frozen=True, kw_only=True):
    """Names and sentences of the flywheel's sheet in one language, rich text.

    The letters of its quantities are symbols of the language's `Notation`.
    """

    wanted: str
    means: Mapping[str, str]
    source_signs: str

    diagrams: str
    by_middle: str
    by_trapezoid: str
    speed: str
    load: str
    over_stroke: str
    table: str
    sizes: Mapping[str, str]
    calculation: str
    title: str

    read: str
    construction: str
    exact: str
    parts: str
    slopes: str
    method: str
    positions: str
    pencil: str
    reached: str
    extreme: str
    not_needed: str
    held: str
    lever_agrees: str
    steps: tuple[str, ...]

    run_up: str
    kloss: str
    line: str
    ran_up: str
    steady: str
    by_motor: str
    stays: str
    stalled: str
    not_steady: str
    braked: str
    coasted: str
    not_stopped: str
    motor_diagram: str
    by_time: str
    by_angle: str
    stop_diagram: str
    run_up_table: str
    stop_table: str

    balancing: str
    run_up_wanted: str
    balancing_wanted: str
    structures: Mapping[str, str]
    weighings: Mapping[str, str]
    substituted: str
    off_line: str
    weight: str
    no_weight: str
    measured: str
    force_falls: str
    centre_stands: str
    centre_moves: str
    polygon_of: str
    before: str
    after: str
    weights_table: str
    forces_table: str
    with_weights: str
