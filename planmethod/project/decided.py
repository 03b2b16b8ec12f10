"""What a mechanism decides of a project (выбор по механизму): strokes, scales, the position."""

from __future__ import annotations

from msgspec import Struct


class Strokes(Struct, frozen=True):
    """Phases of the strokes (рабочий и холостой ход): degrees of the crank.

    ``K_v`` is the ratio of the longer to the shorter one, ``by`` what tells which one works: ``load
    P``, ``longer``, ``working``.
    """

    working_deg: float
    idle_deg: float
    K_v: float
    by: str
