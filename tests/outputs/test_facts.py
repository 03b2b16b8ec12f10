"""The facts of outputs are those that were taken, at least one output of every combination."""

from __future__ import annotations

import re
from itertools import groupby

import pytest
from facts import (
    describe_changes,
    extract_facts,
    find_combination,
    find_differing,
    make_facts,
    read_facts,
    select_outputs,
)
from look import FREE, explain_refusal
from produced import groups
from sums import read_sums

TAKEN = read_facts()
GROUPS = {
    group: list(names) for group, names in groupby(sorted(TAKEN), lambda name: name.split(": ")[0])
}


@pytest.mark.parametrize("group", GROUPS)
def test_facts_are_those_that_were_taken(group: str) -> None:
    old = {name: TAKEN[name] for name in GROUPS[group]}
    new = make_facts(old)
    lines = [
        line
        for name in find_differing(old, new)
        for line in (name, *describe_changes(old[name], new[name]))
    ]
    message = "\n".join([*lines, "To take: make outputs TAKE=1."])
    assert not lines, message


def test_every_combination_has_facts_of_one_output() -> None:
    assert [*TAKEN] == select_outputs(read_sums())
    sums = read_sums().items()
    every = {find_combination(name, int(total.split()[1])) for name, total in sums}
    assert len(every) == len(TAKEN)


def test_there_are_sums_of_every_problem_and_of_no_other() -> None:
    assert {name.partition(": ")[0] for name in read_sums()} == {*groups()}


@pytest.mark.parametrize(
    ("name", "size", "expected"),
    [
        ("levers/a: solve --lang ru --sigma", 9, ("linkages", "solve", "--lang ru", "--sigma")),
        ("press/a: solve --json --all-variants", 9, ("machines", "solve", "--json")),
        (
            "press/a: sheet --layout forces --lang en --phi 0,3",
            9999,
            ("linkages", "sheet", "--layout forces"),
        ),
        ("cams/a: sheet --layout forces --lang en", 99, ("cams", "sheet", "refused")),
        ("cams/a: lint --lang en", 99, ("lint", "--lang en")),
        ("general: teeth --U -2.5 --lang ru", 99, ("general", "teeth", "--lang ru")),
    ],
)
def test_a_combination_is_kind_command_layout_and_language(
    name: str, size: int, expected: tuple[str, ...]
) -> None:
    assert find_combination(name, size) == expected


DRAWING = r"""out/a.svg
--- out/a.svg
<svg> sheet 420.00 297.00 Plan
stroke main link 1 0.00,0.00 10.00,20.50
stroke main link 1 30.00,0.00 40.00,20.00
text '3,10' 1.00,2.00 5.00 0.00 3,10 in 0.00 0.00 7.00 8.00
text '3,10' 1.00,9.00 5.00 0.00 3,10 in 0.00 8.00 7.00 16.00
text 'v' 3.00,2.00 3.50 0.00 velocity 0: \bar{v}^{n}_{BA}
text 'BA' 4.00,2.00 2.50 0.00 velocity 0: \bar{v}^{n}_{BA}
text 'n' 4.00,3.00 2.50 0.00 velocity 0: \bar{v}^{n}_{BA}
view velocity 39.75 104.43 114.32 172.11 'μ_{v}' 0.0512345678
  span pb None 0.00,0.00 30.00,40.00 1
</svg>
"""


def test_facts_of_a_drawing_are_inscriptions_counts_bounds_and_views() -> None:
    assert extract_facts("a: sheet", DRAWING) == [
        "out/a.svg",
        "--- out/a.svg",
        "sheet 420.00 297.00 Plan",
        "text 3,10",
        "text 3,10",
        r"text velocity 0: \bar{v}^{n}_{BA}",
        "stroke main link 1: 2, x 0..40 mean 20.00, y 0..21 mean 10.12",
        "text 5.00: 2, x 1..1 mean 1.00, y 2..9 mean 5.50",
        "text 3.50: 1, x 3..3 mean 3.00, y 2..2 mean 2.00",
        "text 2.50: 2, x 4..4 mean 4.00, y 2..3 mean 2.50",
        "view velocity 40 104 114 172 'μ_{v}' 0.0512346",
        "segment pb None: 50.0 mm, 1",
    ]


def test_facts_of_data_are_named_values_of_some_rows_and_all_texts() -> None:
    rows = ",".join(f'{{"k": {k}, "word": "{"ab"[k == 5]}"}}' for k in range(14))
    found = extract_facts("a: solve --json", f'{{"x": 0.123456789, "rows": [{rows}]}}')
    assert found[:2] == ["x: 0.123457", "rows: 14 rows"]
    assert {int(one) for one in re.findall(r"k: (\d+)", "\n".join(found))} == {0, 1, 2, 12}
    assert 'rows[5].word: "b"' in found
    table = extract_facts("a: solve --csv", "x,w\n" + "".join(f"{k},t{k}\n" for k in range(6)))
    assert table == ["6 rows", "x: 0, 1, 2", "w: t0, t1, t2, t3, t4, t5"]


def test_changes_are_facts_old_and_new() -> None:
    assert [*describe_changes(["a", "b 1", "c"], ["a", "b 2", "c", "d"])] == [
        "  b 1  →  b 2",
        "  + d",
    ]
    assert [*describe_changes(["a", "b"], ["b"])] == ["  - a"]


def test_many_changed_facts_want_a_reason() -> None:
    assert not explain_refusal(FREE, "")
    assert not explain_refusal(FREE + 1, "Digits of forces follow the smallest one.")
    assert "REASON" in explain_refusal(FREE + 1, " ")
