"""Mechanisms written in one line each, for the tests of structure."""

from __future__ import annotations

from doors import Mechanism, Prismatic, Revolute


def mechanism(points: str, slides: str = "", driver: str = "1") -> Mechanism:
    """Make a mechanism from ``A:01 B:12`` (point: links) and ``2/3@B`` (slider/host@pin).

    Links are single digits, in numeric order.
    """
    revolutes = tuple(
        Revolute(name, tuple(links)) for name, links in (word.split(":") for word in points.split())
    )
    prismatics = []
    for word in slides.split():
        pair, pin = word.split("@")
        slider, host = pair.split("/")
        prismatics.append(Prismatic(slider, host, pin))
    used = {link for joint in revolutes for link in joint.links}
    used |= {link for pair in prismatics for link in (pair.slider, pair.host)}
    return Mechanism(tuple(sorted(used - {"0"})), revolutes, tuple(prismatics), driver)


EX1 = mechanism("A:01 B:12 C:23", "3/0@C")
EX2 = mechanism("O:01 A:12 B:23 C:03")
EX3 = mechanism("A:01 C:03 B:12 D:34 E:45", "2/3@B 5/0@E")
SIX_LINK = mechanism("A:01 D:03 B:12 C:23 H:45", "4/2@H 5/0@H")
TASK12 = mechanism("A:01 C:03 B:12 D:34", "2/3@B 4/5@D 5/0@E")
PRESS = mechanism("O:01 P:03 A:12 B:34 D:45", "2/3@A 5/0@D")

TRIAD = mechanism("A:01 B:13 C:23 D:24 E:25 F:04 G:05")
CLASS_IV = mechanism("A:01 B:12 C:23 D:34 E:45 F:25 G:04")
