"""The end of a process that lives for one command: at once, but not over anybody's head."""

from __future__ import annotations

import subprocess
import sys

import pytest

ENDS = """
import atexit, sys
from planmethod.process import end_process
atexit.register(print, "said at the end")
print("x" * 70_000)
{before}
end_process({code})
print("goes on")
"""


def ended(before: str = "", code: str = "3") -> tuple[int, list[str]]:
    source = ENDS.format(before=before, code=code)
    done = subprocess.run([sys.executable, "-c", source], capture_output=True, text=True)
    assert done.stderr == ""
    return done.returncode, done.stdout.splitlines()[1:]


@pytest.mark.parametrize(("code", "given"), [("3", 3), ("None", 0), ("0", 0)])
def test_a_command_ends_at_once_and_says_what_is_to_say(code: str, given: int) -> None:
    assert ended(code=code) == (given, ["said at the end"])


@pytest.mark.parametrize(
    "before",
    [
        "sys.setprofile(lambda *_: None)",
        "sys.settrace(lambda *_: None)",
        "import threading; threading.Timer(0.2, int).start()",
    ],
)
def test_who_watches_or_works_sees_the_end(before: str) -> None:
    assert ended(before)[1] == ["goes on", "said at the end"]


def test_a_word_instead_of_a_code_is_told_by_python() -> None:
    assert ended(code="'no'")[1] == ["goes on", "said at the end"]
