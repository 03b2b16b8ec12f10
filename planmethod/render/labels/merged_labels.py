"""Letters of points that coincide on the paper: one inscription for them all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from planmethod.render.ink.typeset import typeset
from planmethod.render.labels.model import SPARSE, Label, LabelStyle

MergedLetters = list[tuple[complex, list[str]]]
"""Places, mm, and their letters."""

NEAR = 0.3
"""Distance below which points coincide on the paper, mm."""


def merge_letters(
    letters: Iterable[tuple[complex, Sequence[str]]], near: float = NEAR
) -> MergedLetters:
    """Return places with their letters, each letter once, in the order given.

    Parameters
    ----------
    letters : iterable of (complex, sequence of str)
        Places, mm, and their letters.
    near : float, mm
    """
    spots: MergedLetters = []
    for place, own in letters:
        for other, found in spots:
            if abs(other - place) < near:
                found += [letter for letter in own if letter not in found]
                break
        else:
            spots.append((place, list(own)))
    return spots


def label_merged_letters(
    merged: MergedLetters,
    height: float,
    prefix: str,
    *,
    gap: float = 1.4,
    style: LabelStyle = SPARSE,
) -> list[Label]:
    """Return the letters of spots, away from the middle of them all; ``prefix`` is of names."""
    middle = sum(place for place, _ in merged) / len(merged)
    return [
        Label(
            typeset(", ".join(letters), height),
            place,
            prefer=place - middle,
            gap=gap,
            name=f"{prefix} {letters[0]}",
            style=style,
        )
        for place, letters in merged
    ]
