"""Placing of labels (размещение надписей): labels overlap neither each other nor lines.

``model``         labels, their candidate places, and the geometry of boxes and leader lines
``paper``         costs of a place from items and labels that are already on the paper
``label_column``  labels of points that coincide or are close together: merged, or in a column
``place``         greedy placement, hardest labels first, then local repair; optional labels last
"""

from planmethod.render.labels.model import (
    BUSY,
    MIN_LEADER,
    NAMING,
    NAMING_OF_MANY,
    NEAREST,
    SERIES,
    SPARSE,
    UNDER_LABEL,
    Label,
    LabelStyle,
    Placed,
    Segment,
    segment_label,
)
from planmethod.render.labels.place import SIDE_GAP, place_labels, spare_labels

__all__ = [
    "BUSY",
    "MIN_LEADER",
    "NAMING",
    "NAMING_OF_MANY",
    "NEAREST",
    "SERIES",
    "SIDE_GAP",
    "SPARSE",
    "UNDER_LABEL",
    "Label",
    "LabelStyle",
    "Placed",
    "Segment",
    "place_labels",
    "segment_label",
    "spare_labels",
]
