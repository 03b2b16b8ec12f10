"""Settings of a department: strictness, tolerances, points and marks."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType
from typing import Any

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.questions import RATES, Question, Sign
from planmethod.check.sheet import Sheet
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


LONG_MM = 100.0
"""Length on the drawing of a link that turns too little to be measured."""

SHORT = 3.0
"""Sigmas below which a quantity is too short to be measured."""

FOLDED = 1.7
"""Factor for lengths about zero, which have no sign: the middle 68 % of them are closer."""


class Tolerance(Struct, frozen=True):
    """Permitted deviation of an answer (допуск).

    Attributes
    ----------
    exact : float
    sigma : float
    spread : float
        k times sigma.
    minimum : float
        The tolerance is not below it.
    maximum : float
        The tolerance is not above it.
    is_visible : bool
        Whether the drawing can show the answer.
    zero : bool
        Too short to be measured.
    per_mm : float
        Value of a millimetre of the plan; 0 if unknown.
    """

    exact: float
    sigma: float
    spread: float
    minimum: float
    maximum: float
    is_visible: bool
    zero: bool
    per_mm: float

    def tolerance(self, step: float = 0.0) -> float:
        """Return the tolerance of an answer written to a step of its last digit."""
        own = max(math.hypot(self.spread, step / 2), self.minimum)
        return own if self.zero else min(own, self.maximum)

    def allows(self, off: float, size: float, step: float = 0.0, times: float = 1.0) -> bool:
        """Return whether an answer is close enough; for zero, also one of that size."""
        tolerance = self.tolerance(step) * times
        return off <= tolerance * (1 + 1e-9) or (self.zero and size <= tolerance)


def limit_of(
    sheet: Sheet, question: Question, settings: Settings, fixed: float | None
) -> Tolerance:
    """Return the tolerance of an answer.

    Parameters
    ----------
    fixed : float or None
        Fraction of the answer that the task itself permits; it overrides all else.
    """
    exact, sigma = sheet.exact_answers[question.id], sheet.sigma(question)
    length, size = sheet.length(question), abs(exact)
    per_mm = 1.0 if question.is_mm else sheet.scales.get(question.scale, 0.0)
    if question.selector.kind in RATES:  # a zero one counts as that of a long link
        per_mm = size / length if length else _rate_per_mm(sheet, question)
    spread = settings.k * sigma
    turned = question.sign is Sign.ANGLE
    whole = math.degrees(1.0) if turned else size  # of an angle, a share of a radian
    most = settings.cap * whole
    least = min(max(settings.floor_mm * per_mm, settings.floor_share * whole), most)
    zero = not turned and (size < SHORT * sigma or not size)
    if zero:
        least = max(settings.floor_mm * per_mm, 1e-9)
        if question.sign is Sign.SIZE:
            spread = max(spread, FOLDED * spread - size)
    own = Tolerance(exact, sigma, spread, least, most, zero or spread <= most, zero, per_mm)
    if zero:
        return own
    if fixed is not None:
        return _flat(own, fixed * whole)
    flat, tolerance = settings.department * whole, own.tolerance()
    wider = settings.policy == "wider" and flat > tolerance
    stricter = settings.policy == "stricter" and flat < tolerance
    return _flat(own, flat) if wider or stricter or settings.policy == "department" else own


def _rate_per_mm(sheet: Sheet, question: Question) -> float:
    plan = "mu_v" if question.selector.kind == "omega" else "mu_a"
    return sheet.scales[plan] / (LONG_MM * sheet.scales["mu_l"])


def _flat(limit: Tolerance, tolerance: float) -> Tolerance:
    """Return a limit with the department's own tolerance, whatever the drawing can show."""
    return replace(limit, spread=tolerance, minimum=tolerance, maximum=math.inf, is_visible=True)
