"""Points that move by formulas (движение точки), as a kind of problem."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from planmethod.kind import ProblemKind
from planmethod.note.document import Document, GivenFact
from planmethod.options import PlanRequest

if TYPE_CHECKING:
    from planmethod.moving.motion import PointProblem
    from planmethod.note.audit import Audited
    from planmethod.note.wording import Language
    from planmethod.problem.records import QuestionQuantities
    from planmethod.render.ink.drawing import Drawing
    from planmethod.render.play.playback import Playback


class MovingPoints(ProblemKind["PointProblem"]):
    """Points that move by formulas (движение точки), as a kind of problem."""

    table = "point"

    def load(self, path: Path, variant: str | None) -> PointProblem:
        """Read a problem file."""
        from planmethod.moving.reader import load

        return load(path, variant=variant)

    def record(self, problem: PointProblem, lang: str) -> dict[str, Any]:
        """Return the record of ``solve --json``."""
        from planmethod.moving.text import record

        return record(problem, lang)

    def result_rows(self, problem: PointProblem) -> list[dict[str, Any]]:
        """Return the moments, one row each."""
        rows: list[dict[str, Any]] = self.record(problem, "en")["point"]
        return rows

    def solved_document(self, problem: PointProblem, language: Language) -> Document:
        """Return the document of ``solve``."""
        from planmethod.moving.text import solved_document

        return Document.of(solved_document(problem, language))

    def protocol_document(
        self, problem: PointProblem, language: Language, request: PlanRequest
    ) -> Document:
        """Return the document of ``protocol``."""
        from planmethod.moving.results import protocol_document

        return Document.of(protocol_document(problem, language, request.profile))

    def playback(self, problem: PointProblem, language: Language, request: PlanRequest) -> Playback:
        """Return the construction as it is played."""
        from planmethod.moving.playback import playback

        return playback(problem, language, request.profile)

    def drawings(self, problem: PointProblem, request: PlanRequest) -> list[Drawing]:
        """Return the sheets."""
        from planmethod.moving.sheet import drawings

        return drawings(problem, request)

    def live_page(self, problem: PointProblem, lang: str) -> str:
        """Return the page that ``live`` writes."""
        from planmethod.moving.live import live_page

        return live_page(problem, lang)

    def audited(self, problem: PointProblem, ruler: float) -> list[Audited]:
        """Return printed values beside the exact ones and those read with a ruler."""
        from planmethod.moving.results import audited

        return audited(problem, ruler)

    def given_facts(self, problem: PointProblem, language: Language) -> list[GivenFact]:
        """Return the given data, one fact each; the file can be rebuilt from them."""
        from planmethod.moving.text import given_facts

        return given_facts(problem, language)

    def answer_source(self, problem: PointProblem) -> QuestionQuantities:
        """Return the computed quantities with which answers are compared."""
        from planmethod.moving.results import PointQuantities

        return PointQuantities(problem)
