"""Content of the scheme of a train: wheels in columns, axes at their heights (данные схемы)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property
from itertools import combinations

from msgspec import Struct
from msgspec.structs import replace

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
