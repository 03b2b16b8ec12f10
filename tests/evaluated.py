"""Formulas of a text read back: the value of each side of an equation between numbers."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import pairwise
from math import pi, radians

import pytest
from doors import (
    Document,
    DocumentItem as Item,
    DocumentStep as Step,
    Formula,
    Note,
    Paragraph,
    inlined,
)

TERM = r"(?:[\d(π|](?:[\d,.()·/^{}−°π|]*[\d)}°π|])?)"
SUM = rf"−?{TERM}(?: [+−] {TERM})*"
SIDE = rf"(?:{SUM})(?: ?%| \(?[^\W\d][^\s=;,]*)?"
START = r"(?:(?<= = )|(?<=: )|(?<=длина отрезка )|(?<=length of the segment is ))"
CHAIN = re.compile(rf"{START}{SIDE}(?: = {SIDE})+")
DEGREES = ("град", "deg")


def texts_of(document: Document) -> Iterator[str]:
    """Yield the sentences and formulas of a document."""
    for node in document.nodes:
        if isinstance(node, Formula | Item | Note | Paragraph):
            yield node.text
        elif isinstance(node, Step):
            yield from node.lines


def equations_in(texts: Iterable[str]) -> Iterator[tuple[str, list[float], float]]:
    """Yield the equations between numbers, the values of their sides, and the size of the terms."""
    for text in texts:
        plain = re.sub(r"[\u00a0\u202f]", " ", inlined(text))
        for found in CHAIN.finditer(plain):
            if re.search(r"\d[)}°]*[·/^]|[+−] ", found[0]):
                yield found[0], *_values(found[0].split(" = "))


def _values(sides: list[str]) -> tuple[list[float], float]:
    """Return the values of sides, angles in radians, and the largest sum of sizes of terms."""
    values, largest, factor = [], 0.0, 1.0
    for side in reversed(sides):
        found = re.match(SUM, side)
        assert found is not None, side
        plain = re.sub(r"\^\{([^}]*)\}", r"**(\1)", found[0]).replace(",", ".")
        plain = re.sub(r"\|([^|]*)\|", r"abs(\1)", plain.replace("·", "*").replace("−", "-"))
        plain = re.sub(r"([\d.]+)°", rf"(\1*{radians(1.0)})", plain.replace("π", str(pi)))
        if unit := side[found.end() :].lstrip():  # a side without a unit has that of the next one
            factor = radians(1.0) if unit.startswith(DEGREES) else 1.0
        values.append(factor * float(eval(plain)))
        sizes = plain.replace("(-", "(+").replace("- ", "+ ").lstrip("-")
        largest = max(largest, factor * float(eval(sizes)))
        if unit == "%":  # a share has two digits
            largest = max(largest, 500.0 * 10.0 ** -len(plain.partition(".")[2]))
    return values[::-1], largest


def count_equations_that_hold(texts: Iterable[str], share: float = 1.2e-3) -> int:
    """Assert that both sides of equations agree, to a share of their terms; count them."""
    count = 0
    for equation, values, size in equations_in(texts):
        for one, other in pairwise(values):
            assert one == pytest.approx(other, rel=0.0, abs=share * size), equation
            count += 1
    return count
