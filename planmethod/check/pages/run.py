"""``run.json``: what a mark came from, so that it can be made again; names hidden (запись прогона).

Nothing in it changes from one run to the next of the same inputs: there is no time in it.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from planmethod.check.marks import Settings
from planmethod.check.model import Checked, Judged, Written
from planmethod.errors import OutputError
from planmethod.record import replace

PACKAGES = ("planmethod", "numpy")


def run_record(settings: Settings, inputs: Iterable[Path], lang: str, count: int) -> dict[str, Any]:
    """Return what a run was made of: versions, settings, the digests of its files.

    Raises
    ------
    OutputError
        When an input is gone.
    """
    return {
        "schema": 1,
        "versions": {name: _version(name) for name in PACKAGES},
        "language": lang,
        "settings": asdict(settings),
        "inputs": [{"name": path.name, "sha256": _digest(path)} for path in inputs],
        "works": count,
    }


def run_json(record: Mapping[str, Any]) -> bytes:
    """Return the record of a run as a file."""
    return (json.dumps(record, ensure_ascii=False, allow_nan=False, indent=1) + "\n").encode()


def settings_rows(record: Mapping[str, Any]) -> dict[str, str | float]:
    """Return the record of a run as lines of a table."""
    rows: dict[str, str | float] = {}
    for name, value in record["settings"].items():
        if isinstance(value, list | tuple):
            rows[name] = "; ".join(f"{mark}: {least:g}" for least, mark in value)
        elif value is not None:
            rows[name] = value
    rows |= {name: told for name, told in record["versions"].items() if told}
    for file in record["inputs"]:
        rows[file["name"]] = f"SHA-256 {file['sha256']}"
    return rows


def _version(name: str) -> str | None:
    try:
        return version(name)
    except PackageNotFoundError:
        return None


def _digest(path: Path) -> str:
    try:
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError as error:
        raise OutputError("Cannot read {} again: {}.", path, error.strerror) from error


def hidden_name(student: str, salt: str) -> str:
    """Return what a student is called where names are hidden: the same in every run of a salt."""
    return "s-" + hashlib.sha256(f"{salt}\n{student}".encode()).hexdigest()[:8]


def anonymous(works: Sequence[Checked], salt: str) -> list[Checked]:
    """Return the works without the names of students and of their files."""
    return [_anonymous(checked, salt) for checked in works]


def _anonymous(checked: Checked, salt: str) -> Checked:
    work = checked.work
    hidden = hidden_name(work.student, salt)
    file = Path(work.where).name

    def bare(text: str) -> str:
        for name in (work.where, file, work.student):
            text = text.replace(name, hidden) if name else text
        return text

    def rewritten(written: Written) -> Written:
        return replace(
            written,
            where=bare(written.where),
            unreadable=bare(written.unreadable),
            raw=bare(written.raw),
            fault=bare(written.fault),
        )

    def judged_of(judged: Judged) -> Judged:
        written = None if judged.written is None else rewritten(judged.written)
        return replace(judged, written=written, remark=bare(judged.remark))

    answers = tuple(map(judged_of, checked.answers))
    told = replace(
        work,
        student=hidden,
        where="",
        answers=tuple(map(rewritten, work.answers)),
        remarks=tuple(map(rewritten, work.remarks)),
    )
    return replace(checked, work=told, answers=answers, remark=bare(checked.remark))
