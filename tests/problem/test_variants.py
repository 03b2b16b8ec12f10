from __future__ import annotations

from pathlib import Path

import pytest
from doors import (
    AssemblyRelation,
    ProblemError,
    ProblemProblem as Problem,
    Rule,
    moving_reader_load as load,
    problem_loads as loads,
)

TEXT = """
title = "Основная часть"
[frame]
O = [0, 0]
C = [0.3, 0]
guides.x-x = { through = "O", angle = 0 }
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B", "D"]
AB = 0.25
D = { on = "AB", at = 0.1 }
[links.3]
points = ["C", "B"]
CB = 0.2
[driver]
link = "1"
phi = { from = 0, count = 12 }
n = 60
[assembly]
B = "left of AC"
[stamp]
group = "M-1"
[published."v_A"]
value = 1
[variants]
"""


def read(variants: str, name: str | None = None) -> Problem:
    return loads(TEXT + variants, name="v", variant=name)


def test_names_in_file_order_and_the_main_part_untouched() -> None:
    problem = read('"Б" = { driver.phi = 120 }\n"А" = { driver.phi = 60 }')
    assert problem.variants == ("Б", "А")
    assert problem.variant is None
    assert len(problem.drive.positions) == 12
    assert len(problem.published) == 1


def test_a_dotted_key_overrides() -> None:
    problem = read('"Б" = { driver.phi = 120, links.1.OA = 0.05 }', "Б")
    assert problem.variant == "Б"
    assert problem.drive.positions == (120,)
    assert problem.bodies["1"].points["A"] == 0.05
    assert problem.published == ()


def test_quoted_and_plain_keys_mean_the_same() -> None:
    plain = read("v = { links.2.D.at = 0.2 }", "v")
    quoted = read('v = { "links.2.D.at" = 0.2 }', "v")
    table = read("v = { links = { 2 = { D = { at = 0.2 } } } }", "v")
    assert plain == quoted == table
    assert plain.bodies["2"].points["D"] == 0.2


def test_spans_rules_and_places_are_replaced_whole() -> None:
    text = "v = { driver.phi = { from = 0, to = 90, step = 45 }, assembly.B = { near = [1, 2] } }"
    problem = read(text, "v")
    assert problem.drive.positions == (0, 45, 90)
    assert problem.assembly == (Rule("B", AssemblyRelation.NEAR, at=1 + 2j),)


def test_a_key_of_a_span_may_be_overridden_alone() -> None:
    assert len(read('v = { "driver.phi.count" = 24 }', "v").drive.positions) == 24


def test_omega_replaces_n() -> None:
    assert read("v = { driver.omega = 3 }", "v").drive.rate == 3


def test_keys_that_the_main_part_lacks_may_be_added() -> None:
    text = "v = { driver.epsilon = 2, frame.E = [1, 1], scales.mu_l = 0.001, source = 'x' }"
    problem = read(text, "v")
    assert problem.drive.acceleration == 2
    assert problem.scales.mu_l == 0.001
    assert problem.source == "x"


def test_published_values_stay_where_the_motion_is_the_same() -> None:
    assert len(read("v = { stamp.group = 'M-2' }", "v").published) == 1
    own = read("v = { driver.phi = 3, published.v_A.value = 2 }", "v")
    assert [item.value for item in own.published] == [2]


def test_published_values_stay_where_only_a_slider_has_another_length() -> None:
    text = TEXT.replace(
        "[links.3]", '[links.4]\npoints = ["D"]\nslides = { on = "x-x" }\n[links.3]'
    )

    def kept(variants: str) -> int:
        return len(loads(text + variants, name="v", variant="v").published)

    assert kept("v = { links.4.slides.length = 0.06 }") == 1
    assert kept("v = { links.4.slides.offset = 0.06 }") == 0


LOADED = TEXT.replace(
    "[variants]",
    """[published]
"v" = { value = 2, what = "v A" }
"F" = { value = 3, what = "F 2 1" }
"h" = { value = 4, what = "M 2 1 / F 2 1" }
"listed" = { value = 5 }
[dynamics.links.2]
mass = 2
centre = "D"
[[loads]]
name = "P"
link = "3"
at = "B"
force = 10
angle = 0
[variants]
""",
).replace('[published."v_A"]\nvalue = 1\n', "")


@pytest.mark.parametrize(
    ("variant", "kept"),
    [
        ('"stamp.group" = "M-2"', ["v", "F", "h", "listed"]),
        ("dynamics.links.2.mass = 3", ["v", "listed"]),
        ("dynamics.gravity = 9.8", ["v", "listed"]),
        ("loads.P.force = 5", ["v", "listed"]),
        ("loads.P.force = 5, published.F.value = 6", ["v", "listed", "F"]),
        ("driver.omega = 5, loads.P.force = 5", []),
    ],
)
def test_published_forces_stay_where_masses_and_loads_are_the_same(
    variant: str, kept: list[str]
) -> None:
    problem = loads(f"{LOADED}v = {{ {variant} }}", name="v", variant="v")
    assert [item.name for item in problem.published] == kept


def test_an_override_is_read_with_all_checks() -> None:
    with pytest.raises(ProblemError) as caught:
        read("v = { links.1.OA = -1 }", "v")
    assert [str(fault) for fault in caught.value.faults] == [
        "links.1.OA: expected a length in metres greater than 0, got -1"
    ]


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ("driver.ph = 3", "variants.v.driver.ph: the file has no 'driver.ph' to override. "
         "Did you mean 'driver.phi'?"),
        ("links.1.length = 3", "variants.v.links.1.length: the file has no 'links.1.length' to "
         "override"),
        ("frame.guides.x-x.dir = 3", "variants.v.frame.guides.x-x.dir: the file has no "
         "'frame.guides.x-x.dir' to override"),
        ("stamp.autor = 'x'", "variants.v.stamp.autor: the file has no 'stamp.autor' to override. "
         "Did you mean 'stamp.author'?"),
        ("variants.u.driver.phi = 3", "variants.v.variants.u: a variant cannot hold variants"),
        ('driver.phi.from = 1, "driver.phi.from" = 2', "variants.v.driver.phi.from: this value is "
         "overridden twice"),
    ],
)  # fmt: skip
def test_faults(override: str, message: str) -> None:
    with pytest.raises(ProblemError) as caught:
        read(f"v = {{ {override} }}")
    assert [str(fault) for fault in caught.value.faults] == [message]


@pytest.mark.parametrize(
    ("asked", "hint"),
    [
        ("С1", "Did you mean 'C1' in the other layout (Russian or Latin)?"),
        ("A", "Did you mean 'А' in the other layout (Russian or Latin)?"),
        ("Г", "There are А, Б, C1."),
    ],
)
def test_unknown_variant(asked: str, hint: str) -> None:
    text = '"А" = { driver.phi = 1 }\n"Б" = { driver.phi = 2 }\nC1 = { driver.phi = 3 }'
    with pytest.raises(ProblemError) as caught:
        read(text, asked)
    assert str(caught.value.faults[0]) == f"variants: variant '{asked}' does not exist. {hint}"


def test_no_variants_at_all() -> None:
    with pytest.raises(ProblemError, match="The file has no variants"):
        read("", "Б")


@pytest.mark.parametrize("header", ["[variants.Б]", '[variants."Б"]', "  [ variants . Б ]"])
def test_a_russian_name_needs_no_quotes(header: str) -> None:
    assert read(f"{header}\ndriver.phi = 30\n", "Б").drive.positions == (30.0,)


def test_a_table_of_variants_beside_a_moving_point_is_read_too(tmp_path: Path) -> None:
    (tmp_path / "v.csv").write_text("variant,point.t\n1,2\nБ,3\n", encoding="utf-8")
    file = tmp_path / "point.toml"
    file.write_text('variants = "v.csv"\n[point]\nx = "3*t"\ny = "t^2"\nt = 1\n', encoding="utf-8")
    problem = load(file, variant="Б")
    assert (problem.variants, problem.variant, problem.times) == (("1", "Б"), "Б", (3.0,))
