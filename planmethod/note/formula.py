r"""Rich text read once into a tree: letters, indices, bars, fractions, roots (формула).

The markup is small and reads like the textbook::

    v_{CB}          index below; one sign needs no braces: v_B
    a^{n}_{CB}      index above and index below, stacked, in either order
    \bar{v}_{B}     overbar: a thin line above the letters in the braces
    B_{3_{1}}       an index may have an index
    \frac{v}{l}     fraction: built up where possible, ``v/l`` in a line
    \sqrt{x}        root: ``√(x)`` in a line

Any other text represents itself, Russian included. A literal ``_``, ``^``, ``{``, ``}`` or
backslash is written with a backslash before it (``\_``); `escape` does that for text from outside.
"""

# no messages: mistakes in a program

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import TypeAlias, assert_never

from msgspec import Struct

from planmethod.errors import LayoutError
from planmethod.languages import translate

Rich: TypeAlias = str
"""Rich text: the way a formula or a sentence is written down in code and in catalogues."""

SPECIAL = "_^{}\\"
_TEXT_RUN = r"[^_^{}\\]+"


class Letters(Struct, frozen=True):
    """Signs on the base line (знаки строки)."""

    text: str


class Index(Struct, frozen=True):
    """Indices of the preceding sign (индексы).

    ``is_power``: whether the one above was written last, as in ``ω_{3}^{2}``: in a line it follows.
    """

    below: tuple[Node, ...]
    above: tuple[Node, ...]
    is_power: bool = False


class Overline(Struct, frozen=True):
    """Nodes with a line above them (черта сверху)."""

    body: tuple[Node, ...]


class Fraction(Struct, frozen=True):
    """A quotient (дробь)."""

    above: tuple[Node, ...]
    below: tuple[Node, ...]


class Root(Struct, frozen=True):
    """A square root (корень)."""

    body: tuple[Node, ...]


Node: TypeAlias = Letters | Index | Overline | Fraction | Root

RELATIONS = "=≈≠≡<>≤≥→"
"""Signs between the sides of a chain of equalities."""

_SUMS, _PRODUCTS = "+−-±", "·×/"
_COMMANDS = ("bar", "frac", "sqrt")
_STARTS = re.compile(rf"\\({'|'.join(_COMMANDS)})\{{")
_OPEN, _CLOSED = "([", ")]"


def escape(text: str) -> Rich:
    r"""Return rich text that shows the text as it stands (``_`` becomes ``\_``)."""
    return "".join("\\" + sign if sign in SPECIAL else sign for sign in text)


def capitalized(text: Rich) -> Rich:
    """Return rich text with a capital first letter."""
    return text[:1].upper() + text[1:]


def fraction(above: Rich, below: Rich) -> Rich:
    r"""Return a quotient, ``\frac{above}{below}``: neither needs brackets of its own."""
    return f"\\frac{{{above}}}{{{below}}}"


def root(body: Rich) -> Rich:
    r"""Return a square root, ``\sqrt{body}``."""
    return f"\\sqrt{{{body}}}"


@lru_cache(maxsize=4096)
def parse(markup: Rich) -> tuple[Node, ...]:
    """Return the tree of one line of rich text: its nodes as they are written.

    Raises
    ------
    LayoutError
        If braces do not pair, an index is empty, or a command is unknown.
    """
    nodes, end = _parse(markup, 0, in_braces=False)
    assert end == len(markup)
    return nodes


def _parse(markup: str, start: int, *, in_braces: bool) -> tuple[tuple[Node, ...], int]:
    """Read nodes from ``start`` up to the closing brace or the end."""
    nodes: list[Node] = []
    letters, i, plain = "", start, re.compile(_TEXT_RUN)

    def flush() -> None:
        nonlocal letters
        if letters:
            nodes.append(Letters(letters))
        letters = ""

    while i < len(markup):
        sign = markup[i]
        if sign == "}" and in_braces:
            flush()
            return tuple(nodes), i
        if sign == "\\" and markup[i + 1 : i + 2] in tuple(SPECIAL):
            letters += markup[i + 1]
            i += 2
        elif command := _STARTS.match(markup, i):
            flush()
            node, i = _commanded(markup, command)
            nodes.append(node)
        elif sign in "_^":
            flush()
            body, i = _index_body(markup, i)
            nodes.append(_merged(nodes, sign, body))
        elif sign in SPECIAL:
            raise _fault(
                markup, i, translate("'{}' does not pair or starts no known command", sign)
            )
        elif found := plain.match(markup, i):
            letters += found[0]
            i = found.end()
    if in_braces:
        raise _fault(markup, start, "the brace opened here is not closed")
    flush()
    return tuple(nodes), i


def _commanded(markup: str, command: re.Match[str]) -> tuple[Node, int]:
    """Read what a command makes; return it and the place after it."""
    body, end = _parse(markup, command.end(), in_braces=True)
    if command[1] == "bar":
        return Overline(body), end + 1
    if command[1] == "sqrt":
        return Root(body), end + 1
    if markup[end + 1 : end + 2] != "{":
        raise _fault(markup, end, "a fraction has two pairs of braces, one after the other")
    below, last = _parse(markup, end + 2, in_braces=True)
    if not (body and below):
        raise _fault(markup, command.start(), "the part above or below the line is empty")
    return Fraction(body, below), last + 1


def _index_body(markup: str, i: int) -> tuple[tuple[Node, ...], int]:
    """Read the index after the ``_`` or ``^`` at ``i``; return it and the place after it."""
    following = markup[i + 1 : i + 2]
    if following == "{":
        body, end = _parse(markup, i + 2, in_braces=True)
        if body:
            return body, end + 1
    elif following and following not in SPECIAL and not following.isspace():
        return (Letters(following),), i + 2
    raise _fault(markup, i, translate("an index is missing after '{}'", markup[i]))


def _merged(nodes: list[Node], sign: str, body: tuple[Node, ...]) -> Index:
    """Join an index with the one just before it when that has the other place free."""
    before = nodes[-1] if nodes else None
    if isinstance(before, Index):
        if sign == "_" and not before.below:
            nodes.pop()
            return Index(body, before.above)
        if sign == "^" and not before.above:
            nodes.pop()
            return Index(before.below, body, is_power=True)
    return Index(body, ()) if sign == "_" else Index((), body)


def _fault(markup: str, i: int, problem: str) -> LayoutError:
    return LayoutError(
        "Cannot set the inscription {!r}: {} (sign {}). Pair the braces, or write a "
        "literal sign with a backslash before it.",
        markup,
        problem,
        i + 1,
    )


# In one line -------------------------------------------------------------------------------------


def inline(nodes: Iterable[Node]) -> tuple[Node, ...]:
    """Return a formula in one line: ``a/b`` for a fraction, ``√(a)`` for a root.

    Brackets are set only where the value would change without them.
    """
    found: list[Node] = []

    def append(*several: Node) -> None:
        for node in several:
            last = found[-1] if found else None
            if isinstance(node, Letters) and isinstance(last, Letters):
                found[-1] = Letters(last.text + node.text)
            else:
                found.append(node)

    for node, after in pairwise((*nodes, None)):
        match node:
            case Letters():
                append(node)
            case Index(below, above, is_power):
                append(Index(inline(below), inline(above), is_power))
            case Overline(body):
                append(Overline(inline(body)))
            case Root(body):
                append(Letters("√("), *inline(body), Letters(")"))
            case Fraction(above, below):
                whole = isinstance(after, Index) and bool(after.above)
                append(*[Letters("(")] * whole)
                append(*_bracketed(above, _is_sum(above)), Letters("/"))
                append(*_bracketed(below, _is_sum(below) or _is_product(below) or _is_less(below)))
                append(*[Letters(")")] * whole)
            case None:
                pass
            case _:
                assert_never(node)
    return tuple(found)


def inlined(markup: Rich) -> Rich:
    """Return rich text in one line, without fractions and roots."""
    if "\\frac{" not in markup and "\\sqrt{" not in markup:
        return markup
    return written(inline(parse(markup)))


def written(nodes: Iterable[Node]) -> Rich:
    """Return a tree as it is written down."""

    def one(node: Node) -> Rich:
        match node:
            case Letters(text):
                return escape(text)
            case Index(below, above, is_power):
                high = f"^{{{written(above)}}}" if above else ""
                low = f"_{{{written(below)}}}" if below else ""
                return low + high if is_power else high + low
            case Overline(body):
                return f"\\bar{{{written(body)}}}"
            case Fraction(above, below):
                return fraction(written(above), written(below))
            case Root(body):
                return root(written(body))
            case _:
                assert_never(node)

    return "".join(map(one, nodes))


def sides(nodes: Iterable[Node]) -> Iterator[tuple[str, tuple[Node, ...]]]:
    """Yield the sides of a chain of equalities, each with the sign before it (цепочка равенств).

    The first has none. Brackets, fractions and indices are not divided; blanks beside the signs
    are dropped.
    """
    depth, sign, side = 0, "", list[Node]()
    for node in nodes:
        if not isinstance(node, Letters):
            side.append(node)
            continue
        text = ""
        for letter in node.text:
            depth += (letter in _OPEN) - (letter in _CLOSED)
            if depth or letter not in RELATIONS:
                text += letter
                continue
            yield sign, _stripped((*side, Letters(text)))
            sign, side, text = letter, [], ""
        side.append(Letters(text))
    yield sign, _stripped(side)


def _stripped(side: Sequence[Node]) -> tuple[Node, ...]:
    nodes = [node for node in side if node != Letters("")]
    if nodes and isinstance(first := nodes[0], Letters):
        nodes[0] = Letters(first.text.lstrip())
    if nodes and isinstance(last := nodes[-1], Letters):
        nodes[-1] = Letters(last.text.rstrip())
    return tuple(node for node in nodes if node != Letters(""))


def _bracketed(nodes: tuple[Node, ...], needed: bool) -> tuple[Node, ...]:
    return (Letters("("), *inline(nodes), Letters(")")) if needed else inline(nodes)


def _is_sum(nodes: tuple[Node, ...]) -> bool:
    """Return whether a formula is a sum, or a fraction itself."""
    alone = len(nodes) == 1 and isinstance(nodes[0], Fraction)
    return alone or any(sign in _SUMS for sign in _outside(nodes)[1:])


def _is_product(nodes: tuple[Node, ...]) -> bool:
    """Return whether a formula has several factors; a number with its power of ten is one."""
    if any(isinstance(node, Fraction) for node in nodes):
        return True
    signs = re.sub(r"·10(?=\^)", "", _outside(nodes))
    return any(sign in _PRODUCTS for sign in signs) or bool(re.search(r"(?<!\w)\d+[^\W\d_]", signs))


def _is_less(nodes: tuple[Node, ...]) -> bool:
    """Return whether a formula begins with a minus."""
    return bool(nodes) and isinstance(first := nodes[0], Letters) and first.text[:1] in "−-"


def _outside(nodes: tuple[Node, ...]) -> str:
    """Return the letters outside all brackets and bars; ``^`` and ``_`` replace indices."""
    depth, outside = 0, ""
    for node in nodes:
        match node:
            case Letters(text):
                for letter in text:
                    depth += (letter in _OPEN) - (letter in _CLOSED)
                    if letter == "|":
                        depth += -1 if depth else 1
                    outside += "" if depth or letter in _CLOSED else letter
            case Index(_, above):
                outside += "" if depth else "^" if above else "_"
            case _:
                outside += "" if depth else "x"
    return outside
