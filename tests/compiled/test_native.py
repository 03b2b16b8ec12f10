"""Tapes compiled by the system's compiler: the numbers of NumPy's blocks, and whose code is run."""

from __future__ import annotations

import os
import random
import re
import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from doors import (
    COMPILERS,
    CSOURCE_BLOCK as BLOCK,
    GUARDS_PER_WORD,
    MANY,
    Blocks,
    Guard,
    ModelProblem as Problem,
    Native,
    NotCompiledError,
    NumberName,
    Ref,
    Sweep,
    Tape,
    c_source,
    native as native_module,
    problem_load as load,
    problem_loads as loads,
    problem_template as template,
)
from tapes import drawn
from worked import path_of

AS_ALWAYS = native_module.FLAGS

pytestmark = pytest.mark.skipif(
    not any(map(shutil.which, COMPILERS)) or not hasattr(os, "getuid"), reason="no C compiler"
)


@pytest.fixture(scope="module", autouse=True)
def cache(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Compile into a cache of the tests."""
    home = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PLANMETHOD_NATIVE", "1")
        patch.setenv("XDG_CACHE_HOME", str(home))
        quick = tuple(flag.replace("O3", "O1") for flag in native_module.FLAGS)
        patch.setattr(native_module, "FLAGS", quick)  # a third of the time of the compiler
        yield home / "planmethod" / "native"


def both(
    tape: Tape,
    results: list[Ref],
    guards: list[Guard],
    depends: list[frozenset[int]],
    columns: list[Any],
) -> tuple[Any, Any]:
    """Run a tape compiled and in NumPy's blocks: results and first guards that do not hold."""
    found = []
    made = Native(c_source(tape, results, guards, depends), may_compile=True)
    for runner in (made, Blocks(tape, results, guards, depends)):
        out = np.empty((len(results), len(columns[0])))
        failed = np.empty(len(columns[0]), np.int16)
        runner.run([np.array(column) for column in columns], out, failed)
        found.append((out, failed))
    return found[0], found[1]


def test_a_compiled_tape_is_that_of_numpy() -> None:
    """With more guards than a word holds, and more positions than a block."""
    rng, tape = random.Random(1), Tape()
    made = [ref for _ in range(2) for ref, _ in drawn(rng, tape, 60)]
    made += [
        tape.add_node("at_zero", tape.add_node("max", 0, 0.25), 1, 2),
        tape.add_node("div", 0, 1),
    ]
    results = [*made, made[-1], 7.5]
    nodes = [ref for ref in made if type(ref) is int][:-1]
    limits = [-1.99] * GUARDS_PER_WORD + [0.5] * (len(nodes) - GUARDS_PER_WORD)
    guards = [Guard(NumberName("g"), *pair) for pair in zip(nodes, limits, strict=True)]
    depends = [frozenset(rng.sample(range(len(guards)), k % 4)) for k in range(len(results))]
    columns = [[rng.uniform(-2.0, 2.0) for _ in range(2 * BLOCK + 17)] for _ in range(3)]
    columns[0][5] = float("nan")
    mine, theirs = both(tape, results, guards, depends, columns)
    assert len(set(mine[1].tolist())) > 5 and mine[1].max() >= GUARDS_PER_WORD
    assert np.array_equal(mine[1], theirs[1])
    assert np.array_equal(np.isnan(mine[0]), np.isnan(theirs[0]))
    np.testing.assert_allclose(mine[0], theirs[0], rtol=1e-12, atol=1e-14)


def test_angles_are_good_to_the_last_place_and_exact_at_quadrants(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(native_module, "FLAGS", AS_ALWAYS)
    tape = Tape()
    a, x, y = (tape.input(k) for k in range(3))
    results = [tape.add_node("cosd", a), tape.add_node("sind", a)]
    results += [
        tape.add_node("atan2", y, x),
        tape.add_node("degrees", tape.add_node("atan2", y, x)),
    ]
    rng = np.random.default_rng(1)
    angles = np.concatenate([np.arange(-8, 9) * 90.0, rng.uniform(-720, 720, 4000), [3.6e8 + 90]])
    size = rng.uniform(0.1, 9, angles.shape)
    long = np.radians(np.remainder(angles, 360.0).astype(np.longdouble))
    x_of, y_of = (size * np.cos(long)).astype(float), (size * np.sin(long)).astype(float)
    x_of[:3], y_of[:3] = (-1.0, 1.0, 0.0), (-0.0, 0.0, -2.0)
    (out, _), (theirs, _) = both(tape, results, [], [frozenset()] * 4, [angles, x_of, y_of])
    assert out[0, :17].tolist() == [1, 0, -1, 0] * 4 + [1]
    assert out[1, :17].tolist() == [0, 1, 0, -1] * 4 + [0]
    assert out[:2, -1].tolist() == [0.0, 1.0]
    exact = np.cos(long), np.sin(long), np.arctan2(y_of.astype(np.longdouble), x_of)
    for found, right in zip(out, exact, strict=False):
        assert np.abs(found - right).max() <= 2.3e-16 * np.abs(right).max()
    assert out[3, :3].tolist() == [180.0, 0.0, -90.0]
    assert np.abs(out[3] - theirs[3]).max() <= 6e-14


def test_angles_of_equal_steps_are_turned_by_a_table() -> None:
    """Steps equal to rounding count as equal; a block with another one is turned one by one."""
    tape = Tape()
    a = tape.input(0)
    results = [tape.add_node("cosd", a), tape.add_node("sind", a)]
    angles = np.linspace(-400.0, 700.0, 5 * BLOCK + 3)
    angles[3 * BLOCK + 7] += 0.01
    (out, _), _ = both(tape, results, [], [frozenset()] * 2, [angles])
    turned = np.radians(angles.astype(np.longdouble))
    for found, right in zip(out, (np.cos(turned), np.sin(turned)), strict=True):
        assert np.abs(found - right).max() <= 4.5e-16


def agree(problem: Problem, positions: Any, **asked: Any) -> Sweep:
    mine, theirs = Sweep(problem, native=True, **asked), Sweep(problem, native=False, **asked)
    assert not mine.uncompiled and theirs.uncompiled
    found = []
    for sweep in (mine, theirs):
        out, failed = np.empty((len(sweep.rows), len(positions))), np.empty(len(positions), "i2")
        sweep.run(positions, out=out, failed=failed)
        found.append((out, failed))
    (out, failed), (right, gaps) = found
    assert np.array_equal(failed, gaps)
    assert np.array_equal(np.isnan(out), np.isnan(right))
    size = np.nanmax(np.abs(right), axis=1, keepdims=True)
    assert np.nanmax(np.abs(out - right) - 4e-15 * size) <= 4e-15 * np.nanmax(size)
    return mine


def test_sweeps_are_those_of_numpy_with_forces_and_gaps() -> None:
    positions = np.linspace(-170.0, 170.0, 1300)
    agree(load(path_of("levers/task12")), positions, asked=["v_B", "forces"])
    sweep = agree(load(path_of("levers/six-link")), positions, asked=["positions"])
    assert (np.isnan(sweep.run(positions)).any(axis=0)).any()


def test_variants_bound_calls_and_odd_buffers() -> None:
    problem = loads(template("four-bar"), name="four-bar")
    plain = Sweep(problem, varied=["omega_1"], native=False)
    sweep = Sweep(problem, varied=["omega_1"], native=True)
    positions, speeds = np.linspace(0.0, 90.0, 7), np.array([[1.0], [2.0], [3.0]])
    right = plain.run(positions, {"omega_1": speeds})
    assert sweep.run(positions, {"omega_1": speeds}) == pytest.approx(right, rel=1e-14, abs=1e-14)
    turned = np.empty((7, 3, len(sweep.rows))).T  # not in line: NumPy fills it
    assert sweep.run(positions, {"omega_1": speeds}, out=turned) is turned
    assert turned == pytest.approx(right, rel=1e-14, abs=1e-14)
    call = sweep.bind(positions, {"omega_1": speeds})
    first = call()
    positions += 30.0
    speeds *= -2.0
    again = call()
    assert again is first
    right = plain.run(positions, {"omega_1": speeds})
    assert again == pytest.approx(right, rel=1e-14, abs=1e-14)
    loaded = load(path_of("levers/task12"))
    for native in (True, False):
        at = np.array([10.0, 20.0, 30.0])
        bound = Sweep(loaded, forces=True, native=native).bind(at)
        at += 50.0
        right = Sweep(loaded, forces=True, native=False).run(at)
        assert bound() == pytest.approx(right, rel=1e-12)


# Whose code is run --------------------------------------------------------------------------------


def small(name: str = "limit") -> Any:
    tape = Tape()
    x = tape.input(0)
    return c_source(tape, [tape.mul(3.14159, x)], [Guard(NumberName(name), x, 0.5)], [frozenset()])


def test_the_source_has_no_data_of_a_problem_and_variants_share_a_library(cache: Path) -> None:
    source = small("Ё; system()")
    assert source.constants == (0.5, 3.14159) or source.constants == (3.14159, 0.5)
    assert "system" not in source.text and "3.14159" not in source.text
    assert source.text.isascii()
    one = template("four-bar")
    other = re.sub(r"^omega = .*$", "omega = 13.5", one, flags=re.M)
    assert other != one
    kept = []
    for text in (one, other):
        Sweep(loads(text, name="x"), ["v_B"], native=True)
        kept.append(sorted(cache.glob("*.so")))
    assert kept[0] == kept[1]
    assert oct(cache.stat().st_mode & 0o777) == "0o700"
    assert [p for p in cache.iterdir() if p.suffix != ".so"] == []


def test_a_kept_library_is_found_again_and_only_from_many_positions(cache: Path) -> None:
    problem = loads(template("slider-crank"), name="slider-crank")
    fresh = Sweep(problem, ["B"])
    fresh.run(np.linspace(0.0, 90.0, MANY))
    assert fresh.uncompiled == "it has not been compiled yet"
    Sweep(problem, ["B"], native=True)
    for count, native in ((MANY - 1, False), (MANY, True)):
        sweep = Sweep(problem, ["B"])
        sweep.run(np.linspace(0.0, 90.0, count))
        assert (sweep.uncompiled == "") is native


@pytest.mark.parametrize(
    ("spoil", "said"),
    [
        (lambda patch, cache: patch.setenv("PLANMETHOD_NATIVE", "0"), "PLANMETHOD_NATIVE=0"),
        (lambda patch, cache: patch.setenv("PATH", str(cache)), "no C compiler"),
        (lambda patch, cache: cache.chmod(0o750), "is open to others"),
        (lambda patch, cache: patch.setattr(os, "getuid", lambda: 12345), "is open to others"),
        (lambda patch, cache: patch.setattr(native_module, "FLAGS", ("-fno-such",)), "not compile"),
    ],
)
def test_without_a_library_numpy_does_the_work(
    spoil: Any, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path))
    cache = tmp_path / "planmethod" / "native"
    cache.mkdir(parents=True, mode=0o700)
    spoil(monkeypatch, cache)
    sweep = Sweep(loads(template("four-bar"), name="x"), ["v_B"], native=True)
    assert said in sweep.uncompiled
    assert np.isfinite(sweep.bind([10.0, 20.0])()).all()


def test_a_file_that_others_may_write_is_not_loaded(cache: Path) -> None:
    made = Native(small(), may_compile=True)
    out = np.empty((1, 2))
    made.run([np.array([1.0, 2.0])], out)
    (path,) = (p for p in cache.glob("*.so") if p.stat().st_mtime == newest(cache))
    path.chmod(0o722)
    with pytest.raises(NotCompiledError, match="not a file of yours alone"):
        Native(small(), may_compile=True)
    path.chmod(0o700)


def test_folders_of_the_cache_are_the_users_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("XDG_CACHE_HOME", str(tmp_path / "a/b"))
    before = os.umask(0)
    try:
        folder = native_module._folder()
    finally:
        os.umask(before)
    for one in (folder, *folder.parents[:4]):
        if one != tmp_path:
            assert one.stat().st_mode & 0o777 == 0o700, one


def newest(cache: Path) -> float:
    return max(path.stat().st_mtime for path in cache.glob("*.so"))


def test_the_cache_is_bounded(cache: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    old = cache / "old.so"
    old.write_bytes(b"x" * 1000)
    os.utime(old, (1, 1))
    monkeypatch.setattr(
        native_module, "MAX_CACHE_BYTES", sum(p.stat().st_size for p in cache.glob("*.so"))
    )
    tape = Tape()
    Native(c_source(tape, [tape.add(tape.input(0), 9.0)], [], [frozenset()]), may_compile=True)
    assert not old.exists()
    assert list(cache.glob("*.so"))


def test_a_truncated_library_is_rebuilt(cache: Path) -> None:
    """To load one kills the process (SIGBUS)."""
    tape = Tape()
    source = c_source(tape, [tape.add(tape.input(0), 17.0)], [], [frozenset()])
    Native(source, may_compile=True)
    (path,) = (p for p in cache.glob("*.so") if p.stat().st_mtime == newest(cache))
    whole = path.read_bytes()
    for spoilt in (whole[:5000], whole[:-1], b"", whole[:-1] + b"x"):
        path.unlink()
        path.write_bytes(spoilt)  # another file: the first one is at work
        path.chmod(0o700)
        with pytest.raises(NotCompiledError, match="not been compiled yet"):
            Native(source, may_compile=False)
        assert not path.exists()
        made, out = Native(source, may_compile=True), np.empty((1, 2))
        made.run([np.array([1.0, 2.0])], out)
        assert out.tolist() == [[18.0, 19.0]]
        (path,) = (p for p in cache.glob(f"{path.stem[:40]}*"))
