"""Mistakes as rewrites of the program: one function each, in tuples (ошибки студентов)."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from planmethod.check.mistakes import forces, plans, scales, springs, wheels
from planmethod.check.mistakes.plans import Change, MistakeContext

Mistake: TypeAlias = Callable[[MistakeContext], Iterator[Change]]

MISTAKES: tuple[Mistake, ...] = (
    *plans.MOTION_MISTAKES,
    *scales.MISTAKES,
    *forces.FORCE_MISTAKES,
    *springs.SPRING_MISTAKES,
    *wheels.WHEEL_MISTAKES,
)
"""Every mistake of a program: each yields the places where it can be made."""


def changes(scene: MistakeContext) -> Iterator[Change]:
    """Yield every mistake at every place of a sheet."""
    for mistake in MISTAKES:
        yield from mistake(scene)
