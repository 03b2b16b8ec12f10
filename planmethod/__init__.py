"""The graphical plan method of the theory of mechanisms (метод планов).

Public names: `load` and `loads` read a problem file, `solve` computes it, `Sweep` computes many
positions of it, `draw` makes its sheets, `document` describes its construction. They are imported
on first use (PEP 562): Python imports this package before any of its modules, and a command that
needs none of these, or only one, would wait a quarter of a second for NumPy, the sheets and their
dependencies.
"""

# no messages: for programs in Python

from __future__ import annotations

TYPE_CHECKING = False  # not of typing: its import is a tenth of the way to the command line
if TYPE_CHECKING:
    from planmethod.linkages.reading import load as load, loads as loads
    from planmethod.note.protocol import document_of as document
    from planmethod.problem import Problem as Problem
    from planmethod.render.sheets.kinematics import kinematics_sheets as draw
    from planmethod.solved.errors.motion import drafting_of as drafting
    from planmethod.solved.many.sweep import Sweep as Sweep
    from planmethod.solved.selfcheck import judged_statics as statics
    from planmethod.solved.solution import Solution as Solution

if TYPE_CHECKING:
    from typing import Any

    import numpy.typing as npt

    from planmethod.construct.drafting import Profile

__all__ = [
    "Problem",
    "Solution",
    "Sweep",
    "document",
    "drafting",
    "draw",
    "load",
    "loads",
    "solve",
    "statics",
]

_HOMES = {
    "Problem": "planmethod.problem:Problem",
    "Solution": "planmethod.solved.solution:Solution",
    "Sweep": "planmethod.solved.many.sweep:Sweep",
    "document": "planmethod.note.protocol:document_of",
    "drafting": "planmethod.solved.errors.motion:drafting_of",
    "draw": "planmethod.render.sheets.kinematics:kinematics_sheets",
    "load": "planmethod.linkages.reading:load",
    "loads": "planmethod.linkages.reading:loads",
    "statics": "planmethod.solved.selfcheck:judged_statics",
}
"""Locations of the public names; a test compares them with those under `TYPE_CHECKING`."""


def solve(
    problem: Problem,
    *,
    positions: npt.ArrayLike | None = None,
    ruler: float | None = None,
    profile: Profile | str = "board",
) -> Solution:
    """Solve a problem, in the file's positions or in others (degrees, m for a slider).

    Parameters
    ----------
    positions : array_like of shape (n,), optional
        Other positions than the file's; they are copied.
    ruler : float, mm, optional
        Step of the ruler with which the plans are read. Default: the profile's.
    profile : str or Profile
        Accuracy of the drawing: ``cad``, ``board`` or ``coarse``.

    Raises
    ------
    ArgumentError
        An argument has a value that this function does not accept.
    PlanMethodError
        The mechanism cannot be analysed, or cannot be assembled in one of the positions.

    Warns
    -----
    DoubtWarning
        As `planmethod solve` does: few digits are left, a change point is between two
        positions, a number of the file is unlikely.

    Examples
    --------
    >>> import planmethod
    >>> solution = planmethod.solve(planmethod.load("problems/linkages/ex3.toml"))
    >>> print(f"{abs(solution.points['E'].velocity[0]):.4f} m/s")
    3.9157 m/s
    >>> turn = planmethod.solve(solution.problem, positions=range(0, 360, 30))
    >>> print(f"{turn.links['3'].omega.min():.3f} to {turn.links['3'].omega.max():.3f} 1/s")
    -69.565 to 18.391 1/s
    """
    from planmethod.solved.selfcheck import warn_of_doubts
    from planmethod.solved.solution import Solution

    solution = Solution(problem, positions=positions, ruler=ruler, profile=profile)
    warn_of_doubts(solution)
    return solution


if not TYPE_CHECKING:  # type checkers see the imports above

    def __getattr__(name: str) -> Any:
        """Import a public name on first use."""
        if name not in _HOMES:
            raise AttributeError(f"module 'planmethod' has no attribute {name!r}")
        from pkgutil import resolve_name

        return resolve_name(_HOMES[name])
