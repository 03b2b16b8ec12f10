"""Cams (кулачковые механизмы), as a kind of problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from planmethod.kind import ProblemKind
from planmethod.note.document import Document, GivenFact
from planmethod.options import PlanRequest

if TYPE_CHECKING:
    from planmethod.cams.model import CamProblem
    from planmethod.note.records.spreadsheet import SpreadsheetRows
    from planmethod.note.wording import Language
    from planmethod.problem.records import QuestionQuantities
    from planmethod.render.ink.drawing import Drawing
    from planmethod.render.play.playback import Playback


class Cams(ProblemKind["CamProblem"]):
    """Cams (кулачковые механизмы), as a kind of problem."""

    table = "cam"

    def load(self, path: Path, variant: str | None) -> CamProblem:
        """Read a problem file."""
        from planmethod.cams.reader import load

        return load(path, variant=variant)

    def record(self, problem: CamProblem, lang: str) -> dict[str, Any]:
        """Return the record of ``solve --json``."""
        from planmethod.cams.text import record

        return record(problem, lang)

    def spreadsheet(self, problem: CamProblem) -> SpreadsheetRows:
        """Return the text of ``solve --csv``."""
        from planmethod.cams.text import spreadsheet

        return spreadsheet(problem)

    def solved_document(self, problem: CamProblem, language: Language) -> Document:
        """Return the document of ``solve``."""
        from planmethod.cams.text import solved_document

        return Document.of(solved_document(problem, language))

    def protocol_document(
        self, problem: CamProblem, language: Language, request: PlanRequest
    ) -> Document:
        """Return the document of ``protocol``."""
        from planmethod.cams.results import protocol_document

        return Document.of(protocol_document(problem, language, request.profile))

    def playback(self, problem: CamProblem, language: Language, request: PlanRequest) -> Playback:
        """Return the construction as it is played."""
        from planmethod.cams.playback import playback

        return playback(problem, language, request.profile)

    def drawings(self, problem: CamProblem, request: PlanRequest) -> list[Drawing]:
        """Return the sheets."""
        from planmethod.cams.sheet import drawings

        return drawings(problem, request)

    def live_page(self, problem: CamProblem, lang: str) -> str:
        """Return the page that ``live`` writes."""
        from planmethod.cams.live import live_page

        return live_page(problem, lang)

    def given_facts(self, problem: CamProblem, language: Language) -> list[GivenFact]:
        """Return the given data, one fact each; the file can be rebuilt from them."""
        from planmethod.cams.text import given_facts

        return given_facts(problem, language, numbered=True)

    def answer_source(self, problem: CamProblem) -> QuestionQuantities:
        """Return the computed quantities with which answers are compared."""
        from planmethod.cams.results import CamQuantities

        return CamQuantities(problem)
