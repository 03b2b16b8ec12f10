"""Special points of a triad on the scheme (особые точки): intersections of its legs' lines."""

from __future__ import annotations

from planmethod.construct.steps import LineName
from planmethod.mechanism.groups import triad_of
from planmethod.note.narrate.statement import point_name
from planmethod.plans.motion.position import leg_points
from planmethod.render.ink.drawing import Disc, Ink, Item, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.labels import Label
from planmethod.render.pictures.scheme import Scheme

_EXTENSION = 4.0
"""Extension of a leg's line beyond the special point, mm."""

_MAX_UNUSED_DISTANCE = 1.0
"""Largest distance from the group of a drawn special point that no plan uses, in group sizes."""

_MAX_DISTANCE = 3.0
"""Largest distance of the point that the plans use: on paper it is found by its angles."""

_PARALLEL = 1e-3  # sine of the angle of lines that intersect too far away for any paper


def special_points(scheme: Scheme) -> tuple[list[Item], list[Label]]:
    """Return the special points of all triads, the legs' lines up to them, and their letters."""
    items: list[Item] = []
    labels: list[Label] = []
    construction = scheme.solution.construction
    for group in construction.structure.groups:
        triad = triad_of(group)
        if triad is None:
            continue
        special = construction.draft.special[triad.base]
        ends = [[scheme.at(point) for point in leg_points(*leg)] for leg in triad.legs]
        joints = [place for leg in ends for place in leg]
        middle = sum(joints) / len(joints)
        size = max(abs(place - middle) for place in joints)
        for third in range(3):
            pair = [k for k in range(3) if k != third]
            place = _intersect_lines(scheme, *(special.lines[k] for k in pair))
            used = third == special.third
            if (
                place is None
                or abs(place - middle)
                > (_MAX_DISTANCE if used else _MAX_UNUSED_DISTANCE) * size + size
            ):
                continue
            for k in pair:
                items += _line(ends[k], place)
            items.append(Disc(place, 0.8 * scheme.factor, Ink.BLACK, tag="special point"))
            letter = typeset(point_name(f"{special.point[:-1]}{3 - third}"), scheme.letter_height)
            labels.append(Label(letter, place, gap=1.5, priority=1, name="special point"))
    return items, labels


def _intersect_lines(scheme: Scheme, one: LineName, two: LineName) -> complex | None:
    paper, index = scheme.solution.paper, scheme.index
    (p, u), (q, v) = (
        (complex(paper.origin(line)[index]), complex(paper.line_vector(line)[index]))
        for line in (one, two)
    )
    across = (u.conjugate() * v).imag
    if abs(across) < _PARALLEL * abs(u) * abs(v):
        return None
    return p + u * ((q - p).conjugate() * v).imag / across


def _line(ends: list[complex], place: complex) -> list[Item]:
    """Return the line of a leg from its nearer joint to the special point, and a little on.

    Empty if it lies on the leg itself.
    """
    start = min(ends, key=lambda end: abs(end - place))
    away = place - start
    if abs(away) < 1.0:
        return []
    return [Stroke((start, place + away / abs(away) * _EXTENSION), Pen.THIN, tag="special line")]
