"""Random teeth that keep a train coaxial (соосность): some wheels follow from the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction

from planmethod.gears.conditions import coaxial_paths
from planmethod.gears.motion import TrainMotion
from planmethod.varying.parameters import VariedKey

WHEEL = "gears.wheels."

Row = dict[str, Fraction]
"""Coefficients of an equation by labels; what they add up to is under the empty one."""

Solved = tuple[str, Row]
"""The wheel that an equation is solved for, with coefficient 1, and the equation."""


def coaxial_rows(motion: TrainMotion, varied: Sequence[str]) -> list[Solved]:
    """Return the equations that varied wheels have to keep, each solved for one of them.

    An equation with a wheel whose teeth the reader determines is skipped: it follows. So is one
    with wheels whose shifts set the centre distance.

    Parameters
    ----------
    varied : sequence of str
        Labels of the wheels.
    """
    found: list[Row] = []
    sizes, unknown = motion.axes.sizes, set(motion.train.unknown)
    for _, _, (one, other) in coaxial_paths(motion):
        row: Row = {}
        for sign, terms in ((1, one), (-1, other)):
            for turn, label in terms:
                share = motion.train.module_ratio(label)
                row[label] = row.get(label, Fraction(0)) + sign * turn * share
        if sum(factor * sizes[label] for label, factor in row.items()):
            continue
        if unknown & {label for label, factor in row.items() if factor}:
            continue
        given = sum((factor * sizes[x] for x, factor in row.items() if x not in varied), Fraction())
        found.append({**{x: f for x, f in row.items() if f and x in varied}, "": -given})
    return _solved(found, {label: sizes[label] for label in varied})


def _solved(rows: list[Row], sizes: Mapping[str, Fraction]) -> list[Solved]:
    """Solve equations for wheels that are in no other one, the largest first."""
    done: list[Solved] = []
    for row in rows:
        for main, other in done:
            row = _less(row, other, main)
        left = [label for label, factor in row.items() if label and factor]
        if left:
            main = max(left, key=lambda label: (sizes[label], label))
            row = {label: factor / row[main] for label, factor in row.items()}
            done = [*((its, _less(other, row, main)) for its, other in done), (main, row)]
    return done


def _less(row: Row, solved: Row, label: str) -> Row:
    """Return a row without a label that another one is solved for."""
    factor = row.get(label, Fraction(0))
    every = dict.fromkeys((*row, *solved))
    return {x: row.get(x, Fraction(0)) - factor * solved.get(x, Fraction(0)) for x in every}


def make_coaxial(
    values: Mapping[VariedKey, float], rows: Sequence[Solved], sizes: Mapping[str, Fraction]
) -> dict[VariedKey, float] | None:
    """Return values with coaxial wheels; None if a resulting wheel has no permitted size."""
    made = dict(values)
    wheels = {label_of(one): one for one in made if one.name.startswith(WHEEL)}
    per = {label: _exact(one.base) / sizes[label] for label, one in wheels.items()}
    for main, row in rows:
        size = row[""]
        for label, factor in row.items():
            if factor and label not in ("", main):
                size -= factor * _exact(made[wheels[label]]) / per[label]
        told = size * per[main]
        value: float = int(told) if told.denominator == 1 else float(told)
        if value not in wheels[main].values:
            return None
        made[wheels[main]] = value
    return made


def label_of(one: VariedKey) -> str:
    """Return the wheel that a key is of."""
    return one.name.removeprefix(WHEEL).removesuffix(".z").removesuffix(".r")


def _exact(value: float) -> Fraction:
    return Fraction(repr(value))
