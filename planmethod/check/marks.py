"""Settings of a department: strictness of grading, points and marks (настройки кафедры)."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType
from typing import Any

from msgspec import Struct

from planmethod.errors import ExitCode, ProblemError
from planmethod.languages import translate
from planmethod.problem.faults import Faults, is_integer
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.source import parse, read_source

PROFILES = ("board", "cad", "coarse")
"""Profiles of drafting errors that a tolerance can follow from."""

POLICIES = ("construction", "department", "wider", "stricter")
"""Choice of the tolerance: the drawing's, the flat one, the wider of them, the stricter."""

VALUES = ("always", "decided", "never")
"""When a student's page shows the right values: always; once no answer is open; never."""

MARK_LIMIT = 20
_TINY = 1e-9
"""Sums of points are not exact: a share that close below a bound has reached it."""


class SettingsError(ProblemError):
    """The settings of a department are faulty; all their faults are in `faults`."""

    exit_code = ExitCode.USAGE
    head = "{0}: {1} fault{1:||s} in the settings file"


class Settings(Struct, frozen=True):
    """Grading settings of a department (настройки кафедры).

    Attributes
    ----------
    k : float
        Standard deviations of drafting that an answer may be off.
    cap : float
        Share of the value that a tolerance never exceeds: above it the drawing cannot show the
        answer.
    floor_mm : float, mm
        Length on the plan that a tolerance never falls short of.
    floor_share : float
        The same as a share of the value.
    near : float
        Number of tolerances up to which an answer is near.
    near_share, inherited_share, inconsistent_share, unseen_share : float
        Share of its points that an answer gets with such a verdict.
    sense_share : float
        Fraction of an answer's points that its sense is worth, if it is requested.
    department : float
        The department's flat tolerance, a share of the value.
    policy : str
        Choice of the tolerance, one of `POLICIES`.
    profile : str
        One of `PROFILES`.
    ruler_mm : float or None, mm
        Step to which lengths are read; None for that of the profile.
    values : str
        When a student's page shows the right values, one of `VALUES`.
    marks : tuple of (float, str)
        From which share of the points a mark is given, the best first, the last from 0.
    """

    k: float = 2.5
    cap: float = 0.10
    floor_mm: float = 0.5
    floor_share: float = 0.005
    near: float = 1.6
    near_share: float = 0.7
    inherited_share: float = 1.0
    inconsistent_share: float = 1.0
    unseen_share: float = 1.0
    sense_share: float = 0.3
    department: float = 0.05
    policy: str = "construction"
    profile: str = "board"
    ruler_mm: float | None = None
    values: str = "decided"
    marks: tuple[tuple[float, str], ...] = ((0.85, "5"), (0.7, "4"), (0.5, "3"), (0.0, "2"))

    def mark(self, fraction: float) -> str:
        """Return the mark for a share of the points, 0 to 1."""
        return next(
            (mark for least, mark in self.marks if fraction >= least - _TINY), self.marks[-1][1]
        )


DEFAULT = Settings()

_FRACTION_HINT = "Shares are from 0 to 1: 0.05 for 5 %."
_NUMBERS: Mapping[str, tuple[str, float, float, str]] = MappingProxyType(
    {
        "k": ("a number of standard deviations", 0.5, 10.0, "2.5 rejects few correct answers."),
        "cap": ("a share", 0.005, 1.0, _FRACTION_HINT),
        "floor_mm": ("a length in mm", 0.0, 5.0, "It is measured on the plan."),
        "floor_share": ("a share", 0.0, 0.5, _FRACTION_HINT),
        "near": ("a number of tolerances", 1.0, 10.0, "1 for no answers that are near."),
        "near_share": ("a share", 0.0, 1.0, _FRACTION_HINT),
        "inherited_share": ("a share", 0.0, 1.0, _FRACTION_HINT),
        "inconsistent_share": ("a share", 0.0, 1.0, _FRACTION_HINT),
        "unseen_share": ("a share", 0.0, 1.0, _FRACTION_HINT),
        "sense_share": ("a share", 0.0, 1.0, _FRACTION_HINT),
        "department": ("a share", 0.001, 1.0, _FRACTION_HINT),
        "ruler_mm": ("a step of reading in mm", 0.01, 5.0, "A ruler has 0.5 or 1."),
    }
)
"""Keys that take a number: what it is, its bounds, and what to do about one beyond them."""

KEYS = (*_NUMBERS, "policy", "profile", "values", "marks")


def load_settings(path: Path) -> Settings:
    """Read the settings of a department from a TOML file.

    Raises
    ------
    SettingsError
        With every fault of the file: key, what was expected, what was found, the nearest name.
    """
    name = str(path)
    try:
        table = parse(read_source(path), name=name)
    except ProblemError as error:
        raise SettingsError(name, error.faults) from None
    file = FileNode(Faults(), table)
    file.allow(KEYS)
    found: dict[str, Any] = {
        key: file.read(key, _READERS.get(key, _read_number)) for key in file.value
    }
    if not file.faults and found.get("floor_share", DEFAULT.floor_share) > found.get(
        "cap", DEFAULT.cap
    ):
        hint = "No answer could be graded: raise it."
        file["cap"].note("the cap is below floor_share", hint=hint)
    if file.faults:
        raise SettingsError(name, file.faults.listed)
    return Settings(**found)


def _read_number(node: FileNode) -> float:
    what, low, high, hint = _NUMBERS[str(node.key)]
    return node.number(what, low, high, hint=hint)


_MARKS = 'For example: marks = [[0.85, "5"], [0.7, "4"], [0.5, "3"], [0, "2"]]'


def _read_marks(node: FileNode) -> tuple[tuple[float, str], ...]:
    """Read marks: pairs of a share and a name, the best first, the last from 0."""
    node.array(translate("1 to {} marks", MARK_LIMIT), _MARKS, low=1, high=MARK_LIMIT)
    found = node.read_all(_read_mark)
    for index, ((above, _), (below, mark)) in enumerate(pairwise(found), 1):
        if not below < above:
            message = "'{}' is from {:g}, the mark before it from {:g}"
            node[index].note(message, mark, below, above, hint="The best mark comes first.")
    lowest, mark = found[-1]
    if lowest != 0:
        hint = translate("Add the lowest mark: [0, \"2\"], or let '{}' start at 0.", mark)
        node.note("the last mark is from {:g}, expected 0", lowest, hint=hint)
    return found


def _read_mark(node: FileNode) -> tuple[float, str]:
    node.array("[share, mark]", _MARKS, low=2, high=2)
    fraction = node[0].attempt(lambda one: one.number("a share", 0.0, 1.0, hint=_FRACTION_HINT))
    name = node[1].with_value(_unquoted(node.value[1]))
    mark = name.text(MARK_LIMIT).strip()
    if not mark:
        name.reject("the mark is empty", hint=_MARKS)
    return needed(fraction), mark


def _unquoted(value: object) -> object:
    """Take a whole number for a mark: 5 is "5"."""
    return str(value) if is_integer(value) else value


_READERS: Mapping[str, Callable[[FileNode], object]] = {
    "policy": lambda policy: policy.word(POLICIES),
    "profile": lambda profile: profile.word(PROFILES),
    "values": lambda values: values.word(VALUES),
    "marks": _read_marks,
}
"""Readers of the keys whose values are texts or lists."""
