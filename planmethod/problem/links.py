"""Links of the file as written: points, lengths, third points, slides, not yet placed."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from functools import partial
from itertools import permutations

from msgspec import Struct, field

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.faults import is_number
from planmethod.problem.file_node import FileNode, LazyText, Table
from planmethod.problem.model import PointForm
from planmethod.problem.names import (
    NAME_LIMIT,
    angle_lines,
    fold,
    is_point_name,
    listed,
    looks_latin,
    nearest_name,
    segment,
    split_names,
    split_pair,
)

FormReader = Callable[[FileNode, str, Collection[str], LazyText], PointForm]
"""Of the table of a point, its name, the points of its link and their owner."""


def read_form(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    """Read the table of a third point.

    Parameters
    ----------
    points : collection of str
        Of the link.
    owner : str or callable
        Of the points.
    """
    node.allow(keys.POINT)
    kinds = [kind for kind in keys.POINT_FORMS if kind in node]
    if len(kinds) != 1:
        got = translate("got {}", translate(" and ").join(kinds)) if kinds else "got none"
        hint = translate('For example: {} = {{ on = "BC", at = 0.1, across = 0 }}', point)
        node.reject("expected one of side, on, from, vertex, {}", got, hint=hint)
    (kind,) = kinds
    allowed = keys.POINT_FORMS[kind]
    for key in node.value:
        if key not in allowed:
            hint = translate("'{}' allows {}.", kind, listed(allowed))
            node[key].note("not valid with '{}'", kind, hint=hint)
    return _READERS[kind](node, point, points, owner)


def _read_side(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    side = node["side"]
    words = side.value.split() if isinstance(side.value, str) else []
    words = [side.unmask(word) for word in words]
    if len(words) != 3 or words[0] not in ("left", "right") or words[1] != "of":
        side.reject_value('"left of BC" or "right of BC"')
    line = side.split_line(words[2], owner, points)
    if point in line:
        side.reject("the line {} goes through {} itself", words[2], point)
    return PointForm("side", line=line, left=words[0] == "left")


def _read_on(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    line = node.read("on", lambda on: on.line_of(owner, points))
    at, across = _read_along(node)
    if line is not None and point in line:
        node["on"].note("the line {} is named by {} itself", "".join(line), point)
    values = {"line": line, "at": at, "lateral_offset": across}
    return node.build(partial(PointForm, "on"), values)


def _read_from(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    start = node.read("from", lambda start: start.point_of(owner, points))
    at, across = _read_along(node)
    if start == point:
        node["from"].note("{} cannot be measured from itself", point)
    values = {"point": start, "at": at, "lateral_offset": across}
    return node.build(partial(PointForm, "from"), values)


def _read_along(node: FileNode) -> tuple[float | None, float | None]:
    """Read where a point is, along a line and across it."""
    at = node.require("at", FileNode.coordinate)
    return at, node.read("across", FileNode.coordinate, 0.0)


def _read_vertex(node: FileNode, point: str, points: Collection[str], owner: LazyText) -> PointForm:
    vertex = node.read("vertex", lambda vertex: vertex.point_of(owner, points))
    ray = node.require("ray", lambda ray: ray.line_of(owner, points))
    angle = node.require("angle", FileNode.angle)
    distance = node.read("distance", FileNode.length)
    if vertex is not None and ray is not None and (ray[0] != vertex or point in ray):
        message = "expected a ray from {} to another point of the link, got '{}'"
        node["ray"].note(message, vertex, "".join(ray))
    values = {"point": vertex, "line": ray, "angle": angle, "distance": distance}
    return node.build(partial(PointForm, "vertex"), values)


_READERS: dict[str, FormReader] = {
    "side": _read_side,
    "on": _read_on,
    "from": _read_from,
    "vertex": _read_vertex,
}


class Length(Struct, frozen=True):
    """Length key of a link: metres between two of its points."""

    key: str
    a: str
    b: str
    value: float

    def opposite_end(self, point: str) -> str:
        """Return the end that is not ``point``."""
        return self.b if point == self.a else self.a


class Angle(Struct, frozen=True):
    """Angle key of a link: from one directed line of it to another, degrees, ccw positive.

    ``AOD``: from OA to OD; ``ABCD``: from AB to CD.
    """

    key: str
    one: tuple[str, str]
    two: tuple[str, str]
    value: float


class LinkText(Struct):
    """One link as written.

    Attributes
    ----------
    node : FileNode
        Its place in the file; of a link that replaces a higher pair, that of the pair.
    sound : bool
        False once a fault has been noted in the link.
    is_complete : bool
        False when its points or its slide could not be read: then its joints are not
        used.
    faulty : set of str
        Points whose tables could not be read.
    arc : tuple of two str, or None
        Host and centre of a circular slot: its block is read as a link from the centre to the pin.
    """

    name: str
    node: FileNode
    points: tuple[str, ...] = ()
    lengths: list[Length] = field(default_factory=list)
    forms: dict[str, PointForm] = field(default_factory=dict)
    angles: list[Angle] = field(default_factory=list)
    slides: FileNode | None = None
    rolls: FileNode | None = None
    sound: bool = True
    is_complete: bool = True
    faulty: set[str] = field(default_factory=set)
    arc: tuple[str, str] | None = None

    def lengths_of(self, point: str) -> list[Length]:
        """Lengths that end in a point, in file order."""
        return [length for length in self.lengths if point in (length.a, length.b)]


def read_links(node: FileNode) -> dict[str, LinkText]:
    """Read ``[links.*]``, in file order."""
    node.table('[links.1] points = ["A", "B"]')
    if not node.value:
        node.note("the file has no links", hint='Add [links.1] with points = ["A", "B"].')
    node.require_at_most(keys.LINK_LIMIT, "{} links, the limit is {}")
    found: dict[str, LinkText] = {}
    for entry in node.entries():
        name = entry.attempt(partial(_read_name, known=found))
        if name is not None:
            link = found[name] = LinkText(name, entry)
            entry.attempt(partial(_read_link, link=link))
            link.is_complete = link.is_complete and isinstance(entry.value, Mapping)
            link.sound = entry.is_sound
    total = len({point for link in found.values() for point in link.points})
    node.require_at_most(keys.POINT_LIMIT, "{} points, the limit is {}", total)
    return found


def _read_name(node: FileNode, known: Collection[str]) -> str:
    """Return the name of a link, which is the key of its table."""
    name = str(node.key)
    name = node.unmask(name) if looks_latin(name) else name
    if name == FRAME:
        node.reject("the name 0 is the frame's (стойка)", hint="Number the links from 1.")
    node.check_label(name, "a link")
    if name in known:
        node.reject("link '{}' is given twice", name)
    return name


def _read_link(node: FileNode, link: LinkText) -> None:
    node.table('points = ["A", "B"]')
    node.require_at_most(keys.LINK_KEY_LIMIT, "{} keys in a link, the limit is {}")
    if "points" in node:
        node.read("points", partial(_read_points, link=link))
    else:
        hint = "Write points = [...] with the names of its points{}."
        node["points"].note("missing", hint=translate(hint, _list_points(node.value)))
        link.is_complete = False
    for entry in node.entries():
        if entry.key == "slides":
            link.slides = entry
            if not isinstance(entry.value, Mapping):
                entry.attempt(lambda slides: slides.table('slides = { on = "x-x" }'))
                entry.value = {}  # the link stays a slider: fewer follow-up faults
                link.is_complete = False
        elif entry.key == "rolls":
            link.rolls = entry
        elif entry.key == "angle":
            entry.attempt(partial(_read_angles, link=link))
        elif entry.key != "points":
            entry.attempt(partial(_read_key, link=link))
    if link.slides is not None and ("centre" in link.slides or "radius" in link.slides):
        arc = link.slides
        link.slides = None
        arc.attempt(partial(_read_arc, link=link))
        link.is_complete = link.is_complete and arc.is_sound


def _read_key(node: FileNode, link: LinkText) -> None:
    """Read a key that is named by points: a length, or the place of a third point."""
    name = node.unmask(str(node.key))
    if is_number(node.value) or (isinstance(node.value, str) and split_pair(name) is not None):
        _read_length_key(node, name, link)
    elif isinstance(node.value, dict) and is_point_name(name):
        node.attempt(partial(_read_form, point=name, link=link))
        if not node.is_sound:
            link.faulty.add(name)
    else:
        _note_odd_key(node, name, link)


def _read_arc(node: FileNode, link: LinkText) -> None:
    """Read a slide along a circle: its block moves as a link of that radius about its centre."""
    node.allow(keys.SLIDES)
    for key in node.value:
        if key not in keys.ARC:
            node[key].note("not valid with a circular guide", hint="Give on, centre, radius.")
    example = 'For example: slides = { on = "0", centre = "O2", radius = 0.2 }'
    for key in keys.ARC:
        if key not in node and node.is_sound:
            node[key].note("missing", hint=example)
    centre = node.read("centre", FileNode.point_name)
    host = node.read("on", lambda on: on.text(NAME_LIMIT))
    radius = node.read("radius", FileNode.length)
    if centre in link.points:
        node["centre"].note("{} is a point of the sliding block itself", centre)
    elif centre and host and radius and link.points:
        pin = link.points[0]
        link.arc, link.points = (host, centre), (centre, *link.points)
        link.lengths.insert(0, Length(f"{centre}{pin}", centre, pin, radius))


def check_arcs(links: Mapping[str, LinkText], fixed: Collection[str]) -> None:
    """Reject a circular slot whose centre is not a point of its link."""
    for link in links.values():
        host, centre = link.arc or (FRAME, "")
        known = fixed if host == FRAME else links[host].points if host in links else None
        if link.arc is None or (known is not None and centre in known):
            continue
        slides = link.node["slides"]
        if known is None:
            slides["on"].note_unknown(host, [FRAME, *links], "unknown link '{}'")
        else:
            owner = "the frame" if host == FRAME else f"link {host}"
            hint = translate("Its points are {}.", listed(known))
            slides["centre"].note("{} has no point '{}'", owner, centre, hint=hint)
        link.is_complete = link.sound = False


def _list_points(table: Table) -> str:
    pairs = [pair for key in table if (pair := split_pair(fold(key)))]
    points = list(dict.fromkeys(point for pair in pairs for point in pair))
    return f" ({listed(points)})" if points else ""


def _read_points(node: FileNode, link: LinkText) -> None:
    """Read the names of the points; the link is complete if all of them can be read."""
    complete, link.is_complete = link.is_complete, False
    node.array("a list of point names", 'For example: points = ["A", "B"]', low=1)
    node.require_at_most(keys.LINK_POINT_LIMIT, "{} points in a link, the limit is {}")
    names = [entry.attempt(FileNode.point_name) for entry in node.entries()]
    for index, name in enumerate(names):
        if name is not None and name in names[:index]:
            node[index].note("point '{}' is listed twice", name)
    link.points = tuple(dict.fromkeys(name for name in names if name is not None))
    link.is_complete = complete and None not in names


def _pair_names(points: Iterable[str]) -> list[str]:
    return [a + b for a, b in permutations(points, 2)]


def _read_length_key(node: FileNode, key: str, link: LinkText) -> None:
    pair = split_pair(key)
    if pair is None:
        example = "".join(link.points[:2]) if len(link.points) > 1 else "AB"
        hint = translate("A length is named by its two points: {}.", example)
        _note_unknown_key(node, key, link, hint)
        return
    strangers = [point for point in dict.fromkeys(pair) if point not in link.points]
    if strangers:
        if link.is_complete:
            names = translate(" and ").join(f"'{point}'" for point in strangers)
            adds = ", ".join(f'"{point}"' for point in strangers)
            hint = (
                "Its points are {}. If links are joined at {}, add {} to {}.points; a distance "
                "between points of two links changes as they move: the position of the driver is "
                "given by phi, x_B or another key of [driver]."
            )
            told = translate(hint, listed(link.points), listed(strangers), adds, link.node.path)
            node.note("link {} has no point {}", link.name, names, hint=told)
        return
    if pair[0] == pair[1]:
        node.reject("a length is between two different points")
    twin = next((known for known in link.lengths if {known.a, known.b} == set(pair)), None)
    if twin is not None:
        node.reject("the same length as {}", twin.key, hint="Keep one of them.")
    link.lengths.append(Length(key, *pair, node.length()))


def _read_angles(node: FileNode, link: LinkText) -> None:
    """Read ``angle.AOD = 120``: angles between the lines of a link."""
    node.table("angle.AOD = 120, from OA to OD")
    link.angles += node.read_each(partial(_read_angle, link=link)).values()


def _read_angle(node: FileNode, link: LinkText) -> Angle | None:
    letters = node.unmask(str(node.key))
    lines = angle_lines(letters)
    if lines is None:
        hint = "AOD is the angle from OA to OD, ABCD that from AB to CD."
        node.reject("expected the letters of an angle", hint=hint)
    strangers = [point for point in split_names(letters) if point not in link.points]
    if strangers and link.is_complete:
        hint = translate("Its points are {}.", listed(link.points))
        hint = _hint_for_slot(link, lines, node.value) or hint
        node.note("link {} has no point '{}'", link.name, strangers[0], hint=hint)
    angle = node.angle()
    return None if strangers else Angle(str(node.key), *lines, angle)


def _hint_for_slot(link: LinkText, lines: Sequence[tuple[str, ...]], value: object) -> str | None:
    """Return the hint for a slot whose line the file names by the pin of its sliding block."""
    own = link.points[:2]
    for (slot, arm), sign in (((lines[0], lines[1]), -1), ((lines[1], lines[0]), 1)):
        ends = [point for point in slot if point in link.points]
        if len(ends) != 1 or {*arm} != {*own} or not is_number(value):
            continue
        (pin,) = {*slot} - {*ends}
        turned = sign * float(value) + 180 * ((arm != own) + (slot[1] != pin))
        return translate(
            "Its points are {0}. If {1} is the pin of a sliding block on the line {2}{1}, "
            'omit this key and write at the block slides = {{ on = "{3}", through = "{2}", '
            "angle = {4:g} }}, the angle from {5} to {2}{1}.",
            listed(link.points), pin, ends[0], link.name, (turned + 180) % 360 - 180, "".join(own),
        )  # fmt: skip
    return None


def _note_odd_key(node: FileNode, key: str, link: LinkText) -> None:
    if split_pair(key) is not None:
        node.length()
    elif is_point_name(key):
        link.faulty.add(key)
        example = 'For example: {} = {{ on = "{}", at = 0.1 }}'
        hint = translate(example, key, "".join(link.points[:2]) or "BC")
        if isinstance(node.value, str) and node.value.startswith(("left of", "right of")):
            hint = translate('Write {}.side = "{}".', key, node.value)
        node.note_value("a table that places the point", hint)
    else:
        known = (*keys.LINK, *_pair_names(link.points))
        _note_unknown_key(node, key, link, translate("Known here: {}.", listed(known)))


def _note_unknown_key(node: FileNode, key: str, link: LinkText, hint: str) -> None:
    """Note a key that no link has; ``hint`` is for one that is near to none."""
    guess = nearest_name(key, (*keys.LINK, *_pair_names(link.points), *keys.known("mass")))
    if guess in keys.known("mass"):
        hint = translate("It belongs in [dynamics.links.{}]: {} = ...", segment(link.name), guess)
    elif guess:
        hint = translate("Did you mean '{}'?", guess)
    node.note("unknown key", hint=hint)


def _read_form(node: FileNode, point: str, link: LinkText) -> None:
    if point in link.points:
        owner = partial(translate, "link {}", link.name)
        link.forms[point] = read_form(node, point, link.points, owner)
    elif link.is_complete:  # else it may be the name that could not be read
        hint = translate('Add "{}" to {}.points or correct the name.', point, link.node.path)
        node.note("link {} has no point '{}'", link.name, point, hint=hint)
