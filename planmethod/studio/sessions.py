"""Folders of sessions, accessible only with the key; and the edited file (сеансы)."""

from __future__ import annotations

import contextlib
import io
import os
import re
import secrets
import shutil
import stat
import sys
import tempfile
import time
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from hashlib import sha256
from pathlib import Path

from msgspec import Struct, field

from planmethod.errors import OutputError
from planmethod.problem.source import SIZE_LIMIT
from planmethod.render.backends.output import write
from planmethod.studio.requests import Bucket, StudioLimits


class StudioSession(Struct):
    """One open page (сеанс).

    Attributes
    ----------
    key : str
        Told to the page alone; also in the addresses of the files made for it.
    folder : Path
    trusted : bool
        An instructor's.
    used : float
        Time of the last request, s.
    count : int
        Computations so far.
    """

    key: str
    folder: Path
    trusted: bool
    used: float
    count: int = 0
    bucket: Bucket = field(default_factory=Bucket)

    @property
    def works(self) -> Path:
        """Folder of the uploaded submissions."""
        return self.folder / "works"

    def new_folder(self, stored: int) -> tuple[int, Path]:
        """Return the number and the folder of one more computation; old ones go."""
        self.count += 1
        folder = self.folder / str(self.count)
        folder.mkdir()
        shutil.rmtree(self.folder / str(self.count - stored), ignore_errors=True)
        return self.count, folder

    def file(self, number: str, name: str) -> Path | None:
        """Return a file that computation of a number made; None of any other path."""
        root = self._output_folder(number)
        if root is None or "\0" in name:
            return None
        with contextlib.suppress(OSError):  # no system has so long a name
            path = (root / name).resolve()
            return path if path.is_relative_to(root) and path.is_file() else None
        return None

    def _output_folder(self, number: str) -> Path | None:
        """Return the output folder of a computation; None if it has none, or does not exist."""
        if re.fullmatch("[1-9][0-9]{0,8}", number) is None:
            return None
        root = (self.folder / number / "out").resolve()
        return root if root.is_dir() else None

    def zipped(self, number: str) -> bytes | None:
        """Return the files of a computation as one archive; None where there are none."""
        made, folder = io.BytesIO(), self._output_folder(number)
        if folder is None:
            return None
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as book:
            for path in sorted(folder.rglob("*")):
                if path.is_file():
                    book.write(path, path.relative_to(folder).as_posix())
        return made.getvalue()

    def uploaded(self) -> int:
        """Return the size of all submissions, bytes."""
        return sum(path.stat().st_size for path in self.works.glob("*"))


class Sessions:
    """All sessions (сеансы), those that are not used any more cleaned away."""

    def __init__(
        self, root: Path, limits: StudioLimits, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.root, self.limits, self.clock = root, limits, clock
        self._by_key: dict[str, StudioSession] = {}
        self._doors: dict[str, Bucket] = {}

    def __len__(self) -> int:
        return len(self._by_key)

    def enter(
        self, address: str, *, trusted: bool, is_busy: Callable[[str], bool] = lambda key: False
    ) -> StudioSession | None:
        """Return a new session; None where there are too many, or too many from an address.

        Who is trusted is let in however many there are.

        Parameters
        ----------
        is_busy : callable
            Tells of the key of a session whether something is computed for it.
        """
        self.clean()
        limits, now = self.limits, self.clock()
        if not trusted:
            door = self._doors.setdefault(address, Bucket())
            if not door.admit(now, rate=limits.entries, burst=limits.entered):
                return None
        if len(self) >= limits.sessions:
            idle = [one for one in self._by_key.values() if not is_busy(one.key)]
            idle = [one for one in idle if trusted or not one.trusted]
            if idle:
                self._end(min(idle, key=lambda one: one.used))
            elif not trusted:
                return None
        key = secrets.token_urlsafe(24)
        folder = self.root / sha256(key.encode()).hexdigest()[:32]
        (folder / "works").mkdir(parents=True)
        folder.chmod(0o700)
        self._by_key[key] = StudioSession(key, folder, trusted, now)
        return self._by_key[key]

    def of(self, key: str) -> StudioSession | None:
        """Return the session of a key."""
        session = self._by_key.get(key)
        if session is not None:
            session.used = self.clock()
        return session

    def clean(self) -> None:
        """Remove what was not used for long."""
        now = self.clock()
        for session in [*self._by_key.values()]:
            if now - session.used > self.limits.idle:
                self._end(session)
        full = self.limits.entered / self.limits.entries
        self._doors = {a: door for a, door in self._doors.items() if now - door.then < full}

    def _end(self, session: StudioSession) -> None:
        del self._by_key[session.key]
        shutil.rmtree(session.folder, ignore_errors=True)


PREFIX = "planmethod-studio-"
LOCK = "lock"
"""File in the folder of a server that it holds as long as it lives."""


@contextmanager
def served_folder() -> Iterator[Path]:
    """Give the folder of a server; those that servers have left that were killed are removed.

    A folder may be removed if its lock is the user's own and not held: the system releases it
    when a server ends, however that happens.
    """
    parent = Path(tempfile.gettempdir())
    for folder in parent.glob(f"{PREFIX}*"):
        with contextlib.suppress(OSError), _try_lock(folder / LOCK, new=False) as is_held:
            if is_held and not folder.is_symlink():
                shutil.rmtree(folder, ignore_errors=True)
    with (
        tempfile.TemporaryDirectory(prefix=PREFIX) as name,
        _try_lock(Path(name) / LOCK, new=True),
    ):
        yield Path(name)


@contextmanager
def _try_lock(path: Path, *, new: bool) -> Iterator[bool]:
    """Hold a lock if it is free; yield False if the system has no locks."""
    if sys.platform == "win32":
        yield False
        return
    import fcntl

    flags = os.O_RDWR | os.O_NOFOLLOW | (os.O_CREAT | os.O_EXCL if new else os.O_NONBLOCK)
    number = os.open(path, flags, 0o600)
    try:
        found = os.fstat(number)
        is_ours = stat.S_ISREG(found.st_mode) and found.st_uid == os.getuid()
        try:
            fcntl.flock(number, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            is_ours = False
        yield is_ours
    finally:
        os.close(number)


class Desk(Struct, frozen=True):
    """The file or folder edited on one's own machine (рабочее место)."""

    path: Path

    @property
    def names(self) -> list[str]:
        """The problem files there are."""
        if self.path.is_dir():
            return sorted(path.name for path in self.path.glob("*.toml") if path.is_file())
        return [self.path.name]

    def at(self, name: str) -> Path | None:
        """Return the path of a name; None if it is not a plain name of a problem file."""
        folder = self.path if self.path.is_dir() else self.path.parent
        is_one = self.path.is_dir() or name == self.path.name
        plain = re.fullmatch(r"[^/\\:\0]{1,200}\.toml", name) and not name.startswith(".")
        return folder / name if plain and is_one else None

    def read(self, path: Path) -> tuple[str, str] | None:
        """Return the text of a file and its mark; None if it does not exist.

        Raises
        ------
        OutputError
            The file could not be saved again unchanged: it is not a plain file, too large, or
            not UTF-8.
        """
        if not path.exists():
            return None
        data = (
            path.read_bytes() if path.is_file() and path.stat().st_size <= SIZE_LIMIT else b"\xff"
        )
        try:
            return data.decode("utf-8-sig"), mark_of(data)
        except UnicodeDecodeError:
            phrase = (
                "{}: the page edits UTF-8 files of at most {} KiB, and does not change this one."
            )
            raise OutputError(phrase, path.name, SIZE_LIMIT // 1024) from None

    def save(self, path: Path, text: str, known_mark: str, *, over: bool) -> tuple[str, str] | None:
        """Write a text; on a conflict, return the other editor's version instead.

        Raises
        ------
        OutputError
            It cannot be written, or the existing file is not such a text.
        """
        there = self.read(path)
        if there is not None and there[1] != known_mark and not over:
            return there
        write(path, text.encode())
        return None


def mark_of(data: bytes) -> str:
    """Return the fingerprint of a file's contents."""
    return sha256(data).hexdigest()[:16]
