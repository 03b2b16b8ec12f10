"""A solved mechanism for a program: its results as columns, its forces, its sheet."""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any
from warnings import warn

import numpy as np
import numpy.typing as npt
from msgspec.structs import replace

from planmethod.arguments import chosen
from planmethod.construct.arithmetic import Float64
from planmethod.construct.drafting import Profile
from planmethod.errors import DoubtWarning
from planmethod.languages import LANGUAGES
from planmethod.problem.model import Problem
from planmethod.problem.records import Dynamics, in_language
from planmethod.solved.failures import failing
from planmethod.solved.forces.springs import SpringState, spring_states
from planmethod.solved.many.columns import data_frame, swept_columns
from planmethod.solved.reading import Flags, Reading, Reals
from planmethod.solved.selfcheck import judged_statics, warn_of_doubts
from planmethod.solved.solution import Solution as SolvedProblem

if TYPE_CHECKING:
    from planmethod.render.backends.sheet import Sheet
    from planmethod.solved.centres import Centres
    from planmethod.solved.forces.statics import Statics

MAX_DRAWN = 12
"""Most positions of a solution that its sheet shows; of more it shows those of the mechanism."""


_UNLOADED = "the mechanism has neither masses nor loads, so all its forces are zero"


class Solution(SolvedProblem):
    """Solved mechanism (решённый механизм): motion, forces and sheet in some positions.

    Parameters
    ----------
    problem : Problem
    positions : array_like of shape (n,), optional
        Degrees, or m of a driving slider. Default: those of the file.
    partial : bool
        Results are NaN in positions that cannot be assembled, instead of an error.
    **settings
        ``ruler`` (mm), ``profile`` (``cad``, ``board``, ``coarse``): accuracy of the drawing.

    Examples
    --------
    >>> import planmethod
    >>> solution = planmethod.solve(planmethod.load("problems/linkages/ex3.toml"))
    >>> solution
    Solution(ex3: 1 position, I(0,1) → II(2,3) → II(4,5))
    >>> solution.to_columns(["v_E", "omega_3"])["v_E"].round(4)
    array([3.9157])
    """

    def __init__(
        self,
        problem: Problem,
        *,
        positions: npt.ArrayLike | None = None,
        partial: bool = False,
        **settings: Any,
    ) -> None:
        super().__init__(problem, positions=positions, **settings)
        self.partial = partial

    def _new_solution(self, **settings: Any) -> Solution:
        return Solution(**settings, partial=self.partial)

    def __repr__(self) -> str:
        count = len(self.positions)
        name, formula = self.problem.name, self.structure.formula
        return f"Solution({name}: {count} position{'s' * (count != 1)}, {formula})"

    @cached_property
    def si(self) -> Reading:
        """Exact reading at unit scales; with ``partial`` NaN where a step is impossible."""
        return self.read(Float64()) if self.partial else super().si

    @cached_property
    def exists(self) -> Flags:
        """True in the positions that can be assembled, shape (n,)."""
        reading = self.read(Float64())
        return failing(self.construction.program, reading.trace, len(self.positions)) < 0

    @property
    def index(self) -> tuple[str, Reals]:
        """Name and values of the driver's coordinate, by which tables are indexed."""
        return self.problem.drive.coordinate.column, self.positions

    def to_columns(self, names: Iterable[str] | None = None) -> dict[str, Reals]:
        """Return results by name, SI and degrees, ndarrays of shape (n,).

        Parameters
        ----------
        names : iterable of str, optional
            ``omega_3``, ``phi_3``, the size of a vector ``v_E``, a component ``vx_E``, ``x_E``,
            ``u_31``, ``F_B_2/1``, ``M_dr``, or any other spelling; a column has the name by which
            it is requested. Default: everything of the motion.

        Raises
        ------
        UnknownQuantityError
        """
        return swept_columns(self.problem, self.positions, names)

    def to_frame(self, names: Iterable[str] | None = None) -> Any:
        """Return the same as a table of pandas, by the driver's position.

        Raises
        ------
        OutputError
            pandas is not installed.
        """
        return data_frame(self.to_columns(names), self.index)

    def forces(self) -> Forces:
        """Return the forces in the positions.

        Warns
        -----
        DoubtWarning
            The mechanism has neither masses nor loads: all forces are zero.
        """
        return Forces(self)

    def instant_centres(self, index: int = 0) -> Centres:
        """Return the instant centres of all links in one position, and the motions by them.

        Parameters
        ----------
        index : int
            Number of the position.

        Returns
        -------
        Centres
            `Centres.of` gives a centre by its two links (``"0"`` is the frame): ``at``, m, or the
            direction ``towards`` of one at infinity, and how it is found. ``motions`` are those of
            the links.

        Raises
        ------
        ArgumentError
            The position does not exist.

        Examples
        --------
        >>> import planmethod
        >>> solution = planmethod.solve(planmethod.load("problems/linkages/ex3.toml"))
        >>> centres = solution.instant_centres()
        >>> centres
        Centres(links 0, 1, 2, 3, 4, 5: 15 centres)
        >>> rod = centres.of("0", "4")
        >>> f"{rod.at:.4f}", rod.by
        ('0.2471+0.4318j', ('3', '5'))
        >>> f"{centres.motions['4'].omega:.3f} = {solution.links['4'].omega[0]:.3f} 1/s"
        '-9.068 = -9.068 1/s'
        """
        from planmethod.solved.centres import find_centres

        return find_centres(self, index)

    def sheet(
        self,
        *,
        lang: str | None = None,
        paper: str | None = None,
        layout: str | Path | None = None,
        fields: Mapping[str, str] | None = None,
    ) -> Sheet:
        """Draw the sheet.

        It has the positions of the solution; of a solution with more than 12 those of the
        mechanism.

        Parameters
        ----------
        lang : str, optional
            ``ru`` or ``en``. Default: that of the file.
        paper, layout, fields
            As of `planmethod.draw`.

        Raises
        ------
        LayoutError
            The content does not fit.
        """
        from planmethod.render.backends.sheet import Sheet
        from planmethod.render.sheets.kinematics import kinematics_sheets

        problem = self.problem
        if lang is not None:
            problem = in_language(problem, chosen("lang", lang, LANGUAGES))
        own = self.positions.tolist()
        drawn = own if len(own) <= MAX_DRAWN and tuple(own) != problem.drive.positions else None
        return Sheet(
            kinematics_sheets(
                problem,
                paper=paper,
                positions=drawn,
                profile=self.profile,
                fields=fields,
                layout=layout,
            )
        )


class Forces:
    """Forces of a solution in its positions (силы).

    Attributes
    ----------
    solution : Solution
    statics : Statics
        The force plans, the lever, the readings with a ruler.

    Examples
    --------
    >>> import planmethod
    >>> forces = planmethod.solve(planmethod.load("problems/linkages/triad.toml")).forces()
    >>> forces["M_dr"].round(2)
    array([14.65])
    """

    def __init__(self, solution: Solution) -> None:
        problem = solution.problem
        if problem.dynamics is None:
            warn(f"{problem.name}: {_UNLOADED}", DoubtWarning, stacklevel=3)
            problem = replace(problem, dynamics=Dynamics(gravity=0.0, masses={}, loads=()))
            solution = Solution(problem, positions=solution.positions, partial=solution.partial)
        self.solution = solution
        found = swept_columns(problem, solution.positions, None, forces=True)
        self._columns = {name: own + 0.0 for name, own in found.items()}  # no negative zeros

    @cached_property
    def statics(self) -> Statics:
        """The force plans, by `planmethod.statics`."""
        return judged_statics(self.solution)

    def __repr__(self) -> str:
        return f"Forces({self.solution.problem.name}: {', '.join(self._columns)})"

    def __getitem__(self, name: str) -> Reals:
        """Return a force by name, N or N·m, ndarray of shape (n,)."""
        (column,) = self.to_columns([name]).values()
        return column

    @property
    def springs(self) -> dict[str, SpringState]:
        """Springs by name: ``size`` (m, degrees), ``rate``, ``force`` (N, N·m), shape (n,)."""
        return {state.spring.name: state for state in spring_states(self.solution)}

    def to_columns(self, names: Iterable[str] | None = None) -> dict[str, Reals]:
        """Return forces by name, N and N·m, ndarrays of shape (n,).

        ``F_B_2/1`` is the size of the force in B on link 2 from link 1, ``Fx_B_2/1`` its component,
        ``M_E_5/0`` the moment in a prismatic joint, ``M_dr`` the balancing moment, ``M_lever`` the
        same by the lever (``F_dr``, ``F_lever`` of a driving slider).
        """
        if names is None:
            return dict(self._columns)
        return swept_columns(self.solution.problem, self.solution.positions, names)

    def to_frame(self, names: Iterable[str] | None = None) -> Any:
        """Return the same as a table of pandas, by the driver's position.

        Raises
        ------
        OutputError
            pandas is not installed.
        """
        return data_frame(self.to_columns(names), self.solution.index)


def solve(
    problem: Problem,
    *,
    positions: npt.ArrayLike | None = None,
    ruler: float | None = None,
    profile: Profile | str = "board",
    partial: bool = False,
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
    partial : bool
        Results are NaN in positions that cannot be assembled, instead of an error.

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
    solution = Solution(problem, positions=positions, ruler=ruler, profile=profile, partial=partial)
    able = solution.exists if partial and len(solution.positions) else np.array([True])
    if able.all():
        warn_of_doubts(solution)
    elif able.any():
        warn_of_doubts(solution.with_positions(solution.positions[able]))
    return solution
