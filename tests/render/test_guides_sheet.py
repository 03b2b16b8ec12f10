"""Reactions of the guides on the sheet of the forces: at their distance, or at the edges."""

from __future__ import annotations

import re
from functools import cache
from importlib.resources import files

import pytest
from doors import (
    DIMENSION,
    MAX_DISTANCE,
    POINT,
    Disc,
    Drawing,
    DrawingItem as Item,
    Fill,
    ForceReading,
    ModelProblem as Problem,
    PlanKind,
    Severity,
    Solution,
    Stroke,
    View,
    composition,
    drawn_length,
    force_unknowns,
    get_language,
    inner_picture,
    inspect,
    kinematics_sheets,
    statement,
)
from lettered import computed, place_lines
from test_forces_sheet import arrows, couples, shown, turned, views
from worked import path_of

from planmethod import loads

RU = get_language("ru")

LOADS = """
[dynamics]
[[loads]]
link = "{link}"
at = "{at}"
force = 500
angle = 200
[[loads]]
link = "2"
couple = 20
[[loads]]
link = "3"
couple = {couple}
"""


def crosshead(**changes: str) -> Problem:
    """Return the shipped problem in two positions, with other numbers after some keys."""
    text = path_of("levers/crosshead").read_text("utf-8").replace("phi = 150", "phi = [90, 150]")
    for old, new in changes.items():
        text = re.sub(rf"{old} = [\d.]+ ", f"{old} = {new} ", text)
    return loads(text, name="crosshead")


def template(name: str, link: str, at: str, couple: float, length: float | None = None) -> Problem:
    text = (files("planmethod.problem") / "templates" / f"{name}.toml").read_text("utf-8")
    text = text.split("[stamp]")[0] + LOADS.format(link=link, at=at, couple=couple)
    if length is not None:
        text = re.sub(r"(slides = \{[^}\n]*?) \}", rf"\1, length = {length} }}", text)
    return loads(text, name=name)


def task12(length: str) -> Problem:
    text = path_of("levers/task12").read_text("utf-8")
    return loads(text.replace('on = "y-y" }', f'on = "y-y"{length} }}'), name="task12")


@cache
def sheets_of() -> list[Drawing]:
    return kinematics_sheets(crosshead(), layout="forces")


def reading(problem: Problem, index: int = 0) -> ForceReading:
    views_of = composition("forces").views_for("A1", 1)
    return ForceReading(Solution(problem, views=views_of), index)


def marks(sheet: Drawing, view: View) -> list[complex]:
    """Return the marked places of reactions on a view, mm."""
    x0, y0, x1, y1 = view.box
    found = [i.centre for i in sheet.items if isinstance(i, Disc) and i.tag == POINT]
    return [p for p in found if x0 <= p.real <= x1 and y0 <= p.imag <= y1]


def dimension_ends(items: list[Item], letter: str) -> tuple[complex, complex]:
    """Return the ends of the dimension line, which are the tips of its arrowheads, mm."""
    heads = [i for i in items if isinstance(i, Fill) and i.tag == f"{DIMENSION} {letter}"]
    first, second = heads
    return first.points[0], second.points[0]


def shaft(sheet: Drawing, view: View, letter: str) -> Stroke:
    x0, y0, x1, y1 = view.box
    (found,) = (
        item
        for item in sheet.items
        if isinstance(item, Stroke) and item.tag == f"force {letter}"
        if all(x0 <= p.real <= x1 and y0 <= p.imag <= y1 for p in item.points)
    )
    return found


# Drawing -----------------------------------------------------------------------------------------


def test_a_force_is_drawn_at_its_distance_from_the_joint() -> None:
    sheet = sheets_of()[0]
    view = views(sheet, "position")[1]
    at = reading(crosshead())
    contact = next(iter(at.statics.contacts.values()))
    millimetres = float(contact.b()[0]) / view.per_mm
    start, end = dimension_ends(sheet.items, "l_{30}")
    assert end - start == pytest.approx(millimetres, abs=1e-6)  # the guide runs along x
    (place,) = marks(sheet, view)
    assert place.real == pytest.approx(end.real, abs=1e-6)
    drawn = dict(arrows(sheet, view))
    assert turned(drawn["F_{30}"], 1j) < 0.01
    assert shaft(sheet, view, "F_{30}").points[0].real == pytest.approx(place.real, abs=1e-6)
    assert "M_{30}" not in couples(sheet, view)


def test_beyond_the_slider_two_forces_are_drawn_at_its_edges() -> None:
    sheet = sheets_of()[1]
    view = views(sheet, "position")[1]
    drawn = dict(arrows(sheet, view))
    assert "F_{30}" not in drawn
    assert turned(drawn["F^{'}_{30}"], -1j) < 0.01
    assert turned(drawn["F^{''}_{30}"], 1j) < 0.01
    apart = shaft(sheet, view, "F^{'}_{30}").points[0] - shaft(sheet, view, "F^{''}_{30}").points[0]
    assert apart.real * view.per_mm == pytest.approx(0.08, rel=1e-6)
    start, end = dimension_ends(sheet.items, "a_{30}")
    assert (end - start) * view.per_mm == pytest.approx(0.08, rel=1e-6)
    # The force plan keeps the one resultant.
    assert "F_{30}" in dict(arrows(sheet, views(sheet, "forces")[0]))


@pytest.mark.parametrize("index", [0, 1])
def test_the_sheets_have_no_faults(index: int) -> None:
    assert [f for f in inspect(sheets_of()[index]) if f.severity is Severity.ERROR] == []


def test_a_moment_alone_is_a_couple_unless_the_slider_has_a_length() -> None:
    (sheet,) = kinematics_sheets(task12(""), layout="forces")
    view = views(sheet, "position")[1]
    assert couples(sheet, view) == ["M_{50}"]
    assert not any("50" in letter for letter, _ in arrows(sheet, view))
    (sheet,) = kinematics_sheets(task12(", length = 0.12"), layout="forces")
    view = views(sheet, "position")[1]
    assert couples(sheet, view) == []
    drawn = dict(arrows(sheet, view))
    assert turned(drawn["F^{'}_{50}"], -drawn["F^{''}_{50}"]) < 0.01
    assert "M ij , Н·м" in shown(sheet)
    assert "M ij , Н·м" not in shown(sheets_of()[0])


def test_far_away_it_stays_a_force_at_the_joint_and_a_couple() -> None:
    problem = crosshead(length="2.0", across="0.2")
    contact = next(iter(reading(problem).statics.contacts.values()))
    sheet = kinematics_sheets(problem, layout="forces")[0]
    view = views(sheet, "position")[1]
    assert abs(contact.b()[0]) / view.per_mm > MAX_DISTANCE
    assert "M_{30}" in couples(sheet, view)
    assert "F_{30}" in dict(arrows(sheet, view))
    assert marks(sheet, view) == []


def test_sliders_are_to_scale_where_they_look_like_one() -> None:
    solution = Solution(crosshead())
    per_mm = solution.scales[PlanKind.POSITION].per_mm
    assert drawn_length(solution, solution.problem.slides["3"], 1.0) == pytest.approx(0.08 / per_mm)
    for odd in ("1e-4", "9.0"):
        other = Solution(crosshead(length=odd))
        assert drawn_length(other, other.problem.slides["3"], 0.8) == pytest.approx(14.0 * 0.8)


@pytest.mark.parametrize(
    ("problem", "link"),
    [
        (template("sine", "3", "B", -30), "2"),
        (template("sine", "3", "B", -30, 0.05), "2"),
        (template("slotted-link", "3", "D", 10), "2"),
        (template("swinging-block", "3", "C", 15), "2"),
        (template("swinging-block", "3", "C", 15, 0.05), "2"),
    ],
)
def test_an_inner_guide_has_a_picture_of_one_link(problem: Problem, link: str) -> None:
    found = inner_picture(reading(problem), 0, 5.0, RU.notation)
    assert found is not None
    name, picture = found
    assert name == link
    tags = {item.tag for item in picture.items if isinstance(item, Fill)}
    edges = next(iter(problem.slides.values())).length is not None
    letters = ("F^{'}_{23}", "F^{''}_{23}") if edges else ("F_{23}",)
    assert {f"force {letter}" for letter in letters} <= tags
    assert f"{DIMENSION} {'a' if edges else 'l'}_{{23}}" in tags
    assert "couple M_{23}" not in tags
    (sheet,) = kinematics_sheets(problem, layout="forces")
    assert [f for f in inspect(sheet) if f.severity is Severity.ERROR] == []
    assert "Звено 2" in shown(sheet)


def test_a_sliding_block_without_a_moment_needs_no_picture() -> None:
    assert inner_picture(reading(task12("")), 1, 5.0, RU.notation) is None


# Formulas and table -------------------------------------------------------------------------------


PLACE = re.compile(r"^\S+ = [^=]+ = (?P<numbers>[\d,()·/+− ]+) = (?P<value>[\d,]+) (?:Н|м)$")


@pytest.mark.parametrize(
    ("problem", "index", "count"),
    [
        (crosshead(), 0, 1),
        (crosshead(), 1, 3),
        (template("sine", "3", "B", -30, 0.05), 0, 6),
        (template("swinging-block", "3", "C", 15, 0.05), 0, 3),
    ],
)
def test_formulas_of_places_give_their_results(problem: Problem, index: int, count: int) -> None:
    at = reading(problem, index)
    lines = [line for plan in at.plans for line in place_lines(at, plan)]
    matches = [match for line in lines if (match := PLACE.match(line))]
    assert len(matches) == count
    for match in matches:
        value = float(match["value"].replace(",", "."))
        assert computed(match["numbers"]) == pytest.approx(value, rel=5e-3)


def test_formulas_of_the_crosshead() -> None:
    at = reading(crosshead(), 1)
    lines = place_lines(at, at.plans[0])
    assert lines[0].startswith("l_{30} = M_{30}/F_{30} = 12,00/")
    assert lines[1] == "l_{30} > a_{30}/2 = 0,04 м"
    assert lines[2].startswith("F^{'}_{30} = F_{30}·(l_{30} − a_{30}/2)/a_{30} = ")
    assert lines[3].startswith("F^{''}_{30} = F_{30}·(l_{30} + a_{30}/2)/a_{30} = ")
    sizes = [abs(edge.force) for c in at.statics.contacts.values() for edge in c.edges(1)]
    for line, size in zip(lines[2:], sizes, strict=True):
        read = float(line.rpartition(" = ")[2].removesuffix(" Н").replace(",", "."))
        assert read == pytest.approx(size, rel=0.05)
    assert "a_{30} = 0,08 м" in [fact.text for fact in statement(at, RU)]
    assert (
        force_unknowns(at, RU.notation) == "F_{21}, F_{30}, F_{23}, F_{10}, φ_{ij}, l_{30}, M_{ур}"
    )


def test_a_force_through_the_joint_has_no_distance() -> None:
    at = reading(loads(path_of("levers/six-link").read_text("utf-8"), name="six-link"))
    assert place_lines(at, at.plans[0]) == ["l_{42} = l_{56} = 0"]


def test_the_table_has_distances_and_edges() -> None:
    first, second = (shown(sheet) for sheet in sheets_of())
    at = reading(crosshead())
    b = [abs(float(value)) for value in next(iter(at.statics.contacts.values())).b()]
    assert f"{b[0]:.5f}".replace(".", ",") in first
    assert "Реакции на краях ползунов" not in first
    assert f"{b[1]:.5f}".replace(".", ",") in second
    assert "Реакции на краях ползунов" in second
    for edge in next(iter(at.statics.contacts.values())).edges(1):
        assert f"{abs(edge.force):.4g}".replace(".", ",") in second
