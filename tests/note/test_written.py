"""Records of many positions, kept by columns, are put together as plain data."""

from __future__ import annotations

from typing import Any

import pytest
from doors import (
    ColumnarRecords,
    Solution,
    list_of,
    record_in_columns,
    record_of,
    solution_record as record,
    to_builtins,
)
from worked import problem_of

NOTHING = record_of({}, 3)


@pytest.mark.parametrize("name", ["press/press", "levers/task12", "linkages/ex1", "levers/task-33"])
@pytest.mark.parametrize("positions", [(30.0,), (0.0, 40.0, 200.0, 330.0)])
def test_a_solution_in_columns_is_its_plain_data(name: str, positions: tuple[float, ...]) -> None:
    solution = Solution(problem_of(name), positions=positions)
    more = [{"digits": i} for i in range(len(positions))]
    told = record_in_columns(solution, more=more)
    plain = to_builtins(told)
    assert [one.pop("more") for one in plain["positions"]] == more
    assert plain == record(solution)


@pytest.mark.parametrize(
    ("records", "plain"),
    [
        (NOTHING, [{}, {}, {}]),
        (list_of([], 2), [[], []]),
        (record_of({"a": NOTHING, "b": list_of([], 3)}), [{"a": {}, "b": []}] * 3),
        (
            record_of({"100 %": [1.0, None], "%s": ["%d", "°"]}),
            [{"100 %": 1.0, "%s": "%d"}, {"100 %": None, "%s": "°"}],
        ),
        (
            record_of({"n": [1, 1], "x": [1.0, 1.0], "is": [True, True]}),
            [{"n": 1, "x": 1.0, "is": True}] * 2,
        ),
        (
            record_of({"x": [0.5, 1.5]}, some={1: {"edges": [1], "at": "b"}}),
            [{"x": 0.5}, {"x": 1.5, "edges": [1], "at": "b"}],
        ),
        (
            list_of([[0.1, 0.2], record_of({"y": [[], [1.0]]})], 2),
            [[0.1, {"y": []}], [0.2, {"y": [1.0]}]],
        ),
    ],
)
def test_records_are_put_together(records: ColumnarRecords, plain: list[Any]) -> None:
    assert records.to_list() == plain
    assert to_builtins({"positions": records}) == {"positions": plain}
