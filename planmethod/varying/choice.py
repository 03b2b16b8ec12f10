"""Variants chosen from candidates: distinct, each distinguishing all mistakes (выбор вариантов)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from random import Random

from msgspec import Struct, field

from planmethod.check.marks import DEFAULT, Settings
from planmethod.errors import PlanMethodError
from planmethod.gears.model import GearProblem
from planmethod.gears.motion import solve_motion
from planmethod.kinds import kind_of
from planmethod.problem.head import KindProblem
from planmethod.varying.candidates import Overrides, VariantCandidates
from planmethod.varying.judged import Judge, JudgedVariant, Place
from planmethod.varying.sieve import Refusal, Refused
from planmethod.varying.teeth import WHEEL, coaxial, coaxial_rows, label_of
from planmethod.varying.varied import Lots, VariedKey, asked, overrides, usual, with_followers

ROUND = 60
"""Number of candidates that are evaluated together."""

PER_VARIANT = 300
"""Default maximum of candidates for each requested variant."""

APART = 0.6
"""Minimum fraction of the points that a copied variant loses."""

FAMILY = 0.5
"""Fraction of good candidates distinguishing a mistake from which every variant must."""

TRIED_FIRST = 8
"""VariantCandidates from which the family is known."""

WORTH = {Refusal.SHORT: 0.01, Refusal.UNSEEN: 0.05, Refusal.HIDDEN: 0.2}
"""Weight of a rejected candidate, relative to an accepted one."""


class ChosenVariant(Struct, frozen=True):
    """A variant of the table: its overrides of the file, and the mistakes it does not distinguish.

    Attributes
    ----------
    name : str
    own : mapping of str to value
        By dotted key.
    untold : tuple of (str, str)
        Possible mistakes that its answers do not distinguish from others: code and place.
    """

    name: str
    own: Overrides
    untold: tuple[Place, ...] = ()


class VariantChoice(Struct):
    """Results of the search (подобранные варианты).

    Attributes
    ----------
    variants : list of ChosenVariant
    wanted, tried : int
        Number of requested variants, number of candidates tried.
    keys : tuple of VariedKey
    refused : Counter
        Number of rejected candidates by reason and item.
    family : int
        Number of mistakes that every variant distinguishes.
    least : float
        Smallest share of the points that a copy of one variant loses in another one.
    excused : tuple of (str, str)
        Conditions of teeth that the file itself does not meet, and the wheel of each.
    drawn : bool
        Whether plans are drawn: the task is a linkage.
    """

    wanted: int
    keys: tuple[VariedKey, ...]
    variants: list[ChosenVariant] = field(default_factory=list)
    tried: int = 0
    refused: Counter[tuple[Refusal, str]] = field(default_factory=Counter)
    family: int = 0
    least: float = 1.0
    excused: tuple[Place, ...] = ()
    drawn: bool = True


class _Judged(Struct, frozen=True, eq=False):
    """A candidate that may be chosen."""

    own: Overrides
    judged: JudgedVariant


def choose(
    path: Path,
    *,
    count: int,
    seed: int,
    vary: str = "",
    spread: float = 0.3,
    tries: int | None = None,
    settings: Settings = DEFAULT,
    done: Callable[[int], object] = lambda found: None,
) -> tuple[VariantCandidates, VariantChoice]:
    """Find variants of a problem file (подобрать варианты); the same seed gives the same.

    Parameters
    ----------
    count : int
    seed : int
    vary : str
        What is varied, ``links.1.OA,driver.phi=0..90``; the usual numbers when empty.
    spread : float
        Range of the numbers around those of the file, a fraction of them.
    tries : int, optional
        Most candidates.
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
    table = source.table
    keys = asked(table, vary, spread) if vary else usual(table, spread)
    chosen = with_followers(table, keys)
    (main,) = source.read({})
    if isinstance(main, PlanMethodError):
        raise main
    judge = Judge(source.kind, main, settings)
    found = VariantChoice(
        count, tuple(chosen), excused=tuple(sorted(judge.excused)), drawn=source.kind is None
    )
    lots, pool = Lots(chosen, Random(seed)), _Pool(found)
    pool.main = judge.main
    draw, before, limit = _drawing(main, lots), set[str](), tries or PER_VARIANT * count
    while found.tried < limit and len(found.variants) < count:
        drawn: list[tuple[dict[VariedKey, float], Overrides]] = []
        for _ in range(min(ROUND, limit - found.tried)):
            found.tried += 1
            values = draw()
            if values is None:
                found.refused[Refusal.COAXIAL, ""] += 1
                continue
            own = overrides(table, values)
            if repr(own) in before:
                found.refused[Refusal.ALIKE, ""] += 1
                continue
            before.add(repr(own))
            drawn.append((values, own))
        for (values, laid), one in zip(drawn, _outcomes(source, judge, drawn), strict=True):
            if isinstance(one, Refused):
                found.refused[one.why, one.what] += 1
                lots.learn(values, WORTH.get(one.why, 0.0))
            else:
                pool.add(_Judged(laid, one))
                lots.learn(values, pool.worth(one))
        already = len(found.variants)
        pool.choose(strict=True)
        done(max(0, len(found.variants) - already))
    if len(found.variants) < count:
        pool.choose(strict=False)
    pool.tell(_given_scales(table))
    return source, found


def _drawing(main: KindProblem, lots: Lots) -> Callable[[], dict[VariedKey, float] | None]:
    """Return what draws the values of a candidate: of a train such that it is coaxial."""
    if not isinstance(main, GearProblem):
        return lambda: lots.with_followers(lots.draw())
    motion = solve_motion(main)
    wheels = [label_of(one) for one in lots.free if one.name.startswith(WHEEL)]
    rows = coaxial_rows(motion, wheels)
    return lambda: coaxial(lots.draw(), rows, motion.axes.sizes)


def _outcomes(
    source: VariantCandidates,
    judge: Judge,
    drawn: Sequence[tuple[dict[VariedKey, float], Overrides]],
) -> list[JudgedVariant | Refused]:
    if not drawn:
        return []
    read = list(source.read({str(k): own for k, (_, own) in enumerate(drawn)}))
    good = judge.judge([one for one in read if not isinstance(one, PlanMethodError)])
    return [
        Refused(Refusal.FAULTY) if isinstance(one, PlanMethodError) else next(good) for one in read
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
    """VariantCandidates that may be variants, and which of them are."""

    def __init__(self, found: VariantChoice) -> None:
        self.found, self.all = found, list[_Judged]()
        self.main: JudgedVariant | None = None
        self.chosen: list[_Judged] = []
        self._off: dict[tuple[int, int], float] = {}

    def worth(self, one: JudgedVariant) -> float:
        """Return the weight of a candidate: less if it does not distinguish the whole family."""
        return WORTH[Refusal.HIDDEN] if self.family - one.told else 1.0

    def add(self, one: _Judged) -> None:
        self.all.append(one)

    @property
    def family(self) -> frozenset[Place]:
        """Mistakes that each variant must distinguish."""
        told = Counter(place for one in self.all for place in one.judged.told)
        least = max(1.0, FAMILY * len(self.all))
        return frozenset(place for place, count in told.items() if count >= least)

    @property
    def among(self) -> list[str]:
        """Answers that are not the same in all candidates."""
        first = self.all[0].judged.exact
        return [
            item
            for item, value in first.items()
            if any(
                abs(one.judged.exact.get(item, 0.0) - value) > 1e-9 * abs(value) for one in self.all
            )
        ]

    def choose(self, *, strict: bool) -> None:
        """Choose variants again, the earliest first: with all mistakes distinguished, or most."""
        if len(self.all) < TRIED_FIRST and strict:
            return
        family, among = self.family, self.among if self.all else []
        order = sorted(self.all, key=lambda one: len(family - one.judged.told))
        self.chosen = []
        for one in order:
            if strict and family - one.judged.told:
                break
            if len(self.chosen) == self.found.wanted:
                break
            if self._is_apart(one.judged, among):
                self.chosen.append(one)
        self.found.variants = [
            ChosenVariant(str(number), one.own) for number, one in enumerate(self.chosen, 1)
        ]

    def _is_apart(self, one: JudgedVariant, among: Sequence[str]) -> bool:
        others = [other.judged for other in self.chosen]
        if self.main is not None:
            others.append(self.main)
        return all(one.off(o, among) >= APART and o.off(one, among) >= APART for o in others)

    def tell(self, given: frozenset[str]) -> None:
        """Write down scales, and what became of the others."""
        found, family = self.found, self.family
        made = {place for one in self.all for place in one.judged.made}
        told = [one.judged.told for one in self.chosen]
        found.family = len(frozenset.intersection(*told)) if told else 0
        found.variants = [
            ChosenVariant(
                one.name,
                {
                    **one.own,
                    **{f"scales.{k}": v for k, v in own.judged.scales.items() if k in given},
                },
                tuple(sorted(made - own.judged.told)),
            )
            for one, own in zip(found.variants, self.chosen, strict=True)
        ]
        among = self.among if self.all else []
        pairs = [
            one.judged.off(other.judged, among)
            for one in self.chosen
            for other in self.chosen
            if one is not other
        ]
        found.least = min(pairs, default=1.0)
        for own in self.all:
            if own not in self.chosen:
                why = Refusal.SPARE if self._is_apart(own.judged, among) else Refusal.ALIKE
                hidden = family - own.judged.told and len(found.variants) == found.wanted
                found.refused[Refusal.HIDDEN if hidden else why, ""] += 1
