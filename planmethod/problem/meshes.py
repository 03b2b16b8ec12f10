"""Read wheels on links and wheels that roll, and find passive cranks (зацепления в механизме)."""

from __future__ import annotations

from cmath import exp
from collections.abc import Callable, Collection, Iterator, Mapping
from functools import partial
from itertools import permutations
from math import radians
from typing import Any, TypeVar

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Mechanism, Mesh, Passive
from planmethod.mechanism.structure import passive_links
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.joints import FrameText
from planmethod.problem.links import Length, LinkText
from planmethod.problem.mesh_records import GearMesh, MeshSection, RollingSection
from planmethod.problem.model import Body, Rule, Slide
from planmethod.problem.names import NAME_LIMIT, UNITS, format_length, is_label, listed

R = TypeVar("R")

TOLERANCE = 1e-6
"""Share of a distance of centres by which the sum of the pitch radii may differ from it."""

EQUAL = 1e-9
"""Share of a length by which sizes of a passive crank may differ from those of the first."""

POLES = ("W", "N", "J", "Y", "Z", "X")
"""Letters of poles, in the order in which they are taken."""


class _Letters:
    """Letters of poles that no point has."""

    def __init__(self, points: Collection[str]) -> None:
        self._taken = {point.casefold() for point in points}

    def allocate(self, stated: str = "") -> str:
        """Return a stated letter, or the next free one."""
        named = [stated] if stated else []
        free = (letter + n for n in ("", *map(str, range(1, 99))) for letter in POLES)
        found = next(name for name in (*named, *free) if name.casefold() not in self._taken)
        self._taken.add(found.casefold())
        return found

    def has(self, name: str) -> bool:
        """Return whether a point has a name."""
        return name.casefold() in self._taken


def letters_of(links: Mapping[str, LinkText], frame: FrameText) -> _Letters:
    """Return the letters that poles may have."""
    points = {point for link in links.values() for point in link.points}
    return _Letters(points | set(frame.points))


# Rolling -----------------------------------------------------------------------------------------


def read_rolling(
    links: dict[str, LinkText], frame: FrameText, letters: _Letters
) -> tuple[GearMesh, ...]:
    """Read ``links.3.rolls`` of every link, and add the link that replaces each contact.

    Where a wheel touches a line, a slider with its centre keeps the distance and a rack on the
    frame turns it; on a circle, an arm and a wheel on the frame. The slider, or the arm, exerts the
    normal reaction, the mesh that of friction.
    """
    found: list[GearMesh] = []
    for link in [one for one in links.values() if one.rolls is not None]:
        assert link.rolls is not None
        rolling = link.rolls.attempt(partial(_read_rolling, link=link, links=links, frame=frame))
        if rolling is None:
            link.sound = link.is_complete = False
            continue
        mesh = replace(rolling.mesh, name=letters.allocate())
        found.append(replace(rolling, mesh=mesh))
    return tuple(found)


def _read_rolling(
    node: FileNode, link: LinkText, links: dict[str, LinkText], frame: FrameText
) -> GearMesh:
    node.table('rolls = { on = "rail", radius = 0.04, centre = "C" }')
    values = node.record(
        RollingSection,
        on=lambda on: on.any_name("the name of a guide or of a fixed point",
                                  (*frame.guides, *frame.points)),
        radius=FileNode.length,
        centre=lambda centre: centre.point_of(
            partial(translate, "link {}", link.name), link.points
        ),
        circle=FileNode.length,
        by=lambda by: _read_number(by, links),
        at=lambda at: at.coordinate() if node["on"].value in frame.guides else at.angle(),
    )  # fmt: skip
    node.require_sound()
    if not link.points:
        node.reject("link {} has no point for the centre of the wheel", link.name)
    on, r, centre = values["on"], values["radius"], values.get("centre") or link.points[0]
    side, circle = values.get("side", ""), values.get("circle")
    if on not in frame.guides and on not in frame.points:
        node["on"].reject_unknown(on, (*frame.guides, *frame.points), "unknown guide '{}'")
    by = values.get("by") or _free(links, frame)
    phi, at = values.get("phi", 0.0), values.get("at", 0.0)
    if on in frame.guides:
        if circle is not None:
            hint = translate("{} is a guide: leave the radius of the circle out.", on)
            node["circle"].reject("not valid with a straight guide", hint=hint)
        if side in ("outside", "inside"):
            node["side"].reject("expected left or right of a guide, got '{}'", side)
        offset = -r if side == "right" else r
        carrier = links[by] = LinkText(by, node, (centre,))
        carrier.slides = node.with_value({"on": on, "offset": _in_unit(node, offset)})
        mesh = Mesh("", (link.name, FRAME), by, rolls=True)
        return GearMesh(
            mesh, (centre, ""), "rack", (r, 0.0), (phi, 0.0, 0.0),
            place=at, slider=by, offset=-offset, alpha=0.0,
        )  # fmt: skip
    if circle is None:
        hint = translate("Give the radius of the circle about {}: circle = 0.2.", on)
        node["circle"].reject("missing", hint=hint)
    inside = side == "inside"
    if side in ("left", "right"):
        node["side"].reject("expected outside or inside of a circle, got '{}'", side)
    if inside and r >= circle:
        node["radius"].reject("the wheel is not smaller than the circle in which it rolls")
    arm = circle - r if inside else circle + r
    carrier = links[by] = LinkText(by, node, (on, centre))
    carrier.lengths.append(Length(f"{on}{centre}", on, centre, arm))
    mesh = Mesh("", (FRAME, link.name), by, rolls=True)
    kind = "internal" if inside else "external"
    return GearMesh(mesh, (on, centre), kind, (circle, r), (0.0, phi, at), alpha=0.0)


def _in_unit(node: FileNode, metres: float) -> float:
    return metres * UNITS[node.faults.unit]


def _read_number(node: FileNode, links: Collection[str]) -> str:
    name = node.text(NAME_LIMIT)
    if not is_label(name):
        node.reject("{!r} cannot name {}", name[:40], "a link")
    if name in links or name == FRAME:
        node.reject("link '{}' is given twice", name)
    return name


def _free(links: Collection[str], frame: FrameText) -> str:
    """Return the first free number after those of the links."""
    numbers = [int(name) for name in (*links, frame.number) if name.isdecimal()]
    return str(max(numbers, default=0) + 1)


# Meshes ------------------------------------------------------------------------------------------


class MeshScope:
    """What the meshes of a file may name: links, their bodies unless faulty, and the slides."""

    def __init__(
        self,
        links: Collection[str],
        bodies_by_link: Mapping[str, Body],
        slides: Mapping[str, Slide],
        letters: _Letters,
    ) -> None:
        self.links = (FRAME, *links)
        self.bodies, self.slides, self.letters = bodies_by_link, slides, letters

    def turns(self, link: str) -> bool:
        """Return whether a link can turn: prismatic pairs alone do not join it to the frame."""
        while link != FRAME and link in self.slides:
            link = self.slides[link].host
        return link != FRAME


def read_meshes(node: FileNode, scope: MeshScope) -> tuple[GearMesh, ...]:
    """Read ``[[meshes]]``."""
    node.tables(keys.HIGHER_LIMIT, "{} pairs, the limit is {}")
    found = (entry.attempt(partial(_read_mesh, scope=scope)) for entry in node.entries())
    return tuple(mesh for mesh in found if mesh is not None)


def meshes_of_gears(gears: Mapping[str, Any], links: Collection[str]) -> list[dict[str, Any]]:
    """Return the meshes of a train whose wheels have the names of links, as ``[[meshes]]``.

    Empty if ``[gears]`` is a train of its own.
    """
    wheels, meshes = gears.get("wheels"), gears.get("meshes")
    if not isinstance(wheels, Mapping) or not isinstance(meshes, list):
        return []
    found = []
    for mesh in meshes:
        ends = [str(one) for one in mesh.get("of", ())] if isinstance(mesh, Mapping) else []
        if len(ends) != 2 or not {*ends} <= {*links} or not {*ends} <= {*wheels}:
            return []
        teeth = [wheels[one].get("z") if isinstance(wheels[one], Mapping) else wheels[one]
                 for one in ends]  # fmt: skip
        found.append({"links": ends, "kind": mesh.get("kind", "external"), "z": teeth})
    return found


def centres_of(ends: Collection[str], links: Mapping[str, LinkText], frame: FrameText) -> list[str]:
    """Return the fixed point of each link, as the centre of its wheel."""
    own = ([p for p in links[end].points if p in frame.points] for end in ends)
    return [points[0] if points else "" for points in own]


def _read_mesh(node: FileNode, scope: MeshScope) -> GearMesh:
    values = node.record(
        MeshSection,
        links=lambda ends: _read_pair(ends, scope.links),
        centres=lambda ends: _read_pair(ends, None),
        z=partial(_read_list, reader=lambda one: one.integer(1, 10_000), high=2),
        r=partial(_read_list, reader=FileNode.length, high=2),
        phi=partial(_read_list, reader=FileNode.angle, high=3),
        s=FileNode.coordinate,
    )  # fmt: skip
    node.require_sound()
    ends, centres, kind = values["links"], values["centres"], values.get("kind", "external")
    if ends[0] == ends[1]:
        node["links"].reject("a pair must join two different links")
    for link, centre in zip(ends, centres, strict=True):
        own = needed(scope.bodies.get(link)).points
        if centre not in own:
            owner = translate("the frame") if link == FRAME else translate("link {}", link)
            hint = translate("Its points are {}.", listed(own))
            node["centres"].note("{} has no point '{}'", owner, centre, hint=hint)
    name = values.get("name", "")
    if name and scope.letters.has(name):
        node["name"].note("another point has the name {}", name)
    alpha = values.get("alpha", 20.0)
    if not 0.0 <= alpha < 90.0:
        node["alpha"].note("expected 0 to less than 90 degrees, got {:g}", alpha)
    node.require_sound()
    reader = _read_rack if kind == "rack" else _read_wheels
    found = reader(node, values, ends, centres, scope)
    mesh = replace(found.mesh, name=scope.letters.allocate(name))
    return replace(
        found, mesh=mesh, alpha=alpha, teeth=values.get("z", ()), module=values.get("module")
    )


def _read_list(node: FileNode, reader: Callable[[FileNode], R], high: int) -> tuple[R, ...]:
    node.array("a list of numbers", low=1, high=high)
    return node.read_all(reader)


def _read_pair(node: FileNode, known: Collection[str] | None) -> tuple[str, str]:
    node.array("a list of two names", low=2, high=2)
    if known is None:
        one, two = node.read_all(FileNode.point_name)
        return one, two

    def read(entry: FileNode) -> str:
        name = entry.text(NAME_LIMIT)
        if name not in known:
            entry.reject_unknown(name, known, "unknown link '{}'")
        return name

    one, two = node.read_all(read)
    return one, two


def _read_wheels(
    node: FileNode,
    values: Mapping[str, Any],
    ends: tuple[str, str],
    centres: tuple[str, str],
    scope: MeshScope,
) -> GearMesh:
    """Read two wheels; the carrier is the link that has both centres."""
    able = [link for link, body in scope.bodies.items() if {*centres} <= {*body.points}]
    able = [link for link in able if link not in ends or link == FRAME]
    if not able:
        hint = "Name two points of one link, or two fixed points."
        message = "no link has both centres {} and {}, so their distance changes"
        node["centres"].reject(message, *centres, hint=hint)
    carrier = able[0]
    if carrier in ends:
        node["links"].reject("both centres are on the frame, which has one of the wheels")
    body = scope.bodies[carrier].points
    distance = abs(body[centres[1]] - body[centres[0]])
    kind = values.get("kind", "external")
    radii = _radii(node, values, distance, kind)
    wide = sum(radii) if kind == "external" else abs(radii[0] - radii[1])
    if abs(wide - distance) > TOLERANCE * distance:
        unit = node.faults.unit
        text = "the pitch radii give a distance of {}, but {} and {} are {} apart"
        if kind == "internal":
            text = "the difference of the pitch radii is {}, but {} and {} are {} apart"
        hint = "Change the module, the radii or the centres."
        node.reject(
            text, format_length(wide, unit), *centres, format_length(distance, unit), hint=hint
        )
    phi = _phi(node, values, 3 if scope.turns(carrier) else 2, carrier)
    angles = (phi[0], phi[1], phi[2] if len(phi) > 2 else 0.0)
    return GearMesh(Mesh("", ends, carrier), centres, kind, radii, angles)


def _radii(
    node: FileNode, values: Mapping[str, Any], distance: float, kind: str
) -> tuple[float, float]:
    """Return the pitch radii: values, or by the teeth from the module or the distance."""
    z, r, module = values.get("z", ()), values.get("r", ()), values.get("module")
    if bool(z) == bool(r):
        hint = "Give z = [60, 20], or r = [0.9, 0.3]."
        node["z"].reject("expected either teeth or pitch radii", hint=hint)
    both = r or z
    if len(r) == 1 and kind == "external" and r[0] < distance:
        return r[0], distance - r[0]
    if len(both) != 2:
        node["r" if r else "z"].reject("expected two numbers, got {}", len(both))
    if kind == "internal" and both[0] == both[1]:
        node["r" if r else "z"].reject("wheels of an internal mesh must differ in size")
    if r:
        return r[0], r[1]
    if module is not None:
        return z[0] * module / 2000.0, z[1] * module / 2000.0
    whole = sum(z) if kind == "external" else abs(z[0] - z[1])
    return distance * z[0] / whole, distance * z[1] / whole


def _phi(node: FileNode, values: Mapping[str, Any], count: int, carrier: str) -> tuple[float, ...]:
    """Return the angles of an assembled position."""
    phi: tuple[float, ...] = values.get("phi") or (0.0,) * count
    if len(phi) != count:
        hint = ""
        if len(phi) < count:
            hint = translate("The centres are on link {}, which turns: add its angle.", carrier)
        node["phi"].reject("expected {} angles, got {}", count, len(phi), hint=hint)
    return phi


def _read_rack(
    node: FileNode,
    values: Mapping[str, Any],
    ends: tuple[str, str],
    centres: tuple[str, str],
    scope: MeshScope,
) -> GearMesh:
    """Read a wheel and a rack; the carrier has the centre and a prismatic pair with the rack."""
    rack = ends[1]
    able = [
        (slide, slide.host if slide.slider == rack else slide.slider)
        for slide in scope.slides.values()
        if rack in (slide.slider, slide.host)
    ]
    able = [(slide, link) for slide, link in able if centres[0] in scope.bodies[link].points]
    if not able:
        hint = "A guide must keep the rack at the wheel: a pair of the rack with that link."
        message = "link {} slides on no link that has the centre {}"
        node["links"].reject(message, rack, centres[0], hint=hint)
    slide, carrier = able[0]
    turned = exp(-1j * radians(slide.angle))
    points = scope.bodies[slide.host].points
    body = scope.bodies[slide.slider].points
    at = {slide.host: centres[0], slide.slider: centres[1]}
    if slide.host == rack:
        at = {slide.host: centres[1], slide.slider: centres[0]}
    host = ((points[at[slide.host]] - slide.base) * turned).imag
    own = slide.offset + body[at[slide.slider]].imag
    offset = own - host if slide.slider == rack else host - own
    r = values.get("r", ())
    if values.get("z"):
        if values.get("module") is None and not r:
            r = (abs(offset),)
        elif not r:
            r = (values["z"][0] * values["module"] / 2000.0,)
    if not r:
        node["r"].reject("missing", hint="Give the pitch radius of the wheel: r = [0.05].")
    if abs(abs(offset) - r[0]) > TOLERANCE * r[0]:
        unit = node.faults.unit
        hint = "Name a point on the pitch line, or change the radius or the guide."
        message = "the pitch line through {} is {} from {}, but the pitch radius is {}"
        node.reject(
            message, centres[1], format_length(abs(offset), unit), centres[0],
            format_length(r[0], unit), hint=hint,
        )  # fmt: skip
    phi = _phi(node, values, 2 if scope.turns(carrier) else 1, carrier)
    return GearMesh(
        Mesh("", ends, carrier), centres, "rack", (r[0], 0.0),
        (phi[0], 0.0, phi[1] if len(phi) > 1 else 0.0),
        place=values.get("s", 0.0), slider=slide.slider, offset=offset,
    )  # fmt: skip


# Passive cranks ----------------------------------------------------------------------------------


def with_passive(
    mechanism: Mechanism, bodies_by_link: Mapping[str, Body], rules: Collection[Rule]
) -> Mechanism:
    """Return the mechanism with the cranks marked that only repeat another one.

    A parallelogram on the frame moves its coupler without turning it; a third crank of the same
    length that is parallel to the others changes nothing.
    """
    while (n := len(mechanism.active.links)) and 3 * n - 2 * mechanism.active.lower_pairs < 1:
        told = {rule.point for rule in rules}
        able = sorted(
            passive_links(mechanism.active),
            key=lambda link: bool(told & {*bodies_by_link[link].points}),
        )
        found = next(
            (p for link in able if (p := _repeated(mechanism.active, link, bodies_by_link))), None
        )
        if found is None:
            return mechanism
        mechanism = replace(mechanism, passive=(*mechanism.passive, found))
    return mechanism


def _repeated(
    mechanism: Mechanism, link: str, bodies_by_link: Mapping[str, Body]
) -> Passive | None:
    """Return which crank a link repeats, if the sizes make it passive."""
    own = list(_cranks(mechanism, link))
    others = [
        (other, *crank)
        for other in mechanism.links
        if other != link
        for crank in _cranks(mechanism, other)
    ]
    for fixed, pin, coupler in own:
        on = [one for one in others if one[3] == coupler]
        for first, second in permutations(on, 2):
            if first[0] == second[0]:
                continue
            fit = _parallel(bodies_by_link, coupler, (link, fixed, pin), first[:3], second[:3])
            if fit:
                return Passive(link, first[0])
    return None


def _cranks(mechanism: Mechanism, link: str) -> Iterator[tuple[str, str, str]]:
    """Yield the fixed point, the pin and the coupler of a link between frame and coupler."""
    fixed = [one for one in mechanism.revolutes if {FRAME, link} <= {*one.links}]
    pins = [one for one in mechanism.revolutes if link in one.links and FRAME not in one.links]
    for one in fixed:
        for pin in pins:
            for other in pin.links:
                if other != link:
                    yield one.point, pin.point, other


def _parallel(
    bodies_by_link: Mapping[str, Body], coupler: str, *cranks: tuple[str, str, str]
) -> bool:
    """Return whether three cranks are equal, and the coupler has the distances of the frame."""
    frame, middle = bodies_by_link[FRAME].points, bodies_by_link[coupler].points
    radii = [abs(bodies_by_link[link].points[pin] - bodies_by_link[link].points[fixed])
             for link, fixed, pin in cranks]  # fmt: skip
    _, fixed0, pin0 = cranks[1]
    _, fixed1, pin1 = cranks[2]
    span, own = frame[fixed1] - frame[fixed0], middle[pin1] - middle[pin0]
    if not span or not own or abs(abs(span) - abs(own)) > EQUAL * abs(span):
        return False
    turn = span / own
    _, fixed2, pin2 = cranks[0]
    gap = (frame[fixed2] - frame[fixed0]) - (middle[pin2] - middle[pin0]) * turn
    equal = max(radii) - min(radii) <= EQUAL * max(radii)
    return bool(equal and abs(gap) <= EQUAL * abs(span))


def note_passive_loads(node: FileNode, mechanism: Mechanism, loaded: Collection[str]) -> None:
    """Note a fault if a passive link has a mass or a load: ``node`` is that of the links."""
    for one in mechanism.passive:
        if one.link in loaded:
            message = "link {} is passive: statics cannot say how its weight and loads are shared"
            hint = "Give it no mass and no load, or leave it out."
            node[one.link].note(message, one.link, hint=hint)
