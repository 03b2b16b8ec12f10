"""Positions given by an angle of two links or a line: all are found, and each by its number."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from doors import (
    AssemblyError,
    Complexes,
    ProblemError,
    ReadingReals as Reals,
    Solution,
    kinds_load as load,
    kinds_loads as loads,
)

FILE = """
[frame]
O = [0, 0]
C = [{c}, 0]
[links.1]
points = ["O", "A"]
OA = {r}
[links.2]
points = ["A", "B"]
AB = {l}
[links.3]
points = ["B", "C"]
BC = {m}
[assembly]
B = "left of AC"
[driver]
link = "1"
omega = 10
"""


def fourbar(phi: Reals, r: float, l: float, m: float, c: float) -> tuple[Complexes, Complexes]:  # noqa: E741
    """Return A and B by the cosine theorem, B on the left of AC."""
    a = r * np.exp(1j * phi)
    d = np.abs(c - a)
    along = (l**2 - m**2 + d**2) / (2 * d)
    with np.errstate(invalid="ignore"):
        b = a + (c - a) / d * (along + 1j * np.sqrt(l**2 - along**2))
    return a, b


def between(p: Complexes, q: Complexes) -> Reals:
    return np.asarray(np.degrees(np.abs(np.angle(p / q))))


def found(path: Path, text: str) -> list[float]:
    """Return the positions of a file, requested by their numbers."""
    places: list[float] = []
    for number in range(1, 9):
        path.write_text(f"{text}root = {number}\n", encoding="utf-8")
        try:
            problem = load(path)
        except AssemblyError:
            return []
        except ProblemError as error:
            (fault,) = error.faults
            assert len(re.findall(r"near [-0-9.e]+", str(fault))) == len(places)
            return places
        assert problem is not None
        places.append(problem.drive.positions[0])
    raise AssertionError(places)


@pytest.mark.parametrize("seed", range(6))
def test_all_positions_with_an_angle_between_links_are_found(tmp_path: Path, seed: int) -> None:
    rng = np.random.default_rng(seed)
    r, c = 0.1, float(rng.uniform(0.3, 0.5))
    m = float(rng.uniform(0.25, 0.4))
    sizes = {"r": r, "l": float(rng.uniform(c - m + 0.12, c + m - 0.12)), "m": m, "c": c}
    phi = np.radians(np.linspace(0.0, 360.0, 200_001))
    a, b = fourbar(phi, **sizes)
    angles = {"2_3": between(a - b, c - b), "1_2": between(-a, b - a), "1_3": between(a, c - b)}
    for pair, angle in angles.items():
        target = float(np.nanmean(angle))
        off = angle - target
        crossed = np.flatnonzero(off[:-1] * off[1:] < 0)
        places = found(tmp_path / "posed.toml", FILE.format(**sizes) + f"phi_{pair} = {target!r}\n")
        assert places == pytest.approx(np.degrees(phi[crossed]), abs=2e-3)
        a1, b1 = fourbar(np.radians(places), **sizes)
        exact = {"2_3": between(a1 - b1, c - b1), "1_2": between(-a1, b1 - a1)}
        assert exact.get(pair, between(a1, c - b1)) == pytest.approx(target, abs=1e-9)


@pytest.mark.parametrize(("beyond", "count"), [(-1e-5, 2), (0.0, 1), (1e-3, 0)])
def test_an_angle_that_is_only_touched_is_one_position(
    tmp_path: Path, beyond: float, count: int
) -> None:
    sizes = {"r": 0.1, "l": 0.4, "m": 0.4, "c": 0.55}
    most = float(np.degrees(2 * np.arcsin((0.55 + 0.1) / 0.8)))  # with A on the far side of O
    text = FILE.format(**sizes) + f"phi_2_3 = {most + beyond!r}\n"
    places = found(tmp_path / "posed.toml", text)
    assert len(places) == count
    assert places == pytest.approx([180.0] * count, abs=0.2)


def test_variants_have_angles_between_links(tmp_path: Path) -> None:
    (tmp_path / "variants.csv").write_text(
        "no;φ2,3;root\nA;80;near 250\nB;70;1\n", encoding="utf-8"
    )
    text = FILE.format(r=0.1, l=0.4, m=0.4, c=0.55) + "phi_2_3 = 90\nroot = 1\n"
    path = tmp_path / "posed.toml"
    path.write_text('variants = "variants.csv"\n' + text, encoding="utf-8")
    for variant, angle, number in (("A", 80, 1), ("B", 70, 0)):
        problem = load(path, variant=variant)
        assert problem is not None
        side = 0.8 * np.sin(np.radians(angle / 2))
        phi = np.degrees(np.arccos((0.01 + 0.55**2 - side**2) / (2 * 0.1 * 0.55)))
        assert problem.drive.positions[0] == pytest.approx((phi, 360 - phi)[number], abs=1e-9)


SCISSOR = """
[frame]
O = [0, 0]
guides.floor = { through = "O", angle = 0 }
[links.1]
points = ["O", "M", "B", "P"]
OM = 0.5
OB = 1.0
M = { on = "OB", at = 0.5 }
P = { on = "OB", at = 0.2 }
[links.2]
points = ["A", "M", "E", "Q"]
AE = 1.0
M = { on = "AE", at = 0.5 }
Q = { on = "AE", at = 0.7 }
[links.3]
points = ["A"]
slides = { on = "floor" }
[links.4]
points = ["P"]
slides = { on = "5", through = "Q" }
[links.5]
points = ["Q"]
[driver]
link = "1"
PQ = 0.4
v_PQ = 0.02
root = "near 52"
[assembly]
A = "right of O"
"""
"""With A at O, the other way, PQ is the same in all positions: each of them is a least one."""


def test_where_the_output_stays_as_it_is_positions_are_looked_at_together(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    read, count = Solution.read, []

    def counted(self: Solution, *given: Any) -> Any:
        count.append(len(self.positions))
        return read(self, *given)

    monkeypatch.setattr(Solution, "read", counted)
    problem = loads(SCISSOR, name="scissor")
    assert len(count) < 150  # one by one they were 3047
    (phi,) = problem.drive.positions
    turned = np.radians(phi)  # A = 2·OM·cos, P and Q from O and A along the links
    p, q = 0.2 * np.exp(1j * turned), np.cos(turned) - 0.7 * np.exp(-1j * turned)
    assert abs(p - q) == pytest.approx(0.4, rel=1e-12)


SQUARE = """
frame = { O = [0, 0], guides.x-x = { through = "O", angle = 0 } }
assembly = { B = { rule = "right of A", keep = "continuous" } }
[links.1]
points = ["O", "A"]
OA = 0.06
[links.2]
points = ["A", "B"]
AB = 0.1
[links.3]
points = ["B"]
slides = { on = "x-x", offset = 0.04 }
[driver]
link = "1"
omega = 10
"""
"""A slider-crank that comes again after two turns, B being left of A in one of them."""


def place(phi: Reals, side: Reals | float) -> Reals:
    off = 0.04 - 0.06 * np.sin(np.radians(phi))
    return np.asarray(0.06 * np.cos(np.radians(phi)) + side * np.sqrt(0.1**2 - off**2))


def met(values: Reals, target: float) -> int:
    return int(np.count_nonzero(np.diff(np.sign(values - target))))


@pytest.mark.parametrize("target", [0.1, 0.031, 0.004, 0.15])
def test_a_position_is_where_its_rule_holds_though_the_motion_needs_two_turns(
    tmp_path: Path, target: float
) -> None:
    places = found(tmp_path / "square.toml", f"{SQUARE}x_B = {target}\n")
    assert len(places) == met(place(np.linspace(0.0, 360.0, 3601) + 0.013, 1.0), target)
    assert place(np.array(places), 1.0) == pytest.approx(target, abs=1e-9)


def test_a_position_in_which_the_rule_does_not_hold_is_not_a_first_position() -> None:
    with pytest.raises(AssemblyError, match=r"x_B ranges from 4\.78\d+e-05 m"):
        loads(f"{SQUARE}x_B = -0.1\n", name="square")
    with pytest.raises(AssemblyError, match="at = extreme left is not reached"):
        loads(f'{SQUARE}at = "left extreme"\n', name="square")


@pytest.mark.parametrize(("root", "first"), [("near 80", 88.0769), ("near 320", 315.5259)])
def test_a_further_position_is_looked_for_in_both_turns(root: str, first: float) -> None:
    problem = loads(f'{SQUARE}x_B = [0.1, -0.1]\nroot = "{root}"\n', name="square")
    solution = Solution(problem)
    assert solution.positions[0] == pytest.approx(first, abs=1e-4)
    assert solution.points["B"].place.real == pytest.approx([0.1, -0.1], abs=1e-9)
