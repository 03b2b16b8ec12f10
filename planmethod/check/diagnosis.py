"""Causes of wrong answers: the clearly best explanation, or none (диагностика)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations

from msgspec.structs import replace

from planmethod.check.explain import (
    OFF,
    ONE_MISTAKE,
    WIDE,
    Explanation,
    ExplanationFit,
    Explanations,
    Fact,
    StudentNumbers,
)
from planmethod.check.following import (
    Slip,
    diagnose_copied,
    explain_by_value,
    find_slips,
    follows,
    idle,
    propagate_mistake,
    rank,
    repoint,
    values_of,
)
from planmethod.check.grading import (
    ExaminedAnswer,
    collect_student_values,
    facts_of,
)
from planmethod.check.key import SEGMENT_CODES
from planmethod.check.mistakes.plans import MistakeContext
from planmethod.check.mistakes.scales import both_levers, scale_by
from planmethod.check.model import Diagnosis, Verdict
from planmethod.check.routes import LENGTHS
from planmethod.check.sheet import Sheet
from planmethod.check.task import Task
from planmethod.plans.model import FACTS
from planmethod.problem.quantities import TURNINGS, Sign

FEW = 1.0
"""Prior number of answers of usual accuracy, before a student counts as accurate."""

EXACT = 0.15
"""Minimum drafting error of a student, as a fraction of the errors of a careful drawing."""

CLEARLY = 6.0
"""Score by which the best explanation must beat the next one to be named."""

TRIED = 6
"""Named explanations that are compared."""

PAIRED = 20
"""Mistakes of which any two are tried together."""

FEW_CODES = 3
"""Maximum number of mistakes reported as "one of": more would not help the student."""

CLOSE = 15.0
"""Maximum score gap to the best explanation for a comparison with the errors of its own plans."""

MAX_LOCAL_MISTAKES = 3
"""Maximum number of mistakes that are named each by its own answers."""

MANY = 2
"""Number of wrong answers from which some resemble a known mistake by chance."""

COPIED = 25.0
"""Prior of another variant's numbers where they fit: few mistakes give just these."""

MAX_LONE_SLIP = 0.05
"""Maximum relative error of a slip that is not confirmed by anything else on the sheet."""

FORGOTTEN = 0.05
"""Maximum relative error of a scale that is taken for none at all."""

HABITS, SCALES = {"S1", "S2", "S3", "scale"}, {facts.scale for facts in FACTS.values()}
"""Mistakes that are made in every number alike, in the unit of lengths or a scale of a plan."""

PLACED = {"slip", "scale", "S1", "S2", "S3"}
"""Slips in one number whose place, a scale or an operation, says more than the number."""

UNNAMED = 15.0
"""Prior of a wrong number of unknown cause, relative to one mistake at one place.

Some seventy mistakes can be made on a sheet: one of them comes near almost any single number.
"""


def diagnose(task: Task, sheet: Sheet, examined: list[ExaminedAnswer]) -> list[Diagnosis]:
    """Name the mistakes of a sheet, and propagate their consequences.

    The verdicts of the answers that follow from a recognised mistake become `Verdict.INHERITED`.
    """
    copied = diagnose_copied(task, sheet, examined)
    wrong = [one for one in examined if one.verdict is Verdict.WRONG]
    if copied or not wrong:
        return copied
    alone = wrong[0] if len(wrong) == 1 and wrong[0].item.question.unit != "N·m" else None
    facts = facts_of(sheet, examined, task.settings.k)
    own = _student_numbers(sheet, examined, facts)
    whole = _explain_all(task, sheet, examined, wrong, facts, own)
    if alone is not None and _is_only_sense_wrong(alone):
        codes = {fit.explanation.code for fit in whole or ()}
        if "sign" not in codes or codes <= {"sign", ""}:  # else it may be more than the sense
            told = _diagnose_single(sheet, alone, examined, many=False, lone=True)
            return [_or_driver(told, task.named(sheet), facts)]
    if whole is not None:
        return [propagate_mistake(task, sheet, examined, whole)]
    two = _diagnose_pair(task.explanations(sheet), sheet, examined, facts, own)
    if two:
        return two
    return _diagnose_singly(task, sheet, examined, wrong, facts, own)


def _or_driver(diagnosis: Diagnosis, named: Sequence[Explanation], facts: list[Fact]) -> Diagnosis:
    """Return that a sense is wrong, or the driver turns the other way: V2 where it gives all."""
    for made in (e for e in named if e.code == "V2"):
        if all(fact.sense is None or fact.sense(made.trace) is not False for fact in facts):
            return replace(diagnosis, codes=("sign", "V2"), sure=False)
    return diagnosis


def _explains(sheet: Sheet, wrong: list[ExaminedAnswer], explanation: Explanation) -> bool:
    """Return whether a mistake changes a wrong answer at all, its number or its sense."""
    for one in wrong:
        given, right = (e[one.item.question.id] for e in (explanation.values, sheet.exact_answers))
        turned = one.sense_right is False and given * right <= 0
        vector = one.sense_right is False and one.item.question.sign is not Sign.TURN
        if turned or vector or abs(abs(given) - abs(right)) > one.limit.tolerance() / 2:
            return True
    return False


def _student_numbers(
    sheet: Sheet, examined: list[ExaminedAnswer], facts: list[Fact]
) -> StudentNumbers:
    own = collect_student_values(sheet, examined)
    right = {one.item.question.id for one in examined if one.right and one.sense_right is not False}
    came, left = sheet.replayed(own)[0], sheet.local(own)
    squares, count = FEW, FEW
    for fact in facts:
        if fact.id in right and fact.slot in came and fact.slot is not None:
            sigma = left.sigma[fact.slot] * fact.per_slot
            if sigma > fact.min_sigma:
                off = fact.value - fact.of(came[fact.slot] * fact.per_slot)
                squares, count = squares + (off / sigma) ** 2, count + 1
    share = min(1.0, max(EXACT, math.sqrt(squares / count)))
    return StudentNumbers(own, collect_student_values(sheet, examined, values=True), share)


def _explain_all(
    task: Task,
    sheet: Sheet,
    examined: list[ExaminedAnswer],
    wrong: list[ExaminedAnswer],
    facts: list[Fact],
    numbers: StudentNumbers,
) -> list[ExplanationFit] | None:
    """Return the explanations of all that is answered, the best first; None where none is."""
    fits = _rank_explanations(task, sheet, examined, wrong, facts, numbers)
    best = fits[0] if fits else None
    if best is None or not best.likely or best.explanation.code == "P1":
        others = _fits_of_variants(task, sheet, examined, numbers.error_fraction)
        fits = sorted([*fits, *others], key=lambda fit: fit.score)
        best = fits[0] if fits else None
    if best is not None and not best.likely:  # an unexplained number is still propagated
        likely = (fit for fit in fits if fit.likely and fit.score < fits[0].score + CLEARLY)
        best = next((fit for fit in likely if not fit.explanation.code), None)
        return None if best is None else [best]
    if best is None:
        return None
    return [fit for fit in fits if fit.likely and fit.score < best.score + CLEARLY]


def _rank_explanations(
    task: Task,
    sheet: Sheet,
    examined: list[ExaminedAnswer],
    wrong: list[ExaminedAnswer],
    facts: list[Fact],
    numbers: StudentNumbers,
) -> list[ExplanationFit]:
    """Return how explanations fit, the best first."""
    explained = task.explanations(sheet)
    near = [e for e in explained.nearest(facts, TRIED) if _explains(sheet, wrong, e)]
    told = {fact.id for fact in facts}
    judged = [one for one in wrong if one.item.question.id in told]
    put = [
        _of_slip(explained, sheet, one, slip)
        for one in judged
        for slip in find_slips(sheet, one, examined)
    ]
    fits: list[ExplanationFit] = []
    for tried in ([*near, *_scaled(task, sheet, examined)], put):
        rough = [explained.evaluate(e, facts, numbers) for e in tried]
        most = min((fit.score for fit in rough), default=0.0) + CLOSE
        close = [fit.explanation for fit in rough if fit.score <= most]
        fits += [explained.evaluate(e, facts, numbers, closely=True) for e in close]
    for one in judged:
        code = "slip" if one.slip else ""  # shown by their millimetres; else unknown
        made = explain_by_value(sheet, one, Slip(code, "", one.value, UNNAMED), free=True)
        fits.append(explained.evaluate(made, facts, numbers))
    return _different(sorted(fits, key=lambda fit: fit.score), facts)


def _of_slip(explained: Explanations, sheet: Sheet, one: ExaminedAnswer, slip: Slip) -> Explanation:
    """Return what a slip gives: by the program where it can be made there."""
    change = slip.change(sheet, one)
    item, question = one.item.id, one.item.question.id
    made = None if change is None else explained.of_slip(change, question, item)
    return made or explain_by_value(sheet, one, slip, free=False)


def _different(ranked: list[ExplanationFit], facts: list[Fact]) -> list[ExplanationFit]:
    """Return fits without those that give the same numbers as a more common explanation."""
    kept: list[ExplanationFit] = []
    for fit in sorted(ranked, key=lambda fit: -fit.explanation.prior):
        given = fit.explanation.values
        if fit.explanation.free or not any(
            _same(given, other.explanation.values, facts)
            for other in kept
            if other.explanation.prior > fit.explanation.prior
            and not (other.explanation.free or other.explanation.slip)
        ):
            kept.append(fit)
    return sorted(kept, key=lambda fit: fit.score)


def _same(one: Mapping[str, float], two: Mapping[str, float], facts: list[Fact]) -> bool:
    """Return whether two explanations give the same answers."""
    return all(
        abs(fact.of(one[fact.id]) - fact.of(two[fact.id])) <= fact.min_sigma * 0.5
        and (not fact.rotation_sign or one[fact.id] * two[fact.id] >= 0)
        for fact in facts
    )


def _scaled(task: Task, sheet: Sheet, examined: list[ExaminedAnswer]) -> Iterator[Explanation]:
    """Yield a plan that was drawn to another scale than it is read by."""
    scene = MistakeContext(sheet)
    for plan in scene.read_plans:
        ratios = [
            (abs(one.value / one.limit.exact), _relative_tolerance(one))
            for one in examined
            if one.verdict in (Verdict.WRONG, Verdict.INHERITED, Verdict.NEAR)
            and one.item.question.plan is plan
            and one.item.question.key.kind not in TURNINGS
            and one.limit.exact
            and one.value
        ]
        if len(ratios) < 2:
            continue
        scale = sheet.scales[FACTS[plan].scale]
        weights = math.fsum(share**-2 for _, share in ratios)
        factor = math.fsum(ratio / share**2 for ratio, share in ratios) / weights
        if abs(factor * scale - 1) < FORGOTTEN:
            factor = 1 / scale
        slack = task.settings.near
        if all(abs(ratio / factor - 1) < max(0.05, slack * share) for ratio, share in ratios):
            for change in both_levers(scene, scale_by(scene, plan, factor)):
                made = task.explanations(sheet).of_change(change)
                if made is not None:
                    yield made


def _relative_tolerance(one: ExaminedAnswer) -> float:
    """Return the relative tolerance of an answer."""
    return max(one.limit.tolerance(one.step), one.limit.spread) / abs(one.limit.exact)


def _fits_of_variants(
    task: Task, sheet: Sheet, examined: list[ExaminedAnswer], tolerance_share: float
) -> Iterator[ExplanationFit]:
    """Yield how the numbers of the other variants fit, read as the program of each calls them."""
    explained = task.explanations(sheet)
    for variant, theirs in task.theirs(sheet):
        asked = {question.id: question for question in theirs.requested}
        there = [
            replace(one, item=replace(one.item, question=asked[one.item.question.id]))
            for one in examined
        ]
        own = StudentNumbers(
            collect_student_values(theirs, there),
            collect_student_values(theirs, there, values=True),
            tolerance_share,
        )
        made = Explanation(
            "P2", variant, theirs.exact_answers, theirs.exact_trace, theirs, prior=COPIED
        )
        yield explained.evaluate(made, facts_of(theirs, there, task.settings.k), own)


# Two at once ---------------------------------------------------------------------------------


def _diagnose_pair(
    explained: Explanations,
    sheet: Sheet,
    examined: list[ExaminedAnswer],
    facts: list[Fact],
    numbers: StudentNumbers,
) -> list[Diagnosis]:
    """Name two mistakes that together explain a sheet, each a part of it; none where it is open.

    What one leaves unexplained is compared, too, with numbers that are wrong for no known reason.
    """
    singles = [e for e in explained.named if e.change is not None and not e.change.of_scale]
    rough = sorted(
        (explained.evaluate(e, facts, numbers) for e in singles), key=lambda fit: fit.score
    )
    best = [fit.explanation for fit in rough[:PAIRED]]
    left = {id(e): _unexplained(explained, e, facts, numbers) for e in best}
    pairs: list[tuple[float, Explanation, Explanation, Explanation]] = []
    for one, two in combinations(best, 2):
        mine, theirs = left[id(one)], left[id(two)]
        if one.code == two.code or mine <= theirs or theirs <= mine:
            continue
        made = explained.of_both(one, two)
        if made is None or not (fit := explained.evaluate(made, facts, numbers)).likely:
            continue
        fit = explained.evaluate(made, facts, numbers, closely=True)
        alone = min(
            (
                explained.evaluate(
                    e, [f for f in facts if f.id not in rest], numbers, closely=True
                ).score
                + sum(_unnamed(sheet, f) for f in facts if f.id in rest)
                for e, rest in ((one, mine), (two, theirs))
            )
        )
        if fit.likely and fit.score + CLEARLY < alone:
            pairs.append((fit.score, one, two, made))
    pairs.sort(key=lambda pair: pair[0])
    if not pairs:
        return []
    score, one, two, made = pairs[0]
    rivals = [(s, {a.code, b.code}) for s, a, b, _ in pairs if s < score + 2 * CLEARLY]
    if any(s < score + CLEARLY and not codes & {one.code, two.code} for s, codes in rivals):
        return []
    wrong = [o for o in examined if o.verdict is Verdict.WRONG]
    told = []
    for mistake, other in ((one, two), (two, one)):
        begins = [
            o
            for o in wrong
            if o.item.question.id in left[id(other)] and not idle(sheet, o, mistake)
        ]
        if not begins:
            return []
        # What does as well beside the other one: then it is "one of".
        instead = (codes - {other.code} for _, codes in rivals if other.code in codes)
        codes = tuple(
            dict.fromkeys((mistake.code, *(code for pair in instead for code in sorted(pair))))
        )
        if len(codes) > FEW_CODES:
            return []
        told.append((codes, mistake, min(begins, key=lambda o: rank(sheet, o))))
    told.sort(key=lambda one: rank(sheet, one[2]))
    roots = [root for _, _, root in told]
    if roots[0] is roots[1]:
        return []
    for answer in wrong:
        if answer not in roots and follows(answer, made, 1.0) and not idle(sheet, answer, made):
            causes = (root for _, mistake, root in told if not idle(sheet, answer, mistake))
            answer.verdict, answer.source = Verdict.INHERITED, next(causes, roots[0]).item.id
    repoint(examined)
    values = values_of(examined, made)
    return [
        Diagnosis(codes, len(codes) == 1, (root.item.id,), mistake.mistake_at, values)
        for codes, mistake, root in told
    ]


def _unexplained(
    explained: Explanations, explanation: Explanation, facts: list[Fact], numbers: StudentNumbers
) -> set[str]:
    """Return the ids of answers that are surely off, or reversed, with a mistake."""
    return {
        fact.id
        for fact in facts
        if explained.evaluate(explanation, [fact], numbers).chi2 > OFF
        or (fact.sense is not None and fact.sense(explanation.trace) is False)
    }


def _unnamed(sheet: Sheet, fact: Fact) -> float:
    """Return the cost of a wrong number of unknown cause."""
    size = max(abs(fact.value), abs(sheet.exact_answers[fact.id]), fact.min_sigma)
    return 2 * math.log(size * WIDE) + ONE_MISTAKE - 2 * math.log(UNNAMED)


# One by one ----------------------------------------------------------------------------------


def _diagnose_singly(
    task: Task,
    sheet: Sheet,
    examined: list[ExaminedAnswer],
    wrong: list[ExaminedAnswer],
    facts: list[Fact],
    numbers: StudentNumbers,
) -> list[Diagnosis]:
    """Name what can be named where no one mistake explains the whole sheet."""
    explained = task.explanations(sheet)
    diagnoses: list[Diagnosis] = []
    left = list(wrong)
    while left and len(diagnoses) < MAX_LOCAL_MISTAKES:
        ids, fits = _local_causes(explained, sheet, left, facts, numbers)
        gained = [one for one in left if one.item.question.id in ids]
        if not gained:
            break
        left = [one for one in left if one not in gained]
        diagnosis = propagate_mistake(task, sheet, gained, fits)
        # Beside two more wrong numbers it may be what something else gives here.
        diagnoses.append(replace(diagnosis, sure=diagnosis.sure and len(left) < MANY))
    left = [one for one in left if one.verdict is Verdict.WRONG]
    while habits := _habits(sheet, left, examined):
        diagnoses += habits
        known = {root for habit in habits for root in habit.roots}
        left = [one for one in left if one.item.id not in known]
    for one in left:
        lone = not diagnoses and len(left) == 1
        many = len(left) > MANY
        diagnoses.append(_diagnose_single(sheet, one, examined, many=many, lone=lone))
    repoint(examined)
    order = [one.item.id for one in examined]
    diagnoses.sort(key=lambda told: order.index(told.roots[0]))
    return [*_each_habit_once(diagnoses, examined)]


def _local_causes(
    explained: Explanations,
    sheet: Sheet,
    left: Sequence[ExaminedAnswer],
    facts: list[Fact],
    numbers: StudentNumbers,
) -> tuple[frozenset[str], list[ExplanationFit]]:
    """Return the mistakes that explain most of the wrong answers, and which, given all others.

    They must make no other answer wrong, and be clearly likelier than unknown causes.
    """
    wanted = {one.item.question.id for one in left}
    right = Explanation("", "", sheet.exact_answers, sheet.exact_trace, sheet)
    before = _unexplained(explained, right, facts, numbers)
    found: dict[frozenset[str], list[ExplanationFit]] = {}
    for explanation in explained.named:
        rest = _unexplained(explained, explanation, facts, numbers)
        gained = frozenset((before - rest) & wanted)
        if not gained or rest - before:
            continue
        kept = [fact for fact in facts if fact.id in gained]
        fit = explained.evaluate(explanation, kept, numbers, closely=True)
        if fit.likely and fit.score + CLEARLY < math.fsum(_unnamed(sheet, f) for f in kept):
            found.setdefault(gained, []).append(fit)
    if not found:
        return frozenset(), []
    most = max(found, key=lambda gained: (len(gained), -min(f.score for f in found[gained])))
    fits = sorted(found[most], key=lambda fit: fit.score)
    fits = [fit for fit in fits if fit.score < fits[0].score + CLEARLY]
    few = len({fit.explanation.code for fit in fits}) <= FEW_CODES
    return (most, fits) if few else (frozenset(), [])


def _habits(
    sheet: Sheet, left: Sequence[ExaminedAnswer], examined: Sequence[ExaminedAnswer]
) -> list[Diagnosis]:
    """Return the numbers that one scale, or one unit of lengths, makes of several answers."""
    found: dict[tuple[str, str], list[ExaminedAnswer]] = {}
    for one in left if len(left) > 1 else ():
        made = {
            (slip.code, slip.mistake_at)
            for slip in find_slips(sheet, one, examined)
            if slip.code in HABITS and slip.mistake_at in (LENGTHS, *SCALES)
            if abs(abs(one.value) / abs(slip.value) - 1.0) <= MAX_LONE_SLIP
        }
        for habit in made:
            found.setdefault(habit, []).append(one)
    most = max(map(len, found.values()), default=0)
    if most < MANY:
        return []
    alike = [(habit, made) for habit, made in found.items() if len(made) == most]
    codes = tuple(sorted({code for (code, _), made in alike if made == alike[0][1]}))
    where = alike[0][0][1]
    return [Diagnosis(codes, len(codes) == 1, (one.item.id,), where) for one in alike[0][1]]


def _each_habit_once(
    diagnoses: Sequence[Diagnosis], examined: Sequence[ExaminedAnswer]
) -> Iterator[Diagnosis]:
    """Yield the diagnoses; a unit or a scale that is wrong everywhere, at the first answer."""
    by_id, first = {one.item.id: one for one in examined}, dict[tuple[str, ...], str]()
    for one in diagnoses:
        habit = (*one.codes, one.mistake_at)
        if one.codes and {*one.codes} <= HABITS and one.mistake_at in (LENGTHS, *SCALES):
            if habit in first:
                for root in one.roots:
                    by_id[root].verdict, by_id[root].source = Verdict.INHERITED, first[habit]
                continue
            first[habit] = one.roots[0]
        yield one


def _is_only_sense_wrong(one: ExaminedAnswer) -> bool:
    """Return whether only the sense of an answer is wrong."""
    size = one.right or one.near
    if one.item.question.sign is not Sign.TURN:  # else their own numbers give that sense too
        size = size or bool(one.follows)
    return one.sense_right is False and size


def _diagnose_single(
    sheet: Sheet,
    one: ExaminedAnswer,
    examined: Sequence[ExaminedAnswer],
    *,
    many: bool,
    lone: bool,
) -> Diagnosis:
    """Return the diagnosis of a single number; of one among many only if it is certain.

    Some segment of a plan is about as long as almost any number, and some factor relates it to the
    right one: among other wrong numbers only the student's own values, or millimetres, are proof.
    """
    roots = (one.item.id,)
    if _is_only_sense_wrong(one):
        return Diagnosis(("sign",), not many, roots)
    made = find_slips(sheet, one, examined)
    near = [s for s in made if abs(abs(one.value / s.value) - 1.0) <= MAX_LONE_SLIP]
    exact = [s for s in near if s.exact]
    near = exact or near
    codes = dict.fromkeys(slip.code for slip in near)
    if not codes and one.slip:
        codes = {"slip": None}
    elif many and not one.slip and not exact:
        codes = {}
    named = tuple(codes)
    placed = bool(exact) or (len(named) == 1 and named[0] in PLACED)
    where = near[0].mistake_at if placed and near else ""
    read = bool(named) and named[0] in SEGMENT_CODES.values()
    own = one.value_from_mm is not None or (one.local is not None and not read)
    sure = len(named) == 1 and (lone or own or bool(exact))
    return Diagnosis(named, sure, roots, where)
