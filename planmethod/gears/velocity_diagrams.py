"""Velocity diagrams: contact points and rays, exact (картины скоростей).

Heights are from the main axis upwards, segments are positive to the right: v_x = -omega y. The ray
of a body is parallel to its line, at the pole distance from which segments of speeds are read.
"""

from __future__ import annotations

from enum import Enum
from fractions import Fraction

from msgspec import Struct

from planmethod.construct.scale import rounded, series_near
from planmethod.gears.model import PARALLEL, DiagramSettings, Mesh, MeshKind, Train
from planmethod.gears.motion import TrainMotion


class ContactKind(Enum):
    """Kind of a point of the linear velocity diagram."""

    PITCH = "pitch"
    AXIS = "axis"


class ContactPoint(Struct, frozen=True):
    """The pitch point of a mesh, or a point of the axis of a body (полюс зацепления, ось).

    ``of`` is the name of the mesh, or the body.
    """

    kind: ContactKind
    of: str

    @property
    def name(self) -> str:
        """Name in JSON: ``pitch 1-2``."""
        return f"{self.kind.value} {self.of}"


class DiagramPoint(Struct, frozen=True):
    """A point of the linear velocity diagram (точка картины): its height and segment, mm."""

    at: ContactPoint
    height_mm: Fraction
    speed_mm: Fraction


class VelocityDiagrams(Struct, frozen=True):
    """Both velocity diagrams (картины линейных и угловых скоростей).

    Attributes
    ----------
    mu_l : Fraction, m/mm
    speed_per_mm : Fraction
        Speed times height of a millimetre: unit of the speeds times metre.
    rate : float, 1/s
        A unit of the speeds.
    rays : tuple of (label, segment)
        Positive for bodies that turn counter-clockwise.
    """

    mu_l: Fraction
    pole_mm: Fraction
    speed_per_mm: Fraction
    contacts: tuple[DiagramPoint, ...]
    rays: tuple[tuple[str, Fraction], ...]
    rate: float = 1.0

    @property
    def mu_v(self) -> float:
        """Scale of the linear velocities, (m/s)/mm."""
        return rounded(float(self.speed_per_mm) * self.rate)

    @property
    def mu_omega(self) -> float:
        """Scale of the angular velocities, (1/s)/mm."""
        return rounded(self.mu_v / float(self.mu_l * self.pole_mm))

    def ray_scale(self, unit: str) -> tuple[str, float]:
        """Return the scale of the rays by the unit of the speeds: its name, and units per mm."""
        if unit == "n":
            return "mu_n", rounded(float(self.turn_per_mm))
        return "mu_omega", self.mu_omega

    @property
    def turn_per_mm(self) -> Fraction:
        """Speed of a body, in the unit of the inputs, per millimetre of its ray."""
        return self.speed_per_mm / (self.mu_l * self.pole_mm)


def draw(motion: TrainMotion, settings: DiagramSettings | None = None) -> VelocityDiagrams | None:
    """Return the diagrams; None if axes are not parallel at known distances, or nothing moves.

    ``settings`` are other scales than the file's.
    """
    train, axes = motion.train, motion.axes
    bodies = {body for mesh in train.meshes for body in train.ends(mesh)}
    if any(mesh.kind not in PARALLEL for mesh in train.meshes) or not bodies <= set(axes.heights):
        return None
    settings = settings or train.picture
    points: list[tuple[ContactPoint, Fraction, Fraction]] = []
    for mesh in train.meshes:
        one = train.ends(mesh)[0]
        height = axes.heights[one] + _to_pole(motion, mesh)
        pitch = ContactPoint(ContactKind.PITCH, mesh.name)
        points.append((pitch, height, _at(motion, one, height)))
    for body, height in axes.heights.items():
        if height and body in bodies:
            speed = _of_axis(motion, body)
            points.append((ContactPoint(ContactKind.AXIS, body), height, speed))
    most = max(abs(speed) for _, _, speed in points)
    if not most:
        return None
    mm = train.unit_m / settings.mu_l
    per_mm = _round_speed(train, most / settings.longest_mm)
    scale = train.unit_m / per_mm
    pole = settings.pole_mm or _round_pole(train, per_mm / settings.mu_l, settings.near_mm)
    contacts = tuple(DiagramPoint(at, height * mm, speed * scale) for at, height, speed in points)
    per = pole * scale / mm
    rays = tuple((label, motion.speed(label) * per) for label in train.numbers)
    return VelocityDiagrams(settings.mu_l, pole, per_mm, contacts, rays, train.rate)


def _to_pole(motion: TrainMotion, mesh: Mesh) -> Fraction:
    """Return the height of the pitch point of a mesh above the axis of its first wheel.

    It divides the centre distance in proportion to the teeth, whatever the shifts.
    """
    axes = motion.axes
    one, other = motion.train.ends(mesh)
    far, (first, second) = axes.heights[other] - axes.heights[one], (
        axes.sizes[mesh.first], axes.sizes[mesh.second]
    )  # fmt: skip
    return far * first / (first + (second if mesh.kind is MeshKind.EXTERNAL else -second))


def _round_speed(train: Train, lower_bound: Fraction) -> Fraction:
    """Return the speed of a millimetre, unit of the speeds times metre: round in m/s.

    ``lower_bound`` is the least that it may be, sizes in place of metres.
    """
    mu_v = series_near(float(lower_bound * train.unit_m) * train.rate, up=True)
    return Fraction(repr(mu_v)) / Fraction(train.rate)


def _round_pole(train: Train, per_mm: Fraction, pole_mm: Fraction) -> Fraction:
    """Return the pole distance at which the scale of the rays is round, mm.

    ``per_mm`` is the speed per millimetre of a ray at a pole distance of one. The scale is
    round in the unit of the speeds, and as close as possible to that of the distance ``pole_mm``.
    """
    wanted = float(per_mm / pole_mm)
    round_ones = (series_near(wanted, up=up) for up in (True, False))
    best = min(round_ones, key=lambda one: max(one / wanted, wanted / one))
    return per_mm / Fraction(repr(best))


def _at(motion: TrainMotion, body: str, height: Fraction) -> Fraction:
    """Return the speed to the right of a body's point at a height of the line of centres."""
    centre = motion.axes.heights[body]
    return _of_axis(motion, body) - motion.speeds[body] * (height - centre)


def carrier_of(motion: TrainMotion, body: str) -> str | None:
    """Return the body that carries the axis of a body away from its own axis, or None."""
    train, heights = motion.train, motion.axes.heights
    for mesh in train.meshes:
        carrier = train.carrier(mesh)
        if carrier is not None and body in train.ends(mesh) and heights[body] != heights[carrier]:
            return carrier
    return None


def _of_axis(motion: TrainMotion, body: str) -> Fraction:
    """Return the speed to the right of a body's axis: that of its carrier there."""
    heights, carrier = motion.axes.heights, carrier_of(motion, body)
    if carrier is None:
        return Fraction(0)
    return -motion.speeds[carrier] * (heights[body] - heights[carrier])
