"""What a language must be able to say of a moving point."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class PointWording(Struct, frozen=True, kw_only=True):
    """Words of the moving point (движение точки).

    ``circle`` and ``line`` say along what a natural motion runs, ``wheel`` and ``tracks`` what
    wheel carries the point and what that rolls on, ``reasons`` are by the values of
    `planmethod.moving.motion.Why`, ``printed`` are the heads of the table of printed values.
    """

    circle: str
    line: str
    at: str
    reasons: Mapping[str, str]
    polar: str
    rolled: str
    wheel: str
    tracks: Mapping[str, str]
    printed: tuple[str, str, str, str, str]

    # Of the sheet: names of the views, what is asked, tables
    trajectory: str
    hodograph_v: str
    hodograph_a: str
    row: str
    moments: str
    wanted: str
    read_title: str
    read: tuple[str, str, str, str]
    table: str
    chord: str
    chord_note: str

    # Of the protocol: the steps, what is read; ``ways`` by along or across a line, and back
    curve: str
    ray: str
    level: str
    lay_off: str
    lay_off_side: str
    nothing: str
    ways: Mapping[str, str]
    across_pm: str
    end: str
    join: str
    measured: str
    tangent: str
    foot: str
    value: str
    by_hodograph: str
    chord_told: str
    chords: tuple[str, str, str, str, str, str]
