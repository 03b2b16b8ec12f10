"""Decisions and files of a project, as plain data: ``project.json``."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from msgspec import Struct

from planmethod.note.plaintext import plain_text
from planmethod.project.model import PartName, Project

SCHEMA = 1

STROKES = ("working_deg", "idle_deg", "K_v", "by")


class PartFiles(Struct, frozen=True):
    """Files of a part in the order of its sheets, and how many sheets it has."""

    name: PartName
    files: tuple[str, ...]
    sheets: int


def project_record(project: Project, parts: Sequence[PartFiles], basename: str) -> dict[str, Any]:
    """Return the decisions of a project and its files.

    Parameters
    ----------
    parts : sequence of PartFiles
        Those that were made.
    basename : str
        Base name of its files.
    """
    column, scales = project.problem.drive.coordinate.column, project.scales
    strokes = project.strokes
    return {
        "schema": SCHEMA,
        "problem": basename,
        "positions": [{"number": number, column: at} for number, at in enumerate(project.places)],
        "calculated": project.calculated,
        "strokes": None
        if strokes is None
        else {key: _to_json_value(getattr(strokes, key)) for key in STROKES},
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


def _to_json_value(value: float | str | None) -> float | str | None:
    """Return a number without its last bits, a text without markup."""
    return plain_text(value) if isinstance(value, str) else value and round(value, 9)
