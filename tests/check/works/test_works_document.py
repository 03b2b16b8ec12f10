"""The statements of docs/reference/works-formats.md on files."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from doors import Cell, NotReadError, read_head, read_scaled, read_sense, read_unit, read_works
from worked import ROOT

TEXT = (ROOT / "docs" / "reference" / "works-formats.md").read_text("utf-8")
EXAMPLES = re.findall(r"(?ms)^```(json|toml|csv)[^\n]*\n(.*?)^```$", TEXT)


def part(title: str) -> str:
    return TEXT.partition(f"\n## {title}\n")[2].partition("\n## ")[0]


@pytest.mark.parametrize(("kind", "text"), EXAMPLES)
def test_examples_are_read_to_the_last_cell(kind: str, text: str, tmp_path: Path) -> None:
    path = tmp_path / f"work.{kind}"
    path.write_text(text, "utf-8")
    works = read_works(path)
    assert works
    for work in works:
        assert not work.remarks
        assert work.answers
        assert not any(answer.unreadable for answer in work.answers)
        assert work.scales or kind == "csv"


def test_the_heads_of_the_table_are_known() -> None:
    rows = re.findall(r"(?m)^- ([a-z, ]+): (`.*)$", part("A table with a row for each answer"))
    assert len(rows) == 11
    for field, heads in rows:
        named = [read_head(head).field for head in re.findall(r"`([^`]+)`", heads)]
        assert all(named), (field, heads)
        assert len(set(named)) == {"student": 3, "variant, problem": 2, "quantity": 2}.get(field, 1)


def test_numbers_units_and_senses_are_read_as_documented() -> None:
    told = part("Numbers, units, senses")
    for written, said in re.findall(r"(?m)^- (`.*`): ([−\d.]+)$", told):
        for text in re.findall("`([^`]+)`", written):
            value = read_scaled(Cell(text), Cell())[0]
            assert value == float(said.replace("−", "-")), text
    (doubtful,) = re.findall(r"(?m)^- (`.*`): not read", told)
    for text in re.findall("`([^`]+)`", doubtful):
        with pytest.raises(NotReadError):
            read_scaled(Cell(text), Cell())
    (nothing,) = re.findall(r"(?m)^- (`.*): no answer", told)
    assert all(Cell(text).is_blank for text in re.findall("`([^`]+)`", nothing))
    units = told.partition("put together of")[2].partition("are revolutions")[0]
    assert all(read_unit(text) for text in re.findall(r"`(\w[^`]*|°)`", units))
    senses = told.partition("Senses are")[2].partition("; a sense")[0]
    assert all(read_sense(text) for text in re.findall("`([^`]+)`", senses))
