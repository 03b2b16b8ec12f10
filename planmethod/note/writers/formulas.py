"""Formulas for writers: what their letters are, line breaks, formulas in sentences."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, groupby
from typing import assert_never

from msgspec import Struct

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

_GREEK = "\u0370-\u03ff"
_NAMES = "atan2|sin|cos|tg|ctg|arcsin|arccos|arctg|tan|arctan|inv|const|max|min|log|ln|exp"
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
            yield sign, (*term, *_letters_of(node.text[start : found.start()]))
            sign, term, start = found[1], [], found.end()
        depth += sum((s in "([") - (s in ")]") for s in node.text)
        term += _letters_of(node.text[start:])
    yield sign, tuple(term)


def _letters_of(text: str) -> tuple[Letters, ...]:
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


_RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ⁿᵗᵏʳ", "0123456789−nτkr", strict=True))
_LOWERED = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
_LEVELS = re.compile(f"([{''.join(_RAISED)}]+|[{''.join(_LOWERED)}]+)")
_BLANKS = re.compile("([ \u00a0\n]+)")
_STOPS, _LEADS = ".,;:!?»", "«"
_EQUAL, _SIGNS = "=≈≠≡<>≤≥", "=≈≠≡<>≤≥+−±·×∥⊥-"
_TERM = re.compile(
    r"(?:\d[\d.,]*|arccos|const|(?<![A-Za-z\u0370-\u03ff])[A-Za-z\u0370-\u03ff]{1,4}\d{0,2}[′']{0,2}"
    r"|[·×/+−±%°()\[\]|-])+"
)
"""Numbers and short names with the signs between them."""

_FUNCTIONS = frozenset({"sin", "cos", "tg", "ctg", "tan", "inv", "arccos"})

_SYMBOL = re.compile(
    r"\(?(?![IVX]+\b)(?:[A-Z]{1,3}|[a-z\u0370-\u03ff]{1,2}|x[-–]x|y[-–]y)\d?[′″']*\)?"
)
"""Letters of points and segments, but not Latin numerals."""

JOINER = "\N{ZERO WIDTH JOINER}"
"""Sign that forbids a line break, without width: Word's “no-width non break”."""

_RANGE = re.compile(r"(?<=\d)–(?=\d)")
_PAIR = re.compile(r"(?<=;) (?=[−-]?[\d.,]+\))|(?<=\d\)) (?=[^\W\d_]{1,3}\b)")
_RUSSIAN = re.compile(r"[\u0400-\u04ff]")

Word = tuple[Node, ...]

_CONTROL = "[^\n\x20-\x7e\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"


def without_control_characters(text: str) -> str:
    """Return a text without signs that no page can show."""
    return re.sub(_CONTROL, " ", text)


class SentencePart(Struct, frozen=True):
    """A part of a sentence (часть предложения): words, or a formula."""

    nodes: tuple[Node, ...]
    is_formula: bool

    @property
    def text(self) -> str:
        """Letters of a part that is not a formula."""
        return "".join(node.text for node in self.nodes if isinstance(node, Letters))


def units_of(units: Mapping[str, str]) -> frozenset[str]:
    """Return the letters that units of a language are made of: ``м``, ``рад``."""
    return frozenset(name for unit in units.values() for name in re.findall(r"[^\W\d_]+", unit))


def pieces(
    nodes: Iterable[Node], units: frozenset[str], *, symbols: bool = False
) -> list[SentencePart]:
    """Return a sentence as texts and formulas in turn.

    Parameters
    ----------
    nodes : iterable of Node
    units : frozenset of str
        Letters of units.
    symbols : bool
        In a Russian sentence a single Latin letter is a formula too, so that the points ``B`` and
        ``O_{1}`` are set alike.
    """
    nodes = tuple(nodes)
    symbols = symbols and any(_RUSSIAN.search(n.text) for n in nodes if isinstance(n, Letters))
    found: list[SentencePart] = []
    run: list[Word] = []

    def is_formula(word: Word) -> bool:
        return _is_certain(word) or (symbols and bool(_SYMBOL.fullmatch(_letters(word))))

    def close() -> None:
        """Put the words that may be a formula where they belong."""
        blanks: list[Word] = []
        while run and _is_blank(run[-1]):
            blanks.insert(0, run.pop())
        whole = tuple(chain.from_iterable(run))
        found.extend(
            _balanced(whole) if any(map(is_formula, run)) else [SentencePart(whole, False)]
        )
        found.extend(SentencePart(word, False) for word in blanks)
        run.clear()

    for word in _words(with_levels(nodes)):
        if _is_blank(word):
            if run:
                run.append(word)
            else:
                found.append(SentencePart(word, False))
            continue
        lead, core, tail = _stripped(word)
        is_part = _is_part(core, units) or (bool(core) and is_formula(core))
        if lead or not is_part or not _joins(run, core, units):
            close()
            found.append(SentencePart(lead, False))
        if is_part:
            run.append(core)
        else:
            found.append(SentencePart(core, False))
        if tail:
            close()
            found.append(SentencePart(tail, False))
    close()
    gathered = groupby((piece for piece in found if piece.nodes), lambda piece: piece.is_formula)
    return [
        SentencePart(tuple(chain.from_iterable(piece.nodes for piece in group)), is_formula)
        for is_formula, group in gathered
    ]


def sole_formula(parts: Sequence[SentencePart]) -> tuple[Node, ...]:
    """Return the formula of a line that has only a stop besides; empty for another line."""
    ending = parts[1].text.strip() if len(parts) == 2 else ""
    if parts and parts[0].is_formula and (len(parts) == 1 or ending in (".", ",", ";")):
        return (*parts[0].nodes, *((Letters(ending),) if ending else ()))
    return ()


def with_stops(parts: Sequence[SentencePart]) -> Iterator[SentencePart]:
    """Yield the parts of a sentence, a stop in the formula before it: no line begins with one."""
    stop = ""
    for piece, after in zip(parts, [*parts[1:], None], strict=False):  # there may be none
        if not piece.is_formula:
            text = piece.text.removeprefix(stop)
            stop = ""
            if text:
                yield SentencePart((Letters(text),), False)
            continue
        text = after.text if after is not None else ""
        stop = text[:1] if text[:1] in (*_STOPS, ")") else ""
        yield SentencePart((*piece.nodes, *_word_of(stop)), True)


def tied(text: str) -> str:
    """Return a text whose lines do not end within a range of numbers or a pair of coordinates."""
    return _RANGE.sub(f"–{JOINER}", _PAIR.sub("\u00a0", text))


def with_levels(nodes: Iterable[Node]) -> Iterator[Node]:
    """Yield the nodes with indices for letters that are raised or lowered themselves: ``м/с²``."""
    for node in nodes:
        if not isinstance(node, Letters):
            yield node
            continue
        for part in filter(None, _LEVELS.split(node.text)):
            if part[0] in _RAISED:
                yield Index((), (Letters("".join(_RAISED[c] for c in part)),))
            elif part[0] in _LOWERED:
                yield Index((Letters("".join(_LOWERED[c] for c in part)),), ())
            else:
                yield Letters(part)


def _words(nodes: Iterable[Node]) -> Iterator[Word]:
    """Yield words and the blanks between them."""
    word: list[Node] = []
    for node in nodes:
        if not isinstance(node, Letters):
            word.append(node)
            continue
        for part in filter(None, _BLANKS.split(node.text)):
            if _BLANKS.fullmatch(part):
                if word:
                    yield tuple(word)
                yield (Letters(part),)
                word = []
            else:
                word.append(Letters(part))
    if word:
        yield tuple(word)


def _is_blank(word: Word) -> bool:
    return len(word) == 1 and isinstance(word[0], Letters) and bool(_BLANKS.fullmatch(word[0].text))


def _letters(word: Word) -> str:
    return "".join(node.text if isinstance(node, Letters) else "\0" for node in word)


def _stripped(word: Word) -> tuple[Word, Word, Word]:
    """Return the quotation mark before a word, the word, and the stops after it."""
    lead, tail = "", ""
    core = list(word)
    if isinstance(first := core[0], Letters):
        rest = first.text.lstrip(_LEADS)
        lead, core[0] = first.text[: len(first.text) - len(rest)], Letters(rest)
    if isinstance(last := core[-1], Letters):
        rest = last.text.rstrip(_STOPS)
        tail, core[-1] = last.text[len(rest) :], Letters(rest)
    kept = tuple(node for node in core if node != Letters(""))
    return _word_of(lead), kept, _word_of(tail)


def _word_of(text: str) -> Word:
    return (Letters(text),) if text else ()


def _is_certain(word: Word) -> bool:
    """Return whether a word is part of a formula, whatever its neighbours."""
    return any(not isinstance(node, Letters) for node in word) or any(
        sign in _EQUAL for sign in _letters(word)
    )


def _is_part(word: Word, units: frozenset[str]) -> bool:
    """Return whether a word may be part of a formula."""
    text = _letters(word)
    return bool(word) and (
        _is_certain(word)
        or bool(_TERM.fullmatch(text))
        or all(sign in _SIGNS for sign in text)
        or _is_unit(text, units)
    )


def _is_unit(text: str, units: frozenset[str]) -> bool:
    names = re.findall(r"[^\W\d_]+", text)
    return bool(names) and set(names) <= units and not re.search(r"[^\w/·()\0]", text)


def _joins(run: Sequence[Word], word: Word, units: frozenset[str]) -> bool:
    """Return whether a word continues a possible formula before it."""
    before = next((_letters(one) for one in reversed(run) if not _is_blank(one)), "")
    text = _letters(word)
    if not before or before[-1] in _SIGNS or text[0] in _SIGNS:
        return True
    is_number = before[-1].isdigit() or before[-1] in "\0)"
    return before in _FUNCTIONS or (is_number and _is_unit(text, units))


def _balanced(nodes: tuple[Node, ...]) -> Iterator[SentencePart]:
    """Yield a formula without the brackets of the sentence that it begins or ends with."""
    inside = list(nodes)
    opened = sum((s == "(") - (s == ")") for s in _letters(nodes))
    lead = tail = ""
    while opened > 0 and isinstance(first := inside[0], Letters) and first.text.startswith("("):
        lead, inside[0], opened = lead + "(", Letters(first.text[1:]), opened - 1
    while opened < 0 and isinstance(last := inside[-1], Letters) and last.text.endswith(")"):
        tail, inside[-1], opened = tail + ")", Letters(last.text[:-1]), opened + 1
    yield SentencePart(_word_of(lead), False)
    yield SentencePart(tuple(node for node in inside if node != Letters("")), True)
    yield SentencePart(_word_of(tail), False)
