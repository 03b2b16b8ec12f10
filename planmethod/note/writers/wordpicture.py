"""Pictures of a document of Word: dots, and the same picture as SVG beside (рисунки Word)."""

from __future__ import annotations

from io import BytesIO
from typing import Any

from docx.opc.constants import RELATIONSHIP_TYPE
from docx.opc.packuri import PackURI
from docx.opc.part import Part
from docx.oxml.ns import qn
from docx.shared import Mm
from lxml import etree

from planmethod.note.document import Figure
from planmethod.note.writers.wordpages import clean_text

DPI = 200
"""Dots to the inch: for programs that cannot show SVG; of lines more are not seen in print."""

_SVG = "http://schemas.microsoft.com/office/drawing/2016/SVG/main"
_SVG_EXTENSION = "{96DAC541-7B7A-43D3-8B79-37D633B846F1}"


def add_picture(run: Any, figure: Figure, width: float, scale: float, part: Any) -> None:
    """Put a figure into a run of text.

    Parameters
    ----------
    run : docx.text.run.Run
    figure : Figure
    width : float, mm
        As it is shown.
    scale : float
        How many times larger it is shown than its view is.
    part : docx.parts.document.DocumentPart
        Of the file.
    """
    picture = run.add_picture(BytesIO(figure.view.png(DPI * scale)), Mm(width))
    picture._inline.docPr.set("descr", clean_text(figure.caption))
    package = part.package
    count = sum(one.partname.endswith(".svg") for one in package.iter_parts()) + 1
    svg = figure.view.svg().encode()
    vector = Part(PackURI(f"/word/media/vector{count}.svg"), "image/svg+xml", svg, package)
    name = part.relate_to(vector, RELATIONSHIP_TYPE.IMAGE)
    blip = picture._inline.find(f".//{qn('a:blip')}")
    extensions = etree.SubElement(blip, qn("a:extLst"))
    extension = etree.SubElement(extensions, qn("a:ext"), uri=_SVG_EXTENSION)
    beside = etree.SubElement(extension, f"{{{_SVG}}}svgBlip", nsmap={"asvg": _SVG})
    beside.set(qn("r:embed"), name)
