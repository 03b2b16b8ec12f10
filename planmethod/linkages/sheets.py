"""Sheets of linkages for the commands: drawing, warnings, norm control (нормоконтроль)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from msgspec.structs import replace

from planmethod.errors import LayoutError
from planmethod.languages import translate
from planmethod.linkages.reading import unused_table_warnings
from planmethod.options import PlanRequest, ResultRequest, UsageError, message_name
from planmethod.problem.model import SAME_DEG, Problem, Scales
from planmethod.solved.selfcheck import accuracy_warnings, motion_warnings
from planmethod.solved.solution import Solution
from planmethod.solved.turn.determined import with_places

if TYPE_CHECKING:
    from planmethod.render.ink.drawing import Drawing
    from planmethod.render.sheets.controlled import CheckedSheet

MAX_SHEETS = 6
"""Maximum number of sheets of one problem without confirmation."""


def in_positions(problem: Problem, request: PlanRequest) -> Problem:
    """Return a problem in other positions than its own, where the decisions of a project end."""
    if request.phi is None and request.position is None:
        return problem
    return replace(problem, calculated=request.position)


R = TypeVar("R", PlanRequest, ResultRequest)


def in_places(problem: Problem, request: R) -> tuple[Problem, R]:
    """Return a problem in positions that are listed of each driving link, and the rest to do.

    Raises
    ------
    UsageError
        Fewer or more lists than driving links.
    """
    lists, links = request.phi, problem.drive.links
    if lists is None or lists.ndim == 1:
        return problem, request
    if len(lists) != len(links):
        raise UsageError(
            "--phi: {0} list{0:||s} for {1} driving link{1:||s} ({2}). Give a list of each, with "
            "/ between them.",
            len(lists),
            len(links),
            ", ".join(links),
        )
    return with_places(problem, lists.tolist()), replace(request, phi=None)


def drawings(problem: Problem, request: PlanRequest) -> list[Drawing]:
    """Draw the sheets of the plans.

    Raises
    ------
    LayoutError
        The content does not fit.
    click.UsageError
        Graphs over the turn are requested of a slider.
    """
    from planmethod.render.frame import Furniture
    from planmethod.render.sheets.kinematics import kinematics_sheets

    positions = None if request.phi is None else request.phi.tolist()
    furniture = Furniture.of(problem.sheet, before=request.before, total=request.total)
    if request.compact and not problem.sheet.form:  # one set: GOST 2.104, later sheets of a drawing
        furniture = replace(furniture, form="1+2a")
    if request.quantities and not problem.drive.goes_round:
        raise UsageError("--ask: {}: the driver slides and has no turn", message_name(problem))
    return kinematics_sheets(
        compacted(problem, positions) if request.compact else problem,
        positions=positions,
        profile=request.profile,
        fields=request.fields,
        furniture=furniture,
        errors=request.drawing.errors,
        sigma=request.drawing.sigma,
        layout=request.layout,
        most=None if request.drawing.all_positions or request.compact else MAX_SHEETS,
        asked=request.quantities,
    )


def compacted(problem: Problem, positions: Sequence[float] | None) -> Problem:
    """Return a problem without its scales, which are for larger paper.

    Raises
    ------
    LayoutError
        There are more positions than fit on small paper.
    """
    from planmethod.solved.legibility import FEW

    asked = problem.drive.positions if positions is None else positions
    if len(asked) > FEW:
        raise LayoutError(
            "{}: --compact is for at most {} positions, {} are requested. Request fewer "
            "(--phi 30,150), or omit --compact.",
            problem.name,
            FEW,
            len(asked),
        )
    return replace(problem, scales=Scales(convention=problem.scales.convention))


# Warnings ----------------------------------------------------------------------------------------


def sheet_warnings(problem: Problem, request: PlanRequest) -> Iterator[object]:
    """Yield the warnings about the sheets of a problem before they are drawn."""
    layout, phi = request.layout, request.phi
    if problem.is_project and layout is None:
        yield from unused_table_warnings(problem)
    yield from motion_warnings(problem, phi)
    drawn = _drawn_positions(problem, request)
    yield from accuracy_warnings(problem, drawn, forces=_has_forces(layout))
    if layout is not None:
        yield from _omitted_sheets(problem, layout)
        if phi is None:
            yield from _unused_positions(problem, layout)
    if problem.machine is not None and _has_flywheel(layout):
        from planmethod.solved.machine.chain import flywheel_warnings
        from planmethod.solved.machine.flywheel import Flywheel

        yield from flywheel_warnings(Flywheel(problem))


def _drawn_positions(problem: Problem, request: PlanRequest) -> list[float] | None:
    """Return the positions of the sheets; None for those of the file."""
    if request.phi is not None:
        return [float(place) for place in request.phi]
    if request.layout is None or not problem.drive.goes_round:
        return None
    from planmethod.render.sheets.composition import composition

    if not composition(request.layout).cycle:
        return None
    from planmethod.solved.turn.extremes import numbered_positions

    return [float(place) for place in numbered_positions(Solution(problem))]


def _unused_positions(problem: Problem, layout: str) -> Iterator[object]:
    """Yield the warning that sheets of the cycle leave the positions of ``driver.phi`` out."""
    from planmethod.render.sheets.composition import composition

    drive = problem.drive
    if problem.cycle is not None or not drive.goes_round or len(drive.positions) < 2:
        return
    if not composition(layout).cycle:
        return
    from planmethod.solved.turn.extremes import numbered_positions

    positions = numbered_positions(Solution(problem)).tolist()
    apart = [abs((a - b + 180.0) % 360.0 - 180.0)
             for a, b in zip(positions, drive.positions, strict=False)]  # fmt: skip
    if len(positions) != len(drive.positions) or max(apart) > SAME_DEG:
        yield translate(
            "layout {} has the positions of the cycle, {} from {:.5g}° on, not the {} of "
            "driver.phi from {:.5g}° on. With [cycle] zero = {:g}, count = {} in place of "
            "phi, all outputs have the same positions; --phi selects others.",
            layout,
            len(positions),
            positions[0],
            len(drive.positions),
            drive.positions[0],
            drive.positions[0],
            len(drive.positions),
        )


def _omitted_sheets(problem: Problem, layout: str) -> Iterator[object]:
    """Yield the warning that sheets of forces are left out, since the file has no forces."""
    from planmethod.render.sheets.composition import composition
    from planmethod.render.sheets.kinematics import sheets_without_forces

    omitted = sheets_without_forces(composition(layout), problem)
    if omitted:
        yield translate(
            "layout {}: the file has neither [dynamics] nor [[loads]], so the sheets of forces "
            "are omitted: {}.",
            layout,
            ", ".join(map(str, omitted)),
        )


def _has_forces(layout: str | None) -> bool:
    """Return whether the sheets show forces, or results of them."""
    from planmethod.render.sheets.blocks import has_forces
    from planmethod.render.sheets.composition import composition

    return layout is not None and any(
        has_forces(entry.kind) for entry in composition(layout).blocks
    )


def _has_flywheel(layout: str | None) -> bool:
    """Return whether the sheets show the sizes of a flywheel."""
    from planmethod.render.sheets.composition import composition

    return layout is not None and any(
        entry.kind == "flywheel" for entry in composition(layout).blocks
    )


# Norm control ------------------------------------------------------------------------------------


def checked_sheets(problem: Problem, request: PlanRequest) -> tuple[str, list[CheckedSheet]]:
    """Return which sheets are checked, of a project all of its parts, and the sheets."""
    from planmethod.render.sheets.controlled import controlled_kinematics, controlled_structure
    from planmethod.render.sheets.kinematics import kinematics_sheets

    phi, layout, shown = request.phi, request.layout, request.drawing
    if request.structural:
        return "structure", controlled_structure(problem, fields=request.fields)
    usual = phi is None and layout is None and not shown.errors and shown.sigma is None
    if usual and _is_project(problem):
        return "project", _sheets_of_project(problem, request)
    draw = partial(
        kinematics_sheets,
        positions=None if phi is None else phi.tolist(),
        profile=request.profile,
        fields=request.fields,
        errors=shown.errors,
        sigma=shown.sigma,
        layout=layout,
    )
    return "kinematics", controlled_kinematics(in_positions(problem, request), draw)


def _is_project(problem: Problem) -> bool:
    """Return whether a file has [project], or parts of a project beside its linkage.

    A cam that drives the linkage is not such a part.
    """
    from planmethod.project.parts import PART_KINDS

    driving = set() if problem.drive.cam_drive is None else {"cam"}
    parts = {kind.table for kind in PART_KINDS.values()} - driving
    return problem.is_project or bool(problem.tables.keys() & parts)


def _sheets_of_project(problem: Problem, request: PlanRequest) -> list[CheckedSheet]:
    """Return the sheets of all parts of a project, as it draws them, inspected."""
    from planmethod.project.settle import settle
    from planmethod.project.sheets import numbered_set, part_drawings
    from planmethod.render.sheets.controlled import check_drawings

    project = settle(problem, Path(problem.source_file))
    drawn = [part_drawings(project, part, request.fields) for part in project.parts]
    return [
        sheet
        for part, sheets in zip(project.parts, numbered_set(project, drawn), strict=True)
        for sheet in check_drawings(sheets, part.scales)
    ]
