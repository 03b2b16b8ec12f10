"""Fixed points and guides that a file gives by a drawn position: ``[drawn]`` (рисунок задачи)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.construct.steps import IntersectCircles, IntersectLineCircle, PointName
from planmethod.errors import StructureError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME, Mechanism, Revolute
from planmethod.mechanism.structure import analyse
from planmethod.problem.figure import Figure, Scene, Values
from planmethod.problem.file_node import FileNode
from planmethod.problem.joints import DRAWN, FrameText
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
from planmethod.problem.names import format_length, format_place, listed

ANGLE_TOLERANCE = 0.5
"""Degrees by which an angle that the figure gives once more may differ, as it is rounded."""

LENGTH_TOLERANCE = 0.005
"""Share by which a length that it gives once more may differ."""

SAME = 1e-9
"""Share of the figure's size within which two places are one, and a coordinate is zero."""

SUGGESTED = 8
"""Most numbers that are suggested where the figure does not determine a place."""

Reals: TypeAlias = npt.NDArray[np.float64]
PlaceValues: TypeAlias = dict[tuple[str, ...], Any]
"""Values of the unknown places, m and degrees, by their paths in the file."""


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
    node: FileNode, links: Mapping[str, object], points: Sequence[str]
) -> tuple[DrawnFact, ...]:
    """Read ``[drawn]``.

    Parameters
    ----------
    points : sequence of str
        All points of the mechanism.
    """
    node.table("[drawn] phi_3 = 90, phi_2_3 = 90")

    def read_fact(entry: FileNode) -> DrawnFact:
        key = entry.unmask(str(entry.key))
        if key.startswith("phi_"):
            names = tuple(key.removeprefix("phi_").split("_"))
            for name in names:
                if name not in links:
                    entry.reject_unknown(name, links, "unknown link '{}'")
            if len(names) == 1:
                return DrawnFact(DrawnKind.PHI, names, entry.angle())
            if len(names) != 2 or names[0] == names[1]:
                entry.reject("an angle must be between two links", hint="For example: phi_2_3 = 90")
            degrees = entry.angle()
            if not 0.0 <= degrees <= 180.0:
                entry.reject_value("an angle of two links from 0 to 180 degrees")
            return DrawnFact(DrawnKind.BETWEEN, names, degrees)
        if not key[:1].isupper():
            hint = (
                "phi_3 is the direction of link 3 from +x, phi_2_3 its angle to link 2, AC the "
                "distance of two points."
            )
            entry.reject("unknown key", hint=hint)
        pair = entry.split_line(key, "the mechanism", points)
        return DrawnFact(DrawnKind.LENGTH, pair, entry.length())

    found: dict[tuple[DrawnKind, frozenset[str]], DrawnFact] = {}
    for entry in node.entries():
        fact = None if entry.key == "s" else entry.attempt(read_fact)
        if fact is None:
            continue
        same = found.setdefault((fact.kind, frozenset(fact.of)), fact)
        if same is not fact:
            entry.note("the same as {}", same.key, hint="Keep one of them.")
    node.require_sound()
    return tuple(found.values())


def place_drawn(file: FileNode, facts: tuple[DrawnFact, ...], scope: DrawnScope) -> DrawnPosition:
    """Find the fixed points and guides that are drawn; what prevents it is noted at ``[drawn]``."""
    with np.errstate(all="ignore"):  # a mirror image that does not exist is NaN
        return _Placing(file, facts, scope).place()


class _Check(Struct, frozen=True):
    """A number that the figure need not give, and what the others give, by mirror image.

    ``is_supplement`` where an angle is not that of the axes, but of their lines.
    """

    node: FileNode
    name: str
    given_value: float
    drawn_values: Reals
    unit: str
    off: Reals
    is_supplement: npt.NDArray[np.bool_] | None = None

    @property
    def is_consistent(self) -> npt.NDArray[np.bool_]:
        """Where they agree; a place that is not built contradicts nothing."""
        return ~(self.off > 1.0)


class _Placing:
    """The figure of one file."""

    def __init__(self, file: FileNode, facts: tuple[DrawnFact, ...], scope: DrawnScope) -> None:
        self.file, self.node, self.scope = file, file["drawn"], scope
        self.facts, drive = facts, scope.drive
        own = [fact for fact in facts if fact.kind is DrawnKind.PHI and fact.of == (drive.link,)]
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
            told = {(fact.kind, frozenset(fact.of)) for fact in self.facts}
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
        if missing:
            self._note_missing(missing)
        self.node.require_sound()
        figure, drive = self.figure, self.scope.drive
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
            self._note_impossible(core.steps, values)
        checks = [*self._checks(values, axes)]
        fitting = np.logical_and.reduce([built, *(check.is_consistent for check in checks)])
        if not fitting.any():
            self._note_contradiction(checks, built)
        chosen = self._direct(self._by_rules(values, fitting), checks)
        found = {k: self._read_unknown(values, k, unknown_names) for k in chosen}
        kept = self._distinct(found, values)
        if len(kept) > 1:
            self._note_ambiguous(kept, found, values)
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
            facts=tuple(f for f in self.facts if f.of != (drive.link,) or not self.own),
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
        size = self._extent(values, k)
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

    def _extent(self, values: Values, k: int) -> float:
        """Return the size of the figure in a mirror image, m."""
        places = [complex(values[PointName(p)][k]) for p in self.figure.placed]
        places = [place for place in places if place == place]
        return max(abs(one - places[0]) for one in places) or 1.0

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

    # What the figure says twice --------------------------------------------------------------

    def _checks(self, values: Values, axes: Mapping[str, Any]) -> Iterator[_Check]:
        """Yield the numbers that can be compared with the figure."""
        scene, frame = self.scene, self.file["frame"]
        size = max(self._extent(values, k) for k in range(len(self.figure.images)))
        directions = {link: self._direction(link, values, line) for link, line in axes.items()}
        for fact in scene.facts:
            node = self.node[fact.key]
            if fact.kind is DrawnKind.LENGTH and {*fact.of} <= {*self.figure.placed}:
                found = np.abs(np.subtract(*(values[PointName(p)] for p in fact.of)))
                yield self._length(node, "".join(fact.of), fact.value, found)
            elif fact.kind is DrawnKind.PHI and fact.of[0] in directions:
                found = np.degrees(np.angle(directions[fact.of[0]]))
                off = np.abs((found - fact.value + 180.0) % 360.0 - 180.0)
                yield _Check(node, fact.key, fact.value, found, "deg", off / ANGLE_TOLERANCE)
            elif fact.kind is DrawnKind.BETWEEN and {*fact.of} <= {*directions}:
                yield self._between(node, fact, directions)
        for link, body in scene.links.items():
            here = [p for p in body.points if p in self.figure.placed]
            for p, q in pairwise(here):
                given = abs(body.points[q] - body.points[p])
                found = np.abs(values[PointName(q)] - values[PointName(p)])
                if given:
                    node = self.file["links"][link]
                    yield self._length(node, f"l_{p}{q}", given, found)
        for name, place in scene.points.items():
            for axis, value, part in zip("xy", place, (np.real, np.imag), strict=True):
                if name in self.figure.placed and value is not None:
                    found = part(values[PointName(name)])
                    off = np.abs(found - value) / (LENGTH_TOLERANCE * size)
                    yield _Check(frame[name], f"{axis}_{name}", value, found, "m", off)
        for slider, slide in scene.slides.items():
            line = scene.line_of.get(slider)
            ready = line is not None and slide.pin in self.figure.placed and line in scene.lines
            if ready and line is not None and self.figure.has(line):
                base, direction = self.figure.guide_base(line), self._guide(line)
                if base is None or direction is None:
                    continue
                reach = (values[PointName(slide.pin)] - values[base]) / direction
                off = np.abs(reach.imag - slide.offset) / (LENGTH_TOLERANCE * size)
                name = translate("the distance of {} from its guide", slide.pin)
                node = self.file["links"][slider]
                yield _Check(node, name, slide.offset, reach.imag, "m", off)

    def _guide(self, name: str) -> Any:
        """Return the direction of a guide as the frame has it; None where sliders give it."""
        line = self.scene.lines[name]
        if line.angle is None or line.towards is not None:
            return None
        return np.exp(1j * np.radians(line.angle))

    def _direction(self, link: str, values: Values, line: Any) -> Any:
        """Return the direction of a link: of two points that are placed, else of its axis."""
        points = self.scene.links[link].points
        here = [p for p in points if p in self.figure.placed]
        pairs = [(p, q) for i, p in enumerate(here) for q in here[i + 1 :]]
        pairs = [(p, q) for p, q in pairs if points[p] != points[q]]
        if not pairs:
            return values[line][1]
        p, q = max(pairs, key=lambda pair: abs(points[pair[1]] - points[pair[0]]))
        return (values[PointName(q)] - values[PointName(p)]) / (points[q] - points[p])

    def _between(self, node: FileNode, fact: DrawnFact, directions: Mapping[str, Any]) -> _Check:
        """Compare the angle of two links: of their axes, or of the lines of these."""
        one, two = fact.of
        found = np.abs(np.degrees(np.angle(directions[two] / directions[one])))
        direct, turned = np.abs(found - fact.value), np.abs(180.0 - found - fact.value)
        off = np.minimum(direct, turned) / ANGLE_TOLERANCE
        return _Check(node, fact.key, fact.value, found, "deg", off, turned < direct)

    def _length(self, node: FileNode, name: str, length: float, drawn_lengths: Reals) -> _Check:
        off = np.abs(drawn_lengths - length) / (LENGTH_TOLERANCE * length)
        return _Check(node, name, length, drawn_lengths, "m", off)

    # Which mirror image ----------------------------------------------------------------------

    def _by_rules(self, values: Values, fitting: npt.NDArray[np.bool_]) -> list[int]:
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
                kept = [k for k in left if scores[k] >= best - SAME * self._extent(values, k)]
            else:
                kept = [k for k in left if scores[k] > 0.0]
            if not kept:
                self._note_rule(rule, left[0], values)
            left = kept
        return left

    def _direct(self, left: list[int], checks: Sequence[_Check]) -> list[int]:
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
                abs(place - one) > 1e-7 * self._extent(values, images[0]) for place in places
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

    # Faults ----------------------------------------------------------------------------------

    def _note_missing(self, missing: Sequence[str]) -> None:
        """Note what the figure does not determine, and which number would."""
        names = listed(self._called(name) for name in missing)
        told = [key for key, fact in self._candidates() if self._suffices(fact)][:SUGGESTED]
        links = [link for link in self.scope.mechanism.links if link not in self.figure.turned]
        if told:
            hint = translate("One of these would determine it: {}.", listed(told))
        else:
            hint = translate(
                "More than one number is missing; the directions of links {} are not known.",
                listed(links),
            )
        self.node.reject("the figure does not determine {}", names, hint=hint)

    def _called(self, name: str) -> str:
        if name in self.scene.points:
            return translate("point {}", name)
        if name in self.scene.lines:
            return translate("guide {}", name)
        return translate("the position of link {}", name)

    def _candidates(self) -> Iterator[tuple[str, DrawnFact | str]]:
        """Yield numbers that the file lacks."""
        mechanism, told = self.scope.mechanism, {fact.key for fact in self.scene.facts}
        for link in mechanism.links:
            if link not in self.figure.turned:
                yield f"phi_{link}", DrawnFact(DrawnKind.PHI, (link,), 57.3)
        pairs = [tuple(joint.links) for joint in mechanism.revolutes]
        for pair in dict.fromkeys((a, b) for links in pairs for a in links for b in links if a < b):
            fact = DrawnFact(DrawnKind.BETWEEN, pair, 57.3)
            if FRAME not in pair and fact.key not in told:
                yield fact.key, fact
        for name, place in self.scope.frame.drawn_points.items():
            if place[0] is None and place[1] is None:
                yield f'{name} = ["drawn", 0]', name

    def _suffices(self, fact: DrawnFact | str) -> bool:
        """Return whether one more number determines all that is sought."""
        scene, points, facts = self.scene, dict(self.scene.points), self.scene.facts
        if isinstance(fact, str):
            points[fact] = (None, 0.0)
        else:
            facts = (*facts, fact)
        more = Scene(
            scene.links, scene.slides, points, scene.lines, scene.line_of, facts, scene.travel,
            scene.unknown,
        )  # fmt: skip
        return not Figure(more).build()

    def _note_impossible(self, steps: Sequence[Any], values: Values) -> None:
        """Note the first arcs or lines of the figure that do not meet."""
        unit = self.file.faults.unit
        for step in steps:
            value = values[step.out]
            if not isinstance(value, np.ndarray) or np.isfinite(value).any():
                continue
            name = str(step.out).partition("~")[0]
            facts = ""
            if isinstance(step, IntersectCircles):
                p, q = values[step.centre1], values[step.centre2]
                apart = np.abs(q - p)
                k = int(np.flatnonzero(np.isfinite(apart))[0])
                one, two = (float(values[r][k]) for r in (step.radius1, step.radius2))
                said = [format_length(x, unit, 6) for x in (one, two, float(apart[k]))]
                facts = translate(
                    "the arcs have radii {} and {}, their centres are {} apart", *said
                )
            elif isinstance(step, IntersectLineCircle):
                p, u = values[step.line]
                away = np.abs(((values[step.centre] - p) * np.conj(u)).imag) / np.abs(u)
                k = int(np.flatnonzero(np.isfinite(away))[0])
                radius = float(values[step.radius][k])
                said = [format_length(x, unit, 6) for x in (radius, float(away[k]))]
                facts = translate(
                    "the arc has the radius {}, the line is {} from its centre", *said
                )
            else:
                facts = translate("its lines are parallel")
            hint = "Check these lengths, and the angles in [drawn]."
            self.node.reject("the figure cannot be built at {}: {}", name, facts, hint=hint)
        self.node.reject("the figure cannot be built", hint="Check the angles in [drawn].")

    def _note_contradiction(self, checks: Sequence[_Check], built: npt.NDArray[np.bool_]) -> None:
        """Note the numbers that the nearest mirror image contradicts."""
        off = np.array(
            [np.where(check.is_consistent, 0.0, np.minimum(check.off, 1e9)) for check in checks]
        )
        total = np.where(built, (off > 0).sum(axis=0) * 1e12 + off.sum(axis=0), np.inf)
        k = int(np.argmin(total))
        unit = self.file.faults.unit
        for check in checks:
            if check.is_consistent[k]:
                continue
            said = [
                format_length(x, unit, 6) if check.unit == "m" else f"{x:.6g}°"
                for x in (check.given_value, float(check.drawn_values[k]))
            ]
            hint = translate(
                "Correct or remove one of the numbers. Angles may differ by {:g}°, lengths by "
                "{:g} %.",
                *(ANGLE_TOLERANCE, 100.0 * LENGTH_TOLERANCE),
            )
            message = "{} = {} is given, and the other data of the figure give {}"
            check.node.note(message, check.name, *said, hint=hint)
        self.node.reject_all(())

    def _note_rule(self, rule: Rule, k: int, values: Values) -> None:
        """Note a rule that holds in no mirror image of the figure."""
        unit = self.file.faults.unit
        at = format_place(complex(values[PointName(rule.point)][k]), unit)
        axes = [
            f"{link}: {''.join(body.axis)}"
            for link, body in self.scene.links.items()
            if body.axis is not None and rule.point in body.axis
        ]
        hint = translate("The direction of a link is that of its first length: {}.", listed(axes))
        self.file["assembly"][rule.point].reject(
            "the figure contradicts this rule: {} is at ({}) {}", rule.point, at, translate(unit),
            hint=hint,
        )  # fmt: skip

    def _note_ambiguous(
        self, images: Sequence[int], places: Mapping[int, PlaceValues], values: Values
    ) -> None:
        """Note that several mirror images fit, with rules that distinguish two of them."""
        unit = self.file.faults.unit
        told = []
        for k in images[:4]:
            parts = []
            for path, value in places[k].items():
                if isinstance(value, list):
                    shown = f"({format_place(complex(*value), unit)}) {translate(unit)}"
                else:
                    shown = f"{value:.6g}°"
                parts.append(f"{'.'.join(path[-2:] if len(path) > 2 else path[-1:])} = {shown}")
            told.append(", ".join(parts))
        rules = self._distinguishing(images[0], images[1], values)
        hint = translate("Give another angle, or a rule in [assembly].")
        if rules:
            hint = translate("Give in [assembly] {} for the first or {} for the second.", *rules)
        self.node.reject(
            "{} mirror images of the figure fit: {}", len(images), "; ".join(told), hint=hint
        )

    def _distinguishing(self, one: int, two: int, values: Values) -> tuple[str, str] | None:
        """Return two rules for a joint, of which each holds in one mirror image."""
        best: tuple[float, tuple[str, str]] | None = None
        told = {rule.point for rule in self.scope.assembly}

        def offer(p: str, sides: tuple[float, float], words: tuple[str, str], of: str) -> None:
            nonlocal best
            width = min(map(abs, sides))
            if sides[0] * sides[1] < 0 and width > SAME and (best is None or width > best[0]):
                pair = words if sides[0] > 0 else words[::-1]
                best = width, (f'{p} = "{pair[0]} {of}"', f'{p} = "{pair[1]} {of}"')

        for p, refs in self._comparable():
            if p in told:
                continue
            at = [[complex(values[PointName(q)][k]) for k in (one, two)] for q in (p, *refs)]
            ways = [[place[i] - at[0][i] for i in (0, 1)] for place in at[1:]]
            for q, (v, w) in zip(refs, ways, strict=True):
                offer(p, (-v.real, -w.real), ("right of", "left of"), q)
                offer(p, (-v.imag, -w.imag), ("above", "below"), q)
        if best is not None:
            return best[1]
        for p, refs in self._comparable():
            lines = [(q, r) for q in refs for r in refs if q != r and p not in told]
            for q, r in lines:
                sides = []
                for k in (one, two):
                    a, b, c = (complex(values[PointName(name)][k]) for name in (q, r, p))
                    sides.append(((b - a).conjugate() * (c - a)).imag / (abs(b - a) or 1.0))
                offer(p, (sides[0], sides[1]), ("left of", "right of"), q + r)
        return None if best is None else best[1]

    def _comparable(self) -> Iterator[tuple[str, list[str]]]:
        """Yield points that may have a rule, each with the points that it may be compared with."""
        placed = self.figure.placed
        crank = [p for p in self.scene.links[self.scope.drive.link].points if p in placed]
        crank = [p for p in crank if p not in self.scene.points]
        early = [*(p for p in self.scene.points if p in placed), *crank]
        drawn = [*self.scope.frame.drawn_points, *(crank if self.scope.phi_drawn else ())]
        for p in self._inner_points(set()):
            yield p, [q for q in early if q != p]
        for p in drawn:
            yield p, [q for q in placed if q != p]


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
