"""The model by which the studio moves a mechanism: its poses are those of the changed file."""

from __future__ import annotations

import json
import shutil
import subprocess
from typing import Any

import numpy as np
import pytest
from cases import each
from doors import (
    ModelProblem as Problem,
    Parameters,
    ProblemError,
    Solution,
    Sweep,
    drawn_model,
    get_language,
    pose,
)
from worked import ROOT, problem_of

pytestmark = pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")

NAMES = [
    "linkages/ex3", "levers/task-33", "levers/task-52", "levers/task-58", "levers/task-37",
    "levers/task-31", "linkages/2.1.30", "linkages/2.1.15", "linkages/2.1.93", "press/press",
    "levers/crosshead", "levers/task-68", "linkages/triad",
]  # fmt: skip

SCRIPT = """
import { readFileSync } from "node:fs";
import { mechanism, apart } from "PAGE/drag.js";
const asked = JSON.parse(readFileSync(0, "utf-8"));
const whole = numbers => numbers.map(value => Number.isFinite(value) ? value : null);
console.log(JSON.stringify(asked.map(one => {
  const made = mechanism(one.model), given = made.given();
  if (one.values) return one.positions.map(x =>
    whole(made.pose({ ...given, values: { ...given.values, ...one.values }, x }).out));
  const before = made.pose(given);
  return one.points.map(point => {
    const [x, y] = before.at(point);
    const pulled = made.pulled(given, point, [x + one.by[0], y + one.by[1]]);
    if (!pulled) return null;
    const pose = made.pose(pulled);
    return [pose.failed, ...whole(pose.at(point)), ...whole(before.at(point)), pulled.values];
  });
})));
"""


def asked(questions: list[dict[str, Any]]) -> list[Any]:
    """Ask the modules of the page in node."""
    page = (ROOT / "planmethod/studio/page").as_uri()
    done = subprocess.run(
        ["node", "--import", "./scripts/js/resolve.mjs", "--input-type=module", "-e",
         SCRIPT.replace("PAGE", page)],
        input=json.dumps(questions), stdout=subprocess.PIPE, text=True, check=True, cwd=ROOT,
    )  # fmt: skip
    found: list[Any] = json.loads(done.stdout)
    return found


def model_of(problem: Problem) -> dict[str, Any]:
    return drawn_model(Solution(problem), get_language("en"))


@each("name", [name for name in NAMES if name != "linkages/triad"])  # its start follows no line
def test_each_number_changed_on_the_page_gives_the_results_of_the_changed_file(name: str) -> None:
    problem = problem_of(name)
    model, known = model_of(problem), Parameters(problem, pose)
    positions = [float(one) for one in problem.drive.positions[:3]]
    questions, wanted = [], []
    for one in model["parameters"]:
        if not one["moves"] or not one["means"]:  # the page leaves the others alone
            continue
        value = one["value"] * 1.03 or 0.004
        try:
            changed = known.read({known.by_name[one["name"]]: value})
        except ProblemError:  # it contradicts another number
            continue
        sweep = Sweep(changed, drawn=[row.rpartition(".")[0] for row in model["rows"][
            len(Sweep(problem).rows)::2]])  # fmt: skip
        wanted.append(
            (one["name"], sweep.run(np.array(positions)), [row.name for row in sweep.rows])
        )
        questions.append({"model": model, "values": {one["name"]: value}, "positions": positions})
    assert len(questions) >= 3
    for (what, exact, rows), found in zip(wanted, asked(questions), strict=True):
        made = np.array(found, dtype=float).T[:-1]
        assert rows == model["rows"]
        size = np.maximum(np.nanmax(np.abs(exact), axis=1, keepdims=True), 1e-3)
        places = [k for k, row in enumerate(rows) if row.endswith((".x", ".y"))]
        off = np.abs(made - exact)[places] / size[places]
        assert np.nanmax(off) < 1e-9, (what, rows[places[int(np.nanargmax(off.max(axis=1)))]])


@each("name", [name for name in NAMES if name not in ("press/press", "linkages/triad")])
def test_a_joint_that_is_pulled_goes_where_it_was_pulled_to(name: str) -> None:
    model = model_of(problem_of(name))
    size = max(abs(v) for link in model["links"].values() for at in link.values() for v in at)
    by = [0.02 * size, 0.013 * size]
    points = [point for point in model["order"] if point[-1] not in "'0"]
    (found,) = asked([{"model": model, "points": points, "by": by}])
    met = nearer = 0
    for point, told in zip(points, found, strict=True):
        if told is None:
            continue
        failed, x, y, x0, y0, _ = told
        if failed >= 0 or x is None:
            continue
        off = np.hypot(x - x0 - by[0], y - y0 - by[1])
        # A slider goes along its guide only, the end of a rocker along the rocker only.
        assert off < (1 + 1e-9) * np.hypot(*by), point
        nearer += 1
        met += off < 1e-9 * size
    assert nearer >= len(points) // 2
    assert met >= len(points) // 3
