"""Joints of the links: the mechanism behind points, slides and higher pairs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from functools import partial
from itertools import combinations
from typing import Any

from msgspec import Struct, field

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism, Prismatic, Revolute
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.links import Length, LinkText
from planmethod.problem.model import Body, FixedLine, Slide
from planmethod.problem.names import NAME_LIMIT, is_label, listed, looks_latin, split_pair
from planmethod.problem.placement import heading
from planmethod.problem.tables import HigherPairSection

Guide = tuple[str | None, complex, float]
"""Name of the fixed point (or None), base in m, angle in degrees."""


DRAWN = "drawn"
"""Value of a number of the frame that follows from the drawn position."""

Coordinates = tuple[float | None, float | None]
"""Coordinates, m; None of one that is drawn."""


class FrameText(Struct, frozen=True):
    """Fixed points, m, and guides of the frame (стойка).

    Drawn ones have arbitrary places here; ``drawn_points`` and ``drawn_guides`` have their known
    numbers.
    """

    points: Mapping[str, complex]
    guides: Mapping[str, Guide]
    number: str = FRAME
    sound: bool = True
    drawn_points: Mapping[str, Coordinates] = field(default_factory=dict)
    drawn_guides: Mapping[str, FixedLine] = field(default_factory=dict)


def read_frame(node: FileNode) -> FrameText:
    """Read ``[frame]``."""
    points: dict[str, complex] = {}
    drawn: dict[str, Coordinates] = {}
    if isinstance(node.value, Mapping):
        node.require_at_most(keys.POINT_LIMIT, "{} points, the limit is {}")
        for entry in node.entries():
            if entry.key not in keys.FRAME:
                entry.attempt(partial(_read_fixed, points=points, drawn=drawn))
    else:
        node.attempt(lambda frame: frame.table("[frame] A = [0, 0]"))
    number = node.read("number", lambda number: str(number.integer(0, 99)))
    lines: dict[str, FixedLine] = {}
    guides = node.read("guides", partial(_read_guides, points=points, drawn=lines)) or {}
    return FrameText(points, guides, number or FRAME, node.is_sound, drawn, lines)


def _is_drawn(value: object) -> bool:
    """Return whether a place has a coordinate that is drawn."""
    return value == DRAWN or (isinstance(value, list) and len(value) == 2 and DRAWN in value)


def _read_drawn(node: FileNode) -> Coordinates:
    """Read ``"drawn"``, or ``["drawn", 0]``."""
    if node.value == DRAWN:
        return None, None
    x, y = (None if part.value == DRAWN else part.coordinate() for part in node.entries())
    return x, y


def _read_fixed(node: FileNode, points: dict[str, complex], drawn: dict[str, Coordinates]) -> None:
    """Read a fixed point; one with a faulty place is still a point: others may name it."""
    if isinstance(node.value, Mapping):
        node.reject_unknown(str(node.key), keys.FRAME, "unknown key")
    name = node.attempt(lambda entry: entry.check_point_name(str(entry.key)))
    place: complex | None
    if _is_drawn(node.value):
        known = node.attempt(_read_drawn)
        place = complex(1.0 + 0.37 * len(points), 0.61 * len(points))  # apart from the others
        if name is not None and known is not None:
            drawn[name] = known
    else:
        place = node.attempt(FileNode.place)
    if name is not None and name in points:
        node.note("point '{}' is given twice", name)
    elif name is not None:
        points[name] = place or 0j


_GUIDE = 'guides.x-x = { through = "A", angle = 0 }'


def _read_guides(
    node: FileNode, points: Mapping[str, complex], drawn: dict[str, FixedLine]
) -> dict[str, Guide]:
    node.table(_GUIDE)
    node.require_at_most(keys.POINT_LIMIT, "{} guides, the limit is {}")
    guides: dict[str, Guide] = {}
    for entry in node.entries():
        name = entry.attempt(_read_guide_name)
        if name is not None:
            guide = entry.attempt(partial(_read_guide, points=points))
            guides[name], line = guide or ((None, 0j, 0.0), None)
            if line is not None:
                drawn[name] = line
    return guides


def _read_guide_name(node: FileNode) -> str:
    name = str(node.key)
    name = node.unmask(name) if looks_latin(name) else name
    node.check_label(name, "a guide")
    return name


def _read_guide(node: FileNode, points: Mapping[str, complex]) -> tuple[Guide, FixedLine | None]:
    """Read a guide, and the known numbers of one that is drawn."""
    node.table(_GUIDE)
    node.allow(keys.GUIDE)
    for key in keys.GUIDE:
        if key not in node:
            node[key].note("missing", hint=translate("For example: {}", _GUIDE))
    known: Coordinates | None
    if _is_drawn(node["through"].value):
        through, base, known = None, 1 + 0j, node.read("through", _read_drawn)
    else:
        through, base = node.read("through", partial(_read_base, points=points)) or (None, 0j)
        known = (base.real, base.imag)
    turned = node["angle"].value == DRAWN
    angle = None if turned else node.read("angle", FileNode.angle)
    node.require_sound()
    guide = through, base, angle or 0.0
    if known is not None and (turned or None in known):
        return guide, FixedLine(through, known, angle)
    return guide, None


def _read_base(node: FileNode, points: Mapping[str, complex]) -> tuple[str | None, complex]:
    """Read the point that a guide goes through: a fixed one by its name, or any by its place."""
    if isinstance(node.value, str):
        name = node.point_of("the frame", points)
        return name, points[name]
    return None, node.place()


def find_host(
    link: LinkText, links: Mapping[str, LinkText], frame: FrameText
) -> tuple[str, str | None] | None:
    """Return the host of a slider and the guide it is on, if it is a guide; None after a fault."""
    assert link.slides is not None
    link.slides.allow(keys.SLIDES)
    if "on" not in link.slides and link.sound:
        link.slides.note_missing("on", "Name a guide of the frame or a link.")

    def read_host(node: FileNode) -> tuple[str, str | None]:
        known = (*frame.guides, *(name for name in links if name != link.name))
        name = node.any_name("the name of a guide or link", known)
        if name in frame.guides or name == FRAME:
            return FRAME, name if name in frame.guides else None
        if name == link.name:
            node.reject("link {} cannot slide on itself", name)
        if name not in links:
            node.reject_unknown(name, known, "unknown guide or link '{}'")
        return name, None

    return link.slides.read("on", read_host)


def order_hosts(links: Mapping[str, LinkText], hosts: Mapping[str, str]) -> list[str]:
    """Sliders in an order in which every host comes before what slides on it.

    ``hosts`` maps each slider to its host. A circle of sliders is a fault.
    """
    ordered: list[str] = []
    for start in hosts:
        chain: list[str] = []
        link = start
        while link in hosts and link not in ordered and link not in chain:
            chain.append(link)
            link = hosts[link]
        if link in chain:
            circle = chain[chain.index(link) :]
            if start == min(circle, key=list(hosts).index):
                links[start].node["slides"]["on"].note(
                    "links slide on each other in a circle: {}",
                    translate(" on ").join([*circle, circle[0]]),
                    hint="One of them must carry the line without sliding itself.",
                )
            continue
        ordered.extend(reversed(chain))
    return ordered


class Host(Struct, frozen=True):
    """The link, or the frame, whose line a slider moves along.

    Attributes
    ----------
    name : str
    body : Body
        Its points.
    guide : str or None
        The guide, of the frame.
    turn : float or None, degrees
        Direction of its own axis from +x where it only translates, else None.
    angle_optional : bool
        Whether the line is itself its own axis, unless a mark and an angle are given.
    """

    name: str
    body: Body
    guide: str | None
    turn: float | None
    angle_optional: bool

    @property
    def called(self) -> str:
        """What messages call it."""
        return "the frame" if self.name == FRAME else translate("link {}", self.name)


class _Line(Struct, frozen=True):
    """Line of a pair, as `Slide` has it."""

    base: complex
    angle: float
    label: str
    through: str | None
    towards: str | None = None


def read_slide(link: LinkText, host: Host, frame: FrameText) -> Slide | None:
    """Read one prismatic pair, and its length of contact where one is given; None after a fault."""
    assert link.slides is not None
    node = link.slides
    length = node.read("length", FileNode.length)  # a faulty one does not hide the line
    offset = node.read("offset", FileNode.coordinate, 0.0)
    if not link.points:
        return None
    pin, line = link.points[0], None
    if host.guide is not None:
        line = _read_guided(node, host.guide, frame)
    elif "along" in node:
        line = node.attempt(partial(_read_along, pin=pin, host=host))
    else:
        line = node.attempt(partial(_read_through, host=host))
    if line is None or offset is None:
        return None
    return Slide(
        link.name, host.name, pin, line.base, line.angle, offset,
        line.label, line.through, line.towards, length,
    )  # fmt: skip


def _read_guided(node: FileNode, guide: str, frame: FrameText) -> _Line:
    """Return the line of a guide of the frame."""
    for key in ("along", "through", "angle"):
        if key in node:
            hint = translate("The line is given in frame.guides.{}.", guide)
            node[key].note("not valid with the guide '{}'", guide, hint=hint)
    through, base, angle = frame.guides[guide]
    return _Line(base, angle, guide, through)


def _read_along(node: FileNode, pin: str, host: Host) -> _Line:
    """Read a line of two points; the pin of the sliding block itself is rejected."""
    for key in ("through", "angle"):
        if key in node:
            hint = "Give the line by along, or by through and angle."
            node[key].note("not valid with 'along'", hint=hint)
    along, points = node["along"], list(host.body.points)
    pair = split_pair(along.value) if isinstance(along.value, str) else None
    if pair is not None and pin in pair and pin not in points and len(points) > 1:
        own = next((point for point in pair if point in points), points[0])
        hint = (
            'A line needs no second point: through = "{0}", angle = 0 is a slot along {1}, angle = '
            "90 one across it."
        )
        told = translate(hint, own, "".join(points[:2]))
        along.reject(
            "{} is the pin of the sliding block, not a point of {}", pin, host.called, hint=told
        )
    through, towards = along.line_of(lambda: host.called, points)
    start, end = host.body.points[through], host.body.points[towards]
    if start == end:
        along.reject("{} and {} are at the same place", through, towards)
    return _Line(start, heading(end - start), f"{through}{towards}", through, towards)


def _read_through(node: FileNode, host: Host) -> _Line:
    """Read a line by a point of it and its angle."""
    points = list(host.body.points)
    if "through" not in node:
        pair = "".join(points[:2]) if len(points) > 1 else ""
        ways = [f'along = "{pair}"'] if pair else []
        ways += [f'through = "{points[0]}", angle = 0'] if points else []
        hint = translate("Add {}.", translate(" or ").join(ways)) if ways else ""
        node.reject("no line of {} is named", host.called, hint=hint)
    through = node.read("through", lambda through: through.point_of(lambda: host.called, points))
    if "angle" not in node and not host.angle_optional:
        axis = translate("the own axis of link {}", host.name) if host.turn is None else "+x"
        node["angle"].note("missing", hint=translate("Give it in degrees from {}.", axis))
    angle = node.read("angle", partial(_read_angle, host=host), 0.0)
    node["angle"].require_sound()
    through = needed(through)
    return _Line(host.body.points[through], needed(angle), through, through)


def _read_angle(node: FileNode, host: Host) -> float:
    """Read the angle of the line from the host's own axis, degrees."""
    angle = node.angle()
    if host.angle_optional and host.body.axis is None and angle != 0:
        hint = translate("Link {} has no axis other than the line it carries.", host.name)
        node.reject("expected 0 or no value, got {:g}", angle, hint=hint)
    # the file counts from +x where the host cannot turn: that is what the figure shows
    return _principal(angle - host.turn) if host.turn else angle


def _principal(angle: float) -> float:
    """Angle brought into (-180, 180] degrees."""
    turned = angle % 360.0
    return turned - 360.0 if turned > 180.0 else turned


def read_higher(
    node: FileNode, links: dict[str, LinkText], frame: FrameText
) -> tuple[HigherPair, ...]:
    """Read ``[[higher_pairs]]`` and add the link that replaces each to the links.

    A bar between both centres of curvature moves the two links as their profiles do, velocities
    and accelerations too; where one profile is straight, a block that slides along it.
    """
    node.tables(keys.HIGHER_LIMIT, "{} pairs, the limit is {}")
    found: list[HigherPair] = []
    for entry in node.entries():
        pair = entry.attempt(_PairReader(links, frame, found).read)
        if pair is not None:
            found.append(pair)
    return tuple(found)


class _PairReader:
    """Reader of one pair."""

    def __init__(
        self, links: dict[str, LinkText], frame: FrameText, previous: list[HigherPair]
    ) -> None:
        self.links, self.frame = links, frame
        self.rollers = {pair.roller for pair in previous} - {""}
        self.names = {pair.name for pair in previous}

    def read(self, node: FileNode) -> HigherPair:
        """Read the pair and add its link."""
        given = node.record(
            HigherPairSection,
            name=FileNode.point_name,
            links=self._links,
            centres=_read_centres,
            distance=FileNode.length,
            slides=_read_profile,
            roller=self._number,
            by=self._number,
        )
        node.require_sound()
        name, ends, centres = given["name"], given["links"], given["centres"]
        if ends[0] == ends[1]:
            node["links"].reject("a pair must join two different links")
        for link, centre in zip(ends, centres, strict=False):
            own = self.frame.points if link == FRAME else self.links[link].points
            if centre not in own:
                owner = translate("the frame") if link == FRAME else translate("link {}", link)
                hint = translate("Its points are {}.", listed(own))
                node["centres"].note("{} has no point '{}'", owner, centre, hint=hint)
        used = {point for link in self.links.values() for point in link.points}
        if name in used | set(self.frame.points) | self.names:
            node["name"].note("another point has the name {}", name)
        straight = len(centres) == 1
        _check_form(node, straight=straight)
        node.require_sound()
        roller = given.get("roller", "")
        by = given.get("by") or self._free(roller)
        if roller and roller == by:
            node["by"].reject("link '{}' is given twice", by)
        self.links[by] = self._replacement(node, by, given)
        return HigherPair(name, tuple(ends), by, roller, centres[-1] if roller else "")

    def _replacement(self, node: FileNode, by: str, table: Mapping[str, Any]) -> LinkText:
        """Return the link that replaces the pair."""
        centres = table["centres"]
        link = LinkText(by, node, tuple(centres))
        if len(centres) == 1:
            link.slides = node["slides"]
            link.slides.value = {"on": table["links"][1], **table["slides"]}
        else:
            one, other = centres
            link.lengths.append(Length(f"{one}{other}", one, other, table["distance"]))
        return link

    def _links(self, node: FileNode) -> tuple[str, ...]:
        node.array("a list of two links", low=2, high=2)
        return node.read_all(self._link)

    def _link(self, node: FileNode) -> str:
        name, known = node.text(NAME_LIMIT), [FRAME, *self.links]
        if name not in known:
            node.reject_unknown(name, known, "unknown link '{}'")
        return name

    def _number(self, node: FileNode) -> str:
        name = node.text(NAME_LIMIT)
        if not is_label(name):
            node.reject("{!r} cannot name {}", name[:40], "a link")
        if name in self.links or name in self.rollers or name in (FRAME, self.frame.number):
            node.reject("link '{}' is given twice", name)
        return name

    def _free(self, roller: str) -> str:
        """Return the first free number after those of the links."""
        taken = {*self.links, *self.rollers, roller, self.frame.number}
        numbers = [int(name) for name in taken if name.isdecimal()]
        return str(max(numbers, default=0) + 1)


def _read_centres(node: FileNode) -> tuple[str, ...]:
    node.array("a list of one or two points", low=1, high=2)
    return node.read_all(FileNode.point_name)


def _read_profile(node: FileNode) -> object:
    return node.table('slides = { along = "DE" }')


def _check_form(node: FileNode, *, straight: bool) -> None:
    """Reject keys that do not go with the number of centres."""
    wanted, other = ("slides", "distance") if straight else ("distance", "slides")
    if other in node:
        hint = "With two centres give their distance."
        if straight:
            hint = "With one centre the second profile is straight: give slides."
        node[other].note("not valid with these centres", hint=hint)
    if wanted not in node:
        hint = "Give the distance of the centres: the sum of the radii."
        if straight:
            hint = 'Give the straight profile of the second link: slides = { along = "DE" }.'
        node[wanted].note("missing", hint=hint)
    if straight and "roller" in node:
        hint = "A roller has its centre on the second link: give both centres."
        node["roller"].note("not valid with these centres", hint=hint)


def join(
    node: FileNode,
    frame: FrameText,
    links: Mapping[str, LinkText],
    hosts: Mapping[str, str],
    driver: str,
    *,
    complete: bool,
    toothed: Collection[tuple[str, str]] = (),
) -> Mechanism:
    """Make the joints that shared names and slides imply, and check them.

    Parameters
    ----------
    node : FileNode
        ``[links]``.
    hosts : mapping of str to str
        Host of each slider.
    complete : bool
        Whether every point and slide of the file could be read: if not, a missing joint means
        nothing.
    toothed : collection of tuple of two str
        Links that a mesh joins.
    """
    links_by_point: dict[str, list[str]] = {point: [FRAME] for point in frame.points}
    for link in links.values():
        for point in link.points:
            links_by_point.setdefault(point, []).append(link.name)
    revolutes = tuple(
        Revolute(point, tuple(names)) for point, names in links_by_point.items() if len(names) > 1
    )
    prismatics = tuple(
        Prismatic(slider, host, links[slider].points[0])
        for slider, host in hosts.items()
        if links[slider].points
    )
    _reject_duplicates(links, revolutes, prismatics)
    if complete:
        _check_reach(links, revolutes, prismatics, driver, toothed)
    _check_coincident(links, links_by_point, prismatics)
    _check_letters(node, links_by_point)
    return Mechanism(tuple(links), revolutes, prismatics, driver)


def coincident_points(slides: Iterable[Slide]) -> list[str]:
    """Names of points under those of other links: ``B3`` under a pin, ``E4`` on a slider."""
    found: list[str] = []
    for slide in slides:
        if slide.host != FRAME:
            found.append(f"{slide.pin}{slide.host}")
            if slide.through is not None:
                found.append(f"{slide.through}{slide.slider}")
    return found


def _called(link: str) -> str:
    return "the frame" if link == FRAME else translate("link {}", link)


def _reject_duplicates(
    links: Mapping[str, LinkText],
    revolutes: tuple[Revolute, ...],
    prismatics: tuple[Prismatic, ...],
) -> None:
    shared: dict[tuple[str, str], list[str]] = {}
    for joint in revolutes:
        for pair in combinations(joint.links, 2):
            shared.setdefault(pair, []).append(joint.point)
    for (one, two), points in shared.items():
        if len(points) > 1:
            links[two].node["points"].note(
                "{} and link {} share the points {}: they make one rigid body",
                _called(one),
                two,
                translate(" and ").join(points),
                hint="Two links are joined at one point; give the other points other names.",
            )
    for slide in prismatics:
        pair = (slide.host, slide.slider)
        points = shared.get(pair) or shared.get(pair[::-1]) or []
        if points:
            hint = (
                "The pin of a slider is not a point of the link that carries its line; "
                "remove {} from one of them."
            )
            links[slide.slider].node["slides"].note(
                "link {} slides on {} and is pivoted to it in {}: they make one rigid body",
                slide.slider,
                _called(slide.host),
                points[0],
                hint=translate(hint, points[0]),
            )


def _check_reach(
    links: Mapping[str, LinkText],
    revolutes: tuple[Revolute, ...],
    prismatics: tuple[Prismatic, ...],
    driver: str,
    toothed: Collection[tuple[str, str]],
) -> None:
    touching: dict[str, list[tuple[str, ...]]] = {name: [] for name in (FRAME, *links)}
    for joint in revolutes:
        for name in joint.links:
            touching[name].append(joint.links)
    for slide in prismatics:
        touching[slide.slider].append((slide.slider, slide.host))
        touching[slide.host].append((slide.slider, slide.host))
    for pair in toothed:
        for name in pair:
            touching[name].append(pair)
    reached = {FRAME}
    front = [FRAME]
    while front:
        for group in touching[front.pop()]:
            for name in group:
                if name not in reached:
                    reached.add(name)
                    front.append(name)
    for name, link in links.items():
        if name not in reached:
            hint = "Links are joined by points of the same name and by slides: check the names {}."
            message = "link {} is not joined to the frame through other links"
            link.node.note(message, name, hint=translate(hint, listed(link.points)))
        elif name != driver and len(touching[name]) < 2:
            where = next((p for p in link.points if any(j.point == p for j in revolutes)), None)
            hint = (
                "It would move freely: join another of its points, or make them points of the "
                "link it is joined to."
            )
            shown = f", {where}" if where else ""
            link.node.note("link {} has one joint only{}", name, shown, hint=hint)


def _check_coincident(
    links: Mapping[str, LinkText],
    links_by_point: Mapping[str, list[str]],
    prismatics: tuple[Prismatic, ...],
) -> None:
    for slide in prismatics:
        name = f"{slide.pin}{slide.host}"
        if slide.host != FRAME and name in links_by_point:
            links[slide.slider].node["slides"].note(
                "the point of link {} under the pin {} has the name {}, which another point "
                "has, too",
                slide.host,
                slide.pin,
                name,
                hint=translate("Rename the point {}.", name),
            )


def _check_letters(node: FileNode, points: Iterable[str]) -> None:
    """Reject points that differ only in case: on the plans both have the same small letter."""
    seen: dict[str, str] = {}
    for point in points:
        twin = seen.setdefault(point.casefold(), point)
        if twin != point:
            node.note(
                "the points {} and {} differ only in case: on the plans both are {}",
                twin,
                point,
                point.lower(),
                hint=translate("Rename the point {}.", point),
            )
