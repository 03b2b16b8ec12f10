"""Formulas as equations of Word: Office Math made of the tree (формулы Word).

Runs of letters are set by their content: Latin and Greek ones are symbols, italic; digits, names
of functions, units and Russian are upright. Brackets that have their pair are delimiters, which
grow with their content. A sign that lacks a side, as where a formula is cut, is text: a program
that sets it as a sign would show a box for the side. An index without a letter before it is put
on a letter of zero width, for the same reason.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import zip_longest
from math import inf
from typing import Any, TypeAlias, assert_never

from lxml.builder import ElementMaker
from msgspec import Struct

from planmethod.note.document import Equation
from planmethod.note.formula import Fraction, Index, Letters, Node, Overline, Root, parse
from planmethod.note.writers.formulas import PAIRS, Token, matching_bracket, tokens_of, width_em

MATH = "http://schemas.openxmlformats.org/officeDocument/2006/math"
WORD = "http://schemas.openxmlformats.org/wordprocessingml/2006/main"
FONT, TEXT_FONT = "Cambria Math", "Times New Roman"
EMPTY = "\N{ZERO WIDTH SPACE}"

Element: TypeAlias = Any

M = ElementMaker(namespace=MATH, nsmap={"m": MATH, "w": WORD})
W = ElementMaker(namespace=WORD, nsmap={"m": MATH, "w": WORD})
_SPACE = "{http://www.w3.org/XML/1998/namespace}space"

_UNARY = "+−-±"
_SIGN = 2.0
"""Width of a sign between vectors with its blanks, heights of the font."""


# Formulas -----------------------------------------------------------------------------------------


def equation(nodes: Iterable[Node]) -> Element:
    """Return a formula as an ``m:oMath``."""
    return M.oMath(*elements(nodes))


def paragraph(*formulas: Element, side: str = "center") -> Element:
    """Return formulas on a line of their own, an ``m:oMathPara``."""
    return M.oMathPara(M.oMathParaPr(M.jc({f"{{{MATH}}}val": side})), *formulas)


def elements(nodes: Iterable[Node]) -> list[Element]:
    """Return the elements of an equation, in order."""
    return _sequence(list(tokens_of(nodes)))


def _sequence(tokens: Sequence[Token]) -> list[Element]:
    found: list[Element] = []
    operand, k = False, 0
    while k < len(tokens):
        token, kind = tokens[k], tokens[k].kind
        k += 1
        if kind == "brackets":
            end = matching_bracket(tokens, k - 1)
            if end is None:
                found.append(_text(token.text))
            else:
                inside = _sequence(tokens[k:end])
                k = end + 1
                if (
                    token.text == "|"
                    or _is_tall(inside)
                    or (k < len(tokens) and isinstance(tokens[k].node, Index))
                ):
                    inside = inside or [_text(EMPTY)]
                    found.append(delimited(token.text, PAIRS[token.text], inside))
                else:
                    found += [_run(token.text, "p"), *inside, _run(PAIRS[token.text], "p")]
            operand = True
        elif kind == "sign":
            after = tokens[k : k + 2]  # a sign may have one before its number: = −3
            if after and after[0].kind == "sign" and after[0].text.strip(" \u00a0") in _UNARY:
                after = after[1:]
            has_next = bool(after) and after[0].kind != "sign"
            sign = token.text.strip(" \u00a0")
            if has_next and (operand or sign in _UNARY):
                found.append(_run(sign, "p"))
            else:
                found.append(_text(token.text))
            operand = False
        elif kind == "node":
            assert token.node is not None
            if isinstance(token.node, Index):
                base, rest = _base(found[-1]) if operand and found else (_text(EMPTY), None)
                if operand and found:
                    found.pop()
                found += [*([rest] if rest is not None else []), _indexed(base, token.node)]
            else:
                found.append(_element(token.node))
            operand = True
        elif kind == "blank":
            beside = k < len(tokens) and tokens[k].kind in ("unit", "text", "letters", "name")
            if operand and (beside or k < len(tokens)):
                found.append(_text("\u00a0"))
        else:
            style = {"letters": "i", "number": "p"}.get(kind)
            found.append(_run(token.text, style) if style else _text(token.text))
            operand = True
    return found


def _element(node: Node) -> Element:
    match node:
        case Letters():
            return M.box(M.e(*elements([node])))
        case Index():
            return _indexed(_text(EMPTY), node)
        case Overline(body):
            return bar(elements(body), "top")
        case Fraction(above, below):
            return M.f(M.num(*elements(above)), M.den(*elements(below)))
        case Root(body):
            hidden = M.radPr(M.degHide({f"{{{MATH}}}val": "1"}))
            return M.rad(hidden, M.deg(), M.e(*elements(body)))
        case _:
            assert_never(node)


def _indexed(base: Element, index: Index) -> Element:
    e, sub, sup = M.e(base), M.sub(*elements(index.below)), M.sup(*elements(index.above))
    if not index.above:
        return M.sSub(e, sub)
    return M.sSubSup(e, sub, sup) if index.below else M.sSup(e, sup)


def _base(last: Element) -> tuple[Element, Element | None]:
    """Return the letter that carries an index, and the part of its run before it."""
    text = last.find(f"{{{MATH}}}t")
    style = last.find(f"{{{MATH}}}rPr/{{{MATH}}}sty")
    is_symbol = style is not None and style.get(f"{{{MATH}}}val") == "i"
    if last.tag != f"{{{MATH}}}r" or not is_symbol or len(text.text) == 1:
        return last, None
    return _run(text.text[-1], "i"), _run(text.text[:-1], "i")


def bar(body: Sequence[Element], place: str) -> Element:
    """Return elements with a line above or below them (``place`` is ``top`` or ``bot``)."""
    return M.bar(M.barPr(M.pos({f"{{{MATH}}}val": place})), M.e(*body))


def _is_tall(inside: Sequence[Element]) -> bool:
    """Return whether elements are higher than brackets of one line; bars are always delimiters."""
    return not inside or any(
        element.tag == f"{{{MATH}}}f" or element.find(f".//{{{MATH}}}f") is not None
        for element in inside
    )


def delimited(opened: str, closed: str, inside: Sequence[Element]) -> Element:
    """Return elements between two delimiters that grow with them."""
    value = f"{{{MATH}}}val"
    return M.d(M.dPr(M.begChr({value: opened}), M.endChr({value: closed})), M.e(*inside))


def _run(text: str, style: str) -> Element:
    fonts = _fonts(FONT)
    return M.r(M.rPr(M.sty({f"{{{MATH}}}val": style})), fonts, M.t(text))


def _text(text: str) -> Element:
    return M.r(M.rPr(M.nor()), _fonts(TEXT_FONT), M.t({_SPACE: "preserve"}, text))


def _fonts(name: str) -> Element:
    return W.rPr(W.rFonts({f"{{{WORD}}}{key}": name for key in ("ascii", "hAnsi", "cs")}))


# Vector equations ---------------------------------------------------------------------------------


class Addend(Struct, frozen=True):
    """A term of a vector equation with the sign before it (слагаемое).

    ``low`` is placed below it: a direction, or nothing; ``width`` in heights of the font.
    """

    sign: str
    high: list[Element]
    low: list[Element]
    width: float


def vector_equations(equations: Sequence[Equation], max_width: float = inf) -> Element:
    """Return vector equations as one formula: a system where there are several.

    One that is wider than ``max_width`` (in heights of the font) is cut at its signs, and the sign
    is repeated on the next line.
    """
    lines = [list(line) for one in equations for line in _lines(list(_addends(one)), max_width)]
    if len(lines) == 1:
        return M.oMath(*lines[0])
    array = M.eqArr(*(M.e(*line) for line in lines))
    return M.oMath(array if len(equations) == 1 else delimited("{", "", [array]))


def _addends(one: Equation) -> Iterator[Addend]:
    named = bool(one.name) and not one.right
    if named:
        name = parse(one.name)
        yield Addend("", elements(name), [], width_em(name))
    for number, term in enumerate((*one.left, *one.right)):
        sign = "=" if number == len(one.left) or (named and not number) else "+" if number else ""
        symbol, direction = parse(term.symbol), parse(term.direction)
        body = vector(term.symbol)
        for _ in range(term.underlines):
            body = [bar(body, "bot")]
        yield Addend(sign, body, elements(direction), max(width_em(symbol), width_em(direction)))
    if not one.right:
        yield Addend("=", [_run("0", "p")], [], 0.5)


def _lines(addends: Sequence[Addend], max_width: float) -> Iterator[list[Element]]:
    lines: list[list[Addend]] = [[]]
    width = 0.0
    for addend in addends:
        own = addend.width + _SIGN * bool(addend.sign)
        if lines[-1] and width + own > max_width - _SIGN:
            lines.append([])
            width = 0.0
        lines[-1].append(addend)
        width += own
    for line, after in zip_longest(lines, lines[1:]):
        cells = list(_cells(line, after[0].sign if after else ""))
        yield cells[0][0] if len(cells) == 1 else [_two_rows(cells)]


def _cells(line: Sequence[Addend], end: str) -> Iterator[tuple[list[Element], list[Element]]]:
    """Yield the cells of a line, each with the cell below it: a direction or nothing.

    A term that has a direction has its own cell, so that it is centred above it.
    """
    found: list[Element] = []
    for addend in line:
        found += [_sign(addend.sign)] if addend.sign else []
        if not addend.low:
            found += addend.high
            continue
        if found:
            yield found, []
        yield addend.high, addend.low
        found = []
    found += [_sign(end)] if end else []
    if found:
        yield found, []


def _sign(sign: str) -> Element:
    """Return a sign as text: at the edge of a cell LibreOffice would show a box for its side."""
    return _text(f"\u00a0{sign}\u00a0")


def _two_rows(cells: Sequence[tuple[list[Element], list[Element]]]) -> Element:
    """Return a matrix of two rows, the lower one in smaller letters.

    A limit below a term would do, but LibreOffice sets it in letters of an index.
    """
    value = f"{{{MATH}}}val"
    looks = M.mPr(
        M.baseJc({value: "top"}),
        M.plcHide({value: "1"}),
        M.rSpRule({value: "0"}),
        M.cGpRule({value: "3"}),
        M.rSp({value: "0"}),
        M.cSp({value: "0"}),
        M.cGp({value: "0"}),
        M.mcs(M.mc(M.mcPr(M.count({value: str(len(cells))}), M.mcJc({value: "center"})))),
    )
    smaller = (M.argPr(M.argSz({value: "-1"})) for _ in cells)
    below = (
        M.e(size, *(low or [_text(EMPTY)])) for size, (_, low) in zip(smaller, cells, strict=True)
    )
    return M.m(looks, M.mr(*(M.e(*high) for high, _ in cells)), M.mr(*below))


def vector(symbol: str) -> list[Element]:
    """Return the symbol of a vector: its letter has a line above it, its indices have none."""
    nodes = parse(symbol)
    first, rest = nodes[:1], nodes[1:]
    if first and isinstance(first[0], Letters):
        return elements((Overline(first), *rest))
    return elements(nodes)
