"""The sheet of the flywheel: the construction is on it to scale, and the lint finds no faults."""

from __future__ import annotations

import json

import numpy as np
import pytest
from cases import each, thinned
from click.testing import CliRunner
from doors import (
    DRAFTING_PROFILES as PROFILES,
    NEAREST_POLE,
    STEPS,
    TALLEST,
    Alternatives,
    Arc,
    Block,
    BlockOptions,
    BlockSpec,
    BlockStyle,
    Disc,
    Drawing,
    ExitCode,
    Fill,
    Flywheel,
    FlywheelMethod,
    MachineAccount,
    MachineNarrator,
    Pen,
    Sizes,
    Solution,
    Span,
    Stroke,
    Text,
    cli,
    construction_picture,
    drawing_of,
    get_language,
    kinds_load as load,
    kinematics_sheets,
    machine_narrator,
    maker_of,
)
from msgspec.structs import replace
from worked import ROOT, drawn_sheets, path_of, problem_of

WANTED = json.loads((ROOT / "tests/data/flywheel.json").read_text("utf-8"))
FILES = ("press/flywheel", "machines/compressor", "machines/engine")


def sheet(name: str) -> Drawing:
    (drawn,) = drawn_sheets(name, layout="flywheel")
    return drawn


def measured(drawn: Drawing) -> dict[str, Span]:
    """Return the measured segments of the constructed diagrams."""
    views = (view for view in drawn.views if view.kind == "flywheel")
    return {span.name: span for view in views for span in view.spans}


@each("name", FILES)
def test_the_diagrams_under_one_another_have_common_abscissae(name: str) -> None:
    """Moment and work are a view of their own, with others beside them, where white parts them."""
    drawn = sheet(name)
    assert len([view for view in drawn.views if view.kind == "flywheel"]) in (1, 2)
    axes = [item.points for item in drawn.items
            if isinstance(item, Stroke) and item.tag == "diagram axis"]  # fmt: skip
    level = [ends for ends in axes if abs((ends[1] - ends[0]).imag) < 1e-6]
    left = measured(drawn)["H"].end.real
    assert sum(abs(ends[0].real - left) < 1e-6 for ends in level) == 4  # M, A, ΔT, J


def of_kind(name: str, kind: str) -> list[Block]:
    """Return the layouts of a block on an A1 sheet."""
    manner = BlockStyle(
        BlockSpec(kind), Sizes(5.0, 5.0, 5.0, 178.0), 800.0, BlockOptions(get_language("en"))
    )
    made = maker_of(kind)(Solution(problem_of(name)), (0,), manner)
    return list(made.blocks) if isinstance(made, Alternatives) else [made]


def test_the_diagram_of_the_speed_has_its_axis_under_those_of_the_construction() -> None:
    """Where there is space; it is also higher then."""

    def left(way: Block) -> float:
        axes = [item.points for item in way.place(0j)
                if isinstance(item, Stroke) and item.tag == "diagram axis"]  # fmt: skip
        return min(ends[0].real for ends in axes if abs((ends[1] - ends[0]).real) > 100.0)

    (whole,) = of_kind("machines/engine", "flywheel-diagrams")
    ways = of_kind("machines/engine", "speed-diagram")
    starts = {round(left(way) - left(whole), 6) for way in ways}
    heights = {round(way.height) for way in ways}
    assert min(starts) < 0.0 == max(starts)
    assert len(heights) > 2


def test_the_flywheel_is_as_large_as_its_place_on_the_sheet() -> None:
    radii = [max(item.radius for item in way.place(0j) if isinstance(item, Arc))
             for way in of_kind("press/flywheel", "flywheel")]  # fmt: skip
    assert len(radii) > 1 and radii == sorted(radii)


def test_the_flywheel_has_dimensions_with_numbers() -> None:
    """Millimetres without unit, as on a drawing; the lines below say which is D."""
    texts = [item for item in sheet("machines/compressor").items if isinstance(item, Text)]
    told = {
        (item.label, item.text)
        for item in texts
        if item.label.startswith("dimension ") and item.text[0].isdigit()  # H_A has no number
    }
    assert told == {("dimension D", "660"), ("dimension D_{1}", "528"), ("dimension b", "131,1")}


def test_the_points_are_at_their_scaled_coordinates() -> None:
    wanted = WANTED["rod/table/true"]["sheet_mm"]["12"]
    drawn = sheet("press/flywheel")
    spans = measured(drawn)
    assert spans["KL"].length == pytest.approx(wanted["K"] - wanted["L"], abs=1e-6)
    assert spans["H"].length == pytest.approx(30.0)
    points = np.array(
        [item.centre for item in drawn.items if isinstance(item, Disc) and "point" in item.tag]
    )
    # the energy-mass points are right of K and L by J, and above their axis by dT
    foot = spans["KL"].end - 1j * wanted["K"]
    for inertia, energy in zip(wanted["J"][:-1], wanted["T"][:-1], strict=True):
        assert np.min(np.abs(points - foot - complex(inertia, energy))) < 0.02
    left = spans["H"].end
    for k, work in enumerate(wanted["A"]):
        assert np.min(np.abs((points - left).real - 20.0 * k)) < 0.02, work


def test_the_tangents_touch_the_energy_mass_curve_at_its_ends() -> None:
    """The upper one leaves the whole curve below itself, the lower one above."""
    drawn = sheet("press/flywheel")
    points = [item.centre for item in drawn.items if isinstance(item, Disc) and "point" in item.tag]
    lines = [item.points for item in drawn.items
             if isinstance(item, Stroke) and item.tag == "diagram tangent"]  # fmt: skip
    span = measured(drawn)["KL"]
    curve = [z for z in points if z.real > span.end.real]
    upper, lower = sorted(lines, key=lambda line: -line[0].imag)
    for (cut, beyond), sense in ((upper, 1), (lower, -1)):
        way = (beyond - cut) / abs(beyond - cut)
        off = [sense * ((z - cut) * way.conjugate()).imag for z in curve]
        assert max(off) == pytest.approx(0.0, abs=0.05)


OF_TANGENTS = ("касательн", "tangent", "энергомасс", "energy-mass", "KL", "ψ")


@each("name, lang", [("press/flywheel", "ru"), ("machines/compressor", "en")])
def test_by_mertsalov_the_sheet_has_three_curves_of_energy_and_their_segment(
    name: str, lang: str
) -> None:
    problem = problem_of(name)
    assert problem.machine is not None
    machine = replace(problem.machine, method=FlywheelMethod.MERTSALOV)
    problem = replace(problem, machine=machine, sheet=replace(problem.sheet, lang=lang))
    (drawn,) = kinematics_sheets(problem, layout="flywheel")
    drawing = drawing_of(Flywheel(problem), PROFILES["board"])
    wheel, points, work = drawing.flywheel, drawing.points, drawing.scales.work
    second = 0.5 * wheel.middle_speed**2 * points.inertia
    for key, energy in (("T", points.gain), ("T_II", second), ("T_I", points.gain - second)):
        (curve,) = (item.points for item in drawn.items
                    if isinstance(item, Stroke) and item.tag == f"diagram curve {key}")  # fmt: skip
        pieces = (len(curve) - 1) // drawing.count  # of a smooth line between two positions
        got = np.array(curve[::pieces]) - curve[0]
        wanted = np.linspace(0.0, drawing.length, drawing.count + 1)
        assert np.allclose(got, wanted + 1j * (energy - energy[0]) / work, rtol=0.0, atol=1e-6), key
    spans = measured(drawn)
    assert set(spans) == {"AB", "H"}
    length = drawing.inertia * wheel.machine.delta * wheel.middle_speed**2 / work
    assert spans["AB"].length == pytest.approx(length, abs=1e-6)
    ends = {item.tag: item.centre for item in drawn.items
            if isinstance(item, Disc) and item.tag in ("A", "B")}  # fmt: skip
    assert ends["A"] == pytest.approx(spans["AB"].end)
    assert ends["B"].imag == pytest.approx(spans["AB"].start.imag)
    tell = MachineNarrator(drawing, get_language(lang))
    sheet = [item.text for item in drawn.items if isinstance(item, Text)]
    heads = [head for head, _, _ in tell.columns()]
    account = MachineAccount(tell, STEPS)
    told_of = (map(repr, nodes) for nodes in (account.calculation(), account.chapter()))
    for told in (sheet, heads, *told_of):
        text = " ".join(told)
        assert "II" in text
        assert not [word for word in OF_TANGENTS if word in text], text


@each("name", thinned(FILES, 3))
def test_the_lint_finds_no_faults_on_the_sheet(name: str) -> None:
    run = CliRunner().invoke(cli, ["lint", str(path_of(name)), "--layout", "flywheel"])
    assert run.exit_code == ExitCode.DONE, run.output


def test_the_axis_of_the_moment_is_above_its_curve_between_the_positions() -> None:
    """The peak of an engine's moment is between two of eight positions."""
    path = ROOT / "tests/data/projects/engine.toml"
    run = CliRunner().invoke(cli, ["lint", str(path), "--layout", "flywheel"])
    assert run.exit_code == ExitCode.DONE and "PM-D02" not in run.output, run.output


def test_the_sheet_has_the_error_of_the_construction() -> None:
    texts = "".join(item.text for item in sheet("press/flywheel").items if isinstance(item, Text))
    for said in ("−6,50", "−6,63", "2,550", "2,384", "0,055556"):
        assert said in texts


def test_a_file_without_a_machine_is_reported() -> None:
    run = CliRunner().invoke(cli, ["sheet", str(path_of("press/press")), "--layout", "flywheel"])
    assert run.exit_code == ExitCode.USAGE or run.exit_code == ExitCode.PROBLEM, run.output
    assert "needs [machine]" in run.output


def test_a_moment_that_jumps_is_drawn_upright() -> None:
    problem = load(ROOT / "tests/data/turn/shaper.toml")
    drawing = drawing_of(Flywheel(problem), PROFILES["board"])
    picture = construction_picture(drawing, MachineNarrator(drawing, get_language("ru")), 5.0)
    curve = [item for item in picture.items
             if isinstance(item, Stroke) and item.tag == "diagram curve M"]  # fmt: skip
    uprights = [one for one in curve if one.pen is Pen.THIN]
    assert len(uprights) == 2
    assert all(abs((one.points[1] - one.points[0]).real) < 0.1 for one in uprights)
    given = MachineNarrator(drawing, get_language("ru")).given_facts()
    assert not any(fact.text.startswith("φ") for fact in given)  # of no single position


@pytest.mark.parametrize("path, sides", [("problems/machines/engine.toml", (39, 73)),
                                         ("problems/machines/compressor.toml", (30, 77)),
                                         ("tests/data/turn/shaper.toml", (113, 81))])  # fmt: skip
def test_an_energy_mass_curve_takes_the_available_area(path: str, sides: tuple[int, int]) -> None:
    drawing = drawing_of(Flywheel(load(ROOT / path)), PROFILES["board"])
    wide = float(np.ptp(drawing.points.inertia)) / drawing.scales.inertia
    high = float(np.ptp(drawing.points.gain)) / drawing.scales.work
    assert (round(wide), round(high)) == sides
    assert drawing.height <= TALLEST and drawing.pole >= NEAREST_POLE


def test_scales_of_the_file_are_those_of_an_energy_mass_curve() -> None:
    drawing = drawing_of(Flywheel(load(ROOT / "problems/press/flywheel.toml")), PROFILES["board"])
    assert (drawing.scales.inertia, drawing.scales.moment, drawing.pole) == (0.005, 0.5, 30.0)


def test_the_dimensions_of_the_flywheel_span_its_width_and_its_diameter() -> None:
    """Read between the heads of each dimension, beside the circle of the rim."""
    solution = Solution(problem_of("press/flywheel"))
    sizes = machine_narrator(solution, get_language("en")).sizes
    assert sizes is not None and not sizes.bore
    manner = BlockStyle(
        BlockSpec("flywheel"), Sizes(5.0, 5.0, 5.0, 240.0), 800.0, BlockOptions(get_language("en"))
    )
    items = maker_of("flywheel")(solution, (0,), manner).place(0j)
    rim = max(one.radius for one in items if isinstance(one, Arc))
    tips = [one.points[0] for one in items if isinstance(one, Fill)]
    lengths = sorted(
        abs(two - one) / (2.0 * rim) for one, two in zip(tips[::2], tips[1::2], strict=True)
    )
    assert lengths == pytest.approx(sorted((1.0, sizes.width / sizes.diameter)), rel=1e-6)
