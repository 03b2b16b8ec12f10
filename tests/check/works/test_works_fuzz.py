"""Any file of a stranger is read, or rejected with `SubmissionError`."""

from __future__ import annotations

import io
import json
import random
import zipfile
from pathlib import Path

import pytest
from cases import some
from doors import SubmissionsSubmissionError as SubmissionError, read_works
from test_works_csv import LONG, WIDE
from test_works_student import GOOD
from test_works_xlsx import ROWS, saved

TOML = b'student = 7\nscales.mu_v = 0.05\n[[answers]]\nwhat = "v B3"\nvalue = 2.275\n'
BOOK = saved(ROWS, lambda sheet: sheet.merge_cells("A4:A6"))
WORDS = [
    *("v B3", "ω₃", "1,2·10^3", "−", "нет", "0", "1e999", "=1+1", "=HYPERLINK(1)", "nan", "м/с²"),
    *("↺", "\0", '"', ";", ",", "\t", "\n", "\r", "[", "{", "}", "]", "999999999", "1:2", "((м"),
    *(
        "mu_v",
        "student",
        "what",
        "value",
        "mm",
        "№",
        "точка",
        "\ufeff",
        "\ud800",
        "🙂",
        "<v>",
        "</c>",
    ),
]


def spoiled(data: bytes, dice: random.Random) -> bytes:
    """Return a file with a few of its bytes cut, doubled, replaced or put in."""
    for _ in range(dice.randint(1, 4)):
        at, length = dice.randrange(len(data) + 1), dice.choice((0, 1, 1, 2, 8, 40))
        word = dice.choice(WORDS).encode("utf-8", "surrogatepass")
        new = dice.choice((b"", word, dice.randbytes(length), data[at : at + length] * 2))
        data = data[:at] + new + data[at + dice.choice((0, length)) :]
    return data


def spoiled_book(dice: random.Random) -> bytes:
    """Return a workbook one part of which is spoiled, inside a sound archive."""
    stream = io.BytesIO()
    with zipfile.ZipFile(io.BytesIO(BOOK)) as old, zipfile.ZipFile(stream, "w") as new:
        names = old.namelist()
        chosen = dice.choice([*names, "xl/worksheets/sheet1.xml", "xl/worksheets/sheet1.xml"])
        for name in names:
            part = old.read(name)
            new.writestr(name, spoiled(part, dice) if name == chosen else part)
    return stream.getvalue()


def random_text(dice: random.Random) -> bytes:
    words = (dice.choice(WORDS) for _ in range(dice.randrange(60)))
    return "".join(words).encode("utf-8", "surrogatepass")


def malformed(dice: random.Random) -> tuple[str, bytes]:
    """Return a file that something is wrong with, and its extension."""
    kind = dice.choice(("json", "toml", "csv", "wide", "xlsx", "part", "text", "bytes"))
    if kind == "part":
        return "xlsx", spoiled_book(dice)
    if kind == "text":
        return dice.choice(("json", "toml", "csv", "txt", "xlsx")), random_text(dice)
    if kind == "bytes":
        return dice.choice(("json", "csv", "xlsx")), dice.randbytes(dice.randrange(300))
    sound = {
        "json": json.dumps(GOOD, ensure_ascii=False).encode(),
        "toml": TOML,
        "csv": LONG.encode(dice.choice(("utf-8-sig", "cp1251", "utf-16"))),
        "wide": WIDE.encode(),
        "xlsx": BOOK,
    }[kind]
    return "csv" if kind == "wide" else kind, spoiled(sound, dice)


@pytest.mark.parametrize("seed", range(4))
def test_malformed_files(tmp_path: Path, seed: int) -> None:
    dice = random.Random(seed)
    read = 0
    for number in range(some(5000, few=375)):
        kind, data = malformed(dice)
        path = tmp_path / f"work.{kind}"
        path.write_bytes(data)
        try:
            works = read_works(path)
        except SubmissionError as error:
            assert str(path) in str(error), number
            continue
        read += 1
        for work in works:
            for answer in (*work.answers, *work.remarks):
                assert answer.value is None or abs(answer.value) < 1e40
                assert bool(answer.unreadable) == (answer.reason is not None)
    assert read > 50
    assert [path.stem for path in tmp_path.iterdir()] == ["work"] * len(list(tmp_path.iterdir()))
