"""Published values and ``[[answers]]`` of a problem file."""

# Cyrillic letters: what a file may say, or a field term in brackets

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from functools import partial
from typing import TYPE_CHECKING, Any

from msgspec import Struct, field

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Mesh, Revolute
from planmethod.problem import keys
from planmethod.problem.faults import is_integer, show
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.model import Drive, Slide
from planmethod.problem.names import listed, nearest_name_hint, short, split_pair
from planmethod.problem.quantities import (
    BALANCES,
    QuantityKey,
    QuantityNameError,
    joint_of,
    parse_quantity,
)
from planmethod.problem.records import AnswerForm, DirectionMode, Published, QuestionSpec

if TYPE_CHECKING:
    from planmethod.problem.records import Dynamics


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


def check_quantity(node: FileNode, quantity: str, scope: AnswerScope) -> QuantityKey | None:
    """Read a quantity that a node has, and check its names; None where it cannot be read."""
    try:
        key = parse_quantity(quantity, scope.pairs).renamed(scope.letters)
    except QuantityNameError as error:
        node.note(str(error), hint='For example: "v C", "an C B", "omega 2", "F 2 1".')
        return None
    points, links, dynamics = scope.points, scope.links, scope.dynamics
    if not points or not links:
        return key
    if key.is_loaded and dynamics is None:
        message = "'{}' belongs to the force analysis, but the file has no masses and no loads"
        node.note(message, short(key.words), hint="Give [dynamics] or [[loads]].")
        return key
    loads = [load.name for load in dynamics.loads] if dynamics else []
    for name in key.unknown_names(points, links, loads):
        known = [translate("Points: {}", listed(points))]
        if key.is_loaded:
            known += [translate("links: {}", listed(links))]
            known += [translate("loads: {}", listed(loads))] if loads else []
        hint = nearest_name_hint(name, [*points, *links, *loads], f"{'; '.join(known)}.")
        node.note("the mechanism has no '{}'", name, hint=hint)
    return key


def read_tables(file: FileNode) -> dict[str, Any]:
    """Take over the tables that later parts read, checking no more than their TOML type."""
    if "cams" in file:
        hint = "For a linkage and its cam: [cam]."
        file["cams"].note("several cams on a shaft need a file of their own", hint=hint)
    found = {key: file.read(key, FileNode.table) for key in keys.OF_KINDS if key != "cams"}
    return {key: table for key, table in found.items() if table is not None}


QUANTITY_LIMIT = 200
ID_LIMIT = 40
LETTERS_LIMIT = 40
SPELLING_LIMIT = 10
SEGMENT_LIMIT = 40

# No sign that would begin a formula in a spreadsheet, no space that a form could lose.
_ID_RE = r"[^\W\d_][\w./@'{}^-]*\Z"
_RESERVED_NAMES = ("mu_l", "mu_v", "mu_a", "mu_F", "ruler_mm")
"""Names in a row of a group's table that are not answers."""


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
    letters : mapping of str to str
        Names of the points that have letters of the source.
    meshes : collection of Mesh
        Their poles are joints of reactions.
    """

    points: Collection[str]
    links: Collection[str]
    revolutes: Collection[Revolute]
    slides: Mapping[str, Slide]
    dynamics: Dynamics | None
    drive: Drive | None
    letters: Mapping[str, str] = field(default_factory=dict)
    meshes: Collection[Mesh] = ()

    @property
    def names(self) -> tuple[object, ...]:
        """Facts that answers depend on: names, number of positions, balancing quantity."""
        slides = tuple((s.slider, s.host, s.pin, s.through) for s in self.slides.values())
        drive, dynamics = self.drive, self.dynamics
        driven = drive and (len(drive.positions), drive.balancing.turns)
        loads = dynamics and tuple(load.name for load in dynamics.loads)
        letters = tuple(self.letters.items())
        return tuple(self.points), tuple(self.links), self.revolutes, slides, driven, loads, letters

    @property
    def pairs(self) -> dict[str, tuple[str, ...]]:
        """Points that slide on each other, by the subject of their quantities: ``B3/2``.

        On the frame it is one point.
        """
        found: dict[str, tuple[str, ...]] = {}
        for slide in self.slides.values():
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
            message, hint = "answers[{}] is also named '{}'", "Give one of them an id of its own."
            entry.note(message, ids[answer.id], short(answer.id), hint=hint)
        for spelling in answer.letters:
            twin = letters.setdefault((spelling, answer.position), index)
            if twin != index:
                hint = "Give each of them letters of its own."
                entry["letters"].note("'{}' also denotes answers[{}]", short(spelling), twin,
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
    own_sense, key, words, kind, usual = None, None, name, "", AnswerForm.BOTH
    if isinstance(scene, ComputedAnswerNames):
        usual = AnswerForm.VALUE
        if phrase := scene.fault(name):
            what.note(phrase, hint=scene.hint)
        else:
            kind, own_sense = name, DirectionMode.TURN if scene.turns(name) else None
    else:
        key = what.attempt(partial(_read_quantity, name=name, scene=scene))
        if key is not None:
            words, kind, own_sense = key.words, key.word, _quantity_sense(key, scene.drive)
            if scene.letters and key != parse_quantity(name, scene.pairs):
                name = words
    if given.get("form") is AnswerForm.MM and key is not None and not key.has_segment:
        hint = 'Omit it, or write form = "value".'
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


def _read_quantity(node: FileNode, name: str, scene: AnswerScope) -> QuantityKey | None:
    """Check a quantity, and the joint of a reaction, which its words do not contain."""
    if name in (*scene.points, *scene.letters):
        hint = translate("Request x {0}, y {0}.", name)
        node.reject("'{}' is a position, which has two coordinates", name, hint=hint)
    key = check_quantity(node, name, scene)
    if key is not None and not key.kind.analysis.is_of_position:
        node.note(
            "'{}' belongs to the whole cycle", key.words, hint="Request the motion or the forces."
        )
    elif key is not None and key.is_analogue:
        node.note("'{}' is not on any plan", key.words, hint="Request the motion or the forces.")
    joint = joint_of(name)
    named = key is not None and joint and scene.points and node.is_sound
    if key is not None and named and not _joined(joint, {*key.names}, scene):
        hint = translate("Write '{}' instead.", key.words)
        node.note("links {} and {} have no joint {}", *key.names, joint, hint=hint)
    return key


def _joined(joint: str, pair: set[str], scene: AnswerScope) -> bool:
    return (
        any(joint == r.point and pair <= set(r.links) for r in scene.revolutes)
        or any(
            pair == {slide.slider, slide.host} and joint in (slide.pin, slide.through)
            for slide in scene.slides.values()
        )
        or any(joint == mesh.name and pair == {*mesh.links} for mesh in scene.meshes)
    )


def _read_id(node: FileNode) -> str:
    text = node.unmask(node.text(ID_LIMIT))
    if text in _RESERVED_NAMES:
        hint = "Choose another id."
        node.reject("'{}' is a reserved row in tables of answers", text, hint=hint)
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
        node.reject("the text is empty", hint="Omit it.")
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
        hint = "Omit sense: the sign of the number, or the size of a load, is sufficient."
        node.note("'{}' has no sense that could be requested", quantity, hint=hint)
    elif sense is not None and (sense is DirectionMode.TURN) != (default is DirectionMode.TURN):
        text = "'{}' turns" if default is DirectionMode.TURN else "'{}' is a vector"
        node.note(text, quantity, hint=translate('Write sense = "{}".', default.value))
    return sense or default


def _quantity_sense(key: QuantityKey, drive: Drive | None) -> DirectionMode | None:
    if key.over is not None or key.axis:
        return None
    if key.kind in BALANCES and not key.names:
        turns = drive is None or drive.balancing.turns
        return DirectionMode.TURN if turns else DirectionMode.DIRECTION
    return key.kind.sense


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
