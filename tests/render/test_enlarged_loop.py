"""A narrow energy-mass curve is drawn once more, large enough for the numbers of its points."""

from __future__ import annotations

import numpy as np
import pytest
from doors import (
    DRAFTING_PROFILES as PROFILES,
    RATIOS,
    Disc,
    Flywheel,
    FlywheelDrawing,
    MachineNarrator,
    Text,
    construction_picture,
    get_language,
)
from msgspec.structs import replace
from worked import problem_of


@pytest.mark.parametrize("lang", ["ru", "en"])
@pytest.mark.parametrize(("inertia", "narrow"), [(0.0, False), (0.04, True)])
def test_a_narrow_curve_is_enlarged(lang: str, inertia: float, narrow: bool) -> None:
    """The heavier the crank, the less of the inertia changes."""
    problem = problem_of("machines/engine")
    assert problem.machine is not None
    problem = replace(problem, machine=replace(problem.machine, crank_inertia=inertia))
    drawing = FlywheelDrawing(Flywheel(problem), PROFILES["board"])
    picture = construction_picture(drawing, MachineNarrator(drawing, get_language(lang)), 5.0)
    larger = [one.centre for one in picture.items
              if isinstance(one, Disc) and one.tag == "diagram enlarged"]  # fmt: skip
    heading = {"ru": "начинается не с нуля", "en": "does not begin at zero"}[lang]
    written = " ".join(one.text for one in picture.items if isinstance(one, Text))
    assert (heading in written) is narrow
    assert len(larger) == (drawing.count if narrow else 0)
    if narrow:
        curve = [complex(drawing.exact.point(name)[0]) for name in drawing.construction.curve]
        times = np.ptp(np.real(larger)) / np.ptp(np.real(curve))
        assert min(abs(times - ratio) for ratio in RATIOS) < 1e-9
        off = (np.array(larger) - larger[0]) - times * (np.array(curve) - curve[0])
        assert np.max(np.abs(off)) < 1e-9
