"""Laws of motion: their ends, their derivatives, their jumps."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from cams import LAWS
from doors import CamLawName, UnitLaw, law_of

MORE: dict[CamLawName, list[dict[str, Any]]] = {
    CamLawName.CONSTANT: [{}, {"ratio": 2.0}],
    CamLawName.TRAPEZOIDAL: [{}, {"ramp": 0.25}, {"ramp": 0.01}],
    CamLawName.MODIFIED: [{}, {"ramp": 0.25}],
    CamLawName.LINEAR: [{}, {"blend": 0.2}],
    CamLawName.TABLE: [{"values": [0, 0.5, 1, 0.7, 0, -0.5, -1, -0.8, 0]}],
    CamLawName.LIFT: [{"values": [0, 0.1, 0.5, 2, 3.7, 4]}, {"values": [7, 6, 2, 0]}],
    CamLawName.PIECEWISE: [
        {"points": [(0, 1), (0.3, 1), (0.3, 0), (0.6, 0), (0.6, -1), (1, -0.5)]}
    ],
}  # fmt: skip
EVERY = [law_of(name, **keys) for name in CamLawName for keys in MORE.get(name, [{}])]


@pytest.mark.parametrize("law", EVERY, ids=lambda law: law.name.value)
def test_a_law_goes_from_rest_to_one_and_its_derivatives_are_its_own(law: UnitLaw) -> None:
    ends = law.ends
    assert ends[0, 0, 0] == pytest.approx(0.0, abs=1e-15)
    assert ends[-1, 1, 0] == pytest.approx(1.0, abs=1e-14)
    jump = 0.0 if law.start == 0.0 else 1.0  # only the plain linear law starts at once
    assert ends[0, 0, 1] == pytest.approx(jump, abs=1e-14)
    assert ends[-1, 1, 1] == pytest.approx(jump, abs=1e-13)
    assert np.allclose(ends[:-1, 1, :2], ends[1:, 0, :2], atol=1e-13)
    for k, bit in enumerate(law.bits):
        u = np.linspace(bit.start, bit.end, 9)[1:-1]
        step = 1e-3 * (bit.end - bit.start)
        tilt = (law.on(k, u + step) - law.on(k, u - step)) / (2 * step)
        assert np.allclose(tilt[:2], law.on(k, u)[1:], atol=2e-4)


@pytest.mark.parametrize("name", LAWS)
def test_a_law_is_that_of_the_textbook(name: str) -> None:
    law = law_of(CamLawName(name))
    value, slope = LAWS[name]
    for k, bit in enumerate(law.bits):
        u = np.linspace(bit.start, bit.end, 50)[:-1]
        s, v, _ = law.on(k, u)
        assert np.allclose(s, value(u), atol=1e-14)
        assert np.allclose(v, slope(u), atol=1e-13)


def test_greatest_derivatives_are_those_that_are_known() -> None:
    known = {
        "modified-trapezoidal": (2.0, 4.8881),
        "trapezoidal": (2.0, 5.3333),
        "sine": (2.0, 6.2832),
    }
    for name, (v, a) in known.items():
        law = law_of(CamLawName(name))
        rows = [law.on(k, np.linspace(b.start, b.end, 501)) for k, b in enumerate(law.bits)]
        assert max(float(r[1].max()) for r in rows) == pytest.approx(v, abs=1e-4)
        assert max(float(r[2].max()) for r in rows) == pytest.approx(a, abs=1e-4)


def test_decelerations_of_a_table_are_brought_to_the_area_of_the_accelerations() -> None:
    law = law_of(CamLawName.TABLE, values=[1, 1, -0.5, -0.5])
    up, down = 1 / 3 + 1 / 3 * (2 / 3) / 2, 1 / 3 * 0.5 + 1 / 3 * (1 / 3) * 0.5 / 2
    assert law.balance == pytest.approx(up / down)
