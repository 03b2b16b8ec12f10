"""Varied numbers of a file, their round values, candidates (что варьируется)."""

from __future__ import annotations

import math
import re
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.gears.coaxiality import coaxial_paths
from planmethod.gears.motion import TrainMotion
from planmethod.kind import ProblemKind
from planmethod.problem.faults import is_number
from planmethod.problem.formula import read_decimal
from planmethod.problem.names import segment, split_names
from planmethod.problem.reader import key_of
from planmethod.problem.records import KindProblem
from planmethod.problem.source import parse, read_source
from planmethod.problem.toml import value_text

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

    Of a linkage the data of its synthesis, lengths of links, the place and the speed of the driver,
    loads; of a train the wheels and the speeds; of a moving point the numbers of its formulas.

    Raises
    ------
    VaryingError
        The file has none of them.
    """
    return _require_some(
        [replace(one, values=_around(one, spread)) for one in _default_keys(table)]
    )


def _default_keys(table: Mapping[str, Any]) -> Iterator[VariedKey]:
    for key, value in _below(table, "synthesis"):
        if is_number(value) and value:
            yield VariedKey(f"synthesis.{key}", value)
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
    for index, spring in enumerate(table.get("springs", ())):
        for key in ("stiffness", "damping", "preload"):
            if is_number(spring.get(key)) and spring[key]:
                yield VariedKey(f"springs.{index}.{key}", spring[key])
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


LEAST_RATIO = 1.05
"""Least ratio of the times of both strokes in a variant; it is 1 of equal strokes."""

_SYNTHESIS_ANGLES = ("synthesis.swing", "synthesis.pressure", "synthesis.beta")


def _is_angle(name: str) -> bool:
    parts = name.split(".")
    return parts[:2] == ["driver", "phi"] or "angle" in parts or name in _SYNTHESIS_ANGLES


def _is_count(one: VariedKey) -> bool:
    first = one.name.split(".")[:2]
    return first[0] == "gears" and first[1] in ("wheels", "satellites") and one.name[-2:] != ".r"


def _around(one: VariedKey, spread: float) -> tuple[float, ...]:
    """Return the round values about that of the file; the crank goes all round."""
    if one.name == "driver.phi":
        return _between(one, 0, 360 - STEP_DEG)
    if _is_angle(one.name) or not one.base:
        return _between(one, one.base - 90 * spread, one.base + 90 * spread)
    low, high = sorted((one.base * (1 - spread), one.base * (1 + spread)))
    if one.name == "synthesis.K_v":
        low = max(low, min(one.base, LEAST_RATIO))
    return _between(one, low, high) or (one.base,)


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
    return name.startswith(("links.", "frame.", "synthesis.")) or name in (
        "driver.s",
        "point.wheel.radius",
    )


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


WHEEL = "gears.wheels."

Row = dict[str, Fraction]
"""Coefficients of an equation by labels; what they add up to is under the empty one."""

Solved = tuple[str, Row]
"""The wheel that an equation is solved for, with coefficient 1, and the equation."""


def coaxial_rows(motion: TrainMotion, varied: Sequence[str]) -> list[Solved]:
    """Return the equations that varied wheels have to keep, each solved for one of them.

    An equation with a wheel whose teeth the reader determines is skipped: it follows. So is one
    with wheels whose shifts set the centre distance.

    Parameters
    ----------
    varied : sequence of str
        Labels of the wheels.
    """
    found: list[Row] = []
    sizes, unknown = motion.axes.sizes, set(motion.train.unknown)
    for _, _, (one, other) in coaxial_paths(motion):
        row: Row = {}
        for sign, terms in ((1, one), (-1, other)):
            for turn, label in terms:
                share = motion.train.module_ratio(label)
                row[label] = row.get(label, Fraction(0)) + sign * turn * share
        if sum(factor * sizes[label] for label, factor in row.items()):
            continue
        if unknown & {label for label, factor in row.items() if factor}:
            continue
        given = sum((factor * sizes[x] for x, factor in row.items() if x not in varied), Fraction())
        found.append({**{x: f for x, f in row.items() if f and x in varied}, "": -given})
    return _solved(found, {label: sizes[label] for label in varied})


def _solved(rows: list[Row], sizes: Mapping[str, Fraction]) -> list[Solved]:
    """Solve equations for wheels that are in no other one, the largest first."""
    done: list[Solved] = []
    for row in rows:
        for main, other in done:
            row = _less(row, other, main)
        left = [label for label, factor in row.items() if label and factor]
        if left:
            main = max(left, key=lambda label: (sizes[label], label))
            row = {label: factor / row[main] for label, factor in row.items()}
            done = [*((its, _less(other, row, main)) for its, other in done), (main, row)]
    return done


def _less(row: Row, solved: Row, label: str) -> Row:
    """Return a row without a label that another one is solved for."""
    factor = row.get(label, Fraction(0))
    every = dict.fromkeys((*row, *solved))
    return {x: row.get(x, Fraction(0)) - factor * solved.get(x, Fraction(0)) for x in every}


def make_coaxial(
    values: Mapping[VariedKey, float], rows: Sequence[Solved], sizes: Mapping[str, Fraction]
) -> dict[VariedKey, float] | None:
    """Return values with coaxial wheels; None if a resulting wheel has no permitted size."""
    made = dict(values)
    wheels = {label_of(one): one for one in made if one.name.startswith(WHEEL)}
    per = {label: _exact(one.base) / sizes[label] for label, one in wheels.items()}
    for main, row in rows:
        size = row[""]
        for label, factor in row.items():
            if factor and label not in ("", main):
                size -= factor * _exact(made[wheels[label]]) / per[label]
        told = size * per[main]
        value: float = int(told) if told.denominator == 1 else float(told)
        if value not in wheels[main].values:
            return None
        made[wheels[main]] = value
    return made


def label_of(one: VariedKey) -> str:
    """Return the wheel that a key is of."""
    return one.name.removeprefix(WHEEL).removesuffix(".z").removesuffix(".r")


def _exact(value: float) -> Fraction:
    return Fraction(repr(value))


Overrides = Mapping[str, Any]
"""Overrides of the file in a variant, by dotted key."""


class VariantCandidates:
    """A file whose variants are removed, to read others in their place (файл с кандидатами).

    Attributes
    ----------
    path : Path
    kind : ProblemKind
    text : str
        The file without its variants.
    table : mapping
        The same as parsed.

    Raises
    ------
    ProblemError, VaryingError
        The file is faulty, or its variants cannot be removed from its text.
    """

    def __init__(self, path: Path, kind: ProblemKind[Any]) -> None:
        self.path, self.kind = path, kind
        text = read_source(path)
        whole = parse(text, name=str(path))
        self.text = without_variants(text) if "variants" in whole else text
        self.table = parse(self.text, name=str(path))
        if self.table != {key: value for key, value in whole.items() if key != "variants"}:
            raise VaryingError(
                "{}: its [variants] are between other tables; move them to the end of the file",
                path,
            )

    def read(self, variants: Mapping[str, Overrides]) -> Iterator[KindProblem | PlanMethodError]:
        """Yield the problem of every variant, or its error; without variants, the file itself."""
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / self.path.name
            path.write_text(self.with_variants(variants), encoding="utf-8")
            names: list[str | None] = [*variants] or [None]
            while names:
                each = self.kind.load_each(path, tuple(names))
                try:
                    for problem in each:
                        del names[0]
                        yield problem
                except PlanMethodError as error:
                    del names[0]
                    yield error

    def with_variants(self, variants: Mapping[str, Overrides]) -> str:
        """Return the text of the file with other variants."""
        if not variants:
            return self.text
        return f"{self.text.rstrip()}\n\n{toml_of(variants)}"


def without_variants(text: str) -> str:
    """Return the text of a problem file without its variants."""
    text = re.sub(r"(?m)^[ \t]*variants[ \t]*=[ \t]*(\"[^\"\n]*\"|'[^'\n]*')[^\n]*\n?", "", text)
    kept, inside = [], False
    for line in text.splitlines(keepends=True):
        header = re.fullmatch(_HEADER, line)
        if header is not None:
            inside = header[1].strip("\"'") == "variants"
        if not inside:
            kept.append(line)
    return "".join(kept)


_HEADER = r"\s*\[\[?\s*(\"[^\"]*\"|'[^']*'|[^\[\]\s.,\"']++)[^\[\],]*\]\]?\s*+(?:#.*)?+\s*"


def toml_of(variants: Mapping[str, Overrides]) -> str:
    """Return the table ``[variants]`` of a problem file."""
    lines = ["[variants]"]
    for name, own in variants.items():
        text = ", ".join(f'"{key}" = {value_text(value)}' for key, value in own.items())
        lines.append(f"{segment(name)} = {{ {text} }}")
    return "\n".join(lines) + "\n"


def csv_of(variants: Mapping[str, Overrides], lang: str) -> str:
    """Return the table that ``variants = "table.csv"`` names, as Excel of a language has it.

    Raises
    ------
    VaryingError
        A value that is a list has no column.
    """
    separator, decimal = (";", ",") if lang == "ru" else (",", ".")
    heads: dict[str, None] = {}
    rows: list[dict[str, str]] = []
    for own in variants.values():
        row: dict[str, str] = {}
        for key, value in own.items():
            if isinstance(value, list):
                parts = key.split(".")
                if parts[0] != "frame" or len(parts) != 2:
                    raise VaryingError("{} has no column in a CSV table; write a TOML file", key)
                row |= {
                    f"{axis}{parts[1]}": _cell(v, decimal)
                    for axis, v in zip("xy", value, strict=True)
                }
            else:
                row[key] = _cell(value, decimal)
        heads |= dict.fromkeys(row)
        rows.append(row)
    lines = [["variant", *heads]]
    lines += [
        [name, *(row.get(head, "") for head in heads)]
        for name, row in zip(variants, rows, strict=True)
    ]
    return "".join(
        separator.join(_quoted(cell, separator) for cell in line) + "\n" for line in lines
    )


def _cell(value: Any, decimal: str) -> str:
    return value if isinstance(value, str) else repr(value).replace(".", decimal)


def _quoted(cell: str, separator: str) -> str:
    special = separator in cell or '"' in cell
    return '"' + cell.replace('"', '""') + '"' if special else cell
