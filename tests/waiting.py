"""Waiting until another process has done something, however busy the machine is."""

from __future__ import annotations

import time
from collections.abc import Callable

from benchmarks.chromium import PATIENCE

__all__ = ["PATIENCE", "wait_until"]


def wait_until(is_so: Callable[[], object]) -> None:
    """Wait until something is so."""
    end = time.monotonic() + PATIENCE
    while not is_so():
        assert time.monotonic() < end, "it hangs"
        time.sleep(0.02)
