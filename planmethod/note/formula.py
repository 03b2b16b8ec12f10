r"""Rich text read once into a tree: letters, indices, bars (формула).

The markup is small and reads like the textbook::

    v_{CB}          index below; one sign needs no braces: v_B
    a^{n}_{CB}      index above and index below, stacked, in either order
    \bar{v}_{B}     overbar: a thin line above the letters in the braces
    B_{3_{1}}       an index may have an index

Any other text stands for itself, Russian included. A literal ``_``, ``^``, ``{``, ``}`` or
backslash is written with a backslash before it (``\_``); `escape` does that for text from outside.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TypeAlias

from msgspec import Struct

from planmethod.errors import LayoutError
from planmethod.languages import say

Rich: TypeAlias = str
"""Rich text: the way a formula or a sentence is written down in code and in catalogues."""

SPECIAL = "_^{}\\"
_PLAIN = r"[^_^{}\\]+"


class Letters(Struct, frozen=True):
    """Signs on the base line (знаки строки)."""

    text: str


class Index(Struct, frozen=True):
    """Indices of what stands before (индексы)."""

    below: tuple[Node, ...]
    above: tuple[Node, ...]


class Overline(Struct, frozen=True):
    """What has a line above it (черта сверху)."""

    body: tuple[Node, ...]


Node: TypeAlias = Letters | Index | Overline


def escape(text: str) -> Rich:
    r"""Return rich text that shows the text as it stands (``_`` becomes ``\_``)."""
    return "".join("\\" + sign if sign in SPECIAL else sign for sign in text)


@lru_cache(maxsize=4096)
def parse(markup: Rich) -> tuple[Node, ...]:
    """Return the tree of one line of rich text: letters, indices and bars, as they are written.

    Raises
    ------
    LayoutError
        If braces do not pair, an index has nothing in it, or a command is unknown.
    """
    nodes, end = _parse(markup, 0, closing=False)
    assert end == len(markup)
    return nodes


def _parse(markup: str, start: int, *, closing: bool) -> tuple[tuple[Node, ...], int]:
    """Read nodes from ``start`` up to the closing brace or the end."""
    nodes: list[Node] = []
    letters, i, plain = "", start, re.compile(_PLAIN)

    def flush() -> None:
        nonlocal letters
        if letters:
            nodes.append(Letters(letters))
        letters = ""

    while i < len(markup):
        sign = markup[i]
        if sign == "}" and closing:
            flush()
            return tuple(nodes), i
        if sign == "\\" and markup[i + 1 : i + 2] in tuple(SPECIAL):
            letters += markup[i + 1]
            i += 2
        elif markup.startswith("\\bar{", i):
            flush()
            body, end = _parse(markup, i + 5, closing=True)
            nodes.append(Overline(body))
            i = end + 1
        elif sign in "_^":
            flush()
            body, i = _index_body(markup, i)
            nodes.append(_merged(nodes, sign, body))
        elif sign in SPECIAL:
            raise _fault(markup, i, say("'{}' does not pair or starts no known command", sign))
        elif found := plain.match(markup, i):
            letters += found[0]
            i = found.end()
    if closing:
        raise _fault(markup, start, "the brace opened here is not closed")
    flush()
    return tuple(nodes), i


def _index_body(markup: str, i: int) -> tuple[tuple[Node, ...], int]:
    """Read what follows the ``_`` or ``^`` at ``i``; return it and the place after it."""
    following = markup[i + 1 : i + 2]
    if following == "{":
        body, end = _parse(markup, i + 2, closing=True)
        if body:
            return body, end + 1
    elif following and following not in SPECIAL and not following.isspace():
        return (Letters(following),), i + 2
    raise _fault(markup, i, say("nothing stands after '{}'", markup[i]))


def _merged(nodes: list[Node], sign: str, body: tuple[Node, ...]) -> Index:
    """Join an index with the one just before it when that has the other place free."""
    before = nodes[-1] if nodes else None
    if isinstance(before, Index):
        if sign == "_" and not before.below:
            nodes.pop()
            return Index(body, before.above)
        if sign == "^" and not before.above:
            nodes.pop()
            return Index(before.below, body)
    return Index(body, ()) if sign == "_" else Index((), body)


def _fault(markup: str, i: int, what: str) -> LayoutError:
    return LayoutError(
        "Cannot set the inscription {!r}: {} (sign {}). Pair the braces, or write a "
        "literal sign with a backslash before it.",
        markup,
        what,
        i + 1,
    )
