"""A batch on a cluster of this machine: a worker is killed, the files are the same."""

from __future__ import annotations

import json
import pickle
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import nullcontext
from functools import partial
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from cases import some
from click.testing import CliRunner
from worked import PROBLEMS, path_of

from benchmarks.many import killed
from planmethod.cli import cli
from planmethod.commands import batch
from planmethod.commands.batch import VariantOrder

POINT = str(PROBLEMS / "point/k11-01.toml")
VARIANTS = "\n".join(f"[variants.v{n}]\ndriver.phi = {20 + 5 * n}" for n in range(3))


class Here:
    """A cluster of this process, to which everything is sent as to another."""

    def nthreads(self) -> dict[str, int]:
        return {"here": 1}

    def submit(
        self, function: Callable[[VariantOrder], Any], order: VariantOrder, *, key: str
    ) -> Any:
        sent: Callable[[], Any] = partial(function, pickle.loads(pickle.dumps(order)))
        # A worker is in no command: what it does hangs on nothing of the one that sends.
        with ThreadPoolExecutor(1) as thread:
            done = thread.submit(sent).result()
        return SimpleNamespace(result=lambda: pickle.loads(pickle.dumps(done)))


@pytest.fixture
def desk(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A linkage with variants, and a folder with what the commands make of it and of a point."""
    pytest.importorskip("distributed", reason="dask is absent: pip install 'dask[distributed]'")
    monkeypatch.chdir(tmp_path)
    Path("ex3.toml").write_text(path_of("linkages/ex3").read_text("utf-8") + VARIANTS, "utf-8")
    run("sheet", "ex3.toml", "--all-variants", "--format", "pdf", "-o", "own")
    run("sheet", POINT, "--format", "pdf", "-o", "own")
    run("check", "ex3.toml", "--variant", "v1", "--key", "-o", "own")
    return tmp_path


def run(*words: str) -> str:
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 0, result.output
    return result.stdout


def assert_same() -> None:
    for own in Path("own").iterdir():
        assert own.read_bytes() == (Path("out") / own.name).read_bytes(), own.name


def test_what_is_made_is_that_of_the_commands_and_not_made_again(
    desk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(batch, "_cluster", lambda *_: nullcontext(Here()))
    args = ("batch", "ex3.toml", POINT, "--keys")
    assert "4 made, 0 there already." in run(*args)
    assert_same()
    manifest = Path("out", batch.MANIFEST)
    lines = manifest.read_text("utf-8").splitlines(keepends=True)
    names = ["ex3-v0", "ex3-v1", "ex3-v2", "k11-01"]
    assert [json.loads(line)["problem"] for line in lines] == names
    # The end of the run cut a line short, a sheet was spoilt: these two are made again.
    manifest.write_text("".join(lines)[:-20], "utf-8")
    Path("out/ex3-v1.pdf").write_bytes(b"")
    assert "2 made, 2 there already." in run(*args)
    assert_same()
    assert manifest.read_text("utf-8").splitlines(keepends=True) == lines
    monkeypatch.delattr(batch, "_cluster")  # none is begun where nothing is left to do
    assert "0 made, 4 there already." in run(*args)


@pytest.mark.skipif(some(1, few=0) == 0, reason="takes ten seconds: with --thorough")
def test_a_killed_worker_changes_no_byte(desk: Path) -> None:
    said = killed(["ex3.toml", POINT, "--keys"], desk)
    assert "killed" in said
    assert "4 made, 0 there already." in said
    assert_same()


def test_without_dask_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    result = CliRunner().invoke(cli, ["batch", POINT])
    assert result.exit_code == 2
    assert "pip install 'dask[distributed]'" in result.output
