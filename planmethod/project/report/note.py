"""The explanatory note: its chapters in order, those that the file has (пояснительная записка)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from planmethod.cams.model import CamProblem
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.model import GearProblem
from planmethod.note import document
from planmethod.note.document import Document, Node
from planmethod.note.formula import Rich
from planmethod.note.wording import Language
from planmethod.plans.model import RATES
from planmethod.project.model import PartName, Project, SheetEntry
from planmethod.project.report.balancing import balancing_chapter
from planmethod.project.report.cams import cam_chapter
from planmethod.project.report.conclusion import back, conclusion
from planmethod.project.report.context import NBSP, Report
from planmethod.project.report.flywheel import flywheel_chapter
from planmethod.project.report.forces import ForceChapter
from planmethod.project.report.front import front
from planmethod.project.report.gears import meshing_chapter, train_chapter
from planmethod.project.report.plans import PlanChapter
from planmethod.project.report.position import position_part
from planmethod.project.report.results import results_parts
from planmethod.project.report.structure import structure_chapter
from planmethod.project.report.turn import diagrams_part, has_turn, transfer_chapter


def note_document(
    project: Project, language: Language, sheets: Sequence[SheetEntry] = ()
) -> Document:
    """Return the explanatory note of a project (пояснительная записка).

    It has the chapters that the file has something for; its numbers are those of the sheets.

    Parameters
    ----------
    project : Project
    language : Language
    sheets : sequence of SheetEntry
        The sheets of the project where they are drawn; else the parts are listed.

    Raises
    ------
    PositionError
        Where the mechanism cannot be assembled or a force plan does not close.
    """
    units = sorted(set(language.note["units"].values()), key=len, reverse=True)
    tie = re.compile(rf"(?<=\d) (?=(?:{'|'.join(map(re.escape, units))}|%)(?![^\W\d_]))")
    return Document.of(_tied(node, tie) for node in _nodes(Report(project, language), sheets))


def _nodes(report: Report, sheets: Sequence[SheetEntry]) -> Iterator[Node]:
    yield from front(report)
    for node in _chapters(report):
        if isinstance(node, document.Chapter):
            yield document.PageBreak()
        yield node
    yield from conclusion(report)
    yield from back(report, sheets)


def _chapters(report: Report) -> Iterator[Node]:
    yield from structure_chapter(report)
    yield from position_part(report)
    for kind in RATES:
        yield from PlanChapter(report, kind).nodes()
    yield from results_parts(report)
    if has_turn(report):
        yield from diagrams_part(report)
    yield from transfer_chapter(report)
    if report.has(PartName.FORCES):
        yield from ForceChapter(report).nodes()
    if report.has(PartName.FLYWHEEL):
        yield from flywheel_chapter(report)
    if report.has(PartName.BALANCING):
        yield from balancing_chapter(report)
    for part in report.project.parts:
        if isinstance(part.problem, GearProblem):
            yield from train_chapter(report, part.problem)
        elif isinstance(part.problem, MeshingProblem):
            yield from meshing_chapter(report, part.problem)
        elif isinstance(part.problem, CamProblem):
            yield from cam_chapter(report, part.problem)


def _tied(node: Node, tie: re.Pattern[str]) -> Node:
    """Return a node in whose texts numbers and their units stay together, with one kind of dash."""

    def tied(text: Rich) -> Rich:
        return tie.sub(NBSP, text).replace(" — ", f"{NBSP}– ")

    match node:
        case document.Paragraph() | document.Item() | document.Formula() | document.Note():
            return replace(node, text=tied(node.text))
        case document.Step():
            return replace(node, lines=tuple(map(tied, node.lines)))
        case document.Figure():
            return replace(node, caption=tie.sub(NBSP, node.caption))
        case _:
            return node
