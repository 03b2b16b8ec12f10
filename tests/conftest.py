from __future__ import annotations

import ctypes
import gc
import os
import shutil
import signal
import sys
from collections.abc import Iterator
from pathlib import Path

import cases
import pytest
import worked
from hypothesis import settings

# A slow machine does not fail a test, and every run has the same examples.
settings.register_profile("planmethod", deadline=None, derandomize=True, max_examples=40)
settings.register_profile("thinned", deadline=None, derandomize=True, max_examples=8)
settings.register_profile("thorough", deadline=None, derandomize=True, max_examples=200)


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--thorough", action="store_true", help="all random mechanisms, many more examples"
    )
    parser.addoption(
        "--every", action="store_true", help="every case of every test; implied by CI=true"
    )


def is_whole(config: pytest.Config) -> bool:
    """Return whether every case is taken: on request, for tests named one by one, and in CI."""
    asked = config.getoption("--thorough") or config.getoption("--every")
    named = any("::" in word for word in config.args)
    return bool(asked or named or os.environ.get("CI") == "true")


PROGRAMS = ("chromium", "pdftotext", "rsvg-convert", "soffice", "node", "tsc")
"""Programs that ``.ci/run`` installs; without CI, tests that need a missing one are skipped."""


def pytest_configure(config: pytest.Config) -> None:
    absent = [program for program in PROGRAMS if shutil.which(program) is None]
    if absent and os.environ.get("CI") == "true":
        raise pytest.UsageError(f"CI takes every test, and there is no {', '.join(absent)}")
    _end_in_order()
    thorough = bool(config.getoption("--thorough"))
    is_thin = not is_whole(config)
    settings.load_profile("thorough" if thorough else "thinned" if is_thin else "planmethod")
    cases.take(everything=thorough, is_thin=is_thin)
    # The tests share large data, and the search for cycles in it takes 5 %; documents of Word are
    # cycles, and a hundred megabytes of them wait for it.
    gc.set_threshold(30_000, 5, 5)


def _end_in_order() -> None:
    """Handle SIGTERM like Ctrl+C, so that fixtures end their servers and browsers."""
    own = os.getpid()

    def end(number: int, _: object) -> None:
        if os.getpid() != own:  # a forked process ends at once, as by default
            os._exit(128 + number)
        raise KeyboardInterrupt

    signal.signal(signal.SIGTERM, end)


WHOLE = ("contracts/", "construct/", "note/test_messages.py", "outputs/")
"""Tests each of whose cases makes its own claim; elsewhere many cases of a test show the same."""

MANY = 4


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Take every third to seventh case of a test that has many, unless all are requested.

    A test marked ``dear``, which takes seconds, runs its first case only; one without cases is
    left out.
    """
    if is_whole(config):
        return
    found: dict[str, list[pytest.Item]] = {}
    left: set[int] = set()
    for item in items:
        name, bracket, _ = item.nodeid.partition("[")
        if not bracket and item.get_closest_marker("dear"):
            left.add(id(item))
        elif bracket and not name.removeprefix("tests/").startswith(WHOLE):
            found.setdefault(name, []).append(item)
    for own in found.values():
        # An odd step still meets every value of parameters that cross by twos and fours.
        step = (1, 3, 5, 5, 5, 5, 5, 5, 7)[min(len(own) // MANY, 8)]
        if own[0].get_closest_marker("dear"):
            step = len(own)
        left |= {id(one) for k, one in enumerate(own) if k % step}
    config.hook.pytest_deselected(items=[item for item in items if id(item) in left])
    items[:] = [item for item in items if id(item) not in left]


def pytest_collection_finish() -> None:
    """Exempt the collected items from the garbage collector, which would search them each time."""
    gc.collect()
    gc.freeze()


@pytest.fixture(scope="module", autouse=True)
def _what_a_file_has_kept_goes_with_it(request: pytest.FixtureRequest) -> Iterator[None]:
    """Drop the solutions and drawings that a file's tests share: over all files they take 1 GB."""
    yield
    for kept in vars(request.module).values():
        if getattr(kept, "__module__", None) == request.module.__name__:
            getattr(kept, "cache_clear", int)()
    gc.collect()  # with reference cycles
    if sys.platform == "linux":  # what glibc holds of it is a hundred megabytes
        getattr(ctypes.CDLL(None), "malloc_trim", int)(0)


@pytest.fixture(scope="session", autouse=True)
def _no_config_of_the_developer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """Use an empty config file and no cache of the developer's; make every warning an error."""
    empty = Path(tmp_path_factory.mktemp("config")) / "config.toml"
    empty.touch()
    base = tmp_path_factory.getbasetemp()  # of a worker: inside that of the run
    shared = (base.parent if "PYTEST_XDIST_WORKER" in os.environ else base) / "shared"
    shared.mkdir(exist_ok=True)
    worked.shared[:] = [shared]
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PLANMETHOD_CONFIG", str(empty))
        patch.setenv("PLANMETHOD_NATIVE", "0")  # nor libraries that a compiler left in a cache
        patch.setenv("PLANMETHOD_LANG", "en")
        patch.setenv("PYTHONWARNINGS", "error")  # in processes that tests start, too
        yield


@pytest.fixture
def russian(monkeypatch: pytest.MonkeyPatch) -> None:
    """The user names Russian: messages and all that is written are in it."""
    monkeypatch.setenv("PLANMETHOD_LANG", "ru")
