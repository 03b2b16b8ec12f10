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

from planmethod.note import document
from planmethod.note.document import Document, Equation, Table, Term
from planmethod.note.formula import Fraction, Index, Letters, Node, Overline, Rich, Root, parse
from planmethod.note.wording import Language
from planmethod.note.writers.formulas import (
    PAIRS,
    Token,
    matching_bracket,
    pieces,
    tokens_of,
    units_of,
    with_levels,
)

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
    return "\n".join(_Writer(language).lines(document.resolve_references(written)))


class _Writer:
    """Writes nodes one after another, and numbers steps."""

    def __init__(self, language: Language) -> None:
        self._say, self._units = language.document, units_of(language.note["units"])
        self._step = 0

    def lines(self, written: Document) -> Iterator[str]:
        """Yield the lines of a document; entries of one list have no blank line between them."""
        before: document.Node | None = None
        for node, number in document.numbers_of(Document.of(_joined(written.nodes))):
            is_contents = isinstance(node, document.Contents)
            lines = self._contents(written) if is_contents else self._node(node, number)
            is_list = isinstance(node, document.Item | document.Step) and type(before) is type(node)
            if lines and before is not None and not is_list:
                yield ""
            yield from lines
            before = node if lines else before

    def _contents(self, written: Document) -> list[str]:
        listed = (
            f"{'  ' * (level - 1)}- {f'{number} ' * bool(number)}{self._text(title)}"
            for level, number, title in document.headings_of(written)
        )
        return [f"## {self._say.contents}", "", *listed]

    def _node(self, node: document.Node, number: str) -> list[str]:
        match node:
            case document.Title(text):
                return [f"# {self._text(text)}"]
            case document.TitlePage():
                return _broken(list(map(self._text, document.lines_of(node, self._say))))
            case document.Contents() | document.PageBreak():
                return []
            case document.Chapter(title) | document.StructuralHeading(title):
                return [f"## {f'{number}. ' * bool(number)}{self._text(title)}"]
            case document.Part(title):
                return [f"### {number}. {self._text(title)}"]
            case document.Subpart(title):
                return [f"#### {number}. {self._text(title)}"]
            case document.Caption(text):
                return [f"**{self._text(text)}**"]
            case document.Paragraph(text):
                return [self._text(text)]
            case document.Note(text):
                return [f"> {self._text(text)}"]
            case document.Item(text, label):
                return [f"- {f'{self._text(label)} ' * bool(label)}{self._text(text)}"]
            case document.Step(lines, continues):
                self._step += not continues
                lead = "" if continues else f"{self._step}. "
                return _broken(list(map(self._text, lines)), lead)
            case document.Formula(text):
                return _display(latex(parse(text)), number)
            case document.Equations(equations):
                return _display(vector_equations(equations), number)
            case Table(name=name):
                above = [f"**{self._named('table', number, name)}**", ""] if name else []
                return above + self._table(node)
            case document.Figure(caption=caption):
                named = self._named("figure", number, caption) if number else self._text(caption)
                return [f"*{named}*"] if named else []
            case document.References(entries):
                return [f"{k}. {self._text(entry)}" for k, entry in enumerate(entries, 1)]
            case _:
                assert_never(node)

    def _named(self, kind: str, number: str, text: Rich) -> str:
        return self._text(self._say[kind].format(number=number, text=text))

    def _table(self, node: Table) -> list[str]:
        rules = ("---:" if k in node.numbers else "---" for k in range(len(node.head)))
        rows = (map(self._text, cells) for cells in (node.head, *node.rows))
        head, *others = (f"| {' | '.join(cells)} |" for cells in rows)
        return [head, f"| {' | '.join(rules)} |", *others]

    def _text(self, text: Rich) -> str:
        """Return rich text, each formula of it between dollars."""
        return "".join(
            f"${latex(piece.nodes)}$" if piece.is_formula else _escaped(piece.text)
            for piece in pieces(parse(text), self._units)
        )


def _escaped(text: str) -> str:
    return re.sub(_SPECIAL, lambda found: f"{found[0][:-1]}\\{found[0][-1]}", text)


def _joined(nodes: Iterable[document.Node]) -> Iterator[document.Node]:
    """Yield the nodes; what continues a step just before it is one with it."""
    step: document.Step | None = None
    for node in nodes:
        if step is not None and isinstance(node, document.Step) and node.continues:
            step = replace(step, lines=(*step.lines, *node.lines))
            continue
        if step is not None:
            yield step
        step = node if isinstance(node, document.Step) else None
        if step is None:
            yield node
    if step is not None:
        yield step


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
