"""Laws of load as steps: what acts on the links, laid off on the force plans (законы нагрузок).

What follows from other plans is found by steps: it is read by hand, has an error, is compiled and
narrated as everything that is drawn. A load has the letters of the numbers it is computed from;
the narrator writes its formula from them and from its steps.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import assert_never

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import NumberName, PointName
from planmethod.plans.forces.board import Force, ForceBoard, GivenLoad, symbol_letters
from planmethod.plans.forces.polygons import Applied, LoadKind, Shift, free_letter, numbers_of
from planmethod.plans.model import Ends


def lay_off_loads(
    board: ForceBoard, applied: Iterable[Applied], single: Mapping[str, Applied]
) -> None:
    """Lay off the loads on the links other than the reactions.

    Parameters
    ----------
    single : mapping of str to Applied
        The couples of inertia, by link, that the shifted force includes.
    """
    for one in applied:
        if one is single.get(one.link):
            continue
        steps = _LoadSteps(board, one)
        if one.point is None:
            couple = steps.couple()
            board.couples.setdefault(one.link, []).append(couple)
            board.symbols[couple] = one.name
            board.given.append(GivenLoad(one, None, couple, steps.letters))
            continue
        ends = steps.lay_off_force()
        at = PointName(board.kinematics.velocity.named[one.point][1])
        if one.kind is LoadKind.INERTIA and one.link in single:
            at = _shifted(board, one, single[one.link], ends)
        force = Force(at, *ends, one.name)
        board.forces.setdefault(one.link, []).append(force)
        board.given.append(GivenLoad(one, force, None, steps.letters))


# no messages: mistakes in a program
class _LoadSteps:
    """Steps of one load, and the letters of the numbers it is computed from."""

    def __init__(self, board: ForceBoard, one: Applied) -> None:
        self.board, self.one = board, one
        self.letters: dict[NumberName, str] = {}

    def lay_off_force(self) -> Ends:
        """Lay off a force and return its segment."""
        match self.one.kind:
            case LoadKind.INERTIA:
                return self._inertia()
            case LoadKind.WEIGHT:
                turned, _ = numbers_of(self.one)
                return self._force_along(self.board.known("angle", turned), self._weight())
            case LoadKind.EXTERNAL | LoadKind.FRICTION:
                turned, size = numbers_of(self.one)
                angle, newtons = self.board.known("angle", turned), self.board.known("F", size)
                self._note_changing(angle, newtons)
                return self._force_along(angle, newtons)
            case LoadKind.INERTIA_COUPLE:
                raise AssertionError("a couple, not a force")
            case _:
                assert_never(self.one.kind)

    def couple(self) -> NumberName:
        """Compute a couple, N·m."""
        turning = self.board.kinematics.epsilon.get(self.one.link)
        if self.one.kind is LoadKind.INERTIA_COUPLE and turning is not None:
            return self._inertia_couple(turning)
        (size,) = numbers_of(self.one)
        couple = self.board.known("M", size)
        self._note_changing(couple)
        return couple

    def _note_changing(self, *numbers: NumberName) -> None:
        if self.one.steady is None:
            self.board.changing.append((self.one.name, numbers))

    def _force_along(self, angle: NumberName, size: NumberName) -> Ends:
        """Lay off a force of a known direction."""
        board = self.board
        line = board.draft.b.at_angle(board.pole, None, angle)
        return board.pole, board.segments.lay_off_vector(board.name("F"), board.pole, line, size)

    def _datum(self, letter: str, hint: str, value: Number) -> NumberName:
        """Take a number of the data as known."""
        name = self.board.datum(letter, hint, value)
        self.letters[name] = letter
        return name

    # Weight and inertia ----------------------------------------------------------------------

    def _mass(self) -> NumberName:
        link, dynamics = self.one.link, self.board.dynamics
        assert dynamics is not None
        return self._datum(f"m_{{{link}}}", "m", dynamics.masses[link].mass)

    def _weight(self) -> NumberName:
        """Compute a weight: G = m·g."""
        assert self.board.dynamics is not None
        powers = (self._mass(), 1), (self._datum("g", "g", self.board.dynamics.gravity), 1)
        return self.board.segments.compute(symbol_letters(self.one.name), *powers)

    def _inertia(self) -> Ends:
        """Compute Φ = m·a and lay it off against the acceleration of the centre of mass."""
        board, point, mass = self.board, self.one.point, self._mass()
        motion, accelerations, b = (
            board.kinematics.acceleration,
            board.accelerations,
            board.draft.b,
        )
        assert point is not None
        ends = (motion.pole, motion.point[board.kinematics.velocity.named[point]])
        acceleration = accelerations.value(*ends, f"a_{point}")
        self.letters[acceleration] = f"a_{{{point}}}"
        product = ((mass, 1), (acceleration, 1))
        size = board.segments.compute(symbol_letters(self.one.name), *product, size=True)
        drawn = b.compute(board.name("l"), (size, 1), (board.scale, -1))
        head = b.carry(board.name("F"), board.pole, *ends[::-1], drawn)
        board.segments.values[board.pole, head] = size
        board.segments.lengths[board.pole, head] = drawn
        return board.pole, head

    def _inertia_couple(self, turning: NumberName) -> NumberName:
        """Compute the main moment of the inertia forces: M_Φ = -J·ε."""
        link, dynamics = self.one.link, self.board.dynamics
        assert dynamics is not None
        inertia = self._datum(f"J_{{S{link}}}", "J", dynamics.masses[link].inertia)
        self.letters[turning] = f"ε_{{{link}}}"
        powers = ((inertia, 1), (turning, 1))
        return self.board.draft.b.compute(self.board.name("M"), *powers, factor=-1.0)


def _shifted(board: ForceBoard, force: Applied, couple: Applied, ends: Ends) -> PointName:
    """Lay h = M_Φ/Φ off from the centre of mass, across its acceleration, and note the end."""
    motion, b, steps = board.kinematics.acceleration, board.draft.b, _LoadSteps(board, couple)
    assert force.point is not None
    at = board.kinematics.velocity.named[force.point]
    centre, moment = PointName(at[1]), steps.couple()
    over = ((board.segments.values[ends], -1), (board.draft.mu_l, -1))
    length = b.compute(board.name("h"), (moment, 1), *over)
    # Φ is against the acceleration: to the left of that it turns as a positive M_Φ does.
    across = b.perpendicular(centre, b.join(motion.pole, motion.point[at]))
    end = b.lay_off_length(board.name("T"), centre, across, length)
    letter = free_letter("T", couple.link, board.draft.problem)
    board.shifts[couple.link] = Shift(letter, couple, moment, centre, end, length, steps.letters)
    return end
