"""Styles of a document of Word: page, letters, headings of GOST 7.32 (стили документа Word)."""

from __future__ import annotations

from typing import Any

from docx.enum.style import WD_STYLE_TYPE
from docx.enum.text import WD_ALIGN_PARAGRAPH, WD_TAB_ALIGNMENT, WD_TAB_LEADER
from docx.oxml import OxmlElement
from docx.oxml.ns import qn
from docx.shared import Mm, Pt, RGBColor

FONT = "Times New Roman"
SIZE, TABLE_SIZE, LEAST_SIZE = 14.0, 12.0, 10.0
LEFT, RIGHT, TOP, BOTTOM = 30.0, 15.0, 20.0, 20.0
INDENT = 12.5
PAGE = 210.0, 297.0
MM_PER_POINT = 25.4 / 72.0

HEADINGS = ("Heading 1", "Heading 2", "Heading 3")


class WordStyles:
    """Styles of a file by name; those that a template has not are added."""

    def __init__(self, file: Any, *, new: bool, lang: str) -> None:
        self._file, self._new = file, new
        self._known = dict[str, Any]()
        self._there = {style.name for style in file.styles}
        normal = self["Normal"]
        if new:
            self._format(normal, 1.5, INDENT, WD_ALIGN_PARAGRAPH.JUSTIFY)
            _letters(normal, SIZE)
            language = OxmlElement("w:lang")
            language.set(qn("w:val"), lang)
            normal.element.get_or_add_rPr().append(language)
        for name in HEADINGS:
            self._add_style(name, 1.5, INDENT, WD_ALIGN_PARAGRAPH.LEFT, bold=True, around=8.0)
        middle, left = WD_ALIGN_PARAGRAPH.CENTER, WD_ALIGN_PARAGRAPH.LEFT
        self._add_style("Title", 1.5, 0.0, middle, bold=True, size=16.0, around=6.0)
        self._add_style("Title Page", 1.25, 0.0, middle)
        self._add_style("Contents Heading", 1.5, 0.0, middle, bold=True, around=8.0)
        self._add_style("Subheading", 1.5, INDENT, left, keep_with_next=True)
        self._add_style("Remark", 1.0, INDENT, WD_ALIGN_PARAGRAPH.JUSTIFY, size=TABLE_SIZE)
        self._add_style("Formula", 1.15, 0.0, middle, around=3.0)
        self._add_style("Figure", 1.0, 0.0, middle, keep_with_next=True, around=6.0)
        self._add_style("Caption", 1.0, 0.0, middle, around=6.0)
        self._add_style("Table Name", 1.0, 0.0, left, keep_with_next=True, around=3.0)
        self._add_style("Table Text", 1.0, 0.0, left, size=TABLE_SIZE)
        self._add_style("Small Table", 1.0, 0.0, left, size=LEAST_SIZE)
        self._add_style("Title Block", 1.0, 0.0, middle, size=8.0)
        self._add_style("Page Number Line", 1.0, 0.0, middle, size=TABLE_SIZE)
        for level in (1, 2, 3):
            style = self._add_style(f"toc {level}", 1.25, 0.0, left)
            if style is not None:
                form = style.paragraph_format
                form.left_indent, form.right_indent = Mm(7.0 * (level - 1)), Mm(10.0)
                width = PAGE[0] - LEFT - RIGHT
                form.tab_stops.add_tab_stop(Mm(width), WD_TAB_ALIGNMENT.RIGHT, WD_TAB_LEADER.DOTS)

    def __getitem__(self, name: str) -> Any:
        if name not in self._known:
            self._known[name] = self._file.styles[name]
        return self._known[name]

    def apply(self, paragraph: Any, name: str) -> None:
        """Give a paragraph a style, without the library's search by name."""
        paragraph._p.style = self[name].style_id

    @property
    def table(self) -> Any:
        """The style of tables with lines."""
        names = [style.name for style in self._file.styles if style.type == WD_STYLE_TYPE.TABLE]
        return self["Table Grid"] if "Table Grid" in names else None

    def _add_style(
        self,
        name: str,
        spacing: float,
        indent: float,
        alignment: Any,
        *,
        bold: bool = False,
        size: float = SIZE,
        around: float = 0.0,
        keep_with_next: bool = False,
    ) -> Any:
        """Return a style that is set here; None where the template has it."""
        if name in self._there and not self._new:
            return None
        if name in self._there:
            style = self[name]
        else:
            is_own = not name.startswith("toc ")
            style = self._file.styles.add_style(name, WD_STYLE_TYPE.PARAGRAPH, builtin=not is_own)
            style.base_style = self["Normal"]
        self._format(style, spacing, indent, alignment)
        form = style.paragraph_format
        form.space_before = form.space_after = Pt(around)
        form.keep_with_next = keep_with_next or name in HEADINGS
        for border in style.element.findall(f".//{qn('w:pBdr')}"):
            border.getparent().remove(border)
        _letters(style, size, bold=bold)
        return style

    def _format(self, style: Any, spacing: float, indent: float, alignment: Any) -> None:
        form = style.paragraph_format
        form.line_spacing, form.first_line_indent = spacing, Mm(indent)
        form.alignment = alignment
        form.space_before = form.space_after = Pt(0)


def _letters(style: Any, size: float, *, bold: bool = False) -> None:
    """Give a style its letters, whatever the theme of the file has."""
    font = style.font
    font.name, font.size, font.bold, font.italic = FONT, Pt(size), bold, False
    font.color.rgb = RGBColor(0, 0, 0)
    fonts = style.element.get_or_add_rPr().get_or_add_rFonts()
    for key in list(fonts.attrib):
        del fonts.attrib[key]
    for key in ("ascii", "hAnsi", "cs", "eastAsia"):
        fonts.set(qn(f"w:{key}"), FONT)
