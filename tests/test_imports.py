"""Nothing is imported that a command does not use; each in a fresh process."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from worked import path_of

EX3 = str(path_of("linkages/ex3"))
SIX_LINK = str(path_of("levers/six-link"))

ALL = "numpy", "shapely", "svgwrite", "reportlab", "matplotlib", "mpmath", "ezdxf", "scipy"
FONTS = ("fontTools",)
"""The subset of the font is made without the library that made the font."""


def imported(folder: Path, *args: str) -> set[str]:
    """Return the top-level modules there are after a command."""
    program = (
        "import sys\n"
        "from planmethod.cli import cli\n"
        "try:\n"
        f"    cli({list(args)!r})\n"
        "except SystemExit as done:\n"
        "    assert not done.code, done.code\n"
        "print('\\nMODULES', *sorted({name.partition('.')[0] for name in sys.modules}))\n"
    )
    return run(folder, program)


def run(folder: Path, program: str) -> set[str]:
    done = subprocess.run(
        [sys.executable, "-X", "utf8", "-c", program],
        capture_output=True,
        encoding="utf-8",
        cwd=folder,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    return set(done.stdout.rpartition("MODULES")[2].split())


def test_the_package_alone_imports_nothing(tmp_path: Path) -> None:
    program = (
        "import sys, planmethod\n"
        "print('MODULES', *sorted({name.partition('.')[0] for name in sys.modules}))"
    )
    modules = run(tmp_path, program)
    assert "planmethod" in modules
    assert modules.isdisjoint({*ALL, *FONTS, "click"})


@pytest.mark.parametrize(
    ("args", "needs", "spares"),
    [
        (
            ("sheet", EX3, "--format", "svg"),
            {"numpy", "shapely", "svgwrite"},
            {"matplotlib", "mpmath", "ezdxf", "reportlab", "scipy", "fontTools", "PIL"},
        ),
        (
            ("sheet", EX3, "--format", "pdf"),
            {"numpy", "shapely", "reportlab"},
            {"matplotlib", "mpmath", "ezdxf", "svgwrite", "scipy", "fontTools"},
        ),
        (
            ("sheet", EX3, "--format", "png", "--dpi", "30"),
            {"numpy", "shapely", "matplotlib"},
            {"mpmath", "ezdxf", "svgwrite", "reportlab", "scipy"},
        ),
        (
            ("sheet", EX3, "--format", "dxf"),
            {"numpy", "shapely", "ezdxf"},
            {"matplotlib", "mpmath", "svgwrite", "reportlab", "scipy", "PIL"},
        ),
        (("lint", EX3), {"numpy", "shapely"}, {*ALL, *FONTS} - {"numpy", "shapely"}),
        (("solve", EX3), {"numpy"}, {*ALL, *FONTS} - {"numpy"}),
        (("solve", EX3, "--json"), {"numpy"}, {*ALL, *FONTS} - {"numpy"}),
        (("solve", EX3, "--csv"), {"numpy"}, {*ALL, *FONTS} - {"numpy"}),
        (("solve", EX3, "--npz", "ex3.npz"), {"numpy"}, {*ALL, *FONTS} - {"numpy"}),
        (("solve", EX3, "--ask", "v_E"), {"numpy"}, {*ALL, *FONTS} - {"numpy"}),
        (("protocol", EX3), {"numpy"}, {*ALL, *FONTS} - {"numpy"}),
        (("structure", EX3, "--no-drawing"), set(), {*ALL, *FONTS}),
        (("structure", EX3, "--json"), set(), {*ALL, *FONTS} - {"numpy"}),
        (("new", "four-bar"), set(), {*ALL, *FONTS}),
        (("layouts",), set(), {*ALL, *FONTS}),
        (("--help",), set(), {*ALL, *FONTS}),
        (("sheet", "--help"), set(), {*ALL, *FONTS}),
    ],
    ids=lambda value: " ".join(a for a in value if a != EX3) if isinstance(value, tuple) else "",
)
def test_a_command_imports_what_it_uses(
    tmp_path: Path, args: tuple[str, ...], needs: set[str], spares: set[str]
) -> None:
    modules = imported(tmp_path, *args)
    assert needs <= modules
    assert modules & spares == set()


@pytest.mark.parametrize(
    ("args", "there"),
    [(("sheet", SIX_LINK), False), (("sheet", SIX_LINK, "--layout", "forces"), True)],
    ids=["kinematics", "forces"],
)
def test_forces_are_imported_by_their_sheet_alone(
    tmp_path: Path, args: tuple[str, ...], there: bool
) -> None:
    program = (
        "import sys\n"
        "from planmethod.cli import cli\n"
        "try:\n"
        f"    cli({[*args, '--format', 'svg']!r})\n"
        "except SystemExit as done:\n"
        "    assert not done.code, done.code\n"
        "print('\\nMODULES', *(name for name in sys.modules if name.startswith('planmethod')))\n"
    )
    modules = run(tmp_path, program)
    for name in (
        "solved.forces.statics",
        "plans.forces.dyads",
        "render.forces.cut",
        "note.narrate.forces.formulas",
    ):
        assert (f"planmethod.{name}" in modules) is there
