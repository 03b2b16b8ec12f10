"""Work shared among processes: every one loads once, results come in order, no item is lost."""

from __future__ import annotations

import io
import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from typing import Any, Generic, TypeVar

import click
from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.languages import say, speaking, spoken
from planmethod.process import settle_process

T = TypeVar("T")
R = TypeVar("R")

MOST = 61
"""Processes that every system can wait for."""


# What is said ------------------------------------------------------------------------------------


class _Ear(io.StringIO):
    """A stream whose parts are kept in the order in which both streams said them."""

    def __init__(self, said: list[tuple[bool, str]], *, err: bool) -> None:
        super().__init__()
        self._said, self._err = said, err

    def write(self, text: str) -> int:
        """Keep a part."""
        if not isinstance(text, str):
            raise TypeError  # click tries which kind of stream this is
        if text:
            self._said.append((self._err, text))
        return len(text)


class Part(Struct, Generic[T], frozen=True):
    """What became of one item in another process.

    Attributes
    ----------
    said : tuple of (bool, str)
        What was printed, in order; whether on the stream of errors.
    value : T or None
    error : PlanMethodError, UsageError or None
    """

    said: tuple[tuple[bool, str], ...] = ()
    value: T | None = None
    error: Exception | None = None

    def told(self) -> T | None:
        """Say what was said there, and return the value or raise the error."""
        for err, text in self.said:
            click.echo(text, nl=False, err=err)
        if self.error is not None:
            raise self.error
        return self.value


def heard(work: Callable[[], T]) -> Part[T]:
    """Return what becomes of some work, and what it says; errors as those that can travel."""
    said: list[tuple[bool, str]] = []
    value: T | None = None
    error: Exception | None = None
    with redirect_stdout(_Ear(said, err=False)), redirect_stderr(_Ear(said, err=True)):
        try:
            value = work()
        except PlanMethodError as found:
            error = PlanMethodError(str(found))
            error.exit_code = found.exit_code
        except click.UsageError as found:
            error = click.UsageError(found.message)
    return Part(tuple(said), value, error)


# Processes ---------------------------------------------------------------------------------------


class _Here(Struct):
    """State of a process at work."""

    work: Callable[[Any], Any] | None = None
    lang: str = ""
    busy: bool = False


_here = _Here()


def _start(lang: str, begin: Callable[..., Callable[[T], R]], args: tuple[Any, ...]) -> None:
    """Get ready for work; end with the process that gave it."""

    def stop(*_: object) -> None:
        if _here.busy:
            raise SystemExit  # a file half written is removed on the way
        os._exit(1)

    def watch() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
            os._exit(1)

    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl+C is told by the first process alone
    signal.signal(signal.SIGTERM, stop)
    threading.Thread(target=watch, daemon=True).start()
    settle_process()
    try:
        _here.lang = lang
        with speaking(lang):
            _here.work = begin(*args)
    except BaseException:  # the first process has begun the same before, and told of its faults
        os._exit(1)


def _do(item: T) -> Any:
    assert _here.work is not None
    _here.busy = True
    try:
        with speaking(_here.lang):
            return _here.work(item)
    except SystemExit:
        os._exit(1)
    finally:
        _here.busy = False


def shared(
    items: Sequence[T], jobs: int, begin: Callable[..., Callable[[T], R]], *args: Any
) -> Iterator[R | None]:
    """Yield what is made of every item by several processes, in order.

    Where a process is killed, the first item that is not done is begun again by a process that has
    nothing else; if that is killed, too, None stands in its place.

    Parameters
    ----------
    items : sequence
        Pickled one by one.
    jobs : int
        Number of processes.
    begin : callable
        Called with ``args`` once in each process; returns what is done to an item there.
    """
    done: dict[int, R] = {}
    number, alone = 0, False
    while number < len(items):
        left = [number] if alone else [n for n in range(number, len(items)) if n not in done]
        futures: dict[int, Future[R]] = {}
        with _pool(1 if alone else min(jobs, len(left)), begin, args) as pool:
            try:
                for one in left:
                    futures[one] = pool.submit(_do, items[one])
                while number in done or number in futures:
                    yield done.pop(number) if number in done else futures[number].result()
                    number += 1
                alone = False
            except BrokenProcessPool:
                for one, future in futures.items():
                    if one >= number and future.done() and future.exception() is None:
                        done[one] = future.result()
                if alone and number not in done:
                    yield None
                    number += 1
                alone = not alone
                if alone:
                    told = "Warning: a process at work was killed; what it had is begun again."
                    click.echo(say(told), err=True)


@contextmanager
def _pool(
    jobs: int, begin: Callable[..., Callable[[Any], Any]], args: tuple[Any, ...]
) -> Iterator[ProcessPoolExecutor]:
    """Give processes at work; they are ended at once where their giver ends early."""
    before = multiprocessing.active_children()
    pool = ProcessPoolExecutor(
        min(jobs, MOST), initializer=_start, initargs=(spoken(), begin, args)
    )
    try:
        yield pool
    except BaseException:
        for child in multiprocessing.active_children():
            if child not in before:
                child.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
