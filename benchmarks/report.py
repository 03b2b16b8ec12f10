"""The document of the benchmark: every table with the command that makes it."""

from __future__ import annotations

import platform
import subprocess
from collections.abc import Sequence
from functools import cached_property
from pathlib import Path

import numpy as np

from benchmarks import bounds, growth, processes, rivals
from benchmarks.figure import draw
from benchmarks.many import many_section
from benchmarks.peers import PEERS, missing
from benchmarks.scenes import FOURBAR_ROWS, fourbar, slotted
from planmethod.bench import measurements
from planmethod.bench.measurements import Timing
from planmethod.bench.report import Table, load, number, span, speed_section, table

NAME = "speed-and-error"


def _rate(timing: Timing, count: int) -> str:
    rate = count / timing.median
    return f"{span(timing.median)} ({rate / 1e6:.3g} M/s)"


def machine() -> str:
    """Return the machine on which the figures were measured."""
    name = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        models = [s for s in info.read_text("utf-8").splitlines() if s.startswith("model name")]
        name = models[0].partition(":")[2].strip() if models else name
    return (
        f"{name}, {platform.system()}, Python {platform.python_version()}, NumPy {np.__version__}"
    )


def compiler() -> str:
    """Return the version of the C compiler that the C loops are made with, if there is one."""
    try:
        done = subprocess.run(["cc", "--version"], capture_output=True, check=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return ""
    return done.stdout.splitlines()[0]


# Sections ---------------------------------------------------------------------------------------


def peers_ran() -> str:
    """Return how many of the peers ran beside the rows of a table."""
    lost = len(missing())
    return f"{PEERS - lost} of {PEERS} peers"


def rivals_section(compared: Sequence[rivals.Rival]) -> Table:
    """Return the table of the four-bar: this package, C, pylinkage."""
    sizes = list(compared[0].seconds)
    rows = []
    for rival in compared:
        worst = max(rival.error.values(), default=0.0)
        rows.append(
            (
                rival.name,
                *(_rate(rival.seconds[n], n) for n in sizes),
                number(worst) if rival.error else "—",
                peers_ran(),
            )
        )
    ours = compared[0]
    ratios = [
        (
            other.name,
            *(f"{other.seconds[n].median / ours.seconds[n].median:.2g}" for n in sizes),
        )
        for other in compared[1:]
    ]
    header = [f"N = {n:,}".replace(",", " ") for n in sizes]
    notes = [f"- {rival.name}: {rival.computes}." for rival in compared]
    absent = missing()
    if absent:
        notes += ["", "Not run: " + " ".join(absent)]
    return [
        "## One four-bar, with peers",
        "",
        "Warm, one core, medians, all of them taking turns in one run; every answer goes to a "
        "buffer that was there before, except where a peer cannot take one. The error is the "
        "largest over the three sizes.",
        "",
        *table(("who", *header, "largest error", "beside"), rows),
        "",
        *notes,
        "",
        "Time over that of the sweep (above 1: slower):",
        "",
        *table(("who", *header), ratios),
    ]


def growth_section(
    positions: Sequence[tuple[int, float]],
    links: Sequence[growth.Chain],
    others: Sequence[growth.Cost] = (),
) -> Table:
    """Return cost against the number of positions, of links and of all else."""
    return [
        "## Cost against size",
        "",
        "A sweep of a slotted link, everything asked, by number of positions:",
        "",
        *table(
            ("positions", "time", "for a position"),
            [(f"{n:,}".replace(",", " "), span(s), span(s / n)) for n, s in positions],
        ),
        "",
        "A chain of dyads, everything asked, by number of moving links; NumPy's blocks, time of "
        f"the processor, medians; {load()}. To prepare is to analyse the structure, choose the "
        "closings, plan the construction and compile it, once. *At hand* are the numbers of a "
        "position that are in use at a time: a buffer is given back when its last reader has run, "
        "and a group is run whole before the next one.",
        "",
        *table(
            (
                "links", "steps", "at hand", "to prepare", "one position", "10⁴ positions",
                "for a position and link",
            ),
            [
                (
                    str(one.links), str(one.steps), str(one.live), span(one.ready),
                    span(one.one), span(one.many), span(one.each),
                )
                for one in links
            ],
        ),
        *bounds.bounds_table(growth.bounds_of_links(links)),
        *_others(others),
    ]  # fmt: skip


def _others(found: Sequence[growth.Cost]) -> Table:
    """Return the cost of loads, wheels and answers."""
    if not found:
        return []
    return [
        "",
        "Loads on a point of a six-link mechanism, the forces in all positions; wheels in a row, "
        "their record; honest works of one task, checked:",
        "",
        *table(
            ("what", "number", "time", "for one"),
            [
                (one.what, str(one.number), span(one.seconds), span(one.seconds / one.number))
                for one in found
            ],
        ),
        *bounds.bounds_table(growth.bounds_of_costs(found)),
    ]


def scenes_section(scenes: Sequence[tuple[str, int, int, float, float]]) -> Table:
    """Return the saving of smaller requests."""
    return [
        "## Only what a scene needs",
        "",
        "The slotted link: steps kept for what is asked, real operations that are left of them "
        "when constants are folded, and time.",
        "",
        *table(
            ("asked", "steps", "operations", "one position", "10⁴ positions"),
            [
                (name, str(steps), str(operations), span(one), span(many))
                for name, steps, operations, one, many in scenes
            ],
        ),
    ]


def commands_section(
    commands: Sequence[processes.Command], warm: Sequence[tuple[str, Timing, Timing]]
) -> Table:
    """Return whole commands, cold, and sheets in a running process."""
    rows = []
    for command in commands:
        assert command.cold is not None
        rows.append(
            (
                command.name,
                f"{command.cold.median:.3f} s",
                " ".join(command.imports) or "—",
                str(command.modules or "—"),
                f"{command.peak_mb:.0f} MB" if command.peak_mb else "—",
            )
        )
    return [
        "## Commands, from the start of the process",
        "",
        *table(("command", "cold", "third parties imported", "modules", "peak memory"), rows),
        "",
        "A sheet in a process that runs already:",
        "",
        *table(
            ("format", "to make the sheet", "to write it"),
            [(fmt, span(make.median), span(write.median)) for fmt, make, write in warm],
        ),
    ]


def memory_section(rows: Sequence[tuple[str, float]]) -> Table:
    """Return peak memory of batches."""
    return [
        "## Memory",
        "",
        "Peak of a process of its own. A sweep holds its answers and blocks of buffers, whatever "
        "the number of steps; 10⁶ positions of the slotted link are "
        "the answers of 10⁶ positions and little else.",
        "",
        *table(("what", "peak"), [(name, f"{peak:.0f} MB") for name, peak in rows]),
    ]


# The whole --------------------------------------------------------------------------------------


class Measured:
    """Measurements, made when a section is requested; the figure reuses some of them.

    Parameters
    ----------
    quick : bool
        Smaller sizes and fewer runs: a look, not a measurement.
    """

    def __init__(self, *, quick: bool = False) -> None:
        self.quick = quick
        self.sizes = (12, 10_000) if quick else rivals.SIZES

    @cached_property
    def readings(self) -> list[measurements.ReadSpeed]:
        """Time beside error of two mechanisms."""
        return [
            *measurements.sweeps(fourbar(), self.sizes, FOURBAR_ROWS),
            *measurements.sweeps(slotted(), self.sizes),
            *measurements.single_readings(fourbar()),
            *measurements.single_readings(slotted()),
        ]

    @cached_property
    def compared(self) -> list[rivals.Rival]:
        """The four-bar and its peers."""
        return rivals.rivals(self.sizes, rounds=1 if self.quick else 9)

    @cached_property
    def positions(self) -> list[tuple[int, float]]:
        """Cost by positions."""
        more = () if self.quick else (100_000, 1_000_000)
        return rivals.by_positions((1, 12, 100, 1000, 10_000, *more))

    @cached_property
    def links(self) -> list[growth.Chain]:
        """Cost by links."""
        return growth.by_links((1, 2, 5) if self.quick else growth.DYADS)

    @cached_property
    def others(self) -> list[growth.Cost]:
        """Cost by loads, wheels, answers."""
        if self.quick:
            return []
        return [*growth.by_loads(), *growth.by_wheels(), *growth.by_works()]

    def speed(self) -> Table:
        """Return time beside error."""
        held = bounds.bounds_table(bounds.of_sweeps(self.readings))
        return [*speed_section(self.readings), *held]

    def peers(self) -> Table:
        """Return the four-bar with its peers."""
        held = bounds.bounds_table(bounds.of_rivals(self.compared))
        return [*rivals_section(self.compared), *held]

    def size(self) -> Table:
        """Return cost against size, and the saving of smaller requests."""
        scenes = scenes_section(rivals.by_scene())
        return [*growth_section(self.positions, self.links, self.others), "", *scenes]

    def commands(self) -> Table:
        """Return whole commands, and memory."""
        found = processes.commands(runs=1 if self.quick else 9)
        told = commands_section(found, processes.warm_sheets())
        return [
            *told, *bounds.bounds_table(bounds.of_commands(found)),
            "", *memory_section(processes.memory()),
        ]  # fmt: skip

    def many(self) -> Table:
        """Return the growth with variants and positions, and the gain of processes."""
        return many_section(quick=self.quick)

    def figure(self) -> bytes:
        """Return the figure as PNG."""
        return draw(self.readings, self.compared, self.positions, self.links)


def document(sections: Sequence[Table], *, figure: str, command: str) -> str:
    """Return the document around the sections."""
    cc = compiler()
    lines = [
        "<!-- generated by make bench -->",
        "",
        "# Speed and error",
        "",
        f"Made by `{command}` on {machine()}{f', {cc}' if cc else ''}. Times are medians; "
        "compare them with each other, not with another machine's.",
        "",
        f"![time against error; cost against size]({figure})",
    ]
    for section in sections:
        lines += ["", *section]
    return "\n".join(lines) + "\n"
