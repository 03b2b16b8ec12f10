"""Dimensions of the picture of a mesh agree with the numbers of the wheels."""

from __future__ import annotations

from math import pi
from pathlib import Path

import numpy as np
import pytest
from doors import (
    LARGEST_DRAWN_SHIFT,
    SMALLEST_DRAWN_SHIFT,
    Arc,
    Contour,
    MeshView,
    Pen,
    SolvedMeshing,
    Stroke,
    Text,
    Window,
    cutting_picture,
    cutting_view,
    get_language,
    involute_reader_load as load,
    mesh_dimensions,
    meshing_picture,
    sweep,
    view_for,
    working_region,
)
from shapely import LineString, Point
from worked import path_of

FILES = ("meshing/z12-30", "meshing/z20-60-internal")


def view_of(name: str) -> MeshView:
    return view_for(SolvedMeshing(load(path_of(name))), 360.0, 550.0)


@pytest.mark.parametrize("name", FILES)
def test_thickness_and_space_make_the_pitch(name: str) -> None:
    view = view_of(name)
    items, labels = mesh_dimensions(view, 5.0)
    thickness, space, pitch = (sweep(one) for one in items if isinstance(one, Arc))
    tooth = view.solved.teeth[0]
    assert thickness + space == pytest.approx(pitch) == pytest.approx(2 * pi / tooth.z)
    assert thickness * tooth.size("d") / 2 == pytest.approx(tooth.size("s"), abs=1e-6)
    named = {label.name for label in labels}
    lengths = {one for one in named if " r_" not in one}
    assert lengths - {"dimension c"} == {
        "dimension s_{1}",
        "dimension e_{1}",
        "dimension p",
        "dimension h",
    }


@pytest.mark.parametrize("name", FILES)
def test_the_dimension_of_a_tooth_spans_metal_and_that_of_a_space_does_not(
    name: str,
) -> None:
    """The metal of wheel 1 is found by its drawn tips."""
    view = view_of(name)
    items, labels = mesh_dimensions(view, 5.0)
    drawn = meshing_picture(view, get_language("en"), 5.0, items, labels).items
    centre, tooth = view.centre(0), view.solved.teeth[0]
    named = {label.name.removeprefix("dimension "): label for label in labels}
    tips = [one for one in drawn if isinstance(one, Arc) and abs(one.centre - centre) < 1e-9
            and one.radius == pytest.approx(tooth.size("d_a") / 2 * view.scale)
            and one.tag.split(" ")[0] not in ("circle", "dimension", "extension")]  # fmt: skip
    assert len(tips) > 2
    arcs = [one for one in items if isinstance(one, Arc)]
    for letters, is_metal in (("s_{1}", True), ("e_{1}", False)):
        at = named[letters].anchor
        (arc,) = (
            one for one in arcs
            if abs(abs(at - centre) - one.radius) < 1e-6
            and abs(at - centre - one.radius * np.exp(0.5j * (one.start + one.end))) < 1e-6
        )  # fmt: skip
        middle = np.exp(0.5j * (arc.start + arc.end))
        off = [np.angle(np.exp(0.5j * (one.start + one.end)) / middle) for one in tips]
        pitch = 2 * pi / tooth.z
        assert min(map(abs, off)) == pytest.approx(0.0 if is_metal else pitch / 2, abs=0.01 * pitch)


@pytest.mark.parametrize("name", FILES)
def test_the_height_of_the_tooth_runs_from_the_tips_of_wheel_2_to_its_roots(name: str) -> None:
    view = view_of(name)
    items, labels = mesh_dimensions(view, 5.0)
    (middle,) = (label.anchor for label in labels if label.name == "dimension h")
    lines = [one.points for one in items if isinstance(one, Stroke) and len(one.points) == 2]
    start, end = min(lines, key=lambda line: abs(sum(line) / 2 - middle))
    radii = sorted(abs(place - view.centre(1)) / view.scale for place in (start, end))
    sizes = [abs(view.solved.teeth[1].size(of)) / 2 for of in ("d_a", "d_f")]
    assert radii == pytest.approx(sorted(sizes))
    assert abs(end - start) / view.scale == pytest.approx(abs(sizes[1] - sizes[0]))


def test_the_clearance_is_lettered_where_it_is_visible() -> None:
    named = [{one.name for one in mesh_dimensions(view_of(name), 5.0)[1]} for name in FILES]
    assert ["dimension c" in names for names in named] == [True, False]  # of the ring it is 0.05 mm


@pytest.mark.parametrize("name", FILES)
def test_the_rim_is_broken_off_at_both_ends(name: str) -> None:
    items, _ = mesh_dimensions(view_of(name), 5.0)
    assert sum(isinstance(one, Stroke) and one.pen is Pen.BREAK for one in items) == 4


@pytest.mark.parametrize("name", FILES)
def test_the_blocking_contour_is_not_cut(name: str) -> None:
    solved = SolvedMeshing(load(path_of(name)))
    left, low, right, high = working_region(
        solved,
        Window(
            SMALLEST_DRAWN_SHIFT, LARGEST_DRAWN_SHIFT, SMALLEST_DRAWN_SHIFT, LARGEST_DRAWN_SHIFT
        ),
    ).bounds
    assert min(left, low) > SMALLEST_DRAWN_SHIFT + 0.1
    assert max(right, high) < LARGEST_DRAWN_SHIFT - 0.1


@pytest.mark.parametrize("name", FILES)
def test_the_blocking_contour_is_closed(name: str) -> None:
    """Every end of a bound lies on another one: of the ring's also where the involute ends."""
    contour = Contour.of(SolvedMeshing(load(path_of(name))))
    bounds = [part for limit, parts in contour.parts if limit.hard for part in parts]
    for k, part in enumerate(bounds):
        if np.ptp(part, axis=1).max() < 0.05:  # a corner
            continue
        others = np.hstack([other for n, other in enumerate(bounds) if n != k])
        for end in (part[:, :1], part[:, -1:]):
            assert np.min(np.hypot(*(others - end))) < 0.02, (end, contour.window)


def test_the_radii_run_from_the_centres_to_their_circles() -> None:
    """In the external pair both wheels have four; those of a ring would cover the pinion's."""
    told = []
    for name in FILES:
        view = view_of(name)
        items, labels = mesh_dimensions(view, 5.0)
        told.append(
            {label.name.removeprefix("dimension ") for label in labels if " r_" in label.name}
        )
        for wheel in (0, 1) if told[-1] and len(told) == 1 else (0,):
            centre, tooth = view.centre(wheel), view.solved.teeth[wheel]
            rays = [
                one.points for one in items if isinstance(one, Stroke) and one.points[0] == centre
            ]
            radii = sorted(abs(end - centre) / view.scale for _, end in rays)
            assert radii == pytest.approx([tooth.size("d_f") / 2, tooth.size("d_a") / 2])
    every = {f"r_{{{kind}{wheel}}}" for kind in "wbfa" for wheel in (1, 2)}
    assert told == [every, {one for one in every if "1" in one}]


@pytest.mark.parametrize("name", FILES)
def test_the_radius_of_the_rack_ends_on_its_tip(name: str) -> None:
    solved = SolvedMeshing(load(path_of(name)))
    cutting = solved.cuttings[0]
    assert cutting is not None
    view = cutting_view(cutting, 400.0, 300.0)
    picture = cutting_picture(view, get_language("ru"), 5.0)
    (name,) = {one.label for one in picture.items if isinstance(one, Text) and "ρ" in one.text}
    text = name.removeprefix("dimension ")
    size = cutting.tooth.pair.rack.rho * cutting.m
    assert text == f"ρ_{{f}} = {get_language('ru').notation.number(f'{size:.3f}')}"
    (rack,) = (one for one in picture.items if isinstance(one, Stroke) and one.tag == "rack")
    outline = LineString([(z.real, z.imag) for z in rack.points])
    radii = [
        one.points
        for one in picture.items
        if isinstance(one, Stroke)
        and one.tag.startswith("dimension ")
        and abs(abs(one.points[1] - one.points[0]) - size * view.scale) < 1e-9
    ]
    assert len(radii) == 1
    ((start, tip),) = radii
    assert outline.distance(Point(tip.real, tip.imag)) < 0.02
    assert outline.distance(Point(start.real, start.imag)) == pytest.approx(
        size * view.scale, abs=0.02
    )


@pytest.mark.parametrize("name", FILES)
def test_every_dimension_of_the_rack_is_as_long_as_its_letters_state(name: str) -> None:
    cutting = SolvedMeshing(load(path_of(name))).cuttings[0]
    assert cutting is not None
    view = cutting_view(cutting, 400.0, 300.0)
    items = cutting_picture(view, get_language("en"), 5.0).items
    lines = [
        one.points for one in items if isinstance(one, Stroke) and one.tag.startswith("dimension ")
    ]
    said = {}
    for text in (one for one in items if isinstance(one, Text) and " = " in one.label):
        letters, _, number = text.label.removeprefix("dimension ").partition(" = ")
        said[letters] = (float(number.replace("−", "-")), text.at)
    assert {"p", "c", "h_{1}"} <= {*said}
    for letters in ("p", "c", "h_{1}", "x_{1}·m"):
        if letters in said:
            value, at = said[letters]
            near = [line for line in lines if len(line) == 2 and abs(sum(line) / 2 - at) < 45.0]
            lengths = [abs(end - start) / view.scale for start, end in near]
            tails = [length - 10.0 / view.scale for length in lengths]  # arrowheads from outside
            nearest = min((*lengths, *tails), key=lambda length: abs(length - abs(value)))
            assert nearest == pytest.approx(abs(value), abs=6e-4), letters
    arcs = [one for one in items if isinstance(one, Arc) and one.tag.startswith("dimension ")]
    radius = cutting.tooth.size("d") / 2
    swept = sorted(sweep(one) * radius for one in arcs)
    assert swept == pytest.approx(sorted(said[of][0] for of in ("s_{1}", "e_{1}")), abs=1e-3)


def test_a_base_radius_is_named_where_it_is_drawn(tmp_path: Path) -> None:
    """With many teeth N₂ is far away: there is neither a line to it nor a letter of its radius."""
    far = tmp_path / "far.toml"
    far.write_text("[meshing]\nz = [17, 40]\nm = 4\nbeta = 15\nb = 40\nx = [0.63, 0.81]\n", "utf-8")
    told = []
    for path in (path_of(FILES[0]), far):
        view = view_for(SolvedMeshing(load(path)), 360.0, 550.0)
        items, labels = mesh_dimensions(view, 5.0)
        drawn = meshing_picture(view, get_language("en"), 5.0, items, labels).items
        lines = [one for one in drawn if isinstance(one, Stroke) and one.tag == "base radius"]
        named = [one.name for one in labels if " r_{b" in one.name]
        assert len(named) == len(lines)
        told.append(len(named))
    assert min(told) == 1
