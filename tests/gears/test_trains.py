"""Speeds of random trains against formulas and contact points; teeth, efficiency, conditions."""

from __future__ import annotations

import random
from collections.abc import Callable
from fractions import Fraction
from pathlib import Path
from types import MappingProxyType

import pytest
from cases import each
from doors import (
    TrainKind,
    TrainMotion,
    answer,
    conditions,
    draw,
    efficiency,
    max_planets,
    solve,
    tabular,
)
from scales import is_round
from trains import MAKERS, Made, bevel, solved

SEEDS = range(100)  # 500 trains
EXTERNAL_RING = 'wheels = { 1 = 20, 2 = 40, 3 = 100 }\nmeshes = [{ of = [1, 2], carrier = "H"%s },\
 { of = [2, 3], kind = "internal", carrier = "H"%s }]\nfixed = ["3"]\n'
SET = EXTERNAL_RING % ("", "")


@each("maker, seed", [(maker, seed) for maker in MAKERS for seed in SEEDS])
def test_speeds_are_those_of_the_step_by_step_formulas(
    maker: Callable[[random.Random], Made], seed: int, tmp_path: Path
) -> None:
    made = maker(random.Random(f"{maker} {seed}".partition(" at ")[0] + str(seed)))
    motion = solved(tmp_path, made.text)
    for label, speed in made.speeds.items():
        assert motion.speed(label) == speed, (made.text, label)
    for turns in tabular(motion):
        sums = {
            body: speed + turns.held_speeds[body] for body, speed in turns.locked_speeds.items()
        }
        assert sums == {body: motion.speeds[body] for body in sums}
        assert turns.held_speeds[turns.carrier] == 0
    if maker is not bevel:
        assert_contacts_meet(motion)


def assert_contacts_meet(motion: TrainMotion) -> None:
    """Both wheels of a mesh have one velocity where they touch, a distance of radii from each."""
    train, axes = motion.train, motion.axes
    carried = {b: c for m in train.meshes for b in train.ends(m) if (c := train.carrier(m))}

    def velocity(body: str, y: Fraction) -> Fraction:
        centre = axes.heights[body]
        of_axis = -motion.speeds[carried[body]] * centre if body in carried else Fraction(0)
        return of_axis - motion.speeds[body] * (y - centre)

    for mesh in train.meshes:
        one, other = train.ends(mesh)
        r_1, r_2 = axes.sizes[mesh.first], axes.sizes[mesh.second]
        touching = {axes.heights[one] + s * r_1 for s in (1, -1)} & {
            axes.heights[other] + s * r_2 for s in (1, -1)
        }
        assert any(velocity(one, y) == velocity(other, y) for y in touching), mesh
    picture = draw(motion)
    if picture is None:
        assert not any(motion.speeds.values())
        return
    assert 24 <= max(abs(point.speed_mm) for point in picture.contacts) <= 60 + 1e-9
    assert is_round(picture.mu_v)
    assert is_round(picture.ray_scale(train.unit)[1])
    for ray, segment in picture.rays:
        assert (segment > 0) == (motion.speed(ray) > 0)


@each("seed", range(20))
def test_bevel_wheels_have_one_velocity_where_they_touch(seed: int, tmp_path: Path) -> None:
    """Vectors in space: a planet gear square to the main axis z, 1 below it and 3 above."""
    motion = solved(tmp_path, bevel(random.Random(seed)).text)
    z = {label: float(size) for label, size in motion.axes.sizes.items()}
    n = {label: float(motion.speed(label)) for label in ("1", "2", "3", "H")}
    satellite = (n["2"], 0.0, n["H"])
    for central, rim, up in (("1", "2", -1), ("3", "2'", 1)):
        at = (z[central], 0.0, up * z[rim])
        assert cross((0.0, 0.0, n[central]), at) == pytest.approx(cross(satellite, at), abs=1e-9)


def cross(a: tuple[float, ...], b: tuple[float, ...]) -> tuple[float, ...]:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def test_an_axis_turns_the_sense_of_a_bevel_wheel(tmp_path: Path) -> None:
    """Both central wheels on one side of the planet gear turn in the same sense."""
    text = (
        'wheels = {{ 1 = 20, 2 = 10, "2\'" = 20, 3 = {{ z = 20, axis = [0, 0, {}] }} }}\n'
        'meshes = [{{ of = [1, 2], kind = "bevel", carrier = "H" }},'
        ' {{ of = ["2\'", 3], kind = "bevel", carrier = "H" }}]\nn = {{ 1 = 1, H = 0 }}\n'
    )
    assert solved(tmp_path, text.format(1)).speed("3") == -2
    assert solved(tmp_path, text.format(-1)).speed("3") == 2


@pytest.mark.parametrize(("main", "side"), [("0, 0, 1", "1, 0, 0"), ("-1, 0, 0", "0, 1, 0")])
def test_axes_are_vectors_of_any_frame(main: str, side: str, tmp_path: Path) -> None:
    text = (
        f"wheels = {{ 1 = {{ z = 20, axis = [{main}] }}, 2 = {{ z = 15, axis = [{side}] }},"
        " 3 = 20 }\n"
        'meshes = [{ of = [1, 2], kind = "bevel", carrier = "H" },'
        ' { of = [2, 3], kind = "bevel", carrier = "H" }]\nn = { 1 = 100, H = 60 }\n'
    )
    turned = ", ".join(str(-int(x)) for x in main.split(", "))
    told = text.replace("3 = 20 }", f"3 = {{ z = 20, axis = [{turned}] }} }}")
    assert solved(tmp_path, told).speed("3") == 20


def test_pulleys_with_radii_drive_wheels_with_teeth(tmp_path: Path) -> None:
    text = 'wheels = { 1 = { r = 0.05 }, 2 = { r = 0.15 }, "2\'" = 20, 3 = 40 }\nmeshes = [\
{ of = [1, 2], kind = "belt" }, { of = ["2\'", 3] }]\nn = { 1 = 60 }\n'
    motion = solved(tmp_path, text)
    assert motion.speed("3") == -10
    assert (answer(motion, "z_1").reason, answer(motion, "r_2").value) == ("teeth", 150)
    assert not [one for one in conditions(motion) if one.name == "coaxiality"]


def test_a_row_of_any_length_and_a_planet_gear_as_input(tmp_path: Path) -> None:
    wheels = ", ".join(f"{k} = {19 + k}" for k in range(1, 21))
    meshes = ", ".join(f"{{ of = [{k}, {k + 1}] }}" for k in range(1, 20))
    row = solved(tmp_path, f"wheels = {{ {wheels} }}\nmeshes = [{meshes}]\nn = {{ 1 = 39 }}\n")
    assert row.speed("20") == -20
    assert solved(tmp_path, SET + "n = { 2 = 10 }\n").speed("1") == -40


@pytest.mark.parametrize(
    ("kind", "n_2"),
    [("belt", "1/2"), ("chain", "1/2"), ("crossed belt", "-1/2"), ("worm", "1/2")],
)
def test_other_meshes(kind: str, n_2: str, tmp_path: Path) -> None:
    text = f'wheels = {{ 1 = 20, 2 = 40 }}\nmeshes = [{{ of = [1, 2], kind = "{kind}" }}]\n'
    motion = solved(tmp_path, text + "n = { 1 = 1 }\n")
    assert motion.speed("2") == Fraction(n_2)
    assert draw(motion) is None
    if kind == "worm":
        left = text.replace('"worm"', '"worm", hand = "left"') + "n = { 1 = 1 }\n"
        assert solved(tmp_path, left).speed("2") == -Fraction(n_2)


def test_a_rack_has_a_speed_where_there_is_a_module(tmp_path: Path) -> None:
    text = 'wheels = { 1 = 20 }\nmeshes = [{ of = [1, 2], kind = "rack" }]\nomega = { 1 = 3 }\n'
    assert answer(solved(tmp_path, text), "v_2").reason == "module"
    motion = solved(tmp_path, text + "module = 5\n")
    assert answer(motion, "v_2").value == pytest.approx(3 * 0.05)
    assert answer(motion, "U_1_2").reason == "rack"


@pytest.mark.parametrize("unknown", ["1", "2", "3"])
def test_any_one_size_of_a_set_follows_from_the_others(unknown: str, tmp_path: Path) -> None:
    teeth = {"1": 20, "2": 40, "3": 100}
    given = ", ".join(f"{label} = {z}" for label, z in teeth.items() if label != unknown)
    text = SET.replace("1 = 20, 2 = 40, 3 = 100", given) + f'unknown = ["{unknown}"]\n'
    motion = solved(tmp_path, text + "n = { 1 = 6 }\n")
    assert motion.axes.sizes == teeth
    assert motion.speed("H") == 1


def test_coaxial_wheels_determine_unknown_teeth(tmp_path: Path) -> None:
    """2.2.2: two wheels in a ring of a train with fixed axes, a_w with the module."""
    text = "wheels = { 1 = 20, 2 = 18 }\nmeshes = [{ of = [1, 2] }, { of = [2, 3], kind = \
'internal' }]\nunknown = ['3']\nmodule = 6\nn = { 1 = 1 }\n"
    motion = solved(tmp_path, text)
    assert motion.axes.sizes["3"] == 56
    assert answer(motion, "U_13").exact == Fraction(-14, 5)
    assert answer(motion, "a_w_1_2").value == 114
    assert answer(motion, "r_3").value == 168


def test_an_idler_between_wheels_of_one_axis_gets_its_teeth_from_it(tmp_path: Path) -> None:
    """2.2.9: 2' and 4 turn about one axis, 3 between them; z_3 = (90 - 24)/2."""
    text = "wheels = { 1 = 22, 2 = 86, \"2'\" = 24, 4 = 90 }\nmeshes = [{ of = [1, 2] }, { of = \
[\"2'\", 3] }, { of = [3, 4], kind = 'internal' }]\nunknown = ['3']\nn = { 1 = 1240 }\n"
    motion = solved(tmp_path, text)
    assert motion.axes.sizes["3"] == 33
    assert float(motion.speed("4")) == pytest.approx(84.589147)


def test_sets_in_series_and_a_second_name_of_a_carrier(tmp_path: Path) -> None:
    """2.2.76: the carrier of the first set drives the second; both planet gears are unknown."""
    text = "wheels = { 1 = 22, 3 = 72, 4 = 22, 6 = 72 }\nmeshes = [{ of = [1, 2], carrier = 4 },\
 { of = [2, 3], kind = 'internal', carrier = 4 }, { of = [4, 5], carrier = 'H2' },\
 { of = [5, 6], kind = 'internal', carrier = 'H2' }]\nbodies = [['4', 'H1']]\n\
fixed = ['3', '6']\nunknown = ['2', '5']\nn = { 1 = 2100 }\n"
    motion = solved(tmp_path, text)
    for name in ("U_1_H2", "U_1_H_2", "U_1H2"):
        assert answer(motion, name).exact == Fraction(47, 11) ** 2
    assert answer(motion, "z_5").exact == 25
    assert motion.speed("H1") == motion.speed("4")
    assert motion.structure.kind is TrainKind.PLANETARY


def test_ordinary_and_planetary_trains_are_distinguished(tmp_path: Path) -> None:
    planetary = solved(tmp_path, SET + "n = { 1 = 1 }\n")
    assert planetary.structure.kind is TrainKind.PLANETARY
    assert (planetary.structure.formula, planetary.structure.redundant) == (1, 0)
    held = SET.replace('["3"]', '["H"]')
    assert solved(tmp_path, held + "n = { 1 = 1 }\n").structure.kind is TrainKind.ORDINARY


def test_assembly_and_neighbourhood_of_planet_gears(tmp_path: Path) -> None:
    """(20 + 100)/k is whole, and sin(180/k) > 42/60 only up to three."""
    motion = solved(tmp_path, SET + "satellites = 4\nn = { 1 = 1 }\n")
    judged = {one.name: one.is_satisfied for one in conditions(motion)}
    assert judged["assembly"]
    assert not judged["neighbourhood"] or max_planets(motion, "H") == 4
    assert max_planets(motion, "H") == 4  # 0.7071 > 0.7
    assert answer(motion, "k_H").exact == 4
    five = solved(tmp_path, SET + "satellites = { H = 7 }\nn = { 1 = 1 }\n")
    assert not any(one.is_satisfied for one in conditions(five) if one.name == "assembly")


def test_undercutting_is_reported_and_a_shift_avoids_it(tmp_path: Path) -> None:
    text = "wheels = {{ 1 = {}, 2 = 30 }}\nmeshes = [{{ of = [1, 2] }}]\nn = {{ 1 = 1 }}\n"
    said = [one.name for one in conditions(solved(tmp_path, text.format(12)))]
    assert said == ["undercutting"]
    assert not conditions(solved(tmp_path, text.format("{ z = 12, x = 0.3 }")))


# Efficiency --------------------------------------------------------------------------------------


def test_the_tabular_method_turns_the_fixed_wheel_back(tmp_path: Path) -> None:
    """+1 turn of all, -1 of the ring with the carrier held: wheel 1 by +5, in all 6."""
    (turns,) = tabular(solved(tmp_path, SET + "n = { H = 1 }\n"))
    assert turns.started == ("3",)
    assert turns.locked_speeds == dict.fromkeys(("H", "1", "2", "3"), 1)
    assert turns.held_speeds == {"H": 0, "1": 5, "2": Fraction(-5, 2), "3": -1}
    assert not tabular(solved(tmp_path, SET.replace('["3"]', '["H"]') + "n = { 1 = 1 }\n"))


def test_the_efficiency_of_a_set_is_that_of_the_textbook(tmp_path: Path) -> None:
    """Wheel 1 drives: eta = (1 - eta_0 U_13)/(1 - U_13), U_13 = -5, eta_0 = 0.97*0.98."""
    text = EXTERNAL_RING % (", eta = 0.97", ", eta = 0.98") + 'output = "H"\nn = { 1 = 100 }\n'
    inner = Fraction("0.97") * Fraction("0.98")
    assert efficiency(solved(tmp_path, text)) == (1 + 5 * inner) / 6
    back = text.replace('"H"\nn = { 1', '"1"\nn = { H')
    assert efficiency(solved(tmp_path, back)) == 6 / (1 + 5 / inner)


def test_the_efficiency_of_a_row_is_the_product(tmp_path: Path) -> None:
    text = 'wheels = { 1 = 20, 2 = 40, 3 = 30 }\nmeshes = [{ of = [1, 2], eta = 0.9 },\
 { of = [2, 3], eta = 0.8 }]\noutput = "3"\nn = { 1 = -7 }\n'
    assert efficiency(solved(tmp_path, text)) == Fraction("0.72")
    assert answer(solved(tmp_path, text.replace("0.9", "1").replace("0.8", "1")), "eta").value == 1


def test_a_train_that_locks_itself_has_no_efficiency(tmp_path: Path) -> None:
    """U_1H = 1 - 99·101/100² is small: driven from wheel 1 the losses stop it."""
    text = "wheels = { 1 = 99, 2 = 100, \"2'\" = 99, 3 = 100 }\nmeshes = [{ of = [1, 2], carrier =\
 'H', eta = 0.98 }, { of = [\"2'\", 3], carrier = 'H', eta = 0.98 }]\nfixed = ['3']\n\
output = 'H'\nn = { 1 = 1 }\n"
    assert efficiency(solved(tmp_path, text)) is None


def test_equations_in_fractions() -> None:
    one, two = Fraction(1), Fraction(2)
    found = solve(("a", "b", "c"), [({"a": one, "b": two}, Fraction(5)), ({"b": two}, two)])
    assert dict(found.values) == {"a": 3, "b": 1}
    assert (found.free, found.rank) == (("c",), 2)
    assert not solve(("a",), [({"a": one}, one), (MappingProxyType({"a": two}), one)]).consistent


def test_the_distance_of_shifted_wheels_is_that_of_the_standard(tmp_path: Path) -> None:
    text = "wheels = {{ 1 = {{ z = 20, x = {} }}, 2 = {{ z = 60, x = {} }} }}\nmodule = 5\n"
    text += 'meshes = [{{ of = [1, 2], kind = "{}" }}]\nn = {{ 1 = 1 }}\n'
    for kind, shifts, due in (
        ("external", (0.4, 0.4), 203.75037),
        ("internal", (0.72, 1.4), 103.07584),
    ):
        found = answer(solved(tmp_path, text.format(*shifts, kind)), "a_w_1_2")
        assert found.value == pytest.approx(due, abs=1e-4)
        assert found.exact is None
    alike = answer(solved(tmp_path, text.format(0.3, -0.3, "external")), "a_w_1_2")
    assert alike.exact == 200
    near = answer(solved(tmp_path, text.format(-5, -5, "external")), "a_w_1_2")
    assert (near.value, near.reason) == (None, "wheel")
