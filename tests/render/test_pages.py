"""Several sheets in one file: every page equals the sheet in a file of its own."""

from __future__ import annotations

import re

import pytest
from doors import (
    BACKENDS,
    PAGED,
    Arc,
    Disc,
    Drawing,
    Fill,
    Ink,
    Options,
    OutputError,
    Pen,
    PlanMethodError,
    Stroke,
    Text,
    render,
    render_pages,
)
from msgspec.structs import replace
from reading import read_pdf

ITEMS = (
    Stroke((10 + 10j, 60 + 10j), Pen.THIN),
    Disc(30 + 30j, 5.0, Ink.WHITE),
    Text(12 + 40j, "План скоростей", 5.0),
    Fill((40 + 40j, 50 + 40j, 45 + 50j)),
    Arc(50 + 20j, 6.0, pen=Pen.MAIN),
)
SHEETS = [
    Drawing(297.0, 420.0, "Первый", list(ITEMS)),
    Drawing(420.0, 297.0, "Второй", [*reversed(ITEMS)]),
    Drawing(630.0, 297.0, "Третий", [replace(ITEMS[2], text="Лист 3")]),
]


@pytest.mark.parametrize("fmt", sorted(PAGED))
def test_a_single_page_is_the_file_of_its_sheet(fmt: str) -> None:
    assert render_pages(SHEETS[:1], fmt) == render(SHEETS[0], fmt)


def test_every_page_has_the_size_and_the_ink_of_its_sheet() -> None:
    """Pens and ink are reset on every page: none is left over from the page before."""
    whole = render_pages(SHEETS)
    assert len(re.findall(rb"/MediaBox", whole)) == len(SHEETS)
    for number, sheet in enumerate(SHEETS):
        page, alone = read_pdf(whole, number), read_pdf(render(sheet, "pdf"))
        assert (page.width, page.height) == pytest.approx((sheet.width, sheet.height), abs=0.01)
        assert len(page.items) == len(sheet.items)
        assert [repr(item) for item in page.items] == [repr(item) for item in alone.items]


def test_the_file_is_reproducible_and_has_one_font_embedded() -> None:
    whole = render_pages(SHEETS, options=Options(author="Иванов"))
    assert render_pages(SHEETS, options=Options(author="Иванов")) == whole
    assert b"Helvetica" not in whole
    assert len(re.findall(rb"/FontFile2", whole)) == 1
    assert len(set(re.findall(rb"/Title", whole))) == 1


@pytest.mark.parametrize("fmt", sorted({*BACKENDS} - PAGED))
def test_other_formats_have_no_pages(fmt: str) -> None:
    with pytest.raises(OutputError, match=rf"'{fmt}' has no pages\. Use one of: pdf"):
        render_pages(SHEETS, fmt)


def test_no_sheet_at_all() -> None:
    with pytest.raises(OutputError, match="The file would have no sheets"):
        render_pages([])


def test_a_point_that_does_not_exist_is_reported_on_any_page() -> None:
    bad = Drawing(10.0, 10.0, "Четвёртый", [Stroke((0j, complex("nan")))])
    with pytest.raises(PlanMethodError, match="'Четвёртый' has a coordinate that is not finite"):
        render_pages([SHEETS[0], bad])
