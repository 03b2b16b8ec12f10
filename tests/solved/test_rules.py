"""Assembly rules that look ahead."""

from __future__ import annotations

import re

import pytest
from doors import ProblemError, Solution, problem_loads as loads
from worked import path_of


def test_a_rule_cannot_compare_with_a_point_of_a_later_group() -> None:
    text = path_of("levers/six-link").read_text("utf-8").partition("[published")[0]
    text = re.sub(r"(?ms)^\[assembly\]\n.*?(?=^\[|\Z)", '[assembly]\nC = "right of H"\n', text)
    with pytest.raises(ProblemError) as caught:
        Solution(loads(text, name="late"))
    (fault,) = caught.value.faults
    assert str(fault) == (
        "assembly.C: H is placed after C, so it cannot determine its place. "
        "Compare with a fixed point or with one that an earlier group places"
    )
