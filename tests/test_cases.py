"""Joined cases all run, and a failure names its case."""

from __future__ import annotations

import inspect

import pytest
from cases import each


def test_every_case_is_run() -> None:
    seen = []

    @each("one", [1, 2])
    @each("two, three", [(3, 4), (5, 6)])
    def test(fixture: str, one: int, two: int, three: int) -> None:
        seen.append((fixture, one, two, three))

    assert list(inspect.signature(test).parameters) == ["fixture"]
    test(fixture="f")
    assert seen == [("f", 1, 3, 4), ("f", 1, 5, 6), ("f", 2, 3, 4), ("f", 2, 5, 6)]


def test_a_failure_names_all_cases_that_fail() -> None:
    @each("name", ["a", "b", "c", "d"])
    def test(name: str) -> None:
        assert name in "ac"

    with pytest.raises(AssertionError) as caught:
        test()
    assert caught.value.__notes__ == ["name = 'b'", "name = 'd'"]


def test_a_case_that_skips_does_not_hide_the_next() -> None:
    def skip_to(last: int) -> None:
        @each("case", range(3))
        def test(case: int) -> None:
            if case < last:
                pytest.skip("not this one")
            raise ValueError

        test()

    with pytest.raises(ValueError):
        skip_to(2)
    with pytest.raises(pytest.skip.Exception):
        skip_to(3)
