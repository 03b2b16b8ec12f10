"""Force equations of the groups as projections on the axes, and moments (проекции сил на оси)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import degrees

import numpy as np

from planmethod.construct.steps import PointName
from planmethod.note.accounts.analytic import AnalyticAccount
from planmethod.note.accounts.voice import Voice
from planmethod.note.document import Node
from planmethod.note.formula import Rich
from planmethod.note.narrate.contours import AXES, LinearSystem
from planmethod.note.narrate.forces.statement import plan_title
from planmethod.note.spelled import (
    ZERO,
    Spelled,
    angle_of,
    cosine,
    degree,
    named,
    over,
    root,
    sine,
    squared,
    times,
    total,
)
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import (
    Balance,
    Component,
    CoupleOn,
    Edge,
    ForcePlan,
    LoadKind,
    Moments,
    reaction_symbol,
)
from planmethod.plans.model import KnownParts, PlanKind, Relation
from planmethod.plans.motion.legs import slot_name
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.solution import Solution

Pair = tuple[Spelled, Spelled]

_RIGHT = {0: (1, 0), 90: (0, 1), 180: (-1, 0), 270: (0, -1)}


def analytic_chapter(
    solution: Solution, index: int, language: Language, voice: Voice
) -> Iterator[Node]:
    """Yield the chapter of the analytic method, with forces if the problem has any."""
    account = AnalyticAccount(solution, index, language, voice)
    yield from account.chapter(lambda: force_nodes(account))


def force_nodes(account: AnalyticAccount) -> Iterator[Node]:
    """Yield the equations of the forces, if the problem has any that they can give."""
    problem = account.problem
    solved = all(link in account.directions for link in problem.mechanism.links)
    # Force plans alone give the radial force on teeth.
    if solved and problem.dynamics is not None and not problem.meshes:
        yield from ForceProjections(account).nodes()


class ForceProjections:
    """Sums of projections and of moments of every group, from the last one to the driver.

    The values are those of the formulas; the force plans give only which forces are unknown.

    Parameters
    ----------
    account : AnalyticAccount
        With the positions, velocities and accelerations of all points.
    """

    def __init__(self, account: AnalyticAccount) -> None:
        self.account, self.notation = account, account.notation
        self.texts, self.voice = account.texts, account.voice
        self.reading = force_reading(account.solution, account.index)
        self.loads = {one.applied.name: one.applied for one in self.reading.statics.board.given}
        self.opposites = dict(self._opposite_letters())
        self.forces: dict[str, Pair] = {}
        self.sizes: dict[str, Spelled] = {}
        self.couples: dict[str, Spelled] = {}
        self.lines: dict[str, Pair] = {}

    def nodes(self) -> Iterator[Node]:
        """Yield the equations of every force plan."""
        for plan in self.reading.plans:
            title = plan_title(self.reading, plan, self.account.language)
            yield from self.voice.part(self.texts.forces.format(links=title))
            yield from self._plan(plan)

    def _plan(self, plan: ForcePlan) -> Iterator[Node]:
        found = {self._letters(one.force) for one in plan.moments if one.force is not None}
        for edge in plan.polygon:
            is_whole = edge.known is KnownParts.BOTH and edge.component is Component.TOTAL
            if is_whole and self._letters(edge) not in found:
                self._known_force(edge)
        yield from self._state(self.texts.known_forces.format())
        for one in plan.moments:
            if one.force is not None:
                yield from self._moments(one, self._line(one.force, plan))
        for balance in plan.balances:
            yield from self._balance(balance, plan)
            for whole in plan.wholes:
                self._add_components(whole, plan)
            yield from self._state(self.texts.wholes.format())
        for one in plan.moments:
            if one.couple is not None:
                yield from self._moments(one, None)

    def _state(self, text: Rich) -> Iterator[Node]:
        lines, self.account.lines = self.account.lines, []
        if lines:
            yield from self.voice.statement(text, lines)

    # Forces ------------------------------------------------------------------------------------

    def _letters(self, edge: Edge) -> Rich:
        balancer = self.reading.solution.problem.balancer.symbol
        return self.notation.symbol(edge.symbol or balancer)

    def _component(self, symbol: Rich, axis: str) -> Rich:
        """Return the letter of a projection: ``F_{21x}`` of ``F_{21}``."""
        head, brace, tail = symbol.rpartition("_{")
        return f"{head}_{{{tail.removesuffix('}')}{axis}}}" if brace else f"{symbol}_{{{axis}}}"

    def _known_force(self, edge: Edge) -> None:
        """Note the projections of a force that is known before the plan."""
        symbol, force = self._letters(edge), self.reading.force(edge)
        if symbol in self.forces or self.reading.is_negligible(edge):
            self.forces.setdefault(symbol, (ZERO, ZERO))
            return
        load = self.loads.get(edge.symbol)
        if load is not None:
            self.forces[symbol] = self._load(symbol, force, load.kind, edge.on)
            return
        opposite = self.opposites.get(symbol)
        if opposite in self.forces:
            x, y = self.forces[opposite]
            found = self.account
            self.forces[symbol] = (
                found.define(self._component(symbol, "x"), -x, "N"),
                found.define(self._component(symbol, "y"), -y, "N"),
            )
            return
        self.forces[symbol] = self._constants(symbol, force)

    def _opposite_letters(self) -> Iterator[tuple[Rich, Rich]]:
        """Yield the letter of each reaction with that of the opposite one, both ways round."""
        called = self.reading.solution.problem.mechanism.called
        for one in self.reading.statics.reactions:
            pair = called(one.on), called(one.by)
            letters = [self.notation.symbol(reaction_symbol(*way)) for way in (pair, pair[::-1])]
            yield letters[0], letters[1]
            yield letters[1], letters[0]

    def _constants(self, symbol: Rich, force: complex) -> Pair:
        x, y = (
            self.account.constant(self._component(symbol, axis), value, "N")
            for axis, value in zip(AXES, (force.real, force.imag), strict=True)
        )
        return x, y

    def _load(self, symbol: Rich, force: complex, kind: LoadKind, link: str) -> Pair:
        account, dynamics = self.account, self.reading.solution.problem.dynamics
        assert dynamics is not None
        mass = dynamics.masses.get(link)
        if kind is LoadKind.WEIGHT and mass is not None:
            m = account.constant(f"m_{{{link}}}", mass.mass, "kg")
            g = account.constant("g", dynamics.gravity, "m/s²")
            return ZERO, -account.define(symbol, times(m, g), "N")
        turn = round(degrees(np.angle(force)), 6) % 360.0
        right = _RIGHT.get(int(turn)) if turn == int(turn) else None
        if right is not None and kind is not LoadKind.INERTIA:
            size = account.constant(symbol, abs(force), "N")
            x, y = (size if part > 0 else -size if part else ZERO for part in right)
            return x, y
        if kind is not LoadKind.INERTIA or mass is None or mass.centre not in account.places:
            return self._constants(symbol, force)
        m = account.constant(f"m_{{{link}}}", mass.mass, "kg")
        parts = []
        for axis in AXES:
            a = f"a_{{{account.places[mass.centre].name}{axis}}}"
            value = account.values.get(a, 0.0)
            term = times(m, named(a, value, self.notation)) if value else ZERO
            parts.append(account.define(self._component(symbol, axis), -term, "N"))
        return parts[0], parts[1]

    def _line(self, edge: Edge, plan: ForcePlan) -> Pair:
        """Return the projections of a unit vector along the line of an unknown force."""
        symbol = self._letters(edge)
        if symbol not in self.lines:
            self.lines[symbol] = self._direction(edge, plan)
        return self.lines[symbol]

    def _direction(self, edge: Edge, plan: ForcePlan) -> Pair:
        direction = edge.direction
        across = direction is not None and direction.relation is Relation.PERPENDICULAR
        if direction is None:  # a tangential component is across the line of the normal one
            own = [one for one in plan.polygon if (one.on, one.at) == (edge.on, edge.at)]
            direction = next((one.direction for one in own if one.direction is not None), None)
            across = True
        places, symbol = self.account.places, self._letters(edge)
        alpha = f"α_{{{re.sub(r'[_^{},]', '', symbol)}}}"
        ends = () if direction is None else direction.points
        if len(ends) == 2 and all(end in places for end in ends) and direction is not None:
            one, two = (places[end] for end in ends)
            x, y = (total(two.at[k], -one.at[k]) for k in (0, 1))
            quarter = (90.0 if across else 0.0) + direction.angle
            angle = total(angle_of(x, y, self.notation), degree(quarter, self.notation))
            found = self.account.define(alpha, angle, "°")
            return cosine(found), sine(found)
        along = None if direction is None else self._guide(direction.guide)
        if along is not None:
            c, s = along
            return (-s, c) if across else (c, s)
        force = self.reading.force(edge)  # a direction that no letters name
        value = round(degrees(np.angle(force)) % 180.0, 9) if force else 0.0
        found = self.account.given_angle(alpha, value)
        return cosine(found), sine(found)

    def _guide(self, name: Rich) -> Pair | None:
        """Return the projections of a unit vector along the line of a slider."""
        account, problem = self.account, self.reading.solution.problem
        for slide in problem.slides.values():
            if name in (problem.guide_name(slide.label), slot_name(slide)):
                return account.slide_direction(slide).projections(self.notation)
        return None

    def _projections(self, edge: Edge, plan: ForcePlan) -> Pair:
        """Return the projections of a force that is known by now."""
        symbol = self._letters(edge)
        if symbol in self.forces:
            return self.forces[symbol]
        if edge.component is Component.TOTAL and symbol not in self.sizes:
            self._known_force(edge)
            return self.forces[symbol]
        size = self.sizes[symbol]
        x, y = (times(size, part) for part in self._line(edge, plan))
        return x, y

    # Equations ---------------------------------------------------------------------------------

    def _at(self, point: PointName) -> Pair:
        """Return the coordinates of a place of the drawing, m."""
        account = self.account
        if str(point) in account.places:
            return account.places[str(point)].at
        solution = self.reading.solution
        metre = solution.scales[PlanKind.POSITION].per_mm
        origin = solution.construction.draft.origin
        place = self.reading.place(point) * metre + complex(origin)
        name = account.mark(str(point))
        x, y = (
            account.constant(f"{axis}_{{{name}}}", value, "m")
            for axis, value in zip(AXES, (place.real, place.imag), strict=True)
        )
        return x, y

    def _turning(self, at: PointName, about: PointName, force: Pair) -> Spelled:
        """Return the moment of a force about a point: ``(x − x_O)·F_y − (y − y_O)·F_x``."""
        if at == about:
            return ZERO
        (x, y), (p, q) = self._at(at), self._at(about)
        return total(times(total(x, -p), force[1]), -times(total(y, -q), force[0]))

    def _couple(self, couple: CoupleOn) -> Spelled:
        symbol = self.notation.symbol(couple.symbol)
        if symbol not in self.couples:
            self.couples[symbol] = self._inertia_couple(symbol, couple) or self.account.constant(
                symbol, self.reading.number(couple.moment), "N·m"
            )
        return self.couples[symbol]

    def _inertia_couple(self, symbol: Rich, couple: CoupleOn) -> Spelled | None:
        """Return the couple of inertia forces by its formula; None of another couple."""
        account, dynamics = self.account, self.reading.solution.problem.dynamics
        load, epsilon = self.loads.get(couple.symbol), f"ε_{{{couple.on}}}"
        if load is None or load.kind is not LoadKind.INERTIA_COUPLE:
            return None
        assert dynamics is not None
        if epsilon not in account.values:
            return None
        inertia = account.constant(f"J_{{S{couple.on}}}", dynamics.masses[couple.on].inertia,
                                   "kg·m²")  # fmt: skip
        turning = named(epsilon, account.values[epsilon], self.notation)
        return account.define(symbol, -times(inertia, turning), "N·m")

    def _moments(self, one: Moments, line: Pair | None) -> Iterator[Node]:
        """Yield an equation of moments and the force or the couple that it gives."""
        account, reading = self.account, self.reading
        known = [
            self._turning(edge.at, one.about, self.forces[self._letters(edge)])
            for edge in one.edges
            if self._letters(edge) in self.forces and not reading.is_negligible(edge)
        ]
        known += [
            self._couple(couple) for couple in one.couples if not reading.is_no_couple(couple)
        ]
        moments = total(*known)
        if one.force is not None and line is not None:
            symbol = self._letters(one.force)
            lever = self._turning(one.force.at, one.about, line)
            unknown = named(symbol, 0.0, self.notation)
            whole = total(moments, times(unknown, lever))
            value = over(-moments, lever)
            unit = "N"
        else:
            assert one.couple is not None
            symbol = self.notation.symbol(one.couple.symbol)
            whole = total(moments, named(symbol, 0.0, self.notation))
            value, unit = -moments, "N·m"
        about = account.mark(str(one.about))
        account.lines.append(f"ΣM_{{{about}}} = {whole.sides()[0]} = 0")
        found = account.define(symbol, value, unit)
        if one.force is not None:
            self.sizes[symbol] = found
        else:
            self.couples[symbol] = found
        form = self.texts["moments"]["one" if len(one.links) == 1 else "many"]
        yield from self._state(form.format(links=", ".join(one.links), point=about))

    def _balance(self, balance: Balance, plan: ForcePlan) -> Iterator[Node]:
        """Yield both sums of projections, and the forces that they give."""
        account, known = self.account, list[Pair]()
        unknown = [edge for edge in balance.edges if edge.known is not KnownParts.BOTH]
        for edge in balance.edges:
            if edge.known is KnownParts.BOTH:
                known.append(self._projections(edge, plan))
        sums = [total(*(pair[k] for pair in known)) for k in (0, 1)]
        letters = [self._letters(edge) for edge in unknown]
        lines = [] if len(unknown) == 1 else [self._line(edge, plan) for edge in unknown]
        defined, account.lines = account.lines, []
        for k, axis in enumerate(AXES):
            terms = [
                times(named(letter, 0.0, self.notation), line[k])
                for letter, line in zip(letters, lines, strict=False)
            ] or [named(self._component(letters[0], axis), 0.0, self.notation)]
            whole = total(*terms, sums[k]).sides()[0]
            account.lines.append(f"Σ{axis.upper()} = {whole} = 0")
        account.lines += defined
        if lines:
            rows = [(lines[0][k], lines[1][k]) for k in (0, 1)]
            system = LinearSystem(rows, self.notation, account.define)
            values = system.solve([-one for one in sums], "b", account.define)
            for letter, line, value in zip(letters, lines, values, strict=True):
                size = account.define(letter, value, "N")
                self.sizes[letter] = size
                self.forces[letter] = (times(size, line[0]), times(size, line[1]))
        else:
            self._resultant(letters[0], (-sums[0], -sums[1]))
        form = self.texts["sums"]["one" if len(balance.links) == 1 else "many"]
        yield from self._state(form.format(links=", ".join(balance.links)))

    def _resultant(self, symbol: Rich, parts: Pair) -> None:
        """Write the projections of a force, and its size."""
        x, y = (
            self.account.define(self._component(symbol, axis), part, "N")
            for axis, part in zip(AXES, parts, strict=True)
        )
        self.forces[symbol] = (x, y)
        if not (x.is_zero or y.is_zero):
            self.account.define(symbol, root(total(squared(x), squared(y))), "N")

    def _add_components(self, reaction: Edge, plan: ForcePlan) -> None:
        """Write a reaction that has been found in two components, once both are known."""
        parts = [
            edge
            for edge in plan.polygon
            if (edge.on, edge.at) == (reaction.on, reaction.at)
            and edge.component is not Component.TOTAL
        ]
        symbol = self._letters(reaction)
        if symbol in self.forces or not all(self._letters(one) in self.sizes for one in parts):
            return
        pairs = [self._projections(one, plan) for one in parts]
        x, y = (total(*(pair[k] for pair in pairs)) for k in (0, 1))
        self._resultant(symbol, (x, y))
