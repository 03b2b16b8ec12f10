"""The order of the stations of a side view is looked for (порядок на схеме).

Bodies on one axis must not stand in each other's way, few shafts are hollow, no shaft runs through
a wheel: `Arrangement.cost`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import field
from itertools import combinations, permutations

from planmethod.gears.arrangement import Arrangement, Part, Station
from planmethod.gears.scheme import EPS, Across, Scheme
from planmethod.record import dataclass, replace

MOST_ORDERS = 24
"""Orders of the columns that the search begins from."""


@dataclass(frozen=True, slots=True)
class Order:
    """An order that is tried: columns, and on which side of which column webs and arms stand."""

    order: tuple[int, ...]
    webs: tuple[tuple[int, str, int], ...] = field(default=())
    arms: tuple[tuple[str, int, int], ...] = field(default=())
    turns: tuple[int, ...] = ()

    def stations(self, scheme: Scheme) -> tuple[Station, ...]:
        """Return what stands from left to right."""
        stations: list[Station] = []
        for column in self.order:
            if column >= len(scheme.columns):
                across = scheme.across[column - len(scheme.columns)]
                stations += _apex(column, across, self.turns[column - len(scheme.columns)])
                continue
            left: list[Station] = []
            right: list[Station] = []
            for carrier, at, side in self.arms:
                if at == column:
                    (right if side > 0 else left).append(Station(Part.ARM, column, (), carrier))
            for at, label, side in self.webs:
                if at == column:
                    ring = next(rim for rim in scheme.columns[column] if rim.label == label)
                    station = Station(Part.WEB, column, (ring,), ring.body)
                    (right if side > 0 else left).append(station)
            rims = Station(Part.RIMS, column, scheme.columns[column])
            stations += [*left[::-1], rims, *right]
        return tuple(stations)

    def others(self, scheme: Scheme) -> Iterator[Order]:
        """Yield the orders that differ in one thing."""
        for i, j in combinations(range(len(self.order)), 2):
            for start, end in ((i, j), (j, i)):
                order = list(self.order)
                order.insert(end, order.pop(start))
                yield replace(self, order=tuple(order))
        for k, turn in enumerate(self.turns):
            yield replace(self, turns=(*self.turns[:k], -turn, *self.turns[k + 1 :]))
        for k, (at, label, side) in enumerate(self.webs):
            yield replace(self, webs=_put(self.webs, k, (at, label, -side)))
        for k, (carrier, at, side) in enumerate(self.arms):
            for column in _columns_of(scheme, carrier):
                for turned in (side, -side):
                    if (column, turned) != (at, side):
                        yield replace(self, arms=_put(self.arms, k, (carrier, column, turned)))


def _apex(column: int, across: Across, turn: int) -> list[Station]:
    """Return the stations of a body across: level wheels on both sides of the apex."""
    stations = [
        Station(Part.RIMS, column, (cone.rim,), offset=cone.side * turn * cone.radius)
        for cone in across.cones
    ]
    stations.append(Station(Part.APEX, column, (), across.carrier or "", across=across))
    return sorted(stations, key=lambda station: station.offset)


def _put(whole: tuple, k: int, one: tuple) -> tuple:  # type: ignore[type-arg]
    return (*whole[:k], one, *whole[k + 1 :])


def _columns_of(scheme: Scheme, carrier: str) -> list[int]:
    return [
        number
        for number, column in enumerate(scheme.columns)
        if any(scheme.over.get(rim.body) == carrier for rim in column)
    ]


def best_order(scheme: Scheme) -> Order:
    """Look for the best order of the stations: from several orders on, one change after another."""
    train, columns = scheme.motion.train, scheme.columns
    webs = tuple(
        (number, rim.label, -1)
        for number, column in enumerate(columns)
        for rim in column
        if rim.ring and rim.body not in train.fixed
    )
    arms = tuple(
        (carrier, _columns_of(scheme, carrier)[-1], 1)
        for carrier in train.carriers
        if _columns_of(scheme, carrier)
    )
    best: Order | None = None
    costs: dict[Order, float] = {}

    def cost(order: Order) -> float:
        if order not in costs:
            costs[order] = Arrangement(scheme, order.stations(scheme)).cost
        return costs[order]

    blocks = range(len(columns) + len(scheme.across))
    turns = (1,) * len(scheme.across)
    count = MOST_ORDERS // max(1, len(blocks) - 3) ** 2
    for first, _ in zip(permutations(blocks), range(max(count, 1)), strict=False):
        order = Order(first, webs, arms, turns)
        while True:
            better = min(order.others(scheme), key=cost, default=order)
            if cost(better) >= cost(order) - EPS:
                break
            order = better
        if best is None or cost(order) < cost(best) - EPS:
            best = order
    assert best is not None
    return best


def arrange(scheme: Scheme, order: Order | None = None) -> Arrangement:
    """Return the stations of a scheme in an order, in the best one where none is given."""
    return Arrangement(scheme, (order or best_order(scheme)).stations(scheme))
