"""Crank-rocker (кривошипно-коромысловый механизм) from swing, K_v and the crank's pivot.

The rocker's ends B' and B'' are seen from the crank's pivot O at the angle θ of K_v: O is on a
circle over the chord. Both positions close on one side of OC where O is outside of the angle
B'CB'' and of the one across; the crank then turns fully. One parameter is free: the angle β between
the chord and B''O, or a line that O is on, or OC; without any the best transmission angle decides.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product
from math import acos, degrees, nan, radians, sin
from typing import Any

import numpy as np

from planmethod.construct.curves import top
from planmethod.construct.steps import LineSense, Side
from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.synthesis.model import (
    Board,
    FileTable,
    InputError,
    Pose,
    Synthesis,
    angle_of_ratio,
    choose_option_set,
    lengths_of,
    place,
    read,
)

OPTIONS = ("K_v", "swing", "rocker", "centres", "line", "beta")
SIZES: Mapping[str, str] = {"rocker": "CB", "centres": "OC"}

LENGTHS = ("OA", "AB", "CB", "OC")


def synthesize(options: Mapping[str, Any]) -> Synthesis:
    """Find crank, coupler and frame.

    Parameters
    ----------
    options : mapping
        ``K_v``, ``swing`` (degrees), ``rocker`` CB (m; default: 1), and at most one of ``beta``
        (degrees, negative for a pivot beyond the chord), ``line`` (x and y of a point and the
        direction, m and degrees from C, the rocker's middle position along +y), ``centres`` OC (m).

    Raises
    ------
    InputError, AssemblyError
    """
    free = ("", " beta", " line", " centres")
    choose_option_set(
        {**options, "rocker": None}, "crank-rocker", *("K_v swing" + one for one in free)
    )
    options = {**options, "rocker": options["rocker"] or 1.0}
    theta, swing = angle_of_ratio(options["K_v"]), options["swing"]
    if not 0.0 < swing < 180.0:
        raise AssemblyError(
            "swing = {:.10g} deg: a rocker swings by more than 0, less than 180 deg.", swing
        )
    if theta >= 90.0 + swing / 2:
        most = (270.0 + swing / 2) / (90.0 - swing / 2)
        raise AssemblyError(
            "K_v = {:.10g} with the swing {:.10g} deg: theta = {:.10g} deg, less than 90 "
            "+ swing/2 = {:.10g} deg is possible, K_v < {:.10g}.",
            options["K_v"],
            swing,
            theta,
            90.0 + swing / 2,
            most,
        )
    if theta == 0.0 and options["line"] is None and options["centres"] is None:
        raise InputError(
            "K_v = 1: O is anywhere on the line B'B''. Give --centres, more than the "
            "rocker's {:.10g} m, or --line.",
            options["rocker"],
        )
    made = list(_candidates(options, theta))
    if not made:
        raise AssemblyError(_limit(options, theta))
    return min(made, key=lambda pair: pair[0])[1]


def _limits(theta: float, swing: float) -> tuple[float, float, float]:
    """Return the range of β on C's side of the chord for a turning crank, and the least beyond."""
    return max(90.0 - swing / 2, 90.0 + swing / 2 - theta), 180.0 - theta, 90.0 + swing / 2


def _limit(options: Mapping[str, Any], theta: float) -> str:
    """Return the reason why a crank does not exist."""
    if theta == 0.0:
        return translate(
            "K_v = 1: O is on the line B'B'' outside of the chord, so OC must be more "
            "than the rocker's {:.10g} m, and a line must meet it there.",
            options["rocker"],
        )
    low, high, beyond = _limits(theta, options["swing"])
    told = translate("{:.6g} < beta < {:.6g} deg", low, high)
    if beyond < high:
        below = translate("{:.6g} < beta < {:.6g} deg", -high, -beyond)
        told = translate("{} or {}", told, below)
    given = {"beta": "--beta", "line": "--line", "centres": "--centres"}
    name = next((text for key, text in given.items() if options[key] is not None), "this")
    radius = options["rocker"] * sin(radians(options["swing"] / 2)) / (sin(radians(theta)))
    return translate(
        "{}: no place for O from which B'B'' is seen at theta = {:.6g} deg with both "
        "dead positions on one side of OC. Possible are {} on the circle of the "
        "radius {:.6g} m over B'B''.",
        name,
        theta,
        told,
        radius,
    )


def _candidates(options: Mapping[str, Any], theta: float) -> Iterator[tuple[float, Synthesis]]:
    """Yield mechanisms whose crank rotates fully, with the negated transmission angle, degrees."""
    if options["line"] is None and options["centres"] is None:
        betas = [options["beta"]] if options["beta"] is not None else _best_angles(options, theta)
        tries = [(False, 1 if beta >= 0 else -1, LineSense.FORWARD, abs(beta)) for beta in betas]
    else:
        sides = (1, -1) if theta > 0.0 else (1,)
        tries = [(*one, 0.0) for one in product((False, True), sides, LineSense)]
    for mirrored, inner, way, beta in tries:
        made = _built(options, theta, mirrored, inner, way, beta)
        if made is not None:
            yield made


def _best_angles(options: Mapping[str, Any], theta: float) -> list[float]:
    """Return the β of the best transmission angle, on C's side of the chord and beyond it."""
    low, high, beyond = _limits(theta, options["swing"])
    rocker, half = options["rocker"], radians(options["swing"] / 2)

    def worst(beta: float, sense: int) -> float:
        turn = radians(theta)
        near, far = (
            2.0 * rocker * sin(half) * sin(angle) / sin(turn)
            for angle in (radians(180.0 - theta - beta), radians(beta))
        )
        frame = abs(
            rocker * np.exp(1j * (np.pi / 2 + half)) + near * np.exp(-1j * sense * radians(beta))
        )
        return transmission((far - near) / 2, (far + near) / 2, rocker, float(frame))

    least = np.vectorize(worst, otypes=[float])
    found = [top(lambda beta: least(beta, 1), low, high, samples=400)[0]]
    if beyond < high:
        found.append(-top(lambda beta: least(beta, -1), beyond, high, samples=400)[0])
    return found


def transmission(crank: float, coupler: float, rocker: float, frame: float) -> float:
    """Return the least angle between coupler and rocker over the turn, degrees; NaN for none."""
    angles = []
    for span in (abs(frame - crank), frame + crank):
        cosine = (coupler**2 + rocker**2 - span**2) / (2.0 * coupler * rocker)
        if not -1.0 <= cosine <= 1.0:
            return nan
        angles.append(degrees(acos(cosine)))
    return min(min(angle, 180.0 - angle) for angle in angles)


def _built(
    options: Mapping[str, Any],
    theta: float,
    mirrored: bool,
    inner: int,
    branch: LineSense,
    beta: float,
) -> tuple[float, Synthesis] | None:
    """Draw one mechanism; return None where its crank cannot rotate fully.

    Parameters
    ----------
    mirrored : bool
        O is nearer to the right end of the rocker.
    inner : int
        +1: O on C's side of the chord; -1: beyond it.
    branch : LineSense
        Which of the two intersections.
    """
    b, half = Board(), (-1.0 if mirrored else 1.0) * options["swing"] / 2
    c = b.fixed("C", 0j)
    arm = b.length("CB", options["rocker"])
    near, far = (
        b.lay_off_length(name, c, b.ray(c, None, 90.0 + turn), arm)
        for name, turn in (("B''", half), ("B'", -half))
    )
    chord = b.join(near, far)
    side = Side.RIGHT if (inner > 0) is not mirrored else Side.LEFT
    circle = b.inscribed("Z", (near, far), theta, side) if theta > 0.0 else None
    if options["line"] is not None:
        x, y, angle = options["line"]
        line = b.ray(b.fixed("N", complex(x, y)), None, angle)
        if circle is None:
            pivot = b.intersect_lines("O", line, chord)
        else:
            pivot = b.intersect_line_circle("O", line, *circle, branch)
    elif options["centres"] is not None:
        frame = b.length("OC", options["centres"])
        if circle is None:
            pivot = b.intersect_line_circle("O", chord, c, frame, LineSense.BACKWARD)
        else:
            pivot = b.intersect_circles(
                "O", c, frame, *circle, Side.LEFT if branch is LineSense.FORWARD else Side.RIGHT
            )
    else:
        assert circle is not None
        pivot = b.second_intersection("O", near, b.ray(near, chord, side.value * beta), circle[0])
        b.phrases[pivot] = ("again", {"tail": near, "head": far, "angle": beta, "point": pivot})
    long, short = b.measure("O B'", pivot, far), b.measure("O B''", pivot, near)
    crank = b.half_sum(long, short, ("AB", "OA"))
    if options["centres"] is None:
        b.length_from("OC", b.measure("O C", pivot, c))
    out = b.opposite("A'", pivot, far, crank, LineSense.FORWARD)
    back = b.opposite("A''", pivot, near, crank, LineSense.BACKWARD)
    b.circles.append((pivot, out, back))
    try:
        trace = read(b)
    except AssemblyError:
        return None
    o, one, two = (place(trace, name) for name in ("O", "B'", "B''"))
    sides = [(np.conj(-o) * (end - o)).imag for end in (one, two)]
    seen = (np.conj(one - two) * (o - two)).imag * side.value
    lengths = lengths_of(trace, LENGTHS)
    worst = transmission(*lengths.values())
    short_way, long_way = abs(two - o), abs(one - o)
    tiny = 1e-9 * options["rocker"]
    on_arc = circle is None or seen > 0.0
    turns = sides[0] * sides[1] > 0.0 and worst > 1e-6
    if not (on_arc and turns and short_way > tiny and long_way - short_way > tiny):
        return None
    left = (np.conj(-place(trace, "A'") + 0j) * (one - place(trace, "A'"))).imag > 0.0
    tables = (
        FileTable("links.1", "crank", ('points = ["O", "A"]', 'OA = "l_OA"')),
        FileTable("links.2", "coupler", ('points = ["A", "B"]', 'AB = "l_AB"')),
        FileTable("links.3", "rocker", ('points = ["C", "B"]', 'CB = "l_CB"')),
        FileTable("assembly", "assembly", (f'B = "{"left" if left else "right"} of AC"',)),
    )
    poses = tuple(
        Pose((("O", pin, end), ("C", end)), (pin, end)) for pin, end in ((out, far), (back, near))
    )
    facts = {} if options["line"] or options["centres"] else {"beta_deg": inner * beta}
    return -worst, Synthesis(
        "crank-rocker",
        b,
        LENGTHS,
        ("O", "C"),
        poses,
        {"K_v": options["K_v"], "swing": options["swing"]},
        "3",
        ("A", "B", "C"),
        LENGTHS,
        tables,
        driver=("O", out),
        facts=facts,
        theta=("O", near, far) if theta > 0.0 else (),
    )
