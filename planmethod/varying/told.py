"""Report on a choice of variants: varied numbers, rejections, reasons (отчёт о подборе)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from planmethod.note.document import Item, Node, Paragraph, table_of
from planmethod.note.formula import escape
from planmethod.note.wording import Language
from planmethod.varying.choice import APART, VariantChoice
from planmethod.varying.judged import Place
from planmethod.varying.sieve import LEAST_MM, MARGIN, WORST, Refusal
from planmethod.varying.varied import VariedKey

NAMED = 6
"""Answers that are named of those that candidates were refused for, the commonest."""


def told_document(choice: VariantChoice, words: Language) -> Iterator[Node]:
    """Yield what was varied, how many candidates there were, why some were refused."""
    say, number = words.vary, words.say.given
    count = len(choice.variants)
    yield Paragraph(say.found.format(found=count, wanted=choice.wanted, tried=choice.tried))
    if choice.drawn:
        facts = {"margin": number(MARGIN), "mm": number(LEAST_MM), "worst": number(100 * WORST)}
        yield Paragraph(say.bounds.format(**facts))
    yield table_of(say["columns"], [_row(one, words) for one in choice.keys], names=1)
    why: Counter[Refusal] = Counter()
    for (cause, _), times in choice.refused.items():
        why[cause] += times
    if why:
        yield Paragraph(say.refused)
    for cause, times in why.most_common():
        names = _named(cause, choice, words)
        among = say.among.format(names=names) if names else ""
        yield Item(say.because.format(times=times, why=say["why"][cause.value], names=among))
    for name, of in choice.excused:
        yield Paragraph(say.excused.format(condition=say["conditions"][name], of=escape(of)))
    if count > 1:
        lost, least = number(round(100 * choice.least)), number(100 * APART)
        yield Paragraph(say.apart.format(lost=lost, least=least))
    if not choice.family:
        return
    yield Paragraph(say.family.format(count=choice.family))
    untold: dict[Place, list[str]] = {}
    for one in choice.variants:
        for place in one.untold:
            untold.setdefault(place, []).append(one.name)
    if untold:
        yield Paragraph(say.untold)
    for (code, where), those in sorted(untold.items()):
        told = say.nowhere if len(those) == count else say.variants.format(names=", ".join(those))
        yield Item(
            say.untold_in.format(code=escape(f"{code} {where}".rstrip()), where=escape(told))
        )


def _row(one: VariedKey, words: Language) -> list[str]:
    number = words.say.given
    if one.of:
        span = words.vary.share.format(length=escape(one.of))
    else:
        span = f"{number(min(one.values))} … {number(max(one.values))}"
    return [escape(one.shown), number(one.base), span, str(len(one.values)) if one.values else ""]


def _named(why: Refusal, choice: VariantChoice, words: Language) -> str:
    """Return what candidates were refused for, and how many: ``a_E 12, v_B 3``."""
    found = Counter(
        {what: n for (cause, what), n in choice.refused.items() if cause is why and what}
    )
    shown = words.vary["conditions"] if why is Refusal.CONDITION else {}
    return ", ".join(
        f"{escape(shown.get(what, what))} {times}" for what, times in found.most_common(NAMED)
    )
