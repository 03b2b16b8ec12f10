"""Hard cases: good results, a warning, or a refusal with a reason; never a silent wrong number."""

from __future__ import annotations

import math
import re
from dataclasses import replace

import pytest
from cases import thinned
from doors import MULTIPLE, AssemblyError, Solution, problem_loads as loads, verify

from benchmarks import hard_problems as texts
from benchmarks.hard import HardCase, HardRow, Outcome, run
from benchmarks.hard_cases import HARD
from benchmarks.hard_report import summarise, table

CASES = {case.name: case for case in HARD}

REGULAR = {"slider-crank-by-crank", "rocker-by-crank", "quadrants", "zeros"}
"""Cases whose exact positions are not dead positions of their driver, turned or not."""

DEAD = r"dead position|guides are parallel"

SOLVABLE = re.compile(r"by two lengths|slide.* of \S+ m, 5e\+05|from a joint")
"""Rows that are sound for any numbers: an error is a fault."""

RIVAL = "epsilon is small beside omega squared, of which it is a difference"

FAULTS = {
    ("ratios", "crank 1e+02 of the frame"): RIVAL,
    ("ratios", "crank 1e+04 of the frame"): RIVAL,
    ("ratios", "crank 1e+06 of the frame"): RIVAL,
}
"""Rows that do not hold yet, and why; the rest of their cases holds."""


def examined(case: HardCase, *labels: str) -> list[HardRow]:
    rows = tuple(row for row in case.rows if row.label in labels or not labels)
    return run(replace(case, rows=rows))


def hold(row: HardRow) -> None:
    """Assert all that must hold of a row."""
    where = f"{row.case}, {row.label}"
    assert row.outcome is not Outcome.BROKEN, f"{where}: {row.told}"
    assert not row.silently_wrong, f"{where}: {row.error_of} is off by {row.error:.1e}"
    assert not row.underrated, f"{where}: {row.error_of} is off by {row.error:.1e}"
    assert (row.told == "") == (row.outcome is Outcome.GOOD), where
    if row.outcome is not Outcome.REFUSED:
        assert row.multiple <= MULTIPLE, f"{where}: {row.multiple_of} {row.multiple:.3g}"
        assert row.share <= MULTIPLE, f"{where}: {row.error_of} {row.share:.3g}"
    if SOLVABLE.search(row.label):
        assert row.outcome is not Outcome.REFUSED, f"{where}: {row.told}"
    if is_dead(row):
        assert row.outcome is Outcome.REFUSED, where
        assert re.search(DEAD, row.told), f"{where}: {row.told}"


def is_dead(row: HardRow) -> bool:
    if row.case.removesuffix("-turned") in REGULAR:
        return False
    return "exactly" in row.label or row.label.startswith("pin on a")


@pytest.mark.parametrize("name", CASES)
def test_every_row_is_good_or_has_a_message(name: str) -> None:
    """By default of every third row and of those that are dead exactly."""
    case = CASES[name]
    labels = [row.label for row in case.rows]
    taken = {*thinned(labels, 3), *(label for label in labels if "exactly" in label)}
    known = {label for case, label in FAULTS if case == name}
    for row in examined(case, *(taken - known)):
        hold(row)


@pytest.mark.parametrize(
    ("name", "label"),
    [
        pytest.param(*key, marks=pytest.mark.xfail(strict=True, reason=reason))
        for key, reason in FAULTS.items()
    ],
    ids=" ".join,
)
def test_a_known_fault_of_a_row(name: str, label: str) -> None:
    (row,) = examined(CASES[name], label)
    hold(row)


def test_names_and_labels_are_unique() -> None:
    assert len(CASES) == len(HARD)
    keys = [(case.name, row.label) for case in HARD for row in case.rows]
    assert len(set(keys)) == len(keys)
    assert set(FAULTS) <= set(keys)


def test_a_dead_slider_driven_by_its_crank_is_exactly_at_rest() -> None:
    solution = Solution(loads(texts.slider_crank(), name="x"), positions=[0.0, 180.0, -180.0])
    verify(solution)
    assert list(solution.points["B"].velocity) == [0, 0, 0]
    assert list(solution.points["B"].place) == [0.5, 0.25, 0.25]


def test_an_error_names_the_fault_and_its_place() -> None:
    (row,) = examined(CASES["rocker-by-rocker"], "exactly")
    assert row.outcome is Outcome.REFUSED
    assert "at phi = 90 deg" in row.told
    assert math.isinf(row.warned)


@pytest.mark.parametrize(
    ("text", "position"),
    [
        (texts.rocker(phi=110.0, by_rocker=True), 89.0),
        (texts.slotted(pivot=0.125 + 0j), 0.0),
    ],
    ids=["arcs that do not meet", "pin on a pivot"],
)
def test_an_impossible_position_is_reported_without_numpy_warnings(
    text: str, position: float
) -> None:
    # Warnings are errors here.
    solution = Solution(loads(text, name="x"), positions=[position])
    with pytest.raises(AssemblyError):
        verify(solution)


def test_the_referee_checks_existing_results_where_a_pin_is_on_its_pivot() -> None:
    (row,) = examined(CASES["slotted"], "exactly")
    assert not math.isnan(row.margin)


def test_a_small_gap_between_arcs_is_seen_in_the_message() -> None:
    (row,) = examined(CASES["slider-crank-by-slider"], "beyond, 1e-9 m")
    assert "1e-09" in row.told


def test_the_tables_have_their_lines() -> None:
    case = CASES["rocker-by-rocker"]
    rows = examined(case, "1e-01", "1e-02", "1e-09", "exactly")
    whole, folded = table(rows, folded=False).splitlines(), table(rows).splitlines()
    assert len(whole) == 2 + 4
    assert len(folded) == 2 + 3
    assert "| 1e-01 … 1e-02 | good |" in folded[2]
    (line,) = summarise(rows).splitlines()[2:]
    assert line.startswith(f"| {case.name} | {case.title} | 4 | 2 | 1 | 1 | 0 |")
