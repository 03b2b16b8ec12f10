"""Numbers of a file that may be varied: their names, and the file with new values (параметры).

A number that follows from others, the height of a triangle of three sides, is none of them: it is
had by reading the file again.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.problem.faults import Faults, is_number
from planmethod.problem.file_node import FileNode, Table
from planmethod.problem.keys import EFFORTS
from planmethod.problem.model import Body, OutputPositionKind, Problem
from planmethod.problem.names import UNITS, segment, split_names, split_pair
from planmethod.problem.output_rates import is_output_rate
from planmethod.problem.reader import read_parsed

Key = tuple[str | int, ...]

_IRRELEVANT_TABLES = (
    "variants", "published", "answers", "compare", "stamp", "sheet", "scales", "project",
    "balancing", "letters",
)  # fmt: skip
"""Tables on which no number of a plan depends at unit scales."""

_REPLACEABLE_PARTS = ("drive", "assembly", "dynamics", "machine", "cycle")
"""Parts of a problem that are kept where they were replaced after it was read."""


class Parameter(Struct, frozen=True):
    """A number that a file gives (параметр).

    Attributes
    ----------
    name : str
        ``l_AB``, ``x_D``, ``angle_x-x``, ``omega_1``.
    key : tuple of str or int
        Its place in the file; places in lists are numbers from 0.
    value : float
        SI and degrees.
    per : float
        How many of the file's unit one of SI is.
    """

    name: str
    key: Key
    value: float
    per: float = 1.0

    @property
    def dotted(self) -> str:
        """Key as in files: ``links.2.D.at``, ``frame.C[1]``, ``loads.0.force``."""
        if self.key[0] in ("loads", "springs", "meshes"):
            return ".".join(map(str, self.key))
        text = ".".join(segment(part) for part in self.key if isinstance(part, str))
        return text + "".join(f"[{part}]" for part in self.key if isinstance(part, int))

    @property
    def part(self) -> str:
        """The part of a problem that it belongs to: ``drive``, ``dynamics``, or ``bodies``."""
        return _PARTS.get(str(self.key[0]), "bodies")


_PARTS = {"driver": "drive", "dynamics": "dynamics", "loads": "dynamics", "springs": "dynamics"}


class Parameters:
    """Numbers of the file behind a problem, and the problem with others in their place.

    Parameters
    ----------
    problem : Problem
        As it was read. Rates, loads and rules that were replaced in it afterwards stay.
    pose : callable
        Finds the positions that the output determines.

    Attributes
    ----------
    by_name : dict of str to Parameter
        In the order of the file; by its dotted key where another has its name.
    """

    def __init__(self, problem: Problem, pose: Callable[[Problem], Problem]) -> None:
        self.problem, self._pose = problem, pose
        self.by_name: dict[str, Parameter] = {}
        for one in _numbers(problem) if problem.source_table else ():
            name = one.dotted if one.name in self.by_name else one.name
            self.by_name[name] = replace(one, name=name)
        self._others = {one.dotted: name for name, one in self.by_name.items()}
        for name in self.by_name:
            pair = split_pair(name.removeprefix("l_")) if name.startswith("l_") else None
            if pair is not None:
                self._others.setdefault(f"l_{pair[1]}{pair[0]}", name)
        for slide in problem.slides.values():
            self._others.setdefault(f"e_{slide.pin}{slide.host}", f"e_{slide.pin}")
        self._left_out = {one.name: one for one in _rates_left_out(problem)}
        self._parts: dict[str, Any] | None = None

    def find(self, name: str) -> Parameter | None:
        """Return the number that a name or a dotted key means; None of none.

        A rate of the driver that the file leaves out may be named: it is zero there.
        """
        name = self._others.get(name, name)
        return self.by_name.get(name, self._left_out.get(name))

    def check(self, chosen: Sequence[Parameter]) -> None:
        """Reject numbers of a part of the problem that is not as the file has it.

        Raises
        ------
        ProblemError
        """
        for one in chosen:
            if one.part in self._replaced:
                phrase = translate("the problem differs from its file: {} was replaced", one.part)
                hint = translate(
                    "Read the file with each value of {}, and solve each separately.", one.name
                )
                raise ProblemError(self.problem.source_file, [Fault(one.dotted, phrase, hint)])

    def read(self, values: Mapping[Parameter, float]) -> Problem:
        """Return the problem of the same file with other numbers, SI and degrees.

        Its positions are those of the problem, unless the output determines them.

        Raises
        ------
        ProblemError
            The file is faulty with them.
        AssemblyError
            The output never comes where the file has it.
        """
        return replace(self._read(values), **self._replaced)

    @property
    def _replaced(self) -> Mapping[str, Any]:
        """Parts of the problem that are not as the file has them."""
        if self._parts is None:
            read = self._read({})
            names = ("bodies", "slides", "mechanism", *_REPLACEABLE_PARTS)
            pairs = ((name, getattr(self.problem, name)) for name in names)
            self._parts = {name: own for name, own in pairs if own != getattr(read, name)}
        return self._parts

    def _read(self, values: Mapping[Parameter, float]) -> Problem:
        problem, drive = self.problem, self.problem.drive
        table = {
            key: value
            for key, value in problem.source_table.items()
            if key not in _IRRELEVANT_TABLES
        }
        for one, value in values.items():
            _set_number(table, one.key, float(value) * one.per)
        read = read_parsed(
            table,
            source=problem.source_file,
            name=problem.name,
            train=lambda *_, **__: drive.gear_drive or drive.cam_drive,
        )
        if drive.is_determined:
            return self._pose(read)
        return replace(read, drive=replace(read.drive, positions=drive.positions))


def _set_number(table: dict[str, Any], key: Key, value: float) -> None:
    """Set a number in a table, copying each container on its path."""
    level: Any = table
    for part in key[:-1]:
        below = level[part]
        level[part] = list(below) if isinstance(below, list) else dict(below)
        level = level[part]
    level[key[-1]] = value


# Which numbers there are --------------------------------------------------------------------------


def _numbers(problem: Problem) -> Iterator[Parameter]:
    """Yield the numbers that a file gives and that plans depend on."""
    read, given = _Reader(problem.unit), problem.source_table
    yield from _frame_parameters(read, given.get("frame", {}))
    for name, value in given.get("synthesis", {}).items():
        if name in ("centres", "stroke", "offset", "rod", "rocker", "coupler"):
            yield from read.length(name, ("synthesis", name), value)
        elif name in ("K_v", "swing", "lambda", "pressure", "beta"):
            yield from read.number(name, ("synthesis", name), value)
    for name, value in given.get("drawn", {}).items():
        if name == "points":
            for point, place in value.items():
                yield from read.place(point, ("drawn", "points", point), place)
        if name in ("points", "round"):
            continue
        shown = read.angle if name.startswith("phi_") else read.length
        yield from shown(name if name.startswith("phi_") else f"l_{name}", ("drawn", name), value)
    for link, table in given["links"].items():
        yield from _link_parameters(read, link, table, problem.bodies.get(link))
    for index, pair in enumerate(given.get("higher_pairs", ())):
        if "distance" in pair:
            name = f"l_{''.join(pair['centres'])}"
            yield from read.length(name, ("higher_pairs", index, "distance"), pair["distance"])
    for index, mesh in enumerate(given.get("meshes", ())):
        for number, radius in enumerate(mesh.get("r", ())):
            link = mesh["links"][number]
            yield from read.length(f"r_{link}", ("meshes", index, "r", number), radius)
    yield from _driver_parameters(read, problem)
    yield from _force_parameters(read, problem)


class _Reader(Struct):
    """Read numbers that have been found right once."""

    unit: str

    def _node(self, value: object) -> FileNode:
        faults = Faults()
        faults.unit = self.unit
        return FileNode(faults, value)

    def length(self, name: str, key: Key, value: object) -> Iterator[Parameter]:
        metres = self._node(value).attempt(FileNode.coordinate)
        if metres is not None:
            yield Parameter(name, key, metres, UNITS[self.unit])

    def angle(self, name: str, key: Key, value: object) -> Iterator[Parameter]:
        degrees = self._node(value).attempt(FileNode.angle)
        if degrees is not None:
            yield Parameter(name, key, degrees)

    def number(self, name: str, key: Key, value: object, per: float = 1.0) -> Iterator[Parameter]:
        number = self._node(value).attempt(lambda node: node.number(low=-math.inf, high=math.inf))
        if number is not None:
            yield Parameter(name, key, number / per, per)

    def place(self, name: str, key: Key, value: object) -> Iterator[Parameter]:
        if isinstance(value, list) and len(value) == 2:
            yield from self.length(f"x_{name}", (*key, 0), value[0])
            yield from self.length(f"y_{name}", (*key, 1), value[1])


def _frame_parameters(read: _Reader, frame: Table) -> Iterator[Parameter]:
    for point, place in frame.items():
        if point != "guides":
            yield from read.place(point, ("frame", point), place)
    for guide, line in frame.get("guides", {}).items():
        key = ("frame", "guides", guide)
        yield from read.place(guide, (*key, "through"), line["through"])
        yield from read.angle(f"angle_{guide}", (*key, "angle"), line["angle"])


def _link_parameters(
    read: _Reader, link: str, table: Table, body: Body | None
) -> Iterator[Parameter]:
    axis = body.axis if body is not None else None
    for name, value in table.items():
        key: Key = ("links", link, name)
        if name == "angle":
            for letters, angle in value.items():
                yield from read.angle(f"angle_{letters}", (*key, letters), angle)
        elif name == "slides":
            pin = table["points"][0]
            if "offset" in value:
                yield from read.length(f"e_{pin}", (*key, "offset"), value["offset"])
            if "radius" in value:
                letters = f"{value['centre']}{pin}"
                yield from read.length(f"l_{letters}", (*key, "radius"), value["radius"])
            if "angle" in value:
                yield from read.angle(f"angle_{link}", (*key, "angle"), value["angle"])
        elif name == "rolls":
            for own, letter in (("radius", "r"), ("circle", "circle")):
                if own in value:
                    yield from read.length(f"{letter}_{link}", (*key, own), value[own])
        elif isinstance(value, Mapping):
            yield from _point_parameters(read, key, name, value, axis)
        elif len(split_names(name)) == 2:
            yield from read.length(f"l_{name}", key, value)


def _point_parameters(
    read: _Reader, key: Key, point: str, form: Table, axis: tuple[str, str] | None
) -> Iterator[Parameter]:
    """Yield the numbers that place a third point of a link.

    Along and across the own axis, from where it begins, they are ``x_D`` and ``y_D``; else the
    point or the line that they are counted from is named as well.
    """
    if "vertex" in form:
        yield from read.angle(f"angle_{point}", (*key, "angle"), form["angle"])
        if "distance" in form:
            name = f"l_{form['vertex']}{point}"
            yield from read.length(name, (*key, "distance"), form["distance"])
        return
    start = form["on"] if "on" in form else form.get("from", "")
    letters = split_names(start)
    own = axis is not None and letters in (axis, axis[:1])
    of = point if own else f"{start}_{point}"
    for along in read.length("", (*key, "at"), form.get("at")) if "at" in form else ():
        plain = "across" not in form and along.value > 0
        yield replace(along, name=f"l_{letters[0]}{point}" if plain else f"x_{of}")
    if "across" in form:
        yield from read.length(f"y_{of}", (*key, "across"), form["across"])


def _driver_parameters(read: _Reader, problem: Problem) -> Iterator[Parameter]:
    drive, driver = problem.drive, problem.source_table.get("driver", [])
    if isinstance(driver, list) or drive.other_drives:
        return
    if drive.posed is not None and drive.posed.by is OutputPositionKind.LENGTH:
        pair = drive.posed.of
        yield from read.length(f"l_{pair}", ("driver", pair), driver[pair])
        for name in (f"v_{pair}", f"a_{pair}"):
            if name in driver:
                yield from read.number(name, ("driver", name), driver[name])
    for name in driver:
        if is_output_rate(name) or name in EFFORTS:
            yield from read.number(name, ("driver", name), driver[name])
    for name in ("omega", "n", "epsilon") if drive.is_crank else ("v", "a"):
        if name in driver:
            shown = "omega" if name == "n" else name
            shown = f"{shown}_{drive.link}" if drive.is_crank else shown
            per = 30.0 / math.pi if name == "n" else 1.0
            yield from read.number(shown, ("driver", name), driver[name], per)


def _rates_left_out(problem: Problem) -> Iterator[Parameter]:
    """Yield rates of the driver that the file may give and leaves out."""
    drive, driver = problem.drive, problem.source_table.get("driver", {})
    acted = drive.actuator is not None or drive.effort is not None
    acted |= drive.output_rate is not None and drive.output_rate.gain is not None
    if (
        not isinstance(driver, Mapping)
        or drive.other_drives
        or drive.cam_drive is not None
        or acted
        or not driver
    ):
        return
    if drive.is_crank and "epsilon" not in driver:
        yield Parameter(f"epsilon_{drive.link}", ("driver", "epsilon"), 0.0)
    elif not drive.is_crank and "a" not in driver:
        yield Parameter("a", ("driver", "a"), 0.0)


def _force_parameters(read: _Reader, problem: Problem) -> Iterator[Parameter]:
    dynamics = problem.source_table.get("dynamics", {})
    if is_number(dynamics.get("gravity")):
        yield from read.number("g", ("dynamics", "gravity"), dynamics["gravity"])
    for link, mass in dynamics.get("links", {}).items():
        for name, letter in (("mass", "m"), ("inertia", "J")):
            if name in mass:
                key = ("dynamics", "links", link, name)
                yield from read.number(f"{letter}_{link}", key, mass[name])
    own = () if problem.dynamics is None else problem.dynamics.loads
    for index, (load, table) in enumerate(
        zip(own, problem.source_table.get("loads", ()), strict=False)
    ):
        name = load.name.translate({ord("{"): None, ord("}"): None})
        for kind in ("force", "couple"):
            if kind in table and not isinstance(table[kind], Mapping):
                yield from read.number(name, ("loads", index, kind), table[kind])
        if "angle" in table:
            yield from read.angle(f"angle_{name}", ("loads", index, "angle"), table["angle"])
    springs = () if problem.dynamics is None else problem.dynamics.springs
    tables = problem.source_table.get("springs", ())
    for index, (spring, table) in enumerate(zip(springs, tables, strict=False)):
        name = spring.symbol.translate({ord("{"): None, ord("}"): None})
        for kind in ("stiffness", "damping", "preload"):
            if kind in table:
                yield from read.number(f"{kind}_{name}", ("springs", index, kind), table[kind])
        if "length" in table:
            yield from read.length(f"length_{name}", ("springs", index, "length"), table["length"])
        if "angle" in table:
            yield from read.angle(f"angle_{name}", ("springs", index, "angle"), table["angle"])
