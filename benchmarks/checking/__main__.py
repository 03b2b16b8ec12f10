"""Command ``python -m benchmarks.checking``: students of a simulator, judged by the product."""

from __future__ import annotations

import argparse
import json
from pathlib import Path

from benchmarks.checking import DEVELOPMENT, students
from benchmarks.checking.judged import Judged
from benchmarks.checking.report import students_section


def told(one: Judged) -> dict[str, object]:
    """Return a work with its result, to read."""
    work, answers = one.work, one.answers
    return {
        "problem": one.group.problem.name,
        "student": work.student,
        "variant": work.variant,
        "kind": work.kind,
        "habits": work.habits,
        "roots": work.roots,
        "named": one.named,
        "among": one.among,
        "misnamed": one.misnamed,
        "diagnosis": one.result["diagnosis"],
        "points": f"{one.result['points']}/{one.result['of']}",
        "answers": [
            f"{key} = {answer.value:.6g}"
            + (f" [{answer.mm:g} mm]" if answer.mm is not None else "")
            + (
                f": {answers[key]['verdict']}, exact {answers[key]['exact']:.4g} ± "
                f"{answers[key]['tolerance']:.2g}, points {answers[key]['points']:g}"
                if key in answers
                else ""
            )
            + (" STRUCK" if key in work.struck else " changed" if key in work.changed else "")
            for key, answer in work.said.items()
        ],
    }


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--seed", type=int, default=DEVELOPMENT, help="Seeds from 100 are for reports."
    )
    parser.add_argument("--works", type=int, default=24, help="Honest works of each problem.")
    parser.add_argument("--problem", action="append", help="Only these problems.")
    parser.add_argument("--keep", type=Path, help="Folder for the tables and works.json.")
    given = parser.parse_args()
    if given.keep:
        given.keep.mkdir(parents=True, exist_ok=True)
    judged = students(given.seed, given.works, given.problem, given.keep)
    if given.keep:
        text = json.dumps([told(one) for one in judged], ensure_ascii=False, indent=1)
        (given.keep / "works.json").write_text(text, "utf-8")
    print("\n".join(students_section(judged, given.seed)))


if __name__ == "__main__":
    main()
