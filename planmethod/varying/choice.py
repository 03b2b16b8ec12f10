"""Variants chosen from candidates: distinct, each distinguishing all mistakes; the report."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from random import Random

import numpy as np
import numpy.typing as npt
from msgspec import Struct, field

from planmethod.check.marks import DEFAULT, Settings
from planmethod.errors import PlanMethodError
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import solve_motion
from planmethod.kinds import kind_of
from planmethod.note.document import Item, Node, Paragraph, table_of
from planmethod.note.formula import escape
from planmethod.note.wording import Language
from planmethod.problem.records import KindProblem
from planmethod.varying.evaluation import (
    MAX_RELATIVE_SIGMA,
    MIN_LENGTH_MM,
    MIN_MARGIN,
    AnswerColumns,
    CandidateEvaluator,
    EvaluatedVariant,
    Place,
    Rejection,
    RejectionReason,
    evaluator_of,
)
from planmethod.varying.parameters import (
    WHEEL,
    Overrides,
    ValueSampler,
    VariantCandidates,
    VariedKey,
    coaxial_rows,
    default_keys,
    label_of,
    make_coaxial,
    overrides,
    parse_vary,
    with_followers,
)

BATCH_SIZE = 60
"""Number of candidates that are evaluated together."""

PER_VARIANT = 300
"""Default maximum of candidates for each requested variant."""

MIN_LOST_FRACTION = 0.6
"""Minimum fraction of the points that a copied variant loses."""

FAMILY_FRACTION = 0.5
"""Fraction of good candidates distinguishing a mistake from which every variant must."""

TRIED_FIRST = 8
"""VariantCandidates from which the family is known."""

REJECTION_WEIGHT = {
    RejectionReason.SHORT: 0.01,
    RejectionReason.UNSEEN: 0.05,
    RejectionReason.HIDDEN: 0.2,
}
"""Weight of a rejected candidate, relative to an accepted one."""


class ChosenVariant(Struct, frozen=True):
    """A variant of the table: its overrides of the file, and the mistakes it does not distinguish.

    Attributes
    ----------
    name : str
    overrides : mapping of str to value
        By dotted key.
    indistinct : tuple of (str, str)
        Possible mistakes that its answers do not distinguish from others: code and place.
    """

    name: str
    overrides: Overrides
    indistinct: tuple[Place, ...] = ()


class VariantChoice(Struct):
    """Results of the search (подобранные варианты).

    Attributes
    ----------
    variants : list of ChosenVariant
    requested, tried : int
        Number of requested variants, number of candidates tried.
    keys : tuple of VariedKey
    rejections : Counter
        Number of rejected candidates by reason and item.
    family : int
        Number of mistakes that every variant distinguishes.
    min_lost_fraction : float
        Smallest share of the points that a copy of one variant loses in another one.
    waived : tuple of (str, str)
        Conditions of teeth that the file itself does not meet, and the wheel of each.
    drawn : bool
        Whether plans are drawn: the task is a linkage.
    """

    requested: int
    keys: tuple[VariedKey, ...]
    variants: list[ChosenVariant] = field(default_factory=list)
    tried: int = 0
    rejections: Counter[tuple[RejectionReason, str]] = field(default_factory=Counter)
    family: int = 0
    min_lost_fraction: float = 1.0
    waived: tuple[Place, ...] = ()
    drawn: bool = True


Indices = npt.NDArray[np.intp]


class _Candidate(Struct, frozen=True, eq=False):
    """A candidate that may be chosen."""

    overrides: Overrides
    evaluated: EvaluatedVariant


class VariantSearch(Struct, frozen=True, kw_only=True):
    """Search for variants, as it is requested: the same seed finds the same.

    Attributes
    ----------
    count : int
        Number of variants.
    vary : str
        What is varied, ``links.1.OA,driver.phi=0..90``; the usual numbers when empty.
    spread : float
        Range of the numbers around those of the file, a fraction of them.
    tries : int, optional
        Most candidates.
    """

    count: int
    seed: int
    vary: str = ""
    spread: float = 0.3
    tries: int | None = None


def choose(
    path: Path,
    search: VariantSearch,
    *,
    settings: Settings = DEFAULT,
    done: Callable[[int], object] = lambda found: None,
) -> tuple[VariantCandidates, VariantChoice]:
    """Find variants of a problem file (подобрать варианты).

    Parameters
    ----------
    settings : Settings
        Of the department: they determine the tolerances of answers.
    done : callable
        Called with how many more variants there are.

    Raises
    ------
    PlanMethodError
        The file is faulty, or a requested key is not a number of it.
    """
    source = VariantCandidates(path, kind_of(path))
    table, count = source.table, search.count
    keys = (
        parse_vary(table, search.vary, search.spread)
        if search.vary
        else default_keys(table, search.spread)
    )
    chosen = with_followers(table, keys)
    (main,) = source.read({})
    if isinstance(main, PlanMethodError):
        raise main
    judge = evaluator_of(source.kind, main, settings)
    found = VariantChoice(
        count, tuple(chosen), waived=tuple(sorted(judge.waived)), drawn=judge.draws
    )
    lots, pool = ValueSampler(chosen, Random(search.seed)), _Pool(found, judge.main)
    draw, before, limit = _drawing(main, lots), set[str](), search.tries or PER_VARIANT * count
    while found.tried < limit and len(found.variants) < count:
        drawn: list[tuple[dict[VariedKey, float], Overrides]] = []
        for _ in range(min(BATCH_SIZE, limit - found.tried)):
            found.tried += 1
            values = draw()
            if values is None:
                found.rejections[RejectionReason.COAXIAL, ""] += 1
                continue
            own = overrides(table, values)
            if repr(own) in before:
                found.rejections[RejectionReason.DUPLICATE, ""] += 1
                continue
            before.add(repr(own))
            drawn.append((values, own))
        for (values, laid), one in zip(drawn, _outcomes(source, judge, drawn), strict=True):
            if isinstance(one, Rejection):
                found.rejections[one.reason, one.item] += 1
                lots.learn(values, REJECTION_WEIGHT.get(one.reason, 0.0))
            else:
                pool.add(_Candidate(laid, one))
                lots.learn(values, pool.weigh(one))
        already = len(found.variants)
        pool.choose(strict=True)
        done(max(0, len(found.variants) - already))
    if len(found.variants) < count:
        pool.choose(strict=False)
    pool.record_results(_given_scales(table))
    return source, found


def _drawing(main: KindProblem, lots: ValueSampler) -> Callable[[], dict[VariedKey, float] | None]:
    """Return what draws the values of a candidate: of a train such that it is coaxial."""
    if not isinstance(main, GearProblem):
        return lambda: lots.with_followers(lots.draw())
    motion = solve_motion(main)
    wheels = [label_of(one) for one in lots.free if one.name.startswith(WHEEL)]
    rows = coaxial_rows(motion, wheels)
    return lambda: make_coaxial(lots.draw(), rows, motion.axes.sizes)


def _outcomes(
    source: VariantCandidates,
    evaluator: CandidateEvaluator,
    drawn: Sequence[tuple[dict[VariedKey, float], Overrides]],
) -> list[EvaluatedVariant | Rejection]:
    if not drawn:
        return []
    read = list(source.read({str(k): own for k, (_, own) in enumerate(drawn)}))
    good = evaluator.evaluate([one for one in read if not isinstance(one, PlanMethodError)])
    return [
        Rejection(RejectionReason.FAULTY) if isinstance(one, PlanMethodError) else next(good)
        for one in read
    ]


def _given_scales(table: Mapping[str, object]) -> frozenset[str]:
    """Return the scales that a file gives: each variant then has its own."""
    scales = table.get("scales")
    return (
        frozenset(key for key in scales if key.startswith("mu_"))
        if isinstance(scales, dict)
        else frozenset()
    )


class _Pool:
    """Candidates that may be variants, and which of them are.

    Parameters
    ----------
    choice : VariantChoice
    main : EvaluatedVariant or None
        The file itself: no variant may be like it.
    """

    def __init__(self, choice: VariantChoice, main: EvaluatedVariant | None) -> None:
        self.choice, self.all = choice, list[_Candidate]()
        self.chosen: list[int] = []
        self._answers = AnswerColumns(main)
        self._told: Counter[Place] = Counter()
        self._judged: tuple[frozenset[Place], tuple[str, ...], int] = (frozenset(), (), 0)

    def weigh(self, one: EvaluatedVariant) -> float:
        """Return the weight of a candidate: less if it does not distinguish the whole family."""
        return REJECTION_WEIGHT[RejectionReason.HIDDEN] if self.family - one.distinguished else 1.0

    def add(self, one: _Candidate) -> None:
        self.all.append(one)
        self._answers.add(one.evaluated)
        self._told.update(one.evaluated.distinguished)

    @property
    def family(self) -> frozenset[Place]:
        """Mistakes that each variant must distinguish."""
        least = max(1.0, FAMILY_FRACTION * len(self.all))
        return frozenset(place for place, count in self._told.items() if count >= least)

    def choose(self, *, strict: bool) -> None:
        """Choose variants, the earliest first: with all mistakes distinguished, or most.

        The chosen ones remain while the family and the compared answers are the same.
        """
        if len(self.all) < TRIED_FIRST and strict:
            return
        family, among = self.family, self._answers.among
        missing = [len(family - one.evaluated.distinguished) for one in self.all]
        same = strict and self._judged[:2] == (family, among)
        judged = self._judged[2] if same else 0
        order = sorted(range(judged, len(self.all)), key=missing.__getitem__)
        if strict:
            order = [number for number in order if not missing[number]]
        if not same:
            self.chosen = []
        self._judged = family, among, len(self.all)
        self._add_distinct(np.array(order, dtype=int))
        self.choice.variants = [
            ChosenVariant(str(number), self.all[k].overrides)
            for number, k in enumerate(self.chosen, 1)
        ]

    def _add_distinct(self, order: Indices) -> None:
        """Choose candidates in this order that are like none of the chosen ones, nor the file."""
        free = self._unlike_chosen(order)
        while free.any() and len(self.chosen) < self.choice.requested:
            first = int(order[np.argmax(free)])
            self.chosen.append(first)
            free &= self._answers.distinct(first, order, MIN_LOST_FRACTION)
            free[order == first] = False

    def _unlike_chosen(self, candidates: Indices) -> npt.NDArray[np.bool_]:
        """Return which candidates are like none of the chosen ones, nor the file; shape (n,)."""
        unlike = self._answers.distinct_from_main(candidates, MIN_LOST_FRACTION)
        for k in self.chosen:
            unlike &= self._answers.distinct(k, candidates, MIN_LOST_FRACTION)
        return unlike

    def record_results(self, scale_keys: frozenset[str]) -> None:
        """Write down scales, and what became of the others."""
        found, family = self.choice, self.family
        made = {place for one in self.all for place in one.evaluated.possible}
        chosen = [self.all[k].evaluated for k in self.chosen]
        told = [one.distinguished for one in chosen]
        found.family = len(frozenset.intersection(*told)) if told else 0
        found.variants = [
            ChosenVariant(
                one.name,
                {
                    **one.overrides,
                    **{f"scales.{k}": v for k, v in own.scales.items() if k in scale_keys},
                },
                tuple(sorted(made - own.distinguished)),
            )
            for one, own in zip(found.variants, chosen, strict=True)
        ]
        found.min_lost_fraction = self._answers.min_lost_fraction(self.chosen)
        others = np.setdiff1d(np.arange(len(self.all)), self.chosen)
        spare = self._unlike_chosen(others).tolist()
        for k, is_spare in zip(others.tolist(), spare, strict=True):
            why = RejectionReason.SPARE if is_spare else RejectionReason.DUPLICATE
            hidden = family - self.all[k].evaluated.distinguished
            if hidden and len(found.variants) == found.requested:
                why = RejectionReason.HIDDEN
            found.rejections[why, ""] += 1


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
