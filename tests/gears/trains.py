"""Random gear trains with their speeds by the formulas of the textbook, step by step."""

from __future__ import annotations

import random
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path

from doors import TrainMotion, gears_reader_load as load, solve_motion

F = Fraction


def solved(folder: Path, text: str) -> TrainMotion:
    path = folder / "train.toml"
    path.write_text(f"[gears]\n{text}", encoding="utf-8")
    return solve_motion(load(path))


@dataclass(frozen=True)
class Made:
    text: str
    speeds: dict[str, Fraction]


def mesh(one: str, other: str, kind: str = "external", carrier: str = "") -> str:
    carried = f', carrier = "{carrier}"' if carrier else ""
    return f'{{ of = ["{one}", "{other}"], kind = "{kind}"{carried} }}'


def told(wheels: dict[str, int], meshes: list[str], rest: str) -> str:
    teeth = ", ".join(f'"{label}" = {z}' for label, z in wheels.items())
    return f"wheels = {{ {teeth} }}\nmeshes = [ {', '.join(meshes)} ]\n{rest}\n"


def ordinary(rng: random.Random) -> Made:
    """A row of double wheels, by the product of the stages."""
    wheels: dict[str, int] = {}
    meshes, speeds = [], {"1": F(rng.randint(1, 3000) * rng.choice((1, -1)))}
    for k in range(1, rng.randint(2, 6)):
        one = f"{k}'" if k > 1 and rng.random() < 0.6 else f"{k}"
        internal = rng.random() < 0.3
        wheels.setdefault(one, rng.randint(12, 60))
        other = f"{k + 1}"
        wheels[other] = wheels[one] + rng.randint(10, 50) if internal else rng.randint(12, 90)
        meshes.append(mesh(one, other, "internal" if internal else "external"))
        ratio = F(wheels[one], wheels[other])
        speeds[other] = speeds[str(k)] * (ratio if internal else -ratio)
    return Made(told(wheels, meshes, f"n = {{ 1 = {speeds['1']} }}"), speeds)


def row_of(rng: random.Random) -> tuple[dict[str, int], list[str], Fraction]:
    """A set 1-2-2'-3 on H, coaxial, and its ratio U_13 with H held."""
    z1, z2 = rng.randint(15, 40), rng.randint(15, 40)
    if rng.random() < 0.5:  # ring, single planet gear
        wheels = {"1": z1, "2": z2, "3": z1 + 2 * z2}
        meshes = [mesh("1", "2", carrier="H"), mesh("2", "3", "internal", "H")]
        return wheels, meshes, -F(wheels["3"], z1)
    if rng.random() < 0.5:  # ring, double planet gear
        rim = rng.randint(15, 40)
        wheels = {"1": z1, "2": z2, "2'": rim, "3": z1 + z2 + rim}
        meshes = [mesh("1", "2", carrier="H"), mesh("2'", "3", "internal", "H")]
        return wheels, meshes, -F(z2 * wheels["3"], z1 * rim)
    rim = rng.randint(10, z1 + z2 - 10)
    if rim == z2:
        rim += 1
    wheels = {"1": z1, "2": z2, "2'": rim, "3": z1 + z2 - rim}
    meshes = [mesh("1", "2", carrier="H"), mesh("2'", "3", "external", "H")]
    return wheels, meshes, F(z2 * wheels["3"], z1 * rim)


def planetary(rng: random.Random) -> Made:
    wheels, meshes, held = row_of(rng)
    n_1 = F(rng.randint(1, 2000))
    n_h = n_1 / (1 - held)
    n_2 = n_h - (n_1 - n_h) * F(wheels["1"], wheels["2"])
    speeds = {"1": n_1, "H": n_h, "3": F(0), "2": n_2}
    return Made(told(wheels, meshes, f'fixed = ["3"]\nn = {{ 1 = {n_1} }}'), speeds)


def differential(rng: random.Random) -> Made:
    wheels, meshes, held = row_of(rng)
    n_1, n_h = F(rng.randint(-900, 900)), F(rng.randint(-900, 900))
    speeds = {"1": n_1, "H": n_h, "3": n_h + (n_1 - n_h) / held}
    return Made(told(wheels, meshes, f"n = {{ 1 = {n_1}, H = {n_h} }}"), speeds)


def closed(rng: random.Random) -> Made:
    """The set is closed by 3'-4-5, and 5 is one body with H."""
    wheels, meshes, held = row_of(rng)
    z3, z4 = rng.randint(15, 40), rng.randint(15, 40)
    wheels |= {"3'": z3, "4": z4, "5": z3 + 2 * z4}
    meshes += [mesh("3'", "4"), mesh("4", "5", "internal")]
    closing = -F(wheels["5"], z3)
    u_1h = held * (closing - 1) + 1
    n_h = F(rng.randint(1, 500))
    speeds = {"H": n_h, "5": n_h, "1": u_1h * n_h, "3": closing * n_h}
    return Made(told(wheels, meshes, f'bodies = [["5", "H"]]\nn = {{ H = {n_h} }}'), speeds)


def bevel(rng: random.Random) -> Made:
    """Two wheels on one axis with a double satellite across it between them."""
    z1, z2, rim, z3 = (rng.randint(15, 60) for _ in range(4))
    wheels = {"1": z1, "2": z2, "2'": rim, "3": z3}
    meshes = [mesh("1", "2", "bevel", "H"), mesh("2'", "3", "bevel", "H")]
    n_1, n_h = F(rng.randint(-900, 900)), F(rng.randint(-900, 900))
    own = (n_1 - n_h) * F(z1, z2)
    speeds = {"1": n_1, "H": n_h, "2": own, "3": n_h - own * F(rim, z3)}
    return Made(told(wheels, meshes, f"n = {{ 1 = {n_1}, H = {n_h} }}"), speeds)


MAKERS = (ordinary, planetary, differential, closed, bevel)
