"""Moving contents of the page as plain data: outputs of the tape by number, and their places.

A view has a box, mm, and a scale at which the tape's SI numbers are drawn in it; segments and
inscriptions follow outputs. Lengths in millimetres are given at the scales of the sheets, `mu`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from itertools import pairwise
from math import isfinite, lcm
from typing import Any

import numpy as np
import numpy.typing as npt
from msgspec import Struct, field

from planmethod.construct.scale import Scale, series_near
from planmethod.construct.steps import Name, PointName, TriadPose
from planmethod.errors import AssemblyError
from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.forces.statement import link_names
from planmethod.note.narrate.naming import mark, plan_letters, point_name
from planmethod.note.wording import Language
from planmethod.plans.build import Construction, Quantity
from planmethod.plans.draft import cis
from planmethod.plans.forces.board import Force
from planmethod.plans.forces.polygons import Component, Edge
from planmethod.plans.model import FACTS, RATES, PlanKind, assembly_period
from planmethod.plans.motion.position import link_of_axis
from planmethod.problem.model import Drive, Problem
from planmethod.problem.quantities import QuantityKind
from planmethod.render.ink.drawing import Stroke
from planmethod.render.ink.pens import Pen
from planmethod.render.ink.typeset import ink_bounds
from planmethod.render.live.boxes import BOX, box_around
from planmethod.render.live.parts import (
    MovingPart,
    StretchedPart,
    cycle_deg,
    parts_of,
    stretched_parts,
)
from planmethod.render.pictures.lettered import vector_pen
from planmethod.render.pictures.planview import similar_lines
from planmethod.render.pictures.springs import fixed_end, springs_in
from planmethod.render.symbols import SIZES
from planmethod.solved.extents import typical
from planmethod.solved.forces.laws import only_in_positions
from planmethod.solved.forces.loads import applied
from planmethod.solved.forces.statics import Planned, plan_forces, statics_of
from planmethod.solved.many.rows import quantities_for
from planmethod.solved.many.sweep import Sweep
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution

Array = npt.NDArray[Any]
Ref = list[int]
"""Outputs of the two coordinates of a point: ``[k]`` is (k, k+1); ``[k, 1]`` is turned by 90°."""

LETTER, SMALL = 5.0, 4.5

RUNS_OUT = 5.0
"""Ratio of a plan to the typical one above which it runs out of its view."""

SPEEDS = 720
"""Number of angles of a turn at which the page has the speed of a machine."""

_STEPS = {True: 72, False: 60}  # of the positions in which the scheme is drawn
_FINER_STEPS = 4  # refinement of the driver's range for the search


class LiveView(Struct):
    """One picture that moves: the scheme, a plan, the lever.

    ``segments`` are ``{a, b, style, arrow, name, symbol}``; ``labels`` are ``{text, height}`` with
    ``at`` (a point) or ``on`` (a segment); ``turns`` are couples, ``pushes`` forces not to scale.
    """

    id: str
    title: str
    scale: Scale
    per_mm: float = 1.0
    box: tuple[float, float, float, float] = (0.0, 0.0, 1.0, 1.0)
    segments: list[dict[str, Any]] = field(default_factory=list)
    labels: list[dict[str, Any]] = field(default_factory=list)
    turns: list[dict[str, Any]] = field(default_factory=list)
    pushes: list[dict[str, Any]] = field(default_factory=list)


class LiveScene:
    """A problem as it moves.

    Parameters
    ----------
    problem : Problem
    language : Language
    is_round : bool
        Whether the scales are of the series; otherwise the boxes are filled best.

    Attributes
    ----------
    sweep : Sweep
        The tape: its rows are the outputs.
    views : list of LiveView
    parts : list of MovingPart
        Parts of the scheme.
    springs : list of StretchedPart
        Its straight springs.
    shown : Solution
        Solution of the positions that the mechanism moves through, at the scale of the scheme's
        view.

    Raises
    ------
    StructureError, ProblemError, SelfCheckError
    AssemblyError
        None of the positions exists.
    """

    def __init__(self, problem: Problem, language: Language, *, is_round: bool = False) -> None:
        self.problem, self.language, self.is_round = problem, language, is_round
        self._drawn: dict[Name, int] = {}
        self.flywheel = None
        if problem.machine is not None:
            from planmethod.solved.machine.flywheel import Flywheel  # few files have one

            self.flywheel = Flywheel(problem)
        bare = Solution(problem, positions=[])
        self.construction = bare.construction
        self.has_loads = problem.dynamics is not None
        results = quantities_for(bare, None, forces=self.has_loads)
        self.quantities: tuple[Quantity, ...] = results.choose(None)
        self.columns = [column for one in self.quantities for column in one.columns]
        self._row = {column: number for number, column in enumerate(self.columns)}
        self.planned: Planned | None = None
        if self.has_loads:
            draft = self.construction.draft.copy()
            self.planned = plan_forces(bare, draft, applied(bare))
        self.views: list[LiveView] = [
            self._scheme(),
            *map(self._plan, RATES),
            *(self._forces() if self.planned is not None else []),
        ]
        self.sweep = Sweep(problem, forces=self.has_loads, drawn=self.drawn)
        assert [row.name for row in self.sweep.rows][: len(self._row)] == self.columns
        self._explore_range()
        self.parts: list[MovingPart]
        self.parts, self.drawing = parts_of(self.shown, LETTER)
        self.springs: list[StretchedPart] = stretched_parts(self.drawing)
        self._fit_views()
        # Obstacles for inscriptions besides the segments: of the frame, and the sliders.
        still = [bar for part in self.parts if part.link == FRAME for bar in self.bars(part)]
        self.fixed = [[[end.real, -end.imag] for end in bar] for bar in still]
        self.supports = [ink_bounds(list(one.items())) for one in self.drawing.supports]
        self.blocks: list[tuple[Ref, float]] = [
            (self.place(slide.pin), 5.0) for slide in problem.slides.values()
        ]

    def axes(self, part: MovingPart) -> tuple[complex, float]:
        """Return the origin of a link's own axes where its part is drawn, mm, and their turn, °."""
        if part.link == FRAME:
            return 0j, 0.0
        start = complex(self.shown.paper.point(self.anchor_point(part.link))[part.index])
        return start, float(self.shown.links[part.link].phi_deg[part.index])

    def bars(self, part: MovingPart) -> list[tuple[complex, complex]]:
        """Return the lines of a part that inscriptions keep clear of, in its own axes, mm."""
        start, turn = self.axes(part)
        return [
            ((tail - start) * cis(-turn), (head - start) * cis(-turn))
            for item in part.items
            if isinstance(item, Stroke)
            for tail, head in pairwise([*item.points, *(item.points[:1] if item.closed else ())])
            if abs(head - tail) > SIZES.hatch_stroke
        ]

    # Outputs ---------------------------------------------------------------------------------

    def _ref(self, name: Name) -> Ref:
        number = self._drawn.setdefault(name, len(self._drawn))
        return [len(self.columns) + 2 * number]

    @property
    def drawn(self) -> tuple[Name, ...]:
        """Points and numbers of the plans, whose outputs are after those of the quantities."""
        return tuple(self._drawn)

    def place(self, point: str) -> Ref:
        """Return the outputs of the place of a point of the mechanism."""
        return [self._row[f"{point}.x"]]

    def anchor_point(self, link: str) -> PointName:
        """Return the point of a link that its parts follow."""
        return PointName(next(iter(self.problem.bodies[link].points)))

    def rows_of(self, chosen: Callable[[QuantityKind], bool]) -> list[int]:
        """Return the outputs of all quantities of some kinds."""
        return [
            self._row[name] for one in self.quantities if chosen(one.kind) for name in one.columns
        ]

    def row(self, column: str) -> int:
        """Return the output of a column of ``solve --csv``."""
        return self._row[column]

    # Views -----------------------------------------------------------------------------------

    def _scheme(self) -> LiveView:
        kind = PlanKind.POSITION
        view = LiveView("scheme", self.language.sheets["views"][kind.value][0], _unit(kind))
        bodies = self.problem.bodies
        points = dict.fromkeys(p for body in bodies.values() for p in body.points)
        known = [p for p in points if f"{p}.x" in self._row]
        for segment in self.construction.segments:
            ends = segment.name.split("-")
            if segment.kind is kind and all(end in known for end in ends):
                view.segments.append(
                    {
                        "a": self.place(ends[0]),
                        "b": self.place(ends[1]),
                        "style": "hidden",
                        "name": mark(*ends),
                        "symbol": f"l_{{{''.join(ends)}}}",
                    }
                )
        view.labels += [{"at": self.place(p), "text": point_name(p)} for p in known]
        contacts = {mesh.carrier for mesh in self.problem.mechanism.rolling}
        for link, body in bodies.items():
            ends = [p for p in body.points if p in known]
            if link == FRAME or not ends or link in contacts:
                continue
            where = [self.place(ends[0]), self.place(ends[-1])]
            view.labels.append({"text": link, "height": SMALL, "on": where})
        return view

    def _plan(self, kind: PlanKind) -> LiveView:
        return plan_view(self.construction, kind, self.language, self._ref)

    def _forces(self) -> list[LiveView]:
        assert self.planned is not None
        texts, found = self.language.sheets, []
        for number, plan in enumerate(self.planned.board.plans):
            whose = texts.plan_of_group if len(plan.links) > 1 else texts.plan_of_link
            title = whose.format(links=link_names(plan.links))
            view = LiveView(f"forces-{number}", title, _unit(PlanKind.FORCE))
            for edge in (*plan.polygon, *plan.wholes, *plan.inner):
                self._edge(view, edge, is_extra=edge not in plan.polygon)
            found.append(view)
        lever = self._lever()
        return [*found, lever] if lever is not None else found

    def _edge(self, view: LiveView, edge: Edge, *, is_extra: bool) -> None:
        symbol = self.language.notation.symbol(edge.symbol)
        view.labels.append({"text": symbol, "height": SMALL, "of": len(view.segments)})
        view.segments.append(
            {
                "a": self._ref(edge.tail),
                "b": self._ref(edge.head),
                "style": (
                    Pen.RESULTANT if edge.component is Component.TOTAL else Pen.COMPONENT
                ).value,
                "arrow": True,
                "symbol": symbol,
                "beside": is_extra,
            }
        )

    def _lever(self) -> LiveView | None:
        assert self.planned is not None
        lever, notation = self.planned.lever, self.language.notation
        if lever is None:
            return None
        velocity = self.construction.plan(PlanKind.VELOCITY)
        view = LiveView("lever", self.language.sheets.lever, _unit(PlanKind.LEVER))
        bare = Solution(self.problem, positions=[])
        letters = plan_letters(self.problem, velocity)
        lines = [(vector.tail, vector.head) for vector in velocity.vectors]
        for tail, head in [*lines, *similar_lines(bare, velocity)]:
            a, b = [*self._ref(tail), 1], [*self._ref(head), 1]
            view.segments.append({"a": a, "b": b, "style": "thin"})
        for at, own in letters.items():
            view.labels.append({"at": [*self._ref(at), 1], "text": ", ".join(own)})

        def push(at: Ref, symbol: str, tail: PointName, head: PointName) -> None:
            view.labels.append(
                {"text": notation.symbol(symbol), "height": SMALL, "push": len(view.pushes)}
            )
            ends = {"tail": self._ref(tail), "head_at": self._ref(head)}
            view.pushes.append({"at": at, "symbol": notation.symbol(symbol), **ends})

        def turn(link: str, symbol: str, couple: Name) -> None:
            view.labels.append(
                {"text": notation.symbol(symbol), "height": SMALL, "turn": len(view.turns)}
            )
            omega = self._row[f"{link}.omega"]
            view.turns.append(
                {"on": self._segment_of(link), "couple": self._ref(couple)[0], "omega": omega}
            )

        for hung in lever.loads:
            one = hung.load.applied
            if hung.at is None and hung.load.couple is not None:
                turn(one.link, one.name, hung.load.couple)
            elif hung.at is not None and hung.load.force is not None:
                push(self._ref(hung.at), one.name, *hung.load.force.ends)
        drive, driving = self.problem.drive, self.planned.driving
        for other, acting in zip(drive.other_drives, self.planned.other_drivings, strict=True):
            other_symbol = self.problem.balancer_of(other)
            if acting.force is None:
                turn(other.link, other_symbol, acting.balance)
            else:
                push(self._ref_of(other, acting.force), other_symbol, *acting.force.ends)
        motion, symbol = self.construction.kinematics.velocity, self.problem.balancer.symbol
        if driving.between is not None and driving.force is not None:
            both = (driving.force.ends[::-1], driving.force.ends)
            for end, ends in zip(driving.between, both, strict=True):
                push([*self._ref(motion.point[motion.named[end]]), 1], symbol, *ends)
        elif (motor := self.planned.motor) is not None:
            for link, couple in zip(motor.links, motor.couples, strict=True):
                turn(link, symbol, couple)
        elif driving.force is None:
            turn(drive.link, symbol, lever.balance)
        else:
            push(self._ref_of(drive, driving.force), symbol, *driving.force.ends)
        return view

    def _ref_of(self, drive: Drive, force: Force) -> Ref:
        """Return the place on the lever of the point of a driving link that a force acts at."""
        motion = self.construction.kinematics.velocity
        return [*self._ref(motion.point[drive.link, str(force.at)]), 1]

    def _segment_of(self, link: str) -> list[Ref]:
        """Return the ends of the segment of the rotated velocity plan that represents a link."""
        motion = self.construction.kinematics.velocity
        own = [at for (name, _), at in motion.point.items() if name == link]
        ends = [own[0], next((at for at in own if at != own[0]), own[0])]
        return [[*self._ref(end), 1] for end in ends]

    @property
    def period(self) -> float:
        """Driver angle after which the links have the same places, degrees."""
        again = assembly_period(self.construction.draft.choice, 360.0)
        return again if isfinite(again) else 360.0

    def motion(self) -> dict[str, Any] | None:
        """Return the speed of the crank in the steady motion of a machine, by even angles."""
        wheel = self.flywheel
        if wheel is None:
            return None
        omega, _ = wheel.speeds(wheel.even_rotations(SPEEDS * wheel.machine.turns))
        return {
            "omega": [round(value, 9) for value in omega.tolist()],
            "first": wheel.turn.start_deg,
            "sense": wheel.turn.sense,
            "cycle": wheel.machine.cycle_deg,
            "mean": wheel.middle_speed,
        }

    def chosen(self) -> set[str]:
        """Return labels of quantities with a diagram from the start: the last link's motion."""
        link = self.construction.draft.problem.mechanism.links[-1]
        groups = Solution(self.problem, positions=[]).structure.groups
        link = groups[-1].links[-1] if groups else link
        slide = self.problem.slides.get(link)
        if slide is not None and slide.host == FRAME:
            found = {f"v_{slide.pin}", f"a_{slide.pin}"}
        else:
            found = {f"omega_{link}", f"epsilon_{link}"}
        return found | {"M_dr", "F_dr"}

    # Range of the driver ---------------------------------------------------------------------

    def _explore_range(self) -> None:
        """Find the range of the mechanism; choose the scales."""
        drive = self.problem.drive
        if drive.goes_round:
            turns = (round(way / 360.0) for way in (cycle_deg(self.problem), self.period))
            self.driver_range = (0.0, 360.0 * lcm(*turns))
        else:
            self.driver_range = self._reach()
        count = _STEPS[drive.goes_round] * _FINER_STEPS
        self.grid = np.linspace(*self.driver_range, count + 1)
        values, failed = self._run(self.grid)
        own = np.asarray(drive.positions, dtype=float)
        own_values, own_failed = self._run(own)
        self.values = np.hstack((values, own_values))
        self.able = self.grid[failed < 0]
        able, mine = self.able[::_FINER_STEPS], own[own_failed < 0]
        if not (able.size or mine.size):
            failure = self.sweep.failure(float(own[0]))
            raise AssemblyError(str(failure) if failure is not None else "no position exists")
        nominal = Solution(self.problem, positions=(mine if mine.size else able).tolist())
        verify(nominal, forces=self.planned is not None)
        self.scales = dict(nominal.scales)
        if self.planned is not None:
            self.scales[PlanKind.FORCE] = statics_of(nominal).scale
        self.scales[PlanKind.LEVER] = self.scales[PlanKind.VELOCITY]
        places = self._of_places()
        extent = max(np.ptp(places.real) / BOX[0], np.ptp(places.imag) / BOX[1])
        per_mm = self._scale(float(extent))
        unit = {kind: Scale(FACTS[kind].scale, 1.0, FACTS[kind].unit) for kind in PlanKind}
        unit[PlanKind.POSITION] = Scale("mu_l", per_mm, "m")
        chosen = able if able.size else mine
        self.shown = Solution(self.problem, positions=chosen.tolist(), scales=unit)
        self.start = float(mine[0] if mine.size else able[0])
        if drive.goes_round:
            self.start %= self.driver_range[1]

    def _run(self, positions: Array) -> tuple[Array, Array]:
        """Return the outputs in some positions, and the first guard that fails, or -1.

        Loads that are known in the file's positions only leave no forces in others.
        """
        failed = np.empty(positions.shape, np.int16)
        dynamics, own = self.problem.dynamics, self.problem.drive.positions
        if dynamics is None or not only_in_positions(dynamics) or positions.tolist() == list(own):
            return self.sweep.run(positions, failed=failed), failed
        ahead = FACTS[PlanKind.FORCE].prefix
        drawn = [name for name in self._drawn if not name.startswith(ahead)]
        motion = Sweep(self.problem, drawn=drawn)
        values = np.full((len(self.sweep.rows), len(positions)), np.nan)
        number = {row.name: k for k, row in enumerate(self.sweep.rows)}
        values[[number[row.name] for row in motion.rows]] = motion.run(positions, failed=failed)
        return values, failed

    def _of_places(self) -> Array:
        rows = self.rows_of(lambda kind: kind is QuantityKind.PLACE)
        places = self.values[rows[::2]] + 1j * self.values[rows[1::2]]
        held = [
            end
            for spring in springs_in(self.problem)
            if (end := fixed_end(self.problem, spring)) is not None
        ]
        able = places[:, ~np.isnan(places).any(axis=0)]
        return np.vstack([able, *(np.full((1, able.shape[1]), end) for end in held)])

    def _reach(self) -> tuple[float, float]:
        """Return the range of a driving slider: its positions, extended as far as it can go."""
        own = np.asarray(self.problem.drive.positions, dtype=float)
        low, high = float(own.min()), float(own.max())
        size = max([high - low, *(length for _, _, length in self.problem.lengths)]) or 1.0
        ends = []
        for start, sense in ((low, -1.0), (high, 1.0)):
            there = start + sense * size * np.linspace(0.0, 0.5, 1001)
            stop = np.flatnonzero(self._run(there)[1] >= 0)
            ends.append(float(there[max(0, stop[0] - 1)]) if stop.size else float(there[-1]))
        return ends[0], ends[1]

    # Boxes -----------------------------------------------------------------------------------

    def _fit_views(self) -> None:
        """Choose the box and the scale of every view; the scheme has that of its parts."""
        for view in self.views:
            view.scale = self.scales[kind_of(view)]
            if view.id == "scheme":
                view.per_mm = self.shown.scales[PlanKind.POSITION].per_mm
                places = (self._of_places() - self.construction.draft.origin) / view.per_mm
                view.box = box_around(places.ravel(), 17.0)
                continue
            refs = [end for one in view.segments for end in (one["a"], one["b"])]
            refs += [one["at"] for one in view.labels if "at" in one] or [[0]]
            ends = np.array([self._values(ref) for ref in refs])
            if kind_of(view) in RATES:  # of vectors on one line the longest is in its place
                view.segments.sort(key=lambda one: -self._length(one))
            ends = ends[:, ~np.isnan(ends).any(axis=0)]
            sizes = np.maximum(np.ptp(ends.real, axis=0), np.ptp(ends.imag, axis=0))
            ends = ends[:, sizes <= RUNS_OUT * typical(sizes)] if sizes.size else np.zeros((1, 1))
            extent = max(np.ptp(ends.real) / BOX[0], np.ptp(ends.imag) / BOX[1])
            view.per_mm = self._scale(float(extent))
            view.box = box_around(ends.ravel() / view.per_mm, 22.0 if view.pushes else 13.0)

    def _length(self, segment: dict[str, Any]) -> float:
        """Return the median length of a segment of a plan, in the plan's unit."""
        spans = np.abs(self._values(segment["b"]) - self._values(segment["a"]))
        return float(np.median(spans[np.isfinite(spans)]))

    def _scale(self, extent: float) -> float:
        """Return the scale of a view that fills its box, or the next of the series."""
        if not extent:
            return 1.0
        return series_near(0.999 * extent, up=True) if self.is_round else extent

    def _values(self, ref: Ref) -> Array:
        place = self.values[ref[0]] + 1j * self.values[ref[0] + 1]
        return np.asarray(1j * place if ref[1:] else place)

    # Loads -----------------------------------------------------------------------------------

    def loads(self) -> str:
        """Return the function of the loads that differ from position to position, if there are any.

        It is one of JavaScript, see `LoadColumns.javascript`.
        """
        if self.sweep.loads is None:
            return ""
        return self.sweep.loads.javascript([row.name for row in self.sweep.rows])

    def reasons(self) -> list[str]:
        """Return for every guard of the tape why a position has no results if it fails."""
        return reasons_of(self.sweep, self.language, self.sweep.guards)


def reasons_of(
    sweep: Sweep, language: Language, guards: Iterable[tuple[Name, PlanKind]]
) -> list[str]:
    """Return for every guard of a tape why a position has no results if it fails."""
    texts = language.live
    sentences = {
        PlanKind.POSITION: texts.no_place,
        PlanKind.FORCE: texts.no_forces,
        PlanKind.LEVER: texts.no_forces,
    }
    held: dict[Name, str] = {
        step.out: texts.not_held.format(link=link_of_axis(step))
        for step in sweep.program.steps
        if isinstance(step, TriadPose)
    }
    return [
        held.get(step)
        or sentences.get(kind, texts.dead).format(point=point_name(step.partition("~")[0]))
        for step, kind in guards
    ]


def plan_view(
    construction: Construction, kind: PlanKind, language: Language, ref: Callable[[Name], Ref]
) -> LiveView:
    """Return the view of a plan of rates.

    Parameters
    ----------
    ref : callable
        Gives the outputs of a point of the plan.
    """
    plan, problem = construction.plan(kind), construction.draft.problem
    view = LiveView(kind.value, language.sheets["views"][kind.value][0], _unit(kind))
    letters = plan_letters(problem, plan)
    for tail, head in similar_lines(Solution(problem, positions=[]), plan):
        view.segments.append({"a": ref(tail), "b": ref(head), "style": Pen.THIN.value})
    for vector in plan.vectors:
        ends = [letters[end][0] for end in (vector.tail, vector.head)]
        view.segments.append(
            {
                "a": ref(vector.tail),
                "b": ref(vector.head),
                "style": vector_pen(vector, kind).value,
                "arrow": True,
                "name": "".join(ends),
                "symbol": vector.symbol,
            }
        )
    for at, own in letters.items():
        view.labels.append({"at": ref(at), "text": ", ".join(own)})
    return view


def _unit(kind: PlanKind) -> Scale:
    return Scale(FACTS[kind].scale, 1.0, FACTS[kind].unit)


def kind_of(view: LiveView) -> PlanKind:
    """Return the plan that a view shows."""
    name = {"scheme": "position"}.get(view.id, view.id.partition("-")[0])
    return PlanKind.FORCE if name == "forces" else PlanKind(name)
