"""Questions of a problem, found in the program of its plans, and the spellings of letters."""

from __future__ import annotations

import copy
import unicodedata
from collections.abc import Callable, Iterator, Mapping

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.springs import DrawnSprings, draw_springs, spring_letters
from planmethod.construct.arithmetic import Number
from planmethod.construct.dual import angle
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import Name, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import plan_of
from planmethod.plans.model import FACTS, MOTION, Ends, PlanKind
from planmethod.problem.names import LOOKALIKES
from planmethod.problem.quantities import (
    BALANCES,
    CENTRES,
    TRANSFERS,
    TURNINGS,
    QuantityKey,
    QuantityKind,
    Sign,
)
from planmethod.solved.errors.spread import RADIAN
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.quantity_steps import NoValue, NoValueError, QuantitySteps
from planmethod.solved.solution import Solution

USUAL = (
    QuantityKind.VELOCITY,
    QuantityKind.SLIDING,
    QuantityKind.OMEGA,
    QuantityKind.ACCELERATION,
    QuantityKind.CORIOLIS,
    QuantityKind.EPSILON,
)
"""Kinds of the motion that are questions by default, in this order."""

GREEK = {
    "ω": "omega", "ε": "epsilon", "φ": "phi", "Φ": "inertia", "ϕ": "phi", "έ": "epsilon", "τ": "t",
}  # fmt: skip
SHORT = {"eps": "epsilon", "om": "omega", "w": "omega", "fi": "phi"}
DROPPED = str.maketrans("", "", " _{}^()|,.·-–—/'′’*\\$\u00a0\u202f")


def normalize(text: str) -> str:
    """Return the letters without all differences of spelling."""
    folded = unicodedata.normalize("NFKC", text).translate(DROPPED)
    folded = "".join(LOOKALIKES.get(c, c) for c in folded)
    folded = "".join(GREEK.get(c, c) for c in folded)
    for short, whole in SHORT.items():
        rest = folded[len(short) :]
        if folded.lower().startswith(short) and rest.isdigit():
            return whole + rest
    return folded.lower()


class Question(Struct, frozen=True):
    """One quantity of a problem in one position, and the steps that give it (вопрос).

    Attributes
    ----------
    key : QuantityKey
    id : str
        Default name: ``v_B3``.
    symbol : str
        Rich text: ``v_{B3}``.
    unit : str
        SI; ``deg``, ``mm``.
    sign : Sign
    evaluate : callable
        The quantity from a trace, with its sign.
    needs : tuple of Name
    name : NumberName or None
        Number of the program; None for an angle, from which no value follows.
    plan : PlanKind or None
    length : NumberName or None
        Length of its segment, mm.
    ends : (PointName, PointName) or None
        Ends of that segment.
    direction_sign : float
        -1 where the vector points from the second end to the first.
    """

    key: QuantityKey
    id: str
    symbol: str
    unit: str
    sign: Sign
    evaluate: Callable[[Trace], Number]
    needs: tuple[Name, ...]
    name: NumberName | None = None
    plan: PlanKind | None = None
    length: NumberName | None = None
    ends: Ends | None = None
    direction_sign: float = 1.0

    @property
    def is_mm(self) -> bool:
        """True for a length on a plan."""
        return self.unit == "mm"

    @property
    def scale(self) -> str:
        """Scale of its plan: ``mu_v``; empty if there is none."""
        return "" if self.plan is None else FACTS[self.plan].scale


class Questions:
    """Find quantities of a solution in one position, and extend the program by the required steps.

    Parameters
    ----------
    solution : Solution
    position : int
        From 0.
    """

    def __init__(self, solution: Solution, position: int = 0) -> None:
        self.solution, self.position = solution, position
        self.construction = solution.construction
        self.statics: Statics | None = None
        if solution.problem.dynamics is not None:
            self.statics = statics_of(solution)
        self.steps = QuantitySteps(solution, position, self.statics)
        self.springs: DrawnSprings = draw_springs(self.steps, self.statics)
        self._cache: dict[QuantityKey, Question] = {}

    def for_variant(self, solution: Solution) -> Questions:
        """Return the same questions of another solution, which is drawn by the same steps."""
        other = copy.copy(self)
        other.solution, other.construction = solution, solution.construction
        if self.statics is not None:
            other.statics = statics_of(solution)
        other.steps = self.steps.for_variant(solution, other.statics)
        other._cache = dict(self._cache)
        return other

    def question(self, key: QuantityKey) -> Question:
        """Return a quantity with its steps.

        Raises
        ------
        NoValueError
            When the problem has no such quantity.
        """
        if key not in self._cache:
            self._cache[key] = self._create(key)
        return self._cache[key]

    def match(self, question: Question) -> Question:
        """Return a question of another variant as one of this.

        Raises
        ------
        NoValueError
            When the problem has no such quantity.
        """
        found = self.question(question.key)
        return found if found.id == question.id else self.direction(found)

    def usual(self) -> Iterator[QuantityKey]:
        """Yield the default quantities: velocities, accelerations, ω, ε, forces."""
        construction, kinematics = self.construction, self.construction.kinematics
        # Nothing, and the given ones.
        told = {self.steps.zero, *construction.draft.numbers}
        wheels = {
            link for group in construction.structure.groups for link in group.links if group.mesh
        }
        pairs = dict(self.steps.pairs())
        for kind in USUAL:
            for quantity in construction.legend:
                if quantity.kind is not kind or quantity.size is None or quantity.size in told:
                    continue
                read = (plan_of(kind), quantity.of) in kinematics.turnings
                if kind in TURNINGS and not (read or quantity.of in wheels):
                    continue  # given, or that of the link that it slides on
                if kind is QuantityKind.SLIDING and quantity.of.endswith(f"/{FRAME}"):
                    continue  # the velocity itself
                told.add(quantity.size)
                yield QuantityKey(kind, pairs.get(quantity.of, (quantity.of,)))
        if self.statics is not None:
            for letter in spring_letters(self.solution):
                yield QuantityKey(QuantityKind.LOAD, (letter,))
            for reaction in self.statics.board.reactions:
                size = self.statics.board.segments.known(reaction.force.ends)
                if size not in told:
                    told.add(size)
                    yield QuantityKey(QuantityKind.REACTION, (reaction.on, reaction.by))
            yield QuantityKey(QuantityKind.BALANCE, ())
            if self.statics.lever_plan is not None:
                yield QuantityKey(QuantityKind.LEVER, ())

    def links(self) -> dict[str, dict[str, bool]]:
        """Return the points of the links by their letters, and whether each is fixed."""
        bodies, velocity = self.solution.problem.bodies, self.construction.kinematics.velocity
        frame = bodies[FRAME].points
        found = {
            link: {point: point in frame for point in body.points}
            for link, body in bodies.items()
            if link != FRAME
        }
        for link, place in velocity.point:
            if link in found:
                found[link].setdefault(velocity.label(link, place), False)
        return found

    def arms(self) -> Iterator[tuple[str, str]]:
        """Yield the points of links that turn about a fixed one, and that point."""
        for points in self.links().values():
            fixed = [name for name, still in points.items() if still]
            for name, still in points.items():
                if not still and len(fixed) == 1:
                    yield name, fixed[0]

    # Steps -----------------------------------------------------------------------------------

    def _create(self, key: QuantityKey) -> Question:
        if key.over is not None:
            return self._quotient(key, key.over)
        if key.is_angle:
            return self._angle(key)
        kind, name = key.kind, self.steps.number(key)
        if kind in TURNINGS:
            return self._rate(key, name)
        if kind in CENTRES:
            return self._by_centres(key, name)
        unit = kind.written_unit
        if kind.is_length_on_paper:
            plan = plan_of(kind)
            drawn = plan is not PlanKind.POSITION
            ends = tuple(self.steps.point(plan, one) for one in key.names) if drawn else ()
            between = (ends[0], ends[1]) if ends else None
            return self._make_question(key, unit, name, plan, name, between)
        if kind in TRANSFERS or unit == "N·m":
            return self._make_question(key, unit, name)
        if key.axis:
            return self._make_question(key, unit, name, plan_of(kind))
        if kind in BALANCES:
            return self._balance(key, name)
        plan, ends_of = plan_of(kind), self.steps.ends(key, name)
        if ends_of is None and kind is QuantityKind.LOAD and name != self.steps.zero:
            return self._make_question(key, "N·m", name)  # a couple
        is_turned = kind is QuantityKind.REACTION and ends_of is not None
        sign = self.steps.sense(key) if is_turned else 1.0
        return self._of_segment(key, unit, name, plan, ends_of, sign)

    def _by_centres(self, key: QuantityKey, name: NumberName) -> Question:
        """Return a quantity by instant centres; a distance may be given in mm of the drawing."""
        if key.kind is not QuantityKind.CENTRE_DISTANCE:
            return self._make_question(key, key.kind.unit, name)
        one, two, point = key.names
        drawn = self.steps.centres.drawn((one, two), point)
        return self._make_question(key, "m", name, PlanKind.POSITION, drawn)

    def _rate(self, key: QuantityKey, name: NumberName) -> Question:
        plan, kinematics = plan_of(key.kind), self.construction.kinematics
        rates = kinematics.rates(plan)
        for (of, link), turning in kinematics.turnings.items():
            if of is plan and rates.get(link) == name:
                length = self.steps.segments(plan).drawn((turning.start, turning.head))
                return self._make_question(key, key.kind.unit, name, plan, length)
        return self._make_question(key, key.kind.unit, name)

    def _balance(self, key: QuantityKey, name: NumberName) -> Question:
        balancing = self.solution.problem.balancer
        ends = self.steps.ends(key, name)
        plan = None if ends is None else PlanKind.FORCE
        if key.names:
            return self._of_segment(key, "N", name, plan, ends)
        by_lever = key.kind is QuantityKind.LEVER
        symbol = f"lever {balancing.quantity}" if by_lever else balancing.symbol
        return replace(self._of_segment(key, balancing.unit, name, plan, ends), symbol=symbol)

    def _of_segment(
        self, key: QuantityKey, unit: str, name: NumberName, plan: PlanKind | None,
        ends: Ends | None, direction_sign: float = 1.0,
    ) -> Question:  # fmt: skip
        """Return a question of a quantity that a segment of a plan may represent."""
        length = None
        if plan is not None and ends is not None:
            length = self.steps.segments(plan).drawn(ends)
        return self._make_question(key, unit, name, plan, length, ends, direction_sign)

    def _make_question(
        self,
        key: QuantityKey,
        unit: str,
        name: NumberName,
        plan: PlanKind | None = None,
        length: NumberName | None = None,
        ends: Ends | None = None,
        direction_sign: float = 1.0,
    ) -> Question:
        def read_number(trace: Trace) -> Number:
            return trace.value[name]

        needs = tuple(n for n in (name, length, *(ends or ())) if n is not None)
        return Question(
            key, key.id, self.solution.problem.key_symbol(key), unit, key.sign, read_number,
            needs, name, plan, length, ends, direction_sign,
        )  # fmt: skip

    def _quotient(self, key: QuantityKey, over: QuantityKey) -> Question:
        above, below = self.question(key.dividend), self.question(over)
        if above.name is None or below.name is None:
            raise NoValueError(NoValue.NO_QUANTITY)
        name = self.steps.compute((above.name, 1), (below.name, -1))
        sign = Sign.SIZE if Sign.SIZE in (above.sign, below.sign) else Sign.STRICT
        return replace(self._make_question(key, "", name), sign=sign)

    def _angle(self, key: QuantityKey) -> Question:
        symbol = self.solution.problem.key_symbol(key)
        if not key.kind.is_force:
            line = self.steps.line(key)

            def read_angle(trace: Trace) -> Number:
                return angle(trace.value[line][1], 0.0) * RADIAN

            return Question(key, key.id, symbol, "deg", key.sign, read_angle, (line,))
        tail, head = self.steps.directed(key)

        def directed(trace: Trace) -> Number:
            return angle(trace.value[head] - trace.value[tail], 0.0) * RADIAN

        return Question(key, key.id, symbol, "deg", key.sign, directed, (tail, head))

    def direction(self, question: Question) -> Question:
        """Return the angle that a vector makes with +x, degrees.

        Raises
        ------
        NoValueError
            When no plan has the vector.
        """
        if question.ends is None:
            raise NoValueError(NoValue.NO_QUANTITY)
        tail, head = question.ends

        def read_angle(trace: Trace) -> Number:
            return (
                angle((trace.value[head] - trace.value[tail]) * question.direction_sign, 0.0)
                * RADIAN
            )

        own, symbol = f"angle_{question.id}", f"α({question.symbol})"
        return Question(question.key, own, symbol, "deg", Sign.ANGLE, read_angle, (tail, head))

    def segment(self, plan: PlanKind, letters: str) -> tuple[Ends, NumberName]:
        """Return the segment that two letters of a plan name, ``p b3``, and its length.

        Raises
        ------
        NoValueError
        """
        ends = letters_of(letters, self.lettered(plan))
        if ends is None or plan not in MOTION[1:]:
            raise NoValueError(NoValue.NO_POINT)
        return ends, self.steps.segments(plan).length(*ends)

    def lettered(self, plan: PlanKind) -> dict[str, PointName]:
        """Return the points of a velocity or acceleration plan by their letters; else none."""
        if plan not in MOTION[1:]:
            return {}
        found: dict[str, PointName] = {}
        drawn = self.construction.plan(plan)
        for at, shown in drawn.letters.items():
            for letter in shown.split(", "):
                found.setdefault(normalize(letter), at)
        motion = self.steps.kinematics.motion(plan)
        for name, of in motion.named.items():
            found.setdefault(normalize(name.lower()), motion.point[of])
        assert drawn.pole is not None
        for letter in ("p", "π"):
            found.setdefault(normalize(letter), drawn.pole)
        return found


def letters_of(text: str, known: Mapping[str, PointName]) -> Ends | None:
    """Return the two points that the letters of a segment name: ``p b3``, ``pb₃``, ``π-b3``."""
    folded = unicodedata.normalize("NFKC", text).strip().lower()
    for mark in "'′’`|":
        folded = folded.replace(mark, "")
    parts = [normalize(part) for part in folded.replace("-", " ").replace("–", " ").split()]
    if len(parts) == 2:
        cuts = [(parts[0], parts[1])]
    else:
        whole = normalize(folded)
        cuts = [(whole[:at], whole[at:]) for at in range(1, len(whole))]
    for one, two in cuts:
        if one in known and two in known and known[one] != known[two]:
            return known[one], known[two]
    return None
