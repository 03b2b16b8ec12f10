"""Letters of the source for points that coincide: ``[letters]`` (обозначения источника)."""

# Cyrillic letters: examples of letters that a file may give
from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from functools import partial

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import Body, Letters, Slide
from planmethod.problem.names import indexed, listed

BALANCE_LIMIT = 40
_PLACE_RE = r"(?P<place>\S+) on (?P<link>.+)\Z"
_BALANCE_RE = r"[A-Z](?:[^\W_]|_\{[^\W_]+\}|\^\{[^\W_]+\})*\Z"
_EXAMPLE = 'points.L = "H on 2"'


def read_letters(
    node: FileNode,
    bodies_by_link: Mapping[str, Body],
    slides: Iterable[Slide],
    points: Collection[str],
) -> Letters:
    """Read ``[letters]``.

    Parameters
    ----------
    points : collection of str
        Names that quantities may use, ``B3`` of a point under a pin among them.
    """
    node.table(_EXAMPLE)
    at = {(slide.pin, slide.host) for slide in slides if slide.host != FRAME}
    at |= {(slide.through, slide.slider) for slide in slides if slide.through is not None}
    at |= {
        (point, link)
        for link, body in bodies_by_link.items()
        if link != FRAME
        for point in body.points
    }
    read = partial(_read_points, at=at, bodies_by_link=bodies_by_link, points=points)
    return Letters(**node.record(Letters, points=read, balance=_read_balance))


def _read_points(
    node: FileNode,
    at: Collection[tuple[str | None, str]],
    bodies_by_link: Mapping[str, Body],
    points: Collection[str],
) -> dict[str, tuple[str, str]]:
    """Read the letters of points, each by its place and link."""
    node.table(_EXAMPLE)
    taken: dict[tuple[str, str], str] = {}
    small = {point.casefold(): point for point in points}

    def read(entry: FileNode) -> tuple[str, str]:
        name = entry.check_point_name(str(entry.key))
        text = entry.text(BALANCE_LIMIT)
        found = re.match(_PLACE_RE, entry.unmask(text))
        if found is None:
            entry.reject_value("a place and a link", translate("For example: {}", _EXAMPLE))
        place, link = found["place"], found["link"]
        links = [known for known in bodies_by_link if known != FRAME]
        if link not in links:
            entry.reject_unknown(link, links, "unknown link '{}'")
        if (place, link) not in at:
            known = [point for point, of in at if of == link and point is not None]
            hint = translate("Its points are {}.", listed(sorted(known)))
            entry.reject("link {} has no point '{}'", link, place, hint=hint)
        own = place if place in bodies_by_link[link].points else f"{place}{link}"
        other = small.get(name.casefold())
        if other is not None and other not in (place, own):
            entry.reject(
                "{} is also the name of another point", other, hint="Give it another letter."
            )
        twin = taken.setdefault((place, link), name)
        if twin != name:
            entry.reject("the point of link {} at {} has the letter {} too", link, place, twin,
                         hint="Keep one of them.")  # fmt: skip
        small[name.casefold()] = name
        return place, link

    return node.read_each(read)


def _read_balance(node: FileNode) -> str:
    text = node.text(BALANCE_LIMIT)
    if not re.match(_BALANCE_RE, text):
        node.reject_value("a letter with its indices", "For example: M_{1}, M_{1д}, F_{д}.")
    return indexed(text)
