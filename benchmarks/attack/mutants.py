"""Files that strangers might send: shipped ones, changed at random from a seed (мутанты)."""

from __future__ import annotations

import io
import json
import random
import re
import tempfile
import zipfile
from collections.abc import Sequence
from functools import cache
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]

_VALUES = (
    "nan", "inf", "-inf", "0", "-1", "1e308", "-1e308", "1e-308", "5e-324", "99999999999", "1e6",
    "1" * 400, "true", "[]", "{}", '""', '"1/0"', '"9**9**9"', '"((((1"', '"2*pi"', '"sqrt(-1)"',
    "1979-05-27", "[nan, nan]", "[0, 0]", "[[[[]]]]", '["A", "A"]', '"ABCDEF"', '"\\u001b[2J"',
    "{ from = 0, to = 1e9, step = 1e-9 }", '"extreme"', "0.1", "360", "-0.0", '"А"', "1_0",
    '"1e-99999999999999999999"', '"0e99999999999999999999"', '"1e-99999999999999999999*t"',
    '"1e99999 mm"', '"4 in"', '"1500 rpm"', f'"{"-" * 400}1"', '"{}"', '"{0.__class__}"',
    '"{v!r:>999999999}"', '"%s%n"', '"\\u202e\\u200b\\U000E0041"', '"\\u0000"', '"\\uFFFF"',
)  # fmt: skip
_LINES = (
    "[variants.x]", "[[loads]]", "[cycle]", "count = 360", "[driver]", "phi = [0, 1e9]", "a = {",
    " " * 5000, "x" + "." * 70 + "y = 1", "[" * 200, 'k = """', "\x00", "\u202e", "#" * 8000,
    "[project]", "[machine]", "[scales]", "mu_l = 1e-12", "mu_v = 1e-12", "mu_a = 1e12",
    "[sheet]", 'paper = "A0"', "[links.99]", 'points = ["O", "A"]', "[published]", "[[answers]]",
    '"a".' * 3000 + '"a" = 1', "[" + "'a'." * 3000 + "a]", ".".join(["a"] * 4000) + " = 1",
    "[" + '"]".' * 2000 + "a]", 'title = "{v} {0} {} }{"', "x = " + "[" * 3000, "[[a]]\n" * 2000,
    "t = {" + "a.b." * 900 + "c = 1}",
)  # fmt: skip
_NUMBER = r"(?<![\w.\"])[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w.])"
_WORDS = (
    "", "nan", "1e999", "-", "1,5,5", "99999999999999999999", "1·10^999", "0", "²", "\u202e", "м/с",
    "=1+1", '"', "\x1b[2J", "x" * 5000, "\t", ";", "нет", "ccw", "1:2", "мм", "{}", "_{a}",
    "\\", "\ufeff", "x", "?", "н/д", "{v}", "{0}", "1e-99999999999999999999",
    "0e9999999999999999999", "1e-99999999999999999999 м/с", "-" * 400 + "1",
    "\u200b3\u200b", "\U000e0041",
    "../../x", "/etc/passwd", "CON", "\x00", "😀" * 40,
)  # fmt: skip


@cache
def shipped() -> list[str]:
    """Return the texts of the shipped problems."""
    paths = sorted((ROOT / "problems").glob("*/*.toml"))
    return [path.read_text("utf-8") for path in paths]


def problem(luck: random.Random) -> bytes:
    """Return a problem file that something was done to."""
    lines = luck.choice(shipped()).split("\n")
    for _ in range(luck.choice((1, 1, 1, 2, 3, 8))):
        if not lines:
            break
        at = luck.randrange(len(lines))
        match luck.randrange(12):
            case 0 | 1 | 2 | 3:
                lines[at] = re.sub(_NUMBER, lambda _: luck.choice(_VALUES), lines[at])
            case 4:
                lines[at] = f"{lines[at].partition('=')[0]}= {luck.choice(_VALUES)}"
            case 5:
                del lines[at]
            case 6:
                lines.insert(luck.randrange(len(lines)), lines[at])
            case 7:
                other = luck.choice(shipped()).split("\n")
                start = luck.randrange(len(other))
                lines[at:at] = other[start : start + luck.randrange(1, 20)]
            case 8:
                lines.insert(at, luck.choice(_LINES))
            case 9:
                lines[at] = _letters(lines[at], luck)
            case 10:
                one, two = luck.choice("ABCDEO"), luck.choice("ABCDEO1'")
                lines = [line.replace(one, two) for line in lines]
            case 11:
                head, _, rest = lines[at].partition("[")
                inside, _, end = rest.partition("]")
                lines[at] = f"{head}[{', '.join([inside] * luck.choice((2, 9, 70)))}]{end}"
    data = "\n".join(lines).encode("utf-8", "replace")
    return _bytes(data, luck) if luck.random() < 0.03 else data


def _letters(text: str, luck: random.Random) -> str:
    signs = list(text)
    for _ in range(luck.randrange(1, 4)):
        signs.insert(luck.randrange(len(signs) + 1), luck.choice("[]{}\"'=.,#\\\u202eя0-\x1b\n"))
    return "".join(signs)


def _bytes(data: bytes, luck: random.Random) -> bytes:
    mixed = bytearray(data)
    for _ in range(luck.randrange(1, 9)):
        if mixed:
            mixed[luck.randrange(len(mixed))] = luck.randrange(256)
    return bytes(mixed[: luck.randrange(len(mixed) + 1)] if luck.random() < 0.3 else mixed)


# Works -------------------------------------------------------------------------------------------

_HEADS = (
    "student", "what", "value", "unit", "mm", "sense", "v_B, м/с", "v B", "mu_v", "№", "position",
    "вариант", "a_B (мм)", "problem", "id", "ω3", "scale", "",
)  # fmt: skip
_CELLS = (
    "Иванов", "v B", "omega 3", "3,2", "1 234,5·10^-1 мм", "ccw", "↺", "12", "м/с", "a B", "pb",
    "2.5", "μ_v = 0,05", "точка B", "x_B", "y_D", "φ_3", "x S2", "v_Q", "a_B3B2",
    "t(A)", "R_12", "M_ур",
)  # fmt: skip


def work(luck: random.Random) -> tuple[str, bytes]:
    """Return the ending and the bytes of a file of works."""
    ending = luck.choice(("json", "csv", "xlsx", "toml", "tsv"))
    if luck.random() < 0.03:
        return ending, luck.choice(
            (b"", b"\0" * 900, b"\xff\xfe", b"PK\x03\x04", b"{", b"[[", b"null")
        )
    rows = [[_cell(luck) for _ in range(luck.randrange(1, 8))] for _ in range(luck.randrange(9))]
    rows.insert(0, luck.sample(_HEADS, luck.randrange(1, 7)))
    if ending == "xlsx":
        return ending, _workbook(rows, luck)
    if ending in ("json", "toml"):
        answers = [
            dict(zip(("what", "value", "mm", "sense", "unit"), row, strict=False)) for row in rows
        ]
        whole: object = {
            "student": _cell(luck),
            "answers": answers,
            "scales": {_cell(luck): _cell(luck)},
        }
        if luck.random() < 0.3:
            whole = [
                whole,
                {"student": "\ud800" if luck.random() < 0.5 else _cell(luck), "answers": answers},
            ]
        if luck.random() < 0.1:
            for _ in range(luck.choice((5, 990, 3000))):
                whole = [whole]
        try:
            text = json.dumps(whole)
        except RecursionError:
            text = "[" * 3000
        if luck.random() < 0.1:
            text = text[: luck.randrange(len(text))]
        return ending, _changed(text, luck)
    separator = luck.choice(";,\t")
    return ending, _changed("\n".join(separator.join(row) for row in rows), luck)


def answers(luck: random.Random) -> bytes:
    """Return a table of the works of a few students in which some cells are others."""
    head, *rows = (ROOT / "problems" / "groups" / "ex3.csv").read_text("utf-8-sig").splitlines()
    start = luck.randrange(len(rows))
    found = [row.split(";") for row in rows[start : start + luck.choice((5, 40, 90))]]
    for _ in range(luck.choice((0, 1, 3, 30))):
        row = luck.choice(found)
        row[luck.randrange(len(row))] = luck.choice((*_WORDS, *_CELLS))
    return "\n".join([head, *(";".join(row) for row in found)]).encode("utf-8", "replace")


def _cell(luck: random.Random) -> str:
    return luck.choice(_WORDS) if luck.random() < 0.2 else luck.choice(_CELLS)


def _changed(text: str, luck: random.Random) -> bytes:
    if luck.random() < 0.3:
        text = _letters(text, luck)
    data = text.encode(luck.choice(("utf-8", "utf-8", "utf-8", "cp1251", "utf-16")), "replace")
    return _bytes(data, luck) if luck.random() < 0.2 else data


@cache
def _book() -> dict[str, bytes]:
    import openpyxl

    book, stream = openpyxl.Workbook(), io.BytesIO()
    book.save(stream)
    with zipfile.ZipFile(stream) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


_PARTS = (
    b"<mergeCells>" + b'<mergeCell ref="A1:B2"/>' * 3000 + b"</mergeCells>", b"<x>" * 5000,
    b'<mergeCells><mergeCell ref="A1:XFD1048576"/></mergeCells>', b"<!DOCTYPE x>", b"<x/>" * 9999,
)  # fmt: skip


def _workbook(rows: Sequence[Sequence[str]], luck: random.Random) -> bytes:
    from xml.sax.saxutils import escape

    body = ""
    for number, row in enumerate(rows, 1):
        row_at = luck.choice((number, number, number, 1, 19_999, 1_048_576))
        cells = ""
        for n, text in enumerate(row):
            column = luck.choice((chr(65 + n), chr(65 + n), "A", "AZ", "XFD"))
            told = escape(re.sub("[^ -\ud7ff]", "_x001B_", text[:400]))
            cells += f'<c r="{column}{row_at}" t="inlineStr"><is><t>{told}</t></is></c>'
        body += f'<row r="{row_at}">{cells}</row>'
    parts = dict(_book())
    name = "xl/worksheets/sheet1.xml"
    sheet = parts[name].replace(b"<sheetData />", b"<sheetData/>")
    sheet = sheet.replace(b"<sheetData/>", f"<sheetData>{body}</sheetData>".encode())
    if luck.random() < 0.2:
        sheet = sheet.replace(b"</sheetData>", b"</sheetData>" + luck.choice(_PARTS))
    parts[name] = sheet
    if luck.random() < 0.2:
        spoilt = luck.choice(list(parts))
        parts[spoilt] = _bytes(parts[spoilt], luck)
    if luck.random() < 0.05:
        parts["xl/big.dat"] = b" " * (20 * 2**20)
    if luck.random() < 0.1:
        _share(parts, luck.choice((2, 30, 400)), luck.choice((1, 200)))
    return _zipped(parts, luck)


def _zipped(parts: dict[str, bytes], luck: random.Random) -> bytes:
    """Return an archive of parts, sometimes with bytes of its own changed."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for one, data in parts.items():
            archive.writestr(one, data)
    data = stream.getvalue()
    return _bytes(data, luck) if luck.random() < 0.1 else data


def _share(parts: dict[str, bytes], sheets: int, times: int) -> None:
    """Let many sheets of a workbook point at one part, whose rows are many."""
    book = "xl/workbook.xml"
    own = re.search(rb"<sheet [^>]*/>", parts[book])
    if own is None or b"</sheets>" not in parts[book]:
        return
    renamed = re.sub(rb'name="[^"]*"', rb'name="s%d"', own[0])
    renamed = re.sub(rb'sheetId="\d+"', rb'sheetId="%d"', renamed)
    more = b"".join(renamed % (n, n + 2) for n in range(sheets))
    parts[book] = parts[book].replace(b"</sheets>", more + b"</sheets>")
    name = "xl/worksheets/sheet1.xml"
    rows = re.search(rb"<row .*</row>", parts.get(name, b""), re.DOTALL)
    if rows is not None:
        parts[name] = parts[name].replace(b"</sheetData>", rows[0] * times + b"</sheetData>")


# Drawings ----------------------------------------------------------------------------------------

_ENTITIES = (
    "LINE", "LWPOLYLINE", "POLYLINE", "TEXT", "MTEXT", "INSERT", "BLOCK", "ENDBLK", "CIRCLE",
    "SPLINE", "HATCH", "SECTION", "ENDSEC", "EOF", "VERTEX", "SEQEND", "ATTRIB",
)  # fmt: skip
_STEPS = ("M0 0L1e999 1", "M", "Z" * 900, "M1 2L3 4 " * 4000, "C1 2 3", "M-.-1", "мм", "")


@cache
def _drawings() -> dict[str, bytes]:
    """Return the plans of a shipped problem as our own sheet, and as lines and letters of CAD."""
    import ezdxf
    from click.testing import CliRunner

    from planmethod.check.measured.files import read_svg
    from planmethod.cli import cli

    library: Any = ezdxf
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        problem = str(ROOT / "problems" / "linkages" / "ex3.toml")
        CliRunner().invoke(cli, ["sheet", problem, "--format", "svg", "-o", name])
        (sheet,) = folder.glob("*.svg")
        seen, file = read_svg(sheet), library.new("R2000")
        space = file.modelspace()
        for line in seen.lines:
            ends = [(end.real, end.imag) for end in (line.start, line.end)]
            space.add_line(*ends, dxfattribs={"layer": line.layer})
        block = file.blocks.new("LETTERS")
        for one in seen.inscriptions:
            block.add_text(
                one.text, height=one.high, dxfattribs={"insert": (one.at.real, one.at.imag)}
            )
        space.add_blockref("LETTERS", (0, 0))
        file.saveas(folder / "w.dxf")
        return {"svg": sheet.read_bytes(), "dxf": (folder / "w.dxf").read_bytes()}


def drawing(luck: random.Random) -> tuple[str, bytes]:
    """Return the ending and the bytes of a drawing that something was done to."""
    ending = luck.choice(("dxf", "dxf", "dxf", "svg"))
    lines = _drawings()[ending].decode("utf-8", "surrogateescape").split("\n")
    first = lines.index("ENTITIES") if ending == "dxf" and luck.random() < 0.8 else 0
    for _ in range(luck.choice((1, 1, 2, 5, 40))):
        at = luck.randrange(first, max(len(lines), first + 1))
        match luck.randrange(8):
            case 0 | 1 | 2 if ending == "dxf":  # values are every second line
                at += (at + 1) % 2
                lines[at : at + 1] = [_dxf_value("".join(lines[at : at + 1]).strip(), luck)]
            case 3:
                del lines[at : at + luck.choice((1, 2, 2, 2, 8))]
            case 4:
                more = lines[at : at + luck.randrange(1, 40)]
                lines[at:at] = more * min(
                    luck.choice((1, 9, 900)), 2**20 // (len("".join(more)) + 1)
                )
            case 5:
                lines[at : at + 1] = [_letters("".join(lines[at : at + 1]), luck)]
            case 6:
                text = "".join(lines[at : at + 1])[:5000]
                lines[at : at + 1] = [re.sub(_NUMBER, lambda _: luck.choice(_VALUES), text)]
            case _:
                steps = luck.choice(_STEPS)
                text = "".join(lines[at : at + 1])
                lines[at : at + 1] = [re.sub(r' d="[^"]*"', f' d="{steps}"', text)]
    data = "\n".join(lines).encode("utf-8", "replace")
    return ending, _bytes(data, luck) if luck.random() < 0.1 else data


def _dxf_value(value: str, luck: random.Random) -> str:
    """Return another value of the same kind: a number for a number, a word for a word."""
    if re.fullmatch(r"-?\d+", value):
        return luck.choice(("0", "-1", "1", "256", "99999", "-2147483648", "2147483647"))
    if re.fullmatch(r"-?[\d.]+(e[-+]?\d+)?", value):
        return luck.choice(("0", "-1.5", "1e308", "1e-308", "nan", "inf", "1e9", "100.0"))
    return luck.choice((*_ENTITIES, *_WORDS, "LETTERS", "{" * 3000, "\\f|" * 900, "%%d"))


# Templates of Word -------------------------------------------------------------------------------

_MAIN = ("word/document.xml", "word/styles.xml", "[Content_Types].xml")
_ELEMENTS = (
    b"w:sectPr", b"w:body", b"w:pgSz", b"w:style", b"Override", b"Default", b"Relationship",
)  # fmt: skip
_XML = (
    b"<!DOCTYPE x [<!ENTITY a 'aaaaaaaaaa'>]>", b"<w:sectPr/>", b"<w:p>" * 3000, b"</w:body>",
    b"&x;", b"<w:p/>" * 90_000, b"\0", b"{v}",
)  # fmt: skip


@cache
def _template() -> dict[str, bytes]:
    import docx

    stream, file = io.BytesIO(), docx.Document()
    file.add_section()
    file.add_paragraph("planmethod")
    file.save(stream)
    with zipfile.ZipFile(stream) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def template(luck: random.Random) -> bytes:
    """Return a template of Word that something was done to."""
    parts = dict(_template())
    for _ in range(luck.choice((1, 1, 2, 4))):
        spoilt = luck.choice([*parts, *_MAIN])
        if spoilt not in parts:
            continue
        text = parts[spoilt]
        match luck.randrange(8):
            case 0:
                del parts[spoilt]
            case 1:
                parts[spoilt] = luck.choice(
                    (b"", b"<x/>", b"<w:document/>", b" " * (30 * 2**20), text[:99])
                )
            case 2 | 3:
                values = luck.choice((b"x", b"-1", b"", b"99999999999999999999", b"1e9", b"0"))
                parts[spoilt] = re.sub(
                    rb'"\d+"', lambda _, v=values: b'"%s"' % v, text, count=luck.choice((0, 1, 9))
                )
            case 4:
                name = luck.choice(_ELEMENTS)
                parts[spoilt] = re.sub(
                    rb"<%s[ >/].*?(?:/>|</%s>)" % (name, name), b"", text, flags=re.DOTALL
                )
            case 5:
                at = luck.randrange(len(text) + 1)
                parts[spoilt] = text[:at] + luck.choice(_XML) + text[at:]
            case 6:
                parts[spoilt] = _bytes(text, luck)
            case 7:
                parts[
                    luck.choice(("../out.txt", "/x", "word/" + "a" * 300, "word/media/image1.png"))
                ] = text * 9
    return _zipped(parts, luck)


# Others ------------------------------------------------------------------------------------------


@cache
def _others(kind: str) -> list[str]:
    homes = {
        "layout": "planmethod/render/sheets/compositions/[cgho]*.toml",
        "settings": "problems/groups/*.toml",
    }
    found = [path.read_text("utf-8") for path in sorted(ROOT.glob(homes[kind]))]
    return found or ["[tolerance]\nangle = 3\n[marks]\n5 = 0.9\n4 = 0.7\n3 = 0.5\n"]


def other(kind: str, luck: random.Random) -> bytes:
    """Return a file of a department: a layout, settings, or a config file."""
    texts = _others(kind) if kind != "config" else ['[sheet]\npaper = "A3"\n[stamp]\ngroup = "1"\n']
    lines = luck.choice(texts).split("\n")
    for _ in range(luck.randrange(1, 5)):
        at = luck.randrange(len(lines))
        lines[at] = luck.choice(
            (
                re.sub(_NUMBER, luck.choice(_VALUES).replace("\\", "\\\\"), lines[at]),
                f"{lines[at].partition('=')[0]}= {luck.choice(_VALUES)}",
                _letters(lines[at], luck),
                luck.choice(_LINES),
                "",
            )
        )
    return "\n".join(lines).encode("utf-8", "replace")


_SIZES = (
    "K_v", "centres", "stroke", "swing", "lambda", "offset", "pressure", "rod", "rocker", "beta",
    "coupler", "line", "positions", "angles",
)  # fmt: skip


_NUMBERS = (
    "0", "-1", "nan", "inf", "1e308", "1e-300", "3", "0.5", "-2.5", "17", "99999999999", "x", "1/3",
    "",
)  # fmt: skip
_KINDS = ("slider-crank", "crank-rocker", "slotted", "three-angles", "three-positions")
_NEW = ("four-bar", "slider-crank", "2.1.45", "project", "x", "../x")


def words(luck: random.Random) -> list[str]:
    """Return words after the name of the program, for the commands that take numbers."""
    one, two, three, four = (luck.choice(_NUMBERS) for _ in range(4))
    ex3 = str(ROOT / "problems" / "linkages" / "ex3.toml")
    sizes = zip(luck.sample(_SIZES, 4), (one, two, three, four), strict=True)
    return luck.choice(
        (
            ["teeth", "--U", one, "--z-min", two, "--z-max", luck.choice(("30", three))],
            ["teeth", "--scheme", luck.choice(("ring", "pair", "x")), "--U", one],
            [
                "synthesize",
                luck.choice(_KINDS),
                *(word for name, size in sizes for word in (f"--{name}", size)),
            ],
            ["new", luck.choice(_NEW), "new.toml", "--force"],
            ["solve", ex3, "--phi", f"{one}:{two}:{three}"],
            ["solve", ex3, "--ask", luck.choice(_WORDS)],
            ["sheet", ex3, "--stamp", f"title={luck.choice(_WORDS)}", "--ruler", one, "-o", "out"],
        )
    )
