"""Questions and accepted answers of a variant for a learning management system (вопросы для СДО).

Such a system compares numbers with intervals and ignores a student's own earlier values: a part
has the tolerance of the construction, and the values that named mistakes give.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.key import entry_of
from planmethod.check.model import KeyEntry, Sense
from planmethod.check.questions import Sign
from planmethod.check.sheet import Sheet, is_right
from planmethod.check.task import Task, TaskItem
from planmethod.check.tolerance import Tolerance, limit_of
from planmethod.note.wording import Language, MessageTable

MAX_WRONG_VALUES = 12
"""Wrong values of a part that are named; the usual ones first."""

MIN_SEPARATION = 2.0
"""Tolerances within which a mistake cannot be distinguished from the right answer."""

MAX_HALF_WIDTH = 0.1
"""Share of a wrong value that half of its interval is at most."""

MIN_ERROR_FRACTION = 0.3
"""Minimum error scale of a value that a mistake makes small, relative to the right one."""

TURNS, DIRECTIONS = (Sense.CCW, Sense.CW), (Sense.UP, Sense.DOWN, Sense.LEFT, Sense.RIGHT)


class Alternative(Struct, frozen=True):
    """An interval of numbers and its fraction of the points (вариант числа).

    Attributes
    ----------
    value : float
        Value in the requested unit.
    margin : float
        Half of the interval.
    fraction : float
        Of the points, 0 to 1.
    feedback : str
        Rich text; empty for none.
    """

    value: float
    margin: float
    fraction: float = 1.0
    feedback: str = ""


class Choice(Struct, frozen=True):
    """A sense to choose from: its text, correctness and feedback (выбор)."""

    sense: Sense
    text: str
    right: bool
    feedback: str = ""


class QuizPart(Struct, frozen=True):
    """One gap to fill in: a number, or the sense of a quantity (часть вопроса).

    Attributes
    ----------
    entry : KeyEntry
    points : float
    alternatives : tuple of Alternative
        The first whose interval holds an answer counts; empty for a sense.
    choices : tuple of Choice
        Empty of a number.
    """

    entry: KeyEntry
    points: float
    alternatives: tuple[Alternative, ...] = ()
    choices: tuple[Choice, ...] = ()


def quiz_of(task: Task, language: Language) -> list[QuizPart]:
    """Return the parts of the requested items of a variant, in the requested order."""
    parts: list[QuizPart] = []
    for item in task.list_items():
        sheet = task.sheet(item.position)
        limit = limit_of(sheet, item.question, task.settings, item.fixed)
        parts += _ItemParts(task, item, sheet, limit, language).parts()
    return parts


class GapName(Struct, frozen=True):
    """Name of a gap: an item of the task, its position, and whether it is the sense (пропуск)."""

    id: str
    position: int
    sense: bool


def gaps_of(task: Task) -> list[GapName]:
    """Return what the gaps of a variant are of, in the order of `quiz_of`."""
    found: list[GapName] = []
    for item in task.list_items():
        limit = limit_of(task.sheet(item.position), item.question, task.settings, item.fixed)
        turned, share = has_sense(item, limit), task.settings.sense_share
        if not (turned and share == 1.0):
            found.append(GapName(item.name, item.position, sense=False))
        if turned and share:
            found.append(GapName(item.name, item.position, sense=True))
    return found


def has_sense(item: TaskItem, limit: Tolerance) -> bool:
    """Return whether the sense of an answer can be requested."""
    return item.asks_sense and not limit.zero and bool(limit.exact)


def integer_points(parts: Sequence[QuizPart]) -> list[int]:
    """Return the points of parts in the smallest whole numbers of the same proportion."""
    for times in (1, 2, 4, 5, 10, 20, 25, 50, 100):
        scaled = [part.points * times for part in parts]
        if all(abs(one - round(one)) < 1e-6 for one in scaled):
            break
    return [max(1, round(one)) if one > 0 else 0 for one in scaled]


class _ItemParts(Struct, frozen=True):
    """One item of a task, as its parts."""

    task: Task
    item: TaskItem
    sheet: Sheet
    limit: Tolerance
    language: Language

    def parts(self) -> Iterator[QuizPart]:
        """Yield the part of the number, and that of the sense if it is requested."""
        entry = entry_of(self.task, self.item, self.limit)
        numbers = QuizPart(entry, entry.points, tuple(self._alternatives(entry)))
        share, choices = self.task.settings.sense_share, tuple(self._choices(entry))
        if not choices or not share:
            yield numbers
            return
        if share < 1.0:
            yield replace(numbers, points=entry.points * (1.0 - share))
        yield QuizPart(entry, entry.points * share, choices=choices)

    # Numbers -----------------------------------------------------------------------------------

    def _alternatives(self, entry: KeyEntry) -> Iterator[Alternative]:
        settings, limit, per = self.task.settings, self.limit, entry.per
        right = self._right()
        margin = outer = limit.tolerance()
        yield from (Alternative(value / per, margin / per) for value in right)
        wider: tuple[float, float, str] | None = None
        if not limit.is_visible:
            wider = (limit.spread, settings.unseen_share, self.language.check["key"].unseen)
        elif not limit.zero and settings.near > 1.0 and settings.near_share:
            wider = (margin * settings.near, settings.near_share, self._near_feedback)
        if wider is not None and wider[0] > margin:
            outer, share, phrase = wider
            yield from (Alternative(value / per, outer / per, share, phrase) for value in right)
        least = max(outer, MIN_SEPARATION * margin)
        for value, room, codes in _separate_intervals(
            self._mistaken(), right, outer, least, margin, limit
        ):
            yield Alternative(value / per, room / per, 0.0, self._describe_mistakes(codes))

    @property
    def _near_feedback(self) -> str:
        texts: MessageTable = self.language.check["exchange"]
        near: str = texts.near if self.limit.sigma else texts.near_computed
        return near

    def _right(self) -> list[float]:
        """Return the right values, each with the tolerance round it, as it may be written."""
        exact, sign = self.limit.exact, self.item.question.sign
        if sign is Sign.ANGLE:
            return [exact, exact - 360.0, exact + 360.0]
        found = [exact if sign is Sign.STRICT else abs(exact)]
        if sign is Sign.TURN and (self.item.asks_sense or exact < 0):
            found.append(-abs(exact))
        if self.limit.zero and exact:
            found.insert(0, 0.0)
        return found

    def _mistaken(self) -> Iterator[tuple[str, float]]:
        """Yield codes of mistakes and what each gives, the usual ones first."""
        strict = self.item.question.sign in (Sign.STRICT, Sign.ANGLE)
        named = sorted(self.task.named(self.sheet), key=lambda one: -one.prior)
        for one in named:
            value = one.values[self.item.question.id]
            if math.isfinite(value):
                yield one.code, value if strict else abs(value)

    def _describe_mistakes(self, codes: Sequence[str]) -> str:
        """Return the feedback for a value that mistakes give."""
        say, mistakes = self.language.check["student"], self.language.check["mistakes"]
        known = [mistakes[code] for code in codes if code in mistakes]
        if not known:
            return ""
        if len(known) > 1:
            names = "; ".join(one.name for one in known)
            phrase: str = say.one_of.format(names=names)
            return phrase
        text: str = say.mistake.format(value="", so=known[0].so, where="", advice=known[0].advice)
        return text

    # Senses ------------------------------------------------------------------------------------

    def _choices(self, entry: KeyEntry) -> Iterator[Choice]:
        question, exact = self.item.question, self.limit.exact
        if not has_sense(self.item, self.limit):
            return
        turns = question.sign is Sign.TURN
        for sense in TURNS if turns else DIRECTIONS:
            if turns:
                right = (exact > 0) is (sense is Sense.CCW)
            elif (told := is_right(self.sheet, question, sense)) is not None:
                right = told
            else:
                right = entry.sense is not None  # it cannot be proved wrong
            sign, name = self.language.check["senses"][sense.value]
            turned = "" if right or not turns else self._describe_mistakes(self._reversing())
            yield Choice(sense, f"{sign} {name}", right, turned)

    def _reversing(self) -> list[str]:
        """Return the mistakes that turn the sense alone."""
        exact, slack = self.limit.exact, self.limit.tolerance()
        named = (
            (one.code, one.values[self.item.question.id]) for one in self.task.named(self.sheet)
        )
        codes = [code for code, value in named if abs(value + exact) <= slack]
        return list(dict.fromkeys(codes)) or ["sign"]


def _separate_intervals(
    mistaken: Iterable[tuple[str, float]],
    right: Sequence[float],
    outer: float,
    min_distance: float,
    margin: float,
    limit: Tolerance,
) -> Iterator[tuple[float, float, list[str]]]:
    """Yield wrong values with half of their intervals, which do not meet, and their mistakes.

    Values that are nearer to each other than the tolerance are one, with several mistakes.
    """
    found: list[tuple[float, float, list[str]]] = []
    for code, value in mistaken:
        if min(abs(value - one) for one in right) <= min_distance:
            continue
        share = max(abs(value / limit.exact), MIN_ERROR_FRACTION) if limit.exact else 1.0
        room = min(margin * share, MAX_HALF_WIDTH * abs(value) or margin)
        same = next((one for one in found if abs(one[0] - value) <= max(room, one[1])), None)
        if same is None:
            found.append((value, room, [code]))
        elif code not in same[2]:
            same[2].append(code)
    found = found[:MAX_WRONG_VALUES]
    for number, (value, room, codes) in enumerate(found):
        free = min(abs(value - one) for one in right) - outer
        others = [abs(value - one) / 2 for at, (one, *_) in enumerate(found) if at != number]
        yield value, min([room, free, *others]), codes
