"""The played construction: each step once with its sentence, strokes at exact points."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Iterable, Iterator
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from browser import PROGRAM, Page, browsing
from cases import each, sampled, some
from click.testing import CliRunner
from doors import (
    LED,
    PART_OF,
    PLAY_SCRIPT,
    UNDER_LABEL,
    Arc,
    ArcMark,
    Disc,
    Dot,
    DrawingItem as Item,
    ExitCode,
    PlanKind,
    PlanRequest,
    Playback,
    PlaybackRole as Role,
    PlayedStep,
    Segment,
    Solution,
    Text,
    cli,
    detail_view_letter,
    frames,
    get_language,
    joined,
    kind_of,
    linkage_playback,
    plan_picture,
    play_page,
    playback_record,
    problem_loads as loads,
    scheme_picture,
)
from worked import PROBLEMS, ROOT, path_of, problem_of

import planmethod
from benchmarks.generator import random_problem

ON = 1e-9
"""Distance of the end of a stroke from a point of the solution, mm."""

SAME = 0.01
"""Distance of the lines of the last frame from those of the sheet, mm."""

LABELS = (LED, PART_OF, UNDER_LABEL)
"""First words of the tags of leaders, bars and the white of letters."""

FILES = sorted((PROBLEMS / "linkages").glob("*.toml"))
OTHERS = [
    *sorted((PROBLEMS / "gears").glob("*.toml")),
    *sorted((PROBLEMS / "cams").glob("*.toml")),
    *sorted((PROBLEMS / "point").glob("*.toml"))[::4],
]


def played(solution: Solution, index: int = 0, lang: str = "ru") -> Playback:
    return linkage_playback(solution, get_language(lang), index)


def first_of(path: Path) -> Solution:
    solution = Solution(planmethod.load(path))
    return solution.with_positions(solution.positions[:1])


def lines_of(items: Iterable[Item]) -> list[complex]:
    """The ends of the lines and the middles of the circles of a drawing, but for its labels."""
    drawn = [one for one in items if not isinstance(one, Text) and not one.tag.startswith(LABELS)]
    return [
        place
        for one in drawn
        for place in ([one.centre] if isinstance(one, Arc | Disc) else one.points)
    ]


def assert_same_lines(one: list[complex], two: list[complex]) -> None:
    """Lines do not depend on the letters of a drawing."""
    assert len(one) == len(two)
    assert max(abs(a - b) for a, b in zip(one, two, strict=True)) <= SAME


def details_of(solution: Solution, kind: PlanKind) -> tuple[str, ...]:
    views = solution.detail_views_at(kind, 0)
    return tuple(detail_view_letter(view, get_language("ru")) for view in views)


def steps_of(playback: Playback) -> list[PlayedStep]:
    return [step for _, step in playback.steps()]


def assert_every_step_once(playback: Playback, solution: Solution) -> None:
    made = [name for step in steps_of(playback) for name in step.names]
    own = {str(step.out) for part in solution.construction.sections for step in part.steps}
    assert len(made) == len(set(made))
    assert own <= set(made)
    assert all(step.lines and all(step.lines) for step in steps_of(playback))


def assert_strokes_end_at_points(playback: Playback, solution: Solution, index: int) -> None:
    paper = solution.paper
    places = {}
    for section in solution.construction.sections:
        for step in section.steps:
            value = paper.value.get(step.out)
            if value is not None and not isinstance(value, tuple) and np.iscomplexobj(value):
                places[str(step.out)] = complex(paper.point(step.out)[index])
    there = np.array([*places.values()])
    boards = {kind.value for kind in PlanKind}
    count = 0
    for shown in steps_of(playback):
        for mark in shown.marks:
            if mark.board not in boards:
                continue
            if isinstance(mark, Dot):
                assert abs(complex(*mark.at) - places[mark.name]) <= ON, mark
            elif isinstance(mark, Segment) and mark.role in (Role.RESULT, Role.AID):
                for end in (mark.start, mark.end):
                    assert np.min(np.abs(there - complex(*end))) <= ON, mark
            count += 1
    assert count >= len(solution.problem.mechanism.links)


@each("path", sampled(FILES, 6))
def test_each_step_is_played_once_with_a_sentence_and_its_strokes_are_exact(path: Path) -> None:
    solution = first_of(path)
    playback = played(solution)
    assert_every_step_once(playback, solution)
    assert_strokes_end_at_points(playback, solution, 0)


@each("seed", range(some(60, 4)))
def test_random_mechanisms_are_played_whole(seed: int) -> None:
    solution = Solution(loads(random_problem(seed)[0], name=f"random-{seed}"))
    solution = solution.with_positions(solution.positions[:1])
    playback = played(solution, lang="en")
    assert_every_step_once(playback, solution)
    assert_strokes_end_at_points(playback, solution, 0)


@each("name", ["linkages/ex3", "linkages/five-bar"])
def test_the_last_frame_is_the_drawing_of_the_sheet(name: str) -> None:
    solution = first_of(path_of(name))
    playback = played(solution)
    steps = steps_of(playback)
    for board in playback.boards[:3]:
        kind = PlanKind(board.id)
        drawing = (
            scheme_picture(solution, 0, hide_motion=True)
            if kind is PlanKind.POSITION
            else plan_picture(solution, kind, 0, detail_letters=details_of(solution, kind))
        )
        expected = lines_of(drawing.items)
        assert_same_lines(lines_of(board.items)[: len(expected)], expected)  # then its details
        there, missing = (
            Counter(item.text for item in items if isinstance(item, Text))
            for items in (board.items, drawing.items)
        )
        assert missing <= there
        own = [k for k, (section, _) in enumerate(playback.steps()) if section.board == board.id]
        assert len(board.appears) == len(board.items)
        assert {*board.appears} <= {*range(own[0], own[-1] + 1)}, steps


def test_a_letter_appears_with_its_point_and_an_inscription_at_once() -> None:
    solution = first_of(path_of("linkages/ex3"))
    playback = played(solution)
    when = {name: k for k, step in enumerate(steps_of(playback)) for name in step.names}
    for board in playback.boards:
        labels: dict[str, set[int]] = {}
        for item, step in zip(board.items, board.appears, strict=True):
            if isinstance(item, Text) and item.label:
                labels.setdefault(item.label, set()).add(step)
        assert all(len(steps) == 1 for steps in labels.values())
        for point in "ABCDE":
            if f"point {point}" in labels:
                assert labels[f"point {point}"] == {when[point]}


@each("name", ["linkages/ex3", "levers/six-link", "linkages/triad"])
def test_the_terms_of_an_equation_are_drawn_the_unknown_ones_last(name: str) -> None:
    playback = played(first_of(path_of(name)))
    equations = [one for section in playback.sections for one in section.equations]
    assert len(equations) >= 8
    plans = [one for one in playback.sections if one.board.startswith("forces-")]
    assert all(one.equations for one in plans)
    for one in equations:
        terms = [*one.equation.left, *one.equation.right]
        assert len(terms) == len(one.drawn)
        assert min(one.drawn) >= 0
        known = [step for term, step in zip(terms, one.drawn, strict=True) if term.underlines == 2]
        free = [step for term, step in zip(terms, one.drawn, strict=True) if term.underlines < 2]
        assert max(known, default=0) <= min(free)


def test_a_known_force_is_lit_in_the_step_that_lays_it_off_not_with_its_reaction() -> None:
    playback = played(first_of(path_of("levers/six-link")))
    steps = list(playback.steps())
    plan = next(section for section in playback.sections if section.board == "forces-2")
    (balance,) = plan.equations
    for term, at in zip(balance.equation.left, balance.drawn, strict=True):
        if term.underlines == 2:
            assert any("откладываем" in line for line in steps[at][1].lines), term
    group = next(section for section in playback.sections if section.board == "forces-0")
    whole, of_link = group.equations
    free = {at for term, at in zip(whole.equation.left, whole.drawn, strict=True)
            if term.underlines < 2}  # fmt: skip
    assert len(free) == 1  # both unknown reactions, where their lines meet
    assert of_link.drawn[0] in free
    assert of_link.drawn[1] > max(free)


def test_each_leg_of_a_triad_has_its_notch() -> None:
    playback = played(first_of(path_of("linkages/triad")))
    arcs = [
        [mark for mark in step.marks if isinstance(mark, ArcMark)]
        for _, step in playback.steps()
        if step.names and any(isinstance(mark, ArcMark) for mark in step.marks)
    ]
    assert sorted(round(mark.radius, 6) for mark in arcs[0]) == [56.0, 60.0, 80.0]


def test_a_joined_line_is_seen_though_a_link_covers_it() -> None:
    steps = [step for _, step in played(first_of(path_of("linkages/triad"))).steps()]
    joined_lines = [step for step in steps if "Проводим прямую" in step.lines[0]][:2]
    assert [len(step.marks) for step in joined_lines] == [2, 2]  # of AB and of EC
    for step in joined_lines:
        assert {mark.role for mark in step.marks} == {Role.CONSTRUCTION, Role.AID}


def test_a_ray_of_a_diagram_is_shown_in_its_step() -> None:
    path = path_of("cams/oscillating")
    kind = kind_of(path)
    playback = kind.playback(kind.load(path, None), get_language("ru"), PlanRequest(position=0))
    rays = [step for _, step in playback.steps() if step.lines[0].startswith("Проводим луч")]
    assert len(rays) >= 4
    assert all([mark.role for mark in step.marks] == [Role.AID] for step in rays)


def test_a_guide_on_a_link_appears_with_the_point_on_it() -> None:
    playback = played(first_of(path_of("levers/six-link")))
    scheme = next(board for board in playback.boards if board.id == "position")
    steps = [step for _, step in playback.steps()]
    at = {name: number for number, step in enumerate(steps) for name in step.names}
    bars = {number for item, number in zip(scheme.items, scheme.appears, strict=True)
            if item.tag == "link 2"}  # fmt: skip
    assert bars == {at["S2"], at["H"]}


def test_measured_segments_give_their_values_by_the_scale() -> None:
    solution = first_of(path_of("linkages/ex3"))
    found = [one for step in steps_of(played(solution)) for one in step.measured]
    read = [one for one in found if one.value is not None]
    scales = {solution.plan_scale(kind, 0).per_mm for kind in PlanKind if kind in solution.scales}
    assert len(read) >= 8
    for one in read:
        assert one.value is not None
        assert any(abs(one.value - one.length * mu) <= 1e-9 * one.value for mu in scales), one


@each("name", ["linkages/ex3", "levers/six-link", "machines/rubbing-crank"])
def test_each_stroke_is_in_one_step_and_each_sentence_is_in_both_languages(name: str) -> None:
    kind, path = kind_of(path_of(name)), path_of(name)
    both = [
        kind.playback(kind.load(path, None), get_language(lang), PlanRequest(position=0))
        for lang in ("ru", "en")
    ]
    first, second = map(steps_of, both)
    assert [step.names for step in first] == [step.names for step in second]
    assert [step.marks for step in first] == [step.marks for step in second]
    for one, two in zip(first, second, strict=True):
        assert all(map(str.strip, (*one.lines, *two.lines)))
        words = " ".join(two.lines)
        assert not re.search("[а-яё]{3}", re.sub(r"\\\w+", "", words)), words
    drawn = [
        mark
        for step in first
        for mark in step.marks
        if mark.role is Role.RESULT and isinstance(mark, Dot) and mark.name
    ]
    dots = Counter((mark.board, mark.name) for mark in drawn)
    assert max(dots.values()) == 1, dots.most_common(3)


@each("name", ["levers/six-link", "machines/rubbing-crank"])
def test_the_lever_and_the_arms_appear_with_their_sentences(name: str) -> None:
    kind, path = kind_of(path_of(name)), path_of(name)
    playback = kind.playback(kind.load(path, None), get_language("en"), PlanRequest(position=0))
    steps = list(playback.steps())
    for board in playback.boards:
        for item, number in zip(board.items, board.appears, strict=True):
            section, step = steps[number]
            if item.tag.startswith("arm "):
                assert "rms" in " ".join(step.lines), step.lines
                assert board.id in (section.board, section.source)
    lever = next(board for board in playback.boards if board.id == "lever")
    forces = {
        number
        for item, number in zip(lever.items, lever.appears, strict=True)
        if item.tag.startswith("force ")
    }
    assert len(forces) == 1
    assert "carried parallel" in " ".join(steps[forces.pop()][1].lines)


@each("name", ["linkages/triad", "levers/six-link"])
def test_a_measured_segment_is_shown_where_its_ends_are(name: str) -> None:
    solution = first_of(path_of(name))
    playback = played(solution)
    boxes = {board.id: board.box for board in playback.boards}
    for step in steps_of(playback):
        for mark in step.marks:
            if isinstance(mark, Segment) and mark.role is Role.AID:
                left, low, right, high = boxes[mark.board]
                for x, y in (mark.start, mark.end):
                    assert left <= x <= right, (step.lines, mark)
                    assert low <= y <= high, (step.lines, mark)


@each("path", sampled(OTHERS, 3))
def test_gears_cams_and_points_are_played_whole(path: Path) -> None:
    kind = kind_of(path)
    problem = kind.load(path, None)
    playback = kind.playback(problem, get_language("en"), PlanRequest())
    made = [name for step in steps_of(playback) for name in step.names]
    assert made
    assert len(made) == len(set(made)) or "point" in str(path)  # of several moments
    assert all(step.lines for step in steps_of(playback))
    boards = {board.id for board in playback.boards}
    assert {section.board for section in playback.sections} <= boards
    assert all(mark.board in boards for step in steps_of(playback) for mark in step.marks)


def test_the_page_loads_nothing_and_has_every_sentence(tmp_path: Path) -> None:
    problem = problem_of("linkages/ex3")
    playback = played(first_of(path_of("linkages/ex3")))
    html = play_page(problem, playback, get_language("ru"))
    assert not re.search(r'(?:src|href)="(?!#)', html.replace('xlink:href="#', ""))
    assert "default-src 'none'" in html
    assert html.count("<template") == len(steps_of(playback))
    scene = json.loads(re.findall(r'id="scene">(.*?)</script>', html)[0])
    assert len(scene["steps"]) == len(steps_of(playback))


def test_the_script_of_the_page_has_every_module_and_no_name_twice() -> None:
    folder = ROOT / "planmethod/render/play/script"
    assert {f"{name}.js" for name in PLAY_SCRIPT} == {path.name for path in folder.iterdir()}
    script = joined(*PLAY_SCRIPT, package="planmethod.render.play")
    assert not re.search(r"(?m)^(?:import|export)\b", script)
    if shutil.which("node"):
        done = subprocess.run(
            ["node", "--check", "-"], input=script, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr


def test_frames_are_pictures_of_each_step_and_the_record_has_them_all() -> None:
    playback = played(first_of(path_of("linkages/ex3")), lang="en")
    pictures = list(frames(playback))
    assert len(pictures) == len(steps_of(playback))
    for picture in (pictures[0], pictures[-1]):
        ElementTree.fromstring(picture.encode())
    record = playback_record(playback)
    json.dumps(record, allow_nan=False)
    told = [step for section in record["sections"] for step in section["steps"]]
    assert [step["number"] for step in told] == [*range(len(pictures))]


def test_a_position_that_is_not_there_is_refused() -> None:
    done = CliRunner().invoke(cli, ["play", str(path_of("linkages/ex3")), "--position", "99"])
    assert done.exit_code == ExitCode.USAGE
    assert "99" in done.output


def test_the_moving_page_and_the_construction_lead_to_each_other(tmp_path: Path) -> None:
    words = ["live", str(path_of("linkages/ex3")), "--construction", "-o", str(tmp_path)]
    assert CliRunner().invoke(cli, words).exit_code == 0
    live, play = (tmp_path / f"ex3-{name}.html" for name in ("live", "play"))
    assert f'<a href="{play.name}">' in live.read_text("utf-8")
    assert f'<a href="{live.name}">' in play.read_text("utf-8")


@pytest.fixture
def page(tmp_path: Path) -> Iterator[Page]:
    if PROGRAM is None:
        pytest.skip("Chromium is not installed")
    with browsing(tmp_path / "browser") as found:
        yield found


def test_keys_play_questions_and_print_in_a_browser(page: Page, tmp_path: Path) -> None:
    problem = problem_of("linkages/ex3")
    file = tmp_path / "play.html"
    file.write_text(
        play_page(problem, played(first_of(path_of("linkages/ex3"))), get_language("ru")), "utf-8"
    )
    page.open(file)
    count = page.ask("COUNT")
    shown = "[...document.querySelectorAll('#boards [data-phase=now]')].length"

    def press(key: str) -> None:
        page.ask(f"document.dispatchEvent(new KeyboardEvent('keydown', {{ key: '{key}' }}))")

    def at() -> int:
        return int(page.ask("document.getElementById('count').textContent.split(' ')[0]"))

    assert at() == 1
    for key, place in (("PageDown", 2), (" ", 3), ("ArrowLeft", 2), ("End", count), ("Home", 1)):
        press(key)
        assert at() == place
    press("q")
    press("PageDown")
    assert page.ask("document.getElementById('said').classList.contains('asks')")
    assert (
        page.ask(
            "document.querySelectorAll('#boards [data-step=\"1\"]:not([data-phase=later])').length"
        )
        == 0
    )
    press("PageDown")
    assert page.ask(shown) > 0
    assert not page.ask("document.getElementById('said').classList.contains('asks')")
    page.ask("print()")
    frames_there = page.ask("document.querySelectorAll('#frames article').length")
    assert frames_there == page.ask("D.steps.filter(step => step.strokes).length")
    page.open(file, width=390, height=844)
    assert page.ask("document.documentElement.scrollWidth") <= 390
    assert page.said == []
