"""The benchmark's measurements, each taken once: that they run, and what they say of errors."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest

from planmethod.bench import report, speed
from planmethod.bench.clock import Timing
from planmethod.bench.figure import draw
from planmethod.bench.peers import ROWS, peers
from planmethod.bench.scenes import FOURBAR_ROWS, chain, fourbar
from planmethod.solved.many.sweep import Sweep


def once(act: Callable[[], object], **_: float) -> Timing:
    act()
    return Timing(1e-3, 1e-3, 1e-3, 1)


@pytest.fixture(autouse=True)
def quickly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed, "clock", once)


def test_readings_are_as_good_as_their_digits() -> None:
    for scene in ("four-bar", "slotted-link"):
        errors = {r.name: r.error for r in speed.single_readings(scene)}
        assert errors["step by step, float64"] < 2e-15
        assert errors["referee, 30 digits"] < 1e-28
        assert errors["referee, 50 digits"] < 1e-48
        assert 1e-6 < errors["the hand, ruler 0.1 mm"] < errors["the hand, ruler 1 mm"] < 0.1


@pytest.mark.parametrize("scene", ["four-bar", "slotted-link"])
def test_sweeps_are_good_to_four_units(scene: str) -> None:
    for reading in speed.sweeps(scene, (12, 5000)):
        limit = 4e-15 if reading.name.endswith("64") else 5e-6
        assert reading.error < limit, reading


def test_all_who_are_compared_compute_the_same() -> None:
    sweep = Sweep(fourbar(), FOURBAR_ROWS)
    assert len(sweep.rows) == ROWS
    angles = speed.turn(300)
    mine = sweep.run(angles)
    for peer in peers():
        answer = peer.run(angles)
        assert answer is not None
        assert np.allclose(answer, mine[list(peer.rows)], rtol=1e-9, atol=1e-9), peer.name


@pytest.mark.parametrize("dyads", [1, 4, 25])
def test_a_chain_of_dyads_turns_all_round(dyads: int) -> None:
    problem = chain(dyads)
    assert len(problem.mechanism.links) == 1 + 2 * dyads
    assert np.isfinite(Sweep(problem, ["positions"]).run(speed.turn(72))).all()


def test_the_document_has_its_tables_and_figure() -> None:
    readings = speed.sweeps("four-bar", (12, 100))
    rivals = speed.rivals((12, 100), rounds=1)
    positions, links = speed.by_positions((1, 12)), speed.by_links((1, 2), count=100)
    scenes = speed.by_scene(100)
    sections = [
        report.readings_section(readings),
        report.rivals_section(rivals),
        report.growth_section(positions, links),
        report.scenes_section(scenes),
    ]
    text = report.document(sections, figure="f.png", command="planmethod bench")
    assert "| planmethod, sweep |" in text and "![time against error" in text
    lines = text.splitlines()
    for head, rule in itertools.pairwise(lines):
        if rule.startswith("| ---"):
            assert head.count("|") == rule.count("|")
    steps = [row[1] for row in scenes]
    assert steps == sorted(steps) and steps[0] < steps[-1]
    assert draw(readings, rivals, positions, links).startswith(b"\x89PNG")


def test_times_are_told_in_their_unit() -> None:
    assert [report.span(s) for s in (2.5, 0.0123, 4.2e-6, 3e-9)] == [
        "2.5 s", "12.3 ms", "4.2 µs", "3 ns",
    ]  # fmt: skip
