"""Given data of a synthesis in symbols, and the sizes that follow (исходные данные синтеза)."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from typing import Any

from msgspec.structs import replace

from planmethod.note.document import NO_BREAK, GivenFact
from planmethod.note.formula import Rich
from planmethod.note.narrate.stated_links import StatedNumbers
from planmethod.note.numbers import with_unit
from planmethod.note.wording import Language
from planmethod.problem.names import UNITS
from planmethod.synthesis import sizes_of
from planmethod.synthesis.model import NO_LETTERS

GivenNumber = Callable[[float, str, str], Rich]
"""A number with its unit: value (SI, degrees), key of the unit, key of the table."""

ANGLES: Mapping[int, tuple[int, ...]] = {2: (0, 1), 3: (2,), 4: ()}
"""Places of the angles in a row of numbers by its length; the others are coordinates."""


def point_name(name: str, letters: Mapping[str, str] = NO_LETTERS) -> Rich:
    """Return a point's name as rich text: ``A2'`` gives ``A_{2}′``.

    Parameters
    ----------
    letters : mapping
        Other letters for those of the construction.
    """
    match = re.fullmatch(r"([^\d']+)(\d*)('*)", name)
    assert match is not None, name
    letter, index, primes = match.groups()
    whole = letters.get(letter + index)
    if whole is None:
        whole = letters.get(letter, letter) + index
    return (f"{whole[0]}_{{{whole[1:]}}}" if whole[1:] else whole) + "′" * len(primes)


def size_symbol(name: str, letters: Mapping[str, str] = NO_LETTERS) -> Rich:
    """Return the symbol of a length of the mechanism."""
    if name == "e":
        return name
    return f"l_{{{''.join(letters.get(end, end) for end in re.findall(r'[A-Z][0-9]*', name))}}}"


def given_data(
    kind: str,
    data: Mapping[str, Any],
    language: Language,
    *,
    letters: Mapping[str, str] = NO_LETTERS,
    unit: str = "m",
    number: GivenNumber | None = None,
) -> Iterator[tuple[str, Rich]]:
    """Yield the given data by their keys, one ``symbol = value unit`` each.

    Parameters
    ----------
    unit : str
        Unit of lengths.
    number : callable, optional
        Default: the number as it is.
    """
    notation, units = language.notation, language.notation.units

    def plain_number(value: float, unit_key: str, _: str) -> Rich:
        text = notation.as_input(value * UNITS[unit] if unit_key == "m" else value)
        return with_unit(text, units[unit if unit_key == "m" else unit_key]) if unit_key else text

    def of(letter: str) -> Rich:
        return point_name(letter, letters)

    for name, value in data.items():
        if value is None:
            continue
        symbol, told = language.synthesis["given"][name]
        if isinstance(value, tuple):
            rows = value if isinstance(value[0], tuple) else (value,)
            head = language.synthesis["given_rows"][f"{name}-{len(rows[0])}"].format(
                unit=units[unit], **{letter: of(letter) for letter in "OABC"}
            )
            text = "; ".join(_row(row, unit, language) for row in rows)
            yield name, f"{head}: {text}"
            continue
        size = sizes_of(kind).get(name)
        symbol = symbol if size is None else size_symbol(size, letters)
        shown = (number or plain_number)(value, told, name)
        yield name, f"{symbol} = {shown}"


def _row(row: tuple[float, ...], unit: str, language: Language) -> Rich:
    angles = ANGLES[len(row)]
    shown = (
        f"{language.notation.as_input(one)}°"
        if k in angles
        else language.notation.as_input(one * UNITS[unit])
        for k, one in enumerate(row)
    )
    return f"({f';{NO_BREAK}'.join(shown)})"


def synthesis_facts(text: StatedNumbers) -> list[GivenFact]:
    """Return the given data of the synthesis of a file; none without one."""
    problem = text.problem
    task = problem.synthesis
    if task is None:
        return []

    def number(value: float, unit: str, name: str) -> Rich:
        path = f"synthesis.{name}"
        if unit == "m":
            return text.metres(value, path)
        return text.number(value, unit, path) if unit else text.number_text(value, path)

    data: dict[str, object] = {"synthesis.kind": task.kind}
    if task.letters:
        data["synthesis.points"] = dict(task.letters)
    facts = []
    told = given_data(
        task.kind, task.data, text.language,
        letters=task.letters, unit=problem.unit, number=number,
    )  # fmt: skip
    for name, fact in told:
        value = task.data[name]
        facts.append(GivenFact(fact, {f"synthesis.{name}": value, **data}))
        data = {}
    return facts


def without_results(facts: list[GivenFact], text: StatedNumbers) -> list[GivenFact]:
    """Return the given data with the sizes that follow from the synthesis in one fact.

    Such a size is equal to itself: ``l_{OA} = l_{OA}``.
    """
    if text.problem.synthesis is None:
        return facts
    kept: dict[Rich, GivenFact] = {}
    found: dict[Rich, GivenFact] = {}
    for fact in facts:
        symbol, _, value = fact.text.partition(" = ")
        if value and symbol == value:
            found[symbol] = fact
        else:
            kept[fact.text] = fact
    symbols, data = [], dict[str, object]()
    for symbol, fact in found.items():
        given = next((one for one in kept if one.startswith(f"{symbol} = ")), None)
        if given is None:
            symbols.append(symbol)
            data |= fact.data
        else:  # given to the synthesis
            kept[given] = replace(kept[given], data={**kept[given].data, **fact.data})
    if symbols:
        told = text.language.synthesis.found.format(sizes=", ".join(symbols))
        kept[told] = GivenFact(told, data)
    return [*kept.values()]
