"""Texts of the problem files behind the hard cases: textbook mechanisms, turned, scaled, moved.

Every function returns the text of a file. Lengths are in m, angles in degrees; ``turn`` turns the
whole mechanism about the origin. Lengths are mostly eighths of a metre, so that an exact dead
position is exact in float64 as well, unless the mechanism is turned.
"""

from __future__ import annotations

import math

from planmethod.plans.draft import cis


def _pair(z: complex) -> str:
    return f"[{z.real!r}, {z.imag!r}]"


def _crank(link: str, phi: float, omega: float, epsilon: float) -> str:
    return f'[driver]\nlink = "{link}"\nphi = {phi!r}\nomega = {omega!r}\nepsilon = {epsilon!r}\n'


def slider_crank(
    *,
    phi: float = 50.0,
    turn: float = 0.0,
    crank: float = 0.125,
    rod: float = 0.375,
    offset: float = 0.0,
    omega: float = 12.0,
    epsilon: float = 0.0,
    origin: complex = 0j,
    size: float = 1.0,
) -> str:
    """Return a slider-crank driven by its crank; S is a point beside its rod."""
    crank, rod, offset = crank * size, rod * size, offset * size
    u = cis(turn)
    return f"""
[frame]
O = {_pair(origin)}
guides.x-x = {{ through = "O", angle = {turn!r} }}
[links.1]
points = ["O", "A"]
OA = {crank!r}
[links.2]
points = ["A", "B", "S"]
AB = {rod!r}
S = {{ on = "AB", at = {rod / 2!r}, across = {rod / 8!r} }}
[links.3]
points = ["B"]
slides = {{ on = "x-x", offset = {offset!r} }}
[assembly]
B = {{ near = {_pair(origin + u * (rod + crank))} }}
{_crank("1", phi + turn, omega, epsilon)}"""


def driven_by_slider(
    *,
    s: float = 0.4375,
    turn: float = 0.0,
    crank: float = 0.125,
    rod: float = 0.375,
    v: float = 0.5,
    a: float = 0.0,
    start: float = 0.0,
) -> str:
    """Return a slider-crank driven by its slider, like an engine; s counts from ``start``."""
    u = cis(turn)
    return f"""
[frame]
O = [0.0, 0.0]
guides.x-x = {{ through = {_pair(u * start)}, angle = {turn!r} }}
[links.1]
points = ["O", "A"]
OA = {crank!r}
[links.2]
points = ["A", "B", "S"]
AB = {rod!r}
S = {{ on = "AB", at = {rod / 2!r}, across = {rod / 8!r} }}
[links.3]
points = ["B"]
slides = {{ on = "x-x" }}
[assembly]
A = "left of OB"
[driver]
link = "3"
s = {s!r}
v = {v!r}
a = {a!r}
"""


def rocker(
    *,
    phi: float = 70.0,
    turn: float = 0.0,
    crank: float = 0.125,
    rod: float = 0.5,
    arm: float = 0.375,
    frame: float = 0.5,
    omega: float = 12.0,
    epsilon: float = 0.0,
    origin: complex = 0j,
    by_rocker: bool = False,
    third: str | None = None,
) -> str:
    """Return a rocker mechanism (four-bar linkage) driven by its crank or by its rocker.

    At phi = 90 of the rocker, the rocker CB is square to the frame OC, and the crank OA and the
    rod AB are in one line. ``third`` places the point S of the rod.
    """
    third = third or f'S = {{ on = "AB", at = {rod / 2!r}, across = {rod / 8!r} }}'
    rule = 'A = "left of OB"' if by_rocker else 'B = "left of AC"'
    return f"""
[frame]
O = {_pair(origin)}
C = {_pair(origin + frame * cis(turn))}
[links.1]
points = ["O", "A"]
OA = {crank!r}
[links.2]
points = ["A", "B", "S"]
AB = {rod!r}
{third}
[links.3]
points = ["C", "B"]
CB = {arm!r}
[assembly]
{rule}
{_crank("3" if by_rocker else "1", phi + turn, omega, epsilon)}"""


def touching_line(*, gap: float, turn: float = 0.0) -> str:
    """Return a slider-crank whose rod exceeds the distance to its guide by a fraction ``gap``."""
    foot = cis(turn) * (0.0625 - 0.25j)
    near = cis(turn) * (1 - 0.25j)
    return f"""
[frame]
O = [0.0, 0.0]
guides.x-x = {{ through = {_pair(foot)}, angle = {turn!r} }}
[links.1]
points = ["O", "A"]
OA = 0.125
[links.2]
points = ["A", "B"]
AB = {0.375 * (1 + gap)!r}
[links.3]
points = ["B"]
slides = {{ on = "x-x" }}
[assembly]
B = {{ near = {_pair(near)} }}
{_crank("1", 90.0 + turn, 12.0, 0.0)}"""


def slotted(
    *,
    phi: float = 30.0,
    turn: float = 0.0,
    pivot: complex = 0.1875 + 0j,
    offset: float = 0.0,
    omega: float = 12.0,
    epsilon: float = 0.0,
    origin: complex = 0j,
    size: float = 1.0,
) -> str:
    """Return a slotted link (кулиса) about C, its sliding block on the pin A of a 0.125 m crank."""
    return f"""
[frame]
O = {_pair(cis(turn) * origin * size)}
C = {_pair(cis(turn) * pivot * size)}
[links.1]
points = ["O", "A"]
OA = {0.125 * size!r}
[links.2]
points = ["A"]
slides = {{ on = "3", along = "CD", offset = {offset * size!r} }}
[links.3]
points = ["C", "D"]
CD = {0.375 * size!r}
{_crank("1", phi + turn, omega, epsilon)}"""


def pin_from_pivot(
    *, distance: float, turn: float = 0.0, offset: float = 0.0, size: float = 1.0
) -> str:
    """Return a slotted link whose pin is at a distance from its pivot, the crank at 0 deg."""
    pivot = 0.125 + distance * (0.6 + 0.8j)
    return slotted(phi=0.0, turn=turn, pivot=pivot, offset=offset, size=size)


def pivot_at_origin() -> str:
    """Return a slotted link whose pin meets its pivot at the origin, the crank at 0 deg."""
    return slotted(origin=-0.125 + 0j, pivot=0j)


def swinging_block(*, distance: float) -> str:
    """Return a crank whose rod slides through a block, the crank pin near the block's pivot."""
    return f"""
[frame]
O = [0.0, 0.0]
C = {_pair(0.125 + distance * (0.6 + 0.8j))}
[links.1]
points = ["O", "A"]
OA = 0.125
[links.2]
points = ["A", "K"]
AK = 0.375
[links.3]
points = ["C"]
slides = {{ on = "2", along = "AK" }}
{_crank("1", 0.0, 12.0, 0.0)}"""


def tangent_slide(*, phi: float = 40.0, turn: float = 0.0, omega: float = 12.0) -> str:
    """Return a sliding block on a crank's line and on a guide (PRP), parallel at phi = 0."""
    return f"""
[frame]
O = [0.0, 0.0]
guides.x-x = {{ through = {_pair(cis(turn) * 0.25j)}, angle = {turn!r} }}
[links.1]
points = ["O", "K"]
OK = 0.125
[links.2]
points = ["B"]
slides = {{ on = "1", along = "OK" }}
[links.3]
points = ["B"]
slides = {{ on = "x-x" }}
{_crank("1", phi + turn, omega, 0.0)}"""


def leaning_guide(*, angle: float, turn: float = 0.0) -> str:
    """Return a slider-crank whose guide leans at an angle to the ray square to its rod."""
    rod = cis(turn - 60.0) * 0.375
    pin = cis(turn + 90.0) * 0.125
    return f"""
[frame]
O = [0.0, 0.0]
guides.x-x = {{ through = {_pair(pin + rod)}, angle = {turn + 30.0 - angle!r} }}
[links.1]
points = ["O", "A"]
OA = 0.125
[links.2]
points = ["A", "B"]
AB = 0.375
[links.3]
points = ["B"]
slides = {{ on = "x-x" }}
[assembly]
B = {{ near = {_pair(pin + rod)} }}
{_crank("1", 90.0 + turn, 12.0, 0.0)}"""


def cross_slide(
    *,
    angle: float = 70.0,
    turn: float = 0.0,
    omega: float = 12.0,
    origin: complex = 0j,
    size: float = 1.0,
) -> str:
    """Return a bar on a guide with an inclined slot for a sliding block on the crank (RPP)."""
    return f"""
[frame]
O = {_pair(origin)}
guides.x-x = {{ through = "O", angle = {turn!r} }}
[links.1]
points = ["O", "A"]
OA = {0.125 * size!r}
[links.2]
points = ["A"]
slides = {{ on = "3", through = "E", angle = {turn + angle!r} }}
[links.3]
points = ["E"]
slides = {{ on = "x-x" }}
{_crank("1", 50.0 + turn, omega, 0.0)}"""


def lay_beside(distance: float, *, at: float = 0.25) -> str:
    """Return the place of the rod's third point beside a line."""
    return f'S = {{ on = "AB", at = {at!r}, across = {distance!r} }}'


def lay_needle(excess: float) -> str:
    """Return the third point by two lengths that exceed the rod of 0.5 m by a share."""
    return f'AS = {0.25 * (1 + excess)!r}\nBS = {0.25 * (1 + excess)!r}\nS.side = "left of AB"'


def lay_close(distance: float) -> str:
    """Return the third point by two lengths, at a distance from the far end of a rod of 0.5 m."""
    length = math.hypot(0.5 - 0.3 * distance, 0.9 * distance)
    return f'AS = {length!r}\nBS = {distance!r}\nS.side = "left of AB"'


def depart(crank: float, rod: float, angle: float) -> float:
    """Return how far a slider is from its outer dead place, the crank ``angle`` rad from it.

    Without the cancellation of the dead place minus the slider's place.
    """
    leg = crank * math.sin(angle)
    return 2 * crank * math.sin(angle / 2) ** 2 + leg * leg / (rod + math.sqrt(rod**2 - leg**2))


def stretched(crank: float, rod: float, arm: float, frame: float) -> float:
    """Return the crank's angle where it is in one line with the rod, degrees."""
    far = rod + crank
    return math.degrees(math.acos((far**2 + frame**2 - arm**2) / (2 * far * frame)))


def folded(crank: float, rod: float, arm: float, frame: float) -> float:
    """Return the crank's angle where it lies over the rod, degrees."""
    short = rod - crank
    return 180.0 + math.degrees(math.acos((short**2 + frame**2 - arm**2) / (2 * short * frame)))


def abreast(*, gap: float, turn: float = 0.0, inside: bool = False) -> str:
    """Return a rocker mechanism whose two arcs touch but for a share ``gap``, the crank at 0 deg.

    From outside the outer joints are nearer by the gap than the sum of the radii, from inside
    farther by it than their difference.
    """
    rod, arm = 0.5, 0.25
    apart = (rod - arm) * (1 + gap) if inside else (rod + arm) * (1 - gap)
    return rocker(phi=0.0, turn=turn, rod=rod, arm=arm, frame=0.125 + apart)


def add_fixed(text: str, place: complex) -> str:
    """Return a text with a fixed point F that belongs to no link."""
    return text.replace("[frame]\n", f"[frame]\nF = {_pair(place)}\n")


def line_of_one_place() -> str:
    """Return a slotted link whose slot is named by two points at one place."""
    text = slotted()
    return (
        text.replace('["C", "D"]', '["C", "D", "E"]')
        .replace("CD = 0.375", 'CD = 0.375\nE = { on = "CD", at = 0.0 }')
        .replace('along = "CD"', 'along = "CE"')
    )


def crank_of_one_place() -> str:
    """Return a rocker mechanism whose crank pin is at the crank's pivot."""
    text = rocker()
    return text.replace('["O", "A"]', '["O", "A", "K"]').replace(
        "OA = 0.125", 'OK = 0.125\nA = { on = "OK", at = 0.0 }'
    )
