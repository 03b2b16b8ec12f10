"""Problems shared among processes: the same outcome, and the message when one is killed."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import LoadedProblem, ProblemChoice, cli, in_processes, run_steps
from waiting import wait_until
from worked import PROBLEMS, ROOT, path_of

EX3 = path_of("linkages/ex3").read_text("utf-8")
VARIANTS = """
[variants.near]
driver.phi = 25
[variants.far]
links.4.DE = 0.01
"""
"""The far one cannot be assembled."""


@pytest.fixture
def files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """A linkage whose second variant fails, a file that is not there, a moving point."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "ex3.toml").write_text(EX3 + VARIANTS, "utf-8")
    return ["ex3.toml", "none.toml", str(PROBLEMS / "point/k11-01.toml")]


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, args)


def outcome(folder: Path, *args: str) -> tuple[int, str, str, dict[str, bytes]]:
    done = run(*args)
    made = {path.name: path.read_bytes() for path in sorted(folder.iterdir())}
    return done.exit_code, done.stdout, done.stderr, made


@pytest.mark.parametrize(
    "words", ["sheet --format pdf -o .", "solve --json", "lint --json", "check --key -o ."]
)
def test_two_processes_do_the_same_to_the_byte(
    words: str, files: list[str], tmp_path: Path
) -> None:
    command, *rest = words.split()
    args = [command, *files, "--all-variants", *rest]
    one = outcome(tmp_path, *args)
    code, said, told, made = outcome(tmp_path, *args, "--jobs", "2")
    assert (code, said, told, made) == one
    assert code == 3
    assert "none.toml" in told
    assert "far" in told or "ex3" in told
    assert said


def test_rows_of_two_processes_are_the_same(files: list[str]) -> None:
    args = ("solve", files[0], "--all-variants", "--csv")
    one, two = run(*args), run(*args, "--jobs", "2")
    assert two.stdout == one.stdout
    assert one.stdout.count("\n") == 2


# Killed and interrupted --------------------------------------------------------------------------


def killed_by_some(number: int, folder: Path) -> int:
    """Return a square; 2 kills the process always, 5 once."""
    flag = folder / str(number)
    if number == 2 or (number == 5 and not flag.exists()):
        flag.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return number**2


def slow(number: int, folder: Path) -> int:
    """Never end but for 0; leave a file only while at work."""
    at_work = folder / str(number)
    try:
        at_work.touch()
        while number:
            time.sleep(60.0)
    finally:
        at_work.unlink(missing_ok=True)
    return number


def test_a_killed_process_loses_no_other_problem(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    outcomes = list(in_processes(partial(killed_by_some, folder=tmp_path), range(8), 2))
    found = [None if outcome is None else outcome.value for outcome in outcomes]
    assert found == [None if number == 2 else number**2 for number in range(8)]
    assert (tmp_path / "5").exists()
    assert "a process was killed" in capsys.readouterr().err


def test_stopping_early_leaves_no_process_and_no_file(tmp_path: Path) -> None:
    before = multiprocessing.active_children()
    outcomes = in_processes(partial(slow, folder=tmp_path), range(4), 2)
    first = next(outcomes)
    assert first is not None
    assert first.value == 0
    wait_until(lambda: any(tmp_path.iterdir()))
    outcomes.close()  # type: ignore[attr-defined]
    assert multiprocessing.active_children() == before
    assert not any(tmp_path.iterdir())


@pytest.mark.skipif(sys.platform == "win32", reason="there a process is not killed by a signal")
def test_processes_end_with_the_one_that_gave_them_work(tmp_path: Path) -> None:
    code = (
        "from functools import partial\n"
        "from pathlib import Path\n"
        "from commands.test_jobs import slow\n"
        "from planmethod.commands.processes import in_processes\n"
        f"list(in_processes(partial(slow, folder=Path({str(tmp_path)!r})), range(1, 4), 2))\n"
    )
    paths = os.pathsep.join([str(ROOT / "tests"), str(ROOT)])
    giver = subprocess.Popen([sys.executable, "-c", code], env={**os.environ, "PYTHONPATH": paths})
    wait_until(lambda: len(list(tmp_path.iterdir())) == 2)
    giver.kill()
    giver.wait()
    wait_until(lambda: not any(tmp_path.iterdir()))


def test_an_interrupt_is_reported_with_the_work_done(
    files: list[str], capsys: pytest.CaptureFixture[str]
) -> None:
    def steps(todo: list[LoadedProblem]) -> Iterator[Callable[[], None]]:
        yield lambda: None
        raise KeyboardInterrupt

    with pytest.raises(SystemExit) as end:
        run_steps(ProblemChoice(problems=(Path(files[0]),), all_variants=True), steps)
    assert end.value.code == 130
    assert "Stopped: 1 of 2 problems are done" in capsys.readouterr().err
