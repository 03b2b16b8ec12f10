"""Students who type at once in one studio: ``python -m benchmarks.studio`` (нагрузка на студию).

Each student changes a number of a shipped task, waits for the scheme, and changes it again when a
time between two bursts of typing has passed. What is asked stays on this machine, and is bounded in
count and time. Printed are the times from the last letter to the scheme and what became of all.
"""

from __future__ import annotations

import argparse
import http.client
import json
import os
import random
import re
import subprocess
import sys
import threading
import time
from pathlib import Path
from urllib.parse import urlsplit

from planmethod.problem.tasks import tasks

TASKS = ("linkages-ex3", "linkages-ex1", "linkages-2.1.114", "levers-13", "linkages-2.1.2")


class TypingStudent(threading.Thread):
    """One who types (студент за клавиатурой): its times, s, and what was not answered."""

    def __init__(self, address: str, number: int, changes: int, pause: float) -> None:
        super().__init__()
        self.place, self.changes, self.pause = urlsplit(address).netloc, changes, pause
        self.chance = random.Random(number)
        known = {task.name: task for task in tasks()}
        self.text = known[TASKS[number % len(TASKS)]].text
        self.times: list[float] = []
        self.refused = self.lost = 0

    def run(self) -> None:
        """Enter, and type."""
        door = http.client.HTTPConnection(self.place, timeout=60)
        door.request("POST", "/api/session", "{}")
        key = json.loads(door.getresponse().read())["key"]
        time.sleep(self.chance.uniform(0, self.pause))
        for number in range(self.changes):
            began = time.monotonic()
            text = re.sub(r"omega *= *[\d.]+", f"omega = {number + 1}", self.text)
            told = json.dumps({"text": text, "name": "load"})
            try:
                door.request("POST", "/api/do/sketched", told, {"x-studio": key})
                answer = door.getresponse()
                lines = answer.read().splitlines()
                found = json.loads(lines[-1]).get("found", {}) if answer.status == 200 else {}
            except (OSError, ValueError, http.client.HTTPException):
                self.lost += 1
                continue
            if "svg" in found:
                self.times.append(time.monotonic() - began)
            else:
                self.refused += 1
            rest = self.pause * self.chance.uniform(0.5, 1.5) - (time.monotonic() - began)
            time.sleep(max(0.0, rest))


def used_by(root: int) -> tuple[float, float]:
    """Return what a process and those below it used: largest memory, MB added up, and CPU, s.

    Linux only.
    """
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
    return memory, time_used


def main() -> int:
    """Print a row of the table for the numbers of students that are asked for."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--students", default="1,10,25,50")
    parser.add_argument("--changes", type=int, default=8)
    parser.add_argument("--pause", type=float, default=4.0)
    asked = parser.parse_args()
    command = [
        sys.executable,
        "-m",
        "planmethod",
        "studio",
        "--serve",
        "--port",
        "0",
        "--jobs",
        "2",
    ]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as served:
        assert served.stdout is not None
        address = re.findall(r"http://\S+", served.stdout.readline())[0]
        try:
            warm = TypingStudent(address, 0, 4, 0.1)
            warm.run()
            print(f"load average at the start: {os.getloadavg()[0]:.1f}")
            print(
                "students  asked  drawn  refused  lost  median, s  95 %, s  longest, s  "
                "memory, MB  CPU, ms"
            )
            for count in map(int, asked.students.split(",")):
                all_of_them = [
                    TypingStudent(address, k, asked.changes, asked.pause) for k in range(count)
                ]
                before = used_by(served.pid)[1]
                for one in all_of_them:
                    one.start()
                for one in all_of_them:
                    one.join()
                memory, cpu = used_by(served.pid)
                times = sorted(t for one in all_of_them for t in one.times)
                at = [times[min(len(times) - 1, int(len(times) * part))] for part in (0.5, 0.95, 1)]
                print(
                    f"{count:8} {count * asked.changes:6} {len(times):6}"
                    f" {sum(one.refused for one in all_of_them):8}"
                    f" {sum(one.lost for one in all_of_them):5}"
                    f" {at[0]:10.2f} {at[1]:8.2f} {at[2]:11.2f} {memory:11.0f}"
                    f" {1000 * (cpu - before) / max(1, len(times)):8.0f}"
                )
        finally:
            served.terminate()
    print(f"load average at the end: {os.getloadavg()[0]:.1f}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
