"""``[[higher_pairs]]``: profiles that touch, and the links that replace them (высшие пары)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, HigherPair
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode
from planmethod.problem.links import Length, LinkText
from planmethod.problem.names import NAME_LIMIT, is_label, listed
from planmethod.problem.slides import FrameText
from planmethod.problem.tables import HigherPairSection


def read_higher(
    node: FileNode, links: dict[str, LinkText], frame: FrameText
) -> tuple[HigherPair, ...]:
    """Read ``[[higher_pairs]]`` and add the link that replaces each to the links.

    A bar between both centres of curvature moves the two links as their profiles do, velocities
    and accelerations too; where one profile is straight, a block that slides along it.
    """
    node.tables(keys.HIGHER_LIMIT, "{} pairs, the limit is {}")
    found: list[HigherPair] = []
    for entry in node.entries():
        pair = entry.attempt(_PairReader(links, frame, found).read)
        if pair is not None:
            found.append(pair)
    return tuple(found)


class _PairReader:
    """Reader of one pair."""

    def __init__(
        self, links: dict[str, LinkText], frame: FrameText, previous: list[HigherPair]
    ) -> None:
        self.links, self.frame = links, frame
        self.rollers = {pair.roller for pair in previous} - {""}
        self.names = {pair.name for pair in previous}

    def read(self, node: FileNode) -> HigherPair:
        """Read the pair and add its link."""
        given = node.record(
            HigherPairSection,
            name=FileNode.point_name,
            links=self._links,
            centres=_read_centres,
            distance=FileNode.length,
            slides=_read_profile,
            roller=self._number,
            by=self._number,
        )
        node.require_sound()
        name, ends, centres = given["name"], given["links"], given["centres"]
        if ends[0] == ends[1]:
            node["links"].reject("a pair is of two different links")
        for link, centre in zip(ends, centres, strict=False):
            own = self.frame.points if link == FRAME else self.links[link].points
            if centre not in own:
                owner = translate("the frame") if link == FRAME else translate("link {}", link)
                hint = translate("Its points are {}.", listed(own))
                node["centres"].note("{} has no point '{}'", owner, centre, hint=hint)
        used = {point for link in self.links.values() for point in link.points}
        if name in used | set(self.frame.points) | self.names:
            node["name"].note("another point has the name {}", name)
        straight = len(centres) == 1
        _check_form(node, straight=straight)
        node.require_sound()
        roller = given.get("roller", "")
        by = given.get("by") or self._free(roller)
        if roller and roller == by:
            node["by"].reject("link '{}' is given twice", by)
        self.links[by] = self._replacement(node, by, given)
        return HigherPair(name, tuple(ends), by, roller, centres[-1] if roller else "")

    def _replacement(self, node: FileNode, by: str, table: Mapping[str, Any]) -> LinkText:
        """Return the link that replaces the pair."""
        centres = table["centres"]
        link = LinkText(by, node, tuple(centres))
        if len(centres) == 1:
            link.slides = node["slides"]
            link.slides.value = {"on": table["links"][1], **table["slides"]}
        else:
            one, other = centres
            link.lengths.append(Length(f"{one}{other}", one, other, table["distance"]))
        return link

    def _links(self, node: FileNode) -> tuple[str, ...]:
        node.array("a list of two links", low=2, high=2)
        return node.read_all(self._link)

    def _link(self, node: FileNode) -> str:
        name, known = node.text(NAME_LIMIT), [FRAME, *self.links]
        if name not in known:
            node.reject_unknown(name, known, "unknown link '{}'")
        return name

    def _number(self, node: FileNode) -> str:
        name = node.text(NAME_LIMIT)
        if not is_label(name):
            node.reject("{!r} cannot name {}", name[:40], "a link")
        if name in self.links or name in self.rollers or name in (FRAME, self.frame.number):
            node.reject("link '{}' is given twice", name)
        return name

    def _free(self, roller: str) -> str:
        """Return the first free number after those of the links."""
        taken = {*self.links, *self.rollers, roller, self.frame.number}
        numbers = [int(name) for name in taken if name.isdecimal()]
        return str(max(numbers, default=0) + 1)


def _read_centres(node: FileNode) -> tuple[str, ...]:
    node.array("a list of one or two points", low=1, high=2)
    return node.read_all(FileNode.point_name)


def _read_profile(node: FileNode) -> object:
    return node.table('slides = { along = "DE" }')


def _check_form(node: FileNode, *, straight: bool) -> None:
    """Reject keys that do not go with the number of centres."""
    wanted, other = ("slides", "distance") if straight else ("distance", "slides")
    if other in node:
        hint = "With two centres give their distance."
        if straight:
            hint = "With one centre the second profile is straight: give slides."
        node[other].note("does not go with these centres", hint=hint)
    if wanted not in node:
        hint = "Give the distance of the centres: the sum of the radii."
        if straight:
            hint = 'Give the straight profile of the second link: slides = { along = "DE" }.'
        node[wanted].note("missing", hint=hint)
    if straight and "roller" in node:
        hint = "A roller has its centre on the second link: give both centres."
        node["roller"].note("does not go with these centres", hint=hint)
