"""Links of the file as written: points, lengths, third points and slides, not yet placed."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import permutations

from msgspec import Struct, field

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.model import PointForm
from planmethod.problem.names import (
    NAME_LIMIT,
    angle_lines,
    fold,
    is_label,
    is_point_name,
    listed,
    looks_latin,
    nearest_name,
    segment,
    split_names,
    split_pair,
)
from planmethod.problem.pointforms import read_form


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
    sound : bool
        False once a fault has been noted in the link.
    is_complete : bool
        False when its points or its slide could not be read: then its joints are not
        used.
    faulty : set of str
        Points whose tables could not be read.
    arc : tuple of two str, or None
        Host and centre of a circular slot: its block is read as a link from the centre to the pin.
    location : str
        Path of the higher pair that the link replaces; empty for a link of the file.
    """

    name: str
    points: tuple[str, ...] = ()
    lengths: list[Length] = field(default_factory=list)
    forms: dict[str, PointForm] = field(default_factory=dict)
    angles: list[Angle] = field(default_factory=list)
    slides: Table | None = None
    sound: bool = True
    is_complete: bool = True
    faulty: set[str] = field(default_factory=set)
    arc: tuple[str, str] | None = None
    location: str = ""

    @property
    def path(self) -> str:
        """Dotted path of the link, or of its source in the file."""
        return self.location or f"links.{segment(self.name)}"

    def lengths_of(self, point: str) -> list[Length]:
        """Lengths that end in a point, in file order."""
        return [length for length in self.lengths if point in (length.a, length.b)]


def read_label(faults: Faults, path: str, name: str, noun: str) -> bool:
    """Check the name of a link, a guide or a variant."""
    if is_label(name):
        return True
    faults.add(
        path,
        translate("{!r} cannot name {}", name[:40], noun),
        translate("Use letters and digits, at most {}.", NAME_LIMIT),
    )
    return False


def read_links(faults: Faults, table: object) -> dict[str, LinkText]:
    """Read ``[links.*]``, in file order."""
    found: dict[str, LinkText] = {}
    entries = fields.read_table(faults, "links", table, '[links.1] points = ["A", "B"]')
    if entries is None:
        return found
    if not entries:
        faults.add("links", "the file has no links", 'Add [links.1] with points = ["A", "B"].')
    if faults.exceeds("links", "{} links, the limit is {}", len(entries), keys.LINK_LIMIT):
        return found
    for key, value in entries.items():
        path = f"links.{segment(key)}"
        name = fields.unmask(faults, path, key) if looks_latin(key) else key
        if name == FRAME:
            faults.add(path, "the name 0 is the frame's (стойка)", "Number the links from 1.")
            continue
        if not read_label(faults, path, name, "a link"):
            continue
        if name in found:
            faults.add(path, translate("link '{}' is given twice", name))
            continue
        body = fields.read_table(faults, path, value, 'points = ["A", "B"]')
        before = len(faults)
        link = LinkText(name) if body is None else _read_link(faults, path, name, body)
        link.sound = link.sound and body is not None and len(faults) == before
        link.is_complete = link.is_complete and body is not None
        found[name] = link
    total = len({point for link in found.values() for point in link.points})
    if faults.exceeds("links", "{} points, the limit is {}", total, keys.POINT_LIMIT):
        return {}
    return found


def _read_link(faults: Faults, path: str, name: str, table: Table) -> LinkText:
    link = LinkText(name)
    if faults.exceeds(path, "{} keys in a link, the limit is {}", len(table), keys.LINK_KEY_LIMIT):
        return link
    if "points" in table:
        link.points, link.is_complete = _read_points(faults, f"{path}.points", table["points"])
    else:
        hint = translate(
            "Write points = [...] with the names of its points{}.", _list_points(table)
        )
        faults.add(f"{path}.points", "missing", hint)
        link.is_complete = False
    for key, value in table.items():
        where = f"{path}.{segment(key)}"
        if key == "points":
            continue
        if key == "slides":
            link.slides = fields.read_table(faults, where, value, 'slides = { on = "x-x" }')
            if link.slides is None:
                link.slides = {}  # the link stays a slider: fewer follow-up faults
                link.is_complete = False
            continue
        if key == "angle":
            _read_angles(faults, where, value, link)
            continue
        plain = fields.unmask(faults, where, key)
        if fields.is_number(value) or (isinstance(value, str) and split_pair(plain) is not None):
            _read_length_key(faults, where, plain, value, link)
        elif isinstance(value, dict) and is_point_name(plain):
            before = len(faults)
            _read_form(faults, where, plain, value, link)
            if len(faults) != before:
                link.faulty.add(plain)
        else:
            _report_odd_key(faults, where, plain, value, link)
    if link.slides is not None and {"centre", "radius"} & link.slides.keys():
        _read_arc(faults, f"{path}.slides", link)
    return link


def _read_arc(faults: Faults, path: str, link: LinkText) -> None:
    """Read a slide along a circle: its block moves as a link of that radius about its centre."""
    before = len(faults)
    given = fields.read_keys(faults, path, link.slides or {}, keys.SLIDES)
    link.slides = None
    for key in given:
        if key not in keys.ARC:
            faults.add(f"{path}.{key}", "does not go with a circle", "Give on, centre, radius.")
    for key in keys.ARC:
        if key not in given and len(faults) == before:
            hint = 'For example: slides = { on = "0", centre = "O2", radius = 0.2 }'
            faults.add(f"{path}.{key}", "missing", hint)
    centre = host = None
    if "centre" in given:
        centre = fields.read_point_name(faults, f"{path}.centre", given["centre"])
    if "on" in given:
        host = fields.read_text(faults, f"{path}.on", given["on"], limit=NAME_LIMIT)
    radius = (
        fields.read_length(faults, f"{path}.radius", given["radius"]) if "radius" in given else None
    )
    if centre in link.points:
        faults.add(f"{path}.centre", translate("{} is a point of the stone itself", centre))
    if centre and host and radius and link.points and centre not in link.points:
        pin = link.points[0]
        link.arc, link.points = (host, centre), (centre, *link.points)
        link.lengths.insert(0, Length(f"{centre}{pin}", centre, pin, radius))
    link.is_complete = link.is_complete and len(faults) == before


def check_arcs(faults: Faults, links: Mapping[str, LinkText], fixed: Collection[str]) -> None:
    """Reject a circular slot whose centre is not a point of its link."""
    for link in links.values():
        host, centre = link.arc or (FRAME, "")
        known = fixed if host == FRAME else links[host].points if host in links else None
        if link.arc is None or (known is not None and centre in known):
            continue
        path = f"{link.path}.slides"
        if known is None:
            fields.report_unknown(
                faults, f"{path}.on", host, [FRAME, *links], message="unknown link '{}'"
            )
        else:
            owner = "the frame" if host == FRAME else f"link {host}"
            hint = translate("Its points are {}.", listed(known))
            faults.add(f"{path}.centre", translate("{} has no point '{}'", owner, centre), hint)
        link.is_complete = link.sound = False


def _list_points(table: Table) -> str:
    pairs = [pair for key in table if (pair := split_pair(fold(key)))]
    points = list(dict.fromkeys(point for pair in pairs for point in pair))
    return f" ({listed(points)})" if points else ""


def _read_points(faults: Faults, path: str, value: object) -> tuple[tuple[str, ...], bool]:
    """Names of the points, and whether all of them could be read."""
    if not isinstance(value, list) or not value:
        hint = 'For example: points = ["A", "B"]'
        faults.expected(path, "a list of point names", value, hint)
        return (), False
    if faults.exceeds(
        path, "{} points in a link, the limit is {}", len(value), keys.LINK_POINT_LIMIT
    ):
        return (), False
    points: list[str] = []
    whole = True
    for index, item in enumerate(value):
        name = fields.read_point_name(faults, f"{path}[{index}]", item)
        if name is None:
            whole = False
        elif name in points:
            faults.add(f"{path}[{index}]", translate("point '{}' is listed twice", name))
        else:
            points.append(name)
    return tuple(points), whole


def _pair_names(points: Iterable[str]) -> list[str]:
    return [a + b for a, b in permutations(points, 2)]


def _read_length_key(faults: Faults, path: str, key: str, value: object, link: LinkText) -> None:
    pair = split_pair(key)
    if pair is None:
        example = "".join(link.points[:2]) if len(link.points) > 1 else "AB"
        hint = translate("A length is named by its two points: {}.", example)
        _report_unknown_key(faults, path, key, link, hint)
        return
    strangers = [point for point in dict.fromkeys(pair) if point not in link.points]
    if strangers:
        if link.is_complete:
            names = translate(" and ").join(f"'{point}'" for point in strangers)
            adds = ", ".join(f'"{point}"' for point in strangers)
            faults.add(
                path,
                translate("link {} has no point {}", link.name, names),
                translate(
                    "Its points are {}. If links are joined at {}, add {} to {}.points; a "
                    "distance between points of two links changes as they move: the "
                    "position of the driver is given by phi, x_B or another key of "
                    "[driver].",
                    listed(link.points),
                    listed(strangers),
                    adds,
                    link.path,
                ),
            )
        return
    if pair[0] == pair[1]:
        faults.add(path, "a length is between two different points")
        return
    twin = next((known for known in link.lengths if {known.a, known.b} == set(pair)), None)
    if twin is not None:
        faults.add(path, translate("the same length as {}", twin.key), "Keep one of them.")
        return
    length = fields.read_length(faults, path, value)
    if length is not None:
        link.lengths.append(Length(key, *pair, length))


def _read_angles(faults: Faults, path: str, value: object, link: LinkText) -> None:
    """Read ``angle.AOD = 120``: angles between the lines of a link."""
    entries = fields.read_table(faults, path, value, "angle.AOD = 120, from OA to OD") or {}
    for key, item in entries.items():
        where = f"{path}.{segment(key)}"
        letters = fields.unmask(faults, where, key)
        lines = angle_lines(letters)
        if lines is None:
            hint = "AOD is the angle from OA to OD, ABCD that from AB to CD."
            faults.add(where, "expected the letters of an angle", hint)
            continue
        strangers = [
            point for point in dict.fromkeys(split_names(letters)) if point not in link.points
        ]
        if strangers and link.is_complete:
            hint = _hint_for_slot(link, lines, item) or translate(
                "Its points are {}.", listed(link.points)
            )
            faults.add(where, translate("link {} has no point '{}'", link.name, strangers[0]), hint)
        angle = fields.read_angle(faults, where, item)
        if angle is not None and not strangers:
            link.angles.append(Angle(key, *lines, angle))


def _hint_for_slot(link: LinkText, lines: Sequence[tuple[str, ...]], value: object) -> str | None:
    """Return the hint for a slot whose line the file names by the pin of its sliding block."""
    own = link.points[:2]
    for (slot, arm), sign in (((lines[0], lines[1]), -1), ((lines[1], lines[0]), 1)):
        ends = [point for point in slot if point in link.points]
        if len(ends) != 1 or {*arm} != {*own} or not fields.is_number(value):
            continue
        (pin,) = {*slot} - {*ends}
        turned = sign * float(value) + 180 * ((arm != own) + (slot[1] != pin))
        return translate(
            "Its points are {0}. Where {1} is the pin of a stone on the line {2}{1}, leave this "
            'key out and write on the stone slides = {{ on = "{3}", through = "{2}", angle = '
            "{4:g} }}, the angle from {5} to {2}{1}.",
            listed(link.points), pin, ends[0], link.name, (turned + 180) % 360 - 180, "".join(own),
        )  # fmt: skip
    return None


def _report_odd_key(faults: Faults, path: str, key: str, value: object, link: LinkText) -> None:
    if split_pair(key) is not None:
        fields.read_length(faults, path, value)
    elif is_point_name(key):
        link.faulty.add(key)
        hint = translate(
            'For example: {} = {{ on = "{}", at = 0.1 }}', key, "".join(link.points[:2]) or "BC"
        )
        if isinstance(value, str) and value.startswith(("left of", "right of")):
            hint = translate('Write {}.side = "{}".', key, value)
        faults.expected(path, "a table that places the point", value, hint)
    else:
        known = (*keys.LINK, *_pair_names(link.points))
        _report_unknown_key(faults, path, key, link, translate("Known here: {}.", listed(known)))


def _report_unknown_key(faults: Faults, path: str, key: str, link: LinkText, hint: str) -> None:
    """Note a key that no link has; ``hint`` is for one that is near to none."""
    guess = nearest_name(key, (*keys.LINK, *_pair_names(link.points), *keys.known("mass")))
    if guess in keys.known("mass"):
        hint = translate("It belongs in [dynamics.links.{}]: {} = ...", segment(link.name), guess)
    elif guess:
        hint = translate("Did you mean '{}'?", guess)
    faults.add(path, "unknown key", hint)


def _read_form(faults: Faults, path: str, point: str, value: Table, link: LinkText) -> None:
    if point not in link.points:
        if not link.is_complete:
            return  # it may be the name that could not be read
        faults.add(
            path,
            translate("link {} has no point '{}'", link.name, point),
            translate('Add "{}" to {}.points or correct the name.', point, link.path),
        )
        return
    form = read_form(
        faults, path, point, value, link.points, lambda: translate("link {}", link.name)
    )
    if form is not None:
        link.forms[point] = form
