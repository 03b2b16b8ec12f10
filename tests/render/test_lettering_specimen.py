"""The specimen of the lettering: every letter on its grid, and its stated measures."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from doors import (
    ALPHABETS,
    GRID,
    LETTERING_HEIGHT as HEIGHT,
    STYLES,
    Stroke,
    Text,
    get_language,
    in_use,
    lettering,
    lettering_measured as measured,
    lettering_sheet,
    lint,
    using,
)

RU = get_language("ru")


@pytest.mark.parametrize("style", STYLES)
def test_specimen_shows_every_letter_and_is_clean(style: str) -> None:
    with using(lettering(style)) as used:
        drawing = lettering_sheet({}, RU)
        assert drawing.lettering is used
        assert used.missing("".join(ALPHABETS)) == set()
        shown = [i for i in drawing.items if isinstance(i, Text) and i.height == HEIGHT]
        assert [run.text for run in shown] == list("".join(ALPHABETS))
        inner = (20.0, 5.0, drawing.width - 5.0, drawing.height - 5.0)
        assert [finding.message for finding in lint(drawing.items, inner)] == []


def test_letters_are_on_their_grid() -> None:
    drawing = lettering_sheet({}, RU)
    first = next(i for i in drawing.items if isinstance(i, Text) and i.height == HEIGHT)
    lines = [i for i in drawing.items if isinstance(i, Stroke) and i.tag == GRID]
    level = [line for line in lines if line.points[0].imag == line.points[1].imag]
    assert min(abs(line.points[0].imag - first.at.imag) for line in level) < 1e-9
    steps = sorted({round(line.points[0].imag - first.at.imag, 6) for line in level[:14]})
    assert steps[1] - steps[0] == pytest.approx(HEIGHT * in_use().line)


@pytest.mark.parametrize("style", STYLES)
def test_measures_are_those_of_the_standard(style: str) -> None:
    """Rounding of the outlines may lose half a font unit at either side."""
    for measure in measured(lettering(style)):
        assert measure.actual == pytest.approx(measure.nominal, abs=2e-3), measure


def test_the_document_has_the_measured_table() -> None:
    text = (Path(__file__).parents[2] / "docs" / "reference" / "specimens.md").read_text(
        encoding="utf-8"
    )
    rows = re.findall(r"^\| [a-z ]+ ([habced]) \| (.*) \|$", text, flags=re.M)
    assert [symbol for symbol, _ in rows] == list("hcabed")
    for k, (_, cells) in enumerate(rows):
        a, b = measured(lettering("A"))[k], measured(lettering("B"))[k]
        assert cells == (
            f"{round(a.nominal * 14)}/14 | {a.actual * 14:.2f}/14 | "
            f"{round(b.nominal * 10)}/10 | {b.actual * 10:.2f}/10"
        )
