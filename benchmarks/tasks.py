"""The index of the shipped problems and their pages in the documents.

Run ``python -m benchmarks.tasks`` (``make tasks``) to rewrite problems/index.json, docs/tasks.md
and its contact sheets, with a drawing for each structure.
"""

from __future__ import annotations

import json
import re
from itertools import groupby
from pathlib import Path

from msgspec.structs import asdict, replace

from planmethod.kinds import kind_of
from planmethod.linkages.reading import load
from planmethod.mechanism.structure import analyse
from planmethod.note.wording import get_language
from planmethod.problem import variant_names
from planmethod.problem.model import Problem, Scales
from planmethod.problem.tasks import LINKAGE, ShippedTask, home
from planmethod.render.backends import render
from planmethod.render.backends.output import write
from planmethod.render.ink.drawing import Drawing, Pen, Stroke
from planmethod.render.ink.typeset import typeset
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.solved.scaling import Views
from planmethod.solved.solution import Solution

KINDS = (LINKAGE, "gears", "meshing", "cam", "point")
DOCUMENT = Path("docs/tasks.md")
PICTURES = Path("docs/tasks")

ACROSS, WIDTH, HEIGHT = 4, 70.0, 62.0
"""Cells in a row of a contact sheet, and their size, mm."""

ROOM = (48.0, 36.0)
"""Space for the mechanism itself in its cell, mm."""

INTRODUCTION = """# Shipped tasks

Problem files of the textbooks' tasks by structure: the Assur groups in the order of kinematic
analysis, a letter for each pair. `planmethod tasks` lists them; `planmethod new levers-13 my.toml
--variant Б` writes one to start from. Where the figure of a source is lost, the file says what was
chosen in its place; `*` marks those whose scheme is one of several that fit the data: compare it
with the figure of your assignment. The pictures show the first position of each. Written by
`make tasks`.
"""

LETTER = 2.5
HEAD = 3.5


def _order(task: ShippedTask) -> tuple[object, ...]:
    """By kind; linkages by number of groups and structure; numbers in names as numbers."""
    parts = re.split(r"(\d+)", task.name)
    name = tuple((int(p), "") if p.isdigit() else (-1, p) for p in parts)
    return KINDS.index(task.kind), len(task.groups), task.groups, name


def name_of(file: str) -> str:
    """Return the name of a file below the problems: ``levers-13`` for levers/task-13.toml."""
    folder, stem = file.split("/")[0], Path(file).name.removesuffix(".toml")
    stem = stem.removeprefix("task-")
    return stem if stem.startswith(folder) else f"{folder}-{stem}"


def task_of(path: Path) -> ShippedTask:
    """Read a file for the index."""
    file, kind = path.relative_to(home()).as_posix(), kind_of(path)
    one, of, groups = kind.load(path, None), kind.table, tuple[str, ...]()
    if isinstance(one, Problem):
        of, groups = LINKAGE, tuple(group.signature for group in analyse(one.mechanism).groups)
    variants = tuple(variant_names(path))
    return ShippedTask(
        name_of(file), file, of, one.title, one.source, groups, variants, one.reading
    )


def index() -> list[ShippedTask]:
    """Read all files."""
    return sorted(map(task_of, home().rglob("*.toml")), key=_order)


def index_text(tasks: list[ShippedTask]) -> str:
    """Return the text of the index: a line for each task."""
    rows = (json.dumps(asdict(task), ensure_ascii=False) for task in tasks)
    return "[\n" + ",\n".join(rows) + "\n]\n"


def contact_sheet(tasks: list[ShippedTask], title: str) -> Drawing:
    """Draw the schemes of tasks in their first position, in rows, with their names."""
    rows = -(-len(tasks) // ACROSS)
    width, height = min(len(tasks), ACROSS) * WIDTH, rows * HEIGHT
    sheet = Drawing(width, height, title)
    for k, task in enumerate(tasks):
        row, column = divmod(k, ACROSS)
        corner = complex(column * WIDTH, height - row * HEIGHT)
        box = [corner, corner + WIDTH, corner + complex(WIDTH, -HEIGHT), corner - 1j * HEIGHT]
        sheet.add(Stroke((*box, corner), Pen.THIN))
        picture = scheme_picture(_first(task), 0, letter_height=LETTER, hide_motion=True)
        middle = corner + complex(WIDTH, -(HEIGHT - 2 * HEAD)) / 2
        sheet.extend(picture.place(middle + complex(-picture.width, picture.height) / 2))
        sheet.extend(
            typeset(task.name, HEAD).at(
                corner + complex(WIDTH / 2, 0.4 * HEAD - HEIGHT), anchor="centre"
            )
        )
    return sheet


def _first(task: ShippedTask) -> Solution:
    """Return a task solved in its first position, small enough for a cell."""
    problem = replace(load(home() / task.file), scales=Scales())
    return Solution(problem, positions=problem.drive.positions[:1], views=Views.for_scheme(ROOM))


def document(tasks: list[ShippedTask]) -> dict[Path, bytes]:
    """Return docs/tasks.md and its pictures."""
    kinds = get_language("en").tasks
    files: dict[Path, bytes] = {}
    text = [INTRODUCTION]
    for (kind, structure), some in groupby(tasks, lambda task: (task.kind, task.structure)):
        rows = list(some)
        text.append(f"\n## {structure or kinds[kind]}\n")
        if kind == LINKAGE:
            picture = PICTURES / f"{structure}.svg"
            files[picture] = render(contact_sheet(rows, structure), "svg")
            text.append(f"![{structure}](tasks/{picture.name})\n")
        text += ["| task | title | source |", "| --- | --- | --- |"]
        for task in rows:
            variants = f" ({', '.join(task.variants)})" if task.variants else ""
            mark = " \\*" if task.reading else ""
            link = f"[{task.name}](../problems/{task.file}){variants}{mark}"
            text.append(f"| {link} | {task.title} | {task.source} |")
    files[DOCUMENT] = ("\n".join(text) + "\n").encode()
    return files


def main() -> None:
    """Write all of it; pictures of structures that are no more are removed."""
    tasks = index()
    files = document(tasks)
    for old in set(PICTURES.glob("*.svg")) - set(files):
        old.unlink()
    for path, data in {home() / "index.json": index_text(tasks).encode(), **files}.items():
        write(path, data)


if __name__ == "__main__":
    main()
