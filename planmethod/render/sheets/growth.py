"""Plans drawn larger where the paper has room (увеличение масштаба по свободному полю)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

from msgspec.structs import replace

from planmethod.construct.scale import Scale, series_near
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.model import Convention, Scales
from planmethod.render.sheets.pages import Page

STEPS = 3
"""Most members of the series that a scale goes on by."""

_KEYS = {kind: FACTS[kind].scale for kind in reversed(MOTION)}
"""Keys of the scales, the plan that is to be largest first."""


def grown(
    pages: list[Page],
    scales: dict[PlanKind, Scale],
    asked: Scales,
    draw: Callable[[Scales], list[Page] | None],
) -> list[Page]:
    """Return the pages with every free scale as large as they bear.

    Parameters
    ----------
    pages, scales
        What was drawn, and at which scales.
    asked : Scales
        The scales of the file: those that it gives are kept.
    draw : callable
        Draws the pages with other scales; None when they do not fit.

    Notes
    -----
    A larger plan is accepted when it takes no more pages, no smaller letters and no groups apart.
    """
    inverse = asked.convention is Convention.MM_PER_UNIT
    free = [kind for kind, key in _KEYS.items() if getattr(asked, key) is None]
    now: dict[str, Any] = {_KEYS[kind]: scales[kind].per_mm for kind in free}
    for _ in range(STEPS):
        before = dict(now)
        for key in before:
            wish = {**now, key: _larger(now[key], inverse=inverse)}
            tried = draw(replace(asked, **wish))
            if tried is not None and _as_good(tried, pages):
                pages, now = tried, wish
        if now == before:
            break
    return pages


def _larger(per_mm: float, *, inverse: bool) -> float:
    """Return the next scale of the series that draws larger, units per mm."""
    if inverse:
        return 1.0 / series_near(1.0 / per_mm * 1.01, up=True)
    return series_near(per_mm / 1.01, up=False)


def _as_good(pages: Sequence[Page], others: Sequence[Page]) -> bool:
    if len(pages) != len(others):
        return False
    pairs = zip(pages, others, strict=True)
    return all(page.tried <= other.tried for page, other in pairs)
