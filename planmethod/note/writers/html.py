"""A document as one HTML file: no scripts, nothing from outside (документ в HTML)."""

# no messages: HTML

from __future__ import annotations

import html
from collections.abc import Iterable, Iterator
from itertools import groupby
from typing import assert_never

from planmethod.note.document import Document, Equation, PageBreak, Table, Term
from planmethod.note.formula import (
    Fraction,
    Index,
    Letters,
    Node as Sign,
    Overline,
    Root,
    inline,
    parse,
)
from planmethod.note.wording import get_language
from planmethod.note.writers import lowering
from planmethod.note.writers.formulas import without_control_characters
from planmethod.note.writers.lowering import LoweredNode, TextKind, lower

STYLE = """
@page{size:A4;margin:12mm}
*{box-sizing:border-box}
body{font:10pt/1.35 "Segoe UI","Noto Sans","DejaVu Sans",Arial,sans-serif;color:#1b1b1b;
background:#fff;max-width:186mm;margin:0 auto;padding:0 2mm}
h1{font-size:16pt;margin:0}h2{font-size:12pt;margin:4mm 0 1mm;break-after:avoid}
h3{font-size:10pt;margin:3mm 0 1mm;break-after:avoid}
p{margin:1mm 0}.caption{margin:2mm 0;padding:2mm 3mm;background:#eef2f7;border-radius:1.5mm;
font-weight:600;break-after:avoid}
ul{margin:0;padding-left:5mm}li{margin:.7mm 0}
table{border-collapse:collapse;width:100%;font-size:9pt}
th,td{border:.25mm solid #bbb;padding:.5mm 1.5mm;text-align:left;vertical-align:top}
th{background:#f4f4f4;font-weight:600}td.n{text-align:right;white-space:nowrap}
tr{break-inside:avoid}sub,sup{line-height:0}.bar{text-decoration:overline}
.ok td.tone,.inherited td.tone{background:#e5f2e7}
.near td.tone,.inconsistent td.tone,.unseen td.tone{background:#fdf3d3}
.wrong td.tone{background:#fbe3e0;font-weight:600}
.blank td.tone,.unreadable td.tone{background:#ececec}
.note{color:#555;font-size:9pt}.formula{margin-left:8mm}
.term{display:inline-block;text-align:center;vertical-align:top}
.term small{display:block;font-size:8pt}.u1{border-bottom:.3mm solid}.u2{border-bottom:1mm double}
.figures{display:flex;flex-wrap:wrap;gap:4mm;align-items:flex-end;break-inside:avoid}
figure{margin:0}figcaption{font-size:9pt;text-align:center}
"""

NOTE_STYLE = """
.titlepage{text-align:center;break-after:page}.break{break-after:page}
.level2{margin-left:5mm}.level3{margin-left:10mm}.formula-number{float:right}
.fraction{display:inline-block;vertical-align:middle;text-align:center}
.fraction span{display:block;padding:0 .3em}.fraction span+span{border-top:.2mm solid}
"""
"""For documents that have formulas built up, or the pages of a note."""


def html_document(written: Document, *, title: str, lang: str, style: str = "") -> str:
    """Return a document as HTML.

    Parameters
    ----------
    title : str
        Plain text, for the window.
    style : str
        CSS of the figures, beside that of the document.
    """
    body = "\n".join(_body(lower(written, get_language(lang)).nodes))
    kinds = ("titlepage", "break", "level", "formula-number", "fraction")
    if any(f'class="{kind}' in body for kind in kinds):
        style = NOTE_STYLE + style
    return "\n".join(
        [
            f'<!DOCTYPE html>\n<html lang="{lang}"><head><meta charset="utf-8">',
            '<meta name="viewport" content="width=device-width, initial-scale=1">',
            # The content comes from untrusted files: none of it may load or run anything.
            '<meta http-equiv="Content-Security-Policy" '
            "content=\"default-src 'none'; style-src 'unsafe-inline'\">",
            f"<title>{html.escape(without_control_characters(title))}</title><style>{STYLE}{style}</style></head><body>",
            body,
            "</body></html>\n",
        ]
    )


def html_part(written: Document, lang: str) -> str:
    """Return a document as an element for a page that is not ours, its style kept to itself."""
    body = "\n".join(_body(lower(written, get_language(lang)).nodes))
    return f"<div><style>@scope {{{STYLE}{NOTE_STYLE}}}</style>\n{body}\n</div>"


def _body(nodes: Iterable[LoweredNode]) -> Iterator[str]:
    """Yield the elements; consecutive items become a list, figures are set side by side."""
    for (kind, text_kind), run in groupby(nodes, lowering.kind_of):
        elements = map(_element, run)
        if kind is lowering.NamedFigure:
            yield f'<div class="figures">{"".join(elements)}</div>'
        elif text_kind in _LISTS:
            tag, name = _LISTS[text_kind]
            yield f"<{tag}{name}>{''.join(elements)}</{tag}>"
        else:
            yield from elements


_LISTS = {
    TextKind.ITEM: ("ul", ""),
    TextKind.STEP: ("ol", ' class="steps"'),
    TextKind.SOURCE: ("ol", ""),
}
"""Elements of lists, and their classes."""


def _element(node: LoweredNode) -> str:
    match node:
        case lowering.Cover(lines=lines):
            return f'<p class="titlepage">{"<br>".join(map(markup, lines))}</p>'
        case lowering.Heading(text, level):
            return f"<h{level + 1}>{markup(text)}</h{level + 1}>"
        case lowering.ContentsList(title, headings):
            return f"<h2>{title}</h2>" + "".join(
                f'<p class="level{one.level}">{one.number} {markup(one.text)}</p>'
                for one in headings
            )
        case PageBreak():
            return '<div class="break"></div>'
        case lowering.Text(lines, kind):
            return _text("<br>".join(map(markup, lines)), kind)
        case lowering.DisplayedFormula(text, number):
            return f'<p class="formula">{markup(text, built=True)}{_numbered(number)}</p>'
        case lowering.DisplayedEquations(equations, number):
            rows = "".join(f'<p class="formula">{_equation(one)}</p>' for one in equations)
            return rows + _numbered(number)
        case lowering.NamedTable(table, name):
            return (f'<p class="caption">{markup(name)}</p>' if name else "") + _table(table)
        case lowering.NamedFigure(view=view, name=name):
            return f"<figure>{view.svg()}<figcaption>{markup(name)}</figcaption></figure>"
        case _:
            assert_never(node)


def _text(text: str, kind: TextKind) -> str:
    match kind:
        case TextKind.PARAGRAPH:
            return f"<p>{text}</p>"
        case TextKind.CAPTION | TextKind.NOTE:
            return f'<p class="{kind.value}">{text}</p>'
        case TextKind.ITEM | TextKind.STEP | TextKind.SOURCE:
            return f"<li>{text}</li>"
        case _:
            assert_never(kind)


def _numbered(number: str) -> str:
    return f'<span class="formula-number">({number})</span>' if number else ""


def _equation(equation: Equation) -> str:
    def side(terms: tuple[Term, ...]) -> str:
        return " + ".join(
            f'<span class="term"><span class="u{term.underlines}">{markup(term.symbol)}</span>'
            f"<small>{markup(term.direction)}</small></span>"
            for term in terms
        )

    return f"{side(equation.left)} = {side(equation.right) or '0'}"


def _table(table: Table) -> str:
    numbers = table.numbers

    def cell(column: int, text: str) -> str:
        kind = "n" if column in numbers else "tone" if table.tones and column == table.toned else ""
        return f"<td{f' class={kind}' if kind else ''}>{markup(text)}</td>"

    head = "".join(f"<th>{markup(text)}</th>" for text in table.head)
    rows = []
    for number, cells in enumerate(table.rows):
        tone = f' class="{table.tones[number]}"' if table.tones else ""
        rows.append(f"<tr{tone}>{''.join(cell(k, text) for k, text in enumerate(cells))}</tr>")
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(rows)}</tbody></table>"


# Text --------------------------------------------------------------------------------------------


def markup(rich: str, *, built: bool = False) -> str:
    """Return rich text with tags of indices; whatever else looks like a tag is escaped.

    ``built``: whether fractions are built up, as on a line of their own.
    """
    nodes = parse(without_control_characters(rich))
    return "".join(map(_sign, nodes if built else inline(nodes)))


def _sign(node: Sign) -> str:
    def inside(nodes: tuple[Sign, ...]) -> str:
        return "".join(map(_sign, nodes))

    match node:
        case Letters(text):
            return html.escape(text)
        case Index(low, high):
            lower = f"<sub>{inside(low)}</sub>" if low else ""
            return (f"<sup>{inside(high)}</sup>" if high else "") + lower
        case Overline(body):
            return f'<span class="bar">{inside(body)}</span>'
        case Fraction(above, below):
            parts = f"<span>{inside(above)}</span><span>{inside(below)}</span>"
            return f'<span class="fraction">{parts}</span>'
        case Root(body):
            return f'√<span class="bar">{inside(body)}</span>'
        case _:
            assert_never(node)
