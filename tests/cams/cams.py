"""Cams for tests, and laws and least cams computed in another way: on grids, by own formulas."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from math import hypot, pi, radians, tan
from pathlib import Path
from typing import Any

import numpy as np
from doors import CamDesign, LawsReals as Reals, cams_reader_load as load
from worked import PROBLEMS

SHIPPED = sorted((PROBLEMS / "cams").glob("*.toml"))

Shape = Callable[[Reals], Reals]

LAWS: dict[str, tuple[Shape, Shape]] = {
    "3-4-5": (
        lambda u: 10 * u**3 - 15 * u**4 + 6 * u**5,
        lambda u: 30 * u**2 * (1 - u) ** 2,
    ),
    "4-5-6-7": (
        lambda u: 35 * u**4 - 84 * u**5 + 70 * u**6 - 20 * u**7,
        lambda u: 140 * u**3 * (1 - u) ** 3,
    ),
    "cosine": (lambda u: (1 - np.cos(pi * u)) / 2, lambda u: pi / 2 * np.sin(pi * u)),
    "sine": (
        lambda u: u - np.sin(2 * pi * u) / (2 * pi),
        lambda u: 1 - np.cos(2 * pi * u),
    ),
    "constant-acceleration": (
        lambda u: np.where(u < 0.5, 2 * u * u, 1 - 2 * (1 - u) ** 2),
        lambda u: np.where(u < 0.5, 4 * u, 4 * (1 - u)),
    ),
    "linear": (lambda u: u, np.ones_like),
}
"""Value and derivative of laws in units of their phase."""


def written(folder: Path, keys: dict[str, Any]) -> Path:
    """Write a cam file of some keys of ``[cam]``."""

    def said(value: Any) -> str:
        if isinstance(value, dict):
            return "{" + ", ".join(f"{k} = {said(v)}" for k, v in value.items()) + "}"
        return f'"{value}"' if isinstance(value, str) else repr(value)

    lines = [f"{key} = {said(value)}" for key, value in keys.items()]
    path = folder / "cam.toml"
    path.write_text("\n".join(["[cam]", *lines]) + "\n", "utf-8")
    return path


def designed(folder: Path, keys: dict[str, Any]) -> CamDesign:
    return CamDesign(load(written(folder, keys)))


def random_cam(seed: int) -> dict[str, Any]:
    """Return keys of a cam: two phases with limits, all laws, with and without chosen offset."""
    rng = np.random.default_rng(seed)
    names = [str(rng.choice(list(LAWS))) for _ in range(2)]
    keys: dict[str, Any] = {
        "rise": float(rng.uniform(50, 150)),
        "upper_dwell": float(rng.uniform(0, 40)),
        "return": float(rng.uniform(50, 150)),
        "law": dict(zip(("rise", "return"), names, strict=True)),
        "pressure": {"rise": float(rng.uniform(20, 50)), "return": float(rng.uniform(20, 60))},
        "roller": 0.001,
    }
    if rng.random() < 0.5:
        sense = str(rng.choice(["opposite", "same"]))
        more = {"swing": float(rng.uniform(5, 30)), "arm": float(rng.uniform(0.05, 0.3))}
        return {"follower": "oscillating", "sense": sense, **more, **keys}
    keys |= {"follower": "translating", "stroke": float(rng.uniform(0.01, 0.1))}
    if rng.random() < 0.5:
        keys["offset"] = float(rng.uniform(-0.5, 0.5)) * keys["stroke"]
    return keys


def phase_motion(keys: dict[str, Any], phase: str, u: Reals) -> tuple[Reals, Reals, float]:
    """Return s, v_q (of an arm: angles) and tan of the limit at parts of rise or return."""
    size = radians(keys["swing"]) if "swing" in keys else keys["stroke"]
    value, slope = LAWS[keys["law"][phase]]
    sign = 1 if phase == "rise" else -1
    s, v = size * value(u), sign * size * slope(u) / radians(keys[phase])
    return (s if sign > 0 else size - s), v, tan(radians(keys["pressure"][phase]))


def motion(keys: dict[str, Any], count: int) -> list[tuple[Reals, Reals, float]]:
    """Return the same for rise and return on grids."""
    u = np.linspace(0.0, 1.0, count)
    return [phase_motion(keys, phase, u) for phase in ("rise", "return")]


def least_translating(keys: dict[str, Any], count: int = 100_001) -> float:
    """Return the least r_min by brute force: a golden section over e of the worst angle's s0."""
    parts = motion(keys, count)

    def radius(e: float) -> float:
        deep = [np.max(np.abs(v - e) / t - s) for s, v, t in parts]
        return hypot(e, max(0.0, *map(float, deep)))

    if "offset" in keys:
        return radius(keys["offset"])
    low, high, share = -keys["stroke"] * 4, keys["stroke"] * 4, (5**0.5 - 1) / 2
    for _ in range(70):
        one, two = high - share * (high - low), low + share * (high - low)
        low, high = (low, two) if radius(one) < radius(two) else (one, high)
    return radius((low + high) / 2)


def broken(keys: dict[str, Any], axis: complex) -> float:
    """Return by how much an axis breaks the limits of an arm, m, by sines and cosines of angles.

    ``axis`` is from the roller at rest, the pivot ``arm`` beside it. The worst angle of a grid is
    refined on a finer one.
    """
    side = 1 if keys["sense"] == "opposite" else -1
    arm, most = keys["arm"], -1.0
    to = axis - side * arm

    def worst(phase: str, sign: int, u: Reals) -> Reals:
        s, v, t = phase_motion(keys, phase, u)
        seen = to * np.conj(-side * np.exp(-1j * side * s))
        along = sign * (arm * (1 + side * v) - seen.real)
        return np.asarray((along - t * np.abs(seen.imag)) / hypot(1, t))

    for phase, sign in product(("rise", "return"), (1, -1)):
        low, high = 0.0, 1.0
        for _ in range(2):
            u = np.linspace(low, high, 4001)
            k = int(np.argmax(found := worst(phase, sign, u)))
            most = max(most, float(found[k]))
            low, high = u[max(k - 1, 0)], u[min(k + 1, 4000)]
    return most
