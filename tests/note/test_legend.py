"""One legend: a quantity of the plans appears in every output, with its error."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from doors import (
    Draft,
    Kinematics,
    ModelProblem as Problem,
    Quantity,
    QuantityKind,
    Solution,
    Sweep,
    csv_columns,
    drafting_of,
    get_language,
    motion_quantities,
    plans_build as build,
    problem_load as load,
    result_columns,
    solution_record as record,
)
from texts import referee_tables, result_tables
from worked import path_of


@pytest.fixture
def problem(monkeypatch: pytest.MonkeyPatch) -> Problem:
    """Give the third example with one quantity more: how the frame turns as link 3 sees it."""

    def more(kin: Kinematics, draft: Draft) -> Iterator[Quantity]:
        yield from motion_quantities(kin, draft)
        back = draft.b.compute("-omega_3", (kin.omega["3"], 1), factor=-1.0)
        yield Quantity(QuantityKind.OMEGA, back, "0/3", back)

    monkeypatch.setattr(build, "motion_quantities", more)
    return load(path_of("linkages/ex3"))


def test_a_quantity_of_the_legend_is_in_every_output(problem: Problem) -> None:
    solution = Solution(problem)
    omega, sigma = solution.links["3"].omega[0], drafting_of(solution).spreads["omega_3"].sigma[0]
    assert drafting_of(solution).spreads["omega_0/3"].sigma[0] == pytest.approx(sigma)
    assert Sweep(problem, ["omega_0/3"]).table([20.0])["0/3.omega"] == pytest.approx(-omega)
    assert csv_columns(solution)["0/3.omega"] == pytest.approx(-omega)
    entry = record(solution)["positions"][0]
    assert entry["links"]["0/3"] == {"omega": pytest.approx(-omega)}
    read = solution.read_off("omega_0/3")[0]
    told = {"omega": read, "sigma_omega": pytest.approx(sigma)}
    assert entry["hand"]["links"]["0/3"] == told
    assert "ω_{0/3}" in [
        column.head for column in result_columns(solution, [0], get_language("ru"))
    ]
    rows = [line.split() for line in result_tables(solution, "en", sigma=True).splitlines()]
    assert ["0/3", "—", "−15.48", "−15.52", "0.3", "clockwise"] in rows
    many = result_tables(Solution(problem, positions=[0.0, 30.0, 60.0, 90.0]), "en")
    assert many.count("ω_0/3") == 2
    assert "ω_0/3" in referee_tables(solution, 30, "en")
