"""A slot is a line of its link: the error if the sliding block's pin is a point of it."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from doors import ProblemError, Solution, problem_load as load, problem_loads as loads, verify

SLOT = Path(__file__).parent / "faulty" / "slides-along-own-pin.toml"
HINT = 'slides = { on = "3", through = "C", angle = 90 }'


def mechanism(angle: str) -> str:
    """Return a slotted link whose arm CD is at an angle to its slot, CB in the drawn position."""
    return f"""
[frame]
A = [0, 0]
C = [0, -0.2]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B"]
slides = {{ on = "3", along = "CB" }}
[links.3]
points = ["C", "D"]
CD = 0.25
{angle}
[driver]
link = "1"
phi = 60
omega = 16
"""


def test_the_file_is_solved_after_the_advised_change() -> None:
    with pytest.raises(ProblemError, match=re.escape(HINT)):
        load(SLOT)
    text = re.sub(r"(?m)^# .*\n", "", SLOT.read_text("utf-8"))
    text = text.replace('slides = { on = "3", along = "CB" }', HINT)
    text = text.replace("angle.BCD = -90\n", "").replace("DS5 = 0.1\n", "")
    text = text.replace("CS3 = 0.1", 'S3 = { on = "CD", at = 0.1 }')
    text = text.replace("inertia = 0.2\n", 'inertia = 0.2\ncentre = "A"\n')
    verify(Solution(loads(text, name="slot")))


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("angle.BCD = -90", 90),
        ("angle.DCB = 90", 90),
        ("angle.DCB = 30", 30),
        ("angle.BCDC = 0", 0),  # from BC to DC: both are turned round
        ("angle.CBDC = 60", 120),
    ],
)
def test_the_angle_of_the_slot_is_counted_from_the_arm(written: str, told: float) -> None:
    with pytest.raises(ProblemError) as caught:
        loads(mechanism(written), name="slot")
    first = str(caught.value.faults[0])
    assert f'through = "C", angle = {told} }}, the angle from CD to CB' in first


def test_another_letter_than_the_pin_is_no_slot() -> None:
    with pytest.raises(ProblemError) as caught:
        loads(mechanism("angle.DCX = 20").replace('"CB"', '"CX"'), name="slot")
    assert [fault.path for fault in caught.value.faults] == [
        "links.3.angle.DCX",
        "links.2.slides.along",
    ]
    assert "across" not in str(caught.value)
