"""How much a command imports, each in a fresh process: it starts quickly."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

from cases import each
from worked import PROBLEMS, path_of

EX3 = path_of("linkages/ex3")
TRAIN = PROBLEMS / "gears/gears-ex2.toml"

HEAVY = {
    "ezdxf", "fontTools", "matplotlib", "mpmath", "numpy", "openpyxl", "reportlab", "scipy",
    "shapely", "svgwrite",
}  # fmt: skip
"""Libraries that take long to import."""


def imported(folder: Path, *words: str) -> set[str]:
    """Return the modules that Python imports."""
    done = subprocess.run(
        [sys.executable, "-X", "utf8", "-X", "importtime", *words],
        capture_output=True,
        encoding="utf-8",
        cwd=folder,
        timeout=120,
    )
    lines = done.stderr.splitlines()
    assert not done.returncode, [line for line in lines if "import time:" not in line]
    return {line.rpartition("|")[2].strip() for line in lines if line.startswith("import time:")}


def test_the_package_alone_imports_no_modules(tmp_path: Path) -> None:
    modules = imported(tmp_path, "-c", "import planmethod")
    assert "planmethod" in modules
    assert modules.isdisjoint({*HEAVY, "click"})


@each(
    "command, most, heavy",
    [
        ("--help", 10, set()),
        ("solve --help", 15, set()),
        ("new four-bar", 60, set()),
        (f"solve {TRAIN} --json", 90, set()),
        (f"solve {EX3}", 145, {"numpy"}),
        (f"protocol {EX3}", 175, {"numpy"}),
        (f"check --key {EX3}", 320, {"numpy", "openpyxl", "reportlab", "shapely"}),
        (f"sheet {EX3} --format svg", 235, {"numpy", "shapely", "svgwrite"}),
        (f"sheet {EX3} --format pdf", 235, {"numpy", "shapely", "reportlab"}),
    ],
)
def test_a_command_imports_no_more_than_it_needs(
    tmp_path: Path, command: str, most: int, heavy: set[str]
) -> None:
    """Rarely needed imports are in functions; at most ``most`` modules of the package load."""
    modules = imported(tmp_path, "-m", "planmethod", *command.split())
    ours = [name for name in modules if name.partition(".")[0] == "planmethod"]
    assert modules & HEAVY == heavy
    assert len(ours) <= most, f"{command}: {len(ours)} modules"
