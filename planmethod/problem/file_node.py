"""A value at its place in a file (узел файла): how it is read, and the wording of its faults.

A reader is a function of a node that returns its value; after a fault it notes the fault and
raises. Tables and lists have their entries read one by one (`FileNode.read`,
`FileNode.read_each`, `FileNode.read_all`) and continue with the next one, so that all faults of a
file are reported at once. The reader of a table reads like the table::

    def read_mass(node: FileNode) -> Mass:
        node.table('mass = 40, centre = "S2"')
        found = node.record(Mass, centre=FileNode.point_name)
        return node.build(Mass, found)
"""

# Cyrillic letters: type Б of the lettering in a problem file, or a field term in brackets

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from enum import Enum
from typing import Any, NoReturn, TypeAlias, TypeVar, assert_never

from planmethod.errors import Fault
from planmethod.languages import HIDDEN, translate
from planmethod.problem.faults import FAULT_LIMIT, Faults, is_integer, is_number, show
from planmethod.problem.formula import (
    FormulaError,
    evaluate_arithmetic,
    expected_unit,
    measured,
    read_unit,
)
from planmethod.problem.names import (
    NAME_LIMIT,
    UNITS,
    describe_lookalikes,
    fold,
    is_label,
    is_point_name,
    joined,
    listed,
    looks_latin,
    nearest_name_hint,
    segment,
    short,
    split_pair,
)
from planmethod.problem.source import INSTEAD, value_hint
from planmethod.problem.tables import (
    LENGTH_HINT,
    AngleKey,
    ChoiceKey,
    CustomKey,
    FlagKey,
    FlatField,
    IntegerKey,
    NumberKey,
    TextKey,
    WordKey,
    declared,
)

TINY = 1e-30
"""Numbers nearer to zero are read as zero: squares and quotients of them leave the range of
numbers, and programs write so the rounding of a zero."""

_CHOICE_LIMIT = 40

Table: TypeAlias = Mapping[str, Any]
LazyText: TypeAlias = str | Callable[[], str]
"""A text of a message, or a function that makes it: only for a fault, since few files have one."""

_TABLES = (dict, Mapping)
"""Types of a table; the check of the first one is quick."""

M = TypeVar("M", bound=Enum)
R = TypeVar("R")
S = TypeVar("S")


class _NotedError(Exception):
    """A value cannot be read; its fault has been noted."""


def _as_text(text: LazyText) -> str:
    return text if isinstance(text, str) else text()


def needed(value: R | None) -> R:
    """Return a value that a reader needs to continue; raise if it was faulty."""
    if value is None:
        raise _NotedError
    return value


def is_plain_number(text: str) -> bool:
    """Return whether a text is a plain number, not arithmetic."""
    return re.fullmatch(r"[-+−]?\d+(?:[.,]\d+)?", text) is not None


class FileNode:
    """A value at its place in a file (узел файла).

    Attributes
    ----------
    faults : Faults
        Of the file.
    value : object
        None if the file lacks the key. A table loses its unknown keys once they are reported.
    key : str or int
        Its key in the table, or its index in the list, that it is in; the path of a root.
    is_whole : bool
        False of a table in which unknown keys were reported: a key that is missing may be one.
    """

    __slots__ = ("_parent", "faults", "is_whole", "key", "value")

    def __init__(
        self, faults: Faults, value: Any, key: str | int = "", parent: FileNode | None = None
    ) -> None:
        self.faults, self.value, self.key = faults, value, key
        self._parent, self.is_whole = parent, True

    # Its place -------------------------------------------------------------------------------

    @property
    def path(self) -> str:
        """Its place, as in messages: ``loads[2].force``."""
        if self._parent is None:
            return str(self.key)
        if isinstance(self.key, int):
            return f"{self._parent.path}[{self.key}]"
        return joined(self._parent.path, segment(self.key))

    def __contains__(self, key: str) -> bool:
        return isinstance(self.value, _TABLES) and key in self.value

    def __getitem__(self, key: str | int) -> FileNode:
        value = None
        if isinstance(key, int):
            value = self.value[key]
        elif isinstance(self.value, _TABLES):
            value = self.value.get(key)
        return FileNode(self.faults, value, key, self)

    def at(self, path: Iterable[str]) -> FileNode:
        """Return the node at the end of a path of keys."""
        node = self
        for key in path:
            node = node[key]
        return node

    def copy(self) -> FileNode:
        """Return the root with an independent copy of its faults."""
        return FileNode(self.faults.copy(), self.value, self.key)

    def with_value(self, value: object) -> FileNode:
        """Return the same place with another value, for instance a part of its text."""
        return FileNode(self.faults, value, self.key, self._parent)

    def get(self, key: str, absent: object) -> FileNode:
        """Return the node of a key, with a value for a file that lacks it."""
        return self[key] if key in self else FileNode(self.faults, absent, key, self)

    def entries(self) -> Iterator[FileNode]:
        """Yield the entries of a table or of a list, in their order."""
        items = enumerate(self.value) if isinstance(self.value, list) else self.value.items()
        return (FileNode(self.faults, value, key, self) for key, value in items)

    # Its faults ------------------------------------------------------------------------------

    @property
    def is_sound(self) -> bool:
        """True if no fault has been noted here, or of anything that it holds."""
        return not self.faults or self.path not in self.faults.places

    def note(self, message: str, *facts: object, hint: str = "") -> None:
        """Note a fault, a sentence with its facts, and continue."""
        self.faults.add(Fault(self.path, translate(message, *facts), hint))
        node: FileNode | None = self
        while node is not None:
            self.faults.places.add(node.path)
            node = node._parent

    def note_value(self, expected: str, hint: str = "") -> None:
        """Note that ``expected`` was expected instead of the value, and continue."""
        self.note("expected {}, got {}", expected, show(self.value), hint=hint)

    def note_missing(self, key: str, hint: str = "") -> None:
        """Note that a key is missing.

        A misspelt key is reported once: the key it should have been is not called missing as well.
        """
        if self.is_whole:
            self[key].note("missing", hint=hint)

    def note_unknown(
        self, name: str, known: Iterable[str], message: str = "unknown key", *, hint: str = ""
    ) -> None:
        """Note an unknown key or name, as ``unknown link '{}'``, with the nearest known one.

        ``hint`` is that for a name which is near to none.
        """
        names = tuple(known)
        # the nearest name is searched for only if the fault will be listed
        if self.faults.count < FAULT_LIMIT:
            other = translate("Known here: {}.", listed(names)) if names else ""
            hint = nearest_name_hint(name, names, hint or other)
        if "omega" in names:
            hint = INSTEAD.get(name, hint)
        self.note(message, short(name), hint=hint)

    def reject(self, message: str, *facts: object, hint: str = "") -> NoReturn:
        """Note a fault, and raise: the value cannot be read."""
        self.note(message, *facts, hint=hint)
        raise _NotedError

    def reject_value(self, expected: str, hint: str = "") -> NoReturn:
        """Note that ``expected`` was expected, and raise."""
        self.note_value(expected, hint)
        raise _NotedError

    def reject_unknown(
        self, name: str, known: Iterable[str], message: str, *, hint: str = ""
    ) -> NoReturn:
        """Note an unknown name, and raise."""
        self.note_unknown(name, known, message, hint=hint)
        raise _NotedError

    def reject_all(self, faults: Iterable[Fault]) -> NoReturn:
        """Take over faults that were found with the parts of the file, and raise."""
        for fault in faults:
            self.faults.add(fault)
        raise _NotedError

    def require_sound(self) -> None:
        """Raise if anything here has a fault."""
        if not self.is_sound:
            raise _NotedError

    def require_at_most(self, limit: int, message: str, count: int | None = None) -> None:
        """Make sure of a limit: ``{} links, the limit is {}``; ``count`` is that of the entries."""
        number = len(self.value) if count is None else count
        if number > limit:
            self.reject(message, number, limit)

    # Its entries -----------------------------------------------------------------------------

    def attempt(self, reader: Callable[[FileNode], R]) -> R | None:
        """Return the value by a reader; None after a fault."""
        try:
            return reader(self)
        except _NotedError:
            return None

    def read(
        self, key: str, reader: Callable[[FileNode], R], absent: S | None = None
    ) -> R | S | None:
        """Return the value of a key; None after a fault, ``absent`` if the key is missing."""
        return self[key].attempt(reader) if key in self else absent

    def require(self, key: str, reader: Callable[[FileNode], R], hint: LazyText = "") -> R | None:
        """Return the value of a key that must be present; None after a fault."""
        if key not in self:
            self.note_missing(key, _as_text(hint))
        return self.read(key, reader)

    def read_each(self, reader: Callable[[FileNode], R | None]) -> dict[str, R]:
        """Return the values of a table without faults, by key."""
        read = {str(node.key): node.attempt(reader) for node in self.entries()}
        return {key: value for key, value in read.items() if value is not None}

    def read_all(self, reader: Callable[[FileNode], R]) -> tuple[R, ...]:
        """Return the values of a list; raise after reading them if any was faulty."""
        read = self.read_sound(reader)
        if len(read) < len(self.value):
            raise _NotedError
        return read

    def read_sound(self, reader: Callable[[FileNode], R]) -> tuple[R, ...]:
        """Return the values of a list without faults."""
        found = []
        for node in self.entries():
            try:
                found.append(reader(node))
            except _NotedError:
                continue
        return tuple(found)

    def read_one_or_all(self, reader: Callable[[FileNode], R]) -> tuple[R, ...]:
        """Return the values of a list, or one value that is not in a list."""
        return self.read_all(reader) if isinstance(self.value, list) else (reader(self),)

    # Tables and lists ------------------------------------------------------------------------

    def table(self, example: str = "") -> Table:
        """Make sure that this is a table, which is returned."""
        if not isinstance(self.value, _TABLES):
            self.reject_value("a table", translate("For example: {}", example) if example else "")
        return self.value

    def array(
        self, expected: LazyText, hint: LazyText = "", *, low: int = 0, high: float = math.inf
    ) -> None:
        """Make sure that this is a list of ``low`` to ``high`` values."""
        if not isinstance(self.value, list) or not low <= len(self.value) <= high:
            self.reject_value(_as_text(expected), _as_text(hint))

    def tables(self, limit: int, message: str) -> None:
        """Make sure that this is a list of at most ``limit`` tables, ``[[loads]]``."""
        if not isinstance(self.value, list) or not all(isinstance(t, Mapping) for t in self.value):
            self.reject_value(translate("tables [[{}]]", self.key))
        self.require_at_most(limit, message)

    def allow(self, known: Iterable[str]) -> None:
        """Keep the known keys of a table; the others are faults."""
        names, kept = tuple(known), {}
        for key, value in self.value.items():
            if key in names:
                kept[key] = value
                continue
            node = self[key]
            name = node.unmask(key)
            if name in names:
                kept[name] = value
            else:
                node.note_unknown(name, names)
            self.is_whole = self.is_whole and node.is_sound
        self.value = kept

    def record(
        self,
        record: type[object],
        /,
        *,
        without: Collection[str] = (),
        example: str = "",
        **readers: Callable[[FileNode], object],
    ) -> dict[str, Any]:
        """Return the values of a flat table, by the fields of a record.

        Parameters
        ----------
        record : type
            Its fields declare the keys of the table (`declared`).
        without : collection of str
            Keys of the record that this table does not have.
        example : str
            Shown where a required key is missing that has no hint of its own.
        **readers : callable
            Of the table's custom keys; values of custom keys without a reader are returned
            unchanged.
        """
        known = [one for one in declared(record) if one.name not in without]
        self.allow(one.name for one in known)
        found: dict[str, Any] = {}
        for one in known:
            if one.name not in self.value:
                if one.key.required:
                    hint = translate("For example: {}", example) if example else one.key.missing
                    self.note_missing(one.name, hint)
                continue
            node = FileNode(self.faults, self.value[one.name], one.name, self)
            try:
                reader = readers.get(one.name)
                value = reader(node) if reader else _read_declared(node, one)
            except _NotedError:
                continue
            if value is not None:
                found[one.field] = value
        return found

    def build(self, record: Callable[..., R], values: Mapping[str, Any]) -> R:
        """Return a record of values that were read here without a fault."""
        self.require_sound()
        return record(**values)

    # Numbers ---------------------------------------------------------------------------------

    def number(
        self,
        expected: str = "a number",
        low: float = -1e9,
        high: float = 1e9,
        *,
        positive: bool = False,
        offset: bool = False,
        hint: str = LENGTH_HINT,
    ) -> float:
        """Read a finite number within bounds.

        Parameters
        ----------
        expected : str
            Expected value, with its unit: ``a length in metres``.
        positive : bool
            Zero and negative numbers are then reported as such, before the bounds are checked.
        offset : bool
            Whether it is a coordinate or an angle: a nearly zero value becomes zero without a
            note.
        hint : str
            What to do about a number that is out of bounds.
        """
        value = self._evaluated(expected) if isinstance(self.value, str) else self.value
        if not is_number(value):
            self.reject_value(expected)
        try:
            number = float(value)
        except OverflowError:
            number = math.inf if value > 0 else -math.inf
        if not math.isfinite(number):
            self.reject(
                "expected {}, got {:g}", expected, number, hint="The number must be finite."
            )
        if positive and number < TINY:
            small = "So small a number is zero here: check its power of ten." if number > 0 else ""
            self.reject("expected {} greater than 0, got {:g}", expected, number, hint=small)
        if 0 < abs(number) < TINY:
            if not offset:
                self.faults.vanished[self.path] = number
            number = 0.0
        if not low <= number <= high:
            message = "expected {} from {:g} to {:g}, got {:g}"
            self.reject(message, expected, low, high, number, hint=hint)
        return number

    def _evaluated(self, expected: str) -> float:
        """Return the number of a text: arithmetic, or a number with a unit."""
        if self.faults.names and _has_name(self.value, self.faults.names):
            return self._calculated(expected, self.unmask(self.value))
        number = self._converted(expected)
        if number is not None:
            return number
        mistyped = value_hint(self.value)
        if mistyped or not any(map(str.isdecimal, self.value)):
            self.reject_value(expected, mistyped)
        return self._calculated(expected, self.value)

    def _calculated(self, expected: str, text: str) -> float:
        """Return the value of arithmetic, which is kept as it is stated."""
        try:
            number = evaluate_arithmetic(text, self.faults.names)
        except FormulaError as error:
            shown = show(self.value)
            self.reject("expected {}, got {}: {}", expected, shown, str(error), hint=error.hint)
        self.faults.stated[self.path] = text
        return number

    def _converted(self, expected: str) -> float | None:
        """Return a number that has a unit, ``"4 in"``, in the unit that is expected; else None."""
        told = measured(self.value)
        if told is None:
            return None
        unit = expected_unit(expected)
        wanted = read_unit(unit) if unit else None
        number = told.in_unit(unit) if unit else None
        if number is None:
            if wanted is None:
                hint = translate("Write {} without a unit.", told.number)
            elif wanted.dimension == told.of.dimension:
                hint = translate("Write {} for turns, or {} for an angle a second.", "rpm", "rad/s")
            else:
                hint = translate("{} is a unit of {}: check it.", told.unit, told.quantity)
            self.reject_value(expected, hint)
        if not is_plain_number(told.number) and wanted and told.of.factor == wanted.factor:
            self.faults.stated[self.path] = told.number
        return number

    def integer(self, low: int, high: int) -> int:
        """Read a whole number within bounds."""
        if not is_integer(self.value) or not low <= self.value <= high:
            self.reject_value(translate("a whole number from {} to {}", low, high))
        return self.value

    def length(self) -> float:
        """Read a length of a link in the unit of the file; it is returned in m."""
        return self.metres("length", low=1e-9, positive=True)

    def coordinate(self, kind: str = "distance") -> float:
        """Read a coordinate or a signed distance in the unit of the file; it is returned in m."""
        return self.metres(kind, low=-1e6)

    def metres(
        self, kind: str = "distance", *, low: float, high: float = 1e6, positive: bool = False
    ) -> float:
        """Read a length in the unit of the file; it and its bounds are in m.

        Parameters
        ----------
        kind : str
            ``length``, ``distance`` or ``coordinate``: how it is called.
        """
        per, what = UNITS[self.faults.unit], _EXPECTED_TEXTS[self.faults.unit][kind]
        number = self.number(what, low * per, high * per, positive=positive, offset=not positive)
        return number / per

    def place(self) -> complex:
        """Read ``[x, y]``, m."""
        if not isinstance(self.value, list) or len(self.value) != 2:
            commas = isinstance(self.value, list) and len(self.value) in (3, 4)
            hint = "The decimal sign is a point: [0.5, 0.3]." if commas else value_hint(self.value)
            self.reject_value(_EXPECTED_TEXTS[self.faults.unit]["place"], hint)
        x, y = self.read_all(lambda node: node.coordinate("coordinate"))
        return complex(x, y)

    def angle(self) -> float:
        """Read an angle, degrees."""
        if isinstance(self.value, str):
            degrees = re.sub("π|pi", "180", self.value)
            if degrees != self.value and measured(self.value) is None:
                hint = translate('pi is 180 degrees: write "{}".', degrees)
                self.reject_value("an angle in degrees", hint)
        return self.number("an angle in degrees", -36000, 36000, offset=True)

    # Texts -----------------------------------------------------------------------------------

    def flag(self) -> bool:
        """Read true or false."""
        if not isinstance(self.value, bool):
            hint = "Write it without quotes." if self.value in ("true", "false") else ""
            self.reject_value("true or false", hint)
        return self.value

    def text(self, limit: int) -> str:
        """Read a line of text without control characters."""
        if not isinstance(self.value, str):
            bare = is_number(self.value) or show(self.value) == translate("a date or time")
            self.reject_value("a string", "Put it in quotes." if bare else "")
        self.check_text(self.value, limit)
        return self.value

    def check_text(self, text: str, limit: int) -> None:
        """Make sure that a text, the value or a key, is a line without control characters."""
        if len(text) > limit:
            message = "the text has {} characters, the limit is {}"
            self.reject(message, len(text), limit, hint="Shorten it.")
        bad = re.search(f"[\t\n]|{HIDDEN}", text)
        if bad is not None:
            hint = "Write it on one line, without tabs."
            self.reject("the text has the control character U+{:04X}", ord(bad[0]), hint=hint)

    def word(self, known: Iterable[str]) -> str:
        """Read one of a few words."""
        words = tuple(known)
        if not isinstance(self.value, str):
            self.reject_value(_either(words))
        word = self.unmask(self.value)
        if word not in words:
            self.reject_value(_either(words), nearest_name_hint(word, words))
        return word

    def member(self, kind: type[M]) -> M:
        """Read one of the words of an enumeration."""
        return kind(self.word(item.value for item in kind))

    def choice(self, known: Collection[str]) -> str:
        """Read one of a few words, in either alphabet and case."""
        text = self.text(_CHOICE_LIMIT)
        word = chosen(text, known)
        if word is None:
            hint = nearest_name_hint(text, known)
            self.reject_value(translate("one of {}", ", ".join(known)), hint)
        return word

    # Names -----------------------------------------------------------------------------------

    def unmask(self, name: str) -> str:
        """Note the look-alike letters of a name and return the intended name."""
        meant = fold(name)
        if not meant.isascii():
            return name
        if looks_latin(name):
            hint = translate("Type '{}' in the Latin layout.", short(meant))
            self.note(describe_lookalikes(name), hint=hint)
        return meant

    def check_label(self, name: str, noun: str) -> None:
        """Make sure that a name can be that of a link, a guide or a variant."""
        if not is_label(name):
            hint = translate("Use letters and digits, at most {}.", NAME_LIMIT)
            self.reject("{!r} cannot name {}", name[:40], noun, hint=hint)

    def known_name(self, expected: str, known: Collection[str], message: str) -> str:
        """Read the name of something that the file has: one of those known.

        Parameters
        ----------
        expected, message : str
            ``the name of a link``, ``unknown link '{}'``.
        """
        name = self.any_name(expected, known)
        if name not in known:
            self.reject_unknown(name, known, message)
        return name

    def any_name(self, expected: str, known: Collection[str]) -> str:
        """Read a name; those that are known may have letters of any alphabet."""
        if not isinstance(self.value, str):
            hint = ""
            if is_integer(self.value):
                hint = translate('Write {} = "{}".', self.key, self.value)
            self.reject_value(expected, hint)
        return self.value if self.value in known else self.unmask(self.value)

    def point_name(self) -> str:
        """Read the name of a point."""
        if not isinstance(self.value, str):
            self.reject_value("the name of a point", "Put it in quotes.")
        return self.check_point_name(self.value)

    def check_point_name(self, text: str) -> str:
        """Return a text, the value or the key, as the name of a point."""
        name = self.unmask(text)
        if not is_point_name(name):
            hint = "A point is a Latin letter, perhaps with digits or primes: B, O3, S2, C'."
            self.reject(
                "expected {}, got {}", "the name of a point", show(text),
                hint=value_hint(text) or hint,
            )  # fmt: skip
        return name

    def point_of(self, owner: LazyText, known: Iterable[str]) -> str:
        """Read the name of a point, one of those of its owner."""
        name = self.point_name()
        self.check_owned(name, owner, known, near=True)
        return name

    def line_of(self, owner: LazyText, known: Iterable[str]) -> tuple[str, str]:
        """Read a line named by two points of its owner, ``BC``: from B towards C."""
        if not isinstance(self.value, str):
            self.reject_value('two points such as "BC"')
        return self.split_line(self.value, owner, known)

    def split_line(self, text: str, owner: LazyText, known: Iterable[str]) -> tuple[str, str]:
        """Return the two points that a text, the value or a part of it, names."""
        pair, points = split_pair(self.unmask(text)), tuple(known)
        if pair is None or pair[0] == pair[1]:
            expected = 'two different points such as "BC"'
            self.reject("expected {}, got {}", expected, show(text))
        for name in pair:
            self.check_owned(name, owner, points)
        return pair

    def check_owned(
        self, name: str, owner: LazyText, known: Iterable[str], *, near: bool = False
    ) -> None:
        """Make sure that a name is one of the points of an owner; ``near`` hints at the nearest."""
        points = tuple(known)
        if name in points:
            return
        hint = translate("Its points are {}.", listed(points)) if points else ""
        if near and points:
            hint = nearest_name_hint(name, points, hint)
        self.reject("{} has no point '{}'", _as_text(owner), name, hint=hint)


def read_units(file: FileNode) -> None:
    """Read ``units``, the unit of all lengths of a file."""
    unit = file.read("units", lambda units: units.word(UNITS))
    file.faults.unit = unit or file.faults.unit


def _read_declared(node: FileNode, one: FlatField) -> object:
    """Return a value as its key is declared."""
    match one.key:
        case NumberKey() as key:
            return _read_number(node, key)
        case IntegerKey() as key:
            return node.integer(key.low, key.high)
        case AngleKey():
            return node.angle()
        case FlagKey():
            return node.flag()
        case TextKey() as key:
            return node.text(key.limit)
        case WordKey():
            return node.member(one.kind)
        case ChoiceKey() as key:
            return node.choice(key.words)
        case CustomKey():
            return node.value
        case _:
            assert_never(one.key)


def _has_name(text: str, names: Collection[str]) -> bool:
    """Return whether arithmetic has a name, or a word that is written like one."""
    words = re.findall(r"[^\W\d]\w*", text)
    return any("_" in word or fold(word) in names for word in words)


_KINDS = {"a radius": "distance", "a distance": "distance"}


def _read_number(node: FileNode, key: NumberKey) -> float:
    if key.unit == "m" and node.faults.unit != "m":
        kind = _KINDS.get(key.noun, "length")
        return node.metres(kind, low=key.low, high=key.high, positive=key.positive)
    if key.low == 0.0 and key.unbounded and is_number(node.value) and node.value < 0:
        node.reject("expected {}, 0 or greater, got {:g}", key.expected, node.value)
    return node.number(key.expected, key.low, key.high, positive=key.positive, hint=key.hint)


def chosen(text: str, known: Collection[str]) -> str | None:
    """Return the word that a text matches, in either alphabet and case, or None.

    Type Б of the lettering is called B in Latin letters.

    Examples
    --------
    >>> chosen("2А", ("1", "2a"))
    '2a'
    """
    word = fold(text.replace("Б", "B")).replace(" ", "").casefold()
    return next((name for name in known if name.replace(" ", "").casefold() == word), None)


def _either(words: tuple[str, ...]) -> str:
    *first, last = (f"'{word}'" for word in words)
    return translate("{} or {}", ", ".join(first), last) if first else last


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
