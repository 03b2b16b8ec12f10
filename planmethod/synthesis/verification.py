"""Problem file of a synthesized mechanism (файл задачи), and its verification.

The file is commented, ready to solve; the actual motion is found with the solver.
Extreme positions are the roots of the output's velocity, found in the compiled position and
velocity programs to the last digits; the transmission angle is sampled over the whole turn.
"""

# no messages: mistakes in sizes that the program makes

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.errors import PlanMethodError
from planmethod.note.wording import Language
from planmethod.problem.model import Problem
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.reading import Reals
from planmethod.solved.turn.output import Function, crossings, root
from planmethod.synthesis.model import Synthesis, place, ray_angle

COUNT = 12
"""Positions of the driver in a file whose driver turns fully."""

OMEGA = 10.0
"""Angular velocity of the driver, 1/s: to be changed to one's own."""


def problem_text(synthesis: Synthesis, source: str, language: Language) -> str:
    """Return the problem file.

    Parameters
    ----------
    source : str
        The command that made it.
    """
    return "\n".join(_lines(synthesis, source, language)) + "\n"


def _lines(synthesis: Synthesis, source: str, language: Language) -> Iterator[str]:
    texts = language.synthesis
    exact, lengths = synthesis.exact(), synthesis.metres()
    origin = place(exact, synthesis.pivots[0]) if synthesis.pivot_at_origin else 0j
    yield f'title = "{texts["mechanisms"][synthesis.kind]}"'
    yield f'source = "{source}"'
    yield ""
    yield f"[frame] # {texts['comments']['frame']}"
    for pivot in synthesis.pivots:
        at = place(exact, pivot) - origin
        yield f"{pivot} = [{at.real + 0.0!r}, {at.imag + 0.0!r}]"
    for point in synthesis.guide:
        level = (place(exact, point) - origin).imag + 0.0
        yield f"guides.x-x = {{ through = [0.0, {level!r}], angle = 0 }}"
    for table in synthesis.tables[:-1]:
        yield ""
        yield f"[{table.head}] # {texts['comments'][table.word]}"
        yield from (line.format(**lengths) for line in table.lines)
    yield ""
    yield f"[driver] # {texts['comments']['driver']}"
    yield 'link = "1"'
    if synthesis.positions:
        yield f"phi = [{', '.join(repr(phi) for phi in synthesis.positions)}]"
    else:
        pivot, pin = synthesis.driver
        start = ray_angle(place(exact, pivot), place(exact, pin))
        yield f"phi = {{ from = {start!r}, count = {COUNT} }} # {texts['comments']['zero']}"
    yield f"omega = {OMEGA!r} # {texts['comments']['omega']}"
    yield "epsilon = 0.0"
    yield ""
    yield f"[assembly] # {texts['comments']['assembly']}"
    yield from synthesis.tables[-1].lines


CLOSE = 1e-9
"""Relative difference that is allowed between a measured value and its target."""

_GRID = 720
_TYPES = ("crank-rocker", "double-rocker", "rocker-crank", "double-crank")


def checks(synthesis: Synthesis, problem: Problem) -> dict[str, Any]:
    """Return values measured on the mechanism; None, with a reason, for one it does not have.

    Raises
    ------
    PlanMethodError
        It misses a target: rounding is too large, or there is an internal error.
    """
    way = _DriverTurn(synthesis, problem)
    found: dict[str, Any] = {**way.extremes(), **way.angles()}
    found["grashof"] = grashof(synthesis)
    if synthesis.positions:
        found |= way.positions()
    for name, value in synthesis.targets.items():
        measured = found[name]
        if measured is None or not abs(measured - value) <= CLOSE * max(abs(value), 1e-6):
            raise PlanMethodError(
                "The synthesized mechanism has {} = {!r} instead of {!r}: it is too close "
                "to the limit of assembly. Use other values.",
                name,
                measured,
                value,
            )
    return found


def grashof(synthesis: Synthesis) -> dict[str, Any]:
    """Return whether the shortest link turns fully (условие Грасгофа), the margin, and the type.

    ``margin`` is what the other two lengths have more than the shortest and the longest, m; of a
    slider-crank l - r - |e|, of a slotted link O1O3 - O1A.
    """
    named = synthesis.metres()
    sizes = [abs(named[name]) for name in synthesis.grashof]
    if len(sizes) == 2:
        margin, kind = sizes[1] - sizes[0], "swinging slotted link"
    elif len(sizes) == 3:
        margin, kind = sizes[1] - sizes[0] - sizes[2], "slider-crank"
    else:
        low, *middle, high = sorted(sizes)
        margin = sum(middle) - low - high
        kind = _TYPES[sizes.index(low)]
        if margin <= 0.0:
            kind = "triple-rocker" if margin < 0.0 else "change point"
    return {"holds": bool(margin >= 0.0), "margin": margin, "type": kind}


class _DriverTurn:
    """The mechanism over the turn of its driver."""

    def __init__(self, synthesis: Synthesis, problem: Problem) -> None:
        self.synthesis, self.problem = synthesis, problem
        output = synthesis.output
        self.is_link = output in problem.mechanism.links
        self.value, self.rate = (
            (f"{output}.phi_deg", f"{output}.omega")
            if self.is_link
            else (f"{output}.x", f"{output}.vx")
        )
        points = sorted({p for p in synthesis.pressure if p and p not in synthesis.pivots})
        motion = [f"phi_{output}", f"omega_{output}"] if self.is_link else [output, f"v_{output}"]
        # The link whose angle to the output shows how it is driven; a sliding block has 90 degrees.
        self._coupler = ""
        if synthesis.pressure[0]:
            self._coupler = "4" if "5" in problem.mechanism.links else "2"
            motion.append(f"omega_{self._coupler}")
            motion += ["phi_3"] if self._coupler == "4" else ["omega_3"]
        self._sweep = Sweep(problem, [*motion, *points])
        self.start = problem.drive.positions[0]
        turns = self.start + np.linspace(0.0, 360.0, _GRID + 1)
        self.full = bool(np.isfinite(self._table(turns)[self.rate]).all())

    def _table(self, phi: Reals) -> Mapping[str, Reals]:
        return self._sweep.table(phi)

    # Extreme positions -----------------------------------------------------------------------

    def extremes(self) -> dict[str, Any]:
        """Return stroke, swing, phases and K_v; None without two extreme positions."""
        found: dict[str, Any] = dict.fromkeys(("K_v", "stroke", "swing", "slow_deg", "quick_deg"))
        found["stroke_unit"] = "deg" if self.is_link else "m"
        found["extremes"] = []
        if not self.full:
            found["reason"] = "the driver does not turn fully"
            return found
        roots = self._stops()
        values = self._table(np.array(roots))[self.value] if roots else np.zeros(0)
        found["extremes"] = [
            {"phi_deg": phi % 360.0, "value": float(value)}
            for phi, value in zip(roots, values, strict=True)
        ]
        if len(roots) != 2:
            found["reason"] = f"the output has {len(roots)} extreme positions, not 2"
            return found
        apart = float(values[1] - values[0])
        size = abs((apart + 180.0) % 360.0 - 180.0) if self.is_link else abs(apart)
        phases = sorted((roots[1] - roots[0], 360.0 - (roots[1] - roots[0])))
        found |= {
            "K_v": phases[1] / phases[0],
            "stroke": size,
            "swing": size if self.is_link else None,
            "slow_deg": phases[1],
            "quick_deg": phases[0],
        }
        if self._coupler == "4":  # a shaper
            found["swing"] = float(abs(np.ptp(self._table(np.array(roots))["3.phi_deg"])))
        return found

    def _stops(self) -> list[float]:
        """Return the driver's positions where the output stops, degrees from the first one."""
        board = self.synthesis.exact()
        grid = self.start + 360.0 / _GRID * (np.arange(_GRID + 1) + 0.37)
        if len(self.synthesis.poses) == 2:  # both phases are seen, however short one is
            pins = [pose.links[0][0:2] for pose in self.synthesis.poses]
            dead = [ray_angle(place(board, o), place(board, a)) for o, a in pins]
            middle = (dead[0] + dead[1]) / 2
            extra = grid[0] + (np.array([middle, middle + 180.0]) - grid[0]) % 360.0
            grid = np.sort(np.append(grid, extra))
        return self._roots(self._rate, np.asarray(grid, dtype=float))

    def _rate(self, phi: Reals) -> Reals:
        return self._table(phi)[self.rate]

    @staticmethod
    def _roots(rate: Function, grid: Reals) -> list[float]:
        """Return the position of a sign change of a rate."""
        return [root(rate, float(grid[k]), float(grid[k + 1])) for k in crossings(rate(grid))]

    # Angles ----------------------------------------------------------------------------------

    def _transmission(self, phi: Reals) -> Reals:
        """Return the angle at which the coupler drives the output, 90 degrees at best."""
        tail, head, pivot = self.synthesis.pressure
        if not tail:
            return np.full(phi.shape, 90.0)
        found = self._table(phi)
        at = {p: found[f"{p}.x"] + 1j * found[f"{p}.y"] for p in (tail, head)}
        drives = at[head] - at[tail]
        if not pivot:
            return _acute(1j * drives)
        arm = at[head] - (place(self.synthesis.exact(), pivot) - self._origin)
        return _acute(np.conj(arm) * drives)

    @property
    def _origin(self) -> complex:
        made = self.synthesis
        return place(made.exact(), made.pivots[0]) if made.pivot_at_origin else 0j

    def angles(self) -> dict[str, Any]:
        """Return the minimum transmission and the maximum pressure angle, and their positions.

        Over the whole turn, or on the path through the three positions. The angle is extreme where
        the coupler does not rotate relative to the link it drives.
        """
        low, high = self.start, self.start + 360.0
        if not self.full:
            low, high = min(self.synthesis.positions), max(self.synthesis.positions)
        grid = np.linspace(low, high, _GRID + 1) + (0.37 * 360.0 / _GRID if self.full else 0.0)
        places = np.append(grid, self._roots(self._turning, grid))
        angles = self._transmission(places)
        none = not np.isfinite(angles).any()
        k = 0 if none else int(len(angles) - 1 - np.nanargmin(angles[::-1]))
        where = {"phi_deg": None if none else float(places[k]) % 360.0}
        least = None if none else float(angles[k])
        return {
            "transmission_angle": {"min_deg": least, **where},
            "pressure_angle": {"max_deg": None if least is None else 90.0 - least, **where},
        }

    def _turning(self, phi: Reals) -> Reals:
        """Return the angular velocity of the coupler relative to the link it drives, 1/s."""
        if not self._coupler:
            return np.zeros(phi.shape)
        found = self._table(phi)
        rate = found[f"{self._coupler}.omega"]
        return rate - found["3.omega"] if self.synthesis.pressure[2] else rate

    # Three positions -------------------------------------------------------------------------

    def positions(self) -> dict[str, Any]:
        """Return the deviation of the coupler's points from their three positions, m."""
        made, exact = self.synthesis, self.synthesis.exact()
        tail, head, _ = made.pressure
        found = self._table(np.array(made.positions))
        missed = []
        for letter in (tail, head):
            at = found[f"{letter}.x"] + 1j * found[f"{letter}.y"]
            asked = np.array([place(exact, f"{letter}{k}") for k in (1, 2, 3)]) - self._origin
            missed.append(np.abs(at - asked))
        worst = float(np.max(missed))
        return {"missed": worst if np.isfinite(worst) else None}


def _acute(vector: npt.NDArray[np.complex128]) -> Reals:
    """Return the angle between vectors and the x axis, 0 to 90 degrees."""
    return np.asarray(np.degrees(np.arctan2(np.abs(vector.imag), np.abs(vector.real))), float)
