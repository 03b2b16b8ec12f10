"""A cam by construction, as a program of steps, and its ruler readings (построение кулачка)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from math import degrees
from typing import Any

import numpy as np
from msgspec import Struct, field

from planmethod.cams.design import (
    Bound,
    CamDesign,
    CamNode,
    is_plate,
    motion_in_division,
    nodes_of,
    step_between,
    stretch_of,
)
from planmethod.cams.model import Complexes, Contact
from planmethod.cams.scales import CamScales, scales_of
from planmethod.cams.text import MM
from planmethod.construct.arithmetic import Arithmetic, Float64
from planmethod.construct.drafting import Profile, RulerArithmetic, sigmas
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.program import Builder, Program
from planmethod.construct.steps import LineName, LineSense, NumberName, PointName
from planmethod.note.compared import Series, measured_series, sigma_text
from planmethod.note.document import Table, table_of
from planmethod.note.formula import Rich
from planmethod.note.wording import Language
from planmethod.solved.reading import Reals

DIAGRAM_SPACING = 140.0
"""Distance between the axes of neighbouring diagrams, mm."""

FREE = frozenset(map(PointName, ("O_a", "O_v", "O_s", "B", "O")))
"""Points of arbitrary position."""


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
        """Return the values of every step; default: float64."""
        return evaluate(self.program, self.data, arithmetic or Float64())

    @cached_property
    def exact(self) -> Trace:
        """The construction without errors of drawing; those of the method are in it."""
        return self.read()

    def ruled(self, ruler: float) -> Trace:
        """Return the readings of a ruler of this step, mm."""
        return self.read(RulerArithmetic(ruler=ruler))

    def sigma(self, profile: Profile) -> dict[str, float]:
        """Return the drafting errors of all numbers, one standard deviation."""
        found = sigmas(self.program, self.data, profile, FREE)
        return {name: float(one[0]) for name, one in found.items()}

    def exact_points(self) -> Complexes:
        """Return the exact theoretical profile in the divisions, mm of the drawing."""
        phi = np.array([node.phi for node in self.nodes])
        at = self.design.geometry.points(
            phi, np.array([motion_in_division(self.design.problem, n) for n in self.nodes]).T
        )
        found = at.actual if is_plate(self.design) else at.theoretical
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

    def take_point(self, name: str, at: complex = 0j) -> PointName:
        self.data[name] = at
        return self.b.take_point(name)

    def known(self, name: str, value: float) -> NumberName:
        self.data[name] = float(value)
        return self.b.known(name)

    # Diagrams -------------------------------------------------------------------------------------

    def integrate(self) -> None:
        """Integrate the diagram of a_q twice."""
        b, scales, problem = self.b, self.scales, self.design.problem
        origins = [
            self.take_point(f"O_{name}", -1j * DIAGRAM_SPACING * k) for k, name in enumerate("avs")
        ]
        level = self.known("0", 0.0)
        axes = [b.at_angle(origin, None, level) for origin in origins]
        ups = [b.perpendicular(origin, axis) for origin, axis in zip(origins, axes, strict=True)]
        poles = [
            b.lay_off_length(f"π_{name}", origins[k], axes[k], self.known(f"H_{name}", -size))
            for k, (name, size) in enumerate((("a", scales.pole_a), ("v", scales.pole_v)))
        ]

        def upright(k: str, phi: float) -> LineName:
            at = self.known(f"φ {k}", degrees(phi) / scales.degree)
            return b.perpendicular(b.lay_off_length(f"x {k}", origins[0], axes[0], at), axes[0])

        end: dict[str, PointName] = {}
        for last, node in zip((None, *self.nodes), self.nodes, strict=False):
            k, line = node.number, upright(str(node.number), node.phi)
            feet = [b.intersect_lines(f"{name}_{{{k}}} axis", line, axis)
                    for name, axis in zip("vs", axes[1:], strict=True)]  # fmt: skip
            if last is None or node.starts:
                end["v"] = feet[0]
                if jump := float(motion_in_division(problem, node)[1]):
                    height = self.known(f"jump {k}", jump / scales.v)
                    end["v"] = b.lay_off_length(f"V_{{{k}}}", feet[0], line, height)
                if not node.motion.before:  # from the axis, whatever was drawn before
                    end["s"] = feet[1]
                elif last is None:
                    lifted = self.known("s at 0", node.motion.before / scales.s)
                    end["s"] = b.lay_off_length(f"S_{{{k}}}", feet[1], line, lifted)
                else:
                    flat = b.parallel(end["s"], axes[2])
                    end["s"] = b.intersect_lines(f"S_{{{k}}}", line, flat)
            else:
                middle = (last.phi + node.phi) / 2
                size = step_between(problem, last.phi, node.phi)
                up = b.lay_off_length(
                    f"m_{{{k}}}", origins[0], ups[0], self.known(f"y {k}", size / scales.a)
                )
                chord = b.parallel(end["v"], b.join(poles[0], up))
                end["v"] = b.intersect_lines(f"V_{{{k}}}", chord, line)
                half = b.intersect_lines(f"M_{{{k}}}", chord, upright(f"{k}'", middle))
                side = b.intersect_lines(f"n_{{{k}}}", b.parallel(half, axes[1]), ups[1])
                chord = b.parallel(end["s"], b.join(poles[1], side))
                end["s"] = b.intersect_lines(f"S_{{{k}}}", chord, line)
            self.s[k] = b.measure_along(f"s_{{{k}}}", feet[1], end["s"], line)
            self.v[k] = b.measure_along(f"v_{{{k}}}", feet[0], end["v"], line)

    # Region ---------------------------------------------------------------------------------------

    def region(self) -> dict[int, int]:
        """Draw s over v_q with the limiting lines, and read the axis."""
        design, b, mm = self.design, self.b, self.scales.region
        one, plate = design.problem, is_plate(design)
        if plate and one.r_min is not None:
            return {}  # the axis is given
        start = self.take_point("B")
        level = b.at_angle(start, None, self.known("level", 0.0))
        up = b.perpendicular(start, level)
        rays: dict[int, LineName] = {}
        pivot = base = None
        if one.oscillates:
            pivot = b.lay_off_length(
                "O_{2}", start, level, self.known("l", design.side * one.arm / mm)
            )
            base = b.join(pivot, start)
        for node in self.nodes:
            k = node.number
            v = self._scale_length(f"v {k}:", self.v[k], self.scales.v / mm)
            if pivot is not None and base is not None:
                turn = -design.side * degrees(self.scales.s / one.arm)
                rays[k] = b.at_angle(pivot, base, self._scale_length(f"ψ_{{{k}}}", self.s[k], turn))
                if plate:
                    self.ends[k] = self._swung_end(node, pivot, rays[k], v)
                    continue
                at = b.lay_off_length(
                    f"B_{{{k}}}'", pivot, rays[k], self.known(f"l {k}", one.arm / mm)
                )
                along = b.compute(f"v {k}'", (v, 1), factor=design.side)
                self.ends[k] = b.lay_off_length(f"D_{{{k}}}", at, rays[k], along)
                continue
            s = self._scale_length(f"s {k}:", self.s[k], self.scales.s / mm)
            at = b.lay_off_length(f"B_{{{k}}}'", start, up, s)
            across = b.compute(f"v {k}'", (v, 1), factor=-1.0)
            if plate:
                size = float(motion_in_division(one, node)[2])
                across = self.known(f"a {k}", size / mm)
            self.ends[k] = b.lay_off_length(f"D_{{{k}}}", at, b.parallel(at, level), across)
        if pivot is not None and base is not None and plate:
            return self._swung_plate(pivot, base)
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
            foot = b.intersect_lines("E", b.parallel(axis, level), up)
            self.results["e"] = self._result("e", b.measure_along("O_{1}E", axis, foot, level))
        return drawn

    def _plate(self, start: PointName, up: LineName) -> dict[int, int]:
        """Lead a line at 45° to the curve of s over a_q: it cuts off r_min."""
        sums = [float(motion_in_division(self.design.problem, n)[::2].sum()) for n in self.nodes]
        k, b = int(np.argmin(sums)), self.b
        line = b.at_angle(self.ends[k], None, self.known("45", -45.0))
        foot = b.intersect_lines("K", line, up)
        reach = b.measure("KB", foot, start)
        added = self.known("ρ", self.design.problem.min_radius / self.scales.region)
        length = b.total("r_min, mm", reach, added)
        self.results["r_min"] = self._result("r_min", length)
        return {0: k}

    def _swung_end(
        self, node: CamNode, pivot: PointName, ray: LineName, v: NumberName
    ) -> PointName:
        """Lay l ± 2v_q off along the flat face and a_q·l/(l ± v_q) across it.

        The profile is convex where the axis is below the line from the pivot through this end.
        """
        b, k, mm = self.b, node.number, self.scales.region
        v = b.compute(f"v {k}'", (v, 1), factor=float(self.design.side))
        arm = self.known(f"l {k}", self.design.problem.arm / mm)
        at = b.lay_off_length(f"B_{{{k}}}'", pivot, ray, b.total(f"l + 2v {k}", arm, v, v))
        gain = self.known(f"a {k}", float(motion_in_division(self.design.problem, node)[2]) / mm)
        ahead = b.total(f"l + v {k}", arm, v)
        # The perpendicular is the ray turned by +90°: upwards where the pivot is on the left.
        up = -self.design.side * self.design.problem.arm / mm
        across = b.compute(f"a {k}'", (gain, 1), (ahead, -1), factor=up)
        return b.lay_off_length(f"D_{{{k}}}", at, b.perpendicular(at, ray), across)

    def _swung_plate(self, pivot: PointName, base: LineName) -> dict[int, int]:
        """Draw the steepest line through the pivot and a D: it meets the circle of the axis."""
        b, design, mm = self.b, self.design, self.scales.region
        one, k = design.problem, self._steepest()
        line = b.join(pivot, self.ends[k])
        if one.min_radius:
            reach = b.measure(f"O_{{2}}D_{{{k}}}", pivot, self.ends[k])
            size = (NumberName(f"l + v {k}"), 2), (reach, -1)
            off = b.compute("ρ'", *size, factor=design.side * one.min_radius / one.arm)
            line = b.parallel(b.lay_off_length("G", pivot, b.perpendicular(pivot, line), off), line)
        centre = self.known("a, mm", design.geometry.centre / mm)
        axis = b.intersect_line_circle("O_{1}", line, pivot, centre, LineSense.FORWARD)
        foot = b.intersect_lines("K", b.perpendicular(axis, base), base)
        self.results["r_min"] = self._result("r_min", b.measure("O_{1}K", axis, foot))
        return {0: k}

    def _steepest(self) -> int:
        """Return the division whose line limits the axis most by convexity."""
        one, geometry, side = self.design.problem, self.design.geometry, self.design.side

        def spare(node: CamNode) -> float:
            s, v, a = motion_in_division(one, node) / one.arm
            ahead, delta = 1 + side * v, geometry.delta0 + s
            across, along = 1 + 2 * side * v, a / ahead
            kept = geometry.centre * (across * np.sin(delta) + along * np.cos(delta))
            return float((kept - one.min_radius * ahead**2) / np.hypot(across, along))

        return min(self.nodes, key=spare).number

    def _result(self, name: str, length: NumberName) -> NumberName:
        return self.b.compute(name, (length, 1), factor=self.scales.region)

    def _scale_length(self, name: str, of: NumberName, factor: float) -> NumberName:
        return self.b.compute(name, (of, 1), factor=factor)

    def _axis(
        self, start: PointName, level: LineName, pivot: PointName | None,
        rays: Mapping[int, LineName],
    ) -> tuple[PointName | None, dict[int, int]]:  # fmt: skip
        """Draw the limiting lines and find the axis: their intersection, or the given point."""
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
            return b.intersect_lines("O_{1}", *lines), drawn
        if not lines:
            return None, drawn
        if pivot is not None and one.centre is not None:
            size = self.known("a, mm", one.centre / mm)
            return b.intersect_line_circle("O_{1}", lines[0], pivot, size, LineSense.FORWARD), drawn
        if one.offset is not None:
            foot = b.lay_off_length("G", start, level, self.known("e, mm", -one.offset / mm))
            return b.intersect_lines("O_{1}", lines[0], b.perpendicular(foot, level)), drawn
        return b.intersect_lines("O_{1}", lines[0], b.perpendicular(start, lines[0])), drawn

    def _tangent(self, bound: Bound, z: complex) -> int:
        """Return the division whose limiting line has the points D of all others inside."""
        own = [n for n in self.nodes if n.motion == bound.motion]

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
        axis = self.take_point("O")
        sizes = {
            "e": geometry.e, "r_{min}": geometry.r_min, "a": geometry.centre,
            "r_{p}": -geometry.roller, "l": one.arm,
        }  # fmt: skip
        size = {name: self.known(f"{name}: mm", value / mm) for name, value in sizes.items()}
        for node in self.nodes:
            k = node.number
            turn = -degrees(node.phi) + (180.0 if one.oscillates and design.side < 0 else 0.0)
            ray = b.at_angle(axis, None, self.known(f"−φ {k}", turn))
            s = self._scale_length(f"s {k}, mm", self.s[k], self.scales.s / mm)
            v = self._scale_length(f"v {k}, mm", self.v[k], self.scales.v / mm)
            if one.oscillates:
                point, pole = self._swung(node, axis, ray, size)
            elif is_plate(design):
                upright = b.perpendicular(axis, ray)
                foot = b.lay_off_length(
                    f"K_{{{k}}}", axis, upright, b.total(f"h {k}", s, size["r_{min}"])
                )
                b.lay_off_length(f"B_{{{k}}}", foot, b.parallel(foot, ray), v)
                b.measure(f"R_{{{k}}}", axis, PointName(f"B_{{{k}}}"))
                continue
            else:
                pole = b.lay_off_length(f"P_{{{k}}}", axis, ray, v)
                foot = b.lay_off_length(f"K_{{{k}}}", axis, ray, size["e"])
                line = b.perpendicular(foot, ray)
                low = b.intersect_line_circle(
                    f"L_{{{k}}}", line, axis, size["r_{min}"], LineSense.FORWARD
                )
                point = b.lay_off_length(f"B_{{{k}}}", low, line, s)
            b.measure(f"R_{{{k}}}", axis, point)
            if one.contact is Contact.ROLLER:
                b.lay_off_length(f"A_{{{k}}}", point, b.join(pole, point), size["r_{p}"])

    def _swung(
        self, node: CamNode, axis: PointName, ray: LineName, size: Mapping[str, NumberName]
    ) -> tuple[PointName, PointName]:
        """Return an oscillating follower's roller, or the point of its flat face, and the pole."""
        b, design, k = self.b, self.design, node.number
        one, side = design.problem, design.side
        pivot = b.lay_off_length(f"C_{{{k}}}", axis, ray, size["a"])
        rest = self.known(f"δ {k}", 180.0 - side * degrees(design.geometry.delta0))
        turn = -side * degrees(self.scales.s / one.arm)
        delta = b.total(f"δ_{{{k}}}", rest, self._scale_length(f"ψ {k}", self.s[k], turn))
        arm = b.at_angle(pivot, ray, delta)
        speed = self._scale_length(f"ψ' {k}", self.v[k], side * self.scales.v / one.arm)
        ahead = b.total(f"1 + ψ' {k}", self.known(f"1 {k}", 1.0), speed)
        reach = b.compute(f"OP {k}", (size["a"], 1), (speed, 1), (ahead, -1))
        pole = b.lay_off_length(f"P_{{{k}}}", axis, ray, reach)
        if is_plate(design):
            return b.intersect_lines(f"B_{{{k}}}", b.perpendicular(pole, arm), arm), pole
        return b.lay_off_length(f"B_{{{k}}}", pivot, arm, size["l"]), pole


def construct(design: CamDesign, scales: CamScales | None = None) -> CamConstruction:
    """Return the construction of a cam."""
    draft = _Draft(design, scales or scales_of(design), nodes_of(design.problem))
    draft.integrate()
    drawn = draft.region()
    draft.profile()
    bounds = design.bounds if drawn and not is_plate(design) else ()
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


SYMBOLS = {"r_min": "r_{min}", "e": "e", "centre_distance": "a"}


class CamReadings(Struct, frozen=True, dict=True):
    """Ruler readings of a construction beside the exact values (снятые величины)."""

    built: CamConstruction
    language: Language
    profile: Profile

    @cached_property
    def ruled(self) -> Trace:
        """The numbers as the ruler gives them."""
        return self.built.ruled(self.profile.ruler)

    @cached_property
    def sigma(self) -> Mapping[str, float]:
        """Drafting errors of the numbers."""
        return self.built.sigma(self.profile)

    def number(self, name: str, *, exact: bool = False) -> float:
        """Return a number of the construction."""
        trace: Any = self.built.exact if exact else self.ruled
        return float(np.ravel(trace.value[NumberName(name)])[0])

    def series(
        self, symbol: Rich, names: Sequence[str], exact: Sequence[float] | Reals, per_mm: float
    ) -> Series:
        """Return numbers of the construction beside the exact ones, mm of the cam.

        ``per_mm``: what a unit of the construction is worth, m.
        """
        read, sigma = (
            [MM * per_mm * value for value in values]
            for values in (map(self.number, names), (self.sigma[name] for name in names))
        )
        return measured_series(symbol, "mm", exact, read, sigma)

    def sizes(self) -> list[Series]:
        """Return the sizes read off the region."""
        design, symbols = self.built.design, dict(SYMBOLS)
        if design.problem.contact is Contact.FLAT:
            symbols["r_min"] = "r_{0}"
        geometry = design.geometry
        exact = {"r_min": geometry.r_min, "e": geometry.e, "centre_distance": geometry.centre}
        return [
            self.series(symbols[name], [of], [MM * exact[name]], 1.0)
            for name, of in self.built.results.items()
        ]

    def path(self) -> Series:
        """Return the follower's motion s in the divisions, read off the diagram."""
        built = self.built
        names = [f"s_{{{node.number}}}" for node in built.nodes]
        exact = [MM * float(motion_in_division(built.design.problem, n)[0]) for n in built.nodes]
        return self.series("s", names, exact, built.scales.s)

    def radii(self) -> Series:
        """Return the radii of the profile in the divisions."""
        names = [f"R_{{{node.number}}}" for node in self.built.nodes]
        per_mm = self.built.scales.profile
        exact = MM * per_mm * np.abs(self.built.exact_points())
        return self.series("R", names, exact, per_mm)

    def table(self) -> Table:
        """Return the sizes read off the region beside the exact ones, mm."""
        numbers = self.language.notation.numbers
        rows = ([one.symbol, *numbers(*one[0].texts)] for one in self.sizes())
        return table_of(self.language.cam["region_heads"], rows)

    def off(self, trace: Trace) -> float:
        """Return the maximum deviation of a reading's profile from the exact one, mm of the cam."""
        places = [
            np.ravel(trace.value[NumberName(f"B_{{{node.number}}}")])[0]
            for node in self.built.nodes
        ]
        most = np.max(np.abs(np.array(places) - self.built.exact_points()))
        return float(most * self.built.scales.profile * MM)

    def deviation(self) -> Rich:
        """Return the text on the deviation of the drawn profile from the exact one."""
        notation = self.language.notation
        return self.language.cam.deviation.format(
            most=notation.number(f"{self.off(self.ruled):.2f}"),
            method=notation.number(f"{self.off(self.built.exact):.2f}"),
            sigma=notation.number(sigma_text(max(self.radii().sigma))),
        )
