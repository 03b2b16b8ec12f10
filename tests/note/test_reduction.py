"""The tables of the reduced moment and of the energies: sums, the source's figures."""

from __future__ import annotations

import numpy as np
import pytest
from cases import each
from doors import (
    ReductionNarrator,
    Solution,
    fraction,
    get_language,
    largest_symbol,
    machine_narrator,
    typeset,
)
from worked import problem_of


def told(name: str, variant: str | None = None) -> ReductionNarrator:
    return ReductionNarrator(
        machine_narrator(Solution(problem_of(name, variant)), get_language("ru"))
    )


MACHINES = [("press/flywheel", None), ("press/flywheel", "source"), ("machines/engine", None)]


@each("name, variant", MACHINES)
def test_the_terms_add_up(name: str, variant: str | None) -> None:
    tell = told(name, variant)
    rows, rate = tell.flywheel.rows, abs(tell.problem.drive.rate)
    total = sum(term.moment for term in tell.terms)
    assert np.abs(total - rows.moment).max() < 1e-12 * np.abs(rows.moment).max()
    for term in tell.terms:  # each by its formula
        angle = np.nan_to_num(np.radians(tell.angle(term)), nan=np.pi / 2)
        cosine = np.cos(angle) if term.point is not None else np.sign((term.size * term.speed).real)
        formula = -term.counted * np.abs(term.size) * np.abs(term.speed) * cosine / rate
        assert np.abs(formula - term.moment).max() < 1e-9 * np.abs(rows.moment).max(), term.name
    energy = sum(tell.energies().values())
    assert np.abs(energy - rows.inertia * rate**2 / 2).max() < 1e-9


def test_the_tables_of_the_press() -> None:
    """Table 3 of the source in position 4: 0.48; 350.4 N; 0.81 m/s; 6.4°; 1.1 m/s; 36.17 N·m."""
    tell = told("press/flywheel", "source")
    cells = {head: cells for head, _, cells in tell.moments()}
    heads = list(cells)
    assert [cells[head][4] for head in heads[1:6]] == ["0,480", "350,4", "0,806", "180,0", "1,088"]
    assert cells["α_{G3}"][4] == "6,3"
    assert cells["α_{G3}"][6] == "171,5"  # the source: 171,5
    assert cells["M_{с}"][4] == "35,94"
    energies = {head: cells for head, _, cells in tell.energy_columns()}
    assert list(energies)[1:] == ["T_{1}", "T_{3}", "T_{5}", "T", "J_{п}"]
    assert energies["T_{5}"][4] == "1,951"  # the source: 1,97 with its velocities
    assert tell.energy_formulas()[-1] == r"J_{п} = \frac{2T}{ω_{1}^{2}}"


@pytest.mark.parametrize(
    ("name", "variant", "signs"),
    [(*MACHINES[0], "−−−"), (*MACHINES[1], "−++"), (*MACHINES[2], "++")],
)
def test_the_formula_has_the_signs_of_its_terms(name: str, variant: str | None, signs: str) -> None:
    formula = told(name, variant).moment_formula()
    assert "".join(sign for sign in formula if sign in "−+") == signs


@pytest.mark.parametrize(
    ("name", "largest"),
    [
        ("P", "P_{max}"),
        ("F_{5}", "F_{5 max}"),
        ("F_{5}'", "F_{5 max}'"),
        ("M_{1}^{c}", "M_{1}^{c max}"),
    ],
)
def test_the_letter_of_a_largest_load_can_be_set(name: str, largest: str) -> None:
    assert largest_symbol(name) == largest
    assert typeset(fraction(name, largest), 5.0).width > 0.0
