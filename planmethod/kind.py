"""Interface of a kind of problem to the commands, linkages among them (вид задачи)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from msgspec import Struct

from planmethod.errors import Fault, PlanMethodError, ProblemError
from planmethod.languages import translate
from planmethod.options import (
    PlanRequest,
    ResultRequest,
    UsageError,
    find_linkage_options,
    message_name,
)
from planmethod.problem.records import KindProblem, in_language

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.note.audit import Audited
    from planmethod.note.document import Document, GivenFact
    from planmethod.note.records.spreadsheet import SpreadsheetRows
    from planmethod.note.wording import Language
    from planmethod.problem.records import QuestionQuantities
    from planmethod.render.ink.drawing import Drawing
    from planmethod.render.play.playback import Playback
    from planmethod.render.sheets.controlled import CheckedSheet
    from planmethod.solved.many.variants import Batch
    from planmethod.solved.partial_mechanism import MechanismPart
    from planmethod.solved.solution import Solution
    from planmethod.solved.view_space import Views

P = TypeVar("P", bound=KindProblem)


class SketchedFile(Struct, frozen=True):
    """Sketch of a problem file in an editor (эскиз файла).

    Attributes
    ----------
    drawing : Drawing or None
    title : str
    faults : tuple of Fault
        Faults of the file.
    error : PlanMethodError or None
        Why the whole cannot be solved.
    assemblies : int
        How many assembly modes the file leaves.
    moves : bool
        Whether all of it can be drawn.
    """

    drawing: Drawing | None
    title: str
    faults: tuple[Fault, ...] = ()
    error: PlanMethodError | None = None
    assemblies: int = 0
    moves: bool = True


# The kind ----------------------------------------------------------------------------------------


class ProblemKind(ABC, Generic[P]):
    """A kind of problem; its methods import what they need when they are called.

    A method that a kind does not override is a feature that it lacks, and refuses it here.

    Attributes
    ----------
    table : str
        The table of the problem file by which it is recognised.
    scales : str
        Where its file has the scales.
    """

    table: ClassVar[str]
    scales: ClassVar[str] = "[scales]"

    def has(self, method: str) -> bool:
        """Return whether this kind of problem implements the method of this name."""
        return getattr(type(self), method) is not getattr(ProblemKind, method)

    # Reading

    @abstractmethod
    def load(self, path: Path, variant: str | None) -> P:
        """Read a problem file."""

    def load_each(self, path: Path, variants: Iterable[str | None]) -> Iterator[P]:
        """Read some variants of a problem file, None for its main part."""
        return (self.load(path, variant) for variant in variants)

    def decided(self, problem: P, *, drawn: bool = True) -> P:
        """Return a problem with the decisions of its project, if it has one.

        Without ``drawn`` only its positions are decided, not the scales of its sheets.
        """
        return problem

    def rounded(self, problem: P, step: str) -> tuple[P, str]:
        """Return a problem whose sizes by a figure are rounded, and a sentence on the changes.

        Raises
        ------
        ProblemError
            Its file has no such sizes.
        """
        raise ProblemError(
            problem.source_file,
            [Fault("drawn.points", translate("missing, so --round has no sizes to round"), "")],
        )

    def reading_warnings(self, problem: P) -> Iterable[object]:
        """Return the warnings about a problem as read."""
        return ()

    def unused_table_warnings(self, problem: P) -> Iterable[object]:
        """Return the warnings about tables of its file that are not used."""
        return ()

    def accuracy_warnings(self, problem: P) -> Iterable[object]:
        """Return the warnings about positions in which its results have few digits."""
        return ()

    def reject_options(self, problem: P, request: ResultRequest | PlanRequest) -> None:
        """Reject the given options that this kind of problem does not have.

        Raises
        ------
        click.UsageError
        """
        names = [*find_linkage_options(request)]
        if self.has("spreadsheet"):
            names = [name for name in names if name != "--csv"]
        if names == ["--position"]:
            raise UsageError(
                "--position selects a position of the driving link, and {} [{}] has no such link; "
                "omit the option",
                message_name(problem),
                self.table,
            )
        if names:
            raise UsageError(
                "{0} {3:|applies|apply} to linkages, and {1} is not a linkage; omit "
                "such options for [{2}]",
                ", ".join(names),
                message_name(problem),
                self.table,
                len(names),
            )

    def reject_as_project(self, path: Path) -> None:
        """Reject a file that cannot be a course project.

        Raises
        ------
        click.UsageError
        """
        raise UsageError(
            "{}: a project needs a linkage; to draw [{}] only: planmethod sheet",
            path.name,
            self.table,
        )

    # Numbers

    @abstractmethod
    def record(self, problem: P, lang: str) -> dict[str, Any]:
        """Return the record of ``solve --json``."""

    @abstractmethod
    def solved_document(self, problem: P, language: Language) -> Document:
        """Return the document of ``solve``."""

    def spreadsheet(self, problem: P) -> SpreadsheetRows:
        """Return the table of ``solve --csv``, of a kind that has one."""
        raise NotImplementedError

    def result_rows(self, problem: P) -> list[dict[str, Any]]:
        """Return the rows of its table of results by the names of columns: those of ``--csv``."""
        table = self.spreadsheet(problem)
        rows = (row for block in table.blocks() for row in block)
        return [dict(zip(table.header, row, strict=True)) for row in rows]

    def solved_documents(
        self, problem: P, language: Language, request: ResultRequest
    ) -> Iterator[Document]:
        """Yield the documents that ``solve`` prints with its options."""
        yield self.solved_document(problem, language)

    def solved_data(self, problem: P, lang: str, request: ResultRequest) -> Any:
        """Return the data that ``solve`` gives with its options: a record, rows or arrays."""
        return (
            self.spreadsheet(problem)
            if request.csv_file is not None
            else self.record(problem, lang)
        )

    def solved_together(self, problems: Sequence[P], request: ResultRequest) -> Mapping[int, Any]:
        """Return the same of those problems that can be solved together, by index."""
        return {}

    def batches(self, problems: Sequence[P], profile: Profile) -> Sequence[tuple[Batch, list[int]]]:
        """Return the problems that can be solved together, as batches with their indices."""
        return ()

    # Structure

    def structure_record(self, problem: P) -> dict[str, Any]:
        """Return the record of ``structure --json``.

        Raises
        ------
        click.UsageError
            Such problems are not mechanisms.
        """
        raise self._without_structure(problem)

    def structure_document(self, problem: P, language: Language) -> Document:
        """Return the document of ``structure``.

        Raises
        ------
        click.UsageError
            Such problems are not mechanisms.
        """
        raise self._without_structure(problem)

    def structure_drawings(self, problem: P, fields: Mapping[str, str]) -> list[Drawing]:
        """Return the structural sheet, of a kind that has one."""
        return []

    # Texts and drawings

    def protocol_document(self, problem: P, language: Language, request: PlanRequest) -> Document:
        """Return the document of ``protocol``.

        Raises
        ------
        ProblemError
            Such problems are computed without a construction.
        """
        raise self._without(problem, "step-by-step protocol")

    def playback(self, problem: P, language: Language, request: PlanRequest) -> Playback:
        """Return the construction as it is played stroke by stroke.

        Raises
        ------
        ProblemError
            Such problems are computed without a construction.
        """
        raise self._without(problem, "construction to play")

    def drawings(self, problem: P, request: PlanRequest) -> list[Drawing]:
        """Return the sheets.

        Raises
        ------
        ProblemError
            Such problems have no sheets.
        """
        raise self._without(problem, "framed sheet")

    def in_positions(self, problem: P, request: PlanRequest) -> P:
        """Return a problem with the positions in which it is drawn."""
        return problem

    def sheet_warnings(self, problem: P, request: PlanRequest) -> Iterable[object]:
        """Return the warnings about its sheets before they are drawn."""
        return ()

    def checked_sheets(self, problem: P, request: PlanRequest) -> tuple[str, list[CheckedSheet]]:
        """Return the kind of its sheets, and the sheets with the remarks of the norm control."""
        from planmethod.render.sheets.controlled import check_drawings

        return self.table, check_drawings(self.drawings(problem, request), self.scales)

    def live_page(self, problem: P, lang: str) -> str:
        """Return the page that ``live`` writes.

        Raises
        ------
        ProblemError
            Such problems have no page that moves.
        """
        raise self._without(problem, "live page")

    def scheme(self, problem: P) -> Drawing | None:
        """Return the scheme without any results; None for a kind without one."""
        return None

    def part(self, path: Path, *, variant: str | None, views: Views) -> tuple[str, MechanismPart]:
        """Return the title of a file, finished or not, and as much of it as can be drawn.

        Raises
        ------
        ProblemError
            The file cannot be read at all, or only whole problems of the kind can be drawn.
        """
        hint = translate("Its picture: planmethod sheet {}", path)
        raise ProblemError(str(path), [Fault(self.table, "only linkages have a sketch", hint)])

    def sketched(self, path: Path, variant: str | None, language: Language) -> SketchedFile:
        """Return the sketch of a file in an editor: the scheme, or the first sheet."""
        problem = in_language(self.load(path, variant), language.lang)
        drawing = self.scheme(problem)
        if drawing is None:
            drawing = self.drawings(problem, PlanRequest())[0]
        return SketchedFile(drawing, problem.title)

    def task_picture(self, path: Path, language: Language) -> Drawing | None:
        """Return the picture of a shipped task, without results."""
        return self.sketched(path, None, language).drawing

    # Questions

    def audited(self, problem: P, ruler: float) -> list[Audited]:
        """Return printed values beside the exact ones and those read with a ruler.

        Raises
        ------
        ProblemError
            Such problems have no audit.
        """
        raise self._without(problem, "audit of printed values")

    def given_facts(self, problem: P, language: Language) -> list[GivenFact]:
        """Return the given data, one fact each; the file can be rebuilt from them."""
        return []

    def answer_source(self, problem: P) -> Solution | QuestionQuantities:
        """Return the plans or the computed quantities with which answers are compared.

        Raises
        ------
        ProblemError
            Answers to such problems are not checked.
        """
        raise self._without(problem, "checking of answers")

    def failing_conditions(self, problem: P) -> Iterable[tuple[str, str]]:
        """Return the conditions that a problem does not meet, each with its place."""
        return ()

    # Refusals

    def _without(self, problem: P, item: str) -> ProblemError:
        message = translate(
            "this kind of problem has no {}; for its results: planmethod solve", item
        )
        return ProblemError(problem.name, [Fault(self.table, message)])

    def _without_structure(self, problem: P) -> UsageError:
        return UsageError("{} is not a mechanism, it has no structure", message_name(problem))
