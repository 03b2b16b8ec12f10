"""Tasks of section 2.1 from a bank: written, solved, compared with Newton, stated again."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner
from msgspec.structs import replace

from benchmarks import statements
from planmethod import loads

BANK = """
tasks:
- {id: 2.1.1, lengths: {l_OA: 0.1, l_AB: 0.4, l_BC: 0.4}, angles: {phi_3: 90, phi_2_3: 90},
   phi1: [], omega1: 10}
- {id: 2.1.3, lengths: {l_OA: 0.1}, angles: {phi_1: 90}, phi1: [90], omega1: 10}
- {id: 2.1.7, lengths: {l_OA: 0.3, l_AB: 0.8, l_BC: 0.7},
   angles: {phi_1: 90, phi_3: 90, alpha: 30},
   phi1: [90], omega1: 60}
- {id: 2.1.8, lengths: {l_AB: 0.1, l_BC: 0.3},
   angles: {phi_1: 90, alpha: 30}, phi1: [90], omega1: 50}
- {id: 2.1.9, lengths: {l_OA: 0.1}, angles: {phi_1: 30, phi_3: 90}, phi1: [30], omega1: 50}
- {id: 2.1.127, lengths: {l_OA: 0.02, l_AB: 0.26, l_OC: 0.312, l_BC: 0.026}, angles: {alpha: 90},
   phi1: [0, 60], omega1: 70}
"""


@pytest.fixture
def bank(tmp_path: Path) -> Path:
    pytest.importorskip("yaml")
    (tmp_path / "tasks_linkage.yaml").write_text(BANK, encoding="utf-8")
    return tmp_path


def test_tasks_are_counted_by_what_becomes_of_them(bank: Path) -> None:
    printed = CliRunner().invoke(statements.run, [str(bank), "--written", str(bank / "files")])
    assert printed.exit_code == 0, printed.output
    for row in (
        "| solved, whole | 2 | 1 | 7, 8 |",
        "| prints too little | 1 | 1 | 1 |",
        "| its figure is lost | 1 | 1 | 9 |",
        "| its data contradict each other | 1 | 0 | 127 |",
        "| all | 5 | 3 | |",
    ):
        assert row in printed.output
    text = (bank / "files/2.1.7.toml").read_text(encoding="utf-8")
    assert abs(loads(text, name="7").bodies["0"].points["C"] - 0.48**0.5) < 1e-9


def test_newton_finds_another_place_for_other_numbers(bank: Path) -> None:
    """The comparison must be able to fail: the angle of the rod is 31 degrees, not 30."""
    tasks = {name: task for name, task, _, _ in statements.read_tasks(bank)}
    task = tasks["2.1.7"]
    assert task is not None
    problem = loads(task.text(), name="7")
    assert statements.difference(task, problem) < statements.SAME
    other = replace(task, numbers=task.numbers | {"alpha": 31.0})
    assert statements.difference(other, problem) > 1e-3
    assert statements.outcome(replace(task, reading=replace(task.reading, little=True)))[0] == (
        "not as expected: solved"
    )
