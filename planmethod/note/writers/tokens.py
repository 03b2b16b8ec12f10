"""Letters of a formula by what they are: numbers, names, signs, brackets (знаки формулы).

Runs of letters are set by their content: Latin and Greek ones are symbols, set italic; digits,
names of functions, units and Russian are upright.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence

from msgspec import Struct

from planmethod.note.formula import Letters, Node

_GREEK = "\u0370-\u03ff"
_NAMES = "sin|cos|tg|ctg|arcsin|arccos|arctg|tan|arctan|inv|const|max|min|log|ln|exp"
_TOKENS = re.compile(
    r"(?P<unit>(?<=[\d)][ \u00a0])(?:[A-Za-z]+|\([A-Za-z]+[/·][A-Za-z]+\)?)"
    r"(?:[/·](?:[A-Za-z]+|\([A-Za-z]+(?:[/·][A-Za-z]+)*\)?))*|\)/mm\b)"  # mm/(m/s²), (N·m)/mm
    r"|(?P<brackets>[()\[\]|])"
    r"|(?P<number>\d+(?:[.,]\d+)*)"
    rf"|(?P<name>(?:{_NAMES})(?![A-Za-z]))"
    rf"|(?P<letters>[A-Za-z{_GREEK}]+)"
    r"|(?P<sign>[ \u00a0]*[=+−±·×/<>≤≥≈≠≡→-][ \u00a0]*)"
    r"|(?P<blank>[ \u00a0]+)"
    r"|(?P<text>[\u0400-\u04ff]+(?:[-./·][\u0400-\u04ff]+)*|.)",
    re.DOTALL,
)

PAIRS = {"(": ")", "[": "]", "|": "|"}
"""Brackets and what closes them."""

_KEYWORDS = frozenset({"in", "ni", "or", "pi", "mu", "nu", "xi", "Pi", "Xi", "ge", "le", "gt", "lt",
                       "ll", "gg", "ne", "im", "re", "Im", "Re", "to", "rm", "it", "bf", "sum",
                       "lim", "int", "and", "neg", "dot", "hat", "bar", "vec", "div", "sub", "sup",
                       "abs", "rho", "eta", "tau", "phi", "chi", "psi"})  # fmt: skip
"""Letters in a row that the formula editor of LibreOffice takes for a command of its own."""


class Token(Struct, frozen=True):
    """Letters of one kind, or a node of another type (знак).

    Attributes
    ----------
    kind : str
        ``brackets``, ``number``, ``unit``, ``name`` of a function, ``letters``, ``sign``,
        ``blank``, ``text`` or ``node``.
    """

    kind: str
    text: str = ""
    node: Node | None = None


def tokens_of(nodes: Iterable[Node]) -> Iterator[Token]:
    """Yield what a formula is made of, in order."""
    for node in nodes:
        if not isinstance(node, Letters):
            yield Token("node", node=node)
            continue
        for found in _TOKENS.finditer(node.text):
            kind = str(found.lastgroup)
            if kind == "letters" and found[0] in _KEYWORDS:
                yield from (Token(kind, letter) for letter in found[0])
            else:
                yield Token(kind, found[0])


def matching_bracket(tokens: Sequence[Token], start: int) -> int | None:
    """Return the index of the bracket that closes the one at ``start``."""
    opened, depth = tokens[start].text, 0
    closed = PAIRS.get(opened)
    if closed is None:
        return None
    for k in range(start + 1, len(tokens)):
        if tokens[k].kind != "brackets":
            continue
        if tokens[k].text == closed:
            if not depth:
                return k
            depth -= 1
        elif tokens[k].text == opened:
            depth += 1
    return None
