"""Where the reactions of the guides act, with numbers, as rich text (точки приложения реакций)."""

from __future__ import annotations

from planmethod.note.numbers import Notation
from planmethod.plans.forces.polygons import ForcePlan
from planmethod.solved.forces.guides import Guided, guide_of
from planmethod.solved.forces.reading import ForceReading


def place_lines(reading: ForceReading, plan: ForcePlan, say: Notation) -> list[str]:
    """Return how far from its joint each guide's reaction acts, by the hand's numbers.

    Of a force at the edges of its slider also what acts there.
    """
    found = (guide_of(reading, one.couple) for one in plan.moments if one.couple is not None)
    here = [guided for guided in found if guided is not None]
    in_joints = [one.own.symbol("l") for one in here if one.is_no_couple and _is_read(one)]
    lines = [f"{' = '.join(in_joints)} = 0"] if in_joints else []
    return lines + [line for one in here if not one.is_no_couple for line in _lines(one, say)]


def _is_read(guided: Guided) -> bool:
    """Whether a force is something, on the paper too."""
    return not guided.is_none and guided.read_force > 0


def edge_lines(guided: Guided, say: Notation) -> list[str]:
    """Return what acts at the edges of a slider that does not reach as far as the resultant."""
    if not _is_read(guided):
        return _pair(guided, say)
    force = guided.read_force
    return _edges(guided.own, force, guided.read_moment / force, say)


def _lines(guided: Guided, say: Notation) -> list[str]:
    if not _is_read(guided):
        return edge_lines(guided, say)
    moment, force = guided.read_moment, guided.read_force
    letters = f"{guided.own.symbol('l')} = {guided.symbol('M')}/{guided.symbol('F')}"
    numbers = f"{say.found(moment)}/{say.found(force)}"
    first = f"{letters} = {numbers} = {say.found(moment / force)} {say.units['m']}"
    return [first, *edge_lines(guided, say)]


def _pair(guided: Guided, say: Notation) -> list[str]:
    """Return the couple that is left of a reaction without a force."""
    length = guided.contact.length
    if length is None or not guided.edges:
        return []
    names = " = ".join(guided.own.symbol("F", primes) for primes in ("'", "''"))
    size = guided.read_moment / length
    formula = f"{guided.symbol('M')}/{guided.own.symbol('a')}"
    numbers = f"{say.found(guided.read_moment)}/{say.short(length)}"
    return [f"{names} = {formula} = {numbers} = {say.found(size)} {say.units['N']}"]


def _edges(guided: Guided, force: float, distance: float, say: Notation) -> list[str]:
    """Return what acts at the edges of a slider that does not reach as far as the resultant."""
    length = guided.contact.length
    if length is None or not guided.edges or not guided.centred or distance <= length / 2:
        return []
    arm, a, f = (guided.symbol(letter) for letter in "laF")
    half = say.short(length / 2)
    lines = [f"{arm} > {a}/2 = {half} {say.units['m']}"]
    stronger = abs(guided.edges[0].force) > abs(guided.edges[1].force)
    for primes, is_near in (("'", stronger), ("''", not stronger)):
        sign = "+" if is_near else "−"
        size = force * (distance + (length if is_near else -length) / 2) / length
        numbers = f"{say.found(force)}·({say.found(distance)} {sign} {half})/{say.short(length)}"
        formula = f"{f}·({arm} {sign} {a}/2)/{a}"
        name = guided.symbol("F", primes)
        lines.append(f"{name} = {formula} = {numbers} = {say.found(size)} {say.units['N']}")
    return lines
