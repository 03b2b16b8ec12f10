"""Guides of the frame are on the scheme at the places given in the file."""

from __future__ import annotations

import pytest
from doors import (
    PlanKind,
    PointName,
    SchemeView,
    Solution,
    Stroke,
    get_language,
    statement_given_facts as given_facts,
)

from planmethod import loads

MECHANISM = """
title = "A slider beside its guide"
[frame]
O = [0, 0]
guides.x-x = {{ through = {through}, angle = 0 }}
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = ["A", "B"]
AB = 0.35
[links.3]
points = ["B"]
slides = {{ on = "x-x", offset = 0.05 }}
[driver]
link = "1"
phi = 50
omega = 10
[assembly]
B = "right of A"
"""


@pytest.mark.parametrize(
    ("through", "told", "metres"),
    [
        ("[0, -0.03]", "y_{x-x} = −0,03 м", -0.03),
        ('"O"', "горизонтальная направляющая x-x отстоит от точки O на 0,05 м вверх", 0.05),
    ],
)
def test_a_guide_is_lettered_at_its_stated_place(through: str, told: str, metres: float) -> None:
    problem = loads(MECHANISM.format(through=through), name="beside")
    assert told in [fact.text for fact in given_facts(problem, get_language("ru"))]
    solution = Solution(problem)
    pin = PointName("B")
    scheme = SchemeView.drawn(solution, 0).scheme
    ((_, *ends),) = scheme.axis_ends
    per_mm = solution.scales[PlanKind.POSITION].per_mm
    assert [end.imag * per_mm for end in ends] == pytest.approx([metres, metres])
    lines = [i.points for i in scheme.guides if isinstance(i, Stroke) and i.tag == "guide"]
    heights = {round(end.imag * per_mm, 6) for line in lines for end in line}
    assert heights == {metres, round(solution.place(pin)[0].imag, 6)}
