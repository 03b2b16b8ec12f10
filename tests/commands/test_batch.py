"""A batch in processes and on a cluster: killed workers, equal files, no open sockets."""

from __future__ import annotations

import hashlib
import json
import os
import pickle
import shutil
import socket
import subprocess
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
from doors import VariantOrder, batch, cli
from worked import PROBLEMS, ROOT, path_of

from benchmarks.many import killed

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
        # A worker runs outside any command: it does not depend on the sender's context.
        with ThreadPoolExecutor(1) as thread:
            done = thread.submit(sent).result()
        return SimpleNamespace(result=lambda: pickle.loads(pickle.dumps(done)))


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A linkage with variants, and a folder with the files made from it and from a point."""
    folder = tmp_path_factory.mktemp("made")
    ex3, own = folder / "ex3.toml", str(folder / "own")
    ex3.write_text(path_of("linkages/ex3").read_text("utf-8") + VARIANTS, "utf-8")
    run("sheet", str(ex3), "--all-variants", "--format", "pdf", "-o", own)
    run("sheet", POINT, "--format", "pdf", "-o", own)
    run("check", str(ex3), "--variant", "v1", "--key", "-o", own)
    return folder


@pytest.fixture
def desk(made: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the folder, to work in."""
    monkeypatch.chdir(shutil.copytree(made, tmp_path, dirs_exist_ok=True))
    return tmp_path


def run(*words: str) -> str:
    result = CliRunner().invoke(cli, words)
    assert result.exit_code == 0, result.output
    return result.stdout


def assert_same() -> None:
    for own in Path("own").iterdir():
        assert own.read_bytes() == (Path("out") / own.name).read_bytes(), own.name


def test_batch_makes_the_files_of_the_commands_and_does_not_repeat_them(
    desk: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def listen(*_: object) -> None:
        (desk / "listened").touch()

    for name in ("listen", "bind", "connect"):  # also in the processes
        monkeypatch.setattr(socket.socket, name, listen)
    args = ("batch", "ex3.toml", POINT, "--keys", "--jobs", "2")
    assert "4 written, 0 existed already." in run(*args)
    assert_same()
    assert not (desk / "listened").exists()
    manifest = Path("out", batch.MANIFEST)
    lines = manifest.read_text("utf-8").splitlines(keepends=True)
    names = ["ex3-v0", "ex3-v1", "ex3-v2", "k11-01"]
    assert [json.loads(line)["problem"] for line in lines] == names
    # The end of the run cut a line short, a sheet was spoilt: these two are made again.
    manifest.write_text("".join(lines)[:-20], "utf-8")
    Path("out/ex3-v1.pdf").write_bytes(b"")
    assert "2 written, 2 existed already." in run(*args)
    assert_same()
    assert manifest.read_text("utf-8").splitlines(keepends=True) == lines
    monkeypatch.delattr(batch, "_shared")  # no worker starts if every sheet is there
    assert "0 written, 4 existed already." in run(*args)


def test_a_manifest_from_elsewhere_is_no_manifest(desk: Path) -> None:
    manifest = Path("out", batch.MANIFEST)
    args = ("batch", POINT)
    run(*args)
    key = json.loads(manifest.read_text("utf-8"))["key"]
    Path("secret").write_bytes(b"")
    digest = hashlib.sha256(b"").hexdigest()
    for files in ("3", "[]", '{"k11-01.pdf": 1}', "[" * 5000, f'{{"../secret": "{digest}"}}'):
        manifest.write_text(f'{{"problem": "k11-01", "key": "{key}", "files": {files}}}\n', "utf-8")
        assert "1 written, 0 existed already." in run(*args)
    assert_same_sheet("k11-01.pdf")


def test_a_manifest_that_is_a_link_makes_no_file_elsewhere(desk: Path) -> None:
    Path("out").mkdir(exist_ok=True)
    Path("out", batch.MANIFEST).symlink_to(desk / "elsewhere")
    result = CliRunner().invoke(cli, ["batch", "ex3.toml", "--variant", "v0", "--lang", "en"])
    assert (result.exit_code, "a link leads to" in result.output) == (2, True), result.output
    assert not (desk / "elsewhere").exists()


def assert_same_sheet(name: str) -> None:
    assert (Path("own") / name).read_bytes() == (Path("out") / name).read_bytes(), name


def test_a_cluster_makes_the_same(desk: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed", reason="dask is absent: pip install 'dask[distributed]'")
    monkeypatch.setattr(batch, "_cluster", lambda *_: nullcontext(Here()))
    args = ("batch", "ex3.toml", POINT, "--keys", "--scheduler", "here")
    assert "4 written, 0 existed already." in run(*args)
    assert_same()


@pytest.mark.skipif(some(1, few=0) == 0, reason="takes ten seconds: with --thorough")
def test_a_killed_process_changes_no_byte(desk: Path) -> None:
    said = killed(["ex3.toml", POINT, "--keys"], desk)
    assert "killed" in said
    assert "4 written, 0 existed already." in said
    assert_same()


CLUSTER = """
import os, signal, sys, threading, time
from pathlib import Path

def kill(cluster):
    while not list(Path("out").glob("*.pdf")):
        time.sleep(0.01)
    os.kill([nanny.pid for nanny in cluster.workers.values()][0], signal.SIGKILL)
    print("killed", flush=True)

if __name__ == "__main__":
    from distributed import LocalCluster
    from distributed.security import Security
    from planmethod.cli import cli
    more = {"dashboard_address": None, "protocol": "tls", "security": Security()}
    with LocalCluster(n_workers=2, threads_per_worker=1, **more) as cluster:
        threading.Thread(target=kill, args=(cluster,), daemon=True).start()
        cli([*sys.argv[1:], "--scheduler", cluster.scheduler_address], standalone_mode=False)
"""
"""A cluster as docs/how-to/batch.md has it, which loses a worker at the first sheet."""


@pytest.mark.skipif(
    some(1, few=0) == 0 or shutil.which("openssl") is None, reason="takes ten seconds: --thorough"
)
def test_a_cluster_by_tls_that_loses_a_worker_makes_the_same(desk: Path) -> None:
    pytest.importorskip("distributed", reason="dask is absent: pip install 'dask[distributed]'")
    pair = "-keyout key.pem -out cert.pem"
    words = f"openssl req -x509 -newkey rsa:2048 -nodes -days 1 -subj /CN=here {pair}"
    subprocess.run(words.split(), check=True, capture_output=True)
    Path("program.py").write_text(CLUSTER)
    tls, pem = "DASK_DISTRIBUTED__COMM__TLS__", str(desk / "cert.pem")
    own = {f"{tls}{who}__CERT": pem for who in ("CLIENT", "SCHEDULER", "WORKER")}
    own |= {f"{tls}{who}__KEY": str(desk / "key.pem") for who in ("CLIENT", "SCHEDULER", "WORKER")}
    own |= {f"{tls}CA_FILE": pem, "DASK_DISTRIBUTED__COMM__REQUIRE_ENCRYPTION": "true"}
    done = subprocess.run(
        [sys.executable, "program.py", "batch", "ex3.toml", POINT, "--keys"],
        env={**os.environ, **own, "PYTHONPATH": str(ROOT)},
        capture_output=True,
        encoding="utf-8",
        timeout=300,
    )
    assert "4 written, 0 existed already." in done.stdout, done.stderr
    assert "killed" in done.stdout
    assert_same()


def test_without_dask_the_extra_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", None)
    result = CliRunner().invoke(cli, ["batch", POINT, "--scheduler", "tls://here:1"])
    assert result.exit_code == 2
    assert "pip install 'dask[distributed]'" in result.output
