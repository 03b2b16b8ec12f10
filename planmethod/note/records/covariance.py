"""Drafting errors together: the covariance matrix as a spreadsheet (ковариационная матрица)."""

from __future__ import annotations

import csv
import io

from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.errors.spread import Errors
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.solution import Solution


def _errors(solution: Solution) -> Errors:
    if solution.problem.dynamics is None:
        return drafting_of(solution)
    from planmethod.solved.errors.forces import all_errors

    return all_errors(statics_of(solution))


def covariance_text(solutions: list[Solution]) -> str:
    """Return the covariance of every pair of quantities, as CSV.

    A row for each quantity of each position: problem, variant, position (from 0), quantity, its
    sigma, and its covariance with every quantity in the order of the header. Quantities are in SI
    units, segments (``velocity.p-b``) in millimetres of the plan, directions of reactions in
    degrees; all to first order. Forces are there for a problem with ``[dynamics]``.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    before: list[str] | None = None
    for solution in solutions:
        errors = _errors(solution)
        labels = list(errors.items)
        header = ["problem", "variant", "position", "quantity", "sigma", *labels]
        if header != before:
            writer.writerow(header)
        before = header
        problem = solution.problem
        for i in range(len(solution.positions)):
            matrix = errors.covariance(labels, i)
            for k, label in enumerate(labels):
                sigma = float(matrix[k, k]) ** 0.5
                told = [problem.name, problem.variant or "", i, label, sigma]
                writer.writerow([*told, *matrix[k].tolist()])
    return text.getvalue()
