"""Numbers of answers as a person reads them, rich text (запись ответов)."""

from __future__ import annotations

from msgspec import Struct

from planmethod.check.model import Judged, KeyEntry, Sense, WrittenAnswer
from planmethod.note.formula import escape
from planmethod.note.numbers import NOTHING, trimmed
from planmethod.note.plaintext import NO_BREAK
from planmethod.note.rounding import rounded_to, sigma_text
from planmethod.note.wording import Language, Words
from planmethod.note.writers.html import clean

LONGEST = 60
"""Maximum number of characters quoted from foreign text; the rest is cut."""


def quoted(text: str) -> str:
    """Return foreign text as rich text, cut to a length that fits into a sentence."""
    shown = clean(text).strip()
    return escape(shown if len(shown) <= LONGEST else f"{shown[: LONGEST - 1]}…")


def told(value: float, key: KeyEntry) -> float:
    """Return the displayed value of an answer: a size without its sign."""
    return value if key.signed else abs(value)


def shows_turn(key: KeyEntry) -> bool:
    """Return whether an arrow of rotation replaces the sign."""
    return key.asks_sense and key.sense is not None and key.sense.turns


def unsigned(key: KeyEntry) -> float:
    """Return the exact value, unsigned if an arrow of rotation is next to it."""
    return abs(key.exact) if key.sense is not None and key.sense.turns else key.exact


class Speech(Struct, frozen=True):
    """Formatting of answers in a language."""

    words: Language

    @property
    def say(self) -> Words:
        """Words of checking."""
        return self.words.check

    def symbol(self, judged: Judged) -> str:
        """Return the letters of an answer."""
        return quoted(judged.id) if judged.key is None else self.letters(judged.key)

    def letters(self, key: KeyEntry) -> str:
        """Return the letters of a requested quantity."""
        return self.words.say.symbol(key.symbol)

    def unit(self, key: KeyEntry) -> str:
        """Return the unit of a requested quantity; empty if it has none."""
        if key.asked:
            return key.asked
        return "" if key.unit == "1" else self.words.say.units.get(key.unit, key.unit)

    def unread(self, written: WrittenAnswer) -> str:
        """Return why something cannot be read, as plain text."""
        if written.why is None:
            return quoted(written.unreadable or written.raw)
        form = self.words.form
        said: str = form["unread"][written.why.value]
        return said.format(text=quoted(written.fault), known=", ".join(form["units"]))

    def number(self, value: float) -> str:
        """Return a number as a student would write it."""
        return self.words.say.number(trimmed(value, 4))

    def sense(self, sense: Sense | None) -> str:
        """Return the sign of a sense; empty if there is none."""
        return "" if sense is None else self.say["senses"][sense.value][0]

    def with_unit(self, number: str, key: KeyEntry) -> str:
        """Return a number with the requested unit."""
        unit = self.unit(key)
        return number + unit if unit == "°" else f"{number}{NO_BREAK}{unit}" if unit else number

    def right(self, key: KeyEntry, tolerance: float | None = None) -> str:
        """Return the exact value with its tolerance, unit and sense: ``21,3 ± 0,7 м/с² ←``."""
        allowed = key.tolerance if tolerance is None else tolerance
        value = abs(key.exact) if shows_turn(key) else key.exact
        number = self._within(value, key, allowed)
        return self._pointed(self.with_unit(number, key), key.sense if key.asks_sense else None)

    def value(self, key: KeyEntry) -> str:
        """Return the exact value with its tolerance, up to the last digit of it.

        The sense of rotation is shown next to it, always as an arrow.
        """
        return self._within(unsigned(key), key, key.tolerance)

    def _within(self, value: float, key: KeyEntry, tolerance: float) -> str:
        number = self.rounded(told(value, key) / key.per, tolerance / key.per)
        return f"{number}{NO_BREAK}±{NO_BREAK}{self.error(tolerance / key.per)}"

    def si(self, value: float, key: KeyEntry) -> str:
        """Return a number of SI as a student would write it, with the requested unit."""
        return self.with_unit(self.number(value / key.per), key)

    def rounded(self, value: float, tolerance: float) -> str:
        """Return a value up to the last digit of its tolerance."""
        nothing = min(NOTHING, 1e-3 * tolerance)
        return self.words.say.number(rounded_to(value, tolerance, nothing=nothing))

    def error(self, tolerance: float) -> str:
        """Return a tolerance, one digit or two."""
        return self.words.say.number(sigma_text(tolerance, nothing=0.0))

    def own(self, judged: Judged) -> str:
        """Return a student's answer: value with unit and sense, else millimetres."""
        written, key = judged.written, judged.key
        if judged.value is None or key is None:
            bare = "" if written is None or written.mm is None else self.mm(written.mm)
            return self._pointed(bare, None if written is None else written.sense)
        sense = None if written is None else written.sense
        value = abs(judged.value) if sense is not None and sense.turns else judged.value
        return self._pointed(self.si(told(value, key), key), sense)

    def close_to(self, value: float, judged: Judged) -> str:
        """Return another value of an answer, to the significant digits."""
        key = judged.key
        if key is None:
            return self.number(value)
        sense = None
        if shows_turn(key):
            sense = Sense.CCW if value > 0 else Sense.CW
            value = abs(value)
        allowed = judged.tolerance or key.tolerance
        if abs(value) < abs(key.exact) / 3:  # the tolerance is that of a greater number
            allowed = min(allowed, abs(value) / 20 or allowed)
        number = self.rounded(told(value, key) / key.per, allowed / key.per)
        return self._pointed(self.with_unit(number, key), sense)

    def mm(self, length: float, *, unit: bool = True) -> str:
        """Return a length on a plan, to a tenth of a millimetre."""
        number = self.words.say.ruled(round(length, 1))
        return f"{number}{NO_BREAK}{self.words.say.units['mm']}" if unit else number

    def share(self, points: float) -> str:
        """Return points."""
        return self.words.say.number(trimmed(round(points, 2), 6))

    def _pointed(self, text: str, sense: Sense | None) -> str:
        return NO_BREAK.join(part for part in (text, self.sense(sense)) if part)
