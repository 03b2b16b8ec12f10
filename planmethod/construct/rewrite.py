"""Programs changed: values put in, steps rewritten (подстановка значений, замена шагов).

With a person's own values, a program gives the results that follow from them along the
construction. With a step rewritten, it gives the results of a certain mistake.
"""

# no messages: mistakes in a program

from __future__ import annotations

from collections.abc import Callable, Iterable

from planmethod.construct.program import Program
from planmethod.construct.steps import (
    GivenNumber,
    GivenPoint,
    Name,
    NumberName,
    PointName,
    Step,
    result_kind,
)
from planmethod.errors import ProgramError


def substituted(program: Program, names: Iterable[Name]) -> Program:
    """Return a program in which some points and numbers are given instead of made.

    Their values are then data of the program, beside its own: points in mm, numbers in their unit.

    Raises
    ------
    ProgramError
        No step makes a name, or the step makes a line: a line is determined by its points.
    """
    given = set(names)
    unknown = given - {step.out for step in program.steps}
    if unknown:
        raise ProgramError(f"no step makes {', '.join(sorted(unknown))}")

    def change(step: Step) -> Step:
        if step.out not in given:
            return step
        if result_kind(step) is PointName:
            return GivenPoint(PointName(step.out))
        if result_kind(step) is NumberName:
            return GivenNumber(NumberName(step.out))
        raise ProgramError(f"{step.out} is a line: give a point of it, or a number")

    return rewritten(program, change)


def rewritten(program: Program, change: Callable[[Step], Step | tuple[Step, ...]]) -> Program:
    """Return a program with every step changed or kept.

    Parameters
    ----------
    change : callable
        Takes a step and returns its replacement: the same step, or another one that makes the same
        name of the same kind from earlier results; or several, the last of which does.

    Raises
    ------
    ProgramError
        A step makes another name or kind than the one it replaces, or uses a name that is made
        later.
    """
    steps: list[Step] = []
    for before in program.steps:
        changed = change(before)
        several = changed if isinstance(changed, tuple) else (changed,)
        after = several[-1]
        if (after.out, result_kind(after)) != (before.out, result_kind(before)):
            raise ProgramError(f"{after.out} cannot replace {before.out}")
        steps.extend(several)
    return Program(tuple(steps))
