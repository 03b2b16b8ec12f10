"""Any text of a stranger gives a problem or a `ProblemError`."""

from __future__ import annotations

import copy
import datetime
import tomllib
from typing import Any

from cases import some
from doors import (
    FAMILIES_FAMILIES as FAMILIES,
    KEYS_KINDS as KINDS,
    ProblemError,
    ProblemProblem as Problem,
    known,
    problem_loads as loads,
    problem_template as template,
    read_parsed,
)
from hypothesis import HealthCheck, given, settings, strategies as st
from mechanisms import CRANK, LOADED

ASKED = """
[[answers]]
what = "v C"
letters = ["v_C", "VC"]
sense = true
position = 1
[[answers]]
what = "F_B_2/1"
segment = "p b"
form = "mm"
"""
GOOD = [*map(template, FAMILIES), CRANK + ASKED + LOADED]
NAMES = ["A", "B", "C", "D", "O", "S2", "AB", "BC", "CD", "OA", "1", "2", "3", "x-x", "А", "0", ""]
WORDS = [
    *(key for kind in KINDS for key in known(kind)),
    *NAMES,
    *("right of A", "left of AB", "left of", "v B", "segment velocity p B", "mm/unit"),
]

scalars = st.one_of(
    st.booleans(),
    st.integers(),
    st.sampled_from([0, 1, -1, 10**400, -(10**400)]),
    st.floats(),
    st.text(max_size=8),
    st.sampled_from(WORDS),
    st.dates(),
    st.times(),
    st.datetimes(),
)
keys = st.one_of(st.sampled_from(WORDS), st.text(max_size=6))
values = st.recursive(
    scalars,
    lambda inner: st.one_of(st.lists(inner, max_size=4), st.dictionaries(keys, inner, max_size=5)),
    max_leaves=12,
)
tables = st.dictionaries(keys, values, max_size=6)
FEW = settings(
    deadline=None, max_examples=some(150, few=60), suppress_health_check=list(HealthCheck)
)


def try_read(table: dict[str, Any], variant: str | None = None) -> None:
    before = copy.deepcopy(table)
    try:
        problem = read_parsed(table, source="stranger", name="stranger", variant=variant)
    except ProblemError as error:
        assert error.faults
        assert str(error)
    else:
        assert isinstance(problem, Problem)
        assert all(z == z for body in problem.bodies.values() for z in body.points.values())
        assert all(set(problem.bodies[link].points) for link in problem.mechanism.links)
    assert same(table, before)


def same(one: Any, other: Any) -> bool:
    """Equality in which not-a-number equals itself."""
    return repr(one) == repr(other)


@FEW
@given(tables)
def test_random_tables(table: dict[str, Any]) -> None:
    try_read(table)


def paths_of(table: Any, before: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    found = [before] if before else []
    if isinstance(table, dict):
        for key, value in table.items():
            found += paths_of(value, (*before, key))
    elif isinstance(table, list):
        for index, value in enumerate(table):
            found += paths_of(value, (*before, index))
    return found


@st.composite
def spoiled(draw: st.DrawFn) -> dict[str, Any]:
    """A good file with one to four of its values replaced, removed or added to."""
    table = tomllib.loads(draw(st.sampled_from(GOOD)))
    for _ in range(draw(st.integers(1, 4))):
        path = draw(st.sampled_from(paths_of(table)))
        place: Any = table
        for part in path[:-1]:
            place = place[part]
        action = draw(st.sampled_from(["replace", "remove", "add", "rename"]))
        if action == "replace":
            place[path[-1]] = draw(values)
        elif action == "remove":
            del place[path[-1]]
        elif action == "add" and isinstance(place, dict):
            place[draw(keys)] = draw(values)
        elif isinstance(place, dict):
            place[draw(keys)] = place.pop(path[-1])
        if not table:
            break
    return table


@settings(FEW, max_examples=some(1000, few=200))
@given(spoiled())
def test_spoiled_files(table: dict[str, Any]) -> None:
    try_read(table)


@FEW
@given(tables, st.sampled_from(list(FAMILIES)))
def test_random_variants(overrides: dict[str, Any], family: str) -> None:
    table = tomllib.loads(template(family))
    table["variants"] = {"v": overrides}
    try_read(table)
    try_read(table, "v")


@settings(FEW, max_examples=some(300, few=80))
@given(st.data())
def test_spoiled_text(data: st.DataObject) -> None:
    text = data.draw(st.sampled_from(GOOD))
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(text)))
        cut = data.draw(st.integers(0, 10))
        text = text[:at] + data.draw(st.text(max_size=5)) + text[at + cut :]
    try:
        loads(text, name="stranger")
    except ProblemError as error:
        assert error.faults


@FEW
@given(st.text(max_size=200))
def test_random_text(text: str) -> None:
    try:
        loads(text, name="stranger")
    except ProblemError as error:
        assert error.faults


def test_dates_are_described() -> None:
    table = tomllib.loads(template("sine"))
    table["driver"]["phi"] = datetime.date(2024, 1, 1)
    try_read(table)
