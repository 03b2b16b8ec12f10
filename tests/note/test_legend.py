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
    QuantityValues,
    Solution,
    Sweep,
    csv_columns,
    drafting_of,
    get_language,
    motion_quantities,
    parse_quantity,
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


def test_a_ratio_of_a_link_has_neither_unit_nor_sense(monkeypatch: pytest.MonkeyPatch) -> None:
    """The table of links has a column for each kind that the plans give of them."""

    def more(kin: Kinematics, draft: Draft) -> Iterator[Quantity]:
        yield from motion_quantities(kin, draft)
        ratio = draft.b.compute("omega_3/omega_1", (kin.omega["3"], 1), (kin.omega["1"], -1))
        yield Quantity(QuantityKind.RATIO, ratio, "3", ratio)

    monkeypatch.setattr(build, "motion_quantities", more)
    known = (QuantityKind.OMEGA, QuantityKind.EPSILON, QuantityKind.RATIO)
    monkeypatch.setattr("planmethod.solved.quantity_steps.OF_PLANS", known)
    monkeypatch.setattr("planmethod.note.tables.results.OF_PLANS", known)
    of_links = (QuantityKind.DIRECTION, *known)
    monkeypatch.setattr("planmethod.note.tables.results.TURNING", of_links)
    solution = Solution(load(path_of("linkages/ex3")))
    lines = [line.split() for line in result_tables(solution, "en").splitlines()]
    assert next(line for line in lines if line[:2] == ["link", "φ,"])[-3:] == ["sense", "u", "read"]
    assert next(line for line in lines if line[:1] == ["3"])[-2:] == ["0.3095", "0.3103"]
    sized = [line.split() for line in result_tables(solution, "en", sigma=True).splitlines()]
    assert ["link", "u", "read", "±σ"] in sized
    key = parse_quantity("u 3")
    assert QuantityValues(solution).exact(key) == pytest.approx(0.30953, rel=1e-4)
