"""``python -m benchmarks.attack``: hostile input at every entry point of the program.

Files are generated from seeds, one after another, and given to commands in processes with a memory
limit and, for every file, a limit of processor time. Failing files are kept in a folder with their
command line. The number of a file is its seed: ``--only 1234`` runs it again.
"""

from __future__ import annotations

import argparse
import contextlib
import io
import multiprocessing
import os
import random
import signal
import sys
import tempfile
import time
import traceback
import warnings
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing.connection import Connection
from pathlib import Path

from benchmarks.attack import mutants
from benchmarks.attack.patterns import LENGTH, patterns, slow

SECONDS, MEGABYTES, OWN = 5.0, 500.0, 100.0
"""Processor time and memory that one file may take."""
HUNG = 100.0
"""Wall-clock seconds after which a silent process counts as hung in C, however busy it is."""

CHUNK = 250
"""Files that one process is given."""

EX3 = str(mutants.ROOT / "problems" / "linkages" / "ex3.toml")

Made = tuple[list[str], dict[str, bytes], dict[str, str]]
"""Words of a command, files by name, variables of the environment."""


def problem(seed: int) -> Made:
    """Return a command on a problem file."""
    luck = random.Random(seed)
    data = mutants.problem(luck)
    commands = ["solve"] * 6 + ["sketch"] * 3 + ["solve --json", "structure --no-drawing", "audit"]
    commands += ["protocol", "check --key", "form", "live"] if luck.random() < 0.3 else []
    commands += ["sheet --format svg", "lint", "project", "note --format docx"] * (
        luck.random() < 0.02
    )
    chosen, *rest = luck.choice(commands).split()
    return [chosen, "p.toml", *rest, *_out(chosen)], {"p.toml": data}, {}


def _out(command: str) -> list[str]:
    return [] if command in ("solve", "structure", "audit", "protocol", "lint") else ["-o", "out"]


def work(seed: int) -> Made:
    """Return the check of a file of works."""
    ending, data = mutants.work(random.Random(seed))
    return ["check", EX3, f"w.{ending}", "--json"], {f"w.{ending}": data}, {}


def group(seed: int) -> Made:
    """Return the check of several files of works, whose pages are written."""
    luck = random.Random(seed)
    files = {"a.csv": mutants.answers(luck)}
    if luck.random() < 0.3:
        ending, files["w.csv"] = mutants.work(luck)
        files[f"w.{ending}"] = files.pop("w.csv")
    more = luck.choice(([], ["--gradebook"], ["--anonymize", "--salt", "x"], ["--jobs", "1"]))
    return ["check", EX3, *files, "-o", "out", *more], files, {}


def drawing(seed: int) -> Made:
    """Return the check of a drawing."""
    ending, data = mutants.drawing(random.Random(seed))
    return ["check", EX3, f"w.{ending}", "--json"], {f"w.{ending}": data}, {}


def pattern(seed: int) -> Made:
    """Return a command with a template of Word, or with a layout."""
    luck = random.Random(seed)
    if luck.random() < 0.5:
        short = str(mutants.ROOT / "problems" / "linkages" / "2.1.4.toml")
        words = ["note", short, "--format", "docx", "--template", "t.docx", "-o", "out"]
        return words, {"t.docx": mutants.template(luck)}, {}
    words = ["sheet", EX3, "--layout", "l.toml", "--format", "svg", "-o", "out"]
    return words, {"l.toml": mutants.other("layout", luck)}, {}


def department(seed: int) -> Made:
    """Return a command with settings, a config file, or with odd numbers."""
    luck = random.Random(seed)
    kind = luck.choice(("settings", "config", "words"))
    if kind == "words":
        return mutants.words(luck), {}, {}
    data = mutants.other(kind, luck)
    if kind == "settings":
        return ["check", EX3, "w.csv", "--settings", "s.toml", "--json"], {
            "s.toml": data, "w.csv": b"student;v B\nA;3\n",
        }, {}  # fmt: skip
    return ["sketch", EX3, "-o", "out"], {"planmethod/config.toml": data}, {"XDG_CONFIG_HOME": "."}


DOORS: dict[str, Callable[[int], Made]] = {
    "problem files": problem,
    "works": work,
    "groups of works": group,
    "drawings": drawing,
    "templates, layouts": pattern,
    "settings, config, numbers": department,
}

FILES = {"problem files": 20_000, "works": 3000, "groups of works": 2000, "drawings": 1000}
"""Number of files for an entry point. Default: 500."""


@dataclass
class Found:
    """Outcome of the files given to an entry point."""

    door: str
    files: int = 0
    codes: Counter[object] = field(default_factory=Counter)
    slowest: float = 0.0
    largest: float = 0.0
    bad: list[str] = field(default_factory=list)


class _LateError(BaseException):
    """A file exceeded its processor time; no handler of the program catches this."""


def attempt(made: Made, folder: Path) -> tuple[object, float]:
    """Run a command in this process, in a folder; return its exit code and processor time.

    After an internal error, return its traceback instead of the code.
    """
    from planmethod.__main__ import main

    words, files, variables = made
    for name, data in files.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(data)
    os.environ.pop("XDG_CONFIG_HOME", None)
    os.environ.update(variables)
    os.chdir(folder)
    sys.argv = ["planmethod", *words]
    code: object = None
    began, raw = time.process_time(), io.BytesIO()
    said = io.TextIOWrapper(raw, "utf-8", errors="replace", write_through=True)
    with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
        try:
            signal.setitimer(signal.ITIMER_VIRTUAL, SECONDS)
            main()
            code = 0
        except SystemExit as end:
            code = end.code
        except _LateError:
            code = f"over {SECONDS:g} s"
        except BaseException:  # an error that no handler caught
            code = traceback.format_exc(limit=-3)
        finally:
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    told = raw.getvalue().decode("utf-8", "replace")
    if code not in (0, 1, 2, 3, 4) or "Traceback" in told:
        code = f"{code}: {told[-300:].strip()}"
    elif any((ord(c) < 32 and c not in "\n\t\r") or c in "\x7f\x9b\u202e" for c in told):
        code = f"raw characters: {told[-300:]!r}"
    return code, time.process_time() - began


def _late(*_: object) -> None:
    raise _LateError


def _child(door: str, seeds: Sequence[int], pipe: Connection, place: Path) -> None:
    import resource

    signal.signal(signal.SIGVTALRM, _late)
    resource.setrlimit(resource.RLIMIT_AS, (4 * 2**30, 4 * 2**30))
    warnings.simplefilter("ignore")
    # Memory kept by the parent process does not count for the file.
    before = max(0.0, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024 - OWN)
    home = Path.cwd()
    for seed in seeds:
        folder = place / str(seed)
        folder.mkdir()
        pipe.send((seed, None, 0.0, 0.0))
        code, seconds = attempt(DOORS[door](seed), folder)
        os.chdir(home)
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024 - before
        pipe.send((seed, code, seconds, peak))
        if peak > MEGABYTES:
            break  # of the next file it would not be known
        for path in sorted(folder.rglob("*"), reverse=True):
            path.rmdir() if path.is_dir() and not path.is_symlink() else path.unlink()
        folder.rmdir()
    pipe.close()
    os._exit(0)


def attack(door: str, seeds: Sequence[int], *, jobs: int = 1) -> Found:
    """Give files to an entry point and return the outcome."""
    found = Found(door)
    left = [list(seeds[start : start + CHUNK]) for start in range(0, len(seeds), CHUNK)]
    running: list[tuple[Iterator[None], list[int]]] = []
    while left or running:
        while left and len(running) < jobs:
            chunk = left.pop(0)
            running.append((_within(door, chunk, found), chunk))
        for one in list(running):
            try:
                next(one[0])
            except StopIteration:
                running.remove(one)
                if one[1]:
                    left.append(one[1])
    return found


def _within(door: str, seeds: list[int], found: Found) -> Iterator[None]:
    """Run a process in a folder that goes with it, however it ends."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as name:
        yield from _watched(door, seeds, found, Path(name))


def _watched(door: str, seeds: list[int], found: Found, place: Path) -> Iterator[None]:
    """Run a process over files; those that are done are taken from the list."""
    context = multiprocessing.get_context("fork")
    ours, theirs = context.Pipe(duplex=False)
    process = context.Process(target=_child, args=(door, seeds, theirs, place))
    process.start()
    theirs.close()
    at_work: int | None = None
    began = time.monotonic()
    while True:
        try:
            if not ours.poll(0.2):
                if time.monotonic() - began > HUNG and at_work is not None:
                    process.kill()  # hung in C
                yield
                continue
            seed, code, seconds, peak = ours.recv()
        except (EOFError, OSError):
            break
        began = time.monotonic()
        at_work = seed
        if code is None:
            continue
        at_work = None
        seeds.remove(seed)
        _count(found, seed, code, seconds, peak)
    process.join()
    if at_work is not None:
        seeds.remove(at_work)
        _count(found, at_work, f"killed ({process.exitcode})", 0.0, 0.0)


def _count(found: Found, seed: int, code: object, seconds: float, peak: float) -> None:
    found.files += 1
    found.slowest, found.largest = max(found.slowest, seconds), max(found.largest, peak)
    found.codes[code if isinstance(code, int) else "bad"] += 1
    if not isinstance(code, int):
        found.bad.append(f"{seed}: {code}")
    elif peak > MEGABYTES:
        found.bad.append(f"{seed}: {peak:.0f} MB")


def row(found: Found) -> str:
    """Return a row of the table of the report."""
    codes = ", ".join(f"{code}: {n}" for code, n in sorted(found.codes.items(), key=str))
    numbers = f"{found.slowest:.1f} s | {found.largest:.0f} MB | {len(found.bad)}"
    return f"| {found.door} | {found.files} | {codes} | {numbers} |"


def main() -> None:
    """Attack every entry point and print the table; exit code 1 if a file failed."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.attack", description=__doc__)
    parser.add_argument("--door", choices=DOORS, action="append", help="these alone")
    parser.add_argument("--files", type=int, help="how many, for each door")
    parser.add_argument("--first", type=int, default=0, help="first seed")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--only", type=int, help="one seed, at every door, with what it says")
    told = parser.parse_args()
    if told.only is not None:
        for door, make in DOORS.items():
            folder = Path(tempfile.mkdtemp(prefix="attack-"))
            signal.signal(signal.SIGVTALRM, _late)
            print(door, make(told.only)[0], folder, *attempt(make(told.only), folder))
        return
    import planmethod.cli  # noqa: F401 - once, before the processes

    print(
        "| door | files | exit codes | slowest | largest | bad |",
        "| --- | ---: | --- | ---: | ---: | ---: |",
        sep="\n",
    )
    fell = False
    for door in told.door or DOORS:
        count = FILES.get(door, 500) if told.files is None else told.files
        found = attack(door, range(told.first, told.first + count), jobs=told.jobs)
        print(row(found), *found.bad[:20], sep="\n", flush=True)
        fell = fell or bool(found.bad)
    bad = [
        f"{where}: {p!r} on {text!r}" for where, p, w in patterns() if (text := slow(p, w, LENGTH))
    ]
    print(f"| regular expressions | {len(list(patterns()))} | | | | {len(bad)} |", *bad, sep="\n")
    sys.exit(bool(fell or bad))


if __name__ == "__main__":
    main()
