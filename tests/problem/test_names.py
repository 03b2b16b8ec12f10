from __future__ import annotations

import pytest
from doors import (
    LOOKALIKES,
    angle_lines,
    describe_lookalikes,
    fold,
    is_label,
    is_point_name,
    looks_latin,
    nearest_name,
    segment,
    split_pair,
)


@pytest.mark.parametrize(
    ("text", "pair"),
    [
        ("AB", ("A", "B")),
        ("O3A", ("O3", "A")),
        ("AS2", ("A", "S2")),
        ("CS3", ("C", "S3")),
        ("O1O3", ("O1", "O3")),
        ("A'B", ("A'", "B")),
        ("βγ", ("β", "γ")),
        ("A", None),
        ("ABC", None),
        ("3A", None),
        ("A-B", None),
        ("", None),
    ],
)
def test_pairs_split_in_one_way(text: str, pair: tuple[str, str] | None) -> None:
    assert split_pair(text) == pair


@pytest.mark.parametrize("name", ["A", "S2", "O3", "B'", "B1''", "Γ", "b"])
def test_point_names(name: str) -> None:
    assert is_point_name(name)


@pytest.mark.parametrize("name", ["", "3", "AB", "А", "Ш", "A-", "A12345", "A\n", "A 1"])
def test_not_point_names(name: str) -> None:
    assert not is_point_name(name)


@pytest.mark.parametrize("name", ["1", "2a", "шатун", "x-x", "вариант 3", "7'"])
def test_labels(name: str) -> None:
    assert is_label(name)


@pytest.mark.parametrize("name", ["", "a/b", "-x", "x-", "a" * 25, "a\tb", "<b>", "a__b"])
def test_not_labels(name: str) -> None:
    assert not is_label(name)


def test_every_capital_lookalike_of_the_russian_alphabet_is_known() -> None:
    assert fold("АВЕКМНОРСТУХ") == "ABEKMHOPCTYX"
    assert fold("аекорсух") == "aekopcyx"
    assert all(value.isascii() for value in LOOKALIKES.values())


def test_words_are_not_taken_for_latin() -> None:
    assert looks_latin("2а")
    assert looks_latin("у-у")
    assert not looks_latin("шатун")
    assert not looks_latin("x-x")


def test_message_names_each_letter() -> None:
    assert describe_lookalikes("А") == (
        "'А' is the Cyrillic letter А (U+0410), expected the Latin letter 'A'"
    )
    assert describe_lookalikes("АС") == (
        "'АС' has the Cyrillic letter А (U+0410) and the Cyrillic letter С (U+0421), "
        "expected the Latin letters 'A', 'C'"
    )


def test_nearest_name_ignores_case_and_layout() -> None:
    assert nearest_name("Omega", ["phi", "omega"]) == "omega"
    assert nearest_name("оmega", ["phi", "omega"]) == "omega"
    assert nearest_name("zzz", ["phi", "omega"]) is None


def test_paths_are_safe_to_print() -> None:
    assert segment("x-x") == "x-x"
    assert segment("a b") == '"a b"'
    assert segment("") == '""'
    assert segment('a"\n') == '"a\\u0022\\u000a"'
    assert len(segment("a" * 1000)) < 70


@pytest.mark.parametrize("letters", ["AABC", "ABCC", "AB", "ABCDE"])
def test_an_angle_has_two_lines_of_two_points_each(letters: str) -> None:
    assert angle_lines(letters) is None
