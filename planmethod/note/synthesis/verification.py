"""Problem file of a synthesized mechanism (файл задачи), and its verification.

The file is commented, ready to solve; the actual motion is that of the solved mechanism's cycle.
The transmission angle is sampled over the whole turn.
"""

# no messages: mistakes in sizes that the program makes

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from msgspec.structs import replace

from planmethod.construct.curves import roots
from planmethod.construct.steps import PointName
from planmethod.errors import PlanMethodError
from planmethod.languages import LANGUAGES
from planmethod.note.synthesis.drawing import construction_of
from planmethod.note.wording import Language, get_language
from planmethod.problem import loads
from planmethod.problem.machine_records import CycleTask
from planmethod.problem.model import Problem
from planmethod.problem.toml import value_text
from planmethod.solved.reading import Reading, Reals, memoized
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import CrankCycle
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
    values = synthesis.values()
    yield f'title = "{texts["mechanisms"][synthesis.kind]}"'
    yield f'source = "{source}"'
    yield ""
    yield f"[synthesis] # {texts['comments']['given']}"
    yield f'kind = "{synthesis.kind}"'
    for name, value in synthesis.options.items():
        if value is not None:
            yield f"{name} = {value_text(value)}"
    yield ""
    yield f"[frame] # {texts['comments']['frame']}"
    for pivot in synthesis.pivots:
        if f"x_{pivot}" in values:
            sizes = {value: name for name, value in values.items() if name.startswith("l_")}
            at = ((values[f"{axis}_{pivot}"], f"{axis}_{pivot}") for axis in "xy")
            x, y = (f'"{sizes.get(value, name)}"' if value else "0.0" for value, name in at)
            yield f"{pivot} = [{x}, {y}]"
        else:
            yield f"{pivot} = [0.0, 0.0]"
    if synthesis.guide:
        level = next(name for name in (*values, "e") if name in ("e", "l_O3M"))
        through = f'"{level}"' if values[level] else "0.0"
        yield f"guides.x-x = {{ through = [0.0, {through}], angle = 0 }}"
    for table in synthesis.tables[:-1]:
        yield ""
        yield f"[{table.head}] # {texts['comments'][table.word]}"
        yield from table.lines
    yield ""
    yield f"[driver] # {texts['comments']['driver']}"
    yield 'link = "1"'
    if synthesis.positions:
        names = (f'"phi_{k}"' for k, _ in enumerate(synthesis.positions, 1))
        yield f"phi = [{', '.join(names)}]"
    else:
        yield f'phi = {{ from = "phi_0", count = {COUNT} }} # {texts["comments"]["zero"]}'
    yield f"omega = {OMEGA!r} # {texts['comments']['omega']}"
    yield "epsilon = 0.0"
    yield ""
    yield f"[assembly] # {texts['comments']['assembly']}"
    yield from synthesis.tables[-1].lines


def verified(synthesis: Synthesis) -> dict[str, Any]:
    """Return values measured on a mechanism alone: `checks` and the facts of its synthesis."""
    text = problem_text(synthesis, "", get_language(LANGUAGES[0]))
    return {**checks(synthesis, loads(text, name=synthesis.kind)), **synthesis.facts}


@memoized
def measured_on(solution: Solution) -> dict[str, Any]:
    """Return `verified` of ``[synthesis]`` of a problem."""
    return verified(construction_of(solution).synthesis)


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
        self.synthesis = synthesis
        task = CycleTask(output=synthesis.output)
        self.turn = CrankCycle(Solution(replace(problem, cycle=task)), middles(synthesis))
        # The link whose angle to the output shows how it is driven; a sliding block has 90 degrees.
        links = problem.mechanism.links
        self._coupler = ("4" if "5" in links else "2") if synthesis.pressure[0] else ""
        self.start = problem.drive.positions[0]
        self.full = self.turn.range is None

    # Extreme positions -----------------------------------------------------------------------

    def extremes(self) -> dict[str, Any]:
        """Return stroke, swing, phases and K_v; None without two extreme positions."""
        turn, unit = self.turn, self.turn.output.unit
        found: dict[str, Any] = dict.fromkeys(("K_v", "stroke", "swing", "slow_deg", "quick_deg"))
        found["stroke_unit"] = unit
        found["extremes"] = []
        if not self.full:
            found["reason"] = "the driver does not turn fully"
            return found
        phi = [extreme.phi for extreme in turn.turnings]
        reading = turn.read(phi)
        values = turn.output.value(turn.unit, reading)
        found["extremes"] = [
            {"phi_deg": 0.0 if 360.0 - at % 360.0 < CLOSE else at % 360.0, "value": float(value)}
            for at, value in zip(phi, values, strict=True)
        ]
        if len(phi) != 2:
            found["reason"] = f"the output has {len(phi)} extreme positions, not 2"
            return found
        quick, slow = sorted((phi[1] - phi[0], 360.0 - (phi[1] - phi[0])))
        found |= {
            "K_v": slow / quick,
            "stroke": turn.stroke,
            "swing": turn.stroke if unit == "deg" else None,
            "slow_deg": slow,
            "quick_deg": quick,
        }
        if self._coupler == "4":  # a shaper
            slotted = reading.line_vector(turn.unit.construction.draft.axes["3"])
            found["swing"] = float(np.ptp(np.degrees(np.angle(slotted))))
        return found

    # Angles ----------------------------------------------------------------------------------

    def _transmission(self, reading: Reading) -> Reals:
        """Return the angle at which the coupler drives the output, 90 degrees at best."""
        tail, head, pivot = map(PointName, self.synthesis.pressure)
        if not tail:
            return np.full(reading.count, 90.0)
        arm = reading.vector(pivot, head) if pivot else -1j
        across = np.conj(arm) * reading.vector(tail, head)
        return np.degrees(np.arctan2(np.abs(across.imag), np.abs(across.real)))

    def angles(self) -> dict[str, Any]:
        """Return the minimum transmission and the maximum pressure angle, and their positions.

        Over the whole turn, or on the path through the three positions. The angle is extreme where
        the coupler does not rotate relative to the link it drives.
        """
        low, high = self.start, self.start + 360.0
        if not self.full:
            low, high = min(self.synthesis.positions), max(self.synthesis.positions)
        grid = np.linspace(low, high, _GRID + 1) + (0.37 * 360.0 / _GRID if self.full else 0.0)
        places = np.append(grid, roots(self._turning, grid)) if self._coupler else grid
        angles = self._transmission(self.turn.read(places))
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
        reading, omega = self.turn.read(phi), self.turn.unit.construction.kinematics.omega
        rate = reading.number(omega[self._coupler])
        return rate - reading.number(omega["3"]) if self.synthesis.pressure[2] else rate

    # Three positions -------------------------------------------------------------------------

    def positions(self) -> dict[str, Any]:
        """Return the deviation of the coupler's points from their three positions, m."""
        made, exact = self.synthesis, self.synthesis.exact()
        origin = place(exact, made.pivots[0]) if made.pivot_at_origin else 0j
        reading = self.turn.read(made.positions)
        missed = []
        for letter in made.pressure[:2]:
            at = reading.point(PointName(letter)) + self.turn.unit.construction.draft.origin
            asked = np.array([place(exact, f"{letter}{k}") for k in (1, 2, 3)]) - origin
            missed.append(np.abs(at - asked))
        worst = float(np.max(missed))
        return {"missed": worst if np.isfinite(worst) else None}


def middles(synthesis: Synthesis) -> tuple[float, ...]:
    """Return a position within each phase of the driver, degrees, however short it is."""
    if len(synthesis.poses) != 2:
        return ()
    board, pins = synthesis.exact(), [pose.links[0][:2] for pose in synthesis.poses]
    middle = sum(ray_angle(place(board, o), place(board, a)) for o, a in pins) / 2
    return middle, middle + 180.0
