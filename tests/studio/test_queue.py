"""The order of the queue of the studio: idle workers, no threads, no clock."""

from __future__ import annotations

import asyncio
from collections.abc import Callable
from typing import Any

import pytest
from doors import Pace, StudioLimits, StudioQueue, workers

QUICK, USUAL, SLOW = Pace.QUICK, Pace.USUAL, Pace.SLOW


class IdleWorker:
    """A worker that records its requests."""

    begun: list[str]

    def __init__(self, act: Callable[..., Any], limits: StudioLimits) -> None:
        pass

    def run(self, asked: dict[str, Any], seconds: float, tell: Callable[[float], None]) -> Any:
        return {"said": asked["do"]}


class Desk:
    """A queue whose jobs run when they are let go; ``begun`` has them in the order of beginning."""

    def __init__(self, count: int, patch: pytest.MonkeyPatch) -> None:
        patch.setattr(workers, "StudioWorker", IdleWorker)
        patch.setattr(asyncio, "to_thread", self._run)
        self.queue = StudioQueue(lambda asked, tell: {}, count, StudioLimits())
        self.begun: list[str] = []
        self.gates: dict[str, asyncio.Event] = {}
        self.places: dict[str, list[int]] = {}
        self.done: list[dict[str, Any]] = []
        self._jobs: list[asyncio.Task[None]] = []

    async def _run(self, act: Callable[[], Any]) -> Any:
        found = act()
        self.begun.append(found["said"])
        await self.gates[found["said"]].wait()
        return found

    async def ask(self, do: str, session: str, pace: Pace) -> None:
        """Request a job, and return as soon as it is in the queue."""
        self.gates[do] = asyncio.Event()
        self._jobs.append(asyncio.ensure_future(self._read(do, session, pace)))
        await self.settle()

    async def _read(self, do: str, session: str, pace: Pace) -> None:
        async for told in self.queue.run({"do": do}, session=session, pace=pace, seconds=1.0):
            if "place" in told:
                self.places.setdefault(do, []).append(told["place"])
            if "found" in told:
                self.done.append(told["found"])

    async def settle(self) -> None:
        for _ in range(20):
            await asyncio.sleep(0)  # the turn of the others, no time

    async def let(self, do: str) -> None:
        """Let a job end."""
        self.gates[do].set()
        await self.settle()


def test_waiting_requests_run_the_quick_first_and_the_slow_last(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def play() -> Desk:
        desk = Desk(1, monkeypatch)
        await desk.ask("first", "a", USUAL)
        for do, session, pace in (
            ("slow", "b", SLOW), ("usual", "c", USUAL), ("quick", "d", QUICK),
            ("usual too", "e", USUAL), ("quick too", "f", QUICK),
        ):  # fmt: skip
            await desk.ask(do, session, pace)
        assert desk.queue.waiting == 5 and desk.begun == ["first"]
        for do in ("first", "quick", "quick too", "usual", "usual too", "slow"):
            await desk.let(do)
        return desk

    desk = asyncio.run(play())
    assert desk.begun == ["first", "quick", "quick too", "usual", "usual too", "slow"]
    assert [one["said"] for one in desk.done] == desk.begun
    # each client's first message: its place at that time
    assert [desk.places[do][0] for do in ("slow", "usual", "quick", "quick too")] == [1, 1, 1, 2]
    assert (desk.queue.busy, desk.queue.waiting, desk.queue.done) == (0, 0, 6)


def test_the_last_free_process_is_for_quick_jobs(monkeypatch: pytest.MonkeyPatch) -> None:
    async def play() -> list[list[str]]:
        desk, seen = Desk(2, monkeypatch), []
        await desk.ask("long", "a", USUAL)
        await desk.ask("long too", "b", USUAL)
        seen.append([*desk.begun])
        await desk.ask("quick", "c", QUICK)
        seen.append([*desk.begun])
        await desk.let("long")
        seen.append([*desk.begun])
        for do in ("quick", "long too"):
            await desk.let(do)
        return seen

    assert asyncio.run(play()) == [
        ["long"], ["long", "quick"], ["long", "quick", "long too"],
    ]  # fmt: skip


def test_a_session_has_one_slow_job_running_and_others_precede_its_second(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def play() -> Desk:
        desk = Desk(3, monkeypatch)
        await desk.ask("project", "a", SLOW)
        await desk.ask("note", "a", SLOW)
        await desk.ask("other's note", "b", SLOW)
        assert desk.begun == ["project", "other's note"]
        await desk.let("other's note")
        assert desk.begun[2:] == []
        await desk.let("project")
        await desk.let("note")
        return desk

    assert asyncio.run(play()).begun == ["project", "other's note", "note"]


def test_a_newer_quick_job_of_a_session_takes_the_place_of_the_older_one(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    async def play() -> Desk:
        desk = Desk(1, monkeypatch)
        await desk.ask("first", "a", USUAL)
        await desk.ask("faults", "a", QUICK)
        await desk.ask("other's", "b", QUICK)
        await desk.ask("faults", "a", QUICK)  # in the place of the first of them
        assert desk.queue.waiting == 2
        for do in ("first", "faults", "other's"):
            await desk.let(do)
        return desk

    desk = asyncio.run(play())
    assert desk.begun == ["first", "faults", "other's"]
    assert desk.done[0] == {"superseded": True}
    assert not desk.queue.is_busy_for("a")
