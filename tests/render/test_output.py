"""Files are written whole or not at all, and every failure names the next action."""

from __future__ import annotations

import errno
import os
from pathlib import Path

import pytest
from doors import ExitCode, OutputError, output_write as write


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_write_leaves_the_bytes_and_no_other_file(tmp_path: Path) -> None:
    write(tmp_path / "лист 1.svg", b"\x00\r\n<svg/>")
    assert (tmp_path / "лист 1.svg").read_bytes() == b"\x00\r\n<svg/>"
    assert names(tmp_path) == ["лист 1.svg"]


def test_replaces_and_makes_missing_directories(tmp_path: Path) -> None:
    path = tmp_path / "out" / "deep" / "sheet.pdf"
    write(path, b"old and longer")
    write(str(path), b"new")
    assert path.read_bytes() == b"new"
    assert names(path.parent) == ["sheet.pdf"]


@pytest.mark.skipif(os.name != "posix", reason="permission bits of POSIX")
@pytest.mark.parametrize("umask", [0o022, 0o077, 0o002])
def test_new_file_has_the_permissions_of_the_umask(tmp_path: Path, umask: int) -> None:
    before = os.umask(umask)
    try:
        write(tmp_path / "a.svg", b"")
    finally:
        os.umask(before)
    assert (tmp_path / "a.svg").stat().st_mode & 0o777 == 0o666 & ~umask


@pytest.mark.skipif(os.name != "posix", reason="permission bits of POSIX")
def test_existing_file_keeps_its_permissions(tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    path.write_bytes(b"old")
    path.chmod(0o640)
    write(path, b"new")
    assert path.stat().st_mode & 0o777 == 0o640


def test_symbolic_link_is_followed(tmp_path: Path) -> None:
    (tmp_path / "real.svg").write_bytes(b"old")
    link = tmp_path / "link.svg"
    try:
        link.symlink_to(tmp_path / "real.svg")
    except OSError:
        pytest.skip("no symbolic links here")
    write(link, b"new")
    assert link.is_symlink()
    assert (tmp_path / "real.svg").read_bytes() == b"new"


def test_a_dangling_link_creates_no_file_elsewhere(tmp_path: Path) -> None:
    (tmp_path / "out").mkdir()
    for name, target in (("a.svg", "else/new/a.svg"), ("b.svg", "b.svg"), ("pages", "else/pages")):
        (tmp_path / "out" / name).symlink_to(tmp_path / target)
    for name in ("a.svg", "b.svg", "pages/c.svg"):
        with pytest.raises(OutputError, match=r"Remove the link|is a file, not a directory"):
            write(tmp_path / "out" / name, b"new")
    assert [path.name for path in tmp_path.iterdir()] == ["out"]


def test_a_directory_is_rejected(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="it is a directory") as caught:
        write(tmp_path, b"x")
    assert caught.value.exit_code == ExitCode.USAGE


def test_a_device_is_rejected_and_survives() -> None:
    if not Path("/dev/null").is_char_device():
        pytest.skip("no /dev/null here")
    with pytest.raises(OutputError, match="not a regular file"):
        write("/dev/null", b"x")
    assert Path("/dev/null").is_char_device()


def test_file_in_the_place_of_a_directory(tmp_path: Path) -> None:
    (tmp_path / "out").write_bytes(b"keep")
    for path in (tmp_path / "out" / "a.svg", tmp_path / "out" / "deep" / "a.svg"):
        with pytest.raises(OutputError, match="a part of the path is a file"):
            write(path, b"x")
    assert (tmp_path / "out").read_bytes() == b"keep"


def test_name_too_long(tmp_path: Path) -> None:
    with pytest.raises(OutputError, match="the name is too long"):
        write(tmp_path / ("щ" * 300 + ".svg"), b"x")
    assert names(tmp_path) == []


def test_longest_name_still_works(tmp_path: Path) -> None:
    name = "a" * 251 + ".svg"
    write(tmp_path / name, b"x")
    assert names(tmp_path) == [name]


def test_no_permission(tmp_path: Path) -> None:
    tmp_path.chmod(0o500)
    try:
        if os.access(tmp_path, os.W_OK):
            pytest.skip("this user may write everywhere")
        with pytest.raises(OutputError, match=r"no permission\. Choose another directory"):
            write(tmp_path / "a.svg", b"x")
    finally:
        tmp_path.chmod(0o700)


def test_write_protected_file_is_kept(tmp_path: Path) -> None:
    path = tmp_path / "a.svg"
    path.write_bytes(b"old")
    path.chmod(0o400)
    if os.access(path, os.W_OK):
        pytest.skip("this user may write everywhere")
    with pytest.raises(OutputError, match="write-protected"):
        write(path, b"new")
    assert path.read_bytes() == b"old"


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (errno.ENOSPC, "no space left on the device. Free some space"),
        (errno.EACCES, "no permission. Choose another directory with --out"),
        (errno.EROFS, "read-only. Choose another directory"),
        (errno.EIO, "Check the path"),
    ],
)
def test_failure_keeps_the_old_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, code: int, words: str
) -> None:
    path = tmp_path / "a.svg"
    path.write_bytes(b"old")

    def fail(self: Path, target: Path) -> Path:
        assert self.read_bytes() == b"new"
        raise OSError(code, os.strerror(code))

    monkeypatch.setattr(Path, "replace", fail)
    with pytest.raises(OutputError, match=words) as caught:
        write(path, b"new")
    assert str(path) in str(caught.value)
    assert path.read_bytes() == b"old"
    assert names(tmp_path) == ["a.svg"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full here")
def test_disk_that_is_really_full(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    real = Path.open

    def on_full_disk(self: Path, mode: str = "r") -> object:
        real(self, mode).close()
        return real(Path("/dev/full"), "wb")

    monkeypatch.setattr(Path, "open", on_full_disk)
    with pytest.raises(OutputError, match="no space left"):
        write(tmp_path / "a.svg", b"x" * 100_000)
    assert names(tmp_path) == []


def test_interrupt_leaves_no_temporary_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupt(self: Path, target: Path) -> Path:
        raise KeyboardInterrupt

    monkeypatch.setattr(Path, "replace", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write(tmp_path / "a.svg", b"x")
    assert names(tmp_path) == []
