"""The net over all problems but those of levers, and over what is of no problem."""

from __future__ import annotations

import pytest
from cases import is_thinned
from produced import GENERAL, groups
from sums import WHOLE, complaint, kept_sums, sum_of, text_file

OTHERS = [one for one in groups() if not one.startswith("levers/") and one != GENERAL]


@pytest.mark.parametrize("group", OTHERS)
def test_outputs(group: str) -> None:
    said = complaint(group, is_thinned=is_thinned())
    assert not said, said


def test_outputs_of_no_problem() -> None:
    said = complaint(GENERAL, is_thinned=is_thinned())
    assert not said, said


def test_the_net_has_every_problem_and_no_other() -> None:
    assert {name.partition(": ")[0] for name in kept_sums()} == {*groups()}


def test_the_whole_texts_are_those_of_the_sums() -> None:
    kept = kept_sums()
    for name in WHOLE:
        assert sum_of(text_file(name).read_bytes().decode()) == kept[name], name
    assert {*text_file(WHOLE[0]).parent.iterdir()} == {text_file(name) for name in WHOLE}
