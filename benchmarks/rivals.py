"""Speed of this package on one four-bar beside its peers, and how its cost grows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from benchmarks.peers import peers
from benchmarks.scenes import FOURBAR_ROWS, fourbar, slotted
from planmethod.bench.measurements import (
    Timing,
    clock,
    crank_angles,
    everything,
    right_rows,
    row_error,
    spread,
)
from planmethod.solved.many.sweep import Sweep

Array = npt.NDArray[Any]

SIZES = (12, 10_000, 1_000_000)
"""Numbers of positions of the table of peers."""


@dataclass(frozen=True, slots=True)
class Rival:
    """A peer that solves the four-bar, at the sizes of the table.

    Attributes
    ----------
    seconds : dict of int to Timing
        By number of positions.
    error : dict of int to float
        As in `Reading`.
    """

    name: str
    computes: str
    seconds: dict[int, Timing]
    error: dict[int, float]


def rivals(sizes: Sequence[int] = SIZES, *, rounds: int = 9) -> list[Rival]:
    """Time this package and its peers on one four-bar, taking turns."""
    sweep = Sweep(fourbar(), FOURBAR_ROWS, native=False)
    with_phi = [*(r for r in FOURBAR_ROWS if r[0] != "u"), "phi_2", "phi_3"]
    angled = Sweep(fourbar(), with_phi, native=False)
    loose = Sweep(fourbar(), FOURBAR_ROWS, native=False)
    machine = Sweep(fourbar(), FOURBAR_ROWS, native=True)
    buffers = {n: np.empty((len(sweep.rows), n)) for n in sizes}
    more = {n: np.empty((len(angled.rows), n)) for n in sizes}
    angles = {n: crank_angles(n) for n in sizes}
    shuffled = {n: np.random.default_rng(1).permutation(angles[n]) for n in sizes}

    def swept(n: int) -> Array:
        return sweep.run(angles[n], out=None if n <= 40 else buffers[n])

    def with_angles(n: int) -> Array:
        return angled.run(angles[n], out=None if n <= 40 else more[n])

    def uneven(n: int) -> Array:
        return loose.run(shuffled[n], out=None if n <= 40 else buffers[n])

    def stored(n: int) -> None:
        buffers[n].fill(1.0)

    acts: list[tuple[str, str, Callable[[int], Array | None], tuple[int, ...]]] = [
        (
            "planmethod, sweep",
            "all points and links, 20 rows; directions as unit vectors",
            swept,
            tuple(range(20)),
        ),
        (
            "planmethod, sweep, phi in degrees",
            "all points and links, 18 rows; directions by the arc tangent",
            with_angles,
            (),
        ),
        ("planmethod, sweep, uneven phi", "20 rows, no table of angles", uneven, ()),
    ]
    if not machine.uncompiled:
        bound = {n: machine.bind(angles[n], out=buffers[n]) for n in sizes}
        more_acts = (
            (
                "machine code",
                "the same tape compiled",
                lambda n: machine.run(angles[n], out=buffers[n]),
            ),
            ("bound call", "the same, prepared and checked once", lambda n: bound[n]()),
        )
        acts += [
            (f"planmethod, {name}", f"20 rows; {said}", act, tuple(range(20)))
            for name, said, act in more_acts
        ]
    acts.append(("stores alone", "the buffer of 20 rows filled, nothing computed", stored, ()))
    for peer in peers():
        acts.append(
            (peer.name, peer.computes, lambda n, p=peer: p.run(angles[n]), peer.rows)  # type: ignore[misc]
        )
    times: dict[tuple[str, int], list[Timing]] = {}
    for _ in range(rounds):
        for n in sizes:
            for name, _, act, _ in acts:
                times.setdefault((name, n), []).append(
                    clock(lambda a=act, k=n: a(k), enough=0.1, min_runs=3)  # type: ignore[misc]
                )
    right = {n: right_rows(fourbar(), FOURBAR_ROWS, angles[n][spread(n)]) for n in sizes}
    found = []
    for name, computes, act, rows in acts:
        seconds = {n: sorted(times[name, n], key=lambda t: t.median)[rounds // 2] for n in sizes}
        error = {}
        for n in sizes if rows else ():
            answer = act(n)
            if answer is not None:
                error[n] = row_error(right[n][list(rows)], answer[:, spread(n)])
        found.append(Rival(name, computes, seconds, error))
    return found


# How cost grows ---------------------------------------------------------------------------


def by_positions(counts: Sequence[int]) -> list[tuple[int, float]]:
    """Return (positions, seconds) of a sweep of the slotted link."""
    problem = slotted()
    sweep = Sweep(problem, everything(problem))
    found = []
    for n in counts:
        out = None if n <= 40 else np.empty((len(sweep.rows), n))
        angles = crank_angles(n)
        found.append((n, clock(lambda a=angles, o=out: sweep.run(a, out=o)).median))  # type: ignore[misc]
    return found


SCENES: tuple[tuple[str, tuple[str, ...] | None], ...] = (
    ("positions only", ("positions",)),
    ("one velocity", ("v_D",)),
    ("velocities", ("velocities",)),
    ("everything", None),
)
"""Quantities to request, from fewest to all."""


def by_scene(count: int = 10_000) -> list[tuple[str, int, int, float, float]]:
    """Return (requested quantities, steps, operations, seconds for one position, for ``count``)."""
    problem = slotted()
    angles = crank_angles(count)
    found = []
    for name, asked in SCENES:
        sweep = Sweep(problem, asked)
        out = np.empty((len(sweep.rows), count))
        one = clock(lambda s=sweep: s.run(angles[:1])).median  # type: ignore[misc]
        many = clock(lambda s=sweep, o=out: s.run(angles, out=o)).median  # type: ignore[misc]
        found.append((name, sweep.steps, sweep.operations, one, many))
    return found
