"""A mechanism built in Python is the problem of the file that it writes."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from cases import each, thinned
from doors import (
    ArgumentError,
    AssemblyError,
    DoubtWarning,
    ModelProblem as Problem,
    OutputError,
    ProblemError,
    UnknownNameError,
    UnknownQuantityError,
)
from matplotlib.figure import Figure
from msgspec.structs import replace
from pressed import press
from worked import every_file, path_of

import planmethod as pm


def of_press(phi: Any) -> tuple[Any, Any]:
    """Return x_E and omega_3 of the press by formulas of its geometry, not by its plans."""
    phi = np.radians(phi)
    x, y = 0.064 * np.cos(phi), 0.064 * np.sin(phi) + 0.11
    psi = np.arctan2(y, x)
    omega = 50 * 0.064 * (x * np.cos(phi) + y * np.sin(phi)) / (x**2 + y**2)
    high = -0.11 + 0.22 * np.sin(psi)
    return 0.22 * np.cos(psi) + np.sqrt(0.18**2 - high**2), omega


def without_source(problem: Problem) -> Problem:
    return replace(problem, source_file="", variants=(), variant=None)


def test_the_press_moves_as_its_geometry_says() -> None:
    solution = press().solve(np.arange(360))
    found = solution.to_columns(["v_E", "omega_3", "x_E"])
    assert list(found) == ["v_E", "omega_3", "x_E"]
    place, omega = of_press(solution.positions)
    assert found["x_E"] == pytest.approx(place, abs=1e-12)
    assert found["omega_3"] == pytest.approx(omega, rel=1e-11)
    step = 1e-4
    ahead, back = (of_press(solution.positions + by)[0] for by in (step, -step))
    speed = np.abs(ahead - back) / (2 * np.radians(step)) * 50
    assert found["v_E"] == pytest.approx(speed, rel=1e-6, abs=1e-6)


def test_the_written_file_gives_the_same_problem() -> None:
    m = press()
    assert pm.loads(m.to_toml(), name="press") == m.problem
    assert pm.Mechanism.from_dict(m.to_dict(), name="press").problem == m.problem
    assert pm.Mechanism.from_toml(m.to_toml(), name="press").to_dict() == m.to_dict()


def test_shipped_files_are_written_and_read_back() -> None:
    read = 0
    for path in thinned(list(every_file()), 4):
        m = pm.Mechanism.from_file(path)
        again = pm.loads(m.to_toml(), name=m.name)
        assert without_source(again) == without_source(m.problem), path
        read += 1
    assert read > 3


def test_a_variant_is_a_mechanism_of_its_own() -> None:
    path = path_of("linkages/ex3-variants")
    m = pm.Mechanism.from_file(path, variant="2")
    again = pm.loads(m.to_toml(), name=m.name)
    assert without_source(again) == without_source(pm.load(path, variant="2"))
    assert again.drive.positions == (40.0,)


def test_with_changes_the_file_and_what_follows_from_it() -> None:
    m = press()
    other = m.with_(AB=0.05, C=(0, -0.2), omega=20)
    assert other.to_dict()["links"]["1"]["AB"] == 0.05
    assert other.to_dict()["frame"]["C"] == [0.0, -0.2]
    assert ("1", "AB", 0.05) in other.problem.lengths  # of "Given"
    assert other.parameters["omega_1"] == 20.0
    assert m.parameters["l_AB"] == 0.064
    text = m.to_toml().replace("0.064", "0.05").replace("[0, -0.11]", "[0, -0.2]")
    file = pm.loads(text.replace("omega = 50", "omega = 20"), name="press")
    assert file == other.problem
    assert m.with_({"angle_x-x": 5}, y_C=-0.2).parameters["angle_x-x"] == 5.0


def test_numbers_are_si_in_a_file_of_millimetres() -> None:
    m = pm.Mechanism("mm", units="mm").frame(A=(0, 0), D=(300, 0)).drive("1", n=60)
    m.link("1", A="B", length=100).link("2", B="C", length=250).link("3", C="D", length=200)
    m.assemble(C="left of AD")
    assert m.parameters["l_AB"] == pytest.approx(0.1)
    other = m.with_(AB=0.09, omega_1=6.0)
    assert other.to_dict()["links"]["1"]["AB"] == pytest.approx(90.0)
    assert other.to_dict()["driver"]["n"] == pytest.approx(6.0 * 30 / np.pi)
    assert "published" not in other.to_dict()


def test_numpy_values_are_written_as_numbers() -> None:
    m = press().frame(C=np.array([0.0, -0.11])).frame(A=0j)
    m.drive("1", omega=np.float64(50), phi=np.arange(0, 360, 30))
    assert m.to_dict()["driver"]["phi"] == list(range(0, 360, 30))
    assert m.problem == press().problem


@each(
    "build, message",
    [
        (lambda m: m.link("6", A="F"), "a length is that of two points"),
        (lambda m: m.link("6", "A", "F", length=1), "a length is that of two points"),
        (lambda m: m.with_(AC=1.0), "AC"),
        (lambda m: m.with_(C=0.1), "two coordinates"),
        (lambda m: m.set("links.1.points.x", 1), "not a table"),
        (lambda m: m.set("driver.speed", 1).problem, "speed"),
    ],
)
def test_wrong_use_is_reported(build: Any, message: str) -> None:
    with pytest.raises((ArgumentError, UnknownNameError, ProblemError), match=message):
        build(press())


# Results -----------------------------------------------------------------------------------------


def test_every_spelling_of_a_name_gives_one_column() -> None:
    solution = press().solve([20.0, 50.0])
    names = ["v_E", "E.v", "v E", "omega_3", "3.omega", "vx_E", "E.vx", "x_E", "E.x"]
    found = solution.to_columns(names)
    assert list(found) == names
    assert (found["E.v"] == found["v_E"]).all() and (found["v E"] == found["v_E"]).all()
    assert (found["3.omega"] == found["omega_3"]).all()
    assert (found["E.vx"] == found["vx_E"]).all() and (found["E.x"] == found["x_E"]).all()
    assert list(solution.to_columns(["E"])) == ["x_E", "y_E"]
    point = solution.points["E"]
    assert found["v_E"] == pytest.approx(np.abs(point.velocity), rel=1e-13)
    every = solution.to_columns()
    assert every["phi_3"] == pytest.approx(solution.links["3"].phi_deg, rel=1e-13)
    assert every["ay_D"] == pytest.approx(solution.points["D"].acceleration.imag, rel=1e-13)
    with pytest.raises(UnknownQuantityError, match="v_Q"):
        solution.to_columns(["v_Q"])


def test_a_position_that_does_not_exist_is_nan_on_request() -> None:
    m = press().with_(DE=0.1)
    whole = m.solve([0.0, 90.0], partial=True)
    assert whole.exists.tolist() == [True, False]
    found = whole.to_columns(["x_E", "omega_3"])
    assert np.isnan(found["x_E"]).tolist() == [False, True]
    assert np.isfinite(found["omega_3"]).all()
    with pytest.raises(AssemblyError):
        m.solve([0.0, 90.0])


def test_forces_have_the_names_of_columns() -> None:
    m = pm.Mechanism.from_file(path_of("linkages/triad"))
    solution = m.solve()
    forces = solution.forces()
    found, reactions = forces.to_columns(), forces.statics.reactions
    assert len(reactions) > 3
    for one in reactions:
        name = f"{one.joint}_{one.on}/{one.by}"
        assert found[f"F_{name}"] == pytest.approx(np.abs(one.force), rel=1e-9)
        assert forces[f"Fx_{name}"] == pytest.approx(one.force.real, rel=1e-9)
        assert forces[f"F.{one.joint}.{one.on}-{one.by}.y"] == pytest.approx(one.force.imag)
    assert forces["M_dr"] == pytest.approx(forces.statics.balance)


def test_the_driving_moment_balances_the_power_of_a_mass() -> None:
    """A slider of 3 kg on a level guide: M_dr omega = m a v; without masses all is zero."""
    solution = press().mass("5", 3.0).solve(np.arange(0, 360, 10))
    point = solution.points["E"]
    power = 3.0 * point.acceleration.real * point.velocity.real
    moment = solution.forces()["M_dr"]
    assert moment * 50.0 == pytest.approx(power, rel=1e-9, abs=1e-9 * np.abs(power).max())
    with pytest.warns(DoubtWarning, match="neither masses nor loads"):
        nothing = press().solve([20.0]).forces()
    assert not any(column.any() for column in nothing.to_columns().values())
    assert nothing["M_dr"].tolist() == [0.0]


def test_tables_of_pandas_have_the_columns_and_the_position(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    made = SimpleNamespace(
        Index=lambda values, name: (name, list(values)),
        DataFrame=lambda columns, index: (columns, index),
    )
    monkeypatch.setitem(sys.modules, "pandas", made)
    solution = press().solve([20.0, 50.0])
    columns, index = solution.to_frame(["v_E"])
    assert list(columns) == ["v_E"] and index == ("phi_deg", [20.0, 50.0])
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(OutputError, match="pip install pandas"):
        solution.to_frame(["v_E"])


def test_a_sheet_is_a_file_and_a_picture(tmp_path: Path) -> None:
    solution = pm.Mechanism.from_file(path_of("linkages/ex3")).solve()
    sheet = solution.sheet(lang="en", fields={"author": "Ivanov"})
    assert repr(sheet) == f"Sheet({sheet[0].width:g} × {sheet[0].height:g} mm)"
    assert sheet.to_svg().startswith("<?xml") and sheet._repr_svg_() == sheet.to_svg()
    assert sheet.to_pdf().startswith(b"%PDF") and sheet.to_png(dpi=30).startswith(b"\x89PNG")
    sheet.save(tmp_path / "a.pdf")
    assert (tmp_path / "a.pdf").read_bytes() == sheet.to_pdf()
    axes: Any = Figure(figsize=(8, 6)).add_subplot()
    sheet.to_axes(axes)
    assert len(axes.patches) > 100
    assert axes.get_xlim() == (0.0, sheet[0].width)
    assert "Velocity plan" in {item.text for item in sheet[0].items if hasattr(item, "text")}
    with pytest.raises(OutputError, match="docx"):
        sheet.save(tmp_path / "a.docx")


def test_a_notebook_shows_a_mechanism_and_its_solution() -> None:
    m = press()
    assert repr(m) == "Mechanism(press: links 1, 3, 2, 4, 5; driver 1)"
    assert m._repr_svg_().startswith("<?xml")
    solution = m.solve([20.0])
    assert repr(solution) == "Solution(press: 1 position, I(0,1) → II(3,2) → II(4,5))"
    assert "<table" in solution._repr_html_()
    assert isinstance(solution.with_positions([1.0, 2.0]), pm.Solution)


# Other kinds -------------------------------------------------------------------------------------


@each(
    "module, file, names",
    [
        ("gears", "gears/gears-ex2", ["name", "omega"]),
        ("meshing", "meshing/z12-30", ["wheel", "d_a"]),
        ("cams", "cams/central", ["phi_deg", "s"]),
        ("moving", "point/k11-01", ["t", "v"]),
    ],
)
def test_all_kinds_are_loaded_solved_and_drawn_in_the_same_words(
    module: str, file: str, names: list[str]
) -> None:
    task = getattr(pm, module).load(path_of(file))
    solution = task.solve()
    assert solution.record["problem"] == path_of(file).stem
    columns = solution.to_columns(names)
    assert list(columns) == names and len({len(one) for one in columns.values()}) == 1
    assert solution.sheet(lang="en").to_svg().startswith("<?xml")
    with pytest.raises(UnknownNameError):
        solution.to_columns(["no"])
    assert task.problem.name in repr(task) and task.problem.name in repr(solution)


def test_a_table_of_a_kind_has_the_numbers_of_its_record() -> None:
    cam = pm.cams.load(path_of("cams/central")).solve()
    columns = cam.to_columns()
    for one in cam.record["positions"]:
        row = int(np.flatnonzero(columns["phi_deg"] == one["phi_deg"])[0])
        assert columns["s"][row] == pytest.approx(one["s"], abs=1e-15)
    mesh = pm.meshing.load(path_of("meshing/z12-30")).solve()
    assert mesh.to_columns(["d_a"])["d_a"].tolist() == mesh.record["meshing"]["d_a"]


# Many mechanisms ---------------------------------------------------------------------------------


def test_a_grid_has_the_results_of_each_sample() -> None:
    m, positions = press(), np.linspace(0.0, 330.0, 12)
    lengths = np.linspace(0.05, 0.07, 40)
    grid = m.grid(positions, AB=lengths, C=(np.zeros(40), np.linspace(-0.12, -0.1, 40)))
    assert grid.shape == (40, 12) == grid["v_E"].shape
    assert repr(grid) == "Grid(press: 40 samples of l_AB, x_C, y_C × 12 positions)"
    for k in (0, 17, 39):
        alone = m.with_(AB=lengths[k], C=(0, grid.samples["y_C"][k])).solve(positions)
        found = alone.to_columns(["v_E", "omega_3", "x_E"])
        for name, column in found.items():
            assert grid[name][k] == pytest.approx(column, rel=1e-12, abs=1e-12)
    columns = grid.to_columns(["v_E", "E"])
    assert list(columns) == ["l_AB", "x_C", "y_C", "phi_deg", "v_E", "x_E", "y_E"]
    assert columns["phi_deg"][:13].tolist() == [*positions.tolist(), 0.0]
    assert (columns["v_E"] == grid["v_E"].ravel()).all()


@each(
    "samples, message",
    [
        ({"AB": [0.1, 0.2], "CD": [0.1, 0.2, 0.3]}, "one length"),
        ({}, "Give lists"),
        ({"AB": [[0.1, 0.2]]}, "Give lists"),
        ({"AX": [0.1]}, "AX"),
    ],
)
def test_samples_that_do_not_go_together_are_rejected(samples: Any, message: str) -> None:
    with pytest.raises((ArgumentError, UnknownNameError), match=message):
        press().grid([0.0], samples)


def test_a_point_of_a_grid_is_computed_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """It has two columns, neither of which is named as it is requested."""
    grid = press().grid([0.0, 90.0], AB=[0.06, 0.064])
    first = grid.results(["E", "omega_3"])
    monkeypatch.setattr("planmethod.scripting.grid.Sweep", None)
    again = grid.results(["omega_3", "E"])
    assert list(first) == ["x_E", "y_E", "omega_3"]
    assert all(again[name] is own for name, own in first.items())


def geared() -> pm.Mechanism:
    m = pm.Mechanism("geared").frame(O=(0, 0), D=(1.2, 0)).link("1", O="A", length=0.4)
    m.link("2", A="C", length=1.0).link("3", C="B", length=1.0).link("4", D="B", length=0.4)
    m.mesh("1", "4", centres=("O", "D"), z=(60, 20)).assemble(C="left of AB")
    return m.drive("1", omega=2)


def test_wheels_on_links_are_built_and_written_as_the_file_has_them() -> None:
    m = geared()
    assert pm.Mechanism.from_toml(m.to_toml(), name="geared").problem == m.problem
    assert m.solve([20.0]).links["4"].omega == pytest.approx([-6.0])
    moved = m.with_(x_D=1.25).solve([20.0]).to_columns(["v_C"])["v_C"]
    assert m.grid([20.0], x_D=[1.2, 1.25])["v_C"][1] == pytest.approx(moved)
    with pytest.raises(ProblemError, match=r"the pitch radii give a distance of 0\.8 m"):
        geared().mesh("1", "4", centres=("O", "D"), z=(60, 20), module=20).problem  # noqa: B018


def test_a_wheel_that_rolls_is_built_and_written_as_the_file_has_it() -> None:
    m = pm.Mechanism("wheel").frame(O=(0, 0), guides={"rail": ((0, -0.1), 0)})
    m.link("1", O="A", length=0.06).link("2", A="C", length=0.22)
    with pytest.raises(UnknownNameError, match=r"link '3' does not exist\. Known: 1, 2"):
        m.roll("3", on="rail", radius=0.04)
    m.link("3", C="E", length=0.03).roll("3", on="rail", radius=0.04, centre="C")
    m.drive("1", omega=6).assemble(C="right of A")
    assert pm.Mechanism.from_toml(m.to_toml(), name="wheel").problem == m.problem
    solution = m.solve([30.0])
    speed = solution.points["C"].velocity.real
    assert solution.links["3"].omega == pytest.approx(-speed / 0.04)
    centre = solution.instant_centres().of("0", "3")
    assert centre.pole == "W"
    assert centre.at.imag == pytest.approx(-0.1)
    assert repr(solution.instant_centres()) == "Centres(links 0, 1, 2, 3: 6 centres)"


def test_instant_centres_give_the_velocities_of_a_solution() -> None:
    solution = pm.solve(pm.load(path_of("linkages/ex3")))
    centres = solution.instant_centres()
    place, speed = (getattr(solution.points["E"], key)[0] for key in ("place", "velocity"))
    assert centres.motions["5"].velocity(place) == pytest.approx(speed)
    assert centres.of("2", "0") is centres.of("0", "2")
    with pytest.raises(UnknownNameError, match="link '9' does not exist"):
        centres.of("9", "2")


def test_two_links_drive_where_the_second_is_additional() -> None:
    m = pm.Mechanism("five-bar").frame(O=(0, 0), D=(0.4, 0))
    m.link("1", O="A", length=0.12).link("2", A="C", length=0.3).link("3", C="B", length=0.32)
    m.link("4", D="B", length=0.15).drive("1", phi=70, omega=10)
    m.drive("4", additional=True, phi=40, omega=-15).assemble(C="left of AB")
    assert m.problem.drive.links == ("1", "4")
    assert repr(m) == "Mechanism(five-bar: links 1, 2, 3, 4; drivers 1, 4)"
    again = pm.Mechanism.from_dict(m.to_dict())
    assert again == m and again != m.with_(OA=0.13)
    assert m.drive("4", phi=40, omega=1).to_dict()["driver"]["link"] == "4"
    assert "drivers" not in m.to_dict()


def roller() -> pm.Mechanism:
    return pm.Mechanism.from_file(path_of("machines/rolling-wheel"))


def geared_by_radius(radius: float = 0.9) -> pm.Mechanism:
    """Return a geared five-bar whose second wheel is as large as the distance leaves it."""
    m = pm.Mechanism("geared").frame(O=(0, 0), D=(1.2, 0)).link("1", O="A", length=0.4)
    m.link("2", A="C", length=1.0).link("3", C="B", length=1.0).link("4", D="B", length=0.4)
    m.mesh("1", "4", centres=("O", "D"), r=(radius,)).assemble(C="left of AB")
    return m.drive("1", omega=2, phi=[20])


def test_the_radius_of_a_wheel_is_a_number_like_a_length() -> None:
    """One that rolls turns at v/r; in a mesh the other wheel is the rest of the distance."""
    radii = np.linspace(0.03, 0.06, 7)
    turned = roller().grid([40.0, 70.0], r_3=radii)
    for k, radius in enumerate(radii):
        table = roller().to_dict()
        table["links"]["3"]["rolls"]["radius"] = float(radius)
        solution = pm.Mechanism.from_dict(table).solve([40.0, 70.0])
        assert turned["omega_3"][k] == pytest.approx(solution.links["3"].omega, rel=1e-9)
        moment = solution.forces().to_columns(["M_dr"])["M_dr"]
        assert turned["M_dr"][k] == pytest.approx(moment, rel=1e-9)
        assert roller().with_(r_3=radius) == pm.Mechanism.from_dict(table)
    fit = roller().fit(["r_3"], {"omega_3(40)": 12.0})
    assert fit.mechanism.solve([40.0]).links["3"].omega == pytest.approx(12.0, rel=1e-9)
    rates = geared_by_radius().grid([20.0, 30.0], r_1=[0.8, 0.7, 0.6])["omega_4"]
    for own, radius in zip(rates, (0.8, 0.7, 0.6), strict=True):
        assert own == pytest.approx(-2 * radius / (1.2 - radius), rel=1e-9)
        assert geared_by_radius().with_(r_1=radius).problem == geared_by_radius(radius).problem
    fit = geared_by_radius().fit(["r_1"], {"omega_4(20)": -4.0})
    assert fit.numbers["r_1"] == pytest.approx(0.8, rel=1e-9)
    both = geared_by_radius().set(
        "meshes", [{**geared_by_radius().to_dict()["meshes"][0], "r": [0.9, 0.3]}]
    )
    assert both.with_(r_1=0.8, r_4=0.4).solve().links["4"].omega == pytest.approx(-4.0)
    with pytest.raises(ProblemError, match=r"the pitch radii give a distance of 1\.1 m"):
        _ = both.with_(r_1=0.8).problem


def test_stiffness_and_free_length_of_a_spring_are_numbers_like_a_length() -> None:
    m = pm.Mechanism.from_file(path_of("machines/hatch"))
    samples = {"stiffness_F_п": [200.0, 400.0], "length_F_п": [0.6, 0.8]}
    moments = m.grid([60.0, 75.0], samples)["M_dr"]
    for k, (stiffness, length) in enumerate(zip(*samples.values(), strict=True)):
        table = m.to_dict()
        table["springs"][0] |= {"stiffness": stiffness, "length": length}
        changed = pm.Mechanism.from_dict(table, name=m.name)
        own = changed.solve([60.0, 75.0]).forces().to_columns(["M_dr"])["M_dr"]
        assert moments[k] == pytest.approx(own, rel=1e-9)
        numbers = {"stiffness_F_п": stiffness, "length_F_п": length}
        assert m.with_(numbers) == changed
    fit = m.fit(["length_F_п"], {"M_dr(60)": float(moments[0, 0])})
    again = fit.mechanism.solve([60.0]).forces().to_columns(["M_dr"])["M_dr"]
    assert again == pytest.approx(moments[0, 0], rel=1e-9)
