"""``python -m benchmarks.attack.kills``: commands killed in the middle, and run again.

Each command is run once to its end; then again and again in folders of their own, where it is
killed with its processes after a part of its time that is drawn by chance. What is there then must
be files of the whole run, byte by byte, and after one more run all of them, and nothing else.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

from benchmarks.attack.mutants import ROOT

PROBLEMS = ROOT / "problems"
COMMANDS = (
    ("check", "linkages/ex3.toml", "groups/ex3.csv", "--gradebook", "--jobs", "2"),
    ("project", "levers/task-13.toml", "--parts", "kinematics", "--format", "svg,pdf"),
    ("batch", "levers/task-43.toml", "--keys", "--jobs", "2"),
)
RECORDS = ("run.json", "batch.jsonl")
"""Files that grow: they list the files written so far, in complete lines or as a whole."""


def files_of(folder: Path) -> dict[str, bytes]:
    """Return the contents of a folder's files by relative path."""
    return {
        path.relative_to(folder).as_posix(): path.read_bytes()
        for path in sorted(folder.rglob("*"))
        if path.is_file()
    }


def run(command: Sequence[str], out: Path, killed_after: float | None = None) -> float:
    """Run a command to its end, or kill it and its processes; return the seconds of the clock."""
    words = [str(PROBLEMS / word) if "." in word and "/" in word else word for word in command]
    began = time.monotonic()
    process = subprocess.Popen(
        [sys.executable, "-m", "planmethod", *words, "-o", str(out)],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
    with contextlib.suppress(subprocess.TimeoutExpired):
        process.wait(killed_after)
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
    return time.monotonic() - began


def faults(found: dict[str, bytes], whole: dict[str, bytes], *, ended: bool) -> Iterator[str]:
    """Yield the files of a folder that differ from those of the whole run."""
    for name, data in found.items():
        base = name.rpartition("/")[2]
        if base.startswith(".planmethod-"):
            if ended:
                yield f"{name} was left"
        elif name not in whole:
            yield f"{name} is none of the files"
        elif base in RECORDS and not ended:
            lines = [line for line in data.split(b"\n")[:-1] if line]
            for text in lines if base.endswith("l") else [data]:
                with contextlib.suppress(ValueError):
                    json.loads(text)
                    continue
                yield f"{name} is no record"
        elif base not in RECORDS and data != whole[name]:
            yield f"{name} is another: {len(data)} bytes of {len(whole[name])}"
    if ended:
        yield from (f"{name} is missing" for name in whole if name not in found)


def killed(command: Sequence[str], times: int, luck: random.Random, place: Path) -> Iterator[str]:
    """Kill a command ``times`` times; yield the row of the table, then the incomplete files."""
    run(command, place / "first")  # from now on compiled and cached files exist
    seconds = run(command, place / "whole")
    whole = files_of(place / "whole")
    middle, there, bad = 0, [], []
    for number in range(times):
        out = place / str(number)
        run(command, out, luck.uniform(0.1, 1.0) * seconds)
        found = files_of(out)
        middle += len(found) < len(whole)
        there.append(len(found))
        bad += [f"{number}: {one}" for one in faults(found, whole, ended=False)]
        run(command, out)
        bad += [f"{number}, again: {one}" for one in faults(files_of(out), whole, ended=True)]
    files = f"{min(there)} to {max(there)} of {len(whole)}"
    yield f"| {command[0]} | {times} | {middle} | {files} | {len(bad)} |"
    yield from bad


def main() -> None:
    """Kill every command ``--times`` times; exit code 1 if a file was left incomplete."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.attack.kills", description=__doc__)
    parser.add_argument("--times", type=int, default=20, help="of each command")
    parser.add_argument("--seed", type=int, default=0)
    told = parser.parse_args()
    luck, fell = random.Random(told.seed), False
    print("| command | killed | in the middle | files then | in pieces |")
    print("| --- | ---: | ---: | ---: | ---: |", flush=True)
    for command in COMMANDS:
        with tempfile.TemporaryDirectory() as name:
            row, *bad = killed(command, told.times, luck, Path(name))
            print(row, *bad[:20], sep="\n", flush=True)
            fell = fell or bool(bad)
    sys.exit(fell)


if __name__ == "__main__":
    main()
