"""How long something takes."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable, Sequence

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True)
class Timing:
    """Median and spread of repeated runs, seconds."""

    median: float
    least: float
    most: float
    runs: int


def clock(act: Callable[[], object], *, enough: float = 0.4, least: int = 5) -> Timing:
    """Time something warm: once to warm up, then until it has run long enough and often enough."""
    act()
    times: list[float] = []
    began = time.perf_counter()
    while len(times) < least or (time.perf_counter() - began < enough and len(times) < 2000):
        start = time.perf_counter()
        act()
        times.append(time.perf_counter() - start)
    return Timing(statistics.median(times), min(times), max(times), len(times))


def clock_all(acts: Sequence[Callable[[], object]], *, rounds: int = 9) -> list[Timing]:
    """Time several things that take turns, so that what else the machine does falls on all."""
    found: list[list[Timing]] = [[] for _ in acts]
    for _ in range(rounds):
        for own, act in zip(found, acts, strict=True):
            own.append(clock(act, enough=0.02, least=3))
    return [sorted(own, key=lambda timing: timing.median)[rounds // 2] for own in found]
