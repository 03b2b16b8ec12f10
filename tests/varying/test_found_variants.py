"""Variants that the program chooses: checked by formulas of the mechanisms, not by the program."""

from __future__ import annotations

import cmath
import csv
import math
import re
import tomllib
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from itertools import permutations
from pathlib import Path
from random import Random

import pytest
from cases import sampled
from click.testing import CliRunner, Result
from doors import (
    DEFAULT,
    LINKAGES,
    ModelProblem as Problem,
    Rejection,
    RejectionReason,
    Solution,
    Task,
    ValueSampler,
    VariantCandidates,
    VariantChoice,
    VariantSearch,
    choice_choose as choose,
    cli,
    coaxial_rows,
    default_keys,
    evaluator_of,
    free_scales,
    gears_reader_load as load,
    key_of_task,
    kind_of,
    overrides,
    parse_vary,
    solve_motion,
    task_of_problem,
    variant_names,
    with_followers,
)
from worked import PROBLEMS, path_of

EX3 = path_of("linkages/ex3")
SIX_LINK = path_of("levers/six-link")
TRAIN = PROBLEMS / "gears/gears-ex1.toml"
PLANETARY = PROBLEMS / "gears/gears-ex3.toml"
POINT = PROBLEMS / "point/k11-01.toml"
FIRST = (1, 1.05, 1.1, 1.15, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9, 2, 2.1, 2.2, 2.4, 2.5, 2.6)
THEN = (2.8, 3, 3.2, 3.4, 3.6, 3.8, 4, 4.2, 4.5, 4.8, 5, 5.3, 5.6, 6, 6.3, 6.7, 7.1, 7.5, 8, 8.5)
RA40 = {f"{number:g}" for number in (*FIRST, *THEN, 9, 9.5)}


def run(*args: object) -> Result:
    return CliRunner().invoke(cli, ["variants", *map(str, args)])


def beside(folder: Path, problem: Path, table: Path) -> Path:
    """Return a copy of a problem that names a table of variants."""
    copy = folder / problem.name
    text = problem.read_text("utf-8").partition("[variants]")[0]
    copy.write_text(f'variants = "{table.name}"\n{text}', "utf-8")
    return copy


def rows_of(table: Path) -> list[dict[str, float]]:
    with table.open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    return [{key: float(value) for key, value in row.items() if key != "variant"} for row in rows]


def tasks_of(path: Path) -> list[Task]:
    """Return the tasks of all variants of a file, as check reads them."""
    kind, names = kind_of(path), variant_names(path)
    return [task_of_problem(kind, one, DEFAULT) for one in kind.load_each(path, names)]


@pytest.fixture(scope="module")
def of_ex3(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    folder = tmp_path_factory.mktemp("ex3")
    table = folder / "table.csv"
    done = run(EX3, "--count", 6, "--seed", 7, "-o", table, "--lang", "en")
    assert done.exit_code == 0, done.output
    return beside(folder, EX3, table), done.output


def ex3_segments(row: dict[str, float]) -> Iterator[tuple[str, float, float]]:
    """Yield the answers of example 3 by its own formulas: name, value, mm on the sheet."""
    ab, cd, de = (row[f"links.{n}"] for n in ("1.AB", "3.CD", "4.DE"))
    turn, omega, c = cmath.exp(1j * math.radians(row["driver.phi"])), row["driver.omega"], -0.11j
    b, v_b, a_b = ab * turn, 1j * omega * ab * turn, -(omega**2) * ab * turn
    r = b - c
    u = r / abs(r)
    w3 = (v_b * u.conjugate()).imag / abs(r)
    slide = (v_b * u.conjugate()).real
    e3 = ((a_b * u.conjugate()).imag - 2 * w3 * slide) / abs(r)
    d = c + cd * u
    v_d, a_d = 1j * w3 * (d - c), (1j * e3 - w3**2) * (d - c)
    assert 1 - (d.imag / de) ** 2 >= 0.1, "assembles with a margin"
    e = d.real + math.sqrt(de**2 - d.imag**2)
    x = e - d
    w4 = -v_d.imag / x.real
    v_ed = 1j * w4 * x
    e4 = (-a_d.imag + w4**2 * x.imag) / x.real
    speeds = (
        ("v_B", v_b),
        ("v_B3", 1j * w3 * r),
        ("vs", slide),
        ("v_D", v_d),
        ("v_ED", v_ed),
        ("v_E", v_d + v_ed),
    )
    a_e = a_d + (1j * e4 - w4**2) * x
    rates = (
        ("a_B", a_b), ("ak", 2 * w3 * slide), ("an_B3C", w3**2 * abs(r)), ("at_B3C", e3 * abs(r)),
        ("a_D", a_d), ("an_ED", w4**2 * de), ("at_ED", e4 * de), ("a_E", a_e),
    )  # fmt: skip
    for scale, found in (("scales.mu_v", speeds), ("scales.mu_a", rates)):
        yield from ((name, abs(value), abs(value) / row[scale]) for name, value in found)


def test_variants_of_a_linkage_assemble_and_are_long_enough_by_its_own_formulas(
    of_ex3: tuple[Path, str],
) -> None:
    rows = rows_of(of_ex3[0].with_name("table.csv"))
    assert len(rows) == 6
    for row in rows:
        found = list(ex3_segments(row))
        assert len(found) == 14
        assert all(mm >= 5 - 1e-9 for _, _, mm in found), (row, found)
        assert row["driver.phi"] % 5 == 0
        for key in ("links.1.AB", "links.3.CD", "links.4.DE"):
            power = math.floor(math.log10(row[key]) + 1e-12)
            assert f"{row[key] / 10**power:.4g}" in RA40
        for key in ("scales.mu_l", "scales.mu_v", "scales.mu_a"):
            assert f"{row[key]:e}".rstrip("0").split("e")[0].rstrip("0").rstrip(".") in [
                "1",
                "2",
                "2.5",
                "4",
                "5",
            ]


def test_every_position_of_the_crank_is_judged_by_independent_formulas() -> None:
    source = VariantCandidates(EX3, LINKAGES)
    (main,) = source.read({})
    assert isinstance(main, Problem)
    places = {
        f"{phi}-{1000 * rod:.0f}": {"driver.phi": phi, "links.4.DE": rod}
        for phi in sampled(range(0, 360, 5), 3)
        for rod in (0.18, 0.115, 0.105)
    }
    problems = [one for one in source.read(places) if isinstance(one, Problem)]
    why = Counter[str]()
    for problem, one in zip(
        problems, evaluator_of(LINKAGES, main, DEFAULT).evaluate(problems), strict=True
    ):
        row = {"driver.phi": problem.drive.positions[0], "driver.omega": 50.0}
        lengths = {"links.1.AB": 0.064, "links.3.CD": 0.22}
        lengths["links.4.DE"] = abs(
            problem.bodies["4"].points["E"] - problem.bodies["4"].points["D"]
        )
        row |= lengths
        reason = one.reason if isinstance(one, Rejection) else None
        why[str(reason)] += 1
        try:
            list(ex3_segments({**row, "scales.mu_v": 1.0, "scales.mu_a": 1.0}))
        except (AssertionError, ValueError):
            assert reason in (RejectionReason.MARGIN, RejectionReason.ASSEMBLY)
            continue
        scales = Solution(free_scales(problem)).scales.values()
        row |= {f"scales.{scale.symbol}": scale.per_mm for scale in scales}
        shortest = min(mm for _, _, mm in ex3_segments(row))
        assert (reason is RejectionReason.SHORT) is (shortest < 5), (row, one)
    assert len(problems) == len(places) and why[str(RejectionReason.SHORT)] > 10


def test_the_program_reads_the_table_and_finds_the_same(of_ex3: tuple[Path, str]) -> None:
    rows = rows_of(of_ex3[0].with_name("table.csv"))
    for row, task in zip(rows, tasks_of(of_ex3[0]), strict=True):
        entries = {entry.id: entry for entry in key_of_task(task).entries}
        own = {name: value for name, value, _ in ex3_segments(row)}
        for mine, theirs in (
            ("v_ED", "v_E_D"),
            ("a_E", "a_E"),
            ("at_B3C", "at_B3_C"),
            ("ak", "ak_B3_B"),
        ):
            assert abs(entries[theirs].exact) == pytest.approx(own[mine], rel=1e-9)
        assert all(entry.sigma <= 0.1 * abs(entry.exact) for entry in entries.values())


@pytest.mark.parametrize("problem", [EX3, PLANETARY, POINT], ids=lambda path: path.stem)
def test_copying_a_variant_loses_most_points(problem: Path, tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    assert run(problem, "--count", 5, "--seed", 3, "-o", table, "--lang", "en").exit_code == 0
    keys = [key_of_task(task) for task in tasks_of(beside(tmp_path, problem, table))]
    assert len(keys) == 5
    for mine, other in permutations(keys, 2):
        copied = {entry.id: entry.exact for entry in other.entries}
        still = {entry.id for entry in mine.entries if entry.id == "W"}
        lost = sum(
            e.points
            for e in mine.entries
            if e.id not in still
            and (abs(abs(copied[e.id]) - abs(e.exact)) > e.tolerance or copied[e.id] * e.exact < 0)
        )
        whole = sum(e.points for e in mine.entries if e.id not in still)
        assert lost >= 0.6 * whole - 1e-9


def test_a_mistake_that_a_variant_distinguishes_is_off_by_more_than_a_pencil(
    tmp_path: Path,
) -> None:
    source, found = choose(EX3, VariantSearch(count=4, seed=5))
    path = tmp_path / EX3.name
    path.write_text(
        source.with_variants({one.name: one.overrides for one in found.variants}), "utf-8"
    )
    for one, task in zip(found.variants, tasks_of(path), strict=True):
        key, (sheet,) = key_of_task(task), {task.sheet(item.position) for item in task.list_items()}
        seen, made = set(), set()
        for mistake in task.named(sheet):
            made.add((mistake.code, mistake.mistake_at))
            for entry, item in zip(key.entries, task.list_items(), strict=True):
                value = mistake.values[item.question.id]
                off = abs(abs(value) - abs(entry.exact)) > max(entry.tolerance, 2.5 * entry.sigma)
                if off or (entry.asks_sense and value * entry.exact < 0):
                    seen.add((mistake.code, mistake.mistake_at))
        assert made - set(one.indistinct) <= seen
        assert len(made - set(one.indistinct)) >= found.family > 25


# Loads -------------------------------------------------------------------------------------------


def test_a_linkage_with_loads_has_its_reactions_judged(tmp_path: Path) -> None:
    text = re.sub(r"(?s)\[published\].*", "", SIX_LINK.read_text("utf-8"))
    path = tmp_path / "loaded.toml"
    path.write_text(
        text
        + '\n[[answers]]\nwhat = "v C"\n[[answers]]\nwhat = "a C"\n[[answers]]\nwhat = "F 5 0"\n'
        '[[answers]]\nwhat = "balance"\nsense = true\n',
        "utf-8",
    )
    out = tmp_path / "whole.toml"
    done = run(path, "--count", 3, "--seed", 7, "-o", out, "--lang", "en")
    assert done.exit_code == 0, done.output
    for task in tasks_of(out):
        for entry in key_of_task(task).entries:
            assert entry.mm is None or entry.mm >= 5
            assert entry.sigma <= 0.1 * abs(entry.exact)
    own = tomllib.loads(out.read_text("utf-8"))["variants"]["1"]
    share = own["links.2.S2.at"] / own["links.2.BC"]
    assert share == pytest.approx(0.2 / 0.3, rel=0.05), "the centre of mass keeps its place"


# Trains and points -------------------------------------------------------------------------------


@pytest.mark.dear
@pytest.mark.parametrize("name", ["linkages/ex3", "levers/task-12", "levers/task-1"])
def test_candidates_judged_together_are_judged_as_alone(name: str) -> None:
    path = path_of(name)
    source = VariantCandidates(path, LINKAGES)
    chosen = with_followers(source.table, default_keys(source.table, 0.1))
    lots = ValueSampler(chosen, Random(3))
    drawn = [overrides(source.table, lots.with_followers(lots.draw())) for _ in range(60)]
    (main,) = source.read({})
    assert isinstance(main, Problem)
    judge = evaluator_of(LINKAGES, main, DEFAULT)
    read = source.read({str(k): own for k, own in enumerate(drawn)})
    problems = [one for one in read if isinstance(one, Problem)]
    together = list(judge.evaluate(problems))
    for problem, found in sampled([*zip(problems, together, strict=True)], 3):
        (alone,) = judge.evaluate([problem])
        if isinstance(found, Rejection) or isinstance(alone, Rejection):
            assert isinstance(found, Rejection) and isinstance(alone, Rejection)
            # Among others, the motion of a loaded candidate is examined first, then its forces.
            assert found.reason is alone.reason or problem.dynamics is not None, problem.variant
            continue
        assert (found.distinguished, found.possible, found.scales) == (
            alone.distinguished,
            alone.possible,
            alone.scales,
        )
        assert found.exact == pytest.approx(dict(alone.exact), rel=1e-9)
        assert found.allowed == pytest.approx(dict(alone.allowed), rel=1e-6)
    assert any(not isinstance(one, Rejection) for one in together)


def test_trains_are_coaxial_and_whole_by_their_teeth(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    assert run(TRAIN, "--count", 20, "--seed", 7, "-o", table, "--lang", "en").exit_code == 0
    rows = rows_of(table)
    assert len(rows) == 20
    for row in rows:
        z = {key.removeprefix("gears.wheels."): int(value) for key, value in row.items()}
        second = z["1"] + z["2"] - z["3"]  # the teeth of 2', which the file leaves to coaxiality
        ring = z["3'"] + 2 * z["4"]
        assert second >= 17 and ring - z["4"] >= 8
        assert all(n == int(n) for n in z.values())
        assert min(z["2"], z["3"], z["3'"], z["4"]) >= 17 and z["1"] >= 16  # as in the file


def test_both_ways_to_a_wheel_of_a_planetary_stage_are_as_long(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    assert run(PLANETARY, "--count", 8, "--seed", 7, "-o", table, "--lang", "en").exit_code == 0
    for row in rows_of(table):
        z = {key.removeprefix("gears.wheels."): value for key, value in row.items()}
        assert z["6"] + z["5'"] == z["5"] + z["4"]
        assert z["7"] - z["6'"] >= 8
        assert min(z.values()) >= 17


def test_numbers_of_formulas_vary_and_powers_do_not() -> None:
    _, found = choose(POINT, VariantSearch(count=8, seed=7))
    told = [one.overrides for one in found.variants]
    assert len({repr(own) for own in told}) == 8
    for own in told:
        assert re.fullmatch(r"\d\*t\*exp\(t/\d\)", own["point.x"])
        assert re.fullmatch(r"\d\*t/\(t\^2 \+ \d\)\*cos\(t\)", own["point.y"])


# The command -------------------------------------------------------------------------------------


def found_by(seed: int) -> VariantChoice:
    return choose(PLANETARY, VariantSearch(count=5, seed=seed))[1]


def test_the_same_seed_gives_the_same_and_another_one_others() -> None:
    one, again, other = found_by(7), found_by(7), found_by(8)
    assert [v.overrides for v in one.variants] == [v.overrides for v in again.variants]
    assert one.rejections == again.rejections
    assert [v.overrides for v in one.variants] != [v.overrides for v in other.variants]


def test_rejected_candidates_add_up(of_ex3: tuple[Path, str]) -> None:
    tried = int(*re.findall(r"(\d+) candidates were examined", of_ex3[1]))
    thrown = sum(map(int, re.findall(r"(?m)^(\d+): ", of_ex3[1])))
    assert thrown + 6 == tried
    found = found_by(7)
    assert sum(found.rejections.values()) + len(found.variants) == found.tried
    assert found.rejections[RejectionReason.COAXIAL, ""]


def test_a_russian_table_is_as_excel_has_it_and_is_read(tmp_path: Path) -> None:
    table = tmp_path / "table.csv"
    args = (
        EX3,
        "--count",
        2,
        "--seed",
        7,
        "-o",
        table,
        "--lang",
        "ru",
        "--vary",
        "links.1.AB,yC,driver.phi=0..90",
    )
    done = run(*args)
    assert done.exit_code == 0, done.output
    head, first, *_ = table.read_text("utf-8").splitlines()
    assert head.startswith("variant;links.1.AB;driver.phi;xC;yC") and "0,0" in first
    tasks = tasks_of(beside(tmp_path, EX3, table))
    for task in tasks:
        assert isinstance(task.solution, Solution)
        assert 0 <= task.solution.positions[0] <= 90
    places = {task.solution.problem.bodies["0"].points["C"] for task in tasks}
    assert all(place.real == 0 and place.imag < 0 for place in places)


def test_a_file_with_variants_is_written_whole_with_others(tmp_path: Path) -> None:
    source, out = path_of("levers/task-13"), tmp_path / "task-13.toml"
    done = run(
        source,
        "--count",
        1,
        "--seed",
        7,
        "--vary",
        "driver.omega,driver.phi",
        "--tries",
        60,
        "-o",
        out,
    )
    assert done.exit_code in (0, 1)
    one, two = (tomllib.loads(path.read_text("utf-8")) for path in (source, out))
    assert one.pop("variants").keys() == {"А", "Б", "В", "Г", "Д", "Е"}
    two.pop("variants", None)
    assert one == two


def test_too_few_variants_are_reported_by_the_exit_code(tmp_path: Path) -> None:
    done = run(EX3, "--count", 30, "--tries", 20, "--lang", "en", "-o", tmp_path / "t.csv")
    assert done.exit_code == 1
    assert "of 30; 20 candidates" in done.output


@pytest.mark.parametrize(
    ("vary", "said"),
    [
        ("links.1.XY", "has no such number"),
        ("driver.phi=a..b", "FROM..TO is expected"),
        ("driver.phi=91..94", "contains no round number"),
        (" , ", "found no numbers to vary"),
    ],
)
def test_a_value_that_cannot_be_varied_is_reported(vary: str, said: str) -> None:
    done = run(EX3, "--vary", vary, "--lang", "en")
    assert done.exit_code == 2
    assert said in done.output


def test_a_file_without_values_to_vary_is_reported() -> None:
    done = run(PROBLEMS / "meshing/z12-30.toml", "--lang", "en")
    assert done.exit_code == 2 and "found no numbers to vary" in done.output


def test_the_problem_file_is_not_written_over(tmp_path: Path) -> None:
    path = tmp_path / "ex3.toml"
    path.write_bytes(EX3.read_bytes())
    assert run(path, "-o", path, "--lang", "en").exit_code == 2
    assert path.read_bytes() == EX3.read_bytes()
    assert run(path, "-o", tmp_path / "t.xlsx", "--lang", "en").exit_code == 2


def test_values_about_zero_are_a_dozen_or_so_round_ones() -> None:
    for end, step in ((8, 1), (39, 1), (40, 5), (79, 5), (80, 10)):
        table = {"driver": {"s": 1.0}}
        (one,) = parse_vary(table, f"driver.s=-{end}..{end}", 0.1)
        assert one.values == tuple(range(-(end // step) * step, end + 1, step))


TWO_SUNS = """
[gears]
wheels = { 1 = 20, 2 = 20, "2'" = 18, 3 = 60, 4 = 22 }
meshes = [
  { of = [2, 3], kind = "internal", carrier = "H" },
  { of = [1, 2], kind = "external", carrier = "H" },
  { of = ["2'", 4], kind = "external", carrier = "H" },
]
fixed = [3]
n = { 1 = 100 }
"""


def test_equations_of_wheels_on_one_planet_are_solved_for_each_other(tmp_path: Path) -> None:
    """z3 - z2 = z1 + z2 = z4 + z2': each is solved for a wheel that no other one has."""
    path = tmp_path / "two-suns.toml"
    path.write_text(TWO_SUNS, "utf-8")
    motion = solve_motion(load(path))
    sizes = {**motion.axes.sizes, "": Fraction(1)}
    rows = coaxial_rows(motion, [*motion.axes.sizes])
    assert len(rows) == 2
    for main, row in rows:
        assert sum(main in other and other[main] != 0 for _, other in rows) == row[main] == 1
        assert sum(factor * sizes[label] for label, factor in row.items()) == 0
