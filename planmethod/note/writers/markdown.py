r"""A document as Markdown with formulas in LaTeX (документ в Markdown).

Repository pages render it. Formulas are put between dollar signs; those within sentences are found
by `planmethod.note.writers.formulas`. Figures are reduced to their captions.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from itertools import groupby
from typing import assert_never

from msgspec.structs import replace

from planmethod.note.document import Document, Equation, PageBreak, Table, Term
from planmethod.note.formula import Fraction, Index, Letters, Node, Overline, Rich, Root, parse
from planmethod.note.wording import Language
from planmethod.note.writers import lowering
from planmethod.note.writers.formulas import (
    PAIRS,
    Token,
    matching_bracket,
    tokens_of,
    with_levels,
)
from planmethod.note.writers.lowering import LoweredDocument, LoweredNode, TextKind, lower

_SPECIAL = r"[\\`*_$<>|\[\]]|^[#+-](?=\s)|^\d+[.)](?=\s)"
"""Text that Markdown would treat as markup, by its last sign: emphasis, a link, a list entry."""

_SIGNS = {
    "−": "-", "·": r"\cdot ", "×": r"\times ", "±": r"\pm ", "≤": r"\le ", "≥": r"\ge ",
    "≈": r"\approx ", "≠": r"\ne ", "≡": r"\equiv ", "→": r"\to ", "∥": r"\parallel ",
    "⊥": r"\perp ", "∠": r"\angle ", "°": r"^{\circ}", "%": r"\%", "|": r"\vert ", "<": r"\lt ",
    ">": r"\gt ", "′": "'", "…": r"\ldots ", "_": r"\_", "{": r"\{", "}": r"\}", "#": r"\#",
    "&": r"\&", "^": r"\wedge ",
}  # fmt: skip
_FUNCTIONS = ("sin", "cos", "tan", "max", "min", "ln", "log", "exp", "arcsin", "arccos", "arctan")
_SPARE = r"(?<=[A-Za-z]) +(?=[_^{}()])"
"""The space after a command that no letter follows."""

_VARIANTS = {
    "ε": r"\varepsilon ",
    "φ": r"\varphi ",
    "ϑ": r"\vartheta ",
    "λ": r"\lambda ",
    "Λ": r"\Lambda ",
}
"""Greek letters whose commands are not their names of Unicode."""


def markdown_document(written: Document, language: Language) -> str:
    """Return a document as Markdown.

    Raises
    ------
    LayoutError
        A formula is malformed, or a text refers to a missing key.
    """
    return "\n".join(_Writer(lower(written, language)).lines())


class _Writer:
    """Writes nodes one after another."""

    def __init__(self, written: LoweredDocument) -> None:
        self._written = written

    def lines(self) -> Iterator[str]:
        """Yield the lines of a document; entries of one list have no blank line between them."""
        before: LoweredNode | None = None
        for node in _joined(self._written.nodes):
            lines = self._node(node)
            if lines and before is not None and not _is_of_one_list(before, node):
                yield ""
            yield from lines
            before = node if lines else before

    def _node(self, node: LoweredNode) -> list[str]:
        match node:
            case lowering.Cover(lines=lines):
                return _broken(list(map(self._text, lines)))
            case lowering.Heading(text, level, number):
                mark = "#" * (level + 1)
                return [f"{mark} {f'{number}. ' * bool(number)}{self._text(text)}"]
            case lowering.ContentsList(title, headings):
                return [f"## {title}", "", *map(self._listed, headings)]
            case PageBreak():
                return []
            case lowering.Text():
                return self._lines_of_text(node)
            case lowering.DisplayedFormula(text, number):
                return _display(latex(parse(text)), number)
            case lowering.DisplayedEquations(equations, number):
                return _display(vector_equations(equations), number)
            case lowering.NamedTable(table, name):
                return ([f"**{self._text(name)}**", ""] if name else []) + self._table(table)
            case lowering.NamedFigure(name=name):
                return [f"*{self._text(name)}*"] if name else []
            case _:
                assert_never(node)

    def _lines_of_text(self, node: lowering.Text) -> list[str]:
        first, *more = map(self._text, node.lines)
        match node.kind:
            case TextKind.CAPTION:
                return [f"**{first}**"]
            case TextKind.PARAGRAPH:
                return [first]
            case TextKind.NOTE:
                return [f"> {first}"]
            case TextKind.ITEM:
                return [f"- {f'{self._text(node.mark)} ' * bool(node.mark)}{first}"]
            case TextKind.STEP | TextKind.SOURCE:
                return _broken([first, *more], f"{node.mark}. " * bool(node.mark))
            case _:
                assert_never(node.kind)

    def _listed(self, one: lowering.Heading) -> str:
        mark = f"{'  ' * (one.level - 1)}- {f'{one.number} ' * bool(one.number)}"
        return mark + self._text(one.text)

    def _table(self, node: Table) -> list[str]:
        rules = ("---:" if k in node.numbers else "---" for k in range(len(node.head)))
        rows = (map(self._text, cells) for cells in (node.head, *node.rows))
        head, *others = (f"| {' | '.join(cells)} |" for cells in rows)
        return [head, f"| {' | '.join(rules)} |", *others]

    def _text(self, text: Rich) -> str:
        """Return rich text, each formula of it between dollars."""
        return "".join(
            f"${latex(piece.nodes)}$" if piece.is_formula else _escaped(piece.text)
            for piece in self._written.divide(text)
        )


def _escaped(text: str) -> str:
    return re.sub(_SPECIAL, lambda found: f"{found[0][:-1]}\\{found[0][-1]}", text)


def _joined(nodes: Iterable[LoweredNode]) -> Iterator[LoweredNode]:
    """Yield the nodes; what continues a step just before it is one with it."""
    step: lowering.Text | None = None
    for node in nodes:
        match node:
            case lowering.Text(lines, TextKind.STEP, "") if step is not None:
                step = replace(step, lines=(*step.lines, *lines))
                continue
        if step is not None:
            yield step
        step = node if isinstance(node, lowering.Text) and node.kind is TextKind.STEP else None
        if step is None:
            yield node
    if step is not None:
        yield step


def _is_of_one_list(before: LoweredNode, node: LoweredNode) -> bool:
    """Return whether two nodes are entries of one list."""
    match before, node:
        case lowering.Text(kind=first), lowering.Text(kind=second):
            return first is second and first in (TextKind.ITEM, TextKind.STEP, TextKind.SOURCE)
        case _:
            return False


def _broken(lines: Sequence[str], prefix: str = "") -> list[str]:
    """Return lines that stay separate when rendered; ``prefix`` is put before the first."""
    return f"\\\n{' ' * len(prefix)}".join([prefix + lines[0], *lines[1:]]).split("\n")


def _display(formula: str, number: str) -> list[str]:
    tag = f"\\tag{{{number}}}" if number else ""
    return f"$${formula}{tag}$$".split("\n")


# LaTeX -------------------------------------------------------------------------------------------


def latex(nodes: Iterable[Node]) -> str:
    """Return a formula in LaTeX."""
    found = _sequence(list(tokens_of(_merge_letters(nodes)))).strip()
    return re.sub(_SPARE, "", re.sub(r"(?<!\\) {2,}", " ", found))


def _merge_letters(nodes: Iterable[Node]) -> Iterator[Node]:
    """Yield the nodes with adjacent letters merged: a sign has its blanks."""
    for is_letters, run in groupby(with_levels(nodes), lambda node: isinstance(node, Letters)):
        if is_letters:
            yield Letters("".join(node.text for node in run if isinstance(node, Letters)))
        else:
            yield from run


def _sequence(tokens: Sequence[Token]) -> str:
    found, k = "", 0
    while k < len(tokens):
        token, k = tokens[k], k + 1
        end = matching_bracket(tokens, k - 1) if token.kind == "brackets" else None
        if end is not None:
            inside = _sequence(tokens[k:end])
            opened, closed = (_SIGNS.get(s, s) for s in (token.text, PAIRS[token.text]))
            is_tall = "\\frac" in inside
            found += (
                f"\\left{opened}{inside}\\right{closed}" if is_tall else opened + inside + closed
            )
            k = end + 1
        elif token.node is not None:
            before = tokens[k - 2] if k > 1 else Token("blank")
            # Two indices one after the other would be an error: the second has a base of its own.
            bare = before.kind in ("blank", "sign") or isinstance(before.node, Index)
            found += "{}" * (bare and isinstance(token.node, Index)) + _node(token.node)
        elif not (token.kind == "blank" and k > 1 and tokens[k - 2].kind == "name"):
            found += _letters(token)
    return found


def _node(node: Node) -> str:
    match node:
        case Letters():
            return latex([node])
        case Index(below, above):
            low, high = latex(below), latex(above)
            return f"_{{{low}}}" * bool(low) + f"^{{{high}}}" * bool(high)
        case Overline(body):
            return f"\\overline{{{latex(body)}}}"
        case Fraction(above, below):
            return f"\\frac{{{latex(above)}}}{{{latex(below)}}}"
        case Root(body):
            return f"\\sqrt{{{latex(body)}}}"
        case _:
            assert_never(node)


def _letters(token: Token) -> str:
    text = token.text
    match token.kind:
        case "number":
            return text.replace(",", "{,}")
        case "name":
            return f"\\{text} " if text in _FUNCTIONS else f"\\operatorname{{{text}}} "
        case "letters":
            return "".join(map(_letter, text))
        case "blank":
            return "\\ "
        case "unit":
            return f"\\text{{{text}}}"
        case _:
            sign = text.strip(" \u00a0")
            if sign == "-" or any(map(str.isalpha, sign)):
                return f"\\text{{{text}}}"
            return text.replace("\u00a0", " ").replace(sign, _SIGNS.get(sign, sign))


def _letter(letter: str) -> str:
    name = unicodedata.name(letter, "")
    if letter in _VARIANTS or not name.startswith("GREEK"):
        return _VARIANTS.get(letter, letter)
    command = name.rpartition(" LETTER ")[2].lower()
    return f"\\{command.capitalize() if 'CAPITAL' in name else command} "


def vector_equations(equations: Sequence[Equation]) -> str:
    """Return vector equations in LaTeX, aligned at their signs of equality."""
    lines = [_equation(one) for one in equations]
    if len(lines) == 1:
        return lines[0].replace("&", "")
    return "\n\\begin{aligned}\n" + " \\\\\n".join(lines) + "\n\\end{aligned}\n"


def _equation(one: Equation) -> str:
    left = " + ".join(map(_term, one.left))
    name = f"{latex(parse(one.name))} = " if one.name and not one.right else ""
    return f"{name}{left} &= {' + '.join(map(_term, one.right)) or '0'}"


def _term(term: Term) -> str:
    """Return a vector: a line above its letter, underlined as far as it is known, its direction."""
    nodes = parse(term.symbol)
    first = (Overline(nodes[:1]),) if isinstance(nodes[0], Letters) else nodes[:1]
    body = latex((*first, *nodes[1:]))
    for _ in range(term.underlines):
        body = f"\\underline{{{body}}}"
    return f"\\underset{{{latex(parse(term.direction))}}}{{{body}}}" if term.direction else body
