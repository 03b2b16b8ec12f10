"""The folder of a run of ``check``: what it writes there is on record, and goes when it is old.

A run owns the files that it wrote. The next run deletes those that it no longer writes: pages of
students who left the group, names that are now hidden. Files that somebody else created, or
changed, are kept.
"""

from __future__ import annotations

import contextlib
import hashlib
import json
import re
import stat
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from planmethod.render.backends.output import UNFINISHED, write

RECORD, OVERRIDES, PAGES = "run.json", "overrides.csv", "pages"
RECORD_LIMIT = 16 * 2**20
"""Maximum size of a record, bytes."""

_OURS = rf"(?:{PAGES}/)?[^/\\]{{1,255}}"
"""Names of files that a run may have written."""


class RunFolder:
    """Output folder of a run, with the files of an earlier one (папка проверки).

    Attributes
    ----------
    earlier : dict of str to (str or None)
        Digests of files of earlier runs, by name in the folder; None for a file that a run was
        about to write when it was stopped.
    files : dict of str to str
        Digests of the files of this run.
    """

    def __init__(self, out: Path) -> None:
        self.out, self.earlier = out, _earlier(out / RECORD)
        self.files: dict[str, str] = {}

    def record_names(self, names: Iterable[str]) -> None:
        """Record the names of the files to be written: they are owned even if the run is stopped.

        Raises
        ------
        OutputError
        """
        self._write_record({"schema": 1, "files": {**self.earlier, **dict.fromkeys(names)}})

    def write(self, name: str, data: bytes) -> Path:
        """Write a file, whole or not at all, and return where it is.

        Raises
        ------
        OutputError
        """
        path = self.out / name
        write(path, data, output_root=self.out)
        self.files[name] = digest_of(data)
        return path

    def owns(self, name: str) -> bool:
        """Return whether a file is there as an earlier run wrote it."""
        found = self.earlier.get(name)
        return found is not None and found == _digest_at(self.out / name)

    def finish(self, record: Mapping[str, Any]) -> list[Path]:
        """Delete the files that are no longer written, and record the run.

        Returns
        -------
        list of Path
            Files of an earlier run that were edited since: they are kept.

        Raises
        ------
        OutputError
        """
        kept = []
        if None in self.earlier.values():  # a run was stopped, perhaps in the middle of a file
            for folder in (self.out, self.out / PAGES):
                for path in folder.glob(UNFINISHED):
                    with contextlib.suppress(OSError):
                        path.unlink()
        for name in self.earlier.keys() - {*self.files, OVERRIDES}:
            path = self.out / name
            there = _digest_at(path)
            if there is None or (PAGES in name and path.parent.is_symlink()):
                continue  # it is missing, not a file, or in a folder that is elsewhere
            if self.earlier[name] in (None, there):
                with contextlib.suppress(OSError):
                    path.unlink()
            else:
                kept.append(path)
        with contextlib.suppress(OSError):
            (self.out / PAGES).rmdir()  # only where it is empty
        self._write_record({**record, "files": self.files})
        return sorted(kept)

    def _write_record(self, record: Mapping[str, Any]) -> None:
        text = json.dumps(record, ensure_ascii=False, allow_nan=False, indent=1)
        data = f"{text}\n".encode("utf-8", "replace")
        write(self.out / RECORD, data, output_root=self.out)


def digest_of(data: bytes) -> str:
    """Return the digest of a file's contents."""
    return hashlib.sha256(data).hexdigest()


def _earlier(path: Path) -> dict[str, str | None]:
    """Return the files in the record of an earlier run; none if it is not such a record."""
    try:
        if not stat.S_ISREG(path.lstat().st_mode) or path.stat().st_size > RECORD_LIMIT:
            return {}
        files = json.loads(path.read_bytes())["files"]
        return {
            name: None if found is None else str(found)
            for name, found in files.items()
            if re.fullmatch(_OURS, name)
            and name.removeprefix(f"{PAGES}/") not in ("..", ".", RECORD)
            and (found is not None or name != OVERRIDES)
        }
    except (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError):
        return {}


def _digest_at(path: Path) -> str | None:
    """Return the digest of a file; None without a plain file."""
    try:
        if not stat.S_ISREG(path.lstat().st_mode):
            return None
        with path.open("rb") as file:
            return hashlib.file_digest(file, "sha256").hexdigest()
    except OSError:
        return None
