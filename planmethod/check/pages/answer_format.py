"""Numbers of answers as a person reads them, rich text (запись ответов)."""

from __future__ import annotations

from msgspec import Struct

from planmethod.check.model import GradedAnswer, KeyEntry, Sense, WrittenAnswer
from planmethod.note.formula import escape
from planmethod.note.numbers import ZERO_TOLERANCE, trimmed
from planmethod.note.plaintext import NO_BREAK
from planmethod.note.rounding import rounded_to, sigma_text
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.html import without_control_characters

LONGEST = 60
"""Maximum number of characters quoted from foreign text; the rest is cut."""


def quoted(text: str) -> str:
    """Return foreign text as rich text, cut to a length that fits into a sentence."""
    shown = without_control_characters(text).strip()
    return escape(shown if len(shown) <= LONGEST else f"{shown[: LONGEST - 1]}…")


def displayed_value(value: float, key: KeyEntry) -> float:
    """Return the displayed value of an answer: a size without its sign."""
    return value if key.signed else abs(value)


def shows_rotation(key: KeyEntry) -> bool:
    """Return whether an arrow of rotation replaces the sign."""
    return key.asks_sense and key.sense is not None and key.sense.turns


def unsigned(key: KeyEntry) -> float:
    """Return the exact value, unsigned if an arrow of rotation is next to it."""
    return abs(key.exact) if key.sense is not None and key.sense.turns else key.exact


class AnswerFormatter(Struct, frozen=True):
    """Formatting of answers in a language."""

    language: Language

    @property
    def texts(self) -> MessageTable:
        """Words of checking."""
        return self.language.check

    def symbol(self, answer: GradedAnswer) -> str:
        """Return the letters of an answer."""
        return quoted(answer.id) if answer.key is None else self.letters(answer.key)

    def letters(self, key: KeyEntry) -> str:
        """Return the letters of a requested quantity."""
        return self.language.notation.symbol(key.symbol)

    def unit(self, key: KeyEntry) -> str:
        """Return the unit of a requested quantity; empty if it has none."""
        if key.requested_unit:
            return key.requested_unit
        return "" if key.unit == "1" else self.language.notation.units.get(key.unit, key.unit)

    def unread(self, written: WrittenAnswer) -> str:
        """Return why something cannot be read, as plain text."""
        if written.reason is None:
            return quoted(written.unreadable or written.raw)
        form = self.language.form
        phrase: str = form["unread"][written.reason.value]
        return phrase.format(text=quoted(written.fault), known=", ".join(form["units"]))

    def number(self, value: float) -> str:
        """Return a number as a student would write it."""
        return self.language.notation.number(trimmed(value, 4))

    def sense(self, sense: Sense | None) -> str:
        """Return the sign of a sense; empty if there is none."""
        return "" if sense is None else self.texts["senses"][sense.value][0]

    def with_unit(self, number: str, key: KeyEntry) -> str:
        """Return a number with the requested unit."""
        unit = self.unit(key)
        return number + unit if unit == "°" else f"{number}{NO_BREAK}{unit}" if unit else number

    def right(self, key: KeyEntry, tolerance: float | None = None) -> str:
        """Return the exact value with its tolerance, unit and sense: ``21,3 ± 0,7 м/с² ←``."""
        allowed = key.tolerance if tolerance is None else tolerance
        value = abs(key.exact) if shows_rotation(key) else key.exact
        number = self._with_tolerance(value, key, allowed)
        return self._pointed(self.with_unit(number, key), key.sense if key.asks_sense else None)

    def value(self, key: KeyEntry) -> str:
        """Return the exact value with its tolerance, up to the last digit of it.

        The sense of rotation is shown next to it, always as an arrow.
        """
        return self._with_tolerance(unsigned(key), key, key.tolerance)

    def _with_tolerance(self, value: float, key: KeyEntry, tolerance: float) -> str:
        number = self.rounded(displayed_value(value, key) / key.per, tolerance / key.per)
        return f"{number}{NO_BREAK}±{NO_BREAK}{self.error(tolerance / key.per)}"

    def si(self, value: float, key: KeyEntry) -> str:
        """Return a number of SI as a student would write it, with the requested unit."""
        return self.with_unit(self.number(value / key.per), key)

    def rounded(self, value: float, tolerance: float) -> str:
        """Return a value up to the last digit of its tolerance."""
        nothing = min(ZERO_TOLERANCE, 1e-3 * tolerance)
        return self.language.notation.number(rounded_to(value, tolerance, zero_limit=nothing))

    def error(self, tolerance: float) -> str:
        """Return a tolerance, one digit or two."""
        return self.language.notation.number(sigma_text(tolerance, zero_limit=0.0))

    def student_value(self, answer: GradedAnswer) -> str:
        """Return a student's answer: value with unit and sense, else millimetres."""
        written, key = answer.written, answer.key
        if answer.value is None or key is None:
            bare = "" if written is None or written.mm is None else self.mm(written.mm)
            return self._pointed(bare, None if written is None else written.sense)
        sense = None if written is None else written.sense
        value = abs(answer.value) if sense is not None and sense.turns else answer.value
        return self._pointed(self.si(displayed_value(value, key), key), sense)

    def close_to(self, value: float, answer: GradedAnswer) -> str:
        """Return another value of an answer, to the significant digits."""
        key = answer.key
        if key is None:
            return self.number(value)
        sense = None
        if shows_rotation(key):
            sense = Sense.CCW if value > 0 else Sense.CW
            value = abs(value)
        allowed = answer.tolerance or key.tolerance
        if abs(value) < abs(key.exact) / 3:  # the tolerance is that of a greater number
            allowed = min(allowed, abs(value) / 20 or allowed)
        number = self.rounded(displayed_value(value, key) / key.per, allowed / key.per)
        return self._pointed(self.with_unit(number, key), sense)

    def mm(self, length: float, *, unit: bool = True) -> str:
        """Return a length on a plan, to a tenth of a millimetre."""
        number = self.language.notation.measured(round(length, 1))
        return f"{number}{NO_BREAK}{self.language.notation.units['mm']}" if unit else number

    def points(self, points: float) -> str:
        """Return points."""
        return self.language.notation.number(trimmed(round(points, 2), 6))

    def _pointed(self, text: str, sense: Sense | None) -> str:
        return NO_BREAK.join(part for part in (text, self.sense(sense)) if part)
