"""The profile of a cam with its sizes and phase angles (профиль кулачка), mm of paper.

The cam is held and the frame turned against it: the follower at rest is thick, its inverted
positions are thin. The widest gap between two positions, most often the lower dwell, has the
radius, the names of the profiles and the sense of the inverted motion.
"""

from __future__ import annotations

from cmath import exp, phase
from functools import cached_property
from itertools import pairwise
from math import ceil, degrees, pi, sqrt

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.cams.design import CamDesign, CamNode
from planmethod.cams.model import (
    TURN,
    CamGeometry,
    CamPhase,
    CamPoints,
    CamProblem,
    Closure,
    Contact,
)
from planmethod.cams.pictures import DOT, NUMBER, CamView
from planmethod.cams.text import angle_symbol
from planmethod.render.ink.drawing import Arc, Disc, Fill, Ink, Item, Pen, Stroke
from planmethod.render.ink.pens import pens_in_use
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import BUSY, Label
from planmethod.render.labels.label_column import merge_letters
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.diagram import Mark, mark_items
from planmethod.render.pictures.lettered import lettered
from planmethod.render.symbols import (
    DIMENSION,
    angle_dimension,
    dimension,
    dimension_tag,
    fixed_pivot,
    guide_plates,
    radius_dimension,
    revolute,
    turn_arrow,
    unit,
)

PROFILE = "cam profile"
"""Tag of the actual profile; the theoretical one is ``cam profile theoretical``."""

POINTS = 721
_ROD_LENGTH = 40.0  # mm: of a translating follower beyond its roller
_GUIDE = 9.0  # mm: from the middle of the guide to the end of the rod
_OUT = 4.0  # mm: a line of inverted motion goes on beyond the rollers
_OMEGA = 9.0  # mm: radius of the arrow of ω
_ARC_PART = 0.66  # radius of the arcs of phase angles, of the least radius of the cam
_LEAST_ARC = 21.0  # mm: smaller arcs of phase angles are drawn outside the cam
_NAME = replace(BUSY, rings=(14.0, 18.0, 23.0, 29.0, 36.0))  # a name of a profile has a leader
_KEY = ((5.0, 1.5), (9.0, 1.5), (9.0, -1.5), (5.0, -1.5))  # mm: along and across its line
_SMALL = 0.02  # rad: a smaller phase has no dimension
_WIDE = 0.6  # rad: a gap that has room for the arrow of −ω


def profile_picture(view: CamView) -> Picture:
    """Return the profile with the follower at rest, inverted positions and sizes."""
    return _ProfileView(view).picture()


class _ProfileView(Struct, frozen=True, dict=True):
    """The profile as it is drawn; places are in the frame of a counter-clockwise cam."""

    view: CamView

    @cached_property
    def design(self) -> CamDesign:
        return self.view.built.design

    @property
    def problem(self) -> CamProblem:
        return self.design.problem

    @property
    def geometry(self) -> CamGeometry:
        return self.design.geometry

    @property
    def mm(self) -> float:
        return self.view.built.scales.profile

    @property
    def is_flat(self) -> bool:
        return self.problem.contact is Contact.FLAT

    @property
    def roller(self) -> float:
        """Radius of the roller, mm."""
        return self.geometry.roller / self.mm

    @cached_property
    def half_face(self) -> float:
        """Half of the face of a flat follower, mm: the contact stays on it."""
        nodes = self.view.built.nodes
        reach = (self.view.at(f"B_{{{one.number}}}") - self._profile_point(one) for one in nodes)
        return 3.0 + max(map(abs, reach))

    @cached_property
    def curves(self) -> CamPoints:
        return self.geometry.at(np.linspace(0.0, TURN, POINTS)[:-1])

    @cached_property
    def gap(self) -> tuple[float, float]:
        """Widest gap between two positions: its ends, rad."""
        phi = [node.phi for node in self.view.built.nodes]
        return max(pairwise([*phi, phi[0] + TURN]), key=lambda ends: ends[1] - ends[0])

    def in_gap(self, part: float) -> tuple[complex, complex]:
        """Return the points of both profiles at a part of the widest gap, mm."""
        phi = self.gap[0] + part * (self.gap[1] - self.gap[0])
        at = self.geometry.at(np.array([phi % TURN]))
        return complex(at.theoretical[0]) / self.mm, complex(at.actual[0]) / self.mm

    def leg(self, phi: float, radius: float) -> complex:
        """Return the place on the follower's line, or on its line of centres, at a radius, mm."""
        if self.problem.oscillates:
            out = complex(self.geometry.side) * radius
        else:
            e = 0.0 if self.is_flat else self.geometry.e / self.mm
            out = complex(e, sqrt(max(radius**2 - e**2, 0.0)))
        return out * exp(-1j * phi)

    def turn(self, place: complex) -> float:
        """Return the angle of a place as it is drawn, rad."""
        return phase(self.view.spot(place))

    # Whole ----------------------------------------------------------------------------------------

    def picture(self) -> Picture:
        """Return the whole."""
        view, mm = self.view, self.mm
        labels: list[Label] = []
        items = [*self._circles(), *self._inverted(labels)]
        if self.problem.contact is Contact.ROLLER:
            theoretical = view.on_paper(self.curves.theoretical / mm)
            items.append(Stroke(theoretical, Pen.AXIS, closed=True, tag=f"{PROFILE} theoretical"))
        is_groove = self.problem.closure is Closure.FORM
        for side in (self.curves.actual, self.curves.outer)[: 1 + is_groove]:
            items.append(Stroke(view.on_paper(side / mm), Pen.MAIN, closed=True, tag=PROFILE))
        items += [*self._sizes(labels), *self._follower(labels), *self._senses(labels)]
        if (cut := self.design.undercut) is not None:
            items += mark_items(Mark.CROSS, view.spot(cut.point / mm))
            labels.append(view.label("ρ_{min}", cut.point / mm, cut.point))
        items += fixed_pivot(0j, factor=0.9)
        labels.append(view.label("O_{1}", 0j, -1 - 0.4j))
        if self.problem.phase is not None:
            items += self._key(self.problem.phase, labels)
        self._names(labels)
        named = (
            one if one.name.startswith(DIMENSION) else replace(one, name=f"profile: {one.name}")
            for one in labels
        )  # fmt: skip
        return lettered(items, [*named])

    def _key(self, angle: float, labels: list[Label]) -> list[Item]:
        """Return the key of the shaft: its line, its section, its angle from the vertical."""
        view, way = self.view, 1j * exp(1j * angle)
        most = float(np.max(np.abs(self.curves.actual))) / self.mm + 12.0
        line = Stroke(view.on_paper((0j, most * way)), Pen.AXIS, tag="key")
        corners = (along * way + across * 1j * way for along, across in _KEY)
        section = Fill(view.on_paper(corners), Ink.BLACK, tag="key")
        letter: str = view.language.cam.key_letter
        labels.append(view.label(letter, most * way, way))
        items: list[Item] = [line, section]
        if TURN - _SMALL > angle > _SMALL:
            up, ends = most - 5.0, sorted((pi / 2, pi / 2 + view.mirror * angle))
            items.append(Stroke(view.on_paper((0j, most * 1j)), Pen.THIN, tag="key"))
            items += angle_dimension(0j, up, *ends, tag=f"{DIMENSION} key")
            middle = up * 1j * exp(0.5j * angle)
            text = view.language.notation.as_input(round(degrees(angle), 4)) + "°"
            labels.append(view.label(text, middle, middle, size=NUMBER))
        return items

    def _circles(self) -> list[Item]:
        """Return the base circle, the offset circle, and the circle of the pivot."""
        view, mm, found = self.view, self.mm, list[Item]()
        # In the lower dwells the circle is the profile itself.
        dwells = [one for one in self.problem.motions if one.phase is CamPhase.LOWER]
        size = self.geometry.r_min / mm
        for one, other in pairwise([*dwells, *dwells[:1]]):
            rest = self.geometry.at(np.array([one.end % TURN, other.start]))
            turns = [phase(view.spot(place)) for place in rest.theoretical]
            ends = turns[::-1] if view.mirror > 0 else turns
            found.append(Arc(0j, size, *_rising(*ends), Pen.THIN, "base circle"))
        if not dwells:
            found.append(Arc(0j, size, pen=Pen.THIN, tag="base circle"))
        if abs(self.geometry.e) / mm > 1.0 and not self.is_flat:
            found.append(Arc(0j, abs(self.geometry.e) / mm, pen=Pen.THIN, tag="offset circle"))
        if self.problem.oscillates:
            last = view.built.nodes[-1].phi
            turns = [self.turn(self.leg(phi, 1.0)) for phi in (last, 0.0)]
            ends = turns if view.mirror > 0 else turns[::-1]
            found.append(Arc(0j, self.geometry.centre / mm, *_rising(*ends), Pen.THIN, "centres"))
        return found

    # Inverted motion ------------------------------------------------------------------------------

    def _inverted(self, labels: list[Label]) -> list[Item]:
        """Return the positions of inverted motion: follower's lines, rollers, numbers."""
        view, nodes = self.view, self.view.built.nodes
        items: list[Item] = []
        ends: list[complex] = []
        for node in nodes:
            point, foot = view.at(f"B_{{{node.number}}}"), self._profile_point(node)
            out = (
                point
                if self.problem.oscillates
                else point + self._axis_direction(node) * self._reach
            )
            if self.is_flat and not self.problem.oscillates:
                along = 1j * unit(foot)
                out = foot + unit(foot) * (2.0 * _OUT)
                line = (foot - along * self.half_face, foot + along * self.half_face)
                items.append(Stroke(view.on_paper(line), Pen.THIN, tag="inverted"))
                foot = out - unit(foot) * _OUT
            if node.number or self.problem.oscillates:
                items.append(Stroke(view.on_paper((foot, out)), Pen.THIN, tag="inverted"))
            if self.roller and node.number:
                items.append(Arc(view.spot(point), self.roller, pen=Pen.THIN, tag="roller"))
            items.append(Disc(view.spot(point), DOT, Ink.BLACK, tag="drawn"))
            ends.append(foot if self.problem.oscillates else out)
        spots = merge_letters(
            [(end, [str(node.number)]) for node, end in zip(nodes, ends, strict=True)]
        )
        every = self._every([end for end, _ in spots])
        for end, numbers in spots:
            node = nodes[int(numbers[-1])]
            if node.number % every == 0 or node.starts or node is nodes[-1]:
                way = end if self.problem.oscillates else self._axis_direction(node)
                side = -1 + 0j if not (node.number or self.problem.oscillates) else way
                labels.append(view.label(", ".join(numbers), end, side, size=NUMBER))
        return items

    @property
    def _reach(self) -> float:
        """Length of a follower's line beyond the middle of the roller, mm: out of the rollers."""
        return 1.15 * self.roller + _OUT

    def _profile_point(self, node: CamNode) -> complex:
        """Return where a line of inverted motion begins: the lines of a phase at the axis.

        Others begin at the base circle, for the inside of the cam to stay clear.
        """
        k = node.number
        if self.problem.oscillates:
            return self.view.at(f"C_{{{k}}}")
        is_end = node.starts or node.ends or node is self.view.built.nodes[-1]
        return self.view.at(f"{'K' if is_end or self.is_flat else 'L'}_{{{k}}}")

    def _axis_direction(self, node: CamNode) -> complex:
        return exp(1j * (pi / 2 - node.phi))

    def _every(self, ends: list[complex]) -> int:
        """Return which positions have numbers, for them not to touch."""
        width = typeset(str(len(ends) - 1), NUMBER).width + 1.5
        return max(1, ceil(width / min(abs(a - b) for a, b in pairwise(ends))))

    # Sizes ----------------------------------------------------------------------------------------

    def _sizes(self, labels: list[Label]) -> list[Item]:
        """Return the dimensions: r_min, phase angles, the offset."""
        view, mm = self.view, self.mm
        items = self._phases(labels)
        size, symbol = self.geometry.r_min / mm, "r_{0}" if self.is_flat else "r_{min}"
        way = view.spot(unit(self.in_gap(0.22)[0]))
        items += radius_dimension(0j, size, way, tag=dimension_tag(symbol))
        labels.append(_dimension_label(symbol, (0.3 * size * way, size * way), view.letter))
        e = self.geometry.e / mm
        if abs(e) > 1.0 and not self.problem.oscillates:
            level = self._level + 5.0
            ends = (1j * (level - 2.0), view.spot(complex(e, level - 2.0)))
            items += dimension(*ends, 2j, tag=dimension_tag("e"))
            items.append(Stroke((0j, 1j * (level - 2.0)), Pen.THIN, tag="line"))
            labels.append(_dimension_label("e", (ends[0] + 2j, ends[1] + 2j), view.letter))
        return items

    @property
    def _level(self) -> float:
        """Height of the top of the follower's roller, or of its face, mm."""
        return float(self.curves.roller[0].imag) / self.mm + self.roller

    def _phases(self, labels: list[Label]) -> list[Item]:
        """Return the arcs of the phase angles, with the lines that bound them."""
        view, problem, items = self.view, self.problem, list[Item]()
        least = float(np.min(np.abs(self.curves.actual))) / self.mm
        inner = 0.0 if self.is_flat else abs(self.geometry.e) / self.mm
        radius = max(_ARC_PART * least, inner + 2.5 * NUMBER)
        is_inside = _LEAST_ARC <= radius <= 0.9 * least
        if not is_inside:
            far = max(abs(view.at(f"B_{{{node.number}}}")) for node in view.built.nodes)
            radius = far + self._reach + 2 * NUMBER + _OUT
        for part in problem.motions:
            start = part.start
            legs = [self.leg(phi, radius) for phi in (start, part.end)]
            if problem.oscillates or self.is_flat:
                end = self.geometry.centre / self.mm if problem.oscillates else radius + 2.0
                line = (0j, self.leg(start, max(end, radius + 2.0)))
            elif part.phase is CamPhase.LOWER or not is_inside:
                line = (self.leg(start, inner), self.leg(start, radius + 2.0))
            else:
                line = (0j, 0j)
            if line[1]:
                items.append(Stroke(view.on_paper(line), Pen.THIN, tag="phase"))
            high, low = (self.turn(leg) for leg in legs)
            low, high = _rising(*((low, high) if view.mirror > 0 else (high, low)))
            symbol = angle_symbol(problem, part, view.language)
            items += angle_dimension(0j, radius, low, high, tag=dimension_tag(symbol))
            middle = exp(0.5j * (low + high))
            at = radius * middle
            labels.append(
                Label(typeset(symbol, view.letter), at, prefer=middle, gap=1.4, priority=1,
                      name=dimension_tag(symbol), style=BUSY)
            )  # fmt: skip
        return items

    # Follower -------------------------------------------------------------------------------------

    def _follower(self, labels: list[Label]) -> list[Item]:
        """Return the follower at rest, thick, its roller under its rod."""
        view, mm, geometry = self.view, self.mm, self.geometry
        point = view.spot(complex(self.curves.roller[0]) / mm)
        items: list[Item] = []
        if self.roller:
            items += [Disc(point, self.roller), Arc(point, self.roller, tag="roller")]
        if self.problem.oscillates:
            pivot = view.spot(geometry.pivot / mm)
            end = point
            if self.is_flat:
                end = pivot + unit(point - pivot) * self.problem.arm / mm
            items.append(Stroke((pivot, end), Pen.MAIN, tag="follower"))
            items += fixed_pivot(pivot, factor=0.9)
            labels.append(view.label("O_{2}", geometry.pivot / mm, 1 + 1j))
        else:
            foot = point
            if self.is_flat:
                foot = complex(view.mirror * geometry.e / mm, point.imag)
                ends = (foot - self.half_face, foot + self.half_face)
                items.append(Stroke(ends, Pen.MAIN, tag="follower"))
            top = foot + 1j * (self.roller + _ROD_LENGTH + self.problem.stroke / mm)
            items.append(Stroke((foot, top), Pen.MAIN, tag="follower"))
            items += guide_plates(top - 1j * _GUIDE, angle=90.0, width=4.0)
            if not self.is_flat:
                items.append(Stroke((complex(foot.real), foot), Pen.AXIS, tag="line"))
        if self.roller:
            items += revolute(point, factor=0.7)
            way = exp(1j * (pi - 0.6)) if view.mirror > 0 else exp(0.6j)
            items += radius_dimension(point, self.roller, way, tag=dimension_tag("r_{p}"))
            ends = (point + 2.0 * way, point + self.roller * way)
            labels.append(_dimension_label("r_{p}", ends, view.letter))
        if not self.is_flat:
            name = view.label("B", complex(self.curves.roller[0]) / mm, 1 + 0.5j)
            if self.roller < 2 * view.letter:
                labels.append(name)
            else:  # on the white of the roller, beside its rod
                drop = 1.6j if self.problem.oscillates else -1j * (view.letter + 2.0)
                left = 2.0 if view.mirror > 0 else -2.0 - name.inscription.width
                items += name.inscription.at(point + left + drop, label="profile: B")
        return items

    # Senses and names -----------------------------------------------------------------------------

    def _senses(self, labels: list[Label]) -> list[Item]:
        """Return the arrows of ω and, of the inverted motion, of −ω."""
        view, geometry = self.view, self.geometry
        middle = self.gap[0] + 0.6 * (self.gap[1] - self.gap[0])
        is_wide = self.gap[1] - self.gap[0] > _WIDE
        way = self.leg(middle, geometry.r_min / self.mm)
        radius = geometry.centre / self.mm if self.problem.oscillates else abs(way) + 8.0
        if not is_wide:
            radius = _OMEGA + 2.0 * pens_in_use().mark
        found: list[Item] = []
        for sign, size, sense in (("ω", _OMEGA, view.mirror), ("−ω", radius, -view.mirror)):
            turn = self.turn(way)
            if size == _OMEGA:
                turn = abs(turn)  # above the support
            sweep = min(110.0, degrees(26.0 / size))
            found += turn_arrow(0j, size, sense, middle=degrees(turn), sweep=sweep)
            at = size * exp(1j * turn)
            labels.append(Label(typeset(sign, view.letter), at, prefer=at, gap=1.4, name=sign,
                                priority=1, style=BUSY))  # fmt: skip
        return found

    def _names(self, labels: list[Label]) -> None:
        """Add the names of the profiles on leaders."""
        names = self.view.language.cam["profiles"]
        told = [("actual", 1, 0.78)]
        if self.problem.contact is Contact.ROLLER:
            told.append(("theoretical", 0, 0.45))
        for name, k, part in told:
            at = self.view.spot(self.in_gap(part)[k])
            text: str = names[name]
            labels.append(Label(typeset(text, NUMBER), at, prefer=at, gap=0.5, name=text,
                                style=_NAME))  # fmt: skip


def _rising(low: float, high: float) -> tuple[float, float]:
    """Return the ends of an arc from ``low`` counter-clockwise to ``high``, rad."""
    return low, low + (high - low) % TURN


def _dimension_label(symbol: str, ends: tuple[complex, complex], height: float) -> Label:
    """Return the letter of a dimension, beside its line."""
    return Label(typeset(symbol, height), sum(ends) / 2, ends, 1j, gap=0.8, priority=2,
                 name=dimension_tag(symbol), style=BUSY)  # fmt: skip
