"""The benchmark's measurements, each taken once: they run, and compare the peers."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
import pytest
from click.testing import CliRunner
from doors import Sweep, Timing, speed, speed_section

from benchmarks import bounds, growth, many, report, rivals
from benchmarks.__main__ import main
from benchmarks.figure import draw
from benchmarks.peers import ROWS, peers
from benchmarks.scenes import FOURBAR_ROWS, chain, fourbar


def once(act: Callable[[], object], **_: object) -> Timing:
    act()
    return Timing(1e-3, 1e-3, 1e-3, 1)


@pytest.fixture(autouse=True)
def quickly(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(speed, "clock", once)
    monkeypatch.setattr(rivals, "clock", once)
    monkeypatch.setattr(growth, "clock", once)


def test_all_peers_compute_the_same() -> None:
    sweep = Sweep(fourbar(), FOURBAR_ROWS)
    assert len(sweep.rows) == ROWS
    angles = speed.crank_angles(300)
    mine = sweep.run(angles)
    for peer in peers():
        answer = peer.run(angles)
        assert answer is not None
        assert np.allclose(answer, mine[list(peer.rows)], rtol=1e-9, atol=1e-9), peer.name


@pytest.mark.parametrize("dyads", [1, 4, 25])
def test_a_chain_of_dyads_turns_all_round(dyads: int) -> None:
    problem = chain(dyads)
    assert len(problem.mechanism.links) == 1 + 2 * dyads
    assert np.isfinite(Sweep(problem, ["positions"]).run(speed.crank_angles(72))).all()


def test_the_document_has_its_tables_and_figure() -> None:
    readings = speed.sweeps(fourbar(), (12, 100), FOURBAR_ROWS)
    compared = rivals.rivals((12, 100), rounds=1)
    positions, links = rivals.by_positions((1, 12)), growth.by_links((1, 2), count=100)
    scenes = rivals.by_scene(100)
    others = [*growth.by_loads((1, 2)), *growth.by_wheels((3, 4)), *growth.by_works((1, 2))]
    sections = [
        [*speed_section(readings), *bounds.bounds_table(bounds.of_sweeps(readings))],
        [*report.rivals_section(compared), *bounds.bounds_table(bounds.of_rivals(compared))],
        report.growth_section(positions, links, others),
        report.scenes_section(scenes),
    ]
    text = report.document(sections, figure="f.png", command="python -m benchmarks")
    assert "| planmethod, sweep |" in text and "![time against error" in text
    lines = text.splitlines()
    for head, rule in itertools.pairwise(lines):
        if rule.startswith("| ---"):
            assert head.count("|") == rule.count("|")
    steps = [row[1] for row in scenes]
    assert steps == sorted(steps) and steps[0] < steps[-1]
    assert draw(readings, compared, positions, links).startswith(b"\x89PNG")


def test_sections_by_themselves() -> None:
    arguments = ["--only", "random", "--random", "4"]
    told = CliRunner().invoke(main, arguments)
    assert told.exit_code == 0, told.output
    assert "## Random mechanisms" in told.stdout and "4 mechanisms" in told.stdout
    assert "exceptions: 0; results that are NaN without a reason: 0" in told.stdout
    assert "on a wrong branch: 0 of 48 positions" in told.stdout


def test_every_limit_is_printed_with_its_number() -> None:
    told = bounds.bounds_table([bounds.Bound("more", 2.0, 1.0)])
    assert told[-1] == "| more | 2 | at most 1 | no |"
    linear = [many.Grown(n, 1.0 + 1e-3 * n, 30.0) for n in (10, 100, 1000, 10_000)]
    assert many.exponent(linear, "seconds") == pytest.approx(1.0)
    assert many.exponent(linear, "peak_mb") == 0.0
