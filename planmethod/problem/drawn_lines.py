"""Lines and axes that a figure shows by the coordinates of its points (линии рисунка)."""

# no messages: their own readers report faulty values

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeVar

from planmethod.mechanism.model import FRAME
from planmethod.problem.faults import Faults
from planmethod.problem.figure_checks import SAME
from planmethod.problem.file_node import FileNode
from planmethod.problem.joints import DRAWN
from planmethod.problem.names import fold, split_pair
from planmethod.problem.placement import heading, rotation

Value = TypeVar("Value")


def plain_name(text: str) -> str:
    """Return a name without look-alike letters, which its own reader reports."""
    meant = fold(text)
    return meant if meant.isascii() else text


class DrawnLines:
    """Lines of slides and guides, and own axes of links, in the position of a figure.

    Parameters
    ----------
    file : FileNode
        The whole problem file.
    places : dict of str to complex, m
        Coordinates of the points; fixed points that have others in ``[frame]`` are added.
    """

    def __init__(self, file: FileNode, places: dict[str, complex]) -> None:
        self.file, self.z = file, places
        self.links: dict[str, dict[str, Any]] = {}
        self.axes: dict[str, tuple[str, str]] = {}
        spread = [*places.values()]
        self.extent = max(abs(one - spread[0]) for one in spread) or 1.0

    def read(self, value: object, read: Callable[[FileNode], Value]) -> Value | None:
        """Return a value that the file has; None if it is faulty, as its own reader reports."""
        faults = Faults()
        faults.unit, faults.names = self.file.faults.unit, self.file.faults.names
        return FileNode(faults, value).attempt(read)

    def course(self, link: str, depth: int = 0) -> complex | None:
        """Return the direction of a slide in the figure."""
        line = self.line(link, depth)
        return None if line is None else line[1]

    def line(self, link: str, depth: int = 0) -> tuple[complex, complex] | None:
        """Return a point and the direction of the line of a slide in the figure."""
        slides = self.links[link].get("slides")
        if not isinstance(slides, Mapping) or depth > len(self.links):
            return None
        on = plain_name(str(slides.get("on")))
        guides = self.file["frame"]["guides"].value
        if isinstance(guides, Mapping) and on in guides:
            return self.guide(on)
        along = slides.get("along")
        pair = split_pair(plain_name(along)) if isinstance(along, str) else None
        if pair is not None and {*pair} <= {*self.z}:
            vector = self.z[pair[1]] - self.z[pair[0]]
            return (self.z[pair[0]], vector / abs(vector)) if vector else None
        through = slides.get("through")
        angle = self.read(slides.get("angle", 0.0), FileNode.angle)
        if not isinstance(through, str) or angle is None or through not in self.z:
            return None
        if on == FRAME or self._only_translates(on):
            return self.z[through], rotation(angle)
        axis = self.axis(on, depth)
        return None if axis is None else (self.z[through], axis * rotation(angle))

    def axis(self, link: str, depth: int) -> complex | None:
        """Return the direction of the own axis of a link in the figure."""
        table = self.links.get(link)
        if table is None:
            return None
        if "slides" in table:
            return self.course(link, depth + 1)
        names = self.axes.get(link)
        if names is None:
            return None
        vector = self.z[names[1]] - self.z[names[0]] if {*names} <= {*self.z} else 0
        return vector / abs(vector) if vector else None

    def _only_translates(self, link: str) -> bool:
        """Return whether a link slides on the frame, or on a link that does."""
        guides = self.file["frame"]["guides"].value
        seen: set[str] = set()
        while link in self.links and link not in seen:
            seen.add(link)
            slides = self.links[link].get("slides")
            if not isinstance(slides, Mapping):
                return False
            link = plain_name(str(slides.get("on")))
        return link == FRAME or (isinstance(guides, Mapping) and link in guides)

    def guide(self, name: str) -> tuple[complex, complex] | None:
        """Return a point and the direction of a guide of the frame."""
        guide = self.file["frame"]["guides"][name].value
        if not isinstance(guide, Mapping):
            return None
        through, angle = guide.get("through"), guide.get("angle")
        base: complex | None
        if isinstance(through, str) and through != DRAWN:
            base = self.z.get(plain_name(through))
        elif through == DRAWN or (isinstance(through, list) and DRAWN in through):
            base = self._pin_on(name)
            if isinstance(through, list) and base is not None and len(through) == 2:
                known = [self.read(one, FileNode.coordinate) for one in through]
                base = complex(
                    *(
                        part if one is None else one
                        for one, part in zip(known, (base.real, base.imag), strict=True)
                    )
                )
        else:
            base = self.read(through, FileNode.place)
        if base is None:
            return None
        if angle == DRAWN:
            pin = self._pin_on(name, base)
            vector = 0j if pin is None else pin - base
            if abs(vector) <= SAME * self.extent:
                return None
            degrees = heading(vector)  # a line has no sense of its own
            degrees = degrees - 180.0 if degrees > 90.0 else degrees
            return base, rotation(degrees + 180.0 if degrees <= -90.0 else degrees)
        number = self.read(angle, FileNode.angle)
        return None if number is None else (base, rotation(number))

    def _pin_on(self, guide: str, base: complex | None = None) -> complex | None:
        """Return a pin on a guide, at some distance from a point of it."""
        for table in self.links.values():
            slides, points = table.get("slides"), table.get("points")
            if not (isinstance(slides, Mapping) and isinstance(points, list) and points):
                continue
            pin = self.z.get(plain_name(str(points[0])))
            if slides.get("on") != guide or pin is None or "offset" in slides:
                continue
            if base is None or abs(pin - base) > SAME * self.extent:
                return pin
        return None
