"""Remarks for a student, starting with the first mistake, and numbers as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from msgspec import Struct

from planmethod.check.model import (
    Diagnosis,
    GradedAnswer,
    GradedSubmission,
    KeyEntry,
    Sense,
    Unread,
    Verdict,
    WrittenAnswer,
)
from planmethod.note.compared import rounded_to, sigma_text
from planmethod.note.document import NO_BREAK
from planmethod.note.formula import escape
from planmethod.note.numbers import ZERO_TOLERANCE, trimmed
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.formulas import without_control_characters
from planmethod.plans.model import FACTS, RATES

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


PLACED = (Unread.TURNED, Unread.MIRRORED, Unread.DRAWING_UNIT)
"""Remarks on how a drawing was read; no answer is lost by them."""


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


PLANS = {FACTS[kind].scale: kind for kind in RATES}
OFF = (Verdict.WRONG, Verdict.NEAR)

ON_PAPER = {"slip", "swap", "scale", "S1", "S2", "S3", "S4"}
"""Mistakes in a number: the segment that it was read off is right."""


class Remarks(Struct, frozen=True):
    """Remarks on one submission, rich text.

    Attributes
    ----------
    formatter : AnswerFormatter
    checked : GradedSubmission
    scales : mapping of str to float
        Scales of the key, used if the student states none.
    hidden : tuple of str
        Codes of the mistakes that none of the answers can show.
    values : bool
        Whether the right values are shown.
    """

    formatter: AnswerFormatter
    checked: GradedSubmission
    scales: Mapping[str, float]
    hidden: tuple[str, ...] = ()
    values: bool = True

    @property
    def texts(self) -> MessageTable:
        """Words of a student's page."""
        texts: MessageTable = self.formatter.texts["student"]
        return texts

    def _wording(self, name: str) -> str:
        """Return a sentence with the right value in it, or that which goes without."""
        phrase: str = self.texts[name] if self.values else self.texts["without"][name]
        return phrase

    def sentences(self) -> list[str]:
        """Return all remarks; one that all is right where it is."""
        told = [
            *self._instructor_remark(),
            *self._causes(),
            *self._unexplained(),
            *self._inherited(),
        ]
        told += [*self._singly(), *self._missing()]
        return [*(told or [self.texts.all_right]), *self._hidden()]

    def _hidden(self) -> Iterator[str]:
        """Yield which mistakes may be there and do not show."""
        names = [self.formatter.texts["mistakes"][c].name for c in self.hidden if c in self._codes]
        if names:
            yield self.texts.hidden.format(names="; ".join(names))

    def redraw(self) -> list[str]:
        """Return the segments to redraw: those where mistakes begin, else the wrong ones."""
        drawn = [d for d in self.checked.diagnosis if not d.codes or {*d.codes} - ON_PAPER]
        roots = [judged for d in drawn for judged in self._answers_with_ids(d.roots)]
        if self.checked.diagnosis and not roots:
            return []
        off = [judged for judged in self.checked.answers if judged.verdict in OFF]
        lines: dict[tuple[str, str], str] = {}
        for judged in roots or off:
            key = judged.key
            if key is None or key.mm is None or not key.segment or judged.verdict not in OFF:
                continue
            if judged.slip or judged.miscomputed:  # the segment is another matter
                continue
            plan = PLANS.get(key.scale)
            # A number derived from a segment does not show that the segment is wrong.
            if (
                plan is None
                or key.unit not in (FACTS[plan].unit, "mm")
                or self._is_within_tolerance(judged)
            ):
                continue
            lines.setdefault(
                (key.segment, key.scale),
                self._wording("redraw_line").format(
                    segment=segment_letters(key.segment),
                    plan=self.texts["plan_names"][plan.value],
                    right=self.formatter.mm(key.mm),
                ),
            )
        return list(lines.values())

    # Beginnings --------------------------------------------------------------------------------

    def _causes(self) -> Iterator[str]:
        """Yield a remark on each mistake that has a name, or on where the trouble begins."""
        for diagnosis in self.checked.diagnosis:
            roots = self._answers_with_ids(diagnosis.roots)
            if not roots:
                continue
            first, others = roots[0], roots[1:]
            if diagnosis.codes == ("slip",) and first.slip and not others:
                continue  # included in the remark on the student's own numbers
            parts = [self._compared(first), self._cause_text(diagnosis, first)]
            if others:  # the same remark applies to them
                parts.append(self.texts.also.format(answers=self._listed(others)))
            yield " ".join(filter(None, parts))

    def _cause_text(self, diagnosis: Diagnosis, first_wrong_answer: GradedAnswer) -> str:
        words = [self.formatter.texts["mistakes"][c] for c in diagnosis.codes if c in self._codes]
        if not words:
            return self._not_known(first_wrong_answer)
        if diagnosis.codes == ("slip",) and not diagnosis.mistake_at:
            return ""  # included in the remark on the student's own numbers
        if not diagnosis.sure or len(words) > 1:
            names = "; ".join(word.name for word in words)
            end = self.texts.one_of_end.format(answer=self.formatter.symbol(first_wrong_answer))
            return f"{self.texts.one_of.format(names=names)} {end}"
        gives = diagnosis.values.get(first_wrong_answer.id)
        many = "" if gives is None else self.formatter.close_to(gives, first_wrong_answer)
        so_many = (
            f" ({many})"
            if self.values and many and many not in self.formatter.student_value(first_wrong_answer)
            else ""
        )
        return self.texts.mistake.format(
            value=so_many,
            so=words[0].so,
            where=self._place_text(diagnosis.mistake_at),
            advice=words[0].advice,
        )

    def _place_text(self, place: str) -> str:
        if not place:
            return ""
        if " ≠ " in place:  # a formula in place of another one
            wrong, right = place.split(" ≠ ")
            return str(self.texts.mistake_instead.format(wrong=wrong, right=right))
        kind = "pair" if "/" in place else "link" if place.isdigit() else ""
        phrase: str = self.texts["mistake_here"][kind]
        return phrase.format(where=place_letters(place))

    def _not_known(self, answer: GradedAnswer) -> str:
        if answer.miscomputed and answer.local is not None:
            return self._wording("recompute").format(
                local=self.formatter.close_to(answer.local, answer)
            )
        if answer.key is None or answer.key.mm is None or not answer.key.segment:
            return self.texts.unknown_computed
        return self.texts.unknown.format(segment=segment_letters(answer.key.segment))

    def _unexplained(self) -> Iterator[str]:
        """Yield a remark on each wrong answer that no diagnosis speaks of."""
        spoken = {id for diagnosis in self.checked.diagnosis for id in diagnosis.roots}
        follow: list[GradedAnswer] = []
        for judged in self._of(Verdict.WRONG):
            if judged.id in spoken:
                continue
            if self._is_consequence(judged):
                follow.append(judged)
            elif judged.sense_right is False and self._is_within_tolerance(judged):
                continue  # said of its sense
            elif not judged.slip:
                yield f"{self._compared(judged)} {self._not_known(judged)}"
        if follow:
            yield self.texts.follow.format(answers=self._listed(follow))

    def _is_consequence(self, answer: GradedAnswer) -> bool:
        """Return whether a mistake that has a name gives this answer, too."""
        if answer.value is None:
            return False
        return any(
            abs(abs(answer.value) - abs(d.values[answer.id])) <= (answer.tolerance or 0.0)
            for d in self.checked.diagnosis
            if d.sure and answer.id in d.values
        )

    @staticmethod
    def _is_within_tolerance(answer: GradedAnswer) -> bool:
        key = answer.key
        if key is None or answer.value is None:
            return False
        allowed = answer.tolerance or key.tolerance
        return abs(abs(answer.value) - abs(key.exact)) <= allowed

    # What follows ------------------------------------------------------------------------------

    def _inherited(self) -> Iterator[str]:
        groups: dict[str, list[GradedAnswer]] = {}
        for judged in self._of(Verdict.INHERITED):
            groups.setdefault(judged.follows, []).append(judged)
        for source, judged_here in groups.items():
            told = self._answers_with_ids((source,))
            yield self.texts.inherited.format(
                answers=self._listed(judged_here),
                source=self.formatter.symbol(told[0]) if told else quoted(source),
                points=self._points(judged_here),
            )

    def _points(self, answers: Iterable[GradedAnswer]) -> str:
        listed = [one for one in answers if not lacks_sense(one)]
        points, of = sum(j.points for j in listed), sum(j.of for j in listed)
        if points >= of - 1e-9:
            return self.texts.kept
        return self.texts.reduced.format(
            points=self.formatter.points(points), of=self.formatter.points(of)
        )

    # One by one --------------------------------------------------------------------------------

    def _singly(self) -> Iterator[str]:
        texts, speech = self.texts, self.formatter
        for judged in self.checked.answers:
            key, places = judged.key, {"answer": speech.symbol(judged)}
            if key is None:
                continue
            places |= {
                "own": speech.student_value(judged),
                "right": speech.right(key, judged.tolerance),
            }
            local = None if judged.local is None else speech.close_to(judged.local, judged)
            if judged.verdict is Verdict.NEAR:
                yield self._wording("near").format(**places, points=self._lost_points(judged))
            elif judged.verdict is Verdict.INCONSISTENT and local:
                yield texts.inconsistent.format(**places, local=local)
            if (
                judged.sense_right is False
                and self._is_within_tolerance(judged)
                and not self._is_root(judged)
            ):
                yield self._wording("sense").format(**places | {"right": self._sense(key.sense)})
            if judged.slip:
                yield self._slipped(judged)
            if judged.remark:
                yield f"{places['answer']}: {quoted(judged.remark)}"

    def _sense(self, sense: Sense | None) -> str:
        return "" if sense is None else " ".join(self.formatter.texts["senses"][sense.value])

    def _lost_points(self, answer: GradedAnswer) -> str:
        if answer.points >= answer.of:
            return ""
        share = self.formatter.points
        return self.texts.near_points.format(points=share(answer.points), of=share(answer.of))

    def _slipped(self, answer: GradedAnswer) -> str:
        key, written = answer.key, answer.written
        assert key is not None
        per_mm = self.checked.work.scales.get(key.scale) or self.scales.get(key.scale)
        if written is None or written.mm is None or not per_mm or answer.value is None:
            return self.texts.slip_bare.format(
                answer=self.formatter.symbol(answer), own=self.formatter.student_value(answer)
            )
        return self.texts.slip.format(
            answer=self.formatter.symbol(answer),
            mm=self.formatter.number(written.mm),
            scale=self.formatter.number(per_mm),
            product=self.formatter.si(written.mm * per_mm, key),
            own=self.formatter.student_value(answer),
        )

    def _missing(self) -> Iterator[str]:
        unseen = list(self._of(Verdict.UNSEEN))
        if unseen:
            yield self.texts.unseen.format(answers=self._listed(unseen))
        senseless = [judged for judged in self.checked.answers if lacks_sense(judged)]
        if senseless:
            yield self.texts.no_sense.format(answers=self._listed(senseless))
        blank = list(self._of(Verdict.BLANK))
        if blank:
            yield self.texts.blank.format(answers=self._listed(blank))
        for judged in self._of(Verdict.UNREADABLE):
            phrase = self.texts.unreadable if judged in self.checked.open else ""
            yield (phrase or self.texts.unreadable_decided).format(
                answer=self.formatter.symbol(judged),
                reason="" if judged.written is None else self.formatter.unread(judged.written),
                where=self._cell(judged.location),
                points=self.formatter.points(judged.points),
                of=self.formatter.points(judged.of),
            )
        for written in self.checked.work.remarks:
            as_placed = written.reason in PLACED
            phrase = self.texts.as_placed if as_placed else self.texts.unreadable_other
            yield phrase.format(
                reason=self.formatter.unread(written), where=self._cell(written.location)
            )

    def _cell(self, location: str) -> str:
        return f" ({quoted(location)})" if location else ""

    def _instructor_remark(self) -> Iterator[str]:
        if self.checked.remark:
            yield self.texts.remark.format(remark=quoted(self.checked.remark))

    # Pieces ------------------------------------------------------------------------------------

    @property
    def _codes(self) -> Mapping[str, object]:
        texts: MessageTable = self.formatter.texts["mistakes"]
        return texts

    def _compared(self, answer: GradedAnswer) -> str:
        if answer.key is None:
            return self.formatter.symbol(answer)
        return self._wording("compared").format(
            answer=self.formatter.symbol(answer),
            own=self.formatter.student_value(answer) or "—",
            right=self.formatter.right(answer.key, answer.tolerance),
        )

    def _answers_with_ids(self, ids: Iterable[str]) -> list[GradedAnswer]:
        by_id = {judged.id: judged for judged in self.checked.answers}
        return [by_id[id] for id in ids if id in by_id]

    def _of(self, verdict: Verdict) -> Iterator[GradedAnswer]:
        return (judged for judged in self.checked.answers if judged.verdict is verdict)

    def _is_root(self, answer: GradedAnswer) -> bool:
        return any(answer.id in diagnosis.roots for diagnosis in self.checked.diagnosis)

    def _listed(self, answers: Iterable[GradedAnswer]) -> str:
        return ", ".join(self.formatter.symbol(judged) for judged in answers)


def quote_unread(written: WrittenAnswer) -> str:
    """Return the unreadable text as it was written."""
    return quoted(written.raw or written.fault or written.unreadable)


def lacks_sense(answer: GradedAnswer) -> bool:
    """Return whether the requested sense of an answer is missing, at the cost of points."""
    key, written = answer.key, answer.written
    if key is None or written is None or not key.asks_sense or answer.is_manual:
        return False
    is_right = answer.verdict not in (Verdict.WRONG, Verdict.BLANK, Verdict.UNREADABLE)
    missing = written.sense is None and answer.sense_right is None
    return is_right and missing and answer.points < answer.of


def segment_letters(segment: str) -> str:
    """Return the letters of a segment as rich text: ``p-b3`` gives ``pb_{3}``."""
    return "".join(_letter(end) for end in segment.split("-"))


def _letter(end: str) -> str:
    head, tail = end[:1], end[1:].lstrip("_")
    return f"{head}_{{{tail}}}" if tail else head


def scale_letters(name: str) -> str:
    """Return the letters of a scale: ``mu_v`` gives ``μ_{v}``."""
    return f"μ_{{{name.removeprefix('mu_')}}}"


def place_letters(place: str) -> str:
    """Return where a mistake was made, as it is written: a scale with its letter, a force."""
    if "_{" in place:
        return place
    return scale_letters(place) if place.startswith("mu_") else quoted(place)
