"""Content of the side view of a train, and its layout along the axes (компоновка схемы)."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import cached_property
from itertools import combinations, permutations

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.gears.axes import find_axes
from planmethod.gears.model import PARALLEL, Mesh, MeshKind
from planmethod.gears.motion import TrainMotion

WORM = 0.25
"""Radius of a worm by that of its wheel: it does not follow from its starts."""

BELT = 1.3
"""Distance of the axes of a belt, by the sum of the radii."""

OVER_CONE = 1.2
"""Distance of two level bevel wheels one above another, by the sum of the radii."""

EPS = 1e-6
"""Heights that differ by less are one, mm."""


class Rim(Struct, frozen=True):
    """A wheel in a column (венец).

    Attributes
    ----------
    centre, radius : float, mm
    mesh_sides : tuple of int
        Sides of its axis on which it meshes there: +1 above.
    reaches : tuple of float, mm
        Its extent on each of them, where shifts make that different from ``radius``.
    """

    label: str
    body: str
    centre: float
    radius: float
    ring: bool
    mesh_sides: tuple[int, ...]
    reaches: tuple[float, ...] = ()

    def reach(self, side: int) -> float:
        """Return its extent on a side of its axis, mm."""
        return dict(zip(self.mesh_sides, self.reaches, strict=False)).get(side, self.radius)

    def spans(self) -> Iterator[tuple[float, float]]:
        """Yield the height ranges of its halves; for a ring only its rim."""
        for way in self.mesh_sides:
            far = self.centre + way * self.reach(way)
            yield (far, far) if self.ring else (min(self.centre, far), max(self.centre, far))


class Cone(Struct, frozen=True):
    """A bevel mesh of a transverse wheel (коническое зацепление).

    Attributes
    ----------
    rim : Rim
        The wheel on the level axis.
    label : str
        Label of the transverse wheel, ``radius`` its radius, mm.
    side : int
        Side of the apex with the level wheel: -1 left.
    """

    rim: Rim
    label: str
    radius: float
    side: int


class TransverseBody(Struct, frozen=True):
    """A body whose axis is perpendicular to the others, in the paper (поперечное звено)."""

    body: str
    carrier: str | None
    cones: tuple[Cone, ...]


class Worm(Struct, frozen=True):
    """A worm mesh (червячная передача).

    Attributes
    ----------
    rim : Rim
        The part on a level axis.
    label : str
        The other one, seen along its axis; ``radius`` is its radius, mm.
    is_level : bool
        Whether the worm is the level part.
    """

    rim: Rim
    label: str
    radius: float
    is_level: bool


class SchemeData(Struct, frozen=True, dict=True):
    """Bodies of a train with their sizes on the paper, mm (данные схемы)."""

    motion: TrainMotion
    mm: float

    @cached_property
    def heights(self) -> Mapping[str, float]:
        """Heights of the level axes; chosen for the drawing if the train does not fix them."""
        train, axes = self.motion.train, self.motion.axes
        line = axes.axis_of
        known = {line[body]: float(height) * self.mm for body, height in axes.heights.items()}
        left = list(train.meshes)
        while True:
            mesh = next((m for m in left if self._new_line(m, known) is not None), None)
            if mesh is None:
                break
            left.remove(mesh)
            new, height = self._new_line(mesh, known) or ("", 0.0)
            known[new] = height
        level = [b for b in train.bodies if b not in self.motion.roles.transverse | train.racks]
        return {body: known[line[body]] for body in level if line[body] in known}

    def _new_line(self, mesh: Mesh, known: Mapping[str, float]) -> tuple[str, float] | None:
        """Return the axis whose height a mesh determines, and the height."""
        line, across = self.motion.axes.axis_of, self.motion.roles.transverse
        ends = list(self.motion.train.ends(mesh))
        if mesh.kind is MeshKind.BEVEL:  # over the other level wheels of the body across
            (turned,) = [body for body in ends if body in across]
            rims = [(cone_body, radius) for cone_body, _, radius in self._cones(turned)]
            told = [(known[line[b]], r) for b, r in rims if line[b] in known]
            for body, radius in rims:
                if line[body] not in known and told:
                    return line[body], max(h + OVER_CONE * (r + radius) for h, r in told)
            return None
        if mesh.kind is MeshKind.WORM:
            level = mesh.second if self._is_last(mesh.first) else mesh.first
            body = self.motion.train.body_of[level]
            return None if line[body] in known else (line[body], 0.0)
        if mesh.kind is MeshKind.RACK:
            return None
        if mesh.kind in PARALLEL:
            apart = float(self.motion.axes.distances[mesh.name]) * self.mm
        else:
            apart = BELT * sum(self.radius(label) for label in (mesh.first, mesh.second))
        for one, other in (ends, ends[::-1]):
            if line[one] in known and line[other] not in known:
                return line[other], known[line[one]] + apart
        return None

    def radius(self, label: str) -> float:
        """Return the radius of a wheel, mm: of the circle that rolls, the mean of several."""
        rolling = self.rolling.get(label)
        if rolling is None:
            return float(self.motion.axes.radii[label]) * self.mm
        return sum(rolling.values()) / len(rolling)

    @cached_property
    def rolling(self) -> Mapping[str, Mapping[str, float]]:
        """Radii of the circles that roll on each other, by wheel and mesh, where shifts alter them.

        They divide the drawn centre distance in proportion to the teeth.
        """
        found: dict[str, dict[str, float]] = {}
        axes = self.motion.axes
        touched = {x for m in self.motion.train.meshes if m.name in axes.shifted
                   for x in (m.first, m.second)}  # fmt: skip
        for mesh in self.motion.train.meshes:
            labels = (mesh.first, mesh.second)
            one, other = self.motion.train.ends(mesh)
            if mesh.kind not in PARALLEL or not touched & set(labels):
                continue
            if one not in axes.heights or other not in axes.heights:
                continue
            apart = float(abs(axes.heights[one] - axes.heights[other])) * self.mm
            way = 1 if mesh.kind is MeshKind.EXTERNAL else -1
            first, second = (float(axes.sizes[label]) for label in labels)
            for label, size in zip(labels, (first, second), strict=True):
                share = size / abs(first + way * second)
                found.setdefault(label, {})[mesh.name] = apart * share
        return found

    def _cones(self, transverse: str) -> Iterator[tuple[str, Mesh, float]]:
        """Yield the level bodies that a transverse body meshes with, and their radii."""
        train = self.motion.train
        for mesh in train.meshes:
            if mesh.kind is MeshKind.BEVEL and transverse in train.ends(mesh):
                one, other = train.ends(mesh)
                level, label = (other, mesh.second) if one == transverse else (one, mesh.first)
                yield level, mesh, self.radius(label)

    @cached_property
    def transverse_bodies(self) -> tuple[TransverseBody, ...]:
        """Transverse bodies, with their bevel meshes."""
        found = []
        for turned in sorted(self.motion.roles.transverse):
            cones, carrier = [], None
            for body, mesh, radius in self._cones(turned):
                carrier = self.motion.train.carrier(mesh)
                first = self.motion.train.ends(mesh)[0] == turned
                own, other = (mesh.first, mesh.second)[:: 1 if first else -1]
                rim = Rim(other, body, self.heights[body], radius, ring=False, mesh_sides=(1,))
                side = -self.motion.roles.senses[mesh]
                cones.append(Cone(rim, own, self.radius(own), side))
            found.append(TransverseBody(turned, carrier, tuple(cones)))
        return tuple(found)

    @cached_property
    def worms(self) -> tuple[Worm, ...]:
        """Worm meshes."""
        train, sizes, found = self.motion.train, self.motion.axes.sizes, []
        for mesh in train.meshes:
            if mesh.kind is MeshKind.WORM:
                wheel = max((mesh.first, mesh.second), key=lambda label: sizes[label])
                radii = {
                    label: self.radius(wheel) * (1.0 if label == wheel else WORM)
                    for label in (mesh.first, mesh.second)
                }
                level = mesh.second if self._is_last(mesh.first) else mesh.first
                other = mesh.first if level == mesh.second else mesh.second
                body = train.body_of[level]
                rim = Rim(level, body, self.heights.get(body, 0.0), radii[level], False, (-1,))
                found.append(Worm(rim, other, radii[other], level != wheel))
        return tuple(found)

    def _is_last(self, label: str) -> bool:
        """Return whether a body meshes only once."""
        train = self.motion.train
        return sum(train.body_of[label] in train.ends(mesh) for mesh in train.meshes) == 1

    @cached_property
    def undrawn(self) -> tuple[str, ...]:
        """Meshes that cannot be drawn with all level axes in one plane, by kind."""
        train, turned = self.motion.train, self.motion.roles.transverse
        found = []
        for mesh in train.meshes:
            ends = train.ends(mesh)
            level = [body for body in ends if body not in turned | train.racks]
            if mesh.kind is MeshKind.WORM:
                fits = any(map(self._is_last, (mesh.first, mesh.second))) and len(level) == 2
            else:
                count = 1 if mesh.kind in (MeshKind.BEVEL, MeshKind.RACK) else 2
                fits = len(level) == count and all(body in self.heights for body in level)
            carrier = train.carrier(mesh)
            fits = fits and (carrier is None or carrier in self.heights)
            found += [] if fits else [mesh.kind.value]
        return tuple(dict.fromkeys(found))

    @cached_property
    def over(self) -> Mapping[str, str]:
        """Carriers of the bodies whose level axes go round."""
        heights = self.heights
        return {
            body: carrier
            for carrier, bodies in self.motion.roles.planets.items()
            for body in bodies
            if body in heights and carrier in heights and heights[body] != heights[carrier]
        }

    @cached_property
    def coaxial_bodies(self) -> Mapping[str, frozenset[str]]:
        """By body, the other bodies on its axis."""
        levels = {body: round(height, 6) for body, height in self.heights.items()}
        return {
            body: frozenset(b for b, level in levels.items() if level == own and b != body)
            for body, own in levels.items()
        }

    @cached_property
    def columns(self) -> tuple[tuple[Rim, ...], ...]:
        """Wheels by the columns that they mesh in.

        A wheel is placed in a further column where it would overlap another one in the first.
        """
        columns: list[dict[str, Rim]] = []
        for rims in self._meshing():
            for column in columns:
                if any(rim.label in column for rim in rims) and _has_no_overlap(column, *rims):
                    break
            else:
                columns.append(column := {})
            for rim in rims:
                column[rim.label] = _merge_rims(column.get(rim.label), rim)
        return tuple(tuple(column.values()) for column in columns)

    def _meshing(self) -> Iterator[tuple[Rim, ...]]:
        train = self.motion.train
        for mesh in train.meshes:
            if mesh.kind is MeshKind.BEVEL:
                continue
            if mesh.kind is MeshKind.WORM:
                both = (mesh.first, mesh.second)
                yield tuple(worm.rim for worm in self.worms if worm.label in both)
                continue
            labels = [mesh.first] if mesh.kind is MeshKind.RACK else [mesh.first, mesh.second]
            radii = [self.rolling.get(x, {}).get(mesh.name, self.radius(x)) for x in labels]
            bodies = [train.body_of[label] for label in labels]
            if len(labels) == 1:
                yield (Rim(labels[0], bodies[0], self.heights[bodies[0]], radii[0], False, (-1,)),)
                continue
            up = 1 if self.heights[bodies[1]] > self.heights[bodies[0]] else -1
            ways, ring = [up, -up], -1
            if mesh.kind is MeshKind.INTERNAL:
                ring = 0 if radii[0] > radii[1] else 1
                ways = [up, up] if ring == 0 else [-up, -up]
            yield tuple(
                Rim(label, body, self.heights[body], radius, k == ring, (way,))
                for k, (label, body, radius, way) in enumerate(
                    zip(labels, bodies, radii, ways, strict=True)
                )
            )


def scheme_parts(motion: TrainMotion) -> tuple[TrainMotion, ...]:
    """Return the parts of a train that are drawn as views of their own: in each one plane of axes.

    Most trains are one part. A part begins where axes leave the plane of those before; the meshes
    of a carrier stay together. If a part cannot be drawn either, the train is returned whole.
    """
    if not SchemeData(motion, 1.0).undrawn:
        return (motion,)
    train, parts, taken = motion.train, list[TrainMotion](), list[Mesh]()
    for mesh in train.meshes:
        if mesh in taken:
            continue
        carrier = train.carrier(mesh)
        own = [m for m in train.meshes if m == mesh or (carrier and train.carrier(m) == carrier)]
        taken += own
        if parts:
            longer = _part(motion, [*parts[-1].train.meshes, *own])
            if longer is not None:
                parts[-1] = longer
                continue
        part = _part(motion, own)
        if part is None:
            return (motion,)
        parts.append(part)
    return tuple(parts)


def _part(motion: TrainMotion, meshes: Sequence[Mesh]) -> TrainMotion | None:
    """Return some meshes of a train as a train with its speeds; None if it cannot be drawn."""
    train, roles = motion.train, motion.roles
    labels = {label for mesh in meshes for label in (mesh.first, mesh.second)}
    carriers = {body for mesh in meshes if (body := train.carrier(mesh)) is not None}
    bodies = {train.body_of[label] for label in labels} | carriers
    turned = {b for m in meshes if m.kind is MeshKind.BEVEL for b in train.ends(m)}
    sizes = motion.axes.sizes
    own_train = replace(
        train,
        meshes=tuple(meshes),
        wheels={x: replace(w, size=sizes[x]) for x, w in train.wheels.items() if x in labels},
        bodies=tuple(body for body in train.bodies if body in bodies),
        carriers=tuple(body for body in train.carriers if body in carriers),
        racks=train.racks & bodies,
        fixed=train.fixed & bodies,
        inputs={body: speed for body, speed in train.inputs.items() if body in bodies},
        unknown=(),
        coaxial=tuple(own for group in train.coaxial if (own := _of(group, bodies))[1:]),
    )
    own_roles = replace(
        roles,
        central={c: _of(found, bodies) for c, found in roles.central.items() if c in carriers},
        planets={c: _of(found, bodies) for c, found in roles.planets.items() if c in carriers},
        transverse=roles.transverse & turned,
    )
    axes, _ = find_axes(own_train, own_roles)
    if axes is None:
        return None
    part = replace(motion, train=own_train, roles=own_roles, axes=axes)
    return None if SchemeData(part, 1.0).undrawn else part


def _of(names: Iterable[str], of_part: Collection[str]) -> tuple[str, ...]:
    return tuple(name for name in names if name in of_part)


def _merge_rims(before: Rim | None, rim: Rim) -> Rim:
    if before is None:
        return rim
    ways = tuple(dict.fromkeys((*before.mesh_sides, *rim.mesh_sides)))
    reaches = tuple((before if way in before.mesh_sides else rim).reach(way) for way in ways)
    if all(abs(one - before.radius) < EPS for one in reaches):
        return replace(before, mesh_sides=ways)
    return replace(before, mesh_sides=ways, radius=sum(reaches) / len(reaches), reaches=reaches)


def _has_no_overlap(column: Mapping[str, Rim], *rims: Rim) -> bool:
    """Return whether wheels fit in a column without overlap."""
    if any(column[rim.label].ring != rim.ring for rim in rims if rim.label in column):
        return False  # one wheel has teeth inside and outside
    whole = {**column, **{rim.label: _merge_rims(column.get(rim.label), rim) for rim in rims}}
    spans = [span for rim in whole.values() for span in rim.spans()]
    for (a, b), (c, d) in combinations(spans, 2):
        if min(b, d) - max(a, c) > EPS or abs(a - c) + abs(b - d) < EPS:
            return False
        point, (low, high) = (a, (c, d)) if b - a < EPS else (c, (a, b))
        if (b - a < EPS or d - c < EPS) and low + EPS < point < high - EPS:
            return False
    return True


# Costs of an arrangement
_IMPOSSIBLE = 100.0  # two bodies of one axis in each other's way
_CROSSED = 30.0  # a shaft runs through a wheel, a web or an arm
_HOLLOW = 3.0  # a body about another one's shaft
_HIDDEN = 1.0  # an input or an output that does not come out at an end
_LONG = 0.2  # a shaft, for each station that it passes
_BACK = 0.3  # a pair of columns in another order than in the file


class AxisPart(Enum):
    """The part at a station (что на месте)."""

    RIMS = "rims"
    WEB = "web"
    ARM = "arm"
    APEX = "apex"  # where the axis of a bevel wheel across the others meets them


class Station(Struct, frozen=True):
    """A place along the axes: the rims of a column, a web of a ring, an arm, an apex.

    ``offset`` is its place from the apex of its column, mm.
    """

    part: AxisPart
    column: int
    rims: tuple[Rim, ...] = ()
    body: str = ""
    offset: float = 0.0
    transverse: TransverseBody | None = None


class Stub(Struct, frozen=True):
    """Place where a body meets the frame: a bearing, or the ground of a fixed body (опора).

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


class Arrangement(Struct, frozen=True, dict=True):
    """Ordered stations, and the layout that follows from their order (расстановка).

    Attributes
    ----------
    stations : tuple of Station
        From left to right.
    """

    scheme: SchemeData
    stations: tuple[Station, ...]

    @cached_property
    def at(self) -> Mapping[str, tuple[int, ...]]:
        """Stations that a body has on its own axis, by number, sorted."""
        found: dict[str, set[int]] = {}
        over, fixed = self.scheme.over, self.scheme.motion.train.fixed
        for number, station in enumerate(self.stations):
            if station.part is not AxisPart.RIMS and station.body:
                found.setdefault(station.body, set()).add(number)
            for rim in station.rims if station.part is AxisPart.RIMS else ():
                if not rim.ring:
                    found.setdefault(rim.body, set()).add(number)
        for number, station in enumerate(self.stations):
            if station.part is AxisPart.ARM:
                for body, carrier in over.items():
                    if carrier == station.body:
                        found.setdefault(body, set()).add(number)
        for body in fixed:  # a ring alone is held by its rim
            if not found.get(body, True):
                found.pop(body)
        return {body: tuple(sorted(numbers)) for body, numbers in found.items()}

    @cached_property
    def blocked(self) -> frozenset[int]:
        """Gaps that the frame does not reach: within a rotating set, or within a ring."""
        spans: list[set[int]] = []
        for number, station in enumerate(self.stations):
            if station.part is AxisPart.WEB:
                rims = next(
                    k
                    for k, other in enumerate(self.stations)
                    if other.part is AxisPart.RIMS and other.column == station.column
                )
                spans.append({number, rims})
            if station.part is AxisPart.APEX:
                own = [k for k, s in enumerate(self.stations) if s.column == station.column]
                spans.append(set(own))
            if station.part is AxisPart.ARM:
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
        """Bearing or ground of each body that turns about a fixed axis."""
        train, found = self.scheme.motion.train, {}
        last = len(self.stations) - 1
        free = [gap for gap in range(-1, last + 1) if gap not in self.blocked]
        for body, numbers in self.at.items():
            if body in self.scheme.over:
                continue
            low, high = numbers[0], numbers[-1]
            near = [gap for gap in free if low - 1 <= gap <= high]
            near = near or [max(g for g in free if g < low), min(g for g in free if g > high)]
            ends = last if body == train.output and body not in train.inputs else -1
            far = {gap: self._stub_cost(body, gap) + 0.2 * (gap != ends) for gap in near}
            gap = min(near, key=far.__getitem__)
            passed = 0.02 * max(low - 1 - gap, gap - high, 0)
            inside = low <= gap < high
            rank = 0.5 if inside else 0.7 - passed if gap < low else 0.3 + passed
            found[body] = Stub(body, gap, rank)
        return found

    def _stub_cost(self, body: str, gap: int) -> float:
        """Return the cost of a stub of a body in a gap: other bodies block its way."""
        low, high = self.at[body][0], self.at[body][-1]
        start, end = min(low, gap + 0.5), max(high, gap + 0.5)
        passed = sum(
            any(start < k < end for k in self.at[other])
            for other in self.scheme.coaxial_bodies[body]
            if other in self.at
        )
        return max(low - 1 - gap, gap - high, 0) + 3 * passed + 0.1 * (low <= gap < high)

    @cached_property
    def reach(self) -> Mapping[str, tuple[float, float]]:
        """Both ends of each body's shaft, in stations."""
        found = {}
        for body, numbers in self.at.items():
            ends: list[float] = list(numbers)
            if body in self.stubs:
                ends.append(self.stubs[body].gap + self.stubs[body].rank)
            found[body] = min(ends), max(ends)
        return found

    def inner(self, body: str) -> list[str]:
        """Return the bodies whose shafts pass through a body of the same axis."""
        same = (other for other in self.scheme.coaxial_bodies[body] if other in self.reach)
        return [other for other in same if self._is_about(body, other)]

    def _is_about(self, body: str, inner: str) -> bool:
        """Return whether a body can turn about the shaft of another one."""
        low, high = self.reach[body]
        a, b = self.reach[inner]
        return a < low and high < b and not any(low <= k <= high for k in self.at[inner])

    def verticals(self) -> Iterator[tuple[int, float, float, str]]:
        """Yield the parts perpendicular to the axes: station, lower and upper height, body."""
        for number, station in enumerate(self.stations):
            match station.part:
                case AxisPart.ARM:
                    heights = [self.scheme.heights[station.body], *self.arms(station.body)]
                    yield number, min(heights), max(heights), station.body
                case AxisPart.WEB:
                    (ring,) = station.rims
                    for way in ring.mesh_sides:
                        ends = sorted((ring.centre, ring.centre + way * ring.reach(way)))
                        yield number, ends[0], ends[1], ring.body
                case AxisPart.APEX:
                    assert station.transverse is not None
                    tops = [cone.rim.centre + cone.rim.radius for cone in station.transverse.cones]
                    feet = [cone.rim.centre for cone in station.transverse.cones]
                    yield number, min(feet), max(tops), station.body or station.transverse.body
                case AxisPart.RIMS:
                    for rim in station.rims:
                        yield from ((number, a, b, rim.body) for a, b in rim.spans() if b > a)

    def arms(self, carrier: str) -> list[float]:
        """Return the heights of the axes that a carrier carries."""
        return [self.scheme.heights[b] for b, c in self.scheme.over.items() if c == carrier]

    def crosses(self, number: int, low: float, high: float, body: str) -> Iterator[str]:
        """Yield the bodies whose shafts pass through a part perpendicular to the axes."""
        for other, (a, b) in self.reach.items():
            inside = low + EPS < self.scheme.heights[other] < high - EPS
            carried = self.scheme.over.get(other) == body
            if other != body and not carried and inside and a < number < b:
                yield other

    @cached_property
    def cost(self) -> float:
        """Cost that the search minimizes."""
        cost = 0.0
        for one, other in combinations(self.reach, 2):
            (a, b), (c, d) = self.reach[one], self.reach[other]
            if other not in self.scheme.coaxial_bodies[one] or b < c or d < a:
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
        order = [s.column for s in self.stations if s.part is AxisPart.RIMS]
        return cost + _BACK * sum(one > two for one, two in combinations(order, 2))


MAX_ORDERS = 24
"""Orders of the columns that the search begins from."""


class ColumnOrder(Struct, frozen=True):
    """A candidate order: columns, and the column and side of each web and arm."""

    order: tuple[int, ...]
    webs: tuple[tuple[int, str, int], ...] = field(default=())
    arms: tuple[tuple[str, int, int], ...] = field(default=())
    turns: tuple[int, ...] = ()

    def stations(self, scheme: SchemeData) -> tuple[Station, ...]:
        """Return the stations from left to right."""
        stations: list[Station] = []
        for column in self.order:
            if column >= len(scheme.columns):
                across = scheme.transverse_bodies[column - len(scheme.columns)]
                stations += _apex(column, across, self.turns[column - len(scheme.columns)])
                continue
            left: list[Station] = []
            right: list[Station] = []
            for carrier, at, side in self.arms:
                if at == column:
                    (right if side > 0 else left).append(Station(AxisPart.ARM, column, (), carrier))
            for at, label, side in self.webs:
                if at == column:
                    ring = next(rim for rim in scheme.columns[column] if rim.label == label)
                    station = Station(AxisPart.WEB, column, (ring,), ring.body)
                    (right if side > 0 else left).append(station)
            rims = Station(AxisPart.RIMS, column, scheme.columns[column])
            stations += [*left[::-1], rims, *right]
        return tuple(stations)

    def neighbours(self, scheme: SchemeData) -> Iterator[ColumnOrder]:
        """Yield the orders that differ in one thing."""
        for i, j in combinations(range(len(self.order)), 2):
            for start, end in ((i, j), (j, i)):
                order = list(self.order)
                order.insert(end, order.pop(start))
                yield replace(self, order=tuple(order))
        for k, turn in enumerate(self.turns):
            yield replace(self, turns=(*self.turns[:k], -turn, *self.turns[k + 1 :]))
        for k, (at, label, side) in enumerate(self.webs):
            yield replace(self, webs=_with_item(self.webs, k, (at, label, -side)))
        for k, (carrier, at, side) in enumerate(self.arms):
            for column in _columns_of(scheme, carrier):
                for turned in (side, -side):
                    if (column, turned) != (at, side):
                        yield replace(
                            self, arms=_with_item(self.arms, k, (carrier, column, turned))
                        )


def _apex(column: int, transverse: TransverseBody, turn: int) -> list[Station]:
    """Return the stations of a body across: level wheels on both sides of the apex."""
    stations = [
        Station(AxisPart.RIMS, column, (cone.rim,), offset=cone.side * turn * cone.radius)
        for cone in transverse.cones
    ]
    stations.append(
        Station(AxisPart.APEX, column, (), transverse.carrier or "", transverse=transverse)
    )
    return sorted(stations, key=lambda station: station.offset)


def _with_item(items: tuple, k: int, one: tuple) -> tuple:  # type: ignore[type-arg]
    return (*items[:k], one, *items[k + 1 :])


def _columns_of(scheme: SchemeData, carrier: str) -> list[int]:
    return [
        number
        for number, column in enumerate(scheme.columns)
        if any(scheme.over.get(rim.body) == carrier for rim in column)
    ]


def best_order(scheme: SchemeData) -> ColumnOrder:
    """Return the best order of the stations, by local search from several initial orders."""
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
    best: ColumnOrder | None = None
    costs: dict[ColumnOrder, float] = {}

    def cost(order: ColumnOrder) -> float:
        if order not in costs:
            costs[order] = Arrangement(scheme, order.stations(scheme)).cost
        return costs[order]

    blocks = range(len(columns) + len(scheme.transverse_bodies))
    turns = (1,) * len(scheme.transverse_bodies)
    count = MAX_ORDERS // max(1, len(blocks) - 3) ** 2
    for first, _ in zip(permutations(blocks), range(max(count, 1)), strict=False):
        order = ColumnOrder(first, webs, arms, turns)
        while True:
            better = min(order.neighbours(scheme), key=cost, default=order)
            if cost(better) >= cost(order) - EPS:
                break
            order = better
        if best is None or cost(order) < cost(best) - EPS:
            best = order
    assert best is not None
    return best


def arrange(scheme: SchemeData, order: ColumnOrder | None = None) -> Arrangement:
    """Return the stations of a scheme in an order, in the best one where none is given."""
    return Arrangement(scheme, (order or best_order(scheme)).stations(scheme))
