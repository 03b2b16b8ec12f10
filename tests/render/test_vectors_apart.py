"""Vectors of plans: those on one line are beside one another, and a name is at its own vector."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import pytest
from cases import each
from doors import (
    NAMING,
    Drawing,
    ModelLabel,
    Pen,
    PlanKind,
    Solution,
    Span,
    Stroke,
    Text,
    View,
    get_language,
    misleading,
    paper,
    place_labels,
    plan_places,
    shifts_apart,
    typeset,
    writings_of,
)
from shapely import LineString, Point, box
from worked import SIX, drawn_sheets, problem_of

from benchmarks.sheets import positions_of

BY_ENDS = get_language("ru").sheets.by_ends.partition(":")[0]
NOTE = get_language("ru").sheets.apart
ON_ONE_LINE = ("linkages/2.1.48", "linkages/2.1.65", "linkages/2.1.134")


def drawn(name: str) -> Drawing:
    (sheet,) = drawn_sheets(name)
    return sheet


def written(sheet: Drawing) -> str:
    return " ".join(item.text for item in sheet.items if isinstance(item, Text))


def hidden(one: Span, two: Span) -> float:
    """Return the length of the part of the shorter segment that lies on the other one, mm."""
    short, long = sorted((one, two), key=lambda span: abs(span.end - span.start))
    way = (long.end - long.start) / abs(long.end - long.start)
    places = [short.start + (short.end - short.start) * k / 100 for k in range(101)]
    seen = [(place - long.start) / way for place in places]
    inside = [0 <= at.real <= abs(long.end - long.start) and abs(at.imag) < 0.3 for at in seen]
    return sum(inside) / 101 * abs(short.end - short.start)


@each("name", ON_ONE_LINE)
def test_no_vector_of_a_plan_hides_another_one(name: str) -> None:
    sheet = drawn(name)
    for view in sheet.views:
        for one, two in combinations([s for s in view.spans if abs(s.end - s.start) > 1.0], 2):
            assert hidden(one, two) < 1.0, (one.name, two.name)
    assert NOTE.partition(" ")[0] in written(sheet)


@each("name", ON_ONE_LINE)
def test_a_displaced_vector_is_true_and_the_pole_is_in_its_place(name: str) -> None:
    solution, sheet = Solution(problem_of(name)), drawn(name)
    for view in sheet.views[1:]:
        kind = PlanKind(view.kind)
        plan = solution.construction.plan(kind)
        at = plan_places(solution, kind, 0, use_ruler=True)
        sizes = [at[v.head] - at[v.tail] for v in plan.vectors]
        assert len(view.spans) >= 2
        for span in view.spans:
            assert min(abs(span.end - span.start - size) for size in sizes) < 1e-6, span.name
            assert any(
                isinstance(item, Stroke) and abs(item.points[0] - span.start) < 1e-6
                for item in sheet.items
            )


def test_a_plan_without_vectors_on_one_line_says_nothing_of_them() -> None:
    assert NOTE.partition(",")[0] not in written(drawn("linkages/ex1"))


def test_the_first_of_vectors_on_one_line_keeps_its_place() -> None:
    line = [(0j, 40 + 0j), (0j, 20 + 0j), (30 + 0j, 5 + 0j), (0j, 20j)]
    first, second, third, across = shifts_apart(line)
    assert first == across == 0j
    assert {second, third} == {1.8j, -1.8j}


@pytest.mark.parametrize("end", [1.0, 40j, 40 + 40j, -40 + 0j])
def test_vectors_that_only_meet_stay(end: complex) -> None:
    """A short one that starts across another is not hidden by it."""
    assert shifts_apart([(0j, 40 + 0j), (0j, end * 1j if end == 1.0 else end)]) == [0j, 0j]


# Names of vectors ---------------------------------------------------------------------------------


def named_vectors(sheet: Drawing) -> Iterator[tuple[Span, float, float, bool]]:
    """Yield named vectors, the distances of a name from its own and another one, and if it is led.

    Distances are those of the box around the ink, mm.
    """
    writings = {writing.name: writing for writing in writings_of(sheet.items)}
    led = {item.tag for item in sheet.items if isinstance(item, Stroke)}
    for view in sheet.views:
        for position in {span.position for span in view.spans}:
            spans = [span for span in view.spans if span.position == position]
            lines = [LineString([(z.real, z.imag) for z in (s.start, s.end)]) for s in spans]
            for k, span in enumerate(spans):
                if span.label and span.label in writings:
                    around = box(*writings[span.label].ink.bounds)
                    far = [line.distance(around) for line in lines]
                    others = [*far[:k], *far[k + 1 :], 1e9]
                    yield span, far[k], min(others), f"leader of {span.label}" in led


@each("name", [*SIX, "linkages/2.1.45", "levers/task-13"])
def test_the_name_of_a_vector_is_nearest_to_its_own(name: str) -> None:
    """At one distance beside it; on many plans no name has a leader line."""
    for positions in (None, positions_of(problem_of(name), 12)):
        (sheet, *_) = drawn_sheets(name, positions)
        found = list(named_vectors(sheet))
        assert found or positions
        for span, own, other, led in found:
            assert led <= (positions is None)
            assert own < other or led, span.label
            assert 0.7 < own < 2.0 or led, span.label


@each("name", [*SIX, "levers/task-13"])
def test_all_vectors_of_a_series_of_plans_have_names_or_none_and_the_sheet_says_so(
    name: str,
) -> None:
    sheets = drawn_sheets(name, positions_of(problem_of(name), 12))
    explained = " ".join(map(written, sheets)).count(BY_ENDS)
    unnamed = 0
    for view in (view for sheet in sheets for view in sheet.views if view.kind != "position"):
        spans = [span for span in view.spans if span.label and span.length > 3.0]
        names = {item.label for sheet in sheets for item in sheet.items if isinstance(item, Text)}
        assert len({span.label in names for span in spans}) <= 1
        unnamed += any(span.label not in names for span in spans)
    assert explained == unnamed


@each("name", [*SIX, "levers/task-13"])
def test_the_note_names_each_component_that_is_drawn_and_no_other(name: str) -> None:
    positions = positions_of(problem_of(name), 12)
    solution, words = Solution(problem_of(name), positions=positions), get_language("ru").sheets
    sheets = drawn_sheets(name, positions)
    told = " ".join(map(written, sheets)).replace("\u00a0", " ")
    notes = [note.partition(words.without_arrow)[0] for note in told.split(BY_ENDS)[1:]]
    for view in (view for sheet in sheets for view in sheet.views if view.kind != "position"):
        drawn = {item.label for sheet in sheets for item in sheet.items if isinstance(item, Text)}
        spans = [span for span in view.spans if span.label and span.length > 3.0]
        if not spans or spans[0].label in drawn:
            continue
        kinds = {
            v.symbol: v.kind.value for v in solution.construction.plan(PlanKind(view.kind)).vectors
        }
        names = words["components"][view.kind]
        seen = {names[kinds[span.label.partition(": ")[2]]] for span in spans}
        note = notes.pop(0).partition("0: ")[0]
        assert {one for one in names.values() if f", {one}" in note} == seen


def test_many_or_short_vectors_on_one_line_stay_on_it() -> None:
    """They would become a brush; the sides of a force polygon are drawn apart all the same."""
    many = [(0j, 40.0 + 5.0 * k + 0j) for k in range(4)]
    assert shifts_apart(many) == [0j] * 4
    assert shifts_apart([(0j, 14 + 0j), (0j, 12 + 0j)]) == [0j, 0j]
    assert len(set(shifts_apart(many, always=True))) == 4


def test_no_leader_line_is_as_short_as_a_sign() -> None:
    for name in SIX:
        for positions in (None, positions_of(problem_of(name), 12)):
            for sheet in drawn_sheets(name, positions):
                leaders = [
                    abs(item.points[-1] - item.points[0])
                    for item in sheet.items
                    if isinstance(item, Stroke) and item.tag.startswith("leader of ")
                ]
                assert min(leaders, default=9.0) > 4.0


def test_a_name_at_another_vector_is_marked() -> None:
    """The same name beside its own vector is not, and neither is one with a leader line."""
    spans = [
        Span("pb", None, 100 + 100j, 160 + 100j, label="velocity 0: v_{B}"),
        Span("pc", None, 100 + 100j, 160 + 130j, label="velocity 0: v_{C}"),
    ]
    view = View("velocity", (90.0, 90.0, 180.0, 150.0), spans=tuple(spans))

    def codes(at: complex, *leader: complex) -> list[str]:
        items: list[Text | Stroke] = [Text(at, "v", 3.5, label="velocity 0: v_{B}")]
        if leader:
            items.append(Stroke(leader, Pen.THIN, tag="leader of velocity 0: v_{B}"))
        return [one.code for one in misleading(items, writings_of(items), [view])]

    assert codes(150 + 95j) == []
    assert codes(150 + 119j) == ["PM-D14"]
    assert codes(150 + 140j, 150 + 139j, 150 + 101j) == ["PM-D14"]
    assert codes(150 + 85j, 150 + 89j, 150 + 99j) == []
    assert codes(150 + 95j, 150 + 97j, 150 + 99j) == ["PM-D14"]


def test_a_leader_line_ends_at_its_own_vector_alone() -> None:
    """Where two vectors are side by side, the line could lead to either."""
    name = "velocity 0: v_{B}"
    spans = (
        Span("pb", None, 100 + 100j, 160 + 100j, label=name),
        Span("pc", None, 100 + 100j, 160 + 106j, label="velocity 0: v_{C}"),
    )
    view = View("velocity", (90.0, 80.0, 180.0, 150.0), spans=spans)

    def codes(*leader: complex) -> list[str]:
        line = Stroke(leader, Pen.THIN, tag=f"leader of {name}")
        items = (Text(leader[1] - 4j, "v", 3.5, label=name), line)
        return [one.code for one in misleading(items, writings_of(items), [view])]

    assert codes(150 + 99.9j, 140 + 90j) == []
    assert codes(102 + 99.9j, 96 + 90j) == ["PM-D14"]


def test_names_are_led_to_where_their_vectors_are_alone() -> None:
    bundle = [(0j, 60 + 2j * k) for k in range(4)]
    names = [
        ModelLabel(
            typeset(f"v_{k}", 3.5), sum(ends) / 2, ends, gap=1.2, style=NAMING, optional=True
        )
        for k, ends in enumerate(bundle)
    ]
    drawn = [Stroke(ends, Pen.RESULTANT) for ends in bundle]
    placed = place_labels(names, drawn, (-40.0, -40.0, 100.0, 50.0))
    led = [one for one in placed if one.leader is not None]
    assert led
    for one in led:
        assert one.leader is not None
        start = Point(one.leader[0].real, one.leader[0].imag)
        for ends in bundle:
            off = LineString([(end.real, end.imag) for end in ends]).distance(start)
            assert off < 0.2 if ends == one.label.segment else off >= paper.AT_LEADER
