"""The page of two wheels in mesh: teeth touch where the page says, on the line of action."""

from __future__ import annotations

import cmath
import json
import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import PROGRAM, Page, browsing
from doors import (
    MeshingProblem,
    SolvedMeshing,
    involute_live_live_page as live_page,
    involute_reader_load as load,
)
from worked import PROBLEMS

FILES = sorted((PROBLEMS / "meshing").glob("*.toml"))
CASES = [(path, variant) for path in FILES for variant in (None, "without-shift", "axes")]


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    if PROGRAM is None:
        pytest.skip("Chromium is absent")
    with browsing(tmp_path_factory.mktemp("browser")) as browser:
        yield browser


def opened(page: Page, problem: MeshingProblem, folder: Path) -> dict[str, Any]:
    file = folder / "mesh.html"
    text = live_page(problem, "en")
    file.write_text(text, "utf-8")
    page.said.clear()
    page.open(file, width=390, height=800)
    (scene,) = re.findall(r'(?s)id="scene">(.*?)</script>', text)
    told: dict[str, Any] = json.loads(scene)
    return told


@pytest.mark.parametrize(("path", "variant"), CASES)
def test_both_profiles_pass_through_every_contact_and_do_not_cross(
    path: Path, variant: str | None, page: Page, tmp_path: Path
) -> None:
    problem = load(path, variant=variant)
    solved, scene = SolvedMeshing(problem), opened(page, problem, tmp_path)
    pair = solved.pair
    for turned in (0.0, 3.7, 11.1, 200.3):
        rhos = page.ask(f"planmethod.contacts({turned})")
        page.ask(f"planmethod.show({turned})")
        share = (solved.contact.end - solved.contact.start) / pair.p_b
        assert int(share) <= len(rhos) <= int(share) + 1
        assert np.diff(rhos) == pytest.approx(float(pair.p_b))
        for rho in rhos:
            x, y = page.ask(f"planmethod.at({rho!r})")
            place = complex(x, -y)
            # Both flanks have this point: it is at the radius of their involutes, and at the
            # angle of one of their teeth.
            for wheel, tooth in enumerate(solved.teeth):
                centre = complex(0, -scene["wheels"][wheel]["y"])
                own = float(rho) if wheel == 0 else abs(float(pair.line) - float(rho))
                radius = np.hypot(tooth.size("d_b") / 2, own)
                assert abs(place - centre) == pytest.approx(abs(radius), rel=1e-9)
                assert flank_off(page, place, wheel, tooth.z) < 2e-3 * pair.m
            slid = page.ask(f"planmethod.sliding({rho!r})")
            exact = pair.sliding(np.asarray(rho))
            assert slid == pytest.approx([float(one) for one in exact], rel=1e-9, abs=1e-9)
    assert page.ask("document.documentElement.scrollWidth") == 390
    assert not page.said


def flank_off(page: Page, place: complex, wheel: int, count: int) -> float:
    """Return the distance of a place from the drawn outline of a wheel, where the page has it."""
    outline = page.ask(
        f"(() => {{ const one = document.querySelector('.wheel-{wheel} path'), numbers = "
        "one.getAttribute('d').match(/-?[\\d.]+/g).map(Number), move = "
        "one.parentNode.transform.baseVal.consolidate().matrix; const found = []; for (let k = 0; "
        "k < numbers.length; k += 2) { const p = new DOMPoint(numbers[k], numbers[k + 1])"
        ".matrixTransform(move); found.push([p.x, p.y]); } return found; })()"
    )
    points = np.array([complex(x, -y) for x, y in outline])
    assert len(points) % count == 0
    ends = np.roll(points, -1)
    way = ends - points
    share = np.clip(((place - points) * way.conj()).real / np.abs(way) ** 2, 0, 1)
    return float(np.min(np.abs(points + share * way - place)))


def test_the_wheels_turn_by_their_teeth_and_an_internal_one_with_the_other(
    page: Page, tmp_path: Path
) -> None:
    for path, sign in ((FILES[0], -1.0), (FILES[1], 1.0)):
        problem = load(path)
        opened(page, problem, tmp_path)
        page.ask("planmethod.show(30)")
        one, two = (float(page.ask(f"byId('turned-{k}').dataset.value")) for k in (0, 1))
        assert two / one == pytest.approx(sign * problem.z[0] / problem.z[1])
        assert cmath.isclose(one, 30.0)


def test_the_contact_ratio_is_the_mean_number_of_pairs(page: Page, tmp_path: Path) -> None:
    for path in FILES:
        problem = load(path)
        opened(page, problem, tmp_path)
        pitch = 360.0 / problem.z[0]
        counts = page.ask(
            "Array.from({ length: 2000 }, (_, k) =>"
            f" planmethod.contacts({pitch} * k / 2000).length)"
        )
        solved = SolvedMeshing(problem)
        assert np.mean(counts) == pytest.approx(solved.contact.overlap(solved.pair), abs=2e-3)
