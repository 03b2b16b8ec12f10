"""Errors of a program's drawing: sigma of every quantity, and their covariance.

Errors are propagated to first order, stroke by stroke. The error of a segment that is short
relative to its sigma is not normal: any deviation across it makes it longer, and its direction is
undetermined. If no step before it is nearly impossible, the ends of the segment still err to first
order, together: only the readings between them are evaluated again, at the points of a lattice
(`LatticeSampled`) with their covariance. Rounding to the ruler counts as an error that is uniform
over a division. If a step is nearly impossible, sigma comes from random drawings of the whole
construction, which take far longer.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from enum import Enum
from functools import cached_property
from typing import Any, TypeVar

import numpy as np
import numpy.typing as npt
from msgspec import Struct

from planmethod.arguments import known, number_of, text, texts
from planmethod.construct.arithmetic import Number
from planmethod.construct.drafting import (
    AS_SCALED,
    LATTICE_SIZE,
    LatticeSampled,
    Profile,
    Propagated,
    Sampled,
    causes_of,
)
from planmethod.construct.dual import Dual, as_dual, common_slopes
from planmethod.construct.evaluate import Trace, evaluate, extend_trace
from planmethod.construct.program import Program
from planmethod.construct.steps import (
    Compute,
    LineName,
    Measure,
    Name,
    PointName,
    Step,
    Total,
    operands,
    result_kind,
)
from planmethod.errors import PlanMethodError
from planmethod.solved.reading import Flags, Reals, fixed

RADIAN = float(np.degrees(1.0))
"""Size with which the sigma of a direction is compared, degrees: one radian."""


class DrawnKind(Enum):
    """Kind of a quantity: near zero the errors of a length and its direction are not normal."""

    NUMBER = "number"
    LENGTH = "length"
    DIRECTION = "direction"  # degrees


class DrawnQuantity(Struct, frozen=True):
    """A quantity that a drawing gives (величина чертежа).

    Attributes
    ----------
    label : str
        ``velocity.p-b`` (mm of the plan), ``x_B``, ``v_B``, ``F_2_1`` (SI), ``angle_F_2_1``
        (degrees).
    needs : tuple of Name
        Steps that it is taken from.
    read : callable
        The quantity from a trace.
    kind : DrawnKind
    absent : callable or None
        Returns the positions in which its segment is not drawn: there it has no error.
    direction : str
        Label of the direction of a length, if the drawing gives it: if that is unreliable, so is
        the length, because an error across a segment then lengthens it.
    """

    label: str
    needs: tuple[Name, ...]
    read: Callable[[Trace], Number]
    kind: DrawnKind = DrawnKind.NUMBER
    absent: Callable[[], Flags] | None = None
    direction: str = ""


class Drafted(Struct, frozen=True):
    """A construction and the quantities read from it (чертёж).

    Attributes
    ----------
    program : Program
    data : callable
        Data of the program for some positions, by their indices.
    count : int
        Positions.
    profile : Profile
        The hand.
    free : frozenset of str
        Points that may be placed anywhere: they have no error.
    items : sequence of DrawnQuantity
    points : tuple of PointName
        Points whose ellipses can be requested.
    enlargements : mapping of str to Number
        Enlargement of a step relative to its scale, by its name: in all positions, or in each,
        shape (count,).
    """

    program: Program
    data: Callable[[npt.NDArray[np.intp]], dict[str, Number]]
    count: int
    profile: Profile
    free: frozenset[str]
    items: tuple[DrawnQuantity, ...]
    points: tuple[PointName, ...] = ()
    enlargements: Mapping[str, Number] = AS_SCALED

    def times(self, chosen: npt.NDArray[np.intp]) -> dict[str, Number]:
        """Return how many times larger steps are drawn in some positions."""
        return {
            out: times[chosen] if np.ndim(times) else times
            for out, times in self.enlargements.items()
        }


# Takers --------------------------------------------------------------------------------------


def number(name: Name, *, size: bool = False) -> Callable[[Trace], Number]:
    """Return a function that reads a number, or its size."""
    if size:
        return lambda trace: abs(trace.value[name])
    return lambda trace: trace.value[name]


CENTRAL = (0.158655253931457, 0.841344746068543)
"""Quantiles of one sigma either side of the mean of a normal error."""

NOISE = 1e-12
"""Variance, relative to the largest, below which it is the rounding of a zero."""


def sigma_of(value: Dual) -> Reals:
    """Return the sigma of a number in every position."""
    # All causes, those that change nothing too, one after another: `sum` would add up a position
    # alone in another order than one of many.
    slope = value.slope
    sigma = 0.0 if slope is None else np.sqrt(np.add.accumulate(slope**2)[-1])
    return np.array(np.broadcast_to(sigma, value.value.shape), dtype=float)


def covariance_of(values: Sequence[Dual]) -> Reals:
    """Return how numbers err together, x and y of each place: shape (k, k, n)."""
    slopes, _ = common_slopes(*values)
    shape = np.broadcast_shapes((1, len(values[0].value)), *map(np.shape, slopes))
    rows = [
        np.broadcast_to(side, shape)
        for slope, value in zip(slopes, values, strict=True)
        for side in ((np.real(slope), np.imag(slope)) if np.iscomplexobj(value.value) else (slope,))
    ]
    products = np.array(rows)[:, None] * np.array(rows)[None]
    return np.asarray(np.add.accumulate(products, axis=2)[:, :, -1], dtype=float)


def root_of(spread: Reals) -> Reals:
    """Return the symmetric square roots of covariance matrices, shape (n, k, k).

    Of all roots it alone is the same whatever the signs of the eigenvectors are, and their turn
    where eigenvalues are equal: the last bit decides both, and the drawings of a lattice that are
    made with them, and their sigma by as much as 7 %.
    """
    size, turned = np.linalg.eigh(spread)
    size = np.where(size > NOISE * size[:, -1:], size, 0.0)
    return np.asarray((turned * np.sqrt(size)[:, None, :]) @ np.swapaxes(turned, -1, -2))


def half_widths(item: DrawnQuantity, rows: Reals) -> Reals:
    """Return `half_width` of every row; rows whose values all exist are processed together."""
    if not np.isfinite(rows).all():
        return np.array([half_width(item, row) for row in rows])
    if item.kind is DrawnKind.DIRECTION:
        rows = _unwound(rows)
    # Seven figures are sorted faster than sixteen, and whole rows than `np.quantile` parts them.
    ordered = np.sort(rows.astype(np.float32), axis=1)
    low, high = (_quantile(ordered, share) for share in CENTRAL)
    return (high - low) / 2


def _quantile(ordered: npt.NDArray[np.float32], fraction: float) -> Reals:
    """Return the quantile of every row."""
    k, part = divmod(fraction * (ordered.shape[1] - 1), 1.0)
    low, high = ordered[:, int(k)], ordered[:, int(k) + 1]
    return np.asarray(low + part * (high - low), dtype=float)


def half_width(item: DrawnQuantity, values: Reals) -> float:
    """Return half the interval of the middle 68 % of the random values that exist."""
    able = values[np.isfinite(values)]
    if not able.size:
        return float("nan")
    if item.kind is DrawnKind.DIRECTION:
        able = _unwound(able)
    low, high = np.quantile(able, CENTRAL)
    return float(high - low) / 2


def _unwound(degrees: Reals) -> Reals:
    """Return directions from their mean one, in (-180, 180]: those about 180 lie together."""
    ways = np.radians(degrees).astype(np.float32)
    across, along = (f(ways).sum(axis=-1, keepdims=True) for f in (np.sin, np.cos))
    off = degrees - np.degrees(np.arctan2(across, along))
    return np.asarray(off - 360.0 * np.rint(off / 360.0), dtype=float)


Key = TypeVar("Key", bound=str)

DRAWS = 4000
"""Random sheets where first order does not hold."""

MAX_DRAWS = 10_000_000
"""Maximum number of random sheets that can be requested."""

MAX_MARGIN_SIGMA = 0.1
"""Sigma of a step's margin, relative to it, above which first order is not trusted."""

BENT = 0.03
"""The same limit for quantities that are close to zero."""

SHORT = 3.0
"""Ratio of a length to its sigma that is required for first order to be trusted."""

BLOCK = 512
"""Positions propagated in one go: slopes by the strokes before them are kept for all steps."""

AT_ONCE = 128
"""Positions whose readings are made again in one go: more do not stay in the cache."""


class UnknownItemError(PlanMethodError, ValueError):
    """A covariance is requested for a quantity that a drawing does not give."""


class Spread(Struct, frozen=True):
    """Drafting error of one quantity in every position (погрешность построения).

    Attributes
    ----------
    sigma : ndarray of shape (n,)
        One standard deviation, in the quantity's unit. Where it was drawn at random: half of the
        interval that holds the middle 68 % of the draws.
    drawn : ndarray of bool of shape (n,)
        First order does not hold there, and the sigma is that of random draws.
    """

    sigma: Reals
    drawn: Flags


class Errors:
    """Drafting errors of a drawing (погрешности построения).

    Parameters
    ----------
    drawing : Drafted
    draws, seed : int
        Of the random sheets.
    """

    def __init__(self, drawing: Drafted, *, draws: int = DRAWS, seed: int = 1) -> None:
        self.drawing, self.profile = drawing, drawing.profile
        self.draws, self.seed = draws, seed
        self.items: dict[str, DrawnQuantity] = {item.label: item for item in drawing.items}
        self._own: dict[int, _Slopes] = {}
        self._sheets: dict[int, dict[str, float]] = {}
        self._beyond: dict[float, dict[Name, Flags]] = {}

    # First order -----------------------------------------------------------------------------

    def _draw(self, pencil: Any, chosen: npt.NDArray[np.intp]) -> tuple[Trace, dict[str, Number]]:
        """Draw the construction with a pencil and take every quantity off it."""
        program = self.drawing.program
        trace = evaluate(program, self.drawing.data(chosen), pencil)
        return trace, self.read_quantities(trace)

    def read_quantities(self, trace: Trace) -> dict[str, Number]:
        """Return every quantity as it is read."""
        with np.errstate(all="ignore"):
            return {item.label: item.read(trace) for item in self.items.values()}

    @cached_property
    def _causes(self) -> int:
        drawing = self.drawing
        first = np.zeros(1, dtype=int)
        return causes_of(drawing.program, lambda: drawing.data(first), drawing.free)

    def _propagate(self, chosen: npt.NDArray[np.intp]) -> _Slopes:
        if len(chosen) == 1:
            # NumPy multiplies a number by one complex number in another way than by many: the
            # results of a position alone must equal those of it among others to the last bit.
            return self._propagate(np.repeat(chosen, 2)).at(np.zeros(1, dtype=np.intp))
        pencil = Propagated(
            self.profile, self.drawing.free, self._causes, self.drawing.times(chosen)
        )
        trace, taken = self._draw(pencil, chosen)

        def in_every_position(value: Number) -> Dual:
            """Return a number in every position."""
            dual = as_dual(value)
            flat = np.broadcast_to(np.atleast_1d(dual.value), (len(chosen),))
            return Dual(flat, dual.part, dual.rows)

        return _Slopes(
            len(chosen),
            {label: in_every_position(value) for label, value in taken.items()},
            {name: in_every_position(margin) for name, margin in trace.margin.items()},
            {name: in_every_position(trace.value[name]) for name in self.drawing.points},
            {name: in_every_position(trace.value[name]) for name in self._leaves},
            pencil.of,
        )

    @cached_property
    def _first(self) -> _First:
        """First-order results in all positions; slopes of one are recomputed on request."""
        count = self.drawing.count
        parts = [
            self._reduced(self._propagate(np.arange(start, min(start + BLOCK, count))))
            for start in range(0, count, BLOCK)
        ]
        return _First(
            _joined([part.sigmas for part in parts]),
            _joined([part.strain for part in parts]),
            _joined([part.points for part in parts]),
            _joined([part.short for part in parts]),
        )

    def _reduced(self, part: _Slopes) -> _First:
        sigmas = {label: sigma_of(dual) for label, dual in part.quantities.items()}
        short = {
            label: (sigmas[label] > 0)
            & (_size(item, part.quantities[label].value) < SHORT * sigmas[label])
            for label, item in self.items.items()
            if item.kind is not DrawnKind.NUMBER
        }
        for label, item in self.items.items():
            if item.direction:
                short[label] = short[label] | short[item.direction]
        with np.errstate(divide="ignore", invalid="ignore"):
            strain = {
                name: sigma_of(margin) / np.abs(margin.value)
                for name, margin in part.margins.items()
            }
        return _First(
            sigmas,
            strain,
            {name: covariance_of([point]) for name, point in part.points.items()},
            {label: self._read_again(label, part, where) for label, where in short.items()},
        )

    # Quantities close to zero ------------------------------------------------------------------

    @cached_property
    def _readings(self) -> dict[str, tuple[tuple[Step, ...], tuple[Name, ...]]]:
        """Last steps of every length and direction: the read value and the names it depends on."""
        made = {step.out: step for step in self.drawing.program.steps}
        order = {name: k for k, name in enumerate(made)}
        found: dict[str, tuple[tuple[Step, ...], tuple[Name, ...]]] = {}
        for label, item in self.items.items():
            if item.kind is DrawnKind.NUMBER:
                continue
            steps, leaves, left = set[Name](), set[Name](), list(item.needs)
            while left:
                name = left.pop()
                if isinstance(made[name], (Compute, Total, Measure)):
                    if name not in steps:
                        steps.add(name)
                        left += [one for one, _ in operands(made[name])]
                else:
                    leaves.add(name)
            if any(result_kind(made[name]) is LineName for name in leaves):
                continue  # a line has two values
            last = tuple(made[name] for name in sorted(steps, key=order.__getitem__))
            found[label] = last, tuple(sorted(leaves, key=order.__getitem__))
        return found

    @cached_property
    def _leaves(self) -> tuple[Name, ...]:
        return tuple({name: None for _, leaves in self._readings.values() for name in leaves})

    def _read_again(self, label: str, part: _Slopes, mask: Flags) -> Reals:
        """Return the sigma where a length is close to zero, NaN elsewhere; shape (n,).

        Infinite where it cannot be found in this way.
        """
        found = np.where(mask, np.inf, np.nan)
        if label in self._readings:
            short = np.flatnonzero(mask)
            for start in range(0, len(short), AT_ONCE):
                chosen = short[start : start + AT_ONCE]
                found[chosen] = self._read_evenly(label, part, chosen)
        return found

    def _read_evenly(self, label: str, part: _Slopes, chosen: npt.NDArray[np.intp]) -> Reals:
        """Return the sigma of a quantity in some positions.

        The points that it is read from have first-order errors, spread evenly, and are read.
        """
        (steps, leaves), item = self._readings[label], self.items[label]
        read = {name: part.leaves[name].at(chosen) for name in leaves}
        env: dict[Name, Any] = {name: dual.value[:, None] for name, dual in read.items()}
        off = [name for name, dual in read.items() if dual.part is not None]
        wide = {out: np.atleast_1d(k)[:, None] for out, k in self.drawing.times(chosen).items()}
        pencil = LatticeSampled(self.profile, self.drawing.free, wide)
        coordinates: Iterator[Reals] = iter(())
        if off:  # else it errs by its own reading alone
            spread = np.moveaxis(covariance_of([read[name] for name in off]), -1, 0)
            root = root_of(spread)
            coordinates = iter(np.moveaxis(root @ pencil.normals(root.shape[-1]), 1, 0))
        for name in off:
            value = env[name]
            place = env[name] = np.empty((len(chosen), LATTICE_SIZE), value.dtype)
            np.add(value.real, next(coordinates), out=place.real)
            if np.iscomplexobj(value):
                np.add(value.imag, next(coordinates), out=place.imag)
        with np.errstate(all="ignore"):
            taken = item.read(extend_trace(Trace(env, {}), steps, {}, pencil))
        drawn = np.broadcast_to(np.asarray(taken, dtype=float), (len(chosen), LATTICE_SIZE))
        return np.nan_to_num(half_widths(item, drawn), nan=np.inf)

    def _at(self, index: int) -> _Slopes:
        """Return the slopes in one position."""
        if index not in self._own:
            self._own = {index: self._propagate(np.array([index]))}
        return self._own[index]

    def _slope(self, label: str, index: int) -> Reals:
        """Return the slopes of a quantity by every cause in one position, shape (m,)."""
        slope = self._at(index).quantities[label].slope
        return np.zeros(self._causes) if slope is None else slope[:, 0]

    # Where first order does not hold ---------------------------------------------------------

    @cached_property
    def _ancestors(self) -> dict[Name, frozenset[Name]]:
        return _ancestors(self.drawing.program)

    def flag_unreliable(self, *names: Name, limit: float = MAX_MARGIN_SIGMA) -> Flags:
        """Return where a step that others depend on is almost impossible for this hand.

        Its margin there is not much larger than its own error.
        """
        found = np.zeros(self.drawing.count, dtype=bool)
        doubtful = self._unreliable_steps(limit)
        if not doubtful:  # of nearly every drawing
            return found
        above = frozenset[Name]().union(*(self._ancestors[name] for name in names))
        for step, where in doubtful.items():
            if step in above:
                found |= where
        return found

    def _unreliable_steps(self, limit: float) -> dict[Name, Flags]:
        """Return where steps are strained beyond a limit, without those that never are."""
        if limit not in self._beyond:
            beyond = {step: ~(strain <= limit) for step, strain in self._first.strain.items()}
            self._beyond[limit] = {step: where for step, where in beyond.items() if where.any()}
        return self._beyond[limit]

    @cached_property
    def spreads(self) -> Mapping[str, Spread]:
        """Drafting error of every quantity, by its label; each is computed on request."""
        return _Spreads(self)

    def spread_of(self, label: str) -> Spread:
        """Return the drafting error of a quantity, without the cache."""
        item, first = self.items[label], self._first
        sigma = np.array(first.sigmas[label])
        strange = ~np.isfinite(sigma) | self.flag_unreliable(*item.needs)
        if item.direction:
            way = self.items[item.direction]
            strange |= ~np.isfinite(first.sigmas[way.label]) | self.flag_unreliable(*way.needs)
        again = first.short[label] if label in first.short else np.full_like(sigma, np.nan)
        bent = ~np.isnan(again) & self.flag_unreliable(*item.needs, limit=BENT)
        strange, short = strange | np.isinf(again) | bent, np.isfinite(again)
        if item.absent is not None:
            absent = item.absent()
            sigma[absent], strange, short = 0.0, strange & ~absent, short & ~absent
        sigma[short] = again[short]
        for i in np.flatnonzero(strange):
            sigma[i] = self._of_sheets(int(i))[label]
        return Spread(fixed(sigma), fixed(strange | short))

    def _of_sheets(self, index: int) -> dict[str, float]:
        """Return the sigmas of all quantities that random sheets of one position give."""
        if index not in self._sheets:
            drawn = self.sample(index)
            self._sheets[index] = {
                label: half_width(item, drawn[label]) for label, item in self.items.items()
            }
        return self._sheets[index]

    def sample(
        self, index: int, *, draws: int | None = None, seed: int | None = None
    ) -> dict[str, Reals]:
        """Return every quantity of one position from random sheets: arrays of shape (draws,)."""
        count = self.draws if draws is None else number_of("draws", draws, MAX_DRAWS + 1)
        seed = self.seed if seed is None else number_of("seed", seed, 2**32)
        seed = seed * 1_000_003 + self._at_position(index)
        chosen = np.array([index])
        times = self.drawing.times(chosen)
        pencil = Sampled(self.profile, self.drawing.free, count, seed, times)
        _, taken = self._draw(pencil, chosen)
        return {
            label: np.broadcast_to(np.asarray(value, dtype=float), (count,))
            for label, value in taken.items()
        }

    # Together --------------------------------------------------------------------------------

    def covariance(self, labels: Iterable[str], index: int = 0) -> Reals:
        """Return the covariance matrix of some quantities in one position, to first order.

        Returns
        -------
        ndarray of shape (k, k)
            In products of the quantities' units.

        Raises
        ------
        UnknownItemError
        """
        asked = list(texts("labels", labels))
        self._check(asked)
        self._at_position(index)
        rows = np.array([self._slope(label, index) for label in asked])
        return np.asarray(rows @ rows.T, dtype=float)

    def _at_position(self, index: int) -> int:
        return number_of("position", index, self.drawing.count)

    def _check(self, labels: list[str]) -> None:
        unknown = [label for label in labels if label not in self.items]
        if unknown:
            raise UnknownItemError(
                "a drawing does not give {}. Known: {}.", ", ".join(unknown), ", ".join(self.items)
            )

    def ellipse(self, point: PointName, index: int) -> Reals:
        """Return the covariance of a point on its plan, mm², ndarray of shape (2, 2)."""
        self._at_position(index)
        if not isinstance(point, str) or point not in self._first.points:
            raise UnknownItemError(
                "no plan has a point {}. Known: {}.", point, ", ".join(sorted(self._first.points))
            )
        return np.array(self._first.points[point][:, :, index])

    def causes(self, label: str, index: int = 0) -> list[tuple[str, float]]:
        """Return the steps by their share of a quantity's variance, the largest first."""
        self._check([text("label", label)])
        self._at_position(index)
        slope = self._slope(label, index) ** 2
        shares: dict[str, float] = {}
        for step, part in zip(self._at(index).strokes, slope, strict=True):
            shares[step] = shares.get(step, 0.0) + float(part)
        total = sum(shares.values()) or 1.0
        ordered = sorted(shares.items(), key=lambda pair: -pair[1])
        return [(step, part / total) for step, part in ordered if part > 0]


class _Spreads(Mapping[str, Spread]):
    """Spreads by label, each found once."""

    def __init__(self, errors: Errors) -> None:
        self._errors = errors
        self._found: dict[str, Spread] = {}

    def __getitem__(self, label: str) -> Spread:
        known("quantity", label, self._errors.items)
        if label not in self._found:
            self._found[label] = self._errors.spread_of(label)
        return self._found[label]

    def __iter__(self) -> Iterator[str]:
        return iter(self._errors.items)

    def __len__(self) -> int:
        return len(self._errors.items)


class _Slopes(Struct, frozen=True):
    """Quantities, margins, points and leaves with their slopes, and the strokes of the causes."""

    count: int
    quantities: dict[str, Dual]
    margins: dict[Name, Dual]
    points: dict[PointName, Dual]
    leaves: dict[Name, Dual]
    strokes: list[str]

    def at(self, chosen: npt.NDArray[np.intp]) -> _Slopes:
        """Return the same in some of the positions."""

        def some(duals: Mapping[Key, Dual]) -> dict[Key, Dual]:
            return {name: dual.at(chosen) for name, dual in duals.items()}

        return _Slopes(
            len(chosen),
            some(self.quantities),
            some(self.margins),
            some(self.points),
            some(self.leaves),
            self.strokes,
        )


class _First(Struct, frozen=True):
    """First order: sigmas, strain of steps, covariances of points (2, 2, n).

    ``strain``: sigma of a step's margin, in parts of it. ``short``: sigmas of quantities close to
    zero, NaN where they are not.
    """

    sigmas: dict[str, Reals]
    strain: dict[Name, Reals]
    points: dict[PointName, Reals]
    short: dict[str, Reals]


def _size(item: DrawnQuantity, values: Reals) -> Reals | float:
    """Return the size with which a sigma is compared: a length, or that of a rotated segment."""
    return values if item.kind is DrawnKind.LENGTH else RADIAN


def _joined(parts: list[dict[Key, Any]]) -> dict[Key, Any]:
    """Return blocks of positions as one."""
    return {key: np.concatenate([part[key] for part in parts], -1) for key in parts[0]}


def _ancestors(program: Program) -> dict[Name, frozenset[Name]]:
    """Return for every step the steps that it depends on, itself among them."""
    found: dict[Name, frozenset[Name]] = {}
    for step in program.steps:
        above = frozenset[Name]().union(*(found[name] for name, _ in operands(step)))
        found[step.out] = above | {step.out}
    return found
