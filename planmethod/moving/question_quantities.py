"""Numbers of a moving point that students answer, and typical mistakes (величины, ошибки)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from functools import cached_property, partial
from typing import TYPE_CHECKING

from msgspec.structs import replace

from planmethod.moving.construction import construct
from planmethod.moving.interval import drawn_interval
from planmethod.moving.model import PointProblem
from planmethod.moving.motion import LEGEND, Motion, move
from planmethod.moving.reader import QUANTITY_COLUMNS, column_of
from planmethod.moving.sheet import sheet_scales
from planmethod.problem.question_quantities import AnswerValue, Mistaken, QuantityReader

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile

SIZES = ("v", "a", "a_normal", "rho")
USUAL = ("v", "a", "a_tau", "a_n", "rho")
PARTS = ("a_tangential", "a_normal")
ROOTS = {"v": ("vx", "vy"), "a": ("ax", "ay")}
"""Lengths of vectors, and their parts."""


class PointQuantities:
    """Quantities of a moving point for questions (`QuestionQuantities`)."""

    def __init__(self, problem: PointProblem) -> None:
        self.problem, self.count = problem, len(problem.times)
        self.names = tuple(n for n in USUAL if self.quantity(n, 0) is not None)

    @cached_property
    def motion(self) -> Motion:
        """Motion at the moments of the file."""
        return move(self.problem)

    def quantity(self, name: str, position: int) -> AnswerValue | None:
        """Return a quantity by its name of ``[published]``, or as people write it."""
        column = column_of(name)
        value = None if column is None else _value(self.motion, name, position)
        if column is None or value is None:
            return None
        quantity = LEGEND[column]
        return AnswerValue(quantity.symbol, quantity.unit, value, signed=column not in SIZES)

    def read_off(self, name: str, position: int, profile: Profile) -> tuple[float, float] | None:
        """Return its segment on the drawing, mm, and one sigma of the reading."""
        scales = sheet_scales(self.problem, drawn_interval(self.problem), profile)
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
        changes: list[tuple[str, QuantityReader]] = [
            ("K1", self._exchanged),
            *(("K2", partial(self._resultant, of)) for of in (PARTS, PARTS[:1], PARTS[1:])),
            *(("K3", partial(self._rooted, of, 2)) for of in (("v", "a"), ("v",), ("a",))),
            *(("K4", partial(self._rooted, of, 1)) for of in (("v", "a"), ("v",), ("a",))),
            ("K5", self._curved),
        ]
        for code, change in changes:
            yield Mistaken(code, "", change)
        turned = {key: one.in_degrees for key, one in self.problem.formulas.items()}
        if turned != self.problem.formulas:
            motion = move(replace(self.problem, formulas=turned))
            yield Mistaken("K6", "", partial(_value, motion))

    def _of(self, column: str, position: int) -> float | None:
        return _value(self.motion, column, position)

    def _exchanged(self, name: str, position: int) -> float | None:
        """Mistake a_n for a_tau and vice versa."""
        parts = dict(zip(PARTS, PARTS[::-1], strict=True))
        column = column_of(name) or ""
        return self._of(parts.get(column, column), position)

    def _resultant(self, parts: tuple[str, ...], name: str, position: int) -> float | None:
        """Take the whole acceleration for some of its parts."""
        column = column_of(name) or ""
        return self._of("a" if column in parts else column, position)

    def _rooted(self, of: tuple[str, ...], power: int, name: str, position: int) -> float | None:
        """Leave out the root of some lengths, or the squares under it as well."""
        column = column_of(name) or ""
        if column not in of:
            return self._of(column, position)
        parts = (self._of(part, position) or 0.0 for part in ROOTS[column])
        return abs(sum(part**power for part in parts))

    def _curved(self, name: str, position: int) -> float | None:
        """Leave the square out of v²/a_n."""
        v, across = self._of("v", position), self._of("a_normal", position)
        if column_of(name) == "rho" and v is not None and across:
            return v / across
        return self._of(name, position)

    def derive_values(self, name: str, answers: Mapping[str, float]) -> Iterator[tuple[float, str]]:
        """Yield lengths by their parts, a_n by a and a_tau, rho by v and a_n."""
        mine = {column_of(key): (value, key) for key, value in answers.items()}
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
    value = float(motion.columns[QUANTITY_COLUMNS.get(name) or column_of(name) or name][position])
    return value if math.isfinite(value) else None
