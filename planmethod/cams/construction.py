"""A cam by construction, as a program of steps (построение кулачка).

The diagram of the analogue of the acceleration is integrated graphically twice by chords; s over
v_q is drawn with the limiting lines, and the axis of the cam is read; the profile is found by
inverted motion, with s and v_q taken off the diagrams in the compasses. The sizes with which it is
drawn are those of the exact solution. The readings are those of every construction.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from math import degrees, radians
from typing import Any

import numpy as np
from msgspec import Struct, field

from planmethod.cams.design import Bound, CamDesign
from planmethod.cams.geometry import Complexes
from planmethod.cams.laws import Reals
from planmethod.cams.model import TURN, CamPhase, CamProblem, Contact, Stretch
from planmethod.construct.arithmetic import Arithmetic, Float64
from planmethod.construct.drafting import Profile, sigmas
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.hand import Hand
from planmethod.construct.program import Builder, Program
from planmethod.construct.scale import Scale, angle_scale, series_near
from planmethod.construct.steps import LineName, NumberName, PointName, Way

BOX_S, BOX_V, BOX_A = 50.0, 45.0, 60.0
"""Greatest ordinates of the diagrams, mm."""

LEAST_S = 25.0
"""Least height of the diagram of s, mm: from it the profile is laid off."""

APART = 140.0
"""From the axis of a diagram to that of the next below it, mm."""

FREE = frozenset(map(PointName, ("O_a", "O_v", "O_s", "B", "O")))
"""Points that may stand anywhere."""


class CamNode(Struct, frozen=True):
    """A division of the axis of angles (точка деления): its number, phase and angle, rad."""

    number: int
    phase: CamPhase
    phi: float
    starts: bool


class CamScales(Struct, frozen=True):
    """Scales of the diagrams (масштабы): degrees per mm; m per mm of s, v_q, a_q.

    ``region``: m per mm of s over v_q; ``profile``: of the profile. ``pole_v`` and ``pole_a`` are
    the pole distances that follow, mm.
    """

    degree: float
    s: float
    v: float
    a: float
    region: float
    profile: float

    @property
    def phi(self) -> float:
        """Radians per mm."""
        return radians(self.degree)

    @property
    def pole_a(self) -> float:
        """Pole distance of the first integration, mm."""
        return self.v / (self.a * self.phi)

    @property
    def pole_v(self) -> float:
        """Pole distance of the second one, mm."""
        return self.s / (self.v * self.phi)

    def scale(self, name: str) -> Scale:
        """Return the scale of s, v or a."""
        return Scale(f"mu_{name}", float(getattr(self, name)), "m")


def scales_of(
    design: CamDesign, share: float = 1.0, region: float = 150.0, profile: float = 220.0
) -> CamScales:
    """Return scales from the series: diagrams of a share, a region and a profile of so many mm."""
    sizes = np.abs(
        np.concatenate([ends(design.problem, one) for one in design.problem.stretches], 1)
    )
    s, v, a = sizes.max(axis=1)
    boxes = ((s, share * BOX_S), (v, share * BOX_V), (a or s, share * BOX_A))
    mu_s, mu_v, mu_a = (series_near(float(x) / mm, up=True) for x, mm in boxes)
    mu_s = min(mu_s, series_near(float(s) / LEAST_S, up=False))
    geometry = design.geometry
    room = max(geometry.r_min + s, 2 * (a if _is_plate(design) else v))
    if design.problem.oscillates:
        room = max(room, design.problem.arm + v)
    wide = 2 * geometry.centre + geometry.roller if design.problem.oscillates else 0.0
    line = outline(design)
    wide = max(
        wide, *(float(np.ptp(part)) + 2 * geometry.roller for part in (line.real, line.imag))
    )
    return CamScales(
        angle_scale(180.0 / share), mu_s, mu_v, mu_a,
        region=series_near(float(room) / region, up=True),
        profile=series_near(wide / profile, up=True),
    )  # fmt: skip


def ends(problem: CamProblem, stretch: Stretch) -> Reals:
    """Return s, v_q, a_q along a smooth part, its ends from within, shape (3, 33)."""
    return problem.on(stretch, np.linspace(stretch.start, stretch.end, 33))


def outline(design: CamDesign) -> Complexes:
    """Return the theoretical profile and the outer side of a groove, in the frame of the cam, m."""
    at = design.geometry.at(np.linspace(0.0, TURN, 721))
    return np.concatenate([at.theoretical, at.outer])


def _is_plate(design: CamDesign) -> bool:
    return design.problem.contact is Contact.FLAT


def nodes_of(problem: CamProblem) -> tuple[CamNode, ...]:
    """Return the divisions of rise and return, numbered; a dwell has none of its own."""
    found: list[CamNode] = []
    for phase in (CamPhase.RISE, CamPhase.RETURN):
        start, length = problem.starts[phase], problem.length(phase)
        shared = bool(found) and problem.length(CamPhase.UPPER) == 0
        for k in range(shared, problem.parts + 1):
            phi = start + length * k / problem.parts
            found.append(CamNode(len(found), phase, phi, starts=k == 0))
    if problem.length(CamPhase.LOWER) == 0:
        found.pop()  # the turn begins anew
    return tuple(found)


def stretch_of(problem: CamProblem, node: CamNode) -> Stretch:
    """Return the smooth part that a division ends, of the first one of a phase that it begins."""
    own = [one for one in problem.stretches if one.phase is node.phase]
    return next(one for one in own if node.starts or node.phi <= one.end + 1e-9)


def moved_in(problem: CamProblem, node: CamNode) -> Reals:
    """Return s, v_q, a_q in a division, m, from within its phase."""
    return problem.on(stretch_of(problem, node), np.array(node.phi))


def step_between(problem: CamProblem, start: float, end: float) -> float:
    """Return the height of the step that stands for a_q between two divisions, m.

    The ordinate in the middle; where a_q jumps between them, that of the same area.
    """
    slack = 1e-9
    inside = [one.start for one in problem.stretches if start + slack < one.start < end - slack]
    places = np.array([start, *inside, end])
    heights = problem.at((places[1:] + places[:-1]) / 2)[2]
    return float((heights * np.diff(places)).sum() / (end - start))


class CamConstruction(Struct, frozen=True, dict=True):
    """Construction of a cam (построение).

    Attributes
    ----------
    design : CamDesign
    scales : CamScales
    program, data
        The steps, and what they take as given: mm, degrees.
    nodes : tuple of CamNode
    results : mapping
        Numbers that are read, by ``r_min``, ``e``, ``centre_distance``; m.
    drawn : mapping of int to int
        Which division's D the limiting lines pass through, by the number of the line.
    """

    design: CamDesign
    scales: CamScales
    program: Program
    data: Mapping[str, Any]
    nodes: tuple[CamNode, ...]
    results: Mapping[str, NumberName]
    drawn: Mapping[int, int]
    bounds: tuple[Bound, ...]

    def read(self, arithmetic: Arithmetic | None = None) -> Trace:
        """Return the values of every step; float64 when no arithmetic is named."""
        return evaluate(self.program, self.data, arithmetic or Float64())

    @cached_property
    def exact(self) -> Trace:
        """The construction without errors of drawing; those of the method are in it."""
        return self.read()

    def ruled(self, ruler: float) -> Trace:
        """Return what a ruler of this step, mm, gives."""
        return self.read(Hand(ruler=ruler))

    def sigma(self, profile: Profile) -> dict[str, float]:
        """Return the drafting errors of all numbers, one standard deviation."""
        found = sigmas(self.program, self.data, profile, FREE)
        return {name: float(one[0]) for name, one in found.items()}

    def exact_points(self) -> Complexes:
        """Return the exact theoretical profile in the divisions, mm of the drawing."""
        phi = np.array([node.phi for node in self.nodes])
        at = self.design.geometry.points(
            phi, np.array([moved_in(self.design.problem, n) for n in self.nodes]).T
        )
        found = at.actual if _is_plate(self.design) else at.theoretical
        return np.asarray(found / self.scales.profile)


class _Draft(Struct):
    """Construction in the making."""

    design: CamDesign
    scales: CamScales
    nodes: tuple[CamNode, ...]
    b: Builder = field(default_factory=Builder)
    data: dict[str, Any] = field(default_factory=dict)
    s: dict[int, NumberName] = field(default_factory=dict)
    v: dict[int, NumberName] = field(default_factory=dict)
    ends: dict[int, PointName] = field(default_factory=dict)
    results: dict[str, NumberName] = field(default_factory=dict)

    def given(self, name: str, at: complex = 0j) -> PointName:
        self.data[name] = at
        return self.b.given(name)

    def known(self, name: str, value: float) -> NumberName:
        self.data[name] = float(value)
        return self.b.known(name)

    # Diagrams -------------------------------------------------------------------------------------

    def integrate(self) -> None:
        """Integrate the diagram of a_q twice."""
        b, scales, problem = self.b, self.scales, self.design.problem
        origins = [self.given(f"O_{name}", -1j * APART * k) for k, name in enumerate("avs")]
        level = self.known("0", 0.0)
        axes = [b.at_angle(origin, None, level) for origin in origins]
        ups = [b.perpendicular(origin, axis) for origin, axis in zip(origins, axes, strict=True)]
        poles = [
            b.lay_off(f"π_{name}", origins[k], axes[k], self.known(f"H_{name}", -size))
            for k, (name, size) in enumerate((("a", scales.pole_a), ("v", scales.pole_v)))
        ]

        def upright(k: str, phi: float) -> LineName:
            at = self.known(f"φ {k}", degrees(phi) / scales.degree)
            return b.perpendicular(b.lay_off(f"x {k}", origins[0], axes[0], at), axes[0])

        end: dict[str, PointName] = {}
        for last, node in zip((None, *self.nodes), self.nodes, strict=False):
            k, line = node.number, upright(str(node.number), node.phi)
            feet = [b.meet_lines(f"{name}_{{{k}}} axis", line, axis)
                    for name, axis in zip("vs", axes[1:], strict=True)]  # fmt: skip
            if last is None or node.starts:
                end["v"] = feet[0]
                if jump := float(moved_in(problem, node)[1]):
                    height = self.known(f"jump {k}", jump / scales.v)
                    end["v"] = b.lay_off(f"V_{{{k}}}", feet[0], line, height)
                flat = b.parallel(end["s"], axes[2]) if last else axes[2]
                end["s"] = b.meet_lines(f"S_{{{k}}}", line, flat) if last else feet[1]
            else:
                middle = (last.phi + node.phi) / 2
                size = step_between(problem, last.phi, node.phi)
                up = b.lay_off(
                    f"m_{{{k}}}", origins[0], ups[0], self.known(f"y {k}", size / scales.a)
                )
                chord = b.parallel(end["v"], b.join(poles[0], up))
                end["v"] = b.meet_lines(f"V_{{{k}}}", chord, line)
                half = b.meet_lines(f"M_{{{k}}}", chord, upright(f"{k}'", middle))
                side = b.meet_lines(f"n_{{{k}}}", b.parallel(half, axes[1]), ups[1])
                chord = b.parallel(end["s"], b.join(poles[1], side))
                end["s"] = b.meet_lines(f"S_{{{k}}}", chord, line)
            self.s[k] = b.measure_along(f"s_{{{k}}}", feet[1], end["s"], line)
            self.v[k] = b.measure_along(f"v_{{{k}}}", feet[0], end["v"], line)

    # Region ---------------------------------------------------------------------------------------

    def region(self) -> dict[int, int]:
        """Draw s over v_q with the limiting lines, and read the axis."""
        design, b, mm = self.design, self.b, self.scales.region
        one, plate = design.problem, _is_plate(design)
        if plate and one.oscillates:
            return {}
        start = self.given("B")
        level = b.at_angle(start, None, self.known("level", 0.0))
        up = b.perpendicular(start, level)
        rays: dict[int, LineName] = {}
        pivot = base = None
        if one.oscillates:
            pivot = b.lay_off("O_{2}", start, level, self.known("l", design.side * one.arm / mm))
            base = b.join(pivot, start)
        for node in self.nodes:
            k = node.number
            v = self._taken(f"v {k}:", self.v[k], self.scales.v / mm)
            if pivot is not None and base is not None:
                turn = -design.side * degrees(self.scales.s / one.arm)
                rays[k] = b.at_angle(pivot, base, self._taken(f"ψ_{{{k}}}", self.s[k], turn))
                at = b.lay_off(f"B_{{{k}}}'", pivot, rays[k], self.known(f"l {k}", one.arm / mm))
                along = b.compute(f"v {k}'", (v, 1), factor=design.side)
                self.ends[k] = b.lay_off(f"D_{{{k}}}", at, rays[k], along)
                continue
            s = self._taken(f"s {k}:", self.s[k], self.scales.s / mm)
            at = b.lay_off(f"B_{{{k}}}'", start, up, s)
            across = b.compute(f"v {k}'", (v, 1), factor=-1.0)
            if plate:
                size = float(moved_in(one, node)[2])
                across = self.known(f"a {k}", size / mm)
            self.ends[k] = b.lay_off(f"D_{{{k}}}", at, b.parallel(at, level), across)
        if plate:
            return self._plate(start, up)
        axis, drawn = self._axis(start, level, pivot, rays)
        if axis is None:
            return {}
        self.results["r_min"] = self._result("r_min", b.measure("O_{1}B", axis, start))
        if pivot is not None:
            self.results["centre_distance"] = self._result(
                "a", b.measure("O_{1}O_{2}", axis, pivot)
            )
        else:
            foot = b.meet_lines("E", b.parallel(axis, level), up)
            self.results["e"] = self._result("e", b.measure_along("O_{1}E", axis, foot, level))
        return drawn

    def _plate(self, start: PointName, up: LineName) -> dict[int, int]:
        """Lead a line at 45° to the curve of s over a_q: it cuts off r_min."""
        sums = [float(moved_in(self.design.problem, n)[::2].sum()) for n in self.nodes]
        k, b = int(np.argmin(sums)), self.b
        line = b.at_angle(self.ends[k], None, self.known("45", -45.0))
        foot = b.meet_lines("K", line, up)
        reach = b.measure("KB", foot, start)
        added = self.known("ρ", self.design.problem.least / self.scales.region)
        length = b.total("r_min, mm", reach, added)
        self.results["r_min"] = self._result("r_min", length)
        return {0: k}

    def _result(self, name: str, length: NumberName) -> NumberName:
        return self.b.compute(name, (length, 1), factor=self.scales.region)

    def _taken(self, name: str, of: NumberName, factor: float) -> NumberName:
        return self.b.compute(name, (of, 1), factor=factor)

    def _axis(
        self, start: PointName, level: LineName, pivot: PointName | None,
        rays: Mapping[int, LineName],
    ) -> tuple[PointName | None, dict[int, int]]:  # fmt: skip
        """Draw the limiting lines and find the axis where they meet, or where it is asked."""
        design, b, mm = self.design, self.b, self.scales.region
        one, z = design.problem, design.axis
        lines: list[LineName] = []
        drawn: dict[int, int] = {}
        for number, bound in enumerate(design.bounds if one.r_min is None else ()):
            k = self._tangent(bound, z)
            limit = one.limit(bound.phase)
            assert limit is not None
            angle = -90.0 + bound.sign * degrees(limit)
            if pivot is not None:
                angle += 180.0 if design.side > 0 else 0.0
            angle = (angle + 180.0) % 360.0 - 180.0
            turned = self.known(f"angle {number}", angle)
            lines.append(b.at_angle(self.ends[k], rays.get(k), turned))
            drawn[number] = k
        if len(lines) == 2:
            return b.meet_lines("O_{1}", *lines), drawn
        if not lines:
            return None, drawn
        if pivot is not None and one.centre is not None:
            size = self.known("a, mm", one.centre / mm)
            return b.meet_line_circle("O_{1}", lines[0], pivot, size, Way.FORWARD), drawn
        if one.offset is not None:
            foot = b.lay_off("G", start, level, self.known("e, mm", -one.offset / mm))
            return b.meet_lines("O_{1}", lines[0], b.perpendicular(foot, level)), drawn
        return b.meet_lines("O_{1}", lines[0], b.perpendicular(start, lines[0])), drawn

    def _tangent(self, bound: Bound, z: complex) -> int:
        """Return the division through whose D a limiting line leaves all others inside."""
        own = [n for n in self.nodes if n.phase is bound.phase]

        def broken(node: CamNode) -> float:
            stretch = stretch_of(self.design.problem, node)
            a, b, c = self.design.half_planes(stretch, np.array(node.phi), bound.sign)
            return float((a * z.real + b * z.imag - c) / np.hypot(a, b))

        return max(own, key=broken).number

    # Profile --------------------------------------------------------------------------------------

    def profile(self) -> None:
        """Find the profile by inverted motion."""
        design, b, mm = self.design, self.b, self.scales.profile
        one, geometry = design.problem, design.geometry
        axis = self.given("O")
        sizes = {
            "e": geometry.e, "r_{min}": geometry.r_min, "a": geometry.centre,
            "r_{p}": -geometry.roller, "l": one.arm,
        }  # fmt: skip
        size = {name: self.known(f"{name}: mm", value / mm) for name, value in sizes.items()}
        for node in self.nodes:
            k = node.number
            turn = -degrees(node.phi) + (180.0 if one.oscillates and design.side < 0 else 0.0)
            ray = b.at_angle(axis, None, self.known(f"−φ {k}", turn))
            s = self._taken(f"s {k}, mm", self.s[k], self.scales.s / mm)
            v = self._taken(f"v {k}, mm", self.v[k], self.scales.v / mm)
            if one.oscillates:
                point, pole = self._swung(node, axis, ray, size)
            elif _is_plate(design):
                upright = b.perpendicular(axis, ray)
                foot = b.lay_off(f"K_{{{k}}}", axis, upright, b.total(f"h {k}", s, size["r_{min}"]))
                b.lay_off(f"B_{{{k}}}", foot, b.parallel(foot, ray), v)
                b.measure(f"R_{{{k}}}", axis, PointName(f"B_{{{k}}}"))
                continue
            else:
                pole = b.lay_off(f"P_{{{k}}}", axis, ray, v)
                foot = b.lay_off(f"K_{{{k}}}", axis, ray, size["e"])
                line = b.perpendicular(foot, ray)
                low = b.meet_line_circle(f"L_{{{k}}}", line, axis, size["r_{min}"], Way.FORWARD)
                point = b.lay_off(f"B_{{{k}}}", low, line, s)
            b.measure(f"R_{{{k}}}", axis, point)
            if one.contact is Contact.ROLLER:
                b.lay_off(f"A_{{{k}}}", point, b.join(pole, point), size["r_{p}"])

    def _swung(
        self, node: CamNode, axis: PointName, ray: LineName, size: Mapping[str, NumberName]
    ) -> tuple[PointName, PointName]:
        """Return the roller of a pivoted follower, or the point of its plate, and the pole."""
        b, design, k = self.b, self.design, node.number
        one, side = design.problem, design.side
        pivot = b.lay_off(f"C_{{{k}}}", axis, ray, size["a"])
        rest = self.known(f"δ {k}", 180.0 - side * degrees(design.geometry.delta0))
        turn = -side * degrees(self.scales.s / one.arm)
        delta = b.total(f"δ_{{{k}}}", rest, self._taken(f"ψ {k}", self.s[k], turn))
        arm = b.at_angle(pivot, ray, delta)
        speed = self._taken(f"ψ' {k}", self.v[k], side * self.scales.v / one.arm)
        ahead = b.total(f"1 + ψ' {k}", self.known(f"1 {k}", 1.0), speed)
        reach = b.compute(f"OP {k}", (size["a"], 1), (speed, 1), (ahead, -1))
        pole = b.lay_off(f"P_{{{k}}}", axis, ray, reach)
        if _is_plate(design):
            return b.meet_lines(f"B_{{{k}}}", b.perpendicular(pole, arm), arm), pole
        return b.lay_off(f"B_{{{k}}}", pivot, arm, size["l"]), pole


def construct(design: CamDesign, scales: CamScales | None = None) -> CamConstruction:
    """Return the construction of a cam."""
    draft = _Draft(design, scales or scales_of(design), nodes_of(design.problem))
    draft.integrate()
    drawn = draft.region()
    draft.profile()
    bounds = design.bounds if drawn and not _is_plate(design) else ()
    return CamConstruction(
        design,
        draft.scales,
        draft.b.program(),
        draft.data,
        draft.nodes,
        draft.results,
        drawn,
        bounds,
    )
