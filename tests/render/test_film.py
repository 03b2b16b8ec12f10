"""Moving mechanisms for slides: the places of items in an animated SVG and in a GIF."""

from __future__ import annotations

import re
from itertools import combinations
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from cases import each
from click.testing import CliRunner
from doors import (
    Animation,
    Arc,
    Disc,
    ExitCode,
    Solution,
    Text,
    cli,
    ink_bounds,
    make_animation,
    problem_loads as loads,
)
from PIL import Image
from worked import path_of, problem_of

SVG = "{http://www.w3.org/2000/svg}"

ROCKERS = """frame = { A = [0, 0], D = [0.31, 0] }
driver = { link = "1", phi = 40, omega = -10 }
assembly = { C = "above D" }
links.1 = { points = ["A", "B"], AB = 0.1 }
links.2 = { points = ["B", "C"], BC = 0.2 }
links.3 = { points = ["C", "D"], CD = 0.15 }
"""


def test_an_svg_that_plays_has_links_and_plan_where_they_are_solved_to_be() -> None:
    problem = problem_of("linkages/ex3")
    film = make_animation(problem, "ru", frames=12, plans=True)
    assert film.skipped == "" and film.positions == pytest.approx(20.0 + 30.0 * np.arange(12))
    root = ElementTree.fromstring(film.svg(6.0))
    solved = Solution(problem, positions=film.positions.tolist())
    e = solved.points["E"].place

    def moves(kind: str) -> list[np.ndarray]:
        found = [one.get("values") or "" for one in root.iter(f"{SVG}animateTransform")
                 if one.get("type") == kind]  # fmt: skip
        return [np.array([row.split() for row in v.split(";")], float) for v in found]

    # E slides along x: one of the bodies goes as it does, drawn at one scale, and back.
    slides = [way[:, 0] for way in moves("translate") if np.ptp(way[:, 1]) == 0 < np.ptp(way)]
    scale = np.ptp(e.real) / np.ptp(slides[0])
    assert slides[0][0] == slides[0][-1] and len(slides[0]) == 13
    assert (slides[0] - slides[0][0])[:12] * scale == pytest.approx(e.real - e.real[0], abs=2e-5)
    # The crank turns by a whole turn, clockwise where y looks down.
    turned = [way[-1, 0] - way[0, 0] for way in moves("rotate")]
    assert any(turn == pytest.approx(-360.0) for turn in turned)
    # The arrow p-b is as long in every frame, and turns by 30 degrees.
    lines = [
        np.array([re.findall(r"-?[\d.]+", part) for part in (one.get("values") or "").split(";")])
        for one in root.iter(f"{SVG}animate")
        if one.get("attributeName") == "d" and "Z" not in (one.get("values") or "Z")
    ]
    ends = [np.asarray(line, float) for line in lines if line.shape[1] == 4]
    arrows = [line[:, 2] - line[:, 0] - 1j * (line[:, 3] - line[:, 1]) for line in ends]
    assert any(
        np.ptp(np.abs(way)) < 0.05
        and np.degrees(np.angle(way[1:] / way[:-1])) == pytest.approx(np.full(12, 30.0), abs=0.1)
        for way in arrows
    )
    assert not list(root.iter(f"{SVG}script")) and len(film.readings) == 12


@each("name", ["linkages/ex3", "levers/task-33", "press/press"])
def test_joints_of_the_scheme_are_at_their_points_in_every_frame(name: str) -> None:
    """Parts and places have the scale that is written on the film."""
    problem = problem_of(name)
    film = make_animation(problem, "ru", frames=8, plans=False)
    told = "".join(item.text for item in film.static_items if isinstance(item, Text))
    (number,) = re.findall(r"([\d,]+)\sм/мм|([\d,]+)\sмм/м", told)
    mu = float(number[0].replace(",", ".")) if number[0] else 1 / float(number[1].replace(",", "."))
    solved = Solution(problem, positions=film.positions.tolist())
    joints = sorted({joint.point for joint in problem.mechanism.revolutes})
    for k in range(len(film.positions)):
        circles = np.array(
            [
                body.places[k] + item.centre * np.exp(1j * np.radians(body.turns[k]))
                for body in film.drawn_bodies
                for item in body.items
                if isinstance(item, Disc | Arc) and item.radius < 3.0  # half a circle, too
            ]
        )
        places = np.array([solved.points[joint].place[k] for joint in joints]) / mu
        apart = [  # with one circle taken as the first joint, the deviations of the others
            np.abs(places[:, None] - places[0] + at - circles[None, :]).min(axis=1).max()
            for at in circles
        ]
        assert min(apart) < 0.01


def test_positions_that_do_not_exist_are_left_out_and_the_crank_goes_to_and_fro() -> None:
    film = make_animation(loads(ROCKERS, name="rockers"), "en", frames=36, plans=False)
    end = 105.33820309628705
    assert np.abs(film.positions).max() <= end + 360 and film.closed
    assert np.abs((film.positions + 180) % 360 - 180).max() <= end
    steps = np.diff([*film.positions, film.positions[0]])
    assert set(np.round(np.abs(steps), 9)) == {10.0} and steps.sum() == 0
    assert film.skipped.startswith("15 of 36 positions do not exist")
    assert "from -100 to 100" in film.skipped


def test_the_command_writes_every_frame_and_reports_faults(tmp_path: Path) -> None:
    path = tmp_path / "rockers.toml"
    path.write_text(ROCKERS, "utf-8")
    args = ["animate", str(path), "-o", str(tmp_path), "--frames", "8", "--dpi", "40"]
    done = CliRunner().invoke(cli, args)
    assert done.exit_code == 0 and "do not exist and are skipped" in done.output
    assert {p.suffix for p in tmp_path.glob("rockers-animated.*")} == {".gif", ".svg"}
    count = len(
        make_animation(loads(ROCKERS, name="rockers"), "en", frames=8, plans=False).positions
    )
    with Image.open(tmp_path / "rockers-animated.gif") as picture:
        shown = set()
        for k in range(count):
            picture.seek(k)
            shown.add(picture.convert("L").tobytes())
        # Forward and back: all frames but both ends twice; the requested duration.
        assert getattr(picture, "n_frames", 0) == count and len(shown) > count // 2
        assert picture.info["duration"] == round(600 / count) * 10
    wrong = CliRunner().invoke(cli, [*args, "--format", "mp4"])
    assert wrong.exit_code == ExitCode.USAGE and "gif, svg" in wrong.output
    path.write_text(ROCKERS.replace("BC = 0.2", "BC = 0.02"), "utf-8")
    assert CliRunner().invoke(cli, args).exit_code == ExitCode.ASSEMBLY
    train = str(path_of("gears/gears-ex1"))
    assert CliRunner().invoke(cli, ["animate", train]).exit_code == ExitCode.PROBLEM


def lettering(film: Animation) -> list[np.ndarray]:
    """Return the boxes of the inscriptions, (frames, 4) each: left, low, right, high."""
    found = []
    for body in film.drawn_bodies:
        if all(isinstance(item, Text) for item in body.items):
            left, low, right, high = ink_bounds(body.items)
            x, y = body.places.real, body.places.imag
            found.append(np.stack([x + left, y + low, x + right, y + high], axis=1))
    return found


@each("name", ["linkages/ex1", "linkages/ex3", "press/press"])
def test_plans_fill_their_room_and_their_letters_are_apart(name: str) -> None:
    film = make_animation(problem_of(name), "ru", frames=24, plans=True)
    ends = np.array([end for one in film.segments for end in (one.tails, one.heads)])
    size = np.ptp(ends.real), np.ptp(ends.imag)
    assert size[0] <= 160.5 and size[1] <= 120.5  # mm; vectors are drawn up to 2 mm beside
    assert max(size[0] / 160, size[1] / 120) > 0.39  # the next scales are up to 2.5 times finer
    low, high = film.segments[0].bounds
    assert size[0] / (high - low).real > 0.6 or size[1] / (high - low).imag > 0.6
    boxes = lettering(film)
    over = [
        (np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2]) > 0).all(axis=1).sum()
        for a, b in combinations(boxes, 2)
    ]
    assert sum(over) <= 0.04 * 24 * len(boxes)


def test_letters_glide_to_another_place_and_do_not_jump() -> None:
    film = make_animation(problem_of("linkages/ex3"), "ru", frames=120, plans=True)
    most = max(np.abs(np.diff(one.heads)).max() for one in film.segments)
    for box in lettering(film):
        middles = box[:, :2] + box[:, 2:]
        steps = np.hypot(*np.diff([*middles, middles[0]], axis=0).T) / 2
        assert steps.max() < most + 1.0  # mm: a jump is of 10 to 20


def test_vectors_on_one_line_are_beside_one_another_in_every_frame() -> None:
    """B and D of ex3 are on one link: the velocities of B3 and D have one line."""
    film = make_animation(problem_of("linkages/ex3"), "ru", frames=24, plans=True)
    ways = [one.heads - one.tails for one in film.segments]
    for one, other in combinations(range(len(ways)), 2):
        if not (film.segments[one].arrow and film.segments[other].arrow):
            continue
        along = ways[one] / np.abs(ways[one])
        if np.abs((ways[other] * along.conj()).imag).max() > 1e-6:
            continue
        apart = (film.segments[other].tails - film.segments[one].tails) * along.conj()
        # 1.8 mm; less only where both vectors turn round in their line.
        assert np.median(np.abs(apart.imag)) > 1.7 and np.abs(apart.imag).min() > 0.5
        return
    pytest.fail("no two vectors have one line")


def test_a_plan_next_to_a_dead_position_stays_in_its_room() -> None:
    film = make_animation(loads(ROCKERS, name="rockers"), "en", frames=360, plans=True)
    ends = np.array([one.heads for one in film.segments])
    low, high = film.segments[0].bounds
    outside = (ends.real > high.real) | (ends.imag > high.imag) | (ends.imag < low.imag)
    assert outside.any()
    for k in range(len(film.positions)):
        for item in (item for one in film.segments for item in one.drawn(k)):
            left, bottom, right, top = ink_bounds([item])
            assert low.real - 1.0 < left and right < high.real + 1.0
            assert low.imag - 1.0 < bottom and top < high.imag + 1.0
