"""Tables of the simulator, in Markdown (таблицы)."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from benchmarks.checking.judged import Judged, Row, by_habit, found_copies, honest_pairs, total

Table = list[str]
"""Lines of Markdown."""

HEADS = (
    "mistake", "works", "seen", "named", "named or among three", "wrongly", "as",
    "following answers", "lose points", "repeats lose points", "untouched lose points",
    "falsely inconsistent",
)  # fmt: skip


def table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> Table:
    """Return a table of Markdown, numbers to the right."""
    rule = ["---", *["---:"] * (len(head) - 1)]
    return [f"| {' | '.join(row)} |" for row in (head, rule, *rows)]


def share(part: int, whole: int) -> str:
    """Return a percentage; a dash of nothing."""
    return f"{100 * part / whole:.1f}" if whole else "—"


def _cells(row: Row) -> tuple[str, ...]:
    common = Counter(row.wrong_names).most_common(3)
    return (
        row.name,
        str(row.works),
        share(row.seen, row.works),
        share(row.named, row.works),
        share(row.named + row.among, row.works),
        share(row.misnamed, row.works),
        ", ".join(f"{name} {count}" for name, count in common),
        str(row.following),
        share(row.lost, row.following),
        share(row.lost_repeated, row.repeated),
        share(row.lost_untouched, row.untouched),
        share(row.doubted, row.consistent),
    )


def _honest(judged: Sequence[Judged]) -> Table:
    rows = []
    for name, drawn, digits in (
        ("drawn", True, (3, 4)), ("computed", False, (3, 4)),
        ("computed, 4 digits", False, (4,)), ("computed, 3 digits", False, (3,)),
    ):  # fmt: skip
        some = [
            one for one in judged
            if one.work.kind == "honest" and one.group.problem.drawn is drawn
            and one.work.digits in digits
        ]  # fmt: skip
        answers = sum(len(one.work.said) for one in some)
        lost = sum(one.lost(one.work.said) for one in some)
        doubted = sum(one.doubted(one.work.said) for one in some)
        named = sum(bool(one.told) for one in some)
        rows.append(
            (name, str(len(some)), str(answers), f"{100 * lost / max(1, answers):.2f}",
             f"{100 * doubted / max(1, answers):.2f}", str(named))
        )  # fmt: skip
    return table(
        (
            "honest works",
            "works",
            "answers",
            "faulted, %",
            "called inconsistent, %",
            "works with a name",
        ),
        rows,
    )


def _copies(judged: Sequence[Judged]) -> Table:
    rows = []
    for kind in ("copy", "spoilt"):
        copies, found = found_copies(judged, kind)
        name = {"copy": "identical", "spoilt": "half of the last digits changed"}[kind]
        rows.append((f"pairs, {name}", str(copies), f"called alike {share(found, copies)} %"))
    pairs, alike = honest_pairs(judged)
    rows.append(("pairs of independent works", str(pairs), f"called alike {share(alike, pairs)} %"))
    others = [one for one in judged if one.work.kind == "other variant"]
    above = sum(one.share > 0.5 for one in others)
    rows.append(
        ("copies from another variant", str(len(others)), f"above half of the points {above}")
    )
    found = sum(any("P2" in codes for codes, _ in one.told) for one in others)
    rows.append(("", "", f"named so {share(found, len(others))} %"))
    return table(("copies", "number", "found"), rows)


def students_section(judged: Sequence[Judged], seed: int) -> Table:
    """Return all tables."""
    ones = [one for one in judged if one.work.kind == "one"]
    twos = [one for one in judged if one.work.kind == "two"]
    groups = list({id(one.group): one.group for one in judged}.values())
    hidden = Counter(name for group in groups for name in group.hidden)
    families = {
        "drawn": [one for one in ones if one.group.problem.drawn],
        "computed": [one for one in ones if not one.group.problem.drawn],
    }
    problems = {group.problem.name: [one for one in ones if one.group is group] for group in groups}
    together = [
        total(ones, "**one mistake**"),
        *(total(some, f"one mistake, {name}") for name, some in families.items()),
        total(twos, "**two mistakes**"),
        *(total(some, f"one mistake, `{name}`") for name, some in problems.items()),
    ]
    return [
        "## Students of a simulator of its own",
        "",
        f"Seed {seed}, {len(judged)} works of {len(groups)} problems, on none of which the "
        "checking was developed. The students (`benchmarks/checking`) have their own geometry and "
        "habits, and share nothing with the product. *Named*: by one of the names that a teacher "
        "would use (`habits.py`); of two mistakes, one. *Following*: answers that are wrong "
        "because of an earlier one. *Falsely inconsistent*: answers that agree with the student's "
        "own numbers, but are said not to. Percent, except the numbers of works and answers.",
        "",
        *_honest(judged),
        "",
        *table(HEADS, [_cells(row) for row in together]),
        "",
        "By kind of mistake, the least named first:",
        "",
        *table(HEADS, [_cells(row) for row in by_habit(judged)]),
        "",
        "Not visible, the change being within the spread of honest drawings: "
        + (", ".join(f"{name} {count}" for name, count in hidden.most_common()) or "none")
        + ".",
        "",
        *_copies(judged),
    ]
