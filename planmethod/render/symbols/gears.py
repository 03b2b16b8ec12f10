"""Toothed wheels (зубчатые колёса) in both views of a scheme.

From the front a wheel is its pitch circle, dash-dot. From the side (in the plane of the axes) it
is its disc seen on edge: a line with a short cross-bar at the teeth; where two wheels mesh, their
cross-bars lie side by side with the pitch point between them.
"""

from __future__ import annotations

from planmethod.render.ink.drawing import Arc, Disc, Ink, Item, Stroke
from planmethod.render.symbols.axes import axis_line, centre_lines, pitch_circle
from planmethod.render.symbols.grounds import ground_line
from planmethod.render.symbols.sizes import SIZES, unit

PITCH_POINT = 0.8
"""Radius of the dot of a pitch point, mm."""

RACK = 5.0
"""Height of a rack, mm."""


# From the front -----------------------------------------------------------------------------------


def wheel_front(centre: complex, radius: float, *, touch: complex | None = None) -> list[Item]:
    """Return a wheel from the front: pitch circle and centre lines (колесо, вид спереди).

    ``radius`` is that of the pitch circle, ``touch`` the pitch point, mm. The joint or support in
    the centre is drawn after it.
    """
    return [*pitch_circle(centre, radius, touch=touch), *centre_lines(centre, radius)]


def mesh_front(
    first: complex, radius: float, second: complex, *, internal: bool = False
) -> list[Item]:
    """Return two wheels in mesh from the front (зубчатое зацепление, вид спереди).

    Parameters
    ----------
    first, second : complex, mm
        The centres; for ``internal`` the second is that of the ring (колесо с внутренними зубьями).
    radius : float, mm
        Pitch radius of the first; that of the second follows, since the circles touch.

    Notes
    -----
    One line goes through both centres. A ring has its rim outside the pitch circle, a main line; a
    dot marks the pitch point.
    """
    apart = abs(second - first)
    way = unit(second - first)
    point = first - way * radius if internal else first + way * radius
    other = apart + radius if internal else apart - radius
    rim = other + SIZES.slider_width / 2 if internal else other
    items = [
        *pitch_circle(first, radius, touch=point),
        *pitch_circle(second, other, touch=point),
        *centre_lines(first, radius, directions=(way * 1j,)),
        *centre_lines(second, rim, directions=(way * 1j,)),
    ]
    ends = [second - way * (rim + 3.0), second + way * (rim + 3.0)]
    if internal:
        items.append(Arc(second, rim))
    else:
        ends[0] = first - way * (radius + 3.0)
    items += axis_line(*ends, first, second)
    return [*items, Disc(point, PITCH_POINT, Ink.BLACK)]


def rack_front(start: complex, end: complex) -> list[Item]:
    """Return a rack: its pitch line, dash-dot, and the outline of its back (рейка).

    Its body is on the right of the way from ``start`` to ``end``; a wheel touches the pitch line.
    """
    down = unit(end - start) * -1j * RACK
    teeth, back = down * 0.3, down
    body = (start + teeth, start + back, end + back, end + teeth)
    over = unit(end - start) * 3.0
    return [
        Stroke(body, closed=True),
        *axis_line(start - over, end + over, (start + end) / 2),
    ]


# From the side ------------------------------------------------------------------------------------


def wheel_profile(
    centre: complex,
    radius: float,
    *,
    sides: tuple[int, ...] = (1, -1),
    loose: bool = False,
    bore: float = 0.0,
    tag: str = "",
) -> list[Item]:
    """Return a wheel from the side: its disc and a cross-bar at the teeth (колесо, вид сбоку).

    Parameters
    ----------
    centre : complex, mm
        On the axis.
    radius : float, mm
        Pitch radius; the cross-bar stands half a mesh inside it.
    sides : tuple of int
        Which halves are drawn: +1 above the axis, -1 below it.
    loose : bool
        The wheel rotates on its shaft: a hub of two cross-bars with the shaft between them (колесо
        на подшипнике). Otherwise it is fixed to the shaft.
    bore : float, mm
        Half the width of the hollow shaft that its disc begins on.
    """
    tooth = SIZES.teeth / 2
    rim = radius - SIZES.mesh / 2
    root = SIZES.mesh / 2 if loose else bore
    items: list[Item] = []
    for way in sides:
        top, low = centre + 1j * way * rim, centre + 1j * way * root
        items.append(Stroke((low, top), tag=tag))
        items.append(Stroke((top - tooth, top + tooth), tag=tag))
        if loose:
            items.append(Stroke((low - tooth, low + tooth), tag=tag))
    return items


def ring_profile(
    centre: complex, radius: float, *, support: float = 6.0, side: int = 1
) -> list[Item]:
    """Return the upper half of a fixed wheel with inner teeth, from the side (неподвижное колесо).

    Its cross-bar stands half a mesh outside the pitch radius; from there a stem of ``support`` mm
    goes to the hatched frame. ``side`` -1: the lower half.
    """
    tooth, base = SIZES.teeth / 2, SIZES.base / 2
    top = centre + 1j * side * (radius + SIZES.mesh / 2)
    foot = top + 1j * side * support
    return [
        Stroke((top - tooth, top + tooth)),
        Stroke((top, foot)),
        *ground_line(foot - base, foot + base, side=side),
    ]


def bell_profile(
    centre: complex,
    radius: float,
    *,
    web: float,
    side: int = 1,
    bore: float = 0.0,
    tag: str = "",
) -> list[Item]:
    """Return the upper half of a wheel with inner teeth that turns (колесо с внутренними зубьями).

    Its rim stands half a mesh outside the pitch radius and goes ``web`` mm beside the mesh
    (negative: to the left) to the web, which comes down to the axis, or to a hollow shaft of half
    the width ``bore``. ``side`` -1: the lower half.
    """
    tooth = SIZES.teeth / 2 * (-1 if web > 0 else 1)
    out, beside = 1j * side * (radius + SIZES.mesh / 2), centre + web
    return [Stroke((centre + out + tooth, beside + out, beside + 1j * side * bore), tag=tag)]


def carrier_profile(pin: complex, centre: complex, *, reach: float, tag: str = "") -> list[Item]:
    """Return a carrier from the side: the planet's pin and an arm down to the axis (водило).

    ``pin`` is the middle of the planet, ``centre`` the point of the main axis below it; the arm
    stands ``reach`` mm beside the planet (negative: on its left). The shaft continues from the foot
    of the arm as a `link` of the caller.
    """
    along = unit(pin - centre) * (-1j if ((pin - centre) / 1j).real >= 0 else 1j)
    short = along * (SIZES.teeth / 2 + 1.5) * (1 if reach > 0 else -1)
    return [Stroke((pin - short, pin + along * reach, centre + along * reach), tag=tag)]
