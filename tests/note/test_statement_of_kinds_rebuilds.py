"""Trains, meshings, cams and moving points are rebuilt from the stated data alone."""

from __future__ import annotations

import tomllib
from collections.abc import Sequence
from math import isclose
from pathlib import Path
from typing import Any

from cases import each, sampled
from doors import KINDS_KINDS as KINDS, LINKAGES, GivenFact, Language, Notation, get_language

from benchmarks.rebuilt import file_of, printed, table_of

ROOT = Path(__file__).parents[2]
CASES = [
    (kind, path)
    for path in sorted((ROOT / "problems").rglob("*.toml"))
    for kind in KINDS
    if kind is not LINKAGES and kind.table in tomllib.loads(path.read_text("utf-8"))
]
OWN = {
    "gears": (
        """
module = { "1-2" = 4, "3-4" = 6 }
wheels = { 1 = { z = 12, x = 0.3 }, 2 = { z = 24, x = -0.1 }, "3" = 15, 4 = 30 }
meshes = [{ of = [1, 2], eta = 0.97 }, { of = [3, 4], eta = 0.95 }]
bodies = [["V", "2", "3"]]
omega = { 1 = -12.5 }
output = "4"
""",
        """
module = 5
wheels.1.r = 0.05
wheels.2.r = 0.12
wheels.3 = 20
wheels.4 = 2
wheels.5 = 40
wheels.6 = 18
wheels.7.r = 0.03
wheels.8.r = 0.06
meshes = [
  { of = [1, 2], kind = "crossed belt" }, { of = [4, 5], kind = "worm", hand = "left" },
  { of = [3, 6] }, { of = [7, 8], kind = "chain" }, { of = [6, 9], kind = "rack" },
]
bodies = [["2", "3"], ["5", "7"], ["6", "4"]]
n = { 1 = 300 }
""",
        """
wheels = { 1 = 20, 2 = 30, "2'" = 18, 3 = 68, H = { r = 0.05 } }
module = 2
meshes = [{ of = [1, 2], carrier = "H" }, { of = ["2'", 3], kind = "internal", carrier = "H" }]
coaxial = [["1", "3"]]
satellites = { H = 3 }
fixed = [3]
n = { H = 100 }
""",
        """
wheels.1 = { z = 20, axis = [1, 0, 0] }
wheels.2 = { z = 30, axis = [0, 1, 0] }
wheels.3 = { z = 20, axis = [-1, 0, 0] }
meshes = [
  { of = [1, 2], kind = "bevel", carrier = "H" }, { of = [2, 3], kind = "bevel", carrier = "H" },
]
n = { 1 = 100, H = 40 }
""",
    ),
    "point": (
        """
wheel = { radius = 0.4, r = 0.25, angle = -35, within = 1.3 }
phi = "0.3*t**2"
t = { from = 0.1, to = 1.2, count = 9 }
""",
        """
x = "2*cos(pi*t/3)"
y = 0.25
t = [3, "pi/2", 0.1, 2, 7]
""",
        """
s = "t^3/3 - t"
t = 1.25
""",
    ),
    "meshing": (
        """
z = [15, 41]
m = 2.5
beta = 12.5
b = 30
a_w = 73
x2 = 0.15
alpha = 20
""",
        """
z = [20, 60]
m = 4
internal = true
cutter = 24
a_w = 81
x = "contact-ratio"
s_a_min = 0.3
""",
        """
z = [18, 33]
m = 6
ha = 0.8
c = 0.3
x = [0.37, -0.125]
epsilon_min = 1.1
""",
    ),
    "cam": (
        """
follower = "oscillating"
contact = "flat"
swing = 15
arm = 0.2
centre = 0.15
rise = 110
return = 95
lower_dwell = 60
upper_dwell = 95
sense = "same"
law = { rise = { law = "trapezoidal", ramp = 0.2 }, return = { law = "linear", blend = 0.15 } }
curvature = 0.005
count = 36
n = -77.5
mass = 1.5
load = 20
margin = 1.35
""",
        """
follower = "translating"
stroke = 0.0371
offset = -0.012
r_min = 0.06
roller = 0.015
rise = 100.5
upper_dwell = 20
return = 130
law = { rise = { law = "modified-trapezoidal", ramp = 0.1 }, return = "linear" }
pressure = 33
parts = 8
""",
    ),
}
"""Additional problems, for data that the shipped ones do not have."""

RU, EN = get_language("ru"), get_language("en")
SAME = 1e-9
ASIDE = ("published", "answers")
"""Parts of a record that are not computed: numbers printed in the file."""


def numbers_of(record: Any, path: str = "") -> dict[str, float]:
    """Return all numbers of a record by their paths."""
    if isinstance(record, dict):
        pairs = [(str(key), one) for key, one in record.items() if key not in ASIDE]
    elif isinstance(record, list | tuple):
        pairs = [(str(k), one) for k, one in enumerate(record)]
    elif isinstance(record, int | float) and not isinstance(record, bool):
        return {path: float(record)}
    else:
        return {}
    return {
        key: number
        for name, one in pairs
        for key, number in numbers_of(one, f"{path}.{name}").items()
    }


def assert_same(record: Any, again: Any) -> None:
    one, two = numbers_of(record), numbers_of(again)
    assert one.keys() == two.keys()
    for path, number in one.items():
        # Where something is largest is known to the root of the rounding only.
        tol = 1e-5 if ".at_deg." in path else SAME
        assert isclose(number, two[path], rel_tol=tol, abs_tol=tol), path


def numbers_in(value: Any) -> list[float]:
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list | tuple):
        return [number for one in value for number in numbers_in(one)]
    return [] if isinstance(value, str | bool) else [float(value)]


def assert_printed(facts: Sequence[GivenFact], say: Notation) -> None:
    """Assert that every number of the data is in the text of its fact, within its last digit."""
    for fact in facts:
        assert fact.text, fact.data
        told = [*printed(fact.text)]
        for key, value in fact.data.items():
            for number in numbers_in(value):
                assert any(
                    abs(abs(number) * scale - abs(shown)) <= 0.51 * last + 1e-12
                    for shown, last in told
                    for scale in (1.0, 1e-3)
                ), f"{key} = {number}: {fact.text}"


def assert_rebuilt(
    kind: Any, path: Path, variant: str | None, written: Path, languages: Sequence[Language]
) -> None:
    problem = kind.load(path, variant)
    for words in languages:
        facts = kind.given_facts(problem, words)
        table = table_of(facts)
        if kind.table == "gears" and problem.train.ask:
            table["gears"]["ask"] = [*problem.train.ask]
        written.write_text(file_of(table), "utf-8")
        assert_same(kind.record(problem, "en"), kind.record(kind.load(written, None), "en"))
        assert_printed(facts, words.notation)


@each("number, kind, path", [(number, *case) for number, case in enumerate(CASES)])
def test_every_problem_of_a_kind_is_rebuilt(
    number: int, kind: Any, path: Path, tmp_path: Path
) -> None:
    """In ``make test`` every other problem is stated in Russian, the others in English."""
    languages = sampled((RU, EN) if number % 2 else (EN, RU), 2)
    for variant in (None, *kind.load(path, None).variants):
        assert_rebuilt(kind, path, variant, tmp_path / f"{path.stem}.toml", languages)


@each("kind,text", [(kind, text) for kind in KINDS for text in OWN.get(kind.table, ())])
def test_data_that_no_shipped_problem_has_are_rebuilt(kind: Any, text: str, tmp_path: Path) -> None:
    path = tmp_path / "own.toml"
    path.write_text(f"[{kind.table}]\n{text}", "utf-8")
    assert_rebuilt(kind, path, None, tmp_path / "again.toml", (RU, EN))
