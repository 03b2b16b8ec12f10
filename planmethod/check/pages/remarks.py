"""Remarks for a student, starting with the first mistake, and numbers as a person reads them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property

from msgspec import Struct

from planmethod.check.form import describe
from planmethod.check.key import SEGMENT_CODES
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
from planmethod.note.document import NO_BREAK, plain_text
from planmethod.note.formula import Rich, escape
from planmethod.note.numbers import ZERO_TOLERANCE, trimmed
from planmethod.note.wording import Language, MessageTable
from planmethod.note.writers.formulas import without_control_characters
from planmethod.plans.model import FACTS, RATES, PlanKind

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

    def in_words(self, key: KeyEntry) -> Rich:
        """Return a requested quantity in words with its letters."""
        letters = self.letters(key)
        words = describe(key, plain_text(letters), self.language)
        return ", ".join(filter(None, (words, letters)))

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
        if abs(value) > abs(key.exact) * 3 and key.exact:
            allowed = max(allowed, abs(value) / 1000)
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
UNITS_ON_PLANS = ("mm", *(facts.unit for facts in FACTS.values()))
"""Units of quantities that are a segment times a scale; ω and ε are computed from these."""

OFF = (Verdict.WRONG, Verdict.NEAR)

OF_SCALE = {"scale", "S1", "S3"}

ON_PAPER = {"slip", "swap", "S2", "S4", *OF_SCALE, *SEGMENT_CODES.values()}
"""Mistakes in a number, or in reading it: the segments are right."""

SWAP = ("swap",)

SAME = 0.002
"""Relative difference up to which the number that a mistake gives is the student's."""


class Remarks(Struct, frozen=True, dict=True):
    """Remarks on one submission, rich text.

    Attributes
    ----------
    formatter : AnswerFormatter
    checked : GradedSubmission
    scales : mapping of str to float
        Scales of the key, used if the student states none.
    values : bool
        Whether the right values are shown.
    """

    formatter: AnswerFormatter
    checked: GradedSubmission
    scales: Mapping[str, float]
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
        """Return all remarks; the first one says that all is right where it is."""
        told = [
            *self._instructor_remark(),
            *self._causes(),
            *self._unexplained(),
            *self._inherited(),
            *self._singly(),
            *self._missing(),
        ]
        is_whole = self.checked.points >= self.checked.of - 1e-9
        return [*(told or [self.texts.all_right] * is_whole), *self._unseen()]

    def redraw(self) -> list[str]:
        """Return the segments to redraw: those where mistakes begin, else the wrong ones."""
        if self._other_variant:
            return []
        drawn = [d for d in self.checked.diagnosis if not d.codes or {*d.codes} - ON_PAPER]
        roots = [judged for d in drawn for judged in self._answers_with_ids(d.roots)]
        if self.checked.diagnosis and not roots:
            return []
        off = [judged for judged in self.checked.answers if judged.verdict in OFF]
        lines: dict[tuple[str, str], str] = {}
        for judged in roots or off:
            key = judged.key
            if key is None or key.mm is None or not self._is_to_redraw(judged):
                continue
            lines.setdefault(
                (key.segment, key.scale),
                self._wording("redraw_line").format(
                    segment=segment_letters(key.segment),
                    plan=self.texts["plan_names"][PLANS[key.scale].value],
                    right=self.formatter.mm(key.mm),
                ),
            )
        return list(lines.values())

    def _is_to_redraw(self, answer: GradedAnswer) -> bool:
        """Return whether the segment of a wrong answer is wrong: not only its number."""
        key = answer.key
        if key is None or not key.segment or answer.verdict not in OFF:
            return False
        # A number derived from a segment does not show that the segment is wrong.
        if not _is_of_segment(key):
            return False
        # A computed number is laid off after it was computed.
        is_of_number = (answer.slip or answer.miscomputed) and not key.computed
        return not is_of_number and not self._is_within_tolerance(answer)

    # Beginnings --------------------------------------------------------------------------------

    @cached_property
    def _other_variant(self) -> bool:
        """True if the whole submission is of another variant: nothing else is worth saying."""
        return any(d.sure and d.codes == ("P2",) for d in self.checked.diagnosis)

    @cached_property
    def _exchanged(self) -> dict[str, GradedAnswer]:
        """Second answer of two that are each in the other's place, by the id of the first."""
        found: dict[str, GradedAnswer] = {}
        for diagnosis in self.checked.diagnosis:
            for one in self._answers_with_ids(diagnosis.roots if diagnosis.codes == SWAP else ()):
                key = one.key
                if key is None:
                    continue
                others = [
                    (abs(abs(two.value) - abs(key.exact)), number)
                    for number, two in enumerate(self.checked.answers)
                    if two.follows == one.id and two.value is not None and two.key is not None
                    if two.key.unit == key.unit
                ]
                if others:
                    found[one.id] = self.checked.answers[min(others)[1]]
        return found

    def _lengths(self, answers: Iterable[GradedAnswer]) -> str:
        """Return the right lengths of segments, to compare with."""
        keys = [a.key for a in answers if a.key is not None and _is_of_segment(a.key)]
        lengths = (
            self.texts.length.format(
                segment=segment_letters(key.segment), mm=self.formatter.mm(key.mm)
            )
            for key in keys
            if key.mm is not None and self.values
        )
        told = ", ".join(lengths)
        return self.texts.not_redrawn.format(lengths=told) if told else ""

    def _causes(self) -> Iterator[str]:
        """Yield a remark on each mistake that has a name."""
        for diagnosis in self.checked.diagnosis:
            roots = self._answers_with_ids(diagnosis.roots)
            if not roots or not self._names(diagnosis):
                continue
            first, others = roots[0], roots[1:]
            if diagnosis.codes == ("slip",) and first.slip and not others:
                continue  # included in the remark on the student's own numbers
            parts = [self._compared(first), self._cause_text(diagnosis, first)]
            if first.id in self._exchanged:
                parts.append(self._lengths((first, self._exchanged[first.id])))
            if others and not self._other_variant:  # the same remark applies to them
                parts.append(self.texts.also.format(answers=self._listed(others)))
            yield " ".join(filter(None, parts))

    def _names(self, diagnosis: Diagnosis) -> list[str]:
        if diagnosis.codes == ("slip",) and not diagnosis.mistake_at:
            slipped = [one for one in self._answers_with_ids(diagnosis.roots) if one.slip]
            return ["slip"] if slipped else []  # else no cause is known
        return [code for code in diagnosis.codes if code in self._codes]

    def _cause_text(self, diagnosis: Diagnosis, first_wrong_answer: GradedAnswer) -> str:
        words = [self.formatter.texts["mistakes"][code] for code in self._names(diagnosis)]
        if diagnosis.codes == ("slip",) and not diagnosis.mistake_at:
            return ""  # included in the remark on the student's own numbers
        if len(words) > 1:
            names = "; ".join(word.name for word in words)
            end = self.texts.one_of_end.format(answer=self.formatter.symbol(first_wrong_answer))
            return f"{self.texts.one_of.format(names=names)} {end}"
        if not diagnosis.sure:
            return self.texts.perhaps.format(name=words[0].name, advice=words[0].advice)
        gives, value = diagnosis.values.get(first_wrong_answer.id), first_wrong_answer.value
        many = "" if gives is None else self.formatter.close_to(gives, first_wrong_answer)
        is_told = gives is None or abs(abs(gives) - abs(value or 0.0)) <= SAME * abs(gives)
        return self.texts.mistake.format(
            value="" if is_told or not self.values else f" ({many})",
            so=words[0].so,
            where=self._place_text(diagnosis.mistake_at, diagnosis.codes[0]),
            advice=words[0].advice,
        )

    def _place_text(self, place: str, code: str) -> str:
        if not place:
            return ""
        if " ≠ " in place:  # a formula in place of another one
            wrong, right = place.split(" ≠ ")
            return str(self.texts.mistake_instead.format(wrong=wrong, right=right))
        kind = "pair" if "/" in place else "link" if place.isdigit() else ""
        if code in SEGMENT_CODES.values() and "-" in place:
            kind = "segment"
        phrases: MessageTable = self.texts["mistake_here"]
        own = next(name for name in (f"{code} {kind or place}", code, kind) if name in phrases)
        letters = segment_letters(place) if kind == "segment" else place_letters(place)
        return str(phrases[own].format(where=letters))

    def _unexplained(self) -> Iterator[str]:
        """Yield remarks on wrong answers that no mistake with a name explains.

        Those without a known cause share a remark.
        """
        found = [d for d in self.checked.diagnosis if self._names(d)]
        spoken = {id for diagnosis in found for id in diagnosis.roots}
        follow: list[GradedAnswer] = []
        unknown: dict[str, list[GradedAnswer]] = {}
        for judged in self._of(Verdict.WRONG):
            if judged.id in spoken or self._other_variant:
                continue
            if self._is_consequence(judged):
                follow.append(judged)
            elif judged.sense_right is False and self._is_within_tolerance(judged):
                continue  # said of its sense
            elif judged.miscomputed and judged.local is not None:
                local = self.formatter.close_to(judged.local, judged)
                yield f"{self._compared(judged)} {self._wording('recompute').format(local=local)}"
            elif not judged.slip:
                unknown.setdefault(_place_to_check(judged), []).append(judged)
        for place, group in unknown.items():
            keys = (judged.key for judged in group)
            segments = dict.fromkeys(key.segment for key in keys if key is not None)
            end = self.texts[place].format(segments=", ".join(map(segment_letters, segments)))
            yield " ".join([*map(self._compared, group), end])
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
            if judged in self._exchanged.values() or self._other_variant:
                continue
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
        scales = {d.mistake_at for d in self.checked.diagnosis if {*d.codes} & OF_SCALE}
        for judged in self.checked.answers:
            key, places = judged.key, {"answer": speech.symbol(judged)}
            if judged.remark:
                yield f"{places['answer']}: {quoted(judged.remark)}"
            if key is None or self._other_variant:
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
            is_turned = judged.sense_right is False and self._is_within_tolerance(judged)
            if is_turned and not (self._is_root(judged) or judged.verdict is Verdict.INHERITED):
                yield self._wording("sense").format(**places | {"right": self._sense(key.sense)})
            if judged.slip and key.scale not in scales:  # said of the scale
                yield self._slipped(judged)

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
        if written is not None and written.mm and key.mm and key.unit not in UNITS_ON_PLANS:
            found = self.formatter.si(abs(key.exact) * written.mm / key.mm, key)
            return f"{self._compared(answer)} {self._wording('recompute').format(local=found)}"
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

    def _unseen(self) -> Iterator[str]:
        unseen = list(self._of(Verdict.UNSEEN))
        if unseen and not self._other_variant:
            yield self.texts.unseen.format(answers=self._listed(unseen))

    def _missing(self) -> Iterator[str]:
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
        symbol = self.formatter.symbol(answer)
        return self._wording("compared").format(
            answer=f"{symbol} ({self.texts.extra})" if is_extra(answer) else symbol,
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


def _is_of_segment(key: KeyEntry) -> bool:
    """Return whether an answer is the length of a segment of a motion plan, in its unit."""
    plan = PLANS.get(key.scale)
    is_drawn = key.mm is not None and bool(key.segment)
    return plan is not None and is_drawn and key.unit in (FACTS[plan].unit, "mm")


def _place_to_check(answer: GradedAnswer) -> str:
    """Return the name of the sentence on what to check in a wrong answer without a known cause."""
    key = answer.key
    if key is None or key.computed or key.mm is None:
        return "unknown_computed"
    if key.scale == FACTS[PlanKind.FORCE].scale:
        return "unknown_forces"
    return "unknown" if _is_of_segment(key) else "unknown_computed"


def is_extra(answer: GradedAnswer) -> bool:
    """Return whether an answer was not requested: it counts nothing."""
    return not (answer.of or answer.points or answer.is_manual)


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
