"""The equation of the Zhukovsky lever with numbers, as rich text (рычаг Жуковского)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from planmethod.note.narrate.forces.formulas import arm_symbol, signed_sum
from planmethod.note.narrate.letters import shown_letters
from planmethod.note.numbers import Notation
from planmethod.note.rounding import sigma_text
from planmethod.note.wording import Language
from planmethod.plans.model import PlanKind
from planmethod.problem.model import Convention
from planmethod.solved.errors.forces import drawn_forces
from planmethod.solved.forces.lever import HungShift, LeverReading, OnLink
from planmethod.solved.forces.reading import ForceReading


@dataclass(frozen=True, slots=True)
class PairText:
    """How a couple stands on the lever: in letters, in numbers, and where those come from.

    ``letters`` is ``(bc)/l_{BC}``, ``numbers`` ``73,0/0,3``; ``segment`` tells both lengths, or is
    empty where the lever has no segment of the link.
    """

    letters: str
    numbers: str
    segment: str


def both_balances(reading: ForceReading) -> tuple[float, float | None]:
    """Return the balancing moment or force as the hand finds it: by the plans, by the lever."""
    plans = float(drawn_forces(reading.statics).balance[reading.index])
    hung = reading.statics.hung
    return plans, None if hung is None else reading.read_number(hung.balance)


def difference(reading: ForceReading) -> float | None:
    """Return how far the lever is from the force plans, per cent; None where there is neither."""
    balances = drawn_forces(reading.statics).balances
    return None if balances is None else balances.share(reading.index)


def lever_unit(reading: ForceReading, say: Notation) -> str:
    """Return the unit of what balances the driving link."""
    return say.units[reading.balancing.unit]


def lever_lines(reading: ForceReading, words: Language) -> list[str]:
    """Return the moments about the pole, the arms, what balances them, and the discrepancy."""
    said, say = words.sheets, words.say
    if reading.statics.hung is None:
        return [said.lever_stands]
    lever, symbol = LeverReading(reading), say.symbol(reading.balancing_symbol)
    unit, found = lever_unit(reading, say), say.found
    if not lever.forces and not lever.couples:
        return [said.lever_no_work.format(symbol=symbol)]
    lines = [lever_equation(lever, say)]
    arms = lever_arms(lever, say)
    if arms:
        lines.append(f"{'; '.join(arms)} {say.units['mm']}")
    on_links = (*lever.couples, *lever.shifts)
    segments = (pair(lever, one, say).segment for one in on_links)
    lines += [text for text in dict.fromkeys(segments) if text]
    lines += [shift_text(lever, one, say) for one in lever.shifts]
    plans, value = both_balances(reading)
    assert value is not None
    both = {"lever": f"{found(abs(value))} {unit}", "plans": f"{found(abs(plans))} {unit}"}
    lines.append(said.lever_found.format(symbol=symbol, **both))
    share = difference(reading)
    if share is not None:
        lines.append(said.lever_difference.format(share=say.number(f"{share:.1f}")))
        sigma = expected(reading)
        if sigma is not None:
            off = f"{say.number(sigma_text(sigma))} {unit}"
            lines.append(said.lever_expected.format(sigma=off))
    return lines


def expected(reading: ForceReading) -> float | None:
    """Return one sigma of lever minus force plans; None where a drawing cannot tell it."""
    sigma = drawn_forces(reading.statics).discrepancy_sigma
    if sigma is None or not np.isfinite(sigma[reading.index]):
        return None
    return float(sigma[reading.index])


def lever_equation(lever: LeverReading, say: Notation) -> str:
    """Return the sum of the moments about the pole in letters, each with its sign."""
    forces = [(one.arm, say.symbol(one.symbol)) for one in lever.forces if one.arm]
    terms = [(arm, f"{symbol}·{arm_symbol(symbol)}") for arm, symbol in forces]
    terms += [
        (one.lever_moment, f"{say.symbol(one.symbol)}·{pair(lever, one, say).letters}")
        for one in lever.couples
    ]
    return f"ΣM_{{p}} = {signed_sum(terms)} = 0"


def lever_arms(lever: LeverReading, say: Notation) -> list[str]:
    """Return the arms of the forces that have one, mm."""
    return [
        f"{arm_symbol(say.symbol(one.symbol))} = {say.ruled(abs(one.arm))}"
        for one in lever.forces
        if one.arm
    ]


def pair(lever: LeverReading, one: OnLink, say: Notation) -> PairText:
    """Return a couple, or what else goes with ω, by the ends of its link's segment on the lever."""
    ends = _letters(lever, one)
    if ends is None or one.joints is None:
        inverse = lever.reading.solution.problem.scales.convention is Convention.MM_PER_UNIT
        sign, scale = ("·", 1.0 / lever.per_mm) if inverse else ("/", lever.per_mm)
        omega = say.short(one.ratio * lever.per_mm)
        return PairText(f"ω_{{{one.link}}}{sign}μ_{{v}}", f"{omega}{sign}{say.short(scale)}", "")
    letters, length = ends
    segment, link = say.ruled(one.ratio * one.length), say.short(one.length)
    told = f"{letters} = {segment} {say.units['mm']};  {length} = {link} {say.units['m']}"
    return PairText(f"{letters}/{length}", f"{segment}/{link}", told)


def shift_text(lever: LeverReading, one: HungShift, say: Notation) -> str:
    """Return how far the point of a shifted force is from the centre of mass on the lever."""
    told = pair(lever, one, say)
    formula = f"{one.symbol}·{told.letters} = {say.found(one.shift)}·{told.numbers}"
    length = say.number(f"{one.shift * one.ratio:.1f}")
    return f"({''.join(one.letters)}) = {formula} = {length} {say.units['mm']}"


def _letters(lever: LeverReading, one: OnLink) -> tuple[str, str] | None:
    """Return the letters of a couple's segment on the lever and of the length of its link."""
    if one.ends is None or one.joints is None:
        return None
    problem = lever.reading.solution.problem
    letters = shown_letters(problem, lever.reading.solution.construction.plan(PlanKind.VELOCITY))
    if not all(end in letters for end in one.ends):
        return None
    named = {name for _, name, _ in problem.lengths}
    joints = "".join(one.joints[::-1])
    on_link = all(joint in problem.bodies[one.link].points for joint in one.joints)
    if on_link and joints not in named:
        joints = "".join(one.joints)
    return f"({''.join(letters[end][0] for end in one.ends)})", f"l_{{{joints}}}"
