"""Placement of letters on sheets (расстановка букв): distance to their points, and density.

Run ``python -m benchmarks.letters [EVERY]``: it takes every EVERY-th shipped linkage (default: 6 in
one position, 16 in twelve), and prints the last part of benchmarks/reports/paper.md.
"""

from __future__ import annotations

import sys
from pathlib import Path
from statistics import fmean

from planmethod.errors import PlanMethodError
from planmethod.problem import load
from planmethod.render.control.texts import (
    box_contains,
    is_of_point,
    measure_letter_distances,
    writings_of,
)
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.solved.legibility import SIDE, densest

INTRODUCTION = """
## Letters

Measured by `python -m benchmarks.letters`. A letter is nearest to its own point if no other
lettered point of its view is closer; most of the other letters have a leader line. Density counts
the letters of points in the box of the view.
"""

EVERY = {1: 6, 12: 16}
"""Step through the shipped linkages, by number of positions."""

PROBLEMS = Path(__file__).parent.parent / "problems"


def measured(every: int, count: int) -> str:
    """Return the line for ``count`` positions."""
    near, dense, per_area = [], [], []
    for path in sorted(PROBLEMS.glob("l*/*.toml"))[::every]:
        problem = load(path)
        first = problem.drive.positions[0]
        if count > 1 and not problem.drive.is_crank:
            continue
        try:
            sheets = kinematics_sheets(
                problem, positions=[first + 360 * k / count for k in range(count)]
            )
        except PlanMethodError:
            continue
        for sheet in sheets:
            writings = writings_of(sheet.items)
            near += [
                own <= other for _, own, other in measure_letter_distances(writings, sheet.views)
            ]
            for view in (view for view in sheet.views if view.kind == "position"):
                left, low, right, high = view.box
                inside = [
                    w for w in writings if is_of_point(w.name) and box_contains(view.box, w.place)
                ]
                dense.append(
                    densest([complex(w.ink.centroid.x, w.ink.centroid.y) for w in inside])[0]
                )
                per_area.append(len(inside) * 1e4 / ((right - left) * (high - low)))
    return (
        f"- Of {count}: {100 * fmean(near):.1f} % of {len(near)} letters of points are nearest "
        f"to their own; schemes have {fmean(per_area):.0f} a dm², {max(per_area):.0f} at most; at "
        f"most {max(dense)} in a square of {SIDE:.0f} mm; {len(dense)} schemes."
    )


if __name__ == "__main__":
    print(INTRODUCTION)
    for number, every in EVERY.items():
        print(measured(int(sys.argv[1]) if len(sys.argv) > 1 else every, number))
