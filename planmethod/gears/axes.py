"""Positions of the axes, and the teeth that coaxiality determines (условие соосности)."""

from __future__ import annotations

import math
from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from typing import Generic, TypeVar

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.errors import Fault
from planmethod.gears.model import PARALLEL, Mesh, MeshKind, Roles, Train
from planmethod.languages import translate
from planmethod.problem.names import listed, segment

N = TypeVar("N", bound=Hashable)

Row = tuple[Mapping[N, Fraction], Fraction]
"""Coefficients by unknown, and the right side."""


class LinearSolution(Struct, Generic[N], frozen=True):
    """Solution of a system of linear equations.

    Attributes
    ----------
    values : mapping
        The unknowns that are determined.
    free : tuple
        The unknowns that are not.
    rank : int
    consistent : bool
        The equations do not contradict each other.
    """

    values: Mapping[N, Fraction]
    free: tuple[N, ...]
    rank: int
    consistent: bool


def solve(unknowns: Sequence[N], rows: Sequence[Row[N]]) -> LinearSolution[N]:
    """Solve equations exactly by elimination."""
    left: list[tuple[dict[N, Fraction], Fraction]] = [
        ({name: value for name, value in row.items() if value}, right) for row, right in rows
    ]
    done: dict[N, tuple[dict[N, Fraction], Fraction]] = {}
    for pivot in unknowns:
        at = next((i for i, (row, _) in enumerate(left) if pivot in row), None)
        if at is None:
            continue
        row, right = left.pop(at)
        scale = row[pivot]
        row, right = {name: value / scale for name, value in row.items()}, right / scale
        left = [_without(other, pivot, row, right) for other in left]
        done = {name: _without(other, pivot, row, right) for name, other in done.items()}
        done[pivot] = (row, right)
    values = {name: right for name, (row, right) in done.items() if len(row) == 1}
    return LinearSolution(
        values,
        tuple(name for name in unknowns if name not in values),
        len(done),
        not any(right for row, right in left if not row),
    )


def _without(
    equation: tuple[dict[N, Fraction], Fraction],
    pivot: N,
    row: dict[N, Fraction],
    right: Fraction,
) -> tuple[dict[N, Fraction], Fraction]:
    """Return an equation without one unknown."""
    mine, value = equation
    factor = mine.get(pivot)
    if factor is None:
        return equation
    merged = {name: mine.get(name, 0) - factor * row.get(name, 0) for name in {**mine, **row}}
    return {name: Fraction(v) for name, v in merged.items() if v}, value - factor * right


MAX_CHOSEN = 10
"""Most meshes in loops between wheels off the main axis: each may be on either side."""

HINT = "Check the teeth, and which wheels share an axis."

COAXIAL_TOLERANCE = Fraction(2, 100)
"""Modules by which paths over shifted wheels may differ and be coaxial: shifts are rounded."""

REPAIRABLE = Fraction(1, 4)
"""Modules by which they may differ and a small additional shift still makes them coaxial."""

ALPHA = math.radians(20)
"""Pressure angle of the standard rack, rad."""


class TrainDimensions(Struct, frozen=True):
    """Sizes of all wheels and heights of all axes that are at known distances (размеры).

    Attributes
    ----------
    sizes : mapping
        By label: teeth or half modules, metres where no wheel has teeth.
    radii : mapping
        Of the pitch circles by label, in half modules of the train (or metres).
    distances : mapping
        Distances of parallel axes by the name of the mesh, in the same unit: those of the pitch
        circles, or of wheels with shifts without backlash.
    shifted : frozenset of str
        Names of the meshes whose shifts alter it.
    heights : mapping
        By body, from the main axis upwards, in half modules (or metres).
    axis_of : mapping
        By body, the body that its axis is called by.
    """

    sizes: Mapping[str, Fraction]
    radii: Mapping[str, Fraction]
    distances: Mapping[str, Fraction]
    shifted: frozenset[str]
    heights: Mapping[str, Fraction]
    axis_of: Mapping[str, str]


class _Lines(Struct):
    """Bodies by the axis that they turn about; the main one is ``main``."""

    line: dict[str, str]
    main: str = ""
    below: set[str] = field(default_factory=set)

    def join(self, bodies: Iterable[str]) -> None:
        taken = {self.line[body] for body in bodies}
        if not taken:
            return
        name = self.main if self.main in taken else min(taken, key=list(self.line).index)
        self.line = {b: name if old in taken else old for b, old in self.line.items()}
        self.main = name if self.main in taken else self.main


def find_axes(train: Train, roles: Roles) -> tuple[TrainDimensions | None, list[Fault]]:
    """Find the heights of the axes and the unknown teeth.

    Unknown sizes and heights follow from one linear equation for each mesh; central wheels and
    their carrier share an axis, and unless the file states otherwise, a train returns to the main
    axis as soon as it can.
    """
    lines = _find_lines(train, roles)
    meshes = [mesh for mesh in train.meshes if mesh.kind in PARALLEL]
    for mesh in meshes:
        one, other = train.ends(mesh)
        if lines.line[one] == lines.line[other]:
            text = translate(
                "{} and {} mesh, and would turn about one axis", mesh.first, mesh.second
            )
            return None, [Fault("gears.meshes", text, HINT)]
    axes, faults = _solve(train, lines, meshes)
    apart = [] if axes is None else _arms(train, roles, axes)
    return (None, apart) if apart else (axes, faults)


def _arms(train: Train, roles: Roles, axes: TrainDimensions) -> list[Fault]:
    """Compare the given radii of carriers with the distances of the axes of their planets."""
    found = []
    for label, radius in train.arms.items():
        carrier = train.body_of[label]
        reached = {
            body: abs(axes.heights[body] - axes.heights[carrier]) * train.unit_m
            for body in roles.planets.get(carrier, ())
            if body in axes.heights and carrier in axes.heights
        }
        path = f"gears.wheels.{segment(label)}.r"
        if train.toothed and train.module is None:
            hint = "Give module = ... (mm), or every wheel by its radius."
            found.append(
                Fault(path, translate("a radius together with teeth needs the module"), hint)
            )
            continue
        slack = 2 * COAXIAL_TOLERANCE * train.unit_m if is_shifted(train) else radius / 1_000_000
        if reached and min(abs(one - radius) for one in reached.values()) > slack:
            body, far = min(reached.items(), key=lambda one: abs(one[1] - radius))
            text = translate(
                "the train is not coaxial: r_{} = {:g} m, and the axis of {} is {:g} m from it by "
                "the wheels", label, float(radius), body, float(far),
            )  # fmt: skip
            found.append(Fault(path, text, HINT))
    return found


def _find_lines(train: Train, roles: Roles) -> _Lines:
    lines = _Lines({body: body for body in train.bodies})
    for carrier, bodies in roles.central.items():
        lines.join([carrier, *bodies])
    for group in (*train.coaxial, *_around_idlers(train)):
        lines.join(group)
    first = train.ends(train.meshes[0])[0]
    lines.main = lines.line[
        next(iter(train.carriers), next((b for b in train.bodies if b in train.inputs), first))
    ]
    around = {body for bodies in roles.planets.values() for body in bodies}
    heights: dict[str, Fraction | None] = {lines.main: Fraction(0)}
    left = [mesh for mesh in train.meshes if mesh.kind in PARALLEL]
    while left:
        mesh = next((m for m in left if any(lines.line[b] in heights for b in train.ends(m))), None)
        if mesh is None:  # another part, reached through belts or bevels
            break
        left.remove(mesh)
        _place(train, lines, heights, mesh, around)
    for body in train.inputs:
        lines.below |= _axes_below(train, lines, body)
    return lines


def _around_idlers(train: Train) -> Iterator[tuple[str, ...]]:
    """Yield what an idler of unknown teeth runs between: a wheel and a ring, of one axis."""
    told = {body for group in train.coaxial for body in group}
    for label in train.unknown:
        body = train.body_of[label]
        meshes = [mesh for mesh in train.meshes if body in train.ends(mesh)]
        kinds = {mesh.kind for mesh in meshes if label in (mesh.first, mesh.second)}
        ends = {b for mesh in meshes for b in train.ends(mesh)}
        if len(meshes) == 2 and kinds == {MeshKind.EXTERNAL, MeshKind.INTERNAL} and not ends & told:
            yield tuple(ends - {body})


def _place(
    train: Train,
    lines: _Lines,
    heights: dict[str, Fraction | None],
    mesh: Mesh,
    around: set[str],
) -> None:
    """Put the second axis of a mesh on the main one where that may be, else beside the first."""
    ends = train.ends(mesh)
    if all(lines.line[body] in heights for body in ends):
        return
    start, new = ends if lines.line[ends[0]] in heights else ends[::-1]
    size, height = _distance(train, mesh), heights[lines.line[start]]
    at_main = lines.line[start] == lines.main
    slack = 2 * COAXIAL_TOLERANCE if is_shifted(train) else 0
    returns = size is None or height is None or abs(abs(height) - size) <= slack
    between = any(
        new in both and other is not mesh and lines.line[start] in {lines.line[b] for b in both}
        for other in train.meshes
        for both in [train.ends(other)]
    )  # an idler between wheels of one axis
    if returns and not at_main and not between and new not in around:
        lines.join([lines.main, new])
        return
    if size is None or height is None:
        heights[lines.line[new]] = None
    else:
        heights[lines.line[new]] = height + size


def is_shifted(train: Train) -> bool:
    """Return whether a wheel of a train is cut with a shift."""
    return train.toothed and any(wheel.shift for wheel in train.wheels.values())


def cannot_mesh(axes: TrainDimensions, mesh: Mesh) -> bool:
    """Return whether wheels with shifts cannot come as close as the centre distance requires."""
    one, other = axes.radii[mesh.first], axes.radii[mesh.second]
    plain = one + other if mesh.kind is MeshKind.EXTERNAL else abs(one - other)
    return mesh.name in axes.shifted and axes.distances[mesh.name] == plain


def _radius(train: Train, label: str) -> Fraction | None:
    size = train.wheels[label].size
    return None if size is None else size * train.module_ratio(label)


def _distance(train: Train, mesh: Mesh) -> Fraction | None:
    """Return the centre distance of a mesh, with the shifts; None while teeth are unknown.

    Wheels that cannot come that close to each other are placed as if they had no shifts.
    """
    one, other = (_radius(train, label) for label in (mesh.first, mesh.second))
    if one is None or other is None:
        return None
    plain = one + other if mesh.kind is MeshKind.EXTERNAL else abs(one - other)
    _, teeth, shifts = _pair(train, mesh)
    if not train.toothed or not shifts or not teeth:
        return plain
    from planmethod.gears.angles import spread

    share = spread(float(teeth), float(shifts), ALPHA)
    return plain if math.isnan(share) else plain * Fraction(share)


def _pair(train: Train, mesh: Mesh) -> tuple[int, Fraction, Fraction]:
    """Return +1 of an external mesh, -1 of an internal one, and the sums or differences.

    Of an internal mesh they are those of the ring less those of the wheel in it.
    """
    way = 1 if mesh.kind is MeshKind.EXTERNAL else -1
    both = [train.wheels[label] for label in (mesh.first, mesh.second)]
    small, large = sorted(both, key=lambda wheel: wheel.size or 0)
    assert small.size is not None and large.size is not None
    return way, large.size + way * small.size, large.shift + way * small.shift


def shift_for(train: Train, mesh: Mesh, distance: Fraction) -> tuple[str, float]:
    """Return the wheel whose shift would set the axes of a mesh so far apart, and that shift.

    Of an internal mesh it is the ring. The distance is in half modules.
    """
    from planmethod.gears.angles import involute

    _, teeth, shifts = _pair(train, mesh)
    large = max((mesh.first, mesh.second), key=lambda label: train.wheels[label].size or 0)
    plain = teeth * train.module_ratio(large)
    cosine = float(plain / distance) * math.cos(ALPHA) if distance else 2.0
    if cosine >= 1:
        return large, math.nan
    grown = float(involute(math.acos(cosine)) - involute(ALPHA)) * float(teeth)
    less = float(shifts - train.wheels[large].shift)
    return large, grown / (2 * math.tan(ALPHA)) - less


def _axes_below(train: Train, lines: _Lines, body: str) -> set[str]:
    """Return the axes of the stages before the main axis: they are drawn below it."""
    if lines.line[body] == lines.main:
        return set()
    found = {lines.line[body]}
    while True:
        more = {
            lines.line[b]
            for mesh in train.meshes
            if mesh.kind in PARALLEL and found & {lines.line[e] for e in train.ends(mesh)}
            for b in train.ends(mesh)
        } - {lines.main}
        if more <= found:
            return found
        found |= more


_OF_COAXIALITY = ("gears.wheels", "gears.unknown")
"""Keys to which faults of coaxiality refer."""

# Equations ---------------------------------------------------------------------------------------


def _solve(
    train: Train, lines: _Lines, meshes: Sequence[Mesh]
) -> tuple[TrainDimensions | None, list[Fault]]:
    beside = [m for m in meshes if lines.main not in {lines.line[b] for b in train.ends(m)}]
    away = _away(train, lines, meshes) if beside else ({}, set())
    likely = {mesh: _likely_side(train, lines, mesh, *away) for mesh in beside}
    chosen = [mesh for mesh in _in_loops(train, lines, meshes) if mesh in likely]
    if len(chosen) > MAX_CHOSEN:
        text = translate(
            "{} meshes in loops off the main axis, the limit is {}", len(chosen), MAX_CHOSEN
        )
        return None, [Fault("gears.meshes", text)]
    unknown = [("z", label) for label in train.unknown]
    reached = dict.fromkeys(lines.line[b] for mesh in meshes for b in train.ends(mesh))
    names = [*unknown, *(("h", name) for name in reached if name != lines.main)]
    best: Fault | None = None
    for turns in product((1, -1), repeat=len(chosen)):
        side = likely | {m: likely[m] * turn for m, turn in zip(chosen, turns, strict=True)}
        rows = [_equation(train, lines, mesh, side.get(mesh)) for mesh in meshes]
        if is_shifted(train) and not unknown:
            rows = _brought_together(names, list(zip(meshes, rows, strict=True)), train)
        found = solve(names, rows)
        fault = _check_solution(train, found, unknown)
        if fault is None:
            axes = _axes(train, lines, found, meshes)
            if unknown and is_shifted(train):  # pitch circles determine teeth, shifts axes
                wheels = {x: replace(w, size=axes.sizes[x]) for x, w in train.wheels.items()}
                return _solve(replace(train, wheels=wheels, unknown=()), lines, meshes)
            fault = _positive(train, axes, meshes)
            if fault is None:
                return axes, []
        best = fault if best is None or best.path in _OF_COAXIALITY else best
    if best is not None and best.path in _OF_COAXIALITY:
        best = _explain_conflict(train, lines, meshes) or best
    return None, [] if best is None else [best]


def _in_loops(train: Train, lines: _Lines, meshes: Sequence[Mesh]) -> list[Mesh]:
    """Return the meshes without those that only lead to an axis without another mesh."""
    left = list(meshes)
    while True:
        ends = [lines.line[b] for mesh in left for b in train.ends(mesh)]
        loose = {name for name in ends if ends.count(name) == 1} - {lines.main}
        kept = [m for m in left if not loose & {lines.line[b] for b in train.ends(m)}]
        if kept == left:
            return left
        left = kept


def _away(train: Train, lines: _Lines, meshes: Sequence[Mesh]) -> tuple[dict[str, int], set[str]]:
    """Return the number of meshes from each axis to the main one, and axes within its rings."""
    steps = {lines.main: 0}
    ringed: set[str] = set()
    before = 0
    while before < len(steps):
        before = len(steps)
        for one in meshes:
            ends = [lines.line[body] for body in train.ends(one)]
            for near, far in (ends, ends[::-1]):
                if near in steps:
                    steps.setdefault(far, steps[near] + 1)
            if one.kind is MeshKind.INTERNAL and lines.main in ends:
                out = train.ends(one)[1 if ends[0] == lines.main else 0]
                if lines.main == lines.line[train.body_of[_ring_label(train, one, out)]]:
                    ringed.add(lines.line[out])
    return steps, ringed


def _likely_side(
    train: Train, lines: _Lines, mesh: Mesh, steps: Mapping[str, int], ringed: Collection[str]
) -> int:
    """Return +1 if the second of two axes beside the main one is more likely the higher.

    The axis with fewer meshes to the main one is the nearer; the other is beyond it, or within
    where only the nearer one runs in a ring.
    """
    first, second = (lines.line[body] for body in train.ends(mesh))
    near, far, side = first, second, 1
    if steps.get(second, 0) < steps.get(first, 0):
        near, far, side = second, first, -1
    if near in lines.below:
        side = -side
    return -side if near in ringed and far not in ringed else side


def _equation(train: Train, lines: _Lines, mesh: Mesh, side: int | None) -> Row[tuple[str, str]]:
    """Return the height of the second axis over the first: the sum or difference of the sizes."""
    one, other = train.ends(mesh)
    coefficients: dict[tuple[str, str], Fraction] = {}
    right = Fraction(0)
    for body, sign in ((one, -1), (other, 1)):
        if lines.line[body] != lines.main:
            key = ("h", lines.line[body])
            coefficients[key] = coefficients.get(key, Fraction(0)) + sign
    if side is None:  # the axis off the main one is above it, or below
        up = one if lines.line[other] == lines.main else other
        side = -1 if lines.line[up] in lines.below else 1
        side = side if up == other else -side
        out = up
    else:
        out = other
    if not train.unknown and (apart := _distance(train, mesh)) is not None:
        return coefficients, side * apart
    for label in (mesh.first, mesh.second):  # by the pitch circles, which are linear in the teeth
        sign = side
        if mesh.kind is MeshKind.INTERNAL and label != _ring_label(train, mesh, out):
            sign = -side
        size = _radius(train, label)
        if size is None:
            factor = coefficients.get(("z", label), Fraction(0))
            coefficients["z", label] = factor - sign * train.module_ratio(label)
        else:
            right += sign * size
    return coefficients, right


def _brought_together(
    names: Sequence[tuple[str, str]],
    rows: list[tuple[Mesh, Row[tuple[str, str]]]],
    train: Train,
) -> list[Row[tuple[str, str]]]:
    """Return equations of heights in which paths that nearly meet at an axis meet exactly.

    Shifts are rounded, so two paths over shifted wheels to one axis differ slightly. The first
    path determines the height: meshes without shifts, then the others in file order.
    """
    done = [row for mesh, row in rows if not _pair(train, mesh)[2]]
    left = [row for mesh, row in rows if _pair(train, mesh)[2]]
    while left:
        values = solve(names, done).values
        at = next((k for k, (row, _) in enumerate(left) if not row.keys() - values.keys()), None)
        if at is None:
            known = (k for k, (row, _) in enumerate(left) if len(row.keys() - values.keys()) == 1)
            done.append(left.pop(next(known, 0)))
            continue
        row, right = left.pop(at)
        reached = sum((factor * values[name] for name, factor in row.items()), Fraction(0))
        done.append((row, reached if abs(reached - right) <= 2 * REPAIRABLE else right))
    return done


def _ring_label(train: Train, mesh: Mesh, out: str) -> str:
    """Return the wheel with internal teeth: the larger, or where that is unknown the central."""
    one, other = (train.wheels[label].size for label in (mesh.first, mesh.second))
    if one is not None and other is not None:
        return mesh.first if one > other else mesh.second
    return mesh.first if train.ends(mesh)[1] == out else mesh.second


def _check_solution(
    train: Train, solution: LinearSolution[tuple[str, str]], unknown: Sequence[tuple[str, str]]
) -> Fault | None:
    if not solution.consistent:
        return Fault("gears.wheels", "the train is not coaxial", HINT)
    free = [label for kind, label in unknown if (kind, label) not in solution.values]
    if free:
        text = translate("coaxiality does not determine the teeth of {}", listed(free))
        hint = 'Name the wheel that it is coaxial with: coaxial = [["1","3"]].'
        return Fault("gears.unknown", text, "Give the teeth of one of them." if free[1:] else hint)
    for kind, label in unknown:
        value = solution.values[kind, label]
        if value <= 0:
            text = translate("coaxiality gives wheel {} the size {}", label, value)
            return Fault("gears.unknown", text, HINT)
        if train.toothed and value.denominator != 1:
            text = translate(
                "coaxiality gives wheel {} {} = {:g} teeth, not whole", label, value, float(value)
            )
            return Fault("gears.unknown", text, HINT)
    return None


def _axes(
    train: Train,
    lines: _Lines,
    solution: LinearSolution[tuple[str, str]],
    meshes: Sequence[Mesh],
) -> TrainDimensions:
    sizes: dict[str, Fraction] = {}
    for label, wheel in train.wheels.items():
        sizes[label] = solution.values["z", label] if wheel.size is None else wheel.size
    wheels = {label: replace(wheel, size=sizes[label]) for label, wheel in train.wheels.items()}
    whole = replace(train, wheels=wheels, unknown=())
    radii = {label: size * train.module_ratio(label) for label, size in sizes.items()}
    apart = {mesh.name: _distance(whole, mesh) or Fraction(0) for mesh in meshes}
    shifted = frozenset(m.name for m in meshes if train.toothed and _pair(whole, m)[2])
    heights: dict[str, Fraction] = {}
    for body, line in lines.line.items():
        if line == lines.main:
            heights[body] = Fraction(0)
        elif ("h", line) in solution.values:
            heights[body] = solution.values["h", line]
    return TrainDimensions(sizes, radii, apart, shifted, heights, lines.line)


def _positive(train: Train, axes: TrainDimensions, meshes: Sequence[Mesh]) -> Fault | None:
    """Check the distances again with the sizes found: a ring is larger than its mating wheel."""
    for mesh in meshes:
        one, other = axes.sizes[mesh.first], axes.sizes[mesh.second]
        first, second = train.ends(mesh)
        apart = axes.heights.get(first, Fraction(0)) - axes.heights.get(second, Fraction(0))
        if mesh.kind is MeshKind.INTERNAL and one == other:
            text = translate(
                "{} and {} mesh internally and have the same size", mesh.first, mesh.second
            )
            return Fault("gears.meshes", text, HINT)
        wanted = axes.distances[mesh.name]
        known = first in axes.heights and second in axes.heights
        slack = 2 * REPAIRABLE if is_shifted(train) else 0
        if known and abs(abs(apart) - wanted) > slack:
            text = translate(
                "the train is not coaxial at {}: its axes are {} apart, its wheels need {}",
                mesh.name,
                _distance_text(abs(apart)),
                _distance_text(wanted),
            )
            return Fault("gears.wheels", text, HINT)
    return None


def _explain_conflict(train: Train, lines: _Lines, meshes: Sequence[Mesh]) -> Fault | None:
    """Name two meshes that put one axis at two heights."""
    seen: dict[str, tuple[Mesh, Fraction]] = {}
    for mesh in meshes:
        names = {lines.line[b] for b in train.ends(mesh)} - {lines.main}
        size = _distance(train, mesh)
        if len(names) != 1 or size is None:
            continue
        (name,) = names
        before, height = seen.setdefault(name, (mesh, size))
        if abs(height - size) > (2 * REPAIRABLE if is_shifted(train) else 0):
            text = translate(
                "the train is not coaxial: the axis of {} is {} from the main axis by the "
                "mesh {}, and {} by {}",
                name,
                _distance_text(height),
                before.name,
                _distance_text(size),
                mesh.name,
            )
            hint = HINT
            if is_shifted(train):
                label, shift = shift_for(train, mesh, height)
                if abs(shift) < 1:
                    hint = translate(
                        "With x = {:.3f} of wheel {} the axes would coincide.", shift, label
                    )
            return Fault("gears.wheels", text, hint)
    return None


def _distance_text(size: Fraction) -> str:
    """Return a distance in half modules."""
    return str(size) if size.denominator < 1000 else f"{float(size):g}"
