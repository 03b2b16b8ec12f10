"""Read the parts of a problem file in turn, from its parsed TOML."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeAlias

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism
from planmethod.problem import keys
from planmethod.problem.answers import AnswerScope, read_answers
from planmethod.problem.cycle import cycle_count, read_cycle, with_cycle_count
from planmethod.problem.drive import read_assembly, read_drive, read_scales
from planmethod.problem.fields import Faults, read_keys, read_units
from planmethod.problem.joints import coincident_points, join
from planmethod.problem.links import LinkText, check_arcs, read_links
from planmethod.problem.model import Body, CamDrive, GearDrive, Problem, Slide
from planmethod.problem.names import listed
from planmethod.problem.placement import place_points
from planmethod.problem.project import read_project
from planmethod.problem.selector import check_quantity, read_published, read_tables
from planmethod.problem.sheet import read_head
from planmethod.problem.slides import FrameText, find_host, order_hosts, read_frame, read_slide

TrainReader: TypeAlias = Callable[
    [Faults, Mapping[str, Any], Mapping[str, Any]], GearDrive | CamDrive | None
]
"""Reader of ``[gears]`` or ``[cam]`` for the driver: faults, the file, ``[driver]``."""


def read_parts(
    faults: Faults, table: Mapping[str, Any], name: str, train: TrainReader | None
) -> Problem | None:
    """Read a linkage; None after noting a fault.

    Parameters
    ----------
    name : str
        Name of the problem.
    train : callable, optional
        Reads the train, or the cam, that drives.
    """
    given = read_keys(faults, "", table, keys.TOP)
    read_units(faults, given)
    head = read_head(faults, given)
    scales = read_scales(faults, given.get("scales", {}))
    tables = read_tables(faults, given)
    if "links" not in given:
        _report_no_links(faults, given)
        read_frame(faults, given.get("frame", {}))
        return None
    for key in ("frame", "driver"):
        if key not in given:
            faults.add(key, "missing", _MISSING[key])
    drivers = _drivers(given)
    if len(drivers) > 1:
        given["driver"] = drivers[0]
    frame = read_frame(faults, given.get("frame", {}))
    links = read_links(faults, given["links"])
    if "frame" not in given:
        return None
    higher: tuple[HigherPair, ...] = ()
    before = len(faults)
    if "higher_pairs" in given:
        from planmethod.problem.higher import read_higher  # few files have any

        higher = read_higher(faults, given["higher_pairs"], links, frame)
    replaced = len(faults) == before
    check_arcs(faults, links, frame.points)
    for guide in frame.guides:
        if guide in links:
            hint = "Rename the guide, for instance x-x."
            faults.add(f"frame.guides.{guide}", translate("link {} has the same name", guide), hint)
    hosts, guides = _find_hosts(faults, links, frame)
    bodies = _place(faults, links, frame, hosts)
    slides = _read_slides(faults, links, frame, hosts, guides, bodies)
    drive = None
    if "driver" in given and links:
        geared = _read_geared(faults, given, train)
        numbered = cycle_count(given)
        drive = read_drive(faults, given["driver"], links, frame.points, hosts, geared, numbered)
    driver = drive.link if drive else str(_driver_name(given))
    complete = (
        bool(links)
        and frame.sound
        and replaced
        and len(links) - len(higher) == len(given["links"])
        and all(link.is_complete for link in links.values())
    )
    mechanism = join(faults, frame, links, hosts, driver, complete=complete) if links else None
    if frame.number in links:
        hint = "The frame has a number of its own: 0, or one that no link has."
        faults.add("frame.number", translate("link {} has the same number", frame.number), hint)
    elif mechanism is not None:
        mechanism = replace(mechanism, frame=frame.number, higher=higher)
    if len(drivers) > 1:
        _reject_drivers(faults, drivers, mechanism if complete else None)
    moving = [p for link in links.values() for p in link.points if p not in frame.points]
    moving = list(dict.fromkeys(moving))
    assembly = read_assembly(faults, given.get("assembly", {}), moving, frame.points)
    dynamics = machine = None
    if "machine" in given:
        from planmethod.problem.machine import read_machine  # few files have one

        machine = read_machine(faults, given, drive)
    if "dynamics" in given or "loads" in given:
        from planmethod.problem.dynamics import read_dynamics  # few files have any

        dynamics = read_dynamics(faults, given, links, frame.points, drive, machine)
    if "balancing_force" in given:
        from planmethod.problem.dynamics import read_balancing_force  # few files have one

        pushed = read_balancing_force(faults, given, links, drive)
        drive = None if drive is None else replace(drive, pushed=pushed)
    if "friction" in given:
        from planmethod.problem.dynamics import read_friction  # few files have any

        friction = read_friction(faults, given, links, drive, [*frame.points, *moving])
        dynamics = None if dynamics is None else replace(dynamics, friction=friction)
    if "bearings" in given:
        from planmethod.problem.dynamics import read_bearings  # few files have any

        turning = (
            [one.point for one in mechanism.revolutes if FRAME in one.links] if mechanism else []
        )
        bearings = read_bearings(faults, given, turning) if mechanism else {}
        dynamics = None if dynamics is None else replace(dynamics, bearings=bearings)
    balancing = None
    if "balancing" in given:
        from planmethod.problem.dynamics import read_balancing  # few files have one

        balancing = read_balancing(faults, given, tuple(links), drive, dynamics)
    cycle = None
    if "cycle" in given:
        count = cycle_count(given)
        cycle = read_cycle(faults, given["cycle"], bodies, slides, drive, machine, count)
        if cycle is not None and machine is not None:
            machine = with_cycle_count(faults, machine, cycle)
    project = read_project(faults, given["project"]) if "project" in given else None
    points = [*frame.points, *moving, *coincident_points(slides.values())]
    named: tuple[Sequence[str], Sequence[str]] = ((), ()) if faults else (points, tuple(links))

    def checked(path: str, quantity: str, _: str) -> str:
        if quantity:
            check_quantity(faults, path, quantity, *named, dynamics)
        return quantity

    count = len(drive.positions) if drive else 0
    if project is not None and cycle is not None:  # its positions are those of the cycle
        count = cycle.count if machine is None else cycle.count * round(machine.cycle_deg / 360.0)
    published = read_published(faults, given.get("published", {}), checked, positions=count)
    scene = AnswerScope(
        () if faults else points,
        () if faults else tuple(links),
        mechanism.revolutes if mechanism else (),
        slides,
        dynamics,
        drive,
    )
    answers = read_answers(faults, given, scene)
    if faults or drive is None or mechanism is None:
        assert faults, "a part was left out without a word"
        return None
    return Problem(
        name=name,
        **head,
        unit=faults.unit,
        stated=dict(faults.stated),
        vanished=dict(faults.vanished),
        mechanism=mechanism,
        bodies=bodies,
        slides={link: slides[link] for link in links if link in slides},
        drive=drive,
        lengths=tuple(
            (link.name, length.key, length.value)
            for link in links.values()
            for length in link.lengths
        ),
        guides=frame.guides,
        assembly=assembly,
        scales=scales,
        published=published,
        answers=answers,
        dynamics=dynamics,
        cycle=cycle,
        project=project,
        machine=machine,
        balancing=balancing,
        tables=tables,
    )


_MISSING = {
    "frame": "Give the fixed points: [frame] A = [0, 0].",
    "driver": 'Give the driving link: [driver] link = "1", phi = 20, omega = 50.',
}


_OTHER_KINDS = {
    "gears": "a gear train",
    "cam": "a cam mechanism",
    "meshing": "two wheels in mesh",
    "point": "a moving point",
}


def _report_no_links(faults: Faults, document: Mapping[str, Any]) -> None:
    for key, what in _OTHER_KINDS.items():
        if key in document:
            faults.add(
                "links",
                translate("missing: the file describes {} ([{}]), not a linkage", what, key),
                "Plans of a linkage need [frame], [links] and [driver].",
            )
            return
    faults.add("links", "missing", 'Give the links: [links.1] points = ["A", "B"], AB = 0.1.')


def _read_geared(
    faults: Faults, document: Mapping[str, Any], train: TrainReader | None
) -> GearDrive | CamDrive | None:
    """Read the train that the driver names, or the cam whose follower drives."""
    driver = document["driver"]
    if not isinstance(driver, Mapping):
        return None
    if "train" in driver and not isinstance(document.get("gears"), Mapping):
        faults.add("driver.train", "the file has no train", "Describe it in [gears].")
    elif "cam" in driver and not isinstance(document.get("cam"), Mapping):
        faults.add("driver.cam", "the file has no cam", "Describe it in [cam].")
    elif ("train" in driver or "cam" in driver) and train is None:
        key = "train" if "train" in driver else "cam"
        hint = "Read the file by planmethod.load or planmethod.loads."
        faults.add(f"driver.{key}", "trains and cams are not read here", hint)
    elif ("train" in driver or "cam" in driver) and train is not None:
        return train(faults, document, driver)
    return None


def _drivers(document: Mapping[str, Any]) -> list[Mapping[str, Any]]:
    """Return the drivers: several as a list of tables, or as a list of links."""
    driver = document.get("driver")
    listed_links = driver.get("link") if isinstance(driver, Mapping) else None
    if isinstance(driver, Mapping) and isinstance(listed_links, list):
        return [{**driver, "link": link} for link in listed_links]
    return [one for one in driver if isinstance(one, Mapping)] if isinstance(driver, list) else []


def _reject_drivers(
    faults: Faults, drivers: Sequence[Mapping[str, Any]], mechanism: Mechanism | None
) -> None:
    """Note why several drivers are rejected: their names, and the number the mechanism needs."""
    count, names = len(drivers), listed(str(one.get("link", "?")) for one in drivers)
    message = translate("{} drivers are given: links {}", count, names)
    hint = "Plans are made of mechanisms with one: keep one, and join the others to it."
    if mechanism is not None:
        n, pairs = len(mechanism.links), mechanism.lower_pairs
        mobility = 3 * n - 2 * pairs
        message += f"; W = 3n - 2p1 = 3·{n} - 2·{pairs} = {mobility}"
        if mobility == 1:
            hint = "One driver moves all links of this mechanism: keep one of them."
        elif mobility == count:
            hint = translate(
                "The mechanism needs {}, and plans are made of mechanisms with W = 1: "
                "give a pair that joins two of the drivers, or take one of them as fixed.",
                count,
            )
    faults.add("driver", message, hint)


def _driver_name(document: Mapping[str, Any]) -> object:
    driver = document.get("driver")
    return driver.get("link") if isinstance(driver, Mapping) else None


def _find_hosts(
    faults: Faults, links: Mapping[str, LinkText], frame: FrameText
) -> tuple[dict[str, str], dict[str, str | None]]:
    """Host of every slider, and its guide where the host is the frame."""
    hosts: dict[str, str] = {}
    guides: dict[str, str | None] = {}
    for name, link in links.items():
        if link.slides is None:
            continue
        found = find_host(faults, link, links, frame)
        if found is None:
            link.sound = link.is_complete = False
            continue
        hosts[name], guides[name] = found
    return hosts, guides


def _place(
    faults: Faults, links: Mapping[str, LinkText], frame: FrameText, hosts: Mapping[str, str]
) -> dict[str, Body]:
    bodies = {FRAME: Body(dict(frame.points), None)}
    carriers = set(hosts.values())
    for name, link in links.items():
        alone = len(link.points) == 1 and link.slides is None
        if alone and name not in carriers and link.sound:
            faults.add(
                link.path,
                translate("link {} has one point and neither slides nor carries a slide", name),
                "List its second point, or give slides = { on = ... }.",
            )
            link.sound = link.is_complete = False
            continue
        body = place_points(faults, link)
        if body is not None:
            bodies[name] = body
    return bodies


def _read_slides(
    faults: Faults,
    links: Mapping[str, LinkText],
    frame: FrameText,
    hosts: Mapping[str, str],
    guides: Mapping[str, str | None],
    bodies: Mapping[str, Body],
) -> dict[str, Slide]:
    slides: dict[str, Slide] = {}
    turns: dict[str, float | None] = {FRAME: 0.0}
    first: dict[str, str] = {}
    for slider, host in hosts.items():
        first.setdefault(host, slider)
    for slider in order_hosts(faults, hosts):
        host = hosts[slider]
        turn = turns.get(host)
        body = bodies.get(host) or _placeholder_body(links[host])
        # A mark laid off along the own axis names that axis, and the line is still it.
        free = host != FRAME and host not in hosts and not links[host].lengths
        slide = read_slide(
            faults,
            links[slider],
            host,
            guides[slider],
            body,
            frame,
            turn=turn,
            angle_optional=free and first[host] == slider,
        )
        if slide is not None and host in bodies:
            slides[slider] = slide
            turns[slider] = None if turn is None else turn + slide.angle
    return slides


def _placeholder_body(link: LinkText) -> Body:
    """Body of a link that could not be placed: its names are known, so slides can be checked."""
    points = {point: complex(place) for place, point in enumerate(link.points)}
    return Body(points, ("", "") if len(points) > 1 else None)
