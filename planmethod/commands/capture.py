"""Run of a command as by the command line, with captured output and progress (запуск команды)."""

from __future__ import annotations

import io
import re
from contextlib import redirect_stderr, redirect_stdout
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

_BAR = re.compile(r"planmethod\s+\[[^\]\r\n]*+\]\s+(\d++)%[^\r\n]*")
_ORDERS = re.compile(r"\x1b\[[?\d;]*[a-zA-Z]")
MAX_TEXT = 400_000
"""Maximum number of characters that are kept of a command's output."""


class _ProgressReader(io.StringIO):
    """Standard error of a command with a progress bar, which is reported, not kept."""

    def __init__(self, on_progress: Callable[[float], None]) -> None:
        super().__init__()
        self._told = on_progress

    def isatty(self) -> bool:
        """Return True, as for a terminal."""
        return True

    def write(self, text: str) -> int:
        """Report the progress of the bar; keep all other text."""
        text = _ORDERS.sub("", text)
        for share in _BAR.findall(text):
            self._told(int(share) / 100)
        super().write(_BAR.sub("", text).replace("\r", ""))
        return len(text)


def run(name: str, *args: str, on_progress: Callable[[float], None]) -> dict[str, Any]:
    """Run a command as the command line does; return its output and exit code."""
    command = getattr(import_module(f"planmethod.commands.{name}"), name)
    printed, errors, code = io.StringIO(), _ProgressReader(on_progress), 0
    with redirect_stdout(printed), redirect_stderr(errors):
        try:
            found = command.main(list(args), standalone_mode=False, prog_name=f"planmethod {name}")
            code = found if isinstance(found, int) else 0
        except SystemExit as end:
            code = end.code if isinstance(end.code, int) else 1
    return {
        "code": int(code),
        "output": printed.getvalue()[:MAX_TEXT],
        "errors": errors.getvalue().strip()[:MAX_TEXT],
    }
