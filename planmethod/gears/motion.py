"""Speeds of all bodies from the mesh equations, and the velocity diagrams, exact."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from enum import Enum
from fractions import Fraction

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.scale import rounded, series_near
from planmethod.errors import Fault, PlanMethodError, ProblemError
from planmethod.gears.axes import LinearSolution, Row, TrainDimensions, find_axes, solve
from planmethod.gears.model import (
    FLEXIBLE,
    PARALLEL,
    DiagramSettings,
    GearProblem,
    Mesh,
    MeshKind,
    Roles,
    Train,
    find_roles,
)
from planmethod.languages import translate


class TrainKind(Enum):
    """Type of a gear train (вид зубчатого механизма)."""

    ORDINARY = "ordinary"
    PLANETARY = "planetary"
    DIFFERENTIAL = "differential"
    CLOSED = "closed differential"


class Mobility(Struct, frozen=True):
    """Mobility of a train, counted with one planet of each set (структура).

    Attributes
    ----------
    moving, lower, higher : int
        Moving bodies, lower and higher pairs; a belt or a chain couples as a higher pair does.
    mobility : int
        Free speeds that the mesh equations leave.
    is_spatial : bool
        Axes are not parallel: bevel wheels or a worm.
    """

    kind: TrainKind
    moving: int
    lower: int
    higher: int
    mobility: int
    is_spatial: bool = False

    @property
    def formula(self) -> int:
        """W by the formula of Chebyshev; as many as by Somov and Malyshev with teeth at a point."""
        return 3 * self.moving - 2 * self.lower - self.higher

    @property
    def redundant(self) -> int:
        """Constraints that repeat others in the plane: mobility less that formula."""
        return self.mobility - self.formula

    @property
    def spatial(self) -> int:
        """Constraints that repeat others in space, teeth touching along lines."""
        return self.mobility - (6 * self.moving - 5 * self.lower - 2 * self.higher)


class TrainMotion(Struct, frozen=True):
    """A solved train (решённый механизм).

    Attributes
    ----------
    speeds : mapping
        By body, in the unit of the inputs; of a rack its speed in sizes per turn unit.
    """

    train: Train
    roles: Roles
    axes: TrainDimensions
    structure: Mobility
    speeds: Mapping[str, Fraction]

    def speed(self, label: str, carrier: str | None = None) -> Fraction:
        """Return the speed of a label's body, or its speed relative to a carrier."""
        body = self.train.body_of[label]
        if carrier is None or body in self.roles.transverse:
            return self.speeds[body]
        return self.speeds[body] - self.speeds[self.train.body_of[carrier]]

    def has_sign(self, one: str, other: str) -> bool:
        """Return whether the ratio of two bodies has a sign: angular velocities are parallel.

        Axes are parallel along meshes of parallel axes, belts and chains, and where they coincide.
        A bevel mesh turns by a right angle; two of them lead back to the main direction, that of
        the plane in which a scheme is drawn and senses are given. The effect of a worm is unknown:
        its wheel's axis crosses its own, in any direction.
        """
        levels = _levels(self)
        first, second = (levels[self.train.body_of[label]] for label in (one, other))
        return first == second or (first[0] == second[0] and not first[1] and not second[1])


def _levels(motion: TrainMotion) -> dict[str, tuple[int, int, int]]:
    """Return of every body its part of the train, bevel meshes from its main axis, its level.

    Bodies of one part are joined without worms; the number of bevel meshes is 0 or 1, as two turn
    back; bodies of one level are joined without bevel meshes.
    """
    train, axis = motion.train, motion.axes.axis_of
    joined = [(*train.ends(m), m.kind is MeshKind.BEVEL) for m in train.meshes
              if m.kind in (*PARALLEL, *FLEXIBLE, MeshKind.BEVEL)]  # fmt: skip
    joined += [(one, other, False) for one in train.bodies for other in train.bodies
               if axis[one] == axis[other]]  # fmt: skip
    found: dict[str, tuple[int, int, int]] = {}
    main = sorted(train.bodies, key=lambda body: motion.axes.heights.get(body, 1) != 0)
    level = 0
    for part, start in enumerate(main):
        if start in found:
            continue
        found[start] = (part, int(start in motion.roles.transverse), level)
        todo = [start]
        while todo:  # a level is gone through before the next one begins
            body = next((b for b in todo if found[b][2] == level), todo[0])
            todo.remove(body)
            for one, other, turned in joined:
                for near, far in ((one, other), (other, one)):
                    if near == body and far not in found:
                        level += turned
                        told = found[body][1] ^ turned, level if turned else found[body][2]
                        found[far] = (part, *told)
                        todo.append(far)
        level += 1
    return found


def analyse(problem: GearProblem) -> tuple[Roles, TrainDimensions, Mobility]:
    """Find roles, axes and mobility of a train, without regard to its inputs.

    Raises
    ------
    ProblemError
        The train is not coaxial, teeth are not whole, or nothing can move.
    """
    train = problem.train
    roles, faults = find_roles(train)
    axes, more = (None, []) if faults else find_axes(train, roles)
    if axes is None:
        raise ProblemError(problem.source_file, [*faults, *more])
    moving = [body for body in train.bodies if body not in train.fixed]
    rank = solve(moving, _loose(train, rows_of(train, roles, axes))).rank
    mobility = len(moving) - rank
    if mobility < 1:
        text = translate(
            "the train cannot move: {} moving bodies, {} independent meshes", len(moving), rank
        )
        raise ProblemError(problem.source_file, [Fault("gears.fixed", text, "Free a body.")])
    structure = Mobility(
        _kind(train, roles, mobility), len(moving), len(moving), len(train.meshes), mobility,
        any(mesh.kind in (MeshKind.BEVEL, MeshKind.WORM) for mesh in train.meshes),
    )  # fmt: skip
    return roles, axes, structure


def solve_motion(problem: GearProblem) -> TrainMotion:
    """Find the speed of every body.

    Raises
    ------
    ProblemError
        As `analyse`, and where inputs are too few, too many, or contradict each other.
    """
    roles, axes, structure = analyse(problem)
    train = problem.train
    given = {body: speed for body, speed in train.inputs.items() if body not in train.fixed}
    path, count = f"gears.{train.unit}", structure.mobility
    if len(given) > count:
        text = translate("over-determined: W = {}, and {} speeds are given", count, len(given))
        raise ProblemError(problem.source_file, [Fault(path, text, translate("Keep {}.", count))])
    found = speeds_by(train, rows_of(train, roles, axes))
    if not found.consistent:
        text = "over-determined: the speeds given contradict each other"
        raise ProblemError(problem.source_file, [Fault(path, text, "Give others.")])
    if found.free:
        text = "undetermined: W = {}, and {} speeds are given; the speed of {} does not follow"
        text = translate(text, count, len(given), found.free[0])
        hint = "If you need only ratios, give one wheel the speed 1: n = { 1 = 1 }."
        raise ProblemError(problem.source_file, [Fault(path, text, hint)])
    return TrainMotion(train, roles, axes, structure, found.values)


def speeds_by(train: Train, rows: Sequence[Mapping[str, Fraction]]) -> LinearSolution[str]:
    """Solve equations of the meshes for the speeds of all bodies; those of fixed ones are 0."""
    moving = [body for body in train.bodies if body not in train.fixed]
    given = [({b: Fraction(1)}, v) for b, v in train.inputs.items() if b not in train.fixed]
    found = solve(moving, [*_loose(train, rows), *given])
    return replace(found, values={**found.values, **dict.fromkeys(train.fixed, Fraction(0))})


def mesh_row(train: Train, roles: Roles, axes: TrainDimensions, mesh: Mesh) -> dict[str, Fraction]:
    """Return the coefficients of the speeds in the equation of a mesh, seen from its carrier.

    ``(w_a - w_c) z_a + (w_b - w_c) z_b = 0`` for an external mesh.
    """
    one, other = train.ends(mesh)
    rack = mesh.kind is MeshKind.RACK
    first = axes.radii[mesh.first] if rack else axes.sizes[mesh.first]
    second = Fraction(1) if rack else axes.sizes[mesh.second]
    sign = {MeshKind.EXTERNAL: 1, MeshKind.CROSSED: 1, MeshKind.BEVEL: 0}.get(mesh.kind, -1)
    if mesh.kind is MeshKind.WORM and mesh.left:
        sign = 1
    if mesh.kind is MeshKind.BEVEL:
        sign = -roles.senses[mesh]
    row = {one: first, other: sign * second}
    carrier = train.carrier(mesh)
    if carrier is not None:
        own = sum((row[body] for body in (one, other) if body not in roles.transverse), Fraction(0))
        row[carrier] = row.get(carrier, Fraction(0)) - own
    return row


def rows_of(train: Train, roles: Roles, axes: TrainDimensions) -> list[dict[str, Fraction]]:
    """Return the equations of the meshes, in their order."""
    return [mesh_row(train, roles, axes, mesh) for mesh in train.meshes]


def _loose(train: Train, rows: Iterable[Mapping[str, Fraction]]) -> list[Row[str]]:
    """Return equations in the speeds of the moving bodies."""
    fixed, nothing = train.fixed, Fraction(0)
    return [({b: v for b, v in row.items() if b not in fixed}, nothing) for row in rows]


def _kind(train: Train, roles: Roles, mobility: int) -> TrainKind:
    """Return the kind as in the textbook, by fixed central wheels, W and closing meshes."""
    turning = [carrier for carrier in train.carriers if carrier not in train.fixed]
    if not turning:
        return TrainKind.ORDINARY
    if mobility > 1:
        return TrainKind.DIFFERENTIAL
    held = [any(body in train.fixed for body in roles.central[c]) for c in turning]
    return TrainKind.PLANETARY if all(held) else TrainKind.CLOSED


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


def why_not_drawn(motion: TrainMotion) -> str:
    """Return the reason that a train has no diagrams, a key of the catalogues."""
    kinds = {mesh.kind for mesh in motion.train.meshes}
    bodies = {body for mesh in motion.train.meshes for body in motion.train.ends(mesh)}
    if kinds & {MeshKind.BEVEL, MeshKind.WORM}:
        return "crossing"
    if MeshKind.RACK in kinds:
        return "rack"
    flexible = bool(kinds & {*FLEXIBLE})
    return "distances" if flexible or not bodies <= set(motion.axes.heights) else "rest"


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


class TabularMotion(Struct, frozen=True):
    """The table of one carrier (таблица вращений).

    Attributes
    ----------
    carrier : str
    started : tuple of str
        Bodies that are turned while the carrier is held; the others follow by the stages.
    locked_speeds, held_speeds : mapping
        By body: speeds of the locked train, and those with the carrier held. Their sum is the
        speed; of a body across the main axis that is its own turning, with the carrier it has none.
    """

    carrier: str
    started: tuple[str, ...]
    locked_speeds: Mapping[str, Fraction]
    held_speeds: Mapping[str, Fraction]


def tabular(motion: TrainMotion) -> tuple[TabularMotion, ...]:
    """Make the tables of all carriers that may turn, and compare their sums with the speeds.

    Raises
    ------
    PlanMethodError
        A sum differs from the speed that the mesh equations give: an internal error.
    """
    return tuple(
        _tabular_motion(motion, carrier)
        for carrier in motion.train.carriers
        if carrier not in motion.train.fixed
    )


def _tabular_motion(motion: TrainMotion, carrier: str) -> TabularMotion:
    train, roles = motion.train, motion.roles
    central = roles.central[carrier]
    bodies = (*central, *roles.planets[carrier])
    locked = motion.speeds[carrier]
    together = {b: Fraction(0) if b in roles.transverse else locked for b in bodies}
    sources = sorted(bodies, key=lambda b: (b not in train.fixed, b not in train.inputs))
    held: dict[str, Fraction] = {}
    started = []
    for source in sources:
        if source in held:
            continue
        started.append(source)
        held[source] = motion.speeds[source] - together[source]
        for _ in train.meshes:
            _follow(motion, carrier, held)
    for body in bodies:
        if together[body] + held[body] != motion.speeds[body]:
            raise PlanMethodError(
                "the tabular method gives {} the speed {}, the mesh equations {}; please "
                "report the problem file",
                body,
                together[body] + held[body],
                motion.speeds[body],
            )
    return TabularMotion(
        carrier, tuple(started), {carrier: locked} | together, {carrier: Fraction(0)} | held
    )


def _follow(motion: TrainMotion, carrier: str, held_speeds: dict[str, Fraction]) -> None:
    """Propagate the rotation through each mesh that has one end known already."""
    train = motion.train
    for mesh in train.meshes:
        if train.carrier(mesh) != carrier:
            continue
        row = mesh_row(train, motion.roles, motion.axes, mesh)
        for near, far in (train.ends(mesh), train.ends(mesh)[::-1]):
            if near in held_speeds and far not in held_speeds:
                held_speeds[far] = -held_speeds[near] * row[near] / row[far]
