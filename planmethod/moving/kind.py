"""Which files describe a moving point; nothing else of this folder is imported for it."""

from __future__ import annotations

from pathlib import Path

from planmethod.errors import ProblemError
from planmethod.problem.source import parse, read_source


def is_point(path: Path) -> bool:
    """Tell whether a file describes a moving point; one that cannot be read does not."""
    try:
        table = parse(read_source(path), name=str(path))
    except ProblemError:
        return False
    return "point" in table and "links" not in table and "gears" not in table
