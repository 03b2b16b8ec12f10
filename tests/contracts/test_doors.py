"""Hostile input: no traceback, no exit 5, bounded work, no raw bytes on the terminal."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tomllib
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest
from cases import is_thinned
from click.testing import CliRunner, Result
from doors import (
    _HEADER,
    _LITERAL,
    VIEWS,
    CamDesign,
    Drawing,
    Text,
    cli,
    get_language,
    is_label,
    largest_part,
    partial_mechanism as part_module,
    read_parsed,
    sketch,
    without_variants,
)
from worked import ROOT, path_of

from benchmarks.attack.patterns import patterns, slow

EX3 = path_of("linkages/ex3")
FOUR_BAR = """
title = "x"
[frame]
O = [0, 0]
C = {c}
[links.1]
points = ["O", "A"]
OA = 0.1
[links.2]
points = [{points}]
AB = {rod}
[links.3]
points = ["C", "B"]
CB = 0.4
[driver]
link = "1"
phi = 30
omega = 10
[assembly]
B = "above C"
"""


def run(*words: str) -> Result:
    return CliRunner().invoke(cli, words)


def process(
    *words: str | bytes, env: dict[str, str] | None = None, folder: Path = ROOT
) -> subprocess.CompletedProcess[bytes]:
    return subprocess.run(
        [sys.executable, "-m", "planmethod", *words],
        env={**os.environ, "PYTHONPATH": str(ROOT), **(env or {})},
        cwd=folder,
        capture_output=True,
        timeout=120,
    )


# Patterns ----------------------------------------------------------------------------------------


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timer of processor time")
def test_no_pattern_takes_a_power_of_the_length_of_its_text() -> None:
    """One that does takes minutes for such a text, the others milliseconds."""
    found = list(patterns())
    assert len(found) > 100
    every = 8 if is_thinned() else 1
    bad = [(where, p, slow(p, anywhere, 1 << 14)) for where, p, anywhere in found[::every]]
    assert not [one for one in bad if one[2]]
    assert slow(r"(?m)^[ \t]*\[?[ \t]*x", True, 1 << 16)  # its result
    assert slow(r"[^\W_]+(?:[- ]?[^\W_]+)*\Z", False, 100)


def test_a_long_line_is_rejected_before_it_is_parsed(tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(f'title = "x"\n{" " * 100_000}\n')
    for command in ("solve", "sheet", "lint", "audit"):
        result = run(command, str(path))
        assert (result.exit_code, "line 2 has 100000 characters" in result.output) == (3, True)
    assert not is_label("a" * 23 + "!")  # it took a second


def test_texts_of_variants_take_no_power_of_their_length() -> None:
    assert not slow(_HEADER, False, 1 << 14)
    assert not slow(_LITERAL, True, 1 << 14)
    text = "[a]\nb = 1\n[variants.x]\nc = 2\n['d'.e]\nf = 3\n[[ variants . y ]]  # z\n"
    assert without_variants(text) == "[a]\nb = 1\n['d'.e]\nf = 3\n"
    assert re.findall(_LITERAL, "2*t^3 + .5*x1 - 4.*12.5e") == ["2", ".5", "4."]


def test_a_field_of_the_title_block_is_no_longer_than_in_a_file(tmp_path: Path) -> None:
    """Five thousand letters in a cell took 19 s."""
    for text in ("x" * 201, "a\tb"):
        result = run("sheet", str(EX3), "--stamp", f"title={text}", "-o", str(tmp_path))
        assert (result.exit_code, "title: the text has " in result.output) == (2, True)
    result = run("specimen", "lines", "--stamp", f"title={'x' * 200}", "-o", str(tmp_path))
    assert result.exit_code == 0, result.output


def test_a_cam_is_designed_once_for_all_positions(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is designed once for each mistake, too; before, the form took 8 s, others 15 s."""
    made: list[CamDesign] = []
    limited = CamDesign.limited

    def noted(own: CamDesign) -> Any:
        if not any(own is one for one in made):
            made.append(own)
        return limited(own)

    monkeypatch.setattr(CamDesign, "limited", noted)
    result = run("form", str(path_of("cams/groove")), "-o", str(tmp_path))
    assert result.exit_code == 0, result.output
    assert 0 < len(made) <= 5


# Late errors --------------------------------------------------------------------------------------


def test_a_late_error_names_the_file(tmp_path: Path) -> None:
    path = tmp_path / "f.toml"
    path.write_bytes(EX3.read_bytes())
    for words in (
        ("--layout", "flywheel"), ("--layout", "balancing"), ("--position", "3"),
        ("--phi", "0:359:1"), ("--layout", "forces"),
    ):  # fmt: skip
        result = run("sheet", str(path), *words, "-o", str(tmp_path))
        assert result.exit_code in (2, 3)
        assert result.output.startswith(f"Error: {path}: "), result.output


@pytest.mark.parametrize("variant", [None, "ε"])
def test_warnings_and_usage_errors_name_the_file(variant: str | None, tmp_path: Path) -> None:
    path = tmp_path / "p.toml"
    text = path_of("linkages/ex3").read_text("utf-8")
    path.write_text(f'{text}\n[point]\n[variants."ε".driver]\nphi = 31\n', "utf-8")
    of_variant = () if variant is None else ("--variant", variant)
    called = str(path) if variant is None else "p-ε"
    told = run("solve", str(path), *of_variant)
    assert told.exit_code == 0, told.output
    assert told.stderr == f"Warning: {called}: [point] is ignored; write it into a separate file.\n"
    for command in ("solve", "protocol"):
        refused = run(command, str(path), "--position", "7", *of_variant)
        assert refused.exit_code == 2
        assert f"Error: --position 7: the last of {called} is 0" in refused.output


def test_a_layout_without_contents_is_reported(tmp_path: Path) -> None:
    path = tmp_path / "l.toml"
    sizes = "[sizes]\nA3 = { letter = 3.5, title = 5, text = 3.5, column = 200 }\n"
    path.write_text(
        f'formats = ["A3"]\nper_sheet = [36]\n{sizes}[[blocks]]\nkind = "graphs"\n', "utf-8"
    )
    result = run("sheet", str(EX3), "--layout", str(path), "-o", str(tmp_path))
    assert result.exit_code == 2, result.output
    assert "All blocks of the layout are empty" in result.output


# Sketches ----------------------------------------------------------------------------------------


def drawn(text: str) -> Drawing:
    part = largest_part(tomllib.loads(text), source="x", name="x", views=VIEWS)
    return sketch(part, "", get_language("en"), [])


def four_bar(points: Sequence[str] = ("A", "B"), c: str = "[0.3, 0]", rod: str = "0.3") -> str:
    return FOUR_BAR.format(points=", ".join(f'"{p}"' for p in points), c=c, rod=rod)


@pytest.mark.parametrize(
    "c", ["[nan, 0]", "[0.3, inf]", "[0.2, nan]", "[1e300, 0]", f"[0, 1{'0' * 400}]"]
)
def test_a_fixed_point_that_is_nowhere_is_not_drawn(c: str) -> None:
    assert drawn(four_bar(c=c))


def test_points_named_again_and_again_are_marked_once() -> None:
    texts = [i.text for i in drawn(four_bar(["A", "B", "O"] * 100)).items if isinstance(i, Text)]
    assert sum(text.startswith("2?") for text in texts) <= 3


def test_a_scale_that_fits_no_paper_is_another_one_on_a_sketch(tmp_path: Path) -> None:
    """At that of the file the axis of a guide is of a million strokes, and takes gigabytes."""
    path = tmp_path / "x.toml"
    path.write_text(re.sub("mu_l = .*", "mu_l = 1e-9", EX3.read_text("utf-8")), "utf-8")
    out = str(tmp_path)
    assert run("sketch", str(path), "-o", out).exit_code == 0
    assert (tmp_path / "x-sketch.svg").stat().st_size < 100_000
    for command in ("sheet", "project", "note"):
        result = run(command, str(path), "-o", out)
        assert result.exit_code == 2, result.output
        assert "coarser scales" in result.output


def test_a_sketch_tries_no_more_mechanisms_than_it_may(monkeypatch: pytest.MonkeyPatch) -> None:
    tried: set[tuple[str, ...]] = set()

    def noted(table: dict[str, Any], **more: Any) -> Any:
        tried.add(tuple(table["links"]))
        return read_parsed(table, **more)

    monkeypatch.setattr(part_module, "read_parsed", noted)
    links = "".join(f'[links.a{n}]\npoints = ["O", "P", "Q{n}"]\nOP = 0.2\n' for n in range(58))
    largest_part(tomllib.loads(four_bar() + links), source="x", name="x", views=VIEWS)
    assert part_module.TRIES // 2 < len(tried) <= part_module.TRIES + 1  # and the whole file


# The terminal ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "text",
    ['title = "ok\x1b]0;owned\x07"', 'title = "ok"\n"a" \x1b[2J\u202etxt', "om\u202ega = 1",
     'title = "x"\n"\\u001b[31m" = 1', 'title = "\\u202eab"\n[frame]', 'units = "\\u001b[2J"'],
)  # fmt: skip
def test_no_order_of_a_file_reaches_the_terminal(text: str, tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text(text, "utf-8")
    for lang in ("ru", "en"):
        result = run("solve", str(path), "--lang", lang)
        assert result.exit_code == 3
        assert all(c.isprintable() or c in "\n\u00a0" for c in result.output), result.output


@pytest.mark.parametrize("command", ["check --key -o {out}", "form -o {out}"])
def test_a_number_beyond_all_bounds_is_rejected(command: str, tmp_path: Path) -> None:
    path = tmp_path / "x.toml"
    path.write_text('title = "x"\n[point]\nx = "18*t"\ny = "24*sh(t)"\nt = 360\n')
    assert run(*command.format(out=tmp_path).split(), str(path)).exit_code == 3


# Encodings, the environment, Ctrl+C --------------------------------------------------------------


@pytest.mark.skipif(sys.platform != "linux", reason="file names are bytes")
def test_arguments_that_are_not_utf8_are_reported(tmp_path: Path) -> None:
    path = os.fsencode(tmp_path) + b"/n\xff.toml"
    with open(path, "wb") as file:  # noqa: PTH123 - no name in UTF-8
        file.write(EX3.read_bytes())
    for words in (
        ("solve", "--json", path),
        ("sheet", str(EX3), "--stamp", b"author=\xff", "-o", str(tmp_path / "out")),
    ):
        done = process(*words, "--lang", "en")
        assert (done.returncode, b"is not UTF-8" in done.stderr) == (2, True), done.stderr
    assert not (tmp_path / "out").exists()


def test_a_date_of_the_environment_is_in_no_file(tmp_path: Path) -> None:
    for number, date in enumerate(("abc", "1700000000")):
        done = process(
            "sheet", str(EX3), "--format", "svg", "--format", "pdf",
            "-o", str(tmp_path / str(number)),
            env={"SOURCE_DATE_EPOCH": date},
        )  # fmt: skip
        assert done.returncode == 0, done.stderr
    made = [sorted((p.name, p.read_bytes()) for p in (tmp_path / n).iterdir()) for n in "01"]
    assert made[0] == made[1]
    assert [name for name, _ in made[0]] == ["ex3.pdf", "ex3.svg"]  # both --format count


def test_a_missing_library_is_reported(tmp_path: Path) -> None:
    (tmp_path / "reportlab.py").write_text("raise ImportError('libx.so: cannot open')")
    done = process(
        "sheet", str(EX3), "--format", "pdf", "--lang", "en", "-o", str(tmp_path / "out"),
        env={"PYTHONPATH": f"{tmp_path}{os.pathsep}{ROOT}"},
    )  # fmt: skip
    assert (done.returncode, b"libx.so" in done.stderr) == (2, True), done.stderr


PRESSED = """
import os, signal, sys

def press(event, args, pressed=[]):
    if (event, True) == ({event!r}, {word!r} in str(args[0])) and not pressed:
        pressed.append(event)
        os.kill(os.getpid(), signal.SIGINT)

sys.addaudithook(press)
"""
"""Code that presses Ctrl+C in its process at a certain event, whenever that happens."""


@pytest.mark.skipif(os.name != "posix", reason="signals")
@pytest.mark.parametrize(
    ("event", "word"),
    [
        ("import", "planmethod.cli"),  # at the first import of the package
        ("import", "planmethod.solved.solution"),  # in the midst of the work
        ("os.mkdir", "out"),
        ("open", ".tmp"),  # while a file is written
        ("os.rename", ".tmp"),
    ],
)
def test_ctrl_c_is_one_line_and_130(event: str, word: str, tmp_path: Path) -> None:
    (tmp_path / "sitecustomize.py").write_text(PRESSED.format(event=event, word=word))
    paths = os.pathsep.join([str(tmp_path), str(ROOT)])
    done = subprocess.run(
        [sys.executable, "-m", "planmethod", "sheet", str(EX3), "--lang", "en",
         "-o", str(tmp_path / "out")],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        check=False,
        # If the tests run in the background, the signal may be ignored.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    assert done.returncode == 130, done.stderr
    assert done.stderr.decode().strip() == "Stopped; all written files are complete."
    assert not list(tmp_path.rglob("*.tmp"))
