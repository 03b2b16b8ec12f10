"""The printed key."""

from __future__ import annotations

import io
import re
import shutil
import subprocess
from functools import cache
from pathlib import Path

import ex3_work
import openpyxl
import pytest
from doors import (
    DEFAULT,
    LINKAGES,
    TERMINAL_WIDTH as WIDTH,
    WORDING_LANGUAGES as LANGUAGES,
    Key,
    MessageTable,
    get_language,
    key_of_problem,
    key_pdf,
    key_xlsx,
    kinds_loads as loads,
)
from msgspec.structs import replace
from texts import key_text
from worked import ROOT, problem_of

RU = get_language("ru")


@cache
def key(variant: str | None = None) -> Key:
    problem = problem_of("linkages/ex3")
    hidden = {"N1": ("B3",), "S1": ("mu_a",)}
    return Key(problem, variant, ex3_work.entries(), ex3_work.SCALES, hidden)


def group(count: int) -> list[Key]:
    return [key(f"{number}") for number in range(1, count + 1)]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_the_key_of_one_variant_has_a_row_for_each_answer(lang: str) -> None:
    say: MessageTable = get_language(lang).check["key"]
    text = key_text([key()], get_language(lang))
    for entry in ex3_work.entries():
        assert any(entry.symbol[0] in line for line in text.splitlines())
    row = next(line for line in text.splitlines() if line.startswith("v_B3"))
    assert "±" in row and "←" in row and ("44,9" in row or "44.9" in row) and "pb₃" in row
    assert text.count(say.unseen) == 2, "the row of ε₄, and the note"
    assert "N1: " in text and "μ_a" in text.split(say.hidden)[1]
    assert max(map(len, text.splitlines())) <= WIDTH


def test_the_key_of_a_group_has_a_row_for_each_variant_and_keeps_the_width() -> None:
    text = key_text(group(12), RU)
    assert max(map(len, text.splitlines())) <= WIDTH
    assert sum(line.lstrip().startswith("12 ") for line in text.splitlines()) >= 2
    assert "* — чертёж этого не показывает" in text


def test_positions_have_rows_of_their_own() -> None:
    entries = ex3_work.entries()
    two = replace(key(), entries=(*entries, *(replace(e, position=1) for e in entries)))
    text = key_text([two], RU)
    assert "положение 0" in text and "положение 1" in text


def test_variants_with_other_scales_are_listed_separately() -> None:
    other = replace(key("2"), scales={**ex3_work.SCALES, "mu_v": 0.1})
    line = key_text([key("1"), other, key("3")], RU)
    assert "1, 3: μ_l" in line and "2: μ_l = 0,002 м/мм; μ_v = 0,1" in " ".join(line.split())


def test_small_numbers_are_no_zeros() -> None:
    """A crank that creeps has speeds, scales and tolerances below the rounding of others."""
    text = (ROOT / "problems/linkages/ex1.toml").read_text("utf-8")
    creeping = loads(re.sub(r"(?m)^omega = \S+", "omega = 1e-12", text), name="creeping")
    told = key_text([key_of_problem(LINKAGES, creeping, DEFAULT)], get_language("en"))
    assert not re.search(r"μ_\w = 0 |± 0 +\S*/s", told)
    (row,) = (line for line in told.splitlines() if line.startswith("v_B "))
    assert re.search(r"\d·10⁻\S+ ± \d\S*·10⁻", row), row


def test_a_mistake_that_only_some_variants_hide_names_them() -> None:
    seeing = replace(key("2"), hidden={"N1": ("B3",)})
    text = key_text([key("1"), seeing], RU)
    shown = next(line for line in text.splitlines() if "S1:" in line)
    assert "Вариант 1" in shown and "Вариант" not in next(
        line for line in text.splitlines() if "N1:" in line
    )


def test_the_workbook_has_numbers_for_numbers() -> None:
    book = openpyxl.load_workbook(io.BytesIO(key_xlsx(group(2), RU)))
    sheet, hidden = book.worksheets
    assert sheet.max_row == 1 + 2 * len(ex3_work.entries())
    assert sheet["D2"].value == pytest.approx(ex3_work.entries()[0].exact)
    assert sheet["A2"].value == "1" and hidden.max_row == 3
    assert key_xlsx(group(2), RU) == key_xlsx(group(2), RU)


@pytest.mark.skipif(not shutil.which("pdfinfo"), reason="poppler is absent")
@pytest.mark.parametrize("count", [1, 10])
def test_the_key_of_a_group_is_one_page(count: int, tmp_path: Path) -> None:
    data = key_pdf(group(count), RU)
    assert data == key_pdf(group(count), RU) and b"Helvetica" not in data
    (tmp_path / "key.pdf").write_bytes(data)
    done = subprocess.run(["pdfinfo", str(tmp_path / "key.pdf")], capture_output=True, timeout=60)
    assert b"Pages:           1\n" in done.stdout
