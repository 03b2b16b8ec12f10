"""``[[higher_pairs]]``: profiles that touch, and the links that replace them (высшие пары)."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, HigherPair
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
from planmethod.problem.flat_tables import read_flat
from planmethod.problem.links import Length, LinkText
from planmethod.problem.names import NAME_LIMIT, is_label, listed
from planmethod.problem.slides import FrameText
from planmethod.problem.tables import HigherPairSection

EXAMPLE = 'links = ["1", "2"]'


def read_higher(
    faults: Faults, value: object, links: dict[str, LinkText], frame: FrameText
) -> tuple[HigherPair, ...]:
    """Read ``[[higher_pairs]]`` and add the link that replaces each to the links.

    A bar between both centres of curvature moves the two links as their profiles do, velocities
    and accelerations too; where one profile is straight, a block that slides along it.
    """
    if not isinstance(value, list) or not all(isinstance(item, Mapping) for item in value):
        faults.expected("higher_pairs", "tables [[higher_pairs]]", value)
        return ()
    if faults.exceeds("higher_pairs", "{} pairs, the limit is {}", len(value), keys.HIGHER_LIMIT):
        return ()
    found: list[HigherPair] = []
    for index, table in enumerate(value):
        before = len(faults)
        reader = _Reader(faults, f"higher_pairs[{index}]", links, frame, found)
        pair = reader.read(table)
        if pair is not None and len(faults) == before:
            found.append(pair)
    return tuple(found)


class _Reader:
    """Reader of one pair."""

    def __init__(
        self,
        faults: Faults,
        path: str,
        links: dict[str, LinkText],
        frame: FrameText,
        previous: list[HigherPair],
    ) -> None:
        self.faults, self.path, self.links, self.frame = faults, path, links, frame
        self.rollers = {pair.roller for pair in previous} - {""}
        self.names = {pair.name for pair in previous}

    def read(self, table: Table) -> HigherPair | None:
        """Read the pair and add its link; None after noting a fault."""
        faults, path, before = self.faults, self.path, len(self.faults)
        read = {
            "name": fields.read_point_name,
            "links": self._list(self._link, 2, 2),
            "centres": self._list(fields.read_point_name, 1, 2),
            "distance": fields.read_length,
            "slides": lambda faults, path, value: fields.read_table(
                faults, path, value, 'slides = { along = "DE" }'
            ),
            "roller": self._number,
            "by": self._number,
        }
        given = read_flat(faults, path, table, HigherPairSection, read)
        if len(faults) != before:
            return None
        ends, centres = given["links"], given["centres"]
        if ends[0] == ends[1]:
            faults.add(f"{path}.links", "a pair is of two different links")
            return None
        for link, centre in zip(ends, centres, strict=False):
            own = self.frame.points if link == FRAME else self.links[link].points
            if centre not in own:
                owner = translate("the frame") if link == FRAME else translate("link {}", link)
                hint = translate("Its points are {}.", listed(own))
                faults.add(
                    f"{path}.centres", translate("{} has no point '{}'", owner, centre), hint
                )
        used = {point for link in self.links.values() for point in link.points}
        if given["name"] in used | set(self.frame.points) | self.names:
            faults.add(f"{path}.name", translate("another point has the name {}", given["name"]))
        straight = len(centres) == 1
        self._check_form(given, straight=straight)
        if len(faults) != before:
            return None
        roller, by = given.get("roller", ""), given.get("by") or self._free(given.get("roller", ""))
        if roller and roller == by:
            faults.add(f"{path}.by", translate("link '{}' is given twice", by))
            return None
        link = LinkText(by, tuple(centres), location=path)
        if straight:
            link.slides = {"on": ends[1], **given["slides"]}
        else:
            link.lengths.append(Length("".join(centres), centres[0], centres[1], given["distance"]))
        self.links[by] = link
        return HigherPair(given["name"], tuple(ends), by, roller, centres[-1] if roller else "")

    def _check_form(self, table: Mapping[str, object], *, straight: bool) -> None:
        faults, path = self.faults, self.path
        wanted, other = ("slides", "distance") if straight else ("distance", "slides")
        if other in table:
            hint = (
                "With one centre the second profile is straight: give slides."
                if straight
                else "With two centres give their distance."
            )
            faults.add(f"{path}.{other}", "does not go with these centres", hint)
        if wanted not in table:
            hint = (
                'Give the straight profile of the second link: slides = { along = "DE" }.'
                if straight
                else "Give the distance of the centres: the sum of the radii."
            )
            faults.add(f"{path}.{wanted}", "missing", hint)
        if straight and "roller" in table:
            hint = "A roller has its centre on the second link: give both centres."
            faults.add(f"{path}.roller", "does not go with these centres", hint)

    def _list(
        self, item: Callable[[Faults, str, object], str | None], low: int, high: int
    ) -> Callable[[Faults, str, object], tuple[str, ...] | None]:
        def read(faults: Faults, path: str, value: object) -> tuple[str, ...] | None:
            if not isinstance(value, list) or not low <= len(value) <= high:
                what = "a list of two links" if low == high else "a list of one or two points"
                faults.expected(path, what, value)
                return None
            read = [item(faults, f"{path}[{k}]", one) for k, one in enumerate(value)]
            return None if None in read else tuple(one for one in read if one is not None)

        return read

    def _link(self, faults: Faults, path: str, value: object) -> str | None:
        name = fields.read_text(faults, path, value, limit=NAME_LIMIT)
        if name is not None and name not in (FRAME, *self.links):
            fields.report_unknown(
                faults, path, name, [FRAME, *self.links], message="unknown link '{}'"
            )
            return None
        return name

    def _number(self, faults: Faults, path: str, value: object) -> str | None:
        name = fields.read_text(faults, path, value, limit=NAME_LIMIT)
        if name is None:
            return None
        if not is_label(name):
            faults.add(path, translate("{!r} cannot name {}", name[:40], "a link"))
        elif name in self.links or name in self.rollers or name in (FRAME, self.frame.number):
            faults.add(path, translate("link '{}' is given twice", name))
        else:
            return name
        return None

    def _free(self, roller: str) -> str:
        """Return the first free number after those of the links."""
        taken = {*self.links, *self.rollers, roller, self.frame.number}
        numbers = [int(name) for name in taken if name.isdecimal()]
        return str(max(numbers, default=0) + 1)
