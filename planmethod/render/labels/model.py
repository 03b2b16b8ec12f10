"""Labels to be placed, and labels with their places."""

from __future__ import annotations

from msgspec import Struct
from msgspec.structs import replace

from planmethod.render.ink.drawing import Bounds, Fill, Ink, Item, Pen, Stroke, Text
from planmethod.render.ink.typeset import Inscription, typeset

CLEAR = 0.7  # white between a label and a line, mm
VERTICAL_GAP = 0.9  # white between two labels one above the other, mm

UNDER_LABEL = "under a label"
"""Tag of the white under a label that breaks the thin lines behind it."""

LED = "leader of "
"""Prefix of the tag of a leader line, before the name of its label."""

BREAKABLE = frozenset({Pen.THIN, Pen.PALE, Pen.PHANTOM})
"""Pens of the lines that the white of a label may break."""


class LabelStyle(Struct, frozen=True):
    """Placement style of a label; all lengths mm.

    Attributes
    ----------
    rings, far_rings : tuple of float
        Distances beyond the gap to try first, and those to try when the first are occupied.
    angles, far_angles : int
        Places on each ring.
    leader_from : float
        Distance from its point or segment beyond which it gets a leader line (линия-выноска).
    leader : float
        Cost of a leader line, in mm of distance.
    turn_cost : float
        Cost of the direction opposite to the preferred one, in mm of distance.
    stranger : float
        Cost of a place nearer to another label's point than to its own, in mm of distance.
    side_gap : float
        White between it and another label side by side: closer they would read as one.
    heavy : float
        Cost of a thick line between it and its point or segment, in mm of distance.
    slanted : bool
        Its leader line is never horizontal: between letters it would read as a fraction bar.
    """

    rings: tuple[float, ...] = (0.0, 1.2, 3.0, 5.5, 9.0)
    angles: int = 16
    far_rings: tuple[float, ...] = (13.0, 18.0, 25.0, 34.0, 46.0)
    far_angles: int = 32
    leader_from: float = 8.0
    leader: float = 25.0
    turn_cost: float = 3.0
    stranger: float = 0.0
    side_gap: float = 2.0
    heavy: float = 7.0
    slanted: bool = False


SPARSE = LabelStyle()
"""A letter among few: eighty places around its point."""

BUSY = LabelStyle(
    rings=(0.0, 0.8, 1.8, 3.0, 4.5, 6.5, 9.0, 12.0, 16.0),
    angles=24,
    leader_from=5.0,
    leader=10.0,
    side_gap=3.2,
    heavy=20.0,
)
"""A letter among few, on a drawing with many lines."""

SERIES = LabelStyle(
    rings=(0.0, 0.5, 1.1, 2.0, 3.0, 4.5, 6.5, 9.0, 12.0, 15.5),
    angles=20,
    far_rings=(18.5, 22.0, 26.0, 31.0, 37.0, 44.0),
    leader_from=3.2,
    leader=8.0,
    turn_cost=7.0,
    stranger=30.0,
    side_gap=3.2,
    heavy=12.0,
)
"""One of a series of labels: many places, a strict direction, an early leader line."""


NEAREST = LabelStyle(
    rings=(0.0, 1.2, 3.0, 6.0),
    far_rings=(9.5, 14.0, 19.0),
    far_angles=16,
    leader_from=1.8,
    leader=12.0,
    stranger=60.0,
    heavy=25.0,
    slanted=True,
)
"""The letter of a point among other points: close to its own, an early leader line."""

NAMING = LabelStyle(
    rings=(0.0, 1.5, 4.0),
    far_rings=(9.0, 13.0, 18.0),
    far_angles=16,
    leader_from=3.0,
    leader=10.0,
    heavy=12.0,
    slanted=True,
)
"""The name of a vector: along it, or at the end of a leader line from its middle."""


class Label(Struct, frozen=True):
    """Inscription to be placed near a point or along a segment (надпись).

    Attributes
    ----------
    inscription : Inscription
    anchor : complex, mm
        The point it names; the middle of a segment.
    segment : (complex, complex) or None, mm
        The segment it names: it is then placed beside it, near its middle.
    prefer : complex
        Preferred direction from the anchor; 0 for none. For a segment only its side matters.
    gap : float, mm
        White between the anchor point and the label: the radius of a joint and a little more.
    priority : int
        Labels of higher priority are placed earlier.
    name : str
        Name of the inscription for the lint. Default: made of markup and place.
    style : LabelStyle
        Its placement style.
    series : str
        Name of its series: labels of a series whose points are close together form a column.
    optional : bool
        It is left out if there is no free place, and displaces no other label.
    """

    inscription: Inscription
    anchor: complex
    segment: tuple[complex, complex] | None = None
    prefer: complex = 0j
    gap: float = 1.5
    priority: int = 0
    name: str = ""
    style: LabelStyle = SPARSE
    series: str = ""
    optional: bool = False


class Placed(Struct, frozen=True):
    """Label with its place: ``at`` is the left end of its base line, mm.

    ``leader`` is the leader line or None; ``free`` means that the label crosses and overlaps no
    item; ``ground``, that white breaks the thin lines under the label, because it is not free.
    """

    label: Label
    at: complex
    leader: tuple[complex, complex] | None = None
    free: bool = True
    ground: bool = False

    @property
    def bounds(self) -> Bounds:
        """Ink box, mm."""
        return self.label.inscription.ink(self.at)

    def items(self) -> list[Item]:
        """Return the letters, the leader line and the white under the letters."""
        items = self.label.inscription.at(self.at, label=self.label.name)
        if self.label.segment is None:
            named = self.label.anchor
            items = [replace(i, names=named) if isinstance(i, Text) else i for i in items]
        if self.ground:
            x0, y0, x1, y1 = self.bounds
            low, high = (
                complex(x0, y0) - CLEAR / 2 * (1 + 1j),
                complex(x1, y1) + CLEAR / 2 * (1 + 1j),
            )
            corners = (low, complex(high.real, low.imag), high, complex(low.real, high.imag))
            items = [Fill(corners, Ink.WHITE, tag=UNDER_LABEL), *items]
        return (
            items
            if self.leader is None
            else [
                Stroke(self.leader, Pen.THIN, tag=LED + self.label.name),
                *items,
            ]
        )


def segment_label(
    markup: str, start: complex, end: complex, height: float = 3.5, *, prefer: complex = 0j
) -> Label:
    """Return a label along a segment: the number of a link, the length of a vector."""
    return Label(typeset(markup, height), (start + end) / 2, (start, end), prefer, gap=1.2)
