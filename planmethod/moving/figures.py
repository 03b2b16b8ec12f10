"""Numbers of a moving point as students are asked for them, and mistakes (величины, ошибки)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cached_property, partial
from typing import TYPE_CHECKING

from planmethod.moving.model import PointProblem
from planmethod.moving.motion import Motion, move
from planmethod.moving.reader import WHAT, column_of
from planmethod.moving.told import SYMBOLS, unit_of
from planmethod.problem.figures import Figure, Mistaken

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile

SIZES = ("v", "a", "a_normal", "rho")
USUAL = ("v", "a", "a_tau", "a_n", "rho")
ROOTS = {"v": ("vx", "vy"), "a": ("ax", "ay")}
"""Lengths of vectors, and their parts."""


class PointFigures:
    """All that can be asked of a moving point; see `planmethod.problem.figures.Figures`."""

    def __init__(self, problem: PointProblem) -> None:
        self.problem, self.count = problem, len(problem.times)
        self.names = tuple(n for n in USUAL if self.figure(n, 0) is not None)

    @cached_property
    def motion(self) -> Motion:
        """Motion at the moments of the file."""
        return move(self.problem)

    def figure(self, name: str, position: int) -> Figure | None:
        """Return a quantity by its name of ``[published]``, or as people write it."""
        column = column_of(name)
        value = None if column is None else _value(self.motion, name, position)
        if column is None or value is None:
            return None
        return Figure(SYMBOLS[column], unit_of(column), value, signed=column not in SIZES)

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of what is read."""
        from planmethod.moving.construction import construct
        from planmethod.moving.course import course_of
        from planmethod.moving.sheet import sheet_scales

        scales = sheet_scales(self.problem, course_of(self.problem), profile)
        built = construct(self.problem, self.motion, position, scales)
        column = column_of(name) or ""
        sigma = {} if built is None else built.sigma(profile)
        if column not in sigma:
            return None
        scale = scales.get(column[0])
        value = abs(_value(self.motion, name, position) or 0.0)
        return (math.nan if scale is None else value / scale.per_mm), sigma[column]

    def mistaken(self) -> Iterator[Mistaken]:
        """Yield the usual mistakes: roots, the parts of the acceleration, degrees."""
        for code, change in (
            ("K1", self._exchanged),
            ("K2", self._whole),
            ("K3", partial(self._rooted, 1, 2)),
            ("K4", partial(self._rooted, 0.5, 1)),
            ("K5", self._curved),
        ):
            yield Mistaken(code, "", change)
        turned = {key: one.in_degrees for key, one in self.problem.formulas.items()}
        if turned != self.problem.formulas:
            motion = move(replace(self.problem, formulas=turned))
            yield Mistaken("K6", "", partial(_value, motion))

    def _of(self, column: str, position: int) -> float | None:
        return _value(self.motion, column, position)

    def _exchanged(self, name: str, position: int) -> float | None:
        """Take a_n for a_tau and the other way round."""
        parts = {"a_tangential": "a_normal", "a_normal": "a_tangential"}
        column = column_of(name) or ""
        found = self._of(parts.get(column, column), position)
        tau, a = self._of("a_tangential", position), self._of("v", position)
        if column == "rho" and tau and a is not None:
            return a**2 / abs(tau)
        return found

    def _whole(self, name: str, position: int) -> float | None:
        """Take the whole acceleration for its parts."""
        column = column_of(name) or ""
        v, a = self._of("v", position), self._of("a", position)
        if column in ("a_tangential", "a_normal"):
            return a
        if column == "rho" and a and v is not None:
            return v**2 / a
        return self._of(column, position)

    def _rooted(self, root: float, power: int, name: str, position: int) -> float | None:
        """Leave out the root of a length, or the squares under it."""
        column = column_of(name) or ""
        parts = [self._of(part, position) for part in ROOTS.get(column, ())]
        if not parts or None in parts:
            return self._of(column, position)
        total = sum(part**power for part in parts if part is not None)
        return abs(total) if root == 1 or power == 1 else total

    def _curved(self, name: str, position: int) -> float | None:
        """Leave the square out of v²/a_n."""
        v, across = self._of("v", position), self._of("a_normal", position)
        if column_of(name) == "rho" and v is not None and across:
            return v / across
        return self._of(name, position)

    def followed(self, name: str, own: Mapping[str, float]) -> Iterator[tuple[float, str]]:
        """Yield lengths by their parts, a_n by a and a_tau, rho by v and a_n."""
        mine = {column_of(key): (value, key) for key, value in own.items()}
        for out, needs, make in (
            ("v", ("vx", "vy"), math.hypot),
            ("a", ("ax", "ay"), math.hypot),
            ("a_normal", ("a", "a_tangential"), lambda a, t: math.sqrt(max(a * a - t * t, 0.0))),
            ("rho", ("v", "a_normal"), lambda v, n: v * v / n if n else math.inf),
        ):
            if out == column_of(name) and all(need in mine for need in needs):
                values = [mine[need][0] for need in needs]
                for need in needs:
                    yield make(*values), mine[need][1]


def _value(motion: Motion, name: str, position: int) -> float | None:
    value = float(motion.columns[WHAT.get(name) or column_of(name) or name][position])
    return value if math.isfinite(value) else None
