"""Force plans of wheels and racks on links: the force on the teeth along the line of action."""

from __future__ import annotations

from math import radians, tan

from msgspec.structs import replace

from planmethod.construct.steps import NumberName, PointName
from planmethod.mechanism.groups import AssurGroup
from planmethod.plans.forces.board import Force, ForceBoard, of_guide
from planmethod.plans.forces.polygons import (
    Balance,
    Component,
    Edge,
    ForcePlan,
    Moments,
    as_known,
    reaction_edge,
    reaction_symbol,
)
from planmethod.plans.model import Direction, KnownParts, Relation
from planmethod.plans.motion.legs import track_direction
from planmethod.plans.motion.meshes import mesh_of
from planmethod.plans.motion.position import outer_point
from planmethod.problem.mesh_records import GearMesh


def toothed_forces(board: ForceBoard, group: AssurGroup) -> None:
    """Find the force on the teeth and the reaction of the other pair."""
    mesh, (link,) = mesh_of(board.draft.problem, group), group.links
    if mesh.is_rack and link == mesh.mesh.links[1]:
        _rack(board, mesh, link)
    else:
        _wheel(board, mesh, group)


def _wheel(board: ForceBoard, mesh: GearMesh, group: AssurGroup) -> None:
    """Find the circumferential force by moments about the hinge; the hinge closes the plan."""
    b, (leg,) = board.draft.b, group.legs
    link, other = leg.link, mesh.counterpart(leg.link)
    pole, hinge = PointName(mesh.pole), PointName(outer_point(leg))
    moment, start = board.moment((link,), hinge), board.start()
    line = b.join(pole, hinge)
    over = ((board.datum(f"r_{{w{link}}}", "r", mesh.radius(link)), 1),)
    end = board.lay_off_tangential(start, line, moment, over)
    # Teeth push each other apart: a wheel away from the pole, but a ring out over it.
    ring = mesh.kind == "internal" and mesh.radius(link) > mesh.radius(other)
    push = _press(board, mesh, board.segments.values[start, end], -1.0 if ring else 1.0)
    teeth, whole, last = _teeth(board, mesh, link, (start, end), push, pole_line=(pole, hinge))
    loads: list[Edge] = []
    loaded = board.chain(last, link, loads)
    known = board.couples_on(link)
    stands = reaction_edge(link, board.called(leg.to), hinge, loaded, start)
    board.react(mesh.pole, link, other, Force(pole, start, last))
    board.react(hinge, link, leg.to, Force(hinge, loaded, start))
    balance = Balance((link,), (as_known(whole), *loads, stands))
    board.read_off(
        ForcePlan(
            group.links,
            (*teeth, *loads, stands),
            (whole,) if len(teeth) > 1 else (),
            balances=(balance,),
            moments=(Moments((link,), hinge, tuple(loads), known, teeth[0], arm=over),),
            couples=known,
        )
    )


def _press(board: ForceBoard, mesh: GearMesh, force: NumberName, sense: float) -> NumberName | None:
    """Return the radial force of a mesh, F_t·tan α, N; None of a wheel that rolls."""
    if not mesh.alpha:
        return None
    b = board.draft.b
    slope = board.datum(f"tg α_{{{mesh.pole}}}", "tan", tan(radians(mesh.alpha)))
    size = b.compute(board.name("r"), (force, 1), (slope, 1), size=True)
    return size if sense > 0 else board.negative(size)


def _teeth(
    board: ForceBoard,
    mesh: GearMesh,
    link: str,
    tangential: tuple[PointName, PointName],
    push: NumberName | None,
    pole_line: tuple[PointName, PointName],
) -> tuple[tuple[Edge, ...], Edge, PointName]:
    """Lay the radial part off; return the parts of the force on the teeth, it, and its end."""
    by, pole = board.called(mesh.counterpart(link)), PointName(mesh.pole)

    def edge(tail: PointName, head: PointName, part: Component) -> Edge:
        return Edge(reaction_symbol(link, by, part), link, pole, tail, head, component=part)

    start, end = tangential
    ends = str(pole_line[0]), str(pole_line[1])
    if push is None:
        across = Direction(Relation.PERPENDICULAR, ends)
        whole = replace(edge(start, end, Component.TOTAL), direction=across)
        return (whole,), whole, end
    line = board.draft.b.join(*pole_line)
    last = board.segments.lay_off_vector(board.name("n"), end, line, push)
    radial = Direction(Relation.PARALLEL, ends)
    normal = replace(edge(end, last, Component.NORMAL), direction=radial)
    parts = edge(start, end, Component.TANGENTIAL), normal
    whole = edge(start, last, Component.TOTAL)
    return parts, replace(whole, known=KnownParts.NONE), last


def _rack(board: ForceBoard, mesh: GearMesh, link: str) -> None:
    """Find the force along the guide that balances the loads; the guide takes the rest."""
    b, problem = board.draft.b, board.draft.problem
    slide, pole = problem.slides[mesh.slider], PointName(mesh.pole)
    guide, pin, wheel = board.draft.direction(slide), PointName(slide.pin), mesh.mesh.links[0]
    start = board.start()
    loads: list[Edge] = []
    loaded = board.chain(start, link, loads)
    end = b.intersect_lines(
        board.name("x"), b.parallel(loaded, guide), b.perpendicular(start, guide)
    )
    along = board.segments.read_signed(loaded, end, guide, f"F_{link}{wheel}")
    push = _press(board, mesh, along, 1.0)
    centre = PointName(mesh.centres[0])
    teeth, whole, last = _teeth(board, mesh, link, (loaded, end), push, pole_line=(centre, pole))
    direction = track_direction(slide, problem)
    found = replace(teeth[0], known=KnownParts.ONE, direction=direction)
    teeth = (found, *teeth[1:])
    pressed = Force(pole, loaded, last, reaction_symbol(link, board.called(wheel)))
    couple = board.negative(board.moment((link,), pin, pressed))
    board.react(mesh.pole, link, wheel, Force(pole, loaded, last))
    across = track_direction(slide, problem, perpendicular=True)
    known = board.couples_on(link)
    held = board.react_guide(slide.pin, link, slide.host, Force(pin, last, start), couple)
    stands = reaction_edge(link, board.called(slide.host), pin, last, start, across)
    board.read_off(
        ForcePlan(
            (link,),
            (*loads, *teeth, stands),
            (whole,) if len(teeth) > 1 else (),
            balances=(Balance((link,), (*loads, *teeth, stands)),),
            moments=(of_guide(held, [*loads, as_known(whole)], known),),
            couples=(*known, held),
        )
    )
