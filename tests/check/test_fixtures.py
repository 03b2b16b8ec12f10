"""The table of cases in cases.md, each row put through the reader and the checking."""

from __future__ import annotations

import json
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from doors import (
    DEFAULT,
    GradedSubmission,
    NoValueError,
    Settings,
    Sign,
    Solution,
    Task,
    TaskItem,
    Variants,
    Verdict,
    WrittenAnswer,
    check,
    problem_load as load,
    read_json,
)
from msgspec.structs import replace
from worked import path_of

HEAD = "| case | problem | written | settings | verdicts | named | why |"


@dataclass(frozen=True)
class Case:
    name: str
    problem: str
    written: str
    settings: str
    verdicts: str
    named: str
    why: str


def cases() -> list[Case]:
    text = Path(__file__).with_name("cases.md").read_text("utf-8")
    _, _, below = text.partition(HEAD)
    rows = re.match(r"\n\|[-|: ]+\|\n((?:\|.*\|\n)+)", below)
    assert rows, "cases.md has no table of cases"
    return [Case(*(c.strip() for c in row.split("|")[1:-1])) for row in rows[1].splitlines()]


CASES = cases()
_VARIANTS: dict[tuple[str, Settings], Variants] = {}


def asked(case: Case) -> tuple[Task, dict[str, str]]:
    """Return the task of a case, and its options that are not settings of a department."""
    told: dict[str, Any] = {}
    beside: dict[str, str] = {}
    known = set(Settings.__struct_fields__)
    for part in filter(None, case.settings.split(", ")):
        key, value = part.split(" ")
        if key in known:
            told[key] = value if key in ("policy", "profile") else float(value)
        else:
            beside[key] = value
    settings, path = replace(DEFAULT, **told), path_of(case.problem)
    if "phi" in beside:
        positions = [float(phi) for phi in beside["phi"].split("+")]
        return Task(Solution(load(path), positions=positions), settings), beside
    variants = _VARIANTS.setdefault((case.problem, settings), Variants(path, settings))
    return variants.task(beside.get("variant")), beside


def named(task: Task, text: str) -> str:
    """Return the name in checking of an answer of the table, ``balance @1`` in position 1."""
    what, _, position = text.partition(" @")
    try:
        return task.find(WrittenAnswer(what, position=int(position) if position else None)).id
    except NoValueError:
        return what


def right(item: TaskItem, task: Task) -> dict[str, str]:
    """Return the right answer as somebody would write it."""
    exact = task.sheet(item.position).exact_answers[item.question.id]
    size = abs(exact) if item.question.sign in (Sign.SIZE, Sign.TURN) else exact
    sense = "" if item.question.sign is not Sign.TURN else "ccw" if exact > 0 else "cw"
    return {"id": item.id, "value": f"{size:.4g}", "sense": sense}


def answers(case: Case, task: Task) -> list[dict[str, str]]:
    told: list[dict[str, str]] = []
    parts = case.written.split("; ")
    for part in parts:
        if part == "all":
            continue
        match = re.fullmatch(r"([^=@]+)(?: @(\d))? = ?([^()]*?) ?(?:\(([\d.,]+)\))?", part)
        assert match, part
        what, position, value, mm = match.groups()
        told.append({"what": what, "value": value, "mm": mm or "", "position": position or ""})
    if parts[0] == "all":
        own = {named(task, one["what"]) for one in told}
        told += [right(item, task) for item in task.usual() if item.id not in own]
    return told


def judged(case: Case) -> tuple[Task, GradedSubmission]:
    task, beside = asked(case)
    scales = {key: value for key, value in beside.items() if key.startswith("mu_")}
    work: dict[str, Any] = {"student": "s", "scales": scales, "answers": answers(case, task)}
    if "ruler" in beside:
        work["ruler_mm"] = beside["ruler"]
    (read,) = read_json(json.dumps(work).encode(), Path("s.json"))
    assert not read.remarks
    return task, check(task, replace(read, variant=task.variant))


def outcome(case: Case) -> tuple[str, str]:
    """Return the verdicts of the answers named in a row, in the words of the table."""
    task, checked = judged(case)
    texts = [part.split(":")[0] for part in case.verdicts.split("; ")]
    texts += [part.split(" =")[0] for part in case.written.split("; ") if part != "all"]
    called = {named(task, text): text for text in reversed(texts)}
    verdicts = []
    for text in texts[: len(case.verdicts.split("; "))]:
        _, _, position = text.partition(" @")
        one = next(
            a
            for a in checked.answers
            if a.id == named(task, text)
            and (not position or (a.key and a.key.position == int(position)))
        )
        follows = f" from {called.get(one.follows, one.follows)}" if one.follows else ""
        points = f" {one.points:g}" if one.points not in (one.of, 0.0) else ""
        verdicts.append(f"{text}: {one.verdict.value}{follows}{points}")
    diagnosis = [
        (" or ".join(sorted(d.codes)) or "nothing")
        + ("?" if len(d.codes) == 1 and not d.sure else "")
        for d in checked.diagnosis
    ]
    if checked.suspicious:
        diagnosis.append("too exact")
    return "; ".join(verdicts), "; ".join(diagnosis)


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_a_case_is_judged_as_in_the_document(case: Case) -> None:
    verdicts, named = outcome(case)
    assert verdicts == case.verdicts
    assert case.named in (named, "·")


def test_every_verdict_has_its_case() -> None:
    said = " ".join(case.verdicts for case in CASES)
    assert {verdict for verdict in Verdict if verdict.value in said} == set(Verdict)
