"""Joints of the links: the mechanism behind the points and slides, and its cross checks."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from itertools import combinations

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Mechanism, Prismatic, Revolute
from planmethod.problem.fields import Faults
from planmethod.problem.links import LinkText
from planmethod.problem.model import Slide
from planmethod.problem.names import listed
from planmethod.problem.slides import FrameText


def join(
    faults: Faults,
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
    _reject_duplicates(faults, revolutes, prismatics)
    if complete:
        _check_reach(faults, links, revolutes, prismatics, driver)
    _check_coincident(faults, links_by_point, prismatics)
    _check_letters(faults, links_by_point)
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
    faults: Faults, revolutes: tuple[Revolute, ...], prismatics: tuple[Prismatic, ...]
) -> None:
    shared: dict[tuple[str, str], list[str]] = {}
    for joint in revolutes:
        for pair in combinations(joint.links, 2):
            shared.setdefault(pair, []).append(joint.point)
    for (one, two), points in shared.items():
        if len(points) > 1:
            faults.add(
                f"links.{two}.points",
                translate(
                    "{} and link {} share the points {}: they make one rigid body",
                    _called(one),
                    two,
                    translate(" and ").join(points),
                ),
                "Two links are joined at one point; give the other points other names.",
            )
    for slide in prismatics:
        pair = (slide.host, slide.slider)
        points = shared.get(pair) or shared.get(pair[::-1]) or []
        if points:
            faults.add(
                f"links.{slide.slider}.slides",
                translate(
                    "link {} slides on {} and is pivoted to it in {}: they make one rigid body",
                    slide.slider,
                    _called(slide.host),
                    points[0],
                ),
                translate(
                    "The pin of a slider is not a point of the link that carries its line; "
                    "remove {} from one of them.",
                    points[0],
                ),
            )


def _check_reach(
    faults: Faults,
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
            faults.add(
                link.path,
                translate("link {} is not joined to the frame through other links", name),
                translate(
                    "Links are joined by points of the same name and by slides: check the names "
                    "{}.",
                    listed(link.points),
                ),
            )
        elif name != driver and len(touching[name]) < 2:
            where = next((p for p in link.points if any(j.point == p for j in revolutes)), None)
            faults.add(
                link.path,
                translate("link {} has one joint only{}", name, f", {where}" if where else ""),
                "It would move freely: join another of its points, or make them points of the "
                "link it is joined to.",
            )


def _check_coincident(
    faults: Faults, links_by_point: Mapping[str, list[str]], prismatics: tuple[Prismatic, ...]
) -> None:
    for slide in prismatics:
        name = f"{slide.pin}{slide.host}"
        if slide.host != FRAME and name in links_by_point:
            faults.add(
                f"links.{slide.slider}.slides",
                translate(
                    "the point of link {} under the pin {} is called {}, and another point has "
                    "this name",
                    slide.host,
                    slide.pin,
                    name,
                ),
                translate("Rename the point {}.", name),
            )


def _check_letters(faults: Faults, points: Iterable[str]) -> None:
    """Reject points that differ only in case: on the plans both have the same small letter."""
    seen: dict[str, str] = {}
    for point in points:
        twin = seen.setdefault(point.casefold(), point)
        if twin != point:
            faults.add(
                "links",
                translate(
                    "the points {} and {} differ only in case: on the plans both are {}",
                    twin,
                    point,
                    point.lower(),
                ),
                translate("Rename the point {}.", point),
            )
