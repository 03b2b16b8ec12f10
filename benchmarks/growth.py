"""Growth of cost with size: links of a chain, loads, wheels of a train, works of a group."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from msgspec import Struct

from benchmarks.bounds import Bound
from benchmarks.scenes import chain, slotted, train, with_loads
from planmethod.bench.measurements import clock, crank_angles
from planmethod.check.checking import check
from planmethod.check.simulation import simulate_submissions
from planmethod.check.task import Task
from planmethod.gears import reader as trains
from planmethod.gears.record import record
from planmethod.problem.model import Problem
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.solution import Solution

LINEAR = 1.1
"""Exponent up to which cost is called linear."""

AT = 51
"""Links of the chain whose time has a limit, and that limit, s a position and link."""
AT_MOST = 60e-9

DYADS = (1, 2, 4, 8, 16, 25, 50, 100)
LOADS = (5, 10, 20, 50, 100, 200)
WHEELS = (4, 8, 15, 30, 60)
WORKS = (10, 30, 100, 300)


class Chain(Struct, frozen=True):
    """Cost of a chain of dyads, in seconds of processor time.

    Attributes
    ----------
    live : int
        Largest number of values of a position in use at a time.
    ready, one, many : float
        Cost of preparing, of one position, of ``count`` positions.
    """

    links: int
    steps: int
    live: int
    ready: float
    one: float
    many: float
    count: int

    @property
    def each(self) -> float:
        """Seconds for a position and link of many."""
        return self.many / self.count / self.links


class Cost(Struct, frozen=True):
    """Cost of work of some size, in seconds of processor time."""

    what: str
    number: int
    seconds: float


def worked(act: Callable[[], object]) -> float:
    """Return the median cost of a call, in seconds of processor time.

    Growth is measured by it, since other processes on the same core do not count.
    """
    return clock(act, enough=0.3, min_runs=9, timer=time.thread_time).median


def by_links(dyads: Sequence[int] = DYADS, *, count: int = 10_000) -> list[Chain]:
    """Measure chains with these numbers of dyads, all quantities requested, in NumPy's blocks."""
    found = []
    angles = crank_angles(count)
    for k in dyads:
        problem = chain(k)
        ready = worked(partial(Sweep, problem, native=False))
        sweep = Sweep(problem, native=False)
        out = np.empty((len(sweep.rows), count))
        one = worked(partial(sweep.run, angles[:1]))
        many = worked(partial(sweep.run, angles, out=out))
        found.append(Chain(1 + 2 * k, sweep.steps, sweep.live, ready, one, many, count))
    return found


def by_loads(numbers: Sequence[int] = LOADS) -> list[Cost]:
    """Measure force plans of 36 positions of a six-link mechanism by the number of loads."""
    found = []
    for number in numbers:
        problem = with_loads(number)

        def solved(problem: Problem = problem) -> object:
            return statics_of(Solution(problem, positions=crank_angles(36).tolist())).si

        found.append(Cost("loads, 36 positions", number, worked(solved)))
    return found


def by_wheels(numbers: Sequence[int] = WHEELS) -> list[Cost]:
    """Measure the record of a train by its number of wheels in a row."""
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for number in numbers:
            path = Path(folder) / f"{number}.toml"
            path.write_text(train(number), "utf-8")
            problem = trains.load(path)
            found.append(Cost("wheels of a train", number, worked(partial(record, problem, "en"))))
    return found


def by_works(numbers: Sequence[int] = WORKS) -> list[Cost]:
    """Measure the checking of correct submissions of one task by their number."""
    task = Task(Solution(slotted()))
    works = simulate_submissions(task, count=numbers[-1], seed=1)
    answers = len(works[0].answers)

    def checked(number: int) -> None:
        for work in works[:number]:
            check(task, work)

    return [
        Cost("answers of a group", number * answers, worked(partial(checked, number)))
        for number in numbers
    ]


def exponent(numbers: Sequence[float], costs: Sequence[float]) -> float:
    """Return the exponent of growth by all sizes: the slope between logarithms."""
    return float(np.polyfit(np.log(numbers), np.log(costs), 1)[0])


def bounds_of_links(found: Sequence[Chain]) -> list[Bound]:
    """Return the limits for a chain of dyads."""
    sizes = [one.links for one in found]
    held = [
        Bound(
            f"chain of dyads, to {sizes[-1]} links: exponent of {what}",
            exponent(sizes, [getattr(one, key) for one in found]),
            LINEAR,
        )
        for what, key in (("running", "many"), ("one position", "one"), ("preparing", "ready"))
    ]
    held += [
        Bound(f"{AT} links: ns for a position and link", one.each * 1e9, AT_MOST * 1e9)
        for one in found
        if one.links == AT
    ]
    return held


def bounds_of_costs(found: Sequence[Cost]) -> list[Bound]:
    """Return the limits for the other costs that grow."""
    held = []
    for what in dict.fromkeys(one.what for one in found):
        own = [one for one in found if one.what == what]
        grown = exponent([one.number for one in own], [one.seconds for one in own])
        held.append(Bound(f"{what}: exponent", grown, LINEAR))
    return held
