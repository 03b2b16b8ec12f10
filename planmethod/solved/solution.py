"""A solved problem: numeric readings of its plans, each made on request."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cached_property
from math import inf, isfinite, lcm
from types import MappingProxyType
from typing import Any, assert_never

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.arguments import (
    Named,
    above_zero,
    chosen,
    describe,
    known,
    number_of,
    numbers,
    of_type,
)
from planmethod.construct.arithmetic import Arithmetic, Float64, Number
from planmethod.construct.drafting import PROFILES, Profile, RulerArithmetic
from planmethod.construct.evaluate import evaluate
from planmethod.construct.scale import Scale
from planmethod.construct.steps import LineName, NumberName, PointName
from planmethod.errors import ArgumentError
from planmethod.mechanism.structure import Structure
from planmethod.plans.build import Construction, Quantity
from planmethod.plans.model import RATES, PlanKind, assembly_period
from planmethod.plans.motion.legs import Relative
from planmethod.problem.model import Problem, Scales
from planmethod.problem.quantities import Measure, QuantityKind
from planmethod.solved.assembly_modes import construct, drive_data, reject_ambiguous
from planmethod.solved.extents import Extents, median
from planmethod.solved.failures import PositionError, explain, failing
from planmethod.solved.legibility import (
    DetailView,
    find_detail_views,
    is_read,
    lengths_on,
    min_enlarged,
    small_plans,
)
from planmethod.solved.reading import (
    Complexes,
    Memoizing,
    Reading,
    Reals,
    driven,
    fixed,
    other_place,
)
from planmethod.solved.scaling import MAX_DRAWN, choose_scales, decide, per_plan_scales
from planmethod.solved.view_space import Views

UNIT_SCALES: Mapping[str, float] = MappingProxyType({"mu_l": 1.0, "mu_v": 1.0, "mu_a": 1.0})
"""Scales at which a millimetre of a plan is a metre, a metre per second, one per second squared."""

EVERY = slice(None)

FEW_ROWS = 64
"""Number of positions up to which data are expanded to columns, as for variants read together."""


def at_positions(
    values: Mapping[str, Number], chosen: npt.NDArray[np.intp] | slice
) -> dict[str, Number]:
    """Return values of some positions: of columns, shape (n,), those, of single numbers all."""
    return {name: value[chosen] if np.ndim(value) else value for name, value in values.items()}


def filled(values: Mapping[str, Number], count: int) -> dict[str, Any]:
    """Return values as columns of ``count`` positions.

    As for variants that are read together (`planmethod.solved.many.variants`), to the last bit:
    NumPy multiplies a column by one complex number in another way than by a column.
    """
    return {name: np.full(count, value) for name, value in values.items()}


def unit_rate_problem(problem: Problem) -> Problem:
    """Return a problem without loads, its driver at one radian (or metre) a second.

    Other driving links keep their rates related to it.
    """
    rate = problem.drive.rate
    others = tuple(
        replace(one, rate=one.rate / rate if rate else 0.0, acceleration=0.0)
        for one in problem.drive.other_drives
    )
    drive = replace(problem.drive, rate=1.0, acceleration=0.0, other_drives=others)
    return replace(problem, drive=drive, dynamics=None)


class PointMotion(Struct, frozen=True):
    """Place, velocity and acceleration of a point in every position, SI, ndarrays of shape (n,)."""

    place: Complexes
    velocity: Complexes
    acceleration: Complexes


class LinkMotion(Struct, frozen=True):
    """Direction of a link's own axis (degrees in (-180, 180]), omega (1/s), epsilon (1/s²)."""

    phi_deg: Reals
    omega: Reals
    epsilon: Reals


class SegmentReading(Struct, frozen=True):
    """One segment of a plan, mm, ndarrays of shape (n,): exact and read with the ruler."""

    name: str
    exact: Reals
    read: Reals


class RelativeMotion(Struct, frozen=True):
    """Sliding of a point of link ``of`` on link ``to``, SI, ndarrays of shape (n,) (vectors)."""

    point: str
    of: str
    to: str
    velocity: Complexes
    coriolis: Complexes
    acceleration: Complexes


class Solution(Memoizing):
    """Solved task (решённая задача).

    Parameters
    ----------
    problem : Problem
    positions : array_like of shape (n,), optional
        Other positions of the driver than those of the file (degrees, or m for a driving slider).
        The assembly modes of the groups remain those of the file's own positions.
    ruler : float, mm, optional
        Step of the ruler with which the plans are read. Default: the profile's.
    profile : Profile or str
        Drafting accuracy, from which the drafting errors follow. By name ``cad``, ``board`` or
        ``coarse``.
    views : Views, optional
        Boxes that the plans should fill if the file gives no scale.
    scales : mapping of PlanKind to Scale, optional
        Scales of the plans, if neither the file nor the views should determine them.
    construction : Construction, optional
        Construction of the problem, if it exists already; scales and paper do not change it.

    Attributes
    ----------
    origin : Solution
        The solution that this one redraws at other scales; usually itself.

    Raises
    ------
    ArgumentError
        An argument is not valid.
    StructureError, ProblemError, AssemblyError
        The mechanism cannot be analysed or assembled.

    Examples
    --------
    >>> import planmethod
    >>> solution = planmethod.solve(planmethod.load("problems/linkages/ex3.toml"))
    >>> solution.structure.formula
    'I(0,1) → II(2,3) → II(4,5)'
    >>> from planmethod.plans.model import PlanKind
    >>> for segment in solution.segments(PlanKind.VELOCITY)[:3]:
    ...     print(f"{segment.name}: {segment.exact[0]:.2f} mm, read {segment.read[0]:g}")
    p-b: 64.00 mm, read 64
    b-b3: 45.64 mm, read 45.5
    p-b3: 44.87 mm, read 45
    """

    def __init__(
        self,
        problem: Problem,
        *,
        positions: npt.ArrayLike | None = None,
        ruler: float | None = None,
        profile: Profile | str = PROFILES["board"],
        views: Views | None = None,
        scales: Mapping[PlanKind, Scale] | None = None,
        construction: Construction | None = None,
    ) -> None:
        super().__init__()
        self.problem = of_type("problem", problem, Problem, "planmethod.load()")
        asked = problem.drive.positions if positions is None else positions
        self.positions: Reals = fixed(numbers("positions", asked))
        if not isinstance(profile, Profile):
            profile = PROFILES[chosen("profile", profile, PROFILES)]
        if ruler is not None:
            profile = replace(profile, ruler=above_zero("ruler", ruler))
        self.profile = profile
        if construction is None:
            construction = construct(problem)
        self.construction: Construction = of_type("construction", construction, Construction)
        reject_ambiguous(problem, self.construction.draft, self.positions)
        self._views = None if views is None else of_type("views", views, Views)
        if scales is not None:
            of_type("scales", scales, Mapping)
            for kind, scale in scales.items():
                of_type("scales", kind, PlanKind)
                of_type("scales", scale, Scale)
        self._scales = scales
        self.origin = self

    def _repr_html_(self) -> str:
        """Return the notebook's view: the tables of `solve`."""
        from pkgutil import resolve_name

        # Documents are in a higher layer: the page is found by name, as public names are.
        shown: str = resolve_name("planmethod.note.tables.results:results_part")(self)
        return shown

    def with_positions(self, positions: npt.ArrayLike) -> Solution:
        """Return the same mechanism, assembled in the same way, in other positions."""
        return self._with_changes(positions=positions)

    def in_position(self, number: int) -> Solution:
        """Return the same mechanism, assembled in the same way, in one of its positions alone.

        Positions with the same place of the first driver may have different places of another one.
        """
        own, drive = [float(self.positions[number])], self.problem.drive
        if not drive.other_drives:
            return self.with_positions(own)
        if not np.array_equal(self.positions, drive.positions):
            return self.in_places([places[number : number + 1] for places in self.places])
        others = tuple(one.at_index(number) for one in drive.other_drives)
        alone = replace(drive.at_index(number), other_drives=others)
        return self._with_changes(problem=replace(self.problem, drive=alone), positions=own)

    @property
    def places(self) -> list[Reals]:
        """Places of all driving links in the positions, degrees or m, each of shape (n,)."""
        drive = self.problem.drive
        others = (other_place(drive, one, self.positions) for one in drive.other_drives)
        return [self.positions, *others]

    def in_places(self, places: Sequence[Reals]) -> Solution:
        """Return the same mechanism, assembled in the same way, in other places of all drivers.

        Parameters
        ----------
        places : sequence of ndarrays of shape (n,)
            Degrees or m of each driving link, in their order.
        """
        first, *others = (
            one.in_other_positions(own.tolist())
            for one, own in zip(self.problem.drive.every, places, strict=True)
        )
        drive = replace(first, other_drives=tuple(others))
        return self._with_changes(problem=replace(self.problem, drive=drive), positions=places[0])

    def filling(self, views: Views | None, scales: Scales | None = None) -> Solution:
        """Return the same mechanism in the same positions with plans that fill other views.

        ``scales`` are the given scales. Default: the problem's.
        """
        if scales is not None:
            of_type("scales", scales, Scales)
        problem = self.problem if scales is None else replace(self.problem, scales=scales)
        return self._redrawn(problem=problem, views=views, scales=None)

    def drawn_at(
        self, scales: Mapping[PlanKind, Scale], own_scales: Mapping[PlanKind, Reals] | None = None
    ) -> Solution:
        """Return the same mechanism in the same positions with plans at certain scales.

        ``own_scales`` are those of plans out of proportion, shape (n,), NaN where there is none.
        """
        other = self._redrawn(views=None, scales=scales)
        other.own_scales = dict(own_scales or {})
        return other

    def at_unit_rate(self) -> Solution:
        """Return the same mechanism without loads, its driver at one radian (or metre) a second."""
        problem = unit_rate_problem(self.problem)
        # The plans of a crank that turns evenly have fewer steps.
        construction = None if self.problem.drive.acceleration else self.construction
        return self._with_changes(
            problem=problem, views=None, scales=None, construction=construction
        )

    def _redrawn(self, **changed: Any) -> Solution:
        other = self._with_changes(**changed)
        other.origin = self.origin
        if "si" in vars(self):
            other.si = self.si  # scales do not change the exact reading
        return other

    def _with_changes(self, **changed: Any) -> Solution:
        """Return another solution of the same construction."""
        same: dict[str, Any] = {
            "problem": self.problem,
            "positions": self.positions,
            "profile": self.profile,
            "views": self._views,
            "scales": self._scales,
            "construction": self.construction,
        }
        return self._new_solution(**(same | changed))

    def _new_solution(self, **settings: Any) -> Solution:
        """Return a solution of the kind that the variants of this one have."""
        return Solution(**settings)

    @property
    def structure(self) -> Structure:
        """Groups of the mechanism."""
        return self.construction.structure

    @property
    def driven(self) -> tuple[Reals, float | Reals, float | Reals]:
        """Place, rate and acceleration of the driving link in the positions."""
        return driven(self.problem.drive, self.positions)

    @property
    def max_positions(self) -> int:
        """Largest number of positions of one mechanism."""
        return len(self.positions)

    @property
    def parts(self) -> Sequence[tuple[Solution, slice]]:
        """Solutions of one mechanism each, and their positions: this one has one mechanism."""
        return ((self, EVERY),)

    def numbers_of(self, plan: Callable[[Construction], Mapping[str, float]]) -> dict[str, Number]:
        """Return the known numbers of a continuation of the construction."""
        if not callable(plan):
            raise ArgumentError("{}: expected a function, got {}.", "plan", describe(plan))
        return dict(plan(self.construction))

    def length(self, link: str, p: str, q: str) -> float | Reals:
        """Return the given distance of two points of a link, m."""
        bodies = self.problem.bodies
        points = bodies[known("link", link, bodies)].points
        p, q = known("point", p, points), known("point", q, points)
        return abs(points[q] - points[p])

    def variant_at(self, index: int) -> tuple[Solution, int]:
        """Return the solution of the mechanism that a position is of, and its number there."""
        return self, number_of("position", index, len(self.positions))

    # Readings --------------------------------------------------------------------------------

    def data(
        self,
        scales: Mapping[str, Number] = UNIT_SCALES,
        chosen: npt.NDArray[np.intp] | slice = EVERY,
    ) -> dict[str, Any]:
        """Return the data of the program at given scales (unit per mm), for some positions."""
        of_type("scales", scales, Mapping)
        data: dict[str, Any] = {**self._inputs_at(chosen), **at_positions(scales, chosen)}
        count = len(self.positions[chosen])
        if count <= FEW_ROWS:
            data = filled(data, count)
        for name in self.construction.draft.places:
            data[name] = data[name] / data["mu_l"]
        return data

    def _inputs_at(self, chosen: npt.NDArray[np.intp] | slice) -> Mapping[str, Any]:
        """Return the given data of some positions, at unit scales."""
        draft = self.construction.draft
        if self.problem.drive.other_drives:  # entries of lists, which the first one does not name
            return at_positions(drive_data(self.problem, draft, self.positions), chosen)
        return drive_data(self.problem, draft, self.positions[chosen])

    def read(self, arithmetic: Arithmetic, scales: Mapping[str, Number] = UNIT_SCALES) -> Reading:
        """Read the whole program in an arithmetic at given scales (unit per mm)."""
        trace = evaluate(self.construction.program, self.data(scales), arithmetic)
        return Reading(trace, len(self.positions))

    def read_at(self, positions: Reals) -> Reading:
        """Read the whole program at unit scales in other positions."""
        return self.with_positions(positions).read(Float64())

    @cached_property
    def si(self) -> Reading:
        """Exact reading at unit scales: one metre (m/s, m/s²) per millimetre of a plan.

        Raises
        ------
        PositionError
            A step is impossible in some position.
        """
        reading, program = self.read(Float64()), self.construction.program
        if (failing(program, reading.trace, len(self.positions)) >= 0).any():
            draft = self.construction.draft
            raise PositionError(explain(draft, program, reading, self.positions, self.read_at))
        reject_ambiguous(self.problem, self.construction.draft)
        return reading

    @cached_property
    def extents(self) -> Extents:
        """Sizes of the mechanism and its plans, at unit scales."""
        return Extents(self.construction, self.si)

    @cached_property
    def scales(self) -> dict[PlanKind, Scale]:
        """Scales of the plans: given, the file's, or those of the series that fill the views.

        One for all plans of a kind. If the file requests individual ones (`plan_scale`), one of
        these.
        """
        if self._scales is not None:
            return dict(self._scales)
        if not len(self.positions):
            raise ArgumentError("positions: expected at least one, got [].")
        scales = choose_scales(self.extents, self.views, self.given_scales)
        for kind, own in self.own_scales.items():
            if not np.isnan(own).any():  # there is no common scale: one of them represents it
                scales[kind] = replace(scales[kind], per_mm=float(median(own)))
        return scales

    @cached_property
    def own_scales(self) -> dict[PlanKind, Reals]:
        """Scales of the plans that have their own, shape (n,), of the kinds that have such plans.

        NaN where the common one holds.
        """
        found: dict[PlanKind, Reals] = {}
        for kind in RATES if self._scales is None and not self._is_undrawable else ():
            own = per_plan_scales(self.extents, self.views, self.given_scales, kind)
            if not np.isnan(own).all():
                found[kind] = own
        return found

    @property
    def _is_undrawable(self) -> bool:
        """True if there are too many positions to draw."""
        return len(self.positions) > MAX_DRAWN

    def plan_scale(self, kind: PlanKind, index: int) -> Scale:
        """Return the scale at which a plan is drawn in one position: mostly the common one."""
        kind = of_type("kind", kind, PlanKind)
        number_of("position", index, len(self.positions))
        common, own = self.scales[kind], self.own_scales.get(kind)
        if own is None or np.isnan(own[index]):
            return common
        return replace(common, per_mm=float(own[index]))

    def has_common(self, kind: PlanKind) -> bool:
        """Return whether plans of a kind have one scale."""
        of_type("kind", kind, PlanKind)
        own = self.own_scales.get(kind)
        return own is None or bool(np.isnan(own).any())

    @cached_property
    def _decided(self) -> tuple[Views, Scales]:
        if self._views is not None:
            return self._views, self.problem.scales
        moved = tuple(self.positions.tolist()) != self.problem.drive.positions
        return decide(self.extents, self.problem, other_positions=moved)

    @property
    def views(self) -> Views:
        """Boxes that the plans should fill: those of the format on which a sheet is tried first."""
        return self._decided[0]

    @cached_property
    def closes_after(self) -> float:
        """Turns of the driver after which the links are where they were; infinite if they are not.

        A group that passes a change point continues in its other mode: then two turns.
        """
        turn = self.problem.drive.coordinate.turn
        again = assembly_period(self.construction.draft.choice, turn) if isfinite(turn) else turn
        return again / turn if isfinite(again) else inf

    @property
    def closing_turns(self) -> int:
        """Turns of the driver after which the links are where they were; one if they never are."""
        return round(self.closes_after) if isfinite(self.closes_after) else 1

    @property
    def turns(self) -> int:
        """Turns of the driver in a cycle: of the machine, and as many as the links need."""
        return lcm(self.problem.turns, self.closing_turns)

    @property
    def repeated(self) -> int:
        """Number of repetitions of the motion in a cycle: two for a four-stroke engine."""
        return self.turns // self.closing_turns

    @property
    def given_scales(self) -> Scales:
        """Scales that are given: the file's, as far as other positions than its own bear them."""
        return self._decided[1]

    @cached_property
    def per_mm(self) -> dict[str, Number]:
        """Unit per millimetre of each plan, by the name that the program has for it.

        Of several positions those of the plans of each, shape (n,), where one has its own.
        """
        found: dict[str, Number] = {s.symbol: s.per_mm for s in self.scales.values()}
        for kind, own in self.own_scales.items():
            common = self.scales[kind]
            found[common.symbol] = np.where(np.isnan(own), common.per_mm, own)
        return found

    @cached_property
    def paper(self) -> Reading:
        """Exact reading at the plans' scales: millimetres on the paper."""
        self.si  # noqa: B018 - an impossible step must be reported first, in metres
        return self.read(Float64(), self.per_mm)

    @cached_property
    def detail_views(self) -> dict[PlanKind, tuple[DetailView, ...]]:
        """Short segments that are enlarged, by plans: of one position, which has plans alone."""
        found: dict[PlanKind, tuple[DetailView, ...]] = {}
        for kind in RATES:
            first = sum(map(len, found.values()))
            alone = len(self.positions) == 1
            least = min_enlarged(self.profile.ruler)
            found[kind] = (
                find_detail_views(self.construction, self.paper, kind, least, first)
                if alone
                else ()
            )
        return found

    @cached_property
    def small_plans(self) -> dict[PlanKind, dict[int, DetailView]]:
        """Enlarged views beside the plans of several positions, by position."""
        if len(self.positions) == 1 or self._is_undrawable:
            return {kind: {} for kind in RATES}
        return small_plans(self.construction, self.paper, min_enlarged(self.profile.ruler))

    def detail_views_at(self, kind: PlanKind, index: int) -> tuple[DetailView, ...]:
        """Return the enlarged views of a plan in one position."""
        number_of("position", index, len(self.positions))
        small = self.small_plans[of_type("kind", kind, PlanKind)].get(index)
        return self.detail_views[kind] if small is None else (small,)

    def enlarged_on(self, index: int) -> dict[NumberName, DetailView]:
        """Return the lengths that an enlarged view has in a position, and which view."""
        number_of("position", index, len(self.positions))
        return {
            name: detail_view
            for kind in RATES
            for detail_view in self.detail_views_at(kind, index)
            for name in lengths_on(self.construction, kind, detail_view)
        }

    def read_on(self, index: int) -> dict[NumberName, DetailView]:
        """Return the lengths that are read on an enlarged view in a position, and on which."""
        return {
            name: detail_view
            for name, detail_view in self.enlarged_on(index).items()
            if is_read(self.construction, name)
        }

    @cached_property
    def ruler_arithmetic(self) -> RulerArithmetic:
        """Draughtsman with a ruler, who reads short segments where they are enlarged."""
        if len(self.positions) == 1:
            alone: dict[str, Number] = {
                n: detail_view.times for n, detail_view in self.read_on(0).items()
            }
            return RulerArithmetic(self.profile.ruler, alone)
        enlargements: dict[str, Number] = {}
        for index in sorted({k for small in self.small_plans.values() for k in small}):
            for name, detail_view in self.read_on(index).items():
                times = enlargements.setdefault(name, np.ones(len(self.positions)))
                times[index] = detail_view.times
        calculated = self.problem.calculated
        if calculated is not None and self.positions.tolist() == list(self.problem.drive.positions):
            # The calculated position has a plan of its own: it is read there.
            one = self.in_position(calculated)
            others: set[str] = {*enlargements, *one.ruler_arithmetic.enlargements}
            for other in sorted(others):
                times = enlargements.setdefault(other, np.ones(len(self.positions)))
                times[calculated] = one.ruler_arithmetic.enlargements.get(other, 1.0)
        return RulerArithmetic(self.profile.ruler, enlargements)

    @cached_property
    def ruler_reading(self) -> Reading:
        """Reading with a ruler, along the draughtsman's own chain."""
        self.si  # noqa: B018
        return self.read(self.ruler_arithmetic, self.per_mm)

    def place(self, name: PointName) -> Complexes:
        """Return the place of a point in the file's coordinates, m, ndarray of shape (n,)."""
        if not isinstance(name, str) or name not in self.si.value:
            known("point", name, self.construction.draft.points())
        return fixed(self.si.point(name) + self.construction.draft.origin)

    # Results ---------------------------------------------------------------------------------

    @cached_property
    def margin(self) -> Reals:
        """Least margin of all steps in each position: nearness to a dead position."""
        none = np.ones(self.positions.shape)
        margins = [np.broadcast_to(m, none.shape) for m in self.si.trace.margin.values()]
        return fixed(np.asarray(np.min([*margins, none], axis=0), dtype=float))

    @cached_property
    def points(self) -> dict[str, PointMotion]:
        """Motion of every named point, and of the coincident points that move differently."""
        kinematics = self.construction.kinematics
        result: dict[str, PointMotion] = {}
        for name, (link, place) in kinematics.velocity.named.items():
            result[name] = PointMotion(
                self.place(PointName(place)),
                self.si.point(kinematics.velocity.point[link, place]),
                self.si.point(kinematics.acceleration.point[link, place]),
            )
        return Named(result, "point")

    @cached_property
    def links(self) -> dict[str, LinkMotion]:
        """Motion of every moving link."""
        kinematics, draft = self.construction.kinematics, self.construction.draft
        zero = fixed(np.zeros(self.positions.shape))
        result: dict[str, LinkMotion] = {}
        for link in self.problem.mechanism.links:
            angle = Float64().angle(self.si.line_vector(draft.axes[link]))
            omega, epsilon = kinematics.omega.get(link), kinematics.epsilon.get(link)
            result[link] = LinkMotion(
                fixed(angle),
                zero if omega is None else self.si.number(omega),
                zero if epsilon is None else self.si.number(epsilon),
            )
        return Named(result, "link")

    @cached_property
    def relatives(self) -> list[RelativeMotion]:
        """Sliding in every prismatic pair that the plans' equations use."""
        return [self._relative(r) for r in self.construction.kinematics.relatives.values()]

    def _relative(self, r: Relative) -> RelativeMotion:
        def vector(tail: PointName | None, head: PointName | None) -> Complexes:
            assert tail is not None and head is not None
            return fixed(self.si.vector(tail, head))

        return RelativeMotion(
            r.point,
            r.of,
            r.to,
            vector(r.start, r.head),
            vector(r.a_start, r.a_coriolis),
            vector(r.a_coriolis, r.a_head),
        )

    @cached_property
    def legend(self) -> dict[str, Quantity]:
        """Every quantity of the motion by its label."""
        return Named({one.label: one for one in self.construction.legend}, "quantity")

    def quantities(self, *kinds: QuantityKind) -> dict[str, list[Quantity]]:
        """Return the quantities of the motion of some kinds, grouped by their point or link."""
        for kind in kinds:
            of_type("kinds", kind, QuantityKind)
        found: dict[str, list[Quantity]] = {}
        for quantity in self.construction.legend:
            if quantity.kind in kinds:
                found.setdefault(quantity.of, []).append(quantity)
        return found

    def exact(self, quantity: Quantity | str) -> Reals:
        """Return a quantity of the motion, or that of a label, SI and degrees, shape (n,).

        A size if the drawing gives nothing else. For places see `place`.
        """
        if not isinstance(quantity, Quantity):
            quantity = self.legend[quantity]
        match quantity.kind.measure:
            case Measure.ANGLE:
                return self.links[quantity.of].phi_deg
            case Measure.NUMBER:
                value = self.si.number(NumberName(quantity.name))
                return fixed(np.abs(value)) if quantity.kind.is_size else value
            case Measure.PLACE | Measure.VECTOR:
                return fixed(np.abs(self.si.point(PointName(quantity.name))))
            case Measure.DIRECTION:
                return fixed(np.ones(self.positions.shape))
            case never:
                assert_never(never)

    def components(self, quantity: Quantity) -> tuple[Reals, ...]:
        """Return the columns of a quantity, SI and degrees, each of shape (n,)."""
        match quantity.kind.measure:
            case Measure.ANGLE:
                return (self.links[quantity.of].phi_deg,)
            case Measure.NUMBER:
                return (self.si.number(NumberName(quantity.name)),)
            case Measure.PLACE:
                vector = self.place(PointName(quantity.name))
            case Measure.VECTOR:
                vector = self.si.point(PointName(quantity.name))
            case Measure.DIRECTION:
                along = self.si.line_vector(LineName(quantity.name))
                vector = along / np.abs(along)
            case never:
                assert_never(never)
        return vector.real, vector.imag

    def read_off(self, label: str) -> Reals:
        """Return a quantity as found by hand, SI, ndarray of shape (n,).

        Sizes of vectors; angular velocities and accelerations with their sign. Zero for an object
        at rest; NaN if the plan does not determine it.

        Raises
        ------
        UnknownNameError
            There is no such label.
        """
        quantity = self.legend[label]
        if quantity.size is None:
            return fixed(np.zeros(self.positions.shape))
        value = self.ruler_reading.number(quantity.size)
        return fixed(np.abs(value)) if quantity.kind.is_size else value

    def segments(self, kind: PlanKind) -> list[SegmentReading]:
        """Return the segments of a plan in mm: exact, and read along the draughtsman's chain."""
        of_type("kind", kind, PlanKind)
        return [
            SegmentReading(
                segment.name,
                fixed(np.abs(self.paper.number(segment.length))),
                fixed(np.abs(self.ruler_reading.number(segment.length))),
            )
            for segment in self.construction.segments
            if segment.kind is kind
        ]
