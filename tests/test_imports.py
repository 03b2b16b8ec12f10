"""Nothing is imported that a command does not use; each in a fresh process."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from worked import PROBLEMS, path_of

EX3 = str(path_of("linkages/ex3"))
MESHING = str(PROBLEMS / "meshing/z12-30.toml")
TRAIN = str(PROBLEMS / "gears/gears-ex2.toml")
SIX_LINK = str(path_of("levers/six-link"))

ALL = "numpy", "shapely", "svgwrite", "reportlab", "matplotlib", "mpmath", "ezdxf", "scipy"
FONTS = ("fontTools",)
"""The subset of the font is made without the library that made the font."""
FORCES = {
    "planmethod.solved.forces.statics",
    "planmethod.plans.forces.dyads",
    "planmethod.render.forces.cut",
    "planmethod.note.narrate.forces.statement",
}


def imported(folder: Path, *commands: tuple[str, ...]) -> set[str]:
    """Return the modules there are after commands in one process."""
    program = (
        "import sys\n"
        "from planmethod.cli import cli\n"
        f"for args in {commands!r}:\n"
        "    try:\n"
        "        cli(args)\n"
        "    except SystemExit as done:\n"
        "        assert not done.code, done.code\n"
        "print('\\nMODULES', *sys.modules)\n"
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
    modules = run(tmp_path, "import sys, planmethod; print('MODULES', *sys.modules)")
    assert "planmethod" in modules
    assert modules.isdisjoint({*ALL, *FONTS, "click"})


def drawing(name: str, *args: str) -> tuple[tuple[str, ...], ...]:
    return (("sheet", name, *args),)


@pytest.mark.parametrize(
    ("commands", "needs", "spares"),
    [
        (
            drawing(EX3, "--format", "pdf"),
            {"numpy", "shapely", "reportlab"},
            {"matplotlib", "mpmath", "ezdxf", "svgwrite", "scipy", "fontTools"},
        ),
        (
            drawing(EX3, "--format", "png", "--dpi", "30"),
            {"numpy", "shapely", "matplotlib"},
            {"mpmath", "ezdxf", "svgwrite", "reportlab", "scipy"},
        ),
        (
            drawing(EX3, "--format", "dxf"),
            {"numpy", "shapely", "ezdxf"},
            {"matplotlib", "mpmath", "svgwrite", "reportlab", "scipy", "PIL"},
        ),
        (
            drawing(SIX_LINK, "--format", "svg", "-o", "."),
            {"numpy", "shapely", "svgwrite"},
            {"matplotlib", "mpmath", "ezdxf", "reportlab", "scipy", "fontTools", "PIL", *FORCES}
            | {"csv", "difflib"},
        ),
        (
            (("--help",),),
            {"click"},
            {*ALL, *FONTS, "fractions", "hashlib", "importlib.metadata", "logging"}
            | {"multiprocessing", "planmethod.problem.model"},
        ),
        # json: a message is looked up, and there is none
        ((("solve", EX3, "--lang", "ru"),), {"numpy"}, {*FORCES, "fractions", "json"}),
        (drawing(SIX_LINK, "--format", "svg", "--layout", "forces"), FORCES, {"matplotlib"}),
        (
            (("live", EX3), ("animate", EX3, "--format", "svg", "--frames", "8")),
            {"numpy", "svgwrite"},
            {"matplotlib", "mpmath", "ezdxf", "reportlab", "scipy", "fontTools", "PIL"},
        ),
        ((("lint", EX3),), {"numpy", "shapely"}, {*ALL, *FONTS} - {"numpy", "shapely"}),
        (
            (
                ("solve", EX3),
                ("solve", EX3, "--json"),
                ("solve", EX3, "--csv"),
                ("solve", EX3, "--npz", "ex3.npz"),
                ("solve", EX3, "--ask", "v_E"),
                ("protocol", EX3),
                ("synthesize", "slotted", "--K_v", "1.22", "--centres", "1.08"),
                ("solve", MESHING),
                ("protocol", MESHING),
                ("teeth", "--U", "6.5"),
            ),
            {"numpy"},
            {*ALL, *FONTS} - {"numpy"},
        ),
        ((("structure", EX3, "--json"),), set(), {*ALL, *FONTS} - {"numpy"}),
        ((("solve", TRAIN, "--json"),), set(), {*ALL, *FONTS}),
        (
            (
                ("structure", EX3, "--no-drawing"),
                ("new", "four-bar"),
                ("new", "levers-13", "--variant", "Б"),
                ("tasks", "--search", "кулиса"),
                ("layouts",),
                ("--help",),
                ("sheet", "--help"),
            ),
            set(),
            {*ALL, *FONTS},
        ),
    ],
    ids=lambda value: " ".join(value[0]).replace(str(PROBLEMS), "") if type(value) is tuple else "",
)
def test_commands_import_what_they_use(
    tmp_path: Path, commands: tuple[tuple[str, ...], ...], needs: set[str], spares: set[str]
) -> None:
    """Forces, too, are imported by their sheet alone."""
    modules = imported(tmp_path, *commands)
    assert needs <= modules
    assert modules & spares == set()


def test_a_table_of_results_reads_the_words_of_no_other_subject(tmp_path: Path) -> None:
    program = (
        "from planmethod.cli import cli\n"
        "from planmethod.note.wording import language\n"
        f"cli(['solve', {EX3!r}, '--lang', 'ru'], standalone_mode=False)\n"
        "print('\\nMODULES', *vars(language('ru')))\n"
    )
    assert run(tmp_path, program) == {"lang", "say", "note"}
