"""Fixed points and guides that a file gives by a drawn position: ``[drawn]`` (рисунок задачи)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from planmethod.construct.steps import PointName
from planmethod.errors import StructureError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME, Mechanism, Revolute
from planmethod.mechanism.structure import analyse
from planmethod.problem import keys
from planmethod.problem.figure import Figure, Values
from planmethod.problem.figure_checks import SAME, Check, FigureChecks, PlaceValues, Reals, extent
from planmethod.problem.figure_faults import FigureFaults
from planmethod.problem.figure_scene import Scene
from planmethod.problem.file_node import FileNode
from planmethod.problem.joints import DRAWN, FrameText
from planmethod.problem.links import LinkText
from planmethod.problem.model import (
    AssemblyRelation,
    Body,
    DrawnFact,
    DrawnKind,
    DrawnPosition,
    Drive,
    FixedLine,
    OutputPositionKind,
    Rule,
    Slide,
)


class DrawnScope(NamedTuple):
    """Parts of the file that a drawn position is about."""

    frame: FrameText
    links: Mapping[str, Body]
    slides: Mapping[str, Slide]
    drive: Drive
    phi_drawn: bool
    mechanism: Mechanism
    assembly: tuple[Rule, ...]


def read_facts(
    node: FileNode, links: Mapping[str, LinkText], points: Sequence[str]
) -> tuple[DrawnFact, ...]:
    """Read ``[drawn]``.

    Parameters
    ----------
    points : sequence of str
        All points of the mechanism.
    """
    node.table("[drawn] phi_3 = 90, phi_2_3 = 90")

    def line_of(entry: FileNode, name: str) -> tuple[str, str]:
        if not name[:1].isupper():
            entry.reject_unknown(name, links, "unknown link '{}'")
        return entry.split_line(name, "the mechanism", points)

    def link_of(entry: FileNode, line: tuple[str, str]) -> str:
        having = [name for name, link in links.items() if {*line} <= {*link.points}]
        if not having:
            hint = "Angles are those of links and their lines."
            entry.reject("no link has both points {} and {}", *line, hint=hint)
        return having[0]

    def read_fact(entry: FileNode) -> DrawnFact:
        key = entry.unmask(str(entry.key))
        if key.startswith("phi_"):
            names = key.removeprefix("phi_").split("_")
            lines = tuple(None if name in links else line_of(entry, name) for name in names)
            of = tuple(
                name if line is None else link_of(entry, line)
                for name, line in zip(names, lines, strict=True)
            )
            told = lines if any(lines) else ()
            if len(names) == 1:
                return DrawnFact(DrawnKind.PHI, of, entry.angle(), told)
            if len(names) != 2 or of[0] == of[1]:
                entry.reject("an angle must be between two links", hint="For example: phi_2_3 = 90")
            degrees = entry.angle()
            if not 0.0 <= degrees <= 180.0:
                entry.reject_value("an angle of two links from 0 to 180 degrees")
            return DrawnFact(DrawnKind.BETWEEN, of, degrees, told)
        if not key[:1].isupper():
            hint = (
                "phi_3 is the direction of link 3 from +x, phi_2_3 its angle to link 2, phi_BE "
                "that of a line BE, AC the distance of two points."
            )
            entry.reject("unknown key", hint=hint)
        pair = entry.split_line(key, "the mechanism", points)
        return DrawnFact(DrawnKind.LENGTH, pair, entry.length())

    found: dict[tuple[DrawnKind, frozenset[str]], DrawnFact] = {}
    for entry in node.entries():
        fact = None if entry.key in keys.DRAWN else entry.attempt(read_fact)
        if fact is None:
            continue
        same = found.setdefault((fact.kind, frozenset(fact.names)), fact)
        if same is not fact:
            entry.note("the same as {}", same.key, hint="Keep one of them.")
    node.require_sound()
    return tuple(found.values())


def place_drawn(file: FileNode, facts: tuple[DrawnFact, ...], scope: DrawnScope) -> DrawnPosition:
    """Find the fixed points and guides that are drawn; what prevents it is noted at ``[drawn]``."""
    with np.errstate(all="ignore"):  # a mirror image that does not exist is NaN
        return _Placing(file, facts, scope).place()


class _Placing:
    """The figure of one file."""

    def __init__(self, file: FileNode, facts: tuple[DrawnFact, ...], scope: DrawnScope) -> None:
        self.file, self.node, self.scope = file, file["drawn"], scope
        self.facts, drive = facts, scope.drive
        own = [fact for fact in facts if fact.kind is DrawnKind.PHI and fact.names == (drive.link,)]
        travel = None
        if "s" in self.node:
            if drive.is_crank:
                hint = translate("Write phi_{} = ....", drive.link)
                self.node["s"].reject("link {} turns", drive.link, hint=hint)
            travel = self.node["s"].coordinate()
        self.own = bool(own) or travel is not None
        self.position = own[0].value if own else travel
        first = (drive.assembly_positions or drive.positions)[0]
        if not self.own and not scope.phi_drawn and first == first:
            self.position = first
        self.scene = self._scene(self._of_driver())
        self.figure = Figure(self.scene)

    def _of_driver(self) -> tuple[DrawnFact, ...]:
        """Return the facts that the position of the driver adds."""
        drive, posed = self.scope.drive, self.scope.drive.posed
        if self.own or self.scope.phi_drawn:
            return ()
        if posed is not None:
            kinds = {
                OutputPositionKind.PHI: DrawnKind.PHI,
                OutputPositionKind.BETWEEN: DrawnKind.BETWEEN,
            }
            told = {(fact.kind, frozenset(fact.names)) for fact in self.facts}
            of = tuple(posed.of.split("_"))
            kind = kinds.get(posed.by)
            if kind is None or (kind, frozenset(of)) in told:
                return ()
            return (DrawnFact(kind, of, posed.values[0]),)
        if drive.is_crank and drive.cam_drive is None and self.position is not None:
            return (DrawnFact(DrawnKind.PHI, (drive.link,), self.position),)
        return ()

    def _scene(self, of_driver: tuple[DrawnFact, ...]) -> Scene:
        frame, slides, drive = self.scope.frame, self.scope.slides, self.scope.drive
        points = {
            name: frame.drawn_points.get(name, (place.real, place.imag))
            for name, place in frame.points.items()
        }
        lines: dict[str, FixedLine] = {}
        for name, (through, base, angle) in frame.guides.items():
            lines[name] = frame.drawn_guides.get(
                name, FixedLine(through, (base.real, base.imag), angle)
            )
        line_of: dict[str, str] = {}
        for slider, slide in slides.items():
            if slide.host != FRAME:
                continue
            line_of[slider] = slide.label if slide.label in lines else f"{slider}:0"
            if slide.label not in lines:
                at = (slide.base.real, slide.base.imag)
                lines[f"{slider}:0"] = FixedLine(slide.through, at, slide.angle, slide.towards)
        unknown = [*frame.drawn_points, *frame.drawn_guides]
        unknown += [drive.link] if self.scope.phi_drawn else []
        travel = None
        if not drive.is_crank and self.position is not None and drive.cam_drive is None:
            travel = (drive.link, self.position)
        facts = (*of_driver, *self.facts)
        bodies = {name: body for name, body in self.scope.links.items() if name != FRAME}
        bodies[FRAME] = Body({}, None)
        return Scene(bodies, slides, points, lines, line_of, facts, travel, tuple(unknown))

    def place(self) -> DrawnPosition:
        """Build the figure, and choose its mirror image."""
        missing = self.figure.build()
        figure, drive = self.figure, self.scope.drive
        faults = FigureFaults(
            self.file, figure, self.scope.mechanism,
            joints=[*self._inner_points(set())], crank=drive.link, rules=self.scope.assembly,
        )  # fmt: skip
        if missing:
            faults.note_missing(missing)
        self.node.require_sound()
        axes = {link: self._axis(link) for link in figure.turned}
        unknown_names = self._names_of_unknown()
        core = figure.b.program().needed_for(
            [name for names in unknown_names.values() for name in names if name is not None]
        )
        traced = figure.values()
        shape = (len(figure.images),)
        values = {name: _full(value, shape) for name, value in traced.items()}
        built = np.ones(shape, dtype=bool)
        for step in core.steps:
            if isinstance(values[step.out], np.ndarray):
                built &= np.isfinite(values[step.out])
        if not built.any():
            faults.note_impossible(core.steps, values)
        checks = [*FigureChecks(self.file, figure, values, axes).find()]
        fitting = np.logical_and.reduce([built, *(check.is_consistent for check in checks)])
        if not fitting.any():
            faults.note_contradiction(checks, built)
        chosen = self._direct(self._by_rules(values, fitting, faults), checks)
        found = {k: self._read_unknown(values, k, unknown_names) for k in chosen}
        kept = self._distinct(found, values)
        if len(kept) > 1:
            faults.note_ambiguous(kept, found, values)
        (first, *_) = kept
        images = figure.images[first]
        numbers: dict[str, float] = {**figure.numbers}
        numbers.update(zip(figure.choices, images, strict=True))
        known = {step.out for step in core.steps}
        position = self.position
        if self.scope.phi_drawn:
            position = found[first]["driver", "phi"]
        same = [k for k in chosen if self._agree(found[k], found[first])]
        return DrawnPosition(
            facts=tuple(f for f in self.facts if f.names != (drive.link,) or not self.own),
            file_values=self._values_in_file(),
            places_found=found[first],
            position=position,
            is_stated=self.own,
            program=core,
            numbers={name: value for name, value in numbers.items() if name in known},
            places={name: place for name, place in figure.places.items() if name in known},
            directions={n: d for n, d in figure.directions.items() if n in known},
            rules=self._implied(values, same),
            choosing=tuple(self._choosing()),
        )

    # What is found ---------------------------------------------------------------------------

    def _axis(self, link: str) -> Any:
        """Return the line of a link's own axis, through a placed point of it if there is one."""
        points = self.scene.links[link].points
        here = [point for point in points if point in self.figure.placed]
        there = here or [*self.figure.placed]
        return self.figure.axis(link, PointName(there[0]))

    def _names_of_unknown(self) -> dict[str, tuple[Any, ...]]:
        """Return the points and lines of the unknown places, by name."""
        figure, found = self.figure, dict[str, tuple[Any, ...]]()
        for name in self.scene.unknown:
            if name in self.scene.points:
                found[name] = (PointName(name),)
            elif name in self.scene.lines:
                base = figure.guide_base(name)
                through = base or next(map(PointName, figure.placed))
                found[name] = (base, figure.guide_direction(name, through))
            else:
                found[name] = (self._axis(name),)
        return found

    def _read_unknown(
        self, values: Values, k: int, unknown_names: Mapping[str, tuple[Any, ...]]
    ) -> PlaceValues:
        """Return the unknown numbers of a mirror image by their paths, m and degrees."""
        found: PlaceValues = {}
        size = extent(self.figure, values, k)
        frame = self.scope.frame
        for name, names in unknown_names.items():
            if name in self.scene.points:
                place = complex(values[names[0]][k])
                found["frame", name] = _place(place, frame.drawn_points[name], size)
            elif name in self.scene.lines:
                line, path = self.scene.lines[name], ("frame", "guides", name)
                if line.through is None and None in line.base:
                    place = complex(values[names[0]][k])
                    found[*path, "through"] = _place(place, line.base, size)
                if line.angle is None:
                    angle = _degrees(complex(values[names[1]][1][k]))
                    told = self.figure.line_turns.get(name)
                    known = isinstance(told, str) and self.figure.turned[told].by == "phi"
                    if not known:  # a line has no sense of its own
                        angle = angle - 180.0 if angle > 90.0 else angle + 180.0 * (angle <= -90.0)
                    found[*path, "angle"] = angle
            else:
                found["driver", "phi"] = _degrees(complex(values[names[0]][1][k])) % 360.0
        return found

    def _values_in_file(self) -> PlaceValues:
        """Return what the file has in place of the unknown numbers, by their paths."""
        frame, given = self.scope.frame, dict[tuple[str, ...], Any]()
        for name, place in frame.drawn_points.items():
            given["frame", name] = _value_in_file(place)
        for name, line in frame.drawn_guides.items():
            if line.through is None and None in line.base:
                given["frame", "guides", name, "through"] = _value_in_file(line.base)
            if line.angle is None:
                given["frame", "guides", name, "angle"] = DRAWN
        if self.scope.phi_drawn:
            given["driver", "phi"] = DRAWN
        return given

    # Which mirror image ----------------------------------------------------------------------

    def _by_rules(
        self, values: Values, fitting: npt.NDArray[np.bool_], faults: FigureFaults
    ) -> list[int]:
        """Return the mirror images that the file's assembly rules select."""
        left = [int(k) for k in np.flatnonzero(fitting)]
        for rule in self.scope.assembly:
            if not {rule.point, *rule.refs} <= {*self.figure.placed}:
                continue
            scores = self._scores(rule, values)
            if scores is None:
                continue
            if rule.relation is AssemblyRelation.NEAR:
                best = max(scores[k] for k in left)
                kept = [
                    k for k in left if scores[k] >= best - SAME * extent(self.figure, values, k)
                ]
            else:
                kept = [k for k in left if scores[k] > 0.0]
            if not kept:
                faults.note_rule(rule, left[0], values)
            left = kept
        return left

    def _direct(self, left: list[int], checks: Sequence[Check]) -> list[int]:
        """Return the mirror images in which most angles are those of the axes as directed."""
        turned = [check.is_supplement for check in checks if check.is_supplement is not None]
        counts = {k: sum(bool(one[k]) for one in turned) for k in left}
        return [k for k in left if counts[k] == min(counts.values())]

    def _scores(self, rule: Rule, values: Values) -> Reals | None:
        """Return by how much a rule holds, positive where it does; None if it is not tested."""
        p, *refs = (values[PointName(name)] for name in (rule.point, *rule.refs))
        match rule.relation:
            case AssemblyRelation.RIGHT:
                return np.asarray((p - refs[0]).real)
            case AssemblyRelation.LEFT:
                return np.asarray((refs[0] - p).real)
            case AssemblyRelation.ABOVE:
                return np.asarray((p - refs[0]).imag)
            case AssemblyRelation.BELOW:
                return np.asarray((refs[0] - p).imag)
            case AssemblyRelation.LEFT_OF | AssemblyRelation.RIGHT_OF:
                aside = ((refs[1] - refs[0]).conjugate() * (p - refs[0])).imag
                return np.asarray(aside if rule.relation is AssemblyRelation.LEFT_OF else -aside)
            case AssemblyRelation.NEAR:
                return np.asarray(-np.abs(p - rule.at))
            case _:
                return None

    def _distinct(self, places: Mapping[int, PlaceValues], values: Values) -> list[int]:
        """Return one mirror image for each set of unknown places."""
        kept: list[int] = []
        for k, own in places.items():
            if not any(self._agree(own, places[other]) for other in kept):
                kept.append(k)
        return kept

    def _agree(self, one: PlaceValues, two: PlaceValues) -> bool:
        size = max((abs(v) for found in (one, two) for v in _numbers(found)), default=1.0)
        return all(
            abs(a - b) <= 1e-7 * (size or 1.0)
            for a, b in zip(_numbers(one), _numbers(two), strict=True)
        )

    def _choosing(self) -> Iterator[str]:
        """Yield the points whose rules choose the figure alone, not the assembly of a group."""
        drawn, drive = self.scope.frame.drawn_points, self.scope.drive
        crank = self.scene.links[drive.link].points
        for rule in self.scope.assembly:
            if rule.point in drawn or rule.point in crank:
                yield rule.point

    def _implied(self, values: Values, images: Sequence[int]) -> tuple[Rule, ...]:
        """Return the rules that the figure gives for groups without one."""
        if self.scope.drive.posed is not None:
            return ()
        told = {rule.point for rule in self.scope.assembly} - {*self._choosing()}
        found = []
        for point in self._inner_points(told):
            places = [complex(values[PointName(point)][k]) for k in images]
            one = places[0]
            apart = any(
                abs(place - one) > 1e-7 * extent(self.figure, values, images[0]) for place in places
            )
            if one == one and not apart:
                found.append(Rule(point, AssemblyRelation.NEAR, at=one))
        return tuple(found)

    def _inner_points(self, with_rules: set[str]) -> Iterator[str]:
        """Yield the inner joints of built groups that close in two ways and have no rule."""
        for group in self._groups():
            points = {p for link in group.links for p in self.scene.links[link].points}
            if group.signature not in ("RRR", "RRP") or points & with_rules:
                continue
            (joint,) = group.inner
            assert isinstance(joint, Revolute)
            if joint.point in self.figure.placed:
                yield joint.point

    def _groups(self) -> tuple[AssurGroup, ...]:
        try:
            return analyse(self.scope.mechanism).groups
        except StructureError:
            return ()  # reported where the mechanism is assembled


def _full(value: Any, shape: tuple[int, ...]) -> Any:
    if isinstance(value, tuple):
        return tuple(np.broadcast_to(part, shape) for part in value)
    return np.broadcast_to(value, shape)


def _value_in_file(place: tuple[float | None, float | None]) -> Any:
    """Return a place as the file gives it."""
    return DRAWN if place == (None, None) else [DRAWN if x is None else x for x in place]


def _place(
    place: complex, file_place: tuple[float | None, float | None], size: float
) -> list[float]:
    """Return the coordinates of a place; those that the file gives as they are."""
    parts = (place.real, place.imag)
    return [
        (0.0 if abs(part) <= 1e-12 * size else part) if given is None else given
        for part, given in zip(parts, file_place, strict=True)
    ]


def _degrees(direction: complex) -> float:
    """Return the angle of a direction, without the rounding of its construction."""
    angle = float(np.degrees(np.angle(direction)))
    return 180.0 if angle <= -180.0 + 1e-10 else round(angle, 10) + 0.0


def _numbers(places: PlaceValues) -> list[float]:
    return [x for value in places.values() for x in (value if isinstance(value, list) else [value])]
