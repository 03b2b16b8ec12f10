"""Mistakes with loads, moments, reactions and the lever, as rewritten steps (ошибки в силах).

A load may be wrong everywhere, or in one equation of moments, one force plan, or on the lever.
"""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from planmethod.check.mistakes.plans import Change, MistakeContext, times
from planmethod.check.sheet import single_point
from planmethod.construct import steps
from planmethod.construct.steps import LineName, Name, NumberName, Step
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import GivenLoad
from planmethod.plans.forces.polygons import LoadKind, reaction_symbol
from planmethod.plans.model import FACTS, PlanKind


def _loads(scene: MistakeContext, kind: LoadKind) -> Iterator[GivenLoad]:
    if scene.board is not None:
        yield from (given for given in scene.board.given if given.applied.kind is kind)


def inertia_along(scene: MistakeContext) -> Iterator[Change]:
    """F1: Φ along the acceleration: of one link, of all."""
    every: dict[Name, tuple[Step, ...]] = {}
    for given in _loads(scene, LoadKind.INERTIA):
        assert given.force is not None
        carry = scene.steps_by_name.get(given.force.head)
        if isinstance(carry, steps.Carry):
            every[carry.out] = (replace(carry, tail=carry.head, head=carry.tail),)
            yield Change("F1", given.applied.link, {carry.out: every[carry.out]})
    if len(every) > 1:
        yield Change("F1", "", every, prior=2.0)


def inertia_couple_wrong(scene: MistakeContext) -> Iterator[Change]:
    """F2: the couple of inertia with the sense of ε, or forgotten: of one link, of all."""
    for factor in (-1.0, 0.0):
        every: dict[Name, tuple[Step, ...]] = {}
        for given in _loads(scene, LoadKind.INERTIA_COUPLE):
            step = scene.compute(given.couple)
            if step is not None:
                every[step.out] = times(step, factor)
                yield Change("F2", given.applied.link, {step.out: every[step.out]})
        if len(every) > 1:
            yield Change("F2", "", every, prior=2.0)


def weight_wrong(scene: MistakeContext) -> Iterator[Change]:
    """F3: weights forgotten, or mass taken for weight: of one link, of all."""
    found: list[tuple[str, steps.Compute]] = []
    for given in _loads(scene, LoadKind.WEIGHT):
        assert given.force is not None and scene.board is not None
        step = scene.compute(scene.board.segments.values.get(given.force.ends))
        if step is not None:
            found.append((given.applied.link, step))
    for made in (lambda step: times(step, 0.0), _without_g):
        every: dict[Name, tuple[Step, ...]] = {step.out: made(step) for _, step in found}
        for link, step in found:
            yield Change("F3", link, {step.out: made(step)})
        if len(found) > 1:
            yield Change("F3", "", every, prior=2.0)


def _without_g(step: steps.Compute) -> tuple[Step, ...]:
    return (replace(step, powers=step.powers[:1]),)


def arm_along(scene: MistakeContext) -> Iterator[Change]:
    """F4: an arm measured along the force in place of across."""
    for step in scene.steps:
        if isinstance(step, steps.MeasureArm):
            line = LineName(f"{step.out} line")
            if abs(_distance_along(scene, step)) < NO_ARM * abs(scene.exact_value(step.out)):
                continue  # the moment is left out
            along = steps.MeasureAlong(step.out, step.about, step.at, line)
            yield Change("F4", "", {step.out: (steps.Join(line, step.tail, step.head), along)})


NO_ARM = 1e-6
"""Share of an arm below which the distance along the force is none at all."""


def _distance_along(scene: MistakeContext, step: steps.MeasureArm) -> float:
    """Return the distance between an arm's ends along the force, mm."""
    about, at, tail, head = (
        single_point(scene.sheet.exact_trace.value[name])
        for name in (step.about, step.at, step.tail, step.head)
    )
    size = abs(head - tail)
    return ((at - about) * (head - tail).conjugate()).real / size if size else 0.0


def moments_in_mm(scene: MistakeContext) -> Iterator[Change]:
    """F4: arms in mm, or as drawn without μ_l: in one equation of moments, in all."""
    mu_l = NumberName(FACTS[PlanKind.POSITION].scale)
    each = [[*_products(scene, total, mu_l)] for total, _ in _sums(scene)]
    every = {step.out: step for own in each for step in own}
    for products in ([*every.values()], *(own for own in each if 0 < len(own) < len(every))):
        for factor in (1000.0, 1.0 / scene.exact_value(mu_l)) if products else ():
            yield Change("F4", "", {step.out: times(step, factor) for step in products})


def _products(
    scene: MistakeContext, total: steps.Total, scale: NumberName
) -> Iterator[steps.Compute]:
    """Yield the moments of a sum whose arms are read to a scale."""
    for name in total.terms:
        step = scene.compute(name)
        if step is not None and (scale, 1) in step.powers:
            yield step


LEFT_OUT = {LoadKind.WEIGHT: "F3", LoadKind.INERTIA_COUPLE: "F2"}
"""Codes of loads that are left out; of others F6."""

IN_ONE_PLACE = 1.0
"""Prior of a load that is wrong in one equation or plan only."""

Terms = dict[NumberName, tuple[str, str]]
"""Code of a load if it is left out, and its link or symbol, by a number."""


def _loads_by_number(scene: MistakeContext) -> Terms:
    """Return the loads and reactions by their sizes and couples."""
    found: Terms = {}
    if scene.board is None:
        return found
    for reaction in scene.board.reactions:
        symbol = reaction.force.symbol
        found[scene.board.segments.known(reaction.force.ends)] = "F6", symbol
        if reaction.couple is not None:
            found[reaction.couple] = "F6", symbol
    for given in scene.board.given:
        number = given.couple
        if given.force is not None:
            number = scene.board.segments.known(given.force.ends)
        if number is not None:
            code = LEFT_OUT.get(given.applied.kind, "F6")
            found[number] = code, given.applied.name if code == "F6" else given.applied.link
    return found


def _sums(scene: MistakeContext) -> Iterator[tuple[steps.Total, Terms]]:
    """Yield the sums of moments, about points and on the lever, with the loads of their terms."""
    loads = _loads_by_number(scene)
    for total in scene.steps if loads else ():
        if isinstance(total, steps.Total):
            terms: Terms = {}
            for term in total.terms:
                product = scene.compute(term)
                factors = [term, *(name for name, _ in product.powers)] if product else [term]
                terms.update((term, loads[name]) for name in factors if name in loads)
            yield total, terms


def moment_wrong(scene: MistakeContext) -> Iterator[Change]:
    """F2, F3, F6: a load left out of one sum of moments, or with the other sense there."""
    for total, terms in _sums(scene):
        for term, (code, symbol) in terms.items():
            others = tuple(name for name in total.terms if name != term)
            if others:
                left = replace(total, terms=others)
                yield Change(code, symbol, {total.out: (left,)}, prior=IN_ONE_PLACE)
            back = NumberName(f"{total.out} {term}")
            made = steps.Compute(back, -1.0, ((term, 1),)), replace(total, terms=(*others, back))
            if len(total.terms) > 1:
                code = "F2" if code == "F2" else "F6"
                yield Change(code, symbol, {total.out: made}, prior=IN_ONE_PLACE)


def load_not_in_plan(scene: MistakeContext) -> Iterator[Change]:
    """F2, F3, F6: a load left out of the force plan of a group, or with the other sense there."""
    board, loads = scene.board, _loads_by_number(scene)
    for plan in () if board is None else board.plans:
        for edge in plan.polygon:
            assert board is not None
            code, symbol = loads.get(board.segments.known(edge.ends), ("", ""))
            for end in edge.ends:
                step = scene.steps_by_name.get(end)
                if code and isinstance(step, steps.Carry) and step.origin in edge.ends:
                    none = steps.Carry(step.out, step.origin, step.origin, step.origin)
                    back = replace(step, tail=step.head, head=step.tail)
                    for code_of, made in ((code, none), ("F6", back)):
                        where: dict[Name, tuple[Step, ...]] = {step.out: (made,)}
                        yield Change(code_of, symbol, where, prior=IN_ONE_PLACE)


def load_reversed(scene: MistakeContext) -> Iterator[Change]:
    """F6: an external load with the other sense everywhere."""
    for given in _loads(scene, LoadKind.EXTERNAL):
        step = scene.compute(None if given.force is None else _find_length(scene, given))
        if step is not None:
            yield Change("F6", given.applied.name, {step.out: times(step, -1.0)})


def _find_length(scene: MistakeContext, load: GivenLoad) -> NumberName | None:
    """Return the length that a force of a known direction is laid off by."""
    step = None if load.force is None else scene.steps_by_name.get(load.force.head)
    return step.length if isinstance(step, steps.LayOffLength) else None


def masses_in_grams(scene: MistakeContext) -> Iterator[Change]:
    """S2: masses in grams."""
    masses: dict[str, float] = {
        name: 1000.0 * scene.exact_value(name)
        for kind in (LoadKind.WEIGHT, LoadKind.INERTIA)
        for given in _loads(scene, kind)
        for name, letter in given.letters.items()
        if letter.startswith("m_") and name in scene.steps_by_name
    }
    if masses:
        yield Change("S2", "m", data=masses)


def tangential_reversed(scene: MistakeContext) -> Iterator[Change]:
    """F5: R^τ of an equation of moments laid off in the other sense."""
    for plan in () if scene.board is None else scene.board.plans:
        for moments in plan.moments:
            if moments.force is not None and scene.board is not None:
                step = scene.compute(scene.board.segments.known(moments.force.ends))
                if step is not None:
                    yield Change("F5", moments.force.symbol, {step.out: times(step, -1.0)})


def reaction_not_reversed(scene: MistakeContext) -> Iterator[Change]:
    """F5: what acts on the next link with the sense that it has on this one."""
    if scene.board is None:
        return
    for reaction in scene.board.reactions:
        if reaction.by == FRAME:
            continue
        tail, head = reaction.force.ends
        changed: dict[Name, tuple[Step, ...]] = {}
        for step in scene.steps:
            if isinstance(step, steps.Carry | steps.MeasureArm) and (step.tail, step.head) == (
                head,
                tail,
            ):
                changed[step.out] = (replace(step, tail=tail, head=head),)
        if changed:
            yield Change("F5", reaction_symbol(reaction.by, reaction.on), changed)


def lever_not_turned(scene: MistakeContext) -> Iterator[Change]:
    """Z1: forces on the velocity plan that was not turned."""
    changed: dict[Name, tuple[Step, ...]] = {
        step.out: (replace(step, rotated=False),)
        for step in scene.steps
        if isinstance(step, steps.Carry) and step.rotated
    }
    if changed:
        yield Change("Z1", "", changed)


def _couples_on_lever(scene: MistakeContext) -> Iterator[steps.Compute]:
    """Yield the powers of couples, M·ω, on the lever."""
    couples = {given.couple for given in (scene.board.given if scene.board else ()) if given.couple}
    for step in scene.steps:
        if isinstance(step, steps.Compute) and len(step.powers) == 2:
            (one, _), (two, power) = step.powers
            if one in couples and two in scene.rates and power == 1:
                yield step


def lever_by_segments(scene: MistakeContext) -> dict[Name, tuple[Step, ...]]:
    """Return the lever whose couples are multiplied by ab/l, and the crank by its own segment."""
    changed: dict[Name, tuple[Step, ...]] = {}
    for step in _couples_on_lever(scene):
        couple, (rate, _) = step.powers
        read = scene.compute(rate)
        value = None if read is None else scene.compute(read.powers[0][0])
        if read is not None and value is not None:
            powers = (couple, *value.powers, *read.powers[1:])
            factor = step.factor * read.factor * value.factor
            changed[step.out] = (steps.Compute(step.out, factor, powers),)
    whole = scene.sheet.questions.statics
    lever = None if whole is None or whole.lever_plan is None else whole.lever_plan.balance
    last, crank = scene.compute(lever), next(scene.crank_products(1), None)
    if last is not None and crank is not None and (crank.powers[0][0], -1) in last.powers:
        powers = (last.powers[0], (crank.out, -1), *crank.powers[1:])
        changed[last.out] = (steps.Compute(last.out, last.factor * crank.factor, powers),)
    return changed


def couple_not_converted(scene: MistakeContext) -> Iterator[Change]:
    """Z2: a couple on the lever as it is, without (bc)/l."""
    mu_v = NumberName(FACTS[PlanKind.VELOCITY].scale)
    changed: dict[Name, tuple[Step, ...]] = {
        step.out: (replace(step, powers=(step.powers[0], (mu_v, 1))),)
        for step in _couples_on_lever(scene)
        if mu_v in scene.steps_by_name
    }
    if changed:
        yield Change("Z2", "", changed)


FORCE_MISTAKES = (
    inertia_along,
    inertia_couple_wrong,
    weight_wrong,
    arm_along,
    moments_in_mm,
    moment_wrong,
    load_not_in_plan,
    load_reversed,
    masses_in_grams,
    tangential_reversed,
    reaction_not_reversed,
    lever_not_turned,
    couple_not_converted,
)
