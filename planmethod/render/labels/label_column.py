"""Labels of points that coincide or lie close together: merged, or in a column (лесенка)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from msgspec import Struct
from msgspec.structs import replace
from numpy.typing import NDArray

from planmethod.render.ink.typeset import typeset
from planmethod.render.labels.model import (
    SPARSE,
    VERTICAL_GAP,
    Candidates,
    Complexes,
    Floats,
    Label,
    LabelStyle,
    crossed,
)
from planmethod.render.labels.paper import CROSSED, Paper

_BESIDE_LIST = 4.0  # white beside a list of letters in a crowd, mm

MergedLetters = list[tuple[complex, list[str]]]
"""Places, mm, and their letters."""

NEAR = 0.3
"""Distance below which points coincide on the paper, mm."""


def merge_letters(
    letters: Iterable[tuple[complex, Sequence[str]]], near: float = NEAR
) -> MergedLetters:
    """Return places with their letters, each letter once, in the order given.

    Parameters
    ----------
    letters : iterable of (complex, sequence of str)
        Places, mm, and their letters.
    near : float, mm
    """
    spots: MergedLetters = []
    for place, own in letters:
        for other, found in spots:
            if abs(other - place) < near:
                found += [letter for letter in own if letter not in found]
                break
        else:
            spots.append((place, list(own)))
    return spots


def label_merged_letters(
    merged: MergedLetters,
    height: float,
    prefix: str,
    *,
    gap: float = 1.4,
    style: LabelStyle = SPARSE,
) -> list[Label]:
    """Return the letters of spots, away from the middle of them all; ``prefix`` is of names.

    In a crowd a list of letters has more white beside it, or the next letter would read as its own.
    """
    middle = sum(place for place, _ in merged) / len(merged)
    of_list = style if style == SPARSE else replace(style, side_gap=_BESIDE_LIST)
    return [
        Label(
            typeset(", ".join(letters), height),
            place,
            prefer=place - middle,
            gap=gap,
            name=f"{prefix} {letters[0]}",
            style=style if len(letters) == 1 else of_list,
        )
        for place, letters in merged
    ]


_FEWEST = 3  # labels that make a column
_MIN_NEIGHBOUR = 1.1  # of a label's size: nearer neighbours are too close
_DENSE = 0.4  # share of such neighbours that makes a column
_OPEN = 2.4  # of a label's size: here a column ends
_UPRIGHT = 0.6  # height over width of a series from which its labels form a column, not a row
_OFFSETS = (3.0, 6.0, 10.0, 16.0)  # from the points to the column, mm
_SLOT = 1.0  # mm between two slots
_SLANT = 0.6  # mm of cost for a millimetre that a label is shifted along the column
_LONGEST = 32.0  # largest shift along the column, mm
_BOTH_SIDES = 1.0  # mm of cost for a label, if there are columns on both sides
_CROSS = 100.0  # mm of cost for two leader lines that cross
_WHITE = 0.6  # mm between a leader line and its label
_EXCLUDED_COST = 1e9


PlacedCosts: TypeAlias = Callable[[Candidates, NDArray[np.intp]], Floats]


class _Series(Struct, frozen=True):
    """Labels in the order of their points along a column (upright) or row."""

    labels: tuple[Label, ...]
    upright: bool

    def coordinate(self, place: complex) -> float:
        """Return the coordinate of a place along the column: up, or to the right."""
        return place.imag if self.upright else place.real

    def size(self, label: Label) -> float:
        """Return the length of column that a label takes, with the white beside it, mm."""
        if self.upright:
            return tall(label) + VERTICAL_GAP
        return label.inscription.width + label.style.side_gap


def tall(label: Label) -> float:
    """Return the height of a label's ink, mm."""
    return label.inscription.ascent + label.inscription.descent


def dense(labels: Sequence[Label]) -> list[_Series]:
    """Return the parts of a series whose points are too close together, each in its order.

    Too close is nearer to the next point than a label is high, or long where the points lie in a
    row.
    """
    xs, ys = [z.anchor.real for z in labels], [z.anchor.imag for z in labels]
    upright = max(ys) - min(ys) >= _UPRIGHT * (max(xs) - min(xs))
    whole = _Series((), upright)
    ordered = sorted(labels, key=lambda label: whole.coordinate(label.anchor))
    runs: list[list[Label]] = [ordered[:1]]
    near = [0]
    for before, label in pairwise(ordered):
        size = tall(before) if upright else before.inscription.width
        gap = abs(label.anchor - before.anchor)
        if gap > _OPEN * size:
            runs.append([])
            near.append(0)
        runs[-1].append(label)
        near[-1] += gap < _MIN_NEIGHBOUR * size
    return [
        _Series(tuple(run), upright)
        for run, close in zip(runs, near, strict=True)
        if len(run) >= _FEWEST and close >= _DENSE * (len(run) - 1)
    ]


def arrange_in_column(
    paper: Paper, series: _Series, placed_costs: PlacedCosts
) -> list[Candidates | None]:
    """Return one place, or None, for each label of a series, in its order.

    ``placed_costs`` returns the costs of a label's places from the labels already placed.
    """
    columns = {side: [_Column(series, side, offset) for offset in _OFFSETS] for side in (-1, 1)}
    both = [*columns[-1], *columns[1]]
    every = range(len(series.labels))
    sets = [Candidates.joined([column.sets[k] for column in both]) for k in every]
    free = paper.free(sets)
    usable = [places.chosen(rows) for places, rows in zip(sets, free, strict=True)]
    costs = paper.costs(usable, free=True)
    for places, rows, known in zip(sets, free, costs, strict=True):
        whole = np.full(len(places.boxes), _EXCLUDED_COST)
        if len(rows):
            met = known + placed_costs(places, rows)
            whole[rows] = np.where(met < CROSSED, met, _EXCLUDED_COST)
        for column in both:
            whole = column.add_costs(whole)
    best: tuple[float, list[Candidates | None]] = (np.inf, [])
    for parts in (
        ((-1, every),),
        ((1, every),),
        *(((-1, every[first::2]), (1, every[1 - first :: 2])) for first in (0, 1)),
    ):
        cost = _BOTH_SIDES * len(every) if len(parts) > 1 else 0.0
        chosen = []
        for side, members in parts:
            tries = [(*column.filled(members), column) for column in columns[side]]
            least, slots, column = min(tries, key=lambda found: round(found[0], 6))
            cost += least
            chosen.append((column, slots))
        found: list[Candidates | None] = [None for _ in every]
        for column, slots in chosen:
            for k, slot in slots.items():
                found[k] = column.place(k, slot)
        cost += _CROSS * crossed([c.leaders[0] for c in found if c is not None])
        if cost < best[0] - 1e-6:
            best = (cost, found)
    return best[1]


class _Column:
    """A column of slots on one side of a series, and the cost of each label in each slot."""

    def __init__(self, series: _Series, side: int, offset: float) -> None:
        self.series = series
        labels = series.labels
        whole = min(_LONGEST, sum(series.size(label) for label in labels))
        ends = [series.coordinate(label.anchor) for label in (labels[0], labels[-1])]
        self.slots = np.arange(ends[0] - whole, ends[1] + whole, _SLOT)
        across = [label.anchor.real if series.upright else label.anchor.imag for label in labels]
        self.side = side
        self.edge = (max(across) + offset) if side > 0 else (min(across) - offset)
        # Only slots that are not too far from a label's point are considered.
        self.windows = [
            np.flatnonzero(np.abs(self.slots - series.coordinate(label.anchor)) <= _LONGEST)
            for label in labels
        ]
        self.sets = [
            self._candidates(label, self.slots[window])
            for label, window in zip(labels, self.windows, strict=True)
        ]
        self.costs: list[Floats] = []

    def add_costs(self, known: Floats) -> Floats:
        """Take the next label's costs from ``known``; return the rest, of other columns."""
        window = self.windows[len(self.costs)]
        whole = np.full(len(self.slots), _EXCLUDED_COST)
        whole[window] = known[: len(window)]
        self.costs.append(whole)
        return known[len(window) :]

    def _candidates(self, label: Label, slots: Floats) -> Candidates:
        """Return a label in some slots."""
        half_w, half_h = label.inscription.width / 2, tall(label) / 2
        if self.series.upright:
            centres = _places(slots, 1j, self.edge + self.side * half_w)
            ends = _places(slots, 1j, self.edge - self.side * _WHITE)
        else:
            centres = _places(slots, 1, 1j * (self.edge + self.side * half_h))
            ends = _places(slots, 1, 1j * (self.edge - self.side * _WHITE))
        x, y = centres.real, centres.imag
        boxes = np.column_stack([x - half_w, y - half_h, x + half_w, y + half_h])
        shift = np.abs(slots - self.series.coordinate(label.anchor))
        reach = ends - label.anchor
        starts: Complexes = label.anchor + reach * (0.6 * label.gap / np.abs(reach))
        dislike = _SLANT * shift + 0.5 * np.abs(reach)
        return Candidates(label, boxes, dislike, starts, ends)

    def filled(self, members: Sequence[int]) -> tuple[float, dict[int, int]]:
        """Return the least cost of some labels in this column, and the slot of each.

        A label without a slot costs much and is left out.
        """
        steps: list[NDArray[np.intp]] = []
        total = np.zeros(len(self.slots))
        needs = [self.series.size(self.series.labels[k]) / 2 for k in members]
        for k, before, need in zip(members, [0.0, *needs], needs, strict=False):
            apart = int(np.ceil((before + need) / _SLOT)) if steps else 0
            # The best of all slots that leave enough space for the two labels.
            low = np.minimum.accumulate(total)
            where = np.maximum.accumulate(np.where(total <= low, np.arange(len(total)), 0))
            shifted = np.full(len(total), np.inf)
            shifted[apart:] = low[: len(total) - apart]
            steps.append(np.concatenate([np.zeros(apart, dtype=np.intp), where])[: len(total)])
            total = shifted + self.costs[k]
        slot = int(np.argmin(total))
        cost = float(total[slot])
        found: dict[int, int] = {}
        for k, step in zip(reversed(members), reversed(steps), strict=True):
            if self.costs[k][slot] < CROSSED:
                found[k] = slot
            slot = int(step[slot])
        return cost, found

    def place(self, k: int, slot: int) -> Candidates:
        """Return the one place of a label in a slot."""
        c, row = self.sets[k], int(np.searchsorted(self.windows[k], slot))
        one = slice(row, row + 1)
        cost = self.costs[k][slot : slot + 1]
        return Candidates(c.label, c.boxes[one], cost, c.starts[one], c.ends[one])


def _places(slots: Floats, direction: complex, start: complex) -> Complexes:
    """Return the places of slots along a line."""
    return np.asarray(start + direction * slots, dtype=np.complex128)
