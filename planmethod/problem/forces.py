"""``[[loads]]`` of a problem file: external forces and couples."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import re
from collections.abc import Collection, Mapping
from functools import partial
from typing import NoReturn

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import keys
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.links import LinkText
from planmethod.problem.load_records import Against, Couple, Fixed, Load, SizeTable
from planmethod.problem.model import Drive
from planmethod.problem.names import indexed, listed, nearest_name_hint
from planmethod.problem.sizes import LIKE, TURN, liken, read_phase, read_size

NAME_LIMIT = 40
_NAME_RE = r"(?:[^_^{}\\]|[_^](?:[^_^{}\\]|\{[^_^{}\\]+\}))+\Z"


class LoadScope(Struct, frozen=True):
    """Names that masses and loads may use.

    Attributes
    ----------
    links : mapping of str to LinkText
        Links as written; empty when none could be read.
    fixed : collection of str
        Points of the frame.
    drive : Drive or None
        None when it could not be read.
    cycle : float, degrees
        Period of a table over phi.
    """

    links: Mapping[str, LinkText]
    fixed: Collection[str]
    drive: Drive | None
    cycle: float = TURN

    def link_of(self, node: FileNode, verb: str) -> LinkText:
        """Read the name of a moving link; ``verb`` names their action in messages."""
        name = node.any_name("the name of a link", self.links)
        return self.find_link(node, name, verb)

    def find_link(self, node: FileNode, name: str, verb: str) -> LinkText:
        """Return a moving link by its name, which is the value of a node or its key."""
        if name == FRAME:
            hint = translate("Moving links {}: {}.", verb, listed(self.links))
            node.reject("0 is the frame (стойка), which does not move", hint=hint)
        if self.links and name not in self.links:
            node.reject_unknown(name, self.links, "unknown link '{}'")
        return needed(self.links.get(name))  # without links, that they are missing is a fault

    def point_of(self, node: FileNode, link: LinkText) -> str:
        """Read the name of a point of a link."""
        name = node.point_name()
        if name not in link.points and link.is_complete:
            self._reject_point(node, name, link)
        return name

    def _reject_point(self, node: FileNode, name: str, link: LinkText) -> NoReturn:
        others = [other.name for other in self.links.values() if name in other.points]
        points = translate("the points of link {} are {}", link.name, listed(link.points))
        if others:
            text = "{0} is a point of link{1:||s} {2}; {3}."
            hint = translate(text, name, len(others), listed(others), points)
        elif name in self.fixed:
            hint = translate("{} is a point of the frame; {}.", name, points)
        else:
            hint = nearest_name_hint(name, link.points, f"{points[:1].upper()}{points[1:]}.")
        node.reject("link {} has no point '{}'", link.name, name, hint=hint)


def read_loads(node: FileNode, scene: LoadScope) -> tuple[Load | Couple, ...]:
    """Read ``[[loads]]``, in file order."""
    node.tables(keys.LOAD_LIMIT, "{} loads, the limit is {}")
    names: list[str | None] = []
    for entry in node.entries():
        names.append(entry.read("name", partial(_read_name, names=names)))
    used = {name for name in names if name is not None}
    found: dict[int, Load | Couple] = {}
    for index, (entry, name) in enumerate(zip(node.entries(), names, strict=True)):
        load = entry.attempt(partial(_read_load, name=name, used=used, scene=scene))
        if load is not None:
            found[index] = load
            used.add(load.name)
    # the name of a faulty load is not unknown
    known: dict[str, object] = {name: None for name in names if name is not None}
    known |= {load.name: load.size for load in found.values()}
    for index, load in found.items():
        if isinstance(load.size, SizeTable) and load.size.like is not None:
            where = node[index] if "like" in node[index] else node[index]["force"]
            read = partial(liken, load_name=load.name, size=load.size, known=known)
            size = where.read("like", read)
            found[index] = load if size is None else replace(load, size=size)
    return tuple(found.values())


def _read_name(node: FileNode, names: list[str | None]) -> str:
    """Read a name, which must differ from those before it."""
    name = node.text(NAME_LIMIT)
    if not re.match(_NAME_RE, name):
        node.reject_value("a letter with its indices", "For example: F_{5}, P, M_{1}^{c}.")
    name = indexed(name)
    if name in names:
        hint = "Give it another letter."
        node.note("loads[{}] is called {} too", names.index(name), name, hint=hint)
    return name


def _default_name(letter: str, link: str, used: Collection[str]) -> str:
    """Return the first free name of a load: ``F_{5}``, ``F_{5}'``, ``F_{5}''``, ``F_{5}^{(3)}``."""
    stem = f"{letter}_{{{link}}}"
    for count in range(len(used) + 1):
        name = stem + ("'" * count if count < 3 else f"^{{({count})}}")
        if name not in used:
            return name
    raise AssertionError("more names than loads are taken")


def _read_load(
    node: FileNode, name: str | None, used: Collection[str], scene: LoadScope
) -> Load | Couple:
    node.allow(keys.known("load"))
    link = node.require(
        "link", lambda link: scene.link_of(link, "carry loads"),
        lambda: translate("Name the link: {}.", listed(scene.links)),
    )  # fmt: skip
    size = node["couple" if "couple" in node else "force"]
    likened = {key: node.value[key] for key in keys.LIKE if key in node}
    if likened and ("force" in node or "couple" in node):
        hint = "Keep like and shift, or the size of the load."
        node[next(iter(likened))].note("the size of the load is given, too", hint=hint)
    elif "like" in likened:
        size = node.with_value(likened)
    elif likened:
        node["shift"].reject("goes with like only", hint=LIKE)
    if "force" in node and "couple" in node:
        hint = "Write them as two [[loads]]."
        node["couple"].reject("force and couple are both given", hint=hint)
    if size.value is None:
        hint = 'For example: link = "5", at = "H", force = 6000, angle = -90.'
        if node.is_whole:
            node.note("expected force or couple, got neither", hint=hint)
        node.require_sound()
    read = _read_couple if "couple" in node else _read_force
    load = read(node, size, link, scene)
    letter = "F" if isinstance(load, Load) else "M"
    return replace(load, name=name or _default_name(letter, load.link, used))


def _read_force(node: FileNode, size: FileNode, link: LinkText | None, scene: LoadScope) -> Load:
    """Read a force; ``size`` is where its size is given."""
    at = None
    if link is not None:
        named, points = link.name, link.points
        hint = "Name the point of link {} where it acts: {}."
        read_point = partial(scene.point_of, link=link)
        at = node.require("at", read_point, lambda: translate(hint, named, listed(points)))
    fixed_point = at if at in scene.fixed else None
    sense: Fixed | Against | None = None
    if "angle" in node and "against" in node:
        hint = "A force has one direction: keep one of them."
        node["against"].note("angle and against are both given", hint=hint)
    elif "angle" in node:
        sense = node.read("angle", lambda angle: Fixed(angle.angle()))
    elif "against" in node:
        sense = node.read("against", partial(_read_against, expected="velocity"))
        if fixed_point is not None:
            hint = "Give the direction as an angle."
            message = "point {} is fixed and has no velocity"
            node["against"].note(message, fixed_point, hint=hint)
    elif node.is_whole:
        hint = 'Give angle = -90 (degrees from +x) or against = "velocity".'
        node.note("expected a direction, got neither angle nor against", hint=hint)
    read = partial(read_size, drive=scene.drive, turn=scene.cycle)
    force: float | SizeTable | None = size.attempt(read)
    phase = node.read("phases", partial(read_phase, drive=scene.drive, fixed_point=fixed_point))
    node.require_sound()
    assert force is not None and sense is not None, "no fault of it was noted"
    return Load("", needed(link).name, needed(at), force, sense, phase)


def _read_couple(node: FileNode, size: FileNode, link: LinkText | None, scene: LoadScope) -> Couple:
    for key, why in (
        ("at", "A couple acts on the whole link."),
        ("angle", "A couple is counter-clockwise when positive."),
    ):
        if key in node:
            node[key].note("does not go with a couple", hint=why)
    sense = node.read("against", partial(_read_against, expected="rotation"))
    read = partial(read_size, drive=scene.drive, couple=True, turn=scene.cycle)
    couple: float | SizeTable | None = size.attempt(read)
    phase = node.read("phases", partial(read_phase, drive=scene.drive, couple=True))
    node.require_sound()
    assert couple is not None, "no fault of it was noted"
    return Couple("", needed(link).name, couple, sense, phase)


def _read_against(node: FileNode, expected: str) -> Against:
    word = node.word(("velocity", "rotation"))
    if word != expected:
        node.reject("expected '{}', got '{}'", expected, word, hint=_AGAINST[expected])
    return Against()


_AGAINST = {
    "velocity": "A force acts against the velocity of its point.",
    "rotation": "A couple acts against the rotation of its link.",
}
