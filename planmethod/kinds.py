"""Kinds of problem by the table of the file."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from planmethod.cams.kind import Cams
from planmethod.cams.shaft_kind import Camshafts
from planmethod.gears.involute.kind import Meshings
from planmethod.gears.kind import GearTrains
from planmethod.kind import ProblemKind
from planmethod.linkages.kind import Linkages
from planmethod.moving.kind import MovingPoints
from planmethod.problem.source import parse, read_source

LINKAGES = Linkages()
"""The kind of a file that has links, whatever else it has, and of one without any table."""

KINDS: tuple[ProblemKind[Any], ...] = (
    LINKAGES, GearTrains(), MovingPoints(), Meshings(), Cams(), Camshafts(),
)  # fmt: skip
"""All kinds; a file with tables of several is of the first."""

_TABLES = "|".join(kind.table for kind in KINDS if kind is not LINKAGES)
_HEAD = rf"(?m)^[ \t]*(?:\[[ \t]*){{0,2}}[\"']?({_TABLES})\b"


def kind_of(path: Path) -> ProblemKind[Any]:
    """Return the kind of a problem file.

    Raises
    ------
    ProblemError
        The file cannot be read, or is not TOML.
    """
    text = read_source(path)
    if re.search(_HEAD, text) is None:  # a linkage is not parsed twice
        return LINKAGES
    table = parse(text, name=str(path))
    return next((kind for kind in KINDS if kind.table in table), LINKAGES)
