"""Drafting errors in the terminal tables: columns, marks, causes."""

from __future__ import annotations

import re
from functools import cache

import numpy as np
import pytest
from cases import each, sampled, some
from doors import (
    DRAFTING_PROFILES as PROFILES,
    MOTION,
    RATES,
    Drafting,
    ErrorCauses,
    Names,
    PlanKind,
    Solution,
    drafting_of,
    plain_text,
    reported_links,
    reported_points,
    rounded_to,
    sigma_text,
    wording,
)
from protocols import LANGUAGES, assert_readable, drawn, flat, worked
from texts import result_tables
from worked import SIX, problem_of

from planmethod.note.tables.errors import relative_series

NEAR_DEAD = [230.0, 240.0, 250.0]
"""Positions of the six-link where its slider cannot be found by first order."""


def rows_of(text: str) -> list[list[str]]:
    return [line.split() for line in text.splitlines()]


def spoken(sigma: float, mark: bool, lang: str) -> str:
    text = sigma_text(sigma) + ("*" if mark else "")
    return text.replace(".", ",") if lang == "ru" else text


@cache
def around(name: str, count: int) -> Solution:
    return Solution(problem_of(name), positions=[360.0 * k / count for k in range(count)])


@cache
def near_dead() -> Solution:
    return Solution(problem_of("levers/six-link"), positions=NEAR_DEAD)


# Digits -------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("sigma", "text"),
    [
        (0.0, "0"),
        (0.0881, "0.09"),
        (0.1416, "0.14"),
        (0.299, "0.3"),
        (0.294, "0.29"),
        (0.3, "0.3"),
        (0.96, "1.0"),
        (1.0, "1.0"),
        (2.5, "2.5"),
        (9.6, "10"),
        (17.73, "18"),
        (34.0, "30"),
        (263.0, "260"),
        (1234.0, "1200"),
        (0.00012, "0.00012"),
        (float("nan"), "—"),
    ],
)
def test_an_error_has_one_or_two_digits(sigma: float, text: str) -> None:
    assert sigma_text(sigma) == text


@each("sigma", list(np.geomspace(1e-5, 9e5, 200)))
def test_an_error_is_written_to_a_sixth_of_itself(sigma: float) -> None:
    shown = float(sigma_text(sigma))
    assert shown == pytest.approx(sigma, rel=0.17)
    assert len(sigma_text(sigma).replace(".", "").strip("0")) <= 2


@pytest.mark.parametrize(
    ("value", "sigma", "text"),
    [
        (3.9251, 0.0881, "3.93"),
        (1234.5, 56.0, "1230"),
        (-0.004, 0.3, "0.0"),
        (2.0, 0.0, "2.000"),
        (2.0, float("nan"), "2.000"),
        (0.56, 1.8, "0.6"),
    ],
)
def test_a_value_is_rounded_to_the_place_of_its_error(
    value: float, sigma: float, text: str
) -> None:
    assert rounded_to(value, sigma) == text


# Tables of a position -----------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SIX)
def test_tables_fit_the_terminal(name: str, lang: str) -> None:
    assert_readable(result_tables(worked(name), lang, sigma=True))


@each("lang", LANGUAGES)
@each("seed", sampled(range(some(40, few=5)), 3))
def test_tables_of_any_mechanism_fit_the_terminal(seed: int, lang: str) -> None:
    assert_readable(result_tables(drawn(seed), lang, sigma=True))


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SIX)
def test_every_reading_has_its_error_beside_it(name: str, lang: str) -> None:
    solution = worked(name)
    text = result_tables(solution, lang, sigma=True)
    rows, plain = rows_of(text), rows_of(result_tables(solution, lang))
    spreads = drafting_of(solution).spreads

    def cell(label: str) -> str:
        spread = spreads.get(label)
        if spread is None:
            return "0"
        return spoken(float(spread.sigma[0]), bool(spread.drawn[0]), lang)

    points = [row for row in plain if len(row) == 7 and row[0] in solution.points]
    points = [row for row in points if "←" not in row[1]]  # not the reactions
    assert points
    for row in points:
        wide = [*row[:5], cell(f"v_{row[0]}"), *row[5:7], cell(f"a_{row[0]}")]
        assert wide in rows
    for link in solution.links:
        row = next(row for row in plain if row[:1] == [link] and len(row) > 4)
        found = [r for r in rows if r[:1] == [link]]
        omega = [link, *row[1:4], cell(f"omega_{link}")]
        assert any(r[:5] == omega for r in found)
        assert any(r[3:4] == [cell(f"epsilon_{link}")] for r in found)
    for kind in MOTION:
        for segment in solution.segments(kind):
            exact = f"{float(segment.exact[0]):.2f}".replace(".", "," if lang == "ru" else ".")
            error = cell(f"{kind.value}.{segment.name}")
            at = 1 if kind is PlanKind.POSITION else 2
            assert any(row[at : at + 1] == [exact] and row[at + 2] == error for row in rows)


def test_the_errors_of_a_worked_examples_readings_are_printed() -> None:
    solution = worked("linkages/ex3")
    rows = rows_of(result_tables(solution, "ru", sigma=True))
    for header in (
        "точка x, м y, м v, м/с снято ±σ a, м/с² снято ±σ",
        "звено ε, с⁻² снято ±σ куда",
        "отрезок точно, мм снято, мм ±σ",
        "вектор отрезок точно, мм снято, мм ±σ по снятому, м/с",
    ):
        assert header.split() in rows
    sigma = np.sqrt(drafting_of(solution).covariance(["v_E"], 0)[0, 0])
    row = ["E", "0,2471", "0", "3,916", "3,925", spoken(float(sigma), False, "ru")]
    assert any(each[:6] == row for each in rows)
    sliding = next(row for row in rows if row[:2] == ["B:", "3"])
    assert len(sliding) == 4 + 9
    turning = next(row for row in rows if row[0:2] == ["4", "−30,06"])
    assert turning[5:] == ["по", "часовой", "стрелке"]


@pytest.mark.parametrize("lang", LANGUAGES)
def test_errors_found_by_draws_are_marked_and_explained(lang: str) -> None:
    words = wording(lang)
    note = words.drawn_note
    starred = result_tables(near_dead(), lang, sigma=True)
    assert note in flat(starred)
    assert re.search(r"\d\*", starred)
    spread = drafting_of(near_dead()).spreads["v_H"]
    assert spread.drawn.any()
    for i in range(3):
        mark = spoken(float(spread.sigma[i]), bool(spread.drawn[i]), lang)
        points = [row for row in rows_of(starred) if row[:1] == ["H"] and "←" not in row[1]]
        row = points[i]
        assert row[5] == mark
    clean = result_tables(worked("linkages/ex3"), lang, sigma=True)
    assert note not in flat(clean)
    assert "*" not in clean


@pytest.mark.parametrize(
    ("lang", "profile", "said"),
    [("ru", "board", "«чертёжная доска»"), ("ru", "coarse", "«грубо»"), ("en", "cad", "“CAD”")],
)
def test_the_profile_is_named(lang: str, profile: str, said: str) -> None:
    solution = Solution(problem_of("linkages/ex1"), profile=PROFILES[profile])
    assert said in result_tables(solution, lang, sigma=True)


def test_digits_are_aligned_where_some_are_marked() -> None:
    lines = result_tables(worked("press/press"), "ru", sigma=True).splitlines()
    start = next(k for k, line in enumerate(lines) if line.startswith("a_A "))
    cells = [line[: lines[start - 2].index("  по снятому")] for line in lines[start : start + 12]]
    ends = {cell.rstrip(" *")[-1:].isdigit() and len(cell.rstrip(" *")) for cell in cells}
    assert len(ends) == 1


# Many positions -----------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", ["linkages/ex1", "linkages/ex3", "levers/task12", "press/press"])
def test_many_positions_have_one_more_table(name: str, lang: str) -> None:
    solution = around(name, 12)
    text, plain = result_tables(solution, lang, sigma=True), result_tables(solution, lang)
    assert_readable(text)
    title = wording(lang).many_sigmas
    assert text.count(title) == 1
    assert title not in plain
    table = text[text.index(title) :]
    head = [row for row in rows_of(table) if row[:1] == [wording(lang).number]]
    columns = [name for row in head for name in row[3:]]
    relative = [one for plan in RATES for one in relative_series(solution, plan)]
    reported = [*reported_points(solution), *reported_links(solution)]
    assert len(columns) == 2 * len(reported) + len(relative)
    point = reported_points(solution)[-1]
    spread = drafting_of(solution).spreads[f"a_{point}"]
    (row,) = [row for row in head if f"a_{point}" in row]
    at = row.index(f"a_{point}") - 1  # "φ₁, °" is two words
    start = rows_of(table).index(row)
    for i in range(12):
        cells = rows_of(table)[start + 2 + i]
        assert cells[at] == spoken(float(spread.sigma[i]), bool(spread.drawn[i]), lang)


def test_no_causes_of_many_positions() -> None:
    assert wording("ru").table_causes not in result_tables(around("linkages/ex3", 12), sigma=True)


# Tables without the option ------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
def test_tables_without_errors_compute_none(lang: str, monkeypatch: pytest.MonkeyPatch) -> None:
    once = Solution.compute_once
    monkeypatch.setattr(
        Solution,
        "compute_once",
        lambda s, make: pytest.fail("asked") if make is Drafting else once(s, make),
    )
    for solution in (worked("linkages/ex3"), around("linkages/ex3", 12)):
        text = result_tables(solution, lang)
        assert text == result_tables(solution, lang, sigma=False)
        assert "σ" not in text


# Causes -------------------------------------------------------------------------------------------


@pytest.mark.parametrize("lang", LANGUAGES)
@pytest.mark.parametrize("name", SIX)
def test_the_largest_causes_of_the_worst_result(name: str, lang: str) -> None:
    solution, words = worked(name), wording(lang)
    text = result_tables(solution, lang, sigma=True)
    lines = text[text.index(words.table_causes) :].split("\n\n")[0].splitlines()
    spreads = drafting_of(solution).spreads
    worst: dict[str, float] = {}
    for point in reported_points(solution):
        motion = solution.points[point]
        worst[f"v_{point}"] = float(abs(motion.velocity[0]))
        worst[f"a_{point}"] = float(abs(motion.acceleration[0]))
    for link in reported_links(solution):
        worst[f"omega_{link}"] = abs(float(solution.links[link].omega[0]))
        worst[f"epsilon_{link}"] = abs(float(solution.links[link].epsilon[0]))
    parts = {
        label: float(spreads[label].sigma[0]) / value
        for label, value in worst.items()
        if not spreads[label].drawn[0] and 3 * float(spreads[label].sigma[0]) <= value
    }
    label = max(parts, key=lambda each: round(parts[each], 9))
    percent = re.search(r"\((\d+(?:[.,]\d)?) %\)", lines[1])
    assert percent is not None
    assert float(percent[1].replace(",", ".")) == pytest.approx(100 * parts[label], abs=0.51)
    shares = [int(line.split()[0]) for line in lines[2:]]
    assert 1 <= len(shares) <= 3
    assert shares == [
        round(100 * s) for _, s in drafting_of(solution).causes(label, 0)[: len(shares)]
    ]


@each("lang", LANGUAGES)
@each("name", [*SIX, *range(some(25, few=10))])
def test_every_stroke_has_a_name(name: str | int, lang: str) -> None:
    """Every cause of every quantity has a name that a reader knows."""
    solution = drawn(name) if isinstance(name, int) else worked(name)
    causes = ErrorCauses(Names(solution, wording(lang)))
    strokes = {
        stroke
        for label in drafting_of(solution).items
        for stroke, _ in drafting_of(solution).causes(label, 0)
    }
    assert strokes
    for stroke in strokes:
        said = plain_text(causes.describe(stroke))
        assert_readable(said)
        assert said.endswith(")"), said  # which plan it is on


def test_causes_are_named_by_the_drawn_item() -> None:
    solution = worked("linkages/ex3")
    causes, velocity = (
        ErrorCauses(Names(solution, wording("ru"))),
        solution.construction.kinematics.velocity,
    )
    read = velocity.segments.drawn((velocity.pole, velocity.point["3", "B"]))
    for stroke, named in {
        "A": "нанесение точки A (план положений)",
        "line1": "проведение направляющей x-x (план положений)",
        "line2": "откладывание угла φ₁ (план положений)",
        "B": "откладывание отрезка от точки A до точки B (план положений)",
        "v:B3": "отметка точки b₃ в пересечении прямых (план скоростей)",
        read: "снятие отрезка pb₃ (план скоростей)",
        "a:D": "построение точки d по подобию (план ускорений)",
    }.items():
        assert plain_text(causes.describe(stroke)) == named
    english = ErrorCauses(Names(worked("linkages/ex2"), wording("en")))
    assert plain_text(english.describe("B")) == "fixing point B with an arc (position plan)"


def test_without_a_believed_result_there_are_no_causes() -> None:
    """A result lost in its error, or whose error is found by draws, has no first-order causes."""
    solution = Solution(problem_of("levers/six-link"), positions=[250.0])
    drafting_of(solution).spreads = {
        label: type(spread)(spread.sigma, np.ones_like(spread.drawn))
        for label, spread in drafting_of(solution).spreads.items()
    }
    assert tuple(ErrorCauses(Names(solution, wording("ru"))).nodes(0)) == ()
    assert wording("ru").table_causes not in result_tables(solution, sigma=True)
