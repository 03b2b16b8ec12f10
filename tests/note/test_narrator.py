"""The one narrator, through a kind of problem of this test's own with a handful of names."""

from __future__ import annotations

import pytest
from doors import (
    WORDING_LANGUAGES as LANGUAGES,
    BoardNarrator,
    Builder,
    LineName,
    LineSense,
    NumberName,
    PointName,
    Side,
    StepNarrator,
    get_language,
    steps,
)

NUMBERS = {"r": 30.0, "s": -40.0, "turned": -1.0, "read AC": 25.04}
COURSES = {"ray": 3.0 + 1.0j, "post": -0.5 - 2.0j}


class Letters:
    """Names of points and lines as given; numbers read are 0.04 mm off the exact ones."""

    def point(self, name: PointName) -> str:
        return f"{name}_{{1}}"

    def of(self, name: PointName) -> str:
        return f"of {name}"

    def segment(self, tail: PointName, head: PointName) -> str:
        return f"{tail}{head}"

    def line(self, name: LineName) -> str:
        return f"<{name}>"

    def direction_vector(self, name: LineName) -> complex:
        return COURSES[name]

    def length(self, name: NumberName) -> str:
        return f"{abs(self.number(name)):g} mm"

    def number(self, name: NumberName) -> float:
        return NUMBERS[name]

    def exact_value(self, name: NumberName) -> float:
        return NUMBERS[name] - 0.04


class Marking(BoardNarrator):
    """A narrator with its own sentence for given points."""

    def describe_given_point(self, step: steps.GivenPoint) -> list[str]:
        return [f"mark {self.naming.point(step.out)}"]


@pytest.fixture
def narrator() -> BoardNarrator:
    return Marking(Letters(), get_language("en").note)


def arc(way: LineSense, line: str = "ray", branch: str | None = None) -> steps.IntersectLineCircle:
    turned = None if branch is None else NumberName(branch)
    names = PointName("C"), LineName(line), PointName("A"), NumberName("r")
    return steps.IntersectLineCircle(*names, way, turned)


def test_a_narrators_own_sentence_outranks_silence(narrator: BoardNarrator) -> None:
    assert narrator.narrate(steps.GivenPoint(PointName("A"))) == ["mark A_{1}"]
    assert narrator.narrate(steps.GivenNumber(NumberName("r"))) == []


def test_an_intersection_names_both_lines_and_the_point(narrator: BoardNarrator) -> None:
    step = steps.IntersectLines(PointName("C"), LineName("ray"), LineName("post"))
    assert narrator.narrate(step) == ["Where <ray> meets <post> we get point C_{1}."]


@pytest.mark.parametrize(
    ("step", "key"),
    [
        (arc(LineSense.FORWARD), "rightmost"),
        (arc(LineSense.BACKWARD), "leftmost"),
        (arc(LineSense.FORWARD, branch="turned"), "leftmost"),
        (arc(LineSense.FORWARD, "post"), "lower"),
        (arc(LineSense.BACKWARD, "post"), "upper"),
    ],
)
def test_an_arc_names_the_chosen_intersection(step: steps.Step, key: str) -> None:
    for lang in LANGUAGES:
        words = get_language(lang).note
        ways = {name: getattr(words, name) for name in ("rightmost", "leftmost", "upper", "lower")}
        (told,) = Marking(Letters(), words).narrate(step)
        assert [name for name, word in ways.items() if word in told] == [key], told
        assert "30 mm" in told


@pytest.mark.parametrize("branch", [None, NumberName("turned")])
@pytest.mark.parametrize("side", list(Side))
def test_two_arcs_name_the_side_of_the_line_of_centres(
    narrator: BoardNarrator, side: Side, branch: NumberName | None
) -> None:
    ends = PointName("A"), NumberName("r"), PointName("B"), NumberName("s")
    (told,) = narrator.narrate(steps.IntersectCircles(PointName("C"), *ends, side, branch))
    is_left = (side is Side.LEFT) == (branch is None)
    assert ("on the left" in told, "on the right" in told) == (is_left, not is_left)
    assert "A_{1} with the radius 30 mm" in told
    assert "B_{1} with the radius 40 mm" in told


def test_a_reading_has_the_value_read_and_the_exact_one(narrator: BoardNarrator) -> None:
    (told,) = narrator.narrate(steps.Measure(NumberName("read AC"), PointName("A"), PointName("C")))
    assert told == "We measure the segment AC = 25.04 mm (exactly 25.00 mm)."


def test_a_kind_without_sentences_is_silent_about_every_step() -> None:
    builder = Builder()
    one, other = builder.take_point("A"), builder.take_point("B")
    base = builder.join(one, other)
    radius = builder.measure("r", one, other)
    builder.intersect_circles("C", one, radius, other, radius, Side.LEFT)
    builder.intersect_lines("D", base, builder.perpendicular(other, base))
    narrator = StepNarrator()
    assert [narrator.narrate(step) for step in builder.steps] == [[]] * len(builder.steps)
