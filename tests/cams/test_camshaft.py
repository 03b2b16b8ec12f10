"""Cams on one shaft, beside closed laws, a shifted time axis, and the geometry of the key."""

from __future__ import annotations

import itertools
import json
import re
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM as CHROMIUM, browsing
from click.testing import CliRunner
from doors import TURN, cli, kind_of
from numpy.typing import NDArray
from worked import path_of

from scripts.reference import schema

PATH = path_of("camshafts/automatic")
TEXT = PATH.read_text("utf-8")
Reals = NDArray[np.float64]


def run(*words: str) -> str:
    told = CliRunner().invoke(cli, [*words])
    assert told.exit_code == 0, told.output
    return told.output


def record(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(run("solve", str(path), "--json"))
    return found


def quintic(x: Reals) -> Reals:
    return 10 * x**3 - 15 * x**4 + 6 * x**5


def sine(x: Reals) -> Reals:
    return x - np.sin(TURN * x) / TURN


def lift(
    phi: NDArray[np.floating[Any]],
    law: Callable[[Reals], Reals],
    *moves: tuple[float, float, float],
) -> Reals:
    """Return the sum of closed laws: each from an angle, over a length, by a height."""
    return sum((h * law(np.clip((phi - a) / b, 0.0, 1.0)) for a, b, h in moves), np.zeros_like(phi))


def test_lifts_agree_with_closed_laws_of_the_shaft_angle() -> None:
    found = record(PATH)
    phi = np.array([one["phi_deg"] for one in found["positions"]])
    swing = 0.1 * np.radians(18)
    expected = {
        "A": lift((phi - 30) % 360, quintic, (0, 120, 0.03), (160, 90, -0.03)),
        "B": lift((phi - 150) % 360, sine, (0, 70, swing), (170, 80, -swing)),
        "C": lift((phi - 320) % 360, quintic, (0, 60, 0.012), (80, 60, -0.012),
                  (180, 50, 0.008), (230, 60, -0.008)),
    }  # fmt: skip
    for name, lifts in expected.items():
        told = [one[name]["s"] for one in found["positions"]]
        assert told == pytest.approx(lifts, abs=1e-9 * 0.03)
        assert np.ptp(told) > 0


def test_each_cam_is_the_cam_of_a_file_of_its_own(tmp_path: Path) -> None:
    found = record(PATH)
    for part in TEXT.split("[[cams]]")[1:]:
        own = part.partition("[stamp]")[0]
        name = re.search(r'name = "(\w)"', own)
        assert name is not None
        kept = re.sub(r"(?m)^(name|phase) = .*$", "", own)
        path = tmp_path / "alone.toml"
        path.write_text(f"[cam]{kept}" + ("" if "n = 60" in kept else "\n"), "utf-8")
        alone = record(path)
        (cam,) = (one for one in found["cams"] if one["name"] == name[1])
        assert {key: cam[key] for key in alone if key in cam} == {
            key: value for key, value in alone.items() if key in cam
        }
        assert {*alone} - {*cam} == {"schema", "problem", "kind"}


@pytest.mark.parametrize("n", [60, -60])
def test_the_key_points_up_when_the_shaft_is_at_zero(tmp_path: Path, n: int) -> None:
    path = tmp_path / "shaft.toml"
    path.write_text(TEXT.replace("\nn = 60", f"\nn = {n}"), "utf-8")
    for cam in record(path)["cams"]:
        # the cam turns from the angle of the shaft zero to its phase, as its sheet shows it
        way = 1 if n > 0 else -1
        at_zero = cam["key_deg"] - way * cam["phase_deg"]
        assert at_zero == pytest.approx(90.0)


def test_spans_are_a_turn_without_gaps() -> None:
    for cam in record(PATH)["cams"]:
        spans = cam["spans"]
        assert spans[0]["from_deg"] == 0.0
        assert spans[-1]["to_deg"] == pytest.approx(360.0)
        for one, other in itertools.pairwise(spans):
            assert one["to_deg"] == pytest.approx(other["from_deg"])
        begins = [s["from_deg"] for s in spans if s["phase"] == "rise" and not s["continued"]]
        assert any(start == pytest.approx(cam["phase_deg"]) for start in begins)


def test_forty_random_shafts_shift_each_lift_by_its_phase(tmp_path: Path) -> None:
    rng = np.random.default_rng(7)
    path = tmp_path / "random.toml"
    for _ in range(40):
        cams, known = list[str](), dict[str, tuple[float, float, float, float, float]]()
        for name in "KLM"[: int(rng.integers(2, 4))]:
            rise, rest, back = (float(rng.integers(40, 100)) for _ in range(3))
            phase, stroke = float(rng.integers(-360, 361)), float(rng.integers(5, 40)) / 1000
            known[name] = (phase, rise, rest, back, stroke)
            cams.append(
                f'[[cams]]\nname = "{name}"\nphase = {phase}\nfollower = "translating"\n'
                f"stroke = {stroke}\nrise = {rise}\nupper_dwell = {rest}\nreturn = {back}\n"
                'law = "sine"\nr_min = 0.2\noffset = 0\nroller = 0.01\ncount = 36\n'
            )
        path.write_text("\n".join(cams), "utf-8")
        found = record(path)
        phi = 10.0 * np.arange(36)
        for name, (phase, rise, rest, back, stroke) in known.items():
            own = (phi - phase) % 360
            expected = lift(own, sine, (0, rise, stroke), (rise + rest, back, -stroke))
            told = [one[name]["s"] for one in found["positions"]]
            assert told == pytest.approx(expected, abs=1e-9 * stroke)


def test_the_table_has_all_lifts_at_every_half_degree() -> None:
    head, *rows = run("solve", str(PATH), "--csv", "-").splitlines()
    names = head.lstrip("\ufeff").split(",")
    assert names[-4:] == ["phi_deg", "s_A", "s_B", "s_C"]
    assert len(rows) == 720
    assert float(rows[180].split(",")[-3]) == pytest.approx(0.015, abs=1e-12)


@pytest.mark.parametrize("lang", ["ru", "en"])
def test_a_cyclogram_and_a_sheet_of_each_cam_are_drawn(tmp_path: Path, lang: str) -> None:
    told = run("sheet", str(PATH), "--format", "svg", "--lang", lang, "-o", str(tmp_path))
    assert len(told.split()) == 4
    first, second, *_ = (Path(one).read_text("utf-8") for one in told.split())
    assert "cyclogram" not in second
    word = {"ru": "шпонка", "en": "key"}[lang]
    steps = " ".join(run("protocol", str(PATH), "--lang", lang).split())
    assert word in steps
    assert steps.count({"ru": "Диаграмму кулачка", "en": "The diagram of cam"}[lang]) == 3
    assert first != second


def test_mistakes_in_phases_are_named(tmp_path: Path) -> None:
    asked = '\n[[answers]]\nid = "lift"\nwhat = "s_A"\nposition = 5\n'
    problem, answers = tmp_path / "asked.toml", tmp_path / "group.csv"
    problem.write_text(TEXT + asked, "utf-8")
    own = {"right": 75.0 - 30.0, "together": 75.0, "backwards": 75.0 + 30.0}
    lifts = {name: lift(np.array([phi]), quintic, (0, 120, 0.03))[0] for name, phi in own.items()}
    rows = "".join(f"{name},{value:.5f}\n" for name, value in lifts.items())
    answers.write_text(f"student,lift\n{rows}", "utf-8")
    run("check", str(problem), str(answers), "--lang", "en", "-o", str(tmp_path))
    graded = (tmp_path / "results.csv").read_text("utf-8-sig").splitlines()
    head, *lines = (line.split(";") for line in graded)
    told = {line[0]: dict(zip(head, line, strict=True)) for line in lines}
    assert told["right"]["verdict"] == "ok"
    assert [told[name]["codes"] for name in ("together", "backwards")] == ["Q6", "Q7"]


@pytest.mark.parametrize(
    "change, message",
    [
        (('name = "B"', 'name = "A"'), r"cams\[1\]\.name.*another cam is named A"),
        (('name = "B"', 'name = "B b"'), "a name of 1 to 12 letters"),
        (("arm = 0.1", "arm = 0.1\nn = 90"), "cam B makes 90 rev/min"),
        (("phase = 150", 'phase = "x"'), r"cams\[1\]\.phase"),
        (("stroke = 0.03\n", ""), r"cams\[0\]\.stroke.*missing"),
    ],
)
def test_faults_name_their_place(tmp_path: Path, change: tuple[str, str], message: str) -> None:
    assert change[0] in TEXT
    path = tmp_path / "faulty.toml"
    path.write_text(TEXT.replace(*change), "utf-8")
    told = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert told.exit_code == 3
    assert re.search(message, " ".join(told.output.split()))


@pytest.mark.skipif(CHROMIUM is None, reason="chromium is not installed")
def test_on_the_live_page_all_cams_turn_with_the_shaft(tmp_path: Path) -> None:
    """Their numbers are those of their own turns, and the keys point one way."""
    (shaft,) = (kind_of(PATH).load(PATH, None),)
    file = tmp_path / "live.html"
    file.write_text(kind_of(PATH).live_page(shaft, "en"), "utf-8")
    with browsing(tmp_path) as page:
        page.open(file, width=900, height=700)
        for phi in (0.0, 12.5, 200.0, 359.5):
            page.ask(f"show({phi})")
            for k, cam in enumerate(shaft.cams):
                ending = f"-{k}" if k else ""
                told = float(page.ask(f"document.querySelector('#s{ending}').dataset.value"))
                own = np.array([(np.radians(phi) - (cam.phase or 0.0)) % TURN])
                assert told == pytest.approx(1000 * cam.at(own)[0, 0], abs=1e-5)
                cam_at = f"document.querySelector('#cam{ending}')"
                key_at = f"({cam_at}.querySelector('path[transform]') || {cam_at})"
                turned, key = (
                    page.ask(f"{place}.getAttribute('transform')") for place in (cam_at, key_at)
                )
                angles = [float(re.findall(r"-?[\d.]+", one)[0]) for one in (turned, key)]
                whole = (sum(angles) + cam.mirror * phi) % 360.0
                assert min(whole, 360.0 - whole) == pytest.approx(0.0, abs=2e-3)
        assert not page.said


@pytest.mark.parametrize("key", ["r_mim = 0.03", "phase = true", "contact = 'rolling'"])
def test_the_schema_checks_the_keys_of_each_cam(key: str) -> None:
    """An editor with the schema marks them."""
    jsonschema = pytest.importorskip("jsonschema")
    validator = jsonschema.Draft202012Validator(json.loads(schema.SCHEMA.read_text("utf-8")))
    assert not [*validator.iter_errors(tomllib.loads(TEXT))]
    text = TEXT.replace("phase = 320", key) if "phase" in key else TEXT.replace("n = 60", key)
    assert text != TEXT
    assert [*validator.iter_errors(tomllib.loads(text))]


def test_a_linkage_has_no_camshaft(tmp_path: Path) -> None:
    path = tmp_path / "both.toml"
    linkage = path_of("linkages/ex3").read_text("utf-8")
    path.write_text(linkage + "\n" + TEXT[TEXT.index("[[cams]]") : TEXT.index("[stamp]")], "utf-8")
    told = CliRunner().invoke(cli, ["solve", str(path), "--lang", "en"])
    assert told.exit_code == 3
    assert "a file of their own" in " ".join(told.output.split())
