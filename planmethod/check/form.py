"""The form that a student fills in: a workbook without what the answers are (бланк ответов)."""

from __future__ import annotations

import hashlib
import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence, Set
from enum import Enum
from functools import partial
from typing import Any

from msgspec import Struct
from msgspec.structs import asdict, replace

from planmethod.check.key import rich
from planmethod.check.model import KeyEntry
from planmethod.check.submissions.gather import is_of
from planmethod.check.submissions.xlsx_file import META
from planmethod.mechanism.model import FRAME, Mechanism
from planmethod.note.document import plain_text
from planmethod.note.wording import Language, MessageTable, get_language
from planmethod.note.writers.workbook import saved
from planmethod.problem.formula import ratio_of, read_unit
from planmethod.problem.machine_records import OF_NOTE, ProjectTask
from planmethod.problem.quantities import SLIDINGS, QuantityKind, QuantityNameError, parse_words
from planmethod.problem.records import KindProblem

SCHEMA = 1

_WIDTHS = (5, 14, 56, 16, 13, 14, 11, 28, 22)
_IRRELEVANT_PARTS = (
    "name", "title", "sheet", "stamp", "published", "source", "variants", "variant",
    "source_file", "source_table", "drawn", "letters", "synthesis",
)  # fmt: skip
"""Parts of a problem that do not affect the answers."""

_FIELDS_OF_FILES = ("path", "length_unit", "file_keys", *OF_NOTE)
"""Fields that say how a file is written, or what its note has besides: they make no difference."""

_FINGERPRINT_NAMES = {
    "assembly_positions": "judged", "cam_drive": "followed", "gear_drive": "geared",
    "is_pulley": "plain", "lateral_offset": "across", "min_radius": "least",
    "nearest_to": "near", "parameters": "told", "planets": "satellites", "relation": "where",
    "shift_wheel": "alone", "stated_count": "told_count",
}  # fmt: skip
"""Names that fields had when the forms in use were handed out: a form carries its fingerprint."""

_AGREE = 0.01
"""Relative difference of mm × μ and the value above which the form reports a mismatch."""


def fingerprint_of(problem: KindProblem) -> str:
    """Return the fingerprint of a problem: SHA-256 of everything that the answers depend on.

    Comments and the order of the file, its titles and published values make no difference.
    """
    parts = _parts(problem)
    if parts.get("synthesis") is not None:  # a size counts, not how the file has it
        names_size = parts["synthesis"].is_named_in
        stated = parts["stated"].items()
        parts["stated"] = {path: text for path, text in stated if not names_size(text)}
    kept = {name: part for name, part in parts.items() if name not in _IRRELEVANT_PARTS}
    text = json.dumps(kept, sort_keys=True, ensure_ascii=False, default=_parts)
    return hashlib.sha256(text.encode()).hexdigest()


def _parts(record: Any) -> Any:
    """Return the parts of a record, for JSON."""
    if isinstance(record, Mechanism):
        record = replace(record, frame=FRAME)  # its printed number makes no difference
    if isinstance(record, ProjectTask) and record.is_of_note:
        return None
    if isinstance(record, Struct):
        return {
            _FINGERPRINT_NAMES.get(name, name): part
            for name, part in asdict(record).items()
            if name not in _FIELDS_OF_FILES
        }
    if isinstance(record, Mapping):
        return dict(record)
    if isinstance(record, Set):  # in no order that a process would choose
        return sorted(map(str, record))
    return record.value if isinstance(record, Enum) else str(record)


class FormHead(Struct, frozen=True, kw_only=True):
    """What a form is of (шапка бланка).

    Attributes
    ----------
    problem, variant, title : str
        Names of the problem and its variant, and the title of the form.
    fingerprint : str
        Of the problem, see `fingerprint_of`.
    student : str
        Name; the student fills it in if empty.
    lang : str
        Language of the form.
    """

    problem: str
    variant: str | None = None
    fingerprint: str = ""
    student: str = ""
    title: str = ""
    lang: str = "ru"


def form_of(entries: Sequence[KeyEntry], head: FormHead) -> bytes:
    """Return the form as XLSX: locked but for the answers, with lists of senses and units.

    The right values of the entries are not written. The same arguments give the same bytes.
    """
    import openpyxl

    language = get_language(head.lang)
    texts = language.form
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = texts.sheet
    units = offered_units(entries, texts)
    _write_meta(book, entries, units, head)
    scales = _write_head(sheet, entries, texts, head)
    _write_rows(sheet, list_form_rows(entries, language), texts, scales)
    for number, width in enumerate(_WIDTHS, 1):
        sheet.column_dimensions[openpyxl.utils.get_column_letter(number)].width = width
    sheet.page_setup.orientation = "landscape"
    sheet.page_setup.paperSize = 9
    sheet.page_setup.fitToHeight = 0
    sheet.sheet_properties.pageSetUpPr = openpyxl.worksheet.properties.PageSetupProperties(
        fitToPage=True
    )
    sheet.column_dimensions["B"].hidden = True  # the letters are in the next one
    sheet.protection.sheet = True
    sheet.protection.formatColumns = False
    book.properties.creator = "planmethod"
    return saved(book)


def _write_meta(
    book: Any, entries: Sequence[KeyEntry], units: Sequence[str], head: FormHead
) -> None:
    """Write what the form is of, and what the units are, on a sheet that is not shown."""
    sheet = book.create_sheet(META)
    said = [("schema", str(SCHEMA)), ("problem", head.problem), ("variant", head.variant or "")]
    said += [("fingerprint", head.fingerprint), *(("id", entry.id) for entry in entries)]
    for number, (name, text) in enumerate(said, 1):
        sheet.cell(number, 1, name)
        _write(sheet.cell(number, 2), text)
    for number, unit in enumerate(units, 1):
        sheet.cell(number, 4, unit)
        found = read_unit(unit)
        sheet.cell(number, 5, found.factor if found else None)
    sheet.protection.sheet = True
    sheet.sheet_state = "veryHidden"


def _write_head(
    sheet: Any, entries: Sequence[KeyEntry], texts: MessageTable, head: FormHead
) -> dict[str, str]:
    """Write the fields for the student and their scales; return the cells of the scales."""
    from openpyxl.styles import Font

    _write(sheet["A1"], head.title or texts.title)
    sheet["A1"].font = Font(bold=True, size=14)
    for line in texts["advice"]:
        sheet.append([line])
    given = [
        (texts.student, head.student),
        (texts.group, ""),
        (texts.variant, head.variant or ""),
        (texts.problem, head.problem),
    ]
    for label, text in given:
        sheet.append([label])
        cell = sheet.cell(sheet.max_row, 4)
        _write(cell, text)
        if label != texts.problem and not (label == texts.variant and text):
            _open(cell)
    places: dict[str, str] = {}
    asked = {entry.scale for entry in entries if entry.mm is not None}
    for name, label in texts["scales"].items():
        if name in asked:
            sheet.append([label])
            places[name] = f"$D${sheet.max_row}"
            _open(sheet.cell(sheet.max_row, 4))
    if places:
        sheet.append([texts.ruler])
        _open(sheet.cell(sheet.max_row, 4))
    return places


def _write_rows(
    sheet: Any,
    rows: Sequence[FormRow],
    texts: MessageTable,
    scales: Mapping[str, str],
) -> None:
    """Write a row for each answer."""
    from openpyxl.styles import Font
    from openpyxl.worksheet.datavalidation import DataValidation

    positions = any(row.position for row in rows)
    sheet.append([])
    sheet.append([*texts["columns"], *([texts.position] if positions else [])])
    head = sheet.max_row
    for cell in sheet[head]:
        cell.font = Font(bold=True)
    sheet.freeze_panes = f"A{head + 1}"
    lists: dict[tuple[str, ...], Any] = {}
    for number, one in enumerate(rows, 1):
        row = head + number
        named = ", ".join(filter(None, (one.words, one.letters)))
        for column, text in ((1, number), (2, one.id), (3, named), (7, one.unit)):
            _write(sheet.cell(row, column), text)
        for column in (4, 6):
            if column == 6 or one.mm:
                _open(sheet.cell(row, column))
        offered = [(7, one.units), (8, tuple(one.senses.values()))]
        for column, choices in offered:
            if not choices:
                continue
            _open(sheet.cell(row, column))
            if choices not in lists:
                formula = f'"{",".join(choices)}"'
                lists[choices] = DataValidation(type="list", formula1=formula, error=texts.refused)
                sheet.add_data_validation(lists[choices])
            lists[choices].add(f"{'ABCDEFGH'[column - 1]}{row}")
        scale = scales.get(one.scale)
        if scale:
            sheet.cell(row, 5, f'=IF({scale}="","",{scale})')
            # The first unit means SI if a unit is not in the list.
            worth = f"F{row}*IFERROR(VLOOKUP(G{row},{META}!$D:$E,2,FALSE),1)"
            sheet.cell(
                row,
                9,
                f'=IF(OR(D{row}="",E{row}="",F{row}=""),"",IFERROR(IF(ABS(ABS(D{row}*E{row})'
                f'-ABS({worth}))<={_AGREE}*ABS({worth}),"{texts.agrees}","{texts.differs}"),""))',
            )
        if positions:
            sheet.cell(row, 10, one.position)


class FormRow(Struct, frozen=True):
    """One requested answer, without its value (строка бланка).

    Attributes
    ----------
    id, words, letters : str
        Words are empty of a quantity that only its letters name.
    mm : bool
        Whether a segment is measured for it.
    unit : str
        Unit in which it is requested; ``units``: the permitted ones.
    senses : mapping of str to str
        Permitted senses, by their codes; empty if none is requested.
    scale : str
        Scale whose product with the segment is the value, ``mu_v``; empty if there is none.
    position : int
    """

    id: str
    words: str
    letters: str
    mm: bool
    unit: str
    units: tuple[str, ...]
    senses: Mapping[str, str]
    scale: str
    position: int


def offered_units(entries: Sequence[KeyEntry], texts: MessageTable) -> list[str]:
    """Return the units that a form offers."""
    asked = (entry.requested_unit for entry in entries)
    return [unit for unit in dict.fromkeys((*texts["units"], *asked)) if unit and read_unit(unit)]


def list_form_rows(entries: Sequence[KeyEntry], language: Language) -> tuple[FormRow, ...]:
    """Return the rows of a form, without the values of the entries."""
    units = offered_units(entries, language.form)
    letters = _list_letters(entries, language)
    return tuple(map(partial(_form_row, units, language), entries, letters))


def _list_letters(entries: Sequence[KeyEntry], language: Language) -> list[str]:
    """Return the letters of the rows: a symbol only where no other row of the position has it."""
    symbols = [plain_text(language.notation.symbol(entry.symbol)) for entry in entries]
    placed = [(entry.position, symbol) for entry, symbol in zip(entries, symbols, strict=True)]
    counts = Counter(placed)
    return [
        place[1]
        if entry.label == entry.id and counts[place] == 1
        else plain_text(rich(entry.label))
        for entry, place in zip(entries, placed, strict=True)
    ]


def _form_row(units: Sequence[str], language: Language, entry: KeyEntry, letters: str) -> FormRow:
    fitting = tuple(unit for unit in units if ratio_of(unit, entry.unit) is not None)
    usual = next((unit for unit in fitting if ratio_of(unit, entry.unit) == 1.0), entry.unit)
    senses = list(language.form["senses"].items())
    senses = senses[:2] if entry.unit in _TURNING else senses[2:]
    return FormRow(
        entry.id,
        describe(entry, letters, language),
        letters,
        entry.mm is not None,
        entry.requested_unit or usual,
        fitting,
        dict(senses if entry.asks_sense else ()),
        # ω is not its millimetres times μ
        entry.scale if is_of(entry.unit, entry.scale) else "",
        entry.position,
    )


def describe(entry: KeyEntry, letters: str, language: Language) -> str:
    """Return a quantity in words: "velocity of point B3"; empty if there are none for it.

    Points are called as in its letters.
    """
    names: Sequence[str]
    try:
        key = parse_words(entry.what)
        word, names = f"{key.word} {len(key.names)}", key.names
        shown = re.findall(r"[A-Z]\d*", letters.partition("_")[2])
        if key.kind in OF_POINTS and len(shown) == len(names):
            names = shown
    except QuantityNameError:  # a problem without plans: n_H, a_tau
        letter, held, carrier = entry.what.partition("^")
        head, *names = letter.split("_")
        word = f"{head}_{len(names)}{held}"
        names = [*names, carrier]
    phrases: MessageTable = language.form["quantities"]
    phrase: str = phrases.get(entry.what) or phrases.get(word, "")
    return phrase.format(*names)


OF_POINTS = (
    QuantityKind.VELOCITY,
    QuantityKind.ACCELERATION,
    QuantityKind.NORMAL,
    QuantityKind.TANGENTIAL,
    *SLIDINGS,
)


def unit_factor(unit: str) -> float | None:
    """Return the size of a unit in SI; None if it is not a unit."""
    found = read_unit(unit)
    return found.factor if found else None


_TURNING = ("1/s", "1/s²", "N·m")
"""Units of quantities with a sense of rotation."""


def _open(cell: Any) -> None:
    """Let a cell be filled in, and show that it is meant to be."""
    from openpyxl.styles import Border, PatternFill, Protection, Side

    line = Side(style="thin", color="999999")
    cell.protection = Protection(locked=False)
    cell.fill = PatternFill("solid", fgColor="FFF9D6")
    cell.border = Border(left=line, right=line, top=line, bottom=line)


def _write(cell: Any, value: str | int) -> None:
    """Write a text, which never is a formula, into a cell; or a number."""
    if isinstance(value, str):
        value = "".join(letter for letter in value if letter.isprintable())[:1000]
    cell.value = value or None
    if isinstance(value, str) and value:
        cell.data_type = "s"
