"""Random mechanisms judged by the referee, twelve positions each; branches of crank-rockers."""

from __future__ import annotations

import cmath
import math
import random
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass, field

import numpy as np

from benchmarks.generator import random_problem
from planmethod.problem import loads
from planmethod.problem.model import Problem
from planmethod.solved.accuracy import Refereed, examine
from planmethod.solved.many.sweep import Sweep

POSITIONS = 12
DIGITS = 40
BOUNDS = (1.0, 4.0, 16.0)
"""Multiples of κ·u that results are counted by."""

CHUNK = 50


@dataclass
class Tally:
    """Outcomes of random mechanisms.

    Attributes
    ----------
    within : list of int
        Results within each of `BOUNDS`, and beyond the last.
    worst : list of (float, int, float, str, float)
        Largest multiples: multiple, seed, position, result, condition number.
    """

    mechanisms: int = 0
    positions: int = 0
    impossible: int = 0
    disagreed: int = 0
    unexplained: int = 0
    exceptions: list[str] = field(default_factory=list)
    within: list[int] = field(default_factory=lambda: [0] * (len(BOUNDS) + 1))
    worst: list[tuple[float, int, float, str, float]] = field(default_factory=list)

    def add(self, other: Tally) -> None:
        """Add another tally."""
        for name in ("mechanisms", "positions", "impossible", "disagreed", "unexplained"):
            setattr(self, name, getattr(self, name) + getattr(other, name))
        self.exceptions += other.exceptions
        self.within = [a + b for a, b in zip(self.within, other.within, strict=True)]
        self.worst = sorted([*self.worst, *other.worst], reverse=True)[:10]

    @property
    def results(self) -> int:
        """Results judged."""
        return sum(self.within)


def positions_of(problem: Problem) -> list[float]:
    """Return twelve positions: a turn of a crank, a run of a slider, from the file's position."""
    first = problem.drive.positions[0]
    step = 360.0 / POSITIONS if problem.drive.is_crank else 0.05
    return [first + step * k for k in range(POSITIONS)]


def judge(seeds: Sequence[int]) -> Tally:
    """Judge the random mechanisms of some seeds."""
    tally = Tally()
    np.seterr(all="ignore")
    for seed in seeds:
        tally.mechanisms += 1
        try:
            problem = loads(random_problem(seed)[0], name=f"random-{seed}")
            found = examine(problem, positions_of(problem), digits=DIGITS, closely=False)
        except Exception as error:  # whatever it is, it is a finding
            tally.exceptions.append(f"seed {seed}: {type(error).__name__}: {error}")
            continue
        for position in found:
            _count(tally, position, seed)
    tally.worst = sorted(tally.worst, reverse=True)[:10]
    return tally


def _count(tally: Tally, position: Refereed, seed: int) -> None:
    tally.positions += 1
    tally.impossible += bool(position.reason)
    tally.disagreed += not position.agreed
    tally.unexplained += position.unexplained
    for verdict in position.verdicts:
        beyond = sum(verdict.multiple > bound for bound in BOUNDS)
        tally.within[beyond] += 1
    worst = position.worst
    if worst is not None:
        row = (worst.multiple, seed, position.position, worst.label, worst.kappa)
        tally.worst.append(row)


def run(count: int, *, workers: int = 2) -> Iterator[Tally]:
    """Yield the tally so far of ``count`` random mechanisms, judged in several processes."""
    chunks = [range(k, min(k + CHUNK, count)) for k in range(0, count, CHUNK)]
    whole = Tally()
    with ProcessPoolExecutor(workers) as pool:
        for tally in pool.map(judge, chunks):
            whole.add(tally)
            yield whole


# Branches ---------------------------------------------------------------------------------------


def crank_rocker(seed: int) -> tuple[float, float, float, float]:
    """Return crank, coupler, rocker and frame of a random crank-rocker, metres."""
    draw = random.Random(seed)
    while True:
        a, b, c, d = (draw.uniform(0.05, 1.0) for _ in range(4))
        rest = sorted((b, c, d))
        if a < rest[0] and a + rest[2] < rest[0] + rest[1] - 1e-3:
            return a, b, c, d


def wrong_branches(count: int) -> tuple[int, int]:
    """Return (positions looked at, positions on the wrong branch) of random crank-rockers.

    A crank-rocker never passes from one closing to the other as it turns. What it does is found
    here without plans: its coupler point is followed in small steps of the crank from the closing
    of the first position, always taking the nearer of the two meetings of the arcs.
    """
    looked = wrong = 0
    for seed in range(count):
        a, b, c, d = crank_rocker(seed)
        text = (
            f"[frame]\nA = [0, 0]\nD = [{d!r}, 0]\n[links.1]\npoints = ['A', 'B']\nAB = {a!r}\n"
            f"[links.2]\npoints = ['B', 'C']\nBC = {b!r}\n[links.3]\npoints = ['D', 'C']\n"
            f"DC = {c!r}\n[driver]\nlink = '1'\nphi = 10\nomega = 1\n"
            f"[assembly]\nC = '{'left' if seed % 2 else 'right'} of BD'\n"
        )
        angles = np.arange(POSITIONS) * (360.0 / POSITIONS)
        found = Sweep(loads(text, name=f"crank-rocker-{seed}"), ["C"]).run(angles)
        followed = _follow(a, b, c, d, 1 if seed % 2 else -1)
        gap = np.abs(found[0] + 1j * found[1] - followed)
        looked += POSITIONS
        wrong += int((~(gap < 1e-6)).sum())
    return looked, wrong


def _follow(a: float, b: float, c: float, d: float, side: int) -> list[complex]:
    steps = 30
    places: list[complex] = []
    before: complex | None = None
    for k in range(POSITIONS * steps):
        crank = cmath.rect(a, math.radians(k * 360.0 / POSITIONS / steps))
        gap = d - crank
        along = (abs(gap) ** 2 + b * b - c * c) / (2 * abs(gap))
        up = math.sqrt(max(b * b - along * along, 0.0))
        both = [crank + gap / abs(gap) * complex(along, sign * up) for sign in (1, -1)]
        if before is None:
            before = both[0 if side > 0 else 1]
        else:
            near = before
            before = min(both, key=lambda z: abs(z - near))
        if k % steps == 0:
            places.append(before)
    return places
