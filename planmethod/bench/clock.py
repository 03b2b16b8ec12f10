"""How long something takes, in this process or in one of its own."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
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


def clock_processes(commands: Sequence[Sequence[str]], *, runs: int = 5) -> list[Timing]:
    """Time whole processes, taking turns so that a slow moment falls on all of them.

    The first round warms the disk and lets Python keep what it compiled, as an installed package
    has it kept.
    """
    times: list[list[float]] = [[] for _ in commands]
    for turn in range(runs + 1):
        for mine, command in zip(times, commands, strict=True):
            start = time.perf_counter()
            subprocess.run(command, check=True, capture_output=True, env=_environment())
            if turn:
                mine.append(time.perf_counter() - start)
    return [Timing(statistics.median(t), min(t), max(t), len(t)) for t in times]


def _environment() -> dict[str, str]:
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, "PYTHONIOENCODING": "utf-8"}


def run_python(source: str) -> str:
    """Run a few lines in a fresh interpreter and return what they print."""
    env = _environment()
    done = subprocess.run(
        [sys.executable, "-c", source], check=True, capture_output=True, env=env, encoding="utf-8"
    )
    return done.stdout.strip()
