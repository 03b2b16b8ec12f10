"""Worker processes, with limits of time and memory, and their queue (очередь)."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import multiprocessing
import signal
import sys
import time
from collections.abc import AsyncGenerator, AsyncIterator, Callable, Mapping
from enum import IntEnum
from multiprocessing.connection import Connection
from typing import Any, TypeAlias

from planmethod.studio.requests import NESTING_TOO_DEEP, NO_MEMORY, StudioLimits

Job: TypeAlias = dict[str, Any]
"""Job for a process: plain data."""

JobResult: TypeAlias = dict[str, Any]
"""Result of a job: plain data; ``refused``: the sentence with its facts, if it failed."""

ProgressReporter: TypeAlias = Callable[[float], None]
"""Gets the share that is done, 0 to 1."""

Act: TypeAlias = Callable[[Job, ProgressReporter], JobResult]
"""Computes a job in a process; a function of a module."""

ENDING = 10.0
"""Seconds in which a process that has closed its pipe has ended."""

READY = 60.0
"""Seconds in which a process must be ready."""

PRELOADED = (
    "planmethod.linkages.reading", "planmethod.render.sketch", "planmethod.render.backends.svg",
    "planmethod.render.sheets.kinematics",
)  # fmt: skip
"""Modules preloaded in the parent of every process, if the system can."""

PAUSE = 0.5
"""Seconds between reports of the place in the queue."""

MAX_WAIT_FACTOR = 20.0
"""Maximum ratio of elapsed time to the limit of processor time, on a machine with other work:
beyond it the process counts as hanging."""

TOO_LONG = (
    "This takes more than {:g} s of processor time and was stopped. Request fewer "
    "positions, or a part of it; or run planmethod on your own machine, without limits."
)
HANGS = "This was not done after {:.0f} s and was stopped: the machine is busy. Try again later."
ENDED = (
    "The process of this computation ended after {:.0f} s (signal or exit code {}). Try "
    "again; if it recurs, report the file."
)


class Pace(IntEnum):
    """Expected duration of a computation (темп): the quicker goes first."""

    QUICK = 0
    USUAL = 1
    SLOW = 2


# In a process ------------------------------------------------------------------------------------


def run_jobs(pipe: Connection, act: Act, memory: int | None, written: int) -> None:
    """Run jobs until the pipe is closed; the first one is a warm-up."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if sys.platform != "win32":
        signal.signal(signal.SIGPROF, signal.SIG_DFL)  # it ends the process
    with contextlib.suppress(Exception):  # faults are reported with the actual jobs
        act({"do": "warm"}, lambda share: None)
    gc.collect()
    gc.freeze()  # what every computation has is not looked through again and again
    bound(memory, written)
    pipe.send(("ready", None))
    with contextlib.suppress(EOFError, OSError):
        while True:
            asked, seconds = pipe.recv()
            spent = ""
            try:
                _allow(seconds)
                found = act(asked, lambda share: pipe.send(("share", share)))
                _allow(0.0)
                pipe.send(("done", found))
            except MemoryError:
                spent = NO_MEMORY
            except RecursionError:
                spent = NESTING_TOO_DEEP
            if spent:  # outside, where what the work had is gone
                pipe.send(("spent", spent))
                return


def _allow(seconds: float) -> None:
    """End this process after a number of seconds of processor time, if possible; 0: never."""
    if sys.platform != "win32":
        signal.setitimer(signal.ITIMER_PROF, seconds)


def bound(memory: int | None, written: int) -> None:
    """Bound the memory of this process, and the files it writes, where the system can."""
    if sys.platform == "win32":
        return
    import resource

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)  # writing fails, with a message
    resource.setrlimit(resource.RLIMIT_FSIZE, (written, written))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    if memory is not None:
        resource.setrlimit(resource.RLIMIT_AS, (memory, memory))


# Beside them -------------------------------------------------------------------------------------


class StudioWorker:
    """One worker process (рабочий процесс), replaced when it is spent."""

    def __init__(self, act: Act, limits: StudioLimits) -> None:
        self.act, self.limits = act, limits
        way = "spawn" if sys.platform == "win32" else "forkserver"
        self._context: Any = multiprocessing.get_context(way)
        if way == "forkserver":
            self._context.set_forkserver_preload([act.__module__, *PRELOADED])
        self._start_process()

    def _start_process(self) -> None:
        self._pipe, other = self._context.Pipe()
        told = (other, self.act, self.limits.memory, self.limits.written)
        self._process = self._context.Process(target=run_jobs, args=told, daemon=True)
        self._process.start()
        other.close()
        self._is_ready = False

    def run(self, job: Job, seconds: float, report: ProgressReporter) -> JobResult:
        """Have something done, and wait for it; called in a thread.

        What takes more seconds of a processor, or more memory, is refused, and the process is
        another one then.
        """
        began = time.monotonic()
        try:
            if not self._is_ready:
                if not self._pipe.poll(READY):
                    return self._restart("The computation did not start. Try again.")
                self._pipe.recv()
                self._is_ready = True
            self._pipe.send((job, seconds))
            began = time.monotonic()
            end = began + seconds * (1.0 if sys.platform == "win32" else MAX_WAIT_FACTOR)
            while True:
                if not self._pipe.poll(max(0.0, end - time.monotonic())):
                    if sys.platform == "win32":  # there elapsed time is counted
                        return self._again(TOO_LONG, seconds)
                    return self._restart(HANGS, end - began)
                kind, value = self._pipe.recv()
                if kind == "share":
                    report(value)
                elif kind == "done":
                    found: JobResult = value
                    return found
                else:
                    return self._restart(value)
        except (EOFError, OSError):  # it has ended
            pass
        self._process.join(ENDING)
        code = self._process.exitcode
        if code is not None and sys.platform != "win32" and code == -signal.SIGPROF:
            return self._restart(TOO_LONG, seconds)
        return self._restart(ENDED, time.monotonic() - began, _named(code))

    def _restart(self, *said: object) -> JobResult:
        self.stop()
        self._start_process()
        return {"refused": said}

    def interrupt(self) -> None:
        """End its computation; the waiting client gets a rejection."""
        self._process.kill()

    def stop(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.join()
        self._pipe.close()


def _named(code: int | None) -> str:
    """Return the cause of a process's end: its signal, or its exit code."""
    names = {-one.value: one.name for one in signal.Signals}
    return "?" if code is None else names.get(code, str(code))


class _Ticket:
    def __init__(self, do: str, pace: Pace, session: str) -> None:
        self.do, self.pace, self.session = do, pace, session
        self.worker: asyncio.Future[StudioWorker] = asyncio.get_running_loop().create_future()
        self.began = time.monotonic()


class StudioQueue:
    """Computations that wait for a process (очередь расчётов): quick ones first.

    Slower jobs never occupy all processes, and a session has one slow job running.

    Attributes
    ----------
    busy, done, rejected : int
        Numbers of running, completed and rejected jobs.
    """

    def __init__(self, act: Act, count: int, limits: StudioLimits) -> None:
        self.limits = limits
        self._idle = [StudioWorker(act, limits) for _ in range(count)]
        self._every = tuple(self._idle)
        self._max_long = max(1, count - 1)
        self._long = 0
        self._slow: set[str] = set()
        self._waiting: list[_Ticket] = []
        self._count_by_session: dict[str, int] = {}
        self.busy = self.done = self.rejected = 0

    @property
    def waiting(self) -> int:
        """Number of waiting computations."""
        return len(self._waiting)

    def is_full_for(self, session: str) -> bool:
        """Return whether one more of a session cannot wait."""
        return self.waiting >= self.limits.waiting or (
            self._count_by_session.get(session, 0) >= self.limits.session_waiting
        )

    def is_busy_for(self, session: str) -> bool:
        """Return whether a session has a job running or waiting."""
        return session in self._count_by_session

    def stop(self) -> None:
        """End the processes."""
        for worker in self._every:
            worker.stop()

    async def run(
        self, job: Job, *, session: str, pace: Pace, seconds: float
    ) -> AsyncGenerator[Mapping[str, Any], None]:
        """Yield what becomes of it: ``place`` in the queue, ``share`` that is done, ``found``.

        The first item comes at once: then the job is queued, and leaves the queue with its reader.
        A quick job replaces an older waiting one of its session, which yields ``superseded``.
        With ``found`` come the seconds that it ``waited`` and ``worked``.
        """
        ticket = _Ticket(job["do"], pace, session)
        self._count_by_session[session] = self._count_by_session.get(session, 0) + 1
        self._queue(ticket)
        try:
            while not ticket.worker.done():
                yield {"place": self._place(ticket)}
                await asyncio.wait([ticket.worker], timeout=PAUSE)
            if ticket.worker.cancelled():
                yield {"found": {"superseded": True}}
                return
            yield {"place": 0}
        except BaseException:  # the client has gone
            self._leave(ticket)
            raise
        async for told in self._run_on_worker(ticket, job, seconds):
            yield told

    async def _run_on_worker(
        self, ticket: _Ticket, job: Job, seconds: float
    ) -> AsyncIterator[Mapping[str, Any]]:
        loop, worker = asyncio.get_running_loop(), ticket.worker.result()
        began = time.monotonic()
        shares: asyncio.Queue[float | None] = asyncio.Queue()

        def act() -> JobResult:
            def report(fraction: float) -> None:
                loop.call_soon_threadsafe(shares.put_nowait, fraction)

            return worker.run(job, seconds, report)

        future = asyncio.ensure_future(asyncio.to_thread(act))

        def free(_: object) -> None:  # also without a waiting client
            shares.put_nowait(None)
            self._free(ticket, worker)

        future.add_done_callback(free)
        try:
            while (share := await shares.get()) is not None:
                yield {"share": share}
        except BaseException:  # the client has gone
            if not future.done() and ticket.pace:  # a quick one costs less than a process
                worker.interrupt()
            raise
        found = future.result()
        self.done += 1
        self.rejected += "refused" in found
        worked = time.monotonic() - began
        yield {"found": found, "waited": began - ticket.began, "worked": worked}

    def _queue(self, ticket: _Ticket) -> None:
        """Add it after the last of its pace, or replace an older quick one."""
        for k, older in enumerate(self._waiting):
            same = older.do == ticket.do and older.session == ticket.session
            if ticket.pace == older.pace == Pace.QUICK and same:
                self._waiting[k] = ticket
                older.worker.cancel()
                self._forget(older)
                return
        self._waiting.append(ticket)
        self._waiting.sort(key=lambda one: one.pace)
        self._dispatch()

    def _place(self, ticket: _Ticket) -> int:
        return self._waiting.index(ticket) + 1 if ticket in self._waiting else 0

    def _dispatch(self) -> None:
        for ticket in [*self._waiting]:
            if self._idle and self._may(ticket):
                self._waiting.remove(ticket)
                self._long += ticket.pace != Pace.QUICK
                if ticket.pace == Pace.SLOW:
                    self._slow.add(ticket.session)
                self.busy += 1
                ticket.worker.set_result(self._idle.pop())

    def _may(self, ticket: _Ticket) -> bool:
        if ticket.pace == Pace.SLOW and ticket.session in self._slow:
            return False
        return ticket.pace == Pace.QUICK or self._long < self._max_long

    def _free(self, ticket: _Ticket, worker: StudioWorker) -> None:
        self._idle.append(worker)
        self._long -= ticket.pace != Pace.QUICK
        if ticket.pace == Pace.SLOW:
            self._slow.discard(ticket.session)
        self.busy -= 1
        self._forget(ticket)
        self._dispatch()

    def _leave(self, ticket: _Ticket) -> None:
        if ticket in self._waiting:
            self._waiting.remove(ticket)
            self._forget(ticket)
        elif ticket.worker.done() and not ticket.worker.cancelled():
            self._free(ticket, ticket.worker.result())

    def _forget(self, ticket: _Ticket) -> None:
        left = self._count_by_session[ticket.session] - 1
        if left:
            self._count_by_session[ticket.session] = left
        else:
            del self._count_by_session[ticket.session]
