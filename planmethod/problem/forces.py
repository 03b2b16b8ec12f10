"""``[[loads]]`` of a problem file: external forces and couples."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping

from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults, Table
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

    def find_link(self, faults: Faults, path: str, value: object, verb: str) -> LinkText | None:
        """Return a moving link by its name; ``verb`` names their action in messages."""
        if not isinstance(value, str):
            hint = translate('Write link = "{}".', value) if type(value) is int else ""
            faults.expected(path, "the name of a link", value, hint)
            return None
        name = value if value in self.links else fields.unmask(faults, path, value)
        if name == FRAME:
            hint = translate("Moving links {}: {}.", verb, listed(self.links))
            faults.add(path, "0 is the frame (стойка), which does not move", hint)
            return None
        if name not in self.links:
            if self.links:
                fields.report_unknown(faults, path, name, self.links, message="unknown link '{}'")
            return None
        return self.links[name]

    def find_point(self, faults: Faults, path: str, value: object, link: LinkText) -> str | None:
        """Return a point of a link by its name."""
        name = fields.read_point_name(faults, path, value)
        if name is None or name in link.points or not link.is_complete:
            return name
        others = [other.name for other in self.links.values() if name in other.points]
        points = translate("the points of link {} are {}", link.name, listed(link.points))
        if others:
            text = "{0} is a point of link{1:||s} {2}; {3}."
            hint = translate(text, name, len(others), listed(others), points)
        elif name in self.fixed:
            hint = translate("{} is a point of the frame; {}.", name, points)
        else:
            hint = nearest_name_hint(name, link.points, f"{points[:1].upper()}{points[1:]}.")
        faults.add(path, translate("link {} has no point '{}'", link.name, name), hint)
        return None


def read_loads(faults: Faults, value: object, scene: LoadScope) -> tuple[Load | Couple, ...]:
    """Read ``[[loads]]``, in file order."""
    if not isinstance(value, list) or not all(isinstance(item, Mapping) for item in value):
        faults.expected("loads", "tables [[loads]]", value)
        return ()
    if faults.exceeds("loads", "{} loads, the limit is {}", len(value), keys.LOAD_LIMIT):
        return ()
    names = _read_names(faults, value)
    taken = {name for name in names if name is not None}
    found: dict[int, Load | Couple] = {}
    for index, (body, name) in enumerate(zip(value, names, strict=True)):
        load = _read_load(faults, f"loads[{index}]", body, name, taken, scene)
        if load is not None:
            found[index] = load
            taken.add(load.name)
    # the name of a faulty load is not unknown
    known: dict[str, object] = {name: None for name in names if name is not None}
    known |= {load.name: load.size for load in found.values()}
    for index, load in found.items():
        if isinstance(load.size, SizeTable) and load.size.like is not None:
            where = f"loads[{index}]" if "like" in value[index] else f"loads[{index}].force"
            size = liken(faults, where, load.name, load.size, known)
            found[index] = load if size is None else replace(load, size=size)
    return tuple(found.values())


def _read_names(faults: Faults, tables: Iterable[Table]) -> list[str | None]:
    """Read the names in the file, which must differ."""
    names: list[str | None] = []
    for index, body in enumerate(tables):
        path, name = f"loads[{index}].name", None
        if "name" in body:
            name = fields.read_text(faults, path, body["name"], limit=NAME_LIMIT)
        if name is not None and not re.match(_NAME_RE, name):
            faults.expected(
                path, "a letter with its indices", name, "For example: F_{5}, P, M_{1}^{c}."
            )
            name = None
        if name is not None:
            name = indexed(name)
        if name is not None and name in names:
            twin = names.index(name)
            faults.add(
                path, translate("loads[{}] is called {} too", twin, name), "Give it another letter."
            )
        names.append(name)
    return names


def _default_name(letter: str, link: str, used: Collection[str]) -> str:
    """Return the first free name of a load: ``F_{5}``, ``F_{5}'``, ``F_{5}''``, ``F_{5}^{(3)}``."""
    stem = f"{letter}_{{{link}}}"
    for count in range(len(used) + 1):
        name = stem + ("'" * count if count < 3 else f"^{{({count})}}")
        if name not in used:
            return name
    raise AssertionError("more names than loads are taken")


def _read_load(
    faults: Faults,
    path: str,
    body: Table,
    name: str | None,
    used: Collection[str],
    scene: LoadScope,
) -> Load | Couple | None:
    before = len(faults)
    given = fields.read_keys(faults, path, body, keys.known("load"))
    # a misspelt key is reported once: the key it should have been is not called missing as well
    whole = len(faults) == before
    link = None
    if "link" in given:
        link = scene.find_link(faults, f"{path}.link", given["link"], "carry loads")
    elif whole:
        faults.add(f"{path}.link", "missing", translate("Name the link: {}.", listed(scene.links)))
    load: Load | Couple | None = None
    likened = {key: given[key] for key in keys.LIKE if key in given}
    if likened and ("force" in given or "couple" in given):
        hint = "Keep like and shift, or the size of the load."
        faults.add(f"{path}.{next(iter(likened))}", "the size of the load is given, too", hint)
    elif "like" in likened:
        given = {**given, "force": likened}
    elif likened:
        faults.add(f"{path}.shift", "goes with like only", LIKE)
        whole = False
    if "force" in given and "couple" in given:
        hint = "Write them as two [[loads]]."
        faults.add(f"{path}.couple", "force and couple are both given", hint)
    elif "force" in given:
        load = _read_force(faults, path, given, link, scene, is_complete=whole)
    elif "couple" in given:
        load = _read_couple(faults, path, given, link, scene)
    elif whole:
        hint = 'For example: link = "5", at = "H", force = 6000, angle = -90.'
        faults.add(path, "expected force or couple, got neither", hint)
    if load is None or len(faults) != before:
        return None
    letter = "F" if isinstance(load, Load) else "M"
    return replace(load, name=name or _default_name(letter, load.link, used))


def _read_force(
    faults: Faults,
    path: str,
    table: Table,
    link: LinkText | None,
    scene: LoadScope,
    *,
    is_complete: bool,
) -> Load | None:
    at = None
    if "at" not in table:
        if is_complete and link is not None:
            hint = translate(
                "Name the point of link {} where it acts: {}.", link.name, listed(link.points)
            )
            faults.add(f"{path}.at", "missing", hint)
    elif link is not None:
        at = scene.find_point(faults, f"{path}.at", table["at"], link)
    fixed = at in scene.fixed
    sense: Fixed | Against | None = None
    if "angle" in table and "against" in table:
        message = "angle and against are both given"
        faults.add(f"{path}.against", message, "A force has one direction: keep one of them.")
    elif "angle" in table:
        angle = fields.read_angle(faults, f"{path}.angle", table["angle"])
        sense = None if angle is None else Fixed(angle)
    elif "against" in table:
        sense = _read_against(faults, f"{path}.against", table["against"], "velocity")
        if fixed:
            hint = "Give the direction as an angle."
            faults.add(
                f"{path}.against", translate("point {} is fixed and has no velocity", at), hint
            )
    elif is_complete:
        hint = 'Give angle = -90 (degrees from +x) or against = "velocity".'
        faults.add(path, "expected a direction, got neither angle nor against", hint)
    where = path if "like" in table else f"{path}.force"
    size = read_size(faults, where, table["force"], scene.drive, turn=scene.cycle)
    phase = None
    if "phases" in table:
        still = at if fixed else None
        phase = read_phase(
            faults, f"{path}.phases", table["phases"], scene.drive, fixed_point=still
        )
    if link is None or at is None or sense is None or size is None:
        return None
    return Load("", link.name, at, size, sense, phase)


def _read_couple(
    faults: Faults, path: str, table: Table, link: LinkText | None, scene: LoadScope
) -> Couple | None:
    for key, why in (
        ("at", "A couple acts on the whole link."),
        ("angle", "A couple is counter-clockwise when positive."),
    ):
        if key in table:
            faults.add(f"{path}.{key}", "does not go with a couple", why)
    sense = None
    if "against" in table:
        sense = _read_against(faults, f"{path}.against", table["against"], "rotation")
    where = f"{path}.couple"
    size = read_size(faults, where, table["couple"], scene.drive, couple=True, turn=scene.cycle)
    phase = None
    if "phases" in table:
        where = f"{path}.phases"
        phase = read_phase(faults, where, table["phases"], scene.drive, couple=True)
    return None if link is None or size is None else Couple("", link.name, size, sense, phase)


def _read_against(faults: Faults, path: str, value: object, expected: str) -> Against | None:
    word = fields.read_word(faults, path, value, ("velocity", "rotation"))
    if word is None:
        return None
    if word != expected:
        message = translate("expected '{}', got '{}'", expected, word)
        faults.add(path, message, _AGAINST[expected])
        return None
    return Against()


_AGAINST = {
    "velocity": "A force acts against the velocity of its point.",
    "rotation": "A couple acts against the rotation of its link.",
}
