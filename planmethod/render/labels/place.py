"""Greedy label placement, hardest labels first, then local repair."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from functools import lru_cache
from itertools import count

import numpy as np
from msgspec import Struct
from numpy.typing import NDArray

from planmethod.render.ink.drawing import Bounds, Item
from planmethod.render.ink.lettering import OutlineLettering, in_use
from planmethod.render.labels.label_column import arrange_in_column, dense
from planmethod.render.labels.model import (
    SPARSE,
    Candidates,
    Floats,
    Label,
    Placed,
    Segment,
    far_candidates,
    grid_candidates,
    led_across,
    near_candidates,
)
from planmethod.render.labels.paper import (
    CROSSED,
    FORBIDDEN,
    LEADERS_CROSS,
    ROUND_AREAS,
    OverlapCosts,
    Paper,
    PlacedLabels,
)

_FAR_COST = 200.0  # cost from which a label of a crowd tries its far places
_AT_ONCE = 24  # places checked together
_PASSES = 4  # times that all labels of a crowd try again
_POOR = 45.0  # cost from which a better place is sought, even by displacing others
_MIN_GAIN = 5.0  # least gain of a displacement
_SENT_AWAY = 2  # largest number of labels that one may displace
_TRIED = 12  # places for which it may
_LONG = 30.0  # length of a leader line from which a letter breaks thin lines instead, mm
_FEW_BROKEN = CROSSED / 2  # cost up to which it does: about four lines
_HOPELESS = 2  # labels without a place: repair never freed that many in 143 crowded schemes


def place_labels(
    labels: Sequence[Label],
    obstacles: Iterable[Item],
    bounds: Bounds,
    *,
    may_interrupt_lines: bool = True,
    segments: Sequence[Segment] = (),
) -> list[Placed]:
    """Find a place for every label (размещение надписей).

    Parameters
    ----------
    labels : sequence of Label
    obstacles : iterable of Item
        Items already on the sheet. Lines, arcs and outlines should not be crossed, texts and filled
        areas (also white ones: a joint, a slider) must not be. Draw order does not matter: white
        hides no items here.
    bounds : Bounds, mm
        All labels stay inside.
    may_interrupt_lines : bool
        A label of a crowd that finds no free place may break thin lines by a white ground. If not,
        and several find none, they are left unrepaired: the crowd has to be thinned.
    segments : sequence of (complex, complex), mm
        Segments without a label, to which the name of another one may not be nearer.

    Returns
    -------
    list of Placed
        In the order of ``labels``, without the optional ones that found no free place. A label
        without any place overlaps others or leaves the bounds, and is not ``free``.
    """
    return list(
        _placed(
            tuple(labels),
            tuple(obstacles),
            bounds,
            in_use(),
            tuple(segments),
            may_interrupt_lines=may_interrupt_lines,
        )
    )


@lru_cache(maxsize=128)  # more than the pictures of a project's sheet
def _placed(
    labels: tuple[Label, ...],
    obstacles: tuple[Item, ...],
    bounds: Bounds,
    _lettering: OutlineLettering,
    segments: tuple[Segment, ...],
    *,
    may_interrupt_lines: bool,
) -> tuple[Placed, ...]:
    """Return the labels with their places, cached for a picture that is tried on other paper.

    The extent of texts among the obstacles depends on the lettering in use.
    """
    if not labels:
        return ()
    places = _Places(Paper(obstacles, bounds), labels, segments)
    firm = [k for k, label in enumerate(labels) if not label.optional]
    places.fill([k for k in firm if not labels[k].series])
    places.line_up()
    places.fill([k for k in firm if labels[k].series])
    if not may_interrupt_lines and len(places.unfree()) >= _HOPELESS:
        return places.result()
    if any(labels[k].style != SPARSE for k in firm):
        places.reconsider()
        places.improve()
    for k in places.unfree():
        places.displace_others(k)
    for k in places.unfree() if may_interrupt_lines else ():
        places.break_lines(k)
    for k in places.list_distant():
        places.bring_near(k)
    places.fill([k for k, label in enumerate(labels) if label.optional])
    places.lead_across()
    return places.result()


class _CandidateSet(Struct):
    """A set of places of one label with their costs, the cheapest first.

    It has only the free ones of ``every`` place until none of them will do; then ``every`` is None.
    """

    candidates: Candidates
    costs: Floats
    order: NDArray[np.intp]
    overlaps: OverlapCosts
    every: Candidates | None = None

    @classmethod
    def of(
        cls, candidates: Candidates, costs: Floats, labels: int, every: Candidates | None = None
    ) -> _CandidateSet:
        order = np.argsort(np.round(costs, 9), kind="stable")
        return cls(candidates, costs, order, OverlapCosts.of(candidates, labels), every)


class _Placement(Struct):
    """The place that a label has."""

    choice: _CandidateSet
    row: int
    cost: float
    stamp: int
    ground: bool = False


class _Places:
    """Labels and the places that they have so far."""

    def __init__(
        self, paper: Paper, labels: Sequence[Label], segments: Sequence[Segment] = ()
    ) -> None:
        self.paper, self.labels = paper, labels
        self.placements: dict[int, _Placement] = {}
        self.stamps = count()
        self.strangers = list(
            dict.fromkeys(label.anchor for label in self.labels if label.style.stranger)
        )
        named = [x.segment for x in self.labels if x.segment and x.style.other_segment]
        self.lines = list(dict.fromkeys([*named, *segments]))
        sets = [near_candidates(label) for label in self.labels]
        self.choices = [[choice] for choice in self._free(sets)]
        self.placed_labels = PlacedLabels(self.labels)
        self.lined: set[int] = set()
        self._costs: dict[int, tuple[int, float]] = {}
        self._far: dict[int, Candidates] = {}

    # A series --------------------------------------------------------------------------------

    def line_up(self) -> None:
        """Place labels of series whose points are close together."""
        names = dict.fromkeys(label.series for label in self.labels if label.series)
        if not names:
            return
        numbers = {id(label): k for k, label in enumerate(self.labels)}
        for name in names:
            for series in dense([label for label in self.labels if label.series == name]):
                found = arrange_in_column(self.paper, series, self._placed_costs)
                for label, place in zip(series.labels, found, strict=True):
                    if place is not None:
                        k = numbers[id(label)]
                        if self._placed_costs(place, np.zeros(1, dtype=np.intp))[0] < LEADERS_CROSS:
                            self._assign(
                                k, self._make_placement(self._choice(place, place.dislike), 0, 0.0)
                            )
                            self.lined.add(k)

    def _placed_costs(self, candidates: Candidates, rows: NDArray[np.intp]) -> Floats:
        """Return the costs of a new label's places from the labels already placed, shape (n,)."""
        return self.placed_labels.costs(-1, candidates, rows)

    # One label -------------------------------------------------------------------------------

    def fill(self, numbers: Sequence[int]) -> None:
        """Place labels that have none yet, one after another."""
        free = {k: int(np.sum(self.choices[k][0].costs < CROSSED)) for k in numbers}
        self._widen(numbers)
        # Labels with few free places go first, or the others would take these places.
        for k in sorted(numbers, key=lambda k: (-self.labels[k].priority, free[k], k)):
            if k in self.placements:
                continue
            best = self._best(k)
            if best.cost < CROSSED or not self.labels[k].optional:
                self._assign(k, best)

    def _assign(self, k: int, placement: _Placement) -> None:
        self.placements[k] = placement
        self.placed_labels.add(k, placement.choice.candidates, placement.row, placement.stamp)

    def _make_placement(self, choice: _CandidateSet, row: int, cost: float) -> _Placement:
        return _Placement(choice, row, cost, next(self.stamps))

    def _release(self, k: int) -> None:
        self.placements.pop(k, None)
        self.placed_labels.remove(k)

    def _best(self, k: int) -> _Placement:
        """Return the cheapest place of a label, a further one when all near ones are occupied."""
        best = self._sought(k, self._wider)
        if self.labels[k].optional:
            return best
        if best.cost >= CROSSED and any(choice.every is not None for choice in self.choices[k]):
            best = self._sought(k, self._complete_set)
        return best

    def _sought(self, k: int, choice: Callable[[int, int], _CandidateSet]) -> _Placement:
        """Return the cheapest of some places of a label, of further ones where it is needed."""
        best = self._cheapest(k, choice(k, 0))
        # A label of a crowd tries further places before its leader line crosses others, but breaks
        # a line sooner than moving to the other end of the drawing.
        alone = self.labels[k].style == SPARSE
        for number in (1, 2) if alone else (1,) if self.labels[k].style.far_rings else ():
            if best.cost < (CROSSED if alone else _FAR_COST):
                break
            further = self._cheapest(k, choice(k, number))
            if further.cost < best.cost:
                best = further
        return best

    def _widen(self, numbers: Sequence[int]) -> None:
        """Find the far places of the optional labels that have no near one, all at once."""
        ask = [
            k
            for k in numbers
            if self.labels[k].optional
            and self.labels[k].style.far_rings
            and self._cheapest(k, self.choices[k][0]).cost >= _FAR_COST
        ]
        if ask:
            far = self._free_far(ask)
            costs = self.paper.costs(far, self.strangers, self.lines, free=True)
            for k, places, own in zip(ask, far, costs, strict=True):
                self.choices[k].append(self._usable(places, own))

    def _free_far(self, numbers: Sequence[int]) -> list[Candidates]:
        """Return the free far places of optional labels."""
        new = [k for k in numbers if k not in self._far]
        if new:
            sets = [far_candidates(self.labels[k]) for k in new]
            for k, every, rows in zip(new, sets, self.paper.free(sets), strict=True):
                self._far[k] = every.chosen(rows)
        return [self._far[k] for k in numbers]

    def _wider(self, k: int, number: int) -> _CandidateSet:
        """Return the free ones of the places near a label (0), far (1), all over the bounds (2)."""
        while len(self.choices[k]) <= number:
            label = self.labels[k]
            more = (
                far_candidates(label)
                if len(self.choices[k]) == 1
                else grid_candidates(label, self.paper.bounds)
            )
            self.choices[k] += self._free([more])
        return self.choices[k][number]

    def _complete_set(self, k: int, number: int) -> _CandidateSet:
        """Return the same with the places that are not free."""
        choice = self._wider(k, number)
        if choice.every is not None:
            every = choice.every
            (free,) = self.paper.free([every])
            rest = np.setdiff1d(np.arange(len(every.boxes)), free, assume_unique=True)
            costs = np.empty(len(every.boxes))
            costs[free] = choice.costs
            (costs[rest],) = self.paper.costs([every.chosen(rest)], self.strangers, self.lines)
            choice = self.choices[k][number] = self._choice(every, costs)
        return choice

    def _cheapest(self, k: int, choice: _CandidateSet) -> _Placement:
        """Return the cheapest place of a set, comparing only places that may be the cheapest."""
        best, cost = 0, np.inf
        first, count = 0, _AT_ONCE
        while first < len(choice.order):
            rows = choice.order[first : first + count]
            if choice.costs[rows[0]] >= (min(cost, FORBIDDEN) if first else cost):
                break
            costs = np.round(choice.costs[rows] + self._overlap_costs(k, choice, rows), 9)
            least = int(np.argmin(costs))
            if costs[least] < cost:
                best, cost = int(rows[least]), float(costs[least])
            first, count = first + count, 2 * count
        return self._make_placement(choice, best, cost)

    def _free(self, sets: Sequence[Candidates]) -> list[_CandidateSet]:
        """Return the free places of sets, with their costs."""
        free = self.paper.free(sets)
        chosen = [every.chosen(rows) for every, rows in zip(sets, free, strict=True)]
        costs = self.paper.costs(chosen, self.strangers, self.lines, free=True)
        return [
            self._usable(candidates, own)
            if candidates.label.optional
            else self._choice(candidates, own, every)
            for candidates, own, every in zip(chosen, costs, sets, strict=True)
        ]

    def _usable(self, candidates: Candidates, costs: Floats) -> _CandidateSet:
        """Return the places that an optional label may take."""
        rows = np.flatnonzero(costs < CROSSED)
        return self._choice(candidates.chosen(rows), costs[rows])

    def _choice(
        self, candidates: Candidates, costs: Floats, every: Candidates | None = None
    ) -> _CandidateSet:
        return _CandidateSet.of(candidates, costs, len(self.labels), every)

    def _overlap_costs(self, k: int, choice: _CandidateSet, rows: NDArray[np.intp]) -> Floats:
        """Return the costs of some places of a label from the other labels, shape (n,)."""
        if self.labels[k].optional:  # asked once or twice: not worth those of all its places
            return self.placed_labels.costs(k, choice.candidates, rows)
        return np.asarray(
            self.placed_labels.overlap_costs(
                choice.overlaps, rows, self.placed_labels.all_except(k)
            ).sum(axis=1)
        )

    # Repair ----------------------------------------------------------------------------------

    def unfree(self) -> list[int]:
        """Return the labels that cross or overlap something."""
        return [k for k in self._firm if self._cost(k) >= CROSSED]

    @property
    def _firm(self) -> list[int]:
        return [k for k, label in enumerate(self.labels) if not label.optional]

    def _cost(self, k: int) -> float:
        """Return the cost of a label's place with all others where they are now."""
        changes, cost = self._costs.get(k, (-1, 0.0))
        if changes != self.placed_labels.changes:
            choice, row = self.placements[k].choice, self.placements[k].row
            cost = float(choice.costs[row] + self._overlap_costs(k, choice, np.array([row]))[0])
            self._costs[k] = self.placed_labels.changes, cost
        return cost

    def reconsider(self) -> None:
        """Move every label to a better place, if any, now that all are placed."""
        for _ in range(_PASSES):
            moved = False
            for k in self._firm:
                if k in self.lined:
                    continue  # out of its column it would be cheaper, but not better
                now, near = self._cost(k), self.choices[k][0]
                if now < _FAR_COST and len(near.order) and now <= near.costs[near.order[0]]:
                    continue  # no place is cheaper, whichever label moves
                best = self._best(k)
                if best.cost < now - 1e-6:
                    self._assign(k, best)
                    moved = True
            if not moved:
                return

    def improve(self) -> None:
        """Find shorter leader lines by moving other labels."""
        costs = {k: self._cost(k) for k in self._firm if k not in self.lined}
        bad = [k for k, cost in costs.items() if _POOR < cost < CROSSED]
        for k in sorted(bad, key=lambda k: (-costs[k], k)):
            self.displace_others(k)

    def displace_others(self, k: int) -> None:
        """Give a label a better place by displacing one or two others."""
        now = self._cost(k)
        if now < _POOR:
            return  # better since another one was repaired
        for choice in list(self.choices[k]):
            rows = choice.order[:_TRIED]
            rows = rows[choice.costs[rows] < min(now, CROSSED) - _MIN_GAIN]
            if not len(rows):
                continue
            there = self.placed_labels.all_except(k)
            meets = self.placed_labels.overlap_costs(choice.overlaps, rows, there) >= LEADERS_CROSS
            for row, met in zip(rows, meets, strict=True):
                sent = there[met].tolist()
                if self.lined.isdisjoint(sent) and len(sent) <= _SENT_AWAY:
                    taken = self._make_placement(choice, int(row), 0.0)
                    if self._try_displacing(k, taken, sent):
                        return

    def _try_displacing(self, k: int, to: _Placement, sent: Sequence[int]) -> bool:
        """Put a label in the place of others, and these elsewhere, if that is better in total."""
        before = {other: self.placements[other] for other in (k, *sent)}
        crossed, cost = self._state(before)
        for other in before:
            self._release(other)
        self._assign(k, to)
        for other in sent:
            self._assign(other, self._best(other))
        now, costs = self._state(before)
        if now <= crossed and costs < cost - _MIN_GAIN:
            return True
        for other in before:
            self._release(other)
        for other, taken in before.items():
            self._assign(other, taken)
        return False

    def _state(self, numbers: Iterable[int]) -> tuple[int, float]:
        """Return the number of some labels that are not free, and their total cost."""
        costs = [self._cost(k) for k in numbers]
        return sum(cost >= CROSSED for cost in costs), sum(costs)

    def break_lines(self, k: int) -> None:
        """Put a label of a crowd on thin lines that its white ground breaks: the last resort."""
        label = self.labels[k]
        if label.style == SPARSE or self._cost(k) < CROSSED:
            return
        for number in (0, 1):
            choice = self._wider(k, number)
            candidates = choice.every or choice.candidates
            (costs,) = self.paper.costs(
                [candidates], self.strangers, self.lines, may_interrupt_lines=True
            )
            best = self._cheapest(k, self._choice(candidates, costs))
            if best.cost < CROSSED:
                best.ground = True
                self._assign(k, best)
                return
        best = self._cheapest(k, self._complete_set(k, 2))
        if best.cost < self._cost(k):
            self._assign(k, best)

    def list_distant(self) -> list[int]:
        """Return the letters of a crowd whose leader lines are too long to follow."""
        crowd = (k for k in self._firm if self.labels[k].style != SPARSE)
        return [k for k in crowd if k not in self.lined and self._leader(k) > _LONG]

    def _leader(self, k: int) -> float:
        """Return the length of the leader line of a label, mm; 0 without one."""
        candidates, row = self.placements[k].choice.candidates, self.placements[k].row
        return float(np.nan_to_num(abs(candidates.ends[row] - candidates.starts[row])))

    def bring_near(self, k: int) -> None:
        """Put a letter at the end of a long leader line beside its point on a few thin lines."""
        choice = self._wider(k, 0)
        candidates = choice.every or choice.candidates
        (costs,) = self.paper.costs(
            [candidates], self.strangers, self.lines, may_interrupt_lines=True
        )
        best = self._cheapest(k, self._choice(candidates, costs))
        if best.cost < _FEW_BROKEN:
            best.ground = True
            self._assign(k, best)

    def lead_across(self) -> None:
        """Place names that are left on leader lines across other segments, from a dot.

        They make the picture no larger than its lines and the other labels do.
        """
        left = [k for k, label in enumerate(self.labels) if label.style.crossing_cost]
        left = [k for k in left if k not in self.placements]
        if not left:
            return
        x0, y0, x1, y1 = self._occupied()
        inside = [
            led_across(
                far.chosen(
                    np.flatnonzero(
                        (far.boxes[:, :2] >= (x0, y0)).all(axis=1)
                        & (far.boxes[:, 2:] <= (x1, y1)).all(axis=1)
                    )
                )
            )
            for far in self._free_far(left)
        ]
        costs = self.paper.costs(inside, self.strangers, self.lines, free=True)
        for k, places, own in zip(left, inside, costs, strict=True):
            best = self._cheapest(k, self._usable(places, own))
            if best.cost < CROSSED:
                self._assign(k, best)

    def _occupied(self) -> Bounds:
        """Return the box around the lines of the paper and the placed labels."""
        boxes = [
            taken.choice.candidates.boxes[taken.row].tolist() for taken in self.placements.values()
        ]
        ends = self.paper.segments.reshape(-1, 2)
        boxes += [[*ends.min(axis=0), *ends.max(axis=0)]] if len(ends) else []
        low, high = np.array(boxes)[:, :2].min(axis=0), np.array(boxes)[:, 2:].max(axis=0)
        return float(low[0]), float(low[1]), float(high[0]), float(high[1])

    def result(self) -> tuple[Placed, ...]:
        """Return the labels with their places."""
        return tuple(self._placed(k) for k in sorted(self.placements))

    def _placed(self, k: int) -> Placed:
        label, taken = self.labels[k], self.placements[k]
        candidates, row = taken.choice.candidates, taken.row
        x0, y0 = candidates.boxes[row, :2]
        leader = None
        if candidates.led[row]:
            leader = (complex(candidates.starts[row]), complex(candidates.ends[row]))
        return Placed(
            label,
            complex(x0, y0 + label.inscription.descent),
            leader,
            free=label.optional or (not taken.ground and self._cost(k) < CROSSED),
            ground=taken.ground,
            dotted=candidates.label.style.dotted,
        )


NEAR = 8.0
"""Largest distance of an optional label's middle from its point or segment, mm."""

SIDE_GAP = 1.0
"""Extra white on either side of a label, so that it is not read together with another."""


def spare_labels(
    labels: Sequence[Label], obstacles: Iterable[Item], bounds: Bounds
) -> list[Placed]:
    """Place the labels that have a free place, one after another; the others are left out.

    Parameters
    ----------
    labels : sequence of Label
    obstacles : iterable of Item
        As of `place_labels`.
    bounds : Bounds, mm
        All labels stay inside.
    """
    if not labels:
        return []
    paper = Paper(obstacles, bounds)
    sets = [near_candidates(label) for label in labels]
    free = [every.chosen(rows) for every, rows in zip(sets, paper.free(sets), strict=True)]
    white = np.array([-SIDE_GAP, 0, SIDE_GAP, 0]) + ROUND_AREAS * np.array([-1, -1, 1, 1])
    taken = np.empty((0, 4))
    found = []
    for label, places, costs in zip(labels, free, paper.costs(free, free=True), strict=True):
        x0, y0, x1, y1 = (places.boxes[:, k, None] for k in range(4))
        apart = (x1 < taken[:, 0]) | (x0 > taken[:, 2]) | (y1 < taken[:, 1]) | (y0 > taken[:, 3])
        costs = np.where(apart.all(axis=1), costs, np.inf)
        k = int(np.argmin(np.round(costs, 9))) if len(costs) else -1
        if k < 0 or costs[k] >= CROSSED or places.led[k]:
            continue
        box = places.boxes[k]
        middle = (complex(*box[:2]) + complex(*box[2:])) / 2
        if _off(middle, *(label.segment or (label.anchor, label.anchor))) < NEAR:
            at = complex(box[0], box[1] + label.inscription.descent)
            found.append(Placed(label, at, None, free=True, ground=False))
            taken = np.concatenate([taken, [box + white]])
    return found


def _off(place: complex, start: complex, end: complex) -> float:
    """Return how far a place is from a segment, mm."""
    way = end - start
    share = ((place - start) * way.conjugate()).real / max(abs(way) ** 2, 1e-12)
    return abs(place - start - way * min(1.0, max(0.0, share)))
