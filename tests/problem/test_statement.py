"""Statements as textbooks print them, each beside a file of its faults."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from doors import (
    PlanMethodError,
    ProblemError,
    Solution,
    get_language,
    kinds_load as load,
    plain_text,
    statement_given_facts as given_facts,
)

FILES = sorted((Path(__file__).parent / "statement").glob("*.toml"))
FAULTY = [path for path in FILES if path.stem.endswith("-fault")]


def told(path: Path, mark: str) -> list[str]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line.removeprefix(f"# {mark}: ") for line in lines if line.startswith(f"# {mark}: ")]


@pytest.mark.parametrize("path", [p for p in FILES if p not in FAULTY], ids=lambda p: p.stem)
def test_stated_data_are_printed_as_given_and_read_back(path: Path) -> None:
    problem = load(path, variant=next(iter(told(path, "variant")), None))
    solution = Solution(problem)
    said = [
        plain_text(fact.text)
        for fact in given_facts(problem, get_language("ru"), solution.positions.tolist())
    ]
    assert ["; ".join(said)] == told(path, "given")
    for place in told(path, "place"):
        name, x, y = place.split()
        assert solution.points[name].place[0] == pytest.approx(complex(float(x), float(y)))
    for phi in told(path, "phi"):
        assert solution.positions[0] == pytest.approx(float(phi), abs=0.01)
    for speed in told(path, "sliding"):
        assert np.abs(solution.relatives[0].velocity) == pytest.approx(float(speed), rel=1e-9)


@pytest.mark.parametrize("path", FAULTY, ids=lambda p: p.stem)
def test_faults_of_a_statement_are_reported_with_their_place(path: Path) -> None:
    with pytest.raises(PlanMethodError) as caught:
        load(path) and Solution(load(path))
    error = caught.value
    faults = error.faults if isinstance(error, ProblemError) else [error]
    assert [str(fault) for fault in faults] == told(path, "fault")
    assert error.exit_code == int(next(iter(told(path, "exit")), 3))
