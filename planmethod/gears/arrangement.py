"""The side view of a train before it is drawn: what stands where along the axes (компоновка схемы).

From left to right stand stations: wheels in mesh one above another, the webs of wheels with inner
teeth, the arms of carriers. Their order is looked for: bodies on one axis must not stand in each
other's way, few shafts are hollow, no shaft runs through a wheel.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import cached_property
from itertools import combinations, permutations

from planmethod.gears.model import PARALLEL, MeshKind
from planmethod.gears.motion import Motion
from planmethod.gears.picture import carrier_of

MOST_ORDERS = 24
"""Orders of the columns that the search begins from."""

_EPS = 1e-6

# What an arrangement costs
_IMPOSSIBLE = 100.0  # two bodies of one axis in each other's way
_CROSSED = 30.0  # a shaft runs through a wheel, a web or an arm
_HOLLOW = 3.0  # a body about another one's shaft
_HIDDEN = 1.0  # an input or an output that does not come out at an end
_LONG = 0.2  # a shaft, for each station that it passes
_BACK = 0.3  # a pair of columns in another order than in the file


class Part(Enum):
    """What stands at a station (что на месте)."""

    RIMS = "rims"
    WEB = "web"
    ARM = "arm"


@dataclass(frozen=True, slots=True)
class Rim:
    """A wheel in a column (венец).

    Attributes
    ----------
    centre, radius : float, mm
    ways : tuple of int
        On which sides of its axis it meshes there: +1 above.
    """

    label: str
    body: str
    centre: float
    radius: float
    ring: bool
    ways: tuple[int, ...]

    def spans(self) -> Iterator[tuple[float, float]]:
        """Yield the heights that its halves take; of a ring nothing but its rim."""
        for way in self.ways:
            far = self.centre + way * self.radius
            yield (far, far) if self.ring else (min(self.centre, far), max(self.centre, far))


@dataclass(frozen=True, slots=True)
class Station:
    """A place along the axes: the rims of a column, a web of a ring, or the arm of a carrier."""

    part: Part
    column: int
    rims: tuple[Rim, ...] = ()
    body: str = ""


@dataclass(frozen=True, slots=True)
class Stub:
    """Where a body comes out to the frame: a bearing, or the ground of a fixed one (опора).

    Attributes
    ----------
    gap : int
        After the station of this number; -1 is left of all.
    rank : float
        Order of the stubs of one axis in the gap.
    """

    body: str
    gap: int
    rank: float


@dataclass(frozen=True)
class Scheme:
    """Bodies of a train with their sizes on the paper, mm (данные схемы)."""

    motion: Motion
    mm: float

    @cached_property
    def heights(self) -> Mapping[str, float]:
        """Heights of the axes."""
        return {body: float(h) * self.mm for body, h in self.motion.axes.heights.items()}

    @cached_property
    def over(self) -> Mapping[str, str]:
        """Carriers of the bodies whose axes go round."""
        found = {body: carrier_of(self.motion, body) for body in self.heights}
        return {body: carrier for body, carrier in found.items() if carrier is not None}

    @cached_property
    def columns(self) -> tuple[tuple[Rim, ...], ...]:
        """Wheels by the columns that they mesh in.

        A wheel stands in a further column where it would lie on another one in the first.
        """
        columns: list[dict[str, Rim]] = []
        for one, other in self._meshing():
            for column in columns:
                if (one.label in column or other.label in column) and _fits(column, one, other):
                    break
            else:
                columns.append(column := {})
            for rim in (one, other):
                column[rim.label] = _joined(column.get(rim.label), rim)
        return tuple(tuple(column.values()) for column in columns)

    def _meshing(self) -> Iterator[tuple[Rim, Rim]]:
        train, sizes = self.motion.train, self.motion.axes.sizes
        for mesh in train.meshes:
            if mesh.kind not in PARALLEL:
                continue
            labels = (mesh.first, mesh.second)
            radii = [float(sizes[label]) * self.mm for label in labels]
            ends = train.ends(mesh)
            up = 1 if self.heights[ends[1]] > self.heights[ends[0]] else -1
            internal = mesh.kind is MeshKind.INTERNAL
            ways = [up, -up]
            if internal:
                ring = 0 if radii[0] > radii[1] else 1
                ways = [up, up] if ring == 0 else [-up, -up]
            rims = [
                Rim(label, body, self.heights[body], radius, internal and k == ring, (way,))
                for k, (label, body, radius, way) in enumerate(
                    zip(labels, ends, radii, ways, strict=True)
                )
            ]
            yield rims[0], rims[1]


def _joined(before: Rim | None, rim: Rim) -> Rim:
    if before is None:
        return rim
    return replace(before, ways=tuple(dict.fromkeys((*before.ways, *rim.ways))))


def _fits(column: Mapping[str, Rim], *rims: Rim) -> bool:
    """Whether wheels can stand in a column, none over another."""
    whole = {**column, **{rim.label: _joined(column.get(rim.label), rim) for rim in rims}}
    spans = [span for rim in whole.values() for span in rim.spans()]
    for (a, b), (c, d) in combinations(spans, 2):
        if min(b, d) - max(a, c) > _EPS or (a, b) == (c, d):
            return False
        point, (low, high) = ((a, (c, d)) if b - a < _EPS else (c, (a, b)))
        if (b - a < _EPS or d - c < _EPS) and low + _EPS < point < high - _EPS:
            return False
    return True


@dataclass(frozen=True)
class Arrangement:
    """Stations in an order, and what follows from it (расстановка).

    Attributes
    ----------
    stations : tuple of Station
        From left to right.
    """

    scheme: Scheme
    stations: tuple[Station, ...]

    @cached_property
    def at(self) -> Mapping[str, tuple[int, ...]]:
        """Stations that a body has on its own axis, by number, sorted."""
        found: dict[str, set[int]] = {}
        over, fixed = self.scheme.over, self.scheme.motion.train.fixed
        for number, station in enumerate(self.stations):
            if station.part is not Part.RIMS:
                found.setdefault(station.body, set()).add(number)
            for rim in station.rims if station.part is Part.RIMS else ():
                if not rim.ring:
                    found.setdefault(rim.body, set()).add(number)
        for number, station in enumerate(self.stations):
            if station.part is Part.ARM:
                for body, carrier in over.items():
                    if carrier == station.body:
                        found.setdefault(body, set()).add(number)
        for body in fixed:  # a ring alone is held by its rim
            if not found.get(body, True):
                found.pop(body)
        return {body: tuple(sorted(numbers)) for body, numbers in found.items()}

    @cached_property
    def blocked(self) -> frozenset[int]:
        """Gaps that the frame does not reach: within a set that goes round, or within a ring."""
        spans: list[set[int]] = []
        for number, station in enumerate(self.stations):
            if station.part is Part.WEB:
                rims = next(
                    k
                    for k, other in enumerate(self.stations)
                    if other.part is Part.RIMS and other.column == station.column
                )
                spans.append({number, rims})
            if station.part is Part.ARM:
                carried = {b for b, c in self.scheme.over.items() if c == station.body}
                own = [
                    k
                    for k, other in enumerate(self.stations)
                    if any(rim.body in carried for rim in other.rims)
                ]
                spans.append({number, *own})
        return frozenset(gap for span in spans for gap in range(min(span), max(span)))

    @cached_property
    def stubs(self) -> Mapping[str, Stub]:
        """Where each body that turns about a fixed axis comes out to the frame."""
        train, found = self.scheme.motion.train, {}
        last = len(self.stations) - 1
        for body, numbers in self.at.items():
            if body in self.scheme.over:
                continue
            low, high = numbers[0], numbers[-1]
            free = [gap for gap in range(-1, last + 1) if gap not in self.blocked]
            left_first = body in train.inputs or body != self.scheme.motion.train.output

            def far(gap: int, low: int = low, high: int = high, left: bool = left_first) -> float:
                inside = low <= gap < high
                outside = max(low - 1 - gap, gap - high, 0)
                ends = gap == (-1 if left else last)
                others = sum(
                    1 for other in self.at if other != body and self._is_passed(other, body, gap)
                )
                return outside + 3 * others + (0.0 if ends else 0.2) + (0.1 if inside else 0.0)

            gap = min(free, key=far)
            passed = max(low - 1 - gap, gap - high, 0)
            rank = 0.5 if low <= gap < high else 0.7 - 0.02 * passed if gap < low else 0.3
            rank = 0.3 + 0.02 * passed if gap >= high else rank
            found[body] = Stub(body, gap, rank)
        return found

    def _is_passed(self, other: str, body: str, gap: int) -> bool:
        """Whether a body that comes out in a gap would pass through another one of its axis."""
        if self._height(other) != self._height(body):
            return False
        numbers = (*self.at[body], gap + 0.5)
        return any(min(numbers) < k < max(numbers) for k in self.at[other])

    def _height(self, body: str) -> float:
        return round(self.scheme.heights[body], 6)

    @cached_property
    def reach(self) -> Mapping[str, tuple[float, float]]:
        """From where to where a body's shaft goes, in stations."""
        found = {}
        for body, numbers in self.at.items():
            ends: list[float] = list(numbers)
            if body in self.stubs:
                ends.append(self.stubs[body].gap + self.stubs[body].rank)
            found[body] = min(ends), max(ends)
        return found

    def inner(self, body: str) -> list[str]:
        """Return the bodies whose shafts pass through a body of the same axis."""
        same = (other for other in self.reach if self._height(other) == self._height(body))
        return [other for other in same if other != body and self._is_about(body, other)]

    def _is_about(self, body: str, other: str) -> bool:
        """Whether a body can turn about the shaft of another one."""
        low, high = self.reach[body]
        a, b = self.reach[other]
        return a < low and high < b and not any(low <= k <= high for k in self.at[other])

    def verticals(self) -> Iterator[tuple[int, float, float, str]]:
        """Yield what stands across the axes: station, from what height to what, body."""
        for number, station in enumerate(self.stations):
            match station.part:
                case Part.ARM:
                    heights = [self.scheme.heights[station.body], *self.arms(station.body)]
                    yield number, min(heights), max(heights), station.body
                case Part.WEB:
                    (ring,) = station.rims
                    for way in ring.ways:
                        ends = sorted((ring.centre, ring.centre + way * ring.radius))
                        yield number, ends[0], ends[1], ring.body
                case Part.RIMS:
                    for rim in station.rims:
                        yield from ((number, a, b, rim.body) for a, b in rim.spans() if b > a)

    def arms(self, carrier: str) -> list[float]:
        """Return the heights of the axes that a carrier carries."""
        return [self.scheme.heights[b] for b, c in self.scheme.over.items() if c == carrier]

    def crosses(self, number: int, low: float, high: float, body: str) -> Iterator[str]:
        """Yield the bodies whose shafts run through what stands across the axes somewhere."""
        for other, (a, b) in self.reach.items():
            inside = low + _EPS < self.scheme.heights[other] < high - _EPS
            carried = self.scheme.over.get(other) == body
            if other != body and not carried and inside and a < number < b:
                yield other

    @cached_property
    def cost(self) -> float:
        """What is to be least."""
        cost = 0.0
        for one, other in combinations(self.reach, 2):
            (a, b), (c, d) = self.reach[one], self.reach[other]
            if self._height(one) != self._height(other) or b < c or d < a:
                continue
            about = self._is_about(one, other) or self._is_about(other, one)
            cost += _HOLLOW if about else _IMPOSSIBLE
        for vertical in self.verticals():
            cost += _CROSSED * sum(1 for _ in self.crosses(*vertical))
        train = self.scheme.motion.train
        last = len(self.stations) - 1
        for body, stub in self.stubs.items():
            if body in train.inputs or body == train.output:
                cost += _HIDDEN * (stub.gap not in (-1, last))
        cost += _LONG * sum(b - a for a, b in self.reach.values())
        order = [s.column for s in self.stations if s.part is Part.RIMS]
        return cost + _BACK * sum(one > two for one, two in combinations(order, 2))


@dataclass(frozen=True, slots=True)
class _Plan:
    """An order that is tried: columns, and on which side of which column webs and arms stand."""

    order: tuple[int, ...]
    webs: tuple[tuple[int, Rim, int], ...] = field(default=())
    arms: tuple[tuple[str, int, int], ...] = field(default=())

    def stations(self, scheme: Scheme) -> tuple[Station, ...]:
        stations: list[Station] = []
        for column in self.order:
            left: list[Station] = []
            right: list[Station] = []
            for carrier, at, side in self.arms:
                if at == column:
                    (right if side > 0 else left).append(Station(Part.ARM, column, (), carrier))
            for at, ring, side in self.webs:
                if at == column:
                    station = Station(Part.WEB, column, (ring,), ring.body)
                    (right if side > 0 else left).append(station)
            rims = Station(Part.RIMS, column, scheme.columns[column])
            stations += [*left[::-1], rims, *right]
        return tuple(stations)

    def others(self, scheme: Scheme) -> Iterator[_Plan]:
        """Yield the orders that differ in one thing."""
        for i, j in combinations(range(len(self.order)), 2):
            order = list(self.order)
            order[i], order[j] = order[j], order[i]
            yield replace(self, order=tuple(order))
            order = list(self.order)
            order.insert(j, order.pop(i))
            yield replace(self, order=tuple(order))
        for k, (at, ring, side) in enumerate(self.webs):
            yield replace(self, webs=_put(self.webs, k, (at, ring, -side)))
        for k, (carrier, at, side) in enumerate(self.arms):
            for column in _columns_of(scheme, carrier):
                for turned in (side, -side):
                    if (column, turned) != (at, side):
                        yield replace(self, arms=_put(self.arms, k, (carrier, column, turned)))


def _put(whole: tuple, k: int, one: tuple) -> tuple:  # type: ignore[type-arg]
    return (*whole[:k], one, *whole[k + 1 :])


def _columns_of(scheme: Scheme, carrier: str) -> list[int]:
    return [
        number
        for number, column in enumerate(scheme.columns)
        if any(scheme.over.get(rim.body) == carrier for rim in column)
    ]


def arrange(scheme: Scheme) -> Arrangement:
    """Look for the best order of the stations: from several orders on, one change after another."""
    train, columns = scheme.motion.train, scheme.columns
    webs = tuple(
        (number, rim, -1)
        for number, column in enumerate(columns)
        for rim in column
        if rim.ring and rim.body not in train.fixed
    )
    arms = tuple(
        (carrier, _columns_of(scheme, carrier)[-1], 1)
        for carrier in train.carriers
        if _columns_of(scheme, carrier)
    )
    best: Arrangement | None = None
    tried: dict[_Plan, Arrangement] = {}

    def made(plan: _Plan) -> Arrangement:
        if plan not in tried:
            tried[plan] = Arrangement(scheme, plan.stations(scheme))
        return tried[plan]

    for order, _ in zip(permutations(range(len(columns))), range(MOST_ORDERS), strict=False):
        plan = _Plan(order, webs, arms)
        while True:
            better = min(plan.others(scheme), key=lambda one: made(one).cost, default=plan)
            if made(better).cost >= made(plan).cost - _EPS:
                break
            plan = better
        if best is None or made(plan).cost < best.cost - _EPS:
            best = made(plan)
    assert best is not None
    return best
