"""Referee of schemes without redundant constraints: twists summed about contours, rank by SVD.

It knows a mechanism by the keys of its pairs (``B 2-3``) and where they are, and nothing of groups.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

Vector = npt.NDArray[np.float64]


@dataclass(frozen=True)
class Rank:
    """Redundant constraints and mobility of a spatial mechanism, and those of the formula."""

    redundant: int
    mobility: int
    counted: int
    margin: float


def _twists(name: str, at: complex, along: complex) -> list[Vector]:
    place = np.array([at.real, at.imag, 0.0])
    z, u = np.array([0.0, 0.0, 1.0]), np.array([along.real, along.imag, 0.0])

    def turn(axis: Vector) -> Vector:
        return np.concatenate([axis, np.cross(place, axis)])

    def slide(axis: Vector) -> Vector:
        return np.concatenate([np.zeros(3), axis])

    if name in ("4l", "5t"):  # along the normal of the profiles
        tangent = np.cross(z, u)
        plane = [turn(z), slide(tangent), slide(z), turn(u)]
        return [*plane, turn(tangent)] if name == "5t" else plane
    if along:
        more = {"1p": [], "2c": [turn(u)], "3pl": [slide(z), turn(np.cross(z, u))]}
        return [slide(u), *more[name]]
    more = {"1v": [], "2c": [slide(z)], "3s": [turn(np.eye(3)[0]), turn(np.eye(3)[1])]}
    return [turn(z), *more[name]]


def rank_of(classes: Mapping[str, str], places: Mapping[str, tuple[complex, complex]]) -> Rank:
    """Return the ranks of a scheme; ``places`` has points and directions (0 for a hinge)."""
    size = max(abs(at) for at, _ in places.values())
    pairs = [(key, *key.split()[1].split("-")) for key in classes]
    columns: list[Vector] = []
    links = sorted({link for _, *ends in pairs for link in ends})
    column_of: list[int] = []
    for number, (key, *_) in enumerate(pairs):
        at, along = places[key]
        for twist in _twists(classes[key], at / size, along):
            columns.append(twist)
            column_of.append(number)
    contours = _contours(links, [(a, b) for _, a, b in pairs])
    matrix = np.vstack(
        [np.column_stack([c[n] * t for t, n in zip(columns, column_of, strict=True)])
         for c in contours]
    )  # fmt: skip
    values = np.linalg.svd(matrix, compute_uv=False)
    rank = int(np.sum(values > 1e-8))
    freedoms = len(columns)
    moving = len(links) - 1
    counted = freedoms - 6 * (len(pairs) - moving)
    return Rank(len(matrix) - rank, freedoms - rank, counted, float(values.min()))


def _contours(links: Sequence[str], ends: Sequence[tuple[str, str]]) -> list[Vector]:
    """Return independent contours as signs of pairs: the null space of the incidence matrix."""
    incidence = np.zeros((len(links), len(ends)))
    for k, (a, b) in enumerate(ends):
        incidence[links.index(a), k], incidence[links.index(b), k] = -1.0, 1.0
    _, values, rows = np.linalg.svd(incidence)
    return list(rows[int(np.sum(values > 1e-9)) :])
