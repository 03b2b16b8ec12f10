"""Records of trains, meshings and points: each number has its letters and its unit."""

from __future__ import annotations

import pytest
from doors import (
    SolvedMeshing,
    gears_reader_load as load_train,
    gears_record_record as train_record,
    involute_reader_load as load_meshing,
    involute_record_record as meshing_record,
    moving_reader_load as load_point,
    moving_record_record as point_record,
)
from worked import PROBLEMS


@pytest.mark.parametrize("name", ["z12-30", "z20-60-internal"])
def test_sizes_of_a_mesh_are_those_of_its_tables(name: str) -> None:
    problem = load_meshing(PROBLEMS / "meshing" / f"{name}.toml")
    told = meshing_record(problem, "ru")
    legend = told["legend"]
    assert {*legend} <= {*told["meshing"]}
    assert [*legend] == [
        one.quantity.key for group in SolvedMeshing(problem).sized_quantities() for one in group
    ]
    assert legend["d_b"] == {"symbol": ["d_b1", "d_b2"], "unit": "mm"}
    assert legend["alpha_w"] == {"symbol": "α_w", "unit": "deg"}
    assert legend["x_sum"]["symbol"] == ("x_d" if "internal" in name else "x_Σ")
    for key, one in legend.items():
        assert isinstance(one["symbol"], list) == isinstance(told["meshing"][key], list)


def test_speeds_and_requested_quantities_of_a_train_have_letters_and_units() -> None:
    told = train_record(load_train(PROBLEMS / "gears" / "gears-ex6.toml"), "ru")
    assert {*told["gears"]["asked"]} <= {*told["legend"]}
    speeds = {name[2:] for name in told["legend"] if name.startswith("n_")}
    assert {"1", "5", "H"} <= speeds <= {*told["gears"]["bodies"]}
    assert told["legend"]["n_5"] == {"symbol": "n₅", "unit": "1/min"}
    assert told["legend"]["U_1_3^H"] == {"symbol": "U^(H)₁₃", "unit": "1"}


def test_every_column_of_a_point_has_a_symbol_and_a_unit() -> None:
    told = point_record(load_point(PROBLEMS / "point" / "k10-satellite.toml"))
    assert {*told["legend"]} == {*told["point"][0]} - {"reason"}
    assert told["legend"]["a_normal"] == {"symbol": "aⁿ", "unit": "m/s²"}
