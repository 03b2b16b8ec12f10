"""Many positions and variants: growth of cost, gain of processes, cost of a kill."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.bounds import Bound, bounds_table
from benchmarks.processes import PEAK, ROOT, run_python
from planmethod.bench.report import Table, load, span, table

POSITIONS = (100, 1000, 10_000, 100_000, 1_000_000)
VARIANTS = (10, 100, 1000, 10_000)
COMMANDS = {
    "solve --json": ("solve", "--all-variants", "--json"),
    "solve --npz": ("solve", "--all-variants", "--npz", "all.npz"),
    "check --key": ("check", "--key", "--json"),
}
"""Commands that run over variants, with their arguments."""

MOST_SECONDS = {1000: 3.0, 10_000: 25.0}
"""Limits by number of variants, for whole processes."""

CANDIDATES = (1000, 10_000)
"""Candidates of which `planmethod variants` chooses `CHOSEN` variants."""

CHOSEN = 200

MOST_SECONDS_OF_CHOICE = {10_000: 10.0}
"""Limits by number of candidates, for whole processes."""

MOST_MEGABYTES = 300.0
"""More for the most variants than for the fewest."""

DRAWN = 300
"""Variants whose sheets are drawn."""

AT_ONCE = 250
"""Variants of a file."""

LINEAR, LINEAR_VARIANTS = 1.1, 1.05
"""Exponents up to which cost is called linear."""

SENT = 100
"""Variants of the batch that loses a process."""

KILLED = """
import multiprocessing, os, signal, sys, threading, time
from pathlib import Path

def kill(out):
    while not list(out.glob("*.pdf")):
        time.sleep(0.01)
    os.kill(multiprocessing.active_children()[0].pid, signal.SIGKILL)
    print("killed", flush=True)

if __name__ == "__main__":
    from planmethod.cli import cli
    threading.Thread(target=kill, args=(Path("out"),), daemon=True).start()
    cli([*sys.argv[1:], "--jobs", "2"], standalone_mode=False)
"""
"""A batch that loses a process as soon as the first sheet is in the folder ``out``."""


@dataclass(frozen=True, slots=True)
class Grown:
    """Cost of ``count`` positions or variants: seconds, and megabytes more than for few of them."""

    count: int
    seconds: float
    peak_mb: float


def by_positions(counts: Sequence[int]) -> list[Grown]:
    """Measure sweeps of a slotted link, results and all, each in a process of its own."""
    found = []
    for count in counts:
        said = run_python(
            "import time\n"
            "from benchmarks.scenes import slotted\n"
            "from planmethod.bench.measurements import turn\n"
            "from planmethod.solved.many.sweep import Sweep\n"
            f"sweep, at, times = Sweep(slotted()), turn({count}), []\n"
            "for _ in range(5):\n"
            "    start = time.perf_counter()\n"
            "    sweep.run(at)\n"
            "    times.append(time.perf_counter() - start)\n"
            f"{PEAK}\n"
            "print(min(times), peak)\n"
        )
        found.append(Grown(count, *map(float, said.split())))
    return found


def by_variants(command: str, counts: Sequence[int], folder: Path) -> list[Grown]:
    """Measure one of the `COMMANDS` by the number of variants of a table, as whole processes."""
    found = []
    for count in counts:
        first, *others = COMMANDS[command]
        seconds, peak = _run([first, tabled(count, folder), *others], folder)
        found.append(Grown(count, seconds, peak))
    return found


def by_candidates(counts: Sequence[int], folder: Path) -> list[Grown]:
    """Measure the choice of variants by the number of candidates, as whole processes."""
    found, problem = [], str(ROOT / "problems" / "linkages" / "ex3.toml")
    for count in counts:
        words = ["variants", problem, "--count", str(CHOSEN), "--tries", str(count)]
        # Exit code 1: fewer variants were found.
        seconds, peak = _run([*words, "-o", "chosen.csv"], folder, codes=(0, 1))
        found.append(Grown(count, seconds, peak))
    return found


def tabled(count: int, folder: Path) -> str:
    """Write an example with a table of ``count`` variants, and return the name of its file."""
    text = (ROOT / "problems" / "linkages" / "ex3.toml").read_text("utf-8")
    off, rows = np.random.default_rng(1), ["variant;AB;CD;DE;phi"]
    for number in range(1, count + 1):
        a, c, d = (np.array([0.064, 0.22, 0.18]) * off.uniform(0.97, 1.03, 3)).tolist()
        rows.append(f"{number};{a:.5g};{c:.5g};{d:.5g};{off.uniform(0.0, 40.0):.4g}")
    name = f"table{count}"
    (folder / f"{name}.csv").write_text("\n".join(rows) + "\n", "utf-8")
    (folder / f"{name}.toml").write_text(f'variants = "{name}.csv"\n{text}', "utf-8")
    return f"{name}.toml"


def variants(count: int, folder: Path) -> list[str]:
    """Write files with ``count`` variants of an example in all, and return their names."""
    text = (ROOT / "problems" / "linkages" / "ex3.toml").read_text("utf-8")
    names = []
    for first in range(0, count, AT_ONCE):
        own = range(first, min(first + AT_ONCE, count))
        more = "".join(f"[variants.v{n}]\ndriver.phi = {20 + 60 * n / count!r}\n" for n in own)
        names.append(f"group{first}.toml")
        (folder / names[-1]).write_text(f"{text}\n{more}", "utf-8")
    return names


def _run(
    words: Sequence[str], folder: Path, *, codes: Collection[int] = (0,)
) -> tuple[float, float]:
    """Run a command in a folder and return its seconds and its peak, MB."""
    start = (
        "import sys\n"
        "from planmethod.__main__ import main\n"
        "code = 0\n"
        "try:\n"
        "    main()\n"
        "except SystemExit as end:\n"
        "    code = end.code\n"
        f"{PEAK}\n"
        "Path('peak').write_text(str(peak))\n"
        "sys.exit(code)"
    )
    began = time.perf_counter()
    with (folder / "said").open("wb") as said:
        done = subprocess.run(
            [sys.executable, "-c", start, *words],
            cwd=folder,
            env=_environment(),
            stdout=said,
            check=False,
        )
    if done.returncode not in codes:
        done.check_returncode()
    return time.perf_counter() - began, float((folder / "peak").read_text())


def _environment() -> dict[str, str]:
    return {**os.environ, "PYTHONPATH": str(ROOT), "PYTHONIOENCODING": "utf-8"}


def exponent(grown: Sequence[Grown], cost: str) -> float:
    """Return the exponent of growth beyond the cost of the first; 0 if it hardly grows."""
    first, *more = grown
    always = getattr(first, cost)
    costs = {one.count - first.count: getattr(one, cost) - always for one in more}
    told = {count: own for count, own in costs.items() if own > 0.1 * always}
    if len(told) < 2:
        return 0.0
    return float(np.polyfit(np.log([*told]), np.log([*told.values()]), 1)[0])


def in_processes(count: int, folder: Path) -> tuple[float, float, bool]:
    """Return seconds of PDF sheets of variants by one and two processes; whether these agree."""
    one = two = 0.0
    for name in variants(count, folder):  # taking turns
        words = ["sheet", name, "--all-variants", "--format", "pdf"]
        one += _run([*words, "-o", "own"], folder)[0]
        two += _run([*words, "-o", "two", "--jobs", "2"], folder)[0]
    return one, two, alike(folder / "own", folder / "two")


def alike(one: Path, other: Path) -> bool:
    """Return whether every sheet of a folder is in another one, byte for byte."""
    names = [path.name for path in one.glob("*.pdf")]
    return all((other / name).read_bytes() == (one / name).read_bytes() for name in names)


def killed(words: Sequence[str], folder: Path) -> str:
    """Make a batch in ``out`` by two processes, one of which is lost; return its output."""
    program = folder / "program.py"
    program.write_text(KILLED)
    done = subprocess.run(
        [sys.executable, program.name, "batch", *words],
        cwd=folder,
        env=_environment(),
        capture_output=True,
        encoding="utf-8",
        timeout=900,
        check=True,
    )
    return done.stdout


def many_section(*, quick: bool) -> Table:
    """Measure all and return the section."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        sizes = VARIANTS[:3] if quick else VARIANTS
        grown = [("positions", by_positions(POSITIONS[:4] if quick else POSITIONS))]
        grown += [(f"variants, {what}", by_variants(what, sizes, folder)) for what in COMMANDS]
        chosen = by_candidates(CANDIDATES[:1] if quick else CANDIDATES, folder)
        count = min(DRAWN, sizes[-1])
        one, two, same = in_processes(count, folder)
        held = [Bound(f"speed of --jobs 2, {count} variants to PDF", one / two, 1.8, True)]
        for what, rows in grown:
            most = LINEAR if what == "positions" else LINEAR_VARIANTS
            held += [
                Bound(f"{what}: exponent of {cost.partition('_')[0]}", exponent(rows, cost), most)
                for cost in ("seconds", "peak_mb")
            ]
            if what == "positions":
                continue
            held += [
                Bound(f"{what}: seconds of {one.count}", one.seconds, MOST_SECONDS[one.count])
                for one in rows
                if one.count in MOST_SECONDS
            ]
            more = rows[-1].peak_mb - rows[0].peak_mb
            held.append(Bound(f"{what}: MB more than of {rows[0].count}", more, MOST_MEGABYTES))
        held += [
            Bound(f"candidates, variants: seconds of {one.count}", one.seconds, limit)
            for one in chosen
            if (limit := MOST_SECONDS_OF_CHOICE.get(one.count)) is not None
        ]
        grown.append(("candidates, variants", chosen))
        held.append(Bound("files of --jobs 2 that differ", 1.0 - same, 0.0))
        lost = _lost(count, folder)
    return [
        "## Many positions, many variants",
        "",
        "Sweeps of a slotted link in arrays of their own; `solve --json`, `solve --npz` and "
        "`check --key` of all variants of a table, "
        f"`variants --count {CHOSEN}` by its candidates, whole processes; "
        "with the peak of each. The "
        "exponent is that of the cost beyond the first row. "
        f"Then sheets of {count} variants as PDF by one process ({span(one)}), two ({span(two)})"
        f"{lost[0]}; {load()}.",
        "",
        *table(
            ("what", "number", "time", "for one", "peak"),
            [
                (
                    what,
                    str(g.count),
                    span(g.seconds),
                    span(g.seconds / g.count),
                    f"{g.peak_mb:.0f} MB",
                )
                for what, rows in grown
                for g in rows
            ],
        ),
        *bounds_table([*held, *lost[1]]),
    ]


def _lost(count: int, folder: Path) -> tuple[str, list[Bound]]:
    """Return the sentence on a batch that loses a worker, and its bound."""
    sent = min(count, SENT)
    said = killed([*variants(sent, folder), "--format", "pdf"], folder)
    _run(
        ["sheet", *variants(sent, folder), "--all-variants", "--format", "pdf", "-o", "few"], folder
    )
    differ = 1.0 - ("killed" in said and alike(folder / "few", folder / "out"))
    return (
        f", and {sent} of them by a batch of two processes, one of them killed at the first sheet",
        [Bound("files of the batch that differ", differ, 0.0)],
    )
