"""Pictures with their letters placed around them."""

from __future__ import annotations

from collections.abc import Sequence

from planmethod.errors import LayoutError
from planmethod.render.ink.drawing import Fill, Item
from planmethod.render.ink.extent import ink_bounds
from planmethod.render.labels import SIDE_GAP, Label, Placed, place_labels, spare_labels
from planmethod.render.layout.block import Picture

MARGINS = (26.0, 60.0)
"""Margins around a picture for its letters, mm: the larger if the smaller has no free place."""

LONGEST = 50_000.0
"""Largest width or height of a picture that is drawn, mm. The longest sheet has 2523, but trial
scales may be finer, and plans next to a dead position are many times larger."""


def reject_oversized(left: float, low: float, right: float, high: float) -> None:
    """Reject a picture that fits no paper before time and memory are spent on it.

    Raises
    ------
    LayoutError
        It is wider or higher than `LONGEST`, or its size is not a number.
    """
    if not max(right - left, high - low) <= LONGEST:
        raise LayoutError(
            "a picture of {:.3g} × {:.3g} m fits no paper. Take coarser scales in [scales], or "
            "leave them out.",
            (right - left) / 1e3,
            (high - low) / 1e3,
        )


def lettered(
    items: Sequence[Item],
    labels: Sequence[Label],
    *,
    clear: Sequence[Item] = (),
    welcome: Sequence[Label] = (),
) -> Picture:
    """Return a picture of items with their labels in free places around them.

    The labels keep clear of the invisible items of ``clear`` as long as there is space. ``welcome``
    are labels that are left out if they have no free place within the picture.
    """
    left, low, right, high = ink_bounds(items)
    reject_oversized(left, low, right, high)
    for hidden in (clear, ()) if clear else ((),):
        for room in MARGINS:
            bounds = (left - room, low - room, right + room, high + room)
            placed = place_labels(labels, [*items, *hidden], bounds)
            if all(label.free for label in placed):
                break
        else:
            continue
        break
    whole = [*items, *(item for label in placed for item in label.items())]
    for label in spare_labels(
        welcome, [*whole, *clear, *map(_keep_out_area, placed)], ink_bounds(whole)
    ):
        whole += label.items()
    return Picture(tuple(whole), ink_bounds(whole))


def _keep_out_area(placed: Placed) -> Fill:
    """Return the area around a label that must stay free for it to be read alone."""
    left, low, right, high = placed.bounds
    left, right = left - SIDE_GAP, right + SIDE_GAP
    return Fill(
        (complex(left, low), complex(right, low), complex(right, high), complex(left, high))
    )
