"""A linkage built in Python: the table of a problem file, filled call by call (механизм).

The table is in the units of the file, and is read as the file is: `Mechanism.problem` equals the
problem of the text that `Mechanism.to_toml` returns.
"""

# no messages: for programs in Python

from __future__ import annotations

from collections.abc import Iterable, Mapping
from copy import deepcopy
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from planmethod.arguments import known, reals, text
from planmethod.errors import ArgumentError
from planmethod.linkages.reading import load, read_table
from planmethod.problem.model import Problem
from planmethod.problem.names import is_point_name
from planmethod.problem.parameters import Parameter, Parameters
from planmethod.problem.reader import apply_variant
from planmethod.problem.source import parse
from planmethod.problem.toml import table_text
from planmethod.scripting.grid import Grid
from planmethod.scripting.size_fit import SizeFit, characteristics, fit_sizes
from planmethod.scripting.solution import Solution, solve
from planmethod.scripting.tolerance import Tolerance
from planmethod.solved.turn.determined import pose

if TYPE_CHECKING:
    from planmethod.render.backends.sheet import Sheet

Place: TypeAlias = npt.ArrayLike
"""Coordinates of a point: a pair, an array, or a complex number."""

TURN = {"from": 0, "count": 12}
"""Positions of a crank whose positions are not given: twelve of a turn."""


class Mechanism:
    """Linkage that is built in Python (рычажный механизм).

    Numbers are in metres (or in ``units``) and degrees, as in a problem file. Methods that build
    return the mechanism itself; `with_` returns another one.

    Parameters
    ----------
    name : str
    **head
        Keys of the file outside its tables: ``title``, ``source``, ``units``.

    Examples
    --------
    >>> import planmethod
    >>> m = planmethod.Mechanism("four-bar")
    >>> m = m.frame(A=(0, 0), D=(0.3, 0)).drive("1", omega=10)
    >>> m = m.link("1", A="B", length=0.1).link("2", B="C", length=0.25)
    >>> m = m.link("3", C="D", length=0.2).assemble(C="left of AD")
    >>> m
    Mechanism(four-bar: links 1, 2, 3; driver 1)
    >>> m.solve([30.0]).to_columns(["omega_3"])["omega_3"].round(3)
    array([-0.7])
    """

    def __init__(self, name: str = "mechanism", **head: Any) -> None:
        self.name = text("name", name)
        self._table: dict[str, Any] = _toml_value(head)
        self._source = name
        self._problem: Problem | None = None

    # Reading and writing ---------------------------------------------------------------------

    @classmethod
    def from_dict(cls, table: Mapping[str, Any], *, name: str = "mechanism") -> Mechanism:
        """Return the mechanism of a table that is built as a problem file is."""
        return cls(name, **table)

    @classmethod
    def from_toml(cls, toml: str, *, name: str = "mechanism") -> Mechanism:
        """Return the mechanism of the text of a problem file.

        Raises
        ------
        ProblemError
            The text is not TOML.
        """
        return cls.from_dict(parse(text("toml", toml), name=name), name=name)

    @classmethod
    def from_file(cls, path: str | Path, *, variant: str | None = None) -> Mechanism:
        """Return the mechanism of a problem file, with the numbers of a variant.

        Raises
        ------
        ProblemError
            The file is faulty.
        """
        return cls.from_problem(load(path, variant=variant))

    @classmethod
    def from_problem(cls, problem: Problem) -> Mechanism:
        """Return the mechanism of a problem that was read; its variants are left out."""
        table = {key: own for key, own in problem.source_table.items() if key != "variants"}
        made = cls(problem.name, **table)
        made._source, made._problem = problem.source_file, problem
        return made

    def to_dict(self) -> dict[str, Any]:
        """Return a copy of the table."""
        return deepcopy(self._table)

    def to_toml(self) -> str:
        """Return the text of the problem file."""
        return table_text(self._table)

    def __eq__(self, other: object) -> bool:
        """Return whether another mechanism has the same data, whatever its name."""
        return isinstance(other, Mechanism) and self._table == other._table

    __hash__ = None  # type: ignore[assignment]  # its data can be changed

    def __repr__(self) -> str:
        links, driver = self._table.get("links", {}), self._table.get("driver", {})
        told = f"links {', '.join(links)}" if links else "no links"
        listed = self._table.get("drivers") or ([driver] if isinstance(driver, dict) else [])
        names = [str(one["link"]) for one in listed if "link" in one]
        driven = f"; driver{'s' * (len(names) > 1)} {', '.join(names)}" if names else ""
        return f"Mechanism({self.name}: {told}{driven})"

    def _repr_svg_(self) -> str:
        """Return the picture that a notebook shows: the scheme."""
        from planmethod.render.backends import render
        from planmethod.render.sketch import assigned

        return render(assigned(Solution(self.problem)), "svg").decode()

    # Building --------------------------------------------------------------------------------

    def set(self, key: str, value: Any) -> Mechanism:
        """Set any entry of the file by its dotted key: ``set("cycle.output", "5")``."""
        level: dict[str, Any] = self._table
        *way, last = text("key", key).split(".")
        for part in way:
            level = level.setdefault(part, {})
            if not isinstance(level, dict):
                raise ArgumentError("{}: {} is not a table.", key, part)
        level[last] = _toml_value(value)
        self._problem = None
        return self

    def frame(
        self, *, guides: Mapping[str, tuple[str | Place, float]] | None = None, **points: Place
    ) -> Mechanism:
        """Add fixed points, and guides: through a point (its name or place) at an angle."""
        for name, place in points.items():
            self.set(f"frame.{name}", place)
        for name, (through, angle) in (guides or {}).items():
            self._at("frame", "guides")[name] = {"through": _toml_value(through), "angle": angle}
        return self

    def link(self, name: str, *points: str, length: float | None = None, **keys: Any) -> Mechanism:
        """Add a link.

        Parameters
        ----------
        name : str
        *points : str
            Its points, if no keyword names two of them.
        length : float, optional
            Distance of the two points that a keyword names.
        **keys
            ``A="B"`` names two points; other keys are those of a file: ``BC=0.1``, a third point
            ``D={"on": "BC", "at": 0.05}``.

        Raises
        ------
        ArgumentError
            A length without two points, or the other way round.
        """
        pairs = {key: value for key, value in keys.items() if _is_pair(key, value)}
        if len(pairs) != (length is not None) or (pairs and points):
            raise ArgumentError(
                'link {}: a length is that of two points: link("1", A="B", length=0.1).', name
            )
        table: dict[str, Any] = {"points": list(points)}
        for first, second in pairs.items():
            table |= {"points": [first, second], f"{first}{second}": length}
        third = [key for key, value in keys.items() if isinstance(value, Mapping)]
        table["points"] += [
            key for key in third if is_point_name(key) and key not in table["points"]
        ]
        table |= {key: value for key, value in keys.items() if key not in pairs}
        return self._add_link(name, table)

    def slider(
        self, name: str, *, on: str, at: str, along: str | None = None, **keys: Any
    ) -> Mechanism:
        """Add a slider (ползун, камень) with its pin ``at`` a point.

        Parameters
        ----------
        on : str
            A guide of the frame, or a link.
        along : str, optional
            Line of that link, ``CD``. Default: through its first two points.
        **keys
            Other keys of ``slides``: ``offset``, ``angle``, ``through``, ``length``.
        """
        slides: dict[str, Any] = {"on": on}
        host = self._table.get("links", {}).get(on)
        if along is None and host is not None and "through" not in keys and "centre" not in keys:
            along = "".join(host["points"][:2])
        if along is not None:
            slides["along"] = along
        return self._add_link(name, {"points": [at], "slides": slides | keys})

    def drive(self, link: str, *, additional: bool = False, **keys: Any) -> Mechanism:
        """Make a link the driver.

        Parameters
        ----------
        additional : bool
            It drives besides the links that drive already: ``[[drivers]]``.
        **keys
            Of ``[driver]``: ``omega`` (1/s) or ``n`` (rev/min), ``epsilon``, positions ``phi``; of
            a slider ``s``, ``v``, ``a``. A crank without positions has twelve of a turn.
        """
        placed = any(key not in ("omega", "n", "epsilon", "train", "root") for key in keys)
        phi = {} if placed else {"phi": TURN}
        own, table = _toml_value({"link": link, **phi, **keys}), self._at()
        given = table.pop("drivers", None) or ([table["driver"]] if "driver" in table else [])
        others = [one for one in given if additional and one.get("link") != link]
        if not others:
            return self.set("driver", own)
        table.pop("driver", None)
        return self.set("drivers", [*others, own])

    def assemble(self, **rules: Any) -> Mechanism:
        """Add rules, one for a point: ``E="right of D"``, ``B={"near": [0.1, 0.2]}``."""
        self._at("assembly").update(_toml_value(rules))
        return self

    def mass(self, link: str, mass: float, **keys: Any) -> Mechanism:
        """Give a link its mass, kg, and ``inertia`` (kg·m²), ``centre``."""
        self._at("dynamics", "links")[link] = _toml_value({"mass": mass, **keys})
        return self

    def load(self, name: str, **keys: Any) -> Mechanism:
        """Add a load with the keys of ``[[loads]]``: ``link``, ``at``, ``force``, ``angle``."""
        self._at().setdefault("loads", []).append(_toml_value({"name": name, **keys}))
        return self

    def spring(self, name: str, first: str, second: str, **keys: Any) -> Mechanism:
        """Add a spring, gas strut or damper between two links, ``"0"`` for the frame.

        Parameters
        ----------
        **keys
            Of ``[[springs]]``: ``points=("P", "S")`` or ``joint="B"``, ``stiffness``, ``length``
            (``angle``) or ``preload``, ``damping``, ``stops``.
        """
        entry = {"name": name, "links": [first, second], **keys}
        self._at().setdefault("springs", []).append(_toml_value(entry))
        return self

    def mesh(self, first: str, second: str, *, centres: Iterable[str], **keys: Any) -> Mechanism:
        """Put two links in mesh (зацепление): two wheels rigid with them, or a wheel and a rack.

        Parameters
        ----------
        first, second : str
            The links, ``"0"`` for the frame; a rack is the second.
        centres : iterable of str
            Centre of each wheel; of a rack, a point of its pitch line.
        **keys
            Of ``[[meshes]]``: ``z=(60, 20)`` with or without ``module`` (mm), or ``r=(0.9, 0.3)``;
            ``kind`` ``"internal"`` or ``"rack"``; ``phi``, the angles of both links in one
            assembled position; ``alpha``, ``s``, ``name``.

        Examples
        --------
        >>> import planmethod
        >>> m = planmethod.Mechanism("geared five-bar").frame(O=(0, 0), D=(1.2, 0))
        >>> m = m.link("1", O="A", length=0.4).link("2", A="C", length=1.0)
        >>> m = m.link("3", C="B", length=1.0).link("4", D="B", length=0.4)
        >>> m = m.mesh("1", "4", centres=("O", "D"), z=(60, 20)).assemble(C="left of AB")
        >>> m.drive("1", omega=2).solve([20]).links["4"].omega.round(9)
        array([-6.])
        """
        entry = {"links": [first, second], "centres": list(centres), **keys}
        self._table.setdefault("meshes", []).append(_toml_value(entry))
        self._problem = None
        return self

    def roll(self, link: str, *, on: str, radius: float, **keys: Any) -> Mechanism:
        """Make a link a wheel that rolls without sliding (качение) on a line or a circle.

        Parameters
        ----------
        on : str
            Guide of the frame, or the fixed centre of a circle.
        radius : float
            Radius of the wheel.
        **keys
            Of ``rolls``: ``centre``, a point of the link; ``circle``, the radius of that circle;
            ``side``, ``phi``, ``at``, ``by``.

        Raises
        ------
        UnknownNameError
            There is no such link.
        """
        links = self._at("links")
        table = links[known("link", link, links)]
        table["rolls"] = _toml_value({"on": on, "radius": radius, **keys})
        return self

    def _add_link(self, name: str, table: dict[str, Any]) -> Mechanism:
        self._at("links")[text("name", name)] = _toml_value(table)
        return self

    def _at(self, *keys: str) -> dict[str, Any]:
        """Return a table of the file that is about to be changed."""
        self._problem, level = None, self._table
        for key in keys:
            level = level.setdefault(key, {})
        return level

    # Results ---------------------------------------------------------------------------------

    @property
    def problem(self) -> Problem:
        """The problem, as a file with this text gives it.

        Raises
        ------
        ProblemError
            With all faults of the table.
        """
        if self._problem is None:
            table = deepcopy(self._table)
            self._problem = read_table(table, name=self.name, source=self._source)
        return self._problem

    def solve(
        self, positions: npt.ArrayLike | None = None, *, partial: bool = False, **settings: Any
    ) -> Solution:
        """Solve the mechanism: see `planmethod.solve`, whose arguments these are."""
        return solve(self.problem, positions=positions, partial=partial, **settings)

    def sheet(self, **settings: Any) -> Sheet:
        """Draw the sheet of the mechanism's own positions: see `Solution.sheet`."""
        return Solution(self.problem).sheet(**settings)

    @property
    def _parameters(self) -> Parameters:
        return Parameters(self.problem, pose)

    @property
    def parameters(self) -> dict[str, float]:
        """Numbers that `with_` can change, by name; SI and degrees."""
        return {name: one.value for name, one in self._parameters.by_name.items()}

    def with_(self, numbers: Mapping[str, Any] | None = None, /, **named: Any) -> Mechanism:
        """Return the mechanism with other numbers, and all that depends on them.

        Parameters
        ----------
        numbers : mapping, optional
            Those whose names are not words of Python: ``{"angle_x-x": 5}``.
        **named
            Numbers by the names of `parameters`, SI and degrees: ``l_AB`` or ``AB``, ``x_C``, the
            rate ``omega_1`` or ``omega``; of a point ``C=(0, -0.2)``.

        Raises
        ------
        UnknownNameError
            There is no such number.
        """
        given = self._values_by_parameter({**(numbers or {}), **named})
        overrides: dict[tuple[str, ...], Any] = {}
        for parameter, value in given.items():
            own = float(value) * parameter.per
            if isinstance(parameter.key[-1], int):
                *way, axis = parameter.key
                path = tuple(map(str, way))
                place = list(overrides.get(path) or _entry(self._table, way))
                overrides[path] = [own if k == axis else old for k, old in enumerate(place)]
            else:
                overrides[tuple(map(str, parameter.key))] = own
        return self.from_dict(apply_variant(self._table, overrides), name=self.name)

    def grid(
        self,
        positions: npt.ArrayLike,
        samples: Mapping[str, npt.ArrayLike] | None = None,
        /,
        **named: npt.ArrayLike,
    ) -> Grid:
        """Return the results of samples of numbers in positions, computed on request.

        Parameters
        ----------
        positions : array_like of shape (n,)
        samples, **named : array_like of shape (v,)
            Numbers by the names of `with_`; samples of several numbers have one length. The
            samples of a point are ``C=(xs, ys)``.

        Raises
        ------
        UnknownNameError
            There is no such number.
        ArgumentError
            The samples differ in length.
        """
        given = self._values_by_parameter({**(samples or {}), **named})
        columns = {one.name: reals(one.name, values) for one, values in given.items()}
        return Grid(self.problem, positions, columns)

    def tolerance(
        self,
        limits: Mapping[str, float],
        names: Iterable[str],
        positions: npt.ArrayLike | None = None,
        *,
        samples: int = 1000,
        seed: int = 0,
    ) -> Tolerance:
        """Return how deviations of sizes spread results: by derivatives and by samples.

        Parameters
        ----------
        limits : mapping of str to float
            Largest deviation to both sides, by the names of `with_`; of a point ``C`` of both
            coordinates.
        names : iterable of str
            Results by the names of `Solution.to_columns`.
        positions : array_like of shape (n,), optional
            Default: those of the mechanism.
        samples, seed : int
            See `Tolerance`.

        Raises
        ------
        UnknownNameError, UnknownQuantityError
            There is no such number or result.
        ArgumentError
            A deviation is not above zero.
        """
        own = self.problem.drive.positions if positions is None else positions
        every = {
            one.name: (one.value, float(limit))
            for name, limit in limits.items()
            for one in self._meant(name)
        }
        return Tolerance(self.problem, own, every, names, samples=samples, seed=seed)

    def characteristics(self, *names: str) -> dict[str, float]:
        """Return numbers that describe the mechanism, SI and degrees.

        Parameters
        ----------
        *names : str
            ``stroke(E)`` of a point on a guide, ``stroke(3)`` the swing of a link; ``K_v(E)`` the
            ratio of its strokes; ``pressure(E)`` the greatest pressure angle; ``v_E(30)`` any
            quantity in a position; ``max(v_E)``, ``min(x_E)``, ``mean(omega_3)`` over the turn.

        Raises
        ------
        FitError
            The mechanism has no such number.
        ArgumentError, UnknownNameError, UnknownQuantityError
            There is no such name.
        """
        return characteristics(self.problem, names)

    def fit(self, sizes: Iterable[str], targets: Mapping[str, Any]) -> SizeFit[Mechanism]:
        """Find sizes that reach targets, near the present sizes.

        Parameters
        ----------
        sizes : iterable of str
            Numbers by the names of `with_`; of a point ``C`` both coordinates.
        targets : mapping
            Values of `characteristics`; of a point in a position both coordinates,
            ``{"E(30)": (0.1, 0.2)}``. If there are more than sizes, the sum of the squares of the
            relative errors is the least.

        Returns
        -------
        SizeFit
            Its `SizeFit.mechanism` is there only if the targets are reached.

        Raises
        ------
        PlanMethodError
            The mechanism lacks a characteristic from the start.
        """
        # A set has another order in every run, and the last digits depend on it.
        ordered = sorted(sizes) if isinstance(sizes, set | frozenset) else list(sizes)
        start = {one.name: one.value for name in ordered for one in self._meant(name)}
        wanted: dict[str, float] = {}
        for name, value in targets.items():
            if np.ndim(value) or isinstance(value, complex):
                pair = zip("xy", _pair(name, value), strict=True)
                wanted |= {f"{axis}_{name}": float(own) for axis, own in pair}
            else:
                wanted[name] = float(value)
        if not (start and wanted):
            raise ArgumentError('Name sizes and targets: fit(["AB"], {{"stroke(E)": 0.2}}).')
        return fit_sizes(self, start, wanted)

    def _meant(self, name: str) -> tuple[Parameter, ...]:
        """Return the number that a name means, or both coordinates of a point.

        Raises
        ------
        UnknownNameError
        """
        parameters, driver = self._parameters, self.problem.drive.link
        for spelled in (name, f"l_{name}", f"{name}_{driver}"):
            if (one := parameters.find(spelled)) is not None:
                return (one,)
        place = [one for axis in "xy" if (one := parameters.find(f"{axis}_{name}")) is not None]
        if len(place) < 2:
            known("number", name, parameters.by_name)
        return tuple(place)

    def _values_by_parameter(self, numbers: Mapping[str, Any]) -> dict[Parameter, Any]:
        """Return the numbers of the file that names mean, with their values."""
        found: dict[Parameter, Any] = {}
        for name, value in numbers.items():
            meant = self._meant(name)
            values = (value,) if len(meant) == 1 else _pair(name, value)
            found |= dict(zip(meant, values, strict=True))
        return found


def _is_pair(key: str, value: Any) -> bool:
    return isinstance(value, str) and is_point_name(key) and is_point_name(value)


def _pair(name: str, value: Any) -> tuple[Any, Any]:
    """Return the coordinates of a point: a pair, or a complex number.

    Raises
    ------
    ArgumentError
    """
    if isinstance(value, complex):
        return value.real, value.imag
    if isinstance(value, Iterable) and not isinstance(value, str):
        x, *rest = value
        if len(rest) == 1:
            return x, rest[0]
    raise ArgumentError("{}: expected two coordinates, got {!r}.", name, value)


def _entry(table: Any, path: Iterable[str | int]) -> Any:
    for key in path:
        table = table[key]
    return table


def _toml_value(value: Any) -> Any:
    """Return a value as TOML gives it: NumPy's numbers and arrays, tuples and places are plain."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if isinstance(value, complex):
        return [value.real, value.imag]
    if isinstance(value, Mapping):
        return {str(key): _toml_value(own) for key, own in value.items()}
    if isinstance(value, list | tuple | range):
        return [_toml_value(own) for own in value]
    return value
