from __future__ import annotations

import pytest
from doors import (
    Sense,
    UnitsNumber as Number,
    WrittenAnswer,
    ratio,
    read_number,
    read_sense,
    read_unit,
)

NUMBERS = [
    ("2.275", 2.275, 0.001, ""),
    ("2,270", 2.27, 0.001, ""),
    ("0", 0.0, 1.0, ""),
    ("12.", 12.0, 1.0, ""),
    (",5", 0.5, 0.1, ""),
    ("−3,5", -3.5, 0.1, ""),
    ("–3,5", -3.5, 0.1, ""),
    ("+ 3", 3.0, 1.0, ""),
    ("≈ 3,4", 3.4, 0.1, ""),
    ("~3", 3.0, 1.0, ""),
    ("1,2·10^3", 1200.0, 100.0, ""),
    ("1,2*10^3", 1200.0, 100.0, ""),
    ("1.2e3", 1200.0, 100.0, ""),
    ("1,2E+03", 1200.0, 100.0, ""),
    ("1,2·10³", 1200.0, 100.0, ""),
    ("1,20 × 10^(-3)", 0.0012, 1e-5, ""),
    ("1,2·10⁻³ м", 0.0012, 1e-4, "м"),
    ("5х10-3", 0.005, 0.001, ""),
    ("1 234,5", 1234.5, 0.1, ""),
    ("1\u00a0234,5", 1234.5, 0.1, ""),
    ("1\u202f234", 1234.0, 1.0, ""),
    ("1,234", 1.234, 0.001, ""),
    ("1.234,5", 1234.5, 0.1, ""),
    ("1,234.5", 1234.5, 0.1, ""),
    ("1.234.567", 1234567.0, 1.0, ""),
    ("3,4 м/с", 3.4, 0.1, "м/с"),
    ("15 1/с", 15.0, 1.0, "1/с"),
    ("3,4↺", 3.4, 0.1, "↺"),
]


@pytest.mark.parametrize(("text", "value", "step", "rest"), NUMBERS)
def test_a_number_is_read_as_it_is_written(text: str, value: float, step: float, rest: str) -> None:
    number = read_number(text)
    assert number is not None
    assert (number.value, number.step) == pytest.approx((value, step), rel=1e-12)
    assert number.rest == rest


@pytest.mark.parametrize(
    "text",
    [
        "",
        "-",
        "abc",
        "3 4",
        "1 23",
        "1.2.3",
        "1,23,456",
        "1.234,5,6",
        "1.234,567.800",
        "1234.567,8",
        "1e99",
        "9" * 60,
        "x3",
        ".",
    ],
)
def test_a_text_that_is_surely_not_a_number_is_rejected(text: str) -> None:
    assert read_number(text) is None


def test_a_power_that_lost_its_level_is_not_taken_for_another_number() -> None:
    assert read_number("1,2·103") == Number(1.2, 0.1, "·103")


UNITS = [
    ("м/с", 1.0, "m/s"),
    ("m/c", 1.0, "m/s"),
    ("мм/с", 1e-3, "m/s"),
    ("см/сек", 1e-2, "m/s"),
    ("м·с⁻¹", 1.0, "m/s"),
    ("м/с²", 1.0, "m/s²"),
    ("м/c2", 1.0, "m/s²"),
    ("m/s^2", 1.0, "m/s²"),
    ("м/с**2", 1.0, "m/s²"),
    ("рад/с", 1.0, "1/s"),
    ("c^-1", 1.0, "1/s"),
    ("с⁻¹", 1.0, "1/s"),
    ("об/мин", 0.10471975511965977, "1/s"),
    ("об./мин.", 0.10471975511965977, "1/s"),
    ("rpm", 0.10471975511965977, "1/s"),
    ("мин⁻¹", 0.10471975511965977, "1/s"),
    ("град/с", 0.017453292519943295, "1/s"),
    ("рад/с^2", 1.0, "1/s²"),
    ("рад", 57.29577951308232, "deg"),
    ("°", 1.0, "deg"),
    ("град.", 1.0, "deg"),
    ("кН", 1e3, "N"),
    ("H", 1.0, "N"),
    ("Н·мм", 1e-3, "N·m"),
    ("Н.м", 1.0, "N·m"),
    ("Нм", 1.0, "N·m"),
    ("см", 10.0, "mm"),
]


@pytest.mark.parametrize(("text", "factor", "unit"), UNITS)
def test_a_unit_is_read_in_any_letters(text: str, factor: float, unit: str) -> None:
    found, wanted = read_unit(text), read_unit(unit)
    assert found is not None and wanted is not None
    assert found.dimension == wanted.dimension
    assert found.factor / wanted.factor == pytest.approx(factor, rel=1e-12)


@pytest.mark.parametrize(
    "text", ["", "1", "x", "м/", "/с", "м с", "()", "((м", "м)", "кв/с", "м/с" * 20]
)
def test_a_text_that_is_not_a_unit_is_rejected(text: str) -> None:
    assert read_unit(text) is None


def test_angles_are_in_degrees_and_turning_is_in_radians() -> None:
    for text, factor in (("рад", 57.29577951308232), ("°", 1.0), ("рад/с", 1.0)):
        unit = read_unit(text)
        assert unit is not None
        assert unit.factor == pytest.approx(factor, rel=1e-12)


@pytest.mark.parametrize("text", ["s^-2", "1/s^2", "rad/s2", "с-2", "1/с²", "s⁻²"])
def test_a_negative_power_is_a_quotient(text: str) -> None:
    assert read_unit(text) == read_unit("1/s²")


def test_a_value_goes_into_the_unit_of_the_key_or_is_of_another_quantity() -> None:
    assert ratio(WrittenAnswer(value=0.072, unit="мм"), "mm") == pytest.approx(1000.0)
    assert ratio(WrittenAnswer(value=3.2), "mm") == 1.0
    assert ratio(WrittenAnswer(value=3.2, unit="мм/с"), "m/s") == 1.0
    assert ratio(WrittenAnswer(value=3.2, unit="м/с"), "m/s²") is None


@pytest.mark.parametrize(
    ("text", "sense"),
    [
        ("↺", Sense.CCW),
        ("против часовой стрелки", Sense.CCW),
        ("Против ч.с.", Sense.CCW),
        ("↺ против часовой стрелки", Sense.CCW),
        ("по часовой", Sense.CW),
        ("(cw)", Sense.CW),
        ("Вверх", Sense.UP),
        ("↓", Sense.DOWN),
        ("← влево", Sense.LEFT),
        ("right", Sense.RIGHT),
        ("+", None),
        ("-", None),
        ("туда", None),
    ],
)
def test_a_sense_is_read_in_words_and_arrows(text: str, sense: Sense | None) -> None:
    assert read_sense(text) is sense
