"""Every output of the problems of levers has the sum that was taken."""

from __future__ import annotations

import pytest
from cases import is_thinned
from produced import groups
from sums import describe_differences

if is_thinned():
    pytest.skip("sums are compared where every case is taken", allow_module_level=True)


@pytest.mark.parametrize("group", [one for one in groups() if one.startswith("levers/")])
def test_outputs(group: str) -> None:
    message = describe_differences(group)
    assert not message, message
