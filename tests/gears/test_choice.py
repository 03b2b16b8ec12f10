"""Choice of teeth against a search by nested loops, and against the solved file of a set."""

from __future__ import annotations

import json
import math
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from cases import each, some
from click.testing import CliRunner
from doors import (
    SCHEMES,
    ExitCode,
    TeethSpecification,
    TrainScheme,
    answer,
    cli,
    conditions,
    gears_reader_load as load,
    solve_motion,
    teeth_report_problem_text as problem_text,
    teeth_selection_choose as choose,
)

F = Fraction
ALPHA = math.radians(20)
BY_NAME = {scheme.name: scheme for scheme in SCHEMES}
TWO_FIVE = (F(2), F(5, 2))


def clear(ring: int, wheel: int) -> bool:
    """An internal mesh: the ring's tips end before the line of action touches the base circle."""
    r_3, r_2 = ring / 2, wheel / 2
    return ring - wheel >= 8 and r_3 - 1 >= math.hypot(
        r_3 * math.cos(ALPHA), (r_3 - r_2) * math.sin(ALPHA)
    )


def free(one: int, other: int) -> bool:
    """An external mesh: no tip passes the point where the line of action touches a base circle."""
    return all(
        r + 1 <= math.hypot(r * math.cos(ALPHA), (r + s) * math.sin(ALPHA))
        for r, s in ((one / 2, other / 2), (other / 2, one / 2))
    )


def goes_in(z: tuple[int, ...], inner: list[bool], k: int) -> bool:
    """Return whether a planet gear can be turned so that both rims fit a k-th of a turn further."""
    z_1, z_2, rim, z_3 = z
    s_1, s_3 = (-1 if turned else 1 for turned in inner)
    return any(
        ((s_1 * z_1 + k * tooth) * rim - s_3 * z_3 * z_2) % (k * z_2) == 0 for tooth in range(z_2)
    )


def loops(wanted: TeethSpecification) -> set[tuple[tuple[int, ...], Fraction]]:
    """Every set, all four wheels run through."""
    scheme, k, (p, q) = wanted.scheme, wanted.planets, wanted.rows
    inner = [kind.value == "internal" for kind in scheme.kinds]
    spur, ring = (
        range(wanted.min_teeth, wanted.max_teeth + 1),
        range(wanted.min_teeth, wanted.max_ring_teeth + 1),
    )
    first, last = (ring if label in scheme.rings else spur for label in ("1", "3"))
    rims = [(b, b) for b in spur] if scheme.single else list(product(spur, spur))
    found = set()
    for z_1, (z_2, rim), z_3 in product(first, rims, last if len(inner) == 2 else [0]):
        a = p * (z_1 - z_2 if inner[0] else z_1 + z_2)
        if len(inner) == 2 and (a != q * (z_3 - rim if inner[1] else z_3 + rim) or a <= 0):
            continue
        held = F(z_2, z_1) * (1 if inner[0] else -1)
        if len(inner) == 2:
            held *= F(z_3, rim) * (1 if inner[1] else -1)
        u = 1 - held if scheme.is_planetary else held
        if scheme.ratio_name == "U_H_1":
            u = 1 / u if u else F(0)
        meshes = [(z_1, z_2), (z_3, rim)][: len(inner)]
        apart = k == 1 or math.sin(math.pi / k) > max(p * (z_2 + 2), q * (rim + 2)) / a
        if (
            abs(u / wanted.ratio - 1) <= wanted.tolerance
            and all((clear if t else free)(*pair) for pair, t in zip(meshes, inner, strict=True))
            and (not scheme.is_planetary or (apart and goes_in((z_1, z_2, rim, z_3), inner, k)))
        ):
            by = {"1": z_1, "2": z_2, "2'": rim, "3": z_3}
            found.add((tuple(by[label] for label in scheme.wheels), u))
    return found


CASES = [
    ("ring", F(5), 3, None),
    ("ring", F(9, 2), 4, None),
    ("external-internal", F(5), 3, None),
    ("external-internal", F(5), 2, TWO_FIVE),
    ("two-external", F(-12), 3, None),
    ("two-external", F(6), 1, (F(2), F(3))),
    ("two-internal", F(15), 2, None),
    ("two-internal", F(6), 3, TWO_FIVE),
    ("pair", F(-3, 2), 1, None),
    ("two-stage", F(3, 2), 1, TWO_FIVE),
]


@each("name, ratio, count, modules", CASES)
def test_a_search_finds_the_choices_of_nested_loops(
    name: str, ratio: Fraction, count: int, modules: tuple[Fraction, Fraction] | None
) -> None:
    most, seen = some(40, 28), 0
    for least, within in ((16, F(2, 100)), (18, F(0))):
        wanted = TeethSpecification(BY_NAME[name], ratio, within, count, least, most, 75, modules)
        chosen = choose(wanted)
        assert {(one.teeth, one.ratio) for one in chosen.sets} == loops(wanted)
        assert chosen.match_count == len(chosen.sets)
        seen += chosen.match_count
        order = [(one.size, abs(one.error)) for one in chosen.sets]
        assert [size for size, _ in order] == sorted(size for size, _ in order)
        assert choose(wanted, first=2).sets == chosen.sets[:2]
    assert seen


@pytest.mark.parametrize("scheme", SCHEMES, ids=lambda scheme: scheme.name)
@pytest.mark.parametrize("modules", [None, (F(2), F(2)), TWO_FIVE])
def test_the_file_of_a_set_is_solved_to_its_ratio(
    scheme: TrainScheme, modules: tuple[Fraction, Fraction] | None, tmp_path: Path
) -> None:
    ratio = next(case[1] for case in CASES if case[0] == scheme.name)
    if scheme.single and modules == TWO_FIVE:
        modules = None
    chosen = choose(TeethSpecification(scheme, ratio, F(1, 50), 2, modules=modules), first=3)
    path = tmp_path / "chosen.toml"
    path.write_text(problem_text(chosen, 2, "ru"), encoding="utf-8")
    motion = solve_motion(load(path))
    assert answer(motion, scheme.ratio_name).exact == chosen.sets[1].ratio
    assert all(one.is_satisfied for one in conditions(motion))


def run(*args: str) -> Any:
    return CliRunner().invoke(cli, ["teeth", *args])


def test_the_command_lists_writes_and_prints_its_bounds(tmp_path: Path) -> None:
    done = run("--U", "6.5", "--json")
    told = json.loads(done.stdout)
    assert (told["looked_at"], told["found"], len(told["sets"])) == (104 * 104, 38, 20)
    assert told["sets"][4]["teeth"] == {"1": 24, "2": 54, "3": 132}
    file = str(tmp_path / "set.toml")
    done = run("--U", "13/2", "--within", "0", "--write", file, "1", "--lang", "en")
    assert done.exit_code == ExitCode.DONE, done.output
    assert "10816" in done.stdout
    assert load(file).train.planets == {"H": 3}


@each(
    "args, code",
    [
        (("--U", "-3"), ExitCode.FINDINGS),
        (("--U", "0"), ExitCode.USAGE),
        (("--U", "six"), ExitCode.USAGE),
        (("--U", "1/0"), ExitCode.USAGE),
        (("--U", "3.00000001"), ExitCode.USAGE),
        (("--U", "3", "--within", "1"), ExitCode.USAGE),
        (("--U", "3", "--scheme", "david"), ExitCode.USAGE),
        (("--U", "3", "--z-min", "130"), ExitCode.USAGE),
        (("--U", "3", "--modules", "2,3"), ExitCode.USAGE),
        (("--U", "3", "--modules", "0"), ExitCode.USAGE),
        (("--U", "6.5", "--write", "x.toml", "999"), ExitCode.USAGE),
    ],
)
def test_an_impossible_request_is_rejected(args: tuple[str, ...], code: ExitCode) -> None:
    done = run(*args)
    assert done.exit_code == code, done.output
