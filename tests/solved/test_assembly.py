"""Choice of the assembly, and the messages if there is none."""

from __future__ import annotations

import re

import numpy as np
import pytest
from doors import (
    AssemblyError,
    AssemblyRelation,
    ExitCode,
    ModelProblem as Problem,
    ProblemError,
    Rule,
    Solution,
    StructureError,
    problem_loads as loads,
)
from msgspec.structs import replace
from worked import problem_of

FOUR_BAR = """
title = "Четырёхзвенник"
[frame]
A = [0.0, 0.0]
D = [0.4, 0.0]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = {bc}
[links.3]
points = ["D", "C"]
DC = {dc}
[driver]
link = "1"
phi = {phi}
omega = 10
[assembly]
{rule}
"""

SLIDER_CRANK = """
title = "Кривошипно-ползунный механизм"
[frame]
A = [0.0, 0.0]
guides.x-x = {{ through = [0.0, {above}], angle = 0 }}
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.3
[links.3]
points = ["C"]
slides = {{ on = "x-x" }}
[driver]
link = "1"
phi = {phi}
omega = 10
[assembly]
{rule}
"""

SLOTTED = """
title = "Кулиса"
[frame]
A = [0.0, 0.0]
C = [0.0, -{down}]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "E"]
slides = {{ on = "3", along = "CD", offset = {offset} }}
E = {{ from = "B", at = 0.05 }}
[links.3]
points = ["C", "D"]
CD = 0.5
[driver]
link = "1"
phi = {phi}
omega = 10
[assembly]
{rule}
"""


def four_bar(rule: str, *, bc: float = 0.3, dc: float = 0.3, phi: object = 60) -> Problem:
    return loads(FOUR_BAR.format(rule=rule, bc=bc, dc=dc, phi=phi), name="four-bar")


def slider_crank(rule: str, *, above: float = 0.0, phi: object = 60) -> Problem:
    return loads(SLIDER_CRANK.format(rule=rule, above=above, phi=phi), name="slider-crank")


def slotted(rule: str = "", *, down: float = 0.3, offset: float = 0.0, phi: object = 20) -> Problem:
    text = SLOTTED.format(rule=rule, down=down, offset=offset, phi=phi)
    return loads(text, name="slotted")


def place(problem: Problem, point: str) -> complex:
    return complex(Solution(problem).points[point].place[0])


def refused(problem: Problem, positions: list[float] | None = None) -> str:
    """Return the message of a mechanism that cannot be assembled."""
    with pytest.raises(AssemblyError) as error:
        _ = Solution(problem, positions=positions).si
    assert error.value.exit_code is ExitCode.ASSEMBLY
    return str(error.value)


def faulty(problem: Problem) -> list[str]:
    """Return the faults of a problem whose rules do not do."""
    with pytest.raises(ProblemError) as error:
        Solution(problem)
    assert error.value.exit_code is ExitCode.PROBLEM
    return [str(fault) for fault in error.value.faults]


# Rules --------------------------------------------------------------------------------------------

UPPER, LOWER = 0.2826 + 0.2761j, 0.1674 - 0.1895j


@pytest.mark.parametrize(
    ("rule", "wanted"),
    [
        ("above D", UPPER),
        ("below D", LOWER),
        ("left of AD", UPPER),
        ("right of AD", LOWER),
        ("left of BD", UPPER),
        ("right of BD", LOWER),
        ("right of DB", UPPER),
        ("above A", UPPER),
    ],
)
def test_a_rule_in_words_chooses_an_assembly(rule: str, wanted: complex) -> None:
    assert place(four_bar(f'C = "{rule}"'), "C") == pytest.approx(wanted, abs=1e-4)


@pytest.mark.parametrize(
    ("near", "wanted"),
    [("[0.3, 0.2]", UPPER), ("[0.3, -0.2]", LOWER), ("[50, -60]", LOWER), ("[0.28, 0.28]", UPPER)],
)
def test_the_nearer_assembly_is_taken(near: str, wanted: complex) -> None:
    assert place(four_bar(f"C = {{ near = {near} }}"), "C") == pytest.approx(wanted, abs=1e-4)


def test_a_missing_rule_is_requested_with_both_places() -> None:
    (fault,) = faulty(four_bar(""))
    assert fault == (
        "assembly.C: links 2, 3 can be assembled in two ways, with C at (0.2826, 0.2761) or "
        'at (0.1674, -0.1895) m, and no rule selects one. Add C = "above A" for the first '
        'or "below A" for the second to [assembly]'
    )
    (fault,) = faulty(slider_crank(""))
    assert fault.startswith(
        "assembly.C: links 2, 3 can be assembled in two ways, with C at (0.3372, 0) or at "
        "(-0.2372, 0) m,"
    )


def test_missing_rules_of_all_groups_are_reported_at_once() -> None:
    problem = replace(problem_of("levers/six-link"), assembly=())
    (fault,) = faulty(problem)
    assert fault.startswith("assembly.C: links 2, 3 can be assembled in two ways")
    assert len(faulty(replace(problem_of("linkages/ex3"), assembly=()))) == 1
    rules = (Rule("A", AssemblyRelation.ABOVE, ("B",)), Rule("B", AssemblyRelation.LEFT, ("C",)))
    faults = faulty(replace(problem_of("linkages/ex1"), assembly=rules))
    assert [fault.partition(":")[0] for fault in faults] == [
        "assembly.C",
        "assembly.A",
        "assembly.B",
    ]


def test_a_rule_that_does_not_distinguish() -> None:
    """The slider's two places are at one height."""
    (fault,) = faulty(slider_crank('C = "above B"'))
    assert fault == (
        "assembly.C: 'C above B' does not distinguish the two assemblies at phi = 60 deg: both "
        "give -0.0866 m. Compare with another point or with a directed line"
    )
    # As far from the one as from the other: between them.
    (fault,) = faulty(slider_crank("C = { near = [0.05, 7.0] }", phi=60))
    assert fault.startswith(
        "assembly.C: 'C near [0.05, 7]' does not distinguish the two assemblies at phi = 60 deg:"
    )


def test_a_rule_about_a_line_is_reported_as_it_was_written() -> None:
    message = refused(far())
    assert message.startswith("'C left of FG' holds for neither assembly at phi = 60 deg:")


def far() -> Problem:
    """Four-bar with a rule about a line of the frame far to the left of the mechanism."""
    text = FOUR_BAR.format(rule='C = "left of FG"', bc=0.3, dc=0.3, phi=60)
    text = text.replace("D = [0.4, 0.0]", "D = [0.4, 0.0]\nF = [-9.0, -1.0]\nG = [-9.0, 1.0]")
    return loads(text, name="far")


def test_a_rule_that_holds_for_neither_assembly() -> None:
    message = refused(four_bar('C = "right of D"'))
    assert message == (
        "'C right of D' holds for neither assembly at phi = 60 deg: they miss it by 0.1174 m and "
        "0.2326 m. Check the lengths or the rule assembly.C."
    )


@pytest.mark.parametrize(("point", "other"), [("A", "B"), ("B", "A"), ("D", "B")])
def test_points_of_the_frame_and_the_driver_have_one_place(point: str, other: str) -> None:
    rules = (
        Rule("C", AssemblyRelation.ABOVE, ("D",)),
        Rule(point, AssemblyRelation.ABOVE, (other,)),
    )
    (fault,) = faulty(replace(four_bar('C = "above D"'), assembly=rules))
    assert fault == (
        f"assembly.{point}: {point} belongs to the frame or to the driving link: it has one place. "
        "Delete the rule, or name a point that a group places"
    )


def test_a_rule_of_the_first_position_holds_for_all() -> None:
    """At phi = 250 the upper assembly is to the left of G, the lower one is not; the side stays."""
    text = FOUR_BAR.replace("D = [0.4, 0.0]", "D = [0.4, 0.0]\nG = [0.2, 0.0]")
    given = {"rule": 'C = "right of G"', "bc": 0.3, "dc": 0.3}
    several = Solution(loads(text.format(**given, phi=[60, 170, 250]), name="four-bar"))
    assert (several.points["C"].place.imag > 0).all()
    assert several.points["C"].place[2].real < 0.2
    asked = Solution(loads(text.format(**given, phi=60), name="four-bar"), positions=[250.0])
    assert asked.points["C"].place[0] == several.points["C"].place[2]


@pytest.mark.parametrize(
    ("rule", "first", "second"),
    [
        ("left of D", "above A", "below A"),
        ("right of A", "above A", "below A"),
        ("right of B", "above A", "below A"),
    ],
)
def test_a_rule_that_both_assemblies_satisfy_is_rejected_with_one_that_distinguishes(
    rule: str, first: str, second: str
) -> None:
    assert faulty(four_bar(f'C = "{rule}"')) == [
        f"assembly.C: 'C {rule}' holds for both assemblies at phi = 60 deg: with C at "
        f"(0.2826, 0.2761) and at (0.1674, -0.1895) m. "
        f"Give '{first}' for the first or '{second}' for the second"
    ]
    assert place(four_bar(f'C = "{first}"'), "C") == pytest.approx(UPPER, abs=1e-4)
    assert place(four_bar(f'C = "{second}"'), "C") == pytest.approx(LOWER, abs=1e-4)


def test_without_a_point_between_two_assemblies_a_line_or_a_place_distinguishes_them() -> None:
    """Both assemblies are right of and above every fixed point and B: a line separates them."""
    text = FOUR_BAR.replace("D = [0.4, 0.0]", "D = [-0.1, -0.06]")
    problem = loads(text.format(rule='C = "right of A"', bc=0.1, dc=0.31, phi=30), name="four-bar")
    (said,) = faulty(problem)
    told = re.search(r"Give '(.*)' for the first or '(.*)' for the second", said)
    assert told is not None
    for rule, place_of_it in zip(told.groups(), re.findall(r"\((\S+), (\S+)\)", said), strict=True):
        x, y = map(float, place_of_it)
        chosen = loads(text.format(rule=f'C = "{rule}"', bc=0.1, dc=0.31, phi=30), name="four-bar")
        assert place(chosen, "C") == pytest.approx(complex(x, y), abs=1e-4)


def test_the_first_position_that_closes_decides() -> None:
    """With a rocker of 0.12 m only a part of the turn is possible; 180 is not."""
    problem = four_bar('C = "above D"', bc=0.25, dc=0.12, phi=[180, 20])
    draft = Solution(problem, positions=[20.0])
    assert draft.points["C"].place[0].imag > 0


# Slotted links ------------------------------------------------------------------------------------


def test_a_slotted_link_points_at_its_slider_by_default() -> None:
    solution = Solution(slotted())
    b, c, d = (complex(solution.points[p].place[0]) for p in "BCD")
    assert ((d - c) / (b - c)).imag == pytest.approx(0.0, abs=1e-12)
    assert ((d - c) / (b - c)).real > 0
    for phi in (0.0, 90.0, 180.0, 270.0):
        turned = Solution(slotted(), positions=[phi])
        b, c, d = (complex(turned.points[p].place[0]) for p in "BCD")
        assert ((d - c) / (b - c)).real > 0


def test_a_rule_turns_a_slotted_link_away() -> None:
    solution = Solution(slotted('D = "below C"'))
    b, c, d = (complex(solution.points[p].place[0]) for p in "BCD")
    assert ((d - c) / (b - c)).real < 0
    away = Solution(problem_of("levers/task12"))
    b, c, d = (complex(away.points[p].place[0]) for p in "BCD")
    assert ((d - c) / (b - c)).real < 0


def test_a_rule_may_be_about_a_point_of_the_slider() -> None:
    up, down = slotted('E = "above B"'), slotted('E = "below B"')
    assert place(up, "D").imag > -0.3 > place(down, "D").imag


@pytest.mark.parametrize("offset", [0.05, -0.05])
def test_an_offset_pin_is_on_its_side_of_the_line(offset: float) -> None:
    for rule in ('D = "above C"', 'D = "below C"'):
        solution = Solution(slotted(rule, offset=offset))
        b, c, d = (complex(solution.points[p].place[0]) for p in "BCD")
        u = (d - c) / abs(d - c)
        assert (u.conjugate() * (b - c)).imag == pytest.approx(offset, abs=1e-14)
        assert (d.imag > c.imag) == ("above" in rule)


# Impossible positions -----------------------------------------------------------------------------


def test_arcs_that_do_not_meet() -> None:
    message = refused(four_bar('C = "above A"', dc=0.05))
    assert message == (
        "Cannot place C at phi = 60 deg: arcs from B (0.3 m) and D (0.05 m) do not meet, "
        "|BD| = 0.3606 m. Check l_BC, l_DC. The arcs miss by 0.01056 m, by 0.15 m at most "
        "over a turn (at phi = 180 deg)."
    )


def test_the_first_impossible_position_is_named_and_the_others_counted() -> None:
    problem = four_bar('C = "above D"', bc=0.25, dc=0.12)
    positions = [60.0, 170.0, 180.0, 190.0]
    message = refused(problem, positions)
    assert re.match(
        r"Cannot place C at position 1 \(phi = 170 deg\): arcs from B \(0\.25 m\) and D "
        r"\(0\.12 m\) do not meet, \|BD\| = 0\.49\d\d m\. Check l_BC, l_DC\.",
        message,
    )
    assert message.endswith(" The same holds at 2 more of 4 positions.")
    assert "more of" not in refused(problem, positions[:2])


def test_an_arc_that_does_not_reach_the_guide() -> None:
    message = refused(slider_crank('C = "right of B"', above=0.5))
    assert message == (
        "Cannot place C at phi = 60 deg: the arc from B (0.3 m) does not reach the guide of "
        "C. Check l_BC and the place of the guide. It misses by 0.1134 m, by 0.3 m at most "
        "over a turn (at phi = 270 deg)."
    )


def test_a_slotted_link_with_too_large_an_offset() -> None:
    problem = slotted('D = "above C"', offset=0.25, phi=90)
    message = refused(problem, [270.0])
    assert message.startswith("Cannot turn the slotted link about C at phi = 270 deg:")
    assert "0.25 m" in message
    assert "0.2 m away" in message


def test_parallel_guides() -> None:
    """One guide turns with the crank, the other is fixed."""
    text = """
        title = "Тангенсный механизм"
        [frame]
        A = [0.0, 0.0]
        guides.x-x = { through = [0.0, 0.2], angle = 0 }
        [links.1]
        points = ["A", "B"]
        AB = 0.1
        [links.2]
        points = ["C"]
        slides = { on = "1", along = "AB" }
        [links.3]
        points = ["C"]
        slides = { on = "x-x" }
        [driver]
        link = "1"
        phi = 60
        omega = 10
    """
    problem = loads(text, name="tangent")
    assert place(problem, "C") == pytest.approx(0.2 / np.tan(np.pi / 3) + 0.2j)
    message = refused(problem, [180.0])
    assert message == (
        "Cannot place C at phi = 180 deg: its two guides are parallel. Choose another "
        "position, or check their angles."
    )


def test_a_dead_position_is_reported_with_its_reason() -> None:
    """BC = 4, DC = 1: at phi = 0, |BD| = 3, the links 2 and 3 lie on one line."""
    exact = FOUR_BAR.replace("0.4", "4.0").replace("AB = 0.1", "AB = 1.0")
    problem = loads(exact.format(rule='C = "above D"', bc=4.0, dc=1.0, phi=60), name="dead")
    message = refused(problem, [60.0, 0.0])
    assert message == (
        "Cannot close the velocity plan at position 1 (phi = 0 deg): the rays that meet in "
        "c are parallel, because the mechanism is in a dead position, where the driver does "
        "not determine the velocities. Choose another position."
    )


def test_the_margin_falls_towards_a_dead_position() -> None:
    exact = FOUR_BAR.replace("0.4", "4.0").replace("AB = 0.1", "AB = 1.0")
    problem = loads(exact.format(rule='C = "above D"', bc=4.0, dc=1.0, phi=60), name="dead")
    margin = Solution(problem, positions=[60.0, 30.0, 10.0, 1.0, 0.1]).margin
    assert (np.diff(margin) < 0).all()
    assert 0 < margin[-1] < 1e-4


def test_a_driving_slider_names_its_position_in_metres() -> None:
    text = """
        title = "Ведущий ползун"
        [frame]
        A = [0.0, 0.0]
        guides.x-x = { through = "A", angle = 0 }
        [links.1]
        points = ["C"]
        slides = { on = "x-x" }
        [links.2]
        points = ["C", "B"]
        CB = 0.3
        [links.3]
        points = ["A", "B"]
        AB = 0.1
        [driver]
        link = "1"
        s = 0.35
        v = 1.0
        [assembly]
        B = "above A"
    """
    problem = loads(text, name="slider")
    assert place(problem, "B").imag > 0
    message = refused(problem, [0.35, 0.45])
    assert message.startswith("Cannot place B at position 1 (s = 0.45 m): arcs from ")


# Structure ----------------------------------------------------------------------------------------

THIRD_CLASS = """
title = "Группа III класса"
[frame]
A = [0.0, 0.0]
D = [0.8, 0.5]
E = [0.9, -0.3]
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "P"]
BP = 0.3
[links.3]
points = ["P", "Q", "R"]
PQ = 0.2
PR = 0.2
QR = 0.2
R.side = "right of PQ"
[links.4]
points = ["D", "Q"]
DQ = 0.4
[links.5]
points = ["E", "R"]
ER = 0.4
[driver]
link = "1"
phi = 60
omega = 10
[assembly]
P = "right of B"
"""


def test_the_same_links_with_another_driver_fall_into_dyads() -> None:
    """Driven at link 4, the chain is two dyads (links 1 and 2 close last)."""
    text = (
        THIRD_CLASS.replace('link = "1"', 'link = "4"')
        .replace("phi = 60", "phi = 250")
        .replace("BP = 0.3", "BP = 0.5")
    )
    text = text.replace('P = "right of B"', 'R = "left of Q"\nB = "above A"')
    solution = Solution(loads(text, name="third"))
    assert [g.signature for g in solution.structure.groups] == ["RRR", "RRR"]
    assert solution.structure.class_number == 2


def test_two_degrees_of_freedom_are_too_many() -> None:
    text = """
        title = "Пятизвенник"
        [frame]
        A = [0.0, 0.0]
        E = [0.5, 0.0]
        [links.1]
        points = ["A", "B"]
        AB = 0.1
        [links.2]
        points = ["B", "C"]
        BC = 0.3
        [links.3]
        points = ["C", "D"]
        CD = 0.3
        [links.4]
        points = ["D", "E"]
        DE = 0.2
        [driver]
        link = "1"
        phi = 60
        omega = 10
        [assembly]
        C = "above A"
    """
    with pytest.raises(
        StructureError, match=r"^Mobility W = .* = 2, but 1 driver is given"
    ) as error:
        Solution(loads(text, name="five-bar"))
    assert error.value.exit_code == 3


def test_a_structure_that_does_not_move() -> None:
    text = FOUR_BAR.format(rule='C = "above D"', bc=0.3, dc=0.3, phi=60).replace(
        "[driver]", '[links.4]\npoints = ["A", "C"]\nAC = 0.39\n[driver]'
    )
    with pytest.raises(
        StructureError, match=r"^Mobility W = .* = 0, but 1 driver is given"
    ) as error:
        Solution(loads(text, name="truss"))
    assert error.value.exit_code == 3


def test_wheels_on_links_are_rejected_as_pairs() -> None:
    """A five-bar whose two cranks mesh: W = 2, since the mesh is not counted."""
    text = """
[frame]
O = [0, 0]
D = [1.2, 0]
[links.1]
points = ["O", "A"]
OA = 0.4
[links.2]
points = ["A", "C"]
AC = 1.0
[links.3]
points = ["C", "B"]
CB = 1.0
[links.4]
points = ["D", "B"]
DB = 0.4
[gears]
wheels = { 1 = 60, 4 = 20 }
meshes = [{ of = [1, 4], kind = "external" }]
[driver]
link = "1"
phi = 20
omega = 3
[assembly]
C = "left of AB"
"""
    assert Solution(loads(text, name="geared")).links["4"].omega == pytest.approx(-9.0)
    with pytest.raises(StructureError, match=r"Wheels 1, 4 of \[gears\] .* in \[\[meshes\]\]"):
        Solution(loads(text.replace("[1, 4]", "[1, 5]"), name="geared"))
    with pytest.raises(StructureError) as told:
        Solution(loads(text.replace("1 = 60, 4 = 20", "5 = 60, 6 = 20"), name="apart"))
    assert "Wheels" not in str(told.value)
