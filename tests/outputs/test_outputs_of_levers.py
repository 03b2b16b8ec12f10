"""The net over the problems of levers: every output is what was taken."""

from __future__ import annotations

import pytest
from cases import is_thinned
from produced import groups
from sums import complaint


@pytest.mark.parametrize("group", [one for one in groups() if one.startswith("levers/")])
def test_outputs(group: str) -> None:
    said = complaint(group, is_thinned=is_thinned())
    assert not said, said
