"""Sheets, animations and moving pages in the colours of the meanings of their lines."""

from __future__ import annotations

import re
from collections.abc import Iterable
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from browser import PROGRAM, browsing
from click.testing import CliRunner
from doors import (
    Drawing,
    Options,
    Pen,
    PenSet,
    Stroke,
    cli,
    page_live_page as live_page,
    render,
)
from PIL import Image
from worked import path_of, problem_of

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
            pixels = np.asarray(picture.convert("RGB")).reshape(-1, 3)
        found, counts = np.unique(pixels, axis=0, return_counts=True)
        shown.append({"#" + pixel.tobytes().hex() for pixel in found[counts > 9]})
    assert not shown[0] & {BLUE, RED} and shown[1] >= {BLUE, RED}


def test_an_animation_has_the_same_colours(tmp_path: Path) -> None:
    for colour, seen in ((), set()), (("--colour",), {BLUE, RED}):
        program("animate", str(path_of("linkages/ex3")), "-o", str(tmp_path), "--plans",
                "--format", "svg", "--frames", "8", *colour)  # fmt: skip
        text = (tmp_path / "ex3-animated.svg").read_text("utf-8")
        assert colours(text) & {BLUE, RED} == seen


PAGES = {"linkages/ex3": "seg.resultant", "cams/central": "pen-thin", "gears/gears-ex1": "pen-thin"}


@pytest.mark.skipif(PROGRAM is None, reason="chromium is not installed")
def test_a_moving_page_has_one_switch_of_the_colours(tmp_path: Path) -> None:
    with browsing(tmp_path) as page:
        for name, line in PAGES.items():
            for colour in ((), ("--colour",)):
                program("live", str(path_of(name)), "-o", str(tmp_path), *colour)
                page.open(tmp_path / f"{name.split('/')[1]}-live.html", width=390, height=800)
                drawn = f"getComputedStyle(document.querySelector('.{line}')).stroke"
                states = [page.ask(drawn), page.ask(f"(colour.click(), {drawn})")]
                told = tuple(bytes.fromhex((BLUE if "seg" in line else GREY)[1:]))
                coloured = f"rgb{told}"
                plain, lit = states[:: -1 if colour else 1]
                assert lit == coloured != plain, name
            assert not page.said


def luminance(colour: Iterable[float]) -> float:
    """Return the relative luminance of a colour, red, green, blue to 255 (WCAG 2.1)."""
    parts = [c / 255 for c in colour]
    linear = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts]
    return float(np.dot((0.2126, 0.7152, 0.0722), linear))


def test_every_colour_has_a_contrast_on_paper_and_on_a_dark_page() -> None:
    page = live_page(problem_of("linkages/ex3"), "en")
    papers = [tuple(bytes.fromhex(c)) for c in re.findall(r"--paper: #(\w{6})", page)]
    (dark,) = papers
    pairs = dict(re.findall(r"light-dark\((#\w{6}),color-mix\(in srgb,#\w{6} (\d+)%,#fff\)", page))
    assert set(pairs) == {BLUE, RED, GREEN, GREY}
    for pen in Pen:
        colour = np.array(PenSet(is_coloured=True).colour(pen), dtype=float)
        assert 1.05 / (luminance(colour) + 0.05) >= 4.5, pen
    for shown, share in pairs.items():
        part = int(share) / 100
        mixed = part * np.array(list(bytes.fromhex(shown[1:]))) + (1 - part) * 255
        assert (luminance(mixed) + 0.05) / (luminance(dark) + 0.05) >= 4.5, shown
