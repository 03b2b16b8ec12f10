"""Regular expressions that are compiled when they are first used.

Compiling the forty patterns that the modules of a command name takes a tenth of its start, and
most of them are for faults that are not there.
"""

from __future__ import annotations

import re
from typing import Any, AnyStr, Generic, cast


class _Later(Generic[AnyStr]):
    """Stand-in of a compiled pattern."""

    def __init__(self, source: AnyStr, flags: int) -> None:
        """Keep what is to be compiled."""
        self.pattern: AnyStr = source
        self._flags = flags

    def __getattr__(self, name: str) -> Any:
        """Return a method of the pattern, and keep it."""
        method = getattr(re.compile(self.pattern, self._flags), name)
        setattr(self, name, method)
        return method


def pattern(source: AnyStr, flags: int = 0) -> re.Pattern[AnyStr]:
    """Return a regular expression, to be compiled when it is first asked for something."""
    return cast("re.Pattern[AnyStr]", _Later(source, flags))
