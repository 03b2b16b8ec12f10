"""Prismatic pairs: guides of the frame and lines carried by links."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from msgspec import Struct

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.links import LinkText, read_label
from planmethod.problem.model import Body, Slide
from planmethod.problem.names import looks_latin, segment, split_pair
from planmethod.problem.placement import heading

Guide = tuple[str | None, complex, float]
"""Name of the fixed point (or None), base in m, angle in degrees."""


class FrameText(Struct, frozen=True):
    """Fixed points, m, and guides of the frame (стойка)."""

    points: Mapping[str, complex]
    guides: Mapping[str, Guide]
    number: str = FRAME
    sound: bool = True


def read_frame(faults: Faults, table: object) -> FrameText:
    """Read ``[frame]``."""
    before = len(faults)
    points: dict[str, complex] = {}
    entries = fields.read_table(faults, "frame", table, "[frame] A = [0, 0]") or {}
    if faults.exceeds("frame", "{} points, the limit is {}", len(entries), keys.POINT_LIMIT):
        return FrameText({}, {}, sound=False)
    rest: object = {}
    number = FRAME
    for key, value in entries.items():
        if key == "guides":
            rest = value
            continue
        if key == "number":
            whole = fields.read_integer(faults, "frame.number", value, 0, 99)
            number = FRAME if whole is None else str(whole)
            continue
        path = f"frame.{segment(key)}"
        if isinstance(value, Mapping):
            fields.report_unknown(faults, path, key, keys.FRAME)
            continue
        name = fields.read_point_name(faults, path, key)
        place = fields.read_place(faults, path, value)
        if name is not None and name in points:
            faults.add(path, translate("point '{}' is given twice", name))
        elif name is not None:
            # a point with a faulty place is still a point: others may name it
            points[name] = 0j if place is None else place
    guides = _read_guides(faults, rest, points)
    return FrameText(points, guides, number, sound=len(faults) == before)


def _read_guides(faults: Faults, table: object, points: Mapping[str, complex]) -> dict[str, Guide]:
    example = 'guides.x-x = { through = "A", angle = 0 }'
    entries = fields.read_table(faults, "frame.guides", table, example) or {}
    guides: dict[str, Guide] = {}
    if faults.exceeds("frame.guides", "{} guides, the limit is {}", len(entries), keys.POINT_LIMIT):
        return guides
    for key, value in entries.items():
        path = f"frame.guides.{segment(key)}"
        name = fields.unmask(faults, path, key) if looks_latin(key) else key
        if not read_label(faults, path, name, "a guide"):
            continue
        guides[name] = (None, 0j, 0.0)
        body = fields.read_table(faults, path, value, example)
        if body is None:
            continue
        given = fields.read_keys(faults, path, body, keys.GUIDE)
        for missing in (key for key in keys.GUIDE if key not in given):
            faults.add(f"{path}.{missing}", "missing", translate("For example: {}", example))
        through: str | None = None
        base: complex | None = 0j
        if isinstance(given.get("through"), str):
            through = fields.read_known_point(
                faults, f"{path}.through", given["through"], points, of="the frame"
            )
            base = points.get(through, 0j) if through else None
        elif "through" in given:
            base = fields.read_place(faults, f"{path}.through", given["through"])
        angle = fields.read_angle(faults, f"{path}.angle", given.get("angle", 0.0))
        if base is not None and angle is not None:
            guides[name] = (through, base, angle)
    return guides


def find_host(
    faults: Faults, link: LinkText, links: Mapping[str, LinkText], frame: FrameText
) -> tuple[str, str | None] | None:
    """Return the host of a slider and the guide it is on, if it is a guide."""
    assert link.slides is not None
    path = f"{link.path}.slides"
    known = (*frame.guides, *(name for name in links if name != link.name))
    before = len(faults)
    link.slides = fields.read_keys(faults, path, link.slides, keys.SLIDES)
    if "on" not in link.slides:
        if link.sound and len(faults) == before:
            faults.add(f"{path}.on", "missing", "Name a guide of the frame or a link.")
        return None
    value = link.slides["on"]
    if not isinstance(value, str):
        hint = translate('Write on = "{}".', value) if isinstance(value, int) else ""
        faults.expected(f"{path}.on", "the name of a guide or link", value, hint)
        return None
    name = value if value in known else fields.unmask(faults, f"{path}.on", value)
    if name in frame.guides:
        return FRAME, name
    if name == FRAME:
        return FRAME, None
    if name == link.name:
        faults.add(f"{path}.on", translate("link {} cannot slide on itself", name))
        return None
    if name not in links:
        fields.report_unknown(
            faults, f"{path}.on", name, known, message="unknown guide or link '{}'"
        )
        return None
    return name, None


def order_hosts(faults: Faults, hosts: Mapping[str, str]) -> list[str]:
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
                names = translate(" on ").join([*circle, circle[0]])
                faults.add(
                    f"links.{segment(start)}.slides.on",
                    translate("links slide on each other in a circle: {}", names),
                    "One of them must carry the line without sliding itself.",
                )
            continue
        ordered.extend(reversed(chain))
    return ordered


def read_slide(
    faults: Faults,
    link: LinkText,
    host: str,
    guide: str | None,
    body: Body,
    frame: FrameText,
    *,
    turn: float | None,
    angle_optional: bool,
) -> Slide | None:
    """Read one prismatic pair: its line, and its length of contact where one is given.

    Parameters
    ----------
    body : Body
        The host's points (the fixed points when the host is the frame).
    turn : float or None, degrees
        Direction of the host's own axis from +x when the host only translates, else None.
    angle_optional : bool
        Whether this line is itself the host's own axis, unless a mark and an angle are given.
    """
    assert link.slides is not None
    path, given, length = f"{link.path}.slides", link.slides, None
    if "length" in given:
        length = fields.read_length(faults, f"{path}.length", given["length"])
    before = len(faults)  # a faulty length does not hide the line
    offset = fields.read_coordinate(faults, f"{path}.offset", given.get("offset", 0.0)) or 0.0
    if not link.points:
        return None
    pin = link.points[0]
    if guide is not None:
        for key in ("along", "through", "angle"):
            if key in given:
                hint = translate("The line is given in frame.guides.{}.", guide)
                faults.add(
                    f"{path}.{key}", translate("does not go with the guide '{}'", guide), hint
                )
        if len(faults) != before:
            return None
        fixed, base, direction = frame.guides[guide]
        return Slide(link.name, FRAME, pin, base, direction, offset, guide, fixed, length=length)

    def owner() -> str:
        return "the frame" if host == FRAME else translate("link {}", host)

    if "along" in given:
        for key in ("through", "angle"):
            if key in given:
                hint = "The line is given by along, or by through and angle."
                faults.add(f"{path}.{key}", "does not go with 'along'", hint)
        line = _read_along(faults, f"{path}.along", given["along"], pin, body, owner)
        if line is None or len(faults) != before:
            return None
        start, end = body.points[line[0]], body.points[line[1]]
        if start == end:
            faults.add(f"{path}.along", translate("{} and {} are one place", line[0], line[1]))
            return None
        along = heading(end - start)
        label = "".join(line)
        return Slide(link.name, host, pin, start, along, offset, label, *line, length)
    through = _read_through(faults, path, given, body, owner)
    if "through" not in given:
        return None
    marked = body.axis is not None
    angle = _read_slide_angle(
        faults, path, given, host, turn=turn, angle_optional=angle_optional, marked=marked
    )
    if through is None or angle is None or len(faults) != before:
        return None
    base = body.points[through]
    return Slide(link.name, host, pin, base, angle, offset, through, through, length=length)


def _read_along(
    faults: Faults,
    path: str,
    value: object,
    pin: str,
    body: Body,
    owner: Callable[[], str],
) -> tuple[str, str] | None:
    """Read the two points of a line; the pin of the sliding block itself is rejected."""
    pair = split_pair(value) if isinstance(value, str) else None
    points = list(body.points)
    if pair is None or pin not in pair or pin in points or len(points) < 2:
        return fields.read_line_name(faults, path, value, points, of=owner)
    start = next((point for point in pair if point in points), points[0])
    faults.add(
        path,
        translate("{} is the pin of the stone, no point of {}", pin, owner()),
        translate(
            'A line needs no second point: through = "{0}", angle = 0 is a slot along {1}, angle = '
            "90 one across it.",
            start,
            "".join(points[:2]),
        ),
    )
    return None


def _read_through(
    faults: Faults, path: str, table: Table, body: Body, owner: Callable[[], str]
) -> str | None:
    if "through" not in table:
        points = list(body.points)
        pair = "".join(points[:2]) if len(points) > 1 else ""
        ways = [f'along = "{pair}"'] if pair else []
        ways += [f'through = "{points[0]}", angle = 0'] if points else []
        faults.add(
            path,
            translate("no line of {} is named", owner()),
            translate("Add {}.", translate(" or ").join(ways)) if ways else "",
        )
        return None
    return fields.read_known_point(
        faults, f"{path}.through", table["through"], body.points, of=owner
    )


def _read_slide_angle(
    faults: Faults,
    path: str,
    table: Table,
    host: str,
    *,
    turn: float | None,
    angle_optional: bool,
    marked: bool,
) -> float | None:
    """Angle of the line from the host's own axis, degrees."""
    if "angle" not in table:
        if angle_optional:
            return 0.0
        axis = "+x" if turn is not None else translate("the own axis of link {}", host)
        faults.add(f"{path}.angle", "missing", translate("Give it in degrees from {}.", axis))
        return None
    angle = fields.read_angle(faults, f"{path}.angle", table["angle"])
    if angle is None:
        return None
    if angle_optional and not marked and angle != 0:
        faults.add(
            f"{path}.angle",
            translate("expected 0 or nothing, got {:g}", angle),
            translate("Link {} has no axis other than the line it carries.", host),
        )
        return None
    # the file counts from +x where the host cannot turn: that is what the figure shows
    return _principal(angle - turn) if turn else angle


def _principal(angle: float) -> float:
    """Angle brought into (-180, 180] degrees."""
    turned = angle % 360.0
    return turned - 360.0 if turned > 180.0 else turned
