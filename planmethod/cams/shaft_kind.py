"""Camshafts (кулачковые валы), as a kind of problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from planmethod.kind import ProblemKind
from planmethod.note.document import Document, GivenFact
from planmethod.options import PlanRequest

if TYPE_CHECKING:
    from planmethod.cams.shaft import Camshaft
    from planmethod.note.records.spreadsheet import SpreadsheetRows
    from planmethod.note.wording import Language
    from planmethod.problem.records import QuestionQuantities
    from planmethod.render.ink.drawing import Drawing


class Camshafts(ProblemKind["Camshaft"]):
    """Camshafts (кулачковые валы), as a kind of problem."""

    table = "cams"

    def load(self, path: Path, variant: str | None) -> Camshaft:
        """Read a problem file."""
        from planmethod.cams.shaft_reader import load

        return load(path, variant=variant)

    def record(self, problem: Camshaft, lang: str) -> dict[str, Any]:
        """Return the record of ``solve --json``."""
        from planmethod.cams.shaft_text import record

        return record(problem, lang)

    def spreadsheet(self, problem: Camshaft) -> SpreadsheetRows:
        """Return the text of ``solve --csv``."""
        from planmethod.cams.shaft_text import spreadsheet

        return spreadsheet(problem)

    def solved_document(self, problem: Camshaft, language: Language) -> Document:
        """Return the document of ``solve``."""
        from planmethod.cams.shaft_text import solved_document

        return Document.of(solved_document(problem, language))

    def protocol_document(
        self, problem: Camshaft, language: Language, request: PlanRequest
    ) -> Document:
        """Return the document of ``protocol``."""
        from planmethod.cams.shaft_results import protocol_document

        return Document.of(protocol_document(problem, language, request.profile))

    def drawings(self, problem: Camshaft, request: PlanRequest) -> list[Drawing]:
        """Return the sheets: the cyclogram, then each cam."""
        from planmethod.cams.shaft_sheet import drawings

        return drawings(problem, request)

    def live_page(self, problem: Camshaft, lang: str) -> str:
        """Return the page that ``live`` writes."""
        from planmethod.cams.shaft_live import live_page

        return live_page(problem, lang)

    def given_facts(self, problem: Camshaft, language: Language) -> list[GivenFact]:
        """Return the given data, one fact each; the file can be rebuilt from them."""
        from planmethod.cams.shaft_text import given_facts

        return given_facts(problem, language, numbered=True)

    def answer_source(self, problem: Camshaft) -> QuestionQuantities:
        """Return the computed quantities with which answers are compared."""
        from planmethod.cams.shaft_results import CamshaftQuantities

        return CamshaftQuantities(problem)
