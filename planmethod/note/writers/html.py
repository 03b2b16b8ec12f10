"""A document as one HTML file: no scripts, nothing from outside (документ в HTML)."""

# no messages: HTML

from __future__ import annotations

import html
import re
from collections.abc import Iterator
from itertools import groupby
from typing import assert_never

from planmethod.note import document
from planmethod.note.document import Document, Equation, Node, Table
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
from planmethod.note.wording import MessageTable, get_language

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

_CONTROL = "[^\n\x20-\x7e\xa0-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]"


def without_control_characters(text: str) -> str:
    """Return a text without signs that no page can show."""
    return re.sub(_CONTROL, " ", text)


def html_document(written: Document, *, title: str, lang: str, style: str = "") -> str:
    """Return a document as HTML.

    Parameters
    ----------
    title : str
        Plain text, for the window.
    style : str
        CSS of the figures, beside that of the document.
    """
    body = "\n".join(_body(document.resolve_references(written), get_language(lang).document))
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
    body = "\n".join(_body(document.resolve_references(written), get_language(lang).document))
    return f"<div><style>@scope {{{STYLE}{NOTE_STYLE}}}</style>\n{body}\n</div>"


def _body(written: Document, texts: MessageTable) -> Iterator[str]:
    """Yield the elements; consecutive items become a list, figures are set side by side."""
    for kind, run in groupby(document.numbers_of(written), lambda pair: type(pair[0])):
        if kind is document.Contents:
            yield f"<h2>{texts.contents}</h2>{''.join(_contents(written))}"
            continue
        elements = (_element(node, number, texts) for node, number in run)
        if kind is document.Item:
            yield f"<ul>{''.join(elements)}</ul>"
        elif kind is document.Step:
            yield f'<ol class="steps">{"".join(elements)}</ol>'
        elif kind is document.Figure:
            yield f'<div class="figures">{"".join(elements)}</div>'
        else:
            yield from elements


def _contents(written: Document) -> Iterator[str]:
    for level, number, title in document.headings_of(written):
        yield f'<p class="level{level}">{number} {markup(title)}</p>'


def _element(node: Node, number: str, texts: MessageTable) -> str:
    match node:
        case document.Title(text):
            return f"<h1>{markup(text)}</h1>"
        case document.TitlePage():
            lines = "<br>".join(map(markup, document.lines_of(node, texts)))
            return f'<p class="titlepage">{lines}</p>'
        case document.Contents():
            return ""
        case document.PageBreak():
            return '<div class="break"></div>'
        case document.StructuralHeading(title) | document.Chapter(title):
            return f"<h2>{markup(title)}</h2>"
        case document.Part(title):
            return f"<h3>{markup(title)}</h3>"
        case document.Subpart(title):
            return f"<h4>{markup(title)}</h4>"
        case document.Caption(text):
            return f'<p class="caption">{markup(text)}</p>'
        case document.Paragraph(text):
            return f"<p>{markup(text)}</p>"
        case document.Item(text):
            return f"<li>{markup(text)}</li>"
        case document.Step(lines):
            return f"<li>{'<br>'.join(map(markup, lines))}</li>"
        case document.Formula(text):
            return f'<p class="formula">{markup(text, built=True)}{_numbered(number)}</p>'
        case document.Equations(equations):
            lines = "".join(f'<p class="formula">{_equation(one)}</p>' for one in equations)
            return lines + _numbered(number)
        case document.Table(name=name):
            above = texts.table.format(number=number, text=name)
            return (f'<p class="caption">{markup(above)}</p>' if name else "") + _table(node)
        case document.Figure(view, caption):
            caption = texts.figure.format(number=number, text=caption) if number else caption
            return f"<figure>{view.svg()}<figcaption>{markup(caption)}</figcaption></figure>"
        case document.References(entries):
            return f"<ol>{''.join(f'<li>{markup(entry)}</li>' for entry in entries)}</ol>"
        case document.Note(text):
            return f'<p class="note">{markup(text)}</p>'
        case _:
            assert_never(node)


def _numbered(number: str) -> str:
    return f'<span class="formula-number">({number})</span>' if number else ""


def _equation(equation: Equation) -> str:
    def side(terms: tuple[document.Term, ...]) -> str:
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
