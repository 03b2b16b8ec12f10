"""Numbers of sheets that were drawn before their set was known (Лист, Листов)."""

from __future__ import annotations

from msgspec.structs import replace

from planmethod.paper import FRAME_OTHER
from planmethod.render.frame.forms import FORM_2A
from planmethod.render.frame.furniture import Furniture
from planmethod.render.frame.titleblock import STAMP, filled
from planmethod.render.ink.drawing import Drawing, Item, Text, shifted
from planmethod.render.ink.lettering import using

GRAPHS = ("sheet", "sheets")
"""Fields of graphs 7 and 8."""


def numbered(drawing: Drawing, furniture: Furniture, sheet: int) -> Drawing:
    """Return a sheet with its number, and on the first one the number of sheets.

    Parameters
    ----------
    furniture : Furniture
        It has the numbers of preceding and of all sheets; its form must be that of the drawn sheet.
    sheet : int
        Number of the sheet among these, counted from 1.
    """
    form = FORM_2A if drawing.is_continuation else furniture.form_of(sheet)
    by = complex(drawing.width - FRAME_OTHER - form.width, FRAME_OTHER)
    # A single sheet is counted, not numbered (GOST 2.104).
    texts = furniture.numbers(sheet, sheet) or {"sheets": "1"}
    items: list[Item] = []
    boxes = []
    with using(drawing.lettering):
        for key in GRAPHS:
            if key not in form.cells:
                continue
            cell = form.cells[key]
            x0, y0, x1, y1 = cell.box
            boxes.append((x0 + by.real, y0 + by.imag, x1 + by.real, y1 + by.imag))
            if key in texts:
                items += shifted(filled(texts[key], cell), by)
    kept = [one for one in drawing.items if not _is_in_cell(one, boxes)]
    return replace(drawing, items=[*kept, *items])


def _is_in_cell(item: Item, boxes: list[tuple[float, float, float, float]]) -> bool:
    return isinstance(item, Text) and item.tag.startswith(STAMP) and item.box in boxes
