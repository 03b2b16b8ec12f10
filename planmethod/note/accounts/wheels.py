"""Wheels and racks in the analytic method: their angles and ways are linear in others (колёса)."""

# no messages: formulas

from __future__ import annotations

from collections.abc import Iterator
from typing import Protocol

from planmethod.construct.steps import NumberName
from planmethod.mechanism.groups import AssurGroup
from planmethod.mechanism.model import FRAME
from planmethod.note.document import Node
from planmethod.note.formula import Rich
from planmethod.note.narrate.contours import Arm, Direction, Place, Side, Turn
from planmethod.note.numbers import Notation
from planmethod.note.spelled import ONE, ZERO, Spelled, degree, named, times, total
from planmethod.note.wording import MessageTable
from planmethod.plans.motion.meshes import mesh_of
from planmethod.problem.mesh_records import GearMesh
from planmethod.problem.model import Problem, Slide
from planmethod.solved.solution import Solution


class Account(Protocol):
    """Account of the analytic method, whose letters and directions wheels use."""

    solution: Solution
    index: int
    problem: Problem
    notation: Notation
    texts: MessageTable
    values: dict[Rich, float]
    directions: dict[str, Direction]
    coordinate: Rich
    of_length: tuple[str, str]
    of_angle: tuple[str, str]

    def constant(self, symbol: Rich, value: float, unit: str) -> Spelled:
        """Return a given number with its letter."""

    def define(self, symbol: Rich, value: Spelled, unit: str = "") -> Spelled:
        """Write the formula of a new letter."""

    def unknown_turn(self, link: str) -> Turn:
        """Return the angle of a link that is to be found."""

    def turn_is(self, link: str, angle: Spelled, of: Direction) -> None:
        """Write the angle of a link."""

    def track(self, slide: Slide, known: str, point: str) -> tuple[Place, Arm, Arm]:
        """Return the line that a point follows."""

    def locate(self, name: str, side: Side) -> None:
        """Write the coordinates of a point."""

    def differentiate(self, name: str, side: Side) -> None:
        """Write the derivatives of the coordinates of a point."""

    def turns_with(self, slide: Slide, known: str) -> None:
        """Note the direction of the other link of a pair."""

    def state(self, text: Rich) -> Iterator[Node]:
        """Yield the formulas so far."""


class WheelAccount:
    """The formulas of a wheel, a rack or a passive crank in an account of the analytic method."""

    def __init__(self, account: Account) -> None:
        self.account, self.problem, self.notation = account, account.problem, account.notation

    def nodes(self, group: AssurGroup) -> Iterator[Node]:
        """Yield what a mesh gives: the angle of a wheel, or the place of a rack."""
        (link,) = group.links
        if group.is_passive:
            like = next(one.like for one in self.problem.mechanism.passive if one.link == link)
            yield from self._wheel(link, [(ONE, like)], ZERO)
            return
        mesh = mesh_of(self.problem, group)
        if mesh.is_rack and link == mesh.mesh.links[1]:
            yield from self._rack(mesh, link)
            return
        parts: list[tuple[Spelled, str]] = [(ONE, mesh.mesh.carrier)]
        if not mesh.is_rack:
            u = self.account.constant(f"u_{{{mesh.pole}}}", mesh.ratio(link), "")
            parts = [(u, mesh.counterpart(link)), (total(ONE, -u), mesh.mesh.carrier)]
        yield from self._wheel(link, parts, None, mesh)

    def _angle_from_start(
        self, link: str, mesh: GearMesh | None
    ) -> tuple[Spelled, tuple[Spelled, Spelled]]:
        """Return the angle of a link from the assembled position, and its derivatives."""
        direction = self.account.directions[link]
        turn = direction.turn
        rates = (ZERO, ZERO) if turn is None else turn.rates
        angle = direction.value(self.notation)
        if mesh is None or turn is None:
            return angle, rates
        start = self.account.constant(f"φ_{{0,{link}}}", mesh.angle(link), "deg")
        exact = NumberName(f"turn_{mesh.pole}_{link}")
        value = float(self.account.solution.paper.number(exact)[self.account.index])
        whole = 360.0 * round((value - (angle.value - start.value)) / 360.0)
        return total(angle, -start, degree(whole, self.notation)), rates

    def _wheel(
        self,
        link: str,
        parts: list[tuple[Spelled, str]],
        start: Spelled | None,
        mesh: GearMesh | None = None,
    ) -> Iterator[Node]:
        account = self.account
        turn = account.unknown_turn(link)
        angles: list[Spelled] = []
        rates: tuple[list[Spelled], list[Spelled]] = ([], [])
        if start is None and mesh is not None:
            start = account.constant(f"φ_{{0,{link}}}", mesh.angle(link), "deg")
        angles.append(start or ZERO)
        for share, of in parts:
            if of == FRAME or account.directions[of].turn is None:
                continue
            by, found = self._angle_from_start(of, mesh)
            angles.append(times(share, by))
            for order in (0, 1):
                rates[order].append(times(share, found[order]))
        if mesh is not None and mesh.is_rack:
            way, found = self._displacement(mesh)
            per = account.constant(
                f"k_{{{mesh.pole}}}", mesh.rack_sign * mesh.degrees_per_metre, ""
            )
            angles.append(times(per, way))
            back = account.constant(f"d_{{{mesh.pole}}}", -mesh.rack_sign / mesh.offset, "")
            for order in (0, 1):
                rates[order].append(times(back, found[order]))
        account.turn_is(link, total(*angles), Direction(None))
        first, second = (
            account.define(symbol, total(*own), unit)
            for symbol, own, unit in zip(turn.symbols, rates, account.of_angle, strict=True)
        )
        turn.rates = (first, second)
        yield from account.state(account.texts.wheel.format(link=link))

    def _displacement(self, mesh: GearMesh) -> tuple[Spelled, tuple[Spelled, Spelled]]:
        """Return the way of the slider of a rack from the assembled position."""
        slider, values = mesh.slider, self.account.values
        symbol: Rich = f"s_{{{slider}}}"
        if self.problem.drive.link == slider:
            symbol, rates = self.account.coordinate, (ONE, ZERO)
        else:
            names = f"s′_{{{slider}}}", f"s″_{{{slider}}}"
            one, two = (named(name, values.get(name, 0.0), self.notation) for name in names)
            rates = one, two
        s = named(symbol, values[symbol], self.notation)
        start = self.account.constant(f"s_{{0,{slider}}}", mesh.place, "m")
        return total(s, -start), rates

    def _rack(self, mesh: GearMesh, link: str) -> Iterator[Node]:
        account, slide = self.account, self.problem.slides[mesh.slider]
        by, rates = self._angle_from_start(mesh.mesh.links[0], mesh)
        origin, offset, along = account.track(slide, FRAME, slide.pin)
        per = account.constant(f"k_{{{mesh.pole}}}", 1.0 / mesh.degrees_per_metre, "")
        start = account.constant(f"s_{{0,{link}}}", mesh.place, "m")
        back = account.constant(f"d_{{{mesh.pole}}}", -mesh.offset, "m")
        along.length = account.define(f"s_{{{link}}}", total(start, times(per, by)), "m")
        first, second = (
            account.define(symbol, times(back, rate), unit)
            for symbol, rate, unit in zip(along.symbols, rates, account.of_length, strict=True)
        )
        along.rates = (first, second)
        side = Side(origin, (offset, along))
        account.locate(slide.pin, side)
        account.turns_with(slide, FRAME)
        account.differentiate(slide.pin, side)
        yield from account.state(account.texts.rack.format(link=link))
