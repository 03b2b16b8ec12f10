"""Letters of the source for points that coincide: ``[letters]`` (обозначения источника)."""

# Cyrillic letters: examples of letters that a file may give
from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from functools import partial

from planmethod.errors import Fault
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import Body, Letters, Size, Slide
from planmethod.problem.names import indexed, listed, nearest_name, split_pair

BALANCE_LIMIT = 40
_PLACE_RE = r"(?P<place>\S+) on (?P<link>.+)\Z"
_BALANCE_RE = r"[A-Z](?:[^\W_]|_\{[^\W_]+\}|\^\{[^\W_]+\})*\Z"
_SIZE_RE = r"[^\W\d_](?:_?\w{1,3})?\Z"
_OF_LINKS = "ωεφmGJ"
"""First letters of quantities that links have."""
_SIZE_EXAMPLE = 'sizes.a = "x A D"'
_EXAMPLE = 'points.L = "H on 2"'


def read_letters(
    node: FileNode,
    bodies_by_link: Mapping[str, Body],
    slides: Iterable[Slide],
    points: Collection[str],
    fixed: Collection[str],
) -> Letters:
    """Read ``[letters]``.

    Parameters
    ----------
    points : collection of str
        Names that quantities may use, ``B3`` of a point under a pin among them.
    fixed : collection of str
        Points and guides of the frame.
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
    links = [link for link in bodies_by_link if link != FRAME]
    sizes = partial(_read_sizes, fixed=fixed, points=points, links=links)
    return Letters(**node.record(Letters, points=read, balance=_read_balance, sizes=sizes))


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


def _read_sizes(
    node: FileNode, fixed: Collection[str], points: Collection[str], links: Collection[str]
) -> dict[str, Size]:
    """Read the letters of distances in the frame."""
    node.table(_SIZE_EXAMPLE)
    letters: dict[tuple[str, frozenset[str]], str] = {}

    def read(entry: FileNode) -> Size:
        letter = entry.unmask(str(entry.key))
        if not re.match(_SIZE_RE, letter):
            hint = "A letter, perhaps with an index: a, b_1."
            entry.reject("expected the letter of a size, got {}", letter, hint=hint)
        if _is_quantity_letter(letter, points, links):
            hint = "Give it another letter."
            entry.reject("{} is the letter of another quantity", letter, hint=hint)
        axis, _, ends = entry.unmask(entry.text(BALANCE_LIMIT)).partition(" ")
        pairs = [(one, two) for one in fixed for two in fixed if f"{one} {two}" == ends]
        if axis not in ("x", "y") or not pairs or pairs[0][0] == pairs[0][1]:
            known = translate("The frame has {}.", listed(fixed))
            hint = translate("For example: {}", f"{_SIZE_EXAMPLE}. {known}")
            entry.reject_value("x or y, and two points or guides of the frame", hint)
        twin = letters.setdefault((axis, frozenset(pairs[0])), letter)
        if twin != letter:
            hint = "Keep one of them."
            entry.reject("this distance has the letter {} too", twin, hint=hint)
        return Size(axis, *pairs[0])

    return node.read_each(read)


def _is_quantity_letter(letter: str, points: Collection[str], links: Collection[str]) -> bool:
    """Return whether a letter is that of a quantity of a point, a length or a link."""
    head, index = letter[0], letter[1:].removeprefix("_")
    if head == "l":
        return {*(split_pair(index) or ("",))} <= {*points}
    return index in (points if head in "va" else links if head in _OF_LINKS else ())


def unused_letters(letters: Letters, drawn: Collection[tuple[str, str]]) -> list[Fault]:
    """Return the faults of letters that no plan has.

    Parameters
    ----------
    drawn : collection of (str, str)
        Links with the places of their points that the plans have.
    """
    known = [f"{place} on {link}" for link, place in drawn if link != FRAME]
    faults = []
    for name, (place, link) in letters.points.items():
        if (link, place) not in drawn:
            own = listed(sorted(point for of, point in drawn if of == link))
            nearest = nearest_name(f"{place} on {link}", known)
            hint = "Did you mean '{0}'? The plans have these points of link {1}: {2}."
            faults.append(
                Fault(
                    f"letters.points.{name}",
                    translate("the plans have no point {} of link {}", place, link),
                    translate(hint, nearest, link, own),
                )
            )
    return faults


def _read_balance(node: FileNode) -> str:
    text = node.text(BALANCE_LIMIT)
    if not re.match(_BALANCE_RE, text):
        node.reject_value("a letter with its indices", "For example: M_{1}, M_{1д}, F_{д}.")
    return indexed(text)
