"""Mistakes with wheels on links and wheels that roll, as rewritten steps (ошибки с колёсами).

A wrong ratio makes rates wrong. If the student also places the wheel by it, the whole plan of
positions is another one.
"""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.check.mistakes.plans import Change, MistakeContext, times
from planmethod.construct.steps import Compute, Name, NumberName, Step
from planmethod.mechanism.model import FRAME
from planmethod.plans.model import RATES
from planmethod.plans.motion.meshes import turns
from planmethod.problem.mesh_records import GearMesh

OFTEN = 2.0
"""Prior of mistakes with wheels that every group makes."""

Changes = dict[Name, tuple[Step, ...]]


def _driven(scene: MistakeContext) -> Iterator[tuple[str, GearMesh]]:
    """Yield the links that a mesh turns."""
    meshes = {mesh.pole: mesh for mesh in scene.problem.meshes}
    for group in scene.solution.construction.structure.groups:
        if group.mesh in meshes:
            yield group.links[0], meshes[group.mesh]


def _wheels(scene: MistakeContext) -> Iterator[tuple[str, GearMesh]]:
    """Yield the wheels among them: the others are racks."""
    for link, mesh in _driven(scene):
        if not (mesh.is_rack and link == mesh.mesh.links[1]):
            yield link, mesh


def _rates(scene: MistakeContext, link: str, mate_factor: float, carrier_factor: float) -> Changes:
    """Return factors of both terms of the ω and ε of a wheel: of its mate's, of its carrier's."""
    names = [("omega" if plan is RATES[0] else "epsilon") + f"_{link}" for plan in RATES]
    return _factors(
        scene,
        {
            f"{name}{mark}": by
            for name in names
            for mark, by in (("*", mate_factor), ("**", carrier_factor))
        },
    )


def _places(
    scene: MistakeContext, mesh: GearMesh, mate_factor: float, carrier_factor: float
) -> Changes:
    """Return the same factors of the terms of its angle."""
    return _factors(
        scene,
        {
            f"turned_{mesh.pole}": mate_factor,
            f"rolled_{mesh.pole}": mate_factor,
            f"carried_{mesh.pole}": carrier_factor,
        },
    )


def _factors(scene: MistakeContext, factors: dict[str, float]) -> Changes:
    found: Changes = {}
    for name, factor in factors.items():
        step = scene.compute(NumberName(name))
        if step is not None and factor != 1.0:
            found[step.out] = times(step, factor)
    return found


def _of_ratio(
    scene: MistakeContext,
    code: str,
    link: str,
    mesh: GearMesh,
    mate_factor: float,
    carrier_factor: float,
) -> Iterator[Change]:
    """Yield a wrong ratio: of the rates alone, and of the place of the wheel with them."""
    rates = _rates(scene, link, mate_factor, carrier_factor)
    if rates:
        yield Change(code, link, rates, prior=OFTEN)
        if places := _places(scene, mesh, mate_factor, carrier_factor):
            yield Change(code, link, {**rates, **places})


def _ratio(mesh: GearMesh, link: str) -> float:
    """Return the ratio by which a wheel turns with its mate; 0 of a wheel on a rack."""
    return 0.0 if mesh.is_rack else mesh.ratio(link)


def sign_of_mesh(scene: MistakeContext) -> Iterator[Change]:
    """G1: an outer mesh with the sign of an inner one, or the other way; a wheel rolls back."""
    for link, mesh in _wheels(scene):
        u = _ratio(mesh, link)
        yield from _of_ratio(scene, "G1", link, mesh, -1.0, (1 + u) / (1 - u))
        if u and mesh.mesh.rolls:
            yield from _of_ratio(scene, "G1", link, mesh, -1.0, -1.0)


def ratio_inverted(scene: MistakeContext) -> Iterator[Change]:
    """G2: r₁/r₂ for r₂/r₁."""
    for link, mesh in _wheels(scene):
        u = _ratio(mesh, link)
        if u and abs(u) != 1.0:
            yield from _of_ratio(scene, "G2", link, mesh, u**-2, (1 - 1 / u) / (1 - u))


def carrier_forgotten(scene: MistakeContext) -> Iterator[Change]:
    """G3: the ratio of wheels on a link that moves taken for one of fixed axes."""
    for link, mesh in _wheels(scene):
        u = _ratio(mesh, link)
        if not u or not turns(scene.problem, mesh.mesh.carrier):
            continue
        mate = mesh.counterpart(link)
        left = 0.0 if mate != FRAME and turns(scene.problem, mate) else -u / (1 - u)
        yield from _of_ratio(scene, "G3", link, mesh, 1.0, left)


def wheel_radius_wrong(scene: MistakeContext) -> Iterator[Change]:
    """G4: the diameter for the radius where a wheel meets a rack; the mate's in its moments."""
    for link, mesh in _driven(scene):
        if mesh.is_rack and link == mesh.mesh.links[0]:
            yield from _of_ratio(scene, "G4", link, mesh, 0.5, 1.0)
        board = scene.board
        if board is None or mesh.is_rack:
            continue
        for step in scene.steps:
            if board.letter_of(NumberName(step.out)) == f"r_{{w{link}}}":
                other = mesh.radius(mesh.counterpart(link))
                if other and other != mesh.radius(link):
                    yield Change("G4", link, data={step.out: other})


def wheel_slips(scene: MistakeContext) -> Iterator[Change]:
    """G5: a wheel that rolls taken for one that slides: it does not turn, or as its arm does."""
    for link, mesh in _wheels(scene):
        if mesh.mesh.rolls:
            u = _ratio(mesh, link)
            yield from _of_ratio(scene, "G5", link, mesh, 0.0, 0.0)
            if u:
                yield from _of_ratio(scene, "G5", link, mesh, 1.0, 1 / (1 - u))


def pole_misplaced(scene: MistakeContext) -> Iterator[Change]:
    """G6: the pole of a mesh at the radius of the other wheel, or on the other side."""
    for mesh in scene.problem.meshes:
        step = scene.compute(NumberName(f"|r_{mesh.pole}|"))
        if step is None:
            continue
        one, two = mesh.mesh.links
        other = 0.0 if mesh.is_rack else mesh.radius(two)
        if other and other != mesh.radius(one):
            yield Change("G6", mesh.pole, {step.out: times(step, other / mesh.radius(one))})
        yield Change("G6", mesh.pole, {step.out: times(step, -1.0)})


def pressure_angle_wrong(scene: MistakeContext) -> Iterator[Change]:
    """G7: the force on a tooth along the tangent, without α; its radial part to the other side."""
    board = scene.board
    for mesh in scene.problem.meshes if board is not None else ():
        letter = f"tg α_{{{mesh.pole}}}"
        for step in scene.steps:
            if not isinstance(step, Compute) or board is None:
                continue
            if any(board.letter_of(name) == letter for name, _ in step.powers):
                for factor in (0.0, -1.0):
                    changed = times(step, factor)
                    if factor < 0:
                        changed = _radial_reversed(step)
                    yield Change("G7", mesh.pole, {step.out: changed})


def _radial_reversed(step: Compute) -> tuple[Step, ...]:
    """Return the size of a radial force with the other sign."""
    size = NumberName(f"{step.out} size")
    made = Compute(size, step.factor, step.powers, step.size)
    return made, Compute(step.out, -1.0, ((size, 1),))


def rolling_friction_forgotten(scene: MistakeContext) -> Iterator[Change]:
    """G8: no force of friction where a wheel rolls: its inertia does not turn it."""
    board = scene.board
    for link, mesh in _wheels(scene) if board is not None else ():
        if not mesh.mesh.rolls or board is None:
            continue
        for plan in board.plans:
            for moments in plan.moments:
                if moments.force is not None and plan.links == (link,):
                    step = scene.compute(board.segments.known(moments.force.ends))
                    if step is not None:
                        yield Change("G8", link, {step.out: times(step, 0.0)})


WHEEL_MISTAKES = (
    sign_of_mesh,
    ratio_inverted,
    carrier_forgotten,
    wheel_radius_wrong,
    wheel_slips,
    pole_misplaced,
    pressure_angle_wrong,
    rolling_friction_forgotten,
)
