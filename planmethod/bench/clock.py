"""How long something takes."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass


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
