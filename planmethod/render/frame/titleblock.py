"""Title block (основная надпись): its fields, and a form drawn with its texts."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from types import MappingProxyType

from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.note.wording import get_language
from planmethod.problem.common import TITLE_BLOCK
from planmethod.problem.names import nearest_name_hint
from planmethod.render.frame.forms import FORM_1, Form, FormCell
from planmethod.render.ink.drawing import Bounds, Item, Pen, Stroke
from planmethod.render.ink.style import HEIGHTS
from planmethod.render.ink.typeset import smaller_heights
from planmethod.render.layout.block import fit_text

STAMP = "stamp"
"""Tag of the lines and texts of the title block."""

ALIASES: Mapping[str, str] = MappingProxyType({"subject": "material", "date": "author_date"})
"""Fields with a second name, by their meaning instead of their graph."""

SHARED = ("organisation", "department", "group")
"""Fields that share graph 9, from the top."""


def merged(*layers: Mapping[str, str]) -> dict[str, str]:
    """Return the fields of several layers, the later ones over the earlier.

    A field has one place under either name: ``date`` of a layer outranks ``author_date`` of the
    layers below. An empty text clears the field.
    """
    fields: dict[str, str] = {}
    for layer in layers:
        fields |= {ALIASES[key]: text for key, text in layer.items() if key in ALIASES}
        fields |= {key: text for key, text in layer.items() if key not in ALIASES}
    return {key: text for key, text in fields.items() if text}


def title_block(
    fields: Mapping[str, str] = MappingProxyType({}),
    form: Form = FORM_1,
    *,
    lang: str = LANGUAGES[0],
) -> list[Item]:
    """Return the title block, its lower left corner at the origin.

    A text that does not fit its cell shrinks to the next letter height, then is wrapped, then
    shrinks further, but for graph 1, which is wrapped first to have one height on all sheets;
    it never leaves the cell. Fields that the form has no graph for are not shown.

    Raises
    ------
    LayoutError
        If a field is unknown.
    """
    check_fields(fields)
    captions = get_language(lang).frame["captions"]
    values = merged({key: str(value).strip() for key, value in fields.items()})
    letters = values.get("letter", "").replace(" ", "")
    divided = len(letters) <= len(form.letters)
    items: list[Item] = []
    for lines, pen in (
        ((*form.thin_lines, *(form.dividers if divided else ())), Pen.THIN),
        (form.thick_lines, Pen.FRAME),
    ):
        items += [
            Stroke((complex(x0, y0), complex(x1, y1)), pen, tag=STAMP) for x0, y0, x1, y1 in lines
        ]
    items.append(rectangle((0.0, 0.0, form.width, form.height), Pen.FRAME, STAMP))
    for caption, box, align in form.captions:
        items += filled(captions[caption], FormCell(box, 2.5, align))
    for key, cell in form.cells.items():
        if key in values:
            items += filled(values[key], cell, shrink_first=key != "title")
    whole = "\n".join(values[key] for key in SHARED if key in values)
    if whole and form.organisation is not None:
        items += filled(whole, form.organisation)
    items += _letters(letters, form.letters, divided=divided)
    return items


def _letters(letters: str, boxes: tuple[Bounds, ...], *, divided: bool) -> Iterable[Item]:
    """Yield graph 4: a letter in each small cell, or all of them in one where there are more."""
    if not boxes or not letters:
        return
    if not divided:
        yield from filled(letters, FormCell((*boxes[0][:2], *boxes[-1][2:]), 3.5))
        return
    for letter, box in zip(letters, boxes, strict=False):
        yield from filled(letter, FormCell(box, 3.5))


def check_fields(fields: Iterable[str]) -> None:
    """Refuse a field that is unknown, and name the nearest one.

    Raises
    ------
    LayoutError
    """
    for key in fields:
        if key not in TITLE_BLOCK:
            hint = nearest_name_hint(
                key, TITLE_BLOCK, translate("Known: {}.", ", ".join(TITLE_BLOCK))
            )
            raise LayoutError("Unknown field {!r} of the title block. {}", key, hint)


def filled(text: str, cell: FormCell, tag: str = STAMP, *, shrink_first: bool = True) -> list[Item]:
    """Put a text into its cell; in narrow cells less white is left at the sides."""
    wide = cell.box[2] - cell.box[0]
    pad = 0.45 if wide <= 7 else 0.45 if wide <= 10 else 0.6 if wide <= 25 else 1.5
    # 2.5 mm is the smallest for drawings; 1.8, the smallest of all, is better than a cut surname.
    heights = (*smaller_heights(cell.height), HEIGHTS[0])
    return fit_text(text, cell.box, heights, align=cell.align, pad=pad, tag=tag,
               shrink_first=shrink_first)  # fmt: skip


def rectangle(box: Bounds, pen: Pen, tag: str) -> Stroke:
    """Return the outline of a box."""
    x0, y0, x1, y1 = box
    corners = (complex(x0, y0), complex(x1, y0), complex(x1, y1), complex(x0, y1))
    return Stroke(corners, pen, closed=True, tag=tag)
