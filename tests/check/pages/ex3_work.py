"""A work of ex3 without the Coriolis acceleration, judged by hand, and its key."""

from __future__ import annotations

from functools import cache

from doors import (
    FACTS,
    Diagnosis,
    Float64,
    GradedAnswer,
    GradedSubmission,
    KeyEntry,
    NumberName,
    PlanKind,
    Reading,
    Sense,
    Solution,
    Submission,
    Verdict,
    WrittenAnswer,
    evaluate_evaluate as evaluate,
    substituted,
)
from msgspec.structs import replace
from worked import problem_of

SCALES = {"mu_l": 0.002, "mu_v": 0.05, "mu_a": 1.0}
WITHOUT_CORIOLIS = NumberName("ak_B3/2")
ASKED = (
    ("v_B3", "p-b3", "mu_v", Sense.LEFT),
    ("omega_3", "", "", Sense.CCW),
    ("v_D", "p-d", "mu_v", None),
    ("v_E", "p-e", "mu_v", Sense.LEFT),
    ("a_B3", "π-b3", "mu_a", None),
    ("epsilon_3", "", "", Sense.CW),
    ("a_D", "π-d", "mu_a", None),
    ("a_E", "π-e", "mu_a", Sense.LEFT),
    ("epsilon_4", "", "", Sense.CCW),
)


@cache
def solution() -> Solution:
    return Solution(problem_of("linkages/ex3"))


@cache
def entries() -> tuple[KeyEntry, ...]:
    made = []
    for label, segment, scale, sense in ASKED:
        quantity = solution().legend[label]
        exact = float(solution().exact(quantity)[0])
        made.append(
            KeyEntry(
                id=label,
                label=label,
                symbol=quantity.symbol,
                unit=quantity.kind.unit,
                exact=exact,
                sigma=0.012 * abs(exact),
                tolerance=0.03 * abs(exact),
                is_visible=label != "epsilon_4",
                mm=abs(exact) / SCALES[scale] if scale else None,
                scale=scale,
                segment=segment,
                sense=sense,
                asks_sense=sense is not None,
                hidden=("N1",) if label == "a_B3" else (),
            )
        )
    return tuple(made)


@cache
def mistaken() -> tuple[dict[str, float], dict[str, complex]]:
    """Return the answers without the Coriolis acceleration, and the places of its points."""
    construction = solution().construction
    data = {**solution().data(SCALES), WITHOUT_CORIOLIS: 0.0}
    program = substituted(construction.program, [WITHOUT_CORIOLIS])
    reading = Reading(evaluate(program, data, Float64()), 1)
    values = {}
    for key in entries():
        quantity = solution().legend[key.id]
        if key.unit in ("1/s", "1/s²"):
            values[key.id] = float(reading.number(NumberName(quantity.name))[0])
        else:
            values[key.id] = abs(complex(reading.point(quantity.name)[0])) * SCALES[key.scale]
    places = {
        str(name): complex(reading.point(name)[0]) * SCALES[FACTS[plan.kind].scale]
        for plan in construction.plans
        if plan.kind is not PlanKind.POSITION
        for name in plan.letters
    }
    return values, places


def work(student: str = "s02") -> GradedSubmission:
    """Return the judged work."""
    values, places = mistaken()
    judged = []
    for key in entries():
        value = values[key.id] * 1.003
        mm = None if key.mm is None else round(value / SCALES[key.scale], 1)
        written = WrittenAnswer(
            id=key.id,
            value=value,
            mm=mm,
            sense=key.sense,
            location=f"{student}.json",
            raw=f"{value}",
        )
        is_off = abs(value - key.exact) > key.tolerance
        verdict = Verdict.OK if not is_off else Verdict.INHERITED
        follows = "a_B3" if is_off else ""
        if key.id == "a_B3":
            verdict, follows = Verdict.WRONG, ""
        if key.id == "epsilon_4":
            verdict, follows = Verdict.UNSEEN, ""
        points = 0.0 if verdict is Verdict.WRONG else 1.0
        judged.append(
            GradedAnswer(
                key.id,
                verdict,
                key,
                written,
                value=value,
                tolerance=key.tolerance,
                follows=follows,
                local=value if follows else None,
                points=points,
                of=1.0,
            )
        )
    found = Diagnosis(("A1",), True, ("a_B3",), "B3/2", values, places)
    return GradedSubmission(
        Submission(student, tuple(j.written for j in judged if j.written), scales=SCALES),
        None,
        tuple(judged),
        (found,),
        points=sum(j.points for j in judged),
        of=len(judged),
    )


def changed(judged: GradedAnswer, verdict: Verdict, **fields: object) -> GradedAnswer:
    """Return a verdict of another kind."""
    return replace(judged, verdict=verdict, **fields)
