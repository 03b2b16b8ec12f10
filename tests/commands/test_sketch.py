"""Sketches of files that are finished and of those that are not, and the watching of files."""

from __future__ import annotations

import os
import subprocess
import sys
import tomllib
from math import cos
from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import (
    VIEWS,
    Arc,
    Drawing,
    ExitCode,
    Stroke,
    Text,
    cli,
    get_language,
    kinds_loads as loads,
    largest_part,
    sketch,
    unlikely,
)
from waiting import wait_until

EX3 = Path("problems/linkages/ex3.toml").read_text(encoding="utf-8")
FOUR_BAR = """
[frame]
A = [0, 0]
D = [0.5, 0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = {rod}
[links.3]
points = ["C", "D"]
CD = {rocker}
[driver]
link = "1"
phi = {phi}
omega = 10
[assembly]
C = "{rule}"
"""


def drawn(text: str) -> tuple[Drawing, set[str]]:
    """Return the sketch of a text and the links that it shows."""
    part = largest_part(tomllib.loads(text), source="x", name="x", views=VIEWS)
    links = set(part.solution.problem.mechanism.links) if part.solution else set()
    return sketch(part, "", get_language("en"), [str(f) for f in part.faults]), links


def written(drawing: Drawing) -> str:
    return " ".join(item.text for item in drawing.items if isinstance(item, Text))


def without(text: str, line: str) -> str:
    assert line in text
    return "\n".join(one for one in text.splitlines() if not one.startswith(line))


def test_a_finished_file_shows_all_links_and_how_far_the_crank_turns() -> None:
    drawing, links = drawn(EX3)
    assert links == {"1", "2", "3", "4", "5"}
    assert "the crank makes full turns" in written(drawing).lower()
    assert "?" not in written(drawing)


@pytest.mark.parametrize(
    ("text", "links"),
    [
        (without(EX3, "DE"), {"1", "2", "3"}),
        (without(EX3, "E ="), {"1", "2", "3", "4", "5"}),
        (without(EX3, "omega"), {"1", "2", "3", "4", "5"}),
        (EX3[: EX3.index("[driver]")], {"1", "2", "3", "4", "5"}),
        (EX3[: EX3.index("[links.2]")], {"1"}),
        (EX3[: EX3.index("[links.1]")], set()),
        ("", set()),
    ],
)
def test_the_complete_part_of_an_unfinished_file_is_drawn_and_the_rest_is_marked(
    text: str, links: set[str]
) -> None:
    drawing, shown = drawn(text)
    assert shown == links
    given = set(tomllib.loads(text).get("links", {}))
    for link in given - shown:
        if link == "4":  # its point D is drawn
            assert f"{link}?" in written(drawing)
    assert drawing.items


DYAD = """
[links.4]
points = ["C", "E"]
CE = 0.3
[links.5]
points = ["F", "E"]
FE = 0.3
"""


def ways(text: str) -> list[dict[str, str]]:
    part = largest_part(tomllib.loads(text), source="x", name="x", views=VIEWS)
    return [dict(way.rules) for way in part.assemblies]


def test_both_assemblies_are_drawn_with_the_rules_that_choose_them() -> None:
    whole = FOUR_BAR.format(rod=0.4, rocker=0.3, phi=60, rule="above A")
    text = without(without(whole, "C ="), "[assembly]")
    rules = ways(text)
    assert len(rules) == 2
    drawing, _ = drawn(text)
    places = set()
    for one in rules:
        assert f'C = "{one["C"]}"' in written(drawing)
        solution = largest_part(
            tomllib.loads(text + f'\n[assembly]\nC = "{one["C"]}"\n'),
            source="x",
            name="x",
            views=VIEWS,
        ).solution
        assert solution is not None
        places.add(round(float(solution.points["C"].place[0].imag), 6))
    assert len(places) == 2
    assert not ways(whole)


def test_assemblies_of_a_second_group_follow_those_of_the_first() -> None:
    """With C above, the dyad closes in two ways; with C below, it does not reach F."""
    text = FOUR_BAR.format(rod=0.4, rocker=0.3, phi=60, rule="above A")
    text = (
        without(without(text, "C ="), "[assembly]").replace("\nD =", "\nF = [0.6, 0.7]\nD =") + DYAD
    )
    rules = ways(text)
    assert [sorted(one) for one in rules] == [["C", "E"], ["C", "E"]]
    assert len({one["C"] for one in rules}) == 1
    assert len({one["E"] for one in rules}) == 2


def test_arcs_that_do_not_meet_are_drawn_and_the_gap_is_reported_for_the_turn() -> None:
    text = FOUR_BAR.format(rod=0.1, rocker=0.25, phi=90, rule="above D")
    drawing, links = drawn(text)
    assert links == {"1"}
    arcs = [i for i in drawing.items if isinstance(i, Stroke) and i.tag == "arc"]
    assert len(arcs) == 2
    part = largest_part(tomllib.loads(text), source="x", name="x")
    # |BD| is greatest with the crank turned away from D: 0.6 m, for which 0.35 m are there.
    assert "miss by 0.1599 m, by 0.25 m at most over a turn (at phi = 180 deg)" in str(part.trouble)


def test_the_range_of_a_crank_that_does_not_turn_fully_is_an_arc() -> None:
    text = FOUR_BAR.format(rod=0.25, rocker=0.2, phi=20, rule="left of BD")
    drawing, links = drawn(text)
    (arc,) = (i for i in drawing.items if isinstance(i, Arc) and i.tag == "range")
    assert links == {"1", "2", "3"}
    # |BD| = l2 + l3 = 0.45 m at the ends.
    at = 0.5**2 + 0.1**2 - 2 * 0.5 * 0.1 * cos(arc.end)
    assert at == pytest.approx(0.45**2, abs=1e-9)


def test_probable_mistakes_are_reported() -> None:
    slider = """
[frame]
A = [0, 0]
guides.x-x = { through = [0, 150], angle = 0 }
[links.1]
points = ["A", "B"]
AB = 64
[links.2]
points = ["B", "C"]
BC = 100
[links.3]
points = ["C"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = 60
n = 36000
[assembly]
C = "right of B"
"""
    said = list(unlikely(loads(slider, name="x")))
    assert [word in one for word, one in zip(("0.1 m?", "36000", "150 m"), said, strict=True)]
    assert not list(unlikely(loads(EX3, name="x")))


def run(*words: str) -> Result:
    return CliRunner().invoke(cli, ["sketch", *words])


def test_the_command_draws_and_reports_faults(tmp_path: Path) -> None:
    half = tmp_path / "half.toml"
    half.write_text(without(EX3, "DE"), encoding="utf-8")
    result = run(str(half), "-o", str(tmp_path))
    assert result.exit_code == ExitCode.PROBLEM
    assert "links.4.points" in result.output
    assert (tmp_path / "half-sketch.svg").stat().st_size > 1000
    broken = tmp_path / "broken.toml"
    broken.write_text("[frame\n", encoding="utf-8")
    assert run(str(broken), "-o", str(tmp_path)).exit_code == ExitCode.PROBLEM
    assert (tmp_path / "broken-sketch.svg").exists()
    train = run("problems/gears/gears-ex1.toml", "-o", str(tmp_path))
    assert train.exit_code == ExitCode.PROBLEM
    assert "planmethod sheet" in train.output


def test_a_watched_file_is_redrawn_and_its_faults_replace_the_sheet(
    tmp_path: Path,
) -> None:
    file, picture = tmp_path / "my.toml", tmp_path / "my.svg"
    file.write_text(EX3, encoding="utf-8")
    words = ["sheet", str(file), "--watch", "--format", "svg", "-o", str(tmp_path)]
    with subprocess.Popen(
        [sys.executable, "cli.py", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        env={**os.environ, "PYTHONUNBUFFERED": "1"},
    ) as running:
        try:
            whole = _changed(picture, 0)
            _saved(file, without(EX3, "DE"))
            fault = _changed(picture, whole)
            assert fault < whole / 2
            _saved(file, EX3)
            assert _changed(picture, fault) == whole
        finally:
            running.terminate()


def _saved(file: Path, text: str) -> None:
    """Put a text in the place of a file at once: half written, it would be drawn, too."""
    whole = file.with_suffix(".new")
    whole.write_text(text, encoding="utf-8")
    whole.replace(file)


def _changed(picture: Path, size: int) -> int:
    """Return the size of a file once it is another one."""
    wait_until(lambda: picture.exists() and picture.stat().st_size != size)
    return picture.stat().st_size


def test_the_code_of_many_sketches_is_that_of_the_first_fault(tmp_path: Path) -> None:
    faulty, open_ = tmp_path / "faulty.toml", tmp_path / "open.toml"
    faulty.write_text(without(EX3, "DE"), encoding="utf-8")
    open_.write_text(FOUR_BAR.format(rod=0.1, rocker=0.25, phi=90, rule="above D"), "utf-8")

    def code(*files: Path) -> int:
        arguments = ["sketch", *map(str, files), "-o", str(tmp_path)]
        return CliRunner().invoke(cli, arguments).exit_code

    codes = code(faulty), code(open_)
    assert codes == (ExitCode.PROBLEM, ExitCode.ASSEMBLY)
    assert (code(faulty, open_), code(open_, faulty)) == codes
