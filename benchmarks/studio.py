"""Students typing at once in one studio: ``python -m benchmarks.studio`` (нагрузка на студию).

Each student changes a number of a shipped task, waits for the scheme, and changes it again when a
time between two bursts of typing has passed. Requests stay on this machine, and are bounded in
count and time. A row of benchmarks/reports/studio.md is printed for each number of students: the
times from the last letter to the scheme and their parts, the outcome of all requests, memory, and
the load of the machine, by which to judge the times. ``--latencies`` prints how long one student
waits for a scheme, plans, sheets, the first time and later: also for that report.
"""

from __future__ import annotations

import argparse
import contextlib
import http.client
import json
import os
import random
import re
import subprocess
import sys
import threading
import time
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple
from urllib.parse import urlsplit

from planmethod.problem.tasks import tasks

TASKS = ("linkages-ex3", "linkages-ex1", "linkages-2.1.114", "levers-13", "linkages-2.1.2")


HEADS = (
    "students", "asked", "drawn", "refused", "lost", "median, s", "95 %, s", "longest, s",
    "queue 95 %, s", "at work 95 %, s", "memory, MB", "CPU of one scheme, ms", "server's of it, ms",
    "load average",
)  # fmt: skip
LATENCY_HEADS = ("what", "from the start, s", "median, s", "longest, s", "CPU, ms")
THINGS = {
    "scheme": ("sketched", {}),
    "what moves": ("command", {"what": "live"}),
    "sheets": ("sheets", {}),
    "tables": ("command", {"what": "tables"}),
    "sheets as PDF": ("command", {"what": "pdf"}),
    "note": ("command", {"what": "note"}),
}
"""Results that one student waits for, and their requests."""


class Visitor:
    """An open page (посетитель): sends requests, and keeps the session and the connection."""

    def __init__(self, address: str) -> None:
        self._door = http.client.HTTPConnection(urlsplit(address).netloc, timeout=60)
        self._door.request("GET", address)
        came = self._door.getresponse()
        came.read()
        cookie = (came.headers["Set-Cookie"] or "").partition(";")[0]
        self._heads = {"Content-Type": "application/json", "Cookie": cookie}
        self._door.request("POST", "/api/session", "{}", self._heads)
        self._heads["X-Studio"] = json.loads(self._door.getresponse().read())["key"]

    def close(self) -> None:
        """Leave."""
        self._door.close()

    def ask(self, do: str, text: str, **more: Any) -> dict[str, Any]:
        """Return the last line of an answer; an empty one if it is rejected."""
        told = json.dumps({"text": text, "name": "load", **more})
        self._door.request("POST", f"/api/do/{do}", told, self._heads)
        answer = self._door.getresponse()
        lines = answer.read().splitlines()
        found: dict[str, Any] = json.loads(lines[-1]) if answer.status == 200 else {}
        return found


class TypingStudent(threading.Thread):
    """A typing student (студент за клавиатурой).

    Attributes
    ----------
    times : list of tuple of float
        From the last letter to the scheme, of it in the queue, and at work, s.
    refused, lost : int
        Numbers of requests rejected, and not answered.
    """

    def __init__(self, address: str, number: int, changes: int, pause: float) -> None:
        super().__init__()
        self.address, self.number, self.changes, self.pause = address, number, changes, pause
        self.chance = random.Random(number)
        self.text = text_of(TASKS[number % len(TASKS)])
        self.times: list[tuple[float, float, float]] = []
        self.refused = self.lost = 0

    def run(self) -> None:
        """Enter, and type; no two students type the same number."""
        with contextlib.closing(Visitor(self.address)) as page:
            self._type(page)

    def _type(self, page: Visitor) -> None:
        time.sleep(self.chance.uniform(0, self.pause))
        for change in range(self.changes):
            began = time.monotonic()
            typed = f"omega = {change + 1}.{self.number:03d}1"
            try:
                told = page.ask("sketched", re.sub(r"omega *= *[\d.]+", typed, self.text))
            except (OSError, ValueError, http.client.HTTPException):
                self.lost += 1
                continue
            took = time.monotonic() - began
            if "svg" in told.get("found", {}):
                self.times.append((took, told["waited"], told["worked"]))
            else:
                self.refused += 1
            time.sleep(max(0.0, self.pause * self.chance.uniform(0.5, 1.5) - took))


def text_of(name: str) -> str:
    """Return the text of a shipped task."""
    return next(task.text for task in tasks() if task.name == name)


class Used(NamedTuple):
    """Resources used by a server so far (затраты сервера): peak memory, MB; CPU, s."""

    memory: float
    cpu: float
    server: float
    """CPU time of the server's own process, without the workers, s."""


def used_by(root: int) -> Used:
    """Return what a process and those below it used, added up; Linux only."""
    children: dict[int, list[int]] = {}
    used: dict[int, tuple[float, float]] = {}
    for path in Path("/proc").glob("[0-9]*"):
        try:
            told = dict(line.split(":", 1) for line in (path / "status").read_text().splitlines())
            fields = (path / "stat").read_text().rpartition(")")[2].split()
        except OSError:  # it has ended
            continue
        own = int(path.name)
        children.setdefault(int(told["PPid"]), []).append(own)
        cpu = (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
        used[own] = int(told.get("VmHWM", "0 kB").split()[0]) / 1024, cpu
    todo, memory, time_used = [root], 0.0, 0.0
    while todo:
        one = todo.pop()
        memory, time_used = memory + used[one][0], time_used + used[one][1]
        todo += children.get(one, [])
    return Used(memory, time_used, used[root][1])


@contextlib.contextmanager
def served(*more: str) -> Iterator[tuple[str, int]]:
    """Start a studio with two processes at a free port; its address, and the number of it."""
    command = [sys.executable, "-m", "planmethod", "studio", "--port", "0", "--jobs", "2", *more]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as running:
        assert running.stdout is not None
        try:
            yield re.findall(r"http://\S+", running.stdout.readline())[0], running.pid
        finally:
            running.terminate()


def row(address: str, server: int, count: int, changes: int, pause: float) -> list[str]:
    """Return the row of the table for a number of students."""
    students = [TypingStudent(address, k, changes, pause) for k in range(count)]
    load, before = os.getloadavg()[0], used_by(server)
    for one in students:
        one.start()
    for one in students:
        one.join()
    after = used_by(server)
    times = [one for student in students for one in student.times]
    took, waited, worked = (sorted(part) for part in zip(*times, strict=True))
    scheme, own = after.cpu - before.cpu, after.server - before.server
    return [
        str(count), str(count * changes), str(len(times)),
        str(sum(one.refused for one in students)), str(sum(one.lost for one in students)),
        *(f"{one:.2f}" for one in (share(took, 0.5), share(took, 0.95), took[-1])),
        *(f"{one:.2f}" for one in (share(waited, 0.95), share(worked, 0.95))),
        f"{after.memory:.0f}", f"{1000 * scheme / len(times):.0f}",
        f"{1000 * own / len(times):.0f}", f"{load:.1f}–{os.getloadavg()[0]:.1f}",
    ]  # fmt: skip


def share(ordered: Sequence[float], part: float) -> float:
    """Return the value that a part of all does not exceed."""
    return ordered[min(len(ordered) - 1, int(len(ordered) * part))]


def latencies(times: int) -> Iterator[list[str]]:
    """Yield how long one student waits for each thing, s: from the start of the server, and after.

    The last number is the CPU that one of the later ones took, ms.
    """
    for name, (do, more) in THINGS.items():
        took: list[float] = []
        start = time.monotonic()
        with served() as (address, server), contextlib.closing(Visitor(address)) as page:
            for number in range(times + 1):
                text = re.sub(r"omega *= *[\d.]+", f"omega = {number + 1}.7", text_of(TASKS[0]))
                began = time.monotonic() if number else start
                assert "refused" not in page.ask(do, text, **more)["found"]
                took.append(time.monotonic() - began)
                if not number:
                    before = used_by(server).cpu
            cpu = (used_by(server).cpu - before) / times
        warm = sorted(took[1:])
        cells = (took[0], share(warm, 0.5), warm[-1])
        yield [name, *(f"{one:.2f}" for one in cells), f"{1000 * cpu:.0f}"]


def table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> None:
    """Print a table of Markdown, row by row."""
    for cells in (heads, ["---:"] * len(heads)):
        print(f"| {' | '.join(cells)} |")
    for cells in rows:
        print(f"| {' | '.join(cells)} |", flush=True)


def main() -> int:
    """Print the requested rows."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--students", default="1,10,25,50")
    parser.add_argument("--changes", type=int, default=8)
    parser.add_argument("--pause", type=float, default=4.0)
    parser.add_argument("--latencies", type=int, metavar="TIMES")
    asked = parser.parse_args()
    if asked.latencies:
        print(f"load average: {os.getloadavg()[0]:.1f}")
        table(LATENCY_HEADS, latencies(asked.latencies))
        return 0
    with served("--serve") as (address, server):
        TypingStudent(address, 999, 10, 0.1).run()
        counts = map(int, asked.students.split(","))
        table(HEADS, (row(address, server, n, asked.changes, asked.pause) for n in counts))
    return 0


if __name__ == "__main__":
    sys.exit(main())
