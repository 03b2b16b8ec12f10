"""Formulas between the answers of a sheet, right and wrong: routes (пути вычисления).

A route is a product of other quantities of a link, with the length of its arm. Its constant is that
of the right answers, so a student's own numbers give the result to the digits written. A slip is a
route with one factor changed.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import NamedTuple, TypeVar

from planmethod.check.grading import ExaminedAnswer, collect_student_values
from planmethod.check.mistakes.forces import lever_by_segments
from planmethod.check.mistakes.plans import MistakeContext
from planmethod.check.relations import MIN_ROUNDING
from planmethod.check.sheet import Sheet, single_float
from planmethod.construct.program import rewritten
from planmethod.construct.steps import Compute, NumberName
from planmethod.mechanism.model import FRAME
from planmethod.plans.model import PlanKind
from planmethod.problem.quantities import TURNINGS, QuantityKey, QuantityKind, Sign

_V, _OMEGA, _NORMAL = QuantityKind.VELOCITY, QuantityKind.OMEGA, QuantityKind.NORMAL
_TAU, _EPSILON = QuantityKind.TANGENTIAL, QuantityKind.EPSILON
_SLIDING, _CORIOLIS = QuantityKind.SLIDING, QuantityKind.CORIOLIS


class Route(NamedTuple):
    """Quantities that one is a product of, with their powers, and that of the arm's length."""

    powers: Mapping[QuantityKind, int]
    length: int = 0


FROM_SPEEDS = (Route({_V: 2}, -1), Route({_OMEGA: 2}, 1), Route({_V: 1, _OMEGA: 1}))

ROUTES: Mapping[QuantityKind, tuple[Route, ...]] = {
    _V: (Route({_OMEGA: 1}, 1), Route({QuantityKind.TRANSFER: 1})),  # ω·l, v_q·ω₁
    _OMEGA: (Route({_V: 1}, -1), Route({QuantityKind.RATIO: 1})),  # v/l, u·ω₁
    _NORMAL: FROM_SPEEDS,
    _TAU: (Route({_EPSILON: 1}, 1), Route({_EPSILON: 1, _V: 1, _OMEGA: -1})),
    _EPSILON: (Route({_TAU: 1}, -1), Route({_TAU: 1, _OMEGA: 1, _V: -1})),  # l as in ω = v/l
    _CORIOLIS: (Route({_OMEGA: 1, _SLIDING: 1}),),  # 2·ω·v_r
    QuantityKind.TRANSFER: (Route({_V: 1}),),  # v/ω₁
    QuantityKind.RATIO: (Route({_OMEGA: 1}),),  # ω/ω₁
}
"""Routes to a quantity of an arm, a point of a link that turns about a pivot or two points of one.

No route leads back: velocities do not follow from accelerations.
"""

BY_OTHER_ARM = (_V, QuantityKind.ACCELERATION)
"""Kinds that follow from that of another arm of the same link: v'·l/l', a'·l/l'."""

Answer = TypeVar("Answer")

ArmQuantity = tuple[QuantityKind, str, tuple[str, ...]]
"""Kind, link, arm; empty arm for a quantity of a link."""

RouteAnswers = tuple[list[tuple[Answer, int]], int]
"""Answers that one is computed from, with their powers, and the power of the arm's length."""


def follow_routes(sheet: Sheet, examined: list[ExaminedAnswer], floor: float) -> None:
    """Let a number that is not as the plans find it follow the ones that it was computed from.

    Parameters
    ----------
    floor : float
        Least share of a computed number that it may be off.
    """
    answers = answers_by_arm(sheet, examined)
    # A point of a link moves by its ω, before ω is that of the point.
    for one in sorted(examined, key=lambda one: one.item.question.key.kind is _OMEGA):
        if not one.limit.exact or one.follows or (one.right and not one.contradicts):
            continue
        for quantity in arm_quantities(sheet, one.item.question.key):
            for powers, _ in find_routes(sheet, quantity, answers):
                parents = [parent for parent, _ in powers]
                if not one.routed and not would_circle(one, parents, examined):
                    try_powers(one, powers, floor)


def follow_lever(sheet: Sheet, examined: list[ExaminedAnswer]) -> None:
    """Let a lever follow the segments of the plan of velocities: those written, or those drawn.

    A couple is multiplied by ω or by ab/l; what was read wrongly may be right on the plan.
    """
    levers = [
        one
        for one in examined
        if one.item.question.key.kind is QuantityKind.LEVER
        and one.local is not None
        and one.slot is not None
        and not (one.follows or one.limit.zero)
    ]
    changed = lever_by_segments(MistakeContext(sheet)) if levers else {}
    if not changed:
        return
    program = rewritten(sheet.program, lambda step: changed.get(step.out, step))
    misread = {
        one.slot
        for one in examined
        if one.item.question.plan is PlanKind.VELOCITY and not one.right
    }
    own = collect_student_values(sheet, examined)
    for known in (own, {name: put for name, put in own.items() if name not in misread}):
        came, _ = sheet.replayed(known, program)
        for one in levers:
            local = came[one.slot] * one.per_slot if one.slot else 0.0
            slack = one.limit.tolerance(one.step) * max(1.0, abs(local / one.limit.exact))
            if not one.follows and abs(one.value - local) <= slack:
                one.local, one.local_tolerance = local, slack
                one.follows, one.contradicts = True, False


def answers_by_arm(
    sheet: Sheet, examined: Sequence[ExaminedAnswer]
) -> dict[ArmQuantity, ExaminedAnswer]:
    """Return the answers that others can be computed from, by their quantities."""
    answers: dict[ArmQuantity, ExaminedAnswer] = {}
    for one in examined:
        if one.limit.exact and one.value and not one.limit.zero:
            for quantity in arm_quantities(sheet, one.item.question.key):
                answers.setdefault(quantity, one)
    return answers


def try_powers(one: ExaminedAnswer, powers: list[tuple[ExaminedAnswer, int]], floor: float) -> None:
    """Let an answer follow some others, if their product gives it to the digits written."""
    local, rounding = _product(one, powers)
    slack = max(floor, rounding) * abs(local) + one.step / 2
    if not one.matches(local, slack):
        return
    one.local, one.local_tolerance = local, slack
    one.parents = {parent.item.id: abs(local) for parent, _ in powers}
    one.follows = one.closely = one.computed = one.routed = True
    one.contradicts = False


def _product(one: ExaminedAnswer, powers: list[tuple[ExaminedAnswer, int]]) -> tuple[float, float]:
    """Return what the student's own numbers give, and the share of it that rounding can change."""
    local, rounding = one.limit.exact, 0.0
    for parent, power in powers:
        ratio = parent.value / parent.limit.exact
        signed = parent.signed and one.item.question.sign is not Sign.SIZE
        local *= (ratio if signed else abs(ratio)) ** power
        rounding += abs(power) * _rounding(parent)
    return local, rounding


def would_circle(
    one: ExaminedAnswer, parents: Sequence[ExaminedAnswer], examined: Sequence[ExaminedAnswer]
) -> bool:
    """Return whether an answer would follow from its own consequence."""
    by_id = {other.item.id: other for other in examined}
    todo, seen = [*parents], set[str]()
    while todo:
        parent = todo.pop()
        if parent is one:
            return True
        if parent.item.id not in seen:
            seen.add(parent.item.id)
            todo += [by_id[name] for name in parent.parents]
    return False


def find_routes(
    sheet: Sheet, quantity: ArmQuantity, answers: Mapping[ArmQuantity, Answer]
) -> Iterator[RouteAnswers[Answer]]:
    """Yield the answers with their powers by which a quantity can be computed."""
    kind, link, arm = quantity
    routes = [(route, False) for route in ROUTES.get(kind, ())]
    routes += [(Route({kind: 1}), True)] if kind in BY_OTHER_ARM else []
    if kind is QuantityKind.ACCELERATION and _all_normal(sheet, link):
        routes += [(route, False) for route in (*FROM_SPEEDS, Route({_NORMAL: 1}))]
    for route, other_arm in routes:
        found: list[list[tuple[Answer, int]]] = [[]]
        for base_kind, power in route.powers.items():
            at = [
                other
                for (kind_of_arm, at_link, points), other in answers.items()
                if base_kind is kind_of_arm
                and at_link == link
                and (
                    len(points) == len(arm) == 1 and points != arm
                    if other_arm
                    else not arm or points in ((), arm)
                )
            ]
            found = [[*way, (other, power)] for way in found for other in at]
        yield from ((way, route.length) for way in found)


def _all_normal(sheet: Sheet, link: str) -> bool:
    """Return whether the acceleration of a link's points is purely normal: ε is zero."""
    kinematics = sheet.questions.construction.kinematics
    return (
        link not in kinematics.epsilon and not sheet.questions.solution.problem.drive.acceleration
    )


def arm_quantities(sheet: Sheet, quantity_key: QuantityKey) -> Iterator[ArmQuantity]:
    """Yield what a quantity is on its links."""
    kind, names = quantity_key.kind, quantity_key.names
    if quantity_key.over is not None or quantity_key.axis or not names:
        return
    if kind in TURNINGS or kind is QuantityKind.RATIO:
        if len(names) == 1:
            yield kind, names[0], ()
        return
    questions = sheet.questions
    if kind in (_SLIDING, _CORIOLIS):
        for relative in questions.construction.kinematics.relatives.values():
            if {*dict(questions.steps.pairs())[relative.name]} == {*names}:
                yield kind, relative.to, tuple(sorted(names))
        return
    if kind not in (*BY_OTHER_ARM, _NORMAL, _TAU, QuantityKind.TRANSFER):
        return
    for link, points in questions.links().items():
        if not {*names} <= {*points}:
            continue
        free = tuple(sorted(name for name in names if not points[name]))
        turns = any(points.values()) and bool(free)
        if turns or len(names) == 2:
            yield kind, link, free


# Slips ---------------------------------------------------------------------------------------


class RouteSlip(NamedTuple):
    """A value that a route with one factor changed gives, from a student's own numbers."""

    code: str
    mistake_at: str
    value: float


LENGTHS = "l"
"""Place of a mistake in the unit of all lengths."""

OTHER_LENGTH = {_OMEGA: "V5", _NORMAL: "N3"}
"""Code of a route with another length than that of the arm; "slip" for other quantities."""

INSTEAD: Mapping[QuantityKind, Mapping[QuantityKind, tuple[str, tuple[QuantityKind, ...]]]] = {
    _OMEGA: {_V: ("V6", (_V, _SLIDING))},
    _NORMAL: {_V: ("N3", (_V, _SLIDING)), _OMEGA: ("N3", (_OMEGA,))},
    _EPSILON: {_TAU: ("E2", (QuantityKind.ACCELERATION, QuantityKind.RELATIVE))},
    _CORIOLIS: {_SLIDING: ("A4", (_V,)), _OMEGA: ("A5", (_OMEGA,))},
}
"""Kinds of answers that are taken for the right factor of a route, and the code of that."""

DRAWN = 0.006
"""Share of a number that its tolerance exceeds where not only rounding is in it."""

MIN_DISTANCE = 3.0
"""Tolerances by which a slip must differ from the value that the right route gives."""

OPERATIONS = {
    QuantityKind.OMEGA: ("v", "/"),
    QuantityKind.EPSILON: ("a^{τ}", "/"),
    QuantityKind.VELOCITY: ("ω", "·"),
}
"""Quantity multiplied or divided by an arm: its letter, and the right operation."""


def describe_inversion(kind: QuantityKind) -> str:
    """Return the slip of a quantity that is multiplied for divided, or the reverse."""
    letter, operation = OPERATIONS[kind]
    other = {"·": "/", "/": "·"}[operation]
    return f"{letter}{other}l ≠ {letter}{operation}l"


def find_route_slips(
    sheet: Sheet, one: ExaminedAnswer, examined: Sequence[ExaminedAnswer]
) -> Iterator[RouteSlip]:
    """Yield the slips in the formulas of an answer that give just the number written."""
    if not one.limit.exact or one.limit.zero:
        return
    answers = answers_by_arm(sheet, examined)
    seen: set[str] = set()
    for quantity in arm_quantities(sheet, one.item.question.key):
        for powers, length in find_routes(sheet, quantity, answers):
            base, rounding = _product(one, powers)
            share = max(rounding, MIN_ROUNDING, _drawn(one))
            for code, where, factor, more in _factors(sheet, one, powers, length, examined):
                if code not in seen and _is_slip(one, base * factor, base, share + more):
                    seen.add(code)
                    yield RouteSlip(code, where, base * factor)


def _is_slip(one: ExaminedAnswer, value: float, base: float, rounding: float) -> bool:
    """Return whether a value is the number written, and the right route does not give it too."""
    tolerance = rounding * abs(value) + one.step / 2
    is_apart = abs(abs(value) - abs(base)) > MIN_DISTANCE * tolerance
    return is_apart and abs(abs(one.value) - abs(value)) <= tolerance


def _rounding(one: ExaminedAnswer) -> float:
    """Return the share of a number by which its rounding may change it."""
    return one.step / 2 / abs(one.value)


def _drawn(one: ExaminedAnswer) -> float:
    """Return the share of a number that its drawn arm may change, if it has one."""
    if one.local is None or one.local_tolerance is None or not one.local or one.routed:
        return 0.0
    share = one.local_tolerance / abs(one.local)
    return share if share > DRAWN else 0.0


def _factors(
    sheet: Sheet,
    one: ExaminedAnswer,
    powers: Sequence[tuple[ExaminedAnswer, int]],
    length: int,
    examined: Sequence[ExaminedAnswer],
) -> Iterator[tuple[str, str, float, float]]:
    """Yield code, place, factor of each slip in a route, and the rounding that it adds."""
    kind = one.item.question.key.kind
    code = OTHER_LENGTH.get(kind, "slip")
    if length:
        right = abs(one.limit.exact)
        for parent, power in powers:
            right /= abs(parent.limit.exact) ** power
        arm = right ** (1 / length)
        yield "S2", LENGTHS, 1000.0**length, 0.0
        for other in (2.0 * arm, 0.5 * arm, *_lengths(sheet)):
            yield code, "", (other / arm) ** length, 0.0
        multiplied = ("slip", describe_inversion(kind)) if kind in OPERATIONS else (code, "")
        yield *multiplied, arm ** (-2 * length), 0.0  # multiplied for divided
        yield code, "", arm**-length, 0.0
    if kind is _CORIOLIS:
        yield "A3", "", 0.5, 0.0
    for parent, power in powers:
        if power == 2:
            yield "N3", "", 1.0 / abs(parent.value), _rounding(parent)
        code, kinds = INSTEAD.get(kind, {}).get(parent.item.question.key.kind, ("", ()))
        for other in examined:
            if other.item.question.key.kind in kinds and other is not parent and other.value:
                factor = abs(other.value / parent.value) ** power
                yield code, "", factor, power * _rounding(other)


def _lengths(sheet: Sheet) -> Iterator[float]:
    """Yield the given lengths of links, m."""
    for link, body in sheet.questions.solution.problem.bodies.items():
        points = [*body.points.values()]
        if link != FRAME:
            for number, point in enumerate(points):
                yield from (abs(point - other) for other in points[:number] if point != other)


LOAD_FACTORS = {
    QuantityKind.ACCELERATION: (QuantityKind.ACCELERATION, _TAU, _NORMAL),
    _EPSILON: (_EPSILON, _OMEGA),
}
"""Kinds of answers that are taken for the acceleration in Φ or M."""


def find_load_slips(
    sheet: Sheet, one: ExaminedAnswer, examined: Sequence[ExaminedAnswer]
) -> Iterator[RouteSlip]:
    """Yield the slips in Φ = m·a and M = J·ε: another mass, another acceleration, ω for ε."""
    statics, base = sheet.questions.statics, one.local or one.limit.exact
    step = sheet.steps_by_name.get(one.item.question.name or NumberName(""))
    if statics is None or not isinstance(step, Compute) or not base:
        return
    letters = {
        name: letter for given in statics.board.given for name, letter in given.letters.items()
    }
    own = {other.item.question.name: other for other in examined if other.value}
    for name, _ in step.powers:
        letter, right = letters.get(name, ""), own.get(name)
        others: list[tuple[str, float, float]] = []
        if letter[:1] in ("m", "J"):
            others = [
                (other, single_float(sheet.exact_trace.value[number]), 0.0)
                for number, other in letters.items()
                if other[:1] == letter[:1] and number in sheet.steps_by_name
            ]
        elif letter and right is not None:
            kinds = LOAD_FACTORS.get(right.item.question.key.kind, ())
            others = [
                (other.item.question.symbol, abs(other.value), _rounding(other))
                for other in own.values()
                if other.item.question.key.kind in kinds
            ]
        now = abs(right.value) if right is not None else single_float(sheet.exact_trace.value[name])
        for other, value, rounding in others:
            made = RouteSlip("slip", f"{other} ≠ {letter}", base * value / now)
            if _is_slip(one, made.value, base, MIN_ROUNDING + rounding):
                yield made
