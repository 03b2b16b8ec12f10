"""Parts of a project (части проекта), and the kinds of those that are not of its linkage."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from types import MappingProxyType
from typing import Any

from planmethod.cams.kind import Cams
from planmethod.gears.involute.kind import Meshings
from planmethod.gears.kind import GearTrains
from planmethod.kind import ProblemKind


class PartName(Enum):
    """Parts of a project in the order of their sheets, as options and records name them."""

    SYNTHESIS = "synthesis"
    KINEMATICS = "kinematics"
    FORCES = "forces"
    FLYWHEEL = "flywheel"
    BALANCING = "balancing"
    GEARS = "gears"
    MESHING = "meshing"
    CAM = "cam"
    NOTE = "note"


PART_KINDS: Mapping[PartName, ProblemKind[Any]] = MappingProxyType(
    {PartName.GEARS: GearTrains(), PartName.MESHING: Meshings(), PartName.CAM: Cams()}
)
"""Kinds of problem that a linkage's file may have as parts of its project."""
