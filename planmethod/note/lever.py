"""The equation of the Zhukovsky lever with numbers, as rich text (рычаг Жуковского)."""

from __future__ import annotations

import numpy as np

from planmethod.note.force_formulas import (
    NEWTON,
    NEWTON_METRE,
    arm_symbol,
    found,
    short,
    signed_sum,
)
from planmethod.note.letters import shown_letters
from planmethod.note.numbers import russian
from planmethod.note.sigmas import sigma_text
from planmethod.plans.forcereading import ForceReading
from planmethod.plans.leverreading import HungShift, LeverReading, OnLink
from planmethod.plans.model import PlanKind

STANDS = "Начальное звено неподвижно: рычаг не строится."


def both_balances(reading: ForceReading) -> tuple[float, float | None]:
    """Return the balancing moment or force as the hand finds it: by the plans, by the lever."""
    plans = float(reading.statics.balance_of(reading.statics.by_hand)[reading.index])
    hung = reading.statics.hung
    return plans, None if hung is None else reading.read_number(hung.balance)


def difference(reading: ForceReading) -> float | None:
    """Return how far the lever is from the force plans, per cent; None where there is neither."""
    balances = reading.statics.drawn.balances
    return None if balances is None else balances.share(reading.index)


def lever_lines(reading: ForceReading) -> list[str]:
    """Return the moments about the pole, the arms, what balances them, and the discrepancy."""
    if reading.statics.hung is None:
        return [STANDS]
    lever, symbol = LeverReading(reading), reading.balancing_symbol
    value = reading.read_number(reading.statics.hung.balance)
    unit = NEWTON if reading.statics.driving.moment is None else NEWTON_METRE
    loaded = [force for force in lever.forces if force.arm]
    terms = [(one.arm, f"{one.symbol}·{arm_symbol(one.symbol)}") for one in loaded]
    terms += [(one.lever_moment, _couple(lever, one)) for one in lever.couples]
    lines = [f"ΣM_{{p}} = {signed_sum(terms)} = 0"]
    arms = [f"{arm_symbol(one.symbol)} = {russian(f'{abs(one.arm):.1f}')}" for one in loaded]
    if arms:
        lines.append(f"{'; '.join(arms)} мм")
    segments = dict.fromkeys(_segment(lever, one) for one in (*lever.couples, *lever.shifts))
    lines += [segment for segment in segments if segment]
    lines += [_shift(lever, one) for one in lever.shifts]
    plans, _ = both_balances(reading)
    lines.append(f"{symbol} = {found(abs(value))} {unit}; по планам сил {found(abs(plans))} {unit}")
    share = difference(reading)
    if share is not None:
        lines.append(f"Расхождение {russian(f'{share:.1f}')} %")
        sigma = reading.statics.drawn.discrepancy_sigma
        if sigma is not None and np.isfinite(sigma[reading.index]):
            off = sigma_text(float(sigma[reading.index]))
            lines.append(f"Построение позволяет ожидать σ = {russian(off)} {unit}")
    return lines


def _shift(lever: LeverReading, one: HungShift) -> str:
    """Return how far the point of a shifted force is from the centre of mass on the lever."""
    length = russian(f"{abs(one.ends[1] - one.ends[0]):.1f}")
    return f"({''.join(one.letters)}) = {_couple(lever, one)} = {length} мм"


def _couple(lever: LeverReading, one: OnLink) -> str:
    """Return a couple with the arm that it has on the lever: ``M_{Φ2}·(bc)/l_{BC}``."""
    letters = _letters(lever, one)
    if letters is None:
        return f"{one.symbol}·ω_{{{one.link}}}/μ_{{v}}"
    return f"{one.symbol}·{letters[0]}/{letters[1]}"


def _segment(lever: LeverReading, one: OnLink) -> str:
    letters = _letters(lever, one)
    if letters is None:
        return ""
    assert one.segment is not None
    length = abs(one.segment[1] - one.segment[0])
    metres = length / one.ratio if one.ratio else 0.0
    return (
        f"{letters[0]} = {russian(f'{length:.1f}')} мм;  {letters[1]} = {short(round(metres, 4))} м"
    )


def _letters(lever: LeverReading, one: OnLink) -> tuple[str, str] | None:
    """Return the letters of a couple's segment on the lever and of the length of its link."""
    if one.segment is None or one.joints is None:
        return None
    plan = lever.reading.solution.construction.plan(PlanKind.VELOCITY)
    letters = shown_letters(lever.reading.solution.problem, plan)
    ends = []
    for place in one.segment:
        near = [name for name in letters if abs(lever.place(name) - place) < 1e-6]
        if not near:
            return None
        ends.append(letters[near[0]][0])
    named = {name for _, name, _ in lever.reading.solution.problem.lengths}
    joints = "".join(one.joints[::-1])
    joints = joints if joints in named else "".join(one.joints)
    return f"({''.join(ends)})", f"l_{{{joints}}}"
