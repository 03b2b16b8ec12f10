from __future__ import annotations

import re
from dataclasses import fields
from pathlib import Path
from string import Formatter

import pytest
from cases import each

import planmethod
from planmethod.errors import ExitCode
from planmethod.note.wording import (
    CATALOGUES,
    FORCE_CATALOGUES,
    ForceWording,
    UnknownLanguageError,
    Wording,
    force_wording,
    wording,
)

TEMPLATES: list[tuple[tuple[object, ...], str]] = []
TEMPLATES += [(CATALOGUES, field.name) for field in fields(Wording)]
TEMPLATES += [(FORCE_CATALOGUES, field.name) for field in fields(ForceWording)]


def places(text: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(text) if name}


@each("catalogues, name", TEMPLATES)
def test_catalogues_fill_the_same_places(catalogues: tuple[object, ...], name: str) -> None:
    one, *others = (getattr(catalogue, name) for catalogue in catalogues)
    for other in others:
        assert type(other) is type(one)
        if isinstance(one, str):
            assert places(other) == places(one)
        elif isinstance(one, tuple):
            assert [places(text) for text in other] == [places(text) for text in one]
        else:
            assert set(other) == set(one)


def test_russian_is_russian_and_english_is_english() -> None:
    for catalogue in (wording("en"), force_wording(wording("en"))):
        for field in fields(catalogue):
            text = getattr(catalogue, field.name)
            assert not re.search("[а-яё]", str(text), re.IGNORECASE), field.name


def test_every_sentence_of_the_forces_is_said() -> None:
    folder = Path(planmethod.__file__).parent / "note"
    source = "".join(path.read_text(encoding="utf-8") for path in folder.rglob("*.py"))
    for field in fields(ForceWording):
        name = field.name
        other = name == "lang" or name.startswith("side_")  # these are put together
        assert other or re.search(rf"(said\.|\"){name}\b", source), name


def test_an_unknown_language_is_an_error_of_usage() -> None:
    with pytest.raises(UnknownLanguageError, match=r"'de'.*Choose one of: ru, en") as error:
        wording("de")
    assert error.value.exit_code is ExitCode.USAGE
