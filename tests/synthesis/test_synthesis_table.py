"""``[synthesis]``: sizes that follow from given data, what may name them, and the faults."""

from __future__ import annotations

import json
import re
import zipfile
from contextlib import nullcontext
from itertools import product
from math import radians, sin, sqrt, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from doors import (
    SYNTHESIS_KINDS as KINDS,
    TABLE_KINDS as SYNTHESIS_KINDS,
    DoubtWarning,
    ModelProblem as Problem,
    Parameters,
    ProblemError,
    SynthesisFormulas,
    SynthesisSection,
    SynthesisTask,
    cli,
    construction_of,
    declared,
    default_keys,
    fingerprint_of,
    get_language,
    options_of,
    pose,
    reading_warnings,
    solution_record as record,
    source_parse,
    statement_given_facts as given_facts,
    verification_problem_text as problem_text,
)
from test_synthesis import ASKED, made

from planmethod import load, loads, solve

SHAPER = """
[synthesis]
kind = "slotted"
K_v = 1.55
centres = 0.42
stroke = 0.36
[frame]
O3 = [0, 0]
O1 = [0, "l_O1O3"]
guides.x-x = { through = [0, "l_O3M"], angle = 0 }
[links.1]
points = ["O1", "A", "S1"]
O1A = "l_O1A"
S1 = { on = "O1A", at = "l_AO1/2" }
[links.2]
points = ["A"]
slides = { on = "3", along = "O3E" }
[links.3]
points = ["O3", "E", "B"]
O3E = "l_O3D + 0.05"
B = { on = "O3E", at = "l_O3B" }
[links.4]
points = ["B", "C"]
BC = "l_BC"
[links.5]
points = ["C"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = ["phi_0", "phi_0 + 90"]
omega = 10
[assembly]
E = "above O3"
C = "right of B"
[variants.slower]
synthesis.K_v = 1.3
[variants.told]
links.1.O1A = 0.1
"""

ROCKER = """
[synthesis]
kind = "crank-rocker"
K_v = 1.25
swing = 44
rocker = 0.26
points = { O = "A", A = "B", B = "C", C = "D" }
[frame]
A = [0, 0]
D = ["l_AD", 0]
[links.1]
points = ["A", "B"]
AB = "l_AB"
[links.2]
points = ["B", "C"]
BC = "l_BC"
[links.3]
points = ["D", "C"]
DC = "l_DC"
[driver]
link = "1"
phi = 35
omega = 12
[assembly]
C = "left of BD"
"""


def task_of(problem: Problem) -> SynthesisTask:
    assert problem.synthesis is not None
    return problem.synthesis


def lengths_of(text: str, **more: Any) -> dict[str, float]:
    return {name: metres for _, name, metres in loads(text, name="own", **more).lengths}


def test_a_shaper_has_the_sizes_of_its_given_data() -> None:
    for variant, ratio in ((None, 1.55), ("slower", 1.3)):
        half = radians(90.0 * (ratio - 1.0) / (ratio + 1.0))
        problem = loads(SHAPER, name="own", variant=variant)
        found = {name: metres for _, name, metres in problem.lengths}
        assert found["O1A"] == pytest.approx(0.42 * sin(half), rel=1e-14)
        assert found["O3E"] == pytest.approx(0.42 + 0.42 * sin(half) + 0.05, rel=1e-14)
        assert problem.bodies["3"].points["B"] == pytest.approx(0.18 / sin(half), rel=1e-12)
        assert problem.bodies["1"].points["S1"] == pytest.approx(found["O1A"] / 2, rel=1e-14)
        assert problem.bodies["0"].points["O1"] == 0.42j
        turned = solve(problem)
        assert abs(turned.links["3"].omega[0]) < 1e-12  # an extreme position


def test_a_rocker_in_the_letters_of_the_file_swings_by_its_given_angle() -> None:
    found = lengths_of(ROCKER)
    problem = loads(ROCKER, name="own")
    frame = abs(problem.bodies["0"].points["D"])
    ends = []
    for span in (found["BC"] + found["AB"], found["BC"] - found["AB"]):
        cosine = (frame**2 + found["DC"] ** 2 - span**2) / (2.0 * frame * found["DC"])
        ends.append(np.degrees(np.arccos(cosine)))
    assert abs(ends[0] - ends[1]) == pytest.approx(44.0, rel=1e-9)
    assert {"l_AB", "l_BC", "l_DC", "l_AD", "phi_0", "theta"} <= task_of(problem).values.keys()


@pytest.mark.parametrize("name", ASKED)
def test_a_written_file_gives_the_same_mechanism_and_its_given_data(name: str) -> None:
    """It has no length as a number, but for those of the table."""
    found, problem = made(*ASKED[name])
    text = problem_text(found, "test", get_language("en"))
    lengths = found.metres()
    for _, pair, metres in problem.lengths:
        assert metres == lengths[pair]
    given = {key: value for key, value in found.options.items() if value is not None}
    for key, value in given.items():
        assert np.array(task_of(problem).data[key]) == pytest.approx(np.array(value))
    below = text.partition("[links.1]")[2].partition("[driver]")[0]
    assert not re.search(r"= [0-9]", below)
    told = " ".join(fact.text for fact in given_facts(problem, get_language("en")))
    for key, symbol in (("K_v", "K_{v} = "), ("stroke", "H = "), ("swing", "ψ = ")):
        assert (symbol in told) == (key in given)
    # The rod of a rocker that is nearly a wheel is 79 times as long as the centres are apart.
    doubt = pytest.warns(DoubtWarning, match="BC = 31.76 m") if name == "steep" else nullcontext()
    with doubt:
        record_ = record(solve(problem))["synthesis"]
    assert record_["lengths"] == lengths
    assert record_["given"].keys() == given.keys()


def test_given_has_the_data_and_not_their_consequence() -> None:
    told = [fact.text for fact in given_facts(loads(ROCKER, name="own"), get_language("en"))]
    assert "K_{v} = 1.25" in told
    assert "l_{DC} = 0.26 m" in told
    assert "x_{D} = l_{AD}" in told
    assert "l_{AB}, l_{BC} by synthesis" in told
    assert not any(text.startswith(("l_{AB} =", "l_{BC} =")) for text in told)


def test_letters_of_the_file_are_those_of_the_formulas_and_steps() -> None:
    solution = solve(loads(ROCKER, name="own"))
    told = SynthesisFormulas(construction_of(solution), get_language("en"))
    assert {"l_{AB}", "l_{BC}", "l_{AD}"} <= told.values.keys()
    sizes = lengths_of(ROCKER)
    assert told.values["l_{AB}"] == pytest.approx(sizes["AB"], rel=1e-12)
    assert record(solution)["synthesis"]["points"] == {"O": "A", "A": "B", "B": "C", "C": "D"}


def test_a_slider_crank_follows_from_stroke_ratio_and_offset() -> None:
    """In the unit of the file; its own solution of the triangle."""
    text = """
units = "mm"
[synthesis]
kind = "slider-crank"
stroke = 200
K_v = 1.2
offset = 30
[frame]
O = [0, 0]
guides.x-x = { through = [0, "e"], angle = 0 }
[links.1]
points = ["O", "A"]
OA = "l_OA"
[links.2]
points = ["A", "B"]
AB = "l_AB"
[links.3]
points = ["B"]
slides = { on = "x-x" }
[driver]
link = "1"
phi = 30
omega = 10
[assembly]
B = "right of A"
"""
    found, t = lengths_of(text), tan(radians(90.0 * 0.2 / 2.2))
    assert found["OA"] == pytest.approx(sqrt(0.2**2 - 0.4 * 0.03 * t) / 2, rel=1e-12)
    assert found["AB"] == pytest.approx(sqrt(0.2**2 + 0.4 * 0.03 / t) / 2, rel=1e-12)


def test_the_given_data_are_parameters_and_a_form_does_not_depend_on_them() -> None:
    problem = loads(SHAPER, name="own")
    parameters = Parameters(problem, pose)
    ratio = parameters.find("K_v")
    assert ratio is not None
    assert parameters.find("l_O1A") is None
    changed = parameters.read({ratio: 1.3})
    assert changed.lengths == loads(SHAPER, name="own", variant="slower").lengths
    plain = re.sub(r"\[synthesis\][^\[]*", "", SHAPER.partition("[variants")[0])
    for name, value in sorted(task_of(problem).values.items(), key=lambda one: -len(one[0])):
        plain = plain.replace(f'"{name}"', repr(value))
    half = task_of(problem).values["l_O1A"] / 2
    long = task_of(problem).values["l_O3D"] + 0.05
    start = task_of(problem).values["phi_0"]
    for text, value in (("l_AO1/2", half), ("l_O3D + 0.05", long), ("phi_0 + 90", start + 90)):
        plain = plain.replace(f'"{text}"', repr(value))
    assert fingerprint_of(loads(plain, name="own")) == fingerprint_of(problem)


FAULTS = (
    ('kind = "slotted"', 'kind = "sloted"', "synthesis.kind", "one of slotted"),
    ('kind = "slotted"', "", "synthesis.kind", "missing"),
    ("centres = 0.42", "", "synthesis.centres", "missing"),
    ("centres = 0.42", "centers = 0.42", "synthesis.centers", "unknown key"),
    ("K_v = 1.55", "K_v = 0.8", "synthesis.K_v", "less than 1"),
    ("K_v = 1.55", "K_v = 1", "synthesis.K_v", "There is no such mechanism"),
    ("stroke = 0.36", "stroke = 0.36\noffset = 0.1", "synthesis.offset", "slotted does not take"),
    ("stroke = 0.36", "stroke = 0.36\nrod = 0.01", "synthesis.rod", "it must be longer"),
    ("stroke = 0.36", "stroke = 0.36\nswing = 40", "synthesis", "too much"),
    ("stroke = 0.36", 'stroke = 0.36\npoints.P = "Q"', "synthesis.points.P", "no point 'P'"),
    ('"l_O1A"', '"l_O1B"', "links.1.O1A", "unknown name 'l_O1B'"),
    ('"l_O1A"', "0.2", "links.1.O1A", "0.1396 m by the synthesis, 0.2 m here"),
    ('"l_O1A"', '"l_O1A + 0.1"', "links.1.O1A", "0.1396 m by the synthesis"),
    ('[0, "l_O1O3"]', "[0, 0.5]", "frame.O1", "0.42 m by the synthesis, 0.5 m here"),
)  # fmt: skip


@pytest.mark.parametrize(("old", "new", "path", "message"), FAULTS)
def test_a_fault_is_reported_at_its_place(old: str, new: str, path: str, message: str) -> None:
    assert old in SHAPER
    with pytest.raises(ProblemError) as caught:
        loads(SHAPER.replace(old, new, 1), name="own")
    assert [fault.path for fault in caught.value.faults] == [path]
    assert message in caught.value.faults[0].message
    assert "--" not in str(caught.value)


@pytest.mark.parametrize("lang", ["en", "ru"])
@pytest.mark.parametrize(
    ("data", "path"),
    [
        ('kind = "slider-crank"\nK_v = 1.2\nstroke = 0.2\noffset = 3', "offset"),
        ('kind = "slotted"\nswing = 50\ncentres = 0.4\nstroke = 0.5\nrod = 3e-4', "rod"),
        ('kind = "crank-rocker"\nK_v = 1.2\nswing = 50\nline = [5, 5, 10]', "line"),
        ('kind = "three-positions"\npositions = [[0, 0, 1], [1, 0, 20], [1, 0, 20]]', "positions"),
        ('kind = "three-positions"\npositions = [[0, 0, 1], [1, 0, 2], [1, 1, 2, 1]]', "positions"),
        ('kind = "three-positions"\npositions = [[0, 0, 1], [1, 0, 2], [1, 1]]', "positions[2]"),
    ],
)
def test_what_prevents_a_synthesis_is_told_at_its_key_in_both_languages(
    data: str, path: str, lang: str, tmp_path: Path
) -> None:
    file = tmp_path / "own.toml"
    file.write_text(re.sub(r"kind = .*\n(?:.*\n)*?\[frame", f"{data}\n[frame", SHAPER, count=1))
    told = CliRunner().invoke(cli, ["--lang", lang, "solve", str(file)]).output.splitlines()
    assert len(told) == 2
    place, _, reason = told[1].strip().partition(": ")
    assert place == f"synthesis.{path}"
    assert not reason.startswith(f"{path}:")


def test_contradicting_data_are_told_in_the_order_of_the_options() -> None:
    with pytest.raises(ProblemError) as caught:
        loads(SHAPER.replace("K_v = 1.55", "K_v = 1.55\nswing = 40"), name="own")
    assert caught.value.faults[0].message.startswith("K_v, swing, centres, stroke together")


def test_an_optional_key_does_not_hide_a_missing_one() -> None:
    with pytest.raises(ProblemError) as caught:
        loads(ROCKER.replace("swing = 44\n", ""), name="own")
    assert [fault.path for fault in caught.value.faults] == ["synthesis.swing"]


def test_a_synthesis_that_no_number_names_is_a_warning() -> None:
    unused = re.sub(r'"l_[A-Z]+"', "0.3", ROCKER).replace("AB = 0.3", "AB = 0.1")
    unused = re.sub(r"points = { O.*", 'points = { O = "K", A = "L", B = "M", C = "N" }', unused)
    for text, count in ((ROCKER, 0), (unused, 1)):
        told = [str(one) for one in reading_warnings(loads(text, name="own"))]
        assert sum("[synthesis] is not used" in one for one in told) == count


def test_variants_have_other_given_data() -> None:
    keys = {one.name for one in default_keys(source_parse(ROCKER, name="own"), 0.2)}
    assert {"synthesis.K_v", "synthesis.swing", "synthesis.rocker"} <= keys


def test_a_variant_that_contradicts_is_refused() -> None:
    with pytest.raises(ProblemError, match="by the synthesis"):
        loads(SHAPER, name="own", variant="told")


@pytest.mark.parametrize(("lang", "word"), [("ru", "Синтез"), ("en", "Synthesis")])
def test_every_output_tells_the_synthesis(lang: str, word: str, tmp_path: Path) -> None:
    file = tmp_path / "own.toml"
    file.write_text(ROCKER, encoding="utf-8")

    def run(*args: str) -> str:
        done = CliRunner().invoke(cli, [*args, "--lang", lang])
        assert done.exit_code == 0, done.output
        return done.output

    assert f"1. {word}" in run("protocol", str(file))
    told = json.loads(run("project", str(file), "--json", "-o", str(tmp_path)))
    assert [part["name"] for part in told["parts"]] == ["synthesis", "kinematics", "note"]
    assert (tmp_path / "own" / "1-synthesis.pdf").stat().st_size > 5000
    run("sheet", str(file), "--layout", "synthesis", "--format", "dxf,svg", "-o", str(tmp_path))
    assert word in (tmp_path / "own.svg").read_text(encoding="utf-8")
    run("note", str(file), "--format", "docx", "-o", str(tmp_path))
    (note,) = tmp_path.glob("*.docx")
    words = zipfile.ZipFile(note).read("word/document.xml").decode("utf-8")
    plain = [re.sub("<[^>]+>", "", one) for one in re.findall(r"(?s)<w:p\b.*?</w:p>", words)]
    (last,) = (k for k, text in enumerate(plain) if re.match(r".{0,3}(Grashof|условие Г)", text))
    assert plain[last].endswith(".") and plain[last].count(":") == 1
    assert plain[last - 1].endswith(";")


def test_the_table_has_the_options_of_all_kinds() -> None:
    keys = {one.name for one in declared(SynthesisSection)} - {"kind", "points"}
    assert keys == {name for kind in KINDS for name in options_of(kind)}
    assert (*KINDS,) == SYNTHESIS_KINDS


def test_shipped_presses_have_their_given_data() -> None:
    root = Path(__file__).parents[2] / "problems" / "press"
    for path, lang in product(sorted(root.glob("*.toml")), ("en", "ru")):
        told = [fact.text for fact in given_facts(load(path), get_language(lang))]
        assert any(text.startswith("K_{v} = 1") for text in told)
        assert not any(text.startswith("l_{O1A} = ") for text in told)
