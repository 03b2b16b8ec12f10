"""Varied numbers of a file, and the round values of each (что варьируется)."""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Mapping, Sequence
from random import Random
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.problem.file_node import is_number
from planmethod.problem.formula import read_decimal
from planmethod.problem.names import split_names
from planmethod.problem.variants import key_of

COARSE = (
    *(1.0, 1.1, 1.2, 1.4, 1.6, 1.8, 2.0, 2.2, 2.5, 2.8),
    *(3.2, 3.6, 4.0, 4.5, 5.0, 5.6, 6.3, 7.1, 8.0, 9.0),
)
"""Ra20 of GOST 6636: speeds, loads, masses."""

BETWEEN = (
    *(1.05, 1.15, 1.3, 1.5, 1.7, 1.9, 2.1, 2.4, 2.6, 3.0),
    *(3.4, 3.8, 4.2, 4.8, 5.3, 6.0, 6.7, 7.5, 8.5, 9.5),
)
FINE = tuple(sorted((*COARSE, *BETWEEN)))
"""Ra40 of GOST 6636: lengths."""

STEP_DEG = 5
MIN_TEETH = 17
MAX_VALUES = 10_000
MAX_END = 1e9
"""Largest end of a range; no number of a file is larger."""

SPEEDS = ("n", "omega")
FORMULAS = ("x", "y", "r", "phi", "s", "theta")
"""Keys of ``[point]`` whose numbers are varied."""

_LITERAL = r"(?<![\w.^*])(?<!\^[-+(])(\d++(?:\.\d*+)?|\.\d++)(?![\w.])"
"""A number of a formula, without exponents."""


class VaryingError(PlanMethodError):
    """A key cannot be varied as requested."""

    exit_code = ExitCode.USAGE


class VariedKey(Struct, frozen=True):
    """A number of the file that is varied (варьируемое число).

    Attributes
    ----------
    name : str
        Its dotted key.
    base : float
        What the file has, in its unit.
    values : tuple of float
        What it may be.
    part : int or None
        Which coordinate of a point, or number of a formula, it is.
    of : str
        Key of the length in whose proportion it is; empty for a randomly drawn number.
    """

    name: str
    base: float
    values: tuple[float, ...] = ()
    part: int | None = None
    of: str = ""

    @property
    def spelling(self) -> str:
        """Its spelling after ``--vary``."""
        return self.name if self.part is None else f"{self.name}[{self.part}]"


def at(table: Mapping[str, Any], name: str) -> Any:
    """Return the value of a table at a dotted key; None if it has none."""
    found: Any = table
    for part in name.split("."):
        if isinstance(found, list):
            names = [entry.get("name") for entry in found if isinstance(entry, Mapping)]
            index = int(part) if part.isdecimal() else names.index(part) if part in names else -1
            found = found[index] if 0 <= index < len(found) else None
        else:
            found = found.get(part) if isinstance(found, Mapping) else None
    return found


# Which ------------------------------------------------------------------------------------------


def default_keys(table: Mapping[str, Any], spread: float) -> list[VariedKey]:
    """Return the numbers that are varied by default.

    Of a linkage lengths of links, the place and the speed of the driver, loads; of a train the
    wheels and the speeds; of a moving point the numbers of its formulas.

    Raises
    ------
    VaryingError
        The file has none of them.
    """
    return _require_some(
        [replace(one, values=_around(one, spread)) for one in _default_keys(table)]
    )


def _default_keys(table: Mapping[str, Any]) -> Iterator[VariedKey]:
    for link, body in _below(table, "links"):
        for key, value in _below({"": body}, ""):
            if len(split_names(key)) == 2 and is_number(value) and value:
                yield VariedKey(f"links.{link}.{key}", value)
    driver = at(table, "driver") or {}
    for key in ("phi", "s", *SPEEDS, "v", "epsilon", "a"):
        if is_number(driver.get(key)) and (driver[key] or key in ("phi", "s")):
            yield VariedKey(f"driver.{key}", driver[key])
    for index, load in enumerate(table.get("loads", ())):
        for key in ("force", "couple"):
            if is_number(load.get(key)) and load[key]:
                yield VariedKey(f"loads.{index}.{key}", load[key])
    if "links" in table:
        return
    for key in ("wheels", *SPEEDS):
        for label, value in _below(table.get("gears"), key):
            for inner in ("z", "r") if isinstance(value, Mapping) else ("",):
                number = value.get(inner) if inner else value
                if is_number(number) and number:
                    yield VariedKey(".".join(filter(None, ("gears", key, label, inner))), number)
    for key, value in _below(table, "point"):
        if key in FORMULAS and isinstance(value, str):
            for part, literal in enumerate(re.findall(_LITERAL, value)):
                yield VariedKey(f"point.{key}", float(literal), part=part)
        for inner in ("radius", "r") if key == "wheel" else ():
            if is_number(at(table, f"point.wheel.{inner}")):
                yield VariedKey(f"point.wheel.{inner}", at(table, f"point.wheel.{inner}"))


def _below(table: object, key: str) -> Iterator[tuple[str, Any]]:
    below = table.get(key) if isinstance(table, Mapping) else None
    if isinstance(below, Mapping):
        yield from below.items()


def parse_vary(table: Mapping[str, Any], text: str, spread: float) -> list[VariedKey]:
    """Return what ``--vary`` names: ``links.1.OA,driver.phi=0..90``.

    Raises
    ------
    VaryingError
        A key is not a number of the file, or has no round values.
    """
    found = []
    for told in filter(None, (part.strip() for part in text.split(","))):
        written, _, span = (part.strip() for part in told.partition("="))
        found += _read(table, written, span, spread)
    return _require_some(found)


def _require_some(keys: list[VariedKey]) -> list[VariedKey]:
    if not keys:
        raise VaryingError("found no numbers to vary: name numbers of the file after --vary")
    return keys


def _read(table: Mapping[str, Any], written: str, span: str, spread: float) -> list[VariedKey]:
    key, names = key_of(table, written)
    bare, _, part = (key or written).partition("[")
    value = at(table, bare)
    if isinstance(value, str) and bare.startswith("point."):
        found = [one for one in _default_keys(table) if one.name == bare]
        chosen = [one for one in found if not part or one.part == int(part[:-1])]
    elif isinstance(value, list) and part and is_number(value[int(part[:-1])]):
        chosen = [VariedKey(bare, value[int(part[:-1])], part=int(part[:-1]))]
    else:
        chosen = [VariedKey(bare, value)] if is_number(value) and not part else []
    if not chosen:
        raise VaryingError(
            "--vary {}: the file has no such number. Known: {}, and dotted keys of numbers.",
            written,
            ", ".join(dict.fromkeys([*(one.spelling for one in _default_keys(table)), *names])),
        )
    if not span:
        return [replace(one, values=_around(one, spread)) for one in chosen]
    ends = re.fullmatch(r"([-\d.e]*\d)\.\.([-\d.e]+)", span)
    low, high = map(read_decimal, ends.groups()) if ends else (None, None)
    if low is None or high is None or not -MAX_END <= low <= high <= MAX_END:
        raise VaryingError("--vary {}={}: FROM..TO is expected, 40..80", written, span)
    made = [replace(one, values=_between(one, float(low), float(high))) for one in chosen]
    if not all(one.values for one in made):
        raise VaryingError(
            "--vary {}={}: the range contains no round number; widen it", written, span
        )
    return made


# Round values -----------------------------------------------------------------------------------


def _is_angle(name: str) -> bool:
    parts = name.split(".")
    return parts[:2] == ["driver", "phi"] or "angle" in parts


def _is_count(one: VariedKey) -> bool:
    first = one.name.split(".")[:2]
    return first[0] == "gears" and first[1] in ("wheels", "satellites") and one.name[-2:] != ".r"


def _around(one: VariedKey, spread: float) -> tuple[float, ...]:
    """Return the round values about that of the file; the crank goes all round."""
    if one.name == "driver.phi":
        return _between(one, 0, 360 - STEP_DEG)
    if _is_angle(one.name) or not one.base:
        return _between(one, one.base - 90 * spread, one.base + 90 * spread)
    ends = sorted((one.base * (1 - spread), one.base * (1 + spread)))
    return _between(one, *ends) or (one.base,)


def _between(one: VariedKey, low: float, high: float) -> tuple[float, ...]:
    """Return the round values in a range."""
    if _is_angle(one.name):
        return tuple(_multiples(STEP_DEG, low, high))
    if _is_count(one):
        fewest = MIN_TEETH if ".wheels." in one.name else 1
        return tuple(_multiples(1, max(low, min(fewest, one.base)), high))
    if one.name.startswith("gears.wheels."):  # radii: sums of them must be equal
        return tuple(_multiples(_step(one.base), low, high))
    if one.name.startswith("point.") and one.part is not None and one.base == int(one.base):
        least = min(2, one.base)  # 1*t and t/1 are not textbook formulas
        own = tuple(_multiples(1, max(least, low), high))
        return own if len(own) > 2 else tuple(_multiples(1, max(least, one.base - 1), one.base + 2))
    if low <= 0 <= high:
        return tuple(_multiples(_step(max(-low, high)), low, high))
    series = FINE if _is_length(one.name) else COARSE
    return tuple(sorted(_of_series(series, low, high)))


def _is_length(name: str) -> bool:
    return name.startswith(("links.", "frame.")) or name in ("driver.s", "point.wheel.radius")


def _step(value: float) -> float:
    """Return the largest of 1, 5, 10, 50, ... that an eighth of a number is not below."""
    power = math.floor(math.log10(abs(value) / 8 or 1.0))
    one, five = (float(f"{digit}e{power}") for digit in (1, 5))
    return five if five * 8 <= abs(value) * (1 + 1e-9) else one


def _multiples(step: float, low: float, high: float) -> Iterator[float]:
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    for number in range(first, min(last, first + MAX_VALUES) + 1):
        value = float(f"{number * step:.9g}")
        yield int(value) if value == int(value) else value


def _of_series(series: Sequence[float], low: float, high: float) -> Iterator[float]:
    """Yield members of a series, those of a negative range with their sign."""
    turn = -1 if high < 0 else 1
    least, most = sorted((turn * low, turn * high))
    for power in range(math.floor(math.log10(least)), math.floor(math.log10(most)) + 1):
        for member in series:
            value = float(f"{member}e{power}")
            if least * (1 - 1e-9) <= value <= most * (1 + 1e-9):
                yield turn * (int(value) if value == int(value) else value)


# By lot -----------------------------------------------------------------------------------------


def with_followers(table: Mapping[str, Any], chosen: Sequence[VariedKey]) -> list[VariedKey]:
    """Return the varied numbers, and the points on varied links, which keep their proportion."""
    names, found = {one.name for one in chosen}, list(chosen)
    for link, body in _below(table, "links"):
        for point, place in _below({"": body}, ""):
            if isinstance(place, Mapping) and is_number(place.get("at")) and "on" in place:
                of = f"links.{link}.{place['on']}"
                own = f"links.{link}.{point}.at"
                if of in names and own not in names:
                    found.append(VariedKey(own, place["at"], of=of))
    return found


class ValueSampler:
    """Random values, more often those with which candidates did well (жребий).

    Parameters
    ----------
    chosen : sequence of VariedKey
    by : Random
    """

    def __init__(self, chosen: Sequence[VariedKey], by: Random) -> None:
        self.by = by
        self.free = [one for one in chosen if not one.of]
        self.followers = [one for one in chosen if one.of]
        self._weights = {one.spelling: [1.0] * len(one.values) for one in self.free}
        self._counts = {one.spelling: [1] * len(one.values) for one in self.free}

    def draw(self) -> dict[VariedKey, float]:
        """Return one value of every randomly drawn number."""
        found: dict[VariedKey, float] = {}
        for one in self.free:
            worth = zip(self._weights[one.spelling], self._counts[one.spelling], strict=True)
            found[one] = self.by.choices(one.values, [w / n for w, n in worth])[0]
        return found

    def with_followers(self, values: dict[VariedKey, float]) -> dict[VariedKey, float]:
        """Return values with those that are in proportion to them."""
        lengths = {one.name: value / one.base for one, value in values.items()}
        own = {one: float(f"{one.base * lengths[one.of]:.2g}") for one in self.followers}
        return {**values, **own}

    def learn(self, values: Mapping[VariedKey, float], weight: float) -> None:
        """Record the result of a candidate: 1 for a variant, 0 for a worthless one."""
        for one in self.free:
            if values[one] in one.values:
                at = one.values.index(values[one])
                self._weights[one.spelling][at] += weight
                self._counts[one.spelling][at] += 1


def overrides(table: Mapping[str, Any], values: Mapping[VariedKey, float]) -> dict[str, Any]:
    """Return what a variant lays over the file, by dotted key."""
    found: dict[str, Any] = {}
    parts: dict[str, dict[int, float]] = {}
    for one, value in values.items():
        if one.part is None:
            found[one.name] = value
        else:
            parts.setdefault(one.name, {})[one.part] = value
    for name, own in parts.items():
        whole = at(table, name)
        if isinstance(whole, str):
            count = iter(range(len(whole)))
            found[name] = re.sub(
                _LITERAL, lambda m: f"{own.get(next(count), m[0])}", whole  # noqa: B023
            )  # fmt: skip
        else:
            found[name] = [own.get(index, value) for index, value in enumerate(whole)]
    return found
