"""The measurements of checking, on few works: that they run and add up."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

import pytest
from click.testing import CliRunner
from doors import Timing, checking, cli, report
from worked import path_of, problem_of


def once(act: Callable[[], object], **_: float) -> Timing:
    act()
    return Timing(1e-3, 1e-3, 1e-3, 1)


@pytest.fixture(autouse=True)
def quickly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "clock", once)


@cache
def detected() -> list[checking.Detected]:
    return checking.all_detected([problem_of("linkages/ex1")], 1)


def test_every_diagnosis_is_counted_once() -> None:
    for row in detected():
        assert row.named + row.among + row.unknown + row.misnamed == row.works
        assert row.noticed <= row.works <= checking.PLACES
        assert sum(row.named_as.values()) >= row.misnamed


def test_variants_of_a_file_are_distinguished(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(checking, "places_of", lambda task, key: iter(()))
    problems = [problem_of("linkages/ex3-variants", name) for name in ("1", "2")]
    rows = [row for row in checking.all_detected(problems, 1) if row.code == "P2"]
    assert [row.problem for row in rows] == ["ex3-variants (1)", "ex3-variants (2)"]
    assert all(row.named == row.works == 1 for row in rows)


def test_the_tables_have_a_row_for_every_mistake() -> None:
    rows = report.mistakes_table(detected())[2:]
    codes = [row.split(" | ")[0].removeprefix("| ") for row in rows]
    assert codes[-1] == "all"
    assert set(codes[:-1]) == {row.code for row in detected()}
    assert len(report.power_table(detected())) == len(codes) + 1


@pytest.mark.dear
def test_the_section_is_printed_without_the_referee() -> None:
    words = ["bench", "--only", "checking", "--works", "2", str(path_of("linkages/ex1"))]
    run = CliRunner().invoke(cli, words)
    assert run.exit_code == 0, run.output
    for heading in (
        "Submissions without a mistake",
        "Submissions with a mistake",
        "Mistakes that the answers cannot show",
        "Speed",
    ):
        assert f"## {heading}" in run.output
    assert "| ex1, board | 2 |" in run.output
