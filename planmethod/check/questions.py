"""Questions of a problem, found in the program of its plans, and the spellings of letters."""

from __future__ import annotations

import copy
import unicodedata
from collections.abc import Callable, Iterator, Mapping
from enum import Enum

from msgspec import Struct

from planmethod.construct.arithmetic import Number
from planmethod.construct.dual import angle
from planmethod.construct.evaluate import Trace
from planmethod.construct.steps import LineName, Name, NumberName, PointName
from planmethod.mechanism.model import FRAME
from planmethod.plans.build import PLAN_OF, QuantityKind
from planmethod.plans.model import FACTS, MOTION, Ends, PlanKind, Segments, VectorKind
from planmethod.problem.answers import FORCES, TRANSFERS, Selector
from planmethod.problem.names import LOOKALIKES
from planmethod.solved.errors.spread import RADIAN
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.selectors.steps import COMPONENTS, NoValue, NoValueError, SelectorSteps
from planmethod.solved.selectors.values import ForceValues
from planmethod.solved.solution import Solution

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


def name_and_symbol(selector: Selector) -> tuple[str, str]:
    """Return what a quantity is called, ``v_B3``, and its symbol in rich text, ``v_{B3}``."""
    kind, names = selector.kind, selector.names
    own = f"{kind.replace(' ', '_')}_{'_'.join(names)}" if names else kind
    letters = {
        "omega": "ω",
        "epsilon": "ε",
        "phi": "φ",
        "vs": "v",
        "an": "a^{n}",
        "at": "a^{τ}",
        "ak": "a^{k}",
        "ar": "a^{r}",
        "Ft": "F^{τ}",
        "Fn": "F^{n}",
        "weight": "G",
        "inertia": "Φ",
        "length": "l",
        "v_q": "v",
        "a_q": "a",
        "epsilon_q": "ε",
        "load": "",
    }
    if selector.over is not None:
        over_own, over_symbol = name_and_symbol(selector.over)
        one_own, one_symbol = name_and_symbol(Selector(kind, names))
        return f"{one_own}/{over_own}", f"{one_symbol}/{over_symbol}"
    if kind.startswith("segment"):
        return own, "".join(name.lower() for name in names)
    if kind.startswith("arm"):
        return own, "h_{" + ",".join(names) + "}"
    if kind.startswith("angle"):
        return own, "α_{" + ",".join(names) + "}"
    letter = letters.get(kind, kind)
    if kind == "load":
        return own, names[0]
    if kind.endswith("_q"):
        return own, f"{letter}_{{q{names[0]}}}"
    if kind == "inertia couple":
        return own, f"M_{{Φ{names[0]}}}"
    joined = "".join(names) if all(len(n) < 3 for n in names) else ",".join(names)
    return own, f"{letter}_{{{joined}}}" if names else letter


def worded(selector: Selector) -> str:
    """Return a quantity in the words of ``[published]``: what `parse_selector` reads as it."""
    kind, names = selector.kind, list(selector.names)
    if kind.startswith("arm "):
        names.insert(-1, "about")
    words = " ".join((kind, *names))
    return words if selector.over is None else f"{words} / {worded(selector.over)}"


RATES = ("omega", "epsilon")
DRIVES = ("balance", "lever")


class Sign(Enum):
    """Meaning of the sign of an answer."""

    SIZE = "size"  # no meaning: it is a magnitude
    TURN = "turn"  # the sense, which may be stated separately instead
    STRICT = "strict"  # it belongs to the number
    ANGLE = "angle"  # degrees, whole turns do not count


class Question(Struct, frozen=True):
    """One quantity of a problem in one position, and the steps that give it (вопрос).

    Attributes
    ----------
    selector : Selector
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

    selector: Selector
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
        draft = self.construction.draft
        if solution.problem.dynamics is not None:
            self.statics = statics_of(solution)
            draft = self.statics.board.draft
        self._selecting = SelectorSteps(solution, draft.copy())
        self._cache: dict[Selector, Question] = {}

    def for_variant(self, solution: Solution) -> Questions:
        """Return the same questions of another solution, which is drawn by the same steps."""
        other = copy.copy(self)
        other.solution, other.construction = solution, solution.construction
        if self.statics is not None:
            other.statics = statics_of(solution)
        other._cache = dict(self._cache)
        return other

    @property
    def selecting(self) -> SelectorSteps:
        """The construction with the steps of all quantities requested so far."""
        return self._selecting

    def question(self, selector: Selector) -> Question:
        """Return a quantity with its steps.

        Raises
        ------
        NoValueError
            When the problem has no such quantity.
        """
        if selector not in self._cache:
            self._cache[selector] = self._create(selector)
        return self._cache[selector]

    def match(self, question: Question) -> Question:
        """Return a question of another variant as one of this.

        Raises
        ------
        NoValueError
            When the problem has no such quantity.
        """
        found = self.question(question.selector)
        return found if found.id == question.id else self.direction(found)

    def usual(self) -> Iterator[Selector]:
        """Yield the default quantities: velocities, accelerations, ω, ε, forces."""
        construction, kinematics = self.construction, self.construction.kinematics
        # Nothing, and the given ones.
        told = {self._selecting.zero, *self.construction.draft.numbers}
        kinds = (
            (QuantityKind.VELOCITY, "v"),
            (QuantityKind.SLIDING, "vs"),
            (QuantityKind.OMEGA, "omega"),
            (QuantityKind.ACCELERATION, "a"),
            (QuantityKind.CORIOLIS, "ak"),
            (QuantityKind.EPSILON, "epsilon"),
        )
        for kind, word in kinds:
            for quantity in construction.legend:
                if quantity.kind is not kind or quantity.size is None or quantity.size in told:
                    continue
                if word in RATES and (kind.plan, quantity.of) not in kinematics.turnings:
                    continue  # given, or that of the link that it slides on
                if word == "vs" and quantity.of.endswith(f"/{FRAME}"):
                    continue  # the velocity itself
                told.add(quantity.size)
                yield Selector(word, self._names(word, quantity.of))
        if self.statics is not None:
            for reaction in self.statics.board.reactions:
                size = self.statics.board.segments.known(reaction.force.ends)
                if size not in told:
                    told.add(size)
                    yield Selector("F", (reaction.on, reaction.by))
            yield Selector("balance", ())
            if self.statics.lever_plan is not None:
                yield Selector("lever", ())

    def _names(self, word: str, of: str) -> tuple[str, ...]:
        if word not in ("vs", "ak", "ar"):
            return (of,)
        return next(pair for name, pair in self.pairs() if name == of)

    def pairs(self) -> Iterator[tuple[str, tuple[str, str]]]:
        """Yield the sliding pairs by name, ``B3/2``, and their coincident points, ``B3``, ``B``."""
        label = self.construction.kinematics.velocity.label
        for relative in self.construction.kinematics.relatives.values():
            place = relative.point
            yield relative.name, (label(relative.of, place), label(relative.to, place))

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

    def vectors(self) -> Iterator[tuple[Selector, PlanKind, Ends]]:
        """Yield the vectors of the plans between two points of a link: v_ED, aⁿ_ED, a^τ_ED."""
        words = {
            (PlanKind.VELOCITY, VectorKind.RELATIVE): "v",
            (PlanKind.ACCELERATION, VectorKind.NORMAL): "an",
            (PlanKind.ACCELERATION, VectorKind.TANGENTIAL): "at",
        }
        for plan in self.construction.plans:
            for vector in plan.vectors:
                word = words.get((plan.kind, vector.kind))
                if word is None or vector.direction is None:
                    continue
                joint = vector.direction.points[1]
                index = vector.symbol.rpartition("_{")[2].removesuffix("}").removesuffix(joint)
                yield Selector(word, (index, joint)), plan.kind, (vector.tail, vector.head)

    # Steps -----------------------------------------------------------------------------------

    def _create(self, selector: Selector) -> Question:
        kind = selector.kind
        if selector.over is not None:
            return self._quotient(selector)
        if kind == "phi" or kind.startswith("angle "):
            return self._angle(selector)
        if kind in FORCES:
            return self._force(selector)
        for known, plan, ends in self.vectors():
            values = self._segments(plan).values
            if known == selector and ends in values:  # as on the plan, not computed again
                return self._number(selector, values[ends], Sign.SIZE, plan, ends)
        if kind == "vs":
            name = self._selecting.relative("v", *selector.names)
            between = self._ends(PlanKind.VELOCITY, name)
            return self._number(selector, name, Sign.SIZE, PlanKind.VELOCITY, between)
        answer = self._selecting.select(selector)
        if answer.plan is not None:
            tail, head = (self._selecting.point(answer.plan, name) for name in selector.names)
            between = None if answer.plan is PlanKind.POSITION else (tail, head)
            return self._make_question(
                selector, "mm", Sign.SIZE, answer.name, answer.plan, answer.name, between
            )
        if kind in TRANSFERS:
            sign = Sign.STRICT if answer.signed else Sign.SIZE
            return self._make_question(selector, "" if answer.signed else "m", sign, answer.name)
        if kind in COMPONENTS:
            plan = COMPONENTS[kind]
            return self._make_question(selector, FACTS[plan].unit, Sign.STRICT, answer.name, plan)
        if kind in RATES:
            return self._rate(selector, answer.name)
        plan = PLAN_OF[kind[0]]  # of a, an, at, ak, ar; of v
        return self._number(selector, answer.name, Sign.SIZE, plan, self._ends(plan, answer.name))

    def _segments(self, plan: PlanKind) -> Segments:
        if plan is PlanKind.FORCE:
            assert self.statics is not None
            return self.statics.board.segments
        return self._selecting.segments(plan)

    def _ends(self, plan: PlanKind, name: NumberName) -> Ends | None:
        """Return the segment that a number is the value of."""
        values = self._segments(plan).values
        return next((ends for ends, value in values.items() if value == name), None)

    def _rate(self, selector: Selector, name: NumberName) -> Question:
        plan = PLAN_OF[selector.kind]
        kinematics = self.construction.kinematics
        rates = kinematics.rates(plan)
        ends = next(
            (
                (turning.start, turning.head)
                for (of, link), turning in kinematics.turnings.items()
                if of is plan and rates.get(link) == name
            ),
            None,
        )
        unit = "1/s" if plan is PlanKind.VELOCITY else "1/s²"
        length = None if ends is None else self._segments(plan).drawn(ends)
        return self._make_question(selector, unit, Sign.TURN, name, plan if ends else None, length)

    def _number(
        self, selector: Selector, name: NumberName, sign: Sign, plan: PlanKind, ends: Ends | None
    ) -> Question:
        length = None if ends is None else self._segments(plan).drawn(ends)
        return self._make_question(selector, FACTS[plan].unit, sign, name, plan, length, ends)

    def _make_question(
        self,
        selector: Selector,
        unit: str,
        sign: Sign,
        name: NumberName,
        plan: PlanKind | None = None,
        length: NumberName | None = None,
        ends: Ends | None = None,
        direction_sign: float = 1.0,
        symbol: str = "",
    ) -> Question:
        def read_number(trace: Trace) -> Number:
            return trace.value[name]

        needs = tuple(n for n in (name, length, *(ends or ())) if n is not None)
        own, usual = name_and_symbol(selector)
        return Question(
            selector,
            own,
            symbol or usual,
            unit,
            sign,
            read_number,
            needs,
            name,
            plan,
            length,
            ends,
            direction_sign,
        )

    def _quotient(self, selector: Selector) -> Question:
        assert selector.over is not None
        above = self.question(Selector(selector.kind, selector.names))
        below = self.question(selector.over)
        if above.name is None or below.name is None:
            raise NoValueError(NoValue.NO_QUANTITY)
        name = self._selecting.compute((above.name, 1), (below.name, -1))
        sign = Sign.SIZE if Sign.SIZE in (above.sign, below.sign) else Sign.STRICT
        return self._make_question(selector, "", sign, name)

    def _angle(self, selector: Selector) -> Question:
        own, symbol = name_and_symbol(selector)
        if selector.kind == "phi":
            link = selector.names[0]
            axes = self._selecting.draft.axes
            if link not in axes:
                raise NoValueError(NoValue.NO_LINK)
            line: LineName = axes[link]

            def read_angle(trace: Trace) -> Number:
                return angle(trace.value[line][1], 0.0) * RADIAN

            return Question(selector, own, symbol, "deg", Sign.ANGLE, read_angle, (line,))
        tail, head = self._forces().directed(selector)

        def directed(trace: Trace) -> Number:
            return angle(trace.value[head] - trace.value[tail], 0.0) * RADIAN

        return Question(selector, own, symbol, "deg", Sign.ANGLE, directed, (tail, head))

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
        return Question(question.selector, own, symbol, "deg", Sign.ANGLE, read_angle, (tail, head))

    def _forces(self) -> ForceValues:
        return ForceValues(self.solution, self.position)

    def _force(self, selector: Selector) -> Question:
        forces, kind = self._forces(), selector.kind
        name = forces.select(self._selecting, selector)
        first = kind.partition(" ")[0]
        if first in ("arm", "shift"):
            return self._make_question(selector, "mm", Sign.SIZE, name, PlanKind.POSITION, name)
        if kind in DRIVES:
            balancing = self.solution.problem.drive.balancing
            unit = "N" if selector.names else balancing.unit
            sign = Sign.TURN if not selector.names else Sign.SIZE
            ends = self._ends(PlanKind.FORCE, name)
            plan = None if ends is None else PlanKind.FORCE
            length = None if ends is None else self._segments(PlanKind.FORCE).drawn(ends)
            symbol = balancing.symbol if kind == "balance" else f"lever {balancing.quantity}"
            return self._make_question(
                selector,
                unit,
                sign,
                name,
                plan,
                length,
                ends,
                symbol="" if selector.names else symbol,
            )
        if kind in ("M", "inertia couple"):
            return self._make_question(selector, "N·m", Sign.SIZE, name)
        ends, way = self._ends(PlanKind.FORCE, name), 1.0
        if ends is None:
            unit = "N·m" if kind == "load" and name != self._selecting.zero else "N"
            plan = PlanKind.FORCE if unit == "N" else None
            return self._make_question(selector, unit, Sign.SIZE, name, plan)
        if kind == "F":
            way = forces.sense(selector)
        length = self._segments(PlanKind.FORCE).drawn(ends)
        return self._make_question(
            selector, "N", Sign.SIZE, name, PlanKind.FORCE, length, ends, way
        )

    def segment(self, plan: PlanKind, letters: str) -> tuple[Ends, NumberName]:
        """Return the segment that two letters of a plan name, ``p b3``, and its length.

        Raises
        ------
        NoValueError
        """
        ends = letters_of(letters, self.lettered(plan))
        if ends is None or plan not in MOTION[1:]:
            raise NoValueError(NoValue.NO_POINT)
        return ends, self._selecting.segments(plan).length(*ends)

    def lettered(self, plan: PlanKind) -> dict[str, PointName]:
        """Return the points of a velocity or acceleration plan by their letters; else none."""
        if plan not in MOTION[1:]:
            return {}
        found: dict[str, PointName] = {}
        drawn = self.construction.plan(plan)
        for at, shown in drawn.letters.items():
            for letter in shown.split(", "):
                found.setdefault(normalize(letter), at)
        motion = self._selecting.motion(plan)
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
