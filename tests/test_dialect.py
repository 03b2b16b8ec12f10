"""Names and sentences that a stranger cannot guess: their number does not grow."""

from __future__ import annotations

import tomllib

import pytest

from scripts import dialect

CEILINGS = tomllib.loads(dialect.CEILINGS.read_text(encoding="utf-8"))["dialect"]


@pytest.mark.parametrize("kind", dialect.KINDS)
def test_the_number_of_unclear_names_and_sentences_does_not_grow(kind: str) -> None:
    found, ceiling = dialect.KINDS[kind](), CEILINGS[kind]
    assert len(found) <= ceiling, "\n".join(found)
    assert len(found) > ceiling - 10, f"[dialect] {kind} in scripts/budget.toml: {len(found)}"


def test_a_name_without_a_word_of_the_field_is_unclear() -> None:
    assert dialect.split_words("_whatIsTold") == ["what", "is", "told"]
    assert {"told", "laid"} <= dialect.WORDS and "velocity" not in dialect.WORDS
