"""When the lines and letters of a finished drawing appear while its construction is played.

An item is complete when the last of the points is made on which it depends: the points that its
letter names, that its ends lie on, or that the link of its tag has.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from msgspec import Struct, field

from planmethod.render.ink.drawing import Arc, Disc, Fill, Item, Stroke, Text
from planmethod.render.ink.typeset import PART_OF
from planmethod.render.labels.model import LED, UNDER_LABEL

ON = 0.06
"""Distance below which an end of a line is at a point, mm."""


class Moments(Struct):
    """Numbers of the steps in which something of a drawing is complete.

    Attributes
    ----------
    places : list of (complex, int)
        Points, mm, with the steps that make them.
    tags, labels, texts : mapping of str to int
        Steps by the tag of an item, the name of its inscription, the markup of one without a name.
    first : int
        Step of an item without a point.
    exact : mapping of Item to int
        Steps of items that are known as a whole, such as arrows.
    """

    places: list[tuple[complex, int]]
    tags: Mapping[str, int] = field(default_factory=dict)
    labels: Mapping[str, int] = field(default_factory=dict)
    texts: Mapping[str, int] = field(default_factory=dict)
    first: int = 0
    exact: Mapping[Item, int] = field(default_factory=dict)

    def of(self, item: Item) -> int:
        """Return the step with which an item is complete."""
        if item in self.exact:
            return self.exact[item]
        if isinstance(item, Text):
            if item.label in self.labels:
                return self.labels[item.label]
            markup = item.label.rpartition("@")[0]  # its name, if it was given none
            if markup in self.texts:
                return self.texts[markup]
            return self._nearest([item.at if item.names is None else item.names])
        if item.tag in self.tags:
            return self.tags[item.tag]
        return self._nearest(_points(item))

    def _nearest(self, points: Iterable[complex]) -> int:
        """Return the last step that makes a point under some places; else the nearest point's."""
        if not self.places:
            return self.first
        here = list(points)
        under = [step for at, step in self.places if any(abs(at - place) <= ON for place in here)]
        if under:
            return max(under)
        middle = sum(here) / len(here)
        return min(self.places, key=lambda one: abs(one[0] - middle))[1]

    def each(self, items: Sequence[Item]) -> tuple[int, ...]:
        """Return the step with which each item appears; all of an inscription with its letters.

        The white under letters comes before them.
        """
        named = dict[str, int]()
        for item in items:
            if isinstance(item, Text) and item.label:
                named.setdefault(item.label, self.of(item))
        found = list[int]()
        letters = self.first
        for item in reversed(items):
            if isinstance(item, Text):
                letters = named.get(item.label, self.of(item))
                found.append(letters)
                continue
            owner = item.tag.removeprefix(LED).removeprefix(PART_OF)
            if item.tag == UNDER_LABEL:
                found.append(letters)
            elif owner != item.tag and owner in named:
                found.append(named[owner])
            else:
                found.append(self.of(item))
        return tuple(reversed(found))


def _points(item: Item) -> list[complex]:
    match item:
        case Stroke() | Fill():
            return list(item.points)
        case Arc() | Disc():
            return [item.centre]
        case Text():
            return [item.at]
