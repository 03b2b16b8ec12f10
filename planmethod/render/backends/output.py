"""Write a produced file whole or not at all."""

from __future__ import annotations

import contextlib
import errno
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import BinaryIO, NoReturn

from planmethod.errors import OutputError
from planmethod.languages import translate

UNFINISHED = ".planmethod-*.tmp"
"""Name of a file or folder until it is complete; a killed process leaves one behind."""

_CAUSES = {
    errno.EACCES: "no permission. Choose another directory with --out, or close the program that "
    "holds the file open",
    errno.EPERM: "not permitted. Choose another directory with --out",
    errno.EROFS: "the file system is read-only. Choose another directory with --out",
    errno.ENOSPC: "no space left on the device. Free some space, or choose another directory "
    "with --out",
    errno.EDQUOT: "the disk quota is used up. Free some space, or choose another directory "
    "with --out",
    errno.EFBIG: "the file is larger than the system's limit for this user. Raise the limit "
    "(ulimit -f), or request less",
    errno.ENAMETOOLONG: "the name is too long. Choose a shorter one",
    errno.ENOTDIR: "a part of the path is a file, not a directory. Choose another directory "
    "with --out",
    errno.EEXIST: "a part of the path is a file, not a directory. Choose another directory "
    "with --out",
    errno.ELOOP: "symbolic links form a loop. Remove one of them",
}


def write(path: Path | str, data: bytes, *, output_root: Path | None = None) -> None:
    """Write ``data`` to ``path`` whole or not at all, see `opened`.

    Raises
    ------
    OutputError
        The file cannot be written; the message says why and what to do.
    """
    with opened(path, output_root=output_root) as file:
        file.write(data)


def write_all(
    folder: Path,
    files: Mapping[str, bytes],
    *,
    obsolete: Iterable[str] = (),
    output_root: Path | None = None,
) -> None:
    """Write files into a folder, all of them or none.

    They are first written into a temporary folder; other files of the folder stay.

    Parameters
    ----------
    files : mapping of str to bytes
        By their names in the folder.
    obsolete : iterable of str
        Names of older files that are removed afterwards.
    output_root : Path, optional
        The folder of ``--out``: a link that leads out of it is refused.

    Raises
    ------
    OutputError
        One of them cannot be written; the message says why and what to do.
    """
    made = not folder.exists()
    _require_inside(folder, output_root)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        modes = {name: _preserved_mode(folder / name, folder / name) for name in files}
        aside = folder / f".planmethod-{os.urandom(6).hex()}.tmp"
        aside.mkdir()
        try:
            for name, data in files.items():
                (aside / name).write_bytes(data)
                if (mode := modes[name]) is not None:
                    (aside / name).chmod(mode)
            for name in files:
                (aside / name).replace(folder / name)
            for name in obsolete:
                (folder / name).unlink(missing_ok=True)
        finally:
            shutil.rmtree(aside, ignore_errors=True)
            if made:
                with contextlib.suppress(OSError):
                    folder.rmdir()  # only where nothing was written
    except OSError as error:
        _explain(folder, error)


@contextlib.contextmanager
def opened(path: Path | str, *, output_root: Path | None = None) -> Iterator[BinaryIO]:
    """Open a file for bytes that appear at ``path`` whole or not at all.

    The bytes go to a temporary file beside ``path``, which takes its place when the block ends: a
    reader sees the old file or the new one, and a failure leaves what was there. Missing
    directories are made; a symbolic link to an existing file is followed, a dangling one is
    rejected; an existing file keeps its permissions.

    Parameters
    ----------
    output_root : Path, optional
        The folder of ``--out``: a link that leads out of it is refused, of a file or of a folder.

    Raises
    ------
    OutputError
        The file cannot be written; the message says why and what to do.
    """
    asked = Path(path)
    _require_inside(asked, output_root)
    try:
        # Before links are followed: no directory is made at the target of one.
        asked.parent.mkdir(parents=True, exist_ok=True)
        target = resolve_output_path(asked)
        mode = _preserved_mode(target, asked)
        temporary = target.with_name(f".planmethod-{os.urandom(6).hex()}.tmp")
        try:
            # "x": never through a link or a file that somebody put there; permissions by umask.
            with temporary.open("xb") as file:
                yield file
            if mode is not None:
                temporary.chmod(mode)
            temporary.replace(target)
        except BaseException:
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
            raise
    except OSError as error:
        _explain(asked, error)


def _require_inside(path: Path, output_root: Path | None) -> None:
    """Refuse a path that links lead out of a folder; the folder itself may be a link."""
    if output_root is None:
        return
    target, root = Path(os.path.realpath(path)), Path(os.path.realpath(output_root))
    if not target.is_relative_to(root):
        raise OutputError(
            "Cannot write {}: a link leads to {}, out of the folder {}. Remove the link.",
            path,
            target,
            output_root,
        )


def resolve_output_path(path: Path, *, output_root: Path | None = None) -> Path:
    """Return the file that a path leads to; ``output_root`` as in `opened`.

    Raises
    ------
    OutputError
        It is a dangling link, or a link out of the folder.
    """
    _require_inside(path, output_root)
    target = Path(os.path.realpath(path))
    if path.is_symlink() and not target.exists():
        raise OutputError(
            "Cannot write {}: it is a link to {}, which does not exist. Remove the link.",
            path,
            target,
        )
    return target


def _preserved_mode(target: Path, path: Path) -> int | None:
    """Return the permissions of a replaceable file; reject any other existing path."""
    if target.is_dir():
        raise OutputError("Cannot write {}: it is a directory. Give the name of a file.", path)
    if not target.exists():
        return None
    if not target.is_file():
        # Renaming over a device or a pipe would destroy it.
        raise OutputError("Cannot write {}: it is not a regular file. Choose another name.", path)
    if not os.access(target, os.W_OK):
        raise OutputError(
            "Cannot write {}: the file is write-protected. Remove the protection, or "
            "choose another directory with --out.",
            path,
        )
    return target.stat().st_mode & 0o777


def _explain(path: Path, error: OSError) -> NoReturn:
    raise OutputError("Cannot write {}: {}.", path, cause_of(error)) from error


def cause_of(error: OSError) -> str:
    """Return why a file cannot be written, and what to do, without the last point."""
    other = translate("{}. Check the path", error.strerror or error)
    return translate(_CAUSES[error.errno]) if error.errno in _CAUSES else other


def unwritten(error: Exception) -> OSError | None:
    """Return the system error behind an error of a writing library, or None.

    Libraries that write XML by libxml2 (a workbook, in a temporary folder) report it in its words.
    """
    if isinstance(error, OSError):
        return error
    name = str(error).removeprefix("IO_")
    number = getattr(errno, name, None) if type(error).__name__ == "SerialisationError" else None
    return None if number is None else OSError(number, os.strerror(number))
