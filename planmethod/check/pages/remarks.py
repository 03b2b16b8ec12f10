"""Remarks for a student, sentence by sentence, starting with the first mistake (замечания)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from msgspec import Struct

from planmethod.check.model import CheckedWork, Diagnosis, Judged, Sense, Verdict, WrittenAnswer
from planmethod.check.pages.speech import Speech, quoted
from planmethod.note.wording import Words
from planmethod.plans.model import FACTS, RATES

PLANS = {FACTS[kind].scale: kind for kind in RATES}
OFF = (Verdict.WRONG, Verdict.NEAR)

ON_PAPER = {"slip", "scale", "S1", "S2", "S3", "S4"}
"""Mistakes in a number: the segment that it was read off is right."""


class Remarks(Struct, frozen=True):
    """Remarks on one submission, rich text.

    Attributes
    ----------
    speech : Speech
    checked : CheckedWork
    scales : mapping of str to float
        Scales of the key, used if the student states none.
    hidden : tuple of str
        Codes of the mistakes that none of the answers can show.
    values : bool
        Whether the right values are shown.
    """

    speech: Speech
    checked: CheckedWork
    scales: Mapping[str, float]
    hidden: tuple[str, ...] = ()
    values: bool = True

    @property
    def say(self) -> Words:
        """Words of a student's page."""
        said: Words = self.speech.say["student"]
        return said

    def _wording(self, name: str) -> str:
        """Return a sentence with the right value in it, or that which goes without."""
        said: str = self.say[name] if self.values else self.say["without"][name]
        return said

    def sentences(self) -> list[str]:
        """Return all remarks; one that all is right where it is."""
        told = [*self._by_hand(), *self._causes(), *self._unexplained(), *self._inherited()]
        told += [*self._singly(), *self._missing()]
        return [*(told or [self.say.all_right]), *self._hidden()]

    def _hidden(self) -> Iterator[str]:
        """Yield which mistakes may be there and do not show."""
        names = [self.speech.say["mistakes"][c].name for c in self.hidden if c in self._codes]
        if names:
            yield self.say.hidden.format(names="; ".join(names))

    def redraw(self) -> list[str]:
        """Return the segments to redraw: those where mistakes begin, else the wrong ones."""
        drawn = [d for d in self.checked.diagnosis if not d.codes or {*d.codes} - ON_PAPER]
        roots = [judged for d in drawn for judged in self._known(d.roots)]
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
            if plan is None or key.unit not in (FACTS[plan].unit, "mm") or self._fits(judged):
                continue
            lines.setdefault(
                (key.segment, key.scale),
                self._wording("redraw_line").format(
                    segment=segment_letters(key.segment),
                    plan=self.say["plan_names"][plan.value],
                    right=self.speech.mm(key.mm),
                ),
            )
        return list(lines.values())

    # Beginnings --------------------------------------------------------------------------------

    def _causes(self) -> Iterator[str]:
        """Yield a remark on each mistake that has a name, or on where the trouble begins."""
        for diagnosis in self.checked.diagnosis:
            roots = self._known(diagnosis.roots)
            if not roots:
                continue
            first, others = roots[0], roots[1:]
            if diagnosis.codes == ("slip",) and first.slip and not others:
                continue  # included in the remark on the student's own numbers
            parts = [self._compared(first), self._why(diagnosis, first)]
            if others:  # the same remark applies to them
                parts.append(self.say.also.format(answers=self._listed(others)))
            yield " ".join(filter(None, parts))

    def _why(self, diagnosis: Diagnosis, root: Judged) -> str:
        words = [self.speech.say["mistakes"][c] for c in diagnosis.codes if c in self._codes]
        if not words:
            return self._not_known(root)
        if diagnosis.codes == ("slip",) and not diagnosis.where:
            return ""  # included in the remark on the student's own numbers
        if not diagnosis.sure or len(words) > 1:
            names = "; ".join(word.name for word in words)
            end = self.say.one_of_end.format(answer=self.speech.symbol(root))
            return f"{self.say.one_of.format(names=names)} {end}"
        gives = diagnosis.values.get(root.id)
        many = "" if gives is None else self.speech.close_to(gives, root)
        so_many = f" ({many})" if self.values and many and many not in self.speech.own(root) else ""
        return self.say.mistake.format(
            value=so_many,
            so=words[0].so,
            where=self._where(diagnosis.where),
            advice=words[0].advice,
        )

    def _where(self, where: str) -> str:
        if not where:
            return ""
        if " ≠ " in where:  # a formula in place of another one
            wrong, right = where.split(" ≠ ")
            return str(self.say.mistake_instead.format(wrong=wrong, right=right))
        kind = "pair" if "/" in where else "link" if where.isdigit() else ""
        said: str = self.say["mistake_here"][kind]
        return said.format(where=place_letters(where))

    def _not_known(self, judged: Judged) -> str:
        if judged.miscomputed and judged.local is not None:
            return self._wording("recompute").format(
                local=self.speech.close_to(judged.local, judged)
            )
        if judged.key is None or judged.key.mm is None or not judged.key.segment:
            return self.say.unknown_computed
        return self.say.unknown.format(segment=segment_letters(judged.key.segment))

    def _unexplained(self) -> Iterator[str]:
        """Yield a remark on each wrong answer that no diagnosis speaks of."""
        spoken = {id for diagnosis in self.checked.diagnosis for id in diagnosis.roots}
        follow: list[Judged] = []
        for judged in self._of(Verdict.WRONG):
            if judged.id in spoken:
                continue
            if self._is_consequence(judged):
                follow.append(judged)
            elif judged.sense_right is False and self._fits(judged):
                continue  # said of its sense
            elif not judged.slip:
                yield f"{self._compared(judged)} {self._not_known(judged)}"
        if follow:
            yield self.say.follow.format(answers=self._listed(follow))

    def _is_consequence(self, judged: Judged) -> bool:
        """Return whether a mistake that has a name gives this answer, too."""
        if judged.value is None:
            return False
        return any(
            abs(abs(judged.value) - abs(d.values[judged.id])) <= (judged.tolerance or 0.0)
            for d in self.checked.diagnosis
            if d.sure and judged.id in d.values
        )

    @staticmethod
    def _fits(judged: Judged) -> bool:
        key = judged.key
        if key is None or judged.value is None:
            return False
        allowed = judged.tolerance or key.tolerance
        return abs(abs(judged.value) - abs(key.exact)) <= allowed

    # What follows ------------------------------------------------------------------------------

    def _inherited(self) -> Iterator[str]:
        groups: dict[str, list[Judged]] = {}
        for judged in self._of(Verdict.INHERITED):
            groups.setdefault(judged.follows, []).append(judged)
        for source, judged_here in groups.items():
            told = self._known((source,))
            yield self.say.inherited.format(
                answers=self._listed(judged_here),
                source=self.speech.symbol(told[0]) if told else quoted(source),
                points=self._points(judged_here),
            )

    def _points(self, judged: Iterable[Judged]) -> str:
        listed = [one for one in judged if not lacks_sense(one)]
        points, of = sum(j.points for j in listed), sum(j.of for j in listed)
        if points >= of - 1e-9:
            return self.say.kept
        return self.say.reduced.format(points=self.speech.share(points), of=self.speech.share(of))

    # One by one --------------------------------------------------------------------------------

    def _singly(self) -> Iterator[str]:
        say, speech = self.say, self.speech
        for judged in self.checked.answers:
            key, places = judged.key, {"answer": speech.symbol(judged)}
            if key is None:
                continue
            places |= {"own": speech.own(judged), "right": speech.right(key, judged.tolerance)}
            local = None if judged.local is None else speech.close_to(judged.local, judged)
            if judged.verdict is Verdict.NEAR:
                yield self._wording("near").format(**places, points=self._lost(judged))
            elif judged.verdict is Verdict.INCONSISTENT and local:
                yield say.inconsistent.format(**places, local=local)
            if judged.sense_right is False and self._fits(judged) and not self._is_root(judged):
                yield self._wording("sense").format(**places | {"right": self._sense(key.sense)})
            if judged.slip:
                yield self._slipped(judged)
            if judged.remark:
                yield f"{places['answer']}: {quoted(judged.remark)}"

    def _sense(self, sense: Sense | None) -> str:
        return "" if sense is None else " ".join(self.speech.say["senses"][sense.value])

    def _lost(self, judged: Judged) -> str:
        if judged.points >= judged.of:
            return ""
        share = self.speech.share
        return self.say.near_points.format(points=share(judged.points), of=share(judged.of))

    def _slipped(self, judged: Judged) -> str:
        key, written = judged.key, judged.written
        assert key is not None
        per_mm = self.checked.work.scales.get(key.scale) or self.scales.get(key.scale)
        if written is None or written.mm is None or not per_mm or judged.value is None:
            return self.say.slip_bare.format(
                answer=self.speech.symbol(judged), own=self.speech.own(judged)
            )
        return self.say.slip.format(
            answer=self.speech.symbol(judged),
            mm=self.speech.number(written.mm),
            scale=self.speech.number(per_mm),
            product=self.speech.si(written.mm * per_mm, key),
            own=self.speech.own(judged),
        )

    def _missing(self) -> Iterator[str]:
        unseen = list(self._of(Verdict.UNSEEN))
        if unseen:
            yield self.say.unseen.format(answers=self._listed(unseen))
        senseless = [judged for judged in self.checked.answers if lacks_sense(judged)]
        if senseless:
            yield self.say.no_sense.format(answers=self._listed(senseless))
        blank = list(self._of(Verdict.BLANK))
        if blank:
            yield self.say.blank.format(answers=self._listed(blank))
        for judged in self._of(Verdict.UNREADABLE):
            said = self.say.unreadable if judged in self.checked.open else ""
            yield (said or self.say.unreadable_decided).format(
                answer=self.speech.symbol(judged),
                reason="" if judged.written is None else self.speech.unread(judged.written),
                where=self._cell(judged.where),
                points=self.speech.share(judged.points),
                of=self.speech.share(judged.of),
            )
        for written in self.checked.work.remarks:
            yield self.say.unreadable_other.format(
                reason=self.speech.unread(written), where=self._cell(written.where)
            )

    def _cell(self, where: str) -> str:
        return f" ({quoted(where)})" if where else ""

    def _by_hand(self) -> Iterator[str]:
        if self.checked.remark:
            yield self.say.remark.format(remark=quoted(self.checked.remark))

    # Pieces ------------------------------------------------------------------------------------

    @property
    def _codes(self) -> Mapping[str, object]:
        said: Words = self.speech.say["mistakes"]
        return said

    def _compared(self, judged: Judged) -> str:
        if judged.key is None:
            return self.speech.symbol(judged)
        return self._wording("compared").format(
            answer=self.speech.symbol(judged),
            own=self.speech.own(judged) or "—",
            right=self.speech.right(judged.key, judged.tolerance),
        )

    def _known(self, ids: Iterable[str]) -> list[Judged]:
        by_id = {judged.id: judged for judged in self.checked.answers}
        return [by_id[id] for id in ids if id in by_id]

    def _of(self, verdict: Verdict) -> Iterator[Judged]:
        return (judged for judged in self.checked.answers if judged.verdict is verdict)

    def _is_root(self, judged: Judged) -> bool:
        return any(judged.id in diagnosis.roots for diagnosis in self.checked.diagnosis)

    def _listed(self, answers: Iterable[Judged]) -> str:
        return ", ".join(self.speech.symbol(judged) for judged in answers)


def what_stands(written: WrittenAnswer) -> str:
    """Return the unreadable text as it was written."""
    return quoted(written.raw or written.fault or written.unreadable)


def lacks_sense(judged: Judged) -> bool:
    """Return whether the requested sense of an answer is missing, at the cost of points."""
    key, written = judged.key, judged.written
    if key is None or written is None or not key.asks_sense or judged.by_hand:
        return False
    is_right = judged.verdict not in (Verdict.WRONG, Verdict.BLANK, Verdict.UNREADABLE)
    missing = written.sense is None and judged.sense_right is None
    return is_right and missing and judged.points < judged.of


def segment_letters(segment: str) -> str:
    """Return the letters of a segment as rich text: ``p-b3`` gives ``pb_{3}``."""
    return "".join(_letter(end) for end in segment.split("-"))


def _letter(end: str) -> str:
    head, tail = end[:1], end[1:].lstrip("_")
    return f"{head}_{{{tail}}}" if tail else head


def scale_letters(name: str) -> str:
    """Return the letters of a scale: ``mu_v`` gives ``μ_{v}``."""
    return f"μ_{{{name.removeprefix('mu_')}}}"


def place_letters(where: str) -> str:
    """Return where a mistake was made, as it is written: a scale with its letter."""
    return scale_letters(where) if where.startswith("mu_") else quoted(where)
