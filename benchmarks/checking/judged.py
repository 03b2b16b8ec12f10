"""How the product judges works, and counts of it by kind of mistake (что нашла проверка)."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from benchmarks.checking.habits import codes_of
from benchmarks.checking.works import Group, Work, table

FEW = 3
"""Names offered as "one of" that still help a student."""

RIGHT = ("ok", "unseen")

Result = Mapping[str, Any]


def run_product(group: Group, folder: Path) -> list[Result]:
    """Check works with the command, as an instructor does, and return its records."""
    path = folder / f"{group.problem.name}.csv"
    path.write_text(table(group.works), "utf-8")
    command = [sys.executable, "-m", "planmethod", "check", str(group.problem.path), str(path)]
    done = subprocess.run([*command, "--json"], capture_output=True, check=False, text=True)
    if not done.stdout.strip():
        raise RuntimeError(done.stderr)
    return json.loads(done.stdout)  # type: ignore[no-any-return]


@dataclass(frozen=True, slots=True)
class Judged:
    """A work beside what the product says of it."""

    group: Group
    work: Work
    result: Result

    @property
    def answers(self) -> dict[str, Result]:
        """Records of answers by the names of the form."""
        told = {one["id"]: one for one in self.result["answers"]}
        return {
            key: told[key.replace(" ", "_")]
            for key in self.work.said
            if key.replace(" ", "_") in told
        }

    def lost(self, keys: Iterable[str]) -> int:
        """Return how many of these answers lose points."""
        answers = self.answers
        return sum(answers[k]["points"] < answers[k]["of"] - 1e-9 for k in keys if k in answers)

    def doubted(self, keys: Iterable[str]) -> int:
        """Return how many are called right, but not from the earlier answers."""
        answers = self.answers
        return sum(answers[k]["verdict"] == "inconsistent" for k in keys if k in answers)

    @property
    def seen(self) -> bool:
        """Whether anything is said against the work."""
        return any(one["verdict"] not in RIGHT for one in self.result["answers"])

    @property
    def accepted(self) -> list[frozenset[str]]:
        """Codes that name each of the work's habits rightly."""
        return [codes_of(habit) for habit in self.work.habits]

    @property
    def told(self) -> list[tuple[frozenset[str], bool]]:
        """Names that the product gives: codes, and whether it is sure."""
        return [
            (frozenset(one["codes"]), bool(one["sure"]))
            for one in self.result["diagnosis"]
            if one["codes"]
        ]

    @property
    def named(self) -> bool:
        """Whether a habit is named for sure."""
        return any(sure and codes & right for codes, sure in self.told for right in self.accepted)

    @property
    def among(self) -> bool:
        """Whether a habit is among few names, and not named for sure."""
        offered = [codes for codes, sure in self.told if not sure and len(codes) <= FEW]
        return not self.named and any(codes & right for codes in offered for right in self.accepted)

    @property
    def misnamed(self) -> list[str]:
        """Names given for sure that are none of the work's habits."""
        right = frozenset[str]().union(*self.accepted)
        return sorted(
            "+".join(sorted(codes)) for codes, sure in self.told if sure and not codes & right
        )

    @property
    def share(self) -> float:
        """Share of the points that the work gets."""
        return float(self.result["points"]) / float(self.result["of"])


@dataclass(slots=True)
class Row:
    """Counts of works of one kind.

    Attributes
    ----------
    following, lost : int
        Answers that follow from wrong ones, and those of them that lose points.
    repeated, lost_repeated : int
        Answers in which the same habit is followed again.
    untouched, lost_untouched : int
        Answers that the mistake does not touch.
    consistent, doubted : int
        Answers that agree with the student's earlier ones, and those of them that are called
        inconsistent with them.
    """

    name: str
    works: int = 0
    seen: int = 0
    named: int = 0
    among: int = 0
    misnamed: int = 0
    following: int = 0
    lost: int = 0
    repeated: int = 0
    lost_repeated: int = 0
    untouched: int = 0
    lost_untouched: int = 0
    consistent: int = 0
    doubted: int = 0
    wrong_names: list[str] = field(default_factory=list)

    def count(self, judged: Judged) -> None:
        """Count one work."""
        work = judged.work
        self.works += 1
        self.seen += judged.seen
        self.named += judged.named
        self.among += judged.among
        self.misnamed += bool(judged.misnamed)
        self.wrong_names += judged.misnamed
        self.following += len(work.following)
        self.lost += judged.lost(work.following)
        self.repeated += len(work.repeats)
        self.lost_repeated += judged.lost(work.repeats)
        rest = frozenset(work.said) - work.changed
        self.untouched += len(rest)
        self.lost_untouched += judged.lost(rest)
        consistent = frozenset(work.said) - frozenset(work.roots) - work.repeats
        self.consistent += len(consistent)
        self.doubted += judged.doubted(consistent)


def judge(groups: Iterable[Group], keep: Path | None = None) -> Iterator[Judged]:
    """Run the product on groups, and yield each work with its result."""
    with TemporaryDirectory() as temporary:
        for group in groups:
            results = run_product(group, keep or Path(temporary))
            by_name = {one["student"]: one for one in results}
            for work in group.works:
                yield Judged(group, work, by_name[work.student])


def by_habit(judged: Sequence[Judged]) -> list[Row]:
    """Count works with one mistake by their habit, the least named first."""
    rows: dict[str, Row] = {}
    for one in judged:
        if one.work.kind == "one":
            name = one.work.habits[0]
            rows.setdefault(name, Row(name)).count(one)
    return sorted(rows.values(), key=lambda row: ((row.named + row.among) / row.works, -row.works))


def total(judged: Iterable[Judged], name: str) -> Row:
    """Count works together."""
    row = Row(name)
    for one in judged:
        row.count(one)
    return row


def honest_pairs(judged: Sequence[Judged]) -> tuple[int, int]:
    """Return the pairs of independent works of one drawn variant, and those called alike."""
    pairs = alike = 0
    drawn = [
        one for one in judged
        if one.group.problem.drawn and one.work.kind in ("honest", "one", "two")
    ]  # fmt: skip
    for one, other in combinations(drawn, 2):
        if one.group is other.group and one.work.variant == other.work.variant:
            pairs += 1
            alike += other.work.student in one.result["alike"]
    return pairs, alike


def found_copies(judged: Sequence[Judged], kind: str) -> tuple[int, int]:
    """Return the copies of a kind, and those called alike with their source."""
    copies = [one for one in judged if one.work.kind == kind]
    return len(copies), sum(one.work.source in one.result["alike"] for one in copies)
