"""A bounded part of ``make attack``: hostile input at every entry point."""

from __future__ import annotations

import faulthandler
import os
import time

import pytest
from cases import some

pytest.importorskip("resource", reason="limits of processes are of POSIX")

from doors import ProblemError

from benchmarks.attack.__main__ import DOORS, Found, attack, row

FILES = {
    "problem files": 60, "works": 40, "groups of works": 6, "drawings": 20,
    "templates, layouts": 8, "settings, config, numbers": 12,
}  # fmt: skip


@pytest.mark.parametrize("door", DOORS)
def test_no_hostile_file_breaks_the_program(door: str) -> None:
    count = some(20 * FILES[door], few=FILES[door])
    found = attack(door, range(count))
    assert not found.bad
    assert found.files == count
    assert len(found.codes) > 1, "all files are alike"


def test_a_seed_is_a_file() -> None:
    for door, make in DOORS.items():
        assert make(7) == make(7), door
    assert len({make(seed)[1].get("p.toml") for make in DOORS.values() for seed in range(9)}) > 8


def fail(*_: object, **__: object) -> None:
    raise KeyError("inside")


def late(*_: object, **__: object) -> None:
    while time.process_time() < 1e9:
        pass


def large(*_: object, **__: object) -> None:
    kept = bytearray(700 * 2**20)
    raise ProblemError(str(len(kept)), [])


def dead(*_: object, **__: object) -> None:
    faulthandler.disable()  # it would report a crash where there is none
    os.abort()


@pytest.mark.parametrize(
    ("fault", "said"),
    [(fail, "KeyError"), (late, "over 0.2 s"), (large, "MB"), (dead, "killed")],
)
def test_a_failing_file_is_found(fault: object, said: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("benchmarks.attack.__main__.SECONDS", 0.2)
    monkeypatch.setattr("planmethod.kinds.kind_of", fault)
    found: Found = attack("problem files", range(3))
    assert said in " ".join(found.bad), found
    assert row(found).endswith(f"| {len(found.bad)} |")
