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


# From the front -----------------------------------------------------------------------------------


def wheel_front(
    centre: complex, radius: float, *, touch: complex | None = None, tag: str = ""
) -> list[Item]:
    """Return a wheel from the front: pitch circle and centre lines (колесо, вид спереди).

    ``radius`` is that of the pitch circle, ``touch`` the pitch point, mm. The joint or support in
    the centre is drawn after it.
    """
    return [
        *pitch_circle(centre, radius, touch=touch, tag=tag),
        *centre_lines(centre, radius, tag=tag),
    ]


def mesh_front(
    first: complex, radius: float, second: complex, *, internal: bool = False, tag: str = ""
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
        *pitch_circle(first, radius, touch=point, tag=tag),
        *pitch_circle(second, other, touch=point, tag=tag),
        *centre_lines(first, radius, directions=(way * 1j,), tag=tag),
        *centre_lines(second, rim, directions=(way * 1j,), tag=tag),
    ]
    ends = [second - way * (rim + 3.0), second + way * (rim + 3.0)]
    if internal:
        items.append(Arc(second, rim, tag=tag))
    else:
        ends[0] = first - way * (radius + 3.0)
    items += axis_line(*ends, first, second, tag=tag)
    return [*items, Disc(point, PITCH_POINT, Ink.BLACK, tag=tag)]


def rack_front(
    start: complex, end: complex, *, side: int = -1, height: float = 5.0, tag: str = ""
) -> list[Item]:
    """Return a rack: its pitch line, dash-dot, and the outline of its back (рейка).

    ``side`` is where its body is: +1 on the left of the way from ``start`` to ``end``, -1 on the
    right. A wheel touches the pitch line.
    """
    down = unit(end - start) * (1j if side > 0 else -1j)
    teeth, back = down * height * 0.3, down * height
    body = (start + teeth, start + back, end + back, end + teeth)
    over = unit(end - start) * 3.0
    return [
        Stroke(body, tag=tag, closed=True),
        *axis_line(start - over, end + over, (start + end) / 2, tag=tag),
    ]


# From the side ------------------------------------------------------------------------------------


def wheel_profile(
    centre: complex,
    radius: float,
    *,
    axis: complex = 1 + 0j,
    ways: tuple[int, ...] = (1, -1),
    loose: bool = False,
    factor: float = 1.0,
    tag: str = "",
) -> list[Item]:
    """Return a wheel from the side: its disc and a cross-bar at the teeth (колесо, вид сбоку).

    Parameters
    ----------
    centre : complex, mm
        On the axis.
    radius : float, mm
        Pitch radius; the cross-bar stands half a mesh inside it.
    axis : complex
        Direction of the axis.
    ways : tuple of int
        Which halves are drawn: +1 on the left of the axis, -1 on the right.
    loose : bool
        The wheel turns on its shaft: a hub of two cross-bars with the shaft between them (колесо
        на подшипнике). Otherwise it is fixed to it.
    """
    along = unit(axis)
    tooth = along * SIZES.teeth / 2 * factor
    hub = along * SIZES.teeth / 2 * factor
    rim = radius - SIZES.mesh / 2 * factor
    root = SIZES.mesh / 2 * factor if loose else 0.0
    items: list[Item] = []
    for way in ways:
        out = along * 1j * way
        items.append(Stroke((centre + out * root, centre + out * rim), tag=tag))
        items.append(Stroke((centre + out * rim - tooth, centre + out * rim + tooth), tag=tag))
        if loose:
            items.append(Stroke((centre + out * root - hub, centre + out * root + hub), tag=tag))
    return items


def ring_profile(
    centre: complex,
    radius: float,
    *,
    axis: complex = 1 + 0j,
    ways: tuple[int, ...] = (1,),
    stem: float = 6.0,
    factor: float = 1.0,
    tag: str = "",
) -> list[Item]:
    """Return a fixed wheel with inner teeth from the side (неподвижное колесо).

    Its cross-bar stands half a mesh outside the pitch radius; from there a stem of ``stem`` mm goes
    to the hatched frame.
    """
    along = unit(axis)
    tooth = along * SIZES.teeth / 2 * factor
    rim = radius + SIZES.mesh / 2 * factor
    base = along * SIZES.base / 2 * factor
    items: list[Item] = []
    for way in ways:
        out = along * 1j * way
        foot = centre + out * (rim + stem * factor)
        items.append(Stroke((centre + out * rim - tooth, centre + out * rim + tooth), tag=tag))
        items.append(Stroke((centre + out * rim, foot), tag=tag))
        items += ground_line(foot - base, foot + base, side=way, factor=factor)
    return items


def bell_profile(
    centre: complex,
    radius: float,
    *,
    web: float,
    axis: complex = 1 + 0j,
    ways: tuple[int, ...] = (1,),
    factor: float = 1.0,
    tag: str = "",
) -> list[Item]:
    """Return a wheel with inner teeth that turns, from the side (колесо с внутренними зубьями).

    Its rim stands half a mesh outside the pitch radius and goes ``web`` mm beside the mesh
    (negative: against the axis) to the web, which comes down to the axis.
    """
    along = unit(axis)
    tooth = along * SIZES.teeth / 2 * factor * (-1 if web > 0 else 1)
    rim = radius + SIZES.mesh / 2 * factor
    items: list[Item] = []
    for way in ways:
        out = along * 1j * way * rim
        beside = centre + along * web
        items.append(Stroke((centre + out + tooth, beside + out, beside), tag=tag))
    return items


def carrier_profile(pin: complex, centre: complex, *, reach: float, tag: str = "") -> list[Item]:
    """Return a carrier from the side: the planet's pin and an arm down to the axis (водило).

    ``pin`` is the middle of the planet, ``centre`` the point of the main axis below it; the arm
    stands ``reach`` mm beside the planet (negative: on its left). The shaft goes on from the foot
    of the arm: a `link` of the caller.
    """
    along = unit(pin - centre) * (-1j if ((pin - centre) / 1j).real >= 0 else 1j)
    short = along * (SIZES.teeth / 2 + 1.5) * (1 if reach > 0 else -1)
    return [Stroke((pin - short, pin + along * reach, centre + along * reach), tag=tag)]
