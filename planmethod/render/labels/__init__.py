"""Placing of labels (размещение надписей): nothing overlaps, nothing lies on a line.

``model``       what wants a place, and the place it got
``candidates``  the places that come into question for a label
``paper``       what the drawing that is there already makes of them
``others``      what the labels make of them that have their places
``ladder``      columns for the labels of points that are close together
``place``       one label after another, the hard ones first; then those that stand badly are mended
``spare``       labels that are left out where there is no room
"""

from planmethod.render.labels.model import (
    ALONE,
    BUSY,
    CROWDED,
    NAMING,
    NEAREST,
    UNDER_LABEL,
    Label,
    LabelStyle,
    Placed,
    segment_label,
)
from planmethod.render.labels.place import place_labels
from planmethod.render.labels.spare import BESIDE, spare_labels

__all__ = [
    "ALONE",
    "BESIDE",
    "BUSY",
    "CROWDED",
    "NAMING",
    "NEAREST",
    "UNDER_LABEL",
    "Label",
    "LabelStyle",
    "Placed",
    "place_labels",
    "segment_label",
    "spare_labels",
]
