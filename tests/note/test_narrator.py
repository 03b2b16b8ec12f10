"""The one narrator, through a kind of problem of this test's own with a handful of names."""

from __future__ import annotations

import pytest

from planmethod.construct import steps
from planmethod.construct.program import Builder
from planmethod.construct.steps import LineName, NumberName, PointName, Side, Way
from planmethod.note.narrate.narrator import BoardNarrator, StepNarrator
from planmethod.note.wording import LANGUAGES, language

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

    def course(self, name: LineName) -> complex:
        return COURSES[name]

    def length(self, name: NumberName) -> str:
        return f"{abs(self.number(name)):g} mm"

    def number(self, name: NumberName) -> float:
        return NUMBERS[name]

    def exact(self, name: NumberName) -> float:
        return NUMBERS[name] - 0.04


class Marking(BoardNarrator):
    """A narrator with its own sentence for given points."""

    def given(self, step: steps.Given) -> list[str]:
        return [f"mark {self.naming.point(step.out)}"]


@pytest.fixture
def narrator() -> BoardNarrator:
    return Marking(Letters(), language("en").note)


def arc(way: Way, line: str = "ray", branch: str | None = None) -> steps.MeetLineCircle:
    turned = None if branch is None else NumberName(branch)
    names = PointName("C"), LineName(line), PointName("A"), NumberName("r")
    return steps.MeetLineCircle(*names, way, turned)


def test_a_narrators_own_sentence_outranks_silence(narrator: BoardNarrator) -> None:
    assert narrator.tell(steps.Given(PointName("A"))) == ["mark A_{1}"]
    assert narrator.tell(steps.GivenNumber(NumberName("r"))) == []


def test_an_intersection_names_both_lines_and_the_point(narrator: BoardNarrator) -> None:
    step = steps.MeetLines(PointName("C"), LineName("ray"), LineName("post"))
    assert narrator.tell(step) == ["Where <ray> meets <post> we get point C_{1}."]


@pytest.mark.parametrize(
    ("step", "key"),
    [
        (arc(Way.FORWARD), "rightmost"),
        (arc(Way.BACKWARD), "leftmost"),
        (arc(Way.FORWARD, branch="turned"), "leftmost"),
        (arc(Way.FORWARD, "post"), "lower"),
        (arc(Way.BACKWARD, "post"), "upper"),
    ],
)
def test_an_arc_names_the_chosen_intersection(step: steps.Step, key: str) -> None:
    for lang in LANGUAGES:
        words = language(lang).note
        ways = {name: getattr(words, name) for name in ("rightmost", "leftmost", "upper", "lower")}
        (told,) = Marking(Letters(), words).tell(step)
        assert [name for name, word in ways.items() if word in told] == [key], told
        assert "30 mm" in told


@pytest.mark.parametrize("branch", [None, NumberName("turned")])
@pytest.mark.parametrize("side", list(Side))
def test_two_arcs_name_the_side_of_the_line_of_centres(
    narrator: BoardNarrator, side: Side, branch: NumberName | None
) -> None:
    ends = PointName("A"), NumberName("r"), PointName("B"), NumberName("s")
    (told,) = narrator.tell(steps.MeetCircles(PointName("C"), *ends, side, branch))
    is_left = (side is Side.LEFT) == (branch is None)
    assert ("on the left" in told, "on the right" in told) == (is_left, not is_left)
    assert "A_{1} with the radius 30 mm" in told
    assert "B_{1} with the radius 40 mm" in told


def test_a_reading_has_the_value_read_and_the_exact_one(narrator: BoardNarrator) -> None:
    (told,) = narrator.tell(steps.Measure(NumberName("read AC"), PointName("A"), PointName("C")))
    assert told == "We measure the segment AC = 25.04 mm (exactly 25.00 mm)."


def test_a_kind_without_sentences_is_silent_about_every_step() -> None:
    builder = Builder()
    one, other = builder.given("A"), builder.given("B")
    base = builder.join(one, other)
    radius = builder.measure("r", one, other)
    builder.meet_circles("C", one, radius, other, radius, Side.LEFT)
    builder.meet_lines("D", base, builder.perpendicular(other, base))
    narrator = StepNarrator()
    assert [narrator.tell(step) for step in builder.steps] == [[]] * len(builder.steps)
