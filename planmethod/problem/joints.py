"""Joints of the links: the mechanism behind the points and slides, and its cross checks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import combinations

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute
from planmethod.problem.file_node import FileNode
from planmethod.problem.links import LinkText
from planmethod.problem.model import Slide
from planmethod.problem.names import listed
from planmethod.problem.slides import FrameText


def join(
    node: FileNode,
    frame: FrameText,
    links: Mapping[str, LinkText],
    hosts: Mapping[str, str],
    driver: str,
    *,
    complete: bool,
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
        _check_reach(links, revolutes, prismatics, driver)
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
) -> None:
    touching: dict[str, list[tuple[str, ...]]] = {name: [] for name in (FRAME, *links)}
    for joint in revolutes:
        for name in joint.links:
            touching[name].append(joint.links)
    for slide in prismatics:
        touching[slide.slider].append((slide.slider, slide.host))
        touching[slide.host].append((slide.slider, slide.host))
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
                "the point of link {} under the pin {} is called {}, and another point has this "
                "name",
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
