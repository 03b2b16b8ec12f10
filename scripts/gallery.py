"""Pictures of the documentation, each made by the commands shown on its page.

``make gallery`` draws them all. pdftoppm and Chromium turn PDF pages, HTML pages and the studio
into pictures; if a program is missing, its pictures are left as they are, and a note is printed.
"""

from __future__ import annotations

import re
import shlex
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import NamedTuple

from PIL import Image

ROOT = Path(__file__).resolve().parent.parent
SHADES = 64
"""Colours of a picture: more are not seen, and cost."""
GALLERY = ROOT / "docs" / "gallery"
CHROMIUM = ("chromium", "--headless", "--no-sandbox", "--hide-scrollbars", "--disable-gpu")


class Picture(NamedTuple):
    """A picture, the command that draws it, and for pages the part to show."""

    name: str
    command: str
    made: str = ""
    """File that the command makes, where that is not the picture itself."""
    shown: str = ""
    """For a PDF, page and resolution; for HTML, width and height in pixels; for SVG, the frames."""
    served: str = ""
    """Path opened at the server that the command starts."""


PICTURES = (
    Picture("ex3", "sheet problems/linkages/ex3.toml --format png --dpi 62"),
    Picture("task12", "sheet problems/levers/task12.toml --format png --dpi 62"),
    Picture("ex1", "sheet problems/linkages/ex1.toml --format png --dpi 90"),
    Picture(
        "six-link", "sheet problems/levers/six-link.toml --layout forces --format png --dpi 45"
    ),
    Picture(
        "press",
        "sheet problems/press/press.toml --layout forces-cycle --phi 98.918918918919:429:30"
        " --format png --dpi 45",
    ),
    Picture(
        "play",
        "play problems/linkages/ex3.toml --position 0 --frames",
        "ex3-play-*.svg",
        "5 7 8 11 22 35",
    ),
    Picture("offset", "sheet problems/cams/offset.toml --format png --dpi 48"),
    Picture("specimen-symbols", "specimen symbols --format png --dpi 70"),
    Picture("specimen-lines", "specimen lines --format png --dpi 90"),
    Picture("specimen-lettering", "specimen lettering --format png --dpi 45"),
    Picture("note", "note problems/press/press.toml", "press-note.pdf", "12 60"),
    Picture(
        "checking",
        "check problems/linkages/ex3-variants.toml problems/groups/ex3.csv",
        "pages/Белов-Никита.html",
        "900 1000",
    ),
    Picture(
        "studio",
        "studio --port 0",
        shown="1360 900",
        served="?lang=ru#task=linkages-ex3&view=sheets",
    ),
)
PATIENCE = "60000"
"""Milliseconds of its own time in which a page of a server draws itself: it waits for answers."""


def drawn(picture: Picture, folder: Path) -> Path | str:
    """Draw a picture and return its file; a sentence where a program is missing."""
    words = ["-m", "planmethod", "--lang", "ru", *shlex.split(picture.command)]
    if picture.served:
        return served(picture, [sys.executable, *words], folder)
    words += ["-o", str(folder)]
    run = subprocess.run([sys.executable, *words], cwd=ROOT, capture_output=True, text=True)
    if run.returncode not in (0, 1):  # a check has findings
        raise SystemExit(run.stderr)
    if not picture.made:
        return next(folder.glob("*.png"))
    pages, target = sorted(folder.rglob(picture.made)), folder / f"{picture.name}.png"
    page = pages[0]
    if page.suffix == ".svg":
        return strip([pages[int(number) - 1] for number in picture.shown.split()], target)
    if page.suffix == ".pdf":
        program, (number, dpi) = "pdftoppm", picture.shown.split()
        options = ["-png", "-singlefile", "-gray", "-r", dpi, "-f", number, "-l", number]
        line = [program, *options, str(page), str(target.with_suffix(""))]
    else:
        program, size = CHROMIUM[0], picture.shown.replace(" ", ",")
        line = [*CHROMIUM, f"--screenshot={target}", f"--window-size={size}", page.as_uri()]
    if shutil.which(program) is None:
        return f"{picture.name}: {program} is missing, the picture stays as it is"
    subprocess.run(line, check=True, capture_output=True)
    return target


def strip(frames: list[Path], target: Path) -> Path | str:
    """Put frames side by side, three in a row, each as wide as the others."""
    program = "rsvg-convert"
    if shutil.which(program) is None:
        return f"{target.stem}: {program} is missing, the picture stays as it is"
    for frame in frames:
        line = [program, "-w", str(WIDTH), "-o", str(frame.with_suffix(".png")), str(frame)]
        subprocess.run(line, check=True, capture_output=True)
    pictures = [Image.open(frame.with_suffix(".png")).convert("RGB") for frame in frames]
    rows = [pictures[k : k + IN_ROW] for k in range(0, len(pictures), IN_ROW)]
    heights = [max(one.height for one in row) + BETWEEN for row in rows]
    size = IN_ROW * (WIDTH + BETWEEN) + BETWEEN, sum(heights) + BETWEEN
    whole, top = Image.new("RGB", size, EDGE), BETWEEN
    for row, height in zip(rows, heights, strict=True):
        for column, one in enumerate(row):
            left = BETWEEN + column * (WIDTH + BETWEEN)
            frame_size = WIDTH, height - BETWEEN
            whole.paste(Image.new("RGB", frame_size, "white"), (left, top))
            whole.paste(one, (left, top))
        top += height
    whole.save(target)
    return target


WIDTH, IN_ROW, BETWEEN, EDGE = 440, 3, 6, "#d5d8de"
"""Width of a frame in pixels, frames in a row, pixels between them, and the colour there."""


def served(picture: Picture, command: list[str], folder: Path) -> Path | str:
    """Start a server on this machine, look at a page of it, and stop it."""
    if shutil.which(CHROMIUM[0]) is None:
        return f"{picture.name}: {CHROMIUM[0]} is missing, the picture stays as it is"
    target, size = folder / f"{picture.name}.png", picture.shown.replace(" ", ",")
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as running:
        try:
            assert running.stdout is not None
            told = re.search(r"http://\S+", running.stdout.readline())
            if told is None:
                return f"{picture.name}: no server was started, the picture stays as it is"
            page = [f"--virtual-time-budget={PATIENCE}", told[0] + picture.served]
            line = [*CHROMIUM, f"--screenshot={target}", f"--window-size={size}", *page]
            subprocess.run(line, check=True, capture_output=True, timeout=120)
        finally:
            running.terminate()
    return target


def main(names: list[str]) -> None:
    """Draw the named pictures, or all."""
    for picture in PICTURES:
        if names and picture.name not in names:
            continue
        with TemporaryDirectory() as folder:
            made = drawn(picture, Path(folder))
            if isinstance(made, Path):
                Image.open(made).quantize(SHADES).save(
                    GALLERY / f"{picture.name}.png", optimize=True
                )
                made = f"docs/gallery/{picture.name}.png"
        print(made)


if __name__ == "__main__":
    main(sys.argv[1:])
