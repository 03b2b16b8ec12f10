"""Faults of a submission file as a whole, and bounded reading of its bytes."""

from __future__ import annotations

import stat
from pathlib import Path

from planmethod.errors import ExitCode, PlanMethodError

SIZE_LIMIT = 4 * 1024 * 1024


class SubmissionError(PlanMethodError):
    """A submission file cannot be read (файл работ)."""

    exit_code = ExitCode.USAGE


def read_bytes(path: Path, limit: int = SIZE_LIMIT) -> bytes:
    """Return the contents of a file.

    Raises
    ------
    WorksError
        It does not exist, cannot be read, or is too large.
    """
    try:
        if not stat.S_ISREG(path.stat().st_mode):
            raise SubmissionError(
                "{}: this is not a file. Name one: JSON, TOML, CSV or XLSX.", path
            )
        with path.open("rb") as stream:
            data = stream.read(limit + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise SubmissionError("{}: cannot be read: {}. Check the path.", path, reason) from None
    if len(data) > limit:
        raise SubmissionError(
            "{}: larger than {} MiB. Submissions of a group take a few hundred kilobytes; "
            "is this the right file?",
            path,
            limit // 2**20,
        )
    return data
