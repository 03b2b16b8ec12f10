"""What a language must be able to say of the turn of a crank (слова о цикле движения)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class CycleWording(Struct, frozen=True, kw_only=True):
    """Sentences, names and heads of tables of the cycle, rich text; templates of `str.format`."""

    title: str
    why: Mapping[str, str]
    none: str

    # Facts, of a stroke along a guide and of a swing
    output: Mapping[str, str]
    zero: str
    path_zero: str
    extremes: str
    stroke: Mapping[str, str]
    ratio: str
    full_turn: str
    tightest: str
    range: str
    pressure: str
    no_pressure: str

    # Extreme positions by construction, by what the end of the rod goes along
    construction: Mapping[str, str]
    constructed: Mapping[str, str]
    no_construction: str

    # Diagrams
    of: Mapping[str, str]
    diagrams: str
    hodograph: Mapping[str, str]
    drawn: str
    chords: Mapping[str, str]
    scheme_steps: str
    ray_steps: Mapping[str, str]
    again: str
    scales: str

    # Tables
    table: str
    analogues: str
    deviations: str
    way: str
    ways: Mapping[str, str]
    from_plans: str
    greatest: tuple[str, str]
    mean: tuple[str, str]
    sigma: str

    # Sheet
    wanted: str
