"""Names and sentences that a stranger cannot guess: their number does not grow."""

from __future__ import annotations

import tomllib

import pytest

from scripts import dialect

CEILINGS = tomllib.loads(dialect.CEILINGS.read_text(encoding="utf-8"))["dialect"]


@pytest.mark.parametrize(
    ("kind", "listed"),
    [("names", dialect.list_unclear_names), ("sentences", dialect.list_unclear_sentences)],
)
def test_the_number_of_unclear_names_and_sentences_does_not_grow(kind, listed) -> None:  # type: ignore[no-untyped-def]
    found, ceiling = listed(), CEILINGS[kind]
    assert len(found) <= ceiling, "\n".join(found)
    assert len(found) > ceiling - 10, f"[dialect] {kind} in scripts/budget.toml: {len(found)}"


def test_a_name_without_a_word_of_the_field_is_unclear() -> None:
    assert dialect.split_words("_whatIsTold") == ["what", "is", "told"]
    assert {"told", "laid"} <= dialect.WORDS and "velocity" not in dialect.WORDS
