"""Read the parts of a problem file in turn, from its parsed TOML."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, Protocol

from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism
from planmethod.problem import keys
from planmethod.problem.answers import (
    AnswerScope,
    check_quantity,
    read_answers,
    read_published,
    read_tables,
)
from planmethod.problem.drive import read_assembly, read_drive, read_scales
from planmethod.problem.file_node import FileNode, read_units
from planmethod.problem.joints import (
    DRAWN,
    FrameText,
    Host,
    coincident_points,
    find_host,
    join,
    order_hosts,
    read_frame,
    read_higher,
    read_slide,
)
from planmethod.problem.letters import read_letters
from planmethod.problem.links import LinkText, check_arcs, read_links
from planmethod.problem.machine import (
    cycle_count,
    read_cycle,
    read_machine,
    read_project,
    with_cycle_count,
)
from planmethod.problem.mesh_records import GearMesh
from planmethod.problem.meshes import (
    MeshScope,
    centres_of,
    letters_of,
    meshes_of_gears,
    note_passive_loads,
    read_meshes,
    read_rolling,
    with_passive,
)
from planmethod.problem.model import (
    Body,
    CamDrive,
    DrawnFact,
    DrawnPoints,
    DrawnPosition,
    Drive,
    GearDrive,
    Letters,
    Problem,
    Scales,
    Slide,
    SynthesisTask,
)
from planmethod.problem.names import UNITS, listed
from planmethod.problem.other_drivers import (
    add_drivers,
    check_forces_of_drivers,
    driver_entries,
    reject_tables_of_one_driver,
)
from planmethod.problem.output_rates import check_driving_load, check_one_position
from planmethod.problem.placement import place_points
from planmethod.problem.sheet import read_head

if TYPE_CHECKING:
    from planmethod.problem.machine_records import CounterweightTask, Machine
    from planmethod.problem.records import Dynamics


class TrainReader(Protocol):
    """Reader of ``[gears]`` or ``[cam]`` of a file for a driver; None after a fault."""

    def __call__(self, file: FileNode, driver: FileNode) -> GearDrive | CamDrive | None:
        """Return what moves the driver."""
        ...


def read_parts(file: FileNode, name: str, train: TrainReader | None) -> Problem | None:
    """Read a linkage; None after noting a fault.

    Parameters
    ----------
    name : str
        Name of the problem.
    train : callable, optional
        Reads the train, or the cam, that drives.
    """
    if not (isinstance(file["drawn"].value, Mapping) and "points" in file["drawn"]):
        return _read_parts(file, name, train, None)
    from planmethod.problem.drawn_assembly import with_position  # few files have any
    from planmethod.problem.drawn_points import with_sizes

    read_units(file)
    file, shown = with_sizes(file)
    if shown is None:
        return None  # each size that follows would be missing
    problem = _read_parts(file, name, train, None, shown)
    return None if problem is None else with_position(problem, shown)


def _read_parts(
    file: FileNode,
    name: str,
    train: TrainReader | None,
    figure: DrawnPosition | None,
    placed: DrawnPoints | None = None,
) -> Problem | None:
    """Read a linkage; ``figure`` is the drawn position whose numbers the file has by now.

    ``placed`` are points whose coordinates gave sizes that the file has by now.
    """
    file.allow(keys.TOP)
    read_units(file)
    task = _read_synthesis(file)
    if "synthesis" in file and task is None:
        return None  # each number that names a size of it would be a fault as well
    head = read_head(file)
    scales = file.read("scales", read_scales) or Scales()
    tables = read_tables(file)
    if "links" not in file:
        _note_no_links(file)
        file.read("frame", read_frame)
        return None
    drivers, driver_nodes = _drivers(file), driver_entries(file)
    for key in ("frame", "driver"):
        if key not in file and not (key == "driver" and "drivers" in file):
            file[key].note("missing", hint=_MISSING[key])
    if drivers and ("drivers" in file or len(drivers) > 1):
        file.value["driver"] = drivers[0]
    frame = file.read("frame", read_frame) or FrameText({}, {}, sound=False)
    links = file.read("links", read_links) or {}
    if "frame" not in file:
        return None
    higher: tuple[HigherPair, ...] = ()
    if "higher_pairs" in file:
        higher = file.read("higher_pairs", partial(read_higher, links=links, frame=frame)) or ()
    rolling: tuple[GearMesh, ...] = ()
    poles = letters_of(links, frame)
    if any(link.rolls is not None for link in links.values()):
        rolling = read_rolling(links, frame, poles)
    _move_gears(file, links, frame)
    if "gears" not in file:
        tables = {key: table for key, table in tables.items() if key != "gears"}
    check_arcs(links, frame.points)
    for guide in frame.guides:
        if guide in links:
            hint = "Rename the guide, for instance x-x."
            file["frame"]["guides"][guide].note("link {} has the same name", guide, hint=hint)
    hosts, guides = _find_hosts(links, frame)
    bodies = _place(links, frame, hosts, _toothed(file))
    slides = _read_slides(links, frame, hosts, guides, bodies)
    meshes = rolling
    if "meshes" in file:
        scope_of_meshes = MeshScope(links, bodies, slides, poles)
        meshes += file.read("meshes", partial(read_meshes, scope=scope_of_meshes)) or ()
    drive = None
    phi_drawn = file["driver"]["phi"].value == DRAWN
    if phi_drawn:
        file.value["driver"] = {**file.value["driver"], "phi": 0.0}
    sought = bool(frame.drawn_points or frame.drawn_guides or phi_drawn)
    if "driver" in file and links:
        read_one = partial(read_drive, links=links, fixed=frame.points, hosts=hosts)
        first = driver_nodes[0] if driver_nodes and not phi_drawn else file["driver"]
        counted = cycle_count(file.value)
        drive = first.attempt(
            partial(
                read_one,
                leading=_read_leading(file, train, first),
                numbered=counted,
            )
        )
        if len(driver_nodes) > 1:

            def read_other(node: FileNode) -> Drive | None:
                return node.attempt(partial(read_one, leading=_read_leading(file, train, node)))

            drive = add_drivers(driver_nodes, drive, read_other)
            links_given = [str(node["link"].value) for node in driver_nodes]
            reject_tables_of_one_driver(file, links_given)
        if drive is not None:
            nodes = driver_nodes if drive.other_drives else [first]
            check_one_position(nodes, drive.every, cycle=bool(counted) and drive.is_crank)
    driver = drive.link if drive else str(_driver_name(file))
    if task is not None:
        from planmethod.problem.synthesis import check_lengths

        lengths = [
            (link.name, one.key, one.value) for link in links.values() for one in link.lengths
        ]
        places = {
            point: at for point, at in frame.points.items() if point not in frame.drawn_points
        }
        check_lengths(file, task, lengths, places)
    complete = (
        bool(links)
        and frame.sound
        and file["higher_pairs"].is_sound
        and file["meshes"].is_sound
        and len(links) - len(higher) - len(rolling) == len(file["links"].value)
        and all(link.is_complete for link in links.values())
    )
    mechanism = None
    if links:
        mechanism = join(file["links"], frame, links, hosts, driver, complete=complete,
                         toothed=[mesh.mesh.links for mesh in meshes])  # fmt: skip
    if frame.number in links:
        hint = "The number of the frame must be 0, or one that no link has."
        file["frame"]["number"].note("link {} has the same number", frame.number, hint=hint)
    elif mechanism is not None:
        mechanism = replace(
            mechanism,
            frame=frame.number,
            higher=higher,
            meshes=tuple(mesh.mesh for mesh in meshes),
            other_drivers=() if drive is None else drive.links[1:],
        )
    if len(drivers) > 1 and mechanism is not None and complete:
        _note_drivers(file["drivers" if driver_nodes else "driver"], drivers, mechanism)
    moving = [p for link in links.values() for p in link.points if p not in frame.points]
    moving = list(dict.fromkeys(moving))
    drawn = frame.drawn_points if figure is None else {path[1] for path in figure.file_values}
    fixed = [point for point in frame.points if point not in drawn]
    choosable = [*moving, *(point for point in frame.points if point in drawn)]
    rules = partial(read_assembly, moving=choosable, fixed=fixed)
    assembly = file.read("assembly", rules) or ()
    if mechanism is not None and complete and not file.faults and not meshes:
        mechanism = with_passive(mechanism, bodies, assembly)
    shown = _read_figure(file, links, [*frame.points, *moving], sought=sought or figure is not None)
    if placed is not None:
        from planmethod.problem.drawn_assembly import check_figure

        check_figure(file, placed, shown, assembly)
    machine = None
    if "machine" in file:
        machine = file.attempt(partial(read_machine, drive=drive))
    elif "motors" in file:
        hint = 'For example: [machine] delta = "1/18"'
        file["motors"].note("a motor is chosen for a machine, and there is no [machine]", hint=hint)
    dynamics, drive, balancing = _read_forces(file, links, frame, drive, machine, mechanism)
    if mechanism is not None and mechanism.passive and dynamics is not None:
        loaded = {*dynamics.masses, *(load.link for load in dynamics.loads)}
        note_passive_loads(file["links"], mechanism, loaded)
    if dynamics is not None:
        check_forces_of_drivers(driver_nodes, drive)
    for one, node in zip(
        drive.every if drive else (), driver_nodes or [file["driver"]], strict=False
    ):
        if one.effort is not None:
            check_driving_load(file, one, node, has_forces=dynamics is not None)
    cycle = None
    if "cycle" in file:
        read = partial(read_cycle, bodies=bodies, slides=slides, drive=drive, machine=machine)
        cycle = file.attempt(read)
        if cycle is not None and machine is not None:
            machine = with_cycle_count(file["cycle"], machine, cycle)
    project = file.read("project", read_project)
    points = [*frame.points, *moving, *coincident_points(slides.values())]
    letters = Letters()
    if "letters" in file:
        letters = file.read("letters", partial(
            read_letters, bodies_by_link=bodies, slides=slides.values(), points=points,
            fixed=(*frame.points, *frame.guides),
        )) or letters  # fmt: skip
        if letters.balance and dynamics is None and not file.faults:
            hint = "Give the forces, or leave the letter out."
            file["letters"]["balance"].note("valid only with [dynamics]", hint=hint)
        if dynamics is not None and letters.balance in {load.name for load in dynamics.loads}:
            other = "{} is the letter of another quantity"
            file["letters"]["balance"].note(other, letters.balance, hint="Give it another letter.")

    def scope() -> AnswerScope:
        """Return the names that quantities may use; none after a fault."""
        return AnswerScope(
            () if file.faults else points,
            () if file.faults else tuple(links),
            mechanism.revolutes if mechanism else (),
            slides,
            dynamics,
            drive,
            letters.names(bodies),
            mechanism.meshes if mechanism else (),
        )

    named = scope()

    def checked(node: FileNode, _: str) -> str:
        quantity = str(node.value)
        key = check_quantity(node, quantity, named) if quantity else None
        return quantity if key is None else key.words

    count = len(drive.positions) if drive else 0
    if project is not None and not project.is_of_note and cycle is not None:
        # Its positions are those of the cycle.
        count = cycle.count if machine is None else cycle.count * machine.turns
    read_values = partial(read_published, check=checked, positions=count)
    published = file.read("published", read_values) or ()
    answers = read_answers(file, scope())
    if file.faults or drive is None or mechanism is None:
        assert file.faults, "a part was left out without a word"
        return None
    if sought:
        from planmethod.problem.drawn import DrawnScope, place_drawn  # few files have any

        scene = DrawnScope(frame, bodies, slides, drive, phi_drawn, mechanism, assembly)
        known = () if placed is None else _directions(placed, links, shown)
        found = file.attempt(partial(place_drawn, facts=(*shown, *known), scope=scene))
        if found is not None:
            found = replace(found, facts=tuple(one for one in found.facts if one not in known))
        return None if found is None else _read_placed(file, name, train, found, placed)
    return Problem(
        name=name,
        **head,
        unit=file.faults.unit,
        stated=dict(file.faults.stated),
        vanished=dict(file.faults.vanished),
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
        letters=letters,
        synthesis=task,
        meshes=meshes,
    )


def _read_synthesis(file: FileNode) -> SynthesisTask | None:
    """Read ``[synthesis]``, whose results the numbers of the file may name."""
    if "synthesis" not in file:
        return None
    from planmethod.problem.synthesis import read_synthesis, values_in_file  # few files have any

    task = file["synthesis"].attempt(read_synthesis)
    file.faults.names = {} if task is None else values_in_file(task, file.faults.unit)
    return task


def _read_figure(
    file: FileNode,
    links: Mapping[str, LinkText],
    points: Sequence[str],
    *,
    sought: bool,
) -> tuple[DrawnFact, ...]:
    """Read what the figure of the task shows."""
    if "drawn" not in file:
        return ()
    from planmethod.problem.drawn import read_facts

    given = file["drawn"].value
    if not sought and not (isinstance(given, Mapping) and "points" in given):
        hint = 'Write the unknown place: [frame] C = "drawn".'
        file["drawn"].note('nothing in the file is "drawn"', hint=hint)
    return file.read("drawn", partial(read_facts, links=links, points=points)) or ()


def _directions(
    placed: DrawnPoints, links: Mapping[str, LinkText], facts: Sequence[DrawnFact]
) -> tuple[DrawnFact, ...]:
    """Return the directions of links of which coordinates show two points."""
    from planmethod.problem.drawn_assembly import directions

    axes = {
        name: (one.lengths[0].a, one.lengths[0].b) for name, one in links.items() if one.lengths
    }
    return directions(placed, axes, facts)


def _read_placed(
    file: FileNode,
    name: str,
    train: TrainReader | None,
    position: DrawnPosition,
    placed: DrawnPoints | None,
) -> Problem | None:
    """Read the file with the numbers of its drawn position as any other one."""
    table, per = dict(file.value), UNITS[file.faults.unit]
    for path, value in position.places_found.items():
        *way, last = path
        level: dict[str, Any] = table
        for key in way:
            level[key] = dict(level[key])
            level = level[key]
        level[last] = [x * per for x in value] if isinstance(value, list) else value
    problem = _read_parts(file.with_value(table), name, train, position, placed)
    if problem is None:
        return None
    drive = problem.drive
    first = (drive.assembly_positions or drive.positions)[0]
    if drive.posed is None and drive.cam_drive is None and position.position not in (None, first):
        drive = replace(drive, assembly_positions=(position.position,))
    return replace(problem, drive=drive, drawn=position)


def _read_forces(
    file: FileNode,
    links: Mapping[str, LinkText],
    frame: FrameText,
    drive: Drive | None,
    machine: Machine | None,
    mechanism: Mechanism | None,
) -> tuple[Dynamics | None, Drive | None, CounterweightTask | None]:
    """Read the tables of forces: masses and loads, what balances them, friction and bearings."""
    if not _FORCES.intersection(file.value):
        return None, drive, None
    from planmethod.problem import dynamics as forces  # few files have any
    from planmethod.problem.dynamics import LoadScope
    from planmethod.problem.sizes import TURN

    dynamics = balancing = None
    if not {"dynamics", "loads", "springs"}.isdisjoint(file.value):
        cycle = TURN if machine is None else machine.cycle_deg
        scope = LoadScope(links, frame.points, drive, cycle)
        dynamics = forces.read_dynamics(file, scope)
        if "springs" in file:
            from planmethod.problem.springs import with_springs

            dynamics = with_springs(file["springs"], scope, dynamics)
    if "balancing_force" in file:
        pushed = file.attempt(partial(forces.read_balancing_force, links=links, drive=drive))
        drive = None if drive is None else replace(drive, pushed=pushed)
    if "friction" in file:
        points = [*frame.points, *(point for link in links.values() for point in link.points)]
        read = partial(forces.read_friction, links=links, drive=drive, points=points)
        friction = file.attempt(read)
        dynamics = None if dynamics is None else replace(dynamics, friction=friction)
    if "bearings" in file and mechanism is not None:
        turning = [one.point for one in mechanism.revolutes if FRAME in one.links]
        bearings = file.attempt(partial(forces.read_bearings, turning=turning)) or {}
        dynamics = None if dynamics is None else replace(dynamics, bearings=bearings)
    if "balancing" in file:
        balancing = file.read("balancing", partial(
            forces.read_balancing, links=tuple(links), drive=drive, dynamics=dynamics
        ))  # fmt: skip
    return dynamics, drive, balancing


_FORCES = {"dynamics", "loads", "springs", "balancing_force", "friction", "bearings", "balancing"}


_MISSING = {
    "frame": "Give the fixed points: [frame] A = [0, 0].",
    "driver": 'Give the driving link: [driver] link = "1", phi = 20, omega = 50.',
}


def _note_no_links(file: FileNode) -> None:
    for key, what in keys.OF_KINDS.items():
        if key in file:
            hint = "Plans of a linkage need [frame], [links] and [driver]."
            message = "missing: the file describes {} ([{}]), not a linkage"
            file["links"].note(message, what, key, hint=hint)
            return
    hint = 'Give the links: [links.1] points = ["A", "B"], AB = 0.1.'
    file["links"].note("missing", hint=hint)


def _read_leading(
    file: FileNode, train: TrainReader | None, driver: FileNode
) -> GearDrive | CamDrive | None:
    """Read the train that a driver names, or the cam whose follower drives."""
    if "train" in driver and not isinstance(file["gears"].value, Mapping):
        driver["train"].note("the file has no train", hint="Describe it in [gears].")
    elif "cam" in driver and not isinstance(file["cam"].value, Mapping):
        driver["cam"].note("the file has no cam", hint="Describe it in [cam].")
    elif ("train" in driver or "cam" in driver) and train is None:
        hint = "Read the file by planmethod.load or planmethod.loads."
        key = "train" if "train" in driver else "cam"
        driver[key].note("gear trains and cams cannot be read here", hint=hint)
    elif ("train" in driver or "cam" in driver) and train is not None:
        return file.attempt(partial(train, driver=driver))
    return None


def _drivers(file: FileNode) -> list[Mapping[str, Any]]:
    """Return the drivers: several as a list of tables, or as a list of links."""
    driver = file["drivers" if "drivers" in file else "driver"].value
    listed_links = driver.get("link") if isinstance(driver, Mapping) else None
    if isinstance(driver, Mapping) and isinstance(listed_links, list):
        return [{**driver, "link": link} for link in listed_links]
    return [one for one in driver if isinstance(one, Mapping)] if isinstance(driver, list) else []


def _note_drivers(
    node: FileNode, drivers: Sequence[Mapping[str, Any]], mechanism: Mechanism
) -> None:
    """Note why several drivers are rejected: their names, and the number the mechanism needs."""
    count, names = len(drivers), listed(str(one.get("link", "?")) for one in drivers)
    message = translate("{} drivers are given: links {}", count, names)
    n, pairs = len(mechanism.links), mechanism.lower_pairs
    mobility = 3 * n - 2 * pairs - len(mechanism.meshes)
    if mobility == count:
        return
    message += f"; W = 3n - 2p1 = 3·{n} - 2·{pairs} = {mobility}"
    hint = translate("Give as many as W, {}, or change the pairs.", mobility)
    if mobility == 1:
        hint = "One driving link moves this whole mechanism: keep one of them."
    node.note(message, hint=hint)


def _driver_name(file: FileNode) -> object:
    return file["driver"]["link"].value


def _find_hosts(
    links: Mapping[str, LinkText], frame: FrameText
) -> tuple[dict[str, str], dict[str, str | None]]:
    """Host of every slider, and its guide where the host is the frame."""
    hosts: dict[str, str] = {}
    guides: dict[str, str | None] = {}
    for name, link in links.items():
        if link.slides is None:
            continue
        found = find_host(link, links, frame)
        if found is None:
            link.sound = link.is_complete = False
            continue
        hosts[name], guides[name] = found
    return hosts, guides


def _move_gears(file: FileNode, links: Mapping[str, LinkText], frame: FrameText) -> None:
    """Read a train of ``[gears]`` whose wheels have the names of links as ``[[meshes]]``."""
    gears = file["gears"].value
    drivers = [file["driver"].value, *_drivers(file)]
    if (
        not isinstance(gears, Mapping)
        or "meshes" in file
        or any("train" in one for one in drivers if isinstance(one, Mapping))
    ):
        return
    found = meshes_of_gears(gears, links)
    for mesh in found:
        mesh["centres"] = centres_of(mesh["links"], links, frame)
    points = [point for link in links.values() for point in link.points]
    joints = {point: points.count(point) - (point not in frame.points) for point in points}
    slides = sum(link.slides is not None for link in links.values())
    # A linkage that moves definitely has a train beside it, whose wheels are called as links are.
    loose = 3 * len(links) - 2 * (sum(joints.values()) + slides) - 1
    if found and loose == len(found) and all(all(mesh["centres"]) for mesh in found):
        rest = {key: value for key, value in file.value.items() if key != "gears"}
        file.value = {**rest, "meshes": found}


def _toothed(file: FileNode) -> set[str]:
    """Return the names of the links that have a wheel or a rack, as the file has them."""
    meshes = file["meshes"].value
    tables = [one for one in meshes if isinstance(one, Mapping)] if isinstance(meshes, list) else []
    ends = [one.get("links") for one in tables]
    return {str(name) for pair in ends if isinstance(pair, list) for name in pair}


def _place(
    links: Mapping[str, LinkText],
    frame: FrameText,
    hosts: Mapping[str, str],
    toothed: Collection[str],
) -> dict[str, Body]:
    bodies = {FRAME: Body(dict(frame.points), None)}
    carriers = {*hosts.values(), *toothed}
    for name, link in links.items():
        alone = len(link.points) == 1 and link.slides is None and link.rolls is None
        if alone and name not in carriers and link.sound:
            message = "link {} has one point and neither slides nor carries a slide"
            hint = "List its second point, or give slides = { on = ... }."
            link.node.note(message, name, hint=hint)
            link.sound = link.is_complete = False
            continue
        body = place_points(link)
        if body is not None:
            bodies[name] = body
    return bodies


def _read_slides(
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
    for slider in order_hosts(links, hosts):
        host = hosts[slider]
        turn = turns.get(host)
        body = bodies.get(host) or _placeholder_body(links[host])
        # A mark laid off along the own axis names that axis, and the line is still it.
        free = host != FRAME and host not in hosts and not links[host].lengths
        carrier = Host(host, body, guides[slider], turn, free and first[host] == slider)
        slide = read_slide(links[slider], carrier, frame)
        if slide is not None and host in bodies:
            slides[slider] = slide
            turns[slider] = None if turn is None else turn + slide.angle
    return slides


def _placeholder_body(link: LinkText) -> Body:
    """Body of a link that could not be placed: its names are known, so slides can be checked."""
    points = {point: complex(place) for place, point in enumerate(link.points)}
    return Body(points, ("", "") if len(points) > 1 else None)
