"""Parts of paragraphs of Word: sentences, fields, marks, links (абзацы документа Word)."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from docx.enum.text import WD_LINE_SPACING
from docx.oxml import OxmlElement
from docx.oxml.ns import qn
from docx.shared import Pt

from planmethod.note.formula import Rich, parse
from planmethod.note.writers import omml
from planmethod.note.writers.html import without_control_characters
from planmethod.note.writers.linebreak import chain_of, width_em
from planmethod.note.writers.sentences import pieces, tied, with_stops

LONG = 18.0
"""Width, in heights of the font, from which on a formula in a sentence may be cut at its signs."""


def add_sentence(
    paragraph: Any, rich: Rich, units: frozenset[str], max_width: float, *, joined: bool = True
) -> None:
    """Put a sentence into a paragraph, its formulas as equations.

    ``joined``: no line ends within a range of numbers; a sign without width sees to that.
    """
    for piece in with_stops(pieces(parse(without_control_characters(rich)), units, symbols=True)):
        if not piece.is_formula:
            paragraph.add_run(tied(piece.text) if joined else piece.text)
            continue
        parts = [("", piece.nodes)]
        if width_em(piece.nodes) > LONG:
            parts = list(chain_of(piece.nodes, max_width))
        for sign, nodes in parts:
            if sign:
                paragraph.add_run(f" {sign} ")
            if nodes:
                paragraph._p.append(omml.equation(nodes))


@contextmanager
def marked(paragraph: Any, number: int) -> Iterator[None]:
    """Put a bookmark of the contents around text added to a paragraph meanwhile."""
    start, end = OxmlElement("w:bookmarkStart"), OxmlElement("w:bookmarkEnd")
    for mark in (start, end):
        mark.set(qn("w:id"), str(number))
    start.set(qn("w:name"), _mark_name(number))
    paragraph._p.append(start)
    yield
    paragraph._p.append(end)


def add_link(paragraph: Any, number: int) -> Any:
    """Make the content of a paragraph a link to a bookmark; return the run of its page."""
    link = OxmlElement("w:hyperlink")
    link.set(qn("w:anchor"), _mark_name(number))
    for child in list(paragraph._p):
        if child.tag in (qn("w:r"), f"{{{omml.MATH}}}oMath") and not len(
            child.findall(qn("w:fldChar")) + child.findall(qn("w:instrText"))
        ):
            link.append(child)
    paragraph._p.append(link)
    before = len(paragraph._p)
    paragraph.add_run("\t")
    shown = add_field(paragraph, f"PAGEREF {_mark_name(number)} \\h", "")
    for child in list(paragraph._p)[before:]:
        link.append(child)
    return shown


def _mark_name(number: int) -> str:
    return f"_Toc{number:06}"


def add_field(paragraph: Any, code: str, shown: str) -> Any:
    """Put a field at the end of a paragraph; return the run it shows until computed."""
    for kind in ("begin", code, "separate"):
        field_part(paragraph, kind)
    run = paragraph.add_run(shown)
    field_part(paragraph, "end")
    return run


def field_part(paragraph: Any, kind: str) -> None:
    """Put a part of a field: ``begin``, ``separate``, ``end``, or its code."""
    run = paragraph.add_run()._r
    if kind in ("begin", "separate", "end"):
        part = OxmlElement("w:fldChar")
        part.set(qn("w:fldCharType"), kind)
    else:
        part = OxmlElement("w:instrText")
        part.set(qn("xml:space"), "preserve")
        part.text = f" {kind} "
    run.append(part)


def small_paragraph(paragraph: Any, *, space: float = 0.0) -> None:
    """Make a paragraph that has to be there as low as can be; ``space``: points after it."""
    form = paragraph.paragraph_format
    form.line_spacing_rule, form.line_spacing = WD_LINE_SPACING.EXACTLY, Pt(1)
    form.first_line_indent, form.space_before, form.space_after = 0, Pt(0), Pt(space)
