"""Students who type at once: a real server and real clients on this machine, few, for seconds."""

from __future__ import annotations

import sys

import pytest

from benchmarks.studio import HEADS, row, served

pytest.importorskip("starlette", reason="the studio's extra is not installed")
pytest.importorskip("uvicorn", reason="the studio's extra is not installed")


@pytest.mark.skipif(sys.platform != "linux", reason="memory is read from /proc")
def test_no_request_is_lost_where_many_type_at_once_and_memory_is_bounded() -> None:
    with served("--serve") as (address, server):
        told = dict(zip(HEADS, row(address, server, 12, 2, 0.5), strict=True))
    assert (told["asked"], told["drawn"], told["refused"], told["lost"]) == ("24", "24", "0", "0")
    assert 0 < float(told["memory, MB"]) < 1000  # two processes may have 500 each
