from __future__ import annotations

import csv
import io
import math

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    TERMINAL_WIDTH as WIDTH,
    Solution,
    columns_text,
    csv_rows,
    pad,
    plain_text,
    table,
    trimmed,
    width,
)
from protocols import LANGUAGES, assert_readable, drawn, worked
from texts import result_tables
from worked import SIX, problem_of


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SIX)
def test_tables_of_one_position_fit_the_terminal(name: str, lang: str) -> None:
    assert_readable(result_tables(worked(name), lang))


@each("lang", LANGUAGES)
@each("seed", sampled(range(some(40, few=15)), 3))
def test_tables_of_any_mechanism_fit_the_terminal(seed: int, lang: str) -> None:
    assert_readable(result_tables(drawn(seed), lang))


def test_the_tables_have_values_senses_and_readings() -> None:
    lines = result_tables(worked("linkages/ex3"), "ru").splitlines()
    rows = [line.split() for line in lines]
    assert "Формула строения: I(0,1) → II(2,3) → II(4,5)" in lines
    assert "Масштабы: μ_l = 0,002 м/мм; μ_v = 0,05 (м/с)/мм; μ_a = 1 (м/с²)/мм" in lines
    assert ["E", "0,2471", "0", "3,916", "3,925", "87,07", "87,00"] in rows
    turning = "4 −30,06 −9,068 −9,028 по часовой стрелке 84,50 86,11 против часовой стрелки"
    assert turning.split() in rows
    assert ["B:", "3", "по", "2", "2,282", "2,275", "70,63", "70,60", "77,45", "77,50"] in rows
    assert ["v_B3B2", "b₁b₃", "45,64", "45,5", "2,275"] in rows


def test_english_tables_are_english() -> None:
    text = result_tables(worked("linkages/ex3"), "en")
    assert "3.916" in text and "counter-clockwise" in text and "μ_v = 0.05 (m/s)/mm" in text


def many(count: int) -> Solution:
    positions = [360.0 * k / count for k in range(count)]
    return Solution(worked("linkages/ex3").problem, positions=positions)


@pytest.mark.parametrize("lang", LANGUAGES)
def test_many_positions_are_rows(lang: str) -> None:
    text = result_tables(many(12), lang)
    assert_readable(text)
    rows = [line.split() for line in text.splitlines()]
    assert sum(row[:2] == ["0", "0"] for row in rows) >= 5
    assert sum(row[:2] == ["11", "330"] for row in rows) >= 5


def test_few_positions_have_tables_of_their_own() -> None:
    text = result_tables(many(3), "ru")
    assert [f"Положение {k} (всего 3)" in text for k in (0, 1, 2)] == [True] * 3


def test_csv_round_trips_to_the_last_bit() -> None:
    solution = many(5)
    header, rows = csv_rows(solution)
    text = io.StringIO()
    csv.writer(text).writerows([header, *rows])
    again = list(csv.DictReader(io.StringIO(text.getvalue())))
    assert len(again) == 5
    for i, row in enumerate(again):
        assert row["position"] == str(i)
        assert float(row["phi_deg"]) == solution.positions[i]
        assert float(row["margin"]) == solution.margin[i]
        e = solution.points["E"]
        assert complex(float(row["E.x"]), float(row["E.y"])) == complex(e.place[i])
        assert float(row["E.v"]) == abs(complex(e.velocity[i]))
        assert float(row["E.ax"]) == complex(e.acceleration[i]).real + 0.0
        assert float(row["3.omega"]) == solution.links["3"].omega[i]
        assert float(row["velocity.b-b3.exact"]) > 0
        assert float(row["velocity.b-b3.read"]) % 0.5 == 0


@each("seed", sampled(range(some(30, few=15)), 3))
def test_csv_columns_are_unique_and_finite(seed: int) -> None:
    header, rows = csv_rows(drawn(seed))
    assert len(set(header)) == len(header)
    assert all(len(row) == len(header) for row in rows)
    assert np.isfinite(np.asarray(rows, dtype=float)).all()
    assert header[1] == ("phi_deg" if drawn(seed).problem.drive.is_crank else "s")


def test_rich_text_becomes_plain() -> None:
    assert plain_text("ω_{2}^{2}·l_{BC}") == "ω₂²·l_BC"
    assert plain_text("a^{n}_{CB}, a^{τ}_{CB}, b′_{3}") == "aⁿ_CB, a^τ_CB, b′₃"
    assert plain_text("с^{-1}") == "с⁻¹"


def test_wide_and_combining_characters_are_counted() -> None:
    assert width("ω̇ж") == 2
    assert width("表") == 2
    assert pad("表", 4) == "表  "
    lines = table(["a", "b"], [["表", "1"], ["xyz", "22"]])
    assert {width(line) for line in lines} == {7}


def test_wide_tables_are_cut_and_keep_their_leading_columns() -> None:
    columns = [["№", "1"], *([f"column{k}", "0.123456789"] for k in range(20))]
    lines = columns_text(columns, 1)
    assert all(width(line) <= WIDTH for line in lines)
    assert sum(line.startswith("№") for line in lines) > 1


@pytest.mark.parametrize(
    ("value", "told"),
    [
        (89.999999, "89.999999"),
        (0.1 + 0.2, "0.3"),
        (-45.0, "-45"),
        (360 / 7, "51.43"),
        (89.99999912345, "90.00"),  # not 90, and as near to it as four digits say
        (-0.06903979086003997, "-0.06904"),  # ten digits within its rounding
        (218.918918918919, "218.92"),  # two decimals at least
        (math.nan, "—"),
    ],
)
def test_a_given_number_has_the_digits_that_it_was_given_with(value: float, told: str) -> None:
    assert trimmed(value) == told


def test_a_position_is_printed_as_requested() -> None:
    solution = Solution(problem_of("linkages/ex1"), positions=[89.999999])
    assert "φ₁ = 89,999999°" in result_tables(solution)
