"""Cams (кулачки): a disc with its outline, and the roller that runs on it."""

from __future__ import annotations

import cmath
from math import cos, pi, tau

from planmethod.render.ink.drawing import Arc, Disc, Item, Pen, Stroke
from planmethod.render.symbols.pairs import revolute

ROLLER = 3.2
"""Radius of a roller, mm."""


RISE = 1.6
"""Angle of the rise of a cam on either side of its nose, radians."""


def cam_radius(angle: float, *, base: float, lift: float) -> float:
    """Return the radius of a cam's outline at an angle from its nose, mm.

    ``base`` is the least radius and ``lift`` the rise above it, mm, by the cosine law.
    """
    off = abs((angle + pi) % tau - pi)
    return base + (lift * (1 + cos(pi * off / RISE)) / 2 if off < RISE else 0.0)


def cam(
    centre: complex, *, base: float = 8.0, lift: float = 6.0, nose: float = 1.0, tag: str = ""
) -> list[Item]:
    """Return a disc cam: its outline (кулачок); ``nose`` is its direction, radians."""
    angles = [tau * k / 120 for k in range(120)]
    outline = tuple(
        centre + cmath.rect(cam_radius(a - nose, base=base, lift=lift), a) for a in angles
    )
    return [Stroke(outline, closed=True, tag=tag)]


def roller(at: complex) -> list[Item]:
    """Return a roller on its pin, white inside (ролик)."""
    return [Disc(at, ROLLER), Arc(at, ROLLER), *revolute(at, factor=0.7, pen=Pen.THIN)]


def rest_on_cam(
    centre: complex, direction: complex, *, base: float, lift: float, nose: float
) -> complex:
    """Return the centre of a roller that rests on a cam, descending along ``direction``, mm.

    The follower's line goes through the cam's centre; the roller touches the outline without
    running into it.
    """
    up = direction / abs(direction)
    points = [
        cmath.rect(cam_radius(a - nose, base=base, lift=lift), a) / up
        for a in (tau * k / 720 for k in range(720))
    ]
    touching: list[float] = [
        p.real + (ROLLER**2 - p.imag**2) ** 0.5
        for p in points
        if abs(p.imag) < ROLLER and p.real > 0
    ]
    return centre + up * max(touching)
