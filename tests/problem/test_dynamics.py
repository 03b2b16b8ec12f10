"""Masses and loads of problem files: reading, and variants of them."""

from __future__ import annotations

from pathlib import Path

import pytest
from doors import (
    Against,
    Couple,
    Dynamics,
    Fixed,
    Interpolation,
    Load,
    Mass,
    MovingSense,
    Over,
    Phase,
    SizeTable,
    TurningSense,
    parse_quantity,
)
from mechanisms import CRANK, LOADED, SLIDER, messages, read
from worked import problem_of

DOCS = Path(__file__).parents[2] / "docs" / "reference" / "problem-file.md"


def dynamics_of(text: str, base: str = CRANK) -> Dynamics:
    found = read(text, base).dynamics
    assert found is not None
    return found


def one(text: str, base: str = CRANK) -> Load | Couple:
    (load,) = dynamics_of("[[loads]]\n" + text, base).loads
    return load


def force(text: str, base: str = CRANK) -> Load:
    found = one('link = "2"\nat = "S2"\n' + text, base)
    assert isinstance(found, Load)
    return found


# Reading -----------------------------------------------------------------------------------------


def test_a_file_without_masses_and_loads_has_no_dynamics() -> None:
    assert read("").dynamics is None
    assert "dynamics" not in read("").tables


def test_an_empty_table_has_gravity_only() -> None:
    assert dynamics_of("[dynamics]\n") == Dynamics(9.81, {}, ())


@pytest.mark.parametrize(("text", "gravity"), [("9.8", 9.8), ("0", 0), ("false", 0)])
def test_gravity(text: str, gravity: float) -> None:
    assert dynamics_of(f"[dynamics]\ngravity = {text}\n").gravity == gravity


@pytest.mark.parametrize(("text", "asked"), [("", False), ("false", False), ("true", True)])
def test_one_force_of_inertia(text: str, asked: bool) -> None:
    line = f"resultant = {text}\n" if text else ""
    assert dynamics_of(f"[dynamics]\n{line}").resultant is asked
    assert not dynamics_of('[[loads]]\nlink = "1"\ncouple = 1\n').resultant


def test_masses() -> None:
    found = dynamics_of(
        """
        [dynamics.links]
        1 = { inertia = 5 }
        2 = { mass = 40, centre = "S2", inertia = 2 }
        3 = { mass = 50 }
        """
    )
    assert found.masses == {
        "1": Mass(0, None, 5),
        "2": Mass(40, "S2", 2),
        "3": Mass(50, "C", 0),
    }


def test_the_centre_may_be_a_fixed_point() -> None:
    found = dynamics_of('[dynamics.links.1]\nmass = 60\ncentre = "A"\n')
    assert found.masses == {"1": Mass(60, "A")}


def test_records_are_frozen() -> None:
    found = dynamics_of('[dynamics.links.1]\nmass = 60\ncentre = "A"\n')
    with pytest.raises(AttributeError):
        found.masses["1"].mass = 1  # type: ignore[misc]


def test_forces_and_couples() -> None:
    text = """
        [[loads]]
        name = "F_{5C}"
        link = "3"
        at = "C"
        force = -6000
        angle = -90
        [[loads]]
        link = "2"
        at = "S2"
        force = 350.4
        against = "velocity"
        phases = { moving = "down" }
        [[loads]]
        link = "1"
        couple = 20
        [[loads]]
        link = "1"
        couple = 5
        against = "rotation"
        phases = { turning = "cw", phi = [300, 30] }
        """
    assert dynamics_of(text).loads == (
        Load("F_{5C}", "3", "C", -6000, Fixed(-90), path="loads[0]"),
        Load("F_{2}", "2", "S2", 350.4, Against(), Phase(moving=MovingSense.DOWN), "loads[1]"),
        Couple("M_{1}", "1", 20, path="loads[2]"),
        Couple(
            "M_{1}'", "1", 5, Against(), Phase(((300, 30),), turning=TurningSense.CW), "loads[3]"
        ),
    )


def test_loads_without_a_name_have_different_letters() -> None:
    body = '[[loads]]\nlink = "3"\nat = "C"\nforce = 1\nangle = 0\n'
    names = [load.name for load in dynamics_of(body * 5).loads]
    assert names == ["F_{3}", "F_{3}'", "F_{3}''", "F_{3}^{(3)}", "F_{3}^{(4)}"]
    taken = [load.name for load in dynamics_of(body + body + 'name = "F_{3}"\n').loads]
    assert taken == ["F_{3}'", "F_{3}"]


def test_tables() -> None:
    rows = "values = [[0, 0], [90, 730], [360, 0]]"
    text = f'force = {{ over = "phi", {rows}, interpolation = "linear" }}\nangle = 90'
    assert force(text).size == SizeTable(Over.PHI, (0, 90, 360), (0, 730, 0), Interpolation.LINEAR)
    rows = "values = [[-0.1, 5], [0.2, 7]]"
    assert force(f'force = {{ over = "x", {rows}, interpolation = "step" }}\nangle = 90').size == (
        SizeTable(Over.X, (-0.1, 0.2), (5, 7), Interpolation.STEP)
    )
    found = one('link = "1"\ncouple = { over = "position", values = [1, 2, 3, 4] }')
    assert found.size == SizeTable(Over.POSITION, (), (1, 2, 3, 4), Interpolation.STEP)


def test_a_table_over_the_way_of_a_driving_slider() -> None:
    size = '{ over = "s", values = [[0.3, 1], [0.35, 2]], interpolation = "linear" }'
    assert one(f'link = "1"\ncouple = {size}', SLIDER).size == SizeTable(
        Over.S, (0.3, 0.35), (1, 2), Interpolation.LINEAR
    )


def test_several_phases() -> None:
    found = force("force = 1\nangle = 0\nphases = { phi = [[300, 30], [120, 150]] }")
    assert found.phase == Phase(((300, 30), (120, 150)))


def test_the_worked_files() -> None:
    six = problem_of("levers/six-link").dynamics
    assert six is not None
    assert (six.gravity, list(six.masses)) == (9.81, ["1", "2", "3", "5"])
    assert six.loads == (Load("F_{5C}", "5", "H", 6000, Fixed(-90), path="loads[0]"),)
    task = problem_of("levers/task12").dynamics
    assert task is not None
    assert (task.gravity, task.masses["5"]) == (9.8, Mass(30, "S5"))
    press = problem_of("press/press").dynamics
    assert press is not None
    r = abs(problem_of("press/press").bodies["1"].points["S1"])
    crank = press.masses["1"]
    assert crank.inertia + crank.mass * r**2 == pytest.approx(0.03, rel=1e-15)


def test_the_examples_of_the_documentation_are_read() -> None:
    text = DOCS.read_text(encoding="utf-8")
    given = text.split("## Masses and loads")[1].split('```toml title="loads"\n')[1].split("```")[0]
    base = CRANK.replace("links.3", "links.5")
    given = given.replace('"H"', '"C"').replace('at = "B"', 'at = "C"').replace('"3"', '"2"')
    found = dynamics_of(given, base)
    assert found.masses == {"2": Mass(40, "S2", 2), "5": Mass(50, "C")}
    assert [load.name for load in found.loads] == ["F_{5C}", "F_{5}", "M_{1}", "M_{2}"]


# Variants ----------------------------------------------------------------------------------------


def variant(text: str) -> Dynamics:
    problem = read(LOADED + text, variant="v")
    assert problem.dynamics is not None
    return problem.dynamics


@pytest.mark.parametrize(
    "text",
    [
        "v = { dynamics.links.2.mass = 30 }",
        'v = { "dynamics.links.2.mass" = 30 }',
        "[variants.v.dynamics.links.2]\nmass = 30",
    ],
)
def test_a_variant_overrides_a_mass(text: str) -> None:
    assert variant(text).masses == {"2": Mass(30, "S2")}
    assert read(LOADED + text).dynamics == dynamics_of(LOADED)


def test_a_variant_adds_masses_and_gravity() -> None:
    found = variant("v = { dynamics.gravity = false, dynamics.links.3.mass = 5 }")
    assert (found.gravity, found.masses["3"]) == (0, Mass(5, "C"))
    assert variant("v = { dynamics.resultant = true }").resultant
    text = "[variants]\nv = { dynamics.links.3.mass = 5 }"
    assert read(text, variant="v").dynamics == Dynamics(9.81, {"3": Mass(5, "C")}, ())


@pytest.mark.parametrize("key", ["loads.1.force", '"loads.F_{2}.force"', 'loads."F_{2}".force'])
def test_a_variant_overrides_a_load_by_number_or_name(key: str) -> None:
    sizes = [load.size for load in variant(f"v = {{ {key} = 20 }}").loads]
    assert sizes == [dynamics_of(LOADED).loads[0].size, 20]
    assert [load.size for load in dynamics_of(LOADED).loads][1] == 10


def test_a_variant_replaces_a_table_whole_or_one_key_of_it() -> None:
    rows = '{ over = "x", values = [[0, 1], [1, 2]], interpolation = "step" }'
    whole = variant(f"v = {{ loads.P.force = {rows} }}").loads[0].size
    assert whole == SizeTable(Over.X, (0, 1), (1, 2), Interpolation.STEP)
    key = variant('v = { "loads.P.force.interpolation" = "step" }').loads[0].size
    assert key == SizeTable(Over.PHI, (0, 90), (0, 730), Interpolation.STEP)


def test_a_variant_replaces_all_loads() -> None:
    assert variant('v = { loads = [{ link = "1", couple = 3 }] }').loads == (
        Couple("M_{1}", "1", 3, path="loads[0]"),
    )


@pytest.mark.parametrize(
    ("override", "wanted"),
    [
        ("dynamics.gravty = 9", "variants.v.dynamics.gravty: the file has no 'dynamics.gravty' to "
         "override. Did you mean 'dynamics.gravity'?"),
        ("dynamics.links.2.mas = 9", "variants.v.dynamics.links.2.mas: the file has no "
         "'dynamics.links.2.mas' to override. Did you mean 'dynamics.links.2.mass'?"),
        ("loads.2.force = 1", "variants.v.loads.2: the file has no 'loads.2' to override"),
        ("loads.R.force = 1", "variants.v.loads.R: the file has no 'loads.R' to override"),
        ("loads.P.forc = 1", "variants.v.loads.0.forc: the file has no 'loads.0.forc' to "
         "override. Did you mean 'loads.0.force'?"),
        ("loads.P.force = 1, loads.0.force = 2", "variants.v.loads.0.force: this value is "
         "overridden twice"),
        ("links.2.points.0 = 'B'", "variants.v.links.2.points.0: the file has no "
         "'links.2.points.0' to override"),
    ],
)  # fmt: skip
def test_faulty_overrides(override: str, wanted: str) -> None:
    assert messages(LOADED + f"v = {{ {override} }}") == [wanted]


@pytest.mark.parametrize(
    ("written", "letter"),
    [("P12", "P_{12}"), ("P3'", "P_{3}'"), ("Pс", "P_{с}"), ("Fрез", "F_{рез}"),
     ("Pс2'", "P_{с2}'"), ("Fmax", "Fmax"), ("P_3", "P_3"), ("2P", "2P")],
)  # fmt: skip
def test_a_number_after_the_letter_of_a_load_is_its_index(written: str, letter: str) -> None:
    assert force(f'name = "{written}"\nangle = 0\nforce = 1').name == letter
    if letter != written:
        assert parse_quantity(f"arm load {written} about O").names == (letter, "O")


def test_a_load_whose_index_is_written_in_two_ways_has_one_name() -> None:
    load = '[[loads]]\nname = "{}"\nlink = "2"\nat = "S2"\nangle = 0\nforce = 1\n'
    text = load.replace("{}", "P_{3}") + load.replace("{}", "P3")
    assert "loads[0] is also named P_{3}" in messages(text)[0]
