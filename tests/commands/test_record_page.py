"""The page of records, json-and-csv.md, has the keys of today's records, and no others."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from doors import cli
from worked import PROBLEMS, ROOT

PAGE = (ROOT / "docs" / "reference" / "json-and-csv.md").read_text("utf-8")
EX3 = (PROBLEMS / "linkages" / "ex3.toml").read_text("utf-8")
DEAD = """\
title = "Dead position"
frame = { O = [0, 0], C = [0.3, 0] }
links.1 = { points = ["O", "A"], OA = 0.2 }
links.2 = { points = ["A", "B"], AB = 0.2 }
links.3 = { points = ["C", "B"], CB = 0.2 }
driver = { link = "1", phi = [60, 180], omega = 1 }
assembly.B = "left of AC"
"""
"""Four links that cannot be assembled in the second position."""
DRAWN = """\
title = "Coordinates of a figure"
frame = { A = [0, 0], D = "drawn" }
links.1 = { points = ["A", "B"] }
links.2 = { points = ["B", "C"] }
links.3 = { points = ["D", "C"] }
driver = { link = "1", omega = 10 }
drawn.points = { B = [0.0304, 0.05], C = [0.15, 0.09], D = [0.2, 0] }
"""
SPRUNG = """\
title = "Lamp"
frame = { O = [0, 0] }
links.1 = { points = ["O", "P"], OP = 0.12 }
driver = { link = "1", phi = 40, omega = 1 }
dynamics.links.1 = { mass = 2, centre = "P" }
[[springs]]
name = "a"
links = ["1", "0"]
points = ["P", [0, 0.2]]
stiffness = 200
damping = 5
length = 0.05
[[springs]]
links = ["0", "1"]
joint = "O"
stiffness = 3
angle = 20
"""


def named(title: str, *, fields: bool = False) -> set[str]:
    """Return the names of a section in code type; those that begin its points alone if asked."""
    (text,) = re.findall(rf"(?ms)^## {title}\n(.*?)(?=^## |\Z)", PAGE)
    text = re.sub(r"(?ms)^```.*?^```$", "", text)
    if fields:
        text = "\n".join(re.findall(r"(?m)^- ([^:]*)", text))
    return set(re.findall(r"`((?!--)[^`\"\[ ]+)`", text))


def solved(*args: str) -> dict[str, Any]:
    run = CliRunner().invoke(cli, ["solve", *args, "--json"])
    assert run.exit_code == 0, run.output
    found: dict[str, Any] = json.loads(run.stdout)
    return found


def shipped(name: str) -> dict[str, Any]:
    return solved(str(PROBLEMS / f"{name}.toml"))


def keys_of(record: object) -> Iterator[str]:
    """Yield all keys of a record, at any depth."""
    if isinstance(record, dict):
        for key, inner in record.items():
            yield key
            yield from keys_of(inner)
    elif isinstance(record, list):
        for inner in record:
            yield from keys_of(inner)


@pytest.fixture(scope="module")
def linkages(tmp_path_factory: pytest.TempPathFactory) -> list[dict[str, Any]]:
    folder = tmp_path_factory.mktemp("linkages")
    cycle, dead, slider = (folder / f"{name}.toml" for name in ("cycle", "dead", "slider"))
    cycle.write_text(EX3 + '\n[cycle]\ngraphs = ["omega_3"]\n', "utf-8")
    dead.write_text(DEAD, "utf-8")
    CliRunner().invoke(cli, ["new", "driving-slider", str(slider)])
    drawn, sprung = (folder / f"{name}.toml" for name in ("drawn", "sprung"))
    drawn.write_text(DRAWN, "utf-8")
    sprung.write_text(SPRUNG, "utf-8")
    return [
        shipped("machines/rubbing-crank"),
        solved(str(drawn), "--round", "1mm"),
        solved(str(sprung)),
        shipped("machines/balanced-crank"),
        solved(str(PROBLEMS / "press" / "flywheel.toml"), "--variant", "motor"),
        solved(str(cycle)),
        solved(str(slider)),
        solved(str(dead), "--partial"),
    ]


def test_records_of_linkages_have_the_keys_of_the_page(linkages: list[dict[str, Any]]) -> None:
    top = {"schema", "problem", "variant"}
    assert {key for one in linkages for key in one} == top | {
        "structure", "positions", "cycle", "machine", "balancing", "friction", "synthesis",
        "drawn",
    }  # fmt: skip
    assert named("Linkage") >= {key for one in linkages for key in one} - top
    positions = [place for one in linkages for place in one["positions"]]
    of_positions = {key for place in positions for key in place}
    said = named("Linkage", fields=True)
    assert said == of_positions | {"cam_deg"}
    assert named("Linkage") <= {*keys_of(linkages), "cam_deg"}


def test_records_of_forces_cycle_and_machine_have_the_keys_of_the_page(
    linkages: list[dict[str, Any]],
) -> None:
    positions = [place for one in linkages for place in one["positions"]]
    forces = [place["forces"] for place in positions if "forces" in place]
    beside = [one["friction"] for one in linkages if "friction" in one]
    assert {key for one in forces for key in one} <= named("Forces")
    assert {key for one in forces for pair in one["reactions"] for key in pair} - named(
        "Forces"
    ) == {"read", "sigma", "sigma_angle_deg", "read_moment", "sigma_moment"}
    rest = {"forces", "edges", "bearings", "[bearings]", "spring.NAME.force"}
    assert named("Forces") <= {*keys_of([forces, beside]), *rest, "friction"}
    (cycle,) = (one["cycle"] for one in linkages if "cycle" in one)
    assert named("Cycle") == set(cycle)
    (machine,) = (one["machine"] for one in linkages if "machine" in one)
    (balancing,) = (one["balancing"] for one in linkages if "balancing" in one)
    said = named("Machine and balancing")
    of_the_file = {"delta", "mean", "constant", "signs", "cycle_deg", "phi_0_deg", "omega_mean"}
    assert set(machine) - of_the_file - {"K_mm", "L_mm"} <= said
    assert {key for place in machine["positions"] for key in place} - {"number", "phi_deg"} <= said
    assert set(balancing) - {"structure", "method", "share", "rod"} <= said
    chain = shipped("machines/planer-drive")["machine"]["chain"]
    assert said <= {*keys_of([machine, balancing, {"chain": chain}]), "machine", "balancing"}


def test_records_of_syntheses_have_the_keys_of_the_page(linkages: list[dict[str, Any]]) -> None:
    (synthesis,) = (one["synthesis"] for one in linkages if "synthesis" in one)
    done = CliRunner().invoke(
        cli, ["synthesize", "slotted", "--K_v", "1.22", "--centres", "1.08", "--json"]
    )
    own = json.loads(done.stdout).keys() - {"schema"}
    assert set(synthesis) == named("Synthesis") | own


@pytest.mark.parametrize(
    ("title", "name", "table"),
    [
        ("Gear train", "gears/gears-ex3", "gears"),
        ("Meshing", "meshing/z12-30", "meshing"),
        ("Point", "point/k10-satellite", "point"),
        ("Cam", "cams/offset", ""),
    ],
)
def test_records_of_other_kinds_have_the_keys_of_the_page(
    title: str, name: str, table: str
) -> None:
    record = shipped(name)
    common = {"schema", "problem", "variant", "title", "source", "legend"}
    assert set(record) - common == ({table} if table else set(record) - common)
    found: Any = record[table] if table else {k: v for k, v in record.items() if k not in common}
    first = found[0] if isinstance(found, list) else found
    assert set(first) - named(title) <= set(record["legend"])
    assert named(title) <= {*keys_of(found), table, "cam", "legend"}


def test_columns_and_arrays_are_those_of_the_page(tmp_path: Path) -> None:
    import numpy as np

    task = str(PROBLEMS / "levers" / "task12.toml")
    arrays = tmp_path / "some.npz"
    run = CliRunner().invoke(cli, ["solve", task, "--csv"])
    head = io.StringIO(run.stdout).readline().strip().split(",")
    assert CliRunner().invoke(cli, ["solve", task, "--npz", str(arrays)]).exit_code == 0
    names = set(np.load(arrays))
    columns = {name for name in named("CSV and NPZ of linkages") if "." in name}
    assert columns <= set(head) and len(columns) == 17
    assert columns - names == {
        "E.v", "velocity.p-b.exact", "velocity.p-b.read", "F.B.2-1.read", "driving.moment.read",
        "lever.moment.read",
    }  # fmt: skip
    assert {"reason", "reasons"} <= names


def test_the_record_of_checked_works_has_the_keys_of_the_page(tmp_path: Path) -> None:
    args = ["check", str(PROBLEMS / "linkages" / "ex3-variants.toml")]
    run = CliRunner().invoke(cli, [*args, str(PROBLEMS / "groups" / "ex3.csv"), "--json"])
    works = json.loads(run.stdout)
    said = named("Checked works")
    assert said <= {key for work in works for key in (*work, *work["answers"][0])}
