"""Sheets, animations and moving pages in the colours of the meanings of their lines."""

from __future__ import annotations

import re
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from doors import Drawing, Options, Pen, PenSet, Stroke, cli, render
from PIL import Image
from worked import path_of

BLUE, RED, GREEN, GREY = (
    "#" + bytes(PenSet(is_coloured=True).colour(pen)).hex()
    for pen in (Pen.RESULTANT, Pen.RELATIVE, Pen.COMPONENT, Pen.THIN)
)


def program(*arguments: str) -> None:
    done = CliRunner().invoke(cli, list(arguments))
    assert done.exit_code == 0, done.output


def colours(text: str) -> set[str]:
    return set(re.findall(r"(?:stroke|fill)=\"(#\w{6})\"", text)) - {"#000000", "#ffffff"}


@pytest.mark.parametrize("fmt", ["svg", "dxf", "png", "pdf"])
def test_every_format_has_the_colours_of_one_table(fmt: str) -> None:
    line = Stroke((1 + 5j, 9 + 5j), Pen.RELATIVE)
    plain, coloured = (
        render(Drawing(10.0, 10.0, items=[line], pens=PenSet(2.0, is_coloured)), fmt,
               options=Options(dpi=100.0))
        for is_coloured in (False, True)
    )  # fmt: skip
    assert plain != coloured
    red = bytes.fromhex(RED[1:])
    match fmt:
        case "svg":
            assert colours(coloured.decode()) == {RED}
            assert not colours(plain.decode())
        case "dxf":
            assert f"\n420\n{int.from_bytes(red, 'big')}\n" in coloured.decode()
        case "png":
            pixels = np.asarray(Image.open(BytesIO(coloured)))
            assert tuple(pixels[20, 20]) == tuple(red)
            assert np.asarray(Image.open(BytesIO(plain))).ndim == 2
        case _:
            assert len(coloured) != len(plain)


def test_a_sheet_is_coloured_by_its_option_by_its_key_and_by_its_layout(tmp_path: Path) -> None:
    problem = path_of("linkages/ex3")
    keyed = tmp_path / "keyed.toml"
    text = problem.read_text("utf-8")
    assert text.count("\n[sheet]\n") == 1
    keyed.write_text(text.replace("\n[sheet]\n", "\n[sheet]\ncolour = true\n"), "utf-8")
    layout = tmp_path / "own.toml"
    program("layouts", "one-position", str(layout))
    layout.write_text("colour = true\n" + layout.read_text("utf-8"), "utf-8")

    def drawn(path: Path, *more: str) -> set[str]:
        program("sheet", str(path), "--format", "svg", "-o", str(tmp_path), *more)
        return colours((tmp_path / f"{path.stem}.svg").read_text("utf-8"))

    assert drawn(problem) == set()
    for path, more in ((problem, ["--colour"]), (keyed, []), (problem, ["--layout", str(layout)])):
        assert drawn(path, *more) == {BLUE, RED, GREEN, GREY}
    assert drawn(keyed, "--no-colour") == set()


def test_a_gif_has_the_colours_of_the_lines(tmp_path: Path) -> None:
    problem, shown = str(path_of("linkages/ex3")), []
    for colour in ("--no-colour", "--colour"):
        program("animate", problem, "--plans", "--format", "gif", "--frames", "8", colour,
                "-o", str(tmp_path))  # fmt: skip
        with Image.open(tmp_path / "ex3-animated.gif") as picture:
            found = picture.convert("RGB").getcolors(256) or []
        shown.append({"#" + bytes(pixel).hex() for count, pixel in found if count > 9})
    assert not shown[0] & {BLUE, RED} and shown[1] >= {BLUE, RED}


def test_an_animation_and_a_page_have_the_same_colours(tmp_path: Path) -> None:
    for command, name, more in (
        ("animate", "ex3-animated.svg", ("--plans", "--format", "svg", "--frames", "8")),
        ("live", "ex3-live.html", ()),
    ):
        texts = []
        for colour in ((), ("--colour",)):
            program(command, str(path_of("linkages/ex3")), "-o", str(tmp_path), *more, *colour)
            texts.append((tmp_path / name).read_text("utf-8"))
        assert BLUE not in texts[0]
        assert BLUE in texts[1]
        assert RED in texts[1]
