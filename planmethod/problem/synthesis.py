"""Read ``[synthesis]``: the given data of a synthesis, and the sizes that follow (синтез)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Any

from planmethod.errors import AssemblyError
from planmethod.languages import translate
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.model import SynthesisTask
from planmethod.problem.names import UNITS, format_length, segment, split_names, split_pair
from planmethod.problem.tables import SynthesisSection
from planmethod.synthesis import options_of, synthesize
from planmethod.synthesis.model import InputError, OptionSetError, Synthesis

EXAMPLE = 'kind = "slotted", K_v = 1.4, centres = 0.4'

SAME = 1e-6
"""Share by which a length that the file gives as well may differ."""


def read_synthesis(node: FileNode) -> SynthesisTask:
    """Read ``[synthesis]``, and calculate what numbers of the file may name."""
    node.table(EXAMPLE)
    found = node.record(
        SynthesisSection,
        example=EXAMPLE,
        line=_read_line,
        positions=lambda rows: _read_rows(rows, "[x, y, angle] or [xB, yB, xC, yC]", (3, 4)),
        angles=lambda rows: _read_rows(rows, "[a, b]", (2,)),
        points=_read_letters,
    )
    kind = str(needed(found.pop("kind", None)))
    letters = found.pop("points", {})
    given = {name: found.get("lambda_" if name == "lambda" else name) for name in options_of(kind)}
    for key in node.value:
        if key not in ("kind", "points", *given):
            node[key].note(
                "{} does not take this", kind, hint=translate("It takes {}.", _list(given))
            )
    node.require_sound()
    made = _synthesized(node, kind, given)
    for letter in letters:
        if letter not in made.letters:
            node["points"][letter].note_unknown(
                letter, made.letters, "the construction has no point '{}'"
            )
    node.require_sound()
    values = made.values(letters)
    pairs = ((split_pair(name.removeprefix("l_")), value) for name, value in values.items())
    turned = {f"l_{pair[1]}{pair[0]}": value for pair, value in pairs if pair is not None}
    return SynthesisTask(kind, given, letters, {**turned, **values})


def _list(names: Iterable[str]) -> str:
    return ", ".join(names)


def _synthesized(node: FileNode, kind: str, data: Mapping[str, Any]) -> Synthesis:
    """Return the synthesis; what prevents it is noted at the key that the reason names."""
    try:
        return synthesize(kind, data)
    except OptionSetError as error:
        every = {name for way in error.option_sets for name in way}  # others are optional
        there = {name for name, value in data.items() if value is not None and name in every}
        ways = translate("{} is found from: {}.", kind, "; ".join(map(_list, error.option_sets)))
        wider = [way for way in error.option_sets if there < {*way}]
        if wider:
            for name in sorted({*min(wider, key=len)} - there):
                node.note_missing(name, ways)
        else:
            known = _list(name for name in data if name in there)
            node.note("{} together are too much or do not suffice", known, hint=ways)
        node.require_sound()
        raise
    except (InputError, AssemblyError) as error:
        reason = str(error)
        given = [key for key in data if key in node.value]
        forms = (r"(?:--)?{}\b", r".*\b{} [=<>]")  # "K_v = 0.9 is …", "--line: …", "… (K_v > 1)"
        named = [key for form in forms for key in given if re.match(form.format(key), reason)]
        place = node.at((named or given)[:1]) if named or len(given) == 1 else node
        place.reject(reason.removeprefix(f"--{place.key}: ").replace("--", ""))


def _read_letters(node: FileNode) -> dict[str, str]:
    node.table('points = { O = "A", A = "B" }')
    letters = node.read_each(FileNode.point_name)
    if len({*letters.values()}) < len(letters):
        node.reject("two points have one letter")
    node.require_sound()
    return letters


def _read_line(node: FileNode) -> tuple[float, ...]:
    node.array("[x, y, angle]", low=3, high=3)
    return _read_row(node)


def _read_rows(node: FileNode, form: str, counts: tuple[int, ...]) -> tuple[tuple[float, ...], ...]:
    node.array("three rows", low=3, high=3)

    def read_row(row: FileNode) -> tuple[float, ...]:
        row.array(form, low=counts[0], high=counts[-1])
        return _read_row(row)

    rows = node.read_all(read_row)
    if len({*map(len, rows)}) > 1:
        node.reject("the three rows need one form: {}", translate(form))
    return rows


def _read_row(node: FileNode) -> tuple[float, ...]:
    """Read coordinates, and the angle that an odd one has at its end; a pair has two angles."""
    count = len(node.value)
    angles = {3: (2,), 2: (0, 1)}.get(count, ())
    return node.read_all(
        lambda one: one.angle() if one.key in angles else one.coordinate("coordinate")
    )


def values_in_file(task: SynthesisTask, unit: str) -> dict[str, float]:
    """Return the values that numbers of a file may name, in its unit of lengths."""
    return {
        name: value if name.startswith(("phi_", "theta")) else value * UNITS[unit]
        for name, value in task.values.items()
    }


def check_lengths(
    file: FileNode,
    task: SynthesisTask,
    lengths: Iterable[tuple[str, str, float]],
    fixed: Mapping[str, complex],
) -> None:
    """Note a length that the file gives as a number, and that follows from the synthesis.

    Parameters
    ----------
    lengths : iterable of (str, str, float)
        Link, key and metres of every length.
    fixed : mapping
        Places of fixed points, m.
    """
    stated = file.faults.stated

    def check(node: FileNode, name: str, metres: float) -> None:
        found = task.values[name]
        one, other = split_names(name[2:])
        own = rf"\bl_(?:{one}{other}|{other}{one})\b"
        is_other = node.path in stated and not re.search(own, stated[node.path])
        if is_other or not node.is_sound or abs(metres - found) <= SAME * found:
            return
        # The letters of the file are others if the name is that of another length there.
        for path, text in stated.items():
            key = re.fullmatch(r"links\.[^.]+\.(\w+)", path)
            pair = None if key is None else split_pair(key[1])
            if re.search(own, text) and pair is not None and {*pair} != {one, other}:
                return
        unit = file.faults.unit
        node.note(
            "{} by the synthesis, {} here",
            *(format_length(one, unit) for one in (found, metres)),
            hint=translate('Write "{}", or leave a key of [synthesis] out.', name),
        )

    pairs = ((split_pair(name.removeprefix("l_")), name) for name in task.values)
    names = {frozenset(pair): name for pair, name in pairs if pair is not None}
    for link, key, metres in lengths:
        name = names.get(frozenset(split_names(key)))
        if name is not None:
            check(file["links"][link][key], name, metres)
    for ends, name in names.items():
        if ends <= fixed.keys():
            one, other = sorted(ends, key=[*fixed].index)
            check(file["frame"][segment(other)], name, abs(fixed[other] - fixed[one]))
