"""Report on a choice of variants: varied numbers, rejections, reasons (отчёт о подборе)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from planmethod.note.document import Item, Node, Paragraph, table_of
from planmethod.note.formula import escape
from planmethod.note.wording import Language
from planmethod.varying.choice import MIN_LOST_FRACTION, VariantChoice
from planmethod.varying.evaluation import Place
from planmethod.varying.parameters import VariedKey
from planmethod.varying.screening import (
    MAX_RELATIVE_SIGMA,
    MIN_LENGTH_MM,
    MIN_MARGIN,
    RejectionReason,
)

NAMED = 6
"""Answers that are named of those that candidates were refused for, the commonest."""


def report_choice(choice: VariantChoice, language: Language) -> Iterator[Node]:
    """Yield what was varied, how many candidates there were, why some were refused."""
    texts, number = language.vary, language.notation.as_input
    count = len(choice.variants)
    yield Paragraph(texts.found.format(found=count, wanted=choice.requested, tried=choice.tried))
    if choice.drawn:
        facts = {
            "margin": number(MIN_MARGIN),
            "mm": number(MIN_LENGTH_MM),
            "worst": number(100 * MAX_RELATIVE_SIGMA),
        }
        yield Paragraph(texts.bounds.format(**facts))
    yield table_of(texts["columns"], [_row(one, language) for one in choice.keys], names=1)
    why: Counter[RejectionReason] = Counter()
    for (cause, _), times in choice.rejections.items():
        why[cause] += times
    if why:
        yield Paragraph(texts.refused)
    for cause, times in why.most_common():
        names = _named(cause, choice, language)
        among = texts.among.format(names=names) if names else ""
        yield Item(texts.because.format(times=times, why=texts["why"][cause.value], names=among))
    for name, of in choice.waived:
        yield Paragraph(texts.excused.format(condition=texts["conditions"][name], of=escape(of)))
    if count > 1:
        lost, least = number(round(100 * choice.min_lost_fraction)), number(100 * MIN_LOST_FRACTION)
        yield Paragraph(texts.apart.format(lost=lost, least=least))
    if not choice.family:
        return
    yield Paragraph(texts.family.format(count=choice.family))
    untold: dict[Place, list[str]] = {}
    for one in choice.variants:
        for place in one.indistinct:
            untold.setdefault(place, []).append(one.name)
    if untold:
        yield Paragraph(texts.untold)
    for (code, where), those in sorted(untold.items()):
        text = (
            texts.nowhere if len(those) == count else texts.variants.format(names=", ".join(those))
        )
        yield Item(
            texts.untold_in.format(code=escape(f"{code} {where}".rstrip()), where=escape(text))
        )


def _row(one: VariedKey, language: Language) -> list[str]:
    number = language.notation.as_input
    if one.of:
        span = language.vary.share.format(length=escape(one.of))
    else:
        span = f"{number(min(one.values))} … {number(max(one.values))}"
    return [
        escape(one.spelling),
        number(one.base),
        span,
        str(len(one.values)) if one.values else "",
    ]


def _named(reason: RejectionReason, choice: VariantChoice, language: Language) -> str:
    """Return what candidates were refused for, and how many: ``a_E 12, v_B 3``."""
    found = Counter(
        {what: n for (cause, what), n in choice.rejections.items() if cause is reason and what}
    )
    shown = language.vary["conditions"] if reason is RejectionReason.CONDITION else {}
    return ", ".join(
        f"{escape(shown.get(what, what))} {times}" for what, times in found.most_common(NAMED)
    )
