from __future__ import annotations

import re
from dataclasses import fields
from string import Formatter

import pytest

from planmethod.errors import ExitCode
from planmethod.note.wording import CATALOGUES, UnknownLanguageError, Wording, wording

TEMPLATES = [field.name for field in fields(Wording)]


def places(text: str) -> set[str]:
    return {name for _, name, _, _ in Formatter().parse(text) if name}


@pytest.mark.parametrize("name", TEMPLATES)
def test_catalogues_fill_the_same_places(name: str) -> None:
    one, *others = (getattr(catalogue, name) for catalogue in CATALOGUES)
    for other in others:
        assert type(other) is type(one)
        if isinstance(one, str):
            assert places(other) == places(one)
        elif isinstance(one, tuple):
            assert [places(text) for text in other] == [places(text) for text in one]
        else:
            assert set(other) == set(one)


def test_russian_is_russian_and_english_is_english() -> None:
    for field in TEMPLATES:
        text = getattr(wording("en"), field)
        assert not re.search("[а-яё]", str(text), re.IGNORECASE), field


def test_an_unknown_language_is_an_error_of_usage() -> None:
    with pytest.raises(UnknownLanguageError, match=r"'de'.*Choose one of: ru, en") as error:
        wording("de")
    assert error.value.exit_code is ExitCode.USAGE
