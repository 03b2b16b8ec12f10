"""Scales as drawings have them: are they of the series, and which are inscribed."""

from __future__ import annotations

import re
from collections.abc import Iterator
from math import floor, log10

from doors import SCALE_SERIES as SERIES, Drawing, Text

_INSCRIBED = re.compile(r"^ ?= ([\d,]+)(?:·10)? .*(?:/мм|мм/)")


def is_round(per_mm: float) -> bool:
    """Return whether a scale, or its inverse, is of the series."""
    return any(
        abs(one / 10 ** floor(log10(one) + 1e-9) - member) < 1e-6
        for one in (per_mm, 1.0 / per_mm)
        for member in SERIES
    )


def uneven_scales(sheet: Drawing) -> Iterator[str]:
    """Yield the scales of a Russian sheet that are not of the series: of views, as inscribed."""
    for view in sheet.views:
        if view.scale and not is_round(view.per_mm):
            yield f"{view.kind}: {view.scale} = {view.per_mm}"
    for item in sheet.items:
        if not isinstance(item, Text):
            continue
        found = _INSCRIBED.match(item.text)
        if found and " рад" not in item.text and not is_round(float(found[1].replace(",", "."))):
            yield item.text
