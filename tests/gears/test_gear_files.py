"""The worked examples, faults of files, and the contract of the command line."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    KINDS_KINDS as KINDS,
    LINKAGES,
    OF_KINDS,
    ExitCode,
    ProblemError,
    RequestedQuantityError,
    cli,
    get_language,
    kind_of,
    requested_quantities_parse as parse,
    speaking,
)
from worked import PROBLEMS, ROOT

FILES = sorted((PROBLEMS / "gears").glob("*.toml"))
SCHEMA = json.loads((ROOT / "planmethod/problem/schema.json").read_text("utf-8"))

SPEEDS = {
    "gears-ex1": "1=330 2=-110 3=50 4=-25 5=-10",
    "gears-ex2": "1=50 2=-75 H=-75 5=-375 4=125 3=0",
    "gears-ex3": "1=1200 2=-8000/7 3=160000/147 H=160000/147 4=0 5=6560000/3087 6=6560000/64827 "
    "7=26240000/842751",
    "gears-ex4": "1=-410 2=2605/3 H=180 3=-6640/9 3'=-6640/9 4=81230/153",
    "gears-ex5": "1=1 2=-2/3 3=1/2 4=-11/2 H=17/4",
    "gears-ex6": "1=1 2=-67/158 H=4/79 3=-11/79 4=88/553 5=4/79",
    "planetary-k10": "1=10 2=25 4=4 5=4 3=-10 6=6",
}
ASKED = {
    "gears-ex1": "U_1_5=-33 U_1_3=33/5 U_1_2=-3 z_5=100 z_2'=20",
    "gears-ex2": "U_1_5=-2/15 U_H_5=1/5 n_5=-375 z_3=80",
    "gears-ex3": "U_1_2=-21/20 U_2'_3=-21/20 U_6'_7=13/4 U_H_6=441/41 U_1_7=2528253/65600 "
    "n_7=26240000/842751",
    "gears-ex4": "n_4=81230/153 U_4_H=8123/2754 z_4=68 W=2 U_1_4^H=-153/91",
    "gears-ex5": "U_1'_3'^H=13/15 U_3_1=1/2 U_1_H=4/17 W=1",
    "gears-ex6": "U_1_H=79/4 W=1 U_1_3^H=-5 U_3'_5=-11/4",
    "planetary-k10": "omega_2=25 omega_4=4 omega_6=6",
}
CONTACTS = {  # name: height, segment
    "gears-ex1": "1-2:16,-60 2'-3:44,-25 3'-4:20,-125/11 4-5:100,125/11 axis 2:64,0 axis 4:60,0",
    "gears-ex2": "1-2:-20,-12 5-4:20,60 4-3:80,0 axis 1:-50,0 axis 4:50,30",
    "gears-ex3": "1-2:20,-1323/41 2'-3:21,-1260/41 6-5':21,-20/7 5-4:20,0 6'-7:-20,400/147 "
    "axis 2:41,0 axis 5:41,-60 axis 7:45,0",
    "gears-ex4": "1-2:28,154980/8123 2-3:76,-407700/8123 3'-4:68,-60 axis 2:52,-126360/8123 "
    "axis 3:94,-228420/8123",
    "gears-ex5": "1-2:28,-168/17 2'-3:40,-120/17 1'-4:60,-360/17 4'-3':65,-195/17 axis 2:70,0 "
    "axis 4:40,-60",
    "gears-ex6": "1-2:20,-60 2-3:100,3300/79 3'-4:40,1320/79 4-5:110,-1320/79 axis 2:60,-720/79 "
    "axis 4:75,0",
    "planetary-k10": "1-2:70,-60 2-3:30,180/7 5-6:60,-144/7 axis 2:50,-120/7 axis 6:20,0",
}
RAYS = {
    "gears-ex1": "1=150 2=-50 3=250/11 4=-125/11 5=-50/11",
    "gears-ex2": "1=16 H=-24 5=-120 4=40 3=0 2=-24",
    "gears-ex3": "1=2646/41 2=-2520/41 3=2400/41 H=2400/41 4=0 5=800/7 6=800/147 7=3200/1911",
    "gears-ex4": "1=-221400/8123 2=468900/8123 H=97200/8123 3=-398400/8123 4=600/17",
    "gears-ex5": "1=240/17 2=-160/17 3=120/17 4=-1320/17 H=60",
    "gears-ex6": "1=120 2=-4020/79 H=480/79 3=-1320/79 4=10560/553 5=480/79",
    "planetary-k10": "1=240/7 2=600/7 4=96/7 5=96/7 3=-240/7 6=144/7",
}


def number(text: str) -> float:
    above, _, below = text.partition("/")
    return int(above) / int(below or 1)


def whole(text: str) -> dict[str, str]:
    return dict(part.split("=") for part in text.split())


def run(*args: str) -> Any:
    return CliRunner().invoke(cli, args)


def gears(path: Path, *args: str) -> dict[str, Any]:
    done = run("solve", str(path), "--json", *args)
    assert done.exit_code == ExitCode.DONE, done.output
    told: dict[str, Any] = json.loads(done.stdout)["gears"]
    return told


@each("path", FILES)
def test_worked_examples_are_exact(path: Path) -> None:
    told = gears(path)
    for label, value in whole(SPEEDS[path.stem]).items():
        exact = value if "/" in value else f"{value}/1"
        assert told["bodies"][label]["exact"] == exact
        unit = "omega" if path.stem == "planetary-k10" else "n"
        assert told["bodies"][label][unit] == number(value)
    for name, value in whole(ASKED[path.stem]).items():
        assert told["asked"][name]["exact"] == (value if "/" in value else f"{value}/1")
    assert all(one["name"] and isinstance(one["holds"], bool) for one in told["conditions"])


@each("path", FILES)
def test_pictures_are_those_of_the_worked_examples(path: Path) -> None:
    picture = gears(path)["picture"]
    text = CONTACTS[path.stem].replace("axis ", "axis_")
    wanted = [part.split(":") for part in text.split()]
    names = [n.replace("_", " ") if "axis" in n else f"pitch {n}" for n, _ in wanted]
    assert sorted(one["name"] for one in picture["contacts"]) == sorted(names)
    found = {one["name"]: (one["height_mm"], one["speed_mm"]) for one in picture["contacts"]}
    # The examples were reckoned at the longest segment of 60 mm and the pole distance of 40 mm.
    share = max(abs(speed) for _, speed in found.values()) / 60.0
    assert 0.5 < share <= 1.0
    for name, (_, values) in zip(names, wanted, strict=True):
        height, speed = (number(v) for v in values.split(","))
        assert found[name] == pytest.approx((height, share * speed))
    rays = {one["label"]: one["segment_mm"] / share / picture["pole_mm"] for one in picture["rays"]}
    expected = {k: number(v) / 40.0 for k, v in whole(RAYS[path.stem]).items()}
    assert rays == pytest.approx(expected)
    assert picture["mu_l"] == 0.001


@each("path", FILES)
def test_files_agree_with_the_schema_and_are_printed_in_both_languages(path: Path) -> None:
    jsonschema.validate(tomllib.loads(path.read_text("utf-8")), SCHEMA)
    for lang in ("ru", "en"):
        done = run("solve", str(path), "--lang", lang)
        assert done.exit_code == ExitCode.DONE, done.output
    assert run("structure", str(path)).exit_code == ExitCode.DONE
    told = json.loads(run("structure", str(path), "--json").stdout)["structure"]
    assert told["chebyshev"] == told["mobility"]


def test_errors_of_the_sources_are_printed_beside_the_exact_values() -> None:
    printed = {
        (path.stem, one["name"]): (one["printed"], one["exact"])
        for path in FILES
        for one in gears(path)["published"]
        if one["note"]
    }
    assert printed["gears-ex2", "n_5"] == (-384.6, "-375/1")
    assert printed["gears-ex3", "U_1_7"] == (38.55, "2528253/65600")
    assert printed["gears-ex4", "n_4"] == (531.2, "81230/153")
    assert printed["gears-ex6", "U_1_H"] == (-7.75, "79/4")
    assert printed["planetary-k10", "omega_2"] == (24, "25/1")


def test_the_audit_compares_the_values_printed_in_the_sources() -> None:
    done = run("audit", *map(str, FILES), "--lang", "en")
    assert done.exit_code == ExitCode.DONE, done.output
    rows = [[cell.strip("| ") for cell in line.split(" | ")] for line in done.stdout.splitlines()]
    differs = [(row[0], row[2], row[3]) for row in rows if "**differs**" in row]
    assert differs == [
        ("n_5", "−384.6", "−375.00"),
        ("U_1_7", "38.55", "38.540"),
        ("n_7", "31.13", "31.136"),
        ("n_4", "531.2", "530.92"),
        ("U_1_H", "−7.75", "19.750"),
        ("omega_2", "24", "25.000"),
    ]


def test_the_difference_has_the_sign_that_the_audit_gives_it() -> None:
    """Printed over exact less one, in percent: -384.6 is larger than -375."""
    lines = run("solve", str(PROBLEMS / "gears/gears-ex2.toml"), "--lang", "en").stdout
    row = next(line.split() for line in lines.splitlines() if line.split()[:2] == ["n_5", "−384.6"])
    assert row[-1] == "2.560"


def test_a_ratio_to_a_body_at_rest_is_null_with_a_reason(tmp_path: Path) -> None:
    text = FILES[1].read_text("utf-8").replace('"U_1_5"', '"U_1_5", "U_1_3"')
    path = tmp_path / "zero.toml"
    path.write_text(text, encoding="utf-8")
    told = gears(path, "--lang", "en")["asked"]["U_1_3"]
    assert told["value"] is None
    assert told["exact"] is None
    assert "is at rest" in told["reason"]
    assert "is at rest" in run("solve", str(path), "--lang", "en").stdout


def test_variants_are_solved_each_and_keep_no_printed_values(tmp_path: Path) -> None:
    path = tmp_path / "train.toml"
    text = FILES[1].read_text("utf-8") + '\n[variants.Б]\n"gears.n" = { 1 = 100 }\n'
    path.write_text(text, encoding="utf-8")
    done = run("solve", str(path), "--all-variants", "--json")
    told = json.loads(done.stdout)
    assert (told["variant"], told["gears"]["bodies"]["5"]["exact"]) == ("Б", "-750/1")
    assert told["gears"]["published"] == []
    assert run("solve", str(path), "--variant", "В").exit_code == ExitCode.PROBLEM


SET = """
wheels = { 1 = 20, 2 = 40, 3 = 100 }
meshes = [{ of = [1, 2], carrier = "H" }, { of = [2, 3], kind = "internal", carrier = "H" }]
fixed = ["3"]
n = { 1 = 6 }
"""
ROW = "wheels = { 1 = 20, 2 = 36 }\nmeshes = [{ of = [1, 2] }]\nn = { 1 = 1 }\n"


@each(
    "text, said",
    [
        (SET.replace("100", "101"), "not coaxial: the axis of 2 is 60 from the main axis by"),
        (
            SET.replace("2 = 40, 3 = 100", "3 = 101") + 'unknown = ["2"]',
            "gives wheel 2 81/2 = 40.5 teeth, not whole",
        ),
        (SET.replace("{ 1 = 6 }", "{ 1 = 6, H = 1 }"), "over-determined: W = 1, and 2 speeds"),
        (SET.replace('["3"]', "[]"), "undetermined: W = 2, and 1 speeds are given"),
        (SET.replace('["3"]', '["3", "1"]'), "1 is fixed, but its speed is given"),
        (SET.replace('["3"]', '["3", "H"]').replace("n =", "# n ="), "the train cannot move"),
        (ROW + 'fixed = ["4"]', "gears.fixed[0]: unknown wheel '4'"),
        (ROW + 'ask = ["U_1_7"]', "gears.ask[0]: the train has no '7'"),
        (ROW + "omega = { 1 = 1 }", "n and omega are both given"),
        (ROW + "modul = 3", "gears.modul: unknown key. Did you mean 'module'?"),
        (ROW.replace("36", "3.5"), "gears.wheels.2: expected a whole number"),
        (ROW.replace("36", "{ r = 0.05 }"), "a radius together with teeth needs the module"),
        (ROW.replace("[1, 2]", '[1, "1\'"]'), "unknown wheel '1''"),
        (ROW.replace("[1, 2]", "[1, 1]"), "1 and 1 are one body"),
        (ROW.replace("] }", '], kind = "externl" }'), "Did you mean 'external'?"),
        (ROW.replace("36", "36, 5 = 20"), "wheel 5 does not mesh with any other"),
        (ROW.replace("n =", "# n ="), "undetermined: W = 1, and 0 speeds"),
        (ROW + 'unknown = ["2"]', "wheel 2 has a size, and is listed in unknown"),
        (ROW.replace(", 2 = 36", "") + 'unknown = ["2"]', "does not determine the teeth of 2"),
        (
            ROW.replace("1 = 20, 2 = 36", "") + 'unknown = ["1", "2"]',
            "does not determine the teeth of 1, 2. Give the teeth of one of them.",
        ),
        (ROW + "coaxial = [[1, 2]]", "1 and 2 mesh, and would turn about one axis"),
        (ROW + 'coaxial = ["1", "2"]', 'list of labels. Write coaxial = [["1", "2"]].'),
        (ROW + 'output = "1"', "gears.output: 1 is an input"),
        (SET + 'output = "3"', "gears.output: 3 is fixed"),
        (ROW.replace("] }", '], kind = "rack", carrier = "H" }'), "a rack is guided in the frame"),
        (ROW.replace("36", "{ r = 0.0305 }") + "module = 2", "2r/m = 30.5 teeth, not whole"),
        ("wheels = 3\nmeshes = 4", "gears.wheels: expected a table"),
        ("", "gears.wheels: missing"),
        (ROW + "[published.x]\nvalue = 1", "published.x.what: unknown quantity 'x'"),
    ],
)
def test_an_impossible_train_is_rejected_with_a_reason(
    text: str, said: str, tmp_path: Path
) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(f"[gears]\n{text}\n", encoding="utf-8")
    done = run("solve", str(path), "--json")
    assert done.exit_code == ExitCode.PROBLEM, done.output
    assert said in done.stderr, done.stderr
    assert not done.stdout


@each("lang, said", [("ru", "на 60 по зацеплению 1-2 и на 61 по 2-3"), ("en", "is 60 from the")])
def test_that_a_train_is_not_coaxial_has_numbers_in_every_language(
    lang: str, said: str, tmp_path: Path
) -> None:
    path = tmp_path / "faulty.toml"
    path.write_text(f"[gears]\n{SET.replace('100', '101')}", encoding="utf-8")
    kind = kind_of(path)
    with speaking(lang), pytest.raises(ProblemError, match=said):
        kind.solved_document(kind.load(path, None), get_language(lang))


def test_options_of_linkages_are_rejected() -> None:
    done = run("solve", str(FILES[0]), "--csv")
    assert done.exit_code == ExitCode.USAGE
    assert "--csv applies to linkages" in done.stderr


def test_a_kind_is_known_by_its_table_and_links_make_a_linkage(tmp_path: Path) -> None:
    assert {kind_of(path).table for path in FILES} == {"gears"}
    both = tmp_path / "both.toml"
    both.write_text("[gears]\n[links]\n")
    assert kind_of(both) is LINKAGES
    assert [kind.table for kind in KINDS if kind is not LINKAGES] == [*OF_KINDS]


def test_names_of_requested_quantities_are_parsed() -> None:
    known = ("1", "5", "15", "H", "2'")
    assert parse("U_15", ("1", "5")).labels == ("1", "5")
    assert parse("U_1_2'^H", known).carrier == "H"
    for text, said in [("U_1555", "2 labels"), ("W_1", "unknown"), ("z_1^H", "not taken")]:
        with pytest.raises(RequestedQuantityError, match=said):
            parse(text, known)
