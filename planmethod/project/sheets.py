"""Sheets of a project (листы проекта): those of every part, numbered as one set."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import assert_never

from msgspec.structs import replace

from planmethod.note.tables.forces import rubbed
from planmethod.note.wording import Language, get_language
from planmethod.options import PlanRequest
from planmethod.paper import FORMATS
from planmethod.project.parts import PART_KINDS, PartName
from planmethod.project.settle import PAPER, Project, ProjectPart, SheetEntry, first_sheet
from planmethod.render.frame import Furniture, numbered
from planmethod.render.ink.drawing import Drawing
from planmethod.render.sheets.composition import composition
from planmethod.render.sheets.kinematics import kinematics_sheets
from planmethod.render.sheets.model import Composition


def part_drawings(project: Project, part: ProjectPart, fields: Mapping[str, str]) -> list[Drawing]:
    """Return the sheets of a part, not numbered yet (`numbered_set`).

    Parameters
    ----------
    fields : mapping
        Texts of the title block that outrank the file's.

    Raises
    ------
    LayoutError
        The content does not fit.
    """
    problem, language = project.problem, get_language(project.language)
    # Which form of the title block a sheet has depends on whether it is the first of the set.
    before = 0 if part is project.parts[0] else 1
    around = Furniture.of(problem.sheet, before=before)
    match part.name:
        case PartName.SYNTHESIS:
            alone = replace(problem, sheet=replace(problem.sheet, paper=None))  # it is small
            return kinematics_sheets(alone, layout="synthesis", fields=fields, furniture=around)
        case PartName.KINEMATICS:
            return first_sheet(problem, fields=fields, furniture=around)
        case PartName.FORCES:
            found = []
            for name in ("project-forces", *(["friction"] if rubbed(problem) else [])):
                found += kinematics_sheets(
                    problem,
                    layout=_of_position(composition(name, language.lang), project, language),
                    paper=project.paper or PAPER,
                    fields=fields,
                    furniture=around,
                )
            if problem.cycle is not None:
                found += kinematics_sheets(
                    problem, layout="forces-cycle", fields=fields, furniture=around
                )
            return found
        case PartName.FLYWHEEL:
            machine = problem.machine
            layouts = ["flywheel"]
            if machine is not None and (machine.motor or machine.brake) is not None:
                layouts.append("run-up")
            return [
                drawing
                for layout in layouts
                for drawing in kinematics_sheets(
                    problem, layout=layout, fields=fields, furniture=around
                )
            ]
        case PartName.BALANCING:
            return kinematics_sheets(problem, layout="balancing", fields=fields, furniture=around)
        case PartName.GEARS | PartName.MESHING | PartName.CAM:
            titled = replace(part.problem, title=language.project["titles"][part.name.value])
            request = PlanRequest(fields=fields, before=before)
            return PART_KINDS[part.name].drawings(
                part.problem if part.problem.title else titled, request
            )
        case PartName.NOTE:
            return []
        case _:
            assert_never(part.name)


def _of_position(layout: Composition, project: Project, language: Language) -> Composition:
    """Return a composition whose views name their position."""
    if len(project.positions) == 1:
        return layout

    def titled(title: str) -> str:
        return language.sheets.of_position.format(title=title, number=project.calculated)

    views = language.sheets["views"]
    names = {"loads": language.sheets.loads, "lever": language.sheets.lever}
    names["friction-text"] = language.friction.title
    blocks = []
    for entry in layout.blocks:
        name = names.get(entry.kind)
        if entry.kind == "plan" and entry.of is not None:
            name, _ = views[entry.of.value]
        blocks.append(replace(entry, title=titled(name)) if name else entry)
    return replace(layout, blocks=tuple(blocks))


def numbered_set(project: Project, sheets: Sequence[Sequence[Drawing]]) -> list[list[Drawing]]:
    """Return the sheets of all parts with their numbers in one set (Лист, Листов)."""
    total, before = sum(map(len, sheets)), 0
    found: list[list[Drawing]] = []
    for some in sheets:
        around = Furniture.of(project.problem.sheet, before=before, total=total)
        found.append([numbered(one, around, k) for k, one in enumerate(some, 1)])
        before += len(some)
    return found


def sheet_list(project: Project, sheets: Sequence[Sequence[Drawing]]) -> tuple[SheetEntry, ...]:
    """Return the entries of the list of sheets in the note (перечень листов)."""
    sizes = {(paper.width, paper.height): paper for paper in FORMATS.values()}
    found = [
        (part.name, one) for part, some in zip(project.parts, sheets, strict=True) for one in some
    ]
    return tuple(
        SheetEntry(name, number, one.title, sizes[one.width, one.height])
        for number, (name, one) in enumerate(found, 1)
    )


def flat(sheets: Iterable[Iterable[Drawing]]) -> list[Drawing]:
    """Return the sheets of all parts in a row."""
    return [drawing for some in sheets for drawing in some]
