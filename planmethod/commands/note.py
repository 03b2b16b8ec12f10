"""Command ``note``: the explanatory note of a project or of a homework."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from planmethod.project.model import Project


def note_files(project: Project, fields: Mapping[str, str]) -> dict[str, bytes]:
    """Return the files of the note by their names."""
    return {}
