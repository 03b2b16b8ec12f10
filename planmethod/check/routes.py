"""By which formulas of the textbook one answer follows from others (пути вычисления).

The plans find a quantity in one way. A student may find it in any right one: aⁿ as v²/l and as
ω²·l, the speed of a centre of mass as ω·l. A route is the powers of the quantities that go into a
product; its other factors, lengths and given numbers, are the same for all.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TypeVar

from planmethod.check.grading import ExaminedAnswer, distance
from planmethod.check.questions import RATES, Sign
from planmethod.check.sheet import Sheet
from planmethod.problem.selector import Selector

Powers = Mapping[str, int]

ROUTES: Mapping[str, tuple[Powers, ...]] = {
    "v": ({"omega": 1}, {"v_q": 1}, {"v'": 1}),  # ω·l, v_q·ω₁; v'·l/l' of two points of a link
    "omega": ({"v": 1}, {"u": 1}),  # v/l, u·ω₁
    "an": ({"v": 2}, {"omega": 2}, {"v": 1, "omega": 1}),  # v²/l, ω²·l, v·ω
    "at": ({"epsilon": 1},),  # ε·l
    "epsilon": ({"at": 1},),  # a^τ/l
    "a": ({"a'": 1},),  # a'·l/l'
    "a=an": ({"v": 2}, {"omega": 2}, {"v": 1, "omega": 1}, {"an": 1}),  # only aⁿ
    "ak": ({"omega": 1, "vs": 1},),  # 2·ω·v_r
    "v_q": ({"v": 1},),  # v/ω₁
    "u": ({"omega": 1},),  # ω/ω₁
}
"""Routes to a quantity of an arm, a point of a link that turns about a pivot or two points of one.

A quantity with a prime is that of another arm of the same link. No route leads back: velocities do
not follow from accelerations.
"""

Answer = TypeVar("Answer")

QuantityKey = tuple[str, str, tuple[str, ...]]
"""Kind, link, arm; empty arm for a quantity of a link."""


def follow_routes(sheet: Sheet, examined: list[ExaminedAnswer], floor: float) -> None:
    """Let a number that is not as the plans find it follow the ones that it was computed from.

    Parameters
    ----------
    floor : float
        Least share of a computed number that it may be off.
    """
    keys_of_answers = {
        id(one): list(quantity_keys_of(sheet, one.item.question.selector)) for one in examined
    }
    told: dict[QuantityKey, ExaminedAnswer] = {}
    for one in examined:
        for quantity_key in keys_of_answers[id(one)]:
            if one.limit.exact and one.value and not one.limit.zero:
                told.setdefault(quantity_key, one)
    for one in examined:
        if not one.limit.exact or one.follows or (one.right and not one.contradicts):
            continue
        for quantity_key in keys_of_answers[id(one)]:
            for powers in find_routes(sheet, quantity_key, told):
                if one.routed or _would_circle(one, powers, examined):
                    continue
                try_powers(one, powers, floor)


def try_powers(one: ExaminedAnswer, powers: list[tuple[ExaminedAnswer, int]], floor: float) -> None:
    """Let an answer follow some others, if their product gives it to the digits written."""
    if all(parent.right for parent, _ in powers):
        return
    local, rounding = one.limit.exact, 0.0
    for parent, power in powers:
        ratio = parent.value / parent.limit.exact
        signed = parent.signed and one.item.question.sign is not Sign.SIZE
        local *= (ratio if signed else abs(ratio)) ** power
        rounding += abs(power) * parent.step / 2 / abs(parent.value)
    slack = max(floor, rounding) * abs(local) + one.step / 2
    turned = one.signed and one.value * local < 0
    if turned or distance(one.item, one.value, local, signed=one.signed) > slack:
        return
    one.local, one.local_tolerance = local, slack
    one.parents = {parent.item.id: abs(local) for parent, _ in powers}
    one.follows = one.closely = one.computed = one.routed = True
    one.contradicts = False


def _would_circle(
    one: ExaminedAnswer, powers: list[tuple[ExaminedAnswer, int]], examined: list[ExaminedAnswer]
) -> bool:
    """Return whether an answer would follow from its own consequence."""
    by_id = {other.item.id: other for other in examined}
    todo, seen = [parent for parent, _ in powers], set[str]()
    while todo:
        parent = todo.pop()
        if parent is one:
            return True
        if parent.item.id not in seen:
            seen.add(parent.item.id)
            todo += [by_id[name] for name in parent.parents]
    return False


def find_routes(
    sheet: Sheet, quantity_key: QuantityKey, answers: Mapping[QuantityKey, Answer]
) -> Iterator[list[tuple[Answer, int]]]:
    """Yield the answers with their powers by which a quantity can be computed."""
    kind, link, arm = quantity_key
    routes = ROUTES.get(kind, ())
    if kind == "a" and _all_normal(sheet, link):
        routes += ROUTES["a=an"]
    for powers in routes:
        found: list[list[tuple[Answer, int]]] = [[]]
        for of, power in powers.items():
            at = [
                other
                for (what, at_link, points), other in answers.items()
                if what == of.rstrip("'")
                and at_link == link
                and (
                    len(points) == len(arm) == 1 and points != arm
                    if of.endswith("'")
                    else points in ((), arm)
                )
            ]
            found = [[*way, (other, power)] for way in found for other in at]
        yield from found


def _all_normal(sheet: Sheet, link: str) -> bool:
    """Return whether the acceleration of a link's points is purely normal: ε is zero."""
    kinematics = sheet.questions.construction.kinematics
    return (
        link not in kinematics.epsilon and not sheet.questions.solution.problem.drive.acceleration
    )


def quantity_keys_of(sheet: Sheet, selector: Selector) -> Iterator[QuantityKey]:
    """Yield what a quantity is on its links."""
    kind, names = selector.kind, selector.names
    if selector.over is not None or not names:
        return
    if kind in RATES or kind == "u":
        if len(names) == 1:
            yield kind, names[0], ()
        return
    construction = sheet.questions.construction
    if kind in ("vs", "ak"):
        label = construction.kinematics.velocity.label
        for relative in construction.kinematics.relatives.values():
            pair = {label(relative.of, relative.point), label(relative.to, relative.point)}
            if pair == {*names}:
                yield kind, relative.to, tuple(sorted(names))
        return
    if kind not in ("v", "a", "an", "at", "v_q"):
        return
    for link, points in sheet.questions.links().items():
        if not {*names} <= {*points}:
            continue
        free = tuple(sorted(name for name in names if not points[name]))
        turns = any(points.values()) and bool(free)
        if turns or len(names) == 2:
            yield kind, link, free
