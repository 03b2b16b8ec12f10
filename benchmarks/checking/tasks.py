"""The problems of the simulator, and how a student goes through each (задачи).

Ten have data of the bank of tasks, four are of one's own; the checking was not developed on any.
"""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from copy import deepcopy
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from benchmarks.checking import calculated
from benchmarks.checking.drawing import ACCELERATIONS, FORCES, SCHEME, VELOCITIES, Drawing
from benchmarks.checking.forces import four_bar_forces, slider_crank_forces
from benchmarks.checking.hand import Data, Hand, Student
from benchmarks.checking.scheme import at_angle
from benchmarks.checking.triad import triad

FOLDER = Path(__file__).parent / "problems"


@dataclass(frozen=True, slots=True)
class Problem:
    """A problem file with a student's way through it (задача)."""

    name: str
    solve: Callable[[Student], None]
    drawn: bool

    @property
    def path(self) -> Path:
        """File of the problem."""
        return FOLDER / f"{self.name}.toml"

    def variants(self) -> dict[str, Data]:
        """Return the data of all variants by their names."""
        data = tomllib.loads(self.path.read_text("utf-8"))
        return {name: varied(data, change) for name, change in data["variants"].items()}

    def work(
        self, data: Data, hand: Hand, habits: frozenset[tuple[str, str]] = frozenset()
    ) -> Student:
        """Return a student who has done the work."""
        student = Drawing(data, hand, habits) if self.drawn else Student(data, hand, habits)
        self.solve(student)
        student.copy_out()
        return student


def varied(data: Data, change: Data) -> dict[str, Any]:
    """Return data with the numbers of a variant; a load is known by its name."""
    result: dict[str, Any] = deepcopy(dict(data))

    def enter(inside: dict[str, Any], changes: Data) -> None:
        for key, value in changes.items():
            if isinstance(value, dict):
                child = inside[key]
                if isinstance(child, list):
                    child = {one["name"]: one for one in child}
                enter(child, value)
            else:
                inside[key] = value

    enter(result, change)
    return result


def _drawn(groups: Callable[[Drawing], None]) -> Callable[[Student], None]:
    def solve(student: Student) -> None:
        assert isinstance(student, Drawing)
        for student.stage in (SCHEME, VELOCITIES, ACCELERATIONS, FORCES):
            groups(student)

    return solve


def _four_bar(student: Drawing) -> None:
    student.fixed("O", "C")
    student.crank("O", "A")
    student.two_rods("B", "A", "C", ("2", "3"), 1)
    student.carried("S", "A", "B", complex(0.12 / student.length("AB")))
    student.carried("D", "C", "B", student.shape("C", "B", "D", 1), link="3", pivot=True)


def _offset_slider(student: Drawing) -> None:
    student.fixed("O")
    student.crank("O", "A")
    student.slider("B", "A", "2", "x-x", 1)
    student.carried("D", "A", "B", complex(0.15, 0.05) / student.length("AB"))


def _six_bar(student: Drawing) -> None:
    student.fixed("O", "C")
    student.crank("O", "A")
    student.two_rods("B", "A", "C", ("2", "3"), 1)
    student.slider("D", "B", "4", "x-x", 1)
    student.carried("M", "B", "D", complex(0.12 / student.length("BD")))


def _slotted(student: Drawing) -> None:
    student.fixed("O", "B")
    student.crank("O", "A")
    student.slotted("A", "B", "3", "BC")
    ratio = student.length("BC") / abs(student.true["A"] - student.true["B"])
    student.carried("C", "B", "A3", complex(ratio), link="3", pivot=True)
    student.slider("D", "C", "4", "x-x", 1)


def _slotted_after(student: Drawing) -> None:
    student.fixed("A", "E")
    student.crank("A", "B")
    student.slider("C", "B", "2", "x-x", 1)
    student.carried("D", "B", "C", complex(0.25, -0.05) / student.length("BC"))
    student.slotted("D", "E", "5", "EK")
    ratio = student.length("EK") / abs(student.true["D"] - student.true["E"])
    student.carried("K", "E", "D5", complex(ratio), link="5", pivot=True)


def _slotted_arm(student: Drawing) -> None:
    student.fixed("A", "C")
    student.crank("A", "B")
    student.slotted("B", "C", "3", "CK")
    ratio = 0.24 * at_angle(-90) / abs(student.true["B"] - student.true["C"])
    student.carried("D", "C", "B3", ratio, link="3", pivot=True)
    student.slider("E", "D", "4", "y-y", 1)


def _triad(student: Drawing) -> None:
    student.fixed("O", "E", "F")
    student.crank("O", "A")
    arms = (("A", "B", "2"), ("E", "C", "4"), ("F", "D", "5"))
    guess = complex(*student.data["assembly"]["B"]["near"])
    triad(student, arms, "3", 1, guess)


def _forces(student: Drawing) -> None:
    student.fixed("O")
    student.crank("O", "A")
    student.slider("B", "A", "2", "x-x", 1)
    student.carried("S2", "A", "B", complex(0.14 / student.length("AB")))
    slider_crank_forces(student, ("O", "A", "B", "S2"), "x-x")


def _rocker_forces(student: Drawing) -> None:
    student.fixed("O", "C")
    student.crank("O", "A")
    student.two_rods("B", "A", "C", ("2", "3"), 1)
    student.carried("S2", "A", "B", complex(0.2 / student.length("AB")))
    student.carried("S3", "C", "B", complex(0.15 / student.length("CB")), link="3", pivot=True)
    four_bar_forces(student, ("O", "A", "B", "C"), {"2": "S2", "3": "S3"})


PROBLEMS = (
    Problem("b-25", _drawn(_four_bar), drawn=True),
    Problem("b-29", _drawn(_offset_slider), drawn=True),
    Problem("b-100", _drawn(_six_bar), drawn=True),
    Problem("b-123", _drawn(_slotted), drawn=True),
    Problem("h-33", _drawn(_slotted_after), drawn=True),
    Problem("h-13", _drawn(_slotted_arm), drawn=True),
    Problem("g-28", calculated.two_rings, drawn=False),
    Problem("k10", calculated.differential, drawn=False),
    Problem("k11-02", calculated.moving_point, drawn=False),
    Problem("k11-14", calculated.moving_point, drawn=False),
    Problem("own-triad", _drawn(_triad), drawn=True),
    Problem("own-forces", _drawn(_forces), drawn=True),
    Problem("own-rocker", _drawn(_rocker_forces), drawn=True),
    Problem("own-train", calculated.planet_and_row, drawn=False),
)
