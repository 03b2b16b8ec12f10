"""Linkages (рычажные механизмы), as a kind of problem."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planmethod.kind import ProblemKind, SketchedFile
from planmethod.options import PlanRequest, ResultRequest

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.mechanism.structure import Structure
    from planmethod.note.audit import Audited
    from planmethod.note.document import Document, GivenFact
    from planmethod.note.records.spreadsheet import SpreadsheetRows
    from planmethod.note.wording import Language
    from planmethod.problem.model import Problem
    from planmethod.render.ink.drawing import Drawing
    from planmethod.render.play.playback import Playback
    from planmethod.render.sheets.controlled import CheckedSheet
    from planmethod.solved.aligned.schemes import SelfAligning
    from planmethod.solved.many.variants import Batch
    from planmethod.solved.partial_mechanism import MechanismPart
    from planmethod.solved.solution import Solution
    from planmethod.solved.view_space import Views


class Linkages(ProblemKind["Problem"]):
    """Linkages (рычажные механизмы), as a kind of problem: the only one that has plans."""

    table = "links"

    # Reading

    def load(self, path: Path, variant: str | None) -> Problem:
        """Read a problem file."""
        from planmethod.linkages.reading import load

        return load(path, variant=variant)

    def load_each(self, path: Path, variants: Iterable[str | None]) -> Iterator[Problem]:
        """Read some variants of a problem file, the file itself once."""
        from planmethod.linkages.reading import load_each

        return load_each(path, variants)

    def decided(self, problem: Problem, *, drawn: bool = True) -> Problem:
        """Return a problem with the decisions of its project, if it has one."""
        if not problem.is_project:
            return problem
        from planmethod.project.settle import in_positions, with_decisions

        return with_decisions(problem) if drawn else in_positions(problem)

    def rounded(self, problem: Problem, step: str) -> tuple[Problem, str]:
        """Return a problem whose sizes by a figure are rounded, and a sentence on the changes."""
        from planmethod.linkages.reading import rounded, rounding_note

        if problem.drawn is None or problem.drawn.shown is None:
            return super().rounded(problem, step)
        changed = rounded(problem, step)
        return changed, rounding_note(changed)

    def reading_warnings(self, problem: Problem) -> Iterator[object]:
        """Yield the warnings about a problem as read."""
        from planmethod.linkages.reading import reading_warnings

        return reading_warnings(problem)

    def unused_table_warnings(self, problem: Problem) -> Iterator[object]:
        """Yield the warnings about tables of other kinds in its file, without a project."""
        from planmethod.linkages.reading import unused_table_warnings

        return iter(()) if problem.is_project else unused_table_warnings(problem)

    def accuracy_warnings(self, problem: Problem) -> Iterator[object]:
        """Yield the warnings about positions in which its results have few digits."""
        from planmethod.solved.selfcheck import accuracy_warnings

        return accuracy_warnings(problem)

    def reject_options(self, problem: Problem, request: ResultRequest | PlanRequest) -> None:
        """Take all options."""

    def reject_as_project(self, path: Path) -> None:
        """Take every file: its linkage may be a course project."""

    # Numbers

    def record(self, problem: Problem, lang: str) -> dict[str, Any]:
        """Return the record of ``solve --json``."""
        from planmethod.note.records.solution import record
        from planmethod.solved.solution import Solution

        return record(Solution(problem))

    def solved_document(self, problem: Problem, language: Language) -> Document:
        """Return the document of ``solve``."""
        from planmethod.note.tables.results import results_document
        from planmethod.solved.solution import Solution

        return results_document(Solution(problem), language)

    def spreadsheet(self, problem: Problem) -> SpreadsheetRows:
        """Return the table of ``solve --csv``."""
        from planmethod.note.records.spreadsheet import solved_table
        from planmethod.solved.solution import Solution

        return solved_table(Solution(problem))

    def solved_documents(
        self, problem: Problem, language: Language, request: ResultRequest
    ) -> Iterator[Document]:
        """Yield the documents that ``solve`` prints with its options."""
        from planmethod.linkages.sheets import in_places
        from planmethod.linkages.solving import solved_documents

        problem, request = in_places(problem, request)
        return solved_documents(problem, language, request)

    def solved_data(self, problem: Problem, lang: str, request: ResultRequest) -> Any:
        """Return the data that ``solve`` gives with its options: a record, rows or arrays."""
        from planmethod.linkages.sheets import in_places
        from planmethod.linkages.solving import solved_data

        problem, request = in_places(problem, request)
        return solved_data(problem, lang, request)

    def solved_together(
        self, problems: Sequence[Problem], request: ResultRequest
    ) -> dict[int, Any]:
        """Return the same of those problems that can be solved together, by index."""
        from planmethod.linkages.solving import solved_together

        return solved_together(problems, request)

    def batches(
        self, problems: Sequence[Problem], profile: Profile
    ) -> list[tuple[Batch, list[int]]]:
        """Return the problems that are drawn by the same steps, as batches with their indices."""
        from planmethod.solved.many.variants import in_batches

        return in_batches(problems, profile)

    # Structure

    def structure_record(self, problem: Problem) -> dict[str, Any]:
        """Return the record of ``structure --json``."""
        from planmethod.note.records.solution import structure_in_full

        found, aligned = _structure_of(problem)
        whole = structure_in_full(found, problem.mechanism, aligned)
        return {"schema": 1, "problem": problem.name, "structure": whole}

    def structure_document(self, problem: Problem, language: Language) -> Document:
        """Return the document of ``structure``."""
        from planmethod.note.narrate.structure import structure_document

        found, aligned = _structure_of(problem)
        return structure_document(
            problem.mechanism, found, language, problem.sheet.notation, aligned
        )

    def structure_drawings(self, problem: Problem, fields: Mapping[str, str]) -> list[Drawing]:
        """Return the structural sheet."""
        from planmethod.render.sheets.structure import structure_sheet

        return [structure_sheet(problem, *_structure_of(problem), fields=fields)]

    # Texts and drawings

    def protocol_document(
        self, problem: Problem, language: Language, request: PlanRequest
    ) -> Document:
        """Return the document of ``protocol``."""
        from planmethod.linkages.sheets import in_places
        from planmethod.linkages.solving import protocol

        problem, request = in_places(problem, request)
        return protocol(problem, language, request)

    def playback(self, problem: Problem, language: Language, request: PlanRequest) -> Playback:
        """Return the construction of a position as it is played."""
        from planmethod.linkages.sheets import in_places
        from planmethod.linkages.solving import playback

        problem, request = in_places(problem, request)
        return playback(problem, language, request)

    def drawings(self, problem: Problem, request: PlanRequest) -> list[Drawing]:
        """Return the sheets."""
        from planmethod.linkages.sheets import drawings, in_places

        problem, request = in_places(problem, request)
        return drawings(problem, request)

    def in_positions(self, problem: Problem, request: PlanRequest) -> Problem:
        """Return a problem with the positions in which it is drawn."""
        from planmethod.linkages.sheets import in_positions

        return in_positions(problem, request)

    def sheet_warnings(self, problem: Problem, request: PlanRequest) -> Iterator[object]:
        """Yield the warnings about its sheets before they are drawn."""
        from planmethod.linkages.sheets import in_places, sheet_warnings

        problem, request = in_places(problem, request)
        return sheet_warnings(problem, request)

    def checked_sheets(
        self, problem: Problem, request: PlanRequest
    ) -> tuple[str, list[CheckedSheet]]:
        """Return the kind of its sheets, and the sheets with the remarks of the norm control."""
        from planmethod.linkages.sheets import checked_sheets, in_places

        problem, request = in_places(problem, request)
        return checked_sheets(problem, request)

    def live_page(self, problem: Problem, lang: str) -> str:
        """Return the page that ``live`` writes."""
        from planmethod.render.live.page import live_page

        return live_page(problem, lang)

    def scheme(self, problem: Problem) -> Drawing:
        """Return the scheme without any results."""
        from planmethod.render.sketch import assigned
        from planmethod.solved.solution import Solution

        return assigned(Solution(problem))

    def part(self, path: Path, *, variant: str | None, views: Views) -> tuple[str, MechanismPart]:
        """Return the title of a file, finished or not, and as much of it as can be drawn."""
        from planmethod.linkages.reading import part_of

        return part_of(path, variant=variant, views=views)

    def sketched(self, path: Path, variant: str | None, language: Language) -> SketchedFile:
        """Return the sketch of a file in an editor: its scheme."""
        from planmethod.render.sketch import VIEWS, sketch

        title, part = self.part(path, variant=variant, views=VIEWS)
        count = len(part.assemblies)
        is_there = part.solution is not None or count or part.fixed
        return SketchedFile(
            sketch(part, title, language, []) if is_there else None,
            title,
            part.faults,
            part.error,
            count,
            moves=part.solution is not None and part.error is None,
        )

    def task_picture(self, path: Path, language: Language) -> Drawing:
        """Return the picture of a shipped task: its scheme, without results."""
        from planmethod.render.sketch import VIEWS, assigned, sketch

        title, part = self.part(path, variant=None, views=VIEWS)
        if part.solution is None:
            return sketch(part, title, language, [])
        return assigned(part.solution)

    # Questions

    def audited(self, problem: Problem, ruler: float) -> list[Audited]:
        """Return printed values beside the exact ones and those read with a ruler."""
        from planmethod.note.audit import audit

        return audit(problem, ruler=ruler)

    def given_facts(self, problem: Problem, language: Language) -> list[GivenFact]:
        """Return the given data, one fact each: the figure, the sizes, the loads."""
        from planmethod.note.narrate.forces.statement import statement
        from planmethod.note.narrate.statement import drawn, given_facts
        from planmethod.solved.forces.reading import ForceReading
        from planmethod.solved.solution import Solution

        facts = [drawn(problem, language), *given_facts(problem, language)]
        if problem.dynamics is not None:
            known = {fact.text.partition(" = ")[0] for fact in facts}
            loads = statement(ForceReading(Solution(problem), problem.calculated or 0), language)
            facts += [fact for fact in loads if fact.text.partition(" = ")[0] not in known]
        return facts

    def answer_source(self, problem: Problem) -> Solution:
        """Return the plans with which answers are compared."""
        from planmethod.solved.solution import Solution

        return Solution(problem)


def _structure_of(problem: Problem) -> tuple[Structure, SelfAligning]:
    """Return the structure of a mechanism, and its schemes without redundant constraints."""
    from planmethod.solved.aligned.schemes import self_aligning
    from planmethod.solved.assembly_modes import structure_of

    found = structure_of(problem)
    return found, self_aligning(problem, found)
