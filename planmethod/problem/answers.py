"""Published values and ``[[answers]]`` of a problem file, in one short grammar."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterable, Mapping
from enum import Enum
from functools import partial
from typing import TYPE_CHECKING, Any

from msgspec import Struct

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Revolute
from planmethod.problem import keys
from planmethod.problem.faults import is_integer, show
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.model import Drive, Slide
from planmethod.problem.names import (
    indexed,
    listed,
    nearest_name,
    nearest_name_hint,
    short,
    split_pair,
)
from planmethod.problem.records import AnswerForm, DirectionMode, Published, QuestionSpec

if TYPE_CHECKING:
    from planmethod.problem.records import Dynamics


class Selector(Struct, frozen=True):
    """One quantity of a solved problem (величина).

    Attributes
    ----------
    kind : str
        A key of `QUANTITIES` or of `FORCES`.
    names : tuple of str
        Points, or one link; the pole of a plan is ``p``. Coincident points have the number of
        their link: ``B3`` is the point of link 3 under the pin B. For a force: by the
        `NameRole` of each.
    over : Selector or None
        Divisor of a quotient such as ``vx D / omega 1``.
    """

    kind: str
    names: tuple[str, ...]
    over: Selector | None = None


ANALOGUES = ("x1", "y1", "x2", "y2", "phi1", "phi2")
"""First and second derivatives by the coordinate of the driver (аналоги), as JSON has them."""

TRANSFERS = ("v_q", "a_q", "u", "epsilon_q")
"""Transfer functions as the plans give them: of a point, of two links, of a link."""

QUANTITIES: Mapping[str, tuple[int, ...]] = {
    "x": (1,),
    "y": (1,),
    "v": (1, 2),
    "vx": (1,),
    "vy": (1,),
    "a": (1, 2),
    "ax": (1,),
    "ay": (1,),
    "an": (2,),
    "at": (2,),
    "vs": (2,),
    "ar": (2,),
    "ak": (2,),
    "phi": (1,),
    "omega": (1,),
    "epsilon": (1,),
    "length": (2,),
    "segment velocity": (2,),
    "segment acceleration": (2,),
    **dict.fromkeys(ANALOGUES, (1,)),
    **dict.fromkeys(TRANSFERS, (1,)),
    "u": (2,),
}
"""Kinds of quantity of the motion, and how many names each may have."""

LINK_KINDS = frozenset({"phi", "omega", "epsilon", "phi1", "phi2", "u", "epsilon_q"})
POLE = "p"


class NameRole(Enum):
    """Role of a name of a force."""

    LINK = "link"
    BODY = "body"  # a link, or the frame
    POINT = "point"
    LOAD = "load"  # an external load, by its letter in the file


_ON_BY = (NameRole.BODY, NameRole.BODY)
_LINE = (NameRole.POINT, NameRole.POINT)

FORCES: Mapping[str, tuple[tuple[NameRole, ...], ...]] = {
    "F": (_ON_BY,),
    "Ft": ((*_ON_BY, *_LINE),),
    "Fn": ((*_ON_BY, *_LINE),),
    "M": (_ON_BY,),
    "weight": ((NameRole.LINK,),),
    "inertia": ((NameRole.LINK,),),
    "inertia couple": ((NameRole.LINK,),),
    "shift": ((NameRole.LINK,),),
    "load": ((NameRole.LOAD,),),
    "angle F": (_ON_BY,),
    "angle inertia": ((NameRole.LINK,),),
    "angle load": ((NameRole.LOAD,),),
    "arm F": ((*_ON_BY, NameRole.POINT),),
    "arm weight": ((NameRole.LINK, NameRole.POINT),),
    "arm inertia": ((NameRole.LINK, NameRole.POINT),),
    "arm load": ((NameRole.LOAD, NameRole.POINT),),
    "balance": ((), (NameRole.POINT,)),
    "lever": ((), (NameRole.POINT,)),
}
"""Kinds of quantity of the force analysis, and what the names of each are, in every form it has."""

MACHINE: Mapping[str, int] = {
    "machine M": 1,
    "machine J": 1,
    "machine T": 1,
    "machine energy": 2,
    "machine constant": 0,
    "machine omega": 0,
    "machine delta": 0,
    "machine mu_phi": 0,
    "machine mu_A": 0,
    "machine psi_max": 0,
    "machine psi_min": 0,
    "machine KL": 0,
    "machine AB": 0,
    "machine J_f": 0,
    "machine D": 0,
    "machine m": 0,
    "machine b": 0,
}
"""Kinds of quantity of a machine and its flywheel, and how many names each has: a link, and last
the number of a position of ``[machine]``."""

_PAIRED = frozenset(kind.split()[0] for kind in (*QUANTITIES, *FORCES, *MACHINE) if " " in kind)
"""First words of the kinds that have two; ``inertia`` alone is a kind as well."""

_ABOUT = "about"


class SelectorError(ValueError):
    """A selector cannot be parsed; the message has the reason."""


def parse_selector(text: str) -> Selector:
    """Parse ``what``.

    Examples
    --------
    >>> parse_selector("v C B")
    Selector(kind='v', names=('C', 'B'), over=None)
    >>> parse_selector("arm weight 2 about C")
    Selector(kind='arm weight', names=('2', 'C'), over=None)

    Raises
    ------
    SelectorError
    """
    above, slash, below = text.partition("/")
    first = _parse_one(above)
    if not slash:
        return first
    if "/" in below:
        raise SelectorError("expected one division at most")
    second = _parse_one(below)
    if first.kind in MACHINE or second.kind in MACHINE:
        raise SelectorError("quantities of the flywheel cannot be divided")
    return Selector(first.kind, first.names, second)


def _parse_one(text: str) -> Selector:
    words = text.split()
    if not words:
        raise SelectorError('expected a quantity such as "v C", got nothing')
    kind, names = _kind(words)
    if kind in MACHINE:
        counts: tuple[int, ...] = (MACHINE[kind],)
    else:
        counts = QUANTITIES.get(kind) or tuple(len(form) for form in FORCES[kind])
    if kind.startswith("arm "):
        if names[-2:-1] != [_ABOUT]:
            raise SelectorError(translate("'{}' ends with '{}' and a point", kind, _ABOUT))
        del names[-2]
    if len(names) not in counts:
        wanted = translate(" or ").join(map(str, counts))
        told = "'{0}' takes {1} name{2:||s}, got {3}"
        raise SelectorError(translate(told, kind, wanted, 1 if wanted == "1" else 2, len(names)))
    selector = Selector(kind, tuple(names))
    if kind in FORCES:
        indices = (indexed(n) if role is NameRole.LOAD else n for n, role in roles(selector))
        selector = Selector(kind, tuple(indices))
    for pair in _must_differ(selector):
        if len(set(pair)) != len(pair):
            raise SelectorError(translate("'{}' needs two different names", kind))
    return selector


def _kind(words: list[str]) -> tuple[str, list[str]]:
    """Split the words of a quantity into its kind, of one word or two, and its names."""
    first = words[0]
    for size in (2, 1) if first in _PAIRED else (1,):
        kind = " ".join(words[:size])
        if kind in QUANTITIES or kind in FORCES or kind in MACHINE:
            return kind, words[size:]
    known = [*QUANTITIES, *FORCES, *MACHINE]
    unknown = " ".join(words[:2]) if first in _PAIRED else first
    guess = nearest_name(unknown, known)
    tail = translate(" (the nearest is '{}')", guess) if guess else ""
    raise SelectorError(translate("unknown quantity '{}'{}", short(unknown), tail))


def _must_differ(selector: Selector) -> list[tuple[str, ...]]:
    """Return the groups of names that must differ within the group: points, and links."""
    if selector.kind in QUANTITIES:
        return [selector.names]
    if selector.kind in MACHINE:
        return []
    told = roles(selector)
    bodies = tuple(name for name, role in told if role is NameRole.BODY)
    return [bodies, tuple(name for name, role in told if role is NameRole.POINT)]


def roles(selector: Selector) -> list[tuple[str, NameRole]]:
    """Return the names of a force, and their roles."""
    form = next(form for form in FORCES[selector.kind] if len(form) == len(selector.names))
    return list(zip(selector.names, form, strict=True))


def is_force(selector: Selector) -> bool:
    """Return whether a quantity, or its divisor, is of the force analysis."""
    own = selector.kind in FORCES or selector.kind in MACHINE
    return own or (selector.over is not None and is_force(selector.over))


def unknown_names(
    selector: Selector,
    points: Collection[str],
    links: Collection[str],
    loads: Collection[str] = (),
) -> list[str]:
    """Names of a selector that the mechanism does not have.

    Parameters
    ----------
    points : collection of str
        Points, coincident ones such as ``B3`` among them.
    loads : collection of str
        Letters of the external loads.
    """
    if selector.kind in MACHINE:
        found = [name for name in selector.names[:-1] if name not in links]
        found += [name for name in selector.names[-1:] if not name.isdecimal()]
    elif selector.kind in FORCES:
        known = {
            NameRole.LINK: links,
            NameRole.BODY: {*links, FRAME},
            NameRole.POINT: points,
            NameRole.LOAD: loads,
        }
        found = [name for name, role in roles(selector) if name not in known[role]]
    elif selector.kind in LINK_KINDS:
        found = [name for name in selector.names if name not in links]
    else:
        extra = {POLE} if selector.kind.startswith("segment") else set()
        found = [name for name in selector.names if name not in points and name not in extra]
    return found + (unknown_names(selector.over, points, links, loads) if selector.over else [])


def read_published(
    node: FileNode,
    check: Callable[[FileNode, str], str],
    *,
    positions: int = 0,
    example: str = 'value = 3, unit = "м/с", what = "v B"',
    without: Collection[str] = (),
) -> tuple[Published, ...]:
    """Read ``[published."name"]``.

    Parameters
    ----------
    check : callable
        Gets ``what`` (with an empty text where it is absent) and the name, notes faults of the
        quantity, and returns ``what`` as outputs have it.
    positions : int
        How many there are; 0 when not known.
    example, without
        An entry, and the keys that one may not have.
    """

    def read_entry(entry: FileNode) -> Published | None:
        name = str(entry.key)
        table = entry.attempt(lambda entry: entry.table(example))
        entry.check_text(name, _PUBLISHED_NAME_LIMIT)
        needed(table)
        position = partial(read_position, positions=positions)
        given = entry.record(Published, without=without, position=position)
        what = entry["what"].with_value(given.get("what", ""))
        given["what"] = check(what, name)
        return Published(name, **given) if "value" in given else None

    node.table(f'[published."v_B"] {example}')
    node.require_at_most(keys.PUBLISHED_LIMIT, "{} values, the limit is {}")
    return tuple(node.read_each(read_entry).values())


_PUBLISHED_NAME_LIMIT = 80


def read_position(node: FileNode, positions: int) -> int:
    """Read the number of a driver position, from 0; ``positions`` is 0 when not known."""
    if not is_integer(node.value) or node.value < 0:
        node.reject_value("a whole number from 0")
    if positions and node.value >= positions:
        hint = "The first position is 0."
        node.reject("position {} of {}", node.value, positions, hint=hint)
    return node.value


def check_quantity(
    node: FileNode,
    quantity: str,
    points: Collection[str],
    links: Collection[str],
    dynamics: Dynamics | None,
) -> Selector | None:
    """Parse a quantity that a node has, and check its names; None where it cannot be parsed.

    Parameters
    ----------
    points, links : collections of str
        Names of the mechanism, with those of coincident points; empty when it could not be read.
    """
    try:
        selector = parse_selector(quantity)
    except SelectorError as error:
        node.note(str(error), hint='For example: "v C", "an C B", "omega 2", "F 2 1".')
        return None
    if not points or not links:
        return selector
    if is_force(selector) and dynamics is None:
        message = "'{}' is of the force analysis, and the file has no masses and no loads"
        node.note(message, short(quantity), hint="Give [dynamics] or [[loads]].")
        return selector
    loads = [load.name for load in dynamics.loads] if dynamics else []
    for name in unknown_names(selector, points, links, loads):
        known = [translate("Points: {}", listed(points))]
        if is_force(selector):
            known += [translate("links: {}", listed(links))]
            known += [translate("loads: {}", listed(loads))] if loads else []
        hint = nearest_name_hint(name, [*points, *links, *loads], f"{'; '.join(known)}.")
        node.note("the mechanism has no '{}'", name, hint=hint)
    return selector


def read_tables(file: FileNode) -> dict[str, Any]:
    """Take over the tables that later parts read, checking no more than their TOML type."""
    found = {key: file.read(key, FileNode.table) for key in keys.OF_KINDS}
    return {key: table for key, table in found.items() if table is not None}


QUANTITY_LIMIT = 200
ID_LIMIT = 40
LETTERS_LIMIT = 40
SPELLING_LIMIT = 10
SEGMENT_LIMIT = 40

# No sign that would begin a formula in a spreadsheet, no space that a form could lose.
_ID_RE = r"[^\W\d_][\w./@'{}^-]*\Z"
_REACTION_RE = r"[FM]_(?P<joint>[^_/]+)_(?P<on>[^_/]+)/(?P<by>[^_/]+)\Z"
_BALANCING = {"dr": "balance", "lever": "lever"}
_TRANSFERS = ("v_q_", "a_q_", "epsilon_q_")
_RESERVED_NAMES = ("mu_l", "mu_v", "mu_a", "mu_F", "ruler_mm")
"""Names in a row of a group's table that are not answers."""

_TURNS = frozenset({"omega", "epsilon", "M", "inertia couple"})
_VECTORS = frozenset(
    ("v", "a", "vs", "ar", "ak", "an", "at", "F", "Ft", "Fn", "weight", "inertia")
).union(_BALANCING.values())
_NO_SEGMENT = frozenset({*_TURNS, "phi", "angle F", "angle inertia", "angle load"})


class AnswerScope(Struct, frozen=True):
    """Names that answers may use.

    Attributes
    ----------
    points, links : collection of str
        Both empty when they are not known because of other faults: then no name is checked.
    revolutes : collection of Revolute
    slides : mapping of str to Slide
    dynamics : Dynamics or None
    drive : Drive or None
    """

    points: Collection[str]
    links: Collection[str]
    revolutes: Collection[Revolute]
    slides: Mapping[str, Slide]
    dynamics: Dynamics | None
    drive: Drive | None

    @property
    def names(self) -> tuple[object, ...]:
        """Facts that answers depend on: names, number of positions, balancing quantity."""
        slides = tuple((s.slider, s.host, s.pin, s.through) for s in self.slides.values())
        drive, dynamics = self.drive, self.dynamics
        driven = drive and (len(drive.positions), drive.balancing.turns)
        loads = dynamics and tuple(load.name for load in dynamics.loads)
        return tuple(self.points), tuple(self.links), self.revolutes, slides, driven, loads


def words_of(name: str, slides: Iterable[Slide]) -> str:
    """Return the words of ``[published]`` for a name of ``--ask``; other texts as they are.

    ``v_B3`` is ``v B3``, ``v_B3/2`` is ``vs B3 B``, ``F_B_2/1`` is ``F 2 1``, ``M_dr`` is
    ``balance``, ``v_q_C`` is ``v_q C``, ``u_21`` is ``u 2 1``.
    Along a guide of the frame a slider moves as its point does: ``v_E5/0`` is ``v E``.
    """
    name = " ".join(name.split())
    if " " in name or "_" not in name:
        return name
    head, _, rest = name.partition("_")
    reaction = re.match(_REACTION_RE, name)
    if reaction:
        return f"{head} {reaction['on']} {reaction['by']}"
    if head in ("M", "F") and rest in _BALANCING:
        return _BALANCING[rest]
    if head == "load":
        return f"load {rest}"  # its letter may have an index
    if name.startswith(_TRANSFERS):
        return f"{head}_q {name.split('_', 2)[2]}"
    if head == "u":
        return f"u {' '.join(rest.split('/') if '/' in rest else rest)}"
    pair = _sliding(slides).get(rest, ())
    if head in ("v", "ak", "ar") and len(pair) == 2:
        return f"{'vs' if head == 'v' else head} {pair[0]} {pair[1]}"
    if head in ("v", "ar") and len(pair) == 1:
        return f"{head[0]} {pair[0]}"
    return name.replace("_", " ")


def _sliding(slides: Iterable[Slide]) -> dict[str, tuple[str, ...]]:
    """Return the points that slide on each other, by the subject of their quantities: ``B3/2``.

    On the frame it is one point.
    """
    found: dict[str, tuple[str, ...]] = {}
    for slide in slides:
        fixed = slide.host == FRAME
        pairs = [(slide.pin,) if fixed else (f"{slide.pin}{slide.host}", slide.pin)]
        if slide.through is not None and not fixed:
            pairs.append((slide.through, f"{slide.through}{slide.slider}"))
        for pair, place in zip(pairs, (slide.pin, slide.through), strict=False):
            for of, to in ((slide.slider, slide.host), (slide.host, slide.slider)):
                found[f"{place}{of}/{to}"] = pair
    return found


class ComputedAnswerNames(Struct, frozen=True):
    """Names that answers may use in a problem that is computed without plans.

    Attributes
    ----------
    fault : callable
        Returns why a quantity is unavailable; empty where it is available.
    turns : callable
        Whether a quantity has a sense of turning.
    hint : str
        Hint with the known names.
    positions : int
    """

    fault: Callable[[str], str]
    turns: Callable[[str], bool]
    hint: str
    positions: int = 1


def read_answers(
    file: FileNode, scene: AnswerScope | ComputedAnswerNames
) -> tuple[QuestionSpec, ...]:
    """Read ``[[answers]]`` of a file, in its order, and check its ``compare``."""
    file.read("compare", FileNode.flag)
    if "answers" not in file:
        return ()
    node, faults = file["answers"], file.faults
    names = None if isinstance(scene, ComputedAnswerNames) or faults else scene.names
    global _CACHE
    for table, before, answers in _CACHE:
        if names is not None and table is node.value and before == names:
            return answers
    stated = len(faults.stated)
    found = node.attempt(partial(_read_each, scene=scene)) or ()
    if names is not None and not faults and len(faults.stated) == stated:
        _CACHE = ((node.value, names, found), *_CACHE[:1])
    return found


_CACHE: tuple[tuple[object, tuple[object, ...], tuple[QuestionSpec, ...]], ...] = ()
"""Cache of the last faultless tables: most variants of a file share that of its main part. It is
replaced, never modified: another thread may be reading it.
"""


def _read_each(
    node: FileNode, scene: AnswerScope | ComputedAnswerNames
) -> tuple[QuestionSpec, ...]:
    """Read the answers in their order."""
    node.tables(keys.ANSWER_LIMIT, "{} answers, the limit is {}")
    found: list[QuestionSpec] = []
    ids: dict[str, int] = {}
    letters: dict[tuple[str, int | None], int] = {}
    for index, entry in enumerate(node.entries()):
        answer = entry.attempt(partial(_read_answer, scene=scene))
        if answer is None:
            continue
        found.append(answer)
        if ids.setdefault(answer.id, index) != index:
            message, hint = "answers[{}] is called '{}' too", "Give one of them an id of its own."
            entry.note(message, ids[answer.id], short(answer.id), hint=hint)
        for spelling in answer.letters:
            twin = letters.setdefault((spelling, answer.position), index)
            if twin != index:
                hint = "Give each of them letters of its own."
                entry["letters"].note("'{}' denotes answers[{}] too", short(spelling), twin,
                                      hint=hint)  # fmt: skip
    return tuple(found)


def _read_answer(node: FileNode, scene: AnswerScope | ComputedAnswerNames) -> QuestionSpec:
    positions = scene.positions if isinstance(scene, ComputedAnswerNames) else 0
    if isinstance(scene, AnswerScope) and scene.drive:
        positions = len(scene.drive.positions)
    given = node.record(
        QuestionSpec,
        id=_read_id,
        letters=_read_letters,
        position=partial(read_position, positions=positions),
        segment=_read_segment,
    )
    what = node["what"]
    name = needed(what.attempt(_read_what) if "what" in given else None)
    own_sense, selector, words, kind, usual = None, None, name, "", AnswerForm.BOTH
    if isinstance(scene, ComputedAnswerNames):
        usual = AnswerForm.VALUE
        if phrase := scene.fault(name):
            what.note(phrase, hint=scene.hint)
        else:
            kind, own_sense = name, DirectionMode.TURN if scene.turns(name) else None
    else:
        words = words_of(name, scene.slides.values())
        selector = what.attempt(partial(_read_quantity, name=name, words=words, scene=scene))
        if selector is not None:
            kind, own_sense = selector.kind, _quantity_sense(selector, scene.drive)
    if given.get("form") is AnswerForm.MM and selector is not None and _has_no_segment(selector):
        hint = 'Leave it, or form = "value".'
        node["form"].note("'{}' is not a segment of a plan", short(name), hint=hint)
    given["sense"] = node.read("sense", partial(_read_sense, quantity=kind, default=own_sense))
    node.require_sound()
    if "tolerance" in given:
        given["tolerance"] /= 100.0
    position = given.get("position")
    own_id = name.replace(" / ", "/").replace(" ", "_")
    if position is not None:
        own_id += f"@{position}"
    usually: dict[str, Any] = {"id": own_id, "form": usual}
    return QuestionSpec(**usually | given | {"what": words})


def _read_what(node: FileNode) -> str:
    return " ".join(node.unmask(node.text(QUANTITY_LIMIT)).split())


def _read_quantity(node: FileNode, name: str, words: str, scene: AnswerScope) -> Selector | None:
    """Check a quantity, and the joint of a reaction, which its words do not contain."""
    if name in scene.points:
        hint = translate("Ask for x {0}, y {0}.", name)
        node.reject("'{}' is a place, which is two numbers", name, hint=hint)
    selector = check_quantity(node, words, scene.points, scene.links, scene.dynamics)
    if selector is not None and selector.kind in MACHINE:
        node.note("'{}' is of the flywheel", words, hint="Ask for the motion or the forces.")
    elif selector is not None and selector.kind in ANALOGUES:
        node.note("'{}' is on no plan", words, hint="Ask for the motion or the forces.")
    reaction = re.match(_REACTION_RE, name)
    if reaction and scene.points and node.is_sound:
        joint, one, other = reaction["joint"], reaction["on"], reaction["by"]
        if not _joined(joint, {one, other}, scene):
            hint = translate("Without it: '{}'.", words)
            node.note("links {} and {} have no joint {}", one, other, joint, hint=hint)
    return selector


def _joined(joint: str, pair: set[str], scene: AnswerScope) -> bool:
    return any(joint == r.point and pair <= set(r.links) for r in scene.revolutes) or any(
        pair == {slide.slider, slide.host} and joint in (slide.pin, slide.through)
        for slide in scene.slides.values()
    )


def _has_no_segment(selector: Selector) -> bool:
    return selector.kind in _NO_SEGMENT or selector.over is not None


def _read_id(node: FileNode) -> str:
    text = node.unmask(node.text(ID_LIMIT))
    if text in _RESERVED_NAMES:
        hint = "Take another id."
        node.reject("'{}' is a row of its own in tables of answers", text, hint=hint)
    if not re.match(_ID_RE, text):
        hint = "A letter first, then letters, digits and _ . / @ ' - without spaces: v_B3."
        node.reject("expected {}, got {}", "the id of an answer", show(text), hint=hint)
    return text


def _read_letters(node: FileNode) -> tuple[str, ...]:
    if not isinstance(node.value, str):
        expected = partial(translate, "a string or up to {} of them", SPELLING_LIMIT)
        node.array(expected, high=SPELLING_LIMIT)
    return tuple(dict.fromkeys(node.read_one_or_all(_read_spelling)))


def _read_spelling(node: FileNode) -> str:
    text = node.text(LETTERS_LIMIT).strip()
    if not text:
        node.reject("the text is empty", hint="Leave it out.")
    return text


def _read_sense(
    node: FileNode, quantity: str, default: DirectionMode | None
) -> DirectionMode | None:
    """Read the form of a sense; ``true`` is the form of the quantity.

    ``quantity`` is empty for an unknown quantity.
    """
    if node.value is False:
        return None
    sense = None
    if node.value is not True:
        if not isinstance(node.value, str):
            words = ", ".join(f"'{kind.value}'" for kind in DirectionMode)
            node.reject_value(translate("true, false or one of {}", words))
        sense = node.member(DirectionMode)
    if not quantity:
        return sense
    if default is None:
        hint = "Leave sense out: the sign of a number, or the size of a load, says all."
        node.note("'{}' has no sense that could be requested", quantity, hint=hint)
    elif sense is not None and (sense is DirectionMode.TURN) != (default is DirectionMode.TURN):
        text = "'{}' turns" if default is DirectionMode.TURN else "'{}' is a vector"
        node.note(text, quantity, hint=translate('Write sense = "{}".', default.value))
    return sense or default


def _quantity_sense(selector: Selector, drive: Drive | None) -> DirectionMode | None:
    if selector.over is not None:
        return None
    if selector.kind in ("balance", "lever") and not selector.names:
        turns = drive is None or drive.balancing.turns
        return DirectionMode.TURN if turns else DirectionMode.DIRECTION
    if selector.kind in _TURNS:
        return DirectionMode.TURN
    return DirectionMode.DIRECTION if selector.kind in _VECTORS else None


def _read_segment(node: FileNode) -> str:
    """Read the letters of a segment, together or apart: ``pb3``, ``p b3``, ``p-b3``."""
    text = node.text(SEGMENT_LIMIT)
    if not text:
        return ""
    ends = tuple(text.replace("-", " ").split())
    ends = (split_pair(text) or ends) if len(ends) == 1 else ends
    if len(ends) != 2 or ends[0] == ends[1]:
        node.reject_value("the two ends of a segment", 'For example: "p b3".')
    return "-".join(ends)
