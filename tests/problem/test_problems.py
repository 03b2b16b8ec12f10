"""The problems of the repository, the templates, the schema and the documentation."""

from __future__ import annotations

import json
import math
import pickle
import re
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import pytest
from cases import each, thinned
from doors import (
    PROBLEM_FAMILIES as FAMILIES,
    AngleKey,
    Convention,
    FlagKey,
    IntegerKey,
    NumberKey,
    QuantityKey,
    QuantityKind,
    TextKey,
    WordKey,
    declared,
    keys,
    kind_of,
    parse_quantity,
    problem_load as load,
    problem_loads as loads,
    problem_template as template,
    variant_names,
)
from worked import every_file, every_task

import planmethod
from scripts.reference import schema

ROOT = Path(__file__).parents[2]
PROBLEMS = every_file()
SCHEMA: dict[str, Any] = json.loads(schema.SCHEMA.read_text(encoding="utf-8"))
DOCS = (ROOT / "docs" / "reference" / "problem-file.md").read_text(encoding="utf-8")
LINKAGES = ROOT / "problems" / "linkages"
LEVERS = ROOT / "problems" / "levers"
PRESS = ROOT / "problems" / "press" / "press.toml"
STONE = ROOT / "problems" / "press" / "press-stone.toml"


@pytest.mark.parametrize("path", PROBLEMS, ids=lambda path: path.stem)
def test_every_problem_and_variant_loads(path: Path) -> None:
    if "links" not in tomllib.loads(path.read_text(encoding="utf-8")):
        pytest.skip("not a linkage")
    problem = load(path)
    assert problem.title
    assert problem.source
    assert problem.stamp["title"]
    for name in variant_names(path):
        assert load(path, variant=name).variant == name


def test_the_worked_examples_are_here() -> None:
    names = {path.stem for path in PROBLEMS}
    levers = {"six-link", "task12", "task12-variants", "press", "press-stone"}
    assert names >= {"ex1", "ex2", "ex3", *levers}


@pytest.mark.parametrize(
    ("path", "count"),
    [
        (LINKAGES / "ex1.toml", 14),
        (LINKAGES / "ex2.toml", 17),
        (LINKAGES / "ex3.toml", 22),
        (LEVERS / "six-link.toml", 66),
        (LEVERS / "task12.toml", 79),
        (PRESS, 40),
        (STONE, 12),
    ],
    ids=lambda value: value.stem if isinstance(value, Path) else "",
)
def test_every_printed_value_is_listed_with_its_quantity_or_a_note(path: Path, count: int) -> None:
    published = load(path).published
    assert len(published) == count
    for item in published:
        if item.what:
            assert parse_quantity(item.what)
        else:
            assert item.note


def test_points_of_the_examples() -> None:
    points = {
        path.stem: list(
            dict.fromkeys(p for body in load(path).bodies.values() for p in body.points)
        )
        for path in (
            *LINKAGES.glob("ex*.toml"),
            *LEVERS.glob("*[!0-9].toml"),
            LEVERS / "task12.toml",
            PRESS,
            STONE,
        )
    }
    assert points["ex1"] == ["A", "B", "C", "D"]
    assert points["ex2"] == ["O", "C", "A", "B", "D"]
    assert points["ex3"] == ["A", "C", "B", "D", "E"]
    assert points["six-link"] == ["A", "D", "B", "C", "S2", "H"]
    assert points["task12"] == points["task12-variants"] == ["A", "C", "B", "D", "S3", "E", "S5"]
    assert points["press"] == ["O3", "O1", "A", "S1", "S3", "N", "B"]
    assert points["press-stone"] == ["O3", "O1", "A", "S1", "S3", "B"]


def test_the_press_crank_follows_from_the_speed_ratio() -> None:
    problem = load(PRESS)
    theta = math.pi * (1.22 - 1) / (1.22 + 1)
    crank = 1.08 * math.sin(theta / 2)
    assert problem.bodies["1"].points["A"] == pytest.approx(crank, rel=1e-15)
    assert problem.bodies["1"].points["S1"] == pytest.approx(crank / 2, rel=1e-15)
    assert problem.drive.positions[0] == pytest.approx(
        90 + math.degrees(theta / 2) + 120, rel=1e-14
    )
    assert problem.drive.rate == pytest.approx(130 * math.pi / 30, rel=1e-15)


def test_the_two_readings_of_the_press_differ_in_link_4_only() -> None:
    rod, stone = load(PRESS), load(STONE)
    assert rod.drive == stone.drive
    assert rod.dynamics == stone.dynamics
    assert rod.guides == stone.guides
    assert {link: rod.bodies[link] for link in "125"} == {
        link: stone.bodies[link] for link in "125"
    }
    assert "4" not in rod.slides
    assert (stone.slides["4"].host, stone.slides["4"].label) == ("3", rod.slides["2"].label)


def test_the_rod_of_the_six_link_is_square_to_the_coupler() -> None:
    problem = load(LEVERS / "six-link.toml")
    slide = problem.slides["4"]
    assert (slide.host, slide.base, abs(slide.angle)) == ("2", 0.3, 90)
    assert problem.bodies["2"].points["S2"] == 0.2
    assert problem.scales.convention is Convention.MM_PER_UNIT
    assert problem.scales.mu_l == 0.004


def test_the_block_of_task_12_slides_along_x_in_a_link_that_slides_along_y() -> None:
    problem = load(LEVERS / "task12.toml")
    assert problem.slides["5"].angle == 90
    assert problem.slides["4"].angle == -90
    assert problem.bodies["5"].points == {"E": 0, "S5": 0.2}
    assert problem.bodies["3"].points == {"C": 0, "D": 0.25, "S3": -0.1}


def test_the_six_variants_of_task_12() -> None:
    path = LEVERS / "task12-variants.toml"
    phi = {name: load(path, variant=name).drive.positions for name in variant_names(path)}
    assert phi == {"А": (60,), "Б": (120,), "В": (240,), "Г": (300,), "Д": (150,), "Е": (30,)}


@pytest.mark.parametrize("family", FAMILIES)
def test_templates_load_clean_and_are_commented_in_russian(family: str) -> None:
    text = template(family)
    problem = planmethod.loads(text, name=family)  # a crank may be driven by a train
    assert problem.title
    assert len(re.findall(r"#.*[а-яё]", text)) >= 10
    # lines that are commented out must be right as well
    uncommented = re.sub(r"(?m)^# (?=\[|mu_|convention|driver)", "", text)
    assert planmethod.loads(uncommented, name=family, variant="Б").drive is not None


def test_an_unknown_family() -> None:
    with pytest.raises(KeyError):
        template("perpetuum")


SCHEMA_TABLES = {kind: schema.table_at(SCHEMA, kind)["properties"] for kind in schema.PLACES}


def test_the_russian_schema_describes_every_key_and_differs_only_in_language() -> None:
    def told(node: Any, found: list[str]) -> Any:
        if isinstance(node, dict):
            said = node.get("description")
            found += [said] if isinstance(said, str) else []
            inner = {key: told(one, found) for key, one in node.items()}
            return inner | {"description": ""} if isinstance(said, str) else inner
        return [told(one, found) for one in node] if isinstance(node, list) else node

    russian: list[str] = []
    other = json.loads(schema.RUSSIAN_SCHEMA.read_text("utf-8"))
    assert told(other, russian) == told(SCHEMA, [])
    assert [one for one in russian if not re.search("[а-яё]", one)] == []


@each("kind", keys.FLAT)
def test_declared_keys_agree_with_the_types_of_their_fields(kind: str) -> None:
    kinds = {IntegerKey: int, FlagKey: bool, TextKey: str, NumberKey: float, AngleKey: float}
    for one in declared(keys.FLAT[kind]):
        if isinstance(one.key, WordKey):
            sentence = one.key.sentence
            assert all(f'"{word.value}"' in sentence for word in one.kind), one
        elif type(one.key) in kinds:
            assert one.kind is kinds[type(one.key)], one


@each("kind", keys.KINDS)
def test_the_schema_has_exactly_the_keys_the_reader_knows(kind: str) -> None:
    assert set(SCHEMA_TABLES[kind]) == set(keys.known(kind))


WORDS = [QuantityKey(kind, (), axis).word for kind in QuantityKind for axis in ("", "x", "y")
         if (kind.part if axis else kind.word)]  # fmt: skip


@each("kind", WORDS)
def test_every_quantity_is_documented(kind: str) -> None:
    """By its words, or after one that begins with the same word: "`machine D`, `m`, `b`"."""
    first, _, second = kind.partition(" ")
    in_row = second and re.search(rf"(?m)^- `{first} .*`{second}[ `]", DOCS)
    assert in_row or re.search(rf"`{kind}[ `]", DOCS)


def documented_files() -> list[str]:
    blocks = re.findall(r"```toml\n(.*?)```", DOCS, re.DOTALL)
    return [block for block in blocks if "[links.1]" in block and "[driver]" in block]


def test_the_example_of_the_documentation_loads() -> None:
    (example,) = documented_files()
    assert loads(example, name="doc").mechanism.lower_pairs == 7


def validator() -> Any:
    jsonschema = pytest.importorskip("jsonschema")
    jsonschema.Draft202012Validator.check_schema(SCHEMA)
    return jsonschema.Draft202012Validator(SCHEMA)


@pytest.mark.parametrize(
    "path", [*PROBLEMS, *thinned(every_task(), 99)], ids=lambda path: path.stem
)
def test_problems_satisfy_the_schema(path: Path) -> None:
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    assert [error.message for error in validator().iter_errors(table)] == []


def test_templates_satisfy_the_schema() -> None:
    for family in thinned(FAMILIES, 4):
        assert [e.message for e in validator().iter_errors(tomllib.loads(template(family)))] == []


def test_the_schema_finds_faults() -> None:
    table = tomllib.loads(template("four-bar"))
    table["driver"]["omga"] = 1
    table["links"]["1"]["OA"] = -1
    table["links"]["2"]["D"] = {"on": "AB"}
    paths = {".".join(error.absolute_path) for error in validator().iter_errors(table)}
    assert paths == {"driver", "links.1.OA", "links.2.D"}


def test_reading_needs_no_heavy_modules() -> None:
    code = (
        "import sys; from planmethod.problem import load; load(sys.argv[1]);"
        "heavy = {'numpy', 'shapely', 'matplotlib', 'reportlab', 'difflib', 'json'};"
        "print(*heavy & set(sys.modules))"
    )
    run = subprocess.run(
        [sys.executable, "-c", code, str(LINKAGES / "ex3.toml")],
        capture_output=True,
        text=True,
        check=True,
    )
    assert run.stdout.split() == []


@each("path", PROBLEMS)
def test_a_problem_goes_to_another_process_and_comes_back(path: Path) -> None:
    """Everything read from a file can be pickled, since `--jobs` sends it."""
    problem = kind_of(path).load(path, None)
    assert type(pickle.loads(pickle.dumps(problem))) is type(problem)
