"""Slider-crank (кривошипно-ползунный механизм) from the stroke and loci of the crank's pivot.

In the dead positions OB' = l + r and OB'' = l - r. Three loci give O: the circle from which the
stroke is seen at the angle θ of K_v, the circle of Apollonius of the ratio (l - r)/(l + r) that
λ = r/l makes, and the line at the offset e from the guide.
"""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, radians, sin, sqrt, tan
from typing import Any

import numpy as np

from planmethod.construct.curves import root, top
from planmethod.construct.steps import LineSense, Side
from planmethod.errors import AssemblyError
from planmethod.synthesis.model import (
    Board,
    FileTable,
    InputError,
    Pose,
    Synthesis,
    angle_of_ratio,
    choose_option_set,
    place,
    read,
)

OPTIONS = ("K_v", "stroke", "lambda", "offset", "pressure")
SIZES: Mapping[str, str] = {}


def synthesize(options: Mapping[str, Any]) -> Synthesis:
    """Find crank and rod.

    Parameters
    ----------
    options : mapping
        ``stroke`` (m) with two of ``K_v``, ``lambda`` (r/l) and ``offset`` (m; 0 with ``lambda``
        alone); with ``K_v`` alone, for the smallest pressure angle; or with the maximum
        ``pressure`` angle (degrees) and ``offset``.

    Raises
    ------
    InputError, AssemblyError
    """
    way = choose_option_set(
        options,
        "slider-crank",
        "stroke K_v offset",
        "stroke K_v",
        "stroke K_v lambda",
        "stroke lambda",
        "stroke lambda offset",
        "stroke pressure",
        "stroke pressure offset",
    )
    stroke, ratio, offset = options["stroke"], options["lambda"], options["offset"]
    if options["pressure"] is not None:
        ratio = _ratio_of_pressure(stroke, abs(offset or 0.0), options["pressure"])
    if ratio is not None and not 0.0 < ratio < 1.0:
        raise AssemblyError(
            "lambda = r/l = {:.10g}: the crank turns fully only where it is shorter than "
            "the rod, 0 < lambda < 1.",
            ratio,
        )
    theta = 0.0
    if options["K_v"] is not None:
        theta = angle_of_ratio(options["K_v"])
        if ratio is not None and theta == 0.0:
            way = "stroke lambda"  # a central mechanism
    if way.startswith("stroke K_v"):
        _check_ratio(stroke, options["K_v"], theta, ratio, offset)
    if way == "stroke K_v":
        relief = np.vectorize(lambda e: -_pressure(stroke, theta, e), otypes=[float])
        offset, _ = top(relief, 0.0, stroke / tan(radians(theta)), samples=400)
    given = None if way == "stroke K_v lambda" else offset or 0.0
    return _built(options, stroke, theta, ratio, given)


def _check_ratio(
    stroke: float, times: float, theta: float, ratio: float | None, offset: float | None
) -> None:
    """Reject a ratio that the angle θ does not allow, and report the limit."""
    if theta == 0.0:
        raise AssemblyError(
            "K_v = 1: the dead positions are opposite, so the mechanism is central (offset 0) and "
            "lambda is free. Give --stroke and --lambda."
        )
    if theta >= 90.0:
        raise AssemblyError(
            "K_v = {:.10g}: theta = {:.6g} deg, and the crank turns fully only below 90 "
            "deg, K_v < 3. Choose a slotted link.",
            times,
            theta,
        )
    if offset is not None and not 0.0 < abs(offset) < stroke / tan(radians(theta)):
        raise AssemblyError(
            "offset = {:.10g} m with K_v = {:.10g}: 0 < |e| < H/tan(theta) = {:.10g} m "
            "is possible; at 0 K_v is 1, at the limit the crank stops below the dead "
            "position (l - r = e).",
            offset,
            times,
            stroke / tan(radians(theta)),
        )
    if ratio is not None and not tan(radians(theta / 2)) ** 2 < ratio:
        raise AssemblyError(
            "lambda = {:.10g} with K_v = {:.10g}: more than tan^2(theta/2) = {:.10g} is "
            "possible, where l - r = e.",
            ratio,
            times,
            tan(radians(theta / 2)) ** 2,
        )


def _built(
    options: Mapping[str, Any],
    stroke: float,
    theta: float,
    ratio: float | None,
    offset: float | None,
) -> Synthesis:
    """Draw the given loci, and the mechanism that follows from their intersection."""
    b = Board()
    near = b.fixed("B''", 0j)
    guide = b.ray(near, None, 0.0)
    far = b.lay_off_length("B'", near, guide, b.length("H", stroke))
    side = Side.RIGHT if offset is None or offset >= 0.0 else Side.LEFT
    circles = []
    if theta > 0.0:
        circles.append(b.inscribed("Z", (near, far), theta, side))
    if ratio is not None:
        limit = stroke * (1.0 - ratio**2) / (4.0 * ratio)
        if abs(offset or 0.0) > limit * (1.0 + 1e-12):
            raise AssemblyError(
                "offset = {:.10g} m with lambda = {:.10g} and the stroke {:.10g} m: |e| <= "
                "H(1 - lambda^2)/(4 lambda) = {:.10g} m is possible.",
                offset,
                ratio,
                stroke,
                limit,
            )
        ends = [
            b.lay_off_length(
                name, near, guide, b.length(f"B''{name}", length * stroke * (1.0 - ratio))
            )
            for name, length in (("P", 0.5), ("Q", -0.5 / ratio))
        ]
        middle = b.intersect_lines("G", guide, b.bisector(*ends))
        b.circles.append((middle, ends[0]))
        b.phrases[middle] = (
            "apollonius",
            {"tail": "P", "head": "Q", "ratio": ratio, "centre": "G"},
        )
        circles.append((middle, b.measure("G P", middle, ends[0])))
    if offset is None:
        (z, big), (g, small) = circles
        pivot = b.intersect_circles("O", z, big, g, small, Side.LEFT)
    else:
        foot = b.lay_off_length("N", near, b.ray(near, guide, -90.0), b.length("e", offset))
        line = b.parallel(foot, guide) if offset else guide
        pivot = b.intersect_line_circle("O", line, *circles[0], LineSense.BACKWARD)
    short, long = b.measure("O B''", pivot, near), b.measure("O B'", pivot, far)
    crank = b.half_sum(long, short, ("AB", "OA"))
    if offset is None:
        foot = b.intersect_lines("N", b.perpendicular(pivot, guide), guide)
        b.length_from("e", b.measure("O N", pivot, foot))
    out = b.opposite("A'", pivot, far, crank, LineSense.FORWARD)
    back = b.opposite("A''", pivot, near, crank, LineSense.BACKWARD)
    b.circles.append((pivot, out, back))
    trace = read(b)
    if place(trace, "O").real >= 0.0:
        raise AssemblyError(
            "The crank's pivot is below the stroke: l - r < e, and the crank does not turn "
            "fully. Choose another ratio or offset."
        )
    asked_back = {"stroke": stroke}
    asked_back |= {k: options[k] for k in ("K_v",) if options[k] is not None}
    return Synthesis(
        "slider-crank",
        b,
        ("OA", "AB", "e"),
        ("O",),
        (
            Pose((("O", out, far),), (out,), (far,)),
            Pose((("O", back, near),), (back,), (near,)),
        ),
        asked_back,
        "B",
        ("A", "B", ""),
        ("OA", "AB", "e"),
        (
            FileTable("links.1", "crank", ('points = ["O", "A"]', 'OA = "l_OA"')),
            FileTable("links.2", "rod", ('points = ["A", "B"]', 'AB = "l_AB"')),
            FileTable("links.3", "slider", ('points = ["B"]', 'slides = { on = "x-x" }')),
            FileTable("assembly", "assembly", ('B = "right of A"',)),
        ),
        guide=(near,),
        driver=("O", out),
        theta=("O", near, far) if theta > 0.0 else (),
    )


def _pressure(stroke: float, theta: float, offset: float) -> float:
    """Return the sine of the largest pressure angle where K_v and the offset are given."""
    turn = radians(theta)
    x = stroke / 2 - sqrt(
        max(0.0, (stroke / 2 / sin(turn)) ** 2 - (offset - stroke / 2 / tan(turn)) ** 2)
    )
    near, far = abs(complex(x, offset)), abs(complex(stroke - x, offset))
    rod = (near + far) / 2
    return ((far - near) / 2 + offset) / rod if rod > 0.0 else inf


def _ratio_of_pressure(stroke: float, offset: float, angle: float) -> float:
    """Return λ with which the largest pressure angle is given: sin α = (r + e)/l."""
    if not 0.0 < angle < 90.0:
        raise InputError("--pressure {:.10g}: between 0 and 90 degrees is expected.", angle)
    sine = sin(radians(angle))
    if offset == 0.0:
        return sine

    def less(rod: float) -> float:
        crank = sine * rod - offset
        far, near = rod + crank, rod - crank
        return sqrt(far**2 - offset**2) - sqrt(max(0.0, near**2 - offset**2)) - stroke

    least = offset / sine
    rod = root(np.vectorize(less, otypes=[float]), least, least + 2.0 * stroke / sine)
    return (sine * rod - offset) / rod
