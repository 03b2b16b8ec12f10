"""Mistakes with springs and dampers, as rewritten steps of their law (ошибки с пружинами)."""

from __future__ import annotations

from collections.abc import Iterator
from math import pi

from msgspec.structs import replace

from planmethod.check.mistakes.plans import Change, MistakeContext, known, times
from planmethod.check.springs import DrawnSpring
from planmethod.construct.steps import Compute, Name, NumberName, Step, Total

OFTEN = 2.0
"""Prior of mistakes with springs that every group makes."""


def _springs(scene: MistakeContext) -> Iterator[DrawnSpring]:
    """Yield the springs whose force the sheet needs."""
    for one in scene.sheet.questions.springs.springs:
        if one.force.out in scene.steps_by_name:
            yield one


def _product(scene: MistakeContext, name: NumberName | None) -> Compute | None:
    """Return a part of the force of a spring, if it is not zero."""
    step = scene.compute(name)
    return step if step is not None and scene.exact_value(step.out) else None


def force_reversed(scene: MistakeContext) -> Iterator[Change]:
    """F7: a stretched spring pushes and a compressed one pulls: on its links, or in its law."""
    for one in _springs(scene):
        every: dict[Name, tuple[Step, ...]] = {}
        for name in one.loads:
            if (step := scene.compute(name)) is not None:
                every[name] = times(step, -1.0)
        if every:
            yield Change("F7", one.symbol, every, prior=OFTEN)
        elastic = _product(scene, one.elastic)
        if elastic is not None and len(one.force.terms) > 1:
            yield Change("F7", one.symbol, {elastic.out: times(elastic, -1.0)}, prior=OFTEN)


def rest_forgotten(scene: MistakeContext) -> Iterator[Change]:
    """F8: stiffness times the whole length or angle; the preload left out, or alone."""
    for one in _springs(scene):
        if one.elastic is None:
            continue
        changed: dict[Name, tuple[Step, ...]]
        if one.spring.preload is None and one.rest:
            name, given = known(f"{one.deflection.out} of rest")
            whole = replace(one.deflection, terms=(*one.deflection.terms, name))
            changed = {one.deflection.out: (given, whole)}
            yield Change("F8", one.symbol, changed, {name: one.rest}, prior=OFTEN)
        elif one.spring.preload:
            for left in (one.force.terms[-1], one.elastic):
                changed = {one.force.out: (_without(one.force, left),)}
                yield Change("F8", one.symbol, changed, prior=OFTEN)


def _without(force: Total, name: NumberName) -> Total:
    return replace(force, terms=tuple(term for term in force.terms if term != name))


def damping_wrong(scene: MistakeContext) -> Iterator[Change]:
    """F9: the damping left out, or with the motion."""
    for one in _springs(scene):
        step = _product(scene, one.damped)
        if step is not None:
            for factor in (0.0, -1.0):
                yield Change("F9", one.symbol, {step.out: times(step, factor)})


def spring_units(scene: MistakeContext) -> Iterator[Change]:
    """S2: stiffness times millimetres, or times degrees."""
    for one in _springs(scene):
        step = _product(scene, one.elastic)
        if step is not None:
            factor = 180.0 / pi if one.spring.is_torsion else 1000.0
            yield Change("S2", one.symbol, {step.out: times(step, factor)})


SPRING_MISTAKES = (force_reversed, rest_forgotten, damping_wrong, spring_units)
