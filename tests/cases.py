"""Cases of a test: which are taken by default and which with ``--thorough``, many in one test."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable, Sequence
from typing import Any, TypeVar

import pytest

Test = Callable[..., None]
T = TypeVar("T")

_taken = {"everything": False, "thinned": True}


def take(*, everything: bool, is_thin: bool) -> None:
    """Set, before the test modules are imported, which cases are taken."""
    _taken["everything"], _taken["thinned"] = everything, is_thin


def is_thinned() -> bool:
    """Return whether of tests with many cases some are left out."""
    return _taken["thinned"]


def some(count: int, few: int) -> int:
    """Return the number of seeds or examples to run: ``count`` of them, or by default a few."""
    return count if _taken["everything"] else few


def thinned(cases: Sequence[T], step: int) -> Sequence[T]:
    """Return all cases, or by default every ``step``-th, from the first on."""
    return cases if _taken["everything"] else cases[::step]


def sampled(cases: Sequence[T], step: int) -> Sequence[T]:
    """Return all cases, or in ``make test`` every ``step``-th, from the first on."""
    return cases[::step] if _taken["thinned"] else cases


def each(names: str, cases: Iterable[Any]) -> Callable[[Test], Test]:
    """Run a test over many cases as one; the first failure is raised and names all that fail.

    Like ``pytest.mark.parametrize``, for cases that are quicker than pytest's own overhead.
    The cases share the fixtures of the test. One that skips itself is left out; if all do, so does
    the test.

    Parameters
    ----------
    names : str
        Arguments of the test, comma-separated.
    cases : iterable
        Values of the argument, or tuples of them if there are several.
    """
    keys = [name.strip() for name in names.split(",")]
    rows = [dict(zip(keys, case if len(keys) > 1 else [case], strict=True)) for case in cases]
    assert rows

    def join(test: Test) -> Test:
        @functools.wraps(test)
        def run(*args: Any, **given: Any) -> None:
            skipped, faults = [], []
            for row in rows:
                try:
                    test(*args, **row, **given)
                except pytest.skip.Exception as reason:
                    skipped.append(reason)
                except (Exception, pytest.fail.Exception) as fault:
                    faults.append(fault)
                    case = ", ".join(f"{key} = {value!r}" for key, value in row.items())
                    faults[0].add_note(case)
            if faults:
                raise faults[0]
            if len(skipped) == len(rows):
                raise skipped[0]

        own = inspect.signature(test)
        left = [one for name, one in own.parameters.items() if name not in keys]
        run.__signature__ = own.replace(parameters=left)  # type: ignore[attr-defined]
        return run

    return join
