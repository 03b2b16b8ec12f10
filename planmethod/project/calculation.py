"""The calculation of a project or of a homework, chapter by chapter (расчёт проекта)."""

from __future__ import annotations

from collections.abc import Collection, Sequence

from planmethod.cams.calculation import cam_chapter
from planmethod.cams.model import CamProblem
from planmethod.cams.shaft import Camshaft
from planmethod.cams.shaft_calculation import camshaft_chapters
from planmethod.errors import OutputError
from planmethod.gears.calculation import train_chapter
from planmethod.gears.involute.calculation import meshing_chapter
from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.model import GearProblem
from planmethod.note.accounts.machine import machine_narrator
from planmethod.note.calculation.balancing import BalancingChapter
from planmethod.note.calculation.machine import FlywheelChapter, turns_through
from planmethod.note.calculation.model import CalculationBuilder, LivingCalculation
from planmethod.note.calculation.motion import linkage_chapters
from planmethod.note.calculation.synthesis import synthesis_chapter
from planmethod.note.synthesis.drawing import construction_of
from planmethod.note.wording import Language, get_language
from planmethod.note.writers.calculationbook import calculation_workbook
from planmethod.note.writers.notebook import notebook
from planmethod.problem.records import KindProblem
from planmethod.project.parts import PartName
from planmethod.project.settle import Homework, Project
from planmethod.solved.machine.balancing import balancing_of
from planmethod.solved.machine.flywheel import flywheel_of

FORMATS = ("xlsx", "ipynb")
"""Formats of a calculation."""


def calculation_of(
    project: Project | Homework, parts: Collection[str] | None = None
) -> LivingCalculation:
    """Return the calculation, with the chapters that the parts of the file have.

    Its given data and values are those of the note; every chapter is a sheet.

    Parameters
    ----------
    parts : collection of str, optional
        Names of those that are wanted beside the motion. Default: all.

    Raises
    ------
    OutputError
        The kind of problem has no such calculation.
    PlanMethodError
        As of the part.
    """
    language = get_language(project.language)
    texts = language.calculation
    builder = CalculationBuilder(texts.not_reproduced.format())
    if isinstance(project, Homework):
        _part(project.problem, builder, language)
    else:
        _linkage(project, builder, language, parts)
        for part in project.parts:
            if parts is None or part.name.value in parts:
                _part(part.problem, builder, language)
    if not builder.chapters:
        text = "{} has no calculation by formulas; write its note as docx or pdf"
        raise OutputError(text, project.problem.name)
    title = project.problem.title or project.problem.name
    return builder.finished(texts.title.format(title=title), texts.given_data.format())


def calculation_files(
    calculation: LivingCalculation, basename: str, lang: str, formats: Sequence[str] = FORMATS
) -> dict[str, bytes]:
    """Return the files of a calculation by their names: a workbook, a notebook."""
    texts = get_language(lang).calculation
    writers = {"xlsx": calculation_workbook, "ipynb": notebook}
    return {f"{basename}.{fmt}": writers[fmt](calculation, texts) for fmt in formats}


def _linkage(
    project: Project,
    builder: CalculationBuilder,
    language: Language,
    parts: Collection[str] | None,
) -> None:
    texts, solution = language.calculation, project.solution

    def is_requested(name: PartName) -> bool:
        has = any(part.name is name for part in project.parts)
        return has and (parts is None or name.value in parts)

    heads = [texts.position.format(number=k) for k in range(len(project.positions))]
    heads = heads if len(heads) > 1 else [texts.value]
    if is_requested(PartName.SYNTHESIS):
        synthesis_chapter(construction_of(solution), builder, language)
    linkage_chapters(solution, heads, builder, language)
    if is_requested(PartName.FLYWHEEL):
        flywheel = flywheel_of(solution)
        if turns_through(project.positions, flywheel):
            FlywheelChapter(machine_narrator(solution, language), builder, language).write()
            builder.close(texts.machine.format(), heads)
    if is_requested(PartName.BALANCING):
        BalancingChapter(solution, balancing_of(solution), builder, language).write()
        builder.close(texts.balancing.format(), heads)


def _part(problem: KindProblem, builder: CalculationBuilder, language: Language) -> None:
    match problem:
        case GearProblem():
            train_chapter(problem, builder, language)
        case MeshingProblem():
            meshing_chapter(problem, builder, language)
        case CamProblem():
            cam_chapter(problem, builder, language)
        case Camshaft():
            camshaft_chapters(problem, builder, language)
        case _:
            pass
