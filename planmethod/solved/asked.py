"""The results among which what is asked for is: forces are planned only where they are needed."""

from __future__ import annotations

from collections.abc import Iterable

from planmethod.plans.legend import QuantityKind
from planmethod.solved.results import Results, UnknownResultError, results_of
from planmethod.solved.solution import Solution


def results_for(
    solution: Solution, asked: Iterable[str] | None, *, forces: bool = False
) -> Results:
    """Return the results among which the asked ones are: forces are planned only where needed.

    Parameters
    ----------
    asked : iterable of str, optional
        Labels; everything of the motion when absent.
    forces : bool
        Where nothing is asked by name: everything of the forces, too.

    Raises
    ------
    UnknownResultError
        A force is asked of a problem without masses and loads.
    """
    results = results_of(solution.construction)
    other = () if asked is None else [label for label in asked if not results.find(label)]
    if not (other or (forces and asked is None)):
        return results
    if solution.problem.dynamics is not None:
        from planmethod.solved.forces.results import with_forces

        return with_forces(solution, results)
    letters = {kind.letter for kind in QuantityKind if kind.is_force}
    for label in other:
        if label == "forces" or label.partition("_")[0] in letters:
            raise UnknownResultError(
                "no result {!r}: the problem has no loads. Give the masses in [dynamics] and "
                "the loads in [[loads]].",
                label,
            )
    return results
