"""The page of a moving mechanism: its numbers, its pictures, and strangers' text in it."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from browser import PROGRAM, Page, browsing
from cases import each, some
from click.testing import CliRunner
from doors import (
    KINDS_KINDS,
    TOLERANCE_SHARE,
    TOLERANCE_SIGMAS,
    ExitCode,
    Flywheel,
    LiveScene,
    ModelProblem as Problem,
    Parameters,
    Settings,
    Solution,
    Sweep,
    cli,
    drafting_of,
    find_centres,
    get_language,
    number,
    page_live_page as live_page,
    pose,
    problem_loads as loads,
)
from worked import ROOT, path_of, problem_of

from benchmarks.generator import random_problem

AGREE = 1e-12
"""Tolerance, relative to the largest value of a row."""

WATT = """title = "</script><script>alert(1)</script> & <b>Watt</b>"
source = "a linkage of two rockers"
frame = { A = [0, 0], D = [0.4, 0.1] }
driver = { link = "1", phi = 5, omega = 2 }
assembly = { C = "above B" }
[links.1]
points = ["A", "B"]
AB = 0.2
[links.2]
points = ["B", "C", "M"]
BC = 0.1
M = { on = "BC", at = 0.05 }
[links.3]
points = ["C", "D"]
CD = 0.2
[dynamics.links.2]
mass = 3
centre = "M"
inertia = 0.002
"""

LOADS = {
    "against the motion, one way, over x": 'link = "2"\nat = "M"\nagainst = "velocity"\n'
    'phases = { moving = "up" }\nforce = { over = "x", values = [[0.1, 5], [0.19, 9], [0.2, 2]], '
    'interpolation = "step" }',
    "over a span of phi": 'link = "2"\nat = "C"\nangle = 30\nforce = -5\n'
    "phases = { phi = [[350, 20]] }",
    "a couple over phi": 'link = "3"\nphases = { turning = "cw" }\n'
    'couple = { over = "phi", values = [[20, 1], [100, 4], [300, 7]], interpolation = "linear" }',
    "a couple against the rotation": 'link = "3"\ncouple = 2\nagainst = "rotation"',
}


SWUNG = """
frame = { A = [0, 0], D = [0.4, 0.1] }
driver = { link = "1", phi = 5, omega = -2 }
assembly = { C = "above B" }
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.35
[links.3]
points = ["C", "D"]
CD = 0.25
[[loads]]
link = "3"
at = "C"
against = "velocity"
force = { law = "path", values = [[0, 5], [0.3, 9], [0.31, 2], [1, 4]] }
"""
"""A load over the arc of a rocker."""


def watt(load: str = "") -> Problem:
    return loads(WATT + (f"[[loads]]\n{load}\n" if load else ""), name="watt")


# The tape in JavaScript -------------------------------------------------------------------------


def apart(made: np.ndarray, sweep: Sweep, positions: np.ndarray) -> float:
    """Return how far outputs are from the sweep's, as parts of the largest of the row."""
    exact = sweep.run(positions)
    assert (np.isnan(made) == np.isnan(exact)).all()
    assert np.isfinite(exact).any()
    largest = np.max(np.abs(np.nan_to_num(exact)), axis=1, keepdims=True)
    forces = [row.name[:2] in ("f:", "F.") for row in sweep.rows]
    if any(forces):  # forces that cancel are negligible beside the others
        largest[forces] = np.maximum(largest[forces], 1e-3 * largest[forces].max())
    return float(np.max(np.nan_to_num(np.abs(made - exact) / np.maximum(largest, 1e-300))))


@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
@each("seed", range(some(60, 5)))
def test_the_printed_tape_gives_the_numbers_of_the_sweep(seed: int) -> None:
    problem = loads(random_problem(seed)[0], name="random")
    sweep = Sweep(problem)
    first = problem.drive.positions[0]
    positions = np.concatenate((first + np.linspace(-400, 400, 161), 90.0 * np.arange(-5, 6)))
    if not problem.drive.is_crank:
        positions = first + np.linspace(-1.0, 1.0, 161)
    script = (
        f"{sweep.javascript()}\nconst all = {json.dumps(positions.tolist())}.map(x => run(x));\n"
        "console.log(JSON.stringify(all.map(o => o.map(v => v === v ? v : null))));"
    )
    done = subprocess.run(["node", "-"], input=script, capture_output=True, text=True, check=True)
    found = np.array(json.loads(done.stdout), dtype=float).T
    assert apart(found[:-1], sweep, positions) < AGREE
    failed = np.empty(len(positions), np.int16)
    sweep.run(positions, failed=failed)
    assert (found[-1] == failed).all()


# In a browser -----------------------------------------------------------------------------------

needs_chromium = pytest.mark.skipif(PROGRAM is None, reason="chromium is not installed")


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Page]:
    with browsing(tmp_path_factory.mktemp("browser")) as browser:
        yield browser


def opened(page: Page, problem: Problem, folder: Path, lang: str = "ru") -> LiveScene:
    """Open the page of a problem on a telephone; return its scene."""
    file = folder / "live.html"
    file.write_text(live_page(problem, lang), "utf-8")
    page.said.clear()
    page.open(file, width=360, height=740)
    return LiveScene(problem, get_language(lang))


@needs_chromium
@pytest.mark.parametrize("name", ["linkages/ex3", "press/press"])
def test_the_slider_moves_everything_to_the_numbers_of_solve(
    name: str, page: Page, tmp_path: Path
) -> None:
    scene = opened(page, problem_of(name), tmp_path)
    for phi in (20.0, 218.918918918919, 301.25):
        page.ask(f"slider.value = {phi}; slider.dispatchEvent(new Event('input'))")
        run = CliRunner().invoke(cli, ["solve", str(path_of(name)), "--json", "--phi", str(phi)])
        (told,) = json.loads(run.output)["positions"]
        shown = page.ask(
            "Object.fromEntries([...document.querySelectorAll('[data-row]')].map(node =>"
            " [D.rows[node.dataset.row], +node.dataset.value]))"
        )
        for point, values in told["points"].items():
            for key in ("x", "y", "vx", "vy", "ax", "ay"):
                size = max(abs(values[key[:-1] + axis]) for axis in "xy")
                assert shown[f"{point}.{key}"] == pytest.approx(values[key], abs=AGREE * (size + 1))
        for link, values in told["links"].items():
            for key in ("phi_deg", "omega", "epsilon"):
                assert shown[f"{link}.{key}"] == pytest.approx(values[key], rel=AGREE, abs=AGREE)
        if "forces" in told:
            balance = told["forces"]["driving"]["moment"]
            assert shown["driving.moment"] == pytest.approx(balance, rel=1e-11)
        # Drawn items: every vector at the scale of its view, every link at its point.
        for view in scene.views:
            lines = page.ask(
                f"D.views.find(v => v.id === '{view.id}').segments.map(one => one.ends && "
                "[Math.hypot(one.ends[1][0] - one.ends[0][0], one.ends[1][1] - one.ends[0][1]),"
                " one.line.getTotalLength()])"
            )
            assert sum(line is not None for line in lines) >= 2, view.id
            assert all(line[0] == pytest.approx(line[1], abs=0.01) for line in lines if line)
    values = page.ask("(planmethod.show(301.25), at(301.25))")
    for part in scene.parts:
        if part.link in scene.problem.mechanism.links:
            x, turn = (
                values[scene.place(scene.anchor_point(part.link))[0]],
                values[scene.row(f"{part.link}.phi_deg")],
            )
            placed = page.ask(f"byId('part-{scene.parts.index(part)}').getAttribute('transform')")
            numbers = [float(text) for text in re.findall(r"-?[\d.]+", placed)]
            assert numbers[0] == pytest.approx(x / scene.views[0].per_mm, abs=1e-3)
            assert -numbers[2] == pytest.approx(turn, abs=1e-4)
    assert page.ask("document.documentElement.scrollWidth") == 360
    assert not page.said


CROSSED = """(() => {  // inscriptions of the scheme that a drawn line of a moving part runs through
  const view = D.views[0], root = () => view.svg.getCTM().inverse();
  const shapes = [...view.svg.querySelectorAll("[id^=part-] :is(path, line, rect, circle)")];
  const drawn = shapes.map(one => {
    const part = one.closest("[id^=part-]"), long = one.getTotalLength();
    const own = part.getCTM().inverse().multiply(one.getCTM()), count = Math.ceil(long / 0.4) + 1;
    return [part, Array.from({ length: count + 1 }, (_, k) =>
      one.getPointAtLength(long * k / count).matrixTransform(own))];
  });
  let seen = 0, crossed = 0;
  for (let phi = 2; phi < 360; phi += 20) {
    planmethod.show(phi);
    const places = drawn.flatMap(([part, points]) => {
      const now = root().multiply(part.getCTM());
      return points.map(p => p.matrixTransform(now));
    });
    for (const one of view.labels) {
      if (one.node.getAttribute("visibility") === "hidden") continue;
      const moved = one.node.getAttribute("transform");
      const [, x, y] = moved.match(/([-\\d.]+)[ ,]+([-\\d.]+)/).map(Number);
      seen += 1;
      crossed += places.some(p => p.x > x + 0.2 && p.x < x + one.width - 0.2 &&
        p.y > y - one.up + 0.2 && p.y < y + one.down - 0.2);
    }
  }
  return [seen, crossed];
})()"""


@needs_chromium
@each("name", ["linkages/ex3", "levers/task-33", "press/press"])
def test_no_line_of_the_scheme_runs_through_its_letters(
    name: str, page: Page, tmp_path: Path
) -> None:
    """Lines of the slider, its guide, supports and rods count beside the segments of the plan."""
    opened(page, problem_of(name), tmp_path)
    seen, crossed = page.ask(CROSSED)
    assert seen >= 18 * 8
    assert crossed <= 0.02 * seen


@needs_chromium
def test_the_speed_of_a_machine_has_a_diagram_and_is_followed(page: Page, tmp_path: Path) -> None:
    problem = problem_of("press/flywheel")
    opened(page, problem, tmp_path)
    rows = Flywheel(problem).rows
    for phi, omega in zip(rows.phi_deg.tolist(), rows.omega.tolist(), strict=True):
        page.ask(f"planmethod.show({phi % 360})")
        assert page.ask("+D.quantities.at(-1).cells[0].dataset.value") == pytest.approx(
            omega, rel=1e-5
        )
    assert page.ask("D.quantities.at(-1).plot.querySelector('.curve').getTotalLength()") > 300
    assert page.ask("byId('follows').checked") is False
    assert not page.said


@needs_chromium
def test_a_position_that_does_not_exist_is_reported_and_play_turns_back(
    page: Page, tmp_path: Path
) -> None:
    opened(page, watt(), tmp_path, "en")
    assert page.ask("document.title").startswith("</script><script>alert(1)")
    assert page.ask("document.scripts.length") == 2
    assert page.ask("document.querySelectorAll('b').length") == 0
    assert page.ask("byId('why').hidden")
    page.ask("planmethod.show(60)")
    told = page.ask("byId('why').textContent")
    assert told.startswith("This position does not exist: point C cannot be placed.")
    near = [float(text) for text in re.findall(r"= ([\d.]+)°", told)]
    sweep = Sweep(watt())
    for edge, inside in zip(near, (-0.001, 0.001), strict=True):
        values = sweep.run(np.array([edge + inside, edge - inside]))
        assert np.isnan(values).any(axis=0).tolist() == [False, True]
    assert page.ask("document.querySelectorAll('figure.gone').length") == len(LiveScene(
        watt(), get_language("en")).views)  # fmt: skip
    assert set(page.ask("[...document.querySelectorAll('[data-row]')].map(n => n.textContent)")) > {
        "—"
    }
    # Where the motion is blocked, the driver turns back; it does not jump over the gap.
    # In one evaluation: frames of the browser's own clock must not come between.
    seen = page.ask(
        "(() => { planmethod.show(57); sense = 1; playing = 1; const seen = [];"
        " for (let t = 20; t < 2000; t += 20) { tick(t); seen.push([position, sense]); }"
        " playing = 0; return seen; })()"
    )
    places, senses = np.array([57.0, *(place for place, _ in seen)]), [one for _, one in seen]
    assert -1 in senses[:5]
    assert np.abs((np.diff(places) + 180.0) % 360.0 - 180.0).max() < 1.0
    assert page.ask("exists(now)")
    assert not page.said


@needs_chromium
def test_loads_that_change_are_those_of_the_program(page: Page, tmp_path: Path) -> None:
    problems = {told: watt(load) for told, load in LOADS.items()}
    problems |= {name: problem_of(f"machines/{name}") for name in ("engine", "compressor")}
    # its second piston begins at the bottom
    text = (ROOT / "tests/data/turn/two-cylinders.toml").read_text("utf-8")
    problems["two"] = number(loads(text, name="two"))
    problems["arc"] = loads(SWUNG, name="arc")
    for told, problem in problems.items():
        scene = opened(page, problem, tmp_path)
        assert scene.loads(), told
        positions = np.concatenate((np.linspace(-29.0, 57.0, 87) % 360.0, [20.0, 350.0]))
        if problem.machine is not None:
            positions = np.linspace(*scene.driver_range, 121)
        asked = f"{json.dumps(positions.tolist())}.map(x => at(x).map(v => v === v ? v : null))"
        made = np.array(page.ask(asked), dtype=float).T[: len(scene.sweep.rows)]
        assert apart(made, scene.sweep, positions) < 1e-11, told
        assert not page.said, told


@needs_chromium
def test_a_triad_keeps_its_assembly_on_the_page(page: Page, tmp_path: Path) -> None:
    """Over a turn, and where it swings between two dead positions."""
    for length in ("0.06", "0.01"):
        near = "[0.236, 0.08]" if length == "0.06" else "[0.2, 0.05]"
        text = path_of("linkages/triad").read_text("utf-8").replace("OA = 0.06", f"OA = {length}")
        problem = loads(text.replace("[0.236, 0.080]", near), name="triad")
        scene = opened(page, problem, tmp_path, "en")
        positions = np.linspace(0.0, 359.0, 180)
        asked = f"{json.dumps(positions.tolist())}.map(x => at(x).map(v => v === v ? v : null))"
        made = np.array(page.ask(asked), dtype=float).T[: len(scene.sweep.rows)]
        assert apart(made, scene.sweep, positions) < 1e-11
        gone = page.ask("(planmethod.show(200), byId('why').textContent)")
        assert ("link 3 cannot be assembled" in gone) == (length == "0.06")
        assert not page.said


# The file ---------------------------------------------------------------------------------------


def test_the_page_requests_no_resources_and_runs_no_foreign_scripts() -> None:
    text = live_page(watt(), "en")
    assert "default-src 'none'" in text
    assert "unsafe" not in text
    assert text.count("<script") == text.count("</script>") == 2
    assert "alert(1)</script>" not in text.replace("&lt;/script&gt;", "")
    assert not re.search(r'(?:src|href)="(?!#)', text)
    assert not set(re.findall(r"https?://[\w./]+", text)) - {"http://www.w3.org/2000/svg"}


def test_every_kind_of_problem_has_a_page() -> None:
    assert [kind.table for kind in KINDS_KINDS if not kind.has("live_page")] == []


def test_a_mechanism_without_any_position_has_no_page(tmp_path: Path) -> None:
    file = tmp_path / "watt.toml"
    file.write_text(WATT.replace("phi = 5", "phi = 100").replace("[0.4, 0.1]", "[4, 1]"), "utf-8")
    run = CliRunner().invoke(cli, ["live", str(file), "-o", str(tmp_path)])
    assert run.exit_code == ExitCode.ASSEMBLY
    assert "arcs from B" in run.output


GEARED = """
frame = { O = [0, 0], D = [1.2, 0.1] }
driver = { link = "1", phi = 5, omega = 2 }
assembly = { C = "left of AB" }
meshes = [{ links = ["1", "4"], centres = ["O", "D"], z = [60, 20] }]
[links.1]
points = ["O", "A"]
OA = 0.4
[links.2]
points = ["A", "C"]
AC = 1.0
[links.3]
points = ["C", "B"]
CB = 1.0
[links.4]
points = ["D", "B"]
DB = 0.4
"""


@pytest.mark.skipif(PROGRAM is None, reason="Chromium is not installed")
@pytest.mark.parametrize("name", ["geared", "linkages/ex3", "linkages/triad"])
def test_the_switch_of_instant_centres_shows_those_of_the_position(
    page: Page, tmp_path: Path, name: str
) -> None:
    problem = loads(GEARED, name=name) if name == "geared" else problem_of(name)
    opened(page, problem, tmp_path, "en")
    shown = "document.querySelectorAll('.centres [d^=M], .centres circle[visibility=visible]')"
    assert page.ask(f"{shown}.length") == 0
    page.ask("byId('centres').click()")
    size = max(length for _, _, length in problem.lengths)
    for position in (35.0, 43.5, 55.0) if name == "linkages/triad" else (33.0, 121.0, 217.5):
        page.ask(f"planmethod.show({position})")
        numbers = np.array(page.ask("centres(0, now)")).reshape(-1, 3)
        found = find_centres(Solution(problem, positions=[position]))
        for (x, y, w), centre in zip(numbers, found.centres.values(), strict=True):
            if centre.is_infinite:
                assert abs(w) <= 1e-9 * np.hypot(x, y)
            elif np.isfinite(centre.at.real):
                gap = abs(complex(x, y) / w - centre.at)
                assert gap <= 1e-6 * max(size, abs(centre.at)) * max(1.0, abs(centre.at) / size)
        assert page.ask(f"{shown}.length") > 2
    page.ask("byId('centres').click()")
    assert page.ask(f"{shown}.length") == 0 and not page.said


# Teaching ---------------------------------------------------------------------------------------

SETTLED = "!waiting"


def sized(page: Page, name: str, value: float) -> None:
    """Set a size, mm or degrees, by its field."""
    page.ask(
        f"(() => {{ const one = fields.find(one => one.name === {name!r}); one.field.value = "
        f"{value}; one.field.dispatchEvent(new Event('input')); }})()"
    )
    page.wait(SETTLED)


@needs_chromium
@pytest.mark.parametrize(
    ("name", "size", "unit"),
    [("linkages/ex3", "l_CD", "mm"), ("levers/task-33", "y_E", "mm"), ("press/press", "l_NB", "mm"),
     ("levers/crosshead", "angle_x-x", "deg"), ("cams", "l_BC", "mm")],
)  # fmt: skip
def test_a_length_on_the_page_gives_the_results_of_the_changed_file(
    name: str, size: str, unit: str, page: Page, tmp_path: Path
) -> None:
    problem = loads(WATT, name="watt") if name == "cams" else problem_of(name)
    opened(page, problem, tmp_path)
    known = Parameters(problem, pose)
    value = known.by_name[size].value * 1.07 or 4.0
    sized(page, size, value * (1000.0 if unit == "mm" else 1.0))
    changed = known.read({known.by_name[size]: value})
    places = [float(x) for x in problem.drive.positions[:3]]
    asked = f"{json.dumps(places)}.map(x => at(x).slice(0, END).map(v => v === v ? v : null))"
    made = np.array(page.ask(asked), dtype=float).T
    motion = Sweep(changed)
    rows = page.ask("D.rows")
    own = made[[rows.index(row.name) for row in motion.rows]]
    assert apart(own, motion, np.array(places)) < 1e-9
    assert page.ask("scheme.svg.classList.contains('changed')")
    page.ask("byId('first-sizes').click()")
    assert not page.ask("scheme.svg.classList.contains('changed')")
    again = np.array(page.ask(asked), dtype=float).T
    assert apart(again[[rows.index(row.name) for row in motion.rows]], Sweep(problem),
                 np.array(places)) < 1e-11  # fmt: skip
    assert not page.said


@needs_chromium
def test_a_mechanism_that_grows_stays_in_its_picture(page: Page, tmp_path: Path) -> None:
    opened(page, problem_of("linkages/ex3"), tmp_path)
    for length in (400, 130):
        sized(page, "l_DE", length)
        for phi in (0, 90, 200, 300):
            page.ask(f"planmethod.show({phi})")
            inside = page.ask(
                "scheme.labels.filter(one => one.at).every(one => { const [x, y] = point(scheme, "
                "now, one.at, 1), [l, t, w, h] = scheme.box; "
                "return x > l && x < l + w && y > t && y < t + h; })"
            )
            assert inside, (length, phi)


@needs_chromium
def test_a_held_position_is_compared_with_the_current_one(page: Page, tmp_path: Path) -> None:
    problem = problem_of("linkages/ex3")
    opened(page, problem, tmp_path, "en")
    page.ask("planmethod.show(20); byId('hold').click(); planmethod.show(150)")
    told = page.ask(
        "[...document.querySelectorAll('#compared tbody tr')].map(row => [row.cells[0].textContent,"
        " ...[1, 2, 3].map(k => +row.cells[k].dataset.value)])"
    )
    rows = {name: values for name, *values in told}
    table = Sweep(problem).table([20.0, 150.0])
    assert rows["ω3"] == pytest.approx([*table["omega_3"], np.diff(table["omega_3"])[0]])
    speeds = np.abs(table["v_E"])
    assert rows["vE"] == pytest.approx([*speeds, np.diff(speeds)[0]])
    assert rows["E, x"][:2] == pytest.approx(list(table["E.x"]))
    assert not {"A, x", "ω1"} & set(rows)  # they are the same in all positions
    turned = np.diff(table["3.phi_deg"])[0]
    assert rows["φ3"][2] == pytest.approx((turned + 180) % 360 - 180)
    # Both plans are to one scale and from one pole.
    ends = page.ask(
        "D.views.map(view => { const own = view.ghost.getBBox(), [l, t, w, h] = view.box; return "
        "[own.width + own.height > 1, own.x > l && own.y > t && own.x + own.width < l + w && "
        "own.y + own.height < t + h]; })"
    )
    assert all(drawn and inside for drawn, inside in ends)
    page.ask("byId('hold').click()")
    assert page.ask("byId('compared').hidden && !scheme.ghost.getAttribute('d')")
    assert not page.said


@needs_chromium
def test_a_measured_value_is_judged_by_the_accuracy_of_drawing(page: Page, tmp_path: Path) -> None:
    problem = problem_of("linkages/ex3")
    opened(page, problem, tmp_path, "en")
    page.ask("planmethod.show(100); byId('hides').click()")
    shown = page.ask("[...document.querySelectorAll('[data-row]')].map(one => one.textContent)")
    assert set(shown) == {"?"}
    exact = float(Sweep(problem, ["omega_3"]).table([100.0])["omega_3"][0])
    sigma = float(drafting_of(Solution(problem, positions=[100.0])).spreads["omega_3"].sigma[0])
    tolerance = max(TOLERANCE_SIGMAS * sigma, TOLERANCE_SHARE * abs(exact))

    def said(value: float) -> str:
        text = f"{value:.6f}".replace(".", ",")
        page.ask("for (const o of byId('guessed').options) o.selected = o.text === 'ω3'")
        page.ask(f"byId('measured').value = {text!r}; byId('asked').requestSubmit()")
        return str(page.ask("byId('verdict').textContent"))

    assert said(exact + 0.8 * tolerance).startswith("Right")
    assert said(exact - 1.5 * tolerance).startswith("Close")
    assert said(exact + 3 * tolerance).startswith("Not")
    assert said(-exact).startswith("The size is right, the sign is not")
    assert "Exactly" not in said(-exact)
    page.ask("byId('measured').value = 'x'")
    assert page.ask("(byId('asked').requestSubmit(), byId('verdict').textContent)").startswith("En")
    assert (Settings().k, Settings().floor_share) == (TOLERANCE_SIGMAS, TOLERANCE_SHARE)
    assert not page.said


@needs_chromium
def test_marks_of_the_task_lead_to_its_positions(page: Page, tmp_path: Path) -> None:
    text = WATT.replace("phi = 5", "phi = [5, 55, 355, 56]")
    problem = loads(text, name="watt")
    opened(page, problem, tmp_path, "en")
    marks = page.ask("[...byId('marks').children].map(one => [one.textContent, one.hidden])")
    assert [told for told, _ in marks] == ["0", "1", "2", "3"]
    page.wait("[...byId('marks').children].some(one => one.hidden)")  # 55° and 56°: one number
    for mark, phi in ((1, 55), (2, 355)):
        page.ask(f"byId('marks').children[{mark}].click()")
        assert page.ask("position") == phi
        middle = page.ask(
            f"(r => (r.left + r.right) / 2)(byId('marks').children[{mark}].getBoundingClientRect())"
        )
        left, width = page.ask("(r => [r.left, r.width])(slider.getBoundingClientRect())")
        assert middle == pytest.approx(left + 8 + phi / 360 * (width - 16), abs=1)


@needs_chromium
def test_arrows_go_from_segment_to_segment_of_a_view(page: Page, tmp_path: Path) -> None:
    opened(page, problem_of("linkages/ex3"), tmp_path, "en")
    seen = []
    for key in ("ArrowRight", "ArrowRight", "ArrowLeft"):
        page.ask(
            "D.views[1].svg.dispatchEvent(new KeyboardEvent('keydown', "
            f"{{ key: {key!r}, bubbles: true }}))"
        )
        seen.append(page.ask("D.views[1].told.textContent"))
    assert seen[0] == seen[2] != seen[1]
    assert all("m/s" in one for one in seen)


def test_a_mechanism_with_a_triad_says_where_its_sizes_are_changed() -> None:
    text = live_page(problem_of("linkages/triad"), "en")
    assert "planmethod studio" in text
    assert "first-sizes" not in text.partition("<script")[0]
