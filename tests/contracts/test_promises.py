"""Every promise of docs/explanation/security.md has its tests (promises.toml beside this file)."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
PROMISES = tomllib.loads(Path(__file__).with_name("promises.toml").read_text("utf-8"))


def listed(page: str) -> list[str]:
    """Return the items of the first list of a page."""
    text = (ROOT / page).read_text("utf-8").partition("\n## ")[2].partition("\n## ")[0]
    return re.findall(r"(?m)^- (.*)$", text)


def test_the_page_lists_the_promises_that_have_tests() -> None:
    bold = (re.match(r"\*\*(.*?)[.]?\*\*", item) for item in listed("docs/explanation/security.md"))
    assert [found and found[1] for found in bold] == list(PROMISES)
    assert len(listed("docs/ru/explanation/security.md")) == len(PROMISES)


@pytest.mark.parametrize("promise", PROMISES)
def test_the_tests_of_a_promise_exist(promise: str) -> None:
    assert PROMISES[promise]
    for test in PROMISES[promise]:
        file, _, name = test.partition("::")
        assert f"def {name}(" in (ROOT / file).read_text("utf-8"), test
