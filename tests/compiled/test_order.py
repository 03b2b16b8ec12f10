"""The order of a tape's operations, and its live numbers: no more for a longer chain."""

from __future__ import annotations

import hashlib
import re
from typing import Any

import numpy as np
import pytest
from doors import (
    BLOCKS_BLOCK as BLOCK,
    CACHE_BYTES,
    MIN_BLOCK,
    Blocks,
    ModelProblem as Problem,
    Ref,
    Runner,
    Sweep,
    Tape,
    TapeProgram,
    c_source,
    symbolic,
    used_by,
    varied as sweeping,
)

from benchmarks.scenes import chain


def written(problem: Problem, asked: list[str] | None, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return the written program of a sweep and the results wanted of it."""
    kept: list[Any] = []

    def watched(made: TapeProgram, results: Any, depends: Any, **more: Any) -> Runner:
        kept.append((made, results, depends))
        return Runner(made, results, depends, **more)

    with monkeypatch.context() as patch:
        patch.setattr(sweeping, "Runner", watched)
        Sweep(problem, asked, native=False)
    return kept[0]


@pytest.mark.parametrize("last", [False, True], ids=["everything", "the last acceleration"])
def test_numbers_at_hand_do_not_grow_with_a_chain(
    last: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    live, buffers = [], []
    for dyads in (3, 6, 24):
        asked = [f"a_C{dyads}"] if last else None
        made, results, depends = written(chain(dyads), asked, monkeypatch)
        blocks = Blocks(made.tape, results, made.guards, depends)
        live.append(blocks.live)
        source = c_source(made.tape, results, made.guards, depends).text
        buffers.append(len(re.findall(r"double b\d+\[", source)))
        assert blocks.block == BLOCK
    assert live[0] == live[1] == live[2] <= 16
    assert max(buffers) <= 24


def test_every_operand_is_made_before_it_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    made, results, _ = written(chain(5), None, monkeypatch)
    order = used_by(made.tape, [*results, *(guard.margin for guard in made.guards)])
    assert order != sorted(order)  # else the order would not matter
    place = {number: i for i, number in enumerate(order)}
    for number in order:
        kind, refs = made.tape.nodes[number]
        if kind != "input":
            assert all(place[ref] < place[number] for ref in refs if type(ref) is int)


def test_a_value_that_an_earlier_part_reads_is_made_there() -> None:
    """An operation shared by two parts is there once, and the later one may have written it."""
    tape = Tape()
    x = tape.input(0)
    tape.part = 2
    late = tape.add_node("sqrt", x)
    after = tape.add(late, 5.0)
    tape.part = 1
    early = tape.add(late, 1.0)
    assert tape.parts[int(late)] == tape.parts[int(early)] == 2
    first = tape.mul(3.0, x)
    order = used_by(tape, [early, after, first])
    assert sorted(order) == [x, late, after, early, first]
    assert order.index(int(late)) < min(order.index(int(early)), order.index(int(after)))
    assert order.index(int(first)) < order.index(int(late))


def test_the_order_changes_no_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    """Run in the order in which it was written, a tape gives the same bytes."""
    angles, problem = np.linspace(-300.0, 500.0, 1000), chain(4)
    found = []
    for parts in (True, False):
        with monkeypatch.context() as patch:
            if not parts:
                patch.setattr(sweeping, "write", lambda p, d, i, _: symbolic.write(p, d, i))
            sweep = Sweep(problem, native=False)
        failed = np.empty(len(angles), np.int16)
        out = np.empty((len(sweep.rows), len(angles)))
        sweep.run(angles, out=out, failed=failed)
        few = sweep.run(angles[:7])
        found.append([hashlib.sha256(a.tobytes()).hexdigest() for a in (out, failed, few)])
        found[-1].append(str(sweep.live))
    assert found[0][:3] == found[1][:3]
    assert int(found[0][3]) < int(found[1][3])


def test_a_block_is_shorter_where_more_numbers_are_at_hand() -> None:
    lengths = []
    for count in (4, 300, 4000):
        tape = Tape()
        x = tape.input(0)
        many: list[Ref] = [tape.mul(float(k) + 2.5, x) for k in range(count)]
        total = many[0]
        for one in many[1:]:
            total = tape.add_node("max", total, one)
        for one in reversed(many):  # all are read again
            total = tape.add_node("min", total, tape.add_node("sqrt", one))
        blocks = Blocks(tape, [total], [], [frozenset()])
        assert count <= blocks.live <= count + 3
        lengths.append(blocks.block)
        assert blocks.block == MIN_BLOCK or blocks.block * blocks.live * 8 <= max(
            CACHE_BYTES, BLOCK * blocks.live * 8 if blocks.block == BLOCK else 0
        )
        positions = np.linspace(1.0, 2.0, 5000)
        out = np.empty((1, len(positions)))
        blocks.run([positions], out)
        assert np.array_equal(out[0], np.sqrt(2.5 * positions))
    assert lengths[0] == BLOCK > lengths[1] > lengths[2] == MIN_BLOCK


def test_buffers_of_turned_angles_are_given_back() -> None:
    tape = Tape()
    angle, total = tape.input(0), tape.input(1)
    for k in range(30):
        turned = tape.add_node("mul", float(k) + 2.0, angle)
        total = tape.add_node("max", total, tape.add_node("cosd", turned))  # no sine is wanted
    assert Blocks(tape, [total], [], [frozenset()]).live <= 4
