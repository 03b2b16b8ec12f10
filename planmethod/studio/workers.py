"""Processes at work, each with limits of time and memory, and the queue before them (очередь)."""

from __future__ import annotations

import asyncio
import contextlib
import gc
import multiprocessing
import signal
import sys
import time
from collections.abc import AsyncGenerator, AsyncIterator, Callable, Mapping
from multiprocessing.connection import Connection
from typing import Any, TypeAlias

from planmethod.studio.limits import StudioLimits

Asked: TypeAlias = dict[str, Any]
"""What is asked of a process: plain data."""

Found: TypeAlias = dict[str, Any]
"""What it answers: plain data; ``refused``: the sentence, with its facts, why there is nothing."""

Tell: TypeAlias = Callable[[float], None]
"""Gets the share that is done, 0 to 1."""

Act: TypeAlias = Callable[[Asked, Tell], Found]
"""What a process does; a function of a module."""

READY = 60.0
"""Seconds in which a process is ready for work."""

PRELOADED = (
    "planmethod.kinds", "planmethod.render.sketch", "planmethod.render.backends.svg",
    "planmethod.render.sheets.kinematics",
)  # fmt: skip
"""Modules that every process has from the one it is made of, where the system can."""

PAUSE = 0.5
"""Seconds between two looks at the place in the queue."""


# In a process ------------------------------------------------------------------------------------


def work(pipe: Connection, act: Act, memory: int | None, written: int) -> None:
    """Answer what is asked until nobody asks; the first thing is asked of oneself."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    with contextlib.suppress(Exception):  # whatever fails here is told of what is asked
        act({"do": "warm"}, lambda share: None)
    gc.collect()
    gc.freeze()  # what every computation has is not looked through again and again
    bound(memory, written)
    pipe.send(("ready", None))
    with contextlib.suppress(EOFError, OSError):
        while True:
            asked = pipe.recv()
            found: Found | None = None
            with contextlib.suppress(MemoryError, RecursionError):
                found = act(asked, lambda share: pipe.send(("share", share)))
            if found is None:  # outside, where what the work had is gone
                pipe.send(("spent", None))
                return
            pipe.send(("done", found))


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
    """One process at work (рабочий процесс), and another one in its place where it is spent."""

    def __init__(self, act: Act, limits: StudioLimits) -> None:
        self.act, self.limits = act, limits
        way = "spawn" if sys.platform == "win32" else "forkserver"
        self._context: Any = multiprocessing.get_context(way)
        if way == "forkserver":
            self._context.set_forkserver_preload([act.__module__, *PRELOADED])
        self._begin()

    def _begin(self) -> None:
        self._pipe, other = self._context.Pipe()
        told = (other, self.act, self.limits.memory, self.limits.written)
        self._process = self._context.Process(target=work, args=told, daemon=True)
        self._process.start()
        other.close()
        self._is_ready = False

    def run(self, asked: Asked, seconds: float, tell: Tell) -> Found:
        """Have something done, and wait for it; called in a thread.

        What takes longer, or more memory, is refused, and the process is another one then.
        """
        try:
            if not self._is_ready:
                if not self._pipe.poll(READY):
                    return self._again("The computation did not start. Try again.")
                self._pipe.recv()
                self._is_ready = True
            self._pipe.send(asked)
            end = time.monotonic() + seconds
            while True:
                if not self._pipe.poll(max(0.0, end - time.monotonic())):
                    said = "This takes longer than {:g} s and is stopped. Ask for less."
                    return self._again(said, seconds)
                kind, value = self._pipe.recv()
                if kind == "share":
                    tell(value)
                elif kind == "done":
                    found: Found = value
                    return found
                else:
                    break
        except (EOFError, OSError):  # it is killed
            pass
        return self._again("This takes more memory than there is for it. Ask for less.")

    def _again(self, *said: object) -> Found:
        self.stop()
        self._begin()
        return {"refused": said}

    def interrupt(self) -> None:
        """End what it does; who waits for it gets a refusal."""
        self._process.kill()

    def stop(self) -> None:
        """End the process."""
        self._process.kill()
        self._process.join()
        self._pipe.close()


class _Ticket:
    def __init__(self, do: str, quick: bool, session: str) -> None:
        self.do, self.quick, self.session = do, quick, session
        self.given: asyncio.Future[StudioWorker] = asyncio.get_running_loop().create_future()
        self.began = time.monotonic()


class StudioQueue:
    """Computations that wait for a process (очередь расчётов): quick ones first.

    The long ones never take all processes.

    Attributes
    ----------
    busy, done, refused : int
        How many are at work, were done, and could not be.
    """

    def __init__(self, act: Act, count: int, limits: StudioLimits) -> None:
        self.limits = limits
        self._idle = [StudioWorker(act, limits) for _ in range(count)]
        self._every = tuple(self._idle)
        self._most_long = max(1, count - 1)
        self._long = 0
        self._waiting: list[_Ticket] = []
        self._own: dict[str, int] = {}
        self.busy = self.done = self.refused = 0

    @property
    def waiting(self) -> int:
        """How many wait."""
        return len(self._waiting)

    def is_full_for(self, session: str) -> bool:
        """Tell whether one more of a session cannot wait."""
        return self.waiting >= self.limits.waiting or (self._own.get(session, 0) >= self.limits.own)

    def stop(self) -> None:
        """End the processes."""
        for worker in self._every:
            worker.stop()

    async def run(
        self, asked: Asked, *, session: str, quick: bool, seconds: float
    ) -> AsyncGenerator[Mapping[str, Any], None]:
        """Yield what becomes of it: ``place`` in the queue, ``share`` that is done, ``found``.

        The first thing comes at once: then it stands in the queue, and leaves it with its reader.
        A quick one takes the place of an older one of its session that still waits: that one finds
        ``superseded``. With what is found stand the seconds that it ``waited`` and was at work.
        """
        ticket = _Ticket(asked["do"], quick, session)
        self._own[session] = self._own.get(session, 0) + 1
        self._queue(ticket)
        try:
            while not ticket.given.done():
                yield {"place": self._place(ticket)}
                await asyncio.wait([ticket.given], timeout=PAUSE)
            if ticket.given.cancelled():
                yield {"found": {"superseded": True}}
                return
            yield {"place": 0}
        except BaseException:  # who asked has gone
            self._leave(ticket)
            raise
        async for told in self._at_work(ticket, asked, seconds):
            yield told

    async def _at_work(
        self, ticket: _Ticket, asked: Asked, seconds: float
    ) -> AsyncIterator[Mapping[str, Any]]:
        loop, worker = asyncio.get_running_loop(), ticket.given.result()
        began = time.monotonic()
        shares: asyncio.Queue[float | None] = asyncio.Queue()

        def act() -> Found:
            def tell(share: float) -> None:
                loop.call_soon_threadsafe(shares.put_nowait, share)

            return worker.run(asked, seconds, tell)

        future = asyncio.ensure_future(asyncio.to_thread(act))

        def free(_: object) -> None:  # also where nobody waits for the answer any more
            shares.put_nowait(None)
            self._free(ticket, worker)

        future.add_done_callback(free)
        try:
            while (share := await shares.get()) is not None:
                yield {"share": share}
        except BaseException:  # who asked has gone
            if not future.done() and not ticket.quick:  # a quick one costs less than a process
                worker.interrupt()
            raise
        found = future.result()
        self.done += 1
        self.refused += "refused" in found
        worked = time.monotonic() - began
        yield {"found": found, "waited": began - ticket.began, "worked": worked}

    def _queue(self, ticket: _Ticket) -> None:
        """Put it behind the last quick one, or the last of all; or where an older one stood."""
        for k, older in enumerate(self._waiting):
            same = older.do == ticket.do and older.session == ticket.session
            if ticket.quick and older.quick and same:
                self._waiting[k] = ticket
                older.given.cancel()
                self._forget(older)
                return
        self._waiting.append(ticket)
        self._waiting.sort(key=lambda one: not one.quick)
        self._give()

    def _place(self, ticket: _Ticket) -> int:
        return self._waiting.index(ticket) + 1 if ticket in self._waiting else 0

    def _give(self) -> None:
        for ticket in [*self._waiting]:
            if self._idle and (ticket.quick or self._long < self._most_long):
                self._waiting.remove(ticket)
                self._long += not ticket.quick
                self.busy += 1
                ticket.given.set_result(self._idle.pop())

    def _free(self, ticket: _Ticket, worker: StudioWorker) -> None:
        self._idle.append(worker)
        self._long -= not ticket.quick
        self.busy -= 1
        self._forget(ticket)
        self._give()

    def _leave(self, ticket: _Ticket) -> None:
        if ticket in self._waiting:
            self._waiting.remove(ticket)
            self._forget(ticket)
        elif ticket.given.done() and not ticket.given.cancelled():
            self._free(ticket, ticket.given.result())

    def _forget(self, ticket: _Ticket) -> None:
        left = self._own[ticket.session] - 1
        if left:
            self._own[ticket.session] = left
        else:
            del self._own[ticket.session]
