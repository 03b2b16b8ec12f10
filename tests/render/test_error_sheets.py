"""Sheets that show drafting errors: ellipses and sigmas, and neither without the options."""

from __future__ import annotations

import re
from contextlib import suppress
from decimal import ROUND_HALF_EVEN, Decimal
from itertools import product

import pytest
from cases import some, thinned
from doors import (
    DRAFTING_PROFILES as PROFILES,
    FRAME_FORMATS as FORMATS,
    TAG,
    Drafting,
    Drawing,
    LayoutError,
    PlanKind,
    Solution,
    Stroke,
    Views,
    calculation,
    drafting_of,
    get_language,
    kinematics_sheets,
    reported_links,
    reported_points,
    result_columns,
)
from msgspec.structs import replace
from test_sheets import MANY, format_of, marks, texts
from worked import SIX, problem_of

PAPERS = ("A3", "A1")
RU = get_language("ru")


def count_ellipses(sheet: Drawing) -> int:
    return sum(isinstance(item, Stroke) and item.tag == TAG for item in sheet.items)


@pytest.mark.parametrize(
    ("name", "many"),
    [*((name, False) for name in SIX), *((name, True) for name in thinned(SIX, 2))],
)
def test_the_lint_finds_no_faults(name: str, many: bool) -> None:
    positions = MANY[name] if many else None
    alone = ((True, False), (False, True)) if not many and name in thinned(SIX, 3) else ()
    for errors, sigma in ((True, True), *alone):
        sheets = kinematics_sheets(
            problem_of(name), positions=positions, errors=errors, sigma=sigma
        )
        assert marks(sheets) == []
        if sigma:
            assert_tables_inside(sheets)
        sheets = [sheet for sheet in sheets if not sheet.is_continuation]
        assert all((count_ellipses(sheet) > 0) == errors for sheet in sheets)
        for sheet in sheets:
            shown = texts(sheet)
            assert shown.count("Эллипсы погрешностей") == (3 if errors else 0)
            assert ("погрешность построения" in shown) == sigma


@pytest.mark.parametrize("profile", ["cad", "coarse"])
@pytest.mark.parametrize("name", SIX)
def test_the_lint_finds_no_faults_with_other_profiles(name: str, profile: str) -> None:
    sheets = kinematics_sheets(problem_of(name), errors=True, sigma=True, profile=PROFILES[profile])
    assert marks(sheets) == []


@pytest.mark.parametrize(
    ("name", "paper", "many"),
    [
        *product(["linkages/ex1", "linkages/ex3", "levers/task12", "press/press"], PAPERS, [False]),
        *product(thinned(["levers/task12", "press/press", "linkages/ex3"], 3), ["A3"], [True]),
    ],
)
def test_the_table_stays_inside_of_every_format(name: str, paper: str, many: bool) -> None:
    positions = MANY[name] if many else None
    try:
        sheets = kinematics_sheets(
            problem_of(name), paper=paper, positions=positions, errors=True, sigma=True
        )
    except LayoutError:
        # The views and their ellipses alone are too large for it, or at its limit: every position
        # needs a sheet of its own.
        with suppress(LayoutError):
            alone = kinematics_sheets(
                problem_of(name), paper=paper, positions=positions, errors=True, sigma=False
            )
            assert len(alone) == len(positions or [0.0])
        return
    assert {format_of(sheet) for sheet in sheets} == {FORMATS[paper]}
    assert marks(sheets) == []
    assert_tables_inside(sheets)


def assert_tables_inside(sheets: list[Drawing]) -> None:
    tables = 0
    for sheet in sheets:
        left, low, right, high = format_of(sheet).inner
        lines = [item for item in sheet.items if isinstance(item, Stroke) and item.tag == "table"]
        tables += sum(line.closed for line in lines)
        for point in (point for line in lines for point in line.points):
            assert left < point.real <= right  # at most on the frame
            assert low < point.imag < high
    assert tables >= 1


# Sheets without the options -----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("name", "many"),
    [*((name, False) for name in SIX), *((name, True) for name in SIX[: some(6, few=2)])],
)
def test_no_errors_are_computed_without_the_options(
    name: str, many: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The display list does not depend on the profile, and no drafting errors are computed."""
    positions = MANY[name] if many else None
    plain = kinematics_sheets(problem_of(name), positions=positions, sigma=False)
    same_ruler = replace(PROFILES["coarse"], ruler=PROFILES["board"].ruler)
    once = Solution.compute_once
    monkeypatch.setattr(
        Solution,
        "compute_once",
        lambda s, make, *of, **how: (
            pytest.fail("asked") if make is Drafting else once(s, make, *of, **how)
        ),
    )
    again = kinematics_sheets(
        problem_of(name), positions=positions, profile=same_ruler, sigma=False
    )
    assert [sheet.items for sheet in plain] == [sheet.items for sheet in again]


def test_the_profile_brings_its_ruler() -> None:
    problem = problem_of("linkages/ex3")
    asked = kinematics_sheets(problem, ruler=1.0, sigma=False)
    coarse = kinematics_sheets(problem, profile=PROFILES["coarse"], sigma=False)
    assert coarse[0].items == asked[0].items
    assert kinematics_sheets(problem)[0].items == kinematics_sheets(problem, ruler=0.5)[0].items


# The table ----------------------------------------------------------------------------------------


def rounded(sigma: float) -> Decimal:
    """Round an error as GOST does it: two digits when it begins with 1 or 2, else one."""
    value = Decimal(repr(sigma))
    place = value.adjusted()
    lead = value.scaleb(-place)
    digits = Decimal(1).scaleb(place - (1 if lead < Decimal("2.95") else 0))
    return (value / digits).quantize(Decimal(1), ROUND_HALF_EVEN) * digits


def number(text: str) -> Decimal:
    return Decimal(re.sub(r"[*\s]", "", text).replace(",", "."))


@pytest.mark.parametrize("name", SIX)
def test_rows_of_a_single_position(name: str) -> None:
    solution = Solution(problem_of(name), views=Views.for_paper("A2", 1))
    columns = {
        column.head: column.cells for column in result_columns(solution, [0], RU, sigma=True)
    }
    plain = {column.head: column.cells for column in result_columns(solution, [0], RU)}
    assert [cell.text for cell in columns.pop("")] == ["точно", "план", "Δ, %", "±σ"]
    assert list(columns) == list(plain)
    velocities, accelerations = (
        "\n".join(calculation(solution, kind, 0, RU))
        for kind in (PlanKind.VELOCITY, PlanKind.ACCELERATION)
    )
    said = {"v": velocities, "omega": velocities, "a": accelerations, "epsilon": accelerations}
    labels = [("v", "v", p) for p in reported_points(solution)]
    labels += [("ω", "omega", k) for k in reported_links(solution)]
    labels += [("a", "a", p) for p in reported_points(solution)]
    labels += [("ε", "epsilon", k) for k in reported_links(solution)]
    for symbol, word, what in labels:
        head = f"{symbol}_{{{solution.problem.lettered(what)}}}"
        exact, read, off, error = columns[head]
        assert exact == plain[head][0]
        spread = drafting_of(solution).spreads[f"{word}_{what}"]
        sigma = float(spread.sigma[0])
        value = abs(float(solution.read_off(f"{word}_{what}")[0]))
        assert error.text.endswith("*") == bool(spread.drawn[0])
        shown = float(number(read.text))
        if off.text != "—":
            true = float(solution.exact(solution.legend[f"{word}_{what}"])[0])
            assert float(number(off.text.replace("−", "-"))) == pytest.approx(
                100.0 * (shown / abs(true) - 1.0), abs=0.06
            )
        if sigma == 0.0:
            assert error.text == "0"
            continue
        assert number(error.text) == rounded(sigma)
        # The number of the calculation beside it, with the digits that it is printed with there.
        assert f" = {read.text} " in said[word]
        assert len(exact.text.replace(",", "")) >= len(read.text.replace(",", "").lstrip("0"))
        assert shown == pytest.approx(value, rel=0.012)


def test_values_of_many_positions_have_their_errors_beside_them() -> None:
    name = "linkages/ex3"
    solution = Solution(problem_of(name), positions=MANY[name], views=Views.for_paper("A1", 12))
    indices = range(12)
    columns = {c.head: c.cells for c in result_columns(solution, indices, RU, sigma=True)}
    plain = {c.head: c.cells for c in result_columns(solution, indices, RU)}
    assert list(columns) == list(plain)
    drafting = drafting_of(solution)
    for i in indices:
        value, _, error = columns["a_{E}"][i].text.partition(" ± ")
        spread = drafting.spreads["a_E"]
        decimals = {len(each.partition(",")[2]) for each in (error.rstrip("*"), value)}
        assert value == plain["a_{E}"][i].text or len(decimals) == 1
        exact = abs(complex(solution.points["E"].acceleration[i]))
        assert abs(float(number(value)) - exact) <= 0.5 * float(rounded(float(spread.sigma[i])))
        assert number(error) == rounded(float(spread.sigma[i]))
        assert error.endswith("*") == bool(spread.drawn[i])
        assert columns["ω_{3}"][i].sense == plain["ω_{3}"][i].sense
        assert columns["v_{B1}"][i].text == "3,200"  # computed, not read: it has no error
    assert any(cell.text.endswith("*") for cell in columns["a_{E}"])


def test_an_exact_value_has_no_fewer_digits_than_its_error() -> None:
    solution = Solution(problem_of("linkages/ex3"), profile=PROFILES["cad"])
    for column in result_columns(solution, [0], RU, sigma=True)[1:]:
        exact, _, _, error = column.cells
        assert len(exact.text.partition(",")[2]) >= len(error.text.partition(",")[2])


def test_the_mark_is_explained_where_it_is_used() -> None:
    name = "linkages/ex3"
    for sheet in kinematics_sheets(problem_of(name), positions=MANY[name], sigma=True):
        shown = re.sub(r"\s+", " ", texts(sheet))
        starred = re.search(r"\d\*(\s|$)", texts(sheet)) is not None
        assert ("по множеству возможных чертежей" in shown) == starred


def test_a_small_value_is_in_the_table_and_only_rounding_is_zero() -> None:
    solution = Solution(problem_of("linkages/ex1"), positions=[0.0, 3e-4])
    columns = {c.head: c.cells for c in result_columns(solution, [0, 1], RU)}
    assert [cell.text for cell in columns["v_{C}"]] == ["0", "2,042·10^{−5}"]
