"""Output of --referee, for people and for programs."""

from __future__ import annotations

import pytest
from doors import Solution, accuracy_examine as examine, examine_results, referee_record
from texts import referee_tables
from worked import problem_of


@pytest.mark.parametrize(
    ("lang", "word", "value"),
    [("ru", "арбитр", "15,4767088364120"), ("en", "referee", "15.4767088364120")],
)
def test_every_moving_result_is_beside_that_of_the_referee(
    lang: str, word: str, value: str
) -> None:
    text = referee_tables(Solution(problem_of("linkages/ex3")), 50, lang)
    assert word in text and value in text
    assert "\nv_A " not in text  # the pivot does not move
    assert all(len(line) <= 100 for line in text.splitlines())


def test_the_record_has_all_digits() -> None:
    (entry,) = referee_record(Solution(problem_of("linkages/ex3")), 40)
    assert entry["digits"] == 40 and entry["bound"] < 1e-12
    omega = entry["results"]["omega_3"]
    assert len(omega["value"].replace(".", "")) == 40
    assert float(omega["value"]) == pytest.approx(15.47670883641208, rel=1e-15)
    assert omega["multiple"] < 4 and omega["kappa"] > 1
    assert set(entry["results"]["v_E"]) == {"x", "y", "error", "kappa", "multiple"}


def test_more_digits_agree_with_fewer() -> None:
    solution = Solution(problem_of("levers/six-link"))
    few, many = examine_results(solution, 25)[0], examine_results(solution, 60)[0]
    for one, two in zip(few.verdicts, many.verdicts, strict=True):
        assert one.label == two.label
        assert abs(one.value - complex(two.value)) <= 1e-14 * (1 + two.size)
        assert one.error == pytest.approx(two.error, rel=1e-6, abs=1e-20)


def test_a_fast_look_judges_as_a_close_one() -> None:
    problem = problem_of("press/press")
    close = examine(problem, [40.0, 100.0])
    fast = examine(problem, [40.0, 100.0], closely=False)
    for one, two in zip(close, fast, strict=True):
        assert one.agreed and two.agreed and not one.unexplained
        for a, b in zip(one.verdicts, two.verdicts, strict=True):
            assert (a.label, a.error) == (b.label, b.error)
            assert a.reach == pytest.approx(b.reach, rel=1e-6, abs=1e-20)
