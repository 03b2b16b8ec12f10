"""JSON of pylinkage: joints of the class ``Linkage``, and joints and links of ``Mechanism``.

Source: ``linkage/serialization.py`` and ``mechanism/serialization.py`` of
github.com/HugoFara/pylinkage.
"""

from __future__ import annotations

import cmath
import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.peers.foreign import (
    MEMBER_LIMIT,
    ForeignBody,
    ForeignDriver,
    ForeignMechanism,
    ForeignSlide,
    finite,
    reject,
)
from planmethod.problem.placement import heading

PLACE_TOLERANCE = 1e-9
"""Relative distance between a place and that by its lengths, above which it is reported."""

_KEYS = {
    "Static": (), "Crank": ("distance", "angle", "omega"), "Fixed": ("distance", "angle"),
    "Revolute": ("distance0", "distance1"), "Prismatic": ("revolute_radius",),
}  # fmt: skip


def is_pylinkage(text: str) -> bool:
    """Return whether a text may be JSON of pylinkage."""
    return text.lstrip()[:1] == "{" and '"joints"' in text


def read_pylinkage(text: str, source: str) -> ForeignMechanism:
    """Read JSON of pylinkage; lengths are in metres unless the caller has another unit.

    Raises
    ------
    ProblemError
        It is not JSON, or a joint is damaged.
    """
    try:
        data = json.loads(text)
    except (ValueError, RecursionError) as error:
        reject(source, "this is not JSON: {}", str(error)[:100])
    joints = data.get("joints") if isinstance(data, dict) else None
    if not isinstance(joints, list) or not all(isinstance(one, dict) for one in joints):
        reject(source, "the file has no list of joints")
    if len(joints) > MEMBER_LIMIT:
        reject(source, "more than {} points or links", MEMBER_LIMIT)
    name = data.get("name")
    title = name[:100] if isinstance(name, str) and name else "pylinkage"
    reader = _Mechanism if "links" in data else _Linkage
    return reader(data, source, title).read()


class _JointReader:
    """Bodies that grow as joints are read."""

    def __init__(self, data: Mapping[str, Any], source: str, title: str) -> None:
        self.data, self.source, self.title = data, source, title
        self.places: dict[str, complex] = {}
        self.fixed: set[str] = set()
        self.rigid_bodies: dict[str, list[str]] = {}
        self.slides: list[ForeignSlide] = []
        self.remarks: list[str] = []
        self.driver = ForeignDriver()

    def common(self, *points: str) -> str | None:
        """Return the body that has all of some points."""
        return next((k for k, own in self.rigid_bodies.items() if {*points} <= {*own}), None)

    def add_bar(self, *points: str) -> str:
        """Add a body; return its name."""
        name = f"{'-'.join(points)}#{len(self.rigid_bodies)}"
        self.rigid_bodies[name] = list(points)
        return name

    def note_unknown(self, name: str, table: Mapping[str, Any], known: set[str]) -> None:
        """Note the keys of a joint or link that are not read."""
        other = [key for key in table if key not in known]
        if other:
            keys = ", ".join(str(key)[:40] for key in other)
            self.remarks.append(translate("{}: {} is not read", name, keys))

    def mechanism(self) -> ForeignMechanism:
        """Return the mechanism."""
        return ForeignMechanism(
            program="pylinkage",
            title=self.title,
            unit="m",
            points=self.places,
            fixed=frozenset(self.fixed),
            rigid_bodies=tuple(ForeignBody(k, tuple(own)) for k, own in self.rigid_bodies.items()),
            slides=tuple(self.slides),
            driver=self.driver,
            remarks=tuple(self.remarks),
        )


class _Linkage(_JointReader):
    """Joints that are built one after the other."""

    def read(self) -> ForeignMechanism:
        """Read the joints in an order in which each follows the ones it is built on."""
        self.note_unknown("pylinkage", self.data, {"name", "joints", "solve_order"})
        left: list[tuple[str, Mapping[str, Any]]] = []
        for table in self.data["joints"]:
            name = table.get("name")
            if not isinstance(name, str) or not name:
                reject(self.source, "a joint has no name")
            if name in [one for one, _ in left]:
                reject(self.source, "joint {} is there twice", name)
            left.append((name, table))
        while left:
            ready = [one for one in left if self._is_ready(one[1])]
            if not ready:
                names = ", ".join(name for name, _ in left)
                reject(self.source, "joints {} are built on joints that are not there", names)
            for one in ready:
                left.remove(one)
                self._joint(*one)
        return self.mechanism()

    def _is_ready(self, table: Mapping[str, Any]) -> bool:
        for key in ("joint0", "joint1", "joint2"):
            ref = table.get(key)
            if not isinstance(ref, dict) or ref.get("inline"):
                continue
            if str(ref.get("ref")) not in self.places:
                return False
        return True

    def _parents(self, name: str, table: Mapping[str, Any], count: int) -> Iterator[str]:
        for k in range(count):
            ref = table.get(f"joint{k}")
            if not isinstance(ref, dict):
                reject(self.source, "joint {} has no joint{}", name, k)
            if not ref.get("inline"):
                yield str(ref.get("ref"))
                continue
            own = ref.get("name")
            own = own if isinstance(own, str) and own else f"{name}.{k}"
            if own not in self.places:
                self.places[own] = self._place(own, ref)
                self.fixed.add(own)
            yield own

    def _place(self, name: str, table: Mapping[str, Any]) -> complex:
        return complex(*(finite(self.source, table.get(a), f"{name}.{a}") for a in "xy"))

    def _joint(self, name: str, table: Mapping[str, Any]) -> None:
        kind = str(table.get("type")).replace("Linear", "Prismatic")
        if kind not in _KEYS:
            message = "joint {} has the type {!r}, which is not read"
            reject(self.source, message, name, kind[:40])
        refs = {"joint0", "joint1", "joint2"}
        self.note_unknown(name, table, {"type", "name", "x", "y", *_KEYS[kind], *refs})
        near = self._place(name, table)
        size = {
            key: finite(self.source, table[key], f"{name}.{key}")
            for key in _KEYS[kind]
            if table.get(key) is not None
        }
        getattr(self, f"_{kind.lower()}")(name, table, near, size)
        off = abs(self.places[name] - near)
        if off > PLACE_TOLERANCE * max(1.0, abs(near)):
            message = "{} is {:.3g} away from its place in the file, as its lengths require"
            self.remarks.append(translate(message, name, off))

    def _static(self, name: str, _: Any, near: complex, __: Any) -> None:
        self.places[name] = near
        self.fixed.add(name)

    def _crank(self, name: str, table: Any, near: complex, size: dict[str, float]) -> None:
        (centre,) = self._parents(name, table, 1)
        if self.driver.body:
            reject(self.source, "two cranks: planmethod needs one")
        z, r = self.places[centre], size.get("distance", abs(near - self.places[centre]))
        self.places[name] = z + cmath.rect(r, cmath.phase(near - z))
        omega = size.get("omega")
        if omega is None and "angle" in size:
            omega = size["angle"]
            self.remarks.append(translate("the step of the crank, {} rad, is read as 1/s", omega))
        self.driver = ForeignDriver(self.add_bar(centre, name), omega=omega)

    def _fixed(self, name: str, table: Any, near: complex, size: dict[str, float]) -> None:
        one, two = self._parents(name, table, 2)
        z, w = self.places[one], self.places[two]
        r = size.get("distance", abs(near - z))
        angle = size.get("angle", cmath.phase((near - z) / (w - z)) if w != z else 0.0)
        self.places[name] = z + cmath.rect(r, cmath.phase(w - z) + angle)
        if {one, two} <= self.fixed:
            self.fixed.add(name)
            return
        body = self.common(one, two)
        if body is None:
            reject(self.source, "{} is fixed to {} and {}, which no link joins", name, one, two)
        self.rigid_bodies[body].append(name)

    def _revolute(self, name: str, table: Any, near: complex, size: dict[str, float]) -> None:
        one, two = self._parents(name, table, 2)
        z, w = self.places[one], self.places[two]
        r, s = size.get("distance0", abs(near - z)), size.get("distance1", abs(near - w))
        self.places[name] = self._nearest(name, near, [*_arcs(z, r, w, s)])
        body = self.common(one, two)
        if {one, two} <= self.fixed:
            self.fixed.add(name)
        elif body is not None:
            self.rigid_bodies[body].append(name)
        else:
            self.add_bar(one, name)
            self.add_bar(two, name)

    def _prismatic(self, name: str, table: Any, near: complex, size: dict[str, float]) -> None:
        centre, one, two = self._parents(name, table, 3)
        z, base, end = (self.places[p] for p in (centre, one, two))
        if base == end:
            reject(self.source, "the line of {} has no direction", name)
        r = size.get("revolute_radius", abs(near - z))
        self.places[name] = self._nearest(name, near, [*_on_line(z, r, base, end - base)])
        self.add_bar(centre, name)
        host = "" if {one, two} <= self.fixed else self.common(one, two)
        if host is None:
            reject(self.source, "{} slides on {} and {}, which no link joins", name, one, two)
        self.slides.append(ForeignSlide(name, host=host, guide_points=(one, two)))

    def _nearest(self, name: str, near: complex, places: list[complex]) -> complex:
        if not places:
            reject(
                self.source, "{} cannot be placed: its lengths do not meet", name,
                hint="Build the linkage in pylinkage first, and save it again.",
            )  # fmt: skip
        return min(places, key=lambda place: abs(place - near))


class _Mechanism(_JointReader):
    """Joints with places, and links that join them."""

    def read(self) -> ForeignMechanism:
        """Read the joints, the links and the driver."""
        self.note_unknown("pylinkage", self.data, {"name", "joints", "links", "ground"})
        joints: dict[str, Mapping[str, Any]] = {}
        for table in self.data["joints"]:
            key = table.get("id")
            if not isinstance(key, str) or not key or key in joints:
                reject(self.source, "a joint has no id of its own")
            place = table.get("position")
            if not isinstance(place, list) or len(place) != 2:
                reject(self.source, "joint {} has no position", key)
            joints[key] = table
            self.places[key] = complex(*(finite(self.source, x, f"{key}.position") for x in place))
            kind = str(table.get("type", "revolute"))
            if kind not in ("ground", "revolute", "prismatic", "tracker"):
                message = "joint {} has the type {!r}, which is not read"
                reject(self.source, message, key, kind[:40])
            if kind == "ground":
                self.fixed.add(key)
            known = {"id", "type", "position", "name", "axis", "slide_distance"}
            known |= {"ref_joint1_id", "ref_joint2_id", "distance", "angle"}
            self.note_unknown(key, table, known)
        self._links(joints)
        for key, table in joints.items():
            if table.get("type") == "tracker":
                self._tracker(key, table)
        self._join_triangles()
        return self.mechanism()

    def _links(self, joints: Mapping[str, Mapping[str, Any]]) -> None:
        links = self.data["links"]
        if not isinstance(links, list) or len(links) > MEMBER_LIMIT:
            reject(self.source, "the file has no list of links")
        sliding = {key for key, one in joints.items() if one.get("type") == "prismatic"}
        guided: set[str] = set()
        for table in links:
            ids = table.get("joints") if isinstance(table, dict) else None
            name = str(table.get("id", ""))[:100] if isinstance(table, dict) else ""
            if not isinstance(ids, list) or not all(isinstance(one, str) for one in ids):
                reject(self.source, "link {} has no joints", name)
            missing = [one for one in ids if one not in joints]
            if missing:
                reject(self.source, "link {} names joint {}, which is not there", name, missing[0])
            if table.get("type") == "ground":
                self.fixed.update(one for one in ids if one not in sliding)
                continue
            pins = [one for one in ids if one in sliding]
            others = [one for one in ids if one not in sliding]
            apart = [one["joints"] for one in links if one is not table and _has_joints(one)]
            held = {*others} <= self.fixed or any(all(p in own for p in others) for own in apart)
            if held and len(others) > 1 and len(pins) == 1 and self._is_on_line(pins[0], others):
                guided.add(pins[0])
                self._slide(pins[0], others)
                continue
            if name in self.rigid_bodies:
                reject(self.source, "link {} is there twice", name)
            self.rigid_bodies[name] = list(dict.fromkeys(ids))
            self._drive(name, table)
        self.slides = [
            replace(s, host=self.common(*s.guide_points) or "") if s.host else s
            for s in self.slides
        ]
        for pin in sliding - guided:
            axis = joints[pin].get("axis", [1.0, 0.0])
            if not isinstance(axis, list) or len(axis) != 2:
                reject(self.source, "joint {} has no axis", pin)
            way = complex(*(finite(self.source, x, f"{pin}.axis") for x in axis))
            self.slides.append(ForeignSlide(pin, angle=heading(way)))

    def _is_on_line(self, pin: str, guide_joints: list[str]) -> bool:
        """Return whether a slider is on the line of two joints of its guide."""
        one, two = (self.places[p] for p in guide_joints[:2])
        return one != two and abs(((self.places[pin] - one) / (two - one)).imag) < 1e-6

    def _slide(self, pin: str, guide_joints: list[str]) -> None:
        along = (guide_joints[0], guide_joints[1])
        fixed = {*along} <= self.fixed
        self.slides.append(ForeignSlide(pin, host="" if fixed else "?", guide_points=along))

    def _drive(self, name: str, table: Mapping[str, Any]) -> None:
        known = {"id", "type", "joints", "name", "angular_velocity", "initial_angle", "motor_joint"}
        self.note_unknown(name, table, known)
        if table.get("type") not in ("driver", "arc_driver"):
            return
        if self.driver.body:
            reject(self.source, "two drivers: planmethod needs one")
        omega = finite(self.source, table.get("angular_velocity", 0.1), f"{name}.angular_velocity")
        self.driver = ForeignDriver(name, omega=omega)

    def _tracker(self, key: str, table: Mapping[str, Any]) -> None:
        refs = [str(table.get(f"ref_joint{k}_id")) for k in (1, 2)]
        body = self.common(*refs)
        if body is None:
            self.remarks.append(translate("{} traces joints that no link joins: not read", key))
        elif key not in self.rigid_bodies[body]:
            self.rigid_bodies[body].append(key)

    def _join_triangles(self) -> None:
        """Make bars that hold a point to one body a part of that body."""
        for point in self.places:
            bars = [k for k, own in self.rigid_bodies.items() if point in own and len(own) == 2]
            if len(bars) != 2 or self.driver.body in bars or self.common(point) not in bars:
                continue
            if any(point in own for k, own in self.rigid_bodies.items() if k not in bars):
                continue
            ends = [next(p for p in self.rigid_bodies[k] if p != point) for k in bars]
            body = next(
                (k for k, own in self.rigid_bodies.items() if k not in bars and {*ends} <= {*own}),
                None,
            )
            if body is not None and ends[0] != ends[1]:
                self.rigid_bodies[body].append(point)
                for bar in bars:
                    del self.rigid_bodies[bar]


def _has_joints(link: Any) -> bool:
    return isinstance(link, dict) and isinstance(link.get("joints"), list)


def _arcs(z: complex, r: float, w: complex, s: float) -> Iterator[complex]:
    """Yield the intersections of two circles."""
    d = abs(w - z)
    if not d or d > (r + s) * (1 + 1e-9) or d < abs(r - s) * (1 - 1e-9):
        return
    x = (d * d + r * r - s * s) / (2 * d)
    y = math.sqrt(max(0.0, r * r - x * x))
    for sign in (1.0, -1.0):
        yield z + complex(x, sign * y) * (w - z) / d


def _on_line(z: complex, r: float, base: complex, direction: complex) -> Iterator[complex]:
    """Yield the intersections of a circle and a line."""
    unit = direction / abs(direction)
    foot = base + ((z - base) / unit).real * unit
    off = abs(foot - z)
    if off <= r * (1 + 1e-9):
        half = math.sqrt(max(0.0, r * r - off * off))
        yield foot + half * unit
        yield foot - half * unit
