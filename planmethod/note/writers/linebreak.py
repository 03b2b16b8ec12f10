"""Formulas cut into lines that fit, at their signs (перенос формул)."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain
from typing import assert_never

from planmethod.note.formula import (
    Fraction,
    Index,
    Letters,
    Node,
    Overline,
    Root,
    inline,
    sides,
)

_SMALL = 0.7
"""Letters of an index, in parts of the others."""

_SUMS = re.compile(r" ([+−]) ")


def width_em(nodes: Iterable[Node]) -> float:
    """Return the approximate width of a formula, in heights of its font."""
    return sum(map(_node_width_em, nodes))


def _node_width_em(node: Node) -> float:
    match node:
        case Letters(text):
            return 0.47 * len(text)
        case Index(below, above):
            return _SMALL * max(width_em(below), width_em(above))
        case Overline(body):
            return width_em(body)
        case Root(body):
            return width_em(body) + 0.9
        case Fraction(above, below):
            return max(width_em(above), width_em(below)) + 0.3
        case _:
            assert_never(node)


def chain_of(nodes: Iterable[Node], max_width: float) -> Iterator[tuple[str, tuple[Node, ...]]]:
    """Yield the parts of a formula that may be on lines of their own, each with its sign.

    The parts are the sides of its equalities. A side that is wider than ``max_width`` (in heights
    of the font) is cut into the terms of its sums; a term that still is, is written in one line,
    without fractions, and cut at every sum.
    """
    for sign, side in sides(nodes):
        if width_em(side) <= max_width:
            yield sign, side
            continue
        for plus, term in _terms(sign, side, outside=True):
            if width_em(term) <= max_width:
                yield plus, term
            else:
                yield from _terms(plus, inline(term), outside=False)


def _terms(
    sign: str, nodes: Iterable[Node], *, outside: bool
) -> Iterator[tuple[str, tuple[Node, ...]]]:
    """Yield the terms of sums, each with its sign; of those ``outside`` of brackets alone."""
    term: list[Node] = []
    depth = 0
    for node in nodes:
        if not isinstance(node, Letters):
            term.append(node)
            continue
        start = 0
        for found in _SUMS.finditer(node.text):
            before = node.text[: found.start()]
            opened = depth + sum((s in "([") - (s in ")]") for s in before)
            if outside and opened:
                continue
            yield sign, (*term, *_some(node.text[start : found.start()]))
            sign, term, start = found[1], [], found.end()
        depth += sum((s in "([") - (s in ")]") for s in node.text)
        term += _some(node.text[start:])
    yield sign, tuple(term)


def _some(text: str) -> tuple[Letters, ...]:
    return (Letters(text),) if text else ()


def lines_of(nodes: Sequence[Node], max_width: float) -> list[tuple[Node, ...]]:
    """Return a formula in lines; where it is cut, the sign ends a line and begins the next."""
    lines: list[list[tuple[str, tuple[Node, ...]]]] = [[]]
    width = 0.0
    for sign, part in chain_of(nodes, max_width):
        own = width_em(part) + 1.5 * bool(sign)
        if lines[-1] and width + own > max_width:
            lines.append([])
            width = 0.0
        lines[-1].append((sign, part))
        width += own
    found = []
    for line, after in zip(lines, [*lines[1:], None], strict=True):
        parts = (_with_sign(sign, part) for sign, part in line)
        end = (Letters(f" {after[0][0]}"),) if after else ()
        found.append((*chain.from_iterable(parts), *end))
    return found


def _with_sign(sign: str, part: tuple[Node, ...]) -> tuple[Node, ...]:
    return (Letters(f" {sign} "), *part) if sign else part
