"""Mechanisms of PMKS+, Linkage, pylinkage and Pyslvs, against contours closed by numpy."""

from __future__ import annotations

import json
import random
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from cases import each, some
from click.testing import CliRunner
from doors import ProblemError, cli

import planmethod as pm

SAME = 1e-9
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"

# Coordinates of one position: four-bar, slider-crank, six-link with a coupler point.
FOUR_BAR = {"A": 0j, "B": 30 + 40j, "C": 150 + 90j, "D": 200 + 0j}
SLIDER_CRANK = {"A": 0j, "B": 30 + 40j, "C": 150 - 20j}
SIX_LINK = {**FOUR_BAR, "E": 110 + 130j, "F": 210 + 170j, "G": 290 + 20j}
OMEGA = 2.0


def rates(places: dict[str, complex], kind: str) -> dict[str, complex]:
    """Return the velocities of the points, crank AB at `OMEGA`, by the closed contours."""
    z = places
    found = {"B": 1j * OMEGA * (z["B"] - z["A"])}

    def meet(p: str, q: str, v_q: complex, c: str) -> tuple[float, float]:
        bars = 1j * (z[c] - z[p]), -1j * (z[c] - z[q])
        matrix = [[w.real for w in bars], [w.imag for w in bars]]
        gap = v_q - found[p]
        one, two = np.linalg.solve(matrix, [gap.real, gap.imag])
        found[c] = found[p] + 1j * one * (z[c] - z[p])
        return one, two

    if kind == "slider":
        omega = -found["B"].imag / (z["C"] - z["B"]).real
        found["C"] = found["B"] + 1j * omega * (z["C"] - z["B"])
        return found
    omega, _ = meet("B", "D", 0, "C")
    if kind == "six":
        found["E"] = found["B"] + 1j * omega * (z["E"] - z["B"])
        meet("E", "G", 0, "F")
    return found


MECHANISMS = [("four", FOUR_BAR), ("slider", SLIDER_CRANK), ("six", SIX_LINK)]
BODIES = {
    "four": ("AB", "BC", "DC"), "slider": ("AB", "BC"), "six": ("AB", "BCE", "DC", "EF", "GF"),
}  # fmt: skip
FIXED = {"four": "AD", "slider": "A", "six": "ADG"}


# Files, written as the programs write them -------------------------------------------------------


def base64(number: int) -> str:
    text = ""
    rest = abs(number)
    while True:
        text, rest = DIGITS[rest % 64] + text, rest // 64
        if not rest:
            return "0" + text if number < 0 else text


def decimal(x: float) -> str:
    return base64(round(x * 1000))


def pmks(kind: str, places: dict[str, complex], *, rpm: int = 20, clockwise: bool = False) -> str:
    """Return a share link, in centimetres: the places are millimetres."""
    joints = []
    for name, z in places.items():
        flags = 16 + 4 * (name in FIXED[kind]) + 2 * (name == "A")
        joints.append(
            f"{base64(flags)}{name},{name},{decimal(z.real / 10)},{decimal(z.imag / 10)},0"
        )
    links = [f"YR{body},{body},Fe,Fe,0,0,c5cae9,{','.join(body)},," for body in BODIES[kind]]
    if kind == "slider":
        z = places["C"]
        joints.append(f"LP,P,{decimal(z.real / 10)},{decimal(z.imag / 10)},0")
        links.append("YPCP,CP,Fe,0,0,0,,C,P,,")
    settings = f"{base64(152 + clockwise)}.Ay,1E8.{base64(rpm)},0.1011."
    text = settings + ".".join(joints) + ".." + ".".join(links) + "...N_"
    return f"https://app.pmksplus.com/?{text}{DIGITS[len(text) % 62]}"


def linkage2(kind: str, places: dict[str, complex], *, rpm: float = 19.098593171027442) -> str:
    """Return a file of Linkage: 1/96 inch."""
    ids = {name: str(k) for k, name in enumerate(places)}
    lines = [
        "<linkage2>",
        '\t<program zoom="1.0" xoffset="0" scalefactor="1.0" units="Millimeters"/>',
    ]
    for name, z in places.items():
        role = ' anchor="true"' if name in FIXED[kind] else ' draw="true"'
        role += f' input="true" rpm="{rpm!r}"' if name == "A" else ""
        x, y = z.real * 96 / 25.4, z.imag * 96 / 25.4
        head = f'\t<connector id="{ids[name]}" layer="16" x="{x!r}" y="{y!r}"{role} color="32768"'
        if kind == "slider" and name == "C":
            limits = '<slidelimit id="8"/><slidelimit id="9"/>'
            lines.append(f'{head} slider="true">{limits}</connector>')
        else:
            lines.append(head + "/>")
    if kind == "slider":
        for key, x in (("8", 50.0), ("9", 300.0)):
            at = f'x="{x * 96 / 25.4!r}" y="{-20.0 * 96 / 25.4!r}"'
            lines.append(f'\t<connector id="{key}" layer="16" {at} anchor="true" color="1"/>')
        lines.append('\t<Link id="7"><connector id="8"/><connector id="9"/></Link>')
    for k, body in enumerate(BODIES[kind]):
        pins = "".join(f'<connector id="{ids[p]}"/>' for p in body)
        lines.append(f'\t<Link id="{k}" layer="16" linesize="1" solid="true">{pins}</Link>')
    return "\n".join([*lines, "\t<selected></selected>", "</linkage2>"])


def legacy(kind: str, places: dict[str, complex]) -> str:
    """Return JSON of pylinkage's class Linkage, in millimetres; hints are a little off."""

    def ref(name: str) -> dict[str, Any]:
        z = places[name]
        if name == "A":
            return {"inline": True, "type": "Static", "x": z.real, "y": z.imag, "name": name}
        return {"ref": name}

    def joint(type_: str, name: str, *parents: str, **more: float) -> dict[str, Any]:
        z = places[name] + (0.01 if type_ in ("Revolute", "Prismatic") else 0)
        refs = {f"joint{k}": ref(p) for k, p in enumerate(parents)}
        return {"type": type_, "name": name, "x": z.real, "y": z.imag, **refs, **more}

    def gap(p: str, q: str) -> float:
        return abs(places[p] - places[q])

    joints = [joint("Static", name) for name in FIXED[kind] if name != "A"]
    joints.append(joint("Crank", "B", "A", distance=gap("A", "B"), angle=OMEGA))
    if kind == "slider":
        places = {**places, "P": 50 - 20j, "Q": 300 - 20j}
        joints += [joint("Static", name) for name in "PQ"]
        joints.append(joint("Prismatic", "C", "B", "P", "Q", revolute_radius=gap("B", "C")))
    else:
        size = {"distance0": gap("B", "C"), "distance1": gap("D", "C")}
        joints.append(joint("Revolute", "C", "B", "D", **size))
    if kind == "six":
        turn = np.angle((places["E"] - places["B"]) / (places["C"] - places["B"]))
        joints.append(joint("Fixed", "E", "B", "C", distance=gap("B", "E"), angle=float(turn)))
        size = {"distance0": gap("E", "F"), "distance1": gap("G", "F")}
        joints.append(joint("Revolute", "F", "E", "G", **size))
    order = [one["name"] for one in joints]
    return json.dumps({"name": "legacy", "joints": joints[::-1], "solve_order": order})


def mechanism(kind: str, places: dict[str, complex]) -> str:
    """Return JSON of pylinkage's class Mechanism, in millimetres."""
    joints: list[dict[str, Any]] = []
    for name, z in places.items():
        type_ = "ground" if name in FIXED[kind] else "revolute"
        joints.append({"id": name, "type": type_, "position": [z.real, z.imag]})
    links: list[dict[str, Any]] = []
    for body in BODIES[kind]:
        links.append({"id": body, "type": "link", "joints": [*body]})
    links[0] |= {"type": "driver", "motor_joint": "A"}
    links[0] |= {"angular_velocity": OMEGA, "initial_angle": 0.9}
    if kind == "slider":
        joints[-1] |= {"type": "prismatic", "axis": [1.0, 0.0]}
        joints[-1] |= {"slide_distance": 0.0}
        for name, x in (("P", 50.0), ("Q", 300.0)):
            joints.append({"id": name, "type": "ground", "position": [x, -20.0]})
        links.append({"id": "guide", "type": "link", "joints": ["P", "Q", "C"]})
    frame = {"id": "ground", "type": "ground", "joints": [*FIXED[kind]]}
    return json.dumps({"name": kind, "joints": joints, "links": [frame, *links]})


def pyslvs(kind: str, places: dict[str, complex]) -> str:
    """Return a project of Pyslvs in YAML, which folds its lines."""
    joints = []
    for name, z in places.items():
        links = ["ground"] if name in FIXED[kind] else []
        links += [f"L{k}" for k, body in enumerate(BODIES[kind], 1) if name in body]
        type_ = "R"
        if kind == "slider" and name == "C":
            type_, links = "RP, A[0.0]", ["ground", *links]
        joints.append(f"J[{type_}, color[Green], P[{z.real}, {z.imag}], L[{', '.join(links)}]]")
    text = "M[" + ", ".join(joints) + "]"
    folded = text.replace(", J", ",\n  J")
    return f"input:\n- - 0\n  - 1\nmechanism: {folded}\npyslvs_ver: 20.5.0\n"


# Tests -------------------------------------------------------------------------------------------


def check(found: pm.peers.Imported, kind: str, places: dict[str, complex], omega: float) -> None:
    """Compare all points, by their places, with the coordinates and the closed contours."""
    solution = found.mechanism.solve()
    assert len(solution.positions) == 1
    expected = rates(places, kind)
    points = solution.points.values()
    for name, v in expected.items():
        z = places[name] / 1000
        near = min(points, key=lambda point: abs(point.place[0] - z))
        assert abs(near.place[0] - z) < SAME
        assert abs(near.velocity[0] - v / 1000 * omega / OMEGA) < SAME, name


@each("kind, places", MECHANISMS)
def test_share_links_of_pmks(kind: str, places: dict[str, complex]) -> None:
    link = pmks(kind, places)
    check(pm.peers.loads(link), kind, places, 20 * np.pi / 30)
    check(pm.peers.loads(link.partition("?")[2]), kind, places, 20 * np.pi / 30)
    found = pm.peers.loads(pmks(kind, places, clockwise=True))
    check(found, kind, places, -20 * np.pi / 30)
    assert found.program == "PMKS+"
    assert any("masses" in remark or "масс" in remark for remark in found.remarks)


@each("kind, places", MECHANISMS)
def test_files_of_linkage(kind: str, places: dict[str, complex]) -> None:
    found = pm.peers.loads(linkage2(kind, places))
    check(found, kind, places, OMEGA)


@each("kind, places", MECHANISMS)
def test_json_of_pylinkage(kind: str, places: dict[str, complex]) -> None:
    check(pm.peers.loads(mechanism(kind, places), units="mm"), kind, places, OMEGA)
    check(pm.peers.loads(legacy(kind, places), units="mm"), kind, places, OMEGA)


@each("kind, places", MECHANISMS)
def test_projects_of_pyslvs(kind: str, places: dict[str, complex]) -> None:
    text = pyslvs(kind, places)
    found = pm.peers.loads(text)
    check(found, kind, places, 1.0)  # the program has no speeds
    assert any("omega = 1" in remark for remark in found.remarks)
    check(
        pm.peers.loads(text.partition("mechanism: ")[2].partition("pyslvs")[0]), kind, places, 1.0
    )


def both(one: pm.Problem, two: pm.Problem) -> float:
    """Return the greatest difference of two problems in places and velocities of their points."""
    a, b = pm.Solution(one), pm.Solution(two)
    names = a.points.keys() & b.points.keys()
    assert names >= {"B", "C"}
    gaps = [
        max(abs(p.place - q.place).max(), abs(p.velocity - q.velocity).max())
        for p, q in ((a.points[name], b.points[name]) for name in names)
    ]
    return float(max(gaps))


@each("kind, places", MECHANISMS)
def test_export_to_pylinkage_and_to_python_reads_back_equal(
    kind: str, places: dict[str, complex]
) -> None:
    made = pm.peers.loads(mechanism(kind, places), units="mm").mechanism
    again = pm.peers.loads(pm.peers.to_pylinkage(made.problem)).mechanism
    assert both(made.problem, again.problem) < SAME
    program = pm.peers.to_script(made).partition("s = m.solve()")[0]
    names: dict[str, Any] = {}
    exec(program, names)
    assert names["m"].to_dict() == made.to_dict()


def test_shipped_mechanisms_are_exported_with_their_slots() -> None:
    count = 0
    for path in sorted(Path("problems/linkages").glob("*.toml"))[::5]:
        problem = pm.Mechanism.from_file(path).problem
        if problem.drive.gear_drive or problem.drive.cam_drive or problem.drive.posed:
            continue
        try:
            text = pm.peers.to_pylinkage(problem)
        except ProblemError as error:
            assert "pylinkage" in str(error)
            continue
        start = problem.drive.positions[0]
        again = pm.peers.loads(text).mechanism.solve()
        one = pm.Solution(problem, positions=[start])
        for name in one.points.keys() & again.points.keys() & {"B", "C", "D", "E"}:
            off = abs(one.points[name].velocity - again.points[name].velocity).max()
            assert off < 1e-9 * max(1.0, abs(one.points[name].velocity).max()), (path, name)
        count += 1
    assert count > 3


def test_a_slot_beside_the_points_of_a_link_is_exported_with_joints_of_its_own() -> None:
    problem = pm.Mechanism.from_file("problems/levers/task-50.toml").problem
    assert any(slide.offset or slide.towards is None for slide in problem.slides.values())
    again = pm.peers.loads(pm.peers.to_pylinkage(problem)).mechanism.solve()
    one = pm.Solution(problem, positions=problem.drive.positions[:1])
    for name in one.points.keys() & again.points.keys():
        off = abs(one.points[name].velocity - again.points[name].velocity).max()
        assert off < 1e-9 * max(1.0, abs(one.points[name].velocity).max()), name


@pytest.mark.parametrize(
    ("path", "words"),
    [("levers/task-3", "one slot for a pin"), ("linkages/five-bar", "one crank")],
)
def test_what_pylinkage_cannot_move_is_named(path: str, words: str) -> None:
    problem = pm.Mechanism.from_file(f"problems/{path}.toml").problem
    with pytest.raises(ProblemError, match=words):
        pm.peers.to_pylinkage(problem)


WHITWORTH = (
    "2P.Ay,1E8.K,0.1011.MA,A,0,0,0.GB,B,0,ku,0.KC,C,Fe,0,0.GD,D,095,1A7,0.HP,P,0,ku,0,CD,C,D.."
    "YRAB,AB,Fe,Fe,0,NS,c5cae9,A,B,,.YRCD,CD,Fe,Fe,3H,b4,303e9f,C,D,,.YPBP,BP,Fe,0,0,0,,B,P,,..."
    "N_w"
)
"""Template of PMKS+ with a slot on a moving link, and a weld below."""

YOKE = (
    "2P.Ay,1E8.K,0.1011.MA,A,0,0,0.GB,B,Fe,0,0.OC,C,Fe,0VG,0.GD,D,Fe,S8,0.HE,E,Fe,0,0,CD,C,D."
    "LF,F,Fe,0VG,0..YRAB,AB,Fe,Fe,7q,0,c5cae9,A,B,,.YRCD,CD,Fe,Fe,Fe,01a,303e9f,C,D,,."
    "YPBE,BE,Fe,0,0,0,,B,E,,.YPCF,CF,Fe,0,0,0,,C,F,,...N_Z"
)


def test_templates_of_pmks_with_slots_and_welds() -> None:
    problem = pm.peers.loads(WHITWORTH).mechanism.problem
    (slide,) = problem.slides.values()
    assert (slide.pin, slide.label) == ("B", "CD")
    yoke = pm.peers.loads(YOKE).mechanism.solve([0.0, 90.0])
    crank = 0.01  # 1 cm
    omega = -20 * np.pi / 30
    np.testing.assert_allclose(yoke.points["C"].velocity, [0, -crank * omega], atol=1e-12)


def test_what_is_not_understood_is_named() -> None:
    text = linkage2("four", FOUR_BAR).replace(' color="32768"', ' color="1" weight="3"', 1)
    text = text.replace("</linkage2>", '<Link id="9"><connector id="1"/></Link><notes/></linkage2>')
    remarks = " ".join(pm.peers.loads(text).remarks)
    assert "weight" in remarks and "<notes>" in remarks
    data = json.loads(mechanism("four", FOUR_BAR))
    data["joints"][1]["friction"] = 1
    assert "B: friction" in " ".join(pm.peers.loads(json.dumps(data)).remarks)
    text = pyslvs("four", FOUR_BAR) + "path:\n  a: []\n"
    assert "path" in " ".join(pm.peers.loads(text).remarks)


@each(
    "text, told",
    [
        ("", "none of these programs"),
        ("title = 1", "none of these programs"),
        (pmks("four", FOUR_BAR)[:-1] + "#", "cut off"),
        (pmks("four", FOUR_BAR).replace("KD,D", "MD,D"), "needs one"),
        (linkage2("four", FOUR_BAR).replace("<linkage2>", "<linkage2><!DOCTYPE a>"), "entities"),
        (linkage2("four", FOUR_BAR)[:-9], "XML"),
        (linkage2("four", FOUR_BAR).replace('solid="true"', 'actuator="true"', 1), "actuator"),
        (linkage2("four", FOUR_BAR).replace('x="0.0"', 'x="nan"', 1), "not a number"),
        (linkage2("four", FOUR_BAR).replace('input="true"', ""), "no link is driven"),
        (linkage2("four", FOUR_BAR).replace('id="3"', 'id="0"', 1), "there twice"),
        ('{"joints": [', "JSON"),
        ('{"joints": 3}', "no list of joints"),
        ('{"joints": [{"type": "Cam", "name": "A"}]}', "'Cam'"),
        ("[" * 100000 + '"joints"', "none of these programs"),
        ('{"joints": ' + "[" * 100000, "JSON"),
        (mechanism("four", FOUR_BAR).replace('"joints": ["B", "C"]', '"joints": ["B", "X"]'), "X"),
        (mechanism("four", FOUR_BAR).replace('"link"', '"driver"', 1), "two drivers"),
        (legacy("four", FOUR_BAR).replace('"distance0": 130.0', '"distance0": 1.0'), "lengths"),
        ("M[J[R, P[0, 0], L[ground, a]], J[Q]]", "from here: J[Q]"),
        (pyslvs("four", FOUR_BAR).replace("  - 1", "  - 1\n- - 3\n  - 2"), "2 inputs"),
        ("M[" + "J[R, P[0, 0], L[a]]," * 300 + "]", "more than"),
    ],
)
def test_damaged_files_have_one_clear_fault(text: str, told: str) -> None:
    with pytest.raises(ProblemError) as caught:
        pm.peers.loads(text, name="x").mechanism.problem  # noqa: B018
    assert told in str(caught.value)


def test_the_command_converts_both_ways(tmp_path: Path) -> None:
    runner = CliRunner()
    path, toml, py = tmp_path / "a.linkage2", tmp_path / "a.toml", tmp_path / "a.py"
    path.write_text(linkage2("six", SIX_LINK), "utf-8")
    run = runner.invoke(cli, ["--lang", "en", "convert", str(path), str(toml), "--round", "1mm"])
    assert run.exit_code == 0, run.output
    assert "points have other names" in run.output
    lengths = [1000 * x for _, _, x in pm.load(toml).lengths]
    assert np.allclose(lengths, np.round(lengths), atol=1e-9)
    for target in (tmp_path / "a.json", py):
        run = runner.invoke(cli, ["convert", str(toml), str(target)])
        assert run.exit_code == 0, run.output
    again = pm.peers.load(tmp_path / "a.json").mechanism.problem
    assert both(pm.load(toml), again) < SAME
    assert runner.invoke(cli, ["convert", str(py)]).exit_code != 0
    run = runner.invoke(cli, ["convert", pmks("slider", SLIDER_CRANK), "--to", "python"])
    assert run.exit_code == 0 and "pm.Mechanism" in run.output
    (tmp_path / "big.json").write_text('{"joints": 1}' + " " * 1_000_001, "utf-8")
    with pytest.raises(ProblemError):
        pm.peers.load(tmp_path / "big.json")


@pytest.mark.parametrize("write", [pmks, linkage2, legacy, mechanism, pyslvs])
def test_spoiled_files_raise_only_errors_of_the_program(write: Any) -> None:
    """Characters are exchanged, left out and doubled, at random."""
    text, chance = write("slider", SLIDER_CRANK), random.Random(7)
    signs = '0-.,[]{}"<>=xAJ&\x00'
    for _ in range(some(400, 60)):
        spoiled = [*text]
        for _ in range(chance.randint(1, 3)):
            k = chance.randrange(len(spoiled))
            spoiled[k] = chance.choice(["", 2 * spoiled[k], chance.choice(signs)])
        try:
            pm.peers.loads("".join(spoiled)).mechanism.problem  # noqa: B018
        except ProblemError as error:
            assert str(error)


def spoil(value: Any, chance: random.Random) -> Any:
    """Return JSON with entries that are left out, or of another type."""
    if chance.random() < 0.03:
        return chance.choice([None, 1, "x", [], {}])
    if isinstance(value, dict):
        return {k: spoil(own, chance) for k, own in value.items() if chance.random() > 0.02}
    return [spoil(own, chance) for own in value] if isinstance(value, list) else value


@pytest.mark.parametrize("write", [legacy, mechanism])
def test_json_of_other_types_raises_only_errors_of_the_program(write: Any) -> None:
    data, chance = json.loads(write("six", SIX_LINK)), random.Random(3)
    for _ in range(some(2000, 200)):
        try:
            pm.peers.loads(json.dumps(spoil(data, chance))).mechanism.problem  # noqa: B018
        except ProblemError as error:
            assert str(error)
