"""Placing of labels (размещение надписей): labels overlap neither each other nor lines.

``model``          labels to be placed, and labels with their places
``candidates``     the candidate places of a label
``paper``          their costs from items already drawn
``placed_labels``  their costs from labels already placed
``label_column``   columns for the labels of points that are close together
``merged_labels``  one label for points in one place
``place``          greedy placement, hardest labels first, then local repair
``spare``          labels that are left out for lack of space
"""

from planmethod.render.labels.model import (
    BUSY,
    NAMING,
    NEAREST,
    SERIES,
    SPARSE,
    UNDER_LABEL,
    Label,
    LabelStyle,
    Placed,
    segment_label,
)
from planmethod.render.labels.place import SIDE_GAP, place_labels, spare_labels

__all__ = [
    "BUSY",
    "NAMING",
    "NEAREST",
    "SERIES",
    "SIDE_GAP",
    "SPARSE",
    "UNDER_LABEL",
    "Label",
    "LabelStyle",
    "Placed",
    "place_labels",
    "segment_label",
    "spare_labels",
]
