"""What a project decided, and which files it has, as plain data: ``project.json``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msgspec import Struct
from msgspec.structs import asdict

from planmethod.project.model import PartName, Project

SCHEMA = 1


class PartFiles(Struct, frozen=True):
    """Files of a part in the order of its sheets, and how many sheets it has."""

    name: PartName
    files: tuple[str, ...]
    sheets: int


def project_record(project: Project, parts: Sequence[PartFiles], stem: str) -> dict[str, Any]:
    """Return the decisions of a project and its files.

    Parameters
    ----------
    parts : sequence of PartFiles
        Those that were made.
    stem : str
        What its files are called.
    """
    drive, scales = project.problem.drive, project.scales
    column = drive.coordinate.column
    return {
        "schema": SCHEMA,
        "problem": stem,
        "positions": [
            # as sheets write it: an angle within one turn
            {"number": number, column: round(at % 360.0, 9) % 360.0 if drive.is_crank else at}
            for number, at in enumerate(project.positions)
        ],
        "calculated": project.calculated,
        "strokes": None if project.strokes is None else asdict(project.strokes),
        "scales": {
            "mu_l": scales.mu_l,
            "mu_v": scales.mu_v,
            "mu_a": scales.mu_a,
            "mu_F": scales.mu_F,
        },
        "frame": project.frame,
        "parts": [
            {"name": part.name.value, "files": list(part.files), "sheets": part.sheets}
            if part.name is not PartName.NOTE
            else {"name": part.name.value, "files": list(part.files)}
            for part in parts
        ],
    }
