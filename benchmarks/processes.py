"""Whole commands: cold and warm time, imports, memory."""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from benchmarks.scenes import MANY_LOADS
from planmethod.bench.measurements import Timing, clock
from planmethod.linkages.reading import part_of
from planmethod.note.wording import get_language
from planmethod.problem import load, template
from planmethod.render.backends import render
from planmethod.render.ink.drawing import Drawing
from planmethod.render.labels.place import _placed
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.render.sketch import VIEWS, sketch

ROOT = Path(__file__).parent.parent
"""Working directory of processes, where they find the package and the benchmarks."""

FORMATS = ("svg", "pdf", "png")

WATCHED = (
    "click", "numpy", "shapely", "svgwrite", "reportlab", "PIL", "matplotlib", "mpmath", "ezdxf",
)  # fmt: skip
"""Third parties whose import a command may have to pay for."""

YARDSTICKS = (
    "pass",
    "import click",
    "import numpy",
    "import numpy, click",
    "import numpy, shapely, svgwrite, click",
)
"""Programs that measure the cost of a process before any code of the package is loaded."""

COMMANDS = (
    ("--version", ()),
    ("--help", ()),
    ("structure --no-drawing", ()),
    ("solve", ()),
    ("solve --json", ()),
    ("solve --ask v_D", ()),
    ("protocol", ()),
    ("sheet --format svg", ("-o", "{out}")),
    ("sheet --format pdf", ("-o", "{out}")),
    ("sheet --format png", ("-o", "{out}")),
    ("sheet --format svg --phi 0:360:30", ("-o", "{out}")),
    ("sketch", ("-o", "{out}")),
)


LOADED = (
    ("solve --json, 360 loaded positions", 0.5, "press", ("solve", "--json", "--phi", "0:360:1")),
    (
        "sheet --layout forces-cycle, 36 positions",
        1.5,
        "press",
        ("sheet", "--layout", "forces-cycle", "--phi", "0:360:10", "-o", "{out}"),
    ),
    ("solve --json, 60 loads on a point", 1.0, "loads", ("solve", "--json")),
)
"""Commands on loaded mechanisms: a name, seconds that it may take, the problem, words."""


@dataclass(frozen=True, slots=True)
class Command:
    """Cost of one command.

    Attributes
    ----------
    cold : Timing or None
        Whole process, seconds.
    imports : tuple of str
        Third parties of `WATCHED` that it imported.
    modules : int
        Modules in memory when it ended.
    peak_mb : float
        Largest resident size, megabytes.
    """

    name: str
    cold: Timing | None
    imports: tuple[str, ...]
    modules: int
    peak_mb: float


def commands(*, runs: int = 5) -> list[Command]:
    """Measure commands on a slotted link, each in processes of its own, taking turns.

    First come the yardsticks, last those on loaded mechanisms.
    """
    with tempfile.TemporaryDirectory() as folder:
        problem = Path(folder) / "slotted-link.toml"
        problem.write_text(template("slotted-link"), encoding="utf-8")
        press, many = ROOT / "problems" / "press" / "press.toml", Path(folder) / "loads.toml"
        many.write_text(MANY_LOADS, encoding="utf-8")
        lines: list[tuple[str, list[str]]] = []
        for name, more in COMMANDS:
            words = name.split()
            target = [] if name.startswith("--") else [str(problem)]
            rest = [word.format(out=folder) for word in more]
            lines.append((name, [words[0], *target, *words[1:], *rest]))
        for name, _, which, loaded in LOADED:
            rest = [word.format(out=folder) for word in loaded[1:]]
            lines.append((name, [loaded[0], str(press if which == "press" else many), *rest]))
        plain = [[sys.executable, "-c", source] for source in YARDSTICKS]
        # The module is run as the installed script runs it.
        start = "import sys; from planmethod.__main__ import main; main()"
        whole = [[sys.executable, "-c", start, *arguments] for _, arguments in lines]
        timings = clock_processes([*plain, *whole], runs=runs)
        count = len(YARDSTICKS)
        found = [
            Command(source, timing, tuple(n for n in WATCHED if n in source), 0, 0.0)
            for source, timing in zip(YARDSTICKS, timings[:count], strict=True)
        ]
        for (name, arguments), timing in zip(lines, timings[count:], strict=True):
            imports, modules, peak = _looked_at(arguments)
            found.append(Command(f"planmethod {name}", timing, imports, modules, peak))
        return found


def _looked_at(arguments: list[str]) -> tuple[tuple[str, ...], int, float]:
    """Return the imports and the peak memory of one run of a command."""
    said = run_python(
        "import contextlib, io, sys\n"
        f"sys.argv = ['planmethod', *{arguments!r}]\n"
        "from planmethod.__main__ import main\n"
        "with contextlib.redirect_stdout(io.StringIO()):\n"
        "    try:\n"
        "        main()\n"
        "    except SystemExit:\n"
        "        pass\n"
        f"{PEAK}\n"
        f"print(*(name for name in {WATCHED!r} if name in sys.modules))\n"
        "print(len(sys.modules), peak)\n"
    )
    names, _, numbers = said.rpartition("\n") if "\n" in said else ("", "", said)
    modules, peak = numbers.split()
    return tuple(names.split()), int(modules), float(peak)


def warm_sheets() -> list[tuple[str, Timing, Timing]]:
    """Return (format, seconds to make, seconds to write) of sheets in a running process."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "slotted-link.toml"
        path.write_text(template("slotted-link"), encoding="utf-8")
        problem = load(path)
        again = partial(_sketched, path)
        redrawn = (
            "svg of sketch --watch",
            clock(again, enough=1.0, min_runs=3),
            clock(partial(render, again(), "svg"), enough=1.0, min_runs=3),
        )

    def drawn() -> list[Drawing]:
        _placed.cache_clear()  # else the letters would have their places already
        return kinematics_sheets(problem)

    make = clock(drawn, enough=2.0, min_runs=3)
    sheet = kinematics_sheets(problem)[0]
    return [
        *((f, make, clock(partial(render, sheet, f), enough=1.0, min_runs=3)) for f in FORMATS),
        redrawn,
    ]


def _sketched(path: Path) -> Drawing:
    """Read a file again and draw its sketch, as ``--watch`` does."""
    _placed.cache_clear()
    title, part = part_of(path, variant=None, views=VIEWS)
    return sketch(part, title, get_language("en"), [])


PEAK = (
    "from pathlib import Path\n"
    "status = Path('/proc/self/status')\n"
    "lines = status.read_text().splitlines() if status.exists() else []\n"
    "peak = max((int(s.split()[1]) / 1024 for s in lines if s.startswith('VmHWM')), default=0.0)"
)
"""Lines that find the peak of a process itself, MB, without memory from before its start."""

MEMORY = (
    ("interpreter and NumPy", "import numpy"),
    ("sweep of 10⁴ positions", "sweep(10_000)"),
    ("sweep of 10⁶ positions", "sweep(1_000_000)"),
    ("step by step, 10⁴ positions", "steps(10_000)"),
    ("step by step, 10⁵ positions", "steps(100_000)"),
)


def memory() -> list[tuple[str, float]]:
    """Return (subject, peak megabytes), each in a process of its own."""
    head = (
        "import numpy as np\n"
        "from benchmarks.scenes import slotted\n"
        "from planmethod.bench.measurements import turn\n"
        "def sweep(n):\n"
        "    from planmethod.solved.many.sweep import Sweep\n"
        "    Sweep(slotted()).run(turn(n))\n"
        "def steps(n):\n"
        "    from planmethod.solved.solution import Solution\n"
        "    Solution(slotted(), positions=turn(n)).points\n"
    )
    tail = f"{PEAK}\nprint(peak)\n"
    return [(name, float(run_python(f"{head}{act}\n{tail}"))) for name, act in MEMORY]


def clock_processes(commands: Sequence[Sequence[str]], *, runs: int = 5) -> list[Timing]:
    """Time whole processes, taking turns so that a slow moment falls on all of them.

    The first round warms the disk and lets Python cache compiled files, as for an installed
    package.
    """
    times: list[list[float]] = [[] for _ in commands]
    for turn in range(runs + 1):
        for mine, command in zip(times, commands, strict=True):
            start = time.perf_counter()
            subprocess.run(command, check=True, capture_output=True, env=_environment(), cwd=ROOT)
            if turn:
                mine.append(time.perf_counter() - start)
    return [Timing(statistics.median(t), min(t), max(t), len(t)) for t in times]


def _environment() -> dict[str, str]:
    kept = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    return {**kept, "PYTHONIOENCODING": "utf-8"}


def run_python(source: str) -> str:
    """Run a few lines in a fresh interpreter and return what they print."""
    env = _environment()
    done = subprocess.run(
        [sys.executable, "-c", source],
        check=True,
        capture_output=True,
        env=env,
        encoding="utf-8",
        cwd=ROOT,
    )
    return done.stdout.strip()
