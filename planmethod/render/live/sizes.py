"""Lengths that a reader of the page changes: the tape of all of them (ползунки длин)."""

# no messages: numbers of a page

from __future__ import annotations

from typing import Any

from planmethod.plans.model import Turns
from planmethod.problem.parameters import Parameters
from planmethod.render.live.drawn import meaning, numbers_of
from planmethod.render.live.scene import LiveScene
from planmethod.solved.many.sweep import DraggedTape, Sweep
from planmethod.solved.many.variants import SweepError
from planmethod.solved.turn.determined import pose

LONG = 2.0
"""Ratio of the largest value of a slider to that of the file; the least one is its inverse."""

WIDE = 45.0
"""Largest change of an angle, degrees."""

RATES = {"n": "1/s", "omega": "1/s", "epsilon": "1/s²", "v": "m/s", "a": "m/s²"}
"""Units of the driver's rates by their key."""


class LiveSizes:
    """Tape of a scene whose numbers are inputs, in place of the scene's own.

    Parameters
    ----------
    scene : LiveScene
    dragged : DraggedTape
        With the scene's outputs.

    Attributes
    ----------
    numbers : dict
        See `numbers_of`: those parameters that the page may change.
    """

    def __init__(self, scene: LiveScene, dragged: DraggedTape) -> None:
        self.dragged = dragged
        self.numbers = numbers_of(scene.problem, dragged)
        able = [one for one in self.numbers["parameters"] if one["moves"] and one["means"]]
        self.numbers["parameters"] = able

    @classmethod
    def of(cls, scene: LiveScene) -> LiveSizes | None:
        """Return the sizes of a scene; None where a changed size may need another program.

        These are triads, change points, several drivers, wheels in mesh and passive links.
        Rates that follow from an output or a load would be others, too.
        """
        problem = scene.problem
        branches = scene.sweep.branches.values()
        if (
            problem.mechanism.rolling
            or problem.mechanism.passive
            or problem.drive.other_drives
            or problem.drive.found_rates is not None
            or any(not isinstance(one, Turns) for one in branches)
        ):
            return None
        names = [
            name
            for name, one in Parameters(problem, pose).by_name.items()
            if one.part != "dynamics" and [*meaning(problem, one.key)]
        ]
        try:
            sweep = Sweep(problem, varied=names, forces=scene.has_loads, drawn=scene.drawn)
        except SweepError:
            return None
        found = cls(scene, sweep.dragged())
        return found if sweep.rows == scene.sweep.rows and found.sliders() else None

    def sliders(self) -> list[dict[str, Any]]:
        """Return the changed numbers: name, label, unit, value and the ends of its slider.

        Values are millimetres, degrees, or SI.
        """
        found = []
        for one in self.numbers["parameters"]:
            kind, per = one["means"][0], 1.0
            unit = "mm"
            if "angle" in kind:
                unit, ends = "deg", (one["value"] - WIDE, one["value"] + WIDE)
            elif kind == "rate":
                unit = RATES[one["means"][1]]
                ends = self._around(one["value"])
            else:
                per = 1000.0
                ends = self._around(one["value"] * per)
            found.append(
                {"name": one["name"], "label": one["label"], "unit": unit, "per": per,
                 "value": one["value"] * per, "ends": ends}
            )  # fmt: skip
        return found

    def _around(self, value: float) -> tuple[float, float]:
        """Return the ends of a slider about a value; of zero those of the longest length."""
        if value:
            low, high = sorted((value / LONG, value * LONG))
            return low, high
        lengths = [one for one in self.numbers["parameters"] if one["means"][0] == "length"]
        reach = 500.0 * max((one["value"] for one in lengths), default=0.1)
        return -reach, reach
