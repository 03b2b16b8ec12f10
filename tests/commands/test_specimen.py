"""Command specimen: its sheets, files and errors."""

from __future__ import annotations

from pathlib import Path

import pytest
from click.testing import CliRunner, Result
from doors import SPECIMENS, ExitCode, cli


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def run(*args: str) -> Result:
    return CliRunner().invoke(cli, ["specimen", *args])


def made(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


def test_all_sheets_are_drawn_by_default(tmp_path: Path) -> None:
    done = run()
    assert done.exit_code == ExitCode.DONE, done.output
    names = {f"specimen-{name}.{fmt}" for name in SPECIMENS for fmt in ("svg", "pdf")}
    assert made(tmp_path / "out") == names
    assert {Path(line).name for line in done.stdout.splitlines()} == names


def test_named_sheets_once_each(tmp_path: Path) -> None:
    done = run("Symbols", "symbols", "--format", "svg", "-o", "there")
    assert done.exit_code == ExitCode.DONE, done.output
    assert made(tmp_path / "there") == {"specimen-symbols.svg"}


def test_every_format(tmp_path: Path) -> None:
    done = run("lines", "--format", "svg,pdf,png,dxf", "--dpi", "40", "--dxf-text", "strokes")
    assert done.exit_code == ExitCode.DONE, done.output
    assert made(tmp_path / "out") == {
        f"specimen-lines.{fmt}" for fmt in ("svg", "pdf", "png", "dxf")
    }
    assert (tmp_path / "out/specimen-lines.png").read_bytes().startswith(b"\x89PNG")


def test_the_title_block_is_filled(tmp_path: Path) -> None:
    assert run("lines", "--format", "svg", "--stamp", "author=Иванов").exit_code == ExitCode.DONE
    assert "Иванов" in (tmp_path / "out/specimen-lines.svg").read_text("utf-8")
    refused = run("lines", "--stamp", "autor=Иванов")
    assert refused.exit_code == ExitCode.USAGE
    assert "Did you mean 'author'?" in refused.output


def test_an_unknown_sheet_is_rejected_with_the_known_names(tmp_path: Path) -> None:
    refused = run("symbol")
    assert refused.exit_code == ExitCode.USAGE
    assert "no specimen sheet 'symbol'; did you mean 'symbols'?" in refused.output
    assert "Known: symbols, lines, lettering" in refused.output
    assert "Traceback" not in refused.output
    assert not (tmp_path / "out").exists()


def test_the_help_names_the_sheets() -> None:
    told = run("--help").output
    assert "docs/reference/specimens.md" in told
    for name in SPECIMENS:
        assert name in told


def test_the_same_bytes_every_time() -> None:
    first = run("symbols", "--format", "svg,dxf", "-o", "one")
    second = run("symbols", "--format", "svg,dxf", "-o", "two")
    assert first.exit_code == second.exit_code == ExitCode.DONE
    for fmt in ("svg", "dxf"):
        name = f"specimen-symbols.{fmt}"
        assert Path("one", name).read_bytes() == Path("two", name).read_bytes()
