"""Letters of points that coincide on the paper: one inscription for them all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

NEAR = 0.3
"""Points so near one another are one point on the paper, mm."""


def shared_spots(
    letters: Iterable[tuple[complex, Sequence[str]]], near: float = NEAR
) -> list[tuple[complex, list[str]]]:
    """Return places with the letters that stand there, each letter once, in the order given.

    Parameters
    ----------
    letters : iterable of (complex, sequence of str)
        Places, mm, and their letters.
    near : float, mm
    """
    spots: list[tuple[complex, list[str]]] = []
    for place, own in letters:
        for other, found in spots:
            if abs(other - place) < near:
                found += [letter for letter in own if letter not in found]
                break
        else:
            spots.append((place, list(own)))
    return spots
