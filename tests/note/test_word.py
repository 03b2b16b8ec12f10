"""The writer of Word: native equations, numbers, styles, bytes that no clock changes."""

from __future__ import annotations

import contextlib
import re
import shutil
import subprocess
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any, get_args
from zipfile import ZIP_DEFLATED, ZipFile

import docx
import pytest
from doors import (
    Chapter,
    Contents,
    Document,
    DocumentItem as Item,
    DocumentStep as Step,
    Equation,
    Formula,
    LayoutError,
    Node,
    OutputError,
    Paragraph,
    Table,
    Term,
    formula_parse as parse,
    get_language,
    omml,
    protocol_document,
    word_document,
)
from noted import SYSTEM, nodes, note
from PIL import Image
from protocols import worked
from worked import SIX

RU = get_language("ru")
M, W = f"{{{omml.MATH}}}", f"{{{omml.WORD}}}"


def shape(element: Any) -> str:
    """Return the structure of an equation: ``sSub(v,B)``, quotation marks about plain text."""
    tag = element.tag.removeprefix(M)
    if tag == "r":
        text = element.find(f"{M}t").text
        return f'"{text}"' if element.find(f"{M}rPr/{M}nor") is not None else str(text)
    inside = [child for child in element if not child.tag.endswith("Pr")]
    if tag in ("e", "num", "den", "sub", "sup", "lim", "deg", "oMath"):
        return "".join(map(shape, inside))
    if tag == "bar":
        tag += element.find(f"{M}barPr/{M}pos").get(f"{M}val")
    return f"{tag}({','.join(shape(child) for child in inside if child.tag != f'{M}deg')})"


def shape_of(markup: str) -> str:
    return shape(omml.equation(parse(markup)))


@pytest.mark.parametrize(
    ("markup", "structure"),
    [
        ("v_{B}", "sSub(v,B)"),
        ("a^{n}_{CB}", "sSubSup(a,CB,n)"),
        ("ω_{2}^{2}·l", "sSubSup(ω,2,2)·l"),
        ("l_{AB}·15,5^{2}", "sSub(l,AB)·sSup(15,5,2)"),
        (r"ω = \frac{v_{B}}{l}", "ω=f(sSub(v,B),l)"),
        (r"\sqrt{x^{2} + 1}", "rad(sSup(x,2)+1)"),
        (r"\bar{v}_{B}", "sSub(bartop(v),B)"),
        ("= 5", '"= "5'),
        ("a =", 'a" ="'),
        ("(pb) = −3 мм", '(pb)=−3"\u00a0""мм"'),
        (r"(\frac{a}{b})", "d(f(a,b))"),
        ("(1 + δ)^{2}", "sSup(d(1+δ),2)"),
        ("_{2}", f'sSub("{omml.EMPTY}",2)'),
        ("2M_{max}", '2sSub(M,"max")'),
        ("AB_{1} (x", 'AsSub(B,1)"\u00a0""("x'),
        ("tg ψ", '"tg""\u00a0"ψ'),
        ("5 N·m", '5"\u00a0""N·m"'),
    ],
)
def test_formulas_are_native_structures(markup: str, structure: str) -> None:
    assert shape_of(markup) == structure


def test_vector_equations_have_bars_underlines_and_directions() -> None:
    system = shape(omml.vector_equations(SYSTEM))
    assert system.startswith("d(eqArr(") and system.count("bartop(v)") == 6
    assert "barbot(barbot(sSub(bartop(v),B)))" in system.replace(",B3B", ",X")
    assert system.count("limLow") == 0  # LibreOffice sets a limit in letters of an index
    terms, below = re.findall(r"mr\(([^\u2225]*?)\),mr\((.*?)\)", system)[0]
    assert terms.endswith(",barbot(sSub(bartop(v),B3B))") and below.endswith('"∥""\u00a0"CB')


def test_an_equation_without_directions_is_one_line() -> None:
    one = Equation((Term("G_{2}", 2), Term("F_{12}", 2)), (), r"Σ\bar{F}")
    text = shape(omml.vector_equations([one]))
    assert "mr(" not in text and text.endswith('"\u00a0=\u00a0"0') and text.startswith("Σbartop(F)")


def test_a_long_sum_is_cut_at_a_sign_that_is_repeated() -> None:
    forces = tuple(Term(f"F_{{{k}{k + 1}}}", 1, "∥ x-x") for k in range(12))
    equation = omml.vector_equations([Equation(forces)], 27.0)
    lines = equation.findall(f"{M}eqArr/{M}e")
    ends = [shape(line.find(f"{M}m/{M}mr/{M}e[last()]")).strip('"\u00a0') for line in lines]
    starts = [shape(line.find(f"{M}m/{M}mr/{M}e")).strip('"\u00a0') for line in lines]
    assert len(lines) > 1 and set(ends[:-1]) == set(starts[1:]) == {"+"}
    assert ends[-1].endswith("0") and shape(equation).count("bartop(F)") == 12


def test_a_direction_below_a_term_is_one_size_smaller_at_the_most() -> None:
    system = omml.vector_equations(SYSTEM)
    rows = list(system.iter(f"{M}mr"))
    sizes = [size.get(f"{M}val") for row in rows[1::2] for size in row.iter(f"{M}argSz")]
    assert set(sizes) == {"-1"} and not list(system.iter(f"{M}limLow"))


def test_points_are_italic_with_an_index_and_without() -> None:
    text = "Точка B звена 2 и точка O_{1} группы II класса лежат на x–x"
    file = opened(word_document(Document.of([Paragraph(text)]), RU))
    shown = [shape(one) for one in file.element.body.iter(f"{M}oMath")]
    assert shown[:2] == ["B", "sSub(O,1)"] and len(shown) == 3
    english = word_document(Document.of([Paragraph("A point B of link 2")]), get_language("en"))
    assert not list(opened(english).element.body.iter(f"{M}oMath"))


def test_the_lead_in_of_a_formula_stays_with_it() -> None:
    written = (
        Paragraph("Отсюда"), Formula("v_{B} = 5"), Paragraph("Свободен."),
        Step(("Вычисляем", "v_{B} = 5 м/с.", "Конец.")), Paragraph("Данные:"), Item("одно"),
    )  # fmt: skip
    file = opened(word_document(Document.of(written), RU))
    kept = {p.text: bool(p.paragraph_format.keep_with_next) for p in file.paragraphs if p.text}
    assert [text for text, keep in kept.items() if keep] == [
        "Отсюда",
        "1)\u00a0Вычисляем",
        "Данные:",
    ]


def test_ranges_and_coordinates_are_not_cut() -> None:
    text = "Группа звеньев 4–5, точка (0; 25) мм"
    file = opened(word_document(Document.of([Paragraph(text)]), RU))
    assert file.paragraphs[0].text == "Группа звеньев 4–\u200d5, точка (0;\u00a025)\u00a0мм"


@pytest.mark.parametrize("rows", [3, 12])
def test_no_row_of_a_table_is_left_alone(rows: int) -> None:
    table = Table(("N", "v"), tuple((str(k), "1") for k in range(rows)))
    made = opened(word_document(Document.of([table]), RU)).tables[0]
    kept = [bool(row.cells[0].paragraphs[0].paragraph_format.keep_with_next) for row in made.rows]
    last = len(kept) - 1
    assert kept == [k < last and (rows < 5 or k < 2 or k == last - 1) for k in range(last + 1)]
    assert made.rows[0]._tr.trPr.find(f"{W}tblHeader") is not None


@pytest.mark.parametrize(("rows", "strips"), [(3, 0), (12, 1)])
def test_a_table_that_may_be_cut_has_its_continuation_in_the_head(rows: int, strips: int) -> None:
    """The strip repeats with the head; at the start of the table its name covers it."""
    table = Table(("N", "v"), tuple((str(k), "1") for k in range(rows)), name="Значения")
    file = opened(word_document(Document.of([Contents(), Chapter("Глава"), table]), RU))
    made = file.tables[0]
    heads = [row for row in made.rows if row._tr.trPr.find(f"{W}tblHeader") is not None]
    told = [row.cells[0].text for row in heads]
    assert told == ["Продолжение таблицы 1"] * strips + ["N"]
    rectangles = list(file.element.body.iter("{urn:schemas-microsoft-com:vml}rect"))
    assert len(rectangles) == strips and len(made.rows) == rows + 1 + strips
    assert [p.text for p in file.paragraphs].count("Таблица 1 – Значения") == 1
    if strips:
        before = made._tbl.getprevious()
        assert rectangles[0] in before.iter() and len(heads[0]._tr.tc_lst) == 1
        kept = [row.cells[0].paragraphs[0].paragraph_format.keep_with_next for row in heads]
        assert all(kept)


def opened(data: bytes) -> Any:
    return docx.Document(BytesIO(data))


@pytest.fixture(scope="module")
def data() -> bytes:
    return word_document(note(), RU, author="И. Иванов")


def texts_of(file: Any) -> list[str]:
    return [text.text or "" for text in file.element.body.iter(f"{W}t")]


def test_a_text_without_characters_is_written() -> None:
    assert word_document(Document.of([Paragraph("")]), RU)


def test_the_document_of_the_tests_has_every_node() -> None:
    assert {type(node) for node in nodes()} == set(get_args(Node))


def test_every_node_is_written(data: bytes) -> None:
    file = opened(data)
    styles = {p.style.name for p in file.paragraphs}
    assert {"Heading 1", "Heading 2", "Heading 3", "Caption", "Table Name", "toc 1"} <= styles
    text = "\n".join(p.text for p in file.paragraphs)
    for part in ("Пояснительная записка", "1 Кинематика", "1.1 Скорости", "1.1.1 Группа 2–3",
                 "Таблица 1 – Скорости", "Рисунок 1 – План", "2.\u00a0Попов",
                 "На рисунке 1"):  # fmt: skip
        assert part in text
    numbers = [cell.text for table in file.tables for row in table.rows for cell in row.cells]
    assert {"(1.1)", "(1.2)"} <= set(numbers)
    first = file.sections[0]
    assert [round(side.mm) for side in (first.left_margin, first.right_margin)] == [30, 15]
    assert any(s.page_width > s.page_height for s in file.sections)
    assert len(file.inline_shapes) == 2


def test_no_markup_is_left_as_text_and_no_base_is_empty(data: bytes) -> None:
    body = opened(data).element.body
    left = [t for t in body.iter(f"{W}t", f"{M}t") if re.search(r"[_^{}\\]", t.text or "")]
    assert not left
    bases = [*body.iter(f"{M}e", f"{M}num", f"{M}den", f"{M}sub", f"{M}sup", f"{M}lim")]
    assert bases and all(len(base) for base in bases)


@pytest.mark.parametrize("name", [SIX[0], SIX[-1]])
def test_no_formula_of_a_protocol_is_lost_as_text(name: str) -> None:
    written = word_document(protocol_document(worked(name), RU), RU)
    body = opened(written).element.body
    assert not re.search(r"[_^{}\\]", "".join(texts_of(opened(written))))
    assert len(list(body.iter(f"{M}oMath"))) > 60 and len(list(body.iter(f"{M}f"))) > 5


ORDER = ("tblStyle", "tblW", "jc", "tblInd", "tblBorders", "tblLayout", "tblCellMar", "tblLook")
"""Order of the properties of a table in the schema: Word accepts no other."""


def test_properties_are_in_the_order_of_the_schema() -> None:
    file = opened(word_document(note(), RU, frame=True))
    feet = [section.first_page_footer for section in file.sections[1:2]]
    for table in (*file.tables, *(foot.tables[0] for foot in feet)):
        names = [child.tag.removeprefix(W) for child in table._tbl.tblPr]
        assert names == sorted(names, key=ORDER.index)
    settings = [child.tag.removeprefix(W) for child in file.settings.element]
    assert settings.index("updateFields") < settings.index("compat")
    assert settings.index("zoom") < settings.index("updateFields")


def test_the_contents_are_there_before_they_are_brought_up_to_date(data: bytes) -> None:
    file = opened(data)
    entries = [p for p in file.paragraphs if p.style.name.lower().startswith("toc ")]
    assert len(entries) == 5
    codes = [code.text for code in file.element.body.iter(f"{W}instrText")]
    assert (
        any("TOC" in str(code) for code in codes) and sum("PAGEREF" in str(c) for c in codes) == 5
    )
    marks = {mark.get(f"{W}name") for mark in file.element.body.iter(f"{W}bookmarkStart")}
    assert {link.get(f"{W}anchor") for link in file.element.body.iter(f"{W}hyperlink")} == marks


def test_the_file_does_not_depend_on_the_clock(data: bytes) -> None:
    assert word_document(note(), RU, author="И. Иванов") == data
    with ZipFile(BytesIO(data)) as parts:
        assert {entry.date_time[0] for entry in parts.infolist()} == {1980}
        assert any(name.endswith(".svg") for name in parts.namelist())
    assert opened(data).core_properties.author == "И. Иванов"


def test_the_pages_are_a4_upright_with_the_margins_of_a_report(data: bytes) -> None:
    """GOST 7.32: left 30 mm, right 15 mm, above and below 20 mm."""
    first, *others = opened(data).sections
    for section in (first, *others):  # a page with a wide table lies on its side
        size = section.page_width.mm, section.page_height.mm
        assert sorted(size) == pytest.approx([210, 297], abs=0.1)
    assert first.page_width < first.page_height
    sides = first.left_margin.mm, first.right_margin.mm, first.top_margin.mm
    assert (*sides, first.bottom_margin.mm) == pytest.approx((30, 15, 20, 20), abs=0.1)


def test_pages_in_frames_have_title_blocks_with_the_fields_of_the_stamp() -> None:
    stamp = {"designation": "ТММ.01", "author": "Иванов", "title": "Пресс"}
    file = opened(word_document(note(), RU, frame=True, stamp=stamp))
    section = file.sections[1]
    first = section.first_page_footer.tables[0]
    cells = {cell.text for row in first.rows for cell in row.cells}
    name = "Пресс\nПояснительная записка"
    assert {"ТММ.01 ПЗ", "Иванов", name, "Разраб.", "Листов"} <= cells
    later = {cell.text for row in section.footer.tables[0].rows for cell in row.cells}
    assert {"ТММ.01 ПЗ", "Лист"} <= later and "Разраб." not in later
    codes = [c.text for c in first._tbl.iter(f"{W}instrText")]
    assert [str(code).strip() for code in codes] == ["PAGE", "NUMPAGES"]
    assert file.core_properties.author == "Иванов"


def test_a_template_gives_its_page_and_styles(tmp_path: Path) -> None:
    template = docx.Document()
    template.add_paragraph("Образец")
    template.sections[0].left_margin = 719455
    template.styles["Normal"].font.name = "Arial"
    template.save(str(tmp_path / "own.docx"))
    file = opened(word_document(note(), RU, template=tmp_path / "own.docx"))
    assert file.sections[0].left_margin == 719455 and file.styles["Normal"].font.name == "Arial"
    assert all("Образец" not in p.text for p in file.paragraphs)


def test_a_template_that_is_not_there_or_broken_is_a_fault(tmp_path: Path) -> None:
    (tmp_path / "own.docx").write_text("no file of Word")
    with ZipFile(tmp_path / "empty.docx", "w") as other:
        other.writestr("a.txt", "a")
    for name, fault in (
        ("own", "is not a Word file"), ("empty", "is not a Word file"),
        ("absent", "does not exist"),
    ):  # fmt: skip
        with pytest.raises(OutputError, match=fault) as raised:
            word_document(note(), RU, template=tmp_path / f"{name}.docx")
        assert f"{name}.docx" in str(raised.value) and raised.value.exit_code == 2


def changed(folder: Path, change: Callable[[str, bytes], bytes | None]) -> Path:
    """Return a template with changed parts; a part that becomes None is left out."""
    plain, path = BytesIO(), folder / "own.docx"
    docx.Document().save(plain)
    with ZipFile(plain) as parts, ZipFile(path, "w", ZIP_DEFLATED) as written:
        for name in parts.namelist():
            if (data := change(name, parts.read(name))) is not None:
                written.writestr(name, data)
    return path


BODY, STYLES = "word/document.xml", "word/styles.xml"

BROKEN: dict[str, tuple[str, str, str]] = {
    "no section": (BODY, r"<w:sectPr.*?</w:sectPr>", ""),
    "no page": (BODY, r"<w:pgSz[^>]*>", ""),
    "a width that is none": (BODY, r'w:w="\d+"', 'w:w="x"'),
    "a margin that is none": (BODY, r'w:left="\d+"', 'w:left=""'),
    "a narrow page": (BODY, r'w:w="\d+"', 'w:w="99"'),
    "an endless page": (BODY, r'w:w="\d+"', 'w:w="99999999"'),
    "no body": (BODY, r"<w:body>.*</w:body>", ""),
    "another root": (BODY, r"w:document", "w:other"),
    "styles of another kind": (STYLES, r"w:styles", "w:other"),
    "a size of letters that is none": (STYLES, r'<w:sz w:val="\d+"', '<w:sz w:val="x"'),
    "no usual style": (STYLES, r'"Normal"', '"Usual"'),
    "a flag that is none": (STYLES, r"<w:qFormat/>", '<w:qFormat w:val="?"/>'),
    "letters nobody knows": (STYLES, "encoding=.UTF-8.", 'encoding="x-none"'),
    "half of its styles": (STYLES, r"</w:styles>", ""),
    "no types": ("[Content_Types].xml", r"(Types|Override|Default)", r"x\1"),
    "no relations": ("_rels/.rels", r"Relationship ", "Nothing "),
    "a part that is not there": ("word/_rels/document.xml.rels", r'Target="styles', 'Target="no'),
    "settings of another kind": ("word/settings.xml", r"w:settings", "w:other"),
    "properties of another kind": ("docProps/core.xml", r"coreProperties", "x"),
}


SERVES = ("a size of letters that is none", "a flag that is none", "settings of another kind")
"""Faults that Word and the library tolerate."""


@pytest.mark.parametrize("how", BROKEN)
def test_a_broken_template_is_reported_in_one_way_or_works(how: str, tmp_path: Path) -> None:
    """Without a section, types or a page width it ended with exit code 5."""
    part, old, new = BROKEN[how]

    def change(name: str, data: bytes) -> bytes:
        if name != part:
            return data
        text, found = re.subn(old, new, data.decode(), flags=re.S)
        assert found
        return text.encode()

    with contextlib.suppress(OutputError):
        made = word_document(note(), RU, template=changed(tmp_path, change))
        assert opened(made).paragraphs and how in SERVES
        return
    assert how not in SERVES


@pytest.mark.parametrize("left_out", ["styles", "settings", "theme", "numbering", "core", "Types"])
def test_a_template_may_lack_parts(left_out: str, tmp_path: Path) -> None:
    template = changed(tmp_path, lambda name, data: None if left_out in name else data)
    with contextlib.suppress(OutputError):
        assert opened(word_document(note(), RU, template=template)).paragraphs


@pytest.mark.parametrize(
    ("what", "said"),
    [
        (b" " * (33 * 2**20), "33 MiB; the limits are 1000 and 32 MiB"),
        (b"<w:p/>" * 200_001, "over 200000 elements"),
        (b"<w:p>" * 250 + b"</w:p>" * 250, "nested over 200 deep"),
        (b"<w:p " + b" ".join(b'a%d=""' % k for k in range(200_001)) + b"/>", "200000 elements"),
    ],
    ids=["bytes", "elements", "depth", "attributes"],
)
def test_a_template_is_looked_through_before_it_is_read(
    what: bytes, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    template = changed(tmp_path, lambda name, data: data.replace(b"</w:body>", what + b"</w:body>"))
    monkeypatch.setattr(docx, "Document", None)
    with pytest.raises(OutputError, match=said):
        word_document(note(), RU, template=template)


def test_a_failure_without_the_template_is_not_blamed_on_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def fail(*_: object, **__: object) -> None:
        raise ZeroDivisionError

    monkeypatch.setattr("planmethod.note.writers.word.strip_timestamps", fail)
    with pytest.raises(ZeroDivisionError):
        word_document(note(), RU, template=changed(tmp_path, lambda name, data: data))


def test_referenced_targets_must_exist() -> None:
    with pytest.raises(LayoutError, match="speed"):
        word_document(Document.of([Paragraph(r"По формуле (\ref{speed})")]), RU)


def test_a_long_formula_is_cut_into_lines() -> None:
    sides = " = ".join(f"v_{{{k}}} + 12345,678" for k in range(12))
    file = opened(word_document(Document.of([Formula(sides)]), RU))
    assert len(list(file.element.body.iter(f"{M}oMathPara"))) > 2


@pytest.mark.dear
@pytest.mark.skipif(not shutil.which("soffice"), reason="LibreOffice is absent")
@pytest.mark.skipif(not shutil.which("pdftotext"), reason="poppler is absent")
def test_libreoffice_opens_it(data: bytes, tmp_path: Path) -> None:
    (tmp_path / "note.docx").write_bytes(data)
    home = f"-env:UserInstallation={(tmp_path / 'home').as_uri()}"
    order = ["soffice", home, "--headless", "--convert-to", "pdf", "note.docx"]
    subprocess.run(order, cwd=tmp_path, capture_output=True, timeout=120, check=True)
    shown = subprocess.run(
        ["pdftotext", "-layout", "note.pdf", "-"], cwd=tmp_path, capture_output=True, timeout=60
    ).stdout.decode()
    assert "Содержание" in shown and "Рисунок 1 – План" in shown and "(1.2)" in shown
    assert not re.search(r"[_^\\]", shown)  # the brace is that of the system


@pytest.mark.dear
@pytest.mark.skipif(not shutil.which("soffice"), reason="LibreOffice is absent")
@pytest.mark.skipif(not shutil.which("pdftoppm"), reason="poppler is absent")
def test_libreoffice_shows_the_continuation_on_later_pages_alone(tmp_path: Path) -> None:
    rows = tuple((f"строка{k}", "1") for k in range(120))
    table = Table(("N", "v"), rows, name="Значения")
    data = word_document(Document.of([Chapter("Глава"), table]), RU)
    (tmp_path / "note.docx").write_bytes(data)
    home = f"-env:UserInstallation={(tmp_path / 'home').as_uri()}"
    order = ["soffice", home, "--headless", "--convert-to", "pdf", "note.docx"]
    subprocess.run(order, cwd=tmp_path, capture_output=True, timeout=120, check=True)
    order = ["pdftoppm", "-r", "72", "-gray", "note.pdf", "page"]
    subprocess.run(order, cwd=tmp_path, capture_output=True, timeout=60, check=True)
    order = ["pdftotext", "-bbox", "note.pdf", "-"]
    shown = subprocess.run(order, cwd=tmp_path, capture_output=True, timeout=60).stdout.decode()
    pages = shown.split("<page ")[1:]
    word = re.compile(r'xMin="([\d.]+)" yMin="([\d.]+)" xMax="([\d.]+)" yMax="([\d.]+)">Прод')
    ink = []
    for text, path in zip(pages, sorted(tmp_path.glob("page-*.pgm")), strict=True):
        found = word.search(text)
        assert found is not None
        left, top, right, bottom = (round(float(side)) for side in found.groups())
        with Image.open(path) as picture:
            inked = picture.crop((left, top + 2, right, bottom - 3)).tobytes()
            ink.append(min(inked) < 128)
    assert len(ink) > 2 and ink == [False] + [True] * (len(ink) - 1)
