"""Folders by session, nobody's but who has the key; and the file that is edited (сеансы)."""

from __future__ import annotations

import io
import re
import secrets
import shutil
import time
import zipfile
from collections.abc import Callable
from hashlib import sha256
from pathlib import Path

from msgspec import Struct, field

from planmethod.problem.source import SIZE_LIMIT
from planmethod.render.backends.output import write
from planmethod.studio.limits import Bucket, StudioLimits


class StudioSession(Struct):
    """Who has one page open (сеанс).

    Attributes
    ----------
    key : str
        Told to the page alone; also in the addresses of the files made for it.
    folder : Path
    trusted : bool
        An instructor's.
    used : float
        When something was asked the last time, s.
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
        """Folder of the works that were dropped."""
        return self.folder / "works"

    def new_folder(self, kept: int) -> tuple[int, Path]:
        """Return the number and the folder of one more computation; old ones go."""
        self.count += 1
        folder = self.folder / str(self.count)
        folder.mkdir()
        shutil.rmtree(self.folder / str(self.count - kept), ignore_errors=True)
        return self.count, folder

    def file(self, number: str, name: str) -> Path | None:
        """Return a file that computation of a number made; None of any other path."""
        root = (self.folder / number / "out").resolve()
        path = (root / name).resolve()
        return path if path.is_relative_to(root) and path.is_file() else None

    def zipped(self, number: str) -> bytes:
        """Return the files of a computation as one archive."""
        made, folder = io.BytesIO(), self.folder / number / "out"
        with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as book:
            for path in sorted(folder.rglob("*")):
                if path.is_file():
                    book.write(path, path.relative_to(folder).as_posix())
        return made.getvalue()

    def uploaded(self) -> int:
        """Return how many bytes of works there are."""
        return sum(path.stat().st_size for path in self.works.glob("*"))


class Sessions:
    """All sessions (сеансы), those that are not used any more cleaned away."""

    def __init__(
        self, root: Path, limits: StudioLimits, clock: Callable[[], float] = time.monotonic
    ) -> None:
        self.root, self.limits, self.clock = root, limits, clock
        self._found: dict[str, StudioSession] = {}
        self._doors: dict[str, Bucket] = {}

    def __len__(self) -> int:
        return len(self._found)

    def enter(self, address: str, *, trusted: bool) -> StudioSession | None:
        """Return a new session; None where there are too many, or too many from an address."""
        self.clean()
        door = self._doors.setdefault(address, Bucket())
        limits, now = self.limits, self.clock()
        if len(self) >= limits.sessions or not door.takes(
            now, rate=limits.entries, burst=limits.entered
        ):
            return None
        key = secrets.token_urlsafe(24)
        folder = self.root / sha256(key.encode()).hexdigest()[:32]
        (folder / "works").mkdir(parents=True)
        folder.chmod(0o700)
        self._found[key] = StudioSession(key, folder, trusted, now)
        return self._found[key]

    def of(self, key: str) -> StudioSession | None:
        """Return the session of a key."""
        session = self._found.get(key)
        if session is not None:
            session.used = self.clock()
        return session

    def clean(self) -> None:
        """Remove what was not used for long."""
        now = self.clock()
        for key, session in [*self._found.items()]:
            if now - session.used > self.limits.idle:
                del self._found[key]
                shutil.rmtree(session.folder, ignore_errors=True)
        full = self.limits.entered / self.limits.entries
        self._doors = {a: door for a, door in self._doors.items() if now - door.then < full}


class Desk(Struct, frozen=True):
    """The file or the folder that one edits on one's own machine (рабочее место)."""

    path: Path

    @property
    def names(self) -> list[str]:
        """The problem files there are."""
        if self.path.is_dir():
            return sorted(path.name for path in self.path.glob("*.toml") if path.is_file())
        return [self.path.name]

    def at(self, name: str) -> Path | None:
        """Return the path of a name; None where it is no plain name of a problem file."""
        folder = self.path if self.path.is_dir() else self.path.parent
        is_one = self.path.is_dir() or name == self.path.name
        plain = re.fullmatch(r"[^/\\:\0]{1,200}\.toml", name) and not name.startswith(".")
        return folder / name if plain and is_one else None

    def read(self, path: Path) -> tuple[str, str] | None:
        """Return the text of a file and its mark; None where there is none."""
        try:
            with path.open("rb") as file:
                data = file.read(SIZE_LIMIT + 1)
        except OSError:
            return None
        return data.decode("utf-8-sig", "replace"), mark_of(data)

    def save(self, path: Path, text: str, seen: str, *, over: bool) -> tuple[str, str] | None:
        """Write a text; return what another editor left there meanwhile instead, None of nothing.

        Raises
        ------
        OutputError
        """
        there = self.read(path)
        if there is not None and there[1] != seen and not over:
            return there
        write(path, text.encode())
        return None


def mark_of(data: bytes) -> str:
    """Return what tells two states of a file apart."""
    return sha256(data).hexdigest()[:16]
