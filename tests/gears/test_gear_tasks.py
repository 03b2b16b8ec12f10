"""The textbook's tasks: solved as another program, with decimals, solved them."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from cases import each
from doors import answer, gears_reader_load as load, solve_motion
from trains import solved
from worked import PROBLEMS, ROOT

KNOWN: dict[str, dict[str, Any]] = json.loads(
    (ROOT / "tests/data/gear_tasks.json").read_text("utf-8")
)
FILES = sorted((PROBLEMS / "gears/tasks").glob("*.toml"))
SCHEMA = jsonschema.Draft202012Validator(
    json.loads((ROOT / "planmethod/problem/schema.json").read_text("utf-8"))
)


def test_every_task_has_known_speeds() -> None:
    assert [path.stem for path in FILES] == sorted(KNOWN)


@each("path", FILES)
def test_tasks_have_the_known_teeth_and_speeds(path: Path) -> None:
    SCHEMA.validate(tomllib.loads(path.read_text("utf-8")))
    motion, known = solve_motion(load(path)), KNOWN[path.stem]
    assert motion.structure.mobility == known["W"]
    assert {label: motion.axes.sizes[label] for label in known["teeth"]} == known["teeth"]
    speeds = {label: float(motion.speed(label)) for label in known["speeds"]}
    assert speeds == pytest.approx(known["speeds"], abs=1e-5)
    assert all(answer(motion, name).value is not None for name in motion.train.ask)


@pytest.mark.parametrize("of", ['"2\'", 3', '3, "2\'"'])
def test_a_planet_gear_of_a_ring_has_the_next_one_within(of: str, tmp_path: Path) -> None:
    """2.2.35: ring 1, planet gears 2-2' and 3-3'; the sun 4 follows from either form of mesh."""
    text = (
        'wheels = { 1 = 120, 2 = 30, "2\'" = 24, 3 = 20, "3\'" = 18 }\n'
        'meshes = [{ of = [1, 2], kind = "internal", carrier = "H" }, '
        f'{{ of = [{of}], carrier = "H" }}, {{ of = ["3\'", 4], carrier = "H" }}]\n'
        'unknown = ["4"]\nn = { 1 = 10, H = 20 }\n'
    )
    assert solved(tmp_path, text).axes.sizes["4"] == 120 - 30 - 24 - 20 - 18
