"""The browser of the tests, which the measurements drive too."""

from __future__ import annotations

from benchmarks.chromium import PROGRAM, Page, browsing

__all__ = ["PROGRAM", "Page", "browsing"]
