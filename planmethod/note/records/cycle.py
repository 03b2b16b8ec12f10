"""Machine-readable record of the cycle: ``cycle`` of ``solve --json``, and the analogues."""

from __future__ import annotations

from typing import Any

import numpy as np

from planmethod.note.columns import Column, listed, pairs, rows
from planmethod.note.numbers import plain
from planmethod.problem.model import Differentiation
from planmethod.solved.analogues import analogues
from planmethod.solved.solution import Solution
from planmethod.solved.turn.construction import extreme_construction
from planmethod.solved.turn.diagrams import Diagrams, diagrams_of
from planmethod.solved.turn.turn import TURN, Extreme, NoNumber, Turn, turn_of


def analogue_records(solution: Solution) -> list[dict[str, Any]]:
    """Return the transfer functions of every point and link, for every position of a solution.

    Of a point ``x1``, ``y1`` (m per radian of the crank) and ``x2``, ``y2`` (m per radian²); of a
    link ``1`` and ``2`` (of its angle, radians). Of a driving slider per metre of its way.
    """
    points, links = analogues(solution)
    told: dict[str, dict[str, Column]] = {
        name: {
            "x1": listed(one.velocity.real),
            "y1": listed(one.velocity.imag),
            "x2": listed(one.acceleration.real),
            "y2": listed(one.acceleration.imag),
        }
        for name, one in points.items()
    }
    for name, (first, second) in links.items():  # which may be called as a point is
        told.setdefault(name, {}).update({"1": listed(first), "2": listed(second)})
    count = len(solution.positions)
    return rows({name: rows(columns) for name, columns in told.items()}, count)


def cycle_record(solution: Solution) -> dict[str, Any]:
    """Return what is told of the turn of a crank as plain data, SI, degrees of the crank.

    ``value`` and ``stroke`` are m, or degrees of a link. What does not exist is None, and
    ``reasons`` says why. Diagrams are millimetres; of the path, and of what is exact, the first
    position stands at the end again.
    """
    turn, diagrams = turn_of(solution), diagrams_of(solution)
    reasons: dict[str, NoNumber | None] = {}
    working, idle = turn.phases or (None, None)
    if turn.phases is None:
        reasons |= dict.fromkeys(
            ("working_deg", "idle_deg"), turn.why_no_stroke or NoNumber.PARTIAL
        )
    if turn.stroke is None:
        reasons["stroke"] = turn.why_no_stroke
    if turn.ratio is None:
        reasons["K_v"] = turn.why_no_ratio
    if not turn.zero_is_asked:
        reasons["zero_deg"] = turn.why_no_stroke or NoNumber.PARTIAL
    peak = turn.pressure
    if peak is None:
        reasons["pressure_angle"] = NoNumber.NO_DYAD
    if diagrams.mu_t is None:
        reasons["mu_t"] = NoNumber.NO_RATE
    return {
        "output": turn.output.name,
        "zero_deg": plain(turn.zero),
        "positions_deg": listed(turn.positions),
        "extremes": [
            {"phi_deg": plain(one.phi), "value": plain(one.value), **_constructed(solution, one)}
            for one in turn.extremes
        ],
        "stroke": turn.stroke,
        "K_v": turn.ratio,
        "working_deg": working,
        "idle_deg": idle,
        "range_deg": None if turn.range is None else listed(turn.range),
        "pressure_angle": None
        if peak is None
        else {
            "max_deg": plain(peak.most),
            "phi_deg": plain(peak.most_at),
            "min_deg": plain(peak.least),
            "min_phi_deg": plain(peak.least_at),
        },
        "diagrams": _diagrams(diagrams),
        "hodograph": _hodograph(turn),
        **({"reasons": {key: why.value for key, why in reasons.items() if why}} if reasons else {}),
    }


def _constructed(solution: Solution, extreme: Extreme) -> dict[str, float]:
    """Return an extreme position as the ruler reads it, and its sigma, where it is constructed."""
    made = extreme_construction(solution)
    for k, phi in enumerate(made.phi if made is not None else ()):
        assert made is not None
        if abs((extreme.phi - phi + TURN / 2) % TURN - TURN / 2) < 1e-9:
            return {"read_deg": plain(extreme.phi + made.off(k)), "sigma_deg": plain(made.sigma[k])}
    return {}


def _diagrams(diagrams: Diagrams) -> dict[str, Any]:
    s, v_chord, a_chord = diagrams.drawn(Differentiation.CHORDS)
    _, v_exact, a_exact = diagrams.exact(diagrams.shares)
    return {
        "mu_phi": diagrams.mu_phi,
        "mu_t": diagrams.mu_t,
        "mu_s": diagrams.mu_s,
        "mu_v": diagrams.mu_v,
        "mu_a": diagrams.mu_a,
        "s_mm": listed(s),
        "v_chord_mm": listed(v_chord),
        "v_curve_mm": listed(diagrams.curve),
        "a_chord_mm": listed(a_chord),
        "v_exact_mm": listed(v_exact),
        "a_exact_mm": listed(a_exact),
    }


def _hodograph(turn: Turn) -> dict[str, list[list[float | None]]]:
    """Return the velocities of the moving points in the positions of the cycle, m/s."""
    reading = turn.read(turn.positions)
    rate = turn.solution.problem.drive.rate
    found = {}
    plan = turn.unit.construction.kinematics.velocity
    for name, at in plan.named.items():
        velocity = rate * reading.point(plan.point[at])
        if np.any(velocity != 0) or not rate:
            found[name] = pairs(velocity)
    return found
