"""Work shared among processes: results come in order, no item is lost."""

from __future__ import annotations

import io
import multiprocessing
import os
import signal
import sys
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from functools import partial
from typing import Generic, TypeVar

import click
from msgspec import Struct

from planmethod.commands.command import answering
from planmethod.errors import PlanMethodError
from planmethod.languages import current_language, translate

CHUNKS_PER_PROCESS = 4
"""Chunks of the work for each process."""

T = TypeVar("T")
R = TypeVar("R")

MAX_PROCESSES = 61
"""Processes that every system can wait for."""


class Outcome(Struct, Generic[R], frozen=True):
    """Outcome of one item in another process.

    Attributes
    ----------
    output, errors : str
        What was printed on the two streams.
    value : R or None
    error : PlanMethodError, UsageError or None
    """

    output: str = ""
    errors: str = ""
    value: R | None = None
    error: Exception | None = None

    def result(self) -> R | None:
        """Print the captured output, and return the value or raise the error."""
        click.echo(self.errors, nl=False, err=True)
        click.echo(self.output, nl=False)
        if self.error is not None:
            raise self.error
        return self.value


def captured(work: Callable[[], R]) -> Outcome[R]:
    """Return the outcome and the output of some work, with picklable errors."""
    output, errors = io.StringIO(), io.StringIO()
    value: R | None = None
    error: Exception | None = None
    with redirect_stdout(output), redirect_stderr(errors), warnings.catch_warnings():
        if not sys.warnoptions:  # as in the first process (`planmethod.__main__`)
            warnings.simplefilter("ignore")
        try:
            value = work()
        except PlanMethodError as found:
            error = PlanMethodError(str(found))
            error.exit_code = found.exit_code
        except click.UsageError as found:
            error = click.UsageError(found.message)
    return Outcome(output.getvalue(), errors.getvalue(), value, error)


# In the processes --------------------------------------------------------------------------------


def _start() -> None:
    """Prepare a worker process; it ends with its parent."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # only the parent reports the stop
    signal.signal(signal.SIGTERM, _stop)
    threading.Thread(target=_follow, daemon=True).start()


def _stop(*_: object) -> None:
    raise SystemExit  # a file half written is removed on the way


def _follow() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
        os.kill(os.getpid(), signal.SIGTERM)


def _work(act: Callable[[T], R], item: T, lang: str) -> Outcome[R]:
    try:
        with answering(lang):
            return captured(partial(act, item))
    except SystemExit:  # else the executor would send it back, and take the next item
        signal.signal(signal.SIGTERM, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGTERM)
        raise


def split_into_chunks(items: Sequence[T], jobs: int, max_size: int) -> list[Sequence[T]]:
    """Return items in chunks of at most ``max_size``, several for each process: none waits."""
    size = max(1, min(max_size, -(-len(items) // (CHUNKS_PER_PROCESS * jobs))))
    return [items[start : start + size] for start in range(0, len(items), size)]


# In the first process ----------------------------------------------------------------------------


def in_processes(
    act: Callable[[T], R], items: Sequence[T], jobs: int
) -> Iterator[Outcome[R] | None]:
    """Yield the outcome of every item in one of several processes, in order.

    If a process is killed, its first unfinished item is retried in a process of its own; if that
    is killed, too, its outcome is None.

    Parameters
    ----------
    act : callable
        Done to each item; it is pickled, as the items and its results are.
    jobs : int
        Number of processes.
    """
    done: dict[int, Outcome[R]] = {}
    number, alone = 0, False
    while number < len(items):
        left = [number] if alone else [n for n in range(number, len(items)) if n not in done]
        futures: dict[int, Future[Outcome[R]]] = {}
        with _pool(1 if alone else min(jobs, len(left))) as pool:
            try:
                for one in left:
                    futures[one] = pool.submit(_work, act, items[one], current_language())
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
                    click.echo(
                        translate("Warning: a process was killed; its problems are started again."),
                        err=True,
                    )


@contextmanager
def _pool(jobs: int) -> Iterator[ProcessPoolExecutor]:
    """Provide worker processes; end them at once if the block ends early."""
    before = multiprocessing.active_children()
    pool = ProcessPoolExecutor(min(jobs, MAX_PROCESSES), initializer=_start)
    try:
        yield pool
    except BaseException:
        for child in multiprocessing.active_children():
            if child not in before:
                child.terminate()
        raise
    finally:
        pool.shutdown(cancel_futures=True)
