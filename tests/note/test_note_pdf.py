"""A note in PDF: contents with pages, formulas built up, the same bytes each time."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from doors import (
    ASCENT,
    DESCENT,
    Chapter,
    Contents,
    Document,
    DocumentStep as Step,
    Drawing,
    DrawingView,
    Figure,
    FormulaSetter,
    Node,
    PageBreak,
    Paragraph,
    Part,
    Table,
    formula_parse as parse,
    get_language,
    html_document,
    note_fonts,
    pdf_note,
    plain_document,
)
from noted import SYSTEM, note

RU = get_language("ru")


def test_the_note_is_the_same_each_time_and_embeds_its_letters() -> None:
    data = pdf_note(note(), RU, author="И. Иванов")
    assert data == pdf_note(note(), RU, author="И. Иванов") and data.startswith(b"%PDF")
    assert b"Helvetica" not in data


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_every_node_is_on_its_pages(tmp_path: Path) -> None:
    (tmp_path / "n.pdf").write_bytes(pdf_note(note(), RU))
    order = ["pdftotext", "-layout", str(tmp_path / "n.pdf"), "-"]
    pages = subprocess.run(order, capture_output=True, timeout=60).stdout.decode().split("\f")
    assert "Пояснительная записка" in pages[0] and "Омск 2026" in pages[0]
    contents = [" ".join(line.replace(".", " ").split()) for line in pages[1].splitlines()]
    assert "1 Кинематика 3" in contents or "1 Кинематика 4" in contents
    whole = "\n".join(pages)
    for part in ("1.1 Скорости", "(1.1)", "(1.2)", "Таблица 1 – Скорости", "Рисунок 1 – План",
                 "2. Попов", "Примечание", "На рисунке 1"):  # fmt: skip
        assert part in " ".join(whole.replace("\u00a0", " ").split())
    assert not any(sign in whole for sign in "_^{}\\")


def test_fractions_are_built_up_and_terms_underlined() -> None:
    setter = FormulaSetter(note_fonts(), 14.0)
    line, built = setter.set(parse("ab")), setter.set(parse(r"\frac{a}{b}"))
    assert built.ascent + built.descent > 1.5 * (line.ascent + line.descent)
    ((_, rule), _), (above, below) = built.lines[0], built.letters
    apart = (above.y - DESCENT * 14.0 - rule, rule - below.y - ASCENT * 14.0)
    assert apart[0] > 1.0 and apart[1] == pytest.approx(apart[0])  # neither touches the line
    assert len(built.lines) == 1 and len(setter.set(parse(r"\sqrt{\bar{a}}")).lines) == 2
    system = setter.equations(SYSTEM)
    assert len(system.lines) == 6 + 6 + 1  # bars above, lines below, the brace
    assert system.descent > 14.0


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_text_goes_before_a_table_that_does_not_fit_and_long_titles_have_dots(
    tmp_path: Path,
) -> None:
    table = Table(("N", "v"), tuple((f"строка{k}", "1") for k in range(14)), name="Значения")
    long = Part("Крайние положения, ход и коэффициент изменения средней скорости слова")
    written = Document.of(
        (Contents(), Chapter("Глава"), long, *(Paragraph(f"Абзац {k}.") for k in range(21)), table,
         Paragraph("После таблицы."), Part("Дальше"))
    )  # fmt: skip
    (tmp_path / "n.pdf").write_bytes(pdf_note(written, RU))
    order = ["pdftotext", "-layout", str(tmp_path / "n.pdf"), "-"]
    pages = subprocess.run(order, capture_output=True, timeout=60).stdout.decode().split("\f")
    assert "слова" in pages[0] and re.search(r"слова( \.)+ *\d", pages[0])
    assert "После таблицы." in pages[1] and "Значения" not in pages[1] and "строка0" in pages[2]
    assert pages[2].index("строка13") < pages[2].index("Дальше")


def test_every_node_goes_through_the_other_writers() -> None:
    page = html_document(note(), title="Note", lang="ru")
    assert 'class="fraction"' in page and "<svg" in page and "Рисунок 1 – План" in page
    assert "\\" not in page.partition("<body>")[2].replace("\\n", "")
    text = plain_document(note(), RU)
    assert "\n1.1.1 Группа 2–3" in text and "(1.2)" in text and "Таблица 1 – Скорости" in text


def _pages(written: Document, folder: Path) -> list[str]:
    (folder / "n.pdf").write_bytes(pdf_note(written, RU))
    order = ["pdftotext", "-layout", str(folder / "n.pdf"), "-"]
    shown = subprocess.run(order, capture_output=True, timeout=60).stdout.decode()
    return shown.removesuffix("\f").split("\f")


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
@pytest.mark.parametrize(("high", "count"), [(90.0, 1), (105.0, 1), (150.0, 2)])
def test_a_figure_that_ends_a_chapter_shrinks_a_little_to_stay_on_its_page(
    high: float, count: int, tmp_path: Path
) -> None:
    """17 lines leave 100 mm of a page of 257 mm; a picture is not reduced below 78 %."""
    view = DrawingView(Drawing(80.0, high, "Plan"))
    figure = Figure(view, "План", numbered=True, key="plan")
    lines = [Paragraph(f"Абзац {k}.") for k in range(17)]
    pages = _pages(Document.of((*lines, figure)), tmp_path)
    assert len(pages) == count and "План" in pages[-1]


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_a_table_that_runs_on_is_marked_as_continued_on_each_page(tmp_path: Path) -> None:
    rows = tuple((f"строка{k}", "1") for k in range(120))
    table = Table(("N", "v"), rows, name="Значения")
    first, *others = _pages(Document.of((Contents(), Chapter("Глава"), table)), tmp_path)[1:]
    assert "Таблица 1 – Значения" in first and "Продолжение" not in first
    assert len(others) > 1
    for page in others:
        lines = [line.split() for line in page.splitlines() if line.strip()]
        assert lines[:2] == [["Продолжение", "таблицы", "1"], ["N", "v"]]


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_no_text_comes_between_the_parts_of_a_wide_table(tmp_path: Path) -> None:
    head = tuple(f"k{k}" for k in range(14))
    rows = tuple(tuple("1" for _ in head) for _ in range(14))
    table = Table(head, rows, repeated=1, name="Значения")
    for count in (2, 5, 8, 11):
        lines = [Paragraph(f"Абзац {k}.") for k in range(count)]
        written = Document.of((Contents(), Chapter("Глава"), *lines, table, Paragraph("После.")))
        shown = "\n".join(_pages(written, tmp_path))
        assert shown.count("Продолжение таблицы 1") >= 1
        assert shown.index("После.") > shown.rindex("Продолжение таблицы 1")


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
@pytest.mark.parametrize(("after", "count"), [(2, 2), (9, 3)])
def test_a_page_of_a_few_lines_at_the_end_of_a_chapter_is_saved(
    after: int, count: int, tmp_path: Path
) -> None:
    """For two extra lines a figure of 120 mm shrinks; for half a page it would gain no page."""
    view = DrawingView(Drawing(80.0, 120.0, "Plan"))
    figure = Figure(view, "План", numbered=True, key="plan")
    lines = [Paragraph(f"Абзац {k}.") for k in range(13 + after)]
    nodes: list[Node] = [*lines[:3], figure, *lines[3:], PageBreak(), Paragraph("Дальше.")]
    assert len(_pages(Document.of(nodes), tmp_path)) == count


@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_steps_are_counted_in_each_part(tmp_path: Path) -> None:
    steps = (Step(("Берём.",)), Step(("Кладём.",)))
    written = Document.of((Contents(), Chapter("Глава"), Part("а"), *steps, Part("б"), *steps))
    shown = "\n".join(_pages(written, tmp_path)).replace("\u00a0", " ")
    assert [shown.count(f"{k}) ") for k in (1, 2, 3)] == [2, 2, 0]
