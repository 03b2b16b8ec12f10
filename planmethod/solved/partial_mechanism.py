"""The solvable part of an incomplete problem file, for a sketch (часть механизма).

A complete file gives the whole mechanism. From an incomplete one the driver is taken, and
structural groups are joined to it one after the other, as long as they can be read and assembled.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import combinations, islice
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64
from planmethod.errors import Fault, PlanMethodError, ProblemError
from planmethod.problem import keys
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode
from planmethod.problem.linkage import TrainReader
from planmethod.problem.model import Problem
from planmethod.problem.reader import apply_variant, read_parsed, read_variants
from planmethod.solved.failures import Failure, PositionError, explain, failing
from planmethod.solved.reading import Reals
from planmethod.solved.solution import Solution
from planmethod.solved.view_space import Views

GUESSED = 60.0
"""Position in which a crank without one is shown, degrees."""

LINKS, FIXED, TRIES = 30, 40, 150
"""Limits of the links and fixed points examined, and of the mechanisms tried."""

SMALL = 12
"""Links of a part whose assemblies are shown."""

_SIZES = (2, 4)  # of structural groups that are tried, links
_GEOMETRY = ("title", "source", "units", "sheet", "scales", "gears")
_DEAD_OFFSET = 1e-4  # of a dead position, degrees
_FARTHEST = 1.0e6
_FAR_DISTANCES = [1.0e3, 1.7e3]  # nearest one of the modes: which one does not matter


class PartAssembly(Struct, frozen=True):
    """One assembly of a part (сборка), and the rules of ``[assembly]`` that choose it."""

    rules: Mapping[str, str]
    solution: Solution


MAX_ASSEMBLIES = 4
"""Assemblies of one part that are shown."""


class MechanismPart(Struct, frozen=True):
    """The drawable part of a file, and the missing data (часть механизма).

    Attributes
    ----------
    solution : Solution or None
        Solution in the requested positions that exist; None if the driver is not yet defined.
    faults : tuple of Fault
        Faults of the file.
    trouble : PlanMethodError or None
        Reason why the whole file cannot be solved although its parts can be read.
    failure : Failure or None
        Failure of the first requested position that does not exist.
    links : mapping of str to sequence of str
        Links that are not drawn, and the points that the file gives them.
    fixed : mapping of str to complex, m
        Fixed points.
    unsure : tuple of str
        Points whose assembly mode is not given: one of two is shown.
    assemblies : tuple of PartAssembly
        Assemblies of such a part, if rules can distinguish them.
    """

    solution: Solution | None
    faults: tuple[Fault, ...] = ()
    trouble: PlanMethodError | None = None
    failure: Failure | None = None
    links: Mapping[str, tuple[str, ...]] | None = None
    fixed: Mapping[str, complex] | None = None
    unsure: tuple[str, ...] = ()
    assemblies: tuple[PartAssembly, ...] = ()

    @property
    def error(self) -> PlanMethodError | None:
        """Why the whole file cannot be solved in its requested positions."""
        if self.trouble is None and self.failure is not None:
            return PositionError(self.failure)
        return self.trouble


def largest_part(
    table: Mapping[str, Any],
    *,
    source: str,
    name: str,
    variant: str | None = None,
    train: TrainReader | None = None,
    views: Views | None = None,
    posed: Callable[[Problem], Problem] = lambda problem: problem,
) -> MechanismPart:
    """Return the part of a problem that makes a mechanism in some requested position.

    Parameters
    ----------
    table : mapping
        Parsed TOML of the file.
    source, name, variant, train
        As of `read_parsed`.
    views : Views, optional
        Boxes that the plans should fill if the file gives no scale.
    posed : callable, optional
        Finds the positions of a whole problem that its output determines (`planmethod.linkages`).
    """
    try:
        problem = read_parsed(table, source=source, name=name, variant=variant, train=train)
        solution = Solution(posed(problem), views=views)
    except PlanMethodError as error:
        grown = _Growth(_with_variant(table, variant), source, name, train, views)
        faults = error.faults if isinstance(error, ProblemError) else ()
        failure = error.failure if isinstance(error, PositionError) else None
        return replace(grown.part(), faults=faults, trouble=error, failure=failure)
    there, failure = _existing(solution)
    return MechanismPart(
        solution.with_positions(there.tolist()) if there.size else None, failure=failure
    )


def _with_variant(table: Mapping[str, Any], variant: str | None) -> Mapping[str, Any]:
    found = read_variants(FileNode(Faults(), table))
    return apply_variant(table, found[variant]) if variant in found else table


def _existing(solution: Solution) -> tuple[Reals, Failure | None]:
    """Return the requested positions with plans, and the failure of the first one without.

    If there is no such position, dead ones are shifted by an invisible amount.
    """
    draft, program = solution.construction.draft, solution.construction.program
    positions, reading = solution.positions, solution.read(Float64())
    there = failing(program, reading.trace, reading.count) < 0
    if there.all():
        return positions, None
    failure = explain(draft, program, reading, positions, solution.read_at)
    if not there.any():
        positions = positions + _DEAD_OFFSET * (1.0 if solution.problem.drive.goes_round else 1e-3)
        there = failing(program, solution.read_at(positions).trace, reading.count) < 0
    return positions[there], failure


class _Growth:
    """Joins groups to the driver as long as the file lets it."""

    def __init__(
        self,
        table: Mapping[str, Any],
        source: str,
        name: str,
        train: TrainReader | None,
        views: Views | None,
    ) -> None:
        self.views = views
        self.table, self.source, self.name, self.train = table, source, name, train
        links = table.get("links")
        self.links = {
            str(link): body
            for link, body in islice(links.items() if isinstance(links, Mapping) else (), LINKS)
            if isinstance(body, Mapping)
        }
        self.unsure: list[str] = []
        self.tries = 0

    def points(self, link: str) -> tuple[str, ...]:
        """Return the points that the file gives a link."""
        listed = self.links[link].get("points", ())
        named = (p for p in listed if isinstance(p, str)) if isinstance(listed, list) else ()
        return tuple(islice(dict.fromkeys(named), keys.LINK_POINT_LIMIT))

    def part(self) -> MechanismPart:
        """Return the part."""
        found: Solution | None = None
        kept: tuple[str, ...] = ()
        for driver in self._drivers():
            found = self._solved((driver,))
            if found is not None:
                kept = (driver,)
                break
        grows = found is not None
        while grows:
            grows = False
            for more in self._groups(kept):
                bigger = self._solved((*kept, *more))
                if bigger is not None:
                    found, kept, grows = bigger, (*kept, *more), True
                    break
        left = {link: self.points(link) for link in self.links if link not in kept}
        ways = tuple(self._assemblies(kept)) if self.unsure and len(kept) <= SMALL else ()
        return MechanismPart(
            found, links=left, fixed=self._fixed(), unsure=tuple(self.unsure), assemblies=ways
        )

    def _drivers(self) -> Iterator[str]:
        """Yield the driver that the file names, and then links that may be one."""
        driver = self.table.get("driver")
        named = str(driver.get("link")) if isinstance(driver, Mapping) else ""
        if named in self.links:
            yield named
        fixed = self._fixed()
        for link in self.links:
            if link != named and len(self.points(link)) > 1 and fixed.keys() & self.points(link):
                yield link

    def _fixed(self) -> dict[str, complex]:
        frame = self.table.get("frame")
        found: dict[str, complex] = {}
        for point, place in frame.items() if isinstance(frame, Mapping) else ():
            match place:
                case [int() | float() as x, int() | float() as y]:
                    if all(abs(one) <= _FARTHEST for one in (x, y)):  # NaN is not
                        found[str(point)] = complex(x, y)
            if len(found) == FIXED:
                break
        return found

    def _groups(self, included: tuple[str, ...]) -> Iterator[tuple[str, ...]]:
        """Yield connected sets of links, the small ones first."""
        rest = [link for link in self.links if link not in included]
        for size in _SIZES:
            for some in combinations(rest if self.tries < TRIES else (), size):
                if all(any(self._touch(one, two) for two in some if two != one) for one in some):
                    yield some

    def _touch(self, one: str, two: str) -> bool:
        def host(link: str) -> object:
            slides = self.links[link].get("slides")
            return slides.get("on") if isinstance(slides, Mapping) else None

        common = set(self.points(one)) & set(self.points(two))
        return bool(common) or host(one) == two or host(two) == one

    def _table(self, links: tuple[str, ...]) -> dict[str, Any]:
        """Return the file of some links alone."""
        points = {point for link in links for point in self.points(link)}
        rules = self.table.get("assembly")
        rules = rules if isinstance(rules, Mapping) else {}
        table: dict[str, Any] = {key: self.table[key] for key in _GEOMETRY if key in self.table}
        table |= {
            "frame": self.table.get("frame", {}),
            "links": {link: self.links[link] for link in links},
            "assembly": {point: rules[point] for point in rules if point in points},
            "driver": self._driver(links[0]),
        }
        return table

    def _assemblies(self, links: tuple[str, ...]) -> Iterator[PartAssembly]:
        """Yield the ways in which some links close, each with the rules that choose it."""
        table, count = self._table(links), 0
        given = table["assembly"]
        todo: list[dict[str, str]] = [{}]
        while todo and count < MAX_ASSEMBLIES:
            rules = todo.pop(0)
            table["assembly"] = given | rules
            try:
                problem = read_parsed(table, source=self.source, name=self.name, train=self.train)
                solution = Solution(problem, views=self.views)
                there, _ = _existing(solution)
            except ProblemError as error:
                fault = next((one for one in error.faults if one.choices), None)
                point = "" if fault is None else fault.path.partition(".")[2]
                if fault is not None and point not in rules:
                    todo[:0] = [{**rules, point: choice} for choice in fault.choices]
                continue
            except PlanMethodError:  # it has another assembly only
                continue
            if there.size and rules:
                count += 1
                yield PartAssembly(rules, solution.with_positions(there.tolist()))

    def _solved(self, links: tuple[str, ...]) -> Solution | None:
        """Return the mechanism of some links in the requested positions that exist, or None."""
        self.tries += 1
        if self.tries > TRIES:
            return None
        points = {point for link in links for point in self.points(link)}
        table = self._table(links)
        unsure: list[str] = []
        for _ in range(len(links)):  # every group may need one more rule
            try:
                problem = read_parsed(table, source=self.source, name=self.name, train=self.train)
                solution = Solution(problem, views=self.views)
                there, _ = _existing(solution)
            except ProblemError as error:
                more = [
                    point
                    for fault in error.faults
                    for head, _, point in [fault.path.partition(".")]
                    if head == "assembly" and point in points and point not in unsure
                ]
                if not more or len(more) < len(error.faults):
                    return None
                unsure += more
                table["assembly"] |= {point: {"near": _FAR_DISTANCES} for point in more}
                continue
            except PlanMethodError:
                return None
            if not there.size:
                return None
            self.unsure = unsure
            return solution.with_positions(there.tolist())
        return None

    def _driver(self, link: str) -> dict[str, Any]:
        """Return the law of motion as given, or one that shows where the link is."""
        driver = self.table.get("driver")
        given = dict(driver) if isinstance(driver, Mapping) else {}
        if str(given.get("link")) != link or not {"phi", "s"} & given.keys():
            given = {"link": link, "phi": GUESSED}
        if not {"omega", "n", "v", "train"} & given.keys():
            given["v" if "s" in given else "omega"] = 1.0
        return given
