from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from doors import (
    STEP_TYPES,
    Builder,
    Compute,
    Float64,
    GivenNumber,
    GivenPoint,
    IntersectLines,
    Join,
    LayOffLength,
    Leg,
    LineName,
    LineSense,
    NumberName,
    PointName,
    Program,
    ProgramError,
    RulerArithmetic,
    Side,
    Solution,
    evaluate_evaluate as evaluate,
    operands,
    result_kind,
)
from hypothesis import given, strategies as st
from worked import problem_of

A, B, C = PointName("A"), PointName("B"), PointName("C")
AB, AC = LineName("AB"), LineName("AC")
L = NumberName("l_AB")


def test_a_program_is_checked_when_it_is_made() -> None:
    Program((GivenPoint(A), GivenPoint(B), Join(AB, A, B)))
    Program(())


def test_every_name_is_made_once() -> None:
    with pytest.raises(ProgramError, match=r"^step 3: 'A' is already made$"):
        Program((GivenPoint(A), GivenPoint(B), GivenPoint(A)))
    with pytest.raises(ProgramError, match=r"^step 2: 'A' is already made$"):
        Program((GivenPoint(A), GivenNumber(NumberName("A"))))


def test_an_unknown_name_comes_with_the_nearest_one() -> None:
    with pytest.raises(
        ProgramError,
        match=r"^step 3 \(AB\): no earlier step makes 'point_b1'; did you mean 'point_b'\?$",
    ):
        Program(
            (GivenPoint(A), GivenPoint(PointName("point_b")), Join(AB, A, PointName("point_b1"))),
        )
    with pytest.raises(ProgramError, match=r"^step 2 \(AB\): no earlier step makes 'B'$"):
        Program((GivenPoint(A), Join(AB, A, B)))


def test_a_name_is_made_before_it_is_used() -> None:
    with pytest.raises(ProgramError, match=r"step 2 \(AB\): no earlier step makes 'B'"):
        Program((GivenPoint(A), Join(AB, A, B), GivenPoint(B)))
    with pytest.raises(ProgramError, match=r"no earlier step makes 'AB'"):
        Program((GivenPoint(A), GivenPoint(B), IntersectLines(C, AB, AB)))


def test_a_line_is_not_a_point_and_a_number_is_not_a_line() -> None:
    drawn = (GivenPoint(A), GivenPoint(B), Join(AB, A, B), GivenNumber(L))
    with pytest.raises(ProgramError, match=r"^step 5 \(AC\): 'AB' is not a .*PointName$"):
        Program((*drawn, Join(AC, A, PointName("AB"))))
    with pytest.raises(ProgramError, match=r"^step 5 \(C\): 'l_AB' is not a .*LineName$"):
        Program((*drawn, LayOffLength(C, A, LineName("l_AB"), L)))
    with pytest.raises(ProgramError, match=r"^step 5 \(C\): 'A' is not a .*NumberName$"):
        Program((*drawn, LayOffLength(C, A, AB, NumberName("A"))))
    with pytest.raises(ProgramError, match=r"^step 5 \(x\): 'A' is not a .*NumberName$"):
        Program((*drawn, Compute(NumberName("x"), 1.0, ((NumberName("A"), 1),))))


def test_an_absent_line_is_no_operand() -> None:
    builder = Builder()
    turn = builder.known("angle")
    builder.at_angle(builder.take_point("A"), None, turn)
    program = builder.program()
    assert [name for name, _ in operands(program.steps[-1])] == ["A", "angle"]


def test_every_step_makes_something_of_a_known_kind() -> None:
    for step in STEP_TYPES:
        assert "out" in step.__struct_fields__
    assert result_kind(GivenPoint(A)) is PointName
    assert result_kind(Join(AB, A, B)) is LineName
    assert result_kind(GivenNumber(L)) is NumberName


# Only the needed steps ----------------------------------------------------------------------------


def triangle() -> Program:
    b = Builder()
    p, q, r = b.take_point("P"), b.take_point("Q"), b.take_point("R")
    pq, pr = b.join(p, q), b.join(p, r)
    foot = b.intersect_lines("F", pq, b.perpendicular(r, pq))
    b.measure("height", r, foot)
    b.lay_off_length("S", q, pr, b.known("l"))
    return b.program()


def test_only_the_steps_that_are_needed_are_kept() -> None:
    program = triangle()
    kept = program.needed_for([NumberName("height")])
    assert [type(s).__name__ for s in kept.steps] == [
        "GivenPoint", "GivenPoint", "GivenPoint", "Join", "Perpendicular", "IntersectLines",
        "Measure",
    ]  # fmt: skip
    assert [s for s in program.steps if s in kept.steps] == list(kept.steps)
    assert program.needed_for([PointName("P")]).steps == (GivenPoint(PointName("P")),)
    assert program.needed_for([]).steps == ()
    assert program.needed_for([s.out for s in program.steps]) == program


def test_a_name_that_no_step_makes_cannot_be_requested() -> None:
    with pytest.raises(ProgramError, match=r"^no step makes T, U$"):
        triangle().needed_for([PointName("U"), PointName("P"), PointName("T")])


def test_a_pruned_program_needs_no_more_data() -> None:
    kept = triangle().needed_for([NumberName("height")])
    trace = evaluate(kept, {"P": 0j, "Q": 4 + 0j, "R": 1 + 3j}, Float64())
    assert trace.value[NumberName("height")] == 3.0


def ends(value: Any) -> tuple[Any, ...]:
    """Point and direction of a line; a point or a number alone."""
    return value if isinstance(value, tuple) else (value,)


@given(st.data())
def test_pruned_and_full_give_the_same(data: st.DataObject) -> None:
    """In every arithmetic, bit for bit, for any requested results of a mechanism's plans."""
    name = data.draw(st.sampled_from(["linkages/ex3", "levers/task12", "levers/six-link"]))
    solution = Solution(problem_of(name))
    program = solution.construction.program
    asked = data.draw(st.sets(st.sampled_from([s.out for s in program.steps]), max_size=4))
    kept = program.needed_for(asked)
    assert set(kept.steps) <= set(program.steps)
    given_data = {
        **solution.construction.draft.numbers,
        **solution.construction.draft.places,
        **dict.fromkeys(("mu_l", "mu_v", "mu_a"), 1.0),
        "phi": solution.positions,
        "omega_1": solution.problem.drive.rate,
        "epsilon_1": solution.problem.drive.acceleration,
    }
    for arithmetic in (Float64(), RulerArithmetic(ruler=0.001)):
        full = evaluate(program, given_data, arithmetic)
        part = evaluate(kept, given_data, arithmetic)
        assert set(part.value) == {s.out for s in kept.steps}
        for step in kept.steps:
            pair = zip(ends(part.value[step.out]), ends(full.value[step.out]), strict=True)
            assert all(np.array_equal(one, two, equal_nan=True) for one, two in pair)
        for step_name, margin in part.margin.items():
            assert np.array_equal(np.asarray(margin), np.asarray(full.margin[step_name]))


def test_a_velocity_plan_needs_no_acceleration() -> None:
    solution = Solution(problem_of("linkages/ex3"))
    kept = solution.construction.program.needed_for([PointName("v:E")])
    assert not [s.out for s in kept.steps if "a:" in s.out or "epsilon" in s.out or s.out == "mu_a"]
    assert len(kept.steps) < len(solution.construction.program.steps)


# Builder ------------------------------------------------------------------------------------------


def test_a_line_that_was_drawn_is_found_again() -> None:
    b = Builder()
    p, q, angle, other = b.take_point("P"), b.take_point("Q"), b.known("angle"), b.known("other")
    pq = b.join(p, q)
    once = [
        pq,
        b.join(q, p),  # the other way round: another sense
        b.parallel(p, pq),
        b.parallel(q, pq),
        b.perpendicular(p, pq),
        b.at_angle(p, pq, angle),
        b.at_angle(p, None, angle),
        b.at_angle(p, pq, other),
    ]
    again = [
        b.join(p, q),
        b.join(q, p),
        b.parallel(p, pq),
        b.parallel(q, pq),
        b.perpendicular(p, pq),
        b.at_angle(p, pq, angle),
        b.at_angle(p, None, angle),
        b.at_angle(p, pq, other),
    ]
    assert again == once
    assert len(set(once)) == len(once)
    assert len(b.program().steps) == 4 + len(once)


def test_each_verb_makes_its_step_and_returns_its_name() -> None:
    b = Builder()
    p, q, r = b.take_point("P"), b.take_point("Q"), b.take_point("R")
    one, two = b.known("one"), b.known("two")
    pq = b.join(p, q)
    leg = Leg((None, None), centre=p, radius=one)
    made = [
        b.lay_off_length("a", p, pq, one),
        b.intersect_lines("b", pq, b.join(p, r)),
        b.intersect_line_circle("c", pq, r, one, LineSense.BACKWARD),
        b.intersect_circles("d", p, one, q, two, Side.RIGHT),
        b.touch("e", p, one, q, Side.LEFT),
        b.pose_triad("m", (leg, leg, leg), (one, one, two)),
        b.spot("n", LineName("m"), (one, two)),
        b.similar("f", (p, q), (q, r, p), one, span=two),
        b.measure("g", p, q),
        b.measure_along("h", p, q, pq),
        b.compute("i", (one, 2), (two, -1), factor=2.0),
        b.carry("j", p, q, r, one, times=two),
        b.measure_arm("k", p, q, r, p),
        b.total("l", one, two),
        b.measure_angle("o", pq),
    ]
    assert made == list("abcdemnfghijklo")
    steps = {str(step.out): step for step in b.program().steps}
    assert [type(steps[name]).__name__ for name in made] == [
        "LayOffLength", "IntersectLines", "IntersectLineCircle", "IntersectCircles", "Touch",
        "TriadPose", "Spot",
        "Similar", "Measure", "MeasureAlong", "Compute", "Carry", "MeasureArm", "Total",
        "MeasureAngle",
    ]  # fmt: skip
    trace = evaluate(
        b.program(), {"P": 0j, "Q": 3 + 0j, "R": 1 + 1j, "one": 3.0, "two": 4.0}, Float64()
    )
    assert trace.value[NumberName("i")] == 2 * 9 / 4


def test_a_faulty_construction_of_the_builder_is_found() -> None:
    b = Builder()
    b.lay_off_length("X", PointName("nowhere"), LineName("no line"), NumberName("no length"))
    with pytest.raises(ProgramError, match="nowhere"):
        b.program()
