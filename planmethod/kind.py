"""Interface of a kind of problem other than linkages to the commands (вид задачи)."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.problem.records import KindProblem

if TYPE_CHECKING:
    from planmethod.construct.drafting import Profile
    from planmethod.note.audit import Audited
    from planmethod.note.document import Document, GivenFact
    from planmethod.note.records.spreadsheet import SpreadsheetRows
    from planmethod.note.wording import Language
    from planmethod.problem.records import QuestionQuantities
    from planmethod.render.ink.drawing import Drawing

P = TypeVar("P", bound=KindProblem)


class ProblemKind(ABC, Generic[P]):
    """A kind of problem; its methods import what they need when they are called.

    Attributes
    ----------
    table : str
        The table of the problem file by which it is recognised.
    scales : str
        Where its file has the scales.
    is_of_project : bool
        Whether a linkage's file may have it as a part of its project.
    """

    table: ClassVar[str]
    scales: ClassVar[str] = "[scales]"
    is_of_project: ClassVar[bool] = True

    @abstractmethod
    def load(self, path: Path, variant: str | None) -> P:
        """Read a problem file."""

    @abstractmethod
    def record(self, problem: P, lang: str) -> dict[str, Any]:
        """Return the record of ``solve --json``."""

    @abstractmethod
    def solved_document(self, problem: P, language: Language) -> Document:
        """Return the document of ``solve``."""

    def spreadsheet(self, problem: P) -> SpreadsheetRows | None:
        """Return the text that ``solve --csv`` prints; None for a kind without a table."""
        return None

    def structure_record(self, problem: P) -> dict[str, Any] | None:
        """Return the record of ``structure --json``; None for a kind without a structure."""
        return None

    def structure_document(self, problem: P, language: Language) -> Document | None:
        """Return the document of ``structure``; None for a kind without a structure."""
        return None

    @abstractmethod
    def protocol_document(self, problem: P, language: Language, profile: Profile) -> Document:
        """Return the document of ``protocol``."""

    @abstractmethod
    def drawings(
        self,
        problem: P,
        *,
        fields: Mapping[str, str],
        profile: Profile,
        before: int = 0,
        total: int | None = None,
    ) -> list[Drawing]:
        """Return the sheets; ``before`` of the set of ``total`` go before them."""

    def has(self, method: str) -> bool:
        """Return whether this kind of problem implements the method of this name."""
        return getattr(type(self), method, None) is not getattr(ProblemKind, method, None)

    def live_page(self, problem: P, lang: str) -> str:
        """Return the page that ``live`` writes.

        Raises
        ------
        ProblemError
            Such problems have no page that moves.
        """
        raise self._without(problem, "live page")

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

    def scheme(self, problem: P) -> Drawing | None:
        """Return the scheme without any results; None for a kind without one."""
        return None

    def question_quantities(self, problem: P) -> QuestionQuantities:
        """Return the quantities for questions to students.

        Raises
        ------
        ProblemError
            Answers to such problems are not checked.
        """
        raise self._without(problem, "checking of answers")

    def _without(self, problem: P, item: str) -> ProblemError:
        message = translate("such a problem has no {}; its numbers: planmethod solve", item)
        return ProblemError(problem.name, [Fault(self.table, message)])
