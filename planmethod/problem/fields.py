"""Single values of a problem file: types, bounds and the wording of their faults."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from enum import Enum
from typing import Any, TypeAlias, TypeGuard, TypeVar

from planmethod.errors import Fault
from planmethod.languages import HIDDEN, translate
from planmethod.problem.formula import FormulaError, evaluate_arithmetic
from planmethod.problem.model import Drive
from planmethod.problem.names import (
    UNITS,
    describe_lookalikes,
    fold,
    is_point_name,
    joined,
    listed,
    lookalikes,
    nearest_name,
    nearest_name_hint,
    segment,
    short,
    split_pair,
)
from planmethod.problem.typos import INSTEAD, value_hint
from planmethod.problem.units import expected_unit, measured, read_unit

FAULT_LIMIT = 100
"""More faults than this are counted, not listed."""

Table = Mapping[str, Any]
M = TypeVar("M", bound=Enum)


class Faults:
    """Collect the faults of a file, so that all are reported at once (сбор ошибок).

    Attributes
    ----------
    unit : str
        Unit of the lengths of the file, a key of `UNITS`.
    stated : dict of str to str
        Arithmetic in place of a number, as written, by path.
    vanished : dict of str to float
        Numbers that are read as zero, by path: speeds, forces and the like, of which that matters.
    """

    def __init__(self) -> None:
        self.unit = "m"
        self.stated: dict[str, str] = {}
        self.vanished: dict[str, float] = {}
        self._found: list[Fault] = []
        self.count = 0

    def copy(self) -> Faults:
        """Return an independent copy."""
        other = Faults()
        other.unit, other.stated = self.unit, dict(self.stated)
        other.vanished = dict(self.vanished)
        other._found, other.count = list(self._found), self.count
        return other

    def __len__(self) -> int:
        return self.count

    def __bool__(self) -> bool:
        return self.count > 0

    def add(self, path: str, message: str, hint: str = "") -> None:
        """Note a fault; the same fault is noted only once."""
        fault = Fault(path, message, hint)
        if fault in self._found:
            return
        self.count += 1
        if self.count <= FAULT_LIMIT:
            self._found.append(fault)

    def expected(self, path: str, expected: str, value: object, hint: str = "") -> None:
        """Note that ``expected`` was expected instead of a value."""
        self.add(path, translate("expected {}, got {}", expected, show(value)), hint)

    def exceeds(self, path: str, message: str, count: int, limit: int) -> bool:
        """Note an exceeded limit, ``{} links, the limit is {}``; return whether it is exceeded."""
        if count > limit:
            self.add(path, translate(message, count, limit))
        return count > limit

    @property
    def listed(self) -> tuple[Fault, ...]:
        """Faults in the order of finding."""
        left = self.count - len(self._found)
        if left <= 0:
            return tuple(self._found)
        return (*self._found, Fault("", translate("and {} more faults", left), "Fix these first."))


def show(value: object) -> str:
    """Describe a TOML value for a message: ``the string 'abc'``, ``the integer 3``, ``a table``."""
    if isinstance(value, bool):
        return translate("the boolean {}", str(value).lower())
    if isinstance(value, str):
        return translate("the string {!r}", short(value))
    if isinstance(value, int):
        return translate("the integer {}", value) if abs(value) < 10**15 else "a huge integer"
    if isinstance(value, float):
        return translate("the number {:g}", value)
    if isinstance(value, Mapping):
        return "a table"
    if isinstance(value, list):
        return translate("a list of {}", len(value)) if value else "an empty list"
    return "a date or time"


def is_number(value: object) -> TypeGuard[int | float]:
    """Return whether a TOML value is a number (a boolean is not)."""
    return isinstance(value, int | float) and not isinstance(value, bool)


TINY = 1e-30
"""Numbers nearer to zero are read as zero: squares and quotients of them leave the range of
numbers, and programs write so the rounding of a zero."""


def read_number(
    faults: Faults,
    path: str,
    value: object,
    expected: str = "a number",
    *,
    low: float = -1e9,
    high: float = 1e9,
    positive: bool = False,
    offset: bool = False,
    hint: str = "Check the unit: the file is in SI units and degrees.",
) -> float | None:
    """Read a finite number within bounds; None after noting a fault.

    Parameters
    ----------
    expected : str
        Expected value, with its unit: ``a length in metres``.
    positive : bool
        Zero and negative numbers are then reported as such, before the bounds are checked.
    offset : bool
        Whether it is a coordinate or an angle: a nearly zero value becomes zero without a note.
    hint : str
        What to do about a number that is out of bounds.
    """
    number = read_measured(faults, path, value, expected)
    if number is not None and not math.isfinite(number):
        return None
    mistyped = "" if number is not None else value_hint(value)
    value = value if number is None else number
    if isinstance(value, str) and not mistyped and any(map(str.isdecimal, value)):
        try:
            number = evaluate_arithmetic(value)
        except FormulaError as error:
            phrase = translate("expected {}, got {}: {}", expected, show(value), str(error))
            faults.add(path, phrase, error.hint)
            return None
        faults.stated[path], value = value, number
    if not is_number(value):
        faults.expected(path, expected, value, mistyped)
        return None
    try:
        number = float(value)
    except OverflowError:
        number = math.inf if value > 0 else -math.inf
    if not math.isfinite(number):
        faults.add(
            path, translate("expected {}, got {:g}", expected, number), "The number must be finite."
        )
        return None
    if positive and number < TINY:
        small = "So small a number is zero here: check its power of ten." if number > 0 else ""
        faults.add(path, translate("expected {} greater than 0, got {:g}", expected, number), small)
        return None
    if 0 < abs(number) < TINY:
        if not offset:
            faults.vanished[path] = number
        number = 0.0
    if not low <= number <= high:
        faults.add(
            path,
            translate("expected {} from {:g} to {:g}, got {:g}", expected, low, high, number),
            hint,
        )
        return None
    return number


def read_measured(faults: Faults, path: str, value: object, expected: str) -> float | None:
    """Return a number that has a unit, ``"4 in"``, in the unit that is expected.

    Returns
    -------
    float or None
        None if it is not a text of a number and a unit; NaN after noting a fault.
    """
    told = measured(value) if isinstance(value, str) else None
    if told is None:
        return None
    unit = expected_unit(expected)
    number = told.in_unit(unit) if unit else None
    if number is None:
        wanted = read_unit(unit) if unit else None
        if wanted is None:
            hint = translate("Write {} alone: it has no unit.", told.number)
        elif wanted.dimension == told.of.dimension:
            hint = translate("Write {} for turns, or {} for an angle a second.", "rpm", "rad/s")
        else:
            hint = translate("{} is a unit of {}: check it.", told.unit, told.quantity)
        faults.expected(path, expected, value, hint)
        return math.nan
    wanted = read_unit(unit)
    if not is_plain_number(told.number) and wanted is not None and told.of.factor == wanted.factor:
        faults.stated[path] = told.number
    return number


def is_plain_number(text: str) -> bool:
    """Return whether a text is a plain number, not arithmetic."""
    return re.fullmatch(r"[-+−]?\d+(?:[.,]\d+)?", text) is not None


def read_integer(faults: Faults, path: str, value: object, low: int, high: int) -> int | None:
    """Read a whole number within bounds; None after noting a fault."""
    if isinstance(value, bool) or not isinstance(value, int) or not low <= value <= high:
        faults.expected(path, translate("a whole number from {} to {}", low, high), value)
        return None
    return value


def read_flag(faults: Faults, path: str, value: object) -> bool | None:
    """Read true or false; None after noting a fault."""
    if isinstance(value, bool):
        return value
    hint = "Write it without quotes." if value in ("true", "false") else ""
    faults.expected(path, "true or false", value, hint)
    return None


_EXPECTED_TEXTS: Mapping[str, Mapping[str, str]] = {
    "m": {
        "length": "a length in metres",
        "distance": "a distance in metres",
        "coordinate": "a coordinate in metres",
        "place": "[x, y] in metres",
    },
    "cm": {
        "length": "a length in centimetres",
        "distance": "a distance in centimetres",
        "coordinate": "a coordinate in centimetres",
        "place": "[x, y] in centimetres",
    },
    "in": {
        "length": "a length in inches",
        "distance": "a distance in inches",
        "coordinate": "a coordinate in inches",
        "place": "[x, y] in inches",
    },
    "mm": {
        "length": "a length in millimetres",
        "distance": "a distance in millimetres",
        "coordinate": "a coordinate in millimetres",
        "place": "[x, y] in millimetres",
    },
}
"""Expected values of lengths, by the unit of the file."""


def read_length(faults: Faults, path: str, value: object) -> float | None:
    """Read a length of a link in the unit of the file; it is returned in m."""
    return read_metres(faults, path, value, "length", low=1e-9, positive=True)


def read_coordinate(
    faults: Faults, path: str, value: object, kind: str = "distance"
) -> float | None:
    """Read a coordinate or a signed distance in the unit of the file; it is returned in m."""
    return read_metres(faults, path, value, kind, low=-1e6)


def read_metres(
    faults: Faults,
    path: str,
    value: object,
    kind: str = "distance",
    *,
    low: float,
    high: float = 1e6,
    positive: bool = False,
) -> float | None:
    """Read a length in the unit of the file; it and its bounds are in m.

    Parameters
    ----------
    kind : str
        ``length``, ``distance`` or ``coordinate``: how it is called.
    """
    per, what = UNITS[faults.unit], _EXPECTED_TEXTS[faults.unit][kind]
    number = read_number(
        faults, path, value, what, low=low * per, high=high * per, positive=positive,
        offset=not positive,
    )  # fmt: skip
    return None if number is None else number / per


def read_units(faults: Faults, table: Table) -> None:
    """Read ``units``, the unit of all lengths of a file."""
    if "units" in table:
        faults.unit = read_word(faults, "units", table["units"], UNITS) or faults.unit


def read_angle(faults: Faults, path: str, value: object) -> float | None:
    """Read an angle, degrees."""
    radians = re.sub("π|pi", "180", value) if isinstance(value, str) else value
    if isinstance(value, str) and radians != value and measured(value) is None:
        hint = translate('pi is 180 degrees: write "{}".', radians)
        faults.expected(path, "an angle in degrees", value, hint)
        return None
    return read_number(
        faults, path, value, "an angle in degrees", low=-36000, high=36000, offset=True
    )


def read_text(faults: Faults, path: str, value: object, *, limit: int) -> str | None:
    """Read a line of text without control characters."""
    if not isinstance(value, str):
        hint = (
            "Put it in quotes."
            if is_number(value) or show(value) == translate("a date or time")
            else ""
        )
        faults.expected(path, "a string", value, hint)
        return None
    if len(value) > limit:
        faults.add(
            path,
            translate("the text has {} characters, the limit is {}", len(value), limit),
            "Shorten it.",
        )
        return None
    bad = re.search(f"[\t\n]|{HIDDEN}", value)
    if bad is not None:
        faults.add(
            path,
            translate("the text has the control character U+{:04X}", ord(bad[0])),
            "Write it on one line, without tabs.",
        )
        return None
    return value


def read_table(faults: Faults, path: str, value: object, example: str = "") -> Table | None:
    """Read a table."""
    if isinstance(value, Mapping):
        return value
    hint = translate("For example: {}", example) if example else ""
    faults.expected(path, "a table", value, hint)
    return None


def read_place(faults: Faults, path: str, value: object) -> complex | None:
    """Read ``[x, y]``, m."""
    if not isinstance(value, list) or len(value) != 2:
        commas = isinstance(value, list) and len(value) in (3, 4)
        hint = "The decimal sign is a point: [0.5, 0.3]." if commas else ""
        faults.expected(
            path, _EXPECTED_TEXTS[faults.unit]["place"], value, hint or value_hint(value)
        )
        return None
    x = read_coordinate(faults, f"{path}[0]", value[0], "coordinate")
    y = read_coordinate(faults, f"{path}[1]", value[1], "coordinate")
    return None if x is None or y is None else complex(x, y)


def read_keys(faults: Faults, path: str, table: Table, known: Iterable[str]) -> dict[str, Any]:
    """Return the known keys of a table; the others are faults, with the nearest name."""
    names = tuple(known)
    kept: dict[str, Any] = {}
    for key, value in table.items():
        name = unmask(faults, joined(path, segment(key)), key) if key not in names else key
        if name in names:
            kept[name] = value
            continue
        report_unknown(faults, joined(path, segment(key)), name, names)
    return kept


def report_unknown(
    faults: Faults, path: str, name: str, known: Iterable[str], *, message: str = "unknown key"
) -> None:
    """Note an unknown key or name, as ``unknown link '{}'``, with the nearest known one."""
    names = tuple(known)
    # the nearest name is searched for only if the fault will be listed
    guess = nearest_name(name, names) if faults.count < FAULT_LIMIT else None
    hint = translate("Did you mean '{}'?", guess) if guess else ""
    if "omega" in names:
        hint = INSTEAD.get(name, hint)
    if not hint and names:
        hint = translate("Known here: {}.", listed(names))
    faults.add(path, translate(message, short(name)), hint)


def require_turning(
    faults: Faults, path: str, drive: Drive | None, slides: str, hint_at_rest: str
) -> None:
    """Note that a table needs a rotating crank, with a hint for the actual driver."""
    if drive is not None and drive.cam_drive is not None:
        what = "a cam's follower moves link {}, which does not turn all round"
        faults.add(path, translate(what, drive.link), slides)
    elif drive is not None and drive.actuator is not None:
        what = "the actuator {} moves link {}, which does not turn all round"
        faults.add(path, translate(what, "".join(drive.actuator), drive.link), slides)
    elif drive is not None and not drive.is_crank:
        faults.add(path, translate("link {} slides and has no turn", drive.link), slides)
    elif drive is not None and drive.is_at_rest:
        faults.add(path, "the crank stands", hint_at_rest)


def unmask(faults: Faults, path: str, name: str) -> str:
    """Note the look-alike letters of a name and return the intended name."""
    if lookalikes(name) and fold(name).isascii():
        meant = short(fold(name))
        faults.add(
            path, describe_lookalikes(name), translate("Type '{}' in the Latin layout.", meant)
        )
    return fold(name) if fold(name).isascii() else name


def read_word(faults: Faults, path: str, value: object, known: Iterable[str]) -> str | None:
    """Read one of a few words."""
    words = tuple(known)
    if not isinstance(value, str):
        faults.expected(path, _either(words), value)
        return None
    word = unmask(faults, path, value)
    if word not in words:
        faults.expected(path, _either(words), value, nearest_name_hint(word, words))
        return None
    return word


def read_member(faults: Faults, path: str, value: object, kind: type[M]) -> M | None:
    """Read one of the words of an enumeration."""
    word = read_word(faults, path, value, (item.value for item in kind))
    return None if word is None else kind(word)


def _either(words: tuple[str, ...]) -> str:
    *first, last = (f"'{word}'" for word in words)
    return translate("{} or {}", ", ".join(first), last) if first else last


def read_point_name(faults: Faults, path: str, value: object) -> str | None:
    """Read the name of a point."""
    if not isinstance(value, str):
        faults.expected(path, "the name of a point", value, "Put it in quotes.")
        return None
    name = unmask(faults, path, value)
    if not is_point_name(name):
        faults.expected(
            path,
            "the name of a point",
            value,
            value_hint(value)
            or "A point is a Latin letter, perhaps with digits or primes: B, O3, S2, C'.",
        )
        return None
    return name


Owner: TypeAlias = str | Callable[[], str]
"""Owner of the points; its name is computed only for a fault, since few files have one."""


def _no_point(owner: Owner, name: str) -> str:
    return translate("{} has no point '{}'", owner if isinstance(owner, str) else owner(), name)


def read_known_point(
    faults: Faults, path: str, value: object, known: Iterable[str], *, of: Owner
) -> str | None:
    """Read the name of a point that must be one of those known; ``of`` is their owner."""
    name = read_point_name(faults, path, value)
    if name is None:
        return None
    points = tuple(known)
    if name not in points:
        hint = nearest_name_hint(name, points, translate("Its points are {}.", listed(points)))
        faults.add(path, _no_point(of, name), hint if points else "")
        return None
    return name


def read_line_name(
    faults: Faults, path: str, value: object, known: Iterable[str], *, of: Owner
) -> tuple[str, str] | None:
    """Read a line named by two points, ``BC``: from B towards C."""
    if not isinstance(value, str):
        faults.expected(path, 'two points such as "BC"', value)
        return None
    pair = split_pair(unmask(faults, path, value))
    if pair is None or pair[0] == pair[1]:
        faults.expected(path, 'two different points such as "BC"', value)
        return None
    points = tuple(known)
    for name in pair:
        if name not in points:
            hint = translate("Its points are {}.", listed(points)) if points else ""
            faults.add(path, _no_point(of, name), hint)
            return None
    return pair
