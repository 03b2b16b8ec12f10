"""Dimensions of the picture of a mesh agree with the numbers of the wheels."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from worked import path_of

from planmethod.gears.involute.diagrams import HIGH, LOW, Contour, Window, working
from planmethod.gears.involute.meshdimensions import mesh_dimensions
from planmethod.gears.involute.meshpicture import MeshView, view_for
from planmethod.gears.involute.quantities import SolvedMeshing
from planmethod.gears.involute.reader import load
from planmethod.render.ink.drawing import Arc, Pen, Stroke
from planmethod.render.ink.style import sweep

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
    assert named - {"size c"} == {"size s_{1}", "size e_{1}", "size p", "size h"}


def test_the_clearance_is_told_where_it_shows() -> None:
    named = [{one.name for one in mesh_dimensions(view_of(name), 5.0)[1]} for name in FILES]
    assert ["size c" in names for names in named] == [True, False]  # of the ring it is 0.05 mm


@pytest.mark.parametrize("name", FILES)
def test_the_rim_is_broken_off_at_both_ends(name: str) -> None:
    items, _ = mesh_dimensions(view_of(name), 5.0)
    assert sum(isinstance(one, Stroke) and one.pen is Pen.BREAK for one in items) == 4


@pytest.mark.parametrize("name", FILES)
def test_the_blocking_contour_is_not_cut(name: str) -> None:
    solved = SolvedMeshing(load(path_of(name)))
    left, low, right, high = working(solved, Window(LOW, HIGH, LOW, HIGH)).bounds
    assert min(left, low) > LOW + 0.1
    assert max(right, high) < HIGH - 0.1


@pytest.mark.parametrize("name", FILES)
def test_the_blocking_contour_is_closed(name: str) -> None:
    """Every end of a bound lies on another one: of the ring's also where the involute ends."""
    contour = Contour.of(SolvedMeshing(load(path_of(name))))
    bounds = [part for limit, parts in contour.parts if limit.hard for part in parts]
    bounds = [part for part in bounds if np.ptp(part, axis=1).max() > 0.05]
    for k, part in enumerate(bounds):
        others = np.hstack([other for n, other in enumerate(bounds) if n != k])
        for end in (part[:, :1], part[:, -1:]):
            assert np.min(np.hypot(*(others - end))) < 0.02, (end, contour.window)
