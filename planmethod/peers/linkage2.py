"""Files of the program Linkage by David Rector, ``.linkage2`` (XML).

Coordinates are in 1/96 inch, y upwards. Connectors are points, ``Link`` elements bodies. Source
of the attributes: ``CLinkageDoc::WriteOut`` and files of users.
"""

from __future__ import annotations

import math
import re
from xml.etree import ElementTree

from planmethod.languages import translate
from planmethod.peers.foreign import (
    ForeignBody,
    ForeignDriver,
    ForeignMechanism,
    ForeignSlide,
    finite,
    reject,
)

MM = 25.4 / 96.0
"""Millimetres of a unit of the file."""

MECHANISM_LAYER = 16

_SHOWN = {
    "id", "selected", "name", "layer", "x", "y", "anchor", "input", "draw", "rpm", "slider",
    "color", "usercolor", "alwaysmanual", "fastenlink", "fastenconnector", "fasten", "slideradius",
    "linesize", "solid", "locked", "shapetype", "measurementelement", "actuator", "gear", "throw",
    "cpm", "drawcircle", "labelconnector",
}  # fmt: skip
"""Attributes that are read, or only change how the mechanism looks."""


def is_linkage2(text: str) -> bool:
    """Return whether a text is a file of Linkage."""
    return re.match(r"\s*(?:<\?xml[^>]*\?>\s*)?<linkage2[\s>]", text) is not None


def read_linkage2(text: str, source: str) -> ForeignMechanism:
    """Read a file of Linkage.

    Raises
    ------
    ProblemError
        It is not XML, or has a driver that planmethod lacks.
    """
    if re.search(r"<!\s*(?:DOCTYPE|ENTITY)", text, re.IGNORECASE):
        reject(source, "document types and entities are not allowed in a file of Linkage")
    try:
        root = ElementTree.fromstring(text)  # without entities it cannot grow
    except ElementTree.ParseError as error:
        reject(source, "this is not XML: {}", error)
    return _File(root, source).read()


class _File:
    def __init__(self, root: ElementTree.Element, source: str) -> None:
        self.root, self.source = root, source
        self.remarks: list[str] = []
        self.places: dict[str, complex] = {}
        self.names: dict[str, str] = {}

    def read(self) -> ForeignMechanism:
        """Read the connectors and links."""
        connectors = self._connectors()
        rigid_bodies = self._fastened(self._rigid_bodies(), connectors)
        program = self.root.find("program")
        scale = 1.0
        if program is not None:
            scale = finite(self.source, program.get("scalefactor", "1"), "scalefactor")
        if scale <= 0.0:
            reject(self.source, "scalefactor is {}, expected more than 0", scale)
        for child in self.root:
            if child.tag not in ("program", "connector", "Link", "element", "selected", "ratios"):
                if child.tag != "background" or child.text:
                    self.remarks.append(translate("<{}> is not read", child.tag))
            elif child.tag == "ratios" and len(child):
                reject(
                    self.source, "gears and chains of Linkage are not read",
                    hint="Delete them there, and give a train in [gears].",
                )  # fmt: skip
        fixed = {k for k, one in connectors.items() if one.get("anchor") == "true"}
        driver = self._driver(connectors, rigid_bodies)
        slides = tuple(
            slide for key, one in connectors.items()
            if one.get("slider") == "true" and (slide := self._slide(key, one, fixed, rigid_bodies))
        )  # fmt: skip
        on = {p for points in rigid_bodies.values() for p in points}
        on |= {p for slide in slides for p in slide.guide_points}
        return ForeignMechanism(
            program="Linkage",
            title="Linkage",
            unit="mm",
            points={k: self.places[k] * MM * scale for k in self.places if k in on},
            fixed=frozenset(fixed),
            rigid_bodies=tuple(ForeignBody(name, points) for name, points in rigid_bodies.items()),
            slides=slides,
            driver=driver,
            remarks=tuple(self.remarks),
        )

    def _connectors(self) -> dict[str, ElementTree.Element]:
        found = {}
        for one in self.root.findall("connector"):
            key = self._key(one)
            if key in found:
                reject(self.source, "connector {} is there twice", key)
            if not self._is_of_mechanism(one):
                continue
            self._note_unknown(one, "connector")
            x, y = (finite(self.source, one.get(a), f"{a} of connector {key}") for a in "xy")
            found[key], self.places[key] = one, complex(x, y)
        if not found:
            reject(self.source, "the file has no connectors")
        return found

    def _key(self, one: ElementTree.Element) -> str:
        key = one.get("id", "")
        if not re.fullmatch(r"\d{1,6}", key):
            reject(self.source, "{!r} is not a number of a connector or link", key[:20])
        return key

    def _is_of_mechanism(self, one: ElementTree.Element) -> bool:
        layer = one.get("layer", "")
        drawn = layer.isdecimal() and int(layer[:9]) and not int(layer[:9]) & MECHANISM_LAYER
        measured = one.get("measurementelement") == "true"
        if drawn or measured:
            self.remarks.append(
                translate("{} {} only draws or measures, and is not read", one.tag, one.get("id"))
            )
        return not (drawn or measured)

    def _note_unknown(self, one: ElementTree.Element, kind: str) -> None:
        for name in one.attrib:
            if name not in _SHOWN:
                message = "attribute {} of {} {} is not read"
                self.remarks.append(translate(message, name, kind, one.get("id")))

    def _rigid_bodies(self) -> dict[str, tuple[str, ...]]:
        found: dict[str, tuple[str, ...]] = {}
        self.links: dict[str, ElementTree.Element] = {}
        for one in (*self.root.findall("Link"), *self.root.findall("element")):
            key = self._key(one)
            if key in self.links:
                reject(self.source, "link {} is there twice", key)
            if not self._is_of_mechanism(one):
                continue
            self._note_unknown(one, "link")
            if one.get("gear") == "true":
                self.remarks.append(translate("link {} is read as a bar, not as a gear", key))
            ids = [self._key(child) for child in one if child.tag == "connector"]
            missing = [point for point in ids if point not in self.places]
            if missing:
                message = "link {} names connector {}, which is not there"
                reject(self.source, message, key, missing[0])
            if one.get("actuator") == "true":
                reject(
                    self.source, "link {} is an actuator: it is not read", key,
                    hint="Drive a crank; a cylinder is DE, v_DE in [driver].",
                )  # fmt: skip
            found[key], self.links[key] = tuple(ids), one
        return found

    def _fastened(
        self, rigid_bodies: dict[str, tuple[str, ...]], connectors: dict[str, ElementTree.Element]
    ) -> dict[str, tuple[str, ...]]:
        """Join links that are fastened together to one body."""
        for key, one in connectors.items():
            link = one.get("fastenlink") or one.get("fasten")
            if link in rigid_bodies and key not in rigid_bodies[link]:
                rigid_bodies[link] = (*rigid_bodies[link], key)
            elif one.get("fastenconnector"):
                self.remarks.append(translate("connector {} is fastened to another: not read", key))
        for key, body in self.links.items():
            other = body.get("fastenlink")
            if other in rigid_bodies and key in rigid_bodies and other != key:
                rigid_bodies[other] = tuple(
                    dict.fromkeys((*rigid_bodies[other], *rigid_bodies.pop(key)))
                )
            at = body.get("fastenconnector")
            if at in self.places and key in rigid_bodies:
                rigid_bodies[key] = tuple(dict.fromkeys((*rigid_bodies[key], at)))
        return rigid_bodies

    def _driver(
        self, connectors: dict[str, ElementTree.Element], rigid_bodies: dict[str, tuple[str, ...]]
    ) -> ForeignDriver:
        inputs = [key for key, one in connectors.items() if one.get("input") == "true"]
        if len(inputs) > 1:
            reject(self.source, "{} connectors are inputs: planmethod needs one", len(inputs))
        if not inputs:
            return ForeignDriver()
        fixed = {key for key, one in connectors.items() if one.get("anchor") == "true"}
        driven = [
            name for name, points in rigid_bodies.items()
            if inputs[0] in points and not {*points} <= fixed
        ]  # fmt: skip
        if inputs[0] not in fixed or len(driven) != 1:
            reject(
                self.source, "input {} does not join one link to the frame", inputs[0],
                hint="Drive a link that turns about an anchor.",
            )  # fmt: skip
        rpm = finite(self.source, connectors[inputs[0]].get("rpm", "0"), "rpm")
        if rpm:
            message = "rpm is read as counter-clockwise: change the sign of omega if it is not"
            self.remarks.append(translate(message))
        return ForeignDriver(driven[0], omega=rpm * math.pi / 30.0)

    def _slide(
        self,
        key: str,
        one: ElementTree.Element,
        fixed: set[str],
        rigid_bodies: dict[str, tuple[str, ...]],
    ) -> ForeignSlide | None:
        limits = [self._key(child) for child in one if child.tag == "slidelimit"]
        radius = one.get("slideradius")
        if radius is not None and finite(self.source, radius, "slideradius"):
            reject(
                self.source, "connector {} slides on a curve: it is not read", key,
                hint="A circular guide is slides = { on, centre, radius }.",
            )  # fmt: skip
        if len(limits) != 2 or not {*limits} <= {*self.places}:
            reject(self.source, "slider {} has no two ends of its slide", key)
        if {*limits} <= fixed:
            return ForeignSlide(key, guide_points=tuple(limits))
        host = next((name for name, points in rigid_bodies.items() if {*limits} <= {*points}), "")
        if not host:
            reject(self.source, "the ends of the slide of {} are not on one link", key)
        return ForeignSlide(key, host=host, guide_points=tuple(limits))
