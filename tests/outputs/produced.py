"""What every command says of every shipped problem: outputs by name, as texts to compare.

The name of an output is its command line. A sheet is told by its display list, to 0.01 mm, a
workbook by its cells, a note in Word by its texts, a PDF by its name alone; numbers of JSON, CSV
and pages have nine digits, so that no output depends on the last bit of a machine. What does is
left out: ``--referee``, which tells of that bit, and where a number stands beside a diagram.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import tempfile
import tomllib
from base64 import b64decode
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from typing import Any
from unittest.mock import patch
from zipfile import ZipFile
from zlib import crc32

from click.testing import CliRunner
from doors import (
    BACKENDS,
    COMMANDS,
    OTHER_FAMILIES,
    PACKAGES,
    PROBLEM_FAMILIES as FAMILIES,
    SHIPPED,
    SPECIMENS,
    Arc,
    Canvas,
    Disc,
    Drawing,
    DrawingItem as Item,
    Fill,
    Options,
    Stroke,
    Text,
    cli,
)
from openpyxl import load_workbook

ROOT = Path(__file__).resolve().parents[2]
PROBLEMS = ROOT / "problems"
LANGUAGES = ("ru", "en")
GENERAL = "general"
"""Group of the outputs that are of no problem."""

UNSTEADY = frozenset((Path(__file__).parent / "unsteady.txt").read_text("utf-8").splitlines()[4:])
"""Outputs that are not compared: the last bit of a number decides what a person reads."""

Output = tuple[str, Callable[[], str]]

ROUND = "0:360:30"
AFTER = 2.0, 0.002
"""Steps between positions where the driver does not go all round: degrees of a crank, metres."""

LAYOUTS = (
    # layout, positions, every so many problems, what the file has
    ("homework", 1, 4, ""),
    ("few-positions", 3, 3, ""),
    ("many-positions", 12, 3, ""),
    ("compact", 1, 6, ""),
    ("coursework", 1, 6, ""),
    ("coursework-12", 12, 4, ""),
    ("forces", 1, 3, "[dynamics"),
    ("forces-cycle", 12, 4, "[dynamics"),
    ("flywheel", 1, 1, "[machine"),
    ("run-up", 1, 1, "motor"),
    ("balancing", 1, 1, "[balancing]"),
    ("friction", 1, 1, "[friction"),
)
"""Layouts of linkages beside the one that is taken when none is asked for."""

REFUSING = ("gears/gears-ex1", "meshing/z12-30", "point/k10-satellite")
"""Problems whose refusals of what only linkages have are outputs, too."""

ONE_OF_SEVERAL = 'reading = "one of several"'
"""In tasks whose lost figure may have been another one: they have a few outputs."""

WHOLE = ("linkages/ex3.", "machines/", "press/")
"""Problems that have every layout, or its refusal."""

PROJECTS = ("linkages/ex3.", "machines/engine.", "press/flywheel.")
"""Problems that are made projects of."""

SYNTHESES = (
    "slotted --K_v 1.22 --centres 1.08",
    "slotted --swing 40 --centres 0.4 --stroke 0.3 --rod 0.2",
    "slider-crank --K_v 1.2 --stroke 0.2 --offset 0.03",
    "slider-crank --K_v 1.2 --stroke 0.2",
    "slider-crank --K_v 1.2 --stroke 0.2 --lambda 0.3",
    "slider-crank --stroke 0.2 --lambda 0.3",
    "slider-crank --stroke 0.2 --pressure 30 --offset 0.02",
    "crank-rocker --K_v 1.25 --swing 50 --rocker 0.3",
    "crank-rocker --K_v 1.2 --swing 40 --beta -150",
    "crank-rocker --K_v 1.2 --swing 40 --line 0,0.3,0",
    "crank-rocker --K_v 1 --swing 50 --rocker 0.3 --centres 0.5",
    "three-positions --positions '0,0,0; 0.1,0.05,20; 0.25,0.05,50' --coupler 0.2",
    "three-positions --positions '0,0,0; 0.1,0.05,20; 0.25,0.05,50'",
    "three-angles --angles '40,60; 65,75; 90,95' --centres 0.5",
    "three-angles --centres 0.5",
)

TEETH = (
    "--U 6.5",
    "--scheme external-internal --U 8 --modules 2,2.5",
    "--scheme two-external --U 40 --count 5",
    "--scheme two-internal --U 30 --count 5",
    "--scheme pair --U -2.5 --count 5",
    "--scheme two-stage --U 6 --count 5",
)


# Which outputs there are --------------------------------------------------------------------------


def groups() -> list[str]:
    """Return the problems, by path below problems/, and the group of the general outputs."""
    files = sorted(PROBLEMS.rglob("*.toml"))
    return [path.relative_to(PROBLEMS).with_suffix("").as_posix() for path in files] + [GENERAL]


def outputs(group: str) -> Iterator[Output]:
    """Yield the outputs of a group, in a workplace: their names, and what makes their texts."""
    for line in _general() if group == GENERAL else _of_problem(group):
        name = f"{group}: {line}"
        if name not in UNSTEADY:
            yield name, partial(run_command, group, line)


def is_taken(name: str, every: int) -> bool:
    """Return whether one of so many takes this name, whatever others there are."""
    return crc32(name.encode()) % every == 0


def _of_problem(name: str) -> Iterator[str]:
    text = (PROBLEMS / f"{name}.toml").read_text("utf-8")
    is_linkage, has_variants = "[links." in text, "[variants" in text
    of_variants = has_variants and (not is_linkage or is_taken(f"{name} variants", 3))
    own = LANGUAGES[is_taken(f"{name} of variants", 2)]
    if ONE_OF_SEVERAL in text:
        yield f"solve --json{' --all-variants' * of_variants if is_linkage else ' --lang en'}"
        yield from ("solve --lang ru", "protocol --lang en", "sheet --lang ru")
        yield f"check --key --lang {own}"
        return
    for lang in LANGUAGES:
        for command in ("solve", "protocol", "structure --no-drawing", "audit"):
            yield f"{command} --lang {lang}"
        if of_variants and lang == own:
            yield f"solve --lang {lang} --all-variants"
            yield f"protocol --lang {lang} --all-variants"
        if not is_linkage or (lang == own and (not has_variants or is_taken(f"{name} key", 2))):
            yield f"check --key --lang {lang}"
        if is_taken(f"{name} form", 3):
            yield f"form --lang {lang}"
        if is_taken(f"{name} lint", 4):
            yield f"lint --lang {lang}"
        if lang == "ru" or is_taken(f"{name} {lang}", 2):
            yield f"sheet --lang {lang}"
    yield "structure --json"
    if is_linkage:
        yield from _of_linkage(name, text, " --all-variants" * of_variants)
    else:
        yield from (f"solve --json --lang {lang}" for lang in LANGUAGES)
        if has_variants:
            yield "solve --json --all-variants"
    if name in REFUSING:
        yield from ("solve --csv", "solve --ask positions", "sketch", "live", "animate")
        yield from ("sheet --layout homework", "sheet --phi 0,30", "lint --structure")


def _of_linkage(name: str, text: str, every: str) -> Iterator[str]:
    yield f"solve --json{every}"
    yield f"solve --csv{every}"
    yield f"solve --csv --partial --phi {ROUND}"
    yield "structure --lang ru"
    yield "sketch --lang ru"
    for line, some in (
        ("solve --covariance -", 4),
        ("solve --lang ru --sigma", 2),
        ("solve --lang en --ask positions,velocities --partial --phi 0:90:10", 4),
        ("structure --lang en", 4),
        ("sketch --lang en", 4),
        ("live --lang ru", 8),
        ("animate --format svg --frames 8 --plans --lang ru", 8),
        ("sheet --errors --sigma --lang en", 4),
        ("sheet --paper A4 --lang ru", 8),
        ("note --format docx --lang ru", 8),
        ("note --format docx --lang en", 16),
    ):
        if is_taken(f"{name} {line}", some):
            yield line
    if f"{name}.".startswith(PROJECTS):
        yield "project --format svg --lang ru"
        yield "project --json --lang en"
    for layout, count, some, needed in LAYOUTS:
        is_whole = f"{name}.".startswith(WHOLE)
        if is_whole or (needed in text and is_taken(f"{name} {layout}", some)):
            at = "" if count == 1 else f" --phi {positions(name, count)}"
            lang = LANGUAGES[is_taken(f"{name} {layout} in English", 3)]
            yield f"sheet --layout {layout} --lang {lang}{at}"


def positions(name: str, count: int) -> str:
    """Return so many positions of a driver, all round if it goes there, for ``--phi``."""
    if _run("solve", _path(name), "--ask", "positions", "--phi", ROUND).exit_code == 0:
        return f"0:360:{360 // count}"
    driver = tomllib.loads((PROBLEMS / f"{name}.toml").read_text("utf-8"))["driver"]
    at: Any = driver.get("phi", driver.get("s", 0.0))
    first = at["from"] if isinstance(at, dict) else at[0] if isinstance(at, list) else at
    step = AFTER["s" in driver]
    return ",".join(f"{first + step * k:.12g}" for k in range(count))


def _general() -> Iterator[str]:
    for lang in LANGUAGES:
        spoken = f"--lang {lang}"
        yield f"{spoken} --help"
        yield spoken
        yield from (f"{spoken} {command} --help" for command in COMMANDS)
        yield f"tasks {spoken}"
        yield f"layouts {spoken}"
        yield from (f"layouts {name} {spoken}" for name in SHIPPED)
        yield f"new --list {spoken}"
        yield f"new quadrilateral {spoken}"
        yield from (f"specimen {name} {spoken}" for name in SPECIMENS)
        yield from (f"teeth {asked} {spoken}" for asked in TEETH)
        for asked in SYNTHESES:
            yield f"synthesize {asked} {spoken}"
            yield f"synthesize {asked} {spoken} --sheet -o out"
        yield f"check problems/linkages/ex3-variants.toml problems/groups/ex3.csv {spoken}"
    yield "tasks --json"
    yield from (f"teeth {asked} --json" for asked in TEETH)
    yield from (f"synthesize {asked} --json" for asked in SYNTHESES)
    yield from (f"new {family} out/{family}.toml" for family in (*FAMILIES, *OTHER_FAMILIES))
    yield "check problems/linkages/ex3-variants.toml problems/groups/ex3.csv --json"


# Their texts --------------------------------------------------------------------------------------

DIGITS, COARSE = 9, 5
"""Significant digits of numbers, and of those that are integrated or are small differences."""

INTEGRATED = ("machines/compressor", "press/flywheel")
"""Problems with a run-up: its steps make much of a last bit."""

PLACED = re.compile(r"(diagram|flywheel) .*: position \d+")
"""Labels of numbers that stand where there is room, of two places as good in any."""

SCRIPT = "<script.*?</script>|'sha256-[^']*'"
"""Programs of a page: which operations they have depends on numbers that are nearly nothing."""

FORMATTED = 10
"""Signs of a number on a page from which it is one of a calculation, not formatted."""

ENV = {
    "COLUMNS": "80",
    "PLANMETHOD_CONFIG": "config.toml",
    "PLANMETHOD_LANG": "ru",
    "PLANMETHOD_NATIVE": "0",
}


POINT = b64decode(
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGP4DwABAQEAG7buVgAAAABJRU5ErkJggg=="
)
"""A picture of one pixel."""


@contextmanager
def workplace() -> Iterator[None]:
    """Work in an empty folder where the problems are, formats being texts of display lists."""
    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "problems").symlink_to(PROBLEMS)
        (place / "config.toml").touch()
        os.chdir(place)
        try:
            with (
                patch("planmethod.render.backends.make_canvas", ListCanvas),
                # Of a PDF the name alone is compared; to set a note takes a third of a project.
                patch("planmethod.project.notes.pdf_note", lambda *_, **__: b""),
            ):
                yield
        finally:
            os.chdir(before)


def run_command(group: str, line: str) -> str:
    """Return all that a command prints and writes; its exit code if that is not 0."""
    words = shlex.split(line)
    if group != GENERAL:
        words.insert(1, _path(group))
        if words[0] == "sheet":
            words += ["--format", "svg"]
    result = _run(*words)
    parts = [f"exit code {result.exit_code}\n"] if result.exit_code else []
    if result.exception is not None and not isinstance(result.exception, SystemExit):
        parts.append(f"{type(result.exception).__name__}: {result.exception}\n")
    is_data = words[0] != "sheet" and any(f"--{o}" in words for o in ("json", "csv", "covariance"))
    is_coarse = "--covariance" in words or group in INTEGRATED
    digits = COARSE if is_coarse else DIGITS
    # click keeps a command's help option as who first called it named it: by the group, or alone.
    shown = re.sub(r"(?m)^  -h, --help", "  --help    ", result.stdout)
    parts.append(_rounded(shown, digits) if is_data else shown)
    parts += [f"--- to stderr\n{result.stderr}"] if result.stderr else []
    for path in sorted(Path("out").rglob("*")):
        if path.is_file():
            parts.append(f"--- {path.as_posix()}\n{_content(path)}")
    shutil.rmtree("out", ignore_errors=True)
    return "".join(parts)


def _path(name: str) -> str:
    return f"problems/{name}.toml"


def _run(*words: str) -> Any:
    return CliRunner().invoke(cli, words, prog_name="planmethod", env=ENV)


def _content(path: Path) -> str:
    if path.suffix == ".xlsx":
        return "".join(_cells(path))
    if path.suffix == ".docx":
        return "".join(_texts(path))
    if path.suffix == ".pdf" or path.name == "run.json":  # with the versions and sums of files
        return ""
    text = re.sub(SCRIPT, "", path.read_text("utf-8"), flags=re.DOTALL)
    return _rounded(text, DIGITS, FORMATTED)


def _texts(path: Path) -> Iterator[str]:
    """Yield the texts of a file of Word, those of a paragraph or a formula in a line."""
    with ZipFile(path) as parts:
        body = parts.read("word/document.xml").decode()
    for paragraph in body.split("</w:p>"):
        found = re.findall(r"<[wm]:t(?: [^>]*)?>([^<]*)</[wm]:t>", paragraph)
        if found:
            yield f"{''.join(found)}\n"


def _cells(path: Path) -> Iterator[str]:
    for sheet in load_workbook(path):
        yield f"{sheet.title}\n"
        for row in sheet.iter_rows():
            if row[0].value in PACKAGES:  # with its version
                continue
            for cell in row:
                if cell.value is not None:
                    yield f"{cell.coordinate} {_rounded(str(cell.value), DIGITS, FORMATTED)}\n"


def _rounded(text: str, digits: int, least: int = 0) -> str:
    """Return a text whose numbers of so many signs have so many digits, also after the point.

    What is formatted already is short, and keeps its zeros.
    """

    def shortened(number: re.Match[str]) -> str:
        if len(number[0]) < least:
            return number[0]
        return f"{round(float(number[0]), digits) + 0.0:.{digits}g}"

    return re.sub(r"-?\d+\.\d+(?:[eE][-+]?\d+)?|-?\d+[eE][-+]?\d+", shortened, text)


# Display lists ------------------------------------------------------------------------------------


class ListCanvas(Canvas):
    """Canvas of every format that writes display lists."""

    def __init__(self, fmt: str, _options: Options) -> None:
        assert fmt in BACKENDS
        self._fmt, self._pages = fmt, ""

    def open(self, drawing: Drawing) -> None:
        self._pages += "".join(_listed(drawing))

    def stroke(self, item: Stroke) -> None: ...
    def arc(self, item: Arc) -> None: ...
    def fill(self, item: Fill | Disc) -> None: ...
    def text(self, item: Text) -> None: ...

    def close(self) -> bytes:
        # The writer of Word's files reads the pictures of a note.
        return POINT if self._fmt == "png" else self._pages.encode()


def _listed(drawing: Drawing) -> Iterator[str]:
    marks = ["has_omissions"] * drawing.has_omissions
    marks += ["is_continuation"] * drawing.is_continuation
    size = f"{_mm(drawing.width)} {_mm(drawing.height)}"
    yield f"<svg> sheet {' '.join([size, drawing.title, *marks])}\n"
    for item in drawing.items:
        yield f"{_item(item)}\n"
    for view in drawing.views:
        box = " ".join(map(_mm, view.box))
        yield f"view {view.kind} {box} {view.scale!r} {view.per_mm:.9g}\n"
        for span in view.spans:
            ends = f"{_at(span.start)} {_at(span.end)}"
            yield f"  span {span.name} {span.position} {ends} {span.magnification:.9g}\n"
    yield "</svg>\n"


def _item(item: Item) -> str:
    match item:
        case Stroke():
            flags = "closed" * item.closed, "smooth" * item.smooth
            head = ["stroke", item.pen.value, *flags, item.tag, *map(_at, item.points)]
        case Arc():
            turn = _mm(item.start), _mm(item.end)
            head = ["arc", item.pen.value, item.tag, _at(item.centre), _mm(item.radius), *turn]
        case Fill():
            head = ["fill", item.ink.value, item.tag, *map(_at, item.points)]
        case Disc():
            head = ["disc", item.ink.value, item.tag, _at(item.centre), _mm(item.radius)]
        case Text():
            box = [] if item.box is None else ["in", *map(_mm, item.box)]
            size = _mm(item.height), _mm(item.angle)
            at = "" if PLACED.fullmatch(item.label) else _at(item.at)
            label = item.label.partition("@")[0]  # without its place, which has halves of its own
            head = ["text", repr(item.text), at, *size, item.tag, label, *box]
    return " ".join(word for word in head if word)


def _at(point: complex) -> str:
    return f"{_mm(point.real)},{_mm(point.imag)}"


def _mm(number: float) -> str:
    """Return a number to 0.01, exact halves always to the same side."""
    text = f"{number + 1e-6:.2f}"
    return "0.00" if text == "-0.00" else text
